use coupler_atlas::check::Report;

use super::super::plan::Source;

/// GitHub shows no more annotations of one step than this.
const SHOWN: usize = 10;

/// Annotations of a workflow, each at the family's table in the manifest.
pub fn text(report: &Report, source: &Source) -> String {
    let file = source.path.display().to_string().replace('\\', "/");
    let line_of = |id: &str| {
        let planned = source.plan.families.iter().find(|planned| planned.family.id == id);
        planned.map_or(1, |planned| source.text[..planned.span.start].matches('\n').count() + 1)
    };
    let mut text = String::new();
    for finding in report.findings.iter().take(SHOWN) {
        let level = if finding.change.is_difference() { "error" } else { "notice" };
        let (line, title) = (line_of(&finding.place.family), format!("{}: {}", finding.change.kind(), finding.place));
        let (file, title) = (property(&file), property(&title));
        text.push_str(&format!(
            "::{level} file={file},line={line},title={title}::{}\n",
            data(&finding.change.to_string())
        ));
    }
    let left = report.total().saturating_sub(SHOWN);
    if left > 0 {
        text.push_str(&format!("::error file={},line=1,title=and {left} more::see the report\n", property(&file)));
    }
    text
}

/// What stands in an annotation, so that it stays in it.
fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}
