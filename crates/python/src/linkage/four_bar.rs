//! Four-bars.

use coupler_curves::geometry::trig;
use coupler_curves::linkage::{FourBar as Lengths, PlacedFourBar};
use coupler_curves::template::Template;
use coupler_find::{Mechanism, placed_parameters};
use numpy::PyArray2;
use pyo3::prelude::*;

use super::numeric_linkage::Linkage;
use super::recipe::MotionChoice;
use super::templates::template;
use crate::argument::natural;
use crate::arrays;

/// A four-bar: a linkage of four links and four pins, with a point on its coupler.
///
/// Parameters
/// ----------
/// frame, crank, coupler, rocker : float
///     The lengths, in any unit.
/// along, across : float, optional
///     The coupler point: along the coupler from the crank pin towards the rocker pin, and across it to the left. By default its middle.
/// x, y : float, optional
///     The crank's pivot; by default the origin.
/// turn : float, optional
///     The angle of the frame from the x-axis, in degrees.
/// samples : int
///     How many points a curve has.
#[pyclass(frozen, extends = Linkage, module = "coupler_atlas")]
pub struct FourBar;

impl FourBar {
    /// A four-bar at its position in the plane.
    pub fn placed(py: Python, four_bar: &PlacedFourBar) -> PyResult<Py<FourBar>> {
        let values = placed_parameters(four_bar).map(|(name, value)| (name.to_owned(), value)).to_vec();
        let linkage = Linkage::of_template(Mechanism::template(), None, values, MotionChoice::DEFAULT)?;
        Py::new(py, PyClassInitializer::from(linkage).add_subclass(FourBar))
    }
}

/// The object for a linkage: a `FourBar` if it is the four-bar of the catalogue, or one at its place.
pub fn into_object(py: Python, linkage: Linkage) -> PyResult<Py<PyAny>> {
    let template = &linkage.solution.family.template;
    let four_bars = [Mechanism::template().id.clone(), "four-bar".to_owned()];
    if four_bars.contains(&template.id) && catalogue_names(template) {
        let initializer = PyClassInitializer::from(linkage).add_subclass(FourBar);
        return Ok(Py::new(py, initializer)?.into_any());
    }
    Ok(Py::new(py, linkage)?.into_any())
}

/// Whether a linkage has the parameters of a four-bar: a manifest may have one of its name.
fn catalogue_names(template: &Template) -> bool {
    let has = |name: &str| template.parameters.iter().any(|parameter| parameter.name == name);
    ["frame", "crank", "coupler", "rocker", "along", "across"].into_iter().all(has)
}

#[pymethods]
impl FourBar {
    #[new]
    #[pyo3(signature = (frame, crank, coupler, rocker, along=None, across=None, *, x=None, y=None, turn=None, samples=360))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn new(
        frame: f64,
        crank: f64,
        coupler: f64,
        rocker: f64,
        along: Option<f64>,
        across: Option<f64>,
        x: Option<f64>,
        y: Option<f64>,
        turn: Option<f64>,
        samples: i64,
    ) -> PyResult<PyClassInitializer<FourBar>> {
        let mut values = vec![("frame", frame), ("crank", crank), ("coupler", coupler), ("rocker", rocker)];
        let is_placed = x.is_some() || y.is_some() || turn.is_some();
        let template = match is_placed {
            true => {
                values.extend([("along", along.unwrap_or(coupler / 2.0)), ("across", across.unwrap_or(0.0))]);
                values.extend([("x", x), ("y", y), ("turn", turn)].map(|(name, value)| (name, value.unwrap_or(0.0))));
                Mechanism::template()
            }
            false => {
                values.extend(
                    [("along", along), ("across", across)].into_iter().filter_map(|(name, value)| Some((name, value?))),
                );
                template("four-bar", &[])?
            }
        };
        let values: Vec<(String, f64)> = values.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
        let linkage =
            Linkage::of_template(template, None, values, MotionChoice::samples(natural("samples", samples)?))?;
        Ok(PyClassInitializer::from(linkage).add_subclass(FourBar))
    }

    /// The length of the frame: the distance of the pivots.
    #[getter]
    fn frame(this: &Bound<FourBar>) -> Option<f64> {
        this.as_super().get().parameter("frame")
    }

    /// The length of the crank, the driving link.
    #[getter]
    fn crank(this: &Bound<FourBar>) -> Option<f64> {
        this.as_super().get().parameter("crank")
    }

    /// The length of the coupler between its pins.
    #[getter]
    fn coupler(this: &Bound<FourBar>) -> Option<f64> {
        this.as_super().get().parameter("coupler")
    }

    /// The length of the rocker, the driven link.
    #[getter]
    fn rocker(this: &Bound<FourBar>) -> Option<f64> {
        this.as_super().get().parameter("rocker")
    }

    /// The coupler point along the coupler, from the crank pin towards the rocker pin.
    #[getter]
    fn along(this: &Bound<FourBar>) -> Option<f64> {
        this.as_super().get().parameter("along")
    }

    /// The coupler point across the coupler, to the left.
    #[getter]
    fn across(this: &Bound<FourBar>) -> Option<f64> {
        this.as_super().get().parameter("across")
    }

    /// The pivots of the crank and of the rocker: an array of shape (2, 2).
    #[getter]
    fn pivots<'py>(this: &Bound<'py, FourBar>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let [o, c] = this.as_super().get().solution.placed(1)?.pivots;
        arrays::points(this.py(), [o, c].into_iter(), 2)
    }

    /// Its class, after Grashof's condition: ``crank-rocker``, ``double-rocker`` and so on.
    #[getter]
    fn class_(this: &Bound<FourBar>) -> PyResult<&'static str> {
        Ok(this.as_super().get().solution.placed(1)?.lengths.class().name())
    }

    /// The angles of the crank from the frame at which the rocker reverses, in degrees, with crank and coupler extended and folded; None
    /// for one that is not reached.
    #[getter]
    fn rocker_limits(this: &Bound<FourBar>) -> PyResult<(Option<f64>, Option<f64>)> {
        let lengths: Lengths = this.as_super().get().solution.placed(1)?.lengths;
        let [extended, folded] = lengths.rocker_limits().map(|limit| limit.map(trig::degrees));
        Ok((extended, folded))
    }

    fn __repr__(this: &Bound<FourBar>) -> PyResult<String> {
        Ok(format!("FourBar({})", this.as_super().get().described()?))
    }
}
