/// The indices of some numbers in rising order; equal ones keep their order.
pub fn rising_order(keys: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..keys.len()).collect();
    order.sort_by(|&a, &b| keys[a].total_cmp(&keys[b]));
    order
}

/// Some items in the rising order of a key; items with equal keys keep their order.
pub fn in_rising_order<T>(items: Vec<T>, key: impl Fn(&T) -> f64) -> Vec<T> {
    let keys: Vec<f64> = items.iter().map(key).collect();
    let mut items: Vec<Option<T>> = items.into_iter().map(Some).collect();
    rising_order(&keys).into_iter().filter_map(|k| items[k].take()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_items_keep_their_order() {
        assert_eq!(rising_order(&[2.0, -1.0, 2.0, 0.0]), [1, 3, 0, 2]);
        assert_eq!(
            in_rising_order(vec![(1.0, 'a'), (0.5, 'b'), (1.0, 'c')], |item| item.0),
            [(0.5, 'b'), (1.0, 'a'), (1.0, 'c')]
        );
    }
}
