//! What of a drawing in SVG is shown, and how.

use std::str::FromStr;

use simplecss::{AttributeOperator, Declaration, DeclarationTokenizer, PseudoClass, StyleSheet};
use svgtypes::Color;

use super::tree::Tree;

/// The properties of an element that decide whether its outline is seen.
#[derive(Clone, Debug)]
pub(super) struct Style {
    /// Whether neither it nor what is in it is shown.
    pub is_hidden: bool,
    is_visible: bool,
    fill: String,
    stroke: String,
    stroke_width: String,
    fill_opacity: String,
    stroke_opacity: String,
    /// In user units.
    pub font_size: f64,
    /// A transform that style sheets give to the element itself.
    pub transform: Option<String>,
}

impl Style {
    /// That of what surrounds the drawing.
    pub fn initial() -> Style {
        let text = str::to_owned;
        Style {
            is_hidden: false,
            is_visible: true,
            fill: text("black"),
            stroke: text("none"),
            stroke_width: text("1"),
            fill_opacity: text("1"),
            stroke_opacity: text("1"),
            font_size: 16.0,
            transform: None,
        }
    }

    /// Whether the outline of a shape is drawn as a line.
    pub fn is_stroked(&self) -> bool {
        self.is_visible && is_paint(&self.stroke) && !is_zero(&self.stroke_opacity) && !is_zero(&self.stroke_width)
    }

    /// Whether the area of a shape is filled.
    pub fn is_filled(&self) -> bool {
        self.is_visible && is_paint(&self.fill) && !is_zero(&self.fill_opacity)
    }

    /// Lines that are alike have the same text.
    pub fn stroke_key(&self) -> String {
        format!("{} {}", self.stroke, self.stroke_width)
    }

    fn set(&mut self, name: &str, value: &str) {
        let value = value.trim();
        if value == "inherit" {
            return;
        }
        match name {
            "display" => self.is_hidden |= value == "none",
            "visibility" => self.is_visible = value == "visible",
            "opacity" => self.is_hidden |= is_zero(value),
            "transform" => self.transform = Some(value.to_owned()).filter(|value| value != "none"),
            "fill" => value.clone_into(&mut self.fill),
            "stroke" => value.clone_into(&mut self.stroke),
            "stroke-width" => value.clone_into(&mut self.stroke_width),
            "fill-opacity" => value.clone_into(&mut self.fill_opacity),
            "stroke-opacity" => value.clone_into(&mut self.stroke_opacity),
            "font-size" => {
                let pixels = value.trim_end_matches("px").parse().ok().filter(|size: &f64| size.is_finite());
                self.font_size = pixels.unwrap_or(self.font_size);
            }
            _ => {}
        }
    }
}

/// Whether a value of `fill` or `stroke` is seen.
fn is_paint(value: &str) -> bool {
    !matches!(value, "none" | "") && !Color::from_str(value).is_ok_and(|color| color.alpha == 0)
}

fn is_zero(value: &str) -> bool {
    let number = value.trim_end_matches(|c: char| c == '%' || c.is_ascii_alphabetic());
    number.parse::<f64>().is_ok_and(|value| value <= 0.0)
}

/// The properties that attributes have too.
const ATTRIBUTES: [&str; 9] = [
    "display",
    "visibility",
    "opacity",
    "fill",
    "stroke",
    "stroke-width",
    "fill-opacity",
    "stroke-opacity",
    "font-size",
];

/// The most comparisons of rules of style sheets with elements.
const MAX_COMPARISONS: usize = 10_000_000;

/// The style sheets of a drawing.
pub(super) struct Styles<'t> {
    tree: &'t Tree,
    sheet: StyleSheet<'t>,
}

impl<'t> Styles<'t> {
    /// # Errors
    /// There are too many rules.
    pub fn new(tree: &'t Tree) -> Result<Styles<'t>, String> {
        let sheet = StyleSheet::parse(&tree.style_sheet);
        let (rules, elements) = (sheet.rules.len(), tree.elements.len());
        match rules.saturating_mul(elements) {
            count if count > MAX_COMPARISONS => {
                Err(format!("the drawing has {rules} rules of style sheets for {elements} elements: leave some out"))
            }
            _ => Ok(Styles { tree, sheet }),
        }
    }

    /// The most elements that can be drawn.
    pub fn max_drawn(&self) -> usize {
        MAX_COMPARISONS / self.sheet.rules.len().max(1)
    }

    /// The style of an element within what has the style `outer`: from its attributes, the rules of style sheets, and its own declarations.
    pub fn of(&self, index: usize, outer: &Style) -> Style {
        let element = &self.tree.elements[index];
        let mut style = Style { transform: None, ..outer.clone() };
        // Of each property the last value holds.
        let mut values: Vec<(&str, &str)> = Vec::new();
        values.extend(ATTRIBUTES.iter().filter_map(|name| Some((*name, element.attribute(name)?))));
        let mut important = Vec::new();
        let own = DeclarationTokenizer::from(element.attribute("style").unwrap_or_default());
        let matched = self.sheet.rules.iter().filter(|rule| rule.selector.matches(&Node { tree: self.tree, index }));
        let declarations = matched.flat_map(|rule| rule.declarations.iter().copied()).chain(own);
        for Declaration { name, value, important: is_important } in declarations {
            if is_important { important.push((name, value)) } else { values.push((name, value)) }
        }
        values.extend(important);
        for name in ATTRIBUTES.into_iter().chain(["transform"]) {
            if let Some((_, value)) = values.iter().rev().find(|(own, _)| *own == name) {
                style.set(name, value);
            }
        }
        style
    }
}

/// An element as rules of style sheets see it.
struct Node<'t> {
    tree: &'t Tree,
    index: usize,
}

impl simplecss::Element for Node<'_> {
    fn parent_element(&self) -> Option<Self> {
        Some(Node { tree: self.tree, index: self.tree.elements[self.index].parent? })
    }

    fn prev_sibling_element(&self) -> Option<Self> {
        let element = &self.tree.elements[self.index];
        let siblings = &self.tree.elements[element.parent?].children;
        Some(Node { tree: self.tree, index: siblings[element.place.checked_sub(1)?] })
    }

    fn has_local_name(&self, name: &str) -> bool {
        self.tree.elements[self.index].name == name
    }

    fn attribute_matches(&self, name: &str, operator: AttributeOperator<'_>) -> bool {
        self.tree.elements[self.index].attribute(name).is_some_and(|value| operator.matches(value))
    }

    fn pseudo_class_matches(&self, class: PseudoClass<'_>) -> bool {
        matches!(class, PseudoClass::FirstChild) && self.tree.elements[self.index].place == 0
    }
}
