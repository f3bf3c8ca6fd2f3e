//! How much a caption says: where it does not fit, derived values are left out, and then the names of those that vary.

/// A form of the captions of a page, the longest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CaptionForm {
    /// As it is given.
    Whole,
    /// What varies, with its names: "p = 2, k = 1.5".
    Varying,
    /// The values of what varies, whose names are elsewhere on the page: "2, 1.5".
    Values,
}

impl CaptionForm {
    pub const ALL: [CaptionForm; 3] = [CaptionForm::Whole, CaptionForm::Varying, CaptionForm::Values];

    /// A caption in this form; whole if nothing varies.
    pub fn text(self, whole: &str, varying: &[String]) -> String {
        match self {
            _ if varying.is_empty() => whole.to_owned(),
            CaptionForm::Whole => whole.to_owned(),
            CaptionForm::Varying => varying.join(", "),
            CaptionForm::Values => {
                let values: Vec<String> = varying.iter().map(|equation| value(equation).replace(" / ", "/")).collect();
                values.join(", ")
            }
        }
    }

    /// What is said on the page of captions in this form, if anything varies.
    pub fn meaning(self, varying: &[String]) -> Option<String> {
        let names = varying.iter().map(|equation| equation.split([' ']).take_while(|word| !is_sign(word)));
        match self {
            _ if varying.is_empty() => None,
            CaptionForm::Whole => None,
            CaptionForm::Varying => Some("captions that do not fit: what varies".to_owned()),
            CaptionForm::Values => {
                let names: Vec<String> = names.map(|words| words.collect::<Vec<_>>().join(" ")).collect();
                Some(format!("captions: {}", names.join(", ")))
            }
        }
    }
}

/// Whether a word is the sign of an equation.
fn is_sign(word: &str) -> bool {
    matches!(word, "=" | "≈")
}

/// The value of an equation, with its sign of approximation.
fn value(equation: &str) -> &str {
    let at = equation.find("≈ ").or_else(|| equation.find("= ").map(|at| at + 2));
    at.map_or(equation, |at| &equation[at..])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_varies_is_left_of_captions() {
        let varying = ["p = 22 / 9".to_owned(), "k ≈ 1.41421".to_owned()];
        let forms = CaptionForm::ALL.map(|form| form.text("p = 2, a ≈ 2.598, k ≈ 1.41421", &varying));
        assert_eq!(forms, ["p = 2, a ≈ 2.598, k ≈ 1.41421", "p = 22 / 9, k ≈ 1.41421", "22/9, ≈ 1.41421"]);
        assert_eq!(CaptionForm::Values.meaning(&varying).as_deref(), Some("captions: p, k"));
        assert_eq!(CaptionForm::Values.text("a title", &[]), "a title");
    }
}
