//! The typed columns of the tables of a shard, and rows of them.

use std::borrow::Cow;

use coupler_curves::exchange::PointTable;
use coupler_curves::expression::Unit;
use coupler_curves::family::Family;
use coupler_curves::linkage::DyadId;
use coupler_curves::measure::{Measure, Value, compute_columns};
use coupler_curves::solve::SolvedCell;
use coupler_curves::template::ParameterKind;

use crate::record::CellTable;

/// The type of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColumnKind {
    /// Numbers of cells: integers of 64 bits.
    Cell,
    /// Other integers, of 32 bits.
    Integer,
    /// Floating-point numbers of 64 bits.
    Number,
    /// Words.
    Word,
}

/// A column of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct TableColumn {
    /// Its name, as in `cells.csv` and `points.csv`.
    pub name: String,
    /// Its type.
    pub kind: ColumnKind,
    /// Whether a value may be missing.
    pub is_optional: bool,
    /// Whether few of its values are different, so that a dictionary of them is shorter.
    pub is_repetitive: bool,
    /// The unit of its values, `deg` and the like; empty for words, counts, ratios and the manifest's own unit of length.
    pub unit: &'static str,
}

impl TableColumn {
    fn new(name: &str, kind: ColumnKind) -> TableColumn {
        let is_repetitive = matches!(kind, ColumnKind::Integer | ColumnKind::Word);
        TableColumn { name: name.to_owned(), kind, is_optional: false, is_repetitive, unit: "" }
    }

    fn optional(self) -> TableColumn {
        TableColumn { is_optional: true, ..self }
    }

    fn repetitive(self) -> TableColumn {
        TableColumn { is_repetitive: true, ..self }
    }

    fn in_unit(self, unit: &'static str) -> TableColumn {
        TableColumn { unit, ..self }
    }
}

/// The columns of `cells.csv` of a family.
pub(super) fn cell_columns(family: &Family) -> Vec<TableColumn> {
    let parameter = |k: usize| match family.template.parameters[k].kind {
        ParameterKind::Angle(Unit::Rad) => "rad",
        ParameterKind::Angle(_) => "deg",
        _ => "",
    };
    let header = CellTable::new(family).header();
    let (parameters, measures) = (family.template.parameters.len(), family.computed_measures());
    let measures: Vec<_> = measures.map(|(_, measure)| measure).collect();
    let is_driven_by_length = family.template.is_driven_by_length();
    let column = |(k, name): (usize, &str)| match (name, k.checked_sub(3)) {
        (_, None) if k == 0 => TableColumn::new(name, ColumnKind::Cell),
        (_, None) => TableColumn::new(name, ColumnKind::Integer).optional(),
        (_, Some(k)) if k < parameters => TableColumn::new(name, ColumnKind::Number).repetitive().in_unit(parameter(k)),
        ("status" | "family", _) => TableColumn::new(name, ColumnKind::Word),
        ("reason" | "joint", _) => TableColumn::new(name, ColumnKind::Word).optional(),
        _ => {
            let measure = measures.iter().find(|measure| measure.name_for(is_driven_by_length) == name);
            let is_word = measure.is_some_and(|measure| measure.is_word);
            let kind = if is_word { ColumnKind::Word } else { ColumnKind::Number };
            // Those of inputs are lengths if the input is one.
            let has_unit = |measure: &&&Measure| measure.name_for(is_driven_by_length) == measure.name;
            let unit = measure.filter(has_unit).map_or("", |measure| measure.unit);
            TableColumn::new(name, kind).optional().in_unit(unit)
        }
    };
    header.trim_end().split(',').enumerate().map(column).collect()
}

/// The columns of `points.csv` of a family.
pub(super) fn point_columns(family: &Family) -> Vec<TableColumn> {
    let header = PointTable::new(family).header();
    // Derivatives with respect to a length are in the manifest's unit of length.
    let is_driven_by_length = family.template.is_driven_by_length();
    let unit = |unit: &'static str| if is_driven_by_length && unit.contains("radian") { "" } else { unit };
    let column = |(k, name): (usize, &str)| match name {
        _ if k == 0 => TableColumn::new(name, ColumnKind::Cell),
        "trace" | "circuit" | "sample" => TableColumn::new(name, ColumnKind::Integer),
        "input_deg" => TableColumn::new(name, ColumnKind::Number).repetitive().in_unit("deg"),
        "input_length" | "x" | "y" => TableColumn::new(name, ColumnKind::Number),
        _ => match family.columns.iter().find(|column| column.name == name) {
            Some(column) => TableColumn::new(name, ColumnKind::Number).optional().in_unit(unit(column.unit)),
            // `branch`, `branch_2` and so on.
            None => TableColumn::new(name, ColumnKind::Integer),
        },
    };
    header.trim_end().split(',').enumerate().map(column).collect()
}

/// A word of a column; those of measures are many and always the same.
pub type Word = Cow<'static, str>;

/// The values of a column that are not missing, in order.
#[derive(Clone, Debug)]
pub enum Values {
    /// Of [`ColumnKind::Cell`] and [`ColumnKind::Integer`].
    Integers(Vec<i64>),
    /// Of [`ColumnKind::Number`].
    Numbers(Vec<f64>),
    /// Of [`ColumnKind::Word`].
    Words(Vec<Word>),
}

/// A column of some rows.
#[derive(Clone, Debug)]
pub struct ColumnRows {
    /// Its values that are not missing.
    pub values: Values,
    /// For each row 1 if it has a value, otherwise 0; empty if none may be missing. Parquet calls these definition levels.
    pub levels: Vec<i16>,
    is_optional: bool,
}

impl ColumnRows {
    fn new(column: &TableColumn) -> ColumnRows {
        let values = match column.kind {
            ColumnKind::Cell | ColumnKind::Integer => Values::Integers(Vec::new()),
            ColumnKind::Number => Values::Numbers(Vec::new()),
            ColumnKind::Word => Values::Words(Vec::new()),
        };
        ColumnRows { values, levels: Vec::new(), is_optional: column.is_optional }
    }

    fn add_level(&mut self, is_present: bool) {
        if self.is_optional {
            self.levels.push(i16::from(is_present));
        }
    }

    fn integer(&mut self, value: Option<usize>) {
        if let (Values::Integers(values), Some(value)) = (&mut self.values, value) {
            values.push(value as i64);
        }
        self.add_level(value.is_some());
    }

    /// Adds a number; NaN is a missing one, and zero has no sign, as in `cells.csv`.
    fn number(&mut self, value: f64) {
        if let (Values::Numbers(values), false) = (&mut self.values, value.is_nan()) {
            values.push(if value == 0.0 { 0.0 } else { value });
        }
        self.add_level(!value.is_nan());
    }

    fn word(&mut self, word: Option<Word>) {
        self.add_level(word.is_some());
        if let (Values::Words(values), Some(word)) = (&mut self.values, word) {
            values.push(word);
        }
    }

    fn append(&mut self, other: ColumnRows) {
        self.levels.extend(other.levels);
        match (&mut self.values, other.values) {
            (Values::Integers(own), Values::Integers(others)) => own.extend(others),
            (Values::Numbers(own), Values::Numbers(others)) => own.extend(others),
            (Values::Words(own), Values::Words(others)) => own.extend(others),
            // The columns of a table have the same types in all rows.
            _ => {}
        }
    }

    /// Removes the first rows.
    fn split_off_first(&mut self, rows: usize) -> ColumnRows {
        let present = match self.is_optional {
            true => self.levels[..rows].iter().filter(|level| **level == 1).count(),
            false => rows,
        };
        fn first<T>(values: &mut Vec<T>, count: usize) -> Vec<T> {
            let rest = values.split_off(count);
            std::mem::replace(values, rest)
        }
        let levels = if self.is_optional { first(&mut self.levels, rows) } else { Vec::new() };
        let values = match &mut self.values {
            Values::Integers(values) => Values::Integers(first(values, present)),
            Values::Numbers(values) => Values::Numbers(first(values, present)),
            Values::Words(values) => Values::Words(first(values, present)),
        };
        ColumnRows { values, levels, is_optional: self.is_optional }
    }
}

/// Some rows of a table, column by column.
#[derive(Clone, Debug)]
pub struct Rows {
    /// The columns.
    pub columns: Vec<ColumnRows>,
    /// The number of rows.
    pub len: usize,
}

impl Rows {
    /// No rows of a table with these columns.
    pub fn new(columns: &[TableColumn]) -> Rows {
        Rows { columns: columns.iter().map(ColumnRows::new).collect(), len: 0 }
    }

    /// Appends rows of the same table.
    pub fn append(&mut self, other: Rows) {
        self.len += other.len;
        self.columns.iter_mut().zip(other.columns).for_each(|(own, others)| own.append(others));
    }

    /// Removes the first rows, at most as many as there are.
    pub fn split_off_first(&mut self, rows: usize) -> Rows {
        let rows = rows.min(self.len);
        self.len -= rows;
        Rows { columns: self.columns.iter_mut().map(|column| column.split_off_first(rows)).collect(), len: rows }
    }

    /// The bytes of all words.
    pub(super) fn text_bytes(&self) -> usize {
        let bytes = |column: &ColumnRows| match &column.values {
            Values::Words(words) => words.iter().map(|word| word.len()).sum(),
            _ => 0,
        };
        self.columns.iter().map(bytes).sum()
    }

    /// Appends the rows of `cells.csv` of a cell; the columns are those of that table.
    pub fn append_cell(&mut self, family: &Family, solved: &SolvedCell) {
        if solved.is_left_out() {
            return;
        }
        let curves = solved.curves.iter().map(Some).chain(solved.curves.is_empty().then_some(None));
        for curve in curves {
            self.len += 1;
            let mut columns = self.columns.iter_mut();
            // There are as many columns as values.
            let mut next = |add: &mut dyn FnMut(&mut ColumnRows)| columns.next().into_iter().for_each(add);
            next(&mut |column| column.integer(Some(solved.cell.number)));
            next(&mut |column| column.integer(curve.map(|curve| curve.trace)));
            next(&mut |column| column.integer(curve.map(|curve| curve.circuit)));
            for &value in family.parameter_values(&solved.cell) {
                next(&mut |column| column.number(value));
            }
            next(&mut |column| column.word(Some(solved.status().name().into())));
            next(&mut |column| column.word(Some(solved.reason()).filter(|text| !text.is_empty()).map(Word::Owned)));
            for (k, measure) in family.computed_measures() {
                let value = curve.map_or(Value::Missing, |curve| curve.values[k]);
                next(&mut |column| match value {
                    Value::Word(word) => column.word(Some(word.into())),
                    Value::Number(number) => column.number(number),
                    Value::Missing if measure.is_word => column.word(None),
                    Value::Missing => column.number(f64::NAN),
                });
            }
            next(&mut |column| column.word(Some(family.id.clone().into())));
            let joint = curve.map(|curve| solved.linkage.joints[curve.joint].name.clone());
            next(&mut |column| column.word(joint.clone().map(Word::Owned)));
        }
    }

    /// Appends the rows of `points.csv` of a cell; the columns are those of that table.
    pub fn append_points(&mut self, family: &Family, solved: &SolvedCell) {
        let dyads = solved.linkage.dyad_count().max(1);
        for curve in &solved.curves {
            let circuit = solved.circuit(curve);
            self.len += circuit.len();
            for (column, number) in self.columns.iter_mut().zip([solved.cell.number, curve.trace, curve.circuit]) {
                if let Values::Integers(values) = &mut column.values {
                    values.extend(std::iter::repeat_n(number as i64, circuit.len()));
                }
            }
            for (dyad, column) in (0..dyads).map(DyadId::new).zip(self.columns.iter_mut().skip(3)) {
                if let Values::Integers(values) = &mut column.values {
                    let branch = |sample| if circuit.mode_at(sample).sign(dyad) > 0 { 1 } else { -1 };
                    values.extend((0..circuit.len()).map(branch));
                }
            }
            let mut columns = self.columns.iter_mut().skip(3 + dyads);
            let mut next = |add: &mut dyn FnMut(&mut ColumnRows)| columns.next().into_iter().for_each(add);
            next(&mut |column| (0..circuit.len()).for_each(|sample| column.integer(Some(sample))));
            next(&mut |column| circuit.inputs.iter().for_each(|input| column.number(*input)));
            next(&mut |column| circuit.points(curve.joint).for_each(|point| column.number(point.x)));
            next(&mut |column| circuit.points(curve.joint).for_each(|point| column.number(point.y)));
            if !family.columns.is_empty() {
                let first = 7 + dyads;
                for sample in 0..circuit.len() {
                    let values = compute_columns(&family.columns, &solved.linkage, circuit, curve.joint, sample);
                    for (column, value) in self.columns[first..].iter_mut().zip(values) {
                        column.number(value);
                    }
                }
            }
        }
    }
}
