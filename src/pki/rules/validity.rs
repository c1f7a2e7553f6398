use chrono::{DateTime, Duration, Utc};

use crate::pki::{Certificate, CertificateFlaw, Crl, CrlFlaw};

/// How long before its end a certificate is worth a warning.
const SOON: Duration = Duration::days(30);

/// Whether the certificate is valid at `now`, from its first second up to and with its last one (RFC 5280 §4.1.2.5).
pub fn validity_flaw(certificate: &Certificate, now: DateTime<Utc>) -> Option<CertificateFlaw> {
    let (from, until) = (certificate.not_before(), certificate.not_after());
    if now < from {
        Some(CertificateFlaw::NotYetValid { from, now })
    } else if now.timestamp() > until.timestamp() {
        Some(CertificateFlaw::Expired { until, now })
    } else {
        None
    }
}

/// Whether a valid certificate has less than 30 days left.
pub(in crate::pki) fn expires_soon(certificate: &Certificate, now: DateTime<Utc>) -> Option<CertificateFlaw> {
    let until = certificate.not_after();
    let is_expired = now.timestamp() > until.timestamp();
    (!is_expired && until - now < SOON).then_some(CertificateFlaw::ExpiresSoon { until })
}

/// Whether the list is the current one at `now`: from thisUpdate up to and with the second of nextUpdate, which OPC UA
/// needs (RFC 5280 §5.1.2.4 and §5.1.2.5).
pub fn crl_date_flaw(crl: &Crl, now: DateTime<Utc>) -> Option<CrlFlaw> {
    if now < crl.this_update() {
        return Some(CrlFlaw::NotYetValid { from: crl.this_update(), now });
    }
    match crl.next_update() {
        None => Some(CrlFlaw::NoEnd),
        Some(until) if now.timestamp() > until.timestamp() => Some(CrlFlaw::Expired { until, now }),
        Some(_) => None,
    }
}
