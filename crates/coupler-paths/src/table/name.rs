//! The names of the columns of a table.

/// The name of a column.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ColumnName {
    /// As it is written.
    pub text: String,
    /// Its words in small letters, without the unit.
    words: Vec<String>,
    /// The unit in small letters.
    pub unit: Option<String>,
}

/// Units that are known without brackets, as in `x_mm`.
const UNITS: [&str; 20] = [
    "mm", "cm", "m", "um", "µm", "km", "in", "inch", "inches", "ft", "px", "pixel", "pixels", "pt", "deg", "degree",
    "degrees", "rad", "radian", "radians",
];

/// First words of columns that are no coordinates, as in `v_x`.
const DERIVED: [&str; 13] = [
    "vel",
    "velocity",
    "speed",
    "acc",
    "acceleration",
    "delta",
    "err",
    "error",
    "std",
    "sd",
    "sigma",
    "force",
    "momentum",
];

/// Letters that are first words of columns that are no coordinates, or are joints, as in `a_x`.
const DERIVED_OR_JOINTS: [&str; 3] = ["v", "a", "d"];

/// First words of the names of the angle of a crank.
const CRANKS: [&str; 4] = ["input", "crank", "kurbel", "kurbelwinkel"];

/// Names of any angle.
const ANGLES: [&str; 12] =
    ["theta", "θ", "phi", "φ", "ϕ", "psi", "ψ", "alpha", "α", "winkel", "drehwinkel", "rotation"];

impl ColumnName {
    pub fn new(text: &str) -> ColumnName {
        let lower = text.to_lowercase();
        let (base, mut unit) = match lower.find(['[', '(']) {
            Some(at) => (&lower[..at], Some(lower[at + 1..].trim_end_matches([' ', ']', ')']).trim().to_owned())),
            None => match lower.split_once('/') {
                Some((base, unit)) if unit.trim() == "°" || unit.trim().chars().all(char::is_alphabetic) => {
                    (base, Some(unit.trim().to_owned()))
                }
                _ => (&*lower, None),
            },
        };
        let words = base.split(|c: char| !c.is_alphanumeric() && c != '°').filter(|word| !word.is_empty());
        let mut words: Vec<String> = words.map(str::to_owned).collect();
        // As in `a (x)`.
        if words.len() == 1 && unit.as_deref().is_some_and(|unit| ["x", "y"].contains(&unit)) {
            words.extend(unit.take());
        }
        if unit.is_none() && words.len() > 1 && words.last().is_some_and(|word| UNITS.contains(&&**word) || word == "°")
        {
            unit = words.pop();
        }
        ColumnName { text: text.to_owned(), words, unit: unit.filter(|unit| !unit.is_empty()) }
    }

    /// How surely it is the name of a coordinate: 0 for the letter alone, 1 where it is the first word, 2 where it is the last.
    pub fn coordinate_rank(&self, letter: char) -> Option<u8> {
        let is_letter = |word: &String| {
            word.strip_prefix(letter).is_some_and(|rest| rest.bytes().all(|byte| byte.is_ascii_digit()))
        };
        let joined = |word: &String| {
            ["pos", "coord", "data", "value"]
                .iter()
                .any(|part| word.strip_prefix(letter) == Some(part) || word.strip_suffix(letter) == Some(part))
        };
        match &self.words[..] {
            [only] if *only == letter.to_string() => Some(0),
            [first, ..] if is_letter(first) || joined(first) => Some(1),
            [first, .., last] if is_letter(last) && !DERIVED.contains(&&**first) => Some(2),
            _ => None,
        }
    }

    /// What it has besides the letter of a coordinate and the unit, as `A` of `A_x [mm]`; `None` if that is nothing or a number, which would be
    /// taken for that of a path.
    pub fn without_coordinate(&self, letter: char) -> Option<&str> {
        const DIVIDERS: [char; 10] = [' ', '\t', '_', '.', '-', ':', '/', '{', '(', '['];
        let rank = self.coordinate_rank(letter)?;
        let text = self.text.as_str();
        let is_letter = |at: &(usize, char)| at.1.eq_ignore_ascii_case(&letter);
        let rest = match rank {
            0 => return None,
            1 => {
                let word = text.find(|c: char| c.is_alphanumeric())?;
                let end = text[word..].find(|c: char| !c.is_alphanumeric())?;
                let rest = text[word + end..].trim_start_matches(DIVIDERS);
                rest.find(['[', '(']).map_or(rest, |unit| &rest[..unit])
            }
            // Before the last letter that begins a word.
            _ => {
                let begins_word = |at: usize| !text[..at].ends_with(char::is_alphanumeric);
                let (at, _) = text.char_indices().filter(is_letter).rfind(|(at, _)| begins_word(*at))?;
                &text[..at]
            }
        };
        let rest = rest.trim_matches(DIVIDERS);
        (!rest.is_empty() && !rest.chars().all(char::is_numeric)).then_some(rest)
    }

    /// Whether it may be that of a velocity or an acceleration as well as that of a coordinate of a joint.
    pub fn may_be_derived(&self) -> bool {
        self.words.len() > 1 && DERIVED_OR_JOINTS.contains(&&*self.words[0])
    }

    /// How surely it is the name of the angle of the crank: 0 for `angle`, 1 for one of a crank or input, or with the word angle, 2 for a letter
    /// that is usual for angles.
    pub fn angle_rank(&self) -> Option<u8> {
        let has = |word: &str| self.words.iter().any(|own| own == word);
        match &self.words[..] {
            [only] if only == "angle" => Some(0),
            _ if has("length") => None,
            [first, ..] if CRANKS.contains(&&**first) || has("angle") || has("winkel") => Some(1),
            [only] if ANGLES.contains(&&**only) => Some(2),
            _ => None,
        }
    }

    /// Whether it is that of time, of an index or of another number that counts rows.
    pub fn is_count(&self) -> bool {
        const COUNTS: [&str; 12] =
            ["", "t", "time", "zeit", "temps", "tiempo", "frame", "index", "i", "n", "no", "sample"];
        COUNTS.contains(&self.words.first().map_or("", String::as_str))
    }

    /// Whether it is this word and nothing else.
    pub fn is(&self, word: &str) -> bool {
        self.words == [word]
    }

    /// Whether it may be a name: text that begins with a letter, or nothing.
    pub fn is_name(cell: &str) -> bool {
        let is_text = cell.chars().next().is_none_or(|c| c.is_alphabetic() || matches!(c, '[' | '(' | '_' | '#' | '°'));
        is_text && cell.parse::<f64>().is_err()
    }
}

/// Degrees in an angle's unit.
///
/// # Errors
/// The unit is none of an angle.
pub(super) fn degrees_in(unit: Option<&str>) -> Result<f64, String> {
    match unit {
        None | Some("deg" | "degree" | "degrees" | "°") => Ok(1.0),
        Some("rad" | "radian" | "radians") => Ok(180.0 / std::f64::consts::PI),
        Some("rev" | "revs" | "turn" | "turns" | "revolution" | "revolutions") => Ok(360.0),
        Some(unit) => Err(format!("the unit `{unit}` of the angle is not known: write the angle in deg, rad or turns")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_words_and_units() {
        for (text, unit, ranks) in [
            ("x", None, [Some(0), None]),
            ("X [mm]", Some("mm"), [Some(0), None]),
            ("y (px)", Some("px"), [None, Some(0)]),
            ("x/mm", Some("mm"), [Some(0), None]),
            ("x_mm", Some("mm"), [Some(0), None]),
            ("Y-Wert", None, [None, Some(1)]),
            ("x1", None, [Some(1), None]),
            ("Trajectory 1/0 X", None, [Some(2), None]),
            ("pos_y", None, [None, Some(2)]),
            ("xpos", None, [Some(1), None]),
            ("v_x", None, [Some(2), None]),
            ("v_{x}", None, [Some(2), None]),
            ("vel_x", None, [None, None]),
            ("max", None, [None, None]),
            ("sax", None, [None, None]),
        ] {
            let name = ColumnName::new(text);
            assert_eq!(name.unit.as_deref(), unit, "{text}");
            assert_eq!(['x', 'y'].map(|letter| name.coordinate_rank(letter)), ranks, "{text}");
        }
        for text in ["angle [rad]", "theta (rad)", "θ", "crank angle", "input_deg", "Angle/°", "Drehwinkel angle"] {
            assert!(ColumnName::new(text).angle_rank().is_some(), "{text}");
        }
        for text in ["input_length", "x", "θ_{r}", "theta_v"] {
            assert_eq!(ColumnName::new(text).angle_rank(), None, "{text}");
        }
        for (text, rest) in [
            ("a x", Some("a")),
            ("A_x", Some("A")),
            ("A.X [mm]", Some("A")),
            ("A_x_mm", Some("A")),
            ("a (x)", Some("a")),
            ("a[x]", Some("a")),
            ("x a", Some("a")),
            ("x_a (mm)", Some("a")),
            ("v_{x}", Some("v")),
            ("Trajectory 1/0 X", Some("Trajectory 1/0")),
            ("pos_x", Some("pos")),
            ("x", None),
            ("X [mm]", None),
            ("x1", None),
            ("x_1", None),
            ("Kurbel Ä x", Some("Kurbel Ä")),
        ] {
            assert_eq!(ColumnName::new(text).without_coordinate('x'), rest, "{text}");
        }
        assert_eq!(degrees_in(ColumnName::new("theta_rad").unit.as_deref()), Ok(180.0 / std::f64::consts::PI));
        assert_eq!(degrees_in(ColumnName::new("angle/°").unit.as_deref()), Ok(1.0));
        assert!(degrees_in(Some("gon")).is_err());
    }
}
