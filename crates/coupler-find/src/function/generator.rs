//! The linkages that generate functions, in closed form: where they can be assembled, their output and its derivatives.

use std::f64::consts::{FRAC_PI_2, PI};

use coupler_curves::geometry::trig;

/// Which linkage generates a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GeneratorKind {
    /// A four-bar, whose output is the angle of the rocker.
    FourBar,
    /// A slider-crank, whose output is the way of the slider.
    SliderCrank,
}

/// A linkage that generates a function, with the input and the wanted output at the start of the motion.
///
/// Of a four-bar the frame is 1; the input is the angle from the line O → C, from the crank's pivot to the rocker's, to the crank O → A, and
/// the output that from the same line to the rocker C → B. Of a slider-crank the input is the angle from the direction of the slider's line
/// to the crank, and the output is the distance along the line from the foot of the crank's pivot. Angles are in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Generator {
    pub kind: GeneratorKind,
    /// The lengths of crank, coupler and rocker, or of crank and coupler and the offset of the slider's line to the left.
    pub lengths: [f64; 3],
    /// The input and the wanted output at the start.
    pub starts: [f64; 2],
    /// 1 where the rocker pin is to the left of the line from crank pin to rocker pivot, or the slider ahead of the crank pin; -1 on the other side.
    pub side: f64,
}

/// The number of quantities that define a linkage: three lengths, the input and the output at the start.
pub(super) const UNKNOWNS: usize = 5;

impl Generator {
    /// The output at an input, continuous along the motion on one branch; `None` where the linkage cannot be assembled. Of a four-bar it may
    /// differ from the wanted one by whole turns, which [`Generator::turns`] has.
    pub fn output(&self, input: f64) -> Option<f64> {
        let [a, b, third] = self.lengths;
        let (sin, cos) = (trig::sin(input), trig::cos(input));
        match self.kind {
            GeneratorKind::FourBar => {
                let diagonal = diagonal_squared(a, cos);
                let cosine = (third * third + diagonal - b * b) / (2.0 * third * diagonal.sqrt());
                if cosine.abs() > 1.0 || cosine.is_nan() {
                    return None;
                }
                // The direction from the rocker's pivot to the crank pin, without jumps: of a crank shorter than the frame it is about
                // opposite to the frame, and otherwise about that of the crank.
                let to_pin = match a < 1.0 {
                    true => PI - trig::atan2(a * sin, 1.0 - a * cos),
                    false => input + trig::atan2(sin, a - cos),
                };
                Some(to_pin - self.side * trig::acos(cosine))
            }
            GeneratorKind::SliderCrank => {
                let rise = a * sin - third;
                let reach = b * b - rise * rise;
                (reach >= 0.0).then(|| a * cos + self.side * reach.sqrt())
            }
        }
    }

    /// What is added to [`Generator::output`] so that it is nearest to the wanted one at a point, given as the travels of input and output from the
    /// start: whole turns of a rocker. `None` where the linkage cannot be assembled.
    pub fn turns_at(&self, [x, y]: [f64; 2]) -> Option<f64> {
        let there = self.output(self.starts[0] + x)?;
        Some(match self.kind {
            GeneratorKind::FourBar => 2.0 * PI * ((self.starts[1] + y - there) / (2.0 * PI)).round(),
            GeneratorKind::SliderCrank => 0.0,
        })
    }

    /// The derivatives of the output at a travel of the input, where the output is known, less the start of the wanted one: by the logarithms of
    /// crank, coupler and rocker (or by the offset), and by both starts.
    pub fn slopes(&self, travel: f64, output: f64) -> [f64; UNKNOWNS] {
        let [a, b, third] = self.lengths;
        let input = self.starts[0] + travel;
        let (sin, cos) = (trig::sin(input), trig::cos(input));
        match self.kind {
            GeneratorKind::FourBar => {
                // Of the loop's closure, (|B - A|² - b²) / 2 = 0.
                let c = third;
                let (sin_out, cos_out) = (trig::sin(output), trig::cos(output));
                let (sin_between, cos_between) = (trig::sin(input - output), trig::cos(input - output));
                let by_output = -c * sin_out - a * c * sin_between;
                let by = |slope: f64| -slope / by_output;
                [
                    by(a * (a - cos - c * cos_between)),
                    by(-b * b),
                    by(c * (c + cos_out - a * cos_between)),
                    by(a * sin + a * c * sin_between),
                    -1.0,
                ]
            }
            GeneratorKind::SliderCrank => {
                let rise = a * sin - third;
                let reach = self.side * (b * b - rise * rise).sqrt();
                let lean = rise / reach;
                [a * (cos - lean * sin), b * b / reach, lean, -a * sin - lean * a * cos, -1.0]
            }
        }
    }

    /// The linkage after a motion of some unknowns, in the units of [`Generator::slopes`].
    pub fn moved(&self, places: &[usize], by: impl Iterator<Item = f64>) -> Generator {
        /// The greatest step of a logarithm, an angle, or an offset in sizes of the output.
        const MOST: f64 = 0.7;
        let mut next = *self;
        for (place, by) in places.iter().zip(by) {
            let by = by.clamp(-MOST, MOST);
            match place {
                2 if self.kind == GeneratorKind::SliderCrank => next.lengths[2] += by,
                0..3 => next.lengths[*place] *= trig::exp(by),
                _ => next.starts[place - 3] += by,
            }
        }
        next
    }

    /// Whether the linkage can be assembled at all inputs between two, apart from what is rounding at their ends.
    pub fn is_assembled_between(&self, from: f64, to: f64) -> bool {
        /// Relative to the squares of the lengths: a precision point at a limit is within it.
        const ROUNDING: f64 = 1e-12;
        let [a, b, third] = self.lengths;
        extremes(self.kind, from, to).all(|input| match self.kind {
            GeneratorKind::FourBar => {
                let diagonal = diagonal_squared(a, trig::cos(input));
                let [least, most] = [(b - third) * (b - third), (b + third) * (b + third)];
                let rounding = ROUNDING * (most + diagonal);
                diagonal >= least - rounding && diagonal <= most + rounding
            }
            GeneratorKind::SliderCrank => (a * trig::sin(input) - third).abs() <= b * (1.0 + ROUNDING),
        })
    }

    /// The worst transmission angle between two inputs, in radians, 0 to a quarter turn: between coupler and rocker, or the complement of that between coupler
    /// and slider's line.
    pub fn worst_transmission(&self, from: f64, to: f64) -> f64 {
        let [a, b, third] = self.lengths;
        let sine_of_lack = |input: f64| match self.kind {
            GeneratorKind::FourBar => {
                ((b * b + third * third - diagonal_squared(a, trig::cos(input))) / (2.0 * b * third)).abs()
            }
            GeneratorKind::SliderCrank => ((a * trig::sin(input) - third) / b).abs(),
        };
        let worst = extremes(self.kind, from, to).map(sine_of_lack).fold(0.0, f64::max);
        FRAC_PI_2 - trig::asin(worst.min(1.0))
    }

    /// The linkage with its starts as angles that are given, or half a turn more where a link points the opposite way; those that are not given from 0
    /// up to a turn, of an output from minus half a turn.
    pub fn with_starts_near(&self, given: [Option<f64>; 2]) -> Generator {
        let mut next = *self;
        for k in 0..2 {
            let lowest = if k == 0 { 0.0 } else { -PI };
            next.starts[k] = match given[k] {
                _ if k == 1 && self.kind == GeneratorKind::SliderCrank => continue,
                Some(given) if ((self.starts[k] - given) / PI).round().rem_euclid(2.0) == 0.0 => given,
                Some(given) => given + PI,
                None => lowest + (self.starts[k] - lowest).rem_euclid(2.0 * PI),
            };
        }
        next
    }

    /// By how much two linkages of a kind differ: the greatest difference of the logarithms of their lengths, of their offsets and of their
    /// starts; infinite if they are assembled on different sides.
    pub fn distance_to(&self, other: &Generator) -> f64 {
        if self.side != other.side {
            return f64::INFINITY;
        }
        let is_slider = self.kind == GeneratorKind::SliderCrank;
        let length = |k: usize| match k {
            2 if is_slider => (self.lengths[2] - other.lengths[2]).abs(),
            _ => trig::ln(self.lengths[k] / other.lengths[k]).abs(),
        };
        let start = |k: usize| {
            let difference = (self.starts[k] - other.starts[k]).abs();
            if k == 1 && is_slider {
                return difference;
            }
            // Without whole turns.
            2.0 * trig::asin(trig::sin(0.5 * difference).abs().min(1.0))
        };
        (0..3).map(length).chain((0..2).map(start)).fold(0.0, f64::max)
    }

    /// The side on which the pin or the slider is where the output is what is given.
    pub fn side_of(kind: GeneratorKind, [a, _, third]: [f64; 3], [input, output]: [f64; 2]) -> f64 {
        let is_first = match kind {
            // The cross product of crank pin → rocker pivot and rocker pivot → rocker pin.
            GeneratorKind::FourBar => {
                let (x, y) = (1.0 - a * trig::cos(input), -a * trig::sin(input));
                x * third * trig::sin(output) - y * third * trig::cos(output) >= 0.0
            }
            GeneratorKind::SliderCrank => output >= a * trig::cos(input),
        };
        if is_first { 1.0 } else { -1.0 }
    }

    /// Whether the crank turns fully.
    pub fn is_full_turn(&self) -> bool {
        self.lack_of_full_turn() <= 0.0
    }

    /// By how much lengths would have to change at least for the crank to turn fully, relative to the frame or to the size of the output; negative if it does.
    pub fn lack_of_full_turn(&self) -> f64 {
        let [a, b, third] = self.lengths;
        match self.kind {
            GeneratorKind::FourBar => (1.0 + a - b - third).max((b - third).abs() - (1.0 - a).abs()),
            GeneratorKind::SliderCrank => a + third.abs() - b,
        }
    }

    /// The longest link relative to the shortest, of frame, crank, coupler and rocker; of a slider-crank the longest of crank, coupler and offset
    /// relative to the shortest of crank, coupler and the size of the output.
    pub fn ratio(&self) -> f64 {
        let [a, b, third] = self.lengths;
        let [least, most] = match self.kind {
            GeneratorKind::FourBar => [a.min(b).min(third).min(1.0), a.max(b).max(third).max(1.0)],
            GeneratorKind::SliderCrank => [a.min(b).min(1.0), a.max(b).max(third.abs())],
        };
        most / least
    }
}

/// The square of the distance from the crank pin to the rocker's pivot.
fn diagonal_squared(a: f64, cos: f64) -> f64 {
    // Not less than 0 for any rounding.
    (1.0 - a) * (1.0 - a) + 2.0 * a * (1.0 - cos)
}

/// The inputs between two, with these, at which the distances that the links must span are extreme.
fn extremes(kind: GeneratorKind, from: f64, to: f64) -> impl Iterator<Item = f64> {
    let (low, high) = (from.min(to), from.max(to));
    let offset = if kind == GeneratorKind::SliderCrank { FRAC_PI_2 } else { 0.0 };
    let first = ((low - offset) / PI).ceil();
    let inner = (0..4).map(move |k| offset + PI * (first + f64::from(k)));
    [low, high].into_iter().chain(inner.take_while(move |input| *input <= high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scatter::Scatter;

    fn random(scatter: &mut Scatter, kind: GeneratorKind) -> Generator {
        let mut length = || trig::exp(scatter.normal(0.5));
        let mut lengths = [length(), length(), length()];
        if kind == GeneratorKind::SliderCrank {
            lengths[2] -= 1.0;
        }
        let side = if scatter.normal(1.0) > 0.0 { 1.0 } else { -1.0 };
        Generator { kind, lengths, starts: [scatter.normal(2.0), scatter.normal(2.0)], side }
    }

    const KINDS: [GeneratorKind; 2] = [GeneratorKind::FourBar, GeneratorKind::SliderCrank];

    #[test]
    fn the_output_closes_the_loop_on_its_side_without_jumps() {
        let mut scatter = Scatter::new(5);
        for kind in KINDS {
            for _ in 0..300 {
                let generator = random(&mut scatter, kind);
                let [a, b, third] = generator.lengths;
                let mut last: Option<f64> = None;
                for k in 0..=2000 {
                    let input = -4.0 + 0.005 * f64::from(k);
                    let output = generator.output(input);
                    if let Some(output) = output {
                        let pin = [a * trig::cos(input), a * trig::sin(input)];
                        let end = match kind {
                            GeneratorKind::FourBar => [1.0 + third * trig::cos(output), third * trig::sin(output)],
                            GeneratorKind::SliderCrank => [output, third],
                        };
                        let coupler = trig::hypot(end[0] - pin[0], end[1] - pin[1]);
                        assert!((coupler - b).abs() < 1e-9, "{generator:?} {input}");
                        if (generator.worst_transmission(input, input)) > 1e-3 {
                            let side = Generator::side_of(kind, generator.lengths, [input, output]);
                            assert_eq!(side, generator.side, "{generator:?} {input}");
                        }
                        if let Some(last) = last {
                            assert!((output - last).abs() < 0.9, "{generator:?} {input}: {last} {output}");
                        }
                    }
                    last = output;
                }
            }
        }
    }

    #[test]
    fn where_it_can_be_assembled_and_how_it_transmits_are_as_dense_samples_say() {
        let mut scatter = Scatter::new(6);
        for kind in KINDS {
            for _ in 0..400 {
                let generator = random(&mut scatter, kind);
                let from = scatter.normal(3.0);
                let to = from + scatter.normal(1.5);
                let inputs = || (0..=4000).map(|k| from + (to - from) * f64::from(k) / 4000.0);
                let is_assembled = inputs().all(|input| generator.output(input).is_some());
                assert_eq!(generator.is_assembled_between(from, to), is_assembled, "{generator:?} {from} {to}");
                if is_assembled {
                    let at = |input: f64| generator.worst_transmission(input, input);
                    let worst = inputs().map(at).fold(f64::INFINITY, f64::min);
                    let found = generator.worst_transmission(from, to);
                    assert!(found <= worst + 1e-12 && found > worst - 3e-3, "{generator:?} {found} {worst}");
                }
            }
        }
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        const STEP: f64 = 1e-6;
        let mut scatter = Scatter::new(7);
        let mut count = 0;
        for kind in KINDS {
            for _ in 0..200 {
                let generator = random(&mut scatter, kind);
                let travel = scatter.normal(1.0);
                let input = generator.starts[0] + travel;
                if generator.worst_transmission(input, input) < 0.2 || (generator.lengths[0] - 1.0).abs() < 0.1 {
                    continue;
                }
                let Some(output) = generator.output(input) else { continue };
                let slopes = generator.slopes(travel, output);
                // The last is of the wanted output, which this one does not depend on.
                for (k, slope) in slopes.iter().enumerate().take(UNKNOWNS - 1) {
                    let at = |by: f64| {
                        let moved = generator.moved(&[k], std::iter::once(by));
                        moved.output(moved.starts[0] + travel).unwrap()
                    };
                    let difference = (at(STEP) - at(-STEP)) / (2.0 * STEP);
                    assert!((difference - slope).abs() < 1e-6 * (1.0 + slope.abs()), "{generator:?} {k}");
                }
                count += 1;
            }
        }
        assert!(count > 60, "{count}");
    }
}
