//! Whether a certificate may be trusted: the steps of OPC 10000-4 §6.1.3, in its order, each with its status.
//!
//! | step | checked | in |
//! |---|---|---|
//! | 1 | structure: extensions that are critical and not supported, or damaged | `checks` |
//! | 2, 3 | the chain, and every signature in it, also the one a root makes for itself | `chain` |
//! | | name constraints and certificate policies of the authorities (RFC 5280 §6.1) | `names`, `policies` |
//! | 4 | the security policy: keys and hashes | `checks` |
//! | 5 | the trust list | `checks` |
//! | 6 | validity, of the issuers too | `checks` |
//! | 7, 8 | host name and application URI | `checks` |
//! | 9 | usages, and that issuers are CAs | `checks` |
//! | 10, 11 | revocation lists | `revocation` |
//!
//! Where the standard leaves a choice:
//! - **What the peer sends** may complete a chain in either direction, above or below what is trusted, because clients
//!   send their intermediates and the standard lets them; but some member of the chain must be in the trust list itself.
//!   What was merely sent is never trusted, and revocation lists are never taken from the peer.
//! - **A chain ends** in a self-signed certificate. [`TrustPolicy::allow_incomplete_chain`] also lets it end in a
//!   trusted certificate whose issuer is missing.
//! - **Several chains**: issuers are tried from the trust list first, then from the issuers, then from what was sent.
//!   The first chain without a flaw wins. If there is none, the flaw of the chain that came furthest through the steps
//!   is told, because it is the one to mend; among equals, that of the chain tried first.
//! - **Application URI**: the first URI of the certificate must be the announced one. OPC 10000-6 §6.2.2 allows one
//!   only, and the first is what lists show to the person who decides about trust.
//! - **CA:TRUE** in an application certificate is accepted where it is self-signed (OPC 10000-6 §6.2.2 allows it), because
//!   it stands in the trust list by itself. A CA's certificate that another CA issued is refused.
//! - **A certificate that is revoked** is told as such even where a list for another member is missing: a missing list
//!   can be excused, a revocation cannot.
//! - **Key identifiers** that differ are told apart from an issuer that is missing; such a chain is refused, as OpenSSL
//!   does.
//! - **Name constraints** of every authority count, those of the root too; names that cannot be compared with a constraint
//!   of their form are refused (RFC 5280 §4.2.1.10).
//! - **Certificate policies**: OPC UA asks for none, so that a chain fails only where an authority below the root asks.
//! - **A revocation list signed with another key** of the same authority counts if a certificate of that key and name is
//!   in the lists, or in the chain itself, and has a good chain of its own to the same root (RFC 5280 §6.3.3 (f)): after a
//!   change of keys the authority issues such a certificate to itself. The list of the new key may say that the new key's
//!   certificate was not revoked only if that key is in the trust list.
//! - **A revocation list about some certificates** (RFC 5280 §5.2.5) counts where it covers the certificate asked about.
//!   Lists about some reasons count only together, and delta and indirect lists do not count; what any of them revokes is
//!   revoked all the same, indirect ones left aside.

mod chain;
mod checks;
mod lists;
mod names;
mod never;
mod policies;
mod policy;
mod rejection;
mod revocation;
mod role;
#[cfg(test)]
mod tests;

pub use checks::check_application_uri;
pub use lists::TrustLists;
pub use never::never_accepted;
pub use policy::{PresentedCertificate, TrustPolicy};
pub use rejection::CertificateRejection;
pub use role::PeerRole;
