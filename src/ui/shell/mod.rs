//! The dialogs that belong to no feature, and the jobs of all features.
//!
//! | file | what |
//! |---|---|
//! | `dialogs` | draws the open dialogs |
//! | `jobs` | starts jobs, and takes in their events |
//! | `confirm` | asks before a change |
//! | `processing` | the progress and results of a job |
//! | `password` | asks for connection passwords |
//! | `error` | a failure |

pub mod confirm;
pub mod dialogs;
pub mod error;
mod jobs;
pub mod password;
pub mod processing;
