//! The small CA: a root, an intermediate if wanted, application certificates and CRLs. Bytes in, bytes out.
//!
//! | file | contents |
//! |---|---|
//! | `authority` | [`CertificateAuthority`]: a CA certificate and its key, made or taken up again |
//! | `issue` | which parts of a signing request the CA signs, which requests it refuses |
//! | `requested` | subject, key and names of a signing request |
//! | `crl` | its list of revoked certificates |
//! | `encode` | names, times, key identifiers and signatures in DER |

mod authority;
mod crl;
mod encode;
mod issue;
mod requested;
#[cfg(test)]
mod tests;

pub use authority::CertificateAuthority;
pub use crl::{MAX_CRL_DAYS, REVOCATION_REASONS, RevokedCertificate};
pub use issue::IssueRequest;
