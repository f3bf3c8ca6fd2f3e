//! What pages state of motions is true of them.

use std::collections::BTreeSet;
use std::fs;

use crate::support::command::{folder_with, printed, run};
use crate::support::table::{numbers, rows};
use crate::support::texts::texts;

/// The page of a family as SVG, and its table of cells.
fn rendered(family: &str) -> [String; 2] {
    let folder = folder_with(&format!("[atlas]\ntitle = \"T\"\n{family}"));
    printed(folder.path(), &["render", "-q", "--format", "svg", "-o", "out"]);
    ["f-001.svg", "cells.csv"].map(|file| fs::read_to_string(folder.path().join("out/f").join(file)).unwrap())
}

/// The page of one linkage of the catalogue as SVG, and its table of cells.
fn of_catalogue(linkage: &str) -> [String; 2] {
    rendered(&format!("[[family]]\nid = \"f\"\nlinkage = \"{linkage}\"\ncases = [{{}}]\n"))
}

/// A linkage is not asked for more than it reaches: printed limits are within the true ones, and next to them.
#[test]
fn printed_limits_of_the_input_are_reached() {
    for (linkage, word) in [("hart-inversor", "input"), ("peaucellier-lipkin", "input"), ("elliptic-trammel", "slider")]
    {
        let [svg, cells] = of_catalogue(linkage);
        let names =
            if word == "input" { ["input_min_deg", "input_max_deg"] } else { ["input_min_length", "input_max_length"] };
        let limits = numbers(&rows(&cells)[0], names);
        let stated = svg.split(&format!("{word} ")).find_map(|rest| {
            let ends: Vec<f64> = rest
                .split(['<', '·'])
                .next()?
                .replace(['°', ' '], "")
                .replace('−', "-")
                .split("to")
                .map(|end| end.parse().ok())
                .collect::<Option<_>>()?;
            <[f64; 2]>::try_from(ends).ok()
        });
        let [least, most] = stated.unwrap_or_else(|| panic!("{linkage}"));
        assert!(
            (0.0..0.0101).contains(&(least - limits[0])) && (0.0..0.0101).contains(&(limits[1] - most)),
            "{linkage}: {least} {most}, {limits:?}"
        );
    }
}

/// Next to a dead point an error of a length moves the curve without bounds, to the first order: neither does the band, nor the figure shrink.
#[test]
fn tolerances_that_say_nothing_next_to_limits_are_not_drawn() {
    let [svg, cells] =
        rendered("[[family]]\nid = \"f\"\nlinkage = \"peaucellier-lipkin\"\ncases = [{}]\ntolerance = 0.02\n");
    let [worst] = numbers(&rows(&cells)[0], ["tolerance_worst"]);
    assert!(worst > 1000.0 && svg.contains("lengths ± 0.02 move the curve by more than 18"), "{worst}");
    // The scale bar of a figure of the path, which is 18 long, and not of the band.
    assert!(svg.contains(">5</text>") && !svg.contains("00000</text>"));
}

/// What varies and has no room under small figures is not missed without a word.
#[test]
fn captions_that_are_cut_end_in_an_ellipsis() {
    let [svg, _] = rendered(
        "[page]\npaper = { width = \"120 mm\", height = \"200 mm\" }\n[[family]]\nid = \"f\"\nlinkage = \"slider-crank\"\npanels = [8, 7]\n\
         grid = { crank = [10, 11, 12, 13, 14, 15, 16], offset = [0, 1, 2, 3, 4, 5, 6, 7], coupler = 40 }\n",
    );
    assert!(svg.contains(">10, 0</text>") && svg.contains(">16, 7</text>"), "{svg}");
    assert!(svg.contains(">captions: crank, offset</text>"), "{svg}");
    // Where nothing varies there is no other caption.
    let [svg, _] = rendered(
        "[page]\npaper = { width = \"120 mm\", height = \"200 mm\" }\n[[family]]\nid = \"f\"\nlinkage = \"slider-crank\"\npanels = [8, 7]\n\
         cases = [{ crank = 10, coupler = 40 }]\ncaption = \"a caption of so many words that a panel as small as this one has no room for them all\"",
    );
    assert!(svg.contains(" …</text>"), "{svg}");
}

/// The texts under the figures of a page have one size for captions, and one for what else is said, also where one of them is broken.
#[test]
fn texts_under_figures_have_one_size_each() {
    let [svg, _] = rendered(
        "[[family]]\nid = \"f\"\nlinkage = \"evans\"\npanels = [5, 2]\nlet = { a = \"(1 + p)^1.5 / 2\" }\n\
         grid = { p = [2, 3, 4, 5, 6], k = [2, 2.5] }\nnote = \"{p:.2} and {p^7:.6} with words {p^9:.9}\"\n",
    );
    let sizes = |word: &str| -> BTreeSet<&str> {
        let texts = svg.split("<text ").skip(1).filter(|text| text.split("</text>").next().unwrap().contains(word));
        texts.map(|text| text.split("font-size=\"").nth(1).unwrap().split('"').next().unwrap()).collect()
    };
    let [notes, facts, poses] = ["with words", "crank-rocker", "drawn at"].map(sizes);
    assert_eq!(notes.len(), 1, "{notes:?}");
    assert_eq!((&notes, &notes), (&facts, &poses));
}

#[test]
fn pages_of_poses_say_that_places_are_outside_their_figures() {
    // A pole is where two of three poses are turned into each other: far away where they are nearly parallel.
    for (pose, is_beyond) in [("[18.3, 67.6, 8]", true), ("[18.3, 67.6, -60]", false)] {
        let [svg, _] = rendered(&format!(
            "[[family]]\nid = \"f\"\nlinkage = \"four-bar\"\nlayout = \"poses\"\nposes = [[29.8, 59.6, 8.6], [30.7, 67.8, -7.2], {pose}]\n\
             cases = [{{ frame = 80, crank = 30, coupler = 60, rocker = 70 }}]\n"
        ));
        assert_eq!(svg.contains("places further away are left out"), is_beyond, "{pose}");
    }
}

/// The two portions of a symmetrical curve take the same input where the motion is symmetrical, too.
#[test]
fn portions_with_a_mirror_image_are_there_twice_if_that_takes_as_much_input() {
    for (linkage, case, has_twin) in [("hoeken", "", true), ("watt", "p = 4, r = 2, s = 2, a = 1, k = 0.5", false)] {
        let [svg, _] = rendered(&format!("[[family]]\nid = \"f\"\nlinkage = \"{linkage}\"\ncases = [{{ {case} }}]\n"));
        let said = ["°, twice", ", also mirrored"].map(|words| svg.contains(words));
        assert_eq!(said, [has_twin, !has_twin], "{linkage}");
    }
}

#[test]
fn a_plate_of_a_second_point_names_its_path() {
    let folder = folder_with("");
    printed(folder.path(), &["export", "--linkage", "slider-crank", "--format", "svg", "-o", "out"]);
    let svg = fs::read_to_string(folder.path().join("out/slider-crank-1-2-1.svg")).unwrap();
    assert!(svg.contains(">path of B</text>"), "{svg}");
}

/// A portion whose mirror image is partly on it is one with that.
#[test]
fn portions_that_overlap_their_mirror_images_are_one() {
    // Of 105 samples of the first portion 27 are on its mirror image, of 272 of the second 21, and none of the third.
    for (s, is_apart) in [(3.9, false), (4.1, false), (4.2, true)] {
        let [svg, _] = rendered(&format!(
            "[[family]]\nid = \"f\"\nlinkage = \"evans\"\ncases = [{{ p = 3, s = {s}, a = {s} }}]\n"
        ));
        let has_image = svg.contains("also mirrored") || svg.contains(", twice");
        assert!(svg.contains("straight ") && has_image == is_apart, "{s}: {svg}");
    }
}

#[test]
fn linkages_that_repeat_after_several_turns_say_so() {
    assert!(of_catalogue("geared-five-bar")[0].contains("repeats after 2 turns"));
    assert!(!of_catalogue("hoeken")[0].contains("repeats"));
}

#[test]
fn sliders_are_not_shown_at_a_dead_point() {
    let [svg, cells] = of_catalogue("elliptic-trammel");
    let shown = svg.split("shown here at ").nth(1).and_then(|rest| rest.split(" of input").next()).unwrap();
    let shown: f64 = shown.replace('−', "-").parse().unwrap();
    let [least] = numbers(&rows(&cells)[0], ["input_min_length"]);
    assert!((0.5..0.9).contains(&(shown / least)), "{shown} of {least}");
}

/// Six paths have five inks: the first of them is that of two.
#[test]
fn every_path_is_in_the_legend() {
    let points: String =
        (1..7).map(|k| format!("M{k} = {{ point = [\"A\", \"B\"], along = {k}, across = 1 }}\n")).collect();
    let [svg, _] = rendered(&format!(
        "[[linkage]]\nid = \"l\"\ntrace = [\"M1\", \"M2\", \"M3\", \"M4\", \"M5\", \"M6\"]\n[linkage.joints]\n\
         O = {{ fixed = [0, 0] }}\nC = {{ fixed = [4, 0] }}\nA = {{ crank = \"O\", length = 1 }}\n\
         B = {{ dyad = [\"A\", \"C\"], lengths = [3, 4], side = \"left\" }}\n{points}\
         [[family]]\nid = \"f\"\nlinkage = \"l\"\ncases = [{{}}]\n"
    ));
    for text in ["path of M1, path of M6", "path of M2", "path of M5"] {
        assert!(svg.contains(&format!(">{text}</text>")), "{text}");
    }
}

#[test]
fn a_measure_in_the_caption_of_a_linkage_belongs_to_its_family() {
    let folder = folder_with(
        "[atlas]\ntitle = \"T\"\n[[linkage]]\nid = \"l\"\ncaption = \"{straight_length}\"\ntrace = [\"A\"]\n[linkage.joints]\n\
         O = { fixed = [0, 0] }\nA = { crank = \"O\", length = 1 }\n",
    );
    let (_, _, error) = run(folder.path(), &["validate", "atlas.toml"]);
    assert!(error.contains("help: `straight_length` is a measure: write it in the caption of a [[family]]"), "{error}");
}

/// The foot of a line through the pivot is no other point that the output could be measured to.
#[test]
fn the_output_of_a_bar_is_named_by_what_slides_through_it() {
    for e in ["0", "0.5"] {
        let [svg, _] = rendered(&format!(
            "[[family]]\nid = \"f\"\nlinkage = \"inverted-slider-crank\"\ncases = [{{ g = 2, r = 1, e = {e} }}]\n"
        ));
        let words = texts(&svg).join(" ");
        assert!(words.contains("output: the link from C that slides through A"), "{e}: {words}");
    }
}

#[test]
fn racks_say_on_which_side_they_meet_their_pinion() {
    for (radius, place, side) in [("10", "", "right"), ("-10", "", "left"), ("10", "place = { mirror = true }", "left")]
    {
        let [svg, _] = rendered(&format!(
            "[[family]]\nid = \"f\"\nlinkage = \"l\"\ncases = [{{}}]\n{place}\n[[linkage]]\nid = \"l\"\ntrace = [\"R\"]\n\
             input = {{ from = \"-90 deg\", to = \"90 deg\" }}\n[linkage.joints]\nO = {{ fixed = [0, 0] }}\nX = {{ fixed = [50, 0] }}\n\
             A = {{ crank = \"O\", length = 20 }}\nR = {{ rack = \"A\", radius = {radius}, line = [\"O\", \"X\"], offset = 10, start = 5 }}\n"
        ));
        let words = texts(&svg).join(" ");
        assert!(words.contains(&format!("{side} of O")), "{radius} {place}: {words}");
    }
}
