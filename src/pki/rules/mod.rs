//! The rules for certificates. Each is judged in exactly one function, which gives a typed [`CertificateFlaw`] and
//! nothing about how severe it is.
//!
//! | file | rule | source |
//! |---|---|---|
//! | `structure` | extensions are understood, validity ends after it begins | OPC 10000-4 §6.1.3 step 1, RFC 5280 §4.2 |
//! | `signature` | a self-signed certificate is signed with its own key | OPC 10000-4 §6.1.3 step 3 |
//! | `strength` | kind and length of the key, hash of the signature | OPC 10000-4 §6.1.3 step 4, OPC 10000-7 |
//! | `validity` | dates of certificates and of revocation lists | OPC 10000-4 §6.1.3 steps 6 and 10, RFC 5280 §5.1.2 |
//! | `names` | host names and the application URI | OPC 10000-4 §6.1.3 steps 7 and 8, RFC 5280 §4.2.1.6 |
//! | `usage` | what keys and certificates may be used for | OPC 10000-4 §6.1.3 step 9, OPC 10000-6 §6.2.2, RFC 5280 §4.2.1 |
//!
//! Rules about several certificates of a chain (issuers, name constraints, certificate policies, revocation) are part of
//! [`TrustLists::validate`](super::TrustLists::validate).
//!
//! Severity is decided by the users of the rules: [`TrustLists::validate`](super::TrustLists::validate) refuses at the
//! first flaw that its [`TrustPolicy`](super::TrustPolicy) does not excuse;
//! [`check_import`](super::check_import) and [`check_server`](super::check_server) list all flaws with a
//! [`Severity`](super::Severity) each.

mod names;
mod signature;
mod strength;
mod structure;
mod usage;
mod validity;

pub(super) use names::{application_uri_flaw, host_flaw, name_not_ascii};
pub(super) use signature::self_signature_flaw;
pub(super) use strength::{hash_flaw, key_kind_flaw, key_length_flaw, key_length_not_ticked, signature_hash_flaw};
pub(super) use structure::{rare_critical_extensions, structure_flaw};
pub(super) use usage::{
    authority_flaw, claims_to_be_authority, extended_key_usage_missing, issuer_usage_flaw, key_usage_flaw,
    may_sign_lists, path_length_flaw, role_flaw,
};
pub(super) use validity::expires_soon;
pub use validity::{crl_date_flaw, validity_flaw};
