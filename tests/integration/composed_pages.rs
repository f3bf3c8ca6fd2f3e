//! Pages that are composed in memory.

use std::sync::atomic::AtomicBool;

use coupler_atlas::output::{ComposedPage, Error, cells_solved_for_page, known_page_count};
use coupler_drawing::render::PageFormat;

use crate::support::folder::Atlas;
use crate::support::plan::plan;

const MANIFEST: &str = r#"
[atlas]
title = "T"
output = "out"
formats = ["svg", "png"]
[page]
dpi = 30
[[family]]
id = "all"
linkage = "evans"
panels = [2, 1]
sampling = { samples = 12 }
grid = { p = [2, 3, 4], a = 2.6 }
[[family]]
id = "some"
linkage = "evans"
panels = [2, 1]
sampling = { samples = 12 }
grid = { p = [2, 3, 4], a = 2.6 }
where = "p != 3"
sort = "-length"
"#;

#[test]
fn they_have_the_bytes_of_their_files() {
    let (atlas, plan, stop) = (Atlas::rendered(MANIFEST, &[]), plan(MANIFEST), AtomicBool::new(false));
    for (planned, count) in plan.families.iter().zip([2, 1]) {
        for number in 1..=count {
            let page = ComposedPage::new(&plan, planned, number, &stop).unwrap();
            assert_eq!((page.number, page.count), (number, count));
            for format in PageFormat::ALL {
                let id = &planned.family.id;
                let file = atlas.out().join(format!("{id}/{id}-{number:03}.{}", format.name()));
                assert!(page.render(&plan, format).unwrap() == std::fs::read(&file).unwrap(), "{}", file.display());
            }
        }
    }
}

#[test]
fn what_there_is_and_what_it_takes_is_known() {
    let plan = plan(MANIFEST);
    assert_eq!(plan.families.iter().map(known_page_count).collect::<Vec<_>>(), [Some(2), None]);
    assert_eq!(plan.families.iter().map(cells_solved_for_page).collect::<Vec<_>>(), [2, 3]);
    for number in [0, 3] {
        let error = ComposedPage::new(&plan, &plan.families[0], number, &AtomicBool::new(false)).unwrap_err();
        assert_eq!(error.to_string(), format!("`all` has no page {number}: its pages are numbered from 1 to 2"));
    }
    let interrupted = ComposedPage::new(&plan, &plan.families[1], 1, &AtomicBool::new(true));
    assert!(matches!(interrupted, Err(Error::Interrupted)));
}
