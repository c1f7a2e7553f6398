//! Whom controllers trust (manual 2.7.3): the lists and CRLs of one controller while a dialog shows them, and files on
//! their way into the lists of one or many.
//!
//! | file | what |
//! |---|---|
//! | `entry` | [`TrustListEntry`]: one line of a list, ready to be drawn |
//! | `pane` | [`Pane`]: one list, sorted, filtered and ticked |
//! | `form` | [`TrustForm`]: the lists of one controller, and what was done to them |
//! | `change` | delete, move, undo |
//! | `watch` | the lists as the controller reports them |
//! | `add` | [`AddTrustForm`]: files, and the list that each certificate and CRL goes into |
//! | `details` | [`CertificateView`]: one certificate or CRL in full |

mod add;
mod change;
mod column;
mod details;
mod entry;
mod form;
mod pane;
mod texts;
mod view;
mod watch;

use chrono::{DateTime, Utc};
use egui::Ui;

use crate::texts::TextKey as T;
use crate::ui::model::{BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, UiCommand};

pub use add::AddTrustForm;
#[cfg(test)]
pub use add::MAX_TRUST_FILES;
pub use change::change_task;
pub use change::{DeleteTrust, MoveTrust};
pub use column::TrustColumn;
pub use details::{CertificateView, ChainNode, ChainState, CrlView, DetailField, DetailsView};
pub use entry::{CrlDetails, RejectionDetails, TrustListEntry, ValidityState};
pub use form::{Freshness, LastTrustChange, ShownLists, TrustForm};
pub use pane::{Pane, PaneKind};
pub use view::UNDO;

/// What can be asked for in these dialogs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TrustAction {
    /// Let files be chosen for this list.
    Add(PaneKind),
    /// Delete what is ticked in this list, or what the cursor is on; asks first.
    Delete(PaneKind),
    /// Move what is ticked, or what the cursor is on.
    Move {
        /// The list that holds the certificates.
        from: PaneKind,
        /// The list they go into.
        to: PaneKind,
    },
    /// Take the last change back.
    Undo,
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

impl UiCommand {
    /// Trusted, rejected and issuers.
    pub const CLIENT_CERTIFICATES: Self = Self::new(T::ClientCertificates, T::ClientCertificatesTip, |model, rows| {
        model.open_trust(ShownLists::Clients, rows)
    })
    .in_menu(T::MenuCertificate)
    .for_controllers();

    /// Certificate revocation lists.
    pub const CRL: Self = Self::new(T::Crl, T::CrlTip, |model, rows| model.open_trust(ShownLists::Crls, rows))
        .in_menu(T::MenuCertificate)
        .for_controllers();
}

impl Dialog for TrustForm {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, place.on_top, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.put_back(self);
        model.trust_action(TrustAction::Details)
    }

    fn close(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.close_trust(&self)
    }

    fn refresh(&mut self, now: DateTime<Utc>) {
        self.refresh_words(now);
    }
}

impl Dialog for AddTrustForm {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::add(ui, self, place.focus, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.submit_add_trust(self)
    }

    fn is_done_by_confirming(&self) -> bool {
        true
    }
}

impl Dialog for DeleteTrust {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        view::delete(ui, self, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.delete_trust(*self)
    }
}

impl Dialog for MoveTrust {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        view::move_anyway(ui, self, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.move_anyway(*self)
    }
}

impl Dialog for DetailsView {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        view::details(ui, self, model)
    }
}
