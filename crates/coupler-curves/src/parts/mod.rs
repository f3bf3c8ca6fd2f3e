//! The parts of a linkage for a workshop: the frame, the links, the blocks of sliders and the gears, with their holes, slots and outlines.
//!
//! Each part has coordinates of its own, in the unit of the linkage: its first hole is at the origin, its second on the positive x-axis, and it is seen
//! from the side from which the linkage is drawn. Outlines are lines and arcs. Where a part is in a pose is [`Part::plane_from_part`].
//!
//! Everything is held by pins of one diameter: a slot is as wide as a hole, and what slides without turning, such as a yoke, has two guide pins, which
//! slide in slots on its line, or in one that both use; they also hold a plate with the holes that would be in its own slot. A slot is longer than what its pins use by half a hole at each end. An actuator is no part.

mod actuator;
mod anchor;
mod body;
mod error;
mod gears;
mod hole;
mod outline;
mod part;
mod pitch_circle;
mod pitch_line;
mod racks;
mod sizes;
mod slides;
mod travel;

pub use actuator::Actuator;
pub use error::PartsError;
pub use hole::{Hole, Slot};
pub use outline::{Outline, Vertex};
pub use part::Part;
pub use pitch_circle::{Idler, idlers, pitch_circles};
pub use pitch_line::{PitchLine, pitch_line_offset};
pub use sizes::{GivenSizes, Sizes};

use crate::geometry::{Bounds, Point};
use crate::linkage::{JointId, Linkage};
use crate::motion::Circuit;

/// The parts of a linkage.
#[derive(Clone, Debug, PartialEq)]
pub struct Parts {
    /// The sizes that they were made with.
    pub sizes: Sizes,
    /// The frame first, then the links, the blocks and the gears.
    pub parts: Vec<Part>,
    /// What drives the linkage by its length, if it is driven so.
    pub actuator: Option<Actuator>,
}

impl Parts {
    /// The parts of a linkage whose slots are as long as a circuit needs, with a hole at each joint whose curve is traced.
    ///
    /// # Errors
    /// Sizes with which they cannot be made, or a slider on the line of no part.
    pub fn new(
        (linkage, circuit): (&Linkage, &Circuit),
        traced: &[JointId],
        given: GivenSizes,
    ) -> Result<Parts, PartsError> {
        let mut bodies = body::bodies(linkage, circuit, traced);
        let (circles, idlers) = (pitch_circles(linkage, circuit), idlers(linkage, circuit));
        let sizes = sizes::resolve(&bodies, (&circles, &idlers), given)?;
        let gears = gears::add(&mut bodies, linkage, (&circles, &idlers), sizes);
        racks::add(&mut bodies, (linkage, circuit), sizes);
        slides::add(&mut bodies, (linkage, circuit), sizes)?;
        let bodies = bodies.iter().filter(|body| body.is_part());
        let mut parts: Vec<Part> = bodies.map(|body| Part::from_body(body, linkage, sizes)).collect();
        parts.extend(gears);
        parts.iter_mut().for_each(|part| part.note_overlaps(sizes));
        make_names_distinct(&mut parts);
        Ok(Parts { sizes, parts, actuator: Actuator::new(linkage, circuit) })
    }

    /// The bounds of the parts where they are in a pose.
    pub fn bounds(&self, pose: &[Point]) -> Bounds {
        let part_bounds = |part: &Part| part.outline.transformed(&part.plane_from_part(pose)).bounds();
        self.parts.iter().map(part_bounds).fold(Bounds::EMPTY, Bounds::union)
    }
}

/// Numbers parts that have the name of another: `AB`, `AB 2`. Case is no difference: some programs ignore it.
fn make_names_distinct(parts: &mut [Part]) {
    for k in 0..parts.len() {
        let (earlier, rest) = parts.split_at_mut(k);
        let is_free = |name: &String| earlier.iter().all(|other| other.name.to_lowercase() != name.to_lowercase());
        let own = rest[0].name.clone();
        let numbered = (2..=k + 1).map(|number| format!("{own} {number}"));
        if let Some(name) = std::iter::once(own.clone()).chain(numbered).find(is_free) {
            rest[0].name = name;
        }
    }
}
