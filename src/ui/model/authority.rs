//! The small CA in the window: what it is like, and what it can be asked for.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

use secrecy::SecretString;

use super::trust::keep_change;
use super::{AuthorityCommand, Dialog, FileForm, JobId, Model, RowId, Task, Typed};
use crate::jobs::{CreateCsr, CsrFields, PushAuthority, SharedAuthority, SignCsrs};
use crate::model::{
    AuthorityRequest, AuthorityValidity, CertificateProfile, FileFormat, KeyLength, Problem, Subject, SubjectError,
    Validity,
};
use crate::pki::{Csr, IssueRequest, MAX_CERTIFICATE_FILE_BYTES, RevocationReason};
use crate::texts::TextKey;
use crate::ui::backend::{AuthorityDone, AuthorityWork, Command};
use crate::ui::picker::FileKind;
use crate::workspace::MIN_PASSPHRASE_CHARS;
use crate::workspace::authority::{AuthorityOverview, CertificateState, DEFAULT_CRL_DAYS, NewAuthority};

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
    pub passphrase: Typed,
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
    pub again: Typed,
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
        Self { action, passphrase: Typed::default(), show_passphrase: false, working: None, problem: None }
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

    pub fn passphrase_error(&self, passphrase: &Typed) -> Option<TextKey> {
        let short = (1..MIN_PASSPHRASE_CHARS).contains(&passphrase.0.chars().count());
        short.then_some(TextKey::CaPassphraseRule)
    }

    pub fn again_error(&self, passphrase: &Typed) -> Option<TextKey> {
        (!self.again.0.is_empty() && self.again.0 != passphrase.0).then_some(TextKey::CaPassphrasesDiffer)
    }

    fn incomplete(&self, passphrase: &Typed) -> Option<TextKey> {
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

impl Model {
    pub(super) fn open_authority(&mut self) -> Vec<Command> {
        self.dialogs.push(Dialog::Authority(AuthorityView {
            reading: None,
            overview: None,
            ticked: BTreeSet::new(),
            saved: None,
            csr: None,
        }));
        self.look_at_authority()
    }

    /// For a file with a signing request.
    pub(super) fn open_authority_of(&mut self, paths: Vec<PathBuf>) -> Vec<Command> {
        let commands = self.open_authority();
        if let Some(view) = self.authority_view() {
            view.csr = paths.into_iter().next();
        }
        commands
    }

    /// Goes on with a request that was dropped, if there is a CA by now.
    fn sign_dropped(&mut self) -> Vec<Command> {
        let Some(view) = self.authority_view().filter(|view| view.overview.is_some()) else { return vec![] };
        let Some(path) = view.csr.take() else { return vec![] };
        self.ask_authority(AuthorityCommand::SignFile);
        if let Some(file) = self.dialogs.last_mut().and_then(Dialog::file) {
            file.path = path.display().to_string();
        }
        self.read_typed()
    }

    /// Reads it again for the dialog that shows it, if it is open.
    pub(super) fn look_at_authority(&mut self) -> Vec<Command> {
        let job = self.next_job();
        let Some(view) = self.authority_view() else { return vec![] };
        view.reading = Some(job);
        vec![Command::Authority { job, work: AuthorityWork::Look }]
    }

    fn authority_view(&mut self) -> Option<&mut AuthorityView> {
        self.dialogs.iter_mut().find_map(|dialog| match dialog {
            Dialog::Authority(view) => Some(view),
            _ => None,
        })
    }

    pub(super) fn ask_authority(&mut self, command: AuthorityCommand) {
        let rows = self.rows.ticked();
        let names = self.rows.names(&rows);
        let now = self.now;
        let backup = self.workspace.root().join(format!("CA-backup-{}.json", now.format("%Y-%m-%d")));
        let Some(view) = self.authority_view() else { return };
        let action = match command {
            AuthorityCommand::Create => AuthorityAction::Create(CreateAuthorityForm {
                common_name: String::new(),
                organisation: String::new(),
                years: AuthorityValidity::default().years(),
                key_length: KeyLength::Rsa4096,
                intermediate: false,
                again: Typed::default(),
            }),
            AuthorityCommand::Restore => AuthorityAction::Restore { path: String::new() },
            AuthorityCommand::SignControllers if rows.is_empty() => return,
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
                    return;
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
        self.dialogs.push(Dialog::AuthorityForm(AuthorityForm::new(action)));
    }

    pub(super) fn submit_authority(&mut self, mut form: AuthorityForm) -> Vec<Command> {
        if form.working.is_none() && form.reads_file() {
            self.dialogs.push(Dialog::AuthorityForm(form));
            return self.read_typed();
        }
        let work = if form.incomplete().is_none() { self.work(&form) } else { None };
        let commands = match work {
            None => vec![],
            Some(work) => {
                let job = self.next_job();
                form.working = Some(job);
                form.problem = None;
                vec![Command::Authority { job, work }]
            }
        };
        self.dialogs.push(Dialog::AuthorityForm(form));
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

    pub(super) fn authority_done(&mut self, job: JobId, result: Result<AuthorityDone, Problem>) -> Vec<Command> {
        let waits = |dialog: &Dialog| matches!(dialog, Dialog::AuthorityForm(form) if form.working == Some(job));
        let form = self.dialogs.iter().position(waits);
        let done = match result {
            Ok(done) => done,
            Err(problem) => {
                self.authority_failed(job, form, problem);
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
        let Some(Dialog::AuthorityForm(form)) = form.map(|index| self.dialogs.remove(index)) else {
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
                let task = Task::with_results(TextKey::CaCrlTitle, push, keep_change).act(TextKey::ActSendCrl);
                self.start(task.on_closed(Model::look_at_authority), rows, None)
            }
            _ => self.sign_dropped(),
        }
    }

    fn authority_failed(&mut self, job: JobId, form: Option<usize>, problem: Problem) {
        if let Some(Dialog::AuthorityForm(form)) = form.and_then(|index| self.dialogs.get_mut(index)) {
            form.working = None;
            form.problem = Some(problem);
            return;
        }
        // Without a look at it there is nothing to show.
        let looked = self.authority_view().is_some_and(|view| view.reading == Some(job));
        if looked {
            self.dialogs.retain(|dialog| !matches!(dialog, Dialog::Authority(_)));
        }
        self.show_problem(problem);
    }
}

/// What the name of the intermediate CA ends with.
const INTERMEDIATE: &str = " intermediate";
