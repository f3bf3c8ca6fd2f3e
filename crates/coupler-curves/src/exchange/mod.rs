//! The name of a curve and its exchange formats: CSV, JSON, DXF and a fragment of a manifest.
//!
//! Each format is a submodule that turns a [`SelectedCurve`] into text; selecting curves and writing files happen
//! elsewhere.

mod circle;
mod curve_name;
mod curve_path;
mod dxf;
mod dxf_2000;
mod dxf_writer;
mod fragment;
mod json;
mod linkage_in_numbers;
mod number;
mod part_drawing;
mod part_dxf;
mod part_files;
mod part_svg;
mod points;
mod pretty_json;
mod sampling_fields;
mod selected_curve;
mod table;

pub use curve_name::{CurveName, CurveNameError};
pub use selected_curve::SelectedCurve;

// For the other crates of the workspace only.
#[doc(hidden)]
pub use self::{
    fragment::{ParameterSet, drawn_family_settings, family_id, family_settings, manifest_families, manifest_fragment},
    json::{Members, PassDocument},
    linkage_in_numbers::linkage_in_numbers,
    number::{append_integer, append_number, format_significant},
    part_files::PartFormat,
    table::PointTable,
};

impl SelectedCurve<'_> {
    /// The curve's rows of `points.csv`, with the header.
    pub fn to_csv(&self) -> Vec<u8> {
        points::document(self)
    }

    /// A drawing in DXF. No chord of its polyline is further from the curve than `chord` times the curve's extent,
    /// the longer side of the bounds of its samples.
    pub fn to_dxf(&self, chord: f64) -> String {
        dxf::document(self, chord)
    }

    /// The linkage, parameters, circuits, points and measures as JSON.
    pub fn to_json(&self) -> String {
        json::document(self)
    }

    /// A manifest fragment: a family with this curve's cell.
    pub fn to_toml(&self) -> String {
        manifest_fragment(&[ParameterSet::from_curve(self)])
    }
}
