use std::collections::BTreeSet;
use std::io::{self, ErrorKind};
use std::net::SocketAddr;
use std::sync::Arc;

use opcua::crypto::SecurityPolicy as WirePolicy;
use opcua::server::ServerHandle;
use opcua::types::StatusCode;
use tokio::task::spawn_blocking;

use super::super::certificate_store::PkiFolder;
use super::super::endpoints::wire;
use super::client_verifier::{self, ClientVerifier, invalid, read_chain};
use super::connections::{ClaimedIdentity, GateConnection, GateConnections, StopReason};
use super::fault::Fault;
use super::frame::OpenChannelHeader;
use super::inner_server::InnerServer;
use super::limits::AdmissionLimits;
use super::report::AdmissionReporter;
use super::rewrap::{SecuredClient, ServerKeyPair};
use super::sessions::{OpcUaSessions, SessionNumber};
use crate::model::SecurityPolicy;
use crate::pki::{Certificate, CertificateFlaw, CertificateRejection, TrustLists, check_application_uri};
use crate::virtual_controller::connection_limits::ConnectionStage;

/// Stands in front of the OPC UA crate's server, which has no port of its own, and lets in whom it may.
///
/// The crate never lets go of a client that has stopped reading: stopping would take forever and keep a core busy. The
/// clients' connections are therefore ours; dropping [`Gate::run`] closes them all, and the port.
#[derive(Debug)]
pub(in super::super) struct Gate {
    settings: GateSettings,
    pub(super) server: InnerServer,
    own: Arc<ServerKeyPair>,
    verifier: ClientVerifier,
    pki: PkiFolder,
    pub(super) connections: GateConnections,
    sessions: OpcUaSessions,
    pub(super) reporter: AdmissionReporter,
}

/// What the gate of one server does not change.
#[derive(Debug)]
pub(in super::super) struct GateSettings {
    pub(super) limits: AdmissionLimits,
    pub(super) policies: BTreeSet<SecurityPolicy>,
    pub(super) detailed_status: bool,
}

impl GateSettings {
    pub(in super::super) fn new(policies: BTreeSet<SecurityPolicy>, detailed_status: bool) -> Self {
        Self { limits: AdmissionLimits::default(), policies, detailed_status }
    }
}

/// An open connection that was ended because its certificate is not trusted any more.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DisconnectedConnection {
    /// Where the client connected from.
    pub address: SocketAddr,
    /// The client's own.
    pub certificate: Certificate,
    /// Why it would not be let in now.
    pub rejection: CertificateRejection,
}

impl Gate {
    pub(in super::super) fn new(
        settings: GateSettings,
        server: InnerServer,
        own: ServerKeyPair,
        verifier: ClientVerifier,
        pki: PkiFolder,
        reporter: AdmissionReporter,
    ) -> Self {
        let connections = GateConnections::new(settings.limits.slots);
        Self {
            settings,
            server,
            own: Arc::new(own),
            verifier,
            pki,
            connections,
            sessions: OpcUaSessions::default(),
            reporter,
        }
    }

    /// Makes the crate's server the one that clients are led to, until the answer is dropped.
    pub(in super::super) fn attach(self: &Arc<Self>, server: ServerHandle) -> Attached {
        self.server.attach(Some(server));
        Attached(self.clone())
    }

    /// Puts other trust lists in force and ends every open connection that would not be let in now.
    ///
    /// Blocks as [`TrustLists::validate`] does, for each connection.
    pub(in super::super) fn set_trust(&self, lists: TrustLists) -> Vec<DisconnectedConnection> {
        self.verifier.replace(lists);
        let mut cut = Vec::new();
        for connection in self.connections.all() {
            let Some(identity) = connection.state.lock().identity.clone() else { continue };
            let Some(leaf) = identity.leaf() else { continue };
            if let Err(rejection) = self.verifier.admit(&identity.chain, identity.policy, || ()) {
                connection.stop(StopReason::Told(client_verifier::fault(&rejection, self.settings.detailed_status)));
                self.forget(leaf, &connection);
                if connection.state.lock().channel.is_none() {
                    continue;
                }
                self.reporter.cut(connection.peer, &identity.chain, &rejection);
                cut.push(DisconnectedConnection { address: connection.peer, certificate: leaf.clone(), rejection });
            }
        }
        cut
    }

    pub(in super::super) fn pki(&self) -> &PkiFolder {
        &self.pki
    }

    pub(super) fn limits(&self) -> &AdmissionLimits {
        &self.settings.limits
    }

    pub(super) fn own(&self) -> &Arc<ServerKeyPair> {
        &self.own
    }

    pub(super) fn sessions(&self) -> &OpcUaSessions {
        &self.sessions
    }

    /// A client asks for one more session. `None` if it cannot have one.
    pub(super) fn enter_session(&self, connection: &Arc<GateConnection>) -> Option<SessionNumber> {
        self.sessions.enter(connection, &|token| self.server.find_session(token))
    }

    /// The message to the server when a client has left: it closes the client's sessions.
    pub(super) fn closing_message(&self, connection: &Arc<GateConnection>) -> Vec<u8> {
        let Some(channel) = connection.state.lock().channel else { return Vec::new() };
        let ended = self.sessions.leave(connection, channel, &|token| self.server.find_session(token));
        connection.channel.lock().close_sessions(&ended)
    }

    pub(super) fn connection_of_mark(&self, mark: &str) -> Option<Arc<GateConnection>> {
        self.connections
            .all()
            .into_iter()
            .find(|connection| connection.state.lock().login_mark.as_deref() == Some(mark))
    }

    /// Reports that a user was not let in, unless the source is over its limit.
    pub(in super::super) fn login_refused(&self, client: SocketAddr, user: Option<&str>, reason: &str) {
        self.reporter.login_refused(client, user, reason);
    }

    /// Whether sessions without security are offered.
    pub(super) fn offers_none(&self) -> bool {
        self.settings.policies.contains(&SecurityPolicy::None)
    }

    /// Tells of a refusal, and says how the connection is to end.
    pub(super) fn refuse(&self, connection: &GateConnection, fault: Fault) -> StopReason {
        let told = self.reporter.refused(connection.peer, &fault.reason);
        if told { StopReason::Told(fault) } else { StopReason::AtOnce(fault) }
    }

    fn reject(
        &self,
        connection: &GateConnection,
        chain: &[Certificate],
        rejection: &CertificateRejection,
    ) -> StopReason {
        let fault = client_verifier::fault(rejection, self.settings.detailed_status);
        let told = self.reporter.rejected(connection.peer, chain, rejection);
        if told { StopReason::Told(fault) } else { StopReason::AtOnce(fault) }
    }

    /// Looks at an OpenSecureChannel request: the first of a connection, or a renewal by the same client.
    pub(super) async fn admit(
        self: &Arc<Self>,
        connection: &Arc<GateConnection>,
        chunk: &[u8],
    ) -> Result<Arc<ClaimedIdentity>, StopReason> {
        let open = OpenChannelHeader::parse(chunk).map_err(|fault| self.refuse(connection, fault))?;
        let refuse = |status, reason| Err(self.refuse(connection, Fault::new(status, reason)));
        let (known, channel) = {
            let state = connection.state.lock();
            (state.identity.clone(), state.channel)
        };
        let Some(policy) = self.offered(open.policy_uri) else {
            return refuse(StatusCode::BadSecurityPolicyRejected, "a security policy that is not offered");
        };
        match &known {
            Some(known) if known.policy != policy || known.sent != open.certificates => {
                return refuse(StatusCode::BadSecurityChecksFailed, "renewal by somebody else");
            }
            Some(_) if channel != Some(open.channel) => {
                return refuse(StatusCode::BadTcpSecureChannelUnknown, "renewal of another channel");
            }
            None if open.channel != 0 => {
                return refuse(StatusCode::BadTcpSecureChannelUnknown, "the first channel has no number yet");
            }
            _ => {}
        }
        if policy == WirePolicy::None {
            let identity = Arc::new(ClaimedIdentity { policy, sent: open.certificates.to_vec(), chain: Vec::new() });
            connection.state.lock().identity = Some(identity.clone());
            return Ok(identity);
        }
        if open.receiver_thumbprint != self.own.thumbprint() {
            return refuse(StatusCode::BadCertificateInvalid, "the request is for another server certificate");
        }
        let (gate, connection, sent) = (self.clone(), connection.clone(), open.certificates.to_vec());
        spawn_blocking(move || gate.verifier(&connection, policy, sent))
            .await
            .unwrap_or_else(|_| Err(StopReason::Told(Fault::internal())))
    }

    fn verifier(
        &self,
        connection: &GateConnection,
        policy: WirePolicy,
        sent: Vec<u8>,
    ) -> Result<Arc<ClaimedIdentity>, StopReason> {
        let chain = read_chain(&sent).map_err(|rejection| self.reject(connection, &[], &rejection))?;
        let identity = Arc::new(ClaimedIdentity { policy, sent, chain });
        let let_in = self.verifier.admit(&identity.chain, policy, || {
            let Some(leaf) = identity.leaf() else { return Ok::<_, io::Error>(()) };
            {
                let mut state = connection.state.lock();
                if state.secured.is_none() {
                    let client = SecuredClient::new(policy, leaf.der()).map_err(|_| ErrorKind::InvalidInput)?;
                    state.secured = Some(Arc::new(client));
                }
                // Before the folder, so that the certificate is not found there without a connection that needs it.
                state.identity = Some(identity.clone());
            }
            self.pki.admit(leaf.der())
        });
        match let_in {
            Ok(Ok(())) => Ok(identity),
            Ok(Err(e)) if e.kind() == ErrorKind::InvalidInput => {
                let rejection = invalid("the server cannot work with this certificate, perhaps because of its name");
                Err(self.reject(connection, &identity.chain, &rejection))
            }
            Ok(Err(e)) => {
                tracing::error!("the certificate of an OPC UA client cannot be kept: {e}");
                Err(StopReason::Told(Fault::internal()))
            }
            Err(rejection) => {
                if let Some(leaf) = identity.leaf() {
                    self.forget(leaf, connection);
                }
                Err(self.reject(connection, &identity.chain, &rejection))
            }
        }
    }

    /// Takes the certificate of a client that was refused out of the server's hands; not if another connection was let
    /// in with it. Certificates are public: a peer that shows the certificate of another in a way that is refused must
    /// not lock its owner out.
    fn forget(&self, leaf: &Certificate, refused: &GateConnection) {
        self.pki.forget(leaf.der(), || self.connections.any_other_has(leaf, refused));
    }

    /// The policy of this name, if clients may open a channel with it. Without security every client may, since that is
    /// how they ask for the endpoints.
    fn offered(&self, uri: &str) -> Option<WirePolicy> {
        let policies = self.settings.policies.iter().chain([&SecurityPolicy::None]);
        policies.map(|policy| wire(*policy)).find(|policy| policy.to_uri() == uri)
    }

    /// The server has answered an OpenSecureChannel with this channel.
    pub(super) fn opened(&self, connection: &Arc<GateConnection>, channel: u32) {
        self.connections.opened(connection, channel);
    }

    /// The server hangs up with an error of its own.
    pub(super) fn server_refused(&self, connection: &GateConnection) {
        let state = connection.state.lock();
        let unopened = state.identity.clone().filter(|_| state.channel.is_none());
        drop(state);
        if let Some(leaf) = unopened.as_ref().and_then(|identity| identity.leaf()) {
            self.reporter.refused(connection.peer, &format!("the secure channel was not opened ({})", leaf.subject()));
        }
    }

    /// The request of a client with this certificate could not be opened.
    pub(super) fn unproven(&self, connection: &GateConnection, identity: &ClaimedIdentity, fault: Fault) -> StopReason {
        let told = identity.leaf().is_none_or(|leaf| self.reporter.refused(connection.peer, &unproven(leaf)));
        if told { StopReason::Told(fault) } else { StopReason::AtOnce(fault) }
    }

    /// Tells of a request that the server is made to refuse; the connection stays.
    pub(super) fn spoilt(&self, connection: &GateConnection, reason: &str) {
        self.reporter.refused(connection.peer, reason);
    }

    /// The longest message the client of a secure channel takes, in bytes; `None` without a limit.
    pub(in super::super) fn longest_response(&self, channel: u32) -> Option<usize> {
        self.connections.of_channel(channel)?.state.lock().longest_response
    }

    /// Whether a session belongs to the connection it came by. If it does not, the connection ends.
    ///
    /// `facts`: the certificate of CreateSession, DER, and the ApplicationUri; asked for once a session.
    pub(super) fn vouch(
        &self,
        session: u32,
        channel: u32,
        facts: impl FnOnce() -> (Option<Vec<u8>>, String),
    ) -> Result<(), StatusCode> {
        let connection = self.connections.of_channel(channel).ok_or(StatusCode::BadSecureChannelIdInvalid)?;
        if connection.is_stopped() {
            return Err(StatusCode::BadSecureChannelClosed);
        }
        let identity = {
            let state = connection.state.lock();
            if state.sessions.contains(&session) {
                return Ok(());
            }
            state.identity.clone().ok_or(StatusCode::BadSecureChannelIdInvalid)?
        };
        let (certificate, application_uri) = facts();
        let problem = match identity.leaf() {
            Some(leaf) if certificate.as_deref() != Some(leaf.der()) => {
                Some(CertificateRejection::of(CertificateFlaw::NotThatOfTheChannel, leaf))
            }
            Some(leaf) => check_application_uri(leaf, &application_uri).err(),
            None if certificate.is_some() => {
                // Opened under a policy with security and moved to a channel without.
                connection.stop(self.refuse(
                    &connection,
                    Fault::new(StatusCode::BadSecurityChecksFailed, "a secured session on a channel without security"),
                ));
                return Err(StatusCode::BadSecurityChecksFailed);
            }
            None => None,
        };
        if let Some(rejection) = problem {
            connection.stop(self.reject(&connection, &identity.chain, &rejection));
            return Err(StatusCode::from(rejection.status().code()));
        }
        connection.state.lock().add_session(session);
        connection.activity.reached(ConnectionStage::InSession);
        connection.activity.used();
        Ok(())
    }
}

/// The server of a gate.
#[derive(Debug)]
pub(in super::super) struct Attached(pub(in super::super) Arc<Gate>);

impl Drop for Attached {
    fn drop(&mut self) {
        self.0.server.attach(None);
    }
}

fn unproven(leaf: &Certificate) -> String {
    format!("no proof that the client has the key of its certificate ({})", leaf.subject())
}
