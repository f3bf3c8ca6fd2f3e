//! Answers in JSON, as a manifest and in words.

pub(crate) mod manifest;
mod record;
mod significant;

pub use manifest::{answer_families, answers_manifest, manifest_head, title_for};
pub use record::{AnswerRecord, FitRecord};
pub use significant::{format_drawn_length, format_length, format_relative};
