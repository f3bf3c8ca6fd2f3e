//! Drawings of coupler curves: plates, atlas pages and books as SVG, PNG and PDF.
//!
//! Data flows one way: solved cells of [`coupler_curves`] are composed to pages ([`page`], or [`plate`] for one curve),
//! a page is a list of items at fixed positions ([`scene`]), and a scene is rendered to bytes ([`render`]). [`chart`]
//! collects the numbers that charts show. Nothing in this crate reads or writes a file.
//!
//! The plate of a coupler curve:
//!
//! ```
//! use coupler_curves::FourBar;
//! use coupler_drawing::plate_svg;
//!
//! let curve = FourBar { frame: 4.0, crank: 1.0, coupler: 3.0, rocker: 3.5 }.coupler_curve(1.5, 1.0)?;
//! let svg = plate_svg(&curve);
//! # assert!(std::str::from_utf8(&svg).is_ok_and(|svg| svg.starts_with("<svg") || svg.starts_with("<?xml")));
//! # Ok::<(), coupler_curves::CurveError>(())
//! ```

pub mod chart;
pub mod scene;

pub mod page;

pub mod render;

pub mod plate;

pub use plate::svg as plate_svg;
