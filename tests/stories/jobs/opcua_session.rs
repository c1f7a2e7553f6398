//! A session that stays open with a controller's OPC UA server.

use std::time::Duration;

use opcua_configurator::jobs::{
    SelfSigned, SelfSignedFields, SetSettings, SettingsChange, StartServer, StopServer, Verify,
};
use opcua_configurator::model::opcua::{NodeId, QualifiedName, Value};
use opcua_configurator::model::{KeyLength, SecurityPolicy, UserTokenPolicy, Validity};
use opcua_configurator::session::opcua_client::{
    ClientSession, ConnectTimeouts, Failure, Login, OpcUaClient, Stage, SubscriptionIntervals, Target,
};
use opcua_configurator::virtual_controller::FleetFirmware;
use opcua_configurator::workspace::Workspace;

use crate::common::plant::Plant;

const LIMIT: Duration = Duration::from_secs(60);
const CURRENT_TIME: NodeId = NodeId::numeric(0, 2258);
const STATE: NodeId = NodeId::numeric(0, 2259);

struct Server {
    plant: Plant,
    folder: tempfile::TempDir,
}

impl Server {
    /// A running server that trusts this program and lets everybody log in.
    async fn running() -> Self {
        let server =
            Self { plant: Plant::start(1, FleetFirmware::Current).await, folder: tempfile::tempdir().unwrap() };
        let change = SettingsChange {
            security_policies: Some([SecurityPolicy::Basic256Sha256].into()),
            user_tokens: Some([UserTokenPolicy::Anonymous].into()),
            ..SettingsChange::default()
        };
        server.run(SetSettings { change, ..SetSettings::default() }).await;
        let fields = SelfSignedFields {
            common_name: None,
            country: "JP".into(),
            state: "Nagano".into(),
            locality: "Suwa".into(),
            organisation: "Example".into(),
            key_length: KeyLength::Rsa2048,
            validity: Validity::try_from(1).unwrap(),
        };
        server.run(SelfSigned { fields, backup: None }).await;
        server.run(StartServer).await;
        let trust_first = Verify {
            identity: Workspace::new(server.folder.path()).own_identity(),
            login: None,
            trust_first: true,
            patience: ConnectTimeouts::default(),
        };
        server.run(trust_first).await;
        server
    }

    async fn run(&self, operation: impl opcua_configurator::jobs::Operation + 'static) {
        for report in self.plant.run(operation).await {
            assert!(report.result.is_ok(), "{report:?}");
        }
    }

    async fn connect(&self) -> Result<ClientSession, Failure> {
        let identity = Workspace::new(self.folder.path()).own_identity().load_or_make(chrono::Utc::now()).unwrap();
        let client = OpcUaClient::new(&identity, ConnectTimeouts::default()).unwrap();
        let port = self.plant.controller(0).state().settings.port.get();
        let target = Target { host: "127.0.0.1".into(), port };
        let endpoints = client.endpoints(&target).await?;
        let endpoint = endpoints.last().expect("an endpoint");
        let certificate = endpoint.certificates().expect("a certificate").0;
        client.session(&target, endpoint, &certificate, &Login::Anonymous).await
    }
}

async fn within<T>(future: impl Future<Output = T>) -> T {
    tokio::time::timeout(LIMIT, future).await.expect("in time")
}

#[tokio::test(flavor = "multi_thread")]
async fn values_are_read_browsed_written_and_watched_until_the_server_stops() {
    let server = Server::running().await;
    let session = within(server.connect()).await.unwrap();

    let values = within(session.read(&[STATE, CURRENT_TIME, NodeId::numeric(7, 7)])).await.unwrap();
    assert_eq!(values[0].value, Value::Int32(0));
    assert!(matches!(values[1].value, Value::DateTime(Some(_))), "{values:?}");
    assert_eq!(values[2].quality.name(), "BadNodeIdUnknown");
    assert!(within(session.namespaces()).await.unwrap().iter().any(|uri| uri == "http://opcfoundation.org/UA/DI/"));

    let objects = within(session.children(&NodeId::OBJECTS_FOLDER)).await.unwrap();
    let server_node = objects.iter().find(|child| child.browse_name.name == "Server").expect("the Server object");
    let path = ["Server", "ServerStatus", "State"].map(|name| QualifiedName::new(0, name));
    assert_eq!(within(session.node_at(&NodeId::OBJECTS_FOLDER, &path)).await.unwrap(), Some(STATE));
    let nowhere = [QualifiedName::new(0, "Nowhere")];
    assert_eq!(within(session.node_at(&server_node.node, &nowhere)).await.unwrap(), None);
    let attributes = within(session.attributes(&STATE)).await.unwrap();
    assert!(attributes.iter().any(|(name, value)| *name == "BrowseName" && value.value.to_string() == "State"));
    assert!(attributes.iter().all(|(name, _)| *name != "Executable"), "no method");

    let written = within(session.write(&[(STATE, Value::Int32(1))])).await.unwrap();
    assert!(written[0].is_bad(), "{written:?}");

    let intervals = SubscriptionIntervals { publishing: Duration::from_millis(100), ..Default::default() };
    let mut subscription = within(session.subscribe(&[CURRENT_TIME, NodeId::numeric(7, 7)], intervals)).await.unwrap();
    assert_eq!(subscription.accepted()[1].name(), "BadNodeIdUnknown");
    let mut seen = Vec::new();
    while seen.len() < 3 {
        for (index, value) in within(subscription.next()).await.unwrap() {
            assert_eq!(index, 0);
            seen.push(value.value);
        }
    }
    assert!(seen.windows(2).all(|pair| pair[0] != pair[1]), "{seen:?}");

    server.run(StopServer).await;
    within(async { while subscription.next().await.is_ok() {} }).await;
    let failure = within(session.ended()).await;
    assert_eq!(within(session.read_one(&STATE)).await.unwrap_err().cause, failure.cause);
    within(session.close()).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_server_with_another_certificate_gets_no_session() {
    let server = Server::running().await;
    let identity = Workspace::new(server.folder.path()).own_identity().load_or_make(chrono::Utc::now()).unwrap();
    let client = OpcUaClient::new(&identity, ConnectTimeouts::default()).unwrap();
    let target = Target { host: "127.0.0.1".into(), port: server.plant.controller(0).state().settings.port.get() };
    let endpoints = client.endpoints(&target).await.unwrap();
    let failure = within(client.session(&target, &endpoints[0], &identity.certificate, &Login::Anonymous)).await;
    assert_eq!(failure.unwrap_err().stage, Stage::Channel);
    within(server.connect()).await.unwrap().close().await;
}
