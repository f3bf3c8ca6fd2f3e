//! The progress of a run, and a line for each family at its end.

use crate::output::Event;
use crate::record::{FamilyRecord, FileRecord};
use coupler_drawing::render::PageFormat;
use indicatif::ProgressBar;

use super::super::{print_stderr, printable, progress_bar};
use coupler_curves::text::pluralize;

/// The number of cells of a family that are reported one by one as not assembled.
const MAX_WARNINGS: usize = 10;

/// Reports the progress of a run: a bar on a terminal, and a line for each family at the end.
pub(super) struct ProgressReporter {
    is_quiet: bool,
    /// Whether families and books in which nothing has changed have a line, too.
    reports_unchanged: bool,
    bar: ProgressBar,
    /// The cells of the current family that are not assembled.
    warnings: usize,
    /// The first of them, which is printed with the second, or at the end of the family.
    first_warning: Option<String>,
    /// The cells of all families that are not assembled.
    pub not_assembled: usize,
    /// Whether anything of a family or of the book was drawn.
    pub has_drawn: bool,
}

impl ProgressReporter {
    pub fn new(is_quiet: bool, reports_unchanged: bool) -> ProgressReporter {
        ProgressReporter {
            is_quiet,
            reports_unchanged,
            bar: ProgressBar::hidden(),
            warnings: 0,
            first_warning: None,
            not_assembled: 0,
            has_drawn: false,
        }
    }

    /// Removes the bar at the end of a run that reports no family's end.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }

    pub fn handle_event(&mut self, event: Event, lines: &mut String) {
        match event {
            Event::Begin { family, pages } if !self.is_quiet => {
                self.bar = progress_bar::of_things(family, pages, "pages");
            }
            Event::Begin { .. } => {}
            Event::Page => self.bar.inc(1),
            Event::Shortfall { family, cell, reason } => {
                self.not_assembled += 1;
                self.warnings += 1;
                let warning = format!("warning: {family}, cell {cell}: {}\n", printable(reason));
                match self.warnings {
                    1 => self.first_warning = Some(warning),
                    count if count <= MAX_WARNINGS => {
                        let warnings = self.first_warning.take().unwrap_or_default() + &warning;
                        self.bar.suspend(|| print_stderr(&warnings));
                    }
                    _ => {}
                }
            }
            Event::End { record, drawn } => {
                self.bar.finish_and_clear();
                // The warning of a family without curves says why its only cell has none.
                if let Some(warning) = self.first_warning.take().filter(|_| record.cells > 1 || record.curves > 0) {
                    print_stderr(&warning);
                }
                if self.warnings > MAX_WARNINGS {
                    print_stderr(&format!(
                        "warning: {}: {} more cells are not assembled; see cells.csv\n",
                        record.id,
                        self.warnings - MAX_WARNINGS
                    ));
                }
                self.warnings = 0;
                self.has_drawn |= drawn.is_some();
                if drawn.is_some() || self.reports_unchanged {
                    lines.push_str(&summary(record, drawn));
                }
            }
            Event::Book { record, is_drawn } => {
                self.bar.finish_and_clear();
                self.has_drawn |= is_drawn;
                if !is_drawn && !self.reports_unchanged {
                    return;
                }
                let names: Vec<&str> = record.files.iter().map(|file| file.name.as_str()).collect();
                let files = match &names[..] {
                    [first, .., last] => format!("{first} to {last}"),
                    _ => names.concat(),
                };
                let unchanged = if is_drawn { "" } else { " (unchanged)" };
                lines.push_str(&format!("{files}: {}{unchanged}\n", pluralize(record.pages, "page")));
            }
            Event::EmptyBookPart { kind, title } => {
                let reason = match kind {
                    "chapter" => "no cell meets its condition that is not in a chapter before it",
                    _ => "no curve meets its condition and has a value of its sort key",
                };
                let message = format!("warning: the {kind} `{}` of the book is left out: {reason}\n", printable(title));
                self.bar.suspend(|| print_stderr(&message));
            }
            Event::Removed { family } => {
                lines.push_str(&format!("removed: {}, which is not in the manifest\n", printable(family)));
            }
            Event::Rebuilt { record, files, others } => {
                /// The files that are named.
                const MOST: usize = 5;
                let (record, files) = (printable(record.display()), pluralize(files, "file"));
                let mut message = format!("note: {record} is rebuilt from {files} of the atlas\n");
                if !others.is_empty() {
                    let mut names: Vec<String> =
                        others.iter().take(MOST).map(|path| printable(path.display())).collect();
                    if others.len() > MOST {
                        names.push(format!("{} more", others.len() - MOST));
                    }
                    let names = names.join(", ");
                    message.push_str(&format!("note: not known to be of the atlas, and left as they are: {names}\n"));
                }
                self.bar.suspend(|| print_stderr(&message));
            }
            Event::UnusableRecord { record, error } => {
                let (record, error) = (printable(record.display()), printable(error));
                print_stderr(&format!(
                    "warning: {record} is replaced: {error}; every page is drawn, and no file is removed\n"
                ));
            }
        }
    }
}

/// "evans: 3 cells (1 not assembled), 2 curves, 1 page"; `drawn` is `None` if the family is unchanged.
fn summary(record: &FamilyRecord, drawn: Option<usize>) -> String {
    let mut line = format!("{}: {}", record.id, pluralize(record.cells, "cell"));
    let counts = [
        (record.not_assembled - record.partly_assembled + record.unassembled_left_out, "not assembled"),
        (record.partly_assembled, "assembled over a part of the range"),
        (record.cells - record.kept - record.unassembled_left_out, "left out by `where`"),
    ];
    let counts = counts.into_iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}"));
    let counts: Vec<String> = counts.collect();
    if !counts.is_empty() {
        line.push_str(&format!(" ({})", counts.join(", ")));
    }
    line.push_str(&format!(", {}", pluralize(record.curves, "curve")));
    if record.curves_left_out > 0 {
        line.push_str(&format!(" ({} more left out by `where`)", record.curves_left_out));
    }
    line.push_str(&format!(", {}", pluralize(record.pages, "page")));
    let extension = |file: &FileRecord| file.name.rsplit_once('.').map(|(_, extension)| extension.to_owned());
    let is_page = |file: &FileRecord| {
        let extension = extension(file);
        PageFormat::ALL.iter().any(|format| extension.as_deref() == Some(format.name()))
    };
    // Pages that are only in the book have no files.
    let has_page_files = record.files.iter().any(is_page);
    match drawn {
        None => line.push_str(" (unchanged)"),
        Some(drawn) if drawn < record.pages && has_page_files => {
            line.push_str(&format!(" ({drawn} of {} drawn)", pluralize(record.pages, "page")));
        }
        Some(_) => {}
    }
    line.push('\n');
    line
}
