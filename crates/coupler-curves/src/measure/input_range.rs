use super::{Measure, TracedCurve, Value};

/// The measure `is_full_turn`, which is also a boolean.
pub const IS_FULL_TURN: Measure = Measure::word(
    "is_full_turn",
    "full turn of the input",
    "whether the input turns fully on this circuit, yes or no, also through change points; no for an actuator; a condition in `where`",
    |curve: &TracedCurve| Value::Word(if curve.circuit.is_full_turn() { YES } else { "no" }),
);

/// The value of `is_full_turn` on a full turn.
pub const YES: &str = "yes";

/// The measure `input_min_deg`.
pub const INPUT_MIN: Measure = Measure::number(
    "input_min_deg",
    "least input of the circuit",
    "deg",
    "least input of the circuit; empty on a full turn",
    |curve: &TracedCurve| extreme_input(curve, f64::INFINITY, f64::min),
)
.or_length("input_min_length");

/// The measure `input_max_deg`.
pub const INPUT_MAX: Measure = Measure::number(
    "input_max_deg",
    "greatest input of the circuit",
    "deg",
    "greatest input of the circuit; empty on a full turn",
    |curve: &TracedCurve| extreme_input(curve, f64::NEG_INFINITY, f64::max),
)
.or_length("input_max_length");

/// The measure `limit_positions`.
pub const LIMIT_POSITIONS: Measure = Measure::number(
    "limit_positions",
    "number of limit positions",
    "",
    "limit positions of the circuit, in which the drive jams: the input can go no further and turns back; 0 on a full turn, and where only a range of the input ends",
    |curve: &TracedCurve| Value::Number(curve.circuit.limit_count() as f64),
);

fn extreme_input(curve: &TracedCurve, start: f64, pick: fn(f64, f64) -> f64) -> Value {
    if curve.circuit.is_full_turn() {
        return Value::Missing;
    }
    let ends = curve.circuit.passes.iter().flat_map(|pass| [pass.from.input.value, pass.to.input.value]);
    Value::Number(ends.fold(start, pick))
}
