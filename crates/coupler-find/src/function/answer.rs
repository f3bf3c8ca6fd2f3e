//! A linkage that generates a function, in the units of its users.

use std::sync::Arc;

use super::generator::{Generator, GeneratorKind};
use super::structural_error::{ErrorCurve, StructuralError};
use super::target::FunctionTarget;
use coupler_curves::family::{Family, Sampling};
use coupler_curves::geometry::trig;
use coupler_curves::linkage::FourBar;
use coupler_curves::linkage_format;
use coupler_curves::template::Template;

/// A linkage whose output is near a wanted function of its input.
///
/// Of a four-bar the frame is 1; the input is the angle from the frame O → C to the crank O → A and the output that to the rocker C → B,
/// counter-clockwise. Of a slider-crank lengths are in the unit of the output; the input is the angle from the direction of the slider's
/// line to the crank, and the output the distance along the line from the foot of the crank's pivot.
#[derive(Clone, Debug, PartialEq)]
pub struct FunctionAnswer {
    /// Which linkage it is.
    pub kind: GeneratorKind,
    /// Its dimensions by their names: of a four-bar frame, crank, coupler and rocker, of a slider-crank crank, coupler and offset.
    pub dimensions: Vec<(&'static str, f64)>,
    /// The side on which the pin of the rocker, or the slider, is assembled: `left` or `right` of the line from crank pin to rocker pivot, `ahead` of
    /// the crank pin or `behind` it.
    pub side: &'static str,
    /// The input at the start and the end of the function, in degrees; at the start from 0 up to a turn, or what is given, or half a turn from it.
    pub input_deg: [f64; 2],
    /// The output there that is wanted, in degrees or as a length: the function is measured from the first.
    pub output: [f64; 2],
    /// The output less the wanted one, in degrees or as a length; its places are inputs of the linkage, in degrees.
    pub error: StructuralError,
    /// The worst transmission angle over the range of the input, in degrees, 0 to 90.
    pub mu_worst_deg: f64,
    /// The longest link over the shortest.
    pub ratio: f64,
    /// Whether the crank turns fully.
    pub is_full_turn: bool,
    /// Its class; of a slider-crank `crank` where the crank turns fully, and otherwise `rocker`.
    pub class: &'static str,
    /// What it generates.
    pub output_function: OutputFunction,
}

/// The output of a four-bar or a slider-crank at any input, in closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutputFunction {
    pub(super) generator: Generator,
    /// The unit of the lengths and of an output that is a length.
    unit: f64,
    /// The point at which the output is nearest to the wanted one of all that differ by whole turns.
    near: [f64; 2],
}

impl OutputFunction {
    /// The numbers that define it, from which [`OutputFunction::from_numbers`] makes it again.
    pub fn to_numbers(&self) -> [f64; 9] {
        let Generator { lengths: [a, b, third], starts: [input, output], side, .. } = self.generator;
        [a, b, third, input, output, side, self.unit, self.near[0], self.near[1]]
    }

    /// That of a kind of linkage with numbers from [`OutputFunction::to_numbers`].
    pub fn from_numbers(kind: GeneratorKind, numbers: [f64; 9]) -> OutputFunction {
        let [a, b, third, input, output, side, unit, x, y] = numbers;
        let generator = Generator { kind, lengths: [a, b, third], starts: [input, output], side };
        OutputFunction { generator, unit, near: [x, y] }
    }

    /// The output at a travel of the input from the start, in degrees, less the output that is wanted at the start; not a number where the
    /// linkage cannot be assembled.
    pub fn at(&self, travel_deg: f64) -> f64 {
        let Generator { kind, starts: [input, output], .. } = self.generator;
        let Some(turns) = self.generator.turns_at(self.near) else { return f64::NAN };
        let there = self.generator.output(input + trig::radians(travel_deg));
        there.map_or(f64::NAN, |there| output_unit(kind, self.unit) * (there + turns - output))
    }
}

/// The factor from the output of a linkage of unit size, in radians, to that of its user.
fn output_unit(kind: GeneratorKind, unit: f64) -> f64 {
    if kind == GeneratorKind::FourBar { trig::degrees(1.0) } else { unit }
}

impl FunctionAnswer {
    /// The answer of a linkage for a function of unit size.
    pub(super) fn new(
        generator: Generator,
        target: &FunctionTarget,
        unit: f64,
        near: [f64; 2],
    ) -> Option<FunctionAnswer> {
        let Generator { kind, lengths: [a, b, third], starts: [input, output], side } = generator;
        let measured = ErrorCurve::new(&generator, target, near)?.measure();
        if !measured.greatest.is_finite() {
            return None;
        }
        let out = output_unit(kind, unit);
        let degrees = |travel: f64| trig::degrees(input + travel);
        let error = StructuralError {
            greatest: out * measured.greatest,
            at: degrees(measured.at),
            rms: out * measured.rms,
            zeros: measured.zeros.iter().map(|travel| degrees(*travel)).collect(),
        };
        let last = target.samples().last().map_or(0.0, |[_, y]| *y);
        let (dimensions, names, class) = match kind {
            GeneratorKind::FourBar => {
                let four_bar = FourBar { frame: 1.0, crank: a, coupler: b, rocker: third };
                let lengths = vec![("frame", 1.0), ("crank", a), ("coupler", b), ("rocker", third)];
                (lengths, ["left", "right"], four_bar.class().name())
            }
            GeneratorKind::SliderCrank => {
                let lengths = vec![("crank", unit * a), ("coupler", unit * b), ("offset", unit * third)];
                (lengths, ["ahead", "behind"], if generator.is_full_turn() { "crank" } else { "rocker" })
            }
        };
        Some(FunctionAnswer {
            kind,
            dimensions,
            side: names[usize::from(side < 0.0)],
            input_deg: [degrees(0.0), degrees(target.travel())],
            output: [out * output, out * (output + last)],
            error,
            mu_worst_deg: trig::degrees(generator.worst_transmission(input, input + target.travel())),
            ratio: generator.ratio(),
            is_full_turn: generator.is_full_turn(),
            class,
            output_function: OutputFunction { generator, unit, near },
        })
    }

    /// The output at a travel of the input from the start, see [`OutputFunction::at`].
    pub fn generated(&self, travel_deg: f64) -> f64 {
        self.output_function.at(travel_deg)
    }

    /// The linkage as the `[[linkage]]` of a manifest.
    pub fn template_toml(&self) -> String {
        template_toml(self.kind, self.side)
    }

    /// The id of the linkage.
    pub fn linkage_id(&self) -> String {
        linkage_id(self.kind, self.side)
    }

    /// The parameters of the linkage: its dimensions, and the range of the input as `from` and `to`, in degrees, the lesser first.
    pub fn parameters(&self) -> Vec<(String, f64)> {
        let [a, b] = self.input_deg;
        let range = [("from", a.min(b)), ("to", a.max(b))];
        self.dimensions.iter().copied().chain(range).map(|(name, value)| (name.to_owned(), value)).collect()
    }

    /// The family of the linkage over the range of its input; `None` if it cannot be built.
    pub fn family(&self) -> Option<Family> {
        Family::single_cell(template(self.kind, self.side), &self.parameters(), Sampling::Samples(180)).ok()
    }
}

fn base_id(kind: GeneratorKind) -> &'static str {
    if kind == GeneratorKind::FourBar { "function-four-bar" } else { "function-slider-crank" }
}

fn linkage_id(kind: GeneratorKind, side: &str) -> String {
    format!("{}-{side}", base_id(kind))
}

fn template_toml(kind: GeneratorKind, side: &str) -> String {
    let (text, first) = match kind {
        GeneratorKind::FourBar => (include_str!("function-four-bar.toml"), "left"),
        GeneratorKind::SliderCrank => (include_str!("function-slider-crank.toml"), "ahead"),
    };
    let id = base_id(kind);
    text.replace(&format!("side = \"{first}\""), &format!("side = \"{side}\""))
        .replace(&format!("id = \"{id}\""), &format!("id = \"{}\"", linkage_id(kind, side)))
}

fn template(kind: GeneratorKind, side: &str) -> Arc<Template> {
    let templates = linkage_format::parse_templates(&template_toml(kind, side));
    Arc::new(templates.expect("the linkage is valid").remove(0))
}

impl GeneratorKind {
    /// The linkage whose parameters and measures a condition may use.
    pub fn template(self) -> Arc<Template> {
        template(self, if self == GeneratorKind::FourBar { "left" } else { "ahead" })
    }
}
