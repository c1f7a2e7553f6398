use std::fmt;
use std::net::{IpAddr, Ipv6Addr};

/// What counts as one peer: an IPv4 address, or a /64 network of IPv6, since one host may own all of it.
///
/// An IPv4 address is the same in its IPv6-mapped form.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SourceNetwork(IpAddr);

impl SourceNetwork {
    pub fn new(address: IpAddr) -> Self {
        match address.to_canonical() {
            IpAddr::V6(v6) => Self(Ipv6Addr::from_bits(v6.to_bits() & (u128::MAX << 64)).into()),
            v4 => Self(v4),
        }
    }
}

impl fmt::Display for SourceNetwork {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            IpAddr::V4(v4) => v4.fmt(f),
            IpAddr::V6(v6) => write!(f, "{v6}/64"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(address: &str) -> SourceNetwork {
        SourceNetwork::new(address.parse().unwrap())
    }

    #[test]
    fn one_host_is_one_source_in_every_form_of_its_address() {
        assert_eq!(source("::ffff:192.168.0.1"), source("192.168.0.1"));
        assert_ne!(source("192.168.0.2"), source("192.168.0.1"));
        assert_eq!(source("2001:db8:0:1::1"), source("2001:db8:0:1:2:3:4:5"));
        assert_ne!(source("2001:db8:0:1::1"), source("2001:db8:0:2::1"));
        assert_eq!(source("2001:db8:0:1::1").to_string(), "2001:db8:0:1::/64");
        assert_eq!(source("::ffff:192.168.0.1").to_string(), "192.168.0.1");
    }
}
