//! How charts, lists and index of a book refer to plates, and what they call curves and linkages.

use std::collections::BTreeMap;

use super::reader::Pdf;
use crate::support::folder::Atlas;

/// The words on the pages under each title of the outline, without spaces, of the book of a family.
fn words(book: &str, family: &str) -> BTreeMap<String, String> {
    let atlas = Atlas::rendered(
        &format!(
            "[atlas]\ntitle = \"T\"\noutput = \"out\"\nformats = [\"pdf\"]\n[page]\npaper = \"a5\"\n{book}\n[[family]]\nid = \"f\"\n\
             title = \"Family\"\nsampling = {{ samples = 24 }}\n{family}"
        ),
        &[],
    );
    let pdf = Pdf::read(&std::fs::read(atlas.out().join("atlas.pdf")).unwrap());
    let mut starts: Vec<(usize, String)> = pdf.outline().into_iter().map(|(_, title, page)| (page, title)).collect();
    starts.sort();
    let said = |page: usize| -> String { pdf.contents(page).texts.into_iter().map(|(words, ..)| words).collect() };
    let ends: Vec<usize> = starts.iter().map(|(page, _)| *page).chain([pdf.pages().len()]).collect();
    let of_title = |(page, title): &(usize, String)| {
        let end = ends.iter().copied().find(|end| end > page).unwrap_or(*page);
        (title.clone(), (*page..end).map(said).collect::<String>().replace([' ', '\u{2003}'], ""))
    };
    starts.iter().map(of_title).collect()
}

const CRANKS: &str = "linkage = \"slider-crank\"\npanels = [2, 1]\ngrid = { coupler = [2, 3, 4], offset = [0.1, 0.6], across = [0, 1] }\n";

#[test]
fn charts_lists_and_index_say_the_figure_and_call_curves_as_plates_do() {
    let parts = words(
        "[book]\nfinding_charts = true\n[[book.list]]\ntitle = \"Long\"\nsort = \"-length\"\n[[book.list]]\ntitle = \"Table\"\n\
         sort = \"-length\"\ncolumns = [\"length: {length:.2}\"]\n",
        CRANKS,
    );
    // The cells are numbered in the order of the grid, two on a page.
    let chart = &parts["across = 1"];
    assert!(chart.contains("page1,figure2") && chart.contains("page6,figure12"), "{chart}");
    assert!(chart.contains("Belowthemthepageandthefigure."), "{chart}");
    for (part, said) in
        [("Long", "page6,figure12"), ("Table", "pathofM,figure12"), ("Index of geometries", "pathofM,figure12")]
    {
        assert!(parts[part].contains(said), "{part}: {}", parts[part]);
    }
    assert!(parts.values().all(|said| !said.contains("curve1") && !said.contains("curve2")), "{parts:?}");
    // The path of the slider is straight by construction.
    assert!(!parts["Index of geometries"].contains("50.0%"), "{}", parts["Index of geometries"]);
}

#[test]
fn linkages_are_listed_once_where_their_points_do_not_matter_and_outputs_have_units() {
    let list = |sort: &str| {
        format!("[book]\nindex = true\n[[book.list]]\ntitle = \"Own\"\nsort = \"{sort}\"\nper_geometry = 4\n")
    };
    let count = |said: &str| said.matches("page").count() - said.matches("pages").count();
    let of_linkages = words(&list("-mu_worst_deg"), CRANKS);
    assert_eq!(count(&of_linkages["Own"]), 6, "{}", of_linkages["Own"]);
    assert!(of_linkages["Own"].contains("Eachlinkageonce") && !of_linkages["Own"].contains("pathof"));
    let index = &of_linkages["Index of geometries"];
    let angles = index.split("Bytransmissionangle").nth(1).unwrap().split("Bysymmetry").next().unwrap();
    assert_eq!(angles.matches("figure").count(), 6, "{angles}");
    let of_points = words(&list("-length"), CRANKS);
    assert_eq!(count(&of_points["Own"]), 24, "{}", of_points["Own"]);
    assert!(of_points["Own"].contains("pathofB"));
    // Degrees of a rocker, lengths of a slider.
    let cranks = words("[book]\nindex = false\n", &format!("unit = \"mm\"\n{CRANKS}"));
    assert!(cranks["Quick returns"].contains("outputfrom0.80mmto2.94mm"), "{}", cranks["Quick returns"]);
    let rockers = words(
        "[book]\nindex = false\n",
        "linkage = \"four-bar\"\ngrid = { frame = [3, 3.5], crank = 1, coupler = 3, rocker = 3.5, along = 1, across = 1 }\n",
    );
    let said = rockers["Quick returns"].split("outputfrom").nth(1).unwrap();
    assert_eq!(said.split("least").next().unwrap().matches('°').count(), 2, "{said}");
}

#[test]
fn parts_of_a_finding_chart_say_their_ranges() {
    let titles = |family: &str| -> Vec<String> {
        let parts = words("[book]\nfinding_charts = true\nindex = false\nlist = []\n", family);
        parts
            .into_keys()
            .filter(|title| title.contains("p = ") && title.contains(" to ") || title.starts_with("Family: "))
            .collect()
    };
    let grid = "linkage = \"evans\"\npanels = [3, 2]\nlet = { a = \"(1 + p)^1.5 / 2\" }\n";
    let of_values = titles(&format!("{grid}grid = {{ p = {{ from = 2, to = 6, count = 201 }} }}\n"));
    assert!(of_values.len() > 1 && of_values[0].starts_with("p = 2 to "), "{of_values:?}");
    let cases: String = (0..81).map(|k| format!("{{ p = {} }}, ", 2.0 + 0.05 * f64::from(k))).collect();
    let of_cases = titles(&format!("{grid}cases = [{cases}]\n"));
    assert!(of_cases.len() > 1 && of_cases.iter().any(|title| title.starts_with("Family: pages 1–")), "{of_cases:?}");
    let sorted = titles(&format!("{grid}sort = \"-mu_worst_deg\"\ncases = [{cases}]\n"));
    assert!(sorted.iter().any(|title| title.starts_with("Family: figures 1–")), "{sorted:?}");
}
