//! An OPC UA client, from the OPC UA crate, with a certificate of one's choice.

use std::fs;
use std::sync::Arc;
use std::time::Duration;

use opcua::client::{ClientBuilder, IdentityToken, Session};
use opcua::types::{MessageSecurityMode, StatusCode};
use tempfile::TempDir;
use tokio::task::JoinHandle;
use tokio::time::timeout;

use super::authority::Application;

const WAIT_LIMIT: Duration = Duration::from_secs(60);

pub struct Client {
    session: Arc<Session>,
    /// Ends, with the reason, when the connection does.
    events: JoinHandle<StatusCode>,
    _folder: TempDir,
}

impl Client {
    /// Connects, signed and encrypted, anonymous; or says why not.
    pub async fn connect(endpoint: &str, application: &Application) -> Result<Self, StatusCode> {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir_all(folder.path().join("own")).unwrap();
        fs::create_dir_all(folder.path().join("private")).unwrap();
        fs::write(folder.path().join("own/cert.der"), &application.der).unwrap();
        fs::write(folder.path().join("private/private.pem"), application.key.serialize_pem()).unwrap();
        let mut client = ClientBuilder::new()
            .application_name(&application.name)
            .application_uri(application.application_uri())
            .product_uri("urn:client")
            .pki_dir(folder.path())
            .certificate_path("own/cert.der")
            .private_key_path("private/private.pem")
            .trust_server_certs(true)
            .verify_server_certs(false)
            .session_retry_limit(0)
            .client()
            .unwrap();
        let offered = timeout(WAIT_LIMIT, client.get_server_endpoints_from_url(endpoint)).await.unwrap();
        let offered = offered.map_err(|e| e.status())?;
        let fits =
            |policy: &str, mode| policy.ends_with("#Basic256Sha256") && mode == MessageSecurityMode::SignAndEncrypt;
        let endpoint = offered.into_iter().find(|e| fits(e.security_policy_uri.as_ref(), e.security_mode));
        let endpoint = endpoint.expect("the endpoint is offered");
        let connected = client.connect_to_endpoint_directly(endpoint, IdentityToken::Anonymous);
        let (session, events) = connected.map_err(|e| e.status())?;
        // A refused connection shows only on the event loop.
        let mut events = events.spawn();
        tokio::select! {
            _ = session.wait_for_connection() => Ok(Self { session, events, _folder: folder }),
            status = &mut events => Err(status.unwrap()),
            () = tokio::time::sleep(WAIT_LIMIT) => panic!("neither connected nor refused"),
        }
    }

    /// Waits until the server has ended the connection.
    pub async fn was_cut_off(self) -> bool {
        timeout(WAIT_LIMIT, self.events).await.is_ok()
    }

    pub async fn close(self) {
        let _refused = timeout(WAIT_LIMIT, self.session.disconnect()).await;
        let _ended = timeout(WAIT_LIMIT, self.events).await;
    }
}
