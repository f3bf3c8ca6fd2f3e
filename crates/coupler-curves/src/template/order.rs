use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Items that cannot be ordered because they depend on each other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DependencyCycle {
    /// One cycle, with its first item repeated at the end.
    pub cycle: Vec<usize>,
    /// All items that are in a cycle or depend on one.
    pub unresolved: Vec<usize>,
}

/// Orders the items `0..count` so that each comes after those it needs; ascending order where that is possible.
///
/// `needs(k)` are the items that `k` needs, each below `count`; it is called once for each item, and again for the items
/// of a cycle.
///
/// # Errors
/// The items that depend on each other.
pub fn dependency_order(count: usize, needs: impl Fn(usize) -> Vec<usize>) -> Result<Vec<usize>, DependencyCycle> {
    let mut dependents: Vec<Vec<usize>> = vec![Vec::new(); count];
    let mut missing_counts = vec![0; count];
    for (k, missing_count) in missing_counts.iter_mut().enumerate() {
        let needed = needs(k);
        *missing_count = needed.len();
        needed.into_iter().for_each(|need| dependents[need].push(k));
    }
    let mut ready: BinaryHeap<Reverse<usize>> = (0..count).filter(|&k| missing_counts[k] == 0).map(Reverse).collect();
    let mut order: Vec<usize> = Vec::with_capacity(count);
    while let Some(Reverse(next)) = ready.pop() {
        order.push(next);
        for &k in &dependents[next] {
            missing_counts[k] -= 1;
            if missing_counts[k] == 0 {
                ready.push(Reverse(k));
            }
        }
    }
    if order.len() == count {
        return Ok(order);
    }
    // An ordered item is missing nothing, and every other item is missing another that is not ordered.
    let unresolved: Vec<usize> = (0..count).filter(|&k| missing_counts[k] > 0).collect();
    Err(DependencyCycle { cycle: find_cycle(&unresolved, needs, &missing_counts), unresolved })
}

/// Finds a cycle among items each of which needs another of them, so that following these repeats.
fn find_cycle(unresolved: &[usize], needs: impl Fn(usize) -> Vec<usize>, missing_counts: &[usize]) -> Vec<usize> {
    let is_unresolved = |k: &usize| missing_counts[*k] > 0;
    let mut path: Vec<usize> = unresolved.first().copied().into_iter().collect();
    let mut places: Vec<Option<usize>> = vec![None; missing_counts.len()];
    while let Some(next) = path.last().and_then(|&last| needs(last).into_iter().find(is_unresolved)) {
        if let Some(last) = path.last() {
            places[*last] = Some(path.len() - 1);
        }
        let first = places[next];
        path.push(next);
        if let Some(first) = first {
            path.drain(..first);
            break;
        }
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_come_after_those_they_need() {
        let needs = |k: usize| [vec![2], vec![], vec![1], vec![0, 2]][k].clone();
        assert_eq!(dependency_order(4, needs), Ok(vec![1, 2, 0, 3]));
    }

    #[test]
    fn a_cycle_excludes_the_items_that_lead_to_it() {
        let needs = |k: usize| [vec![1], vec![2], vec![3], vec![1]][k].clone();
        assert_eq!(
            dependency_order(4, needs),
            Err(DependencyCycle { cycle: vec![1, 2, 3, 1], unresolved: vec![0, 1, 2, 3] })
        );
        assert_eq!(dependency_order(1, |_| vec![0]), Err(DependencyCycle { cycle: vec![0, 0], unresolved: vec![0] }));
    }

    #[test]
    fn needs_are_computed_once_for_each_item() {
        for count in [1000, 2000] {
            let calls = std::cell::Cell::new(0);
            // Each item needs the one after it, the worst case for a search in ascending order.
            let order = dependency_order(count, |k| {
                calls.set(calls.get() + 1);
                if k + 1 < count { vec![k + 1] } else { vec![] }
            });
            assert_eq!(order, Ok((0..count).rev().collect()));
            assert_eq!(calls.get(), count);
        }
    }
}
