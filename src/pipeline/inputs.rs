//! Digests of what files are made from: a file is up to date if its digest is that of the earlier run.

use crate::manifest::{Plan, PlannedFamily};
use crate::record::{Digest, RunningDigest};
use coupler_curves::solve::SolvedCell;

/// What the files of a family are made from.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    planned: &'a PlannedFamily,
    /// The program's version. A developer who changes the source under the same version has to render with `--force`.
    version: &'a str,
}

impl<'a> Inputs<'a> {
    /// The inputs of a family for this version of the program.
    pub fn new(planned: &'a PlannedFamily) -> Inputs<'a> {
        Inputs { planned, version: env!("CARGO_PKG_VERSION") }
    }

    /// The digest of what all files of the family are made from.
    pub fn family_digest(self) -> Digest {
        self.begin_digest("family", &self.planned.manifest_inputs.family_text()).finish()
    }

    /// The digest of what a page of charts is made from; every cell of the family may be on it.
    pub fn chart_page_digest(self, page: usize) -> Digest {
        let mut digest = self.begin_digest("charts", &self.planned.manifest_inputs.family_text());
        digest.update(format!("page {page}\n").as_bytes());
        digest.finish()
    }

    /// The digest of what a page is made from: its number, the number of pages, what it says of all cells of the family,
    /// and its own cells. `shown` has the indices of the curves on the page if it does not show all of them. All curves
    /// of a cell are in the digest in any case, since all pages of the cell share what is derived from them.
    pub fn page_digest(
        self,
        (page, page_count): (usize, usize),
        common_text: &str,
        cells: &[SolvedCell],
        shown: &[usize],
    ) -> Digest {
        let mut digest = self.begin_digest("page", &self.planned.manifest_inputs.page_text());
        let mut text = format!("page {page} of {page_count}\n{:?}\n{common_text}\n", self.planned.family.names);
        for solved in cells {
            text.push_str(&format!("cell {}:", solved.cell.number));
            // Every bit of a value matters.
            solved.cell.values.iter().for_each(|value| text.push_str(&format!(" {:x}", value.to_bits())));
            for curve in &solved.curves {
                text.push_str(&format!(", {} on {}", curve.trace, curve.circuit));
            }
            text.push('\n');
        }
        digest.update(format!("{text}{shown:?}").as_bytes());
        digest.finish()
    }

    /// The digest of what a book is made from: its families, the most pages of a volume, and the table `[book]`.
    pub fn of_book(plan: &Plan, families: &[&PlannedFamily]) -> Digest {
        let (volume_pages, book) = (plan.volume_pages, &plan.book.manifest_inputs);
        let mut digest = RunningDigest::default();
        digest.update(format!("book in volumes of {volume_pages}\n{book}\n").as_bytes());
        families
            .iter()
            .for_each(|planned| digest.update(format!("{}\n", Inputs::new(planned).family_digest()).as_bytes()));
        digest.finish()
    }

    fn begin_digest(self, kind: &str, manifest: &str) -> RunningDigest {
        let mut digest = RunningDigest::default();
        digest.update(format!("{} {}\n{kind}\n{manifest}\n", env!("CARGO_PKG_NAME"), self.version).as_bytes());
        digest
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::manifest;

    #[test]
    fn digests_depend_on_the_version() {
        let text = "[atlas]\ntitle = \"T\"\n[[family]]\nid = \"e\"\nlinkage = \"evans\"\nsampling = { samples = 9 }\n\
                    cases = [{ p = 2, a = 2 }]";
        let plan = manifest::parse(text).plan.unwrap();
        let current = Inputs::new(&plan.families[0]);
        let next = Inputs { version: "99.0.0", ..current };
        assert_ne!(current.family_digest(), next.family_digest());
        assert_ne!(current.chart_page_digest(1), next.chart_page_digest(1));
        assert_ne!(current.page_digest((1, 1), "", &[], &[]), next.page_digest((1, 1), "", &[], &[]));
    }
}
