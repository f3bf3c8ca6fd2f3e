//! The gallery: its data, its page, the files the page is joined from, and its solver. Tests that need a browser are in
//! `tests/gallery/` and run by `.ci/gallery`.

mod data;
mod page;
mod parts;
mod pieces;
