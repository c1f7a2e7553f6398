use chrono::{TimeDelta, Utc};
use serde_json::{Value, json};

use super::test_controller::{
    ApiClient, CURRENT, KEY, LEGACY, LOOPBACK, RequestFailure, TestController, bounded, code, initial, request,
};
use crate::model::{
    Base64Bytes, CertificateType, Changed, CsrRequest, ErrorCode, Revisioned, StoredServerCertificates,
};
use crate::pki::{Certificate, Csr, PrivateKey, ServerNames, make_csr, pkcs12_write_key, self_signed};
use crate::protocol::{self, CertificateInstalled, CsrMade, Request as _};

fn wish(bits: u16) -> CsrRequest {
    let request = request("robot", bits);
    CsrRequest { subject: request.subject, key_length: request.key_length }
}

fn names() -> ServerNames {
    ServerNames { application_uri: "urn:robot".to_owned(), ips: vec![LOOPBACK], dns: Vec::new() }
}

fn made_on_the_pc(revision: u64, csr: &Csr, key: &PrivateKey) -> Value {
    let pkcs12 = Base64Bytes(pkcs12_write_key("x", key, "transfer").unwrap());
    json!({ "revision": revision, "csr": Base64Bytes(csr.der().to_vec()), "pkcs12": pkcs12, "password": "transfer" })
}

async fn import(
    client: &ApiClient,
    revision: u64,
    certificate: &Certificate,
) -> Result<CertificateInstalled, RequestFailure> {
    let certificate = Base64Bytes(certificate.der().to_vec());
    client.post(protocol::ImportCaSigned::PATH, &json!({ "revision": revision, "certificate": certificate })).await
}

#[tokio::test]
async fn legacy_firmware_takes_a_csr_with_its_key() {
    bounded(async {
        let test_controller = TestController::new(initial(LEGACY)).await;
        let client = test_controller.client().await;
        let make =
            client.post::<CsrMade>(protocol::MakeCsr::PATH, &json!({ "revision": 1, "request": wish(2048) })).await;
        assert_eq!(code(make), ErrorCode::FirmwareTooOld);

        let csr = make_csr(&wish(2048), &names(), &KEY).unwrap();
        let send = async |body: Value| client.post::<CsrMade>(protocol::ImportCsr::PATH, &body).await;
        let other = PrivateKey::generate(wish(2048).key_length).unwrap();
        assert_eq!(code(send(made_on_the_pc(1, &csr, &other)).await), ErrorCode::KeyMismatch);
        let mut wrong = made_on_the_pc(1, &csr, &KEY);
        wrong["password"] = json!("wrong");
        assert_eq!(code(send(wrong).await), ErrorCode::WrongKeyPassword);
        let mut damaged = made_on_the_pc(1, &csr, &KEY);
        damaged["csr"] = json!(Base64Bytes(vec![0x30, 0]));
        assert_eq!(code(send(damaged).await), ErrorCode::FileFormat);
        let short = PrivateKey::generate(wish(1024).key_length).unwrap();
        let too_short = make_csr(&wish(1024), &names(), &short).unwrap();
        assert_eq!(code(send(made_on_the_pc(1, &too_short, &short)).await), ErrorCode::KeyLengthNotAllowed);
        assert_eq!(test_controller.revision(), 1);

        let made = send(made_on_the_pc(1, &csr, &KEY)).await.unwrap();
        assert_eq!((made.changed.revision.number(), made.csr.0.as_slice()), (2, csr.der()));
        let held: Revisioned<StoredServerCertificates> = client.get(protocol::GetCertificates::PATH).await.unwrap();
        assert_eq!(held.value.csr, Some(made.csr));
        assert!(format!("{:?}", test_controller.state().csr).contains("private_key: SecretBytes(…)"));
    })
    .await;
}

#[tokio::test]
async fn a_ca_signed_certificate_is_for_the_csr_held() {
    bounded(async {
        for firmware in [LEGACY, CURRENT] {
            let test_controller = TestController::new(initial(firmware)).await;
            let client = test_controller.client().await;
            let stranger = self_signed(&request("robot", 2048), &names(), &KEY, Utc::now()).unwrap();
            assert_eq!(code(import(&client, 1, &stranger).await), ErrorCode::NoCsr);
            if firmware == CURRENT {
                let sent = made_on_the_pc(1, &make_csr(&wish(2048), &names(), &KEY).unwrap(), &KEY);
                assert_eq!(
                    code(client.post::<CsrMade>(protocol::ImportCsr::PATH, &sent).await),
                    ErrorCode::FirmwareTooNew
                );
                let too_short = json!({ "revision": 1, "request": wish(1024) });
                let refused = client.post::<CsrMade>(protocol::MakeCsr::PATH, &too_short).await;
                assert_eq!(code(refused), ErrorCode::BadCertificateRequest);
                let made: CsrMade = client
                    .post(protocol::MakeCsr::PATH, &json!({ "revision": 1, "request": wish(2048) }))
                    .await
                    .unwrap();
                assert_eq!(Csr::from_der(&made.csr.0).unwrap().common_name(), Some("robot"));
                assert_eq!(code(import(&client, 2, &stranger).await), ErrorCode::CsrMismatch);
                continue;
            }
            let csr = make_csr(&wish(2048), &names(), &KEY).unwrap();
            client.post::<CsrMade>(protocol::ImportCsr::PATH, &made_on_the_pc(1, &csr, &KEY)).await.unwrap();
            let past = Utc::now() - TimeDelta::days(400);
            let expired = self_signed(&request("robot", 2048), &names(), &KEY, past).unwrap();
            assert_eq!(code(import(&client, 2, &expired).await), ErrorCode::CertificateExpired);
            assert_eq!(code(import(&client, 1, &stranger).await), ErrorCode::ChangedMeanwhile);
            let installed = import(&client, 2, &stranger).await.unwrap();
            assert_eq!(installed.certificate.0, stranger.der());
            assert_eq!(test_controller.state().selected, CertificateType::CaSigned);
        }
    })
    .await;
}

#[tokio::test]
async fn a_type_is_selected_only_if_it_is_held() {
    bounded(async {
        let test_controller = TestController::new(initial(CURRENT)).await;
        let client = test_controller.client().await;
        let select = async |kind: &str| {
            client.post::<Changed>(protocol::SelectCertificate::PATH, &json!({ "revision": 1, "type": kind })).await
        };
        assert_eq!(code(select("self-signed").await), ErrorCode::CertificateNotStored);
        assert_eq!(code(select("user-specified").await), ErrorCode::FirmwareTooNew);
        assert_eq!(code(select("home-made").await), ErrorCode::Refused);
        assert_eq!(test_controller.revision(), 1);
    })
    .await;
}
