//! What OpenSSL says of the same files.

use std::path::Path;
use std::process::{Command, Stdio};

use base64::Engine as _;
use opcua_configurator::model::SecurityPolicy;
use opcua_configurator::pki::Role;

use super::forge::now;
use super::world::{Ask, Built, World};

pub fn is_there() -> bool {
    let version = Command::new("openssl").arg("version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    version.is_ok_and(|status| status.success())
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
        Role::Client => command.args(["-purpose", "sslclient"]),
        Role::Server => command.args(["-purpose", "sslserver"]),
        Role::Either => &mut command,
    };
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
