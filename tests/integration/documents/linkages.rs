//! docs/linkages.md, whose sections and pictures are what the program prints and draws of its catalogue.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;

use coupler_curves::catalogue;
use coupler_curves::expression::displayed_name;
use coupler_curves::solve::Solver;
use coupler_drawing::page::{Options, Paper, PoseChoice};
use coupler_drawing::plate;
use coupler_drawing::render::{self, TextMode};

use super::{printed, root};
use crate::recorded::assert_recorded;
use crate::support::plan::plan;

const PAGE: &str = "docs/linkages.md";
/// Small enough for its lettering to be read in a column of text.
const PAPER: Paper = Paper { width: 208.0, height: 144.0 };
/// Of all pictures together, which a reader of the page loads.
const MAX_BYTES: usize = 740_000;

/// What `list linkages NAME` prints.
struct Description {
    source: String,
    legend: String,
    /// The lines on input and output.
    input_and_output: Vec<String>,
    /// Names and constructions.
    joints: Vec<[String; 2]>,
    /// Names, kinds, defaults and ranges.
    parameters: Vec<[String; 4]>,
    /// A family to start from.
    family: String,
}

impl Description {
    fn new(name: &str) -> Description {
        let text = printed(&["list", "linkages", name]);
        let (text, family) = text.split_once("\na family to start from\n").unwrap();
        let (head, lists) = text.split_once("\njoints\n").unwrap();
        let (joints, parameters) = lists.split_once("\nparameters\n").unwrap();
        let mut head = head.lines().skip(1).map(|line| line.trim_start().to_owned());
        let cells = |line: &str| -> Vec<String> {
            line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).map(str::to_owned).collect()
        };
        let joint = |line: &str| <[String; 2]>::try_from(cells(line)).unwrap();
        let parameter = |mut cells: Vec<String>| {
            cells.resize(4, String::new());
            <[String; 4]>::try_from(cells).unwrap()
        };
        Description {
            source: head.next().unwrap(),
            legend: head.next().unwrap(),
            input_and_output: head.collect(),
            joints: joints.lines().filter(|line| !line.is_empty()).map(joint).collect(),
            // A remark on angles follows the parameters.
            parameters: parameters.lines().map(cells).filter(|cells| cells.len() > 1).map(parameter).collect(),
            family: family.to_owned(),
        }
    }

    /// Where a parameter is in the constructions of the joints: lengths of links, and whole constructions otherwise.
    fn places_of(&self, parameter: &str) -> String {
        let name = displayed_name(parameter);
        let mut places = Vec::new();
        for [joint, construction] in &self.joints {
            let construction = construction.trim_end_matches("; traced");
            let clauses = clauses(construction).into_iter().filter(|clause| has_name(value(clause), &name));
            let (lengths, others): (Vec<&str>, Vec<&str>) = clauses.partition(|clause| clause.contains(" = "));
            match others.is_empty() {
                true => places.extend(lengths.into_iter().map(str::to_owned)),
                false => places.push(format!("{joint}, {construction}")),
            }
        }
        assert!(!places.is_empty(), "{parameter} is in no joint");
        places.join("; ")
    }

    fn section(&self, name: &str) -> String {
        let mut out = format!("\n## {name}\n\n- parameters: {}\n", self.legend);
        let traced: Vec<String> = self
            .joints
            .iter()
            .filter_map(|[joint, text]| Some(format!("{joint}, {}", text.strip_suffix("; traced")?)))
            .collect();
        // Writing to a string cannot fail.
        let _ = writeln!(out, "- traced: {}", traced.join("; "));
        for line in &self.input_and_output {
            let _ = writeln!(out, "- {line}");
        }
        let _ = writeln!(out, "- source: {}\n\n![{name}: {}]({})\n", self.source, self.legend, &picture(name)[5..]);
        out.push_str("| parameter | where it is | kind | default | range |\n|---|---|---|---|---|\n");
        for [parameter, kind, default, range] in &self.parameters {
            let default = match default.strip_prefix("default ") {
                Some(value) => format!("`{value}`"),
                None => "none".to_owned(),
            };
            let _ = writeln!(out, "| `{parameter}` | {} | {kind} | {default} | {range} |", self.places_of(parameter));
        }
        let _ = write!(out, "\n```toml\n{}```\n", self.family);
        out
    }

    /// A plate of the family to start from.
    fn plate(&self) -> String {
        let plan = plan(&format!("[atlas]\ntitle = \"T\"\n{}", self.family));
        let mut family = plan.families[0].family.clone();
        family.title.clone_from(&family.template.id);
        let solved = Solver::new(&family).solve(0).unwrap();
        let scene = plate::compose_cell(&family, &solved, PoseChoice::Clearest, &Options::for_paper(PAPER));
        String::from_utf8(render::svg(&scene, TextMode::Text)).unwrap()
    }
}

/// The parts of a construction between commas and semicolons, other than commas in parentheses.
fn clauses(construction: &str) -> Vec<&str> {
    let mut depth = 0;
    let parts = construction.split(|c: char| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        depth == 0 && (c == ',' || c == ';')
    });
    parts.map(str::trim).collect()
}

/// The value in a clause of a construction; empty if there is none.
fn value(clause: &str) -> &str {
    let starts = ["ratio ", "its line ", " = ", "at (", "at ", ": "];
    starts.iter().find_map(|start| Some(clause.split_once(start)?.1)).unwrap_or("")
}

/// Whether a name is in an expression.
fn has_name(expression: &str, name: &str) -> bool {
    let is_part = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    expression.match_indices(name).any(|(at, _)| {
        !is_part(expression[..at].chars().next_back()) && !is_part(expression[at + name.len()..].chars().next())
    })
}

/// The file of a linkage's picture.
fn picture(name: &str) -> String {
    format!("docs/images/linkages/{name}.svg")
}

#[test]
fn the_catalogue_is_recorded() {
    let names: Vec<&str> = catalogue::all().iter().map(|template| template.id.as_str()).collect();
    let list = printed(&["list", "linkages"]);
    let listed = list.lines().filter(|line| !line.starts_with(' ')).map(|line| line.split(' ').next().unwrap());
    assert_eq!(listed.collect::<Vec<_>>(), names);
    let descriptions: Vec<Description> = names.iter().map(|name| Description::new(name)).collect();
    let mut size = 0;
    for (name, description) in names.iter().zip(&descriptions) {
        let plate = description.plate();
        size += plate.len();
        assert_recorded(&picture(name), &plate);
    }
    assert!(size < MAX_BYTES, "the pictures have {size} bytes");
    let pictures = fs::read_dir(root().join("docs/images/linkages")).unwrap();
    let pictures: BTreeSet<_> =
        pictures.map(|entry| entry.unwrap().file_name().into_string().unwrap().replace(".svg", "")).collect();
    assert_eq!(pictures, names.iter().map(|name| (*name).to_owned()).collect());
    // What precedes the sections, and the last line, are written by hand.
    let page = fs::read_to_string(root().join(PAGE)).unwrap();
    let (rest, last) = page.trim_end().rsplit_once('\n').unwrap();
    let head = rest.split("\n## ").next().unwrap().trim_end();
    let links: Vec<String> = names.iter().map(|name| format!("[{name}](#{name})")).collect();
    assert!(head.ends_with(&links.join(" · ")), "{PAGE} has not these links: {}", links.join(" · "));
    let sections: String = names.iter().zip(&descriptions).map(|(name, linkage)| linkage.section(name)).collect();
    assert_recorded(PAGE, &format!("{head}\n{sections}\n{last}\n"));
}
