use std::fmt;

use rcgen::{CertificateParams, ExtendedKeyUsagePurpose, IsCa, KeyUsagePurpose};
use sha2::{Digest as _, Sha256};
use x509_parser::certification_request::X509CertificationRequest;
use x509_parser::cri_attributes::ExtensionRequest;
use x509_parser::prelude::{FromDer, X509Extension};

use super::parts::{FilePart, parts};
use super::pem::{self, MAX_CERTIFICATE_FILE_BYTES};
use super::self_signed::{alternative_names, distinguished_name};
use super::signature::{PublicKey, SignatureAlgorithm, SignatureCheck};
use super::size::check_size;
use super::{Certificate, FileContent, MAX_CERTIFICATE_BYTES, PkiError, PrivateKey, ServerNames, Wanted, name, tlv};
use crate::model::{Cause, CsrRequest, with_cause};

/// A certificate signing request (PKCS#10) for an RSA key, found whole, with a signature that proves that its
/// maker holds the private key.
#[derive(Clone, PartialEq, Eq)]
pub struct Csr {
    der: Vec<u8>,
    common_name: Option<String>,
    key_bits: u16,
    /// In PKCS#1.
    public_key: Vec<u8>,
}

impl Csr {
    /// From DER and nothing but DER, of at most [`MAX_CERTIFICATE_BYTES`].
    pub fn from_der(der: &[u8]) -> Result<Self, PkiError> {
        check_size(der, MAX_CERTIFICATE_BYTES)?;
        let (rest, parsed) = X509CertificationRequest::from_der(der).map_err(with_cause(PkiError::NotACsr))?;
        if !rest.is_empty() {
            return Err(PkiError::TrailingBytes(rest.len()));
        }
        let info = &parsed.certification_request_info;
        let key = PublicKey::of(&info.subject_pki).map_err(with_cause(PkiError::NotACsr))?;
        let algorithm = SignatureAlgorithm::of(&parsed.signature_algorithm);
        let check = algorithm.verify(&key, info.raw, &parsed.signature_value.data);
        let PublicKey::Rsa { pkcs1: public_key, bits: key_bits, .. } = key else {
            return Err(PkiError::NotACsr(Cause::finding("its key is of another kind")));
        };
        match check {
            SignatureCheck::Valid => {}
            SignatureCheck::Invalid => return Err(PkiError::CsrSignature),
            SignatureCheck::CannotVerify(why) => return Err(PkiError::NotACsr(Cause::new(why))),
        }
        Ok(Self { der: der.to_vec(), common_name: name::common_name(&info.subject), key_bits, public_key })
    }

    /// From a file of at most [`MAX_CERTIFICATE_FILE_BYTES`] that holds exactly one request, in DER, PEM or base64;
    /// other things beside it are passed over.
    pub fn from_any(bytes: &[u8]) -> Result<Self, PkiError> {
        check_size(bytes, MAX_CERTIFICATE_FILE_BYTES)?;
        let mut parts = parts(bytes)?;
        let requests = parts.iter().filter(|part| part.content == FileContent::Csr).count();
        match (parts.iter().position(|part| part.content == FileContent::Csr), requests) {
            (Some(at), 1) => Self::from_der(&parts.remove(at).der),
            (Some(_), several) => Err(PkiError::SeveralCsrs(several)),
            (None, _) => match parts.remove(0) {
                FilePart { content: FileContent::Unknown, der } => Self::from_der(&der),
                FilePart { content: found, .. } => Err(PkiError::OtherContent { found, wanted: Wanted::Csr }),
            },
        }
    }

    /// The request itself, as it was read.
    pub fn der(&self) -> &[u8] {
        &self.der
    }

    /// As PEM, ending with a line feed.
    pub fn to_pem(&self) -> String {
        pem::csr(&self.der)
    }

    /// The subject's common name, without control characters.
    pub fn common_name(&self) -> Option<&str> {
        self.common_name.as_deref()
    }

    /// The length of the key.
    pub const fn key_bits(&self) -> u16 {
        self.key_bits
    }

    /// SHA-256 of the public key in PKCS#1, in lower-case hexadecimal: which requests are for the same key.
    pub fn key_digest(&self) -> String {
        hex::encode(Sha256::digest(&self.public_key))
    }

    /// Whether the certificate is for the key of this request. What else the CA changed is its own affair.
    pub fn matches(&self, certificate: &Certificate) -> bool {
        certificate.rsa_public_key() == Some(self.public_key.as_slice())
    }

    /// Whether the request was made with this key.
    pub fn is_of(&self, key: &PrivateKey) -> bool {
        key.public_key() == self.public_key
    }
}

impl fmt::Debug for Csr {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Csr({:?}, {} bits)", self.common_name.as_deref().unwrap_or_default(), self.key_bits)
    }
}

/// The extensions a request asks for: those of the attribute `extensionRequest` (RFC 2985 §5.4.2), or of Microsoft's
/// older `szOID_CERT_EXTENSIONS`, which holds the same (MS-WCCE §3.1.1.4.3.1.1).
pub(super) fn requested_extensions<'a>(
    request: &X509CertificationRequest<'a>,
) -> Result<Vec<X509Extension<'a>>, PkiError> {
    let part = "attribute";
    let damaged = || PkiError::CsrDamaged { part, cause: Cause::finding("it is not whole") };
    let info = tlv::sole(request.certification_request_info.raw).and_then(|info| tlv::all(info.content));
    let parts = info.ok_or_else(damaged)?;
    let Some(attributes) = parts.iter().find(|part| part.tag == tlv::CONTEXT_0) else { return Ok(Vec::new()) };
    let attributes = tlv::all(attributes.content).ok_or_else(damaged)?;
    let values = |wanted: &[u8]| {
        attributes.iter().find_map(|attribute| match tlv::all(attribute.content)?.as_slice() {
            [kind, values] if kind.content == wanted => Some(values.content),
            _ => None,
        })
    };
    match values(EXTENSION_REQUEST).or_else(|| values(CERT_EXTENSIONS)) {
        Some(values) => {
            let (rest, request) =
                ExtensionRequest::from_der(values).map_err(with_cause(|cause| PkiError::CsrDamaged { part, cause }))?;
            if rest.is_empty() { Ok(request.extensions) } else { Err(damaged()) }
        }
        None => Ok(Vec::new()),
    }
}

/// 1.2.840.113549.1.9.14
const EXTENSION_REQUEST: &[u8] = &[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 9, 14];
/// 1.3.6.1.4.1.311.2.1.14
const CERT_EXTENSIONS: &[u8] = &[0x2b, 6, 1, 4, 1, 0x82, 0x37, 2, 1, 14];

/// Makes the request for the certificate of an OPC UA server (manual 2.7.1.5; OPC 10000-6 §6.2.2), signed with SHA-256
/// whatever the length of the key.
///
/// It asks for everything the certificate should have: names, key usages, server and client authentication, and not to
/// be a CA.
pub fn make_csr(request: &CsrRequest, names: &ServerNames, key: &PrivateKey) -> Result<Csr, PkiError> {
    let (asked, got) = (request.key_length.bits(), key.bits());
    if asked != got {
        return Err(PkiError::OtherKeyLength { asked, got });
    }
    let mut params = CertificateParams::default();
    params.distinguished_name = distinguished_name(&request.subject)?;
    params.subject_alt_names = alternative_names(names)?;
    params.key_usages = vec![
        KeyUsagePurpose::DigitalSignature,
        KeyUsagePurpose::ContentCommitment,
        KeyUsagePurpose::KeyEncipherment,
        KeyUsagePurpose::DataEncipherment,
    ];
    params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ServerAuth, ExtendedKeyUsagePurpose::ClientAuth];
    params.is_ca = IsCa::ExplicitNoCa;
    let csr = params.serialize_request(key).map_err(with_cause(PkiError::Signing))?;
    Csr::from_der(csr.der())
}

#[cfg(test)]
mod tests {
    use super::*;
    use x509_parser::prelude::ParsedExtension;

    use crate::model::{KeyLength, SubjectError};
    use crate::pki::samples;

    fn request(key_length: KeyLength) -> CsrRequest {
        CsrRequest { subject: samples::request(key_length).subject, key_length }
    }

    fn csr_of(key: &PrivateKey) -> Csr {
        make_csr(&request(KeyLength::try_from(key.bits()).unwrap()), &samples::names(), key).unwrap()
    }

    #[test]
    fn it_asks_for_what_opc_ua_needs_at_every_key_length() {
        for key in [samples::legacy_key(), samples::key()] {
            let csr = csr_of(key);
            assert_eq!((csr.key_bits(), csr.common_name()), (key.bits(), Some("EpsonRC.SN0000123.192.168.010.001")));
            let (_, parsed) = X509CertificationRequest::from_der(csr.der()).unwrap();
            assert_eq!(
                parsed.certification_request_info.subject.to_string(),
                "C=JP, ST=Nagano, L=Suwa, O=Example & Sons, CN=EpsonRC.SN0000123.192.168.010.001"
            );
            let (mut names, mut usage, mut extended, mut constraints) = (0, 0, false, true);
            for extension in requested_extensions(&parsed).unwrap() {
                match extension.parsed_extension() {
                    ParsedExtension::SubjectAlternativeName(san) => names = san.general_names.len(),
                    ParsedExtension::KeyUsage(asked) => usage = asked.flags,
                    ParsedExtension::ExtendedKeyUsage(asked) => extended = asked.server_auth && asked.client_auth,
                    ParsedExtension::BasicConstraints(asked) => constraints = asked.ca,
                    _ => {}
                }
            }
            assert_eq!((names, usage, extended, constraints), (4, 0b1111, true, false));
        }
    }

    #[test]
    fn it_belongs_to_one_key_and_its_certificates() {
        let csr = csr_of(samples::key());
        assert!(csr.is_of(samples::key()) && !csr.is_of(samples::other_key()));
        assert!(csr.matches(samples::certificate()));
        assert!(!csr.matches(&samples::certificate_for(samples::other_key())));
    }

    #[test]
    fn what_is_written_is_read_back_in_both_forms() {
        let csr = csr_of(samples::key());
        assert_eq!(Csr::from_any(csr.der()).as_ref(), Ok(&csr));
        assert_eq!(Csr::from_any(csr.to_pem().as_bytes()).as_ref(), Ok(&csr));
        assert_eq!(Csr::from_any((csr.to_pem() + &csr.to_pem()).as_bytes()), Err(PkiError::SeveralCsrs(2)));
        let other = PkiError::OtherContent { found: FileContent::Certificate, wanted: Wanted::Csr };
        assert_eq!(Csr::from_any(samples::certificate().to_pem().as_bytes()), Err(other.clone()));
        assert_eq!(Csr::from_any(samples::certificate().der()), Err(other));
        assert_eq!(Csr::from_any(b"hello, robot"), Err(PkiError::NotACsr(Cause::any())));
        assert_eq!(Csr::from_any(b""), Err(PkiError::Empty));
        assert_eq!(Csr::from_der(&[csr.der(), b"\0"].concat()), Err(PkiError::TrailingBytes(1)));
    }

    #[test]
    fn every_damaged_byte_and_every_missing_end_is_noticed() {
        let csr = csr_of(samples::legacy_key());
        for at in 0..csr.der().len() {
            let mut damaged = csr.der().to_vec();
            damaged[at] ^= 0x04;
            if let Ok(read) = Csr::from_der(&damaged) {
                // The parameters of the signature algorithm mean nothing and are not signed.
                assert!(read == Csr { der: damaged, ..csr.clone() }, "byte {at}");
            }
            assert!(Csr::from_der(&csr.der()[..at]).is_err(), "first {at} bytes");
        }
    }

    #[test]
    fn a_wish_that_cannot_be_granted_is_refused() {
        let mut nameless = request(KeyLength::Rsa2048);
        nameless.subject.common_name.clear();
        let made = make_csr(&nameless, &samples::names(), samples::key());
        assert_eq!(made, Err(PkiError::Subject(SubjectError::Empty("common name"))));
        let made = make_csr(&request(KeyLength::Rsa4096), &samples::names(), samples::key());
        assert_eq!(made, Err(PkiError::OtherKeyLength { asked: 4096, got: 2048 }));
        let nowhere = ServerNames { ips: vec![], dns: vec![], ..samples::names() };
        assert_eq!(make_csr(&request(KeyLength::Rsa2048), &nowhere, samples::key()), Err(PkiError::NoHostName));
    }
}
