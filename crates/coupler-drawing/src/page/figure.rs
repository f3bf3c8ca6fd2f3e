//! The figure of a cell: its curves and the linkage that traces them.

use super::area::Area;
use super::arrangement::{Arrangement, Extents};
use super::body::BodyDrawing;
use super::element::{CouplerCurve, Drawing, TextLine};
use super::extents;
use super::labels::{LabelPlacer, Obstacles, label_line};
use super::marks;
use super::mechanism::PosedMechanism;
use super::motion_marks::{MotionMarks, TickPoses, TickSteps};
use super::plot::{MAX_CURVE_ERROR, Plot, reduction_remark, round_number_below};
use super::pose;
use super::rect::Rect;
use super::symbols::{self, Mark, Symbol};
use super::theme::Theme;
use super::tolerance_band;
use super::{Options, Panel, PanelPage, PoseChoice};
use crate::mechanism::Mechanism;
use crate::scene::{Anchor, Animation, Circle, Color, Curve, Item, Stroke};
use coupler_curves::geometry::{Bounds, Point, Similarity, Vector};
use coupler_curves::linkage::{Input, JointId, Linkage};
use coupler_curves::motion::Circuit;
use coupler_curves::path::{self, DashPattern, JointPath};
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

/// The least width and height of a frame in which inputs are numbered, in ems of the numbers: in a smaller one they hide the
/// curve.
const MIN_NUMBERED_FRAME: [f64; 2] = [9.0, 5.0];

/// The least extent of a curve on which inputs are numbered, in ems of the numbers.
const MIN_NUMBERED_CURVE: f64 = 4.0;

/// The range of the input that a dash and its gap span: `dash_deg` for an angle; for a length, the greatest round
/// number up to a twentieth of the longest pass.
pub fn dash_period(linkage: &Linkage, circuits: &[Circuit], options: &Options) -> f64 {
    if linkage.input() != Input::Length {
        return options.dash_deg;
    }
    let passes = circuits.iter().flat_map(|circuit| &circuit.passes);
    round_number_below(passes.map(|pass| pass.input_length()).fold(0.0, f64::max) / 20.0)
}

/// The path of a curve of a cell on the page.
pub(super) fn curve_path(
    solved: &SolvedCell,
    curve: &MeasuredCurve,
    page_from_plane: Similarity,
    dashes: DashPattern,
) -> JointPath {
    let tolerance = MAX_CURVE_ERROR / page_from_plane.scale();
    let mut path = path::joint_path(&solved.linkage, solved.circuit(curve), curve.joint, dashes, tolerance);
    let splines = path.whole.iter_mut().chain(path.dashes.iter_mut().map(|dash| &mut dash.spline));
    splines.for_each(|spline| spline.transform(|point| page_from_plane.apply(point)));
    path
}

/// The number of a cell at the upper left of its panel.
pub(super) fn number_line(solved: &SolvedCell, theme: &Theme) -> TextLine {
    let at = Point::new(0.8 * theme.caption_size, theme.note_size);
    theme.text_line(&solved.cell.number.to_string(), at, Anchor::Start, theme.note_size, theme.grey)
}

/// The figure of a panel: curves, and the linkage in one pose or several.
pub(super) struct Figure<'a> {
    pub panel: &'a Panel<'a>,
    solved_cell: &'a SolvedCell,
    /// The linkage in one pose, or in all poses of an animation.
    pub mechanisms: Vec<PosedMechanism<'a>>,
    /// The duration of the animation.
    seconds: f64,
    /// The linkage at its limits, if it is drawn there.
    ghosts: Vec<PosedMechanism<'a>>,
    /// The circuits that are enlarged in one frame, by their numbers, in the order of the curves of `extents`.
    groups: Vec<Vec<usize>>,
    pub extents: Extents,
}

impl<'a> Figure<'a> {
    /// The figure of a panel; `None` if its cell has no curve.
    pub fn from_panel(panel: &'a Panel<'a>) -> Option<Figure<'a>> {
        let solved = panel.solved_cell;
        let first = solved.curves.first()?;
        let circuit = solved.circuit(first);
        let (poses, seconds) = match &panel.pose {
            PoseChoice::Clearest => (vec![pose::clearest_pose(&solved.linkage, circuit)], 0.0),
            PoseChoice::Fixed(pose) => (vec![pose.clone()], 0.0),
            PoseChoice::Animated { poses, seconds } => (poses.clone(), *seconds),
        };
        let parts = Mechanism::new(&solved.linkage, circuit);
        let mechanism = |pose| PosedMechanism::new(&solved.linkage, parts.clone(), pose);
        let ghosts = if panel.has_ghosts { pose::limits(solved, first) } else { Vec::new() };
        let [mechanisms, ghosts] = [poses, ghosts].map(|poses| poses.into_iter().map(mechanism).collect::<Vec<_>>());
        let groups = extents::circuit_groups(solved);
        let shown = || mechanisms.iter().chain(&ghosts);
        let with_linkage = |curves| {
            panel.body.bounds(shown().fold(curves, |whole: Bounds, mechanism| whole.union(mechanism.bounds())))
        };
        let extents = extents::of_groups(&groups, with_linkage);
        let groups = groups.into_iter().map(|(circuits, _)| circuits).collect();
        Some(Figure { panel, solved_cell: solved, mechanisms, seconds, ghosts, groups, extents })
    }

    /// The circuit of the first curve.
    pub fn first_circuit(&self) -> &Circuit {
        self.solved_cell.circuit(&self.solved_cell.curves[0])
    }

    /// The input in the pose in which the linkage is drawn, with its unit; `None` if that is between samples, or if there are several.
    pub fn pose_input(&self) -> Option<String> {
        let [only] = &self.mechanisms[..] else { return None };
        let input = self.first_circuit().input_of_pose(&only.pose)?;
        Some(marks::format_input(&self.solved_cell.linkage, input))
    }

    /// Items that depend on the pose, animated if there are several poses.
    fn posed_items(&self, items: impl Fn(&PosedMechanism) -> Vec<Item>) -> Vec<Item> {
        match &self.mechanisms[..] {
            [only] => items(only),
            all => vec![Item::Animation(Animation { frames: all.iter().map(items).collect(), seconds: self.seconds })],
        }
    }

    /// The arrangement of the figure if the one of its page is this: poses are drawn with curve and linkage at one scale.
    pub fn arrangement(
        &self,
        of_page: Arrangement,
        frame: Rect,
        scale: Option<f64>,
        themes: [&Theme; 2],
    ) -> Arrangement {
        if self.panel.body.poses.is_empty() {
            of_page.if_enlarging(frame, scale, themes, &self.extents)
        } else {
            Arrangement::Combined
        }
    }

    /// The scale at which the drawing of the linkage fits its frame, in millimetres to a unit.
    pub fn fitting_scale(&self, whole: Rect, arrangement: Arrangement, theme: &Theme) -> f64 {
        let [_, key] = arrangement.rects(whole).map(|frame| Plot::new(frame, theme));
        key.fitted_to(self.extents.linkage).page_from_plane.scale()
    }

    /// The range of the input that a dash and its gap span.
    pub fn dash_period(&self, options: &Options) -> f64 {
        dash_period(&self.solved_cell.linkage, &self.solved_cell.motion.circuits, options)
    }

    /// The length of the crank; `None` if an actuator drives the linkage.
    pub fn crank_length(&self) -> Option<f64> {
        self.solved_cell.linkage.crank_length()
    }

    /// Draws the figure in a frame of an area, with the linkage at a scale in millimetres to a unit, or as large as it fits.
    /// The first theme is for curves that are drawn apart from the linkage, the second for all else. The result is the greatest scale at
    /// which the linkage fits, and whether places of its body are outside the frame.
    pub fn draw(
        &self,
        area: &impl Area,
        whole: Rect,
        (arrangement, scale, period): (Arrangement, Option<f64>, f64),
        page: &PanelPage,
        [curve_theme, theme]: [&Theme; 2],
    ) -> (f64, bool) {
        let [frame, key] = arrangement.rects(whole);
        let key = Plot::new(key, theme);
        let in_dashes = |plot: &Plot,
                         curves: &[&MeasuredCurve],
                         (mut avoided, body): (Obstacles, Option<&BodyDrawing>),
                         theme: &Theme| {
            let paths = self.paths(plot, curves, period, theme);
            let axes = marks::symmetry_axis_items(self.solved_cell, curves, plot, theme);
            avoided.add(&axes, false);
            self.draw_marks(area, plot, curves, axes, theme);
            self.draw_motion_marks(area, plot, curves, (&paths, period), (avoided, body), theme);
            self.draw_curves(area, plot, page, curves, (paths, period), theme);
        };
        let (key, fitting) = key.at_scale(self.extents.linkage, scale);
        key.draw_scale_bar(area, page.heading.unit, &[reduction_remark(scale, fitting)], theme);
        self.draw_underlay(area, &key, theme);
        let number = number_line(self.solved_cell, theme).text;
        let above = number.position - Vector::new(0.0, 0.36 * number.size);
        let mut with_number = Obstacles::default();
        with_number.add_points(&[above, above + Vector::new(number.width(), 0.0)], 0.72 * number.size, false);
        if arrangement == Arrangement::Combined {
            let linkage = self.linkage_items(&key, theme);
            let mut obstacles = with_number;
            obstacles.add(&linkage, false);
            // Numbers in small panels would be on the line of the frame.
            obstacles.add(&self.posed_items(|mechanism| mechanism.underlay_items(&key, theme)), false);
            let mut body = BodyDrawing::new(&self.panel.body, &key, theme);
            body.add_to(&mut obstacles);
            body.draw(area);
            let curves: Vec<&MeasuredCurve> = self.solved_cell.curves.iter().collect();
            in_dashes(&key, &curves, (obstacles, Some(&body)), theme);
            draw_linkage(area, linkage);
            (fitting, body.has_places_beyond)
        } else {
            self.draw_key_curves(area, &key, theme);
            draw_linkage(area, self.linkage_items(&key, theme));
            let frames = frame.divide(self.groups.len());
            // The number is in the first frame.
            let mut obstacles = Some(with_number);
            for ((circuits, bounds), frame) in self.groups.iter().zip(&self.extents.curves).zip(frames) {
                let plot = Plot::new(frame, curve_theme).fitted_to(*bounds);
                let enlargement = plot.page_from_plane.scale() / key.page_from_plane.scale();
                let factor = marks::format_with_digits(enlargement, 2);
                let remarks = [format!(", enlarged × {factor}"), format!(", × {factor}")];
                plot.draw_scale_bar(area, page.heading.unit, &remarks, curve_theme);
                let curves = self.solved_cell.curves.iter().filter(|curve| circuits.contains(&curve.circuit));
                in_dashes(
                    &plot,
                    &curves.collect::<Vec<_>>(),
                    (obstacles.take().unwrap_or_default(), None),
                    curve_theme,
                );
            }
            (fitting, false)
        }
    }

    /// Draws the curves as hairlines with dashes, and their coupler points.
    fn draw_curves(
        &self,
        area: &impl Area,
        plot: &Plot,
        page: &PanelPage,
        curves: &[&MeasuredCurve],
        (paths, period): (Vec<JointPath>, f64),
        theme: &Theme,
    ) {
        let limits = self.limit_poses();
        for (curve, path) in curves.iter().zip(paths) {
            let stroke = theme.curve_stroke(self.style_index(curve));
            let stroke = if self.is_finer(curve) { finer(stroke) } else { stroke };
            let ink = stroke.color;
            let MeasuredCurve { trace, circuit, joint, .. } = curve;
            let dot = |pose: &Vec<Point>| Circle {
                centre: plot.page_from_plane.apply(pose[*joint]),
                radius: 0.5 * theme.joint_radius,
                stroke: None,
                fill: Some(ink),
            };
            let cell = self.solved_cell.cell.number;
            let element = CouplerCurve {
                id: format!("{}-{cell}-{trace}-{circuit}", page.heading.family_id),
                class: "curve",
                title: format!("{}, no. {cell}: {}", page.heading.family_title, self.panel.caption),
                data: [("cell", &cell), ("trace", trace), ("circuit", circuit)]
                    .map(|(name, number)| (name, number.to_string()))
                    .into_iter()
                    .chain(page.heading.unit_data())
                    .collect(),
                page_from_plane: plot.page_from_plane,
                dashes: self.dashes(curve, period, theme),
                path,
                hairline: theme.stroke(theme.faded(ink), theme.hair_width),
                stroke_styles: [stroke, theme.stroke(theme.faded(ink), theme.fine_width)],
                // A dot marks each limit of the input.
                marks: limits[circuit - 1].iter().map(dot).collect(),
            };
            area.record(element);
        }
        let points = self.coupler_point_items(plot, curves, theme);
        area.record(Drawing { class: "coupler-point", title: String::new(), items: points });
    }

    /// Draws the curves of the key as light solid lines.
    fn draw_key_curves(&self, area: &impl Area, plot: &Plot, theme: &Theme) {
        let solved = self.solved_cell;
        let tolerance = MAX_CURVE_ERROR / plot.page_from_plane.scale();
        let solid = |curve: &MeasuredCurve| {
            let mut splines = path::joint_splines(&solved.linkage, solved.circuit(curve), curve.joint, tolerance);
            splines.iter_mut().for_each(|spline| spline.transform(|point| plot.page_from_plane.apply(point)));
            let ink = theme.faded(self.curve_ink(curve, theme));
            Item::Curve(Curve { splines, stroke: theme.stroke(ink, theme.fine_width) })
        };
        let items = solved.curves.iter().map(solid).collect();
        area.record(Drawing { class: "trail", title: String::new(), items });
    }

    /// Draws the marks of the curves: axes of symmetry and straight portions.
    fn draw_marks(&self, area: &impl Area, plot: &Plot, curves: &[&MeasuredCurve], axes: Vec<Item>, theme: &Theme) {
        area.record(Drawing { class: "axis", title: String::new(), items: axes });
        let band = |curve: &&MeasuredCurve| {
            tolerance_band::item(self.solved_cell, curve, self.curve_ink(curve, theme), plot, theme)
        };
        let items: Vec<Item> = curves.iter().filter_map(band).collect();
        if !items.is_empty() {
            area.record(Drawing { class: "tolerance", title: String::new(), items });
        }
        let portion = |curve: &&MeasuredCurve| {
            marks::straight_portion_item(self.solved_cell, curve, self.curve_ink(curve, theme), plot, theme)
        };
        let items = curves.iter().filter_map(portion).collect();
        area.record(Drawing { class: "straight", title: String::new(), items });
    }

    /// Draws the start, the direction and the ticks of each curve, with numbers where they are clear of the `obstacles`
    /// and the curves, after those of a body.
    fn draw_motion_marks(
        &self,
        area: &impl Area,
        plot: &Plot,
        curves: &[&MeasuredCurve],
        (paths, period): (&[JointPath], f64),
        (mut obstacles, body): (Obstacles, Option<&BodyDrawing>),
        theme: &Theme,
    ) {
        let solved = self.solved_cell;
        let steps = TickSteps::new(&solved.linkage, period);
        let poses = |circuit: &Circuit| TickPoses::new(&solved.linkage, circuit, steps);
        let poses: Vec<TickPoses> = solved.motion.circuits.iter().map(poses).collect();
        let marks = |curve: &&MeasuredCurve| {
            MotionMarks::new(&poses[curve.circuit - 1], curve.joint, plot, self.curve_ink(curve, theme), theme)
        };
        let mut marks: Vec<MotionMarks> = curves.iter().map(marks).collect();
        let least_size = MIN_NUMBERED_CURVE * theme.small_size();
        let lines: Vec<Vec<Point>> = paths.iter().map(label_line).collect();
        let is_large = |line: &Vec<Point>| Bounds::from_points(line.iter().copied()).size().max() >= least_size;
        let is_numbered: Vec<bool> = lines.iter().map(is_large).collect();
        lines.iter().for_each(|line| obstacles.add_points(line, theme.curve_width, false));
        for marks in &mut marks {
            obstacles.add(&marks.items, false);
            let items = std::mem::take(&mut marks.items);
            area.record(Drawing { class: "motion", title: String::new(), items });
        }
        let frame = plot.rect_above_scale_bar(theme);
        // Numbers next to each other would read as one.
        let gap = (0.6 * theme.joint_radius).max(0.3 * theme.small_size());
        let mut placer = LabelPlacer::new(&obstacles, frame, theme).with_placed(Vec::new(), gap);
        if let Some(body) = body.filter(|body| !body.is_empty()) {
            body.draw_labels(area, &mut placer, theme);
        }
        let least = MIN_NUMBERED_FRAME.map(|ems| ems * theme.small_size());
        if frame.size.x >= least[0] && frame.size.y >= least[1] {
            let marks = marks.into_iter().zip(is_numbered).filter(|(_, is_numbered)| *is_numbered);
            let marks = marks.map(|(marks, _)| marks).collect();
            area.record(MotionMarks::place_numbers(marks, &mut placer, theme));
        }
    }

    /// The paths of curves, in their order.
    fn paths(&self, plot: &Plot, curves: &[&MeasuredCurve], period: f64, theme: &Theme) -> Vec<JointPath> {
        let path = |curve: &&MeasuredCurve| {
            curve_path(self.solved_cell, curve, plot.page_from_plane, self.dashes(curve, period, theme))
        };
        curves.iter().map(path).collect()
    }

    /// The dashes of a curve: by default a dash is the first 3 degrees of a period of 5.
    fn dashes(&self, curve: &MeasuredCurve, period: f64, theme: &Theme) -> DashPattern {
        DashPattern { period, dash_span: theme.curve_dash_fraction(self.style_index(curve)) * period }
    }

    /// The index of the ink and style of a curve: by circuit if the linkage has one traced joint, otherwise by traced
    /// joint.
    fn style_index(&self, curve: &MeasuredCurve) -> usize {
        let one_trace = self.solved_cell.linkage.traced.len() == 1;
        if one_trace { curve.circuit - 1 } else { curve.trace - 1 }
    }

    /// Whether a curve is finer than others, as it is on another circuit than the linkage, and in the ink of its point.
    fn is_finer(&self, curve: &MeasuredCurve) -> bool {
        self.solved_cell.linkage.traced.len() > 1 && curve.circuit != self.solved_cell.curves[0].circuit
    }

    fn curve_ink(&self, curve: &MeasuredCurve, theme: &Theme) -> Color {
        theme.curve_ink(self.style_index(curve))
    }

    /// The poses at the limits of the input, by circuit.
    fn limit_poses(&self) -> Vec<Vec<Vec<Point>>> {
        let circuits = self.solved_cell.motion.circuits.iter();
        circuits.map(|circuit| pose::limit_poses(&self.solved_cell.linkage, circuit)).collect()
    }

    /// The traced points of curves in the pose, which is on the circuit of the first curve.
    fn coupler_point_items(&self, plot: &Plot, curves: &[&MeasuredCurve], theme: &Theme) -> Vec<Item> {
        let mut posed: Vec<&MeasuredCurve> = Vec::new();
        for curve in curves.iter().filter(|curve| curve.circuit == self.solved_cell.curves[0].circuit) {
            if posed.iter().all(|other| other.joint != curve.joint) {
                posed.push(curve);
            }
        }
        let circle = |curve: &MeasuredCurve, mechanism: &PosedMechanism| {
            let stroke = Some(theme.stroke(self.curve_ink(curve, theme), theme.fine_width));
            let centre = plot.page_from_plane.apply(mechanism.pose[curve.joint]);
            Item::Circle(Circle { centre, radius: theme.joint_radius, stroke, fill: Some(theme.paper) })
        };
        self.posed_items(|mechanism| posed.iter().map(|curve| circle(curve, mechanism)).collect())
    }

    fn draw_underlay(&self, area: &impl Area, plot: &Plot, theme: &Theme) {
        let ghosts: Vec<Item> = self.ghosts.iter().flat_map(|ghost| ghost.ghost_items(plot, theme)).collect();
        if !ghosts.is_empty() {
            area.record(Drawing { class: "ghost", title: String::new(), items: ghosts });
        }
        let items = self.posed_items(|mechanism| mechanism.underlay_items(plot, theme));
        area.record(Drawing { class: "underlay", title: String::new(), items });
    }

    fn linkage_items(&self, plot: &Plot, theme: &Theme) -> Vec<Item> {
        self.posed_items(|mechanism| mechanism.linkage_items(plot, theme, |joint| self.joint_ink(joint, theme)))
    }

    /// The ink of a joint: that of its curve if it is traced.
    pub fn joint_ink(&self, joint: JointId, theme: &Theme) -> Color {
        let traced = self.solved_cell.curves.iter().find(|curve| curve.joint == joint);
        traced.map_or(theme.ink, |curve| self.curve_ink(curve, theme))
    }

    /// The ink of the first curve.
    pub fn first_ink(&self, theme: &Theme) -> Color {
        self.curve_ink(&self.solved_cell.curves[0], theme)
    }

    /// The ink of the first curve that has its straight portion marked.
    pub fn band_ink(&self, theme: &Theme) -> Option<Color> {
        let is_marked = |curve: &&MeasuredCurve| marks::visible_straight_portion(self.solved_cell, curve).is_some();
        self.solved_cell.curves.iter().find(is_marked).map(|curve| self.curve_ink(curve, theme))
    }

    /// The symbols that explain the figure; `period` is that of dashes.
    pub fn symbols(&self, period: f64, theme: &Theme) -> Vec<Symbol> {
        let solved = self.solved_cell;
        let Some(first) = solved.curves.first() else { return Vec::new() };
        let ink = self.curve_ink(first, theme);
        let mut symbols = symbols::of_cell(solved, ink, period);
        symbols.extend(symbols::of_chains(&solved.linkage, theme));
        let mut add = |mark: Mark, meaning: &str| symbols.push(Symbol { mark, meaning: meaning.to_owned() });
        let inks = theme.curve_inks.len();
        for (style, ordinal) in (0..inks).zip(["first", "second", "third", "fourth", "fifth"]) {
            // Of more curves than inks, several have one.
            let curves = solved.curves.iter().filter(|curve| self.style_index(curve) % inks == style);
            let curves: Vec<&MeasuredCurve> = curves.collect();
            // A plate of one curve has none of the points before it.
            let Some(first) = curves.first() else { continue };
            // In the order of the curves, so that M2 is before M10.
            let mut names: Vec<[String; 2]> = Vec::new();
            for name in curves.iter().filter_map(|curve| marks::path_name(solved, curve)) {
                if !names.contains(&name) {
                    names.push(name);
                }
            }
            let mut circuits: Vec<usize> = curves.iter().map(|curve| curve.circuit).collect();
            circuits.dedup();
            let numbered = |nouns: &str, numbers: Vec<String>| format!("{nouns} {}", numbers.join(", "));
            let what = match (&names[..], circuits.len()) {
                ([], 1) if style == 0 => continue,
                ([], 1) => format!("{ordinal} circuit"),
                ([], _) => numbered("circuits", circuits.iter().map(usize::to_string).collect()),
                ([_, _, ..], _) if names.iter().all(|[words, _]| words == "point") => {
                    numbered("points", names.into_iter().map(|[_, number]| number).collect())
                }
                _ => names.iter().map(|name| name.join(" ")).collect::<Vec<_>>().join(", "),
            };
            add(Mark::Dashes(self.curve_ink(first, theme)), &what);
        }
        if solved.curves.iter().any(|curve| self.is_finer(curve)) {
            add(Mark::Line(finer(theme.stroke(ink, theme.curve_width))), "finer: other circuits");
        }
        if solved.motion.circuits.iter().any(|circuit| !circuit.is_full_turn()) {
            add(Mark::Limit(ink), "limit of the input");
        }
        if solved.linkage.motion_options.figure_arc.is_some() {
            add(Mark::Light(ink), "outside the figure of the source");
        }
        if !self.ghosts.is_empty() {
            add(Mark::Ghost, "linkage at its limits");
        }
        if marks::has_symmetry_axis(solved) {
            add(Mark::Axis, "axis of symmetry");
        }
        symbols.extend(tolerance_band::symbol(solved, |curve| self.curve_ink(curve, theme), theme));
        symbols.extend(symbols::of_body(&self.panel.body, theme));
        symbols
    }
}

/// The stroke of curves that are finer than others.
fn finer(stroke: Stroke) -> Stroke {
    const PART: f64 = 0.5;
    Stroke { width: PART * stroke.width, ..stroke }
}

fn draw_linkage(area: &impl Area, items: Vec<Item>) {
    area.record(Drawing { class: "linkage", title: String::new(), items });
}
