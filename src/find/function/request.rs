//! What is asked of a search for functions, as users give it, and all that is wrong with it.

use coupler_curves::linkage::OutputLink;
use coupler_curves::template::Template;
use coupler_find::{
    Condition, Effort, FunctionMethod, FunctionOptions, FunctionTarget, GeneratorKind, LinkageFunctionOptions,
    LinkageSpace, Options, most_precision_points,
};

use super::super::request::{Request, SearchedLinkage};
use crate::notation::Notation;

/// How users choose a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FunctionFit {
    /// Exact at precision points.
    Points,
    /// Least squares.
    LeastSquares,
    /// The least greatest error.
    Minimax,
}

/// Which linkage generates a function.
#[derive(Clone, Debug)]
pub enum FunctionLinkage {
    /// One in closed form: that which is named, or the one whose output is that of the function.
    Closed(Option<GeneratorKind>),
    /// Any linkage, of which some parameters may be kept.
    Any(SearchedLinkage),
}

impl FunctionLinkage {
    /// The linkage that is named, if one is, perhaps of a manifest: a `four-bar` or `slider-crank` of the catalogue with all its lengths free is
    /// solved in closed form.
    pub fn of(named: Option<SearchedLinkage>, has_manifest: bool) -> FunctionLinkage {
        let Some(linkage) = named else { return FunctionLinkage::Closed(None) };
        match linkage.template.id.as_str() {
            _ if has_manifest || !linkage.kept.is_empty() => FunctionLinkage::Any(linkage),
            "four-bar" => FunctionLinkage::Closed(Some(GeneratorKind::FourBar)),
            "slider-crank" => FunctionLinkage::Closed(Some(GeneratorKind::SliderCrank)),
            _ => FunctionLinkage::Any(linkage),
        }
    }

    /// Whether its output is a length.
    pub fn is_length(&self) -> bool {
        match self {
            FunctionLinkage::Closed(kind) => *kind == Some(GeneratorKind::SliderCrank),
            FunctionLinkage::Any(linkage) => {
                let output = linkage.template.structure().ok().and_then(|structure| structure.output());
                output.is_some_and(OutputLink::is_slider)
            }
        }
    }
}

/// What is asked of a search for a function.
#[derive(Clone, Debug)]
pub struct FunctionRequest<'a> {
    /// How the options are written.
    pub notation: Notation,
    /// The wanted function.
    pub target: &'a FunctionTarget,
    /// Which linkage generates it.
    pub linkage: FunctionLinkage,
    /// Whether a manifest is given that may have the linkage.
    pub has_manifest: bool,
    /// How it is found; it follows from the function if it is not given.
    pub fit: Option<FunctionFit>,
    /// The number of precision points.
    pub points: Option<usize>,
    /// The input at the start, in degrees.
    pub input_start_deg: Option<f64>,
    /// The output at the start, in degrees or as a length.
    pub output_start: Option<f64>,
    /// Whether the crank must turn fully.
    pub full_turn: bool,
    /// The greatest ratio of two links of a linkage in closed form, if it is not [`FunctionRequest::MAX_LINK`].
    pub max_link: Option<f64>,
    /// A condition on the linkage.
    pub condition: Option<&'a str>,
    /// How many linkages are tried, and the number that changes which, of any linkage.
    pub effort: Option<Effort>,
    /// See there.
    pub seed: Option<u64>,
    /// The most answers.
    pub most: usize,
}

/// A search that can be begun.
#[derive(Clone, Debug)]
pub enum FunctionSearch {
    /// For a linkage in closed form, with the methods to try in turn until one has an answer.
    Closed(FunctionOptions, Vec<FunctionMethod>),
    /// For the dimensions of any linkage.
    Any(LinkageSpace, LinkageFunctionOptions),
}

/// Linkages have five unknowns, and each precision point or given start takes one.
const UNKNOWNS: usize = 5;

/// The least number of precision points.
const MIN_POINTS: usize = 3;

impl FunctionRequest<'_> {
    /// The greatest ratio of two links if none is given.
    pub const MAX_LINK: f64 = 20.0;

    /// The search.
    ///
    /// # Errors
    /// All that is wrong.
    pub fn check(&self) -> Result<FunctionSearch, Vec<String>> {
        match &self.linkage {
            FunctionLinkage::Closed(Some(kind)) => self.check_closed(*kind),
            FunctionLinkage::Closed(None) if self.target.is_length() => self.check_closed(GeneratorKind::SliderCrank),
            FunctionLinkage::Closed(None) => self.check_closed(GeneratorKind::FourBar),
            FunctionLinkage::Any(linkage) => self.check_any(linkage),
        }
    }

    fn check_closed(&self, kind: GeneratorKind) -> Result<FunctionSearch, Vec<String>> {
        let mut problems = self.unused_options();
        problems.extend(self.wrong_numbers());
        problems.extend(self.wrong_max_link());
        let max_ratio = self.max_link.unwrap_or(FunctionRequest::MAX_LINK);
        let is_length_wanted = kind == GeneratorKind::SliderCrank;
        if is_length_wanted != self.target.is_length() {
            problems.push(match is_length_wanted {
                true => "the output of a slider-crank is a length, and that of the function is an angle: give a length, or choose a four-bar".to_owned(),
                false => "the output of a four-bar is an angle, and that of the function is a length: give an angle, or choose a slider-crank".to_owned(),
            });
        }
        let methods = self.methods().unwrap_or_else(|problem| {
            problems.push(problem);
            Vec::new()
        });
        let condition = self.condition(&kind.template(), &mut problems);
        if !problems.is_empty() {
            return Err(problems);
        }
        let options = FunctionOptions {
            kind,
            method: methods[0],
            input_start_deg: self.input_start_deg,
            output_start: self.output_start,
            full_turn: self.full_turn,
            max_ratio,
            condition,
            most: self.most,
        };
        Ok(FunctionSearch::Closed(options, methods))
    }

    fn check_any(&self, linkage: &SearchedLinkage) -> Result<FunctionSearch, Vec<String>> {
        let name = |option: &str| self.notation.name(option);
        let mut problems = self.wrong_numbers();
        problems.extend(self.wrong_max_link());
        let condition = self.condition(&linkage.template, &mut problems);
        let option = name(if linkage.kept.is_empty() { "linkage" } else { "keep" });
        let space = LinkageSpace::new(linkage.template.clone(), &linkage.kept);
        let space = space.map_err(|errors| problems.extend(errors.iter().map(|error| format!("{option}: {error}"))));
        let open_starts = [self.input_start_deg, self.output_start].iter().filter(|start| start.is_none()).count();
        let points = space
            .as_ref()
            .map_or(Ok(None), |space| self.precision_points(most_precision_points(space, self.target, open_starts)));
        let points = points.unwrap_or_else(|problem| {
            problems.push(problem);
            None
        });
        let default = Options::default();
        let options = LinkageFunctionOptions {
            minimax: self.fit == Some(FunctionFit::Minimax),
            points,
            max_ratio: self.max_link.unwrap_or(f64::INFINITY),
            input_start_deg: self.input_start_deg,
            output_start: self.output_start,
            full_turn: self.full_turn,
            condition,
            effort: self.effort.unwrap_or(default.effort),
            seed: self.seed.unwrap_or(default.seed),
            most: self.most,
        };
        match space {
            Ok(space) if problems.is_empty() => Ok(FunctionSearch::Any(space, options)),
            _ => Err(problems),
        }
    }

    /// What is wrong with the greatest ratio of two links.
    fn wrong_max_link(&self) -> Option<String> {
        let ratio = self.max_link.filter(|ratio| ratio.is_nan() || *ratio < 1.0)?;
        let message = "give how many times the longest link is as long as the shortest at most, as in 10, or inf";
        Some(format!("{}: {message}", self.notation.with_value("max_link", ratio)))
    }

    /// The number of precision points of any linkage, if they are asked for: of a table its rows.
    ///
    /// # Errors
    /// There are too few or too many, or another fit is asked for, too.
    fn precision_points(&self, most: usize) -> Result<Option<usize>, String> {
        let [points, fit] = ["points", "fit"].map(|option| self.notation.name(option));
        let most = most.max(MIN_POINTS);
        let rows = self.target.row_count();
        let count = match (self.points, rows) {
            (Some(_), _) if self.fit.is_some_and(|fit| fit != FunctionFit::Points) => {
                return Err(format!(
                    "{points} is the number of points at which the error is 0, and {fit} makes it least everywhere: leave one out"
                ));
            }
            (Some(count), Some(rows)) if count != rows => {
                return Err(format!(
                    "{points} is of a formula; of a table each row is a precision point, and it has {rows} rows: leave it out"
                ));
            }
            (Some(count), _) => count,
            (None, _) if self.fit == Some(FunctionFit::Points) => rows.unwrap_or(most.min(UNKNOWNS)),
            (None, _) => return Ok(None),
        };
        if (MIN_POINTS..=most).contains(&count) {
            return Ok(Some(count));
        }
        let range = if most == MIN_POINTS { "3".to_owned() } else { format!("from {MIN_POINTS} to {most}") };
        Err(format!(
            "{count} precision points: at most {most} can be exact with so many free parameters and starts: give {range}, or {}",
            self.notation.with_value("fit", "least-squares")
        ))
    }

    /// Options of the search for any linkage, where there is none.
    fn unused_options(&self) -> Vec<String> {
        let options =
            [("manifest", self.has_manifest), ("effort", self.effort.is_some()), ("seed", self.seed.is_some())];
        let example = if self.notation == Notation::CommandLine { "--linkage NAME" } else { "linkage=…" };
        let given = options.iter().filter(|(_, is_given)| *is_given).map(|(option, _)| self.notation.name(option));
        given
            .map(|option| format!("{option} is of {example}, the dimensions of any linkage: name one, or leave it out"))
            .collect()
    }

    /// The numbers that are out of their ranges.
    fn wrong_numbers(&self) -> Vec<String> {
        let mut problems = Vec::new();
        for (option, value) in [("input_start", self.input_start_deg), ("output_start", self.output_start)] {
            if let Some(value) = value.filter(|value| !value.is_finite()) {
                problems.push(format!("{}: {value} is not a finite number", self.notation.name(option)));
            }
        }
        if !(1..=Request::MAX_TOP).contains(&self.most) {
            let option = self.notation.with_value("top", self.most);
            problems.push(format!("{option}: give a number from 1 to {}", Request::MAX_TOP));
        }
        problems
    }

    /// The condition on linkages; what is wrong with it is one of the problems.
    fn condition(&self, template: &Template, problems: &mut Vec<String>) -> Option<Condition> {
        let text = self.condition?;
        let condition = Condition::new(template, text);
        condition
            .map_err(|error| {
                problems.push(format!("{}: `{text}`: {}", self.notation.name("where"), error.message_with_help()));
            })
            .ok()
    }

    /// The methods to try in turn.
    fn methods(&self) -> Result<Vec<FunctionMethod>, String> {
        let [points, fit] = ["points", "fit"].map(|option| self.notation.name(option));
        let least_squares = self.notation.with_value("fit", "least-squares");
        let given = usize::from(self.input_start_deg.is_some()) + usize::from(self.output_start.is_some());
        let most = UNKNOWNS - given;
        let starts = match given {
            0 => "",
            1 => " with a start given",
            _ => " with both starts given",
        };
        match (self.fit, self.points) {
            (Some(FunctionFit::LeastSquares | FunctionFit::Minimax), Some(_)) => Err(format!(
                "{points} is the number of points at which the error is 0, and {fit} makes it least everywhere: leave one out"
            )),
            (Some(FunctionFit::LeastSquares), None) => Ok(vec![FunctionMethod::LeastSquares]),
            (Some(FunctionFit::Minimax), None) => Ok(vec![FunctionMethod::Minimax]),
            (_, Some(count)) if !(MIN_POINTS..=most).contains(&count) => {
                let range = if most == MIN_POINTS { "3".to_owned() } else { format!("from 3 to {most}") };
                let given = self.notation.with_value("points", count);
                Err(format!("{given}: at most {most} points can be exact{starts}: give {range}, or {least_squares}"))
            }
            (_, points_given) => match self.target.row_count() {
                None => {
                    let counts = points_given.map_or((MIN_POINTS..=most).rev().collect(), |count| vec![count]);
                    Ok(counts.into_iter().map(FunctionMethod::Points).collect())
                }
                Some(rows) if points_given.is_some_and(|count| count != rows) => Err(format!(
                    "{points} is of a formula; of a table each row is a precision point, and it has {rows} rows: leave it out"
                )),
                Some(rows) if rows <= most => Ok(vec![FunctionMethod::Points(rows)]),
                Some(rows) if self.fit.is_some() => Err(format!(
                    "{}: at most {most} points can be exact{starts}, and the table has {rows} rows: give {least_squares} or minimax",
                    self.notation.with_value("fit", "points")
                )),
                Some(_) => Ok(vec![FunctionMethod::LeastSquares]),
            },
        }
    }
}
