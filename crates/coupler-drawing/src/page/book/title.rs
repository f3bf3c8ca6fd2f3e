//! The title page of a volume.

use super::super::area::{self, Area};
use super::super::arrangement::Arrangement;
use super::super::element::{Drawing, TextLine};
use super::super::figure::Figure;
use super::super::heading;
use super::super::rect::Rect;
use super::super::theme::Theme;
use super::super::{Options, PanelPage};
use super::atlas::{Atlas, Chapter, Volume};
use crate::scene::group_class::TITLE;
use crate::scene::{Anchor, Color, Group, Item, Path, Scene};
use coupler_curves::geometry::{Point, Vector};

/// The most lines for families.
const MAX_FAMILIES: usize = 5;

pub(super) fn compose(
    scene: &mut Scene,
    atlas: &Atlas,
    volume: &Volume,
    frontispiece: Option<&PanelPage>,
    options: &Options,
    theme: &Theme,
) {
    let root = area::whole_page(scene);
    heading::draw_border(&root, theme);
    let page = root.size();
    let width = page.x - 2.0 * (theme.border + 2.0 * theme.margin);
    let centred = |text: &str, y: f64, size: f64, color: Color| {
        root.record(theme.text_line(text, Point::new(page.x / 2.0, y), Anchor::Middle, size, color).fit_width(width));
    };
    let family_line = |text: &str| {
        theme.text_line(text, Point::origin(), Anchor::Middle, 1.1 * theme.source_size, theme.ink).fit_or_wrap(width)
    };
    let lines: Vec<TextLine> = family_lines(atlas).iter().flat_map(|text| family_line(text)).collect();
    let step = 1.7 * theme.source_size;
    let foot = page.y - theme.border - 2.2 * theme.margin;
    let first = foot - 1.6 * theme.title_size - step * lines.len() as f64;
    let mut y = theme.border + 5.2 * theme.title_size;
    let max_lines = (first - 4.0 * theme.title_size - y) / (LEADING * theme.title_size) + 1.0;
    root.grouped(Group::of_class(TITLE), || {
        for line in wrap_title(atlas.title, width, max_lines.clamp(1.0, 4.0) as usize, theme) {
            centred(&line, y, TITLE_SCALE * theme.title_size, theme.ink);
            y += LEADING * theme.title_size;
        }
    });
    y += (1.3 - LEADING) * theme.title_size;
    draw_rule(&root, Point::new(page.x / 2.0, y), 5.0 * theme.title_size, theme);
    if let Some(name) = volume.name() {
        y += 1.4 * theme.title_size;
        centred(&name, y, 1.3 * theme.source_size, theme.grey);
    }
    for (line, k) in lines.into_iter().zip(1..) {
        root.record(line.moved_to(Point::new(page.x / 2.0, first + step * f64::from(k))));
    }
    centred(atlas.program, foot, theme.source_size, theme.grey);
    if let Some(frontispiece) = frontispiece {
        let corner = Point::new(theme.border + 2.0 * theme.margin, y + 2.0 * theme.title_size);
        let size = Vector::new(width, first - theme.title_size - corner.y);
        draw_frontispiece(&root, Rect { corner, size }, frontispiece, options, theme);
    }
}

/// The font size of the title, relative to that of the title of a page.
const TITLE_SCALE: f64 = 2.2;
/// The distance of lines of the title, likewise.
const LEADING: f64 = 2.7;

/// A title wrapped to at most `max_lines` lines no wider than `max_width`, all about equally wide.
fn wrap_title(title: &str, max_width: f64, max_lines: usize, theme: &Theme) -> Vec<String> {
    let line = theme.text_line(title, Point::origin(), Anchor::Middle, TITLE_SCALE * theme.title_size, theme.ink);
    let count = line.wrap(max_width).len();
    let even = line.text.width() / count as f64;
    let widths = (20..).map(|k| (f64::from(k) / 20.0 * even).min(max_width));
    let mut lines = widths.map(|width| line.wrap(width)).find(|lines| lines.len() <= count).unwrap_or_default();
    let rest = lines.split_off(max_lines.min(lines.len()) - 1);
    lines.push(rest.join(" "));
    lines
}

/// A line for each family, with its counts.
fn family_lines(atlas: &Atlas) -> Vec<String> {
    let line = |chapter: &Chapter| format!("{} · {}", chapter.title, chapter.format_counts(" · "));
    let chapters = &atlas.chapters;
    // The last line is for all families without a separate line.
    let line_count = if chapters.len() > MAX_FAMILIES { MAX_FAMILIES - 1 } else { chapters.len() };
    let named = chapters[..line_count].iter().map(line);
    let rest = &chapters[line_count..];
    let others = (!rest.is_empty()).then(|| {
        let cells = rest.iter().flat_map(|chapter| chapter.cells.iter().cloned()).collect();
        let (curves, pages) =
            (rest.iter().map(|chapter| chapter.curve_count).sum(), rest.iter().map(|chapter| chapter.page_count).sum());
        line(&Chapter {
            title: &format!("{} more families", rest.len()),
            symbols: &[],
            curve_count: curves,
            page_count: pages,
            cells,
            sections: Vec::new(),
        })
    });
    named.chain(others).collect()
}

/// Draws a line under the title.
fn draw_rule(root: &impl Area, centre: Point, length: f64, theme: &Theme) {
    let half = Vector::new(length / 2.0, 0.0);
    let path = Path::stroked(vec![centre - half, centre + half], theme.stroke(theme.hairline, theme.fine_width));
    root.record(Drawing { class: "rule", title: String::new(), items: vec![Item::Path(path)] });
}

/// Draws the first panel of a page, if it has a curve and there is enough space.
fn draw_frontispiece(root: &impl Area, frame: Rect, page: &PanelPage, options: &Options, theme: &Theme) {
    let Some(panel) = page.panels.first() else { return };
    let Some(figure) = Figure::from_panel(panel) else { return };
    if frame.size.x > 10.0 * theme.joint_radius && frame.size.y > 10.0 * theme.joint_radius {
        let period = figure.dash_period(options);
        let group = Group::figure("panel", panel.description(page.heading.family_title, page.heading.dimensions));
        root.grouped(group, || {
            figure.draw(root, frame, (Arrangement::Combined, None, period), page, [theme; 2]);
        });
    }
}
