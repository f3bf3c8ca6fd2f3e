//! Linkages, circuits and curves made again from their pickles.

use coupler_curves::family::{Family, Sampling};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::linkage::{Circuit, Curve, Linkage, MotionChoice, PickledRecipe, into_object, template_of_text};
use crate::manifest::{Manifest, Source};
use crate::reduce::Remake;

/// The linkage that was made from a recipe.
fn made(py: Python, recipe: PickledRecipe) -> PyResult<Linkage> {
    match recipe {
        PickledRecipe::Linkage(name, text, (kind, number, circuits, range_deg), values) => {
            let count = number as usize;
            let sampling = match &*kind {
                "step" => Sampling::Step(number),
                "samples" => Sampling::Samples(count),
                "dense at limits" => Sampling::DenseAtLimits(count),
                "arc length" => Sampling::ArcLength(count),
                _ => return Err(PyValueError::new_err(format!("there is no sampling {kind:?}"))),
            };
            let template = template_of_text(&name, text.as_deref())?;
            let motion = MotionChoice { sampling, circuits, range_deg };
            Linkage::of_template(template, text.map(Into::into), values, motion)
        }
        PickledRecipe::Cell(path, text, name, number, None) => {
            let own = name.clone();
            let cells = move |family: &Family| if family.id == own { number.saturating_sub(1)..number } else { 0..0 };
            Manifest::for_tables(py, Source::new(path, text.into()), cells)?.cell(&name, number)
        }
        PickledRecipe::Cell(path, text, name, number, Some(values)) => {
            Manifest::for_tables(py, Source::new(path, text.into()), |_| 0..0)?.cell_with(&name, number, values)
        }
    }
}

impl Remake for Linkage {
    type State = PickledRecipe;

    fn remake(py: Python, recipe: PickledRecipe) -> PyResult<Py<PyAny>> {
        into_object(py, made(py, recipe)?)
    }
}

/// What a part of a linkage is made again from: what the linkage is, and the index of the part.
type PickledPart = (PickledRecipe, usize);

/// A part of a linkage that is made again, by the name of the list of such parts.
fn remake_part(py: Python, (recipe, index): PickledPart, list: &str) -> PyResult<Py<PyAny>> {
    Ok(Linkage::remake(py, recipe)?.bind(py).getattr(list)?.get_item(index)?.unbind())
}

impl Remake for Curve {
    type State = PickledPart;

    fn remake(py: Python, state: PickledPart) -> PyResult<Py<PyAny>> {
        remake_part(py, state, "curves")
    }
}

impl Remake for Circuit {
    type State = PickledPart;

    fn remake(py: Python, state: PickledPart) -> PyResult<Py<PyAny>> {
        remake_part(py, state, "circuits")
    }
}
