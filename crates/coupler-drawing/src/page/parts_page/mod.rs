//! The `drawing` layout: views of the parts of a linkage with dimensions, a view of the assembly, a table of parts and a title block.

mod assembly;
mod dimension;
mod extent;
mod group;
mod packing;
mod part_view;
mod sheet;
mod table;
mod title_block;

use super::area::Area;
use super::element::Drawing;
use super::figure::Figure;
use super::heading::margins;
use super::panels::draw_not_assembled;
use super::rect::Rect;
use super::theme::Theme;
use super::{Options, Panel, PanelPage, PanelScale, usual_scale_below};
use crate::scene::Anchor;
use assembly::Assembly;
use coupler_curves::geometry::{Point, Vector};
use coupler_curves::parts::{GivenSizes, Parts, PartsError};
use group::groups;
use part_view::Views;
use sheet::{Fitting, Sheet};
use table::Table;
use title_block::TitleBlock;

/// Draws the page, and returns the greatest scale at which the parts fit it, in millimetres to a unit.
pub(in crate::page) fn compose(root: &impl Area, page: &PanelPage, options: &Options, theme: &Theme) -> f64 {
    let top = page.heading.draw(root, theme);
    let top = top + 0.5 * theme.margin;
    let [_, bottom, _] = margins(theme);
    let bottom = bottom + page.heading.folio_height(root.size(), theme);
    let side = theme.border + theme.margin;
    let size = Vector::new(root.size().x - 2.0 * side, root.size().y - bottom - top);
    let contents = Rect { corner: Point::new(side, top), size };
    let Some(panel) = page.panels.first() else { return f64::INFINITY };
    let figure = Figure::from_panel(panel);
    let parts = figure.as_ref().map(|_| parts(panel));
    let block =
        TitleBlock { page, number: panel.solved_cell.cell.number, parameters: &panel.caption, paper: options.paper };
    let title_height = |width: f64| block.height(width, theme);
    let (sheet, scale, greatest) = match (&figure, &parts) {
        (Some(figure), Some(Ok(parts))) => {
            let groups = groups(parts);
            let views = Views { groups: &groups, sizes: parts.sizes, unit: page.heading.unit, theme };
            let assembly = Assembly { figure, key: page.key };
            let table = |sheet: &Sheet| {
                let names = assembly.numbered_names(sheet.assembly.size.x, theme);
                Table::new(&groups, parts, theme).with_note(names)
            };
            let fitting = |sheet: &Sheet| Fitting {
                views: views_fit(&views, sheet.views),
                table: table(sheet).fits(sheet.table.size),
            };
            let sheet = Sheet::best(contents, title_height, fitting, theme);
            let [scale, greatest] = scales(page, &views, sheet.views);
            let drawn = packing::layout(&views, scale, sheet.views);
            let scale = drawn.is_some().then_some(scale);
            match drawn {
                Some(drawn) => drawn.into_iter().for_each(|items| {
                    root.record(Drawing { class: "part", title: String::new(), items });
                }),
                None => draw_message(root, sheet.views, "the views of the parts do not fit the paper", theme),
            }
            assembly.draw(root, sheet.assembly, theme);
            table(&sheet).draw(root, sheet.table);
            (sheet, scale, greatest)
        }
        (_, not_drawn) => {
            let everything = |_: &Sheet| Fitting { views: true, table: true };
            let sheet = Sheet::best(contents, title_height, everything, theme);
            match not_drawn {
                Some(Err(error)) => draw_message(root, sheet.views, &error.to_string(), theme),
                _ => draw_not_assembled(root, sheet.views, panel.solved_cell, theme),
            }
            (sheet, None, f64::INFINITY)
        }
    };
    block.draw(root, (sheet.title, scale), theme);
    greatest
}

/// Writes what there is in place of views.
fn draw_message(root: &impl Area, rect: Rect, message: &str, theme: &Theme) {
    let size = theme.caption_size;
    let line = |words: &str, at: Point| theme.text_line(words, at, Anchor::Middle, size, theme.ink);
    let mut at = rect.centre();
    for words in line(message, at).wrap(rect.size.x) {
        root.record(line(&words, at));
        at.y += 1.3 * size;
    }
}

/// The parts of the linkage of a panel, as the circuit of its first curve needs them.
fn parts(panel: &Panel) -> Result<Parts, PartsError> {
    let solved = panel.solved_cell;
    let curve = &solved.curves[0];
    Parts::new((&solved.linkage, solved.circuit(curve)), curve.joint, GivenSizes::default())
}

/// The scale of the views, and the greatest at which they fit: the greatest usual one, or that of the page if they fit at it.
fn scales(page: &PanelPage, views: &Views, rect: Rect) -> [f64; 2] {
    let fits = |scale: f64| packing::layout(views, scale, rect).is_some();
    if !views_fit(views, rect) {
        return [least_scale(views, rect); 2];
    }
    let greatest = packing::greatest(2.0 * rect.size.max() / views.extent(), fits);
    let scale = match page.scale {
        PanelScale::Fixed(scale) => scale.min(greatest),
        PanelScale::Panel | PanelScale::Page => usual_scale_below(greatest, page.heading.unit),
    };
    // Views that are smaller may be in rows of another height.
    [if fits(scale) { scale } else { greatest }, greatest]
}

/// Whether views fit a rectangle at any scale: with their texts and hardly any parts.
fn views_fit(views: &Views, rect: Rect) -> bool {
    packing::layout(views, least_scale(views, rect), rect).is_some()
}

/// The scale at which the longest part is a fiftieth of a rectangle.
fn least_scale(views: &Views, rect: Rect) -> f64 {
    0.02 * rect.size.max() / views.extent()
}

#[cfg(test)]
mod tests {
    use super::extent::text_corners;
    use crate::page::{self, Heading, Key, Layout, Options, Panel, PanelPage, PanelScale, Paper};
    use crate::scene::{MIN_TEXT_SIZE, Scene, Shape, Text};
    use coupler_curves::catalogue;
    use coupler_curves::family::{Family, Sampling};
    use coupler_curves::geometry::Point;
    use coupler_curves::linkage_format::parse_templates;
    use coupler_curves::solve::Solver;
    use coupler_curves::template::Template;
    use std::sync::Arc;

    /// A title that takes three lines at the foot of a page.
    const TITLE: &str = "Drawings of linkages for the workshop, with a title that is so long that it does not go on one line, nor on \
                         two, at the foot of a page, where the title block is";

    /// The page of a linkage of the catalogue with its default dimensions.
    fn page(id: &str, paper: Paper, scale: PanelScale) -> Scene {
        page_of(catalogue::find(id).unwrap(), (Layout::Drawing, paper, scale), TITLE)
    }

    fn page_of(
        template: Arc<Template>,
        (layout, paper, scale): (Layout, Paper, PanelScale),
        atlas_title: &str,
    ) -> Scene {
        let family = Family::single_cell(template, &[], Sampling::Samples(90)).unwrap();
        let solved = Solver::new(&family).solve(0).unwrap();
        let key = Key::new(&family);
        let heading = Heading::new(&family.title).with_family_id(&family.id).with_atlas_title(atlas_title);
        let panels = vec![Panel::new(&solved).with_caption("p = 2, q = 3")];
        let page = PanelPage { heading, layout, panels, scale, key: Some(&key) };
        page::compose_panels(&page, &Options::for_paper(paper))
    }

    /// The words of the page of a linkage in a text.
    fn words_of(linkage: &str, layout: Layout, paper: Paper) -> Vec<String> {
        let template = parse_templates(linkage).unwrap().remove(0);
        let scene = page_of(template.into(), (layout, paper, PanelScale::Panel), "");
        texts(&scene).into_iter().map(words).collect()
    }

    fn all_words_of(id: &str, layout: Layout) -> String {
        let scene = page_of(catalogue::find(id).unwrap(), (layout, A3, PanelScale::Panel), "");
        texts(&scene).into_iter().map(words).collect::<Vec<_>>().join(" ")
    }

    const PANEL: Layout = Layout::Panels { columns: 1, rows: 1 };
    const A3: Paper = Paper::NAMED[3].1;
    const SMALL: [Paper; 5] = [
        Paper { width: 210.0, height: 297.0 },
        Paper { width: 148.0, height: 210.0 },
        Paper { width: 210.0, height: 148.0 },
        Paper { width: 105.0, height: 148.0 },
        Paper { width: 148.0, height: 105.0 },
    ];

    fn texts(scene: &Scene) -> Vec<&Text> {
        let text = |shape| if let Shape::Text(text) = shape { Some(text) } else { None };
        scene.shapes().into_iter().filter_map(text).collect()
    }

    fn words(text: &Text) -> String {
        text.runs.iter().map(|run| run.text.as_str()).collect()
    }

    #[test]
    fn texts_can_be_read_and_do_not_overlap() {
        let papers = [Paper::NAMED[3].1, Paper::NAMED[2].1, Paper { width: 210.0, height: 297.0 }];
        for id in [
            "slider-crank",
            "inverted-slider-crank",
            "jansen",
            "watt-six-bar",
            "geared-five-bar",
            "scotch-yoke",
            "peaucellier-lipkin",
        ] {
            for paper in papers {
                let scene = page(id, paper, PanelScale::Panel);
                let texts = texts(&scene);
                assert!(texts.len() > 15, "{id}: {}", texts.len());
                for (k, text) in texts.iter().enumerate() {
                    assert!(text.size >= MIN_TEXT_SIZE * 0.999, "{id}: {}", words(text));
                    let [a, b] = text_corners(text);
                    assert!(a.x > 0.0 && a.y > 0.0 && b.x < paper.width && b.y < paper.height, "{id}: {}", words(text));
                    for other in &texts[..k] {
                        let [c, d] = text_corners(other);
                        let overlap = |from: fn(&Point) -> f64| from(&b).min(from(&d)) - from(&a).max(from(&c));
                        // Boxes have some space above and below the letters.
                        let overlaps = overlap(|p| p.x) > 0.2 && overlap(|p| p.y) > 0.2;
                        assert!(!overlaps, "{id} on {paper:?}: {} and {}", words(other), words(text));
                    }
                }
            }
        }
    }

    #[test]
    fn the_table_and_the_title_block_are_whole_on_small_paper() {
        for paper in SMALL {
            for (id, parts) in [
                ("jansen", &["frame", "OP", "PX", "BXW", "PY", "BY", "WZ", "Y-Z-Foot"][..]),
                ("geared-five-bar", &["frame", "gear P", "gear O"]),
                ("scotch-yoke", &["yoke Y", "1 + 2", "3 + 1"]),
            ] {
                let template = catalogue::find(id).unwrap();
                let scene = page_of(template, (Layout::Drawing, paper, PanelScale::Panel), "An atlas of drawings");
                let words: Vec<String> = texts(&scene).into_iter().map(words).collect();
                assert!(!words.iter().any(|word| word.contains('…')), "{id} on {paper:?}: {words:?}");
                for expected in parts.iter().chain(&["part", "holes", "family", "p = 2, q = 3"]) {
                    assert!(words.iter().any(|word| word == expected), "{id} on {paper:?}: {expected}: {words:?}");
                }
            }
        }
    }

    /// So many dyads on a crank that the table has more rows than the page has lines.
    #[test]
    fn rows_that_do_not_fit_are_counted() {
        let dyad = |k: u32| {
            let [near, low, high] = [0.1, 0.01, 0.02].map(|step| step * f64::from(k));
            format!(
                "P{k} = {{ fixed = [{}, {near}] }}\n\
                 B{k} = {{ dyad = [\"A\", \"P{k}\"], lengths = [{}, {}], side = \"left\" }}\n",
                3.0 + near,
                4.0 + low,
                4.5 + high,
            )
        };
        let linkage = format!(
            "[[linkage]]\nid = \"many\"\ntrace = [{}]\n[linkage.joints]\nO = {{ fixed = [0, 0] }}\n\
             A = {{ crank = \"O\", length = 1 }}\n{}",
            (0..14).map(|k| format!("\"B{k}\"")).collect::<Vec<_>>().join(", "),
            (0..14).map(dyad).collect::<String>(),
        );
        let words = words_of(&linkage, Layout::Drawing, SMALL[4]);
        let left_out = |word: &String| word.starts_with("… and ") && word.contains(" more parts");
        assert!(words.iter().any(left_out), "{words:?}");
    }

    #[test]
    fn a_title_block_has_the_load() {
        let linkage = "[[linkage]]\nid = \"press\"\ntrace = [\"B\"]\nload = { joint = \"B\", force = 3, direction = \"-90 deg\" }\n\
                       [linkage.joints]\nO = { fixed = [0, 0] }\nX = { fixed = [1, 0] }\nA = { crank = \"O\", length = 1 }\n\
                       B = { slide = \"A\", length = 3, line = [\"O\", \"X\"], offset = 0, side = \"ahead\" }\n";
        assert!(words_of(linkage, Layout::Drawing, A3).contains(&"3 on B at −90°".to_owned()));
        let panel = words_of(linkage, PANEL, A3);
        assert!(panel.contains(&"load: 3 on B at −90°".to_owned()), "{panel:?}");
    }

    /// On a narrow plate of short links, where long names have no room beside their holes.
    #[test]
    fn long_names_are_clear_of_outlines_and_dimensions() {
        let names = ["Antriebslager", "Schwingenlager", "Kurbelzapfen", "Schwingenzapfen", "Koppelpunkt"];
        let [o, c, a, b, m] = names;
        let linkage = format!(
            "[[linkage]]\nid = \"long\"\ntrace = [\"{m}\"]\n[linkage.joints]\n{o} = {{ fixed = [0, 0] }}\n{c} = {{ fixed = [4, 0] }}\n\
             {a} = {{ crank = \"{o}\", length = 1 }}\n\
             {b} = {{ dyad = [\"{a}\", \"{c}\"], lengths = [3, 3.5], side = \"left\" }}\n\
             {m} = {{ point = [\"{a}\", \"{b}\"], along = 1.5, across = 0.3 }}\n"
        );
        let small = words_of(&linkage, Layout::Drawing, SMALL[3]).join(" ");
        assert!(small.contains("1 Antriebslager · 2"), "numbers in the assembly: {small}");
        let template = parse_templates(&linkage).unwrap().remove(0);
        let scene = page_of(template.into(), (Layout::Drawing, A3, PanelScale::Panel), "");
        let names: Vec<_> = texts(&scene).into_iter().filter(|text| names.contains(&words(text).as_str())).collect();
        assert!(names.len() >= 9);
        let shapes = scene.shapes();
        let lines = shapes.iter().filter_map(|shape| if let Shape::Path(path) = shape { Some(path) } else { None });
        let lines = lines.filter(|path| path.stroke.is_some());
        let points: Vec<Point> = lines
            .flat_map(|path| &path.polylines)
            .flat_map(|line| line.points.windows(2))
            .flat_map(|ends| (1..100).map(|k| ends[0] + (ends[1] - ends[0]) * (f64::from(k) / 100.0)))
            .collect();
        for name in names {
            // Without the space above and below most letters, where a line from a hole may end.
            let [low, high] = text_corners(name);
            let inset = 0.25 * name.size;
            let is_in = |p: &&Point| {
                (low.x + inset..high.x - inset).contains(&p.x) && (low.y + inset..high.y - inset).contains(&p.y)
            };
            let crossed = points.iter().filter(is_in).count();
            assert_eq!(crossed, 0, "{}", words(name));
        }
    }

    #[test]
    fn a_small_part_has_a_scale_of_its_own() {
        let words = all_words_of("rack-steering", Layout::Drawing);
        assert!(words.contains("gear O, scale "), "{words}");
    }

    #[test]
    fn what_is_not_drawn_and_what_an_input_is_measured_from_is_said() {
        let press = all_words_of("toggle-press", PANEL);
        assert!(
            press.contains("fixed point at (0, −2); beyond the") || press.contains("beyond the drawing"),
            "{press}"
        );
        let actuator = all_words_of("linear-actuator", PANEL);
        assert!(actuator.contains("from the foot of the perpendicular"), "{actuator}");
    }

    /// The line of the slot passes beside its pivot, and through it.
    #[test]
    fn feet_that_a_drawing_has_not_are_no_pins_and_have_one_apostrophe() {
        let linkage = |y: &str| {
            format!(
                "[[linkage]]\nid = \"arm\"\ntrace = [\"M\"]\n[linkage.drawing]\njoints = {{ O = [0, 0], A = [1, 0], Pin = [3, {y}], P = [2, 0], M = [5, 0] }}\n\
                 frame = [\"O\", \"Pin\"]\nlinks = [[\"O\", \"A\"], [\"Pin\", \"P\", \"M\"]]\nslides = {{ A = [\"P\", \"M\"] }}\ninput = \"O A\"\n"
            )
        };
        let beside = words_of(&linkage("0.5"), PANEL, A3).join(" ");
        assert!(beside.contains("Pin’ ") && !beside.contains('\''), "{beside}");
        let through = words_of(&linkage("0"), PANEL, A3).join(" ");
        assert!(
            through.contains("slides through A") && !through.contains("Pin’") && !through.contains("Pin'"),
            "{through}"
        );
        let template = parse_templates(&linkage("0.5")).unwrap().remove(0);
        let structure = template.structure().unwrap();
        let is_pin = |name: &str| structure.is_pin(structure.find_joint(name).unwrap());
        assert_eq!(["O", "A", "Pin", "Pin'", "P"].map(is_pin), [true, true, true, false, true]);
    }

    #[test]
    fn a_page_has_the_dimensions_of_each_part_and_a_scale() {
        let scene = page("jansen", Paper::NAMED[3].1, PanelScale::Panel);
        let words: Vec<String> = texts(&scene).into_iter().map(words).collect();
        for expected in ["15", "50", "61.9", "39.3", "jansen", "a3", "O–P 15"] {
            assert!(words.iter().any(|word| word == expected), "{expected}: {words:?}");
        }
        let fixed = page("jansen", Paper::NAMED[3].1, PanelScale::Fixed(0.5));
        assert!(texts(&fixed).into_iter().any(|text| self::words(text) == "0.5 mm"), "the scale that is asked for");
    }
}
