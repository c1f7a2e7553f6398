//! How long a client waits until its certificate is judged: a chain of three, with revocation lists of 10 and of 100,000
//! entries.
//!
//! `cargo bench --bench trust -- [CHECKS]`; 2,000 without an argument.

mod report;

use std::hint::black_box;
use std::time::{Duration, Instant};

use chrono::Utc;
use opcua_configurator::pki::{Certificate, Crl, PeerRole, PresentedCertificate, TrustLists, TrustPolicy};
use rcgen::{
    BasicConstraints, CertificateParams, CertificateRevocationListParams, DnType, IsCa, Issuer, KeyIdMethod, KeyPair,
    KeyUsagePurpose, PKCS_RSA_SHA256, RevocationReason, RevokedCertParams, SigningKey,
};
use report::{Spread, line};
use time::OffsetDateTime;

const ROUNDS: usize = 5;

fn main() {
    let benching = report::is_benching();
    let checks = report::number(0).unwrap_or(if benching { 2_000 } else { 2 });
    let plant = BenchLists::new();
    println!("a chain of three with 2048-bit RSA keys, {checks} checks a round, one of {} cores", report::cores());
    for entries in [10, 100_000] {
        let crls = [plant.crl(&plant.root, entries), plant.crl(&plant.middle, entries)];
        let (mut reading, mut first, mut later) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..report::rounds_when(benching, ROUNDS) {
            let start = Instant::now();
            let lists = plant.lists(&crls);
            reading.push(start.elapsed());
            first.push(plant.time(&lists, 1));
            later.push(plant.time(&lists, checks) / u32::try_from(checks).unwrap_or(1));
        }
        let bytes: usize = crls.iter().map(Vec::len).sum();
        println!("revocation lists of {entries} entries, {bytes} bytes together");
        line("reading both (s)", Spread::seconds(&reading));
        line("first check (ms)", milliseconds(&first));
        line("every later check (ms)", milliseconds(&later));
    }
}

fn milliseconds(times: &[Duration]) -> Spread {
    Spread::of(times.iter().map(|time| time.as_secs_f64() * 1e3))
}

struct BenchLists {
    root: Issuer<'static, KeyPair>,
    middle: Issuer<'static, KeyPair>,
    root_certificate: Certificate,
    middle_certificate: Certificate,
    application: Certificate,
}

impl BenchLists {
    fn new() -> Self {
        let (root, middle) = (authority("Root CA"), authority("Plant CA"));
        let keys = [(); 3].map(|()| KeyPair::generate_for(&PKCS_RSA_SHA256).expect("a key"));
        let [root_key, middle_key, key] = keys;
        let root_certificate = parse(root.self_signed(&root_key).expect("a certificate").der());
        let root = Issuer::new(root, root_key);
        let middle_certificate = parse(middle.signed_by(&middle_key, &root).expect("a certificate").der());
        let middle = Issuer::new(middle, middle_key);
        let mut application = CertificateParams::default();
        application.use_authority_key_identifier_extension = true;
        application.key_usages = vec![
            KeyUsagePurpose::DigitalSignature,
            KeyUsagePurpose::ContentCommitment,
            KeyUsagePurpose::KeyEncipherment,
            KeyUsagePurpose::DataEncipherment,
        ];
        let application = parse(application.signed_by(&key, &middle).expect("a certificate").der());
        Self { root, middle, root_certificate, middle_certificate, application }
    }

    fn crl(&self, issuer: &Issuer<'static, impl SigningKey>, entries: usize) -> Vec<u8> {
        let now = OffsetDateTime::now_utc();
        let revoked_certs = (0..entries).map(|number| RevokedCertParams {
            serial_number: [&[0x40; 8][..], &number.to_be_bytes()].concat().into(),
            revocation_time: now,
            reason_code: Some(RevocationReason::Superseded),
            invalidity_date: None,
        });
        let params = CertificateRevocationListParams {
            this_update: now - time::Duration::days(1),
            next_update: now + time::Duration::days(1),
            crl_number: 1u64.into(),
            issuing_distribution_point: None,
            revoked_certs: revoked_certs.collect(),
            key_identifier_method: KeyIdMethod::Sha256,
        };
        params.signed_by(issuer).expect("a list").der().to_vec()
    }

    fn lists(&self, crls: &[Vec<u8>]) -> TrustLists {
        let crls = crls.iter().map(|der| Crl::from_der(der).expect("a list")).collect();
        TrustLists::new(vec![self.root_certificate.clone()], vec![self.middle_certificate.clone()], crls)
    }

    fn time(&self, lists: &TrustLists, checks: usize) -> Duration {
        let presented = PresentedCertificate {
            certificate: &self.application,
            chain: &[],
            role: PeerRole::Client,
            now: Utc::now(),
            application_uri: None,
            host: None,
            security_policy: None,
        };
        let start = Instant::now();
        for _ in 0..checks {
            let chain = black_box(lists).validate(&presented, &TrustPolicy::default());
            assert_eq!(chain.map(|chain| chain.len()), Ok(3));
        }
        start.elapsed()
    }
}

fn authority(common_name: &str) -> CertificateParams {
    let mut params = CertificateParams::default();
    params.distinguished_name.push(DnType::CommonName, common_name);
    params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
    params.key_usages = vec![KeyUsagePurpose::KeyCertSign, KeyUsagePurpose::CrlSign];
    params.use_authority_key_identifier_extension = true;
    params
}

fn parse(der: &[u8]) -> Certificate {
    Certificate::from_der(der).expect("a certificate")
}
