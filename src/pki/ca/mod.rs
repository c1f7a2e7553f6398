//! The small CA: a root, an intermediate if wanted, application certificates and CRLs. Bytes in, bytes out.
//!
//! | file | its one idea |
//! |---|---|
//! | `authority` | [`CertificateAuthority`]: a CA certificate and its key, made or taken up again |
//! | `issue` | what it signs of a request, and what it refuses |
//! | `requested` | what a signing request asks for, taken over as it stands |
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
