//! Reads a table of cases as CSV: a line with the names of the columns, and a line for each case.

use std::io::{self, Read};

use csv::{ByteRecord, ReaderBuilder, Trim};

use super::case_rows::CaseRows;

/// Reads a table; what is wrong in it is reported.
///
/// # Errors
/// The system fails to read it, or it is too large.
pub(super) fn read(source: impl Read, rows: &mut CaseRows) -> io::Result<()> {
    rows.with_lines();
    // The last line has an end as well, so that each record ends before the line that the reader is in.
    let text = LineFeeds(source).chain(&b"\n"[..]);
    let mut reader = ReaderBuilder::new().has_headers(false).flexible(true).trim(Trim::All).from_reader(text);
    let mut record = ByteRecord::new();
    if !reader.read_byte_record(&mut record).map_err(into_io)? {
        rows.problem(
            "",
            "it is empty",
            "write the names of parameters in its first line, and a case in each line below",
        );
        return Ok(());
    }
    let line_of = |reader: &csv::Reader<_>, record: &ByteRecord| {
        let breaks = record.as_slice().iter().filter(|byte| **byte == b'\n').count();
        usize::try_from(reader.position().line()).unwrap_or(usize::MAX).saturating_sub(breaks + 1)
    };
    let line = line_of(&reader, &record);
    let names: Vec<Option<&str>> = record.iter().map(|field| std::str::from_utf8(field).ok()).collect();
    let Some(names) = names.into_iter().collect::<Option<Vec<&str>>>() else {
        report_no_text(rows, line);
        return Ok(());
    };
    if let [only] = names[..]
        && only.contains([';', '\t'])
    {
        let help = "separate columns by commas, and write numbers with points: 2.5";
        rows.problem(&format!("line {line}"), "its columns are not separated by commas", help);
        return Ok(());
    }
    rows.set_names(names.into_iter().map(str::to_owned).collect());
    let mut values = vec![f64::NAN; rows.width()];
    while reader.read_byte_record(&mut record).map_err(into_io)? {
        if !rows.is_next_kept() {
            rows.skip(1);
            continue;
        }
        let line = line_of(&reader, &record);
        values.fill(f64::NAN);
        if record.len() == values.len() {
            let mut is_text = true;
            for (column, (value, field)) in values.iter_mut().zip(&record).enumerate() {
                match std::str::from_utf8(field) {
                    Ok(text) => match text.parse().ok().filter(|number: &f64| number.is_finite()) {
                        Some(number) => *value = number,
                        None => rows.report_value((line, column), text),
                    },
                    Err(_) => is_text = false,
                }
            }
            if !is_text {
                report_no_text(rows, line);
            }
        } else {
            let message = format!("expected {} values, one for each column, found {}", values.len(), record.len());
            rows.problem(
                &format!("line {line}"),
                &message,
                "separate values by commas, and write numbers with points: 2.5",
            );
        }
        rows.push(&values, line)?;
    }
    Ok(())
}

/// The error of the file, if it was one; of what is in it the reader refuses nothing.
fn into_io(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        kind => io::Error::other(format!("{kind:?}")),
    }
}

/// Reports a line that is not UTF-8.
fn report_no_text(rows: &mut CaseRows, line: usize) {
    rows.problem(&format!("line {line}"), "it is not UTF-8", "save the file as UTF-8");
}

/// A text without carriage returns: lines are counted by their line feeds.
struct LineFeeds<R>(R);

impl<R: Read> Read for LineFeeds<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            let read = self.0.read(buffer)?;
            let mut kept = 0;
            for k in 0..read {
                if buffer[k] != b'\r' {
                    buffer[kept] = buffer[k];
                    kept += 1;
                }
            }
            if kept > 0 || read == 0 {
                return Ok(kept);
            }
        }
    }
}
