//! Trust between the real program and peers from other projects: asyncua and node-opcua as clients that are
//! judged, asyncua as a client that judges and as a server that is judged, and OpenSSL as the authority.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use std::{fs, thread};

use chrono::Utc;
use opcua_configurator::model::{CertificateStatus, SecurityPolicy};
use opcua_configurator::pki::{Bundle, PeerRole, PresentedCertificate, TrustLists, TrustPolicy, read_bundle};
use opcua_configurator::session::opcua_client::{ConnectTimeouts, OpcUaClient, ServerLocation, UserLogin};
use opcua_configurator::workspace::Workspace;
use serde_json::Value;

use super::authority::{Application, Authority, path};
use super::cell::Cell;
use super::peers::{OpenSsl, Python};
use super::trust_peers::{ALL, Attempt, ClientsLists, ENCRYPTED, NEWEST, NONE, Peer, Server};

/// A running server with these policies that takes anybody who gets as far as to log in.
fn running(firmware: &str) -> Cell {
    let cell = Cell::start(firmware);
    cell.make_certificate("2048", 1);
    cell.set("None,Basic256Sha256,Aes256Sha256RsaPss", "anonymous");
    cell.run(&["start"]);
    cell
}

fn add(cell: &Cell, list: &str, certificate: &Path) {
    cell.run(&["clients", "add", "--list", list, path(certificate)]);
}

/// What the controller says of a client it refused.
fn rejected(cell: &Cell, client: &str) -> Value {
    let lists = cell.run(&["clients", "list", "--list", "rejected"]);
    let all = lists["rejected"].as_array().expect("a list");
    let found = all.iter().find(|entry| entry["certificate"]["issued_to"] == client);
    found.unwrap_or_else(|| panic!("no {client} in {lists}")).clone()
}

/// Every peer is refused, and the controller knows why.
fn assert_refused(cell: &Cell, peers: &mut [Peer], attempts: &[Attempt], status: &str) {
    for peer in &mut *peers {
        for attempt in attempts {
            assert_eq!(peer.attempt(attempt).as_deref(), Some(peer.refusal), "{}: {attempt:?}", peer.name);
        }
    }
    let entry = rejected(cell, &attempts[0].name);
    assert_eq!((&entry["status"], &entry["address"]), (&status.into(), &"127.0.0.1".into()), "{entry}");
    assert!(entry["reason"].as_str().is_some_and(|reason| !reason.is_empty()), "{entry}");
    assert!(entry["count"].as_u64() >= Some((peers.len() * attempts.len()) as u64), "{entry}");
}

fn assert_let_in(peers: &mut [Peer], attempts: &[Attempt]) {
    for peer in peers {
        for attempt in attempts {
            assert_eq!(peer.attempt(attempt), None, "{}: {attempt:?}", peer.name);
        }
    }
}

fn let_in_who_was_refused(firmware: &str) {
    let (Some(mut peers), Some(openssl)) = (Peer::found(), OpenSsl::find()) else { return };
    let cell = running(firmware);
    let client = Application::self_signed(&openssl, cell.folder(), "panel");
    let [none, secured @ ..] = ALL.map(|security| Attempt::new(cell.opcua(), &client, security));

    assert_let_in(&mut peers, &[Attempt::bare(cell.opcua()), none]);
    assert_eq!(cell.run(&["clients", "list"])["rejected"], serde_json::json!([]), "nobody asked for certificates");
    assert_refused(&cell, &mut peers, &secured, "BadCertificateUntrusted");

    let thumbprint = rejected(&cell, "panel")["certificate"]["thumbprint"].as_str().expect("hexadecimal").to_owned();
    cell.run(&["clients", "trust", &thumbprint]);
    assert_let_in(&mut peers, &secured);
    let now = cell.run(&["clients", "list"]);
    assert_eq!(now["rejected"], serde_json::json!([]), "{now}");
    assert_eq!(now["trusted"][0]["certificate"]["thumbprint"], thumbprint, "{now}");

    let liar = secured.map(|attempt| Attempt { uri: "urn:interop:somebody-else".to_owned(), ..attempt });
    for peer in &mut peers {
        for attempt in &liar {
            assert!(peer.attempt(attempt).is_some(), "{}: {attempt:?}", peer.name);
        }
    }
    let entry = rejected(&cell, "panel");
    assert_eq!(entry["status"], "BadCertificateUriInvalid", "{entry}");
    assert!(entry["count"].as_u64() >= Some((peers.len() * liar.len()) as u64), "{entry}");
}

#[test]
fn current_firmware_lists_a_stranger_lets_it_in_once_it_is_moved_and_compares_its_application_uri() {
    let_in_who_was_refused("current");
}

#[test]
fn legacy_firmware_lists_a_stranger_lets_it_in_once_it_is_moved_and_compares_its_application_uri() {
    let_in_who_was_refused("legacy");
}

fn trust_an_authority(firmware: &str) {
    let (Some(mut peers), Some(openssl)) = (Peer::found(), OpenSsl::find()) else { return };
    let cell = running(firmware);
    let ca = Authority::root(&openssl, cell.folder(), "Plant-CA");
    let [good, bad] = ["good", "bad"].map(|name| ca.issue(name));
    let expired = ca.issue_expired("expired");
    let stranger = Authority::root(&openssl, cell.folder(), "Other-CA").issue("stranger");
    let attempt = |client: &Application, security| Attempt::new(cell.opcua(), client, security);

    add(&cell, "trusted", &ca.certificate());
    assert_refused(&cell, &mut peers, &[attempt(&good, ENCRYPTED)], "BadCertificateRevocationUnknown");
    cell.run(&["crl", "add", path(&ca.crl())]);
    assert_let_in(&mut peers, &[&ALL.map(|s| attempt(&good, s))[..], &[attempt(&bad, ENCRYPTED)]].concat());
    assert_refused(&cell, &mut peers, &[ENCRYPTED, NEWEST].map(|s| attempt(&expired, s)), "BadCertificateTimeInvalid");
    assert_refused(&cell, &mut peers, &[attempt(&stranger, NEWEST)], "BadCertificateChainIncomplete");

    ca.revoke(&bad);
    cell.run(&["crl", "add", path(&ca.crl())]);
    assert_refused(&cell, &mut peers, &[ENCRYPTED, NEWEST].map(|s| attempt(&bad, s)), "BadCertificateRevoked");
    assert_let_in(&mut peers, &[attempt(&good, ENCRYPTED), attempt(&bad, NONE)]);
}

#[test]
fn current_firmware_takes_whom_an_authority_vouches_for_as_long_as_its_crl_does() {
    trust_an_authority("current");
}

#[test]
fn legacy_firmware_takes_whom_an_authority_vouches_for_as_long_as_its_crl_does() {
    trust_an_authority("legacy");
}

#[test]
fn a_chain_is_completed_from_the_issuers_or_from_what_the_client_sends_along() {
    let (Some(mut peers), Some(openssl)) = (Peer::found(), OpenSsl::find()) else { return };
    let cell = running("current");
    let root = Authority::root(&openssl, cell.folder(), "Plant-Root");
    let line = root.below("Line-CA");
    let [one, two] = ["one", "two"].map(|name| line.issue(name));
    let attempts = |client: &Application| [ENCRYPTED, NEWEST].map(|s| Attempt::new(cell.opcua(), client, s));
    let with_issuer = |client| attempts(client).map(|attempt| Attempt { chain: vec![line.certificate()], ..attempt });

    // In the issuers list, authorities trust no client; they complete the chain of clients that are trusted themselves.
    add(&cell, "issuers", &root.certificate());
    cell.run(&["crl", "add", path(&root.crl()), path(&line.crl())]);
    add(&cell, "trusted", &one.files.certificate);
    assert_refused(&cell, &mut peers, &attempts(&one)[..1], "BadCertificateChainIncomplete");
    assert_let_in(&mut peers, &with_issuer(&one));
    assert_refused(&cell, &mut peers, &with_issuer(&two)[..1], "BadCertificateUntrusted");
    add(&cell, "issuers", &line.certificate());
    assert_let_in(&mut peers, &attempts(&one));
    assert_refused(&cell, &mut peers, &attempts(&two)[..1], "BadCertificateUntrusted");

    // As a trusted authority the root vouches for everybody below.
    cell.run(&["clients", "remove", &thumbprint(&openssl, &root), &thumbprint(&openssl, &line)]);
    add(&cell, "trusted", &root.certificate());
    assert_refused(&cell, &mut peers, &attempts(&two)[..1], "BadCertificateChainIncomplete");
    assert_let_in(&mut peers, &with_issuer(&two));
    add(&cell, "issuers", &line.certificate());
    assert_let_in(&mut peers, &attempts(&two));
}

fn thumbprint(openssl: &OpenSsl, ca: &Authority<'_>) -> String {
    let seen = openssl.call(Path::new("."), &["x509", "-in", path(&ca.certificate()), "-noout", "-fingerprint"]);
    seen.trim().rsplit('=').next().unwrap_or_default().to_owned()
}

/// The small CA of a cell's workspace.
struct SmallCa<'a> {
    cell: &'a Cell,
    passphrase: PathBuf,
}

impl<'a> SmallCa<'a> {
    fn init(cell: &'a Cell) -> Self {
        let passphrase = cell.folder().join("passphrase");
        fs::write(&passphrase, "correct horse").expect("the passphrase's file");
        let ca = Self { cell, passphrase };
        ca.run(&["init", "--cn", "Plant CA", "--bits", "2048"]);
        ca
    }

    fn run(&self, command: &[&str]) {
        self.cell.run_on_workspace(&[&["ca"], command, &["--passphrase-file", path(&self.passphrase)]].concat());
    }

    fn certificate(&self) -> PathBuf {
        self.cell.workspace().join("CA/ca.der")
    }

    /// A request of OpenSSL's, signed as a client.
    fn client(&self, openssl: &OpenSsl, name: &str) -> Application {
        let (client, request) = Application::request(openssl, self.cell.folder(), name);
        let to = ["--out", path(self.cell.folder()), "--format", "pem"];
        self.run(&[&["sign", "--profile", "client"], &to[..], &[path(&request)]].concat());
        client
    }

    fn crl(&self, name: &str) -> PathBuf {
        let file = self.cell.folder().join(name);
        self.run(&["crl", "--out", path(&file)]);
        file
    }
}

#[test]
fn who_is_revoked_by_the_small_ca_while_connected_is_cut_within_a_second() {
    let (Some(mut peers), Some(openssl)) = (Peer::found(), OpenSsl::find()) else { return };
    let cell = running("current");
    let ca = SmallCa::init(&cell);
    let [good, bad] = ["good", "bad"].map(|name| ca.client(&openssl, name));
    add(&cell, "trusted", &ca.certificate());
    cell.run(&["crl", "add", path(&ca.crl("first.crl"))]);
    let attempts = [&good, &bad].map(|client| Attempt::new(cell.opcua(), client, ENCRYPTED));
    for peer in &mut peers {
        attempts.iter().for_each(|attempt| peer.hold(attempt));
    }

    let text = openssl.call(cell.folder(), &["x509", "-in", path(&bad.files.certificate), "-noout", "-serial"]);
    let serial = text.trim().rsplit('=').next().unwrap_or_default();
    ca.run(&["revoke", serial, "--reason", "key-compromise"]);
    let crl = ca.crl("second.crl");
    thread::scope(|scope| {
        let waits: Vec<_> = peers.iter_mut().map(|peer| scope.spawn(|| (peer.name, peer.lost("bad")))).collect();
        let begun = Instant::now();
        let changed = cell.run(&["crl", "add", path(&crl)]);
        let pushed = Instant::now();
        assert_eq!(changed["disconnected"].as_array().map(Vec::len), Some(waits.len()), "{changed}");
        assert_eq!(changed["disconnected"][0]["status"], "BadCertificateRevoked", "{changed}");
        for wait in waits {
            let (peer, heard) = wait.join().expect("no panic");
            let (all, late) = (heard.duration_since(begun), heard.saturating_duration_since(pushed));
            println!("{peer} was cut {all:?} after `crl add` began, {late:?} after it was done");
            assert!(late < Duration::from_secs(1), "{late:?}");
        }
    });
    // Other clients stay connected: a message about them would come before these answers.
    assert_let_in(&mut peers, &attempts[..1]);
    assert_refused(&cell, &mut peers, &attempts[1..], "BadCertificateRevoked");
}

#[test]
fn asyncua_takes_a_server_of_an_authority_it_trusts_and_no_other() {
    let (Some(python), Some(openssl)) = (Python::find(), OpenSsl::find()) else { return };
    let cell = Cell::start("current");
    let ca = SmallCa::init(&cell);
    cell.set("None,Basic256Sha256", "anonymous");
    let subject = ["--country", "JP", "--organisation", "Example"];
    ca.run(&[&["sign-controllers"], &subject[..], &["cell-1"]].concat());
    cell.run(&["start"]);
    assert_eq!(cell.info()["certificate"]["type"], "ca-signed");
    let client = ca.client(&openssl, "panel");
    add(&cell, "trusted", &ca.certificate());
    cell.run(&["crl", "add", path(&ca.crl("first.crl"))]);

    let lists = |name: &str, trusted: &Path, crl: &Path| {
        let [trusted_folder, crls] = ["trusted", "crls"].map(|list| cell.folder().join(name).join(list));
        for (folder, from) in [(&trusted_folder, trusted), (&crls, crl)] {
            fs::create_dir_all(folder).expect("a folder");
            fs::copy(from, folder.join("file").with_extension("der")).expect("a copy");
        }
        ClientsLists { trusted: trusted_folder, crls }
    };
    let first = cell.folder().join("first.crl");
    let other = Authority::root(&openssl, cell.folder(), "Other-CA").certificate();
    let other_der = other.with_extension("der");
    openssl.call(cell.folder(), &["x509", "-in", path(&other), "-outform", "DER", "-out", path(&other_der)]);
    let server = cell.info()["certificate"]["serial_number"].clone();
    let serial = server.as_str().unwrap_or_else(|| panic!("{}", cell.info()["certificate"]));
    ca.run(&["revoke", serial, "--reason", "superseded"]);
    let second = ca.crl("second.crl");

    let judged = [
        (lists("right", &ca.certificate(), &first), None),
        (lists("wrong", &other_der, &first), Some("BadCertificateUntrusted")),
        (lists("revoked", &ca.certificate(), &second), Some("BadCertificateRevoked")),
    ];
    let mut asyncua = Peer::asyncua(&python);
    for (lists, expected) in judged {
        let attempt = Attempt { judge: Some(lists), ..Attempt::new(cell.opcua(), &client, ENCRYPTED) };
        assert_eq!(asyncua.attempt(&attempt).as_deref(), expected, "{attempt:?}");
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn the_verifying_client_judges_the_servers_of_asyncua() {
    let (Some(python), Some(openssl)) = (Python::find(), OpenSsl::find()) else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let ca = Authority::root(&openssl, folder.path(), "Plant-CA");
    let selfsigned = Application::self_signed(&openssl, folder.path(), "selfsigned");
    let [signed, revoked] = ["signed", "revoked"].map(|name| ca.issue(name));
    let expired = ca.issue_expired("expired");
    ca.revoke(&revoked);
    let policies = ["NoSecurity", "Basic256Sha256_SignAndEncrypt", "Aes256Sha256RsaPss_Sign"];
    let server = |name, application: &Application, uri: String| Server {
        name,
        uri,
        certificate: application.files.certificate.clone(),
        key: application.files.key.clone(),
        policies: &policies,
    };
    let servers = [
        server("selfsigned", &selfsigned, selfsigned.uri()),
        server("signed", &signed, signed.uri()),
        server("revoked", &revoked, revoked.uri()),
        server("expired", &expired, expired.uri()),
        server("other uri", &signed, "urn:interop:somebody-else".to_owned()),
    ];
    let mut asyncua = Peer::asyncua(&python);
    let ports = servers.each_ref().map(|server| asyncua.serve(server));

    let held = |files: &[&Path]| {
        let read = |file: &&Path| read_bundle(&fs::read(file).expect("made")).expect("whole");
        let mut all = Bundle::default();
        for bundle in files.iter().map(read) {
            all.certificates.extend(bundle.certificates);
            all.crls.extend(bundle.crls);
        }
        TrustLists::new(all.certificates, Vec::new(), all.crls)
    };
    let (root, crl) = (ca.certificate(), ca.crl());
    let both = held(&[&root, &crl, &selfsigned.files.certificate]);
    let identity = Workspace::new(folder.path()).own_identity().load_or_make(Utc::now()).expect("an identity");
    let client = OpcUaClient::new(&identity, ConnectTimeouts::default()).expect("a client");

    use CertificateStatus::{ChainIncomplete, RevocationUnknown, Revoked, TimeInvalid, Untrusted, UriInvalid};
    for (index, lists, expected) in [
        (0, &both, None),
        (0, &held(&[&root, &crl]), Some(Untrusted)),
        (1, &both, None),
        (1, &held(&[&root]), Some(RevocationUnknown)),
        (1, &held(&[]), Some(ChainIncomplete)),
        (2, &both, Some(Revoked)),
        (3, &both, Some(TimeInvalid)),
        (4, &both, Some(UriInvalid)),
    ] {
        let name = servers[index].name;
        let target = ServerLocation { host: "127.0.0.1".to_owned(), port: ports[index] };
        let endpoints = client.endpoints(&target).await.unwrap_or_else(|e| panic!("{name}: {e:?}"));
        assert_eq!(endpoints.len(), policies.len(), "{name}: {endpoints:?}");
        for endpoint in endpoints.iter().filter(|endpoint| endpoint.policy != Ok(SecurityPolicy::None)) {
            let (certificate, chain) = endpoint.certificates().expect("a certificate");
            let presented = PresentedCertificate {
                certificate: &certificate,
                chain: &chain,
                role: PeerRole::Server,
                now: Utc::now(),
                application_uri: Some(&endpoint.application_uri),
                host: Some(&target.host),
                security_policy: endpoint.policy.clone().ok(),
            };
            let verdict = lists.validate(&presented, &TrustPolicy::default());
            assert_eq!(verdict.as_ref().err().map(|rejection| rejection.status()), expected, "{name}: {verdict:?}");
            if expected.is_none() {
                let tried = client.attempt(&target, endpoint, &certificate, &UserLogin::Anonymous).await;
                assert_eq!(tried.map(|welcome| welcome.state), Ok(0), "{name}");
                let other = &identity.certificate;
                let tried = client.attempt(&target, endpoint, other, &UserLogin::Anonymous).await;
                assert!(tried.is_err(), "{name} does not have the certificate it must have");
            }
        }
    }
}
