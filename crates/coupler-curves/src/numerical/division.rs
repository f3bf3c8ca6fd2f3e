//! Equal parts of a row of segments.

/// A place on a row of segments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentPlace {
    /// The index of the segment.
    pub segment: usize,
    /// The fraction of the segment, from 0 to 1.
    pub fraction: f64,
}

/// The ends of `parts` equally long parts of a row of segments with these lengths, in order: the first is the beginning of the row, the
/// last its end. None without segments or parts, or if the sum of the lengths is not finite and positive.
///
/// Lengths are at least 0. A place between two segments is on the first that is not empty, but for the beginning.
pub fn equal_parts(lengths: &[f64], parts: usize) -> Vec<SegmentPlace> {
    let total: f64 = lengths.iter().sum();
    if parts == 0 || !total.is_finite() || total <= 0.0 {
        return Vec::new();
    }
    let (mut segment, mut before) = (0, 0.0);
    let place = |k: usize| {
        let at = if k < parts { total / parts as f64 * k as f64 } else { total };
        while segment + 1 < lengths.len() && before + lengths[segment] < at {
            before += lengths[segment];
            segment += 1;
        }
        let fraction = match lengths[segment] {
            _ if k == parts => 1.0,
            0.0 => 0.0,
            length => ((at - before) / length).min(1.0),
        };
        SegmentPlace { segment, fraction }
    };
    (0..=parts).map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_row_is_divided_across_its_segments() {
        let places = equal_parts(&[0.0, 1.0, 3.0, 0.0], 4).into_iter().map(|place| (place.segment, place.fraction));
        assert_eq!(places.collect::<Vec<_>>(), [(0, 0.0), (1, 1.0), (2, 1.0 / 3.0), (2, 2.0 / 3.0), (2, 1.0)]);
        for (lengths, parts) in
            [(&[][..], 3), (&[1.0], 0), (&[0.0, 0.0], 3), (&[f64::NAN, 1.0], 3), (&[f64::INFINITY], 3)]
        {
            assert_eq!(equal_parts(lengths, parts), [], "{lengths:?} {parts}");
        }
    }

    proptest! {
        #[test]
        fn parts_are_equally_long_and_the_last_ends_at_the_end(
            lengths in prop::collection::vec(prop_oneof![Just(0.0), 1e-6..1e3f64], 1..50), parts in 1usize..200,
        ) {
            let total: f64 = lengths.iter().sum();
            prop_assume!(total > 0.0);
            let travelled = |place: &SegmentPlace| {
                lengths[..place.segment].iter().sum::<f64>() + lengths[place.segment] * place.fraction
            };
            let places: Vec<f64> = equal_parts(&lengths, parts).iter().map(travelled).collect();
            prop_assert_eq!(places.len(), parts + 1);
            for (k, place) in places.iter().enumerate() {
                prop_assert!((place - total * k as f64 / parts as f64).abs() <= 1e-12 * total);
            }
        }
    }
}
