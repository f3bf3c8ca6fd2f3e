//! Composes the pages of a family.

use std::cell::LazyCell;
use std::rc::Rc;

use super::Captions;
use crate::find;
use crate::manifest::{Plan, PlannedFamily};
use coupler_curves::family::{Family, LengthUnit};
use coupler_curves::geometry::Point;
use coupler_curves::linkage::FourBar;
use coupler_curves::solve::{MovablePoint, SolvedCell, Solver};
use coupler_drawing::chart::{Chart, ChartData};
use coupler_drawing::page::{
    self, ChartPage, CouplerGridPage, Heading, Key, Layout, LinkLabel, Panel, PanelPage, PoseChoice,
};
use coupler_drawing::scene::Scene;
use coupler_find::BodyPose;

/// The labels of the links of a cell: the names of their lengths.
fn link_labels(family: &Family, solved: &SolvedCell) -> Vec<LinkLabel> {
    let joint = |name: &str| solved.linkage.find_joint(name);
    let label = |(ends, text): ([&str; 2], String)| {
        let [from, to] = ends.map(joint);
        Some(LinkLabel { joints: [from?, to?], text })
    };
    family.template.link_length_names().into_iter().filter_map(label).collect()
}

/// The first cell of a family that has a curve, of as many as are solved in an instant.
fn first_with_curve(family: &Family) -> Option<SolvedCell> {
    const MOST: usize = 64;
    let solver = Solver::new(family);
    let solve = |k: usize| solver.solve(k).filter(|solved| !solved.curves.is_empty());
    (0..family.cell_count().min(MOST)).find_map(solve)
}

/// Composes the pages of a family as scenes.
#[derive(Clone, Debug)]
pub struct Composer<'a> {
    /// The plan of the atlas.
    pub plan: &'a Plan,
    /// The family.
    pub planned: &'a PlannedFamily,
    /// The number of pages of the family.
    pub page_count: usize,
    /// How the linkages of the family are built.
    key: Key,
    /// The captions of its cells.
    pub captions: Captions<'a>,
    /// The title of its pages: that of the family, or of the chapter that they are in.
    title: &'a str,
}

impl<'a> Composer<'a> {
    /// A composer of a family's pages.
    pub fn new(plan: &'a Plan, planned: &'a PlannedFamily, page_count: usize) -> Composer<'a> {
        let family = &planned.family;
        Composer {
            plan,
            planned,
            page_count,
            key: Key::new(family),
            captions: Captions::new(planned),
            title: &family.title,
        }
    }

    /// A composer of the pages of a chapter with its title.
    #[cfg(feature = "pdf")]
    pub fn with_title(&self, title: &'a str) -> Composer<'a> {
        Composer { title, ..self.clone() }
    }

    /// What the pages of the family say of all its cells, which depends on all of them.
    pub fn common_text(&self) -> String {
        format!("{:?} {:?}", self.key.dimensions, self.planned.family.captions)
    }

    /// The panel of a cell.
    fn panel<'s>(&self, solved: &'s SolvedCell) -> Panel<'s> {
        let [caption, note] = self.captions.of_solved_cell(solved);
        let panel =
            Panel::new(solved).with_caption(caption).with_varying(self.captions.varying(&solved.cell)).with_note(note);
        let panel = panel.with_facts(page::cell_facts(&self.planned.family, solved)).with_ghosts(self.planned.ghosts);
        if self.planned.poses.is_empty() { panel } else { self.with_poses(panel) }
    }

    /// The panel with the poses of the family, and by how much its linkage misses them. A page of poses shows the linkage at the first of them.
    fn with_poses<'s>(&self, panel: Panel<'s>) -> Panel<'s> {
        let is_page_of_poses = self.planned.layout == Layout::Poses;
        let pose = |&[x, y, angle_deg]: &[f64; 3]| BodyPose { point: Point::new(x, y), angle_deg };
        let poses: Vec<BodyPose> = self.planned.poses.iter().map(pose).collect();
        let passing = find::passing(&poses, panel.solved_cell, is_page_of_poses);
        let panel = panel.with_body(find::guided_body(&poses, is_page_of_poses));
        let Some((text, joints)) = passing else { return panel };
        let note = if panel.note.is_empty() { text } else { format!("{} · {text}", panel.note) };
        let panel = panel.with_note(note);
        if is_page_of_poses { panel.with_pose(PoseChoice::Fixed(joints)) } else { panel }
    }

    /// Composes a page of panels; pages are counted from 1.
    pub fn panel_page(&self, page: usize, solved: &[SolvedCell]) -> Scene {
        let &Composer { plan, planned, .. } = self;
        let sheet = PanelPage {
            heading: self.heading(page, planned.source.clone()).with_dimensions(&self.key.dimensions),
            layout: planned.layout,
            panels: solved.iter().map(|solved| self.panel(solved)).collect(),
            scale: planned.scale,
            key: Some(&self.key),
        };
        page::compose_panels(&sheet, &plan.page)
    }

    /// The coupler-grid pages of a cell, the first of which has the number `page`. Each comes with its number, the
    /// indices of its curves, and a function that composes it.
    pub fn coupler_grid_pages<'s>(
        &'s self,
        page: usize,
        solved: &'s SolvedCell,
    ) -> impl Iterator<Item = (usize, Vec<usize>, impl FnOnce() -> Scene)> {
        let &Composer { plan, planned, .. } = self;
        let labels = Rc::new(link_labels(&planned.family, solved));
        let template = &planned.family.template;
        let coordinates = |trace| {
            let point = MovablePoint::of_trace(template, trace, &solved.cell.values)?;
            Some(point.coordinates.map(|coordinate| coordinate.value))
        };
        let coordinates: Rc<Vec<_>> = Rc::new((1..=template.curve_count()).map(coordinates).collect());
        // The lengths of a four-bar's links are all its dimensions.
        let is_four_bar = FourBar::from_linkage(&solved.linkage).is_some();
        let key = Rc::new((!is_four_bar).then(|| Key::for_cell(&planned.family, &solved.cell)));
        // All pages of a cell have the same pose; it is computed when the first of them is drawn.
        let pose =
            Rc::new(LazyCell::new(|| page::clearest_pose(solved).map_or(PoseChoice::Clearest, PoseChoice::Fixed)));
        (page..).zip(curves_by_page(solved)).map(move |(page, curve_indices)| {
            let (labels, key, pose) = (Rc::clone(&labels), Rc::clone(&key), Rc::clone(&pose));
            let coordinates = Rc::clone(&coordinates);
            let indices = curve_indices.clone();
            let compose = move || {
                let heading = self.heading(page, planned.source.clone());
                let panel = self.panel(solved).with_pose(PoseChoice::clone(&pose));
                let straight_criterion = planned.family.straight;
                let key = Option::as_ref(&key);
                let scale = planned.scale;
                let (labels, coordinates) = (&labels, &coordinates);
                let sheet = CouplerGridPage {
                    heading,
                    panel,
                    scale,
                    curve_indices,
                    coordinates,
                    labels,
                    key,
                    straight_criterion,
                };
                page::compose_coupler_grid(&sheet, &plan.page)
            };
            (page, indices, compose)
        })
    }

    /// Composes a page of charts.
    pub fn chart_page(&self, page: usize, chart: &Chart, data: &ChartData) -> Scene {
        let &Composer { plan, planned, .. } = self;
        let first = (page - 1) * planned.layout.cells_per_page();
        let mut source = vec![planned.source.clone()];
        if data.left_out_count > 0 {
            let ChartData { curve_count: curves, left_out_count: left_out, .. } = data;
            source.push(format!("only the first {} of {curves} curves are drawn", curves - left_out));
        }
        source.extend(planned.family.unit.map(LengthUnit::note));
        source.retain(|part| !part.is_empty());
        let solved = first_with_curve(&planned.family);
        let panel = solved.as_ref().map(Panel::new);
        let sheet = ChartPage {
            heading: self.heading(page, source.join(" · ")).with_dimensions(&self.key.dimensions),
            layout: planned.layout,
            chart,
            quantity_range: first..(first + planned.layout.cells_per_page()).min(chart.y.len()),
            series: &data.series,
            key: panel.as_ref().map(|panel| (&self.key, panel)),
        };
        page::compose_charts(&sheet, &plan.page)
    }

    /// The frontispiece of a book: a single panel of a cell.
    #[cfg(feature = "pdf")]
    pub fn frontispiece<'s>(&'s self, solved: &'s SolvedCell) -> PanelPage<'s> {
        let heading = self.heading(1, String::new());
        PanelPage {
            heading,
            layout: Layout::Panels { columns: 1, rows: 1 },
            panels: vec![self.panel(solved)],
            scale: page::PanelScale::Panel,
            key: None,
        }
    }

    fn heading(&self, page: usize, source: String) -> Heading<'_> {
        let &Composer { plan, planned, page_count, .. } = self;
        let Family { id, names, .. } = &planned.family;
        Heading::new(self.title)
            .with_family_id(id)
            .with_atlas_title(if plan.title == self.title { "" } else { &plan.title })
            .with_source(source)
            .with_symbols(names)
            .with_unit(planned.family.unit)
            .with_page(page, page_count)
    }
}

/// The indices of the curves on each coupler-grid page of a cell; a cell without curves has one page without curves.
pub fn curves_by_page(solved: &SolvedCell) -> Vec<Vec<usize>> {
    let pages = solved.curves_by_traces(Layout::POINTS_PER_PAGE);
    if pages.is_empty() { vec![Vec::new()] } else { pages }
}
