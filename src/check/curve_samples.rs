use std::collections::HashMap;

use crate::record::{Row, TableError};
use coupler_curves::geometry::{Bounds, Point};

/// A curve as the rows of `points.csv` have it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CurveSamples {
    pub trace: usize,
    pub circuit: usize,
    /// The numbers of the samples, as they are written.
    pub sample_numbers: Vec<usize>,
    pub inputs: Vec<f64>,
    pub points: Vec<Point>,
    /// The branch of the first two-valued joint, and of the further ones.
    pub branches: Vec<Vec<i64>>,
    /// The values of the further columns, column by column.
    pub further_columns: Vec<Vec<f64>>,
}

/// Where the columns of a `points.csv` are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct PointColumns {
    trace: usize,
    circuit: usize,
    sample: usize,
    input: usize,
    x: usize,
    y: usize,
    branches: Vec<usize>,
    /// The further columns that are compared, by name.
    pub further_columns: Vec<(String, usize)>,
}

impl PointColumns {
    /// Where they are in a header, of which the columns of another are to be compared.
    ///
    /// # Errors
    /// The names of columns without which nothing can be compared.
    pub fn from_header(header: &[String], expected: &[String]) -> Result<PointColumns, Vec<String>> {
        let place = |name: &str| header.iter().position(|other| other == name);
        let is_input = |name: &&String| name.starts_with("input_");
        let input = expected.iter().find(is_input).map_or("input_deg", String::as_str);
        let needed = ["trace", "circuit", "sample", input, "x", "y"];
        let missing = || needed.iter().filter(|name| place(name).is_none()).map(|name| (*name).to_owned()).collect();
        let [Some(trace), Some(circuit), Some(sample), Some(input), Some(x), Some(y)] = needed.map(place) else {
            return Err(missing());
        };
        let is_branch = |name: &str| name == "branch" || name.starts_with("branch_");
        let common = || expected.iter().filter_map(|name| Some((name.clone(), place(name)?)));
        let branches = common().filter(|(name, _)| is_branch(name)).map(|(_, at)| at).collect();
        let known: Vec<usize> = vec![trace, circuit, sample, input, x, y];
        let further = common().filter(|(name, at)| !known.contains(at) && !is_branch(name) && name != "cell").collect();
        Ok(PointColumns { trace, circuit, sample, input, x, y, branches, further_columns: further })
    }

    /// The curves of some rows of one cell, in the order in which they begin.
    ///
    /// # Errors
    /// A row that has no number where one is due.
    pub fn curves(&self, rows: &[Row]) -> Result<Vec<CurveSamples>, TableError> {
        let mut tracks: Vec<CurveSamples> = Vec::new();
        let mut places: HashMap<(usize, usize), usize> = HashMap::new();
        for row in rows {
            let whole = |column, name: &str| -> Result<usize, TableError> {
                let wrong =
                    |value: i64| TableError::InvalidLine { line: row.line, reason: format!("{name} is {value}") };
                let value = row.integer(column, name)?;
                usize::try_from(value).map_err(|_| wrong(value))
            };
            let [trace, circuit] = [whole(self.trace, "trace")?, whole(self.circuit, "circuit")?];
            let at = *places.entry((trace, circuit)).or_insert_with(|| {
                tracks.push(CurveSamples::new(trace, circuit, self));
                tracks.len() - 1
            });
            let track = &mut tracks[at];
            track.sample_numbers.push(whole(self.sample, "sample")?);
            track.inputs.push(row.number(self.input, "input")?);
            track.points.push(Point::new(row.number(self.x, "x")?, row.number(self.y, "y")?));
            for (column, values) in self.branches.iter().zip(&mut track.branches) {
                values.push(row.integer(*column, "branch")?);
            }
            for ((name, column), values) in self.further_columns.iter().zip(&mut track.further_columns) {
                values.push(row.number(*column, name)?);
            }
        }
        Ok(tracks)
    }
}

/// What is wrong with the numbers of a curve's samples.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct OrderErrors {
    /// Whether they do not rise.
    pub is_unordered: bool,
    /// The first that stands there more than once.
    pub duplicate: Option<usize>,
    /// Those that are missing between others.
    pub missing: Vec<usize>,
}

impl OrderErrors {
    /// What is wrong, in words; of samples that are missing the comparison tells.
    pub fn messages(&self) -> Vec<String> {
        let shuffled = self.is_unordered.then(|| "the rows of its samples are not in order".to_owned());
        let twice = self.duplicate.map(|sample| format!("sample {sample} stands there twice"));
        shuffled.into_iter().chain(twice).collect()
    }
}

impl CurveSamples {
    fn new(trace: usize, circuit: usize, layout: &PointColumns) -> CurveSamples {
        CurveSamples {
            trace,
            circuit,
            sample_numbers: Vec::new(),
            inputs: Vec::new(),
            points: Vec::new(),
            branches: vec![Vec::new(); layout.branches.len()],
            further_columns: vec![Vec::new(); layout.further_columns.len()],
        }
    }

    /// Puts the samples in order, each once, and tells what was wrong with them.
    pub fn sort_samples(&mut self) -> OrderErrors {
        let is_in_order = self.sample_numbers.iter().enumerate().all(|(k, &sample)| k == sample);
        if is_in_order {
            return OrderErrors::default();
        }
        let mut order: Vec<usize> = (0..self.sample_numbers.len()).collect();
        order.sort_by_key(|&k| self.sample_numbers[k]);
        let is_shuffled = order.windows(2).any(|pair| pair[0] > pair[1]);
        let twice = order.windows(2).find(|pair| self.sample_numbers[pair[0]] == self.sample_numbers[pair[1]]);
        let twice = twice.map(|pair| self.sample_numbers[pair[0]]);
        order.dedup_by_key(|k| self.sample_numbers[*k]);
        self.select(&order);
        /// So many are named.
        const MAX_MISSING: usize = 10;
        let mut missing = Vec::new();
        let mut next = 0;
        for &sample in &self.sample_numbers {
            missing.extend((next..sample).take(MAX_MISSING - missing.len()));
            next = sample.saturating_add(1);
        }
        OrderErrors { is_unordered: is_shuffled, duplicate: twice, missing }
    }

    /// The same with these of its samples, in this order.
    pub fn select(&mut self, order: &[usize]) {
        fn kept<T: Copy>(values: &[T], order: &[usize]) -> Vec<T> {
            order.iter().map(|&k| values[k]).collect()
        }
        self.sample_numbers = kept(&self.sample_numbers, order);
        self.inputs = kept(&self.inputs, order);
        self.points = kept(&self.points, order);
        self.branches.iter_mut().for_each(|values| *values = kept(values, order));
        self.further_columns.iter_mut().for_each(|values| *values = kept(values, order));
    }

    /// The diagonal of the box round it, of the samples that have a place.
    pub fn size(&self) -> f64 {
        let placed = self.points.iter().copied().filter(|p| p.x.is_finite() && p.y.is_finite());
        let diagonal = Bounds::from_points(placed).size().norm();
        if diagonal.is_finite() { diagonal } else { 0.0 }
    }

    /// The number of samples.
    pub fn len(&self) -> usize {
        self.points.len()
    }
}

/// How far two places are apart: nothing if both are none, infinitely if one of them is.
pub(super) fn point_distance(was: Point, is: Point) -> f64 {
    let is_none = |p: Point| p.x.is_nan() || p.y.is_nan();
    match (is_none(was), is_none(is)) {
        (true, true) => 0.0,
        (false, false) if was == is => 0.0,
        (false, false) => {
            let by = (is - was).norm();
            if by.is_nan() { f64::INFINITY } else { by }
        }
        _ => f64::INFINITY,
    }
}
