//! What a controller is and may have: plain types, rules, limits and the registry of errors.
//!
//! No I/O, no async, no egui. Text becomes one of these types once, at the edge (a dialog, the command line, a
//! message), and is trusted from there on. Section numbers in the docs are those of the controller's OPC UA manual.

#[macro_use]
mod text_in_messages;

pub mod activation;
mod address;
mod authority;
mod base64_bytes;
mod capabilities;
mod cause;
mod certificate;
mod certificate_status;
mod changed;
mod client_list;
pub mod clock;
mod connection_kind;
mod controller;
mod controller_text;
mod country;
mod credentials;
mod crl_summary;
mod error_code;
pub mod file_names;
mod info;
mod language;
mod log_chunk;
pub mod opcua;
mod problem;
mod revision;
mod settings;
mod spel_value;
mod status_flags;
mod stored_server_certificates;
pub mod text;
pub mod text_table;
mod trust_lists;
pub mod untrusted_text;
mod user;

pub use address::{Address, AddressError, DEFAULT_MANAGEMENT_PORT};
pub use authority::{AuthorityRequest, AuthorityValidity, CertificateProfile, InvalidAuthorityValidity};
pub use base64_bytes::Base64Bytes;
pub use capabilities::{Capabilities, Feature, MissingReason};
pub use cause::{Cause, with_cause, with_sources, with_told_cause};
pub use certificate::{
    CertificateSummary, CertificateType, CsrRequest, FileFormat, KeyLength, SelfSignedRequest, Subject, SubjectError,
    Validity, default_common_name, offered_key_lengths,
};
pub use certificate_status::{CertificateStatus, UnknownCertificateStatus};
pub use changed::Changed;
pub use client_list::{ClientList, ListLimits};
pub use connection_kind::ConnectionKind;
pub use controller::{
    ControllerName, ControllerSeries, FirmwareGeneration, FirmwareVersion, NameError, SerialNumber,
    UnsupportedFirmware, VersionError,
};
pub use controller_text::controller_text;
pub use country::Country;
pub use credentials::Credentials;
pub use crl_summary::CrlSummary;
pub use error_code::{ErrorCode, ErrorOrigin};
pub use info::{ControllerInfo, ServerCertificate, ServerStatus};
pub use language::Language;
pub use log_chunk::LogChunk;
pub use problem::Problem;
pub use revision::{RevisionToken, Revisioned};
pub use settings::{
    PortError, SecurityPolicy, ServerPort, ServerSettings, SettingsError, SettingsWarning, StartupMode, UserTokenPolicy,
};
pub use spel_value::{SpelType, SpelValue};
pub use status_flags::{StatusFlag, StatusFlags};
pub use stored_server_certificates::{StoredServerCertificate, StoredServerCertificates};
pub use trust_lists::{DisconnectedClient, ListedCertificate, ListedCrl, TrustStamp, TrustStep};
pub use user::{MAX_USERS, UserCredential, UserCredentialError, UserName, UserPassword};
