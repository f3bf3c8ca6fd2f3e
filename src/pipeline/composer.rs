//! What the pages of a family show.

use std::cell::LazyCell;
use std::rc::Rc;

use crate::manifest::{Plan, PlannedFamily};
use coupler_curves::family::Family;
use coupler_curves::solve::SolvedCell;
use coupler_drawing::chart::{Chart, ChartData};
use coupler_drawing::page::{
    self, ChartPage, CouplerGridPage, Heading, Layout, LinkLabel, Panel, PanelPage, PoseChoice,
};
use coupler_drawing::scene::Scene;

/// A cell with its lines.
fn panel<'s>(family: &Family, solved: &'s SolvedCell) -> Panel<'s> {
    let [caption, note] = family.format_captions(&solved.cell, solved.first_curve_values());
    Panel {
        link_inks: Vec::new(),
        caption,
        note,
        facts: page::cell_facts(solved),
        solved_cell: solved,
        pose: PoseChoice::Clearest,
    }
}

/// What the links of a cell are called.
fn link_labels(family: &Family, solved: &SolvedCell) -> Vec<LinkLabel> {
    let joint = |name: &str| solved.linkage.joints.iter().position(|joint| joint.name == name);
    let label = |(ends, text): ([&str; 2], String)| {
        let [from, to] = ends.map(joint);
        Some(LinkLabel { joints: [from?, to?], text })
    };
    family.template.link_length_names().into_iter().filter_map(label).collect()
}

/// What the pages of a family show, before they are rendered.
#[derive(Clone, Copy, Debug)]
pub struct Composer<'a> {
    /// The plan the family is of.
    pub plan: &'a Plan,
    /// The family.
    pub planned: &'a PlannedFamily,
    /// How many pages there are.
    pub page_count: usize,
}

impl Composer<'_> {
    /// A page of panels; pages are counted from 1.
    pub fn panel_page(&self, page: usize, solved: &[SolvedCell]) -> Scene {
        let Composer { plan, planned, .. } = *self;
        let sheet = PanelPage {
            heading: self.heading(page, source_line(planned, plan.page.dash_deg)),
            layout: planned.layout,
            panels: solved.iter().map(|solved| panel(&planned.family, solved)).collect(),
        };
        page::compose_panels(&sheet, &plan.page)
    }

    /// The pages of a coupler grid, of which the first has this number: for each, its number, the places of the curves on
    /// it, and how it is composed.
    pub fn coupler_grid_pages<'s>(
        &'s self,
        page: usize,
        solved: &'s SolvedCell,
    ) -> impl Iterator<Item = (usize, Vec<usize>, impl FnOnce() -> Scene)> {
        let Composer { plan, planned, .. } = *self;
        let labels = Rc::new(link_labels(&planned.family, solved));
        // One pose for all pages of a cell, sought for the first that is drawn.
        let view =
            Rc::new(LazyCell::new(|| page::clearest_pose(solved).map_or(PoseChoice::Clearest, PoseChoice::Fixed)));
        (page..).zip(curves_by_page(solved)).map(move |(page, shown)| {
            let (labels, view, places) = (Rc::clone(&labels), Rc::clone(&view), shown.clone());
            let compose = move || {
                let heading = self.heading(page, planned.source.clone());
                let panel = Panel { pose: PoseChoice::clone(&view), ..panel(&planned.family, solved) };
                page::compose_coupler_grid(
                    &CouplerGridPage { heading, panel, curve_indices: shown, labels: &labels },
                    &plan.page,
                )
            };
            (page, places, compose)
        })
    }

    /// A page of charts.
    pub fn chart_page(&self, page: usize, chart: &Chart, gathered: &ChartData) -> Scene {
        let Composer { plan, planned, .. } = *self;
        let first = (page - 1) * planned.layout.cells_per_page();
        let mut source = vec![planned.source.clone()];
        if gathered.left_out_count > 0 {
            let ChartData { curve_count: curves, left_out_count: left_out, .. } = gathered;
            source.push(format!("only the first {} of {curves} curves are drawn", curves - left_out));
        }
        source.retain(|part| !part.is_empty());
        let sheet = ChartPage {
            heading: self.heading(page, source.join(" · ")),
            layout: planned.layout,
            chart,
            quantity_range: first..(first + planned.layout.cells_per_page()).min(chart.y.len()),
            series: &gathered.series,
        };
        page::compose_charts(&sheet, &plan.page)
    }

    /// A plate of one cell for a title page: of a coupler grid, with the curves of one page.
    pub fn frontispiece<'s>(&'s self, solved: &'s SolvedCell) -> PanelPage<'s> {
        let heading = self.heading(1, String::new());
        PanelPage {
            heading,
            layout: Layout::Panels { columns: 1, rows: 1 },
            panels: vec![panel(&self.planned.family, solved)],
        }
    }

    fn heading(&self, page: usize, source: String) -> Heading<'_> {
        let Composer { plan, planned, page_count: of } = *self;
        let Family { id, title, names, .. } = &planned.family;
        Heading {
            atlas_title: &plan.title,
            family_id: id,
            family_title: title,
            source,
            symbols: names,
            page,
            page_count: of,
        }
    }
}

/// The curves of a cell, by the pages of a coupler grid they are on; a cell that is not assembled has a page that says so.
pub fn curves_by_page(solved: &SolvedCell) -> Vec<Vec<usize>> {
    let shown = solved.curves_by_traces(Layout::POINTS_PER_PAGE);
    if shown.is_empty() { vec![Vec::new()] } else { shown }
}

/// Where the linkage comes from, and how a page is to be read.
fn source_line(planned: &PlannedFamily, dash_deg: f64) -> String {
    let dashes = match planned.family.template.is_driven_by_length() {
        true => "a dash and its gap span equal lengths of the actuator".to_owned(),
        false => format!("one dash and its gap = {dash_deg}° of input"),
    };
    let key = format!("{dashes} · scale bars in units of length");
    if planned.source.is_empty() { key } else { format!("{} · {key}", planned.source) }
}
