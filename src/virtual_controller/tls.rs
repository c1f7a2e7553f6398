use std::sync::{Arc, LazyLock};

use rustls::ServerConfig;
use rustls::crypto::{CryptoProvider, aws_lc_rs};
use rustls::pki_types::{CertificateDer, PrivateKeyDer, PrivatePkcs8KeyDer};
use rustls::server::NoServerSessionStorage;

use super::state::KeyPair;
use crate::protocol::TlsTime;

static PROVIDER: LazyLock<Arc<CryptoProvider>> = LazyLock::new(|| Arc::new(aws_lc_rs::default_provider()));

/// TLS 1.2 and 1.3 with the controller's management identity.
///
/// Sessions are not resumed: the cache would be most of what a stopped controller costs, and a handshake with its
/// ECDSA key is cheap.
pub fn server_config(identity: &KeyPair) -> Result<Arc<ServerConfig>, rustls::Error> {
    let certificate = CertificateDer::from(identity.certificate.0.clone());
    let key = PrivateKeyDer::Pkcs8(PrivatePkcs8KeyDer::from(identity.private_key.0.to_vec()));
    let mut config = ServerConfig::builder_with_details(Arc::clone(&PROVIDER), Arc::new(TlsTime))
        .with_safe_default_protocol_versions()?
        .with_no_client_auth()
        .with_single_cert(vec![certificate], key)?;
    config.session_storage = Arc::new(NoServerSessionStorage {});
    config.send_tls13_tickets = 0;
    config.alpn_protocols = vec![b"http/1.1".to_vec()];
    Ok(Arc::new(config))
}
