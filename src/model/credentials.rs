use std::fmt;

use secrecy::SecretString;

/// What the program proves itself with to a controller. Each kind of connection accepts some kinds of credentials. The secret
/// is wiped when it is dropped, and `Debug` does not show it.
#[derive(Clone)]
pub enum Credentials {
    /// The connection password of the management protocol; may be empty.
    ConnectionPassword(SecretString),
}

impl Credentials {
    /// The password among the credentials. Files saved for the controller are protected with it (manual 2.8.1).
    pub const fn password(&self) -> &SecretString {
        match self {
            Self::ConnectionPassword(password) => password,
        }
    }
}

impl From<SecretString> for Credentials {
    fn from(password: SecretString) -> Self {
        Self::ConnectionPassword(password)
    }
}

impl From<&str> for Credentials {
    fn from(password: &str) -> Self {
        Self::ConnectionPassword(password.into())
    }
}

impl fmt::Debug for Credentials {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ConnectionPassword(_) => f.write_str("ConnectionPassword(…)"),
        }
    }
}
