//! The program: arguments in, results to standard output, everything else to standard error, and an exit code.

mod cli;

fn main() -> std::process::ExitCode {
    cli::main()
}
