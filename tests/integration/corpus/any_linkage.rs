//! Linkages of the catalogue with any parameters: from ordinary ones to 10^-300 and 10^300, equal to each other and nearly so.

use coupler_curves::catalogue;
use coupler_curves::exchange::PointTable;
use coupler_curves::family::Family;
use coupler_curves::geometry::{Bounds, trig};
use coupler_curves::linkage::Input;
use coupler_curves::measure::{COLUMNS, Value};
use coupler_curves::motion::Sampling;
use coupler_curves::path::{self, DashPattern};
use coupler_curves::solve::{SolvedCell, Solver, Status};

/// Numbers from bytes, 0 where there are no more.
struct Choices<'a>(&'a [u8]);

impl Choices<'_> {
    /// A number below `count`, at most 256.
    fn below(&mut self, count: usize) -> usize {
        let (first, rest) = self.0.split_first().unwrap_or((&0, &[]));
        self.0 = rest;
        usize::from(*first) % count
    }

    /// A number from 0 up to 1.
    fn share(&mut self) -> f64 {
        (self.below(256) * 256 + self.below(256)) as f64 / 65536.0
    }

    /// A power of ten between two exponents.
    fn power(&mut self, [from, to]: [f64; 2]) -> f64 {
        trig::exp((from + (to - from) * self.share()) * std::f64::consts::LN_10)
    }

    /// A number and the same but for a part of 10^-1 to 10^-16: a change point and one that is nearly one.
    fn near(&mut self, value: f64) -> f64 {
        let part = self.power([-16.0, -1.0]);
        value * (1.0 + [part, -part, 0.0][self.below(3)])
    }

    /// One of the numbers so far.
    fn earlier(&mut self, values: &[(String, f64)]) -> f64 {
        if values.is_empty() { 1.0 } else { values[self.below(values.len())].1 }
    }

    /// A parameter; `None` for its default. In a linkage of an ordinary `style` most are ordinary.
    fn parameter(&mut self, style: usize, values: &[(String, f64)]) -> Option<f64> {
        let kinds = self.below(8);
        let value = match (style, kinds) {
            (0, _) => self.power([-300.0, 300.0]),
            (1, 0 | 1) => self.power([-300.0, 300.0]),
            (1, _) | (2, 0..4) | (3, 0 | 1) => [1.0, 2.0, 3.0, 4.0, 2.5, 3.5, 0.5, 1.5][self.below(8)],
            (_, 4) => self.power([-12.0, 1.0]),
            (_, 5) => {
                let value = self.earlier(values);
                self.near(value)
            }
            (_, 6) => {
                let value = self.earlier(values) + self.earlier(values);
                self.near(value)
            }
            (_, 7) => {
                let value = self.earlier(values) + self.earlier(values) - self.earlier(values);
                self.near(value)
            }
            (_, 3) => 0.0,
            _ => return None,
        };
        Some(if self.below(8) == 0 { -value } else { value })
    }
}

/// A linkage and its parameters as bytes choose them.
fn chosen(bytes: &[u8]) -> (&'static str, Vec<(String, f64)>) {
    let mut choices = Choices(bytes);
    let template = &catalogue::all()[choices.below(catalogue::all().len())];
    let style = choices.below(4);
    let mut values: Vec<(String, f64)> = Vec::new();
    for parameter in &template.parameters {
        let value = choices.parameter(style, &values);
        let value = value.or_else(|| parameter.default.is_none().then_some(2.0));
        values.extend(value.map(|value| (parameter.name.clone(), value)));
    }
    (&template.id, values)
}

/// Asserts that a linkage that bytes choose is refused, or solved and measured without a panic, and that its curves can be drawn
/// and written. Returns whether it has a curve.
pub fn measures(bytes: &[u8]) -> bool {
    let (linkage, values) = chosen(bytes);
    let template = catalogue::find(linkage).expect("it is in the catalogue");
    let Ok(family) = Family::single_cell(template, &values, Sampling::Samples(12)) else { return false };
    let family = Family { columns: COLUMNS.to_vec(), ..family };
    let Some(solved) = Solver::new(&family).solve(0) else { return false };
    assert!(solved.status() != Status::Failed, "{}", solved.reason());
    for curve in &solved.curves {
        let is_number = |value: &Value| !matches!(value, Value::Number(number) if number.is_nan());
        assert!(curve.values.iter().all(is_number), "{:?}", curve.values);
    }
    PointTable::new(&family).append_rows(&solved, &mut Vec::new());
    draw(&solved);
    family.format_captions(&solved.cell, solved.first_curve_values());
    !solved.curves.is_empty()
}

/// Computes the paths of curves as a page has them.
fn draw(solved: &SolvedCell) {
    for curve in &solved.curves {
        let circuit = solved.circuit(curve);
        let [bounds, linkage] = [&[curve.joint][..], &solved.linkage.joint_ids().collect::<Vec<_>>()]
            .map(|joints| Bounds::from_points(joints.iter().flat_map(|joint| circuit.points(*joint))));
        // A page shows a curve as a point if rounding would be visible.
        let (extent, greatest) = (bounds.size().max(), linkage.min.coords.amax().max(linkage.max.coords.amax()));
        if extent <= 1e-10 * greatest {
            continue;
        }
        let tolerance = 1e-4 * extent;
        let dashes = DashPattern { period: 5.0, dash_span: 3.0 };
        if solved.linkage.input() != Input::Length {
            path::joint_path(&solved.linkage, circuit, curve.joint, dashes, tolerance);
        }
        path::joint_polyline(&solved.linkage, circuit, curve.joint, tolerance);
    }
}

/// The linkage that bytes choose, as it is given to `inspect`.
pub fn command(bytes: &[u8]) -> String {
    let (linkage, values) = chosen(bytes);
    let values: Vec<String> = values.iter().map(|(name, value)| format!("{name}={value:e}")).collect();
    format!("coupler-atlas inspect {linkage} {}", values.join(" "))
}
