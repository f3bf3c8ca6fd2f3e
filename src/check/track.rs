use std::collections::HashMap;

use crate::record::{Flaw, Row};
use coupler_curves::geometry::{Bounds, Point};

/// A curve as the rows of `points.csv` have it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Track {
    pub trace: usize,
    pub circuit: usize,
    /// The numbers of the samples, as they are written.
    pub samples: Vec<usize>,
    pub input: Vec<f64>,
    pub points: Vec<Point>,
    /// The branch of the first two-valued joint, and of the further ones.
    pub branches: Vec<Vec<i64>>,
    /// The values of the further columns, column by column.
    pub further: Vec<Vec<f64>>,
}

/// Where the columns of a `points.csv` are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    trace: usize,
    circuit: usize,
    sample: usize,
    input: usize,
    x: usize,
    y: usize,
    branches: Vec<usize>,
    /// The further columns that are compared, by name.
    pub further: Vec<(String, usize)>,
}

impl Layout {
    /// Where they are in a header, of which the columns of another are to be compared.
    ///
    /// # Errors
    /// The names of columns without which nothing can be compared.
    pub fn of(header: &[String], expected: &[String]) -> Result<Layout, Vec<String>> {
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
        Ok(Layout { trace, circuit, sample, input, x, y, branches, further })
    }

    /// The curves of some rows of one cell, in the order in which they begin.
    ///
    /// # Errors
    /// A row that has no number where one is due.
    pub fn tracks(&self, rows: &[Row]) -> Result<Vec<Track>, Flaw> {
        let mut tracks: Vec<Track> = Vec::new();
        let mut places: HashMap<(usize, usize), usize> = HashMap::new();
        for row in rows {
            let whole = |column, name: &str| -> Result<usize, Flaw> {
                let wrong = |value: i64| Flaw::Line { line: row.line, wrong: format!("{name} is {value}") };
                let value = row.whole(column, name)?;
                usize::try_from(value).map_err(|_| wrong(value))
            };
            let [trace, circuit] = [whole(self.trace, "trace")?, whole(self.circuit, "circuit")?];
            let at = *places.entry((trace, circuit)).or_insert_with(|| {
                tracks.push(Track::new(trace, circuit, self));
                tracks.len() - 1
            });
            let track = &mut tracks[at];
            track.samples.push(whole(self.sample, "sample")?);
            track.input.push(row.number(self.input, "input")?);
            track.points.push(Point::new(row.number(self.x, "x")?, row.number(self.y, "y")?));
            for (column, values) in self.branches.iter().zip(&mut track.branches) {
                values.push(row.whole(*column, "branch")?);
            }
            for ((name, column), values) in self.further.iter().zip(&mut track.further) {
                values.push(row.number(*column, name)?);
            }
        }
        Ok(tracks)
    }
}

/// What is wrong with the numbers of a curve's samples.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Disorder {
    /// Whether they do not rise.
    pub is_shuffled: bool,
    /// The first that stands there more than once.
    pub twice: Option<usize>,
    /// Those that are missing between others.
    pub missing: Vec<usize>,
}

impl Disorder {
    /// What is wrong, in words; of samples that are missing the comparison tells.
    pub fn wrongs(&self) -> Vec<String> {
        let shuffled = self.is_shuffled.then(|| "the rows of its samples are not in order".to_owned());
        let twice = self.twice.map(|sample| format!("sample {sample} stands there twice"));
        shuffled.into_iter().chain(twice).collect()
    }
}

impl Track {
    fn new(trace: usize, circuit: usize, layout: &Layout) -> Track {
        Track {
            trace,
            circuit,
            samples: Vec::new(),
            input: Vec::new(),
            points: Vec::new(),
            branches: vec![Vec::new(); layout.branches.len()],
            further: vec![Vec::new(); layout.further.len()],
        }
    }

    /// Puts the samples in order, each once, and tells what was wrong with them.
    pub fn put_in_order(&mut self) -> Disorder {
        let is_in_order = self.samples.iter().enumerate().all(|(k, &sample)| k == sample);
        if is_in_order {
            return Disorder::default();
        }
        let mut order: Vec<usize> = (0..self.samples.len()).collect();
        order.sort_by_key(|&k| self.samples[k]);
        let is_shuffled = order.windows(2).any(|pair| pair[0] > pair[1]);
        let twice = order.windows(2).find(|pair| self.samples[pair[0]] == self.samples[pair[1]]);
        let twice = twice.map(|pair| self.samples[pair[0]]);
        order.dedup_by_key(|k| self.samples[*k]);
        self.keep(&order);
        /// So many are named.
        const NAMED: usize = 10;
        let mut missing = Vec::new();
        let mut next = 0;
        for &sample in &self.samples {
            missing.extend((next..sample).take(NAMED - missing.len()));
            next = sample.saturating_add(1);
        }
        Disorder { is_shuffled, twice, missing }
    }

    /// The same with these of its samples, in this order.
    pub fn keep(&mut self, order: &[usize]) {
        fn kept<T: Copy>(values: &[T], order: &[usize]) -> Vec<T> {
            order.iter().map(|&k| values[k]).collect()
        }
        self.samples = kept(&self.samples, order);
        self.input = kept(&self.input, order);
        self.points = kept(&self.points, order);
        self.branches.iter_mut().for_each(|values| *values = kept(values, order));
        self.further.iter_mut().for_each(|values| *values = kept(values, order));
    }

    /// The diagonal of the box round it, of the samples that have a place.
    pub fn size(&self) -> f64 {
        let placed = self.points.iter().copied().filter(|p| p.x.is_finite() && p.y.is_finite());
        let diagonal = Bounds::of(placed).size().norm();
        if diagonal.is_finite() { diagonal } else { 0.0 }
    }

    /// The number of samples.
    pub fn len(&self) -> usize {
        self.points.len()
    }
}

/// How far two places are apart: nothing if both are none, infinitely if one of them is.
pub(super) fn distance(was: Point, is: Point) -> f64 {
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
