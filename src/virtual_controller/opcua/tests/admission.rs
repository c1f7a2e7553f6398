use std::time::Instant;

use opcua::types::{MessageSecurityMode, StatusCode};
use rcgen::RsaKeySize;

use super::test_application::TestCa;
use super::*;
use crate::model::CertificateStatus;

#[tokio::test(flavor = "multi_thread")]
async fn a_client_is_trusted_through_the_ca_that_issued_its_certificate_until_that_revokes_it() {
    let folder = tempfile::tempdir().unwrap();
    let authority = TestCa::new("Plant CA");
    let (client, other) = (authority.issue("issued", RsaKeySize::_2048), authority.issue("other", RsaKeySize::_2048));
    let lists = |crl| TrustLists::new(vec![authority.certificate.clone()], vec![], vec![crl]);
    let (told, recorded) = (EventLines::default(), Arc::new(RecordedRejections::default()));
    let refusals: Arc<dyn RejectionRecorder> = recorded.clone();
    let server = start(OpcUaConfig {
        trust: lists(authority.crl(1, &[])),
        events: told.events(),
        refusals: Some(refusals),
        ..config(&folder)
    })
    .await;
    let one = ClientOptions::new(&server).identity(&client).connect().await.unwrap();
    let two = ClientOptions::new(&server).identity(&other).connect().await.unwrap();
    assert!(one.is_served().await && two.is_served().await);

    let change = Instant::now();
    let cut = server.set_trust(lists(authority.crl(2, &[&client])));
    timeout(WAIT_LIMIT, one.events).await.unwrap().unwrap();
    let took = change.elapsed();
    assert!(took < Duration::from_millis(500), "{took:?}");
    assert_eq!(cut.len(), 1, "{cut:?}");
    assert_eq!((&cut[0].certificate, cut[0].rejection.status()), (&client.certificate(), CertificateStatus::Revoked));
    assert!(two.is_served().await, "the other one stays");

    let again = ClientOptions::new(&server).identity(&client).connect().await.err();
    assert_eq!(again, Some(StatusCode::BadSecurityChecksFailed));
    told.wait_for("cut off: BadCertificateRevoked").await;
    told.wait_for("refused: BadCertificateRevoked").await;
    let recorded = recorded.0.lock().clone();
    // Cut off, refused, and perhaps once more: the client tries to get its old session back.
    assert!(recorded.len() >= 2, "{recorded:?}");
    for (sent, address, rejection) in recorded {
        assert_eq!((sent, address.to_string()), (vec![client.certificate()], "127.0.0.1".to_owned()));
        assert_eq!(rejection.status(), CertificateStatus::Revoked);
    }
    two.close().await;
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn every_open_connection_that_lost_its_trust_is_cut_in_well_under_a_second() {
    let folder = tempfile::tempdir().unwrap();
    let server = start(OpcUaConfig { trust: trusting(&[&CLIENT]), ..config(&folder) }).await;
    let mut clients = Vec::new();
    for _ in 0..10 {
        clients.push(Client::encrypted(&server).await.unwrap());
    }
    let without = Client::anonymous(&server).await.unwrap();
    let change = Instant::now();
    assert_eq!(server.set_trust(trusting(&[&SERVER])).len(), 10);
    for client in clients {
        timeout(WAIT_LIMIT, client.events).await.unwrap().unwrap();
    }
    let took = change.elapsed();
    println!("10 connections were cut in {took:?}");
    assert!(took < Duration::from_secs(1), "{took:?}");
    assert!(without.is_served().await, "it never was trusted");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_certificate_whose_ca_gave_no_revocation_list_is_refused_unless_that_is_allowed() {
    let authority = TestCa::new("Plant CA");
    let client = authority.issue("issued", RsaKeySize::_2048);
    let trust = TrustLists::new(vec![authority.certificate.clone()], vec![], vec![]);
    let allowed = TrustPolicy { allow_unknown_revocation: true, ..TrustPolicy::default() };
    for (detailed_status, trust_policy, refused) in [
        (false, TrustPolicy::default(), Some(StatusCode::BadSecurityChecksFailed)),
        (true, TrustPolicy::default(), Some(StatusCode::BadCertificateRevocationUnknown)),
        (false, allowed, None),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let server =
            start(OpcUaConfig { trust: trust.clone(), trust_policy, detailed_status, ..config(&folder) }).await;
        let connected = ClientOptions::new(&server).identity(&client).connect().await;
        assert_eq!(connected.err(), refused);
        server.stop().await;
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn trust_goes_by_the_controllers_clock() {
    let folder = tempfile::tempdir().unwrap();
    let clock = CertificateClock::new(|| "1970-01-02T00:00:00Z".parse().unwrap());
    let trust = trusting(&[&CLIENT]);
    let server = start(OpcUaConfig { trust, clock, detailed_status: true, ..config(&folder) }).await;
    assert_eq!(Client::encrypted(&server).await.err(), Some(StatusCode::BadCertificateTimeInvalid));
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn trust_is_looked_at_again_when_a_channel_is_renewed() {
    let folder = tempfile::tempdir().unwrap();
    let start_of_test = Instant::now();
    // A clock that jumps beyond the certificate's life.
    let clock = CertificateClock::new(move || {
        let jumped = start_of_test.elapsed() > Duration::from_secs(4);
        chrono::Utc::now() + chrono::TimeDelta::days(if jumped { 10_000 } else { 0 })
    });
    let told = EventLines::default();
    let server =
        start(OpcUaConfig { trust: trusting(&[&CLIENT]), clock, events: told.events(), ..config(&folder) }).await;
    let mode = MessageSecurityMode::Sign;
    let connected = ClientOptions { mode, lifetime: 2000, ..ClientOptions::new(&server) }.connect().await.unwrap();
    assert!(connected.is_served().await);
    timeout(WAIT_LIMIT, connected.events).await.unwrap().unwrap();
    told.wait_for("refused: BadCertificateTimeInvalid").await;
    assert!(start_of_test.elapsed() > Duration::from_secs(4), "not before the clock jumped");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_crate_finds_the_certificates_of_admitted_clients_and_no_others() {
    let folder = tempfile::tempdir().unwrap();
    let other = TestApplication::new("other");
    let server = start(OpcUaConfig { trust: trusting(&[&CLIENT, &other]), ..config(&folder) }).await;
    let held = || std::fs::read_dir(folder.path().join("pki/trusted")).unwrap().count();
    assert_eq!(held(), 0, "trusted is not yet admitted");
    let one = Client::encrypted(&server).await.unwrap();
    let two = ClientOptions::new(&server).identity(&other).connect().await.unwrap();
    assert_eq!(held(), 2);
    server.set_trust(trusting(&[&other]));
    assert_eq!(held(), 1);
    assert!(Client::encrypted(&server).await.is_err());
    assert_eq!(held(), 1);
    drop(one);
    two.close().await;
    server.stop().await;
}
