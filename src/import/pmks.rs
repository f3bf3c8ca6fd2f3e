//! PMKS+: what both forms of its addresses have.

use coupler_curves::geometry::trig;

use super::error::{Error, quote};
use super::sketch::{Sketch, SketchInput, Slider, SliderLine};

/// What PMKS+ addresses are called in messages.
pub const ORIGIN: &str = "a PMKS+ address";

/// A joint of an address.
#[derive(Clone, Debug)]
pub struct PmksJoint {
    pub name: String,
    pub position: [f64; 2],
    pub is_slider: bool,
    pub is_input: bool,
    pub is_ground: bool,
    pub is_traced: bool,
    /// The angle of a slider's line, in radians.
    pub angle: f64,
}

/// A link of an address.
#[derive(Clone, Debug)]
pub struct PmksLink {
    pub name: String,
    /// Its joints by their indices.
    pub joints: Vec<usize>,
    /// Whether it is the block of a slider.
    pub is_piston: bool,
}

/// A linkage of joints and links, with angles that are rounded by so much, in radians, at most.
///
/// # Errors
/// There are too many; a joint slides on no link.
pub fn sketch(joints: &[PmksJoint], links: &[PmksLink], rounding: f64) -> Result<Sketch, Error> {
    let mut sketch = Sketch::new(ORIGIN);
    for joint in joints {
        let index = sketch.add_joint(joint.name.clone(), joint.position)?;
        sketch.joints[index].is_fixed = joint.is_ground && !joint.is_slider;
        sketch.joints[index].is_traced = joint.is_traced;
    }
    for link in links {
        let index = sketch.add_link(link.name.clone())?;
        link.joints.iter().for_each(|&joint| sketch.attach(index, joint));
    }
    for (k, joint) in joints.iter().enumerate().filter(|(_, joint)| joint.is_slider) {
        let carrier = if joint.is_ground { None } else { Some(carrier(k, joints, &mut sketch)?) };
        // The block keeps the direction of the line, which matters if it has other joints than the slider.
        let has_pin =
            |link: &PmksLink| link.joints.iter().any(|&pin| pin != k && joints[pin].position == joint.position);
        let block = links.iter().position(|link| link.joints.contains(&k) && (link.is_piston || has_pin(link)));
        sketch.sliders.push(Slider {
            joint: k,
            line: SliderLine::Direction { direction: direction(joint.angle, rounding), carrier },
            block,
        });
    }
    let inputs: Vec<usize> = (0..joints.len()).filter(|&k| joints[k].is_input).collect();
    if let [input, further @ ..] = &inputs[..] {
        sketch.input = Some(SketchInput::Pivot(*input));
        for &other in further {
            sketch.note(format!("the joint {} is driven, too, which was left out", quote(&joints[other].name)));
        }
    }
    sketch.note("masses, inertias, centres of mass, shapes, colours and settings were left out");
    Ok(sketch)
}

/// The link with the line of a slider that is not on the ground; the slider is no joint of it.
fn carrier(slider: usize, joints: &[PmksJoint], sketch: &mut Sketch) -> Result<usize, Error> {
    let name = quote(&joints[slider].name);
    let links = sketch.links_at(slider);
    if links.len() < 2 {
        let message = "it slides, but on no other link and not on the ground";
        return Err(Error::new(
            format!("joint {name}"),
            message,
            "put it on the ground, or on the link with its line, in PMKS+",
        ));
    }
    let is_block = |link: &usize| {
        let others = sketch.links[*link].joints.iter().filter(|&&joint| joint != slider);
        others.into_iter().any(|&joint| joints[joint].position == joints[slider].position)
    };
    let carrier = match links.iter().find(|link| !is_block(link)) {
        Some(&link) if links.iter().any(is_block) => link,
        _ => {
            let link = links[links.len() - 1];
            sketch
                .note(format!("the line of the slider {name} was taken to be on {}", quote(&sketch.links[link].name)));
            link
        }
    };
    sketch.links[carrier].joints.retain(|&joint| joint != slider);
    Ok(carrier)
}

/// The unit vector at an angle, both in radians; multiples of 15 degrees that have been rounded are meant exactly.
fn direction(angle: f64, rounding: f64) -> [f64; 2] {
    const STEP: f64 = 15.0;
    let deg = trig::degrees(angle);
    let nearest = (deg / STEP).round() * STEP;
    if trig::radians((deg - nearest).abs()) <= rounding {
        let (x, y) = trig::cos_sin_deg(nearest);
        return [x, y];
    }
    [trig::cos(angle), trig::sin(angle)]
}
