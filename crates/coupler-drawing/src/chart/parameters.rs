//! The parameters of a chart: which are the same on all of its lines, and in which order its lines are.

use super::words::{parameter_unit, printed_formula, printed_name};
use super::{Chart, PointSource};
use coupler_curves::expression::round_to_six_digits;
use coupler_curves::family::Family;

/// A value in print: at most six digits, with a true minus sign.
pub(super) fn printed_value(value: f64) -> String {
    // Adding 0 makes a negative zero positive.
    (round_to_six_digits(value) + 0.0).to_string().replace('-', "−")
}

/// A name of a family and its value in print, as in `p = 2.5`; an angle has its unit.
pub(super) fn printed_assignment(family: &Family, slot: usize, value: f64) -> String {
    let unit = match family.template.parameters.get(slot).map_or("", parameter_unit) {
        "deg" => "°",
        "rad" => " rad",
        unit => unit,
    };
    format!("{} = {}{unit}", printed_name(&family.names[slot]), printed_value(value))
}

/// The names of a family that are the same in all of these cells, by their numbers, with their values; and those that
/// are derived from others, with their formulas: `r = 1, a = (1 + p)^1.5 / 2`.
pub(super) fn fixed_parameters(chart: &Chart, family: &Family, cells: impl Iterator<Item = usize>) -> String {
    let mut values: Option<Vec<f64>> = None;
    let mut varies = vec![false; family.names.len()];
    for number in cells {
        let cell = family.cell(number - 1).values;
        let first = values.get_or_insert_with(|| cell.clone());
        varies.iter_mut().enumerate().for_each(|(slot, varies)| *varies |= cell[slot] != first[slot]);
    }
    let Some(values) = values else { return String::new() };
    let is_shown_otherwise = |slot: usize| {
        let is_x = chart.x.expression.slots() == [slot] && chart.point_source == PointSource::Curves;
        is_x && chart.x.expression.name_or_number().is_some()
    };
    let printed = |slot: usize| {
        if !varies[slot] {
            return Some(printed_assignment(family, slot, values[slot]));
        }
        let (_, formula) = family.derived.iter().find(|(derived, _)| *derived == slot)?;
        Some(format!("{} = {}", printed_name(&family.names[slot]), printed_formula(formula, &family.names)))
    };
    let slots = (0..family.names.len()).filter(|&slot| !is_shown_otherwise(slot));
    slots.filter_map(printed).collect::<Vec<String>>().join(", ")
}

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

    #[test]
    fn values_are_printed_with_a_true_minus_sign() {
        assert_eq!([-0.5, -0.0, 1.0 / 3.0].map(printed_value), ["−0.5", "0", "0.333333"]);
    }
}
