//! Tests of the kinematics against closed forms, published tables, independent formulas and brute force; one topic a
//! file.

mod catalogue;
mod circuits;
mod circular_portions;
mod cognates;
mod coincident_joints;
mod drawings;
mod dual;
mod dyad_chains;
mod expressions;
mod extreme_lengths;
mod grids;
mod groups;
mod instant;
mod invariance;
mod layouts;
mod linkages;
mod mccarthy;
mod measures;
mod output;
mod output_by_samples;
mod parts;
mod paths;
mod portions;
mod rates;
mod sextic;
mod six_bars;
mod special_parts;
mod straight_line;
mod symmetry;
mod thesis;
mod torque;

/// The configuration of the property tests: the same random cases in every run. `PROPTEST_CASES=20000` runs more of
/// them, and `PROPTEST_RNG_SEED=…` others.
fn random() -> proptest::test_runner::Config {
    use proptest::test_runner::{Config, RngSeed};
    let default = Config::default();
    // Up to four times as many cases may be rejected as are run.
    let max_global_rejects = default.cases.saturating_mul(4).max(1024);
    let default = Config { failure_persistence: None, max_global_rejects, ..default };
    match default.rng_seed {
        RngSeed::Random => Config { rng_seed: RngSeed::Fixed(1951), ..default },
        RngSeed::Fixed(_) => default,
    }
}
