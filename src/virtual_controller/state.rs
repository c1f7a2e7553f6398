use std::collections::BTreeMap;
use std::net::{IpAddr, Ipv4Addr};

use chrono::{DateTime, Utc};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::secret_bytes::SecretBytes;
use crate::model::activation::ActivationKeys;
use crate::model::{
    Base64Bytes, CertificateType, ClientList, ControllerName, ControllerSeries, CrlSummary, ErrorCode,
    FirmwareGeneration, FirmwareVersion, ListLimits, ListedCertificate, ListedCrl, MAX_USERS, SerialNumber,
    ServerCertificate, ServerSettings, SettingsError, UnsupportedFirmware, UserName, default_common_name,
    offered_key_lengths,
};
use crate::pki::{Certificate, PkiError, ServerNames};

/// Who a controller is. Never changes during its life.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ControllerIdentity {
    /// Serial number of the controller.
    pub serial: SerialNumber,
    /// Its series.
    pub series: ControllerSeries,
    /// Its firmware.
    pub firmware: FirmwareVersion,
    /// The name the controller itself carries.
    pub name: ControllerName,
}

/// A certificate with its private key.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct KeyPair {
    /// DER.
    pub certificate: Base64Bytes,
    /// PKCS#8, DER.
    pub private_key: SecretBytes,
}

impl KeyPair {
    /// The certificate. It was checked when it was stored, so an error means that the state was damaged.
    pub fn parse(&self) -> Result<Certificate, PkiError> {
        Certificate::from_der(&self.certificate.0)
    }
}

/// A certificate signing request with the key a CA-signed certificate will be for.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct PendingCsr {
    /// DER.
    pub csr: Base64Bytes,
    /// PKCS#8, DER.
    pub private_key: SecretBytes,
}

/// A user of the OPC UA server.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct User {
    /// Name of the user.
    pub name: UserName,
    /// Argon2id, as a PHC string.
    pub password_hash: String,
}

/// A certificate in the trusted or issuers list.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct TrustListCertificate {
    /// Name of the file that the certificate was added from.
    pub file_name: String,
    /// DER.
    pub certificate: Base64Bytes,
    /// When it was added, by the controller's clock.
    pub added: DateTime<Utc>,
}

/// A CRL.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct TrustListCrl {
    /// Name of the file that the CRL was added from.
    pub file_name: String,
    /// DER.
    pub crl: Base64Bytes,
    /// What was read from the DER when it was added: it may be large.
    pub summary: CrlSummary,
    /// When it was added, by the controller's clock.
    pub added: DateTime<Utc>,
}

/// Everything a controller remembers when it is switched off.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ControllerState {
    /// Who the controller is.
    pub identity: ControllerIdentity,
    /// The TLS identity of the management protocol; its certificate's SHA-256 is the controller's fingerprint.
    pub management: KeyPair,
    /// Argon2id of the connection password, as a PHC string.
    pub connection_password_hash: String,
    /// The basic settings.
    pub settings: ServerSettings,
    /// The users of the OPC UA server.
    pub users: Vec<User>,
    /// Always true on current firmware, where activation is a controller option.
    pub activated: bool,
    /// The keys it was activated with, where that was done by keys.
    #[serde(default)]
    pub activation_keys: Option<ActivationKeys>,
    /// The server certificates held, at most one of each type.
    pub certificates: BTreeMap<CertificateType, KeyPair>,
    /// The CSR made last. It stays after its certificate was imported, so that the CA can renew that.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub csr: Option<PendingCsr>,
    /// The type the server uses, whether one is held or not.
    pub selected: CertificateType,
    /// The trusted list: clients, and CAs whose clients are accepted.
    pub trusted: Vec<TrustListCertificate>,
    /// The issuers list: CAs that complete chains. Empty on legacy firmware.
    pub issuers: Vec<TrustListCertificate>,
    /// The CRLs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub crls: Vec<TrustListCrl>,
    /// TCP ports taken by other functions of the controller.
    pub used_ports: Vec<u16>,
    /// Counts every change of the configuration.
    pub revision: u64,
}

/// The port that the OPC UA server is to have belongs to another function of the controller.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("port {0} belongs to another function of the controller")]
pub struct PortTaken(pub u16);

/// Why the OPC UA server cannot start in a state (manual 6.1).
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum StartRefusal {
    #[error("the controller is not activated")]
    NotActivated,
    #[error("no certificate of the selected type is held")]
    NoCertificate,
    #[error(transparent)]
    Settings(#[from] SettingsError),
    #[error(transparent)]
    Certificate(#[from] PkiError),
    #[error("the security policies do not allow the certificate's {0}-bit key")]
    KeyLength(u16),
    #[error(transparent)]
    Port(#[from] PortTaken),
}

impl StartRefusal {
    /// The error number that the controller shows.
    pub const fn code(&self) -> ErrorCode {
        match self {
            Self::NotActivated => ErrorCode::NotActivated,
            Self::NoCertificate => ErrorCode::NoCertificate,
            Self::Settings(_) | Self::Certificate(_) | Self::KeyLength(_) => ErrorCode::InvalidParameter,
            Self::Port(_) => ErrorCode::PortConflict,
        }
    }
}

/// What a state breaks that holds in every state.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum StateError {
    #[error(transparent)]
    Firmware(#[from] UnsupportedFirmware),
    #[error("{0}")]
    Broken(&'static str),
}

/// What of it is sent along with a list: the answer stays below the protocol's limit, however long the names.
const MAX_LISTED_CRL_BYTES: usize = 1024 * 1024;

/// What all CRLs of a controller may have together, in bytes of DER.
pub const MAX_CRLS_BYTES: usize = 4 * 1024 * 1024;

/// What a controller knows about itself only while it is switched on.
#[derive(Debug, Clone, Copy)]
pub struct OperatingContext {
    /// The controller's clock.
    pub now: DateTime<Utc>,
    /// The address its servers listen on.
    pub bind: IpAddr,
    /// The port of its management protocol, which the OPC UA server must not take.
    pub management_port: u16,
}

impl OperatingContext {
    /// The address the controller names itself by: the one it listens on, or the loopback when that is every one.
    pub fn address(&self) -> IpAddr {
        if self.bind.is_unspecified() { IpAddr::V4(Ipv4Addr::LOCALHOST) } else { self.bind }
    }
}

impl ControllerState {
    /// The set of rules that its firmware follows.
    pub fn generation(&self) -> FirmwareGeneration {
        self.identity.firmware.generation()
    }

    /// How many certificates and CRLs its lists hold.
    pub fn limits(&self) -> ListLimits {
        ListLimits::of(self.generation())
    }

    /// The certificates in a list; the rejected list is kept elsewhere and is empty here.
    pub fn list(&self, list: ClientList) -> &[TrustListCertificate] {
        match list {
            ClientList::Trusted => &self.trusted,
            ClientList::Issuers => &self.issuers,
            ClientList::Rejected => &[],
        }
    }

    /// ApplicationName of the OPC UA server (manual 2.7.1.2).
    pub fn application_name(&self, context: &OperatingContext) -> String {
        let ip = match context.address() {
            IpAddr::V4(ip) => ip,
            IpAddr::V6(ip) => ip.to_ipv4().unwrap_or(Ipv4Addr::LOCALHOST),
        };
        default_common_name(&self.identity.serial, ip)
    }

    /// The names a server certificate made in this controller carries.
    pub fn server_names(&self, context: &OperatingContext) -> ServerNames {
        ServerNames {
            application_uri: format!("urn:{}", self.application_name(context)),
            ips: vec![context.address()],
            dns: Vec::new(),
        }
    }

    /// The server certificate in use, if one of the selected type is held.
    pub fn selected_certificate(&self) -> Option<&KeyPair> {
        self.certificates.get(&self.selected)
    }

    /// What the OPC UA server shows its clients; `None` if the selected type is not held.
    pub fn server_certificate(&self) -> Option<ServerCertificate> {
        let certificate = self.selected_certificate()?.parse().ok()?;
        Some(ServerCertificate { kind: self.selected, summary: certificate.summary() })
    }

    /// Ports taken by other functions, the management protocol among them; sorted.
    pub fn taken_ports(&self, context: &OperatingContext) -> Vec<u16> {
        let mut ports = self.used_ports.clone();
        ports.push(context.management_port);
        ports.sort_unstable();
        ports.dedup();
        ports
    }

    /// Whether `port` belongs to no other function of the controller.
    pub fn check_port(&self, port: u16, context: &OperatingContext) -> Result<(), PortTaken> {
        if self.taken_ports(context).contains(&port) { Err(PortTaken(port)) } else { Ok(()) }
    }

    /// What the manual asks of a key: a length every ticked policy allows (2.7.1.2).
    pub fn key_length_fits(&self, bits: u16) -> bool {
        offered_key_lengths(&self.settings.security_policies).iter().any(|length| length.bits() == bits)
    }

    /// Why the OPC UA server cannot start: 7930, 7931, 7932 or 7933, in this order (manual 6.1).
    pub fn check_start(&self, context: &OperatingContext) -> Result<&KeyPair, StartRefusal> {
        if !self.activated {
            return Err(StartRefusal::NotActivated);
        }
        let pair = self.selected_certificate().ok_or(StartRefusal::NoCertificate)?;
        self.settings.check()?;
        let bits = pair.parse()?.key_bits();
        if !self.key_length_fits(bits) {
            return Err(StartRefusal::KeyLength(bits));
        }
        self.check_port(self.settings.port.get(), context)?;
        Ok(pair)
    }

    /// As [`crate::model::ListedCrl`], each with its DER as long as the answer stays small.
    pub fn listed_crls(&self) -> Vec<ListedCrl> {
        let mut room = MAX_LISTED_CRL_BYTES;
        let listed = |held: &TrustListCrl| {
            let fits = held.crl.0.len() <= room;
            room -= if fits { held.crl.0.len() } else { 0 };
            ListedCrl {
                file_name: held.file_name.clone(),
                crl: fits.then(|| held.crl.clone()),
                summary: held.summary.clone(),
                added: held.added,
            }
        };
        self.crls.iter().map(listed).collect()
    }

    /// What holds in every state a controller may be in. A change that breaks it is a mistake of this program, and is
    /// refused; so is a file that does.
    pub fn check(&self) -> Result<(), StateError> {
        let limits = self.limits();
        let broken = |what| Err(StateError::Broken(what));
        self.identity.series.check_firmware(self.identity.firmware)?;
        if self.settings.check().is_err() {
            return broken("incomplete settings");
        }
        if self.users.len() > MAX_USERS {
            return broken("too many users");
        }
        let crl_bytes: usize = self.crls.iter().map(|held| held.crl.0.len()).sum();
        if self.trusted.len() > limits.trusted
            || self.issuers.len() > limits.issuers
            || self.crls.len() > limits.crls
            || crl_bytes > MAX_CRLS_BYTES
        {
            return broken("a list over its limit");
        }
        if self.generation() == FirmwareGeneration::Current
            && (!self.activated || self.certificates.contains_key(&CertificateType::UserSpecified))
        {
            return broken("something current firmware does not have");
        }
        Ok(())
    }
}

impl TrustListCertificate {
    /// `None` for what is no certificate, which the lists never hold.
    pub fn to_message(&self) -> Option<ListedCertificate> {
        let summary = Certificate::from_der(&self.certificate.0).ok()?.summary();
        Some(ListedCertificate {
            file_name: self.file_name.clone(),
            certificate: self.certificate.clone(),
            summary,
            added: self.added,
        })
    }
}
