//! Who does the parts of a step that do not depend on each other.

/// Does what does not depend on each other: one after the other, or on the threads of a program.
pub trait Workers {
    /// How many parts are worth being done in one step.
    fn most_at_once(&self) -> usize;

    /// The results of all items, in their order. They may be left out by a program that stops the search: it takes no further step then.
    fn map<T: Send, R: Send>(&self, items: Vec<T>, work: impl Fn(T) -> R + Send + Sync) -> Vec<R>;
}

/// One part in a step.
pub struct OneAtATime;

impl Workers for OneAtATime {
    fn most_at_once(&self) -> usize {
        1
    }

    fn map<T: Send, R: Send>(&self, items: Vec<T>, work: impl Fn(T) -> R + Send + Sync) -> Vec<R> {
        items.into_iter().map(work).collect()
    }
}
