use std::net::SocketAddr;

use thiserror::Error;

use crate::model::Cause;

/// Why a server could not be started.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum StartError {
    #[error("port {0} is in use")]
    PortInUse(u16),
    #[error("the server cannot run with these settings: {0}")]
    InvalidParameter(#[from] InvalidParameter),
    #[error("the server could not be started: {0}")]
    Failed(#[source] Cause),
}

/// What a server cannot run with.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum InvalidParameter {
    #[error("the application name or URI is empty")]
    ApplicationName,
    #[error("the application URI is that of an information model")]
    ModelNamespace,
    #[error("no security policy")]
    NoPolicy,
    #[error("no user token policy")]
    NoUserToken,
    /// The name of the user.
    #[error("the password of {0} is not an argon2id hash")]
    PasswordHash(String),
    #[error("the server certificate is not an X.509 certificate")]
    Certificate(#[source] Cause),
    #[error("the server certificate is followed by other data")]
    DataAfterCertificate,
    #[error("the server's key is not an RSA key in PKCS#8")]
    Key(#[source] Cause),
    #[error("the server certificate belongs to another key")]
    OtherKey,
    #[error("the server certificate or its key cannot be used")]
    CertificateOrKey,
    #[error("cannot listen on {address}: {cause}")]
    Address {
        address: SocketAddr,
        #[source]
        cause: Cause,
    },
}
