//! An atlas that is rendered for a test.

use std::fs;
use std::process::{Command, Output};

use tempfile::TempDir;

/// A manifest in a folder of its own, whose atlas goes to `out` beside it.
pub struct Atlas(pub TempDir);

impl Atlas {
    pub fn new(manifest: &str) -> Atlas {
        let atlas = Atlas(TempDir::new().unwrap());
        atlas.edit(manifest);
        atlas
    }

    pub fn edit(&self, manifest: &str) {
        fs::write(self.0.path().join("atlas.toml"), manifest).unwrap();
    }

    pub fn out(&self) -> std::path::PathBuf {
        self.0.path().join("out")
    }

    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_coupler-atlas"));
        command.current_dir(self.0.path()).arg("render").args(arguments);
        command
    }

    /// The exit code, standard output and standard error of a run.
    pub fn run(&self, arguments: &[&str]) -> (i32, String, String) {
        let Output { status, stdout, stderr } = self.command(arguments).output().unwrap();
        (status.code().unwrap_or(-1), String::from_utf8(stdout).unwrap(), String::from_utf8(stderr).unwrap())
    }
}
