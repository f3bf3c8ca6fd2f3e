//! Lengths of a drawing in SVG, and the transforms of its viewports.

use std::str::FromStr;

use kurbo::Affine;
use svgtypes::{Align, AspectRatio, Length, LengthUnit, ViewBox};

use super::tree::Element;
use crate::drawing::shorten;

/// What lengths are relative to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Viewport {
    pub width: f64,
    pub height: f64,
    pub font_size: f64,
}

/// The side of a viewport to which a length in per cent is relative.
#[derive(Clone, Copy, Debug)]
pub(super) enum Side {
    Width,
    Height,
    /// The root of the mean square of both.
    Diagonal,
}

/// Millimetres in a pixel, of which 96 are an inch.
pub(super) const MILLIMETRES: f64 = 25.4 / 96.0;

/// A length in user units, which are pixels where no viewport scales them.
fn pixels(length: Length, viewport: Viewport, side: Side) -> f64 {
    let whole = match side {
        Side::Width => viewport.width,
        Side::Height => viewport.height,
        Side::Diagonal => (0.5 * (viewport.width * viewport.width + viewport.height * viewport.height)).sqrt(),
    };
    let unit = match length.unit {
        LengthUnit::None | LengthUnit::Px => 1.0,
        LengthUnit::Em => viewport.font_size,
        LengthUnit::Ex => 0.5 * viewport.font_size,
        LengthUnit::In => 96.0,
        LengthUnit::Cm => 10.0 / MILLIMETRES,
        LengthUnit::Mm => 1.0 / MILLIMETRES,
        LengthUnit::Pt => 96.0 / 72.0,
        LengthUnit::Pc => 16.0,
        LengthUnit::Percent => whole / 100.0,
    };
    length.number * unit
}

/// The length that an attribute has, in user units; `None` without it, or if it is `auto`.
///
/// # Errors
/// It is no length.
pub(super) fn length(element: &Element, name: &str, viewport: Viewport, side: Side) -> Result<Option<f64>, String> {
    let Some(text) = element.attribute(name).map(str::trim).filter(|text| *text != "auto") else { return Ok(None) };
    let length = Length::from_str(text).ok().map(|length| pixels(length, viewport, side));
    let finite = length.filter(|value| value.is_finite());
    finite.map(Some).ok_or_else(|| format!("`{name} = {}` of the drawing is not a length", shorten(text)))
}

/// The transform of a viewport: from what is in it to the plane that it is in.
///
/// # Errors
/// Its view box cannot be read.
pub(super) fn viewport_transform(
    element: &Element,
    [width, height]: [f64; 2],
) -> Result<(Affine, Option<ViewBox>), String> {
    let Some(view_box) = view_box(element)? else { return Ok((Affine::IDENTITY, None)) };
    let aspect = element.attribute("preserveAspectRatio").and_then(|text| AspectRatio::from_str(text).ok());
    let aspect = aspect.unwrap_or(AspectRatio { defer: false, align: Align::XMidYMid, slice: false });
    let [x, y] = [width / view_box.w, height / view_box.h];
    let scale = if aspect.slice { x.max(y) } else { x.min(y) };
    let [x, y] = if aspect.align == Align::None { [x, y] } else { [scale, scale] };
    // The parts of the free space that are before the drawing.
    let [left, above] = match aspect.align {
        Align::None | Align::XMinYMin => [0.0, 0.0],
        Align::XMidYMin => [0.5, 0.0],
        Align::XMaxYMin => [1.0, 0.0],
        Align::XMinYMid => [0.0, 0.5],
        Align::XMidYMid => [0.5, 0.5],
        Align::XMaxYMid => [1.0, 0.5],
        Align::XMinYMax => [0.0, 1.0],
        Align::XMidYMax => [0.5, 1.0],
        Align::XMaxYMax => [1.0, 1.0],
    };
    let shift = (left * (width - x * view_box.w) - x * view_box.x, above * (height - y * view_box.h) - y * view_box.y);
    Ok((Affine::translate(shift) * Affine::scale_non_uniform(x, y), Some(view_box)))
}

/// The view box of an element.
///
/// # Errors
/// It cannot be read.
pub(super) fn view_box(element: &Element) -> Result<Option<ViewBox>, String> {
    let Some(text) = element.attribute("viewBox") else { return Ok(None) };
    let view_box = ViewBox::from_str(text).ok().filter(|view_box| view_box.w > 0.0 && view_box.h > 0.0);
    view_box.map(Some).ok_or_else(|| format!("`viewBox = {}` of the drawing cannot be read", shorten(text)))
}
