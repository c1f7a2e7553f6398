//! Sentences about the small CA, in English.

use crate::model::CertificateSummary;
use crate::texts::Zone;

pub fn authority(summary: &CertificateSummary, zone: Zone) -> String {
    let CertificateSummary { issued_to, issued_by, not_after, key_bits, .. } = summary;
    let until = zone.date(*not_after);
    if issued_to == issued_by {
        format!("{issued_to}, {key_bits} bits, valid until {until}")
    } else {
        format!("{issued_to}, signed by {issued_by}, {key_bits} bits, valid until {until}")
    }
}

pub fn crl_state(revoked: usize, number: u64, next: Option<String>) -> String {
    let next = next.unwrap_or_else(|| "—".to_owned());
    format!("{revoked} revoked, number {number}, next one due by {next}")
}

pub fn ca_saved(path: &std::path::Path) -> String {
    format!("Saved as {}", path.display())
}

pub fn request(common_name: &str, bits: u16) -> String {
    format!("{common_name}, {bits} bits")
}
