//! Quantities of a single sample: the further columns a family may ask of `points.csv`.

use crate::geometry::{Vector, cross, trig};
use crate::linkage::{FourBar, JointId, Linkage, Signs, Step};
use crate::motion::{Circuit, Instant, Jets};

/// A quantity of a traced joint, or of its linkage, at a sample.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    /// Its name.
    pub name: &'static str,
    /// What it is, with its unit and its source.
    pub definition: &'static str,
    take: fn(&Sample) -> f64,
}

/// A sample, and the joints of the linkage that have a part in McCarthy's formulas.
struct Sample<'a> {
    linkage: &'a Linkage,
    joint: JointId,
    jets: Jets,
    input: f64,
    signs: Signs,
}

/// Every column there is. Rates are to a radian of input, or to a unit of its length; unbounded ones are infinite.
pub const COLUMNS: [Column; 24] = [
    Column { name: "vx", definition: "velocity along x", take: |s| s.velocity().x },
    Column { name: "vy", definition: "velocity along y", take: |s| s.velocity().y },
    Column { name: "ax", definition: "acceleration along x", take: |s| s.acceleration().x },
    Column { name: "ay", definition: "acceleration along y", take: |s| s.acceleration().y },
    Column { name: "jx", definition: "jerk along x", take: |s| s.jets.jerk(s.joint).x },
    Column { name: "jy", definition: "jerk along y", take: |s| s.jets.jerk(s.joint).y },
    Column { name: "speed", definition: "magnitude of the velocity", take: |s| s.velocity().norm() },
    Column { name: "curvature", definition: "curvature of the path, positive to the left", take: |s| s.curvature() },
    Column {
        name: "curvature_rate",
        definition: "derivative of the curvature by arc length",
        take: |s| s.curvature_rate(),
    },
    Column {
        name: "pole_x",
        definition: "instant centre of the point's link, on the fixed centrode",
        take: |s| s.instant(|i| i.pole.x),
    },
    Column {
        name: "pole_y",
        definition: "instant centre of the point's link, on the fixed centrode",
        take: |s| s.instant(|i| i.pole.y),
    },
    Column {
        name: "moving_pole_x",
        definition: "instant centre in the link's frame, on the moving centrode: along it",
        take: |s| s.instant(|i| i.moving_pole.x),
    },
    Column {
        name: "moving_pole_y",
        definition: "instant centre in the link's frame, on the moving centrode: to its left",
        take: |s| s.instant(|i| i.moving_pole.y),
    },
    Column {
        name: "inflection_x",
        definition: "inflection pole: on the inflection circle opposite the instant centre",
        take: |s| s.instant(|i| i.inflection_pole().x),
    },
    Column {
        name: "inflection_y",
        definition: "inflection pole: on the inflection circle opposite the instant centre",
        take: |s| s.instant(|i| i.inflection_pole().y),
    },
    Column { name: "psi_deg", definition: "output angle, deg: McCarthy (2.52), of a slot (2.45)", take: |s| s.psi() },
    Column { name: "phi_deg", definition: "coupler angle from the crank, deg: McCarthy (2.57)", take: |s| s.phi() },
    Column { name: "mu_deg", definition: "transmission angle, deg: McCarthy 2.3.3", take: |s| s.mu() },
    Column {
        name: "psi_ratio",
        definition: "angular velocity of the output to that of the input",
        take: |s| s.psi_ratio(),
    },
    Column {
        name: "phi_ratio",
        definition: "angular velocity of the coupler to that of the input",
        take: |s| s.phi_ratio(),
    },
    Column { name: "solvability", definition: "A^2 + B^2 - C^2: McCarthy (2.53)", take: |s| s.solvability() },
    Column { name: "s", definition: "slide of an inverted slider-crank: McCarthy (2.42)", take: |s| s.slide() },
    Column { name: "b", definition: "distance |CA| of an inverted slider-crank: McCarthy (2.40)", take: |s| s.b() },
    Column { name: "beta_deg", definition: "angle from CB to CA, deg: McCarthy (2.40)", take: |s| s.beta() },
];

/// The column of that name.
pub fn column(name: &str) -> Option<Column> {
    COLUMNS.into_iter().find(|column| column.name == name)
}

/// The columns' values at a sample of a joint's curve; not a number where one does not apply.
pub fn take_columns(
    columns: &[Column],
    linkage: &Linkage,
    (circuit, joint): (&Circuit, JointId),
    sample: usize,
) -> Vec<f64> {
    if columns.is_empty() {
        return Vec::new();
    }
    let (jets, input, signs) = (circuit.jets(linkage, sample), circuit.input[sample], circuit.signs(sample));
    let sample = Sample { linkage, joint, jets, input, signs };
    columns.iter().map(|column| (column.take)(&sample)).collect()
}

/// The joints of a four-bar: crank pivot, crank pin, rocker pin, rocker pivot.
struct Loop {
    o: JointId,
    a: JointId,
    b: JointId,
    c: JointId,
}

impl Sample<'_> {
    fn velocity(&self) -> Vector {
        self.jets.velocity(self.joint)
    }

    fn acceleration(&self) -> Vector {
        self.jets.acceleration(self.joint)
    }

    fn curvature(&self) -> f64 {
        let v = self.velocity();
        let speed = v.norm();
        cross(v, self.acceleration()) / (speed * speed * speed)
    }

    fn curvature_rate(&self) -> f64 {
        let (v, a, j) = (self.velocity(), self.acceleration(), self.jets.jerk(self.joint));
        let v2 = v.norm_squared();
        (cross(v, j) * v2 - 3.0 * cross(v, a) * v.dot(&a)) / (v2 * v2 * v2)
    }

    fn instant(&self, of: impl Fn(&Instant) -> f64) -> f64 {
        Instant::of_joint(self.linkage, &self.jets, self.joint).map_or(f64::NAN, |instant| of(&instant))
    }

    /// From one joint to another; as the linkage's own frame has it, but for a turn.
    fn between(&self, from: JointId, to: JointId) -> Vector {
        self.unmirrored(self.jets.place(to) - self.jets.place(from))
    }

    /// A linkage that is placed mirrored keeps its angles.
    fn unmirrored(&self, v: Vector) -> Vector {
        Vector::new(v.x, v.y * self.linkage.placement.handedness())
    }

    /// How fast the line between two joints turns, to a radian of input.
    fn turning(&self, from: JointId, to: JointId) -> f64 {
        let line = self.between(from, to);
        let velocity = self.unmirrored(self.jets.velocity(to) - self.jets.velocity(from));
        let ratio = cross(line, velocity) / line.norm_squared();
        if ratio.is_finite() { ratio } else { f64::INFINITY }
    }

    /// The crank's pivot and pin.
    fn crank(&self) -> Option<(JointId, JointId)> {
        self.linkage.joints.iter().enumerate().find_map(|(id, joint)| match joint.step {
            Step::Crank { pivot, .. } => Some((pivot, id)),
            _ => None,
        })
    }

    /// The four-bar as it stands on its frame; none seen from another link, where other angles have these names.
    fn four_bar(&self) -> Option<Loop> {
        FourBar::of(self.linkage).filter(|_| self.linkage.seen_from.is_none())?;
        let (o, a) = self.crank()?;
        self.linkage.joints.iter().enumerate().find_map(|(b, joint)| match joint.step {
            Step::Dyad { base: [p, q], .. } => Some(Loop { o, a, b, c: if p == a { q } else { p } }),
            _ => None,
        })
    }

    /// The inverted slider-crank: a slot on the crank's pin, or the actuator that drives it.
    fn slider(&self) -> Option<Slider> {
        if self.linkage.seen_from.is_some() {
            return None;
        }
        self.linkage.joints.iter().enumerate().find_map(|(id, joint)| match joint.step {
            Step::Slot { base: [c, a], offset, index } => {
                let (o, crank) = self.crank()?;
                // McCarthy draws the foot to the right of C -> A: there the slide is positive.
                let arm = self.between(c, a);
                let side = -f64::from(self.signs.get(index)) * if offset < 0.0 { -1.0 } else { 1.0 };
                let slide = side * (arm.norm_squared() - offset * offset).max(0.0).sqrt();
                let rate = arm.dot(&self.unmirrored(self.jets.velocity(a) - self.jets.velocity(c))) / slide;
                (a == crank).then_some(Slider { o, a, c, offset: offset.abs(), slide, rate })
            }
            Step::Piston { base: [c, o], offset, .. } => {
                Some(Slider { o, a: id, c, offset, slide: self.input, rate: 1.0 })
            }
            _ => None,
        })
    }

    fn psi(&self) -> f64 {
        let of_slider = |s: Slider| {
            let angle = signed_angle(self.between(s.o, s.c), self.between(s.c, s.a)) - s.beta();
            // From -180 to 180, as the other angles are.
            angle - 360.0 * (angle / 360.0).round()
        };
        let of_rocker = |l: Loop| signed_angle(self.between(l.o, l.c), self.between(l.c, l.b));
        self.four_bar().map(of_rocker).or_else(|| self.slider().map(of_slider)).unwrap_or(f64::NAN)
    }

    fn phi(&self) -> f64 {
        self.four_bar().map_or(f64::NAN, |l| signed_angle(self.between(l.o, l.a), self.between(l.a, l.b)))
    }

    fn mu(&self) -> f64 {
        self.four_bar().map_or(f64::NAN, |l| signed_angle(self.between(l.b, l.a), self.between(l.b, l.c)).abs())
    }

    fn psi_ratio(&self) -> f64 {
        // As psi is C-A's angle less beta, whose rate is e s' / b^2.
        let of_slider = |s: Slider| {
            let ratio = self.turning(s.c, s.a) - s.offset * s.rate / self.between(s.c, s.a).norm_squared();
            if ratio.is_finite() { ratio } else { f64::INFINITY }
        };
        let of_rocker = |l: Loop| self.turning(l.c, l.b);
        self.four_bar().map(of_rocker).or_else(|| self.slider().map(of_slider)).unwrap_or(f64::NAN)
    }

    fn phi_ratio(&self) -> f64 {
        self.four_bar().map_or(f64::NAN, |l| self.turning(l.a, l.b))
    }

    fn solvability(&self) -> f64 {
        let (Some(l), Some(four_bar)) = (self.four_bar(), FourBar::of(self.linkage)) else { return f64::NAN };
        let (frame, crank) = (self.between(l.o, l.c), self.between(l.o, l.a));
        four_bar.solvability(trig::atan2(cross(frame, crank), frame.dot(&crank)))
    }

    fn slide(&self) -> f64 {
        self.slider().map_or(f64::NAN, |s| s.slide)
    }

    fn b(&self) -> f64 {
        self.slider().map_or(f64::NAN, |s| self.between(s.c, s.a).norm())
    }

    fn beta(&self) -> f64 {
        self.slider().map_or(f64::NAN, |s| s.beta())
    }
}

/// McCarthy's inverted slider-crank: the crank's pivot and pin, the pivot of the slider's line, its offset and its slide.
struct Slider {
    o: JointId,
    a: JointId,
    c: JointId,
    offset: f64,
    slide: f64,
    /// The rate of the slide.
    rate: f64,
}

impl Slider {
    /// (2.40): `b cos beta = e` and `b sin beta = s`.
    fn beta(&self) -> f64 {
        trig::degrees(trig::atan2(self.slide, self.offset))
    }
}

/// The angle from one direction to another, in degrees, from -180 to 180.
fn signed_angle(from: Vector, to: Vector) -> f64 {
    trig::degrees(trig::atan2(cross(from, to), from.dot(&to)))
}
