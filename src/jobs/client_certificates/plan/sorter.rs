use std::fmt;

use chrono::{DateTime, Utc};

use super::{Destination, PlannedAction, SkipReason};
use crate::jobs::client_certificates::TrustSnapshot;
use crate::jobs::client_certificates::notes::{self, TrustNote};
use crate::jobs::client_certificates::target_list::TargetList;
use crate::model::{ClientList, CrlSummary, ErrorCode, MissingReason, Problem};
use crate::pki::{Certificate, Crl};
use crate::session::MAX_SENT_CRL_BYTES;

/// Decides about one certificate or CRL at a time.
pub struct Sorter<'a> {
    pub destination: Destination,
    /// Why the controller has no issuers list; `None` if it has one.
    pub no_issuers_list: Option<MissingReason>,
    pub now: DateTime<Utc>,
    pub held: Option<&'a TrustSnapshot>,
    pub held_crls: Vec<Crl>,
    pub offered_crls: Vec<&'a Crl>,
}

impl Sorter<'_> {
    /// `authority`: it is one; `with_application`, `with_authority`: its file holds others of that kind too.
    pub fn certificate(
        &self,
        certificate: &Certificate,
        thumbprint: &str,
        authority: bool,
        with_application: bool,
        with_authority: bool,
    ) -> PlannedAction {
        if let (Destination::Issuers, Some(reason)) = (self.destination, self.no_issuers_list) {
            return PlannedAction::Refused(reason.into());
        }
        let has_issuers_list = self.no_issuers_list.is_none();
        let (to, completes_a_chain) = match (self.destination, authority) {
            (Destination::Crls, _) => return PlannedAction::Skipped(SkipReason::NotAskedFor),
            (Destination::Issuers, false) if with_authority => return PlannedAction::Skipped(SkipReason::NotAskedFor),
            (Destination::Issuers, false) => {
                return PlannedAction::Refused(Problem::with_detail(ErrorCode::NotAnAuthority, thumbprint));
            }
            (Destination::Issuers, true) => (TargetList::Issuers, false),
            (Destination::ByKind | Destination::Trusted, false) => (TargetList::Trusted, false),
            (Destination::ByKind, true) if !has_issuers_list => (TargetList::Trusted, false),
            (Destination::ByKind, true) => (TargetList::Issuers, false),
            (Destination::Trusted, true) if with_application && has_issuers_list => (TargetList::Issuers, true),
            (Destination::Trusted, true) => (TargetList::Trusted, false),
        };
        let list = if to == TargetList::Issuers { ClientList::Issuers } else { ClientList::Trusted };
        if self.held.is_some_and(|held| held.holds(list, thumbprint)) {
            return PlannedAction::Skipped(SkipReason::AlreadyHeld);
        }
        let mut notes = notes::of_certificate(certificate, authority, to, self.now);
        if completes_a_chain {
            notes.insert(0, TrustNote::OnlyCompletesAChain);
        }
        PlannedAction::Send { to, notes }
    }

    /// `among_certificates`: its file holds certificates too.
    pub fn crl(&self, crl: &Crl, summary: &CrlSummary, among_certificates: bool) -> PlannedAction {
        let refused = |code, detail: &dyn fmt::Display| PlannedAction::Refused(Problem::with_detail(code, detail));
        if let Some(why) = crl.unusable() {
            return refused(ErrorCode::BadCrl, &why);
        }
        if crl.der().len() > MAX_SENT_CRL_BYTES {
            let detail = format!("{} > {MAX_SENT_CRL_BYTES} bytes", crl.der().len());
            return refused(ErrorCode::RequestTooLarge, &detail);
        }
        if self.held.is_some_and(|held| held.holds_crl(&summary.id)) {
            return PlannedAction::Skipped(SkipReason::AlreadyHeld);
        }
        let newer_stands_by = |other: &&Crl| crl.has_same_scope_as(other) && other.is_newer_than(crl);
        if self.offered_crls.iter().any(newer_stands_by) {
            return PlannedAction::Skipped(SkipReason::Outdated);
        }
        let mut notes = Vec::new();
        let asked_for = self.destination == Destination::Crls || !among_certificates;
        if let Some(held) = self.held_crls.iter().find(|held| crl.has_same_scope_as(held)) {
            if crl.is_newer_than(held) {
                notes.push(TrustNote::ReplacesOlder);
            } else if asked_for {
                let (new, old) = (crl.number_and_date(), held.number_and_date());
                return refused(ErrorCode::CrlOutdated, &format!("{}: {new} < {old}", summary.issuer));
            } else {
                return PlannedAction::Skipped(SkipReason::Outdated);
            }
        }
        notes.extend(self.number_starts_again(crl));
        if !asked_for {
            notes.push(TrustNote::CrlAmongCertificates);
        }
        if summary.next_update.is_none_or(|next| next < self.now) {
            notes.push(TrustNote::Expired);
        } else if summary.this_update > self.now {
            notes.push(TrustNote::NotYetValid);
        }
        PlannedAction::Send { to: TargetList::Crls, notes }
    }

    /// Compared with what is held and with what comes along.
    fn number_starts_again(&self, crl: &Crl) -> Option<TrustNote> {
        let same_scope =
            self.held_crls.iter().chain(self.offered_crls.iter().copied()).filter(|other| crl.has_same_scope_as(other));
        same_scope.into_iter().find_map(|other| {
            let (number, before) = crl.number_starts_again_after(other)?;
            Some(TrustNote::NumberStartsAgain {
                number,
                date: crl.this_update(),
                before,
                date_before: other.this_update(),
            })
        })
    }
}
