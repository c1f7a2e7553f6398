//! Which certificates a revocation list is about: its issuing distribution point, and the distribution points of
//! certificates (RFC 5280 §5.2.5, §4.2.1.13).

use std::collections::BTreeSet;

use x509_parser::prelude::{FromDer, GeneralName, X509Name};

use super::name::quoted;
use super::tlv::{self, SEQUENCE};
use super::{CrlUnusable, OutOfScope, RevocationReason, name};

/// A set of reasons for a revocation, those of ReasonFlags.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct RevocationReasons(u16);

impl RevocationReasons {
    pub const NONE: Self = Self(0);
    /// keyCompromise (1) to aACompromise (8).
    pub const ALL: Self = Self(0x1fe);

    /// From the content of a BIT STRING.
    fn read(content: &[u8]) -> Option<Self> {
        let (&unused, bytes) = content.split_first()?;
        if unused > 7 || (bytes.is_empty() && unused > 0) {
            return None;
        }
        let is_set = |bit: &u16| bytes.get(usize::from(*bit / 8)).is_some_and(|byte| byte >> (7 - bit % 8) & 1 == 1);
        Some((1..=8).filter(is_set).fold(Self::NONE, |set, bit| Self(set.0 | 1 << bit)))
    }

    pub const fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    pub const fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// One without a bit of its own is only in the set of all.
    pub fn contains(self, reason: RevocationReason) -> bool {
        let bit = match reason {
            RevocationReason::Unspecified | RevocationReason::RemoveFromCrl => return self == Self::ALL,
            RevocationReason::KeyCompromise => 1,
            RevocationReason::CaCompromise => 2,
            RevocationReason::AffiliationChanged => 3,
            RevocationReason::Superseded => 4,
            RevocationReason::CessationOfOperation => 5,
            RevocationReason::CertificateHold => 6,
            RevocationReason::PrivilegeWithdrawn => 7,
            RevocationReason::AaCompromise => 8,
        };
        self.0 >> bit & 1 == 1
    }
}

/// A name of a distribution point, equal for names that are the same (RFC 5280 §7).
type PointName = Vec<u8>;

/// Where a certificate says that its revocation is published by its own issuer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct DistributionPoint {
    names: Vec<PointName>,
    reasons: RevocationReasons,
}

impl DistributionPoint {
    /// The points of an extension, those left out where another authority publishes the lists. `None` if the extension
    /// is damaged.
    pub fn read_all(extension: &[u8], issuer: &X509Name<'_>) -> Option<Vec<Self>> {
        let points = tlv::all(sequence(extension)?)?;
        let points: Vec<Option<Self>> =
            points.into_iter().map(|point| Self::read(point, issuer)).collect::<Option<_>>()?;
        Some(points.into_iter().flatten().collect())
    }

    fn read(point: tlv::Tlv<'_>, issuer: &X509Name<'_>) -> Option<Option<Self>> {
        if point.tag != SEQUENCE {
            return None;
        }
        let mut fields = Fields::of(point.content)?;
        let names = optional(fields.take(0xa0), |content| point_names(content, issuer))?;
        let reasons = optional(fields.take(0x81), RevocationReasons::read)?;
        let of_another = fields.take(0xa2).is_some();
        fields.end()?;
        let names = names.unwrap_or_default();
        Some((!of_another).then_some(Self { names, reasons: reasons.unwrap_or(RevocationReasons::ALL) }))
    }
}

/// The issuing distribution point of a list; the default is that of a list without one: everything its issuer issued.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct CrlScope {
    /// Only certificates with one of these distribution points, or with the first of them as their issuer.
    points: Option<BTreeSet<PointName>>,
    /// The same, for people.
    points_text: String,
    only_users: bool,
    only_authorities: bool,
    only_attributes: bool,
    reasons: RevocationReasons,
    pub indirect: bool,
}

impl Default for CrlScope {
    fn default() -> Self {
        Self {
            points: None,
            points_text: String::new(),
            only_users: false,
            only_authorities: false,
            only_attributes: false,
            reasons: RevocationReasons::ALL,
            indirect: false,
        }
    }
}

impl CrlScope {
    /// `issuer`: of the list. `None` if the extension is damaged.
    pub fn read(extension: &[u8], issuer: &X509Name<'_>) -> Option<Self> {
        let mut fields = Fields::of(sequence(extension)?)?;
        let point = fields.take(0xa0);
        let points = optional(point, |content| point_names(content, issuer))?;
        let scope = Self {
            points_text: point.and_then(first_name).map(|name| quoted(&name)).unwrap_or_default(),
            points: points.map(|names| names.into_iter().collect()),
            only_users: fields.take_boolean(0x81)?,
            only_authorities: fields.take_boolean(0x82)?,
            reasons: optional(fields.take(0x83), RevocationReasons::read)?.unwrap_or(RevocationReasons::ALL),
            indirect: fields.take_boolean(0x84)?,
            only_attributes: fields.take_boolean(0x85)?,
        };
        fields.end()?;
        Some(scope)
    }

    /// Why it can say of no certificate by itself that it is not revoked.
    pub fn unusable(&self) -> Option<CrlUnusable> {
        if self.indirect {
            Some(CrlUnusable::Indirect)
        } else if self.only_attributes {
            Some(CrlUnusable::OnlyAttributeCertificates)
        } else if self.only_users && self.only_authorities {
            Some(CrlUnusable::AboutNothing)
        } else if self.reasons != RevocationReasons::ALL {
            Some(CrlUnusable::OnlySomeReasons)
        } else {
            None
        }
    }

    /// Which reasons the list would name if a certificate were revoked for them (RFC 5280 §6.3.3 (b)(2), (d)).
    ///
    /// `is_ca`, `issuer` (folded) and `distribution_points` are those of the certificate.
    pub fn covers(
        &self,
        is_ca: bool,
        issuer: &[u8],
        distribution_points: &[DistributionPoint],
    ) -> Result<RevocationReasons, OutOfScope> {
        if self.only_users && is_ca {
            return Err(OutOfScope::OnlyApplications);
        }
        if self.only_authorities && !is_ca {
            return Err(OutOfScope::OnlyAuthorities);
        }
        if self.only_attributes {
            return Err(OutOfScope::OnlyAttributeCertificates);
        }
        let Some(points) = &self.points else { return Ok(self.reasons) };
        // A list that was not taken from a distribution point counts as that of a point with the name of the issuer.
        let by_issuer = points.contains(&directory_name(issuer));
        let at_points = distribution_points
            .iter()
            .filter(|point| point.names.iter().any(|name| points.contains(name)))
            .fold(RevocationReasons::NONE, |reasons, point| reasons.or(point.reasons));
        match if by_issuer { RevocationReasons::ALL } else { at_points } {
            RevocationReasons::NONE => Err(OutOfScope::OtherDistributionPoint(self.points_text.clone())),
            reasons => Ok(reasons.and(self.reasons)),
        }
    }

    pub fn is_only_about_authorities(&self) -> bool {
        self.only_authorities
    }

    /// What it leaves out, for people; `None` if it is about everything its issuer issued.
    pub fn limits(&self) -> Option<OutOfScope> {
        if self.only_users {
            Some(OutOfScope::OnlyApplications)
        } else if self.only_authorities {
            Some(OutOfScope::OnlyAuthorities)
        } else if self.only_attributes {
            Some(OutOfScope::OnlyAttributeCertificates)
        } else {
            self.points.is_some().then(|| OutOfScope::OtherDistributionPoint(self.points_text.clone()))
        }
    }
}

/// The optional fields of a SEQUENCE, each with a tag of its own, in their order.
struct Fields<'a>(std::iter::Peekable<std::vec::IntoIter<tlv::Tlv<'a>>>);

impl<'a> Fields<'a> {
    fn of(content: &'a [u8]) -> Option<Self> {
        Some(Self(tlv::all(content)?.into_iter().peekable()))
    }

    fn take(&mut self, tag: u8) -> Option<&'a [u8]> {
        self.0.next_if(|field| field.tag == tag).map(|field| field.content)
    }

    /// DEFAULT FALSE; `None` if it is no BOOLEAN.
    fn take_boolean(&mut self, tag: u8) -> Option<bool> {
        match self.take(tag) {
            None => Some(false),
            Some([value]) => Some(*value != 0),
            Some(_) => None,
        }
    }

    /// `None` if a field is left: it is not known, or not in its place.
    fn end(mut self) -> Option<()> {
        self.0.next().is_none().then_some(())
    }
}

/// Reads a field if it is there; the outer `None` says that it is damaged.
fn optional<T>(field: Option<&[u8]>, read: impl FnOnce(&[u8]) -> Option<T>) -> Option<Option<T>> {
    match field {
        None => Some(None),
        Some(content) => read(content).map(Some),
    }
}

fn sequence(der: &[u8]) -> Option<&[u8]> {
    match tlv::first(der)? {
        (whole, []) if whole.tag == SEQUENCE => Some(whole.content),
        _ => None,
    }
}

/// The names in a DistributionPointName: fullName, or one relative to the issuer.
fn point_names(content: &[u8], issuer: &X509Name<'_>) -> Option<Vec<PointName>> {
    let (point, rest) = tlv::first(content)?;
    match point.tag {
        _ if !rest.is_empty() => None,
        FULL_NAME => Some(tlv::all(point.content)?.into_iter().map(point_name).collect()),
        RELATIVE_NAME => {
            let (issuer, _) = tlv::first(issuer.as_raw())?;
            let last = tlv::write(SET, &[point.content]);
            folded(&tlv::write(SEQUENCE, &[issuer.content, &last])).map(|name| vec![directory_name(&name)])
        }
        _ => None,
    }
}

/// Of a name that cannot be read, its bytes.
fn point_name(general_name: tlv::Tlv<'_>) -> PointName {
    let read = match general_name.tag {
        DIRECTORY_NAME => folded(general_name.content),
        URI => std::str::from_utf8(general_name.content).ok().map(|uri| same_uri(uri).into_bytes()),
        _ => None,
    };
    [&[general_name.tag], read.as_deref().unwrap_or(general_name.content)].concat()
}

/// Scheme and host in lower case (RFC 5280 §7.4).
fn same_uri(uri: &str) -> String {
    let Some(at) = uri.find("://") else { return uri.to_owned() };
    let end = uri[at + 3..].find(['/', '?', '#']).map_or(uri.len(), |length| at + 3 + length);
    uri[..end].to_ascii_lowercase() + &uri[end..]
}

fn directory_name(folded: &[u8]) -> PointName {
    [&[DIRECTORY_NAME], folded].concat()
}

fn folded(der: &[u8]) -> Option<Vec<u8>> {
    match X509Name::from_der(der) {
        Ok(([], name)) => Some(name::folded(&name)),
        _ => None,
    }
}

/// The first name, for people.
fn first_name(content: &[u8]) -> Option<String> {
    let (point, _) = tlv::first(content)?;
    if point.tag != FULL_NAME {
        return None;
    }
    match GeneralName::from_der(point.content).ok()?.1 {
        GeneralName::URI(uri) => Some(name::printable(uri)),
        GeneralName::DirectoryName(directory) => Some(name::full(&directory)),
        other => Some(name::printable(&other.to_string())),
    }
}

const SET: u8 = 0x31;
const FULL_NAME: u8 = 0xa0;
const RELATIVE_NAME: u8 = 0xa1;
const DIRECTORY_NAME: u8 = 0xa4;
const URI: u8 = 0x86;

#[cfg(test)]
mod tests {
    use super::*;

    fn scope(fields: &[u8]) -> Option<CrlScope> {
        CrlScope::read(&tlv::write(SEQUENCE, &[fields]), &X509Name::new(Vec::new(), &[SEQUENCE, 0]))
    }

    #[test]
    fn a_scope_is_read_to_the_last_byte_or_not_at_all() {
        assert_eq!(scope(&[]), Some(CrlScope::default()), "about everything");
        let users = scope(&[0x81, 1, 0xff]).unwrap();
        assert_eq!((users.unusable(), users.limits()), (None, Some(OutOfScope::OnlyApplications)));
        assert_eq!(scope(&[0x81, 1, 0]), Some(CrlScope::default()), "the default, written down");
        for (fields, what) in [
            (&[0x82, 1, 0xff, 0x81, 1, 0xff][..], "not in their order"),
            (&[0x81, 1, 0xff, 0x81, 1, 0xff], "twice"),
            (&[0x81, 2, 0xff, 0xff], "two bytes"),
            (&[0x81, 0], "no byte"),
            (&[0x86, 1, 0xff], "a field that is not known"),
            (&[0x81, 1], "cut short"),
            (&[0x83, 2, 9, 0x60], "nine unused bits"),
            (&[0x83, 0], "no bits"),
            (&[0xa0, 2, 0xa2, 0], "a name of no kind"),
            (&[0xa0, 4, 0xa0, 0, 0xa0, 0], "two names"),
        ] {
            assert_eq!(scope(fields), None, "{what}");
        }
        assert_eq!(
            CrlScope::read(&[0x30, 0, 0], &X509Name::new(Vec::new(), &[SEQUENCE, 0])),
            None,
            "something after it"
        );
        assert_eq!(CrlScope::read(&[0x31, 0], &X509Name::new(Vec::new(), &[SEQUENCE, 0])), None, "a set");
    }

    #[test]
    fn what_counts_by_itself() {
        let unusable = |fields: &[u8]| scope(fields).unwrap().unusable().is_some();
        assert!(unusable(&[0x84, 1, 0xff]), "indirect");
        assert!(unusable(&[0x85, 1, 0xff]), "attribute certificates");
        assert!(unusable(&[0x83, 2, 5, 0x60]), "some reasons");
        assert!(!unusable(&[0x83, 3, 7, 0x7f, 0x80]), "all reasons");
        assert!(!unusable(&[0x82, 1, 0xff]));
        let every = RevocationReasons::read(&[7, 0xff, 0x80]).unwrap();
        assert_eq!(every, RevocationReasons::ALL, "the unused bit is not one of them");
        let some = RevocationReasons::read(&[5, 0x60]).unwrap();
        assert!(some.contains(RevocationReason::KeyCompromise) && some.contains(RevocationReason::CaCompromise));
        assert!(!some.contains(RevocationReason::Superseded) && !some.contains(RevocationReason::Unspecified));
    }

    #[test]
    fn of_a_uri_only_scheme_and_host_are_the_same_in_capitals() {
        assert_eq!(same_uri("HTTP://CA.Example/Plant.crl"), "http://ca.example/Plant.crl");
        assert_eq!(same_uri("LDAP://CA.Example?X"), "ldap://ca.example?X");
        assert_eq!(same_uri("urn:Plant"), "urn:Plant");
    }
}
