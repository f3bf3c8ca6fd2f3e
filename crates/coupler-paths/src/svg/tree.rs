//! The elements of a drawing in SVG.

use std::collections::HashMap;

use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

/// The most elements of a drawing.
const MAX_ELEMENTS: usize = 200_000;

/// The most elements that are nested.
const MAX_DEPTH: usize = 200;

/// The attributes that are kept.
const ATTRIBUTES: [&str; 38] = [
    "id",
    "class",
    "style",
    "transform",
    "d",
    "points",
    "x",
    "y",
    "width",
    "height",
    "rx",
    "ry",
    "r",
    "cx",
    "cy",
    "x1",
    "y1",
    "x2",
    "y2",
    "href",
    "viewBox",
    "preserveAspectRatio",
    "display",
    "visibility",
    "fill",
    "stroke",
    "stroke-width",
    "opacity",
    "fill-opacity",
    "stroke-opacity",
    "font-size",
    "data-scale",
    "data-origin",
    "requiredExtensions",
    "requiredFeatures",
    "systemLanguage",
    "type",
    "color",
];

/// An element.
#[derive(Debug)]
pub(super) struct Element {
    /// Without its prefix.
    pub name: String,
    attributes: Vec<(&'static str, String)>,
    pub parent: Option<usize>,
    pub children: Vec<usize>,
    /// Its place among those of its parent.
    pub place: usize,
}

impl Element {
    pub fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(own, _)| *own == name).map(|(_, value)| value.as_str())
    }
}

/// All elements, the root first, and the text of the style sheets.
#[derive(Debug)]
pub(super) struct Tree {
    pub elements: Vec<Element>,
    pub style_sheet: String,
    ids: HashMap<String, usize>,
}

impl Tree {
    /// # Errors
    /// The drawing is not well-formed, or too large.
    pub fn parse(text: &str) -> Result<Tree, String> {
        let mut tree = Tree { elements: Vec::new(), style_sheet: String::new(), ids: HashMap::new() };
        let mut open: Vec<usize> = Vec::new();
        let mut xml = Reader::from_str(text);
        loop {
            let event = xml.read_event().map_err(|error| {
                let line = 1 + text[..(xml.error_position() as usize).min(text.len())].matches('\n').count();
                format!("the drawing is not well-formed: line {line}: {error}")
            })?;
            match event {
                Event::Start(element) => {
                    if open.len() >= MAX_DEPTH {
                        return Err(format!("the elements of the drawing are nested more than {MAX_DEPTH} deep"));
                    }
                    open.push(tree.add(&element, open.last().copied())?);
                }
                Event::Empty(element) => drop(tree.add(&element, open.last().copied())?),
                Event::End(_) => drop(open.pop()),
                Event::Text(text) if tree.is_style(&open) => tree.style_sheet += &text.into_inner(),
                Event::CData(text) if tree.is_style(&open) => tree.style_sheet += &text.into_inner(),
                Event::Eof if open.is_empty() => return Ok(tree),
                Event::Eof => return Err("the drawing is not well-formed: it ends within an element".to_owned()),
                _ => {}
            }
        }
    }

    fn is_style(&self, open: &[usize]) -> bool {
        open.last().is_some_and(|last| self.elements[*last].name == "style")
    }

    fn add(&mut self, element: &BytesStart, parent: Option<usize>) -> Result<usize, String> {
        let index = self.elements.len();
        if index >= MAX_ELEMENTS {
            return Err(format!("the drawing has more than {MAX_ELEMENTS} elements: leave some out"));
        }
        let error = |error: String| format!("an attribute of the drawing cannot be read: {error}");
        let mut attributes = Vec::new();
        for attribute in element.attributes() {
            let attribute = attribute.map_err(|cause| error(cause.to_string()))?;
            let key = attribute.key.as_ref();
            let key = key.strip_prefix("xlink:").unwrap_or(key);
            let Some(name) = ATTRIBUTES.iter().find(|name| **name == key) else { continue };
            // An entity of the document's own, as Illustrator has for extensions, is kept as it is written.
            let value = attribute.normalized_value(XmlVersion::Explicit1_0);
            let value = value.unwrap_or_else(|_| attribute.value.clone());
            attributes.push((*name, value.into_owned()));
        }
        let place = parent.map_or(0, |parent| self.elements[parent].children.len());
        let name = element.local_name().as_ref().to_owned();
        let element = Element { name, attributes, parent, children: Vec::new(), place };
        if let Some(id) = element.attribute("id") {
            self.ids.entry(id.to_owned()).or_insert(index);
        }
        self.elements.push(element);
        if let Some(parent) = parent {
            self.elements[parent].children.push(index);
        }
        Ok(index)
    }

    /// The element that a link such as `#id` names.
    pub fn linked(&self, link: &str) -> Option<usize> {
        self.ids.get(link.trim().strip_prefix('#')?).copied()
    }

    /// The id of an element or of the nearest of those that it is in.
    pub fn nearest_id(&self, index: usize) -> Option<&str> {
        let mut next = Some(index);
        while let Some(index) = next {
            if let Some(id) = self.elements[index].attribute("id").filter(|id| !id.is_empty()) {
                return Some(id);
            }
            next = self.elements[index].parent;
        }
        None
    }
}
