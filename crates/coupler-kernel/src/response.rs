//! Responses: JSON, and the numbers of its arrays.

use serde_json::{Value, json};

use coupler_curves::geometry::Point;

/// The response to a request.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Response {
    /// The response as JSON. `{"$": [start, length]}` is the array of these elements of `numbers`; a request that cannot
    /// be answered has the response `{"error": "…"}`.
    pub json: String,
    /// The numbers of its arrays, one array after another.
    pub numbers: Vec<f64>,
}

/// Collects the numbers of a response.
#[derive(Debug, Default)]
pub(crate) struct Numbers(Vec<f64>);

impl Numbers {
    /// Adds an array; its place, for the JSON.
    pub fn array(&mut self, values: impl IntoIterator<Item = f64>) -> Value {
        let start = self.0.len();
        self.0.extend(values);
        json!({ "$": [start, self.0.len() - start] })
    }

    /// Adds points as an array `[x, y, x, y, …]`; its place, for the JSON.
    pub fn points(&mut self, points: impl IntoIterator<Item = Point>) -> Value {
        self.array(points.into_iter().flat_map(|p| [p.x, p.y]))
    }

    /// The response with these numbers.
    pub fn into_response(self, value: &Value) -> Response {
        Response { json: value.to_string(), numbers: self.0 }
    }
}
