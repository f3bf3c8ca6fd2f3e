//! The program: results go to standard output, messages and progress to standard error.

fn main() -> std::process::ExitCode {
    let arguments: Vec<std::ffi::OsString> = std::env::args_os().collect();
    coupler_atlas::cli::run(&arguments).into()
}
