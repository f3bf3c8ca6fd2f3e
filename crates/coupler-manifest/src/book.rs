//! Reads `[book]`: what the book has in addition to the pages of its families.

use crate::bounded_number::read_within;
use crate::names::{read_filter, states_direction, uses_text_measure};
use crate::plan::{BookPlan, FindingCharts, ListCriteria, PlannedChapter, PlannedFamily, PlannedList};
use coupler_curves::expression::{Caption, CompiledExpression, Dimension, Expression, Kind, Scope};
use coupler_curves::family::Family;
use coupler_curves::linkage::OutputLink;
use coupler_curves::linkage_format::{Fields, KeySchema, TableSchema, TomlParser, TomlValue, ValueSchema};
use coupler_curves::problem::Problem;
use coupler_drawing::page::book::Emphasis;
use coupler_drawing::page::{Layout, Options, Paper};
use coupler_drawing::render::Format;

/// The prefixes of the names of measures, with what they are measures of.
const EMPHASES: [(&str, Emphasis); 10] = [
    ("straight_half_turn_", Emphasis::None),
    ("straight_5_", Emphasis::Straight5),
    ("straight_10_", Emphasis::Straight10),
    ("straight_", Emphasis::Straight),
    ("dwell_", Emphasis::Dwell),
    ("curvature_", Emphasis::Sharpest),
    ("cusps", Emphasis::Sharpest),
    ("symmetry_", Emphasis::Axis),
    ("time_ratio", Emphasis::Limits),
    ("output_", Emphasis::Limits),
];

/// What the measures of a sort key are measures of, or else those of a condition: of the first that has something to emphasise.
fn emphasis_of(sort: Option<&Expression>, filter: Option<&Expression>) -> Emphasis {
    let of_name = |name: &String| EMPHASES.iter().find(|(prefix, _)| name.starts_with(prefix)).map(|(_, e)| *e);
    let mut names = sort.into_iter().chain(filter).flat_map(Expression::names);
    names.find_map(of_name).unwrap_or(Emphasis::None)
}

/// The most entries of a list.
const MAX_COUNT: usize = 1000;

/// The most columns of a list that is a table.
const MAX_COLUMNS: usize = 8;

/// The default number of entries of a list.
const DEFAULT_COUNT: usize = 100;

/// The default number of entries of a cell.
const DEFAULT_PER_GEOMETRY: usize = 1;

/// The most lists and chapters.
const MAX_TABLES: usize = 50;

/// The greatest gutter and bleed, in millimetres.
const MAX_BINDING: f64 = 50.0;
const MAX_BLEED: f64 = 10.0;

/// The most characters of an address: more would make the codes on plates large.
const MAX_ADDRESS: usize = 200;

/// The `[book]` table.
pub(crate) static BOOK: TableSchema = TableSchema::new(
    "[book]",
    &[
        KeySchema::new(
            "plates_only",
            ValueSchema::Boolean,
            "Whether it has neither a title page nor contents, lists and index; by default if there is no [book] and a single plate.",
        ),
        KeySchema::new("how_to_read", ValueSchema::Boolean, "Whether two facing pages say how plates are read.")
            .with_default(|| "true".to_owned()),
        KeySchema::new(
            "finding_charts",
            ValueSchema::Boolean,
            "Whether charts show the shapes of the curves of each family; by default of those with many plates.",
        ),
        KeySchema::new("thumb_index", ValueSchema::Boolean, "Whether pages have marks at their outer edges.")
            .with_default(|| "true".to_owned()),
        KeySchema::new(
            "index",
            ValueSchema::Boolean,
            "Whether geometries are listed by straightness, transmission angle and symmetry.",
        )
        .with_default(|| "true".to_owned()),
        KeySchema::new(
            "binding",
            ValueSchema::Quantity(Dimension::PaperLength),
            "The width of the gutter at the inner edge of each page; by default none.",
        ),
        KeySchema::new(
            "bleed",
            ValueSchema::Quantity(Dimension::PaperLength),
            "How far pages are printed beyond their edges, which is cut off; by default not at all.",
        ),
        KeySchema::new(
            "gallery",
            ValueSchema::Text,
            "The address of the atlas on the web, to which each plate has a QR code and a link; by default none.",
        ),
        KeySchema::new(
            "chapter",
            ValueSchema::List(&ValueSchema::Table(&CHAPTER), [0, MAX_TABLES]),
            "Chapters for cells that are taken out of their families; by default the change points of coupler grids.",
        ),
        KeySchema::new(
            "list",
            ValueSchema::List(&ValueSchema::Table(&LIST), [0, MAX_TABLES]),
            "Lists of the best curves; by default straight portions, dwells, cusps, symmetrical curves, quick returns.",
        ),
    ],
);

/// A `[[book.chapter]]` table.
static CHAPTER: TableSchema = TableSchema::new(
    "a [[book.chapter]]",
    &[
        KeySchema::required("title", ValueSchema::Text, "Its title, after that of the family."),
        KeySchema::required(
            "where",
            ValueSchema::Text,
            "The cells in it: those with a curve that meets a condition over names and measures.",
        ),
    ],
);

/// A `[[book.list]]` table.
static LIST: TableSchema = TableSchema::new(
    "a [[book.list]]",
    &[
        KeySchema::required("title", ValueSchema::Text, "Its title."),
        KeySchema::new("note", ValueSchema::Text, "What is listed and in what order, in words."),
        KeySchema::new("where", ValueSchema::Text, "The curves that are listed: a condition over names and measures."),
        KeySchema::required(
            "sort",
            ValueSchema::WithExamples(&ValueSchema::Number, crate::chart::numeric_measures),
            "The order of the curves, least first: an expression over names and measures.",
        ),
        KeySchema::new(
            "caption",
            ValueSchema::Text,
            "What is said of each curve, with values and measures in braces; its parts, between ` · `, are lines.",
        ),
        KeySchema::new(
            "columns",
            ValueSchema::List(&ValueSchema::Text, [1, MAX_COLUMNS]),
            "What is said of each curve if the list is a table with a line for each: `head: value`, with measures in braces.",
        ),
        KeySchema::new("count", ValueSchema::Integer([1, MAX_COUNT]), "The most curves.")
            .with_default(|| DEFAULT_COUNT.to_string()),
        KeySchema::new("per_geometry", ValueSchema::Integer([1, MAX_COUNT]), "The most curves of a cell.")
            .with_default(|| DEFAULT_PER_GEOMETRY.to_string()),
    ],
);

/// A list of a book without lists of its own.
struct DefaultList {
    title: &'static str,
    note: &'static str,
    filter: &'static str,
    sort: &'static str,
    caption: &'static str,
    columns: &'static [&'static str],
    count: usize,
    per_geometry: usize,
}

/// The lists of a book by default. Curves that are nearly circles, and those that are nearly arcs traversed back and
/// forth, as of points next to a pin, are trivial: the area they enclose is that of a circle, or nothing.
static DEFAULT_LISTS: [DefaultList; 6] = [
    DefaultList {
        title: "Straight portions by input",
        note: "The longest portions in a strip no wider than 1 % of their length, by the input that they take, the \
               greatest first: where they begin, their length, also as a part of the greatest extent of the curve, \
               their deviation from a line, and the least transmission angle μ, of 15° and more; of curves that are \
               not nearly circles.",
        filter: "straight_10_share >= 0.2 and 4 * pi * abs(area) < 0.9 * length^2 and mu_worst_deg >= 15",
        sort: "-straight_10_input_deg",
        caption: "",
        columns: &[
            "over: {straight_10_input_deg:.0}°",
            "from: {straight_10_start_deg:.0}°",
            "length: {straight_10_length:.3}",
            "of extent: {100 * straight_10_share:.0} %",
            "±: {straight_10_deviation:.4}",
            "μ: {mu_worst_deg:.0}°",
        ],
        count: MAX_COUNT,
        per_geometry: 4,
    },
    DefaultList {
        title: "Straight portions",
        note: "The longest straight portions, relative to the greatest extent of the curve; of curves that are not \
               nearly circles, with transmission angles of 15° and more.",
        filter: "straight_share >= 0.2 and 4 * pi * abs(area) < 0.9 * length^2 and mu_worst_deg >= 15",
        sort: "-straight_share",
        caption: "straight over {straight_length:.3} ± {straight_deviation:.4} · {100 * straight_share:.0} % of the \
                  extent · input {straight_start_deg:.0}° + {straight_input_deg:.0}° · least μ {mu_worst_deg:.1}°",
        columns: &[],
        count: DEFAULT_COUNT,
        per_geometry: DEFAULT_PER_GEOMETRY,
    },
    DefaultList {
        title: "Dwells",
        note: "The circular portions that span the most input: a link as long as the radius, pivoted on the point, \
               rests with its other end. Of curves that are neither nearly circles nor thin crescents, which would \
               hardly move it, with transmission angles of 15° and more.",
        filter: "dwell_input_deg >= 30 and 4 * pi * abs(area) < 0.9 * length^2 and \
                 4 * pi * abs(area) > 0.3 * length^2 and mu_worst_deg >= 15",
        sort: "-dwell_input_deg",
        caption: "dwell {dwell_input_deg:.0}° from {dwell_start_deg:.0}° of input · radius {dwell_radius:.3} ± \
                  {dwell_deviation:.4} · centre {dwell_x:.3}, {dwell_y:.3} · least μ {mu_worst_deg:.1}°",
        columns: &[],
        count: DEFAULT_COUNT,
        per_geometry: DEFAULT_PER_GEOMETRY,
    },
    DefaultList {
        title: "Cusps",
        note: "Curves with a point so sharp that it is a cusp for all purposes: its radius of curvature is less than \
               1/5000 of the length of the curve. The greatest transmission angle first; without thin crescents, \
               and angles below 15°.",
        filter: "(cusps > 0 or curvature_max * length > 5000) and \
                 4 * pi * abs(area) > 0.15 * length^2 and mu_worst_deg >= 15",
        sort: "-mu_worst_deg",
        caption: "cusps {cusps:.0}, crunodes {crunodes:.0} · least μ {mu_worst_deg:.1}°",
        columns: &[],
        count: DEFAULT_COUNT,
        per_geometry: DEFAULT_PER_GEOMETRY,
    },
    DefaultList {
        title: "Symmetrical curves",
        note: "The curves that are most nearly symmetrical: the least deviation from the mirror image first. Of curves \
               with inflections, cusps or crunodes, which excludes ovals, without thin crescents, and with \
               transmission angles of 15° and more.",
        filter: "symmetry_residual < 0.01 and inflections + cusps + crunodes > 0 and \
                 4 * pi * abs(area) > 0.15 * length^2 and mu_worst_deg >= 15",
        sort: "symmetry_residual",
        caption: "deviation {100 * symmetry_residual:.3} % of the extent · axis at {symmetry_deg:.1}° · inflections \
                  {inflections:.0}, crunodes {crunodes:.0} · least μ {mu_worst_deg:.1}°",
        columns: &[],
        count: DEFAULT_COUNT,
        per_geometry: DEFAULT_PER_GEOMETRY,
    },
    DefaultList {
        title: "Quick returns",
        note: "The linkages with the greatest time ratios of their outputs, drawn at the limits of the output, the least in \
               black, with transmission angles of 15° and more.",
        filter: "time_ratio >= 1.1 and mu_worst_deg >= 15",
        sort: "-time_ratio",
        caption: "time ratio {time_ratio:.3} · output from {output_min:.2}[unit] to {output_max:.2}[unit] · least μ {mu_worst_deg:.1}°",
        columns: &[],
        count: DEFAULT_COUNT,
        per_geometry: DEFAULT_PER_GEOMETRY,
    },
];

/// What is in the captions of default lists in place of the unit of the output.
const OUTPUT_UNIT: &str = "[unit]";

/// The unit of the output of a family, as written after a number: degrees of a link that turns, that of its lengths of a slider.
fn output_unit(planned: &PlannedFamily) -> String {
    let output = planned.family.template.structure().ok().and_then(|linkage| linkage.output());
    match output.is_some_and(OutputLink::is_slider) {
        true => planned.family.unit.map_or(String::new(), |unit| format!(" {}", unit.symbol())),
        false => "°".to_owned(),
    }
}

/// The title of the chapter that a book has by default.
const CHANGE_POINTS: &str = "change points";

/// Reads `[book]`; the defaults if there is none.
///
/// If some families could not be read, names that the others do not have are no problem.
pub(crate) fn read<'t>(
    value: Option<&TomlValue<'t>>,
    (planned, are_complete): (&[PlannedFamily], bool),
    page: Option<&Options>,
    parser: &mut TomlParser<'t>,
) -> Option<BookPlan> {
    let families = Families { planned, are_complete };
    let fields = match value {
        None => None,
        Some(value) => Some(Fields::from_value(value, &BOOK, parser)?),
    };
    let get = |key: &str| fields.as_ref().and_then(|fields| fields.get(key));
    let mut flag = |key: &str| get(key).map_or(Some(true), |value| parser.boolean(value));
    let [how_to_read, thumb_index, index] = ["how_to_read", "thumb_index", "index"].map(&mut flag);
    let plates_only = match (&fields, get("plates_only")) {
        (None, _) => Some(None),
        (Some(_), None) => Some(Some(false)),
        (Some(_), Some(value)) => parser.boolean(value).map(Some),
    };
    let finding_charts = finding_charts(get("finding_charts"), families, parser);
    let mut length = |key: &str, most: f64| get(key).map_or(Some(0.0), |value| paper_length(value, most, parser));
    let (binding, bleed) = (length("binding", MAX_BINDING), length("bleed", MAX_BLEED));
    let gallery = get("gallery").map_or(Some(None), |value| address(value, parser).map(Some));
    let chapters = match (&fields, get("chapter")) {
        (Some(fields), Some(_)) => {
            read_tables(fields, "chapter", |value, parser| chapter(value, families, parser), parser)
        }
        _ => Some(vec![change_points(planned)]),
    };
    let lists = match (&fields, get("list")) {
        (Some(fields), Some(_)) => read_tables(fields, "list", |value, parser| list(value, families, parser), parser),
        _ => Some(DEFAULT_LISTS.iter().filter_map(|default| default_list(default, planned)).collect()),
    };
    let manifest_inputs =
        value.map_or(String::new(), |value| coupler_curves::linkage_format::canonical_toml(value, &[]));
    let room = match (get("binding"), binding, page) {
        (Some(value), Some(binding), Some(page)) => {
            check_room(value, &page.clone().with_gutter(binding), planned, parser)
        }
        _ => Some(()),
    };
    let plan = BookPlan {
        plates_only: plates_only?,
        how_to_read: how_to_read?,
        finding_charts: finding_charts?,
        thumb_index: thumb_index?,
        index: index?,
        chapters: chapters?,
        lists: lists?,
        binding: binding?,
        bleed: bleed?,
        gallery: gallery?,
        manifest_inputs,
    };
    room.map(|()| plan)
}

/// The address of a folder or a page on the web.
fn address<'t>(value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> Option<String> {
    let text = short_text(value, MAX_ADDRESS, parser)?;
    let is_address =
        |rest: &str| !rest.is_empty() && rest.chars().all(|c| c.is_ascii_graphic() && !"\"<>\\^`{|}#?".contains(c));
    if ["https://", "http://"].iter().any(|scheme| text.strip_prefix(scheme).is_some_and(is_address)) {
        return Some(text);
    }
    let problem = Problem::error(value.span(), "this is not the address of a gallery");
    parser.report(
        problem.with_help("give that of the folder of its index.html, as in gallery = \"https://example.org/atlas/\""),
    );
    None
}

/// A length on paper, in millimetres, from 0.
fn paper_length<'t>(value: &TomlValue<'t>, most: f64, parser: &mut TomlParser<'t>) -> Option<f64> {
    let read =
        |value: &TomlValue<'t>, parser: &mut TomlParser<'t>| parser.constant_quantity(value, Dimension::PaperLength);
    read_within(value, parser, read, [0.0, most], "mm")
}

/// Reports a gutter that leaves too little of the pages, or of those of a family.
fn check_room<'t>(
    value: &TomlValue<'t>,
    page: &Options,
    families: &[PlannedFamily],
    parser: &mut TomlParser<'t>,
) -> Option<()> {
    let [least, _] = Paper::SIDE_RANGE;
    let is_too_wide = |planned: &&PlannedFamily| {
        let most = match planned.layout {
            Layout::Panels { .. } => Layout::max_panels(page),
            Layout::Chart { .. } => Layout::max_charts(page),
            Layout::CouplerGrid | Layout::Poses | Layout::Drawing => return false,
        };
        planned.formats.contains(&Format::Pdf) && planned.layout.grid()[0] > most[0]
    };
    let (problem, help) = if page.paper.width < least {
        let left = page.paper.width;
        (
            format!("the gutter leaves {left} mm of the width of a page: the least is {least} mm"),
            "give a narrower gutter, or wider paper",
        )
    } else {
        let Some(planned) = families.iter().find(is_too_wide) else { return Some(()) };
        let ([columns, _], id) = (planned.layout.grid(), &planned.family.id);
        (
            format!("the gutter leaves no space for the {columns} columns of family `{id}`"),
            "give a narrower gutter, wider paper, or fewer columns",
        )
    };
    parser.report(Problem::error(value.span(), problem).with_help(help));
    None
}

/// For which families there are finding charts; a warning if that is none although they are asked for.
fn finding_charts<'t>(
    value: Option<&TomlValue<'t>>,
    families: Families,
    parser: &mut TomlParser<'t>,
) -> Option<FindingCharts> {
    let Some(value) = value else { return Some(FindingCharts::WherePlatesAreMany) };
    if !parser.boolean(value)? {
        return Some(FindingCharts::None);
    }
    let can_have_charts = |planned: &PlannedFamily| planned.chart.is_none() && planned.family.cell_count() > 1;
    if families.have_book() && !families.planned.iter().any(can_have_charts) {
        let problem =
            Problem::warning(value.span(), "no family has finding charts: none has pages of two linkages or more");
        parser.report(problem.with_help("leave `finding_charts` out"));
    }
    Some(FindingCharts::Always)
}

/// The families of a manifest.
#[derive(Clone, Copy)]
struct Families<'a> {
    planned: &'a [PlannedFamily],
    /// Whether all of them could be read.
    are_complete: bool,
}

impl Families<'_> {
    /// Whether they could be read, and some of them are in a book.
    fn have_book(&self) -> bool {
        self.are_complete && self.planned.iter().any(|planned| planned.formats.contains(&Format::Pdf))
    }
}

/// Reads the tables of a list of tables, which are not too many; `None` if one cannot be read.
fn read_tables<'t, T>(
    fields: &Fields<'_, 't>,
    key: &str,
    read: impl Fn(&TomlValue<'t>, &mut TomlParser<'t>) -> Option<T>,
    parser: &mut TomlParser<'t>,
) -> Option<Vec<T>> {
    let tables = fields.tables(key, parser);
    report_repeated_titles(tables, key, parser);
    if let Some(first) = tables.get(MAX_TABLES) {
        let message = format!("there are {} tables `{key}`, more than the limit of {MAX_TABLES}", tables.len());
        parser.report(Problem::error(first.span(), message).with_help("leave some out"));
    }
    // All of them are read, so that all problems are reported.
    let read: Vec<Option<T>> = tables.iter().take(MAX_TABLES).map(|value| read(value, parser)).collect();
    read.into_iter().collect()
}

/// The most characters of a title and of a note: more would not fit the contents, or the head of a page.
const MAX_TITLE: usize = 120;
const MAX_NOTE: usize = 600;

/// The title of a chapter or a list, which is not blank.
fn title<'t>(fields: &Fields<'_, 't>, example: &str, parser: &mut TomlParser<'t>) -> Option<String> {
    let value = fields.required("title", example, parser)?;
    let title = short_text(value, MAX_TITLE, parser)?;
    if title.trim().is_empty() {
        let problem = Problem::error(value.span(), "the title is blank");
        parser.report(problem.with_help(format!("give one, as in {example}")));
        return None;
    }
    Some(title)
}

/// A text of at most a number of characters.
fn short_text<'t>(value: &TomlValue<'t>, most: usize, parser: &mut TomlParser<'t>) -> Option<String> {
    let text = parser.text(value)?;
    let count = text.chars().count();
    if count > most {
        let message = format!("the text has {count} characters, more than the limit of {most}");
        parser.report(Problem::error(value.span(), message).with_help("shorten it"));
        return None;
    }
    Some(text)
}

/// Reports tables with the title of one before them.
fn report_repeated_titles<'t>(tables: &[TomlValue<'t>], noun: &str, parser: &mut TomlParser<'t>) {
    let title_of = |table: &TomlValue<'t>| {
        let title = table.get_ref().as_table()?.get("title")?;
        Some((title.get_ref().as_str()?.to_owned(), title.span()))
    };
    let titles: Vec<_> = tables.iter().filter_map(title_of).collect();
    for (k, (title, span)) in titles.iter().enumerate() {
        if titles[..k].iter().any(|(earlier, _)| earlier == title) {
            let problem = Problem::error(span.clone(), format!("another {noun} has the title `{title}`"));
            parser.report(problem.with_help("give each a title of its own: contents and outline have no more"));
        }
    }
}

/// Warns of a table that applies to no family. An atlas without a book needs none.
fn warn_if_none_applies<'t, T>(
    found: &[Option<T>],
    noun: &str,
    value: &TomlValue<'t>,
    families: Families,
    parser: &mut TomlParser<'t>,
) {
    if found.iter().all(Option::is_none) && families.have_book() {
        let problem = Problem::warning(value.span(), format!("no family has curves and the measures of this {noun}"));
        parser.report(problem.with_help("name them in `measures` of a family, or leave its `measures` out"));
    }
}

/// The chapter of change points of coupler grids: their motion is not determined by their lengths.
fn change_points(families: &[PlannedFamily]) -> PlannedChapter {
    let condition = |planned: &PlannedFamily| {
        if planned.layout != Layout::CouplerGrid {
            return None;
        }
        let scope = scope(&planned.family);
        Expression::parse("is_change_point").ok()?.compile(&scope, Kind::Boolean).ok()
    };
    PlannedChapter {
        title: CHANGE_POINTS.to_owned(),
        conditions: families.iter().map(condition).collect(),
        is_given: false,
    }
}

/// The names that expressions about the curves of a family may use.
fn scope(family: &Family) -> Scope<'_> {
    Family::scope(&family.names, family.template.is_driven_by_length())
}

/// Whether a family computes all measures that an expression uses.
fn computes(family: &Family, expression: &CompiledExpression) -> bool {
    family.measures.contains_all(family.measures_in(expression))
}

/// A default list; `None` if no family has its measures.
fn default_list(default: &DefaultList, families: &[PlannedFamily]) -> Option<PlannedList> {
    let [filter, sort] = [default.filter, default.sort].map(Expression::parse);
    let (filter, sort) = (filter.ok()?, sort.ok()?);
    let criteria = |planned: &PlannedFamily| {
        let family = &planned.family;
        let scope = scope(family);
        let criteria = ListCriteria {
            filter: Some(filter.compile(&scope, Kind::Boolean).ok()?),
            sort: sort.compile(&scope, Kind::Number).ok()?,
            caption: Caption::parse(&default.caption.replace(OUTPUT_UNIT, &output_unit(planned))).ok()?,
            columns: default.columns.iter().map(|column| Caption::parse(column).ok()).collect::<Option<_>>()?,
        };
        applies(planned, &criteria).then_some(criteria)
    };
    let criteria: Vec<Option<ListCriteria>> = families.iter().map(criteria).collect();
    criteria.iter().any(Option::is_some).then(|| PlannedList {
        title: default.title.to_owned(),
        note: default.note.to_owned(),
        count: default.count,
        per_geometry: default.per_geometry,
        emphasis: emphasis_of(Some(&sort), Some(&filter)),
        columns: default.columns.iter().filter_map(|column| column_head(column)).collect(),
        criteria,
        is_given: false,
    })
}

/// Whether a family has curves on pages and the measures of a list.
fn applies(planned: &PlannedFamily, criteria: &ListCriteria) -> bool {
    let expressions = criteria.filter.iter().chain([&criteria.sort]);
    planned.chart.is_none() && { expressions }.all(|expression| computes(&planned.family, expression))
}

/// The compiled results of an expression for the families that have its names, and of which `applies` is true; reports the
/// problems of the first family if no family has them.
fn for_families<'t, T>(
    Families { planned: families, are_complete }: Families,
    parser: &mut TomlParser<'t>,
    knows_names: impl Fn(&Scope) -> bool,
    read: impl Fn(&Scope, &mut TomlParser<'t>) -> Option<T>,
    applies: impl Fn(&PlannedFamily, &T) -> bool,
) -> Option<Vec<Option<T>>> {
    let is_known: Vec<bool> = families.iter().map(|planned| knows_names(&scope(&planned.family))).collect();
    // Names that no family has are reported once, with those of the first.
    let is_unknown = !is_known.contains(&true);
    let first = usize::from(are_complete && is_unknown);
    if is_unknown && (!are_complete || families.is_empty()) {
        parser.with_unknown_names(|parser| read(&Family::scope(&[], false), parser))?;
    }
    let mut found = Vec::new();
    for (k, (planned, is_known)) in families.iter().zip(is_known).enumerate() {
        let read = if is_known || k < first { Some(read(&scope(&planned.family), parser)?) } else { None };
        found.push(read.filter(|read| applies(planned, read)));
    }
    Some(found)
}

/// The names of the expressions of a value, as far as they can be parsed.
fn names_in(value: Option<&TomlValue>) -> Vec<String> {
    let text = value.and_then(|value| value.get_ref().as_str());
    text.and_then(|text| Expression::parse(text).ok()).map(|parsed| parsed.names().to_vec()).unwrap_or_default()
}

fn chapter<'t>(value: &TomlValue<'t>, families: Families, parser: &mut TomlParser<'t>) -> Option<PlannedChapter> {
    let fields = Fields::from_value(value, &CHAPTER, parser)?;
    let title = title(&fields, "title = \"change points\"", parser);
    let condition = fields.required("where", "where = \"is_change_point\"", parser);
    let names = names_in(condition);
    let knows = |scope: &Scope| names.iter().all(|name| scope.index_of(name).is_some());
    let conditions = condition.and_then(|value| {
        let read = |scope: &Scope, parser: &mut TomlParser<'t>| read_filter(value, scope, parser);
        for_families(families, parser, knows, read, |planned, condition| {
            planned.chart.is_none() && computes(&planned.family, condition)
        })
    })?;
    warn_if_none_applies(&conditions, "chapter", value, families, parser);
    Some(PlannedChapter { title: title?, conditions, is_given: true })
}

/// The columns of a list that is a table, as far as they can be read, and their heads, if all is right; none of another.
fn columns<'v, 't>(fields: &Fields<'v, 't>, parser: &mut TomlParser<'t>) -> (&'v [TomlValue<'t>], Option<Vec<String>>) {
    let Some(value) = fields.get("columns") else { return (&[], Some(Vec::new())) };
    let Some(columns) = parser.list(value) else { return (&[], None) };
    let are_few = (1..=MAX_COLUMNS).contains(&columns.len());
    if !are_few {
        let message = format!("there are {} columns: expected 1 to {MAX_COLUMNS}", columns.len());
        parser.report(Problem::error(value.span(), message).with_help("leave some out, or leave `columns` out"));
    }
    let head = |column: &TomlValue<'t>| {
        let head = column_head(&short_text(column, MAX_TITLE, parser)?);
        if head.is_none() {
            let problem = Problem::error(column.span(), "this column has no head");
            parser.report(problem.with_help("write it before the value and a colon, as in \"length: {length:.2}\""));
        }
        head
    };
    let heads: Vec<Option<String>> = columns.iter().map(head).collect();
    if let Some(caption) = fields.get("caption") {
        let problem = Problem::error(caption.span(), "a list with `columns` is a table, which has no captions");
        parser.report(problem.with_help("leave out one of them"));
        return (columns, None);
    }
    (columns, heads.into_iter().collect::<Option<_>>().filter(|_| are_few))
}

/// The head of a column: the text before the first colon and space, without values.
fn column_head(column: &str) -> Option<String> {
    let (head, _) = column.split_once(": ")?;
    (!head.trim().is_empty() && !head.contains(['{', '}'])).then(|| head.to_owned())
}

fn list<'t>(value: &TomlValue<'t>, families: Families, parser: &mut TomlParser<'t>) -> Option<PlannedList> {
    let fields = Fields::from_value(value, &LIST, parser)?;
    let title = title(&fields, "title = \"Straight portions\"", parser);
    let note = fields.get("note").map_or(Some(String::new()), |value| short_text(value, MAX_NOTE, parser));
    let mut number =
        |key: &str, default: usize| fields.get(key).map_or(Some(default), |value| parser.integer(value, 1, MAX_COUNT));
    let (count, per_geometry) = (number("count", DEFAULT_COUNT), number("per_geometry", DEFAULT_PER_GEOMETRY));
    let sort = fields.required("sort", "sort = \"-straight_length\"", parser);
    let (filter, caption) = (fields.get("where"), fields.get("caption"));
    let (columns, heads) = columns(&fields, parser);
    let mut names = [filter, sort].map(names_in).concat();
    let parsed = |value: &TomlValue| Some(Caption::parse_partly(value.get_ref().as_str()?).0);
    let captions: Vec<Caption> = caption.into_iter().chain(columns).filter_map(parsed).collect();
    names
        .extend(captions.iter().flat_map(Caption::expressions).flat_map(|(expression, _)| expression.names().to_vec()));
    let words: Vec<&str> = Family::word_measure_names().collect();
    let knows =
        |scope: &Scope| names.iter().all(|name| words.contains(&name.as_str()) || scope.index_of(name).is_some());
    let sort = sort.filter(|value| !uses_text_measure(value, parser) && !states_direction(value, parser));
    let read = |scope: &Scope, parser: &mut TomlParser<'t>| {
        let filter = match filter {
            None => Some(None),
            Some(value) => read_filter(value, scope, parser).map(Some),
        };
        let sort = sort.and_then(|value| parser.numeric_expression(value, scope));
        let caption = match caption {
            None => Caption::parse("").ok(),
            Some(value) => parser.caption(value, scope, &words),
        };
        let columns: Vec<_> = columns.iter().map(|value| parser.caption(value, scope, &words)).collect();
        let columns = columns.into_iter().collect::<Option<_>>();
        Some(ListCriteria { filter: filter?, sort: sort?, caption: caption?, columns: columns? })
    };
    let criteria = for_families(families, parser, knows, read, applies)?;
    warn_if_none_applies(&criteria, "list", value, families, parser);
    let parsed = |value: &TomlValue| value.get_ref().as_str().and_then(|text| Expression::parse(text).ok());
    let emphasis = emphasis_of(sort.and_then(parsed).as_ref(), filter.and_then(parsed).as_ref());
    let (title, note, count, per_geometry, columns) = (title?, note?, count?, per_geometry?, heads?);
    Some(PlannedList { title, note, count, per_geometry, emphasis, columns, criteria, is_given: true })
}
