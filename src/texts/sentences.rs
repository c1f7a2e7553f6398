//! Sentences with values filled in, and the texts of values that belong to no other topic.

use super::{TextKey as T, Zone};
use crate::jobs::{Confirmation, JobStep, JobSummary, ServerEffect};
use crate::model::{CertificateSummary, CertificateType, ErrorCode, FirmwareVersion, Language, ServerStatus};
use crate::workspace::ThemeChoice;

/// `Error (7931)`: as the command line writes it.
pub fn status_with_error(status: &str, error: ErrorCode) -> String {
    format!("{status} ({})", error.as_str())
}

/// Number, message, cause and remedy, a line each.
pub fn error_in_full(language: Language, error: ErrorCode) -> String {
    let explained = error.explain(language);
    format!("{}: {}\n{}\n{}", error.as_str(), explained.message, explained.cause, explained.remedy)
}

/// The title of a dialog about some controllers: "Basic settings – Weld 1".
pub fn title_for(language: Language, title: T, names: &[String]) -> String {
    let title = title.text(language);
    match names {
        [] => title.to_owned(),
        [one] => format!("{title} – {one}"),
        many => format!("{title} – {}", controllers(language, many.len())),
    }
}

/// What a person agrees to, one sentence each. Empty: nothing that disturbs running clients.
pub fn confirmation(confirmation: Confirmation) -> Vec<T> {
    let Confirmation {
        server,
        replaces_certificate,
        changes_certificate,
        invalidates_ca_signed,
        replaces_request,
        changes_endpoints,
        starts_log,
        deletes_log,
        replaces_settings,
        moves_files_aside,
        overwrites_export,
        disconnects_clients,
    } = confirmation;
    let sentences = [
        (server == ServerEffect::Restarts, T::ConfirmStops),
        (server == ServerEffect::Stops, T::ConfirmStop),
        (replaces_certificate, T::ConfirmReplaces),
        (changes_certificate, T::ConfirmChangesCertificate),
        (invalidates_ca_signed, T::ConfirmInvalidatesCaSigned),
        (replaces_request, T::ConfirmReplacesRequest),
        (changes_endpoints, T::ConfirmChangesEndpoints),
        (starts_log, T::LogWarning),
        (deletes_log, T::ConfirmDeletesLog),
        (replaces_settings, T::ConfirmReplacesSettings),
        (moves_files_aside, T::ConfirmMovesFiles),
        (overwrites_export, T::ConfirmOverwritesExport),
        (disconnects_clients, T::ConfirmDisconnectsClients),
    ];
    sentences.into_iter().filter_map(|(applies, sentence)| applies.then_some(sentence)).collect()
}

/// The word for the state of a server.
pub const fn status(status: ServerStatus) -> T {
    match status {
        ServerStatus::Run => T::StatusRun,
        ServerStatus::Stop => T::StatusStop,
        ServerStatus::Error => T::StatusError,
    }
}

/// The word for a type of server certificate.
pub const fn certificate_type(kind: CertificateType) -> T {
    match kind {
        CertificateType::SelfSigned => T::TypeSelfSigned,
        CertificateType::UserSpecified => T::TypeUserSpecified,
        CertificateType::CaSigned => T::TypeCaSigned,
    }
}

/// The word for a step of a job.
pub const fn step(step: JobStep) -> T {
    match step {
        JobStep::Connect => T::StepConnect,
        JobStep::Read => T::StepRead,
        JobStep::Verify => T::StepVerify,
        JobStep::MakeKey => T::StepMakeKey,
        JobStep::Sign => T::StepSign,
        JobStep::Apply => T::StepApply,
        JobStep::SaveBackup => T::StepSaveBackup,
    }
}

/// The word for a choice of colours.
pub const fn theme(theme: ThemeChoice) -> T {
    match theme {
        ThemeChoice::System => T::ThemeSystem,
        ThemeChoice::Light => T::ThemeLight,
        ThemeChoice::Dark => T::ThemeDark,
    }
}

in_every_language! {
    sentences:
    /// A number of controllers.
    fn controllers(count: usize) -> String;
    /// How many rows the filter lets through.
    fn shown_of(shown: usize, all: usize) -> String;
    /// How many rows are ticked, and how many of them the filter hides.
    fn ticked(count: usize, hidden: usize) -> String;
    /// Over the menu of a row that is not ticked.
    fn menu_for_one(name: &str) -> String;
    /// Over the menu of a ticked row.
    fn menu_for_ticked(count: usize) -> String;
    /// How many server certificates have expired.
    fn expired(count: usize) -> String;
    /// How many server certificates expire soon.
    fn expiring(count: usize) -> String;
    /// How many days a certificate is still valid.
    fn days_left(days: i64) -> String;
    /// The name of a row's tick box, for screen readers.
    fn tick_row(name: &str) -> String;
    /// The name of a column's heading, for screen readers.
    fn sort_by(column: T) -> String;
    /// How a job ended.
    fn summary(summary: JobSummary) -> String;
    /// How far a running job is.
    fn job_running(title: T, done: usize, all: usize) -> String;
    /// What the status bar says after a job that needs no dialog.
    fn job_done(title: T, count: usize) -> String;
    /// A controller was added.
    fn added(name: &str) -> String;
    /// How many controllers were removed from the list.
    fn deleted(count: usize) -> String;
    /// How many users there are, and how many there may be.
    fn user_count(count: usize, most: usize) -> String;
    /// When a settings export was made, and of which firmware.
    fn exported_at(at: &str, firmware: FirmwareVersion) -> String;
    /// How long the server log is, how much of its end is here, and how many lines a filter found.
    fn log_size(size: u64, here: u64, lines: usize, found: Option<usize>) -> String;
    /// The version of the program.
    fn version(version: &str) -> String;
    /// A key length.
    fn bits(bits: impl std::fmt::Display) -> String;
    /// Which of the controllers whose identity is to be confirmed is on.
    fn nth_of(nth: usize, all: usize) -> String;
    /// What is said of a certificate in a line of its own.
    fn stored_certificate(summary: &CertificateSummary, zone: Zone) -> String;
    /// One certificate of a chain, above the one it issued.
    fn issuer(summary: &CertificateSummary, zone: Zone) -> String;
    /// In how many of the controllers a certificate type is stored.
    fn stored_in(count: usize, all: usize) -> String;
    /// Which of several controllers will refuse a certificate type.
    fn type_lacking(names: &[&str]) -> String;
    /// Why a controller's certificates are not known.
    fn not_read(name: &str, message: &str) -> String;
    /// How many of the certificates can be imported.
    fn importable(count: usize, all: usize) -> String;
    /// What was found of a certificate, after its severity.
    fn finding(severity: T, explained: &str) -> String;
}
