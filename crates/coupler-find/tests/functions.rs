//! Linkages that generate functions, against what is known of them and against motions that are followed step by step.

mod random;

use std::f64::consts::PI;

use coupler_curves::expression::Expression;
use coupler_curves::geometry::trig;
use coupler_find::{
    Condition, FunctionAnswer, FunctionFindings, FunctionMethod, FunctionOptions, FunctionTarget, GeneratorKind, Law,
    LeftOut, OneAtATime, generate_function,
};
use random::Random;

const FOUR_BAR: GeneratorKind = GeneratorKind::FourBar;
const SLIDER_CRANK: GeneratorKind = GeneratorKind::SliderCrank;

fn options(kind: GeneratorKind, method: FunctionMethod) -> FunctionOptions {
    FunctionOptions {
        kind,
        method,
        input_start_deg: None,
        output_start: None,
        full_turn: false,
        max_ratio: f64::INFINITY,
        condition: None,
        most: 10,
    }
}

fn law(text: &str, x: [f64; 2], input_deg: f64, output: f64, is_length: bool) -> FunctionTarget {
    let range = if is_length { output } else { trig::radians(output) };
    let law = Law::new(&Expression::parse(text).unwrap(), "x", x, trig::radians(input_deg), range);
    FunctionTarget::law(law.unwrap(), is_length)
}

fn find(target: &FunctionTarget, options: &FunctionOptions) -> FunctionFindings {
    generate_function(target, options, &OneAtATime)
}

fn dimension(answer: &FunctionAnswer, name: &str) -> f64 {
    answer.dimensions.iter().find(|(known, _)| *known == name).unwrap().1
}

/// A linkage by its lengths, independently of the program: of a four-bar with the frame 1 crank, coupler and rocker, of a slider-crank crank, coupler
/// and offset.
#[derive(Clone, Copy, Debug)]
struct Linkage {
    kind: GeneratorKind,
    lengths: [f64; 3],
}

impl Linkage {
    fn of(answer: &FunctionAnswer) -> Linkage {
        let names = match answer.kind {
            GeneratorKind::FourBar => ["crank", "coupler", "rocker"],
            GeneratorKind::SliderCrank => ["crank", "coupler", "offset"],
        };
        Linkage { kind: answer.kind, lengths: names.map(|name| dimension(answer, name)) }
    }

    /// Both outputs at an input: of a four-bar by the half-angle formula of the closed loop.
    fn outputs(&self, input: f64) -> Option<[f64; 2]> {
        let [a, b, third] = self.lengths;
        let (sin, cos) = (trig::sin(input), trig::cos(input));
        match self.kind {
            GeneratorKind::FourBar => {
                // p cos ψ + q sin ψ = r
                let (p, q) = (2.0 * third * (1.0 - a * cos), -2.0 * third * a * sin);
                let r = b * b - 1.0 - a * a - third * third + 2.0 * a * cos;
                let root = p * p + q * q - r * r;
                (root >= 0.0).then(|| [1.0, -1.0].map(|sign| trig::atan2(q, p) + sign * trig::atan2(root.sqrt(), r)))
            }
            GeneratorKind::SliderCrank => {
                let rise = a * sin - third;
                let root = b * b - rise * rise;
                (root >= 0.0).then(|| [1.0, -1.0].map(|sign| a * cos + sign * root.sqrt()))
            }
        }
    }

    /// The outputs at some inputs, followed from the first in small steps of the input to the next of both positions; `None` where it
    /// cannot be assembled on the way.
    fn follow(&self, inputs: &[f64], first: f64) -> Option<Vec<f64>> {
        let mut output = first;
        let mut found = Vec::new();
        let mut last = inputs[0];
        for input in inputs {
            const STEPS: usize = 400;
            for k in 0..=STEPS {
                let here = last + (input - last) * k as f64 / STEPS as f64;
                let nearest = |wanted: f64| {
                    let positions = self.outputs(here)?;
                    let turned = positions.map(|position| match self.kind {
                        GeneratorKind::FourBar => position + 2.0 * PI * ((wanted - position) / (2.0 * PI)).round(),
                        GeneratorKind::SliderCrank => position,
                    });
                    turned.into_iter().min_by(|a, b| (a - wanted).abs().total_cmp(&(b - wanted).abs()))
                };
                output = nearest(output)?;
            }
            found.push(output);
            last = *input;
        }
        Some(found)
    }
}

/// A random linkage and the rows of a function that it generates, from inputs and outputs of any zero.
fn random_rows(random: &mut Random, kind: GeneratorKind, count: usize) -> (Linkage, [f64; 2], Vec<[f64; 2]>) {
    loop {
        let mut between = |low: f64, high: f64| random.between(low, high);
        let linkage = Linkage { kind, lengths: [between(0.3, 3.0), between(0.3, 3.0), between(0.3, 3.0)] };
        let mut inputs = vec![between(0.0, 2.0 * PI)];
        for k in 1..count {
            inputs.push(inputs[k - 1] + between(0.5, 1.0) * 1.5 / count as f64);
        }
        let Some(positions) = linkage.outputs(inputs[0]) else { continue };
        // Not near limits, where positions cannot be told apart by steps.
        if inputs.iter().any(|input| linkage.outputs(*input).is_none_or(|[a, b]| (a - b).abs() < 0.4)) {
            continue;
        }
        let Some(outputs) = linkage.follow(&inputs, positions[usize::from(random.number() < 0.5)]) else { continue };
        let unit = if kind == FOUR_BAR { trig::degrees(1.0) } else { 1.0 };
        let rows = inputs.iter().zip(&outputs).map(|(x, y)| [trig::degrees(x - 1.0), unit * (y - 0.3)]);
        return (linkage, [inputs[0], outputs[0]], rows.collect());
    }
}

/// Checks that a linkage generates rows in one motion, to a part of their outputs' size.
fn check_rows(answer: &FunctionAnswer, rows: &[[f64; 2]], part: f64) {
    let unit = if answer.kind == FOUR_BAR { trig::radians(1.0) } else { 1.0 };
    let start = trig::radians(answer.input_deg[0]);
    let inputs: Vec<f64> = rows.iter().map(|row| start + trig::radians(row[0] - rows[0][0])).collect();
    let outputs = Linkage::of(answer).follow(&inputs, unit * answer.output[0]);
    let outputs = outputs.unwrap_or_else(|| panic!("{answer:?} cannot be followed"));
    for (row, output) in rows.iter().zip(outputs) {
        let wanted = unit * (answer.output[0] + row[1] - rows[0][1]);
        assert!((output - wanted).abs() < part, "{answer:?}: {output} for {wanted}");
    }
}

#[test]
fn all_linkages_of_five_rows_pass_them_in_one_motion_and_the_one_that_made_them_is_among_them() {
    for kind in [FOUR_BAR, SLIDER_CRANK] {
        let mut random = Random(11);
        let (mut several, mut left_out) = (0, 0);
        for _ in 0..150 {
            let (linkage, _, rows) = random_rows(&mut random, kind, 5);
            let target = FunctionTarget::rows(&rows, kind == SLIDER_CRANK).unwrap();
            let found = find(&target, &options(kind, FunctionMethod::Points(5)));
            let is_own = |answer: &FunctionAnswer| {
                let lengths = Linkage::of(answer).lengths;
                lengths.iter().zip(linkage.lengths).all(|(a, b)| (a - b).abs() < 1e-4 * (1.0 + b.abs()))
            };
            assert!(found.answers.iter().any(is_own), "{linkage:?}: {found:?}");
            for answer in &found.answers {
                check_rows(answer, &rows, 1e-5);
                assert!(answer.error.greatest.abs() < 1e-4, "{answer:?}");
            }
            let out: usize = found.left_out.iter().map(|(_, count)| count).sum();
            let all = found.solutions.unwrap();
            assert!(all <= 3 && found.answers.len() + out == all, "{found:?}");
            several += usize::from(found.answers.len() > 1);
            left_out += out;
        }
        assert!(several > 5 && left_out > 20, "{kind:?}: {several} {left_out}");
    }
}

/// Freudenstein's three equations with both starts, by Cramer's rule: K1, K2 and K3 of K1 cos ψ - K2 cos θ + K3 = cos(θ - ψ).
fn freudenstein(points: [[f64; 2]; 3]) -> [f64; 3] {
    let rows = points.map(|[x, y]| [trig::cos(y), -trig::cos(x), 1.0, trig::cos(x - y)]);
    let determinant = |columns: [usize; 3]| {
        let m = rows.map(|row| columns.map(|k| row[k]));
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    };
    let all = determinant([0, 1, 2]);
    [determinant([3, 1, 2]), determinant([0, 3, 2]), determinant([0, 1, 3])].map(|part| part / all)
}

/// y = 1 / x for x from 1 to 2, with the input from 30° to 120° and the output from 240° to 330°, in three points of Chebyshev's spacing: the
/// example of textbooks (Shigley and Uicker, Freudenstein's equation), here solved apart from the program.
#[test]
fn three_points_with_both_starts_are_the_linkage_of_freudensteins_equation() {
    let target = law("1 / x", [1.0, 2.0], 90.0, 90.0, false);
    let xs = [1.5 - 0.5 * 0.75f64.sqrt(), 1.5, 1.5 + 0.5 * 0.75f64.sqrt()];
    let points = xs.map(|x| [30.0 + 90.0 * (x - 1.0), 240.0 + 90.0 * (1.0 - 1.0 / x) / 0.5].map(trig::radians));
    let [k1, k2, k3] = freudenstein(points);
    let (crank, rocker) = (1.0 / k1, 1.0 / k2);
    let coupler = (1.0 + crank * crank + rocker * rocker - 2.0 * crank * rocker * k3).sqrt();
    let options = FunctionOptions {
        input_start_deg: Some(30.0),
        output_start: Some(240.0),
        ..options(FOUR_BAR, FunctionMethod::Points(3))
    };
    let found = find(&target, &options);
    assert_eq!((found.solutions, found.left_out.len()), (Some(1), 0), "{found:?}");
    let answer = &found.answers[0];
    for (name, length) in [("frame", 1.0), ("crank", crank), ("coupler", coupler), ("rocker", rocker)] {
        assert!((dimension(answer, name) - length.abs()).abs() < 1e-9, "{answer:?} {name} {length}");
    }
    // A negative length is a link that points the opposite way.
    for (start, given, length) in [(answer.input_deg[0], 30.0, crank), (answer.output[0], 240.0, rocker)] {
        let expected = if length > 0.0 { given } else { given + 180.0 };
        assert!((start - expected).abs() < 1e-9, "{start} {expected}");
    }
    for [input, _] in points {
        let expected = answer.input_deg[0] + trig::degrees(input) - 30.0;
        assert!(answer.error.zeros.iter().any(|zero| (zero - expected).abs() < 1e-6), "{answer:?} {expected}");
    }
}

#[test]
fn the_error_is_that_of_a_motion_that_is_followed() {
    for (kind, range) in [(FOUR_BAR, 90.0), (SLIDER_CRANK, 40.0)] {
        let target = law("log10(x)", [1.0, 10.0], 60.0, range, kind == SLIDER_CRANK);
        for method in [FunctionMethod::Points(4), FunctionMethod::LeastSquares, FunctionMethod::Minimax] {
            let found = find(&target, &FunctionOptions { max_ratio: 20.0, ..options(kind, method) });
            let answer = &found.answers[0];
            let unit = if kind == FOUR_BAR { trig::radians(1.0) } else { 1.0 };
            const STEPS: usize = 3000;
            let inputs: Vec<f64> =
                (0..=STEPS).map(|k| trig::radians(answer.input_deg[0] + 60.0 * k as f64 / STEPS as f64)).collect();
            let first = unit * (answer.output[0] + answer.generated(0.0));
            let outputs = Linkage::of(answer).follow(&inputs, first).unwrap();
            let mut squares = 0.0;
            let mut greatest: f64 = 0.0;
            for (k, output) in outputs.iter().enumerate() {
                let x = 1.0 + 9.0 * k as f64 / STEPS as f64;
                let error = output / unit - answer.output[0] - range * trig::log10(x);
                let weight = if k == 0 || k == STEPS { 0.5 } else { 1.0 };
                squares += weight * error * error / STEPS as f64;
                greatest = greatest.max(error.abs());
            }
            let rms = squares.sqrt();
            assert!((answer.error.rms - rms).abs() < 1e-4 * rms, "{method:?}: {} {rms}", answer.error.rms);
            let own = answer.error.greatest.abs();
            assert!(own >= greatest - 1e-9 && own < greatest + 1e-4 * own, "{method:?}: {own} {greatest}");
        }
    }
}

#[test]
fn many_rows_of_a_linkage_are_met_exactly() {
    for kind in [FOUR_BAR, SLIDER_CRANK] {
        let mut random = Random(13);
        let mut exact = 0;
        for _ in 0..20 {
            let (_, _, rows) = random_rows(&mut random, kind, 25);
            let target = FunctionTarget::rows(&rows, kind == SLIDER_CRANK).unwrap();
            let found = find(&target, &options(kind, FunctionMethod::LeastSquares));
            let best = &found.answers[0];
            check_rows(best, &rows, 1e-2 + best.error.greatest.abs());
            exact += usize::from(best.error.greatest.abs() < 1e-6);
        }
        assert!(exact >= 19, "{kind:?}: {exact}");
    }
}

/// A least greatest error of five unknowns has six extremes of one magnitude and alternating sign, and no linkage nearby has less.
#[test]
fn the_least_greatest_error_alternates_and_cannot_be_lessened_nearby() {
    for (kind, range) in [(FOUR_BAR, 90.0), (SLIDER_CRANK, 2.0)] {
        let target = law("log10(x)", [1.0, 10.0], 60.0, range, kind == SLIDER_CRANK);
        let minimax = find(&target, &FunctionOptions { max_ratio: 20.0, ..options(kind, FunctionMethod::Minimax) });
        let squares =
            find(&target, &FunctionOptions { max_ratio: 20.0, ..options(kind, FunctionMethod::LeastSquares) });
        let [best, mean] = [&minimax, &squares].map(|found| &found.answers[0]);
        let greatest = best.error.greatest.abs();
        assert!(greatest < mean.error.greatest.abs() && best.error.rms > mean.error.rms);
        let error = |travel: f64| best.generated(travel) - range * trig::log10(1.0 + 9.0 * travel / 60.0);
        let mut extremes: Vec<f64> = Vec::new();
        for k in 0..=6000 {
            let here = error(f64::from(k) / 100.0);
            match extremes.last_mut() {
                Some(last) if (*last < 0.0) == (here < 0.0) => {
                    if here.abs() > last.abs() {
                        *last = here;
                    }
                }
                _ => extremes.push(here),
            }
        }
        assert_eq!(extremes.len(), 6, "{extremes:?}");
        assert!(extremes.iter().all(|extreme| (extreme.abs() - greatest).abs() < 1e-3 * greatest), "{extremes:?}");
        // Random changes of all five unknowns.
        let mut random = Random(14);
        let linkage = Linkage::of(best);
        let unit = if kind == FOUR_BAR { trig::radians(1.0) } else { 1.0 };
        let starts = [trig::radians(best.input_deg[0]), unit * best.output[0]];
        for _ in 0..300 {
            let size = trig::exp(random.between(-9.0, -3.0));
            let lengths = linkage.lengths.map(|length| length * (1.0 + size * random.normal()));
            let moved = Linkage { lengths, ..linkage };
            let [input, output] = starts.map(|start| start + size * random.between(-1.0, 1.0));
            let inputs: Vec<f64> = (0..=200).map(|k| input + trig::radians(0.3 * f64::from(k))).collect();
            let Some(outputs) = moved.follow(&inputs, unit * (best.output[0] + best.generated(0.0))) else { continue };
            let wanted = |k: usize| unit * range * trig::log10(1.0 + 9.0 * k as f64 / 200.0);
            let most = outputs.iter().enumerate().map(|(k, there)| (there - output - wanted(k)).abs());
            let most = most.fold(0.0, f64::max) / unit;
            assert!(most > (1.0 - 5e-3) * greatest, "{moved:?} {most} {greatest}");
        }
    }
}

fn check_constraints(method: FunctionMethod) {
    let target = law("x^2", [0.0, 1.0], 80.0, 60.0, false);
    let condition = Condition::new(&FOUR_BAR.template(), "mu_worst_deg >= 30 and crank < 3").unwrap();
    let constrained = FunctionOptions {
        full_turn: true,
        max_ratio: 6.0,
        condition: Some(condition),
        most: 3,
        ..options(FOUR_BAR, method)
    };
    let found = find(&target, &constrained);
    assert!(!found.answers.is_empty(), "{method:?}: {found:?}");
    for answer in &found.answers {
        assert!(answer.is_full_turn && answer.ratio <= 6.0 && answer.mu_worst_deg >= 30.0, "{answer:?}");
        assert!(dimension(answer, "crank") < 3.0 && answer.family().is_some());
    }
    let never = Condition::new(&FOUR_BAR.template(), "mu_worst_deg > 90").unwrap();
    let found = find(&target, &FunctionOptions { condition: Some(never), ..constrained });
    assert!(found.answers.is_empty() && found.left_out[0].0 == LeftOut::Condition && found.left_out[0].1 > 0);
}

#[test]
fn constraints_hold_of_precision_points() {
    check_constraints(FunctionMethod::Points(3));
}

#[test]
fn constraints_hold_of_least_squares() {
    check_constraints(FunctionMethod::LeastSquares);
}

#[test]
#[ignore = "thorough"]
fn constraints_hold_of_the_least_greatest_error() {
    check_constraints(FunctionMethod::Minimax);
}

#[test]
fn rows_that_depend_on_each_other_are_told() {
    let rows: Vec<[f64; 2]> = (0..5).map(|k| [10.0 * f64::from(k * k), 10.0 * f64::from(k * k)]).collect();
    let target = FunctionTarget::rows(&rows, false).unwrap();
    let found = find(&target, &options(FOUR_BAR, FunctionMethod::Points(5)));
    assert!(found.is_degenerate && found.answers.is_empty(), "{found:?}");
}
