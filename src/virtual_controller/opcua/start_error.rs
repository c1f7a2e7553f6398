/// Why a server could not be started.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum StartError {
    #[error("port {0} is in use")]
    PortInUse(u16),
    #[error("the server cannot run with these settings: {0}")]
    InvalidParameter(String),
    #[error("the server could not be started: {0}")]
    Failed(String),
}
