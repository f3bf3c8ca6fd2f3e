//! The search for linkages that guide a body near more poses than can be passed exactly.

use std::collections::BTreeMap;

use super::answer::{Candidate, PoseAnswer};
use super::body::{Placed, PoseSet};
use super::difference::are_different;
use super::dyad::{Dyad, Forms};
use super::dyad_space::Freedom;
use super::findings::{PoseFindings, PoseOptions, placed_dyad, wish};
use super::five;
use super::near_guide::{FreeDyad, NearDyad, NearGuide, PoseAim};
use super::pair::{Misfit, PosedDyad};

use crate::complex::{Complex, length, unit};
use crate::descent::{Candidate as _, Descent};
use crate::even_sequence::EvenSequence;
use crate::options::Effort;
use crate::workers::Workers;
use nalgebra::{Matrix2, Vector2, Vector3};

/// The length with which angles in radians count, in sizes of the poses.
const ANGLE_LENGTH: f64 = 1.0;

/// How far from the middle of the poses pivots are tried, in sizes of the poses.
const REACH: f64 = 4.0;

/// The most poses by which dyads are looked for; linkages are then moved towards all.
const MOST_SAMPLED: usize = 24;

/// Finds linkages that guide a body near poses, of which there may be any number: the sum of the squares of the distances, with angles
/// times the size of the poses, is least.
pub fn nearest_guides(set: &PoseSet, options: &PoseOptions, workers: &impl Workers) -> PoseFindings {
    let placed = set.placed();
    let few: Vec<Placed> = evenly(placed.len(), MOST_SAMPLED).into_iter().map(|k| placed[k]).collect();
    let dyads = near_dyads(&few, options, workers);
    let aim = PoseAim { placed, angle_length: ANGLE_LENGTH };
    let mut pairs: Vec<(f64, [NearDyad; 2])> = Vec::new();
    for (k, (error, a)) in dyads.iter().enumerate() {
        for (other_error, b) in &dyads[..k] {
            let has_link = [a, b].iter().any(|near| matches!(near.dyad, FreeDyad::Revolute { .. }));
            if has_link {
                pairs.push((error + other_error, [a.clone(), b.clone()]));
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    pairs.truncate(pair_count(placed.len(), options.effort));
    let count = pairs.len();
    let moved = workers.map(pairs, |(_, [a, b])| moved([a.dyad, b.dyad], &aim));
    let mut guides: Vec<NearGuide> = moved.into_iter().flatten().collect();
    guides.sort_by(|a, b| a.rms().total_cmp(&b.rms()));
    let mut left_out = BTreeMap::from([(Misfit::Unsolved, 2 * (count - guides.len()))]);
    let answers = solved(set, &guides, options, &mut left_out, workers);
    left_out.retain(|_, count| *count > 0);
    PoseFindings {
        freedom: Freedom::None,
        dyads: dyads.iter().map(|(_, near)| placed_dyad(set, &near.dyad.at(&placed[0]))).collect(),
        pairs: 2 * count,
        left_out,
        pairs_left_out: Vec::new(),
        answers,
    }
}

/// How many pairs are moved towards all poses.
fn pair_count(poses: usize, effort: Effort) -> usize {
    /// So many poses of all pairs together take about a second.
    const NORMAL: usize = 6000;
    let total = match effort {
        Effort::Quick => NORMAL / 3,
        Effort::Normal => NORMAL,
        Effort::Thorough => 4 * NORMAL,
    };
    (total / poses).clamp(40, 600)
}

/// The indices of about so many of some poses, with the first and the last.
fn evenly(count: usize, most: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    (0..most).map(|k| k * (count - 1) / (most - 1)).collect()
}

/// Dyads that nearly keep their lengths, with the root mean square of what they change: those that do so best, and others from all over the
/// plane, for the best alone may be no linkage.
fn near_dyads(few: &[Placed], options: &PoseOptions, workers: &impl Workers) -> Vec<(f64, NearDyad)> {
    const STEPS: usize = 60;
    const SAMPLES: usize = 600;
    const MOST: usize = 40;
    /// Longer links, in sizes of the poses, are as good as sliders.
    const FAR: f64 = 1e3;
    let aim = PoseAim { placed: few, angle_length: ANGLE_LENGTH };
    let forms = Forms::new(few);
    let exchanged = forms.exchanged();
    let sequence = EvenSequence::new(2);
    let sample = |k: usize| {
        let part = sequence.parts(k);
        let normal = unit(std::f64::consts::PI * part(0));
        let normal = Vector3::new(normal.re, normal.im, 0.0);
        if k % 6 == 4 {
            return Dyad::from_homogeneous(&nearest_pin(&exchanged, &normal)?, &normal);
        }
        let pivot = if k % 6 == 5 {
            normal
        } else {
            Vector3::new(REACH * (2.0 * part(0) - 1.0), REACH * (2.0 * part(1) - 1.0), 1.0).normalize()
        };
        Dyad::from_homogeneous(&pivot, &nearest_pin(&forms, &pivot)?)
    };
    let mut starts: Vec<Dyad> = (0..SAMPLES).filter_map(sample).collect();
    starts.extend(of_five(few));
    let moved = |steps: usize| {
        let near = |dyad: &Dyad| {
            let mut near = NearDyad::new(FreeDyad::new(dyad, few), &aim);
            let mut descent = Descent::default();
            (0..steps).for_each(|_| descent.step(&mut near, &aim));
            near
        };
        let mut found: Vec<(f64, NearDyad)> = workers
            .map(starts.iter().collect(), near)
            .into_iter()
            .filter(|near| PosedDyad::new(near.dyad.at(&few[0]), few).reach <= options.max_link.min(FAR))
            .map(|near| ((near.objective() / few.len() as f64).sqrt(), near))
            .collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        found
    };
    let mut kept: Vec<(f64, NearDyad)> = Vec::new();
    // The least, then those that are on the way there: the least alone may be no linkage that passes the poses as asked for.
    for (steps, apart, most) in [(STEPS, 0.02, MOST / 2), (3, 0.3, MOST)] {
        for near in moved(steps) {
            if kept.len() < most && kept.iter().all(|(_, other)| are_apart(&near.1.dyad, &other.dyad, &few[0], apart)) {
                kept.push(near);
            }
        }
    }
    kept
}

/// Whether two dyads are not the same, up to a distance in sizes of the poses.
fn are_apart(a: &FreeDyad, b: &FreeDyad, first: &Placed, apart: f64) -> bool {
    match [a.at(first), b.at(first)] {
        [Dyad::Revolute { pivot: g, pin: w }, Dyad::Revolute { pivot: h, pin: v }] => {
            length(g - h).max(length(w - v)) > apart * (1.0 + length(g))
        }
        [Dyad::Slider { normal: n, pin: w }, Dyad::Slider { normal: m, pin: v }] => {
            length(n - m).min(length(n + m)).max(length(w - v)) > apart
        }
        [Dyad::Slot { pivot: g, normal: n }, Dyad::Slot { pivot: h, normal: m }] => {
            length(n - m).min(length(n + m)).max(length(g - h)) > apart
        }
        _ => true,
    }
}

/// The pin that satisfies the equations of a pivot best.
fn nearest_pin(forms: &Forms, pivot: &Vector3<f64>) -> Option<Vector3<f64>> {
    let (mut normal, mut gradient) = (Matrix2::zeros(), Vector2::zeros());
    for row in forms.rows(pivot) {
        let linear = Vector2::new(row.x, row.y);
        normal += linear * linear.transpose();
        gradient -= linear * row.z;
    }
    let pin = normal.try_inverse()? * gradient;
    pin.iter().all(|x| x.is_finite()).then(|| Vector3::new(pin.x, pin.y, 1.0))
}

/// The dyads of five of the poses, of several choices.
fn of_five(few: &[Placed]) -> Vec<Dyad> {
    let last = few.len() - 1;
    let choices = [[0, 1, 2, 3, 4], [0, 1, 2, 3, 3], [0, 1, 1, 2, 4], [0, 2, 3, 4, 4], [0, 0, 1, 3, 4]];
    let part = |k: usize, shift: usize| (k * last / 4 + shift).min(last);
    let chosen = choices.iter().enumerate().filter_map(|(shift, choice)| {
        let mut indices: Vec<usize> = choice.iter().map(|k| part(*k, usize::from(*k > 0) * (shift % 2))).collect();
        // What is chosen twice is followed by its neighbour.
        for k in 1..indices.len() {
            indices[k] = indices[k].max(indices[k - 1] + 1);
        }
        let five: Option<Vec<Placed>> = indices.iter().map(|k| few.get(*k).copied()).collect();
        let five = five?;
        let dyads = five::dyads(&Forms::new(&five).independent())?;
        // Their pins are given in the first of the five poses.
        let of_first = |pin: Complex| few[0].apply(five[0].of_body(pin));
        let to_first = |dyad: &Dyad| match *dyad {
            Dyad::Revolute { pivot, pin } => Dyad::Revolute { pivot, pin: of_first(pin) },
            Dyad::Slider { normal, pin } => Dyad::Slider { normal, pin: of_first(pin) },
            Dyad::Slot { pivot, normal } => {
                Dyad::Slot { pivot, normal: normal * few[0].direction * five[0].direction.conj() }
            }
        };
        Some(dyads.iter().map(to_first).collect::<Vec<_>>())
    });
    chosen.flatten().collect()
}

/// Two dyads moved until the poses are as near as they can be.
fn moved(dyads: [FreeDyad; 2], aim: &PoseAim) -> Option<NearGuide> {
    const STEPS: usize = 80;
    let mut guide = NearGuide::new(dyads, aim)?;
    let mut descent = Descent::default();
    for _ in 0..STEPS {
        descent.step(&mut guide, aim);
        if descent.is_done {
            break;
        }
    }
    Some(guide)
}

/// The nearest that differ and pass the poses as asked for, with either dyad as the crank.
fn solved(
    set: &PoseSet,
    guides: &[NearGuide],
    options: &PoseOptions,
    left_out: &mut BTreeMap<Misfit, usize>,
    workers: &impl Workers,
) -> Vec<PoseAnswer> {
    let wish = wish(options);
    let tried: Vec<(&NearGuide, bool)> = guides.iter().flat_map(|guide| [(guide, false), (guide, true)]).collect();
    let solve = |(guide, is_swapped): (&NearGuide, bool)| {
        let mut posed = guide.dyads.map(|dyad| PosedDyad::new(dyad.at(&guide.passed[0]), &guide.passed));
        if is_swapped {
            posed.reverse();
        }
        let [crank, follower] = &posed;
        let pivots = posed.iter().filter_map(|posed| posed.dyad.pivot());
        if !pivots.into_iter().all(|pivot| is_within(set, options, pivot)) {
            return Err(Misfit::TooFar);
        }
        let candidate = Candidate { set, passed: &guide.passed, crank, follower };
        PoseAnswer::solve(&candidate, &wish, options.condition.as_ref())
    };
    let mut answers: Vec<PoseAnswer> = Vec::new();
    for result in workers.map(tried, solve) {
        match result {
            Ok(answer) => {
                if answers.len() < options.most && answers.iter().all(|other| are_different(set, &answer, other)) {
                    answers.push(answer);
                }
            }
            Err(misfit) => *left_out.entry(misfit).or_insert(0) += 1,
        }
    }
    answers
}

fn is_within(set: &PoseSet, options: &PoseOptions, pivot: Complex) -> bool {
    options.pivots.is_none_or(|within| {
        let p = set.place(pivot);
        (within.min.x..=within.max.x).contains(&p.x) && (within.min.y..=within.max.y).contains(&p.y)
    })
}

#[cfg(test)]
mod tests {
    use super::super::body::BodyPose;
    use super::super::body::random::random_poses;
    use super::*;
    use crate::scatter::Scatter;
    use crate::workers::OneAtATime;
    use coupler_curves::geometry::Point;

    fn any() -> PoseOptions {
        PoseOptions {
            full_turn: false,
            max_link: f64::INFINITY,
            effort: Effort::Quick,
            most: 3,
            ..PoseOptions::default()
        }
    }

    #[test]
    fn the_four_bar_of_many_poses_is_found() {
        for seed in 1..=6 {
            let (set, _) = random_poses(9, seed);
            let found = nearest_guides(&set, &any(), &OneAtATime);
            let best = found.answers.first().unwrap_or_else(|| panic!("{seed}: {:?}", found.left_out));
            assert!(best.rms(set.size()) < 1e-8 * set.size(), "{seed}: {}", best.rms(set.size()));
        }
    }

    #[test]
    fn of_poses_with_errors_no_linkage_near_is_nearer() {
        let (set, _) = random_poses(8, 3);
        let mut scatter = Scatter::new(5);
        let poses: Vec<BodyPose> = set
            .poses()
            .iter()
            .map(|pose| BodyPose {
                point: Point::new(pose.point.x + scatter.normal(0.01), pose.point.y + scatter.normal(0.01)),
                angle_deg: pose.angle_deg + scatter.normal(0.5),
            })
            .collect();
        let set = PoseSet::new(&poses).unwrap();
        let aim = PoseAim { placed: set.placed(), angle_length: ANGLE_LENGTH };
        let few = set.placed();
        let dyads = near_dyads(few, &any(), &OneAtATime);
        let best = moved([dyads[0].1.dyad, dyads[1].1.dyad], &aim).unwrap();
        assert!(best.rms() > 1e-4);
        // The least sum of squares: what is near is farther, whatever the direction.
        for _ in 0..200 {
            let mut near = best.dyads;
            for dyad in &mut near {
                let by: Vec<f64> = (0..5).map(|_| scatter.normal(1e-3)).collect();
                *dyad = dyad.moved(&by);
            }
            let near = NearGuide::new(near, &aim).map_or(f64::INFINITY, |near| near.rms());
            assert!(near >= best.rms() * (1.0 - 1e-6), "{near} {}", best.rms());
        }
    }
}
