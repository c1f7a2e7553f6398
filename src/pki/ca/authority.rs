use std::fmt;

use chrono::{DateTime, Utc};
use x509_cert::der::asn1::OctetString;
use x509_cert::der::{Decode as _, Encode as _};
use x509_cert::ext::Extension;
use x509_cert::ext::pkix::{AuthorityKeyIdentifier, BasicConstraints, KeyUsage, KeyUsages, SubjectKeyIdentifier};
use x509_cert::name::Name;
use x509_cert::serial_number::SerialNumber;
use x509_cert::spki::SubjectPublicKeyInfoOwned;
use x509_cert::time::Validity;
use x509_cert::{TbsCertificate, Version};

use super::encode;
use crate::model::{AuthorityRequest, KeyLength, with_cause};
use crate::pki::self_signed::{CLOCK_SKEW, random_serial_number};
use crate::pki::{Certificate, CertificateFlaw, PkiError, PrivateKey, validity_flaw};

/// A CA: its certificate, and the key that signs.
///
/// Everything it signs is signed with RSA PKCS#1 v1.5 and SHA-256, has a random serial number of 126 bits, and names
/// the key that signed it (authority key identifier).
pub struct CertificateAuthority {
    certificate: Certificate,
    pub(super) key: PrivateKey,
    pub(super) name: Name,
    pub(super) key_id: OctetString,
}

impl CertificateAuthority {
    /// Makes a root CA, signed with its own key.
    ///
    /// `path_length` is how many CAs may stand between it and an application's certificate: 0 if it signs these itself,
    /// 1 if an intermediate does. It is valid from one day before `now`, because clocks differ.
    pub fn root(
        request: &AuthorityRequest,
        path_length: u8,
        key: PrivateKey,
        now: DateTime<Utc>,
    ) -> Result<Self, PkiError> {
        check_key(request, &key)?;
        let name = encode::name(&request.subject)?;
        let public_key = encode::public_key(&key)?;
        let key_id = encode::key_id(&public_key)?;
        let dates = ValidityPeriod {
            not_before: now.checked_sub_signed(CLOCK_SKEW).ok_or_else(PkiError::beyond_calendar)?,
            not_after: now.checked_add_signed(request.validity.duration()).ok_or_else(PkiError::beyond_calendar)?,
        };
        let draft =
            UnsignedCertificate { subject: name.clone(), public_key, dates, extensions: ca_extensions(path_length)? };
        let certificate = draft.signed((&name, &key_id, &key))?;
        Ok(Self { certificate, key, name, key_id })
    }

    /// Makes a CA below this one, which signs application certificates only. Its validity ends with this one's at the
    /// latest.
    pub fn intermediate(
        &self,
        request: &AuthorityRequest,
        key: PrivateKey,
        now: DateTime<Utc>,
    ) -> Result<Self, PkiError> {
        check_key(request, &key)?;
        let name = encode::name(&request.subject)?;
        if name == self.name {
            return Err(PkiError::AuthorityName);
        }
        let public_key = encode::public_key(&key)?;
        let key_id = encode::key_id(&public_key)?;
        let dates = self.dates(request.validity.duration(), now)?;
        let draft = UnsignedCertificate { subject: name.clone(), public_key, dates, extensions: ca_extensions(0)? };
        let certificate = self.certify(draft)?;
        Ok(Self { certificate, key, name, key_id })
    }

    /// Takes up a CA again. Refuses what cannot sign: no CA, a key that is not its own, no key identifier.
    pub fn from_parts(certificate: Certificate, key: PrivateKey) -> Result<Self, PkiError> {
        if !key.matches(&certificate) {
            return Err(PkiError::NotAPair);
        }
        let parsed =
            x509_cert::Certificate::from_der(certificate.der()).map_err(with_cause(PkiError::NotACertificate))?;
        let tbs = parsed.tbs_certificate;
        let constraints = tbs.get::<BasicConstraints>().map_err(with_cause(PkiError::NotACertificate))?;
        if !constraints.is_some_and(|(_, constraints)| constraints.ca) {
            return Err(PkiError::CannotSign("the certificate is not that of a CA"));
        }
        let usage = tbs.get::<KeyUsage>().map_err(with_cause(PkiError::NotACertificate))?;
        if !usage.is_some_and(|(_, usage)| usage.key_cert_sign() && usage.crl_sign()) {
            return Err(PkiError::CannotSign("its key may not sign certificates and CRLs"));
        }
        let Some((_, SubjectKeyIdentifier(key_id))) =
            tbs.get::<SubjectKeyIdentifier>().map_err(with_cause(PkiError::NotACertificate))?
        else {
            return Err(PkiError::CannotSign("it has no subject key identifier"));
        };
        Ok(Self { certificate, key, name: tbs.subject, key_id })
    }

    /// The certificate of the CA.
    pub const fn certificate(&self) -> &Certificate {
        &self.certificate
    }

    /// The key that signs.
    pub const fn key(&self) -> &PrivateKey {
        &self.key
    }

    /// Whether it may sign now: neither expired, nor ahead of the clock.
    pub fn check_valid(&self, now: DateTime<Utc>) -> Result<(), PkiError> {
        match validity_flaw(&self.certificate, now) {
            None => Ok(()),
            Some(CertificateFlaw::NotYetValid { from, .. }) => Err(PkiError::AuthorityNotYetValid(from)),
            Some(_) => Err(PkiError::AuthorityExpired(self.certificate.not_after())),
        }
    }

    /// From a day ago until `now` plus `validity`, but never beyond this CA's own dates.
    pub(super) fn dates(&self, validity: chrono::Duration, now: DateTime<Utc>) -> Result<ValidityPeriod, PkiError> {
        self.check_valid(now)?;
        let not_before = now.checked_sub_signed(CLOCK_SKEW).ok_or_else(PkiError::beyond_calendar)?;
        let not_after = now.checked_add_signed(validity).ok_or_else(PkiError::beyond_calendar)?;
        Ok(ValidityPeriod {
            not_before: not_before.max(self.certificate.not_before()),
            not_after: not_after.min(self.certificate.not_after()),
        })
    }

    pub(super) fn certify(&self, draft: UnsignedCertificate) -> Result<Certificate, PkiError> {
        draft.signed((&self.name, &self.key_id, &self.key))
    }
}

impl fmt::Debug for CertificateAuthority {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "CertificateAuthority({:?})", self.certificate)
    }
}

/// When a certificate is valid, both ends included.
pub(super) struct ValidityPeriod {
    pub not_before: DateTime<Utc>,
    pub not_after: DateTime<Utc>,
}

/// A certificate that is still to be signed.
pub(super) struct UnsignedCertificate {
    pub subject: Name,
    pub public_key: SubjectPublicKeyInfoOwned,
    pub dates: ValidityPeriod,
    /// Without the key identifiers, which every certificate gets.
    pub extensions: Vec<Extension>,
}

impl UnsignedCertificate {
    fn signed(self, (issuer, issuer_id, key): (&Name, &OctetString, &PrivateKey)) -> Result<Certificate, PkiError> {
        let mut extensions = self.extensions;
        extensions.push(encode::extension(&SubjectKeyIdentifier(encode::key_id(&self.public_key)?))?);
        extensions.push(encode::extension(&authority_key_id(issuer_id))?);
        let tbs_certificate = TbsCertificate {
            version: Version::V3,
            serial_number: SerialNumber::new(&random_serial_number()?).map_err(encode::signing)?,
            signature: encode::algorithm(),
            issuer: issuer.clone(),
            validity: Validity {
                not_before: encode::time(self.dates.not_before)?,
                not_after: encode::time(self.dates.not_after)?,
            },
            subject: self.subject,
            subject_public_key_info: self.public_key,
            issuer_unique_id: None,
            subject_unique_id: None,
            extensions: Some(extensions),
        };
        let signature = encode::sign(key, &tbs_certificate)?;
        let certificate =
            x509_cert::Certificate { tbs_certificate, signature_algorithm: encode::algorithm(), signature };
        Certificate::from_der(&certificate.to_der().map_err(encode::signing)?)
    }
}

/// OpenSSL looks for issuers and CRLs by it.
pub(super) fn authority_key_id(issuer_id: &OctetString) -> AuthorityKeyIdentifier {
    AuthorityKeyIdentifier {
        key_identifier: Some(issuer_id.clone()),
        authority_cert_issuer: None,
        authority_cert_serial_number: None,
    }
}

fn ca_extensions(path_length: u8) -> Result<Vec<Extension>, PkiError> {
    Ok(vec![
        encode::extension(&BasicConstraints { ca: true, path_len_constraint: Some(path_length) })?,
        encode::extension(&KeyUsage(KeyUsages::KeyCertSign | KeyUsages::CRLSign))?,
    ])
}

fn check_key(request: &AuthorityRequest, key: &PrivateKey) -> Result<(), PkiError> {
    let (asked, got) = (request.key_length.bits(), key.bits());
    if request.key_length == KeyLength::Rsa1024 {
        return Err(PkiError::AuthorityKey(asked));
    }
    if asked != got {
        return Err(PkiError::OtherKeyLength { asked, got });
    }
    Ok(())
}
