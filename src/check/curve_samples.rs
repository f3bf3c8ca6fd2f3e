use std::collections::HashMap;

use crate::record::{Row, TableError};
use coupler_curves::geometry::{Bounds, Point};

/// A curve read from the rows of `points.csv`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CurveSamples {
    pub trace: usize,
    pub circuit: usize,
    /// The numbers of the samples, as in the table.
    pub sample_numbers: Vec<usize>,
    pub inputs: Vec<f64>,
    pub points: Vec<Point>,
    /// The branches of the two-valued joints, joint by joint.
    pub branches: Vec<Vec<i64>>,
    /// The values of the further columns, column by column.
    pub further_columns: Vec<Vec<f64>>,
}

/// The indices of the columns of a `points.csv`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct PointColumns {
    trace: usize,
    circuit: usize,
    sample: usize,
    input: usize,
    x: usize,
    y: usize,
    branches: Vec<usize>,
    /// The names and indices of the further columns to compare.
    pub further_columns: Vec<(String, usize)>,
}

impl PointColumns {
    /// Finds the columns in a header; `expected` are the columns to compare.
    ///
    /// # Errors
    /// The names of required columns that are missing.
    pub fn from_header(header: &[String], expected: &[String]) -> Result<PointColumns, Vec<String>> {
        let index = |name: &str| header.iter().position(|other| other == name);
        let is_input = |name: &&String| name.starts_with("input_");
        let input = expected.iter().find(is_input).map_or("input_deg", String::as_str);
        let required = ["trace", "circuit", "sample", input, "x", "y"];
        let missing = || required.iter().filter(|name| index(name).is_none()).map(|name| (*name).to_owned()).collect();
        let [Some(trace), Some(circuit), Some(sample), Some(input), Some(x), Some(y)] = required.map(index) else {
            return Err(missing());
        };
        let is_branch = |name: &str| name == "branch" || name.starts_with("branch_");
        let common = || expected.iter().filter_map(|name| Some((name.clone(), index(name)?)));
        let branches = common().filter(|(name, _)| is_branch(name)).map(|(_, column)| column).collect();
        let known: Vec<usize> = vec![trace, circuit, sample, input, x, y];
        let is_further =
            |(name, column): &(String, usize)| !known.contains(column) && !is_branch(name) && name != "cell";
        let further = common().filter(is_further).collect();
        Ok(PointColumns { trace, circuit, sample, input, x, y, branches, further_columns: further })
    }

    /// The curves in some rows of one cell, in order of their first rows.
    ///
    /// # Errors
    /// A field that should be a number is not.
    pub fn curves(&self, rows: &[Row]) -> Result<Vec<CurveSamples>, TableError> {
        let mut curves: Vec<CurveSamples> = Vec::new();
        let mut indices: HashMap<(usize, usize), usize> = HashMap::new();
        for row in rows {
            let whole = |column, name: &str| -> Result<usize, TableError> {
                let value = row.integer(column, name)?;
                let error = |_| TableError::InvalidLine { line: row.line, reason: format!("{name} is {value}") };
                usize::try_from(value).map_err(error)
            };
            let [trace, circuit] = [whole(self.trace, "trace")?, whole(self.circuit, "circuit")?];
            let index = *indices.entry((trace, circuit)).or_insert_with(|| {
                curves.push(CurveSamples::new(trace, circuit, self));
                curves.len() - 1
            });
            let curve = &mut curves[index];
            curve.sample_numbers.push(whole(self.sample, "sample")?);
            curve.inputs.push(row.number(self.input, "input")?);
            curve.points.push(Point::new(row.number(self.x, "x")?, row.number(self.y, "y")?));
            for (column, values) in self.branches.iter().zip(&mut curve.branches) {
                values.push(row.integer(*column, "branch")?);
            }
            for ((name, column), values) in self.further_columns.iter().zip(&mut curve.further_columns) {
                values.push(row.number(*column, name)?);
            }
        }
        Ok(curves)
    }
}

/// The errors in the sample numbers of a curve.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct OrderErrors {
    /// Whether they are not ascending.
    pub is_unordered: bool,
    /// The first number that occurs more than once.
    pub duplicate: Option<usize>,
    /// The first few numbers missing between others.
    pub missing: Vec<usize>,
}

impl OrderErrors {
    /// A message for each error, except for missing samples, which the comparison of the curves reports.
    pub fn messages(&self) -> Vec<String> {
        let unordered = self.is_unordered.then(|| "the rows of its samples are not in order".to_owned());
        let duplicate = self.duplicate.map(|sample| format!("sample {sample} occurs more than once"));
        unordered.into_iter().chain(duplicate).collect()
    }
}

impl CurveSamples {
    fn new(trace: usize, circuit: usize, columns: &PointColumns) -> CurveSamples {
        CurveSamples {
            trace,
            circuit,
            sample_numbers: Vec::new(),
            inputs: Vec::new(),
            points: Vec::new(),
            branches: vec![Vec::new(); columns.branches.len()],
            further_columns: vec![Vec::new(); columns.further_columns.len()],
        }
    }

    /// Sorts the samples by number, removes duplicates, and returns the errors that were found.
    pub fn sort_samples(&mut self) -> OrderErrors {
        let is_in_order = self.sample_numbers.iter().enumerate().all(|(k, &sample)| k == sample);
        if is_in_order {
            return OrderErrors::default();
        }
        let mut order: Vec<usize> = (0..self.sample_numbers.len()).collect();
        order.sort_by_key(|&k| self.sample_numbers[k]);
        let is_unordered = order.windows(2).any(|pair| pair[0] > pair[1]);
        let duplicate = order.windows(2).find(|pair| self.sample_numbers[pair[0]] == self.sample_numbers[pair[1]]);
        let duplicate = duplicate.map(|pair| self.sample_numbers[pair[0]]);
        order.dedup_by_key(|k| self.sample_numbers[*k]);
        self.select(&order);
        /// At most this many missing samples are listed.
        const MAX_MISSING: usize = 10;
        let mut missing = Vec::new();
        let mut next = 0;
        for &sample in &self.sample_numbers {
            missing.extend((next..sample).take(MAX_MISSING - missing.len()));
            next = sample.saturating_add(1);
        }
        OrderErrors { is_unordered, duplicate, missing }
    }

    /// Keeps the samples with these indices, in this order.
    pub fn select(&mut self, order: &[usize]) {
        fn selected<T: Copy>(values: &[T], order: &[usize]) -> Vec<T> {
            order.iter().map(|&k| values[k]).collect()
        }
        self.sample_numbers = selected(&self.sample_numbers, order);
        self.inputs = selected(&self.inputs, order);
        self.points = selected(&self.points, order);
        self.branches.iter_mut().for_each(|values| *values = selected(values, order));
        self.further_columns.iter_mut().for_each(|values| *values = selected(values, order));
    }

    /// The size: the diagonal of the bounding box of the samples with finite coordinates.
    pub fn size(&self) -> f64 {
        let finite = self.points.iter().copied().filter(|p| p.x.is_finite() && p.y.is_finite());
        let diagonal = Bounds::from_points(finite).size().norm();
        if diagonal.is_finite() { diagonal } else { 0.0 }
    }

    /// The number of samples.
    pub fn len(&self) -> usize {
        self.points.len()
    }
}

/// The distance of two points: 0 if both have NaN coordinates, infinite if one of them has.
pub(super) fn point_distance(recorded: Point, current: Point) -> f64 {
    let is_nan = |p: Point| p.x.is_nan() || p.y.is_nan();
    match (is_nan(recorded), is_nan(current)) {
        (true, true) => 0.0,
        (false, false) if recorded == current => 0.0,
        (false, false) => {
            let distance = (current - recorded).norm();
            if distance.is_nan() { f64::INFINITY } else { distance }
        }
        _ => f64::INFINITY,
    }
}
