//! What stands in the columns of a list.

use std::borrow::Cow;

use egui::Color32;

use crate::pki::CrlHealth;
use crate::texts::{self, TextKey as T};
use crate::ui::features::client_certificates::{CrlDetails, TrustColumn, TrustListEntry, ValidityState};
use crate::ui::model::Model;
use crate::ui::theme::Palette;

/// At first; it can be changed.
pub const fn width(column: TrustColumn) -> f32 {
    use TrustColumn as C;
    match column {
        C::IssuedTo | C::IssuedBy => 140.0,
        C::Issuer => 220.0,
        C::FileName => 130.0,
        C::SerialNumber => 140.0,
        C::ValidFrom => 95.0,
        C::ValidUntil => 155.0,
        C::Thumbprint => 330.0,
        C::Reason | C::Health => 240.0,
        C::Address => 115.0,
        C::Count | C::Entries => 70.0,
        C::FirstSeen | C::LastSeen | C::ThisUpdate => 130.0,
        C::NextUpdate => 190.0,
        C::Number => 90.0,
    }
}

/// How a piece of text looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CellStyle {
    Plain,
    Number,
    /// A word that qualifies what stands beside it.
    Small,
}

/// A piece of text in a column.
#[derive(Debug)]
pub struct CellText<'a> {
    pub text: Cow<'a, str>,
    pub color: Color32,
    pub look: CellStyle,
    /// A dot before it.
    pub dot: bool,
}

/// What stands in one column of one line.
pub fn parts<'a>(
    column: TrustColumn,
    entry: &'a TrustListEntry,
    model: &Model,
    palette: &Palette,
) -> [Option<CellText<'a>>; 2] {
    use TrustColumn as C;
    let language = model.language;
    let part = |text: Cow<'a, str>, color, look| Some(CellText { text, color, look, dot: false });
    let plain = |text: &'a str| [part(text.into(), palette.text, CellStyle::Plain), None];
    let weak = |text: &'a str| [part(text.into(), palette.weak, CellStyle::Plain), None];
    let number = |text: &'a str| [part(text.into(), palette.weak, CellStyle::Number), None];
    let (refusal, crl) = (entry.refusal.as_ref(), entry.crl.as_ref());
    match column {
        C::IssuedTo | C::Issuer => {
            let name = part(entry.issued_to.as_str().into(), palette.text, CellStyle::Plain);
            match refusal {
                Some(refusal) if refusal.is_new => {
                    let text = T::TrustNew.text(language).into();
                    [Some(CellText { text, color: palette.warning, look: CellStyle::Small, dot: true }), name]
                }
                _ => [name, None],
            }
        }
        C::IssuedBy => plain(&entry.issued_by),
        C::FileName => plain(&entry.file_name),
        C::SerialNumber | C::Number => number(&entry.serial_number),
        C::Thumbprint => number(&entry.id),
        C::ValidFrom | C::ThisUpdate => {
            let color = if entry.life == ValidityState::NotYet { palette.error } else { palette.text };
            [part(entry.from.text.as_str().into(), color, CellStyle::Plain), None]
        }
        C::ValidUntil | C::NextUpdate => {
            let Some(until) = &entry.until else { return weak("—") };
            let words = match entry.life {
                ValidityState::Past => Some((T::Expired, palette.error)),
                ValidityState::Soon { .. } => Some((T::ExpiresSoon, palette.warning)),
                ValidityState::NotYet => Some((T::TrustNotYetValid, palette.error)),
                ValidityState::Good => None,
            };
            let color = words.map_or(palette.text, |(_, color)| color);
            let word = words.and_then(|(key, color)| part(key.text(language).into(), color, CellStyle::Small));
            [part(until.text.as_str().into(), color, CellStyle::Plain), word]
        }
        C::Reason => [refusal.and_then(|r| part(r.explain(language).into(), palette.error, CellStyle::Plain)), None],
        C::Address => refusal.map_or([None, None], |refusal| number(&refusal.address)),
        C::Count => [refusal.and_then(|r| part(r.count.to_string().into(), palette.text, CellStyle::Plain)), None],
        C::FirstSeen => refusal.map_or([None, None], |refusal| weak(&refusal.first_seen.text)),
        C::LastSeen => refusal.map_or([None, None], |refusal| weak(&refusal.last_seen.text)),
        C::Entries => [crl.and_then(|crl| part(crl.entries.to_string().into(), palette.text, CellStyle::Plain)), None],
        C::Health => {
            let health = crl.and_then(|crl| Some((crl, crl.health.as_ref()?)));
            let said = health.map(|(crl, health)| health_words(crl, health, model, palette));
            [said.and_then(|(said, color)| part(said.into(), color, CellStyle::Plain)), None]
        }
    }
}

/// What a CRL is good for.
pub fn health_words(crl: &CrlDetails, health: &CrlHealth, model: &Model, palette: &Palette) -> (String, Color32) {
    let words = texts::crl_health(health);
    let color = if health.is_usable() { palette.ok } else { palette.error };
    match &crl.covers {
        Some(authority) => (texts::covers(model.language, words, authority), color),
        None => (words.text(model.language).to_owned(), color),
    }
}
