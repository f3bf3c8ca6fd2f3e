//! What a chart shows, as plain numbers: quantities of every curve of a family, or of every sample of its curves.
//!
//! A [`Chart`] is expressions over the names of [`scope`]. [`Chart::take`] reads off one solved cell what they come to
//! there, and [`Gathering`] joins that to [`Series`], the lines of the chart. Nothing of a cell is kept but those numbers.

mod gathering;
mod scope;
mod taking;

pub use gathering::{Gathered, Gathering, MOST_NUMBERS, Series};
pub use scope::{definition, is_of_samples, scope, unit};
pub use taking::Taken;

use coupler_curves::expression::Bound;

/// What there is a point for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Over {
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
    pub value: Bound,
    /// Whether it is drawn by its logarithm.
    pub is_log: bool,
    /// The least and the greatest value drawn; as the data has them where none is given.
    pub range: Option<[f64; 2]>,
}

/// Quantities over another.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What there is a point for.
    pub over: Over,
    /// What goes to the right.
    pub x: Quantity,
    /// What goes up, each on a chart of its own.
    pub y: Vec<Quantity>,
    /// The names, by their places in [`coupler_curves::family::Family::names`], that tell lines apart.
    pub by: Vec<usize>,
    /// Whether a line goes in the order of x; otherwise in that of the cells or samples.
    pub in_order_of_x: bool,
}
