//! Client lists and CRLs: every rule is the controller's own, and a change is whole or not at all.

use serde_json::{Value, json};

use super::test_controller::{
    CURRENT, LEGACY, RequestFailure, TestController, bounded, clients, code, initial, switch_on, with_certificate,
};
use crate::model::{
    Base64Bytes, ClientList, ErrorCode, ListedCrl, Revisioned, ServerStatus, StartupMode, TrustStamp, TrustStep,
};
use crate::pki::RejectedClient;
use crate::protocol::{self, Request as _, TrustChanged};
use crate::virtual_controller::{DropPoint, FaultSwitches};

fn edit(revision: u64, steps: &[TrustStep]) -> Value {
    json!({ "revision": revision, "steps": steps })
}

fn add(list: ClientList, certificates: &[(String, Base64Bytes)]) -> TrustStep {
    TrustStep::Add { list, certificates: certificates.to_vec() }
}

fn relist(from: ClientList, to: ClientList, certificates: &[(String, Base64Bytes)]) -> TrustStep {
    TrustStep::Move { from, to, thumbprints: certificates.iter().map(|(_, der)| thumbprint(der)).collect() }
}

fn thumbprint(der: &Base64Bytes) -> String {
    crate::pki::Certificate::from_der(&der.0).unwrap().thumbprint_sha1()
}

fn crl(name: &str, key: &rcgen::KeyPair, number: u64) -> Base64Bytes {
    let mut params = rcgen::CertificateParams::default();
    params.distinguished_name = rcgen::DistinguishedName::new();
    params.distinguished_name.push(rcgen::DnType::CommonName, name);
    params.is_ca = rcgen::IsCa::Ca(rcgen::BasicConstraints::Unconstrained);
    params.key_usages = vec![rcgen::KeyUsagePurpose::CrlSign, rcgen::KeyUsagePurpose::KeyCertSign];
    let list = rcgen::CertificateRevocationListParams {
        this_update: rcgen::date_time_ymd(2020, 1, 1),
        next_update: rcgen::date_time_ymd(2040, 1, 1),
        crl_number: rcgen::SerialNumber::from(number),
        issuing_distribution_point: None,
        revoked_certs: Vec::new(),
        key_identifier_method: rcgen::KeyIdMethod::Sha256,
    };
    Base64Bytes(list.signed_by(&rcgen::Issuer::new(params, key)).unwrap().der().to_vec())
}

fn add_crls(crls: &[(&str, &Base64Bytes)]) -> TrustStep {
    TrustStep::AddCrls { crls: crls.iter().map(|(name, der)| ((*name).to_owned(), (*der).clone())).collect() }
}

async fn running() -> TestController {
    let mut new = with_certificate(initial(CURRENT));
    new.settings.startup = StartupMode::Auto;
    TestController::new(new).await
}

use ClientList::{Issuers, Rejected, Trusted};

#[tokio::test]
async fn steps_are_made_in_order_and_all_of_them_or_none() {
    bounded(async {
        let test_controller = running().await;
        let client = test_controller.client().await;
        let certificates = clients("c", 3);
        let (two, last) = certificates.split_at(2);
        let steps = [add(Trusted, two), relist(Trusted, Issuers, &two[..1]), add(Trusted, last)];
        let done: TrustChanged = client.post(protocol::EditTrust::PATH, &edit(1, &steps)).await.unwrap();
        assert_eq!((done.changed.revision.number(), done.changed.status, done.cut.len()), (2, ServerStatus::Run, 0));
        let state = test_controller.state();
        assert_eq!((state.trusted.len(), state.issuers.len()), (2, 1));
        assert_eq!(state.issuers[0].file_name, "c0.der");

        let good = relist(Issuers, Trusted, &two[..1]);
        for (bad, expected) in [
            (add(Trusted, last), ErrorCode::DuplicateCertificate),
            (relist(Issuers, Rejected, last), ErrorCode::NotInList),
            (relist(Trusted, Trusted, last), ErrorCode::Refused),
            (add(Rejected, &clients("d", 1)), ErrorCode::Refused),
            (TrustStep::Remove { list: Trusted, thumbprints: Vec::new() }, ErrorCode::NotInList),
            (TrustStep::RemoveCrls { ids: vec!["AB".to_owned()] }, ErrorCode::NotInList),
            (TrustStep::AddCrls { crls: Vec::new() }, ErrorCode::BadCrl),
        ] {
            let result =
                client.post::<TrustChanged>(protocol::EditTrust::PATH, &edit(2, &[good.clone(), bad.clone()])).await;
            assert_eq!(code(result), expected, "{bad:?}");
        }
        let many = vec![good; protocol::MAX_TRUST_STEPS + 1];
        assert_eq!(code(client.post::<Value>(protocol::EditTrust::PATH, &edit(2, &many)).await), ErrorCode::Refused);
        assert_eq!(test_controller.state(), state);
    })
    .await;
}

#[tokio::test]
async fn legacy_firmware_has_no_issuers() {
    bounded(async {
        let test_controller = TestController::new(initial(LEGACY)).await;
        let client = test_controller.client().await;
        let certificates = clients("c", 1);
        client.post::<Value>(protocol::EditTrust::PATH, &edit(1, &[add(Trusted, &certificates)])).await.unwrap();
        for step in [
            add(Issuers, &clients("d", 1)),
            relist(Trusted, Issuers, &certificates),
            TrustStep::Remove { list: Issuers, thumbprints: vec!["AB".to_owned()] },
        ] {
            let result = client.post::<Value>(protocol::EditTrust::PATH, &edit(2, &[step])).await;
            assert_eq!(code(result), ErrorCode::FirmwareTooOld);
        }
        assert_eq!(test_controller.revision(), 2);
    })
    .await;
}

#[tokio::test]
async fn a_crl_replaces_an_older_one_of_its_issuer_and_no_other() {
    bounded(async {
        let test_controller = running().await;
        let client = test_controller.client().await;
        let (key, other_key) = (rcgen::KeyPair::generate().unwrap(), rcgen::KeyPair::generate().unwrap());
        let (one, two, three) = (crl("A", &key, 1), crl("A", &key, 2), crl("A", &key, 3));
        let other = crl("B", &other_key, 1);
        let both = edit(1, &[add_crls(&[("a.crl", &two), ("b.crl", &other)])]);
        client.post::<TrustChanged>(protocol::EditTrust::PATH, &both).await.unwrap();
        for (der, expected) in [(&one, ErrorCode::CrlOutdated), (&two, ErrorCode::DuplicateCrl)] {
            let result =
                client.post::<Value>(protocol::EditTrust::PATH, &edit(2, &[add_crls(&[("x.crl", der)])])).await;
            assert_eq!(code(result), expected);
        }
        for junk in [Base64Bytes(vec![0x30, 0]), Base64Bytes(three.0[..three.0.len() - 1].to_vec())] {
            let result =
                client.post::<Value>(protocol::EditTrust::PATH, &edit(2, &[add_crls(&[("junk.crl", &junk)])])).await;
            assert_eq!(code(result), ErrorCode::BadCrl);
        }
        client
            .post::<TrustChanged>(protocol::EditTrust::PATH, &edit(2, &[add_crls(&[("a3.crl", &three)])]))
            .await
            .unwrap();
        let listed: Revisioned<Vec<ListedCrl>> = client.get(protocol::GetCrls::PATH).await.unwrap();
        let names: Vec<&str> = listed.value.iter().map(|crl| crl.file_name.as_str()).collect();
        assert_eq!((listed.revision.number(), names), (3, vec!["b.crl", "a3.crl"]));
        assert_eq!(listed.value[1].crl.as_ref(), Some(&three));
        let id = &listed.value[1].summary.id;
        assert_eq!(client.get::<Base64Bytes>(&protocol::GetCrl { id: id.clone() }.target()).await.unwrap(), three);
        assert_eq!(code(client.get::<Value>("/v1/crls/AB").await), ErrorCode::NotInList);
        let again = switch_on(test_controller.folder.path(), initial(CURRENT)).await.unwrap();
        assert_eq!(again.state(), test_controller.state());
    })
    .await;
}

#[tokio::test]
async fn a_crl_that_its_authority_did_not_sign_is_refused() {
    bounded(async {
        let test_controller = TestController::new(initial(CURRENT)).await;
        let client = test_controller.client().await;
        let (key, forger) = (rcgen::KeyPair::generate().unwrap(), rcgen::KeyPair::generate().unwrap());
        let mut params = rcgen::CertificateParams::default();
        params.distinguished_name = rcgen::DistinguishedName::new();
        params.distinguished_name.push(rcgen::DnType::CommonName, "A");
        params.is_ca = rcgen::IsCa::Ca(rcgen::BasicConstraints::Unconstrained);
        let authority = params.self_signed(&key).unwrap().der().to_vec();
        let issuers = add(Issuers, &[("a.der".to_owned(), Base64Bytes(authority))]);
        client.post::<Value>(protocol::EditTrust::PATH, &edit(1, &[issuers])).await.unwrap();
        let mut forged = crl("A", &key, 9);
        *forged.0.last_mut().unwrap() ^= 1;
        let refused =
            client.post::<Value>(protocol::EditTrust::PATH, &edit(2, &[add_crls(&[("x.crl", &forged)])])).await;
        assert_eq!(code(refused), ErrorCode::BadCrl);
        // One of another key of the same name may belong to an authority that is added later.
        let later = edit(2, &[add_crls(&[("later.crl", &crl("A", &forger, 9)), ("a.crl", &crl("A", &key, 1))])]);
        client.post::<TrustChanged>(protocol::EditTrust::PATH, &later).await.unwrap();
        assert_eq!(test_controller.state().crls.len(), 2);
    })
    .await;
}

#[tokio::test]
async fn a_certificate_is_never_in_no_list_and_never_in_two() {
    bounded(async {
        let test_controller = running().await;
        let client = test_controller.client().await;
        let certificates = clients("c", 2);
        client.post::<Value>(protocol::EditTrust::PATH, &edit(1, &[add(Trusted, &certificates)])).await.unwrap();
        let rejected = async || client.get::<Revisioned<Vec<RejectedClient>>>("/v1/clients/rejected").await.unwrap();
        let stamp = async || client.get::<TrustStamp>(protocol::EditTrust::PATH).await.unwrap();
        let away = edit(2, &[relist(Trusted, Rejected, &certificates[..1])]);
        let (state, before) = (test_controller.state(), stamp().await);

        for fault in [
            |switches: &mut FaultSwitches| switches.drop_next_change = Some(DropPoint::BeforeApply),
            |switches: &mut FaultSwitches| switches.disk_full = true,
            |switches: &mut FaultSwitches| switches.task_running = true,
        ] {
            test_controller.controller.faults().update(fault);
            client.post::<Value>(protocol::EditTrust::PATH, &away).await.unwrap_err();
            test_controller.controller.faults().update(|switches| *switches = FaultSwitches::default());
            assert_eq!((test_controller.state(), rejected().await.value.len()), (state.clone(), 0));
        }
        test_controller.controller.faults().update(|switches| switches.drop_next_change = Some(DropPoint::AfterApply));
        assert!(matches!(client.post::<Value>(protocol::EditTrust::PATH, &away).await, Err(RequestFailure::Lost)));
        assert_eq!((test_controller.state().trusted.len(), test_controller.revision()), (1, 3));
        assert_eq!(rejected().await.value[0].count, 0);
        assert!(stamp().await.rejected > before.rejected);
        let again = switch_on(test_controller.folder.path(), initial(CURRENT)).await.unwrap();
        assert_eq!(again.state(), test_controller.state());
        again.shutdown().await;

        // However it comes back, it leaves the rejected list.
        let back = edit(3, &[add(Trusted, &certificates[..1])]);
        client.post::<Value>(protocol::EditTrust::PATH, &back).await.unwrap();
        assert_eq!((test_controller.state().trusted.len(), rejected().await.value.len()), (2, 0));

        // Forgetting is no change of the configuration, but as careful.
        client
            .post::<Value>(protocol::EditTrust::PATH, &edit(4, &[relist(Trusted, Rejected, &certificates)]))
            .await
            .unwrap();
        let thumbprints = certificates.iter().map(|(_, der)| thumbprint(der)).collect();
        let forget = [TrustStep::Remove { list: Rejected, thumbprints }];
        assert_eq!(
            code(client.post::<Value>(protocol::EditTrust::PATH, &edit(4, &forget)).await),
            ErrorCode::ChangedMeanwhile
        );
        test_controller.controller.faults().update(|switches| switches.disk_full = true);
        assert_eq!(code(client.post::<Value>(protocol::EditTrust::PATH, &edit(5, &forget)).await), ErrorCode::DiskFull);
        assert_eq!(rejected().await.value.len(), 2);
        test_controller.controller.faults().update(|switches| switches.disk_full = false);
        let forgotten: TrustChanged = client.post(protocol::EditTrust::PATH, &edit(5, &forget)).await.unwrap();
        assert_eq!((forgotten.changed.revision.number(), rejected().await.value.len()), (5, 0));
        test_controller.controller.shutdown().await;
    })
    .await;
}
