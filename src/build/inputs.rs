//! What files are made from, as digests. Where one is the same as in an earlier run, so is the file.

use crate::manifest::PlannedFamily;
use crate::record::RunningDigest;
use coupler_curves::solve::Solved;

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
    pub fn of_family(self) -> String {
        self.digest("family", &self.planned.inputs.family).finish()
    }

    /// The digest of those of a page of charts, on which every cell may count.
    pub fn of_charts(self, page: usize) -> String {
        let mut digest = self.digest("charts", &self.planned.inputs.family);
        digest.add(format!("page {page}\n").as_bytes());
        digest.finish()
    }

    /// The digest of those of a page of so many, with its cells and, where not all their curves are on it, the places of
    /// those that are. All of them count in any case: what a page has in common with others of its cell is due to them.
    pub fn of_page(self, (page, of): (usize, usize), cells: &[Solved], shown: &[usize]) -> String {
        let mut digest = self.digest("page", &self.planned.inputs.page);
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
        digest.add(format!("{text}{shown:?}").as_bytes());
        digest.finish()
    }

    /// The digest of those of a book of families, in volumes of so many pages.
    pub fn of_book(families: &[&PlannedFamily], volume_pages: usize) -> String {
        let mut digest = RunningDigest::default();
        digest.add(format!("book in volumes of {volume_pages}\n").as_bytes());
        families.iter().for_each(|planned| digest.add(format!("{}\n", Inputs::new(planned).of_family()).as_bytes()));
        digest.finish()
    }

    fn digest(self, kind: &str, manifest: &str) -> RunningDigest {
        let mut digest = RunningDigest::default();
        digest.add(format!("{} {}\n{kind}\n{manifest}\n", env!("CARGO_PKG_NAME"), self.version).as_bytes());
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
        let plan = manifest::load(text).plan.unwrap();
        let this = Inputs::new(&plan.families[0]);
        let next = Inputs { version: "99.0.0", ..this };
        assert_ne!(this.of_family(), next.of_family());
        assert_ne!(this.of_charts(1), next.of_charts(1));
        assert_ne!(this.of_page((1, 1), &[], &[]), next.of_page((1, 1), &[], &[]));
    }
}
