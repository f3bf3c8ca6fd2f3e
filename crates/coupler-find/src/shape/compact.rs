//! The shapes of curves in few bytes, and those of them that are most like another one.

use std::ops::Range;

use crate::shape::best::Best;
use crate::shape::spectrum::{HARMONICS, Spectrum};
use crate::shape::stroke::Stroke;
use crate::shape::synthesis::Synthesis;

/// The harmonics of a curve in canonical phase: those of order 1 and 2, and the others as parts of their greatest, so that the
/// small differences of curves that are nearly circles are kept.
#[derive(Clone, Copy)]
pub(crate) struct Shape {
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
    /// Whether the curve is open, and the closed one goes along it and back.
    is_open: bool,
}

/// The shapes of many curves.
pub(crate) struct Shapes {
    shapes: Vec<Shape>,
    synthesis: Synthesis,
}

/// The units of low harmonics, which are at most 1, and of lengths.
const LOW_UNIT: f32 = 1.0 / 32_000.0;
const LENGTH_UNIT: f64 = 1.0 / 1024.0;

impl Shape {
    /// That of a curve that goes along an open one and back.
    pub fn of_open(self) -> Shape {
        Shape { is_open: true, ..self }
    }

    /// Of a number without a curve.
    pub const EMPTY: Shape =
        Shape { low: [0; 8], high: [0; 32], high_unit: 0.0, rest: 0.0, length: 0, is_full_turn: false, is_open: false };

    /// The memory of a shape.
    pub const BYTES: usize = size_of::<Shape>();

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

    /// The shape of a curve with a spectrum in canonical phase and a length in its sizes.
    pub fn new(canonical: &Spectrum, length: f64, is_full_turn: bool) -> Shape {
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

    pub fn to_bytes(self) -> [u8; Shape::BYTES] {
        let low = self.low.iter().flat_map(|value| value.to_le_bytes());
        let high = self.high.iter().flat_map(|value| value.to_le_bytes());
        let units = [self.high_unit, self.rest].into_iter().flat_map(f32::to_le_bytes);
        let rest = self.length.to_le_bytes().into_iter().chain([self.is_full_turn, self.is_open].map(u8::from));
        let mut bytes = low.chain(high).chain(units).chain(rest);
        std::array::from_fn(|_| bytes.next().unwrap_or_default())
    }

    pub fn from_bytes(bytes: &[u8; Shape::BYTES]) -> Shape {
        let (low, rest) = bytes.split_at(16);
        let (high, rest) = rest.split_at(32);
        let mut next = rest.as_chunks::<4>().0.iter().copied();
        let mut next = || next.next().unwrap_or_default();
        let mut shape =
            Shape { high_unit: f32::from_le_bytes(next()), rest: f32::from_le_bytes(next()), ..Shape::EMPTY };
        let [length, after, is_full_turn, is_open] = next();
        shape.length = u16::from_le_bytes([length, after]);
        (shape.is_full_turn, shape.is_open) = (is_full_turn != 0, is_open != 0);
        shape.low.iter_mut().zip(low.as_chunks().0).for_each(|(value, bytes)| *value = i16::from_le_bytes(*bytes));
        shape.high.iter_mut().zip(high).for_each(|(value, byte)| *value = byte.cast_signed());
        shape
    }

    /// The harmonics of order 1 to 10, then -1 to -10.
    pub fn harmonics(&self) -> [[f32; 2]; 2 * HARMONICS] {
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

/// The parts of the target's length that a curve may have before it is refined; refining changes it.
const MIN_LENGTH: f64 = 0.6;
const MAX_LENGTH: f64 = 1.6;

/// A length in its units; of one that is longer than can be stored, the longest.
fn length_units(length: f64) -> u16 {
    (length / LENGTH_UNIT).min(f64::from(u16::MAX)) as u16
}

impl Shapes {
    pub fn new() -> Shapes {
        Shapes { shapes: Vec::new(), synthesis: Synthesis::new() }
    }

    /// The shapes as bytes, the same on every machine.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.shapes.iter().flat_map(|shape| shape.to_bytes()).collect()
    }

    /// The shapes with these bytes; `None` if they are not a whole number of them.
    pub fn from_bytes(bytes: &[u8]) -> Option<Shapes> {
        let (shapes, []) = bytes.as_chunks() else { return None };
        Some(shapes.iter().map(Shape::from_bytes).collect::<Vec<_>>().into())
    }

    pub fn len(&self) -> usize {
        self.shapes.len()
    }

    pub fn reserve(&mut self, count: usize) {
        self.shapes.reserve_exact(count);
    }

    pub fn push(&mut self, shape: Shape) {
        self.shapes.push(shape);
    }

    /// Adds the curves of a range that are most like a target in canonical phase, by their correlation, and by their places after that of a first.
    /// The length is that of the target in its sizes.
    pub fn nearest(
        &self,
        (target, length, full_turn): (&Spectrum, f64, bool),
        range: (Range<usize>, usize),
        best: &mut Best,
    ) {
        let shape = Shape::new(&target.canonical(), length, true);
        let lengths = [MIN_LENGTH, MAX_LENGTH].map(|part| length_units(part * length));
        self.add_to(best, range, |other, _| {
            let is_candidate = (lengths[0]..=lengths[1]).contains(&other.length) && (other.is_full_turn || !full_turn);
            is_candidate.then(|| -shape.square_distance(other))
        });
    }

    /// Adds the curves of a range of which a portion is most like a stroke, by how much.
    pub fn nearest_portions(
        &self,
        (stroke, full_turn): (&Stroke, bool),
        range: (Range<usize>, usize),
        best: &mut Best,
    ) {
        self.add_to(best, range, |shape, _| {
            if shape.length == 0 || (full_turn && !shape.is_full_turn) {
                return None;
            }
            let length = f32::from(shape.length) * LENGTH_UNIT as f32;
            let window = self.synthesis.best_window(&shape.harmonics(), length, stroke)?;
            Some(-window.residual)
        });
    }

    /// The same with portions that are at least a part of the curve, compared more closely: curves that are not refined must be alike by
    /// themselves.
    pub fn nearest_portions_closely(
        &self,
        (stroke, least): (&Stroke, f64),
        range: (Range<usize>, usize),
        best: &mut Best,
    ) {
        self.add_to(best, range, |shape, floor| {
            let length = f32::from(shape.length) * LENGTH_UNIT as f32;
            let least = if shape.is_open { 0.5 * least } else { least };
            let residual = (shape.length > 0)
                .then(|| self.synthesis.least_residual(&shape.harmonics(), length, (stroke, least), -floor));
            residual.flatten().map(|residual| -residual)
        });
    }

    /// Adds the shapes of a range that have a likeness, which is asked for with what it must exceed to be kept.
    fn add_to(
        &self,
        best: &mut Best,
        (range, first): (Range<usize>, usize),
        likeness: impl Fn(&Shape, f32) -> Option<f32>,
    ) {
        for number in range.start..range.end.min(self.shapes.len()) {
            if let Some(likeness) = likeness(&self.shapes[number], best.floor()) {
                best.add(likeness, first + number);
            }
        }
    }
}

impl From<Vec<Shape>> for Shapes {
    fn from(shapes: Vec<Shape>) -> Shapes {
        Shapes { shapes, ..Shapes::new() }
    }
}
