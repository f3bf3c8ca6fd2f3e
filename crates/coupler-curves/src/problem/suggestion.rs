/// The most characters of a word for which near words are searched; a longer one is a mistake of another kind.
const MAX_LENGTH: usize = 64;

/// The most candidates that are considered, and the most of similar length that are compared with a word, so that the
/// time for a problem does not grow with their number.
const MAX_CANDIDATES: usize = 1000;
const MAX_COMPARED: usize = 200;

/// The most words that a message lists.
const MAX_LISTED: usize = 40;

/// Names that textbooks, such as Norton's, have for what is called otherwise here: of several for one, the first that is possible is meant.
const OTHER_NAMES: [(&str, &str); 32] = [
    ("ground", "frame"),
    ("fixed", "frame"),
    ("base", "frame"),
    ("input", "crank"),
    ("driver", "crank"),
    ("output", "rocker"),
    ("follower", "rocker"),
    ("floating", "coupler"),
    ("connecting_rod", "coupler"),
    ("rod", "coupler"),
    ("eccentricity", "offset"),
    ("link1", "frame"),
    ("link2", "crank"),
    ("link3", "coupler"),
    ("link4", "rocker"),
    ("four_bar", "four-bar"),
    ("4bar", "four-bar"),
    ("crank-rocker", "four-bar"),
    ("crank-slider", "slider-crank"),
    ("strandbeest", "jansen"),
    ("theta2", "input_min_deg"),
    ("theta2", "input_deg"),
    ("theta4", "output_min"),
    ("theta4", "psi_deg"),
    ("transmission_angle", "mu_worst_deg"),
    ("transmission_angle", "mu_deg"),
    ("stride", "straight_length"),
    ("lift", "bbox_height"),
    ("step_height", "bbox_height"),
    ("width", "bbox_width"),
    ("height", "bbox_height"),
    ("size", "paper"),
];

/// The candidate that textbooks call `word`, or the one with the least edit distance from `word`, if that is at most a third of the word's length, or 1.
///
/// Of more than a thousand candidates, only the first are compared.
pub fn nearest_word<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = word.chars().take(MAX_LENGTH + 1).count();
    if length > MAX_LENGTH {
        return None;
    }
    let candidates = candidates.into_iter().take(MAX_CANDIDATES);
    let candidates: Vec<&str> = candidates.collect();
    // A name without its unit or its last part: `mu_min` for `mu_min_deg`.
    let is_longer = |candidate: &&str| candidate.strip_prefix(word).is_some_and(|rest| rest.starts_with('_'));
    if let Some(longer) = candidates.iter().copied().find(is_longer).filter(|_| length > 1) {
        return Some(longer);
    }
    let is_meant = |(name, own): &&(&str, &str)| name.eq_ignore_ascii_case(word) && candidates.contains(own);
    if let Some((_, own)) = OTHER_NAMES.iter().find(is_meant) {
        return Some(own);
    }
    // A single letter is as near to any other.
    if length < 2 {
        return None;
    }
    // A name with another unit or last part: `output_dwell_deg` for `output_dwell_length`.
    let stem = |word: &'a str| word.rsplit_once('_').map(|(stem, _)| stem);
    if let Some((own, _)) = word.rsplit_once('_') {
        let mut related = candidates.iter().copied().filter(|candidate| stem(candidate) == Some(own));
        if let (Some(only), None) = (related.next(), related.next()) {
            return Some(only);
        }
    }
    // A plural: `families` for `family`.
    if let Some(stem) = word.strip_suffix("ies")
        && let Some(singular) = candidates.iter().copied().find(|candidate| candidate.strip_suffix('y') == Some(stem))
    {
        return Some(singular);
    }
    let allowed = (length / 3).max(1);
    let letters = lowercase_letters(word);
    // A letter has at most four bytes.
    let may_be_near = |candidate: &&str| candidate.len() <= 4 * (length + allowed);
    let is_near_in_length = |candidate: &&str| candidate.chars().count().abs_diff(length) <= allowed;
    candidates
        .into_iter()
        .filter(may_be_near)
        .filter(is_near_in_length)
        .take(MAX_COMPARED)
        .map(|candidate| (edit_distance(&letters, &lowercase_letters(candidate)), candidate))
        .filter(|&(distance, _)| distance <= allowed)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// The help for an unknown word: the nearest candidate, or all of them if none is near.
pub fn suggestion(word: &str, candidates: &[&str]) -> String {
    suggestion_among(word, candidates.iter().copied(), candidates.len())
}

/// As [`suggestion`], without a list of the candidates; `count` is their number.
pub fn suggestion_among<'a>(word: &str, candidates: impl Iterator<Item = &'a str> + Clone, count: usize) -> String {
    match nearest_word(word, candidates.clone()) {
        Some(candidate) => format!("did you mean `{candidate}`?"),
        None if count == 0 => "none are defined".to_owned(),
        None => format!("it can be {}", alternatives(candidates, count)),
    }
}

/// Words in a list; of very many, only the first, and the number of the others.
pub fn list_words(words: &[&str]) -> String {
    let listed = &words[..words.len().min(MAX_LISTED)];
    match words.len() - listed.len() {
        0 => listed.join(", "),
        more => format!("{} and {more} more", listed.join(", ")),
    }
}

fn alternatives<'a>(words: impl Iterator<Item = &'a str>, count: usize) -> String {
    let quoted: Vec<String> = words.take(MAX_LISTED).map(|w| format!("`{w}`")).collect();
    if count > quoted.len() {
        return format!("{} or one of {} more", quoted.join(", "), count - quoted.len());
    }
    match quoted.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => quoted.concat(),
    }
}

fn lowercase_letters(word: &str) -> Vec<char> {
    word.chars().flat_map(char::to_lowercase).collect()
}

/// The number of letters to insert, remove, replace or swap with a neighbour to turn `a` into `b` (optimal string
/// alignment).
fn edit_distance(a: &[char], b: &[char]) -> usize {
    // The rows of the two prefixes of `a` before the current one, and of the current one.
    let mut before: Vec<usize> = Vec::with_capacity(b.len() + 1);
    let mut last: Vec<usize> = (0..=b.len()).collect();
    let mut row: Vec<usize> = Vec::with_capacity(b.len() + 1);
    for i in 1..=a.len() {
        row.clear();
        row.push(i);
        for j in 1..=b.len() {
            let replaced = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut best = replaced.min(last[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(before[j - 2] + 1);
            }
            row.push(best);
        }
        std::mem::swap(&mut before, &mut last);
        std::mem::swap(&mut last, &mut row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_word_has_a_suggestion_and_an_unrelated_word_has_none() {
        let keys = ["linkage", "layout", "sampling", "grid", "family"];
        for (word, meant) in [
            ("linkge", Some("linkage")),
            ("gird", Some("grid")),
            ("Grid", Some("grid")),
            ("families", Some("family")),
            ("xyz", None),
        ] {
            assert_eq!(nearest_word(word, keys), meant, "{word}");
        }
        assert_eq!(suggestion("Ground", &["crank", "frame"]), "did you mean `frame`?");
        assert_eq!(suggestion("follower", &["crank", "rocker"]), "did you mean `rocker`?");
        assert_eq!(suggestion("Theta2", &["psi_deg", "input_deg"]), "did you mean `input_deg`?");
        assert_eq!(suggestion("stride", &["length", "straight_length"]), "did you mean `straight_length`?");
        assert_eq!(suggestion("zzz", &["a1", "b1", "c1"]), "it can be `a1`, `b1` or `c1`");
    }

    #[test]
    fn long_words_and_long_lists_are_shortened() {
        let names: Vec<String> = (0..1000).map(|k| format!("name{k}")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        assert_eq!(nearest_word(&"name".repeat(1000), names.iter().copied()), None);
        assert_eq!(suggestion("nmae7", &names), "did you mean `name7`?");
        let listed = suggestion("zzz", &names);
        assert!(listed.ends_with("`name38`, `name39` or one of 960 more"), "{listed}");
        assert!(list_words(&names).ends_with("name39 and 960 more"));
    }
}
