use super::Chosen;
use super::Points;

/// The curve's rows of `points.csv`, under its header.
pub(super) fn table(chosen: &Chosen) -> Vec<u8> {
    let points = Points::new(chosen.family);
    let mut out = points.header().into_bytes();
    points.rows(&chosen.solved, &mut out);
    out
}
