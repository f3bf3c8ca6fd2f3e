//! The program: results go to standard output, messages and progress to standard error.

mod cli;

fn main() -> std::process::ExitCode {
    cli::main()
}
