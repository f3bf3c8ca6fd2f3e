//! Texts that are kept for the life of the program, each once.

use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

static TEXTS: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());

/// A text that is kept: for words of measures, such as names of lengths, of which there are as many as manifests have.
pub fn interned(text: &str) -> &'static str {
    // Nothing can panic between a change and its end.
    let mut texts = TEXTS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = texts.get(text) {
        return known;
    }
    let kept: &'static str = text.to_owned().leak();
    texts.insert(kept);
    kept
}

#[cfg(test)]
mod tests {
    #[test]
    fn equal_texts_are_kept_once() {
        let [first, second] = [1, 1].map(|k| super::interned(&format!("A{k}")));
        assert!(std::ptr::eq(first, second));
        assert_ne!(super::interned("BC"), first);
    }
}
