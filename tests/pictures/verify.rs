//! Pictures of the reports about connecting as a client.

use std::path::PathBuf;

use chrono::Duration;
use opcua_configurator::jobs::{
    CertificateVerdict, ConnectRefusal, EndpointVerdict, NotTried, RefusalDetails, TokenOutcome, TokenVerdict,
    VerifyFinding, VerifyReport,
};
use opcua_configurator::model::{
    CertificateStatus, CertificateSummary, ControllerSeries, ErrorCode, Problem, SecurityPolicy, ServerStatus,
};
use opcua_configurator::pki::{CertificateFinding, CertificateFlaw, CertificateRejection, Severity, client_identity};
use opcua_configurator::session::opcua_client::{MessageSecurity, TokenKind};
use opcua_configurator::ui::backend::RecordingBackend;
use opcua_configurator::workspace::ConfiguratorIdentity;

use crate::harness::{SIZE, choose, click, now, window};
use crate::pictures::{W, assert_shows, chinese, end_job, fail, picture, succeed, tick};
use crate::samples::{configuration, info};

fn open(count: usize) -> W {
    window(RecordingBackend::default(), configuration(24, now()), SIZE).tap(count)
}

/// Ticks so many controllers and asks to verify them.
trait Tap {
    fn tap(self, count: usize) -> Self;
}

impl Tap for W {
    fn tap(mut self, count: usize) -> Self {
        tick(&mut self, &["Weld 1", "Weld 2", "Paint booth"][..count]);
        choose(&mut self, &["Tools", "Verify"]);
        self
    }
}

fn summary() -> CertificateSummary {
    let name = "EpsonRC.SN0000123.192.168.010.001";
    CertificateSummary {
        issued_to: name.into(),
        issued_by: name.into(),
        serial_number: "01".into(),
        not_before: now() - Duration::days(500),
        not_after: now() - Duration::days(3),
        thumbprint: "00".repeat(20),
        key_bits: 2048,
        application_uri: Some(format!("urn:{name}")),
    }
}

fn own() -> ConfiguratorIdentity {
    ConfiguratorIdentity {
        certificate: client_identity("OPC UA Configurator", "desk", now()).unwrap().certificate,
        certificate_path: PathBuf::from("/home/engineer/EpsonRC80/OPCUA/Configurator/configurator.der"),
        key_path: PathBuf::from("/home/engineer/EpsonRC80/OPCUA/Configurator/configurator_key.pem"),
    }
}

fn endpoint(
    policy: SecurityPolicy,
    mode: MessageSecurity,
    anonymous: TokenOutcome,
    user: TokenOutcome,
) -> EndpointVerdict {
    let token = |kind, verdict| TokenVerdict { kind, verdict };
    let tokens = vec![token(TokenKind::Anonymous, anonymous), token(TokenKind::UserName, user)];
    EndpointVerdict { policy: Ok(policy), mode: Some(mode), tokens }
}

/// A server that does not know the configurator, with a certificate past its time.
fn troubled() -> VerifyReport {
    let untrusted = || {
        let reason = "neither it nor any of its issuers is in the trust list".to_owned();
        TokenOutcome::Fails(ConnectRefusal::OwnCertificate(Some(RefusalDetails {
            status: CertificateStatus::Untrusted,
            cause: None,
            reason,
        })))
    };
    let mut endpoints = vec![endpoint(
        SecurityPolicy::None,
        MessageSecurity::None,
        TokenOutcome::Works,
        TokenOutcome::NotTried(NotTried::NoPassword),
    )];
    for policy in
        [SecurityPolicy::Basic256Sha256, SecurityPolicy::Aes128Sha256RsaOaep, SecurityPolicy::Aes256Sha256RsaPss]
    {
        for mode in [MessageSecurity::Sign, MessageSecurity::SignAndEncrypt] {
            endpoints.push(endpoint(policy, mode, untrusted(), TokenOutcome::NotTried(NotTried::NoPassword)));
        }
    }
    VerifyReport {
        url: "opc.tcp://192.168.10.1:4840".into(),
        own: own(),
        findings: vec![VerifyFinding::WeakPolicy(SecurityPolicy::None)],
        certificate: Some(CertificateVerdict {
            summary: summary(),
            refused: Some(CertificateRejection { flaw: expired(), subject: "CN=EpsonRC.SN1".into(), depth: 0 }),
            findings: vec![CertificateFinding { flaw: expired(), severity: Severity::Error }],
        }),
        endpoints,
    }
}

fn expired() -> CertificateFlaw {
    CertificateFlaw::Expired { until: now() - Duration::days(3), now: now() }
}

fn fine() -> VerifyReport {
    let summary = CertificateSummary { not_after: now() + Duration::days(400), ..summary() };
    let works = |mode| endpoint(SecurityPolicy::Basic256Sha256, mode, TokenOutcome::Works, TokenOutcome::Works);
    VerifyReport {
        findings: vec![],
        certificate: Some(CertificateVerdict { summary, refused: None, findings: vec![] }),
        endpoints: vec![works(MessageSecurity::Sign), works(MessageSecurity::SignAndEncrypt)],
        ..troubled()
    }
}

fn stopped() -> VerifyReport {
    VerifyReport {
        findings: vec![VerifyFinding::NotRunning { status: ServerStatus::Stop, error: None }],
        certificate: None,
        endpoints: vec![],
        ..troubled()
    }
}

fn answer(window: &mut W, results: Vec<Result<VerifyReport, Problem>>) {
    let failed = results.iter().filter(|result| result.is_err()).count();
    let done = results.len() - failed;
    for (index, result) in results.into_iter().enumerate() {
        match result {
            Ok(report) => succeed(window, index, report, Some(info(index, now(), ControllerSeries::Rc800))),
            Err(problem) => fail(window, index, problem),
        }
    }
    end_job(window, done, failed, 0);
}

#[test]
fn a_troubled_server() {
    let mut window = open(1);
    answer(&mut window, vec![Ok(troubled())]);
    picture(&mut window, "verify_troubled");
    chinese(&mut window);
    click(&mut window, "信任本配置工具…");
    picture(&mut window, "verify_trust_chinese");
}

#[test]
fn several_controllers() {
    let mut window = open(3);
    answer(&mut window, vec![Ok(fine()), Ok(stopped()), Err(ErrorCode::Unreachable.into())]);
    assert_shows(&window, "The controller cannot be reached");
    click(&mut window, "Weld 1");
    assert_shows(&window, "Basic256Sha256");
}
