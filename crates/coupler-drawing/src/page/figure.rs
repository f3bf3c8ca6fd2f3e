//! The figure of a cell: its curves, and the linkage that draws them.

use super::arrangement::{Arrangement, Extents, Frame};
use super::element::{Area, CouplerCurve, Drawing, draw};
use super::marks;
use super::mechanism::Mechanism;
use super::plot::{Plot, round_number};
use super::pose;
use super::theme::Theme;
use super::{Options, Panel, Sheet, View};
use crate::scene::{Circle, Color, Item, Moving, Path};
use coupler_curves::geometry::{Bounds, Point, Similarity};
use coupler_curves::linkage::{Input, JointId};
use coupler_curves::motion::{self, Circuit, Dashes};
use coupler_curves::solve::{Curve, Solved};

/// A chord is nowhere further than this from its curve, in millimetres on paper: with the rounding to 1/1000 mm, a page
/// can be compared with its samples to 0.01 mm.
pub(super) const CHORD_ERROR: f64 = 0.009;

/// The input a dash and its gap span: that asked for, or, of a length, a round part of what is used of it.
pub(super) fn dash(solved: &Solved, options: &Options) -> f64 {
    if solved.linkage.input() != Input::Length {
        return options.dash_deg;
    }
    let passes = solved.motion.circuits.iter().flat_map(|circuit| &circuit.passes);
    round_number(passes.map(|pass| pass.length()).fold(0.0, f64::max) / 20.0)
}

/// The paths of some curves of a cell on the page, in their order, the k-th in `dashes(k)`; those of one circuit in like
/// dashes are found together.
pub(super) fn paths(
    solved: &Solved,
    curves: &[usize],
    page_from_plane: Similarity,
    dashes: impl Fn(usize) -> Dashes,
) -> Vec<motion::Path> {
    let tolerance = CHORD_ERROR / page_from_plane.scale;
    let on_page = |points: &mut [Point]| points.iter_mut().for_each(|p| *p = page_from_plane.apply(*p));
    let mut out = vec![motion::Path::default(); curves.len()];
    for (number, circuit) in (1..).zip(&solved.motion.circuits) {
        let mut left: Vec<usize> = (0..curves.len()).filter(|&k| solved.curves[curves[k]].circuit == number).collect();
        while let Some(&first) = left.first() {
            let alike = dashes(first);
            let (ours, others) = left.into_iter().partition::<Vec<_>, _>(|&k| dashes(k) == alike);
            let joints: Vec<JointId> = ours.iter().map(|&k| solved.curves[curves[k]].joint).collect();
            let paths = motion::paths(&solved.linkage, circuit, &joints, alike, tolerance);
            for (k, mut path) in ours.into_iter().zip(paths) {
                on_page(&mut path.whole);
                path.dashes.iter_mut().for_each(|dash| on_page(&mut dash.points));
                out[k] = path;
            }
            left = others;
        }
    }
    out
}

/// A cell with the poses its linkage is drawn in.
pub(super) struct Figure<'a> {
    pub panel: &'a Panel<'a>,
    solved: &'a Solved,
    /// The linkage in one pose, or in all it goes through.
    mechanisms: Vec<Mechanism<'a>>,
    /// How long it takes to go through them.
    seconds: f64,
    pub extents: Extents,
}

impl<'a> Figure<'a> {
    /// The figure of a cell; `None` where it has no curve.
    pub fn of(panel: &'a Panel<'a>) -> Option<Figure<'a>> {
        let solved = panel.solved;
        let first = solved.curves.first()?;
        let circuit = solved.circuit(first);
        let (poses, seconds) = match &panel.view {
            View::Clearest => (vec![pose::clearest(&solved.linkage, circuit)], 0.0),
            View::At(pose) => (vec![pose.clone()], 0.0),
            View::Moving { poses, seconds } => (poses.clone(), *seconds),
        };
        let mechanism = |pose| Mechanism::new(&solved.linkage, circuit, pose, &panel.inks);
        let mechanisms: Vec<Mechanism> = poses.into_iter().map(mechanism).collect();
        let curve = Bounds::of(solved.curves.iter().flat_map(|curve| solved.circuit(curve).points(curve.joint)));
        let key = mechanisms.iter().fold(curve, |key, mechanism| key.union(mechanism.bounds()));
        Some(Figure { panel, solved, mechanisms, seconds, extents: Extents { curve, key } })
    }

    /// What is drawn of the linkage in its pose, or moves with it.
    fn posed(&self, items: impl Fn(&Mechanism) -> Vec<Item>) -> Vec<Item> {
        match &self.mechanisms[..] {
            [only] => items(only),
            all => vec![Item::Moving(Moving { frames: all.iter().map(items).collect(), seconds: self.seconds })],
        }
    }

    /// Draws it in a frame of an area.
    pub fn draw(
        &self,
        area: &Area,
        whole: Frame,
        arrangement: Arrangement,
        sheet: &Sheet,
        (options, theme): (&Options, &Theme),
    ) {
        let [curve, key] = arrangement.frames(whole).map(|frame| Plot::new(frame, theme));
        let period = dash(self.solved, options);
        let in_dashes = |plot: &Plot| {
            let paths = self.paths(plot, period, theme);
            self.trail(area, &paths, theme.hair, theme);
            self.marks(area, plot, theme);
            self.curves(area, plot, sheet, (paths, period), theme);
        };
        let key = key.of(self.extents.key);
        key.bar(area, theme);
        self.underlay(area, &key, theme);
        if arrangement == Arrangement::Together {
            in_dashes(&key);
            self.linkage(area, &key, theme);
        } else {
            self.trail(area, &self.paths(&key, period, theme), theme.fine, theme);
            self.linkage(area, &key, theme);
            let curve = curve.of(self.extents.curve);
            curve.bar(area, theme);
            in_dashes(&curve);
        }
    }

    /// The curves in dashes, each with its coupler point.
    fn curves(
        &self,
        area: &Area,
        plot: &Plot,
        sheet: &Sheet,
        (paths, period): (Vec<motion::Path>, f64),
        theme: &Theme,
    ) {
        let limits = self.limit_poses();
        for (curve, path) in self.solved.curves.iter().zip(paths) {
            let stroke = theme.curve_stroke(self.place(curve));
            let ink = stroke.color;
            let Curve { trace, circuit, joint, .. } = curve;
            let dot = |pose: &Vec<Point>| Circle {
                centre: plot.page_from_plane.apply(pose[*joint]),
                radius: 0.5 * theme.joint,
                stroke: None,
                fill: Some(ink),
            };
            let cell = self.solved.cell.number;
            let element = CouplerCurve {
                id: format!("{}-{cell}-{trace}-{circuit}", sheet.heading.family),
                class: "curve",
                title: format!("{}, no. {cell}: {}", sheet.heading.title, self.panel.caption),
                data: vec![("cell", cell.to_string()), ("trace", trace.to_string()), ("circuit", circuit.to_string())],
                page_from_plane: plot.page_from_plane,
                dashes: self.dashes(curve, period, theme),
                strokes: path.dashes,
                weights: [stroke, theme.stroke(theme.faded(ink), theme.fine)],
                // A dot at each limit of the input.
                marks: limits[circuit - 1].iter().map(dot).collect(),
            };
            draw(area, &element);
        }
        let points = self.traced_points(plot, theme);
        draw(area, &Drawing { class: "coupler-point", title: String::new(), items: points });
    }

    /// The curves as light unbroken lines: beside the linkage, and under the dashes to lead the eye over their gaps.
    fn trail(&self, area: &Area, paths: &[motion::Path], weight: f64, theme: &Theme) {
        let trail = |(curve, path): (&Curve, &motion::Path)| {
            let ink = theme.faded(self.ink(curve, theme));
            Item::Path(Path::stroked(path.whole.clone(), theme.stroke(ink, weight)))
        };
        let items = self.solved.curves.iter().zip(paths).map(trail).collect();
        draw(area, &Drawing { class: "trail", title: String::new(), items });
    }

    /// What is marked of the curves: axes of symmetry, straight portions.
    fn marks(&self, area: &Area, plot: &Plot, theme: &Theme) {
        let axes = marks::axes(self.solved, plot, theme);
        draw(area, &Drawing { class: "axis", title: String::new(), items: axes });
        let portion = |curve| marks::portion(self.solved, curve, self.ink(curve, theme), plot, theme);
        let items = self.solved.curves.iter().filter_map(portion).collect();
        draw(area, &Drawing { class: "straight", title: String::new(), items });
    }

    /// The path of every curve, in the order of the curves.
    fn paths(&self, plot: &Plot, period: f64, theme: &Theme) -> Vec<motion::Path> {
        let all: Vec<usize> = (0..self.solved.curves.len()).collect();
        let dashes = |k: usize| self.dashes(&self.solved.curves[k], period, theme);
        paths(self.solved, &all, plot.page_from_plane, dashes)
    }

    /// The dashes of a curve: a dash is the first part of its period, of 5 degrees, as a rule, the first 3.
    fn dashes(&self, curve: &Curve, period: f64, theme: &Theme) -> Dashes {
        Dashes { period, drawn: theme.curve_drawn(self.place(curve)) * period }
    }

    /// Which ink and manner a curve has: curves of one traced joint are told apart by circuit, those of several by trace.
    fn place(&self, curve: &Curve) -> usize {
        let one_trace = self.solved.linkage.traced.len() == 1;
        if one_trace { curve.circuit - 1 } else { curve.trace - 1 }
    }

    fn ink(&self, curve: &Curve, theme: &Theme) -> Color {
        theme.curve_ink(self.place(curve))
    }

    /// The poses at the limits of the input, circuit by circuit.
    fn limit_poses(&self) -> Vec<Vec<Vec<Point>>> {
        let poses = |circuit: &Circuit| {
            let passes = &circuit.passes;
            let pose = |k: usize| motion::pose(&self.solved.linkage, &passes[k], passes[k].to.stop.at);
            (0..passes.len()).filter(|&k| circuit.turns_after(k)).map(pose).collect()
        };
        self.solved.motion.circuits.iter().map(poses).collect()
    }

    fn traced_points(&self, plot: &Plot, theme: &Theme) -> Vec<Item> {
        let mut curves: Vec<&Curve> = Vec::new();
        for curve in self.solved.curves.iter().filter(|curve| curve.circuit == self.solved.curves[0].circuit) {
            if curves.iter().all(|done| done.joint != curve.joint) {
                curves.push(curve);
            }
        }
        let circle = |curve: &Curve, mechanism: &Mechanism| {
            let stroke = Some(theme.stroke(self.ink(curve, theme), theme.fine));
            let centre = plot.page_from_plane.apply(mechanism.pose[curve.joint]);
            Item::Circle(Circle { centre, radius: theme.joint, stroke, fill: Some(theme.paper) })
        };
        self.posed(|mechanism| curves.iter().map(|curve| circle(curve, mechanism)).collect())
    }

    fn underlay(&self, area: &Area, plot: &Plot, theme: &Theme) {
        let items = self.posed(|mechanism| mechanism.underlay(plot, theme));
        draw(area, &Drawing { class: "underlay", title: String::new(), items });
    }

    fn linkage(&self, area: &Area, plot: &Plot, theme: &Theme) {
        let traced = |joint| self.solved.curves.iter().find(|curve| curve.joint == joint);
        let ink = |joint| traced(joint).map_or(theme.ink, |curve| self.ink(curve, theme));
        let items = self.posed(|mechanism| mechanism.items(plot, theme, ink));
        draw(area, &Drawing { class: "linkage", title: String::new(), items });
    }
}
