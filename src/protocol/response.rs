//! What a client does with a response before it believes it.
//!
//! A peer with the right fingerprint can still be broken or hostile. Every response passes [`Response::check`] before the
//! client returns it: lists and texts are bounded, texts hold no character that a terminal or a text layout obeys
//! ([`untrusted_text`]), and times are ones that RFC 3339 can write. The text of a failure passes
//! [`Problem::with_detail`](crate::model::Problem::with_detail), which does the same.

use chrono::{DateTime, Datelike as _, Utc};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::model::{Base64Bytes, CertificateSummary, untrusted_text};

/// A message that a controller sends.
pub trait Response: Serialize + DeserializeOwned + Send {
    /// Cuts and cleans the texts that are only shown. An error says in English what no controller sends.
    fn check(&mut self) -> Result<(), &'static str> {
        Ok(())
    }
}

/// The most entries of a list that a client takes. Controllers have room for 50 certificates and 256 rejected clients.
pub const MAX_LISTED: usize = 1024;
/// The longest text that a client takes, in bytes. The longest names in certificates have 1 KiB.
pub(super) const MAX_TEXT: usize = 4096;
/// The characters kept of a sentence or a name that is only shown.
const SHOWN_CHARS: usize = 500;

/// A response without content.
impl Response for () {}

/// Its size is bounded by [`MAX_RESPONSE_BYTES`](super::MAX_RESPONSE_BYTES).
impl Response for Base64Bytes {}

impl<T: Response> Response for Vec<T> {
    fn check(&mut self) -> Result<(), &'static str> {
        check_count(self)?;
        self.iter_mut().try_for_each(Response::check)
    }
}

impl Response for CertificateSummary {
    fn check(&mut self) -> Result<(), &'static str> {
        for text in [&mut self.issued_to, &mut self.issued_by, &mut self.serial_number, &mut self.thumbprint] {
            check_key(text)?;
        }
        self.application_uri.as_mut().map_or(Ok(()), check_key)?;
        check_time(self.not_before)?;
        check_time(self.not_after)
    }
}

/// A text for people: cut to a length that fits on a screen.
pub(super) fn shorten(text: &mut String) {
    *text = untrusted_text::one_line(text, SHOWN_CHARS);
}

/// A text that is compared with others, such as a name or a thumbprint: taken whole or not at all.
pub(super) fn check_key(text: &mut String) -> Result<(), &'static str> {
    if text.len() > MAX_TEXT {
        return Err("a text in its answer is too long");
    }
    *text = untrusted_text::one_line(text, usize::MAX);
    Ok(())
}

pub(super) fn check_count<T>(list: &[T]) -> Result<(), &'static str> {
    if list.len() > MAX_LISTED { Err("a list in its answer is too long") } else { Ok(()) }
}

/// RFC 3339 writes years of four digits. Others overflow in another time zone.
pub(super) fn check_time(at: DateTime<Utc>) -> Result<(), &'static str> {
    if (0..=9999).contains(&at.year()) { Ok(()) } else { Err("a time in its answer is in no calendar") }
}
