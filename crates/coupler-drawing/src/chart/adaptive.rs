//! Adaptive sampling of quantities between two neighbouring cells of a chart.
//!
//! An interval of the parameter is halved where a line through the samples deviates most from the sample in the middle,
//! until no line deviates by more than [`TOLERANCE`]. All quantities of all lines are sampled at the same places,
//! because a place costs as much as a solved cell, however many quantities are read off it.

/// The greatest deviation of a chord from the sample in its middle, as a fraction of the axis. The line that is drawn
/// also goes through that sample, and deviates from a smooth quantity by a quarter of this, 0.05 mm on an axis of 400 mm,
/// the longest on tabloid paper, where lines are 0.5 mm wide and no bend can be seen between two chords.
const TOLERANCE: f64 = 1.0 / 2000.0;

/// How often an interval is halved: a change that is not smaller after 2^-20 of a step between cells is a jump.
const MAX_DEPTH: u32 = 20;

/// The smallest jump that is shown, as a fraction of the axis: about the width of a line on most charts. Smaller steps,
/// such as between two portions of a curve that are equal but for rounding, are not followed below [`EARLY_DEPTH`].
const SMALLEST_JUMP: f64 = 1.0 / 200.0;

/// The depth at which a change is compared with those further down.
const EARLY_DEPTH: u32 = 10;

/// The depth from which a part is recognised as a jump, if samples do not suffice for [`MAX_DEPTH`]: from
/// [`EARLY_DEPTH`] to here a square root shrinks to a quarter, and a cube root to two fifths.
const LEAST_JUMP_DEPTH: u32 = 14;

/// Every interval is halved this often, so that a line that happens to pass through the sample in the middle is found
/// out.
const MIN_DEPTH: u32 = 1;

/// Values further than this from the axis, in lengths of it, are all alike: the sides of a pole are drawn no better.
const REACH: f64 = 4.0;

/// A value of a quantity and its x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ChartPoint {
    /// x and y; y is NaN where the quantity has no value.
    pub value: [f64; 2],
    /// Their positions along the axes, from 0 to 1 on the axis; y is NaN where it cannot be drawn.
    pub place: [f64; 2],
}

impl ChartPoint {
    pub fn is_drawable(&self) -> bool {
        !self.place[1].is_nan()
    }

    /// The height, within [`REACH`] of the axis.
    fn height(&self) -> f64 {
        self.place[1].clamp(-REACH, 1.0 + REACH)
    }
}

/// The points of all quantities at a value of the parameter.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sample {
    pub parameter: f64,
    pub points: Vec<ChartPoint>,
}

/// A part of an interval, with the indices of the samples at its start, middle and end.
#[derive(Clone, Debug)]
struct Part {
    samples: [usize; 3],
    depth: u32,
    /// The greatest steps of the quantities in its ancestor at [`EARLY_DEPTH`]; empty above it.
    early_changes: Vec<f64>,
    /// The greatest deviation of a line, as a fraction of the axis.
    deviation: f64,
    /// The greatest step of a quantity between its samples, as a fraction of the axis.
    change: f64,
}

impl Part {
    fn is_finished(&self) -> bool {
        self.depth >= MAX_DEPTH
            || (self.depth >= EARLY_DEPTH && self.change < SMALLEST_JUMP)
            || (self.depth >= MIN_DEPTH && self.deviation <= TOLERANCE)
    }
}

/// An interval of a parameter, sampled where the quantities are not straight lines over x.
#[derive(Clone, Debug)]
pub(super) struct AdaptiveInterval {
    /// The samples, in the order of their evaluation; the first two are those at the ends.
    samples: Vec<Sample>,
    /// Its parts, in no order; empty before the first evaluation.
    parts: Vec<Part>,
}

impl AdaptiveInterval {
    /// The interval between two samples, which have the same quantities.
    pub fn new(from: Sample, to: Sample) -> AdaptiveInterval {
        AdaptiveInterval { samples: vec![from, to], parts: Vec::new() }
    }

    /// Whether further samples would not change its lines.
    pub fn is_finished(&self) -> bool {
        !self.parts.is_empty() && self.parts.iter().all(Part::is_finished)
    }

    /// The number of samples between its ends.
    pub fn additional_count(&self) -> usize {
        self.samples.len() - 2
    }

    /// Adds at most `limit` samples where the lines deviate most.
    pub fn refine(&mut self, limit: usize, evaluate: impl Fn(f64) -> Sample) {
        let most = self.samples.len() + limit;
        if self.parts.is_empty() && limit > 0 {
            let root = self.part([0, 1], 0, Vec::new(), &evaluate);
            self.parts.push(root);
        }
        while self.samples.len() + 2 <= most {
            // A jump is first found everywhere, and then followed to its place. Of equal deviations the first is taken.
            let priority = |k: usize| (self.parts[k].depth < LEAST_JUMP_DEPTH, self.parts[k].deviation);
            let unfinished = (0..self.parts.len()).filter(|&k| !self.parts[k].is_finished());
            let worst = unfinished.reduce(|a, b| if priority(b) > priority(a) { b } else { a });
            let Some(worst) = worst else { break };
            let Part { samples: [from, middle, to], depth, early_changes, .. } = self.parts.swap_remove(worst);
            for ends in [[from, middle], [middle, to]] {
                let part = self.part(ends, depth + 1, early_changes.clone(), &evaluate);
                self.parts.push(part);
            }
        }
    }

    /// The part between two samples, with a new one in its middle.
    fn part(
        &mut self,
        [from, to]: [usize; 2],
        depth: u32,
        mut early_changes: Vec<f64>,
        evaluate: &impl Fn(f64) -> Sample,
    ) -> Part {
        let [start, end] = [from, to].map(|k| self.samples[k].parameter);
        let middle = self.samples.len();
        self.samples.push(evaluate(start + (end - start) / 2.0));
        let [from_points, middle_points, to_points] = [from, middle, to].map(|k| &self.samples[k].points);
        let triples = from_points.iter().zip(middle_points).zip(to_points).map(|((a, middle), b)| [a, middle, b]);
        let changes = triples.clone().map(greatest_step);
        let change = changes.clone().fold(0.0, f64::max);
        if depth == EARLY_DEPTH {
            early_changes = changes.collect();
        }
        let deviation = triples.map(chord_deviation).fold(0.0, f64::max);
        Part { samples: [from, middle, to], depth, early_changes, deviation, change }
    }

    /// The values of a quantity between the ends, in order, with a NaN for each gap.
    ///
    /// If the quantity ceases right at an end, which is an exception in its neighbourhood, the whole interval is a gap: it
    /// would be too narrow to be seen.
    pub fn path(&self, quantity: usize) -> Vec<ChartPoint> {
        let point = |sample: usize| self.samples[sample].points[quantity];
        let gap = |at: ChartPoint| ChartPoint { value: [at.value[0], f64::NAN], place: [at.place[0], f64::NAN] };
        let parts = self.ordered_parts();
        // Without further samples, a missing end is a gap by itself.
        let (Some(first), Some(last)) = (parts.first(), parts.last()) else { return Vec::new() };
        let neighbours = [(0, first.samples[1]), (1, last.samples[1])];
        if neighbours.into_iter().any(|(end, next)| !point(end).is_drawable() && point(next).is_drawable()) {
            return vec![gap(point(first.samples[1]))];
        }
        let mut path = Vec::with_capacity(2 * parts.len());
        for part in parts {
            let [from, middle, _] = part.samples;
            path.extend((from > 0).then(|| point(from)));
            path.push(if self.is_jump(part, quantity) { gap(point(middle)) } else { point(middle) });
        }
        path
    }

    /// The parts from the first end to the second; the parameter may ascend or descend.
    fn ordered_parts(&self) -> Vec<&Part> {
        let start = |part: &Part| self.samples[part.samples[0]].parameter;
        let mut parts: Vec<&Part> = self.parts.iter().collect();
        parts.sort_by(|a, b| start(a).total_cmp(&start(b)));
        if self.samples[0].parameter > self.samples[1].parameter {
            parts.reverse();
        }
        parts
    }

    /// Whether a quantity jumps within a part: halving the interval further does not make its change smaller.
    fn is_jump(&self, part: &Part, quantity: usize) -> bool {
        let change = greatest_step(part.samples.map(|k| &self.samples[k].points[quantity]));
        let early = part.early_changes.get(quantity);
        part.depth >= LEAST_JUMP_DEPTH && change >= SMALLEST_JUMP && early.is_some_and(|early| change > 0.5 * early)
    }
}

/// The greater change of height between neighbouring points: a quantity may change and change back.
fn greatest_step([a, middle, b]: [&ChartPoint; 3]) -> f64 {
    (a.height() - middle.height()).abs().max((middle.height() - b.height()).abs())
}

/// How far a chord is above or below the point in the middle; where the quantity begins or ceases between them, their
/// distance along x.
fn chord_deviation([a, middle, b]: [&ChartPoint; 3]) -> f64 {
    let width = b.place[0] - a.place[0];
    match [a, middle, b].map(ChartPoint::is_drawable) {
        [true, true, true] => {
            let along = (middle.place[0] - a.place[0]) / width;
            let along = if along.is_finite() { along } else { 0.5 };
            (middle.height() - (a.height() + along * (b.height() - a.height()))).abs()
        }
        [false, false, false] => 0.0,
        _ => width.abs(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::geometry::trig;

    /// Functions from 0..1 to 0..1 as quantities over the parameter.
    fn refined(ends: [f64; 2], limit: usize, functions: &[fn(f64) -> f64]) -> AdaptiveInterval {
        let evaluate = |x: f64| {
            let point = |function: &fn(f64) -> f64| ChartPoint { value: [x, function(x)], place: [x, function(x)] };
            Sample { parameter: x, points: functions.iter().map(point).collect() }
        };
        let mut interval = AdaptiveInterval::new(evaluate(ends[0]), evaluate(ends[1]));
        interval.refine(limit, evaluate);
        interval
    }

    /// The whole line of a function, with its ends.
    fn line(ends: [f64; 2], function: fn(f64) -> f64) -> Vec<[f64; 2]> {
        let interval = refined(ends, 1000, &[function]);
        assert!(interval.is_finished(), "{} samples", interval.samples.len());
        let mut line = vec![interval.samples[0].points[0].value];
        line.extend(interval.path(0).iter().map(|point| point.value));
        line.push(interval.samples[1].points[0].value);
        line
    }

    /// The greatest vertical distance of a line from its function.
    fn deviation(line: &[[f64; 2]], function: fn(f64) -> f64) -> f64 {
        let pairs = line.windows(2).filter(|pair| pair.iter().all(|[_, y]| !y.is_nan()));
        let places = pairs.flat_map(|pair| (0..=50).map(move |k| (pair, f64::from(k) / 50.0)));
        let deviation = |(pair, part): (&[[f64; 2]], f64)| {
            let [x, y] = [0, 1].map(|k| pair[0][k] + part * (pair[1][k] - pair[0][k]));
            (function(x) - y).abs()
        };
        places.map(deviation).fold(0.0, f64::max)
    }

    #[test]
    fn lines_follow_their_functions() {
        let functions: [fn(f64) -> f64; 6] = [
            |x| x * (1.0 - x) * 4.0,
            |x| 0.5 + 0.5 * trig::sin(12.0 * x),
            // A peak between the ends, a kink, and a peak of a tenth of the width.
            |x| 1e-3 / (1e-3 + (x - 0.617) * (x - 0.617)),
            |x| 1.0 - 2.0 * (x - 0.311).abs(),
            |x| (1.0 - 20.0 * (x - 0.75).abs()).max(0.0),
            |x| x.sqrt(),
        ];
        for (k, function) in functions.into_iter().enumerate() {
            for ends in [[0.0, 1.0], [1.0, 0.0]] {
                let line = line(ends, function);
                // Steep kinks and roots are found to the smallest step that is followed.
                let most = if k >= 4 { 0.5 * SMALLEST_JUMP } else { TOLERANCE };
                assert!(deviation(&line, function) < most, "{k}: {}", deviation(&line, function));
                assert!(line.windows(2).all(|pair| (pair[0][0] < pair[1][0]) == (ends[0] < ends[1])), "{k}");
                assert!(line.len() < 400, "{k}: {}", line.len());
            }
        }
        assert_eq!(line([0.0, 1.0], |x| 1.0 - x).len(), 5, "a straight line needs the least number of samples");
    }

    /// The x on both sides of each gap.
    fn gaps(line: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let is_gap = |triple: &&[[f64; 2]]| triple[1][1].is_nan();
        line.windows(3).filter(is_gap).map(|triple| [triple[0][0], triple[2][0]]).collect()
    }

    #[test]
    fn a_jump_is_a_gap_and_a_steep_rise_is_none() {
        let step = |x: f64| if x < 0.3 { 0.2 * x } else { 0.9 + 0.1 * x };
        let found = gaps(&line([0.0, 1.0], step));
        let [[left, right]] = found[..] else { panic!("{found:?}") };
        assert!(left < 0.3 && 0.3 <= right && right - left < 1e-5, "{left} {right}");
        let pole = gaps(&line([0.0, 1.0], |x| 0.02 / (x - 0.42)));
        assert!(pole.len() == 1 && (pole[0][0] - 0.42).abs() < 1e-5);
        assert!(gaps(&line([0.0, 1.0], |x| if x < 0.3 { 0.5 } else { 0.504 })).is_empty(), "too small to be seen");
        assert!(gaps(&line([0.0, 1.0], |x| trig::pow((x - 0.37).abs(), 1.0 / 3.0).copysign(x - 0.37))).is_empty());
    }

    /// Near a tie of two portions, rounding may select either.
    #[test]
    fn a_jump_that_flickers_is_not_joined() {
        let flicker = |x: f64| {
            let is_high = x > 0.40002 || (x > 0.4 && ((x * 1e9) as u64).is_multiple_of(3));
            if is_high { 0.8 } else { 0.3 }
        };
        let interval = refined([0.0, 1.0], 255, &[flicker]);
        let path = interval.path(0);
        let joined = path.windows(2).filter(|pair| (pair[0].value[1] - pair[1].value[1]).abs() > 0.1);
        assert_eq!(joined.count(), 0);
    }

    #[test]
    fn a_line_is_drawn_up_to_where_its_quantity_ceases() {
        let root = line([0.0, 1.0], |x| (0.6 - x).sqrt());
        let last = root.iter().rfind(|[_, y]| !y.is_nan()).unwrap();
        assert!(last[0] <= 0.6 && last[0] > 0.6 - 2.0 * TOLERANCE, "{last:?}");
        // A value that is missing at an end alone leaves the interval open.
        let hole = line([0.0, 1.0], |x| if x == 1.0 { f64::NAN } else { x });
        assert_eq!(hole.iter().filter(|[_, y]| !y.is_nan()).count(), 1, "{hole:?}");
    }

    #[test]
    fn samples_are_limited_and_shared_by_the_quantities() {
        let waves: [fn(f64) -> f64; 2] = [|x| trig::sin(300.0 * x), |x| x];
        for limit in [0, 1, 2, 3, 10, 57] {
            let interval = refined([0.0, 1.0], limit, &waves);
            assert!(interval.samples.len() <= 2 + limit && !interval.is_finished(), "{limit}");
            assert_eq!(interval.path(0).len(), interval.path(1).len());
        }
        // Two rounds continue one another.
        let mut interval = refined([0.0, 1.0], 3, &[|x| x * x]);
        let known = interval.samples.clone();
        interval.refine(100, |x| Sample {
            parameter: x,
            points: vec![ChartPoint { value: [x, x * x], place: [x, x * x] }],
        });
        assert!(interval.is_finished() && interval.samples.starts_with(&known));
    }
}
