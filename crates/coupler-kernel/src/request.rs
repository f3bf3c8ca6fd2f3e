//! Requests of the page.

use serde_json::Value;

/// A request. As JSON it is an object with its name in snake case as `method`, and with its fields. Numbers may be given as
/// strings: these are read to the last bit, as numbers of JSON need not be.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// What the module was built from.
    About,
    /// Opens the family of a manifest, which has one: its handle and what the page has to know of it.
    OpenFamily {
        /// The manifest, as TOML.
        manifest: String,
    },
    /// Closes a family; its handle is not used again.
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
    /// Closes a study; its handle is not used again.
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

impl Request {
    /// Parses a request.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn parse(text: &str) -> Result<Request, String> {
        let value: Value = serde_json::from_str(text).map_err(|error| format!("the request is not JSON: {error}"))?;
        let of = Object(&value);
        Ok(match of.text("method")?.as_str() {
            "about" => Request::About,
            "open_family" => Request::OpenFamily { manifest: of.text("manifest")? },
            "close_family" => Request::CloseFamily { family: of.index("family")? },
            "open_study" => Request::OpenStudy {
                curve: CurveRequest::from_value(of.member("curve")?)?,
                shown: if of.member("shown")?.is_null() { None } else { Some(of.index("shown")?) },
                is_rough: of.member("is_rough")?.as_bool().ok_or("`is_rough` is neither true nor false")?,
            },
            "close_study" => Request::CloseStudy { study: of.index("study")? },
            "path" => Request::Path { study: of.index("study")?, tolerance: of.number("tolerance")? },
            "speeds" => Request::Speeds { study: of.index("study")?, count: of.index("count")? },
            "measures" => Request::Measures { study: of.index("study")? },
            "cognates" => Request::Cognates { study: of.index("study")? },
            "centrodes" => Request::Centrodes { study: of.index("study")?, samples: of.index("samples")? },
            "nearest" => Request::Nearest { study: of.index("study")?, point: of.pair("point", number)? },
            "reading" => {
                Request::Reading { study: of.index("study")?, pass: of.index("pass")?, input: of.number("input")? }
            }
            "export" => {
                Request::Export { curve: CurveRequest::from_value(of.member("curve")?)?, format: of.text("format")? }
            }
            "fragment" => Request::Fragment { curves: of.list("curves", CurveRequest::from_value)? },
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

    fn text(&self, key: &str) -> Result<String, String> {
        self.read(key, |value| value.as_str().map(str::to_owned))
    }

    fn number(&self, key: &str) -> Result<f64, String> {
        self.read(key, number)
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

/// A name with a number, as `["p", 2.5]`.
fn named_number(value: &Value) -> Result<(String, f64), String> {
    let pair = value.as_array().map(Vec::as_slice);
    match pair {
        Some([Value::String(name), value]) => number(value).map(|value| (name.clone(), value)),
        _ => None,
    }
    .ok_or_else(|| format!("`{value}` is not a name with a number"))
}
