//! The longest dwell of the output.
//!
//! A dwell is a stretch of a circuit on which the output stays within a band, see [`DwellBand`]. For each
//! start the longest one ends where the output first leaves the band that its values span. The start of the longest of
//! all is searched for among samples of the circuit and where a band touches an extreme of the output, and is then
//! refined between samples.

use super::motion::{OutputMotion, Stretch};
use super::output_value;
use crate::geometry::trig;
use crate::linkage::DwellBand;
use crate::measure::budget::{MAX_DWELL_STEPS, Steps};
use crate::measure::circuit_function::{MonotonicPart, Place};
use crate::measure::{Measure, Subject, start_input};
use crate::numerical::Bracket;

/// The measure `output_dwell_deg`.
pub const DWELL: Measure = Measure::number(
    "output_dwell_deg",
    "input span of the output's dwell",
    "deg",
    "greatest input span over which the output stays within a band of 0.01 of its swing or stroke, or of a turn, or as set by the family's `dwell`",
    |curve| output_value(curve, |output| Some(output.dwell()?.input_span)),
)
.more_is_better()
.of(Subject::WithOutput)
.or_length("output_dwell_length");

/// The measure `output_dwell_start_deg`.
pub const DWELL_START: Measure = Measure::number(
    "output_dwell_start_deg",
    "input at the start of the output's dwell",
    "deg",
    "input at which that dwell of the output begins",
    |curve| output_value(curve, |output| Some(start_input(curve, output.dwell()?.start_input))),
)
.of(Subject::WithOutput)
.at_input()
.or_length("output_dwell_start_length");

impl OutputMotion {
    /// The longest dwell of the output; of equally long ones the first. `None` if the search takes more steps than it may.
    pub(in crate::measure) fn dwell(&self) -> Option<Stretch> {
        *self.dwell.get_or_init(|| self.find_dwell())
    }

    /// The width of the band, in radians or in the manifest's unit.
    fn dwell_width(&self) -> f64 {
        match self.dwell_band {
            DwellBand::Share(share) => share * self.travel(),
            DwellBand::Angle(degrees) => trig::radians(degrees),
            DwellBand::Length(length) => length,
        }
    }

    fn find_dwell(&self) -> Option<Stretch> {
        let coordinate = &self.coordinate;
        let search = DwellSearch {
            output: self,
            parts: coordinate.monotonic_parts(),
            width: self.dwell_width(),
            steps: Steps::new(MAX_DWELL_STEPS),
        };
        let begin = search.place(0.0);
        if self.is_at_rest() {
            return Some(Stretch { start_input: coordinate.input(begin), input_span: coordinate.total_input() });
        }
        let mut starts = search.sampled_starts();
        starts.extend((0..search.parts.len()).filter_map(|part| search.start_at_extreme(part)));
        let spans: Vec<(f64, f64)> =
            starts.into_iter().map(|start| (start, search.span_from(start, f64::EPSILON).input_span)).collect();
        let longest = spans.iter().fold(0.0, |longest: f64, (_, span)| longest.max(*span));
        // Of equal ones the first on the circuit.
        let first = spans
            .iter()
            .filter(|(_, span)| *span >= longest * (1.0 - 1e-9))
            .min_by(|a, b| search.covered(a.0).total_cmp(&search.covered(b.0)));
        let (start, span) = first.copied().unwrap_or((0.0, 0.0));
        let found = Stretch { start_input: coordinate.input(search.place(start)), input_span: span };
        search.steps.check().ok().map(|()| found)
    }
}

/// The search for the longest dwell. Positions on the circuit are numbers whose integer part is the index of a
/// monotonic part, and whose fraction is that of the part.
struct DwellSearch<'a> {
    output: &'a OutputMotion,
    parts: Vec<MonotonicPart>,
    width: f64,
    /// The parts that may still be passed.
    steps: Steps,
}

impl DwellSearch<'_> {
    /// The place at a position.
    fn place(&self, position: f64) -> Place {
        let part = (position as usize).min(self.parts.len() - 1);
        self.output.coordinate.place_in_part(&self.parts[part], position - part as f64)
    }

    /// The input covered from the start of the circuit to a position.
    fn covered(&self, position: f64) -> f64 {
        self.output.coordinate.covered_input(self.place(position))
    }

    /// The part after or before another, and the change of the output in the laps between them; `None` beyond an end
    /// of the circuit.
    fn neighbour(&self, part: usize, is_next: bool) -> Option<(usize, f64, f64)> {
        let (count, coordinate) = (self.parts.len(), &self.output.coordinate);
        let lap = if coordinate.is_closed() { Some((coordinate.change(), coordinate.total_input())) } else { None };
        match (is_next, part) {
            (true, part) if part + 1 < count => Some((part + 1, 0.0, 0.0)),
            (true, _) => lap.map(|(change, input)| (0, change, input)),
            (false, 0) => lap.map(|(change, input)| (count - 1, -change, -input)),
            (false, part) => Some((part - 1, 0.0, 0.0)),
        }
    }

    /// The longest dwell that begins at a position, with its end to an accuracy of the parameter.
    fn span_from(&self, position: f64, accuracy: f64) -> Span {
        let coordinate = &self.output.coordinate;
        let start = self.place(position);
        let (start_value, start_covered) = (coordinate.value(start), coordinate.covered_input(start));
        let [start_slope, start_rate] = coordinate.slope_and_input_rate(start);
        let [mut least, mut greatest] = [start_value; 2];
        // A band that touches an extreme includes it in spite of rounding.
        let width = self.width * (1.0 + 1e-10);
        let mut part = (position as usize).min(self.parts.len() - 1);
        let (mut change, mut input) = (0.0, 0.0);
        for _ in 0..=self.parts.len() {
            if self.steps.take(1).is_err() {
                break;
            }
            let end = self.parts[part].values()[1] + change;
            let border = if end > least + width {
                Some((least, width))
            } else if end < greatest - width {
                Some((greatest, -width))
            } else {
                None
            };
            if let Some((border, width)) = border {
                let place = coordinate.solve_in_part(&self.parts[part], border + width - change, accuracy);
                let input_span = coordinate.covered_input(place) + input - start_covered;
                // Where the band begins at the start the end moves as fast as the output at the start, by that at the end.
                let [end_slope, end_rate] = coordinate.slope_and_input_rate(place);
                let rate = if border == start_value {
                    end_rate * start_slope * end_slope.signum() - start_rate * end_slope.abs()
                } else {
                    -start_rate
                };
                return Span { input_span, rate };
            }
            (least, greatest) = (least.min(end), greatest.max(end));
            let Some((next, more_change, more_input)) = self.neighbour(part, true) else {
                let covered = coordinate.covered_input(coordinate.place_in_part(&self.parts[part], 1.0));
                return Span { input_span: covered + input - start_covered, rate: -start_rate };
            };
            (part, change, input) = (next, change + more_change, input + more_input);
        }
        Span { input_span: coordinate.total_input(), rate: 0.0 }
    }

    /// The start of the dwell whose band touches the extreme at the end of a part: going back from there, where the
    /// output leaves the band. `None` if the end is no extreme.
    fn start_at_extreme(&self, part: usize) -> Option<f64> {
        let coordinate = &self.output.coordinate;
        let [before, extreme] = self.parts[part].values();
        let is_greatest = extreme > before;
        if let Some((next, change, _)) = self.neighbour(part, true)
            && (self.parts[next].values()[1] + change > extreme) == is_greatest
        {
            return None;
        }
        let band = if is_greatest { [extreme - self.width, extreme] } else { [extreme, extreme + self.width] };
        let (mut part, mut change) = (part, 0.0);
        for _ in 0..=self.parts.len() {
            self.steps.take(1).ok()?;
            let begin = self.parts[part].values()[0] + change;
            let limit = [(begin < band[0]).then_some(band[0]), (begin > band[1]).then_some(band[1])];
            if let Some(limit) = limit.into_iter().flatten().next() {
                let place = coordinate.solve_in_part(&self.parts[part], limit - change, f64::EPSILON);
                return Some(part as f64 + coordinate.fraction_of_part(&self.parts[part], place));
            }
            let Some((previous, more_change, _)) = self.neighbour(part, false) else { return Some(part as f64) };
            (part, change) = (previous, change + more_change);
        }
        None
    }

    /// Positions at which the dwell that begins there is longer than those that begin next to it: the best of samples
    /// of each part, refined between them.
    fn sampled_starts(&self) -> Vec<f64> {
        const SAMPLES: usize = MonotonicPart::SAMPLES;
        /// How accurately the start is found, relative to its part: the span changes with the square.
        const ACCURACY: f64 = 1e-9;
        /// How accurately the ends of samples are found: enough to know which are the longest.
        const ROUGH: f64 = 1e-6;
        /// Where all spans are equal to this part of them the output turns evenly.
        const EVEN: f64 = 1e-9;
        /// Spans that differ by less, relatively, are equal.
        const ROUNDING: f64 = 1e-12;
        let count = self.parts.len() * SAMPLES;
        let position = |k: usize| k as f64 / SAMPLES as f64;
        let spans: Vec<Span> = (0..count).map(|k| self.span_from(position(k), ROUGH)).collect();
        let longest = spans.iter().fold(0.0, |longest: f64, span| longest.max(span.input_span));
        if spans.iter().all(|span| span.input_span >= longest * (1.0 - EVEN)) {
            return vec![0.0];
        }
        let is_peak = |&k: &usize| {
            let [before, here, after] = [k.saturating_sub(1), k, (k + 1).min(count - 1)].map(|k| spans[k].input_span);
            here >= before.max(after) && here > 0.7 * longest
        };
        let refine = |k: usize| {
            let (mut start, mut most) = (position(k), self.span_from(position(k), f64::EPSILON).input_span);
            // A span may jump where an extreme comes into the band, where another start is looked for, and is smooth on either side. Of
            // equal ones the first counts.
            for [from, to] in [[k.saturating_sub(1), k], [k, (k + 1).min(count)]] {
                let rate = |position| self.span_from(position, f64::EPSILON).rate;
                let rates = [from, to].map(|k| spans.get(k).map_or_else(|| rate(position(k)), |span| span.rate));
                let bracket = Bracket::new([from, to].map(position), rates).filter(|_| rates[0] > 0.0);
                let Some(place) = bracket.map(|bracket| bracket.zero(ACCURACY, rate)) else { continue };
                let span = self.span_from(place, f64::EPSILON).input_span;
                if span > most * (1.0 + ROUNDING) {
                    (start, most) = (place, span);
                }
            }
            start
        };
        (0..count).filter(is_peak).map(refine).collect()
    }
}

/// The input that a dwell spans, and how it changes with the start: the sign of the derivative.
struct Span {
    input_span: f64,
    rate: f64,
}
