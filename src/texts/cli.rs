//! Sentences of the command line.

use std::fmt::Display;

use super::TextKey;

in_every_language! {
    cli:
    /// A controller was added, with what was read from it.
    fn added(name: impl Display, what: impl Display) -> String;
    /// A controller was added whose identity is not confirmed.
    fn added_unconfirmed(name: impl Display, address: impl Display) -> String;
    /// The identity of a controller was confirmed.
    fn trusted(name: impl Display, what: impl Display) -> String;
    /// A controller was removed from the list.
    fn removed(name: impl Display) -> String;
    /// A line of a connection list was left out, with the reason.
    fn left_out(name: impl Display, line: impl Display, why: impl Display) -> String;
    /// A controller has another series than was given.
    fn other_series(name: impl Display, what: impl Display) -> String;
    /// Whether backups are kept, and in which folder.
    fn backup(on: bool, folder: impl Display) -> String;
    /// Certificates were revoked.
    fn revoked(serials: &[String]) -> String;
    /// Virtual controllers are being started.
    fn starting_virtual(count: usize) -> String;
    /// The controllers that are changed.
    fn changes(names: &[&str]) -> String;
    /// The certificate of an authority.
    fn authority(issued_to: &str) -> String;
    /// The certificate of an application.
    fn application(issued_to: &str) -> String;
    /// The CRL of an authority.
    fn crl_of(issuer: &str) -> String;
    /// What is done to the controllers of a generation; `plan` is a table of several lines.
    fn over_plan(controllers: TextKey, plan: &str) -> String;
    /// The certificate to trust so that a server lets this program in.
    fn own_certificate(file: &str) -> String;
    /// A CRL of a list in one line. `until`: when the next one is due. `states`: what is wrong with it.
    fn crl_line(id: &str, issuer: &str, revoked: usize, until: Option<String>, states: &[TextKey]) -> String;
    /// A certificate of a list in one line.
    fn certificate_line(thumbprint: &str, issued_to: &str, until: &str) -> String;
    /// A refused client in one line. `times`: when, from where and how often.
    fn refused_line(thumbprint: &str, issued_to: &str, why: &str, times: &str) -> String;
    /// An entry with the name of the list that it is in.
    fn in_list(list: TextKey, entry: &str) -> String;
    /// When only a part of the server log was read. In bytes.
    fn log_read(name: &str, read: u64, size: u64) -> String;
    /// `passwords`: how many were taken over from the keyring.
    fn vault_created(path: &str, passwords: usize) -> String;
    /// The workspace has no vault.
    fn vault_missing(path: &str) -> String;
    /// Passwords are kept in this vault.
    fn vault_used(path: &str) -> String;
    /// The keyring is chosen, and there is a vault.
    fn vault_used_without_keyring(path: &str) -> String;
    /// How many passwords the vault holds.
    fn vault_passwords(count: usize) -> String;
    /// How many passwords were put into the vault.
    fn vault_imported(count: usize) -> String;
    /// The password of a controller was removed from the vault.
    fn vault_forgot(name: &str) -> String;
    /// The vault has no password of this controller.
    fn vault_has_none(name: &str) -> String;
    /// The value of an argument is none of these.
    fn value_known(known: &[&str]) -> String;
    /// The value of a switch is another word.
    fn value_on_or_off() -> String;
    /// The value of an argument is not a time.
    fn value_time() -> String;
    /// Activation keys were typed for several controllers.
    fn keys_of_one() -> String;
    /// A common name was typed for several controllers.
    fn common_name_of_one() -> String;
    /// A CRL is to be pushed, and no controller is named.
    fn push_to_none() -> String;
    /// Two certificates are to be written to one file.
    fn same_name_in_out() -> String;
    /// A thumbprint or the id of a CRL has a wrong form.
    fn digits_needed(text: &str) -> String;
    /// A passphrase was typed twice, and not the same.
    fn entries_differ() -> String;
    /// No passphrase of the vault was given.
    fn vault_passphrase_option() -> String;
    /// A folder of CRLs holds a certificate.
    fn certificate_among_lists(subject: &str) -> String;
    /// A file of CRLs holds certificates only.
    fn only_certificates() -> String;
    /// A command takes things and then controllers, and got only this.
    fn no_controller_after(argument: &str) -> String;
    /// An address of a PLC is to be written, and no value is given.
    fn no_value_after(argument: &str) -> String;
    /// Every controller was asked for, and there is none.
    fn no_controllers() -> String;
    /// The folder has more files than are read.
    fn too_many_files(folder: impl Display, most: usize) -> String;
}

/// Heading of what is done to the controllers with an issuers list, or to those without.
pub const fn controllers_with(has_issuers_list: bool) -> TextKey {
    if has_issuers_list { TextKey::CliFirmwareCurrent } else { TextKey::CliFirmwareLegacy }
}
