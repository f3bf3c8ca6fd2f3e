//! The Python module `coupler_atlas`: linkages and their curves as NumPy arrays, sweeps as Arrow streams, atlases rendered and checked.
//!
//! A layer over the library: it converts arguments and results, and solves nothing itself. `coupler_atlas/__init__.py` makes one module of
//! this one and the few lines that are Python; `__init__.pyi` has the types.

mod argument;
mod error;
mod file;
mod html;
mod keywords;

mod arrays;
mod task;

mod linkage;

mod manifest;
mod results;

mod atlas;

mod arrow;
mod check;
mod design;
mod find;
mod function;
mod parameter_sets;
mod pickle;
mod poses;
mod render;
mod sweep;

use std::ffi::OsString;

use pyo3::prelude::*;

/// Runs the program `coupler-atlas` with the arguments of a command line, the first of which is its name, and returns the exit code.
#[pyfunction]
fn run_command(py: Python, arguments: Vec<OsString>) -> u8 {
    py.detach(|| coupler_atlas::cli::run(&arguments))
}

/// The compiled part of the package.
#[pymodule]
fn _core(module: &Bound<PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    error::add_to(module)?;
    module.add_class::<linkage::Linkage>()?;
    module.add_class::<linkage::FourBar>()?;
    module.add_class::<linkage::Curve>()?;
    module.add_class::<linkage::Circuit>()?;
    module.add_class::<linkage::Sextic>()?;
    module.add_class::<linkage::Animation>()?;
    module.add_class::<atlas::Atlas>()?;
    module.add_class::<atlas::Family>()?;
    module.add_class::<atlas::Cells>()?;
    module.add_class::<sweep::Sweep>()?;
    module.add_class::<arrow::Batch>()?;
    module.add_class::<results::Results>()?;
    module.add_class::<find::Found>()?;
    module.add_class::<find::Answer>()?;
    module.add_class::<poses::FoundPoses>()?;
    module.add_class::<poses::PoseAnswer>()?;
    module.add_class::<function::FoundFunction>()?;
    module.add_class::<function::FunctionAnswer>()?;
    module.add_class::<design::Designs>()?;
    module.add_class::<design::Design>()?;
    module.add_class::<render::Rendering>()?;
    module.add_class::<check::Report>()?;
    module.add_function(wrap_pyfunction!(linkage::make_linkage, module)?)?;
    module.add_function(wrap_pyfunction!(linkage::linkages, module)?)?;
    module.add_function(wrap_pyfunction!(atlas::read, module)?)?;
    module.add_function(wrap_pyfunction!(atlas::parse, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::sweep, module)?)?;
    module.add_function(wrap_pyfunction!(find::find_linkages, module)?)?;
    module.add_function(wrap_pyfunction!(poses::find_guides, module)?)?;
    module.add_function(wrap_pyfunction!(function::find_generators, module)?)?;
    module.add_function(wrap_pyfunction!(design::design_linkage, module)?)?;
    module.add_function(wrap_pyfunction!(render::render, module)?)?;
    module.add_function(wrap_pyfunction!(check::check_atlas, module)?)?;
    // What pickles call.
    module.add_function(wrap_pyfunction!(pickle::make_linkage_again, module)?)?;
    module.add_function(wrap_pyfunction!(pickle::make_curve_again, module)?)?;
    module.add_function(wrap_pyfunction!(pickle::make_circuit_again, module)?)?;
    module.add_function(wrap_pyfunction!(atlas::read_again, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::sweep_again, module)?)?;
    module.add_function(wrap_pyfunction!(run_command, module)?)
}
