use std::collections::BTreeSet;

use chrono::{DateTime, Utc};

use super::TrustSnapshot;
use crate::model::{CertificateSummary, ClientList, CrlSummary, ErrorCode, FirmwareGeneration, ListLimits, Problem};
use crate::pki::{Bundle, Certificate, Crl};
use crate::protocol::{Base64Bytes, MAX_REQUEST_BYTES, MAX_SENT_CRL_BYTES, TrustStep};

/// A file with certificates and CRLs, read and parsed.
#[derive(Debug, Clone, PartialEq)]
pub struct TrustFile {
    /// Without its folder.
    pub file_name: String,
    pub bundle: Bundle,
}

/// Where a person wants certificates to go. CRLs always go to the CRLs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Destination {
    /// Each where certificates of its kind belong: an application's into the trusted list, an authority's into the
    /// issuers list, or into the trusted list on legacy firmware, which has no other.
    ByKind,
    /// The trusted list; but authorities that came in one file with an application's certificate only complete its
    /// chain, and go as with [`Destination::ByKind`].
    Trusted,
    /// The issuers list, authorities only.
    Issuers,
    /// CRLs only.
    Crls,
}

/// Where something goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Target {
    Trusted,
    Issuers,
    Crls,
}

/// Which of the files' certificates and CRLs go where in one controller; what is left out, and what is wrong. Made
/// without asking anybody: to be shown before anything is sent.
#[derive(Debug, Clone, PartialEq)]
pub struct TrustPlan {
    /// In the order of the files.
    pub items: Vec<Planned>,
    have: [usize; 3],
    limits: ListLimits,
}

/// One certificate or CRL of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Planned {
    /// The file it came from.
    pub file_name: String,
    /// The name the controller will show it under: the file's, with a number where a file holds several.
    pub shown_as: String,
    pub thing: Thing,
    pub fate: Fate,
}

#[derive(Debug, Clone, PartialEq)]
pub enum Thing {
    Certificate { der: Vec<u8>, summary: CertificateSummary, authority: bool },
    Crl { der: Vec<u8>, summary: CrlSummary },
}

/// What becomes of it.
#[derive(Debug, Clone, PartialEq)]
pub enum Fate {
    /// It is sent; a person may want to think about the notes first.
    Goes { to: Target, notes: Vec<Note> },
    /// It is left out, and nothing is wrong.
    Skipped(SkipReason),
    /// It makes the whole request wrong.
    Refused(Problem),
}

/// What a person may want to think about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Note {
    /// An authority in the trusted list: every client is let in that has a certificate from it.
    TrustsAllItIssues,
    /// An authority that came with an application's certificate goes into the issuers list, not into the one asked for.
    OnlyCompletesAChain,
    /// A CRL among certificates goes to the CRLs.
    CrlAmongCertificates,
    /// It takes the place of the older CRL of the same issuer.
    ReplacesOlder,
    /// Its validity is over, or a newer CRL should have come.
    Expired,
    /// Its validity has not begun.
    NotYetValid,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SkipReason {
    /// The same stands earlier in the files.
    Repeated,
    /// The controller holds it already.
    AlreadyHeld,
    /// An application's certificate in a file with authorities, where only authorities were asked for; or certificates,
    /// where only CRLs were.
    NotAskedFor,
}

impl TrustPlan {
    /// `held`: what the controller has; without it, only the files are compared with each other.
    pub fn new(
        files: &[TrustFile],
        destination: Destination,
        generation: FirmwareGeneration,
        limits: ListLimits,
        now: DateTime<Utc>,
        held: Option<&TrustSnapshot>,
    ) -> Self {
        let sorter = Sorter { destination, generation, now, held };
        let mut seen = BTreeSet::new();
        let mut items = Vec::new();
        for file in files {
            let several = file.bundle.certificates.len() + file.bundle.crls.len() > 1;
            let mut number = 0;
            let mut plan = |id: String, thing: Thing, fate: Fate| {
                number += 1;
                let extension = if matches!(thing, Thing::Crl { .. }) { "crl" } else { "der" };
                let shown_as = shown_as(&file.file_name, several.then_some((number, extension)));
                let fate = match fate {
                    Fate::Goes { .. } if !seen.insert(id) => Fate::Skipped(SkipReason::Repeated),
                    fate => fate,
                };
                items.push(Planned { file_name: file.file_name.clone(), shown_as, thing, fate });
            };
            let with_application = file.bundle.certificates.iter().any(|c| !c.is_authority());
            let with_authority = file.bundle.certificates.iter().any(Certificate::is_authority);
            for certificate in &file.bundle.certificates {
                let summary = certificate.summary();
                let authority = certificate.is_authority();
                let fate =
                    sorter.certificate(certificate, &summary.thumbprint, authority, with_application, with_authority);
                let id = summary.thumbprint.clone();
                plan(id, Thing::Certificate { der: certificate.der().to_vec(), summary, authority }, fate);
            }
            for crl in &file.bundle.crls {
                let summary = crl.summary();
                let fate = sorter.crl(crl, &summary, !file.bundle.certificates.is_empty());
                plan(summary.id.clone(), Thing::Crl { der: crl.der().to_vec(), summary }, fate);
            }
        }
        let have = held.map_or([0; 3], |held| [held.trusted.len(), held.issuers.len(), held.crls.len()]);
        Self { items, have, limits }
    }

    /// For a controller whose lists are known.
    pub fn for_controller(files: &[TrustFile], destination: Destination, held: &TrustSnapshot) -> Self {
        Self::new(files, destination, held.generation, held.limits, held.clock, Some(held))
    }

    /// Whether something is there that a person should agree to: a note, or something left out.
    pub fn needs_a_look(&self) -> bool {
        self.items.iter().any(|item| match &item.fate {
            Fate::Goes { notes, .. } => !notes.is_empty(),
            Fate::Skipped(_) | Fate::Refused(_) => true,
        })
    }

    /// How many go there.
    pub fn count(&self, target: Target) -> usize {
        self.going().filter(|(to, _)| *to == target).count()
    }

    /// Why nothing of this may be sent: something is refused, nothing is new, it does not fit.
    pub fn check(&self) -> Result<(), Problem> {
        for item in &self.items {
            if let Fate::Refused(problem) = &item.fate {
                return Err(problem.clone());
            }
        }
        if self.going().next().is_none() {
            let crl = self.items.first().is_some_and(|item| matches!(item.thing, Thing::Crl { .. }));
            return Err(match self.items.first() {
                None => ErrorCode::BadCertificate,
                Some(_) if crl => ErrorCode::DuplicateCrl,
                Some(_) => ErrorCode::DuplicateCertificate,
            }
            .into());
        }
        let replacing = self.items.iter().filter(|item| item.replaces()).count();
        for (target, have, limit, code) in [
            (Target::Trusted, self.have[0], self.limits.trusted, ErrorCode::ListFull),
            (Target::Issuers, self.have[1], self.limits.issuers, ErrorCode::ListFull),
            (Target::Crls, self.have[2].saturating_sub(replacing), self.limits.crls, ErrorCode::TooManyCrls),
        ] {
            let total = have + self.count(target);
            if self.count(target) > 0 && total > limit {
                return Err(Problem::with_detail(code, format!("{total} > {limit}")));
            }
        }
        let bytes: usize = self.going().map(|(_, item)| ENTRY_BYTES + item.thing.der().len().div_ceil(3) * 4).sum();
        if bytes > MAX_REQUEST_BYTES { Err(ErrorCode::RequestTooLarge.into()) } else { Ok(()) }
    }

    /// What is to be sent.
    pub(super) fn steps(&self) -> Vec<TrustStep> {
        let of = |target: Target| -> Vec<(String, Base64Bytes)> {
            self.going()
                .filter(|(to, _)| *to == target)
                .map(|(_, item)| (item.shown_as.clone(), Base64Bytes(item.thing.der().to_vec())))
                .collect()
        };
        let mut steps = Vec::new();
        for (target, list) in [(Target::Issuers, ClientList::Issuers), (Target::Trusted, ClientList::Trusted)] {
            let certificates = of(target);
            if !certificates.is_empty() {
                steps.push(TrustStep::Add { list, certificates });
            }
        }
        let crls = of(Target::Crls);
        if !crls.is_empty() {
            steps.push(TrustStep::AddCrls { crls });
        }
        steps
    }

    fn going(&self) -> impl Iterator<Item = (Target, &Planned)> {
        self.items.iter().filter_map(|item| match item.fate {
            Fate::Goes { to, .. } => Some((to, item)),
            _ => None,
        })
    }
}

/// Generous for what stands around one certificate in a request: its name, brackets.
const ENTRY_BYTES: usize = 300;

impl Planned {
    fn replaces(&self) -> bool {
        matches!(&self.fate, Fate::Goes { notes, .. } if notes.contains(&Note::ReplacesOlder))
    }
}

impl Thing {
    pub fn der(&self) -> &[u8] {
        match self {
            Self::Certificate { der, .. } | Self::Crl { der, .. } => der,
        }
    }
}

/// Decides about one certificate or CRL at a time.
struct Sorter<'a> {
    destination: Destination,
    generation: FirmwareGeneration,
    now: DateTime<Utc>,
    held: Option<&'a TrustSnapshot>,
}

impl Sorter<'_> {
    fn certificate(
        &self,
        certificate: &Certificate,
        thumbprint: &str,
        authority: bool,
        with_application: bool,
        with_authority: bool,
    ) -> Fate {
        let legacy = self.generation == FirmwareGeneration::Legacy;
        let (to, note) = match (self.destination, authority) {
            (Destination::Crls, _) => return Fate::Skipped(SkipReason::NotAskedFor),
            (Destination::Issuers, _) if legacy => return Fate::Refused(ErrorCode::FirmwareTooOld.into()),
            (Destination::Issuers, false) if with_authority => return Fate::Skipped(SkipReason::NotAskedFor),
            (Destination::Issuers, false) => {
                return Fate::Refused(Problem::with_detail(ErrorCode::NotAnAuthority, thumbprint));
            }
            (Destination::Issuers, true) => (Target::Issuers, None),
            (Destination::ByKind | Destination::Trusted, false) => (Target::Trusted, None),
            (Destination::ByKind, true) if legacy => (Target::Trusted, Some(Note::TrustsAllItIssues)),
            (Destination::ByKind, true) => (Target::Issuers, None),
            (Destination::Trusted, true) if with_application && !legacy => {
                (Target::Issuers, Some(Note::OnlyCompletesAChain))
            }
            (Destination::Trusted, true) => (Target::Trusted, Some(Note::TrustsAllItIssues)),
        };
        let list = if to == Target::Issuers { ClientList::Issuers } else { ClientList::Trusted };
        if self.held.is_some_and(|held| held.holds(list, thumbprint)) {
            return Fate::Skipped(SkipReason::AlreadyHeld);
        }
        let mut notes: Vec<Note> = note.into_iter().collect();
        if certificate.not_after() < self.now {
            notes.push(Note::Expired);
        } else if certificate.not_before() > self.now {
            notes.push(Note::NotYetValid);
        }
        Fate::Goes { to, notes }
    }

    fn crl(&self, crl: &Crl, summary: &CrlSummary, among_certificates: bool) -> Fate {
        if crl.der().len() > MAX_SENT_CRL_BYTES {
            let detail = format!("{} > {MAX_SENT_CRL_BYTES} bytes", crl.der().len());
            return Fate::Refused(Problem::with_detail(ErrorCode::RequestTooLarge, detail));
        }
        if self.held.is_some_and(|held| held.holds_crl(&summary.id)) {
            return Fate::Skipped(SkipReason::AlreadyHeld);
        }
        let mut notes = Vec::new();
        if self.destination != Destination::Crls && among_certificates {
            notes.push(Note::CrlAmongCertificates);
        }
        if summary.next_update.is_some_and(|next| next < self.now) {
            notes.push(Note::Expired);
        } else if summary.this_update > self.now {
            notes.push(Note::NotYetValid);
        }
        Fate::Goes { to: Target::Crls, notes }
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
