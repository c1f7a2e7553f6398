//! About whom controllers trust.

use std::borrow::Cow;

use chrono::Duration;

use super::TextKey as T;
use crate::jobs::{SkipReason, TrustNote};
use crate::model::{CertificateStatus, ClientList, ErrorCode, Language};
use crate::pki::{CrlDates, CrlHealth, CrlIssuer};

/// Why a certificate or CRL of a file is left out.
pub const fn skipped_thing(reason: SkipReason) -> T {
    match reason {
        SkipReason::Repeated => T::TrustSkipRepeated,
        SkipReason::AlreadyHeld => T::TrustSkipHeld,
        SkipReason::Outdated => T::TrustSkipOutdated,
        SkipReason::NotAskedFor => T::TrustSkipNotAsked,
    }
}

/// Everything that is wrong with a CRL.
pub fn crl_flaws(health: &CrlHealth) -> Vec<T> {
    let issuer = match health.issuer {
        CrlIssuer::Held { .. } => None,
        CrlIssuer::NotSignedBy { .. } => Some(T::CrlWrongKey),
        CrlIssuer::MayNotSign { .. } => Some(T::CrlMayNotSign),
        CrlIssuer::Missing => Some(T::CrlNoIssuer),
    };
    let dates = match health.dates {
        CrlDates::Current => None,
        CrlDates::Expired => Some(T::CrlExpired),
        CrlDates::NotYetValid => Some(T::CrlNotYet),
        CrlDates::NoEnd => Some(T::CrlNoEnd),
    };
    issuer.into_iter().chain(dates).collect()
}

/// The name of a list of client certificates.
pub const fn client_list(list: ClientList) -> T {
    match list {
        ClientList::Trusted => T::TrustTrusted,
        ClientList::Issuers => T::TrustIssuers,
        ClientList::Rejected => T::TrustRejected,
    }
}

/// The worst that can be said of a CRL.
pub fn crl_health(health: &CrlHealth) -> T {
    crl_flaws(health).first().copied().unwrap_or(T::CrlGood)
}

in_every_language! {
    trust:
    /// "3 of 50".
    fn how_full(count: usize, limit: Option<usize>) -> String;
    /// "3 of 50, 1 ticked".
    fn full_and_ticked(full: &str, count: usize, hidden: usize) -> String;
    /// How many refused clients are new.
    fn new_clients(count: usize) -> String;
    /// How many certificates and CRLs were added.
    fn trust_added(count: usize) -> String;
    /// `list`: the name of the list they were deleted from.
    fn certificates_deleted(list: T, count: usize) -> String;
    /// How many CRLs were deleted.
    fn crls_deleted(count: usize) -> String;
    /// How many certificates were moved between two lists.
    fn certificates_moved(from: T, to: T, count: usize) -> String;
    /// Authorities that no usable CRL is held of.
    fn without_crl(names: &str) -> String;
    /// Who was disconnected, and why.
    fn cut(issued_to: &str, address: &str, status: CertificateStatus) -> String;
    /// How many further entries there are.
    fn and_more(count: usize) -> String;
    /// The clock of the controller is wrong, and it judges certificates by it.
    fn clock_off(ahead: Duration) -> String;
    /// When, from where and how often a client was refused.
    fn refused_times(address: &str, count: u64, first: &str, last: &str) -> String;
    /// What is in a file.
    fn file_holds(certificate_count: usize, crl_count: usize) -> String;
    /// "Firmware before 8.0.0: …".
    fn on_firmware(firmware: T, error: ErrorCode) -> String;
    /// Which authority a CRL is good for.
    fn covers(health: T, authority: &str) -> String;
}

impl TrustNote {
    /// What a person reads: the end of a sentence.
    pub fn text(&self, language: Language) -> Cow<'static, str> {
        in_language!(language, trust::note(self))
    }
}
