use std::fmt;

use serde::Serialize;

/// The family, file, cell or curve of a finding.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Location {
    /// The id of the family; empty for the atlas as a whole.
    pub family: String,
    /// The path of a file, relative to the folder of the atlas.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// The current number of the cell; its recorded number if it no longer exists.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cell: Option<usize>,
    /// The number of the traced joint.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trace: Option<usize>,
    /// The current number of the circuit; its recorded number if it no longer exists.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub circuit: Option<usize>,
}

impl Location {
    /// The location of a family.
    pub fn in_family(id: &str) -> Location {
        Location { family: id.to_owned(), ..Location::default() }
    }

    /// The location of a file.
    pub fn with_file(&self, name: &str) -> Location {
        Location { file: Some(name.to_owned()), ..self.clone() }
    }

    /// The location of a cell.
    pub fn with_cell(&self, cell: usize) -> Location {
        Location { cell: Some(cell), ..self.clone() }
    }

    /// The location of a curve of the cell.
    pub fn with_curve(&self, trace: usize, circuit: usize) -> Location {
        Location { trace: Some(trace), circuit: Some(circuit), ..self.clone() }
    }
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let mut parts = Vec::new();
        match &self.file {
            // The path of a file begins with its family.
            Some(file) => parts.push(file.clone()),
            None if !self.family.is_empty() => parts.push(self.family.clone()),
            None => parts.push("atlas".to_owned()),
        }
        for (name, number) in [("cell", self.cell), ("trace", self.trace), ("circuit", self.circuit)] {
            parts.extend(number.map(|number| format!("{name} {number}")));
        }
        f.write_str(&parts.join(", "))
    }
}
