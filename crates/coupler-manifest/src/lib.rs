//! Parses manifests of atlases: TOML that names families of planar linkages and says how they are drawn.
//!
//! [`parse`] turns a text into a validated [`Plan`], or reports every problem in it with its place and a remedy. It uses
//! no files, threads or clocks, and what it returns depends on the text alone; [`parse_with_files`] also reads the font file
//! that a theme may name.
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
mod format_version;
mod inputs;
mod tolerance;
mod unused_names;

mod theme;

mod undrawable;

mod settings;

mod grid;

mod names;

mod chart;

mod plan;

mod book;

mod schema;

mod cells;
mod templates;

mod family;

mod document;

pub use cells::MAX_PAGE_FILES;
pub use document::{
    MAX_MANIFEST_BYTES, ParseOutcome, linkage_text, parse, parse_for_formats, parse_for_tables, parse_linkages,
    parse_with_files,
};
pub use format_version::FORMAT_VERSION;
pub use inputs::ManifestInputs;
pub use plan::{BookPlan, FindingCharts, ListCriteria, Plan, PlannedChapter, PlannedFamily, PlannedList};
pub use schema::MANIFEST;
pub use theme::FileReader;
pub use tolerance::{PartialTolerances, Tolerances};

pub use coupler_curves::linkage_format::{KeySchema, TableSchema, ValueSchema};
