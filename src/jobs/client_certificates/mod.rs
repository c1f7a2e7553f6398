//! Whom controllers trust: client certificate lists and CRLs (manual 2.7.3).
//!
//! | file | what |
//! |---|---|
//! | `snapshot` | [`ListTrust`]: everything a controller trusts, read at once |
//! | `plan` | [`TrustPlan`]: which file's certificates and CRLs go where, before anything is sent |
//! | `notes` | [`TrustNote`]: what a person should think about before something goes into a list |
//! | `add` | [`AddTrust`]: do what such a plan says |
//! | `remove` | [`RemoveClients`], [`RemoveCrls`] |
//! | `move_clients` | [`MoveClients`]: from one list into another |
//! | `change` | one change sent, and what came of it: [`TrustChange`] |
//! | `undo` | [`TrustUndo`]: the steps that reverse a change |
//! | `undo_trust` | [`UndoTrust`]: sends the steps of a [`TrustUndo`] |
//! | `watch` | [`watch_trust`]: the lists as they change |

mod add;
mod change;
mod move_clients;
mod notes;
mod plan;
mod remove;
#[cfg(test)]
mod samples;
mod snapshot;
mod target_list;
mod undo;
mod undo_trust;
mod watch;

pub use add::AddTrust;
pub use change::TrustChange;
pub use move_clients::MoveClients;
pub use notes::TrustNote;
pub use plan::{Destination, ItemContent, PlannedAction, PlannedItem, SkipReason, TrustFile, TrustPlan};
pub use remove::{RemoveClients, RemoveCrls};
pub use snapshot::{ListTrust, TrustSnapshot};
pub use target_list::TargetList;
pub use undo::TrustUndo;
pub use undo_trust::UndoTrust;
pub use watch::{WATCH_INTERVAL, WatchEvent, watch_trust};
