//! Everything public inside a file, for people and scripts to read.

use chrono::{DateTime, Utc};
use rsa::pkcs8::PrivateKeyInfo;
use rsa::pkcs8::der::Encode as _;
use serde::{Deserialize, Serialize};
use sha1::{Digest as _, Sha1};
use x509_parser::certification_request::X509CertificationRequest;
use x509_parser::prelude::{FromDer as _, SubjectPublicKeyInfo};

use super::certificate_fields::Extensions;
use super::csr::requested_extensions;
use super::general_name::{NameConstraints, Subtree};
use super::parts::{FilePart, parts};
use super::signature::{Curve, PublicKey, SignatureAlgorithm, SignatureCheck};
use super::signers::{SignedBy, Signers};
use super::size::check_size;
use super::{
    AlternativeName, BasicConstraints, Bundle, Certificate, Crl, ExtendedKeyUsage, FileContent, KeyUsage,
    MAX_BUNDLE_BYTES, PkiError, RevocationReason, Wanted, key_file, name, pkcs12, tlv,
};
use crate::model::{Cause, Language, with_cause};

/// One item inside a file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Description {
    /// An X.509 certificate.
    Certificate(Box<CertificateDescription>),
    /// A revocation list.
    Crl(Box<CrlDescription>),
    /// A signing request.
    Csr(Box<CsrDescription>),
    /// A private key. The description holds nothing secret.
    PrivateKey(KeyDescription),
    /// A public key.
    PublicKey(KeyDescription),
}

/// Everything a certificate says. Texts hold no control characters.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CertificateDescription {
    /// The whole subject name.
    pub subject: String,
    /// The whole name of the issuer.
    pub issuer: String,
    /// The common name of the subject, if it has one.
    pub common_name: Option<String>,
    /// Upper-case hexadecimal.
    pub serial_number: String,
    /// X.509 version: 1, 2 or 3.
    pub version: u32,
    /// First moment of the validity.
    pub not_before: DateTime<Utc>,
    /// Last moment of the validity.
    pub not_after: DateTime<Utc>,
    /// The first URI of the alternative names.
    pub application_uri: Option<String>,
    /// The subject alternative names; empty without the extension.
    pub alternative_names: Vec<AlternativeName>,
    /// Whether it is the certificate of a CA; `None` without the extension.
    pub basic_constraints: Option<BasicConstraints>,
    /// What the key may be used for; `None` without the extension.
    pub key_usages: Option<Vec<KeyUsage>>,
    /// What the certificate is for; `None` without the extension.
    pub extended_key_usages: Option<Vec<ExtendedKeyUsage>>,
    /// What an authority says about the names below it.
    #[serde(default)]
    pub name_constraints: Option<NameConstraintsDescription>,
    /// Object identifiers of certificate policies; `None` without the extension.
    #[serde(default)]
    pub policies: Option<Vec<String>>,
    /// Upper-case hexadecimal.
    pub subject_key_id: Option<String>,
    /// Upper-case hexadecimal.
    pub authority_key_id: Option<String>,
    /// The public key.
    pub key: KeyDescription,
    /// Name of the signature algorithm, or its object identifier.
    pub signature_algorithm: String,
    /// Whether its own key signed it: not only its names are the same, its signature was checked.
    pub self_signed: bool,
    /// The SHA-1 thumbprint of the certificate in the same file whose key signed this one, itself aside.
    pub signed_by: Option<String>,
    /// Why an OPC UA application must refuse it, independently of its issuer; `None`: it need not.
    pub not_understood: Option<String>,
    /// Upper-case hexadecimal: the thumbprint of OPC UA.
    pub sha1: String,
    /// Upper-case hexadecimal.
    pub sha256: String,
}

/// RFC 5280 §4.2.1.10.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct NameConstraintsDescription {
    /// The names that a CA below may certify.
    pub permitted: Vec<String>,
    /// The names that a CA below must not certify.
    pub excluded: Vec<String>,
}

/// Everything a revocation list says.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CrlDescription {
    /// The whole name of the issuer.
    pub issuer: String,
    /// The CRL number in decimal; `None` without the extension.
    pub number: Option<String>,
    /// When the list was issued.
    pub this_update: DateTime<Utc>,
    /// Until when a newer one is due; `None` if the list does not tell.
    pub next_update: Option<DateTime<Utc>>,
    /// Upper-case hexadecimal.
    pub authority_key_id: Option<String>,
    /// Name of the signature algorithm, or its object identifier.
    pub signature_algorithm: String,
    /// The SHA-1 thumbprint of the certificate in the same file whose key signed it.
    pub signed_by: Option<String>,
    /// Why it cannot be used for a full check, if it cannot.
    pub unusable: Option<String>,
    /// Which certificates it is only about, if not about all of its authority.
    pub limits: Option<String>,
    /// SHA-1 of the DER in upper-case hexadecimal.
    pub sha1: String,
    /// The revoked certificates, in the order of the list.
    pub entries: Vec<CrlEntry>,
}

/// One revoked certificate.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CrlEntry {
    /// Upper-case hexadecimal.
    pub serial_number: String,
    /// When the certificate was revoked.
    pub date: DateTime<Utc>,
    /// Why it was revoked.
    pub reason: RevocationReason,
}

/// Everything a certificate signing request asks for.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CsrDescription {
    /// The whole subject name.
    pub subject: String,
    /// The subject alternative names; empty without the extension.
    pub alternative_names: Vec<AlternativeName>,
    /// Whether the certificate of a CA is asked for; `None` without the extension.
    pub basic_constraints: Option<BasicConstraints>,
    /// What the key is to be used for; `None` without the extension.
    pub key_usages: Option<Vec<KeyUsage>>,
    /// What the certificate is to be for; `None` without the extension.
    pub extended_key_usages: Option<Vec<ExtendedKeyUsage>>,
    /// The public key.
    pub key: KeyDescription,
    /// Name of the signature algorithm, or its object identifier.
    pub signature_algorithm: String,
    /// Whether its signature proves that the requester holds the private key.
    pub signature_is_right: bool,
    /// SHA-1 of the DER in upper-case hexadecimal.
    pub sha1: String,
}

/// The public facts about a key. Its private half may be in the file or not.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct KeyDescription {
    /// `RSA`, `EC`, or an object identifier.
    pub algorithm: String,
    /// Length in bits, of an RSA key.
    pub bits: Option<u16>,
    /// Name or object identifier of the curve, of an EC key.
    pub curve: Option<String>,
    /// SHA-1 of the public key in upper-case hexadecimal (RFC 5280 §4.2.1.2, method 1): the same for a key, its request
    /// and its certificates.
    pub key_id: Option<String>,
}

/// Describes everything in a file of any kind this program reads, in its order: certificates, chains, revocation lists,
/// signing requests, keys, PKCS#7 and PKCS#12, in DER or PEM.
///
/// The password is that of a PKCS#12 or of an encrypted key. Private keys are described by their public half. Blocks
/// while it hashes the password, and for some signature checks, 2000 at most.
pub fn describe(bytes: &[u8], password: Option<&str>) -> Result<Vec<Description>, PkiError> {
    check_size(bytes, MAX_BUNDLE_BYTES)?;
    let mut found = FileReading::default();
    for part in parts(bytes)? {
        found.part(part, password)?;
        if found.items.len() > MAX_ITEMS {
            return Err(PkiError::TooMany(MAX_ITEMS));
        }
    }
    if found.items.is_empty() {
        return Err(PkiError::NoCertificate);
    }
    found.described()
}

const MAX_ITEMS: usize = 1000;
/// A file decides itself how slow it is to open an encrypted key, and may hold thousands.
const MAX_HASHED: usize = 16;

/// One item of the file. Certificates and lists are described last: their signers may come later in the file.
enum DescribedItem {
    Certificate(Certificate),
    Crl(Crl),
    Other(Description),
}

#[derive(Default)]
struct FileReading {
    items: Vec<DescribedItem>,
    /// Keys the password was hashed for.
    hashed: usize,
}

impl FileReading {
    fn part(&mut self, part: FilePart, password: Option<&str>) -> Result<(), PkiError> {
        match part.content {
            FileContent::Csr => self.other(Description::Csr(Box::new(request(&part.der)?))),
            FileContent::PublicKey => {
                let (_, info) =
                    SubjectPublicKeyInfo::from_der(&part.der).map_err(with_cause(PkiError::NotAPublicKey))?;
                self.other(Description::PublicKey(
                    PublicKey::of(&info).map_err(with_cause(PkiError::NotAPublicKey))?.describe(),
                ));
            }
            FileContent::PrivateKey => self.other(Description::PrivateKey(plain_key(&part.der)?)),
            FileContent::EncryptedKey => {
                self.hashed += 1;
                if self.hashed > MAX_HASHED {
                    return Err(PkiError::TooMany(MAX_HASHED));
                }
                let key = key_file::read_key(&part, password)?;
                self.other(Description::PrivateKey(rsa_key(key.public_key())));
            }
            content if content.is_private_key() => {
                return Err(PkiError::OtherContent { found: content, wanted: Wanted::PrivateKey });
            }
            FileContent::Pkcs12 => {
                let pkcs12::Pkcs12Contents { keys, certificates } =
                    pkcs12::contents(&part.der, password.ok_or(PkiError::PasswordNeeded)?)?;
                for key in keys {
                    self.other(Description::PrivateKey(plain_key(&key)?));
                }
                self.bundle(Bundle { certificates, crls: Vec::new() });
            }
            _ => {
                let mut bundle = Bundle::default();
                bundle.add(part)?;
                self.bundle(bundle);
            }
        }
        Ok(())
    }

    fn other(&mut self, description: Description) {
        self.items.push(DescribedItem::Other(description));
    }

    fn bundle(&mut self, bundle: Bundle) {
        self.items.extend(bundle.certificates.into_iter().map(DescribedItem::Certificate));
        self.items.extend(bundle.crls.into_iter().map(DescribedItem::Crl));
    }

    fn described(&self) -> Result<Vec<Description>, PkiError> {
        let mut signers = Signers::new(self.items.iter().filter_map(|item| match item {
            DescribedItem::Certificate(certificate) => Some(certificate),
            _ => None,
        }));
        self.items
            .iter()
            .map(|item| match item {
                DescribedItem::Certificate(certificate) => {
                    let signed = signers.of_certificate(certificate)?;
                    Ok(Description::Certificate(Box::new(certificate.describe(&signed))))
                }
                DescribedItem::Crl(crl) => Ok(Description::Crl(Box::new(crl.describe(signers.of_crl(crl)?)))),
                DescribedItem::Other(description) => Ok(description.clone()),
            })
            .collect()
    }
}

impl Certificate {
    fn describe(&self, signed: &SignedBy<'_>) -> CertificateDescription {
        let facts = self.facts();
        CertificateDescription {
            subject: facts.subject.clone(),
            issuer: facts.issuer.clone(),
            common_name: facts.common_name.clone(),
            serial_number: facts.serial_number.clone(),
            version: facts.version,
            not_before: facts.not_before,
            not_after: facts.not_after,
            application_uri: self.application_uri(),
            alternative_names: facts.extensions.alternative_names.clone(),
            basic_constraints: facts.extensions.basic_constraints,
            key_usages: facts.extensions.key_usages.clone(),
            extended_key_usages: facts.extensions.extended_key_usages.clone(),
            name_constraints: facts.extensions.name_constraints.as_ref().map(NameConstraints::describe),
            policies: facts.extensions.policies.asserted.clone(),
            subject_key_id: self.subject_key_id().map(hex::encode_upper),
            authority_key_id: self.authority_key_id().map(hex::encode_upper),
            key: facts.public_key.describe(),
            signature_algorithm: facts.signature_algorithm.name().to_owned(),
            self_signed: signed.by_itself,
            signed_by: signed.by.map(Self::thumbprint_sha1),
            not_understood: super::rules::structure_flaw(self).map(|flaw| flaw.reason(Language::En)),
            sha1: self.thumbprint_sha1(),
            sha256: hex::encode_upper(self.sha256()),
        }
    }
}

impl NameConstraints {
    fn describe(&self) -> NameConstraintsDescription {
        let texts =
            |subtrees: &[Subtree]| subtrees.iter().map(|subtree| name::printable(&subtree.base.text())).collect();
        NameConstraintsDescription { permitted: texts(&self.permitted), excluded: texts(&self.excluded) }
    }
}

impl Crl {
    fn describe(&self, signer: Option<&Certificate>) -> CrlDescription {
        CrlDescription {
            issuer: self.issuer().to_owned(),
            number: self.number().map(str::to_owned),
            this_update: self.this_update(),
            next_update: self.next_update(),
            authority_key_id: self.authority_key_id().map(hex::encode_upper),
            signature_algorithm: self.signature_algorithm().to_owned(),
            signed_by: signer.map(Certificate::thumbprint_sha1),
            unusable: self.unusable().map(|why| why.to_string()),
            limits: self.limits().map(|limits| limits.to_string()),
            sha1: self.id(),
            entries: self
                .entries()
                .map(|(serial_number, revoked)| CrlEntry { serial_number, date: revoked.date, reason: revoked.reason })
                .collect(),
        }
    }
}

impl PublicKey {
    fn describe(&self) -> KeyDescription {
        let key_id = |key: &[u8]| Some(hex::encode_upper(Sha1::digest(key)));
        match self {
            Self::Rsa { pkcs1, bits, .. } => {
                KeyDescription { algorithm: "RSA".to_owned(), bits: Some(*bits), curve: None, key_id: key_id(pkcs1) }
            }
            Self::Ec { curve, point, bits } => KeyDescription {
                algorithm: "EC".to_owned(),
                bits: Some(*bits).filter(|bits| *bits > 0),
                curve: curve.map(|curve| curve.name().to_owned()),
                key_id: key_id(point),
            },
            Self::Other { oid } => KeyDescription { algorithm: oid.clone(), bits: None, curve: None, key_id: None },
        }
    }
}

fn request(der: &[u8]) -> Result<CsrDescription, PkiError> {
    check_size(der, super::MAX_CERTIFICATE_BYTES)?;
    let (rest, parsed) = X509CertificationRequest::from_der(der).map_err(with_cause(PkiError::NotACsr))?;
    if !rest.is_empty() {
        return Err(PkiError::TrailingBytes(rest.len()));
    }
    let info = &parsed.certification_request_info;
    let key = PublicKey::of(&info.subject_pki).map_err(with_cause(PkiError::NotACsr))?;
    let algorithm = SignatureAlgorithm::of(&parsed.signature_algorithm);
    let mut extensions = Extensions::default();
    for extension in requested_extensions(&parsed)? {
        extensions.read(extension.parsed_extension());
    }
    Ok(CsrDescription {
        subject: name::full(&info.subject),
        alternative_names: extensions.alternative_names,
        basic_constraints: extensions.basic_constraints,
        key_usages: extensions.key_usages,
        extended_key_usages: extensions.extended_key_usages,
        key: key.describe(),
        signature_algorithm: algorithm.name().to_owned(),
        signature_is_right: algorithm.verify(&key, info.raw, &parsed.signature_value.data) == SignatureCheck::Valid,
        sha1: hex::encode_upper(Sha1::digest(der)),
    })
}

/// The public half of a private key in PKCS#8, PKCS#1 or SEC 1.
fn plain_key(der: &[u8]) -> Result<KeyDescription, PkiError> {
    if PrivateKeyInfo::try_from(der).is_ok() {
        pkcs8(der)
    } else if let Some(key) = sec1(der, None) {
        Ok(key)
    } else {
        pkcs1(der)
    }
}

/// The public half of an unencrypted PKCS#8.
fn pkcs8(der: &[u8]) -> Result<KeyDescription, PkiError> {
    let info = PrivateKeyInfo::try_from(der).map_err(with_cause(PkiError::NotAPrivateKey))?;
    if info.algorithm.oid == rsa::pkcs1::ALGORITHM_OID {
        return pkcs1(info.private_key);
    }
    let oid = info.algorithm.oid.to_string();
    if oid != EC_PUBLIC_KEY {
        return Ok(PublicKey::Other { oid }.describe());
    }
    let curve = info.algorithm.parameters_oid().ok().and_then(|oid| Curve::from_oid(&oid.to_string()));
    sec1(info.private_key, curve).ok_or_else(|| PkiError::NotAPrivateKey(Cause::finding("its elliptic key is damaged")))
}

/// The public half of an elliptic key in the form of RFC 5915: a version, the private number, and perhaps the curve
/// and the public point.
fn sec1(der: &[u8], curve: Option<Curve>) -> Option<KeyDescription> {
    let (key, []) = tlv::first(der)? else { return None };
    let parts = tlv::all(key.content)?;
    let [version, number, more @ ..] = parts.as_slice() else { return None };
    if version.content != [1] || number.tag != tlv::OCTET_STRING {
        return None;
    }
    let inside = |tag| more.iter().find(|part| part.tag == tag).and_then(|part| tlv::first(part.content));
    let curve = curve.or_else(|| {
        let (oid, _) = inside(tlv::CONTEXT_0)?;
        Curve::from_oid(&x509_parser::asn1_rs::Oid::new(oid.content.into()).to_id_string())
    });
    let point = inside(CONTEXT_1).and_then(|(bits, _)| bits.content.split_first()).map(|(_, point)| point.to_vec());
    let is_known = point.is_some();
    let bits = curve.map_or(0, Curve::bits);
    let known = PublicKey::Ec { curve, bits, point: point.unwrap_or_default() }.describe();
    Some(KeyDescription { key_id: known.key_id.filter(|_| is_known), ..known })
}

/// The public half of an RSA key in PKCS#1.
fn pkcs1(der: &[u8]) -> Result<KeyDescription, PkiError> {
    let key = rsa::pkcs1::RsaPrivateKey::try_from(der).map_err(with_cause(PkiError::NotAPrivateKey))?;
    Ok(rsa_key(&key.public_key().to_der().map_err(with_cause(PkiError::NotAPrivateKey))?))
}

fn rsa_key(pkcs1: &[u8]) -> KeyDescription {
    PublicKey::rsa(pkcs1).map(|key| key.describe()).unwrap_or_else(|_| KeyDescription {
        algorithm: "RSA".to_owned(),
        bits: None,
        curve: None,
        key_id: None,
    })
}

const EC_PUBLIC_KEY: &str = "1.2.840.10045.2.1";
const CONTEXT_1: u8 = 0xa1;
