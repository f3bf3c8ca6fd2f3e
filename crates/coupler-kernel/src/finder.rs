//! The search for four-bars in steps, and the index of curves that it looks paths up in.

use serde_json::{Value, json};

use coupler_curves::geometry::{Point, Vector, cross};
use coupler_curves::linkage::{FourBar, PlacedFourBar};
use coupler_find::{Answer, AnswerRecord, Index, Options, PathKind, Ranking, Search, Target, answers_manifest};

use crate::response::Numbers;

/// The most curves that are added to the index in a step, some 5 ms of work.
const CURVES_PER_STEP: usize = 128;

/// The steps of a search that a request takes, most of them fractions of a millisecond: what the page leaves behind at each of them is
/// collected after many megabytes only.
const STEPS_PER_REQUEST: usize = 8;

/// The curves in which a path is looked up while it changes: portions of all would take a second.
const FIRST_CURVES: usize = 15_000;

/// The most points of a path that is searched for: the time of a step grows with them.
const MAX_POINTS: usize = 400;

/// The path through points with the name of its kind.
///
/// # Errors
/// The points are no path, or too many.
pub(crate) fn target_of(points: &[Point], kind: &str) -> Result<Target, String> {
    if points.len() > MAX_POINTS {
        return Err(format!("the path has {} points, and at most {MAX_POINTS} are searched for", points.len()));
    }
    let kinds = [PathKind::Closed, PathKind::Open, PathKind::Part];
    let kind = kinds.into_iter().find(|known| known.name() == kind);
    let kind = kind.ok_or("a path is `closed`, `open` or `part`")?;
    Target::new(points, kind).map_err(|error| error.to_string())
}

/// The four-bar with these pivots of crank and rocker, their pins, and its coupler point.
fn placed([o, c, a, b, m]: [Point; 5]) -> PlacedFourBar {
    let coupler = (b - a).norm();
    let along = (b - a) / coupler;
    PlacedFourBar {
        pivots: [o, c],
        lengths: FourBar { frame: (c - o).norm(), crank: (a - o).norm(), coupler, rocker: (b - c).norm() },
        coupler_point: Vector::new(along.dot(&(m - a)), cross(along, m - a)),
    }
}

/// Adds the next curves to the index, up to the number that the program searches by default; how many there are, and how many there
/// will be.
/// `first` gets the first of them.
pub(crate) fn grow_index(index: &mut Index, first: &mut Index) -> Value {
    index.reserve(Index::DEFAULT_COUNT);
    index.extend(CURVES_PER_STEP.min(Index::DEFAULT_COUNT - index.len()));
    first.extend(FIRST_CURVES.min(index.len()) - first.len());
    json!({ "count": index.len(), "full_count": Index::DEFAULT_COUNT })
}

/// A search for the four-bars whose curves are nearest to a path.
pub(crate) struct FourBarSearch {
    search: Search,
    /// Whether it looks the path up in the first curves, and refines nothing.
    is_quick: bool,
    target: Target,
    /// The answers so far that are being made.
    ranking: Ranking,
}

impl FourBarSearch {
    /// Begins a search in the index, or with a four-bar.
    ///
    /// # Errors
    /// The points are no path.
    pub fn new(
        points: &[Point],
        kind: &str,
        options: Options,
        start: Option<[Point; 5]>,
    ) -> Result<FourBarSearch, String> {
        let target = target_of(points, kind)?;
        let is_quick = !options.refine;
        let search = match start {
            Some(joints) => Search::from_four_bar(&target, options, &placed(joints)),
            None => Search::new(&target, options),
        };
        Ok(FourBarSearch { search, is_quick, target, ranking: Ranking::default() })
    }

    /// What of the path keeps four-bars away from it, as clauses.
    pub fn hindrances(&self) -> Vec<String> {
        self.target.hindrances(false).iter().map(ToString::to_string).collect()
    }

    /// Takes some steps of bounded work; whether nothing is left to do.
    pub fn step(&mut self, index: &Index, first: &Index) -> bool {
        self.ranking = Ranking::default();
        let index = if self.is_quick { first } else { index };
        !(0..STEPS_PER_REQUEST).all(|_| self.search.step(index))
    }

    /// Takes a step towards the answers so far, or has them: those of `find --json` with their curves, and the manifest
    /// of `find --toml` for a path with a name.
    pub fn answers_json(&mut self, name: &str, numbers: &mut Numbers) -> Value {
        if self.ranking.step(&self.search) {
            return json!({ "is_complete": false });
        }
        let answers = std::mem::take(&mut self.ranking).into_answers();
        let size = self.target.size();
        let answer = |(rank, answer): (usize, &Answer)| {
            let curve = answer.mechanism.solved().map(|solved| {
                let curve = &solved.curves[0];
                let circuit = solved.circuit(curve);
                json!({ "closed": circuit.is_closed, "points": numbers.points(circuit.points(curve.joint)) })
            });
            json!({
                "record": AnswerRecord::new(rank, answer),
                "degeneracy": answer.mechanism.degeneracy(),
                "curve": curve,
                "pose": numbers.points(answer.mechanism.pose()),
                "manifest": answers_manifest(name, size, std::slice::from_ref(answer)),
            })
        };
        json!({
            "is_complete": true,
            "size": size,
            "answers": (1..).zip(&answers).map(answer).collect::<Vec<_>>(),
            "manifest": answers_manifest(name, size, &answers),
        })
    }
}
