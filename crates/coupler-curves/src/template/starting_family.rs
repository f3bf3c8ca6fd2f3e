//! A family to start from.

use super::{Parameter, ParameterKind, Template};

impl Template {
    /// A family of a manifest with the numbers that are defaults, or examples where there are none; a default that follows from other
    /// parameters is left to do so.
    pub fn starting_family(&self) -> String {
        let value = |parameter: &Parameter| {
            let number: f64 = match &parameter.default_text[..] {
                "" => parameter.starting_value(),
                text => text.parse().ok()?,
            };
            Some(match parameter.kind {
                ParameterKind::Angle(unit) => format!("{} = \"{number} {}\"", parameter.name, unit.name()),
                _ => format!("{} = {number}", parameter.name),
            })
        };
        let values: Vec<String> = self.parameters.iter().filter_map(value).collect();
        let space = match values.is_empty() {
            true => "cases = [{}]".to_owned(),
            false => format!("grid = {{ {} }}", values.join(", ")),
        };
        format!("[[family]]\nid = \"{0}\"\nlinkage = \"{0}\"\n{space}\n", self.id)
    }
}
