//! The parts of a table: what is between blank lines, or below a line of names.

use super::columns::Header;
use super::dialect::Dialect;
use super::line::{self, Divider, Line};
use super::name::ColumnName;
use super::number::{is_missing, parse_number};

/// A line of a table and its cells.
#[derive(Clone, Debug)]
pub(super) struct Row<'a> {
    pub line: Line<'a>,
    pub cells: Vec<String>,
}

/// Rows below one line of names, without a blank line between them.
#[derive(Debug)]
pub(super) struct Block<'a> {
    pub header: Option<Header>,
    pub rows: Vec<Row<'a>>,
}

/// The blocks of a table, and the lines before them that are neither names nor points.
pub(super) struct Blocks<'a> {
    pub blocks: Vec<Block<'a>>,
    pub others: Vec<Row<'a>>,
}

impl<'a> Blocks<'a> {
    pub fn of(lines: &[Line<'a>], dialect: Dialect) -> Blocks<'a> {
        let mut reader = BlockReader { dialect, done: Vec::new(), header: None, rows: Vec::new(), others: Vec::new() };
        for (k, line) in lines.iter().enumerate() {
            let next = lines[k + 1..].iter().find(|line| !line.is_comment);
            reader.read(*line, next);
        }
        reader.end_block();
        let BlockReader { mut done, others, .. } = reader;
        // Lines of which each is followed by a blank one.
        if done.len() > 2 && done.iter().all(|block| block.rows.len() == 1) {
            let header = done[0].header.take();
            done = vec![Block { header, rows: done.into_iter().flat_map(|block| block.rows).collect() }];
        }
        Blocks { blocks: done, others }
    }
}

struct BlockReader<'a> {
    dialect: Dialect,
    done: Vec<Block<'a>>,
    header: Option<Header>,
    rows: Vec<Row<'a>>,
    /// Lines since the last block or names that are neither.
    others: Vec<Row<'a>>,
}

impl<'a> BlockReader<'a> {
    fn read(&mut self, line: Line<'a>, next: Option<&Line<'a>>) {
        let cells = line::cells(line.text, self.dialect.divider);
        if line.is_comment {
            self.read_comment(line, next);
            return;
        }
        let numbers = self.numbers(&cells);
        if numbers == 0
            && let Some(header) = Header::parse(&cells)
        {
            self.begin(header);
            return;
        }
        let is_text = numbers == 0 && cells.iter().all(|cell| ColumnName::is_name(cell));
        let divider = self.dialect.divider;
        let is_title = || next.is_some_and(|next| Header::parse(&line::cells(next.text, divider)).is_some());
        if self.rows.is_empty() {
            if self.others.is_empty() && is_text && self.header.as_mut().is_some_and(|header| header.take_units(&cells))
            {
                return;
            }
            if numbers < 2 && (self.header.is_none() || is_title()) {
                self.others.push(Row { line, cells });
                return;
            }
        } else if is_text && is_title() {
            self.others.push(Row { line, cells });
            return;
        } else if line.follows_blank {
            self.end_block();
        }
        self.rows.push(Row { line, cells });
    }

    /// Takes names from a comment that has one for each cell of the next line.
    fn read_comment(&mut self, line: Line<'a>, next: Option<&Line<'a>>) {
        let Some(next) = next.filter(|next| self.rows.is_empty() || next.follows_blank) else { return };
        let next = line::cells(next.text, self.dialect.divider);
        let by = |divider| Some(line::cells(line.text, divider)).filter(|cells| cells.len() == next.len());
        let names = by(self.dialect.divider).or_else(|| by(Divider::Blanks)).or_else(|| by(Divider::Char(',')));
        if self.numbers(&next) >= 2
            && let Some(header) = names.and_then(|names| Header::parse(&names))
        {
            self.begin(header);
        }
    }

    /// Begins a block below a line of names, which has the line before it as titles; other lines before the first one are not needed.
    fn begin(&mut self, mut header: Header) {
        self.end_block();
        if let Some(title) = self.others.pop().filter(|title| self.numbers(&title.cells) == 0) {
            header.take_titles(&title.cells);
        }
        self.others.clear();
        self.header = Some(header);
    }

    fn end_block(&mut self) {
        if !self.rows.is_empty() {
            self.done.push(Block { header: self.header.clone(), rows: std::mem::take(&mut self.rows) });
        }
    }

    fn numbers(&self, cells: &[String]) -> usize {
        let is_number = |cell: &&String| !is_missing(cell) && parse_number(cell, self.dialect.style).is_some();
        cells.iter().filter(is_number).count()
    }
}
