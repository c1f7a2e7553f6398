//! Controllers of the list whose identity is not confirmed yet, as after an import.

use crate::texts::TextKey as T;
use crate::ui::features::add_controller::{AddControllerForm, AddStage, ConfirmIdentityForm};
use crate::ui::features::server_control::get_info;
use crate::ui::model::{BackendCommand, Model, RowId, UiCommand};

impl UiCommand {
    /// Compares the fingerprints of the controllers that are not confirmed.
    pub const CONFIRM_IDENTITY: Self = Self::new(T::ConfirmIdentity, T::ConfirmIdentityTip, |model, _| {
        let rows = model.ticked_unconfirmed().collect();
        model.confirm_identities(rows, vec![])
    })
    .in_menu(T::MenuController)
    .for_controllers()
    .disabled_if(|model, targets| model.all_targets_are_confirmed(targets).then_some(T::WhyConfirmed));
}

impl Model {
    /// Ticked rows without a fingerprint.
    pub fn ticked_unconfirmed(&self) -> impl Iterator<Item = RowId> + '_ {
        let rows = self.rows.ticked().into_iter().filter_map(|id| self.rows.get(id));
        rows.filter(|row| row.entry.fingerprint.is_none()).map(|row| row.id)
    }

    /// Reads information; asks first about the identity of controllers where it is not confirmed yet.
    pub(in crate::ui) fn get_info(&mut self, rows: Vec<RowId>) -> Vec<BackendCommand> {
        let confirmed = |id: &RowId| self.rows.get(*id).is_some_and(|row| row.entry.fingerprint.is_some());
        let (then_read, unconfirmed): (Vec<_>, Vec<_>) = rows.into_iter().partition(confirmed);
        if unconfirmed.is_empty() {
            return self.plan(get_info(), then_read);
        }
        self.confirm_identities(unconfirmed, then_read)
    }

    pub(in crate::ui) fn confirm_identities(
        &mut self,
        mut rows: Vec<RowId>,
        then_read: Vec<RowId>,
    ) -> Vec<BackendCommand> {
        if rows.is_empty() {
            return vec![];
        }
        let row = rows.remove(0);
        let mut form = AddControllerForm::new();
        form.identity = Some(ConfirmIdentityForm { row, next: rows, nth: 1, then_read });
        self.probe_identity(form)
    }

    /// Opens the dialog and asks the controller for its fingerprint at once.
    fn probe_identity(&mut self, mut form: AddControllerForm) -> Vec<BackendCommand> {
        let row = form.identity.as_ref().and_then(|identity| self.rows.get(identity.row));
        let Some(entry) = row.map(|row| &row.entry) else { return vec![] };
        let address = entry.address.clone();
        form.name = entry.name.to_string();
        form.address = address.to_string();
        form.series = entry.series;
        let connection = entry.connection;
        form.connection = connection;
        form.stage = AddStage::Probing;
        form.problem = None;
        self.open(form);
        vec![BackendCommand::Probe { job: self.next_job(), connection, address }]
    }

    /// Goes on with the next controller, and in the end with those that were confirmed before. The password typed last
    /// is offered again, as controllers of a plant often share one.
    pub(in crate::ui) fn next_identity(&mut self) -> Vec<BackendCommand> {
        let Some(mut form) = self.take_out::<AddControllerForm>(|_| true) else { return vec![] };
        let Some(identity) = &mut form.identity else { return vec![] };
        if identity.next.is_empty() {
            let rows = std::mem::take(&mut identity.then_read);
            return if rows.is_empty() { vec![] } else { self.plan(get_info(), rows) };
        }
        identity.row = identity.next.remove(0);
        identity.nth += 1;
        self.probe_identity(*form)
    }

    pub(in crate::ui) fn skip_identity(&mut self) -> Vec<BackendCommand> {
        let Some(form) = self.top::<AddControllerForm>().filter(|form| form.identity.is_some()) else { return vec![] };
        let waiting = form.is_waiting();
        let mut commands = if waiting { self.cancel_last() } else { vec![] };
        commands.extend(self.next_identity());
        commands
    }
}
