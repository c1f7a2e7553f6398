//! Files dropped onto the window: what they are, and which dialogs take them.

mod view;

use std::path::PathBuf;

use egui::Ui;

use crate::pki::PkiKind;
use crate::texts::TextKey;
use crate::ui::model::{
    BackendCommand, Dialog, DialogAnswer, DialogPlace, DropChoice, DropForm, DroppedFile, HoveringFiles, JobId,
    MAX_DROPPED, Message, Model, UiCommand,
};
use crate::workspace::Recognised;

/// A dialog that takes files.
struct Route {
    command: UiCommand,
    title: TextKey,
    takes: Takes,
    /// The file is of one controller, so one must be ticked and no more.
    of_one: bool,
    /// Opens the dialog with these files, in the order `takes` names them.
    open: fn(&mut Model, Vec<PathBuf>) -> Vec<BackendCommand>,
}

enum Takes {
    One(Recognised),
    Pair(Recognised, Recognised),
    /// One or more, of any of these kinds.
    Any(&'static [Recognised]),
    /// Nothing: what is missing is said.
    Not(Recognised, TextKey),
}

const CERTIFICATE: Recognised = Recognised::Pki(PkiKind::Certificate);
const CHAIN: Recognised = Recognised::Pki(PkiKind::Chain);
const BUNDLE: Recognised = Recognised::Pki(PkiKind::Bundle);
const CRL: Recognised = Recognised::Pki(PkiKind::Crl);
const CSR: Recognised = Recognised::Pki(PkiKind::Csr);
const KEY: Recognised = Recognised::Pki(PkiKind::Key);
const PKCS12: Recognised = Recognised::Pki(PkiKind::Pkcs12);
const KEY_AND_CERTIFICATE: Recognised = Recognised::Pki(PkiKind::KeyAndCertificate);

/// Every dialog that takes files, one a line; of two for the same command the first that fits. Whether a command can
/// be chosen at all is its own affair, see [`UiCommand::why_disabled`].
#[rustfmt::skip]
const ROUTES: &[Route] = &[
    Route { command: UiCommand::ACTIVATION, title: TextKey::ActivationTitle, takes: Takes::One(Recognised::Activation), of_one: false, open: Model::open_activation_of },
    Route { command: UiCommand::CONNECTION_LIST, title: TextKey::ConnectionListTitle, takes: Takes::One(Recognised::ConnectionList), of_one: false, open: Model::open_connection_list_of },
    Route { command: UiCommand::IMPORT_SETTINGS, title: TextKey::ImportTitle, takes: Takes::One(Recognised::SettingsExport), of_one: true, open: Model::open_import_of },
    Route { command: UiCommand::CA_SIGNED, title: TextKey::CaSignedTitle, takes: Takes::One(CERTIFICATE), of_one: true, open: Model::open_ca_signed_of },
    Route { command: UiCommand::CA_SIGNED, title: TextKey::CaSignedTitle, takes: Takes::One(CHAIN), of_one: true, open: Model::open_ca_signed_of },
    Route { command: UiCommand::USER_SPECIFIED, title: TextKey::UserSpecifiedTitle, takes: Takes::Pair(CERTIFICATE, KEY), of_one: true, open: Model::open_user_pair },
    Route { command: UiCommand::USER_SPECIFIED, title: TextKey::UserSpecifiedTitle, takes: Takes::One(PKCS12), of_one: true, open: Model::open_user_pfx },
    Route { command: UiCommand::USER_SPECIFIED, title: TextKey::UserSpecifiedTitle, takes: Takes::One(CERTIFICATE), of_one: true, open: Model::open_user_certificate },
    Route { command: UiCommand::USER_SPECIFIED, title: TextKey::UserSpecifiedTitle, takes: Takes::One(KEY), of_one: true, open: Model::open_user_key },
    Route { command: UiCommand::USER_SPECIFIED, title: TextKey::UserSpecifiedTitle, takes: Takes::Not(KEY_AND_CERTIFICATE, TextKey::WhySplitKey), of_one: true, open: Model::open_nothing },
    Route { command: UiCommand::CLIENT_CERTIFICATES, title: TextKey::MenuClients, takes: Takes::Any(&[CERTIFICATE, CHAIN, BUNDLE]), of_one: false, open: Model::open_clients_of },
    Route { command: UiCommand::CRL, title: TextKey::DropCrl, takes: Takes::Any(&[CRL, BUNDLE]), of_one: false, open: Model::open_crls_of },
    Route { command: UiCommand::OPEN_RECORDING, title: TextKey::OpenRecordingTitle, takes: Takes::One(Recognised::Recording), of_one: false, open: Model::open_recording_of },
    Route { command: UiCommand::CERTIFICATE_AUTHORITY, title: TextKey::DropAuthority, takes: Takes::One(CSR), of_one: false, open: Model::open_authority_of },
];

impl Dialog for DropForm {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        if self.offers() { model.submit_dropped(*self) } else { vec![] }
    }
}

impl Model {
    /// What can be done with the files now.
    fn dropped(&self, files: Vec<DroppedFile>) -> DropForm {
        let mut choices: Vec<DropChoice> = Vec::new();
        for (route, at) in ROUTES.iter().zip(0..) {
            if choices.iter().any(|choice| choice.command == route.command) {
                continue;
            }
            if let Some((files, why)) = route.takes.of(&files) {
                let many = || (route.of_one && self.rows.ticked_count() > 1).then_some(TextKey::WhyUserOne);
                let why = route.command.why_disabled(self).or(why).or_else(many);
                choices.push(DropChoice { command: route.command, title: route.title, files, why, route: at });
            }
        }
        let open = choices.iter().enumerate().filter(|(_, choice)| choice.why.is_none());
        // What takes most of them; of several, the first.
        let selected = open.rev().max_by_key(|(_, choice)| choice.files.len()).map(|(at, _)| at);
        DropForm { selected, choices, blocked: self.why_no_drop(files.len()), files }
    }

    fn why_no_drop(&self, count: usize) -> Option<TextKey> {
        // One about files dropped before is replaced.
        if self.is_other_open::<DropForm>() {
            Some(TextKey::DropDialogOpen)
        } else {
            (count > MAX_DROPPED).then_some(TextKey::DropTooMany)
        }
    }

    /// Files are held over the window, or none are any more.
    pub(in crate::ui) fn hovered(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        if paths.is_empty() {
            self.hover = None;
            return vec![];
        }
        let job = self.next_job();
        if self.takes_trust_files() {
            self.hover = Some(HoveringFiles { job, paths, found: None, taken: true });
            return vec![];
        }
        if let Some(blocked) = self.why_no_drop(paths.len()) {
            self.hover = Some(HoveringFiles { job, paths, found: Some(DropForm::blocked(blocked)), taken: false });
            return vec![];
        }
        self.hover = Some(HoveringFiles { job, paths: paths.clone(), found: None, taken: false });
        // Not every desktop says what they are before they are dropped.
        let told = paths.iter().all(|path| !path.as_os_str().is_empty());
        if told { vec![BackendCommand::Recognise { job, paths }] } else { vec![] }
    }

    pub(in crate::ui) fn drop_files(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        self.hover = None;
        if self.takes_trust_files() {
            return self.dropped_trust(paths);
        }
        self.close_all::<DropForm>();
        if let Some(blocked) = self.why_no_drop(paths.len()) {
            self.open(DropForm::blocked(blocked));
            return vec![];
        }
        let job = self.next_job();
        self.dropping = Some(job);
        self.status = Some(TextKey::Reading.text(self.language).to_owned());
        vec![BackendCommand::Recognise { job, paths }]
    }

    pub(in crate::ui) fn recognised(&mut self, job: JobId, files: Vec<DroppedFile>) -> Vec<BackendCommand> {
        if self.hover.as_ref().is_some_and(|hover| hover.job == job) {
            let found = self.dropped(files);
            if let Some(hover) = &mut self.hover {
                hover.found = Some(found);
            }
            return vec![];
        }
        if self.dropping != Some(job) {
            return vec![];
        }
        self.dropping = None;
        self.status = None;
        let form = self.dropped(files);
        match form.only() {
            Some(at) => self.open_dropped(form, at),
            None => {
                self.open(form);
                vec![]
            }
        }
    }

    /// The choice was made.
    pub(in crate::ui) fn submit_dropped(&mut self, form: DropForm) -> Vec<BackendCommand> {
        match form.selected {
            Some(at) if form.incomplete().is_none() => self.open_dropped(form, at),
            _ => vec![],
        }
    }

    fn open_dropped(&mut self, form: DropForm, at: usize) -> Vec<BackendCommand> {
        let Some(choice) = form.choices.get(at) else { return vec![] };
        let paths = choice.files.iter().filter_map(|at| form.files.get(*at)).map(|file| file.path.clone()).collect();
        (ROUTES[choice.route].open)(self, paths)
    }

    /// Of what only says what is missing.
    fn open_nothing(&mut self, _paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        vec![]
    }
}

impl Takes {
    /// Which of the files, and why not after all; `None`: none.
    fn of(&self, files: &[DroppedFile]) -> Option<(Vec<usize>, Option<TextKey>)> {
        let of = |kinds: &[Recognised]| -> Vec<usize> {
            let fits = |file: &DroppedFile| file.found.as_ref().is_ok_and(|kind| kinds.contains(kind));
            files.iter().enumerate().filter(|(_, file)| fits(file)).map(|(at, _)| at).collect()
        };
        let (found, why) = match self {
            Self::One(kind) => {
                let found = of(&[*kind]);
                let why = (found.len() > 1).then_some(TextKey::DropOneFile);
                (found, why)
            }
            Self::Pair(first, second) => match (&of(&[*first])[..], &of(&[*second])[..]) {
                ([first], [second]) => (vec![*first, *second], None),
                _ => (vec![], None),
            },
            Self::Any(kinds) => (of(kinds), None),
            Self::Not(kind, why) => (of(&[*kind]), Some(*why)),
        };
        (!found.is_empty()).then_some((found, why))
    }
}
