//! What is wrong with a manifest's form its reader and the schema find; what the reader accepts, the schema does.

use serde_json::{Value, json};

use super::{EVERY_KEY, complaints, is_valid, json, objections, places, toml};

/// Replacements in the manifest that has every key, at least one in each table: unknown keys, wrong types, words that
/// are none, numbers out of range.
const SLIPS: [(&str, &str); 62] = [
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
    ("{ width = \"300 mm\", height = \"8.5 in\" }", "\"a5\""),
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
    ("g = { min = 0, max = 10 }", "g = { least = 0, max = 10 }"),
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
fn slips_are_found_by_both() {
    assert!(complaints(EVERY_KEY).is_none() && is_valid(&json(EVERY_KEY)));
    for (from, to) in SLIPS {
        let text = EVERY_KEY.replacen(from, to, 1);
        assert_ne!(text, EVERY_KEY, "{from}");
        assert!(complaints(&text).is_some(), "the reader accepts {to}");
        assert!(!is_valid(&json(&text)), "the schema accepts {to}");
    }
}

/// How the reader speaks of what is wrong with a manifest's form, whatever its values mean.
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
    "asked for by one of",
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

/// Every value of the manifest that has every key in turn is left out, replaced by others, or given a strange key.
#[test]
fn the_reader_and_the_schema_agree_wherever_a_manifest_is_spoilt() {
    let whole = json(EVERY_KEY);
    let mut all = Vec::new();
    places(&whole, "", &mut all);
    let others = [json!(true), json!(3), json!(-1), json!(2.5), json!("x"), json!([]), json!([1]), json!({})];
    let (mut accepted, mut refused) = (0, 0);
    let mut check = |spoilt: &Value, what: &str| {
        let valid = is_valid(spoilt);
        match complaints(&toml(spoilt)) {
            None => {
                accepted += 1;
                assert!(valid, "{what}: the reader accepts it, and the schema says {}", objections(spoilt));
            }
            Some(said) => {
                let of_form = said.iter().find(|(message, _)| FORM.iter().any(|form| message.contains(form)));
                if let Some((message, _)) = of_form {
                    refused += 1;
                    assert!(!valid, "{what}: the schema accepts it, and the reader says {message}");
                }
            }
        }
    };
    for place in all.iter().filter(|place| !place.is_empty()) {
        for other in &others {
            let mut spoilt = whole.clone();
            *spoilt.pointer_mut(place).unwrap() = other.clone();
            check(&spoilt, &format!("{place} = {other}"));
        }
        let (parent, name) = place.rsplit_once('/').unwrap();
        let mut spoilt = whole.clone();
        match spoilt.pointer_mut(parent).unwrap() {
            Value::Object(entries) => drop(entries.remove(name)),
            Value::Array(items) => drop(items.remove(name.parse().unwrap())),
            _ => unreachable!("a value is in a table or a list"),
        }
        check(&spoilt, &format!("without {place}"));
    }
    assert!(accepted > 100 && refused > 1000, "{accepted} were accepted, {refused} refused for their form");
}
