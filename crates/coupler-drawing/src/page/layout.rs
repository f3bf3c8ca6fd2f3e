//! How cells are laid out on pages.

use crate::chart::{curve_name, point_name};
use coupler_curves::family::Cell;
use coupler_curves::linkage::Linkage;
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

/// How a family's cells are laid out on pages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// A grid of panels, each with a cell's linkage and curves.
    Panels {
        /// The number of panels in a row.
        columns: usize,
        /// The number of rows.
        rows: usize,
    },
    /// A grid of charts, each of one quantity over all curves.
    Chart {
        /// The number of charts in a row.
        columns: usize,
        /// The number of rows.
        rows: usize,
    },
    /// A page for every ten traced points of a cell, as in the atlas of Hrones and Nelson.
    CouplerGrid,
    /// A page for each cell, with the poses of a body that it is to guide and the places of pivots and pins.
    Poses,
    /// A page for each cell, with the parts that its linkage is built from, their dimensions and a table of them.
    Drawing,
}

impl Layout {
    /// The number of traced points on a page of a coupler grid.
    pub const POINTS_PER_PAGE: usize = 10;

    /// The name and a description of every layout.
    pub const ALL: [(&'static str, &'static str); 5] = [
        ("panels", "a grid of panels, each with a cell's linkage, its curves and its caption"),
        ("coupler-grid", "a page for every ten coupler points of a cell, drawn on the grid they lie on"),
        ("poses", "a page for each cell, with the family's `poses` of a body and where pivots and pins can be"),
        ("drawing", "a page for each cell, with dimensioned views of the parts of its linkage and a table of them"),
        ("chart", "a grid of charts, each of one quantity over another, as the family's `chart` names them"),
    ];

    /// The number of columns and rows of a page.
    pub fn grid(self) -> [usize; 2] {
        match self {
            Layout::Panels { columns, rows } | Layout::Chart { columns, rows } => [columns, rows],
            Layout::CouplerGrid | Layout::Poses | Layout::Drawing => [1, 1],
        }
    }

    /// What its pages call the curve of the n-th traced joint, from 1, in two parts, as in "path of" and "B", or "point" and "12"; `None` if the
    /// linkage has one traced joint.
    pub fn curve_name(self, linkage: &Linkage, trace: usize) -> Option<[String; 2]> {
        let traced = linkage.traced.iter().map(|&joint| linkage.joints[joint].name.as_str());
        (linkage.traced.len() > 1).then(|| match self {
            Layout::CouplerGrid => point_name(trace),
            _ => curve_name(traced, trace),
        })
    }

    /// Which curve of a cell it is, as in "path of B, circuit 2": what its joint and its circuit are called, as far as there are several.
    pub fn curve_words(self, solved: &SolvedCell, curve: &MeasuredCurve) -> Option<String> {
        let name = self.curve_name(&solved.linkage, curve.trace).map(|name| name.join(" "));
        let words: Vec<String> = name.into_iter().chain(circuit_words(solved, curve)).collect();
        (!words.is_empty()).then(|| words.join(", "))
    }

    /// The number of the figure of a cell on its page, if that has several.
    pub fn figure_number(self, cell: &Cell) -> Option<usize> {
        (self.cells_per_page() > 1).then_some(cell.number)
    }

    /// The number of panels or charts on a page.
    pub fn cells_per_page(self) -> usize {
        let [columns, rows] = self.grid();
        columns * rows
    }
}

/// The circuit of a curve in words, if its linkage has several.
pub fn circuit_words(solved: &SolvedCell, curve: &MeasuredCurve) -> Option<String> {
    (solved.motion.circuits.len() > 1).then(|| format!("circuit {}", curve.circuit))
}
