use super::number::whole;
use super::shortest;
use crate::family::{Column, Family};
use crate::measure::take_columns;
use crate::solve::Solved;

/// `points.csv`: every sample of every curve.
#[derive(Clone, Copy, Debug)]
pub struct Points<'a> {
    /// How many two-valued joints the linkage has: a column of branches for each, and at least one.
    dyads: usize,
    /// The column of the input.
    input: &'static str,
    /// The columns that follow.
    columns: &'a [Column],
}

impl<'a> Points<'a> {
    /// The table of a family.
    pub fn new(family: &'a Family) -> Points<'a> {
        // All its linkages have as many two-valued joints.
        let dyads = family.linkage(&family.cell(0)).map_or(0, |linkage| linkage.dyads());
        let input = if family.template.is_driven_by_length() { "input_length" } else { "input_deg" };
        Points { dyads, input, columns: &family.columns }
    }

    /// The names of the columns.
    pub fn header(self) -> String {
        let further: String = (2..=self.dyads).map(|k| format!(",branch_{k}")).collect();
        let columns: String = self.columns.iter().map(|column| format!(",{}", column.name)).collect();
        format!("cell,trace,circuit,branch{further},sample,{},x,y{columns}\n", self.input)
    }

    /// The rows of a cell.
    pub fn rows(self, solved: &Solved, out: &mut Vec<u8>) {
        let mut head = Vec::new();
        for curve in &solved.curves {
            let circuit = solved.circuit(curve);
            head.clear();
            for number in [solved.cell.number, curve.trace, curve.circuit] {
                whole(number, &mut head);
                head.push(b',');
            }
            for sample in 0..circuit.len() {
                out.extend_from_slice(&head);
                let signs = circuit.signs(sample);
                for dyad in 0..self.dyads.max(1) {
                    out.extend_from_slice(if signs.get(dyad) > 0 { b"1," } else { b"-1," });
                }
                whole(sample, out);
                let at = circuit.places.point(curve.joint, sample);
                let columns = take_columns(self.columns, &solved.linkage, (circuit, curve.joint), sample);
                for value in [circuit.input[sample], at.x, at.y].into_iter().chain(columns) {
                    out.push(b',');
                    shortest(value, out);
                }
                out.push(b'\n');
            }
        }
    }
}
