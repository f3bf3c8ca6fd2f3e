//! The construction of a linkage in words: for each joint, the lengths and angles that place it.

use super::{ClosureTemplate, Coordinate, JointKindTemplate, JointTemplate, Side, SideTemplate, Template};
use crate::expression::{CompiledExpression, MathText, displayed_name, join_names};
use crate::text::{format_exactly, is_same_number, round_to_six_digits};

impl Template {
    /// How a joint, by its index in [`Template::joints`], is placed: "AB = a, CB = s". The dimensions are as in the
    /// template, by the names of its parameters.
    ///
    /// Of a joint of a drawing the coordinates in it are stated, too; of its dimensions, which follow from them, those that are numbers, rounded.
    pub fn construction(&self, joint: usize) -> MathText {
        let Some(placed) = self.joints.get(joint) else { return MathText::default() };
        let construction = self.with_closures(joint, self.construction_without_drawing(joint, placed));
        match &placed.drawn {
            Some(position) if !matches!(placed.kind, JointKindTemplate::Fixed(_)) => {
                let [x, y] = self.position_as_drawn(position);
                construction.with_words("; laid out at (").with(x).with_words(", ").with(y).with_words(")")
            }
            _ => construction,
        }
    }

    /// What is known of a joint, with the links to joints before it that close loops, and the lines that it slides on.
    fn with_closures(&self, joint: usize, known: MathText) -> MathText {
        let between = |joints: [usize; 2]| self.names_in_a_row(&joints);
        let closing = self.closures.iter().filter_map(|closure| match closure {
            ClosureTemplate::Bar { joints: [a, b], length } if *a.max(b) == joint => {
                Some(drawn_length(&between([*a.min(b), joint]), length))
            }
            ClosureTemplate::Hold { joint: held, base, .. } if *held == joint => {
                Some(MathText::from_words(format!("on the link {}", between(*base))))
            }
            ClosureTemplate::Guide { joint: guided, line, offset } if *guided == joint => {
                let guide = MathText::from_words(format!("slides on a line along {}", between(*line)));
                Some(match offset.constant_value() {
                    Some(0.0) | None => guide,
                    Some(offset) => {
                        let left = self.side_as_drawn(Side::Left);
                        guide.with_words(format!(", to its {left} {}", rounded_equation(offset)))
                    }
                })
            }
            _ => None,
        });
        closing.fold(known, |text, next| if text.is_empty() { next } else { text.with_words(", ").with(next) })
    }

    fn construction_without_drawing(&self, joint: usize, placed: &JointTemplate) -> MathText {
        let name = |k: usize| displayed_name(&self.joints[k].name);
        let between = |joints: [usize; 2]| self.names_in_a_row(&joints);
        let is_drawn = self.joints.iter().any(|joint| joint.drawn.is_some());
        let to_left = format!(", to its {}: ", self.side_as_drawn(Side::Left));
        // In a drawing the coordinates tell the side.
        let on_side = |side: &SideTemplate, base: [usize; 2]| match side.constant().filter(|_| placed.drawn.is_none()) {
            Some(side) => format!(", {} of {}", self.side_as_drawn(side), between(base)),
            None => String::new(),
        };
        let length = |from: usize, value: &CompiledExpression| {
            let link = between([from, joint]);
            if is_drawn { drawn_length(&link, value) } else { equation(&link, value.to_dimension_text()) }
        };
        match &placed.kind {
            JointKindTemplate::Fixed(position) => {
                let [x, y] = self.position_as_drawn(placed.drawn.as_ref().unwrap_or(position));
                let what = match (self.seen_from, self.is_pivot(joint)) {
                    (Some(_), _) if placed.drawn.is_some() => format!("on link {}, laid out at (", self.defined_link()),
                    (Some(_), _) => format!("on link {}, at (", self.defined_link()),
                    (None, true) => "fixed pivot at (".to_owned(),
                    (None, false) => "fixed point at (".to_owned(),
                };
                MathText::from_words(what).with(x).with_words(", ").with(y).with_words(")")
            }
            JointKindTemplate::Crank { pivot, length: crank } => {
                let what = if self.seen_from.is_some() { "pin of the driving link, " } else { "pin of the crank, " };
                MathText::from_words(what).with(length(*pivot, crank))
            }
            JointKindTemplate::Gear { crank, pivot, length: own_length, ratio: [turns, crank_turns], phase } => {
                let geared =
                    MathText::from_words("pin of a crank geared to ").with_words(name(*crank)).with_words(", ");
                let ratio = turns.to_math_text().with_words(" : ").with(crank_turns.to_math_text());
                let geared = geared.with(length(*pivot, own_length)).with_words(", ratio ").with(ratio);
                let ratio = turns.constant_value().zip(crank_turns.constant_value()).map(|(n, m)| n / m);
                let geared = geared.with_words(match ratio {
                    Some(ratio) if ratio < 0.0 => "",
                    Some(_) => ", over an idler",
                    None => ", over an idler where it is positive",
                });
                match is_zero(&phase.value) {
                    true => geared,
                    false => geared.with_words(", at ").with(phase.to_math_text()).with_words(format!(
                        " {} where {} is at 0°",
                        self.turning_as_drawn(),
                        name(*crank)
                    )),
                }
            }
            JointKindTemplate::Piston { base: [from, pivot], length: crank, offset, side } => {
                let driven = MathText::from_words("pin of the crank, ").with(length(*pivot, crank));
                let driven = driven.with_words(on_side(side, [*from, *pivot]));
                let driven = driven.with_words(format!(", driven by the actuator from {}", name(*from)));
                // The foot of the perpendicular from the pivot is to the right of the line from there to the pin.
                let right = self.side_as_drawn(Side::Right);
                let beside = format!(" to the {right} of {}, seen towards {}", name(*from), name(joint));
                with_unless_zero(driven, ", its line ", offset, &beside)
            }
            JointKindTemplate::DrivenSlider { line: along, offset } => {
                let slider =
                    MathText::from_words(format!("slider that is driven, on a line along {}", between(*along)));
                with_unless_zero(slider, &to_left, offset, "")
            }
            JointKindTemplate::Rack { crank, line: along, offset, radius, start } => {
                let rack = MathText::from_words(format!("rack on a line along {}", between(*along)));
                let rack = with_unless_zero(rack, &to_left, offset, "");
                let rack =
                    rack.with_words(format!(", by a pinion on the crank of {}, its pitch radius = ", name(*crank)));
                let rack = rack.with(radius.to_dimension_text()).with_words(self.mesh_of_rack(*crank, *along, radius));
                let first = name(along[0]);
                match is_zero(start) {
                    true => rack.with_words(format!(", at input 0 beside {first}")),
                    false => {
                        let at = rack.with_words(", at input 0 at ").with(start.to_dimension_text());
                        at.with_words(format!(" from {first} along the line"))
                    }
                }
            }
            JointKindTemplate::Dyad { base: [a, b], lengths: [first, second], side } => {
                length(*a, first).with_words(", ").with(length(*b, second)).with_words(on_side(side, [*a, *b]))
            }
            JointKindTemplate::Slide { from, length: link, line: along, offset, side } => {
                let slider = MathText::from_words("slider, ").with(length(*from, link));
                let slider = slider.with_words(format!(", on a line along {}", between(*along)));
                let slider = with_unless_zero(slider, &to_left, offset, "");
                slider.with_words(match side.constant().filter(|_| placed.drawn.is_none()) {
                    Some(Side::Left) => format!(", ahead of {}", name(*from)),
                    Some(Side::Right) => format!(", behind {}", name(*from)),
                    None => String::new(),
                })
            }
            JointKindTemplate::Yoke { from, line: along, offset, angle: slot } => {
                let guided = MathText::from_words(format!("yoke on a guide along {}", between(*along)));
                let guided = with_unless_zero(guided, &to_left, offset, "");
                // At a right angle a mirror image is the same.
                let is_right = slot.value.constant_value().is_some_and(|_| slot.evaluate(&[]).abs() == 90.0);
                let towards =
                    if is_right { String::new() } else { format!(", to its {}", self.side_as_drawn(Side::Left)) };
                let slotted = format!("; {} moves in its slot, its angle to the guide{towards}: ", name(*from));
                guided.with_words(slotted).with(slot.to_math_text())
            }
            JointKindTemplate::Slot { base: [pivot, through], offset, side } => {
                let foot = MathText::from_words(format!(
                    "foot of the perpendicular from {} to the bar that slides through {}, ",
                    name(*pivot),
                    name(*through)
                ));
                let side = match side.constant() {
                    Some(side) => format!(" to the {} of {}", self.side_as_drawn(side), between([*pivot, *through])),
                    None => format!(" on the side of {} on which it is drawn", between([*pivot, *through])),
                };
                match is_drawn && offset.constant_value().is_none() {
                    true => foot.with_words(side.trim_start()),
                    false => foot.with(length(*pivot, offset)).with_words(if is_zero(offset) { "" } else { &side }),
                }
            }
            JointKindTemplate::Parallelogram { corners } => {
                let corners: Vec<usize> = corners.iter().copied().chain([joint]).collect();
                MathText::from_words(format!("parallelogram {}", self.names_in_a_row(&corners)))
            }
            // The links that close loops at it are stated there, or at the joints after it.
            JointKindTemplate::Grouped { .. } => {
                let bars = self.closures.iter().filter_map(|closure| match closure {
                    ClosureTemplate::Bar { joints, .. } if joints.contains(&joint) => Some(*joints),
                    _ => None,
                });
                let is_stated = |joints: &[usize; 2]| joints.iter().max() == Some(&joint);
                let bars: Vec<[usize; 2]> = bars.collect();
                match bars.first() {
                    Some(first) if !bars.iter().any(is_stated) => {
                        MathText::from_words(format!("on the link {}", between(*first)))
                    }
                    _ => MathText::default(),
                }
            }
            JointKindTemplate::Point { base, along, across } => {
                let place = match self.sliding_direction(*base) {
                    Some(direction) => format!("parallel to {direction}"),
                    None => format!("along {}", between(*base)),
                };
                let set = if is_drawn { point_of_drawing } else { point_on_link };
                set(&place, &name(base[0]), along, (across, self.side_as_drawn(Side::Left)))
            }
            JointKindTemplate::Distances { base: [a, b], distances: [first, second], side } => {
                length(*a, first).with_words(", ").with(length(*b, second)).with_words(on_side(side, [*a, *b]))
            }
        }
    }

    /// The direction in which points are measured whose base is a pivot and a joint that slides at an offset from it along the pivot's link, or the
    /// two in the other order, for the block in which it slides: the line through both turns on the link. So does that of a slider and a point of its
    /// guide, which the slider may pass.
    fn sliding_direction(&self, base: [usize; 2]) -> Option<String> {
        let is_base = |a: usize, b: usize| base == [a, b] || base == [b, a];
        let name = |k: usize| displayed_name(&self.joints[k].name);
        self.joints.iter().enumerate().find_map(|(own, joint)| match &joint.kind {
            JointKindTemplate::Slot { base: [pivot, through], offset, .. } if is_base(*pivot, *through) => {
                let line = if base[0] == *pivot { [own, *through] } else { [*through, own] };
                (!is_zero(offset)).then(|| self.names_in_a_row(&line))
            }
            JointKindTemplate::Slide { line: [p, q], .. }
            | JointKindTemplate::Yoke { line: [p, q], .. }
            | JointKindTemplate::Rack { line: [p, q], .. }
            | JointKindTemplate::DrivenSlider { line: [p, q], .. }
                if base[0] == own && (base[1] == *p || base[1] == *q) =>
            {
                let line = if base[1] == *q { [*p, *q] } else { [*q, *p] };
                Some(self.names_in_a_row(&line))
            }
            JointKindTemplate::Piston { base: [from, _], offset, .. } if is_base(*from, own) => {
                (!is_zero(offset)).then(|| format!("the actuator towards {}", name(base[1])))
            }
            _ => None,
        })
    }

    /// The link that the joints are defined in, by its joints; in the reported frame it moves.
    pub(super) fn defined_link(&self) -> String {
        let is_fixed = |joint: &usize| matches!(self.joints[*joint].kind, JointKindTemplate::Fixed(_));
        self.names_in_a_row(&(0..self.joints.len()).filter(is_fixed).collect::<Vec<_>>())
    }

    /// The names of joints, by their indices, in a row as they are printed: AB, or Knee–Hip.
    pub fn names_in_a_row(&self, joints: &[usize]) -> String {
        join_names(&joints.iter().map(|&joint| self.joints[joint].name.as_str()).collect::<Vec<_>>())
    }

    /// Whether a joint is the foot of a line through a pivot that a drawing has not: it is the pivot.
    pub fn is_foot_at_pivot(&self, joint: usize) -> bool {
        let is_further = self.joints[joint].drawn.is_none() && self.joints.iter().any(|other| other.drawn.is_some());
        matches!(&self.joints[joint].kind, JointKindTemplate::Slot { offset, .. } if is_further && is_zero(offset))
    }

    /// Whether a fixed joint is a pivot, as of [`Linkage::pivots`](crate::linkage::Linkage::pivots); otherwise it is only a point of reference.
    fn is_pivot(&self, joint: usize) -> bool {
        self.structure().is_ok_and(|linkage| {
            linkage.find_joint(&self.joints[joint].name).is_some_and(|joint| linkage.pivots().contains(&joint))
        })
    }
}

/// The length of a link of a drawing: "AB ≈ 1.41421", or "link AB" where it follows from coordinates that differ from cell to cell.
fn drawn_length(link: &str, length: &CompiledExpression) -> MathText {
    match length.constant_value() {
        Some(value) => MathText::from_words(format!("{link} {}", rounded_equation(value))),
        None if length.is_distance() => MathText::from_words(format!("link {link}")),
        None => equation(link, length.to_dimension_text()),
    }
}

/// "AB = a".
fn equation(left: &str, right: MathText) -> MathText {
    MathText::from_words(left).equal_to(right)
}

/// The text with a dimension between words, unless the dimension is always 0.
fn with_unless_zero(text: MathText, before: &str, value: &CompiledExpression, after: &str) -> MathText {
    if is_zero(value) { text } else { text.with_words(before).with(value.to_dimension_text()).with_words(after) }
}

fn is_zero(value: &CompiledExpression) -> bool {
    value.constant_value() == Some(0.0)
}

/// "along AB from A: k a", or "along AB from A: u, to its left: v"; `place` is "along AB", or "parallel to BA"; `across` comes with the
/// side it is measured to. The colons keep a parameter whose name is a word apart from the words.
fn point_on_link(place: &str, first: &str, along: &Coordinate, (across, left): (&Coordinate, &str)) -> MathText {
    let start = match (along.count(), across.count()) {
        (1, 1) => MathText::default(),
        (rows, columns) => MathText::from_words(format!("{rows} × {columns} points, ")),
    };
    let along = start.with_words(format!("{place} from {first}: ")).with(coordinate(along));
    match across {
        Coordinate::Single(across) if is_zero(across) => along,
        _ => along.with_words(format!(", to its {left}: ")).with(coordinate(across)),
    }
}

/// "along AB from A ≈ 1.41421, to its left = 2", or "on a line along AB" where the dimensions differ from cell to cell.
fn point_of_drawing(place: &str, first: &str, along: &Coordinate, (across, left): (&Coordinate, &str)) -> MathText {
    let number = |coordinate: &Coordinate| match coordinate {
        Coordinate::Single(value) => value.constant_value(),
        Coordinate::Range { .. } => None,
    };
    match number(along).zip(number(across)) {
        Some((along, 0.0)) => MathText::from_words(format!("{place} from {first} {}", rounded_equation(along))),
        Some((along, across)) => {
            let [along, across] = [along, across].map(rounded_equation);
            MathText::from_words(format!("{place} from {first} {along}, to its {left} {across}"))
        }
        None => MathText::from_words(format!("point of the link {}", place.trim_start_matches("along "))),
    }
}

/// "= 2", or "≈ 1.41421" where it is rounded.
fn rounded_equation(value: f64) -> String {
    let rounded = round_to_six_digits(value);
    let sign = if is_same_number(value, rounded) { "=" } else { "≈" };
    format!("{sign} {}", format_exactly(rounded))
}

fn coordinate(coordinate: &Coordinate) -> MathText {
    match coordinate {
        Coordinate::Single(value) => value.to_dimension_text(),
        Coordinate::Range { from, to, .. } => from.to_dimension_text().with_words(" to ").with(to.to_dimension_text()),
    }
}

#[cfg(test)]
mod tests {
    use crate::catalogue;

    #[test]
    fn constants_have_decimals_beside_them_and_no_digits_that_no_one_writes() {
        let linkage = r#"[[linkage]]
id = "l"
trace = ["M", "B"]
[linkage.joints]
O = { fixed = [0, 0] }
C = { fixed = ["10 / 3", "59 / 19"] }
A = { crank = "O", length = "5 / 2" }
Y = { yoke = "A", line = ["O", "C"], offset = -35.36754082718272, angle = "200 / 3 deg" }
B = { dyad = ["Y", "C"], lengths = ["20 * sqrt(5)", 44.721359549995796], side = "left" }
M = { point = ["Y", "C"], along = 1.25, across = 14.142135623730951 }
"#;
        let template = crate::linkage_format::parse_templates(linkage).unwrap().remove(0);
        for (joint, expected) in [
            (1, "fixed pivot at (10 / 3 ≈ 3.33333, 59 / 19 ≈ 3.10526)"),
            (2, "pin of the crank, OA = 5 / 2 = 2.5"),
            (
                3,
                "yoke on a guide along OC, to its left: ≈−35.3675; A moves in its slot, its angle to the guide, to its left: ≈66.6667°",
            ),
            (4, "YB = 20 √5 ≈ 44.7214, CB ≈ 44.7214, left of YC"),
            (5, "parallel to OC from Y: 1.25, to its left: ≈14.1421"),
        ] {
            assert_eq!(template.construction(joint).to_string(), expected);
        }
    }

    #[test]
    fn every_joint_has_a_construction_in_words() {
        let construction = |id: &str, joint: &str| {
            let template = catalogue::find(id).unwrap();
            let index = template.joints.iter().position(|placed| placed.name == joint).unwrap();
            template.construction(index).to_string()
        };
        for (id, joint, expected) in [
            ("evans", "C", "fixed pivot at (p, 0)"),
            ("evans", "A", "pin of the crank, OA = r"),
            ("evans", "B", "AB = a, CB = s, left of AC"),
            ("evans", "M", "along AB from A: k a"),
            ("chebyshev", "O", "on link AO, at (r, 0)"),
            ("chebyshev", "B", "pin of the driving link, AB = a"),
            ("cognates", "M", "along AB from A: u, to its left: v"),
            ("cognates", "D", "parallelogram OAMD"),
            ("hrones-nelson", "M", "5 × 2 points, along PR from P: 0 to 1.6 A, to its left: 0.5 to 1"),
            ("klann", "Hip", "Knee–Hip = b, Upper–Hip = c, left of Knee–Upper"),
            ("slider-crank", "X", "fixed point at (1, 0)"),
            ("slider-crank", "B", "slider, AB = coupler, on a line along OX, to its left: offset, ahead of A"),
            (
                "linear-actuator",
                "A",
                "pin of the crank, OA = r, right of CO, driven by the actuator from C, its line e to the right of C, seen towards A",
            ),
            (
                "inverted-slider-crank",
                "B",
                "foot of the perpendicular from C to the bar that slides through A, CB = e to the right of CA",
            ),
            ("inverted-slider-crank", "M", "parallel to BA from C: along, to its left: across"),
            (
                "geared-five-bar",
                "D",
                "pin of a crank geared to A, PD = d, ratio n : m, over an idler where it is positive, at phase counter-clockwise where A is at 0°",
            ),
            (
                "scotch-yoke",
                "Y",
                "yoke on a guide along OX, to its left: offset; A moves in its slot, its angle to the guide, to its left: angle",
            ),
            ("scotch-yoke", "M", "parallel to OX from Y: along, to its left: across"),
            ("rack-steering", "N", "parallel to OX from R: −w"),
            (
                "rack-steering",
                "R",
                "rack on a line along OX, to its left: −r, by a pinion on the crank of A, its pitch radius = r, right of O, at input 0 beside O",
            ),
            ("roberts", "M", "AM = b, BM = b, right of AB"),
        ] {
            assert_eq!(construction(id, joint), expected, "{id} {joint}");
        }
        let mut mirrored = (*catalogue::find("geared-five-bar").unwrap()).clone();
        mirrored.orientation = crate::geometry::Orientation::new(true, 0.0);
        let index = mirrored.joints.iter().position(|placed| placed.name == "D").unwrap();
        assert!(mirrored.construction(index).to_string().ends_with("at phase clockwise where A is at 0°"));
        for template in catalogue::all() {
            assert!((0..template.joints.len()).all(|joint| !template.construction(joint).is_empty()));
        }
    }
}
