//! Drawings as drawing programs write them.

use coupler_atlas::find::Outline;
use coupler_curves::geometry::{Point, trig};

use super::{choose, read};

fn svg(content: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" viewBox=\"0 0 100 100\">{content}</svg>"
    )
}

/// The greatest distance of points from a circle; y points up.
fn off_circle(outline: &Outline, centre: [f64; 2], radius: f64) -> f64 {
    let off = |p: &Point| ((p - Point::new(centre[0], centre[1])).norm() - radius).abs();
    outline.points.iter().map(off).fold(0.0, f64::max)
}

/// Asserts that the path of a drawing is a circle.
fn is_circle(content: &str, centre: [f64; 2], radius: f64) {
    let outline = read(svg(content)).unwrap_or_else(|error| panic!("{content}: {error}"));
    assert_eq!(outline.is_closed, Some(true), "{content}: {}", outline.reading.taken);
    let off = off_circle(&outline, centre, radius);
    assert!(off < 2e-5 * radius, "{content}: {off}, {}", outline.reading.taken);
}

#[test]
fn what_is_not_shown_is_no_path() {
    let circle = "<circle cx='30' cy='40' r='20' fill='none' stroke='#000'/>";
    for hidden in [
        "<g display='none'><path d='M0 0L900 900 0 900z' stroke='black'/></g>",
        "<g style='display:none'><path d='M0 0L900 900 0 900z' stroke='black'/></g>",
        "<path visibility='hidden' d='M0 0L900 900 0 900z' stroke='black'/>",
        "<g visibility='hidden'><path d='M0 0L900 900 0 900z' stroke='black'/></g>",
        "<style>.off { display: none }</style><g class='layer off'><path d='M0 0L900 900 0 900z' stroke='black'/></g>",
        "<style><![CDATA[#a path { visibility: hidden }]]></style><g id='a'><path d='M0 0L900 900 0 900z' stroke='black'/></g>",
        "<style>path { fill: none; stroke: none }</style><path d='M0 0L900 900 0 900z'/>",
        "<path d='M0 0L900 900 0 900z' fill='none'/>",
        "<path d='M0 0L900 900 0 900z' stroke='black' opacity='0'/>",
        "<path d='M0 0L900 900 0 900z' fill='none' stroke='black' stroke-opacity='0'/>",
        "<path d='M0 0L900 900 0 900z' fill='none' stroke='black' style='stroke-width:0'/>",
        "<path d='M0 0L900 900 0 900z' fill='none' stroke='rgba(0, 0, 0, 0)'/>",
        "<path d='M0 0L900 900 0 900z' fill='#fff0' style='stroke: #00000000'/>",
        "<switch><path systemLanguage='de, fr' d='M0 0L900 900 0 900z' stroke='black'/><g/></switch>",
        "<defs><path d='M0 0L900 900 0 900z' stroke='black'/></defs>",
        "<symbol id='s'><path d='M0 0L900 900 0 900z' stroke='black'/></symbol>",
        "<clipPath id='c'><path d='M0 0L900 900 0 900z' stroke='black'/></clipPath>",
        "<marker id='m'><path d='M0 0L900 900 0 900z' stroke='black'/></marker>",
        "<pattern id='p'><path d='M0 0L900 900 0 900z' stroke='black'/></pattern>",
        "<mask id='k'><path d='M0 0L900 900 0 900z' stroke='black'/></mask>",
        // Grounds, frames and axes.
        "<rect width='100%' height='100%' fill='white'/>",
        "<rect width='500' height='400' fill='white' stroke='black'/>",
        "<path d='M0 345.6L460.8 345.6 460.8 0 0 0z' style='fill: #ffffff'/>",
        "<path d='M0 300L0 0' stroke='black'/><path d='M0 300L400 300' stroke='black'/><path d='M400 300L400 0' stroke='black'/>\
         <path d='M0 0L400 0' stroke='black'/>",
        "<line x1='0' y1='0' x2='900' y2='5' stroke='black'/>",
        // An area, such as a letter.
        "<path d='M0 0L900 900 0 900z'/>",
        "<text x='5' y='5'>M0 0</text>",
        "<switch><foreignObject requiredExtensions='x'><path d='M0 0L900 900 0 900z' stroke='black'/></foreignObject><g/></switch>",
    ] {
        is_circle(&format!("{hidden}{circle}"), [30.0, -40.0], 20.0);
        is_circle(&format!("{circle}{hidden}"), [30.0, -40.0], 20.0);
    }
    let error = read(svg("<path d='M0 0L9 9 0 9z' fill='none'/>")).unwrap_err();
    assert!(error.contains("1 are not shown"), "{error}");
}

#[test]
fn shapes_are_read_where_they_are_shown() {
    for (content, centre, radius) in [
        ("<circle cx='3' cy='4' r='2'/>", [3.0, -4.0], 2.0),
        ("<path d='M1 4a2 2 0 1 0 4 0a2 2 0 1 0-4 0z'/>", [3.0, -4.0], 2.0),
        ("<rect x='1' y='2' width='4' height='4' rx='9'/>", [3.0, -4.0], 2.0),
        (
            "<g transform='translate(10 0)'><g transform='scale(2)'><circle cx='3' cy='4' r='2'/></g></g>",
            [16.0, -8.0],
            4.0,
        ),
        ("<ellipse cx='3' cy='4' rx='2' ry='1' transform='translate(0 -4) scale(1 2)'/>", [3.0, -4.0], 2.0),
        ("<circle r='2' cx='3' cy='4' transform='rotate(90)'/>", [-4.0, -3.0], 2.0),
        ("<circle cx='50%' cy='25%' r='10%'/>", [50.0, -25.0], 10.0),
        ("<circle cx='1in' cy='25.4mm' r='6pt'/>", [96.0, -96.0], 8.0),
        ("<circle cx='2em' cy='0' r='1em' font-size='10'/>", [20.0, 0.0], 10.0),
        ("<defs><circle id='c' cx='3' cy='4' r='2'/></defs><use href='#c' x='5' y='1'/>", [8.0, -5.0], 2.0),
        (
            "<defs><g id='c'><circle cx='3' cy='4' r='2'/></g></defs><use xlink:href='#c' transform='scale(2)'/>",
            [6.0, -8.0],
            4.0,
        ),
        (
            "<symbol id='s' viewBox='0 0 10 10'><circle cx='5' cy='5' r='4'/></symbol><use href='#s' x='10' width='50' height='50'/>",
            [35.0, -25.0],
            20.0,
        ),
        // Twice as large, in the middle of a height of 40.
        (
            "<svg x='5' width='20' height='40' viewBox='0 0 10 10'><circle cx='5' cy='5' r='4'/></svg>",
            [15.0, -20.0],
            8.0,
        ),
        (
            "<svg width='20' height='40' viewBox='0 0 10 10' preserveAspectRatio='xMinYMin meet'><circle cx='5' cy='5' r='4'/></svg>",
            [10.0, -10.0],
            8.0,
        ),
        (
            "<svg width='20' height='40' viewBox='0 0 10 10' preserveAspectRatio='xMinYMax slice'><circle cx='5' cy='5' r='4'/></svg>",
            [20.0, -20.0],
            16.0,
        ),
        ("<style>circle{stroke:red;fill:none}</style><circle cx='3' cy='4' r='2'/>", [3.0, -4.0], 2.0),
        // Shown in spite of what it is in.
        ("<g visibility='hidden'><circle cx='3' cy='4' r='2' visibility='visible'/></g>", [3.0, -4.0], 2.0),
        (
            "<switch><g systemLanguage='de'/><circle cx='3' cy='4' r='2' systemLanguage='fr, en-GB'/></switch>",
            [3.0, -4.0],
            2.0,
        ),
        (
            "<style>.a{fill:none}.a.b{stroke:#123 !important}</style><circle class='a b' cx='3' cy='4' r='2' style='stroke:none'/>",
            [3.0, -4.0],
            2.0,
        ),
    ] {
        is_circle(content, centre, radius);
    }
    // Illustrator's entities.
    let illustrator = "<!DOCTYPE svg [<!ENTITY ns_extend \"http://ns.adobe.com/Extensibility/1.0/\"><!ENTITY ns_svg \"http://www.w3.org/2000/svg\">]>\
        <svg xmlns:x='&ns_extend;' xmlns='&ns_svg;'><switch><foreignObject requiredExtensions='&ns_extend;'/><g><circle cx='3' cy='4' r='2'/></g></switch></svg>";
    assert!(off_circle(&read(illustrator).unwrap(), [3.0, -4.0], 2.0) < 1e-4);
    // Without a name space, and with a prefix.
    for text in [
        "<svg><circle cx='3' cy='4' r='2'/></svg>",
        "<svg:svg xmlns:svg='http://www.w3.org/2000/svg'><svg:circle cx='3' cy='4' r='2'/></svg:svg>",
    ] {
        assert!(off_circle(&read(text).unwrap(), [3.0, -4.0], 2.0) < 1e-4);
    }
}

#[test]
fn strokes_that_share_ends_are_one_outline() {
    let line = "fill='none' stroke='#000'";
    // Two half circles of radius 20 about (50, 50), in all directions and as one path.
    let halves = [
        ["M30 50A20 20 0 0 1 70 50", "M70 50A20 20 0 0 0 30 50"],
        ["M30 50A20 20 0 0 1 70 50", "M30 50A20 20 0 0 1 70 50"],
    ];
    let upper = halves[0][0];
    for lower in ["M70 50A20 20 0 0 1 30 50", "M30 50A20 20 0 0 0 70 50"] {
        is_circle(&format!("<path d='{upper}' {line}/><path d='{lower}' {line}/>"), [50.0, -50.0], 20.0);
        is_circle(&format!("<path d='{upper}{lower}' {line}/>"), [50.0, -50.0], 20.0);
        // Coordinates are rounded: the radius of an arc is then greater than its half circle has.
        let rounded = lower.replace("30 50", "30.0001 50.0001");
        let outline = read(svg(&format!("<path d='{upper}' {line}/><path d='{rounded}' {line}/>"))).unwrap();
        assert!(outline.is_closed == Some(true) && off_circle(&outline, [50.0, -50.0], 20.0) < 0.1);
    }
    let outline = read(svg(&format!("<path id='a' d='M0 0L10 5' {line}/><path d='M20 0L10 5' {line}/>"))).unwrap();
    let ends = [outline.points[0], outline.points[99]];
    assert_eq!((ends, outline.is_closed), ([Point::new(0.0, 0.0), Point::new(20.0, 0.0)], None));
    // A third stroke, or another colour: no one outline.
    for other in ["<path d='M10 5L10 90' fill='none' stroke='#000'/>", ""] {
        let colour = if other.is_empty() { "red" } else { "#000" };
        let text = svg(&format!(
            "<path d='M0 0Q5 0 10 5' {line}/><path d='M20 0Q15 0 10 5' fill='none' stroke='{colour}'/>{other}"
        ));
        let count = if other.is_empty() { "of 2" } else { "of 3" };
        assert!(read(&text).unwrap().reading.taken.contains(count));
    }
}

#[test]
fn an_outline_is_chosen_by_its_id_or_number() {
    let text = svg(
        "<g id='axes'><rect width='90' height='80' fill='none' stroke='#000'/></g><circle id='one' cx='30' cy='40' r='20' stroke='#000'/>\
         <g id='layer2'><circle cx='3' cy='4' r='2' stroke='#000'/></g><circle id='area' cx='5' cy='5' r='4'/>",
    );
    let taken = read(&text).unwrap();
    assert!(
        taken.reading.taken.starts_with(
            "outline 2 of 4 `one`, a line of 40 by 40, the longest of 2 such; --outline N or ID takes another"
        ),
        "{}",
        taken.reading.taken
    );
    for (wanted, centre, radius) in [
        ("one", [30.0, -40.0], 20.0),
        ("layer2", [3.0, -4.0], 2.0),
        ("3", [3.0, -4.0], 2.0),
        ("area", [5.0, -5.0], 4.0),
    ] {
        let outline = choose(&text, wanted).unwrap();
        assert!(off_circle(&outline, centre, radius) < 1e-4 * radius, "{wanted}");
    }
    assert!(choose(&text, "axes").unwrap().reading.taken.contains("a rectangle"));
    let error = choose(&text, "5").unwrap_err();
    assert!(error.contains("a number from 1 to 4, or axes, one, layer2, area"), "{error}");
}

#[test]
fn the_unit_is_that_of_the_view_box() {
    let unit = |attributes: &str| {
        let outline = read(format!("<svg {attributes}><circle cx='3' cy='4' r='2'/></svg>")).unwrap();
        let is_circle = off_circle(&outline, [3.0, -4.0], 2.0) < 1e-4;
        let reading = outline.reading.taken;
        let Some((_, unit)) = reading.split_once("; ") else { panic!("{reading}") };
        (unit.to_owned(), is_circle)
    };
    let said = |text: &str| (text.to_owned(), true);
    assert_eq!(
        unit("width='210mm' height='297mm' viewBox='0 0 210 297'"),
        said("in the drawing's unit, which is 1 mm")
    );
    assert_eq!(
        unit("width='210mm' height='297mm' viewBox='0 0 793.7007874015748 1122.51968503937'"),
        said("in the drawing's unit, which is 0.264583 mm")
    );
    assert_eq!(unit("width='96'"), said("in the drawing's unit, which is 0.264583 mm"));
    assert_eq!(unit("width='100%' height='100%' viewBox='0 0 9 9'"), said("in the drawing's unit"));
    assert_eq!(unit("viewBox='0 0 9 9'"), said("in the drawing's unit"));
    // Three times as high as it is drawn.
    let (unit, is_circle) = unit("width='10' height='30' viewBox='0 0 10 10' preserveAspectRatio='none'");
    assert!(unit.contains("stretched") && !is_circle);
}

#[test]
fn what_cannot_be_read_is_named() {
    for (text, expected) in [
        ("<svg>", "ends within an element"),
        ("<svg/>", "no path, line"),
        ("<html/>", "no <svg>"),
        ("<svg><text>M0 0</text></svg>", "no path, line"),
        ("<svg><path d='M0 0 L'/></svg>", "the path `M0 0 L` cannot be read"),
        ("<svg><path d='M0 0L1 0L1 x 5 5'/></svg>", "cannot be read"),
        ("<svg><path d='nothing'/></svg>", "cannot be read"),
        ("<svg><circle r='1q'/></svg>", "`r = 1q` of the drawing is not a length"),
        ("<svg><circle r='1' transform='turn(3)'/></svg>", "the transform `turn(3)`"),
        ("<svg><path d='M0 0'/></svg>", "no path, line"),
        ("<svg><circle r='0'/></svg>", "no path, line"),
        ("<svg><rect width='-5' height='5' rx='2'/></svg>", "no path, line"),
        ("<svg>\n<a></b></svg>", "line 2"),
        ("<svg><g id='a'><use href='#a'/></g></svg>", "a link (<use>) to what it is in"),
        ("<svg><circle r='1' style='transform: rotate(3deg)'/></svg>", "`transform: rotate(3deg)` in a style"),
        ("<svg viewBox='0 0 0 1'><circle r='1'/></svg>", "viewBox"),
    ] {
        let error = read(text).expect_err(text);
        assert!(error.contains(expected), "{text}: {error}");
    }
    let (cos, sin) = trig::cos_sin_deg(1.0);
    assert!(read(svg(&format!("<path d='M0 0L{cos} {sin}'/>"))).is_ok(), "a line is better than nothing");
}
