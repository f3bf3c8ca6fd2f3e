//! Bars on a terminal for what takes long.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::printable;

/// A bar on standard error, if that is a terminal: its name, and how many of a number of things are done.
pub fn of_things(name: &str, number: usize, things: &str) -> ProgressBar {
    with_style(name, number, &format!("{{msg:20}} {{bar:40}} {{pos}}/{{len}} {things}"))
}

/// The same of which only the part that is done is shown, in thousandths.
pub fn of_parts(name: &str) -> ProgressBar {
    with_style(name, 1000, "{msg:20} {bar:40} {percent:>3}%")
}

fn with_style(name: &str, number: usize, template: &str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(number as u64), ProgressDrawTarget::stderr());
    let style = ProgressStyle::with_template(template);
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.set_message(printable(name));
    bar
}
