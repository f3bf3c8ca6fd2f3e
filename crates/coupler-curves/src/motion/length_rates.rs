//! How a pose changes where lengths of its linkage are off.
//!
//! Each joint satisfies two equations with the joints before it and the input, those of a group as many together. Differentiated by a length, they are one fewer than the unknowns, the
//! changes of all positions and of the input: these are known up to a part of the motion of the linkage. The least solution is taken, which is defined at
//! limits of the input, too, where the linkage that is off has no pose at the same input.

use std::array::from_fn;

use nalgebra::DMatrix;

use super::derivatives::to_view_frame;
use super::joint_series::{SeriesInput, place_joint_as_series};
use super::pass::InputPosition;
use super::series::{Series, VectorSeries};
use crate::geometry::{Point, Vector, cross};
use crate::linkage::{AssemblyMode, Closure, DyadId, Input, JointId, JointKind, LineDirection, Linkage};

/// Linkages that differ from one in a single length each.
#[derive(Clone, Debug, PartialEq)]
pub struct NeighbourLinkages {
    /// For each length the linkage in which it is shorter, and that in which it is longer.
    pub pairs: Vec<[Linkage; 2]>,
    /// By how much.
    pub step: f64,
    /// The names of the lengths.
    pub names: Vec<String>,
}

impl NeighbourLinkages {
    /// The step for derivatives, as a part of the greatest length. They are central differences of equations that are smooth everywhere, so that rounding
    /// divided by the step and the square of the step, 1e-10 and less, are all their error.
    pub const STEP: f64 = 1e-6;
}

/// A position and its derivative.
type Rate = VectorSeries<f64, 2>;

/// The derivatives of a pose by lengths, in the frame the linkage is seen from.
#[derive(Clone, Debug)]
pub struct LengthRates {
    /// The motion of the linkage itself, in a unit of its own.
    motion: PoseRate,
    /// The changes for a unit of each length.
    lengths: Vec<PoseRate>,
}

/// How a pose changes.
#[derive(Clone, Debug)]
struct PoseRate {
    joints: Vec<Vector>,
    /// Of the input, in radians or units of length.
    input: f64,
}

impl LengthRates {
    /// The derivatives in a pose, which is given by the positions of all joints, its input and its assembly mode; `None` at
    /// a change point, where they are not defined.
    pub fn new(
        linkage: &Linkage,
        neighbours: &NeighbourLinkages,
        positions: &[Point],
        input: InputPosition,
        mode: AssemblyMode,
    ) -> Option<LengthRates> {
        /// Equations are dependent where the least of their components that are independent is less than this part of the greatest.
        const DEPENDENT: f64 = 1e-13;
        let at = in_fixed_frame(linkage, positions)?;
        let size = at.iter().map(|place| place.coords.norm()).fold(0.0, f64::max);
        // An angle is counted in arcs about as large as the linkage.
        let arc = if linkage.input() == Input::Length { 1.0 } else { size };
        let pose = Constraints {
            input,
            mode,
            is_near_limit: linkage.joints.iter().map(|j| is_near_limit(j.kind, &at)).collect(),
        };
        let count = 2 * at.len();
        let mut rates: Vec<Rate> = at.iter().map(|place| Rate::constant(place.coords)).collect();
        let of_input = pose.values(linkage, 0, &rates, &rates);
        // The transpose of the equations' derivatives, and a column of zeros.
        let mut transpose = DMatrix::zeros(count + 1, count + 1);
        for (row, value) in of_input.iter().enumerate() {
            transpose[(count, row)] = value.0[1] / arc;
        }
        for unknown in 0..count {
            let joint = unknown / 2;
            let seed = |rates: &mut Vec<Rate>, rate: f64| {
                let place = &mut rates[joint];
                (if unknown % 2 == 0 { &mut place.x } else { &mut place.y }).0[1] = rate;
            };
            seed(&mut rates, 1.0);
            let values = pose.values(linkage, joint, &rates, &rates);
            for (row, value) in (count - values.len()..).zip(&values) {
                transpose[(unknown, row)] = value.0[1] - of_input[row].0[1];
            }
            seed(&mut rates, 0.0);
        }
        let mut errors = DMatrix::zeros(count, neighbours.pairs.len());
        for (k, [low, high]) in neighbours.pairs.iter().enumerate() {
            let off = |neighbour: &Linkage| {
                let (own, at) = pose.of_neighbour(linkage, neighbour, &rates);
                pose.values(neighbour, 0, &own, &at)
            };
            for (row, (low, high)) in off(low).iter().zip(off(high)).enumerate() {
                errors[(row, k)] = (low.0[0] - high.0[0]) / (2.0 * neighbours.step);
            }
        }
        let factors = transpose.qr();
        let (orthogonal, triangular) = (factors.q(), factors.r());
        let triangular = triangular.view((0, 0), (count, count));
        let [least, most] =
            triangular.diagonal().iter().fold([f64::INFINITY, 0.0], |[l, m], own| [l.min(own.abs()), m.max(own.abs())]);
        if least <= DEPENDENT * most || !most.is_finite() {
            return None;
        }
        let solved = triangular.tr_solve_upper_triangular(&errors)?;
        let solved = orthogonal.columns(0, count) * solved;
        let in_view = |column: &[f64]| {
            let with_rate = |k: usize| {
                let Rate { x, y } = rates[k];
                Rate { x: Series([x.0[0], column[2 * k]]), y: Series([y.0[0], column[2 * k + 1]]) }
            };
            let seen = to_view_frame(linkage, (0..at.len()).map(with_rate).collect());
            let joints = seen.iter().map(|place| Vector::new(place.x.0[1], place.y.0[1])).collect();
            PoseRate { joints, input: column[count] / arc }
        };
        let motion = in_view(orthogonal.column(count).as_slice());
        let lengths = (0..neighbours.pairs.len()).map(|k| in_view(solved.column(k).as_slice())).collect();
        Some(LengthRates { motion, lengths })
    }

    /// The direction in which a joint moves, of two; `None` where it stands still.
    pub fn direction(&self, joint: JointId) -> Option<Vector> {
        self.motion.joints[joint].try_normalize(0.0)
    }

    /// How far the path of a joint moves to the left of a direction that it has, for a unit of each length.
    pub fn moves_across(&self, joint: JointId, direction: Vector) -> impl Iterator<Item = f64> {
        self.lengths.iter().map(move |own| cross(direction, own.joints[joint]))
    }

    /// The derivatives of a joint's position at the same input, by each length; infinite at a limit that it passes.
    pub fn at_input(&self, joint: JointId) -> impl Iterator<Item = Vector> {
        self.lengths
            .iter()
            .map(move |own| own.joints[joint] - self.motion.joints[joint] * (own.input / self.motion.input))
    }
}

/// The positions in the frame of the fixed joints; `None` if they are seen from a link, and no two fixed joints tell from where.
fn in_fixed_frame(linkage: &Linkage, positions: &[Point]) -> Option<Vec<Point>> {
    let seen = positions.iter().map(|place| Point::from(linkage.placement.original_vector(place.coords)));
    if linkage.seen_from.is_none() {
        return Some(seen.collect());
    }
    let seen: Vec<Point> = seen.collect();
    let fixed = |(joint, place): (usize, &Point)| match linkage.joints[joint].kind {
        JointKind::Fixed(at) => Some((*place, at)),
        _ => None,
    };
    let fixed: Vec<(Point, Point)> = seen.iter().enumerate().filter_map(fixed).collect();
    let (from, origin) = *fixed.first()?;
    let (to, end) = *fixed.iter().find(|(_, at)| *at != origin)?;
    let (shown, own) = (to - from, end - origin);
    let (cos, sin) = (shown.dot(&own) / shown.norm_squared(), cross(shown, own) / shown.norm_squared());
    let turned = |v: Vector| Vector::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y);
    Some(seen.iter().map(|place| origin + turned(place - from)).collect())
}

/// Whether a slot, or a line through it, is near a limit: where its joint is hardly further from the pivot than the line.
fn is_near_limit(kind: JointKind, at: &[Point]) -> bool {
    match kind {
        JointKind::Slot { base: [p, q], offset, .. }
        | JointKind::Aligned { line: [p, q], offset, direction: LineDirection::Towards, .. } => {
            2.0 * offset * offset > (at[q.index()] - at[p.index()]).norm_squared()
        }
        _ => false,
    }
}

/// The equations of the joints in a pose.
struct Constraints {
    input: InputPosition,
    mode: AssemblyMode,
    is_near_limit: Vec<bool>,
}

impl Constraints {
    /// The places of the joints of a neighbour, and those from which others are placed. A foot that is at its pivot, as a line without offset has it, is
    /// moved to where it is with one, because other joints of the line are placed from there; its pivot is the origin, so that the direction of so short a
    /// distance is exact.
    fn of_neighbour(&self, linkage: &Linkage, neighbour: &Linkage, at: &[Rate]) -> (Vec<Rate>, Vec<Rate>) {
        let mut places = at.to_vec();
        let mut moved = at.to_vec();
        for (foot, own) in linkage.joints.iter().enumerate() {
            let kind = neighbour.joints[foot].kind;
            if let JointKind::Slot { base: [pivot, _], offset: 0.0, .. } = own.kind
                && kind != own.kind
            {
                places = at.iter().map(|place| place.minus(at[pivot.index()])).collect();
                moved.clone_from(&places);
                moved[foot] = self.placed(kind, &places[..foot]);
            }
        }
        (places, moved)
    }

    /// The place of a joint, from those before it.
    fn placed(&self, kind: JointKind, before: &[Rate]) -> Rate {
        let input = SeriesInput { value: self.input.value, direction: [self.input.cos, self.input.sin] };
        place_joint_as_series(kind, before, input, |dyad: DyadId| f64::from(self.mode.sign(dyad)))
    }

    /// The values of equations, which are zero in the pose, and their derivatives by the input together with the rates of the positions: of the last of all
    /// equations, without those of the joints before `first`, which do not depend on it. Those of the group are behind those of the joints.
    fn values(&self, linkage: &Linkage, first: usize, own: &[Rate], at: &[Rate]) -> Vec<Series<f64, 2>> {
        let of_joints = (first..at.len()).filter_map(|joint| self.of_joint(linkage, joint, own[joint], at)).flatten();
        let closures = linkage.group.iter().flat_map(|group| &group.closures);
        of_joints.chain(closures.flat_map(|closure| self.of_closure(closure, at))).collect()
    }

    /// The equations of what closes a loop of the group.
    fn of_closure(&self, closure: &Closure, at: &[Rate]) -> Vec<Series<f64, 2>> {
        let place = |joint: JointId| at[joint.index()];
        let squared = |[a, b]: [JointId; 2]| place(b).minus(place(a)).norm_squared();
        let constant = |value: f64| Series::constant(value);
        match *closure {
            Closure::Distance { joints, length } => vec![squared(joints) - constant(length * length)],
            Closure::Driven { joints } => vec![squared(joints) - Series::variable(self.input.value).square()],
            Closure::OnLink { joint, base: [p, q], along, across } => {
                let link = place(q).minus(place(p));
                let miss = place(joint).minus(place(p).moved(link, constant(along), constant(across)));
                vec![miss.x, miss.y]
            }
            Closure::OnLine { joint, line: [p, q], length, offset } => {
                let line = place(q).minus(place(p));
                vec![line.cross(place(joint).minus(place(p))) - constant(offset * length)]
            }
        }
    }

    /// The equations of a joint. Where a root would place it, they are those that it solves; where no root vanishes, the difference from the place itself.
    /// `None` of a joint of the group.
    fn of_joint(&self, linkage: &Linkage, joint: usize, own: Rate, at: &[Rate]) -> Option<[Series<f64, 2>; 2]> {
        let distance =
            |from: JointId, length: Series<f64, 2>| own.minus(at[from.index()]).norm_squared() - length.square();
        let constant = |value: f64| Series::constant(value);
        Some(match linkage.joints[joint].kind {
            JointKind::Grouped { .. } => return None,
            JointKind::Dyad { base, lengths, .. } => from_fn(|k| distance(base[k], constant(lengths[k]))),
            JointKind::Piston { base: [pivot, from], length, offset, .. } => {
                let input = Series::variable(self.input.value);
                [distance(pivot, input) - constant(offset * offset), distance(from, constant(length))]
            }
            JointKind::Slide { from, length, line: [p, q], offset, .. } => {
                let [p, q] = [p, q].map(|j| at[j.index()]);
                [q.minus(p).unit().cross(own.minus(p)) - constant(offset), distance(from, constant(length))]
            }
            JointKind::Slot { base: [p, q], offset, .. } if self.is_near_limit[joint] => {
                let [to_foot, to_joint] = [own.minus(at[p.index()]), at[q.index()].minus(own)];
                [to_foot.norm_squared() - constant(offset * offset), to_foot.dot(to_joint)]
            }
            JointKind::Aligned { from, line: [p, q], offset, along, across, .. }
                if self.is_near_limit[joint] && (along, across) != (0.0, 0.0) =>
            {
                let arm = own.minus(at[from.index()]);
                let square = along * along + across * across;
                // The arm turned back by its angle from the line is the line's direction.
                let line = VectorSeries {
                    x: (arm.x.scaled(along) + arm.y.scaled(across)).scaled(1.0 / square),
                    y: (arm.y.scaled(along) - arm.x.scaled(across)).scaled(1.0 / square),
                };
                let base = at[q.index()].minus(at[p.index()]);
                [arm.norm_squared() - constant(square), line.cross(base) - constant(offset)]
            }
            kind => {
                let placed = own.minus(self.placed(kind, &at[..joint]));
                [placed.x, placed.y]
            }
        })
    }
}
