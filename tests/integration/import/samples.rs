//! Linkages in the formats of other programs.

/// A four-bar of PMKS+, in the readable form.
pub const READABLE: &str = "https://app.pmks.invalid/?j=A,0,0,AB,R,t,0,0.1,t,%0AB,0.6,0.8,AB%7CBCM,R,f,0,0.1,f,%0A\
    C,3.4,2.6,BCM%7CCD,R,f,0,0.1,f,%0AD,4,0,CD,R,t,0,0.1,f,%0AM,2.5,3.4,BCM,R,f,0,0.1,f,%0A\
    &l=AB,1,1,0.3,0.4,A%7CB,,l,%0ABCM,1,1,2.1,2.2,B%7CC%7CM,,t,%0ACD,1,1,3.7,1.3,C%7CD,,l,%0A&f=F,1,2&pp=&tp=&s=10,t";

/// A slider-crank of PMKS+: the slider D and the pin C are joints of the block at one place.
pub const SLIDER: &str = "?j=A,0,0,AB,R,t,0,0.1,t,%0AB,0.6,0.8,AB%7CBC,R,f,0,0.1,f,%0AC,3,0.2,BC%7CCD,R,f,0,0.1,f,%0A\
    D,3,0.2,CD,P,t,0.5,0.1,f,%0AM,1.5,1.4,BC,R,f,0,0.1,f,%0A\
    &l=AB,1,1,0,0,A%7CB,,l,%0ABC,1,1,0,0,B%7CC%7CM,,l,%0ACD,1,1,0,0,C%7CD,,l,%0A";

/// The same four-bar in JSON of pylinkage, its coupler point a tracker.
pub const PYLINKAGE: &str = r#"{
  "name": "A four-bar",
  "joints": [
    {"id": "A", "type": "ground", "position": [0, 0], "name": "A"},
    {"id": "B", "type": "revolute", "position": [0.6, 0.8], "name": "B"},
    {"id": "C", "type": "revolute", "position": [3.4, 2.6], "name": "C"},
    {"id": "D", "type": "ground", "position": [4.0, 0.0], "name": "D"},
    {"id": "m", "type": "tracker", "position": [2.5, 3.4], "name": "M", "ref_joint1_id": "B", "ref_joint2_id": "C",
     "distance": 3.22, "angle": 0.37}
  ],
  "links": [
    {"id": "frame", "type": "ground", "joints": ["A", "D"]},
    {"id": "crank", "type": "driver", "joints": ["A", "B"], "motor_joint": "A", "angular_velocity": 1, "initial_angle": 0.9},
    {"id": "coupler", "type": "link", "joints": ["B", "C"]},
    {"id": "rocker", "type": "link", "joints": ["C", "D"]}
  ],
  "ground": "frame"
}"#;

/// A slider-crank of pylinkage.
pub const PYLINKAGE_SLIDER: &str = r#"{"name": "", "joints": [
  {"id": 1, "type": "ground", "position": [0, 0], "name": "A"},
  {"id": 2, "type": "revolute", "position": [0.6, 0.8], "name": "B"},
  {"id": 3, "type": "prismatic", "position": [3, 0.5], "name": "C", "axis": [2, 0], "line_point": [0, 0.5], "slide_distance": 3},
  {"id": 4, "type": "revolute", "position": [1.5, 1.4], "name": "M"}],
  "links": [{"id": 0, "type": "ground", "joints": [1, 3]},
  {"id": 5, "type": "arc_driver", "joints": [1, 2], "motor_joint": 1, "arc_start": 0, "arc_end": 1},
  {"id": 6, "type": "link", "joints": [2, 3, 4]}], "ground": 0}"#;

/// The four-bar as an expression of Pyslvs, with both kinds of brackets.
pub const PYSLVS: &str = "M[J[R, color[green], P[0, 0], L[ground, link_1]], J[R, P[0.6, 0.8], L[link_1, link_2]],\n  \
    J(R, color(green), P(3.4, 2.6), L(link_2, link_3)), J[R, P[4.0, 0.0], L[ground, link_3]], J[R, P[2.5, 3.4], L[link_2]]]";

/// A slider-crank of Pyslvs, whose block carries a point.
pub const PYSLVS_SLIDER: &str = "M[J[R, P[0, 0], L[ground, a]], J[R, P[0.6, 0.8], L[a, b]], J[P, A[10.0], P[3, 0.2], L[ground, c, b]], \
    J[R, P[1.5, 1.4], L[b]], J[R, P[3.5, 0.9], L[c]]]";

/// The four-bar in JSON of LINKS.
pub const LINKS: &str = r#"{"edges": [[0, 1], [1, 2], [2, 3], [1, 4], [4, 2]],
"positions": [[0, 0], [0.6, 0.8], [3.4, 2.6], [4, 0], [2.5, 3.4]], "fixed": [0, 3], "motor": [0, 1], "target": 4}"#;

/// The same as arrays.
pub const ARRAYS: &str = r#"{"A": [[0,1,0,0,0],[1,0,1,0,1],[0,1,0,1,1],[0,0,1,0,0],[0,1,1,0,0]],
"x0": [[0, 0], [0.6, 0.8], [3.4, 2.6], [4, 0], [2.5, 3.4]], "fixed_nodes": [0.0, 3.0], "motor": [0, 1], "target": 4}"#;

/// The digits of the short form.
const DIGITS: &[u8] = b"0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-";

/// A number of the short form.
fn short_number(value: f64) -> String {
    let mut thousands = (value.abs() * 1000.0).round() as usize;
    let mut digits = Vec::new();
    while thousands > 0 || digits.is_empty() {
        digits.insert(0, DIGITS[thousands % 64]);
        thousands /= 64;
    }
    let sign = if value < 0.0 { "0" } else { "" };
    format!("{sign}{}", String::from_utf8(digits).unwrap())
}

/// An address in the short form, from joints with flags and from links.
pub fn short_address(joints: &[(char, &str, [f64; 3])], links: &[&str]) -> String {
    let joint = |(flags, id, [x, y, angle]): &(char, &str, [f64; 3])| {
        format!("{flags}{id},{id},{},{},{}.", short_number(*x), short_number(*y), short_number(*angle))
    };
    let joints: String = joints.iter().map(joint).collect();
    let links: String = links.iter().map(|link| format!("{link}.")).collect();
    let payload = format!("7.A,B.2.10.{joints}.{links}..A.");
    let length = char::from(DIGITS[payload.len() % 62]);
    format!("https://app.pmks.invalid/?{payload}{length}")
}

pub fn short_slider() -> String {
    short_address(
        &[
            ('6', "A", [0.0, 0.0, 0.0]),
            ('0', "B", [0.6, 0.8, 0.0]),
            ('0', "C", [3.0, -0.2, 0.0]),
            ('5', "D", [3.0, -0.2, 1.571]),
            ('G', "M", [1.5, 1.4, 0.0]),
        ],
        &["YRAB,AB,1,1,0,0,c,A,B,,", "YRBC,BC,1,1,0,0,c,B,C,M,,", "YPCD,CD,1,1,0,0,c,C,D,,", "NRX,X,1,1,0,0,c,B,C,,"],
    )
}

/// The four-bar as a file of Linkage, with an element for show.
pub const LINKAGE2: &str = r#"<linkage2>
	<program zoom="1" scalefactor="1" units="Millimeters"/>
	<connector id="0" name="A" layer="16" anchor="true" input="true" rpm="15" x="0" y="0"/>
	<connector id="1" name="B" layer="16" x="0.6" y="0.8"/>
	<connector id="2" name="C" layer="16"x="3.4" y="2.6"/>
	<connector id="5" name="D" anchor="true" x="4" y="0"/>
	<connector id="7" name="M" draw="true" x="2.5" y="3.4"/>
	<connector id="8" layer="1" x="9" y="9"/>
	<Link id="0"><connector id="0"/><connector id="1"/></Link>
	<Link id="1" name=" "><connector id="1"/><connector id="2"/><fastenconnector id="7"/></Link>
	<Link id="2"><connector id="2"/><connector id="5"/></Link>
	<Link id="9" layer="1"><connector id="8"/></Link>
</linkage2>"#;

/// A slider-crank of Linkage.
pub const LINKAGE2_SLIDER: &str = r#"<linkage2>
<connector id="0" name="A" anchor="true" input="true" x="0" y="0"/><connector id="1" name="B" x="0.6" y="0.8"/>
<connector id="2" name="C" x="3" y="0.5" slider="true"><slidelimit id="3"/><slidelimit id="4"/></connector>
<connector id="3" anchor="true" x="0" y="0.5"/><connector id="4" anchor="true" x="5" y="0.5"/>
<connector id="5" name="M" x="1.5" y="1.4"/>
<Link id="0"><connector id="0"/><connector id="1"/></Link>
<Link id="1"><connector id="1"/><connector id="2"/><connector id="5"/></Link></linkage2>"#;

/// The four-bar in JSON of linkage_sim, its coupler in coordinates that are turned by a quarter.
pub const LINKAGE_SIM: &str = r#"{"bodies": {
  "ground": {"attachment_points": {"O2": [0, 0], "O4": [4, 0], "unused": [9, 9]}, "mass": 0},
  "crank": {"attachment_points": {"A": [0, 0], "B": [0.6, 0.8]}},
  "coupler": {"attachment_points": {"B": [0, 0], "C": [1.8, -2.8], "M": [2.6, -1.9]}},
  "rocker": {"attachment_points": {"C": [3.4, 2.6], "D": [4, 0]}}},
"joints": {
  "A": {"type": "revolute", "body_i": "ground", "point_i": "O2", "body_j": "crank", "point_j": "A"},
  "B": {"type": "revolute", "body_i": "crank", "point_i": "B", "body_j": "coupler", "point_j": "B"},
  "C": {"type": "revolute", "body_i": "coupler", "point_i": "C", "body_j": "rocker", "point_j": "C"},
  "D": {"type": "revolute", "body_i": "ground", "point_i": "O4", "body_j": "rocker", "point_j": "D"}},
"drivers": {"D1": {"type": "constant_speed", "body_i": "ground", "body_j": "crank", "omega": 6.28, "theta_0": 0}},
"schema_version": "1.1.0"}"#;

/// A slider-crank of linkage_sim, with a block and a plate that is welded to the rod.
pub const LINKAGE_SIM_SLIDER: &str = r#"{"bodies": {
  "ground": {"attachment_points": {"O": [0, 0], "rail": [0, 0.5]}},
  "crank": {"attachment_points": {"A": [0, 0], "B": [1, 0]}},
  "rod": {"attachment_points": {"B": [0, 0], "C": [2.5, 0]}},
  "plate": {"attachment_points": {"on": [0, 0], "M": [1, 1]}},
  "block": {"attachment_points": {"pin": [0, 0]}}},
"joints": {
  "A": {"type": "revolute", "body_i": "ground", "point_i": "O", "body_j": "crank", "point_j": "A"},
  "B": {"type": "revolute", "body_i": "crank", "point_i": "B", "body_j": "rod", "point_j": "B"},
  "C": {"type": "revolute", "body_i": "rod", "point_i": "C", "body_j": "block", "point_j": "pin"},
  "S": {"type": "prismatic", "body_i": "ground", "point_i": "rail", "body_j": "block", "point_j": "pin", "axis_local_i": [2, 0]},
  "W": {"type": "fixed", "body_i": "rod", "point_i": "B", "body_j": "plate", "point_j": "on", "delta_theta_0": 0.1}},
"drivers": {"D1": {"body_i": "ground", "body_j": "crank", "theta_0": 0.5}}}"#;

/// The four-bar by components of pylinkage, C drawn aside of where its distances put it, and after what is placed from it.
pub const COMPONENTS: &str = r#"{"name": "A four-bar", "joints": [
  {"type": "PointTracker", "name": "M", "anchor1": {"ref": "B"}, "anchor2": {"ref": "C"}, "distance": 3.2202484376209237, "angle": 0.36837945948994055},
  {"type": "Crank", "name": "B", "x": 1.2, "y": 1.6, "joint0": {"inline": true, "type": "Static", "x": 0, "y": 0, "name": "A"}, "distance": 1, "angle": 0.3},
  {"type": "Revolute", "name": "C", "x": 3.5, "y": 2.5, "joint0": {"ref": "B"}, "joint1": "D",
   "distance0": 3.328663395418648, "distance1": 2.6683328128252666},
  {"type": "Ground", "name": "D", "x": 4, "y": 0}], "solve_order": ["B", "C"]}"#;

/// A slider-crank by components.
pub const COMPONENTS_SLIDER: &str = r#"{"name": "", "joints": [
  {"type": "Crank", "name": "B", "x": 0.6, "y": 0.8, "joint0": {"inline": true, "type": "Static", "x": 0, "y": 0, "name": "1402"}, "distance": 1},
  {"type": "Prismatic", "name": "C", "x": 3.5, "y": 0.5, "joint0": {"ref": "B"},
   "joint1": {"inline": true, "type": "Static", "x": 0, "y": 0.5, "name": "P"}, "revolute_radius": 2.4186773244895647,
   "joint2": {"inline": true, "type": "Static", "x": 5, "y": 0.5, "name": "Q"}}]}"#;

/// The four-bar as a table.
pub const TABLE: &str = "\
joint,x,y,fixed,motor,target,bars
A,0,0,1,1,,
B,0.6,0.8,,1,,A C M
C,3.4,2.6,,,,B D
D,4,0,1,,,
M,2.5,3.4,,,1,B C
";

/// Every sample.
pub fn all() -> Vec<String> {
    let samples = [
        READABLE,
        SLIDER,
        PYLINKAGE,
        PYLINKAGE_SLIDER,
        PYSLVS,
        PYSLVS_SLIDER,
        LINKS,
        ARRAYS,
        LINKAGE2,
        LINKAGE2_SLIDER,
        LINKAGE_SIM,
        LINKAGE_SIM_SLIDER,
        COMPONENTS,
        COMPONENTS_SLIDER,
        TABLE,
    ];
    samples.into_iter().map(str::to_owned).chain([short_slider()]).collect()
}
