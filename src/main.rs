//! The program: see the library for everything.

use std::process::ExitCode;

fn main() -> ExitCode {
    opcua_configurator::cli::main()
}
