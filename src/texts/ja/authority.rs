//! Sentences about the small CA, in Japanese.

use crate::model::CertificateSummary;
use crate::texts::Zone;

pub fn authority(summary: &CertificateSummary, zone: Zone) -> String {
    let CertificateSummary { issued_to, issued_by, not_after, key_bits, .. } = summary;
    let until = zone.date(*not_after);
    if issued_to == issued_by {
        format!("{issued_to}、{key_bits}ビット、有効期限：{until}")
    } else {
        format!("{issued_to}、発行者：{issued_by}、{key_bits}ビット、有効期限：{until}")
    }
}

pub fn crl_state(revoked: usize, number: u64, next: Option<String>) -> String {
    let next = next.unwrap_or_else(|| "—".to_owned());
    format!("失効{revoked}件、番号{number}、次回更新の期限：{next}")
}

pub fn ca_saved(path: &std::path::Path) -> String {
    format!("保存先：{}", path.display())
}

pub fn request(common_name: &str, bits: u16) -> String {
    format!("{common_name}、{bits}ビット")
}
