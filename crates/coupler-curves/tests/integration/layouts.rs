//! Linkages as they are, mirrored, turned and scaled.

use coupler_curves::geometry::{Point, trig};
use coupler_curves::linkage::{CircuitSelection, JointId, Linkage, LinkageBuilder, MotionOptions, Side};
use proptest::prelude::*;

/// How a linkage is laid on the plane.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    pub turn_deg: f64,
    pub is_mirrored: bool,
    pub scale: f64,
}

impl Layout {
    pub const PLAIN: Layout = Layout { turn_deg: 0.0, is_mirrored: false, scale: 1.0 };

    pub fn turned(turn_deg: f64) -> Layout {
        Layout { turn_deg, ..Layout::PLAIN }
    }

    pub const MIRRORED: Layout = Layout { is_mirrored: true, ..Layout::PLAIN };

    fn sign(self) -> f64 {
        if self.is_mirrored { -1.0 } else { 1.0 }
    }

    fn point(self, x: f64, y: f64) -> Point {
        let (cos, sin) = trig::cos_sin_deg(self.turn_deg);
        let (x, y) = (self.scale * x, self.scale * self.sign() * y);
        Point::new(cos * x - sin * y, sin * x + cos * y)
    }

    fn length(self, length: f64) -> f64 {
        self.scale * length
    }

    fn across(self, across: f64) -> f64 {
        self.scale * self.sign() * across
    }

    fn side(self) -> Side {
        if self.is_mirrored { Side::Right } else { Side::Left }
    }
}

/// The layouts in which a linkage has the same portions.
pub const LAYOUTS: [Layout; 5] = [
    Layout::PLAIN,
    Layout::MIRRORED,
    Layout { turn_deg: 77.0, is_mirrored: false, scale: 1.0 },
    Layout { turn_deg: 213.0, is_mirrored: true, scale: 1.0 },
    Layout { turn_deg: 0.0, is_mirrored: false, scale: 8.0 },
];

/// A linkage with one traced point, of which all circuits are searched for.
fn finish(builder: LinkageBuilder, traced: JointId) -> Linkage {
    let options = MotionOptions { circuits: CircuitSelection::All, ..MotionOptions::default() };
    builder.build(vec![traced], None, options).unwrap()
}

/// A four-bar and a point of its coupler.
pub fn four_bar(layout: Layout, [frame, crank, coupler, rocker]: [f64; 4], (along, across): (f64, f64)) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::origin());
    let c = builder.fixed("C", layout.point(frame, 0.0));
    let a = builder.crank("A", o, layout.length(crank)).unwrap();
    let lengths = [coupler, rocker].map(|length| layout.length(length));
    let b = builder.dyad("B", [a, c], lengths, layout.side()).unwrap();
    let m = builder.point("M", [a, b], layout.length(along), layout.across(across)).unwrap();
    finish(builder, m)
}

/// A point of a planet gear: the sum of a circle and one that is passed `ratio` times in a turn.
pub fn epicycle(layout: Layout, (radius, arm): (f64, f64), ratio: f64, phase_deg: f64) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::origin());
    let a = builder.crank("A", o, layout.length(radius)).unwrap();
    let phase = layout.sign() * phase_deg + (1.0 - ratio) * layout.turn_deg;
    let m = builder.gear("M", (a, layout.length(arm)), [ratio, 1.0], phase).unwrap();
    finish(builder, m)
}

/// The pin of a piston, on a line beside the pivot.
pub fn piston(layout: Layout, [crank, rod, offset]: [f64; 3]) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::origin());
    let guide = [0.0, 1.0].map(|x| layout.point(x, offset));
    let guide = [builder.fixed("G", guide[0]), builder.fixed("H", guide[1])];
    let a = builder.crank("A", o, layout.length(crank)).unwrap();
    let p = builder.slide("P", (a, layout.length(rod)), (guide, 0.0), layout.side()).unwrap();
    finish(builder, p)
}

/// A Scotch yoke with a crank of length 1.
pub fn scotch_yoke(layout: Layout) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::origin());
    let x = builder.fixed("X", layout.point(1.0, 0.0));
    let a = builder.crank("A", o, layout.length(1.0)).unwrap();
    let y = builder.yoke("Y", a, ([o, x], 0.0), 90.0).unwrap();
    finish(builder, y)
}

/// Dimensions of a Watt linkage: C, O A, A B, C B, D on the first link of the loop, G on the second, D E, G E, and M on D E.
#[derive(Clone, Copy, Debug)]
pub struct Watt {
    pub frame: f64,
    pub crank: f64,
    pub loop_lengths: [f64; 2],
    pub d: [f64; 2],
    pub second: [f64; 2],
    pub g: [f64; 2],
    pub m: [f64; 2],
}

impl Watt {
    /// Watt I: D on the crank's link, G on the coupler.
    pub fn first(self, layout: Layout) -> Linkage {
        let (mut builder, [o, _, a, b]) = self.first_loop(layout);
        let d = builder.point("D", [o, a], layout.length(self.d[0]), layout.across(self.d[1])).unwrap();
        let g = builder.point("G", [a, b], layout.length(self.g[0]), layout.across(self.g[1])).unwrap();
        self.second_loop(layout, builder, d, g)
    }

    /// Watt II: D on the rocker, and a second pivot for G.
    pub fn second(self, layout: Layout) -> Linkage {
        let (mut builder, [_, c, _, b]) = self.first_loop(layout);
        let d = builder.point("D", [c, b], layout.length(self.d[0]), layout.across(self.d[1])).unwrap();
        let q = builder.fixed("Q", layout.point(self.g[0], self.g[1]));
        self.second_loop(layout, builder, d, q)
    }

    fn first_loop(self, layout: Layout) -> (LinkageBuilder, [JointId; 4]) {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", Point::origin());
        let c = builder.fixed("C", layout.point(self.frame, 0.0));
        let a = builder.crank("A", o, layout.length(self.crank)).unwrap();
        let lengths = self.loop_lengths.map(|length| layout.length(length));
        let b = builder.dyad("B", [a, c], lengths, layout.side()).unwrap();
        (builder, [o, c, a, b])
    }

    fn second_loop(self, layout: Layout, mut builder: LinkageBuilder, d: JointId, g: JointId) -> Linkage {
        let e = builder.dyad("E", [d, g], self.second.map(|length| layout.length(length)), layout.side()).unwrap();
        let m = builder.point("M", [d, e], layout.length(self.m[0]), layout.across(self.m[1])).unwrap();
        if builder.set_output_link([g, e]).is_err() {
            builder.set_output_link([d, e]).unwrap();
        }
        finish(builder, m)
    }
}

/// A random Watt linkage, of lengths between 0.2 and 5 frames.
pub fn watt() -> impl Strategy<Value = Watt> {
    let length = || 0.2..5.0;
    let offset = || -3.0..3.0;
    let lengths = (length(), [length(), length()], [length(), length()]);
    (lengths, [offset(), offset()], [offset(), offset()], [offset(), offset()])
        .prop_map(|((crank, loop_lengths, second), d, g, m)| Watt { frame: 1.0, crank, loop_lengths, d, second, g, m })
}
