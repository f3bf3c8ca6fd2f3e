//! The drawing of a manifest from a sketch: sliders on lines between two joints, the input, the traced joints.

use coupler_curves::geometry::trig;
use coupler_curves::problem::suggestion;

use super::error::{Error, quote};
use super::names::Names;
use super::sketch::{Sketch, SketchInput, SliderLine};

/// A linkage as a manifest draws it. Joints are named by their indices.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// What it was read from.
    pub origin: &'static str,
    /// Its title.
    pub title: Option<String>,
    /// The unit of lengths.
    pub unit: Option<String>,
    /// The names of the joints, each of one joint, and where they are drawn.
    pub joints: Vec<(String, [f64; 2])>,
    /// The joints of the frame.
    pub frame: Vec<usize>,
    /// The moving links, each by its joints.
    pub links: Vec<Vec<usize>>,
    /// Joints that slide, each with two joints of its line.
    pub slides: Vec<(usize, [usize; 2])>,
    /// What is driven.
    pub input: DrawingInput,
    /// The range of the input, as a manifest has its values; all of it if `None`.
    pub range: Option<[String; 2]>,
    /// The joints whose curves are traced.
    pub trace: Vec<usize>,
    /// What was left out, and what had to be assumed.
    pub notes: Vec<String>,
}

/// What is driven.
#[derive(Clone, Copy, Debug)]
pub enum DrawingInput {
    /// A link on the frame, by two of its joints.
    Line([usize; 2]),
    /// The angle from a line of a link to a line of another.
    Between([[usize; 2]; 2]),
    /// The way of a joint that slides.
    Slider(usize),
    /// The distance of two joints.
    Distance([usize; 2]),
}

impl Drawing {
    /// The drawing of a sketch, with the input named by two joints if one is given.
    ///
    /// # Errors
    /// The input is not known, or is one that a manifest cannot have.
    pub fn new(mut sketch: Sketch, input: Option<&str>) -> Result<Drawing, Error> {
        let extent = extent(&sketch);
        let is_merged = merge_blocks(&mut sketch, extent * 1e-9);
        leave_out_links(&mut sketch);
        let kept = kept_joints(&mut sketch, &is_merged);
        let mut names = Names::default();
        let mut joints: Vec<(String, [f64; 2])> = kept
            .iter()
            .map(|&joint| (names.distinct(&sketch.joints[joint].name), sketch.joints[joint].position))
            .collect();
        // Every joint that is needed from here on has been kept.
        let mut index = vec![0; sketch.joints.len()];
        kept.iter().enumerate().for_each(|(new, &old)| index[old] = new);
        let mut frame: Vec<usize> =
            kept.iter().filter(|&&joint| sketch.joints[joint].is_fixed).map(|&joint| index[joint]).collect();
        let mut links: Vec<Vec<usize>> =
            sketch.links.iter().map(|link| link.joints.iter().map(|&joint| index[joint]).collect()).collect();
        let (chosen, note) = match input {
            Some(words) => (named_input(words, &joints, &sketch)?, None),
            None => sketch_input(&sketch, &index, &joints)?,
        };
        let trace = traced_joints(&sketch, &kept, &index);
        let mut slides = Vec::new();
        let half = helper_distance(extent);
        for slider in &sketch.sliders {
            let joint = index[slider.joint];
            let (direction, carrier) = match slider.line {
                SliderLine::Direction { direction, carrier } => (direction, carrier),
                SliderLine::Joints(line) => {
                    slides.push((joint, line.map(|joint| index[joint])));
                    continue;
                }
            };
            let (name, [x, y]) = joints[joint].clone();
            let [u, v] = direction.map(|c| c * half);
            let mut add = |end: usize, position: [f64; 2]| {
                joints.push((names.distinct(&format!("{name}{end}")), position));
                joints.len() - 1
            };
            let line = [add(1, [x - u, y - v]), add(2, [x + u, y + v])];
            carrier.map_or(&mut frame, |link| &mut links[link]).extend(line);
            slides.push((joint, line));
            // A link of which two joints slide on one line keeps its direction.
            if let Some(block) = slider.block.filter(|&block| links[block].len() > 1) {
                let ahead = add(3, [x + u, y + v]);
                links[block].push(ahead);
                slides.push((ahead, line));
            }
        }
        links.retain(|link| link.len() > 1);
        if frame.is_empty() {
            return Err(Error::new(
                sketch.origin,
                "no joint is fixed",
                "fix one to the frame there, and import it again",
            ));
        }
        sketch.notes.extend(note);
        let Sketch { origin, title, unit, notes, .. } = sketch;
        Ok(Drawing { origin, title, unit, joints, frame, links, slides, input: chosen, range: None, trace, notes })
    }
}

/// The greater of the width and the height.
fn extent(sketch: &Sketch) -> f64 {
    let span = |axis: usize| {
        let values = || sketch.joints.iter().map(|joint| joint.position[axis]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    span(0).max(span(1)).max(0.0)
}

/// How far the joints of a line are from the joint that slides on it: a quarter of the extent, to one digit.
fn helper_distance(extent: f64) -> f64 {
    let quarter = extent / 4.0;
    if !(quarter.is_normal() && quarter.is_finite()) {
        return 1.0;
    }
    let unit = trig::pow(10.0, trig::log10(quarter).floor());
    (quarter / unit).round().max(1.0) * unit
}

/// Makes one joint of a slider and the pin of its block where the block is a link of these two at one place; returns which joints are gone.
fn merge_blocks(sketch: &mut Sketch, tolerance: f64) -> Vec<bool> {
    let mut is_merged = vec![false; sketch.joints.len()];
    for k in 0..sketch.sliders.len() {
        let slider = sketch.sliders[k].joint;
        let is_same_place = |&&pin: &&usize| {
            let [a, b] = [pin, slider].map(|joint| &sketch.joints[joint]);
            pin != slider && !b.is_fixed && (0..2).all(|axis| (a.position[axis] - b.position[axis]).abs() <= tolerance)
        };
        let at_slider = sketch.links.iter().filter(|link| link.joints.contains(&slider));
        let Some(pin) = at_slider.flat_map(|link| link.joints.iter().find(is_same_place)).next().copied() else {
            continue;
        };
        is_merged[slider] = true;
        sketch.joints[pin].is_traced |= sketch.joints[slider].is_traced;
        sketch.sliders.iter_mut().filter(|other| other.joint == slider).for_each(|other| other.joint = pin);
        for other in &mut sketch.sliders {
            if let SliderLine::Joints(line) = &mut other.line {
                line.iter_mut().filter(|joint| **joint == slider).for_each(|joint| *joint = pin);
            }
        }
        for link in &mut sketch.links {
            let has_pin = link.joints.contains(&pin);
            match link.joints.iter().position(|&joint| joint == slider) {
                Some(at) if has_pin => drop(link.joints.remove(at)),
                Some(at) => link.joints[at] = pin,
                None => {}
            }
        }
        if let Some(SketchInput::Pivot(joint)) = &mut sketch.input
            && *joint == slider
        {
            *joint = pin;
        }
    }
    is_merged
}

/// Takes the joints from links that do not move or have one joint only; a manifest does not need them.
fn leave_out_links(sketch: &mut Sketch) {
    let is_carrier = |link: usize| sketch.sliders.iter().any(|slider| slider.carrier() == Some(link));
    let (mut fixed, mut single) = (Vec::new(), Vec::new());
    for (k, link) in sketch.links.iter().enumerate() {
        let is_fixed = link.joints.iter().all(|&joint| sketch.joints[joint].is_fixed);
        if link.joints.len() > 1 && is_fixed {
            fixed.push(k);
        } else if link.joints.len() == 1 && !is_carrier(k) && !sketch.sliders.iter().any(|s| s.joint == link.joints[0])
        {
            single.push(k);
        }
    }
    for (links, reason) in [(fixed, "all its joints are fixed"), (single, "it has one joint")] {
        for link in links {
            let name = quote(&sketch.links[link].name);
            sketch.note(format!("the link {name} was left out: {reason}"));
            sketch.links[link].joints.clear();
        }
    }
}

/// The joints that are in a link or fixed.
fn kept_joints(sketch: &mut Sketch, is_merged: &[bool]) -> Vec<usize> {
    let is_on_line = |joint: usize| sketch.sliders.iter().any(|slider| slider.line_joints().contains(&joint));
    let driven = sketch.input.map_or(Vec::new(), SketchInput::joints);
    let is_needed = |joint: usize| {
        let is_fixed = sketch.joints[joint].is_fixed;
        is_fixed || !sketch.links_at(joint).is_empty() || is_on_line(joint) || driven.contains(&joint)
    };
    let (kept, lost): (Vec<usize>, Vec<usize>) =
        (0..sketch.joints.len()).filter(|&joint| !is_merged[joint]).partition(|&joint| is_needed(joint));
    sketch.sliders.retain(|slider| kept.contains(&slider.joint));
    for joint in lost {
        let name = quote(&sketch.joints[joint].name);
        sketch.note(format!("the joint {name} was left out: it is in no link"));
    }
    kept
}

/// The joints whose curves are requested, or else those of only one link, or else all that move.
fn traced_joints(sketch: &Sketch, kept: &[usize], index: &[usize]) -> Vec<usize> {
    let is_slider = |joint: usize| sketch.sliders.iter().any(|slider| slider.joint == joint);
    let moving: Vec<usize> = kept.iter().copied().filter(|&joint| !sketch.joints[joint].is_fixed).collect();
    let requested = |joint: usize| sketch.joints[joint].is_traced;
    let is_point = |joint: usize| sketch.links_at(joint).len() == 1 && !is_slider(joint);
    let groups: [&dyn Fn(usize) -> bool; 3] = [&requested, &is_point, &|_| true];
    let found = groups.into_iter().find(|is_in| moving.iter().any(|&joint| is_in(joint)));
    let Some(is_in) = found else { return Vec::new() };
    moving.into_iter().filter(|&joint| is_in(joint)).map(|joint| index[joint]).collect()
}

/// The input that names give: a link, as in "A, B", or the angle between two lines, as in "A B, B C".
fn named_input(words: &str, joints: &[(String, [f64; 2])], sketch: &Sketch) -> Result<DrawingInput, Error> {
    let find = |word: &str| {
        let place = joints.iter().position(|(name, _)| name == word);
        place.ok_or_else(|| {
            let names: Vec<&str> = joints.iter().map(|(name, _)| name.as_str()).collect();
            let message = format!("{} has no joint {}", sketch.origin, quote(word));
            Error::new("--input", message, suggestion(word, &names))
        })
    };
    let parts: Vec<Vec<&str>> = words.split(',').map(|part| part.split_whitespace().collect()).collect();
    match parts.iter().map(Vec::as_slice).collect::<Vec<_>>()[..] {
        [[a], [b]] | [[a, b]] => Ok(DrawingInput::Line([find(a)?, find(b)?])),
        [[a, b], [c, d]] => Ok(DrawingInput::Between([[find(a)?, find(b)?], [find(c)?, find(d)?]])),
        _ => {
            let message = format!("{} does not name two joints", quote(words));
            let remedy =
                "name two joints of the driven link, as in --input \"A, B\", or two lines, as in --input \"A B, B C\"";
            Err(Error::new("--input", message, remedy))
        }
    }
}

/// The input of a file, and what had to be assumed for it.
fn sketch_input(
    sketch: &Sketch,
    index: &[usize],
    joints: &[(String, [f64; 2])],
) -> Result<(DrawingInput, Option<String>), Error> {
    let name = |joint: usize| format!("`{}`", joints[index[joint]].0);
    let fail = |message: String| Err(Error::new(sketch.origin, message, input_remedy(sketch, index, joints)));
    // Another joint of a link, if possible one that moves.
    let other = |link: usize, pivot: usize| {
        let others = || sketch.links[link].joints.iter().copied().filter(|&joint| joint != pivot);
        others().find(|&joint| !sketch.joints[joint].is_fixed).or(others().next())
    };
    let turn = |pivot: usize, links: [Option<usize>; 2]| {
        let from = index[pivot];
        let ends = links.map(|link| link.map(|link| other(link, pivot)));
        match ends {
            [Some(Some(a)), Some(Some(b))] => Ok(DrawingInput::Between([[index[a], from], [from, index[b]]])),
            [None, Some(Some(end))] | [Some(Some(end)), None] if !sketch.joints[end].is_fixed => {
                Ok(DrawingInput::Line([from, index[end]]))
            }
            _ => fail(format!("the links at {} cannot turn", name(pivot))),
        }
    };
    let pivot = match sketch.input {
        None => return fail("the input is not known".to_owned()).map(|input| (input, None)),
        Some(SketchInput::Line(line)) => return Ok((DrawingInput::Line(line.map(|joint| index[joint])), None)),
        Some(SketchInput::Distance(ends)) => return Ok((DrawingInput::Distance(ends.map(|joint| index[joint])), None)),
        Some(SketchInput::Turn { pivot, links }) => return Ok((turn(pivot, links)?, None)),
        Some(SketchInput::Pivot(pivot)) => pivot,
    };
    if sketch.sliders.iter().any(|slider| slider.joint == pivot) {
        return Ok((DrawingInput::Slider(index[pivot]), None));
    }
    match (sketch.joints[pivot].is_fixed, &sketch.links_at(pivot)[..]) {
        (true, [link, further @ ..]) => {
            let input = turn(pivot, [None, Some(*link)])?;
            let note = match input {
                DrawingInput::Line([_, end]) if !further.is_empty() => Some(format!(
                    "{} drives several links; that to `{}` was taken for the input",
                    name(pivot),
                    joints[end].0
                )),
                _ => None,
            };
            Ok((input, note))
        }
        (false, &[first, second]) => Ok((turn(pivot, [Some(first), Some(second)])?, None)),
        _ => fail(format!("no link turns about {}, which is driven", name(pivot))).map(|input| (input, None)),
    }
}

/// Which inputs there are.
fn input_remedy(sketch: &Sketch, index: &[usize], joints: &[(String, [f64; 2])]) -> String {
    /// The most inputs that are listed.
    const MAX_LISTED: usize = 4;
    let is_fixed = |joint: &&usize| sketch.joints[**joint].is_fixed;
    let crank = |joints: &[usize]| {
        let pivot = joints.iter().find(is_fixed)?;
        Some([*pivot, *joints.iter().find(|joint| !is_fixed(joint))?])
    };
    let found = sketch.links.iter().filter_map(|link| crank(&link.joints)).take(MAX_LISTED);
    let found: Vec<String> = found
        .map(|line| format!("--input \"{}\"", line.map(|joint| joints[index[joint]].0.as_str()).join(", ")))
        .collect();
    match &found[..] {
        [] => "no link turns about a fixed joint: draw one".to_owned(),
        found => format!("name two joints of the driven link: {}", found.join(" or ")),
    }
}
