//! Server certificates from elsewhere: where they are, what was found when they were looked at, and the import.

mod ca_signed_view;
mod restore_view;
mod review_view;
mod user_specified_view;

use std::collections::BTreeMap;
use std::path::PathBuf;

use egui::Ui;
use secrecy::SecretString;

use crate::jobs::{
    CaSignedSource, CertificateChecked, CheckBackup, CheckCaSigned, CheckUserSpecified, Confirmation, ImportCaSigned,
    ImportUserSpecified, RestoreBackup, ServerEffect, UserSpecifiedFiles,
};
use crate::model::{Feature, FileFormat, Problem};
use crate::texts::TextKey;
use crate::ui::model::{
    BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId, SecretInput, Task, UiCommand, first_path,
};
use crate::workspace::{BackupKind, KeyBackupSource, Workspace};

/// What is imported.
#[derive(Debug, Clone)]
pub enum ImportSource {
    /// What a CA issued: the only one in each controller's folder, or this file.
    Ca(Option<PathBuf>),
    User {
        files: UserSpecifiedFiles,
        password: Option<SecretString>,
    },
    /// A backup of a key that was made here.
    Backup {
        kind: BackupKind,
        /// Instead of the one in each controller's folder.
        file: Option<PathBuf>,
        /// `None`: the connection password.
        password: Option<SecretString>,
    },
}

impl ImportSource {
    /// What the button that agrees to it says: the act itself.
    pub const fn act(&self) -> TextKey {
        match self {
            Self::Ca(_) | Self::User { .. } => TextKey::ImportButton,
            Self::Backup { .. } => TextKey::CaRestoreNow,
        }
    }

    /// Looks at the certificates and changes nothing.
    fn check(&self, workspace: &Workspace) -> Task {
        let (title, checked) = (self.title(), Model::checked);
        let task = match self.clone() {
            Self::Ca(file) => Task::with_results(title, CheckCaSigned(ca_source(file, workspace)), checked),
            Self::User { files, password } => {
                Task::with_results(title, CheckUserSpecified { files, password }, checked)
            }
            Self::Backup { kind, file, password } => {
                let source = backup_source(kind, file, workspace);
                Task::with_results(title, CheckBackup { source, password }, checked)
            }
        };
        let source = self.clone();
        task.in_background().on_end(move |model| model.checks_ended(&source))
    }

    pub fn import(&self, accept_warnings: bool, workspace: &Workspace) -> Task {
        let title = self.title();
        let task = match self.clone() {
            Self::Ca(file) => Task::new(title, ImportCaSigned { source: ca_source(file, workspace), accept_warnings }),
            Self::User { files, password } => {
                Task::new(title, ImportUserSpecified { files, password, accept_warnings })
            }
            Self::Backup { kind, file, password } => {
                let source = backup_source(kind, file, workspace);
                Task::new(title, RestoreBackup { source, password, accept_warnings })
            }
        };
        task.act(self.act()).restarts_server()
    }

    pub const fn title(&self) -> TextKey {
        match self {
            Self::Ca(_) => TextKey::CaSignedTitle,
            Self::User { .. } => TextKey::UserSpecifiedTitle,
            Self::Backup { .. } => TextKey::RestoreTitle,
        }
    }
}

fn ca_source(file: Option<PathBuf>, workspace: &Workspace) -> CaSignedSource {
    match file {
        Some(file) => CaSignedSource::File(file),
        None => CaSignedSource::Folder(workspace.certificate_files()),
    }
}

fn backup_source(kind: BackupKind, file: Option<PathBuf>, workspace: &Workspace) -> KeyBackupSource {
    KeyBackupSource { files: workspace.certificate_files(), kind, chosen: file }
}

/// The looking before an import.
#[derive(Debug, Default)]
pub struct ImportChecks {
    pub running: bool,
    of: BTreeMap<RowId, Result<CertificateChecked, Problem>>,
}

/// Request and import of a certificate that a CA signs (manual 2.7.1.5).
#[derive(Debug)]
pub struct CaSignedForm {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    /// For one controller: a path, or empty for the only one in its folder.
    pub file: String,
    pub checks: ImportChecks,
}

impl CaSignedForm {
    fn source(&self) -> ImportSource {
        ImportSource::Ca(typed_path(&self.file).filter(|_| self.rows.len() == 1))
    }
}

/// How a certificate made with another tool comes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UserFiles {
    Pfx,
    Pair,
}

/// Import of a certificate made with another tool (manual 2.7.1.4).
#[derive(Debug)]
pub struct UserSpecifiedForm {
    pub row: RowId,
    pub name: String,
    pub kind: UserFiles,
    pub pfx: String,
    pub certificate: String,
    pub key: String,
    pub password: SecretInput,
    pub show_password: bool,
    pub checks: ImportChecks,
}

impl UserSpecifiedForm {
    /// What is imported; `None` while a path is missing. Nothing typed stands for the only files in the folder.
    pub fn source(&self, model: &Model) -> Option<ImportSource> {
        let info = model.rows.get(self.row).and_then(|row| row.info());
        let folder = info.map(|info| (model.workspace.certificate_files(), info.serial.clone()));
        let files = match self.kind {
            UserFiles::Pfx => match (typed_path(&self.pfx), folder) {
                (Some(path), _) => UserSpecifiedFiles::Pfx(path),
                (None, folder) => folder.map(|(files, serial)| UserSpecifiedFiles::PfxIn(files, serial))?,
            },
            UserFiles::Pair => match (typed_path(&self.certificate), typed_path(&self.key), folder) {
                (Some(certificate), Some(key), _) => UserSpecifiedFiles::Pair { certificate, key },
                (None, None, Some((files, serial))) => UserSpecifiedFiles::PairIn(files, serial),
                _ => return None,
            },
        };
        let given = self.kind == UserFiles::Pfx || !self.password.0.is_empty();
        Some(ImportSource::User { files, password: given.then(|| SecretString::from(self.password.0.clone())) })
    }
}

/// Putting back a backup of a key (manual 2.8.1).
#[derive(Debug)]
pub struct RestoreForm {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    pub kind: BackupKind,
    /// For one controller: a path, or empty for the one in its folder.
    pub file: String,
    /// Empty: the connection password.
    pub password: SecretInput,
    pub show_password: bool,
    pub checks: ImportChecks,
}

impl RestoreForm {
    fn source(&self) -> ImportSource {
        let password = (!self.password.0.is_empty()).then(|| SecretString::from(self.password.0.clone()));
        let file = typed_path(&self.file).filter(|_| self.rows.len() == 1);
        ImportSource::Backup { kind: self.kind, file, password }
    }
}

/// A path as people paste it: with blanks and quotes around it.
fn typed_path(text: &str) -> Option<PathBuf> {
    let path = text.trim().trim_matches('"');
    (!path.is_empty()).then(|| PathBuf::from(path))
}

/// What was found, and what the import will do, to be agreed to.
#[derive(Debug)]
pub struct ImportReview {
    pub source: ImportSource,
    pub names: Vec<String>,
    pub found: Vec<(RowId, String, Result<CertificateChecked, Problem>)>,
}

impl ImportReview {
    /// The controllers whose certificate clients would not refuse.
    pub fn importable(&self) -> Vec<RowId> {
        let good =
            |found: &Result<CertificateChecked, Problem>| found.as_ref().is_ok_and(|checked| !checked.is_refused());
        self.found.iter().filter(|(_, _, found)| good(found)).map(|(row, ..)| *row).collect()
    }

    /// What is agreed to. Signing requests without certificates replace no certificate, and no server is started again
    /// for them.
    pub fn confirmation(&self, workspace: &Workspace) -> Confirmation {
        let all = self.source.import(self.warns(), workspace).confirmation().unwrap_or_default();
        let mut checked = self.found.iter().filter_map(|(_, _, found)| found.as_ref().ok());
        if checked.any(|checked| checked.summary.is_some()) {
            return all;
        }
        Confirmation { server: ServerEffect::GoesOn, replaces_certificate: false, ..all }
    }

    /// Whether clients may complain about something that is imported.
    pub fn warns(&self) -> bool {
        let checked = self.found.iter().filter_map(|(_, _, found)| found.as_ref().ok());
        checked.filter(|checked| !checked.is_refused()).any(|checked| !checked.findings.is_empty())
    }
}

impl UiCommand {
    /// Makes a CSR, and imports the certificate that a CA issued for it.
    pub const CA_SIGNED: Self = Self::new(TextKey::CaSigned, TextKey::CaSignedTip, |model, rows| {
        model.open_ca_signed(rows);
        vec![]
    })
    .in_menu(TextKey::MenuCertificate)
    .for_controllers();

    /// Imports a key and a certificate that were made with another tool.
    pub const USER_SPECIFIED: Self = Self::new(TextKey::UserSpecified, TextKey::UserSpecifiedTip, |model, rows| {
        model.open_user_specified(&rows);
        vec![]
    })
    .in_menu(TextKey::MenuCertificate)
    .for_controllers()
    .disabled_if(|model, targets| match model.target_count(targets) {
        ..=1 => model.any_target_lacks(targets, Feature::UserSpecifiedCertificate).then_some(TextKey::WhyUserLegacy),
        _ => Some(TextKey::WhyUserOne),
    });

    /// Puts a backup of a key back.
    pub const RESTORE_BACKUP: Self = Self::new(TextKey::RestoreBackup, TextKey::RestoreBackupTip, |model, rows| {
        model.open_restore(rows);
        vec![]
    })
    .in_menu(TextKey::MenuCertificate)
    .for_controllers()
    .disabled_if(|model, targets| {
        model.any_target_lacks(targets, Feature::KeyImport).then_some(TextKey::WhyLegacyOnly)
    });
}

impl Dialog for CaSignedForm {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        ca_signed_view::show(ui, self, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.check_ca_signed(self)
    }

    fn close(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.drop_job()
    }
}

impl Dialog for UserSpecifiedForm {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        user_specified_view::show(ui, self, place.focus, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.check_user_specified(self)
    }

    fn close(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.drop_job()
    }
}

impl Dialog for RestoreForm {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        restore_view::show(ui, self, place.focus, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.check_backup(self)
    }

    fn close(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.drop_job()
    }
}

impl Dialog for ImportReview {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        review_view::show(ui, self, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.import(self)
    }
}

impl Model {
    pub(in crate::ui) fn new_csr(&mut self) -> Vec<BackendCommand> {
        match self.top::<CaSignedForm>() {
            Some(form) => self.open_self_signed(form.rows.clone(), Some(FileFormat::default())),
            _ => vec![],
        }
    }

    pub(in crate::ui) fn open_ca_signed(&mut self, rows: Vec<RowId>) {
        let names = self.rows.names(&rows);
        let form = CaSignedForm { rows, names, file: String::new(), checks: ImportChecks::default() };
        self.open(form);
    }

    pub(in crate::ui) fn open_user_specified(&mut self, rows: &[RowId]) {
        let [row] = *rows else { return };
        self.open(UserSpecifiedForm {
            row,
            name: self.rows.names(rows).pop().unwrap_or_default(),
            kind: UserFiles::Pfx,
            pfx: String::new(),
            certificate: String::new(),
            key: String::new(),
            password: SecretInput::default(),
            show_password: false,
            checks: ImportChecks::default(),
        });
    }

    pub(in crate::ui) fn open_restore(&mut self, rows: Vec<RowId>) {
        self.open(RestoreForm {
            names: self.rows.names(&rows),
            rows,
            kind: BackupKind::SelfSigned,
            file: String::new(),
            password: SecretInput::default(),
            show_password: false,
            checks: ImportChecks::default(),
        });
    }

    pub(in crate::ui) fn check_backup(&mut self, mut form: Box<RestoreForm>) -> Vec<BackendCommand> {
        let wanted = (!form.checks.running).then(|| (form.source(), form.rows.clone()));
        form.checks.running = true;
        self.put_back(form);
        self.check(wanted)
    }

    pub(in crate::ui) fn open_ca_signed_of(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        self.open_ca_signed(self.rows.ticked());
        if let Some(form) = self.top_mut::<CaSignedForm>() {
            form.file = first_path(&paths);
        }
        vec![]
    }

    pub(in crate::ui) fn open_user_pfx(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        self.open_user_of(|form| form.pfx = first_path(&paths))
    }

    pub(in crate::ui) fn open_user_certificate(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        self.open_user_of(|form| (form.kind, form.certificate) = (UserFiles::Pair, first_path(&paths)))
    }

    pub(in crate::ui) fn open_user_key(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        self.open_user_of(|form| (form.kind, form.key) = (UserFiles::Pair, first_path(&paths)))
    }

    /// The certificate first.
    pub(in crate::ui) fn open_user_pair(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        self.open_user_of(|form| {
            let (certificate, key) = paths.split_at(paths.len().min(1));
            (form.kind, form.certificate, form.key) = (UserFiles::Pair, first_path(certificate), first_path(key));
        })
    }

    fn open_user_of(&mut self, fill: impl FnOnce(&mut UserSpecifiedForm)) -> Vec<BackendCommand> {
        self.open_user_specified(&self.rows.ticked());
        if let Some(form) = self.top_mut::<UserSpecifiedForm>() {
            fill(form);
        }
        vec![]
    }

    pub(in crate::ui) fn check_ca_signed(&mut self, mut form: Box<CaSignedForm>) -> Vec<BackendCommand> {
        let wanted = (!form.checks.running).then(|| (form.source(), form.rows.clone()));
        form.checks.running = true;
        self.put_back(form);
        self.check(wanted)
    }

    pub(in crate::ui) fn check_user_specified(&mut self, mut form: Box<UserSpecifiedForm>) -> Vec<BackendCommand> {
        let source = form.source(self).filter(|_| !form.checks.running);
        form.checks.running |= source.is_some();
        let rows = vec![form.row];
        self.put_back(form);
        self.check(source.map(|source| (source, rows)))
    }

    fn check(&mut self, wanted: Option<(ImportSource, Vec<RowId>)>) -> Vec<BackendCommand> {
        match wanted {
            Some((source, rows)) => {
                let task = source.check(&self.workspace);
                self.start(task, rows, None)
            }
            None => vec![],
        }
    }

    /// The dialog that waits for the checks, and its controllers. At most one is open.
    fn checking(&mut self) -> Option<(&mut ImportChecks, Vec<RowId>)> {
        if self.dialog::<CaSignedForm>().is_some() {
            return self.dialog::<CaSignedForm>().map(|form| (&mut form.checks, form.rows.clone()));
        }
        if self.dialog::<UserSpecifiedForm>().is_some() {
            return self.dialog::<UserSpecifiedForm>().map(|form| (&mut form.checks, vec![form.row]));
        }
        self.dialog::<RestoreForm>().map(|form| (&mut form.checks, form.rows.clone()))
    }

    /// One controller's certificate was looked at, or could not be.
    fn checked(&mut self, row: RowId, result: Result<CertificateChecked, Problem>) -> Vec<BackendCommand> {
        if let Some((checks, _)) = self.checking() {
            checks.of.insert(row, result);
        }
        vec![]
    }

    /// All were.
    fn checks_ended(&mut self, source: &ImportSource) -> Vec<BackendCommand> {
        self.job = None;
        let Some((checks, rows)) = self.checking() else { return vec![] };
        checks.running = false;
        let mut of = std::mem::take(&mut checks.of);
        let found: Vec<_> = rows
            .iter()
            .filter_map(|row| {
                let name = self.rows.names(&[*row]).pop()?;
                Some((*row, name, of.remove(row)?))
            })
            .collect();
        match &found[..] {
            [] => {}
            [(_, _, Err(problem))] => {
                let problem = problem.clone();
                self.show_problem(problem);
            }
            _ => {
                let names = self.rows.names(&rows);
                self.open(ImportReview { source: source.clone(), names, found });
            }
        }
        vec![]
    }

    /// The import was agreed to; the form that asked for it has done its work.
    pub(in crate::ui) fn import(&mut self, review: Box<ImportReview>) -> Vec<BackendCommand> {
        let (rows, accept_warnings) = (review.importable(), review.warns());
        if rows.is_empty() {
            self.put_back(review);
            return vec![];
        }
        self.close_all::<CaSignedForm>();
        self.close_all::<UserSpecifiedForm>();
        self.close_all::<RestoreForm>();
        let task = review.source.import(accept_warnings, &self.workspace);
        self.start(task, rows, None)
    }
}
