use super::PointTable;
use super::SelectedCurve;

/// The curve's rows of `points.csv`, with the header, and a last column that says whether the curve is closed: 1 or 0.
pub(super) fn document(selected: &SelectedCurve) -> Vec<u8> {
    let points = PointTable::new(selected.family);
    let mut rows = Vec::new();
    points.append_rows(&selected.solved, &mut rows);
    let mut out = points.header().trim_end().as_bytes().to_vec();
    out.extend_from_slice(b",closed\n");
    let end: &[u8] = if selected.circuit().is_closed { b",1\n" } else { b",0\n" };
    for row in rows.split(|byte| *byte == b'\n').filter(|row| !row.is_empty()) {
        out.extend_from_slice(row);
        out.extend_from_slice(end);
    }
    out
}
