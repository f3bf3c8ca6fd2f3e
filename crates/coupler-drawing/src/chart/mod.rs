//! The data of charts: quantities of every curve of a family, or of every sample of its curves.
//!
//! A [`Chart`] has expressions over the names of [`scope`]. [`Chart::sample_cell`] evaluates them for one solved cell,
//! and [`ChartBuilder`] joins the resulting points to [`Series`], the lines of the chart. Only these numbers of a cell
//! are kept in memory. A line along a parameter is then sampled between its cells, too, until it deviates from its
//! quantity by less than can be seen.

mod adaptive;
mod axis;
mod builder;
mod parameters;
mod path;
mod refinement;
mod sample;
mod scope;
mod words;

pub use axis::{AxisRange, is_drawable, widen_range};
pub use builder::{ChartBuilder, ChartData, MAX_CURVES, MAX_NUMBERS, Series};
pub use path::LinePath;
pub use refinement::{ForEachInterval, Interval};
pub use sample::ChartSample;
pub use scope::{is_per_sample, scope};
pub(crate) use words::{curve_name, point_name};
pub use words::{title, unit};

use coupler_curves::expression::CompiledExpression;

/// What a point of a chart stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointSource {
    /// A curve, which is a row of `cells.csv`.
    Curves,
    /// A sample of a curve, which is a row of `points.csv`.
    Samples,
}

/// The quantity of an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// The expression as written in the manifest.
    pub text: String,
    /// The quantity in words, or the name of a parameter.
    pub title: String,
    /// The unit: `deg`, `rad`, `per radian` or the like; empty for lengths and pure numbers.
    pub unit: &'static str,
    /// The compiled expression, over the names of [`scope`].
    pub expression: CompiledExpression,
    /// Whether the axis is logarithmic.
    pub is_log: bool,
    /// The least and the greatest value of the axis; those of the data if `None`.
    pub range: Option<[f64; 2]>,
}

impl Quantity {
    /// The title with the unit: "worst transmission angle (°)".
    pub fn label(&self) -> String {
        match self.unit {
            "" => self.title.clone(),
            "deg" => format!("{} (°)", self.title),
            unit => format!("{} ({unit})", self.title),
        }
    }
}

/// A chart of one or more quantities over another.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What a point stands for.
    pub point_source: PointSource,
    /// The quantity of the x axis.
    pub x: Quantity,
    /// The quantities of the y axes, each on a separate chart.
    pub y: Vec<Quantity>,
    /// The parameters that distinguish lines, as indices of [`coupler_curves::family::Family::names`].
    pub group_by: Vec<usize>,
    /// Whether a line joins its points in the order of x; otherwise it joins them in the order of cells or samples.
    pub is_ordered_by_x: bool,
}
