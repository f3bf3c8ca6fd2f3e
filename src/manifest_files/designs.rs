//! Searches for the linkages that a family wishes.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use coupler_curves::template::Template;
use coupler_find::{DesignOptions, Effort};

use super::case_rows::CaseRows;
use super::known_table::KnownTable;
use crate::design::{UNBOUNDED_SIZE, WishProblem, by_wishes, check_wishes};
use crate::manifest::{CaseTable, DesignEffort, DesignRequest, FileProblem, WishPlace};

/// What says of a search, by what its answers are called, which part of it is done, from 0 to 1.
pub(super) type Progress = dyn Fn(&str, f64);

/// The linkages that meet the wishes of a family, as its cases, or those that have been found before. What is wrong is reported.
pub(super) fn search(
    template: &Template,
    request: &DesignRequest,
    (known, report_part): (Option<&KnownTable>, &Progress),
    report: &mut dyn FnMut(WishPlace, FileProblem),
) -> Option<CaseTable> {
    let DesignRequest { name, .. } = request;
    let template = Arc::new(template.clone());
    let (space, wishes) = match check_wishes(&template, &request.wishes, request.max_link) {
        Ok(checked) => checked,
        Err(problems) => {
            problems.into_iter().for_each(|WishProblem { place, message }| report(place, with_help(message)));
            return None;
        }
    };
    if !request.is_searched {
        return None;
    }
    let mut ignore = |_: FileProblem| {};
    let mut rows = CaseRows::new(name, usize::MAX, &mut ignore);
    if let Some(known) = known {
        return known.read(&mut rows).ok().and_then(|()| rows.into_table());
    }
    report_part(name, 0.0);
    // Until nothing is written, Ctrl-C may end the program anywhere.
    let never = AtomicBool::new(false);
    let designs = by_wishes(space, wishes.clone(), options(request), &never, |part| report_part(name, part));
    report_part(name, 1.0);
    if designs.answers.is_empty() {
        let message = format!("no {} was found that meets these wishes", template.id);
        report(WishPlace::All, FileProblem::error(message, designs.remedies(&wishes).join("; ")));
        return None;
    }
    if designs.is_size_unbounded {
        let help = "give a length a value or a range (`fix`, `range`), or `max_link`".to_owned();
        report(WishPlace::All, FileProblem { message: UNBOUNDED_SIZE.to_owned(), help, is_warning: true });
    }
    rows.set_names(template.parameters.iter().map(|parameter| parameter.name.clone()).collect());
    designs.answers.iter().try_for_each(|answer| rows.push(&answer.values, 0)).ok()?;
    rows.into_table()
}

/// How the search goes: as the command's, where the manifest does not say.
fn options(request: &DesignRequest) -> DesignOptions {
    let default = DesignOptions::default();
    let effort = request.effort.map(|effort| match effort {
        DesignEffort::Quick => Effort::Quick,
        DesignEffort::Normal => Effort::Normal,
        DesignEffort::Thorough => Effort::Thorough,
    });
    DesignOptions {
        most: request.best.unwrap_or(default.most),
        effort: effort.unwrap_or(default.effort),
        seed: request.seed.unwrap_or(default.seed),
    }
}

/// A message of which what is after the last semicolon is the remedy.
fn with_help(message: String) -> FileProblem {
    match message.rsplit_once("; ") {
        Some((message, help)) => FileProblem::error(message.to_owned(), help.to_owned()),
        None => FileProblem::error(message, "correct it, or leave it out".to_owned()),
    }
}
