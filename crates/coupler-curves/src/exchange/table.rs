use super::append_number;
use super::number::append_integer;
use crate::family::{Column, Family};
use crate::linkage::DyadId;
use crate::measure::compute_columns;
use crate::solve::SolvedCell;

/// The table `points.csv`: every sample of every curve.
#[derive(Clone, Copy, Debug)]
pub struct PointTable<'a> {
    /// The number of dyads, each with a column of branches; there is always at least one such column.
    dyad_count: usize,
    /// The name of the input's column.
    input_column: &'static str,
    /// The additional columns.
    columns: &'a [Column],
}

impl<'a> PointTable<'a> {
    /// The table of a family.
    pub fn new(family: &'a Family) -> PointTable<'a> {
        // All its linkages have the same number of dyads.
        let dyads = family.linkage(&family.cell(0)).map_or(0, |linkage| linkage.dyad_count());
        let input = if family.template.is_driven_by_length() { "input_length" } else { "input_deg" };
        PointTable { dyad_count: dyads, input_column: input, columns: &family.columns }
    }

    /// The names of the columns.
    pub fn header(self) -> String {
        let further: String = (2..=self.dyad_count).map(|k| format!(",branch_{k}")).collect();
        let columns: String = self.columns.iter().map(|column| format!(",{}", column.name)).collect();
        format!("cell,trace,circuit,branch{further},sample,{},x,y{columns}\n", self.input_column)
    }

    /// The rows of a cell.
    pub fn append_rows(self, solved: &SolvedCell, out: &mut Vec<u8>) {
        let mut head = Vec::new();
        for curve in &solved.curves {
            let circuit = solved.circuit(curve);
            head.clear();
            for number in [solved.cell.number, curve.trace, curve.circuit] {
                append_integer(number, &mut head);
                head.push(b',');
            }
            for sample in 0..circuit.len() {
                out.extend_from_slice(&head);
                let mode = circuit.mode_at(sample);
                for dyad in (0..self.dyad_count.max(1)).map(DyadId::new) {
                    out.extend_from_slice(if mode.sign(dyad) > 0 { b"1," } else { b"-1," });
                }
                append_integer(sample, out);
                let point = circuit.positions.point(curve.joint, sample);
                let columns = compute_columns(self.columns, &solved.linkage, circuit, curve.joint, sample);
                for value in [circuit.inputs[sample], point.x, point.y].into_iter().chain(columns) {
                    out.push(b',');
                    append_number(value, out);
                }
                out.push(b'\n');
            }
        }
    }
}
