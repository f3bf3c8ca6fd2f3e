use std::fmt;

use serde::Serialize;

use coupler_curves::geometry::Point;

/// Something that is not as it was recorded.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// Where.
    #[serde(flatten)]
    pub location: Location,
    /// What.
    #[serde(flatten)]
    pub change: Change,
}

/// Where something is not as it was recorded.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Location {
    /// The family's id; empty for the atlas as a whole.
    pub family: String,
    /// A file, from the atlas's folder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// The number of the cell, as it is now; of one that is no more, as it was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cell: Option<usize>,
    /// The number of the traced joint.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trace: Option<usize>,
    /// The number of the circuit, as it is now; of one that is no more, as it was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub circuit: Option<usize>,
}

/// How much a curve's points have moved.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Displacement {
    /// How far the point has moved that has moved furthest, in the manifest's unit; infinite where it had no place, or
    /// has none now.
    pub distance: f64,
    /// The same in parts of the curve's size, the diagonal of the box round it.
    pub relative: f64,
    /// The sample that has moved furthest.
    pub sample: usize,
    /// The input there: degrees, or an actuator's length.
    pub input: f64,
    /// Where it was.
    #[serde(rename = "was")]
    pub recorded: [f64; 2],
    /// Where it is.
    #[serde(rename = "is")]
    pub current: [f64; 2],
    /// How many samples have moved by more than the tolerance.
    #[serde(rename = "moved")]
    pub moved_samples: usize,
    /// Of how many.
    #[serde(rename = "of")]
    pub total_samples: usize,
    /// How far the two curves are apart as sets of points: near nothing where points have moved along the curve only.
    #[serde(rename = "apart")]
    pub hausdorff_distance: f64,
}

/// What is not as it was recorded. `was` is what is recorded, `is` what comes out now.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Change {
    /// A file cannot be used, or not all of it.
    Damaged {
        /// What is wrong with it.
        #[serde(rename = "wrong")]
        message: String,
    },
    /// A file is not the one that was recorded.
    Altered,
    /// A file has other line ends than were recorded, or a byte order mark; no difference.
    Rewritten,
    /// The manifest has a family that is not recorded.
    FamilyAdded,
    /// A family is recorded that the manifest does not have.
    FamilyRemoved,
    /// A family is another one under the same name.
    FamilyChanged {
        /// What of it: its linkage, the names of its parameters, its columns.
        what: String,
        /// What is recorded.
        #[serde(rename = "was")]
        recorded: String,
        /// What it is.
        #[serde(rename = "is")]
        current: String,
    },
    /// A cell is not recorded.
    CellAdded,
    /// A cell is recorded that there is no more.
    CellRemoved,
    /// A cell is recorded under another number.
    CellRenumbered {
        /// Its recorded number.
        #[serde(rename = "was")]
        recorded: usize,
    },
    /// A cell has other parameters.
    Parameter {
        /// The parameter's name.
        name: String,
        /// What is recorded.
        #[serde(rename = "was")]
        recorded: f64,
        /// What it is.
        #[serde(rename = "is")]
        current: f64,
    },
    /// A cell is assembled over more or less than is recorded.
    Status {
        /// What is recorded.
        #[serde(rename = "was")]
        recorded: String,
        /// What it is, with the reason.
        #[serde(rename = "is")]
        current: String,
    },
    /// A linkage is of another class.
    Class {
        /// What is recorded.
        #[serde(rename = "was")]
        recorded: String,
        /// What it is.
        #[serde(rename = "is")]
        current: String,
    },
    /// One circuit has become several.
    CircuitSplit {
        /// Their numbers.
        into: Vec<usize>,
    },
    /// Several circuits have become one.
    CircuitJoined {
        /// Their recorded numbers.
        from: Vec<usize>,
    },
    /// A circuit is recorded that there is no more.
    CircuitLost,
    /// A circuit is not recorded.
    CircuitAdded,
    /// A circuit is recorded the other way round.
    CircuitReversed,
    /// A closed circuit is recorded from another sample on.
    CircuitShifted {
        /// By how many samples.
        by: usize,
    },
    /// A circuit is recorded under another number.
    CircuitRenumbered {
        /// Its recorded number.
        #[serde(rename = "was")]
        recorded: usize,
    },
    /// A curve is sampled more or less often, or at other inputs.
    Samples {
        /// How many are recorded.
        #[serde(rename = "was")]
        recorded: usize,
        /// How many there are.
        #[serde(rename = "is")]
        current: usize,
        /// The numbers that are missing in the record where the others are there, the first few.
        missing: Vec<usize>,
        /// How far the curves are apart as sets: near nothing where only the sampling has changed.
        #[serde(rename = "apart")]
        hausdorff_distance: f64,
    },
    /// A sample is on the other side of a two-valued joint.
    Branch {
        /// The first such sample.
        sample: usize,
        /// The input there.
        input: f64,
        /// How many such samples there are.
        samples: usize,
        /// What is recorded.
        #[serde(rename = "was")]
        recorded: i64,
        /// What it is.
        #[serde(rename = "is")]
        current: i64,
    },
    /// A curve has moved.
    Moved(Displacement),
    /// A further column of `points.csv` has other values.
    Column {
        /// Its name.
        name: String,
        /// Where it differs most.
        sample: usize,
        /// What is recorded.
        #[serde(rename = "was")]
        recorded: f64,
        /// What it is.
        #[serde(rename = "is")]
        current: f64,
    },
    /// A measure is another one.
    Measure {
        /// Its name.
        name: String,
        /// What is recorded.
        #[serde(rename = "was")]
        recorded: String,
        /// What it is.
        #[serde(rename = "is")]
        current: String,
        /// By how much it differs, in parts of itself; infinite of words, and of what is missing.
        relative: f64,
    },
    /// A page is drawn otherwise, though none of its curves has changed.
    Drawing,
    /// A page is recorded that there is no more, or not recorded though there is one.
    Pages {
        /// How many are recorded.
        #[serde(rename = "was")]
        recorded: usize,
        /// How many there are.
        #[serde(rename = "is")]
        current: usize,
    },
    /// A page shows a curve where its recorded points are not.
    DrawnOff {
        /// How far it is off, in millimetres on paper.
        distance_mm: f64,
    },
}

impl Change {
    /// Whether it is a difference; else it is only worth a word.
    pub fn is_difference(&self) -> bool {
        !matches!(self, Change::Rewritten)
    }

    /// Its kind, as reports have it.
    pub fn kind(&self) -> &'static str {
        match self {
            Change::Damaged { .. } => "damaged",
            Change::Altered => "altered",
            Change::Rewritten => "rewritten",
            Change::FamilyAdded => "family-added",
            Change::FamilyRemoved => "family-removed",
            Change::FamilyChanged { .. } => "family-changed",
            Change::CellAdded => "cell-added",
            Change::CellRemoved => "cell-removed",
            Change::CellRenumbered { .. } => "cell-renumbered",
            Change::Parameter { .. } => "parameter",
            Change::Status { .. } => "status",
            Change::Class { .. } => "class",
            Change::CircuitSplit { .. } => "circuit-split",
            Change::CircuitJoined { .. } => "circuit-joined",
            Change::CircuitLost => "circuit-lost",
            Change::CircuitAdded => "circuit-added",
            Change::CircuitReversed => "circuit-reversed",
            Change::CircuitShifted { .. } => "circuit-shifted",
            Change::CircuitRenumbered { .. } => "circuit-renumbered",
            Change::Samples { .. } => "samples",
            Change::Branch { .. } => "branch",
            Change::Moved(_) => "moved",
            Change::Column { .. } => "column",
            Change::Measure { .. } => "measure",
            Change::Drawing => "drawing",
            Change::Pages { .. } => "pages",
            Change::DrawnOff { .. } => "drawn-off",
        }
    }

    /// What is told first, worst first: what keeps anything from being compared, what is there or not, what a linkage
    /// can do, where its points are, what is measured, what is drawn. Within one rank, by how much.
    pub fn sort_key(&self) -> (usize, f64) {
        const ORDER: [&[&str]; 9] = [
            &["damaged"],
            &["family-removed", "family-added", "family-changed"],
            &["cell-removed", "cell-added", "pages"],
            &["parameter", "status", "class"],
            &["circuit-lost", "circuit-added", "circuit-split", "circuit-joined", "circuit-reversed", "branch"],
            &["moved", "samples", "drawn-off"],
            &["measure", "column", "circuit-renumbered", "circuit-shifted", "cell-renumbered"],
            &["altered", "drawing"],
            &["rewritten"],
        ];
        let rank = ORDER.iter().position(|kinds| kinds.contains(&self.kind())).unwrap_or(ORDER.len());
        let size = match self {
            Change::Moved(by) => by.relative,
            Change::Measure { relative, .. } => *relative,
            Change::DrawnOff { distance_mm } => *distance_mm,
            Change::Samples { hausdorff_distance: apart, .. } => *apart,
            _ => 0.0,
        };
        (rank, -size)
    }
}

impl Location {
    /// A family.
    pub fn in_family(id: &str) -> Location {
        Location { family: id.to_owned(), ..Location::default() }
    }

    /// A file of it.
    pub fn with_file(&self, name: &str) -> Location {
        Location { file: Some(name.to_owned()), ..self.clone() }
    }

    /// A cell of it.
    pub fn with_cell(&self, cell: usize) -> Location {
        Location { cell: Some(cell), ..self.clone() }
    }

    /// A curve of the cell.
    pub fn with_curve(&self, trace: usize, circuit: usize) -> Location {
        Location { trace: Some(trace), circuit: Some(circuit), ..self.clone() }
    }

    /// Something that is not as it was recorded there.
    pub fn finding(&self, change: Change) -> Finding {
        Finding { location: self.clone(), change }
    }
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let mut parts = Vec::new();
        match &self.file {
            // A file's name says which family it is of.
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

/// "no points", "1 point", "2 points".
fn pluralize(n: usize, thing: &str) -> String {
    format!("{n} {thing}{}", if n == 1 { "" } else { "s" })
}

fn comma_separated(numbers: &[usize]) -> String {
    numbers.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
}

/// How far curves are apart, in a few digits.
fn format_distance(distance: f64) -> String {
    if distance == 0.0 { "not at all".to_owned() } else { format!("by {distance:.3e}") }
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Change::Damaged { message: wrong } => write!(f, "{wrong}"),
            Change::Altered => write!(f, "is not the file that was recorded"),
            Change::Rewritten => write!(f, "has other line ends or a byte order mark; nothing else has changed"),
            Change::FamilyAdded => write!(f, "the family is not recorded"),
            Change::FamilyRemoved => write!(f, "the family is recorded and no longer in the manifest"),
            Change::FamilyChanged { what, recorded: was, current: is } => write!(f, "{what} was {was} and is {is}"),
            Change::CellAdded => write!(f, "the cell is not recorded"),
            Change::CellRemoved => write!(f, "the cell is recorded and there no more"),
            Change::CellRenumbered { recorded: was } => write!(f, "the cell is recorded as cell {was}"),
            Change::Parameter { name, recorded: was, current: is } => write!(f, "{name} was {was} and is {is}"),
            Change::Status { recorded: was, current: is } => write!(f, "status was {was} and is {is}"),
            Change::Class { recorded: was, current: is } => write!(f, "the linkage was a {was} and is a {is}"),
            Change::CircuitSplit { into } => write!(f, "the circuit has split into circuits {}", comma_separated(into)),
            Change::CircuitJoined { from } => write!(f, "circuits {} have joined", comma_separated(from)),
            Change::CircuitLost => write!(f, "the circuit is recorded and there no more"),
            Change::CircuitAdded => write!(f, "the circuit is not recorded"),
            Change::CircuitReversed => write!(f, "the circuit is recorded the other way round"),
            Change::CircuitShifted { by } => write!(f, "the circuit is recorded from {} on", pluralize(*by, "sample")),
            Change::CircuitRenumbered { recorded: was } => write!(f, "the circuit is recorded as circuit {was}"),
            Change::Samples { recorded: was, current: is, missing, hausdorff_distance: by } => {
                match was == is {
                    true => write!(f, "{is} samples at other inputs")?,
                    false => write!(f, "{} recorded, and there are {is}", pluralize(*was, "sample"))?,
                }
                if !missing.is_empty() {
                    write!(f, " (missing: {})", comma_separated(missing))?;
                }
                write!(f, "; the curves are apart {}", format_distance(*by))
            }
            Change::Branch { sample, input, samples, recorded: was, current: is } => {
                write!(
                    f,
                    "{} on branch {is} instead of {was}, from sample {sample} at input {input}",
                    pluralize(*samples, "sample")
                )
            }
            Change::Moved(by) => write!(
                f,
                "moved by {:.3e} ({:.1e} of its size) at sample {}, input {}; {} of {} samples; the curves are apart {}",
                by.distance,
                by.relative,
                by.sample,
                by.input,
                by.moved_samples,
                by.total_samples,
                format_distance(by.hausdorff_distance)
            ),
            Change::Column { name, sample, recorded: was, current: is } => {
                write!(f, "{name} was {was} and is {is} at sample {sample}")
            }
            Change::Measure { name, recorded: was, current: is, relative } => {
                let shown = |text: &str| if text.is_empty() { "missing".to_owned() } else { text.to_owned() };
                write!(f, "{name} was {} and is {}", shown(was), shown(is))?;
                if relative.is_finite() { write!(f, ", {relative:.1e} of it") } else { Ok(()) }
            }
            Change::Drawing => write!(f, "is drawn otherwise now; its curves are the same"),
            Change::Pages { recorded: was, current: is } => {
                write!(f, "{} recorded, and there are {is}", pluralize(*was, "page"))
            }
            Change::DrawnOff { distance_mm } => {
                write!(f, "the curve is drawn {distance_mm:.3} mm from its recorded points")
            }
        }
    }
}

/// Coordinates, as findings have them.
pub(super) fn coordinates(point: Point) -> [f64; 2] {
    [point.x, point.y]
}
