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
    use super::super::sampled_space::SampledSpace;
    use super::*;

    #[test]
    fn all_linkages_are_there_and_of_any_size() {
        let (six, simpler) = (six_bar_spaces(), simpler_spaces());
        assert_eq!((six.len(), simpler.len()), (TRACED.len(), SIMPLER.len()));
        for space in six.iter().chain(&simpler) {
            assert!(space.is_scalable(), "{}", space.template().id);
        }
    }

    /// Newton's method, which is not proven to stay on a circuit, against circuits that are.
    #[test]
    #[ignore = "thorough"]
    fn turns_of_groups_are_those_that_are_proven() {
        const SAMPLES: usize = 400;
        /// What poses between the nodes of a turn may be off by, in the longest length: 9e-7 was found.
        const INTERPOLATED: f64 = 2e-6;
        for space in six_bar_spaces().iter().filter(|space| space.is_group()) {
            let sampled = SampledSpace::new(space, true);
            let [mut both, mut missed] = [0, 0];
            for values in (0..SAMPLES).filter_map(|sample| space.sample(sample)) {
                let proven = sampled.traced(&values).into_iter().next().map(|on| on.traced);
                let found = sampled.curves(&values).into_iter().next().map(|(on, _)| on.traced);
                let id = &space.template().id;
                match (proven, found) {
                    (Some(proven), Some(found)) => {
                        both += 1;
                        let positions: Vec<f64> = (0..50).map(|k| f64::from(k) / 50.0).collect();
                        let [own, other] = [proven, found].map(|traced| traced.points(&positions));
                        let pairs = own.iter().flatten().zip(other.iter().flatten());
                        let apart = pairs.map(|(a, b)| (a - b).norm_sqr().sqrt()).fold(0.0, f64::max);
                        let longest = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
                        assert!(apart < INTERPOLATED * longest, "{id} {values:?}: {apart}");
                    }
                    (Some(_), None) => missed += 1,
                    (None, Some(_)) => panic!("{id} {values:?} does not turn"),
                    (None, None) => {}
                }
            }
            assert!(both >= 10 && missed <= both / 20, "{}: {both} found, {missed} missed", space.template().id);
        }
    }
}
