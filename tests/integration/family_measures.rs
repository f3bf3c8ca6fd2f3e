//! Which measures a family computes, in its tables and on its pages.

#[test]
fn a_family_takes_the_measures_it_names_and_those_that_are_asked_for() {
    let text = |measures: &str| {
        format!(
            "[atlas]\ntitle = \"T\"\noutput = \"out\"\n[[family]]\nid = \"e\"\nlinkage = \"evans\"\n\
             sampling = {{ step = \"10 deg\" }}\n{measures}grid = {{ p = [2, 3, 4] }}\nlet = {{ a = \"(1 + p)^1.5 / 2\" }}\n\
             where = \"mu_min_deg > 1 and is_crank_rocker\"\nsort = \"-length\"\nnote = \"{{speed_ratio:.1}}\"\n"
        )
    };
    let run = |measures: &str| {
        let atlas = crate::folder::Atlas::new(&text(measures));
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
    // In the order of all; whether it is a crank-rocker its class tells.
    let asked = ["class", "mu_min_deg", "length", "area", "speed_ratio"];
    assert_eq!(head, asked);
    // What is taken has the values it has among all.
    for (row, whole) in some.iter().zip(&all) {
        for (name, value) in some[0].iter().zip(row) {
            let at = all[0].iter().position(|other| other == name).unwrap();
            assert_eq!(*value, whole[at], "{name}");
        }
    }
    // What is not sought is not drawn.
    let groups = page.matches("<g class=\"straight\">\n").count();
    assert!(groups == 3 && page.matches("<g class=\"straight\">\n</g>").count() == groups);
}
