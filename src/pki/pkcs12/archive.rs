//! The inside of a PKCS#12: its keys and certificates, decrypted (RFC 7292 §4).

use std::borrow::Cow;

use zeroize::Zeroizing;

use super::super::password_encryption::{self as encryption, DecryptError, EncodedPassword};
use super::super::tlv::{self, CONTEXT_0, OCTET_STRING, SEQUENCE, Tlv};
use super::super::{PkiError, ber};
use super::mac::MacData;

/// Every key and every certificate of a PKCS#12, in the order of the file.
pub(super) struct Pkcs12Archive {
    /// In PKCS#8 without encryption, of any algorithm.
    pub keys: Vec<Zeroizing<Vec<u8>>>,
    pub certificates: Vec<Vec<u8>>,
}

impl Pkcs12Archive {
    /// Opens a PKCS#12 whose outside is in DER; what it wraps may be in BER. Hashes the password for each of its parts.
    pub fn open(der: &[u8], password: &str) -> Result<Self, PkiError> {
        let forms = EncodedPassword::forms(password);
        let parts = tlv::sole(der).and_then(|whole| tlv::all(whole.content)).ok_or(PkiError::Damaged)?;
        let (safe, mac) = match parts.as_slice() {
            [_version, safe] => (safe, None),
            [_version, safe, mac] => (safe, Some(MacData::read(mac).map_err(|error| of_mac(&error))?)),
            _ => return Err(PkiError::Damaged),
        };
        let content = match content_info(safe).ok_or(PkiError::Damaged)? {
            (DATA, content) => content_of_data(content).ok_or(PkiError::Damaged)?,
            _ => return Err(unsupported("it is protected by a key and not by a password")),
        };
        if let Some(mac) = &mac
            && !forms.iter().any(|form| mac.is_of(&content, form))
        {
            return Err(PkiError::WrongPasswordOrDamaged);
        }
        // With a right MAC, the password is right, and what fails later is damage.
        let otherwise = if mac.is_some() { PkiError::Damaged } else { PkiError::WrongPasswordOrDamaged };
        let mut reader =
            ArchiveReader { forms, otherwise, hashed: 0, archive: Self { keys: Vec::new(), certificates: Vec::new() } };
        reader.safes(&content)?;
        Ok(reader.archive)
    }
}

struct ArchiveReader<'a> {
    forms: Vec<EncodedPassword<'a>>,
    /// The error for what cannot be decrypted or understood.
    otherwise: PkiError,
    /// Things the password was hashed for.
    hashed: usize,
    archive: Pkcs12Archive,
}

impl ArchiveReader<'_> {
    /// An AuthenticatedSafe.
    fn safes(&mut self, bytes: &[u8]) -> Result<(), PkiError> {
        let der = self.in_der(bytes)?;
        for safe in self.all(self.sequence(&der)?)? {
            match content_info(&safe).ok_or_else(|| self.otherwise.clone())? {
                (DATA, content) => {
                    let bags = content_of_data(content).ok_or_else(|| self.otherwise.clone())?;
                    self.bags(&bags, MAX_DEPTH)?;
                }
                (ENCRYPTED_DATA, content) => {
                    let bags = self.encrypted_data(content)?;
                    self.bags(&bags, MAX_DEPTH)?;
                }
                (ENVELOPED_DATA, _) => return Err(unsupported("it is encrypted for a key and not with a password")),
                _ => return Err(self.otherwise.clone()),
            }
        }
        Ok(())
    }

    /// The version, then what is encrypted: the type of its content, the algorithm, and the data under `[0]`, which is
    /// an octet string, in BER perhaps in pieces.
    fn encrypted_data(&mut self, content: &[u8]) -> Result<Zeroizing<Vec<u8>>, PkiError> {
        let damaged = || self.otherwise.clone();
        let data = tlv::sole(content).and_then(|whole| tlv::all(whole.content)).ok_or_else(damaged)?;
        let info = data.get(1).and_then(|info| tlv::elements(info.content)).ok_or_else(damaged)?;
        let [_, algorithm, data] = info.as_slice() else {
            return if info.len() == 2 { Ok(Zeroizing::new(EMPTY.to_vec())) } else { Err(damaged()) };
        };
        let data = tlv::sole(data).ok_or_else(damaged)?;
        let data = match data.tag {
            IMPLICIT_0 => Cow::Borrowed(data.content),
            CONTEXT_0 => Cow::Owned(ber::joined(OCTET_STRING, data.content).ok_or_else(damaged)?.to_vec()),
            _ => return Err(damaged()),
        };
        self.decrypt(algorithm, &data)
    }

    /// SafeContents: a list of bags, which may hold lists again.
    fn bags(&mut self, bytes: &[u8], depth: usize) -> Result<(), PkiError> {
        let depth = depth.checked_sub(1).ok_or_else(|| self.otherwise.clone())?;
        let der = self.in_der(bytes)?;
        for bag in self.all(self.sequence(&der)?)? {
            let parts = self.all(bag.content)?;
            let [kind, value, ..] = parts.as_slice() else { return Err(self.otherwise.clone()) };
            let Some((_, [kind])) = kind.content.split_at_checked(BAGS.len()).filter(|(start, _)| *start == BAGS)
            else {
                continue;
            };
            match *kind {
                KEY_BAG => self.archive.keys.push(Zeroizing::new(value.content.to_vec())),
                SHROUDED_KEY_BAG => {
                    let parts = tlv::sole(value.content).and_then(|whole| tlv::elements(whole.content));
                    let parts = parts.ok_or_else(|| self.otherwise.clone())?;
                    let [algorithm, data] = parts.as_slice() else { return Err(self.otherwise.clone()) };
                    let data = tlv::sole(data).ok_or_else(|| self.otherwise.clone())?;
                    let key = self.decrypt(algorithm, data.content)?;
                    self.archive.keys.push(key);
                }
                CERTIFICATE_BAG => {
                    let parts = self.all(self.sequence(value.content)?)?;
                    let [kind, value] = parts.as_slice() else { return Err(self.otherwise.clone()) };
                    if kind.content != X509_CERTIFICATE {
                        return Err(unsupported("it holds a certificate that is not X.509"));
                    }
                    let certificate = tlv::sole(value.content).ok_or_else(|| self.otherwise.clone())?;
                    self.archive.certificates.push(certificate.content.to_vec());
                }
                SAFE_CONTENTS_BAG => self.bags(value.content, depth)?,
                // Revocation lists and secrets.
                _ => {}
            }
        }
        Ok(())
    }

    fn decrypt(&mut self, algorithm: &[u8], data: &[u8]) -> Result<Zeroizing<Vec<u8>>, PkiError> {
        self.hashed += 1;
        if self.hashed > super::MAX_ENCRYPTED_PARTS {
            return Err(too_often());
        }
        let mut error = DecryptError::Failed;
        for form in &self.forms {
            match encryption::decrypt(algorithm, data, form) {
                // An old encryption may by chance seem to open with the other form of an empty password.
                Ok(plain) if self.forms.len() == 1 || tlv::sole(&plain).is_some() || ber::is_needed(&plain) => {
                    return Ok(plain);
                }
                Ok(_) => {}
                Err(found) => error = found,
            }
        }
        Err(match error {
            DecryptError::Unsupported(name) => unsupported(&format!("its encryption, {name}, is not known")),
            DecryptError::TooExpensive => too_often(),
            DecryptError::Failed => self.otherwise.clone(),
        })
    }

    fn in_der<'b>(&self, bytes: &'b [u8]) -> Result<Cow<'b, [u8]>, PkiError> {
        if !ber::is_needed(bytes) {
            return Ok(Cow::Borrowed(bytes));
        }
        match ber::first_as_der(bytes) {
            Some((der, [])) => Ok(Cow::Owned(der.to_vec())),
            _ => Err(self.otherwise.clone()),
        }
    }

    /// The content of the only element, a SEQUENCE.
    fn sequence<'b>(&self, der: &'b [u8]) -> Result<&'b [u8], PkiError> {
        let whole = tlv::sole(der).filter(|whole| whole.tag == SEQUENCE);
        whole.map(|whole| whole.content).ok_or_else(|| self.otherwise.clone())
    }

    fn all<'b>(&self, der: &'b [u8]) -> Result<Vec<Tlv<'b>>, PkiError> {
        tlv::all(der).ok_or_else(|| self.otherwise.clone())
    }
}

/// The type of a ContentInfo, as the last number of its identifier, and what is in it.
fn content_info<'a>(info: &Tlv<'a>) -> Option<(u8, &'a [u8])> {
    let parts = tlv::all(info.content)?;
    let [kind, content] = parts.as_slice() else { return None };
    let (_, [kind]) = kind.content.split_at_checked(PKCS7.len()).filter(|(start, _)| *start == PKCS7)? else {
        return None;
    };
    (content.tag == CONTEXT_0).then_some((*kind, content.content))
}

/// The octets of the type `data`.
fn content_of_data(content: &[u8]) -> Option<Zeroizing<Vec<u8>>> {
    tlv::sole(content).filter(|octets| octets.tag == OCTET_STRING).map(|octets| Zeroizing::new(octets.content.to_vec()))
}

fn of_mac(error: &DecryptError) -> PkiError {
    match error {
        DecryptError::Unsupported(name) => unsupported(&format!("its MAC, {name}, is not known")),
        DecryptError::TooExpensive => too_often(),
        DecryptError::Failed => PkiError::Damaged,
    }
}

fn unsupported(why: &str) -> PkiError {
    PkiError::UnsupportedPkcs12(why.to_owned())
}

fn too_often() -> PkiError {
    unsupported(super::TOO_OFTEN)
}

/// Of bags within bags.
const MAX_DEPTH: usize = 8;
const EMPTY: &[u8] = &[SEQUENCE, 0];
/// The implicit `[0]` of a string in one piece.
const IMPLICIT_0: u8 = 0x80;
/// 1.2.840.113549.1.7
const PKCS7: &[u8] = &[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 7];
const DATA: u8 = 1;
const ENVELOPED_DATA: u8 = 3;
const ENCRYPTED_DATA: u8 = 6;
/// 1.2.840.113549.1.12.10.1
const BAGS: &[u8] = &[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 12, 10, 1];
const KEY_BAG: u8 = 1;
const SHROUDED_KEY_BAG: u8 = 2;
const CERTIFICATE_BAG: u8 = 3;
const SAFE_CONTENTS_BAG: u8 = 6;
/// 1.2.840.113549.1.9.22.1
const X509_CERTIFICATE: &[u8] = &[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 9, 22, 1];
