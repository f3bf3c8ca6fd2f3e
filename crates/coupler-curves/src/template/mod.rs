//! A linkage with expressions for numbers; a parameter set makes it a [`Linkage`].

mod joint_kind;
mod order;

pub use joint_kind::{Coordinate, JointKindTemplate};
pub use order::{DependencyCycle, dependency_order};

use crate::expression::{Caption, CompiledExpression, Expression, Unit};
use crate::linkage::{self, BranchArc, JointId, LinkageBuilder, MotionOptions};

pub use crate::linkage::{CircuitSelection, CoincidentDyads, Continuation, Linkage, Orientation, Side};

/// A linkage family before it has numbers. All [`CompiledExpression`] expressions are over [`Template::parameters`].
#[derive(Clone, Debug)]
pub struct Template {
    /// The name manifests call it by.
    pub id: String,
    /// Where it comes from.
    pub source: String,
    /// What its letters mean; may be empty.
    pub legend: String,
    /// Its parameters, in the order of the columns of `cells.csv`.
    pub parameters: Vec<Parameter>,
    /// The line under each figure.
    pub caption: Option<Caption>,
    /// A smaller line under that.
    pub note: Option<Caption>,
    /// The joints in the order they are placed.
    pub joints: Vec<JointTemplate>,
    /// The joints whose curves are wanted, by their place in `joints`.
    pub traced: Vec<usize>,
    /// The link whose frame everything is reported in.
    pub seen_from: Option<[usize; 2]>,
    /// Where the plane it is reported in is laid, after that.
    pub orientation: Orientation,
    /// Which circuits are wanted.
    pub circuits: CircuitSelection,
    /// What happens at a change point.
    pub continuation: Continuation,
    /// Which dyads change their sides where several lie flat at one input.
    pub coincident: CoincidentDyads,
    /// The input at which the sides hold.
    pub start: Option<InputValue>,
    /// The range of the input.
    pub input: Option<[InputValue; 2]>,
    /// The part of the curve that the source's figure shows: input from, to, and branch.
    pub arc: Option<([InputValue; 2], i8)>,
}

/// A parameter of a template.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its value where none is given; may use the other parameters.
    pub default: Option<Expression>,
    /// Its least value; 0 itself is excluded.
    pub min: Option<f64>,
    /// Its greatest value; 0 itself is excluded.
    pub max: Option<f64>,
}

impl Parameter {
    /// What is wrong with a value, if anything.
    pub fn value_error(&self, value: f64) -> Option<String> {
        let name = &self.name;
        if !value.is_finite() {
            return Some(format!("`{name}` is {value}, which is not a finite number"));
        }
        match (self.min, self.max) {
            (Some(0.0), _) if value <= 0.0 => Some(format!("`{name}` is {value}, and must be more than 0")),
            (Some(min), _) if value < min => Some(format!("`{name}` is {value}, below its least value of {min}")),
            (_, Some(0.0)) if value >= 0.0 => Some(format!("`{name}` is {value}, and must be less than 0")),
            (_, Some(max)) if value > max => Some(format!("`{name}` is {value}, above its greatest value of {max}")),
            _ => None,
        }
    }
}

/// A value of the input, with expressions in it: an angle, evaluated in degrees, or a length.
#[derive(Clone, Debug, PartialEq)]
pub struct InputValue {
    /// The number of units.
    pub value: CompiledExpression,
    /// Degrees or radians; none for a length.
    pub unit: Option<Unit>,
}

impl InputValue {
    fn evaluate(&self, values: &[f64]) -> f64 {
        let value = self.value.evaluate(|slot| values[slot]);
        self.unit.map_or(value, |unit| unit.to_base_unit(value))
    }
}

/// A joint with expressions for numbers.
#[derive(Clone, Debug)]
pub struct JointTemplate {
    /// Its name.
    pub name: String,
    /// How it is placed.
    pub kind: JointKindTemplate,
}

/// Why a parameter set makes no linkage.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// An expression has no finite value.
    #[error("{what} of `{joint}` is {value}, which is not a finite number")]
    NotFinite {
        /// The joint.
        joint: String,
        /// Which number of it.
        what: &'static str,
        /// The value.
        value: f64,
    },
    /// A value of the input is not finite, or a range has none to go over.
    #[error("{what} is {value}, {why}")]
    Input {
        /// Which value.
        what: &'static str,
        /// The value, in degrees or a length.
        value: f64,
        /// What is wrong with it.
        why: &'static str,
    },
    /// A joint cannot be placed.
    #[error(transparent)]
    Linkage(#[from] linkage::Error),
}

impl Template {
    /// Its source and its legend in one line, as printed under the title of a page.
    pub fn source_line(&self) -> String {
        let parts = [&self.source, &self.legend].map(String::as_str);
        parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" · ")
    }

    /// Whether its input is the length of an actuator, and not an angle.
    pub fn is_driven_by_length(&self) -> bool {
        self.joints.iter().any(|joint| matches!(joint.kind, JointKindTemplate::Piston { .. }))
    }

    /// How many curves its traced joints draw on one circuit.
    pub fn curve_count(&self) -> usize {
        let points = |placing: &JointKindTemplate| match placing {
            JointKindTemplate::Point { along, across, .. } => along.count() * across.count(),
            _ => 1,
        };
        self.traced.iter().map(|&joint| points(&self.joints[joint].kind)).sum()
    }

    /// What the lengths of links are called, where it is one name or a number: the names of the joints at the ends, and
    /// the word. Of the frame, the distance between two fixed joints on one level, of which one is at its origin.
    pub fn link_length_names(&self) -> Vec<([&str; 2], String)> {
        let name = |joint: usize| self.joints[joint].name.as_str();
        let origin = self.joints.iter().position(|joint| match &joint.kind {
            JointKindTemplate::Fixed(at) => at.iter().all(|c| c.name_or_number().as_deref() == Some("0")),
            _ => false,
        });
        let mut out = Vec::new();
        for joint in &self.joints {
            let mut call = |from: usize, length: &CompiledExpression| {
                out.extend(length.name_or_number().map(|word| ([name(from), joint.name.as_str()], word)));
            };
            match (&joint.kind, origin) {
                (JointKindTemplate::Crank { pivot, length } | JointKindTemplate::Gear { pivot, length, .. }, _) => {
                    call(*pivot, length)
                }
                (JointKindTemplate::Piston { base: [_, pivot], length, .. }, _) => call(*pivot, length),
                (JointKindTemplate::Slide { from, length, .. }, _) => call(*from, length),
                (JointKindTemplate::Dyad { base: [p, q], lengths: [l0, l1], .. }, _) => {
                    call(*p, l0);
                    call(*q, l1);
                }
                (JointKindTemplate::Fixed([x, y]), Some(origin))
                    if y.name_or_number().as_deref() == Some("0") && name(origin) != joint.name =>
                {
                    call(origin, x);
                }
                _ => {}
            }
        }
        out
    }

    /// The linkage of a parameter set, `values` in the order of [`Template::parameters`].
    ///
    /// # Errors
    /// A number that is not finite, a length that is not positive, a joint that cannot be placed.
    pub fn linkage(&self, values: &[f64]) -> Result<Linkage, Error> {
        self.build_with(values, |_, bound| bound.evaluate(|slot| values[slot]))
    }

    /// What is wrong with the joints whatever the numbers: one joint given twice, a point on no link, too many dyads.
    pub fn structural_error(&self) -> Option<linkage::Error> {
        // Any numbers will do; fixed joints and points in general position have distances to measure along.
        let place = |joint: usize| (joint * joint) as f64;
        let numbers = |joint: usize, _: &CompiledExpression| match self.joints[joint].kind {
            JointKindTemplate::Fixed(_) => place(joint),
            JointKindTemplate::Point { .. } => 1.0 + place(joint),
            _ => 1.0,
        };
        match self.build_with(&vec![1.0; self.parameters.len()], numbers) {
            // These depend on the numbers after all: each cell is asked for them.
            Err(Error::Linkage(
                linkage::Error::InvalidLength { .. }
                | linkage::Error::NoTriangle { .. }
                | linkage::Error::NoDirection { .. },
            )) => None,
            Err(Error::Linkage(error)) => Some(error),
            _ => None,
        }
    }

    fn build_with(&self, values: &[f64], number: impl Fn(usize, &CompiledExpression) -> f64) -> Result<Linkage, Error> {
        let mut assembly = LinkageBuilder::default();
        // Where each joint of the template has gone: a grid of points makes several.
        let mut made: Vec<Vec<JointId>> = Vec::with_capacity(self.joints.len());
        for (k, joint) in self.joints.iter().enumerate() {
            let name = joint.name.as_str();
            let finite = |what, value: f64| {
                if value.is_finite() {
                    Ok(value)
                } else {
                    Err(Error::NotFinite { joint: name.to_owned(), what, value })
                }
            };
            let two = |base: &[usize; 2]| base.map(|j| made[j][0]);
            let ids = match &joint.kind {
                JointKindTemplate::Fixed([x, y]) => {
                    let at = [finite("the x", number(k, x))?, finite("the y", number(k, y))?];
                    vec![assembly.fixed(name, at.into())]
                }
                JointKindTemplate::Crank { pivot, length } => {
                    vec![assembly.crank(name, made[*pivot][0], number(k, length))?]
                }
                JointKindTemplate::Gear { pivot, length, ratio: [n, m], phase, .. } => {
                    let ratio = [number(k, n), number(k, m)];
                    let phase = finite("`phase`", phase.evaluate(values))?;
                    vec![assembly.gear(name, (made[*pivot][0], number(k, length)), ratio, phase)?]
                }
                JointKindTemplate::Piston { base, length, offset, side } => {
                    let crank = (number(k, length), finite("`offset`", number(k, offset))?);
                    vec![assembly.piston(name, two(base), crank, *side)?]
                }
                JointKindTemplate::Dyad { base, lengths: [l0, l1], side } => {
                    vec![assembly.dyad(name, two(base), [number(k, l0), number(k, l1)], *side)?]
                }
                JointKindTemplate::Slide { from, length, line, offset, side } => {
                    let hung = (made[*from][0], number(k, length));
                    let line = (two(line), finite("`offset`", number(k, offset))?);
                    vec![assembly.slide(name, hung, line, *side)?]
                }
                JointKindTemplate::Yoke { from, line, offset, angle } => {
                    let line = (two(line), finite("`offset`", number(k, offset))?);
                    let angle = finite("`angle`", angle.evaluate(values))?;
                    vec![assembly.yoke(name, made[*from][0], line, angle)?]
                }
                JointKindTemplate::Slot { base, offset, side } => {
                    vec![assembly.slot(name, two(base), finite("`offset`", number(k, offset))?, *side)?]
                }
                JointKindTemplate::Parallelogram { corners } => {
                    vec![assembly.parallelogram(name, corners.map(|j| made[j][0]))?]
                }
                JointKindTemplate::Distances { base, distances: [d0, d1], side } => {
                    vec![assembly.point_at_distances(name, two(base), [number(k, d0), number(k, d1)], *side)?]
                }
                JointKindTemplate::Point { base, along, across } => {
                    let across = across.values(|b| number(k, b));
                    let mut ids = Vec::new();
                    for along in along.values(|b| number(k, b)) {
                        for &across in &across {
                            let (along, across) = (finite("`along`", along)?, finite("`across`", across)?);
                            ids.push(assembly.point(name, two(base), along, across)?);
                        }
                    }
                    ids
                }
            };
            made.push(ids);
        }
        let traced = self.traced.iter().flat_map(|&k| made[k].clone()).collect();
        let seen_from = self.seen_from.map(|joints| joints.map(|k| made[k][0]));
        let linkage = assembly.build(traced, seen_from, self.motion_options(values)?)?;
        let linkage = Linkage { placement: self.orientation, ..linkage };
        match linkage.motion_options.range {
            Some([from, to]) if to - from > linkage.input().period() => {
                let why = "more from `from` than it takes to come round";
                Err(Error::Input { what: "the input's `to`", value: to, why })
            }
            _ => Ok(linkage),
        }
    }

    fn motion_options(&self, values: &[f64]) -> Result<MotionOptions, Error> {
        let degrees = |what, angle: &InputValue| match angle.evaluate(values) {
            value if value.is_finite() => Ok(value),
            value => Err(Error::Input { what, value, why: "which is not a finite number" }),
        };
        let range = match &self.input {
            None => None,
            Some([from, to]) => {
                let (from, to) = (degrees("the input's `from`", from)?, degrees("the input's `to`", to)?);
                let too_far = |why| Err(Error::Input { what: "the input's `to`", value: to, why });
                match to - from {
                    length if length <= 0.0 => return too_far("and must be more than `from`"),
                    _ => Some([from, to]),
                }
            }
        };
        let start = self.start.as_ref().map(|start| degrees("`start`", start)).transpose()?;
        // An arc whose ends do not exist for these lengths is no part of the curve: nothing is set apart then.
        let arc = self.arc.as_ref().and_then(|([from, to], branch)| {
            let input_deg = [from.evaluate(values), to.evaluate(values)];
            input_deg.iter().all(|deg| deg.is_finite()).then_some(BranchArc { input_deg, branch: *branch })
        });
        let (circuits, continuation, coincident) = (self.circuits, self.continuation, self.coincident);
        Ok(MotionOptions {
            start,
            range,
            circuits,
            continuation,
            coincident,
            figure_arc: arc,
            ..MotionOptions::default()
        })
    }
}
