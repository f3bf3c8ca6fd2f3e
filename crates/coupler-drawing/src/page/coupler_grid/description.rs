//! The description of the linkage, next to its key: its class, every length in full, its output.

use super::super::area::Area;
use super::super::key_drawing;
use super::super::rect::Rect;
use super::super::theme::Theme;
use super::super::{CouplerGridPage, LinkLabel};
use super::columns::finite;
use super::notes::format_inputs;
use super::turn::change_point_inputs;
use crate::scene::{Anchor, Color};
use coupler_curves::expression::join_names;
use coupler_curves::geometry::Point;
use coupler_curves::linkage::{Continuation, FourBar, FourBarClass, JointId, Linkage, OutputLink};
use coupler_curves::measure::Measure;
use coupler_curves::solve::SolvedCell;

/// The description of the linkage of a page: lines, and the lines of its key, if it has one.
pub(super) struct Description {
    /// Each line with its size and colour.
    lines: Vec<(String, f64, Color)>,
    /// The height of the lines of the key.
    key_height: f64,
}

/// The distance of lines relative to their size.
const LEADING: f64 = 1.45;

impl Description {
    /// The description for a width.
    pub fn new(page: &CouplerGridPage, width: f64, theme: &Theme) -> Description {
        let em = theme.note_size;
        let solved = page.panel.solved_cell;
        let class = FourBar::from_linkage(&solved.linkage).map(FourBar::class);
        let mut lines = Vec::new();
        if let Some(class) = class {
            let is_change_point = class == FourBarClass::ChangePoint;
            let (name, size) = if is_change_point { ("change point", 1.6) } else { (class.name(), 1.25) };
            lines.push((name.to_owned(), size * em, theme.ink));
        }
        let mut texts = Vec::new();
        if class == Some(FourBarClass::ChangePoint) {
            texts.push(change_point_note(solved));
        }
        if page.key.is_none() {
            texts.extend(dimensions(&solved.linkage, page.labels));
        }
        texts.extend(output_facts(solved));
        let wrapped = |text: &String| theme.text_line(text, Point::origin(), Anchor::Start, em, theme.grey).wrap(width);
        lines.extend(texts.iter().flat_map(wrapped).map(|text| (text, em, theme.grey)));
        let key_height =
            page.key.map_or(0.0, |key| 0.5 * em + key_drawing::lines_height(width, &key.dimensions, key, theme));
        Description { lines, key_height }
    }

    /// The height that it needs, in millimetres.
    pub fn height(&self) -> f64 {
        self.key_height + self.lines.iter().map(|(_, size, _)| LEADING * size).sum::<f64>()
    }

    /// Draws the description in a frame, as many lines as fit.
    pub fn draw(&self, area: &impl Area, frame: Rect, page: &CouplerGridPage, theme: &Theme) {
        let mut y = frame.corner.y;
        let bottom = frame.corner.y + frame.size.y;
        for (text, size, color) in &self.lines {
            y += LEADING * size;
            if y <= bottom {
                let at = Point::new(frame.corner.x, y);
                let line = theme.text_line(text, at, Anchor::Start, *size, *color).with_italics(page.heading.symbols);
                area.record(line.fit_width(frame.size.x));
            }
        }
        if let Some(key) = page.key {
            let corner = Point::new(frame.corner.x, y + 0.5 * theme.note_size);
            let rest = Rect { corner, size: frame.corner + frame.size - corner };
            key_drawing::draw_lines(area, rest, &key.dimensions, key, theme);
        }
    }
}

/// What a change point is, and how the motion goes on through it on this page.
fn change_point_note(solved: &SolvedCell) -> String {
    let inputs = change_point_inputs(solved);
    let place = if inputs.is_empty() { String::new() } else { format!(" at {}", format_inputs(solved, &inputs)) };
    let choice = match solved.linkage.motion_options.continuation {
        Continuation::Branch => "it stays in its branch",
        Continuation::Smooth => "it goes on smoothly into the other branch",
    };
    format!("all links on one line{place}: there the motion is not determined; as drawn, {choice}")
}

/// A line for each link with a name: what it is, its joints, its length in full.
fn dimensions(linkage: &Linkage, labels: &[LinkLabel]) -> Vec<String> {
    let output = output_joints(linkage);
    let line = |label: &LinkLabel| {
        let [from, to] = label.joints;
        let names = join_names(&label.joints.map(|joint| linkage.joints[joint].name.as_str()));
        // All digits that are needed to read back the same number.
        let length = length(linkage, [from, to])?.to_string();
        let length = if label.text == length { length } else { format!("{} = {length}", label.text) };
        let role = role(linkage, [from, to]).map_or(String::new(), |role| format!("{role} "));
        let is_output = output.is_some_and(|output| is_same([from, to], output));
        Some(format!("{role}{names}: {length}{}", if is_output { ", the output" } else { "" }))
    };
    labels.iter().filter_map(line).collect()
}

fn is_same([a, b]: [JointId; 2], other: [JointId; 2]) -> bool {
    other == [a, b] || other == [b, a]
}

/// The two joints of the output link, if it turns.
fn output_joints(linkage: &Linkage) -> Option<[JointId; 2]> {
    match linkage.output()? {
        OutputLink::Link(joints) => Some(joints),
        OutputLink::Slot { .. } | OutputLink::Slider { .. } => None,
    }
}

/// The distance of two joints of a link.
fn length(linkage: &Linkage, [from, to]: [JointId; 2]) -> Option<f64> {
    linkage.links.iter().find_map(|link| Some((link.position(to)? - link.position(from)?).norm()))
}

/// What a link of a four-bar is called.
fn role(linkage: &Linkage, joints: [JointId; 2]) -> Option<&'static str> {
    let [o, a, b, c] = FourBar::pins(linkage)?;
    let roles = [([o, a], "crank"), ([a, b], "coupler"), ([c, b], "rocker"), ([o, c], "frame")];
    roles.into_iter().find(|(pins, _)| is_same(joints, *pins)).map(|(_, role)| role)
}

/// The swing or stroke of the output, and its time ratio, if they are measured.
fn output_facts(solved: &SolvedCell) -> Option<String> {
    let first = solved.curves.first()?;
    let number = |key| finite(first, key);
    let swing = number(Measure::OUTPUT_SWING).map(|swing| match swing {
        360.0 => "output turns fully".to_owned(),
        swing => format!("output swings {swing:.1}°"),
    });
    let stroke = number(Measure::OUTPUT_STROKE).map(|stroke| format!("stroke of the output {stroke:.4}"));
    let ratio = number(Measure::TIME_RATIO).map(|ratio| format!("time ratio {ratio:.3}"));
    let parts: Vec<String> = swing.into_iter().chain(stroke).chain(ratio).collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}
