//! Texts with something filled in.

use chrono::{DateTime, Datelike as _, FixedOffset, Local, Offset as _, Utc};

use super::TextKey as T;
use crate::jobs::{Confirmation, ServerEffect, Step, Summary};
use crate::model::{CertificateSummary, CertificateType, ErrorCode, FirmwareVersion, Language, ServerStatus};
use crate::workspace::ThemeChoice;

/// Where times are shown as of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Zone {
    /// This computer's time zone.
    #[default]
    Local,
    Fixed(FixedOffset),
}

impl Zone {
    pub fn date(self, at: DateTime<Utc>) -> String {
        self.format(at, "%Y-%m-%d")
    }

    pub fn date_time(self, at: DateTime<Utc>) -> String {
        self.format(at, "%Y-%m-%d %H:%M")
    }

    fn format(self, at: DateTime<Utc>, pattern: &str) -> String {
        // At the ends of what can be written, another zone has no such time.
        let zone = if (0..=9999).contains(&at.year()) { self } else { Self::Fixed(Utc.fix()) };
        match zone {
            Self::Local => at.with_timezone(&Local).format(pattern).to_string(),
            Self::Fixed(offset) => at.with_timezone(&offset).format(pattern).to_string(),
        }
    }
}

fn s(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}

pub fn controllers(language: Language, count: usize) -> String {
    match language {
        Language::En => format!("{count} controller{}", s(count)),
        Language::Zh => format!("{count} 台控制器"),
    }
}

pub fn shown_of(language: Language, shown: usize, all: usize) -> String {
    match language {
        Language::En => format!("{shown} of {all} controllers"),
        Language::Zh => format!("显示 {shown} / {all} 台控制器"),
    }
}

pub fn ticked(language: Language, count: usize, hidden: usize) -> String {
    match (language, hidden) {
        (Language::En, 0) => format!("{count} ticked"),
        (Language::En, _) => format!("{count} ticked, {hidden} of them hidden by the search"),
        (Language::Zh, 0) => format!("已勾选 {count} 台"),
        (Language::Zh, _) => format!("已勾选 {count} 台，其中 {hidden} 台未显示"),
    }
}

pub fn expired(language: Language, count: usize) -> String {
    match language {
        Language::En => format!("{count} certificate{} expired", s(count)),
        Language::Zh => format!("{count} 个证书已过期"),
    }
}

pub fn expiring(language: Language, count: usize) -> String {
    match language {
        Language::En => format!("{count} certificate{} expire{} soon", s(count), if count == 1 { "s" } else { "" }),
        Language::Zh => format!("{count} 个证书即将到期"),
    }
}

pub fn days_left(language: Language, days: i64) -> String {
    match language {
        Language::En => format!("{days} day{} left", if days == 1 { "" } else { "s" }),
        Language::Zh => format!("剩余 {days} 天"),
    }
}

pub fn tick_row(language: Language, name: &str) -> String {
    match language {
        Language::En => format!("Tick {name}"),
        Language::Zh => format!("勾选 {name}"),
    }
}

pub fn sort_by(language: Language, column: T) -> String {
    match language {
        Language::En => format!("Sort by {}", lower_first(column.text(language))),
        Language::Zh => format!("按{}排序", column.text(language)),
    }
}

/// For the middle of a sentence; "IP" stays as it is.
fn lower_first(text: &str) -> String {
    match text.split_at_checked(1) {
        Some((first, rest)) if rest.starts_with(char::is_lowercase) => first.to_lowercase() + rest,
        _ => text.to_owned(),
    }
}

pub fn sorted_tip(language: Language) -> &'static str {
    match language {
        Language::En => "Click to sort, click again to turn the order round",
        Language::Zh => "单击排序，再次单击反转顺序",
    }
}

pub fn summary(language: Language, summary: Summary) -> String {
    let Summary { done, failed, not_started } = summary;
    let parts = match language {
        Language::En => [
            (done, format!("{done} done")),
            (failed, format!("{failed} failed")),
            (not_started, format!("{not_started} not started")),
        ],
        Language::Zh => [
            (done, format!("完成 {done} 台")),
            (failed, format!("失败 {failed} 台")),
            (not_started, format!("未开始 {not_started} 台")),
        ],
    };
    let said: Vec<String> = parts.into_iter().filter(|(n, _)| *n > 0).map(|(_, text)| text).collect();
    said.join(if language == Language::En { ", " } else { "，" })
}

/// What the status bar says after a job that needs no dialog.
/// How far a running job is.
pub fn job_running(language: Language, title: T, done: usize, all: usize) -> String {
    let title = title.text(language).trim_end_matches('…');
    match language {
        Language::En => format!("{title}: {done} of {all} controllers done"),
        Language::Zh => format!("{title}：已完成 {done} / {all} 台控制器"),
    }
}

pub fn job_done(language: Language, title: T, count: usize) -> String {
    let title = title.text(language).trim_end_matches('…');
    match language {
        Language::En => format!("{title}: {} done", controllers(language, count)),
        Language::Zh => format!("{title}：{} 台控制器已完成", count),
    }
}

pub fn added(language: Language, name: &str) -> String {
    match language {
        Language::En => format!("{name} was added"),
        Language::Zh => format!("已添加 {name}"),
    }
}

pub fn deleted(language: Language, count: usize) -> String {
    match language {
        Language::En => format!("{} deleted from the list", controllers(language, count)),
        Language::Zh => format!("已从列表中删除 {count} 台控制器"),
    }
}

pub fn user_count(language: Language, count: usize, most: usize) -> String {
    match language {
        Language::En => format!("{count} of at most {most} users"),
        Language::Zh => format!("{count} 个用户，最多 {most} 个"),
    }
}

/// When a settings export was made, and of which firmware.
pub fn exported_at(language: Language, at: &str, firmware: FirmwareVersion) -> String {
    match language {
        Language::En => format!("{at}, firmware {firmware}"),
        Language::Zh => format!("{at}，固件 {firmware}"),
    }
}

/// How long the server log is, how much of its end is here, and how many lines a filter found.
pub fn log_size(language: Language, size: u64, here: u64, lines: usize, found: Option<usize>) -> String {
    let bytes = match (language, here < size) {
        (Language::En, true) => format!("The last {} of {}", byte_count(here), byte_count(size)),
        (Language::Zh, true) => format!("共 {}，显示最后 {}", byte_count(size), byte_count(here)),
        (_, false) => byte_count(size),
    };
    match (language, found) {
        (Language::En, None) => format!("{bytes}, {lines} line{}", s(lines)),
        (Language::En, Some(found)) => format!("{bytes}, {found} of {lines} line{}", s(lines)),
        (Language::Zh, None) => format!("{bytes}，{lines} 行"),
        (Language::Zh, Some(found)) => format!("{bytes}，显示 {found} / {lines} 行"),
    }
}

fn byte_count(bytes: u64) -> String {
    const KIB: u64 = 1024;
    match bytes {
        0..KIB => format!("{bytes} B"),
        KIB..0x10_0000 => format!("{:.1} KiB", bytes as f64 / KIB as f64),
        _ => format!("{:.1} MiB", bytes as f64 / (KIB * KIB) as f64),
    }
}

/// `Error (7931)`: as the command line writes it.
pub fn status_with_error(status: &str, error: ErrorCode) -> String {
    format!("{status} ({})", error.as_str())
}

/// Number, message, cause and remedy, a line each.
pub fn error_in_full(language: Language, error: ErrorCode) -> String {
    let explained = error.explain(language);
    format!("{}: {}\n{}\n{}", error.as_str(), explained.message, explained.cause, explained.remedy)
}

pub fn version(language: Language, version: &str) -> String {
    match language {
        Language::En => format!("Version {version}"),
        Language::Zh => format!("版本 {version}"),
    }
}

pub fn bits(language: Language, bits: impl std::fmt::Display) -> String {
    match language {
        Language::En => format!("{bits} bits"),
        Language::Zh => format!("{bits} 位"),
    }
}

/// Which of the controllers whose identity is to be confirmed is on.
pub fn nth_of(language: Language, nth: usize, all: usize) -> String {
    match language {
        Language::En => format!("{nth} of {all}"),
        Language::Zh => format!("第 {nth} 台，共 {all} 台"),
    }
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

/// What is said of a certificate in a line of its own.
pub fn stored_certificate(language: Language, summary: &CertificateSummary, zone: Zone) -> String {
    let CertificateSummary { issued_to, issued_by, not_after, .. } = summary;
    let until = zone.date(*not_after);
    match language {
        Language::En => format!("Issued to {issued_to} by {issued_by}, valid until {until}"),
        Language::Zh => format!("颁发给 {issued_to}，颁发者 {issued_by}，有效期至 {until}"),
    }
}

/// One certificate of a chain, above the one it issued.
pub fn issuer(language: Language, summary: &CertificateSummary, zone: Zone) -> String {
    let CertificateSummary { issued_to, issued_by, not_before, not_after, .. } = summary;
    let (from, until) = (zone.date(*not_before), zone.date(*not_after));
    match (language, issued_to == issued_by) {
        (Language::En, true) => format!("{issued_to}, root, valid from {from} until {until}"),
        (Language::En, false) => format!("{issued_to}, by {issued_by}, valid from {from} until {until}"),
        (Language::Zh, true) => format!("{issued_to}，根证书，有效期 {from} 至 {until}"),
        (Language::Zh, false) => format!("{issued_to}，颁发者 {issued_by}，有效期 {from} 至 {until}"),
    }
}

pub fn stored_in(language: Language, count: usize, all: usize) -> String {
    match language {
        Language::En => format!("Stored in {count} of {}", controllers(language, all)),
        Language::Zh => format!("{all} 台控制器中有 {count} 台已保存"),
    }
}

/// Which of several controllers will refuse a certificate type.
pub fn type_lacking(language: Language, names: &[&str]) -> String {
    let (more, named) = (names.len().saturating_sub(5), names.iter().take(5).copied().collect::<Vec<_>>());
    match (language, more) {
        (Language::En, 0) => format!("Not stored in {}; there the change fails", named.join(", ")),
        (Language::En, _) => format!("Not stored in {} and {more} more; there the change fails", named.join(", ")),
        (Language::Zh, 0) => format!("{} 未保存该类型，更改将失败", named.join("、")),
        (Language::Zh, _) => format!("{} 等 {} 台未保存该类型，更改将失败", named.join("、"), names.len()),
    }
}

/// Why a controller's certificates are not known.
pub fn not_read(language: Language, name: &str, message: &str) -> String {
    match language {
        Language::En => format!("{name}: {message}"),
        Language::Zh => format!("{name}：{message}"),
    }
}

pub fn importable(language: Language, count: usize, all: usize) -> String {
    match language {
        Language::En => format!("{count} of {} can be imported", certificates(all)),
        Language::Zh => format!("{all} 个证书中有 {count} 个可以导入"),
    }
}

fn certificates(count: usize) -> String {
    format!("{count} certificate{}", s(count))
}

/// What was found of a certificate, after its severity.
pub fn finding(language: Language, severity: T, explained: &str) -> String {
    match language {
        Language::En => format!("{}: {explained}", severity.text(language)),
        Language::Zh => format!("{}：{explained}", severity.text(language)),
    }
}

/// What a person agrees to, one sentence each. Empty: nothing that disturbs anybody.
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

pub const fn status(status: ServerStatus) -> T {
    match status {
        ServerStatus::Run => T::StatusRun,
        ServerStatus::Stop => T::StatusStop,
        ServerStatus::Error => T::StatusError,
    }
}

pub const fn certificate_type(kind: CertificateType) -> T {
    match kind {
        CertificateType::SelfSigned => T::TypeSelfSigned,
        CertificateType::UserSpecified => T::TypeUserSpecified,
        CertificateType::CaSigned => T::TypeCaSigned,
    }
}

pub const fn step(step: Step) -> T {
    match step {
        Step::Connect => T::StepConnect,
        Step::Read => T::StepRead,
        Step::Verify => T::StepVerify,
        Step::MakeKey => T::StepMakeKey,
        Step::Sign => T::StepSign,
        Step::Apply => T::StepApply,
        Step::SaveBackup => T::StepSaveBackup,
    }
}

pub const fn theme(theme: ThemeChoice) -> T {
    match theme {
        ThemeChoice::System => T::ThemeSystem,
        ThemeChoice::Light => T::ThemeLight,
        ThemeChoice::Dark => T::ThemeDark,
    }
}
