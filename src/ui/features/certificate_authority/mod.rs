//! The small CA in the window: what it is like, and what it can be asked for.

mod form_view;
mod view;

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

use egui::Ui;
use secrecy::SecretString;

use crate::jobs::{CreateCsr, CsrFields, PushAuthority, SharedAuthority, SignCsrs};
use crate::model::{
    AuthorityRequest, AuthorityValidity, CertificateProfile, FileFormat, KeyLength, Problem, Subject, SubjectError,
    Validity,
};
use crate::pki::{Csr, IssueRequest, MAX_CERTIFICATE_FILE_BYTES, RevocationReason};
use crate::texts::TextKey;
use crate::ui::features::client_certificates::change_task;
use crate::ui::model::{
    AuthorityResult, AuthorityWork, BackendCommand, Dialog, DialogAnswer, DialogPlace, FileForm, JobId, Message, Model,
    RowId, SecretInput, Task, UiCommand,
};
use crate::ui::picker::FileKind;
use crate::workspace::MIN_PASSPHRASE_CHARS;
use crate::workspace::authority::{AuthorityOverview, CertificateState, DEFAULT_CRL_DAYS, NewAuthority};

/// What the small CA can be asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AuthorityCommand {
    Create,
    Restore,
    SignControllers,
    SignFile,
    Revoke,
    PublishCrl,
    BackUp,
}

/// The dialog about the CA.
#[derive(Debug)]
pub struct AuthorityView {
    pub reading: Option<JobId>,
    /// `None`: there is none, or it is not known yet.
    pub overview: Option<Box<AuthorityOverview>>,
    /// Serial numbers of the issued certificates that are ticked.
    pub ticked: BTreeSet<String>,
    /// What was written last.
    pub saved: Option<PathBuf>,
    /// A signing request that was dropped onto the window, to be signed once it is known that there is a CA.
    csr: Option<PathBuf>,
}

/// Something the CA is asked for, together with its passphrase.
#[derive(Debug)]
pub struct AuthorityForm {
    pub action: AuthorityAction,
    pub passphrase: SecretInput,
    pub show_passphrase: bool,
    pub working: Option<JobId>,
    /// Why the last attempt failed.
    pub problem: Option<Problem>,
}

#[derive(Debug)]
pub enum AuthorityAction {
    Create(CreateAuthorityForm),
    Restore { path: String },
    SignControllers(SignControllersForm),
    SignFile(SignFileForm),
    Revoke { serial_numbers: Vec<String>, names: Vec<String>, reason: RevocationReason },
    PublishCrl { rows: Vec<RowId>, names: Vec<String>, push: bool, trust: bool },
    BackUp { path: String },
}

/// What a new CA is to be like.
#[derive(Debug)]
pub struct CreateAuthorityForm {
    pub common_name: String,
    pub organisation: String,
    pub years: u8,
    pub key_length: KeyLength,
    pub intermediate: bool,
    /// The passphrase once more.
    pub again: SecretInput,
}

/// Which certificates the ticked controllers get.
#[derive(Debug)]
pub struct SignControllersForm {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    pub organisation: String,
    pub years: u8,
    pub new_key: bool,
    pub renew: bool,
    pub accept_warnings: bool,
}

/// A signing request from a file.
#[derive(Debug)]
pub struct SignFileForm {
    pub file: FileForm,
    pub csr: Option<Csr>,
    pub profile: CertificateProfile,
    pub years: u8,
}

impl AuthorityForm {
    fn new(action: AuthorityAction) -> Self {
        Self { action, passphrase: SecretInput::default(), show_passphrase: false, working: None, problem: None }
    }

    /// Why it cannot be sent yet.
    pub fn incomplete(&self) -> Option<TextKey> {
        if self.working.is_some() {
            return Some(TextKey::CaWorking);
        }
        let of_action = match &self.action {
            AuthorityAction::Create(form) => form.incomplete(&self.passphrase),
            AuthorityAction::Restore { path } | AuthorityAction::BackUp { path } => {
                path.trim().is_empty().then_some(TextKey::FileRule)
            }
            AuthorityAction::SignControllers(form) => form.organisation_error(),
            AuthorityAction::SignFile(form) if self.reads_file() => return form.file.incomplete(),
            AuthorityAction::SignFile(_) | AuthorityAction::Revoke { .. } | AuthorityAction::PublishCrl { .. } => None,
        };
        of_action.or_else(|| self.passphrase.0.is_empty().then_some(TextKey::CaPassphraseNeeded))
    }

    /// What a file holds.
    pub fn take_in(&mut self, bytes: &[u8]) -> Result<(), Problem> {
        if let AuthorityAction::SignFile(form) = &mut self.action {
            form.csr = None;
            form.csr = Some(Csr::from_any(bytes)?);
        }
        Ok(())
    }

    /// The main button reads the file, as what is shown is not what is in it.
    pub fn reads_file(&self) -> bool {
        matches!(&self.action, AuthorityAction::SignFile(form) if !form.file.is_shown())
    }
}

impl CreateAuthorityForm {
    fn subject(&self, suffix: &str) -> Subject {
        Subject {
            common_name: format!("{}{suffix}", self.common_name.trim()),
            country: String::new(),
            state: String::new(),
            locality: String::new(),
            organisation: self.organisation.trim().to_owned(),
        }
    }

    pub fn name_error(&self) -> Option<TextKey> {
        let longest = if self.intermediate { INTERMEDIATE } else { "" };
        let subject = Subject { organisation: String::new(), ..self.subject(longest) };
        if self.common_name.is_empty() { None } else { subject.check().err().map(rule) }
    }

    pub fn organisation_error(&self) -> Option<TextKey> {
        organisation_error(&self.organisation)
    }

    pub fn passphrase_error(&self, passphrase: &SecretInput) -> Option<TextKey> {
        let short = (1..MIN_PASSPHRASE_CHARS).contains(&passphrase.0.chars().count());
        short.then_some(TextKey::CaPassphraseRule)
    }

    pub fn again_error(&self, passphrase: &SecretInput) -> Option<TextKey> {
        (!self.again.0.is_empty() && self.again.0 != passphrase.0).then_some(TextKey::CaPassphrasesDiffer)
    }

    fn incomplete(&self, passphrase: &SecretInput) -> Option<TextKey> {
        if self.common_name.trim().is_empty() {
            return Some(TextKey::CommonNameRule);
        }
        self.name_error()
            .or_else(|| self.organisation_error())
            .or_else(|| self.passphrase_error(passphrase))
            .or_else(|| (self.again.0 != passphrase.0).then_some(TextKey::CaPassphrasesDiffer))
    }

    fn new_authority(&self) -> Option<NewAuthority> {
        let request = |suffix: &str, years: u8| {
            Some(AuthorityRequest {
                subject: self.subject(suffix),
                key_length: self.key_length,
                validity: AuthorityValidity::try_from(years).ok()?,
            })
        };
        let intermediate = if self.intermediate { Some(request(INTERMEDIATE, self.years.min(10))?) } else { None };
        Some(NewAuthority { root: request("", self.years)?, intermediate, crl_days: DEFAULT_CRL_DAYS })
    }
}

impl SignControllersForm {
    pub fn organisation_error(&self) -> Option<TextKey> {
        organisation_error(&self.organisation)
    }

    fn task(&self, passphrase: SecretString, model: &Model) -> Option<Task> {
        let fields = CsrFields {
            common_name: None,
            country: String::new(),
            state: String::new(),
            locality: String::new(),
            organisation: self.organisation.trim().to_owned(),
            key_length: KeyLength::Rsa2048,
        };
        let operation = SignCsrs {
            authority: Arc::new(SharedAuthority::new(model.workspace.authority(), passphrase)),
            request: CreateCsr {
                fields,
                format: FileFormat::Der,
                files: model.workspace.certificate_files(),
                backup: model.options.backup,
            },
            new_key: self.new_key,
            renew: self.renew,
            validity: Validity::try_from(self.years).ok()?,
            allow_short_keys: false,
            accept_warnings: self.accept_warnings,
        };
        let task = Task::new(TextKey::CaSignTitle, operation).act(TextKey::ActSignAndImport);
        Some(task.on_closed(Model::look_at_authority))
    }
}

fn organisation_error(text: &str) -> Option<TextKey> {
    let subject = Subject {
        common_name: "x".into(),
        country: String::new(),
        state: String::new(),
        locality: String::new(),
        organisation: text.trim().to_owned(),
    };
    subject.check().err().map(rule)
}

fn rule(error: SubjectError) -> TextKey {
    match error {
        SubjectError::TooLong(..) => TextKey::LengthRule,
        _ => TextKey::HalfWidthRule,
    }
}

impl UiCommand {
    /// Shows the small CA of the workspace.
    pub const CERTIFICATE_AUTHORITY: Self =
        Self::new(TextKey::CertificateAuthority, TextKey::CertificateAuthorityTip, |model, _| model.open_authority())
            .in_menu(TextKey::MenuTools);
}

impl Dialog for AuthorityView {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, model, messages)
    }
}

impl Dialog for AuthorityForm {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        form_view::show(ui, self, place.focus, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.submit_authority(self)
    }

    fn file(&mut self) -> Option<&mut FileForm> {
        match &mut self.action {
            AuthorityAction::SignFile(form) => Some(&mut form.file),
            _ => None,
        }
    }

    fn take_in_file(&mut self, bytes: &[u8], _model: &Model) -> Result<(), Problem> {
        self.take_in(bytes)
    }
}

impl Model {
    pub(in crate::ui) fn open_authority(&mut self) -> Vec<BackendCommand> {
        self.open(AuthorityView { reading: None, overview: None, ticked: BTreeSet::new(), saved: None, csr: None });
        self.look_at_authority()
    }

    /// For a file with a signing request.
    pub(in crate::ui) fn open_authority_of(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        let commands = self.open_authority();
        if let Some(view) = self.authority_view() {
            view.csr = paths.into_iter().next();
        }
        commands
    }

    /// Goes on with a request that was dropped, if there is a CA by now.
    fn sign_dropped(&mut self) -> Vec<BackendCommand> {
        let Some(view) = self.authority_view().filter(|view| view.overview.is_some()) else { return vec![] };
        let Some(path) = view.csr.take() else { return vec![] };
        self.ask_authority(AuthorityCommand::SignFile);
        if let Some(file) = self.dialogs.last_mut().and_then(|dialog| dialog.file()) {
            file.path = path.display().to_string();
        }
        self.read_typed()
    }

    /// Reads it again for the dialog that shows it, if it is open.
    pub(in crate::ui) fn look_at_authority(&mut self) -> Vec<BackendCommand> {
        let job = self.next_job();
        let Some(view) = self.authority_view() else { return vec![] };
        view.reading = Some(job);
        vec![BackendCommand::Authority { job, work: AuthorityWork::Look }]
    }

    fn authority_view(&mut self) -> Option<&mut AuthorityView> {
        self.dialog::<AuthorityView>()
    }

    pub(in crate::ui) fn ask_authority(&mut self, command: AuthorityCommand) -> Vec<BackendCommand> {
        let rows = self.rows.ticked();
        let names = self.rows.names(&rows);
        let now = self.now;
        let backup = self.workspace.root().join(format!("CA-backup-{}.json", now.format("%Y-%m-%d")));
        let Some(view) = self.authority_view() else { return vec![] };
        let action = match command {
            AuthorityCommand::Create => AuthorityAction::Create(CreateAuthorityForm {
                common_name: String::new(),
                organisation: String::new(),
                years: AuthorityValidity::default().years(),
                key_length: KeyLength::Rsa4096,
                intermediate: false,
                again: SecretInput::default(),
            }),
            AuthorityCommand::Restore => AuthorityAction::Restore { path: String::new() },
            AuthorityCommand::SignControllers if rows.is_empty() => return vec![],
            AuthorityCommand::SignControllers => AuthorityAction::SignControllers(SignControllersForm {
                rows,
                names,
                organisation: String::new(),
                years: 5,
                new_key: false,
                renew: false,
                accept_warnings: false,
            }),
            AuthorityCommand::SignFile => AuthorityAction::SignFile(SignFileForm {
                file: FileForm::new(FileKind::Csr, MAX_CERTIFICATE_FILE_BYTES),
                csr: None,
                profile: CertificateProfile::Client,
                years: 5,
            }),
            AuthorityCommand::Revoke => {
                let issued = view.overview.iter().flat_map(|overview| &overview.issued);
                let chosen: Vec<_> = issued
                    .filter(|i| view.ticked.contains(&i.serial_number) && i.state(now) != CertificateState::Revoked)
                    .collect();
                if chosen.is_empty() {
                    return vec![];
                }
                AuthorityAction::Revoke {
                    serial_numbers: chosen.iter().map(|issued| issued.serial_number.clone()).collect(),
                    names: chosen.iter().map(|issued| issued.issued_to.clone()).collect(),
                    reason: RevocationReason::Unspecified,
                }
            }
            AuthorityCommand::PublishCrl => {
                AuthorityAction::PublishCrl { push: !rows.is_empty(), rows, names, trust: false }
            }
            AuthorityCommand::BackUp => AuthorityAction::BackUp { path: backup.display().to_string() },
        };
        view.saved = None;
        self.open(AuthorityForm::new(action));
        vec![]
    }

    fn submit_authority(&mut self, mut form: Box<AuthorityForm>) -> Vec<BackendCommand> {
        if form.working.is_none() && form.reads_file() {
            self.put_back(form);
            return self.read_typed();
        }
        let work = if form.incomplete().is_none() { self.work(&form) } else { None };
        let commands = match work {
            None => vec![],
            Some(work) => {
                let job = self.next_job();
                form.working = Some(job);
                form.problem = None;
                vec![BackendCommand::Authority { job, work }]
            }
        };
        self.put_back(form);
        commands
    }

    fn work(&self, form: &AuthorityForm) -> Option<AuthorityWork> {
        let passphrase = SecretString::from(form.passphrase.0.clone());
        let absolute = |path: &str| self.workspace.root().join(path.trim().trim_matches('"'));
        Some(match &form.action {
            AuthorityAction::Create(form) => AuthorityWork::Create { new: Box::new(form.new_authority()?), passphrase },
            AuthorityAction::Restore { path } => AuthorityWork::Restore { path: absolute(path), passphrase },
            AuthorityAction::SignControllers(_) => AuthorityWork::Unlock { passphrase },
            AuthorityAction::SignFile(form) => AuthorityWork::Sign {
                csr: Box::new(form.csr.clone()?),
                request: Box::new(IssueRequest {
                    profile: form.profile,
                    validity: Validity::try_from(form.years).ok()?,
                    names: None,
                    allow_short_keys: false,
                }),
                passphrase,
            },
            AuthorityAction::Revoke { serial_numbers, reason, .. } => {
                AuthorityWork::Revoke { serial_numbers: serial_numbers.clone(), reason: *reason, passphrase }
            }
            AuthorityAction::PublishCrl { .. } => AuthorityWork::PublishCrl { passphrase },
            AuthorityAction::BackUp { path } => AuthorityWork::BackUp { path: absolute(path), passphrase },
        })
    }

    pub(in crate::ui) fn authority_done(
        &mut self,
        job: JobId,
        result: Result<AuthorityResult, Problem>,
    ) -> Vec<BackendCommand> {
        let done = match result {
            Ok(done) => done,
            Err(problem) => {
                self.authority_failed(job, problem);
                return vec![];
            }
        };
        // Also when the form was closed before its work was done.
        if let Some(view) = self.authority_view() {
            view.reading = None;
            view.ticked.clear();
            view.saved = done.saved;
            view.overview.clone_from(&done.overview);
        }
        let Some(form) = self.take_out::<AuthorityForm>(|form| form.working == Some(job)) else {
            return self.sign_dropped();
        };
        match (form.action, done.overview) {
            (AuthorityAction::SignControllers(signing), _) => {
                let passphrase = SecretString::from(form.passphrase.0.clone());
                match signing.task(passphrase, self) {
                    Some(task) => self.start(task, signing.rows, None),
                    None => vec![],
                }
            }
            (AuthorityAction::PublishCrl { rows, push: true, trust, .. }, Some(overview)) => {
                let push = PushAuthority::new(&overview, trust);
                let task = change_task(TextKey::CaCrlTitle, push).act(TextKey::ActSendCrl);
                self.start(task.on_closed(Model::look_at_authority), rows, None)
            }
            _ => self.sign_dropped(),
        }
    }

    fn authority_failed(&mut self, job: JobId, problem: Problem) {
        if let Some(form) = self.dialog::<AuthorityForm>().filter(|form| form.working == Some(job)) {
            form.working = None;
            form.problem = Some(problem);
            return;
        }
        // Without a look at it there is nothing to show.
        let looked = self.authority_view().is_some_and(|view| view.reading == Some(job));
        if looked {
            self.close_all::<AuthorityView>();
        }
        self.show_problem(problem);
    }
}

/// What the name of the intermediate CA ends with.
const INTERMEDIATE: &str = " intermediate";
