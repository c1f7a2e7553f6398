use std::collections::BTreeSet;
use std::fmt;
use std::net::IpAddr;
use std::path::PathBuf;
use std::sync::Arc;

use argon2::password_hash::PasswordHash;
use rsa::RsaPrivateKey;
use rsa::pkcs8::{DecodePrivateKey, EncodePublicKey};
use x509_parser::prelude::{FromDer, X509Certificate};
use zeroize::Zeroizing;

use super::address_space::is_model_namespace;
use super::{CertificateClock, InvalidParameter, RejectionRecorder, ServerEvents, StartError};
use crate::model::with_cause;
use crate::model::{SecurityPolicy, UserTokenPolicy};
use crate::pki::{TrustLists, TrustPolicy};
use crate::virtual_controller::cell::CellHandle;

/// Everything one server is made of.
#[derive(Clone)]
pub struct OpcUaConfig {
    /// The ApplicationName, which is also the certificate's common name (manual 2.7.1.2).
    pub application_name: String,
    /// `urn:<application_name>`: the certificate's SubjectAltName carries it, and it names namespace 1.
    pub application_uri: String,
    /// The address to listen on and to put in the endpoints' URLs.
    pub bind: IpAddr,
    /// 0 takes any free port; see [`super::OpcUaServer::port`].
    pub port: u16,
    /// At least one. `None` is offered without security, every other as Sign and as SignAndEncrypt.
    pub policies: BTreeSet<SecurityPolicy>,
    /// At least one.
    pub user_tokens: BTreeSet<UserTokenPolicy>,
    /// The users who may log in with a password.
    pub users: Vec<OpcUaUser>,
    /// The server certificate in DER.
    pub certificate_der: Vec<u8>,
    /// The RSA key of the certificate, PKCS#8 DER.
    pub private_key_pkcs8: Zeroizing<Vec<u8>>,
    /// Which client certificates are let in. [`super::OpcUaServer::set_trust`] changes it while the server runs.
    pub trust: TrustLists,
    /// What is let pass although OPC 10000-4 §6.1.3 advises against it.
    pub trust_policy: TrustPolicy,
    /// Whether the error for a client says what is wrong with its certificate. By default it says only that it was
    /// refused, as OPC 10000-6 §6.7.6 wants it.
    pub detailed_status: bool,
    /// Told of every client whose certificate was refused.
    pub refusals: Option<Arc<dyn RejectionRecorder>>,
    /// The clock certificates are checked by.
    pub clock: CertificateClock,
    /// What the address space shows: the controller, its robots and what is around them. The firmware decides which
    /// nodes there are.
    pub cell: CellHandle,
    /// Told what happens while the server runs.
    pub events: ServerEvents,
    /// A folder of this server alone. Starting creates it, or removes from it what an earlier run left.
    pub pki_folder: PathBuf,
}

/// How a controller admits OPC UA clients, where that is not for its engineer to say. Safe by default.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct AdmissionOptions {
    /// Tell a refused client what is wrong with its certificate, instead of `BadSecurityChecksFailed`.
    pub detailed_status: bool,
    /// Admit certificates whose CA has given no valid revocation list.
    pub allow_unknown_revocation: bool,
}

impl AdmissionOptions {
    pub(in super::super) fn trust_policy(self) -> TrustPolicy {
        TrustPolicy { allow_unknown_revocation: self.allow_unknown_revocation, ..TrustPolicy::default() }
    }
}

/// A user who may log in with a password.
#[derive(Clone, PartialEq, Eq)]
pub struct OpcUaUser {
    /// Name of the user.
    pub name: String,
    /// As [`super::hash_password`] makes it: argon2id in the PHC string format.
    pub password_hash: String,
}

impl OpcUaConfig {
    /// The server's key, after every parameter was found usable.
    pub(super) fn check(&self) -> Result<RsaPrivateKey, StartError> {
        if self.application_name.is_empty() || self.application_uri.is_empty() {
            return Err(InvalidParameter::ApplicationName.into());
        }
        // It becomes the URI of namespace 1.
        if is_model_namespace(&self.application_uri) {
            return Err(InvalidParameter::ModelNamespace.into());
        }
        if self.policies.is_empty() {
            return Err(InvalidParameter::NoPolicy.into());
        }
        if self.user_tokens.is_empty() {
            return Err(InvalidParameter::NoUserToken.into());
        }
        for user in &self.users {
            if !PasswordHash::new(&user.password_hash).is_ok_and(|hash| hash.algorithm == argon2::ARGON2ID_IDENT) {
                return Err(InvalidParameter::PasswordHash(user.name.clone()).into());
            }
        }
        let (rest, certificate) =
            X509Certificate::from_der(&self.certificate_der).map_err(with_cause(InvalidParameter::Certificate))?;
        if !rest.is_empty() {
            return Err(InvalidParameter::DataAfterCertificate.into());
        }
        let key = RsaPrivateKey::from_pkcs8_der(&self.private_key_pkcs8).map_err(with_cause(InvalidParameter::Key))?;
        let public_key = key.to_public_key().to_public_key_der().map_err(with_cause(StartError::Failed))?;
        if certificate.public_key().raw != public_key.as_bytes() {
            return Err(InvalidParameter::OtherKey.into());
        }
        Ok(key)
    }
}

impl fmt::Debug for OpcUaConfig {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("OpcUaConfig")
            .field("application_name", &self.application_name)
            .field("application_uri", &self.application_uri)
            .field("bind", &self.bind)
            .field("port", &self.port)
            .field("policies", &self.policies)
            .field("user_tokens", &self.user_tokens)
            .field("users", &self.users)
            .field("trusted_clients", &self.trust.trusted().len())
            .field("trust_policy", &self.trust_policy)
            .field("detailed_status", &self.detailed_status)
            .field("cell", &self.cell)
            .field("pki_folder", &self.pki_folder)
            .finish_non_exhaustive()
    }
}

impl fmt::Debug for OpcUaUser {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("OpcUaUser").field("name", &self.name).finish_non_exhaustive()
    }
}
