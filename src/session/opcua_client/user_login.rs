use secrecy::SecretString;

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
