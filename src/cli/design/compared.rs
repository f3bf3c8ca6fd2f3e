//! Trade-offs: what a linkage has over another, and what it lacks, from their numbers.

use coupler_atlas::design::Design;

use super::text::short;

/// What designers weigh.
struct Quality {
    /// Its value; `None` where it does not apply.
    value: fn(&Design) -> Option<f64>,
    /// Whether more of it is better.
    more: bool,
    /// What two values differ by at least to be told apart, as a part of the greater.
    least: f64,
    /// How a better and a worse value is told, beside the other.
    words: fn(f64, f64) -> [String; 2],
    /// What the best of all is called.
    best: &'static str,
}

const QUALITIES: [Quality; 6] = [
    Quality {
        value: |design| Some(design.straight.length / design.figures.size),
        more: true,
        least: 0.02,
        words: |own, other| {
            let percent = short(100.0 * (own / other - 1.0).abs(), 2);
            [format!("{percent} % longer for its size"), format!("{percent} % shorter for its size")]
        },
        best: "longest for its size",
    },
    Quality {
        value: |design| Some(design.straight.deviation / design.straight.length),
        more: false,
        least: 0.02,
        words: |own, other| {
            let times = short((own / other).max(other / own), 3);
            [format!("{times} times as straight"), format!("deviates {times} times as much")]
        },
        best: "straightest",
    },
    Quality {
        value: |design| Some(design.figures.mu_min),
        more: true,
        least: 0.03,
        words: |own, other| {
            let by = short((own - other).abs(), 2);
            [format!("transmission angle {by}° better"), format!("transmission angle {by}° worse")]
        },
        best: "best transmission angle",
    },
    Quality {
        value: |design| Some(design.unevenness),
        more: false,
        least: 0.03,
        words: |own, other| {
            let both = format!("({} to {})", ratio(own), ratio(other));
            [format!("evener speed {both}"), format!("less even speed {both}")]
        },
        best: "evenest speed",
    },
    Quality {
        value: Design::time_ratio,
        more: true,
        least: 0.03,
        words: |own, other| {
            let both = format!("(1:{} to 1:{})", ratio(1.0 / own), ratio(1.0 / other));
            [format!("quicker return {both}"), format!("slower return {both}")]
        },
        best: "quickest return",
    },
    Quality {
        value: |design| Some(design.double_points as f64),
        more: false,
        least: 0.5,
        words: |own, _| {
            let crossings = format!("crosses itself {}", if own == 1.0 { "once" } else { "more often" });
            ["does not cross itself so often".to_owned(), crossings]
        },
        best: "",
    },
];

/// A ratio to read.
pub(super) fn ratio(value: f64) -> String {
    if value.is_finite() { format!("{value:.2}") } else { "∞".to_owned() }
}

impl Quality {
    /// 1 where the first is better, -1 where it is worse, 0 where they are alike or cannot be compared.
    fn compare(&self, own: &Design, other: &Design) -> i32 {
        let (Some(a), Some(b)) = ((self.value)(own), (self.value)(other)) else { return 0 };
        if a == b || (a - b).abs() <= self.least * a.abs().max(b.abs()) {
            return 0;
        }
        if (a > b) == self.more { 1 } else { -1 }
    }
}

/// What is to be said for and against a design, beside the first of all; of the first, where others are better.
pub(super) fn trade_offs(designs: &[Design], k: usize) -> String {
    let (own, first) = (&designs[k], &designs[0]);
    if k == 0 {
        return of_the_first(designs);
    }
    let (mut better, mut worse) = (Vec::new(), Vec::new());
    for quality in &QUALITIES {
        let (Some(a), Some(b)) = ((quality.value)(own), (quality.value)(first)) else { continue };
        let [good, bad] = (quality.words)(a, b);
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

fn of_the_first(designs: &[Design]) -> String {
    let first = &designs[0];
    let (mut led, mut others) = (Vec::new(), Vec::new());
    for quality in QUALITIES.iter().filter(|quality| !quality.best.is_empty()) {
        let is_better = |a: usize, b: usize| quality.compare(&designs[a], &designs[b]) > 0;
        let beaten = (1..designs.len()).filter(|&k| is_better(k, 0));
        match beaten.reduce(|best, k| if is_better(k, best) { k } else { best }) {
            Some(k) => others.push(format!("{} in {}", quality.best, k + 1)),
            None if (1..designs.len()).any(|k| quality.compare(first, &designs[k]) > 0) => led.push(quality.best),
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
