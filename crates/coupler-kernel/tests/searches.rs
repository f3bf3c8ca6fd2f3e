//! Searches of the kernel find what the crate below it finds, in steps.

use coupler_curves::geometry::{Point, distance_to_segment, trig};
use coupler_find::{AnswerRecord, Index, Options, PathKind, Search, Target, answers_manifest};
use coupler_kernel::{Kernel, Response};
use serde_json::{Value, json};

fn call(kernel: &mut Kernel, request: &Value, numbers: &[f64]) -> (Value, Vec<f64>) {
    let Response { json, numbers } = kernel.call_with_numbers(&request.to_string(), numbers);
    (serde_json::from_str(&json).unwrap(), numbers)
}

/// The answer to a request that must have one.
fn answer(kernel: &mut Kernel, request: &Value, numbers: &[f64]) -> (Value, Vec<f64>) {
    let (value, numbers) = call(kernel, request, numbers);
    assert!(value.get("error").is_none(), "{request}: {value}");
    (value, numbers)
}

fn error(kernel: &mut Kernel, request: &Value, numbers: &[f64]) -> String {
    call(kernel, request, numbers).0["error"].as_str().unwrap().to_owned()
}

/// A kernel whose index has at least some curves, and how many.
fn kernel_with_index(least: usize) -> (Kernel, usize) {
    let mut kernel = Kernel::default();
    loop {
        let (grown, _) = answer(&mut kernel, &json!({ "method": "grow_index" }), &[]);
        assert_eq!(grown["full_count"], Index::DEFAULT_COUNT);
        let count = grown["count"].as_u64().unwrap() as usize;
        if count >= least {
            return (kernel, count);
        }
    }
}

/// A closed path like a bean, or a part of it.
fn path(count: usize, part: f64) -> Vec<f64> {
    let angle = |k: usize| part * std::f64::consts::TAU * k as f64 / count as f64;
    let point = |t: f64| {
        let r = 3.0 + trig::cos(t) + 0.3 * trig::cos(3.0 * t);
        [7.0 + r * trig::cos(t), 0.6 * r * trig::sin(t) - 2.0]
    };
    (0..count).flat_map(|k| point(angle(k))).collect()
}

fn open_request(numbers: &[f64], kind: &str, full_turn: bool) -> Value {
    json!({
        "method": "open_search",
        "points": { "$": [0, numbers.len()] },
        "kind": kind,
        "full_turn": full_turn,
        "max_link": 10,
        "pivots": null,
        "condition": null,
        "refine": true,
        "start": null,
        "most": 3,
    })
}

/// The answers of a search so far.
fn answers(kernel: &mut Kernel, handle: &Value) -> Response {
    let request = json!({ "method": "answers", "search": handle, "name": "bean" }).to_string();
    loop {
        let response = kernel.call(&request);
        if !response.json.contains("\"is_complete\":false") {
            return response;
        }
    }
}

/// Searches to the end: the answers in JSON, their numbers, and how many steps it took.
fn search(kernel: &mut Kernel, request: &Value, numbers: &[f64]) -> (String, Vec<f64>, usize) {
    let (opened, _) = answer(kernel, request, numbers);
    let handle = opened["search"].clone();
    let mut steps = 1;
    while answer(kernel, &json!({ "method": "step_search", "search": handle }), &[]).0["is_done"] == false {
        steps += 1;
    }
    let Response { json, numbers } = answers(kernel, &handle);
    answer(kernel, &json!({ "method": "close_search", "search": handle }), &[]);
    (json, numbers, steps)
}

/// Panics unless the answers to paths, by kind, name, part of the curve and whether the crank turns fully, are those of the program.
fn assert_same_answers(sought: [(PathKind, &str, f64, bool); 2]) {
    let (mut kernel, count) = kernel_with_index(3000);
    let index = Index::with_count(count);
    for (kind, name, part, full_turn) in sought {
        let numbers = path(60, part);
        let (text, numbers_out, steps) = search(&mut kernel, &open_request(&numbers, name, full_turn), &numbers);
        let found: Value = serde_json::from_str(&text).unwrap();
        let points: Vec<Point> = numbers.as_chunks().0.iter().map(|&[x, y]| Point::new(x, y)).collect();
        let target = Target::new(&points, kind).unwrap();
        let options = Options { full_turn, most: 3, ..Options::default() };
        let expected = Search::new(&target, options).run(&index);
        assert!(!expected.is_empty(), "{name}");
        assert_eq!(found["size"], target.size());
        assert_eq!(found["manifest"], answers_manifest("bean", target.size(), &expected));
        let answers = found["answers"].as_array().unwrap();
        assert_eq!(answers.len(), expected.len());
        for (rank, answer) in (1..).zip(&expected) {
            // As text: numbers of JSON are not read to the last bit.
            let record = serde_json::to_value(AnswerRecord::new(rank, answer)).unwrap();
            assert!(text.contains(&format!("\"record\":{record}")), "{record}");
        }
        // Each of several steps of the search.
        assert!(steps > 125, "{steps} steps");
        for (answer, expected) in answers.iter().zip(&expected) {
            // The curve passes the path at its deviation.
            let [start, length] = [0, 1].map(|k| answer["curve"]["points"]["$"][k].as_u64().unwrap() as usize);
            let curve = numbers_out[start..start + length].as_chunks::<2>().0;
            let curve: Vec<Point> = curve.iter().map(|[x, y]| Point::new(*x, *y)).collect();
            let distance = |p: &Point| {
                let segments = curve.windows(2).map(|ends| distance_to_segment(*p, ends[0], ends[1]));
                segments.fold(f64::INFINITY, f64::min)
            };
            let greatest = points.iter().map(distance).fold(0.0, f64::max);
            assert!(
                greatest < expected.deviation.greatest + 0.05 * target.size(),
                "{greatest}, {}",
                expected.deviation.greatest
            );
        }
    }
}

#[test]
fn answers_are_those_of_the_program() {
    assert_same_answers([(PathKind::Closed, "closed", 1.0, true), (PathKind::Part, "part", 0.4, false)]);
}

#[test]
#[ignore = "thorough"]
fn answers_to_other_requests_are_those_of_the_program() {
    assert_same_answers([(PathKind::Closed, "closed", 1.0, false), (PathKind::Part, "part", 0.4, true)]);
}

#[test]
fn there_are_answers_before_the_end() {
    let (mut kernel, _) = kernel_with_index(3000);
    let numbers = path(60, 1.0);
    let (opened, _) = answer(&mut kernel, &open_request(&numbers, "closed", true), &numbers);
    let handle = opened["search"].clone();
    let so_far = |kernel: &mut Kernel| {
        let found: Value = serde_json::from_str(&answers(kernel, &handle).json).unwrap();
        found["answers"].as_array().unwrap().first().map(|best| best["record"]["rms"].as_f64().unwrap())
    };
    assert_eq!(so_far(&mut kernel), None);
    let mut steps = 0;
    let mut known: Option<f64> = None;
    loop {
        let step = json!({ "method": "step_search", "search": handle });
        let is_done = answer(&mut kernel, &step, &[]).0["is_done"] == true;
        steps += 1;
        if steps % 250 == 0 || is_done {
            let found = so_far(&mut kernel);
            assert!(known.is_none() || found.is_some(), "answers do not vanish");
            known = found;
        }
        if is_done {
            break;
        }
    }
    assert!(known.is_some());
}

/// The deviation of the best answer of a search, relative to the size of the path, the answer's pose and the record.
fn best(kernel: &mut Kernel, request: &Value, numbers: &[f64]) -> (f64, Vec<f64>, Value) {
    let (text, out, _) = search(kernel, request, numbers);
    let found: Value = serde_json::from_str(&text).unwrap();
    let best = &found["answers"][0];
    let start = best["pose"]["$"][0].as_u64().unwrap() as usize;
    (best["record"]["rms_relative"].as_f64().unwrap(), out[start..start + 10].to_vec(), best["record"].clone())
}

#[test]
fn a_search_looks_up_without_refining_and_begins_with_a_four_bar() {
    let (mut kernel, _) = kernel_with_index(3000);
    let mut numbers = path(60, 1.0);
    let mut request = open_request(&numbers, "closed", true);
    request["refine"] = json!(false);
    let (rough, pose, _) = best(&mut kernel, &request, &numbers);
    request["refine"] = json!(true);
    request["start"] = json!({ "$": [numbers.len(), 10] });
    numbers.extend(pose);
    // Another kernel has no index at all.
    let (warm, _, _) = best(&mut Kernel::default(), &request, &numbers);
    assert!(warm < 0.75 * rough && warm < 0.03, "{warm} after {rough}");
    request["start"] = json!({ "$": [0, 8] });
    assert!(error(&mut kernel, &request, &numbers).contains("not five points"));
}

#[test]
fn drawn_paths_have_no_noise_and_points_enough() {
    let mut kernel = Kernel::default();
    let circle = |count: usize, noise: f64| -> Vec<f64> {
        let radius = |k: usize| 1.0 + noise * (f64::from((k * 7919 % 101) as u32) / 50.0 - 1.0);
        let angle = |k: usize| std::f64::consts::TAU * k as f64 / count as f64;
        (0..count).flat_map(|k| [radius(k) * trig::cos(angle(k)), radius(k) * trig::sin(angle(k))]).collect()
    };
    let mut drawn = |points: &[f64], closed: bool, is_part: bool| {
        let array = json!({ "$": [0, points.len()] });
        let request = json!({ "method": "drawn_path", "points": array, "closed": closed, "is_part": is_part });
        let (path, numbers) = answer(&mut kernel, &request, points);
        (path["kind"].as_str().unwrap().to_owned(), numbers)
    };
    let length = |numbers: &[f64]| -> f64 {
        let points = numbers.as_chunks::<2>().0;
        let step = |k: usize| {
            let [a, b] = [points[k], points[(k + 1) % points.len()]];
            ((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1])).sqrt()
        };
        (0..points.len()).map(step).sum::<f64>() / std::f64::consts::TAU
    };
    // Without noise, few points are even ones along them, and enough are taken as they are.
    assert_eq!(drawn(&circle(60, 0.0), true, false), ("closed".to_owned(), circle(60, 0.0)));
    let (kind, few) = drawn(&circle(12, 0.0), true, true);
    assert_eq!((kind.as_str(), few.len()), ("part", 202));
    assert_eq!(few[..2], few[200..]);
    for count in [100, 200, 400] {
        let noisy = circle(count, 0.02);
        let (_, quiet) = drawn(&noisy, true, false);
        assert!(
            length(&noisy) > 1.02 && (length(&quiet) - 1.0).abs() < 0.02,
            "{} of {}",
            length(&quiet),
            length(&noisy)
        );
    }
    let (kind, line) = drawn(&[0.0, 0.0, 3.0, 0.0, 3.0, f64::NAN, 3.0, 0.0, 3.0, 1.0], false, false);
    assert_eq!((kind.as_str(), line.len(), &line[..2], &line[198..]), ("part", 200, &[0.0, 0.0][..], &[3.0, 1.0][..]));
    let request = json!({ "method": "drawn_path", "points": { "$": [0, 4] }, "closed": true, "is_part": false });
    assert!(error(&mut kernel, &request, &[1.0; 4]).contains("too small"));
}

#[test]
fn pivots_and_conditions_are_kept() {
    let (mut kernel, _) = kernel_with_index(3000);
    let mut numbers = path(60, 1.0);
    let mut request = open_request(&numbers, "closed", true);
    request["pivots"] = json!({ "$": [numbers.len(), 4] });
    request["condition"] = json!("mu_worst_deg >= 25");
    let corners = [14.0, 8.0, 2.0, -9.0];
    numbers.extend(corners);
    let (_, _, record) = best(&mut kernel, &request, &numbers);
    assert!(record["mu_worst_deg"].as_f64().unwrap() >= 25.0 - 1e-6, "{record}");
    for pivot in ["crank_pivot", "rocker_pivot"] {
        let [x, y] = [0, 1].map(|k| record[pivot][k].as_f64().unwrap());
        assert!((1.99..=14.01).contains(&x) && (-9.01..=8.01).contains(&y), "{record}");
    }
    request["condition"] = json!("nothing >= 25");
    assert!(error(&mut kernel, &request, &numbers).contains("nothing"));
}

#[test]
fn the_index_grows_in_steps() {
    let (_, count) = kernel_with_index(1);
    // Bounded work for a page with one thread.
    assert!(count <= 128, "{count} curves in a step");
}

#[test]
fn wrong_searches_are_named() {
    let (mut kernel, _) = kernel_with_index(1);
    let numbers = path(30, 1.0);
    let mut wrong = |change: Value, numbers: &[f64], reason: &str| {
        let mut request = open_request(numbers, "closed", true);
        request.as_object_mut().unwrap().extend(change.as_object().unwrap().clone());
        let error = error(&mut kernel, &request, numbers);
        assert!(error.contains(reason), "{error}, not {reason}");
    };
    wrong(json!({ "kind": "round" }), &numbers, "`closed`, `open` or `part`");
    wrong(json!({ "points": { "$": [1, 60] } }), &numbers, "`points` of the request has another form");
    wrong(json!({ "points": { "$": [0, u64::MAX] } }), &numbers, "`points` of the request has another form");
    wrong(json!({ "points": { "$": [0, 59] } }), &numbers, "an x without a y");
    wrong(json!({}), &[1.0; 20], "at least 5 distinct points");
    wrong(json!({}), &[f64::NAN; 20], "not finite");
    wrong(json!({}), &vec![1.0; 2000], "at most 400 are searched for");
    let none = json!({ "method": "step_search", "search": 7 });
    assert!(error(&mut kernel, &none, &[]).contains("the handle 7 is not open"));
}
