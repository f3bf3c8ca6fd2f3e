//! Links that are very short, very long, or almost as long as one another.

use coupler_curves::catalogue;
use coupler_curves::family::Family;
use coupler_curves::geometry::trig;
use coupler_curves::measure::{self, Measure, Value};
use coupler_curves::motion::Sampling;
use coupler_curves::solve::{SolvedCell, Solver, Status};

fn solved(linkage: &str, values: &[(&str, f64)]) -> SolvedCell {
    let values: Vec<(String, f64)> = values.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let family = Family::single_cell(catalogue::find(linkage).unwrap(), &values, Sampling::Samples(24)).unwrap();
    Solver::new(&family).solve(0).unwrap()
}

fn four_bar([frame, crank, coupler, rocker]: [f64; 4], along: f64) -> SolvedCell {
    let lengths = [("frame", frame), ("crank", crank), ("coupler", coupler), ("rocker", rocker)];
    solved("four-bar", &[&lengths[..], &[("along", along), ("across", 1.0)]].concat())
}

/// The shorter the rocker, the more its angle is rounding: it turns fully while the crank moves by no more than its pin does. The
/// crank's limits are those of triangles with the sides frame, crank, and coupler plus or minus rocker.
#[test]
fn a_very_short_rocker_is_resolved_as_far_as_rounding_lets_it() {
    for rocker in [1e-3, 1e-5, 1e-6, 5e-7, 1e-7, 1e-8, 1e-9] {
        let solved = four_bar([2.0, 1.0, 2.5, rocker], 1.0);
        assert_eq!(solved.motion.circuits.len(), 2, "{rocker}");
        for curve in &solved.curves {
            assert_eq!(curve.measure(Measure::OUTPUT_SWING), Some(360.0), "{rocker}");
            let limit = |side: f64| {
                let cos = (5.0 - side * side) / 4.0;
                trig::degrees(trig::atan2((1.0 - cos * cos).sqrt(), cos))
            };
            let [low, high] = [2.5 - rocker, 2.5 + rocker].map(limit);
            let found = [Measure::INPUT_MIN, Measure::INPUT_MAX].map(|key| curve.measure(key).unwrap());
            let [from, to] = if found[0] > 0.0 { [low, high] } else { [-high, -low] };
            assert!((found[0] - from).abs().max((found[1] - to).abs()) < 1e-12, "{rocker}: {found:?} {low} {high}");
            assert_eq!(curve.measure(Measure::CUSPS), Some(0.0), "{rocker}");
            // What is halved further is rounding.
            assert!(solved.circuit(curve).pieces(&solved.linkage).len() < 100, "{rocker}");
        }
    }
    // The rocker's angle is no more than rounding.
    for rocker in [1e-12, 1e-14] {
        for curve in &four_bar([2.0, 1.0, 2.5, rocker], 1.0).curves {
            assert_eq!(curve.measure(Measure::OUTPUT_SWING), None, "{rocker}");
            assert!(matches!(curve.measure(Measure::TOO_CLOSE), Some("positions" | "measures")), "{rocker}");
        }
    }
}

#[test]
fn a_circuit_without_length_has_no_output_measures() {
    let solved = solved("geared-five-bar", &[("b", 1e-300)]);
    assert_ne!(solved.status(), Status::Failed);
    for curve in &solved.curves {
        assert_eq!(curve.measure(Measure::OUTPUT_DWELL), None);
        assert_eq!(curve.measure(Measure::TOO_CLOSE), Some("positions"));
    }
}

#[test]
fn lengths_beyond_double_precision_are_a_reason() {
    for along in [1e61, 1e155, 1e300] {
        let solved = four_bar([4.0, 1.0, 3.0, 3.5], along);
        assert_eq!(
            (solved.status(), solved.reason().as_str()),
            (Status::None, "its lengths are too large or too small for double precision"),
            "{along}"
        );
    }
}

/// Scaled by a power of two, a linkage has the same curve to the last digit, however small or large it is.
#[test]
fn measures_are_the_same_at_any_scale() {
    let lengths = [4.0, 1.25, 3.0, 3.5];
    let own = four_bar(lengths, 1.0);
    for exponent in [-190i64, -60, 60, 190] {
        // The bits of a power of two are those of its exponent.
        let scale = f64::from_bits(((1023 + exponent) as u64) << 52);
        let [frame, crank, coupler, rocker] = lengths.map(|length| length * scale);
        let values = [("frame", frame), ("crank", crank), ("coupler", coupler), ("rocker", rocker)];
        let scaled = solved("four-bar", &[&values[..], &[("along", scale), ("across", scale)]].concat());
        for (a, b) in own.curves.iter().zip(&scaled.curves) {
            for (k, measure) in measure::ALL.iter().enumerate() {
                let is_length = ["length", "bbox_x_min", "straight_length", "dwell_radius"].contains(&measure.name);
                let is_ratio =
                    measure.unit == "deg" || measure.is_word || ["cusps", "crunodes"].contains(&measure.name);
                match (a.values[k], b.values[k]) {
                    (Value::Number(a), Value::Number(b)) if is_length => assert_eq!(a * scale, b, "{}", measure.name),
                    (a, b) if is_ratio => assert_eq!(a, b, "{} at 2^{exponent}", measure.name),
                    _ => {}
                }
            }
        }
    }
}

/// Next to a change point the output or the curve is rounding at many places, of which each is compared with each: what is not known
/// has no value, and that is said.
#[test]
fn searches_that_find_no_end_are_given_up() {
    let evans = [("p", 3.5), ("r", 2.5), ("a", 2.5), ("s", 1.499_999_999_999_85), ("k", 2.5)];
    let solved = solved("evans", &evans);
    assert_eq!(solved.status(), Status::Ok);
    for curve in &solved.curves {
        assert_eq!(curve.measure(Measure::OUTPUT_DWELL), None);
        assert!(matches!(curve.measure(Measure::TOO_CLOSE), Some("positions" | "measures")));
    }
}
