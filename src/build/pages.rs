//! The pages of a family, composed and rendered.

use super::Error;
use crate::chart::{Chart, Gathered};
use crate::family::Family;
use crate::manifest::{Plan, PlannedFamily};
use crate::page::{self, ChartSheet, GridSheet, Heading, Label, Layout, Panel, Sheet, View};
use crate::record::FileRecord;
use crate::render::{self, Format};
use crate::scene::Scene;
use crate::sweep::Solved;

/// A page in each format.
pub(super) struct Rendered {
    /// The files' names and bytes.
    pub files: Vec<(String, Vec<u8>)>,
    /// What is recorded of them.
    pub records: Vec<FileRecord>,
}

/// How the pages of a family are made.
#[derive(Clone, Copy)]
pub(super) struct Printer<'a> {
    pub plan: &'a Plan,
    pub planned: &'a PlannedFamily,
    pub formats: &'a [Format],
    /// How many pages there are.
    pub of: usize,
}

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

impl Printer<'_> {
    /// A page of panels; pages are counted from 1.
    pub fn panels(&self, page: usize, solved: &[Solved]) -> Result<Rendered, Error> {
        let Printer { plan, planned, .. } = *self;
        let family = &planned.family;
        let sheet = Sheet {
            heading: self.heading(page, source_line(planned, plan.page.dash_deg)),
            layout: planned.layout,
            panels: solved.iter().map(|solved| panel(family, solved)).collect(),
        };
        self.render(page, &page::compose(&sheet, &plan.page))
    }

    /// The pages of a coupler grid, of which the first has this number.
    pub fn grids(&self, page: usize, solved: &Solved) -> Result<Vec<Rendered>, Error> {
        let Printer { plan, planned, .. } = *self;
        let mut shown = solved.by_points(Layout::POINTS);
        if shown.is_empty() {
            // A cell that is not assembled has a page that says so.
            shown.push(Vec::new());
        }
        let labels = labels(&planned.family, solved);
        // One pose for all pages of a cell.
        let view = page::clearest_pose(solved).map_or(View::Clearest, View::At);
        let draw = |(page, shown)| {
            let heading = self.heading(page, planned.source.clone());
            let panel = Panel { view: view.clone(), ..panel(&planned.family, solved) };
            let sheet = GridSheet { heading, panel, shown, labels: &labels };
            self.render(page, &page::compose_grid(&sheet, &plan.page))
        };
        (page..).zip(shown).map(draw).collect()
    }

    /// A page of charts.
    pub fn charts(&self, page: usize, chart: &Chart, gathered: &Gathered) -> Result<Rendered, Error> {
        let Printer { plan, planned, .. } = *self;
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
        self.render(page, &page::compose_charts(&sheet, &plan.page))
    }

    fn heading(&self, page: usize, source: String) -> Heading<'_> {
        let Printer { plan, planned, of, .. } = *self;
        let Family { id, title, names, .. } = &planned.family;
        Heading { atlas: &plan.title, family: id, title, source, symbols: names, page, of }
    }

    /// A page in each format.
    fn render(&self, page: usize, scene: &Scene) -> Result<Rendered, Error> {
        let Printer { plan, planned, formats, .. } = *self;
        let (mut files, mut records) = (Vec::new(), Vec::new());
        let svg = render::svg(scene, plan.text);
        for format in formats {
            let name = format!("{}-{page:03}.{}", planned.family.id, format.name());
            match format {
                Format::Svg => {
                    records.push(FileRecord::of_bytes(&name, &svg));
                    files.push((name, svg.clone()));
                }
                Format::Png => {
                    records.push(FileRecord::of_drawing(&name, &svg, plan.dpi));
                    let png =
                        render::png(scene, plan.dpi).map_err(|error| Error::Image { name: name.clone(), error })?;
                    files.push((name, png));
                }
            }
        }
        Ok(Rendered { files, records })
    }
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
