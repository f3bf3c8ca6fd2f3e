//! What is asked of `design LINKAGE`, checked.

use coupler_curves::expression::Expression;
use coupler_find::DesignOptions;

use super::super::super::Failure;
use super::super::super::linkage::{find_template, own_text};
use super::arguments::WishArguments;
use crate::design::WishRequest;
use crate::find::Notation;

/// What the arguments ask for, and the text of the linkage, if it is of a manifest.
///
/// # Errors
/// Everything in them that cannot be read.
pub(super) fn read(arguments: &WishArguments) -> Result<(WishRequest, Option<String>), Failure> {
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
    let request = WishRequest {
        notation: Notation::CommandLine,
        template,
        condition: arguments.condition.clone(),
        maximize: arguments.maximize.clone(),
        minimize: arguments.minimize.clone(),
        range: arguments.range.clone(),
        fix: arguments.fix.clone(),
        max_link,
        options: DesignOptions { most: arguments.best.into(), effort: arguments.effort.into(), seed: arguments.seed },
    };
    if problems.is_empty() {
        return Ok((request, own_linkage));
    }
    problems.extend(request.check().err().into_iter().flatten());
    Err(Failure::inputs(&problems))
}
