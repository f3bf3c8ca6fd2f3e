//! The scripts that contain the data of a family, as statements that the page executes.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::piece::{CellData, PieceContent, PieceIndex, PieceSeries};
use super::typed_array::{differences, f64s, u8s, u16s, u32s};
use crate::manifest::{Plan, PlannedFamily};
use coupler_curves::family::Sampling;
use coupler_curves::geometry::{Bounds, Point};
use coupler_curves::measure;
use coupler_curves::solve::{MeasuredCurve, SolvedCell, Status};
use coupler_drawing::page::Layout;
use coupler_drawing::scene::{Group, Item, Scene};

/// The name of the head of the data in the folder of a family.
pub const SCRIPT_FILE: &str = "gallery.js";

/// The greatest number of points of a curve: enough to draw a thumbnail, to select the curve with a pointer, and to
/// compare shapes. The page's kernel solves the linkage to show a curve in detail.
const MAX_POINTS: usize = 128;

/// The code of a missing word.
const MISSING_WORD: u8 = u8::MAX;

/// The statements of the scripts of a family.
#[derive(Clone, Copy, Debug)]
pub struct FamilyScript<'a> {
    plan: &'a Plan,
    planned: &'a PlannedFamily,
}

impl<'a> FamilyScript<'a> {
    /// The scripts of a family of a plan.
    pub fn new(plan: &'a Plan, planned: &'a PlannedFamily) -> FamilyScript<'a> {
        FamilyScript { plan, planned }
    }

    /// The head of the data: what the family is, and the index of its pieces, which is known at the end of a run.
    /// `statements` are those of a family that is small enough to have everything in its head, and otherwise empty.
    pub fn head(self, pieces: &[PieceIndex], statements: &str) -> String {
        let family = &self.planned.family;
        let (paper, is_dark) = (self.plan.page.paper, self.plan.page.theme.paper.is_dark());
        let layout = match self.planned.layout {
            Layout::Panels { .. } | Layout::Poses | Layout::Drawing => "panels",
            Layout::Chart { .. } => "chart",
            Layout::CouplerGrid => "coupler-grid",
        };
        // The pages of a sorted family have their cells in another order.
        let has_panels = layout == "panels" && family.sort.is_none();
        let index = |series: PieceSeries| {
            pieces.iter().filter(|piece| piece.series == series).map(piece_json).collect::<Vec<_>>()
        };
        let begin = statement(
            "begin",
            &json!({
                "id": family.id,
                "title": family.title,
                "source": family.source_without_legend(&self.planned.source),
                "legend": family.legend(),
                "linkage": family.template.id,
                "layout": layout,
                "panels": has_panels.then(|| self.planned.layout.cells_per_page()),
                "sampling": sampling_json(family.sampling),
                "paths": self.path_names(),
                "is_length": family.template.is_driven_by_length(),
                "paper": { "width": paper.width, "height": paper.height, "is_dark": is_dark },
                // What the kernel opens: all that determines a curve whose assigned values are known.
                "manifest": self.planned.excerpt(),
                "names": family.names,
                "free": family.space.assigned_slots(),
                "assignments": self.assignments(),
                "measures": self.measures(false).map(|(_, measure)| measure.name).collect::<Vec<_>>(),
                "words": self.measures(true).map(|(_, measure)| measure.name).collect::<Vec<_>>(),
                "pieces": { "table": index(PieceSeries::Table), "curves": index(PieceSeries::Curves) },
            }),
        );
        format!("{begin}{statements}{}", self.end())
    }

    /// What pages call the curve of each traced joint; none if it is the number of its point.
    fn path_names(self) -> Vec<String> {
        let template = &self.planned.family.template;
        let Ok(linkage) = template.structure() else { return Vec::new() };
        let names = (1..=template.curve_count()).filter_map(|trace| self.planned.layout.curve_name(&linkage, trace));
        let names: Vec<String> = names.map(|name| name.join(" ")).collect();
        if names.iter().all(|name| name.starts_with("point ")) { Vec::new() } else { names }
    }

    /// The first statement of a piece.
    pub fn begin_piece(self, series: PieceSeries, number: usize) -> String {
        statement("piece", &json!({ "id": self.planned.family.id, "series": series.name(), "number": number }))
    }

    /// The statements with some cells and their curves, in order of their numbers.
    pub fn cells(self, solved: &[SolvedCell]) -> CellData {
        let kept: Vec<&SolvedCell> = solved.iter().filter(|solved| !solved.is_left_out()).collect();
        let curves: Vec<(&SolvedCell, &MeasuredCurve)> =
            kept.iter().flat_map(|s| s.curves.iter().map(move |curve| (*s, curve))).collect();
        let (Some(first), Some(last)) = (kept.first(), kept.last()) else { return CellData::default() };
        let range = |slot: usize| {
            let values = || kept.iter().filter_map(|s| s.cell.values.get(slot).copied());
            [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
        };
        let content = PieceContent {
            cells: kept.len(),
            curves: curves.len(),
            pages: 0,
            numbers: Some([first.cell.number, last.cell.number]),
            traces: curves.iter().map(|(_, curve)| curve.trace).max().unwrap_or(0),
            ranges: (0..self.planned.family.names.len()).map(range).collect(),
        };
        CellData { table: self.table_rows(&kept, &curves), curves: self.outlines(&kept, &curves), content }
    }

    /// The distinct lists of slots that parameter sets assign, each in order.
    fn assignments(self) -> Vec<Vec<usize>> {
        self.planned.family.space.distinct_names().into_iter().map(|(_, slots)| slots).collect()
    }

    /// For each cell the index of the list of slots that its parameter set assigns; `None` if there is only one list.
    fn assignment_of_cells(self, kept: &[&SolvedCell]) -> Option<Value> {
        let lists = self.assignments();
        let index = |solved: &&SolvedCell| {
            let mut slots: Vec<usize> = self.planned.family.space.slots_of(solved.cell.number - 1).collect();
            slots.sort_unstable();
            lists.iter().position(|list| *list == slots).unwrap_or(0)
        };
        (lists.len() > 1).then(|| u16s(kept.iter().map(index)))
    }

    /// The measures of the family that are words, or those that are numbers, with their indices.
    fn measures(self, is_word: bool) -> impl Iterator<Item = (usize, &'static measure::Measure)> + 'a {
        self.planned.family.computed_measures().filter(move |(_, measure)| measure.is_word == is_word)
    }

    /// The statement of the table: the values of cells, and the measures of their curves.
    fn table_rows(self, kept: &[&SolvedCell], curves: &[(&SolvedCell, &MeasuredCurve)]) -> String {
        let status = |s: &&SolvedCell| match s.status() {
            Status::Ok => 0,
            Status::Partial => 1,
            Status::None | Status::Failed => 2,
        };
        let number = |curve: &MeasuredCurve, k: usize| match curve.values.get(k) {
            Some(measure::Value::Number(value)) => *value,
            _ => f64::NAN,
        };
        let column = |slot: usize| f64s(kept.iter().map(|s| s.cell.values.get(slot).copied().unwrap_or(f64::NAN)));
        statement(
            "cells",
            &merged(
                rows_json(kept, curves),
                json!({
                    "count": kept.len(),
                    "values": (0..self.planned.family.names.len()).map(column).collect::<Vec<_>>(),
                    "assignment": self.assignment_of_cells(kept),
                    "status": u8s(kept.iter().map(status)),
                    "measures": self
                        .measures(false)
                        .map(|(k, _)| f64s(curves.iter().map(|(_, curve)| number(curve, k))))
                        .collect::<Vec<_>>(),
                    "words": self.measures(true).map(|(k, _)| words_json(curves, k)).collect::<Vec<_>>(),
                }),
            ),
        )
    }

    /// The statement with what is shown of cells and curves: captions and points. It has the rows of the table that say which curves
    /// they are, so that curves are found by their shape without the table.
    fn outlines(self, kept: &[&SolvedCell], curves: &[(&SolvedCell, &MeasuredCurve)]) -> String {
        let family = &self.planned.family;
        let lines: Vec<[String; 2]> =
            kept.iter().map(|s| family.format_captions(&s.cell, s.first_curve_values())).collect();
        let points: Vec<Vec<Point>> = curves.iter().map(|(solved, curve)| thinned_points(solved, curve)).collect();
        let boxes: Vec<Bounds> = points.iter().map(|points| Bounds::from_points(points.iter().copied())).collect();
        let side = |of: fn(&Bounds) -> f64| f64s(boxes.iter().map(of));
        let quantized: Vec<Vec<[u16; 2]>> = points
            .iter()
            .zip(&boxes)
            .map(|(points, bounds)| points.iter().map(|p| quantize(*p, bounds)).collect())
            .collect();
        let value = json!({
            "reason": texts(kept.iter().map(|s| s.reason())),
            "caption": texts(lines.iter().map(|[caption, _]| caption.clone())),
            "note": texts(lines.iter().map(|[_, note]| note.clone())),
            "cells": kept.len(),
            "rows": rows_json(kept, curves),
            "box": [side(|b| b.min.x), side(|b| b.min.y), side(|b| b.max.x), side(|b| b.max.y)],
            "count": u16s(points.iter().map(Vec::len)),
            "curves": curves.len(),
        });
        // The page keeps the literals of a script as long as its text, but a comment is only in the text.
        format!("couplerAtlas.curves({value},()=>{{/*{}*/}});\n", differences(&quantized))
    }

    /// A statement with the layout of a page: for each view, the cell, the scale and origin that map the plane to
    /// millimetres on paper, and the trace and the circuit of each curve drawn with them, one after another.
    pub fn page(self, number: usize, scene: &Scene) -> String {
        let mut views: Vec<Value> = Vec::new();
        let mut last = Vec::new();
        for (view, curve) in drawn_curves(&scene.items) {
            if view != last || views.is_empty() {
                let [cell, scale, x, y] = [0, 1, 2, 3].map(|k| view.get(k).copied().unwrap_or(f64::NAN));
                views.push(json!({ "cell": cell, "scale": scale, "origin": [x, y], "curves": [] }));
                last = view;
            }
            if let Some(Value::Array(curves)) = views.last_mut().and_then(|view| view.get_mut("curves")) {
                curves.extend(curve.map(Value::from));
            }
        }
        statement("page", &json!({ "page": number, "views": views }))
    }

    /// The last statement of the head, and of each piece.
    pub fn end(self) -> String {
        statement("end", &json!({ "id": self.planned.family.id }))
    }
}

/// A call of a function of the page; its argument is JSON, which escapes any text in it.
pub(super) fn statement(name: &str, value: &Value) -> String {
    format!("couplerAtlas.{name}({value});\n")
}

/// Which cells and curves some are: the numbers of the cells, the number of curves of each, the trace and the circuit of each
/// curve, and whether it is closed.
fn rows_json(kept: &[&SolvedCell], curves: &[(&SolvedCell, &MeasuredCurve)]) -> Value {
    let numbers: Vec<usize> = kept.iter().map(|s| s.cell.number).collect();
    let is_run = numbers.windows(2).all(|pair| pair[0] + 1 == pair[1]);
    json!({
        // The first number, if the others follow it.
        "number": if is_run { json!(numbers.first()) } else { u32s(numbers) },
        "curves": u16s(kept.iter().map(|s| s.curves.len())),
        "trace": u16s(curves.iter().map(|(_, curve)| curve.trace)),
        "circuit": u16s(curves.iter().map(|(_, curve)| curve.circuit)),
        "closed": u8s(curves.iter().map(|(solved, curve)| u8::from(solved.circuit(curve).is_closed))),
    })
}

/// The sampling as JSON, with the keys of a manifest.
fn sampling_json(sampling: Sampling) -> Value {
    match sampling {
        Sampling::Step(step) => json!({ "step": step }),
        Sampling::Samples(samples) => json!({ "samples": samples }),
        Sampling::DenseAtLimits(samples) => json!({ "samples": samples, "spacing": "smooth" }),
        Sampling::ArcLength(samples) => json!({ "samples": samples, "spacing": "arc" }),
    }
}

/// The words of the `k`-th measure: a list of the distinct words, and for each curve the index of its word.
fn words_json(curves: &[(&SolvedCell, &MeasuredCurve)], k: usize) -> Value {
    let mut values: BTreeMap<&str, u8> = BTreeMap::new();
    let word = |curve: &MeasuredCurve| match curve.values.get(k) {
        Some(measure::Value::Word(word)) => Some(*word),
        _ => None,
    };
    for word in curves.iter().filter_map(|(_, curve)| word(curve)) {
        let next = u8::try_from(values.len()).unwrap_or(MISSING_WORD);
        values.entry(word).or_insert(next);
    }
    let mut words: Vec<(&str, u8)> = values.iter().map(|(word, code)| (*word, *code)).collect();
    words.sort_by_key(|(_, code)| *code);
    let code = |curve: &MeasuredCurve| word(curve).and_then(|word| values.get(word).copied()).unwrap_or(MISSING_WORD);
    json!({
        "values": words.iter().map(|(word, _)| *word).collect::<Vec<_>>(),
        "codes": u8s(curves.iter().map(|(_, curve)| code(curve))),
    })
}

/// Some texts; an empty list if all are empty.
fn texts(texts: impl Iterator<Item = String>) -> Value {
    let texts: Vec<String> = texts.collect();
    if texts.iter().all(String::is_empty) { json!([]) } else { json!(texts) }
}

/// The entry of a piece in the index of the head.
fn piece_json(piece: &PieceIndex) -> Value {
    let PieceContent { cells, curves, pages, numbers, traces, ranges } = &piece.content;
    let entry = json!({ "bytes": piece.bytes, "cells": cells, "curves": curves, "numbers": numbers });
    let further = match piece.series {
        PieceSeries::Table => json!({ "traces": traces, "ranges": ranges }),
        PieceSeries::Curves => json!({ "pages": pages }),
    };
    merged(entry, further)
}

/// An object with the keys of another one, too.
fn merged(object: Value, further: Value) -> Value {
    match (object, further) {
        (Value::Object(object), Value::Object(further)) => Value::Object(object.into_iter().chain(further).collect()),
        (object, _) => object,
    }
}

/// At most [`MAX_POINTS`] points of a curve, including the first and, of an open curve, the last.
fn thinned_points(solved: &SolvedCell, curve: &MeasuredCurve) -> Vec<Point> {
    let circuit = solved.circuit(curve);
    let all: Vec<Point> = circuit.points(curve.joint).filter(|p| p.x.is_finite() && p.y.is_finite()).collect();
    if all.len() <= MAX_POINTS {
        return all;
    }
    let steps = if circuit.is_closed { MAX_POINTS } else { MAX_POINTS - 1 };
    let length = if circuit.is_closed { all.len() } else { all.len() - 1 };
    (0..MAX_POINTS).map(|k| all[k * length / steps]).collect()
}

/// The position of a point in the bounds of its curve, from 0 to 65,535.
fn quantize(p: Point, bounds: &Bounds) -> [u16; 2] {
    let scaled = |value: f64, min: f64, max: f64| {
        let ratio = (value - min) / (max - min);
        if ratio.is_finite() { (ratio * f64::from(u16::MAX)).round() as u16 } else { 0 }
    };
    [scaled(p.x, bounds.min.x, bounds.max.x), scaled(p.y, bounds.min.y, bounds.max.y)]
}

/// The curves drawn by some items, in order: the cell, scale and origin of each as four numbers, and its trace and
/// circuit.
fn drawn_curves(items: &[Item]) -> Vec<(Vec<f64>, [usize; 2])> {
    let mut curves = Vec::new();
    for item in items {
        if let Item::Group(group) = item {
            match drawn_curve(group) {
                Some(curve) => curves.push(curve),
                None => curves.extend(drawn_curves(&group.items)),
            }
        }
    }
    curves
}

/// The curve drawn by a group, from its data attributes.
fn drawn_curve(group: &Group) -> Option<(Vec<f64>, [usize; 2])> {
    let attribute = |name: &str| group.data.iter().find(|(known, _)| *known == name).map(|(_, value)| value.as_str());
    let numbers: Vec<f64> = [attribute("cell")?, attribute("scale")?]
        .into_iter()
        .chain(attribute("origin")?.split(' '))
        .filter_map(|number| number.parse().ok())
        .collect();
    Some((numbers, [attribute("trace")?.parse().ok()?, attribute("circuit")?.parse().ok()?]))
}
