use std::fs;
use std::sync::Arc;

use opcua::client::{ClientBuilder, IdentityToken, Session};
use opcua::types::{
    BrowseDescription, BrowseDirection, EndpointDescription, MessageSecurityMode, NodeClass, NodeClassMask, NodeId,
    ReadValueId, ReferenceTypeId, StatusCode, TimestampsToReturn, UserTokenPolicy, UserTokenType, VariableId, Variant,
};
use tempfile::TempDir;
use tokio::task::JoinHandle;
use tokio::time::timeout;

use super::super::{OpcUaServer, endpoints};
use super::test_application::TestApplication;
use super::{CLIENT, WAIT_LIMIT};
use crate::model::SecurityPolicy;

/// How to connect with the OPC UA crate's client.
pub(super) struct ClientOptions<'a> {
    pub server: &'a OpcUaServer,
    pub identity: &'a TestApplication,
    pub policy: SecurityPolicy,
    pub mode: MessageSecurityMode,
    pub user: IdentityToken,
    pub application_uri: String,
    /// Instead of the server's own URL.
    pub through: Option<String>,
    /// Of the secure channel, in milliseconds; renewed after three quarters of it.
    pub lifetime: u32,
    /// The longest message the client takes, in bytes.
    pub max_message_size: Option<usize>,
    /// Send passwords as they are.
    pub clear_password: bool,
}

impl<'a> ClientOptions<'a> {
    /// Encrypted, with [`CLIENT`]'s certificate, anonymous.
    pub fn new(server: &'a OpcUaServer) -> Self {
        Self {
            server,
            identity: &CLIENT,
            policy: SecurityPolicy::Basic256Sha256,
            mode: MessageSecurityMode::SignAndEncrypt,
            user: IdentityToken::Anonymous,
            application_uri: format!("urn:{}", CLIENT.name),
            through: None,
            lifetime: 60_000,
            max_message_size: None,
            clear_password: false,
        }
    }

    pub fn plain(server: &'a OpcUaServer) -> Self {
        Self { policy: SecurityPolicy::None, mode: MessageSecurityMode::None, ..Self::new(server) }
    }

    pub fn identity(self, identity: &'a TestApplication) -> Self {
        Self { identity, application_uri: format!("urn:{}", identity.name), ..self }
    }

    pub async fn connect(self) -> Result<Client, StatusCode> {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir_all(folder.path().join("own")).unwrap();
        fs::create_dir_all(folder.path().join("private")).unwrap();
        fs::write(folder.path().join("own/cert.der"), &self.identity.der).unwrap();
        fs::write(folder.path().join("private/private.pem"), self.identity.key.serialize_pem()).unwrap();
        let mut builder = ClientBuilder::new();
        if let Some(size) = self.max_message_size {
            builder = builder.max_message_size(size);
        }
        let mut client = builder
            .application_name("client")
            .application_uri(&self.application_uri)
            .product_uri("urn:client")
            .pki_dir(folder.path())
            .certificate_path("own/cert.der")
            .private_key_path("private/private.pem")
            .trust_server_certs(true)
            .verify_server_certs(false)
            .session_retry_limit(0)
            .channel_lifetime(self.lifetime)
            .client()
            .unwrap();
        let offered = timeout(WAIT_LIMIT, client.get_server_endpoints_from_url(self.server.endpoint())).await.unwrap();
        let policy = endpoints::wire(self.policy).to_uri();
        let mut endpoint = offered
            .map_err(|e| e.status())?
            .into_iter()
            .find(|e| e.security_policy_uri.as_ref() == policy && e.security_mode == self.mode)
            .unwrap_or_else(|| EndpointDescription {
                endpoint_url: self.server.endpoint().into(),
                security_policy_uri: policy.into(),
                security_mode: self.mode,
                user_identity_tokens: Some(vec![UserTokenPolicy {
                    policy_id: "anonymous".into(),
                    token_type: UserTokenType::Anonymous,
                    ..Default::default()
                }]),
                ..Default::default()
            });
        if let Some(through) = self.through {
            endpoint.endpoint_url = through.into();
        }
        if self.clear_password {
            for token in endpoint.user_identity_tokens.iter_mut().flatten() {
                token.security_policy_uri = "http://opcfoundation.org/UA/SecurityPolicy#None".into();
            }
        }
        let (session, events) = client.connect_to_endpoint_directly(endpoint, self.user).map_err(|e| e.status())?;
        // A refused connection shows only on the event loop.
        let mut events = events.spawn();
        tokio::select! {
            _ = session.wait_for_connection() => Ok(Client { session, events, _folder: folder }),
            status = &mut events => Err(status.unwrap()),
            () = tokio::time::sleep(WAIT_LIMIT) => panic!("neither connected nor refused"),
        }
    }
}

/// A connected client.
pub(super) struct Client {
    pub session: Arc<Session>,
    /// Ends, with the reason, when the connection does.
    pub events: JoinHandle<StatusCode>,
    _folder: TempDir,
}

impl Client {
    pub async fn anonymous(server: &OpcUaServer) -> Result<Self, StatusCode> {
        ClientOptions::plain(server).connect().await
    }

    pub async fn encrypted(server: &OpcUaServer) -> Result<Self, StatusCode> {
        ClientOptions::new(server).connect().await
    }

    pub async fn log_in(server: &OpcUaServer, name: &str, password: &str) -> Result<(), StatusCode> {
        let user = IdentityToken::new_user_name(name, password);
        ClientOptions { user, ..ClientOptions::plain(server) }.connect().await?.close().await;
        Ok(())
    }

    pub async fn read(&self, node: impl Into<NodeId>) -> Variant {
        self.try_read(node).await.unwrap()
    }

    pub async fn try_read(&self, node: impl Into<NodeId>) -> Result<Variant, StatusCode> {
        let node = ReadValueId::from(node.into());
        let read = timeout(WAIT_LIMIT, self.session.read(&[node], TimestampsToReturn::Both, 0.0)).await.unwrap();
        let value = read.map_err(|e| e.status())?.into_iter().next().unwrap();
        match value.status {
            Some(status) if status.is_bad() => Err(status),
            _ => Ok(value.value.unwrap_or_default()),
        }
    }

    /// Whether the server answers.
    pub async fn is_served(&self) -> bool {
        self.try_read(VariableId::Server_ServerStatus_CurrentTime).await.is_ok()
    }

    /// Names and ids of the nodes below one node.
    pub async fn browse(&self, node: impl Into<NodeId>) -> Vec<(String, NodeId)> {
        let browse = BrowseDescription {
            node_id: node.into(),
            browse_direction: BrowseDirection::Forward,
            reference_type_id: ReferenceTypeId::HierarchicalReferences.into(),
            include_subtypes: true,
            node_class_mask: (NodeClassMask::OBJECT | NodeClassMask::VARIABLE).bits(),
            result_mask: 63,
        };
        let results = timeout(WAIT_LIMIT, self.session.browse(&[browse], 100, None)).await.unwrap().unwrap();
        let references = results.into_iter().next().unwrap().references.unwrap_or_default();
        references
            .into_iter()
            .filter(|r| matches!(r.node_class, NodeClass::Object | NodeClass::Variable))
            .map(|r| (r.browse_name.name.to_string(), r.node_id.node_id))
            .collect()
    }

    pub async fn close(self) {
        let _ = timeout(WAIT_LIMIT, self.session.disconnect()).await;
        let _ = timeout(WAIT_LIMIT, self.events).await;
    }
}
