//! One session with one controller: what every driver must offer, and the driver for the management protocol.
//!
//! A [`Connector`] opens [`ControllerSession`]s. Jobs know only these two traits, so another way of reaching a
//! controller is one more driver and no change anywhere else.
//!
//! [`opcua_client`] is no session to configure with: it looks at a controller's OPC UA server as its clients do.

mod management;
pub mod opcua_client;
mod pinned_tls;

use async_trait::async_trait;
use secrecy::SecretString;

pub use management::{ManagementConnector, Timeouts};

use crate::model::{Address, ClientList, ControllerInfo, ErrorCode, Problem, ServerSettings, UserName};
use crate::pki::Fingerprint;
use crate::protocol::{
    Activate, AddUser, Base64Bytes, Changed, CsrMade, EditTrust, ExportSettings, HeldCertificates, ImportCaSigned,
    ImportCertificate, ImportCsr, ImportSettings, Installed, ListedCertificate, ListedCrl, LogChunk, MakeCsr,
    MakeSelfSigned, RejectedClient, RemoveUsers, Revisioned, SelectCertificate, SetSettings, SettingsExport,
    TrustChanged, TrustStamp,
};

/// Opens sessions.
#[async_trait]
pub trait Connector: Send + Sync {
    /// The fingerprint of whatever controller answers at an address. Sends nothing that is secret.
    async fn probe(&self, address: &Address) -> Result<Fingerprint, Problem>;

    /// Connects, checks the fingerprint, then logs in with the connection password (which may be empty).
    async fn connect(
        &self,
        address: &Address,
        fingerprint: Fingerprint,
        password: &SecretString,
    ) -> Result<Box<dyn ControllerSession>, Problem>;
}

/// A logged-in session. Every call is one request, bounded in time; an error leaves the session usable unless it says
/// that the connection or the session is over. What a driver cannot do it refuses.
#[async_trait]
pub trait ControllerSession: Send + Sync {
    async fn info(&mut self) -> Result<ControllerInfo, Problem>;
    async fn start_server(&mut self) -> Result<Changed, Problem> {
        not_offered()
    }
    async fn stop_server(&mut self) -> Result<Changed, Problem> {
        not_offered()
    }
    async fn settings(&mut self) -> Result<Revisioned<ServerSettings>, Problem> {
        not_offered()
    }
    async fn set_settings(&mut self, _change: SetSettings) -> Result<Changed, Problem> {
        not_offered()
    }
    async fn users(&mut self) -> Result<Revisioned<Vec<UserName>>, Problem> {
        not_offered()
    }
    async fn add_user(&mut self, _change: AddUser) -> Result<Changed, Problem> {
        not_offered()
    }
    async fn remove_users(&mut self, _change: RemoveUsers) -> Result<Changed, Problem> {
        not_offered()
    }
    /// Current firmware only.
    async fn make_self_signed(&mut self, _change: MakeSelfSigned) -> Result<Installed, Problem> {
        not_offered()
    }
    /// Legacy firmware only.
    async fn import_certificate(&mut self, _change: ImportCertificate) -> Result<Installed, Problem> {
        not_offered()
    }
    async fn certificates(&mut self) -> Result<Revisioned<HeldCertificates>, Problem> {
        not_offered()
    }
    async fn select_certificate(&mut self, _change: SelectCertificate) -> Result<Changed, Problem> {
        not_offered()
    }
    /// Current firmware only.
    async fn make_csr(&mut self, _change: MakeCsr) -> Result<CsrMade, Problem> {
        not_offered()
    }
    /// Legacy firmware only.
    async fn import_csr(&mut self, _change: ImportCsr) -> Result<CsrMade, Problem> {
        not_offered()
    }
    async fn import_ca_signed(&mut self, _change: ImportCaSigned) -> Result<Installed, Problem> {
        not_offered()
    }
    /// The trusted list, or on current firmware the issuers list.
    async fn clients(&mut self, _list: ClientList) -> Result<Revisioned<Vec<ListedCertificate>>, Problem> {
        not_offered()
    }
    /// Seen last first.
    async fn rejected_clients(&mut self) -> Result<Revisioned<Vec<RejectedClient>>, Problem> {
        not_offered()
    }
    async fn crls(&mut self) -> Result<Revisioned<Vec<ListedCrl>>, Problem> {
        not_offered()
    }
    /// The DER of one CRL.
    async fn crl(&mut self, _id: &str) -> Result<Base64Bytes, Problem> {
        not_offered()
    }
    /// Cheap: tells whether the lists and CRLs are worth reading again.
    async fn trust_stamp(&mut self) -> Result<TrustStamp, Problem> {
        not_offered()
    }
    async fn edit_trust(&mut self, _change: EditTrust) -> Result<TrustChanged, Problem> {
        not_offered()
    }
    /// Legacy firmware only.
    async fn activate(&mut self, _change: Activate) -> Result<Changed, Problem> {
        not_offered()
    }
    /// The server log from this byte on, or its end.
    async fn log(&mut self, _from: Option<u64>) -> Result<LogChunk, Problem> {
        not_offered()
    }
    /// Legacy firmware only.
    async fn export_settings(&mut self, _request: ExportSettings) -> Result<SettingsExport, Problem> {
        not_offered()
    }
    /// Legacy firmware only.
    async fn import_settings(&mut self, _change: ImportSettings) -> Result<Changed, Problem> {
        not_offered()
    }
    /// The revision that a change was based on which was sent and whose answer did not come: it may have been applied.
    fn unanswered(&self) -> Option<u64> {
        None
    }
    /// Ends the session in the controller. Failing to do so is harmless: it expires there.
    async fn close(&mut self);
}

fn not_offered<T>() -> Result<T, Problem> {
    Err(Problem::with_detail(ErrorCode::Refused, "this way of reaching the controller does not offer it"))
}
