//! The six-bar linkages whose coupler points are searched together.

use super::space::LinkageSpace;
use coupler_curves::catalogue;

/// A linkage of the catalogue, the coupler point that traces, and the dimensions of its other coupler point, which are kept.
type Traced = (&'static str, &'static str, &'static [&'static str]);

/// Every form of Watt's and Stephenson's chains, each input, and each link that does not turn about a fixed pivot: but those whose points trace what a
/// four-bar driven by the same crank does. Those that dyads place come first.
const TRACED: [Traced; 13] = [
    ("stephenson-six-bar", "M", &[]),
    ("stephenson-i-six-bar", "M", &["along_c", "across_c"]),
    ("stephenson-i-six-bar", "N", &["along", "across"]),
    ("watt-i-six-bar", "M", &["along_c", "across_c"]),
    ("watt-i-six-bar", "N", &["along", "across"]),
    ("watt-i-six-bar-by-ternary", "M", &["along_c", "across_c"]),
    ("watt-i-six-bar-by-ternary", "N", &["along", "across"]),
    ("watt-six-bar", "M", &[]),
    ("stephenson-ii-six-bar", "M", &["n_x", "n_y"]),
    ("stephenson-ii-six-bar", "N", &["m_x", "m_y"]),
    ("stephenson-ii-six-bar-by-binary", "M", &["n_x", "n_y"]),
    ("stephenson-ii-six-bar-by-binary", "N", &["m_x", "m_y"]),
    ("stephenson-iii-six-bar-by-binary", "N", &["m_x", "m_y"]),
];

/// Other linkages with fewer links, the parameters of which that are kept, each at a value.
const SIMPLER: [(&str, &[(&str, &str)]); 8] = [
    ("four-bar", &[]),
    ("slider-crank", &[]),
    ("inverted-slider-crank", &[]),
    ("geared-five-bar", &[("n", "1"), ("m", "1")]),
    ("geared-five-bar", &[("n", "-1"), ("m", "1")]),
    ("geared-five-bar", &[("n", "2"), ("m", "1")]),
    ("geared-five-bar", &[("n", "-2"), ("m", "1")]),
    ("geared-five-bar", &[("n", "-1"), ("m", "2")]),
];

/// The spaces of all six-bar linkages: those whose curves a [`super::LinkageIndex`] has.
pub fn six_bar_spaces() -> Vec<LinkageSpace> {
    let space = |(id, joint, kept): Traced| {
        let kept: Vec<(String, Option<String>)> = kept.iter().map(|name| ((*name).to_owned(), None)).collect();
        LinkageSpace::new(catalogue::find(id)?, &kept).ok()?.tracing(joint)
    };
    TRACED.into_iter().filter_map(space).collect()
}

/// The spaces of the linkages with fewer links: four-bars, slider-cranks, and geared five-bars of some ratios.
pub fn simpler_spaces() -> Vec<LinkageSpace> {
    let space = |(id, kept): (&str, &[(&str, &str)])| {
        let kept: Vec<(String, Option<String>)> =
            kept.iter().map(|(name, value)| ((*name).to_owned(), Some((*value).to_owned()))).collect();
        LinkageSpace::new(catalogue::find(id)?, &kept).ok()
    };
    SIMPLER.into_iter().filter_map(space).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_linkages_are_there_and_of_any_size() {
        let (six, simpler) = (six_bar_spaces(), simpler_spaces());
        assert_eq!((six.len(), simpler.len()), (TRACED.len(), SIMPLER.len()));
        for space in six.iter().chain(&simpler) {
            assert!(space.is_scalable(), "{}", space.template().id);
        }
    }
}
