use super::{Measure, TracedCurve, Value};

/// The measure `input_min_deg`.
pub const INPUT_MIN: Measure = Measure {
    name: "input_min_deg",
    unit: "deg",
    is_word: false,
    definition: "least input of the circuit; empty on a full turn",
    compute: |curve: &TracedCurve| extreme_input(curve, f64::INFINITY, f64::min),
};

/// The measure `input_max_deg`.
pub const INPUT_MAX: Measure = Measure {
    name: "input_max_deg",
    unit: "deg",
    is_word: false,
    definition: "greatest input of the circuit; empty on a full turn",
    compute: |curve: &TracedCurve| extreme_input(curve, f64::NEG_INFINITY, f64::max),
};

fn extreme_input(curve: &TracedCurve, start: f64, pick: fn(f64, f64) -> f64) -> Value {
    let passes = &curve.circuit.passes;
    let reverses = passes.iter().any(|pass| pass.input_direction() != passes[0].input_direction());
    if curve.circuit.is_closed && !reverses {
        return Value::Missing;
    }
    let ends = passes.iter().flat_map(|pass| [pass.from.input.value, pass.to.input.value]);
    Value::Number(ends.fold(start, pick))
}
