//! How a search begins again: from dimensions at random near those whose curves are nearest to the target.

use super::fitting::LinkageFitting;
use super::refinements::{Refinement, finished};

/// How often, and from what, a search begins again.
pub(super) struct Restarts {
    /// The rounds, as long as each finds something nearer.
    pub rounds: u64,
    /// The rounds one after the other that may find nothing nearer.
    pub patience: u64,
    /// The starts of a round.
    pub count: usize,
    /// The nearest of each linkage that are begun from.
    of_each: usize,
}

/// The nearest of all that are begun from.
const NEAREST: usize = 6;

impl Restarts {
    /// Those of a search of one linkage or of several, after a number of starts. Of several, time is better spent on these than on first starts.
    pub fn of(linkages: usize, starts: usize) -> Restarts {
        match linkages {
            1 => Restarts { rounds: 3, patience: 3, count: starts / 5, of_each: NEAREST },
            _ => Restarts { rounds: 12, patience: 2, count: starts / 2, of_each: 3 },
        }
    }

    /// The nearest, few of each linkage, among refinements in their order.
    pub fn nearest(&self, refinements: &[Refinement]) -> Vec<Refinement> {
        let mut kept: Vec<&Refinement> = Vec::new();
        for refinement in refinements {
            let own = kept.iter().filter(|other| other.linkage == refinement.linkage).count();
            if own < self.of_each && kept.len() < NEAREST {
                kept.push(refinement);
            }
        }
        kept.into_iter().cloned().collect()
    }

    /// A start of a round, of a search with a seed: refined if it is soon near the best, whose mean square of distances is given.
    pub fn begun(
        &self,
        (round, start): (u64, usize),
        seed: u64,
        from: &[Refinement],
        fittings: &[LinkageFitting],
        best: f64,
    ) -> Option<Refinement> {
        /// The spreads in turn.
        const SPREADS: [f64; 3] = [0.1, 0.25, 0.5];
        /// The steps, and those after which it must be near the best.
        const STEPS: usize = 60;
        const PROMISING_STEPS: usize = 16;
        const PROMISING_SUM: f64 = 30.0;
        let number = round * self.count as u64 + start as u64 + 1;
        let own_seed = seed.wrapping_add(number.wrapping_mul(0x5851_F42D_4C95_7F2D));
        let Refinement { linkage, own } = &from[start % from.len()];
        let fitting = &fittings[*linkage];
        let mut own = fitting.begin_near(own, own_seed, SPREADS[start % SPREADS.len()])?;
        fitting.advance(&mut own, PROMISING_STEPS);
        if own.mean_square() > PROMISING_SUM * best {
            return None;
        }
        fitting.advance(&mut own, STEPS - PROMISING_STEPS);
        let own = finished(fitting, own)?;
        fitting.has_valid_length(&own).then_some(Refinement { linkage: *linkage, own })
    }
}
