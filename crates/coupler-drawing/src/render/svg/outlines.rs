//! Texts as outlines of their glyphs.

use super::number::{Number, to_micrometres};
use super::path_data::PathWriter;
use super::{Escaped, SvgWriter};
use crate::scene::{OutlineSegment, Text};
use coupler_curves::geometry::Point;

impl SvgWriter {
    /// Writes a text as one path, with the text as its label.
    pub(super) fn write_outlines(&mut self, text: &Text) {
        let label: String = text.runs.iter().map(|run| run.text.as_str()).collect();
        self.write(format_args!("<path role=\"img\" aria-label=\"{}\"", Escaped(&label)));
        if text.quarter_turns != 0 {
            let [x, y] = [text.position.x, text.position.y].map(|c| Number(to_micrometres(c)));
            self.write(format_args!(" transform=\"rotate({} {x} {y})\"", u32::from(text.quarter_turns) * 90));
        }
        self.output.push_str(" d=\"");
        let mut path = PathWriter::default();
        for run in text.glyph_runs() {
            let size = run.size;
            for (at, outline) in run.outlines() {
                let on_page = |[x, y]: [f64; 2]| Point::new(at.x + x * size, at.y - y * size);
                for segment in outline.iter().copied() {
                    match segment {
                        OutlineSegment::Move(p) => path.write_command(&mut self.output, 'm', &[on_page(p)]),
                        OutlineSegment::Line(p) => path.write_command(&mut self.output, 'l', &[on_page(p)]),
                        OutlineSegment::Quad(c, p) => {
                            path.write_command(&mut self.output, 'q', &[on_page(c), on_page(p)])
                        }
                        OutlineSegment::Cubic(c, d, p) => {
                            path.write_command(&mut self.output, 'c', &[on_page(c), on_page(d), on_page(p)])
                        }
                        OutlineSegment::Close => path.close(&mut self.output),
                    }
                }
            }
        }
        self.output.push('"');
        self.write_paint(None, Some(text.color));
        self.end_element("path", None);
    }
}
