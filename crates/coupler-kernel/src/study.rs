//! The study of a curve: its linkage with all circuits, and the circuit that is shown.

use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

use coupler_curves::family::Family;
use coupler_curves::geometry::{Bounds, Point, Vector};
use coupler_curves::linkage::{CircuitSelection, JointId, Linkage};
use coupler_curves::measure;
use coupler_curves::motion::{
    self, Circuit, InstantaneousMotion, JointDerivatives, Pass, Sampler, Sampling, UnsampledCircuit, eased_input,
    find_circuits,
};
use coupler_curves::solve::ChangedCell;
use coupler_drawing::mechanism::Mechanism;

/// The number of samples of the circuit that is shown.
const SAMPLES: usize = 240;

/// A linkage in motion on one of its circuits.
#[derive(Debug)]
pub(crate) struct Study {
    /// A family of the cell alone.
    pub family: Family,
    pub linkage: Linkage,
    /// The index of the circuit that is shown.
    pub shown: usize,
    /// That circuit, sampled.
    pub circuit: Circuit,
    pub joint: JointId,
    pub mechanism: Mechanism,
    /// Linkages without other traced points, by the joint that they have, with its index in them.
    single_points: RefCell<HashMap<JointId, Rc<(Linkage, JointId)>>>,
}

/// A place on a circuit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    /// The index of the pass.
    pub pass: usize,
    /// The input.
    pub input: f64,
}

/// What is known of a curve that may not exist.
#[derive(Debug)]
pub(crate) struct Opened {
    /// The study, or why there is none.
    pub study: Result<Study, String>,
    /// The linkage, if it could be built.
    pub linkage: Option<Linkage>,
    /// The circuits that were found.
    pub circuits: Vec<UnsampledCircuit>,
    pub home: Option<usize>,
    /// What the linkage lacks of the requested range.
    pub shortfall: Option<String>,
    /// The values of the names of the family.
    pub values: Vec<f64>,
}

impl Opened {
    /// Opens the study of a curve of a changed cell, by its trace and circuit.
    pub fn new(changed: ChangedCell, curve: [usize; 2], shown: Option<usize>, is_rough: bool) -> Opened {
        let ChangedCell { family, numbers, .. } = changed;
        let cell = family.cell(0);
        let mut opened = Opened {
            study: Err(String::new()),
            linkage: None,
            circuits: Vec::new(),
            home: None,
            shortfall: None,
            values: cell.values.clone(),
        };
        opened.study = match family.linkage(&cell) {
            Err(error) => Err(error.to_string()),
            Ok(linkage) => {
                let [trace, number] = curve;
                opened.linkage = Some(linkage.clone());
                opened.find_circuits(&linkage, number, is_rough && shown.is_none());
                opened.study(family, linkage, numbers.trace(trace), shown)
            }
        };
        opened
    }

    /// Finds the circuits of a linkage, all of them or those that its family selects, and the one with a number among
    /// the latter.
    fn find_circuits(&mut self, linkage: &Linkage, number: usize, only_selected: bool) {
        let selected = find_circuits(linkage);
        self.shortfall = selected.assembly_error.as_ref().map(ToString::to_string);
        let own = number.checked_sub(1).and_then(|k| selected.circuits.get(k)).cloned();
        self.circuits = if only_selected {
            selected.circuits
        } else {
            let mut whole = linkage.clone();
            whole.motion_options.circuits = CircuitSelection::All;
            find_circuits(&whole).circuits
        };
        self.home = own.and_then(|own| self.circuits.iter().position(|other| is_same_circuit(other, &own)));
    }

    /// The study of a trace, from 1, on a circuit, by its index; without one, on the curve's own.
    fn study(&self, family: Family, linkage: Linkage, trace: usize, shown: Option<usize>) -> Result<Study, String> {
        let reason = |otherwise: &str| self.shortfall.clone().unwrap_or_else(|| otherwise.to_owned());
        if self.circuits.is_empty() {
            return Err(reason("no input allows assembly"));
        }
        let shown = shown.filter(|k| *k < self.circuits.len()).or(self.home).ok_or_else(|| {
            reason("the circuit of this curve no longer exists: it has merged with another, or split")
        })?;
        let joint = trace.checked_sub(1).and_then(|k| linkage.traced.get(k)).copied();
        let joint = joint.ok_or_else(|| format!("there is no trace {trace}"))?;
        let sampler = Sampler::new(Sampling::DenseAtLimits(SAMPLES));
        let circuit = sampler.sample_circuit(&linkage, self.circuits[shown].clone());
        let mechanism = mechanism_with_point(&linkage, joint, &circuit);
        let single_points = RefCell::default();
        let study = Study { family, linkage, shown, circuit, joint, mechanism, single_points };
        let size = study.bounds(&[joint]).size().norm();
        let is_drawable = size > 0.0 && size.is_finite();
        if is_drawable { Ok(study) } else { Err("its lengths differ too much to be drawn".to_owned()) }
    }
}

/// The parts of a linkage, with a traced point on its link even if it is one of a grid, whose points are left out.
fn mechanism_with_point(linkage: &Linkage, joint: JointId, circuit: &Circuit) -> Mechanism {
    let (single, single_joint) = linkage.with_one_point(joint);
    let mut mechanism = Mechanism::new(&single, circuit);
    let joints = mechanism.links.iter_mut().flat_map(|link| &mut link.joints);
    joints.filter(|other| **other == single_joint).for_each(|other| *other = joint);
    mechanism
}

/// Whether two circuits, found with other selections, are the same.
fn is_same_circuit(circuit: &UnsampledCircuit, other: &UnsampledCircuit) -> bool {
    let [first, ..] = &other.passes[..] else { return false };
    let least = |pass: &Pass| pass.input_range()[0];
    circuit.passes.iter().any(|pass| pass.mode == first.mode && (least(pass) - least(first)).abs() < 1e-9)
}

impl Study {
    /// The bounds of the linkage over the circuit, and of the paths of further joints.
    pub fn bounds(&self, further: &[JointId]) -> Bounds {
        let Mechanism { slots, guides, gears, pivots, links, .. } = &self.mechanism;
        let mut joints: Vec<JointId> = links.iter().flat_map(|link| &link.joints).chain(pivots).copied().collect();
        joints.extend(slots.iter().map(|slot| slot.through).chain(further.iter().copied()));
        joints.sort_unstable();
        joints.dedup();
        let paths = joints.iter().flat_map(|&joint| self.circuit.points(joint));
        let start: Vec<Point> = self.linkage.joint_ids().map(|joint| self.circuit.positions.point(joint, 0)).collect();
        let gears = gears.iter().flat_map(|gear| {
            let (centre, radius) = (gear.centre_in(&start), Vector::repeat(gear.radius));
            [centre - radius, centre + radius]
        });
        Bounds::from_points(paths.chain(guides.iter().flat_map(|guide| guide.ends)).chain(gears).filter(is_finite))
    }

    /// The bounds of the curve.
    pub fn curve_bounds(&self) -> Bounds {
        Bounds::from_points(self.circuit.points(self.joint).filter(is_finite))
    }

    /// The joints that are traced besides.
    pub fn other_joints(&self) -> impl Iterator<Item = JointId> {
        self.linkage.traced.iter().copied().filter(|&joint| joint != self.joint)
    }

    /// The passes of the circuit.
    pub fn passes(&self) -> &[Pass] {
        &self.circuit.passes
    }

    /// The linkage without other traced points than a joint, and the joint in it: its poses are faster to compute.
    pub fn single_point(&self, joint: JointId) -> Rc<(Linkage, JointId)> {
        let mut known = self.single_points.borrow_mut();
        known.entry(joint).or_insert_with(|| Rc::new(self.linkage.with_one_point(joint))).clone()
    }

    /// The position of a joint at an input of a pass.
    pub fn joint_position(&self, joint: JointId, pass: usize, input: f64) -> Option<Point> {
        let pass = self.passes().get(pass)?;
        let single = self.single_point(joint);
        let (linkage, joint) = &*single;
        Some(motion::pose(linkage, pass, input)[*joint])
    }

    /// The derivatives of the traced point's linkage at an input of a pass.
    fn derivatives(&self, pass: &Pass, input: f64) -> (Rc<(Linkage, JointId)>, JointDerivatives) {
        let single = self.single_point(self.joint);
        let derivatives = JointDerivatives::on_pass(&single.0, pass, input);
        (single, derivatives)
    }

    /// About `count` places on the circuit, pass after pass and each with both its ends, denser towards limits.
    pub fn places(&self, count: usize) -> impl Iterator<Item = Place> {
        let whole: f64 = self.passes().iter().map(Pass::input_length).sum();
        let parts = move |pass: &Pass| ((count as f64 * pass.input_length() / whole) as usize).max(8);
        let of_pass = move |(k, pass): (usize, &Pass)| {
            let (pass, parts) = (pass.clone(), parts(pass));
            let input = move |i: usize| match i {
                0 => pass.from.input.value,
                i if i == parts => pass.to.input.value,
                i => eased_input(&pass, i as f64 / parts as f64),
            };
            (0..=parts).map(move |i| Place { pass: k, input: input(i) })
        };
        self.passes().iter().enumerate().flat_map(of_pass)
    }

    /// The velocity of the traced point at an input of a pass, per radian or unit of length of the input.
    pub fn velocity(&self, pass: &Pass, input: f64) -> Vector {
        let (single, derivatives) = self.derivatives(pass, input);
        derivatives.velocity(single.1)
    }

    /// The motion of the link that traces the curve at an input of a pass; `None` if it translates.
    pub fn instant(&self, pass: &Pass, input: f64) -> Option<InstantaneousMotion> {
        let (single, derivatives) = self.derivatives(pass, input);
        InstantaneousMotion::from_joint(&single.0, &derivatives, single.1)
    }

    /// The positions of all joints at a sample of the circuit.
    pub fn sampled_pose(&self, sample: usize) -> Vec<Point> {
        self.linkage.joint_ids().map(|joint| self.circuit.positions.point(joint, sample)).collect()
    }

    /// The least and the greatest transmission angle at the samples of the circuit, in degrees, which include its limits;
    /// `None` if the linkage is not a four-bar.
    pub fn transmission_range(&self) -> Option<[f64; 2]> {
        let angles = (0..self.circuit.len()).filter_map(|sample| self.transmission_angle(&self.sampled_pose(sample)));
        let finite = angles.filter(|angle| angle.is_finite());
        finite.map(|angle| [angle; 2]).reduce(|[least, most], [angle, _]| [least.min(angle), most.max(angle)])
    }

    /// The transmission angle in a pose, in degrees; `None` if the linkage is not a four-bar.
    pub fn transmission_angle(&self, pose: &[Point]) -> Option<f64> {
        measure::transmission_angle(&self.linkage, pose)
    }
}

fn is_finite(p: &Point) -> bool {
    p.x.is_finite() && p.y.is_finite()
}
