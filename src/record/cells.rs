use coupler_curves::exchange::{shortest, whole};
use coupler_curves::family::Family;
use coupler_curves::measure::Value;
use coupler_curves::solve::{Curve, Solved, Status};

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
        let measures = self.family.taken().map(|(_, measure)| measure.name);
        let all =
            ["cell", "trace", "circuit"].into_iter().chain(parameters).chain(["status", "reason"]).chain(measures);
        let mut rows = Rows::onto(Vec::new());
        all.for_each(|name| rows.field(name.as_bytes()));
        rows.end();
        String::from_utf8(rows.finish()).unwrap_or_default()
    }

    /// The rows of a cell.
    pub fn rows(self, solved: &Solved, out: &mut Vec<u8>) {
        if solved.is_left_out() {
            return;
        }
        let mut rows = Rows::onto(std::mem::take(out));
        if solved.curves.is_empty() {
            self.row(solved, None, &mut rows);
        }
        for curve in &solved.curves {
            self.row(solved, Some(curve), &mut rows);
        }
        *out = rows.finish();
    }

    fn row(self, solved: &Solved, curve: Option<&Curve>, rows: &mut Rows) {
        rows.whole(Some(solved.cell.number));
        rows.whole(curve.map(|curve| curve.trace));
        rows.whole(curve.map(|curve| curve.circuit));
        self.family.parameters(&solved.cell).iter().for_each(|&value| rows.number(value));
        rows.field(solved.status().name().as_bytes());
        rows.field(solved.motion.shortfall.as_deref().unwrap_or_default().as_bytes());
        for (k, _) in self.family.taken() {
            match curve.map(|curve| curve.measures[k]) {
                Some(Value::Number(value)) => rows.number(value),
                Some(Value::Word(word)) => rows.field(word.as_bytes()),
                Some(Value::Missing) | None => rows.field(b""),
            }
        }
        rows.end();
    }
}

/// The cells of a `cells.csv` that were not assembled, or not over the whole range asked for, and why.
pub fn shortfalls(file: impl std::io::Read) -> Vec<(usize, String)> {
    let mut reader = csv::Reader::from_reader(file);
    let headers = reader.headers().cloned().unwrap_or_default();
    let place = |name: &str| headers.iter().position(|header| header == name);
    let (Some(cell), Some(status), Some(reason)) = (place("cell"), place("status"), place("reason")) else {
        return Vec::new();
    };
    let mut found: Vec<(usize, String)> = Vec::new();
    // A line that cannot be read tells nothing.
    for row in reader.records().flatten() {
        let number = row.get(cell).and_then(|number| number.parse().ok());
        let falls_short = row.get(status) != Some(Status::Ok.name());
        // A cell has a row for each of its curves.
        if let Some(number) = number.filter(|number| falls_short && found.last().is_none_or(|(last, _)| last != number))
        {
            found.push((number, row.get(reason).unwrap_or_default().to_owned()));
        }
    }
    found
}

/// Lines of comma-separated values, quoted where they have to be.
struct Rows {
    writer: csv::Writer<Vec<u8>>,
    /// The digits of a number.
    digits: Vec<u8>,
}

// Writing to memory cannot fail.
impl Rows {
    /// Lines after those there are.
    fn onto(out: Vec<u8>) -> Rows {
        Rows { writer: csv::Writer::from_writer(out), digits: Vec::new() }
    }

    fn field(&mut self, text: &[u8]) {
        let _ = self.writer.write_field(text);
    }

    fn number(&mut self, value: f64) {
        self.digits.clear();
        shortest(value, &mut self.digits);
        let _ = self.writer.write_field(&self.digits);
    }

    fn whole(&mut self, value: Option<usize>) {
        self.digits.clear();
        if let Some(value) = value {
            whole(value, &mut self.digits);
        }
        let _ = self.writer.write_field(&self.digits);
    }

    fn end(&mut self) {
        let _ = self.writer.write_record(None::<&[u8]>);
    }

    fn finish(self) -> Vec<u8> {
        self.writer.into_inner().unwrap_or_default()
    }
}
