use std::fmt;

use crate::model::CertificateStatus;
use crate::pki::Certificate;

/// Why a certificate is not trusted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rejection {
    pub status: CertificateStatus,
    /// Of the certificate at fault, which may be an issuer. Without control characters.
    pub subject: String,
    /// How far above the certificate that was checked it stands; 0 is that certificate itself.
    pub depth: usize,
    /// In English, without control characters.
    pub reason: String,
}

impl Rejection {
    pub(super) fn new(
        status: CertificateStatus,
        certificate: &Certificate,
        depth: usize,
        reason: impl Into<String>,
    ) -> Self {
        Self { status, subject: certificate.subject().to_owned(), depth, reason: reason.into() }
    }
}

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.status, self.reason)?;
        if self.depth > 0 {
            write!(f, " ({}, {} above)", self.subject, self.depth)
        } else {
            write!(f, " ({})", self.subject)
        }
    }
}

impl std::error::Error for Rejection {}
