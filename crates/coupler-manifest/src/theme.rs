//! Reads the `theme` of `[page]`: the name of a theme, or a table that modifies one.

use crate::bounded_number::read_within;
use crate::default_value;
use crate::files::FileReader;
use coupler_curves::expression::Dimension;
use coupler_curves::linkage_format::{Fields, KeySchema, TableSchema, TomlParser, TomlValue, ValueSchema, words};
use coupler_curves::problem::{Problem, Span};
use coupler_drawing::page::Theme;
use coupler_drawing::scene::{Color, FontFamily, Typeface};

/// The schema of the name of a theme.
pub(crate) const NAME_FORM: ValueSchema = ValueSchema::Word(|| Theme::NAMED.map(|named| named.name).to_vec());

/// The name of the default theme, as JSON.
pub(crate) fn default_name() -> String {
    let [default, ..] = Theme::NAMED;
    default_value::string(default.name)
}

/// The table of a theme that modifies another.
pub(crate) static THEME: TableSchema = TableSchema::new(
    "a theme",
    &[
        KeySchema::new("base", NAME_FORM, "The theme that it modifies.").with_default(default_name),
        KeySchema::new("paper", ValueSchema::Color, "The colour of the paper, and of hollow shapes."),
        KeySchema::new("ink", ValueSchema::Color, "The colour of links, joints, titles and captions."),
        KeySchema::new(
            "grey",
            ValueSchema::Color,
            "The colour of the source line, notes, numbers, scale bars and axes.",
        ),
        KeySchema::new("hairline", ValueSchema::Color, "The colour of the frame and of grids."),
        KeySchema::new(
            "curves",
            ValueSchema::List(&ValueSchema::Color, [1, usize::MAX]),
            "The inks of curves, used in turn: five or more.",
        ),
        KeySchema::new(
            "monochrome",
            ValueSchema::Boolean,
            "Whether every colour becomes the grey of its lightness; by default as in the base.",
        ),
        KeySchema::new("face", ValueSchema::Word(|| words(&FontFamily::NAMED)), "The typeface.")
            .with_default(|| default_value::word(&FontFamily::NAMED, &Theme::default().typeface.family)),
        KeySchema::new(
            "fallback_face",
            ValueSchema::Text,
            "A font file for characters that the typeface does not have, relative to the manifest's folder.",
        ),
        KeySchema::new("drawn", ValueSchema::InRange(DRAWN_RANGE), "The drawn fraction of a dash and its gap.")
            .with_default(|| Theme::default().dash_fraction.to_string()),
        KeySchema::new("weights", WEIGHTS_FORM, "Line weights on tabloid paper, or a factor for all of them."),
        KeySchema::new(
            "lettering",
            LETTERING_FORM,
            "Sizes of lettering on tabloid paper, or a factor for all of them.",
        ),
    ],
);

const DRAWN_RANGE: [f64; 2] = [0.05, 1.0];
/// The range of the factor that scales sizes.
const SCALE_RANGE: [f64; 2] = [0.5, 2.0];
const WEIGHTS_FORM: ValueSchema =
    ValueSchema::AnyOf(&[ValueSchema::InRange(SCALE_RANGE), ValueSchema::Table(&WEIGHTS)]);
const LETTERING_FORM: ValueSchema =
    ValueSchema::AnyOf(&[ValueSchema::InRange(SCALE_RANGE), ValueSchema::Table(&LETTERING)]);
const SIZE_FORM: ValueSchema = ValueSchema::Quantity(Dimension::PaperLength);

static WEIGHTS: TableSchema = TableSchema::new(
    "`weights`",
    &[
        KeySchema::new("link", SIZE_FORM, "Of links."),
        KeySchema::new("curve", SIZE_FORM, "Of curves."),
        KeySchema::new("fine", SIZE_FORM, "Of joints, the border and light curves."),
        KeySchema::new("hair", SIZE_FORM, "Of the frame, grids and scale bars."),
        KeySchema::new("joint", SIZE_FORM, "The radius of a joint."),
    ],
);

static LETTERING: TableSchema = TableSchema::new(
    "`lettering`",
    &[
        KeySchema::new("title", SIZE_FORM, "Of the title."),
        KeySchema::new("source", SIZE_FORM, "Of the source line and the folio."),
        KeySchema::new("caption", SIZE_FORM, "Of captions."),
        KeySchema::new("note", SIZE_FORM, "Of notes and numbers."),
    ],
);

/// Borrows the sizes of a theme in the order of their table's keys.
type SizeAccessor = fn(&mut Theme) -> Vec<&mut f64>;

const WEIGHT_SIZES: SizeAccessor = |theme| {
    vec![
        &mut theme.link_width,
        &mut theme.curve_width,
        &mut theme.fine_width,
        &mut theme.hair_width,
        &mut theme.joint_radius,
    ]
};
const LETTERING_SIZES: SizeAccessor =
    |theme| vec![&mut theme.title_size, &mut theme.source_size, &mut theme.caption_size, &mut theme.note_size];

/// Reads a theme; values that cannot be parsed keep those of the base theme.
pub(crate) fn read<'t>(value: &TomlValue<'t>, files: FileReader, parser: &mut TomlParser<'t>) -> Theme {
    if value.get_ref().is_str() {
        return named_theme(value, parser).unwrap_or_default();
    }
    let Some(fields) = Fields::from_value(value, &THEME, parser) else { return Theme::default() };
    let base = fields.get("base").map_or_else(|| Some(Theme::default()), |value| named_theme(value, parser));
    let base_read = base.is_some();
    let mut theme = base.unwrap_or_default();
    let colors_read = apply_colors(&fields, &mut theme, parser) && base_read;
    if let Some(face) = fields.get("face") {
        theme.typeface.family = parser.word(face, &FontFamily::NAMED).unwrap_or_default();
    }
    if let Some(value) = fields.get("fallback_face") {
        theme.typeface = with_fallback(theme.typeface, value, files, parser).unwrap_or(theme.typeface);
    }
    if let Some(value) = fields.get("drawn") {
        let drawn = read_within(value, parser, |value, parser| parser.constant(value), DRAWN_RANGE, "of a dash's span");
        theme.dash_fraction = drawn.unwrap_or(theme.dash_fraction);
    }
    apply_sizes(fields.get("weights"), (&WEIGHTS, WEIGHT_SIZES, [0.02, 5.0]), &mut theme, parser);
    apply_sizes(fields.get("lettering"), (&LETTERING, LETTERING_SIZES, [0.5, 20.0]), &mut theme, parser);
    // Colours that could not be parsed are not checked.
    if colors_read {
        check_contrast(&fields, &theme, parser);
        check_curves(&fields, &theme, parser);
    }
    theme
}

/// A typeface with the font file at a path; as it is if files are not read.
fn with_fallback<'t>(
    typeface: Typeface,
    value: &TomlValue<'t>,
    files: FileReader,
    parser: &mut TomlParser<'t>,
) -> Option<Typeface> {
    let path = parser.text(value)?;
    let Some(files) = files else { return Some(typeface) };
    let font = files.font(&path).and_then(|bytes| typeface.with_fallback(bytes).map_err(|error| error.to_string()));
    if let Err(why) = &font {
        let problem = Problem::error(value.span(), format!("cannot use `{}`: {why}", path.escape_debug()));
        parser.report(problem.with_help("give the path of a .ttf, .otf or .ttc file, relative to the manifest"));
    }
    font.ok()
}

/// Changes a theme's colours, and returns whether all of those given could be parsed.
fn apply_colors<'t>(fields: &Fields<'_, 't>, theme: &mut Theme, parser: &mut TomlParser<'t>) -> bool {
    let mut all_read = true;
    for (key, color) in [
        ("paper", &mut theme.paper),
        ("ink", &mut theme.ink),
        ("grey", &mut theme.grey),
        ("hairline", &mut theme.hairline),
    ] {
        if let Some(value) = fields.get(key) {
            let read = self::color(value, parser);
            all_read &= read.is_some();
            *color = read.unwrap_or(*color);
        }
    }
    let given = fields.get("curves").map(|value| curve_colors(value, parser));
    all_read &= !matches!(given, Some(None));
    let given = given.flatten();
    // A theme based on a monochrome theme is monochrome by default.
    let is_monochrome = fields.get("monochrome").and_then(|value| parser.boolean(value));
    if is_monochrome.unwrap_or(theme.curve_styles.len() > 1) {
        *theme = theme.clone().into_greyscale(given);
    } else if let Some(given) = given {
        theme.curve_inks = given;
    }
    all_read
}

/// Reads the name of a theme.
fn named_theme<'t>(value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> Option<Theme> {
    let themes = Theme::NAMED.map(|named| (named.name, named.theme));
    parser.word(value, &themes).map(|theme| theme())
}

/// Reads a colour.
fn color<'t>(value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> Option<Color> {
    let text = parser.text(value)?;
    let color = Color::parse(&text);
    if color.is_none() {
        let problem = Problem::error(value.span(), format!("`{}` is not a colour", text.escape_debug()));
        parser.report(problem.with_help("write red, green and blue in hexadecimal digits, as in \"#8c2d19\""));
    }
    color
}

/// Reads the inks of curves; `None` if any of them is not a colour.
fn curve_colors<'t>(value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> Option<Vec<Color>> {
    let list = parser.list(value)?;
    if list.is_empty() {
        let problem = Problem::error(value.span(), "`curves` is empty");
        parser.report(problem.with_help("give five colours, or leave `curves` out"));
        return None;
    }
    let read: Vec<Option<Color>> = list.iter().map(|item| color(item, parser)).collect();
    read.into_iter().collect()
}

/// Sets sizes on tabloid paper, each by its key, or scales all of them by a number.
fn apply_sizes<'t>(
    value: Option<&TomlValue<'t>>,
    (schema, sizes, range): (&'static TableSchema, SizeAccessor, [f64; 2]),
    theme: &mut Theme,
    parser: &mut TomlParser<'t>,
) {
    let Some(value) = value else { return };
    let is_table = value.get_ref().is_table();
    if !is_table {
        let factor = read_within(value, parser, |value, parser| parser.constant(value), SCALE_RANGE, "times the size");
        sizes(theme).into_iter().for_each(|size| *size *= factor.unwrap_or(1.0));
        return;
    }
    let Some(fields) = Fields::from_value(value, schema, parser) else { return };
    for (key, size) in schema.key_names().into_iter().zip(sizes(theme)) {
        let Some(value) = fields.get(key) else { continue };
        let read = |value: &TomlValue<'t>, parser: &mut TomlParser<'t>| {
            parser.constant_quantity(value, Dimension::PaperLength)
        };
        let mm = read_within(value, parser, read, range, "mm");
        *size = mm.unwrap_or(*size);
    }
}

/// A colour with the contrast to the paper that its use requires: those of text and of lines are from WCAG 2.2, 1.4.3
/// and 1.4.11; hairlines, which carry no information, only have to be visible.
struct ColorRole {
    key: &'static str,
    color: Color,
    /// The place where the colour is given; `None` if it is inherited from the base theme.
    span: Option<Span>,
    min_contrast: f64,
}

/// The colours of a theme whose contrast is checked.
fn color_roles(fields: &Fields, theme: &Theme) -> Vec<ColorRole> {
    let span = |key: &str| fields.get(key).map(TomlValue::span);
    let role = |key: &'static str, color, min_contrast| ColorRole { key, color, span: span(key), min_contrast };
    let mut roles =
        vec![role("ink", theme.ink, 4.5), role("grey", theme.grey, 4.5), role("hairline", theme.hairline, 1.2)];
    let list = fields.get("curves").and_then(|value| value.get_ref().as_array());
    roles.extend(theme.curve_inks.iter().enumerate().map(|(k, &color)| {
        let span = list.and_then(|list| list.get(k)).map(TomlValue::span);
        ColorRole { key: "curves", color, span, min_contrast: 3.0 }
    }));
    roles
}

/// Checks that inks contrast with the paper. Inherited inks are reported together, at `paper`.
fn check_contrast<'t>(fields: &Fields<'_, 't>, theme: &Theme, parser: &mut TomlParser<'t>) {
    let mut inherited: Vec<(&str, f64)> = Vec::new();
    for ColorRole { key, color, span, min_contrast: required } in color_roles(fields, theme) {
        let contrast = color.contrast(theme.paper);
        if contrast >= required {
            continue;
        }
        let Some(span) = span else {
            inherited.push((key, contrast / required));
            continue;
        };
        // An invisible colour is a mistake; one that is hard to see may be intended.
        let (message, is_error) = if contrast < 1.0 + 0.2 * (required - 1.0) {
            (format!("{color} cannot be distinguished from the paper, {}", theme.paper), true)
        } else {
            (format!("{color} is hard to see on the paper, {}", theme.paper), false)
        };
        let problem = if is_error { Problem::error(span, message) } else { Problem::warning(span, message) };
        let direction = if theme.paper.is_dark() { "lighter" } else { "darker" };
        parser.report(problem.with_help(format!(
            "their contrast is {contrast:.1} to 1, but `{key}` requires {required} to 1: give a {direction} colour"
        )));
    }
    if let Some(worst) = inherited.iter().map(|(_, part)| *part).reduce(f64::min) {
        let mut keys: Vec<String> = inherited.iter().map(|(key, _)| format!("`{key}`")).collect();
        keys.dedup();
        let span = fields.get("paper").map_or_else(|| fields.span.clone(), TomlValue::span);
        let message = format!("on this paper, {}, the theme's {} are hard to see", theme.paper, keys.join(", "));
        let problem = if worst < 0.5 { Problem::error(span, message) } else { Problem::warning(span, message) };
        let base = if theme.paper.is_dark() { "dark" } else { "print" };
        parser.report(problem.with_help(format!("start from base = \"{base}\", or set these colours too")));
    }
}

/// Checks that there are enough inks for curves, and that they can be told apart.
fn check_curves<'t>(fields: &Fields<'_, 't>, theme: &Theme, parser: &mut TomlParser<'t>) {
    /// A difference in CIELAB at which thin lines still look alike.
    const MIN_DIFFERENCE: f64 = 10.0;
    const MIN_INKS: usize = 5;
    let Some(value) = fields.get("curves") else { return };
    // In a monochrome theme weights and dashes tell curves apart as well.
    if theme.curve_styles.len() > 1 {
        return;
    }
    let inks = &theme.curve_inks;
    if inks.len() < MIN_INKS {
        let message = format!("expected at least {MIN_INKS} inks to tell curves apart, found {}", inks.len());
        let help = "give five colours or more, or set monochrome = true to tell curves apart by weights and dashes too";
        parser.report(Problem::warning(value.span(), message).with_help(help));
    }
    let places = value.get_ref().as_array();
    for (k, ink) in inks.iter().enumerate() {
        let like = inks[..k].iter().find(|other| other.difference(*ink) < MIN_DIFFERENCE);
        if let (Some(other), Some(place)) = (like, places.and_then(|list| list.get(k))) {
            let problem = Problem::warning(place.span(), format!("{ink} looks like {other}, which is given before it"));
            parser.report(problem.with_help("give a colour that is lighter or darker, or another hue"));
        }
    }
}
