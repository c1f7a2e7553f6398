use std::io::IsTerminal as _;
use std::path::Path;

use secrecy::{ExposeSecret as _, SecretString};

use super::secret_file::read_secret;
use crate::model::{ErrorCode, Language, Problem};
use crate::texts::{TextKey, cli as texts};

/// The passphrase of the small CA: from a file, or asked for on the terminal, twice where it is chosen.
pub fn ca_passphrase(file: Option<&Path>, chosen: bool, language: Language) -> Result<SecretString, Problem> {
    passphrase(TextKey::CliAskCaPassphrase, file, chosen, language)
}

/// A passphrase from a file, or asked for on the terminal: twice where it is `chosen`.
///
/// Errors: those of [`read_secret`]; [`ErrorCode::NoPassphrase`] where there is no terminal, or the entries differ.
pub fn passphrase(
    question: TextKey,
    file: Option<&Path>,
    chosen: bool,
    language: Language,
) -> Result<SecretString, Problem> {
    if let Some(file) = file {
        return read_secret(file);
    }
    let ask = |question: TextKey| ask_secret(question.text(language))?.ok_or(Problem::new(ErrorCode::NoPassphrase));
    let passphrase = ask(question)?;
    if chosen && ask(TextKey::CliAskAgain)?.expose_secret() != passphrase.expose_secret() {
        return Err(Problem::with_detail(ErrorCode::NoPassphrase, texts::entries_differ(language)));
    }
    Ok(passphrase)
}

/// Asks on the terminal, without showing what is typed; `None` without one.
pub fn ask_secret(question: &str) -> Result<Option<SecretString>, Problem> {
    let terminal = console::Term::stderr();
    if !terminal.is_term() || !std::io::stdin().is_terminal() {
        return Ok(None);
    }
    eprint!("{question}: ");
    let typed = terminal.read_secure_line().map_err(|e| Problem::with_detail(ErrorCode::Internal, e))?;
    Ok(Some(SecretString::from(typed)))
}
