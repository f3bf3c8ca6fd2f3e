//! The names that expressions may use.

use std::collections::HashMap;

use super::kind::Kind;
use crate::problem::{list_words, nearest_word, suggestion_among};

/// Names with their kinds and indices, found by a hash rather than one by one.
#[derive(Clone, Debug, Default)]
pub struct Scope<'a> {
    names: Vec<(&'a str, Kind)>,
    indices: HashMap<&'a str, usize>,
    /// How many of the first names a message lists, and what it says of the others; of all scopes without one all names are listed.
    others: Option<(usize, &'static str)>,
}

impl<'a> Scope<'a> {
    /// The names that are numbers.
    pub fn from_numbers(names: impl IntoIterator<Item = &'a str>) -> Scope<'a> {
        names.into_iter().map(|name| (name, Kind::Number)).collect()
    }

    /// The same, where messages list only so many of the first names, and describe the others in these words.
    pub fn with_others_described(self, listed: usize, others: &'static str) -> Scope<'a> {
        Scope { others: Some((listed, others)), ..self }
    }

    /// The help for an unknown name: the nearest of the names, or else what it can be.
    pub fn suggestion(&self, name: &str) -> String {
        match self.others.filter(|_| nearest_word(name, self.names()).is_none()) {
            None => suggestion_among(name, self.names(), self.len()),
            Some((0, others)) => format!("it can be {others}"),
            Some((listed, others)) => {
                let own: Vec<&str> = self.names().take(listed).collect();
                format!("it can be one of {}, or {others}", list_words(&own))
            }
        }
    }

    /// The number of names.
    pub fn len(&self) -> usize {
        self.names.len()
    }

    /// Whether there are no names.
    pub fn is_empty(&self) -> bool {
        self.names.is_empty()
    }

    /// The index of a name; the first, if several have it.
    pub fn index_of(&self, name: &str) -> Option<usize> {
        self.indices.get(name).copied()
    }

    /// The kind of a name.
    pub fn kind_of(&self, name: &str) -> Option<Kind> {
        self.index_of(name).map(|index| self.names[index].1)
    }

    /// The names, in the order of their indices.
    pub fn names(&self) -> impl Iterator<Item = &'a str> + Clone {
        self.names.iter().map(|(name, _)| *name)
    }
}

impl<'a> Extend<(&'a str, Kind)> for Scope<'a> {
    fn extend<T: IntoIterator<Item = (&'a str, Kind)>>(&mut self, names: T) {
        for (name, kind) in names {
            self.indices.entry(name).or_insert(self.names.len());
            self.names.push((name, kind));
        }
    }
}

impl<'a> FromIterator<(&'a str, Kind)> for Scope<'a> {
    fn from_iter<T: IntoIterator<Item = (&'a str, Kind)>>(names: T) -> Scope<'a> {
        let mut scope = Scope::default();
        scope.extend(names);
        scope
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_several_equal_names_is_found() {
        let scope: Scope = [("a", Kind::Number), ("b", Kind::Boolean), ("a", Kind::Boolean)].into_iter().collect();
        assert_eq!((scope.index_of("a"), scope.kind_of("a"), scope.len()), (Some(0), Some(Kind::Number), 3));
        assert_eq!((scope.index_of("b"), scope.index_of("c")), (Some(1), None));
    }

    #[test]
    fn the_names_that_are_listed_elsewhere_are_described() {
        let scope = Scope::from_numbers(["frame", "crank", "area"]).with_others_described(2, "a measure");
        assert_eq!(scope.suggestion("xyz"), "it can be one of frame, crank, or a measure");
        assert_eq!(scope.suggestion("aera"), "did you mean `area`?");
        assert_eq!(
            Scope::from_numbers(["a"]).with_others_described(0, "a measure").suggestion("b"),
            "it can be a measure"
        );
    }
}
