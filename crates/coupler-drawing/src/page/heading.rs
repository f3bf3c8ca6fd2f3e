//! The frame of every page: border, title, source line and folio.

use super::Paper;
use super::area::Area;
use super::element::TextLine;
use super::theme::Theme;
use crate::scene::group_class::{FOLIO, TITLE};
use crate::scene::{Anchor, Group};
use coupler_curves::expression::MathText;
use coupler_curves::family::LengthUnit;
use coupler_curves::geometry::{Point, Vector};

/// The texts around the contents of a page: title, source line and folio.
///
/// [`Heading::new`] needs the title only; everything else is optional.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Heading<'a> {
    /// The title of the page, which is the family's.
    pub family_title: &'a str,
    /// The prefix of the ids of the page's groups, which is the family's id.
    pub family_id: &'a str,
    /// The atlas's title, written before the folio; may be empty.
    pub atlas_title: &'a str,
    /// The line under the title: where the linkage comes from and what its letters mean; may be empty.
    pub source: String,
    /// The dimensions that all linkages of the page share, printed once under the source line.
    pub dimensions: &'a [MathText],
    /// The names of parameters, set in italics.
    pub symbols: &'a [String],
    /// The unit of the lengths; `None` if they are in a unit of their own.
    pub unit: Option<LengthUnit>,
    /// The page's number in the family, from 1.
    pub page: usize,
    /// The number of pages of the family.
    pub page_count: usize,
}

impl<'a> Heading<'a> {
    /// The heading of a single page with a title; ids begin with `page`, and the other texts are empty.
    pub fn new(title: &'a str) -> Heading<'a> {
        Heading {
            family_title: title,
            family_id: "page",
            atlas_title: "",
            source: String::new(),
            dimensions: &[],
            symbols: &[],
            unit: None,
            page: 1,
            page_count: 1,
        }
    }

    /// The heading with another prefix for the ids of the page's groups.
    pub fn with_family_id(self, family_id: &'a str) -> Heading<'a> {
        Heading { family_id, ..self }
    }

    /// The heading with the title of an atlas.
    pub fn with_atlas_title(self, atlas_title: &'a str) -> Heading<'a> {
        Heading { atlas_title, ..self }
    }

    /// The heading with a line under its title.
    pub fn with_source(self, source: impl Into<String>) -> Heading<'a> {
        Heading { source: source.into(), ..self }
    }

    /// The heading with dimensions under its source line.
    pub fn with_dimensions(self, dimensions: &'a [MathText]) -> Heading<'a> {
        Heading { dimensions, ..self }
    }

    /// The heading with the names of parameters, which are set in italics.
    pub fn with_symbols(self, symbols: &'a [String]) -> Heading<'a> {
        Heading { symbols, ..self }
    }

    /// The heading of a page whose lengths have a unit.
    pub fn with_unit(self, unit: Option<LengthUnit>) -> Heading<'a> {
        Heading { unit, ..self }
    }

    /// The heading of a page by its number, from 1, and the number of pages.
    pub fn with_page(self, page: usize, page_count: usize) -> Heading<'a> {
        Heading { page, page_count, ..self }
    }

    /// The attribute that says the unit in a drawing, if there is one.
    pub(super) fn unit_data(&self) -> Option<(&'static str, String)> {
        self.unit.map(|unit| ("unit", unit.symbol().to_owned()))
    }

    /// The title of the document the page is written to.
    pub(super) fn page_title(&self) -> String {
        let page = format!("{}{}", self.family_title, self.page_number(", "));
        if self.atlas_title.is_empty() { page } else { format!("{page}: {}", self.atlas_title) }
    }

    /// The title of the atlas and that of the family, as far as they are not empty.
    pub(super) fn titles(&self) -> String {
        let titles = [self.atlas_title, self.family_title];
        titles.into_iter().filter(|title| !title.is_empty()).collect::<Vec<_>>().join(" · ")
    }

    /// Draws border, title, source lines, dimensions and folio; the result is the least y of the contents.
    pub(super) fn draw(&self, root: &impl Area, theme: &Theme) -> f64 {
        draw_border(root, theme);
        let page = root.size();
        draw_title(root, self.family_title, theme);
        let (lines, top) = self.lines_under_title(page, theme);
        lines.into_iter().for_each(|line| root.record(line));
        let foot = page.x - theme.border - theme.margin;
        let mut foot = Point::new(foot, foot_baseline(page, theme) - self.folio_height(page, theme));
        root.grouped(Group::of_class(FOLIO), || {
            for line in self.folio_lines(self.atlas_title, page, theme) {
                root.record(line.moved_to(foot));
                foot.y += SOURCE_LEADING * theme.source_size;
            }
        });
        top
    }

    /// The source lines and the dimensions, and the least y of the contents below them.
    pub(super) fn lines_under_title(&self, page: Vector, theme: &Theme) -> (Vec<TextLine>, f64) {
        let mut at = placed_title(self.family_title, page, theme).1;
        let width = page.x - 2.0 * at.x;
        let source_line =
            |text: &str| theme.text_line(text, Point::origin(), Anchor::Start, theme.source_size, theme.grey);
        // A source too long for one line is broken at separators.
        let source = source_line(&self.source).wrap_at_separators(width);
        let source = source.iter().map(|line| source_line(line).with_italics(self.symbols));
        let dimension_line =
            |text: &MathText| theme.math_line(text, Point::origin(), Anchor::Start, theme.source_size, theme.ink);
        let fits = |text: &MathText| dimension_line(text).text.width() <= width;
        let dimensions = MathText::join(self.dimensions.iter().cloned(), ", ").wrap(fits);
        let mut lines = Vec::new();
        for line in source.chain(dimensions.iter().map(dimension_line)) {
            lines.push(line.moved_to(at).fit_width(width));
            at.y += SOURCE_LEADING * theme.source_size;
        }
        // Two thirds of the last line's leading are above the contents.
        (lines, (at.y - 0.6 * theme.source_size).max(margins(theme)[0]))
    }

    /// The lines at the foot of a page on the right: `titles`, such as that of the atlas, and the page number.
    pub(super) fn folio_lines(&self, titles: &str, page: Vector, theme: &Theme) -> Vec<TextLine> {
        /// The end of a longer title is left out.
        const MOST: usize = 3;
        let width = MAX_FOLIO_PART * (page.x - 2.0 * (theme.border + theme.margin));
        let line = |text: &str| theme.text_line(text, Point::origin(), Anchor::End, theme.source_size, theme.grey);
        let folio = self.folio();
        let folio = if titles.is_empty() { folio.trim_start_matches(SEPARATOR) } else { &folio };
        if titles.is_empty() && folio.is_empty() {
            return Vec::new();
        }
        let whole = line(&format!("{titles}{folio}"));
        if TextLine::min_part(theme.source_size) * whole.text.width() <= width {
            return vec![whole.fit_width(width)];
        }
        let words = line(titles).wrap(width);
        let [first, rest] = [&words[..words.len().min(MOST - 1)], words.get(MOST - 1..).unwrap_or_default()];
        let last = if rest.is_empty() { folio.trim_start_matches(SEPARATOR).to_owned() } else { rest.join(" ") };
        let suffix = if rest.is_empty() { "" } else { folio };
        let last = line(&last).fit_width_with_suffix(suffix, width);
        let lines = first.iter().map(|text| line(text).fit_width(width)).chain([last]);
        lines.filter(|line| line.text.width() > 0.0).collect()
    }

    /// The width of the lines at the foot of a page on the right.
    pub(super) fn folio_width(&self, page: Vector, theme: &Theme) -> f64 {
        self.folio_lines(self.atlas_title, page, theme).iter().map(|line| line.text.width()).fold(0.0, f64::max)
    }

    /// The height of these lines above the last.
    pub(super) fn folio_height(&self, page: Vector, theme: &Theme) -> f64 {
        SOURCE_LEADING
            * theme.source_size
            * self.folio_lines(self.atlas_title, page, theme).len().saturating_sub(1) as f64
    }

    /// The page number, which ends the last line of the page, with a separator before it; empty if there is one page.
    pub(super) fn folio(&self) -> String {
        self.page_number(SEPARATOR)
    }

    /// The page number with a separator before it; empty if there is one page.
    fn page_number(&self, separator: &str) -> String {
        match self.page_count {
            1 => String::new(),
            count => format!("{separator}page {} of {count}", self.page),
        }
    }
}

/// The part of the width of a page that its title and number may take at the foot; the symbols are left of them.
const MAX_FOLIO_PART: f64 = 0.5;

/// Separates the parts of a line.
const SEPARATOR: &str = " · ";

/// The distance of the lines under the title, in ems.
pub(super) const SOURCE_LEADING: f64 = 1.35;

/// The baseline of the last line of a page.
pub(super) fn foot_baseline(page: Vector, theme: &Theme) -> f64 {
    page.y - theme.border - 0.6 * theme.margin
}

/// Draws the border of a page.
pub(super) fn draw_border(root: &impl Area, theme: &Theme) {
    let page = root.size();
    let corners = [Point::new(theme.border, theme.border), Point::new(page.x - theme.border, page.y - theme.border)];
    root.record_rectangle(corners, theme.stroke(theme.ink, theme.fine_width));
}

/// The distance of the lines of a title, in their size.
const TITLE_LEADING: f64 = 1.2;

/// The lines of a title on paper of a width.
fn title_lines(title: &str, paper_width: f64, theme: &Theme) -> Vec<TextLine> {
    let width = paper_width - 2.0 * (theme.border + theme.margin);
    theme.text_line(title, Point::origin(), Anchor::Start, theme.title_size, theme.ink).fit_or_wrap(width)
}

/// Draws the title of a page, in as many lines as it needs; the position at which the line under it starts.
pub(super) fn draw_title(root: &impl Area, title: &str, theme: &Theme) -> Point {
    let (lines, below) = placed_title(title, root.size(), theme);
    root.grouped(Group::of_class(TITLE), || lines.into_iter().for_each(|line| root.record(line)));
    below
}

/// The lines of the title of a page, and the position at which the line under it starts.
fn placed_title(title: &str, page: Vector, theme: &Theme) -> (Vec<TextLine>, Point) {
    let mut at = Point::new(theme.border + theme.margin, theme.border + 1.9 * theme.title_size);
    let mut lines = Vec::new();
    for line in title_lines(title, page.x, theme) {
        let size = line.text.size;
        lines.push(line.moved_to(at));
        at.y += TITLE_LEADING * size;
    }
    (lines, Point::new(at.x, at.y - TITLE_LEADING * theme.title_size + 1.85 * theme.source_size))
}

/// The least y of the contents of a page with a title and so many lines under it.
pub(super) fn contents_top(title: &str, line_count: usize, paper: Paper, theme: &Theme) -> f64 {
    let title: f64 = title_lines(title, paper.width, theme).iter().map(|line| TITLE_LEADING * line.text.size).sum();
    let below = SOURCE_LEADING * theme.source_size * line_count.saturating_sub(1) as f64;
    margins(theme)[0] + (title - TITLE_LEADING * theme.title_size).max(0.0) + below
}

/// The size of the contents of a page, in millimetres.
pub(super) fn contents_size(paper: Paper, theme: &Theme) -> Vector {
    let [top, bottom, _] = margins(theme);
    Vector::new(paper.width - 2.0 * (theme.border + theme.margin), paper.height - top - bottom)
}

/// The margins above, below and on both sides of the contents, in millimetres.
pub(super) fn margins(theme: &Theme) -> [f64; 3] {
    let top = theme.border + 2.3 * theme.title_size + 3.2 * theme.source_size;
    let bottom = theme.border + theme.margin + theme.source_size;
    [top, bottom, theme.border + theme.margin]
}
