use std::fmt;
use std::net::{IpAddr, Ipv6Addr};
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The TCP port of the management protocol when an address names none.
pub const DEFAULT_MANAGEMENT_PORT: u16 = 7943;

/// Where a controller's management protocol answers: `host[:port]`.
///
/// The host is an IPv4 address, an IPv6 address in brackets, or a host name. Two addresses are the same when they lead
/// to the same place without a name lookup: neither case nor the spelling of an IPv6 address matters.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Address {
    host: String,
    port: u16,
}

/// Why a text is not an [`Address`]. Each variant but `Empty` quotes the part of the text that is wrong.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum AddressError {
    /// There is no text.
    #[error("the address is empty")]
    Empty,
    /// The host is neither an IP address nor a host name.
    #[error("\"{0}\" is not an IP address or a host name")]
    Host(String),
    /// The port is not a number from 1 to 65535.
    #[error("\"{0}\" is not a port between 1 and 65535")]
    Port(String),
    /// The address of an OPC UA server or of a web page names another port and protocol.
    #[error("leave out \"{0}://\", and give the address, and perhaps the port, of the management protocol")]
    Scheme(String),
    /// Something follows the port, as in a URL.
    #[error("leave out \"{0}\"")]
    Path(String),
    /// Some programs read them as octal numbers.
    #[error("\"{found}\" has leading zeros; write {meant}")]
    LeadingZeros {
        /// The number as it was written.
        found: String,
        /// The address without leading zeros, to be proposed.
        meant: String,
    },
    /// The IPv6 address has a zone (`%eth0`), which has a meaning on one computer only.
    #[error("the zone \"{0}\" is not supported; give an address that needs none")]
    Zone(String),
    /// The host name holds characters outside ASCII.
    #[error("\"{0}\" has characters that are not ASCII; use half-width digits, and the \"xn--\" form of a host name")]
    NotAscii(String),
}

impl Address {
    /// The host, without the square brackets of an IPv6 address; host names in lower case.
    pub fn host(&self) -> &str {
        &self.host
    }

    /// The TCP port; the default of the management protocol if the text named none.
    pub fn port(&self) -> u16 {
        self.port
    }

    /// The address when the host is a literal one.
    pub fn ip(&self) -> Option<IpAddr> {
        self.host.parse().ok()
    }

    /// What `getaddrinfo` and URLs want: brackets around IPv6.
    pub fn authority(&self) -> String {
        match self.ip() {
            Some(IpAddr::V6(ip)) => format!("[{ip}]:{}", self.port),
            _ => format!("{}:{}", self.host, self.port),
        }
    }

    /// Sort key: literal addresses in numeric order before names.
    pub fn sort_key(&self) -> (bool, Option<IpAddr>, &str, u16) {
        (self.ip().is_none(), self.ip(), &self.host, self.port)
    }
}

impl FromStr for Address {
    type Err = AddressError;

    fn from_str(text: &str) -> Result<Self, AddressError> {
        Self::with_default_port(text, DEFAULT_MANAGEMENT_PORT)
    }
}

impl Address {
    /// The address of another protocol than the management protocol, with that protocol's port if the text names none.
    ///
    /// Errors: as those of the text of an [`Address`].
    pub fn with_default_port(text: &str, default: u16) -> Result<Self, AddressError> {
        let text = text.trim();
        if text.is_empty() {
            return Err(AddressError::Empty);
        }
        if let Some(error) = other_form(text) {
            return Err(error);
        }
        let (host, port) = split_port(text)?;
        // The root of all names (RFC 1034 §3.1) makes no difference.
        let host = host.strip_suffix('.').filter(|host| !host.is_empty()).unwrap_or(host);
        let port = match port {
            None => default,
            Some(port) => port.parse().ok().filter(|p| *p != 0).ok_or_else(|| AddressError::Port(port.to_owned()))?,
        };
        match host.parse::<IpAddr>() {
            // An IPv6 address has many spellings; stored in one of them, it is found in a list under all.
            Ok(ip) => Ok(Self { host: ip.to_string(), port }),
            Err(_) if is_host_name(host) => Ok(Self { host: host.to_ascii_lowercase(), port }),
            Err(_) => Err(AddressError::Host(host.to_owned())),
        }
    }
}

/// What the text is, if it is an address in a form of something else.
fn other_form(text: &str) -> Option<AddressError> {
    if let Some((scheme, _)) = text.split_once("://") {
        return Some(AddressError::Scheme(scheme.to_owned()));
    }
    if let Some(at) = text.find('/') {
        return Some(AddressError::Path(text[at..].to_owned()));
    }
    if let Some((_, zone)) = text.split_once('%') {
        let end = zone.find(']').unwrap_or(zone.len());
        return Some(AddressError::Zone(format!("%{}", &zone[..end])));
    }
    if !text.is_ascii() {
        return Some(AddressError::NotAscii(text.to_owned()));
    }
    let host = text.split(':').next().unwrap_or_default();
    let numbers: Option<Vec<u8>> = host.split('.').map(|number| number.parse::<u8>().ok()).collect();
    let meant = <[u8; 4]>::try_from(numbers?).ok().map(|numbers| IpAddr::from(numbers).to_string())?;
    let has_zeros = host.split('.').any(|number| number.len() > 1 && number.starts_with('0'));
    has_zeros.then(|| AddressError::LeadingZeros { found: host.to_owned(), meant })
}

fn split_port(text: &str) -> Result<(&str, Option<&str>), AddressError> {
    let bad_host = || AddressError::Host(text.to_owned());
    if let Some(rest) = text.strip_prefix('[') {
        let (host, tail) = rest.split_once(']').ok_or_else(bad_host)?;
        host.parse::<Ipv6Addr>().map_err(|_| bad_host())?;
        return match tail.strip_prefix(':') {
            Some(port) => Ok((host, Some(port))),
            None if tail.is_empty() => Ok((host, None)),
            None => Err(bad_host()),
        };
    }
    if text.parse::<Ipv6Addr>().is_ok() {
        return Ok((text, None));
    }
    Ok(text.rsplit_once(':').map_or((text, None), |(host, port)| (host, Some(port))))
}

/// RFC 1123 names; a last label of digits only is a mistyped IPv4 address, not a name.
fn is_host_name(host: &str) -> bool {
    let label = |l: &str| {
        (1..=63).contains(&l.len())
            && l.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'-' || b == b'_')
            && !l.starts_with('-')
            && !l.ends_with('-')
    };
    host.len() <= 253
        && host.split('.').all(label)
        && !host.rsplit('.').next().is_some_and(|last| last.bytes().all(|b| b.is_ascii_digit()))
}

impl fmt::Display for Address {
    /// The default port is left out, as the engineer would write it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.port == DEFAULT_MANAGEMENT_PORT { f.write_str(&self.host) } else { f.write_str(&self.authority()) }
    }
}

text_in_messages!(Address, AddressError);

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str) -> String {
        text.parse::<Address>().expect(text).to_string()
    }

    #[test]
    fn hosts_ports_and_names_are_understood() {
        assert_eq!(shown(" 192.168.10.1 "), "192.168.10.1");
        assert_eq!(shown("192.168.10.1:7943"), "192.168.10.1");
        assert_eq!(shown("192.168.10.1:8000"), "192.168.10.1:8000");
        assert_eq!(shown("Robot-7.plant.local:8000"), "robot-7.plant.local:8000");
        assert_eq!(shown("robot.plant.local."), "robot.plant.local");
        assert_eq!(shown("[::1]:8000"), "[::1]:8000");
        assert_eq!("::1".parse::<Address>().expect("v6").authority(), "[::1]:7943");
    }

    #[test]
    fn every_spelling_is_the_same_address() {
        let address = "[fe80::1]:8000".parse::<Address>().expect("v6");
        for text in ["[FE80::1]:8000", "[fe80:0::1]:8000", "[fe80:0:0:0:0:0:0:0001]:8000", "[fe80::0.0.0.1]:8000"] {
            assert_eq!(text.parse(), Ok(address.clone()), "{text}");
        }
        assert_eq!("Robot.Plant".parse::<Address>(), "robot.plant".parse());
    }

    #[test]
    fn mistakes_are_named() {
        assert_eq!("".parse::<Address>(), Err(AddressError::Empty));
        assert_eq!("10.0.0.999".parse::<Address>(), Err(AddressError::Host("10.0.0.999".into())));
        assert_eq!("robot:0".parse::<Address>(), Err(AddressError::Port("0".into())));
        assert_eq!("robot:70000".parse::<Address>(), Err(AddressError::Port("70000".into())));
        assert_eq!("opc.tcp://robot:4840".parse::<Address>(), Err(AddressError::Scheme("opc.tcp".into())));
        assert_eq!("10.0.0.1/24".parse::<Address>(), Err(AddressError::Path("/24".into())));
        assert_eq!("[fe80::1%3]:7943".parse::<Address>(), Err(AddressError::Zone("%3".into())));
        let zeros = AddressError::LeadingZeros { found: "10.000.00.010".into(), meant: "10.0.0.10".into() };
        assert_eq!("10.000.00.010:7943".parse::<Address>(), Err(zeros));
        assert_eq!("１０.0.0.1".parse::<Address>(), Err(AddressError::NotAscii("１０.0.0.1".into())));
        assert!("ro bot".parse::<Address>().is_err());
        assert!("机器人".parse::<Address>().is_err());
    }

    #[test]
    fn addresses_sort_by_number() {
        let mut list: Vec<Address> =
            ["robot", "10.0.0.10", "10.0.0.9"].iter().map(|s| s.parse().expect("address")).collect();
        list.sort_by(|a, b| a.sort_key().cmp(&b.sort_key()));
        let shown: Vec<String> = list.iter().map(ToString::to_string).collect();
        assert_eq!(shown, ["10.0.0.9", "10.0.0.10", "robot"]);
    }
}
