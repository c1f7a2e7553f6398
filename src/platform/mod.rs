//! What differs between operating systems, behind functions that are the same on all of them.
//!
//! | module | what it does |
//! |---|---|
//! | [`private`] | files and folders that only this account can use |
//! | [`replace`] | replaces and removes files that another program may have open |
//! | [`stop_signal`] | waits until the system or the user asks the program to end |
//! | [`display`] | chooses between Wayland and X11; takes source locations out of error messages |
//! | `terminal_line` | pseudo-terminals and serial devices (Unix) |
//! | [`console`] | standard streams and messages of a program that has no console window (Windows) |
//! | `windows` | access control lists, data protection and the session end of Windows |

pub mod console;
pub mod display;
pub mod private;
pub mod replace;
pub mod stop_signal;
#[cfg(unix)]
pub mod terminal_line;
#[cfg(windows)]
pub mod windows;
