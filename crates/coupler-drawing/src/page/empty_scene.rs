//! A page before anything is drawn on it.

use super::theme::Theme;
use super::{Options, Paper};
use crate::scene::Scene;

pub(super) fn empty_scene(title: String, options: &Options, theme: &Theme) -> Scene {
    let Paper { width, height } = options.paper;
    let (paper, typeface) = (theme.paper, theme.typeface);
    Scene { width, height, paper, typeface, title, items: Vec::new(), links: Vec::new(), reduced_scale: None }
}
