use chrono::{DateTime, Duration, Utc};
use x509_cert::Version;
use x509_cert::crl::{CertificateList, RevokedCert, TbsCertList};
use x509_cert::der::Encode as _;
use x509_cert::der::asn1::Uint;
use x509_cert::ext::pkix::{CrlNumber, CrlReason};
use x509_cert::serial_number::SerialNumber;

use super::authority::authority_key_id;
use super::{CertificateAuthority, encode};
use crate::model::with_cause;
use crate::pki::{Crl, PkiError, RevocationReason};

/// One entry of a CRL.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RevokedCertificate {
    /// Hexadecimal.
    pub serial_number: String,
    /// When the certificate was revoked.
    pub at: DateTime<Utc>,
    /// Why it was revoked.
    pub reason: RevocationReason,
}

/// What this CA revokes for (RFC 5280 §5.3.1). Left out is what means nothing here: a hold, which would have to be
/// lifted again, what only delta CRLs say, and attribute authorities.
pub const REVOCATION_REASONS: [RevocationReason; 7] = [
    RevocationReason::Unspecified,
    RevocationReason::KeyCompromise,
    RevocationReason::CaCompromise,
    RevocationReason::AffiliationChanged,
    RevocationReason::Superseded,
    RevocationReason::CessationOfOperation,
    RevocationReason::PrivilegeWithdrawn,
];

/// The longest a CRL may be good for, in days.
pub const MAX_CRL_DAYS: u16 = 3650;

impl CertificateAuthority {
    /// Signs the list of what this CA has revoked (RFC 5280 §5).
    ///
    /// Good from one hour before `now`, for clocks that are behind, until `days` after it, but not beyond the CA
    /// itself. `number` must be larger than that of every CRL before it.
    pub fn crl(
        &self,
        revoked: &[RevokedCertificate],
        number: u64,
        now: DateTime<Utc>,
        days: u16,
    ) -> Result<Crl, PkiError> {
        self.check_valid(now)?;
        let this_update = now.checked_sub_signed(Duration::hours(1)).ok_or_else(PkiError::beyond_calendar)?;
        let next_update =
            now.checked_add_signed(Duration::days(i64::from(days))).ok_or_else(PkiError::beyond_calendar)?;
        let entries = revoked.iter().map(entry).collect::<Result<Vec<_>, _>>()?;
        let number = Uint::new(&number.to_be_bytes()).map_err(encode::signing)?;
        let tbs_cert_list = TbsCertList {
            version: Version::V2,
            signature: encode::algorithm(),
            issuer: self.name.clone(),
            this_update: encode::time(this_update)?,
            next_update: Some(encode::time(next_update.min(self.certificate().not_after()))?),
            // An empty sequence is not allowed.
            revoked_certificates: (!entries.is_empty()).then_some(entries),
            crl_extensions: Some(vec![
                encode::extension(&authority_key_id(&self.key_id))?,
                encode::extension(&CrlNumber(number))?,
            ]),
        };
        let signature = encode::sign(&self.key, &tbs_cert_list)?;
        let list = CertificateList { tbs_cert_list, signature_algorithm: encode::algorithm(), signature };
        Crl::from_der(&list.to_der().map_err(encode::signing)?)
    }
}

fn entry(revoked: &RevokedCertificate) -> Result<RevokedCert, PkiError> {
    let serial = hex::decode(&revoked.serial_number).map_err(with_cause(PkiError::Signing))?;
    let reason = match revoked.reason {
        // Is to be left out (RFC 5280 §5.3.1).
        RevocationReason::Unspecified => None,
        RevocationReason::KeyCompromise => Some(CrlReason::KeyCompromise),
        RevocationReason::CaCompromise => Some(CrlReason::CaCompromise),
        RevocationReason::AffiliationChanged => Some(CrlReason::AffiliationChanged),
        RevocationReason::Superseded => Some(CrlReason::Superseded),
        RevocationReason::CessationOfOperation => Some(CrlReason::CessationOfOperation),
        RevocationReason::CertificateHold => Some(CrlReason::CertificateHold),
        RevocationReason::RemoveFromCrl => Some(CrlReason::RemoveFromCRL),
        RevocationReason::PrivilegeWithdrawn => Some(CrlReason::PrivilegeWithdrawn),
        RevocationReason::AaCompromise => Some(CrlReason::AaCompromise),
    };
    Ok(RevokedCert {
        serial_number: SerialNumber::new(&serial).map_err(encode::signing)?,
        revocation_date: encode::time(revoked.at)?,
        crl_entry_extensions: reason.map(|reason| encode::extension(&reason)).transpose()?.map(|reason| vec![reason]),
    })
}
