//! Requests of the page.

use serde_json::Value;

use coupler_curves::geometry::{Bounds, Point};
use coupler_find::{Condition, Effort, Mechanism, Options};

/// A request. As JSON it is an object with its name in snake case as `method`, and with its fields. Numbers may be given as
/// strings: these are read to the last bit, as numbers of JSON need not be. `{"$": [start, length]}` is an array of the numbers
/// that come with it, as in a [`crate::Response`].
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// What the module was built from.
    About,
    /// Opens the family of a manifest, which has one: its handle and what the page has to know of it.
    OpenFamily {
        /// The manifest, as TOML.
        manifest: String,
    },
    /// The linkages of the catalogue: `linkages`, each with its `id`, its `legend`, and a `manifest` with a family of it to start from.
    Catalogue,
    /// The first cell of a family: the statements `head`, `cells` and `curves` of the data of a family of this cell alone.
    FirstCell {
        /// The handle.
        family: usize,
    },
    /// A curve with its changes, as statements of the data of a family of this curve alone.
    CurveData {
        /// The curve.
        curve: CurveRequest,
    },
    /// Closes a family; the next family that is opened may have its handle.
    CloseFamily {
        /// The handle.
        family: usize,
    },
    /// Opens the study of a curve: its linkage in motion. Without a curve, the reason.
    OpenStudy {
        /// The curve.
        curve: CurveRequest,
        /// The index of the circuit to show among all of the linkage; null for the curve's own.
        shown: Option<usize>,
        /// Whether only the circuits that the family selects are found.
        is_rough: bool,
    },
    /// Closes a study; the next study that is opened may have its handle.
    CloseStudy {
        /// The handle.
        study: usize,
    },
    /// The curve as a polyline, and its dashes.
    Path {
        /// The handle of the study.
        study: usize,
        /// The greatest distance of a chord from the curve.
        tolerance: f64,
    },
    /// The speed of the traced point over the circuit.
    Speeds {
        /// The handle of the study.
        study: usize,
        /// The number of places in each pass.
        count: usize,
    },
    /// The motion of a joint and of the links: `passes` and `inputs` of places, arrays, and there `positions`, `velocities` and
    /// `accelerations` of the joint, arrays `[x, y, x, y, …]`; `links`, a list with the names of the `joints` of each moving link and the arrays
    /// of its angular `velocities` and `accelerations`; `transmission_angles` in degrees, an array, null but for four-bars; and `torques`, an
    /// array, with `torque`, an object of their extremes over the circuit: `peak`, the greatest magnitude, at `peak_input`, `min` and `max`,
    /// infinite ones as words. Both are null without a load.
    JointMotion {
        /// The handle of the study.
        study: usize,
        /// The index of the joint.
        joint: usize,
        /// About the number of places over the circuit, if `place` is null.
        count: usize,
        /// One place, `{"pass": 0, "input": 30}`, by the index of its pass; or null.
        place: Option<(usize, f64)>,
        /// The load, as `100 on C at -90 deg`, or `100 on C` for a force against the motion of C; null for the family's, if it has one.
        load: Option<String>,
    },
    /// The measures of the curve, and its straight portion.
    Measures {
        /// The handle of the study.
        study: usize,
    },
    /// The cognates of the linkage, or null.
    Cognates {
        /// The handle of the study.
        study: usize,
    },
    /// The fixed and the moving centrode of the link that traces the curve, or null.
    Centrodes {
        /// The handle of the study.
        study: usize,
        /// The number of samples of the circuit.
        samples: usize,
    },
    /// The reading at the point of the curve nearest to a point.
    Nearest {
        /// The handle of the study.
        study: usize,
        /// The point.
        point: [f64; 2],
    },
    /// The reading at an input of a pass.
    Reading {
        /// The handle of the study.
        study: usize,
        /// The index of the pass.
        pass: usize,
        /// The input.
        input: f64,
    },
    /// The joints of a study that dimensions move: `handles`, each with `joint`, the `names` of the dimensions, and `nearest`, those by which it is moved
    /// if none is locked.
    Handles {
        /// The handle of the study.
        study: usize,
    },
    /// Moves a joint to a place by the nearest of some dimensions, the input held, or as near to it as they can: `changes`, names with their values; `distance`,
    /// how far the joint remains from the place; `is_held`, false if there is no such pose.
    Drag {
        /// The handle of the study.
        study: usize,
        /// The index of the joint.
        joint: usize,
        /// The place.
        to: [f64; 2],
        /// The index of the pass.
        pass: usize,
        /// The input.
        input: f64,
        /// The names of the dimensions.
        unlocked: Vec<String>,
    },
    /// A curve as a file.
    Export {
        /// The curve.
        curve: CurveRequest,
        /// The name of the format.
        format: String,
    },
    /// A manifest fragment with the cells of some curves.
    Fragment {
        /// The curves.
        curves: Vec<CurveRequest>,
    },
    /// Reads the path in a file.
    ReadPath {
        /// The bytes of the file, an array of numbers.
        bytes: Vec<f64>,
        /// The outline to take of several: its id, or its number from 1; by default the most likely.
        outline: Option<String>,
    },
    /// The path to search for of a shape: without noise, and with points enough for its form to be seen.
    DrawnPath {
        /// The points of the shape, an array `[x, y, x, y, …]`.
        points: Vec<Point>,
        /// Whether it is closed.
        closed: bool,
        /// Whether it is to be a part of curves.
        is_part: bool,
    },
    /// Opens a moving picture (GIF) of a width and a height in pixels: its handle.
    OpenPicture {
        /// The width and the height.
        size: [usize; 2],
    },
    /// Adds a frame to a moving picture; the number of bytes so far.
    AddFrame {
        /// The handle of the picture.
        picture: usize,
        /// Its pixels row by row: red + 256 green + 65,536 blue.
        pixels: Vec<f64>,
        /// How long it is shown, in hundredths of a second.
        delay: usize,
    },
    /// The bytes of a moving picture, an array, which is closed.
    ClosePicture {
        /// The handle of the picture.
        picture: usize,
    },
    /// Adds some four-bars to the index that searches look their paths up in.
    GrowIndex,
    /// Begins to search the index for the four-bars whose curves are nearest to a path.
    OpenSearch {
        /// The points of the path, an array `[x, y, x, y, …]`.
        points: Vec<Point>,
        /// What a curve has in common with it: `closed`, `open` or `part`.
        kind: String,
        /// Whether the crank must turn fully, the greatest distance of two joints of a link in sizes of the path, a condition, the box of the
        /// fixed pivots as two of its corners, the most answers, and whether they are refined: if not, fewer are tried.
        options: Options,
        /// The four-bar to begin with in place of those of the index, by the pivots of its crank and its rocker, their pins, and its coupler
        /// point, an array of ten numbers.
        start: Option<[Point; 5]>,
    },
    /// Takes a step of a search.
    StepSearch {
        /// The handle.
        search: usize,
    },
    /// Takes a step towards the answers of a search so far, until they are complete.
    Answers {
        /// The handle of the search.
        search: usize,
        /// The name of the path, for the manifest.
        name: String,
    },
    /// Closes a search; the next search that is opened may have its handle.
    CloseSearch {
        /// The handle.
        search: usize,
    },
    /// Opens an index of given curves by their shape: its handle.
    OpenCurves {
        /// The number of curves that are to be added.
        count: usize,
    },
    /// Adds curves to an index.
    AddCurves {
        /// The handle of the index.
        curves: usize,
        /// The curves.
        given: GivenCurves,
    },
    /// Closes an index; the next index that is opened may have its handle.
    CloseCurves {
        /// The handle.
        curves: usize,
    },
    /// Opens a path to which curves are compared: its handle.
    OpenShape {
        /// The points of the path, an array `[x, y, x, y, …]`.
        points: Vec<Point>,
        /// What a curve has in common with it: `closed`, `open` or `part`.
        kind: String,
        /// Whether a curve may be mirrored.
        mirror: bool,
        /// The least part of a curve that is compared with an open path.
        least: f64,
        /// The curves that are wanted.
        wanted: usize,
    },
    /// Compares some curves of an index with a path by their shape, in steps, index by index: after the last step of one, the most similar of
    /// all that have been compared, by their numbers, which follow those of the indexes before.
    CompareShape {
        /// The handle of the path.
        shape: usize,
        /// The handle of the index.
        curves: usize,
        /// The number of the curve to begin with: 0, and then what the step before returned.
        from: usize,
    },
    /// How much curves are like a path, compared more closely than in an index.
    CompareClosely {
        /// The handle of the path.
        shape: usize,
        /// The curves.
        given: GivenCurves,
    },
    /// How a curve fits a path where it is nearest to it.
    FitShape {
        /// The handle of the path.
        shape: usize,
        /// The points of the curve, an array `[x, y, x, y, …]`.
        points: Vec<Point>,
        /// Whether it is closed.
        closed: bool,
    },
    /// Closes a path; the next path that is opened may have its handle.
    CloseShape {
        /// The handle.
        shape: usize,
    },
    /// The deviation of a curve from points where both are.
    Deviation {
        /// The points, an array `[x, y, x, y, …]`.
        from: Vec<Point>,
        /// The points of the curve, an array `[x, y, x, y, …]`.
        points: Vec<Point>,
        /// Whether the curve is closed.
        closed: bool,
    },
}

/// A curve of a family, perhaps with changed parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveRequest {
    /// The handle of the family.
    pub family: usize,
    /// The number of the cell, from 1.
    pub cell: usize,
    /// The numbers of the trace and of the circuit, from 1.
    pub curve: [usize; 2],
    /// The names that the cell gives values to.
    pub values: Vec<(String, f64)>,
    /// The names with changed values.
    pub changes: Vec<(String, f64)>,
}

/// Curves that are given by their points.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenCurves {
    /// The points of all of them, an array `[x, y, x, y, …]`.
    pub points: Vec<Point>,
    /// The number of points of each.
    pub counts: Vec<f64>,
    /// For each whether it is closed: not 0.
    pub closed: Vec<f64>,
}

impl Request {
    /// Parses a request with its numbers.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn parse(text: &str, numbers: &[f64]) -> Result<Request, String> {
        let value: Value = serde_json::from_str(text).map_err(|error| format!("the request is not JSON: {error}"))?;
        let of = Object(&value);
        Ok(match of.text("method")?.as_str() {
            "about" => Request::About,
            "open_family" => Request::OpenFamily { manifest: of.text("manifest")? },
            "catalogue" => Request::Catalogue,
            "first_cell" => Request::FirstCell { family: of.index("family")? },
            "curve_data" => Request::CurveData { curve: CurveRequest::from_value(of.member("curve")?)? },
            "close_family" => Request::CloseFamily { family: of.index("family")? },
            "open_study" => Request::OpenStudy {
                curve: CurveRequest::from_value(of.member("curve")?)?,
                shown: of.optional("shown", Object::index)?,
                is_rough: of.flag("is_rough")?,
            },
            "close_study" => Request::CloseStudy { study: of.index("study")? },
            "path" => Request::Path { study: of.index("study")?, tolerance: of.number("tolerance")? },
            "speeds" => Request::Speeds { study: of.index("study")?, count: of.index("count")? },
            "joint_motion" => Request::JointMotion {
                study: of.index("study")?,
                joint: of.index("joint")?,
                count: of.index("count")?,
                place: match of.member("place")? {
                    Value::Null => None,
                    place => Some((Object(place).index("pass")?, Object(place).number("input")?)),
                },
                load: of.optional("load", Object::text)?,
            },
            "measures" => Request::Measures { study: of.index("study")? },
            "cognates" => Request::Cognates { study: of.index("study")? },
            "centrodes" => Request::Centrodes { study: of.index("study")?, samples: of.index("samples")? },
            "nearest" => Request::Nearest { study: of.index("study")?, point: of.pair("point", number)? },
            "reading" => {
                Request::Reading { study: of.index("study")?, pass: of.index("pass")?, input: of.number("input")? }
            }
            "handles" => Request::Handles { study: of.index("study")? },
            "drag" => Request::Drag {
                study: of.index("study")?,
                joint: of.index("joint")?,
                to: of.pair("to", number)?,
                pass: of.index("pass")?,
                input: of.number("input")?,
                unlocked: of.list("unlocked", |name| {
                    name.as_str().map(str::to_owned).ok_or_else(|| format!("`{name}` is not a name"))
                })?,
            },
            "export" => {
                Request::Export { curve: CurveRequest::from_value(of.member("curve")?)?, format: of.text("format")? }
            }
            "fragment" => Request::Fragment { curves: of.list("curves", CurveRequest::from_value)? },
            "read_path" => Request::ReadPath {
                bytes: of.array("bytes", numbers)?.to_vec(),
                outline: of.optional("outline", Object::text)?,
            },
            "drawn_path" => Request::DrawnPath {
                points: of.points("points", numbers)?,
                closed: of.flag("closed")?,
                is_part: of.flag("is_part")?,
            },
            "open_picture" => Request::OpenPicture { size: [of.index("width")?, of.index("height")?] },
            "add_frame" => Request::AddFrame {
                picture: of.index("picture")?,
                pixels: of.array("pixels", numbers)?.to_vec(),
                delay: of.index("delay")?,
            },
            "close_picture" => Request::ClosePicture { picture: of.index("picture")? },
            "grow_index" => Request::GrowIndex,
            "open_search" => Request::OpenSearch {
                points: of.points("points", numbers)?,
                kind: of.text("kind")?,
                options: Options {
                    full_turn: of.flag("full_turn")?,
                    max_link: of.number("max_link")?,
                    pivots: of.optional("pivots", |of, key| of.points(key, numbers))?.map(Bounds::from_points),
                    condition: of.optional("condition", |of, key| condition(&of.text(key)?))?,
                    effort: if of.flag("refine")? { Effort::Normal } else { Effort::Quick },
                    refine: of.flag("refine")?,
                    most: of.index("most")?,
                    ..Options::default()
                },
                start: of.optional("start", |of, key| {
                    of.points(key, numbers)?
                        .try_into()
                        .map_err(|_| "`start` of the request is not five points".to_owned())
                })?,
            },
            "step_search" => Request::StepSearch { search: of.index("search")? },
            "answers" => Request::Answers { search: of.index("search")?, name: of.text("name")? },
            "close_search" => Request::CloseSearch { search: of.index("search")? },
            "open_curves" => Request::OpenCurves { count: of.index("count")? },
            "add_curves" => {
                Request::AddCurves { curves: of.index("curves")?, given: GivenCurves::from_fields(&of, numbers)? }
            }
            "close_curves" => Request::CloseCurves { curves: of.index("curves")? },
            "open_shape" => Request::OpenShape {
                points: of.points("points", numbers)?,
                kind: of.text("kind")?,
                mirror: of.flag("mirror")?,
                least: of.number("least")?,
                wanted: of.index("wanted")?,
            },
            "compare_shape" => Request::CompareShape {
                shape: of.index("shape")?,
                curves: of.index("curves")?,
                from: of.index("from")?,
            },
            "compare_closely" => {
                Request::CompareClosely { shape: of.index("shape")?, given: GivenCurves::from_fields(&of, numbers)? }
            }
            "fit_shape" => Request::FitShape {
                shape: of.index("shape")?,
                points: of.points("points", numbers)?,
                closed: of.flag("closed")?,
            },
            "close_shape" => Request::CloseShape { shape: of.index("shape")? },
            "deviation" => Request::Deviation {
                from: of.points("from", numbers)?,
                points: of.points("points", numbers)?,
                closed: of.flag("closed")?,
            },
            method => return Err(format!("there is no request `{method}`")),
        })
    }
}

impl CurveRequest {
    fn from_value(value: &Value) -> Result<CurveRequest, String> {
        let of = Object(value);
        Ok(CurveRequest {
            family: of.index("family")?,
            cell: of.index("cell")?,
            curve: of.pair("curve", index)?,
            values: of.list("values", named_number)?,
            changes: of.list("changes", named_number)?,
        })
    }
}

impl GivenCurves {
    fn from_fields(of: &Object<'_>, numbers: &[f64]) -> Result<GivenCurves, String> {
        Ok(GivenCurves {
            points: of.points("points", numbers)?,
            counts: of.array("counts", numbers)?.to_vec(),
            closed: of.array("closed", numbers)?.to_vec(),
        })
    }

    /// The points of each, and whether it is closed.
    ///
    /// # Errors
    /// There are not as many of one as of the others.
    pub(crate) fn curves(&self) -> Result<impl Iterator<Item = (&[Point], bool)>, String> {
        let mut rest = &self.points[..];
        let mut next = |count: &f64| rest.split_off(..*count as usize);
        let curves: Option<Vec<&[Point]>> = self.counts.iter().map(&mut next).collect();
        let curves = curves.filter(|curves| curves.len() == self.closed.len());
        let curves = curves.ok_or("there are fewer points than counted")?;
        Ok(curves.into_iter().zip(self.closed.iter().map(|closed| *closed != 0.0)))
    }
}

/// The members of a JSON object. Derived parsers of the requests would be a tenth of the module.
struct Object<'v>(&'v Value);

impl<'v> Object<'v> {
    fn member(&self, key: &str) -> Result<&'v Value, String> {
        self.0.get(key).ok_or_else(|| format!("the request lacks `{key}`"))
    }

    /// A member read by a function.
    fn read<T>(&self, key: &str, read: impl Fn(&'v Value) -> Option<T>) -> Result<T, String> {
        read(self.member(key)?).ok_or_else(|| format!("`{key}` of the request has another form"))
    }

    /// A member that may be null.
    fn optional<T>(&self, key: &str, read: impl Fn(&Self, &str) -> Result<T, String>) -> Result<Option<T>, String> {
        if self.member(key)?.is_null() { Ok(None) } else { read(self, key).map(Some) }
    }

    fn text(&self, key: &str) -> Result<String, String> {
        self.read(key, |value| value.as_str().map(str::to_owned))
    }

    fn number(&self, key: &str) -> Result<f64, String> {
        self.read(key, number)
    }

    fn flag(&self, key: &str) -> Result<bool, String> {
        self.read(key, Value::as_bool)
    }

    /// An array of numbers.
    fn array<'n>(&self, key: &str, numbers: &'n [f64]) -> Result<&'n [f64], String> {
        self.read(key, |value| {
            let [start, length] = Object(value).pair("$", index).ok()?;
            numbers.get(start..start.checked_add(length)?)
        })
    }

    /// The points of an array `[x, y, x, y, …]` of numbers.
    fn points(&self, key: &str, numbers: &[f64]) -> Result<Vec<Point>, String> {
        let (points, rest) = self.array(key, numbers)?.as_chunks();
        if rest.is_empty() {
            Ok(points.iter().map(|&[x, y]| Point::new(x, y)).collect())
        } else {
            Err(format!("`{key}` of the request has an x without a y"))
        }
    }

    fn index(&self, key: &str) -> Result<usize, String> {
        self.read(key, index)
    }

    fn pair<T>(&self, key: &str, item: impl Fn(&Value) -> Option<T>) -> Result<[T; 2], String> {
        self.read(key, |value| match value.as_array()?.as_slice() {
            [first, second] => Some([item(first)?, item(second)?]),
            _ => None,
        })
    }

    fn list<T>(&self, key: &str, item: impl Fn(&Value) -> Result<T, String>) -> Result<Vec<T>, String> {
        self.read(key, Value::as_array)?.iter().map(item).collect()
    }
}

fn number(value: &Value) -> Option<f64> {
    match value {
        Value::String(text) => text.parse().ok(),
        value => value.as_f64(),
    }
}

fn index(value: &Value) -> Option<usize> {
    usize::try_from(value.as_u64()?).ok()
}

/// A condition on four-bars.
fn condition(text: &str) -> Result<Condition, String> {
    Condition::new(&Mechanism::template(), text).map_err(|error| format!("`{text}`: {error}"))
}

/// A name with a number, as `["p", 2.5]`.
fn named_number(value: &Value) -> Result<(String, f64), String> {
    let pair = value.as_array().map(Vec::as_slice);
    match pair {
        Some([Value::String(name), value]) => number(value).map(|value| (name.clone(), value)),
        _ => None,
    }
    .ok_or_else(|| format!("`{value}` is not a name with a number"))
}
