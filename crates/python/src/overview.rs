//! What a notebook shows of an atlas.

use coupler_atlas::manifest::PlannedFamily;
use coupler_atlas::output;
use coupler_drawing::render::PageFormat;
use pyo3::prelude::*;

use crate::error::Error;
use crate::html;
use crate::linkage::into_text;
use crate::manifest::Manifest;
use crate::page;

/// The most families with a picture.
const MOST_PICTURES: usize = 12;

/// The most cells that are solved for all pages, which takes a few seconds with the slowest measures.
const MOST_CELLS: usize = 300;

/// The most bytes of all pages: a notebook keeps them in its file.
const MOST_BYTES: usize = 2_000_000;

/// The pixels across a page.
const PAGE_WIDTH: usize = 360;

/// A table of the families of an atlas, with the first page of each while there are no more than a notebook can show, and how to have the others.
/// `plate` is the picture of a family of whose pages none is shown, by its index.
pub fn html(py: Python, manifest: &Manifest, plate: impl Fn(usize) -> PyResult<String>) -> PyResult<String> {
    let for_pages = match Manifest::for_pages(py, manifest.source()) {
        Ok(read) => Ok(read.manifest),
        Err(error) if error.is_instance_of::<Error>(py) => Err(first_problem(&error.value(py).to_string())),
        Err(error) => return Err(error),
    };
    let mut rows = String::new();
    let (mut cells_left, mut bytes_left) = (MOST_CELLS, MOST_BYTES);
    let (mut shown, mut counted, mut uncounted) = (0, 0, 0);
    for (index, planned) in manifest.plan.families.iter().enumerate() {
        let PlannedFamily { family, .. } = planned;
        let mut page_count = output::known_page_count(planned);
        let mut picture = String::new();
        if index < MOST_PICTURES {
            let page = match &for_pages {
                Ok(manifest) => first_page(py, manifest, index, (&mut cells_left, &mut bytes_left))?,
                Err(error) => Err(error.clone()),
            };
            picture = match page {
                Ok((page, count)) => {
                    page_count = Some(count);
                    shown += 1;
                    page
                }
                Err(why) => format!("{}<br>{}", plate(index)?, html::escaped(&why)),
            };
        }
        match page_count {
            Some(count) => counted += count,
            None => uncounted += 1,
        }
        let pages = page_count.map_or("not counted".to_owned(), |count| count.to_string());
        let texts = [&family.id, &family.title, &family.template.id, &family.cell_count().to_string(), &pages];
        rows += &html::row_of("td", texts.into_iter().map(|text| html::escaped(text)).chain([picture]));
    }
    let head = html::row("th", &["family", "title", "linkage", "cells", "pages", "the first page"]);
    let title = html::escaped(&manifest.plan.title);
    let others = match uncounted {
        0 => String::new(),
        1 => " and those of a family that are not counted".to_owned(),
        count => format!(" and those of {count} families that are not counted"),
    };
    let first = manifest.plan.families.first().map_or("", |planned| planned.family.id.as_str());
    let hint = format!(
        "Pages shown: {shown} of {counted}{others}. <code>coupler_atlas.render(atlas)</code> writes all of them, and \
         <code>atlas[&quot;{}&quot;].page(1)</code> is a single one.",
        html::escaped(first)
    );
    Ok(format!("<table><caption>{title}</caption>{head}{rows}</table><p>{hint}</p>"))
}

/// The first page of a family as a picture, and the number of its pages; or why it is not shown.
///
/// # Errors
/// Ctrl-C.
fn first_page(
    py: Python,
    manifest: &Manifest,
    index: usize,
    (cells_left, bytes_left): (&mut usize, &mut usize),
) -> PyResult<Result<(String, usize), String>> {
    let planned = &manifest.plan.families[index];
    let id = &planned.family.id;
    let solved = output::cells_solved_for_page(planned);
    if solved > *cells_left {
        return Ok(Err(format!("atlas[\"{id}\"].page(1) solves {solved} cells for its first page")));
    }
    *cells_left -= solved;
    let composed = page::composed(py, manifest, index, 1)?;
    let rendered = composed.and_then(|page| Ok((page.render(&manifest.plan, PageFormat::Svg)?, page.count)));
    let (svg, count) = match rendered {
        Ok((svg, count)) => (into_text(svg), count),
        Err(error) => return Ok(Err(error.to_string())),
    };
    let title = format!("page 1 of {count} of {id}: {}", planned.family.title);
    let picture = html::picture(&svg, &title, PAGE_WIDTH);
    if picture.len() > *bytes_left {
        return Ok(Err(format!("atlas[\"{id}\"].page(1) has {} kB", picture.len() / 1000)));
    }
    *bytes_left -= picture.len();
    Ok(Ok((picture, count)))
}

/// The first problem in the message of an error, or the whole message.
fn first_problem(message: &str) -> String {
    message.lines().find_map(|line| line.strip_prefix("error: ")).unwrap_or(message).to_owned()
}
