//! The names in a certificate as they are compared, and what an authority says about them (RFC 5280 §4.2.1.10).

use std::net::{Ipv4Addr, Ipv6Addr};

use x509_parser::prelude::{FromDer as _, GeneralName as Parsed, X509Name};

use super::{name, tlv};

/// A name of the subject alternative name, or the base of a name constraint.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum GeneralName {
    Dns(String),
    Email(String),
    Uri(String),
    /// An address; in a constraint, the address and its mask.
    Ip(Vec<u8>),
    /// A distinguished name, see [`name::folded`]; its first parts are a prefix of it.
    Directory {
        folded: Vec<u8>,
        text: String,
    },
    /// One of a form that is not compared, by its tag number (RFC 5280 §4.2.1.6).
    Other(u32),
}

/// What an authority says about the names in the certificates below it.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct NameConstraints {
    pub permitted: Vec<Subtree>,
    pub excluded: Vec<Subtree>,
}

/// Everything from one name downwards.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Subtree {
    pub base: GeneralName,
    /// Whether it has the minimum 0 and no maximum, as RFC 5280 wants. Others are not supported.
    pub is_whole: bool,
}

/// Why a name is not allowed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NotAllowed {
    NotPermitted,
    /// Names of this form are constrained, and this one cannot be compared.
    CannotSay,
}

impl GeneralName {
    /// `None` if it is damaged.
    pub fn of(parsed: &Parsed<'_>) -> Option<Self> {
        Some(match parsed {
            Parsed::DNSName(dns) => Self::Dns((*dns).to_owned()),
            Parsed::RFC822Name(mail) => Self::Email((*mail).to_owned()),
            Parsed::URI(uri) => Self::Uri((*uri).to_owned()),
            Parsed::IPAddress(bytes) => Self::Ip(bytes.to_vec()),
            Parsed::DirectoryName(directory) => Self::directory(directory),
            Parsed::OtherName(..) => Self::Other(0),
            Parsed::X400Address(_) => Self::Other(3),
            Parsed::EDIPartyName(_) => Self::Other(5),
            Parsed::RegisteredID(_) => Self::Other(8),
            Parsed::Invalid(..) => return None,
        })
    }

    pub fn directory(name: &X509Name<'_>) -> Self {
        Self::Directory { folded: name::folded(name), text: name::full(name) }
    }

    /// As a person reads it. Not cut, and not without control characters.
    pub fn text(&self) -> String {
        match self {
            Self::Dns(text) => format!("DNS:{text}"),
            Self::Email(text) => format!("email:{text}"),
            Self::Uri(text) => format!("URI:{text}"),
            Self::Ip(bytes) => match (bytes.len(), bytes.split_at(bytes.len() / 2)) {
                (4 | 16, _) => format!("IP:{}", address(bytes)),
                (_, (base, mask)) => format!("IP:{}/{}", address(base), address(mask)),
            },
            Self::Directory { text, .. } => text.clone(),
            Self::Other(tag) => format!("[{tag}]"),
        }
    }

    /// The tag number of its form.
    const fn form(&self) -> u32 {
        match self {
            Self::Email(_) => 1,
            Self::Dns(_) => 2,
            Self::Directory { .. } => 4,
            Self::Uri(_) => 6,
            Self::Ip(_) => 7,
            Self::Other(tag) => *tag,
        }
    }
}

impl NameConstraints {
    /// From the content of the extension; `None` if it is damaged.
    pub fn parse(value: &[u8]) -> Option<Self> {
        let (whole, []) = tlv::first(value)? else { return None };
        if whole.tag != tlv::SEQUENCE {
            return None;
        }
        let mut constraints = Self::default();
        let parts = tlv::all(whole.content)?;
        match parts.iter().map(|part| part.tag).collect::<Vec<_>>()[..] {
            [PERMITTED] | [EXCLUDED] | [PERMITTED, EXCLUDED] => {}
            _ => return None,
        }
        for part in parts {
            let subtrees = tlv::all(part.content)?.into_iter().map(subtree).collect::<Option<Vec<_>>>()?;
            if subtrees.is_empty() {
                return None;
            }
            *(if part.tag == PERMITTED { &mut constraints.permitted } else { &mut constraints.excluded }) = subtrees;
        }
        Some(constraints)
    }

    /// Whether the authority may certify this name.
    pub fn allow(&self, name: &GeneralName) -> Result<(), NotAllowed> {
        let of_its_form = |subtrees: &'_ [Subtree]| -> Vec<Option<bool>> {
            let same_form = subtrees.iter().filter(|subtree| subtree.base.form() == name.form());
            same_form.map(|subtree| subtree.contains(name)).collect()
        };
        let (permitted, excluded) = (of_its_form(&self.permitted), of_its_form(&self.excluded));
        if excluded.contains(&Some(true)) {
            return Err(NotAllowed::NotPermitted);
        }
        if excluded.contains(&None) {
            return Err(NotAllowed::CannotSay);
        }
        if permitted.is_empty() || permitted.contains(&Some(true)) {
            Ok(())
        } else if permitted.contains(&None) {
            Err(NotAllowed::CannotSay)
        } else {
            Err(NotAllowed::NotPermitted)
        }
    }

    pub fn len(&self) -> usize {
        self.permitted.len() + self.excluded.len()
    }
}

fn subtree(element: tlv::Tlv<'_>) -> Option<Subtree> {
    let parts = tlv::all(element.content)?;
    let (base, distances) = parts.split_first()?;
    if element.tag != tlv::SEQUENCE || distances.iter().any(|distance| ![MINIMUM, MAXIMUM].contains(&distance.tag)) {
        return None;
    }
    let der = tlv::write(base.tag, &[base.content]);
    let (_, parsed) = Parsed::from_der(&der).ok()?;
    let base = GeneralName::of(&parsed)?;
    if matches!(&base, GeneralName::Ip(bytes) if ![8, 32].contains(&bytes.len())) {
        return None;
    }
    let is_whole = distances.iter().all(|distance| distance.tag == MINIMUM && distance.content == [0]);
    Some(Subtree { base, is_whole })
}

impl Subtree {
    /// Whether the name, which is of the same form, lies in it; `None` if that cannot be said.
    fn contains(&self, name: &GeneralName) -> Option<bool> {
        if !self.is_whole {
            return None;
        }
        match (&self.base, name) {
            (GeneralName::Dns(base), GeneralName::Dns(name)) => Some(dns_lies_in(name, base)),
            (GeneralName::Email(base), GeneralName::Email(name)) => email_lies_in(name, base),
            (GeneralName::Uri(base), GeneralName::Uri(name)) => {
                let host = host_of(name).filter(|host| is_host_name(host))?;
                Some(host_lies_in(host, base))
            }
            (GeneralName::Ip(base), GeneralName::Ip(name)) => Some(ip_lies_in(name, base)),
            (GeneralName::Directory { folded: base, .. }, GeneralName::Directory { folded: name, .. }) => {
                Some(name.starts_with(base))
            }
            _ => None,
        }
    }
}

fn address(bytes: &[u8]) -> String {
    match (<[u8; 4]>::try_from(bytes), <[u8; 16]>::try_from(bytes)) {
        (Ok(v4), _) => Ipv4Addr::from(v4).to_string(),
        (_, Ok(v6)) => Ipv6Addr::from(v6).to_string(),
        _ => hex::encode_upper(bytes),
    }
}

/// Any number of labels may stand before the base; at least one, if the base begins with a dot.
fn dns_lies_in(name: &str, base: &str) -> bool {
    let (name, base) = (lower(name), lower(base));
    match name.strip_suffix(base.as_str()) {
        Some("") => !base.starts_with('.'),
        Some(before) => base.is_empty() || base.starts_with('.') || before.ends_with('.'),
        None => false,
    }
}

/// A base that begins with a dot is a domain, with at least one label before it; any other is one host.
fn host_lies_in(host: &str, base: &str) -> bool {
    let (host, base) = (lower(host), lower(base));
    if base.starts_with('.') { host.len() > base.len() && host.ends_with(base.as_str()) } else { host == base }
}

/// A base with `@` is one mailbox, whose part before it is compared exactly.
fn email_lies_in(name: &str, base: &str) -> Option<bool> {
    let (local, host) = name.rsplit_once('@')?;
    Some(match base.rsplit_once('@') {
        Some((base_local, base_host)) => local == base_local && lower(host) == lower(base_host),
        None => host_lies_in(host, base),
    })
}

/// The base is an address followed by its mask, of the same length each.
fn ip_lies_in(name: &[u8], base: &[u8]) -> bool {
    let (address, mask) = base.split_at(base.len() / 2);
    name.len() == address.len()
        && name.iter().zip(address).zip(mask).all(|((name, base), mask)| name & mask == base & mask)
}

/// The host in the authority part of a URI (RFC 3986 §3.2.2). Most application URIs, `urn:…`, have none.
fn host_of(uri: &str) -> Option<&str> {
    let (_, rest) = uri.split_once("://")?;
    let authority = rest.split(['/', '?', '#']).next()?;
    let host = authority.rsplit_once('@').map_or(authority, |(_, host)| host);
    if host.starts_with('[') {
        return None;
    }
    let host = host.split_once(':').map_or(host, |(host, _)| host);
    (!host.is_empty()).then_some(host)
}

/// Not an address.
fn is_host_name(host: &str) -> bool {
    host.parse::<std::net::IpAddr>().is_err()
}

/// Without the dot that may stand at the end.
fn lower(text: &str) -> String {
    text.strip_suffix('.').unwrap_or(text).to_ascii_lowercase()
}

const PERMITTED: u8 = 0xa0;
const EXCLUDED: u8 = 0xa1;
const MINIMUM: u8 = 0x80;
const MAXIMUM: u8 = 0x81;

#[cfg(test)]
mod tests {
    use super::*;

    /// Tag and content of the base of a subtree.
    type SubtreeBase<'a> = (u8, &'a [u8]);

    fn der(parts: &[(u8, &[SubtreeBase<'_>])]) -> Vec<u8> {
        let lists: Vec<Vec<u8>> = parts
            .iter()
            .map(|(tag, bases)| {
                let subtrees: Vec<Vec<u8>> =
                    bases.iter().map(|(tag, base)| tlv::write(tlv::SEQUENCE, &[&tlv::write(*tag, &[base])])).collect();
                tlv::write(*tag, &subtrees.iter().map(Vec::as_slice).collect::<Vec<_>>())
            })
            .collect();
        tlv::write(tlv::SEQUENCE, &lists.iter().map(Vec::as_slice).collect::<Vec<_>>())
    }

    fn permits(tag: u8, base: &[u8], name: &GeneralName) -> Result<(), NotAllowed> {
        NameConstraints::parse(&der(&[(PERMITTED, &[(tag, base)])])).unwrap().allow(name)
    }

    const NO: Result<(), NotAllowed> = Err(NotAllowed::NotPermitted);
    const CANNOT_SAY: Result<(), NotAllowed> = Err(NotAllowed::CannotSay);

    #[test]
    fn names_lie_in_a_subtree_as_the_rfc_says() {
        for (base, name, expected) in [
            ("plant.example", "plant.example", Ok(())),
            ("plant.example", "robot.PLANT.example", Ok(())),
            ("plant.example", "robot.plant.example.", Ok(())),
            ("plant.example", "otherplant.example", NO),
            ("plant.example", "example", NO),
            (".plant.example", "robot.plant.example", Ok(())),
            (".plant.example", "plant.example", NO),
            ("", "anything", Ok(())),
        ] {
            assert_eq!(
                permits(0x82, base.as_bytes(), &GeneralName::Dns(name.into())),
                expected,
                "DNS {name} in {base}"
            );
        }
        for (base, name, expected) in [
            ("plant.example", "http://plant.example/a", Ok(())),
            ("plant.example", "opc.tcp://user@Plant.example:4840/a@b", Ok(())),
            ("plant.example", "http://robot.plant.example", NO),
            (".plant.example", "http://robot.plant.example", Ok(())),
            (".plant.example", "http://plant.example", NO),
            ("plant.example", "urn:plant:robot", CANNOT_SAY),
            ("plant.example", "http://192.168.10.1/", CANNOT_SAY),
            ("plant.example", "http://[fe80::1]/", CANNOT_SAY),
        ] {
            assert_eq!(
                permits(0x86, base.as_bytes(), &GeneralName::Uri(name.into())),
                expected,
                "URI {name} in {base}"
            );
        }
        for (base, name, expected) in [
            ("root@plant.example", "root@PLANT.example", Ok(())),
            ("root@plant.example", "Root@plant.example", NO),
            ("plant.example", "anybody@plant.example", Ok(())),
            ("plant.example", "anybody@hall.plant.example", NO),
            (".plant.example", "anybody@hall.plant.example", Ok(())),
            ("plant.example", "no mailbox", CANNOT_SAY),
        ] {
            assert_eq!(permits(0x81, base.as_bytes(), &GeneralName::Email(name.into())), expected, "{name} in {base}");
        }
        let lan = [192, 168, 10, 0, 255, 255, 255, 0];
        assert_eq!(permits(0x87, &lan, &GeneralName::Ip(vec![192, 168, 10, 77])), Ok(()));
        assert_eq!(permits(0x87, &lan, &GeneralName::Ip(vec![192, 168, 11, 77])), NO);
        assert_eq!(permits(0x87, &lan, &GeneralName::Ip(vec![0; 16])), NO);
        // Names of other forms are free.
        assert_eq!(permits(0x87, &lan, &GeneralName::Dns("anything".into())), Ok(()));
        assert_eq!(permits(0x88, &[42, 3], &GeneralName::Other(8)), CANNOT_SAY);
        assert_eq!(permits(0x88, &[42, 3], &GeneralName::Other(0)), Ok(()));
    }

    #[test]
    fn a_network_is_shown_with_its_mask() {
        let constraints = NameConstraints::parse(&der(&[(PERMITTED, &[(0x87, &[192, 168, 10, 0, 255, 255, 255, 0])])]));
        assert_eq!(constraints.unwrap().permitted[0].base.text(), "IP:192.168.10.0/255.255.255.0");
        assert_eq!(GeneralName::Ip(vec![192, 168, 10, 1]).text(), "IP:192.168.10.1");
        assert_eq!(GeneralName::Ip(vec![1, 2, 3]).text(), "IP:01/0203", "damaged, and shown all the same");
    }

    #[test]
    fn what_is_excluded_is_not_permitted_again() {
        let both: &[(u8, &[SubtreeBase<'_>])] =
            &[(PERMITTED, &[(0x82, b"plant.example")]), (EXCLUDED, &[(0x82, b"office.plant.example"), (0x86, b"x")])];
        let constraints = NameConstraints::parse(&der(both)).unwrap();
        let dns = |name: &str| constraints.allow(&GeneralName::Dns(name.into()));
        assert_eq!((dns("robot.plant.example"), dns("pc.office.plant.example"), dns("elsewhere")), (Ok(()), NO, NO));
        assert_eq!(constraints.allow(&GeneralName::Uri("urn:robot".into())), CANNOT_SAY);
    }

    #[test]
    fn distances_are_not_supported_and_damage_is_noticed() {
        let with_minimum = |number: u8| {
            let base = tlv::write(0x82, &[b"plant.example"]);
            let subtree = tlv::write(tlv::SEQUENCE, &[&base, &tlv::write(MINIMUM, &[&[number]])]);
            tlv::write(tlv::SEQUENCE, &[&tlv::write(PERMITTED, &[&subtree])])
        };
        let name = GeneralName::Dns("plant.example".into());
        assert_eq!(NameConstraints::parse(&with_minimum(0)).unwrap().allow(&name), Ok(()));
        assert_eq!(NameConstraints::parse(&with_minimum(1)).unwrap().allow(&name), CANNOT_SAY);
        for damaged in [
            der(&[]),
            der(&[(PERMITTED, &[])]),
            der(&[(EXCLUDED, &[(0x82, b"x")]), (PERMITTED, &[(0x82, b"x")])]),
            der(&[(PERMITTED, &[(0x87, &[192, 168, 10, 1])])]),
            der(&[(PERMITTED, &[(0x86, b"\xff")])]),
            vec![0x30, 2, 0xa0],
            [der(&[(PERMITTED, &[(0x82, b"x")])]), vec![0]].concat(),
        ] {
            assert_eq!(NameConstraints::parse(&damaged), None, "{damaged:02x?}");
        }
    }
}
