use async_trait::async_trait;

use super::{Confirmation, JobStep, NoOutput, Operation, OperationRun, ServerEffect};
use crate::model::{ErrorCode, MAX_USERS, Problem, RevisionToken, Revisioned, UserCredential, UserName};

/// Lists the users of an OPC UA server; never their passwords (manual 2.6.2.1).
#[derive(Debug, Clone, Copy)]
pub struct ListUsers;

#[async_trait]
impl Operation for ListUsers {
    type Output = Revisioned<Vec<UserName>>;

    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<Revisioned<Vec<UserName>>, Problem> {
        run.begin(JobStep::Read)?;
        run.session.users().await
    }
}

/// Adds one user (manual 2.6.2.2).
#[derive(Debug, Clone)]
pub struct AddUser {
    /// Name and password of the new user.
    pub credential: UserCredential,
    /// The configuration that a dialog showed; `None` bases the change on the present one.
    pub based_on: Option<RevisionToken>,
}

#[async_trait]
impl Operation for AddUser {
    type Output = NoOutput;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation { server: ServerEffect::Restarts, ..Confirmation::default() })
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<NoOutput, Problem> {
        run.begin(JobStep::Read)?;
        let current = run.session.users().await?;
        if current.value.contains(&self.credential.name) {
            return Err(Problem::with_detail(ErrorCode::UserExists, &self.credential.name));
        }
        if current.value.len() >= MAX_USERS {
            return Err(ErrorCode::TooManyUsers.into());
        }
        run.begin(JobStep::Apply)?;
        run.session.add_user(self.based_on.unwrap_or(current.revision), self.credential.clone()).await?;
        Ok(NoOutput)
    }
}

/// Removes users (manual 2.6.2.3).
#[derive(Debug, Clone)]
pub struct RemoveUsers {
    /// The users to be removed.
    pub names: Vec<UserName>,
    /// The configuration that a dialog showed; `None` bases the change on the present one.
    pub based_on: Option<RevisionToken>,
}

#[async_trait]
impl Operation for RemoveUsers {
    type Output = NoOutput;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation { server: ServerEffect::Restarts, ..Confirmation::default() })
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<NoOutput, Problem> {
        run.begin(JobStep::Read)?;
        let current = run.session.users().await?;
        if let Some(missing) = self.names.iter().find(|name| !current.value.contains(name)) {
            return Err(Problem::with_detail(ErrorCode::UserNotFound, missing));
        }
        run.begin(JobStep::Apply)?;
        run.session.remove_users(self.based_on.unwrap_or(current.revision), self.names.clone()).await?;
        Ok(NoOutput)
    }
}
