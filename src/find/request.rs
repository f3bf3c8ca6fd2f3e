//! What is asked of a search, as users give it, and all that is wrong with it.

use std::fmt::Display;
use std::sync::Arc;

use coupler_curves::geometry::{Bounds, Point};
use coupler_curves::template::Template;
use coupler_find::{Condition, LinkageSearch, LinkageSpace, Mechanism, Options};

use super::index_file::MAX_CURVES;
use super::several::Several;
use crate::notation::Notation;

/// A linkage whose dimensions are searched.
#[derive(Clone, Debug)]
pub struct SearchedLinkage {
    /// The linkage.
    pub template: Arc<Template>,
    /// The parameters that are kept, each with its value if it has another than its default.
    pub kept: Vec<(String, Option<String>)>,
}

/// What is searched.
#[derive(Clone, Debug)]
pub enum Searched {
    /// Four-bars.
    FourBars,
    /// The dimensions of a linkage.
    Linkage(SearchedLinkage),
    /// Several linkages.
    Several(Several),
    /// The curves of an atlas.
    Atlas,
    /// Linkages that guide a body through poses.
    Poses,
}

/// What is asked of a search.
#[derive(Clone, Debug)]
pub struct Request<'a> {
    /// How the options are written.
    pub notation: Notation,
    /// What is searched.
    pub searched: Searched,
    /// Whether the points of the path have angles of the crank.
    pub is_timed: bool,
    /// Whether curves of an atlas are compared where they are.
    pub is_fixed: bool,
    /// The number of four-bars, or of the parameter sets of a linkage, in which the path is looked up, if it is not the default.
    pub index: Option<usize>,
    /// The box of the fixed pivots: least x, least y, greatest x, greatest y.
    pub pivots: Option<[f64; 4]>,
    /// A condition; on the linkages of an atlas, whose names are known to the search only, and for poses, it is not checked.
    pub condition: Option<&'a str>,
    /// The other options; their box and condition are not used.
    pub options: Options,
}

impl SearchedLinkage {
    fn is_free_four_bar(&self) -> bool {
        self.template.id == "four-bar" && self.kept.is_empty()
    }
}

/// Something that is wrong with a request.
#[derive(Clone, Debug)]
pub struct RequestProblem {
    /// The option that it is about, with words between underscores.
    pub option: &'static str,
    /// What is wrong, and what to do, with the options as users write them.
    pub message: String,
}

impl Request<'_> {
    /// The greatest number of answers.
    pub const MAX_TOP: usize = 100;

    /// The options of the search, and the space of a linkage's dimensions: none for the search of four-bars, which a `four-bar` with all its
    /// parameters free has as well.
    ///
    /// # Errors
    /// All problems of the request.
    pub fn check(&self) -> Result<(Options, Option<LinkageSpace>), Vec<RequestProblem>> {
        let mut problems = self.contradictions();
        let mut space = None;
        if let Some(SearchedLinkage { template, kept }) = self.searched_linkage() {
            match LinkageSpace::new(template.clone(), kept) {
                Ok(found) => space = Some(found),
                Err(errors) => {
                    let option = if kept.is_empty() { "linkage" } else { "keep" };
                    let messages = errors.iter().map(|error| format!("{}: {error}", self.notation.name(option)));
                    problems.extend(messages.map(|message| RequestProblem { option, message }));
                }
            }
        }
        let mut options = Options { pivots: None, condition: None, ..self.options.clone() };
        let wrong = |option, value: &dyn Display, what: String| {
            let message = format!("{}: {what}", self.notation.with_value(option, value));
            RequestProblem { option, message }
        };
        if options.max_link.is_nan() || options.max_link <= 0.0 {
            let what = "give a positive number of sizes of the path, as in 10, or inf".to_owned();
            problems.push(wrong("max_link", &options.max_link, what));
        }
        if !(1..=Request::MAX_TOP).contains(&options.most) {
            problems.push(wrong("top", &options.most, format!("give a number from 1 to {}", Request::MAX_TOP)));
        }
        if let Some([x_min, y_min, x_max, y_max]) = self.pivots {
            options.pivots = Some(Bounds::from_points([Point::new(x_min, y_min), Point::new(x_max, y_max)]));
            let numbers = [x_min, y_min, x_max, y_max].map(|value| value.to_string()).join(", ");
            if !(x_min < x_max && y_min < y_max && [x_min, y_min, x_max, y_max].iter().all(|v| v.is_finite())) {
                let example = match self.notation {
                    Notation::CommandLine => "as in --pivots=-50,-20,50,0",
                    Notation::Python => "as in pivots=(-50, -20, 50, 0)",
                };
                let what = format!("give a box, least x, least y, greatest x and greatest y, {example}");
                problems.push(wrong("pivots", &format!("({numbers})"), what));
            }
        }
        let (unit, most) = match self.searched {
            Searched::Several(_) => ("curves of six-bars", LinkageSearch::MAX_SAMPLES),
            _ if space.is_some() => ("parameter sets", LinkageSearch::MAX_SAMPLES),
            _ => ("four-bars", MAX_CURVES),
        };
        if let Some(index) = self.index.filter(|index| !(1..=most).contains(index)) {
            problems.push(wrong("index", &index, format!("it is the number of {unit}: give one from 1 to {most}")));
        }
        if let Some(text) = self.condition.filter(|_| !matches!(self.searched, Searched::Atlas | Searched::Poses)) {
            let templates = match (&self.searched, self.searched_linkage()) {
                (Searched::Several(several), _) => {
                    several.spaces().iter().map(|space| space.template().clone()).collect()
                }
                (_, Some(linkage)) => vec![linkage.template.clone()],
                (_, None) => vec![Mechanism::template()],
            };
            match Condition::of_any(templates.iter().map(|template| &**template), text) {
                Ok(condition) => options.condition = Some(condition),
                Err(error) => {
                    let message = format!("{}: `{text}`: {}", self.notation.name("where"), error.message_with_help());
                    problems.push(RequestProblem { option: "where", message });
                }
            }
        }
        if problems.is_empty() { Ok((options, space)) } else { Err(problems) }
    }

    /// The linkage whose dimensions are searched, unless the search of four-bars finds them.
    fn searched_linkage(&self) -> Option<&SearchedLinkage> {
        match &self.searched {
            Searched::Linkage(linkage) => Some(linkage).filter(|linkage| !linkage.is_free_four_bar()),
            Searched::FourBars | Searched::Several(_) | Searched::Atlas | Searched::Poses => None,
        }
    }

    /// The options that do not go together.
    fn contradictions(&self) -> Vec<RequestProblem> {
        let [atlas, linkage, fixed, timed, index] =
            ["atlas", "linkage", "fixed", "timed", "index"].map(|option| self.notation.name(option));
        let mut problems = Vec::new();
        let mut add = |option, message| problems.push(RequestProblem { option, message });
        match &self.searched {
            Searched::Atlas => {
                if self.is_timed {
                    add(
                        "timed",
                        format!(
                            "{timed} and {atlas} do not go together: the curves of an atlas are compared by their shape; leave one out"
                        ),
                    );
                }
                if self.index.is_some() {
                    add(
                        "index",
                        format!(
                            "{index} is the number of random four-bars, and with {atlas} the curves of the atlas take their place: leave one out"
                        ),
                    );
                }
            }
            Searched::FourBars if self.is_fixed => {
                let example = if self.notation == Notation::CommandLine { " MANIFEST|DIR" } else { "=…" };
                add(
                    "fixed",
                    format!("{fixed} compares the curves of an atlas where they are: name one, {atlas}{example}"),
                );
            }
            Searched::Linkage(_) | Searched::Several(_) if self.is_fixed => {
                add(
                    "fixed",
                    format!(
                        "{fixed} compares the curves of an atlas where they are, and {linkage} searches linkages of any size in any place: leave one out"
                    ),
                );
            }
            Searched::FourBars | Searched::Linkage(_) | Searched::Several(_) | Searched::Poses => {}
        }
        if let Searched::Linkage(SearchedLinkage { template, .. }) = &self.searched
            && self.is_timed
            && template.is_driven_by_length()
        {
            let name = &template.id;
            add(
                "timed",
                format!(
                    "{timed} needs an input that is an angle, and that of {name} is a length: leave {timed} out, or choose another linkage"
                ),
            );
        }
        problems
    }
}
