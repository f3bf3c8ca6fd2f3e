use super::PointTable;
use super::SelectedCurve;

/// The curve's rows of `points.csv`, with the header.
pub(super) fn document(selected: &SelectedCurve) -> Vec<u8> {
    let points = PointTable::new(selected.family);
    let mut out = points.header().into_bytes();
    points.append_rows(&selected.solved, &mut out);
    out
}
