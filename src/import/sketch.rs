//! A linkage as other programs describe it: joints by coordinates, links by their joints, and sliders by angles.

use super::error::{Error, quote};

/// A linkage as another program describes it. Joints and links are named by their indices.
#[derive(Clone, Debug, Default)]
pub struct Sketch {
    /// What it was read from, as in "a PMKS+ address".
    pub origin: &'static str,
    /// Its title.
    pub title: Option<String>,
    /// The unit of lengths.
    pub unit: Option<String>,
    /// The joints.
    pub joints: Vec<SketchJoint>,
    /// The moving links.
    pub links: Vec<SketchLink>,
    /// The joints that slide.
    pub sliders: Vec<Slider>,
    /// What is driven.
    pub input: Option<SketchInput>,
    /// What was left out, and what had to be assumed.
    pub notes: Vec<String>,
}

/// A joint.
#[derive(Clone, Debug)]
pub struct SketchJoint {
    /// Its name in the file, which others may have, too.
    pub name: String,
    /// Where it is drawn.
    pub position: [f64; 2],
    /// Whether it is fixed to the frame.
    pub is_fixed: bool,
    /// Whether its curve is requested.
    pub is_traced: bool,
}

/// A moving link.
#[derive(Clone, Debug)]
pub struct SketchLink {
    /// Its name in the file.
    pub name: String,
    /// Its joints.
    pub joints: Vec<usize>,
}

/// A joint that slides on a line through its place in the drawing.
#[derive(Clone, Debug)]
pub struct Slider {
    /// The joint.
    pub joint: usize,
    /// The line.
    pub line: SliderLine,
    /// The link that keeps the direction of the line; on the others the joint is a pin.
    pub block: Option<usize>,
}

/// A line on which a joint slides.
#[derive(Clone, Copy, Debug)]
pub enum SliderLine {
    /// By its direction.
    Direction {
        /// A unit vector.
        direction: [f64; 2],
        /// The link that has the line; the frame if `None`.
        carrier: Option<usize>,
    },
    /// By two joints of a link or of the frame.
    Joints([usize; 2]),
}

impl Slider {
    /// The link that has the line, if it is given by its direction and not on the frame.
    pub fn carrier(&self) -> Option<usize> {
        match self.line {
            SliderLine::Direction { carrier, .. } => carrier,
            SliderLine::Joints(_) => None,
        }
    }

    /// The joints by which the line is given.
    pub fn line_joints(&self) -> &[usize] {
        match &self.line {
            SliderLine::Direction { .. } => &[],
            SliderLine::Joints(joints) => joints,
        }
    }
}

/// What is driven.
#[derive(Clone, Copy, Debug)]
pub enum SketchInput {
    /// The link that turns about a joint.
    Pivot(usize),
    /// The angle from a link to another about a joint of both; the frame if `None`.
    Turn {
        /// The joint.
        pivot: usize,
        /// The links.
        links: [Option<usize>; 2],
    },
    /// The link with two joints.
    Line([usize; 2]),
    /// The distance of two joints, an actuator's length.
    Distance([usize; 2]),
}

impl SketchInput {
    /// The joints that it names.
    pub fn joints(self) -> Vec<usize> {
        match self {
            SketchInput::Pivot(pivot) | SketchInput::Turn { pivot, .. } => vec![pivot],
            SketchInput::Line(joints) | SketchInput::Distance(joints) => joints.to_vec(),
        }
    }
}

impl Sketch {
    /// The most joints that are read, and the most links: more than any linkage whose curves can be computed has.
    pub const MAX_PARTS: usize = 100;

    /// An empty sketch.
    pub fn new(origin: &'static str) -> Sketch {
        Sketch { origin, ..Sketch::default() }
    }

    /// Adds a joint, and returns its index.
    ///
    /// # Errors
    /// There are too many; its place is not finite.
    pub fn add_joint(&mut self, name: impl Into<String>, position: [f64; 2]) -> Result<usize, Error> {
        self.check_count(self.joints.len(), "joints")?;
        let name = name.into();
        if !position.iter().all(|coordinate| coordinate.is_finite()) {
            let message = format!("the place of {} is too far away", quote(&name));
            return Err(Error::new(self.origin, message, "give it smaller lengths and coordinates"));
        }
        self.joints.push(SketchJoint { name, position, is_fixed: false, is_traced: false });
        Ok(self.joints.len() - 1)
    }

    /// Adds a link without joints, and returns its index.
    ///
    /// # Errors
    /// There are too many.
    pub fn add_link(&mut self, name: impl Into<String>) -> Result<usize, Error> {
        self.check_count(self.links.len(), "links")?;
        self.links.push(SketchLink { name: name.into(), joints: Vec::new() });
        Ok(self.links.len() - 1)
    }

    /// The link with a name, which is added if there is none.
    ///
    /// # Errors
    /// There are too many.
    pub fn link_named(&mut self, name: &str) -> Result<usize, Error> {
        match self.links.iter().position(|link| link.name == name) {
            Some(link) => Ok(link),
            None => self.add_link(name),
        }
    }

    /// Adds a joint to a link, unless it is on it.
    pub fn attach(&mut self, link: usize, joint: usize) {
        if !self.links[link].joints.contains(&joint) {
            self.links[link].joints.push(joint);
        }
    }

    /// The links that have a joint.
    pub fn links_at(&self, joint: usize) -> Vec<usize> {
        (0..self.links.len()).filter(|&link| self.links[link].joints.contains(&joint)).collect()
    }

    /// Adds a note, once.
    pub fn note(&mut self, note: impl Into<String>) {
        let note = note.into();
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    fn check_count(&self, count: usize, what: &str) -> Result<(), Error> {
        let max = Sketch::MAX_PARTS;
        match count < max {
            true => Ok(()),
            false => Err(Error::new(
                self.origin,
                format!("it has more than {max} {what}, the most that are read"),
                "import the part of the linkage that traces the curve",
            )),
        }
    }
}

/// Reads a finite number; `place` names what it is.
pub(super) fn parse_number(text: &str, place: &str, what: &str) -> Result<f64, Error> {
    let number = text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| {
        Error::new(place, format!("expected a number for {what}, found {}", quote(text)), "write one, as in 2.5")
    })
}
