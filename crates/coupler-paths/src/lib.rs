//! Reads the path in a file, as `find` searches for it: a table of points, JSON, or a drawing in SVG or DXF; and the function in a table.
//!
//! ```
//! use coupler_paths::{ReadOptions, parse_outline};
//!
//! let mut outline = parse_outline(b"<svg><path d='M0 0H4V3Z' stroke='black'/></svg>", &ReadOptions::default()).unwrap();
//! assert!(outline.decide_closed());
//! assert_eq!(outline.reading.taken, "outline 1 of 1, a line of 4 by 3; in the drawing's unit");
//! ```

mod closing;
mod outline;

mod encoding;

mod drawing;
mod dxf;
mod svg;

mod json;
mod table;

mod file;

pub use file::{MAX_POINTS, parse_function, parse_outline};
pub use outline::{Outline, ReadOptions, Reading};
pub use table::FunctionRows;
