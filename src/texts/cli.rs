//! Sentences of the command line.

use std::fmt::Display;

use super::TextKey;
use crate::model::FirmwareGeneration;

in_every_language! {
    cli:
    fn added(name: impl Display, what: impl Display) -> String;
    fn added_unconfirmed(name: impl Display, address: impl Display) -> String;
    fn trusted(name: impl Display, what: impl Display) -> String;
    fn removed(name: impl Display) -> String;
    fn left_out(name: impl Display, line: impl Display, why: impl Display) -> String;
    fn other_series(name: impl Display, what: impl Display) -> String;
    fn backup(on: bool, folder: impl Display) -> String;
    fn revoked(serials: &[String]) -> String;
    fn starting_virtual(count: usize) -> String;
    fn changes(names: &[&str]) -> String;
    fn authority(issued_to: &str) -> String;
    fn application(issued_to: &str) -> String;
    fn crl_of(issuer: &str) -> String;
    /// What is done to the controllers of a generation; `plan` is a table of several lines.
    fn over_plan(controllers: TextKey, plan: &str) -> String;
    /// The certificate to trust so that a server lets this program in.
    fn own_certificate(file: &str) -> String;
}

/// Over what is done to the controllers of a generation.
pub const fn controllers_with(generation: FirmwareGeneration) -> TextKey {
    match generation {
        FirmwareGeneration::Current => TextKey::CliFirmwareCurrent,
        FirmwareGeneration::Legacy => TextKey::CliFirmwareLegacy,
    }
}
