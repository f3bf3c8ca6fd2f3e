//! What the README shows is so.

use coupler_atlas::manifest;
use coupler_atlas::problem::report;

#[test]
fn the_readmes_manifest_is_one() {
    let readme = include_str!("../../README.md");
    let text = readme.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    let loaded = manifest::load(text);
    let plan = loaded.plan.unwrap_or_else(|| panic!("{}", report(&loaded.problems, "README.md", text, false)));
    assert_eq!(plan.families[0].family.cells(), 18);
}

#[test]
fn the_readme_names_every_command_and_linkages_are_listed_by_the_program() {
    let readme = include_str!("../../README.md");
    for command in ["`render ", "`validate ", "`list ", "`init "] {
        assert!(readme.contains(command), "{command}");
    }
}
