//! An HTTPS server that is not one of ours: it answers as a test says.

use std::sync::Arc;

use opcua_configurator::model::Address;
use opcua_configurator::pki::{TlsIdentity, tls_identity};
use rustls::pki_types::{CertificateDer, PrivateKeyDer, PrivatePkcs8KeyDer};
use tokio::io::{AsyncBufReadExt as _, AsyncReadExt as _, AsyncWriteExt as _, BufReader};
use tokio::net::TcpListener;

/// The server's end of TLS under a new identity.
pub fn tls(name: &str) -> (tokio_rustls::TlsAcceptor, TlsIdentity) {
    let identity = tls_identity(name, chrono::Utc::now()).unwrap();
    let key = PrivateKeyDer::Pkcs8(PrivatePkcs8KeyDer::from(identity.private_key_pkcs8.to_vec()));
    let config = rustls::ServerConfig::builder_with_provider(Arc::new(rustls::crypto::aws_lc_rs::default_provider()))
        .with_safe_default_protocol_versions()
        .unwrap()
        .with_no_client_auth()
        .with_single_cert(vec![CertificateDer::from(identity.certificate_der.clone())], key)
        .unwrap();
    (tokio_rustls::TlsAcceptor::from(Arc::new(config)), identity)
}

pub async fn listener() -> (TcpListener, Address) {
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let address = listener.local_addr().unwrap().to_string().parse().unwrap();
    (listener, address)
}

/// A server that answers each request by its first line, such as `GET /v1/info HTTP/1.1`: status line and body.
pub async fn serve(answer: impl Fn(&str) -> (String, String) + Send + Sync + 'static) -> (Address, TlsIdentity) {
    let (acceptor, identity) = tls("a liar");
    let (listener, address) = listener().await;
    let answer = Arc::new(answer);
    tokio::spawn(async move {
        while let Ok((stream, _)) = listener.accept().await {
            let (acceptor, answer) = (acceptor.clone(), answer.clone());
            tokio::spawn(async move {
                let mut stream = BufReader::new(acceptor.accept(stream).await?);
                loop {
                    let mut lines = Vec::new();
                    loop {
                        let mut line = String::new();
                        if stream.read_line(&mut line).await? == 0 {
                            return Ok::<_, std::io::Error>(());
                        }
                        if line == "\r\n" {
                            break;
                        }
                        lines.push(line);
                    }
                    let length = lines
                        .iter()
                        .find_map(|line| line.to_ascii_lowercase().strip_prefix("content-length:").map(str::to_owned));
                    let mut body = vec![0; length.map_or(0, |length| length.trim().parse().unwrap())];
                    stream.read_exact(&mut body).await?;
                    let (status, body) = answer(lines[0].trim());
                    let head = format!("HTTP/1.1 {status}\r\ncontent-length: {}\r\n\r\n", body.len());
                    stream.write_all([head, body].concat().as_bytes()).await?;
                    stream.flush().await?;
                }
            });
        }
    });
    (address, identity)
}
