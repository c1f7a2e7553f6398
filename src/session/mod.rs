//! One session with one controller: what every driver must offer, and the driver for the management protocol.
//!
//! A [`Connector`] opens [`ControllerSession`]s. Jobs know only these two traits, so another way of reaching a
//! controller is one more driver and no change anywhere else.

mod management;
mod pinned_tls;

use async_trait::async_trait;
use secrecy::SecretString;

pub use management::{ManagementConnector, Timeouts};

use crate::model::{Address, ClientList, ControllerInfo, Problem, ServerSettings, UserName};
use crate::pki::Fingerprint;
use crate::protocol::{
    Activate, AddClients, AddUser, Changed, ExportSettings, ImportCertificate, ImportSettings, Installed,
    ListedCertificate, LogChunk, MakeSelfSigned, RemoveUsers, Revisioned, SetSettings, SettingsExport,
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
/// that the connection or the session is over.
#[async_trait]
pub trait ControllerSession: Send + Sync {
    async fn info(&mut self) -> Result<ControllerInfo, Problem>;
    async fn start_server(&mut self) -> Result<Changed, Problem>;
    async fn stop_server(&mut self) -> Result<Changed, Problem>;
    async fn settings(&mut self) -> Result<Revisioned<ServerSettings>, Problem>;
    async fn set_settings(&mut self, change: SetSettings) -> Result<Changed, Problem>;
    async fn users(&mut self) -> Result<Revisioned<Vec<UserName>>, Problem>;
    async fn add_user(&mut self, change: AddUser) -> Result<Changed, Problem>;
    async fn remove_users(&mut self, change: RemoveUsers) -> Result<Changed, Problem>;
    /// Current firmware only.
    async fn make_self_signed(&mut self, change: MakeSelfSigned) -> Result<Installed, Problem>;
    /// Legacy firmware only.
    async fn import_certificate(&mut self, change: ImportCertificate) -> Result<Installed, Problem>;
    async fn clients(&mut self, list: ClientList) -> Result<Revisioned<Vec<ListedCertificate>>, Problem>;
    async fn add_clients(&mut self, list: ClientList, change: AddClients) -> Result<Changed, Problem>;
    /// Legacy firmware only.
    async fn activate(&mut self, change: Activate) -> Result<Changed, Problem>;
    /// The server log from this byte on, or its end.
    async fn log(&mut self, from: Option<u64>) -> Result<LogChunk, Problem>;
    /// Legacy firmware only.
    async fn export_settings(&mut self, request: ExportSettings) -> Result<SettingsExport, Problem>;
    /// Legacy firmware only.
    async fn import_settings(&mut self, change: ImportSettings) -> Result<Changed, Problem>;
    /// Ends the session in the controller. Failing to do so is harmless: it expires there.
    async fn close(&mut self);
}
