use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;

use tokio::task::spawn_blocking;

use super::{Controller, ControllerError, ServerState};
use crate::model::{
    Base64Bytes, Changed, ClientList, ControllerInfo, ErrorCode, FirmwareGeneration, ListedCertificate, ListedCrl,
    LogChunk, RevisionToken, Revisioned, ServerSettings, ServerStatus, StoredServerCertificate,
    StoredServerCertificates, TrustStamp, UserName,
};
use crate::pki::RejectedClient;
use crate::protocol::{SettingsExport, WireSecret};
use crate::virtual_controller::change_error::TrustError;
use crate::virtual_controller::ports::is_free;
use crate::virtual_controller::settings_transfer;
use crate::virtual_controller::state::TrustListCertificate;

impl Controller {
    /// `reached`: the address the asking client used, which names the controller when it listens on every one.
    pub(in super::super) fn info(&self, reached: Option<IpAddr>) -> ControllerInfo {
        let (status, error) = self.status();
        let (state, around) = (self.state(), self.operating_context());
        ControllerInfo {
            name: state.identity.name.to_string(),
            serial: state.identity.serial.clone(),
            series: state.identity.series,
            firmware: state.identity.firmware,
            status,
            error,
            activated: state.activated,
            certificate: state.server_certificate(),
            application_name: state.application_name(&around),
            endpoint: self.endpoint(reached),
            used_ports: state.taken_ports(&around),
            limits: state.limits(),
            clock: around.now,
            revision: RevisionToken::new(state.revision),
        }
    }

    pub(in super::super) fn settings(&self) -> Revisioned<ServerSettings> {
        let state = self.state();
        Revisioned { revision: RevisionToken::new(state.revision), value: state.settings.clone() }
    }

    pub(in super::super) fn users(&self) -> Revisioned<Vec<UserName>> {
        let state = self.state();
        Revisioned {
            revision: RevisionToken::new(state.revision),
            value: state.users.iter().map(|user| user.name.clone()).collect(),
        }
    }

    pub(in super::super) fn certificates(&self) -> Revisioned<StoredServerCertificates> {
        let state = self.state();
        let held = state
            .certificates
            .iter()
            .map(|(kind, pair)| StoredServerCertificate { kind: *kind, certificate: pair.certificate.clone() })
            .collect();
        let csr = state.csr.as_ref().map(|pending| pending.csr.clone());
        Revisioned {
            revision: RevisionToken::new(state.revision),
            value: StoredServerCertificates { selected: state.selected, held, csr },
        }
    }

    /// The trusted or the issuers list.
    pub(in super::super) fn clients(&self, list: ClientList) -> Result<Revisioned<Vec<ListedCertificate>>, TrustError> {
        let state = self.state();
        if list == ClientList::Issuers && state.generation() == FirmwareGeneration::Legacy {
            return Err(TrustError::FirmwareTooOld);
        }
        let value = state.list(list).iter().filter_map(TrustListCertificate::to_message).collect();
        Ok(Revisioned { revision: RevisionToken::new(state.revision), value })
    }

    pub(in super::super) fn rejected_clients(&self) -> Revisioned<Vec<RejectedClient>> {
        Revisioned { revision: RevisionToken::new(self.state().revision), value: self.rejected.list() }
    }

    pub(in super::super) fn crls(&self) -> Revisioned<Vec<ListedCrl>> {
        let state = self.state();
        Revisioned { revision: RevisionToken::new(state.revision), value: state.listed_crls() }
    }

    /// The DER of one CRL.
    pub(in super::super) fn crl(&self, id: &str) -> Result<Base64Bytes, TrustError> {
        let state = self.state();
        let held = state.crls.iter().find(|held| held.summary.id == id);
        held.map(|held| held.crl.clone()).ok_or_else(|| TrustError::NotInList(id.to_owned()))
    }

    pub(in super::super) fn trust_stamp(&self) -> TrustStamp {
        TrustStamp { revision: RevisionToken::new(self.state().revision), rejected: self.rejected.stamp() }
    }

    /// The server log from byte `from` on, or its end.
    pub(in super::super) async fn read_log(&self, from: Option<u64>) -> Result<LogChunk, ControllerError> {
        let log = Arc::clone(&self.log);
        let read = spawn_blocking(move || log.read(from)).await.map_err(std::io::Error::other).flatten();
        read.map_err(ControllerError::Log)
    }

    /// Settings, users and keys, sealed.
    pub(in super::super) async fn export(&self, passphrase: WireSecret) -> Result<SettingsExport, ControllerError> {
        let (state, around) = (self.state(), self.operating_context());
        Ok(spawn_blocking(move || settings_transfer::export(&state, &around, &passphrase.0)).await??)
    }

    pub(super) fn changed(&self) -> Changed {
        Changed { revision: RevisionToken::new(self.state().revision), status: self.status().0 }
    }

    /// A server that died by itself is noticed here.
    fn status(&self) -> (ServerStatus, Option<ErrorCode>) {
        let server_state = *self.server_state.lock();
        let notice = self.state().settings.server_log.then_some(ErrorCode::ServerLogOn);
        match server_state {
            ServerState::Stopped => (ServerStatus::Stop, notice),
            ServerState::Failed { code, revision } => match self.lasts(code, revision) {
                Some(code) => (ServerStatus::Error, Some(code)),
                None => (ServerStatus::Stop, notice),
            },
            ServerState::Running => match self.server.try_lock() {
                Ok(slot) if !slot.is_running() => (ServerStatus::Error, Some(ErrorCode::ServerError)),
                _ => (ServerStatus::Run, notice),
            },
        }
    }

    /// The reason for which a server that failed to start could not start now either: 7930 to 7933 and 582 end when
    /// their cause is mended; the others last until the next start or stop that succeeds.
    fn lasts(&self, failed: ErrorCode, at_revision: u64) -> Option<ErrorCode> {
        use ErrorCode::*;
        let state = self.state();
        match failed {
            NotActivated | NoCertificate | InvalidParameter | PortConflict => {
                if let Err(refusal) = state.check_start(&self.operating_context()) {
                    return Some(refusal.code());
                }
                let lasts = match failed {
                    // Another program on this computer has the port.
                    PortConflict => !is_free(self.bind, state.settings.port.get()),
                    // The server itself did not accept its configuration.
                    InvalidParameter => state.revision == at_revision,
                    _ => false,
                };
                lasts.then_some(failed)
            }
            ServerLogFull => (state.settings.server_log && self.log.is_full()).then_some(failed),
            other => Some(other),
        }
    }

    pub(in super::super) fn endpoint(&self, reached: Option<IpAddr>) -> String {
        let host = match reached {
            Some(address) if self.bind.is_unspecified() => address.to_canonical(),
            _ => self.operating_context().address(),
        };
        format!("opc.tcp://{}", SocketAddr::new(host, self.state().settings.port.get()))
    }
}
