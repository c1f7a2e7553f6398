//! Sentences about whom controllers trust, in English.

use std::borrow::Cow;

use chrono::Duration;

use super::LANGUAGE;
use crate::jobs::Note;
use crate::model::{CertificateStatus, ErrorCode};
use crate::pki::CertificateFlaw;
use crate::texts::TextKey as T;
use crate::texts::certificates::date;

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

pub fn note(note: &Note) -> Cow<'static, str> {
    match note {
        Note::NeverAccepted { authority, flaw } => never_accepted(*authority, flaw).into(),
        Note::NumberStartsAgain { number, date: on, before, date_before } => {
            starts_again((number, &date(on)), (before, &date(date_before))).into()
        }
        Note::TrustsAllItIssues => "lets in every client with a certificate from it".into(),
        Note::OnlyCompletesAChain => "only completes the chain".into(),
        Note::CrlAmongCertificates => "CRL among certificates".into(),
        Note::ReplacesOlder => "replaces the older one".into(),
        Note::Expired => "expired".into(),
        Note::NotYetValid => "not valid yet".into(),
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
