//! Sentences about the small CA.

use super::{TextKey as T, Zone};
use crate::model::{CertificateSummary, Language};
use crate::pki::RevocationReason;

/// Why a certificate is revoked.
pub const fn reason(reason: RevocationReason) -> T {
    match reason {
        RevocationReason::KeyCompromise => T::ReasonKeyCompromise,
        RevocationReason::CaCompromise | RevocationReason::AaCompromise => T::ReasonCaCompromise,
        RevocationReason::AffiliationChanged => T::ReasonAffiliationChanged,
        RevocationReason::Superseded => T::ReasonSuperseded,
        RevocationReason::CessationOfOperation => T::ReasonCessation,
        RevocationReason::PrivilegeWithdrawn => T::ReasonPrivilegeWithdrawn,
        RevocationReason::Unspecified | RevocationReason::CertificateHold | RevocationReason::RemoveFromCrl => {
            T::ReasonUnspecified
        }
    }
}

/// Who signs, and for how long yet.
pub fn authority(language: Language, summary: &CertificateSummary, zone: Zone) -> String {
    let CertificateSummary { issued_to, issued_by, not_after, key_bits, .. } = summary;
    let until = zone.date(*not_after);
    match (language, issued_to == issued_by) {
        (Language::En, true) => format!("{issued_to}, {key_bits} bits, valid until {until}"),
        (Language::En, false) => format!("{issued_to}, signed by {issued_by}, {key_bits} bits, valid until {until}"),
        (Language::Zh, true) => format!("{issued_to}，{key_bits} 位，有效期至 {until}"),
        (Language::Zh, false) => format!("{issued_to}，由 {issued_by} 签发，{key_bits} 位，有效期至 {until}"),
    }
}

/// What a CRL says, and when the next one is due.
pub fn crl_state(language: Language, revoked: usize, number: u64, next: Option<String>) -> String {
    let next = next.unwrap_or_else(|| "—".to_owned());
    match language {
        Language::En => format!("{revoked} revoked, number {number}, next one due by {next}"),
        Language::Zh => format!("已吊销 {revoked} 个，编号 {number}，下次更新期限 {next}"),
    }
}

pub fn ca_saved(language: Language, path: &std::path::Path) -> String {
    match language {
        Language::En => format!("Saved as {}", path.display()),
        Language::Zh => format!("已保存为 {}", path.display()),
    }
}

/// What a signing request from a file asks for.
pub fn request(language: Language, common_name: &str, bits: u16) -> String {
    match language {
        Language::En => format!("{common_name}, {bits} bits"),
        Language::Zh => format!("{common_name}，{bits} 位"),
    }
}
