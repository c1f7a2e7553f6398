use std::fmt;

use crate::model::{CertificateStatus, Language};
use crate::pki::name::quoted;
use crate::pki::{Certificate, CertificateFlaw, RefusalCause};

/// Why a certificate is not trusted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CertificateRejection {
    /// What is wrong.
    pub flaw: CertificateFlaw,
    /// Of the certificate at fault, which may be an issuer. Without control characters.
    pub subject: String,
    /// How far above the certificate that was checked it stands; 0 is that certificate itself.
    pub depth: usize,
}

impl CertificateRejection {
    pub(super) fn new(flaw: CertificateFlaw, certificate: &Certificate, depth: usize) -> Self {
        Self { flaw, subject: certificate.subject().to_owned(), depth }
    }

    /// Of the certificate itself.
    pub fn of(flaw: CertificateFlaw, certificate: &Certificate) -> Self {
        Self::new(flaw, certificate, 0)
    }

    /// Of something that is not a certificate, or cannot be read; `subject` is what it is called.
    pub fn unreadable(why: impl fmt::Display, subject: &str) -> Self {
        let flaw = CertificateFlaw::Unreadable { why: quoted(&why.to_string()) };
        Self { flaw, subject: quoted(subject), depth: 0 }
    }

    /// The OPC UA status of the flaw.
    pub fn status(&self) -> CertificateStatus {
        self.flaw.status(self.depth > 0)
    }

    /// What is wrong, without what to do and without the name of the certificate. In English.
    pub fn reason(&self) -> String {
        self.flaw.reason(Language::En)
    }

    /// The same, to be told to others.
    pub fn cause(&self) -> RefusalCause {
        RefusalCause { flaw: self.flaw.clone(), at_fault: (self.depth > 0).then(|| quoted(&self.subject)) }
    }
}

impl fmt::Display for CertificateRejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.status(), self.reason())?;
        if self.depth > 0 {
            write!(f, " ({}, {} above)", self.subject, self.depth)
        } else {
            write!(f, " ({})", self.subject)
        }
    }
}

impl std::error::Error for CertificateRejection {}
