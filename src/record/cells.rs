//! The table `cells.csv`.

use coupler_curves::exchange::{append_integer, append_number};
use coupler_curves::family::Family;
use coupler_curves::measure::Value;
use coupler_curves::solve::{MeasuredCurve, SolvedCell, Status};

/// `cells.csv`: a row for each traced curve, and one without trace and circuit for a cell that has no curves.
#[derive(Clone, Copy, Debug)]
pub struct CellTable<'a> {
    family: &'a Family,
}

impl<'a> CellTable<'a> {
    /// The table of a family.
    pub fn new(family: &'a Family) -> CellTable<'a> {
        CellTable { family }
    }

    /// The header line.
    pub fn header(self) -> String {
        let parameters = self.family.template.parameters.iter().map(|parameter| parameter.name.as_str());
        let is_driven_by_length = self.family.template.is_driven_by_length();
        let measures = self.family.computed_measures().map(|(_, measure)| measure.name_for(is_driven_by_length));
        let first = ["cell", "trace", "circuit"].into_iter().chain(parameters).chain(["status", "reason"]);
        let all = first.chain(measures).chain(["family", "joint"]);
        let mut rows = CsvWriter::append_to(Vec::new());
        all.for_each(|name| rows.field(name.as_bytes()));
        rows.end_row();
        String::from_utf8(rows.into_bytes()).unwrap_or_default()
    }

    /// Appends the rows of a cell.
    pub fn append_rows(self, solved: &SolvedCell, out: &mut Vec<u8>) {
        if solved.is_left_out() {
            return;
        }
        let mut rows = CsvWriter::append_to(std::mem::take(out));
        if solved.curves.is_empty() {
            self.write_row(solved, None, &mut rows);
        }
        for curve in &solved.curves {
            self.write_row(solved, Some(curve), &mut rows);
        }
        *out = rows.into_bytes();
    }

    fn write_row(self, solved: &SolvedCell, curve: Option<&MeasuredCurve>, rows: &mut CsvWriter) {
        rows.integer(Some(solved.cell.number));
        rows.integer(curve.map(|curve| curve.trace));
        rows.integer(curve.map(|curve| curve.circuit));
        self.family.parameter_values(&solved.cell).iter().for_each(|&value| rows.number(value));
        rows.field(solved.status().name().as_bytes());
        rows.field(solved.reason().as_bytes());
        for (k, _) in self.family.computed_measures() {
            match curve.map(|curve| curve.values[k]) {
                Some(Value::Number(value)) => rows.number(value),
                Some(Value::Word(word)) => rows.field(word.as_bytes()),
                Some(Value::Missing) | None => rows.field(b""),
            }
        }
        rows.field(self.family.id.as_bytes());
        rows.field(curve.map_or("", |curve| &solved.linkage.joints[curve.joint].name).as_bytes());
        rows.end_row();
    }
}

/// Reads from a `cells.csv` the cells that could not be assembled, or not over the whole requested range, and why.
pub fn read_unassembled_cells(file: impl std::io::Read) -> Vec<(usize, String)> {
    let mut reader = csv::Reader::from_reader(file);
    let headers = reader.headers().cloned().unwrap_or_default();
    let column = |name: &str| headers.iter().position(|header| header == name);
    let (Some(cell), Some(status), Some(reason)) = (column("cell"), column("status"), column("reason")) else {
        return Vec::new();
    };
    let mut found: Vec<(usize, String)> = Vec::new();
    // Lines that cannot be read are skipped.
    for row in reader.records().flatten() {
        let number = row.get(cell).and_then(|number| number.parse().ok());
        let falls_short = row.get(status) != Some(Status::Ok.name());
        // A cell may have several rows, one for each of its curves.
        if let Some(number) = number.filter(|number| falls_short && found.last().is_none_or(|(last, _)| last != number))
        {
            found.push((number, row.get(reason).unwrap_or_default().to_owned()));
        }
    }
    found
}

/// Writes lines of comma-separated values, quoted where necessary.
struct CsvWriter {
    writer: csv::Writer<Vec<u8>>,
    /// A buffer for the digits of a number.
    digits: Vec<u8>,
}

// Writing to memory cannot fail.
impl CsvWriter {
    /// Appends lines to existing text.
    fn append_to(out: Vec<u8>) -> CsvWriter {
        CsvWriter { writer: csv::Writer::from_writer(out), digits: Vec::new() }
    }

    fn field(&mut self, text: &[u8]) {
        let _ = self.writer.write_field(text);
    }

    fn number(&mut self, value: f64) {
        self.digits.clear();
        append_number(value, &mut self.digits);
        let _ = self.writer.write_field(&self.digits);
    }

    fn integer(&mut self, value: Option<usize>) {
        self.digits.clear();
        if let Some(value) = value {
            append_integer(value, &mut self.digits);
        }
        let _ = self.writer.write_field(&self.digits);
    }

    fn end_row(&mut self) {
        let _ = self.writer.write_record(None::<&[u8]>);
    }

    fn into_bytes(self) -> Vec<u8> {
        self.writer.into_inner().unwrap_or_default()
    }
}
