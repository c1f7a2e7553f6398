//! Sentences about the small CA, in English.

use crate::model::CertificateSummary;
use crate::texts::Zone;

english_texts! { authority:
    CertificateAuthority: "Certificate authority…";
    CertificateAuthorityTip: "Sign certificate requests with an authority of your own";
    ActSignAndImport: "Sign and import";
    ActSendCrl: "Send CRL";
    CaTitle: "Certificate authority";
    CaNone: "This workspace has no certificate authority yet";
    CaNoneText: "A certificate authority (CA) of your own signs the certificates of controllers and clients, so that everybody only has to trust one certificate. Its key stays on this computer, protected by a passphrase.";
    CaCreate: "Create CA…";
    CaRestore: "Restore backup…";
    CaCreateTitle: "Create CA";
    CaRestoreTitle: "Restore CA from backup";
    CaSignTicked: "Sign ticked controllers…";
    CaSignTickedTip: "Make or read the CSR of each ticked controller, sign it and import the certificate";
    CaSignTitle: "CA: sign and import";
    CaSignFile: "Sign CSR file…";
    CaSignFileTitle: "Sign CSR file";
    CaRevoke: "Revoke…";
    CaRevokeTitle: "Revoke certificates";
    CaPublish: "Publish CRL…";
    CaCrlTitle: "CA: publish CRL";
    CaBackUp: "Back up…";
    CaBackUpTitle: "Back up CA";
    CaIssued: "Issued certificates";
    CaIssuedNone: "No certificate has been issued yet";
    CaProfile: "For";
    CaServer: "Server";
    CaClient: "Client";
    CaValid: "Valid";
    CaExpired: "Expired";
    CaRevoked: "Revoked";
    CaCrl: "CRL";
    CaTickIssued: "Tick certificates first";
    CaNameHint: "For example Plant 3 CA";
    CaIntermediate: "With an intermediate CA that signs";
    CaIntermediateTip: "The root then only signs the intermediate, and its key (root.key) can be kept elsewhere.";
    CaKeep: "Keep the passphrase safe. Without it nothing can be signed or revoked, and nobody can restore it.";
    CaPassphraseAgain: "Passphrase again";
    CaPassphrasesDiffer: "The two passphrases differ";
    CaPassphraseRule: "At least 8 characters";
    CaPassphraseNeeded: "Enter the passphrase of the CA";
    CaSignText: "The server certificates of these controllers are replaced by ones the CA signs. A CSR is made where there is none; below firmware 8.0.0 that makes the present CA-signed certificate invalid at once.";
    CaNewKey: "Have the controllers make new keys";
    CaRenew: "Renew certificates that are still valid";
    CaAcceptWarnings: "Import even where some clients may complain";
    CaSignFileText: "The names in the request are taken over after a check, nothing else.";
    CaRequest: "Request";
    CaRevokeText: "Revoked certificates cannot be made valid again. Clients and controllers learn of it from the new CRL, so publish it to them afterwards.";
    CaReason: "Reason";
    CaPublishText: "A new CRL with a new date and number is made and saved in the CA folder.";
    CaPush: "Send it to the ticked controllers, and the CA certificate to their issuers list";
    CaPushNone: "Tick controllers to send it to them as well";
    CaTrust: "Trust the CA there: every client with a certificate from it is let in";
    CaBackUpText: "Keys, certificates and database in one file, which the passphrase of the CA opens.";
    CaRestoreText: "The backup is opened with the passphrase the CA had when it was made.";
    CaSign: "Sign";
    CaPublishNow: "Publish";
    CaRevokeNow: "Revoke";
    CaBackUpNow: "Back up";
    CaRestoreNow: "Restore";
    CaCreateNow: "Create";
    CaWorking: "Working…";
    ReasonUnspecified: "Not specified";
    ReasonKeyCompromise: "Key compromised";
    ReasonCaCompromise: "CA compromised";
    ReasonAffiliationChanged: "Name or owner changed";
    ReasonSuperseded: "Replaced by another certificate";
    ReasonCessation: "No longer in operation";
    ReasonPrivilegeWithdrawn: "Permission withdrawn";
}

pub fn authority(summary: &CertificateSummary, zone: Zone) -> String {
    let CertificateSummary { issued_to, issued_by, not_after, key_bits, .. } = summary;
    let until = zone.date(*not_after);
    if issued_to == issued_by {
        format!("{issued_to}, {key_bits} bits, valid until {until}")
    } else {
        format!("{issued_to}, signed by {issued_by}, {key_bits} bits, valid until {until}")
    }
}

pub fn crl_state(revoked: usize, number: u64, next: Option<String>) -> String {
    let next = next.unwrap_or_else(|| "—".to_owned());
    format!("{revoked} revoked, number {number}, next one due by {next}")
}

pub fn ca_saved(path: &std::path::Path) -> String {
    format!("Saved as {}", path.display())
}

pub fn request(common_name: &str, bits: u16) -> String {
    format!("{common_name}, {bits} bits")
}
