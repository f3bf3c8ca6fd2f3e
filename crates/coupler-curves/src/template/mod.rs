//! A template: a linkage whose dimensions are expressions. A parameter set turns it into a [`Linkage`].

mod as_drawn;
mod closure;
mod construction;
mod input_value;
mod joint_kind;
mod length;
mod load_text;
mod order;
mod parameter;
mod parameter_kinds;
mod rack_text;
mod side;
mod starting_family;

pub use closure::ClosureTemplate;
pub use joint_kind::{Coordinate, JointKindTemplate};
pub use parameter::{Parameter, ParameterKind};
pub use side::SideTemplate;

// For the other crates of the workspace only.
#[doc(hidden)]
pub use self::{
    input_value::InputValue,
    length::LinkLength,
    load_text::LoadTextError,
    order::{DependencyCycle, dependency_order},
};

use crate::expression::{Caption, CompiledExpression, Unit, displayed_name};
use crate::linkage::{self, BranchArc, DwellBand, JointId, LinkageBuilder, Load, MotionOptions};

pub use crate::linkage::{CircuitSelection, CoincidentDyads, Continuation, Linkage, Orientation, Side};

/// A linkage whose dimensions are expressions. Every [`CompiledExpression`] in it is over [`Template::parameters`].
#[derive(Clone, Debug)]
pub struct Template {
    /// Its name in manifests.
    pub id: String,
    /// Its source in the literature; may be empty.
    pub source: String,
    /// The meaning of its parameters; may be empty.
    pub legend: String,
    /// Its parameters, in the order of the columns of `cells.csv`.
    pub parameters: Vec<Parameter>,
    /// The caption under each cell.
    pub caption: Option<Caption>,
    /// A second, smaller line under the caption.
    pub note: Option<Caption>,
    /// The joints in the order they are placed.
    pub joints: Vec<JointTemplate>,
    /// The closed loops by which joints are placed that no dyads place; none if there are no such joints.
    pub closures: Vec<ClosureTemplate>,
    /// The same linkage driven elsewhere, by which dyads place all joints, if all circuits of joints with closures are to be found.
    pub driven_elsewhere: Option<Box<Template>>,
    /// The joints whose curves are traced, by their indices in `joints`.
    pub traced: Vec<usize>,
    /// The link in whose frame everything is reported: the joint at its origin and a joint on its positive x-axis.
    pub seen_from: Option<[usize; 2]>,
    /// The output link; `None` for the default of [`Linkage::output`].
    pub output_link: Option<OutputLinkTemplate>,
    /// The force that it moves against, on a joint by its index in `joints`.
    pub load: Option<Load<usize>>,
    /// How far each of its lengths may be off, if that is to be measured: positive.
    pub tolerance: Option<f64>,
    /// How far its output may move while it dwells.
    pub dwell: DwellBand,
    /// The chains it is composed of in addition to the first, each by its joints.
    pub chains: Vec<Vec<usize>>,
    /// The orientation applied to everything reported, after `seen_from`.
    pub orientation: Orientation,
    /// The circuits to solve.
    pub circuits: CircuitSelection,
    /// How the motion continues at a change point.
    pub continuation: Continuation,
    /// The dyads that change sides where several are flat at one input.
    pub coincident: CoincidentDyads,
    /// The input at which the sides of the joints apply.
    pub start: Option<InputValue>,
    /// The range of the input.
    pub input: Option<[InputValue; 2]>,
    /// The part of the curve that the source's figure shows: the input at its ends, and the branch.
    pub arc: Option<([InputValue; 2], i8)>,
}

/// The output link by its joints, given by their indices in [`Template::joints`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputLinkTemplate {
    /// The link with two joints; its angle is that of the line from the first to the second.
    Link([usize; 2]),
    /// The slider or the yoke of a joint.
    Slider(usize),
}

/// A joint whose dimensions are expressions.
#[derive(Clone, Debug)]
pub struct JointTemplate {
    /// Its name.
    pub name: String,
    /// How it is placed.
    pub kind: JointKindTemplate,
    /// Its coordinates in the drawing that its dimensions follow from, if there is one.
    pub drawn: Option<[CompiledExpression; 2]>,
}

/// Why a linkage cannot be built from a parameter set.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An expression has no finite value.
    #[error("{what} of `{joint}` is {value}, which is not a finite number")]
    NotFinite {
        /// The joint.
        joint: String,
        /// The number in question.
        what: &'static str,
        /// The value.
        value: f64,
    },
    /// A value of the input is not finite, or its range is empty or longer than a period.
    #[error("{what} is {value}, {why}")]
    Input {
        /// The value in question.
        what: &'static str,
        /// The value, in degrees or as a length.
        value: f64,
        /// The error in it, as a clause.
        why: &'static str,
    },
    /// A joint is drawn where its links are in line.
    #[error("`{joint}` is drawn at a dead point, in line with the joints that hold it, so that its side is not known")]
    Flat {
        /// The joint.
        joint: String,
    },
    /// A joint cannot be placed.
    #[error(transparent)]
    Linkage(#[from] linkage::Error),
}

impl Template {
    /// The same over a range of its input only, in degrees and in either order: on all its circuits, wherever its own start is.
    pub fn over(&self, [from, to]: [f64; 2]) -> Template {
        let at = |value: f64| InputValue { value: CompiledExpression::constant(value), unit: Some(Unit::Deg) };
        let [least, greatest] = [from.min(to), from.max(to)].map(at);
        Template {
            input: Some([least.clone(), greatest]),
            start: Some(least),
            circuits: CircuitSelection::All,
            ..self.clone()
        }
    }

    /// Its source and its legend in one line, as printed under the title of a page.
    pub fn source_line(&self) -> String {
        let parts = [&self.source, &self.legend].map(String::as_str);
        parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" · ")
    }

    /// Whether its input is a length, of an actuator or of the way of a slider, rather than an angle.
    pub fn is_driven_by_length(&self) -> bool {
        let is_by_closure = self.closures.iter().any(|closure| matches!(closure, ClosureTemplate::Drive { .. }));
        is_by_closure
            || self.joints.iter().any(|joint| {
                matches!(joint.kind, JointKindTemplate::Piston { .. } | JointKindTemplate::DrivenSlider { .. })
            })
    }

    /// What its input is, in words.
    pub fn input_in_words(&self) -> String {
        let driven = self.joints.iter().find_map(|joint| match &joint.kind {
            JointKindTemplate::Piston { base: [from, _], offset, .. } => Some(match offset.constant_value() {
                Some(0.0) => "the actuator's length".to_owned(),
                _ => {
                    let from = displayed_name(&self.joints[*from].name);
                    format!("the actuator's length from the foot of the perpendicular from {from} to its line")
                }
            }),
            JointKindTemplate::DrivenSlider { line: [from, to], .. } => {
                let [slider, from, to] =
                    [joint, &self.joints[*from], &self.joints[*to]].map(|joint| displayed_name(&joint.name));
                Some(format!("the way of the slider {slider} from {from} towards {to}"))
            }
            _ => None,
        });
        let by_closure = self.closures.iter().find_map(|closure| match closure {
            ClosureTemplate::Drive { joints } => {
                let [a, b] = joints.map(|joint| displayed_name(&self.joints[joint].name));
                Some(format!("the length of the actuator from {a} to {b}"))
            }
            _ => None,
        });
        driven.or(by_closure).unwrap_or_else(|| "the angle of the crank".to_owned())
    }

    /// The names of its traced joints, that of a grid once for each of its points.
    pub fn traced_names(&self) -> impl Iterator<Item = &str> + Clone {
        self.traced.iter().flat_map(|&joint| {
            let JointTemplate { name, kind, .. } = &self.joints[joint];
            std::iter::repeat_n(name.as_str(), kind.point_count())
        })
    }

    /// The number of curves that its traced joints trace on one circuit.
    pub fn curve_count(&self) -> usize {
        self.traced.iter().map(|&joint| self.joints[joint].kind.point_count()).sum()
    }

    /// The labels of link lengths that are a single name or number: the names of the joints at both ends, and the
    /// label.
    ///
    /// The frame is included as the distance of a fixed joint on the x-axis from one at the origin.
    pub fn link_length_names(&self) -> Vec<([&str; 2], String)> {
        let name = |joint: usize| self.joints[joint].name.as_str();
        let origin = self.joints.iter().position(|joint| match &joint.kind {
            JointKindTemplate::Fixed(xy) => xy.iter().all(|c| c.name_or_number().as_deref() == Some("0")),
            _ => false,
        });
        let mut out = Vec::new();
        for joint in &self.joints {
            let mut add = |from: usize, length: &CompiledExpression| {
                out.extend(length.name_or_number().map(|label| ([name(from), joint.name.as_str()], label)));
            };
            match (&joint.kind, origin) {
                (JointKindTemplate::Crank { pivot, length } | JointKindTemplate::Gear { pivot, length, .. }, _) => {
                    add(*pivot, length)
                }
                (JointKindTemplate::Piston { base: [_, pivot], length, .. }, _) => add(*pivot, length),
                (JointKindTemplate::Slide { from, length, .. }, _) => add(*from, length),
                (JointKindTemplate::Dyad { base: [p, q], lengths: [l0, l1], .. }, _) => {
                    add(*p, l0);
                    add(*q, l1);
                }
                (JointKindTemplate::Fixed([x, y]), Some(origin))
                    if y.name_or_number().as_deref() == Some("0") && name(origin) != joint.name =>
                {
                    add(origin, x);
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
        let mut linkage = self.build_with(values, |_, expression| expression.evaluate(|slot| values[slot]))?;
        if let Some(other) = &self.driven_elsewhere {
            linkage.driven_elsewhere = Some(Box::new(other.linkage(values)?));
        }
        Ok(linkage)
    }

    /// The error in the joints that does not depend on numbers: one joint given twice, a point on no link, too many
    /// dyads.
    pub fn structural_error(&self) -> Option<linkage::Error> {
        match self.structure() {
            // These depend on the numbers after all; they are checked in each cell.
            Err(Error::Linkage(
                linkage::Error::InvalidLength { .. }
                | linkage::Error::NoTriangle { .. }
                | linkage::Error::NoDirection { .. }
                | linkage::Error::NoPitchRadius { .. },
            )) => None,
            // The range, too, may depend on the numbers.
            Err(Error::Linkage(linkage::Error::RackWithoutRange { .. })) if self.input.is_some() => None,
            Err(Error::Linkage(error)) => Some(error),
            _ => None,
        }
    }

    /// A linkage with the joints of the template and any dimensions.
    ///
    /// # Errors
    /// As of [`Template::linkage`], with dimensions that need not be those of any parameter set.
    pub fn structure(&self) -> Result<Linkage, Error> {
        // Fixed joints and points must not coincide, so that lines through them have directions.
        let position = |joint: usize| (joint * joint) as f64;
        let numbers = |joint: usize, _: &CompiledExpression| match self.joints[joint].kind {
            JointKindTemplate::Fixed(_) | JointKindTemplate::Grouped { .. } => position(joint),
            JointKindTemplate::Point { .. } => 1.0 + position(joint),
            _ => 1.0,
        };
        self.build_with(&vec![1.0; self.parameters.len()], numbers)
    }

    fn build_with(&self, values: &[f64], number: impl Fn(usize, &CompiledExpression) -> f64) -> Result<Linkage, Error> {
        let mut builder = LinkageBuilder::default();
        // The joints built from each joint of the template: several for a grid of points.
        let mut built: Vec<Vec<JointId>> = Vec::with_capacity(self.joints.len());
        for (k, joint) in self.joints.iter().enumerate() {
            let name = joint.name.as_str();
            let finite = |what, value: f64| {
                if value.is_finite() {
                    Ok(value)
                } else {
                    Err(Error::NotFinite { joint: name.to_owned(), what, value })
                }
            };
            let two = |base: &[usize; 2]| base.map(|j| built[j][0]);
            let side = |side: &SideTemplate| {
                side.evaluate(|sine| number(k, sine)).ok_or_else(|| Error::Flat { joint: name.to_owned() })
            };
            let ids = match &joint.kind {
                JointKindTemplate::Fixed([x, y]) => {
                    let position = [finite("the x", number(k, x))?, finite("the y", number(k, y))?];
                    vec![builder.fixed(name, position.into())]
                }
                JointKindTemplate::Crank { pivot, length } => {
                    vec![builder.crank(name, built[*pivot][0], number(k, length))?]
                }
                JointKindTemplate::Gear { pivot, length, ratio: [n, m], phase, .. } => {
                    let ratio = [number(k, n), number(k, m)];
                    let phase = finite("`phase`", phase.evaluate(values))?;
                    vec![builder.gear(name, (built[*pivot][0], number(k, length)), ratio, phase)?]
                }
                JointKindTemplate::Piston { base, length, offset, side: own } => {
                    let crank = (number(k, length), finite("`offset`", number(k, offset))?);
                    vec![builder.piston(name, two(base), crank, side(own)?)?]
                }
                JointKindTemplate::DrivenSlider { line, offset } => {
                    vec![builder.driven_slider(name, (two(line), finite("`offset`", number(k, offset))?))?]
                }
                JointKindTemplate::Rack { line, offset, radius, start, .. } => {
                    let line = (two(line), finite("`offset`", number(k, offset))?);
                    let way = (finite("`radius`", number(k, radius))?, finite("`start`", number(k, start))?);
                    vec![builder.rack(name, line, way)?]
                }
                JointKindTemplate::Dyad { base, lengths: [l0, l1], side: own } => {
                    vec![builder.dyad(name, two(base), [number(k, l0), number(k, l1)], side(own)?)?]
                }
                JointKindTemplate::Slide { from, length, line, offset, side: own } => {
                    let link = (built[*from][0], number(k, length));
                    let line = (two(line), finite("`offset`", number(k, offset))?);
                    vec![builder.slide(name, link, line, side(own)?)?]
                }
                JointKindTemplate::Yoke { from, line, offset, angle } => {
                    let line = (two(line), finite("`offset`", number(k, offset))?);
                    let angle = finite("`angle`", angle.evaluate(values))?;
                    vec![builder.yoke(name, built[*from][0], line, angle)?]
                }
                JointKindTemplate::Slot { base, offset, side: own } => {
                    let offset = finite("`offset`", number(k, offset))?;
                    // Without an offset the side is a matter of direction, which is towards the joint in a drawing.
                    let side = match own {
                        SideTemplate::Drawn(_) if offset == 0.0 => Side::Right,
                        own => side(own)?,
                    };
                    vec![builder.slot(name, two(base), offset, side)?]
                }
                JointKindTemplate::Grouped { at: [x, y] } => {
                    let at = [finite("the x", number(k, x))?, finite("the y", number(k, y))?];
                    vec![builder.grouped(name, at.into())]
                }
                JointKindTemplate::Parallelogram { corners } => {
                    vec![builder.parallelogram(name, corners.map(|j| built[j][0]))?]
                }
                JointKindTemplate::Distances { base, distances: [d0, d1], side: own } => {
                    vec![builder.point_at_distances(name, two(base), [number(k, d0), number(k, d1)], side(own)?)?]
                }
                JointKindTemplate::Point { base, along, across } => {
                    let across = across.values(|b| number(k, b));
                    let mut ids = Vec::new();
                    for along in along.values(|b| number(k, b)) {
                        for &across in &across {
                            let (along, across) = (finite("`along`", along)?, finite("`across`", across)?);
                            ids.push(builder.point(name, two(base), along, across)?);
                        }
                    }
                    ids
                }
            };
            built.push(ids);
            // A link is there before the points of it.
            for closure in self.closures.iter().filter(|closure| closure.joints().into_iter().max() == Some(k)) {
                let two = |base: &[usize; 2]| base.map(|j| built[j][0]);
                match closure {
                    ClosureTemplate::Bar { joints, length } => builder.grouped_bar(two(joints), number(k, length))?,
                    ClosureTemplate::Hold { joint, base, place: [along, across] } => {
                        let place = [finite("`along`", number(k, along))?, finite("`across`", number(k, across))?];
                        builder.hold(built[*joint][0], two(base), place)?;
                    }
                    ClosureTemplate::Guide { joint, line, offset } => {
                        builder.guide(built[*joint][0], two(line), finite("`offset`", number(k, offset))?)?;
                    }
                    ClosureTemplate::Drive { joints } => builder.drive(two(joints)),
                    ClosureTemplate::Start { joint, at: [x, y] } => {
                        let at = [finite("the x", number(k, x))?, finite("the y", number(k, y))?];
                        builder.start_at(built[*joint][0], at.into());
                    }
                }
            }
        }
        let traced = self.traced.iter().flat_map(|&k| built[k].clone()).collect();
        let seen_from = self.seen_from.map(|joints| joints.map(|k| built[k][0]));
        match self.output_link {
            None => {}
            Some(OutputLinkTemplate::Link(joints)) => builder.set_output_link(joints.map(|k| built[k][0]))?,
            Some(OutputLinkTemplate::Slider(joint)) => builder.set_output_slider(built[joint][0])?,
        }
        let linkage = builder.build(traced, seen_from, self.motion_options(values)?)?;
        let chain = |joints: &Vec<usize>| joints.iter().flat_map(|&k| built[k].clone()).collect();
        let chains = self.chains.iter().map(chain).collect();
        let load = self.load.map(|load| load.map_joint(|k| built[k][0]));
        let (tolerance, dwell) = (self.tolerance, self.dwell);
        let linkage = Linkage { placement: self.orientation, load, tolerance, dwell, chains, ..linkage };
        match linkage.motion_options.range {
            Some([from, to]) if to - from > linkage.input().period() => {
                let why = "which is more than a period from `from`";
                Err(Error::Input { what: "the input's `to`", value: to, why })
            }
            _ => Ok(linkage),
        }
    }

    fn motion_options(&self, values: &[f64]) -> Result<MotionOptions, Error> {
        let finite = |what, input: &InputValue| match input.evaluate(values) {
            value if value.is_finite() => Ok(value),
            value => Err(Error::Input { what, value, why: "which is not a finite number" }),
        };
        let range = match &self.input {
            None => None,
            Some([from, to]) => {
                let (from, to) = (finite("the input's `from`", from)?, finite("the input's `to`", to)?);
                if to - from <= 0.0 {
                    let why = "and must be more than `from`";
                    return Err(Error::Input { what: "the input's `to`", value: to, why });
                }
                Some([from, to])
            }
        };
        let start = self.start.as_ref().map(|start| finite("`start`", start)).transpose()?;
        // An arc whose ends do not exist for these lengths is ignored.
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
