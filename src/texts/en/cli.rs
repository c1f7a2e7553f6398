//! Sentences of the command line, in English.

use std::fmt::Display;

use super::LANGUAGE;
use crate::texts::TextKey;

english_texts! { cli:
    // headings of tables, in capitals
    HeadingActivated: "ACTIVATED";
    HeadingAddress: "ADDRESS";
    HeadingBits: "BITS";
    HeadingCa: "CA";
    HeadingCertificate: "CERTIFICATE";
    HeadingCertificates: "CERTIFICATES";
    HeadingCommonName: "COMMON NAME";
    HeadingController: "CONTROLLER";
    HeadingCrls: "CRLS";
    HeadingCrlNumber: "CRL NUMBER";
    HeadingDisconnected: "DISCONNECTED";
    HeadingEndpoint: "ENDPOINT";
    HeadingExpiry: "EXPIRY";
    HeadingFile: "FILE";
    HeadingFirmware: "FIRMWARE";
    HeadingGoesTo: "GOES TO";
    HeadingIdentity: "IDENTITY";
    HeadingIssuedBy: "ISSUED BY";
    HeadingIssuedTo: "ISSUED TO";
    HeadingIssuers: "ISSUERS";
    HeadingLicence: "LICENCE";
    HeadingLog: "LOG";
    HeadingName: "NAME";
    HeadingNextCrlBy: "NEXT CRL BY";
    HeadingNote: "NOTE";
    HeadingPolicies: "POLICIES";
    HeadingPort: "PORT";
    HeadingProfile: "PROFILE";
    HeadingRejected: "REJECTED";
    HeadingResult: "RESULT";
    HeadingRetrieved: "RETRIEVED";
    HeadingRevision: "REVISION";
    HeadingRevoked: "REVOKED";
    HeadingSerial: "SERIAL";
    HeadingStartup: "STARTUP";
    HeadingStatus: "STATUS";
    HeadingThumbprint: "THUMBPRINT";
    HeadingTokens: "TOKENS";
    HeadingTrusted: "TRUSTED";
    HeadingType: "TYPE";
    HeadingUsers: "USERS";
    HeadingUserToken: "USER TOKEN";
    HeadingVersion: "VERSION";
    HeadingWarnings: "WARNINGS";
    HeadingWhat: "WHAT";

    // words and sentences
    CliAddUnconfirmed: "To add it now and confirm its identity later, use --unconfirmed.";
    CliVaultKeeps: "The vault is not open: passwords in it stay; \"vault status\" lists them, \"vault forget\" deletes them.";
    CliStopping: "Stopping after the step in hand; press Ctrl-C again to leave it unfinished…";
    CliGoOn: "Go on? [y/N]";
    CliClientsMayComplain: "clients may complain about what is listed above";
    CliFirmwareCurrent: "Controllers with firmware 8.0.0 and later";
    CliFirmwareLegacy: "Controllers with firmware below 8.0.0";
    CliError: "error";
    CliWarning: "warning";
    CliCertificateAccepted: "A careful client accepts the server's certificate";
    CliWindowBroughtToFront: "The workspace is open already; its window was brought to the front.";
    CliAskCaPassphrase: "Passphrase of the CA";
    CliAskVaultPassphrase: "Passphrase of the vault";
    CliAskNewVaultPassphrase: "New passphrase of the vault";
    CliAskAgain: "The same again";
    CliAskLogPassword: "Password for the server log (199532 in the manual)";
    CliProgramError: "The program ends because of an error in it";
}

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

pub fn crl_line(id: &str, issuer: &str, revoked: usize, until: Option<String>, states: &[TextKey]) -> String {
    let states: String = states.iter().map(|state| format!(", {}", state.text(LANGUAGE))).collect();
    format!("{id} {issuer}: {revoked} revoked, next by {}{states}", until.as_deref().unwrap_or("—"))
}

pub fn certificate_line(thumbprint: &str, issued_to: &str, until: &str) -> String {
    format!("{thumbprint} {issued_to} until {until}")
}

pub fn refused_line(thumbprint: &str, issued_to: &str, why: &str, times: &str) -> String {
    format!("{thumbprint} {issued_to}: {why} {times}")
}

pub fn in_list(list: TextKey, entry: &str) -> String {
    format!("{}: {entry}", list.text(LANGUAGE))
}

pub fn log_read(name: &str, read: u64, size: u64) -> String {
    format!("{name}: {read} of {size} bytes of the log were read")
}

pub fn vault_created(path: &str, passwords: usize) -> String {
    format!("Created {path}; passwords taken over from the keyring: {passwords}")
}

pub fn vault_missing(path: &str) -> String {
    format!("There is no vault at {path}")
}

pub fn vault_used(path: &str) -> String {
    format!("The vault {path} is used")
}

pub fn vault_used_without_keyring(path: &str) -> String {
    format!("The vault {path} is used where there is no keyring; see \"vault on\"")
}

pub fn vault_passwords(count: usize) -> String {
    format!("Passwords: {count}")
}

pub fn vault_imported(count: usize) -> String {
    format!("Passwords put into the vault: {count}")
}

pub fn vault_forgot(name: &str) -> String {
    format!("Deleted the password of {name} from the vault")
}

pub fn vault_has_none(name: &str) -> String {
    format!("The vault has no password of {name}")
}

pub fn value_known(known: &[&str]) -> String {
    format!("known are {}", known.join(", "))
}

pub fn value_on_or_off() -> String {
    "it is neither on nor off".to_owned()
}

pub fn value_time() -> String {
    "it is not a time in RFC 3339, such as 2026-01-31T12:00:00Z".to_owned()
}

pub fn keys_of_one() -> String {
    "use --file for several controllers".to_owned()
}

pub fn common_name_of_one() -> String {
    "a common name can be given for one controller only".to_owned()
}

pub fn push_to_none() -> String {
    "--push needs names or --all".to_owned()
}

pub fn same_name_in_out() -> String {
    "two certificates would get the same name in --out".to_owned()
}

pub fn digits_needed(text: &str) -> String {
    format!("{text}: 40 hexadecimal digits are needed")
}

pub fn entries_differ() -> String {
    "the two entries differ".to_owned()
}

pub fn vault_passphrase_option() -> String {
    "the file is named with --vault-passphrase-file".to_owned()
}

pub fn certificate_among_lists(subject: &str) -> String {
    format!("--crls: there is a certificate among the revocation lists, {subject}")
}

pub fn only_certificates() -> String {
    "it holds certificates and no CRL".to_owned()
}

pub fn no_controller_after(argument: &str) -> String {
    format!("none is named after \"{argument}\"; name controllers, or give --all")
}

pub fn no_value_after(argument: &str) -> String {
    format!("no value follows \"{argument}\"")
}

pub fn no_controllers() -> String {
    "the list of controllers is empty".to_owned()
}

pub fn too_many_files(folder: impl Display, most: usize) -> String {
    format!("{folder}: more than {most} files, or too deep")
}
