use std::borrow::Cow;

use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

use super::path::{self, Fault};
use super::{DrawnCurve, DrawnError};
use coupler_curves::geometry::{Point, Similarity};

/// The most points of a page's curves that are read; pages have some thousands.
const MOST_POINTS: usize = 2_000_000;

/// The coupler curves of a page in SVG, in the order in which they are drawn.
///
/// It takes as much memory as their points, and time in proportion to the bytes.
///
/// # Errors
/// The first that is found; see [`DrawnError`]. A page that is cut short anywhere before its last character is one.
pub fn drawn_curves(svg: &[u8]) -> Result<Vec<DrawnCurve>, DrawnError> {
    let text = std::str::from_utf8(svg).map_err(|_| DrawnError::NotText)?;
    let mut xml = Reader::from_str(text);
    let mut page = Page { room: MOST_POINTS, ..Page::default() };
    loop {
        page.at = xml.buffer_position();
        match xml.read_event() {
            Ok(Event::Start(element)) => page.open(&element)?,
            Ok(Event::Empty(element)) => {
                page.open(&element)?;
                page.close();
            }
            Ok(Event::End(_)) => page.close(),
            // It may define entities, and give any element any attribute.
            Ok(Event::DocType(_)) => return Err(DrawnError::Foreign { part: "document type" }),
            Ok(Event::Eof) => return page.end(),
            Ok(_) => {}
            Err(error) => return Err(page.not_xml(&error)),
        }
    }
}

/// A page as far as it is read.
#[derive(Default)]
struct Page {
    /// How many bytes are read.
    at: u64,
    /// How many elements are open.
    depth: usize,
    has_root: bool,
    /// The depth of the outermost open element that no curve may be in, and why.
    barrier: Option<(usize, Barrier)>,
    /// The depth of the curve that is open, the last of the curves.
    within: Option<usize>,
    curves: Vec<DrawnCurve>,
    /// How many points may still be read.
    room: usize,
}

/// Why no curve may be in an element.
enum Barrier {
    /// It has this attribute.
    Attribute(&'static str),
    /// It is neither the page nor a group.
    Element(String),
}

impl Page {
    fn open(&mut self, element: &BytesStart) -> Result<(), DrawnError> {
        self.depth += 1;
        let name = element.name().0;
        if let Some(part) = ["style", "script"].into_iter().find(|part| *part == name) {
            return Err(DrawnError::Foreign { part: if part == "style" { "style sheet" } else { part } });
        }
        if self.depth == 1 {
            return self.root(element);
        }
        if self.within.is_some() {
            return self.part(element);
        }
        if name != "g" {
            self.bar(Barrier::Element(clipped(name)));
            return Ok(());
        }
        let [class, transform, style] = self.attributes(element, ["class", "transform", "style"])?;
        if let Some(attribute) = moved(transform.is_some(), style.is_some()) {
            self.bar(Barrier::Attribute(attribute));
        }
        if class.as_deref() == Some("curve") { self.curve(element) } else { Ok(()) }
    }

    /// The page itself.
    fn root(&mut self, element: &BytesStart) -> Result<(), DrawnError> {
        if element.name().0 != "svg" || self.has_root {
            return Err(DrawnError::NotSvg);
        }
        self.has_root = true;
        let names = ["width", "height", "viewBox", "transform", "style"];
        let [width, height, view, transform, style] = self.attributes(element, names)?;
        let millimetres = |length: &Option<Cow<str>>| length.as_deref()?.strip_suffix("mm").map(str::to_owned);
        let whole = millimetres(&width).zip(millimetres(&height)).map(|(w, h)| format!("0 0 {w} {h}"));
        if whole.is_none() || view.as_deref() != whole.as_deref() {
            return Err(DrawnError::NotInMillimetres);
        }
        // The style of a page is one of its lettering.
        let is_style = style.is_some_and(|style| style.split(';').any(|part| !part.trim_start().starts_with("font-")));
        if let Some(attribute) = moved(transform.is_some(), is_style) {
            self.bar(Barrier::Attribute(attribute));
        }
        Ok(())
    }

    /// Remembers that nothing in this element may be a curve, unless that is so already.
    fn bar(&mut self, barrier: Barrier) {
        self.barrier.get_or_insert((self.depth, barrier));
    }

    /// The group of a curve.
    fn curve(&mut self, element: &BytesStart) -> Result<(), DrawnError> {
        const NAMES: [&str; 7] =
            ["id", "data-cell", "data-trace", "data-circuit", "data-scale", "data-origin", "data-dash"];
        let values = self.attributes(element, NAMES)?;
        let curve = values[0].as_deref().map(clipped).unwrap_or_default();
        match &self.barrier {
            Some((_, Barrier::Attribute(attribute))) => return Err(DrawnError::Moved { curve, attribute }),
            Some((_, Barrier::Element(element))) => {
                return Err(DrawnError::Misplaced { curve, element: element.clone() });
            }
            None => {}
        }
        if let Some(k) = values.iter().position(Option::is_none) {
            return Err(DrawnError::Missing { curve, attribute: NAMES[k] });
        }
        let [id, cell, trace, circuit, scale, origin, dash] = values.map(Option::unwrap_or_default);
        let fact = |k: usize, value: &str| Fact { curve: &curve, attribute: NAMES[k], value: value.to_owned() };
        let scale = fact(4, &scale).numbers("a positive number", |[scale]: &[f64; 1]| *scale > 0.0)?[0];
        let [x, y] = fact(5, &origin).numbers("two numbers", |_| true)?;
        let expected = "two positive numbers, the second not above the first";
        let dash = fact(6, &dash).numbers(expected, |[period, drawn]| 0.0 < *drawn && drawn <= period)?;
        self.curves.push(DrawnCurve {
            cell: fact(1, &cell).count()?,
            trace: fact(2, &trace).count()?,
            circuit: fact(3, &circuit).count()?,
            id: id.into_owned(),
            page_from_plane: Similarity { scale, flips_y: true, origin: Point::new(x, y) },
            dash,
            lines: Vec::new(),
        });
        self.within = Some(self.depth);
        Ok(())
    }

    /// An element in a curve: its title, its dashes and the dots of its limits.
    fn part(&mut self, element: &BytesStart) -> Result<(), DrawnError> {
        let Some(open) = self.curves.last() else { return Ok(()) };
        let curve = clipped(&open.id);
        let name = element.name().0;
        if !["title", "path", "circle"].contains(&name) {
            return Err(DrawnError::Misplaced { curve, element: clipped(name) });
        }
        let [transform, style, data] = self.attributes(element, ["transform", "style", "d"])?;
        if let Some(attribute) = moved(transform.is_some(), style.is_some()) {
            return Err(DrawnError::Moved { curve, attribute });
        }
        if let Some(data) = data.filter(|_| name == "path") {
            let lines = path::lines(&data, &mut self.room).map_err(|fault| match fault {
                Fault::NotLines => DrawnError::NotLines { curve },
                Fault::NoRoom => DrawnError::TooLarge { most: MOST_POINTS },
            })?;
            if let Some(open) = self.curves.last_mut() {
                open.lines.extend(lines);
            }
        }
        Ok(())
    }

    fn close(&mut self) {
        if self.within == Some(self.depth) {
            self.within = None;
        }
        if self.barrier.as_ref().is_some_and(|(depth, _)| *depth == self.depth) {
            self.barrier = None;
        }
        // The reader has found that what is closed was open.
        self.depth = self.depth.saturating_sub(1);
    }

    fn end(self) -> Result<Vec<DrawnCurve>, DrawnError> {
        match (self.depth, self.has_root) {
            (0, true) => Ok(self.curves),
            (0, false) => Err(DrawnError::NotSvg),
            _ => Err(DrawnError::BreaksOff),
        }
    }

    /// The values of some attributes of an element. Only these are looked at twice, so that any number of others takes
    /// no more time than it takes to pass over them.
    fn attributes<'a, const N: usize>(
        &self,
        element: &'a BytesStart,
        names: [&str; N],
    ) -> Result<[Option<Cow<'a, str>>; N], DrawnError> {
        let mut values = [const { None }; N];
        for attribute in element.attributes().with_checks(false) {
            let attribute = attribute.map_err(|error| self.not_xml(&error))?;
            let Some(k) = names.iter().position(|name| *name == attribute.key.0) else { continue };
            let value = attribute.normalized_value(XmlVersion::Explicit1_0).map_err(|error| self.not_xml(&error))?;
            if values[k].replace(value).is_some() {
                return Err(self.not_xml(&"an attribute stands twice"));
            }
        }
        Ok(values)
    }

    fn not_xml(&self, reason: &dyn std::fmt::Display) -> DrawnError {
        DrawnError::NotXml { at: self.at, reason: clipped(&reason.to_string()) }
    }
}

/// The attribute that moves an element, if any.
fn moved(transform: bool, style: bool) -> Option<&'static str> {
    if transform { Some("transform") } else { style.then_some("style") }
}

/// An attribute of a curve, and what is to be said if it is wrong.
struct Fact<'a> {
    curve: &'a str,
    attribute: &'static str,
    value: String,
}

impl Fact<'_> {
    fn count(&self) -> Result<usize, DrawnError> {
        self.value.parse().map_err(|_| self.is_not("a whole number"))
    }

    /// So many finite numbers with spaces between them.
    fn numbers<const N: usize>(
        &self,
        expected: &'static str,
        is_right: impl Fn(&[f64; N]) -> bool,
    ) -> Result<[f64; N], DrawnError> {
        let words = self.value.split_ascii_whitespace().take(N + 1);
        let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok().filter(|x: &f64| x.is_finite())).collect();
        let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
        numbers.filter(is_right).ok_or_else(|| self.is_not(expected))
    }

    fn is_not(&self, expected: &'static str) -> DrawnError {
        let Fact { curve, attribute, value } = self;
        DrawnError::NotANumber { curve: (*curve).to_owned(), attribute, value: clipped(value), expected }
    }
}

/// A text, or as much of the beginning of it as a message has room for.
fn clipped(text: &str) -> String {
    const MOST: usize = 80;
    let mut clipped: String = text.chars().take(MOST).collect();
    if clipped.len() < text.len() {
        clipped.push('…');
    }
    clipped
}
