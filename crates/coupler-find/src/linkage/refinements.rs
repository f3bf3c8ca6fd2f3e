//! Refinements of several linkages, which compete.

use super::fitting::LinkageFitting;
use super::refinement::LinkageRefinement;

/// A refinement, and the number of its linkage, from 0.
#[derive(Clone)]
pub(super) struct Refinement {
    pub linkage: usize,
    pub own: LinkageRefinement,
}

/// Of several linkages, the nearest of each that are kept however near others are.
const KEPT_OF_EACH: usize = 3;

/// Keeps the nearest that are not alike.
pub(super) fn keep_nearest(refinements: &mut Vec<Refinement>, most: usize) {
    /// Refinements that have found the same linkage differ by less than this.
    const ALIKE: f64 = 1e-6;
    refinements.sort_by(|a, b| a.own.mean_square().total_cmp(&b.own.mean_square()));
    refinements.dedup_by(|Refinement { own: a, linkage }, Refinement { own: b, linkage: other }| {
        linkage == other && a.mean_square() - b.mean_square() <= ALIKE * b.mean_square() && a.is_done() && b.is_done()
    });
    // Of several linkages some of each, for the nearest in the beginning need not be in the end.
    let mut kept = vec![0; refinements.iter().map(|refinement| refinement.linkage + 1).max().unwrap_or(0)];
    let several = kept.len() > 1;
    let mut count = 0;
    refinements.retain(|Refinement { linkage, .. }| {
        let own = &mut kept[*linkage];
        let is_kept = count < most.max(1) || (several && *own < KEPT_OF_EACH);
        (count, *own) = (count + usize::from(is_kept), *own + usize::from(is_kept));
        is_kept
    });
}

/// A refinement on all points of the target, if it has begun on few of them.
pub(super) fn finished(fitting: &LinkageFitting, refinement: LinkageRefinement) -> Option<LinkageRefinement> {
    /// Few points tell where the curve is to a few steps.
    const STEPS: usize = 20;
    if !refinement.has_few_points {
        return Some(refinement);
    }
    let mut refinement = fitting.on_all_points(refinement)?;
    fitting.advance(&mut refinement, STEPS);
    Some(refinement)
}
