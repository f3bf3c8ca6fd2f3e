//! Random manifests: every linkage of the catalogue and those of `linkages.toml`, sampled in every way.

use std::fmt::Write;

use coupler_manifest as manifest;

/// The linkages of `linkages.toml`.
const LINKAGES: &str = include_str!("linkages.toml");

/// Every linkage, with the parameters that are varied and their usual values.
const KINDS: [(&str, &str); 33] = [
    ("four-bar", "frame 4 crank 1.5 coupler 3 rocker 3.5 along 2 across 1"),
    ("four-bar", "frame 2 crank 4 coupler 3 rocker 3.5 along 2 across 1"),
    ("evans", "p 2 r 1 a 2.6 s 2.6 k 2"),
    ("chebyshev", "p 4 r 5 s 5 a 2 k 0.5"),
    ("watt", "p 8 r 4 s 4 a 2.5 k 0.5"),
    ("roberts", "p 4 r 2.4 s 2.4 a 2 b 2.4"),
    ("hoeken", "p 2 r 1 a 2.5"),
    ("hrones-nelson", "A 2.5 B 3 C 2"),
    ("cognates", "p 4 r 1.5 a 3 s 3.5 u 1.8 v 1.3"),
    ("slider-crank", "crank 1 coupler 3 offset 0.5 along 2 across 0.4"),
    ("inverted-slider-crank", "g 2 r 1 e 0.5 along 4 across 0.5"),
    ("scotch-yoke", "r 1 offset 0.5 angle 80 along 2 across 0.5"),
    ("jansen", "j 50 k 61.9 m 15"),
    ("klann", "r 0.268 a 0.59 s 0.32 b 0.9 c 0.52"),
    ("pantograph", "p 2 r 1 a 2.5 u 4 v 4 n 3"),
    ("peaucellier-lipkin", "r 5 arm 15 side 6"),
    ("hart-inversor", "long 12 short 6 part 0.5 r 2"),
    ("linear-actuator", "g 2 r 1 e 0.2 along 2.5 across -0.5"),
    ("geared-five-bar", "f 3 a 5 b 7 c 8 d 4 phase 20"),
    ("watt-six-bar", "p 110 r 70 a 100 s 90 b 120 c 160"),
    ("stephenson-six-bar", "p 135 r 80 a 105 s 120 b 180 c 180"),
    ("moving-line", "p 4 r 1.2 a 3.1 s 3.4 l 5 e 0.4"),
    ("moving-slot", "p 4 r 1.2 a 3.1 s 3.4 e 0.3 x -1"),
    ("slot-and-dyad", "g 2 r 1 u 3 b 2.5 c 3.5"),
    ("moving-yoke", "p 4 r 1 a 3 s 3.2 h 70"),
    ("actuator-and-dyad", "g 3 r 1.2 e 0.1 a 2.6 s 2.2"),
    ("two-gears", "a 2 d 1 b 5 c 5.5 h 10"),
    ("fast-gear", "a 2 d 0.2"),
    ("parallelograms", "p 4 r 1.5 b 3 c 3"),
    ("coupler-driven", "p 4 r 5 s 5 a 2"),
    ("part-of-a-turn", "p 4 r 1.5 a 3 s 3.5"),
    ("two-dyads", "p 4 r 2 a 3.5 s 2.4"),
    ("driven-slider", "e 0.3 r 1.2 l 3 a 2.6 s 2.2"),
];

/// The number of kinds of linkages.
pub const KIND_COUNT: usize = KINDS.len() + 1;

/// The same sequence of numbers for each seed on any machine: Steele, Lea and Flood's SplitMix64, OOPSLA 2014.
pub struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number from -1 to 1.
    fn deviate(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[(self.next() % from.len() as u64) as usize]
    }
}

/// A random manifest with families of the given kinds of linkages, from 0, each with `cells` cells.
pub fn manifest(random: &mut Random, kinds: impl Iterator<Item = usize>, cells: usize) -> String {
    let mut text = header(random);
    for (number, kind) in kinds.enumerate() {
        text += &family(random, kind % KIND_COUNT, number, cells);
    }
    text + LINKAGES
}

fn header(random: &mut Random) -> String {
    let dash = random.pick(&["5", "5", "3", "7", "1.3", "12.5"]);
    let theme = random.pick(&["paper", "monochrome", "dark"]);
    let paper = random.pick(&["tabloid", "a4", "a3"]);
    format!(
        "[atlas]\ntitle = \"Random linkages\"\nformats = [\"svg\"]\n\
         [page]\ndash = \"{dash} deg\"\ntheme = \"{theme}\"\npaper = \"{paper}\"\n\n"
    )
}

/// A family with valid cells: parameters with which the linkage cannot be built are drawn again.
fn family(random: &mut Random, kind: usize, number: usize, cells: usize) -> String {
    let (linkage, parameters) = KINDS.get(kind).copied().unwrap_or(("small-curve", "x 4 r 1.5"));
    let is_actuator = ["linear-actuator", "actuator-and-dyad", "driven-slider"].contains(&linkage);
    let columns = random.pick(&[5, 3, 2, 1]);
    let mut text = format!(
        "[[family]]\nid = \"family-{number}\"\nlinkage = \"{linkage}\"\npanels = [{columns}, {}]\n",
        random.pick(&[3, 2, 1])
    );
    let _ = writeln!(text, "sampling = {}", sampling(random, is_actuator));
    let _ = writeln!(text, "circuits = \"{}\"", random.pick(&["start", "all"]));
    let _ = writeln!(text, "continuation = \"{}\"", random.pick(&["smooth", "branch"]));
    let _ = writeln!(text, "coincident = \"{}\"", random.pick(&["together", "first", "last"]));
    text += random.pick(&[
        "",
        "",
        "place = { mirror = true, rotate = \"30 deg\" }\n",
        "place = { rotate = \"-77 deg\" }\n",
    ]);
    text += random.pick(&["", "", "columns = [\"vx\", \"vy\"]\n"]);
    text += random.pick(&["measures = []\n", "measures = []\n", "measures = []\n", ""]);
    if linkage == "hrones-nelson" {
        text += random.pick(&["", "layout = \"coupler-grid\"\n"]);
        text = text.replace(&format!("panels = [{columns}"), "# [");
    }
    let mut cases = String::new();
    let mut left = cells;
    let mut rejected = 0;
    while left > 0 {
        let case = case(random, linkage, parameters);
        let alone = format!("[atlas]\ntitle = \"One\"\n{text}cases = [{case}]\n{LINKAGES}");
        let outcome = manifest::parse(&alone);
        if outcome.plan.is_some() {
            cases += &format!("    {case},\n");
            left -= 1;
        } else {
            rejected += 1;
            assert!(rejected < 1000, "{:?}\n{alone}", outcome.problems);
        }
    }
    format!("{text}cases = [\n{cases}]\n\n")
}

fn sampling(random: &mut Random, is_actuator: bool) -> String {
    let step = match is_actuator {
        true => random.pick(&["0.01", "0.05", "0.1", "0.37"]),
        false => random.pick(&[
            "\"0.5 deg\"",
            "\"1.37 deg\"",
            "\"2 deg\"",
            "\"3 deg\"",
            "\"5 deg\"",
            "\"11 deg\"",
            "\"30 deg\"",
        ]),
    };
    let samples = random.pick(&[2, 3, 5, 8, 12, 37, 72, 180, 360, 721]);
    match random.pick(&[0, 1, 1, 1, 2, 2, 3, 3]) {
        0 => format!("{{ step = {step} }}"),
        1 => format!("{{ samples = {samples} }}"),
        2 => format!("{{ samples = {samples}, spacing = \"smooth\" }}"),
        _ => format!("{{ samples = {samples}, spacing = \"arc\" }}"),
    }
}

/// Parameter values near the usual ones, or far from them; of a four-bar also at change points and near them.
fn case(random: &mut Random, linkage: &str, parameters: &str) -> String {
    let words: Vec<&str> = parameters.split(' ').collect();
    let spread = random.pick(&[0.02, 0.2, 0.7]);
    let decimals = random.pick(&[0, 1, 2, 2, 15]);
    // A linkage of another size, with positions as exact in relation to it.
    let size = if linkage.contains("four-bar") { random.pick(&[1.0, 1.0, 1.0, 1e-3, 1e6]) } else { 1.0 };
    let round = |value: f64| if decimals > 9 { value } else { format!("{value:.decimals$}").parse().unwrap_or(value) };
    let mut values: Vec<(&str, f64)> = words
        .chunks(2)
        .map(|pair| {
            let usual: f64 = pair[1].parse().unwrap_or(1.0);
            (pair[0], size * round(usual * growth(spread * random.deviate())))
        })
        .collect();
    let near = random.pick(&[0.0, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2]) * random.deviate() * size;
    if values.len() >= 4 && random.pick(&[true, false, false]) {
        // The last of the first four lengths makes two of them equal the other two, or one the other three.
        let [a, b, c] = [values[0].1, values[1].1, values[2].1];
        values[3].1 = random.pick(&[a + b - c, a + c - b, b + c - a, a + b + c]) + near;
    }
    if random.pick(&[false, false, false, true]) {
        let (from, to) = (random.pick(&[0, 1, 2]), random.pick(&[1, 2, 3]));
        if from < values.len() && to < values.len() {
            values[to].1 = values[from].1 + near;
        }
    }
    if linkage == "geared-five-bar" {
        values.push(("n", random.pick(&[-3.0, -1.0, 1.0, 2.0, 5.0])));
        values.push(("m", random.pick(&[1.0, 2.0, 3.0])));
    }
    if linkage == "small-curve" {
        values.push(("t", random.pick(&[0.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15])));
    }
    let fields: Vec<String> = values.iter().map(|(name, value)| format!("{name} = {value:?}")).collect();
    format!("{{ {} }}", fields.join(", "))
}

/// About e^x, positive for any x, by operations that are the same on every machine (Padé's approximant).
fn growth(x: f64) -> f64 {
    (1.0 + x / 2.0 + x * x / 12.0) / (1.0 - x / 2.0 + x * x / 12.0)
}
