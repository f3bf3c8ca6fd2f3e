//! Trade-offs: what a linkage has over another, and what it lacks, from their numbers.

use coupler_atlas::design::Design;

use super::text::format_significant;

/// What designers weigh.
struct Quality {
    /// Its value; `None` where it does not apply.
    value: fn(&Design) -> Option<f64>,
    /// Whether more of it is better.
    is_more_better: bool,
    /// What two values differ by at least to be told apart, as a part of the greater.
    min_difference: f64,
    /// How a better and a worse value is told, beside the other.
    describe: fn(f64, f64) -> [String; 2],
    /// What the best of all is called.
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
            let by = format_significant((own - other).abs(), 2);
            [format!("transmission angle {by}° better"), format!("transmission angle {by}° worse")]
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

/// A ratio to read.
pub(super) fn format_ratio(value: f64) -> String {
    if value.is_finite() { format!("{value:.2}") } else { "∞".to_owned() }
}

impl Quality {
    /// 1 where the first is better, -1 where it is worse, 0 where they are alike or cannot be compared.
    fn compare(&self, own: &Design, other: &Design) -> i32 {
        let (Some(a), Some(b)) = ((self.value)(own), (self.value)(other)) else { return 0 };
        if a == b || (a - b).abs() <= self.min_difference * a.abs().max(b.abs()) {
            return 0;
        }
        if (a > b) == self.is_more_better { 1 } else { -1 }
    }
}

/// What is to be said for and against a design, beside the first of all; of the first, where others are better.
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
    let (mut led, mut others) = (Vec::new(), Vec::new());
    for quality in QUALITIES.iter().filter(|quality| !quality.superlative.is_empty()) {
        let is_better = |a: usize, b: usize| quality.compare(&designs[a], &designs[b]) > 0;
        let beaten = (1..designs.len()).filter(|&k| is_better(k, 0));
        match beaten.reduce(|best, k| if is_better(k, best) { k } else { best }) {
            Some(k) => others.push(format!("{} in {}", quality.superlative, k + 1)),
            None if (1..designs.len()).any(|k| quality.compare(first, &designs[k]) > 0) => {
                led.push(quality.superlative)
            }
            None => {}
        }
    }
    match (led.is_empty(), others.is_empty()) {
        (true, true) => "the only one".to_owned(),
        (false, true) => format!("of all: {}", led.join(", ")),
        (true, false) => others.join(", "),
        (false, false) => format!("of all: {}; but {}", led.join(", "), others.join(", ")),
    }
}
