//! Dimension lines: between two extension lines, with arrowheads and a number.

use super::super::theme::Theme;
use crate::scene::{Anchor, Item, Path, Polyline, Text};
use coupler_curves::geometry::{Point, Vector, left_normal};
use coupler_curves::text::{exact_decimals, format_in_full, is_same_number, round_to_six_digits};

/// The direction of a dimension.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Direction {
    /// A horizontal distance, under a view.
    Across,
    /// A vertical one, on the left of it.
    Up,
}

/// A dimension between two points of a page.
pub(super) struct Dimension {
    pub direction: Direction,
    /// The ends, from which extension lines lead to the dimension line.
    pub ends: [Point; 2],
    /// Where the dimension line is: its y if it is horizontal, otherwise its x.
    pub at: f64,
    pub text: String,
}

/// The distance from a dimension line to the next, in ems of the numbers.
pub(super) const PITCH: f64 = 1.7;

impl Dimension {
    /// Where its extension lines are: the x of a horizontal dimension, the y of a vertical one.
    pub fn extensions(&self) -> [f64; 2] {
        self.ends.map(|end| self.coordinate(end))
    }

    /// The coordinate of a point that it measures.
    fn coordinate(&self, p: Point) -> f64 {
        match self.direction {
            Direction::Across => p.x,
            Direction::Up => p.y,
        }
    }

    /// Its lines and its number, which is next to the line where it is too long for it, beyond extension lines of others that are there.
    pub fn items(&self, others: &[f64], theme: &Theme) -> Vec<Item> {
        let size = theme.small_size();
        let arrow = 0.8 * size;
        let feet = self.ends.map(|end| match self.direction {
            Direction::Across => Point::new(end.x, self.at),
            Direction::Up => Point::new(self.at, end.y),
        });
        let along = (feet[1] - feet[0]).try_normalize(0.0).unwrap_or(Vector::x());
        let length = (feet[1] - feet[0]).norm();
        let beyond = 0.35 * size;
        let extension = |k: usize| {
            let away = (feet[k] - self.ends[k]).try_normalize(0.0).unwrap_or(Vector::zeros());
            line(&[self.ends[k] + away * beyond, feet[k] + away * beyond])
        };
        let text = theme.text_line(&self.text, Point::origin(), Anchor::Middle, size, theme.ink).text;
        let width = text.width();
        let fits = width + 2.0 * arrow + 0.6 * size <= length;
        let head = |tip: Point, direction: Vector| {
            let (back, half) = (direction * arrow, left_normal(direction) * (0.18 * arrow));
            Polyline { points: vec![tip, tip - back + half, tip - back - half], is_closed: true }
        };
        let (lines, heads, middle) = if fits {
            let middle = feet[0] + along * (length / 2.0);
            (vec![line(&feet)], [head(feet[0], -along), head(feet[1], along)], middle)
        } else {
            // The arrows point inwards, and the number is beyond the end where it is nearer, at the one that is away from other dimensions if it may be at both.
            let mut outside = [feet[0] - along * (1.8 * arrow), feet[1] + along * (1.8 * arrow)];
            let ways = if self.goes_back() { [(1, along), (0, -along)] } else { [(0, -along), (1, along)] };
            let spots =
                ways.map(|(k, outward)| (k, outward, self.room(outside[k], outward, width + 0.6 * size, others)));
            let nearest = |a: (usize, Vector, f64), b: (usize, Vector, f64)| if b.2 < a.2 { b } else { a };
            let (k, outward, further) = spots.into_iter().reduce(nearest).unwrap_or(spots[0]);
            outside[k] += outward * further;
            let middle = outside[k] + outward * (width / 2.0 + 0.3 * size);
            (vec![line(&outside)], [head(feet[0], along), head(feet[1], -along)], middle)
        };
        let stroke = Some(theme.stroke(theme.grey, theme.hair_width));
        let polylines = (0..2).map(extension).chain(lines).collect();
        let baseline = if fits { -0.25 * size } else { 0.35 * size };
        let (position, quarter_turns) = match self.direction {
            Direction::Across => (middle + Vector::new(0.0, baseline), 0),
            Direction::Up => (middle + Vector::new(baseline, 0.0), 3),
        };
        vec![
            Item::Path(Path { polylines, stroke, fill: None }),
            Item::Path(Path { polylines: heads.to_vec(), stroke: None, fill: Some(theme.grey) }),
            Item::Text(Text { position, quarter_turns, ..text }),
        ]
    }

    /// How much further than a point, in a direction, a text of a width begins that no line of others passes.
    fn room(&self, from: Point, outward: Vector, width: f64, others: &[f64]) -> f64 {
        let start = self.coordinate(from);
        let sign = self.coordinate(Point::from(outward));
        let mut distances: Vec<f64> = others.iter().map(|at| sign * (at - start)).collect();
        distances.sort_by(f64::total_cmp);
        let mut further = 0.0;
        for distance in distances {
            if (further..further + width).contains(&distance) {
                further = distance;
            }
        }
        further
    }

    /// Whether it leads to the left or down: its number is beyond its second end where it does not fit, on the side without other dimensions.
    fn goes_back(&self) -> bool {
        match self.direction {
            Direction::Across => self.ends[1].x < self.ends[0].x,
            Direction::Up => self.ends[1].y > self.ends[0].y,
        }
    }
}

fn line(points: &[Point]) -> Polyline {
    Polyline { points: points.to_vec(), is_closed: false }
}

/// A length as captions print it, without the noise of differences: in full if that takes no more digits than anyone writes and reads back as the
/// length, and otherwise in six digits after ≈.
pub(super) fn length_text(value: f64) -> String {
    const MAX_WRITTEN_DIGITS: usize = 10;
    /// The noise of differences, as a part of their value: the twelfth digit of a number that is not round may happen to be 0.
    const NOISE: f64 = 16.0 * f64::EPSILON;
    let without_noise = format!("{value:.11e}").parse().unwrap_or(value);
    let rounded = round_to_six_digits(without_noise);
    if is_same_number(rounded, without_noise) {
        return rounded.to_string();
    }
    let in_full = format_in_full(without_noise);
    let is_written = exact_decimals(without_noise).is_some()
        && in_full.chars().filter(char::is_ascii_digit).count() <= MAX_WRITTEN_DIGITS
        && (without_noise - value).abs() <= NOISE * value.abs();
    if is_written { in_full } else { format!("≈{rounded}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_all_their_digits_or_are_marked_as_rounded() {
        for (value, text) in [
            (2.5, "2.5"),
            (0.1 + 0.2, "0.3"),
            (1.234_567_89, "1.23456789"),
            (1.1 - 1.0 - 0.025, "0.075"),
            (2.0_f64.sqrt(), "≈1.41421"),
            (2000.0_f64.sqrt(), "≈44.7214"),
        ] {
            assert_eq!(length_text(value), text);
        }
    }
}
