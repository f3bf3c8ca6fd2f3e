//! The parser and the schema both reject errors of form, and the schema accepts whatever the parser accepts.

use serde_json::{Value, json};

use super::{EVERY_KEY, collect_pointers, is_valid, json, parser_errors, schema_errors, toml};

/// Replacements in the manifest that has every key, at least one in each table: unknown keys, wrong types, unknown
/// words, numbers out of range.
const SLIPS: [(&str, &str); 68] = [
    ("[atlas]\n", "[atlass]\n[atlas]\n"),
    ("[atlas]\n", "families = 3\n[atlas]\n"),
    ("title = \"Every key\"", "titel = \"Every key\""),
    ("title = \"Every key\"", "title = 3"),
    ("format = 1\n", "format = 2\n"),
    ("format = 1\n", "format = \"1\"\n"),
    ("\"svg\", \"png\", \"pdf\"", "\"swg\""),
    ("\"svg\", \"png\", \"pdf\"", ""),
    ("volume_pages = 100", "volume_pages = 0"),
    ("dpi = 100", "dpi = 100\nppi = 3"),
    ("dpi = 100", "dpi = 9"),
    ("dash = \"5 deg\"", "dash = 5"),
    ("dash = \"5 deg\"", "dash = \"5 mm\""),
    ("\"outlines\"", "\"outline\""),
    ("{ width = \"300 mm\", height = \"8.5 in\" }", "\"a7\""),
    ("{ width = \"300 mm\", height = \"8.5 in\" }", "{ width = \"300 mm\" }"),
    ("width = \"300 mm\"", "width = 300"),
    ("width = \"300 mm\"", "depth = \"1 mm\", width = \"300 mm\""),
    ("base = \"paper\"", "base = \"parchment\""),
    ("drawn = 0.6", "drawn = 2"),
    ("drawn = 0.6", "drown = 0.6"),
    ("ink = \"#000\"", "ink = \"#0000\""),
    ("ink = \"#000\"", "ink = \"black\""),
    ("monochrome = true", "monochrome = \"yes\""),
    ("face = \"sans\"", "face = \"times\""),
    ("weights = { link", "weights = { links"),
    ("lettering = { title", "lettering = { titles"),
    ("source = \"3.8 mm\"", "source = 3.8"),
    ("id = \"panels\"", "id = \"Panels\""),
    ("id = \"panels\"", "id = \"con\""),
    ("id = \"panels\"", "id = \"lpt1\""),
    ("linkage = \"evans\"\n", "linkge = \"evans\"\n"),
    ("layout = \"panels\"", "layout = \"tiles\""),
    ("panels = [2, 1]", "panels = [2]"),
    ("panels = [2, 1]", "panels = [0, 1]"),
    ("sampling = { step = \"10 deg\" }", "sampling = {}"),
    ("sampling = { step = \"10 deg\" }", "sampling = { step = \"10 deg\", samples = 9 }"),
    ("sampling = { step = \"10 deg\" }", "sampling = { steps = \"10 deg\" }"),
    ("spacing = \"smooth\"", "spacing = \"dense\""),
    ("from = 2, to = 3, step = 0.5", "from = 2, to = 3, step = 0.5, count = 3"),
    ("from = 2, to = 3, step = 0.5", "from = 2, to = 3, by = 0.5"),
    ("k = 2 }", "\"2k\" = 2 }"),
    ("k = 2 }", "k = [] }"),
    ("k = 2 }", "k = true }"),
    ("where = \"is_crank_rocker and mu_min_deg > 1\"", "where = 3"),
    ("mirror = true", "mirror = 1"),
    ("mirror = true", "mirrored = true"),
    ("\"psi_deg\", \"vx\"", "\"psi\", \"vx\""),
    ("tolerance = 0.001", "tolerance = 0.001, length = 2"),
    ("tolerance = 0.001", "tolerance = 0"),
    ("chart = { x = \"p\"", "chart = { over = \"p\""),
    ("straight_length = [0, 3]", "straight_length = [0]"),
    ("cases = [{ g = 4, r = 1 }", "cases = [{ g = [4], r = 1 }"),
    ("[family.design]", "grid = { crank = 2 }\n[family.design]"),
    ("maximize = [", "maximise = ["),
    ("max_link = 250", "max_link = 0"),
    ("best = 1", "best = 0"),
    ("effort = \"quick\"", "effort = \"fast\""),
    ("range = [\"p = 2..3 by 0.5\"]", "range = [2, 3]"),
    ("g = { min = 0, max = 10, example = 4 }", "g = { least = 0, max = 10 }"),
    ("branch = 1", "branch = \"left\", side = 3"),
    ("input = { from = \"0 deg\", to", "input = { form = \"0 deg\", to"),
    ("start = \"10 deg\"", "start = [10]"),
    ("dyad = [\"A\", \"C\"]", "dyad = [\"A\"]"),
    ("side = \"ahead\"", "side = \"left\""),
    ("fixed = [0, 0]", "fixd = [0, 0]"),
    ("length = 5, line", "line"),
    ("along = { from = 0, to = 2, count = 3 }", "along = { from = 0, to = 2, step = 1 }"),
];

#[test]
fn slips_are_found_by_the_parser_and_the_schema() {
    assert!(parser_errors(EVERY_KEY).is_none() && is_valid(&json(EVERY_KEY)));
    for (from, to) in SLIPS {
        let text = EVERY_KEY.replacen(from, to, 1);
        assert_ne!(text, EVERY_KEY, "{from}");
        assert!(parser_errors(&text).is_some(), "the parser accepts {to}");
        assert!(!is_valid(&json(&text)), "the schema accepts {to}");
    }
}

/// Parts of the parser's messages about errors of form, which do not depend on the meaning of the values.
const FORM: [&str; 25] = [
    ", found a string",
    ", found a number",
    ", found a boolean",
    ", found a date",
    ", found a list",
    ", found a table",
    "expected two values, found ",
    " has no key `",
    " has no `",
    "the manifest has no ",
    " is not one of the words allowed here",
    "invalid value `",
    "does not say how it is placed",
    ", not both",
    "needs a step or a ",
    "takes exactly one of",
    " has no values",
    "there are no cases",
    "`y` is empty",
    "`formats` is empty",
    "no joint is traced",
    "`curves` is empty",
    " is not a colour",
    " is not a slug",
    "`where` must be a condition in quotes",
];

/// Removes each value of the manifest that has every key, and replaces it by others.
#[test]
#[ignore = "thorough"]
fn the_parser_and_the_schema_agree_on_every_changed_value() {
    let whole = json(EVERY_KEY);
    let mut pointers = Vec::new();
    collect_pointers(&whole, "", &mut pointers);
    let others = [json!(true), json!(3), json!(-1), json!(2.5), json!("x"), json!([]), json!([1]), json!({})];
    let (mut accepted, mut rejected) = (0, 0);
    let mut check = |changed: &Value, change: &str| {
        let is_valid = is_valid(changed);
        match parser_errors(&toml(changed)) {
            None => {
                accepted += 1;
                assert!(is_valid, "{change}: the parser accepts it, but the schema says {}", schema_errors(changed));
            }
            Some(errors) => {
                let form_error = errors.iter().find(|(message, _)| FORM.iter().any(|form| message.contains(form)));
                if let Some((message, _)) = form_error {
                    rejected += 1;
                    assert!(!is_valid, "{change}: the schema accepts it, but the parser says {message}");
                }
            }
        }
    };
    for pointer in pointers.iter().filter(|pointer| !pointer.is_empty()) {
        for other in &others {
            let mut changed = whole.clone();
            *changed.pointer_mut(pointer).unwrap() = other.clone();
            check(&changed, &format!("{pointer} = {other}"));
        }
        let (parent, name) = pointer.rsplit_once('/').unwrap();
        let mut changed = whole.clone();
        match changed.pointer_mut(parent).unwrap() {
            Value::Object(entries) => drop(entries.remove(name)),
            Value::Array(items) => drop(items.remove(name.parse().unwrap())),
            _ => unreachable!("a value is in a table or a list"),
        }
        check(&changed, &format!("without {pointer}"));
    }
    assert!(accepted > 100 && rejected > 1000, "{accepted} were accepted, {rejected} rejected for their form");
}
