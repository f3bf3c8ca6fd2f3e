//! The diameter of holes and the width of links.

use super::body::Body;
use super::error::PartsError;
use super::pitch_circle::{Idler, PitchCircle};
use crate::expression::format_number;

/// The sizes that are given, in the unit of the linkage; positive.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GivenSizes {
    /// The diameter of holes.
    pub hole: Option<f64>,
    /// The width of links.
    pub width: Option<f64>,
}

/// The sizes of parts, in the unit of the linkage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sizes {
    /// The diameter of holes, and the width of slots.
    pub hole: f64,
    /// The width of links: twice the distance from a hole to the outline around it.
    pub width: f64,
}

impl Sizes {
    /// The least distance from the centre of a hole to that of another or to the centre line of a slot with enough material between them.
    pub(super) fn clearance(&self) -> f64 {
        1.5 * self.hole
    }
}

/// The sizes of the parts of bodies: by default links are as wide as a tenth of the longest distance of two holes of a moving link, to one
/// digit, and holes half as wide as links, but at most half as wide as two of them are apart
/// or a quarter of the least pitch radius of a gear, which has a second hole, or half that of an idler, to one digit.
pub(super) fn resolve(
    bodies: &[Body],
    (gears, idlers): (&[PitchCircle], &[Idler]),
    given: GivenSizes,
) -> Result<Sizes, PartsError> {
    let least = |radii: &mut dyn Iterator<Item = f64>| radii.fold(f64::INFINITY, f64::min);
    let [gear, idler] =
        [least(&mut gears.iter().map(|gear| gear.radius)), least(&mut idlers.iter().map(|idler| idler.radius))];
    let least_radius = gear.min(idler);
    let longest = bodies.iter().filter(|body| !body.is_ground).flat_map(distances).map(|(_, d)| d).fold(0.0, f64::max);
    let longest =
        if longest > 0.0 { longest } else { bodies.iter().flat_map(distances).map(|(_, d)| d).fold(0.0, f64::max) };
    let shortest = bodies.iter().flat_map(distances).min_by(|a, b| a.1.total_cmp(&b.1));
    let width = given.width.unwrap_or_else(|| one_digit(if longest > 0.0 { longest / 10.0 } else { 1.0 }));
    let hole = given.hole.unwrap_or_else(|| {
        let most = shortest.as_ref().map_or(f64::INFINITY, |(_, distance)| one_digit(distance / 2.0));
        let of_gears = (gear / 4.0).min(idler / 2.0);
        let most = if of_gears.is_finite() { most.min(one_digit(of_gears)) } else { most };
        (width / 2.0).min(most)
    });
    if hole >= width {
        return Err(PartsError::HoleTooWide { hole, width });
    }
    if hole >= 2.0 * least_radius {
        return Err(PartsError::GearTooSmall { radius: format_number(least_radius, None), hole });
    }
    match shortest {
        Some((names, distance)) if distance <= hole => {
            Err(PartsError::HolesOverlap { names, distance: format_number(distance, None), hole })
        }
        _ => Ok(Sizes { hole, width }),
    }
}

/// The distances of the holes of a body, with their names.
fn distances(body: &Body) -> Vec<([String; 2], f64)> {
    let pairs = (0..body.holes.len()).flat_map(|k| (0..k).map(move |j| [&body.holes[j], &body.holes[k]]));
    pairs.map(|pair| (pair.map(|hole| hole.name.clone()), (pair[1].centre - pair[0].centre).norm())).collect()
}

/// A number rounded to one significant digit.
fn one_digit(value: f64) -> f64 {
    format!("{value:.0e}").parse().unwrap_or(value)
}
