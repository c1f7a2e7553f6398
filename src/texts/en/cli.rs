//! Sentences of the command line, in English.

use std::fmt::Display;

use super::LANGUAGE;
use crate::texts::TextKey;

pub fn added(name: impl Display, what: impl Display) -> String {
    format!("Added {name}: {what}")
}

pub fn added_unconfirmed(name: impl Display, address: impl Display) -> String {
    format!("Added {name}: {address}; confirm its identity with \"controllers trust\"")
}

pub fn trusted(name: impl Display, what: impl Display) -> String {
    format!("Trusted {name}: {what}")
}

pub fn removed(name: impl Display) -> String {
    format!("Removed {name}")
}

pub fn left_out(name: impl Display, line: impl Display, why: impl Display) -> String {
    format!("Left out {name}, line {line}: {why}")
}

pub fn other_series(name: impl Display, what: impl Display) -> String {
    format!("{name}: the controller says that it is {what}")
}

pub fn backup(on: bool, folder: impl Display) -> String {
    format!("Backup is {}; folder {folder}", if on { "on" } else { "off" })
}

pub fn revoked(serials: &[String]) -> String {
    format!("Revoked: {}\nGive the new CRL to every controller: ca crl --push", serials.join(", "))
}

pub fn starting_virtual(count: usize) -> String {
    format!("Starting {count} virtual controllers…")
}

pub fn changes(names: &[&str]) -> String {
    format!("This changes {}:", names.join(", "))
}

pub fn authority(issued_to: &str) -> String {
    format!("authority {issued_to}")
}

pub fn application(issued_to: &str) -> String {
    format!("application {issued_to}")
}

pub fn crl_of(issuer: &str) -> String {
    format!("CRL of {issuer}")
}

pub fn over_plan(controllers: TextKey, plan: &str) -> String {
    format!("{}:\n{plan}", controllers.text(LANGUAGE))
}

pub fn own_certificate(file: &str) -> String {
    format!("The certificate of this configurator is {file}; --trust-me puts it into Trusted")
}
