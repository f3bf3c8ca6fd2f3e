//! `dwell` of a family: how far its output may move while it dwells.

use coupler_curves::expression::Dimension;
use coupler_curves::linkage::DwellBand;
use coupler_curves::linkage_format::{Fields, KeySchema, TableSchema, TomlParser, TomlValue, ValueSchema};
use coupler_curves::problem::Problem;
use coupler_curves::template::Template;

/// The `dwell` table.
pub(crate) static DWELL: TableSchema = TableSchema::new(
    "`dwell`",
    &[
        KeySchema::new(
            "share",
            ValueSchema::InRange([MIN_SHARE, 1.0]),
            "The width of the band relative to the swing or the stroke of the output, or to a turn.",
        ),
        KeySchema::new("angle", ValueSchema::Quantity(Dimension::Angle), "Its width for an output that turns."),
        KeySchema::new("length", ValueSchema::Positive, "Its width for an output that is a slider."),
    ],
)
.with_one_of(&["share", "angle", "length"]);

/// The least share: the output is known to a millionth of it.
const MIN_SHARE: f64 = 1e-6;

/// The default, as JSON.
pub(crate) fn default_text() -> String {
    let (key, value) = match DwellBand::default() {
        DwellBand::Share(value) => ("share", value),
        DwellBand::Angle(value) => ("angle", value),
        DwellBand::Length(value) => ("length", value),
    };
    format!("{{ \"{key}\": {value} }}")
}

/// Reads the band of the output of a linkage, if it is known.
pub(crate) fn read<'t>(
    value: &TomlValue<'t>,
    template: Option<&Template>,
    parser: &mut TomlParser<'t>,
) -> Option<DwellBand> {
    let fields = Fields::from_value(value, &DWELL, parser)?;
    let given: Vec<&str> = DWELL.key_names().into_iter().filter(|key| fields.get(key).is_some()).collect();
    // What is wrong with the joints is reported with the linkage.
    let structure = template.and_then(|template| Some((template, template.structure().ok()?)));
    let is_slider = structure.map(|(template, linkage)| (template, linkage.output().map(|output| output.is_slider())));
    let forms: &[&str] = match is_slider {
        None => &["{ share = 0.01 }", "{ angle = \"0.5 deg\" }", "{ length = 0.2 }"],
        Some((template, None)) => {
            let problem =
                Problem::error(value.span(), format!("`{}` has no output link that could dwell", template.id));
            parser.report(problem.with_help("state it with `output_link` in [[linkage]], or leave `dwell` out"));
            return None;
        }
        Some((_, Some(true))) => &["{ share = 0.01 }", "{ length = 0.2 }"],
        Some((_, Some(false))) => &["{ share = 0.01 }", "{ angle = \"0.5 deg\" }"],
    };
    let help = format!("write {}", forms.join(" or "));
    let [key] = given[..] else {
        let problem = Problem::error(value.span(), "`dwell` takes exactly one of `share`, `angle` and `length`");
        parser.report(problem.with_help(help));
        return None;
    };
    let value = fields.get(key)?;
    let has_form = forms.iter().any(|form| form.starts_with(&format!("{{ {key} ")));
    if let (Some((template, _)), false) = (is_slider, has_form) {
        let kind = if key == "angle" { "a slider, and has no angle" } else { "a link that turns, and has no length" };
        let problem = Problem::error(value.span(), format!("the output of `{}` is {kind}", template.id));
        parser.report(problem.with_help(help));
        return None;
    }
    let number = match key {
        "angle" => parser.constant_quantity(value, Dimension::Angle)?,
        _ => parser.constant(value)?,
    };
    let (range, band) = match key {
        "share" => (MIN_SHARE..=1.0, DwellBand::Share(number)),
        "angle" => (f64::MIN_POSITIVE..=360.0, DwellBand::Angle(number)),
        _ => (f64::MIN_POSITIVE..=f64::MAX, DwellBand::Length(number)),
    };
    if range.contains(&number) {
        return Some(band);
    }
    let problem = Problem::error(value.span(), format!("`{key}` is {number}, which is out of range"));
    parser.report(problem.with_help(match key {
        "share" => format!("give {MIN_SHARE} to 1"),
        "angle" => "give an angle greater than 0, at most 360 deg".to_owned(),
        _ => "give a number greater than 0".to_owned(),
    }));
    None
}
