use super::PointTable;
use super::SelectedCurve;

/// The curve's rows of `points.csv`, under its header.
pub(super) fn document(chosen: &SelectedCurve) -> Vec<u8> {
    let points = PointTable::new(chosen.family);
    let mut out = points.header().into_bytes();
    points.append_rows(&chosen.solved, &mut out);
    out
}
