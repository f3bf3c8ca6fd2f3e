//! Whether messages have colours.

use std::ffi::{OsStr, OsString};
use std::io::{self, IsTerminal};
use std::sync::OnceLock;

use clap::{ColorChoice, ValueEnum};

/// When messages have colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Color {
    // Comments of documentation would take five lines of the help of each command.
    #[default]
    Auto,
    Always,
    Never,
}

/// The environment variables that colours depend on, and how.
pub const VARIABLES: [(&str, &str); 2] = [
    ("NO_COLOR", "If it is set and not empty, messages have no colours, unless --color says otherwise."),
    (
        "CLICOLOR_FORCE",
        "If it is set, and neither empty nor 0, messages have colours also where they are not written to a terminal, \
         unless NO_COLOR is set or --color says otherwise.",
    ),
];

/// The option of the command line, for messages about anything else.
static GIVEN: OnceLock<Color> = OnceLock::new();

impl Color {
    /// Makes this the choice for all messages that follow; only the first call has an effect.
    pub fn set(self) {
        let _ = GIVEN.set(self);
    }

    /// The choice in arguments that need not be valid, for messages about them.
    pub fn from_arguments(arguments: &[OsString]) -> Color {
        let mut arguments = arguments.iter().map(|argument| argument.to_str()).take_while(|text| *text != Some("--"));
        let mut found = Color::default();
        while let Some(argument) = arguments.next() {
            let value = match argument {
                Some("--color") => arguments.next().flatten(),
                Some(argument) => argument.strip_prefix("--color="),
                None => None,
            };
            found = value.and_then(|value| Color::from_str(value, false).ok()).unwrap_or(found);
        }
        found
    }

    /// The choice for the messages and the help of clap, which go to standard error and standard output.
    pub fn for_clap(self) -> ColorChoice {
        match [io::stderr().is_terminal(), io::stdout().is_terminal()].map(|is_terminal| self.is_styled(is_terminal)) {
            [true, true] => ColorChoice::Always,
            [false, false] => ColorChoice::Never,
            _ => ColorChoice::Auto,
        }
    }

    fn is_styled(self, is_terminal: bool) -> bool {
        let is_set = |name: &str, off: &[&str]| {
            std::env::var_os(name).is_some_and(|value| !off.iter().any(|off| value == OsStr::new(off)))
        };
        match self {
            Color::Always => true,
            Color::Never => false,
            Color::Auto if is_set("NO_COLOR", &[""]) => false,
            Color::Auto if is_set("CLICOLOR_FORCE", &["", "0"]) => true,
            Color::Auto => is_terminal && std::env::var_os("TERM").is_none_or(|terminal| terminal != "dumb"),
        }
    }
}

/// Whether messages on standard error have colours.
pub fn is_stderr_styled() -> bool {
    GIVEN.get().copied().unwrap_or_default().is_styled(io::stderr().is_terminal())
}
