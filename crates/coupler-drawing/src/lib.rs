//! Drawings of coupler curves: plates, atlas pages and books as SVG, PNG and PDF.
//!
//! Data flows one way: solved cells of [`coupler_curves`] are composed to pages ([`page`]), a page is a list of items at fixed
//! positions ([`scene`]), and a scene is rendered to bytes ([`render`]). Nothing here reads or writes a file.

pub mod chart;
pub mod scene;

pub mod page;

pub mod plate;
pub mod render;
