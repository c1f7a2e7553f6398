//! About whom controllers trust.

use chrono::Duration;

use super::TextKey as T;
use crate::jobs::SkipReason;
use crate::model::{CertificateStatus, Language, Problem};
use crate::pki::{CrlDates, CrlHealth, CrlIssuer};
use crate::protocol::CutClient;
use crate::ui::model::trust::{ChainState, Done, PaneKind, TrustColumn};

pub const fn pane(kind: PaneKind) -> T {
    match kind {
        PaneKind::Trusted => T::TrustTrusted,
        PaneKind::Rejected => T::TrustRejected,
        PaneKind::Issuers => T::TrustIssuers,
        PaneKind::Crls => T::TrustCrls,
    }
}

/// What to do when a list is empty.
pub const fn pane_empty(kind: PaneKind) -> T {
    match kind {
        PaneKind::Trusted => T::TrustTrustedEmpty,
        PaneKind::Rejected => T::TrustRejectedEmpty,
        PaneKind::Issuers => T::TrustIssuersEmpty,
        PaneKind::Crls => T::CrlEmpty,
    }
}

pub const fn trust_column(column: TrustColumn) -> T {
    match column {
        TrustColumn::IssuedTo => T::TrustIssuedTo,
        TrustColumn::IssuedBy => T::TrustIssuedBy,
        TrustColumn::FileName => T::TrustFileName,
        TrustColumn::SerialNumber => T::ColumnSerial,
        TrustColumn::ValidFrom => T::TrustValidFrom,
        TrustColumn::ValidUntil => T::TrustValidUntil,
        TrustColumn::Thumbprint => T::TrustThumbprint,
        TrustColumn::Reason => T::TrustReason,
        TrustColumn::Address => T::TrustAddress,
        TrustColumn::Count => T::TrustCount,
        TrustColumn::FirstSeen => T::TrustFirstSeen,
        TrustColumn::LastSeen => T::TrustLastSeen,
        TrustColumn::Issuer => T::CrlIssuer,
        TrustColumn::ThisUpdate => T::CrlThisUpdate,
        TrustColumn::NextUpdate => T::CrlNextUpdate,
        TrustColumn::Entries => T::CrlEntries,
        TrustColumn::Number => T::CrlNumber,
        TrustColumn::Health => T::CrlHealth,
    }
}

/// The end of a sentence as a line of its own.
pub fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map(|first| first.to_uppercase().chain(chars).collect()).unwrap_or_default()
}

/// "3 of 50".
pub fn how_full(language: Language, count: usize, limit: Option<usize>) -> String {
    match (language, limit) {
        (Language::En, Some(limit)) => format!("{count} of {limit}"),
        (Language::Zh, Some(limit)) => format!("{count} / {limit}"),
        (_, None) => count.to_string(),
    }
}

/// "3 of 50, 1 ticked".
pub fn full_and_ticked(language: Language, full: &str, count: usize, hidden: usize) -> String {
    match (language, hidden) {
        (Language::En, 0) => format!("{full}, {count} ticked"),
        (Language::En, _) => format!("{full}, {count} ticked, {hidden} of them hidden"),
        (Language::Zh, 0) => format!("{full}，已勾选 {count} 项"),
        (Language::Zh, _) => format!("{full}，已勾选 {count} 项，其中 {hidden} 项未显示"),
    }
}

pub fn new_clients(language: Language, count: usize) -> String {
    match language {
        Language::En => format!("{count} new"),
        Language::Zh => format!("{count} 个新"),
    }
}

fn certificates(language: Language, count: usize) -> String {
    match (language, count) {
        (Language::En, 1) => "1 certificate".to_owned(),
        (Language::En, _) => format!("{count} certificates"),
        (Language::Zh, _) => format!("{count} 个证书"),
    }
}

fn crls(language: Language, count: usize) -> String {
    match (language, count) {
        (Language::En, 1) => "1 CRL".to_owned(),
        (Language::En, _) => format!("{count} CRLs"),
        (Language::Zh, _) => format!("{count} 个 CRL"),
    }
}

/// What was done last.
pub fn trust_done(language: Language, done: &Done) -> String {
    let list = |kind: PaneKind| pane(kind).text(language);
    match (language, done) {
        (Language::En, Done::Added(count)) => format!("{count} added"),
        (Language::Zh, Done::Added(count)) => format!("已添加 {count} 项"),
        (Language::En, Done::Deleted { from: PaneKind::Crls, count }) => format!("{} deleted", crls(language, *count)),
        (Language::Zh, Done::Deleted { from: PaneKind::Crls, count }) => format!("已删除 {}", crls(language, *count)),
        (Language::En, Done::Deleted { from, count }) => {
            format!("{} deleted from {}", certificates(language, *count), list(*from))
        }
        (Language::Zh, Done::Deleted { from, count }) => {
            format!("已从[{}]删除 {}", list(*from), certificates(language, *count))
        }
        (Language::En, Done::Moved { from, to, count }) => {
            format!("{} moved from {} to {}", certificates(language, *count), list(*from), list(*to))
        }
        (Language::Zh, Done::Moved { from, to, count }) => {
            format!("已将 {} 从[{}]移到[{}]", certificates(language, *count), list(*from), list(*to))
        }
        (Language::En, Done::TakenBack) => "The change was taken back".to_owned(),
        (Language::Zh, Done::TakenBack) => "已撤销更改".to_owned(),
    }
}

/// Authorities that no usable CRL is held of.
pub fn without_crl(language: Language, names: &str) -> String {
    let colon = if language == Language::En { ": " } else { "：" };
    format!("{}{colon}{names}", T::CrlWithoutTitle.text(language))
}

/// Who was disconnected, and why.
pub fn cut(language: Language, client: &CutClient) -> String {
    let why = short_reason(language, client.status);
    match language {
        Language::En => format!("{} ({}): {why}", client.issued_to, client.address),
        Language::Zh => format!("{}（{}）：{why}", client.issued_to, client.address),
    }
}

/// The first part of the explanation: what it means, without what helps.
fn short_reason(language: Language, status: CertificateStatus) -> String {
    let whole = status.explain(language);
    let end = match language {
        Language::En => whole.find(';'),
        Language::Zh => whole.find('，'),
    };
    whole[..end.unwrap_or(whole.len())].trim_end_matches(['.', '。']).to_owned()
}

pub fn and_more(language: Language, count: usize) -> String {
    match language {
        Language::En => format!("and {count} more"),
        Language::Zh => format!("另有 {count} 个"),
    }
}

/// The clock of the controller is wrong, and it judges certificates by it.
pub fn clock_off(language: Language, ahead: Duration) -> String {
    let (minutes, ahead) = (ahead.num_minutes().abs(), ahead > Duration::zero());
    let amount = match (language, minutes) {
        (Language::En, 0..120) => format!("{minutes} minutes"),
        (Language::En, 120..2880) => format!("{} hours", minutes / 60),
        (Language::En, _) => format!("{} days", minutes / 1440),
        (Language::Zh, 0..120) => format!("{minutes} 分钟"),
        (Language::Zh, 120..2880) => format!("{} 小时", minutes / 60),
        (Language::Zh, _) => format!("{} 天", minutes / 1440),
    };
    match (language, ahead) {
        (Language::En, true) => {
            format!("The clock of the controller is {amount} ahead of this computer's. It judges validity by its own.")
        }
        (Language::En, false) => {
            format!("The clock of the controller is {amount} behind this computer's. It judges validity by its own.")
        }
        (Language::Zh, true) => format!("控制器的时钟比本机快 {amount}，有效期以控制器时钟为准。"),
        (Language::Zh, false) => format!("控制器的时钟比本机慢 {amount}，有效期以控制器时钟为准。"),
    }
}

/// When, from where and how often a client was refused.
pub fn refused_times(language: Language, address: &str, count: u64, first: &str, last: &str) -> String {
    match (language, count) {
        (Language::En, 1) => format!("From {address}, once, {last}"),
        (Language::En, _) => format!("From {address}, {count} times, first {first}, last {last}"),
        (Language::Zh, 1) => format!("来自 {address}，1 次，{last}"),
        (Language::Zh, _) => format!("来自 {address}，共 {count} 次，首次 {first}，最近 {last}"),
    }
}

/// What is in a file.
pub fn file_holds(language: Language, certificate_count: usize, crl_count: usize) -> String {
    let comma = if language == Language::En { ", " } else { "，" };
    let parts = [
        (certificate_count > 0).then(|| certificates(language, certificate_count)),
        (crl_count > 0).then(|| crls(language, crl_count)),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(comma)
}

pub const fn skipped_thing(reason: SkipReason) -> T {
    match reason {
        SkipReason::Repeated => T::TrustSkipRepeated,
        SkipReason::AlreadyHeld => T::TrustSkipHeld,
        SkipReason::Outdated => T::TrustSkipOutdated,
        SkipReason::NotAskedFor => T::TrustSkipNotAsked,
    }
}

/// "Firmware before 8.0.0: …".
pub fn on_firmware(language: Language, firmware: T, problem: &Problem) -> String {
    let colon = if language == Language::En { ": " } else { "：" };
    format!("{}{colon}{}", firmware.text(language), problem.code.explain(language).message)
}

pub const fn chain_state(state: ChainState) -> T {
    match state {
        ChainState::Missing => T::TrustChainMissing,
        ChainState::Revoked => T::TrustChainRevoked,
        ChainState::Expired => T::TrustChainExpired,
        ChainState::NotYetValid => T::TrustNotYetValid,
        ChainState::NotAnAuthority => T::TrustChainNotCa,
        ChainState::WithoutCrl => T::TrustChainNoCrl,
        ChainState::OnlySent => T::TrustChainSent,
    }
}

/// The worst that can be said of a CRL.
pub const fn crl_health(health: &CrlHealth) -> T {
    match (&health.issuer, health.dates) {
        (CrlIssuer::NotSignedBy { .. }, _) => T::CrlWrongKey,
        (CrlIssuer::MayNotSign { .. }, _) => T::CrlMayNotSign,
        (CrlIssuer::Missing, _) => T::CrlNoIssuer,
        (CrlIssuer::Held { .. }, CrlDates::Expired) => T::CrlExpired,
        (CrlIssuer::Held { .. }, CrlDates::NotYetValid) => T::CrlNotYet,
        (CrlIssuer::Held { .. }, CrlDates::NoEnd) => T::CrlNoEnd,
        (CrlIssuer::Held { .. }, CrlDates::Current) => T::CrlGood,
    }
}

/// Which authority a CRL is good for.
pub fn covers(language: Language, health: T, authority: &str) -> String {
    match language {
        Language::En => format!("{} (covers {authority})", health.text(language)),
        Language::Zh => format!("{}（适用于 {authority}）", health.text(language)),
    }
}
