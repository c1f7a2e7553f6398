use std::net::SocketAddr;

use thiserror::Error;

use crate::model::Cause;

/// Why a server could not be started.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum StartError {
    /// Another process, or this one, uses the port.
    #[error("port {0} is in use")]
    PortInUse(u16),
    /// The server cannot run with the given parameters.
    #[error("the server cannot run with these settings: {0}")]
    InvalidParameter(#[from] InvalidParameter),
    /// The OPC UA crate did not start the server.
    #[error("the server could not be started: {0}")]
    Failed(#[source] Cause),
}

/// What a server cannot run with.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum InvalidParameter {
    /// The application name or URI is empty.
    #[error("the application name or URI is empty")]
    ApplicationName,
    /// The application URI is that of an information model, which would have two meanings for one namespace.
    #[error("the application URI is that of an information model")]
    ModelNamespace,
    /// No security policy is given.
    #[error("no security policy")]
    NoPolicy,
    /// No user token policy is given.
    #[error("no user token policy")]
    NoUserToken,
    /// The name of the user.
    #[error("the password of {0} is not an argon2id hash")]
    PasswordHash(String),
    /// The server certificate cannot be read.
    #[error("the server certificate is not an X.509 certificate")]
    Certificate(#[source] Cause),
    /// Bytes follow the server certificate.
    #[error("the server certificate is followed by other data")]
    DataAfterCertificate,
    /// The server's key cannot be read.
    #[error("the server's key is not an RSA key in PKCS#8")]
    Key(#[source] Cause),
    /// The server certificate has another public key than that of the server's key.
    #[error("the server certificate belongs to another key")]
    OtherKey,
    /// The OPC UA crate does not take the certificate or the key.
    #[error("the server certificate or its key cannot be used")]
    CertificateOrKey,
    /// The address cannot be listened on.
    #[error("cannot listen on {address}: {cause}")]
    Address {
        /// The address with the port.
        address: SocketAddr,
        /// The error of the operating system.
        #[source]
        cause: Cause,
    },
}
