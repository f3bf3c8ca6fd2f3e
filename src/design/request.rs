//! What is asked of a search by wishes, checked.

use std::sync::Arc;

use coupler_curves::template::Template;
use coupler_find::{DesignSpace, DesignSpaceError, Direction, LinkageSpaceError, RangeRequest, WishError, Wishes};

use crate::manifest::{WishPlace, WishTexts};

/// What is wrong with the wishes of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct WishProblem {
    /// Where it is wrong.
    pub place: WishPlace,
    /// What is wrong, and after a semicolon, as a rule, what to do about it.
    pub message: String,
}

/// Checks wishes for a linkage of which no link is longer than `max_link`.
///
/// # Errors
/// Everything that is wrong with them.
pub fn check_wishes(
    template: &Arc<Template>,
    texts: &WishTexts,
    max_link: f64,
) -> Result<(DesignSpace, Wishes), Vec<WishProblem>> {
    let mut problems = Vec::new();
    let space = space(template, texts, &mut problems);
    let wishes = wishes(template, texts, max_link, &mut problems);
    space.zip(wishes).filter(|_| problems.is_empty()).ok_or(problems)
}

/// The two sides of `name = value`.
fn named(text: &str) -> Option<(String, String)> {
    let (name, value) = text.split_once('=')?;
    Some((name.trim().to_owned(), value.trim().to_owned()))
}

fn space(template: &Arc<Template>, texts: &WishTexts, problems: &mut Vec<WishProblem>) -> Option<DesignSpace> {
    let fix = |text: &String| named(text).map_or((text.trim().to_owned(), None), |(name, value)| (name, Some(value)));
    let fixed: Vec<_> = texts.fix.iter().map(fix).collect();
    let (mut ranges, mut places) = (Vec::new(), Vec::new());
    for (k, text) in texts.range.iter().enumerate() {
        let place = WishPlace::Range(k);
        match named(text) {
            Some((name, text)) => {
                ranges.push(RangeRequest { name, text });
                places.push(place);
            }
            None => {
                let message = format!("`{text}` is no range of a parameter; write it like \"r = 20..60 by 1\"");
                problems.push(WishProblem { place, message });
            }
        }
    }
    let place = |error: &DesignSpaceError| match error {
        DesignSpaceError::Range { name, text, .. } => {
            let is_own = |range: &RangeRequest| range.name == *name && range.text == *text;
            // Of two that are the same the second is one too many.
            ranges.iter().rposition(is_own).map(|k| places[k])
        }
        DesignSpaceError::Parameter(
            LinkageSpaceError::Unknown { name, .. }
            | LinkageSpaceError::Repeated { name }
            | LinkageSpaceError::NoValue { name }
            | LinkageSpaceError::Value { name, .. },
        ) => fixed.iter().rposition(|(own, _)| own == name).map(WishPlace::Fix),
        _ => None,
    };
    let problem = |error: DesignSpaceError| WishProblem {
        place: place(&error).unwrap_or(WishPlace::All),
        message: error.to_string(),
    };
    let space = DesignSpace::new(template.clone(), &fixed, &ranges);
    space.map_err(|errors| problems.extend(errors.into_iter().map(problem))).ok()
}

fn wishes(template: &Template, texts: &WishTexts, max_link: f64, problems: &mut Vec<WishProblem>) -> Option<Wishes> {
    let greatest = (0..).zip(&texts.maximize).map(|(k, text)| (WishPlace::Maximize(k), (Direction::Greatest, text)));
    let least = (0..).zip(&texts.minimize).map(|(k, text)| (WishPlace::Minimize(k), (Direction::Least, text)));
    let (places, goals): (Vec<WishPlace>, Vec<(Direction, String)>) =
        greatest.chain(least).map(|(place, (direction, text))| (place, (direction, text.clone()))).unzip();
    let condition = texts.condition.as_deref();
    let before = problems.len();
    let mut check = |place: WishPlace, compiled: Result<Wishes, Vec<WishError>>| {
        let problem = |error: WishError| WishProblem { place, message: error.to_string() };
        compiled.map_err(|errors| problems.extend(errors.into_iter().map(problem))).ok()
    };
    // One by one, so that each problem has its place.
    if condition.is_some() {
        check(WishPlace::Condition, Wishes::new(template, condition, &[], max_link));
    }
    for (place, goal) in places.into_iter().zip(&goals) {
        check(place, Wishes::new(template, None, std::slice::from_ref(goal), max_link));
    }
    if problems.len() > before {
        return None;
    }
    let together = Wishes::new(template, condition, &goals, max_link);
    let problem = |error: WishError| WishProblem { place: WishPlace::All, message: error.to_string() };
    together.map_err(|errors| problems.extend(errors.into_iter().map(problem))).ok()
}
