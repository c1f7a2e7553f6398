use opcua::client::services::{ActivateSession, CloseSession, CreateSession};
use opcua::client::{IdentityToken, UARequest};
use opcua::crypto::{PrivateKey, X509};
use opcua::types::{ApplicationDescription, ApplicationType, NodeId};
use secrecy::ExposeSecret as _;

use super::connection::{ClientChannel, ConnectionSetup, REQUEST};
use super::endpoint::Endpoint;
use super::failure::{ConnectFailure, ConnectFailureCause, ConnectStage};
use super::user_login::UserLogin;
use crate::model::SecurityPolicy;

/// What is needed to open a session: the server, the endpoint, who logs in.
pub(super) struct SessionRequest {
    pub connection: ConnectionSetup,
    pub endpoint: Endpoint,
    /// The certificate that the server must show. DER.
    pub expected: Vec<u8>,
    pub login: UserLogin,
    pub application_uri: String,
    pub own_certificate: X509,
    pub own_key: PrivateKey,
    /// How long the server keeps a session that it hears nothing of, in milliseconds.
    pub session_timeout_ms: f64,
}

/// A session in which a user is logged in, with its channel.
pub(super) struct OpenSession {
    pub channel: ClientChannel,
    /// Names the session in every request.
    pub token: NodeId,
}

impl SessionRequest {
    /// Opens a channel as the endpoint wants it, creates a session and logs in. Nothing is left open after an error.
    pub async fn open(self) -> Result<OpenSession, ConnectFailure> {
        let secured = self.endpoint.policy != Ok(SecurityPolicy::None);
        if secured && self.endpoint.certificate != self.expected {
            return Err(ConnectFailure::of(ConnectStage::Channel, ConnectFailureCause::OtherCertificate));
        }
        let description = self.endpoint.at(&self.connection.target);
        let mut channel = self.connection.open(description.clone()).await?;
        let token = match self.create_session(&mut channel, &description).await {
            Ok(token) => token,
            Err(failure) => {
                channel.close().await;
                return Err(failure);
            }
        };
        let mut session = OpenSession { channel, token };
        match self.activate(&mut session, description).await {
            Ok(()) => Ok(session),
            Err(failure) => {
                session.close().await;
                Err(failure)
            }
        }
    }

    /// The authentication token of the new session.
    async fn create_session(
        &self,
        channel: &mut ClientChannel,
        description: &opcua::types::EndpointDescription,
    ) -> Result<NodeId, ConnectFailure> {
        let store = &self.connection.store;
        let created = channel
            .drive(ConnectStage::CreateSession, async |secure| {
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
                    .session_timeout(self.session_timeout_ms)
                    .send(secure)
                    .await
            })
            .await?;
        let login_needs_it = matches!(self.login, UserLogin::User { .. });
        // A password is encrypted for the certificate in this answer, which nothing signs without security.
        if login_needs_it && created.server_certificate.as_ref() != self.expected {
            return Err(ConnectFailure::of(ConnectStage::CreateSession, ConnectFailureCause::OtherCertificate));
        }
        Ok(created.authentication_token)
    }

    async fn activate(
        &self,
        session: &mut OpenSession,
        description: opcua::types::EndpointDescription,
    ) -> Result<(), ConnectFailure> {
        let user = match &self.login {
            UserLogin::Anonymous => IdentityToken::Anonymous,
            UserLogin::User { name, password } => IdentityToken::new_user_name(name.clone(), password.expose_secret()),
        };
        let OpenSession { channel, token } = session;
        channel
            .drive(ConnectStage::Login, async |secure| {
                let handle = secure.request_handle();
                ActivateSession::new_manual(description, 0, REQUEST, token.clone(), handle)
                    .identity_token(user)
                    .private_key(self.own_key.clone())
                    .send(secure)
                    .await
            })
            .await?;
        Ok(())
    }
}

impl OpenSession {
    /// Closes session and channel. A server that does not answer is disconnected after some seconds.
    pub async fn close(mut self) {
        // A session that is not closed takes one of the few that the server allows.
        let close = async |secure: &_| {
            CloseSession::new_manual(0, REQUEST, self.token.clone(), 0).delete_subscriptions(true).send(secure).await
        };
        if let Ok(Err(failure)) =
            tokio::time::timeout(CLOSE, self.channel.drive(ConnectStage::CreateSession, close)).await
        {
            tracing::debug!(cause = %failure.cause, "session not closed");
        }
        self.channel.close().await;
    }
}

const APPLICATION: &str = "OPC UA Configurator";
pub(super) const CLOSE: std::time::Duration = std::time::Duration::from_secs(2);
