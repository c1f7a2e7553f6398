//! The small CA of a workspace, on disk.
//!
//! ```text
//! <workspace>/CA/
//!   ca.json             the database: certificates, what was issued and revoked, the CRLs, their numbers
//!   ca.key              key of the CA that signs, encrypted PKCS#8 in PEM under the passphrase
//!   root.key            the same of the root, if an intermediate signs; may be kept elsewhere
//!   issued/<serial>.der what was issued
//!   ca.der, ca.crl      certificate and CRL of the CA that signs, to be handed out
//!   root.der, root.crl  the same of the root, if an intermediate signs
//!   ca.pem              both certificates, for tools that want PEM
//!   .lock               locked by the process that changes any of this
//! ```
//!
//! The keys are ordinary encrypted PKCS#8, so that OpenSSL, XCA or a bigger CA can take over whenever the plant
//! outgrows this one. `ca.json` alone is what counts, and is replaced as a whole: there is a CA once it is there, and
//! `.der`, `.crl` and `ca.pem` are made from it again whenever they differ. A certificate or a CRL is written down
//! there before it is handed out. So if the process ends in between, no certificate is in use that could not be
//! revoked, no serial number is used twice (they are random), and every CRL has a larger number than the ones before:
//! the number is the time in seconds, or one more than the last, which holds even when an old backup is restored.

mod backup;
mod database;
mod error;
mod files;
mod signing;
#[cfg(test)]
mod tests;

pub use database::{CertificateState, IssuedCertificate, IssuedFor, RecordedRevocation};
pub use error::AuthorityError;
pub use files::{AuthorityFiles, AuthorityOverview, NewAuthority, PublishedAuthority};
pub use signing::{DEFAULT_CRL_DAYS, UnlockedAuthority, UnrecordedCertificate};
