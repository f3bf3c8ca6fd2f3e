//! The SVG format.

mod number;
#[cfg(feature = "fonts")]
mod outlines;
mod path_data;

use std::fmt::{self, Write};
use std::ops::Range;

use super::TextMode;
use crate::scene::{
    Anchor, Animation, Circle, Color, Curve, Group, Item, Path, Scene, Stroke, Text, TextRun, has_right_to_left,
    reading_parts,
};
use number::{Number, to_micrometres};
use path_data::{absolute_path_data, write_path_data, write_spline_data};

/// Renders a scene to an SVG document; coordinates are in millimetres, rounded to 1/1000 mm.
pub fn svg(scene: &Scene, text: TextMode) -> Vec<u8> {
    let mut writer = SvgWriter { output: String::with_capacity(64 * 1024), text_mode: text };
    let (w, h) = (Number(to_micrometres(scene.width)), Number(to_micrometres(scene.height)));
    writer.write(format_args!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}mm\" height=\"{h}mm\" viewBox=\"0 0 {w} {h}\" \
         xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" role=\"graphics-document document\" xml:lang=\"en\" \
         font-family=\"{}\" font-kerning=\"none\" style=\"font-variant-ligatures:none\" \
         stroke-linejoin=\"round\" fill=\"none\">\n",
        scene.typeface.family.fallback_families()
    ));
    writer.write(format_args!("<title>{}</title>\n", Escaped(&scene.title)));
    let figures = scene.figures();
    let descriptions: Vec<&str> = figures.iter().map(|figure| figure.description.as_str()).collect();
    if !descriptions.is_empty() {
        writer.write(format_args!("<desc>{}</desc>\n", Escaped(&descriptions.join(". "))));
    }
    writer.write(format_args!("<rect width=\"{w}\" height=\"{h}\" fill=\"{}\"/>\n", scene.paper));
    // Of a page with one figure beside its key, its parts are layers, too.
    let layers = if figures.iter().filter(|figure| figure.class != "key").count() == 1 { 2 } else { 1 };
    for item in &scene.items {
        writer.write_item(item, layers);
    }
    writer.output.push_str("</svg>\n");
    writer.output.into_bytes()
}

/// Writes the elements of a document.
struct SvgWriter {
    output: String,
    text_mode: TextMode,
}

impl SvgWriter {
    fn write(&mut self, arguments: std::fmt::Arguments) {
        // Writing to a string cannot fail.
        let _ = self.output.write_fmt(arguments);
    }

    /// Writes an item; it is in layers that are nested so deep.
    fn write_item(&mut self, item: &Item, layers: usize) {
        match item {
            Item::Group(group) => self.write_group(group, layers),
            Item::Path(path) => self.write_path(path, None),
            Item::Curve(curve) => self.write_curve(curve),
            Item::Circle(circle) => self.write_circle(circle, None),
            Item::Animation(animation) => self.write_animation(animation),
            Item::Text(text) => match self.text_mode {
                #[cfg(feature = "fonts")]
                TextMode::Outlines => self.write_outlines(text),
                _ => self.write_text(text),
            },
        }
    }

    /// Writes a group, which is a layer in drawing programs if layers are nested so deep.
    fn write_group(&mut self, group: &Group, layers: usize) {
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
        let label = if group.id.is_empty() { group.class.replace('-', " ") } else { group.id.clone() };
        if layers > 0 && !label.is_empty() {
            self.write(format_args!(" inkscape:groupmode=\"layer\" inkscape:label=\"{}\"", Escaped(&label)));
        }
        self.output.push('>');
        if !group.title.is_empty() {
            self.write(format_args!("<title>{}</title>", Escaped(&group.title)));
        }
        self.output.push('\n');
        for item in &group.items {
            self.write_item(item, layers.saturating_sub(1));
        }
        self.output.push_str("</g>\n");
    }

    /// Writes each item of the first frame, animated through its positions in all frames.
    fn write_animation(&mut self, animation: &Animation) {
        let Animation { frames, seconds } = animation;
        let Some(first) = frames.first() else { return };
        for (k, item) in first.iter().enumerate() {
            let states = || frames.iter().filter_map(|frame| frame.get(k));
            let paths = || states().filter_map(|item| if let Item::Path(path) = item { Some(path) } else { None });
            let circles =
                || states().filter_map(|item| if let Item::Circle(circle) = item { Some(circle) } else { None });
            match item {
                Item::Path(path) => {
                    let values: Vec<String> = paths().map(absolute_path_data).collect();
                    self.write_path(path, Some(&self.animate_element("d", &values, *seconds)));
                }
                Item::Circle(circle) => {
                    let values = |coordinate: fn(&Circle) -> f64| -> Vec<String> {
                        circles().map(|circle| Number(to_micrometres(coordinate(circle))).to_string()).collect()
                    };
                    let x = self.animate_element("cx", &values(|circle| circle.centre.x), *seconds);
                    let y = self.animate_element("cy", &values(|circle| circle.centre.y), *seconds);
                    self.write_circle(circle, Some(&(x + &y)));
                }
                _ => self.write_item(item, 0),
            }
        }
    }

    /// The element that animates an attribute; empty if all values are equal.
    fn animate_element(&self, attribute: &str, values: &[String], seconds: f64) -> String {
        if values.iter().all(|value| *value == values[0]) {
            return String::new();
        }
        let values = values.join(";");
        format!(
            "<animate attributeName=\"{attribute}\" values=\"{values}\" dur=\"{seconds}s\" repeatCount=\"indefinite\"/>"
        )
    }

    /// Writes an attribute with a length: most attributes have one, and `format_args` takes longer.
    fn write_length(&mut self, before: &str, mm: f64) {
        self.output.push_str(before);
        let _ = Number(to_micrometres(mm)).write_to(&mut self.output);
        self.output.push('"');
    }

    fn write_color(&mut self, before: &str, color: Color) {
        self.output.push_str(before);
        let _ = color.write_to(&mut self.output);
        self.output.push('"');
    }

    fn write_paint(&mut self, stroke: Option<Stroke>, fill: Option<Color>) {
        if let Some(fill) = fill {
            self.write_color(" fill=\"", fill);
        }
        if let Some(stroke) = stroke {
            self.write_color(" stroke=\"", stroke.color);
            self.write_length(" stroke-width=\"", stroke.width);
            if stroke.has_round_ends {
                self.output.push_str(" stroke-linecap=\"round\"");
            }
        }
    }

    /// Ends an element, with an animation as its content if there is one.
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

    fn write_curve(&mut self, curve: &Curve) {
        self.output.push_str("<path d=\"");
        write_spline_data(&mut self.output, curve);
        self.output.push('"');
        self.write_paint(Some(curve.stroke), None);
        self.output.push_str("/>\n");
    }

    fn write_circle(&mut self, circle: &Circle, animation: Option<&String>) {
        self.write_length("<circle cx=\"", circle.centre.x);
        self.write_length(" cy=\"", circle.centre.y);
        self.write_length(" r=\"", circle.radius);
        self.write_paint(circle.stroke, circle.fill);
        self.end_element("circle", animation);
    }

    fn write_text(&mut self, text: &Text) {
        self.write_length("<text x=\"", text.position.x);
        self.write_length(" y=\"", text.position.y);
        self.write_length(" font-size=\"", text.size);
        self.write_color(" fill=\"", text.color);
        match text.anchor {
            Anchor::Start => {}
            Anchor::Middle => self.output.push_str(" text-anchor=\"middle\""),
            Anchor::End => self.output.push_str(" text-anchor=\"end\""),
        }
        if text.quarter_turns != 0 {
            let [x, y] = [text.position.x, text.position.y].map(|c| Number(to_micrometres(c)));
            self.write(format_args!(" transform=\"rotate({} {x} {y})\"", u32::from(text.quarter_turns) * 90));
        }
        let is_right_to_left = text.runs.iter().any(|run| has_right_to_left(&run.text));
        let parts = if is_right_to_left { reading_parts(&text.words()) } else { Vec::new() };
        if parts.len() == 1 {
            // The direction is that of the first letter, as in the other formats.
            self.output.push_str(" unicode-bidi=\"plaintext\"");
        }
        if text.runs.iter().any(|run| run.text.contains("  ")) {
            // By default a viewer collapses consecutive spaces.
            self.output.push_str(" xml:space=\"preserve\"");
        }
        self.output.push('>');
        let isolated = (parts.len() > 1).then(|| isolated_runs(&text.runs, &parts));
        let mut rise = 0.0;
        for run in isolated.as_ref().unwrap_or(&text.runs) {
            let is_shifted = run.rise(text.size) != rise;
            if !is_shifted && !run.is_raised && !run.face.is_italic {
                let _ = Escaped(&run.text).write_to(&mut self.output);
                continue;
            }
            self.output.push_str("<tspan");
            if is_shifted {
                self.write_length(" dy=\"", rise - run.rise(text.size));
                rise = run.rise(text.size);
            }
            if run.is_raised {
                self.write_length(" font-size=\"", run.size(text.size));
            }
            if run.face.is_italic {
                self.output.push_str(" font-style=\"italic\"");
            }
            self.output.push('>');
            let _ = Escaped(&run.text).write_to(&mut self.output);
            self.output.push_str("</tspan>");
        }
        self.output.push_str("</text>\n");
    }
}

/// Runs of text in which each part is isolated, so that it has the direction of its first letter.
fn isolated_runs(runs: &[TextRun], parts: &[Range<usize>]) -> Vec<TextRun> {
    const FIRST: char = '\u{2068}';
    const LAST: char = '\u{2069}';
    let mut start = 0;
    let mut isolate = |run: &TextRun| {
        let mut own = String::with_capacity(run.text.len() + 6);
        for (at, c) in run.text.char_indices() {
            if parts.iter().any(|part| part.start == start + at) {
                own.push(FIRST);
            }
            own.push(c);
            if parts.iter().any(|part| part.end == start + at + c.len_utf8()) {
                own.push(LAST);
            }
        }
        start += run.text.len();
        TextRun { text: own, ..run.clone() }
    };
    runs.iter().map(&mut isolate).collect()
}

/// Text with escaped markup; characters that XML does not allow become replacement characters.
struct Escaped<'a>(&'a str);

impl Escaped<'_> {
    fn write_to(&self, out: &mut impl Write) -> fmt::Result {
        for c in self.0.chars() {
            match c {
                '&' => out.write_str("&amp;")?,
                '<' => out.write_str("&lt;")?,
                '>' => out.write_str("&gt;")?,
                '"' => out.write_str("&quot;")?,
                '\t' | '\n' => out.write_char(' ')?,
                '\0'..='\x1f' | '\x7f' | '\u{fffe}' | '\u{ffff}' => out.write_char('\u{fffd}')?,
                c => out.write_char(c)?,
            }
        }
        Ok(())
    }
}

impl fmt::Display for Escaped<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write_to(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_in_text_is_escaped() {
        assert_eq!(Escaped("<a href=\"x\">&\u{7}\n").to_string(), "&lt;a href=&quot;x&quot;&gt;&amp;\u{fffd} ");
    }
}
