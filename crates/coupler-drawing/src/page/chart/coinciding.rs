//! Lines of a chart that coincide, which are drawn once.

use crate::chart::{AxisRange, PointSource, Series};
use coupler_curves::geometry::{Bounds, Point, distance_to_segment};

/// The distances, as parts of the axes, up to which two lines are one: of lines through samples, what is less than their weight, of those through
/// linkages, which have marks, rounding.
const VISIBLE: f64 = 1e-3;
const ROUNDING: f64 = 1e-6;

/// The label of each line for the quantity at an index: with those of the later lines that coincide with it, and empty if
/// all lines do; `None` if it coincides with an earlier line, or has no values.
///
/// Measures of the linkage, for example, are the same for each of its traced points, and a point has one path whatever drives its link.
pub(super) fn shared_labels(
    series: &[Series],
    quantity_index: usize,
    source: PointSource,
    axes: [AxisRange; 2],
) -> Vec<Option<String>> {
    let on_axes = |values: [f64; 2]| {
        let [x, y] = [0, 1].map(|k| axes[k].fraction(values[k]));
        Some(Point::new(x?, y?))
    };
    // Both lines through samples and those through linkages may be drawn through more points, and between linkages without values.
    let drawn: Vec<Vec<Option<Point>>> =
        series.iter().map(|line| line.path(quantity_index).into_iter().map(on_axes).collect()).collect();
    let at_points: Vec<Vec<Option<Point>>> =
        series.iter().map(|line| line.points(quantity_index).map(on_axes).collect()).collect();
    // Of most pairs of lines, the bounds say that they differ, without a comparison of all their points.
    let bounds: Vec<Bounds> = drawn.iter().map(|line| Bounds::from_points(line.iter().flatten().copied())).collect();
    let are_drawn_as_one = |a: usize, b: usize| {
        have_same_bounds(bounds[a], bounds[b])
            && (has_same_points(&drawn[a], &drawn[b], VISIBLE)
                || runs_along(&drawn[a], &drawn[b]) && runs_along(&drawn[b], &drawn[a]))
    };
    let coincide = |a: usize, b: usize| match source {
        // Each point is a linkage, which has a mark. Lines without any may be there between linkages.
        PointSource::Curves => {
            has_same_points(&at_points[a], &at_points[b], ROUNDING)
                && (at_points[a].iter().any(Option::is_some) || are_drawn_as_one(a, b))
        }
        PointSource::Samples => are_drawn_as_one(a, b),
    };
    // What an axis cannot show is left out, but said.
    let is_empty = |k: usize| {
        let line = &series[k];
        line.points(quantity_index).chain(line.path(quantity_index)).all(|[_, y]| y.is_nan())
    };
    let all_empty = (0..series.len()).all(is_empty);
    let mut groups: Vec<Vec<usize>> = Vec::new();
    // A line without values has no label, unless there is none with any.
    for k in (0..series.len()).filter(|&k| all_empty || !is_empty(k)) {
        match groups.iter_mut().find(|group| coincide(group[0], k)) {
            Some(group) => group.push(k),
            None => groups.push(vec![k]),
        }
    }
    let mut labels = vec![None; series.len()];
    for lines in groups {
        labels[lines[0]] = Some(match lines.len() == series.len() {
            true => String::new(),
            false => {
                let label = |&k: &usize| series[k].label.as_str();
                let all: Vec<&str> = series.iter().map(|line| line.label.as_str()).collect();
                let own: Vec<&str> = lines.iter().map(label).collect();
                common_parts(&own, &all).unwrap_or_else(|| joined_label(own))
            }
        });
    }
    if let [only] = series {
        labels[0] = Some(only.label.clone());
    }
    labels
}

/// Whether no side of two bounds is further apart than lines that are one can be.
fn have_same_bounds(a: Bounds, b: Bounds) -> bool {
    /// Of the sides, to rounding.
    const MOST: f64 = VISIBLE * (1.0 + 1e-9);
    let is_near = |a: Point, b: Point| (0..2).all(|k| a[k] == b[k] || (a[k] - b[k]).abs() <= MOST);
    is_near(a.min, b.min) && is_near(a.max, b.max)
}

/// Whether two lines have the same points.
fn has_same_points(a: &[Option<Point>], b: &[Option<Point>], distance: f64) -> bool {
    let is_same = |(a, b): (&Option<Point>, &Option<Point>)| match (a, b) {
        (Some(a), Some(b)) => (a - b).norm() <= distance,
        (None, None) => true,
        _ => false,
    };
    a.len() == b.len() && a.iter().zip(b).all(is_same)
}

/// Whether all points of a line are on another one, in their order.
fn runs_along(line: &[Option<Point>], other: &[Option<Point>]) -> bool {
    let segment = |k: usize| Some([(*other.get(k)?)?, (*other.get(k + 1)?)?]);
    let mut at = 0;
    let is_on_other = |p: &Point| {
        let found =
            (at..other.len()).find(|k| segment(*k).is_some_and(|[a, b]| distance_to_segment(*p, a, b) <= VISIBLE));
        at = found.unwrap_or(at);
        found.is_some()
    };
    line.iter().flatten().all(is_on_other)
}

/// The parts that some labels have in common, if no other label has all of them: the other parts distinguish no lines.
fn common_parts(own: &[&str], all: &[&str]) -> Option<String> {
    let parts = |label: &str| label.split(", ").map(str::to_owned).collect::<Vec<String>>();
    let (first, others) = own.split_first()?;
    let mut common = parts(first);
    common.retain(|part| others.iter().all(|label| parts(label).contains(part)));
    let has_all = |label: &&&str| common.iter().all(|part| parts(label).contains(part));
    (!common.is_empty() && all.iter().filter(has_all).count() == own.len()).then(|| common.join(", "))
}

fn joined_label(labels: Vec<&str>) -> String {
    /// The most labels that are joined; of more, the first and the last are named.
    const MAX_JOINED: usize = 3;
    match &labels[..] {
        [first, .., last] if labels.len() > MAX_JOINED => format!("{first} … {last} ({} lines)", labels.len()),
        few => few.join("; "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::LinePath;

    #[test]
    fn coinciding_lines_share_a_label() {
        let line = |label: &str, y: &[f64]| Series {
            label: label.to_owned(),
            x: vec![1.0, 2.0],
            y: vec![y.to_vec()],
            ..Series::default()
        };
        let axis = AxisRange { low: 0.0, high: 2.0, is_log: false };
        let labels_of = |lines: &[Series], source: PointSource| -> Vec<String> {
            let labels = shared_labels(lines, 0, source, [axis; 2]);
            labels.into_iter().map(|label| label.unwrap_or_else(|| "-".to_owned())).collect()
        };
        let labels = |lines: &[Series]| labels_of(lines, PointSource::Curves);
        let [a, b, c] = [line("a", &[0.0, f64::NAN]), line("b", &[0.0, 1.0]), line("c", &[-0.0, -f64::NAN])];
        assert_eq!(labels(&[a.clone(), b.clone(), c.clone()]), ["a; c", "b", "-"]);
        assert_eq!(labels(&[a.clone(), c.clone()]), ["", "-"]);
        assert_eq!(labels(std::slice::from_ref(&b)), ["b"]);
        assert_eq!(labels(&[b, a.clone(), a.clone(), c.clone(), c])[1], "a … c (4 lines)");
        let [first, second] = ["p = 1", "p = 2"].map(|p| {
            let y = [p.len() as f64, if p == "p = 1" { 1.0 } else { 2.0 }];
            ["path of M", "path of B"].map(|path| line(&format!("{p}, {path}"), &y))
        });
        assert_eq!(labels(&[first, second].concat()), ["p = 1", "-", "p = 2", "-"]);
        assert!(labels(&[]).is_empty());
        // To rounding, and where the samples of a line are elsewhere on it.
        let almost = line("d", &[1e-15, 1.0 - 1e-15]);
        let [e, f] =
            [1.0, 1.1].map(|y| Series { x: vec![1.0, 1.25, 2.0], y: vec![vec![0.0, 0.25 * y, 1.0]], ..almost.clone() });
        let b = line("b", &[0.0, 1.0]);
        assert_eq!(labels(&[b.clone(), almost, f.clone()]), ["b; d", "-", "d"]);
        assert_eq!(labels(&[b.clone(), e.clone(), f.clone()]), ["b", "d", "d"]);
        assert_eq!(labels_of(&[b, e, f], PointSource::Samples), ["b; d", "-", "d"]);
        // Of lines without values at linkages, one may have some between them, and only that one is there.
        let none = line("g", &[f64::NAN, f64::NAN]);
        let path = LinePath { points: vec![[1.2, 0.5], [1.4, 1.0]], range: None };
        let between = Series { label: "h".to_owned(), paths: vec![path], ..none.clone() };
        assert_eq!(labels(&[none.clone(), between, none.clone()]), ["-", "h", "-"]);
        assert_eq!(labels(&[none.clone(), none]), ["", "-"]);
    }

    #[test]
    fn many_lines_that_differ_are_not_compared_at_all_their_points() {
        let count = 1440;
        let line = |k: usize| Series {
            label: k.to_string(),
            x: (0..count).map(|i| i as f64).collect(),
            y: vec![(0..count).map(|i| (i * i) as f64 + (k / 2) as f64 * 1e4).collect()],
            ..Series::default()
        };
        let lines: Vec<Series> = (0..1000).map(line).collect();
        let axis = |high: f64| AxisRange { low: 0.0, high, is_log: false };
        let axes = [axis(count as f64), axis(5e6)];
        let begin = std::time::Instant::now();
        let labels = shared_labels(&lines, 0, PointSource::Samples, axes);
        assert!(begin.elapsed().as_secs_f64() < 1.0, "{:?}", begin.elapsed());
        assert_eq!(
            [labels[0].as_deref(), labels[1].as_deref(), labels[2].as_deref()],
            [Some("0; 1"), None, Some("2; 3")]
        );
    }
}
