use std::fmt::Write;

use super::TextMode;
use crate::scene::{Anchor, Animation, Circle, Color, Group, Item, OutlineSegment, Path, Scene, Stroke, Text};
use coupler_curves::geometry::Point;

/// A scene as an SVG document, in millimetres to 1/1000 mm.
pub fn svg(scene: &Scene, text: TextMode) -> Vec<u8> {
    let mut out = SvgWriter { output: String::with_capacity(64 * 1024), text_mode: text };
    let (w, h) = (Number(to_micrometres(scene.width)), Number(to_micrometres(scene.height)));
    out.write(format_args!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}mm\" height=\"{h}mm\" viewBox=\"0 0 {w} {h}\" \
         font-family=\"{}\" font-kerning=\"none\" style=\"font-variant-ligatures:none\" \
         stroke-linejoin=\"round\" fill=\"none\">\n",
        scene.typeface.fallback_families()
    ));
    out.write(format_args!("<title>{}</title>\n", Escaped(&scene.title)));
    out.write(format_args!("<rect width=\"{w}\" height=\"{h}\" fill=\"{}\"/>\n", scene.paper));
    for item in &scene.items {
        out.write_item(item);
    }
    out.output.push_str("</svg>\n");
    out.output.into_bytes()
}

struct SvgWriter {
    output: String,
    text_mode: TextMode,
}

impl SvgWriter {
    fn write(&mut self, arguments: std::fmt::Arguments) {
        // Writing to a string cannot fail.
        let _ = self.output.write_fmt(arguments);
    }

    fn write_item(&mut self, item: &Item) {
        match item {
            Item::Group(group) => self.write_group(group),
            Item::Path(path) => self.write_path(path, None),
            Item::Circle(circle) => self.write_circle(circle, None),
            Item::Animation(moving) => self.write_animation(moving),
            Item::Text(text) if self.text_mode == TextMode::Outlines => self.write_outlines(text),
            Item::Text(text) => self.write_text(text),
        }
    }

    fn write_group(&mut self, group: &Group) {
        self.output.push_str("<g");
        if !group.id.is_empty() {
            self.write(format_args!(" id=\"{}\"", Escaped(&group.id)));
        }
        if !group.class.is_empty() {
            self.write(format_args!(" class=\"{}\"", group.class));
        }
        for (name, value) in &group.data {
            self.write(format_args!(" data-{name}=\"{}\"", Escaped(value)));
        }
        self.output.push('>');
        if !group.title.is_empty() {
            self.write(format_args!("<title>{}</title>", Escaped(&group.title)));
        }
        self.output.push('\n');
        for item in &group.items {
            self.write_item(item);
        }
        self.output.push_str("</g>\n");
    }

    /// Each item of the first frame, with its places in all of them.
    fn write_animation(&mut self, moving: &Animation) {
        let Some(first) = moving.frames.first() else { return };
        for (k, item) in first.iter().enumerate() {
            let frames = || moving.frames.iter().filter_map(|frame| frame.get(k));
            let paths = || frames().filter_map(|item| if let Item::Path(path) = item { Some(path) } else { None });
            let circles =
                || frames().filter_map(|item| if let Item::Circle(circle) = item { Some(circle) } else { None });
            match item {
                Item::Path(path) => {
                    let values: Vec<String> = paths().map(absolute_path_data).collect();
                    self.write_path(path, Some(&self.animate_element("d", &values, moving.seconds)));
                }
                Item::Circle(circle) => {
                    let along = |of: fn(&Circle) -> f64| -> Vec<String> {
                        circles().map(|circle| Number(to_micrometres(of(circle))).to_string()).collect()
                    };
                    let x = self.animate_element("cx", &along(|circle| circle.centre.x), moving.seconds);
                    let y = self.animate_element("cy", &along(|circle| circle.centre.y), moving.seconds);
                    self.write_circle(circle, Some(&(x + &y)));
                }
                _ => self.write_item(item),
            }
        }
    }

    /// The element that moves an attribute; nothing where it stays.
    fn animate_element(&self, attribute: &str, values: &[String], seconds: f64) -> String {
        if values.iter().all(|value| *value == values[0]) {
            return String::new();
        }
        let values = values.join(";");
        format!(
            "<animate attributeName=\"{attribute}\" values=\"{values}\" dur=\"{seconds}s\" repeatCount=\"indefinite\"/>"
        )
    }

    fn write_paint(&mut self, stroke: Option<Stroke>, fill: Option<Color>) {
        if let Some(fill) = fill {
            self.write(format_args!(" fill=\"{}\"", fill));
        }
        if let Some(stroke) = stroke {
            let width = Number(to_micrometres(stroke.width));
            self.write(format_args!(" stroke=\"{}\" stroke-width=\"{width}\"", stroke.color));
            if stroke.has_round_ends {
                self.output.push_str(" stroke-linecap=\"round\"");
            }
        }
    }

    /// Ends an element, with what moves it inside.
    fn end_element(&mut self, name: &str, animation: Option<&String>) {
        match animation.filter(|animation| !animation.is_empty()) {
            None => self.output.push_str("/>\n"),
            Some(animation) => self.write(format_args!(">{animation}</{name}>\n")),
        }
    }

    fn write_path(&mut self, path: &Path, animation: Option<&String>) {
        self.output.push_str("<path d=\"");
        write_path_data(&mut self.output, path);
        self.output.push('"');
        self.write_paint(path.stroke, path.fill);
        self.end_element("path", animation);
    }

    fn write_circle(&mut self, circle: &Circle, animation: Option<&String>) {
        let [x, y] = [circle.centre.x, circle.centre.y].map(|c| Number(to_micrometres(c)));
        let radius = Number(to_micrometres(circle.radius));
        self.write(format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\""));
        self.write_paint(circle.stroke, circle.fill);
        self.end_element("circle", animation);
    }

    fn write_text(&mut self, text: &Text) {
        let [x, y, size] = [text.position.x, text.position.y, text.size].map(|c| Number(to_micrometres(c)));
        self.write(format_args!("<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" fill=\"{}\"", text.color));
        match text.anchor {
            Anchor::Start => {}
            Anchor::Middle => self.output.push_str(" text-anchor=\"middle\""),
            Anchor::End => self.output.push_str(" text-anchor=\"end\""),
        }
        if text.quarter_turns != 0 {
            self.write(format_args!(" transform=\"rotate({} {x} {y})\"", u32::from(text.quarter_turns) * 90));
        }
        if text.runs.iter().any(|run| run.text.contains("  ")) {
            // Readers take several spaces for one.
            self.output.push_str(" xml:space=\"preserve\"");
        }
        self.output.push('>');
        for run in &text.runs {
            if run.face.is_italic {
                self.write(format_args!("<tspan font-style=\"italic\">{}</tspan>", Escaped(&run.text)));
            } else {
                self.write(format_args!("{}", Escaped(&run.text)));
            }
        }
        self.output.push_str("</text>\n");
    }

    fn write_outlines(&mut self, text: &Text) {
        let words: String = text.runs.iter().map(|run| run.text.as_str()).collect();
        self.write(format_args!("<path role=\"img\" aria-label=\"{}\"", Escaped(&words)));
        if text.quarter_turns != 0 {
            let [x, y] = [text.position.x, text.position.y].map(|c| Number(to_micrometres(c)));
            self.write(format_args!(" transform=\"rotate({} {x} {y})\"", u32::from(text.quarter_turns) * 90));
        }
        self.output.push_str(" d=\"");
        let mut pen = PathWriter::default();
        let mut at = text.start();
        for run in &text.runs {
            for c in run.text.chars() {
                let place = |[x, y]: [f64; 2]| Point::new(at.x + x * text.size, at.y - y * text.size);
                for segment in run.face.outline(c).iter().copied() {
                    match segment {
                        OutlineSegment::Move(p) => pen.write_command(&mut self.output, 'm', &[place(p)]),
                        OutlineSegment::Line(p) => pen.write_command(&mut self.output, 'l', &[place(p)]),
                        OutlineSegment::Quad(c, p) => pen.write_command(&mut self.output, 'q', &[place(c), place(p)]),
                        OutlineSegment::Cubic(c, d, p) => {
                            pen.write_command(&mut self.output, 'c', &[place(c), place(d), place(p)])
                        }
                        OutlineSegment::Close => pen.close(&mut self.output),
                    }
                }
                at.x += run.face.advance(c) * text.size;
            }
        }
        self.output.push('"');
        self.write_paint(None, Some(text.color));
        self.end_element("path", None);
    }
}

fn write_path_data(out: &mut String, path: &Path) {
    let mut pen = PathWriter::default();
    for line in &path.polylines {
        for (k, &point) in line.points.iter().enumerate() {
            pen.write_command(out, if k == 0 { 'm' } else { 'l' }, &[point]);
        }
        if line.is_closed {
            pen.close(out);
        }
    }
}

/// A path in absolute coordinates: values between two frames are then places between them.
fn absolute_path_data(path: &Path) -> String {
    let mut out = String::new();
    for line in &path.polylines {
        for (k, point) in line.points.iter().enumerate() {
            let [x, y] = [point.x, point.y].map(|c| Number(to_micrometres(c)));
            let _ = write!(out, "{}{x} {y}", if k == 0 { 'M' } else { 'L' });
        }
        if line.is_closed {
            out.push('Z');
        }
    }
    out
}

/// Writes path data in relative coordinates. Places are rounded to micrometres before they are subtracted, so that
/// no error adds up.
#[derive(Default)]
struct PathWriter {
    current: [i64; 2],
    start: [i64; 2],
    last_command: Option<char>,
}

impl PathWriter {
    fn write_command(&mut self, out: &mut String, command: char, points: &[Point]) {
        let begin = self.current;
        if self.last_command == Some(command) && command != 'm' || self.last_command == Some('m') && command == 'l' {
            // A repeated command is not written again, and what follows a move is a line.
            self.last_command = Some(command);
            self.write_point(out, begin, points[0], true);
        } else {
            // A move that opens a path is from the origin, and what follows it is relative, as after any other.
            out.push(command);
            self.last_command = Some(command);
            self.write_point(out, begin, points[0], false);
        }
        for &point in &points[1..] {
            self.write_point(out, begin, point, true);
        }
        if command == 'm' {
            self.start = self.current;
        }
    }

    fn write_point(&mut self, out: &mut String, from: [i64; 2], point: Point, parted: bool) {
        self.current = [to_micrometres(point.x), to_micrometres(point.y)];
        let (x, y) = (self.current[0] - from[0], self.current[1] - from[1]);
        if parted && x >= 0 {
            out.push(' ');
        }
        out.push_str(Number(x).format_into(&mut [0; 24]));
        if y >= 0 {
            out.push(' ');
        }
        out.push_str(Number(y).format_into(&mut [0; 24]));
    }

    fn close(&mut self, out: &mut String) {
        out.push('z');
        self.current = self.start;
        self.last_command = Some('z');
    }
}

fn to_micrometres(mm: f64) -> i64 {
    (mm * 1000.0).round() as i64
}

/// Micrometres written as millimetres, in as few characters as it takes.
#[derive(Clone, Copy)]
struct Number(i64);

impl Number {
    /// Its text, at the end of a buffer. Most of what an SVG has are numbers, over which the formatter takes its time.
    fn format_into(self, buffer: &mut [u8; 24]) -> &str {
        let (mut whole, mut part) = (self.0.unsigned_abs() / 1000, self.0.unsigned_abs() % 1000);
        let mut at = buffer.len();
        let mut push = |byte: u8| {
            at -= 1;
            buffer[at] = byte;
        };
        if part > 0 {
            let mut digits = 3;
            while part % 10 == 0 {
                part /= 10;
                digits -= 1;
            }
            for _ in 0..digits {
                push(b'0' + (part % 10) as u8);
                part /= 10;
            }
            push(b'.');
        }
        while whole > 0 {
            push(b'0' + (whole % 10) as u8);
            whole /= 10;
        }
        match self.0.signum() {
            -1 => push(b'-'),
            0 => push(b'0'),
            _ => {}
        }
        std::str::from_utf8(&buffer[at..]).unwrap_or_default()
    }
}

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.format_into(&mut [0; 24]))
    }
}

/// Text that no reader takes for markup; characters XML has no place for become a replacement character.
struct Escaped<'a>(&'a str);

impl std::fmt::Display for Escaped<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for c in self.0.chars() {
            match c {
                '&' => f.write_str("&amp;")?,
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                '"' => f.write_str("&quot;")?,
                '\t' | '\n' => f.write_str(" ")?,
                '\0'..='\x1f' | '\x7f' | '\u{fffe}' | '\u{ffff}' => f.write_char('\u{fffd}')?,
                c => f.write_char(c)?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (micrometres, written) in [
            (0, "0"),
            (500, ".5"),
            (-10, "-.01"),
            (1234, "1.234"),
            (-2000, "-2"),
            (1050, "1.05"),
            (40_100, "40.1"),
            (i64::MIN, "-9223372036854775.808"),
        ] {
            assert_eq!(Number(micrometres).to_string(), written);
        }
    }

    #[test]
    fn path_data_is_relative_and_adds_up() {
        let mut out = String::new();
        let mut pen = PathWriter::default();
        let at = Point::new;
        for (command, point) in [('m', at(1.0, 2.0)), ('l', at(1.5, 1.0)), ('l', at(1.4, 1.0)), ('m', at(0.0, 0.0))] {
            pen.write_command(&mut out, command, &[point]);
        }
        pen.close(&mut out);
        pen.write_command(&mut out, 'l', &[at(3.0, -1.0)]);
        assert_eq!(out, "m1 2 .5-1-.1 0m-1.4-1zl3-1");
    }

    #[test]
    fn markup_in_a_title_stays_text() {
        assert_eq!(Escaped("<a href=\"x\">&\u{7}\n").to_string(), "&lt;a href=&quot;x&quot;&gt;&amp;\u{fffd} ");
    }
}
