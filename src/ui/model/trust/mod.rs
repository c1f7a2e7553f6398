//! Whom controllers trust (manual 2.7.3): the lists and CRLs of one controller while a dialog shows them, and files on
//! their way into the lists of one or many.
//!
//! | file | what |
//! |---|---|
//! | `entry` | [`Entry`]: one line of a list, ready to be drawn |
//! | `pane` | [`Pane`]: one list, sorted, filtered and ticked |
//! | `form` | [`TrustForm`]: the lists of one controller, and what was done to them |
//! | `change` | delete, move, undo |
//! | `watch` | the lists as the controller reports them |
//! | `add` | [`AddTrustForm`]: files, and where what is in them goes |
//! | `details` | [`CertificateView`]: one certificate or CRL in full |

mod add;
mod change;
mod details;
mod entry;
mod form;
mod pane;
mod texts;
mod watch;

pub use add::{AddFile, AddTrustForm, MAX_TRUST_FILES, ReadTrustFile};
pub(super) use change::keep_change;
pub use change::{DeleteTrust, MoveTrust};
pub use details::{CertificateView, ChainNode, ChainState, CrlLine, CrlView, DetailsView, Field};
pub use entry::{Crl, Entry, Life, Moment, Refusal};
pub use form::{Done, Link, Shows, TrustForm};
pub use pane::{Pane, PaneKind, TrustColumn};

/// What can be asked for in these dialogs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TrustAction {
    /// Let files be chosen for this list.
    Add(PaneKind),
    /// Delete what is ticked in this list, or what the cursor is on; asks first.
    Delete(PaneKind),
    /// Move what is ticked, or what the cursor is on.
    Move { from: PaneKind, to: PaneKind },
    /// Take the last change back.
    Undo,
    /// Take back what a job did to several controllers.
    UndoJob,
    /// Show what the cursor is on in full.
    Details,
    /// Read the lists again after the connection was given up.
    Reconnect,
    /// Let the desktop's dialog find files.
    ChooseFiles,
    /// Read the file whose path is typed.
    ReadTyped,
    /// Leave a file out again.
    LeaveOut(usize),
    /// Another destination was chosen.
    Replan,
}
