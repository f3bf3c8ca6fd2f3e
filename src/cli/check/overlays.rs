//! Drawings of the curves that have moved.

use std::path::Path;

use crate::check::{self, Options, Report};
use crate::manifest::Plan;
use crate::output;
use crate::record::RUN_FILE_NAME;
use quick_xml::escape::escape;

use super::super::{Failure, print_stderr, printable};
use coupler_curves::text::pluralize;

/// At most this many curves are drawn, the worst ones: nobody looks at more.
const MAX_CURVES: usize = 500;

const STYLE: &str = "body{font:16px/1.5 'DejaVu Serif Condensed',Georgia,serif;color:#111;background:#fffdf8;\
                     margin:2rem auto;max-width:70rem;padding:0 1rem}figure{margin:2rem 0}img{width:100%}";

/// How the page ends its title.
const TITLE: &str = "what has moved";

/// Checks that a folder has no page of another kind, which would be overwritten.
///
/// # Errors
/// It has an atlas, or a page that no earlier check wrote.
pub fn require_own_folder(folder: &Path) -> Result<(), Failure> {
    let page = folder.join("index.html");
    let is_own =
        || std::fs::read(&page).is_ok_and(|page| String::from_utf8_lossy(&page).contains(&format!("{TITLE}</title>")));
    let what = match () {
        () if folder.join(RUN_FILE_NAME).exists() => "an atlas",
        () if page.exists() && !is_own() => "a page index.html that no check wrote",
        () => return Ok(()),
    };
    Err(Failure::input(format!(
        "{} has {what}, which would be overwritten: name another folder with --diff",
        folder.display()
    )))
}

/// Writes a page for each curve that has moved, and an index of the pages, into a folder that [`require_own_folder`] has passed.
pub fn write(folder: &Path, plan: &Plan, recorded: &Path, options: &Options, report: &Report) -> Result<(), Failure> {
    output::create_folder(folder)?;
    let (mut figures, mut written, mut failed) = (String::new(), 0, None);
    check::draw_overlays(plan, recorded, options, report, MAX_CURVES, |overlay| {
        let (name, location) = (&overlay.name, escape(printable(&overlay.finding.location)));
        figures.push_str(&format!(
            "<figure id=\"{name}\"><figcaption><b>{location}</b>: {}</figcaption>\
             <a href=\"{name}\"><img src=\"{name}\" alt=\"{location}, old and new\" loading=\"lazy\"></a></figure>\n",
            escape(printable(&overlay.finding.change)),
        ));
        match output::write_file(&folder.join(name), &overlay.svg) {
            Ok(()) => written += 1,
            Err(error) => failed = failed.take().or(Some(error)),
        }
    })?;
    if let Some(error) = failed {
        return Err(error.into());
    }
    let title = escape(printable(&plan.title));
    let summary = match written {
        0 => "No curve has moved.".to_owned(),
        n => format!("{}, the worst first.", pluralize(n, "curve")),
    };
    let page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{title}: {TITLE}</title>\n\
         <meta name=\"viewport\" content=\"width=device-width\"><style>{STYLE}</style></head>\n\
         <body><h1>{title}: {TITLE}</h1>\n<p>{summary}</p>\n{figures}</body></html>\n"
    );
    output::write_file(&folder.join("index.html"), page.as_bytes())?;
    print_stderr(&format!("{} drawn in {}\n", pluralize(written, "curve"), printable(folder.display())));
    Ok(())
}
