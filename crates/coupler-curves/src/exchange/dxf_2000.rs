//! The frame of a document in DXF of AutoCAD 2000 (AC1015): the tables, blocks and objects around the entities of its model space.
//!
//! R12, in which curves are written, has no unit and no light polylines: AC1015 is the first version in which `$INSUNITS` and `LWPOLYLINE` with bulges
//! are defined, and what reads DXF at all reads it. It asks for handles, for owners, and for objects that a drawing of two dimensions does without.
//!
//! # Source
//! *AutoCAD 2000 DXF Reference*.

use std::fmt::Display;

use super::dxf_writer::DxfWriter;
use crate::geometry::{Bounds, Point};

/// A layer in DXF: its name, its AutoCAD colour number, and its line type.
pub(super) struct DxfLayer {
    pub name: String,
    pub color: u8,
    pub line_type: &'static str,
}

/// The line type of centre lines.
pub(super) const CENTRE_LINE: &str = "CENTER";
/// The line type of all others.
pub(super) const SOLID_LINE: &str = "Continuous";

/// The handles of what other objects refer to; those of entities and of what none refers to begin after them.
const LAYERS: u32 = 0x10;
const BLOCKS: u32 = 0x11;
const MODEL_SPACE: u32 = 0x12;
const PAPER_SPACE: u32 = 0x13;
const ROOT: u32 = 0x14;
const GROUPS: u32 = 0x15;
const LAYOUTS: u32 = 0x16;
const MODEL_LAYOUT: u32 = 0x17;
const PAPER_LAYOUT: u32 = 0x18;
const PLOT_STYLES: u32 = 0x19;
const NORMAL_STYLE: u32 = 0x1A;
const FIRST_FREE: u32 = 0x20;

/// A document that is being written: the tables first, then entities.
pub(super) struct Dxf2000 {
    out: DxfWriter,
    next_handle: u32,
}

impl Dxf2000 {
    /// A document with layers; a dash of its centre lines is `dash` long.
    pub fn new(layers: &[DxfLayer], (bounds, dash): (Bounds, f64)) -> Dxf2000 {
        let mut document = Dxf2000 { out: DxfWriter::default(), next_handle: FIRST_FREE };
        document.tables(layers, bounds, dash);
        document.blocks();
        document.out.section("ENTITIES");
        document
    }

    /// The document, after its header, with the lines of a comment.
    pub fn finish(mut self, (bounds, unit_code, is_metric): (Bounds, u8, bool), comments: &[&str]) -> String {
        self.out.end_marker("ENDSEC");
        self.objects(bounds);
        self.out.end_marker("EOF");
        let mut head = DxfWriter::default();
        comments.iter().for_each(|comment| head.group(999, ascii(comment)));
        head.section("HEADER");
        for (name, code, value) in [("$ACADVER", 1, "AC1015"), ("$DWGCODEPAGE", 3, "ANSI_1252")] {
            head.group(9, name);
            head.group(code, value);
        }
        head.header_point("$INSBASE", Point::origin(), 3);
        head.header_point("$EXTMIN", bounds.min, 3);
        head.header_point("$EXTMAX", bounds.max, 3);
        head.header_point("$LIMMIN", bounds.min, 2);
        head.header_point("$LIMMAX", bounds.max, 2);
        let whole = [("$LUNITS", 2), ("$LUPREC", 8), ("$INSUNITS", unit_code), ("$MEASUREMENT", u8::from(is_metric))];
        for (name, value) in whole {
            head.group(9, name);
            head.group(70, value);
        }
        head.group(9, "$HANDSEED");
        head.group(5, format_args!("{:X}", self.next_handle));
        head.end_marker("ENDSEC");
        head.section("CLASSES");
        head.end_marker("ENDSEC");
        head.0 + &self.out.0
    }

    /// Begins an entity on a layer; its own groups follow.
    pub fn entity(&mut self, kind: &str, layer: &str, class: &str) {
        self.object(kind, MODEL_SPACE, "AcDbEntity");
        self.group(8, ascii(layer));
        self.group(100, class);
    }

    /// Writes a group.
    pub fn group(&mut self, code: u16, value: impl Display) {
        self.out.group(code, value);
    }

    pub fn number(&mut self, code: u16, value: f64) {
        self.out.number(code, value);
    }

    pub fn coordinates(&mut self, first: u16, p: Point) {
        self.out.coordinates(first, p);
    }

    /// Writes groups that never differ.
    fn fixed(&mut self, groups: &[(u16, &str)]) {
        groups.iter().for_each(|(code, value)| self.group(*code, value));
    }

    fn handle(&mut self) -> u32 {
        self.next_handle += 1;
        self.next_handle - 1
    }

    /// Begins an object with a new handle.
    fn object(&mut self, kind: &str, owner: u32, class: &str) {
        let handle = self.handle();
        self.object_with_handle((kind, handle), owner, class);
    }

    fn object_with_handle(&mut self, (kind, handle): (&str, u32), owner: u32, class: &str) {
        self.group(0, kind);
        self.group(if kind == "DIMSTYLE" { 105 } else { 5 }, format_args!("{handle:X}"));
        self.group(330, format_args!("{owner:X}"));
        self.group(100, class);
    }

    /// Begins a table with a number of records.
    fn table(&mut self, name: &str, handle: Option<u32>, records: usize) -> u32 {
        let handle = handle.unwrap_or_else(|| self.handle());
        self.fixed(&[(0, "TABLE"), (2, name)]);
        self.group(5, format_args!("{handle:X}"));
        self.fixed(&[(330, "0"), (100, "AcDbSymbolTable")]);
        self.group(70, records);
        handle
    }

    /// Begins a record of a table.
    fn record(&mut self, kind: &str, table: u32, (class, name): (&str, &str)) {
        self.object(kind, table, "AcDbSymbolTableRecord");
        self.group(100, class);
        self.group(2, ascii(name));
    }

    fn tables(&mut self, layers: &[DxfLayer], bounds: Bounds, dash: f64) {
        self.out.section("TABLES");
        self.view_port(bounds);
        self.line_types(dash);
        let table = self.table("LAYER", Some(LAYERS), layers.len() + 1);
        let zero = DxfLayer { name: "0".to_owned(), color: 7, line_type: SOLID_LINE };
        for DxfLayer { name, color, line_type } in std::iter::once(&zero).chain(layers) {
            self.record("LAYER", table, ("AcDbLayerTableRecord", name));
            self.group(70, 0);
            self.group(62, color);
            self.group(6, line_type);
            self.group(370, -3);
            self.group(390, format_args!("{NORMAL_STYLE:X}"));
        }
        self.end_table();
        let table = self.table("STYLE", None, 1);
        self.record("STYLE", table, ("AcDbTextStyleTableRecord", "Standard"));
        self.fixed(&[(70, "0"), (40, "0.0"), (41, "1.0"), (50, "0.0"), (71, "0"), (42, "2.5"), (3, "txt"), (4, "")]);
        self.end_table();
        for name in ["VIEW", "UCS"] {
            self.table(name, None, 0);
            self.end_table();
        }
        let table = self.table("APPID", None, 1);
        self.record("APPID", table, ("AcDbRegAppTableRecord", "ACAD"));
        self.group(70, 0);
        self.end_table();
        let table = self.table("DIMSTYLE", None, 1);
        self.fixed(&[(100, "AcDbDimStyleTable"), (71, "1")]);
        self.record("DIMSTYLE", table, ("AcDbDimStyleTableRecord", "Standard"));
        self.group(70, 0);
        self.end_table();
        let table = self.table("BLOCK_RECORD", Some(BLOCKS), 2);
        for (name, handle, layout) in SPACES {
            self.object_with_handle(("BLOCK_RECORD", handle), table, "AcDbSymbolTableRecord");
            self.fixed(&[(100, "AcDbBlockTableRecord"), (2, name)]);
            self.group(340, format_args!("{layout:X}"));
        }
        self.end_table();
        self.out.end_marker("ENDSEC");
    }

    fn end_table(&mut self) {
        self.out.end_marker("ENDTAB");
    }

    /// The view that a program opens with: all of the drawing.
    fn view_port(&mut self, bounds: Bounds) {
        let table = self.table("VPORT", None, 1);
        self.record("VPORT", table, ("AcDbViewportTableRecord", "*Active"));
        self.fixed(&[(70, "0"), (10, "0.0"), (20, "0.0"), (11, "1.0"), (21, "1.0")]);
        let (centre, size) = (bounds.centre(), bounds.size());
        self.number(12, centre.x);
        self.number(22, centre.y);
        self.fixed(&[(13, "0.0"), (23, "0.0"), (14, "10.0"), (24, "10.0"), (15, "10.0"), (25, "10.0")]);
        self.fixed(&[(16, "0.0"), (26, "0.0"), (36, "1.0"), (17, "0.0"), (27, "0.0"), (37, "0.0")]);
        // The height of the view, with a margin, and its ratio of width to height.
        const ASPECT: f64 = 1.5;
        self.number(40, 1.1 * size.y.max(size.x / ASPECT));
        self.number(41, ASPECT);
        self.fixed(&[(42, "50.0"), (43, "0.0"), (44, "0.0"), (50, "0.0"), (51, "0.0")]);
        self.fixed(&[(71, "0"), (72, "100"), (73, "1"), (74, "3"), (75, "0"), (76, "0"), (77, "0"), (78, "0")]);
        self.end_table();
    }

    fn line_types(&mut self, dash: f64) {
        let table = self.table("LTYPE", None, 4);
        let centre_line = [2.0, -0.5, 0.5, -0.5].map(|length| length * dash);
        let types: [(&str, &str, &[f64]); 4] = [
            ("ByBlock", "", &[]),
            ("ByLayer", "", &[]),
            (SOLID_LINE, "Solid line", &[]),
            (CENTRE_LINE, "Center ____ _ ____ _ ____", &centre_line),
        ];
        for (name, description, pattern) in types {
            self.record("LTYPE", table, ("AcDbLinetypeTableRecord", name));
            self.group(70, 0);
            self.group(3, description);
            self.group(72, 65);
            self.group(73, pattern.len());
            self.number(40, pattern.iter().map(|length| length.abs()).sum());
            for length in pattern {
                self.number(49, *length);
                self.group(74, 0);
            }
        }
        self.end_table();
    }

    fn blocks(&mut self) {
        self.out.section("BLOCKS");
        for (name, handle, _) in SPACES {
            let space: &[(u16, &str)] = if handle == PAPER_SPACE { &[(67, "1")] } else { &[] };
            self.object("BLOCK", handle, "AcDbEntity");
            self.fixed(space);
            self.fixed(&[(8, "0"), (100, "AcDbBlockBegin"), (2, name), (70, "0")]);
            self.coordinates(10, Point::origin());
            self.fixed(&[(3, name), (1, "")]);
            self.object("ENDBLK", handle, "AcDbEntity");
            self.fixed(space);
            self.fixed(&[(8, "0"), (100, "AcDbBlockEnd")]);
        }
        self.out.end_marker("ENDSEC");
    }

    fn objects(&mut self, bounds: Bounds) {
        self.out.section("OBJECTS");
        let root = [("ACAD_GROUP", GROUPS), ("ACAD_LAYOUT", LAYOUTS), ("ACAD_PLOTSTYLENAME", PLOT_STYLES)];
        self.dictionary(("DICTIONARY", ROOT), 0, &root);
        self.dictionary(("DICTIONARY", GROUPS), ROOT, &[]);
        self.dictionary(("DICTIONARY", LAYOUTS), ROOT, &[("Layout1", PAPER_LAYOUT), ("Model", MODEL_LAYOUT)]);
        self.dictionary(("ACDBDICTIONARYWDFLT", PLOT_STYLES), ROOT, &[("Normal", NORMAL_STYLE)]);
        self.group(100, "AcDbDictionaryWithDefault");
        self.group(340, format_args!("{NORMAL_STYLE:X}"));
        self.group(0, "ACDBPLACEHOLDER");
        self.group(5, format_args!("{NORMAL_STYLE:X}"));
        self.group(330, format_args!("{PLOT_STYLES:X}"));
        self.layout(("Model", MODEL_LAYOUT, MODEL_SPACE), "1024", "0", bounds);
        self.layout(("Layout1", PAPER_LAYOUT, PAPER_SPACE), "0", "1", bounds);
        self.out.end_marker("ENDSEC");
    }

    fn dictionary(&mut self, kind_and_handle: (&str, u32), owner: u32, entries: &[(&str, u32)]) {
        self.object_with_handle(kind_and_handle, owner, "AcDbDictionary");
        self.group(281, 1);
        for (name, handle) in entries {
            self.group(3, name);
            self.group(350, format_args!("{handle:X}"));
        }
    }

    fn layout(&mut self, (name, handle, space): (&str, u32, u32), plot_flags: &str, tab: &str, bounds: Bounds) {
        self.object_with_handle(("LAYOUT", handle), LAYOUTS, "AcDbPlotSettings");
        self.fixed(&[(1, ""), (2, "none_device"), (4, "ISO_A4_(210.00_x_297.00_MM)"), (6, "")]);
        self.fixed(&[(40, "7.5"), (41, "20.0"), (42, "7.5"), (43, "20.0"), (44, "210.0"), (45, "297.0")]);
        self.fixed(&[(46, "0.0"), (47, "0.0"), (48, "0.0"), (49, "0.0"), (140, "0.0"), (141, "0.0")]);
        self.fixed(&[(142, "1.0"), (143, "1.0"), (70, plot_flags), (72, "1"), (73, "0"), (74, "5"), (7, "")]);
        self.fixed(&[(75, "16"), (147, "1.0"), (148, "0.0"), (149, "0.0")]);
        self.fixed(&[(100, "AcDbLayout"), (1, name), (70, "1"), (71, tab)]);
        for (code, p) in [(10, bounds.min), (11, bounds.max)] {
            self.number(code, p.x);
            self.number(code + 10, p.y);
        }
        for (code, p) in [(12, Point::origin()), (14, bounds.min), (15, bounds.max)] {
            self.coordinates(code, p);
        }
        self.number(146, 0.0);
        self.coordinates(13, Point::origin());
        self.coordinates(16, Point::new(1.0, 0.0));
        self.coordinates(17, Point::new(0.0, 1.0));
        self.group(76, 0);
        self.group(330, format_args!("{space:X}"));
    }
}

/// The block records of the model and of its paper, with their layouts.
const SPACES: [(&str, u32, u32); 2] =
    [("*Model_Space", MODEL_SPACE, MODEL_LAYOUT), ("*Paper_Space", PAPER_SPACE, PAPER_LAYOUT)];

/// A text in ASCII: other characters by their codes, as DXF before 2007 has them.
pub(super) fn ascii(text: &str) -> String {
    let code = |c: char| format!("\\U+{:04X}", u32::from(c));
    text.chars().map(|c| if c.is_ascii() { c.to_string() } else { code(c) }).collect()
}
