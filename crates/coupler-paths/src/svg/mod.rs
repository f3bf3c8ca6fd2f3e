//! The outlines of a drawing in SVG.

mod length;
mod shape;
mod style;
mod tree;

use kurbo::Affine;

use crate::drawing::{Kind, Piece, outline_of, polylines, shorten};
use crate::outline::{Outline, ReadOptions};
use length::{MILLIMETRES, Side, Viewport, length, view_box, viewport_transform};
use style::{Style, Styles};
use tree::{Element, Tree};

/// The path in a drawing, as points at equal distances: of what is shown, the outline that is chosen, or the most likely. It is in the drawing's
/// unit, which its view box has, with all transforms. Its y points up, so that that of the drawing changes its sign. A plate of this program
/// has the unit and the origin of its linkage. Elements without a drawing around them are one.
///
/// # Errors
/// The drawing cannot be read, or has no such outline.
pub(crate) fn parse_svg(text: &str, options: &ReadOptions) -> Result<Outline, String> {
    let tree = Tree::parse(text)?;
    let is_drawn = |name: &str| SHAPES.contains(&name) || name == "g" || name == "use";
    if tree.elements.first().is_some_and(|first| is_drawn(&first.name)) {
        return parse_svg(&format!("<svg>{text}</svg>"), options);
    }
    let root =
        tree.elements.first().filter(|root| root.name == "svg").ok_or("it is no drawing in SVG: it has no <svg>")?;
    let (stretch, viewport, unit) = root_viewport(root)?;
    let styles = Styles::new(&tree)?;
    let mut walk = Walk { tree: &tree, styles, pieces: Vec::new(), drawn: 0, points: 0, hidden: 0, links: Vec::new() };
    let style = walk.styles.of(0, &Style::initial());
    let context = Context { transform: stretch, style, viewport, plate: None };
    if !context.style.is_hidden {
        walk.children(0, &context)?;
    }
    let Walk { pieces, hidden, .. } = walk;
    if pieces.is_empty() {
        let hidden = if hidden > 0 {
            format!("; {hidden} are not shown, for they have no colour or are hidden")
        } else {
            String::new()
        };
        return Err(format!(
            "the drawing has no path, line, polygon, rectangle, circle or ellipse that is shown{hidden}"
        ));
    }
    let is_plate = pieces.iter().any(|piece| piece.kind == Kind::Curve);
    let mut outline = outline_of(pieces, options).map_err(|error| format!("the drawing: {error}"))?;
    let taken = &mut outline.reading.taken;
    *taken += "; ";
    *taken += if is_plate && taken.contains("of this program") { "in the unit of its linkage" } else { &unit };
    Ok(outline)
}

/// Whether a text is the data of a path, as `M0 0L3 4`.
pub(crate) fn is_path_data(text: &str) -> bool {
    let text = text.trim();
    let is_of_data = |c: char| c.is_ascii_whitespace() || "MmLlHhVvCcSsQqTtAaZzEe0123456789+-.,".contains(c);
    text.starts_with(['M', 'm']) && text.len() > 1 && text.chars().all(is_of_data)
}

/// The path with this data, as of a drawing with nothing else.
///
/// # Errors
/// They cannot be read, or draw nothing.
pub(crate) fn parse_path_data(text: &str, options: &ReadOptions) -> Result<Outline, String> {
    parse_svg(&format!("<svg><path d=\"{}\" stroke=\"black\"/></svg>", text.trim()), options)
}

/// The transform that undoes a distortion of the root's viewport, what lengths in per cent are relative to, and the drawing's unit in words.
fn root_viewport(root: &Element) -> Result<(Affine, Viewport, String), String> {
    // What a browser takes where nothing is said.
    let unknown = Viewport { width: 300.0, height: 150.0, font_size: 16.0 };
    // Of the window that shows it nothing is known.
    let is_of_window =
        |text: &str| ["%", "vw", "vh", "vmin", "vmax"].iter().any(|unit| text.trim_end().ends_with(unit));
    let is_absolute = |name: &str| root.attribute(name).is_some_and(|text| !is_of_window(text));
    let [width, height] = [("width", Side::Width), ("height", Side::Height)]
        .map(|(name, side)| if is_absolute(name) { length(root, name, unknown, side) } else { Ok(None) });
    let (width, height) = (width?.filter(|width| *width > 0.0), height?.filter(|height| *height > 0.0));
    let view_box = view_box(root)?;
    let viewport = match view_box {
        Some(view_box) => Viewport { width: view_box.w, height: view_box.h, ..unknown },
        None => Viewport { width: width.unwrap_or(unknown.width), height: height.unwrap_or(unknown.height), ..unknown },
    };
    let size = match (width, height) {
        (Some(width), Some(height)) => Some([width, height]),
        (Some(width), None) => Some([width, width * viewport.height / viewport.width]),
        (None, Some(height)) => Some([height * viewport.width / viewport.height, height]),
        (None, None) => None,
    };
    let Some(size) = size else { return Ok((Affine::IDENTITY, viewport, "in the drawing's unit".to_owned())) };
    let [a, _, _, d, _, _] = viewport_transform(root, size)?.0.as_coeffs();
    if (d / a - 1.0).abs() <= 1e-9 {
        let unit = coupler_find::format_length(a * MILLIMETRES, a * MILLIMETRES);
        return Ok((Affine::IDENTITY, viewport, format!("in the drawing's unit, which is {unit} mm")));
    }
    let unit =
        "in the drawing's unit of x, in which y is stretched as preserveAspectRatio=\"none\" asks for".to_owned();
    Ok((Affine::scale_non_uniform(1.0, d / a), viewport, unit))
}

/// Where an element is.
#[derive(Clone)]
struct Context {
    /// From its plane to that of the drawing.
    transform: Affine,
    style: Style,
    viewport: Viewport,
    /// From the plane of the drawing to that of the linkage, in a plate of this program.
    plate: Option<Affine>,
}

/// The most elements that are drawn, with those that are drawn again by links.
const MAX_DRAWN: usize = 400_000;

/// The most links within links.
const MAX_LINKS: usize = 20;

/// Elements that have an outline.
const SHAPES: [&str; 7] = ["path", "polyline", "polygon", "line", "rect", "circle", "ellipse"];

/// Elements whose contents are drawn in their place.
const CONTAINERS: [&str; 3] = ["g", "a", "svg"];

/// Collects the outlines of what is shown.
struct Walk<'t> {
    tree: &'t Tree,
    styles: Styles<'t>,
    pieces: Vec<Piece>,
    /// The number of elements so far.
    drawn: usize,
    /// The number of points so far.
    points: usize,
    /// The number of outlines that are not shown.
    hidden: usize,
    /// The links that are followed.
    links: Vec<usize>,
}

impl Walk<'_> {
    fn children(&mut self, index: usize, context: &Context) -> Result<(), String> {
        let tree = self.tree;
        tree.elements[index].children.iter().try_for_each(|child| self.element(*child, context))
    }

    fn element(&mut self, index: usize, outer: &Context) -> Result<(), String> {
        self.drawn += 1;
        let most = MAX_DRAWN.min(self.styles.max_drawn());
        if self.drawn > most {
            return Err(format!("the drawing shows more than {most} elements: leave some out"));
        }
        let element = &self.tree.elements[index];
        let name = element.name.as_str();
        let is_shape = SHAPES.contains(&name);
        if !is_shape && !CONTAINERS.contains(&name) && name != "use" && name != "switch" {
            return Ok(());
        }
        let style = self.styles.of(index, &outer.style);
        if style.is_hidden {
            self.hidden += usize::from(is_shape);
            return Ok(());
        }
        if let Some(transform) = &style.transform {
            let transform = shorten(transform);
            return Err(format!(
                "the drawing has `transform: {transform}` in a style, which is not read: write it as an attribute, `transform=\"…\"`"
            ));
        }
        let transform = outer.transform * transform_of(element)?;
        let viewport = Viewport { font_size: style.font_size, ..outer.viewport };
        let context = Context { transform, style, viewport, plate: outer.plate.or(plate_of(element)) };
        match name {
            "use" => self.link(index, &context),
            "svg" => self.viewport(index, index, &context),
            "switch" => {
                // A reader without extensions, of English.
                let is_for_all = |child: &&usize| {
                    let child = &self.tree.elements[**child];
                    let is_english =
                        |text: &str| text.split(',').any(|language| language.trim_start().starts_with("en"));
                    child.attribute("requiredExtensions").is_none()
                        && child.attribute("systemLanguage").is_none_or(is_english)
                };
                let first = element.children.iter().find(is_for_all).copied();
                first.map_or(Ok(()), |child| self.element(child, &context))
            }
            _ if is_shape => self.shape(index, &context),
            _ => {
                let count = self.pieces.len();
                self.children(index, &context)?;
                if context.plate.is_some() && outer.plate.is_none() {
                    // The first path is the whole curve, and those that follow are its dashes.
                    let shown = self.pieces.split_off(count);
                    self.pieces.extend(shown.into_iter().take(1));
                }
                Ok(())
            }
        }
    }

    /// What a link shows, at its place.
    fn link(&mut self, index: usize, context: &Context) -> Result<(), String> {
        let element = &self.tree.elements[index];
        let Some(linked) = element.attribute("href").and_then(|link| self.tree.linked(link)) else { return Ok(()) };
        if self.links.len() >= MAX_LINKS || self.links.contains(&linked) {
            return Err("the drawing has a link (<use>) to what it is in, or too many within each other".to_owned());
        }
        let shift = |name, side| length(element, name, context.viewport, side).map(Option::unwrap_or_default);
        let shift = Affine::translate((shift("x", Side::Width)?, shift("y", Side::Height)?));
        let context = Context { transform: context.transform * shift, ..context.clone() };
        self.links.push(linked);
        let count = self.pieces.len();
        match self.tree.elements[linked].name.as_str() {
            "symbol" => {
                let style = self.styles.of(linked, &context.style);
                if !style.is_hidden {
                    self.viewport(linked, index, &Context { style, ..context })?;
                }
            }
            _ => self.element(linked, &context)?,
        }
        if let Some(id) = element.attribute("id") {
            self.pieces[count..].iter_mut().for_each(|piece| piece.id = Some(id.to_owned()));
        }
        self.links.pop();
        Ok(())
    }

    /// The contents of a nested drawing or symbol, with the size that it or the link to it has.
    fn viewport(&mut self, index: usize, sized: usize, context: &Context) -> Result<(), String> {
        let element = &self.tree.elements[index];
        let sides = [("width", Side::Width, context.viewport.width), ("height", Side::Height, context.viewport.height)];
        let mut size = [0.0; 2];
        for (size, (name, side, whole)) in size.iter_mut().zip(sides) {
            let given = [sized, index].map(|owner| length(&self.tree.elements[owner], name, context.viewport, side));
            let [given, own] = given;
            *size = given?.or(own?).unwrap_or(whole);
        }
        let place = |name, side| length(element, name, context.viewport, side).map(Option::unwrap_or_default);
        let shift = match element.name.as_str() {
            "svg" => Affine::translate((place("x", Side::Width)?, place("y", Side::Height)?)),
            _ => Affine::IDENTITY,
        };
        if !(size[0] > 0.0 && size[1] > 0.0) {
            return Ok(());
        }
        let (transform, view_box) = viewport_transform(element, size)?;
        let [width, height] = view_box.map_or(size, |view_box| [view_box.w, view_box.h]);
        let viewport = Viewport { width, height, ..context.viewport };
        self.children(index, &Context { transform: context.transform * shift * transform, viewport, ..context.clone() })
    }

    fn shape(&mut self, index: usize, context: &Context) -> Result<(), String> {
        let style = &context.style;
        let kind = match (context.plate, style.is_stroked(), style.is_filled()) {
            (Some(_), true, _) => Kind::Curve,
            (_, true, _) => Kind::Stroke,
            (_, false, true) => Kind::Fill,
            (_, false, false) => {
                self.hidden += 1;
                return Ok(());
            }
        };
        let Some(path) = shape::outline(&self.tree.elements[index], context.viewport)? else { return Ok(()) };
        let transform = context.plate.unwrap_or(Affine::IDENTITY) * context.transform;
        let id = self.tree.nearest_id(index).map(str::to_owned);
        let style = if kind == Kind::Stroke { style.stroke_key() } else { String::new() };
        for points in polylines(&path, transform, &mut self.points).map_err(|error| format!("the drawing: {error}"))? {
            self.pieces.push(Piece { points, kind, id: id.clone(), style: style.clone() });
        }
        Ok(())
    }
}

fn transform_of(element: &Element) -> Result<Affine, String> {
    let Some(text) = element.attribute("transform") else { return Ok(Affine::IDENTITY) };
    let transform: svgtypes::Transform = text
        .parse()
        .map_err(|error| format!("the transform `{}` of the drawing cannot be read: {error}", shorten(text)))?;
    let svgtypes::Transform { a, b, c, d, e, f } = transform;
    Ok(Affine::new([a, b, c, d, e, f]))
}

/// From the plane of a plate of this program to that of its linkage, if an element is its curve.
fn plate_of(element: &Element) -> Option<Affine> {
    if element.attribute("class") != Some("curve") {
        return None;
    }
    let scale: f64 = element.attribute("data-scale")?.parse().ok()?;
    let (x, y) = element.attribute("data-origin")?.split_once(' ')?;
    let origin: (f64, f64) = (x.parse().ok()?, y.parse().ok()?);
    (scale > 0.0).then(|| Affine::scale(1.0 / scale) * Affine::translate((-origin.0, -origin.1)))
}
