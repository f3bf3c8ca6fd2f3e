//! The kernel of the gallery: everything that its page computes about linkages, as a WebAssembly module.
//!
//! The page calls [`Kernel::call`] with a request in JSON, see [`Request`], and gets a [`Response`]: JSON, in which arrays
//! of numbers are given by their place in a list of `f64`. What is computed for each frame of a motion has functions of
//! its own, [`Kernel::pose`] and [`Kernel::joint_position`]. The module's exported functions pass these through linear
//! memory.
//!
//! Linkages cross the boundary as manifests in TOML, so that the page knows no linkages, joints or expressions.
//!
//! ```
//! use coupler_kernel::Kernel;
//!
//! let mut kernel = Kernel::default();
//! let manifest = r#"
//!     [atlas]
//!     title = "Straight lines"
//!     [[family]]
//!     id = "hoeken"
//!     linkage = "hoeken"
//!     sampling = { samples = 180 }
//!     cases = [{ a = 1 }]
//! "#;
//! let request = serde_json::json!({ "method": "open_family", "manifest": manifest });
//! assert!(kernel.call(&request.to_string()).json.starts_with(r#"{"family":0"#));
//! ```

mod response;

mod request;

mod family;

mod study;

mod joint_motion;
mod overlays;
mod paths;
mod reading;

mod description;
mod dragging;
mod tables;

mod drawn_path;
mod finder;
mod moving_picture;
mod path_file;

mod curves;

mod kernel;

mod exports;

pub use kernel::Kernel;
pub use request::{CurveRequest, Request};
pub use response::Response;
