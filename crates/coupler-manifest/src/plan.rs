//! What a manifest asks for.

use std::borrow::Cow;

use coupler_curves::expression::{Caption, CompiledExpression};
use coupler_curves::family::Family;
use coupler_curves::linkage_format::{quoted, toml_number};
use coupler_curves::measure::MeasureSet;
use coupler_curves::problem::{Problem, Span};
use coupler_drawing::chart::Chart;
use coupler_drawing::page;
use coupler_drawing::page::book::Emphasis;
use coupler_drawing::render::{Format, TextMode};

use crate::inputs::ManifestInputs;
use crate::tolerance::PartialTolerances;

/// A validated manifest: what to solve, and how to draw it.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The atlas's title.
    pub title: String,
    /// The output folder, as the manifest gives it, if it does.
    pub output: Option<String>,
    /// The most pages of a volume of the book.
    pub volume_pages: usize,
    /// What the book has in addition to the pages of its families.
    pub book: BookPlan,
    /// The options that all pages share.
    pub page: page::Options,
    /// The resolution of PNG images, in pixels per inch.
    pub dpi: f64,
    /// How text is written in SVG.
    pub text_mode: TextMode,
    /// The families, in order.
    pub families: Vec<PlannedFamily>,
    /// Texts of the manifest with characters that its typeface does not have: problems in all formats but SVG.
    pub undrawable: Vec<Problem>,
}

/// What a book has in addition to the pages of its families.
#[derive(Clone, Debug, Default)]
pub struct BookPlan {
    /// Whether it has its plates only; `None` if that depends on how many there are.
    pub plates_only: Option<bool>,
    /// Whether it says how its plates are read.
    pub how_to_read: bool,
    /// For which families it has charts of the shapes of their curves.
    pub finding_charts: FindingCharts,
    /// Whether it has marks at the outer edges of its pages.
    pub thumb_index: bool,
    /// Whether it has an index of geometries.
    pub index: bool,
    /// The chapters for cells that are taken out of their families.
    pub chapters: Vec<PlannedChapter>,
    /// The lists of curves.
    pub lists: Vec<PlannedList>,
    /// The width of the gutter at the inner edge of each page, in millimetres.
    pub binding: f64,
    /// How far its pages are printed beyond their edges, in millimetres.
    pub bleed: f64,
    /// The address of the gallery, to which its plates have codes and links.
    pub gallery: Option<String>,
    /// What the manifest contributes to the book in addition to its families.
    pub manifest_inputs: String,
}

impl Plan {
    /// The plan of the pages of the book, which are narrower by its gutter.
    pub fn with_book_pages(&self) -> Cow<'_, Plan> {
        if self.book.binding == 0.0 {
            return Cow::Borrowed(self);
        }
        Cow::Owned(Plan { page: self.book.page_options(&self.page), ..self.clone() })
    }
}

impl BookPlan {
    /// The options of its pages, which are narrower by the gutter.
    pub(crate) fn page_options(&self, page: &page::Options) -> page::Options {
        page.clone().with_gutter(self.binding)
    }
}

/// For which families a book has finding charts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FindingCharts {
    /// None.
    #[default]
    None,
    /// Those with so many plates that looking at charts spares looking at plates.
    WherePlatesAreMany,
    /// Every family.
    Always,
}

/// A chapter of a book: the cells of each family with a curve for which a condition holds.
#[derive(Clone, Debug)]
pub struct PlannedChapter {
    /// Its title, after that of the family.
    pub title: String,
    /// The condition for each family, over [`Family::scope`]; `None` for a family that it does not apply to.
    pub conditions: Vec<Option<CompiledExpression>>,
    /// Whether the manifest has it, so that one without cells is a mistake.
    pub is_given: bool,
}

/// A list of the best curves of a book.
#[derive(Clone, Debug)]
pub struct PlannedList {
    /// The title.
    pub title: String,
    /// What is listed and in what order, in words; may be empty.
    pub note: String,
    /// The most entries.
    pub count: usize,
    /// The most entries of a cell.
    pub per_geometry: usize,
    /// What its entries emphasise: what the measures by which it is sorted are measures of.
    pub emphasis: Emphasis,
    /// The heads of its columns, if it is a table of numbers; otherwise none, and its entries have drawings.
    pub columns: Vec<String>,
    /// The criteria for each family; `None` for a family that it does not apply to.
    pub criteria: Vec<Option<ListCriteria>>,
    /// Whether the manifest has it, so that one without curves is a mistake.
    pub is_given: bool,
}

/// Which curves of a family are in a list.
#[derive(Clone, Debug)]
pub struct ListCriteria {
    /// The condition on a curve, over [`Family::scope`].
    pub filter: Option<CompiledExpression>,
    /// The key by which curves are sorted, least first, over [`Family::scope`].
    pub sort: CompiledExpression,
    /// What is said of each.
    pub caption: Caption,
    /// What is in the columns, each after its head and a colon.
    pub columns: Vec<Caption>,
}

impl ListCriteria {
    /// Whether all of it is the same for all curves of a linkage on one circuit, whatever point traces them.
    pub fn is_of_linkage(&self, family: &Family) -> bool {
        let expressions = self.filter.iter().chain([&self.sort]);
        let of_expressions = expressions.map(|expression| family.measures_in(expression));
        let said: Vec<&String> = (self.columns.iter().chain([&self.caption]))
            .flat_map(|caption| caption.expressions().flat_map(|(expression, _)| expression.names()))
            .collect();
        let of_captions = MeasureSet::of(|measure| said.iter().any(|name| **name == measure.name));
        of_expressions.chain([of_captions]).all(|measures| (measures & MeasureSet::OF_PATHS).is_empty())
    }
}

/// A family and how it is rendered.
#[derive(Clone, Debug)]
pub struct PlannedFamily {
    /// The family.
    pub family: Family,
    /// How pages are laid out.
    pub layout: page::Layout,
    /// The scale of the linkages on its pages of panels.
    pub scale: page::PanelScale,
    /// Whether its pages of panels show the linkages at their limits as well.
    pub ghosts: bool,
    /// The poses of a body that its linkages are to guide, each x, y and the angle in degrees; may be empty.
    pub poses: Vec<[f64; 3]>,
    /// What its charts show; `None` unless its layout is charts.
    pub chart: Option<Chart>,
    /// The formats of its pages.
    pub formats: Vec<Format>,
    /// The line under the title of its pages.
    pub source: String,
    /// The caption of its cells, if neither the manifest nor the linkage gives one: the parameters that vary.
    pub automatic_caption: Option<String>,
    /// The text of its `sort`.
    pub sort: Option<String>,
    /// The file or the search that its cases are from, if they are.
    pub case_file: Option<CaseFile>,
    /// What the manifest contributes to its files.
    pub manifest_inputs: ManifestInputs,
    /// How much it may differ from a recorded atlas.
    pub tolerances: PartialTolerances,
    /// The place of its table in the manifest.
    pub span: Span,
    /// The place of its `where` in the manifest.
    pub filter_span: Option<Span>,
    /// The place of its `scale`.
    pub scale_span: Option<Span>,
}

/// The file or the search that the cases of a family are from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CaseFile {
    /// Its path, as the manifest has it, or what the answers are called.
    pub path: String,
    /// A digest of the names and values in it.
    pub digest: String,
}

impl PlannedFamily {
    /// The layout of its panels where the manifest leaves their number to the paper.
    pub fn usual_layout(&self, page: &page::Options) -> page::Layout {
        let key = page::Key::new(&self.family);
        let heading =
            page::Heading::new(&self.family.title).with_source(&*self.source).with_dimensions(&key.dimensions);
        page::Layout::for_panels(page, self.family.cell_count(), &heading, &key)
    }

    /// A manifest of this family alone, in which its names have the same order: of its parameter sets it has the first of
    /// each distinct set of names, see [`coupler_curves::family::ParameterSpace::distinct_names`]. It cannot be rendered as the family is, but
    /// says all that determines a curve whose parameters are known.
    pub fn excerpt(&self) -> String {
        let family = &self.family;
        let case = |k: usize| {
            let cell = family.cell(k);
            let values = family.space.slots_of(k).map(|slot| (&family.names[slot], cell.values[slot]));
            let values: Vec<String> = values.map(|(name, value)| format!("{name}={}", toml_number(value))).collect();
            format!("{{{}}}", values.join(","))
        };
        let cases: Vec<String> = family.space.distinct_names().into_iter().map(|(first, _)| case(first)).collect();
        // In the excerpt other parameters vary.
        let caption = self.automatic_caption.iter().map(|caption| format!("\"caption\"={},", quoted(caption)));
        self.manifest_inputs.excerpt(&format!("{}cases=[{}]", caption.collect::<String>(), cases.join(",")))
    }

    /// The most pages that the family can have, if `where` keeps all its cells.
    pub fn max_pages(&self) -> usize {
        let cells = self.family.cell_count();
        let points = self.family.template.curve_count();
        match (&self.chart, self.layout) {
            (Some(chart), layout) => chart.y.len().div_ceil(layout.cells_per_page()),
            (None, page::Layout::CouplerGrid) => {
                cells.saturating_mul(points.div_ceil(page::Layout::POINTS_PER_PAGE).max(1))
            }
            (None, layout) => cells.div_ceil(layout.cells_per_page()),
        }
    }
}
