use std::collections::BTreeSet;

use opcua::client::IdentityToken;
use opcua::types::{StatusCode, VariableId};

use super::impersonating_proxy::ImpersonatingProxy;
use super::*;
use crate::model::CertificateStatus;
use crate::pki::CertificateFlaw;

const TIME: VariableId = VariableId::Server_ServerStatus_CurrentTime;

/// Connected or not, it gets nothing.
async fn gets_nothing(dial: ClientOptions<'_>) {
    if let Ok(client) = dial.connect().await {
        assert!(client.try_read(TIME).await.is_err());
        assert!(timeout(WAIT_LIMIT, client.events).await.is_ok(), "the connection is still open");
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_session_under_another_certificate_than_its_channel_ends_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let told = EventLines::default();
    let other = TestApplication::new("other");
    let trust = trusting(&[&CLIENT, &other]);
    let server = start(OpcUaConfig { trust, events: told.events(), ..config(&folder) }).await;
    // The crate has both certificates in its folder now.
    for identity in [&*CLIENT, &other] {
        ClientOptions::new(&server).identity(identity).connect().await.unwrap().close().await;
    }
    let disguise = ImpersonatingProxy::start(&server, &CLIENT, &other, &[]).await;
    gets_nothing(ClientOptions { through: Some(disguise.url.clone()), ..ClientOptions::new(&server) }).await;
    told.wait_for("opened with another certificate").await;

    // The disguise is not what it fails by.
    let honest = ImpersonatingProxy::start(&server, &CLIENT, &CLIENT, &[]).await;
    let client =
        ClientOptions { through: Some(honest.url.clone()), ..ClientOptions::new(&server) }.connect().await.unwrap();
    assert!(client.is_served().await);
    client.close().await;
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_client_that_gives_another_application_uri_than_its_certificate_is_cut_off_and_listed() {
    let folder = tempfile::tempdir().unwrap();
    let recorded = Arc::new(RecordedRejections::default());
    let refusals: Arc<dyn RejectionRecorder> = recorded.clone();
    let trust = trusting(&[&CLIENT]);
    let server = start(OpcUaConfig { trust, refusals: Some(refusals), ..config(&folder) }).await;
    gets_nothing(ClientOptions { application_uri: "urn:somebody:else".to_owned(), ..ClientOptions::new(&server) })
        .await;
    let recorded = recorded.0.lock().clone();
    assert_eq!(recorded.len(), 1, "{recorded:?}");
    assert_eq!(
        (&recorded[0].0[..], recorded[0].2.status()),
        (&[CLIENT.certificate()][..], CertificateStatus::UriInvalid)
    );
    assert!(Client::encrypted(&server).await.unwrap().is_served().await);
    server.stop().await;
}

/// The secure channel does not ask for the URI; the session does.
#[tokio::test(flavor = "multi_thread")]
async fn a_client_whose_certificate_has_no_application_uri_is_refused_for_that() {
    let folder = tempfile::tempdir().unwrap();
    let recorded = Arc::new(RecordedRejections::default());
    let refusals: Arc<dyn RejectionRecorder> = recorded.clone();
    let bare = TestApplication::without_uri("bare");
    let server = start(OpcUaConfig { trust: trusting(&[&bare]), refusals: Some(refusals), ..config(&folder) }).await;
    gets_nothing(ClientOptions::new(&server).identity(&bare)).await;
    let flaws: Vec<CertificateFlaw> = recorded.0.lock().iter().map(|(.., rejection)| rejection.flaw.clone()).collect();
    assert_eq!(flaws, [CertificateFlaw::UriMissing { announced: Some("urn:bare".to_owned()) }]);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn without_security_a_server_that_does_not_offer_it_only_tells_its_endpoints() {
    let folder = tempfile::tempdir().unwrap();
    let policies = BTreeSet::from([SecurityPolicy::Basic256Sha256]);
    let (told, trust) = (EventLines::default(), trusting(&[&CLIENT]));
    let server = start(OpcUaConfig { policies, trust, events: told.events(), ..config(&folder) }).await;
    assert_eq!(Client::anonymous(&server).await.err(), Some(StatusCode::BadSecurityPolicyRejected));
    told.wait_for("a session without security").await;
    // Nor does it open channels with a policy it does not offer.
    let other = ClientOptions { policy: SecurityPolicy::Aes128Sha256RsaOaep, ..ClientOptions::new(&server) };
    assert!(other.connect().await.is_err());
    // Which begins with a question for the endpoints.
    Client::encrypted(&server).await.unwrap().close().await;
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_password_in_clear_is_refused_even_if_it_is_right() {
    let folder = tempfile::tempdir().unwrap();
    let told = EventLines::default();
    let password_hash = hash_password("Passw0rd").unwrap();
    let users = vec![OpcUaUser { name: "operator1".to_owned(), password_hash }];
    let server = start(OpcUaConfig { users, events: told.events(), ..config(&folder) }).await;
    let user = || IdentityToken::new_user_name("operator1", "Passw0rd");
    let clear = ClientOptions { user: user(), clear_password: true, ..ClientOptions::plain(&server) }.connect().await;
    assert_eq!(clear.err(), Some(StatusCode::BadIdentityTokenRejected));
    told.wait_for("whose password was not encrypted").await;
    ClientOptions { user: user(), ..ClientOptions::plain(&server) }.connect().await.unwrap().close().await;
    server.stop().await;
}
