//! The `drawing` layout: views of the parts of a linkage with dimensions, a view of the assembly, a table of parts and a title block.

mod dimension;
mod extent;
mod group;
mod packing;
mod part_view;
mod table;
mod title_block;

use super::area::Area;
use super::element::Drawing;
use super::figure::Figure;
use super::heading::margins;
use super::key_drawing;
use super::panels::draw_not_assembled;
use super::rect::Rect;
use super::theme::Theme;
use super::{Key, Options, Panel, PanelPage, PanelScale, usual_scale_below};
use crate::scene::Anchor;
use coupler_curves::geometry::{Point, Vector};
use coupler_curves::parts::{GivenSizes, Parts, PartsError};
use group::{Group, groups};
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
    let (views, [assembly, table, title]) = divide(contents, theme);
    let [scale, greatest] = match (&figure, &parts) {
        (Some(figure), Some(Ok(parts))) => {
            let groups = groups(parts);
            let scales = scales(page, &groups, parts, views, theme);
            match packing::layout(&groups, parts.sizes, scales[0], views, theme) {
                Some(drawn) => drawn.into_iter().for_each(|items| {
                    root.record(Drawing { class: "part", title: String::new(), items });
                }),
                None => draw_message(root, views, "the views of the parts do not fit the paper", theme),
            }
            draw_assembly(root, assembly, (figure, page.key), theme);
            table::draw(root, table, &groups, parts, theme);
            scales
        }
        (_, Some(Err(error))) => {
            draw_message(root, views, &error.to_string(), theme);
            [1.0, f64::INFINITY]
        }
        _ => {
            draw_not_assembled(root, views, panel.solved_cell, theme);
            [1.0, f64::INFINITY]
        }
    };
    TitleBlock { page, number: panel.solved_cell.cell.number, scale, paper: options.paper }.draw(root, title, theme);
    greatest
}

/// Writes what there is in place of views.
fn draw_message(root: &impl Area, rect: Rect, message: &str, theme: &Theme) {
    let line = theme.text_line(message, rect.centre(), Anchor::Middle, theme.caption_size, theme.ink);
    root.record(line.fit_width(rect.size.x));
}

/// The parts of the linkage of a panel, as the circuit of its first curve needs them.
fn parts(panel: &Panel) -> Result<Parts, PartsError> {
    let solved = panel.solved_cell;
    let curve = &solved.curves[0];
    Parts::new((&solved.linkage, solved.circuit(curve)), curve.joint, GivenSizes::default())
}

/// The scale of the views, and the greatest at which they fit: the greatest usual one, or that of the page if they fit at it.
fn scales(page: &PanelPage, groups: &[Group], parts: &Parts, views: Rect, theme: &Theme) -> [f64; 2] {
    let fits = |scale: f64| packing::layout(groups, parts.sizes, scale, views, theme).is_some();
    let extent = groups.iter().map(|group| group.part.outline.bounds().size().max()).fold(0.0, f64::max);
    let greatest = packing::greatest(2.0 * views.size.max() / extent, fits);
    let scale = match page.scale {
        PanelScale::Fixed(scale) => scale.min(greatest),
        PanelScale::Panel | PanelScale::Page => usual_scale_below(greatest, page.heading.unit),
    };
    // Views that are smaller may be in rows of another height.
    [if fits(scale) { scale } else { greatest }, greatest]
}

/// The rectangle of the views, and those of the assembly, the table and the title block: in a column on the right of a wide page, or
/// side by side under the views of a high one.
fn divide(contents: Rect, theme: &Theme) -> (Rect, [Rect; 3]) {
    let gap = theme.margin;
    let title_height = TitleBlock::height(theme);
    let part =
        |x: f64, y: f64, w: f64, h: f64| Rect { corner: contents.corner + Vector::new(x, y), size: Vector::new(w, h) };
    let (width, height) = (contents.size.x, contents.size.y);
    if width > height {
        let column = 0.3 * width;
        let (x, views) = (width - column, width - column - gap);
        let assembly = (0.75 * column).min(0.4 * height);
        let table = height - assembly - title_height - 2.0 * gap;
        let rects = [
            part(x, 0.0, column, assembly),
            part(x, assembly + gap, column, table),
            part(x, height - title_height, column, title_height),
        ];
        return (part(0.0, 0.0, views, height), rects);
    }
    let row = (0.3 * height).max(title_height);
    let (y, third) = (height - row, (width - 2.0 * gap) / 3.0);
    let rects = [
        part(0.0, y, third, row),
        part(third + gap, y, third, row),
        part(2.0 * (third + gap), height - title_height, third, title_height),
    ];
    (part(0.0, 0.0, width, height - row - gap), rects)
}

/// Draws the linkage in its pose, with the names of its joints.
fn draw_assembly(root: &impl Area, rect: Rect, (figure, key): (&Figure, Option<&Key>), theme: &Theme) {
    if let (Some(mechanism), Some(key)) = (figure.mechanisms.first(), key) {
        let ink = |joint| figure.joint_ink(joint, theme);
        key_drawing::draw_linkage(root, rect, (mechanism, key), figure.first_circuit(), ink, theme);
    }
}

#[cfg(test)]
mod tests {
    use super::extent::text_corners;
    use crate::page::{self, Heading, Key, Layout, Options, Panel, PanelPage, PanelScale, Paper};
    use crate::scene::{MIN_TEXT_SIZE, Scene, Shape, Text};
    use coupler_curves::catalogue;
    use coupler_curves::family::{Family, Sampling};
    use coupler_curves::geometry::Point;
    use coupler_curves::solve::Solver;

    /// A title that takes three lines at the foot of a page.
    const TITLE: &str = "Drawings of linkages for the workshop, with a title that is so long that it does not go on one line, nor on \
                         two, at the foot of a page, where the title block is";

    /// The page of a linkage of the catalogue with its default dimensions.
    fn page(id: &str, paper: Paper, scale: PanelScale) -> Scene {
        let family = Family::single_cell(catalogue::find(id).unwrap(), &[], Sampling::Samples(90)).unwrap();
        let solved = Solver::new(&family).solve(0).unwrap();
        let key = Key::new(&family);
        let heading = Heading::new(&family.title).with_family_id(&family.id).with_atlas_title(TITLE);
        let panels = vec![Panel::new(&solved)];
        let page = PanelPage { heading, layout: Layout::Drawing, panels, scale, key: Some(&key) };
        page::compose_panels(&page, &Options::for_paper(paper))
    }

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
