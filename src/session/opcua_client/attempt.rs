use opcua::client::services::{ActivateSession, CloseSession, CreateSession, Read};
use opcua::client::{IdentityToken, UARequest};
use opcua::crypto::{PrivateKey, X509};
use opcua::types::{ApplicationDescription, ApplicationType, NodeId, ReadValueId, StatusCode, VariableId, Variant};
use secrecy::ExposeSecret as _;

use super::connection::{Channel, Connection, REQUEST};
use super::failure::{Cause, Failure, Stage, status};
use super::{Endpoint, Login, Welcome};
use crate::model::SecurityPolicy;

/// One try with one endpoint and one login.
pub(super) struct Attempt {
    pub connection: Connection,
    pub endpoint: Endpoint,
    /// DER.
    pub expected: Vec<u8>,
    pub login: Login,
    pub application_uri: String,
    pub own_certificate: X509,
    pub own_key: PrivateKey,
}

impl Attempt {
    pub async fn run(self) -> Result<Welcome, Failure> {
        let secured = self.endpoint.policy != Ok(SecurityPolicy::None);
        if secured && self.endpoint.certificate != self.expected {
            return Err(Failure::of(Stage::Channel, Cause::OtherCertificate));
        }
        let description = self.endpoint.at(&self.connection.target);
        let mut channel = self.connection.open(description.clone()).await?;
        let session = self.create_session(&mut channel, &description).await?;
        let result = self.use_session(&mut channel, description, &session).await;
        // A session that is not closed takes one of the few that the server allows.
        let close = async |secure: &_| {
            CloseSession::new_manual(0, REQUEST, session.clone(), 0).delete_subscriptions(true).send(secure).await
        };
        if let Ok(Err(failure)) = tokio::time::timeout(CLOSE, channel.drive(Stage::CreateSession, close)).await {
            tracing::debug!(cause = %failure.cause, "session not closed");
        }
        channel.close().await;
        result
    }

    /// The authentication token of the new session.
    async fn create_session(
        &self,
        channel: &mut Channel,
        description: &opcua::types::EndpointDescription,
    ) -> Result<NodeId, Failure> {
        let store = &self.connection.store;
        let created = channel
            .drive(Stage::CreateSession, async |secure| {
                let application = ApplicationDescription {
                    application_uri: self.application_uri.as_str().into(),
                    product_uri: "urn:opcua-configurator".into(),
                    application_name: APPLICATION.into(),
                    application_type: ApplicationType::Client,
                    ..Default::default()
                };
                CreateSession::new_manual(store, description, 0, REQUEST, NodeId::null(), secure.request_handle())
                    .client_description(application)
                    .endpoint_url(description.endpoint_url.clone())
                    .session_name(APPLICATION)
                    .client_certificate(self.own_certificate.clone())
                    .session_timeout(SESSION_TIMEOUT_MS)
                    .send(secure)
                    .await
            })
            .await?;
        let login_needs_it = matches!(self.login, Login::User { .. });
        // A password is encrypted for whatever certificate is in this answer, which nothing signs without security.
        if login_needs_it && created.server_certificate.as_ref() != self.expected {
            return Err(Failure::of(Stage::CreateSession, Cause::OtherCertificate));
        }
        Ok(created.authentication_token)
    }

    async fn use_session(
        &self,
        channel: &mut Channel,
        description: opcua::types::EndpointDescription,
        session: &NodeId,
    ) -> Result<Welcome, Failure> {
        let token = match &self.login {
            Login::Anonymous => IdentityToken::Anonymous,
            Login::User { name, password } => IdentityToken::new_user_name(name.clone(), password.expose_secret()),
        };
        channel
            .drive(Stage::Login, async |secure| {
                let handle = secure.request_handle();
                ActivateSession::new_manual(description, 0, REQUEST, session.clone(), handle)
                    .identity_token(token)
                    .private_key(self.own_key.clone())
                    .send(secure)
                    .await
            })
            .await?;
        let read = channel
            .drive(Stage::Read, async |secure| {
                Read::new_manual(0, REQUEST, session.clone(), secure.request_handle())
                    .node(ReadValueId::from(NodeId::from(VariableId::Server_ServerStatus_State)))
                    .node(ReadValueId::from(NodeId::from(VariableId::Server_NamespaceArray)))
                    .send(secure)
                    .await
            })
            .await?;
        let values = read.results.unwrap_or_default();
        let [state, namespaces] = &values[..] else {
            return Err(Failure::of(Stage::Read, Cause::NotOpcUa("its answer is not what was asked for".to_owned())));
        };
        for value in [state, namespaces] {
            if let Some(code) = value.status.filter(|code| code.is_bad()) {
                return Err(Failure::of(Stage::Read, status(code, "")));
            }
        }
        match &state.value {
            Some(Variant::Int32(state)) => Ok(Welcome { state: *state }),
            _ => Err(Failure::of(Stage::Read, status(StatusCode::BadTypeMismatch, ""))),
        }
    }
}

const APPLICATION: &str = "OPC UA Configurator";
/// A server that hears no more of this client forgets it soon.
const SESSION_TIMEOUT_MS: f64 = 10_000.0;
const CLOSE: std::time::Duration = std::time::Duration::from_secs(2);
