//! Pages say all that is needed to build their linkages: every dimension in full, the joints and how they are placed, and
//! what the symbols mean.

use std::collections::HashSet;
use std::fs;

use coupler_atlas::manifest::{Plan, PlannedFamily};
use coupler_curves::family::Cell;
use coupler_curves::geometry::{Vector, trig};
use coupler_drawing::page::{Layout, PanelScale};

use crate::support::command::{folder_with, printed};
use crate::support::plan::plan;
use crate::support::texts::texts;

/// A manifest of one family without errors.
fn family(text: &str) -> String {
    format!("[atlas]\ntitle = \"T\"\n[[family]]\n{text}")
}

/// A page of panels as SVG, with its family and its cells.
struct Page<'p> {
    svg: String,
    planned: &'p PlannedFamily,
    cells: Vec<Cell>,
}

/// The pages of the families of panels of a manifest.
fn pages<'p>(text: &str, plan: &'p Plan) -> Vec<Page<'p>> {
    let folder = folder_with(text);
    printed(folder.path(), &["render", "-q", "--format", "svg", "-o", "out"]);
    let of_family = |planned: &'p PlannedFamily| {
        let family = &planned.family;
        let cells: Vec<Cell> = (0..family.cell_count()).map(|k| family.cell(k)).collect();
        let page = |(k, cells): (usize, &[Cell])| {
            let path = folder.path().join(format!("out/{0}/{0}-{k:03}.svg", family.id));
            Page { svg: fs::read_to_string(path).unwrap(), planned, cells: cells.to_vec() }
        };
        (1..).zip(cells.chunks(planned.layout.cells_per_page())).map(page).collect::<Vec<_>>()
    };
    let of_panels = plan.families.iter().filter(|planned| matches!(planned.layout, Layout::Panels { .. }));
    of_panels.flat_map(of_family).collect()
}

/// The last word of a name as it is printed, with spaces in place of underscores.
fn last_word(name: &str) -> String {
    name.rsplit('_').next().unwrap_or_default().to_owned()
}

/// The values that the lines state: "p = 2.50", of a formula "u = 2 a = 5", and of a fraction "p = 22 / 9".
fn stated_values(lines: &[String]) -> Vec<(String, f64)> {
    let mut values = Vec::new();
    // An equation may go on in the next line.
    let text = lines.join(", ");
    for equation in text.split(", ") {
        let mut sides = equation.split(" = ");
        let Some(name) = sides.next().and_then(|name| name.split(' ').next_back()) else { continue };
        for side in sides {
            // A fraction may have its decimal beside it.
            let side = side.split(" ≈ ").next().unwrap_or(side);
            let side = side.trim_end_matches(['°', ',']).replace('−', "-");
            let (numerator, denominator) = side.split_once(" / ").unwrap_or((&side, "1"));
            if let (Ok(numerator), Ok(denominator)) = (numerator.parse::<f64>(), denominator.parse::<f64>()) {
                values.push((name.to_owned(), numerator / denominator));
            }
        }
    }
    values
}

/// Manifests with dimensions of many kinds: rounded by captions, missing in them, derived, angles, long fractions.
fn manifests() -> Vec<String> {
    let atlas = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/atlas.toml")).unwrap();
    vec![
        atlas,
        family(
            "id = \"f\"\nlinkage = \"evans\"\npanels = [3, 2]\ngrid = { p = [2.125, 2.001], k = [1.5, 2] }\nlet = { a = \"p + 1\" }",
        ),
        family(
            "id = \"f\"\nlinkage = \"four-bar\"\ngrid = { along = { from = 0.1, to = 4, count = 8 } }\n\
                let = { frame = 4, crank = 1, coupler = 3, rocker = 3.5 }",
        ),
        family("id = \"f\"\nlinkage = \"geared-five-bar\"\ngrid = { phase = [0, \"30 deg\"], a = [5, 5.25] }"),
        family("id = \"f\"\nlinkage = \"jansen\"\ncases = [{}, { m = 12.123456789, j = 51 }]"),
        family(
            "id = \"f\"\nlinkage = \"pantograph\"\ncaption = \"u = {u:.1}\"\ngrid = { u = [3.75, 4.5], n = [2, 3] }",
        ),
    ]
}

#[test]
#[ignore = "thorough"]
fn every_given_value_can_be_read_in_full_on_its_page() {
    let mut checked = 0;
    for text in manifests() {
        let plan = plan(&text);
        for Page { svg, planned, cells } in pages(&text, &plan) {
            let family = &planned.family;
            let parameters = &family.template.parameters;
            let stated = stated_values(&texts(&svg));
            for cell in &cells {
                for slot in family.space.slots_of(cell.number - 1).filter(|slot| *slot < parameters.len()) {
                    let value = (last_word(&family.names[slot]), cell.values[slot]);
                    assert!(stated.contains(&value), "{}: {value:?} of {stated:?}", family.id);
                    checked += 1;
                }
            }
            // A default is given as well.
            for (slot, parameter) in parameters.iter().enumerate() {
                if let Ok(number) = parameter.default_text.parse::<f64>() {
                    let is_used = cells.iter().any(|cell| cell.values[slot] == number);
                    assert!(!is_used || stated.contains(&(last_word(&parameter.name), number)), "{}", parameter.name);
                }
            }
        }
    }
    assert!(checked > 300, "{checked}");
}

/// The caption and the straight portion under the only panel of a page.
fn caption_and_straight(family_text: &str) -> [String; 2] {
    let text = family(&format!("id = \"f\"\nlinkage = \"evans\"\nsampling = {{ samples = 90 }}\n{family_text}"));
    let plan = plan(&text);
    let lines = texts(&pages(&text, &plan)[0].svg);
    let line = |has: &dyn Fn(&str) -> bool| lines.iter().find(|line| has(line)).cloned().unwrap_or_default();
    let straight = line(&|line| line.starts_with("straight ") || line.contains("· straight "));
    let portion = straight.split("straight ").nth(1).unwrap().split('°').next().unwrap().to_owned();
    [line(&|line| line.starts_with("p = 3") && line.contains("a ")), portion]
}

#[test]
fn the_linkage_of_rounded_numbers_has_the_properties_on_its_page() {
    let let_a = "grid = { p = 3.5 }\nlet = { a = \"(1 + p)^1.5 / 2\" }";
    let [caption, straight] = caption_and_straight(let_a);
    let number = caption.split("a ≈ ").nth(1).unwrap_or_else(|| panic!("{caption}"));
    let printed: f64 = number.split(',').next().unwrap().parse().unwrap();
    let with = |a: f64| caption_and_straight(&format!("cases = [{{ p = 3.5, a = {a} }}]"));
    assert_eq!(with(printed)[1], straight);
    // The two decimals that the caption states are not enough, and are those of a given value only where they are all.
    let stated = (printed * 100.0).round() / 100.0;
    assert_ne!(with(stated)[1], straight);
    for (a, text) in [(4.5, "a = 4.5"), (4.5678, "a = 4.5678")] {
        let [caption, _] = with(a);
        assert!(caption.contains(text), "{caption}");
    }
}

#[test]
#[ignore = "thorough"]
fn no_two_panels_of_a_page_share_a_caption() {
    for text in manifests() {
        let plan = plan(&text);
        for Page { svg, planned, cells } in pages(&text, &plan) {
            // The title of a curve ends with the caption of its panel.
            let titles = svg.split("<title>").skip(2).filter_map(|title| title.split("</title>").next());
            let numbered = titles.filter_map(|title| title.split_once(", no. ")?.1.split_once(": "));
            let panels: HashSet<(&str, &str)> = numbered.collect();
            let captions: HashSet<&str> = panels.iter().map(|(_, caption)| *caption).collect();
            assert_eq!((panels.len(), captions.len()), (cells.len(), cells.len()), "{}", planned.family.id);
        }
    }
}

/// Panics unless the pages of a manifest have a key of their joints and explain their symbols.
fn assert_explained(manifests: &[String]) {
    for text in manifests {
        let plan = plan(text);
        for Page { svg, planned, .. } in pages(text, &plan) {
            let lines = texts(&svg);
            // Joints that coincide are one pin with the names of both.
            let names: HashSet<&str> = lines.iter().flat_map(|line| line.split(", ")).collect();
            for joint in &planned.family.template.joints {
                assert!(names.contains(joint.name.as_str()), "{}: {}", planned.family.id, joint.name);
            }
            assert!(lines.iter().any(|line| line == "traced point"));
            assert!(lines.iter().any(|line| line.starts_with("input: ")));
            for (class, meaning) in [("axis", "axis of symmetry"), ("straight", "straight portion")] {
                let is_drawn = groups(&svg, class).iter().any(|group| group.contains("<path"));
                let is_explained = lines.iter().any(|line| line.contains(meaning));
                assert_eq!(is_explained, is_drawn, "{}: {meaning}", planned.family.id);
            }
        }
    }
}

#[test]
fn every_page_has_a_key_of_its_joints_and_explains_its_symbols() {
    // The first is the manifest of the whole atlas.
    assert_explained(&manifests()[1..]);
}

#[test]
#[ignore = "thorough"]
fn every_page_of_the_atlas_has_a_key_of_its_joints_and_explains_its_symbols() {
    assert_explained(&manifests()[..1]);
}

#[test]
fn common_dimensions_are_exact_and_formulas_are_set_as_formulas() {
    let dimensions = |text: &str| -> Vec<String> {
        let plan = plan(&family(text));
        plan.families[0].family.common_dimensions().iter().map(ToString::to_string).collect()
    };
    let evans = "id = \"f\"\nlinkage = \"evans\"\ngrid = { p = [2, 3] }\nlet = { a = \"(1 + p)^1.5 / 2\" }";
    assert_eq!(dimensions(evans), ["r = 1", "a = (1 + p)^1.5 / 2", "s = a", "k = 2"]);
    let klann = dimensions("id = \"f\"\nlinkage = \"klann\"\ngrid = { r = [0.2, 0.25] }");
    assert!(klann.contains(&"foot along = −1.098 / √2 ≈ −0.776403".to_owned()), "{klann:?}");
    assert!(!klann.iter().any(|text| text.starts_with("r =")), "{klann:?}");
    let helper = "id = \"f\"\nlinkage = \"evans\"\ngrid = { p = [2, 3], h = [0.1] }\nlet = { a = \"p + h\", unused = \"2 * h\" }\nsort = \"unused\"";
    assert_eq!(dimensions(helper), ["r = 1", "a = p + h", "s = a", "k = 2", "h = 0.1"]);
}

/// The part of a page in groups of a class.
fn groups<'s>(svg: &'s str, class: &str) -> Vec<&'s str> {
    let start = format!("<g class=\"{class}\"");
    svg.split(&start).skip(1).map(|group| group.split("</g>").next().unwrap()).collect()
}

#[test]
fn cognates_have_inks_and_lengths_of_their_own() {
    let text =
        family("id = \"f\"\nlinkage = \"cognates\"\ngrid = { p = 4, r = 1.5, a = 3, s = 3.5, u = 1.8, v = 1.3 }");
    let plan = plan(&text);
    let Page { svg, .. } = pages(&text, &plan).remove(0);
    let theme = &plan.page.theme;
    for links in groups(&svg, "linkage") {
        for ink in [theme.ink, theme.curve_ink(2), theme.curve_ink(3)] {
            assert!(links.contains(&format!("stroke=\"{ink}\"")), "{ink}");
        }
    }
    // Lengths as of the theorem: the cognates are the four-bar's sides times |AM| / a and |BM| / a.
    let [am, bm] = [trig::hypot(1.8, 1.3), trig::hypot(1.2, 1.3)];
    for (name, length) in [("OD", am), ("DE", 0.5 * am), ("QE", 3.5 / 3.0 * am), ("CF", bm), ("QG", 0.5 * bm)] {
        let label = format!("{name} ≈ {length:.4}");
        assert!(texts(&svg).iter().any(|line| line.contains(&label)), "{label}");
    }
}

#[test]
fn linkages_are_shown_at_their_limits_where_the_manifest_asks_for_it() {
    let ghosts = |crank: f64, keys: &str| {
        let text = family(&format!(
            "id = \"f\"\nlinkage = \"four-bar\"\n{keys}\ngrid = {{ crank = {crank} }}\n\
             let = {{ frame = 4, coupler = 3, rocker = 3.5, along = 1, across = 1 }}"
        ));
        let plan = plan(&text);
        let Page { svg, .. } = pages(&text, &plan).remove(0);
        let poses = groups(&svg, "ghost").concat().matches(['M', 'm']).count();
        (poses > 0, texts(&svg).iter().any(|line| line == "linkage at its limits"))
    };
    assert_eq!(ghosts(1.0, ""), (false, false));
    // A crank-rocker has limits of its output, a double-rocker limits of its input, a drag-link none.
    assert_eq!(ghosts(1.0, "ghosts = true"), (true, true));
    assert_eq!(ghosts(3.0, "ghosts = true"), (true, true));
    let drag_link = "id = \"f\"\nlinkage = \"four-bar\"\nghosts = true\ngrid = { crank = 3 }\n\
                     let = { frame = 1, coupler = 3, rocker = 3.5, along = 1, across = 1 }";
    let text = family(drag_link);
    assert!(!pages(&text, &plan(&text))[0].svg.contains("class=\"ghost\""));
}

/// A manifest of forty panels on a sheet of a size.
fn forty_panels(paper: &str) -> String {
    let cranks = "[0.5, 0.625, 0.75, 0.875, 1, 1.125, 1.25, 1.375]";
    format!(
        "[atlas]\ntitle = \"T\"\n[page]\npaper = \"{paper}\"\n[[family]]\nid = \"f\"\nlinkage = \"four-bar\"\n\
         panels = [8, 5]\ngrid = {{ crank = {cranks}, across = [0, 0.25, 0.5, 0.75, 1] }}\n\
         let = {{ frame = 4, coupler = 3.125, rocker = 3.5, along = 1.5 }}"
    )
}

#[test]
#[ignore = "thorough"]
fn enlarged_curves_are_at_least_twice_as_large_and_no_text_is_below_six_points() {
    let mut factors = 0;
    for text in manifests().into_iter().chain(["a4", "tabloid"].map(forty_panels)) {
        let plan = plan(&text);
        for Page { svg, planned, .. } in pages(&text, &plan) {
            let stated = texts(&svg);
            for factor in stated.iter().filter_map(|line| line.rsplit_once("× ")?.1.parse::<f64>().ok()) {
                assert!(factor >= 2.0, "{}: {factor}", planned.family.id);
                factors += 1;
            }
            for size in svg.split("font-size=\"").skip(1).map(|rest| rest.split('"').next().unwrap()) {
                let points = size.parse::<f64>().unwrap() / 25.4 * 72.0;
                assert!(points >= 6.0 - 0.005, "{}: {points}", planned.family.id);
            }
        }
    }
    assert!(factors > 20, "{factors}");
}

/// A manifest of a linkage with points on its coupler, each placed from the one before.
fn with_coupler_points(count: usize) -> String {
    let point = |k: usize| format!("T{} = {{ point = [\"A\", \"T{k}\"], along = 2, across = 0.1 }}\n", k + 1);
    let points: String = (0..count).map(point).collect();
    format!(
        "{}\n[[linkage]]\nid = \"many\"\ntrace = [\"T{count}\"]\n[linkage.joints]\nO = {{ fixed = [0, 0] }}\n\
        C = {{ fixed = [4, 0] }}\nA = {{ crank = \"O\", length = 1 }}\n\
        B = {{ dyad = [\"A\", \"C\"], lengths = [3, 3.5], side = \"left\" }}\n\
        T0 = {{ point = [\"A\", \"B\"], along = 1 }}\n{points}",
        family("id = \"f\"\nlinkage = \"many\"\npanels = [2, 2]\ncases = [{}]")
    )
}

#[test]
fn a_key_of_many_joints_is_complete_or_says_what_it_leaves_out() {
    let missing = |count: usize| {
        let text = with_coupler_points(count);
        let plan = plan(&text);
        let lines = texts(&pages(&text, &plan)[0].svg);
        let joints = &plan.families[0].family.template.joints;
        let named = joints.iter().filter(|joint| lines.contains(&joint.name)).count();
        (joints.len() - named, lines.iter().any(|line| line.ends_with("for which this page is too small")))
    };
    assert_eq!([5, 40].map(missing), [(0, false); 2]);
    let (missing, is_said) = missing(200);
    assert!(missing > 50 && is_said, "{missing}");
}

/// The numbers of an attribute of the elements of some markup.
fn attributes(markup: &str, name: &str) -> Vec<f64> {
    let start = format!(" {name}=\"");
    let values = markup.split(&start).skip(1);
    values.map(|value| value.split('"').next().unwrap().parse().unwrap()).collect()
}

/// The only page of a family, on paper of a size in millimetres.
fn page_on_paper([width, height]: [u32; 2], text: &str) -> String {
    let paper = format!("paper = {{ width = \"{width} mm\", height = \"{height} mm\" }}");
    let folder = folder_with(&format!("[atlas]\ntitle = \"T\"\n[page]\n{paper}\n[[family]]\nid = \"f\"\n{text}"));
    printed(folder.path(), &["render", "-q", "--format", "svg", "-o", "out"]);
    fs::read_to_string(folder.path().join("out/f/f-001.svg")).unwrap()
}

#[test]
fn small_paper_has_a_key_or_says_what_paper_it_needs() {
    const A6: [u32; 2] = [105, 148];
    let chart = |grid: &str, y: &str| {
        format!(
            "linkage = \"evans\"\nlayout = \"chart\"\npanels = {grid}\nchart = {{ x = \"p\", y = [{y}] }}\n\
             grid = {{ p = [2, 3] }}\nlet = {{ a = 2.6 }}"
        )
    };
    let panels =
        |grid: &str| format!("linkage = \"evans\"\npanels = {grid}\ngrid = {{ p = [2, 2.5, 3] }}\nlet = {{ a = 2.6 }}");
    let has_key = |svg: &str| texts(svg).iter().any(|line| line == "pin of the crank, OA = r");
    let note = |svg: &str| texts(svg).into_iter().find(|line| line.starts_with("the key is left out"));
    // As many panels as leave room to a key, where their number is left to the paper.
    let jansen = "linkage = \"jansen\"\ngrid = { m = [13, 14, 15, 16, 17] }".to_owned();
    let evans = "linkage = \"evans\"\ngrid = { p = [2, 2.5, 3, 3.5, 4, 5, 6] }\nlet = { a = 2.6 }".to_owned();
    for text in [jansen, evans] {
        let svg = page_on_paper(A6, &text);
        let is_placed = |line: &String| line.starts_with("pin of the crank");
        assert!(texts(&svg).iter().any(is_placed) && note(&svg).is_none(), "{:?}", texts(&svg));
    }
    for text in [chart("[1, 1]", "\"length\""), panels("[1, 1]")] {
        let svg = page_on_paper(A6, &text);
        assert!(has_key(&svg) && note(&svg).is_none(), "{:?}", texts(&svg));
    }
    for text in [chart("[1, 4]", "\"length\", \"area\", \"bbox_x_min\", \"bbox_x_max\""), panels("[2, 4]")] {
        let svg = page_on_paper(A6, &text);
        let said = note(&svg).unwrap_or_else(|| panic!("{:?}", texts(&svg)));
        let sides: Vec<u32> = said.split(' ').filter_map(|word| word.parse().ok()).collect();
        let svg = page_on_paper([sides[0], sides[1]], &text);
        assert!(!has_key(&page_on_paper(A6, &text)) && has_key(&svg), "{said}: {:?}", texts(&svg));
    }
}

#[test]
fn all_pages_of_a_family_have_the_key_or_none() {
    // The linkages of the first page have the more symbols.
    let text = "[atlas]\ntitle = \"T\"\n[page]\npaper = { width = \"105 mm\", height = \"148 mm\" }\n[[family]]\nid = \"f\"\n\
                linkage = \"four-bar\"\npanels = [2, 2]\nsampling = { samples = 24 }\n\
                grid = { crank = [1, 1.1, 1.2, 1.3, 2.6, 2.7, 2.8, 2.9] }\nlet = { frame = 3.5, rocker = 3.2, coupler = 3, along = 1.5 }";
    let plan = plan(text);
    let has_key = |page: &Page| texts(&page.svg).iter().any(|line| line == "pin of the crank, OA = crank");
    let pages: Vec<bool> = pages(text, &plan).iter().map(has_key).collect();
    assert!(pages.len() == 2 && pages[0] == pages[1], "{pages:?}");
}

#[test]
fn a_key_with_many_lines_takes_more_of_a_page_with_one_panel() {
    for paper in [[210, 297], [297, 210]] {
        let joints: String = (0..30)
            .map(|k| format!("P{k} = {{ point = [\"A\", \"B\"], along = \"1.5 + {k} / 100\", across = 0.5 }}\n"))
            .collect();
        let points: Vec<String> = (0..30).map(|k| format!("\"P{k}\"")).collect();
        let svg = page_on_paper(
            paper,
            &format!(
                "linkage = \"many\"\ncases = [{{}}]\nsampling = {{ samples = 12 }}\n[[linkage]]\nid = \"many\"\ntrace = [{}]\n\
                 [linkage.joints]\nO = {{ fixed = [0, 0] }}\nC = {{ fixed = [4, 0] }}\nA = {{ crank = \"O\", length = 1 }}\n\
                 B = {{ dyad = [\"A\", \"C\"], lengths = [4, 3], side = \"left\" }}\n{joints}",
                points.join(", ")
            ),
        );
        assert!(texts(&svg).iter().all(|line| !line.contains("more lines")), "{paper:?}: {:?}", texts(&svg));
        // Paths are in the order of the points.
        assert!(texts(&svg).iter().any(|line| line.starts_with("path of P0, path of P5, path of P10")));
    }
}

#[test]
fn a_key_beside_panels_has_a_smaller_drawing_before_its_lines_are_left_out() {
    let svg = page_on_paper(
        [120, 100],
        "linkage = \"evans\"\npanels = [3, 1]\nsampling = { samples = 24 }\ncases = [{ p = 2, a = 2.6 }, { p = 3, a = 1.5 }, { p = 9, a = 2.6 }]",
    );
    let lines = texts(&svg);
    assert!(lines.iter().any(|line| line.starts_with("shown here at")), "{lines:?}");
    assert!(lines.iter().all(|line| !line.contains("more lines")), "{lines:?}");
}

#[test]
fn what_varies_stays_in_the_captions_of_small_panels_and_numbers_are_above_linkages() {
    let svg = page_on_paper(
        [210, 297],
        "linkage = \"four-bar\"\npanels = [14, 10]\nsampling = { samples = 24 }\n\
         grid = { frame = { from = 3, to = 4.3, step = 0.1 }, rocker = { from = 3, to = 3.9, step = 0.1 } }\n\
         let = { crank = 1, coupler = 3, along = 1.5, across = 1 }",
    );
    let lines = texts(&svg);
    assert!(
        ["4.3, 3.9", "captions: frame, rocker"].iter().all(|said| lines.iter().any(|line| line == said)),
        "{lines:?}"
    );
    assert!(lines.iter().all(|line| !line.ends_with('…') || line == "…"), "{lines:?}");
    let panel = svg.split("class=\"panel\"").nth(1).unwrap();
    // The scale bar, which is under the linkage, may have the same number.
    let numbers = panel.split("<text ").filter(|text| text.contains(">1</text>"));
    let number = numbers.flat_map(|text| attributes(&format!(" {text}"), "y")).fold(f64::INFINITY, f64::min);
    let joints = attributes(panel, "cy");
    assert!(joints.iter().all(|y| *y > number), "{number:?} {joints:?}");
    // Derived values are left out before.
    let svg = page_on_paper(
        [210, 297],
        "linkage = \"evans\"\npanels = [14, 8]\nsampling = { samples = 24 }\nlet = { a = \"(1 + p)^1.5 / 2\" }\n\
         grid = { p = { from = 2, to = 3.3, step = 0.1 }, k = { from = 1.5, to = 2.2, step = 0.1 } }",
    );
    let lines = texts(&svg);
    assert!(lines.windows(2).any(|pair| pair == ["p = 3.3,", "k = 2.2"]), "{lines:?}");
    assert!(lines.iter().any(|line| line == "captions that do not fit: what varies"), "{lines:?}");
}

#[test]
fn numbers_of_inputs_are_apart() {
    let svg = page_on_paper(
        [105, 148],
        "linkage = \"evans\"\npanels = [3, 2]\nlet = { a = \"(1 + p)^1.5 / 2\" }\ngrid = { p = [2, 2.5, 3], k = [1.5, 2] }",
    );
    let numbers: Vec<[f64; 3]> = (svg.split("<text ").skip(1))
        .filter(|text| ["90", "180", "270"].iter().any(|input| text.contains(&format!(">{input}</text>"))))
        .map(|text| ["x", "y", "font-size"].map(|name| attributes(&format!(" {text}"), name)[0]))
        .collect();
    // A figure is 0.636 of the size wide; the shorter number has two.
    let is_apart =
        |[a, b]: [&[f64; 3]; 2]| (a[1] - b[1]).abs() > a[2] || (a[0] - b[0]).abs() > (2.5 * 0.636 + 0.25) * a[2];
    assert!(numbers.len() > 5);
    assert!((0..numbers.len()).all(|k| numbers[..k].iter().all(|other| is_apart([other, &numbers[k]]))), "{numbers:?}");
}

#[test]
fn joints_have_one_size_on_a_page_and_texts_keep_to_its_margins() {
    // The first crank is too short to be seen between the smallest joints.
    let svg = page_on_paper(
        [432, 279],
        "linkage = \"four-bar\"\npanels = [3, 1]\ngrid = { crank = [0.002, 0.1, 1] }\n\
         let = { frame = 4, coupler = 3, rocker = 3.5, along = 3, across = 1 }\ncaption = \"{crank} and {frame} and {coupler} and {rocker}\"",
    );
    let linkages = groups(&svg, "linkage");
    let radii = |linkage: &&str| -> Vec<u64> { attributes(linkage, "r").into_iter().map(f64::to_bits).collect() };
    assert_eq!(linkages[..3].iter().map(radii).collect::<HashSet<_>>().len(), 1);
    // Border and margin are 8 mm each.
    let number = svg.split("<text ").find(|text| text.contains(">1</text>")).unwrap();
    assert!(attributes(&format!(" {number}"), "x")[0] >= 16.0, "{number}");
}

#[test]
fn ticks_have_the_inputs_of_the_tables() {
    let svg = page_on_paper([432, 279], "linkage = \"rack-steering\"\ncases = [{}]");
    let lines = texts(&svg);
    assert!(["−90", "−360"].iter().all(|input| lines.iter().any(|line| line == input)), "{lines:?}");
}

#[test]
fn circuits_that_are_apart_are_enlarged_in_frames_of_their_own() {
    // Two small mirror images, far from each other.
    let text = family(
        "id = \"f\"\nlinkage = \"four-bar\"\ncircuits = \"all\"\npanels = [1, 1]\ngrid = { crank = 0.05 }\n\
         let = { frame = 4, coupler = 3, rocker = 3.5, along = 3, across = 1 }",
    );
    let plan = plan(&text);
    let Page { svg, .. } = pages(&text, &plan).remove(0);
    assert_eq!(texts(&svg).iter().filter(|line| line.contains("enlarged ×")).count(), 2);
    let curves: Vec<&str> = svg.split("class=\"curve\"").skip(1).collect();
    assert_eq!(curves.len(), 2);
}

#[test]
fn linkages_have_one_scale_where_the_manifest_asks_for_it() {
    let scales = |keys: &str| -> Vec<f64> {
        // All are drawn as one figure.
        let text = family(&format!(
            "id = \"f\"\nlinkage = \"four-bar\"\npanels = [2, 2]\n{keys}\ngrid = {{ frame = [1, 1.5] }}\n\
             let = {{ crank = 3, coupler = 3, rocker = 3.5, across = 2 }}\ncircuits = \"start\""
        ));
        let plan = plan(&text);
        let Page { svg, planned, .. } = pages(&text, &plan).remove(0);
        let scale = |text: &str| text.split('"').next().unwrap().parse().unwrap();
        assert!(planned.scale == PanelScale::Panel || texts(&svg).iter().any(|line| line.starts_with("crank = ")));
        svg.split("data-scale=\"").skip(1).map(scale).collect()
    };
    let [free, common, fixed] = ["", "scale = \"page\"", "scale = \"5 mm\""].map(scales);
    assert_ne!(free[0], free[1]);
    assert_eq!(common, [free[0].min(free[1]); 2]);
    assert_eq!(fixed, [5.0; 2]);
}

#[test]
fn coupler_grids_have_the_scale_that_the_manifest_gives() {
    let pages = |scale: &str| -> Vec<String> {
        let text = family(&format!(
            "id = \"f\"\nlinkage = \"hrones-nelson\"\nlayout = \"coupler-grid\"\nscale = \"{scale}\"\n\
             cases = [{{ A = 3, B = 3.5, C = 4 }}, {{ A = 2, B = 2, C = 2 }}]"
        ));
        let folder = folder_with(&text);
        printed(folder.path(), &["render", "-q", "--format", "svg", "-o", "out"]);
        let files = fs::read_dir(folder.path().join("out/f")).unwrap().map(|entry| entry.unwrap().path());
        let pages: Vec<String> = files
            .filter(|path| path.extension().is_some_and(|extension| extension == "svg"))
            .map(|path| fs::read_to_string(path).unwrap())
            .collect();
        assert!(pages.len() >= 2);
        pages
    };
    for svg in pages("25 mm") {
        assert!(svg.split("data-scale=\"").skip(1).all(|rest| rest.starts_with("25\"")));
        assert!(texts(&svg).contains(&"crank = 25.0 mm on paper".to_owned()));
    }
}

#[test]
fn the_lengths_of_cognates_are_under_their_panels_or_as_formulas_in_the_key() {
    let cognates = |panels: &str, paper: &str| {
        let text = family(&format!(
            "id = \"f\"\nlinkage = \"cognates\"\npanels = {panels}\n\
             grid = {{ u = [0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4], v = [0.25, 0.5, 0.75, 1, 1.25] }}"
        ));
        let text = text.replace("[[family]]", &format!("[page]\npaper = {paper}\n[[family]]"));
        let plan = plan(&text);
        let lines = texts(&pages(&text, &plan)[0].svg);
        // The chains of the cognates are explained in any case.
        assert!(["links of ODEMHQ", "links of CFGMIQ"].iter().all(|links| lines.iter().any(|line| line == links)));
        // All lengths of a note, or none.
        let lengths = ["OD", "DE", "QE", "OQ", "CF", "FG", "QG", "CQ"].map(|name| {
            lines
                .iter()
                .filter(|line| [" = ", " ≈ "].iter().any(|sign| line.contains(&format!("{name}{sign}"))))
                .count()
        });
        assert!(lengths.iter().all(|count| *count == lengths[0]), "{lengths:?}");
        let has_formulas = lines.iter().any(|line| line.contains("QE = s √(u2 + v2) / a"));
        assert!(!lines.iter().any(|line| line == "notes that need larger panels are left out"));
        (lengths[0], has_formulas)
    };
    assert_eq!(cognates("[8, 5]", "\"a4\""), (1, true));
    assert_eq!(cognates("[4, 3]", "\"tabloid\""), (12, false));
    assert_eq!(cognates("[2, 2]", "\"a4\""), (4, false));
}

#[test]
#[ignore = "thorough"]
fn notes_that_do_not_fit_their_panels_are_left_out_whole_and_this_is_said() {
    let measured = |panels: &str| {
        let note = "the transmission angle is from {mu_min_deg:.2} to {mu_max_deg:.2} degrees, and the curve is {length:.3} long in all";
        let text = family(&format!(
            "id = \"f\"\nlinkage = \"four-bar\"\nnote = \"{note}\"\npanels = {panels}\n\
             grid = {{ crank = [0.5, 0.75, 1, 1.25, 1.5], along = [0, 1, 2, 3, 4, 5, 6, 7] }}\n\
             let = {{ frame = 4, coupler = 3, rocker = 3.5 }}"
        ));
        let text = text.replace("[[family]]", "[page]\npaper = \"a4\"\n[[family]]");
        let plan = plan(&text);
        let lines = texts(&pages(&text, &plan)[0].svg);
        let notes = lines.iter().filter(|line| line.starts_with("the transmission angle is")).count();
        (notes, lines.iter().any(|line| line == "notes that need larger panels are left out"))
    };
    assert_eq!(["[8, 5]", "[2, 2]"].map(measured), [(0, true), (4, false)]);
}

#[test]
fn a_crank_that_its_joints_would_hide_is_longer_in_the_key_which_says_so() {
    let remark = "hidden by its joints";
    let key = |crank: &str| {
        let text = family(&format!(
            "id = \"f\"\nlinkage = \"four-bar\"\ncases = [{{ frame = 1, crank = {crank}, coupler = 1.2, rocker = 0.8 }}]"
        ));
        let plan = plan(&text);
        let svg = pages(&text, &plan).remove(0).svg;
        // The key is drawn after the panel; a pivot has circles of two radii.
        let linkage = groups(&svg, "linkage")[1].to_owned();
        let circles = linkage.split("<circle ").skip(1).map(|circle| {
            ["cx", "cy", "r"].map(|name| {
                let value = circle.split(&format!("{name}=\"")).nth(1).unwrap();
                value.split('"').next().unwrap().parse::<f64>().unwrap()
            })
        });
        let circles: Vec<[f64; 3]> = circles.collect();
        let least = circles.iter().map(|[.., r]| *r).fold(f64::INFINITY, f64::min);
        let distance = |a: &[f64; 3], b: &[f64; 3]| Vector::new(a[0] - b[0], a[1] - b[1]).norm();
        let pairs = circles.iter().enumerate().flat_map(|(k, a)| circles[..k].iter().map(move |b| (a, b)));
        let apart =
            pairs.map(|(a, b)| distance(a, b)).filter(|distance| *distance > 1e-9).fold(f64::INFINITY, f64::min);
        (apart > 2.0 * least, texts(&svg).join(" ").contains(remark))
    };
    assert_eq!(key("0.2"), (true, false));
    for crank in ["0.01", "0.0001"] {
        assert_eq!(key(crank), (true, true), "{crank}");
    }
}

#[test]
fn the_key_of_a_coupler_grid_of_an_eight_bar_is_complete() {
    let text = "\
        [atlas]\ntitle = \"T\"\n[page]\npaper = \"a4\"\n[[family]]\nid = \"f\"\nlinkage = \"eight\"\n\
        layout = \"coupler-grid\"\ncases = [{}]\n[[linkage]]\nid = \"eight\"\ntrace = [\"N\"]\n[linkage.joints]\n\
        O = { fixed = [0, 0] }\nC = { fixed = [4, 0] }\nG = { fixed = [6.125, -1.0625] }\n\
        H = { fixed = [-1.5, 3.03125] }\nA = { crank = \"O\", length = 0.5 }\n\
        B = { dyad = [\"A\", \"C\"], lengths = [3, 3.5], side = \"left\" }\n\
        M = { point = [\"A\", \"B\"], along = 1.5, across = 1.03125 }\n\
        D = { dyad = [\"M\", \"G\"], lengths = [4.75, 4.53125], side = \"left\" }\n\
        K = { point = [\"M\", \"D\"], along = 2, across = -0.75 }\n\
        E = { dyad = [\"K\", \"H\"], lengths = [4.5, 2.25], side = \"right\" }\n\
        N = { point = [\"K\", \"E\"], along = { from = 0, to = 2, count = 5 }, across = { from = -0.5, to = 0.5, count = 2 } }\n";
    let folder = folder_with(text);
    printed(folder.path(), &["render", "-q", "--format", "svg", "-o", "out"]);
    let lines = texts(&fs::read_to_string(folder.path().join("out/f/f-001.svg")).unwrap());
    assert!(lines.contains(&"output: the link from H to E".to_owned()), "{lines:?}");
    assert!(!lines.iter().any(|line| line.contains("too small")));
    // The columns have portions to 1 % only, and the notes are on these.
    assert!(!lines.iter().any(|line| line.contains("0.1 %")));
}

#[test]
fn points_of_a_grid_on_a_sliding_body_have_the_coordinates_of_its_linkage() {
    let text = "[atlas]\ntitle = \"T\"\n[[family]]\nid = \"f\"\nlinkage = \"cylinder\"\nlayout = \"coupler-grid\"\n\
        cases = [{}]\n[[linkage]]\nid = \"cylinder\"\ntrace = [\"M\"]\n[linkage.joints]\nO = { fixed = [0, 0] }\n\
        C = { fixed = [2.5, 0] }\nA = { piston = [\"C\", \"O\"], length = 1.2, offset = 0.2, side = \"left\" }\n\
        M = { point = [\"C\", \"A\"], along = { from = 0.5, to = 1.25, count = 3 }, across = { from = -0.5, to = 0.25, count = 2 } }\n";
    let folder = folder_with(text);
    printed(folder.path(), &["render", "-q", "--format", "svg", "-o", "out"]);
    let svg = fs::read_to_string(folder.path().join("out/f/f-001.svg")).unwrap();
    let lines = texts(&svg);
    let count = |text: &str| lines.iter().filter(|line| *line == text).count();
    // Three values along, twice each, and two across, three times each; decimals as many as needed for all.
    for (coordinate, times) in [("0.500", 2), ("0.875", 2), ("1.250", 2), ("−0.50", 3), ("0.25", 3)] {
        assert_eq!(count(coordinate), times, "{coordinate}: {lines:?}");
    }
    // The key has one name for all points, and no link joins them: one through C, the foot and A, and the crank.
    assert_eq!(groups(&svg, "name").iter().flat_map(|names| texts(names)).filter(|name| name == "M").count(), 1);
    assert!(groups(&svg, "linkage").iter().all(|links| links.matches("<path").count() <= 4), "{svg}");
}

#[test]
fn long_names_of_joints_are_whole_in_the_key_and_numbers_in_its_drawing() {
    let names = [
        "FixedPivotOfTheCrank",
        "FixedPivotOfTheRocker",
        "PinOfTheCrank",
        "PinOfTheRocker",
        "CouplerPointOfTheLinkageThatTracesTheCurve",
    ];
    let [o, c, a, b, m] = names;
    let text = format!(
        "[atlas]\ntitle = \"T\"\n[page]\npaper = \"a4\"\n[[family]]\nid = \"f\"\nlinkage = \"long\"\nsampling = {{ samples = 24 }}\n\
         cases = [{{ r = 1 }}]\n[[linkage]]\nid = \"long\"\nparameters = {{ r = {{ min = 0 }} }}\ntrace = [\"{m}\"]\n[linkage.joints]\n\
         {o} = {{ fixed = [0, 0] }}\n{c} = {{ fixed = [3, 0] }}\n{a} = {{ crank = \"{o}\", length = \"r\" }}\n\
         {b} = {{ dyad = [\"{a}\", \"{c}\"], lengths = [3, 2.5], side = \"left\" }}\n\
         {m} = {{ point = [\"{a}\", \"{b}\"], along = 1.5, across = 1 }}\n"
    );
    let folder = folder_with(&text);
    printed(folder.path(), &["render", "-q", "--format", "svg", "-o", "out"]);
    let svg = fs::read_to_string(folder.path().join("out/f/f-001.svg")).unwrap();
    let lines = texts(&svg);
    assert!(lines.iter().all(|line| !line.contains('…')), "{lines:?}");
    let whole: String = lines.concat().split_whitespace().collect();
    for (k, name) in names.iter().enumerate() {
        assert!(whole.contains(&format!("{}{name}", k + 1)), "{name}: {lines:?}");
        assert!(lines.contains(&(k + 1).to_string()), "{k}: {lines:?}");
    }
    assert!(whole.contains(&format!("{o}–{a}=r")), "{lines:?}");
}

#[test]
fn a_page_says_what_it_shows_and_has_layers() {
    const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
    const XML: &str = "http://www.w3.org/XML/1998/namespace";
    for (panels, layers) in
        [(1, &["title", "f-1", "linkage", "f-1-1-1", "key"][..]), (2, &["title", "f-1", "f-2", "key"])]
    {
        let text = family(&format!(
            "id = \"f\"\nlinkage = \"evans\"\ntitle = \"A & B\"\npanels = [{panels}, 1]\ngrid = {{ p = [2, 3] }}\n\
             let = {{ a = \"(1 + p)^1.5 / 2\" }}"
        ));
        let plan = plan(&text);
        let Page { svg, .. } = pages(&text, &plan).remove(0);
        let document = roxmltree::Document::parse(&svg).unwrap();
        let root = document.root_element();
        assert_eq!(root.attribute("role"), Some("graphics-document document"));
        assert_eq!(root.attribute((XML, "lang")), Some("en"));
        let says = root.children().find(|child| child.has_tag_name("desc")).unwrap().text().unwrap();
        for words in ["A & B, no. 1: ", "p = 2", "r = 1", "crank-rocker", "μ "] {
            assert!(says.contains(words), "{words} in {says}");
        }
        assert_eq!(says.contains("A & B, no. 2: "), panels == 2);
        let is_layer = |node: &roxmltree::Node| node.attribute((INKSCAPE, "groupmode")) == Some("layer");
        let found: HashSet<&str> =
            document.descendants().filter(is_layer).filter_map(|node| node.attribute((INKSCAPE, "label"))).collect();
        assert!(layers.iter().all(|layer| found.contains(layer)), "{layers:?} in {found:?}");
        // A page of several figures has them as layers, and not all their parts.
        assert_eq!(found.contains("linkage"), panels == 1);
    }
}
