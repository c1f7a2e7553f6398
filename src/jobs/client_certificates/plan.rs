use std::collections::BTreeSet;
use std::fmt;

use chrono::{DateTime, Utc};

use super::TrustSnapshot;
use super::notes::{self, TrustNote};
use super::target_list::TargetList;
use crate::model::{
    Base64Bytes, Capabilities, CertificateSummary, ClientList, CrlSummary, ErrorCode, Feature, ListLimits,
    MissingReason, Problem, TrustStep,
};
use crate::pki::{Bundle, Certificate, Crl, is_authority};
use crate::session::{MAX_REQUEST_BYTES, MAX_SENT_CRL_BYTES};

/// A file with certificates and CRLs, read and parsed.
#[derive(Debug, Clone, PartialEq)]
pub struct TrustFile {
    /// Without its folder.
    pub file_name: String,
    /// The certificates and CRLs of the file, in its order.
    pub bundle: Bundle,
}

/// Where a person wants certificates to go. CRLs always go to the CRLs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Destination {
    /// Each where certificates of its kind belong: an application's into the trusted list, an authority's into the
    /// issuers list, or into the trusted list where the controller has no issuers list.
    ByKind,
    /// The trusted list; but authorities that came in one file with an application's certificate only complete its
    /// chain, and go as with [`Destination::ByKind`].
    Trusted,
    /// The issuers list, authorities only.
    Issuers,
    /// CRLs only.
    Crls,
}

/// Which of the files' certificates and CRLs go where in one controller; what is left out, and what is wrong. Made
/// from the files and the snapshot alone: to be shown before anything is sent.
#[derive(Debug, Clone, PartialEq)]
pub struct TrustPlan {
    /// In the order of the files.
    pub items: Vec<PlannedItem>,
    have: [usize; 3],
    limits: ListLimits,
}

/// One certificate or CRL of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedItem {
    /// The file it came from.
    pub file_name: String,
    /// The name the controller will show it under: the file's, with a number where a file holds several.
    pub shown_as: String,
    /// The certificate or CRL.
    pub content: ItemContent,
    /// Whether it is sent, and where to.
    pub action: PlannedAction,
}

/// A certificate or CRL of a file, as it is sent.
#[derive(Debug, Clone, PartialEq)]
pub enum ItemContent {
    /// A certificate.
    Certificate {
        /// The certificate in DER.
        der: Vec<u8>,
        /// Names, dates and thumbprint.
        summary: CertificateSummary,
        /// Whether it is the certificate of a CA.
        authority: bool,
    },
    /// A CRL.
    Crl {
        /// The CRL in DER.
        der: Vec<u8>,
        /// Issuer, number and dates.
        summary: CrlSummary,
    },
}

/// What becomes of it.
#[derive(Debug, Clone, PartialEq)]
pub enum PlannedAction {
    /// It is sent; a person may want to think about the notes first.
    Send {
        /// The list it goes into.
        to: TargetList,
        /// What to consider before agreeing.
        notes: Vec<TrustNote>,
    },
    /// It is left out, and nothing is wrong.
    Skipped(SkipReason),
    /// It makes the whole request wrong.
    Refused(Problem),
}

/// Why a certificate or CRL is left out. None of it is a mistake.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SkipReason {
    /// The same stands earlier in the files.
    Repeated,
    /// The controller holds it already.
    AlreadyHeld,
    /// A newer CRL of the same issuer stands in the files, or is held already.
    Outdated,
    /// An application's certificate in a file with authorities, where only authorities were asked for; or certificates,
    /// where only CRLs were.
    NotAskedFor,
}

impl TrustPlan {
    /// `held`: what the controller has; without it, only the files are compared with each other. Blocks for large CRLs.
    pub fn new(
        files: &[TrustFile],
        destination: Destination,
        capabilities: &Capabilities,
        limits: ListLimits,
        now: DateTime<Utc>,
        held: Option<&TrustSnapshot>,
    ) -> Self {
        let held_crls = held.into_iter().flat_map(|held| &held.crls).filter_map(|held| held.crl.as_ref());
        let held_crls = held_crls.filter_map(|der| Crl::from_der(&der.0).ok()).collect();
        let offered_crls = files.iter().flat_map(|file| &file.bundle.crls).collect();
        let at_hand: Vec<Certificate> = files
            .iter()
            .flat_map(|file| file.bundle.certificates.iter().cloned())
            .chain(held.into_iter().flat_map(TrustSnapshot::certificates))
            .collect();
        let no_issuers_list = capabilities.missing(Feature::IssuersList);
        let sorter = Sorter { destination, no_issuers_list, now, held, held_crls, offered_crls };
        let mut seen = BTreeSet::new();
        let mut items = Vec::new();
        for file in files {
            let several = file.bundle.certificates.len() + file.bundle.crls.len() > 1;
            let mut number = 0;
            let mut plan = |id: String, content: ItemContent, action: PlannedAction| {
                number += 1;
                let extension = if matches!(content, ItemContent::Crl { .. }) { "crl" } else { "der" };
                let shown_as = shown_as(&file.file_name, several.then_some((number, extension)));
                let action = match action {
                    PlannedAction::Send { .. } if !seen.insert(id) => PlannedAction::Skipped(SkipReason::Repeated),
                    action => action,
                };
                items.push(PlannedItem { file_name: file.file_name.clone(), shown_as, content, action });
            };
            let judged: Vec<(&Certificate, bool)> =
                file.bundle.certificates.iter().map(|c| (c, is_authority(c, &at_hand))).collect();
            let with_application = judged.iter().any(|(_, authority)| !authority);
            let with_authority = judged.iter().any(|(_, authority)| *authority);
            for (certificate, authority) in judged {
                let summary = certificate.summary();
                let action =
                    sorter.certificate(certificate, &summary.thumbprint, authority, with_application, with_authority);
                let id = summary.thumbprint.clone();
                plan(id, ItemContent::Certificate { der: certificate.der().to_vec(), summary, authority }, action);
            }
            for crl in &file.bundle.crls {
                let summary = crl.summary();
                let action = sorter.crl(crl, &summary, !file.bundle.certificates.is_empty());
                plan(summary.id.clone(), ItemContent::Crl { der: crl.der().to_vec(), summary }, action);
            }
        }
        let have = held.map_or([0; 3], |held| [held.trusted.len(), held.issuers.len(), held.crls.len()]);
        Self { items, have, limits }
    }

    /// For a controller whose lists are known.
    pub fn for_controller(files: &[TrustFile], destination: Destination, held: &TrustSnapshot) -> Self {
        Self::new(files, destination, &held.capabilities, held.limits, held.clock, Some(held))
    }

    /// Whether something is there that a person should agree to: a note, or something left out. What is refused is not
    /// sent anyhow.
    pub fn needs_a_look(&self) -> bool {
        self.items.iter().any(|item| match &item.action {
            PlannedAction::Send { notes, .. } => !notes.is_empty(),
            PlannedAction::Skipped(_) => true,
            PlannedAction::Refused(_) => false,
        })
    }

    /// How many go there.
    pub fn count(&self, target: TargetList) -> usize {
        self.going().filter(|(to, _)| *to == target).count()
    }

    /// Why nothing of this may be sent: something is refused, nothing is new, it does not fit.
    pub fn check(&self) -> Result<(), Problem> {
        for item in &self.items {
            if let PlannedAction::Refused(problem) = &item.action {
                return Err(problem.clone());
            }
        }
        if self.going().next().is_none() {
            return Err(self.why_nothing_is_sent().into());
        }
        let replacing = self.items.iter().filter(|item| item.replaces()).count();
        for (target, have, limit, code) in [
            (TargetList::Trusted, self.have[0], self.limits.trusted, ErrorCode::ListFull),
            (TargetList::Issuers, self.have[1], self.limits.issuers, ErrorCode::ListFull),
            (TargetList::Crls, self.have[2].saturating_sub(replacing), self.limits.crls, ErrorCode::TooManyCrls),
        ] {
            let total = have + self.count(target);
            if self.count(target) > 0 && total > limit {
                return Err(Problem::with_detail(code, format!("{total} > {limit}")));
            }
        }
        let bytes: usize = self.going().map(|(_, item)| ENTRY_BYTES + item.content.der().len().div_ceil(3) * 4).sum();
        if bytes > MAX_REQUEST_BYTES { Err(ErrorCode::RequestTooLarge.into()) } else { Ok(()) }
    }

    /// What is to be sent.
    pub(super) fn steps(&self) -> Vec<TrustStep> {
        let of = |target: TargetList| -> Vec<(String, Base64Bytes)> {
            self.going()
                .filter(|(to, _)| *to == target)
                .map(|(_, item)| (item.shown_as.clone(), Base64Bytes(item.content.der().to_vec())))
                .collect()
        };
        let mut steps = Vec::new();
        for (target, list) in [(TargetList::Issuers, ClientList::Issuers), (TargetList::Trusted, ClientList::Trusted)] {
            let certificates = of(target);
            if !certificates.is_empty() {
                steps.push(TrustStep::Add { list, certificates });
            }
        }
        let crls = of(TargetList::Crls);
        if !crls.is_empty() {
            steps.push(TrustStep::AddCrls { crls });
        }
        steps
    }

    fn why_nothing_is_sent(&self) -> ErrorCode {
        let nothing_but_crls = self.items.iter().all(|item| matches!(item.content, ItemContent::Crl { .. }));
        let not_asked_for = |item: &PlannedItem| item.action == PlannedAction::Skipped(SkipReason::NotAskedFor);
        match self.items.first() {
            None => ErrorCode::BadCertificate,
            Some(_) if nothing_but_crls => ErrorCode::DuplicateCrl,
            // Certificates where only CRLs were asked for.
            Some(_) if self.items.iter().all(not_asked_for) => ErrorCode::BadCrl,
            Some(_) => ErrorCode::DuplicateCertificate,
        }
    }

    fn going(&self) -> impl Iterator<Item = (TargetList, &PlannedItem)> {
        self.items.iter().filter_map(|item| match item.action {
            PlannedAction::Send { to, .. } => Some((to, item)),
            _ => None,
        })
    }
}

/// Generous for what stands around one certificate in a request: its name, brackets.
const ENTRY_BYTES: usize = 300;

impl PlannedItem {
    fn replaces(&self) -> bool {
        matches!(&self.action, PlannedAction::Send { notes, .. } if notes.contains(&TrustNote::ReplacesOlder))
    }
}

impl ItemContent {
    /// The certificate or CRL in DER.
    pub fn der(&self) -> &[u8] {
        match self {
            Self::Certificate { der, .. } | Self::Crl { der, .. } => der,
        }
    }
}

/// Decides about one certificate or CRL at a time.
struct Sorter<'a> {
    destination: Destination,
    /// Why the controller has no issuers list; `None` if it has one.
    no_issuers_list: Option<MissingReason>,
    now: DateTime<Utc>,
    held: Option<&'a TrustSnapshot>,
    held_crls: Vec<Crl>,
    offered_crls: Vec<&'a Crl>,
}

impl Sorter<'_> {
    fn certificate(
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

    fn crl(&self, crl: &Crl, summary: &CrlSummary, among_certificates: bool) -> PlannedAction {
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

/// The controller takes up to 255 bytes and no path.
fn shown_as(file_name: &str, several: Option<(usize, &str)>) -> String {
    const MAX_STEM_BYTES: usize = 200;
    let harmless: String =
        file_name.chars().map(|c| if c.is_control() || c == '/' || c == '\\' { '_' } else { c }).collect();
    let (stem, extension) = harmless.rsplit_once('.').unwrap_or((&harmless, ""));
    let stem = &stem[..stem.floor_char_boundary(MAX_STEM_BYTES)];
    match several {
        Some((number, extension)) => format!("{stem}_{number}.{extension}"),
        None if extension.is_empty() || extension.len() > 16 => stem.to_owned(),
        None => format!("{stem}.{extension}"),
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::{
        application, authority, issuing_application, listed, listed_crl, now, rejected, snapshot,
    };
    use super::*;
    use crate::model::FirmwareGeneration;

    fn file(name: &str, certificates: &[&Certificate], crls: &[&Crl]) -> TrustFile {
        let certificates = certificates.iter().copied().cloned().collect();
        TrustFile {
            file_name: name.to_owned(),
            bundle: Bundle { certificates, crls: crls.iter().copied().cloned().collect() },
        }
    }

    fn plan(files: &[TrustFile], destination: Destination, generation: FirmwareGeneration) -> TrustPlan {
        TrustPlan::for_controller(files, destination, &snapshot(generation))
    }

    fn planned_actions(plan: &TrustPlan) -> Vec<PlannedAction> {
        plan.items.iter().map(|item| item.action.clone()).collect()
    }

    fn goes(to: TargetList, notes: &[TrustNote]) -> PlannedAction {
        PlannedAction::Send { to, notes: notes.to_vec() }
    }

    use FirmwareGeneration::{Current, Legacy};
    use PlannedAction::Skipped;

    #[test]
    fn a_chain_with_its_crl_is_sorted_by_kind() {
        let (ca, client) = (authority("Plant CA"), application("client"));
        let files = [file("chain.p7b", &[&client, &ca.certificate], &[&ca.crl(1)])];
        for destination in [Destination::ByKind, Destination::Trusted] {
            let current = plan(&files, destination, Current);
            let note: &[TrustNote] =
                if destination == Destination::ByKind { &[] } else { &[TrustNote::OnlyCompletesAChain] };
            let crl = goes(TargetList::Crls, &[TrustNote::CrlAmongCertificates]);
            assert_eq!(
                planned_actions(&current),
                [goes(TargetList::Trusted, &[]), goes(TargetList::Issuers, note), crl]
            );
            assert_eq!(current.check(), Ok(()));
            let names: Vec<&str> = current.items.iter().map(|item| item.shown_as.as_str()).collect();
            assert_eq!(names, ["chain_1.der", "chain_2.der", "chain_3.crl"]);
            assert_eq!(current.steps().len(), 3);

            let legacy = plan(&files, destination, Legacy);
            assert_eq!(planned_actions(&legacy)[1], goes(TargetList::Trusted, &[TrustNote::TrustsAllItIssues]));
            assert!(legacy.needs_a_look());
        }
    }

    #[test]
    fn what_issued_a_certificate_at_hand_is_an_authority_whatever_it_says() {
        let (plain, issuing) = (application("plain"), issuing_application("signer"));
        let files = [file("signer.der", &[&issuing.certificate], &[])];
        let alone = plan(&files, Destination::ByKind, Current);
        assert_eq!(planned_actions(&alone), [goes(TargetList::Trusted, &[])]);
        let below = issuing.client("client");
        let with_client = [files[0].clone(), file("client.der", &[&below], &[])];
        let planned = plan(&with_client, Destination::ByKind, Current);
        assert_eq!(planned_actions(&planned), [goes(TargetList::Issuers, &[]), goes(TargetList::Trusted, &[])]);
        for held_somewhere in [true, false] {
            let mut held = snapshot(Current);
            if held_somewhere {
                held.trusted.push(listed(&below));
            } else {
                held.rejected.push(rejected(&below));
            }
            held.trusted.push(listed(&plain));
            let planned = TrustPlan::for_controller(&files, Destination::Trusted, &held);
            assert_eq!(planned_actions(&planned), [goes(TargetList::Trusted, &[TrustNote::TrustsAllItIssues])]);
        }
    }

    #[test]
    fn an_authority_alone_becomes_trusted_only_where_that_was_asked_for() {
        let ca = authority("Plant CA");
        let files = [file("ca.der", &[&ca.certificate], &[])];
        assert_eq!(planned_actions(&plan(&files, Destination::ByKind, Current)), [goes(TargetList::Issuers, &[])]);
        assert!(!plan(&files, Destination::ByKind, Current).needs_a_look());
        let trusted = plan(&files, Destination::Trusted, Current);
        assert_eq!(planned_actions(&trusted), [goes(TargetList::Trusted, &[TrustNote::TrustsAllItIssues])]);
        assert_eq!(trusted.items[0].shown_as, "ca.der");
        assert!(trusted.needs_a_look());
    }

    #[test]
    fn the_issuers_list_takes_authorities_only() {
        let (ca, client) = (authority("Plant CA"), application("client"));
        let chain = [file("chain.pem", &[&client, &ca.certificate], &[])];
        let sorted = plan(&chain, Destination::Issuers, Current);
        assert_eq!(planned_actions(&sorted), [Skipped(SkipReason::NotAskedFor), goes(TargetList::Issuers, &[])]);
        let alone = plan(&[file("client.der", &[&client], &[])], Destination::Issuers, Current);
        assert_eq!(alone.check().unwrap_err().code, ErrorCode::NotAnAuthority);
        assert_eq!(plan(&chain, Destination::Issuers, Legacy).check().unwrap_err().code, ErrorCode::FirmwareTooOld);
    }

    #[test]
    fn what_is_there_already_is_left_out() {
        let (one, two) = (application("one"), application("two"));
        let mut held = snapshot(Current);
        held.trusted.push(listed(&one));
        let files = [file("one.der", &[&one], &[]), file("two.der", &[&two], &[]), file("again.der", &[&two], &[])];
        let both = TrustPlan::for_controller(&files, Destination::Trusted, &held);
        let left_out =
            [Skipped(SkipReason::AlreadyHeld), goes(TargetList::Trusted, &[]), Skipped(SkipReason::Repeated)];
        assert_eq!(planned_actions(&both), left_out);
        assert_eq!(both.check(), Ok(()));
        let nothing = TrustPlan::for_controller(&files[..1], Destination::Trusted, &held);
        assert_eq!(nothing.check(), Err(ErrorCode::DuplicateCertificate.into()));
        assert_eq!(plan(&[], Destination::Trusted, Current).check(), Err(ErrorCode::BadCertificate.into()));
    }

    #[test]
    fn an_older_crl_never_takes_the_place_of_a_newer_one() {
        let ca = authority("Plant CA");
        let (old, held, new) = (ca.crl(1), ca.crl(2), ca.crl(3));
        let mut lists = snapshot(Current);
        lists.crls.push(listed_crl(&held));
        let planned = |files: &[TrustFile], to| TrustPlan::for_controller(files, to, &lists);
        let newer = planned(&[file("3.crl", &[], &[&new])], Destination::Crls);
        assert_eq!(planned_actions(&newer), [goes(TargetList::Crls, &[TrustNote::ReplacesOlder])]);
        let same = planned(&[file("2.crl", &[], &[&held])], Destination::Crls);
        assert_eq!(same.check(), Err(ErrorCode::DuplicateCrl.into()));
        let older = planned(&[file("1.crl", &[], &[&old])], Destination::Crls);
        assert_eq!(older.check().unwrap_err().code, ErrorCode::CrlOutdated);
        // One that came along with certificates is no reason to refuse those.
        let along = planned(&[file("chain.p7b", &[&ca.certificate], &[&old])], Destination::ByKind);
        assert_eq!(planned_actions(&along), [goes(TargetList::Issuers, &[]), Skipped(SkipReason::Outdated)]);
        let both = planned(&[file("1.crl", &[], &[&old]), file("3.crl", &[], &[&new])], Destination::Crls);
        assert_eq!(
            planned_actions(&both),
            [Skipped(SkipReason::Outdated), goes(TargetList::Crls, &[TrustNote::ReplacesOlder])]
        );
    }

    /// Made by OpenSSL; the authority was set up anew with the same key.
    #[test]
    fn a_crl_whose_number_starts_again_is_taken_with_both_numbers_and_dates() {
        let read = |der: &[u8]| Crl::from_der(der).unwrap();
        let before = read(include_bytes!("../../../tests/cases/12-crl-number-reset/crls/0.crl"));
        let after = read(include_bytes!("../../../tests/cases/12-crl-number-reset/crls/1.crl"));
        let note = TrustNote::NumberStartsAgain {
            number: "1".to_owned(),
            date: after.this_update(),
            before: "500".to_owned(),
            date_before: before.this_update(),
        };
        let mut held = snapshot(Current);
        held.clock = "2026-11-27T12:00:00Z".parse().unwrap();
        held.crls.push(listed_crl(&before));
        let planned = TrustPlan::for_controller(&[file("1.crl", &[], &[&after])], Destination::Crls, &held);
        assert_eq!(planned_actions(&planned), [goes(TargetList::Crls, &[TrustNote::ReplacesOlder, note.clone()])]);
        assert!(planned.needs_a_look());
        assert_eq!(planned.check(), Ok(()));
        for language in crate::model::Language::ALL {
            let said = note.text(language);
            for date in ["2026-10-18T15:16:44Z", "2026-11-26T15:16:44Z"] {
                assert!(said.contains(date), "no {date} in {said}");
            }
            let numbers: Vec<&str> = said.split(|c: char| !c.is_ascii_digit()).collect();
            assert!(numbers.contains(&"500") && numbers.contains(&"1"), "{said}");
        }
        held.crls.clear();
        let files = [file("0.crl", &[], &[&before]), file("1.crl", &[], &[&after])];
        let planned = TrustPlan::for_controller(&files, Destination::Crls, &held);
        assert_eq!(
            planned_actions(&planned),
            [Skipped(SkipReason::Outdated), goes(TargetList::Crls, &[note])],
            "both come at once"
        );
        held.crls = vec![listed_crl(&after)];
        let planned = TrustPlan::for_controller(&files[..1], Destination::Crls, &held);
        let [PlannedAction::Refused(problem)] = &planned_actions(&planned)[..] else { panic!("{planned:?}") };
        assert_eq!(problem.code, ErrorCode::CrlOutdated);
    }

    #[test]
    fn limits_hold_before_anything_is_sent() {
        let certificates: Vec<Certificate> = (0..11).map(|i| application(&format!("client{i}"))).collect();
        let files: Vec<TrustFile> = certificates.iter().map(|c| file("c.der", &[c], &[])).collect();
        assert_eq!(plan(&files[..10], Destination::Trusted, Legacy).check(), Ok(()));
        assert_eq!(plan(&files, Destination::Trusted, Legacy).check().unwrap_err().code, ErrorCode::ListFull);
        let mut held = snapshot(Legacy);
        held.trusted = certificates[..10].iter().map(listed).collect();
        let over = TrustPlan::for_controller(&files[10..], Destination::Trusted, &held);
        assert_eq!(over.check().unwrap_err().code, ErrorCode::ListFull);

        let authorities: Vec<_> = (0..11).map(|i| authority(&format!("CA {i}"))).collect();
        let mut full = snapshot(Legacy);
        full.crls = authorities[..10].iter().map(|ca| listed_crl(&ca.crl(1))).collect();
        let replacing = [file("new.crl", &[], &[&authorities[3].crl(2)])];
        assert_eq!(TrustPlan::for_controller(&replacing, Destination::Crls, &full).check(), Ok(()));
        let another = [file("more.crl", &[], &[&authorities[10].crl(1)])];
        let over = TrustPlan::for_controller(&another, Destination::Crls, &full);
        assert_eq!(over.check().unwrap_err().code, ErrorCode::TooManyCrls);
    }

    #[test]
    fn dates_are_those_of_the_controllers_clock() {
        let files = [file("client.der", &[&application("client")], &[])];
        let at = |now: &str| {
            let mut held = snapshot(Current);
            held.clock = now.parse().unwrap();
            planned_actions(&TrustPlan::for_controller(&files, Destination::Trusted, &held))
        };
        assert_eq!(at("2035-01-01T00:00:00Z"), [goes(TargetList::Trusted, &[TrustNote::Expired])]);
        assert_eq!(at("2020-01-01T00:00:00Z"), [goes(TargetList::Trusted, &[TrustNote::NotYetValid])]);
        assert_eq!(at(&now().to_rfc3339()), [goes(TargetList::Trusted, &[])]);
    }

    #[test]
    fn a_file_name_is_made_harmless_and_short() {
        assert_eq!(shown_as("a/b\\c\n.der", None), "a_b_c_.der");
        let long = format!("{}.der", "长".repeat(200));
        let shown = shown_as(&long, Some((12, "crl")));
        assert!(shown.len() <= 255 && shown.ends_with("长_12.crl"), "{shown}");
        assert_eq!(shown_as("noname", None), "noname");
        assert!(shown_as(&format!("x.{}", "y".repeat(300)), None).len() <= 255);
    }
}
