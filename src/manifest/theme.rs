//! The `theme` of `[page]`: the name of one, or a table that starts from one and changes it.

use super::settings::within;
use coupler_curves::expression::Dimension;
use coupler_curves::notation::{Fields, Form, Key, Reader, Table, Value, words};
use coupler_curves::problem::{Problem, Span};
use coupler_drawing::page::Theme;
use coupler_drawing::scene::{Color, Typeface};

/// The name of a theme.
pub(super) const NAME: Form = Form::Word(|| Theme::NAMED.map(|named| named.name).to_vec());

/// A theme that starts from another.
pub(super) static THEME: Table = Table::new(
    "a theme",
    &[
        Key::new("base", NAME, "The theme it starts from.").or("\"paper\""),
        Key::new("paper", Form::Color, "The colour of the paper, and of all that is hollow."),
        Key::new("ink", Form::Color, "The colour of links, joints, titles and captions."),
        Key::new("grey", Form::Color, "The colour of the source line, notes, numbers, scale bars and axes."),
        Key::new("hairline", Form::Color, "The colour of the frame and of grids."),
        Key::new("curves", Form::List(&Form::Color, [1, usize::MAX]), "The inks of curves in turn: five or more."),
        Key::new(
            "monochrome",
            Form::Truth,
            "Whether every colour becomes the grey of its lightness; as the base has it where left out.",
        ),
        Key::new("face", Form::Word(|| words(&Typeface::NAMED)), "The typeface.").or("\"serif-condensed\""),
        Key::new("drawn", Form::Within(DRAWN), "How much of a dash and its gap is dash.").or("0.6"),
        Key::new("weights", WEIGHTS_FORM, "Line weights on tabloid paper, or how many times what they are."),
        Key::new("lettering", LETTERING_FORM, "Sizes of lettering on tabloid paper, or how many times what they are."),
    ],
);

const DRAWN: [f64; 2] = [0.05, 1.0];
/// How many times what they are sizes may be.
const TIMES: [f64; 2] = [0.5, 2.0];
const WEIGHTS_FORM: Form = Form::Either(&[Form::Within(TIMES), Form::Table(&WEIGHTS)]);
const LETTERING_FORM: Form = Form::Either(&[Form::Within(TIMES), Form::Table(&LETTERING)]);
const SIZE: Form = Form::Quantity(Dimension::Paper);

static WEIGHTS: Table = Table::new(
    "`weights`",
    &[
        Key::new("link", SIZE, "Of links."),
        Key::new("curve", SIZE, "Of curves."),
        Key::new("fine", SIZE, "Of joints, the border and light curves."),
        Key::new("hair", SIZE, "Of the frame, grids and scale bars."),
        Key::new("joint", SIZE, "The radius of a joint."),
    ],
);

static LETTERING: Table = Table::new(
    "`lettering`",
    &[
        Key::new("title", SIZE, "Of the title."),
        Key::new("source", SIZE, "Of the source line and the folio."),
        Key::new("caption", SIZE, "Of captions."),
        Key::new("note", SIZE, "Of notes and numbers."),
    ],
);

/// The sizes of a theme in the order of their table's keys.
type Sizes = fn(&mut Theme) -> Vec<&mut f64>;

const WEIGHT_SIZES: Sizes =
    |theme| vec![&mut theme.link, &mut theme.curve, &mut theme.fine, &mut theme.hair, &mut theme.joint];
const LETTERING_SIZES: Sizes = |theme| vec![&mut theme.title, &mut theme.source, &mut theme.caption, &mut theme.note];

/// Reads a theme; what of it cannot be read is as in the theme it starts from.
pub(super) fn read<'t>(value: &Value<'t>, reader: &mut Reader<'t>) -> Theme {
    if value.get_ref().is_str() {
        return named(value, reader).unwrap_or_default();
    }
    let Some(fields) = Fields::of(value, &THEME, reader) else { return Theme::default() };
    let base = fields.get("base").map_or_else(|| Some(Theme::default()), |value| named(value, reader));
    let base_read = base.is_some();
    let mut theme = base.unwrap_or_default();
    let colors_read = colors(&fields, &mut theme, reader) && base_read;
    if let Some(face) = fields.get("face") {
        theme.typeface = reader.word(face, &Typeface::NAMED).unwrap_or_default();
    }
    if let Some(value) = fields.get("drawn") {
        let drawn = within(value, reader, |value, reader| reader.constant(value), DRAWN, "of a dash's span");
        theme.drawn = drawn.unwrap_or(theme.drawn);
    }
    sizes(fields.get("weights"), (&WEIGHTS, WEIGHT_SIZES, [0.02, 5.0]), &mut theme, reader);
    sizes(fields.get("lettering"), (&LETTERING, LETTERING_SIZES, [0.5, 20.0]), &mut theme, reader);
    // Of colours that could not be read nothing is asked.
    if colors_read {
        check_contrast(&fields, &theme, reader);
        check_curves(&fields, &theme, reader);
    }
    theme
}

/// Changes a theme's colours; whether all that are given could be read.
fn colors<'t>(fields: &Fields<'_, 't>, theme: &mut Theme, reader: &mut Reader<'t>) -> bool {
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
    let given = fields.get("curves").map(|value| curves(value, reader));
    all_read &= !matches!(given, Some(None));
    let given = given.flatten();
    // What starts from a monochrome theme is one as well.
    let is_monochrome = fields.get("monochrome").and_then(|value| reader.truth(value));
    if is_monochrome.unwrap_or(theme.manners.len() > 1) {
        *theme = theme.clone().in_greys(given);
    } else if let Some(given) = given {
        theme.curves = given;
    }
    all_read
}

fn named<'t>(value: &Value<'t>, reader: &mut Reader<'t>) -> Option<Theme> {
    let themes = Theme::NAMED.map(|named| (named.name, named.theme));
    reader.word(value, &themes).map(|theme| theme())
}

fn color<'t>(value: &Value<'t>, reader: &mut Reader<'t>) -> Option<Color> {
    let text = reader.text(value)?;
    let color = Color::parse(&text);
    if color.is_none() {
        let problem = Problem::error(value.span(), format!("`{}` is no colour", text.escape_debug()));
        reader.note(problem.help("write red, green and blue in hexadecimal digits, as in \"#8c2d19\""));
    }
    color
}

/// The inks of curves; none where one of them is no colour.
fn curves<'t>(value: &Value<'t>, reader: &mut Reader<'t>) -> Option<Vec<Color>> {
    let list = reader.list(value)?;
    if list.is_empty() {
        let problem = Problem::error(value.span(), "curves are drawn in no ink at all");
        reader.note(problem.help("give five colours, or leave `curves` out"));
        return None;
    }
    let read: Vec<Option<Color>> = list.iter().map(|item| color(item, reader)).collect();
    read.into_iter().collect()
}

/// Sizes on tabloid paper, each by its key; or a number, so many times what they are.
fn sizes<'t>(
    value: Option<&Value<'t>>,
    (form, known, range): (&'static Table, Sizes, [f64; 2]),
    theme: &mut Theme,
    reader: &mut Reader<'t>,
) {
    let Some(value) = value else { return };
    let is_table = value.get_ref().is_table();
    if !is_table {
        let times = within(value, reader, |value, reader| reader.constant(value), TIMES, "times the size");
        known(theme).into_iter().for_each(|size| *size *= times.unwrap_or(1.0));
        return;
    }
    let Some(fields) = Fields::of(value, form, reader) else { return };
    for (key, size) in form.names().into_iter().zip(known(theme)) {
        let Some(value) = fields.get(key) else { continue };
        let read = |value: &Value<'t>, reader: &mut Reader<'t>| reader.measure(value, Dimension::Paper);
        let mm = within(value, reader, read, range, "mm");
        *size = mm.unwrap_or(*size);
    }
}

/// What a colour is for, and the contrast with the paper that it wants: those of text and of lines in WCAG 2.2, 1.4.3
/// and 1.4.11; of hairlines, which nothing depends on, that they can be seen.
struct Role {
    key: &'static str,
    color: Color,
    /// Where the colour is given; it may be that of the theme it starts from.
    span: Option<Span>,
    wanted: f64,
}

fn roles(fields: &Fields, theme: &Theme) -> Vec<Role> {
    let place = |key: &str| fields.get(key).map(Value::span);
    let role = |key: &'static str, color, wanted| Role { key, color, span: place(key), wanted };
    let mut roles =
        vec![role("ink", theme.ink, 4.5), role("grey", theme.grey, 4.5), role("hairline", theme.hairline, 1.2)];
    let list = fields.get("curves").and_then(|value| value.get_ref().as_array());
    roles.extend(theme.curves.iter().enumerate().map(|(k, &color)| {
        let span = list.and_then(|list| list.get(k)).map(Value::span);
        Role { key: "curves", color, span, wanted: 3.0 }
    }));
    roles
}

/// Whether inks can be told from the paper. Those of the theme it starts from are complained of together, at the paper.
fn check_contrast<'t>(fields: &Fields<'_, 't>, theme: &Theme, reader: &mut Reader<'t>) {
    let mut inherited: Vec<(&str, f64)> = Vec::new();
    for Role { key, color, span, wanted } in roles(fields, theme) {
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
        reader.note(problem.help(format!(
            "their contrast is {contrast:.1} to 1, and `{key}` wants {wanted} to 1: give a {way} colour"
        )));
    }
    if let Some(worst) = inherited.iter().map(|(_, part)| *part).reduce(f64::min) {
        let mut keys: Vec<String> = inherited.iter().map(|(key, _)| format!("`{key}`")).collect();
        keys.dedup();
        let span = fields.get("paper").map_or_else(|| fields.span.clone(), Value::span);
        let message = format!("on this paper, {}, the theme's {} cannot well be seen", theme.paper, keys.join(", "));
        let problem = if worst < 0.5 { Problem::error(span, message) } else { Problem::warning(span, message) };
        let base = if theme.paper.luminance() > 0.18 { "print" } else { "dark" };
        reader.note(problem.help(format!("start from base = \"{base}\", or give these colours too")));
    }
}

/// Whether there are inks enough for curves, and whether they can be told apart.
fn check_curves<'t>(fields: &Fields<'_, 't>, theme: &Theme, reader: &mut Reader<'t>) {
    /// A difference in CIELAB at which thin lines still look alike.
    const ALIKE: f64 = 10.0;
    const INKS: usize = 5;
    let Some(value) = fields.get("curves") else { return };
    // In monochrome weights and dashes tell curves apart as well.
    if theme.manners.len() > 1 {
        return;
    }
    let inks = &theme.curves;
    if inks.len() < INKS {
        let message = format!("curves are told apart by {INKS} inks, and here are {}", inks.len());
        let help =
            "give five colours or more, or write monochrome = true: weights and dashes then tell curves apart too";
        reader.note(Problem::warning(value.span(), message).help(help));
    }
    let places = value.get_ref().as_array();
    for (k, ink) in inks.iter().enumerate() {
        let like = inks[..k].iter().find(|other| other.difference(*ink) < ALIKE);
        if let (Some(other), Some(place)) = (like, places.and_then(|list| list.get(k))) {
            let problem = Problem::warning(place.span(), format!("{ink} looks like {other}, which is given before it"));
            reader.note(problem.help("give a colour that is lighter or darker, or another hue"));
        }
    }
}
