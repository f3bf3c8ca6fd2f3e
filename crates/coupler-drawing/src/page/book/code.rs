//! The code on a plate that leads to its curve in the gallery.

use qrcodegen::{QrCode, QrCodeEcc};

use super::super::Options;
use super::free_space::FreeSpace;
use crate::scene::{Color, Group, Item, LinkKind, LinkTarget, PageLink, Path, Polyline, Scene};
use coupler_curves::geometry::Vector;

/// The side of a module in millimetres, which cameras of telephones and printers resolve.
const MODULE: f64 = 0.4;

/// The modules of the quiet zone on each side.
const QUIET: f64 = 4.0;

/// The address in a gallery of the first curve of a page of a family, or of the family if the page has none.
pub fn gallery_address(scene: &Scene, gallery: &str, family: &str) -> String {
    let page = match gallery.strip_suffix(".html") {
        Some(_) => gallery.to_owned(),
        None => format!("{}/index.html", gallery.trim_end_matches('/')),
    };
    match first_curve(&scene.items) {
        Some(key) => format!("{page}#/{family}/curve/{key}"),
        None => format!("{page}#/{family}"),
    }
}

/// The cell, trace and circuit of the first curve that is drawn, as in "12.1.1".
fn first_curve(items: &[Item]) -> Option<String> {
    items.iter().find_map(|item| match item {
        Item::Group(group) if group.class == "curve" => {
            let value = |name: &str| Some(&group.data.iter().find(|(own, _)| *own == name)?.1);
            Some(format!("{}.{}.{}", value("cell")?, value("trace")?, value("circuit")?))
        }
        Item::Group(group) => first_curve(&group.items),
        _ => None,
    })
}

/// Draws an address as a QR code with a link, inside the border of a page where nothing else is, as near to its edges as
/// possible. Nothing is drawn where there is no space, or of an address that is too long for a code.
pub fn draw_code(scene: &mut Scene, address: &str, options: &Options) {
    let Ok(code) = QrCode::encode_text(address, QrCodeEcc::Low) else { return };
    let theme = options.theme.for_paper(options.paper);
    let side = MODULE * (f64::from(code.size()) + 2.0 * QUIET);
    let Some(corner) = FreeSpace::of_page(scene).square(side, theme.border) else { return };
    let size = Vector::repeat(side);
    let title = format!("QR code: {address}");
    let target = LinkTarget::Address(address.to_owned());
    scene.links.push(PageLink { corner, size, target, title: title.clone(), kind: LinkKind::Code });
    let modules = dark_runs(&code).map(|(from, to, row)| {
        let at =
            |column: i32, row: i32| corner + Vector::new(f64::from(column), f64::from(row)).add_scalar(QUIET) * MODULE;
        let points = vec![at(from, row), at(to, row), at(to, row + 1), at(from, row + 1)];
        Polyline { points, is_closed: true }
    });
    let modules = Path { polylines: modules.collect(), stroke: None, fill: Some(Color(0, 0, 0)) };
    // Cameras read dark modules on a light ground.
    let Color(r, g, b) = theme.paper;
    let is_dark = [r, g, b].map(u32::from).iter().sum::<u32>() < 3 * 0xc0;
    let ground = is_dark.then(|| {
        let corners = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)];
        let points = corners.map(|(x, y)| corner + Vector::new(x, y)).to_vec();
        let polylines = vec![Polyline { points, is_closed: true }];
        Item::Path(Path { polylines, stroke: None, fill: Some(Color(0xff, 0xff, 0xff)) })
    });
    let items = ground.into_iter().chain([Item::Path(modules)]).collect();
    scene.items.push(Item::Group(Group { items, ..Group::figure("code", title) }));
}

/// The runs of dark modules: the columns of their ends, and their rows.
fn dark_runs(code: &QrCode) -> impl Iterator<Item = (i32, i32, i32)> + '_ {
    let size = code.size();
    let run = move |(column, row): (i32, i32)| {
        let begins = code.get_module(column, row) && !code.get_module(column - 1, row);
        let end = (column..=size).find(|&column| !code.get_module(column, row));
        begins.then_some((column, end?, row))
    };
    (0..size).flat_map(move |row| (0..size).map(move |column| (column, row))).filter_map(run)
}
