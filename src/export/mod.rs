//! Taking a curve away: as a drawing, still or moving, for CAD, as a table, as JSON, and as a piece of a manifest.
//!
//! Each format is a file here, and makes bytes of a [`Chosen`] curve; none of them decides which curves are wanted or
//! where the bytes go.

mod circle;
mod dxf;
mod fragment;
mod json;
mod layout;
mod plate;
mod points;

pub use fragment::fragment;
pub use plate::moving_view;

use crate::family::{Family, Sampling};
use crate::geometry::Point;
use crate::motion::Circuit;
use crate::page;
use crate::record::shortest;
use crate::render::{PngError, TextMode};
use crate::sweep::{Curve, Solved};

/// What one curve is taken away as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Format {
    /// A plate of the curve with its linkage.
    Svg,
    /// The same, moving by itself.
    MovingSvg,
    /// The plate as an image.
    Png,
    /// A drawing for CAD, in the language of AutoCAD R12.
    Dxf,
    /// Its rows of `points.csv`.
    Csv,
    /// Linkage, parameters, circuits, points and measures.
    Json,
    /// A piece of a manifest, of all curves together.
    Toml,
}

impl Format {
    /// Every format.
    pub const ALL: [Format; 7] =
        [Format::Svg, Format::MovingSvg, Format::Png, Format::Dxf, Format::Csv, Format::Json, Format::Toml];

    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            Format::Svg => "svg",
            Format::MovingSvg => "moving-svg",
            Format::Png => "png",
            Format::Dxf => "dxf",
            Format::Csv => "csv",
            Format::Json => "json",
            Format::Toml => "toml",
        }
    }

    /// How the names of its files end.
    pub fn ending(self) -> &'static str {
        if self == Format::MovingSvg { "-moving.svg" } else { self.extension() }
    }

    fn extension(self) -> &'static str {
        match self {
            Format::Svg | Format::MovingSvg => ".svg",
            Format::Png => ".png",
            Format::Dxf => ".dxf",
            Format::Csv => ".csv",
            Format::Json => ".json",
            Format::Toml => ".toml",
        }
    }
}

/// How curves are taken away.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// What plates look like; their paper too.
    pub page: page::Options,
    /// How text stands in SVG.
    pub text: TextMode,
    /// The resolution of images, in pixels to the inch.
    pub dpi: f64,
    /// How far a chord of a DXF polyline may be from its curve, in parts of the curve's extent: the longer side of the box
    /// round its samples.
    pub chord: f64,
}

impl Options {
    /// The chord's distance where nothing else is asked for.
    pub const CHORD: f64 = 1e-4;

    /// The paper of plates.
    pub const PAPER: page::Paper = page::Paper { width: 200.0, height: 150.0 };
}

/// One curve that is taken away.
#[derive(Clone, Debug)]
pub struct Chosen<'a> {
    /// Its family.
    pub family: &'a Family,
    /// What stands under the title of its plate.
    pub source: &'a str,
    /// Its cell, solved, with this one curve left of it.
    solved: Solved,
    /// The parameters it has in place of its cell's.
    changed: &'a [(String, f64)],
}

impl<'a> Chosen<'a> {
    /// Each curve of a solved cell by itself; `changed` are the parameters it has in place of those of the cell of its
    /// number.
    pub fn each(family: &'a Family, source: &'a str, changed: &'a [(String, f64)], solved: &Solved) -> Vec<Chosen<'a>> {
        let alone = |curve: &Curve| Solved { curves: vec![curve.clone()], ..solved.clone() };
        solved.curves.iter().map(|curve| Chosen { family, source, solved: alone(curve), changed }).collect()
    }

    /// The bytes of the curve in a format, a piece of a manifest of it alone among them.
    ///
    /// # Errors
    /// An image of too many pixels.
    pub fn bytes(&self, format: Format, options: &Options) -> Result<Vec<u8>, PngError> {
        Ok(match format {
            Format::Svg => plate::svg(self, options, false),
            Format::MovingSvg => plate::svg(self, options, true),
            Format::Png => plate::png(self, options)?,
            Format::Dxf => dxf::document(self, options.chord).into_bytes(),
            Format::Csv => points::table(self),
            Format::Json => json::document(self).into_bytes(),
            Format::Toml => fragment(&[Case::of(self)]).into_bytes(),
        })
    }

    /// What it is called: `evans:12.1.1`, with the parameters that are not its cell's, `evans:12.1.1?p=2.5&k=2`.
    pub fn name(&self) -> String {
        let [cell, trace, circuit] = self.numbers();
        let changed = self.changed(|name, value| format!("{name}={value}"));
        let query = if changed.is_empty() { String::new() } else { format!("?{}", changed.join("&")) };
        format!("{}:{cell}.{trace}.{circuit}{query}", self.family.id)
    }

    /// The name of its file in a format: `evans-12-1-1.dxf`, `evans-12-1-1-p-2.5.dxf`.
    pub fn file(&self, format: Format) -> String {
        let [cell, trace, circuit] = self.numbers();
        let changed = self.changed(|name, value| format!("-{name}-{value}")).concat();
        format!("{}-{cell}-{trace}-{circuit}{changed}{}", self.family.id, format.ending())
    }

    /// The numbers of its cell, its trace and its circuit.
    fn numbers(&self) -> [usize; 3] {
        let curve = self.curve();
        [self.solved.cell.number, curve.trace, curve.circuit]
    }

    fn changed(&self, written: impl Fn(&str, String) -> String) -> Vec<String> {
        self.changed.iter().map(|(name, value)| written(name, digits(*value))).collect()
    }

    fn curve(&self) -> &Curve {
        &self.solved.curves[0]
    }

    fn circuit(&self) -> &Circuit {
        self.solved.circuit(self.curve())
    }

    /// The places of all joints in the pose it is shown in for CAD: at the sample a third of the way through its circuit,
    /// where no dyad of a linkage that goes there and back is near its limit.
    fn pose(&self) -> Vec<Point> {
        let circuit = self.circuit();
        let sample = circuit.len() / 3;
        (0..self.solved.linkage.joints.len()).map(|joint| circuit.places.point(joint, sample)).collect()
    }
}

/// A parameter set that is taken away.
#[derive(Clone, Debug)]
pub struct Case<'a> {
    /// Its family.
    pub family: &'a Family,
    /// The values of its template's parameters.
    pub values: Vec<f64>,
    /// The name of the curve it is taken for.
    pub name: String,
}

impl<'a> Case<'a> {
    /// That of a curve.
    pub fn of(chosen: &Chosen<'a>) -> Case<'a> {
        let values = chosen.family.parameters(&chosen.solved.cell).to_vec();
        Case { family: chosen.family, values, name: chosen.name() }
    }
}

/// A number in the fewest digits that read back to it.
fn digits(value: f64) -> String {
    let mut out = Vec::new();
    shortest(value, &mut out);
    String::from_utf8(out).unwrap_or_default()
}

/// How circuits are sampled: the key, its number, and the spacing where it is not even.
fn sampled(sampling: Sampling) -> (&'static str, f64, Option<&'static str>) {
    match sampling {
        Sampling::Step(step) => ("step", step, None),
        Sampling::Samples(samples) => ("samples", samples as f64, None),
        Sampling::Smooth(samples) => ("samples", samples as f64, Some("smooth")),
        Sampling::Arc(samples) => ("samples", samples as f64, Some("arc")),
    }
}
