//! Tables as digitisers and spreadsheets write them.

use coupler_curves::geometry::trig;

use super::{choose, read, read_timed};

/// Points of an ellipse, to four decimals.
fn ellipse() -> Vec<[f64; 2]> {
    let round = |value: f64| (value * 1e4).round() / 1e4;
    let point = |k: usize| {
        let (cos, sin) = trig::cos_sin_deg(18.0 * k as f64 + 5.0);
        [round(3.0 * cos + 0.5), round(2.0 * sin - 1.25)]
    };
    (0..20).map(point).collect()
}

/// The points as lines, each written by a function of its index and coordinates.
fn lines(line: impl Fn(usize, f64, f64) -> String) -> String {
    ellipse().iter().enumerate().map(|(k, [x, y])| line(k, *x, *y) + "\n").collect()
}

fn comma(value: f64) -> String {
    value.to_string().replace('.', ",")
}

fn minus(value: f64) -> String {
    value.to_string().replace('-', "\u{2212}")
}

/// Asserts that a file has the points of the ellipse.
fn is_ellipse(name: &str, bytes: impl AsRef<[u8]>) {
    let outline = read(bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
    let points: Vec<[f64; 2]> = outline.points.iter().map(|p| [p.x, p.y]).collect();
    assert_eq!(points, ellipse(), "{name}: {}", outline.reading.taken);
    assert!(outline.reading.taken.contains("x is column"), "{name}: {}", outline.reading.taken);
}

#[test]
fn the_forms_of_programs_are_read() {
    let plain = lines(|_, x, y| format!("{x},{y}"));
    let header = |header: &str, divider: &str| format!("{header}\n{}", lines(|_, x, y| format!("{x}{divider}{y}")));
    let utf_16 = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<u8>>();
    for (name, text) in [
        ("commas", plain.clone()),
        ("old line ends", plain.replace('\n', "\r")),
        ("Windows' line ends", plain.replace('\n', "\r\n")),
        ("Engauge, decimal commas in quotes", lines(|_, x, y| format!("\"{}\", \"{}\"", comma(x), comma(y)))),
        ("Engauge, with names", format!("x, y\n{}", lines(|_, x, y| format!("\"{}\", \"{}\"", comma(x), comma(y))))),
        ("Engauge, named after the curve", header("x,Curve1", ",")),
        ("WebPlotDigitizer", header("Default Dataset,\nX, Y", ", ")),
        (
            "WebPlotDigitizer with semicolons",
            format!("Default Dataset;\nX;Y\n{}", lines(|_, x, y| format!("{};{}", comma(x), comma(y)))),
        ),
        (
            "Tracker",
            format!("mass A\t\t\nt\tx\ty\n{}", lines(|k, x, y| format!("{:.3E}\t{x:E}\t{y:E}", k as f64 / 25.0))),
        ),
        (
            "Tracker with velocities",
            format!("t,x,y,v_{{x}},v_{{y}}\n{}", lines(|k, x, y| format!("{k},{x},{y},9,{k}"))),
        ),
        (
            "Tracker without points at the ends",
            format!("t,x,y\n0,,\n1,,\n{}30,,\n", lines(|k, x, y| format!("{k},{x},{y}"))),
        ),
        (
            "Kinovea",
            format!("#Kinovea Trajectory data export\n#T X Y\n{}", lines(|k, x, y| format!("0:00:00:{k:02} {x} {y}"))),
        ),
        (
            "Kinovea's table",
            format!(
                "Time (ms);Trajectory 1 X;Trajectory 1 Y\n{}",
                lines(|k, x, y| format!("{k};{};{}", comma(x), comma(y)))
            ),
        ),
        ("gnuplot", format!("# Curve 0 of 1\n# x y type\n{}\n\n", lines(|_, x, y| format!("{x}  {y}  i")))),
        ("R", format!("\"x\" \"y\"\n{}", lines(|k, x, y| format!("\"{}\" {x} {y}", k + 1)))),
        ("R, with commas", format!("\"\",\"x\",\"y\"\n{}", lines(|k, x, y| format!("\"{}\",{x},{y}", k + 1)))),
        ("pandas, with tabs", format!("\tx\ty\n{}", lines(|k, x, y| format!("{k}\t{x}\t{y}")))),
        ("NumPy", format!("# t, x, y\n{}", lines(|k, x, y| format!("{k}, {x}, {y}")))),
        ("MATLAB", format!("% x y\n{}", lines(|_, x, y| format!("{x:e} {y:e}")))),
        ("slashes", format!("// x, y\n{plain}")),
        ("y before x", format!("y,x\n{}", lines(|_, x, y| format!("{y},{x}")))),
        ("time after", format!("x,y,time\n{}", lines(|k, x, y| format!("{x},{y},{k}")))),
        ("units in brackets", header("X [mm],Y [mm]", ",")),
        ("units in parentheses, blanks", header("x (mm)  y (mm)", "  ")),
        ("units after slashes", header("x/mm;y/mm", ";")),
        ("units after words", header("x_mm\ty_mm", "\t")),
        ("units below", format!("x,y\nmm,mm\n{plain}")),
        ("sep", format!("sep=;\n{}", lines(|_, x, y| format!("{};{}", comma(x), comma(y))))),
        ("sep with names", format!("\"sep=;\"\r\nx;y\r\n{}", lines(|_, x, y| format!("{x};{y}")))),
        ("dividers at the ends", lines(|_, x, y| format!("{};{};", comma(x), comma(y)))),
        ("decimal commas and blanks", lines(|_, x, y| format!("{}  {}", comma(x), comma(y)))),
        ("decimal commas and tabs", lines(|_, x, y| format!("{}\t{}", comma(x), comma(y)))),
        ("Fortran", lines(|_, x, y| format!("  {x:E}  {y:E}").replace('E', "D"))),
        ("minus signs", lines(|_, x, y| format!("{};{}", minus(x), minus(y)))),
        ("no-break spaces", lines(|_, x, y| format!("{x}\u{a0};\u{a0}{y}"))),
        ("no-break spaces between", lines(|_, x, y| format!("{x}\u{a0}{y}"))),
        ("vertical bars", lines(|_, x, y| format!("{x} | {y}"))),
        ("a blank line after each", lines(|_, x, y| format!("{x},{y}\n"))),
        ("empty rows of a spreadsheet", format!("x;y;\n{};;\n;;\n", lines(|_, x, y| format!("{x};{y};")))),
        (
            "preamble",
            format!("Scale;12,5\nOperator;me\nx;y\n{}", lines(|_, x, y| format!("{};{}", comma(x), comma(y)))),
        ),
    ] {
        is_ellipse(name, &text);
        is_ellipse(name, format!("\u{feff}{text}"));
        if !text.contains('\u{2212}') && !text.contains('\u{a0}') {
            is_ellipse(name, utf_16(&text));
            is_ellipse(name, [&b"\xff\xfe"[..], &utf_16(&text)].concat());
        }
    }
    // The western code page, with a no-break space and a degree sign.
    is_ellipse("code page", [b"t [\xb0];x;y\n", lines(|k, x, y| format!("{k};{x};{y}")).as_bytes()].concat());
}

#[test]
fn groups_of_three_digits_are_read_where_they_can_be_nothing_else() {
    let first = |text: &str| read(text).map(|outline| [outline.points[0].x, outline.points[0].y]);
    assert_eq!(first("1.234,5;2.000,25\n1;2\n"), Ok([1234.5, 2000.25]));
    assert_eq!(first("\"1,234.5\",\"2,000.25\"\n1,2\n"), Ok([1234.5, 2000.25]));
    assert_eq!(first("1'234.5;2'000\n1;2\n"), Ok([1234.5, 2000.0]));
    assert_eq!(first("1\u{202f}234,5;2\u{a0}000\n1;2\n"), Ok([1234.5, 2000.0]));
    assert_eq!(first("1,130;20,5\n2;3\n"), Ok([1.13, 20.5]));
    let error = first("\"1,234\",\"2,345\"\n\"3,456\",\"4,567\"\n").unwrap_err();
    assert!(error.contains("`1,234` may be 1.234 or 1234"), "{error}");
}

#[test]
fn angles_have_units() {
    let degrees: Vec<f64> = (0..20).map(|k| 18.0 * f64::from(k)).collect();
    let table = |header: &str, factor: f64| {
        format!("{header}\n{}", lines(|k, x, y| format!("{},{x},{y}", degrees[k] * factor)))
    };
    let radian = std::f64::consts::PI / 180.0;
    for (text, unit) in [
        (table("angle [rad],x,y", radian), "rad"),
        (table("theta (rad),x,y", radian), "rad"),
        (table("θ/rad,x,y", radian), "rad"),
        (table("angle_rad,x,y", radian), "rad"),
        (table("angle,x,y\nrad,mm,mm", radian), "rad"),
        (table("# angle [rad], x, y", radian), "rad"),
        (table("crank angle [turns],x,y", 1.0 / 360.0), "turns"),
        (table("angle [deg],x,y", 1.0), "deg"),
        (table("angle/°,x,y", 1.0), "°"),
        (table("input_deg,x,y", 1.0), "deg"),
        (table("phi,x,y", 1.0), "degrees"),
    ] {
        let outline = read_timed(&text).unwrap();
        let angles = outline.angles_deg.unwrap();
        assert!(angles.iter().zip(&degrees).all(|(angle, expected)| (angle - expected).abs() < 1e-9), "{text}");
        assert!(outline.reading.taken.contains(&format!("in {unit}")), "{}", outline.reading.taken);
        let untimed = read(&text).unwrap();
        assert!(
            untimed.angles_deg.is_none() && untimed.reading.taken.contains("not used without --timed"),
            "{}",
            untimed.reading.taken
        );
    }
    assert!(read_timed(table("angle [gon],x,y", 1.0)).unwrap_err().contains("`gon`"));
    assert!(
        read_timed(format!("theta,phi,x,y\n{}", lines(|k, x, y| format!("{k},{k},{x},{y}"))))
            .unwrap_err()
            .contains("name one of them `angle`")
    );
}

#[test]
fn what_may_be_misread_is_refused() {
    for (text, expected) in [
        (lines(|k, x, y| format!("{},{x},{y}", 100 - k)), "rises or falls throughout"),
        (lines(|k, x, y| format!("{},{x},{y}", k / 3)), "rises or falls throughout"),
        (format!("x;y\n{}", lines(|_, x, y| format!("{x}mm;{y}mm"))), "line 2: `"),
        (lines(|k, x, y| format!("{k},0,{x},{y}")), "of more than three columns write their names in a first line"),
        (
            lines(|k, x, y| format!("{},{x},{y}", 0.04 * k as f64)),
            "name them in a first line, as in t,x,y or x,y,angle",
        ),
        (lines(|k, x, y| format!("{k} {x} {y}")), "name them in a first line"),
        (lines(|k, x, y| format!("{k},{k},{x},{y}")), "has 4 fields, and not 3"),
        (format!("x,y\n{}", lines(|k, x, y| format!("{},{x},{y}", k + 1))), "has 3 fields, and not 2"),
        (format!("x [mm],y [cm]\n{}", lines(|_, x, y| format!("{x},{y}"))), "x is in mm and y in cm"),
        (format!("{}\n{}", lines(|_, x, y| format!("{x},{y}")), lines(|_, x, y| format!("{y},{x}"))), "it has 2 paths"),
        (
            format!("a,,b,\nX,Y,X,Y\n{}", lines(|_, x, y| format!("{x},{y},{y},{x}"))),
            "1 `a` in lines 3 to 22, 2 `b` in lines 3 to 22",
        ),
        (
            format!(
                "x,Curve1\n{}\nx,Curve2\n{}",
                lines(|_, x, y| format!("{x},{y}")),
                lines(|_, x, y| format!("{y},{x}"))
            ),
            "1 `Curve1`",
        ),
        (lines(|k, x, y| if k == 7 { ",".to_owned() + "\n" } else { format!("{x},{y}") }), "it has 2 paths"),
        (
            format!("x,y\n{}", lines(|k, x, y| if k == 7 { "NaN,NaN".to_owned() } else { format!("{x},{y}") })),
            "a gap in the path",
        ),
        (lines(|k, x, y| if k == 7 { format!("{},{}", comma(x), comma(y)) } else { format!("{x},{y}") }), "line 8"),
        (format!("t,x\n{}", lines(|_, x, y| format!("{x},{y}"))), "no columns `x` and `y`"),
        (
            format!("t x y\n{}", lines(|k, x, y| if k == 3 { format!("{x} {y}") } else { format!("{k} {x} {y}") })),
            "has 2 fields, and not 3",
        ),
        ("1,2\n3,4\n".repeat(60_000), "more than 100000 lines"),
        ("\u{0}\u{1}\u{2}".to_owned(), "no table of points"),
    ] {
        let error = read(&text).expect_err(expected);
        assert!(error.contains(expected), "{expected}: {error}");
    }
}

#[test]
fn one_of_several_paths_is_chosen() {
    let two = format!("a,,b,\nX,Y,X,Y\n{}", lines(|_, x, y| format!("{x},{y},{y},{x}")));
    let curves =
        format!("x,Curve1\n{}\nx,Curve2\n{}", lines(|_, x, y| format!("{x},{y}")), lines(|_, x, y| format!("{y},{x}")));
    let blocks = format!("{}\n\n{}", lines(|_, x, y| format!("{x} {y}")), lines(|_, x, y| format!("{y} {x}")));
    for (text, names) in [(two, ["a", "b"]), (curves, ["Curve1", "Curve2"]), (blocks, ["1", "2"])] {
        for (k, name) in names.iter().enumerate() {
            for wanted in [name, &(k + 1).to_string().as_str()] {
                let outline = choose(&text, wanted).unwrap();
                let points: Vec<[f64; 2]> =
                    outline.points.iter().map(|p| if k == 0 { [p.x, p.y] } else { [p.y, p.x] }).collect();
                assert_eq!(points, ellipse());
                assert!(
                    outline.reading.taken.starts_with(&format!("path {}", k + 1))
                        && outline.reading.taken.contains("of 2"),
                    "{}",
                    outline.reading.taken
                );
            }
        }
        assert!(choose(&text, "nothing").unwrap_err().contains("a number from 1 to 2"));
    }
}
