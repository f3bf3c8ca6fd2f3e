//! Reads the coupler curves of an SVG page.

use std::borrow::Cow;

use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

use super::path::{self, PathError};
use super::{DrawnCurve, DrawnCurveError};
use coupler_curves::geometry::{Point, Similarity};

/// The most points of all curves of a page, as chords; pages have some ten thousands.
const MAX_POINTS: usize = 2_000_000;

/// Reads the coupler curves of an SVG page, in the order in which they are drawn.
///
/// Memory is proportional to their points, and time to the bytes of the page.
///
/// # Errors
/// The first error found, see [`DrawnCurveError`]. A page truncated anywhere before its last character is an error.
pub fn read_drawn_curves(svg: &[u8]) -> Result<Vec<DrawnCurve>, DrawnCurveError> {
    let text = std::str::from_utf8(svg).map_err(|_| DrawnCurveError::NotUtf8)?;
    let mut xml = Reader::from_str(text);
    let mut page = PageReader { points_left: MAX_POINTS, ..PageReader::default() };
    loop {
        page.position = xml.buffer_position();
        match xml.read_event() {
            Ok(Event::Start(element)) => page.start_element(&element)?,
            Ok(Event::Empty(element)) => {
                page.start_element(&element)?;
                page.end_element();
            }
            Ok(Event::End(_)) => page.end_element(),
            // A document type may define entities, and give any element any attribute.
            Ok(Event::DocType(_)) => return Err(DrawnCurveError::UnsupportedPart { part: "document type" }),
            Ok(Event::Eof) => return page.finish(),
            Ok(_) => {}
            Err(error) => return Err(page.xml_error(&error)),
        }
    }
}

/// The state of reading a page.
#[derive(Default)]
struct PageReader {
    /// The number of bytes read.
    position: u64,
    /// The number of open elements.
    depth: usize,
    has_root: bool,
    /// The depth of the outermost open element in which no curve may be, and why.
    barrier: Option<(usize, Barrier)>,
    /// The depth of the open curve, which is the last of `curves`.
    curve_depth: Option<usize>,
    /// Whether no path of the open curve has been read.
    expects_hairline: bool,
    curves: Vec<DrawnCurve>,
    /// The number of points that may still be read.
    points_left: usize,
}

/// Why no curve may be inside an element.
enum Barrier {
    /// It has this attribute.
    Attribute(&'static str),
    /// It is neither the page nor a group.
    Element(String),
}

impl PageReader {
    fn start_element(&mut self, element: &BytesStart) -> Result<(), DrawnCurveError> {
        self.depth += 1;
        let name = element.name().0;
        if let Some(part) = ["style", "script"].into_iter().find(|part| *part == name) {
            return Err(DrawnCurveError::UnsupportedPart { part: if part == "style" { "style sheet" } else { part } });
        }
        if self.depth == 1 {
            return self.start_root(element);
        }
        if self.curve_depth.is_some() {
            return self.start_curve_child(element);
        }
        if name != "g" {
            self.set_barrier(Barrier::Element(shorten(name)));
            return Ok(());
        }
        let [class, transform, style] = self.read_attributes(element, ["class", "transform", "style"])?;
        if let Some(attribute) = moving_attribute(transform.is_some(), style.is_some()) {
            self.set_barrier(Barrier::Attribute(attribute));
        }
        if class.as_deref() == Some("curve") { self.start_curve(element) } else { Ok(()) }
    }

    /// Reads the root element.
    fn start_root(&mut self, element: &BytesStart) -> Result<(), DrawnCurveError> {
        if element.name().0 != "svg" || self.has_root {
            return Err(DrawnCurveError::NotSvg);
        }
        self.has_root = true;
        let names = ["width", "height", "viewBox", "transform", "style"];
        let [width, height, view, transform, style] = self.read_attributes(element, names)?;
        let millimetres = |length: &Option<Cow<str>>| length.as_deref()?.strip_suffix("mm").map(str::to_owned);
        let whole = millimetres(&width).zip(millimetres(&height)).map(|(w, h)| format!("0 0 {w} {h}"));
        if whole.is_none() || view.as_deref() != whole.as_deref() {
            return Err(DrawnCurveError::NotInMillimetres);
        }
        // The style of a page may only set its fonts.
        let has_other_style =
            style.is_some_and(|style| style.split(';').any(|part| !part.trim_start().starts_with("font-")));
        if let Some(attribute) = moving_attribute(transform.is_some(), has_other_style) {
            self.set_barrier(Barrier::Attribute(attribute));
        }
        Ok(())
    }

    /// Marks the current element as one in which no curve may be, unless an outer element is marked already.
    fn set_barrier(&mut self, barrier: Barrier) {
        self.barrier.get_or_insert((self.depth, barrier));
    }

    /// Reads the group of a curve.
    fn start_curve(&mut self, element: &BytesStart) -> Result<(), DrawnCurveError> {
        const NAMES: [&str; 7] =
            ["id", "data-cell", "data-trace", "data-circuit", "data-scale", "data-origin", "data-dash"];
        const DRAWN: &str = "data-drawn";
        let values = self.read_attributes(element, NAMES)?;
        let [drawn] = self.read_attributes(element, [DRAWN])?;
        let curve = values[0].as_deref().map(shorten).unwrap_or_default();
        match &self.barrier {
            Some((_, Barrier::Attribute(attribute))) => return Err(DrawnCurveError::Transformed { curve, attribute }),
            Some((_, Barrier::Element(element))) => {
                return Err(DrawnCurveError::UnexpectedNesting { curve, element: element.clone() });
            }
            None => {}
        }
        if let Some(k) = values.iter().position(Option::is_none) {
            return Err(DrawnCurveError::MissingAttribute { curve, attribute: NAMES[k] });
        }
        let [id, cell, trace, circuit, scale, origin, dash] = values.map(Option::unwrap_or_default);
        let curve_attribute =
            |k: usize, value: &str| CurveAttribute { curve_id: &curve, name: NAMES[k], value: value.to_owned() };
        let stretches = |value: Cow<str>| {
            CurveAttribute { curve_id: &curve, name: DRAWN, value: value.into_owned() }.parse_stretches()
        };
        let scale =
            curve_attribute(4, &scale).parse_numbers("a positive number", |[scale]: &[f64; 1]| *scale > 0.0)?[0];
        let [x, y] = curve_attribute(5, &origin).parse_numbers("two numbers", |_| true)?;
        let expected = "two positive numbers, the second not above the first";
        let dash =
            curve_attribute(6, &dash).parse_numbers(expected, |[period, drawn]| 0.0 < *drawn && drawn <= period)?;
        self.curves.push(DrawnCurve {
            cell: curve_attribute(1, &cell).parse_count()?,
            trace: curve_attribute(2, &trace).parse_count()?,
            circuit: curve_attribute(3, &circuit).parse_count()?,
            id: id.into_owned(),
            page_from_plane: Similarity::with_y_down(scale, Point::new(x, y)),
            dash,
            dashed_travel: drawn.map(stretches).transpose()?,
            hairline: Vec::new(),
            dashes: Vec::new(),
        });
        self.curve_depth = Some(self.depth);
        self.expects_hairline = true;
        Ok(())
    }

    /// Reads an element of a curve: its title, its dashes, or the dot of a limit.
    fn start_curve_child(&mut self, element: &BytesStart) -> Result<(), DrawnCurveError> {
        let Some(open) = self.curves.last() else { return Ok(()) };
        let curve = shorten(&open.id);
        let name = element.name().0;
        if !["title", "path", "circle"].contains(&name) {
            return Err(DrawnCurveError::UnexpectedNesting { curve, element: shorten(name) });
        }
        let [transform, style, data] = self.read_attributes(element, ["transform", "style", "d"])?;
        if let Some(attribute) = moving_attribute(transform.is_some(), style.is_some()) {
            return Err(DrawnCurveError::Transformed { curve, attribute });
        }
        if let Some(data) = data.filter(|_| name == "path") {
            let splines = path::parse_splines(&data, &mut self.points_left).map_err(|error| match error {
                PathError::NotSplines => DrawnCurveError::NotSplines { curve },
                PathError::TooManyPoints => DrawnCurveError::TooManyPoints { max_points: MAX_POINTS },
            })?;
            if let Some(open) = self.curves.last_mut() {
                // The first path is that of the whole curve, the others are its dashes.
                let is_first = std::mem::take(&mut self.expects_hairline);
                if is_first { open.hairline = splines } else { open.dashes.extend(splines) }
            }
        }
        Ok(())
    }

    fn end_element(&mut self) {
        if self.curve_depth == Some(self.depth) {
            self.curve_depth = None;
        }
        if self.barrier.as_ref().is_some_and(|(depth, _)| *depth == self.depth) {
            self.barrier = None;
        }
        // The XML reader has checked that the element was open.
        self.depth = self.depth.saturating_sub(1);
    }

    fn finish(self) -> Result<Vec<DrawnCurve>, DrawnCurveError> {
        match (self.depth, self.has_root) {
            (0, true) => Ok(self.curves),
            (0, false) => Err(DrawnCurveError::NotSvg),
            _ => Err(DrawnCurveError::Truncated),
        }
    }

    /// The values of some attributes of an element. Only these are checked for repetition, so that the time is linear
    /// in the number of attributes.
    fn read_attributes<'a, const N: usize>(
        &self,
        element: &'a BytesStart,
        names: [&str; N],
    ) -> Result<[Option<Cow<'a, str>>; N], DrawnCurveError> {
        let mut values = [const { None }; N];
        for attribute in element.attributes().with_checks(false) {
            let attribute = attribute.map_err(|error| self.xml_error(&error))?;
            let Some(k) = names.iter().position(|name| *name == attribute.key.0) else { continue };
            let value = attribute.normalized_value(XmlVersion::Explicit1_0).map_err(|error| self.xml_error(&error))?;
            if values[k].replace(value).is_some() {
                return Err(self.xml_error(&"an attribute is repeated"));
            }
        }
        Ok(values)
    }

    fn xml_error(&self, reason: &dyn std::fmt::Display) -> DrawnCurveError {
        DrawnCurveError::NotXml { byte_offset: self.position, reason: shorten(&reason.to_string()) }
    }
}

/// The attribute that may move an element, if it has one.
fn moving_attribute(transform: bool, style: bool) -> Option<&'static str> {
    if transform { Some("transform") } else { style.then_some("style") }
}

/// An attribute of a curve, with what its errors need.
struct CurveAttribute<'a> {
    curve_id: &'a str,
    name: &'static str,
    value: String,
}

impl CurveAttribute<'_> {
    fn parse_count(&self) -> Result<usize, DrawnCurveError> {
        self.value.parse().map_err(|_| self.invalid_attribute("a whole number"))
    }

    /// Parses the ends of stretches: finite numbers that do not fall, separated by spaces.
    fn parse_stretches(&self) -> Result<Vec<[f64; 2]>, DrawnCurveError> {
        let words = self.value.split_ascii_whitespace();
        let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok().filter(|x: &f64| x.is_finite())).collect();
        let numbers = numbers.filter(|numbers| numbers.len().is_multiple_of(2) && numbers.is_sorted());
        let pairs = numbers.map(|numbers| numbers.as_chunks().0.to_vec());
        pairs.ok_or_else(|| self.invalid_attribute("pairs of rising numbers"))
    }

    /// Parses finite numbers separated by spaces.
    fn parse_numbers<const N: usize>(
        &self,
        expected: &'static str,
        is_valid: impl Fn(&[f64; N]) -> bool,
    ) -> Result<[f64; N], DrawnCurveError> {
        let words = self.value.split_ascii_whitespace().take(N + 1);
        let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok().filter(|x: &f64| x.is_finite())).collect();
        let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
        numbers.filter(is_valid).ok_or_else(|| self.invalid_attribute(expected))
    }

    fn invalid_attribute(&self, expected: &'static str) -> DrawnCurveError {
        let CurveAttribute { curve_id: curve, name: attribute, value } = self;
        DrawnCurveError::InvalidAttribute { curve: (*curve).to_owned(), attribute, value: shorten(value), expected }
    }
}

/// Shortens a text for a message.
fn shorten(text: &str) -> String {
    const MAX_CHARACTERS: usize = 80;
    let mut clipped: String = text.chars().take(MAX_CHARACTERS).collect();
    if clipped.len() < text.len() {
        clipped.push('…');
    }
    clipped
}
