//! Reads a `[[family]]` table.

use std::sync::Arc;

use crate::cells::{self, AtlasTotals, Purpose};
use crate::files::FileReader;
use crate::inputs::ManifestInputs;
use crate::name_list::name_indices;
use crate::names::read_names;
use crate::plan::{CaseFile, PlannedFamily};
use crate::schema::{
    DEFAULT_PLACE, FAMILY, MIN_TOLERANCE, PLACE, SAMPLING, SPACINGS, STRAIGHT, Spacing, default_sampling,
};
use crate::templates::Templates;
use crate::{applicability, chart, dwell, layout, settings, tolerance};
use coupler_curves::expression::{Caption, Dimension, Expression, Scope};
use coupler_curves::family::{COLUMNS, Column, Family, LengthUnit, MAX_SAMPLES, MEASURES, Sampling, StraightCriterion};
use coupler_curves::linkage_format::{self, Fields, TomlParser, TomlValue};
use coupler_curves::measure::MeasureSet;
use coupler_curves::problem::Problem;
use coupler_curves::template::{Orientation, Template};
use coupler_drawing::page::{Layout, Options};
use coupler_drawing::render::Format;

/// What families share.
pub(crate) struct Context<'a> {
    /// The linkages that they may name.
    pub templates: &'a Templates,
    /// The formats of the atlas.
    pub formats: &'a [Format],
    /// The formats that they may name.
    pub writable: &'a [Format],
    /// The title of a family that has none of its own; its id if there is no such title.
    pub default_title: Option<&'a str>,
    /// The unit of lengths of a family that has none of its own.
    pub unit: Option<LengthUnit>,
    /// The options of pages; `None` if `[page]` could not be parsed.
    pub page: Option<&'a Options>,
    /// What the cells are for.
    pub purpose: Purpose<'a>,
    /// What reads the files that they name.
    pub files: FileReader<'a>,
}

/// Reads a family, and adds it to `totals`.
pub(crate) fn read<'t>(
    value: &TomlValue<'t>,
    Context { templates, formats, writable, default_title, unit, page, purpose, files }: Context,
    totals: &mut AtlasTotals,
    parser: &mut TomlParser<'t>,
) -> Option<PlannedFamily> {
    let before = parser.problem_count();
    let fields = Fields::from_value(value, &FAMILY, parser)?;
    let id =
        fields.required("id", "id = \"evans\"", parser).and_then(|value| linkage_format::parse_slug(value, parser));
    let template =
        fields.required("linkage", "linkage = \"evans\"", parser).and_then(|value| templates.find(value, parser));
    let template = apply_overrides(template, &fields, parser);
    let text = |key: &str, parser: &mut TomlParser<'t>| fields.get(key).and_then(|value| parser.text(value));
    let (title, source) = (text("title", parser), text("source", parser));
    let formats = match fields.get("formats") {
        None => Some(formats.to_vec()),
        Some(value) => settings::formats(value, writable, parser),
    };
    let sampling = match (fields.get("sampling"), &template) {
        (Some(value), _) => sampling(value, template.as_deref(), parser),
        (None, template) => template.as_ref().map(|template| default_sampling(template.is_driven_by_length())),
    };
    let columns = fields.get("columns").map_or(Some(Vec::new()), |value| columns(value, parser));
    let straight = match fields.get("straight") {
        None => Some(StraightCriterion::default()),
        Some(value) => straight(value, template.as_deref(), parser),
    };
    let is_driven_by_length = template.as_ref().map(|template| template.is_driven_by_length());
    let measures = match fields.get("measures") {
        None => Some(MeasureSet::ALL),
        Some(value) => measures(value, is_driven_by_length, parser),
    };
    if let Some(template) = &template {
        applicability::check(template, &fields, parser);
    }
    let tolerances = tolerance::read(fields.get("check"), &tolerance::FAMILY_CHECK, parser);
    let parameters = template.as_ref().map_or(0, |template| template.parameters.len());
    if !totals.add_names(parameters, &fields, parser) {
        return None;
    }
    let names = read_names(template.as_deref(), &fields, files, parser);
    let chart = match fields.get("chart") {
        None => Some(None),
        Some(value) => chart::read(value, template.as_deref().zip(names.as_ref()), parser).map(Some),
    };
    let charts = chart.as_ref().and_then(Option::as_ref).map_or(1, |chart| chart.y.len());
    let layout = layout::read(&fields, page, charts, parser);
    let unit = fields.get("unit").map_or(Some(unit), |value| parser.word(value, &LengthUnit::ALL).map(Some));
    let scale = layout::panel_scale(&fields, layout, unit, parser);
    let ghosts = layout::ghosts(&fields, layout, parser);
    let poses = layout::poses(&fields, layout, parser);
    // The cells are checked also if other keys cannot be read.
    let (template, names) = (template?, names?);
    let are_settings_read = straight.is_some() && unit.is_some() && measures.is_some();
    let is_sampling_read = sampling.is_some() && columns.is_some();
    let default_sampling = default_sampling(template.is_driven_by_length());
    let id_or_empty = id.clone().unwrap_or_default();
    let mut family = Family {
        title: title.unwrap_or_else(|| default_title.unwrap_or(&id_or_empty).to_owned()),
        id: id_or_empty,
        template,
        unit: unit.unwrap_or_default(),
        names: names.all,
        space: names.space,
        derived: names.derived,
        sampling: sampling.unwrap_or(default_sampling),
        columns: columns.unwrap_or_default(),
        straight: straight.unwrap_or_default(),
        measures: measures.unwrap_or(MeasureSet::ALL),
        filter: names.filter,
        sort: names.sort,
        captions: names.captions,
    };
    let automatic_caption = family.automatic_caption().filter(|_| family.captions[0].is_none());
    family.captions[0] = family.captions[0].take().or_else(|| Caption::parse(automatic_caption.as_ref()?).ok());
    // A measure that an expression uses is computed, even if `measures` does not name it.
    let quantities = chart.iter().flatten().flat_map(|chart| std::iter::once(&chart.x).chain(&chart.y));
    let charted = quantities.fold(MeasureSet::EMPTY, |set, quantity| set | family.measures_in(&quantity.expression));
    family.measures |= family.selection_measures() | family.caption_measures() | charted;
    let count = family.cell_count();
    let checked = match purpose {
        Purpose::Pages if !totals.add_cells(&family, &fields, parser) => return None,
        Purpose::Pages => 0..count,
        Purpose::Tables(range) => range(&family),
    };
    if !parser.has_syntax_error() {
        let given = cells::GivenNames {
            spans: &names.spans,
            misspelt: &names.misspelt,
            unread: &names.unread,
            table: names.table.as_ref(),
        };
        cells::check(&family, checked, &fields, given, parser.problem_count() > before, parser);
    }
    (names.is_complete && id.is_some() && are_settings_read && is_sampling_read).then_some(())?;
    let source = source.unwrap_or_else(|| family.template.source_line());
    let [filter_span, scale_span] = ["where", "scale"].map(|key| fields.get(key).map(TomlValue::span));
    let sort = fields.get("sort").and_then(|value| value.get_ref().as_str()).map(str::to_owned);
    let (layout, chart, formats) = (layout?, chart?, formats?);
    let has_pages = matches!(purpose, Purpose::Pages);
    let inputs = ManifestInputs::default();
    let mut planned = PlannedFamily {
        family,
        layout,
        scale: scale?,
        ghosts: ghosts?,
        poses: poses?,
        chart,
        formats,
        source,
        automatic_caption,
        sort,
        case_file: names.table.map(|table| CaseFile { path: table.path, digest: table.digest }),
        manifest_inputs: inputs,
        tolerances,
        span: value.span(),
        filter_span,
        scale_span,
    };
    if let (true, Layout::Panels { .. }, None, Some(page)) = (has_pages, planned.layout, fields.get("panels"), page) {
        planned.layout = planned.usual_layout(page);
    }
    cells::check_memory(&planned.family, has_pages.then_some(planned.layout), &fields, parser);
    if has_pages {
        totals.add_page_files(&planned, &fields, parser);
    }
    Some(planned)
}

/// The template, if it is known, with the family's settings in place of its own.
fn apply_overrides<'t>(
    template: Option<Arc<Template>>,
    fields: &Fields<'_, 't>,
    parser: &mut TomlParser<'t>,
) -> Option<Arc<Template>> {
    let known = template.as_deref();
    let circuits = fields.get("circuits").and_then(|value| parser.word(value, &linkage_format::CIRCUIT_SELECTIONS));
    let continuation = fields.get("continuation").and_then(|value| parser.word(value, &linkage_format::CONTINUATIONS));
    let coincident = fields.get("coincident").and_then(|value| parser.word(value, &linkage_format::COINCIDENT_DYADS));
    let placement = fields.get("place").and_then(|value| placement(value, parser));
    let load = fields
        .get("load")
        .and_then(|value| linkage_format::parse_load(value, known.map(|known| &known.joints[..]), parser));
    let tolerance = fields.get("tolerance").and_then(|value| linkage_format::parse_tolerance(value, known, parser));
    let dwell = fields.get("dwell").and_then(|value| dwell::read(value, known, parser));
    let traced = fields.get("trace").and_then(|value| traced_joints(value, known, parser));
    let template = template?;
    let has_settings = traced.is_some() || circuits.is_some() || continuation.is_some() || coincident.is_some();
    if !has_settings && placement.is_none() && load.is_none() && tolerance.is_none() && dwell.is_none() {
        return Some(template);
    }
    let mut changed = Template::clone(&template);
    changed.circuits = circuits.unwrap_or(changed.circuits);
    changed.continuation = continuation.unwrap_or(changed.continuation);
    changed.coincident = coincident.unwrap_or(changed.coincident);
    changed.orientation = placement.unwrap_or(changed.orientation);
    changed.traced = traced.unwrap_or(changed.traced);
    changed.load = load.or(changed.load);
    changed.tolerance = tolerance.or(changed.tolerance);
    changed.dwell = dwell.unwrap_or(changed.dwell);
    Some(Arc::new(changed))
}

/// Reads the joints whose curves are traced, as their indices among those of the linkage, if it is known.
fn traced_joints<'t>(
    value: &TomlValue<'t>,
    template: Option<&Template>,
    parser: &mut TomlParser<'t>,
) -> Option<Vec<usize>> {
    let known = template.map(|template| template.joints.iter().map(|joint| joint.name.as_str()).collect::<Vec<_>>());
    let traced = name_indices(value, "joint", known.as_deref(), parser)?;
    if traced.is_empty() {
        let problem = Problem::error(value.span(), "no joint is traced");
        parser.report(problem.with_help("name at least one, as in [\"M\"], or leave `trace` out"));
        return None;
    }
    Some(traced)
}

/// Reads how the linkages of a family are placed in the plane.
fn placement<'t>(value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> Option<Orientation> {
    let fields = Fields::from_value(value, &PLACE, parser)?;
    let mirror = fields.get("mirror").map_or(Some(DEFAULT_PLACE.0), |value| parser.boolean(value));
    let rotate =
        fields.get("rotate").map_or(Some(DEFAULT_PLACE.1), |value| parser.constant_quantity(value, Dimension::Angle));
    Some(Orientation::new(mirror?, rotate?))
}

/// Reads how circuits are sampled.
fn sampling<'t>(value: &TomlValue<'t>, template: Option<&Template>, parser: &mut TomlParser<'t>) -> Option<Sampling> {
    let fields = Fields::from_value(value, &SAMPLING, parser)?;
    let spacing = fields.get("spacing").map_or(Some(Spacing::default()), |value| parser.word(value, &SPACINGS));
    if let (Some(_), Some(value)) = (fields.get("step"), fields.get("spacing")) {
        let problem = Problem::error(value.span(), "`spacing` cannot be combined with `step`");
        parser.report(problem.with_help("write { samples = 180, spacing = \"smooth\" }"));
    }
    match (fields.get("step"), fields.get("samples")) {
        // If the linkage could not be parsed, its input may be an angle or a length.
        (Some(value), None)
            if template.is_none()
                && value.get_ref().as_str().is_none_or(|text| Expression::evaluate_constant(text).is_ok()) =>
        {
            None
        }
        (Some(value), None) if template.is_some_and(Template::is_driven_by_length) => {
            let step = parser.input_length(value, &Scope::default())?.evaluate(|_| f64::NAN);
            let step = parser.require_finite(value, step)?;
            if step > 0.0 {
                return Some(Sampling::Step(step));
            }
            let problem = Problem::error(value.span(), format!("`step` must be greater than 0, found {step}"));
            parser.report(problem.with_help("give a length greater than 0, as in step = 0.05"));
            None
        }
        (Some(value), None) => {
            let step = parser.constant_quantity(value, Dimension::Angle)?;
            let least = 360.0 / MAX_SAMPLES as f64;
            let problem = match step {
                0.0 => Problem::error(value.span(), "`step` must not be 0"),
                step if step < least || step > 360.0 => {
                    Problem::error(value.span(), format!("a step of {step} deg is out of range"))
                }
                _ => return Some(Sampling::Step(step)),
            };
            parser.report(problem.with_help(format!("give {least} to 360 deg, as in step = \"2 deg\"")));
            None
        }
        (None, Some(value)) => parser.integer(value, 2, MAX_SAMPLES).zip(spacing).map(|(n, spacing)| match spacing {
            Spacing::Even => Sampling::Samples(n),
            Spacing::Smooth => Sampling::DenseAtLimits(n),
            Spacing::Arc => Sampling::ArcLength(n),
        }),
        (step, _) => {
            let message = if step.is_some() {
                "sampling is by step or by samples, not both"
            } else {
                "sampling needs a step or a number of samples"
            };
            let step = if template.is_some_and(Template::is_driven_by_length) { "0.05" } else { "\"2 deg\"" };
            let help = format!("write {{ step = {step} }} or {{ samples = 180 }}");
            parser.report(Problem::error(value.span(), message).with_help(help));
            None
        }
    }
}

/// Reads the criterion for the straight portion.
fn straight<'t>(
    value: &TomlValue<'t>,
    template: Option<&Template>,
    parser: &mut TomlParser<'t>,
) -> Option<StraightCriterion> {
    let fields = Fields::from_value(value, &STRAIGHT, parser)?;
    let is_driven_by_length = template.is_some_and(Template::is_driven_by_length);
    let given: Vec<&str> = STRAIGHT.key_names().into_iter().filter(|key| fields.get(key).is_some()).collect();
    let [key] = given[..] else {
        let problem = Problem::error(value.span(), "`straight` takes exactly one of `tolerance`, `input` and `length`");
        let input = if is_driven_by_length { "0.5" } else { "\"120 deg\"" };
        let help = format!("write {{ tolerance = 0.001 }}, {{ input = {input} }} or {{ length = 2 }}");
        parser.report(problem.with_help(help));
        return None;
    };
    let value = fields.get(key)?;
    let number = match key {
        // If the linkage could not be parsed, its input may be an angle or a length.
        "input" if template.is_none() => return None,
        "input" if is_driven_by_length => {
            let length = parser.input_length(value, &Scope::default())?.evaluate(|_| f64::NAN);
            parser.require_finite(value, length)?
        }
        "input" => parser.constant_quantity(value, Dimension::Angle)?,
        _ => parser.constant(value)?,
    };
    let least = if key == "tolerance" { MIN_TOLERANCE } else { 0.0 };
    let (most, straight) = match key {
        "tolerance" => (1.0, StraightCriterion::Tolerance(number)),
        "input" if !is_driven_by_length => (720.0, StraightCriterion::Input(number)),
        "input" => (f64::INFINITY, StraightCriterion::Input(number)),
        _ => (f64::INFINITY, StraightCriterion::Length(number)),
    };
    if number > 0.0 && number >= least && number <= most {
        return Some(straight);
    }
    let problem = Problem::error(value.span(), format!("`{key}` is {number}, which is out of range"));
    let range = match most {
        _ if least > 0.0 => format!("give {least} to {most}"),
        most if most.is_finite() => format!("give an angle greater than 0, at most {most} deg"),
        _ => "give a number greater than 0".to_owned(),
    };
    parser.report(problem.with_help(range));
    None
}

/// Reads the additional columns of `points.csv`.
fn columns<'t>(value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> Option<Vec<Column>> {
    let places = name_indices(value, "column", Some(&COLUMNS.map(|column| column.name)), parser)?;
    Some(places.into_iter().map(|place| COLUMNS[place]).collect())
}

/// Reads which measures are named, in the order of [`MEASURES`], of a linkage driven by a length or an angle; `None` if
/// it is not known which.
fn measures<'t>(
    value: &TomlValue<'t>,
    is_driven_by_length: Option<bool>,
    parser: &mut TomlParser<'t>,
) -> Option<MeasureSet> {
    let names = |is_driven_by_length: bool| MEASURES.iter().map(move |measure| measure.name_for(is_driven_by_length));
    let mut known: Vec<&str> = names(is_driven_by_length.unwrap_or(false)).collect();
    if is_driven_by_length.is_none() {
        known.extend(names(true));
    }
    // Names beyond those of an angle are the same measures again.
    let places = name_indices(value, "measure", Some(&known), parser)?;
    Some(places.into_iter().filter(|place| *place < MEASURES.len()).collect())
}
