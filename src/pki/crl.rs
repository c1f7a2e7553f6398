use chrono::DateTime;
use sha1::{Digest as _, Sha1};
use x509_parser::prelude::{CertificateRevocationList, FromDer};

use super::PkiError;
use crate::model::CrlSummary;

/// One certificate revocation list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Crl {
    der: Vec<u8>,
    summary: CrlSummary,
}

impl Crl {
    pub fn from_der(der: &[u8]) -> Result<Self, PkiError> {
        let (_, crl) = CertificateRevocationList::from_der(der).map_err(|_| PkiError::NotACertificate)?;
        let date = |seconds| DateTime::from_timestamp(seconds, 0).ok_or(PkiError::NotACertificate);
        let summary = CrlSummary {
            issuer: super::name::title(crl.issuer()),
            this_update: date(crl.last_update().timestamp())?,
            next_update: crl.next_update().map(|time| date(time.timestamp())).transpose()?,
            entries: crl.iter_revoked_certificates().count(),
            number: crl.crl_number().map(ToString::to_string),
            id: hex::encode_upper(Sha1::digest(der)),
        };
        Ok(Self { der: der.to_vec(), summary })
    }

    pub fn der(&self) -> &[u8] {
        &self.der
    }

    pub fn summary(&self) -> CrlSummary {
        self.summary.clone()
    }
}
