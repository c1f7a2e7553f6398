use std::path::PathBuf;

use clap::Args;
use secrecy::ExposeSecret as _;

use super::secret_file::read_secret;
use crate::model::{ErrorCode, Problem, UserCredential, UserPassword};

/// Who logs in to OPC UA servers.
#[derive(Debug, Args)]
pub struct UserLoginArgs {
    /// User that logs in where a user name is wanted; without one, only anonymous logins are made
    #[arg(long, value_name = "USER", requires = "user_password_file")]
    user: Option<String>,

    /// File with the user's password, "-" for standard input
    #[arg(long, value_name = "FILE", requires = "user")]
    user_password_file: Option<PathBuf>,
}

impl UserLoginArgs {
    /// The user with the password from its file; `None`: anonymous. Blocks while it reads.
    ///
    /// Errors: [`ErrorCode::BadCredential`], and those of a file that cannot be read.
    pub fn credential(&self) -> Result<Option<UserCredential>, Problem> {
        let (Some(user), Some(file)) = (&self.user, &self.user_password_file) else { return Ok(None) };
        let bad = |e| Problem::with_detail(ErrorCode::BadCredential, e);
        let name = user.parse().map_err(bad)?;
        let password = UserPassword::new(read_secret(file)?.expose_secret()).map_err(bad)?;
        Ok(Some(UserCredential { name, password }))
    }
}
