//! Parses manifests of atlases: TOML that names families of planar linkages and says how they are drawn.
//!
//! [`parse`] turns a text into a validated [`Plan`], or reports every problem in it with its place and a remedy. It uses
//! no files, threads or clocks, and what it returns depends on the text alone; [`parse_with_files`] has the files that the manifest
//! may name read, the font file of a theme and tables of cases, and the linkages searched that it wishes.
//!
//! ```
//! let text = r#"
//!     [atlas]
//!     title = "Straight lines"
//!
//!     [[family]]
//!     id = "hoeken"
//!     linkage = "hoeken"
//!     sampling = { samples = 180 }
//!     grid = { a = [1, 2] }
//! "#;
//! let outcome = coupler_manifest::parse(text);
//! let plan = outcome.plan.expect("a manifest without errors");
//! assert_eq!(plan.families[0].family.cell_count(), 2);
//! ```

mod applicability;
mod bounded_number;
mod default_value;
mod dwell;
mod format_version;
mod inputs;
mod name_list;
mod tolerance;

mod wishes;

mod files;

mod theme;

mod undrawable;

mod settings;

mod grid;

mod design;
mod parameter_sets;
mod unused_names;

mod names;

mod chart;

mod plan;

mod book;

mod schema;

mod cells;
mod layout;
mod templates;

mod family;

mod document;

pub use cells::MAX_PAGE_FILES;
pub use document::{
    MAX_MANIFEST_BYTES, ParseOutcome, linkage_text, parse, parse_for_formats, parse_for_tables, parse_linkages,
    parse_with_files,
};
pub use files::{CaseTable, FileProblem, FileReader, Files, RowPlaces};
pub use format_version::FORMAT_VERSION;
pub use inputs::ManifestInputs;
pub use plan::{BookPlan, CaseFile, FindingCharts, ListCriteria, Plan, PlannedChapter, PlannedFamily, PlannedList};
pub use schema::MANIFEST;
pub use tolerance::{PartialTolerances, Tolerances, tolerated_names};

pub use wishes::{DesignEffort, DesignRequest, MAX_DESIGNS, WishPlace, WishTexts};

pub use coupler_curves::linkage_format::{KeySchema, TableSchema, ValueSchema};
