use std::time::Duration;

/// Where a server is reached.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ServerLocation {
    /// A name or an address, without brackets.
    pub host: String,
    /// TCP port.
    pub port: u16,
}

impl ServerLocation {
    /// `host:port`, as `getaddrinfo` and URLs want it.
    pub fn authority(&self) -> String {
        if self.host.contains(':') {
            format!("[{}]:{}", self.host, self.port)
        } else {
            format!("{}:{}", self.host, self.port)
        }
    }

    /// `opc.tcp://host:port`.
    pub fn url(&self) -> String {
        format!("opc.tcp://{}", self.authority())
    }
}

/// Whether a TCP port accepts connections, found out by connecting and closing at once.
pub async fn is_reachable(target: &ServerLocation, timeouts: Duration) -> bool {
    let connect = tokio::net::TcpStream::connect(target.authority());
    matches!(tokio::time::timeout(timeouts, connect).await, Ok(Ok(_)))
}
