//! Sentences with values filled in, in English.

use super::LANGUAGE;
use crate::jobs::JobSummary;
use crate::model::{CertificateSummary, FirmwareVersion};
use crate::texts::{TextKey as T, Zone, byte_count};

fn s(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}

pub fn controllers(count: usize) -> String {
    format!("{count} controller{}", s(count))
}

pub fn shown_of(shown: usize, all: usize) -> String {
    format!("{shown} of {all} controllers")
}

pub fn ticked(count: usize, hidden: usize) -> String {
    match hidden {
        0 => format!("{count} ticked"),
        _ => format!("{count} ticked, {hidden} of them hidden by the search"),
    }
}

pub fn menu_for_one(name: &str) -> String {
    format!("Only {name}")
}

pub fn menu_for_ticked(count: usize) -> String {
    match count {
        1 => "The ticked controller".to_owned(),
        _ => format!("All {count} ticked controllers"),
    }
}

pub fn expired(count: usize) -> String {
    format!("{count} certificate{} expired", s(count))
}

pub fn expiring(count: usize) -> String {
    format!("{count} certificate{} expire{} soon", s(count), if count == 1 { "s" } else { "" })
}

pub fn days_left(days: i64) -> String {
    format!("{days} day{} left", if days == 1 { "" } else { "s" })
}

pub fn tick_row(name: &str) -> String {
    format!("Tick {name}")
}

pub fn sort_by(column: T) -> String {
    format!("Sort by {}", lower_first(column.text(LANGUAGE)))
}

/// For the middle of a sentence; "IP" stays as it is.
fn lower_first(text: &str) -> String {
    match text.split_at_checked(1) {
        Some((first, rest)) if rest.starts_with(char::is_lowercase) => first.to_lowercase() + rest,
        _ => text.to_owned(),
    }
}

pub fn summary(summary: JobSummary) -> String {
    let JobSummary { done, failed, not_started } = summary;
    let parts = [
        (done, format!("{done} done")),
        (failed, format!("{failed} failed")),
        (not_started, format!("{not_started} not started")),
    ];
    let said: Vec<String> = parts.into_iter().filter(|(n, _)| *n > 0).map(|(_, text)| text).collect();
    said.join(", ")
}

pub fn job_running(title: T, done: usize, all: usize) -> String {
    let title = title.text(LANGUAGE).trim_end_matches('…');
    format!("{title}: {done} of {all} controllers done")
}

pub fn job_done(title: T, count: usize) -> String {
    let title = title.text(LANGUAGE).trim_end_matches('…');
    format!("{title}: {} done", controllers(count))
}

pub fn added(name: &str) -> String {
    format!("{name} was added")
}

pub fn deleted(count: usize) -> String {
    format!("{} deleted from the list", controllers(count))
}

pub fn user_count(count: usize, most: usize) -> String {
    format!("{count} of at most {most} users")
}

pub fn exported_at(at: &str, firmware: FirmwareVersion) -> String {
    format!("{at}, firmware {firmware}")
}

pub fn log_size(size: u64, here: u64, lines: usize, found: Option<usize>) -> String {
    let bytes =
        if here < size { format!("The last {} of {}", byte_count(here), byte_count(size)) } else { byte_count(size) };
    match found {
        None => format!("{bytes}, {lines} line{}", s(lines)),
        Some(found) => format!("{bytes}, {found} of {lines} line{}", s(lines)),
    }
}

pub fn version(version: &str) -> String {
    format!("Version {version}")
}

pub fn bits(bits: impl std::fmt::Display) -> String {
    format!("{bits} bits")
}

pub fn nth_of(nth: usize, all: usize) -> String {
    format!("{nth} of {all}")
}

pub fn stored_certificate(summary: &CertificateSummary, zone: Zone) -> String {
    let CertificateSummary { issued_to, issued_by, not_after, .. } = summary;
    let until = zone.date(*not_after);
    format!("Issued to {issued_to} by {issued_by}, valid until {until}")
}

pub fn issuer(summary: &CertificateSummary, zone: Zone) -> String {
    let CertificateSummary { issued_to, issued_by, not_before, not_after, .. } = summary;
    let (from, until) = (zone.date(*not_before), zone.date(*not_after));
    if issued_to == issued_by {
        format!("{issued_to}, root, valid from {from} until {until}")
    } else {
        format!("{issued_to}, by {issued_by}, valid from {from} until {until}")
    }
}

pub fn stored_in(count: usize, all: usize) -> String {
    format!("Stored in {count} of {}", controllers(all))
}

pub fn type_lacking(names: &[&str]) -> String {
    let (more, named) = (names.len().saturating_sub(5), names.iter().take(5).copied().collect::<Vec<_>>());
    match more {
        0 => format!("Not stored in {}; there the change fails", named.join(", ")),
        _ => format!("Not stored in {} and {more} more; there the change fails", named.join(", ")),
    }
}

pub fn not_read(name: &str, message: &str) -> String {
    format!("{name}: {message}")
}

pub fn importable(count: usize, all: usize) -> String {
    format!("{count} of {} can be imported", certificates(all))
}

fn certificates(count: usize) -> String {
    format!("{count} certificate{}", s(count))
}

pub fn finding(severity: T, explained: &str) -> String {
    format!("{}: {explained}", severity.text(LANGUAGE))
}
