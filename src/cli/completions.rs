//! `completions`: completions for a shell, generated from the arguments.

use crate::design::LinkageKind;
use crate::export;
use crate::import;
use clap::Args;
use clap::builder::PossibleValuesParser;
use clap_complete::Shell;
use coupler_curves::catalogue;
use coupler_drawing::render;

use super::{Failure, Outcome, check, print_bytes, validate};

/// Print completions for a shell: coupler-atlas completions bash >
/// ~/.local/share/bash-completion/completions/coupler-atlas
#[derive(Debug, Args)]
pub struct Arguments {
    /// The shell.
    shell: Shell,
}

/// Stands for the families of ./atlas.toml in a generated script, until it is replaced by what lists them.
const FAMILIES: &str = "FAMILIES-OF-THE-MANIFEST";

/// What lists the families of ./atlas.toml in bash, zsh and fish; other shells are offered none. In bash `$1` is the
/// program as it was called.
const FAMILY_LISTS: [(Shell, &str, &str); 3] = [
    (Shell::Bash, "\"FAMILIES-OF-THE-MANIFEST\"", "\"$(\"$1\" list families 2>/dev/null)\""),
    (Shell::Zsh, "(FAMILIES-OF-THE-MANIFEST)", "{compadd -- $(coupler-atlas list families 2>/dev/null)}"),
    (Shell::Fish, "\"FAMILIES-OF-THE-MANIFEST\\t''\"", "\"(coupler-atlas list families 2>/dev/null)\""),
];

pub fn run(arguments: &Arguments, command: clap::Command) -> Result<Outcome, Failure> {
    let mut command = offered_values().into_iter().fold(command, offer);
    let name = command.get_name().to_owned();
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, name.as_str(), &mut script);
    let mut script = String::from_utf8_lossy(&script).into_owned();
    if arguments.shell == Shell::Bash {
        // clap_complete 4.6.11 writes the name of a program with a hyphen in two ways, so that the arguments of no command
        // would be completed (clap-rs/clap#6421). Once that is fixed, there is nothing to replace.
        script = script.replace(&name.replace('-', "__subcmd__"), &name.replace('-', "__"));
    }
    if let Some((_, placeholder, list)) = FAMILY_LISTS.iter().find(|(shell, ..)| *shell == arguments.shell) {
        script = script.replace(placeholder, list);
    }
    print_bytes(script.as_bytes())?;
    Ok(Outcome::Done)
}

/// The values to offer for an argument of a command.
type Offer = (&'static str, &'static str, Vec<&'static str>);

/// The values that are offered where the arguments themselves accept others too, or several in a list.
fn offered_values() -> Vec<Offer> {
    let linkages = || catalogue::all().iter().map(|template| template.id.as_str()).collect::<Vec<_>>();
    let built_in = render::Format::ALL.into_iter().filter(|format| format.is_built_in());
    vec![
        ("inspect", "linkage", linkages()),
        ("export", "linkage", linkages()),
        ("import", "format", import::Format::ALL.map(import::Format::name).to_vec()),
        ("design", "linkage", linkages()),
        ("design straight-line", "types", LinkageKind::ALL.map(LinkageKind::id).to_vec()),
        ("render", "format", built_in.map(render::Format::name).collect()),
        (
            "export",
            "format",
            export::Format::ALL.into_iter().filter(|format| format.is_built_in()).map(export::Format::name).collect(),
        ),
        ("export", "form", export::ManifestForm::ALL.map(export::ManifestForm::name).to_vec()),
        ("check", "report", check::REPORTS.map(|(name, _)| name).to_vec()),
        ("validate", "report", validate::REPORTS.map(|(name, _)| name).to_vec()),
        ("render", "only", vec![FAMILIES]),
        ("check", "only", vec![FAMILIES]),
        ("export", "only", vec![FAMILIES]),
    ]
}

/// Offers values. This is done for completions only: a command must not reject the linkage of a manifest.
fn offer(command: clap::Command, (name, id, values): Offer) -> clap::Command {
    // `mut_arg` would move the argument behind all others.
    let offer = |argument: clap::Arg| match argument.get_id() == id {
        true => argument.value_parser(PossibleValuesParser::new(values.clone())),
        false => argument,
    };
    match name.split_once(' ') {
        Some((name, of)) => {
            command.mut_subcommand(name, |command| command.mut_subcommand(of, |command| command.mut_args(offer)))
        }
        None => command.mut_subcommand(name, |command| command.mut_args(offer)),
    }
}
