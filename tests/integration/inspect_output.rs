//! The order of what `inspect` prints: the most important lines of the text first, and the keys of the JSON as documented.

use std::fmt;
use std::path::Path;

use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};

use crate::support::command::printed;

fn inspect(arguments: &[&str]) -> String {
    printed(Path::new("."), &[&["inspect"], arguments].concat())
}

/// The titles of the lines of a text, up to their colons.
fn titles(text: &str) -> Vec<&str> {
    text.lines().map(|line| line.split(':').next().unwrap()).collect()
}

#[test]
fn the_text_begins_with_class_limits_transmission_angle_and_straight_portion() {
    let text = inspect(&["roberts", "p=2", "r=2", "a=1", "b=2"]);
    let first = ["roberts", "class", "limits of the input", "transmission angle", "straight portion"];
    assert_eq!(titles(&text)[..5], first, "{text}");
    assert!(text.contains("\nlimits of the input: 28.95502437° to 97.18075578°, where it jams\n"), "{text}");
    assert!(text.contains("\ntransmission angle: worst 0°, from 0° to 180°\n"), "{text}");
    let text = inspect(&["klann"]);
    assert_eq!(titles(&text)[1..5], ["six-bar", "limits of the input", "transmission angle", "straight portion"]);
    assert!(text.contains("\nlimits of the input: none, it turns fully\n"), "{text}");
    // Of several curves, that with the longest portion for its size is named.
    let text = inspect(&["hrones-nelson"]);
    assert!(text.contains(" (trace 2, circuit 1, the longest for the size of its curve among 10)\n"), "{text}");
    // An actuator has lengths, and its point moves on a circle.
    let text = inspect(&["linear-actuator"]);
    assert!(
        text.contains("\nlimits of the input: 1 to 3, where it jams\n") && text.contains("\nstraight portion: none\n"),
        "{text}"
    );
    // A linkage that cannot be assembled has none of them.
    let text = inspect(&["evans", "p=9", "a=1"]);
    assert_eq!(
        titles(&text)[1..4],
        ["class", "not assembled", "limits of the rocker, by the crank's angle from the frame"]
    );
}

#[test]
fn the_summary_has_the_numbers_of_the_measures() {
    let text = inspect(&["hoeken"]);
    let json: serde_json::Value = serde_json::from_str(&inspect(&["hoeken", "--json"])).unwrap();
    let measures = &json["curves"][0]["measures"];
    let line = |title: &str| text.lines().find(|line| line.starts_with(title)).unwrap_or_else(|| panic!("{title}"));
    let numbers = |line: &str| -> Vec<f64> {
        let words = line.split([' ', '°', ',']).filter_map(|word| word.parse().ok());
        words.collect()
    };
    let compare = |title: &str, names: &[(&str, f64)]| {
        let found = numbers(line(title));
        assert_eq!(found.len(), names.len(), "{found:?}");
        for (number, (name, factor)) in found.iter().zip(names) {
            let exact = factor * measures[name].as_f64().unwrap_or_else(|| panic!("{name}"));
            assert!((number - exact).abs() <= 1e-2 * exact.abs(), "{name}: {number} {exact}");
        }
    };
    compare("transmission angle", &[("mu_worst_deg", 1.0), ("mu_min_deg", 1.0), ("mu_max_deg", 1.0)]);
    compare(
        "straight portion",
        &[
            ("straight_length", 1.0),
            ("straight_share", 100.0),
            ("straight_deviation", 1.0),
            ("straight_start_deg", 1.0),
            ("straight_input_deg", 1.0),
            ("straight_twin_deg", 1.0),
        ],
    );
}

/// JSON with the keys of its objects in their order.
enum Ordered {
    Scalar,
    List(Vec<Ordered>),
    Object(Vec<(String, Ordered)>),
}

impl<'de> Deserialize<'de> for Ordered {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Ordered, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = Ordered;
            fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
                formatter.write_str("JSON")
            }
            fn visit_unit<E>(self) -> Result<Ordered, E> {
                Ok(Ordered::Scalar)
            }
            fn visit_bool<E>(self, _: bool) -> Result<Ordered, E> {
                Ok(Ordered::Scalar)
            }
            fn visit_u64<E>(self, _: u64) -> Result<Ordered, E> {
                Ok(Ordered::Scalar)
            }
            fn visit_i64<E>(self, _: i64) -> Result<Ordered, E> {
                Ok(Ordered::Scalar)
            }
            fn visit_f64<E>(self, _: f64) -> Result<Ordered, E> {
                Ok(Ordered::Scalar)
            }
            fn visit_str<E>(self, _: &str) -> Result<Ordered, E> {
                Ok(Ordered::Scalar)
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Ordered, A::Error> {
                let mut items = Vec::new();
                while let Some(item) = list.next_element()? {
                    items.push(item);
                }
                Ok(Ordered::List(items))
            }
            fn visit_map<A: MapAccess<'de>>(self, mut object: A) -> Result<Ordered, A::Error> {
                let mut entries = Vec::new();
                while let Some(entry) = object.next_entry()? {
                    entries.push(entry);
                }
                Ok(Ordered::Object(entries))
            }
        }
        deserializer.deserialize_any(Reader)
    }
}

/// Calls a function with each object inside another, and with its key or that of the list in which it is.
fn for_each_object(value: &Ordered, key: &str, receive: &mut dyn FnMut(&str, Vec<&str>)) {
    match value {
        Ordered::Scalar => {}
        Ordered::List(items) => items.iter().for_each(|item| for_each_object(item, key, receive)),
        Ordered::Object(entries) => {
            receive(key, entries.iter().map(|(key, _)| key.as_str()).collect());
            entries.iter().for_each(|(key, value)| for_each_object(value, key, receive));
        }
    }
}

/// Whether these words are in a list, one after another, possibly with others in between.
fn are_in_order<'l>(words: &[&str], mut list: impl Iterator<Item = &'l str>) -> bool {
    words.iter().all(|word| list.any(|other| other == *word))
}

/// The permitted error of a length is the one at which the straight portion's printed length changes by its last digit.
#[test]
fn a_length_may_be_off_by_as_much_as_is_printed() {
    let length = |arguments: &[&str]| -> f64 {
        let text = inspect(&[&["evans", "p=2.5", "r=1"][..], arguments, &["--json"]].concat());
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        json["curves"][0]["measures"]["straight_length"].as_f64().unwrap()
    };
    let text = inspect(&["evans", "p=2.5", "r=1", "a=3.3", "s=3.3", "--tolerance", "0.1", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let curve = &json["tolerance"]["curves"][0];
    let of =
        |name: &str| curve["lengths"].as_array().unwrap().iter().find(|length| length["name"] == name).unwrap().clone();
    assert!(curve["root_sum_square"].as_f64() < curve["worst_case"].as_f64());
    let permitted = of("CB")["permitted"].as_f64().unwrap();
    let whole = length(&["a=3.3", "s=3.3"]);
    let changed = length(&["a=3.3", &format!("s={}", 3.3 + permitted)]);
    let exponent: i32 = format!("{whole:e}").split_once('e').unwrap().1.parse().unwrap();
    let digit: f64 = format!("1e{}", exponent - 3).parse().unwrap();
    assert!(((changed - whole).abs() / digit - 1.0).abs() < 0.05, "{whole}, {changed}: {permitted}");
    let text = inspect(&["evans", "p=2.5", "r=1", "a=3.3", "s=3.3", "--tolerance", "0.1"]);
    assert!(
        text.contains("\ntolerance: every length off by 0.1 moves the curve (trace 1, circuit 1) by at most "),
        "{text}"
    );
}

/// In each object, the keys are in the order in which docs/inspect.md describes them.
#[test]
fn the_keys_of_the_json_are_in_the_documented_order() {
    let document = include_str!("../../docs/inspect.md");
    // Each part begins with a table, and ends before the next one.
    let parts: Vec<&str> = document.split("\n| key |").skip(1).collect();
    let words = |part: &'static str| part.split('`').skip(1).step_by(2);
    let first_column = parts[0].lines().filter_map(|line| line.strip_prefix("| `")?.split(" |").next());
    let top_level: Vec<&str> = first_column.flat_map(|cell| cell.split(['`', ',', ' '])).collect();
    let measures = printed(Path::new("."), &["list", "measures"]);
    let mut seen = 0;
    for arguments in [
        &["watt", "p=4", "r=2", "a=2", "s=2", "--at", "10", "--cognates"][..],
        &["inverted-slider-crank"],
        &["roberts", "p=2", "r=2", "a=1", "b=2"],
        &["evans", "p=2", "a=2.5", "--tolerance", "0.01"],
    ] {
        let text = inspect(&[arguments, &["--json"]].concat());
        let plain = inspect(arguments);
        let (_, values) = plain.lines().next().unwrap().split_once(": ").unwrap();
        let parameters: Vec<&str> = values.split(", ").map(|value| value.split(" =").next().unwrap()).collect();
        for_each_object(&serde_json::from_str(&text).unwrap(), "", &mut |key, keys| {
            seen += 1;
            let is_ordered = match key {
                "" => are_in_order(&keys, top_level.iter().copied()),
                // The order in which the text has them.
                "parameters" => keys == parameters,
                "measures" => {
                    keys == measures
                        .lines()
                        .take(keys.len())
                        .filter_map(|line| line.split(' ').next())
                        .collect::<Vec<_>>()
                }
                _ => parts.iter().any(|part| are_in_order(&keys, words(part))),
            };
            assert!(is_ordered, "{arguments:?}: the keys of `{key}` are {keys:?}");
        });
    }
    assert!(seen > 100, "{seen}");
}
