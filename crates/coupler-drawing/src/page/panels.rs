//! The `panels` layout: a grid of cells, each with its figure, number and caption.

use super::area::Area;
use super::arrangement::{Arrangement, Extents};
use super::balanced_grid::balanced_grid;
use super::element::Drawing;
use super::figure::{self, Figure};
use super::heading::{Heading, contents_size, margins};
use super::key::Key;
use super::key_division::{self, Beside};
use super::key_drawing;
use super::panel_texts::{self, PanelTexts};
use super::plot::is_reduced;
use super::rect::Rect;
use super::symbols::{self, Mark, Symbol};
use super::theme::Theme;
use super::{Options, PanelPage, PanelScale, Paper};
use crate::scene::{Anchor, Color, Group, Item};
use coupler_curves::geometry::{Point, Vector};
use coupler_curves::solve::SolvedCell;

/// Composes a page; the result is the greatest scale at which its linkages fit, in millimetres to a unit.
pub(super) fn compose(root: &impl Area, page: &PanelPage, options: &Options, theme: &Theme) -> f64 {
    let top = page.heading.draw(root, theme);
    let figures: Vec<Option<Figure>> = page.panels.iter().map(Figure::from_panel).collect();
    // All panels have the dashes of the one with the greatest range of the input.
    let period = figures.iter().flatten().map(|figure| figure.dash_period(options)).fold(0.0, f64::max);
    let mut symbols = page_symbols(page, &figures, period, theme);
    let contents = |symbols: &[Symbol]| contents(root.size(), &page.heading, (top, symbols), theme);
    let beside = beside_key(page.layout.grid());
    // Whether there is room for the key is decided for all pages of a family alike, whatever symbols they have.
    let usual = contents(&usual_symbols(page.key, theme)).size;
    let has_key = page.key.is_some_and(|key| {
        let usual = Rect { corner: Point::origin(), size: usual };
        // A specimen is to show a figure, and a key only if it is whole.
        let is_whole = || key_drawing::has_all_lines(key_division::divide(usual, beside, key, theme).1, key, theme);
        key_division::has_room(usual.size, beside, Some(key), theme) && (!options.is_specimen || is_whole())
    });
    if let (Some(key), false, false) = (page.key, has_key, symbols.is_empty() || options.is_specimen) {
        let meaning = key_division::left_out_note(usual, beside, key, options);
        symbols.push(Symbol { mark: Mark::Letter("…"), meaning });
    }
    let divided = |symbols: &[Symbol]| match page.key.filter(|_| has_key) {
        Some(key) => {
            let (panels, key) = key_division::divide(contents(symbols), beside, key, theme);
            (panels, Some(key))
        }
        None => (contents(symbols), None),
    };
    let area = |panels: Rect| {
        let far = panels.corner + panels.size;
        root.without_margins([panels.corner.y, root.size().y - far.y, panels.corner.x, root.size().x - far.x])
    };
    let panel_texts = |panels: Rect| {
        let [columns, rows] = page.layout.grid();
        PanelTexts::new(page, &figures, area(panels).grid_cells(rows, columns)[0].size(), theme)
    };
    let (mut panels, mut key) = divided(&symbols);
    let mut texts = panel_texts(panels);
    if let (Some(meaning), false) = (texts.form.meaning(&texts.varying), symbols.is_empty()) {
        symbols.push(Symbol { mark: Mark::Letter("…"), meaning });
        (panels, key) = divided(&symbols);
        texts = panel_texts(panels);
    }
    let (has_facts, has_notes) = (texts.has_facts, texts.has_notes);
    let drawn = draw_panels(&area(panels), page, &figures, period, texts);
    // Where the numbers are left out, the formulas are in the key.
    let note = page.key.filter(|_| has_key && !has_notes).and_then(|key| key.note.clone());
    let height = |symbols: &[Symbol]| contents(symbols).size.y;
    let before = height(&symbols);
    symbols.retain(|symbol| match symbol.meaning.as_str() {
        TRANSMISSION_ANGLE | LIMITS_OF_TRANSMISSION => has_facts,
        NOT_ENLARGED => drawn.has_enlarged,
        PLACES_BEYOND => drawn.has_places_beyond,
        NOTES_LEFT_OUT => !has_notes && note.is_none(),
        _ => true,
    });
    if let (Some(key), Some(rect)) = (page.key, key) {
        let figures: Vec<&Figure> = figures.iter().flatten().collect();
        let key = Key { note, ..key.clone() };
        // With fewer symbols than there could be, there is more room for its lines than for the panels.
        let more = match key_drawing::has_all_lines(rect, &key, theme) {
            true => 0.0,
            false => (height(&symbols) - before).max(0.0),
        };
        let rect = Rect { size: rect.size + Vector::new(0.0, more), ..rect };
        key_drawing::draw(root, rect, &key, &figures, theme);
    }
    let scale = symbols::scale_bar(drawn.common_scale(), common_crank(&figures), page.heading.unit);
    for (at, line) in layout_symbols(root.size(), &page.heading, &symbols, scale, theme).0 {
        symbols::draw(root, &line, at, theme);
    }
    drawn.fitting_scale
}

/// The contents of a page with these symbols at its foot, from `top` down.
fn contents(page: Vector, heading: &Heading, (top, symbols): (f64, &[Symbol]), theme: &Theme) -> Rect {
    // The scale is known after the panels are arranged; no statement of it is wider than this one.
    let scale = symbols::scale_bar(Some(1234.0), None, heading.unit);
    let above_foot = layout_symbols(page, heading, symbols, scale, theme).1;
    let [_, _, side] = margins(theme);
    Rect { corner: Point::new(side, top), size: Vector::new(page.x - 2.0 * side, (above_foot - top).max(0.1 * page.y)) }
}

/// The length of a crank that all linkages of a page have.
fn common_crank(figures: &[Option<Figure>]) -> Option<f64> {
    let cranks: Vec<f64> = figures.iter().flatten().filter_map(Figure::crank_length).collect();
    // Lengths that are computed in different ways may differ by rounding.
    let is_common = |first: &f64| cranks.iter().all(|crank| (crank - first).abs() <= 1e-9 * first);
    cranks.first().copied().filter(is_common)
}

/// The lines that explain the symbols of a page and the scale bars at its foot, with their positions; and the greatest y of the
/// contents.
fn layout_symbols(
    page: Vector,
    heading: &Heading,
    symbols: &[Symbol],
    scale: Symbol,
    theme: &Theme,
) -> (Vec<(Point, Vec<Symbol>)>, f64) {
    // A page without figures has no symbols.
    let explained: Vec<Symbol> = symbols.iter().cloned().chain((!symbols.is_empty()).then_some(scale)).collect();
    symbols::at_foot(page, heading, &explained, theme)
}

/// The symbols that pages of panels have as a rule, with the widest texts.
fn usual_symbols(key: Option<&Key>, theme: &Theme) -> Vec<Symbol> {
    let straight = key.map_or("", |key| &key.straight);
    let meanings = [
        (Mark::CrankPivot, "crank's pivot"),
        (Mark::Pivot, "fixed pivot"),
        (Mark::TracedPoint(theme.ink), "traced point"),
        (Mark::Dashes(theme.ink), "dash and gap: 5° of input"),
        (Mark::Start(theme.ink), "start and direction"),
        (Mark::Tick(theme.ink), "every 30° of input"),
        (Mark::Band(theme.ink), straight),
        (Mark::Letter("μ"), TRANSMISSION_ANGLE),
    ];
    meanings.map(|(mark, meaning)| Symbol { mark, meaning: meaning.to_owned() }).to_vec()
}

/// The symbols of all figures of a page, each once, and those of the texts under them.
fn page_symbols(page: &PanelPage, figures: &[Option<Figure>], period: f64, theme: &Theme) -> Vec<Symbol> {
    let mut symbols: Vec<Symbol> = Vec::new();
    for symbol in figures.iter().flatten().flat_map(|figure| figure.symbols(period, theme)) {
        if symbols.iter().all(|known| known.meaning != symbol.meaning) {
            symbols.push(symbol);
        }
    }
    if symbols.is_empty() {
        return symbols;
    }
    let mut add = |mark: Mark, meaning: &str| symbols.push(Symbol { mark, meaning: meaning.to_owned() });
    let has = |text: &str| page.panels.iter().flat_map(|panel| &panel.facts).any(|fact| fact.contains(text));
    let band = figures.iter().flatten().find_map(|figure| figure.band_ink(theme));
    if let (Some(key), Some(ink)) = (page.key, band) {
        add(Mark::Band(ink), &key.straight);
    }
    if let Some(ink) = figures.iter().flatten().map(|figure| figure.first_ink(theme)).next() {
        add(Mark::Light(ink), NOT_ENLARGED);
    }
    if has("μ") {
        add(Mark::Letter("μ"), if has("reaches") { LIMITS_OF_TRANSMISSION } else { TRANSMISSION_ANGLE });
    }
    if page.panels.iter().any(|panel| panel.body.places.iter().any(|places| !places.marks.is_empty())) {
        add(Mark::Letter("…"), PLACES_BEYOND);
    }
    if page.panels.iter().any(|panel| !panel.note.is_empty()) {
        add(Mark::Letter("…"), NOTES_LEFT_OUT);
    }
    symbols
}

/// What the symbol μ of the facts means.
const TRANSMISSION_ANGLE: &str = "transmission angle";

/// What it means where an angle at a limit is stated.
const LIMITS_OF_TRANSMISSION: &str = "transmission angle; at 0° and 180° coupler and output link are on one line";

/// What the light curve on a linkage means whose curve is drawn apart from it.
const NOT_ENLARGED: &str = "curve at the scale of the linkage";

/// What is said where places of a body are outside their frame.
const PLACES_BEYOND: &str = "places further away are left out";

/// What is said where the notes of panels are left out.
const NOTES_LEFT_OUT: &str = "notes that need larger panels are left out";

/// What was decided when the panels of a page were drawn.
struct DrawnPanels {
    /// The scale of the linkages in millimetres to a unit, if it is to be common to all.
    scale: Option<f64>,
    /// The greatest scale at which all linkages fit.
    fitting_scale: f64,
    /// Whether a curve is drawn apart from its linkage.
    has_enlarged: bool,
    /// Whether places of a body are outside their frame.
    has_places_beyond: bool,
}

impl DrawnPanels {
    /// The scale of the linkages in millimetres to a unit, if it is common to all.
    fn common_scale(&self) -> Option<f64> {
        self.scale.filter(|scale| !is_reduced(*scale, self.fitting_scale))
    }
}

/// Draws the panels.
fn draw_panels<A: Area>(
    root: &A,
    page: &PanelPage,
    figures: &[Option<Figure>],
    period: f64,
    texts: PanelTexts,
) -> DrawnPanels {
    let [columns, rows] = page.layout.grid();
    let areas = root.grid_cells(rows, columns);
    let PanelTexts { theme, foot, .. } = &texts;
    let foot = *foot;
    // One arrangement fits all panels: a page is split to within a hundredth of a millimetre.
    let figure_rect = |area: &A| {
        /// In panels that are narrower, in ems, the number is above the figure, where it would be on the linkage.
        const LEAST_BESIDE_NUMBER: f64 = 11.0;
        let gap = 1.2 * theme.caption_size;
        let is_narrow = area.size().x < LEAST_BESIDE_NUMBER * theme.note_size;
        let top = if is_narrow { 1.2 * theme.note_size } else { 0.0 };
        let size = area.size() - Vector::new(gap, top) - Vector::new(gap, foot);
        Rect { corner: Point::new(gap, top), size: size.sup(&Vector::new(1.0, 1.0)) }
    };
    let extents: Vec<Extents> = figures.iter().flatten().map(|figure| figure.extents.clone()).collect();
    let page_scale = page.scale.fixed();
    let arrangement = Arrangement::best(figure_rect(&areas[0]), page_scale, theme, &extents);
    let fit = |(figure, area): (&Figure, &A)| {
        let frame = figure_rect(area);
        figure.fitting_scale(frame, figure.arrangement(arrangement, frame, page_scale, [theme; 2]), theme)
    };
    let drawn = || figures.iter().zip(&areas).filter_map(|(figure, area)| Some((figure.as_ref()?, area)));
    let scale = match page.scale {
        PanelScale::Page => Some(drawn().map(fit).fold(f64::INFINITY, f64::min)),
        PanelScale::Panel | PanelScale::Fixed(_) => page_scale,
    };
    let crank_on_paper = |(figure, area): (&Figure, &A)| {
        let fitting = fit((figure, area));
        Some(figure.crank_length()? * scale.map_or(fitting, |scale| scale.min(fitting)))
    };
    // The smallest joints, of a third of the radius, would hide a shorter crank as well.
    let can_be_seen = |length: &f64| *length >= 0.75 * theme.joint_radius;
    // Joints have one size on a page, with which every crank is seen that can be.
    let shortest_crank = drawn().filter_map(crank_on_paper).filter(can_be_seen).fold(f64::INFINITY, f64::min);
    let figure_theme = &theme.for_crank_length(shortest_crank);
    // Ticks on an enlarged curve are as long as without such a crank.
    let curve_theme = &Theme { joint_radius: theme.joint_radius, ..figure_theme.clone() };
    let themes = [curve_theme, figure_theme];
    let mut has_places_beyond = false;
    let (mut has_enlarged, mut fitting_scale) = (false, f64::INFINITY);
    for (((panel, figure), area), lines) in page.panels.iter().zip(figures).zip(&areas).zip(&texts.lines) {
        let frame = figure_rect(area);
        let number = panel.solved_cell.cell.number;
        let group = Group {
            id: format!("{}-{number}", page.heading.family_id),
            ..Group::figure("panel", panel.description(page.heading.family_title, page.heading.dimensions))
        };
        area.grouped(group, || {
            match figure {
                Some(figure) => {
                    let arrangement = figure.arrangement(arrangement, frame, scale, themes);
                    has_enlarged |= arrangement != Arrangement::Combined;
                    let (fitting, is_beyond) = figure.draw(area, frame, (arrangement, scale, period), page, themes);
                    has_places_beyond |= is_beyond;
                    fitting_scale = fitting_scale.min(fitting);
                }
                None => draw_not_assembled(area, frame, panel.solved_cell, theme),
            }
            area.record(figure::number_line(panel.solved_cell, theme));
            panel_texts::draw_lines(area, lines, area.size().y - foot, theme);
        });
    }
    DrawnPanels { scale, fitting_scale, has_enlarged, has_places_beyond }
}

/// The least width and height of a panel, in ems of the smallest caption: four lines of text under a figure five lines high.
const LEAST_PANEL: [f64; 2] = [5.0, 10.5];

/// The same of a panel whose linkage can be read without a glass: a figure as high as eight lines of text, and as wide as a caption of one
/// line.
const LEGIBLE_PANEL: [f64; 2] = [16.0, 14.0];

/// The most columns and rows of panels on a page.
pub(super) fn max_grid(paper: Paper, theme: &Theme) -> [usize; 2] {
    max_in(contents_size(paper, theme), LEAST_PANEL, theme)
}

/// The most columns and rows of panels of a least size in contents of a size.
fn max_in(contents: Vector, least: [f64; 2], theme: &Theme) -> [usize; 2] {
    let em = theme.for_panel_size(Vector::zeros()).caption_size;
    [0, 1].map(|k| ((contents[k] / (least[k] * em)).floor() as usize).max(1))
}

/// Panels beside a key: on small paper large enough for a figure, and for four lines of text under it.
fn beside_key(grid: [usize; 2]) -> Beside {
    Beside { grid, least: [0.0, 0.0], least_on_small_paper: [8.0, 14.0] }
}

/// The columns and rows for `count` cells: some fifteen at most on a page, each about as wide as high with its caption, large enough to be read, and
/// so few that the key has room. A wide page has its key on the right.
pub(super) fn grid_for(paper: Paper, theme: &Theme, count: usize, heading: &Heading, key: &Key) -> [usize; 2] {
    const MOST: usize = 15;
    const ASPECT_RATIO: f64 = 1.0;
    let page = Vector::new(paper.width, paper.height);
    let (_, top) = heading.lines_under_title(page, theme);
    let whole = contents(page, heading, (top, &usual_symbols(Some(key), theme)), theme);
    let has_room = |grid: &[usize; 2]| key_division::has_room(whole.size, beside_key(*grid), Some(key), theme);
    let has_all_lines = |grid: &[usize; 2]| {
        let (_, rect) = key_division::divide(whole, beside_key(*grid), key, theme);
        has_room(grid) && key_drawing::has_all_lines(rect, key, theme)
    };
    let beside = match has_room(&[1, 1]) {
        true => key_division::beside(contents_size(paper, theme), beside_key([1, 1]), theme),
        false => whole.size,
    };
    let most_in = max_in(beside.inf(&whole.size), LEGIBLE_PANEL, theme);
    let grid = |most: usize| balanced_grid(beside, most_in, count.min(most), ASPECT_RATIO);
    let grids = || (1..=MOST).rev().map(grid);
    grids().find(has_all_lines).or_else(|| grids().find(has_room)).unwrap_or_else(|| grid(MOST))
}

/// Draws a message in place of a figure: the cell is not assembled, and the reason.
pub(super) fn draw_not_assembled(area: &impl Area, frame: Rect, cell: &SolvedCell, theme: &Theme) {
    let reason = cell.motion.assembly_error.as_ref().map_or("it has no curve".to_owned(), ToString::to_string);
    let centre = frame.centre();
    let text_line = |text: &str, size: f64, color: Color| {
        theme.text_line(text, Point::new(centre.x, 0.0), Anchor::Middle, size, color)
    };
    let mut lines = vec![text_line("not assembled", theme.caption_size, theme.text_ink(theme.curve_ink(0))).text];
    let reason = text_line(&reason, theme.note_size, theme.grey).wrap(0.9 * frame.size.x);
    lines.extend(reason.iter().map(|line| text_line(line, theme.note_size, theme.grey).text));
    let step = 1.5 * theme.note_size;
    // In a small panel the beginning of the reason, below the number of the cell.
    let top = frame.corner.y + theme.note_size + step;
    lines.truncate((((frame.corner.y + frame.size.y - top) / step).floor() as usize + 1).max(1));
    let first = (centre.y - step * (lines.len() - 1) as f64 / 2.0).max(top);
    for (k, text) in lines.iter_mut().enumerate() {
        text.position.y = first + step * k as f64;
    }
    let items = lines.into_iter().map(Item::Text).collect();
    area.record(Drawing { class: "not-assembled", title: String::new(), items });
}
