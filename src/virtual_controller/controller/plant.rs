use std::path::Path;

use crate::model::{ErrorCode, Problem};
use crate::virtual_controller::opcua::{DeviceIdentity, Events, OpcUaConfig, OpcUaServer, OpcUaUser};
use crate::virtual_controller::state::{State, Surroundings};

#[derive(Debug)]
struct Plant {
    server: Option<OpcUaServer>,
    /// The controller is switched off; nothing begins any more.
    off: bool,
}

impl Plant {
    fn admit(&self) -> Result<(), Problem> {
        if self.off { Err(Problem::with_detail(ErrorCode::Refused, "the controller is switched off")) } else { Ok(()) }
    }

    fn is_running(&self) -> bool {
        self.server.as_ref().is_some_and(OpcUaServer::is_running)
    }

    fn trust(&self, state: &State) -> Result<(), Problem> {
        match &self.server {
            Some(server) => server
                .set_trusted_clients(&trusted_clients(state))
                .map_err(|source| StoreError::Io { path: PathBuf::from(OPCUA_FOLDER), source }.into()),
            None => Ok(()),
        }
    }

    async fn stop(&mut self) {
        if let Some(server) = self.server.take() {
            server.stop().await;
        }
    }
}

const OPCUA_FOLDER: &str = "opcua";

fn opcua_config(state: &State, around: &Surroundings, folder: &Path) -> Result<OpcUaConfig, Problem> {
    let pair = state.check_start(around)?;
    let names = state.server_names(around);
    // Clients insist that the server's URI is the one in its certificate, and a certificate from elsewhere has its own.
    let application_uri =
        pair.parse().ok().and_then(|certificate| certificate.application_uri()).unwrap_or(names.application_uri);
    Ok(OpcUaConfig {
        application_name: state.application_name(around),
        application_uri,
        bind: around.bind,
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
        trusted_clients: trusted_clients(state),
        identity: DeviceIdentity {
            name: state.identity.name.to_string(),
            series: state.identity.series,
            serial: state.identity.serial.clone(),
            firmware: state.identity.firmware,
        },
        events: Events::default(),
        pki_folder: folder.join(OPCUA_FOLDER),
    })
}

fn trusted_clients(state: &State) -> Vec<Vec<u8>> {
    state.trusted.iter().map(|listed| listed.certificate.0.clone()).collect()
}
