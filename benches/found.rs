//! Counts how many curves of random linkages the search for any linkage finds: `cargo bench --bench found`, the table of docs/find.md. Takes minutes;
//! `LINKAGE=evans` counts those of one linkage, `COUNT=100` more than twenty of each, and `INPUT=any` those of linkages that need not turn.

#[path = "../tests/integration/find_linkage/random_curves.rs"]
mod random_curves;

use coupler_find::Options;
use random_curves::deviations;

/// The built-in linkages, and whether their input turns fully.
const LINKAGES: [(&str, bool); 19] = [
    ("slider-crank", true),
    ("inverted-slider-crank", true),
    ("geared-five-bar", true),
    ("watt-six-bar", true),
    ("stephenson-six-bar", true),
    ("evans", true),
    ("hoeken", true),
    ("chebyshev", true),
    ("roberts", false),
    ("watt", false),
    ("scotch-yoke", true),
    ("pantograph", true),
    ("hrones-nelson", true),
    ("jansen", true),
    ("klann", true),
    ("cognates", true),
    ("peaucellier-lipkin", false),
    ("hart-inversor", false),
    ("linear-actuator", false),
];

fn main() {
    for (name, full_turn) in LINKAGES {
        if std::env::var("LINKAGE").is_ok_and(|only| only != name) {
            continue;
        }
        let full_turn = full_turn && std::env::var("INPUT").is_err();
        let begin = std::time::Instant::now();
        let count = std::env::var("COUNT").map_or(20, |count| count.parse().unwrap());
        let mut all = deviations(name, full_turn, count, &Options::default());
        all.sort_by(f64::total_cmp);
        let found = all.iter().filter(|rms| **rms < 1e-3).count();
        let shown: Vec<String> = all.iter().map(|rms| format!("{rms:.1e}")).collect();
        println!(
            "{name}: {found} of {}, {:.2} s each: {}",
            all.len(),
            begin.elapsed().as_secs_f64() / all.len() as f64,
            shown.join(" ")
        );
    }
}
