use chrono::{DateTime, Utc};
use serde::{Deserialize, Serialize};

use super::{
    CertificateSummary, CertificateType, ControllerSeries, ErrorCode, FirmwareGeneration, FirmwareVersion, ListLimits,
    RevisionToken, SerialNumber,
};

/// State of the OPC UA server inside a controller (manual 2.4.4.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum ServerStatus {
    /// The server runs and accepts clients.
    Run,
    /// The server does not run.
    Stop,
    /// It cannot run, or failed while starting or stopping; [`ControllerInfo::error`] says why.
    Error,
}

impl ServerStatus {
    /// `Run` or `Stop`, as the manual writes it.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Run => "Run",
            Self::Stop => "Stop",
            Self::Error => "Error",
        }
    }
}

/// The certificate the OPC UA server shows its clients.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ServerCertificate {
    /// How the certificate came to be.
    #[serde(rename = "type")]
    pub kind: CertificateType,
    /// Names, dates and key of the certificate.
    #[serde(flatten)]
    pub summary: CertificateSummary,
}

/// Everything "Get new information" reads from a controller (manual 2.4.4.1).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ControllerInfo {
    /// The name the controller itself carries; the configurator's list has its own.
    pub name: String,
    /// Serial number of the controller.
    pub serial: SerialNumber,
    /// Series of the controller.
    pub series: ControllerSeries,
    /// Version of its firmware.
    pub firmware: FirmwareVersion,
    /// Whether its OPC UA server runs.
    pub status: ServerStatus,
    /// Why the status is [`ServerStatus::Error`] (manual 6.1), as it is now: the number goes when its cause is mended. With
    /// any other status a notice, and nothing is wrong: [`ErrorCode::ServerLogOn`] while the server log is on.
    pub error: Option<ErrorCode>,
    /// Whether the OPC UA function was activated. Always true for current firmware.
    pub activated: bool,
    /// The certificate type in use, with its certificate, if one is installed.
    pub certificate: Option<ServerCertificate>,
    /// ApplicationName of the OPC UA server, and the default common name of its certificate.
    pub application_name: String,
    /// `opc.tcp://host:port` as clients reach it.
    pub endpoint: String,
    /// TCP ports taken by other functions of the controller.
    pub used_ports: Vec<u16>,
    /// How many certificates and CRLs fit into its lists.
    pub limits: ListLimits,
    /// The controller's clock.
    pub clock: DateTime<Utc>,
    /// The configuration that this was read from.
    pub revision: RevisionToken,
}

impl ControllerInfo {
    /// The longest of the controller's texts that is taken, in bytes. None of the manual's comes near it.
    pub const MAX_TEXT: usize = 1024;
    /// The most used ports that are taken.
    pub const MAX_USED_PORTS: usize = 1024;

    /// The set of rules that its firmware follows.
    pub fn generation(&self) -> FirmwareGeneration {
        self.firmware.generation()
    }

    /// Whether this is small enough to be kept for every controller of a plant.
    pub fn is_small(&self) -> bool {
        let certificate = self.certificate.as_ref().map(|certificate| &certificate.summary);
        let own = [&self.name, &self.application_name, &self.endpoint];
        let certificates = certificate.into_iter().flat_map(|c| {
            [&c.issued_to, &c.issued_by, &c.serial_number, &c.thumbprint].into_iter().chain(&c.application_uri)
        });
        own.into_iter().chain(certificates).all(|text| text.len() <= Self::MAX_TEXT)
            && self.used_ports.len() <= Self::MAX_USED_PORTS
    }
}
