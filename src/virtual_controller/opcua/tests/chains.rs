use std::sync::atomic::Ordering;

use opcua::types::MessageSecurityMode;
use rcgen::RsaKeySize;

use super::impersonating_proxy::ImpersonatingProxy;
use super::test_application::TestCa;
use super::*;

/// Connects a client that sends its issuer along, over and over renews its channel, and is served all the time.
async fn is_served_with_its_chain(size: RsaKeySize, policies: &[SecurityPolicy]) {
    let folder = tempfile::tempdir().unwrap();
    let (root, authority) = (TestCa::new("Root CA"), TestCa::new("Plant CA"));
    let client = authority.issue("chained", size);
    let trust = TrustLists::new(vec![authority.certificate.clone()], vec![], vec![authority.crl(1, &[])]);
    let server = start(OpcUaConfig { trust, ..config(&folder) }).await;
    let chain = [authority.certificate.der(), root.certificate.der()];
    let disguise = ImpersonatingProxy::start(&server, &client, &client, &chain).await;
    let mut sessions = 0;
    for policy in policies {
        for mode in [MessageSecurityMode::Sign, MessageSecurityMode::SignAndEncrypt] {
            let through = Some(disguise.url.clone());
            let dial = ClientOptions { policy: *policy, mode, through, lifetime: 1000, ..ClientOptions::new(&server) };
            let client = dial.identity(&client).connect().await.unwrap_or_else(|e| panic!("{policy} {mode}: {e}"));
            let start = tokio::time::Instant::now();
            // Two renewals.
            while start.elapsed() < Duration::from_millis(1800) {
                assert!(client.is_served().await, "{policy} {mode}, after {:?}", start.elapsed());
                tokio::time::sleep(Duration::from_millis(20)).await;
            }
            client.close().await;
            sessions += 1;
            assert_eq!(disguise.sessions.load(Ordering::Relaxed), sessions, "issuers in CreateSession too");
        }
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_client_that_sends_its_issuers_is_served_through_renewals() {
    use SecurityPolicy::{Aes128Sha256RsaOaep, Aes256Sha256RsaPss, Basic256Sha256};
    is_served_with_its_chain(RsaKeySize::_2048, &[Basic256Sha256, Aes128Sha256RsaOaep, Aes256Sha256RsaPss]).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_client_with_a_long_key_that_sends_its_issuers_is_served_too() {
    is_served_with_its_chain(RsaKeySize::_4096, &[SecurityPolicy::Basic256Sha256]).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_issuer_that_was_sent_completes_a_chain_but_is_not_trusted_for_it() {
    let folder = tempfile::tempdir().unwrap();
    let authority = TestCa::new("Plant CA");
    let client = authority.issue("chained", RsaKeySize::_2048);
    let recorded = Arc::new(RecordedRejections::default());
    let refusals: Arc<dyn RejectionRecorder> = recorded.clone();
    let server = start(OpcUaConfig { refusals: Some(refusals), ..config(&folder) }).await;
    let disguise = ImpersonatingProxy::start(&server, &client, &client, &[authority.certificate.der()]).await;
    let through = Some(disguise.url.clone());
    let refused = ClientOptions { through, ..ClientOptions::new(&server) }.identity(&client).connect().await.err();
    assert_eq!(refused, Some(opcua::types::StatusCode::BadSecurityChecksFailed));
    let recorded = recorded.0.lock().clone();
    let (sent, address, rejection) = &recorded[0];
    assert_eq!(*sent, [client.certificate(), authority.certificate.clone()]);
    assert_eq!(
        (address.to_string(), rejection.status()),
        ("127.0.0.1".to_owned(), crate::model::CertificateStatus::Untrusted)
    );
    server.stop().await;
}
