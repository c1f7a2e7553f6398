use secrecy::SecretString;

use crate::model::UserCredential;

/// Who logs in.
#[derive(Debug, Clone)]
pub enum UserLogin {
    /// Without a user name.
    Anonymous,
    /// With user name and password.
    User {
        /// The user name.
        name: String,
        /// Its password; encrypted for the server's certificate where the endpoint asks for that.
        password: SecretString,
    },
}

impl UserLogin {
    /// With this user; anonymous without one.
    pub fn of(user: Option<&UserCredential>) -> Self {
        match user {
            None => Self::Anonymous,
            Some(UserCredential { name, password }) => {
                Self::User { name: name.as_str().to_owned(), password: password.secret().clone() }
            }
        }
    }
}
