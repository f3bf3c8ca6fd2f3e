//! The keys of a manifest and of a `[[family]]`.

use super::chart::CHART;
use super::grid::VALUES_FORM;
use super::names::MAX_LIMIT;
use super::settings::{ATLAS, FORMATS, PAGE};
use super::tolerance::{CHECK, FAMILY_CHECK};
use coupler_curves::catalogue;
use coupler_curves::expression::Dimension;
use coupler_curves::family::{COLUMNS, Family, MAX_SAMPLES, MEASURES};
use coupler_curves::linkage_format::{
    CIRCUITS_KEY, COINCIDENT_KEY, CONTINUATION_KEY, KeySchema, LINKAGES_KEY, TableSchema, ValueSchema, words,
};
use coupler_drawing::page::Layout;

/// A manifest.
pub static MANIFEST: TableSchema = TableSchema::new(
    "a manifest",
    &[
        KeySchema::required("atlas", ValueSchema::Table(&ATLAS), "The atlas as a whole."),
        KeySchema::new("page", ValueSchema::Table(&PAGE), "What all its pages have in common.").with_default("{}"),
        KeySchema::new("check", ValueSchema::Table(&CHECK), "By how much families may differ from a recorded atlas.")
            .with_default("{}"),
        KeySchema::required(
            "family",
            ValueSchema::List(&ValueSchema::Table(&FAMILY), [1, usize::MAX]),
            "The families: each a linkage over a grid of parameters, or over cases.",
        ),
        LINKAGES_KEY,
    ],
);

/// A `[[family]]`.
pub(super) static FAMILY: TableSchema = TableSchema::new(
    "a [[family]]",
    &[
        KeySchema::required("id", ValueSchema::Slug, "Its name, that of its folder and its files."),
        KeySchema::required(
            "linkage",
            ValueSchema::WithExamples(&ValueSchema::Text, linkage_ids),
            "A linkage of the catalogue, or of this file.",
        ),
        KeySchema::new("title", ValueSchema::Text, "The title of its pages; its id where left out."),
        KeySchema::new("source", ValueSchema::Text, "The line under the title; that of the linkage where left out."),
        KeySchema::new("layout", ValueSchema::Word(|| words(&Layout::ALL)), "How its pages are laid out.")
            .with_default("\"panels\""),
        KeySchema::new("chart", ValueSchema::Table(&CHART), "What its charts show, where its layout is chart."),
        KeySchema::new(
            "panels",
            ValueSchema::List(&ValueSchema::Integer([1, usize::MAX]), [2, 2]),
            "The columns and rows of a page; 5 and 3, or as many as it has room for, where left out.",
        ),
        KeySchema::required("sampling", ValueSchema::Table(&SAMPLING), "How circuits are sampled."),
        KeySchema::new(
            "grid",
            ValueSchema::IdentifierMap(&VALUES_FORM),
            "The values of parameters, the last fastest: every one with every other.",
        ),
        KeySchema::new(
            "cases",
            ValueSchema::List(&ValueSchema::IdentifierMap(&ValueSchema::Number), [1, usize::MAX]),
            "The values of parameters, case by case.",
        ),
        KeySchema::new("let", ValueSchema::IdentifierMap(&ValueSchema::Number), "Values that are derived from others.")
            .with_default("{}"),
        KeySchema::new(
            "where",
            ValueSchema::Text,
            "Which curves are kept: a condition over names and measures, as in \"mu_min_deg > 20\".",
        ),
        KeySchema::new(
            "sort",
            ValueSchema::WithExamples(&ValueSchema::Number, numeric_measures),
            "The order on pages, least first: an expression over names and measures.",
        ),
        KeySchema::new(
            "caption",
            ValueSchema::Text,
            "The line under a cell, with values and measures in braces; the linkage's where left out.",
        ),
        KeySchema::new("note", ValueSchema::Text, "A second, smaller line, likewise."),
        FORMATS,
        KeySchema::new("limit", ValueSchema::Integer([1, MAX_LIMIT]), "The most cells it may have.")
            .with_default("100000"),
        CIRCUITS_KEY,
        CONTINUATION_KEY,
        COINCIDENT_KEY,
        KeySchema::new("place", ValueSchema::Table(&PLACE), "How its linkages are laid in the plane.")
            .with_default("{}"),
        KeySchema::new(
            "columns",
            ValueSchema::Set(&ValueSchema::Word(|| COLUMNS.map(|column| column.name).to_vec()), [0, usize::MAX]),
            "Further columns of its points.",
        )
        .with_default("[]"),
        KeySchema::new(
            "straight",
            ValueSchema::Table(&STRAIGHT),
            "Which portion is the straight one, by one of the three.",
        )
        .with_default("{ \"tolerance\": 0.001 }"),
        KeySchema::new(
            "measures",
            ValueSchema::Set(&ValueSchema::Word(|| MEASURES.map(|measure| measure.name).to_vec()), [0, usize::MAX]),
            "The measures that are taken of its curves; all where left out.",
        ),
        KeySchema::new("check", ValueSchema::Table(&FAMILY_CHECK), "By how much it may differ from a recorded atlas.")
            .with_default("{}"),
    ],
)
.with_one_of(&["grid", "cases"]);

fn linkage_ids() -> Vec<&'static str> {
    catalogue::all().iter().map(|template| template.id.as_str()).collect()
}

/// The measures that are numbers.
pub(super) fn numeric_measures() -> Vec<&'static str> {
    Family::numeric_measure_names().collect()
}

/// How the linkages of a family are laid.
pub(super) static PLACE: TableSchema = TableSchema::new(
    "`place`",
    &[
        KeySchema::new("mirror", ValueSchema::Boolean, "Whether they are mirrored about the x-axis.")
            .with_default("false"),
        KeySchema::new("rotate", ValueSchema::Quantity(Dimension::Angle), "How far they are then turned.")
            .with_default("\"0 deg\""),
    ],
);

/// How circuits are sampled.
pub(super) static SAMPLING: TableSchema = TableSchema::new(
    "`sampling`",
    &[
        KeySchema::new("step", ValueSchema::Input, "By every multiple of a step of the input, and at limits."),
        KeySchema::new(
            "samples",
            ValueSchema::Integer([2, MAX_SAMPLES]),
            "By a number of samples in the whole circuit.",
        ),
        KeySchema::new(
            "spacing",
            ValueSchema::Word(|| words(&SPACINGS)),
            "How a number of samples is spread: evenly, close at limits, or evenly along the path.",
        )
        .with_default("\"even\""),
    ],
)
.with_one_of(&["step", "samples"]);

/// How a number of samples is spread.
#[derive(Clone, Copy)]
pub(super) enum Spacing {
    Even,
    Smooth,
    Arc,
}

pub(super) const SPACINGS: [(&str, Spacing); 3] =
    [("even", Spacing::Even), ("smooth", Spacing::Smooth), ("arc", Spacing::Arc)];

/// A portion as straight as that is not told from one that is straighter still.
pub(super) const MIN_TOLERANCE: f64 = 1e-8;

/// What is asked of the straight portion.
pub(super) static STRAIGHT: TableSchema = TableSchema::new(
    "`straight`",
    &[
        KeySchema::new(
            "tolerance",
            ValueSchema::InRange([MIN_TOLERANCE, 1.0]),
            "The longest in a strip of so many times its length.",
        ),
        KeySchema::new("input", ValueSchema::Input, "The straightest that spans so much input."),
        KeySchema::new("length", ValueSchema::Positive, "The straightest that is so long."),
    ],
)
.with_one_of(&["tolerance", "input", "length"]);
