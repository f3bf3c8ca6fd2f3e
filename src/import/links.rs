//! LINKS and LInK: bars between points, by lists in JSON.

use std::collections::BTreeSet;

use serde_json::{Map, Value};

use super::error::{Error, quote};
use super::json_values::{index, indices, position, unit};
use super::sketch::{Sketch, SketchInput};

const ORIGIN: &str = "a file of LINKS or LInK";

/// Whether an object has the keys of this format.
pub fn is_links(object: &Map<String, Value>) -> bool {
    ["edges", "A", "x0", "positions"].iter().any(|key| object.contains_key(*key))
}

/// Reads a linkage from the lists `edges`, `positions`, `fixed`, `motor` and `target`, or from the arrays `A`, `x0`,
/// `fixed_nodes`, `motor` and `target`.
///
/// # Errors
/// A list is missing or wrong.
pub fn parse(object: &Map<String, Value>) -> Result<Sketch, Error> {
    let mut sketch = Sketch::new(ORIGIN);
    let either = |keys: [&'static str; 2]| keys.into_iter().find_map(|key| Some((key, object.get(key)?)));
    let list = |keys: [&'static str; 2]| {
        let (key, value) = either(keys).ok_or_else(|| {
            let message = format!("there is neither `{}` nor `{}`", keys[0], keys[1]);
            Error::new(ORIGIN, message, format!("add `{}`", keys[0]))
        })?;
        let list = value.as_array();
        list.map(|list| (key, list))
            .ok_or_else(|| Error::new(format!("`{key}`"), "expected a list", "write it as a list"))
    };
    let (key, positions) = list(["positions", "x0"])?;
    for (k, value) in positions.iter().enumerate() {
        sketch.add_joint(joint_name(k), position(value, &format!("`{key}`, entry {k}"))?)?;
    }
    let count = sketch.joints.len();
    let (key, fixed) = list(["fixed", "fixed_nodes"])?;
    for joint in indices(fixed, key, count)? {
        sketch.joints[joint].is_fixed = true;
    }
    let edges = match object.get("edges") {
        Some(_) => listed_edges(list(["edges", "edges"])?.1, count)?,
        None => adjacent(list(["A", "A"])?.1, count)?,
    };
    add_bars(&edges, &mut sketch)?;
    if let Some(motor) = object.get("motor").and_then(Value::as_array) {
        sketch.input = Some(motor_input(&indices(motor, "motor", count)?, "`motor`")?);
    }
    match object.get("target") {
        None | Some(Value::Null) => {}
        Some(target) => {
            let target = index(target, "`target`", count)?;
            sketch.joints[target].is_traced = true;
        }
    }
    sketch.title = object.get("name").and_then(Value::as_str).map(str::to_owned);
    sketch.unit = unit(object);
    Ok(sketch)
}

/// The name of a joint that has none.
pub fn joint_name(index: usize) -> String {
    format!("J{index}")
}

/// The input of a crank by its pivot and its pin.
///
/// # Errors
/// There are other than two joints.
pub fn motor_input(joints: &[usize], place: &str) -> Result<SketchInput, Error> {
    match joints {
        &[a, b] if a != b => Ok(SketchInput::Line([a, b])),
        _ => {
            let message = "it does not name two joints";
            Err(Error::new(place, message, "write the pivot of the crank and its pin, as in [0, 1]"))
        }
    }
}

/// Adds the links that bars form.
///
/// # Errors
/// There are too many.
pub fn add_bars(edges: &BTreeSet<[usize; 2]>, sketch: &mut Sketch) -> Result<(), Error> {
    let edges: Vec<[usize; 2]> = edges.iter().copied().collect();
    for joints in rigid_links(sketch.joints.len(), &edges) {
        let names: Vec<&str> = joints.iter().map(|joint| sketch.joints[*joint].name.as_str()).collect();
        let link = sketch.add_link(names.join("-"))?;
        sketch.links[link].joints = joints;
    }
    Ok(())
}

/// Adds a bar between two joints.
///
/// # Errors
/// It is from a joint to itself.
pub fn add_edge([a, b]: [usize; 2], place: &str, edges: &mut BTreeSet<[usize; 2]>) -> Result<(), Error> {
    if a == b {
        return Err(Error::new(place, format!("the bar is from joint {a} to itself"), "leave it out"));
    }
    edges.insert([a.min(b), a.max(b)]);
    Ok(())
}

/// The edges of a list of pairs, each in ascending order.
fn listed_edges(list: &[Value], count: usize) -> Result<BTreeSet<[usize; 2]>, Error> {
    let mut edges = BTreeSet::new();
    for (k, value) in list.iter().enumerate() {
        let place = format!("`edges`, entry {k}");
        let pair = value.as_array().map(Vec::as_slice).unwrap_or_default();
        let [a, b] = pair else {
            let message = format!("expected two joints, found {}", quote(&value.to_string()));
            return Err(Error::new(place, message, "write the two joints of a bar, as in [0, 1]"));
        };
        add_edge([index(a, &place, count)?, index(b, &place, count)?], &place, &mut edges)?;
    }
    Ok(edges)
}

/// The edges of a matrix whose entries are not zero where two joints are joined.
fn adjacent(rows: &[Value], count: usize) -> Result<BTreeSet<[usize; 2]>, Error> {
    let mut edges = BTreeSet::new();
    for (i, row) in rows.iter().enumerate() {
        let place = format!("`A`, row {i}");
        let row = row.as_array().filter(|row| row.len() == count && rows.len() == count).ok_or_else(|| {
            Error::new(
                &place,
                format!("expected {count} rows of {count} numbers, one for each joint"),
                "complete the matrix",
            )
        })?;
        for (j, value) in row.iter().enumerate() {
            let is_joined = match value {
                Value::Bool(is_joined) => *is_joined,
                value => {
                    let message = format!("expected 0 or 1, found {}", quote(&value.to_string()));
                    value.as_f64().ok_or_else(|| Error::new(&place, message, "write 1 for a bar"))? != 0.0
                }
            };
            if is_joined && i != j {
                edges.insert([i.min(j), i.max(j)]);
            }
        }
    }
    Ok(edges)
}

/// The rigid links that bars form: three joints that are joined by three bars, and further ones that are so joined to two of a link.
fn rigid_links(count: usize, edges: &[[usize; 2]]) -> Vec<Vec<usize>> {
    let mut edge_at = vec![vec![None; count]; count];
    for (k, &[a, b]) in edges.iter().enumerate() {
        (edge_at[a][b], edge_at[b][a]) = (Some(k), Some(k));
    }
    // The bars of a triangle have one number, the least of theirs.
    let mut number: Vec<usize> = (0..edges.len()).collect();
    let root = |number: &[usize], mut k: usize| {
        while number[k] != k {
            k = number[k];
        }
        k
    };
    for (k, &[a, b]) in edges.iter().enumerate() {
        for (first, second) in edge_at[a].iter().zip(&edge_at[b]) {
            if let (&Some(first), &Some(second)) = (first, second) {
                let roots = [k, first, second].map(|edge| root(&number, edge));
                let least = roots.into_iter().min().unwrap_or(k);
                roots.into_iter().for_each(|root| number[root] = least);
            }
        }
    }
    let mut links: Vec<(usize, Vec<usize>)> = Vec::new();
    for (k, &edge) in edges.iter().enumerate() {
        let root = root(&number, k);
        let at = links.iter().position(|(other, _)| *other == root).unwrap_or_else(|| {
            links.push((root, Vec::new()));
            links.len() - 1
        });
        let joints = &mut links[at].1;
        edge.into_iter().for_each(|joint| {
            if !joints.contains(&joint) {
                joints.push(joint)
            }
        });
    }
    links.into_iter().map(|(_, joints)| joints).collect()
}
