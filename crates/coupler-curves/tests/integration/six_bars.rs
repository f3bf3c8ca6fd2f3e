//! The kinds of six-bars.

use coupler_curves::linkage::{
    JointId, KinematicChain, Link, Linkage, LinkageBuilder, MotionOptions, Side::Left, Side::Right, SixBar,
};

use crate::catalogue::default_linkage;

fn kind(linkage: &Linkage) -> Option<SixBar> {
    KinematicChain::from_linkage(linkage)?.six_bar()
}

/// The linkage seen from the link with two of its joints.
fn seen_from(linkage: &Linkage, joints: [&str; 2]) -> Linkage {
    let seen_from = joints.map(|name| linkage.find_joint(name).unwrap());
    Linkage { seen_from: Some(seen_from), ..linkage.clone() }
}

fn build(builder: LinkageBuilder, traced: JointId) -> Linkage {
    builder.build(vec![traced], None, MotionOptions::default()).unwrap()
}

#[test]
fn the_six_bars_of_the_catalogue_are_named() {
    let named: Vec<(&str, &str)> = coupler_curves::catalogue::all()
        .iter()
        .filter(|template| template.parameters.iter().all(|parameter| parameter.default.is_some()))
        .filter_map(|template| Some((template.id.as_str(), kind(&default_linkage(&template.id))?.name())))
        .collect();
    let expected = [
        ("excavator", "Watt II"),
        ("hart-inversor", "Watt I"),
        ("klann", "Stephenson III"),
        ("shaper", "Watt II"),
        ("stephenson-i-six-bar", "Stephenson I"),
        ("stephenson-ii-six-bar", "Stephenson II"),
        ("stephenson-ii-six-bar-by-binary", "Stephenson II"),
        ("stephenson-iii-six-bar-by-binary", "Stephenson III"),
        ("stephenson-six-bar", "Stephenson III"),
        ("toggle-press", "Watt II"),
        ("watt-i-six-bar", "Watt I"),
        ("watt-i-six-bar-by-ternary", "Watt I"),
        ("watt-ii-six-bar-by-ternary", "Watt II"),
        ("watt-six-bar", "Watt II"),
        ("whitworth", "Watt II"),
    ];
    let mut sorted = named.clone();
    sorted.sort_unstable();
    assert_eq!(sorted, expected);
}

/// The inputs of a chain that differ are between the frame and its neighbours; for these six-bars the crank is a ternary link or a
/// binary one, and the four-bar that it drives has the frame in common with it.
#[test]
fn the_cranks_of_the_six_bars_are_binary_or_ternary() {
    for (id, degree) in [
        ("watt-i-six-bar", 2),
        ("watt-i-six-bar-by-ternary", 3),
        ("watt-six-bar", 2),
        ("watt-ii-six-bar-by-ternary", 3),
        ("stephenson-i-six-bar", 3),
        ("stephenson-ii-six-bar", 3),
        ("stephenson-ii-six-bar-by-binary", 2),
        ("stephenson-iii-six-bar-by-binary", 2),
        ("stephenson-six-bar", 2),
    ] {
        let linkage = default_linkage(id);
        let crank = linkage.crank().unwrap();
        let has = |link: &Link| crank.iter().all(|&joint| link.position(joint).is_some());
        let crank = linkage.links.iter().position(has).unwrap();
        let chain = KinematicChain::from_linkage(&linkage).unwrap();
        assert_eq!(chain.joints.iter().flatten().filter(|&&link| link == crank).count(), degree, "{id}");
    }
}

#[test]
fn every_inversion_has_its_number() {
    let stephenson = default_linkage("stephenson-six-bar");
    for (ground, expected) in [
        (["O", "C"], SixBar::StephensonIII),
        (["A", "B"], SixBar::StephensonIII),
        (["O", "A"], SixBar::StephensonI),
        (["C", "B"], SixBar::StephensonI),
        (["D", "E"], SixBar::StephensonII),
        (["Q", "E"], SixBar::StephensonII),
    ] {
        assert_eq!(kind(&seen_from(&stephenson, ground)), Some(expected), "{ground:?}");
    }
    let watt = default_linkage("watt-six-bar");
    for (ground, expected) in [
        (["O", "C"], SixBar::WattII),
        (["C", "D"], SixBar::WattII),
        (["O", "A"], SixBar::WattI),
        (["A", "B"], SixBar::WattI),
        (["D", "M"], SixBar::WattI),
        (["Q", "E"], SixBar::WattI),
    ] {
        assert_eq!(kind(&seen_from(&watt, ground)), Some(expected), "{ground:?}");
    }
}

/// A four-bar with the joints O, C, A and B, and then a part that is added to it.
fn four_bar_and(add: impl FnOnce(&mut LinkageBuilder, [JointId; 4]) -> JointId) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let [o, c] = [("O", 0.0), ("C", 4.0)].map(|(name, x)| builder.fixed(name, [x, 0.0].into()));
    let a = builder.crank("A", o, 1.0).unwrap();
    let b = builder.dyad("B", [a, c], [3.0, 3.5], Left).unwrap();
    let traced = add(&mut builder, [o, c, a, b]);
    build(builder, traced)
}

#[test]
fn sliders_are_joints() {
    // A slider on the frame, driven by a point of the rocker or of the coupler.
    let slider = |at: &dyn Fn(&mut LinkageBuilder, [JointId; 4]) -> JointId| {
        four_bar_and(|builder, pins @ [o, c, ..]| {
            let from = at(builder, pins);
            builder.slide("E", (from, 5.0), ([o, c], -1.0), Left).unwrap()
        })
    };
    let by_rocker = slider(&|builder, [_, c, _, b]| builder.point("D", [c, b], 2.0, 1.0).unwrap());
    let by_coupler = slider(&|builder, [_, _, a, b]| builder.point("D", [a, b], 2.0, 1.0).unwrap());
    assert_eq!([kind(&by_rocker), kind(&by_coupler)], [Some(SixBar::WattII), Some(SixBar::StephensonIII)]);
    // Three links on one pin: the rocker is nearest to the frame.
    assert_eq!(kind(&slider(&|_, [_, _, _, b]| b)), Some(SixBar::WattII));
    // Driven by the crank pin, which the crank carries.
    assert_eq!(kind(&slider(&|_, [_, _, a, _]| a)), Some(SixBar::WattII));
    // A slider on the coupler.
    let on_coupler = four_bar_and(|builder, [_, _, a, b]| {
        let q = builder.fixed("Q", [0.0, 5.0].into());
        let e = builder.slide("E", (q, 4.0), ([a, b], 0.0), Left).unwrap();
        builder.point("M", [e, b], 1.0, 1.0).unwrap()
    });
    assert_eq!(kind(&on_coupler), Some(SixBar::StephensonIII));
}

#[test]
fn blocks_in_slots_and_rods_of_actuators_are_links() {
    // The shaper's quick return: a block on the crank pin slides along a lever, whose end drives the ram.
    for offset in [0.0, 0.5] {
        let mut builder = LinkageBuilder::default();
        let [o, c] = [("O", 2.0), ("C", 0.0)].map(|(name, y)| builder.fixed(name, [0.0, y].into()));
        let x = builder.fixed("X", [1.0, 0.0].into());
        let a = builder.crank("A", o, 1.0).unwrap();
        builder.slot("B", [c, a], offset, Right).unwrap();
        let d = builder.point("D", [c, a], 4.0, 0.0).unwrap();
        let e = builder.slide("E", (d, 2.0), ([c, x], 4.5), Left).unwrap();
        let linkage = build(builder, e);
        assert_eq!(KinematicChain::from_linkage(&linkage).unwrap().link_count, 6);
        assert_eq!(kind(&linkage), Some(SixBar::WattII), "offset {offset}");
    }
    // A block is one link, also where it has points.
    for offset in [0.0, 0.5] {
        let mut builder = LinkageBuilder::default();
        let [o, c] = [("O", 2.0), ("C", 0.0)].map(|(name, y)| builder.fixed(name, [0.0, y].into()));
        let a = builder.crank("A", o, 1.0).unwrap();
        builder.slot("B", [c, a], offset, Right).unwrap();
        let points = [("K", 0.5), ("M", 0.7)].map(|(name, along)| builder.point(name, [a, c], along, 0.1).unwrap());
        let chain = KinematicChain::from_linkage(&build(builder, points[0])).unwrap();
        assert_eq!((chain.link_count, chain.joints.len()), (4, 4), "offset {offset}");
    }
    // An actuator moves a crank, whose second pin drives a rocker: an excavator's bucket.
    let mut builder = LinkageBuilder::default();
    let fixed = [("O", 0.0, 0.0), ("C", 3.0, 0.0), ("Q", -2.0, 1.0)];
    let [o, c, q] = fixed.map(|(name, x, y)| builder.fixed(name, [x, y].into()));
    let a = builder.piston("A", [q, o], (1.0, 0.0), Left).unwrap();
    let d = builder.point("D", [o, a], 0.0, 1.5).unwrap();
    let e = builder.dyad("E", [d, c], [3.0, 2.0], Left).unwrap();
    assert_eq!(kind(&build(builder, e)), Some(SixBar::WattII));
    // A yoke has its block as a further link: with the crank and the frame these are four links.
    let yoke = default_linkage("scotch-yoke");
    let chain = KinematicChain::from_linkage(&yoke).unwrap();
    assert_eq!((chain.link_count, chain.joints.len()), (4, 4));
    for id in ["slider-crank", "inverted-slider-crank", "linear-actuator", "hoeken"] {
        let chain = KinematicChain::from_linkage(&default_linkage(id)).unwrap();
        assert_eq!((chain.link_count, chain.joints.len()), (4, 4), "{id}");
    }
    assert_eq!(KinematicChain::from_linkage(&default_linkage("geared-five-bar")), None);
}

#[test]
fn points_that_join_no_links_do_not_count() {
    let linkage = four_bar_and(|builder, [o, c, a, b]| {
        let d = builder.point("D", [a, b], 1.0, 2.0).unwrap();
        let q = builder.fixed("Q", [2.0, 5.0].into());
        // Points of the frame, of the coupler and of the new link; a dyad on one link is a point of it.
        builder.point("P", [o, c], 1.0, 1.0).unwrap();
        builder.dyad("N", [a, d], [2.0, 2.0], Left).unwrap();
        let e = builder.dyad("E", [d, q], [3.0, 3.0], Left).unwrap();
        builder.point("M", [d, e], 1.0, 1.0).unwrap()
    });
    assert_eq!(kind(&linkage), Some(SixBar::StephensonIII));
    // Two four-bars on one crank pin: the crank carries both couplers, and is joined to the frame.
    let twin = four_bar_and(|builder, [_, _, a, _]| {
        let q = builder.fixed("Q", [-4.0, 0.0].into());
        builder.dyad("E", [a, q], [3.0, 3.5], Left).unwrap()
    });
    assert_eq!(kind(&twin), Some(SixBar::WattII));
    // With a further dyad it has eight links.
    let eight = four_bar_and(|builder, [_, _, a, b]| {
        let [q, s] = [("Q", -4.0), ("S", 8.0)].map(|(name, x)| builder.fixed(name, [x, 0.0].into()));
        builder.dyad("E", [a, q], [3.0, 3.5], Left).unwrap();
        builder.dyad("F", [b, s], [3.0, 3.5], Left).unwrap()
    });
    assert_eq!(kind(&eight), None);
}
