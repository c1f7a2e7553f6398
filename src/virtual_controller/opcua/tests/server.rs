use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::time::Instant;

use opcua::client::ClientBuilder;
use opcua::types::{MessageSecurityMode, NodeId, ObjectId, StatusCode, VariableId, Variant, WriteValue};

use super::*;

fn string(value: Variant) -> String {
    match value {
        Variant::String(text) => text.to_string(),
        Variant::LocalizedText(text) => text.text.to_string(),
        other => panic!("{other:?} is not text"),
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn it_starts_again_on_the_same_port_after_a_stop_with_clients_connected() {
    let folder = tempfile::tempdir().unwrap();
    let server = start(config(&folder)).await;
    let port = server.port();
    assert_eq!(server.endpoint(), format!("opc.tcp://127.0.0.1:{port}"));
    for _ in 0..2 {
        let server = start(OpcUaConfig { port: 0, ..config(&tempfile::tempdir().unwrap()) }).await;
        assert_ne!(server.port(), port);
        server.stop().await;
    }
    let client = Client::anonymous(&server).await.unwrap();
    let silent = tokio::net::TcpStream::connect(("127.0.0.1", port)).await.unwrap();
    assert!(server.is_running());
    let stopping = Instant::now();
    server.stop().await;
    assert!(stopping.elapsed() < Duration::from_secs(20), "took {:?}", stopping.elapsed());
    drop((client, silent));
    assert!(tokio::net::TcpStream::connect(("127.0.0.1", port)).await.is_err());

    let server = start(OpcUaConfig { port, ..config(&folder) }).await;
    assert_eq!(server.port(), port);
    Client::anonymous(&server).await.unwrap().close().await;
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_port_in_use_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port();
    let error = OpcUaServer::start(OpcUaConfig { port, ..config(&folder) }).await.unwrap_err();
    assert_eq!(error, StartError::PortInUse(port));
}

#[tokio::test(flavor = "multi_thread")]
async fn what_cannot_work_is_refused_and_frees_the_port() {
    let folder = tempfile::tempdir().unwrap();
    let good = config(&folder);
    let port = {
        let server = start(good.clone()).await;
        let port = server.port();
        server.stop().await;
        port
    };
    let other_key = Zeroizing::new(CLIENT.key.serialize_der());
    let user = OpcUaUser { name: "operator1".to_owned(), password_hash: "$argon2i$nonsense".to_owned() };
    for bad in [
        OpcUaConfig { policies: BTreeSet::new(), ..good.clone() },
        OpcUaConfig { user_tokens: BTreeSet::new(), ..good.clone() },
        OpcUaConfig { certificate_der: b"no certificate".to_vec(), ..good.clone() },
        OpcUaConfig { private_key_pkcs8: Zeroizing::new(b"no key".to_vec()), ..good.clone() },
        OpcUaConfig { private_key_pkcs8: other_key, ..good.clone() },
        OpcUaConfig { users: vec![user], ..good.clone() },
        OpcUaConfig { bind: Ipv4Addr::new(192, 0, 2, 1).into(), ..good.clone() },
    ] {
        let error = OpcUaServer::start(OpcUaConfig { port, ..bad }).await.unwrap_err();
        assert!(matches!(error, StartError::InvalidParameter(_)), "{error}");
    }
    start(OpcUaConfig { port, ..good }).await.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn namespace_1_is_the_servers_own_and_the_controller_lies_in_the_device_set() {
    let folder = tempfile::tempdir().unwrap();
    let server = start(config(&folder)).await;
    let client = Client::anonymous(&server).await.unwrap();

    let Variant::Array(namespaces) = client.read(VariableId::Server_NamespaceArray).await else { panic!("no array") };
    let namespaces: Vec<String> = namespaces.values.into_iter().map(string).collect();
    assert_eq!(
        namespaces,
        [
            "http://opcfoundation.org/UA/",
            URI,
            "http://opcfoundation.org/UA/DI/",
            "http://opcfoundation.org/UA/Robotics/"
        ]
    );

    let objects = client.browse(ObjectId::ObjectsFolder).await;
    let device_set = NodeId::new(2, 5001u32);
    assert!(objects.contains(&("DeviceSet".to_owned(), device_set.clone())), "{objects:?}");
    let below = async |id: NodeId, name: &str| {
        let children = client.browse(id).await;
        let found = children.iter().find(|(known, _)| known == name).map(|(_, id)| id.clone());
        found.unwrap_or_else(|| panic!("no {name} in {children:?}"))
    };
    let system = below(device_set, "MotionDeviceSystem_0").await;
    let controller = below(below(system, "Controllers").await, "Controller_0").await;
    for (name, value) in [
        ("Manufacturer", "Seiko Epson Corporation"),
        ("Model", "RC800"),
        ("SerialNumber", "SN0000123"),
        ("ComponentName", "Weld 1"),
    ] {
        assert_eq!(string(client.read(below(controller.clone(), name).await).await), value, "{name}");
    }
    let software = below(below(controller.clone(), "Software").await, "Software_0").await;
    assert_eq!(string(client.read(below(software, "SoftwareRevision").await).await), "8.0.1");

    let write = WriteValue::value_attr(below(controller, "SerialNumber").await, "SN2".into());
    let results = timeout(WAIT_LIMIT, client.session.write(&[write])).await.unwrap().unwrap();
    assert_eq!(results, [StatusCode::BadNotWritable]);

    client.close().await;
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_user_is_let_in_with_the_right_password_only() {
    let folder = tempfile::tempdir().unwrap();
    let user = |name: &str| OpcUaUser { name: name.to_owned(), password_hash: hash_password("Passw0rd").unwrap() };
    let told = EventLines::default();
    let server = start(OpcUaConfig {
        user_tokens: BTreeSet::from([UserTokenPolicy::UserName]),
        users: vec![user("operator1"), user("operator2")],
        events: told.events(),
        ..config(&folder)
    })
    .await;

    assert_eq!(Client::log_in(&server, "operator1", "Passw0rd").await, Ok(()));
    assert_eq!(Client::log_in(&server, "nobody00", "Passw0rd").await, Err(StatusCode::BadUserAccessDenied));
    assert!(Client::anonymous(&server).await.is_err());
    for _ in 0..5 {
        assert_eq!(Client::log_in(&server, "operator1", "passw0rd").await, Err(StatusCode::BadUserAccessDenied));
    }
    let asked = Instant::now();
    assert_eq!(Client::log_in(&server, "operator1", "Passw0rd").await, Ok(()));
    assert!(asked.elapsed() >= Duration::from_secs(1), "slowed down: {:?}", asked.elapsed());
    assert_eq!(Client::log_in(&server, "operator2", "Passw0rd").await, Ok(()));
    server.stop().await;
    let told = told.lines();
    for line in [
        "server started: opc.tcp://127.0.0.1:",
        "session of operator1 activated: ",
        "session of an anonymous or unknown user refused: no such user, from 127.0.0.1:",
        "session of operator1 refused: wrong password, from 127.0.0.1:",
        "server stopped: ",
    ] {
        assert!(told.contains(line), "{line}\n{told}");
    }
    assert!(!told.contains("nobody00") && !told.contains("assw0rd"), "{told}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_password_is_encrypted_where_the_channel_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let server = start(OpcUaConfig { policies: BTreeSet::from([SecurityPolicy::None]), ..config(&folder) }).await;
    let client = ClientBuilder::new().application_name("c").application_uri("urn:c").product_uri("urn:c");
    let client = client.pki_dir(folder.path().join("client")).client().unwrap();
    let endpoints =
        timeout(WAIT_LIMIT, client.get_server_endpoints_from_url(server.endpoint())).await.unwrap().unwrap();
    assert_eq!(endpoints.len(), 1);
    assert_eq!(endpoints[0].endpoint_url.as_ref(), format!("{}/", server.endpoint()));
    let tokens = endpoints[0].user_identity_tokens.clone().unwrap();
    let password = tokens.iter().find(|t| t.token_type == opcua::types::UserTokenType::UserName).unwrap();
    assert_eq!(password.security_policy_uri.as_ref(), "http://opcfoundation.org/UA/SecurityPolicy#Basic256Sha256");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn trust_in_a_client_changes_while_the_server_runs() {
    let folder = tempfile::tempdir().unwrap();
    let server = start(config(&folder)).await;
    assert_eq!(Client::encrypted(&server).await.err(), Some(StatusCode::BadSecurityChecksFailed));

    assert_eq!(server.set_trust(trusting(&[&CLIENT])), []);
    Client::encrypted(&server).await.unwrap().close().await;

    server.set_trust(trusting(&[&SERVER]));
    assert_eq!(Client::encrypted(&server).await.err(), Some(StatusCode::BadSecurityChecksFailed));
    server.stop().await;

    let server = start(OpcUaConfig { trust: trusting(&[&CLIENT]), ..config(&folder) }).await;
    for policy in SecurityPolicy::ALL {
        let mode = match policy {
            SecurityPolicy::None => MessageSecurityMode::None,
            _ => MessageSecurityMode::SignAndEncrypt,
        };
        let client = ClientOptions { policy, mode, ..ClientOptions::new(&server) }.connect().await;
        client.unwrap_or_else(|e| panic!("{policy}: {e}")).close().await;
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_key_lies_on_disk_while_the_server_runs_and_what_strangers_send_never_does() {
    let folder = tempfile::tempdir().unwrap();
    let server = start(config(&folder)).await;
    assert!(Client::encrypted(&server).await.is_err());
    let files = |path: &Path| -> BTreeSet<String> {
        fs::read_dir(path).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect()
    };
    let pki = folder.path().join("pki");
    let key = files(&pki).into_iter().find(|name| name.ends_with(".pem")).unwrap();
    assert_eq!(files(&pki), ["own.der", &key, "rejected", "trusted"].map(str::to_owned).into());
    assert_eq!(files(&pki.join("trusted")), BTreeSet::new());
    assert!(pki.join("rejected").is_file());
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        assert_eq!(fs::metadata(&pki).unwrap().permissions().mode() & 0o777, 0o700);
        assert_eq!(fs::metadata(pki.join(&key)).unwrap().permissions().mode() & 0o777, 0o600);
    }
    server.stop().await;
    assert!(!pki.join(&key).exists());
}

#[test]
fn debug_output_holds_no_secret() {
    let folder = tempfile::tempdir().unwrap();
    let user = OpcUaUser { name: "operator1".to_owned(), password_hash: "$argon2id$secret".to_owned() };
    let text = format!("{:?}", OpcUaConfig { users: vec![user], ..config(&folder) });
    assert!(text.contains("operator1") && !text.contains("argon2id") && !text.contains("private_key"), "{text}");
}
