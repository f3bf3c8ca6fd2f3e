//! The SVG format.

mod number;
#[cfg(feature = "fonts")]
mod outlines;
mod path_data;

use std::fmt::Write;

use super::TextMode;
use crate::scene::{
    Anchor, Animation, Circle, Color, Curve, Group, Item, Path, Scene, Stroke, Text, has_right_to_left,
};
use number::{Number, to_micrometres};
use path_data::{absolute_path_data, write_path_data, write_spline_data};

/// Renders a scene to an SVG document; coordinates are in millimetres, rounded to 1/1000 mm.
pub fn svg(scene: &Scene, text: TextMode) -> Vec<u8> {
    let mut writer = SvgWriter { output: String::with_capacity(64 * 1024), text_mode: text };
    let (w, h) = (Number(to_micrometres(scene.width)), Number(to_micrometres(scene.height)));
    writer.write(format_args!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}mm\" height=\"{h}mm\" viewBox=\"0 0 {w} {h}\" \
         font-family=\"{}\" font-kerning=\"none\" style=\"font-variant-ligatures:none\" \
         stroke-linejoin=\"round\" fill=\"none\">\n",
        scene.typeface.family.fallback_families()
    ));
    writer.write(format_args!("<title>{}</title>\n", Escaped(&scene.title)));
    writer.write(format_args!("<rect width=\"{w}\" height=\"{h}\" fill=\"{}\"/>\n", scene.paper));
    for item in &scene.items {
        writer.write_item(item);
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

    fn write_item(&mut self, item: &Item) {
        match item {
            Item::Group(group) => self.write_group(group),
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
                _ => self.write_item(item),
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
        if text.runs.iter().any(|run| has_right_to_left(&run.text)) {
            // The direction is that of the first letter, as in the other formats.
            self.output.push_str(" unicode-bidi=\"plaintext\"");
        }
        if text.runs.iter().any(|run| run.text.contains("  ")) {
            // By default a viewer collapses consecutive spaces.
            self.output.push_str(" xml:space=\"preserve\"");
        }
        self.output.push('>');
        let mut rise = 0.0;
        for run in &text.runs {
            let is_shifted = run.rise(text.size) != rise;
            if !is_shifted && !run.is_raised && !run.face.is_italic {
                self.write(format_args!("{}", Escaped(&run.text)));
                continue;
            }
            self.output.push_str("<tspan");
            if is_shifted {
                let shift = Number(to_micrometres(rise - run.rise(text.size)));
                self.write(format_args!(" dy=\"{shift}\""));
                rise = run.rise(text.size);
            }
            if run.is_raised {
                self.write(format_args!(" font-size=\"{}\"", Number(to_micrometres(run.size(text.size)))));
            }
            if run.face.is_italic {
                self.output.push_str(" font-style=\"italic\"");
            }
            self.write(format_args!(">{}</tspan>", Escaped(&run.text)));
        }
        self.output.push_str("</text>\n");
    }
}

/// Text with escaped markup; characters that XML does not allow become replacement characters.
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
    fn markup_in_text_is_escaped() {
        assert_eq!(Escaped("<a href=\"x\">&\u{7}\n").to_string(), "&lt;a href=&quot;x&quot;&gt;&amp;\u{fffd} ");
    }
}
