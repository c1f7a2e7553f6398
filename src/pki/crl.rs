use std::cmp::Ordering;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use chrono::{DateTime, SecondsFormat, Utc};
use sha1::{Digest as _, Sha1};
use x509_parser::prelude::{
    CertificateRevocationList, FromDer, ParsedExtension, RevokedCertificate, X509Extension, X509Name,
};

use super::certificate_fields::{date, range_within, significant};
use super::distribution_point::{CrlScope, RevocationReasons};
use super::name::quoted;
use super::signature::{SignatureAlgorithm, SignatureCheck};
use super::size::check_size;
use super::{Certificate, CrlUnusable, OutOfScope, PkiError, RevocationReason, name, pem, tlv};
use crate::model::{Cause, CrlSummary, with_cause};

/// The largest revocation list that is read, in bytes of DER: room for 150,000 entries with long serial numbers.
pub const MAX_CRL_BYTES: usize = 8 * 1024 * 1024;

/// One X.509 certificate revocation list, found whole: nothing missing, nothing after it, no extension twice, one
/// signature algorithm. Indexed once, so that looking a certificate up does not depend on how long the list is.
///
/// Nothing is said about who signed it, or whether it is of today. One that cannot be used for a full check can be
/// read and shown; [`Crl::unusable`] says why.
#[derive(Clone, PartialEq, Eq)]
pub struct Crl {
    der: Arc<[u8]>,
    facts: Arc<CrlFields>,
}

#[derive(Debug, PartialEq, Eq)]
struct CrlFields {
    issuer: String,
    issuer_title: String,
    issuer_folded: Vec<u8>,
    authority_key_id: Option<Vec<u8>>,
    number: Option<Vec<u8>>,
    number_text: Option<String>,
    this_update: DateTime<Utc>,
    next_update: Option<DateTime<Utc>>,
    /// Sorted by serial number.
    entries: Vec<RevokedEntry>,
    unusable: Option<CrlUnusable>,
    scope: CrlScope,
    signature_algorithm: SignatureAlgorithm,
    signed: Range<usize>,
    signature: Vec<u8>,
}

/// Small, because a list may have a hundred thousand of them: the serial number itself stays in the DER.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct RevokedEntry {
    start: u32,
    length: u32,
    date: i64,
    reason: RevocationReason,
}

/// What a revocation list says of one certificate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RevocationEntry {
    /// When the certificate was revoked.
    pub date: DateTime<Utc>,
    /// Why it was revoked; [`RevocationReason::Unspecified`] where the list does not tell.
    pub reason: RevocationReason,
}

impl Crl {
    /// From DER and nothing but DER, of at most [`MAX_CRL_BYTES`].
    pub fn from_der(der: &[u8]) -> Result<Self, PkiError> {
        check_size(der, MAX_CRL_BYTES)?;
        let (rest, parsed) = CertificateRevocationList::from_der(der).map_err(with_cause(PkiError::NotACrl))?;
        if !rest.is_empty() {
            return Err(PkiError::TrailingBytes(rest.len()));
        }
        let facts = Arc::new(CrlFields::of(der, &parsed)?);
        if tlv::is_signed_object(der) {
            Ok(Self { der: der.into(), facts })
        } else {
            Err(PkiError::NotACrl(Cause::finding(UNREADABLE)))
        }
    }

    /// The list itself, as it was read.
    pub fn der(&self) -> &[u8] {
        &self.der
    }

    /// As PEM, ending with a line feed.
    pub fn to_pem(&self) -> String {
        pem::crl(&self.der)
    }

    /// What a list of lists shows of it.
    pub fn summary(&self) -> CrlSummary {
        CrlSummary {
            issuer: self.facts.issuer_title.clone(),
            this_update: self.facts.this_update,
            next_update: self.facts.next_update,
            entries: self.facts.entries.len(),
            number: self.facts.number_text.clone(),
            id: self.id(),
        }
    }

    /// SHA-1 of the DER in upper-case hexadecimal, like the thumbprint of a certificate.
    pub fn id(&self) -> String {
        hex::encode_upper(Sha1::digest(&self.der))
    }

    /// The whole name of the authority, without control characters.
    pub fn issuer(&self) -> &str {
        &self.facts.issuer
    }

    /// The key identifier of the authority, if there is one.
    pub fn authority_key_id(&self) -> Option<&[u8]> {
        self.facts.authority_key_id.as_deref()
    }

    /// When the authority made it.
    pub fn this_update(&self) -> DateTime<Utc> {
        self.facts.this_update
    }

    /// When the authority promised the next one, if it did.
    pub fn next_update(&self) -> Option<DateTime<Utc>> {
        self.facts.next_update
    }

    /// The CRL number in decimal, if there is one.
    pub fn number(&self) -> Option<&str> {
        self.facts.number_text.as_deref()
    }

    /// Its number, if there is one, and its date: `number 7 of 2026-11-26T15:16:44Z`.
    pub fn number_and_date(&self) -> String {
        let date = self.this_update().to_rfc3339_opts(SecondsFormat::Secs, true);
        self.number().map_or_else(|| format!("of {date}"), |number| format!("number {number} of {date}"))
    }

    /// The name of the algorithm it is signed with.
    pub fn signature_algorithm(&self) -> &str {
        self.facts.signature_algorithm.name()
    }

    /// Why it can say of no certificate by itself that it is not revoked, if it cannot: it is a delta or indirect list,
    /// it is only about some reasons, or something in it is critical and not understood (RFC 5280 §5.2).
    pub fn unusable(&self) -> Option<CrlUnusable> {
        self.facts.unusable.clone().or(self.facts.scope.unusable())
    }

    /// Which certificates of its authority it leaves out; `None` if none.
    pub fn limits(&self) -> Option<OutOfScope> {
        self.facts.scope.limits()
    }

    /// The reasons for which it would name the certificate if it were revoked for them; or why it would not. Says
    /// nothing about dates and signatures.
    pub(super) fn covers(&self, certificate: &Certificate) -> Result<RevocationReasons, OutOfScope> {
        let is_ca = certificate.basic_constraints().is_some_and(|constraints| constraints.ca);
        let facts = certificate.facts();
        self.facts.scope.covers(is_ca, &facts.issuer_folded, &facts.distribution_points)
    }

    /// Why nothing in it counts as a full list, even together with others.
    pub(super) fn not_understood(&self) -> Option<CrlUnusable> {
        self.facts.unusable.clone().or(self.facts.scope.indirect.then_some(CrlUnusable::Indirect))
    }

    pub(super) fn is_only_about_authorities(&self) -> bool {
        self.facts.scope.is_only_about_authorities()
    }

    /// Whether only the newer of both counts: they are of the same authority (the same name and, where both say it, the
    /// same key) and about the same certificates.
    pub fn has_same_scope_as(&self, other: &Self) -> bool {
        self.facts.issuer_folded == other.facts.issuer_folded
            && self.facts.scope == other.facts.scope
            && match (self.authority_key_id(), other.authority_key_id()) {
                (Some(one), Some(other)) => one == other,
                _ => true,
            }
    }

    /// Whether it is a later one than `other` of the same authority: by the date, then by the CRL number where both
    /// have one. A list is not newer than itself.
    ///
    /// Numbers go up (RFC 5280 §5.2.3), but an authority that was set up anew starts again:
    /// [`Crl::number_starts_again_after`].
    pub fn is_newer_than(&self, other: &Self) -> bool {
        self.facts.this_update.cmp(&other.facts.this_update).then(self.compare_numbers(other)).is_gt()
    }

    /// Whether it is newer than `other` of the same authority, but its number is lower: both numbers, its own first.
    pub fn number_starts_again_after(&self, other: &Self) -> Option<(String, String)> {
        let again = self.facts.this_update > other.facts.this_update && self.compare_numbers(other).is_lt();
        again.then(|| Some((self.facts.number_text.clone()?, other.facts.number_text.clone()?))).flatten()
    }

    fn compare_numbers(&self, other: &Self) -> Ordering {
        match (&self.facts.number, &other.facts.number) {
            (Some(one), Some(other)) => (one.len(), one).cmp(&(other.len(), other)),
            _ => Ordering::Equal,
        }
    }

    /// Whether the authority may have issued the certificate: the same name. Keys are not looked at.
    pub fn is_by_issuer_of(&self, certificate: &Certificate) -> bool {
        self.facts.issuer_folded == certificate.facts().issuer_folded
    }

    /// Whether the certificate carries the name of its authority and, where both say it, the key identifier. The
    /// signature is not looked at.
    pub fn is_of(&self, authority: &Certificate) -> bool {
        self.facts.issuer_folded == authority.facts().subject_folded
            && match (self.authority_key_id(), authority.subject_key_id()) {
                (Some(wanted), Some(has)) => wanted == has,
                _ => true,
            }
    }

    /// What it says of a certificate, if it lists it. Says nothing about certificates of other authorities.
    ///
    /// An indirect list never does: its entries may be about certificates of any issuer.
    pub fn revoked(&self, certificate: &Certificate) -> Option<RevocationEntry> {
        if self.facts.scope.indirect || !self.is_by_issuer_of(certificate) {
            return None;
        }
        let serial = certificate.facts().serial.as_slice();
        let entries = &self.facts.entries;
        let first = entries.partition_point(|entry| entry.serial(&self.der) < serial);
        let same = entries[first..].iter().take_while(|entry| entry.serial(&self.der) == serial);
        // A list may name one certificate twice; what revokes it counts.
        let entry = same.into_iter().find(|entry| entry.reason != RevocationReason::RemoveFromCrl)?;
        Some(RevocationEntry { date: DateTime::from_timestamp(entry.date, 0)?, reason: entry.reason })
    }

    /// Every entry: the serial number in upper-case hexadecimal, and what is said of it. Sorted by serial number.
    pub fn entries(&self) -> impl Iterator<Item = (String, RevocationEntry)> + '_ {
        self.facts.entries.iter().filter_map(|entry| {
            let serial = hex::encode_upper(entry.serial(&self.der));
            Some((serial, RevocationEntry { date: DateTime::from_timestamp(entry.date, 0)?, reason: entry.reason }))
        })
    }

    /// Whether its signature was made with the key of `issuer`. Names, dates and usages are not looked at. Reads the
    /// whole list.
    pub fn verify_signed_by(&self, issuer: &Certificate) -> bool {
        self.signature_by(issuer) == SignatureCheck::Valid
    }

    pub(super) fn signature_by(&self, issuer: &Certificate) -> SignatureCheck {
        let facts = &self.facts;
        facts.signature_algorithm.verify(&issuer.facts().public_key, &self.der[facts.signed.clone()], &facts.signature)
    }

    /// Orders lists of one issuer. Unlike [`Crl::is_newer_than`] also where some have a number and some have none.
    pub(super) fn age_key(&self) -> impl Ord + '_ {
        let number = self.facts.number.as_deref().unwrap_or_default();
        (self.facts.this_update, number.len(), number)
    }

    pub(super) fn issuer_folded(&self) -> &[u8] {
        &self.facts.issuer_folded
    }

    pub(super) fn algorithm(&self) -> &SignatureAlgorithm {
        &self.facts.signature_algorithm
    }
}

impl fmt::Debug for Crl {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Crl({:?}, {} entries, {})", self.facts.issuer_title, self.facts.entries.len(), self.id())
    }
}

impl RevokedEntry {
    fn serial<'a>(&self, der: &'a [u8]) -> &'a [u8] {
        let start = self.start as usize;
        &der[start..start + self.length as usize]
    }
}

impl CrlFields {
    fn of(der: &[u8], parsed: &CertificateRevocationList<'_>) -> Result<Self, PkiError> {
        let damaged = || PkiError::NotACrl(Cause::finding("a date is out of range"));
        let list = &parsed.tbs_cert_list;
        if parsed.signature_algorithm != list.signature {
            return Err(PkiError::SignatureAlgorithms);
        }
        if !matches!(list.version.map(|version| version.0), None | Some(1)) {
            return Err(PkiError::NotACrl(Cause::finding("its version is unknown")));
        }
        // The only error is that an extension is repeated.
        parsed.tbs_cert_list.extensions_map().map_err(|_| PkiError::RepeatedExtension)?;
        let entries = &list.revoked_certificates;
        // The parser passes over a table of entries that it cannot read, as if there were none.
        if count_entries(der) != Some(entries.len()) {
            return Err(PkiError::NotACrl(Cause::finding("its entries are damaged")));
        }
        let mut facts = Self {
            issuer: name::full(parsed.issuer()),
            issuer_title: name::title(parsed.issuer()),
            issuer_folded: name::folded(parsed.issuer()),
            authority_key_id: None,
            number: None,
            number_text: None,
            this_update: date(parsed.last_update()).ok_or_else(damaged)?,
            next_update: parsed.next_update().map(|at| date(at).ok_or_else(damaged)).transpose()?,
            entries: Vec::with_capacity(entries.len()),
            unusable: None,
            scope: CrlScope::default(),
            signature_algorithm: SignatureAlgorithm::of(&parsed.signature_algorithm),
            signed: range_within(der, list.as_ref()).ok_or(PkiError::NotACrl(Cause::finding(UNREADABLE)))?,
            signature: parsed.signature_value.data.to_vec(),
        };
        for extension in parsed.extensions() {
            facts.read(extension, parsed.issuer())?;
        }
        for entry in entries {
            facts.add(der, entry)?;
        }
        facts.entries.sort_by(|one, other| one.serial(der).cmp(other.serial(der)));
        Ok(facts)
    }

    fn read(&mut self, extension: &X509Extension<'_>, issuer: &X509Name<'_>) -> Result<(), PkiError> {
        let damaged = PkiError::NotACrl(Cause::finding("one of its extensions is damaged"));
        match extension.parsed_extension() {
            _ if extension.oid.to_id_string() == ISSUING_DISTRIBUTION_POINT => {
                self.scope = CrlScope::read(extension.value, issuer).ok_or(damaged)?;
            }
            ParsedExtension::AuthorityKeyIdentifier(authority) => {
                self.authority_key_id = authority.key_identifier.as_ref().map(|id| id.0.to_vec());
            }
            ParsedExtension::CRLNumber(number) => {
                let bytes = number.to_bytes_be();
                if bytes.len() > MAX_NUMBER_BYTES {
                    return Err(PkiError::NotACrl(Cause::finding("its number is too long")));
                }
                self.number_text = Some(number.to_string());
                self.number = Some(bytes);
            }
            ParsedExtension::ParseError { .. } => return Err(damaged),
            _ if extension.oid.to_id_string() == DELTA_CRL_INDICATOR => {
                self.unusable(CrlUnusable::Delta);
            }
            _ if extension.critical => {
                self.unusable(CrlUnusable::CriticalExtension(quoted(&extension.oid.to_id_string())));
            }
            _ => {}
        }
        Ok(())
    }

    fn add(&mut self, der: &[u8], entry: &RevokedCertificate<'_>) -> Result<(), PkiError> {
        let damaged = PkiError::NotACrl(Cause::finding("its entries are damaged"));
        let mut reason = RevocationReason::Unspecified;
        for extension in entry.extensions() {
            match extension.parsed_extension() {
                ParsedExtension::ReasonCode(code) => reason = RevocationReason::of(*code).ok_or(damaged.clone())?,
                ParsedExtension::InvalidityDate(_) => {}
                ParsedExtension::ParseError { .. } => return Err(damaged),
                _ if extension.oid.to_id_string() == CERTIFICATE_ISSUER => {
                    self.scope.indirect = true;
                }
                _ if extension.critical => {
                    self.unusable(CrlUnusable::CriticalEntryExtension(quoted(&extension.oid.to_id_string())));
                }
                _ => {}
            }
        }
        let serial = significant(entry.raw_serial());
        let at = range_within(der, serial).ok_or(damaged.clone())?;
        self.entries.push(RevokedEntry {
            // A list is shorter than 4 GiB.
            start: u32::try_from(at.start).map_err(|_| damaged.clone())?,
            length: u32::try_from(at.len()).map_err(|_| damaged.clone())?,
            date: date(entry.revocation_date).ok_or(damaged)?.timestamp(),
            reason,
        });
        Ok(())
    }

    fn unusable(&mut self, why: CrlUnusable) {
        self.unusable.get_or_insert(why);
    }
}

/// How many entries the table of entries has; `None` if the list, or the table, is not whole.
fn count_entries(der: &[u8]) -> Option<usize> {
    let (list, _) = tlv::first(der)?;
    let (signed, _) = tlv::first(list.content)?;
    let parts = tlv::all(signed.content)?;
    // Behind version, algorithm and issuer come one or two dates, and behind these the table, if there is one.
    let dates = parts.iter().position(|part| TIMES.contains(&part.tag))?;
    let behind = parts[dates..].iter().find(|part| !TIMES.contains(&part.tag));
    match behind {
        Some(table) if table.tag == tlv::SEQUENCE => tlv::all(table.content).map(|entries| entries.len()),
        _ => Some(0),
    }
}

/// Nothing of it makes sense as a revocation list; it may be something else.
pub(super) const UNREADABLE: &str = "it cannot be read";
const UTC_TIME: u8 = 0x17;
const GENERALIZED_TIME: u8 = 0x18;
const TIMES: [u8; 2] = [UTC_TIME, GENERALIZED_TIME];
/// RFC 5280 §5.2.3.
const MAX_NUMBER_BYTES: usize = 20;
const DELTA_CRL_INDICATOR: &str = "2.5.29.27";
const ISSUING_DISTRIBUTION_POINT: &str = "2.5.29.28";
const CERTIFICATE_ISSUER: &str = "2.5.29.29";

#[cfg(test)]
mod tests;
