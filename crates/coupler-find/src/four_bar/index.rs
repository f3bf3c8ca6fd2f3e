//! Coupler curves of many four-bars by their shape.

use crate::complex::{Complex, closed_length};
use crate::four_bar::parameters::Parameters;
use crate::four_bar::pose::Pose;
use crate::four_bar::sequence::{CLASSES, four_bar_of_sequence};
use crate::shape::best::Best;
use crate::shape::compact::{Shape, Shapes};
use crate::shape::spectrum::{Extent, Spectrum, Transform, directions};
use crate::shape::stroke::Stroke;
use crate::target::{PathKind, Target};

/// The curves of the four-bars of a fixed sequence, whose parameters fill their ranges evenly.
///
/// Curves are closed and described by their harmonics ±1 to ±10 in canonical phase, in [`Index::BYTES_PER_CURVE`] bytes.
/// The sequence has crank-rockers, drag-links and triple-rockers; rocker-cranks and double-rockers trace the curves of
/// crank-rockers (Roberts and Chebyshev).
pub struct Index {
    shapes: Shapes,
    transform: Transform,
    directions: Vec<Complex>,
}

/// Some curves of an index.
pub struct IndexPart(Vec<Shape>);

/// The number of poses from which a curve is computed.
pub(crate) const SAMPLES: usize = 128;

/// A four-bar of the sequence on one of its circuits.
pub(crate) struct Entry {
    pub linkage: Parameters,
    pub circuit: Vec<Pose>,
}

impl Index {
    /// The memory of a curve.
    pub const BYTES_PER_CURVE: usize = Shape::BYTES;

    /// The version of the sequence and of the bytes.
    pub const VERSION: u32 = 1;

    /// The number of curves that are searched unless another one is asked for.
    pub const DEFAULT_COUNT: usize = 100_000;

    /// An index without curves.
    pub fn new() -> Index {
        Index { shapes: Shapes::new(), transform: Transform::new(), directions: directions(SAMPLES) }
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
        let shapes: Vec<Shape> = parts.into_iter().flat_map(|IndexPart(shapes)| shapes).collect();
        Index { shapes: Shapes::from(shapes), ..Index::new() }
    }

    /// The curves as bytes, [`Index::BYTES_PER_CURVE`] for each, the same on every machine.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.shapes.to_bytes()
    }

    /// The index with these bytes; `None` if they are not a whole number of curves. They must be those of an index of this
    /// [`Index::VERSION`].
    pub fn from_bytes(bytes: &[u8]) -> Option<Index> {
        Some(Index { shapes: Shapes::from_bytes(bytes)?, ..Index::new() })
    }

    /// Takes the memory for so many curves at once: growing step by step takes three times as much.
    pub fn reserve(&mut self, count: usize) {
        self.shapes.reserve(count.saturating_sub(self.len()));
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
        self.len() == 0
    }

    /// The numbers of the curves that are most like a closed target, or of those with a portion that is most like an open one; at
    /// most `most`, the likeliest first. Of closed ones the harmonics are compared in canonical phase only.
    pub fn most_alike(&self, target: &Target, full_turn: bool, most: usize) -> Vec<usize> {
        let points = target.normalized();
        let mut best = Best::new(most);
        match target.kind() {
            PathKind::Closed => {
                let (spectrum, ..) = self.transform.spectrum(&points);
                self.nearest((&spectrum, target.smooth_length(), full_turn), 0..self.len(), &mut best);
            }
            PathKind::Open | PathKind::Part => {
                self.nearest_portions((&Stroke::new(&points), full_turn), 0..self.len(), &mut best);
            }
        }
        best.sorted().into_iter().map(|(_, number)| number).collect()
    }

    /// How much a curve is like a closed target, up to 1 for similar curves: the greatest correlation of their harmonics over all
    /// starts, directions and reflections. `None` if the index has no such curve.
    pub fn likeness(&self, target: &Target, number: usize) -> Option<f64> {
        let (spectrum, ..) = self.transform.spectrum(&target.normalized());
        let (curve, ..) = self.spectrum(&self.entry(number).filter(|_| number < self.len())?);
        Some(self.transform.likeness(&spectrum, &curve).value)
    }

    /// The transform of spectra.
    pub(crate) fn transform(&self) -> &Transform {
        &self.transform
    }

    /// A four-bar of the sequence.
    pub(crate) fn entry(&self, number: usize) -> Option<Entry> {
        let linkage = four_bar_of_sequence(number);
        let mut circuits = linkage.circuits(&self.directions);
        // Of two circuits, each in turn.
        let place = (number / CLASSES).checked_rem(circuits.len())?;
        let circuit = circuits.swap_remove(place);
        (circuit.len() > SAMPLES / 2).then_some(Entry { linkage, circuit })
    }

    /// The spectrum of a curve, with its extent, and its length in sizes.
    pub(crate) fn spectrum(&self, entry: &Entry) -> (Spectrum, Extent, f64) {
        let points = entry.linkage.curve(&entry.circuit);
        let (spectrum, extent) = self.transform.spectrum(&points);
        (spectrum, extent, closed_length(&points) / extent.size)
    }

    fn shape(&self, number: usize) -> Shape {
        let Some(entry) = self.entry(number) else { return Shape::EMPTY };
        let (spectrum, _, length) = self.spectrum(&entry);
        Shape::new(&spectrum.canonical(), length, entry.linkage.is_full_turn())
    }

    /// Adds the curves of a range that are most like a target in canonical phase, see [`Shapes::nearest`].
    pub(crate) fn nearest(&self, query: (&Spectrum, f64, bool), range: std::ops::Range<usize>, best: &mut Best) {
        self.shapes.nearest(query, (range, 0), best);
    }

    /// Adds the curves of a range of which a portion is most like a stroke, see [`Shapes::nearest_portions`].
    pub(crate) fn nearest_portions(&self, query: (&Stroke, bool), range: std::ops::Range<usize>, best: &mut Best) {
        self.shapes.nearest_portions(query, (range, 0), best);
    }
}

impl Default for Index {
    fn default() -> Index {
        Index::new()
    }
}
