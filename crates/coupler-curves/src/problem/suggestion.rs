/// The candidate with the least edit distance from `word`, if that is at most a third of the word's length, or 1.
pub fn nearest_word<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let allowed = (word.chars().count() / 3).max(1);
    candidates
        .into_iter()
        .map(|candidate| (edit_distance(word, candidate), candidate))
        .filter(|&(distance, _)| distance <= allowed)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// The help for an unknown word: the nearest candidate, or all of them if none is near.
pub fn suggestion(word: &str, candidates: &[&str]) -> String {
    match nearest_word(word, candidates.iter().copied()) {
        Some(candidate) => format!("did you mean `{candidate}`?"),
        None if candidates.is_empty() => "none are defined".to_owned(),
        None => format!("it can be {}", alternatives(candidates)),
    }
}

fn alternatives(words: &[&str]) -> String {
    let quoted: Vec<String> = words.iter().map(|w| format!("`{w}`")).collect();
    match quoted.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => quoted.concat(),
    }
}

/// The number of letters to insert, remove, replace or swap with a neighbour to turn `a` into `b`, ignoring case
/// (optimal string alignment).
fn edit_distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.to_lowercase().chars().collect(), b.to_lowercase().chars().collect());
    let mut rows = vec![vec![0; b.len() + 1]; a.len() + 1];
    rows[0] = (0..=b.len()).collect();
    for i in 1..=a.len() {
        rows[i][0] = i;
        for j in 1..=b.len() {
            let replaced = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut best = replaced.min(rows[i - 1][j] + 1).min(rows[i][j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(rows[i - 2][j - 2] + 1);
            }
            rows[i][j] = best;
        }
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_word_has_a_suggestion_and_an_unrelated_word_has_none() {
        let keys = ["linkage", "layout", "sampling", "grid"];
        for (word, meant) in
            [("linkge", Some("linkage")), ("gird", Some("grid")), ("Grid", Some("grid")), ("xyz", None)]
        {
            assert_eq!(nearest_word(word, keys), meant, "{word}");
        }
        assert_eq!(suggestion("zzz", &["a1", "b1", "c1"]), "it can be `a1`, `b1` or `c1`");
    }
}
