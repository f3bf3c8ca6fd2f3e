//! Charts: their manifest keys, their lines against the tables, and the positions of their points on the page.

use coupler_atlas::manifest;
use coupler_atlas::sweep;
use coupler_curves::geometry::trig;
use coupler_curves::problem::report;
use coupler_curves::solve;
use coupler_drawing::chart::{ChartBuilder, ChartData, ForEachInterval, MAX_NUMBERS, PointSource, Series};

use crate::support::folder::Atlas;
use crate::support::plan::plan;
use crate::support::table::rows;

const GOOD: &str = r#"[atlas]
title = "T"
formats = ["svg"]
output = "out"
[[family]]
id = "evans"
linkage = "evans"
layout = "chart"
chart = { x = "p", y = ["length", "mu_min_deg"] }
sampling = { step = "10 deg" }
grid = { p = [2, 3, 4], k = [1.5, 2] }
let = { a = "(1 + p)^1.5 / 2" }
"#;

/// The lines of the first family's chart, which join the points of its cells.
fn series(text: &str) -> Vec<Series> {
    chart_data(text, |builder| builder.build()).series
}

/// The lines of the first family's chart as they are drawn.
fn refined(text: &str) -> Vec<Series> {
    let for_each: ForEachInterval = &|intervals, refine| intervals.iter_mut().for_each(refine);
    chart_data(text, |builder| builder.build_refined(for_each)).series
}

fn chart_data(text: &str, build: impl FnOnce(ChartBuilder) -> ChartData) -> ChartData {
    let plan = plan(text);
    let planned = &plan.families[0];
    let chart = planned.chart.as_ref().unwrap();
    let mut builder = ChartBuilder::new(chart, &planned.family);
    let kept = sweep::kept_cells(&planned.family);
    let sample = |_, solved: Vec<solve::SolvedCell>| {
        solved.iter().flat_map(|solved| chart.sample_cell(&planned.family, solved)).collect::<Vec<_>>()
    };
    let groups = sweep::CellGroups {
        cells: &kept,
        first_group: 0,
        size: 4,
        work_bytes: 0,
        requested_measures: None,
        solve_known: None,
    };
    sweep::process_groups(&planned.family, groups, sample, |samples| -> Result<(), ()> {
        samples.into_iter().for_each(|sample| builder.add(sample));
        Ok(())
    })
    .unwrap();
    build(builder)
}

fn rendered(text: &str) -> Atlas {
    Atlas::rendered(text, &[])
}

fn page(atlas: &Atlas, number: usize) -> String {
    atlas.read(&format!("evans/evans-{number:03}.svg"))
}

#[test]
fn each_mistake_has_its_message_and_place() {
    let chart = "chart = { x = \"p\", y = [\"length\", \"mu_min_deg\"] }";
    let with = |chart: &str| format!("chart = {{ {chart} }}");
    let cases = [
        (chart, String::new(), "the layout is `chart`, but there is no `chart`", "8:10"),
        ("layout = \"chart\"\n", String::new(), "there is a `chart`, but the layout is not `chart`", "8:9"),
        ("\"chart\"", "\"charts\"".into(), "`charts` is not one of the words allowed here", "8:10"),
        (chart, with("x = \"p\""), "`chart` has no `y`", "9:9"),
        (chart, with("y = \"length\""), "`chart` has no `x`", "9:9"),
        (chart, with("x = \"p\", y = []"), "`y` is empty", "9:24"),
        (chart, with("x = \"p\", y = 3"), "expected a string, found a number", "9:24"),
        (chart, with("x = \"q\", y = \"length\""), "unknown name `q`", "9:16"),
        (chart, with("x = \"p\", y = \"lenght\""), "unknown name `lenght`", "9:25"),
        (chart, with("x = \"p\", y = \"length +\""), "unexpected end of the expression", "9:33"),
        (chart, with("x = \"p\", y = \"is_crank_rocker\""), "expected a number, found a condition", "9:25"),
        (chart, with("x = \"p\", y = [\"length\", \"length\"]"), "`length` is named twice", "9:35"),
        (
            chart,
            with("x = \"p\", y = [\"length\", \"speed\"]"),
            "`speed` has a value for each sample, and `p` one for each curve",
            "9:35",
        ),
        (chart, with("x = \"p\", y = \"length\", by = [\"h\"]"), "there is no `h`", "9:40"),
        (chart, with("x = \"p\", y = \"length\", log = \"area\""), "the chart has no quantity `area`", "9:40"),
        (
            chart,
            with("x = \"p\", y = \"length\", range = { area = [0, 1] }"),
            "the chart has no quantity `area`",
            "9:44",
        ),
        (chart, with("x = \"p\", y = \"length\", range = { p = [3, 1] }"), "[3, 1] is not a range", "9:48"),
        (chart, with("x = \"p\", y = \"length\", range = { p = [3] }"), "expected two values, found 1", "9:48"),
        (
            chart,
            with("x = \"p\", y = \"length\", log = \"p\", range = { p = [0, 1] }"),
            "a logarithmic axis cannot begin at 0",
            "9:59",
        ),
        (chart, with("x = \"p\", y = \"length\", titles = \"T\""), "`chart` has no key `titles`", "9:34"),
        (chart, with("x = \"p\", y = \"length\", title = \"T\""), "expected a table, found a string", "9:42"),
        (
            chart,
            with("x = \"p\", y = \"length\", title = { area = \"A\" }"),
            "the chart has no quantity `area`",
            "9:44",
        ),
        ("sampling", "panels = [40, 1]\nsampling".into(), "invalid value `40`", "10:11"),
        (
            "k = [1.5, 2]",
            "h = [1.5, 2]".into(),
            "`h` is not a parameter of `evans`, and no expression uses it",
            "11:25",
        ),
        (
            "k = [1.5, 2] }",
            "k = { from = 1, to = 2, count = 50000 } }\nlimit = 1000000".into(),
            "a chart can have at most 100000 cells",
            "9:9",
        ),
        ("linkage = \"evans\"", "linkage = \"evens\"".into(), "there is no linkage `evens`", "7:11"),
    ];
    for (from, to, message, place) in cases {
        let text = GOOD.replacen(from, &to, 1);
        assert_ne!(text, GOOD, "{from}");
        let loaded = manifest::parse(&text);
        let printed = report(&loaded.problems, "atlas.toml", &text, false);
        assert!(loaded.plan.is_none() && loaded.problems.len() == 1, "{message}:\n{printed}");
        assert!(
            printed.contains(message) && printed.contains(&format!("atlas.toml:{place}\n")),
            "{message}, {place}:\n{printed}"
        );
        assert!(!loaded.problems[0].help.is_empty());
    }
    // Expressions are parsed even if the linkage is unknown.
    let text = GOOD.replace("linkage = \"evans\"", "linkage = \"evens\"").replace("\"length\"", "\"length +\"");
    assert!(report(&manifest::parse(&text).problems, "m", &text, false).contains("unexpected end of the expression"));
}

#[test]
fn a_chart_may_use_helpers_and_expressions() {
    let text = GOOD.replace("k = [1.5, 2]", "h = [1.5, 2]").replace("\"length\"", "\"length / h\"");
    assert_eq!(series(&text).len(), 2);
}

/// There is a line for each value of the grid's other axes, in order of x; each point is a row of `cells.csv`.
#[test]
fn lines_over_curves_match_the_rows_of_cells_csv() {
    let text = GOOD.replace("[2, 3, 4]", "[4, 2, 3]").replace("\"length\"", "\"length / area\"");
    let found = series(&text);
    assert_eq!(found.iter().map(|series| series.label.as_str()).collect::<Vec<_>>(), ["k = 1.5", "k = 2"]);
    let atlas = rendered(&text);
    let rows = rows(&atlas.read("evans/cells.csv"));
    for (series, k) in found.iter().zip(["1.5", "2"]) {
        assert_eq!(series.x, [2.0, 3.0, 4.0]);
        for (point, p) in ["2", "3", "4"].iter().enumerate() {
            let row = rows.iter().find(|row| row["p"] == *p && row["k"] == k).unwrap();
            let number = |name: &str| row[name].parse::<f64>().unwrap();
            assert_eq!(series.y[0][point], number("length") / number("area"));
            assert_eq!(series.y[1][point], number("mu_min_deg"));
        }
    }
}

/// A line has every sample, and the first again where the curve closes.
#[test]
fn lines_over_samples_match_the_rows_of_points_csv() {
    let chart = "chart = { x = \"arc\", y = [\"speed\", \"x + y\", \"input_deg\", \"length\"] }\ncolumns = [\"speed\"]";
    let text = GOOD.replace("chart = { x = \"p\", y = [\"length\", \"mu_min_deg\"] }", chart);
    assert_eq!(plan(&text).families[0].chart.as_ref().unwrap().point_source, PointSource::Samples);
    let found = series(&text);
    assert_eq!(found.len(), 6);
    assert_eq!(found[1].label, "p = 2, k = 2");
    let atlas = rendered(&text);
    let rows = rows(&atlas.read("evans/points.csv"));
    for series in &found {
        let cell = series.cell.unwrap().to_string();
        let cell_rows: Vec<_> = rows.iter().filter(|row| row["cell"] == cell).collect();
        assert_eq!(series.x.len(), cell_rows.len() + 1);
        let mut chords = 0.0;
        for (k, row) in cell_rows.iter().enumerate() {
            let number =
                |row: &std::collections::BTreeMap<String, String>, name: &str| row[name].parse::<f64>().unwrap();
            assert_eq!(series.y[0][k], number(row, "speed"));
            assert_eq!(series.y[1][k], number(row, "x") + number(row, "y"));
            assert_eq!(series.y[2][k], number(row, "input_deg"));
            if k > 0 {
                let step = |name: &str| number(row, name) - number(cell_rows[k - 1], name);
                chords += trig::hypot(step("x"), step("y"));
            }
            // An arc is longer than its chord: over ten degrees by a few parts in a thousand, at sharp ends by more.
            assert!((chords..=1.05 * chords).contains(&series.x[k]), "{} {chords}", series.x[k]);
        }
        let last = series.x.len() - 1;
        assert_eq!((series.y[0][last], series.y[2][last]), (series.y[0][0], 360.0));
        // The length of the whole path is the measure, except for the order of the summation.
        assert!((series.x[last] / series.y[3][0] - 1.0).abs() < 1e-14);
    }
}

/// A rocker's circuit goes back and forth: the input ends where it began.
#[test]
fn a_rocking_circuit_returns_to_its_start() {
    let text = GOOD
        .replace("linkage = \"evans\"", "linkage = \"watt\"")
        .replace("chart = { x = \"p\", y = [\"length\", \"mu_min_deg\"] }", "chart = { x = \"input_deg\", y = \"y\" }")
        .replace("grid = { p = [2, 3, 4], k = [1.5, 2] }", "cases = [{ p = 4, r = 2, s = 2, a = 1 }]")
        .replace("let = { a = \"(1 + p)^1.5 / 2\" }\n", "");
    let [series] = &series(&text)[..] else { panic!("one line") };
    let last = series.x.len() - 1;
    assert!((series.x[0] - series.x[last]).abs() < 1e-12 && series.y[0][0] == series.y[0][last]);
    assert!(series.label.is_empty());
}

#[test]
fn left_out_cells_and_missing_values_are_gaps() {
    let five = GOOD.replace("[2, 3, 4], k = [1.5, 2]", "[2, 3, 4, 5, 6]");
    let xs = |text: &str| series(text).into_iter().map(|series| series.x).collect::<Vec<_>>();
    assert_eq!(xs(&five), [[2.0, 3.0, 4.0, 5.0, 6.0]]);
    let gap = &xs(&(five.clone() + "where = \"p != 4\"\n"))[0];
    assert_eq!(gap[..2], [2.0, 3.0]);
    assert!(gap[2].is_nan() && gap[3..] == [5.0, 6.0]);
    // Cells that are left out at the ends make no gap.
    assert_eq!(xs(&(five.clone() + "where = \"3 <= p and p <= 5\"\n")), [[3.0, 4.0, 5.0]]);
    // A measure that does not apply: the least input of a full turn.
    let missing = five.replace("\"length\"", "\"input_min_deg\"");
    assert!(series(&missing)[0].y[0].iter().all(|y| y.is_nan()));
    // A case that cannot be assembled.
    let cases = five
        .replace("grid = { p = [2, 3, 4, 5, 6] }", "cases = [{ p = 2, s = 2 }, { p = 20, s = 1 }, { p = 3, s = 3 }]");
    let cases = cases.replace("x = \"p\"", "x = \"s\"");
    let gap = &xs(&cases)[0];
    assert_eq!(gap[..], [2.0, 3.0], "the missing case is the first in order");
}

#[test]
fn by_selects_the_names_that_separate_lines() {
    let labels = |text: &str| series(text).into_iter().map(|series| series.label).collect::<Vec<_>>();
    let by = |by: &str| GOOD.replace("\"mu_min_deg\"] }", &format!("\"mu_min_deg\"], by = {by} }}"));
    assert_eq!(labels(&by("[]")), [""]);
    assert_eq!(labels(&by("[\"p\"]")), ["p = 2", "p = 3", "p = 4"]);
    // `a` is derived from p, which then does not separate lines.
    assert_eq!(labels(&GOOD.replace("x = \"p\"", "x = \"a\"")), ["k = 1.5", "k = 2"]);
    // Over a measure, lines run along the last axis.
    let over_measure = GOOD.replace("x = \"p\"", "x = \"area\"");
    assert_eq!(labels(&over_measure), ["p = 2", "p = 3", "p = 4"]);
    let circuits = GOOD.replace("sampling", "circuits = \"all\"\nsampling").replace(", k = [1.5, 2]", "");
    assert_eq!(labels(&circuits), ["circuit 1", "circuit 2"]);
}

/// The numbers of a `data-` attribute.
fn attribute(text: &str, name: &str) -> Vec<f64> {
    let value = text.split(&format!("data-{name}=\"")).nth(1).unwrap().split('"').next().unwrap();
    value.split(' ').map(|number| number.parse().unwrap()).collect()
}

/// The numbers after `name="` in each element.
fn values(text: &str, name: &str) -> Vec<f64> {
    let start = format!(" {name}=\"");
    text.split(&start).skip(1).map(|part| part.split('"').next().unwrap().parse().unwrap()).collect()
}

/// Marks are where the ticks, and the ranges in the attributes of the group, place their values.
#[test]
fn points_are_drawn_at_their_values() {
    let text = GOOD.replace(", k = [1.5, 2]", "").replace("\"mu_min_deg\"]", "\"mu_min_deg\"], log = \"mu_min_deg\"");
    let found = &series(&text)[0];
    let svg = page(&rendered(&text), 1);
    for (k, chart) in svg.split("class=\"chart\"").skip(1).enumerate() {
        let frame = attribute(chart, "frame");
        let (x, y) = (attribute(chart, "x-range"), attribute(chart, "y-range"));
        let is_log = chart.contains("data-y-scale=\"log\"");
        assert_eq!(is_log, k == 1);
        let line = chart.split("class=\"series\"").nth(1).unwrap().split("</g>").next().unwrap();
        let (cx, cy) = (values(line, "cx"), values(line, "cy"));
        assert_eq!(cx.len(), 3);
        for point in 0..3 {
            let right = (cx[point] - frame[0]) / (frame[2] - frame[0]);
            let up = (frame[3] - cy[point]) / (frame[3] - frame[1]);
            let across = x[0] + right * (x[1] - x[0]);
            let high = if is_log { y[0] * trig::pow(y[1] / y[0], up) } else { y[0] + up * (y[1] - y[0]) };
            // Coordinates on the page are written to a micrometre.
            assert!((across / found.x[point] - 1.0).abs() < 1e-4, "{across}");
            assert!((high / found.y[k][point] - 1.0).abs() < 1e-4, "{high} {:?}", found.y[k]);
        }
        // The tick of 3 is under the mark of 3, to the hundredth of a millimetre to which plotters places it.
        let tick = chart.split("<text ").find(|text| text.contains(">3.0</text>") && text.contains("middle")).unwrap();
        let at: f64 = tick.split("x=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
        assert!((at - cx[1]).abs() < 0.011, "{at} {}", cx[1]);
    }
}

#[test]
fn charts_have_ids_titles_and_escaped_names() {
    let text = GOOD.replace("\"length\"", "\"length * (p > 2 and p < 9)\"");
    assert!(manifest::parse(&text).plan.is_none(), "a condition is not a number");
    let text = GOOD.replace("title = \"T\"", "title = \"A & <B>\"").replace("\"length\"", "\"max(length, 1)\"");
    let svg = page(&rendered(&text), 1);
    for part in [
        "<g id=\"evans-chart-1\" class=\"chart\" data-frame=",
        "<title>max(length of the curve, 1) over p</title>",
        "<g id=\"evans-chart-2-1\" class=\"series\" data-trace=\"1\" data-circuit=\"1\"><title>A &amp; &lt;B&gt;: least transmission angle over p</title>",
        ">least transmission angle (°)</text>",
        "A &amp; &lt;B&gt;",
    ] {
        assert!(svg.contains(part), "{part}");
    }
    assert!(!svg.contains("page 1"), "there is one page");
    let ids: Vec<&str> = svg.split(" id=\"").skip(1).map(|part| part.split('"').next().unwrap()).collect();
    let mut unique = ids.clone();
    unique.sort_unstable();
    unique.dedup();
    // The transmission angle does not depend on the coupler point: its lines coincide, and one is drawn.
    assert_eq!((ids.len(), unique.len()), (5, 5));
}

#[test]
fn more_charts_than_fit_on_a_page_continue_on_the_next() {
    let text =
        GOOD.replace("\"mu_min_deg\"]", "\"mu_min_deg\", \"area\"]").replace("sampling", "panels = [2, 1]\nsampling");
    let atlas = rendered(&text);
    assert!(page(&atlas, 1).contains("page 1 of 2"));
    let second = page(&atlas, 2);
    assert!(second.contains("id=\"evans-chart-3\"") && !second.contains("id=\"evans-chart-2\""));
    let record = atlas.read("run.json");
    assert!(record.contains("\"pages\": 2") && record.contains("evans-002.svg"));
}

#[test]
fn an_empty_chart_says_so() {
    let empty = page(&rendered(&GOOD.replace("\"length\"", "\"input_min_deg\"")), 1);
    assert!(empty.contains(">no finite value</text>") && empty.contains("id=\"evans-chart-2-1\""));
    let low = GOOD.replace("\"mu_min_deg\"]", "\"-length\"], log = [\"-length\"]");
    assert!(page(&rendered(&low), 1).contains("no positive value for a logarithmic axis"));
    let some = GOOD.replace("\"mu_min_deg\"]", "\"p - 3\"], log = [\"p - 3\"]");
    assert!(page(&rendered(&some), 1).contains(">2 values of 0 or less are left out</text>"));
    let beyond = GOOD.replace("\"mu_min_deg\"]", "\"mu_min_deg\"], range = { length = [1e6, 2e6] }");
    assert!(page(&rendered(&beyond), 1).contains(">no value is in the range of the axes</text>"));
    // No cell can be assembled, or none is kept.
    let far = GOOD.replace("let = { a = \"(1 + p)^1.5 / 2\" }", "let = { a = 0.1 }");
    assert!(page(&rendered(&far), 1).contains("no finite value"));
    let atlas = rendered(&(GOOD.to_owned() + "where = \"p > 9\"\n"));
    assert!(!atlas.out().join("evans/evans-001.svg").exists());
}

#[test]
fn no_values_make_a_chart_panic() {
    for y in
        ["p * 0", "1e-12 * p", "1e12 + p", "1e300 * p", "1e-320 * p", "1 / (p - 3)", "sqrt(p - 3)", "p * 0 + 1e-300"]
    {
        for log in ["", ", log = [\"y\"]"] {
            let chart = format!("chart = {{ x = \"p\", y = \"{y}\"{} }}", log.replace('y', y));
            let text = GOOD.replace("chart = { x = \"p\", y = [\"length\", \"mu_min_deg\"] }", &chart);
            let svg = page(&rendered(&text), 1);
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{y}{log}");
        }
    }
    // A single cell is a single mark.
    let one = page(&rendered(&GOOD.replace("p = [2, 3, 4], k = [1.5, 2]", "p = 2")), 1);
    let series: Vec<&str> = one.split("class=\"series\"").skip(1).collect();
    let marks = series.iter().map(|line| line.split("</g>").next().unwrap().matches("<circle").count());
    assert_eq!(marks.collect::<Vec<_>>(), [1, 1]);
}

#[test]
fn a_chart_is_the_same_with_any_number_of_jobs() {
    let text = GOOD.replace("[2, 3, 4]", "{ from = 2, to = 6, count = 60 }");
    let atlas = rendered(&text);
    let run = |jobs: &str| {
        assert_eq!(atlas.run(&["-q", "--jobs", jobs]).0, 0);
        page(&atlas, 1)
    };
    assert!(run("1") == run("8"));
}

/// Ten thousand cells make lines of a hundred points for each of a hundred labels, all of which have room in columns below their chart.
#[test]
#[ignore = "thorough"]
fn ten_thousand_cells_make_a_chart() {
    let grid = "p = { from = 2, to = 6, count = 100 }, k = { from = 1, to = 3, count = 100 }";
    let text = GOOD.replace("p = [2, 3, 4], k = [1.5, 2]", grid).replace("\"10 deg\"", "\"60 deg\"");
    // No curve has such a long straight portion, which is quick to find out and keeps the test short.
    let text = text + "straight = { length = 1000 }\n";
    let svg = page(&rendered(&text), 1);
    // The transmission angle is the same for each k.
    assert_eq!(svg.matches("class=\"series\"").count(), 101);
    assert!(!svg.contains(" more</text>"));
}

/// Curves beyond the limit on numbers are counted, and none of their numbers is kept.
#[test]
fn too_many_numbers_are_counted_and_not_kept() {
    let text = GOOD.replace("x = \"p\"", "x = \"input_deg\"").replace("\"length\"", "\"speed\"");
    let plan = plan(&text);
    let planned = &plan.families[0];
    let mut builder = ChartBuilder::new(planned.chart.as_ref().unwrap(), &planned.family);
    let numbers = vec![1.0; MAX_NUMBERS / 3];
    for cell in 1..=6 {
        let numbers = numbers.clone();
        builder.add(coupler_drawing::chart::ChartSample { cell, trace: 1, circuit: 1, numbers, paths: Vec::new() });
    }
    let chart = builder.build();
    assert_eq!((chart.series.len(), chart.curve_count, chart.left_out_count), (3, 6, 3));
}

/// For the thesis's proportions, Chebyshev's curve is that of an Evans linkage at half size (Roberts and Chebyshev);
/// and the ratio of its width to its height, which falls according to the thesis (10.1.2), rises with p.
#[test]
fn the_range_of_x_to_that_of_y_rises_with_p() {
    let ratio = "(bbox_x_max - bbox_x_min) / (bbox_y_max - bbox_y_min)";
    let evans = GOOD
        .replace(
            "chart = { x = \"p\", y = [\"length\", \"mu_min_deg\"] }",
            &format!("chart = {{ x = \"p\", y = [\"{ratio}\", \"length\"] }}"),
        )
        .replace("p = [2, 3, 4], k = [1.5, 2]", "p = { from = 1.75, to = 6, step = 0.25 }")
        .replace("10 deg", "0.5 deg");
    let chebyshev = evans.replace("\"evans\"", "\"chebyshev\"").replace("let = { a", "let = { r");
    let (evans, chebyshev) = (&series(&evans)[0], &series(&chebyshev)[0]);
    assert!(evans.y[0].windows(2).all(|pair| pair[0] < pair[1]), "{:?}", evans.y[0]);
    for k in 0..evans.x.len() {
        // The inputs of the two differ, and so do their samples and the interpolation between them: by an error of the
        // fourth order in half a degree.
        assert!((evans.y[0][k] / chebyshev.y[0][k] - 1.0).abs() < 1e-6, "{k}: {} {}", evans.y[0][k], chebyshev.y[0][k]);
        assert!((evans.y[1][k] / chebyshev.y[1][k] / 2.0 - 1.0).abs() < 1e-6, "{k}");
    }
}

/// The chart of the atlas in which a peak between two cells was cut off, and a jump of the length was joined.
const EVANS: &str = r#"[atlas]
title = "T"
[[family]]
id = "evans"
linkage = "evans"
layout = "chart"
chart = { x = "p", y = ["straight_length / straight_deviation", "straight_length"] }
measures = []
straight = { input = "120 deg" }
grid = { p = { from = 1.75, to = 6, step = 0.125 } }
let = { a = "(1 + p)^1.5 / 2" }
"#;

/// The straightest of these linkages has p = 1 + sqrt(3): a grid of 17,000 values of p has its greatest ratio next to it.
#[test]
fn a_peak_between_two_cells_is_drawn_at_its_height() {
    let near_peak = EVANS.replace("{ from = 1.75, to = 6, step = 0.125 }", "{ from = 2.725, to = 2.74, count = 61 }");
    let highest = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        points.filter(|[_, y]| !y.is_nan()).max_by(|a, b| a[1].total_cmp(&b[1])).unwrap()
    };
    let expected = highest(&mut series(&near_peak)[0].points(0));
    assert!((expected[0] - 2.732).abs() < 3e-4 && expected[1] > 9700.0, "{expected:?}");
    let [line] = &refined(EVANS)[..] else { panic!("one line") };
    let cells = highest(&mut line.points(0));
    assert!((cells[0], cells[1].round()) == (2.75, 7772.0), "{cells:?}");
    let drawn = highest(&mut line.path(0).into_iter());
    assert!((drawn[0] - expected[0]).abs() < 1e-3 && (drawn[1] / expected[1] - 1.0).abs() < 2e-3, "{drawn:?}");
    assert_eq!(line.paths[0].range.unwrap()[1], drawn[1], "the axis reaches the peak");
    // The page shows it within its frame.
    let svg =
        page(&rendered(&EVANS.replace("title = \"T\"", "title = \"T\"\nformats = [\"svg\"]\noutput = \"out\"")), 1);
    assert_eq!(attribute(&svg, "y-range"), [0.0, 10000.0]);
}

/// The line of a quantity follows it everywhere: between the cells it passes through cells of a finer grid.
#[test]
fn lines_between_cells_pass_through_those_of_a_finer_grid() {
    let finer = EVANS.replace("step = 0.125", "step = 0.03125");
    let (coarse, fine) = (&refined(EVANS)[0], &series(&finer)[0]);
    for quantity in 0..2 {
        let path = coarse.path(quantity);
        let [low, high] = coarse.paths[quantity].range.unwrap();
        for [x, y] in fine.points(quantity) {
            let pair = path.windows(2).find(|pair| pair[0][0] <= x && x <= pair[1][0]).unwrap();
            let part = (x - pair[0][0]) / (pair[1][0] - pair[0][0]);
            let drawn = pair[0][1] + part * (pair[1][1] - pair[0][1]);
            assert!((drawn - y).abs() < 1e-3 * (high - low), "{quantity}: {drawn} {y} at {x}");
        }
    }
}

/// Another portion becomes the straightest, and is longer.
#[test]
fn a_jump_is_a_gap() {
    let path = refined(EVANS)[0].path(1);
    let gaps: Vec<_> = path.windows(3).filter(|triple| triple[1][1].is_nan()).collect();
    let [&[before, _, after]] = gaps[..] else { panic!("{gaps:?}") };
    assert!((before[0] - 2.19).abs() < 0.01 && after[0] - before[0] < 1e-6, "{gaps:?}");
    assert!(before[1] > after[1] + 0.2, "{gaps:?}");
    // The page has two lines, and no mark between the cells.
    let text = EVANS.replace("title = \"T\"", "title = \"T\"\nformats = [\"svg\"]\noutput = \"out\"");
    let svg = page(&rendered(&text), 1);
    let line = svg.split("class=\"series\"").nth(2).unwrap().split("</g>").next().unwrap();
    assert_eq!(line.matches("<circle").count(), 35);
    assert_eq!(line.split(" d=\"").nth(1).unwrap().split('"').next().unwrap().matches(['m', 'M']).count(), 2);
}

/// Cells that `where` leaves out are gaps, and a line ends where the linkage cannot be assembled.
#[test]
fn a_line_ends_where_its_curves_do() {
    let five = GOOD.replace("[2, 3, 4], k = [1.5, 2]", "[2, 3, 4, 5, 6]");
    let [line] = &refined(&(five.clone() + "where = \"p != 4\"\n"))[..] else { panic!("one line") };
    let drawn: Vec<f64> = line.path(0).iter().filter(|[_, y]| !y.is_nan()).map(|[x, _]| *x).collect();
    assert!(drawn.iter().all(|x| *x <= 3.0 || *x >= 5.0) && drawn.contains(&3.0) && drawn.contains(&5.0));
    // Frame 2, coupler and rocker 1: a crank of up to 4 reaches, and one of 5 does not.
    let four_bar = GOOD
        .replace("linkage = \"evans\"", "linkage = \"four-bar\"")
        .replace("x = \"p\"", "x = \"crank\"")
        .replace("grid = { p = [2, 3, 4], k = [1.5, 2] }", "grid = { crank = [1, 2, 3, 5] }")
        .replace("a = \"(1 + p)^1.5 / 2\"", "frame = 2, coupler = 1, rocker = 1.5, along = 0.5")
        .replace("sampling", "circuits = \"start\"\nsampling");
    let lines = refined(&four_bar);
    let [line] = &lines[..] else { panic!("{lines:?}") };
    let last = line.path(0).into_iter().rfind(|[_, y]| !y.is_nan()).unwrap();
    assert!((4.49..=4.5).contains(&last[0]), "{last:?}");
}

/// Over a measure, over several axes or with parameters that change together, a line joins its points.
#[test]
fn lines_that_do_not_follow_one_parameter_join_their_points() {
    let by = GOOD.replace("\"mu_min_deg\"] }", "\"mu_min_deg\"], by = [] }");
    let cases = GOOD.replace("grid = { p = [2, 3, 4], k = [1.5, 2] }", "cases = [{ p = 2, k = 1 }, { p = 3, k = 2 }]");
    for text in [GOOD.replace("x = \"p\"", "x = \"area\""), by, cases] {
        assert!(refined(&text).iter().all(|series| series.paths.is_empty()));
    }
    let cases = GOOD.replace("grid = { p = [2, 3, 4], k = [1.5, 2] }", "cases = [{ p = 2, k = 2 }, { p = 3, k = 2 }]");
    for text in [GOOD.to_owned(), GOOD.replace("x = \"p\"", "x = \"a\""), cases] {
        assert!(refined(&text).iter().all(|series| series.paths.iter().all(|path| path.points.len() > 4)));
    }
}

/// The sides of a pole do not set the range of the axis, and no line joins them.
#[test]
fn the_sides_of_a_pole_do_not_set_the_range() {
    let pole = EVANS.replace("\"straight_length / straight_deviation\", \"straight_length\"", "\"1 / (p - 2.7)\"");
    let [line] = &refined(&pole)[..] else { panic!("one line") };
    let path = line.path(0);
    let gaps: Vec<_> = path.windows(3).filter(|triple| triple[1][1].is_nan()).collect();
    assert!(gaps.len() == 1 && gaps[0][0][1] < -1e3 && gaps[0][2][1] > 1e3, "{gaps:?}");
    let cells = line.y[0].iter().fold(0.0, |most: f64, y| most.max(y.abs()));
    assert!(line.paths[0].range.unwrap().iter().all(|y| y.abs() < 2.0 * cells));
}

/// A line over samples turns where its curve does, and breaks where an angle goes on from 180 to -180 degrees.
#[test]
fn lines_over_samples_are_denser_than_the_samples() {
    let text = GOOD
        .replace("x = \"p\", y = [\"length\", \"mu_min_deg\"]", "x = \"input_deg\", y = [\"psi_deg\", \"speed\"]")
        .replace("linkage = \"evans\"", "linkage = \"watt\"")
        .replace("grid = { p = [2, 3, 4], k = [1.5, 2] }", "cases = [{ p = 4, r = 2, s = 2, a = 1 }]")
        .replace("let = { a = \"(1 + p)^1.5 / 2\" }\n", "");
    let finer = series(&text.replace("10 deg", "0.5 deg"));
    let [line] = &refined(&text)[..] else { panic!("one line") };
    let psi = line.path(0);
    assert_eq!(psi.iter().filter(|[_, y]| y.is_nan()).count(), 2);
    let steps = psi.windows(2).map(|pair| (pair[1][1] - pair[0][1]).abs());
    assert!(steps.filter(|step| !step.is_nan()).all(|step| step < 30.0));
    // Away from the limits, where the speed is unbounded, the line passes through the samples of a finer family.
    let path = line.path(1);
    let near = |[x, y]: [f64; 2]| {
        let gap = |pair: &[[f64; 2]]| {
            let part = (x - pair[0][0]) / (pair[1][0] - pair[0][0]);
            if (0.0..=1.0).contains(&part) { (pair[0][1] + part * (pair[1][1] - pair[0][1]) - y).abs() } else { 1.0 }
        };
        path.windows(2).map(gap).fold(1.0, f64::min)
    };
    let inner = finer[0].points(1).filter(|[x, y]| x.abs() < 40.0 && y.is_finite());
    let worst = inner.map(near).fold(0.0, f64::max);
    assert!(worst < 2e-3, "{worst}");
}

/// What is the same on all lines is under the title, with what follows from it; names have spaces.
#[test]
fn the_heading_has_the_fixed_parameters() {
    let text = GOOD.replace("a = \"(1 + p)^1.5 / 2\"", "a = \"base_length^1.5 / 2\", base_length = \"1 + p\"");
    let svg = page(&rendered(&text), 1);
    let line: String = svg.split("<text").filter(|text| text.contains("base length")).collect();
    let plain: String = line.split('>').map(|part| part.split('<').next().unwrap()).collect();
    // The exponent is raised.
    assert!(plain.contains("r = 1, a = (base length)1.5 / 2, s = a, base length = 1 + p"), "{plain}");
    assert!(!svg.contains("base_length"));
    let given = GOOD.replace("\"mu_min_deg\"] }", "\"mu_min_deg\"], title = { mu_min_deg = \"transmission\" } }");
    assert!(page(&rendered(&given), 1).contains(">transmission (°)</text>"));
    // Minus signs are true ones.
    let minus = GOOD.replace("k = [1.5, 2]", "k = [-1.5, 2]");
    assert!(page(&rendered(&minus), 1).contains("= −1.5</text>"));
}

/// Lines that differ by one parameter have inks in its order.
#[test]
fn lines_in_an_order_have_places() {
    let places = |text: &str| series(text).iter().map(|series| series.place).collect::<Vec<_>>();
    assert_eq!(places(&GOOD.replace("k = [1.5, 2]", "k = [2, 1, 1.5]")), [Some(1.0), Some(0.0), Some(0.5)]);
    assert_eq!(places(&GOOD.replace(", k = [1.5, 2]", "")), [None]);
    let two = GOOD.replace("k = [1.5, 2]", "k = [1.5, 2], r = [1, 1.1]");
    assert_eq!(places(&two), [None; 4]);
}

/// The texts of a page with their positions and sizes.
fn placed_texts(svg: &str) -> Vec<(String, [f64; 3])> {
    let attribute = |tag: &str, name: &str| -> f64 {
        let value = tag.split(&format!("{name}=\"")).nth(1).unwrap_or_else(|| panic!("{name} in {tag}"));
        value.split('"').next().unwrap().parse().unwrap()
    };
    let of = |element: &str| {
        let (tag, rest) = element.split_once('>').unwrap();
        let content = rest.split("</text>").next().unwrap();
        let text: String = content.split('<').map(|part| part.rsplit('>').next().unwrap()).collect();
        (text, ["x", "y", "font-size"].map(|name| attribute(tag, name)))
    };
    svg.split("<text ").skip(1).map(of).collect()
}

#[test]
fn labels_do_not_overprint_the_number_of_those_left_out() {
    let atlas = rendered(
        "[atlas]\ntitle = \"T\"\nformats = [\"svg\"]\noutput = \"out\"\n[page]\npaper = \"a5\"\n[[family]]\nid = \"f\"\nlinkage = \"four-bar\"\n\
         layout = \"chart\"\nchart = { x = \"crank\", y = [\"mu_min_deg\", \"length\", \"bbox_x_max\", \"output_swing_deg\"], \
         by = [\"coupler\", \"rocker\"] }\nsampling = { step = \"10 deg\" }\n\
         grid = { crank = [0.25, 0.5, 1], coupler = [2.5, 3, 3.5, 4], rocker = [2.5, 3, 3.5, 4, 4.5] }\nlet = { frame = 4 }\n",
    );
    let svg = atlas.read("f/f-001.svg");
    let texts = placed_texts(&svg);
    let rests: Vec<_> = texts.iter().filter(|(text, _)| text.starts_with("and ") && text.ends_with(" more")).collect();
    assert!(!rests.is_empty() && texts.iter().any(|(text, _)| text.ends_with("lines)")), "{texts:?}");
    for (rest, [x, y, size]) in rests {
        let overprints =
            |[other_x, other_y, _]: &[f64; 3]| (other_x - x).abs() < 1e-6 && (other_y - y).abs() < size * 0.9;
        let count = texts.iter().filter(|(_, place)| overprints(place)).count();
        assert_eq!(count, 1, "{rest} at {x}, {y}");
    }
    assert!(texts.iter().any(|(text, _)| text.starts_with("all lines have their labels on paper of ")), "{texts:?}");
}

/// Of more lines than have room beside a small chart, the labels are below it, and no word of one is divided.
#[test]
fn labels_of_many_lines_on_small_paper_are_whole() {
    let chart = |grid: &str| {
        let atlas = rendered(&format!(
            "[atlas]\ntitle = \"T\"\nformats = [\"svg\"]\noutput = \"out\"\n[page]\npaper = \"a6\"\n[[family]]\nid = \"f\"\n\
             linkage = \"four-bar\"\nlayout = \"chart\"\nchart = {{ x = \"frame\", y = [\"mu_worst_deg\", \"length\"] }}\nsampling = {{ samples = 24 }}\n\
             grid = {{ frame = [3, 3.5, 4], crank = 1, along = 1.5, across = 1, {grid} }}\n",
        ));
        placed_texts(&atlas.read("f/f-001.svg")).into_iter().map(|(text, _)| text).collect::<Vec<String>>()
    };
    let few = chart("coupler = [2.5, 3, 3.5], rocker = [3, 3.5]");
    let label = |text: &&String| text.ends_with("circuit 1") && text.split(", ").count() == 3;
    assert_eq!(few.iter().filter(label).count(), 6, "{few:?}");
    let many = chart("coupler = [2.5, 2.75, 3, 3.25, 3.5], rocker = [3, 3.25, 3.5, 3.75]");
    let is_part = |text: &String| ["cou", "pler", "roc", "ker", "circ", "uit"].contains(&text.as_str());
    assert!(!many.iter().any(is_part) && many.iter().any(|text| text == "coupler, rocker"), "{many:?}");
    assert!(many.iter().any(|text| text.starts_with("all lines have their labels on paper of ")), "{many:?}");
}

#[test]
fn names_in_labels_without_room_are_said_once_and_titles_are_whole() {
    let atlas = rendered(
        "[atlas]\ntitle = \"T\"\nformats = [\"svg\"]\noutput = \"out\"\n[page]\npaper = { width = \"148 mm\", height = \"105 mm\" }\n\
         [[family]]\nid = \"f\"\nlinkage = \"wordy\"\nlayout = \"chart\"\npanels = [2, 1]\nsampling = { samples = 24 }\n\
         grid = { coupler_of_the_loop = [3, 3.5, 4], distance_of_pivots = [2.2, 2.5] }\nchart = { x = \"input_deg\", y = [\"x\", \"y\"] }\n\
         [[linkage]]\nid = \"wordy\"\ntrace = [\"M\"]\n\
         parameters = { coupler_of_the_loop = { default = 3 }, distance_of_pivots = { default = 2 } }\n\
         [linkage.joints]\nO = { fixed = [0, 0] }\nC = { fixed = [\"distance_of_pivots\", 0] }\nA = { crank = \"O\", length = 1 }\n\
         B = { dyad = [\"A\", \"C\"], lengths = [\"coupler_of_the_loop\", 3], side = \"left\" }\n\
         M = { point = [\"A\", \"B\"], along = 1, across = 0.5 }\n",
    );
    let texts: Vec<String> = placed_texts(&atlas.read("f/f-001.svg")).into_iter().map(|(text, _)| text).collect();
    for said in ["3, 2.2", "4, 2.5", "coupler"] {
        assert!(
            texts.iter().filter(|text| *text == said || said == "coupler" && text.starts_with(said)).count() >= 2,
            "{texts:?}"
        );
    }
    assert!(texts.iter().all(|text| !text.contains('…') && !text.ends_with("more")), "{texts:?}");
}

#[test]
fn a_chart_shows_its_lines_as_far_as_they_have_values_and_explains_the_inks_of_its_key() {
    let atlas = rendered(
        "[atlas]\ntitle = \"T\"\nformats = [\"svg\"]\noutput = \"out\"\n[[family]]\nid = \"f\"\nlinkage = \"cognates\"\n\
         layout = \"chart\"\nchart = { x = \"u\", y = [\"straight_length\"] }\nsampling = { step = \"5 deg\" }\n\
         grid = { u = { from = 0.5, to = 2, step = 0.25 } }\nlet = { p = 4, r = 1.5, a = 3, s = 3.5, v = 0.5 }\n",
    );
    let svg = atlas.read("f/f-001.svg");
    let range = svg.split("data-x-range=\"").nth(1).unwrap().split('"').next().unwrap();
    let low: f64 = range.split(' ').next().unwrap().parse().unwrap();
    // There is a straight portion from u = 1.41 on, and the first cell that has one is 1.5.
    assert!((1.25..1.42).contains(&low), "{range}");
    let texts: Vec<String> = placed_texts(&svg).into_iter().map(|(text, _)| text).collect();
    for meaning in ["links of OCABM", "links of ODEMHQ", "links of CFGMIQ"] {
        assert!(texts.iter().any(|text| text == meaning), "{texts:?}");
    }
}

#[test]
fn the_symbols_of_a_chart_leave_the_folio_free() {
    let title = "A long title of an atlas that is printed in full at the foot of each of its pages, on the right";
    let atlas = rendered(&format!(
        "[atlas]\ntitle = \"{title}\"\nformats = [\"svg\"]\noutput = \"out\"\n\
         [page]\npaper = {{ width = \"210 mm\", height = \"148 mm\" }}\n\
         [[family]]\nid = \"f\"\ntitle = \"F\"\nlinkage = \"cognates\"\nlayout = \"chart\"\nchart = {{ x = \"u\", y = [\"length\"] }}\n\
         sampling = {{ step = \"10 deg\" }}\ngrid = {{ u = [1, 1.5, 2] }}\n"
    ));
    let svg = atlas.read("f/f-001.svg");
    let texts = placed_texts(&svg);
    let find = |start: &str| {
        texts.iter().find(|(text, _)| text.starts_with(start)).unwrap_or_else(|| panic!("{start}: {texts:?}"))
    };
    let first_folio = find("A long title").1;
    // The symbols are in several lines, none of which is as wide as half of the page.
    let symbols = ["crank’s pivot", "traced point", "links of CFGMIQ", "mark: a linkage"].map(|start| find(start).1);
    let rows: std::collections::BTreeSet<u64> = symbols.iter().map(|[_, y, _]| y.to_bits()).collect();
    assert!(rows.len() > 1, "{symbols:?}");
    assert!(symbols.iter().all(|[x, ..]| *x < 105.0) && first_folio[0] > 190.0, "{symbols:?} {first_folio:?}");
    // And they are under the chart.
    let frame = svg.split("data-frame=\"").nth(1).unwrap().split('"').next().unwrap();
    let bottom: f64 = frame.split(' ').nth(3).unwrap().parse().unwrap();
    assert!(symbols.iter().all(|[_, y, size]| y - size > bottom), "{symbols:?} {bottom}");
}
