//! The table of designs, and the message where there are none.

use std::fmt::Write;

use crate::design::{Designs, UNBOUNDED_SIZE, describe, parameters};
use coupler_curves::text::pluralize;
use coupler_find::{DesignAnswer, Wishes};

use super::super::super::jams::jams;
use super::arguments::WishArguments;
use crate::format::format_significant;

/// The designs, each with what is wished, its dimensions, and what else a designer asks first.
pub(super) fn text(linkage: &str, designs: &Designs) -> String {
    let mut out = format!(
        "{linkage}, {} searched: {}\n",
        pluralize(designs.searched.len(), "parameter"),
        designs.searched.join(", ")
    );
    for (rank, answer) in (1..).zip(&designs.answers) {
        out += &entry(&rank.to_string(), answer);
    }
    out
}

fn entry(rank: &str, answer: &DesignAnswer) -> String {
    let curve = &answer.solved.curves[0];
    let mut further = Vec::new();
    let class = curve.measure(coupler_curves::measure::Measure::CLASS);
    further.extend(class.map(str::to_owned));
    further.extend(answer.mu_worst_deg().map(|mu| format!("mu worst {}°", format_significant(mu, 4))));
    further.push(format!("longest link {}", format_significant(answer.longest_link, 6)));
    let joint = &answer.solved.linkage.joints[curve.joint].name;
    further.push(format!("{joint} (trace {}) on circuit {}", curve.trace, curve.circuit));
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(out, "{rank:>3}  {}", describe(answer));
    let _ = writeln!(out, "     {}", parameters(answer));
    let _ = writeln!(out, "     {}", further.join(", "));
    out
}

/// What to know about the designs.
pub(super) fn notes(arguments: &WishArguments, designs: &Designs) -> String {
    let mut out = String::new();
    if designs.is_interrupted && !designs.answers.is_empty() {
        out += "note: interrupted: these are the best so far\n";
    }
    if designs.is_size_unbounded {
        let remedy = "give a length a value or a range (--fix, --range), or --max-link";
        out += &format!("note: {UNBOUNDED_SIZE}: {remedy}\n");
    }
    if let Some(mu_worst_deg) = designs.answers.first().and_then(DesignAnswer::mu_worst_deg) {
        out += &jams(mu_worst_deg, arguments.condition.as_deref());
    }
    out
}

/// The message where no linkage meets the wishes: what each comes to while the others are met.
pub(super) fn no_design_message(linkage: &str, wishes: &Wishes, designs: &Designs) -> String {
    let mut out = format!("no {linkage} was found that meets these wishes\n");
    if designs.is_interrupted {
        return out.trim_end().to_owned();
    }
    out.extend(designs.remedies(wishes).into_iter().map(|remedy| format!("hint: {remedy}\n")));
    out.trim_end().to_owned()
}
