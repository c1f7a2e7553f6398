use secrecy::SecretString;

use super::JobContext;
use crate::model::{Address, ControllerInfo, Problem};
use crate::pki::Fingerprint;

/// A controller that was met for the first time.
#[derive(Debug, Clone, PartialEq)]
pub struct Enrolled {
    pub fingerprint: Fingerprint,
    pub info: ControllerInfo,
    /// The password works, but could only be kept until the program ends.
    pub password_not_kept: Option<Problem>,
}

/// The fingerprint of whatever controller answers at an address, to be compared by a person.
pub async fn probe(address: &Address, context: &JobContext) -> Result<Fingerprint, Problem> {
    context.connector.probe(address).await
}

/// Logs in to a controller whose fingerprint was accepted, reads its information and remembers the password.
pub async fn enroll(
    address: &Address,
    fingerprint: Fingerprint,
    password: SecretString,
    context: &JobContext,
) -> Result<Enrolled, Problem> {
    let mut session = context.connector.connect(address, fingerprint, &password).await?;
    let info = session.info().await;
    session.close().await;
    let info = info?;
    info.series.check_firmware(info.firmware)?;
    let passwords = context.passwords.clone();
    let password_not_kept =
        tokio::task::spawn_blocking(move || passwords.set(fingerprint, password).err().map(Problem::from))
            .await
            .map_err(|e| Problem::with_detail(crate::model::ErrorCode::Internal, e))?;
    Ok(Enrolled { fingerprint, info, password_not_kept })
}
