//! Who gets into the OPC UA server of a virtual controller that was configured and started from the command line.

use std::fs;
use std::path::Path;
use std::time::Duration;

use opcua::client::{ClientBuilder, IdentityToken};
use opcua::crypto::SecurityPolicy;
use opcua::types::{MessageSecurityMode, StatusCode, UserTokenPolicy, UserTokenType};
use rcgen::{
    BasicConstraints, CertificateParams, DnType, ExtendedKeyUsagePurpose, IsCa, Issuer, KeyPair, KeyUsagePurpose,
    PKCS_RSA_SHA256, RsaKeySize, SanType,
};

use crate::common::command_line_test::CommandLineTest;

const MAKE: [&str; 12] = [
    "cert",
    "self-signed",
    "--country",
    "JP",
    "--state",
    "Nagano",
    "--locality",
    "Suwa",
    "--organisation",
    "Example",
    "--yes",
    "cell",
];
const WAIT_LIMIT: Duration = Duration::from_secs(60);

#[tokio::test(flavor = "multi_thread")]
async fn a_refused_client_is_told_why_only_by_controllers_that_are_started_so() {
    let usual = running(&[]);
    let open = running(&["--detailed-status", "--allow-unknown-revocation"]);
    let folder = tempfile::tempdir().unwrap();
    let authority = make_client_and_authority(folder.path());
    for (cli, told) in
        [(&usual, StatusCode::BadSecurityChecksFailed), (&open, StatusCode::BadCertificateChainIncomplete)]
    {
        assert_eq!(connect(cli, folder.path()).await, Err(told));
        let trusted = cli.json(&["clients", "add", "--yes", "--list", "trusted", authority.to_str().unwrap(), "cell"]);
        assert_eq!(trusted.0, Some(0), "{trusted:?}");
    }
    // The CA has given no revocation list.
    assert_eq!(connect(&usual, folder.path()).await, Err(StatusCode::BadSecurityChecksFailed));
    assert_eq!(connect(&open, folder.path()).await, Ok(()));
}

/// One controller with a running server; `more` are arguments of `virtual`.
fn running(more: &[&str]) -> CommandLineTest {
    let cli = CommandLineTest::with(1, &[&["--seed", "3", "--firmware", "current"], more].concat());
    assert_eq!(cli.add(0, "cell").0, Some(0));
    for arguments in [
        &["settings", "set", "--policies", "Basic256Sha256", "--tokens", "anonymous", "--yes", "cell"][..],
        &MAKE,
        &["start", "cell"],
    ] {
        let (code, lines) = cli.json(arguments);
        assert_eq!(code, Some(0), "{arguments:?}: {lines:?}");
    }
    cli
}

/// A client's key and certificate where the library looks for them, and the file with the CA that issued it.
fn make_client_and_authority(folder: &Path) -> std::path::PathBuf {
    let key = || KeyPair::generate_rsa_for(&PKCS_RSA_SHA256, RsaKeySize::_2048).unwrap();
    let named = |name: &str, usages: &[KeyUsagePurpose]| {
        let mut params = CertificateParams::default();
        params.distinguished_name.push(DnType::CommonName, name);
        params.key_usages = usages.to_vec();
        params
    };
    let authority_key = key();
    let mut authority = named("Plant CA", &[KeyUsagePurpose::KeyCertSign, KeyUsagePurpose::CrlSign]);
    authority.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
    let authority_file = folder.join("authority.der");
    fs::write(&authority_file, authority.self_signed(&authority_key).unwrap().der()).unwrap();

    let client_key = key();
    let mut client = named(
        "client",
        &[
            KeyUsagePurpose::DigitalSignature,
            KeyUsagePurpose::ContentCommitment,
            KeyUsagePurpose::KeyEncipherment,
            KeyUsagePurpose::DataEncipherment,
        ],
    );
    client.extended_key_usages = vec![ExtendedKeyUsagePurpose::ClientAuth];
    client.subject_alt_names = vec![SanType::URI("urn:client".try_into().unwrap())];
    client.use_authority_key_identifier_extension = true;
    let issued = client.signed_by(&client_key, &Issuer::new(authority, authority_key)).unwrap();
    fs::write(folder.join("own.der"), issued.der()).unwrap();
    fs::write(folder.join("own.pem"), client_key.serialize_pem()).unwrap();
    authority_file
}

async fn connect(cli: &CommandLineTest, pki: &Path) -> Result<(), StatusCode> {
    let mut client = ClientBuilder::new()
        .application_name("client")
        .application_uri("urn:client")
        .product_uri("urn:client")
        .pki_dir(pki)
        .certificate_path("own.der")
        .private_key_path("own.pem")
        .trust_server_certs(true)
        .verify_server_certs(false)
        .session_retry_limit(0)
        .client()
        .unwrap();
    let url = cli.ready[0]["opcua"].as_str().unwrap();
    let token = UserTokenPolicy { token_type: UserTokenType::Anonymous, ..Default::default() };
    let endpoint = (url, SecurityPolicy::Basic256Sha256.to_str(), MessageSecurityMode::SignAndEncrypt, token);
    let dialling = client.connect_to_matching_endpoint(endpoint, IdentityToken::Anonymous);
    let (session, events) = tokio::time::timeout(WAIT_LIMIT, dialling).await.unwrap().map_err(|e| e.status())?;
    let mut events = events.spawn();
    tokio::select! {
        _ = session.wait_for_connection() => {}
        status = &mut events => return Err(status.unwrap()),
        () = tokio::time::sleep(WAIT_LIMIT) => panic!("neither connected nor refused"),
    }
    let _ = tokio::time::timeout(WAIT_LIMIT, session.disconnect()).await;
    Ok(())
}
