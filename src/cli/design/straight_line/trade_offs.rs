//! Trade-offs: how a design is better or worse than another, in words.

use crate::design::Design;

use super::format::format_ratio;
use crate::format::format_significant;

/// A property by which designs are compared.
struct Quality {
    /// Its value; `None` where it does not apply.
    value: fn(&Design) -> Option<f64>,
    /// Whether a greater value is better.
    is_more_better: bool,
    /// The least difference of two values that counts, relative to the greater in magnitude.
    min_difference: f64,
    /// The words for a value that is better than another, and for one that is worse.
    describe: fn(f64, f64) -> [String; 2],
    /// The words for the best value of all; empty if it is not mentioned.
    superlative: &'static str,
}

const QUALITIES: [Quality; 6] = [
    Quality {
        value: |design| Some(design.straight.length / design.performance.size),
        is_more_better: true,
        min_difference: 0.02,
        describe: |own, other| {
            let percent = format_significant(100.0 * (own / other - 1.0).abs(), 2);
            [format!("{percent} % longer for its size"), format!("{percent} % shorter for its size")]
        },
        superlative: "longest for its size",
    },
    Quality {
        value: |design| Some(design.straight.deviation / design.straight.length),
        is_more_better: false,
        min_difference: 0.02,
        describe: |own, other| {
            let times = format_significant((own / other).max(other / own), 3);
            [format!("{times} times as straight"), format!("deviates {times} times as much")]
        },
        superlative: "straightest",
    },
    Quality {
        value: |design| Some(design.performance.mu_min),
        is_more_better: true,
        min_difference: 0.03,
        describe: |own, other| {
            let difference = format_significant((own - other).abs(), 2);
            [format!("transmission angle {difference}° better"), format!("transmission angle {difference}° worse")]
        },
        superlative: "best transmission angle",
    },
    Quality {
        value: |design| Some(design.speed_ratio),
        is_more_better: false,
        min_difference: 0.03,
        describe: |own, other| {
            let both = format!("({} to {})", format_ratio(own), format_ratio(other));
            [format!("evener speed {both}"), format!("less even speed {both}")]
        },
        superlative: "evenest speed",
    },
    Quality {
        value: Design::time_ratio,
        is_more_better: true,
        min_difference: 0.03,
        describe: |own, other| {
            let both = format!("(1:{} to 1:{})", format_ratio(1.0 / own), format_ratio(1.0 / other));
            [format!("quicker return {both}"), format!("slower return {both}")]
        },
        superlative: "quickest return",
    },
    Quality {
        value: |design| Some(design.crunode_count as f64),
        is_more_better: false,
        min_difference: 0.5,
        describe: |own, _| {
            let crossings = format!("crosses itself {}", if own == 1.0 { "once" } else { "more often" });
            ["does not cross itself so often".to_owned(), crossings]
        },
        superlative: "",
    },
];

impl Quality {
    /// 1 if the first is better, -1 if it is worse, 0 if they are alike or cannot be compared.
    fn compare(&self, own: &Design, other: &Design) -> i32 {
        let (Some(a), Some(b)) = ((self.value)(own), (self.value)(other)) else { return 0 };
        if a == b || (a - b).abs() <= self.min_difference * a.abs().max(b.abs()) {
            return 0;
        }
        if (a > b) == self.is_more_better { 1 } else { -1 }
    }
}

/// How the `k`-th design is better and worse than the first; for the first itself, where it leads and where others do.
pub(super) fn trade_offs(designs: &[Design], k: usize) -> String {
    let (own, first) = (&designs[k], &designs[0]);
    if k == 0 {
        return first_trade_offs(designs);
    }
    let (mut better, mut worse) = (Vec::new(), Vec::new());
    for quality in &QUALITIES {
        let (Some(a), Some(b)) = ((quality.value)(own), (quality.value)(first)) else { continue };
        let [good, bad] = (quality.describe)(a, b);
        match quality.compare(own, first) {
            1 => better.push(good),
            -1 => worse.push(bad),
            _ => {}
        }
    }
    match (better.is_empty(), worse.is_empty()) {
        (true, true) => "as good as 1".to_owned(),
        (false, true) => format!("against 1: {}", better.join(", ")),
        (true, false) => format!("against 1: {}", worse.join(", ")),
        (false, false) => format!("against 1: {}, but {}", better.join(", "), worse.join(", ")),
    }
}

fn first_trade_offs(designs: &[Design]) -> String {
    let first = &designs[0];
    let (mut leads, mut others) = (Vec::new(), Vec::new());
    for quality in QUALITIES.iter().filter(|quality| !quality.superlative.is_empty()) {
        let is_better = |a: usize, b: usize| quality.compare(&designs[a], &designs[b]) > 0;
        let better = (1..designs.len()).filter(|&k| is_better(k, 0));
        match better.reduce(|best, k| if is_better(k, best) { k } else { best }) {
            Some(k) => others.push(format!("{} in {}", quality.superlative, k + 1)),
            None if (1..designs.len()).any(|k| quality.compare(first, &designs[k]) > 0) => {
                leads.push(quality.superlative)
            }
            None => {}
        }
    }
    match (leads.is_empty(), others.is_empty()) {
        (true, true) => "the only design".to_owned(),
        (false, true) => format!("of all: {}", leads.join(", ")),
        (true, false) => others.join(", "),
        (false, false) => format!("of all: {}; but {}", leads.join(", "), others.join(", ")),
    }
}
