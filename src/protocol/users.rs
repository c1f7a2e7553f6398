//! The users of the OPC UA server (manual 2.6.2).

use serde::{Deserialize, Serialize};

use super::request::requests;
use super::{Response, WireSecret};
use crate::model::{Changed, RevisionToken, Revisioned, UserName};

requests! {
    /// Users of the OPC UA server.
    USER_REQUESTS
    GET "/v1/users" GetUsers { none } session -> Revisioned<Vec<UserName>>, "";
    POST "/v1/users" AddUser { json } revision -> Changed, "";
    POST "/v1/users/remove" RemoveUsers { json } revision -> Changed, "all of them or none";
}

/// Reads the names of the users. No request reads a password.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct GetUsers;

/// Letters and digits, as the type says.
impl Response for UserName {}

/// Adds a user (manual 2.6.2.2).
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AddUser {
    /// The configuration that the change is based on.
    pub revision: RevisionToken,
    /// Name of the new user.
    pub name: UserName,
    /// Password of the new user.
    pub password: WireSecret,
}

/// Removes users (manual 2.6.2.3).
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RemoveUsers {
    /// The configuration that the change is based on.
    pub revision: RevisionToken,
    /// The users to be removed.
    pub names: Vec<UserName>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_members_of_a_request_are_refused() {
        assert!(serde_json::from_str::<RemoveUsers>(r#"{"revision":1,"names":[],"force":true}"#).is_err());
    }
}
