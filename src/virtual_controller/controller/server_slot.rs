use std::path::Path;

use tokio::task::spawn_blocking;

use super::error::{ControllerError, ServerStartError};
use crate::model::{CertificateSummary, DisconnectedClient};
use crate::pki::{Certificate, Crl, PkiError, TrustLists, TrustPolicy};
use crate::virtual_controller::cell::CellHandle;
use crate::virtual_controller::opcua::{
    CertificateClock, DisconnectedConnection, OpcUaConfig, OpcUaServer, OpcUaUser, ServerEvents,
};
use crate::virtual_controller::state::{ControllerState, OperatingContext, TrustListCertificate};

/// The OPC UA server, if it runs. Serialises changes: only the holder of the lock around it may change the server.
#[derive(Debug)]
pub(super) struct ServerSlot {
    pub server: Option<OpcUaServer>,
    /// The controller is switched off; nothing begins any more.
    pub off: bool,
}

impl ServerSlot {
    pub fn admit(&self) -> Result<(), ControllerError> {
        if self.off { Err(ControllerError::SwitchedOff) } else { Ok(()) }
    }

    pub fn is_running(&self) -> bool {
        self.server.as_ref().is_some_and(OpcUaServer::is_running)
    }

    /// Puts other trust lists in force in the running server, and says whose connections it ended.
    pub async fn trust(&mut self, lists: TrustLists) -> Vec<DisconnectedClient> {
        let Some(server) = self.server.take() else { return Vec::new() };
        // Checks the certificate of every connection.
        let changed = spawn_blocking(move || {
            let cut = server.set_trust(lists);
            (server, cut)
        });
        match changed.await {
            Ok((server, cut)) => {
                self.server = Some(server);
                cut.into_iter().map(cut_client).collect()
            }
            Err(error) => {
                tracing::error!(%error, "the OPC UA server died of a change of trust");
                Vec::new()
            }
        }
    }

    pub async fn stop(&mut self) {
        if let Some(server) = self.server.take() {
            server.stop().await;
        }
    }
}

const OPCUA_FOLDER: &str = "opcua";

pub(super) fn opcua_config(
    state: &ControllerState,
    context: &OperatingContext,
    cell: CellHandle,
    folder: &Path,
) -> Result<OpcUaConfig, ServerStartError> {
    let pair = state.check_start(context)?;
    let names = state.server_names(context);
    // Clients insist that the server's URI is the one in its certificate, and a certificate from elsewhere has its own.
    let application_uri =
        pair.parse().ok().and_then(|certificate| certificate.application_uri()).unwrap_or(names.application_uri);
    Ok(OpcUaConfig {
        application_name: state.application_name(context),
        application_uri,
        bind: context.bind,
        port: state.settings.port.get(),
        policies: state.settings.security_policies.clone(),
        user_tokens: state.settings.user_tokens.clone(),
        users: state
            .users
            .iter()
            .map(|user| OpcUaUser { name: user.name.to_string(), password_hash: user.password_hash.clone() })
            .collect(),
        certificate_der: pair.certificate.0.clone(),
        private_key_pkcs8: pair.private_key.0.clone(),
        trust: trust_lists(state).map_err(ServerStartError::TrustLists)?,
        trust_policy: TrustPolicy::default(),
        detailed_status: false,
        refusals: None,
        clock: CertificateClock::default(),
        cell,
        events: ServerEvents::default(),
        pki_folder: folder.join(OPCUA_FOLDER),
    })
}

/// What the state lists, parsed. Slow with large CRLs.
pub(super) fn trust_lists(state: &ControllerState) -> Result<TrustLists, PkiError> {
    let certificates = |list: &[TrustListCertificate]| -> Result<Vec<Certificate>, PkiError> {
        list.iter().map(|listed| Certificate::from_der(&listed.certificate.0)).collect()
    };
    let crls = state.crls.iter().map(|held| Crl::from_der(&held.crl.0)).collect::<Result<_, _>>()?;
    Ok(TrustLists::new(certificates(&state.trusted)?, certificates(&state.issuers)?, crls))
}

fn cut_client(cut: DisconnectedConnection) -> DisconnectedClient {
    let CertificateSummary { issued_to, thumbprint, .. } = cut.certificate.summary();
    DisconnectedClient { address: cut.address.to_string(), issued_to, thumbprint, status: cut.rejection.status() }
}
