//! Searches for curves of linkages with random dimensions, wherever they are; the benchmark `found` counts more of them.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use coupler_atlas::find::find_linkage;
use coupler_curves::catalogue;
use coupler_curves::family::{Family, Sampling};
use coupler_curves::geometry::{Point, trig};
use coupler_curves::measure::MeasureSet;
use coupler_curves::solve::{MeasuredCurve, Solver};
use coupler_curves::template::{ParameterKind, Template};
use coupler_find::{LinkageAnswer, LinkageSpace, Options, PathKind, Target};

#[expect(dead_code, reason = "others need normally distributed numbers")]
#[path = "../../../crates/coupler-find/tests/random/mod.rs"]
mod random;

pub use random::Random;

/// A linkage with its default dimensions, or those of its example where it has none.
pub fn with_defaults(template: &Arc<Template>, sampling: Sampling) -> Family {
    let required = template.parameters.iter().filter(|parameter| parameter.default.is_none());
    let values: Vec<(String, f64)> =
        required.map(|parameter| (parameter.name.clone(), parameter.example.unwrap_or(1.0))).collect();
    Family::single_cell(template.clone(), &values, sampling).unwrap()
}

/// The curve of a linkage with dimensions around its defaults: lengths 0.6 to 1.7 times as great, coordinates moved by up to 0.6 of the mean
/// length, angles anywhere. At most `count` points at equal distances; whether it is closed.
pub fn random_curve(
    template: &Arc<Template>,
    full_turn: bool,
    random: &mut Random,
    count: usize,
) -> (Vec<Point>, bool) {
    let family = with_defaults(template, Sampling::Samples(24));
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
                ParameterKind::Angle(_) => random.between(-180.0, 180.0),
                ParameterKind::Length if parameter.min.is_none() => value + mean * random.between(-0.6, 0.6),
                _ => value * random.between(0.6, 1.7),
            };
            (parameter.name.clone(), value)
        };
        let given: Vec<(String, f64)> = template.parameters.iter().zip(&base).map(vary).collect();
        let Ok(family) = Family::single_cell(template.clone(), &given, Sampling::ArcLength(count)) else { continue };
        let Some(solved) = Solver::new(&family).measuring(MeasureSet::EMPTY).solve(0) else { continue };
        // Other traced joints of some linkages move along lines.
        let is_point = |curve: &&MeasuredCurve| solved.linkage.joints[curve.joint.index()].name == "M";
        let Some(curve) = solved.curves.iter().find(is_point).or(solved.curves.last()) else { continue };
        let circuit = solved.circuit(curve);
        if circuit.is_closed && (circuit.is_full_turn() || !full_turn) {
            return (circuit.points(curve.joint).collect(), true);
        }
    }
    panic!("{} has no closed curve", template.id);
}

/// Points elsewhere, in another size and direction, mirrored or not.
pub fn placed(points: &[Point], random: &mut Random) -> Vec<Point> {
    let (scale, angle) = (random.between(0.1, 30.0), random.between(0.0, 6.3));
    let (x, y, mirror) = (random.between(-90.0, 90.0), random.between(-90.0, 90.0), random.number() < 0.5);
    let (cos, sin) = (scale * trig::cos(angle), scale * trig::sin(angle));
    let image = |p: &Point| {
        let own = if mirror { -p.y } else { p.y };
        Point::new(x + cos * p.x - sin * own, y + sin * p.x + cos * own)
    };
    points.iter().map(image).collect()
}

pub fn search(template: &Arc<Template>, points: &[Point], options: &Options) -> Vec<LinkageAnswer> {
    let target = Target::new(points, PathKind::Closed).unwrap();
    let space = LinkageSpace::new(template.clone(), &[]).unwrap();
    answers(&space, &target, options)
}

pub fn answers(space: &LinkageSpace, target: &Target, options: &Options) -> Vec<LinkageAnswer> {
    find_linkage(space, target, options, None, &AtomicBool::new(false), |_| ()).unwrap().answers
}

/// The least deviations of searches for random curves of a linkage, relative to the size of the path.
pub fn deviations(name: &str, full_turn: bool, count: usize, options: &Options) -> Vec<f64> {
    let template = catalogue::find(name).unwrap();
    let mut random = Random(17);
    let deviation = |_| {
        let points = placed(&random_curve(&template, full_turn, &mut random, 100).0, &mut random);
        let options = Options { full_turn, most: 1, ..options.clone() };
        search(&template, &points, &options)
            .first()
            .map_or(f64::INFINITY, |answer| answer.curve.fit.deviation.rms_relative)
    };
    (0..count).map(deviation).collect()
}
