//! Rows of exported curves, and how far they are from the curve of a manifest.

use std::path::Path;

use coupler_curves::geometry::Point;
use coupler_curves::linkage::Input;
use coupler_curves::motion::{self, Motion, Sampler};

use super::command::printed;
use super::plan::plan;

/// The input, x and y of each row of an exported curve.
pub fn rows(folder: &Path, arguments: &[&str]) -> Vec<[f64; 3]> {
    let table = printed(folder, &[arguments, &["--format", "csv"]].concat());
    let mut table = csv::Reader::from_reader(table.as_bytes());
    let header = table.headers().unwrap().clone();
    let is_input = |column: &str| matches!(column, "input_deg" | "input_length");
    let columns: [&dyn Fn(&str) -> bool; 3] = [&is_input, &|column| column == "x", &|column| column == "y"];
    let columns = columns.map(|is_it| header.iter().position(is_it).unwrap());
    let rows = table.records().map(|row| columns.map(|column| row.as_ref().unwrap()[column].parse::<f64>().unwrap()));
    rows.collect()
}

/// The greatest distance of rows from the point that the first family of a manifest traces first, on whichever pass is nearest, at
/// the same input.
pub fn distance_to_curve(manifest: &str, rows: impl Iterator<Item = [f64; 3]>) -> f64 {
    let plan = plan(manifest);
    let family = &plan.families[0].family;
    let linkage = family.linkage(&family.cell(0)).unwrap();
    let motion = Motion::solve(&linkage, &Sampler::new(family.sampling));
    let traced = linkage.traced[0];
    let passes: Vec<_> = motion.circuits.iter().flat_map(|circuit| &circuit.passes).collect();
    let is_angle = linkage.input() != Input::Length;
    let distance = |[input, x, y]: [f64; 3]| {
        let distances = passes.iter().filter_map(|pass| {
            let (from, to) = (pass.from.input.value, pass.to.input.value);
            let turns = if is_angle { ((from.min(to) - 1e-9 - input) / 360.0).ceil() * 360.0 } else { 0.0 };
            let at = input + turns;
            let is_on_pass = (from.min(to) - 1e-9..=from.max(to) + 1e-9).contains(&at);
            let at = at.clamp(from.min(to), from.max(to));
            is_on_pass.then(|| (motion::pose(&linkage, pass, at)[traced.index()] - Point::new(x, y)).norm())
        });
        distances.fold(f64::INFINITY, f64::min)
    };
    rows.step_by(7).map(distance).fold(0.0, f64::max)
}
