//! Memory and time are bounded: what is too large is refused with the number and the limit, and the time to read a
//! manifest grows with its length.

use std::hint::black_box;
use std::time::{Duration, Instant};

use coupler_atlas::manifest::{self, MAX_MANIFEST_BYTES};
use coupler_atlas::sweep::{self, CellIndices};
use coupler_curves::linkage_format::MAX_PROBLEMS;
use coupler_curves::problem::report;

use crate::support::plan::plan;

/// A manifest with a family over a grid, its further keys, and a four-bar with further joints.
struct Manifest {
    title: String,
    sampling: String,
    grid: String,
    keys: String,
    along: String,
    joints: String,
    parameters: String,
}

impl Default for Manifest {
    fn default() -> Manifest {
        let own = str::to_owned;
        Manifest {
            title: own("T"),
            sampling: own("{ samples = 9 }"),
            grid: own("{ r = [1] }"),
            keys: String::new(),
            along: own("1"),
            joints: String::new(),
            parameters: own("{ r = { default = 1 } }"),
        }
    }
}

impl Manifest {
    fn text(&self) -> String {
        let Manifest { title, sampling, grid, keys, along, joints, parameters } = self;
        format!(
            "[atlas]\ntitle = \"{title}\"\n[[family]]\nid = \"f\"\nlinkage = \"mine\"\nsampling = {sampling}\n\
             grid = {grid}\n{keys}\n[[linkage]]\nid = \"mine\"\ntrace = [\"M\"]\nparameters = {parameters}\n\
             [linkage.joints]\nO = {{ fixed = [0, 0] }}\nC = {{ fixed = [4, 0] }}\nA = {{ crank = \"O\", length = 1 }}\n\
             B = {{ dyad = [\"A\", \"C\"], lengths = [3, 3.5], side = \"left\" }}\n\
             M = {{ point = [\"A\", \"B\"], along = {along}, across = 1 }}\n{joints}"
        )
    }
}

/// The only problem of a manifest that is not accepted, as reported.
fn problem(text: &str) -> String {
    let loaded = manifest::parse(text);
    assert!(
        loaded.plan.is_none() && loaded.problems.len() == 1,
        "{:?}",
        loaded.problems.iter().take(9).collect::<Vec<_>>()
    );
    report(&loaded.problems, "m.toml", text, false)
}

#[test]
fn too_many_cells_are_refused_without_being_counted_one_by_one() {
    let cells = |grid: &str, limit: &str| {
        problem(&Manifest { grid: grid.to_owned(), keys: limit.to_owned(), ..Manifest::default() }.text())
    };
    let range = "{ r = { from = 0, to = 1, count = 1_000_000_000 } }";
    let refused = cells(range, "limit = 10_000_000");
    assert!(refused.contains("the grid has 1000000000 cells, more than the limit of 10000000"), "{refused}");
    assert!(refused.contains("m.toml:7:8"), "{refused}");
    let refused = cells(&range.replace("from = 0", "from = 0.5"), "limit = 1_000_000_000");
    assert!(refused.contains("have 1000000000 cells, more than the limit of 10000000"), "{refused}");
    assert!(cells("{ r = 1 }", "limit = 5_000_000_000").contains("give a whole number from 1 to 4000000000"));
}

#[test]
fn cells_that_are_not_selected_one_by_one_take_no_memory() {
    let grid = "{ r = { from = 1, to = 2, count = 100_000 } }".to_owned();
    let plan = plan(&Manifest { grid, ..Manifest::default() }.text());
    let kept = sweep::kept_cells(&plan.families[0].family);
    assert_eq!(kept, CellIndices::Range(0..100_000));
    assert_eq!((kept.get(99_999), kept.get(100_000)), (Some(99_999), None));
}

#[test]
fn a_page_that_does_not_fit_memory_is_refused() {
    let large = Manifest {
        sampling: "{ samples = 100_000 }".to_owned(),
        along: "{ from = 0, to = 1, count = 1000 }".to_owned(),
        ..Manifest::default()
    };
    let refused = problem(&large.text());
    assert!(refused.contains("a cell would take about ") && refused.contains(" MB, more than the limit of 240 MB"));
    assert!(refused.contains("m.toml:6:12") && refused.contains("use fewer samples"), "{refused}");
    // The same points in two families of fewer samples or of fewer points are accepted.
    let few_points = Manifest { along: "1".to_owned(), ..large };
    assert!(manifest::parse(&few_points.text()).plan.is_some());
    let many_cells = Manifest { grid: "{ r = { from = 1, to = 2, count = 15 } }".to_owned(), ..few_points };
    assert!(problem(&many_cells.text()).contains("the 15 cells of a page would take about "));
}

/// Gears that are back at their positions only after 716,539 turns.
#[test]
fn a_linkage_of_very_many_turns_is_refused() {
    let gear = |name, turns| format!("{name} = {{ gear = \"A\", about = \"C\", length = 1, ratio = [1, {turns}] }}\n");
    let joints = [gear("G", 97), gear("H", 89), gear("I", 83)].concat();
    let text = Manifest { joints, ..Manifest::default() }.text().replace("[\"M\"]", "[\"M\", \"G\", \"H\", \"I\"]");
    let loaded = manifest::parse(&text);
    let refused = report(&loaded.problems, "m.toml", &text, false);
    assert!(loaded.plan.is_none() && refused.contains("MB, more than the limit"), "{refused}");
}

#[test]
fn a_manifest_that_is_too_long_is_refused() {
    let mut text = Manifest::default().text();
    text.push_str(&"#".repeat(MAX_MANIFEST_BYTES - text.len()));
    assert!(manifest::parse(&text).plan.is_some());
    text.push('#');
    let message = format!("the manifest has {} bytes, more than the limit of {MAX_MANIFEST_BYTES}", text.len());
    assert!(problem(&text).contains(&message));
    let (templates, problems) = manifest::parse_linkages(&text);
    assert!(templates.is_empty() && problems[0].message == message);
}

#[test]
fn nesting_does_not_overflow_the_stack() {
    let nested = |open: &str, close: &str| format!("{}{}", open.repeat(100_000), close.repeat(100_000));
    for text in [
        format!("x = {}", nested("[", "]")),
        format!("x = {}", nested("{ a = ", "}")),
        format!("x{} = 1", ".a".repeat(100_000)),
        format!("[x{}]", ".a".repeat(100_000)),
        Manifest { along: format!("\"{}\"", nested("(", ")")), ..Manifest::default() }.text(),
        Manifest { along: format!("\"{}1\"", "-".repeat(100_000)), ..Manifest::default() }.text(),
        Manifest { along: format!("\"{}1\"", "2^".repeat(100_000)), ..Manifest::default() }.text(),
        Manifest { along: format!("\"{}1\"", "not ".repeat(100_000)), ..Manifest::default() }.text(),
    ] {
        let loaded = manifest::parse(&text);
        assert!(loaded.plan.is_none() && !report(&loaded.problems, "m", &text, false).is_empty());
    }
}

#[test]
fn very_many_problems_are_counted() {
    let text = (0..2000).map(|k| format!("key{k} = 1\n")).collect::<String>();
    let problems = manifest::parse(&text).problems;
    assert_eq!(problems.len(), MAX_PROBLEMS + 1);
    let unreported = problems.last().unwrap();
    // Each key, and that there are no atlas and no family.
    assert_eq!(unreported.message, format!("there are {} more problems", 2002 - MAX_PROBLEMS));
    assert!(unreported.is_error());
}

/// The least time of some runs.
fn least_time(work: impl Fn()) -> Duration {
    let time = |_| {
        let start = Instant::now();
        work();
        start.elapsed()
    };
    (0..3).map(time).min().unwrap_or_default()
}

/// Asserts that the time to parse a manifest, and to report its problems, grows less than quadratically: by less than
/// 3.2 for each of two doublings. Other tests and programs disturb measurements, but not always: it is tried many times.
fn assert_time_grows_with_length(what: &str, size: usize, text: impl Fn(usize) -> String) {
    let mut ratios = Vec::new();
    for _ in 0..40 {
        let times = [1, 2, 4].map(|factor| {
            let text = text(factor * size);
            assert!(text.len() <= MAX_MANIFEST_BYTES, "{what}: {} bytes", text.len());
            least_time(|| {
                let loaded = manifest::parse(&text);
                black_box(report(&loaded.problems, "m", &text, false));
            })
        });
        let [first, second] = [0, 1].map(|k| times[k + 1].as_secs_f64() / times[k].as_secs_f64());
        if first < 3.2 && second < 3.2 {
            return;
        }
        ratios.push([first, second]);
    }
    panic!("{what}: the time grows by {ratios:?}");
}

/// Lines for numbers from 0.
fn lines(count: usize, line: impl Fn(usize) -> String) -> String {
    (0..count).map(|k| line(k) + "\n").collect()
}

#[test]
#[ignore = "thorough"]
fn the_time_to_parse_names_grows_with_their_number() {
    assert_time_grows_with_length("parameters with defaults", 2000, |count| {
        let default = |k: usize| format!("p{k} = {{ default = \"p{} + 1\" }}, ", k + 1);
        let defaults: String = (0..count).map(default).collect();
        Manifest {
            parameters: format!("{{ {defaults} p{count} = {{}}, r = {{}} }}"),
            grid: format!("{{ p{count} = [1], r = [1] }}"),
            ..Manifest::default()
        }
        .text()
    });
    assert_time_grows_with_length("derived values", 2000, |count| {
        let lets = lines(count, |k| format!("z{k} = \"z{} + 1\"", k + 1));
        let keys = format!("where = \"z0 > 0\"\n[family.let]\n{lets}");
        Manifest { keys, grid: format!("{{ r = [1], z{count} = [1] }}"), ..Manifest::default() }.text()
    });
    assert_time_grows_with_length("unknown names", 2000, |count| {
        let keys = format!("[family.let]\n{}", lines(count, |k| format!("z{k} = \"q{k}\"")));
        Manifest { keys, ..Manifest::default() }.text()
    });
    assert_time_grows_with_length("unused names", 2000, |count| {
        let keys = format!("[family.let]\n{}", lines(count, |k| format!("z{k} = {k}")));
        Manifest { keys, ..Manifest::default() }.text()
    });
    assert_time_grows_with_length("names in an expression", 2000, |count| {
        let sum: String = (0..count).map(|k| format!("z{k} + ")).collect();
        let keys = format!("where = \"{sum} 1 > 0\"\n[family.let]\n{}", lines(count, |k| format!("z{k} = {k}")));
        Manifest { keys, ..Manifest::default() }.text()
    });
    assert_time_grows_with_length("names in a caption", 2000, |count| {
        let caption: String = (0..count).map(|k| format!("{{z{k}}} ")).collect();
        let keys = format!("caption = \"{caption}\"\n[family.let]\n{}", lines(count, |k| format!("z{k} = {k}")));
        Manifest { keys, ..Manifest::default() }.text()
    });
}

#[test]
#[ignore = "thorough"]
fn the_time_to_parse_tables_grows_with_their_number() {
    assert_time_grows_with_length("joints", 1000, |count| {
        let point = |k: usize| format!("M{k} = {{ point = [\"A\", \"B\"], along = {k}, across = 1 }}");
        let traced: String = (0..count).map(|k| format!(", \"M{k}\"")).collect();
        let joints = lines(count, point);
        Manifest { joints, ..Manifest::default() }.text().replace("[\"M\"]", &format!("[\"M\"{traced}]"))
    });
    let family = "[[family]]\nid = \"f\"\nlinkage = \"mine\"\n";
    assert_time_grows_with_length("families", 500, |count| {
        let text = Manifest::default().text();
        let family = |k| {
            format!("[[family]]\nid = \"f{k}\"\nlinkage = \"mine\"\nsampling = {{ samples = 9 }}\ngrid = {{ r = [1] }}")
        };
        text + &lines(count, family)
    });
    assert_time_grows_with_length("linkages", 400, |count| {
        let text = Manifest::default().text();
        let linkage = text[text.find("[[linkage]]").unwrap()..].to_owned();
        let uses = |k: usize| {
            format!(
                "{}sampling = {{ samples = 9 }}\ngrid = {{ r = [1] }}",
                family.replace("\"f\"", &format!("\"f{k}\"")).replace("mine", &format!("m{k}"))
            )
        };
        text + &lines(count, |k| linkage.replace("mine", &format!("m{k}"))) + &lines(count, uses)
    });
    assert_time_grows_with_length("cases", 10_000, |count| {
        let cases: String = (0..count).map(|k| format!("{{ r = {} }}, ", k + 1)).collect();
        Manifest::default().text().replace("grid = { r = [1] }", &format!("cases = [{cases}]"))
    });
    assert_time_grows_with_length("unknown keys", 4000, |count| lines(count, |k| format!("key{k} = 1")));
}

#[test]
#[ignore = "thorough"]
fn the_time_to_parse_texts_grows_with_their_length() {
    assert_time_grows_with_length("an expression", 200_000, |count| {
        let keys = format!("let = {{ r = \"{}1\" }}", "1 + ".repeat(count / 4));
        let grid = "{ q = [1] }".to_owned();
        Manifest { keys: keys.replace("\"1 + ", "\"q + "), grid, ..Manifest::default() }.text()
    });
    assert_time_grows_with_length("a title", 100_000, |count| {
        Manifest { title: "word ".repeat(count / 5), ..Manifest::default() }.text()
    });
    for key in ["title", "source", "note"] {
        assert_time_grows_with_length(key, 100_000, |count| {
            Manifest { keys: format!("{key} = \"{}\"", "word ".repeat(count / 5)), ..Manifest::default() }.text()
        });
    }
    assert_time_grows_with_length("mistakes in one caption", 2000, |count| {
        Manifest { keys: format!("caption = \"{}\"", "{qq} ".repeat(count)), ..Manifest::default() }.text()
    });
}
