//! Linkages, their circuits and their curves.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use coupler_atlas::manifest;
use coupler_curves::catalogue;
use coupler_curves::exchange::SelectedCurve;
use coupler_curves::family::{Family, MEASURES, ParameterText, Sampling};
use coupler_curves::find::{Mechanism, placed_parameters};
use coupler_curves::geometry::trig;
use coupler_curves::linkage::{
    self, CircuitSelection, Cognates, DyadId, FourBar as Lengths, Input, JointId, PlacedFourBar,
};
use coupler_curves::measure::Value;
use coupler_curves::motion::{self, MAX_SAMPLES, Sampler};
use coupler_curves::problem::suggestion;
use coupler_curves::solve::{MeasuredCurve, SolvedCell, solve_cell, solve_measuring};
use coupler_curves::template::Template;
use coupler_drawing::curve_file::{self, CurveFormat, FileOptions};
use coupler_drawing::page::{Options, PoseChoice};
use coupler_drawing::plate::{self, PAPER, moving_view};
use coupler_drawing::render::{self, TextMode};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyTuple};

use crate::arrays;
use crate::atlas::read_text;
use crate::error::{self, LinkageError};

/// The number of samples of a circuit where none is given, as in `inspect`.
const DEFAULT_SAMPLES: usize = 360;

/// A sampler; the last one is kept, for its table of sines takes as long as the samples of a linkage.
fn sampler(sampling: Sampling) -> Arc<Sampler> {
    static LAST: Mutex<Option<(Sampling, Arc<Sampler>)>> = Mutex::new(None);
    let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
    match &*last {
        Some((known, sampler)) if *known == sampling => sampler.clone(),
        _ => {
            let sampler = Arc::new(Sampler::new(sampling));
            *last = Some((sampling, sampler.clone()));
            sampler
        }
    }
}

/// A linkage with what has been computed of it.
pub struct Solution {
    family: Family,
    source: String,
    number: Option<usize>,
    /// Without measures, which take most of the time.
    moved: OnceLock<Option<SolvedCell>>,
    measured: OnceLock<Option<SolvedCell>>,
}

impl Solution {
    /// Its circuits and curves, without measures.
    fn moved(&self) -> PyResult<&SolvedCell> {
        let solve = || solve_measuring(&self.family, &sampler(self.family.sampling), 0, &[false; MEASURES.len()]);
        self.moved.get_or_init(solve).as_ref().ok_or_else(|| self.no_linkage())
    }

    /// Its circuits and curves with all measures.
    fn measured(&self, py: Python) -> PyResult<&SolvedCell> {
        let solve = || solve_cell(&self.family, &sampler(self.family.sampling), 0);
        let measured = py.detach(|| self.measured.get_or_init(solve).as_ref());
        measured.ok_or_else(|| self.no_linkage())
    }

    fn no_linkage(&self) -> PyErr {
        LinkageError::new_err(format!("{}: there is no linkage with these parameters", self.family.id))
    }

    /// The index of a curve among those of the linkage, by the numbers of its trace and its circuit.
    fn curve_index(&self, trace: usize, circuit: usize) -> PyResult<usize> {
        let solved = self.moved()?;
        if !solved.motion.is_assembled() {
            return Err(LinkageError::new_err(format!("{}: {}", self.family.id, solved.reason())));
        }
        let index = solved.curves.iter().position(|curve| [curve.trace, curve.circuit] == [trace, circuit]);
        index.ok_or_else(|| {
            let (traces, circuits) = (solved.linkage.traced.len(), solved.motion.circuits.len());
            PyValueError::new_err(format!(
                "trace={trace}, circuit={circuit}: `{}` has traces 1 to {traces} and circuits 1 to {circuits}",
                self.family.id
            ))
        })
    }

    fn placed(&self, trace: usize) -> PyResult<PlacedFourBar> {
        let solved = self.moved()?;
        let id = &self.family.id;
        let Some(&joint) = trace.checked_sub(1).and_then(|k| solved.linkage.traced.get(k)) else {
            let count = solved.linkage.traced.len();
            return Err(PyValueError::new_err(format!("trace={trace}: `{id}` traces joints 1 to {count}")));
        };
        PlacedFourBar::from_linkage(&solved.linkage, joint)
            .map_err(|error| LinkageError::new_err(format!("{id}: {error}; {}", error.help())))
    }

    /// The linkage as SVG, with all its curves.
    fn svg(&self, pose: impl FnOnce(&SolvedCell) -> PoseChoice, py: Python) -> PyResult<String> {
        let solved = self.measured(py)?;
        if !solved.motion.is_assembled() {
            return Err(LinkageError::new_err(format!("{}: {}", self.family.id, solved.reason())));
        }
        let scene = plate::compose_cell(&self.family, solved, pose(solved), &Options::for_paper(PAPER));
        Ok(into_text(render::svg(&scene, TextMode::Text)))
    }
}

fn into_text(bytes: Vec<u8>) -> String {
    String::from_utf8_lossy(&bytes).into_owned()
}

/// A linkage with numeric dimensions.
///
/// Lengths are in the unit in which they were given, inputs in degrees (or that unit, of an actuator), rates per radian (or unit) of the
/// input. Arrays are computed once, share their memory, and cannot be written to: copy one to change it. Circuits and traces are numbered
/// from 1, as in tables.
#[pyclass(frozen, subclass, module = "coupler_atlas")]
pub struct Linkage {
    solution: Arc<Solution>,
    curves: PyOnceLock<Py<PyTuple>>,
    circuits: PyOnceLock<Py<PyTuple>>,
}

impl Linkage {
    /// The linkage of a family with a single cell, which has this number in an atlas.
    pub fn new(family: Family, source: String, number: Option<usize>) -> Linkage {
        let solution = Solution { family, source, number, moved: OnceLock::new(), measured: OnceLock::new() };
        Linkage { solution: Arc::new(solution), curves: PyOnceLock::new(), circuits: PyOnceLock::new() }
    }

    fn of_template(template: Arc<Template>, values: &[(String, f64)], samples: usize) -> PyResult<Linkage> {
        let samples = checked_samples(samples)?;
        let source = template.source_line();
        let id = template.id.clone();
        let family = Family::single_cell(template, values, Sampling::Samples(samples))
            .map_err(|errors| LinkageError::new_err(format!("{id}: {}", errors.to_string().replace('\n', "; "))))?;
        Ok(Linkage::new(family, source, None))
    }

    fn parameter(&self, name: &str) -> Option<f64> {
        let family = &self.solution.family;
        let slot = family.names.iter().position(|known| known == name)?;
        family.cell(0).values.get(slot).copied()
    }
}

fn checked_samples(samples: usize) -> PyResult<usize> {
    match samples {
        2..=MAX_SAMPLES => Ok(samples),
        _ => Err(PyValueError::new_err(format!("samples={samples}: a circuit has from 2 to {MAX_SAMPLES} samples"))),
    }
}

#[pymethods]
impl Linkage {
    /// The id of the linkage, or of its family.
    #[getter]
    fn id(&self) -> &str {
        &self.solution.family.id
    }

    /// The number of its cell in its family, from 1; None for a linkage by itself.
    #[getter]
    fn number(&self) -> Option<usize> {
        self.solution.number
    }

    /// The values of its parameters by name, in the order in which they are declared.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let family = &self.solution.family;
        let (values, found) = (family.cell(0).values, PyDict::new(py));
        for (parameter, value) in family.template.parameters.iter().zip(values) {
            found.set_item(&parameter.name, value)?;
        }
        Ok(found)
    }

    /// The names of the joints.
    #[getter]
    fn joints(&self) -> PyResult<Vec<&str>> {
        Ok(self.solution.moved()?.linkage.joints.iter().map(|joint| joint.name.as_str()).collect())
    }

    /// What the input is: ``deg``, an angle, or ``length``.
    #[getter]
    fn input(&self) -> &'static str {
        if self.solution.family.template.is_driven_by_length() { "length" } else { "deg" }
    }

    /// Whether it can be assembled: ``ok``, ``partial`` over a part of the requested range, or ``none``.
    #[getter]
    fn status(&self) -> PyResult<&'static str> {
        Ok(self.solution.moved()?.status().name())
    }

    /// Why the status is not ``ok``; empty if it is.
    #[getter]
    fn reason(&self) -> PyResult<String> {
        Ok(self.solution.moved()?.reason())
    }

    /// The points of a curve: an array of shape (n, 2), in the unit of the lengths.
    ///
    /// Parameters
    /// ----------
    /// samples : int, optional
    ///     How many points the circuit has, in equal steps of the input; by default those of the linkage, 360 unless it says otherwise.
    /// trace, circuit : int
    ///     The numbers of the traced joint and of the circuit, from 1.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     A closed curve does not repeat its first point. At a point that a joint does not reach its coordinates are NaN.
    #[pyo3(signature = (samples=None, *, trace=1, circuit=1))]
    fn curve<'py>(
        this: &Bound<'py, Linkage>,
        samples: Option<usize>,
        trace: usize,
        circuit: usize,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let py = this.py();
        let solution = &this.get().solution;
        let index = solution.curve_index(trace, circuit)?;
        let Some(samples) = samples else {
            let curve = Linkage::curves(this)?.bind(py).get_item(index)?.cast_into::<Curve>()?;
            return Ok(Curve::points(&curve)?.bind(py).clone());
        };
        let sampler = sampler(Sampling::Samples(checked_samples(samples)?));
        let solved = solution.moved()?;
        let curve = &solved.curves[index];
        let own = solved.circuit(curve);
        let (linkage, joint) = solved.linkage.with_one_point(curve.joint);
        let unsampled = motion::UnsampledCircuit { passes: own.passes.clone(), is_closed: own.is_closed };
        let sampled = py.detach(|| sampler.sample_circuit(&linkage, unsampled));
        arrays::points(py, sampled.points(joint), sampled.len())
    }

    /// The curves, one for each traced joint and circuit, in this order.
    #[getter]
    fn curves(this: &Bound<Linkage>) -> PyResult<Py<PyTuple>> {
        let (py, own) = (this.py(), this.get());
        let make = || {
            let count = own.solution.moved()?.curves.len();
            let curve = |index| Py::new(py, Curve::new(own.solution.clone(), index));
            Ok::<_, PyErr>(PyTuple::new(py, (0..count).map(curve).collect::<PyResult<Vec<_>>>()?)?.unbind())
        };
        Ok(own.curves.get_or_try_init(py, make)?.clone_ref(py))
    }

    /// The circuits: motions of the whole linkage without disassembly, those that start on branch 1 first, then by least input.
    #[getter]
    fn circuits(this: &Bound<Linkage>) -> PyResult<Py<PyTuple>> {
        let (py, own) = (this.py(), this.get());
        let make = || {
            let count = own.solution.moved()?.motion.circuits.len();
            let circuit =
                |index| Py::new(py, Circuit { solution: own.solution.clone(), index, inputs: PyOnceLock::new() });
            Ok::<_, PyErr>(PyTuple::new(py, (0..count).map(circuit).collect::<PyResult<Vec<_>>>()?)?.unbind())
        };
        Ok(own.circuits.get_or_try_init(py, make)?.clone_ref(py))
    }

    /// For each circuit the least and the greatest input, in degrees or units of length, which are its limit positions; None where the input turns
    /// fully.
    #[getter]
    fn limits(&self) -> PyResult<Vec<Option<(f64, f64)>>> {
        Ok(self.solution.moved()?.motion.circuits.iter().map(limits_of).collect())
    }

    /// All measures of a curve by name: numbers, words, and None where a measure does not apply.
    ///
    /// Angles are in degrees and named so (``_deg``), lengths in the unit of the linkage, rates per radian. docs/measures.md defines them.
    #[pyo3(signature = (*, trace=1, circuit=1))]
    fn measures<'py>(&self, py: Python<'py>, trace: usize, circuit: usize) -> PyResult<Bound<'py, PyDict>> {
        let index = self.solution.curve_index(trace, circuit)?;
        measures_of(py, &self.solution, index)
    }

    /// The Roberts-Chebyshev cognates: the two other four-bars that trace the same curve, where they do.
    ///
    /// Parameters
    /// ----------
    /// trace : int
    ///     The number of the traced joint that is the coupler point, from 1.
    #[pyo3(signature = (*, trace=1))]
    fn cognates(&self, py: Python, trace: usize) -> PyResult<Vec<Py<FourBar>>> {
        let placed = self.solution.placed(trace)?;
        let id = &self.solution.family.id;
        let cognates = Cognates::from_four_bar(placed)
            .map_err(|error| LinkageError::new_err(format!("{id}: {error}; {}", error.help())))?;
        cognates.others.iter().map(|cognate| FourBar::placed(py, &cognate.four_bar)).collect()
    }

    /// The equation of the curve of a coupler point of a four-bar, a polynomial of degree 6.
    ///
    /// Parameters
    /// ----------
    /// trace : int
    ///     The number of the traced joint that is the coupler point, from 1.
    #[pyo3(signature = (*, trace=1))]
    fn sextic(&self, trace: usize) -> PyResult<Sextic> {
        let placed = self.solution.placed(trace)?;
        let found = linkage::Sextic::from_four_bar(placed.lengths, placed.coupler_point);
        let inner = found.ok_or_else(|| {
            let message = "the traced joint is a pin, which moves on a circle, and so has no sextic";
            LinkageError::new_err(format!("{}: {message}", self.solution.family.id))
        })?;
        Ok(Sextic { inner })
    }

    /// A plate of the linkage and its curves, as SVG.
    fn svg(&self, py: Python) -> PyResult<String> {
        self.solution.svg(|_| PoseChoice::Clearest, py)
    }

    /// The linkage in motion through a circuit, for a notebook or a file.
    #[pyo3(signature = (*, circuit=1))]
    fn animate(&self, py: Python, circuit: usize) -> PyResult<Animation> {
        let circuits = self.solution.moved()?.motion.circuits.len();
        if circuits > 0 && !(1..=circuits).contains(&circuit) {
            let message = format!("circuit={circuit}: `{}` has circuits 1 to {circuits}", self.solution.family.id);
            return Err(PyValueError::new_err(message));
        }
        let pose = |solved: &SolvedCell| match circuit.checked_sub(1).and_then(|k| solved.motion.circuits.get(k)) {
            Some(own) => moving_view(&solved.linkage, own, circuit),
            None => PoseChoice::Clearest,
        };
        Ok(Animation { svg: self.solution.svg(pose, py)? })
    }

    /// The plate that a notebook shows; nothing if the linkage cannot be assembled.
    fn _repr_svg_(&self, py: Python) -> PyResult<Option<String>> {
        if self.solution.moved()?.motion.is_assembled() { self.svg(py).map(Some) } else { Ok(None) }
    }

    fn __repr__(&self) -> String {
        let family = &self.solution.family;
        let values = family.template.parameters.iter().zip(family.cell(0).values);
        let values: Vec<String> = values.map(|(parameter, value)| format!("{}={value}", parameter.name)).collect();
        format!("<coupler_atlas.Linkage {}: {}>", family.id, values.join(", "))
    }
}

fn limits_of(circuit: &motion::Circuit) -> Option<(f64, f64)> {
    let range = || circuit.passes.iter().map(|pass| pass.input_range());
    let [least, greatest] =
        [range().map(|[low, _]| low).reduce(f64::min), range().map(|[_, high]| high).reduce(f64::max)];
    least.zip(greatest).filter(|_| !circuit.is_full_turn())
}

fn measures_of<'py>(py: Python<'py>, solution: &Solution, index: usize) -> PyResult<Bound<'py, PyDict>> {
    let solved = solution.measured(py)?;
    let is_driven_by_length = solved.linkage.input() == Input::Length;
    let found = PyDict::new(py);
    for (measure, value) in MEASURES.iter().zip(&solved.curves[index].values) {
        let name = measure.name_for(is_driven_by_length);
        match value {
            Value::Number(number) => found.set_item(name, number)?,
            Value::Word(word) => found.set_item(name, word)?,
            Value::Missing => found.set_item(name, py.None())?,
        }
    }
    Ok(found)
}

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
        let values = placed_parameters(four_bar).map(|(name, value)| (name.to_owned(), value));
        let linkage = Linkage::of_template(Mechanism::template(), &values, DEFAULT_SAMPLES)?;
        Py::new(py, PyClassInitializer::from(linkage).add_subclass(FourBar))
    }
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
        samples: usize,
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
        let linkage = Linkage::of_template(template, &values, samples)?;
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

    fn __repr__(this: &Bound<FourBar>) -> String {
        let own = this.as_super().get();
        let family = &own.solution.family;
        let values = family.template.parameters.iter().zip(family.cell(0).values);
        let values: Vec<String> = values.map(|(parameter, value)| format!("{}={value}", parameter.name)).collect();
        format!("FourBar({})", values.join(", "))
    }
}

/// The curve of a traced joint on a circuit.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Curve {
    solution: Arc<Solution>,
    index: usize,
    points: PyOnceLock<Py<PyArray2<f64>>>,
    inputs: PyOnceLock<Py<PyArray1<f64>>>,
    branches: PyOnceLock<Py<PyArray2<i8>>>,
    velocities: PyOnceLock<Py<PyArray2<f64>>>,
}

impl Curve {
    fn new(solution: Arc<Solution>, index: usize) -> Curve {
        Curve {
            solution,
            index,
            points: PyOnceLock::new(),
            inputs: PyOnceLock::new(),
            branches: PyOnceLock::new(),
            velocities: PyOnceLock::new(),
        }
    }

    /// Its curve and its circuit. They have been solved, or there would be no curve.
    fn parts(&self) -> PyResult<(&SolvedCell, &MeasuredCurve, &motion::Circuit)> {
        let solved = self.solution.moved()?;
        let curve = &solved.curves[self.index];
        Ok((solved, curve, solved.circuit(curve)))
    }

    /// Its points and inputs, and whether it is closed.
    pub fn path(&self) -> PyResult<(Vec<coupler_curves::geometry::Point>, Vec<f64>, bool)> {
        let (_, curve, circuit) = self.parts()?;
        Ok((circuit.points(curve.joint).collect(), circuit.inputs.clone(), circuit.is_closed))
    }

    fn file(&self, py: Python, format: CurveFormat) -> PyResult<String> {
        let Solution { family, source, number, .. } = &*self.solution;
        let mut solved = self.solution.measured(py)?.clone();
        solved.cell.number = number.unwrap_or(solved.cell.number);
        let selected = SelectedCurve::all_from_cell(family, source, &[], &solved);
        let options = FileOptions {
            page: Options::for_paper(PAPER),
            text_mode: TextMode::Text,
            chord_tolerance: FileOptions::DEFAULT_CHORD_TOLERANCE,
        };
        let selected = selected.get(self.index).ok_or_else(|| self.solution.no_linkage())?;
        Ok(into_text(curve_file::bytes(selected, format, &options)))
    }
}

#[pymethods]
impl Curve {
    /// The number of the traced joint, from 1.
    #[getter]
    fn trace(&self) -> PyResult<usize> {
        Ok(self.parts()?.1.trace)
    }

    /// The number of the circuit, from 1.
    #[getter]
    fn circuit(&self) -> PyResult<usize> {
        Ok(self.parts()?.1.circuit)
    }

    /// The name of the traced joint.
    #[getter]
    fn joint(&self) -> PyResult<&str> {
        let (solved, curve, _) = self.parts()?;
        Ok(&solved.linkage.joints[curve.joint].name)
    }

    /// Whether it ends where it begins; the first point is not repeated.
    #[getter]
    fn closed(&self) -> PyResult<bool> {
        Ok(self.parts()?.2.is_closed)
    }

    /// Whether the input turns fully.
    #[getter]
    fn full_turn(&self) -> PyResult<bool> {
        Ok(self.parts()?.2.is_full_turn())
    }

    /// The least and the greatest input, in degrees or units of length; None where the input turns fully.
    #[getter]
    fn limits(&self) -> PyResult<Option<(f64, f64)>> {
        Ok(limits_of(self.parts()?.2))
    }

    /// The points: an array of shape (n, 2), in the unit of the lengths.
    #[getter]
    fn points(this: &Bound<Curve>) -> PyResult<Py<PyArray2<f64>>> {
        let (py, own) = (this.py(), this.get());
        let make = || {
            let (_, curve, circuit) = own.parts()?;
            Ok::<_, PyErr>(arrays::points(py, circuit.points(curve.joint), circuit.len())?.unbind())
        };
        Ok(own.points.get_or_try_init(py, make)?.clone_ref(py))
    }

    /// The inputs at the points: an array of shape (n,), in degrees, continuous and never wrapped, or in units of length.
    #[getter]
    fn inputs(this: &Bound<Curve>) -> PyResult<Py<PyArray1<f64>>> {
        let (py, own) = (this.py(), this.get());
        let make = || Ok::<_, PyErr>(arrays::column(py, own.parts()?.2.inputs.clone()).unbind());
        Ok(own.inputs.get_or_try_init(py, make)?.clone_ref(py))
    }

    /// The side of the first two-valued joint at the points: an array of shape (n,), 1 left, -1 right, and 1 where there is no such joint.
    #[getter]
    fn branch<'py>(this: &Bound<'py, Curve>) -> PyResult<Bound<'py, PyAny>> {
        let index = (pyo3::types::PySlice::full(this.py()), 0);
        Curve::branches(this)?.bind(this.py()).get_item(index)
    }

    /// The sides of all two-valued joints at the points: an array of shape (n, joints), and (n, 1) where there is none.
    #[getter]
    fn branches(this: &Bound<Curve>) -> PyResult<Py<PyArray2<i8>>> {
        let (py, own) = (this.py(), this.get());
        let make = || {
            let (solved, _, circuit) = own.parts()?;
            Ok::<_, PyErr>(branches_of(py, solved, circuit)?.unbind())
        };
        Ok(own.branches.get_or_try_init(py, make)?.clone_ref(py))
    }

    /// The velocities at the points: an array of shape (n, 2), in units of length per radian, or unit of length, of the input; infinite at
    /// limits.
    #[getter]
    fn velocities(this: &Bound<Curve>) -> PyResult<Py<PyArray2<f64>>> {
        let (py, own) = (this.py(), this.get());
        let make = || {
            let (solved, curve, circuit) = own.parts()?;
            let values = py.detach(|| velocities_of(solved, circuit, curve.joint));
            Ok::<_, PyErr>(arrays::rows(py, values, 2)?.unbind())
        };
        Ok(own.velocities.get_or_try_init(py, make)?.clone_ref(py))
    }

    /// All measures of the curve by name, as of ``Linkage.measures``.
    fn measures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        measures_of(py, &self.solution, self.index)
    }

    /// A plate of the curve with its linkage, as SVG.
    fn svg(&self, py: Python) -> PyResult<String> {
        self.file(py, CurveFormat::Svg)
    }

    /// The manifest of a family with this linkage, as TOML.
    fn toml(&self, py: Python) -> PyResult<String> {
        self.file(py, CurveFormat::Toml)
    }

    /// A drawing for CAD, as DXF.
    fn dxf(&self, py: Python) -> PyResult<String> {
        self.file(py, CurveFormat::Dxf)
    }

    /// The rows of ``points.csv``.
    fn csv(&self, py: Python) -> PyResult<String> {
        self.file(py, CurveFormat::Csv)
    }

    /// Linkage, parameters, circuits, points and measures, as JSON.
    fn json(&self, py: Python) -> PyResult<String> {
        self.file(py, CurveFormat::Json)
    }

    /// The plate that a notebook shows.
    fn _repr_svg_(&self, py: Python) -> PyResult<String> {
        self.svg(py)
    }

    /// The number of points.
    fn __len__(&self) -> PyResult<usize> {
        Ok(self.parts()?.2.len())
    }

    fn __repr__(&self) -> PyResult<String> {
        let (_, curve, circuit) = self.parts()?;
        let kind = if circuit.is_closed { "closed" } else { "open" };
        let (id, joint) = (&self.solution.family.id, self.joint()?);
        Ok(format!(
            "<coupler_atlas.Curve of {id}: {joint} on circuit {}, {} points, {kind}>",
            curve.circuit,
            circuit.len()
        ))
    }
}

fn branches_of<'py>(
    py: Python<'py>,
    solved: &SolvedCell,
    circuit: &motion::Circuit,
) -> PyResult<Bound<'py, PyArray2<i8>>> {
    let dyads = solved.linkage.dyad_count().max(1);
    let side = |k| move |dyad| if circuit.mode_at(k).sign(DyadId::new(dyad)) > 0 { 1 } else { -1 };
    arrays::rows(py, (0..circuit.len()).flat_map(|k| (0..dyads).map(side(k))).collect(), dyads)
}

/// Components x and y in turn.
fn velocities_of(solved: &SolvedCell, circuit: &motion::Circuit, joint: JointId) -> Vec<f64> {
    let (linkage, joint) = match solved.linkage.traced.contains(&joint) {
        true => solved.linkage.with_one_point(joint),
        false => (solved.linkage.clone(), joint),
    };
    let velocity = |sample| {
        let velocity = circuit.derivatives(&linkage, sample).velocity(joint);
        [velocity.x, velocity.y]
    };
    (0..circuit.len()).flat_map(velocity).collect()
}

/// A circuit: a motion of the whole linkage without disassembly.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Circuit {
    solution: Arc<Solution>,
    index: usize,
    inputs: PyOnceLock<Py<PyArray1<f64>>>,
}

impl Circuit {
    fn parts(&self) -> PyResult<(&SolvedCell, &motion::Circuit)> {
        let solved = self.solution.moved()?;
        Ok((solved, &solved.motion.circuits[self.index]))
    }

    fn joint(&self, name: &str) -> PyResult<JointId> {
        let linkage = &self.parts()?.0.linkage;
        let found = linkage.joint_ids().find(|joint| linkage.joints[*joint].name == name);
        found.ok_or_else(|| {
            let mut names: Vec<&str> = linkage.joints.iter().map(|joint| joint.name.as_str()).collect();
            names.dedup();
            PyValueError::new_err(format!("there is no joint `{name}`: {}", suggestion(name, &names)))
        })
    }
}

#[pymethods]
impl Circuit {
    /// Its number, from 1.
    #[getter]
    fn number(&self) -> usize {
        self.index + 1
    }

    /// Whether it ends where it begins; the first sample is not repeated.
    #[getter]
    fn closed(&self) -> PyResult<bool> {
        Ok(self.parts()?.1.is_closed)
    }

    /// Whether the input turns fully.
    #[getter]
    fn full_turn(&self) -> PyResult<bool> {
        Ok(self.parts()?.1.is_full_turn())
    }

    /// The least and the greatest input, in degrees or units of length; None where the input turns fully.
    #[getter]
    fn limits(&self) -> PyResult<Option<(f64, f64)>> {
        Ok(limits_of(self.parts()?.1))
    }

    /// The inputs of the samples: an array of shape (n,), in degrees, continuous and never wrapped, or in units of length.
    #[getter]
    fn inputs(this: &Bound<Circuit>) -> PyResult<Py<PyArray1<f64>>> {
        let (py, own) = (this.py(), this.get());
        let make = || Ok::<_, PyErr>(arrays::column(py, own.parts()?.1.inputs.clone()).unbind());
        Ok(own.inputs.get_or_try_init(py, make)?.clone_ref(py))
    }

    /// The sides of all two-valued joints at the samples: an array of shape (n, joints), 1 left, -1 right, and (n, 1) where there is none.
    #[getter]
    fn branches<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i8>>> {
        let (solved, circuit) = self.parts()?;
        branches_of(py, solved, circuit)
    }

    /// The positions of a joint, by its name: an array of shape (n, 2), in the unit of the lengths.
    fn positions<'py>(&self, py: Python<'py>, joint: &str) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (joint, (_, circuit)) = (self.joint(joint)?, self.parts()?);
        arrays::points(py, circuit.points(joint), circuit.len())
    }

    /// The velocities of a joint, by its name: an array of shape (n, 2), per radian, or unit of length, of the input; infinite at limits.
    fn velocities<'py>(&self, py: Python<'py>, joint: &str) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (joint, (solved, circuit)) = (self.joint(joint)?, self.parts()?);
        arrays::rows(py, py.detach(|| velocities_of(solved, circuit, joint)), 2)
    }

    /// The number of samples.
    fn __len__(&self) -> PyResult<usize> {
        Ok(self.parts()?.1.len())
    }

    fn __repr__(&self) -> PyResult<String> {
        let kind = if self.full_turn()? { "a full turn" } else { "between limits" };
        Ok(format!(
            "<coupler_atlas.Circuit {} of {}: {kind}, {} samples>",
            self.number(),
            self.solution.family.id,
            self.__len__()?
        ))
    }
}

/// The equation of a coupler curve, a polynomial of degree 6 in x and y, with the crank's pivot at the origin and the x-axis towards the rocker's.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Sextic {
    inner: linkage::Sextic,
}

#[pymethods]
impl Sextic {
    /// The coefficients: an array of shape (7, 7), of which [i, j] is that of x^i y^j; that of x^6 is 1.
    #[getter]
    fn coefficients<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        // Adding 0 turns -0 into 0.
        let coefficient = |i, j| if i + j <= 6 { self.inner.coefficient(i, j) + 0.0 } else { 0.0 };
        arrays::rows(py, (0..7).flat_map(|i| (0..7).map(move |j| coefficient(i, j))).collect(), 7)
    }

    /// The same with the origin in the middle of the two pivots.
    #[getter]
    fn centred_coefficients<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let centred = self.inner.centred_coefficients();
        arrays::rows(py, centred.iter().flatten().map(|coefficient| coefficient + 0.0).collect(), 7)
    }

    /// The real double points, each as (x, y, kind): ``crunode``, ``cusp`` or ``acnode``.
    #[getter]
    fn double_points(&self) -> Vec<(f64, f64, &'static str)> {
        let points = self.inner.double_points().into_iter();
        points.map(|double| (double.point.x, double.point.y, double.kind.name())).collect()
    }

    /// How often the curve passes through the circular points.
    #[getter]
    fn circular_points(&self) -> usize {
        self.inner.circularity()
    }

    fn __repr__(&self) -> String {
        format!("<coupler_atlas.Sextic with {} real double points>", self.inner.double_points().len())
    }
}

/// A linkage in motion. A notebook shows it; ``save`` writes it as SVG, which browsers play.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Animation {
    /// The animated plate, as SVG without scripts.
    #[pyo3(get)]
    svg: String,
}

#[pymethods]
impl Animation {
    /// Write the animation as SVG.
    fn save(&self, path: PathBuf) -> PyResult<()> {
        coupler_atlas::output::write_file(&path, self.svg.as_bytes())
            .map_err(|error| error::OutputError::new_err(error.to_string()))
    }

    /// The animation in a frame of its own, in which no script runs.
    fn _repr_html_(&self) -> String {
        let page = format!(
            "<!DOCTYPE html><style>body{{margin:0}}svg{{display:block;width:100%;height:auto}}</style>{}",
            self.svg
        );
        let escaped = page.replace('&', "&amp;").replace('"', "&quot;");
        format!(
            "<iframe sandbox title=\"a linkage in motion\" srcdoc=\"{escaped}\" \
             style=\"border:0;width:100%;max-width:800px;aspect-ratio:{}/{}\"></iframe>",
            PAPER.width, PAPER.height
        )
    }

    fn __repr__(&self) -> String {
        format!("<coupler_atlas.Animation, {} bytes of SVG>", self.svg.len())
    }
}

/// Finds a linkage by its id, of `own` and of the catalogue.
fn template(name: &str, own: &[Arc<Template>]) -> PyResult<Arc<Template>> {
    let known: Vec<&Arc<Template>> = own.iter().chain(catalogue::all()).collect();
    let found = known.iter().find(|template| template.id == name).map(|template| Arc::clone(template));
    found.ok_or_else(|| {
        let ids: Vec<&str> = known.iter().map(|template| template.id.as_str()).collect();
        PyValueError::new_err(format!("there is no linkage `{name}`: {}", suggestion(name, &ids)))
    })
}

/// Make a linkage of the catalogue, or of a manifest.
///
/// Parameters
/// ----------
/// name : str
///     The id of the linkage; ``linkages()`` lists those of the catalogue.
/// manifest : path, optional
///     A manifest whose linkages can be named, too.
/// samples : int
///     How many points a curve has.
/// circuits : {"start", "all"}, optional
///     Only the circuit through the start pose, or all; by default what the linkage says.
/// **parameters : float or str
///     Its parameters: numbers, or expressions with units, as in ``phase="30 deg"``.
///
/// Returns
/// -------
/// Linkage
///
/// Raises
/// ------
/// LinkageError
///     A parameter is missing, unknown or out of its range.
/// ValueError
///     There is no such linkage.
#[pyfunction]
#[pyo3(name = "linkage", signature = (name, /, *, manifest=None, samples=360, circuits=None, **parameters))]
pub fn make_linkage(
    py: Python,
    name: &str,
    manifest: Option<PathBuf>,
    samples: usize,
    circuits: Option<&str>,
    parameters: Option<Bound<PyDict>>,
) -> PyResult<Linkage> {
    let mut own = Vec::new();
    if let Some(path) = manifest {
        let text = read_text(py, &path)?;
        let (templates, problems) = manifest::parse_linkages(&text);
        if problems.iter().any(|problem| problem.is_error()) {
            return Err(error::manifest_error(py, &path, &text, &problems));
        }
        own = templates;
    }
    let mut template = template(name, &own)?;
    match circuits {
        None => {}
        Some("start") => Arc::make_mut(&mut template).circuits = CircuitSelection::Start,
        Some("all") => Arc::make_mut(&mut template).circuits = CircuitSelection::All,
        Some(other) => return Err(PyValueError::new_err(format!("circuits={other:?}: give \"start\" or \"all\""))),
    }
    let mut values = Vec::new();
    for (key, value) in parameters.iter().flatten() {
        let key: String = key.extract()?;
        let given = if let Ok(number) = value.extract::<f64>() {
            (key, number)
        } else if let Ok(text) = value.extract::<String>() {
            let parsed = ParameterText::parse(&format!("{key}={text}"))
                .map_err(|error| PyValueError::new_err(error.to_string()))?;
            parsed.resolve(&template).map_err(|error| LinkageError::new_err(format!("{name}: {error}")))?
        } else {
            let kind = value.get_type().name()?;
            return Err(PyTypeError::new_err(format!("{key}: a parameter is a number or an expression, not a {kind}")));
        };
        values.push(given);
    }
    Linkage::of_template(template, &values, samples)
}

/// The ids of the linkages of the catalogue, in order.
#[pyfunction]
pub fn linkages() -> Vec<String> {
    catalogue::all().iter().map(|template| template.id.clone()).collect()
}
