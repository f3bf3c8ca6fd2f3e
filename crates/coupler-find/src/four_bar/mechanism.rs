//! A four-bar of an answer, solved: its circuit, its input along the target, its class and its transmission angle.

use std::sync::{Arc, LazyLock};

use crate::condition::Condition;

use coupler_curves::family::{Family, Sampling};
use coupler_curves::geometry::{Point, cross, left_normal, trig};
use coupler_curves::linkage::{FourBar, PlacedFourBar, Side};
use coupler_curves::linkage_format;
use coupler_curves::measure::{Measure, MeasureSet};
use coupler_curves::motion::Circuit;
use coupler_curves::solve::{SolvedCell, Solver};
use coupler_curves::template::Template;

/// A four-bar whose coupler point traces the curve of an answer, in the unit and axes of the target.
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanism {
    /// The four-bar.
    pub four_bar: PlacedFourBar,
    /// The crank pin and the rocker pin at the first point of the target.
    pub pins: [Point; 2],
    /// The side of the line from the crank pin to the rocker's pivot on which the rocker pin is then.
    pub side: Side,
    /// The angle from the x-axis to the crank at the first and at the last point of the target, in degrees, continuous along the
    /// motion between them.
    pub input_deg: [f64; 2],
    /// Whether the input falls at the first point as the target is followed.
    pub is_reversed: bool,
    /// The number of the circuit, from 1, among those of [`Mechanism::template`].
    pub circuit: usize,
    /// Its class; see [`coupler_curves::linkage::FourBarClass::name`].
    pub class: &'static str,
    /// Whether the input turns fully.
    pub is_full_turn: bool,
    /// The worst transmission angle over the circuit, in degrees, 0 to 90.
    pub mu_worst_deg: f64,
    /// Whether it meets the constraints of the search.
    pub meets_constraints: bool,
}

impl Condition {
    /// Whether a four-bar meets the condition on the circuit with these positions of its crank pin and its rocker pin.
    pub(crate) fn is_met(&self, four_bar: &PlacedFourBar, pins: [Point; 2]) -> bool {
        let Some((mut family, solved, circuit)) = solve_on_circuit(four_bar, pins, Some(self), MeasureSet::EMPTY)
        else {
            return false;
        };
        family.filter = Some(self.compiled().clone());
        family.keeps(&solved.cell, &solved.curves[circuit].values)
    }
}

static TEMPLATE: LazyLock<Arc<Template>> = LazyLock::new(|| {
    let templates = linkage_format::parse_templates(Mechanism::TEMPLATE_TOML);
    Arc::new(templates.expect("the linkage is valid").remove(0))
});

/// The measures that are always computed.
const REPORTED: MeasureSet = MeasureSet::EMPTY.with(Measure::CLASS).with(Measure::MU_WORST);

impl Mechanism {
    /// The linkage of all answers, as the `[[linkage]]` of a manifest.
    pub const TEMPLATE_TOML: &'static str = include_str!("placed-four-bar.toml");

    /// The linkage of all answers: a four-bar anywhere in the plane.
    pub fn template() -> Arc<Template> {
        TEMPLATE.clone()
    }

    /// The parameters of [`Mechanism::template`].
    pub fn parameters(&self) -> [(&'static str, f64); 9] {
        placed_parameters(&self.four_bar)
    }

    /// What its links are if lengths that differ by less than a thousandth of the longest are the same, and it is then at a change point: its class
    /// is decided by less than links are made to.
    pub fn degeneracy(&self) -> Option<&'static str> {
        const SAME: f64 = 1e-3;
        let FourBar { frame, crank, coupler, rocker } = self.four_bar.lengths;
        let mut lengths = [frame, crank, coupler, rocker];
        lengths.sort_by(f64::total_cmp);
        let [shortest, short, long, longest] = lengths;
        let are_same = |a: f64, b: f64| (a - b).abs() <= SAME * longest;
        match (are_same(frame, coupler), are_same(crank, rocker)) {
            _ if are_same(shortest, 0.0) => Some("a link without length"),
            _ if are_same(shortest, longest) => Some("four equal links: change point"),
            (true, true) => Some("equal opposite links: change point"),
            _ if are_same(shortest, short) && are_same(long, longest) => Some("equal neighbouring links: change point"),
            _ if are_same(shortest + longest, short + long) => Some("all but a change point"),
            _ => None,
        }
    }

    /// The direction in which the crank turns as the target is followed: `forward` if the input rises at its first point.
    pub fn direction(&self) -> &'static str {
        if self.is_reversed { "backward" } else { "forward" }
    }

    /// [`Mechanism::side`] in a word.
    pub fn side_name(&self) -> &'static str {
        if self.side == Side::Left { "left" } else { "right" }
    }

    /// The greatest distance of two joints of a link.
    pub fn longest_link(&self) -> f64 {
        let PlacedFourBar { lengths: FourBar { frame, crank, coupler, rocker }, coupler_point: point, .. } =
            self.four_bar;
        let length = |x: f64, y: f64| (x * x + y * y).sqrt();
        let sides = [length(point.x, point.y), length(point.x - coupler, point.y)];
        [frame, crank, coupler, rocker].into_iter().chain(sides).fold(0.0, f64::max)
    }

    /// The positions of the joints of [`Mechanism::template`] at the first point of the target.
    pub fn pose(&self) -> Vec<Point> {
        let [o, c] = self.four_bar.pivots;
        let [a, b] = self.pins;
        let along = (b - a) / self.four_bar.lengths.coupler;
        let point = self.four_bar.coupler_point;
        vec![o, c, a, b, a + along * point.x + left_normal(along) * point.y]
    }

    /// The solved linkage with the curve of the answer only, without measures.
    pub fn solved(&self) -> Option<SolvedCell> {
        let family = family(&self.four_bar)?;
        let solved = Solver::new(&family).measuring(MeasureSet::EMPTY).solve(0)?;
        let curve = solved.curves.iter().find(|curve| curve.circuit == self.circuit)?;
        Some(solved.with_curve(curve))
    }

    /// Solves a four-bar, given by its crank pin and its rocker pin at each point of the target. `None` if it cannot be
    /// assembled.
    pub(crate) fn solve(
        four_bar: PlacedFourBar,
        pins: &[[Point; 2]],
        condition: Option<&Condition>,
    ) -> Option<Mechanism> {
        let &[first, ..] = pins else { return None };
        let (mut family, solved, circuit) = solve_on_circuit(&four_bar, first, condition, REPORTED)?;
        let curve = &solved.curves[circuit];
        let circuit = solved.circuit(curve);
        let is_full_turn = circuit.is_full_turn();
        let inputs: Vec<f64> = pins.iter().map(|pins| input_of(&four_bar, pins)).collect();
        let turn_from_first = |input: &f64| wrapped(input - inputs[0]);
        // Neighbouring points may share a pose.
        let first_turn = inputs.iter().map(turn_from_first).find(|turn| turn.abs() > 1e-9);
        let is_reversed = first_turn.is_some_and(|turn| turn < 0.0);
        let [from, to] = [inputs[0], inputs[inputs.len() - 1]];
        let input_deg = match is_full_turn {
            true if is_reversed => [from, from - (from - to).rem_euclid(360.0)],
            true => [from, from + (to - from).rem_euclid(360.0)],
            false => {
                let samples = || circuit.inputs.iter().copied();
                let middle =
                    0.5 * (samples().fold(f64::INFINITY, f64::min) + samples().fold(f64::NEG_INFINITY, f64::max));
                [from, to].map(|input| middle + wrapped(input - middle))
            }
        };
        family.filter = condition.map(|condition| condition.compiled().clone());
        Some(Mechanism {
            four_bar,
            pins: first,
            side: side_of(&four_bar, &first),
            input_deg,
            is_reversed,
            circuit: curve.circuit,
            class: curve.measure(Measure::CLASS).unwrap_or(""),
            is_full_turn,
            mu_worst_deg: curve.measure(Measure::MU_WORST).unwrap_or(f64::NAN),
            meets_constraints: family.keeps(&solved.cell, &curve.values),
        })
    }
}

/// A four-bar, solved, with the measures that a condition needs and others; and the index of the curve on the
/// circuit with these positions of its crank pin and its rocker pin.
fn solve_on_circuit(
    four_bar: &PlacedFourBar,
    pins: [Point; 2],
    condition: Option<&Condition>,
    reported: MeasureSet,
) -> Option<(Family, SolvedCell, usize)> {
    let family = family(four_bar)?;
    let used = condition.map_or(MeasureSet::EMPTY, |condition| family.measures_in(condition.compiled()));
    let solved = Solver::new(&family).measuring(used | reported).solve(0)?;
    let distance = |k: &usize| distance_from(&solved, solved.circuit(&solved.curves[*k]), pins);
    let nearest = (0..solved.curves.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    Some((family, solved, nearest))
}

/// The family of one cell, a four-bar.
fn family(four_bar: &PlacedFourBar) -> Option<Family> {
    let values = placed_parameters(four_bar).map(|(name, value)| (name.to_owned(), value));
    Family::single_cell(TEMPLATE.clone(), &values, Sampling::Samples(360)).ok()
}

/// The parameters of [`Mechanism::template`] for a four-bar.
pub fn placed_parameters(four_bar: &PlacedFourBar) -> [(&'static str, f64); 9] {
    let PlacedFourBar { pivots: [o, c], lengths: FourBar { frame, crank, coupler, rocker }, coupler_point } = four_bar;
    let turn = trig::degrees(trig::atan2(c.y - o.y, c.x - o.x));
    [
        ("frame", *frame),
        ("crank", *crank),
        ("coupler", *coupler),
        ("rocker", *rocker),
        ("along", coupler_point.x),
        ("across", coupler_point.y),
        ("x", o.x),
        ("y", o.y),
        ("turn", turn),
    ]
}

/// An angle in degrees, from -180 to 180.
fn wrapped(angle: f64) -> f64 {
    (angle + 180.0).rem_euclid(360.0) - 180.0
}

/// The angle from the x-axis to the crank, in degrees.
fn input_of(four_bar: &PlacedFourBar, [a, _]: &[Point; 2]) -> f64 {
    let arm = a - four_bar.pivots[0];
    trig::degrees(trig::atan2(arm.y, arm.x))
}

/// The side of the line from the crank pin to the rocker's pivot on which the rocker pin is.
fn side_of(four_bar: &PlacedFourBar, [a, b]: &[Point; 2]) -> Side {
    if cross(four_bar.pivots[1] - a, b - a) >= 0.0 { Side::Left } else { Side::Right }
}

/// The least sum of the squares of the distances of the pins from those of a circuit's samples.
fn distance_from(SolvedCell { linkage, .. }: &SolvedCell, circuit: &Circuit, [a, b]: [Point; 2]) -> f64 {
    let Some([_, crank_pin, rocker_pin, _]) = FourBar::pins(linkage) else { return f64::INFINITY };
    let squares = circuit.points(crank_pin).zip(circuit.points(rocker_pin));
    squares.map(|(p, q)| (p - a).norm_squared() + (q - b).norm_squared()).fold(f64::INFINITY, f64::min)
}
