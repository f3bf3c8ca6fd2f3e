//! Drawings of coupler curves: plates, atlas pages and books as SVG, PNG and PDF.
//!
//! Data flows one way: solved cells of [`coupler_curves`] are composed into pages ([`page`], or [`plate`] for one
//! curve), a page is a list of items at fixed positions ([`scene`]), and a scene is rendered to bytes ([`render`]).
//! [`chart`] collects the numbers that charts show, [`mechanism`] the parts of a linkage that are drawn. Nothing in this
//! crate reads or writes a file.
//!
//! Features, all by default: `plotters` for charts, `fonts` for text as outlines, `png` and `pdf` for these formats.
//! Without them, plates and the other pages are composed to the same scenes and written as SVG with text, and the crate
//! builds for WebAssembly without imports.
//!
//! A four-bar, its class, one of its coupler curves, the longest straight portion of the curve, and the curve's plate:
//!
//! ```
//! use coupler_curves::FourBar;
//!
//! let four_bar = FourBar { frame: 2.0, crank: 1.0, coupler: 2.5, rocker: 2.5 };
//! let class = four_bar.class();
//! let curve = four_bar.coupler_curve(5.0, 0.0)?;
//! let straight = curve.straight_portion();
//! let svg = coupler_drawing::plate_svg(&curve);
//! # assert_eq!(class.name(), "crank-rocker");
//! # assert!(straight.is_some_and(|straight| straight.length > 1.1));
//! # assert!(std::str::from_utf8(&svg).is_ok_and(|svg| svg.contains("<svg") && svg.contains("frame = 2")));
//! # Ok::<(), coupler_curves::CurveError>(())
//! ```

pub mod chart;
pub mod mechanism;
pub mod scene;

pub mod page;

pub mod render;

pub mod plate;

pub mod curve_file;

pub use plate::svg as plate_svg;
