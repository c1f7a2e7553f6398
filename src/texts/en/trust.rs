//! Sentences about whom controllers trust, in English.

use std::borrow::Cow;

use chrono::Duration;

use super::LANGUAGE;
use crate::jobs::TrustNote;
use crate::model::{CertificateStatus, ErrorCode};
use crate::pki::CertificateFlaw;
use crate::texts::TextKey as T;
use crate::texts::certificates::date;

english_texts! { trust:
    ClientCertificates: "Client certificates…";
    ClientCertificatesTip: "Trusted, rejected and issuers: which clients may connect";
    Crl: "CRL…";
    CrlTip: "Certificate revocation lists of the authorities that issued client certificates";
    ActMoveClients: "Move certificates";
    TrustTitle: "Client certificates";
    TrustTrusted: "Trusted";
    TrustRejected: "Rejected";
    TrustIssuers: "Issuers";
    TrustFilter: "Filter by name, issuer, address or number";
    TrustNothingFound: "Nothing matches the filter";
    TrustTrustedEmpty: "Nobody is let in by a certificate yet. Add the certificate of a client, or let a client try to connect: it then appears under Rejected.";
    TrustRejectedEmpty: "No client was refused. One that tries to connect and is not let in appears here by itself.";
    TrustIssuersEmpty: "No authorities. Add the certificates of those that issued the certificates of clients, where these do not send them along.";
    TrustIssuersLegacy: "Firmware before 8.0.0 has no list of issuers. There, add authorities to Trusted.";
    TrustLegacyTrusted: "Firmware before 8.0.0 has no list of issuers; there, authorities go to Trusted";
    TrustFull: "The list is full: delete what is no longer needed first";
    TrustIssuersWhy: "Only for firmware 8.0.0 and later";
    TrustChoose: "Tick something, or click a line first";
    TrustBusy: "Applying the last change…";
    TrustIssuedTo: "Issued to";
    TrustIssuedBy: "Issued by";
    TrustFileName: "File name";
    TrustValidFrom: "Valid from";
    TrustValidUntil: "Valid until";
    TrustThumbprint: "Thumbprint (SHA-1)";
    TrustReason: "Reason";
    TrustAddress: "Address";
    TrustCount: "Times";
    TrustFirstSeen: "First seen";
    TrustLastSeen: "Last seen";
    TrustNotYetValid: "not valid yet";
    TrustNew: "new";
    TrustLive: "Live";
    TrustLiveTip: "What changes in the controller shows here within a second";
    TrustLost: "Connection lost, trying again";
    TrustEnded: "Not up to date";
    TrustAddTo: "Add…";
    TrustTrust: "Trust";
    TrustTrustTip: "Let these clients in from now on";
    TrustReject: "Reject";
    TrustRejectTip: "Move them to Rejected; their clients are disconnected at once";
    TrustUndo: "Undo";
    TrustUndoNothing: "Nothing was changed here that can be taken back";
    TrustTakenBack: "The change was taken back";
    TrustUndoTitle: "Undo the change of trust";
    TrustDetails: "Details…";
    TrustCutTitle: "Disconnected";
    TrustCutNone: "Nobody was disconnected";
    TrustPickLine: "Click a line to see all of it here";
    TrustMovedHere: "put here by a person, has not come since";
    TrustMoveTitle: "Trust anyway?";
    TrustMove: "Move";
    TrustDeleteTitle: "Delete certificates";
    TrustDeleteText: "Clients that are not trusted any more are disconnected at once. The OPC UA server goes on running. The deletion can be taken back until the dialog is closed.";
    TrustDeleteRejected: "They are forgotten until they try again. This cannot be taken back.";
    TrustAddTitle: "Add certificates";
    TrustAddFiles: "Files";
    TrustAddText: "Certificates and chains in any format: DER, PEM, P7B. CRLs in them come along. Several files can be chosen at once, or dropped here.";
    TrustAddRule: "Choose files first";
    TrustLeaveOutRule: "Leave out the files that cannot be used first";
    TrustLeaveOut: "Leave out";
    TrustTooMany: "At most 100 files at once";
    TrustDropHere: "Drop to see where they go; nothing is sent yet";
    TrustReadFile: "Read file";
    TrustGoesTo: "Goes to";
    TrustWhereGoes: "What goes where";
    TrustByKind: "Sort by kind";
    TrustByKindTip: "Clients to Trusted, authorities to Issuers, CRLs to CRL";
    TrustTrustedTip: "Everything to Trusted; authorities that come with the certificate of a client only complete its chain and go to Issuers";
    TrustIssuersTip: "Authorities only";
    TrustCrls: "CRL";
    TrustNothing: "nowhere";
    TrustKindClient: "client";
    TrustKindAuthority: "authority";
    TrustKindCrl: "CRL";
    TrustSkipRepeated: "is in the files twice";
    TrustSkipHeld: "is in the controller already";
    TrustSkipOutdated: "is older than the one in the controller";
    TrustSkipNotAsked: "is not what was asked for";
    TrustOnCurrent: "Firmware 8.0.0 and later";
    TrustOnLegacy: "Firmware before 8.0.0";
    TrustRevokesAtOnce: "Clients whose certificate is revoked are disconnected at once. The OPC UA server goes on running.";
    TrustCertificateTitle: "Certificate";
    TrustSubject: "Subject";
    TrustIssuerFull: "Issuer";
    TrustAlternativeNames: "Alternative names";
    TrustKeyUsages: "Key usages";
    TrustPurposes: "Purposes";
    TrustAuthority: "Authority";
    TrustSha256: "Thumbprint (SHA-256)";
    TrustChain: "Chain";
    TrustChainMissing: "missing: add its certificate to Issuers or Trusted";
    TrustChainRevoked: "revoked";
    TrustChainExpired: "expired";
    TrustChainNotCa: "is no authority";
    TrustChainNoCrl: "no usable CRL";
    TrustChainSent: "only sent by the client";
    TrustCopyPem: "Copy as PEM";
    CrlTitle: "CRL";
    CrlAddTitle: "Add CRL";
    CrlAddText: "CRL files in any format: DER, PEM, or within P7B. Several can be chosen at once, or dropped here.";
    CrlEmpty: "No CRLs. Without one, whether a certificate from an authority was revoked is not known. Add the current CRL of each authority.";
    CrlIssuer: "Issuer";
    CrlThisUpdate: "This update";
    CrlNextUpdate: "Next update";
    CrlEntries: "Revoked";
    CrlNumber: "CRL number";
    CrlHealth: "Health";
    CrlSignature: "Signature";
    CrlGood: "in use";
    CrlUnusable: "cannot be used";
    CrlExpired: "expired, get a new one";
    CrlNotYet: "not valid yet";
    CrlNoIssuer: "its issuer is in no list, no use yet";
    CrlWrongKey: "not signed by the issuer of this name, no use";
    CrlMayNotSign: "its issuer may not sign CRLs, no use";
    CrlNoEnd: "does not say until when it is valid, no use";
    CrlDeleteTitle: "Delete CRLs";
    CrlDeleteText: "The certificates they revoke count as valid again, or as unchecked. Clients that are not let in without them are disconnected at once. The deletion can be taken back until the dialog is closed.";
    CrlRevoked: "Revoked certificates";
    CrlRevokedNone: "It revokes no certificate";
    CrlWithoutTitle: "Authorities without a usable CRL";
    CrlWithoutText: "Whether their certificates were revoked is not known, so clients with one may be refused.";
    ChooseFilesTitle: "Choose files";
    KeyUndo: "Take the last change back, in client certificates and CRLs";
    KeyPanes: "Change to the next list, in client certificates";
    KeySideways: "Left, Right";
}

pub fn how_full(count: usize, limit: Option<usize>) -> String {
    match limit {
        Some(limit) => format!("{count} of {limit}"),
        None => count.to_string(),
    }
}

pub fn full_and_ticked(full: &str, count: usize, hidden: usize) -> String {
    match hidden {
        0 => format!("{full}, {count} ticked"),
        _ => format!("{full}, {count} ticked, {hidden} of them hidden"),
    }
}

pub fn new_clients(count: usize) -> String {
    format!("{count} new")
}

fn certificates(count: usize) -> String {
    match count {
        1 => "1 certificate".to_owned(),
        _ => format!("{count} certificates"),
    }
}

fn crls(count: usize) -> String {
    match count {
        1 => "1 CRL".to_owned(),
        _ => format!("{count} CRLs"),
    }
}

pub fn trust_added(count: usize) -> String {
    format!("{count} added")
}

pub fn certificates_deleted(list: T, count: usize) -> String {
    format!("{} deleted from {}", certificates(count), list.text(LANGUAGE))
}

pub fn crls_deleted(count: usize) -> String {
    format!("{} deleted", crls(count))
}

pub fn certificates_moved(from: T, to: T, count: usize) -> String {
    format!("{} moved from {} to {}", certificates(count), from.text(LANGUAGE), to.text(LANGUAGE))
}

pub fn without_crl(names: &str) -> String {
    format!("{}: {names}", T::CrlWithoutTitle.text(LANGUAGE))
}

pub fn cut(issued_to: &str, address: &str, status: CertificateStatus) -> String {
    format!("{issued_to} ({address}): {}", status.reason(LANGUAGE))
}

pub fn and_more(count: usize) -> String {
    format!("and {count} more")
}

pub fn clock_off(ahead: Duration) -> String {
    let (minutes, ahead) = (ahead.num_minutes().abs(), ahead > Duration::zero());
    let amount = match minutes {
        0..120 => format!("{minutes} minutes"),
        120..2880 => format!("{} hours", minutes / 60),
        _ => format!("{} days", minutes / 1440),
    };
    match ahead {
        true => {
            format!("The clock of the controller is {amount} ahead of this computer's. It judges validity by its own.")
        }
        false => {
            format!("The clock of the controller is {amount} behind this computer's. It judges validity by its own.")
        }
    }
}

pub fn refused_times(address: &str, count: u64, first: &str, last: &str) -> String {
    match count {
        1 => format!("From {address}, once, {last}"),
        _ => format!("From {address}, {count} times, first {first}, last {last}"),
    }
}

pub fn file_holds(certificate_count: usize, crl_count: usize) -> String {
    let parts =
        [(certificate_count > 0).then(|| certificates(certificate_count)), (crl_count > 0).then(|| crls(crl_count))];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

pub fn on_firmware(firmware: T, error: ErrorCode) -> String {
    format!("{}: {}", firmware.text(LANGUAGE), error.explain(LANGUAGE).message)
}

pub fn covers(health: T, authority: &str) -> String {
    format!("{} (covers {authority})", health.text(LANGUAGE))
}

pub fn note(note: &TrustNote) -> Cow<'static, str> {
    match note {
        TrustNote::NeverAccepted { authority, flaw } => never_accepted(*authority, flaw).into(),
        TrustNote::NumberStartsAgain { number, date: on, before, date_before } => {
            starts_again((number, &date(on)), (before, &date(date_before))).into()
        }
        TrustNote::TrustsAllItIssues => "lets in every client with a certificate from it".into(),
        TrustNote::OnlyCompletesAChain => "only completes the chain".into(),
        TrustNote::CrlAmongCertificates => "CRL among certificates".into(),
        TrustNote::ReplacesOlder => "replaces the older one".into(),
        TrustNote::Expired => "expired".into(),
        TrustNote::NotYetValid => "not valid yet".into(),
    }
}

fn starts_again((number, date): (&str, &str), (before, date_before): (&str, &str)) -> String {
    format!(
        "its number starts again: {number} of {date}, after {before} of {date_before}; ask the authority whether it was \
         set up anew"
    )
}

fn never_accepted(authority: bool, flaw: &CertificateFlaw) -> String {
    let (reason, remedy) = (flaw.reason(LANGUAGE), flaw.remedy(LANGUAGE));
    if authority {
        format!("no client with a certificate from it is ever let in: {reason}; {remedy}")
    } else {
        format!("no client is ever let in with it: {reason}; {remedy}")
    }
}
