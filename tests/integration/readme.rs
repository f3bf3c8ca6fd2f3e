//! The examples and statements of docs/start.md, docs/manifest.md, docs/tutorial.md and docs/check.md, and the READMEs of the crates.

use coupler_curves::measure::Measure;
use coupler_curves::solve::Solver;
use std::sync::atomic::AtomicBool;

use coupler_atlas::manifest;
use coupler_atlas::sweep;
use coupler_curves::problem::report;
use coupler_drawing::page::Layout;

use crate::support::command::{PROGRAM, result, run};
use crate::support::folder::Atlas;
use crate::support::plan::plan;

#[test]
fn the_manifest_in_docs_manifest_is_valid() {
    let document = include_str!("../../docs/manifest.md");
    let text = document.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    assert_eq!(plan(text).families[0].family.cell_count(), 18);
}

/// The tutorial's search for a feeder, and the cell that it keeps.
#[test]
fn the_feeder_in_docs_tutorial_is_found() {
    let tutorial = include_str!("../../docs/tutorial.md");
    let text = tutorial.split("```toml\n").find(|part| part.contains("id = \"feeder\"")).unwrap();
    let text = text.split("```").next().unwrap();
    let family = &plan(text).families[0].family;
    let kept = sweep::kept_cells(family);
    assert_eq!((family.cell_count(), kept.iter().collect::<Vec<_>>()), (1125, vec![899]));
    let solved = Solver::new(family).solve(899).unwrap();
    let number = |key| solved.curves[0].measure(key).unwrap();
    assert_eq!(format!("{:.3}", number(Measure::STRAIGHT_LENGTH)), "2.105");
    assert_eq!(format!("{:.1}", number(Measure::MU_MIN)), "45.2");
    assert!(tutorial.contains("cell 900, with 2.105 cranks of straight line and 45.2° at the worst"));
}

#[test]
fn the_joints_in_docs_manifest_can_be_parsed() {
    let document = include_str!("../../docs/manifest.md");
    let joints: Vec<&str> =
        document.lines().filter(|line| line.starts_with("| `{")).filter_map(|line| line.split('`').nth(1)).collect();
    assert_eq!(joints.len(), 8);
    for joint in joints {
        let is_input = joint.contains("piston") || joint.contains("slider");
        let a = if is_input { "A = { fixed = [1, 2] }" } else { "A = { crank = \"O\", length = 1 }" };
        // A rack does not come back.
        let range = if joint.contains("rack") { "input = { from = \"0 deg\", to = \"90 deg\" }\n" } else { "" };
        // Dyads on the joint use all joints that it does not use itself.
        let dyad = |name: &str, on: [&str; 2]| {
            format!("{name} = {{ dyad = [\"{}\", \"{}\"], lengths = [1, 1], side = \"left\" }}", on[0], on[1])
        };
        let rest: Vec<String> = ["A", "O", "C", "P", "Q"]
            .iter()
            .enumerate()
            .map(|(k, joint)| {
                dyad(&format!("Z{}", k + 1), [&if k == 0 { "X".to_owned() } else { format!("Z{k}") }, joint])
            })
            .collect();
        let text = format!(
            "[atlas]\ntitle = \"T\"\n[[linkage]]\nid = \"mine\"\ntrace = [\"X\", \"Z5\"]\n{range}[linkage.joints]\n\
             O = {{ fixed = [0, 0] }}\nC = {{ fixed = [4, 0] }}\nP = {{ fixed = [5, 1] }}\nQ = {{ fixed = [6, 2] }}\n\
             {a}\nX = {joint}\n{}\n",
            rest.join("\n")
        );
        let (linkages, problems) = manifest::parse_linkages(&text);
        assert!(linkages.len() == 1 && problems.is_empty(), "{}", report(&problems, "docs/manifest.md", &text, false));
    }
}

/// The example of the library is the one that `cargo test` compiles and runs in the documentation of coupler-drawing.
#[test]
fn the_library_example_is_a_tested_one() {
    let page = include_str!("../../docs/start.md");
    let example = page.split("```rust\n").nth(1).unwrap().split("```").next().unwrap();
    let tested: Vec<&str> = include_str!("../../crates/coupler-drawing/src/lib.rs").lines().collect();
    assert!(example.lines().filter(|line| !line.is_empty()).count() <= 6, "an import and at most six lines");
    for line in example.lines() {
        assert!(tested.contains(&format!("//! {line}").trim_end()), "not tested: {line}");
    }
}

/// The examples of the crates' READMEs are parts of those that `cargo test` runs in their documentation.
#[test]
fn the_examples_of_the_crates_are_tested_ones() {
    let crates = [
        (include_str!("../../crates/coupler-curves/README.md"), include_str!("../../crates/coupler-curves/src/lib.rs")),
        (
            include_str!("../../crates/coupler-drawing/README.md"),
            include_str!("../../crates/coupler-drawing/src/lib.rs"),
        ),
    ];
    for (readme, source) in crates {
        let tested: Vec<&str> = source.lines().collect();
        let example = readme.split("```rust\n").nth(1).unwrap().split("```").next().unwrap();
        for line in example.lines() {
            assert!(tested.contains(&format!("//! {line}").trim_end()), "not tested: {line}");
        }
    }
}

#[test]
fn the_examples_have_the_stated_sizes() {
    let page = include_str!("../../docs/start.md");
    let cases = [
        (include_str!("../../examples/hrones-nelson.toml"), "7,800 curves on 780 pages", 7_800, 780),
        (include_str!("../../examples/hrones-nelson-fine.toml"), "77,680 on 7,768", 77_680, 7_768),
    ];
    for (text, statement, curves, pages) in cases {
        assert!(page.contains(statement), "{statement}");
        let [planned] = &plan(text).families[..] else { panic!("one family") };
        assert_eq!(planned.layout, Layout::CouplerGrid);
        // Whether a linkage is a crank-rocker or has a change point follows from its lengths, without any curves.
        let kept = sweep::select_cells(&planned.family, true, &AtomicBool::new(false)).unwrap();
        assert_eq!(kept.point_counts.iter().sum::<u32>() as usize, curves);
        assert_eq!(
            kept.point_counts.iter().map(|points| (*points as usize).div_ceil(Layout::POINTS_PER_PAGE)).sum::<usize>(),
            pages
        );
        assert!(planned.family.template.parameters.iter().map(|parameter| &*parameter.name).eq(["A", "B", "C"]));
    }
}

/// The action and the hooks that docs/check.md uses are those of this repository, in this version.
#[test]
fn the_action_and_the_hooks_in_docs_check_exist() {
    let document = include_str!("../../docs/check.md");
    let version = concat!("v", env!("CARGO_PKG_VERSION"));
    for statement in
        ["- uses: coupler-atlas/coupler-atlas@VERSION\n", "coupler-atlas/coupler-atlas\n    rev: VERSION\n"]
    {
        assert!(document.contains(&statement.replace("VERSION", version)), "{statement}");
    }
    let inputs =
        include_str!("../../action.yml").split("inputs:\n").nth(1).unwrap().split("\noutputs:").next().unwrap();
    let inputs: Vec<&str> = inputs.lines().filter_map(|line| line.strip_prefix("  ")?.strip_suffix(':')).collect();
    let used = document.split("with: { manifest").nth(1).unwrap().split(" }").next().unwrap();
    let used = format!("manifest{used}");
    let names: Vec<&str> = used.split(", ").map(|pair| pair.split(": ").next().unwrap()).collect();
    for name in &names {
        assert!(inputs.contains(name), "the action has no input {name}");
    }
    for name in inputs {
        let is_described = names.contains(&name)
            || ["`NAME`", "`NAME: "].iter().any(|word| document.contains(&word.replace("NAME", name)));
        assert!(is_described, "the input {name} is not described");
    }
    let ids =
        |text: &'static str| text.lines().filter_map(|line| line.trim().strip_prefix("- id: ")).collect::<Vec<_>>();
    assert_eq!(ids(document), ids(include_str!("../../.pre-commit-hooks.yaml")));
}

/// Runs the commands of the examples for CI and pre-commit on an unchanged atlas, and then on a changed one.
#[test]
fn the_commands_in_docs_check_can_be_run() {
    let after =
        |text: &'static str, start: &str| text.lines().filter_map(|line| line.strip_prefix(start)).collect::<Vec<_>>();
    let checks = after(include_str!("../../docs/check.md"), "    coupler-atlas check atlas.toml ");
    let checks: Vec<String> = checks.iter().map(|options| format!("check atlas.toml {options}")).collect();
    let hooks = include_str!("../../.pre-commit-hooks.yaml");
    let arguments = after(hooks, "  args: ");
    let hooks = after(hooks, "  entry: coupler-atlas ");
    assert_eq!((checks.len(), hooks.len()), (1, 2));
    let check = format!("{} {}", hooks[1], arguments[0].trim_matches(['[', ']']).replace(", ", " "));
    let (validate, commands) = (hooks[0], [&*checks[0], &*check]);
    let manifest = "[atlas]\ntitle = \"T\"\noutput = \"output\"\nformats = [\"svg\"]\n[[family]]\nid = \"e\"\nlinkage = \"evans\"\n\
                    sampling = { samples = 9 }\ncases = [{ p = 2, a = 2 }]\n";
    let atlas = Atlas::new(manifest);
    let folder = atlas.0.path();
    let run = |arguments: &str| run(folder, &arguments.split(' ').collect::<Vec<_>>());
    assert_eq!(run("render -q").0, 0);
    for command in commands.iter().chain([&validate]) {
        assert_eq!(run(command).0, 0, "{command}");
    }
    for command in commands {
        assert_eq!(run(command).1, "", "{command}");
    }
    atlas.edit(&manifest.replace("a = 2 }", "a = 2.1 }"));
    for command in commands {
        let (code, report, _) = run(command);
        assert!(code == 1 && report.contains("moved"), "{command}: {report}");
    }
    for file in ["report.xml", "moved/index.html", "moved/e-1-1-1.svg"] {
        assert!(folder.join(file).is_file(), "{file}");
    }
}

/// The commands of docs/check.md that compare two commits.
#[test]
#[ignore = "thorough"]
fn two_commits_are_compared() {
    let document = include_str!("../../docs/check.md");
    let commands = document.split("```sh\n").nth(1).unwrap().split("```").next().unwrap();
    let manifest = "[atlas]\ntitle = \"T\"\nformats = [\"svg\"]\n[[family]]\nid = \"e\"\nlinkage = \"evans\"\n\
                    sampling = { samples = 9 }\ncases = [{ p = 2, a = 2 }]\n";
    let folder = tempfile::tempdir().unwrap();
    let repository = folder.path().join("repository");
    std::fs::create_dir(&repository).unwrap();
    std::os::unix::fs::symlink(PROGRAM, folder.path().join("coupler-atlas")).unwrap();
    let path = format!("{}:{}", folder.path().display(), std::env::var("PATH").unwrap());
    let bash = |script: &str| {
        let mut command = std::process::Command::new("bash");
        command.args(["-ec", script]).current_dir(&repository).env("PATH", &path);
        result(command.output().unwrap())
    };
    std::fs::write(repository.join("atlas.toml"), manifest).unwrap();
    let git = "git init -qb main && git add . && git -c user.name=T -c user.email=t@example.org commit -qm first && git switch -qc other";
    assert_eq!(bash(git).0, 0);
    std::fs::write(repository.join("atlas.toml"), manifest.replace("a = 2 }", "a = 2.1 }")).unwrap();
    let (code, out, err) = bash(commands);
    assert!(code == 1 && out.contains("e  1 curve moved, at most cell 1"), "{out}{err}");
    assert!(repository.join("moved/index.html").is_file());
}
