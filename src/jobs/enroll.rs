use super::JobContext;
use crate::model::{Address, ConnectionKind, ControllerInfo, Credentials, ErrorCode, Problem};
use crate::pki::Fingerprint;

/// A controller that was met for the first time.
#[derive(Debug, Clone, PartialEq)]
pub struct Enrolled {
    /// The identity that was confirmed.
    pub fingerprint: Fingerprint,
    /// The first information, read after the login.
    pub info: ControllerInfo,
    /// The password works, but could only be kept until the program ends.
    pub password_not_kept: Option<Problem>,
}

/// The fingerprint of the controller that answers at an address, to be compared by a person.
pub async fn probe(
    connection: ConnectionKind,
    address: &Address,
    context: &JobContext,
) -> Result<Fingerprint, Problem> {
    context.connectors.get(connection)?.probe(address).await
}

/// Logs in to a controller whose fingerprint was accepted, reads its information and remembers the credentials.
pub async fn enroll(
    connection: ConnectionKind,
    address: &Address,
    fingerprint: Fingerprint,
    credentials: Credentials,
    context: &JobContext,
) -> Result<Enrolled, Problem> {
    let mut session = context.connectors.get(connection)?.connect(address, fingerprint, &credentials).await?;
    let info = session.info().await;
    session.close().await;
    let info = info?;
    info.series
        .check_firmware(info.firmware)
        .map_err(|error| Problem::with_detail(ErrorCode::FirmwareNotSupported, error))?;
    let passwords = context.passwords.clone();
    let password_not_kept =
        tokio::task::spawn_blocking(move || passwords.set(fingerprint, credentials).err().map(Problem::from))
            .await
            .map_err(|e| Problem::with_detail(crate::model::ErrorCode::Internal, e))?;
    Ok(Enrolled { fingerprint, info, password_not_kept })
}
