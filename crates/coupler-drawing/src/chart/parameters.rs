//! The order of the lines of a chart.

/// The places of groups in an order, from 0 to 1, given the values of their names; `None` if the groups are in no
/// order, because no name is greater wherever another one is, or less.
pub(super) fn ordered_places(groups: &[Vec<f64>]) -> Option<Vec<f64>> {
    let first = groups.first()?;
    let varying: Vec<usize> = (0..first.len()).filter(|&k| groups.iter().any(|group| group[k] != first[k])).collect();
    let leading = *varying.first()?;
    let mut order: Vec<usize> = (0..groups.len()).collect();
    order.sort_by(|&a, &b| groups[a][leading].total_cmp(&groups[b][leading]));
    let is_monotonic = |&name: &usize| {
        let values = order.iter().map(|&group| groups[group][name]);
        values.clone().is_sorted_by(|a, b| a < b) || values.is_sorted_by(|a, b| a > b)
    };
    varying.iter().all(is_monotonic).then(|| {
        let mut places = vec![0.0; groups.len()];
        order.iter().enumerate().for_each(|(k, &group)| places[group] = k as f64 / (groups.len() - 1) as f64);
        places
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_are_ordered_by_values_that_change_together() {
        let places = |groups: &[&[f64]]| ordered_places(&groups.iter().map(|group| group.to_vec()).collect::<Vec<_>>());
        assert_eq!(places(&[&[3.0], &[1.0], &[2.0]]), Some(vec![1.0, 0.0, 0.5]));
        assert_eq!(places(&[&[1.0, 9.0, 5.0], &[2.0, 8.0, 5.0]]), Some(vec![0.0, 1.0]));
        assert_eq!(places(&[&[1.0, 1.0], &[1.0, 2.0], &[2.0, 1.0]]), None, "a grid of two parameters");
        assert_eq!(places(&[&[1.0]]), None);
        assert_eq!(places(&[&[], &[]]), None);
        assert_eq!(places(&[]), None);
    }
}
