//! Which measures a family computes, in its tables and on its pages.

#[test]
fn a_family_computes_the_measures_it_names_and_those_its_expressions_use() {
    let text = |measures: &str| {
        format!(
            "[atlas]\ntitle = \"T\"\noutput = \"out\"\n[[family]]\nid = \"e\"\nlinkage = \"evans\"\n\
             sampling = {{ step = \"10 deg\" }}\n{measures}grid = {{ p = [2, 3, 4] }}\nlet = {{ a = \"(1 + p)^1.5 / 2\" }}\n\
             where = \"mu_min_deg > 1 and is_crank_rocker\"\nsort = \"-length\"\nnote = \"{{speed_ratio:.1}}\"\n"
        )
    };
    let run = |measures: &str| {
        let atlas = crate::support::folder::Atlas::new(&text(measures));
        let (code, _, err) = atlas.run(&[]);
        assert_eq!(code, 0, "{err}");
        let cells = std::fs::read_to_string(atlas.out().join("e/cells.csv")).unwrap();
        let page = std::fs::read_to_string(atlas.out().join("e/e-001.svg")).unwrap();
        let rows: Vec<Vec<String>> = cells.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect();
        (rows, page)
    };
    let (all, _) = run("");
    let (some, page) = run("measures = [\"area\", \"class\"]\n");
    let head: Vec<&str> = some[0].iter().map(String::as_str).skip_while(|name| *name != "reason").skip(1).collect();
    // In the order of all measures; `is_crank_rocker` follows from `class`.
    let expected = ["class", "mu_min_deg", "length", "area", "speed_ratio", "family", "joint"];
    assert_eq!(head, expected);
    // The values are the same as when all measures are computed.
    for (row, full_row) in some.iter().zip(&all) {
        for (name, value) in some[0].iter().zip(row) {
            let column = all[0].iter().position(|other| other == name).unwrap();
            assert_eq!(*value, full_row[column], "{name}");
        }
    }
    // Straight portions are not searched for, and their groups on the page are empty.
    let groups = page.matches("<g class=\"straight\">\n").count();
    assert!(groups == 3 && page.matches("<g class=\"straight\">\n</g>").count() == groups);
}
