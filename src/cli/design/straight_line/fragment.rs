//! A manifest that renders the designs.

use std::fmt::Write;

use crate::design::Design;

use super::report::Report;

/// A complete manifest: one family for each linkage and tolerance, with its cases in order of rank.
pub(super) fn manifest(report: &Report) -> String {
    let mut out =
        "# Straight-line linkages found by `coupler-atlas design straight-line`; `coupler-atlas render` draws them.\n\n\
                   [atlas]\ntitle = \"Straight-line linkages\"\nformats = [\"svg\"]\n\n[page]\npaper = \"a4\"\n"
            .to_owned();
    let mut families: Vec<(String, Vec<&Design>)> = Vec::new();
    for design in &report.results.designs {
        let is_same = |other: &Design| other.family.id == design.family.id && other.tolerance == design.tolerance;
        match families.iter_mut().find(|(_, designs)| is_same(designs[0])) {
            Some((_, designs)) => designs.push(design),
            None => {
                let id = &design.family.id;
                let number = families.iter().filter(|(_, designs)| designs[0].family.id == *id).count() + 1;
                let id = if number == 1 { id.clone() } else { format!("{id}-{number}") };
                families.push((id, vec![design]));
            }
        }
    }
    for (id, designs) in &families {
        append_family(id, designs, &mut out);
    }
    out
}

fn append_family(id: &str, designs: &[&Design], out: &mut String) {
    let first = designs[0];
    let template = &first.family.template;
    let columns = designs.len().min(3);
    let rows = designs.len().div_ceil(columns);
    // Writing to a string cannot fail.
    let _ = write!(
        out,
        "\n[[family]]\nid = \"{id}\"\nlinkage = \"{}\"\npanels = [{columns}, {rows}]\nsampling = {{ samples = 360 }}\n\
         straight = {{ tolerance = {} }}\ncases = [\n",
        template.id, first.tolerance
    );
    for design in designs {
        let names = template.parameters.iter().map(|parameter| &parameter.name);
        let values: Vec<String> = names.map(|name| format!("{name} = {}", design.parameter(name))).collect();
        let _ = writeln!(out, "    {{ {} }},", values.join(", "));
    }
    out.push_str("]\n");
}
