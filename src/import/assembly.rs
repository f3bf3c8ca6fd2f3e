//! The pose of bodies that joints hold together, by Levenberg and Marquardt's method.

use coupler_curves::geometry::{Point, Vector, left_normal, trig};

/// The place of a body: that of its origin, and its angle in radians.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pose {
    pub origin: Vector,
    pub angle: f64,
}

impl Pose {
    /// A vector of the body in the plane.
    pub fn turn(self, [x, y]: [f64; 2]) -> Vector {
        let (cos, sin) = (trig::cos(self.angle), trig::sin(self.angle));
        Vector::new(cos * x - sin * y, sin * x + cos * y)
    }

    /// The pose after a change of its coordinates and its angle.
    fn moved(self, [x, y, angle]: [f64; 3]) -> Pose {
        Pose { origin: self.origin + Vector::new(x, y), angle: self.angle + angle }
    }

    /// A point of the body in the plane.
    pub fn place(self, point: [f64; 2]) -> Point {
        Point::from(self.origin + self.turn(point))
    }
}

/// What holds two bodies together.
#[derive(Clone, Copy, Debug)]
pub struct Hold {
    /// The bodies.
    pub bodies: [usize; 2],
    /// What is the same on both.
    pub kind: HoldKind,
}

/// What two bodies have in common.
#[derive(Clone, Copy, Debug)]
pub enum HoldKind {
    /// A point of each at one place.
    Point([[f64; 2]; 2]),
    /// A point of the second on a line through one of the first, in a direction of the first.
    Line([[f64; 2]; 2], [f64; 2]),
    /// The angle of the second less that of the first.
    Angle(f64),
}

/// A pose of bodies, of which the first is at rest, in which all that holds them does: that of the files' coordinates if it is
/// one, or else one near it. Lengths are in units of the size of the bodies.
pub fn assemble(body_count: usize, holds: &[Hold]) -> Option<Vec<Pose>> {
    /// How often it is begun in another pose.
    const STARTS: usize = 8;
    (0..STARTS).find_map(|start| descend(start_poses(body_count, start), holds))
}

/// Bodies that are turned and moved by amounts that differ: the first time by none.
fn start_poses(body_count: usize, start: usize) -> Vec<Pose> {
    /// The golden ratio, whose multiples modulo 1 are spread evenly.
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let spread = |k: usize| (k as f64 * GOLDEN).fract() - 0.5;
    let pose = |body: usize| {
        let k = (start * body_count + body) * 3;
        let angle = std::f64::consts::TAU * spread(k);
        Pose { origin: Vector::new(spread(k + 1), spread(k + 2)), angle }
    };
    (0..body_count).map(|body| if start == 0 || body == 0 { Pose::default() } else { pose(body) }).collect()
}

fn descend(mut poses: Vec<Pose>, holds: &[Hold]) -> Option<Vec<Pose>> {
    const MAX_STEPS: usize = 60;
    /// The greatest error of what is assembled.
    const TOLERANCE: f64 = 1e-10;
    /// Below it, the error is that of rounding.
    const ROUNDING: f64 = 1e-14;
    /// With more, the bodies do not move.
    const MAX_DAMPING: f64 = 1e6;
    let mut damping = 1e-3;
    let mut error = squares(&residuals(&poses, holds));
    for _ in 0..MAX_STEPS {
        if error.sqrt() <= ROUNDING || damping > MAX_DAMPING {
            break;
        }
        let step = solve(normal_equations(&poses, holds, damping))?;
        let moved = moved(&poses, &step);
        let next = squares(&residuals(&moved, holds));
        // Where the error hardly falls, it is at its least.
        let has_fallen = next < 0.999 * error;
        if next < error {
            (poses, error) = (moved, next);
        }
        damping *= if has_fallen { 0.1 } else { 10.0 };
    }
    (error.sqrt() <= TOLERANCE).then_some(poses)
}

fn squares(residuals: &[[f64; 2]]) -> f64 {
    residuals.iter().flatten().map(|value| value * value).sum()
}

/// How far bodies are from what holds them.
fn residuals(poses: &[Pose], holds: &[Hold]) -> Vec<[f64; 2]> {
    holds.iter().map(|hold| residual(hold.kind, hold.bodies.map(|body| poses[body]))).collect()
}

/// How far two bodies are from what holds them, in two numbers, of which the second may be 0.
fn residual(kind: HoldKind, [a, b]: [Pose; 2]) -> [f64; 2] {
    match kind {
        HoldKind::Point([p, q]) => (b.place(q) - a.place(p)).into(),
        HoldKind::Line([p, q], direction) => [left_normal(a.turn(direction)).dot(&(b.place(q) - a.place(p))), 0.0],
        // Not the difference itself: a turn more is the same.
        HoldKind::Angle(angle) => [2.0 * trig::sin((b.angle - a.angle - angle) / 2.0), 0.0],
    }
}

/// Poses after a step in the three coordinates of each body but the first.
fn moved(poses: &[Pose], step: &[f64]) -> Vec<Pose> {
    let changes = step.chunks_exact(3).map(|change| [change[0], change[1], change[2]]);
    let first = poses.iter().take(1).copied();
    first.chain(poses.iter().skip(1).zip(changes).map(|(pose, change)| pose.moved(change))).collect()
}

/// The normal equations of the next step, each with its right side last.
fn normal_equations(poses: &[Pose], holds: &[Hold], damping: f64) -> Vec<Vec<f64>> {
    let count = 3 * (poses.len() - 1);
    let mut rows = vec![vec![0.0; count + 1]; count];
    for hold in holds {
        let pair = hold.bodies.map(|body| poses[body]);
        let value = residual(hold.kind, pair);
        // The unknowns that it depends on, with its derivatives by them; the first body has none.
        let mut slopes = Vec::new();
        for (k, body) in hold.bodies.into_iter().enumerate().filter(|(_, body)| *body > 0) {
            slopes.extend((0..3).map(|axis| (3 * (body - 1) + axis, slope(hold.kind, pair, k, axis))));
        }
        for &(i, slope) in &slopes {
            slopes.iter().for_each(|&(j, other)| rows[i][j] += product(slope, other));
            rows[i][count] -= product(slope, value);
        }
    }
    for (k, row) in rows.iter_mut().enumerate() {
        row[k] += damping * (1.0 + row[k]);
    }
    rows
}

fn product([a, b]: [f64; 2], [c, d]: [f64; 2]) -> f64 {
    a * c + b * d
}

/// The derivative of how far two bodies are from what holds them by a coordinate of one, by differences to either side.
fn slope(kind: HoldKind, pair: [Pose; 2], body: usize, axis: usize) -> [f64; 2] {
    const STEP: f64 = 1e-6;
    let [ahead, behind] = [STEP, -STEP].map(|step| {
        let mut change = [0.0; 3];
        change[axis] = step;
        let mut pair = pair;
        pair[body] = pair[body].moved(change);
        residual(kind, pair)
    });
    [0, 1].map(|k| (ahead[k] - behind[k]) / (2.0 * STEP))
}

/// Solves equations by elimination; `None` if they have no single solution.
fn solve(mut rows: Vec<Vec<f64>>) -> Option<Vec<f64>> {
    let count = rows.len();
    for k in 0..count {
        let pivot = (k..count).max_by(|&a, &b| rows[a][k].abs().total_cmp(&rows[b][k].abs()))?;
        rows.swap(k, pivot);
        let (done, rest) = rows.split_at_mut(k + 1);
        let row = &done[k];
        if !row[k].is_normal() {
            return None;
        }
        for other in rest {
            let factor = other[k] / row[k];
            (k..=count).for_each(|column| other[column] -= factor * row[column]);
        }
    }
    let mut solution = vec![0.0; count];
    for k in (0..count).rev() {
        let known: f64 = (k + 1..count).map(|column| rows[k][column] * solution[column]).sum();
        solution[k] = (rows[k][count] - known) / rows[k][k];
    }
    Some(solution)
}
