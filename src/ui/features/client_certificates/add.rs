//! Files on their way into the lists of one controller or many.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use chrono::{DateTime, Utc};

use super::change::change_task;
use super::{LastTrustChange, PaneKind, ShownLists};
use crate::jobs::{AddTrust, Destination, PlannedAction, TrustFile, TrustPlan, TrustSnapshot};
use crate::model::{Capabilities, Feature, ListLimits, Problem, RevisionToken};
use crate::texts::TextKey;
use crate::ui::features::client_certificates::TrustForm;
use crate::ui::model::{BackendCommand, JobId, Model, ReadTrustFile, RowId};
use crate::ui::picker::FileKind;

/// More files at once are not read.
pub const MAX_TRUST_FILES: usize = 100;

/// A file in the dialog.
#[derive(Debug)]
pub struct AddFile {
    pub path: PathBuf,
    /// Without its folder.
    pub name: String,
    /// Why it cannot be used.
    pub problem: Option<Problem>,
    file: Option<TrustFile>,
}

impl AddFile {
    /// How many certificates and CRLs are in it.
    pub fn counts(&self) -> (usize, usize) {
        self.file.as_ref().map_or((0, 0), |file| (file.bundle.certificates.len(), file.bundle.crls.len()))
    }
}

/// Certificates and CRLs from files, and where they go; nothing is sent before a person agrees.
#[derive(Debug)]
pub struct AddTrustForm {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    pub shows: ShownLists,
    pub destination: Destination,
    /// As it is typed.
    pub path: String,
    pub picking: Option<JobId>,
    pub reading: Option<JobId>,
    /// Why the desktop's dialog did not help.
    pub problem: Option<Problem>,
    /// More than [`MAX_TRUST_FILES`] were given at last; they were not read.
    pub too_many: bool,
    pub files: Vec<AddFile>,
    /// What becomes of it all: one plan for the controllers with an issuers list (`true`), one for the others.
    pub plans: Vec<(bool, TrustPlan)>,
    /// Why it cannot be done anywhere.
    pub refused: Option<Problem>,
}

impl AddTrustForm {
    fn new(rows: Vec<RowId>, names: Vec<String>, shows: ShownLists, destination: Destination) -> Self {
        Self {
            rows,
            names,
            shows,
            destination,
            path: String::new(),
            picking: None,
            reading: None,
            problem: None,
            too_many: false,
            files: Vec::new(),
            plans: Vec::new(),
            refused: None,
        }
    }

    /// Why the main button does nothing, where that is not for [`Self::refused`] to say.
    pub fn incomplete(&self) -> Option<TextKey> {
        if self.reading.is_some() {
            Some(TextKey::Reading)
        } else if self.files.is_empty() {
            Some(TextKey::TrustAddRule)
        } else if self.files.iter().any(|file| file.problem.is_some()) {
            Some(TextKey::TrustLeaveOutRule)
        } else {
            None
        }
    }

    /// Whether the main button does something.
    pub fn is_complete(&self) -> bool {
        self.incomplete().is_none() && self.refused.is_none()
    }

    /// The typed path was not read yet, so the main button reads it.
    pub fn reads_file(&self) -> bool {
        !self.typed().as_os_str().is_empty()
    }

    /// File managers put quotes around a path they copy.
    fn typed(&self) -> &Path {
        Path::new(self.path.trim().trim_matches('"'))
    }

    fn title(&self) -> TextKey {
        if self.destination == Destination::Crls { TextKey::CrlAddTitle } else { TextKey::TrustAddTitle }
    }

    /// How many certificates and CRLs are sent to a controller, at most.
    pub fn count(&self) -> usize {
        let going = |plan: &TrustPlan| {
            plan.items.iter().filter(|item| matches!(item.action, PlannedAction::Send { .. })).count()
        };
        self.plans.iter().map(|(_, plan)| going(plan)).max().unwrap_or_default()
    }

    fn usable(&self) -> Arc<[TrustFile]> {
        self.files.iter().filter_map(|file| file.file.clone()).collect()
    }

    fn operation(&self, based_on: Option<RevisionToken>) -> AddTrust {
        AddTrust { files: self.usable(), destination: self.destination, based_on }
    }

    /// Works out anew what goes where. `held`: what the one controller has.
    fn plan(&mut self, held: Option<&TrustSnapshot>, kinds: &[(Capabilities, ListLimits)], now: DateTime<Utc>) {
        let files = self.usable();
        let has_issuers_list = |capabilities: &Capabilities| capabilities.offers(Feature::IssuersList);
        self.plans = match held {
            Some(held) => {
                let plan = TrustPlan::for_controller(&files, self.destination, held);
                vec![(has_issuers_list(&held.capabilities), plan)]
            }
            None => kinds
                .iter()
                .map(|(capabilities, limits)| {
                    let plan = TrustPlan::new(&files, self.destination, capabilities, *limits, now, None);
                    (has_issuers_list(capabilities), plan)
                })
                .collect(),
        };
        let mut checks: Vec<_> = self.plans.iter().map(|(_, plan)| plan.check()).collect();
        let possible = files.is_empty() || checks.iter().any(Result::is_ok);
        self.refused = if possible { None } else { checks.drain(..).find_map(Result::err) };
    }
}

impl Model {
    fn adding_trust(&mut self) -> Option<&mut AddTrustForm> {
        match self.top_mut::<AddTrustForm>() {
            Some(form) => Some(form),
            _ => None,
        }
    }

    pub(in crate::ui) fn open_add_trust(&mut self, shows: ShownLists, rows: Vec<RowId>) {
        let destination = if shows == ShownLists::Crls { Destination::Crls } else { Destination::Trusted };
        let names = self.rows.names(&rows);
        self.open(AddTrustForm::new(rows, names, shows, destination));
        self.replan();
    }

    /// A list's own button: the desktop's dialog opens at once.
    pub(in crate::ui) fn add_to(&mut self, kind: PaneKind) -> Vec<BackendCommand> {
        let Some(destination) = kind.destination() else { return vec![] };
        if self.add_over_lists(destination) { self.choose_trust_files() } else { vec![] }
    }

    /// Opens the dialog over the lists of the one controller.
    fn add_over_lists(&mut self, destination: Destination) -> bool {
        let Some(form) = self.top::<TrustForm>() else { return false };
        let ready = form.is_ready();
        if ready {
            let form = AddTrustForm::new(vec![form.row], vec![form.name.clone()], form.shows, destination);
            self.open(form);
            self.replan();
        }
        ready
    }

    pub(in crate::ui) fn choose_trust_files(&mut self) -> Vec<BackendCommand> {
        let job = self.next_job();
        let title = TextKey::ChooseFilesTitle.text(self.language).to_owned();
        let Some(form) = self.adding_trust().filter(|form| form.picking.is_none()) else { return vec![] };
        form.picking = Some(job);
        let kind = if form.shows == ShownLists::Crls { FileKind::Crl } else { FileKind::Trust };
        vec![BackendCommand::PickFiles { job, kind, title }]
    }

    pub(in crate::ui) fn trust_files_picked(
        &mut self,
        job: JobId,
        result: Result<Vec<PathBuf>, Problem>,
    ) -> Vec<BackendCommand> {
        let Some(form) = self.adding_trust().filter(|form| form.picking == Some(job)) else { return vec![] };
        form.picking = None;
        match result {
            Ok(paths) => self.read_trust_files(paths),
            Err(problem) => {
                form.problem = Some(problem);
                vec![]
            }
        }
    }

    /// A relative path starts at the workspace.
    pub(in crate::ui) fn read_typed_trust(&mut self) -> Vec<BackendCommand> {
        let root = self.workspace.root().to_owned();
        let Some(form) = self.adding_trust().filter(|form| form.reads_file()) else { return vec![] };
        let path = root.join(form.typed());
        form.path.clear();
        self.read_trust_files(vec![path])
    }

    /// Files dropped onto the lists, or onto the dialog that adds to them.
    pub(in crate::ui) fn dropped_trust(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        if let Some(form) = self.top::<TrustForm>() {
            let destination = if form.shows == ShownLists::Crls { Destination::Crls } else { Destination::ByKind };
            if !self.add_over_lists(destination) {
                return vec![];
            }
        }
        self.read_trust_files(paths)
    }

    /// Whether files that are dropped are for the dialog on top.
    pub(in crate::ui) fn takes_trust_files(&self) -> bool {
        self.top::<TrustForm>().is_some_and(TrustForm::is_ready)
            || self.top::<AddTrustForm>().is_some_and(|form| form.reading.is_none())
    }

    /// Files dropped onto the window, of which the client lists are one of the possible goals.
    pub(in crate::ui) fn open_clients_of(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        self.open_trust_of(ShownLists::Clients, paths)
    }

    pub(in crate::ui) fn open_crls_of(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        self.open_trust_of(ShownLists::Crls, paths)
    }

    fn open_trust_of(&mut self, shows: ShownLists, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        let ticked = self.rows.ticked();
        let mut commands = self.open_trust(shows, ticked);
        if let Some(form) = self.top_mut::<TrustForm>() {
            // What the controller holds decides what becomes of them.
            form.pending = paths;
        } else if let Some(form) = self.top_mut::<AddTrustForm>() {
            if shows == ShownLists::Clients {
                form.destination = Destination::ByKind;
            }
            commands.extend(self.read_trust_files(paths));
        }
        commands
    }

    fn read_trust_files(&mut self, mut paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        let job = self.next_job();
        let Some(form) = self.adding_trust().filter(|form| form.reading.is_none()) else { return vec![] };
        paths.retain(|path| !form.files.iter().any(|file| file.path == *path));
        form.problem = None;
        form.too_many = false;
        if paths.is_empty() {
            return vec![];
        }
        let room = MAX_TRUST_FILES.saturating_sub(form.files.len());
        if paths.len() > room {
            form.too_many = true;
            return vec![];
        }
        form.reading = Some(job);
        vec![BackendCommand::ReadTrustFiles { job, paths }]
    }

    pub(in crate::ui) fn trust_files_read(&mut self, job: JobId, files: Vec<ReadTrustFile>) {
        let Some(form) = self.adding_trust().filter(|form| form.reading == Some(job)) else { return };
        form.reading = None;
        form.files.extend(files.into_iter().map(|ReadTrustFile { path, result }| {
            let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
            let (file, problem) = match result {
                Ok(file) => (Some(file), None),
                Err(problem) => (None, Some(problem)),
            };
            AddFile { path, name, problem, file }
        }));
        self.replan();
    }

    pub(in crate::ui) fn leave_out(&mut self, index: usize) {
        if let Some(form) = self.adding_trust()
            && index < form.files.len()
        {
            form.files.remove(index);
        }
        self.replan();
    }

    /// The files, the destination or what the controller holds is another now.
    pub(in crate::ui) fn replan(&mut self) {
        if self.top::<AddTrustForm>().is_none() {
            return;
        }
        let Some(mut form) = self.take_out::<AddTrustForm>(|_| true) else { return };
        let (kinds, now) = (self.kinds_of(&form.rows), self.now);
        form.plan(self.dialog::<TrustForm>().and_then(|lists| lists.held.as_deref()), &kinds, now);
        self.put_back(form);
    }

    /// What the controllers with an issuers list offer, and those without, each with the smallest limits among them. A
    /// controller that was not read yet is taken for one with an issuers list.
    fn kinds_of(&self, rows: &[RowId]) -> Vec<(Capabilities, ListLimits)> {
        let rows: Vec<_> = rows.iter().filter_map(|row| self.rows.get(*row)).collect();
        let of = |has_issuers_list: bool| {
            let mut members = rows
                .iter()
                .map(|row| (row.capabilities(), row.info().map_or(ListLimits::LARGEST, |info| info.limits)))
                .filter(|(capabilities, _)| capabilities.offers(Feature::IssuersList) == has_issuers_list);
            let first = members.next()?;
            Some(members.fold(first, |(capabilities, least), (_, limits)| (capabilities, least.min(limits))))
        };
        [true, false].into_iter().filter_map(of).collect()
    }

    /// What was chosen was agreed to.
    pub(in crate::ui) fn submit_add_trust(&mut self, form: Box<AddTrustForm>) -> Vec<BackendCommand> {
        if form.reads_file() && form.reading.is_none() {
            self.put_back(form);
            return self.read_typed_trust();
        }
        if !form.is_complete() {
            self.put_back(form);
            return vec![];
        }
        let Some(revision) = self.dialog::<TrustForm>().map(|lists| lists.held.as_ref().map(|held| held.revision))
        else {
            let title = form.title();
            let task = change_task(title, form.operation(None)).act(title);
            let rows = form.rows.clone();
            self.put_back(form);
            return self.plan(task, rows);
        };
        let done = LastTrustChange::Added(form.count());
        self.change(form.title(), form.operation(revision), done)
    }
}
