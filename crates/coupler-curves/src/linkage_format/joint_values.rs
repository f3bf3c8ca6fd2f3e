//! The values of a joint's keys: names of joints, lengths, sides, coordinates.

use super::fields::Fields;
use super::names::JointNames;
use super::schema::{KeySchema, TableSchema, ValueSchema};
use super::toml_parser::{TomlParser, TomlValue};
use crate::expression::{CompiledExpression, Scope};
use crate::problem::{Problem, suggestion};
use crate::template::{Coordinate, InputValue, Side};

/// The sides of a line.
pub(super) const SIDES: [(&str, Side); 2] = [("left", Side::Left), ("right", Side::Right)];
/// The sides of a slide: ahead of or behind the joint it is linked to, along the line.
pub(super) const SLIDE_SIDES: [(&str, Side); 2] = [("ahead", Side::Left), ("behind", Side::Right)];

/// The most points that the grid of one `point` joint may have.
pub(super) const MAX_GRID_POINTS: usize = 10_000;

/// A number, or a range that makes a grid of points.
pub(super) const COORDINATE: ValueSchema = ValueSchema::AnyOf(&[ValueSchema::Number, ValueSchema::Table(&RANGE)]);
static RANGE: TableSchema = TableSchema::new(
    "a range",
    &[
        KeySchema::required("from", ValueSchema::Number, "The first value."),
        KeySchema::required("to", ValueSchema::Number, "The last value."),
        KeySchema::required("count", ValueSchema::Integer([1, MAX_GRID_POINTS]), "The number of values."),
    ],
);

/// The keys of a joint, and what its values may use: the names of all joints, and the parameters.
pub(super) struct JointFields<'f, 't> {
    pub name: &'f str,
    pub fields: Fields<'f, 't>,
    pub names: &'f JointNames<'f>,
    pub scope: &'f Scope<'f>,
}

impl<'t> JointFields<'_, 't> {
    /// A joint by its name.
    pub fn joint(&self, key: &str, parser: &mut TomlParser<'t>) -> Option<usize> {
        let value = self.fields.required(key, &format!("{key} = \"P\""), parser)?;
        parse_joint_ref(value, self.names, parser)
    }

    /// Two different joints by their names.
    pub fn joint_pair(&self, key: &str, parser: &mut TomlParser<'t>) -> Option<[usize; 2]> {
        let value = self.fields.required(key, &format!("{key} = [\"P\", \"Q\"]"), parser)?;
        parse_joint_pair(value, self.names, parser)
    }

    /// Three different joints by their names.
    pub fn corners(&self, key: &str, parser: &mut TomlParser<'t>) -> Option<[usize; 3]> {
        parse_corners(self.fields.get(key)?, self.names, parser)
    }

    /// Two numbers.
    pub fn numbers(&self, key: &str, parser: &mut TomlParser<'t>) -> Option<[CompiledExpression; 2]> {
        let value = self.fields.required(key, &format!("{key} = [2, 3]"), parser)?;
        let [a, b] = parser.pair(value, "[1, 2]")?;
        let (a, b) = (parser.numeric_expression(a, self.scope), parser.numeric_expression(b, self.scope));
        Some([a?, b?])
    }

    /// The lengths of two links.
    pub fn lengths(&self, parser: &mut TomlParser<'t>) -> Option<[CompiledExpression; 2]> {
        let lengths = self.numbers("lengths", parser);
        if let Some(values) = self.fields.get("lengths").and_then(|value| value.get_ref().as_array()) {
            lengths.iter().flatten().zip(values).for_each(|(length, value)| check_positive(length, value, parser));
        }
        lengths
    }

    /// The length of a link.
    pub fn length(&self, parser: &mut TomlParser<'t>) -> Option<CompiledExpression> {
        let value = self.fields.required("length", "length = 1", parser)?;
        let length = parser.numeric_expression(value, self.scope)?;
        check_positive(&length, value, parser);
        Some(length)
    }

    /// The offset of a line; 0 by default.
    pub fn offset(&self, parser: &mut TomlParser<'t>) -> Option<CompiledExpression> {
        self.number_or_zero("offset", parser)
    }

    /// A number that must be given.
    pub fn number(&self, key: &str, example: &str, parser: &mut TomlParser<'t>) -> Option<CompiledExpression> {
        let value = self.fields.required(key, example, parser)?;
        parser.numeric_expression(value, self.scope)
    }

    /// A number; 0 by default.
    pub fn number_or_zero(&self, key: &str, parser: &mut TomlParser<'t>) -> Option<CompiledExpression> {
        match self.fields.get(key) {
            None => Some(CompiledExpression::constant(0.0)),
            Some(value) => parser.numeric_expression(value, self.scope),
        }
    }

    /// An angle, which has a default in degrees.
    pub fn angle(&self, key: &str, default: f64, parser: &mut TomlParser<'t>) -> Option<InputValue> {
        match self.fields.get(key) {
            None => Some(InputValue { value: CompiledExpression::constant(default), unit: None }),
            Some(value) => parser.angle(value, self.scope),
        }
    }

    /// The side of a line.
    pub fn side(&self, words: &[(&str, Side)], parser: &mut TomlParser<'t>) -> Option<Side> {
        let value = self.fields.required("side", &format!("side = \"{}\"", words[0].0), parser)?;
        parser.word(value, words)
    }

    /// The ratio of two gears.
    pub fn ratio(&self, parser: &mut TomlParser<'t>) -> Option<[CompiledExpression; 2]> {
        let value = self.fields.required("ratio", "ratio = [2, 3]", parser)?;
        parse_ratio(value, self.scope, parser)
    }

    /// A coordinate on a link, or a range of them; 0 by default.
    pub fn coordinate(&self, key: &str, parser: &mut TomlParser<'t>) -> Option<Coordinate> {
        match self.fields.get(key) {
            None => Some(Coordinate::Single(CompiledExpression::constant(0.0))),
            Some(value) => parse_coordinate(value, self.scope, parser),
        }
    }
}

fn parse_coordinate<'t>(value: &TomlValue<'t>, scope: &Scope, parser: &mut TomlParser<'t>) -> Option<Coordinate> {
    if value.get_ref().as_table().is_none() {
        return parser.numeric_expression(value, scope).map(Coordinate::Single);
    }
    let fields = Fields::from_value(value, &RANGE, parser)?;
    let mut end = |key: &str| {
        fields.required(key, &format!("{key} = 1"), parser).and_then(|v| parser.numeric_expression(v, scope))
    };
    let (from, to) = (end("from"), end("to"));
    let count = fields.required("count", "count = 5", parser).and_then(|v| parser.integer(v, 1, MAX_GRID_POINTS));
    Some(Coordinate::Range { from: from?, to: to?, count: count? })
}

/// Parses two whole numbers other than 0; how great they are in lowest terms is checked in each cell.
fn parse_ratio<'t>(
    value: &TomlValue<'t>,
    scope: &Scope,
    parser: &mut TomlParser<'t>,
) -> Option<[CompiledExpression; 2]> {
    let [a, b] = parser.pair(value, "[1, 2]")?;
    let mut whole = |value: &TomlValue<'t>| {
        let compiled = parser.numeric_expression(value, scope)?;
        let number = compiled.evaluate(|_| f64::NAN);
        if number.is_nan() || number.fract() == 0.0 && number != 0.0 {
            return Some(compiled);
        }
        let problem = Problem::error(value.span(), format!("a gear ratio cannot contain {number}"));
        parser.report(
            problem
                .with_help("give whole numbers, from 1 to 100 in lowest terms; a negative one reverses the direction"),
        );
        None
    };
    let (a, b) = (whole(a), whole(b));
    Some([a?, b?])
}

/// Reports a length that is the same in every cell and not positive; the others are checked in each cell.
pub(super) fn check_positive<'t>(length: &CompiledExpression, value: &TomlValue<'t>, parser: &mut TomlParser<'t>) {
    let number = length.evaluate(|_| f64::NAN);
    if number <= 0.0 {
        let problem = Problem::error(value.span(), format!("a length must be positive, found {number}"));
        parser.report(problem.with_help("give a length greater than 0"));
    }
}

/// The index of a joint by its name.
pub(super) fn parse_joint_ref<'t>(
    value: &TomlValue<'t>,
    names: &JointNames,
    parser: &mut TomlParser<'t>,
) -> Option<usize> {
    let name = parser.text(value)?;
    let index = names.index_of(&name);
    // A joint may be in an entry that could not be read.
    if index.is_none() && !parser.has_syntax_error() {
        let problem = Problem::error(value.span(), format!("unknown joint `{name}`"));
        parser.report(problem.with_help(suggestion(&name, names.all())));
    }
    index
}

/// The indices of three different joints by their names.
fn parse_corners<'t>(value: &TomlValue<'t>, names: &JointNames, parser: &mut TomlParser<'t>) -> Option<[usize; 3]> {
    let list = parser.list(value)?;
    let [a, b, c] = list else {
        let problem =
            Problem::error(value.span(), format!("a parallelogram is placed from 3 joints, not {}", list.len()));
        parser
            .report(problem.with_help("name its other corners in order, as in parallelogram = [\"C\", \"O\", \"A\"]"));
        return None;
    };
    let [a, b, c] = [a, b, c].map(|value| parse_joint_ref(value, names, parser));
    let corners = [a?, b?, c?];
    let repeated = (0..3).find(|&k| corners[..k].contains(&corners[k]));
    if let Some(k) = repeated {
        let problem = Problem::error(list[k].span(), format!("`{}` is named twice", names.all()[corners[k]]));
        parser.report(problem.with_help("name three different joints"));
        return None;
    }
    Some(corners)
}

/// The indices of two different joints by their names.
pub(super) fn parse_joint_pair<'t>(
    value: &TomlValue<'t>,
    names: &JointNames,
    parser: &mut TomlParser<'t>,
) -> Option<[usize; 2]> {
    let [a, b] = parser.pair(value, "[\"A\", \"B\"]")?;
    let (a, b) = (parse_joint_ref(a, names, parser), parse_joint_ref(b, names, parser));
    let (a, b) = (a?, b?);
    if a == b {
        let problem = Problem::error(value.span(), format!("`{}` is named twice", names.all()[a]));
        parser.report(problem.with_help("name two different joints"));
        return None;
    }
    Some([a, b])
}
