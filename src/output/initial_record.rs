//! The record of a family before any of its files is written.

use crate::pipeline::FamilyPipeline;
use crate::record::FamilyRecord;

/// The record of a family before any of its files is written.
pub(super) fn initial_record(pipeline: &FamilyPipeline) -> FamilyRecord {
    let family = &pipeline.composer.planned.family;
    FamilyRecord {
        id: family.id.clone(),
        title: family.title.clone(),
        linkage: family.template.id.clone(),
        unit: family.unit.map(|unit| unit.symbol().to_owned()),
        inputs_sha256: None,
        cells: family.cell_count(),
        kept: pipeline.arrangement.kept.len(),
        unassembled_left_out: pipeline.arrangement.unassembled_left_out,
        not_assembled: 0,
        partly_assembled: 0,
        curves_left_out: 0,
        curves: 0,
        pages: pipeline.pagination.page_count,
        files: Vec::new(),
    }
}
