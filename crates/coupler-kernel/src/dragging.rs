//! Handles: joints that are moved to places by the dimensions of a linkage, its input held.

use serde_json::{Value, json};

use coupler_curves::geometry::{Point, Vector};
use coupler_curves::linkage::JointId;
use coupler_curves::motion::{Pass, poses};
use coupler_curves::solve::{ChangedCell, MovablePoint};

use crate::family::OpenFamily;
use crate::request::CurveRequest;
use crate::study::{Place, Study};

/// A step of a value by which derivatives are computed, in the value's unit.
const STEP: f64 = 1e-6;

/// A joint that moves by less than this, in sizes of the linkage for a unit of a value, does not move but for rounding.
const MOVES: f64 = 1e-7;

/// The most steps of Levenberg and Marquardt's method: far from its end the pointer has moved on.
const STEPS: usize = 25;

/// A joint is where it is to be, in sizes of the linkage.
const REACHED: f64 = 1e-12;

/// The linkage of a study with other dimensions, at an input of one of its passes.
pub(crate) struct Dragging<'a> {
    family: &'a OpenFamily,
    curve: &'a CurveRequest,
    study: &'a Study,
    pass: &'a Pass,
    input: f64,
    /// The size of the linkage.
    size: f64,
}

/// A value that may change: of a parameter, a helper, or a coordinate of the traced point.
#[derive(Clone, Debug)]
struct Unlocked {
    name: String,
    value: f64,
    /// What counts as a change of 1.
    unit: f64,
    /// The least and the greatest value.
    bounds: [f64; 2],
}

impl Unlocked {
    /// The value after a step in its unit, within its bounds, of which 0 is never reached.
    fn moved(&self, by: f64) -> f64 {
        let [low, high] = self.bounds;
        let value = (self.value + by * self.unit).clamp(low, high);
        let is_at_zero = value == 0.0 && (low == 0.0 || high == 0.0);
        if is_at_zero { self.value / 2.0 } else { value }
    }
}

impl<'a> Dragging<'a> {
    /// A study of a curve at a place. `None` if it has no such pass.
    pub fn new(
        family: &'a OpenFamily,
        curve: &'a CurveRequest,
        study: &'a Study,
        place: Place,
    ) -> Option<Dragging<'a>> {
        let pass = study.passes().get(place.pass)?;
        let size = study.bounds(&[study.joint]).size().norm();
        Some(Dragging { family, curve, study, pass, input: place.input, size })
    }

    /// All values that no expression gives and that are not whole numbers, as they are.
    fn unlocked(&self) -> Result<Vec<Unlocked>, String> {
        let ChangedCell { family, numbers, .. } = self.family.changed_cell(self.curve)?;
        let cell = family.cell(0);
        let values = &cell.values;
        let greatest =
            values.iter().filter(|value| value.is_finite()).fold(0.0, |most: f64, value| most.max(value.abs()));
        // The unit of a small value is not small: it would not move.
        let unlocked = |name: String, value: f64, bounds: [f64; 2]| Unlocked {
            name,
            value,
            unit: value.abs().max(0.1 * greatest),
            bounds,
        };
        let own = self.family.names().into_iter().filter(|name| !name.is_derived && !name.is_whole);
        let named = own.filter_map(|name| {
            let bounds = [name.min.unwrap_or(f64::NEG_INFINITY), name.max.unwrap_or(f64::INFINITY)];
            let value = values.get(name.slot).copied().filter(|value| value.is_finite())?;
            Some(unlocked(name.name.to_owned(), value, bounds))
        });
        let mut all: Vec<Unlocked> = named.collect();
        let trace = self.curve.curve[0];
        let template = &self.family.planned.family.template;
        let parameters = family.parameter_values(&cell);
        let name = MovablePoint::of_trace(template, trace, parameters).map(|point| point.name);
        if let Some((name, point)) =
            name.zip(MovablePoint::of_trace(&family.template, numbers.trace(trace), parameters))
        {
            for (way, coordinate) in ["along", "across"].into_iter().zip(point.coordinates) {
                if coordinate.is_constant && coordinate.value.is_finite() {
                    let any = [f64::NEG_INFINITY, f64::INFINITY];
                    all.push(unlocked(format!("{name}.{way}"), coordinate.value, any));
                }
            }
        }
        Ok(all)
    }

    /// The positions of all joints with other values, the traced one where it was among them. `None` if it cannot be assembled.
    fn joints(&self, values: &[Unlocked]) -> Option<Vec<Point>> {
        let mut curve = self.curve.clone();
        for Unlocked { name, value, .. } in values {
            curve.changes.retain(|(other, _)| other != name);
            curve.changes.push((name.clone(), *value));
        }
        let ChangedCell { family, numbers, .. } = self.family.changed_cell(&curve).ok()?;
        let linkage = family.linkage(&family.cell(0)).ok()?;
        let positions = poses(&linkage, &self.pass.of_neighbour(&linkage)?, &[self.input]);
        let mut all: Vec<Point> = linkage.joint_ids().map(|joint| positions.point(joint, 0)).collect();
        // A moved point of a grid is a joint of its own.
        let traced = *linkage.traced.get(numbers.trace(curve.curve[0]).checked_sub(1)?)?;
        *all.get_mut(self.study.joint.index())? = positions.point(traced, 0);
        /// Of a length.
        const ROUNDING: f64 = 1e-9;
        let are_there = all.iter().all(|p| p.x.is_finite() && p.y.is_finite());
        (are_there && positions.keep_lengths(&linkage, ROUNDING)).then_some(all)
    }

    /// The values, each moved by a step in its unit.
    fn moved(values: &[Unlocked], by: &[f64]) -> Vec<Unlocked> {
        values.iter().zip(by).map(|(one, by)| Unlocked { value: one.moved(*by), ..one.clone() }).collect()
    }

    /// The motion of all joints for a unit of each value.
    fn rates(&self, values: &[Unlocked], at: &[Point]) -> Vec<Vec<Vector>> {
        let motion = |k: usize, step: f64| {
            let mut by = vec![0.0; values.len()];
            by[k] = step;
            let moved = Dragging::moved(values, &by);
            // At a bound there is no step beyond it, and next to it a shorter one.
            let step = (moved[k].value - values[k].value) / values[k].unit;
            let joints = self.joints(&moved).filter(|_| step.abs() > STEP / 2.0)?;
            Some(at.iter().zip(joints).map(|(before, after)| (after - before) / step).collect())
        };
        let none = || vec![Vector::zeros(); at.len()];
        (0..values.len()).map(|k| motion(k, STEP).or_else(|| motion(k, -STEP)).unwrap_or_else(none)).collect()
    }

    /// The joints that are drawn, and the traced one.
    fn shown_joints(&self) -> Vec<JointId> {
        let mut joints = self.study.mechanism.drawn_joints(&self.study.linkage);
        joints.push(self.study.joint);
        joints.sort_unstable();
        joints.dedup();
        joints
    }

    fn moves(&self, rates: &[Vector], joint: JointId) -> bool {
        rates[joint.index()].norm() > MOVES * self.size
    }

    /// The numbers of the values that move a joint, those first that move the fewest others: at most as many as it takes to move it in both
    /// directions of the plane, so that the coupler point moves by its coordinates, and a pin by the lengths at it.
    fn nearest(&self, rates: &[Vec<Vector>], joint: JointId) -> Vec<usize> {
        /// The square of the sine of the angle between two rates that are two directions.
        const APART: f64 = 0.01;
        let joints = self.shown_joints();
        let moved = |k: usize| joints.iter().filter(|other| self.moves(&rates[k], **other)).count();
        let mut order: Vec<(usize, usize)> =
            (0..rates.len()).filter(|k| self.moves(&rates[*k], joint)).map(|k| (moved(k), k)).collect();
        order.sort_unstable();
        let is_apart = |a: Vector, b: Vector| {
            let cross = a.x * b.y - a.y * b.x;
            cross * cross > APART * a.norm_squared() * b.norm_squared()
        };
        let of = |k: usize| rates[k][joint.index()];
        let spans = |count: usize| order[..count].iter().any(|(_, k)| is_apart(of(order[0].1), of(*k)));
        let enough = (1..=order.len()).find(|count| spans(*count)).unwrap_or(order.len());
        // Those that move as many are as near.
        let last = enough.checked_sub(1).map_or(0, |k| order[k].0);
        order.into_iter().take_while(|(count, _)| *count <= last).map(|(_, k)| k).collect()
    }

    /// The joints that are moved by values, with the names of these, and of those by which they are moved if none is locked.
    ///
    /// # Errors
    /// What is wrong with the curve.
    pub fn handles(&self) -> Result<Value, String> {
        let values = self.unlocked()?;
        let Some(at) = self.joints(&values) else { return Ok(json!({ "handles": [] })) };
        let rates = self.rates(&values, &at);
        let name = |k: usize| values[k].name.as_str();
        let handle = |joint: JointId| {
            let names: Vec<&str> = (0..values.len()).filter(|k| self.moves(&rates[*k], joint)).map(name).collect();
            let nearest: Vec<&str> = self.nearest(&rates, joint).into_iter().map(name).collect();
            (!names.is_empty()).then(|| json!({ "joint": joint.index(), "names": names, "nearest": nearest }))
        };
        Ok(json!({ "handles": self.shown_joints().into_iter().filter_map(handle).collect::<Vec<_>>() }))
    }

    /// Moves a joint to a place by the nearest of some values, or as near to it as they can: Levenberg and Marquardt's method, whose steps are short
    /// in the units of the values.
    ///
    /// # Errors
    /// What is wrong with the curve.
    pub fn drag(&self, joint: usize, to: Point, names: &[String]) -> Result<Value, String> {
        let all: Vec<Unlocked> = self.unlocked()?.into_iter().filter(|one| names.contains(&one.name)).collect();
        let Some(mut at) = self.joints(&all).filter(|at| joint < at.len()) else {
            return Ok(json!({ "changes": [], "is_held": false, "distance": null }));
        };
        let nearest = self.nearest(&self.rates(&all, &at), JointId::new(joint));
        let mut values: Vec<Unlocked> = nearest.into_iter().map(|k| all[k].clone()).collect();
        let before: Vec<f64> = values.iter().map(|one| one.value).collect();
        // Relative to the squares of the rates.
        let mut damping = 1e-3;
        for _ in 0..STEPS {
            let offset = to - at[joint];
            if offset.norm() <= REACHED * self.size {
                break;
            }
            let rates: Vec<Vector> = self.rates(&values, &at).iter().map(|of_value| of_value[joint]).collect();
            let mut is_nearer = false;
            while !is_nearer && damping < 1e9 {
                let trial = Dragging::moved(&values, &step(&rates, &values, offset, damping));
                let found = self.joints(&trial).filter(|found| (to - found[joint]).norm() < offset.norm());
                is_nearer = found.is_some();
                damping *= if is_nearer { 0.1 } else { 10.0 };
                if let Some(found) = found {
                    (values, at) = (trial, found);
                }
            }
            if !is_nearer {
                break;
            }
        }
        let changes: Vec<Value> = values
            .iter()
            .zip(before)
            .filter(|(one, before)| one.value != *before)
            .map(|(one, _)| json!([one.name, one.value]))
            .collect();
        Ok(json!({ "changes": changes, "is_held": true, "distance": (to - at[joint]).norm() }))
    }
}

/// The step of the values that moves a joint by an offset, damped: J' (J J' + d I)⁻¹ r with the rates J of the values that are not held by their bounds.
fn step(rates: &[Vector], values: &[Unlocked], offset: Vector, damping: f64) -> Vec<f64> {
    let mut is_held = vec![false; rates.len()];
    loop {
        let free = || rates.iter().zip(&is_held).filter(|(_, is_held)| !**is_held).map(|(rate, _)| rate);
        let sum = |of: fn(&Vector) -> f64| free().map(of).sum::<f64>();
        let (xx, xy, yy) = (sum(|r| r.x * r.x), sum(|r| r.x * r.y), sum(|r| r.y * r.y));
        let more = (damping * (xx + yy)).max(f64::MIN_POSITIVE);
        let (xx, yy) = (xx + more, yy + more);
        let determinant = xx * yy - xy * xy;
        let x = (yy * offset.x - xy * offset.y) / determinant;
        let y = (xx * offset.y - xy * offset.x) / determinant;
        let by: Vec<f64> = rates
            .iter()
            .zip(&is_held)
            .map(|(rate, is_held)| if *is_held { 0.0 } else { rate.x * x + rate.y * y })
            .collect();
        // A value at its bound that would go beyond it is held, and the others make up for it.
        let beyond = by
            .iter()
            .zip(values)
            .zip(&is_held)
            .position(|((by, one), is_held)| !*is_held && *by != 0.0 && one.moved(*by) == one.value);
        match beyond {
            Some(k) => is_held[k] = true,
            None => return by,
        }
    }
}
