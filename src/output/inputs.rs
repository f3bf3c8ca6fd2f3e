//! What files are made from, as digests. Where one is the same as in an earlier run, so is the file.

use crate::manifest::PlannedFamily;
use crate::record::RunningDigest;
use coupler_curves::solve::SolvedCell;

/// What the files of a family are made from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inputs<'a> {
    planned: &'a PlannedFamily,
    /// The program's version. Its source may differ without it: whoever changes it draws everything afresh.
    version: &'a str,
}

impl<'a> Inputs<'a> {
    pub fn new(planned: &'a PlannedFamily) -> Inputs<'a> {
        Inputs { planned, version: env!("CARGO_PKG_VERSION") }
    }

    /// The digest of all of them.
    pub fn family_digest(self) -> String {
        self.begin_digest("family", &self.planned.manifest_inputs.family).finish()
    }

    /// The digest of those of a page of charts, on which every cell may count.
    pub fn chart_page_digest(self, page: usize) -> String {
        let mut digest = self.begin_digest("charts", &self.planned.manifest_inputs.family);
        digest.update(format!("page {page}\n").as_bytes());
        digest.finish()
    }

    /// The digest of those of a page of so many, with its cells and, where not all their curves are on it, the places of
    /// those that are. All of them count in any case: what a page has in common with others of its cell is due to them.
    pub fn page_digest(self, (page, of): (usize, usize), cells: &[SolvedCell], shown: &[usize]) -> String {
        let mut digest = self.begin_digest("page", &self.planned.manifest_inputs.page);
        let mut text = format!("page {page} of {of}\n{:?}\n", self.planned.family.names);
        for solved in cells {
            text.push_str(&format!("cell {}:", solved.cell.number));
            // Every bit of a value counts.
            solved.cell.values.iter().for_each(|value| text.push_str(&format!(" {:x}", value.to_bits())));
            for curve in &solved.curves {
                text.push_str(&format!(", {} on {}", curve.trace, curve.circuit));
            }
            text.push('\n');
        }
        digest.update(format!("{text}{shown:?}").as_bytes());
        digest.finish()
    }

    /// The digest of those of a book of families, in volumes of so many pages.
    pub fn book_digest(families: &[&PlannedFamily], volume_pages: usize) -> String {
        let mut digest = RunningDigest::default();
        digest.update(format!("book in volumes of {volume_pages}\n").as_bytes());
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
    fn another_version_makes_other_files() {
        let text = "[atlas]\ntitle = \"T\"\n[[family]]\nid = \"e\"\nlinkage = \"evans\"\nsampling = { samples = 9 }\n\
                    cases = [{ p = 2, a = 2 }]";
        let plan = manifest::parse(text).plan.unwrap();
        let this = Inputs::new(&plan.families[0]);
        let next = Inputs { version: "99.0.0", ..this };
        assert_ne!(this.family_digest(), next.family_digest());
        assert_ne!(this.chart_page_digest(1), next.chart_page_digest(1));
        assert_ne!(this.page_digest((1, 1), &[], &[]), next.page_digest((1, 1), &[], &[]));
    }
}
