//! A family of a single cell as the data of the gallery have families, for a linkage that is in no atlas.

use std::sync::Arc;

use serde_json::{Value, json};

use coupler_curves::catalogue;
use coupler_curves::family::Family;
use coupler_curves::geometry::Bounds;
use coupler_curves::measure::Value as Measured;
use coupler_curves::solve::{MeasuredCurve, SolvedCell, Solver, Status};
use coupler_curves::template::Template;

use crate::family::OpenFamily;
use crate::request::CurveRequest;
use crate::response::Numbers;

/// The code of a curve without a word.
const MISSING_WORD: f64 = 255.0;

/// The linkages of the catalogue: the id, the legend, and a manifest with a family to start from.
pub(crate) fn catalogue_json() -> Value {
    let linkage = |template: &Arc<Template>| {
        let manifest = format!("[atlas]\ntitle = \"{}\"\n{}", template.id, template.starting_family());
        json!({ "id": template.id, "legend": template.legend, "manifest": manifest })
    };
    json!({ "linkages": catalogue::all().iter().map(linkage).collect::<Vec<_>>() })
}

/// The first cell of a family with its curves: the statements of the script of a family of this cell alone.
///
/// # Errors
/// Why it has no curve.
pub(crate) fn first_cell_json(open: &OpenFamily, numbers: &mut Numbers) -> Result<Value, String> {
    let family = &open.planned.family;
    let solved = Solver::new(family).solve(0).ok_or("it has no linkage")?;
    if solved.curves.is_empty() {
        return Err(format!("`{}` has no curve: {}", family.id, solved.reason()));
    }
    Ok(statements_json(family, &open.planned.source, &solved, numbers))
}

/// A curve of a family with its changes: the statements of the script of a family of this curve alone.
///
/// # Errors
/// Why there is no such curve.
pub(crate) fn curve_json(open: &OpenFamily, curve: &CurveRequest, numbers: &mut Numbers) -> Result<Value, String> {
    let (family, solved) = open.solve(curve)?;
    Ok(statements_json(&family, &open.planned.source, &solved, numbers))
}

/// The statements of the script of a family of a single cell, from a source.
fn statements_json(family: &Family, source: &str, solved: &SolvedCell, numbers: &mut Numbers) -> Value {
    let SolvedCell { cell, curves, .. } = solved;
    let mut slots: Vec<usize> = family.space.slots_of(0).collect();
    slots.sort_unstable();
    let measures = |is_word| family.computed_measures().filter(move |(_, measure)| measure.is_word == is_word);
    let names = |is_word| measures(is_word).map(|(_, measure)| measure.name).collect::<Vec<_>>();
    let entry = json!({
        "bytes": 0,
        "cells": 1,
        "curves": curves.len(),
        "numbers": [cell.number, cell.number],
        "pages": 0,
        "traces": family.template.traced.len(),
        "ranges": cell.values.iter().map(|value| [value, value]).collect::<Vec<_>>(),
    });
    let head = json!({
        "title": family.title,
        "source": family.source_without_legend(source),
        "legend": family.legend(),
        "linkage": family.template.id,
        "layout": "panels",
        "panels": null,
        "is_length": family.template.is_driven_by_length(),
        "names": family.names,
        "free": slots,
        "assignments": [slots],
        "measures": names(false),
        "words": names(true),
        "pieces": { "table": [entry], "curves": [entry] },
    });
    let number = |k: usize| {
        curves.iter().map(move |curve| match curve.values.get(k) {
            Some(Measured::Number(value)) => *value,
            _ => f64::NAN,
        })
    };
    let cells = json!({
        "count": 1,
        "number": cell.number,
        "values": cell.values,
        "status": if solved.status() == Status::Ok { 0 } else { 1 },
        "curves": curves.len(),
        "trace": numbers.array(curves.iter().map(|curve| curve.trace as f64)),
        "circuit": numbers.array(curves.iter().map(|curve| curve.circuit as f64)),
        "closed": numbers.array(curves.iter().map(|curve| f64::from(u8::from(solved.circuit(curve).is_closed)))),
        "measures": measures(false).map(|(k, _)| numbers.array(number(k))).collect::<Vec<_>>(),
        "words": measures(true).map(|(k, _)| words_json(curves, k, numbers)).collect::<Vec<_>>(),
    });
    json!({ "head": head, "cells": cells, "curves": outlines_json(family, solved, numbers) })
}

/// The distinct words of the `k`-th measure, and the index of the word of each curve.
fn words_json(curves: &[MeasuredCurve], k: usize, numbers: &mut Numbers) -> Value {
    let mut values: Vec<&str> = Vec::new();
    let codes: Vec<f64> = curves
        .iter()
        .map(|curve| match curve.values.get(k) {
            Some(Measured::Word(word)) => values.iter().position(|known| known == word).unwrap_or_else(|| {
                values.push(word);
                values.len() - 1
            }) as f64,
            _ => MISSING_WORD,
        })
        .collect();
    json!({ "values": values, "codes": numbers.array(codes) })
}

/// The captions of the cell, and the points of its curves to 1/65,535 of their bounds.
fn outlines_json(family: &Family, solved: &SolvedCell, numbers: &mut Numbers) -> Value {
    let [caption, note] = family.format_captions(&solved.cell, solved.first_curve_values());
    let (mut boxes, mut counts, mut points): ([Vec<f64>; 4], Vec<f64>, Vec<f64>) = Default::default();
    for curve in &solved.curves {
        let own: Vec<_> = solved.circuit(curve).points(curve.joint).collect();
        let Bounds { min, max } = Bounds::from_points(own.iter().copied());
        let part = |value: f64, min: f64, max: f64| {
            let part = (value - min) / (max - min);
            if part.is_finite() { (part * f64::from(u16::MAX)).round() } else { 0.0 }
        };
        points.extend(own.iter().flat_map(|p| [part(p.x, min.x, max.x), part(p.y, min.y, max.y)]));
        counts.push(own.len() as f64);
        boxes.iter_mut().zip([min.x, min.y, max.x, max.y]).for_each(|(side, value)| side.push(value));
    }
    json!({
        "reason": [solved.reason()],
        "caption": [caption],
        "note": [note],
        "cells": 1,
        "box": boxes.map(|side| numbers.array(side)),
        "count": numbers.array(counts),
        "curves": solved.curves.len(),
        "points": numbers.array(points),
    })
}
