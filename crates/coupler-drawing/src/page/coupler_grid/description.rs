//! The description of the linkage, next to its key: its class, every length in full, its output.

use super::super::area::Area;
use super::super::key::Key;
use super::super::key_drawing;
use super::super::rect::Rect;
use super::super::theme::Theme;
use super::super::{CouplerGridPage, LinkLabel};
use super::columns::finite;
use super::notes::format_inputs;
use super::turn::change_point_inputs;
use crate::scene::{Anchor, Color};
use coupler_curves::expression::{displayed_name, join_names};
use coupler_curves::geometry::Point;
use coupler_curves::linkage::{Continuation, FourBar, FourBarClass, JointId, JointKind, Linkage, OutputLink};
use coupler_curves::measure::Measure;
use coupler_curves::solve::SolvedCell;
use coupler_curves::text::format_for_building;

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
    pub fn new(page: &CouplerGridPage, key: Option<&Key>, width: f64, theme: &Theme) -> Description {
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
        if key.is_none() {
            texts.extend(dimensions(&solved.linkage, page.labels));
        }
        if class == Some(FourBarClass::ChangePoint) {
            texts.push(change_point_note(solved));
        }
        texts.extend(output_facts(solved));
        let wrapped = |text: &String| theme.text_line(text, Point::origin(), Anchor::Start, em, theme.grey).wrap(width);
        lines.extend(texts.iter().flat_map(wrapped).map(|text| (text, em, theme.grey)));
        let key_height =
            key.map_or(0.0, |key| 0.5 * em + key_drawing::lines_height(width, &key.dimensions, key, theme));
        Description { lines, key_height }
    }

    /// The height that it needs, in millimetres.
    pub fn height(&self) -> f64 {
        self.key_height + self.lines.iter().map(|(_, size, _)| LEADING * size).sum::<f64>()
    }

    /// Draws the description in a frame, as many lines as fit, and how many do not.
    pub fn draw(&self, area: &impl Area, frame: Rect, page: &CouplerGridPage, key: Option<&Key>, theme: &Theme) {
        let mut y = frame.corner.y;
        let bottom = frame.corner.y + frame.size.y * (1.0 + 1e-9);
        for (k, (text, size, color)) in self.lines.iter().enumerate() {
            y += LEADING * size;
            let line = |text: &str| {
                let line = theme.text_line(text, Point::new(frame.corner.x, y), Anchor::Start, *size, *color);
                line.with_italics(page.heading.symbols)
            };
            if self.lines.get(k + 1).is_some_and(|(_, next, _)| y + LEADING * next > bottom) {
                let fits = |text: &str| line(text).text.width() <= frame.size.x;
                area.record(line(&key_drawing::left_out_lines(self.lines.len() - k, fits)).fit_width(frame.size.x));
                break;
            }
            area.record(line(text).fit_width(frame.size.x));
        }
        if let Some(key) = key {
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

/// A line for each link of a four-bar: what it is, its joints, its length in full with its name, and the direction of a frame that is
/// not along the x-axis.
pub(super) fn dimensions(linkage: &Linkage, labels: &[LinkLabel]) -> Vec<String> {
    let Some([o, a, b, c]) = FourBar::pins(linkage) else { return Vec::new() };
    let output = output_joints(linkage);
    let line = |(role, joints): (&str, [JointId; 2])| {
        let names = join_names(&joints.map(|joint| linkage.joints[joint].name.as_str()));
        let length = format_for_building(length(linkage, joints)?);
        let label = labels.iter().find(|label| is_same(label.joints, joints)).map(|label| label.text.as_str());
        let is_named = label.is_some_and(|label| label.parse::<f64>().is_err());
        let length = match label.filter(|_| is_named) {
            Some(label) => format!("{} = {length}", displayed_name(label)),
            None => length,
        };
        let is_output = output.is_some_and(|output| is_same(joints, output));
        let ends = if joints == [o, c] { slanted_ends(linkage, joints) } else { None };
        let ends = ends.unwrap_or_default();
        Some(format!("{role} {names}: {length}{ends}{}", if is_output { ", the output" } else { "" }))
    };
    [("frame", [o, c]), ("crank", [o, a]), ("coupler", [a, b]), ("rocker", [c, b])]
        .into_iter()
        .filter_map(line)
        .collect()
}

/// Where the ends of a frame are that is not along the x-axis.
fn slanted_ends(linkage: &Linkage, joints: [JointId; 2]) -> Option<String> {
    let [JointKind::Fixed(from), JointKind::Fixed(to)] = joints.map(|joint| &linkage.joints[joint].kind) else {
        return None;
    };
    let coordinates = |at: &Point| [at.x, at.y].map(format_for_building).join(", ");
    let is_slanted = linkage.seen_from.is_none() && (from.y != to.y || from.x > to.x);
    is_slanted.then(|| format!(", from ({}) to ({})", coordinates(from), coordinates(to)))
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
