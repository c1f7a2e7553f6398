//! Looking into files and judging certificates from the command line, with files that OpenSSL and this program made.
//! The half with OpenSSL's files is skipped where it is not installed; with `OPCUA_INTEROP_REQUIRED=1` that is a failure.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use rcgen::{
    BasicConstraints, CertificateParams, CertificateRevocationListParams, DnType, ExtendedKeyUsagePurpose, IsCa,
    Issuer, KeyIdMethod, KeyPair, KeyUsagePurpose, PKCS_RSA_SHA256, RevocationReason, RevokedCertParams, SanType,
};
use serde_json::Value;
use time::OffsetDateTime;

use crate::common::process::{Finished, Running};

const DONE: Duration = Duration::from_secs(60);

fn run(folder: &Path, arguments: &[&str]) -> Finished {
    let mut command = Command::new(env!("CARGO_BIN_EXE_opcua-configurator"));
    Running::start(command.args(["--lang", "en"]).args(arguments).current_dir(folder)).expect("it starts").finish(DONE)
}

fn show(folder: &Path, arguments: &[&str]) -> Vec<Value> {
    let shown = run(folder, &[&["--json", "pki", "show"], arguments].concat());
    assert_eq!(shown.code, Some(0), "{}", shown.stderr);
    let shown: Value = serde_json::from_str(&shown.stdout).expect("JSON");
    shown["contents"].as_array().expect("a list").clone()
}

/// A CA and an application it issued, in `trusted/ca.der`, `crls/ca.crl`, `app.pem` and `app.key`.
fn fleet(folder: &Path) {
    for name in ["trusted", "issuers", "crls"] {
        fs::create_dir(folder.join(name)).unwrap();
    }
    let mut ca = CertificateParams::default();
    ca.distinguished_name.push(DnType::CommonName, "Plant CA");
    ca.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
    ca.key_usages = vec![KeyUsagePurpose::KeyCertSign, KeyUsagePurpose::CrlSign];
    let key = KeyPair::generate().unwrap();
    fs::write(folder.join("trusted/ca.der"), ca.self_signed(&key).unwrap().der()).unwrap();
    let ca = Issuer::new(ca, key);

    let mut application = CertificateParams::default();
    application.distinguished_name.push(DnType::CommonName, "Robot \u{1b}[2J");
    application.serial_number = Some(77u64.into());
    application.subject_alt_names = vec![
        SanType::URI("urn:robot".try_into().unwrap()),
        SanType::DnsName("robot.example".try_into().unwrap()),
        SanType::IpAddress("192.168.10.1".parse().unwrap()),
    ];
    application.key_usages = vec![
        KeyUsagePurpose::DigitalSignature,
        KeyUsagePurpose::ContentCommitment,
        KeyUsagePurpose::KeyEncipherment,
        KeyUsagePurpose::DataEncipherment,
    ];
    application.extended_key_usages = vec![ExtendedKeyUsagePurpose::ServerAuth];
    let key = KeyPair::generate_for(&PKCS_RSA_SHA256).unwrap();
    fs::write(folder.join("app.pem"), application.signed_by(&key, &ca).unwrap().pem()).unwrap();
    fs::write(folder.join("app.key"), key.serialize_pem()).unwrap();
    application.serial_number = None;
    fs::write(folder.join("app.csr"), application.serialize_request(&key).unwrap().der()).unwrap();
    fs::write(folder.join("crls/ca.crl"), crl(&ca, &[])).unwrap();
    fs::write(folder.join("revoked.crl"), crl(&ca, &[77])).unwrap();
}

fn crl(ca: &Issuer<'_, KeyPair>, revoked: &[u64]) -> Vec<u8> {
    let now = OffsetDateTime::now_utc();
    let day = time::Duration::days(1);
    let revoked_certs = revoked.iter().map(|serial| RevokedCertParams {
        serial_number: (*serial).into(),
        revocation_time: now - day,
        reason_code: Some(RevocationReason::KeyCompromise),
        invalidity_date: None,
    });
    let params = CertificateRevocationListParams {
        this_update: now - day,
        next_update: now + day,
        crl_number: 3u64.into(),
        issuing_distribution_point: None,
        revoked_certs: revoked_certs.collect(),
        key_identifier_method: KeyIdMethod::Sha256,
    };
    params.signed_by(ca).unwrap().der().to_vec()
}

#[test]
fn verify_prints_the_opc_ua_status_and_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fleet(folder);
    fs::create_dir(folder.join("none")).unwrap();
    fs::create_dir(folder.join("revoked")).unwrap();
    fs::rename(folder.join("revoked.crl"), folder.join("revoked/ca.crl")).unwrap();
    let trusted = ["--trusted", "trusted", "--issuers", "issuers"];
    let listed = [&trusted[..], &["--crls", "crls"]].concat();
    for (options, expected) in [
        (&listed[..], "Good"),
        (&[&listed[..], &["--uri", "urn:robot", "--host", "ROBOT.example"]].concat(), "Good"),
        (&[&listed[..], &["--host", "192.168.10.1", "--policy", "Basic256Sha256"]].concat(), "Good"),
        (&[&listed[..], &["--uri", "urn:other"]].concat(), "BadCertificateUriInvalid"),
        (&[&listed[..], &["--host", "other.example"]].concat(), "BadCertificateHostNameInvalid"),
        (&[&listed[..], &["--role", "client"]].concat(), "BadCertificateUseNotAllowed"),
        (&[&listed[..], &["--at", "1970-01-01T00:00:00Z"]].concat(), "BadCertificateTimeInvalid"),
        (&[&trusted[..], &["--crls", "revoked"]].concat(), "BadCertificateRevoked"),
        (&trusted, "BadCertificateRevocationUnknown"),
        (&[&trusted[..], &["--allow-unknown-revocation"]].concat(), "Good"),
        (&["--trusted", "none", "--issuers", "trusted", "--crls", "crls"], "BadCertificateUntrusted"),
        (&["--trusted", "none"], "BadCertificateChainIncomplete"),
    ] {
        let said = run(folder, &[&["pki", "verify"], options, &["app.pem"]].concat());
        assert_eq!(said.stdout.trim_end(), expected, "{options:?}: {}", said.stderr);
        assert_eq!(said.code, Some(if expected == "Good" { 0 } else { 1 }), "{options:?}");
        assert_eq!(said.stderr.is_empty(), expected == "Good", "{}", said.stderr);
        assert!(!said.stderr.contains('\u{1b}'), "a name commands the terminal");
    }
    fs::write(folder.join("half.pem"), "-----BEGIN CERTIFICATE-----\nMIIB\n-----END CERTIFICATE-----\n").unwrap();
    let said = run(folder, &["pki", "verify", "half.pem"]);
    assert_eq!((said.code, said.stdout.trim_end()), (Some(1), "BadCertificateInvalid"));
}

/// Files of other tools. Each flaw has its own cause and remedy; several of them share one OPC UA status.
#[test]
fn the_reason_decides_what_is_said_and_not_the_status() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    for (case, uri, expected, words) in [
        (
            "09-critical-extensions/ca-nameconstraints",
            None,
            "BadCertificateInvalid",
            &["DNS:line1", "name constraints", "4.2.1.10", "names that this authority may certify"][..],
        ),
        ("09-critical-extensions/ca-policy-constraints-crit", None, "Good", &[]),
        ("09-critical-extensions/ca-policymappings-crit", None, "Good", &[]),
        (
            "10-application-uri/self-no-san",
            Some("urn:example:line1:client"),
            "BadCertificateUriInvalid",
            &["has no application URI", "urn:example:line1:client", "subject alternative name"],
        ),
        ("10-application-uri/self-uri-latin1", None, "BadCertificateInvalid", &["not ASCII", "4.2.1.6", "UaExpert"]),
        (
            "10-application-uri/self-uri-utf8",
            Some("urn:Büro-PC:UaExpert"),
            "BadCertificateUriInvalid",
            &["urn:Büro-PC:UaExpert", "not ASCII", "4.2.1.6", "give the application a URI of ASCII characters"],
        ),
        ("10-application-uri/self-uri-utf8", Some("urn:Buero"), "BadCertificateUriInvalid", &["not ASCII"]),
        (
            "11-aki-ski/aki-ski-differ-same-key",
            None,
            "BadCertificateChainIncomplete",
            &["is there and signed it", "another key identifier", "0B8711F296A2EE4423B81175F2B2AE50A2732A1D"],
        ),
        (
            "07-crl-idp/crl-idp-dp-only-no-cdp",
            None,
            "BadCertificateRevocationUnknown",
            &["does not cover this certificate", "the distribution point", "add the list of a distribution point"],
        ),
    ] {
        let folder = cases.join(case);
        let mut arguments = vec!["pki", "verify", "--trusted", "trusted", "--at", "2026-12-01T00:00:00Z"];
        if folder.join("crls").exists() {
            arguments.extend(["--crls", "crls"]);
        }
        arguments.extend(uri.map(|uri| ["--uri", uri]).into_iter().flatten());
        arguments.push("cert.der");
        let said = run(&folder, &arguments);
        assert_eq!(said.stdout.trim_end(), expected, "{case}: {}", said.stderr);
        for word in words {
            assert!(said.stderr.contains(word), "{case}: no {word:?} in {}", said.stderr);
        }
        assert!(!said.stderr.contains("damaged"), "{case}: {}", said.stderr);
    }
    let shown = show(&cases.join("09-critical-extensions/ca-nameconstraints"), &["trusted/0.der"]);
    let constraints = serde_json::json!({ "permitted": ["DNS:example.com"], "excluded": [] });
    assert_eq!((&shown[0]["name_constraints"], &shown[0]["not_understood"]), (&constraints, &Value::Null));
    let json = run(
        &cases.join("10-application-uri/self-no-san"),
        &[
            "--json",
            "pki",
            "verify",
            "--trusted",
            "trusted",
            "--at",
            "2026-12-01T00:00:00Z",
            "--uri",
            "urn:x",
            "cert.der",
        ],
    );
    let said: Value = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!(said["cause"], serde_json::json!({ "flaw": "uri-missing", "announced": "urn:x" }));
    assert_eq!((said["depth"].as_u64(), said["remedy"].is_string()), (Some(0), true));
}

#[test]
fn a_wrong_request_is_no_verdict() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fleet(folder);
    fs::write(folder.join("issuers/empty.der"), "").unwrap();
    for arguments in [
        &["--trusted", "trusted", "--issuers", "issuers", "--crls", "crls", "app.pem"][..],
        &["--trusted", "trusted", "--crls", "trusted", "app.pem"],
        &["--trusted", "nowhere", "app.pem"],
        &["--trusted", "trusted", "nowhere.pem"],
        &["--trusted", "trusted", "app.key"],
        &["--trusted", "trusted", "crls/ca.crl"],
        &["--at", "yesterday", "app.pem"],
        &["--policy", "Basic512", "app.pem"],
    ] {
        let said = run(folder, &[&["pki", "verify"], arguments].concat());
        assert_eq!((said.code, said.stdout.as_str()), (Some(2), ""), "{arguments:?}: {}", said.stderr);
        assert!(!said.stderr.is_empty(), "{arguments:?}");
    }
}

#[test]
fn show_tells_everything_public_and_no_secret() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fleet(folder);
    let shown = show(folder, &["app.pem"]);
    let app = &shown[0];
    assert_eq!((shown.len(), &app["kind"]), (1, &Value::from("certificate")));
    assert_eq!(app["subject"], "CN=Robot \u{fffd}[2J");
    assert_eq!(app["issuer"], "CN=Plant CA");
    assert_eq!(app["serial_number"], "4D");
    assert_eq!(app["alternative_names"][0]["uri"], "urn:robot");
    assert_eq!(app["extended_key_usages"], serde_json::json!(["serverAuth"]));
    assert_eq!(app["key"]["bits"], 2048);
    assert_eq!(app["self_signed"], false);

    let request = show(folder, &["app.csr"]);
    assert_eq!((&request[0]["kind"], &request[0]["signature_is_right"]), (&"csr".into(), &true.into()));
    assert_eq!(request[0]["key"], app["key"], "the same key");
    let key = show(folder, &["app.key"]);
    assert_eq!((&key[0]["kind"], &key[0]["key_id"]), (&"private-key".into(), &app["key"]["key_id"]));
    let secret = fs::read_to_string(folder.join("app.key")).unwrap();
    let secret = secret.lines().nth(5).unwrap();
    assert!(!run(folder, &["pki", "show", "app.key"]).stdout.contains(secret));

    let list = show(folder, &["revoked.crl"]);
    assert_eq!((&list[0]["kind"], &list[0]["number"]), (&"crl".into(), &"3".into()));
    assert_eq!(list[0]["entries"][0]["serial_number"], "4D");
    assert_eq!(list[0]["entries"][0]["reason"], "keyCompromise");

    let chain = [fs::read(folder.join("app.pem")).unwrap(), b"text\n".to_vec()].concat();
    fs::write(folder.join("chain.pem"), chain).unwrap();
    assert_eq!(show(folder, &["chain.pem"]).len(), 1);
    fs::write(folder.join("garbage"), [7; 100]).unwrap();
    let refused = run(folder, &["pki", "show", "garbage"]);
    assert_eq!((refused.code, refused.stdout.as_str()), (Some(2), ""));
}

#[test]
fn show_reads_what_openssl_writes() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fleet(folder);
    fs::write(folder.join("password"), "secret\n").unwrap();
    let openssl = |arguments: &str| {
        let mut command = Command::new("openssl");
        let status = command.args(arguments.split(' ')).current_dir(folder).stderr(Stdio::null()).status();
        status.is_ok_and(|status| status.success())
    };
    if !openssl("version -a") {
        assert!(std::env::var_os("OPCUA_INTEROP_REQUIRED").is_none(), "there is no `openssl`");
        eprintln!("SKIPPED: there is no `openssl`");
        return;
    }
    for (arguments, file, kinds) in [
        ("x509 -in trusted/ca.der -inform DER -out ca.pem", "ca.pem", &["certificate"][..]),
        (
            "crl2pkcs7 -certfile ca.pem -certfile app.pem -in crls/ca.crl -inform DER -out all.p7b",
            "all.p7b",
            &["certificate", "certificate", "crl"],
        ),
        ("crl2pkcs7 -nocrl -certfile app.pem -outform DER -out app.p7c", "app.p7c", &["certificate"]),
        (
            "pkcs12 -export -in app.pem -inkey app.key -certfile ca.pem -out app.pfx -passout file:password",
            "app.pfx",
            &["private-key", "certificate", "certificate"],
        ),
        ("pkcs12 -export -nokeys -in ca.pem -out ca.p12 -passout file:password", "ca.p12", &["certificate"]),
        ("pkcs8 -topk8 -in app.key -outform DER -out app.p8 -passout file:password", "app.p8", &["private-key"]),
        ("rsa -in app.key -traditional -out app.rsa", "app.rsa", &["private-key"]),
        ("rsa -in app.key -pubout -out app.pub", "app.pub", &["public-key"]),
        ("genpkey -algorithm EC -pkeyopt ec_paramgen_curve:P-384 -outform DER -out ec.der", "ec.der", &["private-key"]),
        (
            "req -new -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -subj /CN=x -keyout ec.key -out ec.csr",
            "ec.csr",
            &["csr"],
        ),
        ("ec -in ec.key -out ec.sec1", "ec.sec1", &["private-key"]),
    ] {
        assert!(openssl(arguments), "openssl {arguments}");
        let shown = show(folder, &[file, "--password-file", "password"]);
        let found: Vec<&str> = shown.iter().map(|thing| thing["kind"].as_str().unwrap()).collect();
        assert_eq!(found, kinds, "{file}");
    }
    let all = show(folder, &["all.p7b"]);
    let (ca, app) = (&all[0], &all[1]);
    let (ca, app) = if ca["subject"] == "CN=Plant CA" { (ca, app) } else { (app, ca) };
    assert_eq!((&app["signed_by"], &ca["self_signed"]), (&ca["sha1"], &Value::from(true)));
    assert_eq!(all[2]["signed_by"], ca["sha1"]);
    assert_eq!(show(folder, &["app.rsa"])[0]["key_id"], show(folder, &["app.pub"])[0]["key_id"]);

    assert!(openssl("x509 -in app.pem -outform DER -out app.der"));
    for (file, password) in [("app.pfx", None), ("app.p8", None), ("app.pfx", Some("wrong"))] {
        let mut arguments = vec!["pki", "show", file];
        if let Some(password) = password {
            fs::write(folder.join("wrong"), password).unwrap();
            arguments.extend(["--password-file", "wrong"]);
        }
        let refused = run(folder, &arguments);
        assert_eq!((refused.code, refused.stdout.as_str()), (Some(2), ""), "{file}: {}", refused.stderr);
    }
}
