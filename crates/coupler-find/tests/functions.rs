//! Function generation.
use coupler_curves::expression::Expression;
use coupler_find::*;

fn law(text: &str, x: [f64; 2], input: f64, output: f64, is_length: bool) -> FunctionTarget {
    let rad = std::f64::consts::PI / 180.0;
    let range = if is_length { output } else { output * rad };
    FunctionTarget::law(Law::new(&Expression::parse(text).unwrap(), "x", x, input * rad, range).unwrap(), is_length)
}

#[test]
fn explore() {
    for kind in [GeneratorKind::FourBar, GeneratorKind::SliderCrank] {
        let target = law(
            "log10(x)",
            [1.0, 10.0],
            60.0,
            if kind == GeneratorKind::FourBar { 90.0 } else { 2.0 },
            kind == GeneratorKind::SliderCrank,
        );
        for (method, condition, full_turn) in [
            (FunctionMethod::Points(5), None, false),
            (FunctionMethod::Points(4), Some("mu_worst_deg >= 30"), false),
            (FunctionMethod::Points(3), Some("mu_worst_deg >= 30"), false),
            (FunctionMethod::LeastSquares, Some("mu_worst_deg >= 30"), false),
            (FunctionMethod::Minimax, None, true),
            (FunctionMethod::Minimax, Some("mu_worst_deg >= 40"), false),
            (FunctionMethod::Minimax, Some("mu_worst_deg >= 40"), true),
        ] {
            let options = FunctionOptions {
                kind,
                method,
                input_start_deg: None,
                output_start: None,
                full_turn,
                max_ratio: 20.0,
                condition: condition.map(|c| Condition::new(&kind.template(), c).unwrap()),
                most: 2,
            };
            let begun = std::time::Instant::now();
            let found = generate_function(&target, &options, &OneAtATime);
            println!("{kind:?} {method:?} {:?} {:?} {:?}", begun.elapsed(), found.solutions, found.left_out);
            for a in &found.answers {
                println!(
                    "   {:?} {} {:?} {:?} greatest {} rms {} zeros {} mu {}",
                    a.dimensions,
                    a.side,
                    a.input_deg,
                    a.output,
                    a.error.greatest,
                    a.error.rms,
                    a.error.zeros.len(),
                    a.mu_worst_deg
                );
            }
        }
    }
}
