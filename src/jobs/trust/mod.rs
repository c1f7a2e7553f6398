//! Whom controllers trust: client certificate lists and CRLs (manual 2.7.3).
//!
//! | file | what |
//! |---|---|
//! | `snapshot` | [`ListTrust`]: everything a controller trusts, read at once |
//! | `plan` | [`TrustPlan`]: which file's certificates and CRLs go where, before anything is sent |
//! | `notes` | [`Note`]: what a person should think about before something goes into a list |
//! | `add` | [`AddTrust`]: do what such a plan says |
//! | `remove` | [`RemoveClients`], [`RemoveCrls`] |
//! | `relist` | [`MoveClients`]: from one list into another |
//! | `change` | one change sent, and what came of it: [`TrustChange`] |
//! | `undo` | [`TrustUndo`]: the steps that reverse a change |
//! | `undo_trust` | [`UndoTrust`]: sends them |
//! | `watch` | [`watch_trust`]: the lists as they change |

mod add;
mod change;
mod notes;
mod plan;
mod relist;
mod remove;
#[cfg(test)]
mod samples;
mod snapshot;
mod target;
mod undo;
mod undo_trust;
mod watch;

pub use add::AddTrust;
pub use change::TrustChange;
pub use notes::Note;
pub use plan::{Destination, ItemContent, PlannedAction, PlannedItem, SkipReason, TrustFile, TrustPlan};
pub use relist::MoveClients;
pub use remove::{RemoveClients, RemoveCrls};
pub use snapshot::{ListTrust, TrustSnapshot};
pub use target::Target;
pub use undo::TrustUndo;
pub use undo_trust::UndoTrust;
pub use watch::{WATCH_INTERVAL, WatchEvent, watch_trust};
