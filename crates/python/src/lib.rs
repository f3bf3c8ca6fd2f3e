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
mod reduce;
mod task;

mod linkage;

mod manifest;
mod results;

mod page;

mod overview;

mod atlas;

mod arrow;
mod check;
mod design;
mod find;
mod function;
mod inspection;
mod parameter_sets;
mod pickle;
mod poses;
mod render;
mod sweep;

use std::ffi::OsString;

use pyo3::PyClass;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

/// Runs the program `coupler-atlas` with the arguments of a command line, the first of which is its name, and returns the exit code.
#[pyfunction]
fn run_command(py: Python, arguments: Vec<OsString>) -> u8 {
    py.detach(|| coupler_atlas::cli::run(&arguments))
}

/// Adds the classes to the module, all of which can be made again from their pickles, and defines the function that pickles call.
macro_rules! classes {
    ($($class:ty),* $(,)?) => {
        fn add_classes(module: &Bound<PyModule>) -> PyResult<()> {
            $(module.add_class::<$class>()?;)*
            Ok(())
        }

        /// Makes an object again that was pickled or copied.
        #[pyfunction]
        #[pyo3(name = "_remake")]
        fn make_again(class: &str, state: &Bound<PyAny>) -> PyResult<Py<PyAny>> {
            match class {
                $(<$class as PyClass>::NAME => reduce::remade::<$class>(state),)*
                _ => Err(PyTypeError::new_err(format!("there is no class {class}: the pickle is of another version"))),
            }
        }
    };
}

classes!(
    linkage::Linkage,
    linkage::Curve,
    linkage::Circuit,
    linkage::Sextic,
    linkage::Animation,
    linkage::Explorer,
    atlas::Atlas,
    atlas::Family,
    atlas::Cells,
    page::Page,
    sweep::Sweep,
    arrow::Batch,
    find::Found,
    find::Answer,
    poses::FoundPoses,
    poses::PoseAnswer,
    function::FoundFunction,
    function::FunctionAnswer,
    design::Designs,
    design::Design,
    render::Rendering,
    check::Report,
    inspection::Inspection,
);

/// The compiled part of the package.
#[pymodule]
fn _core(module: &Bound<PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    error::add_to(module)?;
    add_classes(module)?;
    // Pickled as what they are kinds of, or are.
    module.add_class::<linkage::FourBar>()?;
    module.add_class::<results::Results>()?;
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
    module.add_function(wrap_pyfunction!(inspection::inspect_linkage, module)?)?;
    // What pickles call.
    module.add_function(wrap_pyfunction!(make_again, module)?)?;
    module.add_function(wrap_pyfunction!(run_command, module)?)
}
