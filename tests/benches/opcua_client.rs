//! An OPC UA client for benches that compare servers.

use std::fs;
use std::net::{IpAddr, Ipv4Addr};
use std::path::Path;
use std::sync::Arc;

use chrono::{TimeDelta, Utc};
use opcua::client::{ClientBuilder, IdentityToken, Session};
use opcua::crypto::SecurityPolicy as WirePolicy;
use opcua::types::{
    BrowseDescription, BrowseDirection, BrowseResultMask, DataValue, EndpointDescription, MessageSecurityMode, NodeId,
    ReadValueId, ReferenceDescription, StatusCode, TimestampsToReturn,
};
use opcua_configurator::model::{KeyLength, SelfSignedRequest, Subject, Validity};
use opcua_configurator::pki::{Certificate, PrivateKey, ServerNames, self_signed};
use rsa::RsaPrivateKey;
use rsa::pkcs8::{DecodePrivateKey as _, EncodePrivateKey as _, LineEnding};
use tokio::task::JoinHandle;

/// What is measured: without security, and with the usual one.
pub const MODES: [(WirePolicy, MessageSecurityMode); 2] =
    [(WirePolicy::None, MessageSecurityMode::None), (WirePolicy::Basic256Sha256, MessageSecurityMode::SignAndEncrypt)];

pub type Failure = Box<dyn std::error::Error + Send + Sync>;

/// An application's key and certificate.
pub struct TestApplication {
    pub name: &'static str,
    pub key: PrivateKey,
    pub certificate: Certificate,
}

impl TestApplication {
    /// With the application URI `urn:<name>`.
    pub fn new(name: &'static str) -> Result<Self, Failure> {
        let subject = Subject {
            common_name: name.to_owned(),
            country: String::new(),
            state: String::new(),
            locality: String::new(),
            organisation: String::new(),
        };
        let request = SelfSignedRequest { subject, key_length: KeyLength::Rsa2048, validity: Validity::try_from(1)? };
        let names = ServerNames {
            application_uri: format!("urn:{name}"),
            ips: vec![IpAddr::V4(Ipv4Addr::LOCALHOST)],
            dns: Vec::new(),
        };
        let key = PrivateKey::generate(KeyLength::Rsa2048)?;
        let certificate = self_signed(&request, &names, &key, Utc::now() - TimeDelta::hours(1))?;
        Ok(Self { name, key, certificate })
    }

    /// Writes `own.der`, `own.crt` (PEM) and `own.pem` (the key).
    pub fn write(&self, folder: &Path) -> Result<(), Failure> {
        fs::create_dir_all(folder)?;
        fs::write(folder.join("own.der"), self.certificate.der())?;
        fs::write(folder.join("own.crt"), self.certificate.to_pem())?;
        let key = RsaPrivateKey::from_pkcs8_der(&self.key.to_pkcs8_der()?)?;
        fs::write(folder.join("own.pem"), key.to_pkcs8_pem(LineEnding::LF)?.as_bytes())?;
        Ok(())
    }
}

/// A connected client with an anonymous session.
pub struct Client {
    session: Arc<Session>,
    events: JoinHandle<StatusCode>,
    _folder: tempfile::TempDir,
}

impl Client {
    /// Without a check of the server's certificate.
    pub async fn connect(endpoint: EndpointDescription, client: &TestApplication) -> Result<Self, Failure> {
        let folder = tempfile::tempdir()?;
        client.write(folder.path())?;
        let mut dialling = application(client, folder.path())?;
        let url = endpoint.endpoint_url.to_string();
        let (session, events) = dialling.connect_to_endpoint_directly(endpoint, IdentityToken::Anonymous)?;
        let mut events = events.spawn();
        tokio::select! {
            _ = session.wait_for_connection() => Ok(Self { session, events, _folder: folder }),
            status = &mut events => Err(format!("not connected to {url}: {}", status?).into()),
        }
    }

    /// Reads the nodes in one request; each has to have a value.
    pub async fn read(&self, nodes: &[ReadValueId]) -> Result<Vec<DataValue>, Failure> {
        let values = self.read_any(nodes).await?;
        let are_there = values.len() == nodes.len()
            && values.iter().all(|value| value.value.is_some() && value.status.is_none_or(|status| status.is_good()));
        if are_there { Ok(values) } else { Err("a value was not read".into()) }
    }

    /// Reads the nodes in one request; some may have no value.
    pub async fn read_any(&self, nodes: &[ReadValueId]) -> Result<Vec<DataValue>, Failure> {
        Ok(self.session.read(nodes, TimestampsToReturn::Both, 0.0).await?)
    }

    /// What the nodes refer to, forward.
    pub async fn references(&self, nodes: &[NodeId]) -> Result<Vec<ReferenceDescription>, Failure> {
        let requests: Vec<BrowseDescription> = nodes
            .iter()
            .map(|node| BrowseDescription {
                node_id: node.clone(),
                browse_direction: BrowseDirection::Forward,
                reference_type_id: NodeId::null(),
                include_subtypes: true,
                node_class_mask: 0,
                result_mask: BrowseResultMask::All as u32,
            })
            .collect();
        let mut found = Vec::new();
        let mut results = self.session.browse(&requests, 0, None).await?;
        while !results.is_empty() {
            let mut unfinished = Vec::new();
            for result in results {
                found.extend(result.references.into_iter().flatten());
                if !result.continuation_point.is_null() {
                    unfinished.push(result.continuation_point);
                }
            }
            results = match unfinished[..] {
                [] => Vec::new(),
                _ => self.session.browse_next(false, &unfinished).await?,
            };
        }
        Ok(found)
    }

    pub async fn close(self) {
        let _ = self.session.disconnect().await;
        let _ = self.events.await;
    }
}

/// The endpoint that a server offers for a policy, at the address that it was asked at.
pub async fn offered_endpoint(
    url: &str,
    policy: WirePolicy,
    mode: MessageSecurityMode,
    client: &TestApplication,
) -> Result<EndpointDescription, Failure> {
    let folder = tempfile::tempdir()?;
    client.write(folder.path())?;
    let endpoints = application(client, folder.path())?.get_server_endpoints_from_url(url).await?;
    let offered = endpoints
        .into_iter()
        .find(|endpoint| endpoint.security_mode == mode && endpoint.security_policy_uri.as_ref() == policy.to_uri());
    let offered = offered.ok_or_else(|| format!("{url} does not offer {}", policy.to_str()))?;
    Ok(EndpointDescription { endpoint_url: url.into(), ..offered })
}

/// A motion log's `Data` node has half a megabyte, more than the library takes by itself.
const MAX_BYTES: usize = 16 << 20;

fn application(client: &TestApplication, folder: &Path) -> Result<opcua::client::Client, Failure> {
    let client = ClientBuilder::new()
        .application_name(client.name)
        .application_uri(format!("urn:{}", client.name))
        .product_uri(client.name)
        .pki_dir(folder)
        .certificate_path("own.der")
        .private_key_path("own.pem")
        .trust_server_certs(true)
        .verify_server_certs(false)
        .session_retry_limit(0)
        .max_message_size(MAX_BYTES)
        .max_byte_string_length(MAX_BYTES)
        .max_chunk_count(MAX_BYTES / 8192)
        .max_array_length(100_000)
        .client()
        .map_err(|errors| errors.join(", "))?;
    Ok(client)
}
