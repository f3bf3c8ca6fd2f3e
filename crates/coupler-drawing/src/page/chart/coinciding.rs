//! Lines of a chart that coincide, which are drawn once.

use std::collections::BTreeMap;

use crate::chart::Series;

/// The label of each line for the quantity at an index: with those of the later lines that coincide with it, and empty if
/// all lines do; `None` if it coincides with an earlier line.
///
/// Measures of the linkage, for example, are the same for each of its traced points.
pub(super) fn shared_labels(series: &[Series], quantity_index: usize) -> Vec<Option<String>> {
    let mut groups: BTreeMap<Vec<u64>, Vec<usize>> = BTreeMap::new();
    for (k, line) in series.iter().enumerate() {
        groups.entry(line.points(quantity_index).flatten().map(value_bits).collect()).or_default().push(k);
    }
    let mut labels = vec![None; series.len()];
    for lines in groups.into_values() {
        labels[lines[0]] = Some(match lines.len() == series.len() {
            true => String::new(),
            false => {
                let label = |&k: &usize| series[k].label.as_str();
                let all: Vec<&str> = series.iter().map(|line| line.label.as_str()).collect();
                let own: Vec<&str> = lines.iter().map(label).collect();
                common_parts(&own, &all).unwrap_or_else(|| joined_label(own))
            }
        });
    }
    if let [only] = series {
        labels[0] = Some(only.label.clone());
    }
    labels
}

/// The bits of a value, by which lines are compared: all gaps are equal, and so are both zeros.
fn value_bits(value: f64) -> u64 {
    if value.is_nan() { f64::NAN.to_bits() } else { (value + 0.0).to_bits() }
}

/// The parts that some labels have in common, if no other label has all of them: the other parts distinguish no lines.
fn common_parts(own: &[&str], all: &[&str]) -> Option<String> {
    let parts = |label: &str| label.split(", ").map(str::to_owned).collect::<Vec<String>>();
    let (first, others) = own.split_first()?;
    let mut common = parts(first);
    common.retain(|part| others.iter().all(|label| parts(label).contains(part)));
    let has_all = |label: &&&str| common.iter().all(|part| parts(label).contains(part));
    (!common.is_empty() && all.iter().filter(has_all).count() == own.len()).then(|| common.join(", "))
}

fn joined_label(labels: Vec<&str>) -> String {
    /// The most labels that are joined; of more, the first and the last are named.
    const MAX_JOINED: usize = 3;
    match &labels[..] {
        [first, .., last] if labels.len() > MAX_JOINED => format!("{first} … {last} ({} lines)", labels.len()),
        few => few.join("; "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coinciding_lines_share_a_label() {
        let line = |label: &str, y: &[f64]| Series {
            label: label.to_owned(),
            x: vec![1.0, 2.0],
            y: vec![y.to_vec()],
            ..Series::default()
        };
        let labels = |lines: &[Series]| -> Vec<String> {
            shared_labels(lines, 0).into_iter().map(|label| label.unwrap_or_else(|| "-".to_owned())).collect()
        };
        let [a, b, c] = [line("a", &[0.0, f64::NAN]), line("b", &[0.0, 1.0]), line("c", &[-0.0, -f64::NAN])];
        assert_eq!(labels(&[a.clone(), b.clone(), c.clone()]), ["a; c", "b", "-"]);
        assert_eq!(labels(&[a.clone(), c.clone()]), ["", "-"]);
        assert_eq!(labels(std::slice::from_ref(&b)), ["b"]);
        assert_eq!(labels(&[b, a.clone(), a.clone(), c.clone(), c])[1], "a … c (4 lines)");
        let [first, second] = ["p = 1", "p = 2"].map(|p| {
            let y = [p.len() as f64, if p == "p = 1" { 1.0 } else { 2.0 }];
            ["path of M", "path of B"].map(|path| line(&format!("{p}, {path}"), &y))
        });
        assert_eq!(labels(&[first, second].concat()), ["p = 1", "-", "p = 2", "-"]);
        assert!(labels(&[]).is_empty());
    }
}
