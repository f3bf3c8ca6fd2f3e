use plotters::drawing::IntoDrawingArea;

use super::super::arrangement::{Arrangement, Frame};
use super::super::element::{Area, Drawing, draw, size};
use super::super::figure::Figure;
use super::super::heading;
use super::super::theme::Theme;
use super::super::{Options, Sheet};
use super::{Atlas, Chapter, Volume, number};
use crate::scene::{Anchor, Canvas, Color, Item, Label, Path, Scene};
use coupler_curves::geometry::{Point, Vector};

/// The most families that are named.
const MOST: usize = 5;

pub(super) fn compose(
    scene: &mut Scene,
    atlas: &Atlas,
    volume: &Volume,
    frontispiece: Option<&Sheet>,
    (options, theme): (&Options, &Theme),
) {
    let root = Canvas::new(scene).into_drawing_area();
    heading::border(&root, theme);
    let page = size(&root);
    let room = page.x - 2.0 * (theme.border + 2.0 * theme.margin);
    let centred = |text: &str, y: f64, size: f64, color: Color| {
        draw(&root, &theme.words(text, Point::new(page.x / 2.0, y), Anchor::Middle, size, color).fitted(room));
    };
    let lines = families(atlas);
    let step = 1.7 * theme.source;
    let foot = page.y - theme.border - 2.2 * theme.margin;
    let first = foot - 1.6 * theme.title - step * lines.len() as f64;
    let mut y = theme.border + 5.2 * theme.title;
    let most = (first - 4.0 * theme.title - y) / (LEADING * theme.title) + 1.0;
    for line in title(atlas.title, room, most.clamp(1.0, 4.0) as usize, theme) {
        centred(&line, y, TITLE * theme.title, theme.ink);
        y += LEADING * theme.title;
    }
    y += (1.3 - LEADING) * theme.title;
    rule(&root, Point::new(page.x / 2.0, y), 5.0 * theme.title, theme);
    if let Some(name) = volume.name() {
        y += 1.4 * theme.title;
        centred(&name, y, 1.3 * theme.source, theme.grey);
    }
    for (line, k) in lines.iter().zip(1..) {
        centred(line, first + step * f64::from(k), 1.1 * theme.source, theme.ink);
    }
    centred(atlas.program, foot, theme.source, theme.grey);
    if let Some(sheet) = frontispiece {
        let corner = Point::new(theme.border + 2.0 * theme.margin, y + 2.0 * theme.title);
        let size = Vector::new(room, first - theme.title - corner.y);
        figure(&root, Frame { corner, size }, sheet, (options, theme));
    }
    drop(root);
    number(scene, Label::Roman(1), options);
}

/// The em of the title, and from one of its lines to the next, in those of a page's.
const TITLE: f64 = 2.2;
const LEADING: f64 = 2.7;

/// A title in lines no wider than `room` and about as wide as each other, `most` at most.
fn title(title: &str, room: f64, most: usize, theme: &Theme) -> Vec<String> {
    let words = theme.words(title, Point::origin(), Anchor::Middle, TITLE * theme.title, theme.ink);
    let count = words.wrapped(room).len();
    let even = words.text.width() / count as f64;
    let widths = (20..).map(|k| (f64::from(k) / 20.0 * even).min(room));
    let mut lines = widths.map(|width| words.wrapped(width)).find(|lines| lines.len() <= count).unwrap_or_default();
    let rest = lines.split_off(most.min(lines.len()) - 1);
    lines.push(rest.join(" "));
    lines
}

/// What the atlas has, a line for each family.
fn families(atlas: &Atlas) -> Vec<String> {
    let line = |chapter: &Chapter| format!("{} · {}", chapter.title, chapter.counts(" · "));
    let chapters = &atlas.chapters;
    // The last line is for those that have no line of their own.
    let own = if chapters.len() > MOST { MOST - 1 } else { chapters.len() };
    let named = chapters[..own].iter().map(line);
    let rest = &chapters[own..];
    let others = (!rest.is_empty()).then(|| {
        let cells = rest.iter().flat_map(|chapter| chapter.cells.iter().cloned()).collect();
        let (curves, pages) =
            (rest.iter().map(|chapter| chapter.curves).sum(), rest.iter().map(|chapter| chapter.pages).sum());
        line(&Chapter { title: &format!("{} more families", rest.len()), symbols: &[], curves, pages, cells })
    });
    named.chain(others).collect()
}

/// A line under the title.
fn rule(root: &Area, centre: Point, length: f64, theme: &Theme) {
    let half = Vector::new(length / 2.0, 0.0);
    let path = Path::stroked(vec![centre - half, centre + half], theme.stroke(theme.hairline, theme.fine));
    draw(root, &Drawing { class: "rule", title: String::new(), items: vec![Item::Path(path)] });
}

/// The first cell of a sheet; nothing, where it has no curve or there is no room.
fn figure(root: &Area, frame: Frame, sheet: &Sheet, (options, theme): (&Options, &Theme)) {
    let Some(figure) = sheet.panels.first().and_then(Figure::of) else { return };
    if frame.size.x > 10.0 * theme.joint && frame.size.y > 10.0 * theme.joint {
        figure.draw(root, frame, Arrangement::Together, sheet, (options, theme));
    }
}
