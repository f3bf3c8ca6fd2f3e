//! Quantities of a single sample: the optional columns of `points.csv`.

use super::{Subject, torque};
use crate::geometry::{Vector, cross, curvature, trig};
use crate::linkage::{FourBar, JointId, JointKind, Linkage};
use crate::motion::{Circuit, InstantaneousMotion, JointDerivatives, Pass};

/// A quantity of a traced joint, or of its linkage, at a sample.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    /// Its name.
    pub name: &'static str,
    /// What it is in a few words, as on charts.
    pub title: &'static str,
    /// Its unit: `deg`, or `per radian` and the like for a derivative with respect to an input angle; empty for a length or
    /// a pure number.
    pub unit: &'static str,
    /// Its definition, with its unit and its source.
    pub definition: &'static str,
    /// The linkages that have it.
    pub subject: Subject,
    compute: fn(&Sample) -> f64,
}

impl Column {
    /// A column of every linkage.
    const fn new(
        name: &'static str,
        title: &'static str,
        definition: &'static str,
        compute: fn(&Sample) -> f64,
    ) -> Column {
        Column { name, title, unit: "", definition, subject: Subject::Any, compute }
    }

    /// The same column, in a unit.
    const fn in_unit(self, unit: &'static str) -> Column {
        Column { unit, ..self }
    }

    /// The same column, of these linkages only.
    const fn of(self, subject: Subject) -> Column {
        Column { subject, ..self }
    }
}

/// A sample of a joint's curve.
struct Sample<'a> {
    linkage: &'a Linkage,
    joint: JointId,
    derivatives: JointDerivatives,
    input: f64,
    pass: &'a Pass,
}

/// All columns. Derivatives are per radian of input, or per unit of length; unbounded ones are infinite.
pub static COLUMNS: [Column; 25] = [
    Column::new("vx", "velocity along x", "velocity along x", |s| s.velocity().x).in_unit("per radian"),
    Column::new("vy", "velocity along y", "velocity along y", |s| s.velocity().y).in_unit("per radian"),
    Column::new("ax", "acceleration along x", "acceleration along x", |s| s.acceleration().x).in_unit("per radian²"),
    Column::new("ay", "acceleration along y", "acceleration along y", |s| s.acceleration().y).in_unit("per radian²"),
    Column::new("jx", "jerk along x", "jerk along x", |s| s.derivatives.jerk(s.joint).x).in_unit("per radian³"),
    Column::new("jy", "jerk along y", "jerk along y", |s| s.derivatives.jerk(s.joint).y).in_unit("per radian³"),
    Column::new("speed", "speed", "magnitude of the velocity", |s| s.velocity().norm()).in_unit("per radian"),
    Column::new("curvature", "curvature", "curvature of the path, positive to the left", |s| s.curvature()),
    Column::new(
        "curvature_rate",
        "rate of the curvature along the curve",
        "derivative of the curvature with respect to arc length",
        |s| s.curvature_rate(),
    ),
    Column::new(
        "pole_x",
        "x of the instant centre",
        "instant centre of the point's link, on the fixed centrode",
        |s| s.instant_value(|i| i.pole.x),
    ),
    Column::new(
        "pole_y",
        "y of the instant centre",
        "instant centre of the point's link, on the fixed centrode",
        |s| s.instant_value(|i| i.pole.y),
    ),
    Column::new(
        "moving_pole_x",
        "instant centre along the link",
        "instant centre in the link's frame, on the moving centrode: along it",
        |s| s.instant_value(|i| i.moving_pole.x),
    ),
    Column::new(
        "moving_pole_y",
        "instant centre across the link",
        "instant centre in the link's frame, on the moving centrode: to its left",
        |s| s.instant_value(|i| i.moving_pole.y),
    ),
    Column::new(
        "inflection_x",
        "x of the inflection pole",
        "inflection pole: on the inflection circle opposite the instant centre",
        |s| s.instant_value(|i| i.inflection_pole().x),
    ),
    Column::new(
        "inflection_y",
        "y of the inflection pole",
        "inflection pole: on the inflection circle opposite the instant centre",
        |s| s.instant_value(|i| i.inflection_pole().y),
    ),
    Column::new(
        "torque",
        "input torque",
        "input torque against the load, or the force of an input that is a length, without friction and masses",
        |s| torque::input_torque(s.linkage, s.pass, &s.derivatives).unwrap_or(f64::NAN),
    )
    .of(Subject::WithLoad),
    Column::new("psi_deg", "output angle", "output angle, deg: McCarthy (2.52), of a slot (2.45)", |s| s.psi())
        .in_unit("deg")
        .of(Subject::FourBarOrInvertedSliderCrank),
    Column::new("phi_deg", "coupler angle", "coupler angle from the crank, deg: McCarthy (2.57)", |s| s.phi())
        .in_unit("deg")
        .of(Subject::FourBarOnFrame),
    Column::new("mu_deg", "transmission angle", "transmission angle, deg: McCarthy 2.3.3", |s| s.mu())
        .in_unit("deg")
        .of(Subject::FourBarOnFrame),
    Column::new(
        "psi_ratio",
        "angular velocity of the output over that of the input",
        "angular velocity of the output to that of the input",
        |s| s.psi_ratio(),
    )
    .of(Subject::FourBarOrInvertedSliderCrank),
    Column::new(
        "phi_ratio",
        "angular velocity of the coupler over that of the input",
        "angular velocity of the coupler to that of the input",
        |s| s.phi_ratio(),
    )
    .of(Subject::FourBarOnFrame),
    Column::new("solvability", "A² + B² − C²", "A^2 + B^2 - C^2: McCarthy (2.53)", |s| s.solvability())
        .of(Subject::FourBarOnFrame),
    Column::new("s", "slide", "slide of an inverted slider-crank: McCarthy (2.42)", |s| s.slide())
        .of(Subject::InvertedSliderCrank),
    Column::new("b", "distance from C to A", "distance |CA| of an inverted slider-crank: McCarthy (2.40)", |s| s.b())
        .of(Subject::InvertedSliderCrank),
    Column::new("beta_deg", "angle from CB to CA", "angle from CB to CA, deg: McCarthy (2.40)", |s| s.beta())
        .in_unit("deg")
        .of(Subject::InvertedSliderCrank),
];

/// The column of a name.
pub fn find_column(name: &str) -> Option<Column> {
    COLUMNS.into_iter().find(|column| column.name == name)
}

/// The values of columns at a sample of a joint's curve; NaN where a column does not apply.
pub fn compute_columns(
    columns: &[Column],
    linkage: &Linkage,
    circuit: &Circuit,
    joint: JointId,
    sample: usize,
) -> Vec<f64> {
    if columns.is_empty() {
        return Vec::new();
    }
    let (derivatives, input) = (circuit.derivatives(linkage, sample), circuit.inputs[sample]);
    let sample = Sample { linkage, joint, derivatives, input, pass: &circuit.passes[circuit.pass_at(sample)] };
    columns.iter().map(|column| (column.compute)(&sample)).collect()
}

/// The joints of a four-bar: crank pivot, crank pin, rocker pin, rocker pivot.
struct FourBarJoints {
    o: JointId,
    a: JointId,
    b: JointId,
    c: JointId,
}

impl Sample<'_> {
    fn velocity(&self) -> Vector {
        self.derivatives.velocity(self.joint)
    }

    fn acceleration(&self) -> Vector {
        self.derivatives.acceleration(self.joint)
    }

    fn curvature(&self) -> f64 {
        curvature(self.velocity(), self.acceleration())
    }

    fn curvature_rate(&self) -> f64 {
        let (v, a, j) = (self.velocity(), self.acceleration(), self.derivatives.jerk(self.joint));
        let v2 = v.norm_squared();
        (cross(v, j) * v2 - 3.0 * cross(v, a) * v.dot(&a)) / (v2 * v2 * v2)
    }

    fn instant_value(&self, value: impl Fn(&InstantaneousMotion) -> f64) -> f64 {
        InstantaneousMotion::from_joint(self.linkage, &self.derivatives, self.joint)
            .map_or(f64::NAN, |instant| value(&instant))
    }

    /// The vector from one joint to another, in the frame of the linkage apart from a rotation.
    fn vector(&self, from: JointId, to: JointId) -> Vector {
        self.without_mirroring(self.derivatives.position(to) - self.derivatives.position(from))
    }

    /// Undoes the mirroring of the linkage's placement, so that angles keep their signs.
    fn without_mirroring(&self, v: Vector) -> Vector {
        Vector::new(v.x, v.y * self.linkage.placement.handedness())
    }

    /// The angular velocity of the line between two joints, per radian of input.
    fn angular_velocity_ratio(&self, from: JointId, to: JointId) -> f64 {
        let line = self.vector(from, to);
        let velocity = self.without_mirroring(self.derivatives.velocity(to) - self.derivatives.velocity(from));
        let ratio = cross(line, velocity) / line.norm_squared();
        if ratio.is_finite() { ratio } else { f64::INFINITY }
    }

    /// The joints of a four-bar; `None` if it is seen from another link, because the angles of McCarthy's formulas are
    /// measured from the frame.
    fn four_bar_joints(&self) -> Option<FourBarJoints> {
        FourBar::from_linkage(self.linkage).filter(|_| self.linkage.seen_from.is_none())?;
        let [o, a] = self.linkage.crank()?;
        self.linkage.joint_ids().zip(&self.linkage.joints).find_map(|(b, joint)| match joint.kind {
            JointKind::Dyad { base: [p, q], .. } => Some(FourBarJoints { o, a, b, c: if p == a { q } else { p } }),
            _ => None,
        })
    }

    /// An inverted slider-crank: a slot on the crank's pin, or an actuator that drives the crank.
    fn inverted_slider_crank(&self) -> Option<InvertedSliderCrank> {
        if self.linkage.seen_from.is_some() {
            return None;
        }
        self.linkage.joint_ids().zip(&self.linkage.joints).find_map(|(id, joint)| match joint.kind {
            JointKind::Slot { base: [c, a], offset, dyad } => {
                let [o, crank] = self.linkage.crank()?;
                // McCarthy draws the foot to the right of C -> A: there the slide is positive.
                let arm = self.vector(c, a);
                let side = -f64::from(self.pass.mode.sign(dyad)) * if offset < 0.0 { -1.0 } else { 1.0 };
                let slide = side * (arm.norm_squared() - offset * offset).max(0.0).sqrt();
                let rate = arm
                    .dot(&self.without_mirroring(self.derivatives.velocity(a) - self.derivatives.velocity(c)))
                    / slide;
                (a == crank).then_some(InvertedSliderCrank { o, a, c, offset: offset.abs(), slide, slide_rate: rate })
            }
            JointKind::Piston { base: [c, o], offset, .. } => {
                Some(InvertedSliderCrank { o, a: id, c, offset, slide: self.input, slide_rate: 1.0 })
            }
            _ => None,
        })
    }

    fn psi(&self) -> f64 {
        let of_slider = |s: InvertedSliderCrank| {
            let angle = signed_angle(self.vector(s.o, s.c), self.vector(s.c, s.a)) - s.beta();
            // From -180 to 180, like the other angles.
            angle - 360.0 * (angle / 360.0).round()
        };
        let of_rocker = |l: FourBarJoints| signed_angle(self.vector(l.o, l.c), self.vector(l.c, l.b));
        self.four_bar_joints()
            .map(of_rocker)
            .or_else(|| self.inverted_slider_crank().map(of_slider))
            .unwrap_or(f64::NAN)
    }

    fn phi(&self) -> f64 {
        self.four_bar_joints().map_or(f64::NAN, |l| signed_angle(self.vector(l.o, l.a), self.vector(l.a, l.b)))
    }

    fn mu(&self) -> f64 {
        self.four_bar_joints().map_or(f64::NAN, |l| signed_angle(self.vector(l.b, l.a), self.vector(l.b, l.c)).abs())
    }

    fn psi_ratio(&self) -> f64 {
        // psi is the angle of C-A minus beta, and the derivative of beta is e s' / b^2.
        let of_slider = |s: InvertedSliderCrank| {
            let ratio =
                self.angular_velocity_ratio(s.c, s.a) - s.offset * s.slide_rate / self.vector(s.c, s.a).norm_squared();
            if ratio.is_finite() { ratio } else { f64::INFINITY }
        };
        let of_rocker = |l: FourBarJoints| self.angular_velocity_ratio(l.c, l.b);
        self.four_bar_joints()
            .map(of_rocker)
            .or_else(|| self.inverted_slider_crank().map(of_slider))
            .unwrap_or(f64::NAN)
    }

    fn phi_ratio(&self) -> f64 {
        self.four_bar_joints().map_or(f64::NAN, |l| self.angular_velocity_ratio(l.a, l.b))
    }

    fn solvability(&self) -> f64 {
        let (Some(l), Some(four_bar)) = (self.four_bar_joints(), FourBar::from_linkage(self.linkage)) else {
            return f64::NAN;
        };
        let (frame, crank) = (self.vector(l.o, l.c), self.vector(l.o, l.a));
        four_bar.solvability(trig::atan2(cross(frame, crank), frame.dot(&crank)))
    }

    fn slide(&self) -> f64 {
        self.inverted_slider_crank().map_or(f64::NAN, |s| s.slide)
    }

    fn b(&self) -> f64 {
        self.inverted_slider_crank().map_or(f64::NAN, |s| self.vector(s.c, s.a).norm())
    }

    fn beta(&self) -> f64 {
        self.inverted_slider_crank().map_or(f64::NAN, |s| s.beta())
    }
}

/// McCarthy's inverted slider-crank: the crank's pivot and pin, the pivot of the slider's line, its offset and its
/// slide.
struct InvertedSliderCrank {
    o: JointId,
    a: JointId,
    c: JointId,
    offset: f64,
    slide: f64,
    /// The derivative of the slide with respect to the input.
    slide_rate: f64,
}

impl InvertedSliderCrank {
    /// (2.40): `b cos beta = e` and `b sin beta = s`.
    fn beta(&self) -> f64 {
        trig::degrees(trig::atan2(self.slide, self.offset))
    }
}

/// The angle from one direction to another, in degrees, from -180 to 180.
fn signed_angle(from: Vector, to: Vector) -> f64 {
    trig::degrees(trig::atan2(cross(from, to), from.dot(&to)))
}
