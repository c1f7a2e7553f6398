use std::fmt;
use std::str::FromStr;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD as BASE64;
use thiserror::Error;

/// The identifier of a node in one server (OPC 10000-3 §8.2).
///
/// Its text form is that of OPC 10000-6 §5.3.1.10: `ns=1;i=196865`; namespace 0 is left out.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId {
    /// Index into the server's namespace array. The same namespace may have another index after a restart.
    pub namespace: u16,
    /// The identifier within the namespace.
    pub identifier: Identifier,
}

/// The identifier of a node within its namespace (OPC 10000-3 §8.2.3).
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Identifier {
    /// `i=`
    Numeric(u32),
    /// `s=`, at most 4,096 characters.
    String(String),
    /// `g=`, in the order of its text form.
    Guid([u8; 16]),
    /// `b=`, at most 4,096 bytes.
    Opaque(Vec<u8>),
}

/// A name within a namespace, for example the BrowseName of a node (OPC 10000-3 §8.3).
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct QualifiedName {
    /// Index into the server's namespace array.
    pub namespace: u16,
    /// The name itself.
    pub name: String,
}

/// A text that is not a node id.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum NodeIdError {
    /// There is no `i=`, `s=`, `g=` or `b=`.
    #[error("no identifier i=, s=, g= or b=")]
    NoIdentifier,
    /// What follows `ns=` is not a number from 0 to 65,535.
    #[error("ns= is not followed by a number from 0 to 65535")]
    Namespace,
    /// What follows `i=` is not a number from 0 to 4,294,967,295.
    #[error("i= is not followed by a number from 0 to 4294967295")]
    Numeric,
    /// What follows `g=` is not a GUID.
    #[error("g= is not followed by a GUID")]
    Guid,
    /// What follows `b=` is not Base64.
    #[error("b= is not followed by Base64")]
    Opaque,
}

impl NodeId {
    /// A node id with a number.
    pub const fn numeric(namespace: u16, identifier: u32) -> Self {
        Self { namespace, identifier: Identifier::Numeric(identifier) }
    }

    /// The folder `Objects`, where the instances of a server begin (OPC 10000-5 §8.2.4).
    pub const OBJECTS_FOLDER: Self = Self::numeric(0, 85);
    /// The folder `Root` (OPC 10000-5 §8.2.1).
    pub const ROOT_FOLDER: Self = Self::numeric(0, 84);
}

impl fmt::Display for NodeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.namespace != 0 {
            write!(f, "ns={};", self.namespace)?;
        }
        match &self.identifier {
            Identifier::Numeric(number) => write!(f, "i={number}"),
            Identifier::String(text) => write!(f, "s={text}"),
            Identifier::Opaque(bytes) => write!(f, "b={}", BASE64.encode(bytes)),
            Identifier::Guid(guid) => {
                f.write_str("g=")?;
                for (at, byte) in guid.iter().enumerate() {
                    if GUID_HYPHENS.contains(&at) {
                        f.write_str("-")?;
                    }
                    write!(f, "{byte:02x}")?;
                }
                Ok(())
            }
        }
    }
}

impl FromStr for NodeId {
    type Err = NodeIdError;

    fn from_str(text: &str) -> Result<Self, NodeIdError> {
        let (namespace, rest) = match text.strip_prefix("ns=") {
            Some(rest) => {
                let (namespace, rest) = rest.split_once(';').ok_or(NodeIdError::NoIdentifier)?;
                (namespace.parse().map_err(|_not_a_number| NodeIdError::Namespace)?, rest)
            }
            None => (0, text),
        };
        let (kind, value) = rest.split_once('=').ok_or(NodeIdError::NoIdentifier)?;
        let identifier = match kind {
            "i" => Identifier::Numeric(value.parse().map_err(|_not_a_number| NodeIdError::Numeric)?),
            "s" => Identifier::String(value.to_owned()),
            "g" => Identifier::Guid(guid(value).ok_or(NodeIdError::Guid)?),
            "b" => Identifier::Opaque(BASE64.decode(value).map_err(|_not_base64| NodeIdError::Opaque)?),
            _ => return Err(NodeIdError::NoIdentifier),
        };
        Ok(Self { namespace, identifier })
    }
}

/// The bytes of `xxxxxxxx-xxxx-xxxx-xxxx-xxxxxxxxxxxx`.
fn guid(text: &str) -> Option<[u8; 16]> {
    let hyphens = [8, 13, 18, 23];
    let is_right = |(at, byte): (usize, u8)| match hyphens.contains(&at) {
        true => byte == b'-',
        false => byte.is_ascii_hexdigit(),
    };
    let right = text.len() == 36 && text.bytes().enumerate().all(is_right);
    let digits: String = right.then(|| text.chars().filter(|char| *char != '-').collect())?;
    hex::decode(digits).ok()?.try_into().ok()
}

impl QualifiedName {
    /// A name in a namespace.
    pub fn new(namespace: u16, name: impl Into<String>) -> Self {
        Self { namespace, name: name.into() }
    }
}

/// `1:Name`; namespace 0 is left out (OPC 10000-6 §5.3.1.14).
impl fmt::Display for QualifiedName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.namespace {
            0 => f.write_str(&self.name),
            namespace => write!(f, "{namespace}:{}", self.name),
        }
    }
}

/// The bytes of a GUID's text form that a hyphen precedes.
const GUID_HYPHENS: [usize; 4] = [4, 6, 8, 10];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_node_id_keeps_its_text() {
        for text in [
            "i=85",
            "ns=1;i=196865",
            "ns=65535;s=a;b=c d",
            "ns=2;g=00112233-4455-6677-8899-aabbccddeeff",
            "ns=3;b=AP8=",
            "s=",
        ] {
            assert_eq!(text.parse::<NodeId>().unwrap().to_string(), text);
        }
        assert_eq!("ns=0;i=1".parse::<NodeId>().unwrap(), NodeId::numeric(0, 1));
    }

    #[test]
    fn the_error_names_the_part_that_is_wrong() {
        for (text, error) in [
            ("", NodeIdError::NoIdentifier),
            ("85", NodeIdError::NoIdentifier),
            ("x=1", NodeIdError::NoIdentifier),
            ("ns=1", NodeIdError::NoIdentifier),
            ("ns=70000;i=1", NodeIdError::Namespace),
            ("i=-1", NodeIdError::Numeric),
            ("g=0011223-34455-6677-8899-aabbccddeeff", NodeIdError::Guid),
            ("b=%", NodeIdError::Opaque),
        ] {
            assert_eq!(text.parse::<NodeId>(), Err(error), "{text}");
        }
    }
}
