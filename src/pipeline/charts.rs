//! The data of charts, computed on all threads.

use coupler_drawing::chart::{ChartBuilder, ChartData};
use rayon::prelude::*;

/// The data of a chart whose points are complete. Its lines are sampled further where they are not straight; what is
/// solved for that is the same with any number of threads.
pub fn build_chart(builder: ChartBuilder) -> ChartData {
    builder.build_refined(&|intervals, refine| intervals.par_iter_mut().for_each(refine))
}
