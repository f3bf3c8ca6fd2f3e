//! The kernel: open families, studies and searches by their handles.

use serde_json::{Value, json};

use coupler_curves::geometry::Point;
use coupler_curves::linkage::{Cognates, JointId};
use coupler_curves::motion;
use coupler_find::{CurveIndex, Index};

use crate::curves::{ShapeSearch, deviation};
use crate::description::{opened_json, study_json};
use crate::dragging::Dragging;
use crate::drawn_path::drawn_path_json;
use crate::family::{OpenFamily, fragment};
use crate::finder::{FourBarSearch, grow_index};
use crate::joint_motion::joint_motion_json;
use crate::moving_picture::MovingPicture;
use crate::overlays::{centrodes_json, cognate_pins, cognates, cognates_json};
use crate::path_file::path_file_json;
use crate::paths::{measures_json, path_json, speeds_json};
use crate::reading::{nearest_place, reading_json};
use crate::request::{CurveRequest, Request};
use crate::response::{Numbers, Response};
use crate::study::{Opened, Place, Study};
use crate::tables::{catalogue_json, curve_json, first_cell_json};

/// What the page has opened, by handles from 0; the handle of what is closed is used again.
#[derive(Default)]
pub struct Kernel {
    families: Slots<OpenFamily>,
    studies: Slots<OpenStudy>,
    index: Index,
    /// The first curves of the index, in which paths are looked up while they change.
    first: Index,
    searches: Slots<FourBarSearch>,
    curves: Slots<CurveIndex>,
    shapes: Slots<ShapeSearch>,
    pictures: Slots<MovingPicture>,
}

/// A study with what is computed once for all its poses.
#[derive(Debug)]
struct OpenStudy {
    curve: CurveRequest,
    study: Study,
    cognates: Option<Cognates>,
}

/// The curves for which an index takes memory before they come; more of them take it then.
const MAX_RESERVED: usize = 100_000;

impl Kernel {
    /// The numbers of a pose before the positions of the joints: the transmission angle, the velocity, the pole, the
    /// inflection pole, and the pins of both cognates.
    pub const POSE_HEADER: usize = 15;

    /// Answers a request in JSON.
    pub fn call(&mut self, request: &str) -> Response {
        self.call_with_numbers(request, &[])
    }

    /// Answers a request in JSON with numbers, to which it refers.
    pub fn call_with_numbers(&mut self, request: &str, given: &[f64]) -> Response {
        let mut numbers = Numbers::default();
        let answer = Request::parse(request, given).and_then(|request| self.answer(request, &mut numbers));
        numbers.into_response(&answer.unwrap_or_else(|error| json!({ "error": error })))
    }

    fn answer(&mut self, request: Request, numbers: &mut Numbers) -> Result<Value, String> {
        Ok(match request {
            Request::About => json!({
                "version": env!("CARGO_PKG_VERSION"),
                "compiler": env!("KERNEL_COMPILER"),
                "sources": env!("KERNEL_SOURCES"),
            }),
            Request::OpenFamily { manifest } => {
                let family = OpenFamily::from_manifest(&manifest)?;
                let description = family.description();
                merge(json!({ "family": self.families.insert(family) }), description)
            }
            Request::Catalogue => catalogue_json(),
            Request::FirstCell { family } => first_cell_json(self.families.get(family)?, numbers)?,
            Request::CurveData { curve } => curve_json(self.families.get(curve.family)?, &curve, numbers)?,
            Request::CloseFamily { family } => json!({ "closed": self.families.remove(family) }),
            Request::OpenStudy { curve, shown, is_rough } => self.open_study(&curve, shown, is_rough, numbers)?,
            Request::CloseStudy { study } => json!({ "closed": self.studies.remove(study) }),
            Request::Path { study, tolerance } => {
                let OpenStudy { curve, study, .. } = self.studies.get(study)?;
                path_json(study, &self.families.get(curve.family)?.options.page, tolerance, numbers)
            }
            Request::Speeds { study, count } => speeds_json(self.study(study)?, count, numbers),
            Request::JointMotion { study, joint, count, place, load } => {
                let study = self.study(study)?;
                let places = match place {
                    Some((pass, input)) => vec![Place { pass, input }],
                    None => study.places(count).collect(),
                };
                joint_motion_json(study, joint, &places, load.as_deref(), numbers)?
            }
            Request::Measures { study } => measures_json(self.study(study)?, numbers),
            Request::Cognates { study } => json!(cognates_json(self.study(study)?, numbers)),
            Request::Centrodes { study, samples } => json!(centrodes_json(self.study(study)?, samples, numbers)),
            Request::Nearest { study, point: [x, y] } => {
                let study = self.study(study)?;
                nearest_place(study, Point::new(x, y)).map_or(Value::Null, |place| reading_json(study, place))
            }
            Request::Reading { study, pass, input } => reading_json(self.study(study)?, Place { pass, input }),
            Request::Handles { study } => {
                let pass = self.study(study)?.passes().first().ok_or("the study has no pass")?;
                // Not where a joint may be at rest.
                let input = pass.from.input.value + 0.37 * (pass.to.input.value - pass.from.input.value);
                self.dragging(study, Place { pass: 0, input })?.handles()?
            }
            Request::Drag { study, joint, to: [x, y], pass, input, unlocked } => {
                self.dragging(study, Place { pass, input })?.drag(joint, Point::new(x, y), &unlocked)?
            }
            Request::Export { curve, format } => self.families.get(curve.family)?.export(&curve, &format)?,
            Request::Fragment { curves } => {
                let curves = curves
                    .iter()
                    .map(|curve| Ok((self.families.get(curve.family)?, curve)))
                    .collect::<Result<Vec<_>, String>>()?;
                json!({ "text": fragment(&curves)? })
            }
            Request::ReadPath { bytes, outline } => path_file_json(&bytes, outline.as_deref(), numbers)?,
            Request::DrawnPath { points, closed, is_part } => drawn_path_json(&points, closed, is_part, numbers)?,
            Request::OpenPicture { size } => json!({ "picture": self.pictures.insert(MovingPicture::new(size)?) }),
            Request::AddFrame { picture, pixels, delay } => {
                json!({ "bytes": self.pictures.get_mut(picture)?.add(&pixels, delay)? })
            }
            Request::ClosePicture { picture } => {
                let file = self.pictures.take(picture).ok_or_else(|| not_open(picture))?.finish()?;
                json!({ "bytes": numbers.array(file.into_iter().map(f64::from)) })
            }
            Request::GrowIndex => grow_index(&mut self.index, &mut self.first),
            Request::OpenSearch { points, kind, options, start } => {
                let search = FourBarSearch::new(&points, &kind, options, start)?;
                json!({ "hindrances": search.hindrances(), "search": self.searches.insert(search) })
            }
            Request::StepSearch { search } => {
                json!({ "is_done": self.searches.get_mut(search)?.step(&self.index, &self.first) })
            }
            Request::Answers { search, name } => self.searches.get_mut(search)?.answers_json(&name, numbers),
            Request::CloseSearch { search } => json!({ "closed": self.searches.remove(search) }),
            Request::OpenCurves { count } => {
                json!({ "curves": self.curves.insert(CurveIndex::with_capacity(count.min(MAX_RESERVED))) })
            }
            Request::AddCurves { curves, given } => {
                let index = self.curves.get_mut(curves)?;
                given.curves()?.for_each(|(points, is_closed)| index.push(points, is_closed));
                json!({ "count": index.len() })
            }
            Request::CloseCurves { curves } => json!({ "closed": self.curves.remove(curves) }),
            Request::OpenShape { points, kind, mirror, least, wanted } => {
                let search = ShapeSearch::new(&points, &kind, mirror, least, wanted)?;
                json!({ "most": search.most(), "shape": self.shapes.insert(search) })
            }
            Request::CompareShape { shape, curves, from } => {
                self.shapes.get_mut(shape)?.compare(self.curves.get(curves)?, from, numbers)
            }
            Request::CompareClosely { shape, given } => self.shapes.get(shape)?.likenesses(&given, numbers)?,
            Request::FitShape { shape, points, closed } => self.shapes.get(shape)?.fit(&points, closed, numbers),
            Request::CloseShape { shape } => json!({ "closed": self.shapes.remove(shape) }),
            Request::Deviation { from, points, closed } => deviation(&from, &points, closed)?,
        })
    }

    fn open_study(
        &mut self,
        curve: &CurveRequest,
        shown: Option<usize>,
        is_rough: bool,
        numbers: &mut Numbers,
    ) -> Result<Value, String> {
        let family = self.families.get(curve.family)?;
        let changed = match family.changed_cell(curve) {
            Ok(changed) => changed,
            Err(reason) => return Ok(json!({ "reason": reason, "circuits": [] })),
        };
        let opened = Opened::new(changed, curve.curve, shown, is_rough);
        let found = opened_json(family, curve, &opened);
        let Ok(study) = opened.study else { return Ok(found) };
        let description = study_json(&study, numbers);
        let open = OpenStudy { curve: curve.clone(), cognates: cognates(&study), study };
        let handle = json!({ "study": self.studies.insert(open) });
        Ok(merge(merge(handle, found), description))
    }

    fn dragging(&self, study: usize, place: Place) -> Result<Dragging<'_>, String> {
        let OpenStudy { curve, study, .. } = self.studies.get(study)?;
        let family = self.families.get(curve.family)?;
        Dragging::new(family, curve, study, place).ok_or_else(|| format!("there is no pass {}", place.pass))
    }

    fn study(&self, handle: usize) -> Result<&Study, String> {
        self.studies.get(handle).map(|open| &open.study)
    }

    /// The pose of a study's linkage at an input of a pass: the numbers of [`Kernel::POSE_HEADER`], NaN where they are
    /// not defined, and the positions of all joints; empty without such a study or pass.
    pub fn pose(&self, study: usize, pass: usize, input: f64, out: &mut Vec<f64>) {
        out.clear();
        let Ok(OpenStudy { study, cognates, .. }) = self.studies.get(study) else { return };
        let Some(moved) = study.passes().get(pass) else { return };
        let pose = motion::pose(&study.linkage, moved, input);
        let velocity = study.velocity(moved, input);
        let undefined = Point::new(f64::NAN, f64::NAN);
        let instant = study.instant(moved, input);
        let [pole, inflection] = instant.map_or([undefined; 2], |instant| [instant.pole, instant.inflection_pole()]);
        let pins = cognates.as_ref().and_then(|cognates| cognate_pins(study, cognates, &pose));
        out.extend([study.transmission_angle(&pose).unwrap_or(f64::NAN), velocity.x, velocity.y]);
        let points = [pole, inflection].into_iter().chain(pins.unwrap_or([undefined; 4])).chain(pose);
        out.extend(points.flat_map(|p| [p.x, p.y]));
    }

    /// The position of a joint of a study's linkage at an input of a pass; NaN where there is none.
    pub fn joint_position(&self, study: usize, joint: usize, pass: usize, input: f64) -> [f64; 2] {
        let position = self.study(study).ok().filter(|study| joint < study.linkage.joints.len());
        let position = position.and_then(|study| study.joint_position(JointId::new(joint), pass, input));
        position.map_or([f64::NAN; 2], |p| [p.x, p.y])
    }
}

/// Two JSON objects as one.
fn merge(mut first: Value, second: Value) -> Value {
    if let (Value::Object(first), Value::Object(second)) = (&mut first, second) {
        first.extend(second);
    }
    first
}

/// Things by their handles.
#[derive(Debug)]
struct Slots<T>(Vec<Option<T>>);

impl<T> Default for Slots<T> {
    fn default() -> Slots<T> {
        Slots(Vec::new())
    }
}

impl<T> Slots<T> {
    /// Adds a thing; its handle, the least that is free.
    fn insert(&mut self, thing: T) -> usize {
        let free = self.0.iter().position(Option::is_none).unwrap_or(self.0.len());
        if free == self.0.len() {
            self.0.push(None);
        }
        self.0[free] = Some(thing);
        free
    }

    /// Removes a thing; whether there was one.
    fn remove(&mut self, handle: usize) -> bool {
        self.take(handle).is_some()
    }

    /// Removes and returns a thing, if there is one.
    fn take(&mut self, handle: usize) -> Option<T> {
        self.0.get_mut(handle).and_then(Option::take)
    }

    fn get(&self, handle: usize) -> Result<&T, String> {
        self.0.get(handle).and_then(Option::as_ref).ok_or_else(|| not_open(handle))
    }

    fn get_mut(&mut self, handle: usize) -> Result<&mut T, String> {
        self.0.get_mut(handle).and_then(Option::as_mut).ok_or_else(|| not_open(handle))
    }
}

fn not_open(handle: usize) -> String {
    format!("the handle {handle} is not open")
}
