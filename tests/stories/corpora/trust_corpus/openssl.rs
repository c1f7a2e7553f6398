//! What OpenSSL says of the same files.

use std::path::Path;
use std::process::{Command, Stdio};

use base64::Engine as _;
use chrono::NaiveDate;
use opcua_configurator::model::SecurityPolicy;
use opcua_configurator::pki::PeerRole;

use super::forge::now;
use super::world::{Ask, Built, World};

/// Which OpenSSL judges: that of the library, which an update may change without the command.
#[derive(Debug)]
pub struct Version {
    /// As `openssl version` prints it.
    pub text: String,
    pub released: Option<NaiveDate>,
}

impl Version {
    /// `None` if there is no `openssl`.
    pub fn ask() -> Option<Self> {
        let output = Command::new("openssl").arg("version").stdin(Stdio::null()).stderr(Stdio::null()).output().ok()?;
        output.status.success().then(|| Self::read(&String::from_utf8_lossy(&output.stdout)))
    }

    /// From `OpenSSL 3.0.19 27 Jan 2026 (Library: OpenSSL 3.0.19 27 Jan 2026)`; older ones print no library.
    fn read(text: &str) -> Self {
        let text = text.trim();
        let words: Vec<&str> = text.trim_end_matches(')').split_whitespace().collect();
        let date = words.last_chunk::<3>().map(|date| date.join(" "));
        let released = date.and_then(|date| NaiveDate::parse_from_str(&date, "%d %b %Y").ok());
        Self { text: text.to_owned(), released }
    }
}

#[test]
fn the_version_is_that_of_the_library() {
    let released = |text| Version::read(text).released;
    let date = |year, month, day| NaiveDate::from_ymd_opt(year, month, day);
    assert_eq!(
        released("OpenSSL 3.0.19 27 Jan 2026 (Library: OpenSSL 3.0.22 25 Aug 2026)\n"),
        date(2026, 8, 25),
        "only the library was updated"
    );
    assert_eq!(released("OpenSSL 1.1.1w  11 Sep 2023\n"), date(2023, 9, 11));
    assert_eq!(released("LibreSSL 3.3.6\n"), None);
}

/// Whether `openssl verify` accepts it, and what it prints.
pub fn accepts(world: &World, built: &Built, folder: &Path) -> (bool, String) {
    let write = |file: &str, label: &str, ders: &[&[Vec<u8>]]| -> Option<()> {
        let text: String = ders.iter().flat_map(|ders| ders.iter()).map(|der| pem(label, der)).collect();
        std::fs::write(folder.join(file), &text).expect("the folder is writable");
        (!text.is_empty()).then_some(())
    };
    let mut command = Command::new("openssl");
    command.arg("verify").args(["-attime", &now().timestamp().to_string(), "-no-CApath", "-no-CAstore"]);
    match write("trusted.pem", "CERTIFICATE", &[&built.trusted]) {
        Some(()) => command.args(["-CAfile", "trusted.pem"]),
        None => command.arg("-no-CAfile"),
    };
    if write("untrusted.pem", "CERTIFICATE", &[&built.issuers, &built.sent]).is_some() {
        command.args(["-untrusted", "untrusted.pem"]);
    }
    let lists = match world.ask {
        Ask::AllLists => Some("-crl_check_all"),
        Ask::PartialChain => {
            command.arg("-partial_chain");
            Some("-crl_check")
        }
        Ask::NoLists => None,
    };
    if let Some(lists) = lists {
        command.arg(lists);
        if world.extended_lists {
            command.arg("-extended_crl");
        }
        if write("lists.pem", "X509 CRL", &[&built.lists]).is_some() {
            command.args(["-CRLfile", "lists.pem"]);
        }
    }
    let is_legacy = matches!(world.security_policy, Some(SecurityPolicy::Basic128Rsa15 | SecurityPolicy::Basic256));
    if !is_legacy && !world.policy.allow_sha1 {
        // RSA from 2048 bits up, SHA-2.
        command.args(["-auth_level", "2"]);
    }
    match world.role {
        PeerRole::Client => command.args(["-purpose", "sslclient"]),
        PeerRole::Server => command.args(["-purpose", "sslserver"]),
        PeerRole::Either => &mut command,
    };
    if world.check_policies {
        // anyPolicy, as RFC 5280 §6.1.1 (c) has it where no policy is asked for.
        command.args(["-policy", "2.5.29.32.0"]);
    }
    if let Some(host) = world.host {
        let is_address = host.parse::<std::net::IpAddr>().is_ok();
        command.args([if is_address { "-verify_ip" } else { "-verify_hostname" }, host]);
    }
    write("leaf.pem", "CERTIFICATE", &[std::slice::from_ref(&built.leaf)]);
    let output = command.arg("leaf.pem").current_dir(folder).stdin(Stdio::null()).output().expect("openssl runs");
    let said = String::from_utf8_lossy(&output.stderr).into_owned() + &String::from_utf8_lossy(&output.stdout);
    (output.status.success(), said)
}

fn pem(label: &str, der: &[u8]) -> String {
    let body = base64::engine::general_purpose::STANDARD.encode(der);
    let lines: Vec<&str> = (0..body.len()).step_by(64).map(|at| &body[at..body.len().min(at + 64)]).collect();
    format!("-----BEGIN {label}-----\n{}\n-----END {label}-----\n", lines.join("\n"))
}
