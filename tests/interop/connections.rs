//! The real program against peers from other projects: asyncua, node-opcua and OpenSSL.
//!
//! Each story starts a virtual controller and configures it from the command line, as a user would; then a peer looks
//! at the result from outside.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use opcua_configurator::pki::{Certificate, FileContent, PkiError, Wanted, pkcs12_read, read_pair};
use serde_json::Value;

use super::cell::Cell;
use super::peers::{ClientCertificate, Node, OpenSsl, Python};

const PASSWORD: &str = "Secret123";

#[test]
fn asyncua_gets_in_with_a_trusted_certificate_and_a_created_user_and_nobody_else_does() {
    let Some(python) = Python::find() else { return };
    let cell = Cell::start("current");
    let own = python.make_certificate(cell.folder(), "own");
    let stranger = python.make_certificate(cell.folder(), "stranger");
    cell.make_certificate("2048", 5);
    cell.set("None,Basic256Sha256", "anonymous,username");
    cell.add_user("operator1", PASSWORD);
    cell.trust(&own);
    cell.run(&["start"]);
    assert_eq!(cell.info()["status"], "Run");

    let secure = |certificate: &ClientCertificate, password: &str| {
        python.session(cell.opcua(), Some(certificate), Some(("operator1", password)))
    };

    let seen = secure(&own, PASSWORD);
    assert_eq!(seen["ok"], true, "{seen}");
    assert_eq!(seen["state"], "Running", "{seen}");
    let server = python.endpoints(cell.opcua(), None);
    assert_eq!(seen["namespaces"][1], server["application_uri"], "{seen}");
    assert_eq!(seen["servers"][0], server["application_uri"], "{seen}");
    assert_eq!(server["application_name"], cell.info()["application_name"], "{server}");
    for object in ["Server", "DeviceSet"] {
        assert!(texts(&seen["objects"]).contains(&object), "no {object} in Objects: {seen}");
    }
    assert!(!texts(&seen["devices"]).is_empty(), "DeviceSet is empty: {seen}");

    let anonymous = python.session(cell.opcua(), None, None);
    assert_eq!(anonymous["ok"], true, "{anonymous}");

    let wrong = secure(&own, "Secret124");
    assert_eq!(wrong["ok"], false, "{wrong}");
    assert!(["BadUserAccessDenied", "BadIdentityTokenRejected"].contains(&text(&wrong["error"])), "{wrong}");

    let unknown = secure(&stranger, PASSWORD);
    assert_eq!(unknown["ok"], false, "{unknown}");
    assert!(["BadSecurityChecksFailed", "BadCertificateUntrusted"].contains(&text(&unknown["error"])), "{unknown}");

    cell.run(&["stop"]);
    assert_eq!(cell.info()["status"], "Stop");
    let stopped = secure(&own, PASSWORD);
    assert_eq!(stopped["error"], "ConnectionRefused", "{stopped}");
}

#[test]
fn asyncua_is_refused_what_a_running_server_is_told_to_forbid() {
    let Some(python) = Python::find() else { return };
    let cell = Cell::start("current");
    let own = python.make_certificate(cell.folder(), "own");
    cell.make_certificate("2048", 1);
    cell.set("None,Basic256Sha256", "anonymous,username");
    cell.add_user("operator1", PASSWORD);
    cell.trust(&own);
    cell.run(&["start"]);
    let user = Some(("operator1", PASSWORD));
    for (certificate, user) in [(None, None), (None, user), (Some(&own), None), (Some(&own), user)] {
        let seen = python.session(cell.opcua(), certificate, user);
        assert_eq!(seen["ok"], true, "{seen}");
    }

    cell.set("Basic256Sha256", "username");

    assert_eq!(cell.info()["status"], "Run", "a server that ran is started again after a change");
    for (certificate, user) in [(None, None), (None, user), (Some(&own), None)] {
        let seen = python.session(cell.opcua(), certificate, user);
        assert_eq!(seen["ok"], false, "{seen}");
        assert_ne!(seen["error"], "ConnectionRefused", "{seen}");
    }
    let seen = python.session(cell.opcua(), Some(&own), user);
    assert_eq!(seen["ok"], true, "{seen}");
}

#[test]
fn node_opcua_lists_the_endpoints_that_were_set() {
    let Some(node) = Node::find() else { return };
    let cell = Cell::start("current");
    cell.make_certificate("2048", 1);
    let all = "None,Basic128Rsa15,Basic256,Basic256Sha256,Aes128Sha256RsaOaep,Aes256Sha256RsaPss";
    cell.set(all, "anonymous,username");
    cell.run(&["start"]);

    for (policies, tokens, count) in [
        (all, "anonymous,username", 11),
        ("None", "anonymous", 1),
        ("None,Basic256Sha256", "anonymous", 3),
        ("Aes128Sha256RsaOaep,Aes256Sha256RsaPss", "username", 4),
    ] {
        cell.set(policies, tokens);
        let seen = node.endpoints(cell.opcua());
        assert_eq!(seen["ok"], true, "{policies}: {seen}");
        let endpoints = seen["endpoints"].as_array().expect("a list of endpoints");
        assert_eq!(endpoints.len(), count, "{policies}: {seen}");

        let offered: BTreeSet<_> = endpoints.iter().map(|e| (text(&e["policy"]), text(&e["mode"]))).collect();
        let wanted: BTreeSet<_> = policies
            .split(',')
            .flat_map(|policy| match policy {
                "None" => vec![(policy, "None")],
                _ => vec![(policy, "Sign"), (policy, "SignAndEncrypt")],
            })
            .collect();
        assert_eq!(offered, wanted);

        for endpoint in endpoints {
            let offered: BTreeSet<_> = texts(&endpoint["tokens"]).into_iter().map(str::to_lowercase).collect();
            assert_eq!(offered, tokens.split(',').map(str::to_owned).collect(), "{policies}: {endpoint}");
        }
    }
}

#[test]
fn openssl_agrees_with_certificates_made_on_the_pc_for_legacy_firmware() {
    let (Some(python), Some(openssl)) = (Python::find(), OpenSsl::find()) else { return };
    for (bits, policies, years) in CERTIFICATES {
        let cell = Cell::start("legacy");
        cell.run_on_workspace(&["backup", "on"]);
        let certificate = check_certificate(&cell, &python, &openssl, bits, policies, years);

        let folder = cell.workspace().join(cell.serial()).join("Cert/SelfSigned");
        let kept = fs::read(folder.join("1_cert.der")).expect("the backup of the certificate");
        assert!(kept == certificate, "the server shows another certificate than the backup holds");
        assert!(folder.join("1_key.pfx").is_file(), "the backup of the key");
    }
}

#[test]
fn openssl_agrees_with_certificates_made_in_the_controller_by_current_firmware() {
    let (Some(python), Some(openssl)) = (Python::find(), OpenSsl::find()) else { return };
    for (bits, policies, years) in CERTIFICATES {
        let cell = Cell::start("current");
        cell.run_on_workspace(&["backup", "on"]);
        check_certificate(&cell, &python, &openssl, bits, policies, years);

        let key = cell.workspace().join(cell.serial()).join("Cert/SelfSigned/1_key.pfx");
        assert!(!key.exists(), "the key left the controller");
    }
}

/// Key length, the policies that go with it, and years of validity.
const CERTIFICATES: [(&str, &str, u8); 3] =
    [("1024", "Basic128Rsa15,Basic256", 1), ("2048", "None,Basic256Sha256", 5), ("4096", "Basic256Sha256", 10)];

/// Makes a certificate, has OpenSSL read and verify what the running server shows, and gives that certificate's DER.
fn check_certificate(
    cell: &Cell,
    python: &Python,
    openssl: &OpenSsl,
    bits: &str,
    policies: &str,
    years: u8,
) -> Vec<u8> {
    cell.set(policies, "anonymous");
    cell.make_certificate(bits, years);
    cell.run(&["start"]);
    let file = cell.folder().join("server.der");
    let server = python.endpoints(cell.opcua(), Some(&file));
    assert_eq!(server["ok"], true, "{server}");

    let seen = openssl.read(&file);
    let common_name = format!("CN=EpsonRC.{}.127.000.000.001", cell.serial());
    let subject = ["C=JP", "ST=Nagano", "L=Suwa", "O=Example", common_name.as_str()];
    assert_eq!(seen.subject.iter().map(String::as_str).collect::<BTreeSet<_>>(), BTreeSet::from(subject));
    assert_eq!(seen.issuer, seen.subject);
    assert_eq!(seen.version, 3);
    assert_eq!(seen.bits.to_string(), bits);
    assert_eq!(seen.extension("Basic Constraints"), ["CA:FALSE"]);
    assert_eq!(
        seen.extension("Key Usage"),
        ["Digital Signature", "Non Repudiation", "Key Encipherment", "Data Encipherment", "Certificate Sign"]
    );
    assert!(seen.extension("Extended Key Usage").contains(&"TLS Web Server Authentication"));
    let names = seen.extension("Subject Alternative Name");
    assert!(names.contains(&format!("URI:{}", text(&server["application_uri"])).as_str()), "{names:?}");
    assert!(names.iter().any(|name| name.starts_with("DNS:") || name.starts_with("IP Address:")), "{names:?}");
    let authority = seen.extension("Authority Key Identifier");
    let own = seen.extension("Subject Key Identifier");
    assert_eq!(authority[0].trim_start_matches("keyid:"), own[0]);

    let days = (seen.not_after - seen.not_before).num_days();
    let wanted = i64::from(years) * 1461 / 4;
    assert!((wanted - 2..=wanted + 2).contains(&days), "{years} years are about {wanted} days, not {days}");
    openssl.verify(&file);
    fs::read(&file).expect("the certificate just saved")
}

#[test]
fn openssl_signs_the_requests_and_asyncua_gets_in_by_what_it_signed() {
    let (Some(python), Some(openssl)) = (Python::find(), OpenSsl::find()) else { return };
    for (firmware, bits, policies, format) in [
        ("current", "2048", "None,Basic256Sha256", "pem"),
        ("legacy", "2048", "None,Basic256Sha256", "der"),
        ("legacy", "1024", "Basic256", "pem"),
        ("current", "4096", "Basic256Sha256", "der"),
    ] {
        let cell = Cell::start(firmware);
        cell.run_on_workspace(&["backup", "on"]);
        cell.set(policies, "anonymous");
        let csr = cell.make_csr(bits, format);
        let request = csr.to_str().expect("temporary folders have plain names");
        let form = format.to_uppercase();
        let seen =
            openssl.call(cell.folder(), &["req", "-inform", &form, "-in", request, "-noout", "-text", "-verify"]);
        for part in [
            format!("Public-Key: ({bits} bit)"),
            format!("URI:urn:EpsonRC.{}.127.000.000.001", cell.serial()),
            "IP Address:127.0.0.1".to_owned(),
            "Digital Signature, Non Repudiation, Key Encipherment, Data Encipherment".to_owned(),
            "TLS Web Server Authentication".to_owned(),
        ] {
            assert!(seen.contains(&part), "no {part} in\n{seen}");
        }

        let ca = ["req", "-x509", "-newkey", "rsa:2048", "-nodes", "-keyout", "ca.key", "-out", "ca.pem"];
        openssl.call(cell.folder(), &[&ca[..], &["-subj", "/CN=Plant CA", "-days", "3650"]].concat());
        let sign = ["x509", "-req", "-inform", &form, "-in", request, "-CA", "ca.pem", "-CAkey", "ca.key"];
        let as_asked = ["-CAcreateserial", "-days", "365", "-copy_extensions", "copyall", "-outform", "DER"];
        openssl.call(cell.folder(), &[&sign[..], &as_asked, &["-out", "signed.der"]].concat());
        let folder = cell.workspace().join(cell.serial()).join("Cert/CASigned");
        fs::create_dir_all(&folder).expect("the import folder");
        fs::copy(cell.folder().join("signed.der"), folder.join("from_ca.der")).expect("the certificate");

        let imported = cell.run(&["cert", "import-ca"]);
        assert_eq!(imported["certificate"]["issued_by"], "Plant CA", "{imported}");
        assert_eq!(imported["findings"], serde_json::json!([]), "{imported}");
        assert_eq!(cell.info()["certificate"]["type"], "ca-signed");
        cell.run(&["start"]);
        let shown = cell.folder().join("server.der");
        assert_eq!(python.endpoints(cell.opcua(), Some(&shown))["ok"], true);
        let signed = fs::read(cell.folder().join("signed.der")).expect("the certificate");
        assert!(fs::read(&shown).expect("the server's certificate") == signed, "the server shows another certificate");
        if policies == "None,Basic256Sha256" {
            let own = python.make_certificate(cell.folder(), "own");
            cell.trust(&own);
            let session = python.session(cell.opcua(), Some(&own), None);
            assert_eq!(session["ok"], true, "{session}");
        }
        let key = folder.join("3_key.pfx");
        assert_eq!(key.exists(), firmware == "legacy", "only a legacy controller's key is backed up");
        if key.exists() {
            let read = ["pkcs12", "-in", key.to_str().expect("a plain name"), "-passin", "pass:interop", "-nodes"];
            let pem = openssl.call(cell.folder(), &read);
            assert!(pem.contains("BEGIN PRIVATE KEY"), "{pem}");
        }
    }
}

/// A certificate and its key as a person makes them with OpenSSL: `own.pem`, `own.key`, `own.der`.
fn made_by_hand(openssl: &OpenSsl, folder: &Path, uri: &str) {
    let make = ["req", "-x509", "-newkey", "rsa:2048", "-nodes", "-keyout", "own.key", "-out", "own.pem"];
    let names = format!("subjectAltName=URI:{uri},IP:127.0.0.1");
    let usage = "keyUsage=critical,digitalSignature,nonRepudiation,keyEncipherment,dataEncipherment";
    let rest = ["-addext", &names, "-addext", usage, "-addext", "extendedKeyUsage=serverAuth"];
    let end = ["-addext", "basicConstraints=critical,CA:FALSE", "-subj", "/CN=by hand", "-days", "365"];
    openssl.call(folder, &[&make[..], &rest, &end].concat());
    openssl.call(folder, &["x509", "-in", "own.pem", "-outform", "DER", "-out", "own.der"]);
}

#[test]
fn whatever_openssl_writes_as_pkcs12_is_read() {
    let Some(openssl) = OpenSsl::find() else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    made_by_hand(&openssl, folder.path(), "urn:by-hand");
    let certificate = Certificate::from_der(&fs::read(folder.path().join("own.der")).expect("made")).expect("whole");
    let old = ["-provider", "default", "-provider", "legacy"];
    let variants: [&[&str]; 9] = [
        &[],
        &["-legacy"],
        &["-keypbe", "PBE-SHA1-3DES", "-certpbe", "PBE-SHA1-3DES", "-macalg", "sha1"],
        &["-keypbe", "PBE-SHA1-RC2-40", "-certpbe", "PBE-SHA1-RC2-40", old[0], old[1], old[2], old[3]],
        &["-keypbe", "AES-128-CBC", "-certpbe", "AES-192-CBC", "-macalg", "sha512"],
        &["-nomac"],
        &["-keypbe", "NONE", "-certpbe", "NONE"],
        &["-keypbe", "NONE", "-certpbe", "NONE", "-nomac"],
        &["-name", "robot 7", "-certfile", "own.pem", "-iter", "100000"],
    ];
    for variant in variants {
        for password in ["Secret123", ""] {
            let word = format!("pass:{password}");
            let write = ["pkcs12", "-export", "-in", "own.pem", "-inkey", "own.key", "-out", "own.pfx", "-passout"];
            openssl.call(folder.path(), &[&write[..], &[&word], variant].concat());
            let pfx = fs::read(folder.path().join("own.pfx")).expect("made");
            let (key, chain) =
                pkcs12_read(&pfx, password).unwrap_or_else(|e| panic!("{variant:?} with \"{password}\": {e}"));
            assert!(key.matches(&certificate) && chain[0] == certificate, "{variant:?}");
            if !variant.contains(&"NONE") {
                assert_eq!(pkcs12_read(&pfx, "other").err(), Some(PkiError::WrongPasswordOrDamaged), "{variant:?}");
            }
        }
    }
}

#[test]
fn whatever_openssl_writes_as_a_key_is_read_or_told_how_to_convert() {
    let Some(openssl) = OpenSsl::find() else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    made_by_hand(&openssl, folder.path(), "urn:by-hand");
    let certificate = fs::read(folder.path().join("own.der")).expect("made");
    let old = ["-provider", "default", "-provider", "legacy"];
    let read = |command: &[&str], form: &str| {
        let rest = ["-in", "own.key", "-out", "variant.key", "-outform", form];
        openssl.call(folder.path(), &[command, &rest].concat());
        let key = fs::read(folder.path().join("variant.key")).expect("made");
        (read_pair(&certificate, &key, Some("Secret123")).map(drop), read_pair(&certificate, &key, Some("other")).err())
    };
    let plain: [&[&str]; 2] = [&["pkcs8", "-topk8", "-nocrypt"], &["rsa", "-traditional"]];
    let word = ["pkcs8", "-topk8", "-passout", "pass:Secret123"];
    let encrypted: [&[&str]; 9] = [
        &[],
        &["-v2", "aes-128-cbc"],
        &["-v2", "aes-192-cbc"],
        &["-v2", "aes256", "-v2prf", "hmacWithSHA1"],
        &["-v2", "aes256", "-v2prf", "hmacWithSHA512", "-iter", "100000"],
        &["-v2", "des3"],
        &["-scrypt"],
        &["-v1", "PBE-SHA1-3DES"],
        &["-v1", "PBE-SHA1-RC2-40", old[0], old[1], old[2], old[3]],
    ];
    for form in ["PEM", "DER"] {
        for command in plain {
            assert_eq!(read(command, form), (Ok(()), None), "{command:?} {form}");
        }
        for variant in encrypted {
            let (right, wrong) = read(&[&word[..], variant].concat(), form);
            assert_eq!(right, Ok(()), "{variant:?} {form}");
            assert_eq!(wrong, Some(PkiError::WrongPasswordOrDamaged), "{variant:?} {form}");
        }
        let unknown = [&word[..], &["-v1", "PBE-MD5-DES"], &old].concat();
        let named = PkiError::UnsupportedKeyEncryption("DES with MD2 or MD5 (PKCS#5 v1.5)".to_owned());
        assert_eq!(read(&unknown, form).0, Err(named), "{form}");
    }
    let traditional = ["rsa", "-traditional", "-aes256", "-passout", "pass:Secret123"];
    let told = PkiError::OtherContent { found: FileContent::TraditionalKey, wanted: Wanted::PrivateKey };
    assert_eq!(read(&traditional, "PEM").0, Err(told));
}

#[test]
fn a_legacy_controller_serves_with_what_was_made_by_hand() {
    let (Some(python), Some(openssl)) = (Python::find(), OpenSsl::find()) else { return };
    let cell = Cell::start("legacy");
    let application_name = text(&cell.info()["application_name"]).to_owned();
    made_by_hand(&openssl, cell.folder(), &format!("urn:{application_name}"));
    let write = ["pkcs12", "-export", "-in", "own.pem", "-inkey", "own.key", "-out", "own.pfx", "-passout"];
    openssl.call(cell.folder(), &[&write[..], &["pass:Secret123"]].concat());
    let file = |name: &str| cell.folder().join(name).to_str().expect("a plain name").to_owned();
    fs::write(cell.folder().join("word"), PASSWORD).expect("the password's file");
    cell.make_certificate("2048", 1);
    cell.set("None,Basic256Sha256", "anonymous");
    for import in [
        &["cert", "import-user", "--password-file", &file("word"), &file("own.pfx")][..],
        &["cert", "import-user", &file("own.der"), &file("own.key")],
    ] {
        cell.run(&["cert", "select", "self-signed"]);
        let imported = cell.run(import);
        assert_eq!(imported["certificate"]["issued_to"], "by hand", "{imported}");
        assert_eq!(cell.info()["certificate"]["type"], "user-specified");
    }
    cell.run(&["start"]);
    let own = python.make_certificate(cell.folder(), "own-client");
    cell.trust(&own);
    let session = python.session(cell.opcua(), Some(&own), None);
    assert_eq!(session["ok"], true, "{session}");
    let exported = cell.run(&["cert", "export", "--format", "pem"]);
    let seen = openssl.call(cell.folder(), &["x509", "-in", text(&exported["file"]), "-noout", "-subject"]);
    assert!(seen.contains(&application_name), "{seen}");
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

fn texts(value: &Value) -> Vec<&str> {
    value.as_array().map(|list| list.iter().map(text).collect()).unwrap_or_default()
}
