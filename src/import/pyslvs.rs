//! Pyslvs: an expression of joints, `M[J[R, P[0, 0], L[ground, link_1]], …]`.

use coupler_curves::geometry::trig;

use super::error::{Error, quote};
use super::sketch::{Sketch, Slider, SliderLine, parse_number};

const ORIGIN: &str = "a Pyslvs expression";

/// The link that is the frame.
const GROUND: &str = "ground";

/// Whether a text begins like an expression.
pub fn is_pyslvs(text: &str) -> bool {
    let rest = text.trim_start().strip_prefix('M').map(str::trim_start);
    rest.is_some_and(|rest| rest.starts_with(['[', '(']))
}

/// Reads the linkage of an expression.
///
/// # Errors
/// The brackets are not closed, or a joint is wrong.
pub fn parse(text: &str) -> Result<Sketch, Error> {
    let mut parser = Parser { text, at: 0 };
    let whole = parser.term(0)?;
    parser.skip_blanks();
    if parser.at < text.len() {
        return Err(parser.error(format!("{} follows the expression", quote(&text[parser.at..])), "leave it out"));
    }
    if whole.name != "M" {
        return Err(Error::new(ORIGIN, format!("it begins with {}", quote(whole.name)), "write M[…]"));
    }
    let mut sketch = Sketch::new(ORIGIN);
    for (k, term) in whole.parts.unwrap_or_default().iter().enumerate() {
        add_joint(term, k, &mut sketch)?;
    }
    sketch.note("colours were left out");
    Ok(sketch)
}

fn add_joint(term: &Term, k: usize, sketch: &mut Sketch) -> Result<(), Error> {
    let place = format!("joint {k}");
    let wrong = |message: String| Error::new(&place, message, "write it as in J[R, P[0, 0], L[ground, link_1]]");
    let parts = term.parts.as_deref().filter(|_| term.name == "J");
    let parts = parts.ok_or_else(|| wrong(format!("expected J[…], found {}", quote(term.name))))?;
    // A type P has the name of the position, but no brackets.
    let part = |name: &str| parts.iter().filter(|part| part.name == name).find_map(|part| part.parts.as_deref());
    let Some([x, y]) = part("P").map(|xy| [xy.first(), xy.get(1)]) else {
        return Err(wrong("it has no position, P[x, y]".to_owned()));
    };
    let number = |term: Option<&Term>, what: &str| parse_number(term.map_or("", |term| term.name), &place, what);
    let joint = sketch.add_joint(format!("P{k}"), [number(x, "x")?, number(y, "y")?])?;
    let names: Vec<&str> = part("L").unwrap_or_default().iter().map(|link| link.name).collect();
    let kind = parts.first().map_or("", |kind| kind.name);
    let is_slider = match kind {
        "R" => false,
        "P" | "RP" if parts[0].parts.is_none() => true,
        _ => return Err(wrong(format!("its type is {}, not R, P or RP", quote(kind)))),
    };
    if !is_slider {
        sketch.joints[joint].is_fixed = names.contains(&GROUND);
        for name in names.into_iter().filter(|name| *name != GROUND) {
            let link = sketch.link_named(name)?;
            sketch.attach(link, joint);
        }
        return Ok(());
    }
    let angle = number(part("A").and_then(<[Term]>::first), "the angle, A[…]")?;
    // The line is on the frame, or else on the link that is named first.
    let carrier_name = names.iter().find(|name| **name == GROUND).or(names.first()).copied();
    let Some(carrier_name) = carrier_name.filter(|_| names.len() > 1) else {
        return Err(wrong("it slides, and has fewer than two links".to_owned()));
    };
    let carrier = if carrier_name == GROUND { None } else { Some(sketch.link_named(carrier_name)?) };
    let mut block = None;
    for name in names.into_iter().filter(|name| *name != carrier_name) {
        let link = sketch.link_named(name)?;
        sketch.attach(link, joint);
        // The first link at a slider keeps the direction of the line; at a slot all turn.
        block = block.or((kind == "P").then_some(link));
    }
    let (x, y) = trig::cos_sin_deg(angle);
    sketch.sliders.push(Slider { joint, line: SliderLine::Direction { direction: [x, y], carrier }, block });
    Ok(())
}

/// A word, with the terms in its brackets if it has any.
#[derive(Debug)]
struct Term<'t> {
    name: &'t str,
    parts: Option<Vec<Term<'t>>>,
}

struct Parser<'t> {
    text: &'t str,
    /// The next byte.
    at: usize,
}

impl<'t> Parser<'t> {
    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    fn skip_blanks(&mut self) {
        self.at += self.rest().len() - self.rest().trim_start().len();
    }

    fn error(&self, message: String, remedy: &str) -> Error {
        let before = &self.text[..self.at];
        let line = before.matches('\n').count() + 1;
        let column = before[before.rfind('\n').map_or(0, |end| end + 1)..].chars().count() + 1;
        Error::new(format!("line {line}, column {column}"), message, remedy)
    }

    fn term(&mut self, depth: usize) -> Result<Term<'t>, Error> {
        /// An expression, a joint, one of its parts, a name.
        const MAX_DEPTH: usize = 4;
        self.skip_blanks();
        let start = self.at;
        let length = self.rest().find([',', '[', ']', '(', ')', '\n']).unwrap_or(self.rest().len());
        self.at += length;
        let name = self.text[start..self.at].trim();
        self.skip_blanks();
        let close = match self.rest().chars().next() {
            Some('[') => ']',
            Some('(') => ')',
            _ => return Ok(Term { name, parts: None }),
        };
        if depth == MAX_DEPTH {
            return Err(
                self.error("brackets are nested too deeply".to_owned(), "write joints as in J[R, P[0, 0], L[ground]]")
            );
        }
        self.at += 1;
        let mut parts = Vec::new();
        loop {
            self.skip_blanks();
            if self.rest().starts_with(close) {
                break;
            }
            parts.push(self.term(depth + 1)?);
            self.skip_blanks();
            match self.rest().chars().next() {
                Some(',') => self.at += 1,
                Some(c) if c == close => {}
                found => {
                    let found = found.map_or("the end".to_owned(), |c| quote(&c.to_string()));
                    return Err(
                        self.error(format!("expected `,` or `{close}`, found {found}"), "copy the whole expression")
                    );
                }
            }
        }
        self.at += 1;
        Ok(Term { name, parts: Some(parts) })
    }
}
