//! How the input depends on the parameter of a piece.

/// How the input depends on the parameter `u` of a piece, from -1 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InputMap {
    /// `middle + half * u`.
    Linear {
        /// The input in the middle, in degrees or in units of length.
        middle: f64,
        /// Half of the input it spans; negative where the input falls.
        half: f64,
    },
    /// `limit - direction * (middle + half * u)^2`.
    Root {
        /// The input at the limit.
        limit: f64,
        /// 1 where the limit is the greatest input nearby, -1 where it is the least.
        direction: f64,
        /// The signed root of the distance from the limit in the middle.
        middle: f64,
        /// Half of the range of that root.
        half: f64,
    },
}

impl InputMap {
    /// The input at a parameter.
    pub fn input(&self, u: f64) -> f64 {
        match *self {
            InputMap::Linear { middle, half } => middle + half * u,
            InputMap::Root { limit, direction, middle, half } => {
                let root = middle + half * u;
                limit - direction * root * root
            }
        }
    }

    /// The derivative of the input with respect to the parameter.
    pub fn input_rate(&self, u: f64) -> f64 {
        match *self {
            InputMap::Linear { half, .. } => half,
            InputMap::Root { direction, middle, half, .. } => -2.0 * direction * (middle + half * u) * half,
        }
    }

    /// The parameter at an input on the piece, on the side of the limit that `after` says; not limited to [-1, 1].
    pub fn parameter(&self, input: f64, after: bool) -> f64 {
        match *self {
            InputMap::Linear { middle, half } => (input - middle) / half,
            InputMap::Root { limit, direction, middle, half } => {
                let root = (direction * (limit - input)).max(0.0).sqrt();
                ((if after { root } else { -root }) - middle) / half
            }
        }
    }

    /// The same piece at inputs that are greater by `by`.
    pub(super) fn shifted(&self, by: f64) -> InputMap {
        match *self {
            InputMap::Linear { middle, half } => InputMap::Linear { middle: middle + by, half },
            InputMap::Root { limit, direction, middle, half } => {
                InputMap::Root { limit: limit + by, direction, middle, half }
            }
        }
    }

    pub(super) fn restricted(&self, [from, to]: [f64; 2]) -> InputMap {
        let (centre, share) = ((from + to) / 2.0, (to - from) / 2.0);
        match *self {
            InputMap::Linear { middle, half } => {
                InputMap::Linear { middle: middle + half * centre, half: half * share }
            }
            InputMap::Root { limit, direction, middle, half } => {
                InputMap::Root { limit, direction, middle: middle + half * centre, half: half * share }
            }
        }
    }
}
