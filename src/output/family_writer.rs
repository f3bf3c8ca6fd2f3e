//! Writes the tables and pages of a family in order, and continues where an earlier run was killed.

use std::io::Read;
use std::path::Path;

use rayon::prelude::*;
use serde_json::Value;

use super::initial_record::initial_record;
use super::journal::JournalFile;
use super::pages::{OutputSink, PageFiles, TableRows};
use super::survey::FamilySurvey;
use super::table_file::TableFile;
use super::{Error, Event};
use crate::gallery::{CellData, DataFile, PieceContent, PieceWriter};
use crate::pipeline::{FamilyPipeline, GroupsDone, Output, page_file_name};
use crate::record::{Digest, FamilyProgress, FamilyRecord, FileRecord, JournalEntry, read_unassembled_cells};

/// What is to be written.
#[derive(Clone, Copy)]
pub(super) struct FamilyTask<'a> {
    pub pipeline: &'a FamilyPipeline<'a>,
    pub sink: OutputSink<'a>,
    /// The folder of the family.
    pub folder: &'a Path,
    pub journal: &'a JournalFile,
    /// The digest of what the files are made from.
    pub inputs_sha256: Digest,
}

/// Writes the files of a family.
pub(super) struct FamilyWriter<'a> {
    task: FamilyTask<'a>,
    tables: Tables<'a>,
    /// What an earlier run has finished.
    done: GroupsDone,
    record: FamilyRecord,
    /// The number of pages drawn.
    drawn_pages: usize,
    /// What the book needs to know of the cells.
    survey: FamilySurvey,
}

/// The written family: its record, the number of pages drawn, and what the book needs to know of its cells.
pub(super) type WrittenFamily = (FamilyRecord, usize, FamilySurvey);

/// The tables and the gallery's data of a family while they are written.
struct Tables<'a> {
    cells: TableFile,
    points: TableFile,
    pieces: PieceWriter<'a>,
    /// The statements of the open pieces, in the order of [`PieceSeries::ALL`], for a run that continues this one.
    open_pieces: [TableFile; 2],
}

/// The names of the files with the statements of open pieces, which are never finished under these names.
const OPEN_PIECE_NAMES: [&str; 2] = ["gallery-table.js", "gallery-curves.js"];

impl<'a> FamilyWriter<'a> {
    /// Starts the tables of a family.
    pub fn start(task: FamilyTask<'a>) -> Result<FamilyWriter<'a>, Error> {
        let (points, cells) = task.sink.tables;
        let create = |name: &str, header: &str| TableFile::with_header(task.folder.join(name), header);
        let [table, curves] = OPEN_PIECE_NAMES.map(|name| create(name, ""));
        let tables = Tables {
            cells: create("cells.csv", &cells.header())?,
            points: create("points.csv", &points.header())?,
            pieces: PieceWriter::new(task.sink.script),
            open_pieces: [table?, curves?],
        };
        let record = initial_record(task.pipeline);
        Ok(FamilyWriter {
            task,
            tables,
            done: GroupsDone::default(),
            record,
            drawn_pages: 0,
            survey: FamilySurvey::default(),
        })
    }

    /// Continues the tables of a family, and reports what has been done; `None` if they, or the pages of the cells in
    /// them, are not as the earlier run has left them.
    pub fn resume(
        task: FamilyTask<'a>,
        (progress, finished): (&FamilyProgress, &[Value]),
        report: &mut dyn FnMut(Event),
    ) -> Option<FamilyWriter<'a>> {
        if progress.inputs_sha256 != task.inputs_sha256 {
            return None;
        }
        let done = GroupsDone { groups: progress.groups, sorted_groups: progress.sorted_groups };
        let pages = finished_pages(&task, done)?;
        let [cells, points, table, curves] = progress.tables.as_slice() else { return None };
        let resume = |name: &str, table| TableFile::resume(task.folder.join(name), table);
        let finished = finished.get(..progress.pieces)?.to_vec();
        let mut pieces = PieceWriter::new(task.sink.script);
        pieces.finished = serde_json::from_value(Value::Array(finished)).ok()?;
        let contents: [PieceContent; 2] = serde_json::from_value(progress.open_pieces.clone()).ok()?;
        let open_pieces = [resume(OPEN_PIECE_NAMES[0], table)?, resume(OPEN_PIECE_NAMES[1], curves)?];
        for ((piece, content), file) in pieces.open.iter_mut().zip(contents).zip(&open_pieces) {
            file.reader()?.read_to_string(&mut piece.statements).ok()?;
            piece.content = content;
        }
        let mut record = initial_record(task.pipeline);
        for name in pieces.finished_names() {
            record.files.push(task.sink.registry.reuse_if(&name, |_| true)?);
        }
        let tables =
            Tables { cells: resume("cells.csv", cells)?, points: resume("points.csv", points)?, pieces, open_pieces };
        record.curves = progress.curves;
        record.curves_left_out = progress.curves_left_out;
        record.not_assembled = progress.not_assembled;
        record.partly_assembled = progress.partly_assembled;
        if record.not_assembled > 0 {
            for (cell, reason) in read_unassembled_cells(tables.cells.reader()?) {
                report(Event::Shortfall { family: &record.id, cell, reason: &reason });
            }
        }
        for page in pages {
            record.files.extend(page);
            report(Event::Page);
        }
        Some(FamilyWriter { task, tables, done, record, drawn_pages: 0, survey: FamilySurvey::default() })
    }

    /// Writes the tables, the script and the pages. The survey is of the cells that no earlier run has finished.
    pub fn write_all(mut self, report: &mut dyn FnMut(Event)) -> Result<WrittenFamily, Error> {
        let FamilyTask { pipeline, sink, .. } = self.task;
        let result = pipeline.run(&sink, self.done, |output| match output {
            Output::Cells(mut rows) => {
                self.survey.add(std::mem::take(&mut rows.surveyed), &sink.composer.plan.book);
                self.add_rows(&rows, report)
            }
            Output::Page(page) => self.add_page(page, report),
            Output::Done(done) => self.record_progress(done),
        });
        let Tables { cells, points, pieces, open_pieces } = self.tables;
        match result {
            Ok(()) => {}
            Err(Error::Interrupted) => {
                // The next run continues from here.
                open_pieces.into_iter().chain([cells, points]).for_each(TableFile::keep);
                return Err(Error::Interrupted);
            }
            Err(error) => return Err(error),
        }
        for file in pieces.finish() {
            self.record.files.push(write_data(&sink, &file)?);
        }
        let tables = [cells, points].map(|table| sink.registry.commit_file(table));
        self.record.files.extend(tables.into_iter().collect::<Result<Vec<FileRecord>, Error>>()?);
        Ok((self.record, self.drawn_pages, self.survey))
    }

    /// Appends the rows of some cells, adds their counts to the record, and reports those that could not be assembled.
    fn add_rows(&mut self, rows: &TableRows, report: &mut dyn FnMut(Event)) -> Result<(), Error> {
        self.tables.points.append(&rows.points)?;
        self.tables.cells.append(&rows.cells)?;
        let CellData { table, curves, .. } = &rows.gallery_data;
        let full = self.tables.pieces.add_cells(&rows.gallery_data);
        self.finish_pieces(full)?;
        let [open_table, open_curves] = &mut self.tables.open_pieces;
        open_table.append(table.as_bytes())?;
        open_curves.append(curves.as_bytes())?;
        self.record.curves += rows.curve_count;
        self.record.curves_left_out += rows.curves_left_out;
        self.record.not_assembled += rows.shortfalls.len();
        self.record.partly_assembled += rows.partly_assembled;
        for (cell, reason) in &rows.shortfalls {
            report(Event::Shortfall { family: &self.record.id, cell: *cell, reason });
        }
        Ok(())
    }

    /// Adds a page to the record.
    fn add_page(&mut self, page: PageFiles, report: &mut dyn FnMut(Event)) -> Result<(), Error> {
        let full = self.tables.pieces.add_page(&page.gallery_data);
        self.finish_pieces(full)?;
        self.tables.open_pieces[1].append(page.gallery_data.as_bytes())?;
        self.record.files.extend(page.files);
        self.drawn_pages += usize::from(page.is_drawn);
        report(Event::Page);
        Ok(())
    }

    /// Writes the pieces of the gallery's data that are full, and empties the files with their statements.
    fn finish_pieces(&mut self, full: impl IntoIterator<Item = DataFile>) -> Result<(), Error> {
        let Tables { pieces, open_pieces, .. } = &mut self.tables;
        let full: Vec<DataFile> = full.into_iter().collect();
        let first = pieces.finished.len() - full.len();
        for (file, (number, index)) in full.iter().zip(pieces.finished.iter().enumerate().skip(first)) {
            self.record.files.push(write_data(&self.task.sink, file)?);
            // An index entry is made of texts and numbers, which can always be written as JSON.
            let entry = serde_json::to_value(index).unwrap_or_default();
            let family = self.record.id.clone();
            self.task.journal.append(&JournalEntry::Piece { family, number, index: entry })?;
            let open = index.series as usize;
            open_pieces[open] = TableFile::with_header(self.task.folder.join(OPEN_PIECE_NAMES[open]), "")?;
        }
        Ok(())
    }

    /// Records how far the tables have been written.
    fn record_progress(&mut self, done: GroupsDone) -> Result<(), Error> {
        let Tables { cells, points, pieces, open_pieces: [open_table, open_curves] } = &mut self.tables;
        let tables = vec![cells.flush()?, points.flush()?, open_table.flush()?, open_curves.flush()?];
        let contents: Vec<&PieceContent> = pieces.open.iter().map(|piece| &piece.content).collect();
        self.task.journal.append(&JournalEntry::Progress(FamilyProgress {
            family: self.record.id.clone(),
            inputs_sha256: self.task.inputs_sha256,
            groups: done.groups,
            sorted_groups: done.sorted_groups,
            curves: self.record.curves,
            curves_left_out: self.record.curves_left_out,
            not_assembled: self.record.not_assembled,
            partly_assembled: self.record.partly_assembled,
            tables,
            pieces: pieces.finished.len(),
            open_pieces: serde_json::to_value(contents).unwrap_or_default(),
        }))
    }
}

/// Writes a file with data for the gallery.
fn write_data(sink: &OutputSink, file: &DataFile) -> Result<FileRecord, Error> {
    let bytes = file.text.as_bytes();
    sink.registry.write_file(FileRecord::from_bytes(file.name.clone(), bytes), bytes)
}

/// The records of the files of each page that an earlier run has finished; `None` if any of them is not intact.
fn finished_pages(task: &FamilyTask, done: GroupsDone) -> Option<Vec<Vec<FileRecord>>> {
    let FamilyPipeline { composer, pagination, arrangement } = task.pipeline;
    let family = &composer.planned.family;
    let groups = if family.sort.is_some() { done.sorted_groups } else { done.groups };
    let cells = (groups * pagination.group_size).min(arrangement.kept.len());
    let is_complete = done.groups * pagination.group_size >= arrangement.kept.len();
    if done.sorted_groups > 0 && !is_complete {
        return None;
    }
    let pages = if cells == arrangement.kept.len() { pagination.page_count } else { pagination.first_page(cells) - 1 };
    let record = |page: usize| -> Option<Vec<FileRecord>> {
        let name = |format| page_file_name(&family.id, page, pagination.page_count, format);
        let is_finished = |record: &FileRecord| record.inputs_sha256.is_some();
        task.sink.formats.iter().map(|&format| task.sink.registry.reuse_if(&name(format), is_finished)).collect()
    };
    (1..=pages).into_par_iter().map(record).collect()
}
