//! What the pages of a family show.

use std::cell::LazyCell;
use std::rc::Rc;

use crate::manifest::{Plan, PlannedFamily};
use coupler_curves::family::Family;
use coupler_curves::solve::Solved;
use coupler_drawing::chart::{Chart, Gathered};
use coupler_drawing::page::{self, ChartSheet, GridSheet, Heading, Label, Layout, Panel, Sheet, View};
use coupler_drawing::scene::Scene;

/// A cell with its lines.
fn panel<'s>(family: &Family, solved: &'s Solved) -> Panel<'s> {
    let [caption, note] = family.describe(&solved.cell, solved.measures());
    Panel { inks: Vec::new(), caption, note, facts: page::facts(solved), solved, view: View::Clearest }
}

/// What the links of a cell are called.
fn labels(family: &Family, solved: &Solved) -> Vec<Label> {
    let joint = |name: &str| solved.linkage.joints.iter().position(|joint| joint.name == name);
    let label = |(ends, text): ([&str; 2], String)| {
        let [from, to] = ends.map(joint);
        Some(Label { ends: [from?, to?], text })
    };
    family.template.lengths().into_iter().filter_map(label).collect()
}

/// What the pages of a family show, before they are rendered.
#[derive(Clone, Copy, Debug)]
pub struct Composer<'a> {
    /// The plan the family is of.
    pub plan: &'a Plan,
    /// The family.
    pub planned: &'a PlannedFamily,
    /// How many pages there are.
    pub of: usize,
}

impl Composer<'_> {
    /// A page of panels; pages are counted from 1.
    pub fn panels(&self, page: usize, solved: &[Solved]) -> Scene {
        let Composer { plan, planned, .. } = *self;
        let sheet = Sheet {
            heading: self.heading(page, source_line(planned, plan.page.dash_deg)),
            layout: planned.layout,
            panels: solved.iter().map(|solved| panel(&planned.family, solved)).collect(),
        };
        page::compose(&sheet, &plan.page)
    }

    /// The pages of a coupler grid, of which the first has this number: for each, its number, the places of the curves on
    /// it, and how it is composed.
    pub fn grids<'s>(
        &'s self,
        page: usize,
        solved: &'s Solved,
    ) -> impl Iterator<Item = (usize, Vec<usize>, impl FnOnce() -> Scene)> {
        let Composer { plan, planned, .. } = *self;
        let labels = Rc::new(labels(&planned.family, solved));
        // One pose for all pages of a cell, sought for the first that is drawn.
        let view = Rc::new(LazyCell::new(|| page::clearest_pose(solved).map_or(View::Clearest, View::At)));
        (page..).zip(leaves(solved)).map(move |(page, shown)| {
            let (labels, view, places) = (Rc::clone(&labels), Rc::clone(&view), shown.clone());
            let compose = move || {
                let heading = self.heading(page, planned.source.clone());
                let panel = Panel { view: View::clone(&view), ..panel(&planned.family, solved) };
                page::compose_grid(&GridSheet { heading, panel, shown, labels: &labels }, &plan.page)
            };
            (page, places, compose)
        })
    }

    /// A page of charts.
    pub fn charts(&self, page: usize, chart: &Chart, gathered: &Gathered) -> Scene {
        let Composer { plan, planned, .. } = *self;
        let first = (page - 1) * planned.layout.cells();
        let mut source = vec![planned.source.clone()];
        if gathered.left_out > 0 {
            let Gathered { curves, left_out, .. } = gathered;
            source.push(format!("only the first {} of {curves} curves are drawn", curves - left_out));
        }
        source.retain(|part| !part.is_empty());
        let sheet = ChartSheet {
            heading: self.heading(page, source.join(" · ")),
            layout: planned.layout,
            chart,
            shown: first..(first + planned.layout.cells()).min(chart.y.len()),
            series: &gathered.series,
        };
        page::compose_charts(&sheet, &plan.page)
    }

    /// A plate of one cell for a title page: of a coupler grid, with the curves of one page.
    pub fn frontispiece<'s>(&'s self, solved: &'s Solved) -> Sheet<'s> {
        let heading = self.heading(1, String::new());
        Sheet {
            heading,
            layout: Layout::Panels { columns: 1, rows: 1 },
            panels: vec![panel(&self.planned.family, solved)],
        }
    }

    fn heading(&self, page: usize, source: String) -> Heading<'_> {
        let Composer { plan, planned, of } = *self;
        let Family { id, title, names, .. } = &planned.family;
        Heading { atlas: &plan.title, family: id, title, source, symbols: names, page, of }
    }
}

/// The curves of a cell, by the pages of a coupler grid they are on; a cell that is not assembled has a page that says so.
pub fn leaves(solved: &Solved) -> Vec<Vec<usize>> {
    let shown = solved.by_points(Layout::POINTS);
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
