//! What a chart shows, as plain numbers: quantities of every curve of a family, or of every sample of its curves.
//!
//! A [`Chart`] is expressions over the names of [`scope`]. [`Chart::sample_cell`] reads off one solved cell what they come to
//! there, and [`ChartBuilder`] joins that to [`Series`], the lines of the chart. Nothing of a cell is kept but those numbers.

mod builder;
mod sample;
mod scope;

pub use builder::{ChartBuilder, ChartData, MAX_NUMBERS, Series};
pub use sample::ChartSample;
pub use scope::{definition, is_per_sample, scope, unit};

use coupler_curves::expression::CompiledExpression;

/// What there is a point for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointSource {
    /// Each curve: each row of `cells.csv`.
    Curves,
    /// Each sample of each curve: each row of `points.csv`.
    Samples,
}

/// What is drawn along an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// The expression as it is written.
    pub text: String,
    /// Its unit, `deg` or none.
    pub unit: &'static str,
    /// What it is, in words; may be empty.
    pub definition: &'static str,
    /// Its value, over [`scope`].
    pub expression: CompiledExpression,
    /// Whether it is drawn by its logarithm.
    pub is_log: bool,
    /// The least and the greatest value drawn; as the data has them where none is given.
    pub range: Option<[f64; 2]>,
}

/// Quantities over another.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What there is a point for.
    pub point_source: PointSource,
    /// What goes to the right.
    pub x: Quantity,
    /// What goes up, each on a chart of its own.
    pub y: Vec<Quantity>,
    /// The names, by their places in [`coupler_curves::family::Family::names`], that tell lines apart.
    pub group_by: Vec<usize>,
    /// Whether a line goes in the order of x; otherwise in that of the cells or samples.
    pub is_ordered_by_x: bool,
}
