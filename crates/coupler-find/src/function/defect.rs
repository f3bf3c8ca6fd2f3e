//! Why a linkage that is exact at precision points does not pass them in one motion.

use super::generator::Generator;

/// Why a linkage does not generate a function, though its output is exact at all precision points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Defect {
    /// Two points, by their numbers from 1, are on different branches: the linkage would have to be taken apart, or pass a limit.
    Branch([usize; 2]),
    /// Between two points are inputs at which the linkage cannot be assembled.
    Limit([usize; 2]),
    /// Between two points the rocker turns by another angle than it should, a whole turn more or less.
    Turns([usize; 2]),
    /// The range of the input reaches beyond a limit, outside of the points.
    Range,
}

/// Radians, or sizes of the output: the rounding of a solution, with room for points near limits, where it is its root.
const SAME: f64 = 1e-5;

/// The first defect of a linkage with precision points, each the travels of input and output, on the way from the first to the last and in a
/// range of the travel; outputs that differ by less than 1e-5 of `size` are the same.
pub(super) fn defect(linkage: &Generator, points: &[[f64; 2]], [from, to]: [f64; 2], size: f64) -> Option<Defect> {
    let [input, output] = linkage.starts;
    let turns = points.first().and_then(|first| linkage.turns_at(*first)).unwrap_or(0.0);
    for (k, pair) in points.windows(2).enumerate() {
        let numbers = [k + 1, k + 2];
        let [[before, _], [x, y]] = [pair[0], pair[1]];
        if !linkage.is_assembled_between(input + before, input + x) {
            // The other branch may be reached through the limit, or in no way.
            let other = Generator::side_of(linkage.kind, linkage.lengths, [input + x, output + y]) != linkage.side;
            return Some(if other { Defect::Branch(numbers) } else { Defect::Limit(numbers) });
        }
        let is_there = |linkage: &Generator, turns: f64| {
            let there = linkage.output(input + x);
            there.is_none_or(|there| (there + turns - output - y).abs() <= SAME * size)
        };
        if !is_there(linkage, turns) {
            let mirrored = Generator { side: -linkage.side, ..*linkage };
            let is_mirrored = mirrored.turns_at(pair[1]).is_some_and(|turns| is_there(&mirrored, turns));
            return Some(if is_mirrored { Defect::Branch(numbers) } else { Defect::Turns(numbers) });
        }
    }
    (!linkage.is_assembled_between(input + from, input + to)).then_some(Defect::Range)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::function::generator::GeneratorKind;
    use crate::function::precision::exact;
    use crate::scatter::Scatter;

    /// The output at a travel of the input, followed in small steps to the nearest of both sides; `None` where there is none.
    fn followed(linkage: &Generator, [from, to]: [f64; 2], output: f64) -> Option<f64> {
        const STEPS: usize = 3000;
        let mut output = output;
        for k in 0..=STEPS {
            let input = linkage.starts[0] + from + (to - from) * k as f64 / STEPS as f64;
            let on = |side: f64| {
                let there = Generator { side, ..*linkage }.output(input)?;
                let turns = std::f64::consts::TAU * ((output - there) / std::f64::consts::TAU).round();
                Some(if linkage.kind == GeneratorKind::FourBar { there + turns } else { there })
            };
            let sides = [on(1.0)?, on(-1.0)?];
            output = sides.into_iter().min_by(|a, b| (a - output).abs().total_cmp(&(b - output).abs()))?;
        }
        Some(output)
    }

    #[test]
    fn an_output_that_would_have_to_turn_once_more_and_a_range_beyond_a_limit_are_told() {
        // A drag-link: both cranks turn fully.
        let lengths = [2.0, 2.2, 2.4];
        let linkage = Generator { kind: GeneratorKind::FourBar, lengths, starts: [0.5, 0.0], side: 1.0 };
        let first = linkage.output(0.5).unwrap();
        let point = |x: f64| [x, linkage.output(0.5 + x).unwrap() - first];
        let linkage = Generator { starts: [0.5, first], ..linkage };
        let mut points = [0.0, 2.0, 4.0, 6.0].map(point);
        assert_eq!(defect(&linkage, &points, [0.0, 6.0], 1.0), None);
        points[3][1] -= std::f64::consts::TAU;
        assert_eq!(defect(&linkage, &points, [0.0, 6.0], 1.0), Some(Defect::Turns([3, 4])));
        // The slider's coupler is too short for a turn.
        let lengths = [1.0, 0.9, 0.0];
        let linkage = Generator { kind: GeneratorKind::SliderCrank, lengths, starts: [0.0, 1.9], side: 1.0 };
        let points = [0.0, 0.3, 0.6].map(|x| [x, linkage.output(x).unwrap() - 1.9]);
        assert_eq!(defect(&linkage, &points, [0.0, 1.0], 1.0), None);
        assert_eq!(defect(&linkage, &points, [0.0, 1.2], 1.0), Some(Defect::Range));
    }

    #[test]
    fn a_linkage_without_defect_passes_its_points_in_one_motion_and_one_with_a_defect_does_not() {
        let mut scatter = Scatter::new(8);
        let mut counts = [0; 5];
        for kind in [GeneratorKind::FourBar, GeneratorKind::SliderCrank] {
            for _ in 0..1500 {
                let mut points = vec![[0.0, 0.0]];
                for k in 1..5 {
                    let [x, y]: [f64; 2] = points[k - 1];
                    points.push([x + 0.1 + scatter.normal(0.6).abs(), y + scatter.normal(0.7)]);
                }
                for linkage in exact(kind, &points, [None; 2]).linkages {
                    let start = linkage.starts[0];
                    // Near a limit neither steps nor rounding tell the sides apart.
                    let near_limit = |x: f64| linkage.worst_transmission(start + x, start + x) < 0.03;
                    if points.iter().any(|[x, _]| near_limit(*x)) || (linkage.lengths[0] - 1.0).abs() < 0.05 {
                        continue;
                    }
                    let range = [points[0][0], points[4][0]];
                    let steep = linkage.worst_transmission(start + range[0], start + range[1]);
                    let found = defect(&linkage, &points, range, 1.0);
                    if found.is_none() && steep < 0.03 {
                        continue;
                    }
                    let output = linkage.starts[1];
                    let passes = (1..5).all(|k| {
                        let [[from, before], [to, wanted]] = [points[k - 1], points[k]];
                        let there = followed(&linkage, [from, to], output + before);
                        there.is_some_and(|there| (there - output - wanted).abs() < 1e-3)
                    });
                    assert_eq!(found.is_none(), passes, "{linkage:?} {points:?} {found:?}");
                    counts[match found {
                        None => 0,
                        Some(Defect::Branch(_)) => 1,
                        Some(Defect::Limit(_)) => 2,
                        Some(Defect::Turns(_)) => 3,
                        Some(Defect::Range) => 4,
                    }] += 1;
                }
            }
        }
        assert!(counts[0] > 100 && counts[1] > 100 && counts[2] > 20, "{counts:?}");
    }
}
