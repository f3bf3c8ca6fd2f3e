//! What is asked of `design LINKAGE`, checked.

use coupler_curves::expression::Expression;
use coupler_find::{DesignOptions, DesignSpace, Direction, RangeRequest, Wishes};

use super::super::super::Failure;
use super::super::super::linkage::{find_template, own_text};
use super::arguments::WishArguments;

/// A search that can be begun.
pub(super) struct Request {
    pub space: DesignSpace,
    pub wishes: Wishes,
    pub options: DesignOptions,
    /// The text of the linkage, if it is of a manifest.
    pub own_linkage: Option<String>,
}

/// Checks the arguments.
///
/// # Errors
/// Everything that is wrong with them.
pub(super) fn check(arguments: &WishArguments) -> Result<Request, Failure> {
    let name = arguments.linkage.as_deref().unwrap_or_default();
    let template = find_template(name, arguments.manifest.as_deref())?;
    let own_linkage = own_text(arguments.manifest.as_deref(), &template)?;
    let mut problems = Vec::new();
    let max_link = match arguments.max_link.trim() {
        "inf" => Ok(f64::INFINITY),
        text => Expression::evaluate_constant(text),
    };
    let max_link = match max_link {
        Ok(value) if value > 0.0 => value,
        Ok(value) => {
            problems.push(format!("--max-link: {value} is not positive; give a length, as in 250, or inf"));
            f64::INFINITY
        }
        Err(error) => {
            problems.push(format!("--max-link: `{}`: {}", arguments.max_link, error.message_with_help()));
            f64::INFINITY
        }
    };
    let named = |text: &str| {
        let (name, value) = text.split_once('=')?;
        Some((name.trim().to_owned(), value.trim().to_owned()))
    };
    let fix = |text: &String| named(text).map_or((text.trim().to_owned(), None), |(name, value)| (name, Some(value)));
    let fixed: Vec<_> = arguments.fix.iter().map(fix).collect();
    let mut ranges = Vec::new();
    for text in &arguments.range {
        match named(text) {
            Some((name, text)) => ranges.push(RangeRequest { name, text }),
            None => problems.push(format!("--range: `{text}` has no `=`; write it like \"r = 20..60 by 1\"")),
        }
    }
    let all_goals = [(Direction::Greatest, &arguments.maximize), (Direction::Least, &arguments.minimize)];
    let goals: Vec<(Direction, String)> = all_goals
        .into_iter()
        .flat_map(|(direction, texts)| texts.iter().map(move |text| (direction, text.clone())))
        .collect();
    let wishes = Wishes::new(&template, arguments.condition.as_deref(), &goals, max_link);
    let space = DesignSpace::new(template, &fixed, &ranges);
    match (space, wishes) {
        (Ok(space), Ok(wishes)) if problems.is_empty() => {
            let options =
                DesignOptions { most: arguments.best.into(), effort: arguments.effort.into(), seed: arguments.seed };
            Ok(Request { space, wishes, options, own_linkage })
        }
        (space, wishes) => {
            problems.extend(space.err().into_iter().flatten().map(|error| error.to_string()));
            problems.extend(wishes.err().into_iter().flatten().map(|error| error.to_string()));
            Err(Failure::inputs(&problems))
        }
    }
}
