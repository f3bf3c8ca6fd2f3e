//! Numbers read off a motion, one measure a file; each is a column of `cells.csv` and a name in `where`.

mod annulus;
mod between;
mod class;
mod column;
mod course;
mod crossings;
mod dwell;
mod exchange;
mod extreme;
mod input_range;
mod kind;
mod longest;
mod mirror;
mod path;
mod shape;
mod speed_ratio;
mod straight;
mod straightest;
mod strip;
mod swing;
mod symmetry;
mod time_ratio;
mod trail;
mod transmission;

pub use column::{COLUMNS, Column, column, take_columns};
pub use dwell::Dwell;
pub use mirror::Axis;
pub use path::lengths_from_start;
pub use straight::{Portion, Straight};
pub use symmetry::Symmetry;

use std::cell::OnceCell;
use std::rc::Rc;

use crate::linkage::{Class, JointId, Linkage};
use crate::motion::{Circuit, Motion};
use course::Course;
use trail::Trail;

/// What a measure is taken of: a traced joint on a circuit.
#[derive(Clone, Debug)]
pub struct Subject<'a> {
    /// The linkage.
    pub linkage: &'a Linkage,
    /// All that it does.
    pub motion: &'a Motion,
    /// The circuit, by as many samples as tell of its curves: a measure is one of the curve, however few its samples are.
    pub circuit: &'a Circuit,
    /// The traced joint.
    pub joint: JointId,
    /// What is asked of its straight portion.
    pub asked: Straight,
    alone: OnceCell<(Linkage, JointId)>,
    trail: OnceCell<Rc<Trail>>,
    course: OnceCell<Course>,
    straight: OnceCell<Option<Portion>>,
    dwell: OnceCell<Option<Dwell>>,
    symmetry: OnceCell<Option<Symmetry>>,
    transmission: OnceCell<Option<[f64; 2]>>,
    cusps: OnceCell<usize>,
}

impl<'a> Subject<'a> {
    /// A traced joint on a circuit of a linkage's motion.
    pub fn new(linkage: &'a Linkage, motion: &'a Motion, circuit: &'a Circuit, joint: JointId) -> Subject<'a> {
        let (alone, trail, course, straight, dwell, symmetry, transmission, cusps) = Default::default();
        let (asked, circuit) = (Straight::default(), circuit.finely(linkage));
        Subject {
            linkage,
            motion,
            circuit,
            joint,
            asked,
            alone,
            trail,
            course,
            straight,
            dwell,
            symmetry,
            transmission,
            cusps,
        }
    }

    /// The same, of which another straight portion is wanted.
    pub fn asking(self, asked: Straight) -> Subject<'a> {
        Subject { asked, straight: OnceCell::new(), ..self }
    }

    /// The straight portion asked for.
    pub fn straight(&self) -> Option<&Portion> {
        self.straight.get_or_init(|| straight::portion(self.course()?, self.asked)).as_ref()
    }

    /// The least and the greatest transmission angle, in degrees.
    fn transmission(&self) -> Option<[f64; 2]> {
        *self.transmission.get_or_init(|| transmission::least_and_greatest(self))
    }

    /// The linkage without other traced points, and the joint in it: what is asked at many inputs is asked of this.
    fn alone(&self) -> (&Linkage, JointId) {
        let (linkage, joint) = self.alone.get_or_init(|| self.linkage.with_one_point(self.joint));
        (linkage, *joint)
    }

    /// How often the path stands still and turns back.
    fn cusps(&self) -> usize {
        *self.cusps.get_or_init(|| shape::cusps(self))
    }

    /// What is marked on pages of what has been measured: its straight portion and its symmetry.
    pub fn marks(&self) -> (Option<Portion>, Option<Symmetry>) {
        (self.straight.get().cloned().flatten(), self.symmetry.get().copied().flatten())
    }

    /// Whether it is symmetrical, and about which line; `None` of a point.
    pub fn symmetry(&self) -> Option<&Symmetry> {
        self.symmetry.get_or_init(|| symmetry::symmetry(self)).as_ref()
    }

    /// The best circular portion.
    pub fn dwell(&self) -> Option<&Dwell> {
        self.dwell.get_or_init(|| dwell::dwell(self.course()?)).as_ref()
    }

    /// The curve, made once for all measures.
    fn trail(&self) -> &Trail {
        self.trail.get_or_init(|| self.new_trail())
    }

    fn new_trail(&self) -> Rc<Trail> {
        Rc::new(Trail::of(self.circuit, self.joint, self.linkage.input()))
    }

    /// The curve as a row of points, made once for all portions; `None` where it has no place at most of its samples.
    fn course(&self) -> Option<&Course> {
        const FEWEST: usize = 5;
        let course = || Course::of(self.trail.get_or_init(|| self.new_trail()).clone());
        (self.trail().points.len() >= FEWEST).then(|| self.course.get_or_init(course))
    }
}

/// A measured value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A word.
    Word(&'static str),
    /// It does not apply.
    Missing,
}

/// A measure.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    /// Its column.
    pub name: &'static str,
    /// Its unit; empty for a word or a pure number.
    pub unit: &'static str,
    /// Whether it is a word and not a number: a word cannot be compared in `where`.
    pub is_word: bool,
    /// What it is.
    pub definition: &'static str,
    /// How it is taken.
    pub take: fn(&Subject) -> Value,
}

impl Measure {
    /// A measure that is a number.
    const fn number(
        name: &'static str,
        unit: &'static str,
        definition: &'static str,
        take: fn(&Subject) -> Value,
    ) -> Measure {
        Measure { name, unit, is_word: false, definition, take }
    }
}

/// Every measure, in the order of the columns.
pub const ALL: [Measure; 33] = [
    class::CLASS,
    kind::TYPE,
    kind::SHORTEST,
    input_range::INPUT_MIN,
    input_range::INPUT_MAX,
    swing::OUTPUT_SWING,
    transmission::MU_MIN,
    transmission::MU_MAX,
    time_ratio::TIME_RATIO,
    path::LENGTH,
    path::AREA,
    path::BOX[0],
    path::BOX[1],
    path::BOX[2],
    path::BOX[3],
    shape::CUSPS,
    shape::CRUNODES,
    shape::INFLECTIONS,
    symmetry::SYMMETRY,
    symmetry::AXIS,
    symmetry::RESIDUAL,
    shape::CURVATURE_MAX,
    speed_ratio::SPEED_RATIO,
    straight::MEASURES[0],
    straight::MEASURES[1],
    straight::MEASURES[2],
    straight::MEASURES[3],
    dwell::MEASURES[0],
    dwell::MEASURES[1],
    dwell::MEASURES[2],
    dwell::MEASURES[3],
    dwell::MEASURES[4],
    dwell::MEASURES[5],
];

/// A name that is true or false of a curve: `is_crank_rocker` and its like, by the word it asks for.
pub const TRUTHS: [(&str, &str); 5] = [
    ("is_crank_rocker", "crank-rocker"),
    ("is_drag_link", "drag-link"),
    ("is_double_rocker", "double-rocker"),
    ("is_triple_rocker", "triple-rocker"),
    ("is_change_point", "change-point"),
];

/// Whether it is the measure, told by its place in [`ALL`], by which [`TRUTHS`] are told.
pub fn tells_truths(measure: usize) -> bool {
    ALL[measure].name == class::CLASS.name
}

/// Whether one of [`TRUTHS`] holds, 1 or 0; not a number where there is no class.
pub fn truth(word: &str, values: &[Value]) -> f64 {
    match ALL.iter().zip(values).find(|(measure, _)| measure.name == class::CLASS.name) {
        Some((_, Value::Word(class))) => f64::from(u8::from(*class == word)),
        _ => f64::NAN,
    }
}

/// Every measure of a subject, in the order of [`ALL`].
pub fn take(subject: &Subject) -> Vec<Value> {
    take_some(subject, |_| true)
}

/// Some measures of a subject, told by their place in [`ALL`], in that order; the others are missing.
pub fn take_some(subject: &Subject, is_wanted: impl Fn(usize) -> bool) -> Vec<Value> {
    let take = |(k, measure): (usize, &Measure)| if is_wanted(k) { (measure.take)(subject) } else { Value::Missing };
    ALL.iter().enumerate().map(take).collect()
}

const _: () = assert!(TRUTHS.len() == Class::ALL.len());

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_class_has_its_truth() {
        for class in Class::ALL {
            let truth =
                TRUTHS.iter().find(|(_, word)| *word == class.name()).unwrap_or_else(|| panic!("{}", class.name()));
            assert_eq!(truth.0, format!("is_{}", class.name().replace('-', "_")));
        }
    }
}
