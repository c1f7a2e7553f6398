//! The work of the small CA.

use crate::model::{Problem, clock};
use crate::ui::model::{AuthorityResult, AuthorityWork};
use crate::workspace::authority::{AuthorityError, AuthorityFiles};

impl AuthorityWork {
    /// Blocks for as long as it takes.
    pub(super) fn run(self, files: &AuthorityFiles) -> Result<AuthorityResult, Problem> {
        let now = clock::now();
        let mut saved = None;
        match self {
            Self::Look => {}
            Self::Create { new, passphrase } => drop(files.create(&new, &passphrase, now)?),
            Self::Restore { path, passphrase } => drop(files.restore(&path, &passphrase)?),
            Self::Unlock { passphrase } => drop(files.open(&passphrase)?),
            Self::Sign { csr, request, passphrase } => {
                saved = Some(files.open(&passphrase)?.sign(&csr, &request, false, now)?.1);
            }
            Self::Revoke { serial_numbers, reason, passphrase } => {
                files.open(&passphrase)?.revoke(&serial_numbers, reason, now)?;
            }
            Self::PublishCrl { passphrase } => files.open(&passphrase)?.publish_crl(None, now)?,
            Self::BackUp { path, passphrase } => {
                files.open(&passphrase)?.back_up(&path, now)?;
                saved = Some(path);
            }
        }
        let overview = match files.overview() {
            Ok(overview) => Some(Box::new(overview)),
            Err(AuthorityError::Missing(_)) => None,
            Err(error) => return Err(error.into()),
        };
        Ok(AuthorityResult { overview, saved })
    }
}
