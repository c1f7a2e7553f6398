mod sorter;
#[cfg(test)]
mod tests;

use std::collections::BTreeSet;

use chrono::{DateTime, Utc};

use super::TrustSnapshot;
use super::notes::TrustNote;
use super::target_list::TargetList;
use crate::model::{
    Base64Bytes, Capabilities, CertificateSummary, ClientList, CrlSummary, ErrorCode, Feature, ListLimits, Problem,
    TrustStep,
};
use crate::pki::{Bundle, Certificate, Crl, is_authority};
use crate::session::MAX_REQUEST_BYTES;

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
        let sorter = sorter::Sorter { destination, no_issuers_list, now, held, held_crls, offered_crls };
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
