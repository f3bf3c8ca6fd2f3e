//! Themes: their keys in a manifest, their effect on pages, and whether readers can distinguish their inks.

use std::fs;

use coupler_atlas::manifest;
use coupler_curves::geometry::trig;
use coupler_curves::problem::report;
use coupler_drawing::page::{Layout, Options, Paper, Theme};
use coupler_drawing::scene::{Color, FontFamily};

use crate::support::folder::Atlas;
use crate::support::plan::plan;

/// Panels with five curves each, plates, a case that cannot be assembled, and a chart with several lines.
const GOOD: &str = r#"[atlas]
title = "T"
output = "out"
[page]
theme = "paper"
[[linkage]]
id = "five"
parameters = { g = { min = 0 } }
caption = "g = {g:.1}"
trace = ["M"]
[linkage.joints]
O = { fixed = [0, 0] }
C = { fixed = ["g", 0] }
A = { crank = "O", length = 1 }
B = { dyad = ["A", "C"], lengths = [2.7, 3], side = "left" }
M = { point = ["A", "B"], along = { from = 0.3, to = 2.7, count = 5 }, across = 1 }
[[family]]
id = "panels"
linkage = "five"
panels = [3, 1]
sampling = { step = "10 deg" }
grid = { g = [3, 3.3, 9] }
[[family]]
id = "plates"
linkage = "jansen"
panels = [2, 1]
sampling = { step = "10 deg" }
grid = { m = [14, 15] }
[[family]]
id = "chart"
linkage = "evans"
layout = "chart"
chart = { x = "p", y = ["length", "mu_min_deg"] }
sampling = { step = "10 deg" }
grid = { p = [2, 3, 4], k = [1.5, 1.75, 2] }
let = { a = "(1 + p)^1.5 / 2" }
"#;

fn with(theme: &str) -> String {
    GOOD.replace("\"paper\"", theme)
}

fn theme(text: &str) -> Theme {
    plan(&with(text)).page.theme
}

fn named(name: &str) -> Theme {
    theme(&format!("\"{name}\""))
}

/// The report on a manifest with a theme, and whether the parser accepts it.
fn check(theme: &str) -> (String, bool) {
    let text = with(theme);
    let loaded = manifest::parse(&text);
    assert!(loaded.problems.iter().all(|problem| !problem.help.is_empty()));
    (report(&loaded.problems, "atlas.toml", &text, false), loaded.plan.is_some())
}

#[test]
fn each_mistake_has_its_message() {
    let cases = [
        ("\"drak\"", "`drak` is not one of the words allowed here", "5:9"),
        ("3", "expected a table, found a number", "5:9"),
        ("{ bace = \"dark\" }", "a theme has no key `bace`", "5:11"),
        ("{ base = \"night\" }", "`night` is not one of the words allowed here", "5:18"),
        ("{ paper = \"white\" }", "`white` is not a colour", "5:19"),
        ("{ ink = \"#12345\" }", "`#12345` is not a colour", "5:17"),
        ("{ ink = 0 }", "expected a string, found a number", "5:17"),
        ("{ curves = \"#000\" }", "expected a list, found a string", "5:20"),
        ("{ curves = [] }", "`curves` is empty", "5:20"),
        ("{ curves = [\"#000\", \"blue\"] }", "`blue` is not a colour", "5:29"),
        ("{ curves = [\"#000\", \"#fffeff\"] }", "#fffeff cannot be distinguished from the paper, #fffdf8", "5:29"),
        ("{ ink = \"#f0f0f0\" }", "#f0f0f0 cannot be distinguished from the paper", "5:17"),
        ("{ paper = \"#000\" }", "on this paper, #000000, the theme's `ink`, `grey`, `curves` are hard to see", "5:19"),
        ("{ monochrome = \"yes\" }", "expected a boolean, found a string", "5:24"),
        ("{ face = \"times\" }", "`times` is not one of the words allowed here", "5:18"),
        ("{ drawn = 0 }", "0 of a dash's span is out of range", "5:19"),
        ("{ drawn = 1.5 }", "1.5 of a dash's span is out of range", "5:19"),
        ("{ weights = { links = \"1 mm\" } }", "`weights` has no key `links`", "5:23"),
        ("{ weights = { link = 1 } }", "the unit is missing", "5:30"),
        ("{ weights = { link = \"9 mm\" } }", "9 mm is out of range", "5:30"),
        ("{ weights = 0 }", "0 times the size is out of range", "5:21"),
        ("{ lettering = { title = \"2 deg\" } }", "`deg` is not a unit here", "5:36"),
        ("{ lettering = { note = \"0.1 mm\" } }", "0.1 mm is out of range", "5:32"),
        ("{ lettering = 3 }", "3 times the size is out of range", "5:23"),
    ];
    for (theme, message, place) in cases {
        let (report, is_accepted) = check(theme);
        assert!(!is_accepted, "{theme}");
        assert!(report.contains(message), "{message}:\n{report}");
        assert!(report.contains(&format!("atlas.toml:{place}\n")), "{message} at {place}:\n{report}");
    }
    let (report, _) = check("{ bace = 1, ink = \"x\", face = \"y\", drawn = 2, weights = 9, lettering = 9 }");
    assert_eq!(report.matches("error: ").count(), 6, "{report}");
    assert!(report.contains("did you mean `base`?"), "{report}");
    // Without a known paper, contrast is not checked.
    let (report, _) = self::check("{ base = \"drak\", ink = \"#eee\" }");
    assert_eq!(report.matches("error: ").count(), 1, "{report}");
}

#[test]
fn inks_that_are_hard_to_see_are_warnings() {
    let cases = [
        ("{ ink = \"#888\" }", "#888888 is hard to see on the paper, #fffdf8"),
        ("{ base = \"dark\", grey = \"#777\" }", "#777777 is hard to see on the paper, #14181d"),
        ("{ paper = \"#c0c0c0\" }", "on this paper, #c0c0c0, the theme's `grey`, `hairline`, `curves` are hard to see"),
        ("{ curves = [\"#000\", \"#00f\", \"#080\"] }", "expected at least 5 inks to tell curves apart, found 3"),
        (
            "{ curves = [\"#8c2d19\", \"#1f3d66\", \"#2f6b3a\", \"#5b2d82\", \"#8f2f1b\"] }",
            "#8f2f1b looks like #8c2d19, which is given before it",
        ),
    ];
    for (theme, message) in cases {
        let (report, is_accepted) = check(theme);
        assert!(is_accepted && report.contains(message) && !report.contains("error: "), "{message}:\n{report}");
    }
    for good in [
        "{}",
        "{ base = \"dark\" }",
        "{ base = \"dark\", monochrome = true }",
        "{ monochrome = true, curves = [\"#000\", \"#00f\"] }",
        "{ paper = \"#eef\" }",
    ] {
        assert_eq!(check(good).0, "", "{good}");
    }
}

#[test]
fn a_table_changes_only_the_keys_it_gives() {
    assert_eq!(theme("{}"), Theme::default());
    for name in Theme::NAMED.map(|theme| theme.name) {
        assert_eq!(theme(&format!("{{ base = \"{name}\" }}")), named(name));
    }
    // A monochrome base stays monochrome unless the table sets `monochrome = false`.
    let red = |monochrome: &str| theme(&format!("{{ base = \"monochrome\", ink = \"#700\"{monochrome} }}")).ink;
    assert_eq!((red(""), red(", monochrome = false")), (Color(0x77, 0, 0).to_grey(), Color(0x77, 0, 0)));
    let changed = theme(
        "{ base = \"print\", ink = \"#123\", face = \"mono\", drawn = \"3 / 4\", weights = { link = \"0.05 in\" }, lettering = 1.5 }",
    );
    let print = named("print");
    let expected = Theme {
        ink: Color(0x11, 0x22, 0x33),
        typeface: FontFamily::Mono.into(),
        dash_fraction: 0.75,
        link_width: 0.05 * 25.4,
        title_size: 1.5 * print.title_size,
        source_size: 1.5 * print.source_size,
        caption_size: 1.5 * print.caption_size,
        note_size: 1.5 * print.note_size,
        ..print
    };
    assert_eq!(changed, expected);
}

#[test]
fn sizes_follow_the_paper() {
    let options = |theme: &str, paper: &str| {
        let text = with(theme).replace("[page]\n", &format!("[page]\npaper = \"{paper}\"\n"));
        let page = plan(&text).page;
        page.theme.for_paper(page.paper)
    };
    for (paper, scale) in [("tabloid", 1.0), ("a4", f64::min(297.0 / 431.8, 210.0 / 279.4))] {
        let scaled = options("{ weights = { curve = \"0.8 mm\" }, lettering = { note = \"4 mm\" } }", paper);
        assert!(
            (scaled.curve_width - 0.8 * scale.sqrt()).abs() < 1e-12 && (scaled.note_size - 4.0 * scale).abs() < 1e-12
        );
        let plain = options("\"paper\"", paper);
        assert_eq!((scaled.link_width, scaled.title_size), (plain.link_width, plain.title_size));
        let double = options("{ weights = 2 }", paper);
        let weights = |theme: &Theme| {
            [theme.link_width, theme.curve_width, theme.fine_width, theme.hair_width, theme.joint_radius]
        };
        assert_eq!(weights(&double), weights(&plain).map(|weight| 2.0 * weight));
    }
    // Larger lettering leaves room for fewer panels.
    let large = Options::for_paper(Paper::NAMED[1].1).with_theme(theme("{ lettering = 2 }"));
    let plain = Options::for_paper(Paper::NAMED[1].1);
    let [fewer, more] = [&large, &plain].map(Layout::max_panels);
    assert!(fewer[0] < more[0] && fewer[1] < more[1], "{fewer:?} {more:?}");
}

/// The first page of each family with a theme: the family, the SVG and the image.
fn pages(theme: &str) -> Vec<(String, String, image::RgbImage)> {
    let atlas = Atlas::rendered(&with(theme), &[]);
    let page = |family: &str| {
        let path = atlas.out().join(format!("{family}/{family}-001"));
        let image = image::open(path.with_extension("png")).unwrap().to_rgb8();
        (family.to_owned(), fs::read_to_string(path.with_extension("svg")).unwrap(), image)
    };
    ["panels", "plates", "chart"].map(page).into()
}

/// The colours of an SVG.
fn colors(svg: &str) -> Vec<Color> {
    let words = svg.split("=\"#").skip(1).map(|rest| format!("#{}", rest.split('"').next().unwrap()));
    let mut found: Vec<Color> = words.map(|word| Color::parse(&word).unwrap()).collect();
    found.sort_by_key(|Color(r, g, b)| (*r, *g, *b));
    found.dedup();
    assert!(found.len() > 3);
    found
}

#[test]
fn dark_pages_are_dark() {
    let paper = named("dark").paper;
    assert!(paper.lightness() < 10.0);
    for (family, svg, image) in pages("\"dark\"") {
        let dark = image.pixels().filter(|pixel| Color(pixel[0], pixel[1], pixel[2]).lightness() < 15.0).count();
        let all = image.pixels().count();
        assert!(dark as f64 > 0.85 * all as f64, "{family}: {dark} of {all}");
        // Nothing is darker than the paper, so that no ink of another theme remains, and no shape is filled white.
        for color in colors(&svg) {
            assert!(color.lightness() >= paper.lightness(), "{family}: {color}");
        }
        let fills = svg.split("fill=\"#").skip(1).map(|rest| format!("#{}", &rest[..6]));
        let white = fills.filter_map(|fill| Color::parse(&fill)).filter(|fill| fill.lightness() > 95.0).count();
        assert_eq!(white, 0, "{family}");
    }
}

#[test]
fn monochrome_pages_have_no_colour() {
    for theme in [
        "\"monochrome\"",
        "{ monochrome = true }",
        "{ base = \"dark\", monochrome = true, curves = [\"#f88\", \"#8af\"] }",
    ] {
        for (family, svg, image) in pages(theme) {
            let is_grey = |Color(r, g, b): Color| r == g && g == b;
            assert!(colors(&svg).into_iter().all(is_grey), "{theme} {family}: {:?}", colors(&svg));
            assert!(image.pixels().all(|p| is_grey(Color(p[0], p[1], p[2]))), "{theme} {family}");
        }
    }
    // Each curve of a panel has a stroke style of its own.
    let (_, svg, _) = pages("\"monochrome\"").remove(0);
    let curve = |k: usize| svg.split(&format!("id=\"panels-1-{k}-1\"")).nth(1).unwrap().split("</g>").next().unwrap();
    // The dashes are the second path.
    let style = |k: usize| curve(k).split(" stroke=").nth(2).unwrap().split("/>").next().unwrap().to_owned();
    let styles: Vec<String> = (1..=5).map(style).collect();
    for (k, style) in styles.iter().enumerate() {
        assert!(!styles[..k].contains(style), "{styles:?}");
    }
}

#[test]
#[ignore = "thorough"]
fn pages_have_the_typeface_of_the_theme() {
    let families: Vec<&str> = FontFamily::NAMED.iter().map(|(_, face)| face.fallback_families()).collect();
    for (name, face) in FontFamily::NAMED {
        let pages = pages(&format!("{{ face = \"{name}\" }}"));
        for (family, svg, _) in &pages {
            let named: Vec<&str> = svg.split("font-family=\"").skip(1).map(|s| s.split('"').next().unwrap()).collect();
            assert_eq!(named, [face.fallback_families()], "{family}");
        }
        assert_eq!(families.iter().filter(|other| **other == face.fallback_families()).count(), 1);
    }
    // Images use the outlines of the typeface.
    let [serif, mono] = ["serif", "mono"].map(|face| pages(&format!("{{ face = \"{face}\" }}")).remove(0).2);
    assert_ne!(serif, mono);
}

#[test]
fn the_theme_sets_the_drawn_part_of_a_dash() {
    // The drawn part changes the dashes of a curve, but not their number.
    let dashes = |theme: &str| {
        let (_, svg, _) = pages(theme).remove(0);
        let curve = svg.split("id=\"panels-1-1-1\"").nth(1).unwrap().split("</g>").next().unwrap();
        curve.split(" d=\"").nth(2).unwrap().split('"').next().unwrap().to_owned()
    };
    let [plain, same, longer] = ["\"paper\"", "{ drawn = 0.6 }", "{ drawn = 0.9 }"].map(dashes);
    assert_eq!(plain, same);
    assert!(plain != longer && plain.matches('m').count() == longer.matches('m').count());
}

/// The least difference between any two of the colours.
fn least_difference(colors: &[[f64; 3]], difference: impl Fn(&[f64; 3], &[f64; 3]) -> f64) -> f64 {
    let pairs = (0..colors.len()).flat_map(|k| (0..k).map(move |l| (k, l)));
    pairs.map(|(k, l)| difference(&colors[k], &colors[l])).fold(f64::INFINITY, f64::min)
}

/// The product of a matrix and a vector.
fn product(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// Linear light of an sRGB colour (IEC 61966-2-1).
fn linear(Color(r, g, b): Color) -> [f64; 3] {
    [r, g, b].map(|channel| {
        let c = f64::from(channel) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { trig::pow((c + 0.055) / 1.055, 2.4) }
    })
}

/// CIELAB of linear light, D65.
fn lab(light: [f64; 3]) -> [f64; 3] {
    const XYZ: [[f64; 3]; 3] = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];
    let white = product(&XYZ, [1.0; 3]);
    let xyz = product(&XYZ, light.map(|c| c.clamp(0.0, 1.0)));
    let f = |k: usize| {
        let t = xyz[k] / white[k];
        if t > 216.0 / 24389.0 { trig::pow(t, 1.0 / 3.0) } else { (24389.0 / 27.0 * t + 16.0) / 116.0 }
    };
    [116.0 * f(1) - 16.0, 500.0 * (f(0) - f(1)), 200.0 * (f(1) - f(2))]
}

/// Machado, Oliveira and Fernandes, A physiologically-based model for simulation of color vision deficiency (IEEE TVCG
/// 15, 2009), severity 1: protanopia, deuteranopia, tritanopia; for linear light.
const DICHROMACIES: [[[f64; 3]; 3]; 3] = [
    [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
];

#[test]
fn inks_can_be_distinguished_by_all_readers() {
    let distance = |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f64>().sqrt();
    let lightness = |a: &[f64; 3], b: &[f64; 3]| (a[0] - b[0]).abs();
    // The values in docs/themes.md, rounded down: in colour, under each dichromacy, in grey. A difference of about 2 is
    // just visible side by side; thin lines need several times that.
    let cases = [
        ("paper", [34.9, 20.1, 23.6, 26.3, 8.7]),
        ("print", [34.9, 20.1, 23.6, 26.3, 8.7]),
        ("monochrome", [12.9; 5]),
        ("dark", [32.0, 21.0, 22.0, 23.0, 8.4]),
    ];
    for (name, expected) in cases {
        let light: Vec<[f64; 3]> = named(name).curve_inks.iter().map(|ink| linear(*ink)).collect();
        let seen = |matrix: &[[f64; 3]; 3]| light.iter().map(|ink| lab(product(matrix, *ink))).collect::<Vec<_>>();
        let normal: Vec<[f64; 3]> = light.iter().map(|ink| lab(*ink)).collect();
        let mut differences = vec![least_difference(&normal, distance)];
        differences.extend(DICHROMACIES.iter().map(|matrix| least_difference(&seen(matrix), distance)));
        differences.push(least_difference(&normal, lightness));
        for (difference, expected) in differences.iter().zip(expected) {
            assert!(
                difference >= &expected && *difference < expected + 1.0,
                "{name}: {difference}, expected {expected}"
            );
        }
        // Manifests are checked with the same difference.
        let inks = named(name).curve_inks;
        assert!((inks[0].difference(inks[1]) - distance(&normal[0], &normal[1])).abs() < 1e-9);
    }
}

#[test]
fn contrast_is_sufficient_for_reading() {
    for name in Theme::NAMED.map(|theme| theme.name) {
        let theme = named(name);
        for (text, k) in [theme.ink, theme.grey, theme.curve_ink(0)].into_iter().zip(0..) {
            assert!(text.contrast(theme.paper) >= 4.5, "{name}: text {k}");
        }
        for ink in &theme.curve_inks {
            assert!(ink.contrast(theme.paper) >= 3.0, "{name}: {ink}");
        }
        assert!(theme.hairline.contrast(theme.paper) >= 1.5, "{name}");
    }
}

#[test]
fn docs_themes_has_a_valid_theme_and_names_every_key() {
    let text = include_str!("../../docs/themes.md");
    let page = text.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    let (report, is_accepted) = check(page.split_once("theme = ").unwrap().1.trim());
    assert!(is_accepted && report.is_empty(), "{report}");
    let names = Theme::NAMED.iter().map(|theme| theme.name).chain(FontFamily::NAMED.iter().map(|(name, _)| *name));
    for name in names {
        assert!(text.contains(&format!("`\"{name}\"`")), "{name}");
    }
    let (report, _) = self::check("{ zzzzzz = 1, weights = { zzzzzz = 1 }, lettering = { zzzzzz = 1 } }");
    let keys =
        report.lines().filter(|line| line.contains("it can be")).flat_map(|line| line.split('`').skip(1).step_by(2));
    for key in keys {
        assert!(text.contains(&format!("`{key}`")), "{key}");
    }
    assert_eq!(report.matches("it can be").count(), 3, "{report}");
}
