//! Reading a manifest, and saying what is wrong with it.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use coupler_atlas::manifest::{self, Plan};
use coupler_atlas::output;
use coupler_curves::problem::{self, Problem, suggestion};

use super::{InputError, pluralize, print_stderr};

/// A manifest that was read, with what is needed to speak of it.
pub struct ManifestSource {
    pub path: PathBuf,
    pub text: String,
    pub plan: Plan,
}

/// Reads a manifest; every problem in it goes to standard error.
pub fn read(path: &Path) -> anyhow::Result<ManifestSource> {
    let text = output::read_manifest(path).map_err(|error| match error {
        output::Error::Read { source, .. } if source.kind() == std::io::ErrorKind::NotFound => {
            let path = path.display();
            anyhow::Error::from(InputError(format!(
                "there is no {path}: `coupler-atlas init {path}` writes one to start from"
            )))
        }
        error => error.into(),
    })?;
    let loaded = manifest::parse(&text);
    report_problems(path, &text, &loaded.problems);
    match loaded.plan {
        Some(plan) => Ok(ManifestSource { path: path.to_owned(), text, plan }),
        None => {
            let errors = loaded.problems.iter().filter(|p| p.is_error()).count();
            Err(InputError(format!("{}: {}", path.display(), pluralize(errors, "problem"))).into())
        }
    }
}

impl ManifestSource {
    /// Says more of what is wrong with the manifest.
    pub fn report_problems(&self, problems: &[Problem]) {
        report_problems(&self.path, &self.text, problems);
    }

    /// Complains of ids that are no family's.
    pub fn require_families(&self, only: &[String]) -> Result<(), InputError> {
        let ids: Vec<&str> = self.plan.families.iter().map(|planned| planned.family.id.as_str()).collect();
        match only.iter().find(|id| !ids.contains(&id.as_str())) {
            Some(id) => Err(InputError(format!("there is no family `{id}`: {}", suggestion(id, &ids)))),
            None => Ok(()),
        }
    }

    /// The folder results go to: as given on the command line, or beside the manifest.
    pub fn output_folder(&self, given: Option<&Path>) -> PathBuf {
        match given {
            Some(folder) => folder.to_owned(),
            None => self.path.parent().unwrap_or(Path::new("")).join(&self.plan.output),
        }
    }
}

/// Says what is wrong with a text.
pub fn report_problems(path: &Path, text: &str, problems: &[Problem]) {
    let styled = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    print_stderr(&problem::report(problems, &path.display().to_string(), text, styled));
}
