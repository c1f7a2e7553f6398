//! What came of connecting to a server as a client, in English.

use super::LANGUAGE;
use crate::jobs::{ConnectRefusal, NotTried, RefusalDetails, VerifyCounts, VerifyFinding};
use crate::model::CertificateStatus;
use crate::session::opcua_client::TokenKind;
use crate::texts::without_stop;

english_texts! { verify:
    Verify: "Verify";
    VerifyTip: "Connect to the OPC UA server as a client would, in every way it offers";
    VerifyTitle: "Verify";
    VerifyWorks: "Everything tried works";
    VerifyFails: "Not everything works";
    VerifyEndpoint: "Endpoint";
    VerdictWorks: "Works";
    VerdictFails: "Fails";
    VerdictNotTried: "Not tried";
    VerifyCertificate: "Server certificate";
    VerifyAccepted: "a careful client accepts it";
    VerifyRefused: "a careful client refuses it";
    VerifyAgain: "Verify again";
    VerifyTrust: "Trust this configurator…";
    VerifyTrustText: "The server lets in only clients whose certificate is in Trusted. That of this configurator is not there; it can be added now, or later from the file in this folder.";
    VerifyLogin: "To try logging in, give a user of the controller. The password is sent encrypted only, and not again once it was refused.";
    TrustConfiguratorTitle: "Trust this configurator";
    ConfirmTrustConfigurator: "The certificate of this configurator is put into Trusted and stays there: with a user of the controller, or where anonymous users are let in, it may connect like any other client.";
    VerifyAfterChanges: "After a change";
    VerifyAfterChangesOn: "Verify when the server has started again";
}

pub fn refusal(refusal: &ConnectRefusal) -> String {
    match refusal {
        ConnectRefusal::NotReachable(why) => {
            format!("Nothing answers there ({why}); check the port, the firewall and the cable")
        }
        ConnectRefusal::TimedOut => "The server does not answer in time; check the network, or start the server again".to_owned(),
        ConnectRefusal::NotOpcUa(why) => format!("The answer is not that of an OPC UA server: {why}"),
        ConnectRefusal::Closed => "The server closes the connection without a reason; look into its log. After many refusals it gives no reason for a minute"
            .to_owned(),
        ConnectRefusal::OwnCertificate(None) => "The server refuses the certificate of this configurator and does not say \
                                   why; most often it is not trusted yet"
            .to_owned(),
        ConnectRefusal::OwnCertificate(Some(RefusalDetails { status: CertificateStatus::Untrusted, .. })) => {
            "The server does not trust the certificate of this configurator; add it to Trusted and verify again"
                .to_owned()
        }
        ConnectRefusal::OwnCertificate(Some(told)) => format!(
            "The server refuses the certificate of this configurator ({}): {}",
            told.status,
            without_stop(&told.explain(LANGUAGE))
        ),
        ConnectRefusal::OtherCertificate => {
            "The server answers with another certificate than the one of the endpoint; no password was sent".to_owned()
        }
        ConnectRefusal::Password => "User name or password is wrong, or the user is locked out for a minute".to_owned(),
        ConnectRefusal::Anonymous => "The server offers login without a user name, but refuses it".to_owned(),
        ConnectRefusal::Busy(name) => {
            format!("The server has no room for another client ({name}); close some, then verify again")
        }
        ConnectRefusal::State(state) => {
            format!("A client can log in, but the server reports the state {state} instead of Running")
        }
        ConnectRefusal::Status { name, reason } if reason.is_empty() => format!("The server refuses it: {name}"),
        ConnectRefusal::Status { name, reason } => format!("The server refuses it: {name}, {reason}"),
    }
}

pub const fn not_tried(why: NotTried) -> &'static str {
    match why {
        NotTried::NoPassword => "Not tried: give a user name and a password to try it",
        NotTried::PasswordRefused => {
            "Not tried: the password was refused before, and trying on would lock the user out"
        }
        NotTried::PasswordInTheClear => "Not tried: the server wants the password without encryption",
        NotTried::OtherToken => "Not tried: only user names and passwords can be tried",
        NotTried::UnknownSecurity => "Not tried: this security policy or mode is not known here",
        NotTried::OtherCertificate => {
            "Not tried: the server does not show the certificate that is selected in the controller"
        }
        NotTried::Chain => "Not tried: the server sends a chain of certificates, which is not supported yet",
    }
}

pub fn verify_finding(finding: &VerifyFinding) -> String {
    match finding {
        VerifyFinding::NotRunning { error: Some(code), .. } => {
            format!("The server does not run: {}", code.explain(LANGUAGE).message)
        }
        VerifyFinding::NotRunning { error: None, .. } => {
            "The server does not run; start it, then verify again".to_owned()
        }
        VerifyFinding::NoAnswer(why) => refusal(why),
        VerifyFinding::NoEndpoints => "The server offers no endpoint".to_owned(),
        VerifyFinding::PolicyMissing(policy) => format!(
            "{policy} is ticked in the basic settings, but the server does not offer it; start the server again"
        ),
        VerifyFinding::PolicyNotTicked(policy) => {
            format!("The server offers {policy}, which is not ticked in the basic settings; start the server again")
        }
        VerifyFinding::TokenMissing(token) => format!(
            "\"{}\" is ticked in the basic settings, but the server does not offer it; start the server again",
            TokenKind::from(*token).text(LANGUAGE)
        ),
        VerifyFinding::TokenNotTicked(token) => format!(
            "The server offers \"{}\", which is not ticked in the basic settings; start the server again",
            TokenKind::from(*token).text(LANGUAGE)
        ),
        VerifyFinding::OtherAddress { url, reachable: true } => {
            format!("The server gives its address as {url}; clients must know it by that name")
        }
        VerifyFinding::OtherAddress { url, reachable: false } => format!(
            "The server gives its address as {url}, which this computer does not reach; clients that follow it fail"
        ),
        VerifyFinding::WeakPolicy(policy) if policy.as_str() == "None" => {
            "None is offered: whoever listens reads everything, and can change it".to_owned()
        }
        VerifyFinding::WeakPolicy(policy) => format!("{policy} is offered, which is deprecated and can be broken"),
        VerifyFinding::NoUsers => {
            "Only users with a password are let in, and the controller has none; add a user".to_owned()
        }
        VerifyFinding::Clock(ahead) => format!(
            "The controller's clock is {} {}; set it, or certificates may be refused",
            span(ahead.num_minutes().unsigned_abs()),
            if *ahead < chrono::TimeDelta::zero() { "behind" } else { "ahead" }
        ),
    }
}

fn span(minutes: u64) -> String {
    match minutes {
        0..120 => format!("{minutes} minutes"),
        120..2880 => format!("{} hours", minutes / 60),
        _ => format!("{} days", minutes / 1440),
    }
}

pub const fn token_kind(kind: TokenKind) -> &'static str {
    match kind {
        TokenKind::Anonymous => "Anonymous",
        TokenKind::UserName => "User name and password",
        TokenKind::Certificate => "User certificate",
        TokenKind::Issued => "Issued token",
    }
}

pub fn verify_counts(counts: VerifyCounts) -> String {
    let VerifyCounts { work, fail, not_tried } = counts;
    format!("{work} work, {fail} do not, {not_tried} not tried")
}

pub fn endpoints_named(names: &[String]) -> String {
    match names {
        names if names.len() > MOST => format!("{} endpoints", names.len()),
        names => names.join(", "),
    }
}

const MOST: usize = 4;
