//! What is asked of a search for functions, as users give it, and all that is wrong with it.

use coupler_find::{Condition, FunctionMethod, FunctionOptions, FunctionTarget, GeneratorKind};

use super::super::request::Notation;

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

/// What is asked of a search for a function.
#[derive(Clone, Copy, Debug)]
pub struct FunctionRequest<'a> {
    /// How the options are written.
    pub notation: Notation,
    /// The wanted function.
    pub target: &'a FunctionTarget,
    /// Which linkage generates it.
    pub kind: GeneratorKind,
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
    /// The greatest ratio of two links.
    pub max_link: f64,
    /// A condition on the linkage.
    pub condition: Option<&'a str>,
    /// The most answers.
    pub most: usize,
}

/// Linkages have five unknowns, and each precision point or given start takes one.
const UNKNOWNS: usize = 5;

/// The least number of precision points.
const MIN_POINTS: usize = 3;

impl FunctionRequest<'_> {
    /// The greatest ratio of two links if none is given.
    pub const MAX_LINK: f64 = 20.0;

    /// The options of the search, with the methods to try in turn until one has an answer.
    ///
    /// # Errors
    /// All that is wrong.
    pub fn check(&self) -> Result<(FunctionOptions, Vec<FunctionMethod>), Vec<String>> {
        let name = |option: &str| self.notation.name(option);
        let mut problems = Vec::new();
        for (option, value) in [("input_start", self.input_start_deg), ("output_start", self.output_start)] {
            if let Some(value) = value.filter(|value| !value.is_finite()) {
                problems.push(format!("{}: {value} is not a finite number", name(option)));
            }
        }
        if self.max_link.is_nan() || self.max_link < 1.0 {
            let message = "give how many times the longest link is as long as the shortest at most, as in 10, or inf";
            problems.push(format!("{} {}: {message}", name("max_link"), self.max_link));
        }
        let is_length_wanted = self.kind == GeneratorKind::SliderCrank;
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
        let condition = self.condition.map(|text| {
            Condition::new(&self.kind.template(), text)
                .map_err(|error| format!("{}: `{text}`: {}", name("where"), error.message_with_help()))
        });
        let condition = condition.transpose().unwrap_or_else(|problem| {
            problems.push(problem);
            None
        });
        if !problems.is_empty() {
            return Err(problems);
        }
        let options = FunctionOptions {
            kind: self.kind,
            method: methods[0],
            input_start_deg: self.input_start_deg,
            output_start: self.output_start,
            full_turn: self.full_turn,
            max_ratio: self.max_link,
            condition,
            most: self.most,
        };
        Ok((options, methods))
    }

    /// The methods to try in turn.
    fn methods(&self) -> Result<Vec<FunctionMethod>, String> {
        let [points, fit] = ["points", "fit"].map(|option| self.notation.name(option));
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
                Err(format!(
                    "{points} {count}: at most {most} points can be exact{starts}: give {range}, or {fit} least-squares"
                ))
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
                    "{fit} points: at most {most} points can be exact{starts}, and the table has {rows} rows: give {fit} least-squares or minimax"
                )),
                Some(_) => Ok(vec![FunctionMethod::LeastSquares]),
            },
        }
    }
}
