//! A fragment of a manifest, the TOML file that an atlas is made from, that reproduces the cells of some curves: one
//! family for each combination of linkage and settings.

use std::collections::HashMap;
use std::fmt::Write;

use super::SelectedCurve;
use super::linkage_in_numbers::load_to_toml;
use super::number::format_number;
use super::sampling_fields::sampling_fields;
use crate::catalogue;
use crate::family::{Family, MAX_CELLS, StraightCriterion};
use crate::linkage::DwellBand;
use crate::linkage_format::{quoted, toml_number};
use crate::template::{CircuitSelection, CoincidentDyads, Continuation, Orientation, Template};

/// The families of some parameter sets, in their order, to be put into a manifest that has an `[atlas]` and the custom
/// linkages that they use. A cell with several curves is written once.
pub fn manifest_fragment(cases: &[ParameterSet]) -> String {
    "# Put this into a manifest with an [atlas].\n".to_owned() + &manifest_families(cases, false)
}

/// The families of some parameter sets, in their order. If the manifest has no custom linkages, a comment says of each which is missing.
pub fn manifest_families(cases: &[ParameterSet], has_linkages: bool) -> String {
    let mut families: Vec<(String, Vec<&ParameterSet>)> = Vec::new();
    for case in cases {
        let settings = family_settings(case.family);
        match families
            .iter_mut()
            .find(|(known, others)| *known == settings && others[0].family.title == case.family.title)
        {
            Some((_, others)) => others.push(case),
            None => families.push((settings, vec![case])),
        }
    }
    let mut out = String::new();
    for (k, (settings, cases)) in families.iter().enumerate() {
        let id = &cases[0].family.template.id;
        let earlier = families[..k].iter().filter(|(_, others)| others[0].family.template.id == *id).count();
        if !has_linkages && !is_built_in(&cases[0].family.template) {
            let _ = write!(out, "\n# The [[linkage]] `{id}` is the atlas's own: copy it from its manifest.");
        }
        write_family(&family_id(id, earlier + 1), settings, cases, &mut out);
    }
    out
}

/// The id of the n-th family of a linkage: the linkage's id, shortened if needed, and a suffix.
pub fn family_id(linkage: &str, number: usize) -> String {
    let stem: String = linkage.chars().take(50).collect();
    let stem = stem.trim_end_matches('-');
    if number == 1 { format!("{stem}-exported") } else { format!("{stem}-exported-{number}") }
}

/// Writes one family, with a row of parameter values for each cell.
fn write_family(id: &str, settings: &str, cases: &[&ParameterSet], out: &mut String) {
    let template = &cases[0].family.template;
    let mut rows: Vec<(String, Vec<&str>)> = Vec::new();
    let mut places: HashMap<String, usize> = HashMap::new();
    for case in cases {
        let value = |(k, value): (usize, &f64)| format!("{} = {}", template.parameters[k].name, format_number(*value));
        let values: Vec<String> = case.values.iter().enumerate().map(value).collect();
        let row = if values.is_empty() { "{}".to_owned() } else { format!("{{ {} }}", values.join(", ")) };
        match places.get(&row).and_then(|place| rows.get_mut(*place)) {
            Some((_, names)) => names.push(&case.curve_name),
            None => {
                places.insert(row.clone(), rows.len());
                rows.push((row, vec![&case.curve_name]));
            }
        }
    }
    let columns = rows.len().min(3);
    let panels = [columns, rows.len().div_ceil(columns.max(1)).min(3)];
    let limit = if rows.len() > MAX_CELLS { format!("limit = {}\n", rows.len()) } else { String::new() };
    // Writing to a string cannot fail.
    let _ = write!(
        out,
        "\n[[family]]\nid = \"{id}\"\nlinkage = \"{}\"\ntitle = {}\npanels = [{}, {}]\n{limit}{settings}cases = [\n",
        template.id,
        quoted(&cases[0].family.title),
        panels[0],
        panels[1]
    );
    for (row, names) in rows {
        let _ = writeln!(out, "    {row}, # {}", names.join(", "));
    }
    out.push_str("]\n");
}

/// Whether a linkage is one of the catalogue's.
fn is_built_in(template: &Template) -> bool {
    catalogue::find(&template.id).is_some()
}

/// The settings of a family other than its cells, which distinguish the families of one linkage.
pub fn family_settings(family: &Family) -> String {
    let template = &family.template;
    let circuits = match template.circuits {
        CircuitSelection::Start => "start",
        CircuitSelection::All => "all",
    };
    let mut out = sampling_setting(family);
    let _ = writeln!(out, "circuits = \"{circuits}\"");
    out += &continuation_settings(template);
    // A linkage that is not of the catalogue may trace others in its manifest.
    if catalogue::find(&template.id).is_none_or(|own| own.traced != template.traced) {
        let names: Vec<String> = template.traced.iter().map(|joint| quoted(&template.joints[*joint].name)).collect();
        let _ = writeln!(out, "trace = [{}]", names.join(", "));
    }
    if template.orientation != Orientation::default() {
        let _ = writeln!(out, "place = {}", placement_to_toml(&template.orientation));
    }
    out += &straight_setting(family);
    out += &dwell_setting(template);
    if let Some(tolerance) = template.tolerance {
        let _ = writeln!(out, "tolerance = {}", toml_number(tolerance));
    }
    if let Some(load) = template.load {
        let _ = writeln!(out, "load = {}", load_to_toml(template, load));
    }
    if !family.columns.is_empty() {
        let columns: Vec<String> = family.columns.iter().map(|column| format!("\"{}\"", column.name)).collect();
        let _ = writeln!(out, "columns = [{}]", columns.join(", "));
    }
    out
}

/// The settings of a family whose linkage is drawn as it is placed, in a pose of the only circuit.
pub fn drawn_family_settings(family: &Family) -> String {
    let template = &family.template;
    sampling_setting(family) + &continuation_settings(template) + &straight_setting(family) + &dwell_setting(template)
}

/// A value of the input, or a part of it.
fn input_to_toml(family: &Family, value: f64) -> String {
    let number = format_number(value);
    if family.template.is_driven_by_length() { number } else { format!("\"{number} deg\"") }
}

fn sampling_setting(family: &Family) -> String {
    let sampling = match sampling_fields(family.sampling) {
        ("step", step, _) => format!("step = {}", input_to_toml(family, step)),
        (key, number, None) => format!("{key} = {}", format_number(number)),
        (key, number, Some(spacing)) => format!("{key} = {}, spacing = \"{spacing}\"", format_number(number)),
    };
    format!("sampling = {{ {sampling} }}\n")
}

fn continuation_settings(template: &Template) -> String {
    let continuation = match template.continuation {
        Continuation::Smooth => "smooth",
        Continuation::Branch => "branch",
    };
    let coincident = match template.coincident {
        CoincidentDyads::Together => "together",
        CoincidentDyads::First => "first",
        CoincidentDyads::Last => "last",
    };
    let mut out = format!("continuation = \"{continuation}\"\n");
    // Every linkage of the catalogue has `together`.
    if template.coincident != CoincidentDyads::Together || !is_built_in(template) {
        let _ = writeln!(out, "coincident = \"{coincident}\"");
    }
    out
}

fn straight_setting(family: &Family) -> String {
    if family.straight == StraightCriterion::default() {
        return String::new();
    }
    let straight = match family.straight {
        StraightCriterion::Tolerance(tolerance) => format!("tolerance = {}", format_number(tolerance)),
        StraightCriterion::Input(value) => format!("input = {}", input_to_toml(family, value)),
        StraightCriterion::Length(length) => format!("length = {}", format_number(length)),
    };
    format!("straight = {{ {straight} }}\n")
}

fn dwell_setting(template: &Template) -> String {
    if template.dwell == DwellBand::default() {
        return String::new();
    }
    let band = match template.dwell {
        DwellBand::Share(share) => format!("share = {}", format_number(share)),
        DwellBand::Angle(degrees) => format!("angle = \"{} deg\"", format_number(degrees)),
        DwellBand::Length(length) => format!("length = {}", format_number(length)),
    };
    format!("dwell = {{ {band} }}\n")
}

/// The `place` of a family.
fn placement_to_toml(placement: &Orientation) -> String {
    let is_mirrored = placement.handedness() < 0.0;
    format!("{{ mirror = {is_mirrored}, rotate = \"{} deg\" }}", format_number(placement.rotation_deg()))
}

/// A parameter set to be exported.
#[derive(Clone, Debug)]
pub struct ParameterSet<'a> {
    /// Its family.
    pub family: &'a Family,
    /// The values of its template's parameters.
    pub values: Vec<f64>,
    /// The name of the curve it belongs to.
    pub curve_name: String,
}

impl<'a> ParameterSet<'a> {
    /// The parameter set of a curve.
    pub fn from_curve(selected: &SelectedCurve<'a>) -> ParameterSet<'a> {
        let values = selected.family.parameter_values(&selected.solved.cell).to_vec();
        ParameterSet { family: selected.family, values, curve_name: selected.name() }
    }
}
