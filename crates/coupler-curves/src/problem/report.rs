use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

use super::{Problem, Severity};

/// Renders problems for a terminal: each with file, line and column, the offending text underlined and `help:`.
///
/// Errors come before warnings. `path` is the name of the text. Spans beyond the text are moved to its end. With
/// `styled` the report has terminal colours; it has no other control characters, even if the text does.
pub fn report(problems: &[Problem], path: &str, text: &str, styled: bool) -> String {
    let renderer = if styled { Renderer::styled() } else { Renderer::plain() }.decor_style(DecorStyle::Ascii);
    let mut ordered: Vec<&Problem> = problems.iter().collect();
    ordered.sort_by_key(|p| (p.severity != Severity::Error, p.span.start));
    let line_starts: Vec<usize> = std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect();
    let mut out = String::new();
    for problem in ordered {
        let Problem { message, label, help, .. } = problem;
        let [message, label, help] = [message, label, help].map(|text| replace_control_chars(text));
        let sanitized = Problem { message, label, help, ..problem.clone() };
        out.push_str(&renderer.render(&[group(&sanitized, path, Excerpt::around(problem, text, &line_starts))]));
        out.push_str("\n\n");
    }
    // In the text itself the renderer replaces ASCII control characters, but not the C1 ones, which terminals obey too.
    out.replace(|c: char| ('\u{80}'..='\u{9f}').contains(&c), "\u{fffd}")
}

/// Replaces control characters in a message that may quote the text.
fn replace_control_chars(message: &str) -> String {
    message.replace(|c: char| c.is_control() && c != '\n', "\u{fffd}")
}

fn group<'a>(problem: &'a Problem, path: &'a str, excerpt: Excerpt<'a>) -> annotate_snippets::Group<'a> {
    let level = match problem.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let annotation = AnnotationKind::Primary.span(excerpt.underlined);
    let annotation = match problem.label.as_str() {
        "" => annotation,
        label => annotation.label(label),
    };
    let snippet = Snippet::source(excerpt.lines).line_start(excerpt.first_line).path(path).annotation(annotation);
    let group = level.primary_title(problem.message.as_str()).element(snippet);
    match problem.help.as_str() {
        "" => group,
        help => group.element(Level::HELP.message(help)),
    }
}

/// The lines of a text around a problem. The renderer reads all lines that it is given, and so gets only these.
struct Excerpt<'a> {
    lines: &'a str,
    /// The number of the first line, from 1.
    first_line: usize,
    /// The underlined part of `lines`.
    underlined: std::ops::Range<usize>,
}

impl<'a> Excerpt<'a> {
    /// The lines of `text` around a problem; `line_starts` are the indices at which lines start.
    fn around(problem: &Problem, text: &'a str, line_starts: &[usize]) -> Excerpt<'a> {
        let span = underlined_span(problem, text);
        let line = line_starts.partition_point(|&start| start <= span.start);
        // Two more lines on either side, for a problem at the end of the text or of a line.
        let first = line.saturating_sub(3);
        let end = line_starts.get(line + 2).copied().unwrap_or(text.len());
        let start = line_starts[first];
        let underlined = span.start - start..span.end - start;
        Excerpt { lines: &text[start..end], first_line: first + 1, underlined }
    }
}

/// The span clamped to the text and to character boundaries; only the first line of a longer one is underlined.
fn underlined_span(problem: &Problem, text: &str) -> std::ops::Range<usize> {
    let start = floor_char_boundary(text, problem.span.start);
    let end = floor_char_boundary(text, problem.span.end).max(start);
    let end = text[start..end].find(['\r', '\n']).map_or(end, |n| start + n);
    start..end
}

fn floor_char_boundary(text: &str, mut at: usize) -> usize {
    at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_has_message_place_and_help() {
        let text = "title = \"x\"\nstep = 0\n";
        let problem = Problem::error(19..20, "a step of 0 never ends").with_help("give a step of more than 0");
        let report = report(&[problem], "atlas.toml", text, false);
        assert!(report.contains("error: a step of 0 never ends"), "{report}");
        assert!(report.contains("atlas.toml:2:8"), "{report}");
        assert!(report.contains("help: give a step of more than 0"), "{report}");
    }

    #[test]
    fn invalid_spans_are_rendered() {
        for (start, end) in [(0, 0), (3, 1), (900, 1000), (1, 2)] {
            report(&[Problem::error(start..end, "odd")], "x", "é\nü", false);
        }
        report(&[Problem::error(0..0, "empty")], "x", "", false);
    }
}
