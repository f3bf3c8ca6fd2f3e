use super::shortest;
use crate::family::Family;
use crate::measure::{self, Value};
use crate::sweep::{Curve, Solved};

/// `cells.csv`: a row for each traced curve; a single one, without trace and circuit, for a cell that has no motion.
#[derive(Clone, Copy, Debug)]
pub struct Cells<'a> {
    family: &'a Family,
}

impl<'a> Cells<'a> {
    /// The table of a family.
    pub fn new(family: &'a Family) -> Cells<'a> {
        Cells { family }
    }

    /// The names of the columns.
    pub fn header(self) -> String {
        let parameters = self.family.template.parameters.iter().map(|parameter| parameter.name.as_str());
        let measures = measure::ALL.iter().map(|measure| measure.name);
        let all =
            ["cell", "trace", "circuit"].into_iter().chain(parameters).chain(["status", "reason"]).chain(measures);
        line(all.map(str::to_owned))
    }

    /// The rows of a cell.
    pub fn rows(self, solved: &Solved, out: &mut String) {
        if solved.is_left_out() {
            return;
        }
        if solved.curves.is_empty() {
            out.push_str(&self.row(solved, None));
        }
        for curve in &solved.curves {
            out.push_str(&self.row(solved, Some(curve)));
        }
    }

    fn row(self, solved: &Solved, curve: Option<&Curve>) -> String {
        let number = |value: f64| {
            let mut out = String::new();
            shortest(value, &mut out);
            out
        };
        let of_curve = |pick: fn(&Curve) -> usize| curve.map(|curve| pick(curve).to_string()).unwrap_or_default();
        let mut fields = vec![solved.cell.number.to_string(), of_curve(|c| c.trace), of_curve(|c| c.circuit)];
        fields.extend(self.family.parameters(&solved.cell).iter().map(|&value| number(value)));
        fields.push(solved.status().name().to_owned());
        fields.push(solved.motion.shortfall.clone().unwrap_or_default());
        fields.extend(measure::ALL.iter().enumerate().map(|(k, _)| match curve.map(|curve| curve.measures[k]) {
            Some(Value::Number(value)) => number(value),
            Some(Value::Word(word)) => word.to_owned(),
            Some(Value::Missing) | None => String::new(),
        }));
        line(fields.into_iter())
    }
}

/// A line of comma-separated values, quoted where they have to be.
fn line(fields: impl Iterator<Item = String>) -> String {
    let mut writer = csv::WriterBuilder::new().from_writer(Vec::new());
    // Writing to memory cannot fail, and what was written was text.
    let written = writer.write_record(fields).ok().and_then(|()| writer.into_inner().ok());
    written.and_then(|bytes| String::from_utf8(bytes).ok()).unwrap_or_default()
}
