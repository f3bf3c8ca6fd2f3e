//! The elements that areas record: groups of items and lines of text, in full precision.

use std::collections::HashSet;

use super::typography::{begins_with_value, is_article, is_defined, typeset};
use crate::scene::{Anchor, Circle, Color, Curve, Face, Group, Item, MIN_TEXT_SIZE, Stroke, Text, TextRun, Typeface};
use coupler_curves::expression::{MathPiece, MathText};
use coupler_curves::geometry::{Point, Similarity, Spline, Vector};
use coupler_curves::path::{Dash, DashPattern, JointPath};
use coupler_curves::text::divide_word;

/// An element, whose geometry is in millimetres from the origin of the area it is drawn on.
pub(super) trait Element {
    /// The item of the page, for the position of that origin on the page.
    fn into_item(self, origin: Vector) -> Item;
}

/// A coupler curve: a group with an id, a title and data attributes.
pub(super) struct CouplerCurve {
    pub id: String,
    pub class: &'static str,
    pub title: String,
    pub data: Vec<(&'static str, String)>,
    /// From the plane to millimetres of the area.
    pub page_from_plane: Similarity,
    /// How the curve is cut into dashes.
    pub dashes: DashPattern,
    /// Its path, already in millimetres of the area.
    pub path: JointPath,
    /// The stroke of the whole path, under the dashes.
    pub hairline: Stroke,
    /// The strokes of the dashes that belong to the figure, and of those that do not.
    pub stroke_styles: [Stroke; 2],
    /// Marks on the curve.
    pub marks: Vec<Circle>,
}

impl Element for CouplerCurve {
    fn into_item(self, origin: Vector) -> Item {
        let drawing_data = self.drawing_data(origin);
        let data = self.data.into_iter().chain(drawing_data).collect();
        let curve = |splines: Vec<Spline>, stroke: Stroke| {
            (!splines.is_empty()).then_some(Item::Curve(Curve { splines, stroke }))
        };
        let (figure, other): (Vec<Dash>, Vec<Dash>) = self.path.dashes.into_iter().partition(|dash| dash.is_in_figure);
        let [figure, other] = [figure, other].map(|dashes| dashes.into_iter().map(|dash| dash.spline).collect());
        let hairline = curve(self.path.whole, self.hairline);
        let [figure_stroke, other_stroke] = self.stroke_styles;
        let paths = [hairline, curve(other, other_stroke), curve(figure, figure_stroke)].into_iter().flatten();
        let mut items: Vec<Item> = paths.chain(self.marks.into_iter().map(Item::Circle)).collect();
        items.iter_mut().for_each(|item| translate(item, origin));
        Item::Group(Group { id: self.id, class: self.class, title: self.title, data, items, ..Group::default() })
    }
}

impl CouplerCurve {
    /// The transform and the dashes of the curve, with which a drawing can be compared with its samples. The numbers
    /// parse to the same `f64`.
    fn drawing_data(&self, origin: Vector) -> Vec<(&'static str, String)> {
        let (scale, at) = (self.page_from_plane.scale(), self.page_from_plane.origin() + origin);
        let DashPattern { period, dash_span } = self.dashes;
        let mut data = vec![
            ("scale", scale.to_string()),
            ("origin", format!("{} {}", at.x, at.y)),
            ("dash", format!("{period} {dash_span}")),
        ];
        if let Some(stretches) = &self.path.dashed_travel {
            let ends: Vec<String> = stretches.iter().flatten().map(f64::to_string).collect();
            data.push(("drawn", ends.join(" ")));
        }
        data
    }
}

/// A group of lines, circles and text, without an id.
pub(super) struct Drawing {
    pub class: &'static str,
    pub title: String,
    pub items: Vec<Item>,
}

impl Element for Drawing {
    fn into_item(mut self, origin: Vector) -> Item {
        self.items.iter_mut().for_each(|item| translate(item, origin));
        Item::Group(Group { class: self.class, title: self.title, items: self.items, ..Group::default() })
    }
}

impl Element for Item {
    fn into_item(mut self, origin: Vector) -> Item {
        translate(&mut self, origin);
        self
    }
}

/// An item elsewhere.
pub(super) fn translated(mut item: Item, by: Vector) -> Item {
    translate(&mut item, by);
    item
}

/// Moves an item.
fn translate(item: &mut Item, by: Vector) {
    match item {
        Item::Group(group) => group.items.iter_mut().for_each(|item| translate(item, by)),
        Item::Path(path) => {
            path.polylines.iter_mut().flat_map(|line| &mut line.points).for_each(|point| *point += by);
        }
        Item::Curve(curve) => curve.splines.iter_mut().for_each(|spline| spline.transform(|point| point + by)),
        Item::Circle(circle) => circle.centre += by,
        Item::Text(text) => text.position += by,
        Item::Animation(moving) => moving.frames.iter_mut().flatten().for_each(|item| translate(item, by)),
    }
}

/// A line of text.
#[derive(Clone)]
pub(super) struct TextLine {
    pub text: Text,
}

impl TextLine {
    /// A line of text at a position of the area, with raised exponents: what follows `^` up to the end of its number, name or parentheses.
    pub fn new(text: &str, typeface: Typeface, at: Point, anchor: Anchor, (size, color): (f64, Color)) -> TextLine {
        let runs = runs_with_exponents(text, typeface.regular());
        TextLine { text: Text { position: at, anchor, size, color, runs, quarter_turns: 0 } }
    }

    /// The text as it was written: an exponent follows `^`.
    fn plain(&self) -> String {
        let mut plain = String::new();
        for run in &self.text.runs {
            plain.extend(run.is_raised.then_some('^'));
            plain.push_str(&run.text);
        }
        plain
    }

    /// A line of mathematical text at a position of the area: symbols in italics, exponents raised, with the characters of typesetting.
    pub fn from_math(
        text: &MathText,
        typeface: Typeface,
        at: Point,
        anchor: Anchor,
        size: f64,
        color: Color,
    ) -> TextLine {
        let run = |piece: &MathPiece| TextRun {
            text: typeset(&piece.text),
            face: Face { typeface, is_italic: piece.is_symbol },
            is_raised: piece.is_raised,
        };
        let runs = text.pieces().iter().map(run).collect();
        TextLine { text: Text { position: at, anchor, size, color, runs, quarter_turns: 0 } }
    }

    /// The line with the words that are single-letter `symbols` in italics.
    pub fn with_italics(mut self, symbols: &[String]) -> TextLine {
        // A single letter, also with an index, is a symbol; a longer name is read as a word.
        let printed = |symbol: &String| MathText::from_name(symbol).pieces().first().cloned();
        let letters: HashSet<String> =
            symbols.iter().filter_map(printed).filter(|piece| piece.is_symbol).map(|piece| piece.text).collect();
        let text = self.plain();
        let mut runs: Vec<TextRun> = Vec::new();
        let typeface = self.text.runs.first().map_or(Typeface::default(), |run| run.face.typeface);
        let mut push = |text: &str, is_italic, is_raised| match runs.last_mut() {
            Some(last) if last.face.is_italic == is_italic && last.is_raised == is_raised => last.text.push_str(text),
            _ => runs.push(TextRun { is_raised, ..TextRun::new(text, Face { typeface, is_italic }) }),
        };
        let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == '\'' || c == '’';
        let mut rest = text.as_str();
        while let Some(c) = rest.chars().next() {
            if let Some(exponent) = exponent(rest) {
                push(exponent, letters.contains(exponent), true);
                rest = &rest[1 + exponent.len()..];
                continue;
            }
            // A word, or a single character between words.
            let word_end = rest.find(|c| !is_word(c)).unwrap_or(rest.len());
            let (piece, after) = rest.split_at(word_end.max(c.len_utf8()));
            let is_symbol = letters.contains(piece) && !is_article(piece, after);
            push(piece, is_symbol || is_defined(piece, after), false);
            rest = after;
        }
        self.text.runs = runs;
        self
    }

    /// The line at another position.
    pub fn moved_to(self, position: Point) -> TextLine {
        TextLine { text: Text { position, ..self.text } }
    }

    /// The line as it is if it fits `width` at no less than [`TextLine::min_part`] of its size; otherwise lines that
    /// do: broken at the separators of its parts if these fit, or else between words at that part of its size. Nothing is left out but what remains
    /// of a word that is wider.
    pub fn fit_or_wrap(mut self, width: f64) -> Vec<TextLine> {
        let least = TextLine::min_part(self.text.size);
        if least * self.text.width() <= width {
            return vec![self.fit_width(width)];
        }
        let text = self.plain();
        if text.split(" · ").any(|part| self.with_words(part).text.width() > width) {
            self.text.size *= least;
        }
        self.wrap_at_separators(width).iter().map(|words| self.with_words(words).fit_width(width)).collect()
    }

    /// The least part of its size that a line may have to fit a width before it is broken: 85 %, but no text becomes
    /// smaller than [`MIN_TEXT_SIZE`].
    pub fn min_part(size: f64) -> f64 {
        (MIN_TEXT_SIZE / size).clamp(0.85, 1.0)
    }

    /// A line like this one with other words, all in the face of its first run.
    fn with_words(&self, words: &str) -> TextLine {
        let runs = self.text.runs.first().map(|run| runs_with_exponents(words, run.face)).unwrap_or_default();
        // Its own words are not copied, since this is called for each word of a text that is broken.
        let Text { position, anchor, size, color, quarter_turns, .. } = self.text;
        TextLine { text: Text { position, anchor, size, color, runs, quarter_turns } }
    }

    /// The text in lines no wider than `width`, broken at the separators of its parts where that is possible, and
    /// otherwise between words.
    pub fn wrap_at_separators(&self, width: f64) -> Vec<String> {
        let text = self.plain();
        let is_wider = |line: &str| self.with_words(line).text.width() > width;
        let mut lines: Vec<String> = Vec::new();
        for part in text.split(" · ").filter(|part| !part.is_empty()) {
            match lines.last_mut() {
                Some(line) if !is_wider(&format!("{line} · {part}")) => {
                    line.push_str(" · ");
                    line.push_str(part);
                }
                _ if is_wider(part) => lines.extend(self.with_words(part).wrap(width)),
                _ => lines.push(part.to_owned()),
            }
        }
        lines
    }

    /// The words of the line in one line, if [`fit_width`](TextLine::fit_width) leaves them whole, or else in several.
    pub fn wrap_unless_it_fits(&self, width: f64) -> Vec<String> {
        let lines = match self.clone().fit_width(width).plain() == self.plain() {
            true => vec![self.plain()],
            false => self.wrap(width),
        };
        lines.into_iter().filter(|line| !line.is_empty()).collect()
    }

    /// The line fitted to `width`: set smaller, down to two thirds but not below [`MIN_TEXT_SIZE`], and then
    /// truncated.
    pub fn fit_width(self, width: f64) -> TextLine {
        self.fit_width_with_suffix("", width)
    }

    /// The line with a suffix, fitted to `width`: set smaller, down to two thirds, and then truncated before the
    /// suffix, which stays whole as long as it fits.
    pub fn fit_width_with_suffix(mut self, suffix: &str, width: f64) -> TextLine {
        let face = self.text.runs.last().map(|run| run.face);
        let suffix_width = |size: f64| face.map_or(0.0, |face| face.width(suffix, size));
        let natural = self.text.width() + suffix_width(self.text.size);
        // Rounding is tolerated: `width` may have been computed from this very text, or the size from `width`.
        let tolerated = width * (1.0 + 1e-9);
        if natural > tolerated {
            let least = (2.0 / 3.0 * self.text.size).max(MIN_TEXT_SIZE.min(self.text.size));
            self.text.size = (self.text.size * width / natural).max(least);
        }
        let width = tolerated;
        if !suffix.is_empty() {
            self.truncate(width - suffix_width(self.text.size));
            match self.text.runs.last_mut() {
                Some(run) => run.text.push_str(suffix),
                // Without text before it, the suffix needs no separator.
                None => self.text.runs.extend(face.map(|face| TextRun::new(suffix.trim_start_matches(" · "), face))),
            }
        }
        self.truncate(width);
        self
    }

    /// Truncates text that is wider than `width`, with an ellipsis.
    ///
    /// Characters are counted from the start of the line, so that the time does not grow with what is left out.
    fn truncate(&mut self, width: f64) {
        let size = self.text.size;
        let mut width_before = 0.0;
        let mut widths_before = Vec::with_capacity(self.text.runs.len());
        for run in &self.text.runs {
            widths_before.push(width_before);
            width_before += run.width(size);
        }
        let mut line_width = width_before;
        while line_width > width {
            let Some(mut run) = self.text.runs.pop() else { break };
            line_width = widths_before[self.text.runs.len()];
            if let Some(end) = truncated_length(&run, run.size(size), width - line_width) {
                run.text.truncate(end);
                run.text.push('…');
                self.text.runs.push(run);
                break;
            }
        }
    }

    /// The text in lines no wider than `width`, broken between words, and in words that are wider; a name stays with its value if both fit a
    /// line.
    pub fn wrap(&self, width: f64) -> Vec<String> {
        let text = self.plain();
        let is_wider = |line: &str| self.with_words(line).text.width() > width;
        let mut lines: Vec<String> = Vec::new();
        let words = equations(&text).into_iter().flat_map(|part| match is_wider(part) {
            true => part.split(' ').collect(),
            false => vec![part],
        });
        for word in words {
            let parts = divide_word(word, |part| !is_wider(part));
            match lines.last_mut() {
                _ if parts.len() > 1 => lines.extend(parts.into_iter().map(str::to_owned)),
                Some(line) if !is_wider(&format!("{line} {word}")) => {
                    line.push(' ');
                    line.push_str(word);
                }
                // At a line break the separator is dropped.
                Some(_) if word == "·" => lines.push(String::new()),
                _ => lines.push(word.to_owned()),
            }
        }
        lines.iter().map(|line| line.trim_start().to_owned()).collect()
    }
}

impl Element for TextLine {
    fn into_item(self, origin: Vector) -> Item {
        Item::Text(self.text).into_item(origin)
    }
}

/// The words of a text; what is on both sides of "=" or "≈" is one of them, and so are an article or pronoun of one letter and
/// the word after it, and a letter and a number after it.
fn equations(text: &str) -> Vec<&str> {
    let mut words = Vec::new();
    let mut start = 0;
    for (at, _) in text.match_indices(' ') {
        let last = text[start..at].rsplit(' ').next().unwrap_or_default();
        let is_letter = last.len() == 1 && last.starts_with(|c: char| c.is_ascii_alphabetic());
        let is_number = text[at + 1..].starts_with(|c: char| c.is_ascii_digit() || c == '−');
        if !(matches!(last, "a" | "A" | "I")
            || is_letter && is_number
            || begins_with_value(&text[at..])
            || [" =", " ≈"].iter().any(|sign| text[..at].ends_with(sign)))
        {
            words.push(&text[start..at]);
            start = at + 1;
        }
    }
    words.push(&text[start..]);
    words
}

/// A text in runs: its exponents are raised.
fn runs_with_exponents(text: &str, face: Face) -> Vec<TextRun> {
    let mut runs = vec![TextRun::new("", face)];
    let mut rest = text;
    while let Some(at) = rest.find('^') {
        let (before, from) = rest.split_at(at);
        let exponent = exponent(from);
        // Without an exponent, the character is one of the text.
        let taken = exponent.map_or(1, |exponent| 1 + exponent.len());
        let last = runs.len() - 1;
        runs[last].text.push_str(if exponent.is_some() { before } else { &rest[..=at] });
        if let Some(exponent) = exponent {
            runs.push(TextRun { is_raised: true, ..TextRun::new(exponent, face) });
            runs.push(TextRun::new("", face));
        }
        rest = &from[taken..];
    }
    let last = runs.len() - 1;
    runs[last].text.push_str(rest);
    let is_plain = runs.len() == 1;
    runs.retain(|run| is_plain || !run.text.is_empty());
    runs
}

/// The exponent at the start of a text, after its `^`: a number, a name, or what parentheses enclose, with them.
fn exponent(text: &str) -> Option<&str> {
    let rest = text.strip_prefix('^')?;
    let is_part = |c: char| c.is_alphanumeric() || matches!(c, '.' | '_' | '−');
    let length = match rest.strip_prefix('(') {
        Some(inner) => inner.find(')')? + 2,
        None => rest.find(|c| !is_part(c)).unwrap_or(rest.len()),
    };
    // A full stop ends a sentence.
    let exponent = rest[..length].trim_end_matches('.');
    (!exponent.is_empty()).then_some(exponent)
}

/// The length in bytes of the longest beginning of a run that fits `width` with an ellipsis after it; `None` if none
/// does. It is shorter than the run, and does not end with a space or an ellipsis.
fn truncated_length(run: &TextRun, size: f64, width: f64) -> Option<usize> {
    let text = run.text.trim_end_matches('…');
    let ellipsis = run.face.advance('…');
    // The advance of the characters so far, and the end of the last that is not a space.
    let (mut advance, mut end) = (0.0, 0);
    let mut found = None;
    for (at, c) in text.char_indices() {
        if at + c.len_utf8() == text.len() {
            break;
        }
        advance += run.face.advance(c);
        if !c.is_whitespace() {
            if (advance + ellipsis) * size > width {
                return found;
            }
            end = at + c.len_utf8();
        }
        if found.is_some() || ellipsis * size <= width {
            found = Some(end);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::FontFamily;

    fn sans(text: &str) -> TextLine {
        TextLine::new(text, FontFamily::Sans.into(), Point::origin(), Anchor::Start, (3.0, Color(0, 0, 0)))
    }

    #[test]
    fn single_letters_that_are_parameters_are_italic() {
        let symbols = ["p".to_owned(), "frame".to_owned()];
        let runs = sans("p = 2, prop frame's p's").with_italics(&symbols).text.runs;
        let sans = Typeface::from(FontFamily::Sans);
        let texts: Vec<(&str, Face)> = runs.iter().map(|run| (run.text.as_str(), run.face)).collect();
        assert_eq!(texts, [("p", sans.italic()), (" = 2, prop frame's p's", sans.regular())]);
    }

    #[test]
    fn exponents_are_raised() {
        let symbols = ["p".to_owned()];
        let runs = sans("µ, (1 + p)^1.5 / 2 and 2^p. x^").with_italics(&symbols).text.runs;
        let raised: Vec<(&str, bool)> =
            runs.iter().filter(|run| run.is_raised).map(|run| (run.text.as_str(), run.face.is_italic)).collect();
        assert_eq!(raised, [("1.5", false), ("p", true)]);
        assert_eq!(runs.iter().map(|run| run.text.as_str()).collect::<String>(), "µ, (1 + p)1.5 / 2 and 2p. x^");
        // Also in lines without symbols, of the smallest size, and in those that are broken.
        let raised = |line: &TextLine| line.text.runs.iter().filter(|run| run.is_raised).count();
        assert_eq!([raised(&sans("x^2 + y^2 = 1")), raised(&sans("x^ ^2^3"))], [2, 2]);
        assert_eq!(sans("^ x^2").plain(), "^ x^2");
        let run = TextRun { is_raised: true, ..TextRun::new("2", Typeface::from(FontFamily::Sans).regular()) };
        assert!(run.size(MIN_TEXT_SIZE) < 0.8 * MIN_TEXT_SIZE);
        let broken = sans("one x^2 two x^3").fit_or_wrap(sans("one x^2").text.width());
        assert_eq!(broken.iter().map(raised).collect::<Vec<_>>(), [1, 1]);
    }

    #[test]
    fn a_long_line_is_set_smaller_and_then_truncated() {
        let natural = sans("a line of some length").text.width();
        let smaller = sans("a line of some length").fit_width(0.9 * natural).text;
        assert!(smaller.width() <= 0.9 * natural * 1.000_001 && smaller.runs[0].text.ends_with("length"));
        let cut = sans("a line of some length").fit_width(0.3 * natural).text;
        assert!(cut.width() <= 0.3 * natural && cut.runs[0].text.ends_with('…'));
        assert!(sans("a").fit_width(0.0).text.runs.is_empty());
        let suffixed = sans("a line of some length").fit_width_with_suffix(", page 1", 0.6 * natural).text;
        assert!(suffixed.width() <= 0.6 * natural && suffixed.runs[0].text.ends_with("…, page 1"), "{suffixed:?}");
        // A line is not truncated to its own width, even if rounding makes that a little smaller.
        for k in 1..200 {
            let before = 0.37 * f64::from(k);
            let width = (before + natural) - before;
            assert_eq!(sans("a line of some length").fit_width(width).text, sans("a line of some length").text, "{k}");
        }
    }

    /// Truncates a character at a time.
    fn truncate_slowly(mut line: TextLine, width: f64) -> Text {
        while line.text.width() > width {
            match line.text.runs.last_mut() {
                Some(run) if run.text.chars().count() > 1 => {
                    let mut shorter = run.text.trim_end_matches('…').to_owned();
                    shorter.pop();
                    run.text = format!("{}…", shorter.trim_end());
                    if shorter.is_empty() {
                        line.text.runs.pop();
                    }
                }
                _ => drop(line.text.runs.pop()),
            }
        }
        line.text
    }

    #[test]
    fn as_much_of_a_line_as_fits_is_kept() {
        let symbols = ["p".to_owned()];
        for text in ["p = 2, a line of p's and  spaces ", "pp", "p p p p", "…", "é p ü", "p"] {
            let natural = sans(text).with_italics(&symbols).text.width();
            for k in 0..=100 {
                let width = natural * f64::from(k) / 99.5;
                let mut line = sans(text).with_italics(&symbols);
                line.truncate(width);
                assert_eq!(line.text, truncate_slowly(sans(text).with_italics(&symbols), width), "{text} {width}");
            }
        }
        assert!(sans(&"word ".repeat(200_000)).fit_width(100.0).text.width() <= 100.0);
    }
}
