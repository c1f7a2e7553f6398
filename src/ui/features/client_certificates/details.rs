//! One certificate or CRL in full.

use chrono::{DateTime, Utc};

use super::{PaneKind, RejectionDetails, ShownLists};
use crate::jobs::TrustSnapshot;
use crate::model::{CertificateSummary, ErrorCode, ListedCertificate, Problem};
use crate::pki::{self, AlternativeName, Certificate, CrlFlaw, RevocationReason};
use crate::texts::{TextKey, Zone};
use crate::ui::features::client_certificates::TrustForm;
use crate::ui::model::Model;

/// What the dialog shows.
#[derive(Debug)]
#[allow(clippy::large_enum_variant, reason = "the dialog boxes it as a whole")]
pub enum DetailsView {
    /// A certificate, with the chain above it.
    Certificate(CertificateView),
    /// A CRL, with its entries.
    Crl(CrlView),
}

/// A line of a certificate or CRL.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DetailField {
    pub label: TextKey,
    /// One under the other.
    pub lines: Vec<String>,
    pub monospace: bool,
}

/// One certificate, and the authorities above it.
#[derive(Debug)]
pub struct CertificateView {
    pub title: String,
    pub fields: Vec<DetailField>,
    /// From the root down to the certificate itself.
    pub chain: Vec<ChainNode>,
    /// Why the controller refused it last.
    pub refused: Option<RejectionDetails>,
    pub pem: String,
}

/// One step of a chain.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChainNode {
    pub name: String,
    /// The list it is in; `None` for what the client only sent, and for what is missing.
    pub list: Option<PaneKind>,
    /// The worst first.
    pub states: Vec<ChainState>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ChainState {
    /// The certificate of this issuer is not at hand.
    Missing,
    /// A CRL names it.
    Revoked,
    Expired,
    NotYetValid,
    /// It is no CA, so it must not have issued anything.
    NotAnAuthority,
    /// No usable CRL of this authority is held.
    WithoutCrl,
    /// The client sent it; it counts only where some other member of the chain is trusted.
    OnlySent,
}

/// One CRL, and whom it revokes.
#[derive(Debug)]
pub struct CrlView {
    pub title: String,
    pub fields: Vec<DetailField>,
    /// Why nothing can be checked with it.
    pub flaw: Option<CrlFlaw>,
    /// By serial number.
    pub entries: Vec<CrlLine>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CrlLine {
    pub serial_number: String,
    pub date: String,
    pub reason: RevocationReason,
    /// What it is called, if the controller knows it.
    pub name: Option<String>,
}

/// Chains are not longer.
const MAX_CHAIN: usize = 10;

impl CertificateView {
    /// Of the certificate with this thumbprint; `None` if it is not held any more.
    pub fn of(held: &TrustSnapshot, kind: PaneKind, thumbprint: &str, zone: Zone) -> Option<Result<Self, Problem>> {
        let (der, summary, file_name, sent, refused) = match kind {
            PaneKind::Trusted | PaneKind::Issuers => {
                let list = if kind == PaneKind::Issuers { &held.issuers } else { &held.trusted };
                let found = list.iter().find(|listed| listed.summary.thumbprint == thumbprint)?;
                (&found.certificate, &found.summary, found.file_name.clone(), Vec::new(), None)
            }
            PaneKind::Rejected => {
                let found = held.rejected.iter().find(|client| client.summary.thumbprint == thumbprint)?;
                let sent = found.chain.iter().filter_map(|der| Certificate::from_der(&der.0).ok()).collect();
                let refused = Some(RejectionDetails::of(found, zone));
                (&found.certificate, &found.summary, String::new(), sent, refused)
            }
            PaneKind::Crls => return None,
        };
        let certificate = match Certificate::from_der(&der.0) {
            Ok(certificate) => certificate,
            Err(error) => return Some(Err(Problem::with_detail(ErrorCode::BadCertificate, error))),
        };
        Some(Ok(Self {
            title: summary.issued_to.clone(),
            fields: fields(&certificate, summary, file_name, zone),
            chain: Chain { held, sent: &sent }.above(&certificate, kind),
            refused,
            pem: certificate.to_pem(),
        }))
    }
}

fn fields(certificate: &Certificate, summary: &CertificateSummary, file_name: String, zone: Zone) -> Vec<DetailField> {
    use TextKey as T;
    let one = |label, text: String| DetailField { label, lines: vec![text], monospace: false };
    let number = |label, text: String| DetailField { label, lines: vec![text], monospace: true };
    let usages = |none: bool, lines: Vec<String>| if none { Vec::new() } else { vec![lines.join(", ")] };
    let key_usages = certificate.key_usages();
    let purposes = certificate.extended_key_usages();
    let ca = certificate.basic_constraints().filter(|constraints| constraints.ca);
    let fields = vec![
        one(T::TrustFileName, file_name),
        one(T::TrustSubject, certificate.subject().to_owned()),
        one(T::TrustIssuerFull, certificate.issuer().to_owned()),
        number(T::ColumnSerial, summary.serial_number.clone()),
        one(T::TrustValidFrom, zone.date_time(certificate.not_before())),
        one(T::TrustValidUntil, zone.date_time(certificate.not_after())),
        DetailField {
            label: T::TrustAlternativeNames,
            lines: certificate.alternative_names().iter().map(AlternativeName::to_string).collect(),
            monospace: false,
        },
        one(T::KeyLength, certificate.key_bits().to_string()),
        DetailField {
            label: T::TrustKeyUsages,
            lines: usages(
                key_usages.is_none(),
                key_usages.iter().copied().flatten().map(|u| u.as_str().into()).collect(),
            ),
            monospace: false,
        },
        DetailField {
            label: T::TrustPurposes,
            lines: usages(purposes.is_none(), purposes.iter().copied().flatten().map(|p| p.as_str().into()).collect()),
            monospace: false,
        },
        DetailField {
            label: T::TrustAuthority,
            lines: ca
                .map(|ca| ca.path_length.map_or_else(|| "CA".to_owned(), |most| format!("CA, pathlen {most}")))
                .into_iter()
                .collect(),
            monospace: false,
        },
        number(T::TrustThumbprint, summary.thumbprint.clone()),
        number(T::TrustSha256, hex::encode_upper(certificate.sha256())),
    ];
    fields.into_iter().filter(|field| field.lines.iter().any(|line| !line.is_empty())).collect()
}

/// Where issuers are looked for.
struct Chain<'a> {
    held: &'a TrustSnapshot,
    sent: &'a [Certificate],
}

impl Chain<'_> {
    /// The certificate and everything above it, the uppermost first.
    fn above(&self, certificate: &Certificate, kind: PaneKind) -> Vec<ChainNode> {
        let mut nodes = vec![self.node(certificate, Some(kind), false)];
        let mut last = certificate.clone();
        while nodes.len() < MAX_CHAIN && !last.is_self_signed() {
            match self.issuer(&last) {
                Some((issuer, list)) => {
                    nodes.push(self.node(&issuer, list, true));
                    last = issuer;
                }
                None => {
                    let states = vec![ChainState::Missing];
                    nodes.push(ChainNode { name: last.issuer().to_owned(), list: None, states });
                    break;
                }
            }
        }
        nodes.reverse();
        nodes
    }

    fn node(&self, certificate: &Certificate, list: Option<PaneKind>, issued: bool) -> ChainNode {
        let now = self.held.clock;
        let summary = certificate.summary();
        let mut states = Vec::new();
        let mut add = |applies: bool, state| states.extend(applies.then_some(state));
        add(self.is_revoked(certificate), ChainState::Revoked);
        add(certificate.not_after() < now, ChainState::Expired);
        add(certificate.not_before() > now, ChainState::NotYetValid);
        add(issued && !certificate.is_ca(), ChainState::NotAnAuthority);
        add(issued && self.held.health.without_crl.contains(&summary.thumbprint), ChainState::WithoutCrl);
        add(list.is_none(), ChainState::OnlySent);
        ChainNode { name: summary.issued_to, list, states }
    }

    /// Trusted ones first, what was sent last.
    fn issuer(&self, certificate: &Certificate) -> Option<(Certificate, Option<PaneKind>)> {
        let name = certificate.summary().issued_by;
        // Parsing them all would take long with full lists.
        let of = |list: &[ListedCertificate]| -> Vec<Certificate> {
            let named = list.iter().filter(|listed| listed.summary.issued_to == name);
            named.filter_map(|listed| Certificate::from_der(&listed.certificate.0).ok()).collect()
        };
        let issued = |issuer: &Certificate| {
            issuer.subject() == certificate.issuer() && issuer != certificate && certificate.verify_signed_by(issuer)
        };
        let held = [(&self.held.trusted, PaneKind::Trusted), (&self.held.issuers, PaneKind::Issuers)];
        held.into_iter()
            .find_map(|(list, kind)| of(list).into_iter().find(issued).map(|issuer| (issuer, Some(kind))))
            .or_else(|| self.sent.iter().find(|sent| issued(sent)).map(|issuer| (issuer.clone(), None)))
    }

    fn is_revoked(&self, certificate: &Certificate) -> bool {
        let name = certificate.summary().issued_by;
        self.held
            .crls
            .iter()
            .zip(&self.held.health.crls)
            .filter(|(listed, health)| {
                listed.summary.issuer == name && matches!(health.issuer, pki::CrlIssuer::Held { .. })
            })
            .filter_map(|(listed, _)| pki::Crl::from_der(&listed.crl.as_ref()?.0).ok())
            .any(|crl| crl.revoked(certificate).is_some())
    }
}

impl CrlView {
    /// Of the CRL with this id; `None` if it is not held any more.
    pub fn of(held: &TrustSnapshot, id: &str, zone: Zone) -> Option<Result<Self, Problem>> {
        use TextKey as T;
        let at = held.crls.iter().position(|listed| listed.summary.id == id)?;
        let listed = &held.crls[at];
        let crl = match pki::Crl::from_der(&listed.crl.as_ref()?.0) {
            Ok(crl) => crl,
            Err(error) => return Some(Err(Problem::with_detail(ErrorCode::BadCrl, error))),
        };
        let authorities = held.trusted.iter().chain(&held.issuers);
        let authorities = authorities.filter_map(|listed| Certificate::from_der(&listed.certificate.0).ok());
        let flaw = held.health.crls.get(at).and_then(|health| health.flaw(&crl, authorities, held.clock));
        let date = |at: DateTime<Utc>| zone.date_time(at);
        let one = |label, text: String| DetailField { label, lines: vec![text], monospace: false };
        let fields = vec![
            one(T::TrustFileName, listed.file_name.clone()),
            one(T::TrustIssuerFull, crl.issuer().to_owned()),
            one(T::CrlNumber, crl.number().unwrap_or_default().to_owned()),
            one(T::CrlThisUpdate, date(crl.this_update())),
            one(T::CrlNextUpdate, crl.next_update().map(date).unwrap_or_default()),
            one(T::CrlSignature, crl.signature_algorithm().to_owned()),
            DetailField { label: T::TrustThumbprint, lines: vec![id.to_owned()], monospace: true },
        ];
        let fields = fields.into_iter().filter(|field| field.lines.iter().any(|line| !line.is_empty())).collect();
        let listed_ones = held.trusted.iter().chain(&held.issuers).map(|listed| &listed.summary);
        let known: std::collections::HashMap<&str, &str> = listed_ones
            .chain(held.rejected.iter().map(|client| &client.summary))
            .filter(|summary| summary.issued_by == listed.summary.issuer)
            .map(|summary| (summary.serial_number.as_str(), summary.issued_to.as_str()))
            .collect();
        let entries = crl.entries().map(|(serial_number, revoked)| CrlLine {
            name: known
                .get(serial_number.trim_start_matches("00"))
                .or(known.get(serial_number.as_str()))
                .map(|n| (*n).to_owned()),
            date: date(revoked.date),
            reason: revoked.reason,
            serial_number,
        });
        Some(Ok(Self { title: listed.summary.issuer.clone(), fields, flaw, entries: entries.collect() }))
    }
}

impl Model {
    /// Shows in full what the cursor is on.
    pub(in crate::ui) fn open_details(&mut self) {
        let zone = self.zone;
        let Some(form) = self.top::<TrustForm>() else { return };
        let Some((pane, held)) = form.focused().zip(form.held.as_deref()) else { return };
        let Some(entry) = pane.cursor_entry() else { return };
        let view = match form.shows {
            ShownLists::Clients => {
                CertificateView::of(held, pane.kind, &entry.id, zone).map(|view| view.map(DetailsView::Certificate))
            }
            ShownLists::Crls => CrlView::of(held, &entry.id, zone).map(|view| view.map(DetailsView::Crl)),
        };
        match view {
            Some(Ok(view)) => self.open(view),
            Some(Err(problem)) => self.show_problem(problem),
            // It went just now.
            None => {}
        }
    }
}
