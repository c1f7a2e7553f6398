//! The program: see the library for everything.

// No console window opens behind the window; the command line uses the console it was started from.
#![cfg_attr(windows, windows_subsystem = "windows")]

use std::process::ExitCode;

fn main() -> ExitCode {
    opcua_configurator::cli::main()
}
