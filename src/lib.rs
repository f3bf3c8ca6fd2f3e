//! Atlases of coupler curves.

pub mod build;
pub mod catalogue;
pub mod expression;
pub mod family;
pub mod geometry;
pub mod linkage;
pub mod manifest;
pub mod measure;
pub mod motion;
pub mod notation;
pub mod page;
pub mod problem;
pub mod record;
pub mod render;
pub mod scene;
pub mod sweep;
pub mod template;
