use std::collections::BTreeSet;

use crate::jobs;
use crate::model::{MAX_USERS, RevisionToken, UserCredential, UserName, UserPassword};
use crate::texts::TextKey;
use crate::ui::model::{RowId, SecretInput};

/// The users of one controller (manual 2.6.2).
#[derive(Debug)]
pub struct UsersForm {
    pub row: RowId,
    pub name: String,
    pub reading: bool,
    pub revision: Option<RevisionToken>,
    pub users: Vec<UserName>,
    pub ticked: BTreeSet<UserName>,
}

/// One more user, for one controller or many.
#[derive(Debug)]
pub struct AddUserForm {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    pub revision: Option<RevisionToken>,
    /// Users the one controller has already.
    pub existing: Vec<UserName>,
    pub name: String,
    pub password: SecretInput,
    pub show_password: bool,
}

impl AddUserForm {
    pub fn name_error(&self) -> Option<TextKey> {
        match self.name.parse::<UserName>() {
            Err(_) if self.name.is_empty() => None,
            Err(_) => Some(TextKey::UserRule),
            Ok(name) => self.existing.contains(&name).then_some(TextKey::UserExists),
        }
    }

    pub fn password_error(&self) -> Option<TextKey> {
        (!self.password.0.is_empty() && UserPassword::new(&self.password.0).is_err()).then_some(TextKey::UserRule)
    }

    pub fn operation(&self) -> Option<jobs::AddUser> {
        let name: UserName = self.name.parse().ok()?;
        let password = UserPassword::new(&self.password.0).ok()?;
        let fits = !self.existing.contains(&name) && self.existing.len() < MAX_USERS;
        fits.then_some(jobs::AddUser { credential: UserCredential { name, password }, based_on: self.revision })
    }
}
