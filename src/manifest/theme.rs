//! The `theme` of `[page]`: the name of one, or a table that starts from one and changes it.

use super::settings::read_within;
use coupler_curves::expression::Dimension;
use coupler_curves::linkage_format::{Fields, KeySchema, TableSchema, TomlParser, TomlValue, ValueSchema, words};
use coupler_curves::problem::{Problem, Span};
use coupler_drawing::page::Theme;
use coupler_drawing::scene::{Color, Typeface};

/// The name of a theme.
pub(super) const NAME_FORM: ValueSchema = ValueSchema::Word(|| Theme::NAMED.map(|named| named.name).to_vec());

/// A theme that starts from another.
pub(super) static THEME: TableSchema = TableSchema::new(
    "a theme",
    &[
        KeySchema::new("base", NAME_FORM, "The theme it starts from.").with_default("\"paper\""),
        KeySchema::new("paper", ValueSchema::Color, "The colour of the paper, and of all that is hollow."),
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
            "The inks of curves in turn: five or more.",
        ),
        KeySchema::new(
            "monochrome",
            ValueSchema::Boolean,
            "Whether every colour becomes the grey of its lightness; as the base has it where left out.",
        ),
        KeySchema::new("face", ValueSchema::Word(|| words(&Typeface::NAMED)), "The typeface.")
            .with_default("\"serif-condensed\""),
        KeySchema::new("drawn", ValueSchema::InRange(DRAWN_RANGE), "How much of a dash and its gap is dash.")
            .with_default("0.6"),
        KeySchema::new("weights", WEIGHTS_FORM, "Line weights on tabloid paper, or how many times what they are."),
        KeySchema::new(
            "lettering",
            LETTERING_FORM,
            "Sizes of lettering on tabloid paper, or how many times what they are.",
        ),
    ],
);

const DRAWN_RANGE: [f64; 2] = [0.05, 1.0];
/// How many times what they are sizes may be.
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

/// The sizes of a theme in the order of their table's keys.
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

/// Reads a theme; what of it cannot be read is as in the theme it starts from.
pub(super) fn read<'t>(value: &TomlValue<'t>, reader: &mut TomlParser<'t>) -> Theme {
    if value.get_ref().is_str() {
        return named_theme(value, reader).unwrap_or_default();
    }
    let Some(fields) = Fields::from_value(value, &THEME, reader) else { return Theme::default() };
    let base = fields.get("base").map_or_else(|| Some(Theme::default()), |value| named_theme(value, reader));
    let base_read = base.is_some();
    let mut theme = base.unwrap_or_default();
    let colors_read = apply_colors(&fields, &mut theme, reader) && base_read;
    if let Some(face) = fields.get("face") {
        theme.typeface = reader.word(face, &Typeface::NAMED).unwrap_or_default();
    }
    if let Some(value) = fields.get("drawn") {
        let drawn = read_within(value, reader, |value, reader| reader.constant(value), DRAWN_RANGE, "of a dash's span");
        theme.dash_fraction = drawn.unwrap_or(theme.dash_fraction);
    }
    apply_sizes(fields.get("weights"), (&WEIGHTS, WEIGHT_SIZES, [0.02, 5.0]), &mut theme, reader);
    apply_sizes(fields.get("lettering"), (&LETTERING, LETTERING_SIZES, [0.5, 20.0]), &mut theme, reader);
    // Of colours that could not be read nothing is asked.
    if colors_read {
        check_contrast(&fields, &theme, reader);
        check_curves(&fields, &theme, reader);
    }
    theme
}

/// Changes a theme's colours; whether all that are given could be read.
fn apply_colors<'t>(fields: &Fields<'_, 't>, theme: &mut Theme, reader: &mut TomlParser<'t>) -> bool {
    let mut all_read = true;
    for (key, color) in [
        ("paper", &mut theme.paper),
        ("ink", &mut theme.ink),
        ("grey", &mut theme.grey),
        ("hairline", &mut theme.hairline),
    ] {
        if let Some(value) = fields.get(key) {
            let read = self::color(value, reader);
            all_read &= read.is_some();
            *color = read.unwrap_or(*color);
        }
    }
    let given = fields.get("curves").map(|value| curve_colors(value, reader));
    all_read &= !matches!(given, Some(None));
    let given = given.flatten();
    // What starts from a monochrome theme is one as well.
    let is_monochrome = fields.get("monochrome").and_then(|value| reader.boolean(value));
    if is_monochrome.unwrap_or(theme.curve_styles.len() > 1) {
        *theme = theme.clone().into_greyscale(given);
    } else if let Some(given) = given {
        theme.curve_inks = given;
    }
    all_read
}

fn named_theme<'t>(value: &TomlValue<'t>, reader: &mut TomlParser<'t>) -> Option<Theme> {
    let themes = Theme::NAMED.map(|named| (named.name, named.theme));
    reader.word(value, &themes).map(|theme| theme())
}

fn color<'t>(value: &TomlValue<'t>, reader: &mut TomlParser<'t>) -> Option<Color> {
    let text = reader.text(value)?;
    let color = Color::parse(&text);
    if color.is_none() {
        let problem = Problem::error(value.span(), format!("`{}` is no colour", text.escape_debug()));
        reader.report(problem.with_help("write red, green and blue in hexadecimal digits, as in \"#8c2d19\""));
    }
    color
}

/// The inks of curves; none where one of them is no colour.
fn curve_colors<'t>(value: &TomlValue<'t>, reader: &mut TomlParser<'t>) -> Option<Vec<Color>> {
    let list = reader.list(value)?;
    if list.is_empty() {
        let problem = Problem::error(value.span(), "curves are drawn in no ink at all");
        reader.report(problem.with_help("give five colours, or leave `curves` out"));
        return None;
    }
    let read: Vec<Option<Color>> = list.iter().map(|item| color(item, reader)).collect();
    read.into_iter().collect()
}

/// Sizes on tabloid paper, each by its key; or a number, so many times what they are.
fn apply_sizes<'t>(
    value: Option<&TomlValue<'t>>,
    (form, known, range): (&'static TableSchema, SizeAccessor, [f64; 2]),
    theme: &mut Theme,
    reader: &mut TomlParser<'t>,
) {
    let Some(value) = value else { return };
    let is_table = value.get_ref().is_table();
    if !is_table {
        let times = read_within(value, reader, |value, reader| reader.constant(value), SCALE_RANGE, "times the size");
        known(theme).into_iter().for_each(|size| *size *= times.unwrap_or(1.0));
        return;
    }
    let Some(fields) = Fields::from_value(value, form, reader) else { return };
    for (key, size) in form.key_names().into_iter().zip(known(theme)) {
        let Some(value) = fields.get(key) else { continue };
        let read = |value: &TomlValue<'t>, reader: &mut TomlParser<'t>| {
            reader.constant_quantity(value, Dimension::PaperLength)
        };
        let mm = read_within(value, reader, read, range, "mm");
        *size = mm.unwrap_or(*size);
    }
}

/// What a colour is for, and the contrast with the paper that it wants: those of text and of lines in WCAG 2.2, 1.4.3
/// and 1.4.11; of hairlines, which nothing depends on, that they can be seen.
struct ColorRole {
    key: &'static str,
    color: Color,
    /// Where the colour is given; it may be that of the theme it starts from.
    span: Option<Span>,
    min_contrast: f64,
}

fn color_roles(fields: &Fields, theme: &Theme) -> Vec<ColorRole> {
    let place = |key: &str| fields.get(key).map(TomlValue::span);
    let role = |key: &'static str, color, wanted| ColorRole { key, color, span: place(key), min_contrast: wanted };
    let mut roles =
        vec![role("ink", theme.ink, 4.5), role("grey", theme.grey, 4.5), role("hairline", theme.hairline, 1.2)];
    let list = fields.get("curves").and_then(|value| value.get_ref().as_array());
    roles.extend(theme.curve_inks.iter().enumerate().map(|(k, &color)| {
        let span = list.and_then(|list| list.get(k)).map(TomlValue::span);
        ColorRole { key: "curves", color, span, min_contrast: 3.0 }
    }));
    roles
}

/// Whether inks can be told from the paper. Those of the theme it starts from are complained of together, at the paper.
fn check_contrast<'t>(fields: &Fields<'_, 't>, theme: &Theme, reader: &mut TomlParser<'t>) {
    let mut inherited: Vec<(&str, f64)> = Vec::new();
    for ColorRole { key, color, span, min_contrast: wanted } in color_roles(fields, theme) {
        let contrast = color.contrast(theme.paper);
        if contrast >= wanted {
            continue;
        }
        let Some(span) = span else {
            inherited.push((key, contrast / wanted));
            continue;
        };
        // One that cannot be seen is a mistake, one that can hardly be seen may be meant.
        let (message, is_error) = if contrast < 1.0 + 0.2 * (wanted - 1.0) {
            (format!("{color} cannot be told from the paper, {}", theme.paper), true)
        } else {
            (format!("{color} is hard to see on the paper, {}", theme.paper), false)
        };
        let problem = if is_error { Problem::error(span, message) } else { Problem::warning(span, message) };
        let way = if theme.paper.luminance() > 0.18 { "darker" } else { "lighter" };
        reader.report(problem.with_help(format!(
            "their contrast is {contrast:.1} to 1, and `{key}` wants {wanted} to 1: give a {way} colour"
        )));
    }
    if let Some(worst) = inherited.iter().map(|(_, part)| *part).reduce(f64::min) {
        let mut keys: Vec<String> = inherited.iter().map(|(key, _)| format!("`{key}`")).collect();
        keys.dedup();
        let span = fields.get("paper").map_or_else(|| fields.span.clone(), TomlValue::span);
        let message = format!("on this paper, {}, the theme's {} cannot well be seen", theme.paper, keys.join(", "));
        let problem = if worst < 0.5 { Problem::error(span, message) } else { Problem::warning(span, message) };
        let base = if theme.paper.luminance() > 0.18 { "print" } else { "dark" };
        reader.report(problem.with_help(format!("start from base = \"{base}\", or give these colours too")));
    }
}

/// Whether there are inks enough for curves, and whether they can be told apart.
fn check_curves<'t>(fields: &Fields<'_, 't>, theme: &Theme, reader: &mut TomlParser<'t>) {
    /// A difference in CIELAB at which thin lines still look alike.
    const MIN_DIFFERENCE: f64 = 10.0;
    const MIN_INKS: usize = 5;
    let Some(value) = fields.get("curves") else { return };
    // In monochrome weights and dashes tell curves apart as well.
    if theme.curve_styles.len() > 1 {
        return;
    }
    let inks = &theme.curve_inks;
    if inks.len() < MIN_INKS {
        let message = format!("curves are told apart by {MIN_INKS} inks, and here are {}", inks.len());
        let help =
            "give five colours or more, or write monochrome = true: weights and dashes then tell curves apart too";
        reader.report(Problem::warning(value.span(), message).with_help(help));
    }
    let places = value.get_ref().as_array();
    for (k, ink) in inks.iter().enumerate() {
        let like = inks[..k].iter().find(|other| other.difference(*ink) < MIN_DIFFERENCE);
        if let (Some(other), Some(place)) = (like, places.and_then(|list| list.get(k))) {
            let problem = Problem::warning(place.span(), format!("{ink} looks like {other}, which is given before it"));
            reader.report(problem.with_help("give a colour that is lighter or darker, or another hue"));
        }
    }
}
