//! Keys, certificates, PKCS#12 and PEM. Bytes in, bytes out: no I/O, no async, no clock of its own.
//!
//! | file | contents |
//! |---|---|
//! | `certificate` | [`Certificate`]: one X.509 certificate that was parsed and found whole |
//! | `facts` | what is read from a certificate, once |
//! | `general_name` | alternative names, name constraints |
//! | `flaw` | [`CertificateFlaw`]: what can be wrong with a certificate, and what to do |
//! | `signature` | signature algorithms, verification of one signature |
//! | `crl` | [`Crl`]: one certificate revocation list, indexed |
//! | `authority` | [`is_authority`]: whether a certificate is that of an authority or of an application |
//! | `distribution_point` | which certificates a revocation list is about |
//! | `bundle` | [`read_bundle`]: any file with certificates and revocation lists |
//! | `trust` | [`TrustLists`]: whether a certificate may be trusted (OPC 10000-4 §6.1.3) |
//! | `describe` | [`describe`]: everything public inside a file, to be read |
//! | `signers` | which certificate of a file signed which certificates and CRLs of the same file |
//! | `parts` | what is in a file, by its content: where every reader starts |
//! | `file_content` | [`FileContent`]: kinds of content, and how to convert one into another |
//! | `pem` | the text armour around DER, both ways |
//! | `ber` | the looser encoding of PKCS#7 and PKCS#12, made into DER |
//! | `key` | [`PrivateKey`]: an RSA key that signs |
//! | `key_file` | [`read_key_file`], [`read_pair`]: private keys as other tools write them |
//! | `password_encryption` | what a password encrypts, in keys and in PKCS#12 |
//! | `key_encryption` | [`encrypt_key`]: a private key under a passphrase, for any tool to read |
//! | `self_signed` | [`self_signed`]: an OPC UA server certificate, signed with its own key |
//! | `csr` | [`Csr`], [`make_csr`]: the request for a certificate that a CA signs |
//! | `issuers` | [`issuers_of`]: who issued a certificate, as far as the issuers are at hand |
//! | `kind` | [`recognise`]: what a file is, by its content |
//! | `ca` | [`CertificateAuthority`]: the small CA, which signs requests |
//! | `pkcs12` | [`pkcs12_write`], [`pkcs12_read`]: a key and its certificates under a password |
//! | `rejected_client` | [`RejectedClient`]: a client certificate that a controller refused |
//! | `rules` | the rules for certificates, each in one function |
//! | `server_certificate` | [`check_import`], [`check_server`]: what OPC UA clients say about the certificate of a server |
//! | `identity` | [`tls_identity`]: what a controller's management interface shows of itself |
//! | `client_identity` | [`client_identity`]: what this computer shows of itself to OPC UA servers |
//! | `tlv` | just enough DER to see from outside what a file is |
//! | `fingerprint` | [`Fingerprint`]: the SHA-256 that a configurator pins of a controller's TLS certificate |
//! | `name` | the text of an X.509 name |
//! | `error` | [`PkiError`]: everything that can be wrong, each with its cause |
//!
//! Making an RSA key, and everything with a PKCS#12, is slow and blocks: keep it off the window's thread and off async
//! workers.
//!
//! What comes from outside is bounded before it is parsed: [`MAX_CERTIFICATE_BYTES`],
//! [`MAX_CERTIFICATE_FILE_BYTES`], [`MAX_KEY_FILE_BYTES`], [`MAX_PKCS12_BYTES`], [`MAX_CRL_BYTES`],
//! [`MAX_BUNDLE_BYTES`]. Text taken from a certificate holds no control characters.

mod authority;
mod ber;
mod bundle;
mod ca;
mod certificate;
mod certificate_fields;
mod certificate_file;
mod client_identity;
mod crl;
mod csr;
mod describe;
mod distribution_point;
mod error;
mod file_content;
mod fingerprint;
mod flaw;
mod general_name;
mod identity;
mod issuers;
mod key;
mod key_encryption;
mod key_file;
mod key_usage;
mod kind;
mod name;
mod parts;
mod password_encryption;
mod pem;
mod pkcs12;
mod rejected_client;
mod revocation_reason;
mod rules;
#[cfg(test)]
mod samples;
mod sealed;
mod self_signed;
mod server_certificate;
mod signature;
mod signers;
mod size;
mod tlv;
mod trust;
mod trust_health;

pub use authority::is_authority;
pub use bundle::{Bundle, MAX_BUNDLE_BYTES, read_bundle};
pub use ca::{CertificateAuthority, IssueRequest, MAX_CRL_DAYS, REVOCATION_REASONS, RevokedCertificate};
pub use certificate::{Certificate, MAX_CERTIFICATE_BYTES};
pub use certificate_fields::{AlternativeName, BasicConstraints, ExtendedKeyUsage};
pub use client_identity::{ClientIdentity, client_identity};
pub use crl::{Crl, MAX_CRL_BYTES, RevocationEntry};
pub use csr::{Csr, make_csr};
pub use describe::{
    CertificateDescription, CrlDescription, CrlEntry, CsrDescription, Description, KeyDescription,
    NameConstraintsDescription, describe,
};
pub use error::PkiError;
pub use file_content::{FileContent, Wanted};
pub use fingerprint::{Fingerprint, FingerprintError};
pub use flaw::{CertificateFlaw, CrlFlaw, CrlUnusable, OutOfScope, RefusalCause, UnverifiableSignature};
pub use identity::{TlsIdentity, tls_identity};
pub use issuers::{Issuers, issuers_of};
pub use key::PrivateKey;
pub use key_encryption::encrypt_key;
pub use key_file::{MAX_KEY_FILE_BYTES, read_key_file, read_pair};
pub use key_usage::KeyUsage;
pub use kind::{PkiKind, recognise};
pub use pem::MAX_CERTIFICATE_FILE_BYTES;
pub use pkcs12::{MAX_PKCS12_BYTES, PKCS12_ITERATIONS, pkcs12_read, pkcs12_read_key, pkcs12_write, pkcs12_write_key};
pub use rejected_client::RejectedClient;
pub use revocation_reason::RevocationReason;
pub use rules::{crl_date_flaw, validity_flaw};
pub use sealed::{SEAL_NONCE_BYTES, SEAL_SALT_BYTES, SealCost, SealError, Sealed, SealingKey, open, seal};
pub use self_signed::{ServerNames, self_signed};
pub use server_certificate::{
    CertificateFinding, ExpectedServer, ServerCheck, Severity, check_import, check_server, check_usable,
};
pub use trust::{
    CertificateRejection, PeerRole, PresentedCertificate, TrustLists, TrustPolicy, check_application_uri,
    never_accepted,
};
pub use trust_health::{CrlDates, CrlHealth, CrlIssuer, TrustHealth};
