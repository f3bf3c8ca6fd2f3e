//! The keys of a manifest and of its `[[family]]` tables.

use crate::book::BOOK;
use crate::chart::{CHART, measure_names, numeric_measures};
use crate::default_value;
use crate::design::DESIGN;
use crate::dwell::{self, DWELL};
use crate::grid::VALUES_FORM;
use crate::parameter_sets::MAX_LIMIT;
use crate::settings::{ATLAS, FORMATS, PAGE, UNIT};
use crate::tolerance::{CHECK, FAMILY_CHECK};
use coupler_curves::catalogue;
use coupler_curves::expression::Dimension;
use coupler_curves::family::{COLUMNS, MAX_CELLS, MAX_SAMPLES, Sampling, StraightCriterion};
use coupler_curves::linkage_format::{
    CIRCUITS_KEY, COINCIDENT_KEY, CONTINUATION_KEY, KeySchema, LINKAGES_KEY, LOAD_KEY, TOLERANCE_KEY, TableSchema,
    ValueSchema, words,
};
use coupler_drawing::page::{Layout, PanelScale};

/// The root of a manifest.
pub static MANIFEST: TableSchema = TableSchema::new(
    "a manifest",
    &[
        KeySchema::required("atlas", ValueSchema::Table(&ATLAS), "The atlas as a whole."),
        KeySchema::new("page", ValueSchema::Table(&PAGE), "The options that all pages share.")
            .with_default(default_value::empty_table),
        KeySchema::new("check", ValueSchema::Table(&CHECK), "How much families may differ from a recorded atlas.")
            .with_default(default_value::empty_table),
        KeySchema::required(
            "family",
            ValueSchema::List(&ValueSchema::Table(&FAMILY), [1, usize::MAX]),
            "The families: each a linkage over a grid of parameters, or over cases.",
        ),
        LINKAGES_KEY,
        KeySchema::new(
            "book",
            ValueSchema::Table(&BOOK),
            "What the book has in addition to the pages of its families.",
        )
        .with_default(default_value::empty_table),
    ],
);

/// The `[[family]]` table.
pub(crate) static FAMILY: TableSchema = TableSchema::new(
    "a [[family]]",
    &[
        KeySchema::required("id", ValueSchema::Slug, "Its name, also that of its folder and its files."),
        KeySchema::required(
            "linkage",
            ValueSchema::WithExamples(&ValueSchema::Text, linkage_ids),
            "A linkage of the catalogue, or of this file.",
        ),
        KeySchema::new("title", ValueSchema::Text, "The title of its pages; by default that of the atlas if it is the only family, and otherwise its id."),
        UNIT,
        KeySchema::new("source", ValueSchema::Text, "The line under the title; that of the linkage by default."),
        KeySchema::new("layout", ValueSchema::Word(|| words(&Layout::ALL)), "How its pages are laid out.")
            .with_default(|| default_value::string(DEFAULT_LAYOUT)),
        KeySchema::new("chart", ValueSchema::Table(&CHART), "What its charts show, if its layout is `chart`."),
        KeySchema::new(
            "panels",
            ValueSchema::List(&ValueSchema::Integer([1, usize::MAX]), [2, 2]),
            "The columns and rows of a page; by default as many as make the cells large, some 15 at most.",
        ),
        KeySchema::new(
            "scale",
            ValueSchema::AnyOf(&[
                ValueSchema::Word(|| words(&PANEL_SCALES)),
                ValueSchema::Quantity(Dimension::PaperLength),
                ValueSchema::WithExamples(&ValueSchema::Ratio, || vec!["1:1", "1:2", "2:1"]),
            ]),
            "The scale of the linkages on pages of panels: each as large as its panel, all of a page alike, the length of a unit on paper, or, of lengths with a unit, that on paper to that of the linkage.",
        )
        .with_default(|| default_value::string("panel")),
        KeySchema::new(
            "ghosts",
            ValueSchema::Boolean,
            "Whether pages of panels show the linkages in fine lines at the limits of their input, or else of their output.",
        )
        .with_default(|| "false".to_owned()),
        KeySchema::new(
            "poses",
            ValueSchema::List(&ValueSchema::List(&ValueSchema::Number, [3, 3]), [1, MAX_POSES]),
            "Poses of a body that its linkages are to guide, drawn on pages of panels and of poses: each x, y and the angle in degrees.",
        ),
        KeySchema::new(
            "sampling",
            ValueSchema::Table(&SAMPLING),
            "How circuits are sampled; by default in steps of 2 deg, or at 180 samples if an actuator drives the linkage.",
        )
        .with_default(default_sampling_text),
        KeySchema::new(
            "grid",
            ValueSchema::IdentifierMap(&VALUES_FORM),
            "The values of parameters in all combinations, the last varying fastest.",
        ),
        KeySchema::new(
            "cases",
            ValueSchema::AnyOf(&[
                ValueSchema::List(&ValueSchema::IdentifierMap(&ValueSchema::Number), [1, usize::MAX]),
                ValueSchema::Text,
            ]),
            "The values of parameters, case by case; or a table in CSV with a row for each case, relative to the manifest's folder.",
        ),
        KeySchema::new(
            "design",
            ValueSchema::Table(&DESIGN),
            "Wishes on measures and parameters: the cases are the linkages that a search finds for them, the best first.",
        ),
        KeySchema::new("let", ValueSchema::IdentifierMap(&ValueSchema::Number), "Values that are derived from others.")
            .with_default(default_value::empty_table),
        KeySchema::new(
            "where",
            ValueSchema::Text,
            "The curves that are kept: a condition over names and measures, as in \"mu_min_deg > 20\".",
        ),
        KeySchema::new(
            "sort",
            ValueSchema::WithExamples(&ValueSchema::Number, numeric_measures),
            "The order on pages, least first: an expression over names and measures.",
        ),
        KeySchema::new(
            "caption",
            ValueSchema::Text,
            "The line under a cell, with values and measures in braces; that of the linkage by default.",
        ),
        KeySchema::new("note", ValueSchema::Text, "A second, smaller line under a cell."),
        FORMATS,
        KeySchema::new("limit", ValueSchema::Integer([1, MAX_LIMIT]), "The most cells it may have.")
            .with_default(|| MAX_CELLS.to_string()),
        CIRCUITS_KEY,
        CONTINUATION_KEY,
        COINCIDENT_KEY,
        KeySchema::new(
            "trace",
            ValueSchema::Set(&ValueSchema::Text, [1, usize::MAX]),
            "The joints whose curves are traced; those of the linkage by default.",
        ),
        KeySchema::new("place", ValueSchema::Table(&PLACE), "How its linkages are placed in the plane.")
            .with_default(default_value::empty_table),
        LOAD_KEY,
        TOLERANCE_KEY,
        KeySchema::new(
            "columns",
            ValueSchema::Set(&ValueSchema::Word(|| COLUMNS.map(|column| column.name).to_vec()), [0, usize::MAX]),
            "Additional columns of its points.",
        )
        .with_default(default_value::empty_list),
        KeySchema::new(
            "straight",
            ValueSchema::Table(&STRAIGHT),
            "The criterion for the straight portion, one of three.",
        )
        .with_default(default_straight),
        KeySchema::new(
            "dwell",
            ValueSchema::Table(&DWELL),
            "The width of the band within which the output dwells, one of three.",
        )
        .with_default(dwell::default_text),
        KeySchema::new(
            "measures",
            ValueSchema::Set(&ValueSchema::Word(|| measure_names(|_| true)), [0, usize::MAX]),
            "The measures computed for its curves; all by default.",
        ),
        KeySchema::new("check", ValueSchema::Table(&FAMILY_CHECK), "How much it may differ from a recorded atlas.")
            .with_default(default_value::empty_table),
    ],
)
.with_one_of(&["grid", "cases", "design"])
.with_other_names("a parameter of the linkage is given in `grid`, `cases` or `let`, as in let = { crank = 2 }; ");

fn linkage_ids() -> Vec<&'static str> {
    catalogue::all().iter().map(|template| template.id.as_str()).collect()
}

/// How circuits are sampled by default.
pub(crate) fn default_sampling(is_driven_by_length: bool) -> Sampling {
    if is_driven_by_length { Sampling::Samples(180) } else { Sampling::Step(DEFAULT_STEP) }
}

/// The default input between samples, in degrees.
const DEFAULT_STEP: f64 = 2.0;

/// That for an angle, as JSON.
fn default_sampling_text() -> String {
    format!("{{ \"step\": {} }}", default_value::degrees(DEFAULT_STEP))
}

/// The default straight criterion, as JSON.
fn default_straight() -> String {
    let (key, value) = match StraightCriterion::default() {
        StraightCriterion::Tolerance(value) => ("tolerance", value),
        StraightCriterion::Input(value) => ("input", value),
        StraightCriterion::Length(value) => ("length", value),
    };
    format!("{{ \"{key}\": {value} }}")
}

/// The most poses of a body: as many as linkages are searched for.
pub(crate) const MAX_POSES: usize = 1000;

/// The words for the scale of linkages on pages of panels.
pub(crate) const PANEL_SCALES: [(&str, PanelScale); 2] = [("panel", PanelScale::Panel), ("page", PanelScale::Page)];

/// The default layout.
pub(crate) const DEFAULT_LAYOUT: &str = "panels";

/// The default placement: whether linkages are mirrored, and how far they are turned, in degrees.
pub(crate) const DEFAULT_PLACE: (bool, f64) = (false, 0.0);

/// The `place` table: how linkages are placed in the plane.
pub(crate) static PLACE: TableSchema = TableSchema::new(
    "`place`",
    &[
        KeySchema::new("mirror", ValueSchema::Boolean, "Whether they are mirrored about the x-axis.")
            .with_default(|| DEFAULT_PLACE.0.to_string()),
        KeySchema::new("rotate", ValueSchema::Quantity(Dimension::Angle), "The angle by which they are then rotated.")
            .with_default(|| default_value::degrees(DEFAULT_PLACE.1)),
    ],
);

/// The `sampling` table.
pub(crate) static SAMPLING: TableSchema = TableSchema::new(
    "`sampling`",
    &[
        KeySchema::new("step", ValueSchema::Input, "At every multiple of a step of the input, and at limits."),
        KeySchema::new("samples", ValueSchema::Integer([2, MAX_SAMPLES]), "A number of samples in the whole circuit."),
        KeySchema::new(
            "spacing",
            ValueSchema::Word(|| words(&SPACINGS)),
            "How a number of samples is distributed: evenly, densely at limits, or evenly along the path.",
        )
        .with_default(|| default_value::word(&SPACINGS, &Spacing::default())),
    ],
)
.with_one_of(&["step", "samples"]);

/// How a given number of samples is distributed over a circuit.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub(crate) enum Spacing {
    /// Evenly in the input.
    #[default]
    Even,
    /// Densely at limits.
    Smooth,
    /// Evenly along the path.
    Arc,
}

/// The words for spacings.
pub(crate) const SPACINGS: [(&str, Spacing); 3] =
    [("even", Spacing::Even), ("smooth", Spacing::Smooth), ("arc", Spacing::Arc)];

/// The least tolerance of a straight portion; portions straighter than this cannot be told apart.
pub(crate) const MIN_TOLERANCE: f64 = 1e-8;

/// The `straight` table: the criterion for the straight portion.
pub(crate) static STRAIGHT: TableSchema = TableSchema::new(
    "`straight`",
    &[
        KeySchema::new(
            "tolerance",
            ValueSchema::InRange([MIN_TOLERANCE, 1.0]),
            "The longest portion in a strip whose width is this fraction of its length.",
        ),
        KeySchema::new("input", ValueSchema::Input, "The straightest portion that spans this range of the input."),
        KeySchema::new("length", ValueSchema::Positive, "The straightest portion of this length."),
    ],
)
.with_one_of(&["tolerance", "input", "length"]);
