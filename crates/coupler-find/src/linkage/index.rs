//! The curves of several linkages by their shape, which can be kept.

use std::ops::Range;

use super::sampled_space::SampledSpace;
use super::samples::SampleCurve;
use super::space::LinkageSpace;
use crate::curve::index::CurveShape;
use crate::shape::spectrum::Transform;

/// The shapes of curves of several linkages, each of which traces one joint on one circuit: with the number of the linkage and of the sample,
/// [`LinkageIndex::BYTES_PER_CURVE`] bytes for each.
#[derive(Default)]
pub struct LinkageIndex {
    linkage_count: usize,
    /// The numbers of the linkage and of the sample, in one.
    codes: Vec<u32>,
    shapes: Vec<CurveShape>,
}

/// Linkages whose curves are sampled for an index.
pub struct LinkageSampler {
    sampled: Vec<SampledSpace>,
}

/// Some samples of a linkage: those that have a curve.
pub struct LinkageIndexPart(Vec<(u32, CurveShape)>);

/// The bits of the number of a sample.
const SAMPLE_BITS: u32 = 27;

/// How many samples are taken for each curve that is wanted, at most.
const TRIES: usize = 50;

/// The samples that one part tries.
const PART: usize = 256;

/// Of linkages that Newton's method solves there are so many times fewer curves, for each takes as many times longer.
const FEWER_OF_GROUPS: usize = 20;

/// Where the input need not turn fully, circuits are searched for, and there are so many times fewer curves.
const FEWER_WITH_LIMITS: usize = 10;

impl LinkageSampler {
    /// The linkages of these spaces, at most 32, whose input turns fully or not.
    pub fn new(spaces: &[LinkageSpace], full_turn: bool) -> LinkageSampler {
        LinkageSampler { sampled: spaces.iter().map(|space| SampledSpace::new(space, full_turn)).collect() }
    }

    /// The number of linkages.
    pub fn linkage_count(&self) -> usize {
        self.sampled.len()
    }

    /// How many of the curves of an index of about that many are those of each linkage, at most.
    pub fn quotas(&self, count: usize) -> Vec<usize> {
        let weights: Vec<usize> =
            self.sampled.iter().map(|sampled| if sampled.space.is_group() { 1 } else { FEWER_OF_GROUPS }).collect();
        let whole: usize = weights.iter().sum::<usize>().max(1);
        let fewer = if self.sampled.iter().all(|sampled| sampled.full_turn) { 1 } else { FEWER_WITH_LIMITS };
        weights.into_iter().map(|weight| (count * weight / (whole * fewer)).max(1)).collect()
    }

    /// The samples of the parts of a linkage, in their order, until it has the curves that are wanted.
    pub fn ranges(quota: usize) -> impl Iterator<Item = Range<usize>> {
        let most = (quota * TRIES).min(1 << SAMPLE_BITS);
        (0..most).step_by(PART).map(move |from| from..(from + PART).min(most))
    }

    /// The curves of a range of samples of a linkage; any thread may find them.
    pub fn part(&self, linkage: usize, range: Range<usize>) -> LinkageIndexPart {
        let transform = Transform::new();
        let sampled = &self.sampled[linkage];
        let of_sample = |sample: usize| {
            let values = sampled.space.sample(sample)?;
            let (on, points) = sampled.curves(&values).into_iter().next()?;
            let shape = CurveShape::of_polyline(&transform, &points?, !on.traced.circuit.is_closed);
            Some(((linkage as u32) << SAMPLE_BITS | sample as u32, shape))
        };
        LinkageIndexPart(range.filter_map(of_sample).collect())
    }

    /// Whether a curve of an index is that of its linkage and sample.
    pub fn has(&self, index: &LinkageIndex, number: usize) -> bool {
        let (linkage, sample) = numbers(index.codes[number]);
        let LinkageIndexPart(found) = match linkage < self.sampled.len() {
            true => self.part(linkage, sample..sample + 1),
            false => LinkageIndexPart(Vec::new()),
        };
        found.first().is_some_and(|(_, shape)| shape.to_bytes() == index.shapes[number].to_bytes())
    }
}

/// The number of the linkage and of the sample.
fn numbers(code: u32) -> (usize, usize) {
    ((code >> SAMPLE_BITS) as usize, (code & ((1 << SAMPLE_BITS) - 1)) as usize)
}

impl LinkageIndex {
    /// The memory of a curve.
    pub const BYTES_PER_CURVE: usize = size_of::<u32>() + CurveShape::BYTES;

    /// The version of the samples and of the bytes.
    pub const VERSION: u32 = 2;

    /// The number of curves that are searched unless another one is asked for.
    pub const DEFAULT_COUNT: usize = 100_000;

    /// An index without curves of a number of linkages.
    pub fn new(linkage_count: usize) -> LinkageIndex {
        LinkageIndex { linkage_count, ..LinkageIndex::default() }
    }

    /// Adds the curves of a part, at most so many, and returns how many.
    pub fn extend(&mut self, LinkageIndexPart(curves): LinkageIndexPart, most: usize) -> usize {
        let added = curves.len().min(most);
        let (codes, shapes): (Vec<u32>, Vec<CurveShape>) = curves.into_iter().take(most).unzip();
        self.codes.extend(codes);
        self.shapes.extend(shapes);
        added
    }

    /// The number of curves.
    pub fn len(&self) -> usize {
        self.codes.len()
    }

    /// Whether it has no curves.
    pub fn is_empty(&self) -> bool {
        self.codes.is_empty()
    }

    /// The number of linkages.
    pub(super) fn linkage_count(&self) -> usize {
        self.linkage_count
    }

    pub(super) fn curves(&self) -> impl Iterator<Item = (SampleCurve, CurveShape)> {
        self.codes.iter().zip(&self.shapes).map(|(code, shape)| {
            let (linkage, sample) = numbers(*code);
            let curve = SampleCurve { linkage: linkage as u32, sample: sample as u32, trace: 0, circuit: 0 };
            (curve, *shape)
        })
    }

    /// The curves as bytes, [`LinkageIndex::BYTES_PER_CURVE`] for each, the same on every machine.
    pub fn to_bytes(&self) -> Vec<u8> {
        let each = self.codes.iter().zip(&self.shapes);
        each.flat_map(|(code, shape)| code.to_le_bytes().into_iter().chain(shape.to_bytes())).collect()
    }

    /// The index of a number of linkages with these bytes; `None` if they are not a whole number of curves. They must be those of an index of this
    /// [`LinkageIndex::VERSION`].
    pub fn from_bytes(linkage_count: usize, bytes: &[u8]) -> Option<LinkageIndex> {
        let (curves, []) = bytes.as_chunks::<{ LinkageIndex::BYTES_PER_CURVE }>() else { return None };
        let mut index = LinkageIndex::new(linkage_count);
        for curve in curves {
            let (code, shape) = curve.split_first_chunk()?;
            index.codes.push(u32::from_le_bytes(*code));
            index.shapes.push(CurveShape::from_bytes(shape.first_chunk()?));
        }
        Some(index)
    }
}
