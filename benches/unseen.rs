//! Compares the answers of `find` for random targets of many laws with the best that is known of each: `cargo bench --bench unseen`.
//!
//! The targets are made, not stored: another `SEED=` has targets that no search has been tuned for. `COUNT=` is how many there are of each law,
//! `LAW=` a part of the name of the laws. What is known of a target is the linkage that made it, if one did, and the answers of `LONG=` long
//! searches: thorough ones, in four times as many curves, for the target, for it with fewer constraints, and from the answers to that. With
//! `KNOWN=FILE` the best that has been found is read from a file, and kept there, so that one version is compared with what others found. With
//! `LIST=1` each target has a line. `JOBS=` is the number of threads.

#[path = "../crates/coupler-find/tests/random/mod.rs"]
mod random;

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use coupler_curves::catalogue;
use coupler_curves::family::{Family, Sampling};
use coupler_curves::geometry::{Point, Vector, trig};
use coupler_curves::linkage::{FourBar, PlacedFourBar, Side};
use coupler_curves::measure::MeasureSet;
use coupler_curves::solve::Solver;
use coupler_curves::template::ParameterKind;
use coupler_find::{Effort, Index, Options, PathKind, Search, Target};
use random::Random;

/// A random target: its points, what is asked for, and the four-bar that made it.
struct Sought {
    points: Vec<Point>,
    kind: PathKind,
    options: Options,
    maker: Option<PlacedFourBar>,
}

/// What is known of a target: the deviation of the answer and of the best, in its size, and the seconds of the search.
struct Outcome {
    law: usize,
    number: usize,
    answer: Option<f64>,
    best: Option<f64>,
    seconds: f64,
}

impl Random {
    /// One of some values, each as likely as another.
    fn one_of<T: Copy>(&mut self, values: &[T]) -> T {
        values[((self.number() * values.len() as f64) as usize).min(values.len() - 1)]
    }

    /// Points at the parts of a round, at which `curve` has its points, at even or at uneven steps.
    fn around(&mut self, count: usize, unevenness: f64, curve: impl Fn(f64) -> Point) -> Vec<Point> {
        (0..count).map(|k| curve((k as f64 + unevenness * self.number()) / count as f64)).collect()
    }

    /// The points with normal errors, of this part of their size in the mean square.
    fn with_noise(&mut self, points: &[Point], noise: f64) -> Vec<Point> {
        let size = Target::new(points, PathKind::Open).map_or(1.0, |target| target.size());
        let mut error = || noise * size / 2f64.sqrt() * self.normal();
        points.iter().map(|p| p + Vector::new(error(), error())).collect()
    }
}

/// A law and its name.
type Law = (&'static str, fn(&mut Random) -> Sought);

const LAWS: [Law; 13] = [
    ("ellipses with harmonics", |random| {
        drawn(random, PathKind::Closed, |r| harmonics(r, &[0.0, 0.25, 0.12], 60, 0.0))
    }),
    ("Fourier curves", |random| {
        drawn(random, PathKind::Closed, |r| harmonics(r, &[0.3, 0.3, 0.2, 0.1, 0.05], 100, 0.0))
    }),
    ("few points of Fourier curves", |random| {
        drawn(random, PathKind::Closed, |r| {
            let count = r.one_of(&[12, 18, 25, 40]);
            harmonics(r, &[0.2, 0.3, 0.15, 0.08], count, 0.8)
        })
    }),
    ("polygons", |random| drawn(random, PathKind::Closed, polygon)),
    ("splines through random points", |random| drawn(random, PathKind::Closed, spline)),
    ("letters", |random| drawn(random, PathKind::Open, letter)),
    ("curves of six-bars", |random| drawn(random, PathKind::Closed, six_bar)),
    ("a hundred points of four-bars", |random| of_four_bar(random, PathKind::Closed, &[100], &[0.0])),
    ("few points of four-bars", |random| of_four_bar(random, PathKind::Closed, &[18, 25, 40, 60, 140], &[0.0])),
    ("few points of four-bars, with noise", |random| {
        of_four_bar(random, PathKind::Closed, &[18, 25, 40, 60, 140], &[0.01, 0.02, 0.05])
    }),
    ("parts of curves of four-bars", |random| of_four_bar(random, PathKind::Part, &[20, 40, 80], &[0.0])),
    ("parts, with noise", |random| of_four_bar(random, PathKind::Part, &[20, 40, 80], &[0.01, 0.02, 0.05])),
    ("precision points", |random| of_four_bar(random, PathKind::Open, &[9, 12, 18], &[0.0, 0.02])),
];

/// A drawn path with one of the usual constraints.
fn drawn(random: &mut Random, kind: PathKind, points: impl Fn(&mut Random) -> Vec<Point>) -> Sought {
    let full_turn = random.number() < 0.5;
    let max_link = random.one_of(&[10.0, 10.0, f64::INFINITY]);
    let options = Options { full_turn, max_link, ..Options::default() };
    Sought { points: points(random), kind, options, maker: None }
}

/// Points of an ellipse with further harmonics of the orders 2, 3, … and -2, -3, …, given by their greatest amplitudes.
fn harmonics(random: &mut Random, amplitudes: &[f64], count: usize, unevenness: f64) -> Vec<Point> {
    let mut terms = vec![(1.0, 1.0, 0.0), (-1.0, random.between(-0.8, 0.8), 0.0)];
    for (amplitude, order) in amplitudes.iter().zip(2..) {
        for order in [f64::from(order), -f64::from(order)] {
            let amplitude = amplitude * random.between(-1.0, 1.0);
            terms.push((order, amplitude, random.between(0.0, TAU)));
        }
    }
    let at = |part: f64| {
        let turned = |(order, amplitude, phase): &(f64, f64, f64)| {
            let angle = TAU * order * part + phase;
            Vector::new(trig::cos(angle), trig::sin(angle)) * *amplitude
        };
        Point::origin() + terms.iter().map(turned).sum::<Vector>()
    };
    random.around(count, unevenness, at)
}

/// Points of a polygon of three to six corners.
fn polygon(random: &mut Random) -> Vec<Point> {
    let corners = random.one_of(&[3, 4, 4, 5, 6]);
    let corner =
        |part: f64, radius: f64| Point::new(radius * trig::cos(TAU * part), 0.7 * radius * trig::sin(TAU * part));
    let mut outline: Vec<Point> = (0..corners)
        .map(|k| corner((k as f64 + random.between(0.0, 0.7)) / corners as f64, random.between(0.5, 1.5)))
        .collect();
    outline.push(outline[0]);
    let count = random.one_of(&[30, 72]);
    along(&outline, count + 1)[..count].to_vec()
}

/// Points at equal distances along a polyline, with both ends.
fn along(corners: &[Point], count: usize) -> Vec<Point> {
    let lengths: Vec<f64> = corners.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
    let step = lengths.iter().sum::<f64>() / (count - 1) as f64;
    let at = |k: usize| {
        let (mut left, mut segment) = (step * k as f64, 0);
        while segment + 1 < lengths.len() && left > lengths[segment] {
            left -= lengths[segment];
            segment += 1;
        }
        corners[segment] + (corners[segment + 1] - corners[segment]) * (left / lengths[segment])
    };
    (0..count).map(at).collect()
}

/// Points of the closed cubic through five to eight random points (Catmull and Rom).
fn spline(random: &mut Random) -> Vec<Point> {
    let knots = random.one_of(&[5, 6, 8]);
    let knot = |part: f64, radius: f64| Point::new(radius * trig::cos(TAU * part), radius * trig::sin(TAU * part));
    let knots: Vec<Point> = (0..knots)
        .map(|k| knot((k as f64 + random.between(-0.4, 0.4)) / knots as f64, random.between(0.5, 1.5)))
        .collect();
    let at = |part: f64| {
        let (whole, t) = ((part * knots.len() as f64) as usize, (part * knots.len() as f64).fract());
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| knots[(whole + k) % knots.len()].coords);
        let slopes = [(c - a) * 0.5, (d - b) * 0.5];
        let cubic = b * (1.0 + t * t * (2.0 * t - 3.0))
            + c * (t * t * (3.0 - 2.0 * t))
            + slopes[0] * (t * (1.0 - t) * (1.0 - t))
            - slopes[1] * (t * t * (1.0 - t));
        Point::from(cubic)
    };
    let count = random.one_of(&[25, 60, 100]);
    random.around(count, 0.0, at)
}

/// Points of a stroke like a letter, sheared and as wide as may be.
fn letter(random: &mut Random) -> Vec<Point> {
    const LETTERS: [&[(f64, f64)]; 8] = [
        &[(0.0, 2.0), (0.0, 0.0), (1.0, 0.0)],
        &[(0.0, 2.0), (0.5, 0.0), (1.0, 2.0)],
        &[(0.0, 0.0), (0.0, 2.0), (1.0, 0.0), (1.0, 2.0)],
        &[(0.0, 2.0), (1.0, 2.0), (0.0, 0.0), (1.0, 0.0)],
        &[(0.0, 0.0), (0.0, 2.0), (0.5, 1.0), (1.0, 2.0), (1.0, 0.0)],
        &[(0.0, 2.0), (0.0, 0.5), (0.2, 0.1), (0.5, 0.0), (0.8, 0.1), (1.0, 0.5), (1.0, 2.0)],
        &[(1.0, 1.7), (0.7, 2.0), (0.3, 2.0), (0.0, 1.5), (0.0, 0.5), (0.3, 0.0), (0.7, 0.0), (1.0, 0.3)],
        &[(1.0, 1.8), (0.5, 2.0), (0.0, 1.6), (0.2, 1.2), (0.8, 0.8), (1.0, 0.4), (0.5, 0.0), (0.0, 0.2)],
    ];
    let (width, shear) = (random.between(0.6, 2.0), random.between(-0.4, 0.4));
    let corners: Vec<Point> =
        random.one_of(&LETTERS).iter().map(|(x, y)| Point::new(width * x + shear * y, *y)).collect();
    let count = random.one_of(&[11, 25, 61]);
    along(&corners, count)
}

/// A closed curve of a linkage of the catalogue with more links than four, with dimensions around its defaults.
fn six_bar(random: &mut Random) -> Vec<Point> {
    const LINKAGES: [&str; 4] = ["watt-six-bar", "stephenson-six-bar", "geared-five-bar", "klann"];
    let template = catalogue::find(random.one_of(&LINKAGES)).expect("it is in the catalogue");
    loop {
        let required = template.parameters.iter().filter(|parameter| parameter.default.is_none());
        let examples = required.map(|parameter| (parameter.name.clone(), parameter.example.unwrap_or(1.0)));
        let family = Family::single_cell(template.clone(), &examples.collect::<Vec<_>>(), Sampling::Samples(24));
        let Ok(family) = family else { continue };
        let vary = |(parameter, value): (&coupler_curves::template::Parameter, &f64)| {
            let is_ratio = ["n", "m"].contains(&parameter.name.as_str());
            let is_varied = parameter.kind == ParameterKind::Length && parameter.min.is_some() && !is_ratio;
            (parameter.name.clone(), if is_varied { value * random.between(0.7, 1.4) } else { *value })
        };
        let given: Vec<(String, f64)> = template.parameters.iter().zip(&family.cell(0).values).map(vary).collect();
        let sampling = Sampling::ArcLength(random.one_of(&[40, 100]));
        let Ok(family) = Family::single_cell(template.clone(), &given, sampling) else { continue };
        let Some(solved) = Solver::new(&family).measuring(MeasureSet::EMPTY).solve(0) else { continue };
        let Some(curve) = solved.curves.last() else { continue };
        let circuit = solved.circuit(curve);
        let points: Vec<Point> = circuit.points(curve.joint).collect();
        if circuit.is_closed && Target::new(&points, PathKind::Closed).is_ok() {
            return points;
        }
    }
}

/// The coupler point of a placed four-bar at an angle of the crank from the x-axis.
fn coupler_point(placed: &PlacedFourBar, side: Side, crank_angle: f64) -> Point {
    let PlacedFourBar { pivots: [o, c], lengths: FourBar { crank, coupler, rocker, .. }, coupler_point } = *placed;
    let a = o + Vector::new(trig::cos(crank_angle), trig::sin(crank_angle)) * crank;
    let diagonal = c - a;
    let along = (diagonal.norm_squared() + coupler * coupler - rocker * rocker) / (2.0 * diagonal.norm());
    let across = (coupler * coupler - along * along).max(0.0).sqrt() * if side == Side::Left { 1.0 } else { -1.0 };
    let unit = diagonal.normalize();
    let coupler_unit = (unit * along + Vector::new(-unit.y, unit.x) * across) / coupler;
    a + coupler_unit * coupler_point.x + Vector::new(-coupler_unit.y, coupler_unit.x) * coupler_point.y
}

/// Points of a random four-bar whose crank turns fully, at uneven steps of it: of its curve, or of a part of it.
fn of_four_bar(random: &mut Random, kind: PathKind, counts: &[usize], noises: &[f64]) -> Sought {
    loop {
        let [frame, crank, coupler, rocker] = std::array::from_fn(|_| random.between(0.2, 4.0));
        if (frame - crank).abs() < (coupler - rocker).abs() + 0.02 || frame + crank + 0.02 > coupler + rocker {
            continue;
        }
        let coupler_point_at = Vector::new(random.between(-4.0, 4.0), random.between(-4.0, 4.0));
        let lengths = FourBar { frame, crank, coupler, rocker };
        let pivots = [Point::origin(), Point::new(frame, 0.0)];
        let placed = PlacedFourBar { pivots, lengths, coupler_point: coupler_point_at };
        let side = random.one_of(&[Side::Left, Side::Right]);
        let (start, sign) = (random.number(), random.one_of(&[1.0, -1.0]));
        let turn = if kind == PathKind::Closed { 1.0 } else { random.between(0.2, 0.8) };
        let (count, noise) = (random.one_of(counts), random.one_of(noises));
        let at = |part: f64| coupler_point(&placed, side, TAU * (start + sign * turn * part));
        let clean = random.around(count, 0.7, at);
        let points = random.with_noise(&clean, noise);
        let max_link = random.one_of(&[10.0, f64::INFINITY]);
        let options = Options { full_turn: random.number() < 0.7, max_link, ..Options::default() };
        return Sought { points, kind, options, maker: Some(placed) };
    }
}

/// The least deviation of an answer, in sizes of the target.
fn least(search: Search, index: &Index) -> Option<f64> {
    search.run(index).first().map(|answer| answer.deviation.rms_relative)
}

/// The best that long searches find, each with a seed of its own.
fn long_searches(target: &Target, sought: &Sought, count: u64, index: &Index) -> Option<f64> {
    let own = |seed: u64| Options { seed, effort: Effort::Thorough, most: 30, ..sought.options.clone() };
    let from = |placed: &PlacedFourBar| {
        let options = Options { effort: Effort::Quick, most: 1, ..own(1) };
        least(Search::from_four_bar(target, options, placed), &Index::new())
    };
    let mut found: Vec<f64> = sought.maker.iter().filter_map(from).collect();
    for seed in 1..=count {
        let relaxed = [
            own(seed),
            Options { max_link: f64::INFINITY, ..own(seed) },
            Options { max_link: 0.4 * sought.options.max_link.min(10.0), ..own(seed) },
            Options { full_turn: false, ..own(seed) },
        ];
        let relaxed = relaxed.iter().enumerate().filter(|(k, options)| *k == 0 || **options != own(seed));
        for (k, options) in relaxed {
            let answers = Search::new(target, options.clone()).run(index);
            match k {
                0 => found.extend(answers.first().map(|answer| answer.deviation.rms_relative)),
                _ => {
                    let mechanisms = answers.iter().take(6).flat_map(|answer| answer.mechanisms());
                    found.extend(mechanisms.filter_map(|mechanism| from(&mechanism.four_bar)));
                }
            }
        }
    }
    found.into_iter().min_by(f64::total_cmp)
}

/// The seconds that this thread has had a processor, where the system tells it, and otherwise those that have passed.
fn seconds(begin: Instant) -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = text.split_whitespace().next().and_then(|word| word.parse::<f64>().ok());
    nanoseconds.map_or(begin.elapsed().as_secs_f64(), |nanoseconds| 1e-9 * nanoseconds)
}

/// The value of a variable, or another one where it is not set.
fn variable(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |value| value.parse().unwrap_or_else(|_| panic!("{name}={value} is no number")))
}

/// The value below which a part of sorted values is.
fn quantile(sorted: &[f64], part: f64) -> f64 {
    if sorted.is_empty() { f64::NAN } else { sorted[(part * (sorted.len() - 1) as f64).round() as usize] }
}

/// How often an answer is as near as the best, but for rounding, and a small one that is as good as exact.
fn ratio(answer: f64, best: f64) -> f64 {
    /// Deviations are compared from here on.
    const SMALL: f64 = 1e-4;
    answer.max(SMALL) / best.max(SMALL)
}

fn report(name: &str, outcomes: &[&Outcome]) {
    let mut ratios: Vec<f64> =
        outcomes.iter().filter_map(|outcome| Some(ratio(outcome.answer?, outcome.best?))).collect();
    ratios.sort_by(f64::total_cmp);
    let mut times: Vec<f64> = outcomes.iter().map(|outcome| outcome.seconds).collect();
    times.sort_by(f64::total_cmp);
    let missing = outcomes.iter().filter(|outcome| outcome.answer.is_none());
    let missed = missing.clone().filter(|outcome| outcome.best.is_some()).count();
    let worse = ratios.iter().filter(|ratio| **ratio > 1.02).count();
    println!(
        "{name:36} {:4} {:5} {:7} {:8} {:8.3} {:8.3} {:8.3} {:8.2} {:8.2}",
        outcomes.len(),
        worse,
        missing.count(),
        missed,
        quantile(&ratios, 0.5),
        quantile(&ratios, 0.9),
        quantile(&ratios, 1.0),
        quantile(&times, 0.5),
        quantile(&times, 1.0)
    );
}

fn main() {
    let [seed, count, long] = [("SEED", 1), ("COUNT", 12), ("LONG", 1)].map(|(name, value)| variable(name, value));
    let (jobs, is_listed) = (variable("JOBS", 1), variable("LIST", 0) > 0);
    let only = std::env::var("LAW").unwrap_or_default();
    let file = std::env::var("KNOWN").ok();
    let text = file.as_ref().and_then(|file| std::fs::read_to_string(file).ok()).unwrap_or_default();
    let line = |line: &str| {
        let (key, value) = line.rsplit_once('\t')?;
        Some((key.to_owned(), value.parse::<f64>().ok()?))
    };
    let known: BTreeMap<String, f64> = text.lines().filter_map(line).collect();
    let index = Index::with_count(Index::DEFAULT_COUNT);
    let long_index = if long > 0 { Index::with_count(4 * Index::DEFAULT_COUNT) } else { Index::new() };
    let laws: Vec<usize> = (0..LAWS.len()).filter(|law| LAWS[*law].0.contains(&only)).collect();
    let tasks: Vec<(usize, usize)> =
        laws.iter().flat_map(|law| (0..count as usize).map(|number| (*law, number))).collect();
    let key = |law: usize, number: usize| format!("{}\t{seed}\t{number}", LAWS[law].0);
    let (next, outcomes) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let work = || {
        while let Some(&(law, number)) = tasks.get(next.fetch_add(1, Ordering::Relaxed)) {
            // Each target is the same whichever others there are.
            let mut random = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ (1000 * law + number) as u64);
            (0..8).for_each(|_| _ = random.number());
            let sought = LAWS[law].1(&mut random);
            let Ok(target) = Target::new(&sought.points, sought.kind) else { continue };
            let begin = Instant::now();
            let before = seconds(begin);
            let answer = least(Search::new(&target, sought.options.clone()), &index);
            let seconds = seconds(begin) - before;
            let longer = long_searches(&target, &sought, long, &long_index);
            let all = [answer, longer, known.get(&key(law, number)).copied()];
            let best = all.into_iter().flatten().min_by(f64::total_cmp);
            if is_listed {
                let shown = |value: Option<f64>| value.map_or("none".to_owned(), |value| format!("{value:.6}"));
                println!(
                    "{} {number}: {} points, {:?}, {} links to {}, {} for {}, {seconds:.2} s",
                    LAWS[law].0,
                    sought.points.len(),
                    sought.kind,
                    if sought.options.full_turn { "crank," } else { "any," },
                    sought.options.max_link,
                    shown(answer),
                    shown(best)
                );
            }
            outcomes.lock().unwrap().push(Outcome { law, number, answer, best, seconds });
        }
    };
    std::thread::scope(|scope| (0..jobs).for_each(|_| _ = scope.spawn(work)));
    let mut outcomes: Vec<Outcome> = outcomes.into_inner().unwrap();
    outcomes.sort_by_key(|outcome| (outcome.law, outcome.number));
    println!("seed {seed}: the ratio of the answer's deviation to the best that is known, and the seconds of a search");
    println!(
        "{:36} {:>4} {:>5} {:>7} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}",
        "targets", "", ">1.02", "without", "of these", "median", "90 %", "worst", "median", "longest"
    );
    for law in laws {
        report(LAWS[law].0, &outcomes.iter().filter(|outcome| outcome.law == law).collect::<Vec<_>>());
    }
    report("all", &outcomes.iter().collect::<Vec<_>>());
    if let Some(file) = file {
        let mut known = known;
        let found = outcomes.iter().filter_map(|outcome| Some((key(outcome.law, outcome.number), outcome.best?)));
        known.extend(found);
        let lines: String = known.iter().map(|(key, value)| format!("{key}\t{value:e}\n")).collect();
        std::fs::write(&file, lines).unwrap_or_else(|error| panic!("{file}: {error}"));
    }
}
