//! The texts under the figures of a page of panels: what is said of each cell, as far as there is room.

use super::PanelPage;
use super::area::Area;
use super::caption_form::CaptionForm;
use super::element::TextLine;
use super::figure::Figure;
use super::panel::Panel;
use super::theme::Theme;
use crate::scene::{Anchor, Color};
use coupler_curves::geometry::{Point, Vector};

/// The texts under the figures of a page.
pub(super) struct PanelTexts {
    /// The theme of panels, with the size of captions.
    pub theme: Theme,
    /// The lines of each panel.
    pub lines: Vec<Vec<TextLine>>,
    /// The height under the figures.
    pub foot: f64,
    /// How much the captions say, and what varies in one of them.
    pub form: CaptionForm,
    pub varying: Vec<String>,
    /// Whether the facts of the cells are there, and their notes.
    pub has_facts: bool,
    pub has_notes: bool,
}

impl PanelTexts {
    /// The texts in panels of a size. Facts, then notes, then the derived values in captions, and then the names in them, that leave too little to the
    /// figures are left out: captions say how the linkages are built, the facts are in the table of cells, and the key has the formulas of notes.
    pub fn new(page: &PanelPage, figures: &[Option<Figure>], size: Vector, theme: &Theme) -> PanelTexts {
        /// The part of a panel that is left to its figure, however long its text is.
        const MIN_FIGURE: f64 = 0.4;
        let theme = &theme.for_panel_size(size);
        let width = size.x - 1.2 * theme.caption_size;
        let most_text = (1.0 - MIN_FIGURE) * size.y;
        let facts = FactsLayout::for_page(page, figures, width, theme);
        let texts = |form: CaptionForm, facts: FactsLayout, has_notes: bool| {
            let said = |(panel, figure): (&Panel, &Option<Figure>)| {
                let pose = figure.as_ref().and_then(Figure::pose_input);
                Said::of_panel(panel, form, (facts, pose, has_notes))
            };
            let said: Vec<Said> = page.panels.iter().zip(figures).map(said).collect();
            let captions = said.iter().map(|said| said.caption.as_str());
            let caption_size = equal_size(captions, theme.caption_size, width, theme);
            let notes = said.iter().flat_map(|said| said.notes.iter().chain(&said.error)).map(String::as_str);
            let note_size = equal_size(notes, theme.note_size, width, theme);
            let lines = |said: &Said| said.lines([caption_size, note_size], width, page.heading.symbols, theme);
            let lines: Vec<Vec<TextLine>> = said.iter().map(lines).collect();
            let theme = Theme { caption_size, ..theme.clone() };
            let height = |lines: &Vec<TextLine>| lines.iter().map(leading).sum::<f64>();
            let foot = lines.iter().map(height).fold(0.0, f64::max) + 2.2 * theme.caption_size;
            let has_facts = facts != FactsLayout::None;
            let varying = page.panels.iter().map(|panel| &panel.varying).find(|varying| !varying.is_empty());
            let varying = varying.cloned().unwrap_or_default();
            PanelTexts { theme, lines, foot, form, varying, has_facts, has_notes }
        };
        let [whole, varying, values] = CaptionForm::ALL;
        let none = FactsLayout::None;
        let choices = [(whole, facts, true), (whole, none, true), (whole, none, false), (varying, none, false)];
        let choices = choices.into_iter().map(|(form, facts, has_notes)| texts(form, facts, has_notes));
        let fitting = choices.into_iter().find(|texts| texts.foot <= most_text);
        let texts = fitting.unwrap_or_else(|| texts(values, none, false));
        PanelTexts { foot: texts.foot.min(most_text), ..texts }
    }
}

/// The size of some texts of a page, all in one: that at which each is on one line, or if one is much too wide for that, the least size
/// before lines are broken, at which it takes the fewest lines.
fn equal_size<'a>(texts: impl Iterator<Item = &'a str>, size: f64, width: f64, theme: &Theme) -> f64 {
    let natural = |text| theme.text_line(text, Point::origin(), Anchor::Middle, size, theme.ink).text.width();
    let part = texts.map(|text| width / natural(text)).fold(1.0, f64::min);
    size * part.max(TextLine::min_part(size))
}

/// The distance from a line of text to the next.
fn leading(line: &TextLine) -> f64 {
    1.45 * line.text.size
}

/// What is said under a figure.
struct Said {
    caption: String,
    /// The note, and the facts.
    notes: Vec<String>,
    /// Why the linkage cannot move through the whole range.
    error: Option<String>,
}

impl Said {
    fn of_panel(
        panel: &Panel,
        form: CaptionForm,
        (facts, pose, has_note): (FactsLayout, Option<String>, bool),
    ) -> Said {
        let note = if has_note { panel.note.clone() } else { String::new() };
        let motion = &panel.solved_cell.motion;
        Said {
            caption: form.text(&panel.caption, &panel.varying),
            notes: std::iter::once(note).chain(facts.panel_lines(panel, pose)).collect(),
            error: motion.assembly_error.as_ref().filter(|_| motion.is_assembled()).map(ToString::to_string),
        }
    }

    /// Its lines, with the caption and the others in sizes that are those of the page: a text that is wider is broken.
    fn lines(&self, [caption, note]: [f64; 2], width: f64, symbols: &[String], theme: &Theme) -> Vec<TextLine> {
        let lines = |text: &str, size: f64, color: Color, symbols: &[String]| -> Vec<TextLine> {
            let line = |words: &str| theme.text_line(words, Point::origin(), Anchor::Middle, size, color);
            let wrapped = match line(text) {
                // The size may have been computed from this very text.
                whole if whole.text.width() <= width * (1.0 + 1e-9) => vec![text.to_owned()],
                whole => whole.wrap_at_separators(width),
            };
            let lines = wrapped.iter().map(|words| line(words).fit_width(width)).filter(|line| line.text.width() > 0.0);
            lines.map(|line| line.with_italics(symbols)).collect()
        };
        let [first, others] = [&self.notes[..1], &self.notes[1..]];
        let error = self.error.iter().flat_map(|error| lines(error, note, theme.text_ink(theme.curve_ink(0)), &[]));
        let caption = lines(&self.caption, caption, theme.ink, symbols).into_iter();
        let caption = caption.chain(first.iter().flat_map(|text| lines(text, note, theme.grey, symbols)));
        caption.chain(others.iter().flat_map(|text| lines(text, note, theme.grey, &[]))).chain(error).collect()
    }
}

/// The number of lines for the facts of a cell, the same for all cells of a page.
#[derive(Clone, Copy, PartialEq, Eq)]
enum FactsLayout {
    None,
    OneLine,
    TwoLines,
}

impl FactsLayout {
    /// One line if the facts of every panel fit `width` at no less than [`TextLine::min_part`] of their size; otherwise two.
    fn for_page(page: &PanelPage, figures: &[Option<Figure>], width: f64, theme: &Theme) -> FactsLayout {
        let pose = |figure: &Option<Figure>| figure.as_ref().and_then(Figure::pose_input);
        let panels = page.panels.iter().zip(figures);
        let texts = panels.flat_map(|(panel, figure)| FactsLayout::OneLine.panel_lines(panel, pose(figure)));
        let natural = |text: String| {
            theme.text_line(&text, Point::origin(), Anchor::Middle, theme.note_size, theme.grey).text.width()
        };
        match texts.map(natural).fold(0.0, f64::max) {
            0.0 => FactsLayout::None,
            widest if TextLine::min_part(theme.note_size) * widest <= width => FactsLayout::OneLine,
            _ => FactsLayout::TwoLines,
        }
    }

    /// The lines of facts under a panel, of which the last also says in which pose its linkage is.
    fn panel_lines(self, panel: &Panel, pose: Option<String>) -> Vec<String> {
        let [class, straight] = panel.facts.clone();
        let pose = pose.map(|input| format!("drawn at {input}"));
        let last: Vec<String> = [straight].into_iter().filter(|part| !part.is_empty()).chain(pose).collect();
        let parts = [class, last.join(" · ")].into_iter().filter(|part| !part.is_empty());
        match self {
            FactsLayout::None => Vec::new(),
            FactsLayout::OneLine => vec![parts.collect::<Vec<_>>().join(" · ")],
            FactsLayout::TwoLines => parts.collect(),
        }
    }
}

/// Draws the lines under a figure from `top`, as many as fit; the last of these says by its end that others do not.
pub(super) fn draw_lines(area: &impl Area, lines: &[TextLine], top: f64, theme: &Theme) {
    let first = top + 1.5 * theme.caption_size;
    let steps = lines.windows(2).map(|pair| leading(&pair[0]).max(leading(&pair[1])));
    let heights = std::iter::once(first).chain(steps.scan(first, |y, step| {
        *y += step;
        Some(*y)
    }));
    let fitting: Vec<(&TextLine, f64)> = lines.iter().zip(heights).take_while(|(_, y)| *y <= area.size().y).collect();
    for (k, (line, y)) in fitting.iter().enumerate() {
        let line = (*line).clone().moved_to(Point::new(area.size().x / 2.0, *y));
        let is_cut = k + 1 == fitting.len() && fitting.len() < lines.len();
        area.record(if is_cut { line.fit_width_with_suffix(" …", area.size().x) } else { line });
    }
}
