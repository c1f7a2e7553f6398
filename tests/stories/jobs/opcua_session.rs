//! A session that stays open with a controller's OPC UA server.

use std::time::Duration;

use opcua_configurator::jobs::{
    AddUser, BasicSettingsChange, SelfSigned, SelfSignedFields, SetBasicSettings, StartServer, StopServer,
    TrustConfigurator,
};
use opcua_configurator::model::opcua::{NodeId, QualifiedName, Value};
use opcua_configurator::model::{
    Credentials, ErrorCode, KeyLength, Problem, SecurityPolicy, UserCredential, UserPassword, UserTokenPolicy, Validity,
};
use opcua_configurator::pki::Certificate;
use opcua_configurator::session::Connector as _;
use opcua_configurator::session::opcua_client::{
    ClientSession, ConnectTimeouts, ControllerServer, OpcUaClient, ServerLocation, SubscriptionIntervals, UserLogin,
};
use opcua_configurator::virtual_controller::FleetFirmware;
use opcua_configurator::workspace::Workspace;

use crate::common::test_fleet::{self, TestFleet};

const LIMIT: Duration = Duration::from_secs(60);
const CURRENT_TIME: NodeId = NodeId::numeric(0, 2258);
const STATE: NodeId = NodeId::numeric(0, 2259);

struct Server {
    fleet: TestFleet,
    folder: tempfile::TempDir,
}

impl Server {
    /// A running server that trusts this program and takes anonymous clients.
    async fn running() -> Self {
        let server = Self::stopped([UserTokenPolicy::Anonymous]).await;
        server.run(StartServer).await;
        server.trust().await;
        server
    }

    /// A server with a certificate, one policy and one user.
    async fn stopped(user_tokens: impl IntoIterator<Item = UserTokenPolicy>) -> Self {
        let server =
            Self { fleet: TestFleet::start(1, FleetFirmware::Current).await, folder: tempfile::tempdir().unwrap() };
        let change = BasicSettingsChange {
            security_policies: Some([SecurityPolicy::Basic256Sha256].into()),
            user_tokens: Some(user_tokens.into_iter().collect()),
            ..BasicSettingsChange::default()
        };
        server.run(SetBasicSettings { change, ..SetBasicSettings::default() }).await;
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
        let credential =
            UserCredential { name: "operator1".parse().unwrap(), password: UserPassword::new("Passw0rd1").unwrap() };
        server.run(AddUser { credential, based_on: None }).await;
        server
    }

    async fn trust(&self) {
        self.run(TrustConfigurator { identity: Workspace::new(self.folder.path()).own_identity() }).await;
    }

    async fn run(&self, operation: impl opcua_configurator::jobs::Operation + 'static) {
        for report in self.fleet.run(operation).await {
            assert!(report.result.is_ok(), "{report:?}");
        }
    }

    async fn connect(&self, login: &UserLogin) -> Result<ClientSession, Problem> {
        let server = self.find().await?;
        Ok(server.connect(&self.client(), login).await?)
    }

    /// The certificate of this program.
    fn client_certificate(&self) -> Certificate {
        Workspace::new(self.folder.path()).own_identity().load_or_make(chrono::Utc::now()).unwrap().certificate
    }

    fn client(&self) -> OpcUaClient {
        let identity = Workspace::new(self.folder.path()).own_identity().load_or_make(chrono::Utc::now()).unwrap();
        OpcUaClient::new(&identity, ConnectTimeouts::default()).unwrap()
    }

    /// The server, as the controller describes it.
    async fn find(&self) -> Result<ControllerServer, Problem> {
        let controller = self.fleet.listed().remove(0);
        let (fingerprint, host) = (controller.fingerprint.unwrap(), controller.address.host().to_owned());
        let password = Credentials::ConnectionPassword(test_fleet::PASSWORD.into());
        let mut session = self.fleet.connector.connect(&controller.address, fingerprint, &password).await?;
        let found = ControllerServer::find(session.as_mut(), &host).await;
        session.close().await;
        found
    }
}

fn user(password: &str) -> UserLogin {
    UserLogin::User { name: "operator1".into(), password: password.into() }
}

async fn within<T>(future: impl Future<Output = T>) -> T {
    tokio::time::timeout(LIMIT, future).await.expect("in time")
}

#[tokio::test(flavor = "multi_thread")]
async fn values_are_read_browsed_written_and_watched_until_the_server_stops() {
    let server = Server::running().await;
    let session = within(server.connect(&UserLogin::Anonymous)).await.unwrap();

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
async fn every_reason_for_no_session_has_its_own_error() {
    let server = Server::stopped(UserTokenPolicy::ALL).await;
    let refused = async |login: &UserLogin| within(server.connect(login)).await.map(|_| ()).unwrap_err().code;
    assert_eq!(refused(&UserLogin::Anonymous).await, ErrorCode::ServerNotRunning);
    server.run(StartServer).await;
    assert_eq!(refused(&UserLogin::Anonymous).await, ErrorCode::ConfiguratorNotTrusted);
    server.trust().await;
    assert_eq!(refused(&user("Wr0ngPassword")).await, ErrorCode::OpcUaLoginRefused);
    within(server.connect(&user("Passw0rd1"))).await.unwrap().close().await;

    let found = server.find().await.unwrap();
    let other = ControllerServer { certificate: server.client_certificate(), ..found.clone() };
    let refused = within(other.connect(&server.client(), &UserLogin::Anonymous)).await.unwrap_err();
    assert_eq!(Problem::from(refused).code, ErrorCode::NoSuitableEndpoint);
    let closed = ServerLocation { port: 1, ..found.target };
    let refused = ControllerServer { target: closed, ..found }.connect(&server.client(), &UserLogin::Anonymous).await;
    assert_eq!(Problem::from(refused.unwrap_err()).code, ErrorCode::OpcUaConnectionFailed);
}
