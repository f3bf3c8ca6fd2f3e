//! The linkages of the catalogue can be opened without an atlas, with the values that the catalogue gives.

use coupler_curves::catalogue;
use coupler_kernel::{Kernel, Response};
use serde_json::{Value, json};

/// The answer to a request that must have one, and its numbers.
fn answer(kernel: &mut Kernel, request: &Value) -> (Value, Vec<f64>) {
    let Response { json, numbers } = kernel.call(&request.to_string());
    let value: Value = serde_json::from_str(&json).unwrap();
    assert!(value.get("error").is_none(), "{request}: {value}");
    (value, numbers)
}

fn array<'n>(value: &Value, numbers: &'n [f64]) -> &'n [f64] {
    let [start, length] = [0, 1].map(|k| value["$"][k].as_u64().unwrap() as usize);
    &numbers[start..start + length]
}

#[test]
fn an_angle_has_a_unit_and_a_length_has_none() {
    let mut kernel = Kernel::default();
    let (listed, _) = answer(&mut kernel, &json!({ "method": "catalogue" }));
    let yoke = listed["linkages"].as_array().unwrap().iter().find(|linkage| linkage["id"] == "scotch-yoke").unwrap();
    let (opened, _) = answer(&mut kernel, &json!({ "method": "open_family", "manifest": yoke["manifest"] }));
    let names = opened["names"].as_array().unwrap();
    let unit = |name: &str| names.iter().find(|one| one["name"] == name).unwrap()["unit"].clone();
    assert_eq!([unit("angle"), unit("r")], [json!("deg"), Value::Null]);
}

#[test]
fn every_linkage_of_the_catalogue_has_a_first_cell_with_its_own_values() {
    let mut kernel = Kernel::default();
    let (listed, _) = answer(&mut kernel, &json!({ "method": "catalogue" }));
    let listed = listed["linkages"].as_array().unwrap();
    assert_eq!(listed.len(), catalogue::all().len());
    for (linkage, template) in listed.iter().zip(catalogue::all()) {
        assert_eq!([&linkage["id"], &linkage["legend"]], [&json!(template.id), &json!(template.legend)]);
        let (family, _) = answer(&mut kernel, &json!({ "method": "open_family", "manifest": linkage["manifest"] }));
        let (table, numbers) = answer(&mut kernel, &json!({ "method": "first_cell", "family": family["family"] }));
        let (head, cells, curves) = (&table["head"], &table["cells"], &table["curves"]);
        let value = |name: &str| {
            let slot = head["names"].as_array().unwrap().iter().position(|known| known == name).unwrap();
            (slot, cells["values"][slot].as_f64().unwrap())
        };
        for parameter in &template.parameters {
            let (slot, value) = value(&parameter.name);
            let is_free = head["free"].as_array().unwrap().contains(&json!(slot));
            match (parameter.example, parameter.default_text.parse::<f64>()) {
                (Some(example), _) => assert_eq!((value, is_free), (example, true), "{}", template.id),
                (None, Ok(default)) => assert_eq!((value, is_free), (default, true), "{}", template.id),
                _ => assert!(value.is_finite() && !is_free, "{}", template.id),
            }
        }
        // The first curve is that of a study with these values, as the page opens it.
        let assigned: Vec<(&Value, String)> = head["free"]
            .as_array()
            .unwrap()
            .iter()
            .map(|slot| {
                let slot = slot.as_u64().unwrap() as usize;
                (&head["names"][slot], cells["values"][slot].to_string())
            })
            .collect();
        let curve =
            json!({ "family": family["family"], "cell": 1, "curve": [1, 1], "values": assigned, "changes": [] });
        let (study, _) =
            answer(&mut kernel, &json!({ "method": "open_study", "curve": curve, "shown": null, "is_rough": true }));
        let studied: Vec<f64> =
            study["curve_box"].as_array().unwrap().iter().map(|side| side.as_f64().unwrap()).collect();
        let size = (studied[2] - studied[0]).max(studied[3] - studied[1]);
        for (side, studied) in curves["box"].as_array().unwrap().iter().zip(studied) {
            // Both are sampled, at other inputs.
            assert!((array(side, &numbers)[0] - studied).abs() < 2e-2 * size, "{}", template.id);
        }
        let count: f64 = array(&curves["count"], &numbers).iter().sum();
        let points = array(&curves["points"], &numbers);
        assert_eq!(points.len(), 2 * count as usize);
        assert!(points.iter().all(|part| part.fract() == 0.0 && (0.0..=65535.0).contains(part)));
        for column in cells["measures"].as_array().unwrap() {
            assert_eq!(array(column, &numbers).len(), curves["curves"].as_u64().unwrap() as usize);
        }
    }
}

/// The data of a curve with changes have its own values, measures and bounds, under the number that its cell has.
#[test]
fn a_changed_curve_is_a_family_of_its_own() {
    let mut kernel = Kernel::default();
    let manifest =
        "[atlas]\ntitle = \"T\"\n[[family]]\nid = \"h\"\nlinkage = \"hoeken\"\ngrid = { r = [1, 1.1, 1.2] }\n";
    let (family, _) = answer(&mut kernel, &json!({ "method": "open_family", "manifest": manifest }));
    let mut data = |changes: Value| {
        let curve = json!({
            "family": family["family"], "cell": 3, "curve": [1, 1], "values": [["r", "1.2"]], "changes": changes,
        });
        answer(&mut kernel, &json!({ "method": "curve_data", "curve": curve }))
    };
    let (plain, plain_numbers) = data(json!([]));
    let (twice, twice_numbers) = data(json!([["p", 4], ["r", "2.4"], ["a", 5]]));
    let slot = |name: &str| plain["head"]["names"].as_array().unwrap().iter().position(|known| known == name).unwrap();
    assert_eq!([&plain["cells"]["number"], &twice["cells"]["number"]], [3, 3]);
    assert_eq!([&plain["cells"]["values"][slot("r")], &twice["cells"]["values"][slot("r")]], [1.2, 2.4]);
    assert_eq!(plain["cells"]["curves"], 1);
    // Twice the linkage has twice the curve.
    for side in 0..4 {
        let [one, other] = [(&plain, &plain_numbers), (&twice, &twice_numbers)]
            .map(|(data, numbers)| array(&data["curves"]["box"][side], numbers)[0]);
        assert!((2.0 * one - other).abs() < 1e-9, "{one} {other}");
    }
    let length = plain["head"]["measures"].as_array().unwrap().iter().position(|name| name == "length").unwrap();
    let [one, other] = [(&plain, &plain_numbers), (&twice, &twice_numbers)]
        .map(|(data, numbers)| array(&data["cells"]["measures"][length], numbers)[0]);
    assert!(one > 1.0 && (2.0 * one - other).abs() < 1e-6 * other, "{one} {other}");
}

#[test]
fn a_family_without_a_curve_says_why() {
    let mut kernel = Kernel::default();
    let manifest = "[atlas]\ntitle = \"T\"\n[[family]]\nid = \"far\"\nlinkage = \"four-bar\"\n\
                    cases = [{ frame = 9, crank = 1, coupler = 1, rocker = 1 }]\n";
    let (family, _) = answer(&mut kernel, &json!({ "method": "open_family", "manifest": manifest }));
    let Response { json, .. } = kernel.call(&json!({ "method": "first_cell", "family": family["family"] }).to_string());
    assert!(json.contains("`far` has no curve: "), "{json}");
}
