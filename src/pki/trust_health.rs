use chrono::{DateTime, Utc};
use serde::Serialize;

use super::{Certificate, Crl};

/// What is wrong with CRLs and the authorities they are for, before a client is refused because of it.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct TrustHealth {
    /// One for each CRL, in their order.
    pub crls: Vec<CrlHealth>,
    /// Thumbprints of the authorities that no usable CRL is held of: whether a certificate from them was revoked is not
    /// known, so clients with one are refused.
    pub without_crl: Vec<String>,
}

#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct CrlHealth {
    pub issuer: CrlIssuer,
    pub dates: CrlDates,
}

/// Whose CRL it is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CrlIssuer {
    /// An authority in the trusted or issuers list signed it.
    Held { thumbprint: String },
    /// It carries the name of this authority, which did not sign it: it is of no use.
    NotSignedBy { thumbprint: String },
    /// No authority of that name is held: it is of no use until one is.
    Missing,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CrlDates {
    Current,
    /// A newer one should have come: certificates of its issuer are refused until it does.
    Expired,
    NotYetValid,
}

impl CrlHealth {
    /// Whether certificates can be checked with it.
    pub fn is_usable(&self) -> bool {
        matches!(self.issuer, CrlIssuer::Held { .. }) && self.dates == CrlDates::Current
    }
}

impl TrustHealth {
    /// `authorities`: those in the trusted and issuers lists; other certificates among them are passed over.
    pub fn of<'a>(crls: impl IntoIterator<Item = &'a Crl>, authorities: &[&Certificate], now: DateTime<Utc>) -> Self {
        let crls: Vec<CrlHealth> = crls
            .into_iter()
            .map(|crl| CrlHealth { issuer: issuer(crl, authorities), dates: dates(crl, now) })
            .collect();
        let without_crl = authorities
            .iter()
            .filter(|authority| authority.is_ca() && authority.application_uri().is_none())
            .map(|authority| authority.thumbprint_sha1())
            .filter(|own| {
                !crls.iter().any(|crl| {
                    crl.is_usable() && matches!(&crl.issuer, CrlIssuer::Held { thumbprint } if thumbprint == own)
                })
            })
            .collect();
        Self { crls, without_crl }
    }
}

fn issuer(crl: &Crl, authorities: &[&Certificate]) -> CrlIssuer {
    let name = crl.summary().issuer;
    match authorities.iter().find(|authority| authority.is_ca() && authority.summary().issued_to == name) {
        Some(authority) => CrlIssuer::Held { thumbprint: authority.thumbprint_sha1() },
        None => CrlIssuer::Missing,
    }
}

fn dates(crl: &Crl, now: DateTime<Utc>) -> CrlDates {
    let summary = crl.summary();
    if summary.this_update > now {
        CrlDates::NotYetValid
    } else if summary.next_update.is_some_and(|next| next < now) {
        CrlDates::Expired
    } else {
        CrlDates::Current
    }
}
