//! The figure of a cell: its curves, and the linkage that draws them.

use super::arrangement::{Arrangement, Extents, Frame};
use super::element::{Area, CouplerCurve, Drawing, draw};
use super::mechanism::Mechanism;
use super::plot::Plot;
use super::pose;
use super::theme::Theme;
use super::{Options, Panel, Sheet};
use crate::geometry::Bounds;
use crate::motion::{self, Dashes};
use crate::scene::{Circle, Color, Item, Line, Path};
use crate::sweep::{Curve, Solved};

/// A chord is nowhere further than this from its curve, in millimetres on paper.
const CHORD_ERROR: f64 = 0.01;

/// A cell with the pose its linkage is drawn in.
pub(super) struct Figure<'a> {
    pub panel: &'a Panel<'a>,
    solved: &'a Solved,
    mechanism: Mechanism<'a>,
    pub extents: Extents,
}

impl<'a> Figure<'a> {
    /// The figure of a cell; `None` where it has no curve.
    pub fn of(panel: &'a Panel<'a>) -> Option<Figure<'a>> {
        let solved = panel.solved;
        let first = solved.curves.first()?;
        let circuit = solved.circuit(first);
        let pose = pose::clearest(&solved.linkage, circuit);
        let mechanism = Mechanism::new(&solved.linkage, circuit, pose);
        let curve = Bounds::of(solved.curves.iter().flat_map(|curve| solved.circuit(curve).points(curve.joint)));
        let key = mechanism.bounds().union(curve);
        Some(Figure { panel, solved, mechanism, extents: Extents { curve, key } })
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
        let period = options.dash_deg;
        // A dash spans three fifths of its period: the first 3 of 5 degrees.
        let dashes = Dashes { period, drawn: 0.6 * period };
        if arrangement == Arrangement::Together {
            let plot = key.of(self.extents.key);
            plot.bar(area, theme);
            self.underlay(area, &plot, theme);
            self.trail(area, &plot, theme.hair, theme);
            self.curves(area, &plot, sheet, dashes, theme);
            self.linkage(area, &plot, theme);
            return;
        }
        let plot = key.of(self.extents.key);
        plot.bar(area, theme);
        self.underlay(area, &plot, theme);
        self.trail(area, &plot, theme.fine, theme);
        self.linkage(area, &plot, theme);
        let plot = curve.of(self.extents.curve);
        plot.bar(area, theme);
        self.trail(area, &plot, theme.hair, theme);
        self.curves(area, &plot, sheet, dashes, theme);
    }

    /// The curves in dashes, each with its coupler point.
    fn curves(&self, area: &Area, plot: &Plot, sheet: &Sheet, dashes: Dashes, theme: &Theme) {
        for curve in &self.solved.curves {
            let ink = self.ink(curve, theme);
            let strokes = self.strokes(curve, plot, dashes);
            let Curve { trace, circuit, .. } = curve;
            let cell = self.solved.cell.number;
            let element = CouplerCurve {
                id: format!("{}-{cell}-{trace}-{circuit}", sheet.family),
                class: "curve",
                title: format!("{}, no. {cell}: {}", sheet.title, self.panel.caption),
                data: vec![("cell", cell.to_string()), ("trace", trace.to_string()), ("circuit", circuit.to_string())],
                strokes,
                weights: [theme.stroke(ink, theme.curve), theme.stroke(theme.faded(ink), theme.fine)],
                marks: self.limits(curve, plot, ink, theme),
            };
            draw(area, &element);
        }
        let points = self.traced_points(plot, theme);
        draw(area, &Drawing { class: "coupler-point", title: String::new(), items: points });
    }

    /// The curves as light unbroken lines: beside the linkage, and under the dashes to lead the eye over their gaps.
    fn trail(&self, area: &Area, plot: &Plot, weight: f64, theme: &Theme) {
        let mut items = Vec::new();
        for curve in &self.solved.curves {
            let whole = Dashes { period: 360.0, drawn: 360.0 };
            let line = |points| Line { points, closed: false };
            let lines = self.strokes(curve, plot, whole).into_iter().map(|stroke| line(stroke.points)).collect();
            let ink = theme.faded(self.ink(curve, theme));
            items.push(Item::Path(Path { lines, stroke: Some(theme.stroke(ink, weight)), fill: None }));
        }
        draw(area, &Drawing { class: "trail", title: String::new(), items });
    }

    fn strokes(&self, curve: &Curve, plot: &Plot, dashes: Dashes) -> Vec<motion::Stroke> {
        let circuit = self.solved.circuit(curve);
        let tolerance = CHORD_ERROR / plot.page_from_plane.scale;
        let strokes = motion::strokes(&self.solved.linkage, circuit, &[curve.joint], dashes, tolerance);
        let on_page = |stroke: motion::Stroke| motion::Stroke {
            points: stroke.points.into_iter().map(|p| plot.page_from_plane.apply(p)).collect(),
            ..stroke
        };
        strokes.into_iter().flatten().map(on_page).collect()
    }

    /// Curves of one traced joint are told apart by circuit, those of several by trace.
    fn ink(&self, curve: &Curve, theme: &Theme) -> Color {
        let one_trace = self.solved.linkage.traced.len() == 1;
        theme.curve_ink(if one_trace { curve.circuit - 1 } else { curve.trace - 1 })
    }

    /// A dot at each limit of the input.
    fn limits(&self, curve: &Curve, plot: &Plot, ink: Color, theme: &Theme) -> Vec<Circle> {
        let circuit = self.solved.circuit(curve);
        let n = circuit.passes.len();
        let turns = |k: usize| circuit.passes[k].heading() != circuit.passes[(k + 1) % n].heading();
        let ends = (0..n).filter(|&k| n > 1 && turns(k) && !circuit.passes[k].to.flat.is_none());
        let place = |k: usize| {
            let pass = &circuit.passes[k];
            motion::pose(&self.solved.linkage, pass, pass.to.stop.at)[curve.joint]
        };
        let dot = |k: usize| Circle {
            centre: plot.page_from_plane.apply(place(k)),
            radius: 0.5 * theme.joint,
            stroke: None,
            fill: Some(ink),
        };
        ends.map(dot).collect()
    }

    fn traced_points(&self, plot: &Plot, theme: &Theme) -> Vec<Item> {
        let mut done = Vec::new();
        let mut items = Vec::new();
        for curve in self.solved.curves.iter().filter(|curve| curve.circuit == self.solved.curves[0].circuit) {
            if !done.contains(&curve.joint) {
                done.push(curve.joint);
                let stroke = Some(theme.stroke(self.ink(curve, theme), theme.fine));
                let centre = plot.page_from_plane.apply(self.mechanism.pose[curve.joint]);
                items.push(Item::Circle(Circle { centre, radius: theme.joint, stroke, fill: Some(theme.paper) }));
            }
        }
        items
    }

    fn underlay(&self, area: &Area, plot: &Plot, theme: &Theme) {
        let items = self.mechanism.underlay(plot, theme);
        draw(area, &Drawing { class: "underlay", title: String::new(), items });
    }

    fn linkage(&self, area: &Area, plot: &Plot, theme: &Theme) {
        let traced = |joint| self.solved.curves.iter().find(|curve| curve.joint == joint);
        let ink = |joint| traced(joint).map_or(theme.ink, |curve| self.ink(curve, theme));
        let items = self.mechanism.items(plot, theme, ink);
        draw(area, &Drawing { class: "linkage", title: String::new(), items });
    }
}
