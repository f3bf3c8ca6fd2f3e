//! Runs the program as a user would, in a folder, independently of the environment of the tests.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

/// The program, as a path, for tests of its environment.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_coupler-atlas");

/// The commands of the program; a test of the documents compares them with its help.
pub const COMMANDS: [&str; 14] = [
    "render",
    "validate",
    "check",
    "inspect",
    "design",
    "find",
    "export",
    "list",
    "sweep",
    "gather",
    "import",
    "init",
    "completions",
    "man",
];

/// The exit code, the standard output and the standard error of a command.
pub type Ran = (i32, String, String);

/// The program in a folder, without standard input and without the variables that its output depends on.
pub fn program(folder: &Path) -> Command {
    command(PROGRAM, folder)
}

/// A script of the shell in a folder, like [`program`], which is its `$0`.
#[cfg(unix)]
pub fn shell(folder: &Path, script: &str) -> Command {
    let mut shell = command("sh", folder);
    shell.args(["-c", script, PROGRAM]);
    shell
}

fn command(name: &str, folder: &Path) -> Command {
    let mut command = Command::new(name);
    command.current_dir(folder).stdin(Stdio::null());
    for name in ["NO_COLOR", "CLICOLOR_FORCE", "COLUMNS"] {
        command.env_remove(name);
    }
    command.env("XDG_CACHE_HOME", env!("CARGO_TARGET_TMPDIR"));
    command
}

/// What a command has returned.
pub fn result(output: Output) -> Ran {
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap_or(-1), text(output.stdout), text(output.stderr))
}

/// Runs a command in a folder.
pub fn run(folder: &Path, arguments: &[&str]) -> Ran {
    result(program(folder).args(arguments).output().unwrap())
}

/// The standard output of a command that succeeds.
pub fn printed(folder: &Path, arguments: &[&str]) -> String {
    let (code, out, err) = run(folder, arguments);
    assert_eq!(code, 0, "{arguments:?}: {err}");
    out
}

/// A folder with a manifest, `atlas.toml`.
pub fn folder_with(manifest: &str) -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("atlas.toml"), manifest).unwrap();
    folder
}
