//! How far a curve moves where lengths of its linkage are off: across itself, since what moves along it is only at another input.
//!
//! The moves are derivatives by the lengths, interpolated on the pieces of the circuit as other functions of the pose are. Their extremes are those of the
//! polynomials, known to a millionth.

use super::features::CurveMoves;
use super::{Measure, Subject, TracedCurve, Value};
use crate::geometry::{Chebyshev, Point, TERMS, Vector, left_normal};
use crate::motion::{CircuitPiece, InputPosition, LengthRates, NeighbourLinkages};
use crate::numerical::maximum;
use crate::text::interned;

/// The measure `sensitivity_max`.
pub const SENSITIVITY: Measure = Measure::number(
    "sensitivity_max",
    "greatest sensitivity to a length",
    "",
    "greatest move of the curve, across itself, for a unit of error of one length of its linkage, to the first order",
    |curve| of_greatest(curve, |_, move_per_unit| Value::Number(move_per_unit)),
)
.of(Subject::WithTolerance);

/// The measure `sensitivity_length`.
pub const LENGTH: Measure = Measure::word(
    "sensitivity_length",
    "most sensitive length",
    "the length whose error moves the curve by most: of two joints, as AB, or a coordinate of one, as \"M across\"",
    |curve| {
        of_greatest(curve, |length, _| {
            curve.neighbours().map_or(Value::Missing, |own| Value::Word(interned(&own.names[length])))
        })
    },
)
.of(Subject::WithTolerance);

/// The measure `tolerance_worst`.
pub const WORST: Measure = Measure::number(
    "tolerance_worst",
    "move of the curve in the worst case",
    "",
    "greatest move of the curve, across itself, where each length is off by the tolerance to its worse side, to the first order",
    |curve| of_all(curve, |moves| moves.worst_case),
)
.of(Subject::WithTolerance);

/// The measure `tolerance_rss`.
pub const ROOT_SUM_SQUARE: Measure = Measure::number(
    "tolerance_rss",
    "move of the curve as root of the sum of squares",
    "",
    "greatest root of the sum of the squares of the curve's moves for an error of each length by the tolerance",
    |curve| of_all(curve, |moves| moves.root_sum_square),
)
.of(Subject::WithTolerance);

fn of_greatest(curve: &TracedCurve, value: impl Fn(usize, f64) -> Value) -> Value {
    let Some(moves) = curve.moves() else { return Value::Missing };
    let of_equal_the_first = |best: Option<(usize, f64)>, (length, own): (usize, f64)| match best {
        Some((_, most)) if own <= most * (1.0 + ACCURACY) => best,
        _ => Some((length, own)),
    };
    let greatest = moves.lengths.iter().copied().enumerate().fold(None, of_equal_the_first);
    greatest.map_or(Value::Missing, |(length, own)| value(length, own))
}

fn of_all(curve: &TracedCurve, per_unit: impl Fn(&CurveMoves) -> f64) -> Value {
    let value = || Some(curve.linkage.tolerance? * per_unit(curve.moves()?));
    value().map_or(Value::Missing, Value::Number)
}

/// The relative accuracy of the greatest moves.
const ACCURACY: f64 = 1e-6;

impl TracedCurve<'_> {
    /// How far it moves for errors of the lengths of its linkage; `None` where the lengths cannot be off by themselves, at a change point, near which no
    /// error is small, and for a point that stands still.
    pub fn moves(&self) -> Option<&CurveMoves> {
        self.moves
            .get_or_init(|| {
                Search { curve: self, neighbours: self.neighbours()?, spans: Vec::new(), greatest: 0.0 }.moves()
            })
            .as_ref()
    }
}

/// The moves on a part of a circuit.
struct Span {
    /// For each length, in the order of the nodes.
    series: Vec<Chebyshev>,
    /// The joint's positions at the nodes, and directions that change steadily.
    places: Vec<(Point, Vector)>,
}

struct Search<'a> {
    curve: &'a TracedCurve<'a>,
    neighbours: &'a NeighbourLinkages,
    spans: Vec<Span>,
    greatest: f64,
}

impl Search<'_> {
    fn moves(mut self) -> Option<CurveMoves> {
        let pieces = self.curve.circuit.pieces(self.curve.linkage);
        for (k, piece) in pieces.pieces.iter().enumerate() {
            let joints: Vec<[Chebyshev; 2]> =
                self.curve.linkage.joint_ids().map(|joint| pieces.series(k, joint)).collect();
            self.append(*piece, &joints, MAX_DEPTH)?;
        }
        let lengths = 0..self.neighbours.pairs.len();
        let worst = |own: &[f64]| own.iter().map(|own| own.abs()).sum::<f64>();
        let square = |own: &[f64]| own.iter().map(|own| own * own).sum::<f64>().sqrt();
        let along = |span: &Span| {
            let values: Vec<[f64; TERMS]> = span.series.iter().map(Chebyshev::values).collect();
            let at = |node: usize| worst(&values.iter().map(|own| own[node]).collect::<Vec<f64>>());
            let left = |node: usize| left_normal(span.places[node].1) * at(node);
            (0..TERMS).map(|node| (span.places[node].0, left(node))).collect::<Vec<_>>()
        };
        let worst_case = self.greatest_of(worst);
        let cleared = |own: f64| if own <= RESOLVED * worst_case { 0.0 } else { own };
        Some(CurveMoves {
            lengths: lengths.map(|k| cleared(self.greatest_of(|own| own[k].abs()))).collect(),
            worst_case,
            root_sum_square: self.greatest_of(square),
            worst_along: self.spans.iter().flat_map(along).collect(),
        })
    }

    /// Appends the spans of a piece, which is halved until its polynomials have converged.
    fn append(&mut self, piece: CircuitPiece, joints: &[[Chebyshev; 2]], depth: usize) -> Option<()> {
        let places = joints.iter().map(|own| own.each_ref().map(Chebyshev::values)).collect::<Vec<_>>();
        let mut span = Span { series: Vec::new(), places: Vec::with_capacity(TERMS) };
        let mut values = vec![[0.0; TERMS]; self.neighbours.pairs.len()];
        for node in 0..TERMS {
            let positions: Vec<Point> = places.iter().map(|[x, y]| Point::new(x[node], y[node])).collect();
            let u = Chebyshev::nodes()[node];
            let linkage = self.curve.linkage;
            let input = InputPosition::new(linkage.input(), piece.map.input(u));
            let mode = self.curve.circuit.passes[piece.pass_at(u)].mode;
            let rates = LengthRates::new(linkage, self.neighbours, &positions, input, mode)?;
            let direction = rates.direction(self.curve.joint)?;
            // The motion has no sense in a pose, and a cusp reverses it: the next direction is the nearer of the two.
            let before = span.places.last().or_else(|| self.spans.last()?.places.last()).map(|(_, before)| *before);
            let direction =
                if before.is_some_and(|before: Vector| before.dot(&direction) < 0.0) { -direction } else { direction };
            span.places.push((positions[self.curve.joint.index()], direction));
            for (own, value) in values.iter_mut().zip(rates.moves_across(self.curve.joint, direction)) {
                own[node] = value;
            }
        }
        span.series = values.iter().map(Chebyshev::from_values).collect();
        let bound = span.series.iter().map(Chebyshev::bound).fold(0.0, f64::max);
        if !bound.is_finite() {
            return None;
        }
        self.greatest = self.greatest.max(bound);
        let tail = values.iter().map(Chebyshev::tail_of).fold(0.0, f64::max);
        if tail <= RESOLVED * self.greatest || depth == 0 || self.spans.len() >= MAX_SPANS {
            self.spans.push(span);
            return Some(());
        }
        let halves: Vec<[[Chebyshev; 2]; 2]> = joints.iter().map(|own| own.each_ref().map(Chebyshev::halves)).collect();
        for (half, part) in [[-1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
            let joints: Vec<[Chebyshev; 2]> = halves.iter().map(|[x, y]| [x[half], y[half]]).collect();
            self.append(piece.restricted(part), &joints, depth - 1)?;
        }
        Some(())
    }

    /// The greatest value of a function of the moves for each length, which has a maximum between two others of its values only where these show one.
    fn greatest_of(&self, function: impl Fn(&[f64]) -> f64) -> f64 {
        /// A place of a maximum is known to this, so that the value is known to its square.
        const PLACE: f64 = 1e-5;
        /// A maximum next to a node is not much greater than at the node.
        const LIKELY: f64 = 0.9;
        let at = |span: &Span, u: f64| function(&span.series.iter().map(|own| own.at(u)).collect::<Vec<f64>>());
        let places: Vec<f64> = std::iter::once(-1.0).chain(Chebyshev::nodes().iter().copied()).chain([1.0]).collect();
        let values: Vec<Vec<f64>> =
            self.spans.iter().map(|span| places.iter().map(|&u| at(span, u)).collect()).collect();
        let most = values.iter().flatten().copied().fold(0.0, f64::max);
        let mut greatest = most;
        for (span, values) in self.spans.iter().zip(&values) {
            for k in 1..places.len() - 1 {
                if values[k] >= LIKELY * most && values[k] >= values[k - 1] && values[k] >= values[k + 1] {
                    let found = maximum([places[k - 1], places[k + 1]], PLACE, |u| at(span, u));
                    greatest = greatest.max(found.value);
                }
            }
        }
        greatest
    }
}

/// The last terms of a polynomial that has converged, relative to the greatest of all moves.
const RESOLVED: f64 = 1e-9;

/// A piece is halved no more often: then its polynomials are as good as these can be, as next to a cusp.
const MAX_DEPTH: usize = 12;

/// A circuit has no more parts.
const MAX_SPANS: usize = 2048;
