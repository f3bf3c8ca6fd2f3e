//! What a page is of, drawn where there is room for it.

use super::super::area::{Area, whole_page};
use super::super::element::Drawing;
use super::super::empty_scene::empty_scene;
use super::super::figure::Figure;
use super::super::heading::margins;
use super::super::panels::draw_not_assembled;
use super::super::rect::Rect;
use super::super::theme::Theme;
use super::super::{Options, Panel, PanelPage, PanelScale, Paper, usual_scale_below};
use super::assembly::Assembly;
use super::group::Group;
use super::packing;
use super::part_view::Views;
use super::sheet::{Fitting, Sheet};
use super::table::Table;
use super::title_block::TitleBlock;
use crate::scene::{Anchor, Group as SceneGroup};
use coupler_curves::geometry::{Point, Vector};
use coupler_curves::parts::{Parts, PartsError};

/// What a page is of.
pub(super) struct Contents<'a> {
    pub page: &'a PanelPage<'a>,
    pub panel: &'a Panel<'a>,
    pub options: &'a Options,
    /// `None` if the linkage is not assembled, as the parts.
    pub figure: Option<&'a Figure<'a>>,
    pub parts: Option<&'a Result<Parts, PartsError>>,
    /// None if there are no parts.
    pub groups: &'a [Group<'a>],
}

impl Contents<'_> {
    /// Draws the page, and returns the greatest scale at which the parts fit it.
    pub fn draw(&self, root: &impl Area, theme: &Theme) -> f64 {
        let rect = self.draw_heading(root, theme);
        let Some((sheet, fitting)) = self.sheet(rect, theme) else {
            let message = format!("this page is too small for the drawing, which needs {}", self.needed_paper());
            draw_message(root, rect, &message, theme);
            return f64::INFINITY;
        };
        let (mut stated, mut greatest) = (None, f64::INFINITY);
        match (self.figure, self.parts) {
            (Some(figure), Some(Ok(parts))) => {
                let views = self.views(parts, theme);
                if fitting.views {
                    let [scale, most] = scales(self.page, &views, sheet.views);
                    (stated, greatest) = (Some(scale), most);
                    let views = packing::layout(&views, scale, sheet.views).unwrap_or_default();
                    root.grouped(SceneGroup::figure("parts", self.description()), || {
                        for items in views {
                            root.record(Drawing { class: "part", title: String::new(), items });
                        }
                    });
                } else {
                    let paper = self.needed_paper();
                    let message = format!("the views of the parts do not fit this page: they need {paper}");
                    draw_message(root, sheet.views, &message, theme);
                    greatest = least_scale(&views);
                }
                self.assembly(figure).draw(root, sheet.assembly, theme);
                self.table(parts, &sheet, theme).draw(root, sheet.table);
            }
            (_, Some(Err(error))) => draw_message(root, sheet.views, &error.to_string(), theme),
            _ => draw_not_assembled(root, sheet.views, self.panel.solved_cell, theme),
        }
        self.title_block(sheet.is_title_short).draw(root, (sheet.title, stated), theme);
        greatest
    }

    /// The linkage, and the names of its parts, in words.
    fn description(&self) -> String {
        let heading = &self.page.heading;
        let names: Vec<&str> = self.groups.iter().flat_map(|group| group.names.iter().copied()).collect();
        let linkage = self.panel.description(heading.family_title, heading.dimensions);
        format!("Drawing of the parts {}. {linkage}", names.join(", "))
    }

    /// Draws the heading, and returns what it leaves.
    fn draw_heading(&self, root: &impl Area, theme: &Theme) -> Rect {
        let heading = &self.page.heading;
        let top = heading.draw(root, theme) + 0.5 * theme.margin;
        let [_, bottom, side] = margins(theme);
        let bottom = bottom + heading.folio_height(root.size(), theme);
        let size = Vector::new(root.size().x - 2.0 * side, root.size().y - bottom - top);
        Rect { corner: Point::new(side, top), size }
    }

    /// The sheet on which the most has room; `None` if there is not enough for a part of it.
    fn sheet(&self, contents: Rect, theme: &Theme) -> Option<(Sheet, Fitting)> {
        let title_height = |width: f64, is_short: bool| self.title_block(is_short).height(width, theme);
        let Some(Ok(parts)) = self.parts else {
            return Sheet::best(contents, self.everything(), title_height, |_| Some(self.everything()), theme);
        };
        // At the least scale at which they can be read.
        let views = self.views(parts, theme);
        let sizes = packing::sizes(&views.all(least_scale(&views)));
        let fitting = |sheet: &Sheet| {
            let rows = self.table(parts, sheet, theme).rows_in(sheet.table.size)?;
            Some(Fitting { views: packing::corners(&sizes, sheet.views, theme).is_some(), rows })
        };
        Sheet::best(contents, self.everything(), title_height, fitting, theme)
    }

    fn everything(&self) -> Fitting {
        let rows = match self.parts {
            Some(Ok(parts)) => Table::row_count(self.groups, parts),
            _ => 0,
        };
        Fitting { views: true, rows }
    }

    /// The least of some larger papers on which everything fits.
    fn needed_paper(&self) -> String {
        let fits = |paper: &Paper| {
            let options = self.options.clone().with_paper(*paper);
            let theme = options.theme.for_paper(*paper);
            let mut scene = empty_scene(self.page.heading.page_title(), &options, &theme);
            let contents = self.draw_heading(&whole_page(&mut scene), &theme);
            self.sheet(contents, &theme).is_some_and(|(_, fitting)| fitting == self.everything())
        };
        let papers: Vec<Paper> = self.options.paper.larger().collect();
        // What fits one fits all that are larger.
        let paper = papers.get(papers.partition_point(|paper| !fits(paper)));
        paper.map_or("larger paper".to_owned(), |Paper { width, height }| {
            format!("paper of {width}\u{a0}×\u{a0}{height}\u{a0}mm")
        })
    }

    fn views<'v>(&'v self, parts: &Parts, theme: &'v Theme) -> Views<'v> {
        Views { groups: self.groups, sizes: parts.sizes, unit: self.page.heading.unit, theme }
    }

    fn assembly<'v>(&'v self, figure: &'v Figure<'v>) -> Assembly<'v> {
        Assembly { figure, key: self.page.key }
    }

    fn table<'v>(&self, parts: &Parts, sheet: &Sheet, theme: &'v Theme) -> Table<'v> {
        let names = self.figure.and_then(|figure| self.assembly(figure).numbered_names(sheet.assembly.size.x, theme));
        Table::new(self.groups, parts, theme).with_note(names)
    }

    fn title_block(&self, is_short: bool) -> TitleBlock<'_> {
        TitleBlock {
            page: self.page,
            number: self.panel.solved_cell.cell.number,
            parameters: &self.panel.caption,
            paper: self.options.sheet(),
            is_short,
        }
    }
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

/// The scale of the views, and the greatest at which they fit: the greatest usual one, or that of the page if they fit at it.
fn scales(page: &PanelPage, views: &Views, rect: Rect) -> [f64; 2] {
    let fits = |scale: f64| packing::layout(views, scale, rect).is_some();
    let greatest = packing::greatest(2.0 * rect.size.max() / views.extent(), fits);
    let scale = match page.scale {
        PanelScale::Fixed(scale) => scale.min(greatest),
        PanelScale::Panel | PanelScale::Page => usual_scale_below(greatest, page.heading.unit),
    };
    // Views that are smaller may be in rows of another height.
    [if fits(scale) { scale } else { greatest }, greatest]
}

/// The least scale at which views can be read: at which the longest part is as long as a short word.
fn least_scale(views: &Views) -> f64 {
    /// In ems of a note.
    const LEAST: f64 = 6.0;
    LEAST * views.theme.note_size / views.extent()
}
