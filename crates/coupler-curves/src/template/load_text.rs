//! A load as users write it: `100 on C at -90 deg`.

use crate::expression::{self, Dimension, Expression, Quantity, Scope, displayed_name};
use crate::linkage::Load;
use crate::problem::suggestion;
use crate::template::Template;
use crate::text::format_as_written;

/// How a load is written.
const EXAMPLE: &str = "\"100 on C at -90 deg\", or \"100 on C\" for a force against the motion of C";

/// Why a text is no load of a linkage.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LoadTextError {
    /// It is not a force on a joint.
    #[error("`{0}` is no load; write {EXAMPLE}")]
    Form(String),
    /// A number in it cannot be read.
    #[error("`{text}`: {error}; write {EXAMPLE}")]
    Number {
        /// The text of the number.
        text: String,
        /// What is wrong with it.
        error: expression::Error,
    },
    /// The force is not a finite number greater than 0.
    #[error("the force is {0}, and must be a number greater than 0; write {EXAMPLE}")]
    Force(f64),
    /// The direction is not a finite number.
    #[error("the direction is {0}, and must be a finite number; write {EXAMPLE}")]
    Direction(f64),
    /// The linkage has no such joint, or a grid of them.
    #[error("the linkage has no single joint `{name}`; {suggestion}")]
    Joint {
        /// The name.
        name: String,
        /// The nearest joint, or all of them.
        suggestion: String,
    },
}

impl Template {
    /// Its load as pages state it: "100 on C at −90°", in the direction that it has on paper, or "100 on C, against its motion".
    pub fn load_in_words(&self) -> Option<String> {
        let Load { joint, force, direction_deg } = self.load?;
        let on = format!("{} on {}", format_as_written(force), displayed_name(&self.joints[joint].name));
        Some(match direction_deg {
            Some(deg) => format!("{on} at {}°", format_as_written(self.direction_as_drawn(deg))),
            None => format!("{on}, against its motion"),
        })
    }

    /// The load on one of its joints that a text states: a force, the joint, and the direction in degrees unless a unit is stated, without
    /// which the force is against the motion of the joint.
    ///
    /// # Errors
    /// The text is no load, or there is no such joint.
    pub fn parse_load(&self, text: &str) -> Result<Load<usize>, LoadTextError> {
        let number = |text: &str, value: Result<f64, expression::Error>| {
            value.map_err(|error| LoadTextError::Number { text: text.to_owned(), error })
        };
        let (force, on) = text.split_once(" on ").ok_or_else(|| LoadTextError::Form(text.to_owned()))?;
        let (name, direction) = match on.rsplit_once(" at ") {
            Some((name, direction)) => (name.trim(), Some(direction.trim())),
            None => (on.trim(), None),
        };
        let single = |joint: usize| self.joints[joint].kind.point_count() == 1;
        let joint = (0..self.joints.len()).find(|&k| self.joints[k].name == name && single(k)).ok_or_else(|| {
            let known: Vec<&str> =
                (0..self.joints.len()).filter(|&k| single(k)).map(|k| self.joints[k].name.as_str()).collect();
            LoadTextError::Joint { name: name.to_owned(), suggestion: suggestion(name, &known) }
        })?;
        let force = number(force, Expression::evaluate_constant(force.trim()))?;
        if !(force > 0.0 && force.is_finite()) {
            return Err(LoadTextError::Force(force));
        }
        let direction_deg = match direction {
            None => None,
            Some(direction) => {
                let value = match Quantity::parse(direction, Dimension::Angle) {
                    Ok(quantity) => {
                        quantity.expression.check(&Scope::default()).map(|_| quantity.evaluate(|_| f64::NAN))
                    }
                    // Without a unit.
                    Err(_) => Expression::evaluate_constant(direction),
                };
                Some(number(direction, value)?)
            }
        };
        match direction_deg {
            Some(deg) if !deg.is_finite() => Err(LoadTextError::Direction(deg)),
            direction_deg => Ok(Load { joint, force, direction_deg }),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::catalogue;
    use crate::geometry::Orientation;
    use crate::linkage::Load;

    #[test]
    fn a_load_is_a_force_on_a_joint() {
        let template = catalogue::find("slider-crank").unwrap();
        let joint = template.joints.iter().position(|joint| joint.name == "B").unwrap();
        for (text, force, direction_deg) in [
            ("100 on B at -90 deg", 100.0, Some(-90.0)),
            ("2 * 30 on B at pi rad", 60.0, Some(180.0)),
            ("1e3 on B at 45", 1e3, Some(45.0)),
            ("0.5 on B", 0.5, None),
        ] {
            assert_eq!(template.parse_load(text), Ok(Load { joint, force, direction_deg }), "{text}");
        }
        for (text, message) in [
            ("100", "`100` is no load; write \"100 on C at -90 deg\""),
            ("100 on Z", "the linkage has no single joint `Z`; "),
            ("0 on B", "the force is 0, and must be"),
            ("x on B", "`x`: "),
            ("1 on B at up", "`up`: "),
            ("1 on B at 1/0", "the direction is inf"),
        ] {
            let found = template.parse_load(text).unwrap_err().to_string();
            assert!(found.starts_with(message), "{text}: {found}");
        }
        let grid = catalogue::find("hrones-nelson").unwrap();
        let traced = &grid.joints[grid.traced[0]];
        assert_eq!(grid.parse_load(&format!("1 on {}", traced.name)).is_ok(), traced.kind.point_count() == 1);
    }

    #[test]
    fn in_words_it_has_the_direction_on_paper() {
        let words = |text: &str, is_mirrored: bool, deg: f64| {
            let mut template = (*catalogue::find("slider-crank").unwrap()).clone();
            template.load = Some(template.parse_load(text).unwrap());
            template.orientation = Orientation::new(is_mirrored, deg);
            template.load_in_words().unwrap()
        };
        for (text, is_mirrored, deg, expected) in [
            ("100 on B at -90 deg", false, 0.0, "100 on B at −90°"),
            ("100 on B at -90 deg", true, 0.0, "100 on B at 90°"),
            ("100 on B at -90 deg", false, 90.0, "100 on B at 0°"),
            ("100 on B at 180 deg", false, 90.0, "100 on B at −90°"),
            // A rotation by no quarter turns is stated apart.
            ("100 on B at -90 deg", true, 30.0, "100 on B at 90°"),
            ("0.5 on B", true, 0.0, "0.5 on B, against its motion"),
        ] {
            assert_eq!(words(text, is_mirrored, deg), expected);
        }
    }
}
