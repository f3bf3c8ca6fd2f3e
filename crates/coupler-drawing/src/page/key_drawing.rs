//! The drawing of a key: its lines in a column or a strip, and a linkage with the names of its joints.

use super::area::Area;
use super::direction::DirectionMarks;
use super::element::{Drawing, TextLine};
use super::figure::Figure;
use super::key::{Key, PinMarks};
use super::labels::{LabelPlacer, Obstacles};
use super::mechanism::PosedMechanism;
use super::plot::Plot;
use super::pose;
use super::rect::Rect;
use super::theme::Theme;
use crate::mechanism::Mechanism;
use crate::scene::{Anchor, Circle, Color, Group, Item, MIN_TEXT_SIZE, Text};
use coupler_curves::expression::{MathText, displayed_name};
use coupler_curves::geometry::{Bounds, Point, Vector};
use coupler_curves::linkage::{JointId, JointKind, Linkage};
use coupler_curves::motion::{Circuit, Motion, Sampler, Sampling};

/// The width of a line of text of the key, in ems of a note.
pub(super) const COLUMN_WIDTH: f64 = 24.0;

/// The distance from a line of the key to the next, in ems.
pub(super) const LEADING: f64 = 1.42;

/// The part of the width of a strip that its drawing takes, at most.
pub(super) const STRIP_DRAWING_PART: f64 = 0.4;

/// The greatest width of a name at a joint, as a part of the drawing.
const MAX_NAME_PART: f64 = 0.3;

/// The figure whose linkage a key shows: the first of those with the most joints, as a joint at an offset of 0 is not drawn, in which no
/// two are close together, or else the one of them in which they are furthest apart.
fn clearest_figure<'f, 'a>(figures: &[&'f Figure<'a>]) -> Option<&'f Figure<'a>> {
    /// The least distance of joints, relative to the size of the linkage: some three of their radii in a key.
    const CLEAR: f64 = 0.06;
    let mechanism = |figure: &'f Figure<'a>| figure.mechanisms.first();
    let count = |figure: &'f Figure<'a>| mechanism(figure).map_or(0, |mechanism| mechanism.drawn_joints().len());
    let most = figures.iter().copied().map(count).max()?;
    let distance = |figure: &'f Figure<'a>| {
        mechanism(figure).map_or(0.0, |mechanism| least_distance(mechanism, figure.first_circuit())).min(CLEAR)
    };
    let with_most = figures.iter().copied().filter(|figure| count(figure) == most);
    with_most.reduce(|best, next| if distance(next) > distance(best) { next } else { best })
}

/// The least distance of two joints of a linkage that have names in its key, relative to its size.
fn least_distance(mechanism: &PosedMechanism, circuit: &Circuit) -> f64 {
    let joints: Vec<JointId> = pins(mechanism, circuit).into_iter().map(|pin| pin[0]).collect();
    let pairs = joints.iter().enumerate().flat_map(|(k, a)| joints[..k].iter().map(move |b| (a, b)));
    let distances = pairs.map(|(a, b)| (mechanism.pose[*a] - mechanism.pose[*b]).norm());
    distances.fold(f64::INFINITY, f64::min) / mechanism.bounds().size().max()
}

/// Draws a key in a rectangle, with the linkage of the clearest of some figures.
pub(super) fn draw(area: &impl Area, rect: Rect, key: &Key, figures: &[&Figure], theme: &Theme) {
    let (drawing, text) = drawing_and_text(rect, key, theme);
    let mut key = key.clone().with_common_pins(&common_pins(figures));
    if needs_marks(&key, drawing.x, theme) {
        key.marks = PinMarks::Numbers;
    }
    if let Some((figure, mechanism)) =
        clearest_figure(figures).and_then(|figure| Some((figure, figure.mechanisms.first()?)))
    {
        let name = |joint: JointId| displayed_name(&mechanism.linkage.joints[joint].name);
        let [_, far] = helpers(mechanism);
        key.beyond = far.into_iter().map(name).collect();
        let drawing = Rect { corner: rect.corner, size: drawing };
        let ink = |joint| figure.joint_ink(joint, theme);
        match with_longer_crank(mechanism) {
            Some((linkage, circuit)) => {
                let pose = pose::clearest_pose(&linkage, &circuit);
                let mechanism = PosedMechanism::new(&linkage, Mechanism::new(&linkage, &circuit), pose);
                draw_linkage(area, drawing, (&mechanism, &key), &circuit, ink, theme);
                key.remarks.push("shown here with a longer crank, as its own is hidden by its joints".to_owned());
            }
            None => {
                draw_linkage(area, drawing, (mechanism, &key), figure.first_circuit(), ink, theme);
                key.remarks.extend(figure.pose_input().map(|input| format!("shown here at {input} of input")));
            }
        }
    }
    let changes_sides = |figure: &&Figure| {
        let passes = &figure.first_circuit().passes;
        passes.iter().any(|pass| pass.mode != passes[0].mode)
    };
    if figures.iter().any(changes_sides) {
        key.remarks
            .push("sides are those shown here; a joint changes its side where it passes a dead point".to_owned());
    }
    draw_lines(area, text, &[], &key, theme);
}

/// The size of the drawing at the upper left of a key, and the rectangle of its lines.
fn drawing_and_text(rect: Rect, key: &Key, theme: &Theme) -> (Vector, Rect) {
    /// The least part of its usual height that a drawing over many lines has.
    const LEAST: f64 = 0.6;
    let em = theme.note_size;
    let is_column = rect.size.x < 1.4 * rect.size.y;
    let drawing = match is_column {
        true => {
            let smallest = MIN_TEXT_SIZE.min(em);
            let lines = KeyLines::new(rect, &[], key, smallest, theme);
            let rows = (lines.rows.len() + MORE_REMARKS).div_ceil(lines.columns);
            let left = rect.size.y - em - LEADING * smallest * rows as f64;
            let usual = (0.9 * rect.size.x).min(0.42 * rect.size.y);
            Vector::new(rect.size.x, usual.min(left.max(LEAST * usual)))
        }
        false => Vector::new((1.2 * rect.size.y).min(STRIP_DRAWING_PART * rect.size.x), rect.size.y),
    };
    let before = match is_column {
        true => Vector::new(0.0, drawing.y + em),
        false => Vector::new(drawing.x + em, 0.0),
    };
    (drawing, Rect { corner: rect.corner + before, size: rect.size - before })
}

/// Whether all lines of a key fit a rectangle at their smallest size, with some remarks on its drawing.
pub(super) fn has_all_lines(rect: Rect, key: &Key, theme: &Theme) -> bool {
    let (_, text) = drawing_and_text(rect, key, theme);
    let lines = KeyLines::new(text, &[], key, MIN_TEXT_SIZE.min(theme.note_size), theme);
    lines.rows.len() + MORE_REMARKS <= lines.capacity()
}

/// The lines of the remarks on the drawing that are added to those of a key.
pub(super) const MORE_REMARKS: usize = 3;

/// Whether a drawing of a width has marks of the joints in place of names, as one is too long for it.
pub(super) fn needs_marks(key: &Key, width: f64, theme: &Theme) -> bool {
    let name_width =
        |name: &str| theme.text_line(name, Point::origin(), Anchor::Middle, theme.caption_size, theme.ink).text.width();
    key.joints.iter().any(|(name, _)| name_width(name) > MAX_NAME_PART * width)
}

/// The linkage with a longer crank, sampled, if its own is so short that its joints hide it.
fn with_longer_crank(mechanism: &PosedMechanism) -> Option<(Linkage, Circuit)> {
    /// The length up to which a crank is hidden, and that with which it is shown, relative to the size of the linkage.
    const LENGTHS: [f64; 2] = [0.02, 0.12];
    /// Enough to choose a clear pose.
    const SAMPLES: usize = 120;
    let size = mechanism.bounds().size().max();
    let mut linkage = mechanism.linkage.clone();
    let [_, pin] = linkage.crank()?;
    match &mut linkage.joints[pin].kind {
        JointKind::Crank { length, .. } if *length <= LENGTHS[0] * size => *length = LENGTHS[1] * size,
        _ => return None,
    }
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(SAMPLES)));
    let circuit = motion.circuits.into_iter().next()?;
    Some((linkage, circuit))
}

/// Writes dimensions, the joints of a key and its remarks in columns, from the upper left. Where they are too many, the text
/// is smaller, and at last the number of lines that are left out is stated.
pub(super) fn draw_lines(area: &impl Area, rect: Rect, dimensions: &[MathText], key: &Key, theme: &Theme) {
    let smallest = MIN_TEXT_SIZE.min(theme.note_size);
    let sizes = [1.0, 0.9, 0.8, 0.7, 0.0].map(|part| (part * theme.note_size).max(smallest));
    let lines = |em: f64| KeyLines::new(rect, dimensions, key, em, theme);
    let fitting = sizes.into_iter().map(lines).find(|lines| lines.rows.len() <= lines.capacity());
    fitting.unwrap_or_else(|| lines(smallest)).draw(area, rect, theme);
}

/// The height of the lines of a key in a column of a width, at their full size.
pub(super) fn lines_height(width: f64, dimensions: &[MathText], key: &Key, theme: &Theme) -> f64 {
    let em = theme.note_size;
    let column = Rect { corner: Point::origin(), size: Vector::new(width, em) };
    LEADING * em * (KeyLines::new(column, dimensions, key, em, theme).rows.len() as f64 + 1.0)
}

/// The lines of a key at a size of text.
struct KeyLines {
    em: f64,
    columns: usize,
    per_column: usize,
    /// The width of a column without the space after it.
    width: f64,
    /// The name of the joint that begins here, the text, and its indent.
    rows: Vec<(Option<TextLine>, TextLine, f64)>,
    /// The place of the first remark among the rows.
    first_remark: usize,
}

impl KeyLines {
    fn new(rect: Rect, dimensions: &[MathText], key: &Key, em: f64, theme: &Theme) -> KeyLines {
        let columns = (rect.size.x / (COLUMN_WIDTH * em)).floor().max(1.0);
        let width = rect.size.x / columns - em;
        let line = |text: &MathText, color| theme.math_line(text, Point::origin(), Anchor::Start, em, color);
        let name = |(k, (name, _)): (usize, &(String, MathText))| {
            let words = key.mark(k).map_or(name.clone(), |mark| format!("{mark} {name}"));
            line(&MathText::from_words(words), theme.ink)
        };
        let names: Vec<TextLine> = key.joints.iter().enumerate().map(name).collect();
        // The text is beside the names, or below them where they would leave too little to it.
        let widest = names.iter().map(|name| name.text.width()).fold(0.0, f64::max);
        let is_beside = widest <= 0.4 * width;
        let indent = if is_beside { widest + 0.7 * em } else { 1.5 * em };
        let fits = |text: &MathText| line(text, theme.grey).text.width() <= width - indent;
        let fits_column = |text: &MathText| line(text, theme.ink).text.width() <= width;
        let dimensions = MathText::join(dimensions.iter().cloned(), ", ").wrap(fits_column);
        let dimensions = dimensions.iter().filter(|part| !part.pieces().is_empty());
        let mut rows: Vec<_> = dimensions.map(|part| (None, line(part, theme.ink), 0.0)).collect();
        for (name, (joint, construction)) in names.into_iter().zip(&key.joints) {
            let mut name = match is_beside {
                true => Some(name),
                false => {
                    let parts = name.wrap(width);
                    rows.extend(
                        parts.into_iter().map(|part| (None, line(&MathText::from_words(part), theme.ink), 0.0)),
                    );
                    None
                }
            };
            let remarks = [(&key.helpers, "; no pin"), (&key.beyond, "; beyond the drawing")];
            let remarks = remarks.into_iter().filter(|(joints, _)| joints.contains(joint));
            let construction = remarks.fold(construction.clone(), |text, (_, words)| text.with_words(words));
            for part in construction.wrap(fits) {
                rows.push((name.take(), line(&part, theme.grey), indent));
            }
        }
        let formulas = key.note.iter().flat_map(|note| note.wrap(fits_column));
        rows.extend(formulas.map(|part| (None, line(&part, theme.grey), 0.0)));
        let first_remark = rows.len();
        for remark in &key.remarks {
            let text = theme.text_line(remark, Point::origin(), Anchor::Start, em, theme.grey);
            let wrapped = text.wrap(width);
            rows.extend(wrapped.iter().map(|part| (None, line(&MathText::from_words(part.as_str()), theme.grey), 0.0)));
        }
        let per_column = ((rect.size.y / (LEADING * em)).floor() as usize).max(1);
        KeyLines { em, columns: columns as usize, per_column, width, rows, first_remark }
    }

    /// The number of lines that the rectangle has.
    fn capacity(&self) -> usize {
        self.columns * self.per_column
    }

    fn draw(&self, area: &impl Area, rect: Rect, theme: &Theme) {
        let (em, step) = (self.em, LEADING * self.em);
        let left_out = match self.rows.len() > self.capacity() {
            true => self.rows.len() + 1 - self.capacity(),
            false => 0,
        };
        let line = |text: &str| theme.text_line(text, Point::origin(), Anchor::Start, em, theme.ink);
        let rest = line(&left_out_lines(left_out, |text| line(text).text.width() <= self.width));
        let rest = (left_out > 0).then_some((None, rest, 0.0));
        let shown = self.rows.len() - left_out;
        for (k, (name, text, indent)) in self.rows[..shown].iter().chain(&rest).enumerate() {
            // The remarks are apart from the joints.
            let is_apart = k >= self.first_remark && k / self.per_column == self.first_remark / self.per_column;
            let gap = if is_apart { 0.5 * step } else { 0.0 };
            let column = Vector::new((k / self.per_column) as f64 * (self.width + em), 0.0);
            let at = rect.corner + column + Vector::new(0.0, em + gap + step * (k % self.per_column) as f64);
            for (line, x) in name.iter().map(|name| (name, 0.0)).chain([(text, *indent)]) {
                area.record(line.clone().moved_to(at + Vector::new(x, 0.0)).fit_width(self.width - x));
            }
        }
    }
}

/// What is said in place of the last line where some do not fit.
pub(super) fn left_out_lines(count: usize, fits: impl Fn(&str) -> bool) -> String {
    let short = format!("… and {count} more lines");
    let whole = format!("{short}, for which this page is too small");
    if fits(&whole) { whole } else { short }
}

/// Draws a linkage in its pose on a circuit with the names of its joints, the direction of the crank and the output; `ink` is the
/// colour of a joint.
pub(super) fn draw_linkage(
    area: &impl Area,
    rect: Rect,
    (mechanism, key): (&PosedMechanism, &Key),
    circuit: &Circuit,
    ink: impl Fn(JointId) -> Color,
    theme: &Theme,
) {
    let letter = theme.caption_size;
    let frame = rect.inset(1.6 * letter);
    let named = pins(mechanism, circuit);
    let at_points = named.iter().map(|pin| mechanism.pose[pin[0]]);
    let bounds = mechanism.bounds().union(Bounds::from_points(at_points));
    let least_radius = |plot: &Plot| 4.0 * theme.joint_radius / plot.page_from_plane.scale();
    let directions = |plot: &Plot| DirectionMarks::new(mechanism, circuit, least_radius(plot));
    let plot = Plot::whole(frame).fitted_to(bounds);
    // Where its arrows would be outside, the linkage is smaller.
    let with_arrows = bounds.union(Bounds::from_points(directions(&plot).points()));
    let is_inside = [with_arrows.min, with_arrows.max].iter().all(|p| rect.contains(&plot.page_from_plane.apply(*p)));
    let plot = if is_inside { plot } else { plot.fitted_to(with_arrows) };
    let underlay = mechanism.underlay_items(&plot, theme);
    let links = mechanism.linkage_items(&plot, theme, ink);
    let directions = directions(&plot).map(plot.page_from_plane);
    let mut marks = directions.items(theme);
    let dot = |&joint: &JointId| Circle {
        centre: plot.page_from_plane.apply(mechanism.pose[joint]),
        radius: 0.35 * theme.joint_radius,
        stroke: None,
        fill: Some(theme.grey),
    };
    // Helpers, feet of lines, yokes, racks and the points of grids are no pins.
    let drawn = mechanism.drawn_joints();
    let is_pin = |joint: &&JointId| drawn.contains(joint) && mechanism.is_pin(**joint);
    marks.extend(named.iter().map(|pin| &pin[0]).filter(|joint| !is_pin(joint)).map(dot).map(Item::Circle));
    let zero = theme.text_line("0°", Point::origin(), Anchor::Middle, theme.note_size, theme.grey).text;
    let mut obstacles = Obstacles::default();
    obstacles.add(&underlay, true);
    obstacles.add(&links, false);
    obstacles.add(&marks, false);
    let mut placer = LabelPlacer::new(&obstacles, rect, theme);
    let names = joint_names((mechanism, key), &named, &plot, theme)
        .into_iter()
        .chain(directions.zero_end().map(|at| (at, zero)));
    let names = names.filter_map(|(at, name)| placer.place_at_point(at, name)).collect();
    area.grouped(Group::figure("key", "Key: the linkage with the names of its joints"), || {
        for (class, items) in [("underlay", underlay), ("linkage", links), ("direction", marks), ("name", names)] {
            area.record(Drawing { class, title: String::new(), items });
        }
    });
}

/// The joints that only serve to place others: those that are near the linkage, and those that the drawing does not have.
fn helpers(mechanism: &PosedMechanism) -> [Vec<JointId>; 2] {
    /// The growth of the drawing up to which a point is shown.
    const MAX_GROWTH: f64 = 1.3;
    let bounds = mechanism.bounds();
    let is_near = |joint: &JointId| {
        let with = bounds.union(Bounds::from_points([mechanism.pose[*joint]]));
        with.size().max() <= MAX_GROWTH * bounds.size().max()
    };
    let (near, far) = mechanism.mechanism.helpers.iter().copied().partition(is_near);
    [near, far]
}

/// The joints that are drawn, those that are traced and the helpers, each name once: a grid of points has one name for all of them. Joints
/// that are in one place all the time are together, also those that are not drawn where others are.
fn pins(mechanism: &PosedMechanism, circuit: &Circuit) -> Vec<Vec<JointId>> {
    let linkage = mechanism.linkage;
    let name = |joint: JointId| linkage.joints[joint].name.as_str();
    let drawn: Vec<JointId> = mechanism.drawn_joints().into_iter().chain(linkage.traced.iter().copied()).collect();
    let is_hidden = |joint: &JointId| {
        !linkage.is_helper(*joint) && drawn.iter().any(|other| other != joint && circuit.coincide(*other, *joint))
    };
    let hidden: Vec<JointId> = linkage.joint_ids().filter(is_hidden).collect();
    let [near, _] = helpers(mechanism);
    let all = drawn.into_iter().chain(hidden).chain(near);
    let mut pins: Vec<Vec<JointId>> = Vec::new();
    for joint in all {
        if pins.iter().flatten().any(|known| name(*known) == name(joint)) {
            continue;
        }
        match pins.iter_mut().find(|pin| circuit.coincide(pin[0], joint)) {
            Some(pin) => pin.push(joint),
            None => pins.push(vec![joint]),
        }
    }
    pins
}

/// The names of the joints of each pin that is one in all figures, where it has several.
fn common_pins(figures: &[&Figure]) -> Vec<Vec<String>> {
    let names = |figure: &&Figure| -> Vec<Vec<String>> {
        let Some(mechanism) = figure.mechanisms.first() else { return Vec::new() };
        let name = |joint: &JointId| displayed_name(&mechanism.linkage.joints[*joint].name);
        let several = pins(mechanism, figure.first_circuit()).into_iter().filter(|pin| pin.len() > 1);
        several.map(|pin| pin.iter().map(name).collect()).collect()
    };
    let mut pins = figures.iter().map(names);
    let first = pins.next().unwrap_or_default();
    pins.fold(first, |common, next| common.into_iter().filter(|pin| next.contains(pin)).collect())
}

/// The names of pins, with their positions; those of helpers and of the feet of slots' lines are grey.
fn joint_names(
    (mechanism, key): (&PosedMechanism, &Key),
    pins: &[Vec<JointId>],
    plot: &Plot,
    theme: &Theme,
) -> Vec<(Point, Text)> {
    let linkage = mechanism.linkage;
    let label = |pin: &Vec<JointId>| {
        let names: Vec<String> = pin.iter().map(|&joint| displayed_name(&linkage.joints[joint].name)).collect();
        let is_foot = matches!(linkage.joints[pin[0]].kind, JointKind::Slot { .. }) && !mechanism.is_pin(pin[0]);
        let is_light = is_foot || mechanism.mechanism.helpers.contains(&pin[0]);
        let ink = if is_light { theme.grey } else { theme.ink };
        let text =
            theme.text_line(&key.pin_label(&names), Point::origin(), Anchor::Middle, theme.caption_size, ink).text;
        (plot.page_from_plane.apply(mechanism.pose[pin[0]]), text)
    };
    pins.iter().map(label).collect()
}
