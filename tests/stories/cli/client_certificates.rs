//! Client certificate lists and CRLs through the real command line.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use opcua_configurator::pki::Bundle;
use serde_json::{Value, json};

use crate::common::clients::{self, Authority, Client, TestApplication};
use crate::common::command_line_test::{CommandLineTest, assert_error, walk};

fn write(cli: &CommandLineTest, name: &str, bytes: impl AsRef<[u8]>) -> String {
    fs::write(cli.folder.path().join(name), bytes).unwrap();
    cli.file(name)
}

/// A desk with one current controller, "weld", and one legacy one, "paint".
fn mixed() -> CommandLineTest {
    let cli = CommandLineTest::with(2, &["--seed", "3", "--firmware", "mixed"]);
    let legacy = |index: &usize| cli.ready[*index]["firmware"].as_str().unwrap().starts_with('7');
    let (old, new) = if legacy(&0) { (0, 1) } else { (1, 0) };
    assert!(legacy(&old) && !legacy(&new), "{:?}", cli.ready);
    assert_eq!((cli.add(new, "weld").0, cli.add(old, "paint").0), (Some(0), Some(0)));
    cli
}

/// Starts the OPC UA server of "weld", for anonymous users.
fn serve(cli: &CommandLineTest) {
    let words = ["cert", "self-signed", "--country", "jp", "--state", "N", "--locality", "S", "--organisation", "E"];
    let (code, lines) = cli.json(&[&words[..], &["--years", "5", "--yes", "weld"]].concat());
    assert_eq!(code, Some(0), "{lines:?}");
    let settings = ["settings", "set", "--tokens", "anonymous", "--startup", "auto", "--yes", "weld"];
    assert_eq!(cli.json(&settings).0, Some(0));
    assert_eq!(cli.json(&["start", "weld"]).0, Some(0));
}

/// RFC 5280 §4.2.1.9 makes an authority, with any subject alternative name: it completes the client's chain and
/// lets in no other client.
#[test]
fn an_authority_with_a_uri_that_comes_with_a_client_lets_in_no_stranger() {
    let cli = CommandLineTest::with(1, &["--seed", "3", "--firmware", "current"]);
    assert_eq!(cli.add(0, "weld").0, Some(0));
    serve(&cli);
    let ca = Authority::with_uri("NO Plant CA");
    let (client, stranger) = (ca.client("client", 7), ca.client("stranger", 8));
    let bundle =
        Bundle { certificates: vec![client.certificate.clone(), ca.certificate.clone()], crls: vec![ca.crl(1, &[])] };
    let chain = write(&cli, "nochain-crl.p7b", clients::p7b(&bundle));
    let authority = write(&cli, "ca.der", ca.certificate.der());

    let (code, lines) = cli.json(&["clients", "add", "--list", "trusted", &authority, "weld"]);
    assert_eq!(code, Some(2), "nobody agreed to let in every client of it");
    assert_error(&lines, "not-confirmed");
    let (code, lines) = cli.json(&["clients", "add", "--yes", &chain, "weld"]);
    let counts = ["trusted", "issuers", "crls"].map(|list| lines[0]["result"][list].clone());
    assert_eq!((code, counts), (Some(0), [json!(1), json!(1), json!(1)]), "{lines:?}");
    let (_, lines) = cli.json(&["clients", "list", "--list", "issuers", "weld"]);
    assert_eq!(lines[0]["result"]["issuers"][0]["certificate"]["thumbprint"], json!(ca.certificate.thumbprint_sha1()));

    let runtime = tokio::runtime::Runtime::new().unwrap();
    let endpoint = cli.ready[0]["opcua"].as_str().unwrap().to_owned();
    runtime.block_on(async {
        let inside = Client::connect(&endpoint, &client).await.expect("trusted by itself");
        assert!(Client::connect(&endpoint, &stranger).await.is_err(), "nobody named it");
        inside.close().await;
    });
    let (_, lines) = cli.json(&["clients", "list", "--list", "rejected", "weld"]);
    let refused = &lines[0]["result"]["rejected"][0];
    assert_eq!(
        (&refused["status"], &refused["certificate"]["issued_to"]),
        (&json!("BadCertificateUntrusted"), &json!("stranger"))
    );

    // Without its CRL, the authority is named as one that lacks it.
    let id = bundle.crls[0].id();
    assert_eq!(cli.json(&["crl", "remove", &id, "weld", "--yes"]).0, Some(0));
    let (_, lines) = cli.json(&["crl", "list", "weld"]);
    assert_eq!(lines[0]["result"]["without_crl"], json!([ca.certificate.thumbprint_sha1()]));
}

#[test]
fn certificates_are_added_listed_and_removed_in_many_controllers() {
    let cli = mixed();
    let (one, ca) = (TestApplication::new("one"), Authority::new("Plant CA"));
    let issued = ca.client("issued", 7);
    let one_file = write(&cli, "one.pem", one.certificate.to_pem());
    let bundle =
        Bundle { certificates: vec![issued.certificate.clone(), ca.certificate.clone()], crls: vec![ca.crl(1, &[])] };
    let chain = write(&cli, "chain.p7b", clients::p7b(&bundle));

    let (code, lines) = cli.json(&["clients", "add", "--list", "trusted", &one_file, "--all"]);
    assert_eq!((code, lines.len()), (Some(0), 2), "{lines:?}");
    assert!(lines.iter().all(|line| line["result"]["trusted"] == 1), "{lines:?}");
    let (code, lines) = cli.json(&["clients", "add", &one_file, "weld"]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "duplicate-certificate");

    // A chain means something else to each generation: without a terminal, a person must have agreed.
    let (code, lines) = cli.json(&["clients", "add", &chain, "--all"]);
    assert_eq!(code, Some(2));
    assert_error(&lines, "not-confirmed");
    let (code, lines) = cli.json(&["clients", "add", &chain, "--all", "--yes"]);
    assert_eq!(code, Some(0), "{lines:?}");
    let counts = |line: &Value| ["trusted", "issuers", "crls"].map(|list| line["result"][list].as_u64().unwrap());
    assert_eq!((counts(&lines[0]), counts(&lines[1])), ([3, 0, 1], [2, 1, 1]));

    let (_, lines) = cli.json(&["clients", "list", "weld"]);
    let weld = &lines[0]["result"];
    assert_eq!(weld["issuers"][0]["certificate"]["thumbprint"], json!(ca.certificate.thumbprint_sha1()));
    assert_eq!(weld["trusted"][0]["file_name"], "one.pem");
    assert_eq!(weld["rejected"], json!([]));
    let table = cli.run(&["clients", "list", "--list", "issuers", "weld"]);
    assert!(table.stdout.contains("Plant CA until"), "{}", table.stdout);

    let lower = one.thumbprint().to_lowercase();
    let (code, lines) = cli.json(&["clients", "remove", &lower, "--all"]);
    assert_eq!(code, Some(2));
    assert_error(&lines, "not-confirmed");
    let (code, lines) = cli.json(&["clients", "remove", &lower, "--all", "--yes"]);
    assert_eq!((code, &lines[0]["result"]["disconnected"]), (Some(0), &json!([])), "{lines:?}");
    let (code, lines) = cli.json(&["clients", "remove", &lower, "--all", "--yes"]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "not-in-list");
    let (code, lines) = cli.json(&["clients", "remove", "not-hex", "--all", "--yes"]);
    assert_eq!(code, Some(2));
    assert_error(&lines, "not-in-list");
}

#[test]
fn crls_are_added_replaced_listed_with_their_health_and_removed() {
    let cli = mixed();
    let ca = Authority::new("Plant CA");
    let (first, second) = (ca.crl(1, &[]), ca.crl(2, &[&ca.client("gone", 9)]));
    let first_file = write(&cli, "first.crl", first.der());
    let second_file = write(&cli, "second.crl", second.der());
    let ca_file = write(&cli, "ca.der", ca.certificate.der());
    let (code, lines) = cli.json(&["crl", "add", &first_file, "--all", "--yes"]);
    assert_eq!((code, lines.len()), (Some(0), 2), "{lines:?}");
    let (_, lines) = cli.json(&["crl", "list", "weld"]);
    let crl = &lines[0]["result"]["crls"][0];
    assert_eq!((&crl["health"]["issuer"], &crl["health"]["dates"]), (&json!("missing"), &json!("current")));
    assert!(cli.run(&["crl", "list", "weld"]).stdout.contains("its issuer is in no list"));
    assert_eq!(cli.json(&["clients", "add", "--list", "issuers", &ca_file, "weld"]).0, Some(0));

    let (code, _) = cli.json(&["crl", "add", &second_file, "weld", "--yes"]);
    assert_eq!(code, Some(0));
    let (_, lines) = cli.json(&["crl", "list", "weld"]);
    let crls = lines[0]["result"]["crls"].as_array().unwrap();
    assert_eq!(crls.len(), 1);
    assert_eq!((&crls[0]["crl"]["id"], &crls[0]["crl"]["entries"]), (&json!(second.id()), &json!(1)));
    let held = json!({ "held": { "thumbprint": ca.certificate.thumbprint_sha1() } });
    assert_eq!((&crls[0]["health"]["issuer"], &lines[0]["result"]["without_crl"]), (&held, &json!([])));
    let (code, lines) = cli.json(&["crl", "add", &first_file, "weld", "--yes"]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "crl-outdated");
    let (code, lines) = cli.json(&["crl", "add", &second_file, "weld", "--yes"]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "duplicate-crl");
    let (code, lines) = cli.json(&["crl", "add", &second_file, "weld"]);
    assert_eq!((code, &lines[0]["error"]["code"]), (Some(2), &json!("not-confirmed")));
    let (code, lines) = cli.json(&["crl", "remove", &second.id(), "weld", "--yes"]);
    assert_eq!((code, &lines[0]["result"]["crls"]), (Some(0), &json!(0)), "{lines:?}");
    let (code, lines) = cli.json(&["crl", "remove", &second.id(), "weld", "--yes"]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "not-in-list");
}

#[test]
fn a_file_that_is_no_good_makes_the_request_wrong() {
    let cli = mixed();
    let one = TestApplication::new("one");
    let good = write(&cli, "good.der", one.certificate.der());
    let cut = write(&cli, "cut.der", &one.certificate.der()[..one.certificate.der().len() - 3]);
    let empty = write(&cli, "empty.der", "");
    let key = write(&cli, "key.pem", "-----BEGIN PRIVATE KEY-----\nAAAA\n-----END PRIVATE KEY-----\n");
    for bad in [&cut, &empty, &key, &cli.file("password"), &cli.file("nowhere")] {
        for command in [&["clients", "add"][..], &["crl", "add"]] {
            let (code, lines) = cli.json(&[command, &[&good, bad, "--all", "--yes"]].concat());
            assert_eq!(code, Some(2), "{bad} {lines:?}");
            assert!(!lines[0]["error"]["code"].as_str().unwrap().is_empty());
        }
    }
    // Nothing is sent where nothing is of the kind.
    for bad in [&good, &cut, &cli.file("password")] {
        let (code, lines) = cli.json(&["crl", "add", bad, "--all", "--yes"]);
        assert_eq!((code, lines.len()), (Some(2), 1), "{lines:?}");
        assert_error(&lines, "bad-crl");
    }
    let (code, lines) = cli.json(&["clients", "add", "--list", "issuers", &good, "--all"]);
    assert_eq!(code, Some(1));
    assert_eq!(
        (&lines[0]["error"]["code"], &lines[1]["error"]["code"]),
        (&json!("firmware-too-old"), &json!("not-an-authority"))
    );
    let (_, lines) = cli.json(&["info", "--all"]);
    assert!(lines.iter().all(|line| line["result"]["revision"] == 1), "nothing was changed: {lines:?}");
}

/// RFC 5280 lets everything into a list; that it is of no use is said first, as for an expired certificate.
#[test]
fn what_no_client_is_ever_let_in_with_is_said_before_it_is_added() {
    let cli = mixed();
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/15-never-admitted");
    for (file, words) in [
        ("self-ec.der", "its key is not an RSA key"),
        ("self-k1024.der", "its RSA key has 1024 bits"),
        ("self-no-ku.der", "it does not say what its key may be used for"),
        ("self-eku-server-only.der", "its extended key usage is not for clients"),
    ] {
        let file = cases.join(file).display().to_string();
        for list in [&[][..], &["--list", "trusted"]] {
            let said = cli.run(&[&["clients", "add"], list, &[&file, "weld"]].concat());
            assert_eq!(said.code, Some(2), "{}", said.stderr);
            let words = format!("no client is ever let in with it: {words}");
            assert!(said.stderr.contains(&words), "no {words:?} in {}", said.stderr);
        }
    }
    let elliptic = cases.join("self-ec.der").display().to_string();
    assert_eq!(cli.json(&["clients", "add", "--yes", &elliptic, "weld"]).0, Some(0), "who agrees may add it");
}

#[test]
fn a_refused_client_is_remembered_by_a_killed_controller_and_can_be_trusted() {
    let data = tempfile::tempdir().unwrap();
    let folder = data.path().display().to_string();
    let stranger = TestApplication::new("stranger");
    let runtime = tokio::runtime::Runtime::new().unwrap();
    let knock = |cli: &CommandLineTest| {
        let endpoint = cli.ready[0]["opcua"].as_str().unwrap().to_owned();
        runtime.block_on(async { Client::connect(&endpoint, &stranger).await })
    };
    {
        let cli = CommandLineTest::with(1, &["--seed", "3", "--firmware", "current", "--data", &folder]);
        assert_eq!(cli.add(0, "weld").0, Some(0));
        serve(&cli);
        assert!(knock(&cli).is_err());
        let (_, lines) = cli.json(&["clients", "list", "--list", "rejected", "weld"]);
        let seen = &lines[0]["result"]["rejected"][0];
        assert_eq!((&seen["status"], &seen["address"]), (&json!("BadCertificateUntrusted"), &json!("127.0.0.1")));
        assert_eq!(seen["certificate"]["thumbprint"], json!(stranger.thumbprint()));
        let begun = Instant::now();
        while !walk(data.path()).iter().any(|file| file.ends_with("rejected.json")) {
            assert!(begun.elapsed() < Duration::from_secs(60), "never written");
            std::thread::sleep(Duration::from_millis(20));
        }
        // Dropped, the desk kills its controllers.
    }
    let cli = CommandLineTest::with(1, &["--seed", "3", "--firmware", "current", "--data", &folder]);
    assert_eq!(cli.add(0, "weld").0, Some(0));
    let table = cli.run(&["clients", "list", "--list", "rejected", "weld"]);
    for said in ["stranger: ", "(BadCertificateUntrusted)", "From 127.0.0.1"] {
        assert!(table.stdout.contains(said), "no {said} in {}", table.stdout);
    }
    // One that is of no use even when it is trusted is trusted only by who agrees.
    let weak = TestApplication::sign_only("weak");
    let endpoint = cli.ready[0]["opcua"].as_str().unwrap().to_owned();
    let knock_weakly = || runtime.block_on(async { Client::connect(&endpoint, &weak).await }).map(drop);
    assert!(knock_weakly().is_err());
    let trust_weak = ["clients", "trust", &weak.thumbprint(), "weld"];
    let (code, lines) = cli.json(&trust_weak);
    assert_eq!(code, Some(1), "{lines:?}");
    assert_error(&lines, "not-confirmed");
    let said = cli.run(&trust_weak);
    assert_eq!(said.code, Some(2), "{}", said.stderr);
    assert!(said.stderr.contains("no client is ever let in with it: its key may not be used for nonRepudiation"));
    assert_eq!(cli.json(&[&trust_weak[..], &["--yes"]].concat()).0, Some(0));
    assert!(knock_weakly().is_err(), "as was said");
    let (_, lines) = cli.json(&["clients", "list", "--list", "rejected", "weld"]);
    let refused = lines[0]["result"]["rejected"].as_array().unwrap();
    let refused = refused.iter().find(|one| one["certificate"]["issued_to"] == "weak").unwrap();
    assert_eq!(
        (&refused["status"], &refused["cause"]["flaw"]),
        (&json!("BadCertificateUseNotAllowed"), &json!("key-usage-lacks"))
    );
    assert_eq!(cli.json(&["clients", "remove", &weak.thumbprint(), "weld", "--yes"]).0, Some(0));
    let (code, lines) = cli.json(&["clients", "trust", &stranger.thumbprint(), "weld"]);
    assert_eq!((code, &lines[0]["result"]["trusted"]), (Some(0), &json!(1)), "{lines:?}");
    assert_eq!(lines[0]["result"]["rejected"], 0);
    let inside = knock(&cli).expect("trusted now");
    let (code, lines) = cli.json(&["clients", "remove", &stranger.thumbprint(), "weld", "--yes"]);
    assert_eq!(code, Some(0), "{lines:?}");
    let gone = &lines[0]["result"]["disconnected"][0];
    assert_eq!((&gone["issued_to"], &gone["status"]), (&json!("stranger"), &json!("BadCertificateUntrusted")));
    runtime.block_on(inside.ended());
}
