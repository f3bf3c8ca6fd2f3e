//! Composed pages for benchmarks.

use coupler_atlas::manifest::Plan;
use coupler_curves::solve::SolvedCell;
use coupler_drawing::page::{self, CouplerGridPage, Heading, Layout, Panel, PanelPage, PanelScale, PoseChoice};
use coupler_drawing::scene::Scene;

/// The pages of ten curves of a cell of the first family.
pub fn coupler_grid(plan: &Plan, solved: &SolvedCell) -> Vec<Scene> {
    let family = &plan.families[0].family;
    let pages = solved.curves_by_traces(Layout::POINTS_PER_PAGE);
    let page_count = pages.len();
    let pose = page::clearest_pose(solved).map_or(PoseChoice::Clearest, PoseChoice::Fixed);
    let sheet = |(page, shown)| {
        let [caption, note] = family.format_captions(&solved.cell, solved.first_curve_values());
        let facts = page::cell_facts(family, solved);
        let (title, symbols) = (family.title.as_str(), family.names.as_slice());
        let source = plan.families[0].source.clone();
        let heading = Heading::new(title)
            .with_family_id(&family.id)
            .with_atlas_title(&plan.title)
            .with_source(source)
            .with_symbols(symbols)
            .with_page(page, page_count);
        let panel = Panel::new(solved).with_caption(caption).with_note(note).with_facts(facts).with_pose(pose.clone());
        let straight_criterion = family.straight;
        let (scale, curve_indices) = (PanelScale::Panel, shown);
        let sheet = CouplerGridPage {
            heading,
            panel,
            scale,
            curve_indices,
            coordinates: &[],
            labels: &[],
            key: None,
            straight_criterion,
        };
        page::compose_coupler_grid(&sheet, &plan.page)
    };
    (1..).zip(pages).map(sheet).collect()
}

/// A page of panels of cells of the first family.
pub fn panels<'s>(plan: &Plan, solved: &'s [SolvedCell]) -> Scene {
    let planned = &plan.families[0];
    let family = &planned.family;
    let panel = |solved: &'s SolvedCell| {
        let [caption, note] = family.format_captions(&solved.cell, solved.first_curve_values());
        Panel::new(solved).with_caption(caption).with_note(note)
    };
    let sheet = PanelPage {
        heading: Heading::new(&family.title).with_family_id(&family.id).with_atlas_title(&plan.title),
        layout: planned.layout,
        panels: solved.iter().map(panel).collect(),
        scale: planned.scale,
        key: None,
    };
    page::compose_panels(&sheet, &plan.page)
}
