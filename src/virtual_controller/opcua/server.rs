use std::error::Error;
use std::fmt;
use std::io;
use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use opcua::server::node_manager::ServerContext;
use opcua::server::node_manager::memory::{CoreNodeManagerBuilder, InMemoryNodeManagerBuilder};
use opcua::server::{Server, ServerBuilder, ServerHandle};
use opcua::types::BuildInfo;
use rsa::pkcs8::{EncodePrivateKey, LineEnding};
use rsa::traits::PublicKeyParts;
use tokio::net::TcpListener;
use tokio::task::JoinHandle;

use super::address_space::{ControllerNodes, Types};
use super::admission::{
    AdmissionReporter, Attached, ClientVerifier, DisconnectedConnection, Gate, GateSettings, GuardedNodeManager,
    InnerServer, ServerKeyPair, deaf_listener,
};
use super::certificate_store::{OWN_CERTIFICATE, PkiFolder};
use super::config::OpcUaConfig;
use super::endpoints::{self, UserTokens};
use super::events::{ServerEvent, ServerEvents};
use super::start_error::{InvalidParameter, StartError};
use super::users::Users;
use crate::model::Cause;
use crate::pki::TrustLists;

/// A running OPC UA server. Dropping it stops it too, without waiting.
pub struct OpcUaServer {
    address: SocketAddr,
    handle: ServerHandle,
    gate: Attached,
    events: ServerEvents,
    server: JoinHandle<Result<(), String>>,
    clients: JoinHandle<()>,
}

impl OpcUaServer {
    /// Returns once the server accepts connections. When it fails, the port is free again.
    pub async fn start(config: OpcUaConfig) -> Result<Self, StartError> {
        // The port comes first: it is what fails most, and a port of 0 must be known before the endpoints' URLs are.
        let clients = listen(config.bind, config.port).await?;
        let address = clients.local_addr().map_err(failed)?;
        let (inner, other_end) = deaf_listener().map_err(failed)?;
        let inner_port = inner.local_addr().map_err(failed)?.port();
        let events = config.events.clone();
        let policies = config.policies.iter().map(|p| p.as_str()).collect::<Vec<_>>().join(", ");
        // Reads and writes files, checks the key, and builds some ten thousand nodes.
        let (server, handle, gate) =
            tokio::task::spawn_blocking(move || build(&config, address)).await.map_err(failed)??;
        let stop_unless_ready = handle.token().clone().drop_guard();
        let mut server = tokio::spawn(async move {
            let ended = server.run_with(inner).await;
            drop(other_end);
            ended
        });
        tokio::time::timeout(START_TIMEOUT, ready(&mut server, &handle, inner_port))
            .await
            .map_err(|_| StartError::Failed(Cause::finding("it is not ready in time")))??;
        stop_unless_ready.disarm();
        // Endpoint URLs are made with this port: it must be the one clients know before the first of them asks.
        handle.info().port.store(address.port(), Ordering::Relaxed);
        let clients = tokio::spawn(gate.0.clone().run(clients));
        let running = Self { address, handle, gate, events, server, clients };
        tracing::info!(endpoint = running.endpoint(), "OPC UA server started");
        running.events.tell(ServerEvent::Started { endpoint: &running.endpoint(), policies: &policies });
        Ok(running)
    }

    /// The TCP port it listens on.
    pub fn port(&self) -> u16 {
        self.address.port()
    }

    /// `opc.tcp://host:port`, as clients reach it.
    pub fn endpoint(&self) -> String {
        endpoint(self.address)
    }

    /// Lets in clients by these lists from now on, and ends at once every open connection that would not be let in any
    /// more. Gives those that were ended.
    ///
    /// Checks the certificate of every connection, so not for an async task.
    pub fn set_trust(&self, lists: TrustLists) -> Vec<DisconnectedConnection> {
        self.gate.0.set_trust(lists)
    }

    /// False once the server has ended by itself.
    pub fn is_running(&self) -> bool {
        !self.server.is_finished() && !self.clients.is_finished()
    }

    /// Closes every connection and the port. Takes at most a few seconds, also with clients that do not react.
    pub async fn stop(mut self) {
        self.handle.cancel();
        // Clients that listen are told why they are disconnected; the others are cut off.
        let told = ended(&mut self.server, SHUTDOWN_MESSAGE_LIMIT).await;
        self.clients.abort();
        ended(&mut self.clients, STOP_TIMEOUT).await;
        if !told && !ended(&mut self.server, STOP_TIMEOUT).await {
            tracing::warn!(endpoint = self.endpoint(), "OPC UA server did not stop in time");
            self.server.abort();
        }
        tracing::info!(endpoint = self.endpoint(), "OPC UA server stopped");
        self.events.tell(ServerEvent::Stopped { endpoint: &self.endpoint() });
    }
}

impl Drop for OpcUaServer {
    fn drop(&mut self) {
        self.handle.cancel();
        self.clients.abort();
    }
}

impl fmt::Debug for OpcUaServer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("OpcUaServer").field("endpoint", &self.endpoint()).finish_non_exhaustive()
    }
}

/// The crate stores its port when it begins to accept, without a notification.
async fn ready(
    server: &mut JoinHandle<Result<(), String>>,
    handle: &ServerHandle,
    port: u16,
) -> Result<(), StartError> {
    while handle.info().port.load(Ordering::Relaxed) != port {
        if server.is_finished() {
            return Err(match server.await {
                Ok(Err(reason)) => StartError::Failed(Cause::told(reason)),
                Ok(Ok(())) => StartError::Failed(Cause::finding("it ended at once")),
                Err(e) => failed(e),
            });
        }
        tokio::time::sleep(POLL).await;
    }
    Ok(())
}

/// Whether a task has ended, or ends within the time given.
async fn ended<T>(task: &mut JoinHandle<T>, within: Duration) -> bool {
    // A task that has ended may have been awaited already and must not be again.
    task.is_finished() || tokio::time::timeout(within, task).await.is_ok()
}

/// On Unix tokio sets `SO_REUSEADDR`, so connections of an earlier run that still linger do not hold the port, while
/// another listener does.
async fn listen(address: IpAddr, port: u16) -> Result<TcpListener, StartError> {
    TcpListener::bind((address, port)).await.map_err(|e| match e.kind() {
        io::ErrorKind::AddrInUse => StartError::PortInUse(port),
        io::ErrorKind::AddrNotAvailable | io::ErrorKind::PermissionDenied => {
            InvalidParameter::Address { address: SocketAddr::new(address, port), cause: Cause::new(e) }.into()
        }
        _ => failed(e),
    })
}

fn build(config: &OpcUaConfig, address: SocketAddr) -> Result<(Server, ServerHandle, Attached), StartError> {
    let key = config.check()?;
    let description = config.cell.description();
    let types = Types::of(description.controller.generation(), description.virtual_io).map_err(failed)?;
    let pki = PkiFolder::create(config.pki_folder.clone()).map_err(failed)?;
    let pem = key.to_pkcs8_pem(LineEnding::LF).map_err(failed)?;
    pki.write_own(&config.certificate_der, &pem).map_err(failed)?;
    let own = ServerKeyPair::new(&config.certificate_der, &pem).map_err(StartError::from)?;
    let gate = Arc::new(Gate::new(
        GateSettings::new(config.policies.clone(), config.detailed_status),
        InnerServer::default(),
        own,
        ClientVerifier::new(config.trust.clone(), config.trust_policy, config.clock.clone()),
        pki,
        AdmissionReporter::new(config.events.clone(), config.refusals.clone()),
    ));
    let (server, handle) = builder(config, address, key.size() * 8, types, &gate).build().map_err(told)?;
    let attached = gate.attach(handle.clone());
    gate.pki().close_rejected().map_err(failed)?;
    if handle.info().server_pkey.is_none() || handle.info().server_certificate.is_none() {
        return Err(InvalidParameter::CertificateOrKey.into());
    }
    Ok((server, handle, attached))
}

fn builder(
    config: &OpcUaConfig,
    address: SocketAddr,
    key_bits: usize,
    types: Types,
    gate: &Arc<Gate>,
) -> ServerBuilder {
    let cell = config.cell.clone();
    let firmware = cell.description().controller.firmware;
    let of_channel = gate.clone();
    let longest_response = Box::new(move |channel| of_channel.longest_response(channel));
    let controller = move |context: ServerContext| ControllerNodes::new(&context, types, cell, longest_response);
    let tokens = UserTokens::new(config.user_tokens.clone());
    let mut builder = ServerBuilder::new()
        // The controller's nodes before the standard ones: that gives them namespace 1. The crate's diagnostics want
        // the same namespace and are left out.
        .without_node_managers()
        .with_node_manager(GuardedNodeManager::builder(controller, gate.clone()))
        .with_node_manager(GuardedNodeManager::builder(
            InMemoryNodeManagerBuilder::new(CoreNodeManagerBuilder),
            gate.clone(),
        ))
        .with_authenticator(Arc::new(Users::new(tokens, &config.users, gate.clone(), config.events.clone())))
        .application_name(&config.application_name)
        .application_uri(&config.application_uri)
        .product_uri(PRODUCT_URI)
        .build_info(BuildInfo {
            product_uri: PRODUCT_URI.into(),
            manufacturer_name: env!("CARGO_PKG_NAME").into(),
            product_name: "Virtual controller".into(),
            software_version: firmware.to_string().into(),
            build_number: env!("CARGO_PKG_VERSION").into(),
            ..Default::default()
        })
        .host(host(address.ip()))
        .port(address.port())
        .discovery_urls(vec![format!("{}/", endpoint(address))])
        .pki_dir(gate.pki().root())
        .certificate_path(OWN_CERTIFICATE)
        .private_key_path(gate.pki().key_file())
        .create_sample_keypair(false)
        .trust_client_certs(false)
        // The gate has looked at it, by the controller's clock.
        .check_cert_time(false)
        .limits(endpoints::limits())
        .hello_timeout(endpoints::HELLO_TIMEOUT_SECS)
        .subscription_poll_interval_ms(endpoints::SUBSCRIPTION_TICK_MS)
        .max_session_timeout_ms(endpoints::SESSION_TIMEOUT_MS)
        .max_secure_channel_token_lifetime_ms(endpoints::TOKEN_LIFETIME_MS);
    for (id, endpoint) in endpoints::endpoints(&config.policies, key_bits) {
        builder = builder.add_endpoint(id, endpoint);
    }
    builder
}

fn endpoint(address: SocketAddr) -> String {
    format!("opc.tcp://{}:{}", host(address.ip()), address.port())
}

/// As it stands in a URL.
fn host(address: IpAddr) -> String {
    match address {
        IpAddr::V4(v4) => v4.to_string(),
        IpAddr::V6(v6) => format!("[{v6}]"),
    }
}

fn failed(error: impl Error + Send + Sync + 'static) -> StartError {
    StartError::Failed(Cause::new(error))
}

/// The OPC UA library tells its errors as texts.
fn told(error: String) -> StartError {
    StartError::Failed(Cause::told(error))
}

const PRODUCT_URI: &str = "urn:opcua-configurator:virtual-controller";
const START_TIMEOUT: Duration = Duration::from_secs(10);
const SHUTDOWN_MESSAGE_LIMIT: Duration = Duration::from_secs(1);
const STOP_TIMEOUT: Duration = Duration::from_secs(3);
const POLL: Duration = Duration::from_millis(2);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ipv6_address_stands_in_brackets() {
        assert_eq!(endpoint("[::1]:4840".parse().unwrap()), "opc.tcp://[::1]:4840");
        assert_eq!(endpoint("192.168.0.1:4840".parse().unwrap()), "opc.tcp://192.168.0.1:4840");
    }
}
