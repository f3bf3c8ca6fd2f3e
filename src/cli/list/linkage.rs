//! What there is to know of a linkage before one writes a family of it.

use std::fmt::Write;
use std::sync::Arc;

use coupler_curves::catalogue;
use coupler_curves::family::{Family, Sampling};
use coupler_curves::measure::MeasureSet;
use coupler_curves::solve::Solver;
use coupler_curves::template::{OutputLinkTemplate, Parameter, ParameterKind, Template};

/// A paragraph for each linkage of the catalogue.
pub(super) fn catalogue_rows() -> String {
    catalogue::all().iter().map(|template| summary(template)).collect()
}

/// Its parameters, its source, the meaning of the parameters, and its output link.
fn summary(template: &Template) -> String {
    let parameters: Vec<&str> = template.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
    let mut out = String::new();
    let output = output_link(template).map(|output| format!("output: {output}"));
    let lines = [parameters.join(", "), template.source.clone(), template.legend.clone()];
    for (k, line) in lines.iter().chain(&output).filter(|line| !line.is_empty()).enumerate() {
        let name = if k == 0 { template.id.as_str() } else { "" };
        // Writing to a string cannot fail.
        let _ = writeln!(out, "{name:<16} {line}");
    }
    out
}

fn output_link(template: &Template) -> Option<String> {
    let name = |joint: usize| template.joints[joint].name.as_str();
    template.output_link.map(|output| match output {
        OutputLinkTemplate::Link([from, to]) => format!("link {}-{}", name(from), name(to)),
        OutputLinkTemplate::Slider(joint) => format!("slider {}", name(joint)),
    })
}

/// Everything on a linkage: its source, joints, input, output and parameters, and a family to paste.
pub(super) fn describe(template: &Arc<Template>) -> String {
    let mut out = format!("{}\n", template.id);
    for line in [&template.source, &template.legend].into_iter().filter(|line| !line.is_empty()) {
        let _ = writeln!(out, "  {line}");
    }
    let _ = writeln!(out, "  input: {}", template.input_in_words());
    if let Some(output) = output_link(template) {
        let _ = writeln!(out, "  output: {output}");
    }
    out.push_str("\njoints\n");
    let width = template.joints.iter().map(|joint| joint.name.chars().count()).max().unwrap_or(0);
    for (k, joint) in template.joints.iter().enumerate() {
        let traced = if template.traced.contains(&k) { "; traced" } else { "" };
        let _ = writeln!(out, "  {:<width$}  {}{traced}", joint.name, template.construction(k));
    }
    if !template.parameters.is_empty() {
        out.push_str("\nparameters\n");
        let rows: Vec<[String; 4]> = template.parameters.iter().map(parameter_row).collect();
        let widths: [usize; 4] =
            std::array::from_fn(|k| rows.iter().map(|row| row[k].chars().count()).max().unwrap_or(0));
        for [name, kind, default, range] in &rows {
            let row = format!("  {name:<0$}  {kind:<1$}  {default:<2$}  {range}", widths[0], widths[1], widths[2]);
            let _ = writeln!(out, "{}", row.trim_end());
        }
        if template.parameters.iter().any(|parameter| matches!(parameter.kind, ParameterKind::Angle(_))) {
            out.push_str(
                "  an angle may state its unit: \"30 deg\", \"0.5 rad\"; a number without one is in the unit above\n",
            );
        }
    }
    let _ = write!(out, "\na family to start from\n{}", family(template));
    out
}

/// Its name, kind, default and range.
fn parameter_row(parameter: &Parameter) -> [String; 4] {
    let default = match &parameter.default_text[..] {
        "" => "no default".to_owned(),
        text => format!("default {text}"),
    };
    let bound = |bound: f64, word: &str, from: &str| match bound {
        0.0 => format!("{word} 0"),
        bound => format!("{from} {bound}"),
    };
    let least = parameter.min.map(|min| bound(min, "more than", "from"));
    let most = parameter.max.map(|max| bound(max, "less than", "up to"));
    let range = least.into_iter().chain(most).collect::<Vec<_>>().join(", ");
    [parameter.name.clone(), parameter.kind.name().to_owned(), default, range]
}

/// Its [`Template::starting_family`], with a comment if it cannot be assembled.
fn family(template: &Arc<Template>) -> String {
    let comment = match assembly_error(template) {
        Some(error) => format!("# Change the numbers, with which it cannot be assembled: {error}\n"),
        None => String::new(),
    };
    comment + &template.starting_family()
}

/// Why the linkage cannot be assembled with its defaults and examples, and 1 for other parameters.
fn assembly_error(template: &Arc<Template>) -> Option<String> {
    let without_default = template.parameters.iter().filter(|parameter| parameter.default.is_none());
    let values: Vec<(String, f64)> =
        without_default.map(|parameter| (parameter.name.clone(), parameter.starting_value())).collect();
    let family = match Family::single_cell(Arc::clone(template), &values, Sampling::Samples(2)) {
        Ok(family) => family,
        Err(errors) => return Some(errors.to_string().replace('\n', "; ")),
    };
    let solved = Solver::new(&family).measuring(MeasureSet::EMPTY).solve(0)?;
    solved.motion.assembly_error.as_ref().map(ToString::to_string)
}
