//! The changes of client lists and CRLs (manual 2.7.3), as functions on a copy of the state.

use std::collections::HashMap;

use chrono::{DateTime, Utc};
use sha1::{Digest as _, Sha1};

use super::change_error::TrustError;
use super::rejected::RejectedEntry;
use super::state::{ControllerState, MAX_CRLS_BYTES, OperatingContext, TrustListCertificate, TrustListCrl};
use crate::model::{Base64Bytes, ClientList, FirmwareGeneration, TrustStep};
use crate::pki::{Certificate, Crl};
use crate::protocol::{MAX_SENT_CRL_BYTES, MAX_TRUST_STEPS};

/// The longest file name a list keeps.
const MAX_FILE_NAME_BYTES: usize = 255;

/// What a change means for the rejected list, which is no part of the state.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct RejectedListChanges {
    /// To be there before the change is in force, so that no certificate is in no list at all.
    pub arrived: Vec<RejectedEntry>,
    /// By thumbprint; to be gone after it.
    pub left: Vec<String>,
}

/// Makes all steps, one after the other. `rejected`: what the rejected list holds, in DER, by thumbprint.
pub fn edit_trust(
    state: &mut ControllerState,
    context: &OperatingContext,
    steps: Vec<TrustStep>,
    rejected: HashMap<String, Base64Bytes>,
) -> Result<RejectedListChanges, TrustError> {
    if !(1..=MAX_TRUST_STEPS).contains(&steps.len()) {
        return Err(TrustError::StepCount);
    }
    let mut editor = TrustListEditor { state, now: context.now, rejected, outcome: RejectedListChanges::default() };
    for step in steps {
        match step {
            TrustStep::Add { list, certificates } => editor.add(list, certificates)?,
            TrustStep::Remove { list, thumbprints } => editor.take(list, &thumbprints).map(drop)?,
            TrustStep::Move { from, to, thumbprints } => editor.relist(from, to, &thumbprints)?,
            TrustStep::AddCrls { crls } => editor.add_crls(crls)?,
            TrustStep::RemoveCrls { ids } => editor.remove_crls(&ids)?,
        }
    }
    Ok(editor.outcome)
}

struct TrustListEditor<'a> {
    state: &'a mut ControllerState,
    now: DateTime<Utc>,
    rejected: HashMap<String, Base64Bytes>,
    outcome: RejectedListChanges,
}

impl TrustListEditor<'_> {
    fn add(&mut self, list: ClientList, certificates: Vec<(String, Base64Bytes)>) -> Result<(), TrustError> {
        if certificates.is_empty() {
            return Err(TrustError::NoCertificate);
        }
        let added = self.now;
        let listed = certificates
            .into_iter()
            .map(|(file_name, certificate)| {
                check_file_name(&file_name)?;
                if let Err(source) = Certificate::from_der(&certificate.0) {
                    return Err(TrustError::Certificate { file_name, source });
                }
                Ok(TrustListCertificate { file_name, certificate, added })
            })
            .collect::<Result<_, TrustError>>()?;
        self.put(list, listed)
    }

    fn relist(&mut self, from: ClientList, to: ClientList, thumbprints: &[String]) -> Result<(), TrustError> {
        if from == to {
            return Err(TrustError::SameList);
        }
        let taken = self.take(from, thumbprints)?;
        if to != ClientList::Rejected {
            return self.put(to, taken);
        }
        for listed in taken {
            let thumbprint = thumbprint(&listed.certificate);
            self.outcome.left.retain(|left| *left != thumbprint);
            self.rejected.insert(thumbprint.clone(), listed.certificate.clone());
            self.outcome.arrived.push(RejectedEntry::moved(listed.certificate, thumbprint, self.now));
        }
        Ok(())
    }

    /// Puts certificates into the trusted or the issuers list; they leave the rejected one.
    fn put(&mut self, list: ClientList, new: Vec<TrustListCertificate>) -> Result<(), TrustError> {
        let limit = match list {
            ClientList::Trusted => self.state.limits().trusted,
            ClientList::Issuers => self.state.limits().issuers,
            ClientList::Rejected => return Err(TrustError::FilledByController),
        };
        let target = self.list(list)?;
        let total = target.len() + new.len();
        if total > limit {
            return Err(TrustError::ListFull { total, limit });
        }
        for listed in new {
            let target = self.list(list)?;
            if target.iter().any(|held| held.certificate == listed.certificate) {
                return Err(TrustError::Duplicate { file_name: listed.file_name });
            }
            let thumbprint = thumbprint(&listed.certificate);
            target.push(listed);
            self.forget(thumbprint);
        }
        Ok(())
    }

    /// Takes certificates out of a list: all of them, or none.
    fn take(&mut self, list: ClientList, thumbprints: &[String]) -> Result<Vec<TrustListCertificate>, TrustError> {
        if thumbprints.is_empty() {
            return Err(TrustError::NoCertificateNamed);
        }
        let missing = |thumbprint: &String| TrustError::NotInList(thumbprint.clone());
        let mut taken = Vec::new();
        if list == ClientList::Rejected {
            for thumbprint in thumbprints {
                let certificate = self.rejected.remove(thumbprint).ok_or_else(|| missing(thumbprint))?;
                let file_name = file_name_of(&certificate);
                self.forget(thumbprint.clone());
                taken.push(TrustListCertificate { file_name, certificate, added: self.now });
            }
            return Ok(taken);
        }
        let held = self.list(list)?;
        let prints: Vec<String> = held.iter().map(|listed| thumbprint(&listed.certificate)).collect();
        let mut held: Vec<Option<TrustListCertificate>> = std::mem::take(held).into_iter().map(Some).collect();
        for thumbprint in thumbprints {
            let index = prints.iter().position(|print| print == thumbprint);
            let listed = index.and_then(|index| held[index].take()).ok_or_else(|| missing(thumbprint))?;
            taken.push(listed);
        }
        *self.list(list)? = held.into_iter().flatten().collect();
        Ok(taken)
    }

    fn forget(&mut self, thumbprint: String) {
        self.rejected.remove(&thumbprint);
        self.outcome.arrived.retain(|entry| entry.thumbprint != thumbprint);
        if !self.outcome.left.contains(&thumbprint) {
            self.outcome.left.push(thumbprint);
        }
    }

    fn list(&mut self, list: ClientList) -> Result<&mut Vec<TrustListCertificate>, TrustError> {
        match list {
            ClientList::Issuers if self.state.generation() == FirmwareGeneration::Legacy => {
                Err(TrustError::FirmwareTooOld)
            }
            ClientList::Issuers => Ok(&mut self.state.issuers),
            ClientList::Trusted => Ok(&mut self.state.trusted),
            ClientList::Rejected => Err(TrustError::FilledByController),
        }
    }

    fn add_crls(&mut self, crls: Vec<(String, Base64Bytes)>) -> Result<(), TrustError> {
        if crls.is_empty() {
            return Err(TrustError::NoCrl);
        }
        for (file_name, der) in crls {
            check_file_name(&file_name)?;
            self.add_crl(file_name, der)?;
        }
        let bytes: usize = self.state.crls.iter().map(|held| held.crl.0.len()).sum();
        if bytes > MAX_CRLS_BYTES {
            return Err(TrustError::TooManyCrlBytes { bytes, most: MAX_CRLS_BYTES });
        }
        Ok(())
    }

    fn add_crl(&mut self, file_name: String, der: Base64Bytes) -> Result<(), TrustError> {
        if der.0.len() > MAX_SENT_CRL_BYTES {
            return Err(TrustError::CrlTooLarge { file_name });
        }
        let crl = match Crl::from_der(&der.0) {
            Ok(crl) => crl,
            Err(source) => return Err(TrustError::Crl { file_name, source }),
        };
        if let Some(because) = crl.unusable() {
            return Err(TrustError::CrlUnusable { file_name, because });
        }
        let mut kept = Vec::with_capacity(self.state.crls.len() + 1);
        for held in std::mem::take(&mut self.state.crls) {
            if held.crl == der {
                return Err(TrustError::DuplicateCrl { file_name });
            }
            let replaced = match Crl::from_der(&held.crl.0) {
                Ok(old) if crl.has_same_scope_as(&old) && !crl.is_newer_than(&old) => {
                    let (new, held) = (crl.number_and_date(), old.number_and_date());
                    return Err(TrustError::CrlOutdated { file_name, new, held });
                }
                Ok(old) => crl.has_same_scope_as(&old),
                Err(_) => false,
            };
            if !replaced {
                kept.push(held);
            }
        }
        let most = self.state.limits().crls;
        if kept.len() >= most {
            return Err(TrustError::TooManyCrls { most });
        }
        if !self.signature_fits(&crl) {
            return Err(TrustError::CrlSignature { file_name });
        }
        kept.push(TrustListCrl { file_name, summary: crl.summary(), crl: der, added: self.now });
        self.state.crls = kept;
        Ok(())
    }

    /// An authority that is held must have signed its CRL: a forged one would only take the right one's place.
    fn signature_fits(&self, crl: &Crl) -> bool {
        let held = self.state.trusted.iter().chain(&self.state.issuers);
        let mut authorities = held
            .filter_map(|listed| Certificate::from_der(&listed.certificate.0).ok())
            .filter(|certificate| crl.is_of(certificate))
            .peekable();
        authorities.peek().is_none() || authorities.any(|authority| crl.verify_signed_by(&authority))
    }

    fn remove_crls(&mut self, ids: &[String]) -> Result<(), TrustError> {
        if ids.is_empty() {
            return Err(TrustError::NoCrlNamed);
        }
        for id in ids {
            let index = self.state.crls.iter().position(|held| held.summary.id == *id);
            self.state.crls.remove(index.ok_or_else(|| TrustError::NotInList(id.clone()))?);
        }
        Ok(())
    }
}

fn thumbprint(certificate: &Base64Bytes) -> String {
    hex::encode_upper(Sha1::digest(&certificate.0))
}

/// A refused client sent no file: its common name stands for one.
fn file_name_of(certificate: &Base64Bytes) -> String {
    let name = Certificate::from_der(&certificate.0).ok().and_then(|certificate| certificate.common_name());
    let harmless = |c: char| if c.is_control() || "/\\:*?\"<>|".contains(c) { '_' } else { c };
    let name: String = name.unwrap_or_default().chars().map(harmless).take(60).collect();
    if name.is_empty() { "client.der".to_owned() } else { format!("{name}.der") }
}

/// The name is only for people to recognise a file by, so any script goes.
fn check_file_name(name: &str) -> Result<(), TrustError> {
    let fits = (1..=MAX_FILE_NAME_BYTES).contains(&name.len())
        && !name.chars().any(|c| c.is_control() || c == '/' || c == '\\');
    if fits { Ok(()) } else { Err(TrustError::FileName) }
}
