//! Integration tests of the library and the program, one file per topic.

#[cfg(unix)]
mod action;
mod answers;
mod architecture;
mod atlas;
mod binding;
mod book;
mod case_tables;
mod charts;
mod check;
mod command_line;
mod complete_manifests;
mod completions;
mod composed_pages;
mod conditions;
mod corpus;
mod coupler_grid;
mod dependencies;
mod design;
mod documents;
mod drawn;
mod examples;
mod export;
mod export_parts;
mod facts;
mod family_designs;
mod family_measures;
mod faults;
mod find;
mod find_atlas;
mod find_files;
mod find_function;
mod find_linkage;
mod find_poses;
mod formats;
mod gallery;
mod golden;
mod hostile_text;
mod import;
mod imports;
mod independent_problems;
mod inputs;
mod inspect_output;
mod lettering;
mod limits;
mod loads;
mod manifests;
mod ownership;
mod plates;
mod program;
mod random_linkages;
mod rates;
mod readme;
mod recorded;
mod recorded_images;
mod remedies;
mod repair;
mod reruns;
mod resuming;
mod scales;
mod schema;
mod shards;
mod support;
mod surroundings;
mod themes;
mod watching;
mod wishes;

/// The configuration of property tests, with the same random cases in every run; `PROPTEST_CASES=20000` sets their
/// number, and `PROPTEST_RNG_SEED=…` the seed.
fn proptest_config() -> proptest::test_runner::Config {
    use proptest::test_runner::{Config, RngSeed};
    let default = Config::default();
    // The limit of rejected cases grows with the number of cases.
    let max_global_rejects = default.cases.saturating_mul(4).max(1024);
    let default = Config { failure_persistence: None, max_global_rejects, ..default };
    match default.rng_seed {
        RngSeed::Random => Config { rng_seed: RngSeed::Fixed(1951), ..default },
        RngSeed::Fixed(_) => default,
    }
}
