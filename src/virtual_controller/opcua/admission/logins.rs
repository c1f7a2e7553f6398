use std::net::SocketAddr;

use opcua::types::UserNameIdentityToken;

use super::connections::GateConnection;
use super::gate::Gate;
use crate::pki::Fingerprint;
use crate::virtual_controller::connection_limits::{LimitedConnection as _, SourceNetwork};

/// Who logs in with a password.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in super::super) struct PasswordLogin {
    /// As the client gave it.
    pub(in super::super) name: String,
    pub(in super::super) client: SocketAddr,
    pub(in super::super) source: SourceNetwork,
    /// Of the trusted certificate of its secure channel.
    pub(in super::super) certificate: Option<Fingerprint>,
}

/// What goes on to the server of a user's token. Its name gets the mark of the connection: the OPC UA crate hands over a
/// name and nothing else, so that the gate puts into it whose it is. `None` for a password in clear where the channel is
/// not secured either, which the server would check although it asked for an encrypted one.
pub(super) fn passed_on(token: &UserNameIdentityToken, is_secured: bool, mark: &str) -> Option<UserNameIdentityToken> {
    let is_clear = !is_secured && token.encryption_algorithm.is_empty();
    (!is_clear).then(|| {
        let user_name = format!("{}{SEPARATOR}{mark}", token.user_name.as_ref()).into();
        UserNameIdentityToken { user_name, ..token.clone() }
    })
}

impl Gate {
    /// Who gave this marked name. `None` if the mark is of no connection that is open.
    pub(in super::super) fn login(&self, marked: &str) -> Option<PasswordLogin> {
        let (name, mark) = marked.rsplit_once(SEPARATOR)?;
        let connection = self.connection_of_mark(mark)?;
        let state = connection.state.lock();
        let leaf = state.identity.as_ref().and_then(|identity| identity.leaf());
        Some(PasswordLogin {
            name: name.to_owned(),
            client: connection.peer,
            source: connection.source(),
            certificate: leaf.map(|leaf| Fingerprint::of(leaf.der())),
        })
    }
}

impl GateConnection {
    /// A random text that stands for the connection.
    pub(super) fn login_mark(&self) -> Result<String, getrandom::Error> {
        let mut state = self.state.lock();
        if let Some(mark) = &state.login_mark {
            return Ok(mark.clone());
        }
        let mut random = [0; 16];
        getrandom::fill(&mut random)?;
        Ok(state.login_mark.insert(hex::encode(random)).clone())
    }
}

const SEPARATOR: char = '\0';
