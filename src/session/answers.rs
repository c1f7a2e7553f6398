//! What a controller answers, checked where it enters: the one place between the network and the rest of the program.
//!
//! A peer with the right fingerprint can still be broken or hostile. Every answer passes [`Answer::check`] before it is
//! returned: lists and texts have an end, texts hold no character that a terminal or a text layout obeys
//! ([`foreign_text`]), times are ones that RFC 3339 can write. Failures pass
//! [`Problem::with_detail`](crate::model::Problem::with_detail), which does the same.

use chrono::{DateTime, Datelike as _, Utc};
use serde::de::DeserializeOwned;

use crate::model::{CertificateSummary, ControllerInfo, CrlSummary, ErrorCode, ServerSettings, UserName, foreign_text};
use crate::protocol::{
    Base64Bytes, Changed, CsrMade, HeldCertificates, Hello, Installed, ListedCertificate, ListedCrl, LogChunk,
    MAX_LOG_CHUNK_BYTES, RejectedClient, Revisioned, Session, SettingsExport, TrustChanged, TrustStamp,
};

/// A message that a controller sends.
pub(super) trait Answer: DeserializeOwned {
    /// Makes the texts fit to be shown; says what is wrong with an answer that no controller gives.
    fn check(&mut self) -> Result<(), &'static str>;
}

/// The most entries of a list that are taken. Controllers have room for 50 certificates and 256 rejected clients.
pub const MAX_LISTED: usize = 1024;
/// The longest text that is taken, in bytes. The longest names in certificates have 1 KiB.
const MAX_TEXT: usize = 4096;
/// Characters kept of a sentence or a name that is only shown.
const SHOWN_CHARS: usize = 500;

impl Answer for () {
    fn check(&mut self) -> Result<(), &'static str> {
        Ok(())
    }
}

impl Answer for Option<()> {
    fn check(&mut self) -> Result<(), &'static str> {
        Ok(())
    }
}

impl Answer for Hello {
    fn check(&mut self) -> Result<(), &'static str> {
        shown(&mut self.product);
        few(&self.versions)
    }
}

impl Answer for Session {
    fn check(&mut self) -> Result<(), &'static str> {
        let token = self.token.expose();
        if token.len() > MAX_TEXT || !token.bytes().all(|byte| byte.is_ascii_graphic()) {
            return Err("its session token fits into no header");
        }
        Ok(())
    }
}

impl<T> Answer for Revisioned<T>
where
    Self: DeserializeOwned,
    T: Answer,
{
    fn check(&mut self) -> Result<(), &'static str> {
        self.value.check()
    }
}

impl<T: Answer> Answer for Vec<T> {
    fn check(&mut self) -> Result<(), &'static str> {
        few(self)?;
        self.iter_mut().try_for_each(Answer::check)
    }
}

impl Answer for ControllerInfo {
    fn check(&mut self) -> Result<(), &'static str> {
        if !self.is_small() {
            return Err("its information is too large");
        }
        for text in [&mut self.name, &mut self.application_name, &mut self.endpoint] {
            shown(text);
        }
        if let Some(certificate) = &mut self.certificate {
            certificate.summary.check()?;
        }
        // What only the PC can find out is not the state of a controller.
        if self.error.is_some_and(|code| !code.is_a_controllers()) {
            self.error = Some(ErrorCode::ServerError);
        }
        let limits = [&mut self.limits.trusted, &mut self.limits.issuers, &mut self.limits.crls];
        limits.into_iter().for_each(|limit| *limit = (*limit).min(MAX_LISTED));
        time(self.clock)
    }
}

impl Answer for ServerSettings {
    fn check(&mut self) -> Result<(), &'static str> {
        Ok(())
    }
}

/// Letters and digits, as its type says.
impl Answer for UserName {
    fn check(&mut self) -> Result<(), &'static str> {
        Ok(())
    }
}

impl Answer for HeldCertificates {
    fn check(&mut self) -> Result<(), &'static str> {
        few(&self.held)
    }
}

impl Answer for CertificateSummary {
    fn check(&mut self) -> Result<(), &'static str> {
        for text in [&mut self.issued_to, &mut self.issued_by, &mut self.serial_number, &mut self.thumbprint] {
            known(text)?;
        }
        self.application_uri.as_mut().map_or(Ok(()), known)?;
        time(self.not_before)?;
        time(self.not_after)
    }
}

impl Answer for CrlSummary {
    fn check(&mut self) -> Result<(), &'static str> {
        known(&mut self.issuer)?;
        known(&mut self.id)?;
        self.number.as_mut().map_or(Ok(()), known)?;
        time(self.this_update)?;
        self.next_update.map_or(Ok(()), time)
    }
}

impl Answer for ListedCertificate {
    fn check(&mut self) -> Result<(), &'static str> {
        shown(&mut self.file_name);
        self.summary.check()?;
        time(self.added)
    }
}

impl Answer for RejectedClient {
    fn check(&mut self) -> Result<(), &'static str> {
        shown(&mut self.reason);
        shown(&mut self.address);
        few(&self.chain)?;
        self.summary.check()?;
        time(self.first_seen)?;
        time(self.last_seen)
    }
}

impl Answer for ListedCrl {
    fn check(&mut self) -> Result<(), &'static str> {
        shown(&mut self.file_name);
        // It becomes a part of a path.
        if !self.summary.id.bytes().all(|byte| byte.is_ascii_hexdigit()) {
            return Err("the name of a revocation list is no SHA-1");
        }
        self.summary.check()?;
        time(self.added)
    }
}

impl Answer for Base64Bytes {
    fn check(&mut self) -> Result<(), &'static str> {
        Ok(())
    }
}

impl Answer for TrustStamp {
    fn check(&mut self) -> Result<(), &'static str> {
        Ok(())
    }
}

impl Answer for Changed {
    fn check(&mut self) -> Result<(), &'static str> {
        Ok(())
    }
}

impl Answer for Installed {
    fn check(&mut self) -> Result<(), &'static str> {
        Ok(())
    }
}

impl Answer for CsrMade {
    fn check(&mut self) -> Result<(), &'static str> {
        Ok(())
    }
}

impl Answer for TrustChanged {
    fn check(&mut self) -> Result<(), &'static str> {
        few(&self.cut)?;
        for cut in &mut self.cut {
            [&mut cut.address, &mut cut.issued_to, &mut cut.thumbprint].into_iter().for_each(shown);
        }
        Ok(())
    }
}

impl Answer for LogChunk {
    /// The text stays as it is: it has lines, and `--json` writes it with escapes. What shows it as text uses
    /// [`foreign_text::lines`].
    fn check(&mut self) -> Result<(), &'static str> {
        // Bytes that are not UTF-8 arrive as characters of three bytes.
        if self.text.len() > 3 * MAX_LOG_CHUNK_BYTES {
            return Err("a piece of its log is too large");
        }
        if self.next < self.from {
            return Err("a piece of its log ends before it begins");
        }
        Ok(())
    }
}

impl Answer for SettingsExport {
    /// Nothing is changed: the checksum covers the texts.
    fn check(&mut self) -> Result<(), &'static str> {
        if self.format.len() > MAX_TEXT || self.checksum.len() > MAX_TEXT {
            return Err("its export is too large");
        }
        time(self.exported)
    }
}

/// A text for people: cut to a length that fits on a screen.
fn shown(text: &mut String) {
    *text = foreign_text::one_line(text, SHOWN_CHARS);
}

/// A text that things are recognised by: taken whole or not at all.
fn known(text: &mut String) -> Result<(), &'static str> {
    if text.len() > MAX_TEXT {
        return Err("a text in its answer is too long");
    }
    *text = foreign_text::one_line(text, usize::MAX);
    Ok(())
}

fn few<T>(list: &[T]) -> Result<(), &'static str> {
    if list.len() > MAX_LISTED { Err("a list in its answer is too long") } else { Ok(()) }
}

/// RFC 3339 writes years of four digits. Others overflow in another time zone.
fn time(at: DateTime<Utc>) -> Result<(), &'static str> {
    if (0..=9999).contains(&at.year()) { Ok(()) } else { Err("a time in its answer is in no calendar") }
}
