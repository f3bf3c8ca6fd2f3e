//! `find --linkage`: curves of linkages with random dimensions are found again, wherever they are.

use std::sync::Arc;

use coupler_atlas::find::{LinkageAnswer, search_linkage};
use coupler_curves::catalogue;
use coupler_curves::family::{Family, Sampling};
use coupler_curves::find::{LinkageSpace, Options, PathKind, Target};
use coupler_curves::geometry::Point;
use coupler_curves::measure;
use coupler_curves::motion::Sampler;
use coupler_curves::solve::solve_measuring;
use coupler_curves::template::{ParameterKind, Template};

/// Random numbers from 0 to 1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

/// The curve of a linkage with dimensions around its defaults: lengths 0.6 to 1.7 times as great, coordinates moved by up to 0.6 of the mean
/// length, angles anywhere. At most `count` points at equal distances; whether it is closed.
fn random_curve(template: &Arc<Template>, full_turn: bool, random: &mut Random, count: usize) -> (Vec<Point>, bool) {
    let defaults: Vec<(String, f64)> = template
        .parameters
        .iter()
        .filter(|parameter| parameter.default.is_none())
        .map(|parameter| (parameter.name.clone(), parameter.example.unwrap_or(1.0)))
        .collect();
    let family = Family::single_cell(template.clone(), &defaults, Sampling::Samples(24)).unwrap();
    let base = family.cell(0).values;
    let lengths: Vec<f64> = template
        .parameters
        .iter()
        .zip(&base)
        .filter(|(parameter, _)| parameter.kind == ParameterKind::Length)
        .map(|(_, value)| value.abs())
        .collect();
    let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
    for _ in 0..10_000 {
        let vary = |(parameter, value): (&coupler_curves::template::Parameter, &f64)| {
            let value = match parameter.kind {
                _ if ["n", "m"].contains(&parameter.name.as_str()) && template.id == "geared-five-bar" => *value,
                ParameterKind::Angle(_) => random.within(-180.0, 180.0),
                ParameterKind::Length if parameter.min.is_none() => value + mean * random.within(-0.6, 0.6),
                _ => value * random.within(0.6, 1.7),
            };
            (parameter.name.clone(), value)
        };
        let given: Vec<(String, f64)> = template.parameters.iter().zip(&base).map(vary).collect();
        let Ok(family) = Family::single_cell(template.clone(), &given, Sampling::ArcLength(count)) else { continue };
        let requested = vec![false; measure::ALL.len()];
        let Some(solved) = solve_measuring(&family, &Sampler::new(family.sampling), 0, &requested) else { continue };
        let Some(curve) = solved.curves.last() else { continue };
        let circuit = solved.circuit(curve);
        if circuit.is_closed && (circuit.is_full_turn() || !full_turn) {
            return (circuit.points(curve.joint).collect(), true);
        }
    }
    panic!("{} has no closed curve", template.id);
}

/// Points elsewhere, in another size and direction, mirrored or not.
fn placed(points: &[Point], random: &mut Random) -> Vec<Point> {
    let (scale, angle) = (random.within(0.1, 30.0), random.within(0.0, 6.3));
    let (x, y, mirror) = (random.within(-90.0, 90.0), random.within(-90.0, 90.0), random.next() < 0.5);
    let (cos, sin) = (scale * angle.cos(), scale * angle.sin());
    let image = |p: &Point| {
        let own = if mirror { -p.y } else { p.y };
        Point::new(x + cos * p.x - sin * own, y + sin * p.x + cos * own)
    };
    points.iter().map(image).collect()
}

fn search(template: &Arc<Template>, points: &[Point], options: &Options) -> Vec<LinkageAnswer> {
    let target = Target::new(points, PathKind::Closed).unwrap();
    let space = LinkageSpace::new(template.clone(), &[]).unwrap();
    search_linkage(&space, &target, options, None).0
}

/// The built-in linkages, and whether their input turns fully.
const LINKAGES: [(&str, bool); 19] = [
    ("slider-crank", true),
    ("inverted-slider-crank", true),
    ("geared-five-bar", true),
    ("watt-six-bar", true),
    ("stephenson-six-bar", true),
    ("evans", true),
    ("hoeken", true),
    ("chebyshev", true),
    ("roberts", false),
    ("watt", false),
    ("scotch-yoke", true),
    ("pantograph", true),
    ("hrones-nelson", true),
    ("jansen", true),
    ("klann", true),
    ("cognates", true),
    ("peaucellier-lipkin", false),
    ("hart-inversor", false),
    ("linear-actuator", false),
];

#[test]
#[ignore = "measures twenty searches for each linkage, minutes"]
fn how_many_random_curves_are_found() {
    for (name, full_turn) in LINKAGES {
        if std::env::var("LINKAGE").is_ok_and(|only| only != name) {
            continue;
        }
        let template = catalogue::find(name).unwrap();
        let mut random = Random(17);
        let mut all: Vec<f64> = Vec::new();
        let begin = std::time::Instant::now();
        let count = std::env::var("COUNT").map_or(20, |count| count.parse().unwrap());
        for _ in 0..count {
            let points = random_curve(&template, full_turn, &mut random, 100).0;
            let points = placed(&points, &mut random);
            let answers = search(&template, &points, &Options { full_turn, most: 1, ..Options::default() });
            all.push(answers.first().map_or(f64::INFINITY, |answer| answer.curve.fit.rms_relative));
        }
        all.sort_by(f64::total_cmp);
        let found = all.iter().filter(|rms| **rms < 1e-3).count();
        let shown: Vec<String> = all.iter().map(|rms| format!("{rms:.1e}")).collect();
        println!("{name}: {found} of {}, {:.2} s each: {}", all.len(), begin.elapsed().as_secs_f64() / all.len() as f64, shown.join(" "));
    }
}
