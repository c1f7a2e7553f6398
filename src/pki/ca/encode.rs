use std::time::Duration;

use chrono::{DateTime, Datelike as _, Utc};
use sha1::{Digest as _, Sha1};
use x509_cert::attr::AttributeTypeAndValue;
use x509_cert::der::asn1::{Any, BitString, GeneralizedTime, OctetString, SetOfVec, UtcTime};
use x509_cert::der::oid::ObjectIdentifier;
use x509_cert::der::{Encode, Tag};
use x509_cert::ext::{AsExtension, Extension};
use x509_cert::name::{Name, RdnSequence, RelativeDistinguishedName};
use x509_cert::spki::{AlgorithmIdentifierOwned, SubjectPublicKeyInfoOwned};
use x509_cert::time::Time;

use crate::model::{Cause, Subject, with_cause};
use crate::pki::{PkiError, PrivateKey};

/// A subject as X.501 writes it; empty fields are left out. The country is a PrintableString, as RFC 5280 wants it.
pub(super) fn name(subject: &Subject) -> Result<Name, PkiError> {
    subject.check()?;
    let mut parts = Vec::new();
    for (oid, tag, text) in [
        (COUNTRY, Tag::PrintableString, &subject.country),
        (STATE, Tag::Utf8String, &subject.state),
        (LOCALITY, Tag::Utf8String, &subject.locality),
        (ORGANISATION, Tag::Utf8String, &subject.organisation),
        (COMMON_NAME, Tag::Utf8String, &subject.common_name),
    ] {
        if !text.is_empty() {
            let value = Any::new(tag, text.as_bytes()).map_err(signing)?;
            let part = SetOfVec::try_from(vec![AttributeTypeAndValue { oid, value }]).map_err(signing)?;
            parts.push(RelativeDistinguishedName::from(part));
        }
    }
    Ok(RdnSequence(parts))
}

/// UTCTime up to 2049, GeneralizedTime after that (RFC 5280 §4.1.2.5). Whole seconds from 1970 to 9999 only.
pub(super) fn time(at: DateTime<Utc>) -> Result<Time, PkiError> {
    let since_1970 = Duration::from_secs(u64::try_from(at.timestamp()).map_err(with_cause(PkiError::Dates))?);
    let time = if at.year() < 2050 {
        UtcTime::from_unix_duration(since_1970).map(Time::UtcTime)
    } else {
        GeneralizedTime::from_unix_duration(since_1970).map(Time::GeneralTime)
    };
    time.map_err(with_cause(PkiError::Dates))
}

/// SHA-1 of the public key, the first method of RFC 5280 §4.2.1.2: what OpenSSL computes as well.
pub(super) fn key_id(public_key: &SubjectPublicKeyInfoOwned) -> Result<OctetString, PkiError> {
    OctetString::new(Sha1::digest(public_key.subject_public_key.raw_bytes()).as_slice()).map_err(signing)
}

pub(super) fn public_key(key: &PrivateKey) -> Result<SubjectPublicKeyInfoOwned, PkiError> {
    let algorithm = AlgorithmIdentifierOwned { oid: RSA_ENCRYPTION, parameters: Some(Any::null()) };
    let subject_public_key = BitString::from_bytes(key.public_key()).map_err(signing)?;
    Ok(SubjectPublicKeyInfoOwned { algorithm, subject_public_key })
}

pub(super) fn extension(extension: &impl AsExtension) -> Result<Extension, PkiError> {
    // The subject only matters to extensions that replace an empty one, and no subject here is empty.
    extension.to_extension(&Name::default(), &[]).map_err(signing)
}

/// The algorithm every certificate and CRL here names.
pub(super) fn algorithm() -> AlgorithmIdentifierOwned {
    AlgorithmIdentifierOwned { oid: SHA256_WITH_RSA, parameters: Some(Any::null()) }
}

pub(super) fn sign(key: &PrivateKey, to_be_signed: &impl Encode) -> Result<BitString, PkiError> {
    let bytes = to_be_signed.to_der().map_err(signing)?;
    BitString::from_bytes(&key.sign_sha256(&bytes)?).map_err(signing)
}

/// What cannot be written in DER cannot be signed.
pub(super) fn signing(error: x509_cert::der::Error) -> PkiError {
    PkiError::Signing(Cause::new(error))
}

pub(super) const COMMON_NAME: ObjectIdentifier = ObjectIdentifier::new_unwrap("2.5.4.3");
const COUNTRY: ObjectIdentifier = ObjectIdentifier::new_unwrap("2.5.4.6");
const LOCALITY: ObjectIdentifier = ObjectIdentifier::new_unwrap("2.5.4.7");
const STATE: ObjectIdentifier = ObjectIdentifier::new_unwrap("2.5.4.8");
const ORGANISATION: ObjectIdentifier = ObjectIdentifier::new_unwrap("2.5.4.10");
const RSA_ENCRYPTION: ObjectIdentifier = ObjectIdentifier::new_unwrap("1.2.840.113549.1.1.1");
const SHA256_WITH_RSA: ObjectIdentifier = ObjectIdentifier::new_unwrap("1.2.840.113549.1.1.11");
