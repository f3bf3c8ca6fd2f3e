//! PMKS+ addresses in the readable form: `?j=JOINTS&l=LINKS`.

use super::error::{Error, quote};
use super::pmks::{self, ORIGIN, PmksJoint, PmksLink};
use super::sketch::{Sketch, parse_number};

/// What is to be done with an address that is not whole.
const COPY_AGAIN: &str = "copy the whole address again";

/// The part of an address after its `?`.
pub fn query(text: &str) -> Option<&str> {
    text.trim().split_once('?').map(|(_, query)| query)
}

/// Whether a query has the keys of the readable form.
pub fn is_readable(query: &str) -> bool {
    query.split('&').any(|part| part.starts_with("j=") || part.starts_with("l="))
}

/// Angles have all their digits.
const ROUNDING: f64 = 1e-12;

/// Reads the linkage of an address.
///
/// # Errors
/// A joint or a link is wrong.
pub fn parse(query: &str) -> Result<Sketch, Error> {
    let value = |key: &str| {
        let part = query.split('&').find_map(|part| part.strip_prefix(key)?.strip_prefix('='));
        part.map(|part| percent_decoded(part, &format!("`{key}`"))).transpose()
    };
    let text = value("j")?.ok_or_else(|| Error::new(ORIGIN, "it has no joints, `j=`", COPY_AGAIN))?;
    let mut ids: Vec<String> = Vec::new();
    let mut joints = Vec::new();
    let mut links: Vec<PmksLink> = Vec::new();
    for (k, line) in lines(&text).enumerate() {
        let place = format!("`j`, joint {}", k + 1);
        let fields: Vec<&str> = line.split(',').map(str::trim).collect();
        let [id, x, y, on, kind, ground, angle, _friction, input, ..] = fields[..] else {
            let message = format!("it has {} of 9 fields, {}", fields.len(), quote(line));
            return Err(Error::new(place, message, COPY_AGAIN));
        };
        let is_slider = match kind {
            "R" => false,
            "P" => true,
            _ => {
                let message = format!("its type is {}", quote(kind));
                return Err(Error::new(place, message, "a joint is R, a pin, or P, a slider"));
            }
        };
        for name in names(on) {
            let link = find_link(name, &mut links);
            check_count(links.len())?;
            if !links[link].joints.contains(&k) {
                links[link].joints.push(k);
            }
        }
        ids.push(id.to_owned());
        joints.push(PmksJoint {
            name: id.to_owned(),
            position: [parse_number(x, &place, "x")?, parse_number(y, &place, "y")?],
            is_slider,
            is_input: is_true(input, &place, "input")?,
            is_ground: is_true(ground, &place, "ground")?,
            is_traced: false,
            angle: if is_slider { parse_number(angle, &place, "the angle")? } else { 0.0 },
        });
        check_count(joints.len())?;
    }
    for (k, line) in lines(&value("l")?.unwrap_or_default()).enumerate() {
        let place = format!("`l`, link {}", k + 1);
        let fields: Vec<&str> = line.split(',').map(str::trim).collect();
        let (Some(name), Some(own)) = (fields.first(), fields.get(5)) else {
            let message = format!("it has {} of 8 fields, {}", fields.len(), quote(line));
            return Err(Error::new(place, message, COPY_AGAIN));
        };
        let link = find_link(name, &mut links);
        check_count(links.len())?;
        for id in names(own) {
            // Several joints may have one id; those that name the link are on it already.
            if links[link].joints.iter().any(|&joint| ids[joint] == id) {
                continue;
            }
            let joint = ids
                .iter()
                .position(|known| known == id)
                .ok_or_else(|| Error::new(&place, format!("there is no joint {}", quote(id)), COPY_AGAIN))?;
            links[link].joints.push(joint);
        }
    }
    let mut sketch = pmks::sketch(&joints, &links, ROUNDING)?;
    if value("f")?.is_some_and(|forces| !forces.trim().is_empty()) {
        sketch.note("forces were left out");
    }
    Ok(sketch)
}

fn lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines().map(str::trim).filter(|line| !line.is_empty())
}

/// The names in a list such as `AB|BCM`.
fn names(list: &str) -> impl Iterator<Item = &str> {
    list.split('|').map(str::trim).filter(|name| !name.is_empty())
}

fn find_link(name: &str, links: &mut Vec<PmksLink>) -> usize {
    links.iter().position(|link| link.name == name).unwrap_or_else(|| {
        links.push(PmksLink { name: name.to_owned(), joints: Vec::new(), is_piston: false });
        links.len() - 1
    })
}

fn check_count(count: usize) -> Result<(), Error> {
    let max = Sketch::MAX_PARTS;
    let message = format!("it has more than {max} joints or links, the most that are read");
    if count <= max { Ok(()) } else { Err(Error::new(ORIGIN, message, "import the part that traces the curve")) }
}

fn is_true(text: &str, place: &str, what: &str) -> Result<bool, Error> {
    match text {
        "t" => Ok(true),
        "f" => Ok(false),
        _ => Err(Error::new(place, format!("expected t or f for {what}, found {}", quote(text)), COPY_AGAIN)),
    }
}

/// A text with the characters that `%` and two hexadecimal digits stand for.
pub fn percent_decoded(text: &str, place: &str) -> Result<String, Error> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let [first, others @ ..] = rest {
        rest = others;
        if *first != b'%' {
            bytes.push(*first);
            continue;
        }
        let digit = |byte: &u8| char::from(*byte).to_digit(16);
        let code = others.first().and_then(digit).zip(others.get(1).and_then(digit));
        let Some((high, low)) = code else {
            return Err(Error::new(place, "it has a % without two hexadecimal digits", COPY_AGAIN));
        };
        bytes.push((high * 16 + low) as u8);
        rest = &others[2..];
    }
    String::from_utf8(bytes).map_err(|_| Error::new(place, "it is not UTF-8", COPY_AGAIN))
}
