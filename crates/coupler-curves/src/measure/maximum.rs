//! Searches for the portion that is greatest as a function of where it begins.

/// The golden section, `(sqrt(5) - 1) / 2`.
const GOLDEN_SECTION: f64 = 0.618_033_988_749_894_9;

/// Where a maximum is searched for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bracket {
    /// The lower end.
    pub from: f64,
    /// The upper end.
    pub to: f64,
    /// The number of parts whose ends are tried first.
    pub first_parts: usize,
    /// How accurately the maximum is located.
    pub accuracy: f64,
}

/// The place at which a function is greatest, and its value there: a size, and what belongs to it; `None` if it has none
/// anywhere. The function gets the place, and how accurate its value must be relative to its size.
///
/// The function is evaluated at the ends of equal parts of the bracket, and then, between the neighbours of the best, by
/// golden section.
pub(super) fn greatest_in<T: Copy>(
    bracket: Bracket,
    mut function: impl FnMut(f64, f64) -> Option<(T, f64)>,
) -> Option<(f64, (T, f64))> {
    const COARSE: f64 = 1e-4;
    const FINE: f64 = 1e-6;
    let Bracket { from, to, first_parts, accuracy } = bracket;
    let step = (to - from) / first_parts as f64;
    let size = |value: &Option<(T, f64)>| value.map_or(f64::NEG_INFINITY, |(_, size)| size);
    let mut best: (f64, Option<(T, f64)>) = (from, None);
    for k in 0..=first_parts {
        let at = from + step * k as f64;
        let value = function(at, COARSE);
        if size(&value) > size(&best.1) {
            best = (at, value);
        }
    }
    best.1?;
    let (mut a, mut b) = ((best.0 - step).max(from), (best.0 + step).min(to));
    let (mut c, mut d) = (b - GOLDEN_SECTION * (b - a), a + GOLDEN_SECTION * (b - a));
    let (mut at_c, mut at_d) = (function(c, FINE), function(d, FINE));
    while b - a > accuracy {
        for (at, value) in [(c, at_c), (d, at_d)] {
            if size(&value) > size(&best.1) {
                best = (at, value);
            }
        }
        if size(&at_c) > size(&at_d) {
            (b, d, at_d) = (d, c, at_c);
            c = b - GOLDEN_SECTION * (b - a);
            at_c = function(c, FINE);
        } else {
            (a, c, at_c) = (c, d, at_d);
            d = a + GOLDEN_SECTION * (b - a);
            at_d = function(d, FINE);
        }
    }
    // A portion that fits at few ends may be missed when the search for its end begins elsewhere.
    let exact = function(best.0, FINE);
    if size(&exact) > size(&best.1) {
        best.1 = exact;
    }
    Some((best.0, best.1?))
}
