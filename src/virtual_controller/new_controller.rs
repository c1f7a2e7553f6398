use chrono::{DateTime, Utc};
use thiserror::Error;

use super::activation_keys::demo_keys;
use super::change_error::CertificateChangeError;
use super::changes::install_self_signed;
use super::secret_bytes::SecretBytes;
use super::state::{ControllerIdentity, ControllerState, KeyPair, OperatingContext, StateError};
use crate::model::{
    Base64Bytes, CertificateType, FirmwareGeneration, KeyLength, SelfSignedRequest, ServerSettings, Subject, Validity,
};
use crate::pki::{PkiError, tls_identity};

/// What a controller is when it is first switched on.
#[derive(Debug, Clone)]
pub struct NewController {
    /// Serial number, series, firmware and name.
    pub identity: ControllerIdentity,
    /// As [`super::hash_connection_password`] makes it.
    pub connection_password_hash: String,
    /// The basic settings.
    pub settings: ServerSettings,
    /// Looked at on legacy firmware only; current firmware is always activated.
    pub activated: bool,
    /// TCP ports taken by other functions of the controller.
    pub used_ports: Vec<u16>,
    /// A self-signed server certificate to begin with.
    pub certificate: Option<NewCertificate>,
}

/// A self-signed certificate with the default subject.
#[derive(Debug, Clone, Copy)]
pub struct NewCertificate {
    /// Length of the key.
    pub key_length: KeyLength,
    /// When it begins to be valid; may lie in the past.
    pub made: DateTime<Utc>,
    /// How long the certificate is valid.
    pub validity: Validity,
}

/// Why a controller cannot be made.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum NewControllerError {
    /// The identity of its management protocol.
    #[error(transparent)]
    ManagementIdentity(#[from] PkiError),
    #[error(transparent)]
    Certificate(#[from] CertificateChangeError),
    #[error(transparent)]
    ControllerState(#[from] StateError),
}

/// Ports that other functions of a controller usually take: FTP data, remote control, user programs, FINS.
pub const USUAL_PORTS: [u16; 4] = [2001, 5000, 5001, 9600];

impl NewController {
    /// An activated controller as it comes from the factory: default settings, no users, no certificate.
    pub fn new(identity: ControllerIdentity, connection_password_hash: String) -> Self {
        Self {
            identity,
            connection_password_hash,
            settings: ServerSettings::default(),
            activated: true,
            used_ports: USUAL_PORTS.to_vec(),
            certificate: None,
        }
    }

    /// Makes its keys. Slow when a server certificate is wanted.
    pub(super) fn make(self, context: &OperatingContext) -> Result<ControllerState, NewControllerError> {
        let tls = tls_identity(self.identity.serial.as_str(), context.now)?;
        let management =
            KeyPair { certificate: Base64Bytes(tls.certificate_der), private_key: SecretBytes(tls.private_key_pkcs8) };
        let current = self.identity.firmware.generation() == FirmwareGeneration::Current;
        let activated = self.activated || current;
        let activation_keys = (activated && !current).then(|| demo_keys(&self.identity.serial));
        let mut state = ControllerState {
            identity: self.identity,
            management,
            connection_password_hash: self.connection_password_hash,
            settings: self.settings,
            users: Vec::new(),
            activated,
            activation_keys,
            certificates: Default::default(),
            csr: None,
            selected: CertificateType::SelfSigned,
            trusted: Vec::new(),
            issuers: Vec::new(),
            crls: Vec::new(),
            used_ports: self.used_ports,
            revision: 1,
        };
        if let Some(wanted) = self.certificate {
            let request = SelfSignedRequest {
                subject: Subject {
                    common_name: state.application_name(context),
                    country: "JP".to_owned(),
                    state: "Nagano".to_owned(),
                    locality: "Suwa".to_owned(),
                    organisation: "Virtual controllers".to_owned(),
                },
                key_length: wanted.key_length,
                validity: wanted.validity,
            };
            install_self_signed(&mut state, context, &request, wanted.made)?;
        }
        state.check()?;
        Ok(state)
    }
}
