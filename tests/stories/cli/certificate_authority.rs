//! The small CA from the command line, and what OpenSSL says about everything it makes.
//!
//! Without OpenSSL the stories about it are skipped and say so; with `OPCUA_INTEROP_REQUIRED=1` that is a failure.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use opcua_configurator::pki::{Certificate, Crl};
use opcua_configurator::workspace::Workspace;
use serde_json::Value;

use crate::common::command_line_test::{self, CommandLineTest, DONE, assert_error, program};
use crate::common::process::{Finished, Running};
use crate::interop::peers::OpenSsl;

const PASSPHRASE: &str = "correct horse";

/// A workspace with a CA.
struct Office {
    folder: tempfile::TempDir,
}

impl Office {
    fn empty() -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("passphrase"), PASSPHRASE).unwrap();
        Self { folder }
    }

    fn with_ca(more: &[&str]) -> Self {
        let office = Self::empty();
        let (code, lines) = office.init(more);
        assert_eq!(code, Some(0), "{lines:?}");
        office
    }

    fn init(&self, more: &[&str]) -> (Option<i32>, Vec<Value>) {
        let subject = ["--cn", "Plant CA", "--organisation", "Example & Sons", "--bits", "2048"];
        self.ca("init", &[&subject[..], more].concat())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn ca_file(&self, name: &str) -> PathBuf {
        self.path("workspace").join("CA").join(name)
    }

    fn command(&self, subcommand: &str, more: &[&str]) -> Command {
        let mut command = program();
        command
            .current_dir(self.folder.path())
            .args(["--workspace", "workspace", "--json", "ca", subcommand])
            .args(more);
        if subcommand != "show" {
            command.args(["--passphrase-file", "passphrase"]);
        }
        command
    }

    fn ca(&self, subcommand: &str, more: &[&str]) -> (Option<i32>, Vec<Value>) {
        let Finished { code, stdout, stderr } =
            Running::start(&mut self.command(subcommand, more)).unwrap().finish(DONE);
        assert!(!stdout.contains(PASSPHRASE) && !stderr.contains(PASSPHRASE));
        (code, stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect())
    }

    /// The result of something that succeeds.
    fn done(&self, subcommand: &str, more: &[&str]) -> Value {
        let (code, lines) = self.ca(subcommand, more);
        assert_eq!((code, lines.len()), (Some(0), 1), "{lines:?}");
        lines[0]["result"].clone()
    }

    fn refused(&self, subcommand: &str, more: &[&str], exit: i32, code: &str) {
        let (exited, lines) = self.ca(subcommand, more);
        assert_eq!(exited, Some(exit), "{lines:?}");
        assert_error(&lines, code);
    }

    /// A request made with OpenSSL; its configuration gives everything but the key.
    fn request(&self, openssl: &OpenSsl, name: &str, configuration: &str, key: &str) -> String {
        fs::write(self.path("request.cnf"), configuration).unwrap();
        let (key_file, file) = (format!("{name}.key"), format!("{name}.csr"));
        let new =
            ["req", "-new", "-config", "request.cnf", "-nodes", "-newkey", key, "-keyout", &key_file, "-out", &file];
        openssl.call(self.folder.path(), &new);
        file
    }

    /// Every certificate and CRL in PEM, as OpenSSL wants them.
    fn pem(&self, openssl: &OpenSsl) {
        for ca in ["ca", "root"].into_iter().filter(|ca| self.ca_file(&format!("{ca}.der")).exists()) {
            let (der, crl) = (format!("workspace/CA/{ca}.der"), format!("workspace/CA/{ca}.crl"));
            let folder = self.folder.path();
            openssl.call(folder, &["x509", "-inform", "DER", "-in", &der, "-out", &format!("{ca}.pem")]);
            openssl.call(folder, &["crl", "-inform", "DER", "-in", &crl, "-out", &format!("{ca}.crl.pem")]);
        }
        let all = |suffix: &str| {
            let read = |ca| fs::read_to_string(self.path(&format!("{ca}.{suffix}"))).unwrap_or_default();
            ["ca", "root"].map(read).concat()
        };
        fs::write(self.path("crls.pem"), all("crl.pem")).unwrap();
    }

    /// The status this program itself gives a certificate.
    fn status(&self, certificate: &str) -> String {
        for (folder, extension) in [("trusted", "der"), ("crls", "crl")] {
            fs::create_dir_all(self.path(folder)).unwrap();
            for ca in ["ca", "root"] {
                let name = format!("{ca}.{extension}");
                let _ = fs::copy(self.ca_file(&name), self.path(folder).join(&name));
            }
        }
        let mut command = program();
        command.current_dir(self.folder.path()).args(["pki", "verify", "--trusted", "trusted", "--crls", "crls"]);
        Running::start(command.arg(certificate)).unwrap().finish(DONE).stdout.trim().to_owned()
    }

    /// What `openssl verify` says about a certificate with every CRL at hand, at a time.
    fn verify(&self, certificate: &str, purpose: &str, at: Option<i64>) -> String {
        let root = if self.path("root.pem").exists() { "root.pem" } else { "ca.pem" };
        let mut command = Command::new("openssl");
        command.current_dir(self.folder.path()).args([
            "verify",
            "-x509_strict",
            "-crl_check_all",
            "-CRLfile",
            "crls.pem",
        ]);
        command.args(["-purpose", purpose, "-CAfile", root, "-untrusted", "ca.pem"]);
        if let Some(at) = at {
            command.args(["-attime", &at.to_string()]);
        }
        let Finished { stdout, stderr, .. } = Running::start(command.arg(certificate)).unwrap().finish(DONE);
        stdout + &stderr
    }
}

/// Repeated parts, an order of its own, a name of OpenSSL's default string types, and an extension many tools add.
const SERVER: &str = "
[req]
prompt = no
distinguished_name = name
req_extensions = extensions
string_mask = utf8only
[name]
0.DC = example
1.DC = plant
O = Example & Sons
CN = robot 7
C = JP
[extensions]
subjectKeyIdentifier = hash
basicConstraints = critical, CA:TRUE
subjectAltName = URI:urn:example:robot7, DNS:robot-7, IP:192.168.10.7, IP:fe80::7
";

const CLIENT: &str = "
[req]
prompt = no
distinguished_name = name
req_extensions = extensions
[name]
CN = SCADA
[extensions]
subjectAltName = URI:urn:example:scada
";

#[test]
fn openssl_agrees_with_root_intermediate_server_client_and_crl() {
    let Some(openssl) = OpenSsl::find() else { return };
    for more in [&[][..], &["--intermediate", "--years", "12"]] {
        let office = Office::with_ca(more);
        let folder = office.folder.path();
        let server = office.request(&openssl, "server", SERVER, "rsa:2048");
        let client = office.request(&openssl, "client", CLIENT, "rsa:3072");
        let to = ["--out", "out", "--format", "pem"];
        office.done("sign", &[&to[..], &[&server]].concat());
        office.done("sign", &[&to[..], &["--profile", "client", "--years", "10", &client]].concat());
        office.pem(&openssl);
        for (certificate, purposes, not_for) in [
            ("out/server.pem", &["sslserver", "sslclient"][..], None),
            ("out/client.pem", &["sslclient"], Some("sslserver")),
        ] {
            for purpose in purposes {
                assert_eq!(office.verify(certificate, purpose, None), format!("{certificate}: OK\n"));
            }
            if let Some(purpose) = not_for {
                assert!(office.verify(certificate, purpose, None).contains("unsuitable certificate purpose"));
            }
        }
        assert_eq!(["server", "client"].map(|it| office.status(&format!("out/{it}.pem"))), ["Good", "Good"]);
        for ca in ["ca", "root"].into_iter().filter(|ca| office.path(&format!("{ca}.pem")).exists()) {
            let pem = format!("{ca}.pem");
            assert_eq!(office.verify(&pem, "any", None), format!("{pem}: OK\n"));
            let crl =
                openssl.call(folder, &["crl", "-in", &format!("{ca}.crl.pem"), "-text", "-noout", "-CAfile", &pem]);
            assert!(crl.contains("Version 2") && crl.contains("No Revoked Certificates."), "{crl}");
            // Another tool can take over with the passphrase alone.
            let key = format!("workspace/CA/{ca}.key");
            let public = ["pkey", "-in", &key, "-passin", "file:passphrase", "-pubout"];
            let of_certificate = openssl.call(folder, &["x509", "-in", &pem, "-noout", "-pubkey"]);
            assert_eq!(openssl.call(folder, &public), of_certificate);
        }

        let text = openssl.call(folder, &["x509", "-in", "out/server.pem", "-noout", "-text"]);
        for expected in [
            "Subject: DC = example, DC = plant, O = Example & Sons, CN = robot 7, C = JP",
            "CA:FALSE",
            "Digital Signature, Non Repudiation, Key Encipherment, Data Encipherment",
            "TLS Web Server Authentication, TLS Web Client Authentication",
            "URI:urn:example:robot7, DNS:robot-7, IP Address:192.168.10.7, IP Address:FE80:0:0:0:0:0:0:7",
            "sha256WithRSAEncryption",
        ] {
            assert!(text.contains(expected), "no {expected} in\n{text}");
        }
        let subject = |of: &str, file: &str| {
            openssl.call(folder, &[of, "-in", file, "-noout", "-subject", "-nameopt", "multiline,show_type"])
        };
        assert_eq!(subject("x509", "out/server.pem"), subject("req", "server.csr"), "string types and all");

        // Revoked clients are refused, and so is every client while the CRL is too old.
        let serial = office.done("show", &[])["issued"][0]["serial_number"].as_str().unwrap().to_owned();
        office.done("revoke", &[&serial, "--reason", "key-compromise"]);
        office.pem(&openssl);
        assert!(office.verify("out/server.pem", "sslserver", None).contains("certificate revoked"));
        assert_eq!(office.status("out/server.pem"), "BadCertificateRevoked");
        assert_eq!(office.verify("out/client.pem", "sslclient", None), "out/client.pem: OK\n");
        let crl = openssl.call(folder, &["crl", "-in", "ca.crl.pem", "-text", "-noout"]);
        assert!(crl.contains(&serial) && crl.contains("Key Compromise"), "{crl}");
        let later = (chrono::Utc::now() + chrono::Duration::days(370)).timestamp();
        assert!(office.verify("out/client.pem", "sslclient", Some(later)).contains("CRL has expired"));
        openssl.call(folder, &["asn1parse", "-inform", "DER", "-in", "workspace/CA/ca.crl"]);
    }
}

#[test]
fn openssl_reads_a_published_crl_in_both_forms_and_its_number_grows() {
    let Some(openssl) = OpenSsl::find() else { return };
    let office = Office::with_ca(&["--intermediate"]);
    let mut last = 0;
    for (out, beside, form) in [("a.crl", "root-a.crl", "DER"), ("b.pem", "root-b.pem", "PEM")] {
        let published = office.done("crl", &["--out", out, "--days", "30"]);
        assert_eq!(published["saved"], serde_json::json!([out, beside]));
        for file in [out, beside] {
            let shown = ["crl", "-inform", form, "-in", file, "-noout", "-crlnumber"];
            let number = openssl.call(office.folder.path(), &shown);
            let number = u64::from_str_radix(number.trim().strip_prefix("crlNumber=0x").unwrap(), 16).unwrap();
            assert!(number > 1_600_000_000);
            if file == out {
                assert!(number > last);
                last = number;
            }
        }
    }
}

#[test]
fn what_the_ca_does_not_do_says_why() {
    let Some(openssl) = OpenSsl::find() else { return };
    let office = Office::empty();
    office.refused("show", &[], 2, "no-authority");
    office.refused("sign", &["x.csr"], 2, "no-authority");
    fs::write(office.path("passphrase"), "short").unwrap();
    assert_error(&office.init(&[]).1, "bad-passphrase");
    fs::write(office.path("passphrase"), PASSPHRASE).unwrap();
    assert_error(&office.init(&["--years", "31"]).1, "bad-certificate-request");
    assert_error(&office.init(&["--country", "XX"]).1, "bad-certificate-request");
    assert!(!office.ca_file("ca.json").exists());
    assert_eq!(office.init(&[]).0, Some(0));
    assert_error(&office.init(&[]).1, "authority-exists");

    let server = office.request(&openssl, "server", SERVER, "rsa:2048");
    office.done("sign", &[&server]);
    office.refused("sign", &[&server], 1, "already-signed");
    office.done("sign", &["--renew", &server]);
    let short = office.request(&openssl, "short", SERVER, "rsa:1024");
    office.refused("sign", &[&short], 1, "short-key");
    office.done("sign", &["--allow-short-keys", &short]);
    let bare = office.request(&openssl, "bare", "[req]\nprompt=no\ndistinguished_name=n\n[n]\nCN=bare\n", "rsa:2048");
    office.refused("sign", &[&bare], 1, "csr-refused");
    office.done("sign", &["--uri", "urn:bare", "--host", "192.168.10.8", "--host", "bare", &bare]);
    let client = office.request(&openssl, "client", CLIENT, "rsa:2048");
    office.refused("sign", &[&client], 1, "bad-certificate-request");
    let damaged = fs::read_to_string(office.path(&client)).unwrap().replacen("\nMI", "\nMJ", 1);
    fs::write(office.path("damaged.csr"), damaged).unwrap();
    office.refused("sign", &["damaged.csr"], 1, "file-format");
    office.refused("sign", &["missing.csr"], 1, "file-not-found");
    office.refused("sign", &["--out", ".", "a/x.csr", "b/x.csr"], 2, "several-files");

    let serial = office.done("show", &[])["issued"][0]["serial_number"].as_str().unwrap().to_owned();
    office.refused("revoke", &["4711", "--reason", "superseded"], 2, "unknown-serial");
    office.done("revoke", &[&serial, "--reason", "superseded"]);
    office.refused("revoke", &[&serial, "--reason", "superseded"], 2, "already-revoked");
    let states: Vec<_> =
        office.done("show", &[])["issued"].as_array().unwrap().iter().map(|i| i["status"].clone()).collect();
    assert_eq!(states, ["revoked", "valid", "valid", "valid"]);

    fs::write(office.path("passphrase"), "correct house").unwrap();
    office.refused("crl", &[], 2, "authority-passphrase");
    office.refused("backup", &["--out", "ca.backup"], 2, "authority-passphrase");
    fs::write(office.path("passphrase"), PASSPHRASE).unwrap();
    let mut without = program();
    let without = without.args(["--workspace", office.path("workspace").to_str().unwrap(), "--json", "ca", "crl"]);
    let Finished { code, stdout, .. } = Running::start(without.args(["--out", "x.crl"])).unwrap().finish(DONE);
    assert_eq!(code, Some(2), "there is no terminal to ask on");
    assert!(stdout.contains(r#""no-passphrase""#), "{stdout}");
    let held = Workspace::new(office.path("workspace")).authority().open(&PASSPHRASE.into()).unwrap();
    office.refused("crl", &[], 2, "authority-busy");
    drop(held);
    let whole = fs::read(office.ca_file("ca.json")).unwrap();
    fs::write(office.ca_file("ca.json"), &whole[..whole.len() - 9]).unwrap();
    for (subcommand, more) in [("show", vec![]), ("sign", vec![server.as_str()]), ("crl", vec![])] {
        office.refused(subcommand, &more, 2, "authority-damaged");
    }
}

#[test]
fn a_backup_moves_the_ca_to_another_workspace() {
    let office = Office::with_ca(&["--intermediate"]);
    office.done("backup", &["--out", "ca.backup"]);
    office.refused("restore", &["ca.backup"], 2, "authority-exists");
    let before = office.done("show", &[]);
    fs::rename(office.path("workspace"), office.path("lost")).unwrap();
    fs::write(office.path("damaged"), &fs::read(office.path("ca.backup")).unwrap()[..500]).unwrap();
    office.refused("restore", &["damaged"], 2, "backup-damaged");
    office.refused("restore", &["missing"], 2, "file-unreadable");
    fs::write(office.path("passphrase"), "correct house").unwrap();
    office.refused("restore", &["ca.backup"], 2, "backup-passphrase");
    fs::write(office.path("passphrase"), PASSPHRASE).unwrap();
    office.done("restore", &["ca.backup"]);
    assert_eq!(office.done("show", &[]), before);
    office.done("crl", &[]);
}

/// `ulimit -f` makes every write beyond so many blocks of 512 bytes fail, as a full disk does.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_the_ca_as_it_was() {
    let limited = |office: &Office, blocks: u32, subcommand: &str, more: &[&str]| {
        let inner = office.command(subcommand, more);
        let mut command = program();
        command = {
            let mut shell = Command::new("sh");
            shell.envs(command.get_envs().filter_map(|(name, value)| Some((name, value?))));
            shell.env_remove("DBUS_SESSION_BUS_ADDRESS").current_dir(office.folder.path());
            shell.args(["-c", &format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$@\""), "sh"]);
            shell.arg(inner.get_program()).args(inner.get_args());
            shell
        };
        let finished = Running::start(&mut command).unwrap().finish(DONE);
        let lines: Vec<Value> = finished.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        assert_error(&lines, "workspace-full");
    };
    let office = Office::empty();
    let subject = ["--cn", "Plant CA", "--bits", "2048"];
    for blocks in [1, 2] {
        limited(&office, blocks, "init", &subject);
        office.refused("show", &[], 2, "no-authority");
    }
    assert_eq!(office.init(&[]).0, Some(0), "what the attempts left behind is in nobody's way");
    let before = fs::read(office.ca_file("ca.json")).unwrap();
    limited(&office, 1, "crl", &["--out", "x.crl"]);
    limited(&office, 1, "backup", &["--out", "ca.backup"]);
    assert_eq!(fs::read(office.ca_file("ca.json")).unwrap(), before);
    assert!(!office.path("ca.backup").exists());
}

/// A process that is killed at any moment leaves every certificate file in the database, and CRL numbers only grow.
#[test]
fn a_ca_killed_at_any_moment_forgets_nothing() {
    let Some(openssl) = OpenSsl::find() else { return };
    let office = Office::with_ca(&["--intermediate"]);
    let server = office.request(&openssl, "server", SERVER, "rsa:2048");
    let (mut numbers, mut serials) = (Vec::new(), BTreeSet::new());
    for milliseconds in (0..24).map(|step| 150 + step * 40) {
        let command = if milliseconds % 80 == 70 { ("sign", vec!["--renew", &server]) } else { ("crl", vec![]) };
        let running = Running::start(&mut office.command(command.0, &command.1)).unwrap();
        std::thread::sleep(Duration::from_millis(milliseconds));
        drop(running);
        let shown = office.done("show", &[]);
        let number = |ca: &str| shown[ca]["crl"]["number"].as_str().unwrap().parse::<u64>().unwrap();
        numbers.push((number("ca"), number("root")));
        let known: BTreeSet<String> = shown["issued"]
            .as_array()
            .unwrap()
            .iter()
            .map(|i| i["serial_number"].as_str().unwrap().to_owned())
            .collect();
        assert!(known.is_superset(&serials), "one was forgotten");
        for file in command_line_test::walk(&office.ca_file(""))
            .iter()
            .filter(|file| file.parent().unwrap().ends_with("issued"))
        {
            let temporary = file.file_name().unwrap().to_string_lossy().starts_with(".writing-");
            assert!(temporary || known.contains(&*file.file_stem().unwrap().to_string_lossy()), "{}", file.display());
        }
        serials = known;
    }
    assert!(numbers.is_sorted());
    let crl = |name: &str| Crl::from_der(&fs::read(office.ca_file(name)).unwrap()).unwrap();
    office.done("crl", &[]);
    assert!(crl("ca.crl").number().unwrap().parse::<u64>().unwrap() > numbers.last().unwrap().0);
    let certificate = |path: &Path| Certificate::from_der(&fs::read(path).unwrap()).unwrap();
    assert!(crl("root.crl").verify_signed_by(&certificate(&office.ca_file("root.der"))));
    assert!(!serials.is_empty() || !office.ca_file("issued").exists());
}

#[test]
fn controllers_get_ca_signed_certificates_in_one_command() {
    let cli = CommandLineTest::with(3, &["--seed", "3", "--firmware", "mixed"]);
    for (index, name) in ["weld", "paint", "glue"].into_iter().enumerate() {
        assert_eq!(cli.add(index, name).0, Some(0));
    }
    let passphrase = cli.file("passphrase");
    fs::write(&passphrase, PASSPHRASE).unwrap();
    let ca = |arguments: &[&str]| cli.json(&[&["ca"], arguments, &["--passphrase-file", &passphrase]].concat());
    assert_error(&ca(&["sign-controllers", "--yes", "--all"]).1, "no-authority");
    assert_eq!(ca(&["init", "--cn", "Plant CA", "--bits", "2048"]).0, Some(0));
    assert_error(&ca(&["sign-controllers", "--all"]).1, "not-confirmed");

    let sign = |more: &[&str]| {
        let (code, lines) = ca(&[&["sign-controllers", "--yes", "--organisation", "Example"], more].concat());
        assert_eq!(code, Some(0), "{lines:?}");
        lines
    };
    let issued = || cli.json(&["ca", "show"]).1[0]["result"]["issued"].as_array().unwrap().clone();
    let first = sign(&["--all"]);
    assert_eq!((first.len(), issued().len()), (3, 3));
    for line in &first {
        assert_eq!(line["result"]["certificate"]["issued_by"], "Plant CA");
        assert_eq!(line["result"]["findings"], serde_json::json!([]), "{line}");
        let serial = &line["result"]["certificate"]["serial_number"];
        let entry = issued().into_iter().find(|issued| issued["serial_number"] == *serial).unwrap();
        assert_eq!(entry["controller"]["name"], line["controller"]);
    }
    let (code, started) = cli.json(&["start", "--all"]);
    assert_eq!(code, Some(0), "{started:?}");

    // Once more changes nothing, neither in the CA nor in the controllers.
    let revisions =
        |lines: Vec<Value>| lines.into_iter().map(|line| line["result"]["revision"].clone()).collect::<Vec<_>>();
    let before = revisions(cli.json(&["info", "--all"]).1);
    let certificates =
        |lines: &[Value]| -> Vec<_> { lines.iter().map(|l| l["result"]["certificate"].clone()).collect() };
    assert_eq!(certificates(&sign(&["--all"])), certificates(&first));
    assert_eq!((issued().len(), revisions(cli.json(&["info", "--all"]).1)), (3, before));

    // A renewal is another certificate for the same key, a new key another request.
    let renewed = sign(&["--renew", "weld"]);
    let renewed = &renewed[0]["result"]["certificate"]["thumbprint"];
    let rekeyed = sign(&["--new-key", "paint"]);
    let keys: BTreeSet<String> = issued().iter().map(|issued| issued["key"].as_str().unwrap().to_owned()).collect();
    assert_eq!((issued().len(), keys.len()), (5, 4));
    assert_eq!(rekeyed[0]["result"]["status"], "Run", "the server runs on with the new certificate");
    assert_eq!(issued()[3]["thumbprint"], *renewed);
}

#[test]
fn controllers_learn_of_the_ca_and_of_what_it_revoked() {
    let cli = CommandLineTest::with(2, &["--seed", "3", "--firmware", "mixed"]);
    for (index, name) in ["weld", "paint"].into_iter().enumerate() {
        assert_eq!(cli.add(index, name).0, Some(0));
    }
    let passphrase = cli.file("passphrase");
    fs::write(&passphrase, PASSPHRASE).unwrap();
    let ca = |arguments: &[&str]| cli.json(&[&["ca"], arguments, &["--passphrase-file", &passphrase]].concat());
    assert_eq!(ca(&["init", "--cn", "Plant CA", "--bits", "2048", "--intermediate"]).0, Some(0));
    let number = || cli.json(&["ca", "show"]).1[0]["result"]["ca"]["crl"]["number"].clone();
    let first = number();
    assert_error(&ca(&["crl", "--push", "weld"]).1, "not-confirmed");
    assert_error(&ca(&["crl", "--yes", "--push"]).1, "unknown-controller");
    assert_error(&ca(&["crl", "--yes", "--push", "nobody"]).1, "unknown-controller");
    assert_eq!(number(), first, "nothing was published");

    let counts = |arguments: &[&str]| {
        let (code, lines) = ca(arguments);
        assert_eq!(code, Some(0), "{lines:?}");
        let of = |name: &str| {
            let result = &lines.iter().find(|line| line["controller"] == name).unwrap()["result"];
            ["trusted", "issuers", "crls"].map(|list| result[list].as_u64().unwrap())
        };
        (of("weld"), of("paint"))
    };
    let push = ["crl", "--yes", "--push", "--all"];
    let (legacy, current) = ([0, 0, 2], [0, 2, 2]);
    assert_eq!(counts(&push), (legacy, current));
    assert_eq!(counts(&push), (legacy, current), "a newer CRL takes the place of the former");
    assert_eq!(counts(&[&push[..], &["--trust"]].concat()), ([2, 0, 2], [2, 2, 2]));

    assert_eq!(ca(&["sign-controllers", "--yes", "weld"]).0, Some(0));
    let serial = cli.json(&["ca", "show"]).1[0]["result"]["issued"][0]["serial_number"].as_str().unwrap().to_owned();
    assert_eq!(ca(&["revoke", &serial, "--reason", "cessationOfOperation"]).0, Some(0));
    assert_eq!(ca(&push).0, Some(0));
    let (_, held) = cli.json(&["crl", "list", "--all"]);
    for line in held {
        let crls = line["result"]["crls"].as_array().unwrap();
        let entries: u64 = crls.iter().map(|crl| crl["crl"]["entries"].as_u64().unwrap()).sum();
        assert_eq!((crls.len(), entries), (2, 1), "{line}");
    }
}
