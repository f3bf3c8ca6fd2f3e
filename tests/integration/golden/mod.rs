//! Golden pages: a page of each layout and the tables of a family, byte for byte. The plates of the catalogue, in docs/images/linkages, are compared
//! in the same way by the tests of documents, and the whole atlas by its digests in `atlas.rs`.

use crate::recorded::assert_recorded;
use crate::support::command::{folder_with, printed};
use crate::support::folder::files;

#[test]
fn every_golden_page_is_recorded() {
    let folder = folder_with(include_str!("golden.toml"));
    printed(folder.path(), &["render", "-q"]);
    let out = folder.path().join("out");
    let is_golden = |name: &String| name.ends_with(".svg") || name.starts_with("panels/") && name.ends_with(".csv");
    let golden: Vec<String> = files(&out).into_iter().filter(is_golden).collect();
    assert_eq!(golden.len(), 6, "{golden:?}");
    for name in golden {
        let file = name.rsplit('/').next().unwrap();
        assert_recorded(
            &format!("tests/integration/golden/{file}"),
            &std::fs::read_to_string(out.join(&name)).unwrap(),
        );
    }
}
