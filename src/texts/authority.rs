//! Sentences about the small CA.

use super::{TextKey as T, Zone};
use crate::model::CertificateSummary;
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

in_every_language! {
    authority:
    /// Who signs, and for how long yet.
    fn authority(summary: &CertificateSummary, zone: Zone) -> String;
    /// What a CRL says, and when the next one is due.
    fn crl_state(revoked: usize, number: u64, next: Option<String>) -> String;
    /// A file of the CA was written.
    fn ca_saved(path: &std::path::Path) -> String;
    /// What a signing request from a file asks for.
    fn request(common_name: &str, bits: u16) -> String;
}
