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
            false => joined_label(lines.iter().map(|&k| series[k].label.as_str()).collect()),
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
        assert!(labels(&[]).is_empty());
    }
}
