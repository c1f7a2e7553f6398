use chrono::{DateTime, Utc};
use thiserror::Error;

use super::{FileContent, Wanted};
use crate::model::text::TextError;
use crate::model::{Cause, ErrorCode, Problem, SubjectError, with_sources};

/// Everything that can be wrong with a key, a certificate, or the wish for one. Holds no secret.
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum PkiError {
    // a certificate file
    /// The file has no bytes.
    #[error("the file is empty")]
    Empty,
    /// The file is larger than is read.
    #[error("{bytes} bytes are too many; at most {max} are read")]
    TooLarge {
        /// Size of the file.
        bytes: usize,
        /// Greatest size that is read.
        max: usize,
    },
    /// The bytes are not an X.509 certificate.
    #[error("not an X.509 certificate, or a damaged one")]
    NotACertificate(#[source] Cause),
    /// Bytes follow the certificate, list or request; holds how many.
    #[error("{0} bytes follow the end")]
    TrailingBytes(usize),
    /// The signature algorithms inside and outside of the signed part differ (RFC 5280 §4.1.1.2).
    #[error("it names two different signature algorithms")]
    SignatureAlgorithms,
    /// An extension occurs twice (RFC 5280 §4.2).
    #[error("it has the same extension twice")]
    RepeatedExtension,
    /// A PEM block is not closed, or is not base64.
    #[error("the PEM text is damaged")]
    BadPem,
    /// A text file has an unknown encoding.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The file holds something else, which may be what was wanted in another form.
    #[error("it is {found}, not {wanted}{}", found.remedy(*wanted).map(|remedy| format!("; {remedy}")).unwrap_or_default())]
    OtherContent {
        /// What the file is.
        found: FileContent,
        /// What was expected.
        wanted: Wanted,
    },
    /// The file has no certificate.
    #[error("there is no certificate in it")]
    NoCertificate,
    /// The bytes are not a public key.
    #[error("not a public key, or a damaged one")]
    NotAPublicKey(#[source] Cause),
    /// The file has several certificates where one is expected; holds how many.
    #[error("there are {0} certificates in it; exactly one is expected")]
    SeveralCertificates(usize),
    /// A private key does not belong among certificates, which are handed around.
    #[error("there is a private key in it; a file with only the certificate is expected")]
    PrivateKeyInside,

    // a revocation list, and files of several things
    /// The bytes are not a usable CRL; holds why.
    #[error("not a certificate revocation list, or a damaged one: {0}")]
    NotACrl(#[source] Cause),
    /// The bytes are not a PKCS#7 with certificates; holds why.
    #[error("not a PKCS#7 with certificates, or a damaged one: {0}")]
    NotPkcs7(#[source] Cause),
    /// The file holds neither certificates nor CRLs.
    #[error("neither a certificate nor a revocation list nor a PKCS#7, or a damaged one")]
    NotTrustMaterial,
    /// The file holds more objects than are read; holds the limit.
    #[error("it holds more than {0} certificates and revocation lists, or encrypted keys")]
    TooMany(usize),
    /// More signatures would have to be checked than is done for one file.
    #[error("too many certificates in it have the same name to find out who signed what")]
    TooManySigners,

    // a certificate signing request
    /// The bytes are not a signing request for an RSA key.
    #[error("not a certificate signing request (PKCS#10) for an RSA key, or a damaged one")]
    NotACsr(#[source] Cause),
    /// The signature of the signing request does not fit its key.
    #[error("the signature of the certificate signing request is wrong")]
    CsrSignature,
    /// The file has several signing requests; holds how many.
    #[error("there are {0} certificate signing requests in it; exactly one is expected")]
    SeveralCsrs(usize),

    // the small CA
    /// The rest of the sentence, the signing request being its subject.
    #[error("the certificate signing request {0}")]
    CsrRefused(&'static str),
    /// A part of the signing request is damaged.
    #[error("the certificate signing request has a damaged {part}")]
    CsrDamaged {
        /// The part, in English.
        part: &'static str,
        /// What the library says about it.
        #[source]
        cause: Cause,
    },
    /// The key in the request is too short for the CA to sign; holds the bits.
    #[error("the key has {0} bits; at least 2048 are asked for")]
    ShortKey(u16),
    /// The key of a CA has another length than 2048 or 4096 bits; holds the bits.
    #[error("the key of a CA has 2048 or 4096 bits, not {0}")]
    AuthorityKey(u16),
    /// Intermediate and root CA have the same name.
    #[error("the intermediate CA needs another name than the root")]
    AuthorityName,
    /// The certificate cannot be issued by the CA; holds the sentence.
    #[error("{0}")]
    CannotSign(&'static str),
    /// The certificate of the CA has expired; holds when.
    #[error("the CA was valid until {0}")]
    AuthorityExpired(DateTime<Utc>),
    /// The certificate of the CA is not valid yet; holds from when on.
    #[error("the CA is valid from {0} on")]
    AuthorityNotYetValid(DateTime<Utc>),

    // a key
    /// The bytes are not an RSA private key.
    #[error("not an RSA private key, or a damaged one")]
    NotAPrivateKey(#[source] Cause),
    /// The RSA key has a length that is not used; holds the bits.
    #[error("RSA keys of {0} bits are not used; only 1024, 2048 and 4096 are")]
    KeyLength(u16),
    /// The cryptographic library made no key.
    #[error("the key could not be made")]
    KeyGeneration(#[source] Cause),
    /// The key could not be encoded.
    #[error("the key could not be written")]
    KeyEncoding(#[source] Cause),

    // a PKCS#12 file
    /// The bytes are not a PKCS#12.
    #[error("not a PKCS#12 file")]
    NotPkcs12,
    /// The PKCS#12 uses an algorithm or structure that is not read; holds which.
    #[error("this kind of PKCS#12 is not supported: {0}")]
    UnsupportedPkcs12(String),
    /// The format cannot always tell the two apart.
    #[error("the password is wrong, or the file is damaged")]
    WrongPasswordOrDamaged,
    /// The file has no private key.
    #[error("there is no private key in it")]
    NoKey,
    /// The file has several private keys; holds how many.
    #[error("there are {0} private keys in it; exactly one is expected")]
    SeveralKeys(usize),
    /// No certificate in the file has the public key of the private key.
    #[error("no certificate belongs to the private key")]
    NotAPair,
    /// The PKCS#12 could not be encoded.
    #[error("the PKCS#12 could not be written")]
    Pkcs12Encoding,
    /// The structure of the file is damaged.
    #[error("the file is damaged")]
    Damaged,

    // a key file
    /// The key is encrypted and no password was given.
    #[error("the private key is encrypted, and no password was given")]
    PasswordNeeded,
    /// How the key is encrypted.
    #[error(
        "the encryption of the private key, {0}, is not supported; encrypt it anew with \
         `openssl pkcs8 -topk8 -in FILE -out new.key`"
    )]
    UnsupportedKeyEncryption(String),

    // a certificate to be used
    /// The certificate has expired; holds when.
    #[error("the certificate was valid until {0}")]
    Expired(DateTime<Utc>),
    /// No ticked security policy allows the key length; holds the bits.
    #[error("the security policies do not allow {0}-bit keys")]
    KeyLengthNotAllowed(u16),

    // a certificate to be made
    /// The subject is wrong.
    #[error(transparent)]
    Subject(#[from] SubjectError),
    /// The text is not a URI; holds the text.
    #[error("the application URI \"{0}\" is not a URI")]
    ApplicationUri(String),
    /// The text is not a DNS name; holds the text.
    #[error("\"{0}\" is not a DNS name")]
    DnsName(String),
    /// No address and no DNS name were given for a server certificate.
    #[error("a server certificate needs at least one IP address or DNS name")]
    NoHostName,
    /// The key has another length than was asked for.
    #[error("a {asked}-bit key was asked for, but the key has {got} bits")]
    OtherKeyLength {
        /// Bits asked for.
        asked: u16,
        /// Bits of the key.
        got: u16,
    },
    /// A date is outside of what X.509 can write.
    #[error("the certificate's dates cannot be written")]
    Dates(#[source] Cause),
    /// The operating system gave no random numbers.
    #[error("no random numbers are to be had")]
    Random(#[source] Cause),
    /// The cryptographic library did not sign.
    #[error("the certificate could not be signed")]
    Signing(#[source] Cause),
}

impl PkiError {
    /// [`PkiError::Dates`], found before a library was asked.
    pub(super) fn beyond_calendar() -> Self {
        Self::Dates(Cause::finding("a date is out of range"))
    }

    /// The code that stands for the error in a [`Problem`].
    pub const fn code(&self) -> ErrorCode {
        match self {
            Self::Subject(_)
            | Self::ApplicationUri(_)
            | Self::DnsName(_)
            | Self::NoHostName
            | Self::AuthorityName
            | Self::AuthorityKey(_) => ErrorCode::BadCertificateRequest,
            Self::CannotSign(_) => ErrorCode::AuthorityDamaged,
            Self::CsrRefused(_) | Self::CsrDamaged { .. } => ErrorCode::CsrRefused,
            Self::ShortKey(_) => ErrorCode::ShortKey,
            Self::AuthorityExpired(_) | Self::AuthorityNotYetValid(_) => ErrorCode::AuthorityExpired,
            Self::NotAPair => ErrorCode::KeyMismatch,
            Self::WrongPasswordOrDamaged | Self::PasswordNeeded => ErrorCode::WrongKeyPassword,
            Self::Expired(_) => ErrorCode::CertificateExpired,
            Self::KeyLengthNotAllowed(_) => ErrorCode::KeyLengthNotAllowed,
            Self::NotAPrivateKey(_)
            | Self::KeyLength(_)
            | Self::NotACsr(_)
            | Self::CsrSignature
            | Self::SeveralCsrs(_)
            | Self::NotPkcs12
            | Self::UnsupportedPkcs12(_)
            | Self::NoKey
            | Self::SeveralKeys(_)
            | Self::Damaged
            | Self::Text(_)
            | Self::OtherContent { wanted: Wanted::Csr | Wanted::PrivateKey | Wanted::Pkcs12, .. }
            | Self::UnsupportedKeyEncryption(_) => ErrorCode::FileFormat,
            Self::KeyGeneration(_)
            | Self::KeyEncoding(_)
            | Self::Pkcs12Encoding
            | Self::OtherKeyLength { .. }
            | Self::Dates(_)
            | Self::Random(_)
            | Self::Signing(_) => ErrorCode::Internal,
            Self::Empty
            | Self::TooLarge { .. }
            | Self::NotACertificate(_)
            | Self::NotAPublicKey(_)
            | Self::TrailingBytes(_)
            | Self::SignatureAlgorithms
            | Self::RepeatedExtension
            | Self::BadPem
            | Self::NoCertificate
            | Self::SeveralCertificates(_)
            | Self::NotACrl(_)
            | Self::NotPkcs7(_)
            | Self::NotTrustMaterial
            | Self::OtherContent { .. }
            | Self::TooMany(_)
            | Self::TooManySigners
            | Self::PrivateKeyInside => ErrorCode::BadCertificate,
        }
    }
}

impl From<PkiError> for Problem {
    fn from(error: PkiError) -> Self {
        Self::with_detail(error.code(), with_sources(&error))
    }
}

#[cfg(test)]
mod tests {
    use std::error::Error as _;

    use super::*;
    use crate::pki::{Certificate, PrivateKey};

    #[test]
    fn a_problem_says_whose_fault_it_is_and_why() {
        let bad_file = Problem::from(PkiError::TrailingBytes(3));
        assert_eq!(bad_file.code, ErrorCode::BadCertificate);
        assert_eq!(bad_file.detail.as_deref(), Some("3 bytes follow the end"));

        let bad_wish = Problem::from(PkiError::from(SubjectError::Empty("common name")));
        assert_eq!(bad_wish.code, ErrorCode::BadCertificateRequest);
        assert_eq!(bad_wish.detail.as_deref(), Some("common name is empty"));

        assert_eq!(Problem::from(PkiError::Signing(Cause::any())).code, ErrorCode::Internal);
    }

    #[test]
    fn what_a_library_says_is_the_source_and_ends_the_detail() {
        let key = PrivateKey::from_pkcs8_der(&[0x30, 3, 2, 1, 0]).unwrap_err();
        assert_eq!(key, PkiError::NotAPrivateKey(Cause::any()));
        let source = key.source().expect("the DER reader says where it stopped").to_string();
        let detail = Problem::from(key).detail.unwrap();
        assert_eq!(detail, format!("not an RSA private key, or a damaged one: {source}"));

        let certificate = Certificate::from_der(&[0x30, 0]).unwrap_err();
        assert!(certificate.source().is_some(), "{certificate:?}");
        assert_eq!(PkiError::Empty.source().map(ToString::to_string), None);
    }
}
