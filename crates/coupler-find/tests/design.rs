//! Searches by wishes, against closed forms, brute force and each other.

use coupler_curves::catalogue;
use coupler_curves::geometry::trig;
use coupler_find::{
    DesignAnswer, DesignOptions, DesignSearch, DesignSpace, Direction, Effort, OneAtATime, RangeRequest, Wishes,
    Workers,
};

/// What is asked of a search.
#[derive(Clone, Default)]
struct Asked<'a> {
    conditions: &'a str,
    goals: &'a [(Direction, &'a str)],
    ranges: &'a [(&'a str, &'a str)],
    max_link: Option<f64>,
    most: usize,
    seed: u64,
}

fn search(linkage: &str, asked: &Asked, workers: &impl Workers) -> DesignSearch {
    let template = catalogue::find(linkage).unwrap();
    let owned = |texts: &[(&str, &str)]| -> Vec<RangeRequest> {
        texts.iter().map(|(name, text)| RangeRequest { name: (*name).to_owned(), text: (*text).to_owned() }).collect()
    };
    let space = DesignSpace::new(template.clone(), &[], &owned(asked.ranges)).unwrap();
    let goals: Vec<_> = asked.goals.iter().map(|(direction, text)| (*direction, (*text).to_owned())).collect();
    let conditions = Some(asked.conditions).filter(|text| !text.is_empty());
    let wishes = Wishes::new(&template, conditions, &goals, asked.max_link.unwrap_or(f64::INFINITY)).unwrap();
    let options = DesignOptions { most: asked.most.max(1), effort: Effort::Quick, seed: asked.seed };
    let mut search = DesignSearch::new(space, wishes, options);
    while search.step(workers) {}
    search
}

fn answers(linkage: &str, asked: &Asked) -> Vec<DesignAnswer> {
    search(linkage, asked, &OneAtATime).answers(&OneAtATime)
}

fn value(answer: &DesignAnswer, name: &str) -> f64 {
    let parameters = &answer.family.template.parameters;
    answer.values[parameters.iter().position(|parameter| parameter.name == name).unwrap()]
}

/// The stroke and the time ratio of an offset slider-crank, in closed form: the slider is at its ends where crank and coupler are in line.
fn stroke_and_time_ratio(answer: &DesignAnswer) -> [f64; 2] {
    let [r, l, e] = ["crank", "coupler", "offset"].map(|name| value(answer, name));
    let reach = |length: f64| (length * length - e * e).sqrt();
    let angle = |length: f64| trig::degrees(trig::atan2(e, reach(length)));
    let turned = (angle(l - r) - angle(l + r)).abs();
    [reach(l + r) - reach(l - r), (180.0 + turned) / (180.0 - turned)]
}

#[test]
fn a_slider_crank_has_the_stroke_and_the_time_ratio_that_are_wished() {
    for (stroke, time_ratio) in [(100.0, 1.25), (0.02, 1.1)] {
        let conditions = format!("time_ratio == {time_ratio} and output_stroke == {stroke}");
        let found = answers("slider-crank", &Asked { conditions: &conditions, most: 4, ..Asked::default() });
        assert_eq!(found.len(), 4);
        for answer in &found {
            let [of_stroke, of_ratio] = stroke_and_time_ratio(answer);
            assert!((of_stroke / stroke - 1.0).abs() < 1e-9, "{of_stroke}");
            assert!((of_ratio - time_ratio).abs() < 1e-9, "{of_ratio}");
        }
    }
}

#[test]
#[ignore = "thorough"]
fn what_cannot_be_met_comes_as_near_as_the_best_that_meets_the_rest() {
    let goals = [(Direction::Greatest, "mu_worst_deg")];
    let conditions = "time_ratio == 1.25 and output_stroke == 100";
    let best = answers("slider-crank", &Asked { conditions, goals: &goals, most: 1, ..Asked::default() });
    let greatest = best[0].goals[0].1;
    // Along the curve of linkages that meet both conditions, the greatest by brute force: with the crank 1 and each coupler, the offset.
    let mut brute = 0.0f64;
    for k in 1..4000 {
        let l = 1.0 + 0.002 * f64::from(k);
        let ratio = |e: f64| {
            let angle = |length: f64| trig::degrees(trig::asin(e / length));
            (180.0 + angle(l - 1.0) - angle(l + 1.0)) / (180.0 - angle(l - 1.0) + angle(l + 1.0))
        };
        let (mut low, mut high) = (0.0, l - 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if ratio(middle) < 1.25 { low = middle } else { high = middle }
        }
        // The angle between the coupler and the normal of the line is least where the crank is farthest across.
        brute = brute.max(trig::degrees(trig::acos((1.0 + low) / l)));
    }
    assert!((greatest - brute).abs() < 1e-3, "{greatest}, by brute force {brute}");
    let conditions = format!("{conditions} and mu_worst_deg >= 60");
    let search = search("slider-crank", &Asked { conditions: &conditions, ..Asked::default() }, &OneAtATime);
    assert!(search.answers(&OneAtATime).is_empty());
    let misses = search.misses();
    let of_angle = misses.iter().find(|miss| miss.wish == 2).unwrap();
    let (_, nearest) = of_angle.nearest.wishes[2].value.clone().unwrap();
    assert!((nearest - brute).abs() < 0.05, "{nearest}");
    assert!(of_angle.nearest.wishes[..2].iter().all(|wish| wish.is_met));
}

/// Several parts in a step, the last first.
struct Backward;

impl Workers for Backward {
    fn most_at_once(&self) -> usize {
        7
    }

    fn map<T: Send, R: Send>(&self, items: Vec<T>, work: impl Fn(T) -> R + Send + Sync) -> Vec<R> {
        let mut results: Vec<R> = items.into_iter().rev().map(work).collect();
        results.reverse();
        results
    }
}

fn values(asked: &Asked, workers: &impl Workers) -> Vec<Vec<f64>> {
    let found = search("slider-crank", asked, workers).answers(workers);
    found.into_iter().map(|answer| answer.values).collect()
}

#[test]
fn the_answer_does_not_depend_on_the_workers() {
    let asked = Asked { conditions: "output_stroke == 2 and mu_worst_deg >= 50", most: 3, ..Asked::default() };
    assert_eq!(values(&asked, &OneAtATime), values(&asked, &Backward));
}

#[test]
#[ignore = "thorough"]
fn the_best_answer_does_not_depend_on_the_workers_but_on_the_seed() {
    let goals = [(Direction::Greatest, "mu_worst_deg")];
    let asked = Asked { conditions: "output_stroke == 2", goals: &goals, most: 3, ..Asked::default() };
    assert_eq!(values(&asked, &OneAtATime), values(&asked, &Backward));
    assert_ne!(values(&asked, &OneAtATime), values(&Asked { seed: 1, ..asked }, &OneAtATime));
}

#[test]
#[ignore = "thorough"]
fn designs_of_another_size_are_as_many_times_greater() {
    let goals = [(Direction::Greatest, "mu_worst_deg")];
    let best = |stroke: &str| {
        let conditions = format!("time_ratio == 1.2 and output_stroke == {stroke}");
        let asked = Asked { conditions: &conditions, goals: &goals, ..Asked::default() };
        let answer = answers("slider-crank", &asked).remove(0);
        (answer.goals[0].1, value(&answer, "crank"))
    };
    let [one, other] = [best("1"), best("64")];
    assert!((one.0 - other.0).abs() < 1e-3, "{one:?}, {other:?}");
    // The greatest angle is flat there.
    assert!((other.1 / one.1 - 64.0).abs() < 0.5, "{one:?}, {other:?}");
}

#[test]
#[ignore = "thorough"]
fn steps_ranges_and_the_longest_link_are_kept() {
    let ranges =
        [("frame", "40..80 by 1"), ("crank", "10..30 by 1"), ("coupler", "30..90 by 2"), ("rocker", "20..80 by 5")];
    let goals = [(Direction::Greatest, "mu_worst_deg")];
    let conditions = "output_swing_deg == 60 +- 0.5 and is_crank_rocker";
    let asked = Asked { conditions, goals: &goals, ranges: &ranges, max_link: Some(70.0), most: 5, ..Asked::default() };
    let found = answers("four-bar", &asked);
    assert!(!found.is_empty());
    // The best of all, in closed form.
    let mut best = 0.0f64;
    let degrees_of = |a: f64, b: f64, c: f64| trig::degrees(trig::acos((a * a + b * b - c * c) / (2.0 * a * b)));
    for (f, c) in (40..=70).flat_map(|f| (10..=30).map(move |c| (f, c))) {
        for (l, s) in (30..=70).step_by(2).flat_map(|l| (20..=70).step_by(5).map(move |s| (l, s))) {
            let mut sorted = [f, c, l, s];
            sorted.sort_unstable();
            if sorted[0] != c || sorted[0] + sorted[3] >= sorted[1] + sorted[2] {
                continue;
            }
            let [f, c, l, s] = [f, c, l, s].map(f64::from);
            let swing = degrees_of(f, s, l + c) - degrees_of(f, s, l - c);
            if (swing - 60.0).abs() <= 0.5 {
                best = best.max(degrees_of(l, s, f - c).min(180.0 - degrees_of(l, s, f + c)));
            }
        }
    }
    let found_best = found[0].goals[0].1;
    assert!(found_best <= best + 1e-9 && found_best > best - 1.0, "{found_best}, the best is {best}");
    for answer in &found {
        for (name, step) in [("frame", 1.0), ("crank", 1.0), ("coupler", 2.0), ("rocker", 5.0)] {
            assert_eq!(value(answer, name) % step, 0.0, "{name}");
        }
        assert!(answer.longest_link <= 70.0 && answer.wishes.iter().all(|wish| wish.is_met));
    }
}

#[test]
#[ignore = "thorough"]
fn several_goals_are_traded_off() {
    let goals = [(Direction::Greatest, "mu_worst_deg"), (Direction::Greatest, "time_ratio")];
    let asked =
        Asked { conditions: "output_swing_deg == 60 and is_crank_rocker", goals: &goals, most: 6, ..Asked::default() };
    let found = answers("four-bar", &asked);
    assert!(found.len() >= 4, "{}", found.len());
    for pair in found.windows(2) {
        let [first, second] = [0, 1].map(|k| [&pair[0], &pair[1]].map(|answer| answer.goals[k].1));
        assert!(first[0] >= first[1] && second[0] <= second[1], "{first:?} {second:?}");
    }
}

#[test]
#[ignore = "thorough"]
fn trade_offs_have_a_value_of_each_goal() {
    let goals = [(Direction::Greatest, "mu_worst_deg"), (Direction::Greatest, "time_ratio")];
    let asked =
        Asked { conditions: "output_stroke == 100", goals: &goals, max_link: Some(250.0), most: 3, ..Asked::default() };
    let found = answers("slider-crank", &asked);
    // Where the linkage jams the time ratio grows without end, and has no value beyond.
    assert!(found.len() > 1 && found.iter().all(|answer| answer.goals.iter().all(|(_, value)| value.is_finite())));
}

#[test]
fn parameters_that_change_nothing_keep_their_defaults() {
    let asked = Asked { conditions: "output_swing_deg == 40", ..Asked::default() };
    let search = search("watt-six-bar", &Asked { conditions: "output_swing_deg >= 1", ..asked }, &OneAtATime);
    let searched: Vec<&str> = search.space().free_names().collect();
    assert_eq!(searched, ["p", "r", "a", "s", "u", "v", "b", "c", "x", "y"]);
    for answer in search.answers(&OneAtATime) {
        assert_eq!(value(&answer, "along"), value(&answer, "b") / 2.0);
    }
}
