//! One session with one controller: what every driver offers, in the types of the model, and the drivers.
//!
//! | file | contents |
//! |---|---|
//! | `mod` | [`Connector`] and [`ControllerSession`]: the two traits that a driver implements |
//! | `changes` | the changes that a session sends, and their results |
//! | `drivers` | [`Connectors`]: the driver of each [`ConnectionKind`](crate::model::ConnectionKind); [`capabilities`] of a controller that is not connected |
//! | `management` | the driver for the management protocol |
//! | [`opcua_client`] | connects to a controller's OPC UA server as its clients do; it configures nothing |
//!
//! Jobs, window and command line know the traits and [`Connectors`] only. A new driver is a module beside `management`,
//! one kind of connection in the model, and one entry in `drivers`.

mod changes;
mod drivers;
mod management;
pub mod opcua_client;

use async_trait::async_trait;
use secrecy::SecretString;

pub use changes::{CsrImport, InstalledCertificate, SealedKey, SettingsUpdate, StoredCsr, TrustEdited};
pub use drivers::{Connectors, capabilities};
pub use management::{ManagementConnector, ManagementTimeouts};

// Limits and the file format that every driver shares today.
pub use crate::protocol::{MAX_REQUEST_BYTES, MAX_SENT_CRL_BYTES, SettingsExport};

use crate::model::activation::ActivationKeys;
use crate::model::{
    Address, Base64Bytes, Capabilities, CertificateType, Changed, ClientList, ControllerInfo, Credentials, CsrRequest,
    ListedCertificate, ListedCrl, LogChunk, MissingReason, Problem, RevisionToken, Revisioned, SelfSignedRequest,
    ServerSettings, StoredServerCertificates, TrustStamp, TrustStep, UserCredential, UserName,
};
use crate::pki::{Fingerprint, RejectedClient};

/// Opens sessions of one kind of connection.
#[async_trait]
pub trait Connector: Send + Sync {
    /// The fingerprint of the controller that answers at an address. Sends no secret.
    ///
    /// Errors: [`NotAController`](crate::model::ErrorCode::NotAController),
    /// [`ProtocolVersion`](crate::model::ErrorCode::ProtocolVersion), and those of a connection that fails.
    async fn probe(&self, address: &Address) -> Result<Fingerprint, Problem>;

    /// Connects, checks the fingerprint, then logs in. Nothing is sent to a controller with another fingerprint
    /// ([`FingerprintChanged`](crate::model::ErrorCode::FingerprintChanged)).
    async fn connect(
        &self,
        address: &Address,
        fingerprint: Fingerprint,
        credentials: &Credentials,
    ) -> Result<Box<dyn ControllerSession>, Problem>;
}

/// A logged-in session with one controller. Every call is one request, bounded in time. After an error the session can
/// be used further, unless the error says that the connection or the session is over.
///
/// Calls that a driver does not implement fail with [`MissingReason::NotOverThisConnection`];
/// [`ControllerSession::capabilities`] names them beforehand. A change names the configuration that it is based on, and
/// is applied whole or not at all.
#[async_trait]
pub trait ControllerSession: Send + Sync {
    /// The state of the controller (manual 2.4.4.1).
    async fn info(&mut self) -> Result<ControllerInfo, Problem>;

    /// What this controller offers over this connection, and for each missing feature the reason. Constant during a
    /// session; reads [`ControllerSession::info`] if this has not been done.
    async fn capabilities(&mut self) -> Result<Capabilities, Problem>;

    /// Starts the OPC UA server (manual 2.4.3). Does nothing if it runs.
    async fn start_server(&mut self) -> Result<Changed, Problem> {
        not_offered()
    }

    /// Stops the OPC UA server, which ends all its connections.
    async fn stop_server(&mut self) -> Result<Changed, Problem> {
        not_offered()
    }

    /// Reads the basic settings (manual 2.6.1).
    async fn settings(&mut self) -> Result<Revisioned<ServerSettings>, Problem> {
        not_offered()
    }

    /// Replaces the basic settings (manual 2.6.1).
    async fn set_settings(&mut self, _based_on: RevisionToken, _update: SettingsUpdate) -> Result<Changed, Problem> {
        not_offered()
    }

    /// The names of the users. Passwords cannot be read.
    async fn users(&mut self) -> Result<Revisioned<Vec<UserName>>, Problem> {
        not_offered()
    }

    /// Adds a user (manual 2.6.2.2).
    async fn add_user(&mut self, _based_on: RevisionToken, _user: UserCredential) -> Result<Changed, Problem> {
        not_offered()
    }

    /// Removes users (manual 2.6.2.3).
    async fn remove_users(&mut self, _based_on: RevisionToken, _names: Vec<UserName>) -> Result<Changed, Problem> {
        not_offered()
    }

    /// The controller makes key and certificate, installs and selects them. Needs
    /// [`Feature::KeysMadeInController`](crate::model::Feature::KeysMadeInController).
    async fn make_self_signed(
        &mut self,
        _based_on: RevisionToken,
        _request: SelfSignedRequest,
    ) -> Result<InstalledCertificate, Problem> {
        not_offered()
    }

    /// Installs and selects a key and its certificate. Not for [`CertificateType::CaSigned`]. Needs
    /// [`Feature::KeyImport`](crate::model::Feature::KeyImport).
    async fn import_certificate(
        &mut self,
        _based_on: RevisionToken,
        _kind: CertificateType,
        _key: SealedKey,
    ) -> Result<InstalledCertificate, Problem> {
        not_offered()
    }

    /// Reads the server certificates that the controller has stored, and its signing request.
    async fn certificates(&mut self) -> Result<Revisioned<StoredServerCertificates>, Problem> {
        not_offered()
    }

    /// Selects the certificate that the OPC UA server uses.
    async fn select_certificate(
        &mut self,
        _based_on: RevisionToken,
        _kind: CertificateType,
    ) -> Result<Changed, Problem> {
        not_offered()
    }

    /// The controller makes a key and its signing request. Needs
    /// [`Feature::KeysMadeInController`](crate::model::Feature::KeysMadeInController).
    async fn make_csr(&mut self, _based_on: RevisionToken, _request: CsrRequest) -> Result<StoredCsr, Problem> {
        not_offered()
    }

    /// Stores a signing request with its key. Needs [`Feature::KeyImport`](crate::model::Feature::KeyImport).
    async fn import_csr(&mut self, _based_on: RevisionToken, _import: CsrImport) -> Result<StoredCsr, Problem> {
        not_offered()
    }

    /// Installs and selects the certificate, in DER, that a CA issued for the signing request in the controller.
    async fn import_ca_signed(
        &mut self,
        _based_on: RevisionToken,
        _certificate: Vec<u8>,
    ) -> Result<InstalledCertificate, Problem> {
        not_offered()
    }

    /// The trusted or the issuers list.
    async fn clients(&mut self, _list: ClientList) -> Result<Revisioned<Vec<ListedCertificate>>, Problem> {
        not_offered()
    }

    /// The rejected list, the latest refusal first.
    async fn rejected_clients(&mut self) -> Result<Revisioned<Vec<RejectedClient>>, Problem> {
        not_offered()
    }

    /// Reads the CRLs.
    async fn crls(&mut self) -> Result<Revisioned<Vec<ListedCrl>>, Problem> {
        not_offered()
    }

    /// The DER of the CRL with this [`CrlSummary::id`](crate::model::CrlSummary::id).
    async fn crl(&mut self, _id: &str) -> Result<Base64Bytes, Problem> {
        not_offered()
    }

    /// Cheap: tells whether the lists and CRLs have changed.
    async fn trust_stamp(&mut self) -> Result<TrustStamp, Problem> {
        not_offered()
    }

    /// Changes lists and CRLs: all steps, one after the other, or none.
    async fn edit_trust(&mut self, _based_on: RevisionToken, _steps: Vec<TrustStep>) -> Result<TrustEdited, Problem> {
        not_offered()
    }

    /// Needs [`Feature::ActivationKeys`](crate::model::Feature::ActivationKeys).
    async fn activate(&mut self, _based_on: RevisionToken, _keys: ActivationKeys) -> Result<Changed, Problem> {
        not_offered()
    }

    /// A piece of the server log from this offset in bytes; without one, the last piece.
    async fn log(&mut self, _from: Option<u64>) -> Result<LogChunk, Problem> {
        not_offered()
    }

    /// Settings, users and activation keys, sealed by the controller. Needs
    /// [`Feature::SettingsTransfer`](crate::model::Feature::SettingsTransfer).
    async fn export_settings(&mut self, _passphrase: SecretString) -> Result<SettingsExport, Problem> {
        not_offered()
    }

    /// Restores an export. Needs [`Feature::SettingsTransfer`](crate::model::Feature::SettingsTransfer).
    async fn import_settings(
        &mut self,
        _based_on: RevisionToken,
        _export: SettingsExport,
        _passphrase: SecretString,
    ) -> Result<Changed, Problem> {
        not_offered()
    }

    /// The configuration that the latest change without an answer was based on: that change may have been applied.
    /// `None` while every change was answered.
    fn unanswered(&self) -> Option<RevisionToken> {
        None
    }

    /// Ends the session in the controller. A session that cannot be ended expires there.
    async fn close(&mut self);
}

fn not_offered<T>() -> Result<T, Problem> {
    Err(MissingReason::NotOverThisConnection.into())
}
