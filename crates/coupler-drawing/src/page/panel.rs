//! A panel of a page: a solved cell, the texts under it, and the pose its linkage is drawn in.

use super::guided_body::GuidedBody;
use coupler_curves::expression::MathText;
use coupler_curves::geometry::Point;
use coupler_curves::measure::Measure;
use coupler_curves::solve::SolvedCell;

/// A cell of a page: its curves, its linkage and the lines under them.
///
/// [`Panel::new`] needs the cell only; everything else is optional.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Panel<'a> {
    /// The cell.
    pub solved_cell: &'a SolvedCell,
    /// The line under the figure; may be empty.
    pub caption: String,
    /// The parts of it that differ between the panels of a page, as in "p = 2": they stay where the caption does not fit; may be empty.
    pub varying: Vec<String>,
    /// A smaller line under the caption; may be empty.
    pub note: String,
    /// Measured facts about the cell, as [`cell_facts`](super::cell_facts) gives them; may be empty.
    pub facts: [String; 2],
    /// The pose the linkage is drawn in.
    pub pose: PoseChoice,
    /// Whether the linkage is also drawn, in fine lines, at the limits of its input or else of its output.
    pub has_ghosts: bool,
    /// The body that it is to guide; without poses if there is none.
    pub body: GuidedBody,
}

impl<'a> Panel<'a> {
    /// The panel of a solved cell in its clearest pose, without caption, note and facts.
    pub fn new(solved_cell: &'a SolvedCell) -> Panel<'a> {
        Panel {
            solved_cell,
            caption: String::new(),
            varying: Vec::new(),
            note: String::new(),
            facts: Default::default(),
            pose: PoseChoice::default(),
            has_ghosts: false,
            body: GuidedBody::default(),
        }
    }

    /// The panel with a caption.
    pub fn with_caption(self, caption: impl Into<String>) -> Panel<'a> {
        Panel { caption: caption.into(), ..self }
    }

    /// The panel with the parts of its caption that stay where it does not fit, as in "p = 2".
    pub fn with_varying(self, varying: Vec<String>) -> Panel<'a> {
        Panel { varying, ..self }
    }

    /// The panel with a smaller line under its caption.
    pub fn with_note(self, note: impl Into<String>) -> Panel<'a> {
        Panel { note: note.into(), ..self }
    }

    /// The panel with facts, such as those of [`cell_facts`](super::cell_facts).
    pub fn with_facts(self, facts: [String; 2]) -> Panel<'a> {
        Panel { facts, ..self }
    }

    /// The panel with or without the linkage in fine lines at the limits of its input or else of its output.
    pub fn with_ghosts(self, has_ghosts: bool) -> Panel<'a> {
        Panel { has_ghosts, ..self }
    }

    /// The panel with the poses of a body that its linkage is to guide, and with curve and linkage at one scale.
    pub fn with_body(self, body: GuidedBody) -> Panel<'a> {
        Panel { body, ..self }
    }

    /// What the panel shows, in words: the linkage by the title of its family and its number, the dimensions, class and facts; or why it
    /// is not assembled. `common` is the dimensions that all linkages of the page share.
    pub(super) fn description(&self, title: &str, common: &[MathText]) -> String {
        let solved = self.solved_cell;
        let class = solved.curves.first().and_then(|curve| curve.measure(Measure::CLASS));
        let class = class.filter(|_| self.facts[0].is_empty()).map(str::to_owned);
        let is_assembled = solved.motion.is_assembled();
        let error = solved.motion.assembly_error.as_ref();
        let error = error.map(|error| if is_assembled { error.to_string() } else { format!("not assembled: {error}") });
        let dimensions = [self.caption.clone()].into_iter().chain(common.iter().map(MathText::to_string));
        let dimensions: Vec<String> = dimensions.filter(|part| !part.is_empty()).collect();
        let parts = [dimensions.join(", "), self.note.clone()].into_iter().chain(class).chain(self.facts.clone());
        let parts: Vec<String> = parts.chain(error).filter(|part| !part.is_empty()).collect();
        let which = format!("{title}, no. {}", solved.cell.number);
        if parts.is_empty() { which } else { format!("{which}: {}", parts.join("; ")) }
    }

    /// The panel with its linkage in another pose.
    pub fn with_pose(self, pose: PoseChoice) -> Panel<'a> {
        Panel { pose, ..self }
    }
}

/// The pose a linkage is drawn in; a pose is the positions of all its joints.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub enum PoseChoice {
    /// The clearest pose of the circuit of the first curve.
    #[default]
    Clearest,
    /// This pose.
    Fixed(Vec<Point>),
    /// These poses one after the other, repeated without end.
    Animated {
        /// The poses at equal time steps; the first one is repeated at the end.
        poses: Vec<Vec<Point>>,
        /// The time from the first pose to the last, in seconds.
        seconds: f64,
    },
}
