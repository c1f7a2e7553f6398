//! Sentences about the small CA, in Chinese.

use crate::model::CertificateSummary;
use crate::texts::Zone;

pub fn authority(summary: &CertificateSummary, zone: Zone) -> String {
    let CertificateSummary { issued_to, issued_by, not_after, key_bits, .. } = summary;
    let until = zone.date(*not_after);
    if issued_to == issued_by {
        format!("{issued_to}，{key_bits} 位，有效期至 {until}")
    } else {
        format!("{issued_to}，由 {issued_by} 签发，{key_bits} 位，有效期至 {until}")
    }
}

pub fn crl_state(revoked: usize, number: u64, next: Option<String>) -> String {
    let next = next.unwrap_or_else(|| "—".to_owned());
    format!("已吊销 {revoked} 个，编号 {number}，下次更新期限 {next}")
}

pub fn ca_saved(path: &std::path::Path) -> String {
    format!("已保存为 {}", path.display())
}

pub fn request(common_name: &str, bits: u16) -> String {
    format!("{common_name}，{bits} 位")
}
