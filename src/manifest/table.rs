//! The keys of a manifest and of a `[[family]]`.

use super::chart::CHART;
use super::grid::VALUES;
use super::names::MAX_LIMIT;
use super::settings::{ATLAS, FORMATS, PAGE};
use super::tolerance::{CHECK, OWN_CHECK};
use coupler_curves::catalogue;
use coupler_curves::expression::Dimension;
use coupler_curves::family::{COLUMNS, Family, MAX_SAMPLES, MEASURES};
use coupler_curves::notation::{CIRCUITS_KEY, COINCIDENT_KEY, CONTINUATION_KEY, Form, Key, LINKAGES, Table, words};
use coupler_drawing::page::Layout;

/// A manifest.
pub static MANIFEST: Table = Table::new(
    "a manifest",
    &[
        Key::required("atlas", Form::Table(&ATLAS), "The atlas as a whole."),
        Key::new("page", Form::Table(&PAGE), "What all its pages have in common.").or("{}"),
        Key::new("check", Form::Table(&CHECK), "By how much families may differ from a recorded atlas.").or("{}"),
        Key::required(
            "family",
            Form::List(&Form::Table(&FAMILY), [1, usize::MAX]),
            "The families: each a linkage over a grid of parameters, or over cases.",
        ),
        LINKAGES,
    ],
);

/// A `[[family]]`.
pub(super) static FAMILY: Table = Table::new(
    "a [[family]]",
    &[
        Key::required("id", Form::Slug, "Its name, that of its folder and its files."),
        Key::required("linkage", Form::Like(&Form::Text, linkages), "A linkage of the catalogue, or of this file."),
        Key::new("title", Form::Text, "The title of its pages; its id where left out."),
        Key::new("source", Form::Text, "The line under the title; that of the linkage where left out."),
        Key::new("layout", Form::Word(|| words(&Layout::ALL)), "How its pages are laid out.").or("\"panels\""),
        Key::new("chart", Form::Table(&CHART), "What its charts show, where its layout is chart."),
        Key::new(
            "panels",
            Form::List(&Form::Count([1, usize::MAX]), [2, 2]),
            "The columns and rows of a page; 5 and 3, or as many as it has room for, where left out.",
        ),
        Key::required("sampling", Form::Table(&SAMPLING), "How circuits are sampled."),
        Key::new(
            "grid",
            Form::Names(&VALUES),
            "The values of parameters, the last fastest: every one with every other.",
        ),
        Key::new(
            "cases",
            Form::List(&Form::Names(&Form::Number), [1, usize::MAX]),
            "The values of parameters, case by case.",
        ),
        Key::new("let", Form::Names(&Form::Number), "Values that are derived from others.").or("{}"),
        Key::new(
            "where",
            Form::Text,
            "Which curves are kept: a condition over names and measures, as in \"mu_min_deg > 20\".",
        ),
        Key::new(
            "sort",
            Form::Like(&Form::Number, measures),
            "The order on pages, least first: an expression over names and measures.",
        ),
        Key::new(
            "caption",
            Form::Text,
            "The line under a cell, with values and measures in braces; the linkage's where left out.",
        ),
        Key::new("note", Form::Text, "A second, smaller line, likewise."),
        FORMATS,
        Key::new("limit", Form::Count([1, MAX_LIMIT]), "The most cells it may have.").or("100000"),
        CIRCUITS_KEY,
        CONTINUATION_KEY,
        COINCIDENT_KEY,
        Key::new("place", Form::Table(&PLACE), "How its linkages are laid in the plane.").or("{}"),
        Key::new(
            "columns",
            Form::Set(&Form::Word(|| COLUMNS.map(|column| column.name).to_vec()), [0, usize::MAX]),
            "Further columns of its points.",
        )
        .or("[]"),
        Key::new("straight", Form::Table(&STRAIGHT), "Which portion is the straight one, by one of the three.")
            .or("{ \"tolerance\": 0.001 }"),
        Key::new(
            "measures",
            Form::Set(&Form::Word(|| MEASURES.map(|measure| measure.name).to_vec()), [0, usize::MAX]),
            "The measures that are taken of its curves; all where left out.",
        ),
        Key::new("check", Form::Table(&OWN_CHECK), "By how much it may differ from a recorded atlas.").or("{}"),
    ],
)
.with_one_of(&["grid", "cases"]);

fn linkages() -> Vec<&'static str> {
    catalogue::all().iter().map(|template| template.id.as_str()).collect()
}

/// The measures that are numbers.
pub(super) fn measures() -> Vec<&'static str> {
    Family::measures().collect()
}

/// How the linkages of a family are laid.
pub(super) static PLACE: Table = Table::new(
    "`place`",
    &[
        Key::new("mirror", Form::Truth, "Whether they are mirrored about the x-axis.").or("false"),
        Key::new("rotate", Form::Quantity(Dimension::Angle), "How far they are then turned.").or("\"0 deg\""),
    ],
);

/// How circuits are sampled.
pub(super) static SAMPLING: Table = Table::new(
    "`sampling`",
    &[
        Key::new("step", Form::Input, "By every multiple of a step of the input, and at limits."),
        Key::new("samples", Form::Count([2, MAX_SAMPLES]), "By a number of samples in the whole circuit."),
        Key::new(
            "spacing",
            Form::Word(|| words(&SPACINGS)),
            "How a number of samples is spread: evenly, close at limits, or evenly along the path.",
        )
        .or("\"even\""),
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
pub(super) const LEAST_TOLERANCE: f64 = 1e-8;

/// What is asked of the straight portion.
pub(super) static STRAIGHT: Table = Table::new(
    "`straight`",
    &[
        Key::new(
            "tolerance",
            Form::Within([LEAST_TOLERANCE, 1.0]),
            "The longest in a strip of so many times its length.",
        ),
        Key::new("input", Form::Input, "The straightest that spans so much input."),
        Key::new("length", Form::Positive, "The straightest that is so long."),
    ],
)
.with_one_of(&["tolerance", "input", "length"]);
