//! Linkage: the XML of a `.linkage2` file, with connectors by coordinates and links by their connectors.

use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

use super::error::{Error, quote};
use super::sketch::{Sketch, SketchInput, Slider, SliderLine, parse_number};

const ORIGIN: &str = "a file of Linkage";

/// The layer of what is drawn for show; it does not move, unless it is fastened to a link.
const DRAWING_LAYER: &str = "1";

/// Whether a text is XML.
pub fn is_xml(text: &str) -> bool {
    text.starts_with('<')
}

/// Whether a text is XML that begins as a file of Linkage does.
pub fn is_linkage2(text: &str) -> bool {
    let root = text.split('<').find(|part| part.starts_with(|c: char| c.is_ascii_alphabetic()));
    is_xml(text) && root.is_some_and(|root| root.starts_with("linkage2"))
}

/// Reads a linkage.
///
/// # Errors
/// The text is not well-formed XML, a connector or a link is wrong, or it has gears or curved slots.
pub fn parse(text: &str) -> Result<Sketch, Error> {
    let file = File::read(text)?;
    let mut sketch = Sketch::new(ORIGIN);
    let kept: Vec<&Connector> = file.connectors.iter().filter(|connector| !connector.is_show).collect();
    for connector in &kept {
        let joint = sketch.add_joint(connector.name.as_str(), connector.position)?;
        sketch.joints[joint].is_fixed = connector.is_anchor;
        sketch.joints[joint].is_traced = connector.is_traced;
    }
    let find = |id: &str, place: &str| {
        kept.iter().position(|connector| connector.id == id).ok_or_else(|| {
            let message = format!("there is no connector {}", quote(id));
            Error::new(place, message, "name a connector by its id, or leave it out")
        })
    };
    for connector in kept.iter().filter(|connector| connector.is_slider) {
        let [from, to] = &connector.limits[..] else {
            let message = format!("it slides, and has {} limits, not 2", connector.limits.len());
            return Err(Error::new(&connector.place, message, "give the two connectors between which it slides"));
        };
        let line = SliderLine::Joints([find(from, &connector.place)?, find(to, &connector.place)?]);
        let joint = find(&connector.id, &connector.place)?;
        sketch.sliders.push(Slider { joint, line, block: None });
    }
    let mut actuators = Vec::new();
    // The index in the sketch of each link of the file that is in it.
    let mut indices = Vec::new();
    for link in file.links.iter().filter(|link| !link.is_show) {
        let joints = link.connectors.iter().map(|id| find(id, &link.place)).collect::<Result<Vec<_>, _>>()?;
        if link.is_actuator {
            match joints[..] {
                [a, b] if a != b => actuators.push([a, b]),
                _ => return Err(Error::new(&link.place, "the actuator is not between two connectors", "give it two")),
            }
            continue;
        }
        let index = sketch.add_link(link.name.as_str())?;
        joints.into_iter().for_each(|joint| sketch.attach(index, joint));
        // What is fastened to a link moves with it; of the rest of the drawing nothing is kept.
        for joint in link.fastened_connectors.iter().filter_map(|id| find(id, "").ok()) {
            sketch.attach(index, joint);
        }
        indices.push((link, index));
    }
    for &(link, index) in &indices {
        for &(_, other) in indices.iter().filter(|(other, _)| link.fastened_links.contains(&other.id)) {
            let joints = if other == index { Vec::new() } else { std::mem::take(&mut sketch.links[other].joints) };
            joints.into_iter().for_each(|joint| sketch.attach(index, joint));
        }
    }
    slide_pins(&mut sketch);
    let pivots = kept.iter().enumerate().filter(|(_, connector)| connector.is_input);
    let pivots = pivots.map(|(joint, _)| SketchInput::Pivot(joint));
    let mut inputs = pivots.chain(actuators.into_iter().map(SketchInput::Distance));
    sketch.input = inputs.next();
    for further in inputs {
        let names: Vec<String> = further.joints().into_iter().map(|joint| quote(&sketch.joints[joint].name)).collect();
        sketch.note(format!("{} is a second input, which was left out", names.join(" to ")));
    }
    if kept.len() < file.connectors.len() {
        sketch.note("what is drawn for show was left out");
    }
    sketch.note("speeds, limits of motions, colours, sizes and settings were left out");
    match (file.unit, file.scale) {
        (unit, None) => sketch.unit = unit,
        (unit, Some(scale)) => sketch.note(format!(
            "lengths are those of the file; the program multiplies them by {scale} and calls them {}",
            quote(unit.as_deref().unwrap_or_default())
        )),
    }
    Ok(sketch)
}

/// Where a link slides by two of its joints on one line, as a piston does, it is a joint of another link that slides in place of
/// one of them, for it is from this that the other link is placed; all joints of the link move alike.
fn slide_pins(sketch: &mut Sketch) {
    for link in 0..sketch.links.len() {
        let joints = &sketch.links[link].joints;
        let line = |slider: &Slider| slider.line_joints().to_vec();
        let on_link: Vec<usize> =
            (0..sketch.sliders.len()).filter(|&k| joints.contains(&sketch.sliders[k].joint)).collect();
        let &[first, second] = &on_link[..] else { continue };
        let is_piston = line(&sketch.sliders[first]) == line(&sketch.sliders[second]);
        let slides = |joint: usize| on_link.iter().any(|&k| sketch.sliders[k].joint == joint);
        let is_pin = |joint: usize| sketch.links_at(joint).len() > 1;
        let pin = joints.iter().copied().find(|&joint| is_pin(joint) && !slides(joint));
        if let Some(pin) = pin.filter(|_| is_piston) {
            let free = on_link.into_iter().find(|&k| !is_pin(sketch.sliders[k].joint));
            free.into_iter().for_each(|k| sketch.sliders[k].joint = pin);
        }
    }
}

/// What a file has.
#[derive(Default)]
struct File {
    connectors: Vec<Connector>,
    links: Vec<Link>,
    unit: Option<String>,
    /// By what lengths are multiplied, if not by 1.
    scale: Option<f64>,
}

struct Connector {
    id: String,
    name: String,
    /// The place in the file, as in "line 3, connector `2`".
    place: String,
    position: [f64; 2],
    is_anchor: bool,
    is_input: bool,
    is_traced: bool,
    is_slider: bool,
    is_show: bool,
    /// The ids of the connectors between which it slides.
    limits: Vec<String>,
}

struct Link {
    id: String,
    name: String,
    place: String,
    is_actuator: bool,
    is_show: bool,
    connectors: Vec<String>,
    fastened_connectors: Vec<String>,
    fastened_links: Vec<String>,
}

impl File {
    fn read(text: &str) -> Result<File, Error> {
        /// A file, a link, one of its connectors.
        const MAX_DEPTH: usize = 8;
        let mut file = File::default();
        let mut open: Vec<String> = Vec::new();
        let mut xml = Reader::from_str(text);
        let (mut line, mut counted) = (1, 0);
        loop {
            let position = (xml.buffer_position() as usize).min(text.len());
            line += text.as_bytes()[counted..position].iter().filter(|byte| **byte == b'\n').count();
            counted = position;
            let wrong =
                |message: String| Error::new(format!("line {line}"), message, "save the file again where it was made");
            let event = xml.read_event().map_err(|error| wrong(format!("it is not well-formed XML: {error}")))?;
            match event {
                Event::Start(element) => {
                    if open.len() >= MAX_DEPTH {
                        return Err(wrong("elements are nested too deeply".to_owned()));
                    }
                    let element = Element::new(&element, line)?;
                    file.add(&element, &open)?;
                    open.push(element.name);
                }
                Event::Empty(element) => file.add(&Element::new(&element, line)?, &open)?,
                Event::End(_) => drop(open.pop()),
                Event::Eof if !open.is_empty() => {
                    return Err(wrong("it is not well-formed XML: it ends within an element".to_owned()));
                }
                Event::Eof => return Ok(file),
                _ => {}
            }
        }
    }

    /// Adds what an element is, in the elements that are open around it.
    fn add(&mut self, element: &Element, open: &[String]) -> Result<(), Error> {
        if open.is_empty() {
            let is_linkage = element.name == "linkage2";
            return if is_linkage { Ok(()) } else { Err(element.error("the XML is not that of Linkage")) };
        }
        let id = || element.id();
        match (open.get(1).map(String::as_str), element.name.as_str()) {
            (None, "program") => {
                self.unit = element.get("units").map(str::to_owned);
                let scale = element.get("scalefactor").map(|text| parse_number(text, &element.place, "scalefactor"));
                self.scale = scale.transpose()?.filter(|scale| *scale != 1.0);
            }
            (None, "connector") => self.connectors.push(element.connector()?),
            (None, "link") => self.links.push(element.link()?),
            (Some("connector"), "slidelimit") => {
                let id = id()?;
                self.connectors.last_mut().into_iter().for_each(|connector| connector.limits.push(id.clone()));
            }
            (Some("link"), kind @ ("connector" | "fastenconnector" | "fastenlink")) => {
                let id = id()?;
                if let Some(link) = self.links.last_mut() {
                    match kind {
                        "connector" => link.connectors.push(id),
                        "fastenconnector" => link.fastened_connectors.push(id),
                        _ => link.fastened_links.push(id),
                    }
                }
            }
            (Some("ratios"), "ratio") => {
                let message = "gears and chains, which a drawing cannot express";
                let remedy =
                    "leave them out there, or write the gear as a joint of [linkage.joints] (docs/manifest.md)";
                return Err(Error::new(&element.place, message, remedy));
            }
            _ => {}
        }
        Ok(())
    }
}

/// An element with its attributes.
struct Element {
    /// In lower case.
    name: String,
    attributes: Vec<(String, String)>,
    /// Its line.
    place: String,
}

impl Element {
    fn new(element: &BytesStart, line: usize) -> Result<Element, Error> {
        let name = element.local_name().as_ref().to_ascii_lowercase();
        let place = format!("line {line}, `{name}`");
        let mut attributes = Vec::new();
        for attribute in element.attributes() {
            let attribute = attribute.map_err(|error| {
                Error::new(&place, format!("an attribute cannot be read: {error}"), "write it as in id=\"1\"")
            })?;
            let value = attribute.normalized_value(XmlVersion::Explicit1_0);
            let value = value.unwrap_or_else(|_| attribute.value.clone());
            attributes.push((attribute.key.as_ref().to_ascii_lowercase(), value.into_owned()));
        }
        Ok(Element { name, attributes, place })
    }

    fn get(&self, key: &str) -> Option<&str> {
        self.attributes.iter().find(|(name, _)| name == key).map(|(_, value)| value.as_str())
    }

    fn is_set(&self, key: &str) -> bool {
        self.get(key).is_some_and(|value| value.eq_ignore_ascii_case("true"))
    }

    fn error(&self, message: impl std::fmt::Display) -> Error {
        Error::new(&self.place, message, "give a .linkage2 file, as the program Linkage saves it")
    }

    fn id(&self) -> Result<String, Error> {
        self.get("id").map(str::to_owned).ok_or_else(|| self.error("it has no `id`"))
    }

    /// Its name, or else its id after a letter.
    fn title(&self, letter: char) -> Result<String, Error> {
        let name = self.get("name").filter(|name| !name.trim().is_empty());
        name.map_or_else(|| Ok(format!("{letter}{}", self.id()?)), |name| Ok(name.to_owned()))
    }

    fn is_show(&self) -> bool {
        self.get("layer") == Some(DRAWING_LAYER) || self.is_set("measurementelement")
    }

    fn connector(&self) -> Result<Connector, Error> {
        let id = self.id()?;
        let place = format!("{} {}", self.place, quote(&id));
        let number = |key: &str| parse_number(self.get(key).unwrap_or_default(), &place, key);
        let is_straight = self.get("slideradius").is_none() || number("slideradius")? == 0.0;
        if !is_straight {
            let remedy = "make its `slideradius` 0, or replace it by a link from the centre of the arc";
            return Err(Error::new(&place, "it slides on an arc, which a drawing cannot express", remedy));
        }
        Ok(Connector {
            name: self.title('J')?,
            position: [number("x")?, number("y")?],
            is_anchor: self.is_set("anchor"),
            is_input: self.is_set("input"),
            is_traced: self.is_set("draw"),
            is_slider: self.is_set("slider"),
            is_show: self.is_show(),
            limits: Vec::new(),
            id,
            place,
        })
    }

    fn link(&self) -> Result<Link, Error> {
        let id = self.id()?;
        Ok(Link {
            name: self.title('L')?,
            place: format!("{} {}", self.place, quote(&id)),
            is_actuator: self.is_set("actuator"),
            is_show: self.is_show(),
            connectors: Vec::new(),
            fastened_connectors: Vec::new(),
            fastened_links: Vec::new(),
            id,
        })
    }
}
