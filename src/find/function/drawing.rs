//! A chart of a wanted function, of what linkages generate, and of the structural error.

use coupler_curves::expression::CompiledExpression;
use coupler_curves::geometry::trig;
use coupler_drawing::chart::{Chart, PointSource, Quantity, Series};
use coupler_drawing::page::{self, ChartPage, Heading, Layout, Options, Paper};
use coupler_drawing::render::{self, TextMode};
use coupler_find::{FunctionAnswer, FunctionTarget};

/// The most linkages of a chart.
const MAX_LINES: usize = 3;

/// The parts of the input at whose ends lines have points: chords of smooth functions then deviate by less than can be seen.
const PARTS: usize = 360;

/// An upright page of A4 with the outputs over the input, both from their starts, and the structural error below, with the places where it is
/// zero, as SVG. `details` are the lines under the title.
pub fn draw_function(title: &str, details: &str, target: &FunctionTarget, answers: &[FunctionAnswer]) -> Vec<u8> {
    let unit = if target.is_length() { "" } else { "deg" };
    let quantity = |title: &str, unit: &'static str| Quantity {
        text: String::new(),
        title: title.to_owned(),
        unit,
        expression: CompiledExpression::constant(0.0),
        is_log: false,
        range: None,
    };
    let chart = Chart {
        point_source: PointSource::Samples,
        x: quantity("input from the start", "deg"),
        y: vec![quantity("output from the start", unit), quantity("structural error", unit)],
        group_by: Vec::new(),
        is_ordered_by_x: true,
    };
    let page = ChartPage {
        heading: Heading::new(title).with_family_id("function").with_source(details),
        layout: Layout::Chart { columns: 1, rows: 2 },
        chart: &chart,
        quantity_range: 0..2,
        series: &series(target, answers),
        key: None,
    };
    let paper = Paper { width: 210.0, height: 297.0 };
    render::svg(&page::compose_charts(&page, &Options::for_paper(paper)), TextMode::Text)
}

fn series(target: &FunctionTarget, answers: &[FunctionAnswer]) -> Vec<Series> {
    let output = |value: f64| if target.is_length() { value } else { trig::degrees(value) };
    let travel_deg = trig::degrees(target.travel());
    let travels: Vec<f64> = (0..=PARTS).map(|k| travel_deg * k as f64 / PARTS as f64).collect();
    let wanted = |travel: f64| target.as_law().map_or(f64::NAN, |law| output(law.wanted(trig::radians(travel))));
    let named = |label: String, number: usize, points: Vec<[f64; 3]>| {
        let column = |k: usize| points.iter().map(|point| point[k]).collect::<Vec<f64>>();
        Series { label, trace: number, circuit: 1, x: column(0), y: vec![column(1), column(2)], ..Series::default() }
    };
    // Points of their own, for no line joins what has a gap between.
    let apart = |points: Vec<[f64; 3]>| -> Vec<[f64; 3]> {
        points.into_iter().flat_map(|point| [point, [point[0], f64::NAN, f64::NAN]]).collect()
    };
    let mut all = Vec::new();
    match target.as_law() {
        Some(_) => {
            all.push(named("wanted".to_owned(), 1, travels.iter().map(|x| [*x, wanted(*x), 0.0]).collect()));
        }
        None => {
            let rows = target.samples().into_iter().map(|[x, y]| [trig::degrees(x), output(y), f64::NAN]);
            all.push(named("wanted".to_owned(), 1, apart(rows.collect())));
        }
    }
    for (rank, answer) in (1..).zip(answers).take(MAX_LINES) {
        let points = travels.iter().map(|x| {
            let generated = answer.generated(*x);
            [*x, generated, generated - wanted(*x)]
        });
        all.push(named(format!("linkage {rank}"), rank + 1, points.collect()));
    }
    let errors_of_rows = |answer: &FunctionAnswer| {
        let error = |[x, y]: [f64; 2]| {
            let travel = trig::degrees(x);
            [travel, f64::NAN, answer.generated(travel) - output(y)]
        };
        target.samples().into_iter().map(error).collect::<Vec<_>>()
    };
    if let Some(best) = answers.first() {
        let zeros = best.error.zeros.iter().map(|input| input - best.input_deg[0]);
        let marks = match target.as_law() {
            Some(_) => zeros.map(|x| [x, wanted(x), 0.0]).collect(),
            None => errors_of_rows(best),
        };
        let label = if target.as_law().is_some() { "no error of linkage 1" } else { "error of linkage 1" };
        all.push(named(label.to_owned(), MAX_LINES + 2, apart(marks)));
    }
    all
}
