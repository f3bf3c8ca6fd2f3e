//! PMKS+ addresses in the short form: a payload after `?`, with sections that end with a full stop and numbers in base 64.

use super::error::{Error, quote};
use super::pmks::{self, ORIGIN, PmksJoint, PmksLink};
use super::pmks_address::percent_decoded;
use super::sketch::Sketch;

/// The digits of numbers, of which the last two are not those of the length at the end.
const DIGITS: &str = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-";

/// The values of the digits of the length at the end.
const LENGTH_BASE: usize = 62;

const COPY_AGAIN: &str = "copy the whole address again";

/// The flags of a joint.
const SLIDER: u64 = 1;
const INPUT: u64 = 2;
const GROUND: u64 = 4;
const SHOWN: u64 = 16;

/// Angles are rounded to a thousandth.
const ROUNDING: f64 = 0.000_6;

/// Reads the linkage of an address.
///
/// # Errors
/// The payload is not whole, or a joint or a link is wrong.
pub fn parse(query: &str) -> Result<Sketch, Error> {
    let payload = percent_decoded(query, ORIGIN)?;
    let has_length = |text: &str| {
        let mut characters = text.chars();
        let last = characters.next_back().and_then(digit);
        last.is_some_and(|last| last as usize == characters.count() % LENGTH_BASE)
    };
    let is_whole = has_length(query) || has_length(&payload);
    let sections: Vec<&str> = payload.split('.').collect();
    // Before the joints: flags, decimal numbers, whole numbers and choices of the settings.
    const SETTINGS: usize = 4;
    if !is_whole || sections.len() <= SETTINGS {
        let message = "its last character is not that of its length, so that a part is missing";
        return Err(Error::new(ORIGIN, message, COPY_AGAIN));
    }
    let mut rest = sections[SETTINGS..].iter().copied();
    let joint_texts: Vec<&str> = rest.by_ref().take_while(|text| !text.is_empty()).collect();
    let link_texts: Vec<&str> = rest.by_ref().take_while(|text| !text.is_empty()).collect();
    if joint_texts.len().max(link_texts.len()) > Sketch::MAX_PARTS {
        let message = format!("it has more than {} joints or links, the most that are read", Sketch::MAX_PARTS);
        return Err(Error::new(ORIGIN, message, "import the part that traces the curve"));
    }
    let mut ids = Vec::new();
    let mut joints = Vec::new();
    for (k, text) in joint_texts.into_iter().enumerate() {
        let place = format!("joint {}", k + 1);
        let [head, name, x, y, angle] = text.split(',').collect::<Vec<_>>()[..] else {
            return Err(Error::new(place, format!("expected 5 fields, found {}", quote(text)), COPY_AGAIN));
        };
        let (flags, id) = split_first(head).ok_or_else(|| Error::new(&place, "it has no flags", COPY_AGAIN))?;
        let flags = digit(flags)
            .ok_or_else(|| Error::new(&place, format!("its flags are {}", quote(&flags.to_string())), COPY_AGAIN))?;
        let position = [number(x, &place)?, number(y, &place)?];
        let has = |flag: u64| flags & flag != 0;
        joints.push(PmksJoint {
            name: if name.trim().is_empty() { id } else { name }.to_owned(),
            position,
            is_slider: has(SLIDER),
            is_input: has(INPUT),
            is_ground: has(GROUND),
            is_traced: has(SHOWN),
            angle: number(angle, &place)?,
        });
        ids.push(id);
    }
    let mut links = Vec::new();
    for (k, text) in link_texts.into_iter().enumerate() {
        links.extend(link(text, &ids, &format!("link {}", k + 1))?);
    }
    let mut sketch = pmks::sketch(&joints, &links, ROUNDING)?;
    if rest.next().is_some_and(|force| force.chars().count() > 1) {
        sketch.note("forces were left out");
    }
    Ok(sketch)
}

/// A link; `None` for one that is welded into another.
fn link(text: &str, ids: &[&str], place: &str) -> Result<Option<PmksLink>, Error> {
    let wrong = || Error::new(place, format!("it is not the text of a link: {}", quote(text)), COPY_AGAIN);
    let (root, rest) = split_first(text).ok_or_else(wrong)?;
    let (kind, rest) = split_first(rest).ok_or_else(wrong)?;
    let (is_root, is_piston) = match (root, kind) {
        ('Y' | 'N', 'R' | 'P') => (root == 'Y', kind == 'P'),
        _ => return Err(wrong()),
    };
    let fields: Vec<&str> = rest.split(',').collect();
    // Before the joints: id, name, mass, inertia, the two coordinates of the centre of mass, colour.
    let [id, name, _, _, _, _, _, own @ ..] = &fields[..] else { return Err(wrong()) };
    let mut joints = Vec::new();
    // After an empty field the welded links follow.
    for own in own.iter().take_while(|own| !own.is_empty()) {
        let joint = ids.iter().position(|id| id == own);
        joints.push(joint.ok_or_else(|| Error::new(place, format!("there is no joint {}", quote(own)), COPY_AGAIN))?);
    }
    let name = if name.trim().is_empty() { id } else { name };
    Ok(is_root.then(|| PmksLink { name: (*name).to_owned(), joints, is_piston }))
}

/// The first character of a text, and the others.
fn split_first(text: &str) -> Option<(char, &str)> {
    let mut characters = text.chars();
    Some((characters.next()?, characters.as_str()))
}

fn digit(c: char) -> Option<u64> {
    DIGITS.find(c).map(|place| place as u64)
}

/// A number: a thousand times its value in base 64, negative after a leading 0.
fn number(text: &str, place: &str) -> Result<f64, Error> {
    /// With more digits, a whole number is not one that a float has exactly.
    const MAX_DIGITS: usize = 8;
    let (sign, digits) = match text.strip_prefix('0') {
        Some(digits) if !digits.is_empty() => (-1.0, digits),
        _ => (1.0, text),
    };
    let is_short = (1..=MAX_DIGITS).contains(&digits.len());
    let thousands = digits.chars().try_fold(0, |sum: u64, c| Some(sum * 64 + digit(c)?)).filter(|_| is_short);
    let thousands = thousands
        .ok_or_else(|| Error::new(place, format!("{} is not a number in base 64", quote(text)), COPY_AGAIN))?;
    Ok(sign * thousands as f64 / 1000.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_thousandths_in_base_64() {
        for (text, value) in [("0", 0.0), ("0wS", -3.74), ("0bg", -2.41), ("1", 0.001), ("Fc", 0.998), ("10", 0.064)] {
            assert_eq!(number(text, ""), Ok(value), "{text}");
        }
        for text in ["", "!", "1é", "123456789"] {
            assert!(number(text, "").is_err(), "{text}");
        }
    }
}
