//! Coupler curves of many four-bars by their shape.

use super::complex::{Complex, closed_length, unit};
use super::parameters::Parameters;
use super::portion::{Stroke, Synthesis};
use super::pose::Pose;
use super::spectrum::{HARMONICS, Spectrum, Transform, directions};
use super::target::{PathKind, Target};
use crate::linkage::FourBarClass;

/// The curves of the four-bars of a fixed sequence, whose parameters fill their ranges evenly.
///
/// Curves are closed and described by their harmonics ±1 to ±10 in canonical phase, in [`Index::BYTES_PER_CURVE`] bytes.
/// The sequence has crank-rockers, drag-links and triple-rockers; rocker-cranks and double-rockers trace the curves of
/// crank-rockers (Roberts and Chebyshev).
pub struct Index {
    shapes: Vec<Shape>,
    transform: Transform,
    synthesis: Synthesis,
    directions: Vec<Complex>,
}

/// Some curves of an index.
pub struct IndexPart(Vec<Shape>);

/// The harmonics of a curve in canonical phase: those of order 1 and 2, and the others as parts of their greatest, so that the
/// small differences of curves that are nearly circles are kept.
#[derive(Clone, Copy)]
struct Shape {
    low: [i16; 8],
    high: [i8; 32],
    /// The unit of the higher harmonics.
    high_unit: f32,
    /// The squares of all harmonics but the real parts of those of odd order, and of what the harmonics leave out of the curve.
    rest: f32,
    /// The length of the curve in its sizes.
    length: u16,
    /// Whether the crank turns fully.
    is_full_turn: bool,
}

/// The units of low harmonics, which are at most 1, and of lengths.
const LOW_UNIT: f32 = 1.0 / 32_000.0;
const LENGTH_UNIT: f64 = 1.0 / 1024.0;

/// The number of poses from which a curve is computed.
pub(super) const SAMPLES: usize = 128;

/// A four-bar of the sequence on one of its circuits.
pub(super) struct Entry {
    pub linkage: Parameters,
    pub circuit: Vec<Pose>,
}

impl Index {
    /// The memory of a curve.
    pub const BYTES_PER_CURVE: usize = size_of::<Shape>();

    /// The version of the sequence and of the bytes.
    pub const VERSION: u32 = 1;

    /// The number of curves that are searched unless another one is asked for.
    pub const DEFAULT_COUNT: usize = 100_000;

    /// An index without curves.
    pub fn new() -> Index {
        Index {
            shapes: Vec::new(),
            transform: Transform::new(),
            synthesis: Synthesis::new(),
            directions: directions(SAMPLES),
        }
    }

    /// An index of the first curves of the sequence.
    pub fn with_count(count: usize) -> Index {
        let mut index = Index::new();
        index.extend(count);
        index
    }

    /// A part of an index, which can be computed on any thread.
    pub fn part(range: std::ops::Range<usize>) -> IndexPart {
        let index = Index::new();
        IndexPart(range.map(|number| index.shape(number)).collect())
    }

    /// The index of parts that follow each other from the first curve on.
    pub fn from_parts(parts: impl IntoIterator<Item = IndexPart>) -> Index {
        Index { shapes: parts.into_iter().flat_map(|IndexPart(shapes)| shapes).collect(), ..Index::new() }
    }

    /// The curves as bytes, [`Index::BYTES_PER_CURVE`] for each, the same on every machine.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.shapes.iter().flat_map(|shape| shape.to_bytes()).collect()
    }

    /// The index with these bytes; `None` if they are not a whole number of curves. They must be those of an index of this
    /// [`Index::VERSION`].
    pub fn from_bytes(bytes: &[u8]) -> Option<Index> {
        let (shapes, []) = bytes.as_chunks() else { return None };
        Some(Index { shapes: shapes.iter().map(Shape::from_bytes).collect(), ..Index::new() })
    }

    /// Adds the next curves of the sequence; the order in which an index grows does not change it.
    pub fn extend(&mut self, count: usize) {
        self.shapes.reserve(count);
        for number in self.shapes.len()..self.shapes.len() + count {
            let shape = self.shape(number);
            self.shapes.push(shape);
        }
    }

    /// The number of curves.
    pub fn len(&self) -> usize {
        self.shapes.len()
    }

    /// Whether it has no curves.
    pub fn is_empty(&self) -> bool {
        self.shapes.is_empty()
    }

    /// The numbers of the curves that are most like a closed target, or of those with a portion that is most like an open one; at
    /// most `most`, the likeliest first. Of closed ones the harmonics are compared in canonical phase only.
    pub fn most_alike(&self, target: &Target, full_turn: bool, most: usize) -> Vec<usize> {
        let points = target.normalized();
        let found = match target.kind() {
            PathKind::Closed => {
                let (spectrum, ..) = self.transform.spectrum(&points);
                let query = (&spectrum, target.polyline_length(), full_turn);
                self.nearest(query, 0..self.len(), Vec::new(), most)
            }
            PathKind::Open | PathKind::Part => {
                self.nearest_portions((&Stroke::new(&points), full_turn), 0..self.len(), Vec::new(), most)
            }
        };
        found.into_iter().map(|(_, number)| number).collect()
    }

    /// How much a curve is like a closed target, up to 1 for similar curves: the greatest correlation of their harmonics over all
    /// starts, directions and reflections. `None` if the index has no such curve.
    pub fn likeness(&self, target: &Target, number: usize) -> Option<f64> {
        let (spectrum, ..) = self.transform.spectrum(&target.normalized());
        let (curve, ..) = self.spectrum(&self.entry(number).filter(|_| number < self.len())?);
        Some(self.transform.likeness(&spectrum, &curve).value)
    }

    /// The transform of spectra.
    pub(super) fn transform(&self) -> &Transform {
        &self.transform
    }

    /// A four-bar of the sequence.
    pub(super) fn entry(&self, number: usize) -> Option<Entry> {
        let linkage = four_bar_of_sequence(number);
        let mut circuits = linkage.circuits(&self.directions);
        // Of two circuits, each in turn.
        let place = (number / CLASSES).checked_rem(circuits.len())?;
        let circuit = circuits.swap_remove(place);
        (circuit.len() > SAMPLES / 2).then_some(Entry { linkage, circuit })
    }

    /// The spectrum of a curve, with its centroid, its size, and its length in sizes.
    pub(super) fn spectrum(&self, entry: &Entry) -> (Spectrum, Complex, f64, f64) {
        let points = entry.linkage.curve(&entry.circuit);
        let (spectrum, centre, size) = self.transform.spectrum(&points);
        (spectrum, centre, size, closed_length(&points) / size)
    }

    fn shape(&self, number: usize) -> Shape {
        let Some(entry) = self.entry(number) else { return Shape::EMPTY };
        let (spectrum, _, _, length) = self.spectrum(&entry);
        Shape::new(&spectrum.canonical(), length, entry.linkage.is_full_turn())
    }

    /// The curves of a range that are most like a target in canonical phase, at most `most` with those that are given, the
    /// best first: their correlation, and their numbers. The length is that of the target in its sizes.
    pub(super) fn nearest(
        &self,
        (target, length, full_turn): (&Spectrum, f64, bool),
        range: std::ops::Range<usize>,
        best: Vec<(f32, usize)>,
        most: usize,
    ) -> Vec<(f32, usize)> {
        let shape = Shape::new(&target.canonical(), length, true);
        let lengths = [MIN_LENGTH, MAX_LENGTH].map(|part| length_units(part * length));
        self.best_of(range, best, most, |other| {
            let is_candidate = (lengths[0]..=lengths[1]).contains(&other.length) && (other.is_full_turn || !full_turn);
            is_candidate.then(|| -shape.square_distance(other))
        })
    }

    /// The curves of a range of which a portion is most like a stroke, at most `most` with those that are given, the best first:
    /// how much, and their numbers.
    pub(super) fn nearest_portions(
        &self,
        (stroke, full_turn): (&Stroke, bool),
        range: std::ops::Range<usize>,
        best: Vec<(f32, usize)>,
        most: usize,
    ) -> Vec<(f32, usize)> {
        self.best_of(range, best, most, |shape| {
            if shape.length == 0 || (full_turn && !shape.is_full_turn) {
                return None;
            }
            let length = f32::from(shape.length) * LENGTH_UNIT as f32;
            let window = self.synthesis.best_window(&shape.harmonics(), length, stroke)?;
            Some(-window.residual)
        })
    }

    /// The shapes of a range with the greatest likeness, at most `most` with those that are given, the best first.
    fn best_of(
        &self,
        range: std::ops::Range<usize>,
        mut best: Vec<(f32, usize)>,
        most: usize,
        likeness: impl Fn(&Shape) -> Option<f32>,
    ) -> Vec<(f32, usize)> {
        let mut least = f32::NEG_INFINITY;
        for number in range.start..range.end.min(self.shapes.len()) {
            let Some(likeness) = likeness(&self.shapes[number]).filter(|likeness| *likeness > least) else { continue };
            best.push((likeness, number));
            if best.len() >= 2 * most {
                least = keep_best(&mut best, most);
            }
        }
        keep_best(&mut best, most);
        best
    }
}

impl Default for Index {
    fn default() -> Index {
        Index::new()
    }
}

/// The parts of the target's length that a curve may have before it is refined; refining changes it.
const MIN_LENGTH: f64 = 0.6;
const MAX_LENGTH: f64 = 1.6;

/// Keeps the best, in order; the least of them, if they are as many as that.
fn keep_best(best: &mut Vec<(f32, usize)>, most: usize) -> f32 {
    best.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    best.truncate(most);
    if best.len() == most { best[most - 1].0 } else { f32::NEG_INFINITY }
}

/// A length in its units; of one that is longer than can be stored, the longest.
fn length_units(length: f64) -> u16 {
    (length / LENGTH_UNIT).min(f64::from(u16::MAX)) as u16
}

impl Shape {
    /// Of a number without a curve.
    const EMPTY: Shape =
        Shape { low: [0; 8], high: [0; 32], high_unit: 0.0, rest: 0.0, length: 0, is_full_turn: false };

    /// The harmonics of the parts, odd orders before even ones: 1, -1, 2, -2; then ±3, ±5, ±7, ±9 and ±4, ±6, ±8, ±10.
    const LOW: [usize; 4] = [0, HARMONICS, 1, HARMONICS + 1];
    const HIGH: [usize; 16] = [
        2,
        HARMONICS + 2,
        4,
        HARMONICS + 4,
        6,
        HARMONICS + 6,
        8,
        HARMONICS + 8,
        3,
        HARMONICS + 3,
        5,
        HARMONICS + 5,
        7,
        HARMONICS + 7,
        9,
        HARMONICS + 9,
    ];

    fn new(canonical: &Spectrum, length: f64, is_full_turn: bool) -> Shape {
        let Spectrum(harmonics) = canonical;
        let high = Shape::HIGH.map(|k| harmonics[k]);
        let greatest = high.iter().map(|z| z.re.abs().max(z.im.abs())).fold(0.0, f64::max);
        let high_unit = (greatest / 127.0) as f32;
        let mut shape = Shape { length: length_units(length), high_unit, is_full_turn, ..Shape::EMPTY };
        let low = |value: f64| (value / f64::from(LOW_UNIT)).round() as i16;
        let in_units = |value: f64| (value / f64::from(high_unit).max(f64::MIN_POSITIVE)).round() as i8;
        // Real parts before imaginary parts.
        for (slot, harmonic) in Shape::LOW.into_iter().enumerate() {
            (shape.low[slot], shape.low[4 + slot]) = (low(harmonics[harmonic].re), low(harmonics[harmonic].im));
        }
        for (slot, z) in high.into_iter().enumerate() {
            (shape.high[slot], shape.high[16 + slot]) = (in_units(z.re), in_units(z.im));
        }
        let left_out = 1.0 - harmonics.iter().map(|z| z.norm_sqr()).sum::<f64>();
        shape.rest = left_out as f32 + (1..4).map(|part| shape.product(&shape, part)).sum::<f32>();
        shape
    }

    fn to_bytes(self) -> [u8; Index::BYTES_PER_CURVE] {
        let low = self.low.iter().flat_map(|value| value.to_le_bytes());
        let high = self.high.iter().flat_map(|value| value.to_le_bytes());
        let units = [self.high_unit, self.rest].into_iter().flat_map(f32::to_le_bytes);
        let rest = self.length.to_le_bytes().into_iter().chain([u8::from(self.is_full_turn), 0]);
        let mut bytes = low.chain(high).chain(units).chain(rest);
        std::array::from_fn(|_| bytes.next().unwrap_or_default())
    }

    fn from_bytes(bytes: &[u8; Index::BYTES_PER_CURVE]) -> Shape {
        let (low, rest) = bytes.split_at(16);
        let (high, rest) = rest.split_at(32);
        let mut next = rest.as_chunks::<4>().0.iter().copied();
        let mut next = || next.next().unwrap_or_default();
        let mut shape =
            Shape { high_unit: f32::from_le_bytes(next()), rest: f32::from_le_bytes(next()), ..Shape::EMPTY };
        let [length, after, is_full_turn, _] = next();
        shape.length = u16::from_le_bytes([length, after]);
        shape.is_full_turn = is_full_turn != 0;
        shape.low.iter_mut().zip(low.as_chunks().0).for_each(|(value, bytes)| *value = i16::from_le_bytes(*bytes));
        shape.high.iter_mut().zip(high).for_each(|(value, byte)| *value = byte.cast_signed());
        shape
    }

    /// The harmonics of order 1 to 10, then -1 to -10.
    fn harmonics(&self) -> [[f32; 2]; 2 * HARMONICS] {
        let mut harmonics = [[0.0; 2]; 2 * HARMONICS];
        for (slot, k) in Shape::LOW.into_iter().enumerate() {
            harmonics[k] = [self.low[slot], self.low[4 + slot]].map(|value| f32::from(value) * LOW_UNIT);
        }
        for (slot, k) in Shape::HIGH.into_iter().enumerate() {
            harmonics[k] = [self.high[slot], self.high[16 + slot]].map(|value| f32::from(value) * self.high_unit);
        }
        harmonics
    }

    /// The harmonics of a part: the real parts of odd orders, of even orders, and the imaginary parts of both.
    fn part(&self, part: usize) -> (&[i16; 2], &[i8; 8]) {
        let (low, high) = (self.low.as_chunks().0, self.high.as_chunks().0);
        (&low[part], &high[part])
    }

    /// The sum of the products of a part with that of another shape.
    fn product(&self, other: &Shape, part: usize) -> f32 {
        let ((low, high), (other_low, other_high)) = (self.part(part), other.part(part));
        let low: f32 = low.iter().zip(other_low).map(|(a, b)| f32::from(*a) * f32::from(*b)).sum();
        let high: i32 = high.iter().zip(other_high).map(|(a, b)| i32::from(*a) * i32::from(*b)).sum();
        low * (LOW_UNIT * LOW_UNIT) + high as f32 * (self.high_unit * other.high_unit)
    }

    /// The square of the distance to another shape: the least of those in the same phase, with the other one from the opposite
    /// start, and with the mirror images of both.
    fn square_distance(&self, other: &Shape) -> f32 {
        let ((low, high), (other_low, other_high)) = (self.part(0), other.part(0));
        // The greatest harmonics are in the part that never changes its sign; its differences are exact.
        let low: f32 =
            low.iter().zip(other_low).map(|(a, b)| (f32::from(*a) - f32::from(*b)) * LOW_UNIT).map(|d| d * d).sum();
        let difference = |(a, b): (&i8, &i8)| f32::from(*a) * self.high_unit - f32::from(*b) * other.high_unit;
        let high: f32 = high.iter().zip(other_high).map(difference).map(|d| d * d).sum();
        let [even, odd_across, even_across] = [1, 2, 3].map(|part| self.product(other, part));
        let same = even + (odd_across + even_across).abs();
        let opposite = (odd_across - even_across).abs() - even;
        low + high + self.rest + other.rest - 2.0 * same.max(opposite)
    }
}

/// The classes of the sequence come in turn: two crank-rockers, a drag-link, a triple-rocker.
const CLASSES: usize = 4;

/// The orders of four links.
const PERMUTATIONS: [[usize; 4]; 24] = [
    [0, 1, 2, 3],
    [0, 1, 3, 2],
    [0, 2, 1, 3],
    [0, 2, 3, 1],
    [0, 3, 1, 2],
    [0, 3, 2, 1],
    [1, 0, 2, 3],
    [1, 0, 3, 2],
    [1, 2, 0, 3],
    [1, 2, 3, 0],
    [1, 3, 0, 2],
    [1, 3, 2, 0],
    [2, 0, 1, 3],
    [2, 0, 3, 1],
    [2, 1, 0, 3],
    [2, 1, 3, 0],
    [2, 3, 0, 1],
    [2, 3, 1, 0],
    [3, 0, 1, 2],
    [3, 0, 2, 1],
    [3, 1, 0, 2],
    [3, 1, 2, 0],
    [3, 2, 0, 1],
    [3, 2, 1, 0],
];

/// A four-bar of the sequence, with its crank's pivot at the origin.
///
/// Five numbers of the additive recurrence of Roberts (the powers of the inverse of the real root of x^6 = x + 1), which
/// fills the unit cube evenly, are the slacks in Grashof's condition and the place of the coupler point.
fn four_bar_of_sequence(number: usize) -> Parameters {
    const ROOT: f64 = 1.167_303_978_261_418_7;
    let mut power = 1.0;
    let [a, b, c, r, angle]: [f64; 5] = std::array::from_fn(|_| {
        power /= ROOT;
        (0.5 + power * (number as f64 + 1.0)).fract()
    });
    // From 0 to 50 times the shortest link, half of them less than it.
    let slack = |u: f64| u / (1.02 - u);
    let (x, y, z) = (slack(a), slack(b), slack(c));
    let class = match number % CLASSES {
        0 | 1 => FourBarClass::CrankRocker,
        2 => FourBarClass::DragLink,
        _ => FourBarClass::TripleRocker,
    };
    let [frame, crank, coupler, rocker] = match class {
        // The shortest link is 1, and the slacks of the three conditions that it turns fully are x, y and z.
        FourBarClass::CrankRocker => [1.0 + 0.5 * (y + z), 1.0, 1.0 + 0.5 * (x + z), 1.0 + 0.5 * (x + y)],
        FourBarClass::DragLink => [1.0, 1.0 + 0.5 * (y + z), 1.0 + 0.5 * (x + z), 1.0 + 0.5 * (x + y)],
        // The longest link is longer than Grashof's condition allows, and shorter than the three others together.
        _ => {
            let lengths = [1.0, 1.0 + x, 1.0 + x + y, 1.0 + 2.0 * x + y + 2.0 * c];
            let order = PERMUTATIONS[(number / CLASSES) % PERMUTATIONS.len()];
            order.map(|place| lengths[place])
        }
    };
    let reach = 0.05 + 1.2 * r / (1.1 - r);
    let size = 0.7 * coupler.max(crank.min(frame));
    let point = Complex::new(0.5 * coupler, 0.0) + unit(std::f64::consts::TAU * angle) * (reach * size);
    Parameters {
        crank_pivot: Complex::new(0.0, 0.0),
        direction: Complex::new(1.0, 0.0),
        frame,
        crank,
        coupler,
        rocker,
        point,
    }
}
