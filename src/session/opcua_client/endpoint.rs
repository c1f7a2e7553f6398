use opcua::types::{EndpointDescription, MessageSecurityMode, UserTokenType};
use serde::Serialize;
use x509_parser::prelude::{FromDer as _, X509Certificate};

use super::failure::printable;
use super::server_location::ServerLocation;
use crate::model::{SecurityPolicy, UserTokenPolicy, with_cause};
use crate::pki::{Certificate, PkiError};

/// How messages are protected (OPC 10000-4 §7.20).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub enum MessageSecurity {
    /// Neither signed nor encrypted.
    None,
    /// Signed, and readable by others.
    Sign,
    /// Signed and encrypted.
    SignAndEncrypt,
}

impl MessageSecurity {
    /// The name in OPC 10000-4.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::None => "None",
            Self::Sign => "Sign",
            Self::SignAndEncrypt => "SignAndEncrypt",
        }
    }
}

/// A way of saying who one is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum TokenKind {
    /// No user name.
    Anonymous,
    /// A user name and a password.
    UserName,
    /// With a certificate of the user's own.
    Certificate,
    /// Issued by another service, such as a JSON Web Token.
    Issued,
}

impl From<UserTokenPolicy> for TokenKind {
    fn from(policy: UserTokenPolicy) -> Self {
        match policy {
            UserTokenPolicy::Anonymous => Self::Anonymous,
            UserTokenPolicy::UserName => Self::UserName,
        }
    }
}

impl TokenKind {
    /// The policy of the basic settings that stands for it.
    pub const fn policy(self) -> Option<UserTokenPolicy> {
        match self {
            Self::Anonymous => Some(UserTokenPolicy::Anonymous),
            Self::UserName => Some(UserTokenPolicy::UserName),
            Self::Certificate | Self::Issued => None,
        }
    }
}

/// A token one endpoint takes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OfferedToken {
    /// The kind of token.
    pub kind: TokenKind,
    /// Whether a password is encrypted on its way; `false` where the server asks for it in the clear.
    pub protected: bool,
}

/// One endpoint of a server, as far as it is understood.
#[derive(Debug, Clone)]
pub struct Endpoint {
    pub(super) description: EndpointDescription,
    /// The URL the server gives; clients that ask for endpoints follow it.
    pub url: String,
    /// What stands for the policy otherwise is not known here.
    pub policy: Result<SecurityPolicy, String>,
    /// `None`: not one of the specification's.
    pub mode: Option<MessageSecurity>,
    /// Each kind once, at most.
    pub tokens: Vec<OfferedToken>,
    /// The server's certificate, and what it sends after it.
    pub certificate: Vec<u8>,
    /// Application URI that the server reports.
    pub application_uri: String,
}

impl Endpoint {
    /// `None`: not over `opc.tcp` with the binary encoding, the only transport here.
    pub(super) fn new(description: EndpointDescription) -> Option<Self> {
        let url = printable(description.endpoint_url.as_ref());
        if !url.starts_with(SCHEME) {
            return None;
        }
        let uri = description.security_policy_uri.as_ref();
        let policy = policy(uri).ok_or_else(|| printable(uri));
        let mode = match description.security_mode {
            MessageSecurityMode::None => Some(MessageSecurity::None),
            MessageSecurityMode::Sign => Some(MessageSecurity::Sign),
            MessageSecurityMode::SignAndEncrypt => Some(MessageSecurity::SignAndEncrypt),
            _ => None,
        };
        let mut tokens: Vec<OfferedToken> = Vec::new();
        for token in description.user_identity_tokens.iter().flatten() {
            let kind = match token.token_type {
                UserTokenType::Anonymous => TokenKind::Anonymous,
                UserTokenType::UserName => TokenKind::UserName,
                UserTokenType::Certificate => TokenKind::Certificate,
                UserTokenType::IssuedToken => TokenKind::Issued,
            };
            let own = self::policy(token.security_policy_uri.as_ref());
            // OPC 10000-4 §7.41: without a policy of its own a token has that of the channel.
            let protected = match (token.security_policy_uri.is_empty(), own) {
                (true, _) => policy.as_ref().is_ok_and(|policy| *policy != SecurityPolicy::None),
                (false, Some(SecurityPolicy::None)) => mode == Some(MessageSecurity::SignAndEncrypt),
                (false, own) => own.is_some(),
            };
            // The library takes the first of a kind as well.
            if !tokens.iter().any(|offered| offered.kind == kind) {
                tokens.push(OfferedToken { kind, protected });
            }
        }
        tokens.sort_by_key(|token| token.kind);
        Some(Self {
            url,
            policy,
            mode,
            tokens,
            certificate: description.server_certificate.as_ref().to_vec(),
            application_uri: printable(description.server.application_uri.as_ref()),
            description,
        })
    }

    /// The host in its URL, without brackets; empty if there is none.
    pub fn host(&self) -> &str {
        self.parts().0
    }

    /// The server's certificate, and those it sends after it.
    pub fn certificates(&self) -> Result<(Certificate, Vec<Certificate>), PkiError> {
        let mut chain = Vec::new();
        let mut rest = &self.certificate[..];
        while !rest.is_empty() && chain.len() < MAX_CHAIN {
            let (after, _) = X509Certificate::from_der(rest).map_err(with_cause(PkiError::NotACertificate))?;
            chain.push(Certificate::from_der(&rest[..rest.len() - after.len()])?);
            rest = after;
        }
        if chain.is_empty() { Err(PkiError::Empty) } else { Ok((chain.remove(0), chain)) }
    }

    /// Host and port of its URL.
    pub fn target(&self) -> Option<ServerLocation> {
        let (host, port, _) = self.parts();
        let port = if port.is_empty() { Ok(DEFAULT_PORT) } else { port.parse() };
        (!host.is_empty()).then_some(())?;
        Some(ServerLocation { host: host.to_owned(), port: port.ok()? })
    }

    /// The description, to be reached where this computer reaches it.
    pub(super) fn at(&self, target: &ServerLocation) -> EndpointDescription {
        let mut description = self.description.clone();
        description.endpoint_url = format!("{}/{}", target.url(), self.parts().2).into();
        description
    }

    /// Host, port and path of the URL.
    fn parts(&self) -> (&str, &str, &str) {
        let rest = self.url.strip_prefix(SCHEME).unwrap_or_default();
        let (authority, path) = rest.split_once('/').unwrap_or((rest, ""));
        let (host, port) = match authority.strip_prefix('[').and_then(|v6| v6.split_once(']')) {
            Some((host, tail)) => (host, tail.strip_prefix(':').unwrap_or_default()),
            None => authority.rsplit_once(':').unwrap_or((authority, "")),
        };
        (host, port, path)
    }
}

fn policy(uri: &str) -> Option<SecurityPolicy> {
    let name = uri.strip_prefix("http://opcfoundation.org/UA/SecurityPolicy#")?;
    let named = match name {
        "Aes128_Sha256_RsaOaep" => SecurityPolicy::Aes128Sha256RsaOaep,
        "Aes256_Sha256_RsaPss" => SecurityPolicy::Aes256Sha256RsaPss,
        name => return SecurityPolicy::ALL.into_iter().find(|policy| policy.as_str() == name),
    };
    Some(named)
}

const SCHEME: &str = "opc.tcp://";
const DEFAULT_PORT: u16 = 4840;
/// Longer chains are refused.
const MAX_CHAIN: usize = 8;

#[cfg(test)]
mod tests {
    use super::*;
    use opcua::types::UserTokenPolicy as WireToken;

    fn described(url: &str, policy: &str, mode: MessageSecurityMode, password: Option<&str>) -> Option<Endpoint> {
        let token = WireToken {
            token_type: UserTokenType::UserName,
            security_policy_uri: password.map(uri).unwrap_or_default().as_str().into(),
            ..Default::default()
        };
        Endpoint::new(EndpointDescription {
            endpoint_url: url.into(),
            security_policy_uri: uri(policy).as_str().into(),
            security_mode: mode,
            user_identity_tokens: Some(vec![token.clone(), token]),
            ..Default::default()
        })
    }

    fn uri(policy: &str) -> String {
        format!("http://opcfoundation.org/UA/SecurityPolicy#{policy}")
    }

    #[test]
    fn every_policy_of_the_manual_is_known_by_its_uri() {
        use opcua::crypto::SecurityPolicy as Wire;
        for (wire, expected) in [
            (Wire::None, SecurityPolicy::None),
            (Wire::Basic128Rsa15, SecurityPolicy::Basic128Rsa15),
            (Wire::Basic256, SecurityPolicy::Basic256),
            (Wire::Basic256Sha256, SecurityPolicy::Basic256Sha256),
            (Wire::Aes128Sha256RsaOaep, SecurityPolicy::Aes128Sha256RsaOaep),
            (Wire::Aes256Sha256RsaPss, SecurityPolicy::Aes256Sha256RsaPss),
        ] {
            assert_eq!(policy(wire.to_uri()), Some(expected));
        }
        assert_eq!(policy(&uri("ECC_nistP256")), None);
    }

    #[test]
    fn a_url_is_taken_apart_and_led_to_where_the_server_is_reached() {
        let target = ServerLocation { host: "fe80::1".into(), port: 4841 };
        for (url, host, port, reached) in [
            ("opc.tcp://robot:4840/a/b", "robot", Some(4840), "opc.tcp://[fe80::1]:4841/a/b"),
            ("opc.tcp://10.0.0.1", "10.0.0.1", Some(4840), "opc.tcp://[fe80::1]:4841/"),
            ("opc.tcp://[::1]:70000/", "::1", None, "opc.tcp://[fe80::1]:4841/"),
            ("opc.tcp://", "", None, "opc.tcp://[fe80::1]:4841/"),
        ] {
            let endpoint = described(url, "None", MessageSecurityMode::None, None).unwrap();
            assert_eq!(endpoint.host(), host);
            assert_eq!(endpoint.target().map(|target| target.port), port, "{url}");
            assert_eq!(endpoint.at(&target).endpoint_url.as_ref(), reached);
        }
        assert!(described("https://robot/", "None", MessageSecurityMode::None, None).is_none());
    }

    #[test]
    fn a_password_in_the_clear_is_noticed() {
        use MessageSecurityMode as Mode;
        for (policy, mode, password, protected) in [
            ("None", Mode::None, None, false),
            ("None", Mode::None, Some("None"), false),
            ("None", Mode::None, Some("Basic256Sha256"), true),
            ("None", Mode::None, Some("Nonsense"), false),
            ("Basic256Sha256", Mode::Sign, None, true),
            ("Basic256Sha256", Mode::Sign, Some("None"), false),
            ("Basic256Sha256", Mode::SignAndEncrypt, Some("None"), true),
        ] {
            let endpoint = described("opc.tcp://robot", policy, mode, password).unwrap();
            assert_eq!(
                endpoint.tokens,
                [OfferedToken { kind: TokenKind::UserName, protected }],
                "{policy} {password:?}"
            );
        }
    }
}
