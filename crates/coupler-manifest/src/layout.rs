//! Reads how the pages of a family are laid out, and the keys that only some layouts have.

use crate::bounded_number::read_within;
use crate::chart;
use crate::schema::{DEFAULT_LAYOUT, MAX_POSES, PANEL_SCALES};
use coupler_curves::expression::Dimension;
use coupler_curves::family::LengthUnit;
use coupler_curves::linkage_format::{Fields, TomlParser, TomlValue};
use coupler_curves::problem::Problem;
use coupler_drawing::page::{Layout, Options, PanelScale};

/// Reports a key that pages of a family's layout do not have.
fn check_has_layout<'t>(
    key: &str,
    value: &TomlValue<'t>,
    (layout, applies): (Option<Layout>, impl Fn(Layout) -> bool),
    parser: &mut TomlParser<'t>,
) -> Option<()> {
    let Some(layout) = layout.filter(|layout| !applies(*layout)) else { return Some(()) };
    let name = match layout {
        Layout::CouplerGrid => "a coupler grid",
        Layout::Drawing => "parts",
        _ => "charts",
    };
    let problem = Problem::error(value.span(), format!("a page of {name} has no `{key}`"));
    parser.report(problem.with_help(format!("leave `{key}` out, or write layout = \"panels\"")));
    None
}

/// Reads whether pages of panels show the linkages at their limits.
pub(crate) fn ghosts<'t>(fields: &Fields<'_, 't>, layout: Option<Layout>, parser: &mut TomlParser<'t>) -> Option<bool> {
    let Some(value) = fields.get("ghosts") else { return Some(false) };
    check_has_layout("ghosts", value, (layout, has_panels), parser)?;
    parser.boolean(value)
}

/// Whether pages of a layout have panels, if only one.
fn has_panels(layout: Layout) -> bool {
    matches!(layout, Layout::Panels { .. } | Layout::Poses)
}

/// Reads the poses of a body: each x, y and the angle in degrees; none if there are none.
pub(crate) fn poses<'t>(
    fields: &Fields<'_, 't>,
    layout: Option<Layout>,
    parser: &mut TomlParser<'t>,
) -> Option<Vec<[f64; 3]>> {
    const EXAMPLE: &str = "poses = [[0, 0, 0], [40, 10, 30]]: each x, y and the angle in degrees";
    let Some(value) = fields.get("poses") else {
        return match (layout, fields.get("layout")) {
            (Some(Layout::Poses), Some(value)) => {
                let problem = Problem::error(value.span(), "the layout is `poses`, but there are no `poses`");
                parser.report(problem.with_help(format!("give them: {EXAMPLE}")));
                None
            }
            _ => Some(Vec::new()),
        };
    };
    check_has_layout("poses", value, (layout, has_panels), parser)?;
    let items = parser.list(value)?;
    if items.is_empty() || items.len() > MAX_POSES {
        let message = format!("`poses` has {} poses: give 1 to {MAX_POSES}", items.len());
        parser.report(Problem::error(value.span(), message).with_help(format!("write {EXAMPLE}")));
        return None;
    }
    // All of them are read, so that all problems are reported.
    let read: Vec<Option<[f64; 3]>> = items.iter().map(|item| pose(item, parser)).collect();
    read.into_iter().collect()
}

/// Reads x, y and an angle in degrees.
fn pose<'t>(value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> Option<[f64; 3]> {
    /// As large as linkages may be, and turns whose digits are not lost.
    const LARGEST: f64 = 1e60;
    const LARGEST_DEG: f64 = 1e6;
    let list = parser.list(value)?;
    if let [x, y, angle_deg] = list {
        let mut read = |item: &TomlValue<'t>, most: f64, what: &str| {
            read_within(item, parser, |item, parser| parser.constant(item), [-most, most], what)
        };
        let [x, y] = [x, y].map(|item| read(item, LARGEST, "units of length"));
        let angle_deg = read(angle_deg, LARGEST_DEG, "deg");
        return Some([x?, y?, angle_deg?]);
    }
    let problem = Problem::error(value.span(), format!("expected x, y and an angle, found {} values", list.len()));
    parser.report(problem.with_help("write them like [40, 10, 30], with the angle in degrees"));
    None
}

/// Reads the scale of the linkages on pages of panels and of coupler grids; `unit` is that of the lengths, if it could be read.
pub(crate) fn panel_scale<'t>(
    fields: &Fields<'_, 't>,
    layout: Option<Layout>,
    unit: Option<Option<LengthUnit>>,
    parser: &mut TomlParser<'t>,
) -> Option<PanelScale> {
    /// The least and the greatest length of a unit on paper, in millimetres: a curve of a thousandth of a unit is seen at
    /// the greatest, a linkage of a million units fits the largest paper at the least.
    const RANGE: [f64; 2] = [0.001, 100_000.0];
    let Some(value) = fields.get("scale") else { return Some(PanelScale::default()) };
    check_has_layout("scale", value, (layout, |layout| !matches!(layout, Layout::Chart { .. })), parser)?;
    let text = value.get_ref().as_str();
    if let Some((_, scale)) = PANEL_SCALES.iter().find(|(name, _)| Some(*name) == text) {
        return Some(*scale);
    }
    if text.is_some_and(|text| text.chars().all(char::is_alphabetic)) {
        return parser.word(value, &PANEL_SCALES);
    }
    let read = |value: &TomlValue<'t>, parser: &mut TomlParser<'t>| match text.and_then(|text| text.split_once(':')) {
        Some((paper, plane)) => ratio(value, [paper, plane], unit, parser),
        None if let Some([paper, plane]) = text.and_then(fraction) => {
            let problem = Problem::error(value.span(), "a scale has a colon, and no fraction bar");
            parser.report(problem.with_help(format!("write scale = \"{paper}:{plane}\"")));
            None
        }
        None => parser.constant_quantity(value, Dimension::PaperLength),
    };
    read_within(value, parser, read, RANGE, "mm to a unit").map(PanelScale::Fixed)
}

/// The numbers of a fraction.
fn fraction(text: &str) -> Option<[&str; 2]> {
    let (over, under) = text.split_once('/')?;
    let parts = [over, under].map(str::trim);
    parts.iter().all(|part| part.parse::<f64>().is_ok()).then_some(parts)
}

/// Reads a scale like 1:2, a length on paper to one of the linkage, as millimetres to a unit, if this could be read.
fn ratio<'t>(
    value: &TomlValue<'t>,
    parts: [&str; 2],
    unit: Option<Option<LengthUnit>>,
    parser: &mut TomlParser<'t>,
) -> Option<f64> {
    let [paper, plane] = parts.map(|part| part.trim().parse().ok().filter(|number: &f64| *number > 0.0));
    let problem = match (paper, plane, unit) {
        (Some(paper), Some(plane), Some(Some(unit))) => return Some(unit.millimetres() * paper / plane),
        (Some(_), Some(_), None) => return None,
        (Some(_), Some(_), Some(None)) => Problem::error(value.span(), "this scale needs the unit of the lengths").with_help(
            "write unit = \"mm\" in [atlas] or here; or give the length of a unit on paper, as in scale = \"20 mm\"",
        ),
        _ => Problem::error(value.span(), "a scale has a number before the colon, and one after it")
            .with_help("write scale = \"1:1\", \"1:2\" for half the size, or \"2:1\" for twice the size"),
    };
    parser.report(problem);
    None
}

/// Stands for the panels of a family that is not known yet.
const UNKNOWN_PANELS: Layout = Layout::Panels { columns: 1, rows: 1 };

/// Reads the layout. Where `panels` is absent, the grid is chosen for the number of charts; that of panels is chosen when the family is known.
pub(crate) fn read<'t>(
    fields: &Fields<'_, 't>,
    page: Option<&Options>,
    charts: usize,
    parser: &mut TomlParser<'t>,
) -> Option<Layout> {
    let words = Layout::ALL.map(|(name, _)| (name, name));
    let name = match fields.get("layout") {
        Some(value) => parser.word(value, &words)?,
        None => DEFAULT_LAYOUT,
    };
    let is_chart = name == "chart";
    chart::check_layout(fields, is_chart, parser);
    // A page that could not be parsed sets no limit.
    let most = if is_chart { Layout::max_charts } else { Layout::max_panels };
    let [most_columns, most_rows] = page.map_or([100, 100], most);
    let of_one_cell = match name {
        "coupler-grid" => Some((Layout::CouplerGrid, "a page of a coupler grid")),
        "poses" => Some((Layout::Poses, "a page of poses")),
        "drawing" => Some((Layout::Drawing, "a drawing of parts")),
        _ => None,
    };
    if let Some((layout, what)) = of_one_cell {
        if let Some(value) = fields.get("panels") {
            let problem = Problem::error(value.span(), format!("{what} has one cell and no panels"));
            parser.report(problem.with_help("leave `panels` out, or write layout = \"panels\""));
        }
        return Some(layout);
    }
    let Some(value) = fields.get("panels") else {
        return match page {
            Some(page) if is_chart => Some(Layout::for_charts(page, charts)),
            page => page.map(|_| UNKNOWN_PANELS),
        };
    };
    let [columns, rows] = parser.pair(value, "[1, 2]")?;
    let (columns, rows) = (parser.integer(columns, 1, most_columns), parser.integer(rows, 1, most_rows));
    let (columns, rows) = (columns?, rows?);
    Some(if is_chart { Layout::Chart { columns, rows } } else { Layout::Panels { columns, rows } })
}
