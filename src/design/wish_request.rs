//! What is asked of a search by wishes, as users give it, and all that is wrong with it.

use std::sync::Arc;

use coupler_curves::template::Template;
use coupler_find::{DesignOptions, DesignSpace, Wishes};

use super::request::check_wishes;
use crate::manifest::{MAX_DESIGNS, WishTexts};
use crate::notation::Notation;

/// What is asked of a search by wishes.
#[derive(Clone, Debug)]
pub struct WishRequest {
    /// How the options are written.
    pub notation: Notation,
    /// The linkage.
    pub template: Arc<Template>,
    /// The conditions, joined by `and`.
    pub condition: Option<String>,
    /// Expressions that are to be as great as possible.
    pub maximize: Vec<String>,
    /// Expressions that are to be as small as possible.
    pub minimize: Vec<String>,
    /// The ranges of parameters, and the steps of their values: "r = 20..60 by 1".
    pub range: Vec<String>,
    /// The parameters that keep their default, "s", or a value, "p = 100".
    pub fix: Vec<String>,
    /// The greatest distance of two joints of a link, in the unit of the lengths; may be infinite.
    pub max_link: f64,
    /// How the search goes.
    pub options: DesignOptions,
}

impl WishRequest {
    /// The greatest number of designs.
    pub const MAX_BEST: usize = MAX_DESIGNS;

    /// What varies, and what is wished.
    ///
    /// # Errors
    /// All problems of the request.
    pub fn check(&self) -> Result<(DesignSpace, Wishes), Vec<String>> {
        let mut problems = Vec::new();
        if self.max_link.is_nan() || self.max_link <= 0.0 {
            let option = self.notation.name("max_link");
            problems.push(format!("{option}: {} is not positive; give a length, as in 250, or inf", self.max_link));
        }
        let most = self.options.most;
        if !(1..=WishRequest::MAX_BEST).contains(&most) {
            let option = self.notation.with_value("best", most);
            problems.push(format!("{option}: give a number from 1 to {}", WishRequest::MAX_BEST));
        }
        let texts = WishTexts {
            condition: self.condition.clone(),
            maximize: self.maximize.clone(),
            minimize: self.minimize.clone(),
            range: self.range.clone(),
            fix: self.fix.clone(),
        };
        match check_wishes(&self.template, &texts, self.max_link) {
            Ok(checked) if problems.is_empty() => Ok(checked),
            checked => {
                problems.extend(checked.err().into_iter().flatten().map(|problem| problem.message));
                Err(problems)
            }
        }
    }

    /// What is wished, in one line.
    pub fn in_words(&self) -> String {
        let goals = |verb: &'static str, texts: &[String]| {
            texts.iter().map(move |text| format!("{verb} {text}")).collect::<Vec<_>>()
        };
        let mut parts = Vec::new();
        parts.extend(self.condition.clone());
        parts.extend(goals("greatest", &self.maximize));
        parts.extend(goals("least", &self.minimize));
        parts.join(" · ")
    }
}
