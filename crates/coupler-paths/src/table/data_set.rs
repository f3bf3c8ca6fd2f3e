//! The paths in a table, and the points of one.

use coupler_curves::geometry::Point;

use super::block::{Block, Row};
use super::columns::{Columns, Header};
use super::dialect::Dialect;
use super::line::Divider;
use super::name::degrees_in;
use super::number::{is_missing, parse_number};
use crate::outline::{Outline, ReadOptions, Reading, limited};

/// A path in a table.
pub(super) struct DataSet<'t, 'a> {
    /// What it is called, if it has a name.
    pub id: Option<String>,
    header: Option<&'t Header>,
    /// The columns of its coordinates.
    coordinates: [usize; 2],
    rows: Vec<&'t Row<'a>>,
    /// The number of cells before the first column that has a name: 1 if rows begin with their names, as in R.
    shift: usize,
}

/// All paths of a block.
pub(super) fn data_sets<'t, 'a>(block: &'t Block<'a>) -> Vec<DataSet<'t, 'a>> {
    let Some(header) = &block.header else {
        let rows = block.rows.iter().collect();
        return vec![DataSet { id: None, header: None, coordinates: [0, 1], rows, shift: 0 }];
    };
    // As R writes them, in quotes or not.
    let has_row_name = |row: &Row| {
        row.cells.len() == header.names.len() + 1 && row.line.text.starts_with(|c: char| c == '"' || c.is_alphabetic())
    };
    let shift = usize::from(block.rows.iter().all(has_row_name));
    let set = |id, coordinates, rows| DataSet { id, header: Some(header), coordinates, rows, shift };
    let pairs = header.coordinates();
    if let ([only], [Some(cell), Some(trace), Some(circuit)]) =
        (&pairs[..], ["cell", "trace", "circuit"].map(|name| header.column(name)))
    {
        // Of points.csv: a path for each curve.
        let mut sets: Vec<DataSet> = Vec::new();
        for row in &block.rows {
            let part = |column: usize| row.cells.get(column).map_or("", String::as_str);
            let id = Some([cell, trace, circuit].map(part).join("."));
            match sets.last_mut().filter(|set| set.id == id) {
                Some(set) => set.rows.push(row),
                None => sets.push(set(id, *only, vec![row])),
            }
        }
        return sets;
    }
    pairs.iter().map(|pair| set(Some(header.id(*pair)), *pair, block.rows.iter().collect())).collect()
}

impl DataSet<'_, '_> {
    /// The numbers of its first and its last line.
    pub fn lines(&self) -> [usize; 2] {
        [self.rows.first(), self.rows.last()].map(|row| row.map_or(0, |row| row.line.number))
    }

    /// Its points, and what was taken for them.
    ///
    /// # Errors
    /// Every line that cannot be read, or why the columns are not known.
    pub fn outline(&self, dialect: Dialect, options: &ReadOptions) -> Result<Outline, Vec<String>> {
        let columns = self.columns(dialect, options).map_err(|problem| vec![problem])?;
        let degrees = match (self.header, columns.angle.filter(|_| options.is_timed)) {
            (Some(header), Some(angle)) => {
                degrees_in(header.names[angle].unit.as_deref()).map_err(|problem| vec![problem])?
            }
            _ => 1.0,
        };
        let unit = self.unit([columns.x, columns.y])?;
        let reader = RowReader { dialect, columns, set: self, is_timed: options.is_timed, degrees };
        let (rows, left_out) = reader.without_blank_ends();
        let mut outline = Outline::new(Vec::new(), None, self.closed(dialect, rows));
        let mut angles_deg = Vec::new();
        let mut problems = Vec::new();
        for row in rows {
            reader.read(row, &mut outline.points, &mut angles_deg, &mut problems);
        }
        if !problems.is_empty() {
            return Err(limited(problems, "lines"));
        }
        outline.angles_deg = (!angles_deg.is_empty()).then_some(angles_deg);
        let taken = self.describe_taken(dialect, columns, options, unit.as_deref(), left_out);
        outline.reading = Reading { taken, has_unused_angles: !options.is_timed && self.has_angles(columns) };
        Ok(outline)
    }

    /// Whether the column `closed` of an exported curve says that it is closed.
    fn closed(&self, dialect: Dialect, rows: &[&Row]) -> Option<bool> {
        let column = self.header?.column("closed")? + self.shift;
        let value = |row: &&Row| row.cells.get(column).and_then(|cell| parse_number(cell, dialect.style));
        let first = rows.first().and_then(value).filter(|value| [0.0, 1.0].contains(value))?;
        rows.iter().all(|row| value(row) == Some(first)).then_some(first == 1.0)
    }

    fn columns(&self, dialect: Dialect, options: &ReadOptions) -> Result<Columns, String> {
        let is_timed = options.is_timed;
        let [x, y] = self.coordinates;
        let Some(header) = self.header else {
            let has_third = self.rows.first().is_some_and(|row| row.cells.len() == 3);
            if has_third {
                self.check_three(dialect, is_timed)?;
            }
            return Ok(Columns { x, y, angle: has_third.then_some(2) });
        };
        match header.angles()[..] {
            [] => Ok(Columns { x, y, angle: None }),
            [angle] => Ok(Columns { x, y, angle: Some(angle) }),
            [first, second, ..] if is_timed => {
                let [first, second] = [first, second].map(|k| &header.names[k].text);
                Err(format!(
                    "the columns `{first}` and `{second}` may both be the angle of the {}: name one of them `angle`",
                    options.angles_of
                ))
            }
            [..] => Ok(Columns { x, y, angle: None }),
        }
    }

    /// Whether there are columns of angles, which of them ever is that of the crank.
    fn has_angles(&self, columns: Columns) -> bool {
        columns.angle.is_some() || self.header.is_some_and(|header| !header.angles().is_empty())
    }

    /// Checks that the first of three columns without names is not time or an index, and that the third may be the angle, if it is asked for.
    fn check_three(&self, dialect: Dialect, is_timed: bool) -> Result<(), String> {
        const HALF_TURN: f64 = 180.0;
        let column = |k: usize| -> Option<Vec<f64>> {
            let value = |row: &&Row| row.cells.get(k).and_then(|cell| parse_number(cell, dialect.style));
            self.rows.iter().map(value).collect()
        };
        let (Some(first), Some(third)) = (column(0), column(2)) else { return Ok(()) };
        if first.len() < 4 {
            return Ok(());
        }
        let steps = |values: &[f64]| values.windows(2).map(|pair| pair[1] - pair[0]).collect::<Vec<f64>>();
        // Time, an index or an angle goes one way, whatever it counts, and an angle may begin again after a turn.
        let goes_one_way = |values: &[f64], least_turn: f64| {
            let steps: Vec<f64> = steps(values).into_iter().filter(|step| step.abs() < least_turn).collect();
            let [rises, falls] = [1.0, -1.0].map(|sign| steps.iter().any(|step| sign * step > 0.0));
            rises != falls
        };
        let is_even = |values: &[f64]| {
            let steps = steps(values);
            let [least, greatest] = [
                steps.iter().copied().fold(f64::INFINITY, f64::min),
                steps.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            ];
            greatest - least <= 0.02 * greatest.abs().max(least.abs())
        };
        let may_be_angle = is_even(&third) || !is_even(&first) && goes_one_way(&third, HALF_TURN);
        if goes_one_way(&first, f64::INFINITY) && !(is_timed && may_be_angle) {
            return Err("the table has three columns without names, the first of which rises or falls throughout as time, an index or x may: name them in a first line, as in t,x,y or x,y,angle".to_owned());
        }
        Ok(())
    }

    /// The unit of both coordinates, if they have one.
    fn unit(&self, columns: [usize; 2]) -> Result<Option<String>, Vec<String>> {
        let Some(header) = self.header else { return Ok(None) };
        match columns.map(|k| header.names[k].unit.clone()) {
            [Some(x), Some(y)] if x != y => Err(vec![format!("x is in {x} and y in {y}: write both in one unit")]),
            [x, y] => Ok(x.or(y)),
        }
    }

    /// What was taken, as a clause.
    fn describe_taken(
        &self,
        dialect: Dialect,
        columns: Columns,
        options: &ReadOptions,
        unit: Option<&str>,
        left_out: usize,
    ) -> String {
        let name = |k: usize| match self.header {
            Some(header) => format!("{} `{}`", k + 1 + self.shift, header.names[k].text),
            None => (k + 1).to_string(),
        };
        let mut reading = format!("x is column {}, y column {}", name(columns.x), name(columns.y));
        match columns.angle {
            Some(angle) if options.is_timed => {
                let own = self.header.and_then(|header| header.names[angle].unit.as_deref());
                reading += &format!(
                    ", the angle of the {} column {}, in {}",
                    options.angles_of,
                    name(angle),
                    own.unwrap_or("degrees")
                );
            }
            Some(angle) => reading += &format!("; column {} is not used without --timed", name(angle)),
            None => {}
        }
        if let Some(unit) = unit {
            reading += &format!("; in {unit}");
            if unit.starts_with("px") || unit.starts_with("pixel") {
                reading += ", with y pointing up";
            }
        }
        if dialect.style.decimal == ',' {
            reading += "; commas are decimal";
        }
        match left_out {
            0 => {}
            1 => reading += "; a line without coordinates at an end is left out",
            count => reading += &format!("; {count} lines without coordinates at the ends are left out"),
        }
        reading
    }
}

/// Reads the rows of a path.
struct RowReader<'r, 't, 'a> {
    dialect: Dialect,
    columns: Columns,
    set: &'r DataSet<'t, 'a>,
    is_timed: bool,
    /// Degrees in the unit of the angle.
    degrees: f64,
}

impl<'t, 'a> RowReader<'_, 't, 'a> {
    fn cell<'c>(&self, row: &'c Row, column: usize) -> Option<&'c str> {
        row.cells.get(column + self.set.shift).map(String::as_str)
    }

    fn has_no_coordinates(&self, row: &Row) -> bool {
        let is_none = |column| self.cell(row, column).is_none_or(is_missing);
        self.set.header.is_some() && is_none(self.columns.x) && is_none(self.columns.y)
    }

    /// The rows without those at both ends that have no coordinates, and the number of these.
    fn without_blank_ends(&self) -> (&[&'t Row<'a>], usize) {
        let rows = &self.set.rows[..];
        let is_present = |row: &&Row| !self.has_no_coordinates(row);
        let (Some(first), Some(last)) = (rows.iter().position(is_present), rows.iter().rposition(is_present)) else {
            return (rows, 0);
        };
        (&rows[first..=last], rows.len() - (last + 1 - first))
    }

    fn read(&self, row: &Row, points: &mut Vec<Point>, angles_deg: &mut Vec<f64>, problems: &mut Vec<String>) {
        let number = row.line.number;
        let mut problem = |text: String| problems.push(format!("line {number}: {text}"));
        let text = row.line.text;
        let count = row.cells.len();
        let most = match self.set.header {
            Some(header) => header.names.len() + self.set.shift,
            // Without names there are a point and an angle.
            None => self.set.rows[0].cells.len().clamp(2, 3),
        };
        let is_shifted = self.dialect.divider == Divider::Blanks && count < most;
        if count > most || count > 1 && (is_shifted || self.set.header.is_none() && count != most) {
            if count < most && self.columns.angle.is_some() && self.is_timed {
                return problem(format!("`{text}` has no angle, as the others have"));
            }
            let hint = match self.dialect.divider {
                Divider::Char(',') if count > most && self.set.header.is_none() => {
                    ": write decimals with a point, or divide fields by semicolons; of more than three columns write their names in a first line"
                }
                Divider::Char(',') if count > most => ": write decimals with a point, or divide fields by semicolons",
                _ => "",
            };
            return problem(format!("`{text}` has {count} fields, and not {most}{hint}"));
        }
        if self.has_no_coordinates(row) {
            return problem(format!(
                "`{text}` has no coordinates, a gap in the path: keep the lines before or after it"
            ));
        }
        if let Some(angle) = self.columns.angle.filter(|_| self.is_timed) {
            match self.cell(row, angle).map(|cell| self.number(cell, "an angle")) {
                Some(Ok(angle)) => angles_deg.push(angle * self.degrees),
                Some(Err(error)) => problem(error),
                None => problem(format!("`{text}` has no angle, as the others have")),
            }
        }
        match [self.columns.x, self.columns.y].map(|column| self.cell(row, column)) {
            [Some(x), Some(y)] => match [x, y].map(|cell| self.number(cell, "a coordinate")) {
                [Ok(x), Ok(y)] => points.push(Point::new(x, y)),
                coordinates => coordinates.into_iter().filter_map(Result::err).for_each(problem),
            },
            _ => problem(format!("`{text}` has no two coordinates: write them like 1.5, 2")),
        }
    }

    /// A number that must be finite.
    fn number(&self, cell: &str, what: &str) -> Result<f64, String> {
        match parse_number(cell, self.dialect.style) {
            Some(value) if value.is_finite() => Ok(value),
            Some(value) => Err(format!("`{cell}` is {value}: {what} must be finite")),
            None => Err(not_a_number(cell, self.dialect, self.set.rows.iter().copied())),
        }
    }
}

/// What is wrong with a cell that is no number in a table with these rows.
pub(super) fn not_a_number<'r, 'a: 'r>(
    cell: &str,
    dialect: Dialect,
    rows: impl IntoIterator<Item = &'r Row<'a>>,
) -> String {
    let [own, other] = if dialect.style.decimal == '.' { ['.', ','] } else { [',', '.'] };
    let is_plain = |cell: &str| cell.replacen(',', ".", 1).parse::<f64>().is_ok();
    let is_own = |cell: &String| cell.contains(own) && is_plain(cell);
    if cell.contains(other) && is_plain(cell) && rows.into_iter().any(|row| row.cells.iter().any(is_own)) {
        let [found, usual] = if own == '.' { ["a comma", "a decimal point"] } else { ["a point", "a decimal comma"] };
        let [with, without] = if own == '.' { ["a point", "the comma"] } else { ["a comma", "the point"] };
        return format!(
            "`{cell}` has {found} where other numbers have {usual}: write it with {with}, or without {without}"
        );
    }
    format!("`{cell}` is not a number")
}
