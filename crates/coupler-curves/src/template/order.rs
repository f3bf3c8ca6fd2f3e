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
/// `needs(k)` are the items that `k` needs, each below `count`.
///
/// # Errors
/// The items that depend on each other.
pub fn dependency_order(count: usize, needs: impl Fn(usize) -> Vec<usize>) -> Result<Vec<usize>, DependencyCycle> {
    let mut order: Vec<usize> = Vec::with_capacity(count);
    while order.len() < count {
        let is_ready = |k: &usize| !order.contains(k) && needs(*k).iter().all(|need| order.contains(need));
        match (0..count).find(is_ready) {
            Some(next) => order.push(next),
            None => {
                let unresolved = (0..count).filter(|k| !order.contains(k)).collect();
                return Err(DependencyCycle { cycle: find_cycle(count, &needs, &order), unresolved });
            }
        }
    }
    Ok(order)
}

/// Finds a cycle among the items that are not in `order`: each needs another such item, so following these repeats.
fn find_cycle(count: usize, needs: &impl Fn(usize) -> Vec<usize>, order: &[usize]) -> Vec<usize> {
    let is_unresolved = |k: &usize| !order.contains(k);
    let mut path: Vec<usize> = (0..count).find(is_unresolved).into_iter().collect();
    while let Some(next) = path.last().and_then(|&last| needs(last).into_iter().find(is_unresolved)) {
        if let Some(first) = path.iter().position(|&k| k == next) {
            path.drain(..first);
            path.push(next);
            break;
        }
        path.push(next);
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
}
