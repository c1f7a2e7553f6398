//! Every test that drives the program from outside: its window, its command line, its operations. One binary, so that
//! the library is linked once; a file is a story and has the name of the feature it is about.
//!
//! - `window`: the real window without a display
//! - `cli`: the program as a process
//! - `jobs`: operations without a window
//! - `interop`: against peers of other projects
//! - `architecture`: the structure of the source
//! - `corpora`: readers and rules against many inputs
//!
//! The tests run as threads of one process: none may change its environment, its current folder or its limits. A test
//! that needs such a change starts a process for it, as `cli::main_job` does for a full disk.

mod architecture;
mod cli;
#[path = "../common/mod.rs"]
mod common;
mod corpora;
mod every_error;
#[path = "../interop/mod.rs"]
mod interop;
mod jobs;
#[path = "../fuzz/make_seeds.rs"]
mod make_seeds;
mod pulled_cable;
#[path = "../fuzz/src/readers/mod.rs"]
mod readers;
mod window;
