//! The shape of a closed curve as the spectrum of its points at equal distances along it.
//!
//! The curve z(s), from its centroid, is the sum of harmonics c(k) e^(2πi k s), k = ±1 to ±10, where s is the part of its length;
//! they have a sum of squares of at most 1, the mean square of a curve of size 1. A rotation by α and a start at -τ multiply
//! c(k) by e^(i(α + kτ)); the opposite direction exchanges c(k) and c(-k); a reflection and the opposite direction together
//! conjugate c(k). So one correlation compares two curves in all positions, sizes, directions, reflections and starts.

use std::borrow::Cow;
use std::f64::consts::{PI, TAU};

use crate::complex::{Complex, length, mean, open_length, unit};
use coupler_curves::geometry::Similarity;

/// The number of harmonics of either sign.
pub(crate) const HARMONICS: usize = 10;

/// The number of points at equal distances from which a spectrum is computed.
const POINTS: usize = 64;

/// The harmonics 1 to 10, then -1 to -10.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spectrum(pub [Complex; 2 * HARMONICS]);

/// The directions of equal parts of a turn.
pub(crate) fn directions(count: usize) -> Vec<Complex> {
    (0..count).map(|k| unit(TAU * k as f64 / count as f64)).collect()
}

/// Points at equal distances along a closed polyline, from its first point on.
pub(crate) fn resampled(points: &[Complex], count: usize) -> Vec<Complex> {
    resampled_segments(points, points.len(), count)
}

/// An open polyline as the chord from its first point to its last and ten harmonics, which are 0 at both. Noise is spread over all
/// harmonics, of which these have next to none.
struct OpenHarmonics {
    first: Complex,
    chord: Complex,
    harmonics: [Complex; HARMONICS],
}

impl OpenHarmonics {
    /// Of points at equal steps of the parameter, which goes from 0 to 1.
    fn of(points: &[Complex]) -> OpenHarmonics {
        let intervals = points.len() - 1;
        let part = |n: usize| n as f64 / intervals as f64;
        let (first, chord) = (points[0], points[intervals] - points[0]);
        let beside: Vec<Complex> =
            points[..intervals].iter().enumerate().map(|(n, point)| point - first - chord * part(n)).collect();
        let harmonic = |k: usize| {
            let sum: Complex = beside.iter().enumerate().map(|(n, point)| point * half_turns(k, part(n)).im).sum();
            sum * (2.0 / intervals as f64)
        };
        OpenHarmonics { first, chord, harmonics: std::array::from_fn(|k| harmonic(k + 1)) }
    }

    fn point(&self, at: f64) -> Complex {
        let terms = (1..).zip(&self.harmonics).map(|(k, harmonic)| harmonic * half_turns(k, at).im);
        self.first + self.chord * at + terms.sum::<Complex>()
    }

    fn velocity(&self, at: f64) -> Complex {
        let terms = (1..).zip(&self.harmonics).map(|(k, harmonic)| harmonic * (PI * k as f64 * half_turns(k, at).re));
        self.chord + terms.sum::<Complex>()
    }
}

/// The direction after a part of a number of half turns.
fn half_turns(count: usize, part: f64) -> Complex {
    unit(PI * count as f64 * part)
}

/// The length of an open polyline without what it has in addition to its [`OpenHarmonics`].
pub(crate) fn smooth_open_length(points: &[Complex]) -> f64 {
    let last = points.len() - 1;
    let mut even = resampled_segments(points, last, POINTS);
    even.push(points[last]);
    let harmonics = OpenHarmonics::of(&even);
    let speed = |n: usize| length(harmonics.velocity(n as f64 / POINTS as f64));
    // The trapezoidal rule.
    let ends = 0.5 * (speed(0) + speed(POINTS));
    (ends + (1..POINTS).map(speed).sum::<f64>()) / POINTS as f64
}

/// An open polyline without its noise: its [`OpenHarmonics`], or itself if it has next to no noise. The length of a noisy polyline says how
/// many points there are up to a place, and not how far along the path that is.
pub(crate) fn without_noise(points: &[Complex]) -> Cow<'_, [Complex]> {
    /// A polyline that is longer than its harmonics by more is mostly noise.
    const NOISY: f64 = 1.15;
    /// Through fewer points noise cannot be told from the path.
    const FEW: usize = 4 * HARMONICS;
    if points.len() < FEW || open_length(points) <= NOISY * smooth_open_length(points) {
        return points.into();
    }
    let harmonics = OpenHarmonics::of(points);
    let last = points.len() - 1;
    (0..=last).map(|n| harmonics.point(n as f64 / last as f64)).collect()
}

/// Points at equal distances along the first segments of a closed polyline.
fn resampled_segments(points: &[Complex], segments: usize, count: usize) -> Vec<Complex> {
    let next = |k: usize| points[(k + 1) % points.len()];
    let lengths: Vec<f64> = (0..segments).map(|k| length(next(k) - points[k])).collect();
    let step = lengths.iter().sum::<f64>() / count as f64;
    let (mut segment, mut before) = (0, 0.0);
    let point = |k: usize| {
        let at = step * k as f64;
        while segment + 1 < segments && before + lengths[segment] <= at {
            before += lengths[segment];
            segment += 1;
        }
        let part = if lengths[segment] > 0.0 { ((at - before) / lengths[segment]).min(1.0) } else { 0.0 };
        points[segment] + (next(segment) - points[segment]) * part
    };
    (0..count).map(point).collect()
}

/// Where the points of a curve are at equal distances along it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    /// Their centroid.
    pub centre: Complex,
    /// The root of the mean square of their distances from it.
    pub size: f64,
}

/// How a curve is placed on the one it is like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Likeness {
    /// The correlation, up to 1 for similar curves.
    pub value: f64,
    /// Whether the curve is mirrored in the x-axis before.
    pub is_mirrored: bool,
    /// The factor of the similarity that follows, for curves of size 1.
    pub factor: Complex,
}

impl Likeness {
    /// The similarity that places the curve on the target, if it is there; each is given by the extent that goes with its spectrum.
    pub fn similarity(&self, target: &Extent, curve: &Extent) -> Similarity {
        let factor = self.factor * (target.size / curve.size);
        let placed = Similarity { is_mirrored: self.is_mirrored, factor, shift: target.centre };
        Similarity { shift: target.centre - placed.direction(curve.centre), ..placed }
    }
}

/// The table of a spectrum's computation.
pub(crate) struct Transform {
    directions: Vec<Complex>,
}

impl Transform {
    pub fn new() -> Transform {
        Transform { directions: directions(POINTS) }
    }

    /// The spectrum of a closed polyline, and the extent of [`POINTS`] points at equal distances along it.
    pub fn spectrum(&self, polyline: &[Complex]) -> (Spectrum, Extent) {
        let points = resampled(polyline, POINTS);
        let centre = mean(&points);
        let mut harmonics = [Complex::new(0.0, 0.0); 2 * HARMONICS];
        let mut squares = 0.0;
        for (n, point) in points.iter().enumerate() {
            let z = point - centre;
            squares += z.norm_sqr();
            for k in 1..=HARMONICS {
                let direction = self.directions[(n * k) % POINTS];
                harmonics[k - 1] += z * direction.conj();
                harmonics[HARMONICS + k - 1] += z * direction;
            }
        }
        let size = (squares / points.len() as f64).sqrt();
        let scale = 1.0 / (points.len() as f64 * size.max(f64::MIN_POSITIVE));
        (Spectrum(harmonics.map(|harmonic| harmonic * scale)), Extent { centre, size })
    }

    /// The length of the curve of the harmonics ±1 to ±10 of a closed polyline.
    pub fn length(&self, polyline: &[Complex]) -> f64 {
        let (Spectrum(harmonics), Extent { size, .. }) = self.spectrum(polyline);
        let velocity = |n: usize| -> Complex {
            let of_order = |k: usize| {
                let turn = self.directions[(n * k) % POINTS];
                (harmonics[k - 1] * turn - harmonics[HARMONICS + k - 1] * turn.conj()) * (TAU * k as f64)
            };
            (1..=HARMONICS).map(of_order).sum()
        };
        size * (0..POINTS).map(|n| length(velocity(n))).sum::<f64>() / POINTS as f64
    }

    /// How a curve of a spectrum is most like another one, over all starts, directions and reflections.
    pub fn likeness(&self, target: &Spectrum, curve: &Spectrum) -> Likeness {
        let mut best = Likeness { value: 0.0, is_mirrored: false, factor: Complex::new(1.0, 0.0) };
        for (is_mirrored, is_reversed) in [(false, false), (false, true), (true, false), (true, true)] {
            let placed = curve.oriented(is_mirrored, is_reversed);
            let product = |k: usize| target.0[k] * placed.0[k].conj();
            let products: [Complex; 2 * HARMONICS] = std::array::from_fn(product);
            // No start gives more than the amplitudes.
            if products.iter().map(|product| length(*product)).sum::<f64>() <= best.value {
                continue;
            }
            for start in 0..POINTS {
                let sum: Complex = (1..=HARMONICS)
                    .map(|k| {
                        let turn = self.directions[(k * start) % POINTS];
                        products[k - 1] * turn.conj() + products[HARMONICS + k - 1] * turn
                    })
                    .sum();
                if sum.norm_sqr() > best.value * best.value {
                    best = Likeness { value: length(sum), is_mirrored, factor: sum };
                }
            }
        }
        best
    }
}

impl Transform {
    /// How a curve of a spectrum is like another one with any start, in all directions and reflections: the greatest correlations among those
    /// of neighbouring starts, the greatest first; and whether the curve's direction is the opposite one.
    pub fn likenesses(&self, target: &Spectrum, curve: &Spectrum) -> Vec<(Likeness, bool)> {
        let mut found: Vec<(Likeness, bool)> = Vec::new();
        for (is_mirrored, is_reversed) in [(false, false), (false, true), (true, false), (true, true)] {
            let placed = curve.oriented(is_mirrored, is_reversed);
            let products: [Complex; 2 * HARMONICS] = std::array::from_fn(|k| target.0[k] * placed.0[k].conj());
            let factors: [Complex; POINTS] = std::array::from_fn(|start| {
                let turn = |k: usize| self.directions[(k * start) % POINTS];
                (1..=HARMONICS).map(|k| products[k - 1] * turn(k).conj() + products[HARMONICS + k - 1] * turn(k)).sum()
            });
            let value = |start: usize| length(factors[start % POINTS]);
            let is_greatest =
                |start: &usize| value(*start) > value(start + POINTS - 1) && value(*start) >= value(start + 1);
            let likeness = |start| (Likeness { value: value(start), is_mirrored, factor: factors[start] }, is_reversed);
            found.extend((0..POINTS).filter(is_greatest).map(likeness));
        }
        found.sort_by(|a, b| b.0.value.total_cmp(&a.0.value));
        found
    }
}

/// The square root of a vector of length 1 with a real part that is not negative.
fn unit_root(z: Complex) -> Complex {
    let cos = (0.5 * (1.0 + z.re)).max(0.0).sqrt();
    let sin = (0.5 * (1.0 - z.re)).max(0.0).sqrt();
    Complex::new(cos, sin.copysign(z.im))
}

impl Spectrum {
    /// The spectrum of the curve after a reflection in the x-axis, and in the opposite direction.
    pub fn oriented(&self, is_mirrored: bool, is_reversed: bool) -> Spectrum {
        let Spectrum(mut harmonics) = *self;
        // A reflection conjugates the harmonics and exchanges their signs; so does the opposite direction the signs.
        if is_mirrored != is_reversed {
            let (positive, negative) = harmonics.split_at_mut(HARMONICS);
            positive.swap_with_slice(negative);
        }
        Spectrum(if is_mirrored { harmonics.map(|harmonic| harmonic.conj()) } else { harmonics })
    }

    /// The spectrum in canonical phase and direction: of the harmonics 1 and -1, the first is the greater one, and both are
    /// real and positive. A start on the opposite side, which changes the sign of the even harmonics, is the only other one.
    pub fn canonical(&self) -> Spectrum {
        let is_reversed = self.0[HARMONICS].norm_sqr() > self.0[0].norm_sqr();
        let Spectrum(harmonics) = self.oriented(false, is_reversed);
        let phase = |z: Complex| if z.norm_sqr() > 0.0 { z.conj() / length(z) } else { Complex::new(1.0, 0.0) };
        let [first, second] = [phase(harmonics[0]), phase(harmonics[HARMONICS])];
        // e^(2iα) and e^(2iτ).
        let rotation = unit_root(first * second);
        let start = first * rotation.conj();
        let mut power = start;
        let mut canonical = harmonics;
        for k in 0..HARMONICS {
            canonical[k] *= rotation * power;
            canonical[HARMONICS + k] *= rotation * power.conj();
            power *= start;
        }
        Spectrum(canonical)
    }
}
