/// What cannot be put in order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DependencyCycle {
    /// A cycle, its first once more at the end.
    pub cycle: Vec<usize>,
    /// All that is in a cycle or needs what is.
    pub unresolved: Vec<usize>,
}

/// An order in which everything comes after what it needs; as numbered, where that is one.
///
/// `needs(k)` are the numbers, below `count`, of what `k` needs.
///
/// # Errors
/// What stays open, where there is no such order.
pub fn dependency_order(count: usize, needs: impl Fn(usize) -> Vec<usize>) -> Result<Vec<usize>, DependencyCycle> {
    let mut order: Vec<usize> = Vec::with_capacity(count);
    while order.len() < count {
        let is_ready = |k: &usize| !order.contains(k) && needs(*k).iter().all(|need| order.contains(need));
        match (0..count).find(is_ready) {
            Some(next) => order.push(next),
            None => {
                let all = (0..count).filter(|k| !order.contains(k)).collect();
                return Err(DependencyCycle { cycle: find_cycle(count, &needs, &order), unresolved: all });
            }
        }
    }
    Ok(order)
}

/// What cannot be put in order needs something that cannot either: following those comes round.
fn find_cycle(count: usize, needs: &impl Fn(usize) -> Vec<usize>, order: &[usize]) -> Vec<usize> {
    let stuck = |k: &usize| !order.contains(k);
    let mut path: Vec<usize> = (0..count).find(stuck).into_iter().collect();
    while let Some(next) = path.last().and_then(|&at| needs(at).into_iter().find(stuck)) {
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
    fn everything_comes_after_what_it_needs() {
        let needs = |k: usize| [vec![2], vec![], vec![1], vec![0, 2]][k].clone();
        assert_eq!(dependency_order(4, needs), Ok(vec![1, 2, 0, 3]));
    }

    #[test]
    fn a_cycle_is_found_and_what_leads_to_it_left_out() {
        let needs = |k: usize| [vec![1], vec![2], vec![3], vec![1]][k].clone();
        assert_eq!(
            dependency_order(4, needs),
            Err(DependencyCycle { cycle: vec![1, 2, 3, 1], unresolved: vec![0, 1, 2, 3] })
        );
        assert_eq!(dependency_order(1, |_| vec![0]), Err(DependencyCycle { cycle: vec![0, 0], unresolved: vec![0] }));
    }
}
