//! `man` and `completions`: the manual page and shell completions, generated from the arguments.

use std::io;

use clap::{Args, CommandFactory};
use clap_complete::Shell;
use clap_mangen::Man;

use super::{Outcome, print_bytes};

/// Print the manual page in roff: coupler-atlas man | man -l -
#[derive(Debug, Args)]
pub struct Manual {}

/// Print completions for a shell: coupler-atlas completions bash >
/// ~/.local/share/bash-completion/completions/coupler-atlas
#[derive(Debug, Args)]
pub struct Completions {
    /// The shell.
    shell: Shell,
}

/// Prints one manual page: the program, then a section for each command.
pub fn print_manual(_: &Manual) -> anyhow::Result<Outcome> {
    let mut command = super::Arguments::command();
    command.build();
    let mut page = Vec::new();
    let program = Man::new(command.clone());
    program.render_title(&mut page)?;
    program.render_name_section(&mut page)?;
    program.render_synopsis_section(&mut page)?;
    program.render_description_section(&mut page)?;
    for command in command.get_subcommands().filter(|command| !command.is_hide_set()) {
        write_command_section(command, &mut page)?;
    }
    program.render_extra_section(&mut page)?;
    program.render_version_section(&mut page)?;
    print_bytes(&page)?;
    Ok(Outcome::Done)
}

/// Writes the section of a command: its synopsis, description and options.
fn write_command_section(command: &clap::Command, page: &mut Vec<u8>) -> io::Result<()> {
    use io::Write;
    let mut body = Vec::new();
    let man = Man::new(command.clone());
    man.render_synopsis_section(&mut body)?;
    man.render_description_section(&mut body)?;
    man.render_options_section(&mut body)?;
    // Sections of the command's own page become subsections of this one.
    let body = String::from_utf8_lossy(&body).replace(".SH ", ".SS ");
    writeln!(page, ".SH {}", command.get_name().to_uppercase())?;
    page.write_all(body.as_bytes())
}

pub fn print_completions(arguments: &Completions) -> anyhow::Result<Outcome> {
    let mut command = super::Arguments::command();
    let name = command.get_name().to_owned();
    let mut out = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, name, &mut out);
    print_bytes(&out)?;
    Ok(Outcome::Done)
}
