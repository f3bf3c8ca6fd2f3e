//! The figure of a cell: its curves, and the linkage that draws them.

use super::arrangement::{Arrangement, Extents, Frame};
use super::element::{Area, CouplerCurve, Drawing, draw};
use super::marks;
use super::mechanism::Mechanism;
use super::plot::{Plot, round_number};
use super::pose;
use super::theme::Theme;
use super::{Options, Panel, Sheet, View};
use crate::geometry::{Bounds, Point};
use crate::linkage::{Input, JointId};
use crate::motion::{self, Circuit, Dashes};
use crate::scene::{Circle, Color, Item, Line, Moving, Path};
use crate::sweep::{Curve, Solved};

/// A chord is nowhere further than this from its curve, in millimetres on paper.
const CHORD_ERROR: f64 = 0.01;

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
        let in_dashes = |plot: &Plot| {
            self.trail(area, plot, theme.hair, theme);
            self.marks(area, plot, theme);
            self.curves(area, plot, sheet, self.dash(options), theme);
        };
        let key = key.of(self.extents.key);
        key.bar(area, theme);
        self.underlay(area, &key, theme);
        if arrangement == Arrangement::Together {
            in_dashes(&key);
            self.linkage(area, &key, theme);
        } else {
            self.trail(area, &key, theme.fine, theme);
            self.linkage(area, &key, theme);
            let curve = curve.of(self.extents.curve);
            curve.bar(area, theme);
            in_dashes(&curve);
        }
    }

    /// The input a dash and its gap span: that asked for, or, of a length, a round part of what is used of it.
    fn dash(&self, options: &Options) -> f64 {
        if self.solved.linkage.input() != Input::Length {
            return options.dash_deg;
        }
        let passes = self.solved.motion.circuits.iter().flat_map(|circuit| &circuit.passes);
        round_number(passes.map(|pass| pass.length()).fold(0.0, f64::max) / 20.0)
    }

    /// The curves in dashes, each with its coupler point.
    fn curves(&self, area: &Area, plot: &Plot, sheet: &Sheet, period: f64, theme: &Theme) {
        let limits = self.limit_poses();
        // A dash is the first part of its period: of 5 degrees, as a rule, the first 3.
        let dashes = |curve: &Curve| Dashes { period, drawn: theme.curve_drawn(self.place(curve)) * period };
        for (curve, strokes) in self.solved.curves.iter().zip(self.strokes(plot, dashes)) {
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
                id: format!("{}-{cell}-{trace}-{circuit}", sheet.family),
                class: "curve",
                title: format!("{}, no. {cell}: {}", sheet.title, self.panel.caption),
                data: vec![("cell", cell.to_string()), ("trace", trace.to_string()), ("circuit", circuit.to_string())],
                strokes,
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
    fn trail(&self, area: &Area, plot: &Plot, weight: f64, theme: &Theme) {
        let mut items = Vec::new();
        // One stroke to a turn; of lengths, one to all there are.
        let ends = self.solved.motion.circuits.iter().flat_map(|circuit| &circuit.passes);
        let furthest = ends.map(|pass| pass.from.stop.at.max(pass.to.stop.at)).fold(0.0, f64::max);
        let whole = if self.solved.linkage.input() == Input::Length { 2.0 * furthest } else { 360.0 };
        let whole = Dashes { period: whole, drawn: whole };
        for (curve, strokes) in self.solved.curves.iter().zip(self.strokes(plot, |_| whole)) {
            let line = |points| Line { points, closed: false };
            let lines = strokes.into_iter().map(|stroke| line(stroke.points)).collect();
            let ink = theme.faded(self.ink(curve, theme));
            items.push(Item::Path(Path { lines, stroke: Some(theme.stroke(ink, weight)), fill: None }));
        }
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

    /// The strokes of every curve, in the order of the curves; those of one circuit with like dashes are found together.
    fn strokes(&self, plot: &Plot, dashes: impl Fn(&Curve) -> Dashes) -> Vec<Vec<motion::Stroke>> {
        let curves = &self.solved.curves;
        let tolerance = CHORD_ERROR / plot.page_from_plane.scale;
        let on_page = |stroke: motion::Stroke| motion::Stroke {
            points: stroke.points.into_iter().map(|p| plot.page_from_plane.apply(p)).collect(),
            ..stroke
        };
        let mut out = vec![Vec::new(); curves.len()];
        for (number, circuit) in (1..).zip(&self.solved.motion.circuits) {
            let mut left: Vec<usize> = (0..curves.len()).filter(|&k| curves[k].circuit == number).collect();
            while let Some(&first) = left.first() {
                let alike = dashes(&curves[first]);
                let (ours, others) = left.into_iter().partition::<Vec<_>, _>(|&k| dashes(&curves[k]) == alike);
                let joints: Vec<JointId> = ours.iter().map(|&k| curves[k].joint).collect();
                let strokes = motion::strokes(&self.solved.linkage, circuit, &joints, alike, tolerance);
                for (k, strokes) in ours.into_iter().zip(strokes) {
                    out[k] = strokes.into_iter().map(on_page).collect();
                }
                left = others;
            }
        }
        out
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
