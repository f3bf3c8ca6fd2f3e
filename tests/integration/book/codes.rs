//! The codes and links of plates to the gallery.

use coupler_drawing::page::Theme;
use coupler_drawing::page::book::{draw_code, gallery_address};
use coupler_drawing::render::png;
use coupler_drawing::scene::{LinkKind, LinkTarget, Scene};
use image::GrayImage;

use super::bound;
use super::reader::Pdf;
use super::sheets::MANIFEST;
use crate::support::folder::Atlas;
use crate::support::plan::plan;

const DPI: f64 = 200.0;

/// A page as an image.
fn drawn(scene: &Scene) -> GrayImage {
    image::load_from_memory(&png(scene, DPI).unwrap()).unwrap().into_luma8()
}

#[test]
fn a_code_is_where_nothing_else_is_and_reads_as_its_address() {
    let mut plan = plan(
        &bound::MANIFEST
            .replace("[[family]]\nid = \"rockers\"", "[page]\npaper = \"a4\"\n[[family]]\nid = \"rockers\""),
    );
    let solved = bound::solve_families(&plan);
    for theme in ["paper", "dark"] {
        let named = Theme::NAMED.iter().find(|named| named.name == theme).unwrap();
        plan.page.theme = (named.theme)();
        let (scenes, _) = bound::pages(&plan, &solved);
        let first = &scenes[0];
        let address = gallery_address(first, "https://example.org/atlas/", "rockers");
        assert_eq!(address, "https://example.org/atlas/index.html#/rockers/curve/1.1.1");
        let mut scene = first.clone();
        draw_code(&mut scene, &address, &plan.page);
        let link = scene.links.last().unwrap();
        assert_eq!((&link.target, link.kind), (&LinkTarget::Address(address.clone()), LinkKind::Code));
        let pixels = |mm: f64| (mm * DPI / 25.4).round() as u32;
        let [left, top] = [link.corner.x, link.corner.y].map(pixels);
        let side = pixels(link.size.x);
        let cut = |image: &GrayImage| image::imageops::crop_imm(image, left, top, side, side).to_image();
        let before = cut(&drawn(first));
        assert!(before.pixels().all(|pixel| pixel == before.get_pixel(0, 0)), "something else is there");
        let after = cut(&drawn(&scene));
        let at = |x: usize, y: usize| after.get_pixel(x as u32, y as u32).0[0];
        let mut prepared =
            rqrr::PreparedImage::prepare_from_greyscale(after.width() as usize, after.height() as usize, at);
        let grids = prepared.detect_grids();
        assert_eq!(grids.len(), 1, "{theme}");
        let (meta, says) = grids[0].decode().unwrap();
        assert_eq!(says, address);
        let modules = meta.version.to_size() as f64 + 8.0;
        assert!(link.size.x / modules > 0.4 - 1e-9, "{} mm for {modules} modules", link.size.x);
    }
}

#[test]
fn each_plate_leads_to_its_curve_and_back_to_its_entry() {
    let atlas = Atlas::rendered(&MANIFEST.replace("bleed", "gallery = \"https://example.org/a\"\nbleed"), &[]);
    let bytes = std::fs::read(atlas.out().join("atlas.pdf")).unwrap();
    let text = String::from_utf8_lossy(&bytes);
    let addresses: Vec<&str> = text.split("/URI(").skip(1).map(|rest| rest.split(')').next().unwrap()).collect();
    let curves = ["evans/curve/1.1.1", "evans/curve/3.1.1", "hoeken/curve/1.1.1", "hoeken/curve/2.1.1"];
    assert_eq!(addresses, curves.map(|curve| format!("https://example.org/a/index.html#/{curve}")));
    let pdf = Pdf::read(&bytes);
    // A title page and a page of contents precede the plates.
    for page in 2..6 {
        assert!(pdf.links(page).iter().any(|(_, to)| *to == 1), "page {page}");
    }
    assert_eq!(pdf.contents(1).texts.iter().filter(|(text, ..)| text == "Contents").count(), 1);
}
