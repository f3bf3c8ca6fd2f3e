//! What is asked of `design LINKAGE`, checked.

use coupler_curves::expression::Expression;
use coupler_find::{DesignOptions, RangeRequest};

use super::super::super::Failure;
use super::super::super::linkage::{find_template, own_text};
use super::arguments::WishArguments;
use crate::design::DesignRequest;
use crate::find::Notation;

/// What the arguments ask for, and the text of the linkage, if it is of a manifest.
///
/// # Errors
/// Everything in them that cannot be read.
pub(super) fn read(arguments: &WishArguments) -> Result<(DesignRequest, Option<String>), Failure> {
    let name = arguments.linkage.as_deref().unwrap_or_default();
    let template = find_template(name, arguments.manifest.as_deref())?;
    let own_linkage = own_text(arguments.manifest.as_deref(), &template)?;
    let mut problems = Vec::new();
    let max_link = match arguments.max_link.trim() {
        "inf" => Ok(f64::INFINITY),
        text => Expression::evaluate_constant(text),
    };
    let max_link = max_link.unwrap_or_else(|error| {
        problems.push(format!("--max-link: `{}`: {}", arguments.max_link, error.message_with_help()));
        f64::INFINITY
    });
    let named = |text: &str| {
        let (name, value) = text.split_once('=')?;
        Some((name.trim().to_owned(), value.trim().to_owned()))
    };
    let fix = |text: &String| named(text).map_or((text.trim().to_owned(), None), |(name, value)| (name, Some(value)));
    let mut ranges = Vec::new();
    for text in &arguments.range {
        match named(text) {
            Some((name, text)) => ranges.push(RangeRequest { name, text }),
            None => problems.push(format!("--range: `{text}` has no `=`; write it like \"r = 20..60 by 1\"")),
        }
    }
    let request = DesignRequest {
        notation: Notation::CommandLine,
        template,
        condition: arguments.condition.clone(),
        maximize: arguments.maximize.clone(),
        minimize: arguments.minimize.clone(),
        ranges,
        fixed: arguments.fix.iter().map(fix).collect(),
        max_link,
        options: DesignOptions { most: arguments.best.into(), effort: arguments.effort.into(), seed: arguments.seed },
    };
    if problems.is_empty() {
        return Ok((request, own_linkage));
    }
    problems.extend(request.check().err().into_iter().flatten());
    Err(Failure::inputs(&problems))
}
