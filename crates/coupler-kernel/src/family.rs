//! Open families: what is needed to study and export their curves.

use serde_json::{Value, json};

use coupler_curves::exchange::{CurveName, ParameterSet, SelectedCurve, manifest_fragment};
use coupler_curves::expression::CompiledExpression;
use coupler_curves::family::{Case, Family};
use coupler_curves::problem::Problem;
use coupler_curves::solve::{ChangedCell, SolvedCell, Solver};
use coupler_curves::template::{CircuitSelection, JointKindTemplate, ParameterKind};
use coupler_drawing::curve_file::{self, CurveFormat, FileOptions};
use coupler_drawing::plate::PAPER;
use coupler_drawing::render::Format;
use coupler_manifest::PlannedFamily;

use crate::request::CurveRequest;

/// An open family.
#[derive(Debug)]
pub(crate) struct OpenFamily {
    pub planned: PlannedFamily,
    /// How its curves are exported.
    pub options: FileOptions,
}

/// A name of a family: of a parameter of its linkage, or of a helper.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Name<'a> {
    /// Its index among all.
    pub slot: usize,
    pub name: &'a str,
    /// The least and the greatest value; 0 is exclusive.
    pub min: Option<f64>,
    pub max: Option<f64>,
    pub is_whole: bool,
    /// The unit of an angle: "deg" or "rad".
    pub unit: Option<&'static str>,
    /// Whether an expression of other names gives its value.
    pub is_derived: bool,
}

impl OpenFamily {
    /// Opens the first family of a manifest.
    ///
    /// # Errors
    /// The errors of the manifest, one on a line.
    pub fn from_manifest(manifest: &str) -> Result<OpenFamily, String> {
        let outcome = coupler_manifest::parse_for_formats(manifest, &Format::ALL, None);
        let messages = || {
            let errors = outcome.problems.iter().filter(|problem| problem.is_error());
            errors.map(|Problem { message, .. }| message.as_str()).collect::<Vec<_>>().join("\n")
        };
        let plan = outcome.plan.as_ref().ok_or_else(messages)?;
        let planned = plan.families.first().ok_or("the manifest has no family")?.clone();
        let options = FileOptions {
            page: plan.page.clone().with_paper(PAPER),
            text_mode: plan.text_mode,
            chord_tolerance: FileOptions::DEFAULT_CHORD_TOLERANCE,
        };
        Ok(OpenFamily { planned, options })
    }

    /// The names whose values may be changed, and what these may be.
    pub fn names<'n>(&'n self) -> Vec<Name<'n>> {
        let Family { names, template, derived, .. } = &self.planned.family;
        let is_whole = |name: &str| {
            template.joints.iter().any(|joint| match &joint.kind {
                JointKindTemplate::Gear { ratio, .. } => {
                    ratio.iter().any(|part| part.name_or_number().as_deref() == Some(name))
                }
                _ => false,
            })
        };
        let name = |(slot, name): (usize, &'n String)| {
            let parameter = template.parameters.get(slot);
            let [min, max] = parameter.map(|parameter| [parameter.min, parameter.max]).unwrap_or_default();
            let unit = parameter.and_then(|parameter| match parameter.kind {
                ParameterKind::Angle(unit) => Some(unit.name()),
                _ => None,
            });
            let expression = derived.iter().find(|(other, _)| *other == slot).map(|(_, expression)| expression);
            let is_derived = expression.is_some_and(|expression: &CompiledExpression| !expression.slots().is_empty());
            Name { slot, name, min, max, is_whole: is_whole(name), unit, is_derived }
        };
        names.iter().enumerate().map(name).collect()
    }

    /// What the page has to know of the family.
    pub fn description(&self) -> Value {
        let template = &self.planned.family.template;
        let name = |Name { name, min, max, is_whole, unit, is_derived, .. }: &Name| json!({ "name": name, "min": min, "max": max, "is_whole": is_whole, "unit": unit, "is_derived": is_derived });
        json!({
            "names": self.names().iter().map(name).collect::<Vec<_>>(),
            "is_length": template.is_driven_by_length(),
            "has_all_circuits": template.circuits == CircuitSelection::All,
        })
    }

    /// The cell of a curve with its changes.
    ///
    /// # Errors
    /// What is wrong with the values or the changes, one on a line.
    pub fn changed_cell(&self, curve: &CurveRequest) -> Result<ChangedCell, String> {
        let family = &self.planned.family;
        let slot = |name: &str| family.names.iter().position(|known| known == name);
        let value = |(name, value): &(String, f64)| {
            slot(name).map(|slot| (slot, *value)).ok_or_else(|| format!("there is no `{name}`"))
        };
        let case: Case = curve.values.iter().map(value).collect::<Result<_, _>>()?;
        let [trace, _] = curve.curve;
        ChangedCell::from_case(family, (curve.cell, case), Some(trace), &curve.changes)
            .map_err(|errors| errors.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
    }

    /// Solves the cell of a curve as the program does: a family of the cell alone, and the cell with this curve alone.
    ///
    /// # Errors
    /// Why there is no such curve.
    pub fn solve(&self, request: &CurveRequest) -> Result<(Family, SolvedCell), String> {
        let ChangedCell { family, numbers, circuit } = self.changed_cell(request)?;
        let solved = Solver::new(&family).solve(0).ok_or("it has no linkage")?;
        let reason = solved.reason();
        let mut solved = numbers.restore(solved);
        let [trace, named] = request.curve;
        let wanted = [trace, circuit.unwrap_or(named)];
        solved.curves.retain(|curve| [curve.trace, curve.circuit] == wanted);
        match solved.curves.is_empty() {
            true if reason.is_empty() => Err("this circuit no longer exists".to_owned()),
            true => Err(reason),
            false => Ok((family, solved)),
        }
    }

    /// Solves a curve, and calls `work` with it.
    ///
    /// # Errors
    /// Why there is no such curve.
    fn with_selected_curve<T>(
        &self,
        request: &CurveRequest,
        work: impl FnOnce(&SelectedCurve) -> T,
    ) -> Result<T, String> {
        let (family, solved) = self.solve(request)?;
        let curves = SelectedCurve::all_from_cell(&family, &self.planned.source, &request.changes, &solved);
        curves.first().map(work).ok_or_else(|| "there is no such curve".to_owned())
    }

    /// The name of a curve, which is solved only if its number may have changed.
    fn curve_name(&self, request: &CurveRequest) -> Result<String, String> {
        if !request.changes.is_empty() {
            return self.with_selected_curve(request, |curve| curve.name());
        }
        let family = self.planned.family.id.clone();
        let (cell, curve) = (Some(request.cell), Some(request.curve));
        Ok(CurveName { family, cell, curve, overrides: Vec::new() }.to_string())
    }

    /// A curve in a format: the name of the file and its text.
    ///
    /// # Errors
    /// Why there is no such curve, or no such format.
    pub fn export(&self, request: &CurveRequest, format: &str) -> Result<Value, String> {
        let known = CurveFormat::ALL.into_iter().find(|known| known.name() == format);
        let format = known.ok_or_else(|| format!("there is no format `{format}`"))?;
        self.with_selected_curve(request, |curve| {
            let bytes = curve_file::bytes(curve, format, &self.options);
            json!({ "name": format.file_name(curve), "text": String::from_utf8_lossy(&bytes) })
        })
    }
}

/// A manifest fragment with the cells of some curves of open families.
///
/// # Errors
/// Why there is no such curve.
pub(crate) fn fragment(curves: &[(&OpenFamily, &CurveRequest)]) -> Result<String, String> {
    let changed: Vec<(ChangedCell, String)> = curves
        .iter()
        .map(|(family, request)| Ok((family.changed_cell(request)?, family.curve_name(request)?)))
        .collect::<Result<_, String>>()?;
    let set = |(ChangedCell { family, .. }, name): &(ChangedCell, String)| {
        let values = family.parameter_values(&family.cell(0)).to_vec();
        (family.clone(), values, name.clone())
    };
    let owned: Vec<(Family, Vec<f64>, String)> = changed.iter().map(set).collect();
    let sets: Vec<ParameterSet> = owned
        .iter()
        .map(|(family, values, name)| ParameterSet { family, values: values.clone(), curve_name: name.clone() })
        .collect();
    Ok(manifest_fragment(&sets))
}
