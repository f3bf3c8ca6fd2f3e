//! Numbers that fill a cube evenly.

use coupler_curves::geometry::trig;

/// The numbers of a sequence that fills a cube of a dimension evenly, the additive recurrence of Roberts: the powers of the inverse of the real
/// root of x^(d+1) = x + 1, times the place in the sequence.
#[derive(Clone, Debug)]
pub(crate) struct EvenSequence {
    powers: Vec<f64>,
}

impl EvenSequence {
    /// The sequence in a cube of a dimension.
    pub fn new(dimension: usize) -> EvenSequence {
        const ROUNDS: usize = 60;
        let mut root: f64 = 1.0;
        for _ in 0..ROUNDS {
            // The root of order d + 1 of 1 + x is nearer to it.
            root = trig::exp(trig::ln(1.0 + root) / (dimension as f64 + 1.0));
        }
        let mut power = 1.0;
        let next = |_| {
            power /= root;
            power
        };
        EvenSequence { powers: (0..dimension).map(next).collect() }
    }

    /// Numbers from 0 to 1, one for each direction.
    pub fn parts(&self, number: usize) -> impl Fn(usize) -> f64 + '_ {
        move |direction| (0.5 + self.powers[direction] * (number as f64 + 1.0)).fract()
    }
}
