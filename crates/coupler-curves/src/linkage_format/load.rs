//! The schema of a `load` and its parser.

use super::fields::Fields;
use super::joint_values::parse_joint_ref;
use super::names::JointNames;
use super::schema::{KeySchema, TableSchema, ValueSchema};
use super::toml_parser::{TomlParser, TomlValue};
use crate::expression::Dimension;
use crate::linkage::Load;
use crate::problem::Problem;
use crate::template::JointTemplate;

/// The key of a load: of a `[[linkage]]`, and of a family in its place.
pub const LOAD_KEY: KeySchema = KeySchema::new(
    "load",
    ValueSchema::Table(&LOAD),
    "The force on a joint that the input moves the linkage against: measures and columns of the input torque follow from it.",
);

/// The `load` table.
static LOAD: TableSchema = TableSchema::new(
    "`load`",
    &[
        KeySchema::required("joint", ValueSchema::Text, "The joint on which the force acts."),
        KeySchema::required("force", ValueSchema::Positive, "Its magnitude, in any unit."),
        KeySchema::new(
            "direction",
            ValueSchema::Quantity(Dimension::Angle),
            "The direction that it keeps, from the x-axis; without one, it opposes the motion of the joint.",
        ),
    ],
);

/// Parses a load on one of the joints of a template, if they are known.
pub fn parse_load<'t>(
    value: &TomlValue<'t>,
    joints: Option<&[JointTemplate]>,
    parser: &mut TomlParser<'t>,
) -> Option<Load<usize>> {
    let names = joints.map(|joints| joints.iter().map(|joint| joint.name.as_str()).collect());
    parse_load_on(value, names, |joint| joints.is_some_and(|joints| joints[joint].kind.point_count() > 1), parser)
}

/// Parses a load on one of the joints with these names, if they are known, of which some are grids of points.
pub(super) fn parse_load_on<'t>(
    value: &TomlValue<'t>,
    names: Option<Vec<&str>>,
    is_grid: impl Fn(usize) -> bool,
    parser: &mut TomlParser<'t>,
) -> Option<Load<usize>> {
    let fields = Fields::from_value(value, &LOAD, parser)?;
    let names = names.map(JointNames::new);
    let joint = fields.required("joint", "joint = \"C\"", parser).and_then(|value| {
        let Some(names) = &names else {
            parser.text(value);
            return None;
        };
        let joint = parse_joint_ref(value, names, parser)?;
        if !is_grid(joint) {
            return Some(joint);
        }
        let problem = Problem::error(value.span(), format!("`{}` is a grid of points", names.all()[joint]));
        parser.report(problem.with_help("a load is on one joint: name another"));
        None
    });
    let force = fields.required("force", "force = 100", parser).and_then(|value| {
        let force = parser.constant(value)?;
        if force > 0.0 {
            return Some(force);
        }
        let problem = Problem::error(value.span(), format!("`force` must be greater than 0, found {force}"));
        parser.report(problem.with_help("write a force the other way with another `direction`"));
        None
    });
    let direction_deg = match fields.get("direction") {
        None => Some(None),
        Some(value) => parser.constant_quantity(value, Dimension::Angle).map(Some),
    };
    Some(Load { joint: joint?, force: force?, direction_deg: direction_deg? })
}
