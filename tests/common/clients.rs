//! Real OPC UA clients, and an authority that makes certificates and CRLs for them.

use std::fs;
use std::net::{IpAddr, Ipv4Addr};
use std::sync::Arc;
use std::time::Duration;

use opcua::client::{ClientBuilder, IdentityToken, Session};
use opcua::types::{
    MessageSecurityMode, NodeId, ReadValueId, StatusCode, TimestampsToReturn, UserTokenPolicy, UserTokenType,
    VariableId,
};
use opcua_configurator::pki::{Bundle, Certificate, Crl};
use rcgen::{
    BasicConstraints, CertificateParams, CertificateRevocationListParams, CertifiedIssuer, DnType,
    ExtendedKeyUsagePurpose, IsCa, KeyIdMethod, KeyPair, KeyUsagePurpose, PKCS_RSA_SHA256, RevokedCertParams,
    RsaKeySize, SanType, SerialNumber,
};
use tempfile::TempDir;
use time::OffsetDateTime;
use tokio::task::JoinHandle;
use tokio::time::timeout;

const WAIT_LIMIT: Duration = Duration::from_secs(30);

/// A client's certificate and key.
pub struct TestApplication {
    pub name: String,
    pub certificate: Certificate,
    key: KeyPair,
    serial: SerialNumber,
}

pub struct Authority {
    issuer: CertifiedIssuer<'static, KeyPair>,
    pub certificate: Certificate,
}

fn rsa() -> KeyPair {
    KeyPair::generate_rsa_for(&PKCS_RSA_SHA256, RsaKeySize::_2048).unwrap()
}

fn params(name: &str, serial: u64) -> CertificateParams {
    let mut params = CertificateParams::default();
    params.distinguished_name = rcgen::DistinguishedName::new();
    params.distinguished_name.push(DnType::CommonName, name);
    params.serial_number = Some(SerialNumber::from(serial));
    params.not_before = OffsetDateTime::now_utc() - time::Duration::hours(1);
    params.not_after = OffsetDateTime::now_utc() + time::Duration::days(365);
    params
}

fn client_params(name: &str, serial: u64) -> CertificateParams {
    let mut params = params(name, serial);
    params.subject_alt_names = vec![
        SanType::URI(format!("urn:{name}").try_into().unwrap()),
        SanType::IpAddress(IpAddr::V4(Ipv4Addr::LOCALHOST)),
    ];
    params.key_usages = vec![
        KeyUsagePurpose::DigitalSignature,
        KeyUsagePurpose::ContentCommitment,
        KeyUsagePurpose::KeyEncipherment,
        KeyUsagePurpose::DataEncipherment,
    ];
    params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ServerAuth, ExtendedKeyUsagePurpose::ClientAuth];
    params
}

impl TestApplication {
    /// With a certificate it signed itself.
    pub fn new(name: &str) -> Self {
        let mut params = client_params(name, 1);
        params.key_usages.push(KeyUsagePurpose::KeyCertSign);
        Self::self_signed(name, &params)
    }

    /// With a key that may only sign, which OPC 10000-6 §6.2.2 does not allow.
    pub fn sign_only(name: &str) -> Self {
        let mut params = client_params(name, 1);
        params.key_usages = vec![KeyUsagePurpose::DigitalSignature];
        Self::self_signed(name, &params)
    }

    fn self_signed(name: &str, params: &CertificateParams) -> Self {
        let key = rsa();
        let certificate = Certificate::from_der(params.self_signed(&key).unwrap().der()).unwrap();
        Self { name: name.to_owned(), certificate, key, serial: SerialNumber::from(1_u64) }
    }

    pub fn thumbprint(&self) -> String {
        self.certificate.thumbprint_sha1()
    }
}

impl Authority {
    pub fn new(name: &str) -> Self {
        Self::made(name, Vec::new())
    }

    /// With a URI in its subject alternative name, as node-opcua-pki makes authorities.
    pub fn with_uri(name: &str) -> Self {
        Self::made(name, vec![SanType::URI(format!("urn:{}", name.replace(' ', "-")).try_into().unwrap())])
    }

    fn made(name: &str, names: Vec<SanType>) -> Self {
        let mut params = params(name, 1);
        params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
        params.key_usages = vec![KeyUsagePurpose::KeyCertSign, KeyUsagePurpose::CrlSign];
        params.subject_alt_names = names;
        let issuer = CertifiedIssuer::self_signed(params, rsa()).unwrap();
        let certificate = Certificate::from_der(issuer.der()).unwrap();
        Self { issuer, certificate }
    }

    pub fn client(&self, name: &str, serial: u64) -> TestApplication {
        let key = rsa();
        let mut params = client_params(name, serial);
        params.use_authority_key_identifier_extension = true;
        let certificate = Certificate::from_der(params.signed_by(&key, &self.issuer).unwrap().der()).unwrap();
        TestApplication { name: name.to_owned(), certificate, key, serial: SerialNumber::from(serial) }
    }

    /// Of now, for a week.
    pub fn crl(&self, number: u64, revoked: &[&TestApplication]) -> Crl {
        let now = OffsetDateTime::now_utc();
        let entry = |identity: &&TestApplication| RevokedCertParams {
            serial_number: identity.serial.clone(),
            revocation_time: now - time::Duration::minutes(1),
            reason_code: None,
            invalidity_date: None,
        };
        let params = CertificateRevocationListParams {
            this_update: now - time::Duration::minutes(1),
            next_update: now + time::Duration::days(7),
            crl_number: SerialNumber::from(number),
            issuing_distribution_point: None,
            revoked_certs: revoked.iter().map(entry).collect(),
            key_identifier_method: KeyIdMethod::Sha256,
        };
        Crl::from_der(params.signed_by(&self.issuer).unwrap().der()).unwrap()
    }
}

/// PKCS#7 with nothing in it but certificates and CRLs, as `.p7b` files are.
pub fn p7b(bundle: &Bundle) -> Vec<u8> {
    let signed_data = [0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 7, 2];
    let data = [0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 7, 1];
    let certificates: Vec<u8> = bundle.certificates.iter().flat_map(|c| c.der().to_vec()).collect();
    let crls: Vec<u8> = bundle.crls.iter().flat_map(|c| c.der().to_vec()).collect();
    let content = [
        der(0x02, &[1]),
        der(0x31, &[]),
        der(0x30, &der(0x06, &data)),
        der(0xa0, &certificates),
        if crls.is_empty() { Vec::new() } else { der(0xa1, &crls) },
        der(0x31, &[]),
    ]
    .concat();
    der(0x30, &[der(0x06, &signed_data), der(0xa0, &der(0x30, &content))].concat())
}

fn der(tag: u8, content: &[u8]) -> Vec<u8> {
    let length = content.len();
    let mut out = vec![tag];
    match length {
        0..0x80 => out.push(length as u8),
        0x80..0x1_0000 => out.extend([0x82, (length >> 8) as u8, length as u8]),
        _ => out.extend([0x83, (length >> 16) as u8, (length >> 8) as u8, length as u8]),
    }
    out.extend(content);
    out
}

/// A client with a session.
pub struct Client {
    session: Arc<Session>,
    events: JoinHandle<StatusCode>,
    _folder: TempDir,
}

impl Client {
    /// With Basic256Sha256, signed and encrypted, anonymously.
    pub async fn connect(endpoint: &str, identity: &TestApplication) -> Result<Self, StatusCode> {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir_all(folder.path().join("own")).unwrap();
        fs::create_dir_all(folder.path().join("private")).unwrap();
        fs::write(folder.path().join("own/cert.der"), identity.certificate.der()).unwrap();
        fs::write(folder.path().join("private/private.pem"), identity.key.serialize_pem()).unwrap();
        let uri = format!("urn:{}", identity.name);
        let mut client = ClientBuilder::new()
            .application_name(identity.name.as_str())
            .application_uri(uri.as_str())
            .product_uri(uri.as_str())
            .pki_dir(folder.path())
            .certificate_path("own/cert.der")
            .private_key_path("private/private.pem")
            .trust_server_certs(true)
            .verify_server_certs(false)
            .session_retry_limit(0)
            .client()
            .unwrap();
        let token = UserTokenPolicy { token_type: UserTokenType::Anonymous, ..Default::default() };
        let policy = opcua::crypto::SecurityPolicy::Basic256Sha256.to_str();
        let endpoint = (endpoint, policy, MessageSecurityMode::SignAndEncrypt, token);
        let (session, events) =
            timeout(WAIT_LIMIT, client.connect_to_matching_endpoint(endpoint, IdentityToken::Anonymous))
                .await
                .unwrap()
                .map_err(|e| e.status())?;
        // A refused connection shows only on the event loop.
        let mut events = events.spawn();
        tokio::select! {
            _ = session.wait_for_connection() => Ok(Self { session, events, _folder: folder }),
            status = &mut events => Err(status.unwrap()),
            () = tokio::time::sleep(WAIT_LIMIT) => panic!("neither connected nor refused"),
        }
    }

    /// Whether the server answers a request over this connection.
    pub async fn is_answered(&self) -> bool {
        let state = ReadValueId::from(NodeId::from(VariableId::Server_ServerStatus_State));
        let read = self.session.read(std::slice::from_ref(&state), TimestampsToReturn::Neither, 0.0);
        timeout(WAIT_LIMIT, read).await.is_ok_and(|answer| answer.is_ok())
    }

    /// The server ends the connection.
    pub async fn ended(self) {
        timeout(WAIT_LIMIT, self.events).await.expect("still connected").unwrap();
    }

    /// Ends the client at once, without a word to the server.
    pub fn abandon(self) {
        self.events.abort();
    }

    pub async fn close(self) {
        let _ = timeout(WAIT_LIMIT, self.session.disconnect()).await;
        let _ = timeout(WAIT_LIMIT, self.events).await;
    }
}
