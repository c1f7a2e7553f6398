//! The changes of client lists and CRLs (manual 2.7.3), as functions on a copy of the state.

use std::collections::HashMap;

use chrono::{DateTime, Utc};
use sha1::{Digest as _, Sha1};

use super::rejected::RejectedEntry;
use super::state::{ControllerState, MAX_CRLS_BYTES, OperatingContext, TrustListCertificate, TrustListCrl};
use crate::model::{Base64Bytes, ClientList, ErrorCode, FirmwareGeneration, Problem, TrustStep};
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
) -> Result<RejectedListChanges, Problem> {
    if !(1..=MAX_TRUST_STEPS).contains(&steps.len()) {
        return Err(Problem::with_detail(ErrorCode::Refused, format!("1 to {MAX_TRUST_STEPS} steps make a change")));
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
    fn add(&mut self, list: ClientList, certificates: Vec<(String, Base64Bytes)>) -> Result<(), Problem> {
        if certificates.is_empty() {
            return Err(Problem::with_detail(ErrorCode::BadCertificate, "no certificate was sent"));
        }
        let added = self.now;
        let listed = certificates
            .into_iter()
            .map(|(file_name, certificate)| {
                check_file_name(&file_name)?;
                Certificate::from_der(&certificate.0).map_err(|error| {
                    Problem::with_detail(ErrorCode::BadCertificate, format!("{file_name}: {error}"))
                })?;
                Ok(TrustListCertificate { file_name, certificate, added })
            })
            .collect::<Result<_, Problem>>()?;
        self.put(list, listed)
    }

    fn relist(&mut self, from: ClientList, to: ClientList, thumbprints: &[String]) -> Result<(), Problem> {
        if from == to {
            return Err(Problem::with_detail(ErrorCode::Refused, "a certificate is moved into another list"));
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
    fn put(&mut self, list: ClientList, new: Vec<TrustListCertificate>) -> Result<(), Problem> {
        let limit = match list {
            ClientList::Trusted => self.state.limits().trusted,
            ClientList::Issuers => self.state.limits().issuers,
            ClientList::Rejected => {
                return Err(Problem::with_detail(ErrorCode::Refused, "the controller fills this list"));
            }
        };
        let target = self.list(list)?;
        let total = target.len() + new.len();
        if total > limit {
            return Err(Problem::with_detail(ErrorCode::ListFull, format!("{total} > {limit}")));
        }
        for listed in new {
            let target = self.list(list)?;
            if target.iter().any(|held| held.certificate == listed.certificate) {
                return Err(Problem::with_detail(ErrorCode::DuplicateCertificate, listed.file_name));
            }
            let thumbprint = thumbprint(&listed.certificate);
            target.push(listed);
            self.forget(thumbprint);
        }
        Ok(())
    }

    /// Takes certificates out of a list: all of them, or none.
    fn take(&mut self, list: ClientList, thumbprints: &[String]) -> Result<Vec<TrustListCertificate>, Problem> {
        if thumbprints.is_empty() {
            return Err(Problem::with_detail(ErrorCode::NotInList, "no certificate was named"));
        }
        let missing = |thumbprint: &String| Problem::with_detail(ErrorCode::NotInList, thumbprint);
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

    fn list(&mut self, list: ClientList) -> Result<&mut Vec<TrustListCertificate>, Problem> {
        match list {
            ClientList::Issuers if self.state.generation() == FirmwareGeneration::Legacy => {
                Err(ErrorCode::FirmwareTooOld.into())
            }
            ClientList::Issuers => Ok(&mut self.state.issuers),
            ClientList::Trusted => Ok(&mut self.state.trusted),
            ClientList::Rejected => Err(Problem::with_detail(ErrorCode::Internal, "the rejected list is elsewhere")),
        }
    }

    fn add_crls(&mut self, crls: Vec<(String, Base64Bytes)>) -> Result<(), Problem> {
        if crls.is_empty() {
            return Err(Problem::with_detail(ErrorCode::BadCrl, "no CRL was sent"));
        }
        for (file_name, der) in crls {
            check_file_name(&file_name)?;
            self.add_crl(file_name, der)?;
        }
        let bytes: usize = self.state.crls.iter().map(|held| held.crl.0.len()).sum();
        if bytes > MAX_CRLS_BYTES {
            return Err(Problem::with_detail(ErrorCode::TooManyCrls, format!("{bytes} > {MAX_CRLS_BYTES} bytes")));
        }
        Ok(())
    }

    fn add_crl(&mut self, file_name: String, der: Base64Bytes) -> Result<(), Problem> {
        let bad =
            |reason: &dyn std::fmt::Display| Problem::with_detail(ErrorCode::BadCrl, format!("{file_name}: {reason}"));
        if der.0.len() > MAX_SENT_CRL_BYTES {
            return Err(bad(&format_args!("larger than {MAX_SENT_CRL_BYTES} bytes")));
        }
        let crl = Crl::from_der(&der.0).map_err(|error| bad(&error))?;
        if let Some(why) = crl.unusable() {
            return Err(bad(&why));
        }
        let mut kept = Vec::with_capacity(self.state.crls.len() + 1);
        for held in std::mem::take(&mut self.state.crls) {
            if held.crl == der {
                return Err(Problem::with_detail(ErrorCode::DuplicateCrl, file_name));
            }
            let replaced = match Crl::from_der(&held.crl.0) {
                Ok(old) if crl.has_same_scope_as(&old) && !crl.is_newer_than(&old) => {
                    let (new, old) = (crl.number_and_date(), old.number_and_date());
                    return Err(Problem::with_detail(ErrorCode::CrlOutdated, format!("{file_name}: {new} < {old}")));
                }
                Ok(old) => crl.has_same_scope_as(&old),
                Err(_) => false,
            };
            if !replaced {
                kept.push(held);
            }
        }
        if kept.len() >= self.state.limits().crls {
            let detail = format!("more than {}", self.state.limits().crls);
            return Err(Problem::with_detail(ErrorCode::TooManyCrls, detail));
        }
        self.check_signature(&crl).map_err(|reason| bad(&reason))?;
        kept.push(TrustListCrl { file_name, summary: crl.summary(), crl: der, added: self.now });
        self.state.crls = kept;
        Ok(())
    }

    /// An authority that is held must have signed its CRL: a forged one would only take the right one's place.
    fn check_signature(&self, crl: &Crl) -> Result<(), &'static str> {
        let held = self.state.trusted.iter().chain(&self.state.issuers);
        let mut authorities = held
            .filter_map(|listed| Certificate::from_der(&listed.certificate.0).ok())
            .filter(|certificate| crl.is_of(certificate))
            .peekable();
        if authorities.peek().is_none() || authorities.any(|authority| crl.verify_signed_by(&authority)) {
            Ok(())
        } else {
            Err("it is not signed by the authority whose name it carries")
        }
    }

    fn remove_crls(&mut self, ids: &[String]) -> Result<(), Problem> {
        if ids.is_empty() {
            return Err(Problem::with_detail(ErrorCode::NotInList, "no CRL was named"));
        }
        for id in ids {
            let index = self.state.crls.iter().position(|held| held.summary.id == *id);
            self.state.crls.remove(index.ok_or_else(|| Problem::with_detail(ErrorCode::NotInList, id))?);
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
fn check_file_name(name: &str) -> Result<(), Problem> {
    let fits = (1..=MAX_FILE_NAME_BYTES).contains(&name.len())
        && !name.chars().any(|c| c.is_control() || c == '/' || c == '\\');
    if fits { Ok(()) } else { Err(Problem::with_detail(ErrorCode::BadName, "file name")) }
}
