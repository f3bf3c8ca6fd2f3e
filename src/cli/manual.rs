use std::io;

use clap::{Args, CommandFactory};
use clap_complete::Shell;
use clap_mangen::Man;

use super::{Outcome, print};

/// Print the manual page, in roff: coupler-atlas man | man -l -
#[derive(Debug, Args)]
pub struct Manual {}

/// Print a shell's completions: coupler-atlas completions bash > ~/.local/share/bash-completion/completions/coupler-atlas
#[derive(Debug, Args)]
pub struct Completions {
    /// The shell.
    shell: Shell,
}

/// The page of the program, and after it what each command takes.
pub fn print_manual(_: &Manual) -> anyhow::Result<Outcome> {
    let mut command = super::Arguments::command();
    command.build();
    let mut page = Vec::new();
    let whole = Man::new(command.clone());
    whole.render_title(&mut page)?;
    whole.render_name_section(&mut page)?;
    whole.render_synopsis_section(&mut page)?;
    whole.render_description_section(&mut page)?;
    for command in command.get_subcommands().filter(|command| !command.is_hide_set()) {
        write_command_section(command, &mut page)?;
    }
    whole.render_extra_section(&mut page)?;
    whole.render_version_section(&mut page)?;
    print(&String::from_utf8_lossy(&page))?;
    Ok(Outcome::Done)
}

/// What one command does and takes, under a heading of its own.
fn write_command_section(command: &clap::Command, page: &mut Vec<u8>) -> io::Result<()> {
    use io::Write;
    let mut body = Vec::new();
    let man = Man::new(command.clone());
    man.render_synopsis_section(&mut body)?;
    man.render_description_section(&mut body)?;
    man.render_options_section(&mut body)?;
    // Each is a section of the whole page: what are sections of its own become parts of that.
    let body = String::from_utf8_lossy(&body).replace(".SH ", ".SS ");
    writeln!(page, ".SH {}", command.get_name().to_uppercase())?;
    page.write_all(body.as_bytes())
}

pub fn print_completions(arguments: &Completions) -> anyhow::Result<Outcome> {
    let mut command = super::Arguments::command();
    let name = command.get_name().to_owned();
    let mut out = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, name, &mut out);
    print(&String::from_utf8_lossy(&out))?;
    Ok(Outcome::Done)
}
