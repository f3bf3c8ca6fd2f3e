//! What keeps curves away from a path is named, and nothing of curves that four-bars draw.

use coupler_curves::geometry::{Point, trig};
use coupler_curves::linkage::FourBar;
use coupler_find::{Hindrance, Index, Options, Search, Target};

fn points(count: usize, point: impl Fn(f64) -> [f64; 2]) -> Vec<Point> {
    (0..count).map(|k| point(k as f64 / count as f64).into()).collect()
}

/// A polyline through corners, with points between them.
fn polyline(corners: &[[f64; 2]]) -> Vec<Point> {
    let between = |pair: &[[f64; 2]]| {
        let [from, to] = [Point::from(pair[0]), Point::from(pair[1])];
        (0..20).map(move |k| from + (to - from) * (f64::from(k) / 20.0)).collect::<Vec<_>>()
    };
    corners.windows(2).flat_map(between).chain([Point::from(corners[corners.len() - 1])]).collect()
}

#[test]
fn corners_crossings_and_spirals_are_named() {
    let zigzag = polyline(&[
        [0.0, 0.0],
        [1.0, 3.0],
        [2.0, 0.0],
        [3.0, 3.0],
        [4.0, 0.0],
        [5.0, 3.0],
        [6.0, 0.0],
        [7.0, 3.0],
        [8.0, 0.0],
    ]);
    let found = Target::part(&zigzag).unwrap().hindrances(false);
    let Hindrance::Corners { count: 7, sharpest_deg } = found[0] else { panic!("{found:?}") };
    assert!((140.0..145.0).contains(&sharpest_deg), "{sharpest_deg}");
    assert_eq!(found[1], Hindrance::Meets { count: 8 });
    let spiral = points(100, |t| [t * trig::cos(20.0 * t), t * trig::sin(20.0 * t)]);
    let found = Target::part(&spiral).unwrap().hindrances(true);
    assert!(
        found.iter().any(|one| matches!(one, Hindrance::Spiral { turns } if (2.5..3.4).contains(turns))),
        "{found:?}"
    );
    assert_eq!(found.last(), Some(&Hindrance::Open));
    // A rose of five petals meets its centre, near which each crosses others.
    let star = points(200, |t| {
        let t = std::f64::consts::TAU * t;
        [3.0 * trig::cos(2.0 * t) + 2.0 * trig::cos(3.0 * t), 3.0 * trig::sin(2.0 * t) - 2.0 * trig::sin(3.0 * t)]
    });
    let found = Target::closed(&star).unwrap().hindrances(true);
    assert!(found.contains(&Hindrance::Crossings { count: 5 }), "{found:?}");
    let square = polyline(&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [0.0, 0.0]]);
    let [Hindrance::Corners { count: 4, sharpest_deg }] = Target::closed(&square).unwrap().hindrances(true)[..] else {
        panic!()
    };
    assert!((sharpest_deg - 90.0).abs() < 1e-6, "{sharpest_deg}");
}

#[test]
fn curves_of_four_bars_have_no_hindrance() {
    let eight = points(80, |t| [trig::sin(std::f64::consts::TAU * t), trig::sin(2.0 * std::f64::consts::TAU * t)]);
    let target = Target::closed(&eight).unwrap();
    assert_eq!(target.hindrances(true), []);
    let answers = Search::new(&target, Options { most: 3, ..Options::default() }).run(&Index::with_count(3000));
    let mut mechanism = answers[0].mechanism.clone();
    for (frame, crank, coupler, rocker, expected) in [
        (2.0, 2.0, 2.001, 2.0, Some("four equal links: change point")),
        (3.0, 1.0, 3.001, 1.0, Some("equal opposite links: change point")),
        (3.0, 3.0, 1.0, 1.001, Some("equal neighbouring links: change point")),
        (4.0, 1.0, 3.0, 2.001, Some("all but a change point")),
        (4.0, 1e-4, 3.0, 2.5, Some("a link without length")),
        (4.0, 1.0, 3.0, 2.5, None),
    ] {
        mechanism.four_bar.lengths = FourBar { frame, crank, coupler, rocker };
        assert_eq!(mechanism.degeneracy(), expected, "{frame} {crank} {coupler} {rocker}");
    }
    let ellipse =
        points(60, |t| [4.0 * trig::cos(std::f64::consts::TAU * t), 2.0 * trig::sin(std::f64::consts::TAU * t)]);
    assert_eq!(Target::closed(&ellipse).unwrap().hindrances(true), []);
}
