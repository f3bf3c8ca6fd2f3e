//! A chart of a wanted function, of what linkages generate, and of the structural error.

use coupler_curves::expression::CompiledExpression;
use coupler_curves::geometry::trig;
use coupler_drawing::chart::{Chart, PointSource, Quantity, Series};
use coupler_drawing::page::{self, ChartPage, Heading, Layout, Options, Paper};
use coupler_drawing::render::{self, TextMode};
use coupler_find::{FunctionAnswer, FunctionTarget, LinkageFunctionAnswer};

/// The most linkages of a chart.
const MAX_LINES: usize = 3;

/// The parts of the input at whose ends lines have points: chords of smooth functions then deviate by less than can be seen.
const PARTS: usize = 360;

/// An upright page of A4 with the outputs over the input, both from their starts, and the structural error below, with the places where it is
/// zero, as SVG. `details` are the lines under the title.
pub fn draw_function(title: &str, details: &str, target: &FunctionTarget, answers: &[FunctionAnswer]) -> Vec<u8> {
    let lines: Vec<Line> = answers.iter().take(MAX_LINES).map(|answer| Line::of(target, answer)).collect();
    draw(title, details, target, &lines)
}

/// The same of a linkage whose dimensions have been found, without places of no error.
pub fn draw_linkage_function(
    title: &str,
    details: &str,
    target: &FunctionTarget,
    answers: &[LinkageFunctionAnswer],
) -> Vec<u8> {
    let line = |answer: &LinkageFunctionAnswer| {
        let at = |travels: &[f64]| answer.generated(travels).unwrap_or(vec![f64::NAN; travels.len()]);
        Line { outputs: at(&travels_deg(target)), outputs_at_samples: at(&sample_travels(target)), zeros: Vec::new() }
    };
    let lines: Vec<Line> = answers.iter().take(MAX_LINES).map(line).collect();
    draw(title, details, target, &lines)
}

/// What a linkage generates.
struct Line {
    /// The outputs at [`travels_deg`] and at [`sample_travels`].
    outputs: Vec<f64>,
    outputs_at_samples: Vec<f64>,
    /// The travels at which it has no error.
    zeros: Vec<f64>,
}

impl Line {
    fn of(target: &FunctionTarget, answer: &FunctionAnswer) -> Line {
        let at = |travels: Vec<f64>| travels.into_iter().map(|travel| answer.generated(travel)).collect();
        Line {
            outputs: at(travels_deg(target)),
            outputs_at_samples: at(sample_travels(target)),
            zeros: answer.error.zeros.iter().map(|input| input - answer.input_deg[0]).collect(),
        }
    }
}

/// The travels of the input at which lines have points, in degrees.
fn travels_deg(target: &FunctionTarget) -> Vec<f64> {
    let all = trig::degrees(target.travel());
    (0..=PARTS).map(|k| all * k as f64 / PARTS as f64).collect()
}

/// The travels of the input at the rows, or at the samples of a law, in degrees.
fn sample_travels(target: &FunctionTarget) -> Vec<f64> {
    target.samples().iter().map(|[x, _]| trig::degrees(*x)).collect()
}

fn draw(title: &str, details: &str, target: &FunctionTarget, lines: &[Line]) -> Vec<u8> {
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
        series: &series(target, lines),
        key: None,
    };
    let paper = Paper { width: 210.0, height: 297.0 };
    render::svg(&page::compose_charts(&page, &Options::for_paper(paper)), TextMode::Text)
}

fn series(target: &FunctionTarget, lines: &[Line]) -> Vec<Series> {
    let output = |value: f64| if target.is_length() { value } else { trig::degrees(value) };
    let travels = travels_deg(target);
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
    for (rank, line) in (1..).zip(lines) {
        let points = travels.iter().zip(&line.outputs).map(|(x, there)| [*x, *there, there - wanted(*x)]);
        all.push(named(format!("linkage {rank}"), rank + 1, points.collect()));
    }
    if let Some(best) = lines.first() {
        let samples = target.samples();
        let of_rows = samples
            .iter()
            .zip(&best.outputs_at_samples)
            .map(|([x, y], there)| [trig::degrees(*x), f64::NAN, there - output(*y)]);
        let (label, marks): (&str, Vec<[f64; 3]>) = match target.as_law() {
            Some(_) => ("no error of linkage 1", best.zeros.iter().map(|x| [*x, wanted(*x), 0.0]).collect()),
            None => ("error of linkage 1", of_rows.collect()),
        };
        if !marks.is_empty() {
            all.push(named(label.to_owned(), MAX_LINES + 2, apart(marks)));
        }
    }
    all
}
