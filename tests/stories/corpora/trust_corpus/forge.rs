//! Keys, certificates and revocation lists in which everything can be wrong.

use std::sync::LazyLock;

use aws_lc_rs::rand::SystemRandom;
use aws_lc_rs::rsa::{KeyPair as RsaPair, KeySize};
use aws_lc_rs::signature::{
    ECDSA_P256_SHA256_ASN1_SIGNING, ECDSA_P384_SHA384_ASN1_SIGNING, EcdsaKeyPair, EcdsaSigningAlgorithm, KeyPair as _,
};
use chrono::{DateTime, Duration, TimeZone as _, Utc};
use rsa::pkcs1::EncodeRsaPublicKey as _;
use rsa::pkcs8::DecodePrivateKey as _;
use rsa::rand_core::OsRng;
use rsa::{Pkcs1v15Sign, Pss, RsaPrivateKey};
use sha1::Sha1;
use sha2::{Digest as _, Sha256, Sha384, Sha512};

use super::der::{bits, boolean, generalized_time, int, octets, oid, seq, set, time, tlv};

/// The moment every case is looked at.
pub fn now() -> DateTime<Utc> {
    Utc.with_ymd_and_hms(2030, 6, 15, 12, 0, 0).unwrap()
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Algorithm {
    Sha256,
    Sha384,
    Sha512,
    Sha1,
    /// With a signature of noise: no key of this kind is at hand, and the signature should not be looked at.
    Md5,
    Pss,
}

pub struct Key {
    private: Private,
    /// SubjectPublicKeyInfo.
    pub info: Vec<u8>,
    /// SHA-1 of the public key.
    pub id: Vec<u8>,
}

enum Private {
    Rsa(Box<RsaPrivateKey>),
    P256(EcdsaKeyPair),
    P384(EcdsaKeyPair),
}

impl Key {
    fn rsa(bits: usize) -> Self {
        let key = match bits {
            2048 => from_aws(KeySize::Rsa2048),
            4096 => from_aws(KeySize::Rsa4096),
            other => RsaPrivateKey::new(&mut OsRng, other).unwrap(),
        };
        let public = key.to_public_key().to_pkcs1_der().unwrap().into_vec();
        Self::new(Private::Rsa(Box::new(key)), &seq(&[&oid("1.2.840.113549.1.1.1"), &[5, 0]]), &public)
    }

    fn ec(algorithm: &'static EcdsaSigningAlgorithm, curve: &str, wrap: fn(EcdsaKeyPair) -> Private) -> Self {
        let pair = EcdsaKeyPair::generate(algorithm).unwrap();
        let public = pair.public_key().as_ref().to_vec();
        Self::new(wrap(pair), &seq(&[&oid("1.2.840.10045.2.1"), &oid(curve)]), &public)
    }

    fn new(private: Private, algorithm: &[u8], public: &[u8]) -> Self {
        Self { private, info: seq(&[algorithm, &bits(public)]), id: Sha1::digest(public).to_vec() }
    }

    /// AlgorithmIdentifier of signatures with this key.
    fn identifier(&self, algorithm: Algorithm) -> Vec<u8> {
        let rsa = |oid_text: &str| seq(&[&oid(oid_text), &[5, 0]]);
        match (&self.private, algorithm) {
            (Private::P256(_), _) => seq(&[&oid("1.2.840.10045.4.3.2")]),
            (Private::P384(_), _) => seq(&[&oid("1.2.840.10045.4.3.3")]),
            (_, Algorithm::Sha256) => rsa("1.2.840.113549.1.1.11"),
            (_, Algorithm::Sha384) => rsa("1.2.840.113549.1.1.12"),
            (_, Algorithm::Sha512) => rsa("1.2.840.113549.1.1.13"),
            (_, Algorithm::Sha1) => rsa("1.2.840.113549.1.1.5"),
            (_, Algorithm::Md5) => rsa("1.2.840.113549.1.1.4"),
            (_, Algorithm::Pss) => {
                let sha256 = seq(&[&oid("2.16.840.1.101.3.4.2.1"), &[5, 0]]);
                let mask = seq(&[&oid("1.2.840.113549.1.1.8"), &sha256]);
                let params = seq(&[&tlv(0xa0, &[&sha256]), &tlv(0xa1, &[&mask]), &tlv(0xa2, &[&int(&[32])])]);
                seq(&[&oid("1.2.840.113549.1.1.10"), &params])
            }
        }
    }

    fn sign(&self, algorithm: Algorithm, message: &[u8]) -> Vec<u8> {
        let key = match &self.private {
            Private::P256(pair) | Private::P384(pair) => {
                return pair.sign(&SystemRandom::new(), message).unwrap().as_ref().to_vec();
            }
            Private::Rsa(key) => key,
        };
        let signed = match algorithm {
            Algorithm::Sha256 => key.sign(Pkcs1v15Sign::new::<Sha256>(), &Sha256::digest(message)),
            Algorithm::Sha384 => key.sign(Pkcs1v15Sign::new::<Sha384>(), &Sha384::digest(message)),
            Algorithm::Sha512 => key.sign(Pkcs1v15Sign::new::<Sha512>(), &Sha512::digest(message)),
            Algorithm::Sha1 => key.sign(Pkcs1v15Sign::new::<Sha1>(), &Sha1::digest(message)),
            Algorithm::Pss => key.sign_with_rng(&mut OsRng, Pss::new::<Sha256>(), &Sha256::digest(message)),
            Algorithm::Md5 => Ok(vec![0x42; 256]),
        };
        signed.unwrap()
    }
}

fn from_aws(size: KeySize) -> RsaPrivateKey {
    use aws_lc_rs::encoding::AsDer as _;
    RsaPrivateKey::from_pkcs8_der(RsaPair::generate(size).unwrap().as_der().unwrap().as_ref()).unwrap()
}

/// Made once for all cases: making keys is slow.
pub struct Keys {
    pub leaf: Key,
    pub leaf_1024: Key,
    pub leaf_4096: Key,
    pub leaf_ec: Key,
    /// Of intermediates, from the leaf upwards.
    pub middle: [Key; 2],
    pub root: Key,
    /// One of a CA that is not trusted.
    pub stranger: Key,
    pub rsa_1024: Key,
    pub p256: Key,
    pub p384: Key,
}

pub fn keys() -> &'static Keys {
    static KEYS: LazyLock<Keys> = LazyLock::new(|| {
        let p256 = || Key::ec(&ECDSA_P256_SHA256_ASN1_SIGNING, "1.2.840.10045.3.1.7", Private::P256);
        Keys {
            leaf: Key::rsa(2048),
            leaf_1024: Key::rsa(1024),
            leaf_4096: Key::rsa(4096),
            leaf_ec: p256(),
            middle: [Key::rsa(2048), Key::rsa(2048)],
            root: Key::rsa(2048),
            stranger: Key::rsa(2048),
            rsa_1024: Key::rsa(1024),
            p256: p256(),
            p384: Key::ec(&ECDSA_P384_SHA384_ASN1_SIGNING, "1.3.132.0.34", Private::P384),
        }
    });
    &KEYS
}

pub const UTF8: u8 = 0x0c;
pub const PRINTABLE: u8 = 0x13;
pub const COMMON_NAME: &str = "2.5.4.3";
pub const ORGANISATION: &str = "2.5.4.10";

/// A name of one attribute a part, in strings of that type.
pub fn name_in(string_type: u8, parts: &[(&str, &str)]) -> Vec<u8> {
    let parts: Vec<Vec<u8>> =
        parts.iter().map(|(kind, text)| set(&[&seq(&[&oid(kind), &tlv(string_type, &[text.as_bytes()])])])).collect();
    tlv(0x30, &parts.iter().map(Vec::as_slice).collect::<Vec<_>>())
}

pub fn name(common_name: &str) -> Vec<u8> {
    name_in(UTF8, &[(ORGANISATION, "Plant"), (COMMON_NAME, common_name)])
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Extension {
    pub oid: &'static str,
    pub critical: bool,
    pub value: Vec<u8>,
}

impl Extension {
    pub fn new(oid: &'static str, critical: bool, value: Vec<u8>) -> Self {
        Self { oid, critical, value }
    }

    fn der(&self) -> Vec<u8> {
        let critical = if self.critical { boolean(true) } else { Vec::new() };
        seq(&[&oid(self.oid), &critical, &octets(&self.value)])
    }
}

pub const BASIC_CONSTRAINTS: &str = "2.5.29.19";
pub const KEY_USAGE: &str = "2.5.29.15";
pub const EXTENDED_KEY_USAGE: &str = "2.5.29.37";
pub const ALTERNATIVE_NAME: &str = "2.5.29.17";
pub const SUBJECT_KEY_ID: &str = "2.5.29.14";
pub const AUTHORITY_KEY_ID: &str = "2.5.29.35";
pub const DISTRIBUTION_POINT: &str = "2.5.29.28";
pub const UNKNOWN: &str = "1.3.6.1.4.1.99999.1";

pub fn basic_constraints(ca: bool, path_length: Option<u8>) -> Extension {
    let ca_der = if ca { boolean(true) } else { Vec::new() };
    let path = path_length.map(|length| int(&[length])).unwrap_or_default();
    Extension::new(BASIC_CONSTRAINTS, true, seq(&[&ca_der, &path]))
}

/// The bits by their numbers: 0 digitalSignature … 5 keyCertSign, 6 cRLSign.
pub fn key_usage(numbers: &[u8]) -> Extension {
    let flags = numbers.iter().fold(0u8, |flags, number| flags | 0x80 >> number);
    Extension::new(KEY_USAGE, true, tlv(0x03, &[&[flags.trailing_zeros().min(7) as u8, flags]]))
}

pub const SERVER_AUTH: &str = "1.3.6.1.5.5.7.3.1";
pub const CLIENT_AUTH: &str = "1.3.6.1.5.5.7.3.2";
pub const CODE_SIGNING: &str = "1.3.6.1.5.5.7.3.3";
pub const ANY_USAGE: &str = "2.5.29.37.0";

pub fn extended_key_usage(purposes: &[&str]) -> Extension {
    let purposes: Vec<Vec<u8>> = purposes.iter().map(|purpose| oid(purpose)).collect();
    let value = tlv(0x30, &purposes.iter().map(Vec::as_slice).collect::<Vec<_>>());
    Extension::new(EXTENDED_KEY_USAGE, false, value)
}

pub const URI: u8 = 0x86;
pub const DNS: u8 = 0x82;
pub const IP: u8 = 0x87;

pub fn alternative_names(names: &[(u8, &[u8])]) -> Extension {
    let names: Vec<Vec<u8>> = names.iter().map(|(tag, value)| tlv(*tag, &[value])).collect();
    let value = tlv(0x30, &names.iter().map(Vec::as_slice).collect::<Vec<_>>());
    Extension::new(ALTERNATIVE_NAME, false, value)
}

pub fn subject_key_id(id: &[u8]) -> Extension {
    Extension::new(SUBJECT_KEY_ID, false, octets(id))
}

pub fn authority_key_id(id: &[u8]) -> Extension {
    Extension::new(AUTHORITY_KEY_ID, false, seq(&[&tlv(0x80, &[id])]))
}

#[derive(Clone)]
pub struct Cert {
    /// 0 is version 1.
    pub version: u8,
    pub serial: Vec<u8>,
    pub algorithm: Algorithm,
    /// What is said outside of what is signed, if it is not the same.
    pub other_algorithm: Option<Algorithm>,
    pub subject: Vec<u8>,
    pub issuer: Vec<u8>,
    pub not_before: DateTime<Utc>,
    pub not_after: DateTime<Utc>,
    pub generalized: bool,
    pub key: &'static Key,
    /// Instead of the key's own SubjectPublicKeyInfo.
    pub info: Option<Vec<u8>>,
    pub extensions: Vec<Extension>,
    pub signer: &'static Key,
    pub damage: Option<fn(&mut Vec<u8>)>,
}

impl Cert {
    pub fn set(&mut self, extension: Extension) {
        self.drop(extension.oid);
        self.extensions.push(extension);
    }

    pub fn drop(&mut self, oid: &str) {
        self.extensions.retain(|extension| extension.oid != oid);
    }

    pub fn der(&self) -> Vec<u8> {
        let when = if self.generalized { generalized_time } else { time };
        let version = if self.version == 0 { Vec::new() } else { tlv(0xa0, &[&int(&[self.version])]) };
        let info = self.info.as_deref().unwrap_or(&self.key.info);
        let extensions = extensions(0xa3, &self.extensions);
        let identifier = self.signer.identifier(self.algorithm);
        let signed = seq(&[
            &version,
            &int(&self.serial),
            &identifier,
            &self.issuer,
            &seq(&[&when(self.not_before), &when(self.not_after)]),
            &self.subject,
            info,
            &extensions,
        ]);
        let outer = self.other_algorithm.map_or(identifier, |other| self.signer.identifier(other));
        let mut signature = self.signer.sign(self.algorithm, &signed);
        if let Some(damage) = self.damage {
            damage(&mut signature);
        }
        seq(&[&signed, &outer, &bits(&signature)])
    }
}

#[derive(Clone)]
pub struct Entry {
    pub serial: Vec<u8>,
    pub reason: Option<u8>,
    pub extensions: Vec<Extension>,
}

impl Entry {
    pub fn new(serial: &[u8]) -> Self {
        Self { serial: serial.to_vec(), reason: None, extensions: Vec::new() }
    }

    pub fn der(&self) -> Vec<u8> {
        let reason = self.reason.map(|reason| Extension::new("2.5.29.21", false, vec![0x0a, 1, reason]));
        let all: Vec<Vec<u8>> = reason.iter().chain(&self.extensions).map(Extension::der).collect();
        let all: Vec<&[u8]> = all.iter().map(Vec::as_slice).collect();
        let extensions = if all.is_empty() { Vec::new() } else { seq(&all) };
        seq(&[&int(&self.serial), &time(now() - Duration::days(2)), &extensions])
    }
}

#[derive(Clone)]
pub struct List {
    pub issuer: Vec<u8>,
    pub this_update: DateTime<Utc>,
    pub next_update: Option<DateTime<Utc>>,
    pub entries: Vec<Entry>,
    pub extensions: Vec<Extension>,
    pub algorithm: Algorithm,
    pub signer: &'static Key,
    pub damage: Option<fn(&mut Vec<u8>)>,
}

impl List {
    /// What a careful CA makes: of yesterday, for a month.
    pub fn of(ca: &Cert) -> Self {
        Self {
            issuer: ca.subject.clone(),
            this_update: now() - Duration::days(1),
            next_update: Some(now() + Duration::days(30)),
            entries: Vec::new(),
            extensions: vec![authority_key_id(&ca.key.id), Extension::new("2.5.29.20", false, int(&[7]))],
            algorithm: Algorithm::Sha256,
            signer: ca.key,
            damage: None,
        }
    }

    pub fn drop(&mut self, oid: &str) {
        self.extensions.retain(|extension| extension.oid != oid);
    }

    pub fn der(&self) -> Vec<u8> {
        let entries: Vec<Vec<u8>> = self.entries.iter().map(Entry::der).collect();
        let entries: Vec<&[u8]> = entries.iter().map(Vec::as_slice).collect();
        let entries = if entries.is_empty() { Vec::new() } else { seq(&entries) };
        let identifier = self.signer.identifier(self.algorithm);
        let signed = seq(&[
            &int(&[1]),
            &identifier,
            &self.issuer,
            &time(self.this_update),
            &self.next_update.map(time).unwrap_or_default(),
            &entries,
            &extensions(0xa0, &self.extensions),
        ]);
        let mut signature = self.signer.sign(self.algorithm, &signed);
        if let Some(damage) = self.damage {
            damage(&mut signature);
        }
        seq(&[&signed, &identifier, &bits(&signature)])
    }
}

fn extensions(tag: u8, extensions: &[Extension]) -> Vec<u8> {
    let all: Vec<Vec<u8>> = extensions.iter().map(Extension::der).collect();
    let all: Vec<&[u8]> = all.iter().map(Vec::as_slice).collect();
    if all.is_empty() { Vec::new() } else { tlv(tag, &[&seq(&all)]) }
}
