use std::cmp::Ordering;

use chrono::{DateTime, Duration, Utc};

use super::TrustColumn;
use crate::model::{CertificateStatus, CertificateSummary, Language, ListedCertificate, ListedCrl};
use crate::pki::{CrlHealth, RefusalCause, RejectedClient};
use crate::texts::Zone;
use crate::texts::explain_refusal;
use crate::ui::model::EXPIRES_SOON;

/// A point in time, and how it is shown.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ShownTime {
    pub at: DateTime<Utc>,
    pub text: String,
}

/// How a validity stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ValidityState {
    Past,
    Soon { days: i64 },
    Good,
    NotYet,
}

/// What a controller remembers of a client it refused.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RejectionDetails {
    pub status: CertificateStatus,
    pub cause: Option<RefusalCause>,
    /// What was wrong with this very certificate, in English words; may be empty.
    pub reason: String,
    /// Empty: it was put here by a person, and has not come since.
    pub address: String,
    pub count: u64,
    pub first_seen: ShownTime,
    pub last_seen: ShownTime,
    /// It came while the dialog was open, and was not selected since.
    pub is_new: bool,
}

impl RejectionDetails {
    pub fn of(client: &RejectedClient, zone: Zone) -> Self {
        Self {
            status: client.status,
            cause: client.cause.clone(),
            reason: client.reason.clone(),
            address: client.address.clone(),
            count: client.count,
            first_seen: ShownTime { at: client.first_seen, text: zone.date_time(client.first_seen) },
            last_seen: ShownTime { at: client.last_seen, text: zone.date_time(client.last_seen) },
            is_new: false,
        }
    }

    /// What it means and what to do.
    pub fn explain(&self, language: Language) -> String {
        explain_refusal(self.status, self.cause.as_ref(), language)
    }
}

/// What only a CRL has.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CrlDetails {
    /// Revoked certificates.
    pub entries: usize,
    pub health: Option<CrlHealth>,
    /// The name of the authority it is held for, if that is held as well.
    pub covers: Option<String>,
}

/// One line of a list, with every text that does not depend on the language made once.
#[derive(Debug, Clone, PartialEq)]
pub struct TrustListEntry {
    /// The thumbprint of a certificate, the id of a CRL: SHA-1, upper-case hexadecimal.
    pub id: String,
    /// Empty for a refused client, which has none.
    pub file_name: String,
    /// The issuer of a CRL.
    pub issued_to: String,
    pub issued_by: String,
    /// Of a CRL: its number.
    pub serial_number: String,
    /// `thisUpdate` of a CRL.
    pub from: ShownTime,
    /// `nextUpdate` of a CRL, which may lack it.
    pub until: Option<ShownTime>,
    pub life: ValidityState,
    pub refusal: Option<RejectionDetails>,
    pub crl: Option<CrlDetails>,
    /// Lower case: what the filter looks through.
    pub(super) haystack: String,
    title: String,
}

impl TrustListEntry {
    pub fn listed(listed: &ListedCertificate, zone: Zone, now: DateTime<Utc>) -> Self {
        Self::certificate(&listed.summary, listed.file_name.clone(), None, zone, now)
    }

    pub fn rejected(client: &RejectedClient, zone: Zone, now: DateTime<Utc>) -> Self {
        Self::certificate(&client.summary, String::new(), Some(RejectionDetails::of(client, zone)), zone, now)
    }

    pub fn crl(
        listed: &ListedCrl,
        health: Option<CrlHealth>,
        covers: Option<String>,
        zone: Zone,
        now: DateTime<Utc>,
    ) -> Self {
        let summary = &listed.summary;
        let mut entry = Self {
            id: summary.id.clone(),
            file_name: listed.file_name.clone(),
            issued_to: summary.issuer.clone(),
            issued_by: String::new(),
            serial_number: summary.number.clone().unwrap_or_default(),
            from: ShownTime { at: summary.this_update, text: zone.date_time(summary.this_update) },
            until: summary.next_update.map(|at| ShownTime { at, text: zone.date_time(at) }),
            life: ValidityState::Good,
            refusal: None,
            crl: Some(CrlDetails { entries: summary.entries, health, covers }),
            haystack: String::new(),
            title: String::new(),
        };
        entry.finish(now);
        entry
    }

    fn certificate(
        summary: &CertificateSummary,
        file_name: String,
        refusal: Option<RejectionDetails>,
        zone: Zone,
        now: DateTime<Utc>,
    ) -> Self {
        let mut entry = Self {
            id: summary.thumbprint.clone(),
            file_name,
            issued_to: summary.issued_to.clone(),
            issued_by: summary.issued_by.clone(),
            serial_number: summary.serial_number.clone(),
            from: ShownTime { at: summary.not_before, text: zone.date(summary.not_before) },
            until: Some(ShownTime { at: summary.not_after, text: zone.date(summary.not_after) }),
            life: ValidityState::Good,
            refusal,
            crl: None,
            haystack: String::new(),
            title: String::new(),
        };
        entry.haystack = summary.application_uri.clone().unwrap_or_default();
        entry.finish(now);
        entry
    }

    fn finish(&mut self, now: DateTime<Utc>) {
        let (address, status) =
            self.refusal.as_ref().map_or(("", ""), |refusal| (&refusal.address, refusal.status.as_str()));
        let parts = [&self.haystack, &self.issued_to, &self.issued_by, &self.file_name, &self.serial_number, &self.id]
            .map(String::as_str);
        self.haystack = [&parts[..], &[address, status]].concat().join("\n").to_lowercase();
        self.title = self.issued_to.to_lowercase();
        self.refresh(now);
    }

    /// Brings words like "expired" up to date.
    pub fn refresh(&mut self, now: DateTime<Utc>) {
        self.life = match &self.until {
            _ if self.from.at > now => ValidityState::NotYet,
            Some(until) if until.at <= now => ValidityState::Past,
            // A CRL lives for days or hours only.
            Some(until) if self.crl.is_none() && until.at - now < EXPIRES_SOON => {
                ValidityState::Soon { days: (until.at - now).num_days() }
            }
            Some(until) if self.crl.is_some() && until.at - now < Duration::days(1) => ValidityState::Soon { days: 0 },
            _ => ValidityState::Good,
        };
    }

    pub(in crate::ui) fn compare(&self, other: &Self, column: TrustColumn) -> Ordering {
        let refused = |entry: &Self| entry.refusal.as_ref().map(|r| (r.status.as_str(), r.count));
        let seen =
            |entry: &Self, which: fn(&RejectionDetails) -> &ShownTime| entry.refusal.as_ref().map(|r| which(r).at);
        let crl = |entry: &Self| entry.crl.as_ref().map(|crl| (crl.entries, crl.health.as_ref().map(is_bad)));
        let order = match column {
            TrustColumn::IssuedTo | TrustColumn::Issuer => Ordering::Equal,
            TrustColumn::FileName => self.file_name.to_lowercase().cmp(&other.file_name.to_lowercase()),
            TrustColumn::IssuedBy => self.issued_by.to_lowercase().cmp(&other.issued_by.to_lowercase()),
            // Numbers: the longer one is the larger.
            TrustColumn::SerialNumber | TrustColumn::Number => {
                let number = |entry: &Self| (entry.serial_number.len(), entry.serial_number.clone());
                number(self).cmp(&number(other))
            }
            TrustColumn::ValidFrom | TrustColumn::ThisUpdate => self.from.at.cmp(&other.from.at),
            TrustColumn::ValidUntil | TrustColumn::NextUpdate => {
                self.until.as_ref().map(|m| m.at).cmp(&other.until.as_ref().map(|m| m.at))
            }
            TrustColumn::Thumbprint => self.id.cmp(&other.id),
            TrustColumn::Reason => refused(self).map(|r| r.0).cmp(&refused(other).map(|r| r.0)),
            TrustColumn::Count => refused(self).map(|r| r.1).cmp(&refused(other).map(|r| r.1)),
            TrustColumn::Address => {
                let address = |entry: &Self| entry.refusal.as_ref().map(|r| r.address.parse::<std::net::IpAddr>().ok());
                address(self).cmp(&address(other))
            }
            TrustColumn::FirstSeen => seen(self, |r| &r.first_seen).cmp(&seen(other, |r| &r.first_seen)),
            TrustColumn::LastSeen => seen(self, |r| &r.last_seen).cmp(&seen(other, |r| &r.last_seen)),
            TrustColumn::Entries => crl(self).map(|c| c.0).cmp(&crl(other).map(|c| c.0)),
            TrustColumn::Health => crl(self).map(|c| c.1).cmp(&crl(other).map(|c| c.1)),
        };
        order.then_with(|| self.title.cmp(&other.title)).then_with(|| self.id.cmp(&other.id))
    }
}

/// The bad ones first.
fn is_bad(health: &CrlHealth) -> bool {
    health.is_usable()
}
