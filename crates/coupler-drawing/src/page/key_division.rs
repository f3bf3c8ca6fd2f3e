//! How the contents of a page are divided between its key and what is beside it.

use super::heading;
use super::key::Key;
use super::key_drawing::{self, COLUMN_WIDTH, LEADING, MORE_REMARKS, STRIP_DRAWING_PART, lines_height};
use super::rect::Rect;
use super::theme::Theme;
use super::{Options, Paper};
use coupler_curves::geometry::{Point, Vector};

/// What a key is drawn beside: panels or charts in columns and rows, with the least size of one.
#[derive(Clone, Copy)]
pub(super) struct Beside {
    pub grid: [usize; 2],
    /// The least width and height of one, in ems of a caption.
    pub least: [f64; 2],
    /// The same where the key takes more than the usual part of its page.
    pub least_on_small_paper: [f64; 2],
}

impl Beside {
    /// The most of a page that the key takes.
    fn most_of_key(self) -> f64 {
        PARTS[if self.grid == [1, 1] { 2 } else { 1 }]
    }

    /// Whether all have the least size in contents of a size.
    fn fits(self, size: Vector, is_small: bool, theme: &Theme) -> bool {
        let em = theme.for_panel_size(Vector::zeros()).caption_size;
        let least = if is_small { self.least_on_small_paper } else { self.least };
        (0..2).all(|k| size[k] >= self.grid[k] as f64 * least[k] * em)
    }
}

/// The part of a page that its key takes, the most that it takes where the panels are large enough, and the most beside a single one, whose
/// linkage the key shows once more.
const PARTS: [f64; 3] = [0.36, 0.56, 0.68];

/// How a key takes its part of the contents of a page.
#[derive(Clone, Copy)]
struct Division {
    /// Whether it is a column on the right, of a wide page, and not a strip at the foot.
    is_wide: bool,
    /// The length of the contents that are divided, and what the key takes of it.
    whole: f64,
    needed: f64,
    /// Whether the key takes more than its usual part.
    is_small: bool,
}

impl Division {
    fn new(contents: Vector, beside: Beside, key: Option<&Key>, theme: &Theme) -> Division {
        let em = theme.note_size;
        let is_wide = contents.x > 1.1 * contents.y;
        let (whole, usual) =
            if is_wide { (contents.x, COLUMN_WIDTH * em) } else { (contents.y, 1.1 * COLUMN_WIDTH * em) };
        let is_small = usual > PARTS[0] * whole;
        let Some(key) = key else { return Division { is_wide, whole, needed: usual, is_small } };
        let strip = strip_height(contents.x, key, theme);
        let needed = if is_small && !is_wide { strip.min(usual) } else { usual };
        let division = Division { is_wide, whole, needed, is_small };
        // A key with more lines takes more, where that leaves enough.
        let larger = if is_wide {
            [2.0, 3.0].map(|columns| columns * usual + theme.margin).to_vec()
        } else {
            vec![strip.min(beside.most_of_key() * whole)]
        };
        let larger = larger.into_iter().filter(|needed| *needed > division.needed);
        let larger = larger.map(|needed| Division { needed, is_small: true, ..division });
        let mut fitting = larger.filter(|larger| larger.has_room(contents, beside, theme));
        match key_drawing::has_all_lines(division.key(contents, theme), key, theme) {
            true => division,
            false => fitting.next().unwrap_or(division),
        }
    }

    fn along(&self, length: f64) -> Vector {
        if self.is_wide { Vector::new(length, 0.0) } else { Vector::new(0.0, length) }
    }

    /// The size of the contents that is left beside the key.
    fn left(&self, contents: Vector, theme: &Theme) -> Vector {
        contents - self.along(self.needed + theme.note_size)
    }

    /// The rectangle of the key in contents at the origin.
    fn key(&self, contents: Vector, theme: &Theme) -> Rect {
        let before = self.along(self.whole - self.needed);
        Rect { corner: Point::origin() + before, size: contents - before }.inset(0.5 * theme.margin)
    }

    fn has_room(&self, contents: Vector, beside: Beside, theme: &Theme) -> bool {
        self.needed <= beside.most_of_key() * self.whole
            && beside.fits(self.left(contents, theme), self.is_small, theme)
    }
}

/// Whether a key leaves enough of the contents of a page to what is beside it.
pub(super) fn has_room(contents: Vector, beside: Beside, key: Option<&Key>, theme: &Theme) -> bool {
    Division::new(contents, beside, key, theme).has_room(contents, beside, theme)
}

/// Divides the contents of a page into the part for panels and that for the key: a column on the right of a wide page,
/// a strip at the foot of a high one.
pub(super) fn divide(contents: Rect, beside: Beside, key: &Key, theme: &Theme) -> (Rect, Rect) {
    let division = Division::new(contents.size, beside, Some(key), theme);
    let panels = Rect { size: division.left(contents.size, theme), ..contents };
    let key = division.key(contents.size, theme);
    (panels, Rect { corner: contents.corner + key.corner.coords, ..key })
}

/// The size of the contents that a usual key leaves, or all where it has no room.
pub(super) fn beside(contents: Vector, beside: Beside, theme: &Theme) -> Vector {
    match has_room(contents, beside, None, theme) {
        true => Division::new(contents, beside, None, theme).left(contents, theme),
        false => contents,
    }
}

/// The height of a strip with the lines of a key.
fn strip_height(width: f64, key: &Key, theme: &Theme) -> f64 {
    /// The least height, in ems.
    const LEAST: f64 = 15.0;
    let em = theme.note_size;
    let text = (1.0 - STRIP_DRAWING_PART) * width - em - theme.margin;
    let columns = (text / (COLUMN_WIDTH * em)).floor().max(1.0);
    let lines = lines_height(text, &[], key, theme) / columns + MORE_REMARKS as f64 * LEADING * em;
    theme.margin + lines.max(LEAST * em)
}

/// What is said on a page whose key is left out, as its panels leave no room to it in contents of this size.
pub(super) fn left_out_note(contents: Vector, beside: Beside, key: &Key, options: &Options) -> String {
    let own = options.paper;
    let taken = heading::contents_size(own, &options.theme.for_paper(own)) - contents;
    let is_enough = |paper: &Paper, beside: Beside| {
        let theme = &options.theme.for_paper(*paper);
        has_room(heading::contents_size(*paper, theme) - taken, beside, Some(key), theme)
    };
    let paper = own
        .larger()
        .find(|paper| is_enough(paper, beside))
        .map(|paper| format!("{} × {} mm", paper.width, paper.height));
    let paper = paper.map_or("larger paper".to_owned(), |size| format!("paper of {size}"));
    let fewer = if is_enough(&own, Beside { grid: [1, 1], ..beside }) { " or fewer figures" } else { "" };
    format!("the key is left out: it needs {paper}{fewer}")
}
