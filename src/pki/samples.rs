//! Keys and certificates for the tests of this room, made once: keys are slow.

use std::sync::LazyLock;

use chrono::{DateTime, TimeZone as _, Utc};

use super::{Certificate, PrivateKey, ServerNames, self_signed};
use crate::model::{KeyLength, SelfSignedRequest, Subject, Validity};

pub(super) fn key() -> &'static PrivateKey {
    static KEY: LazyLock<PrivateKey> = LazyLock::new(|| PrivateKey::generate(KeyLength::Rsa2048).unwrap());
    &KEY
}

pub(super) fn other_key() -> &'static PrivateKey {
    static KEY: LazyLock<PrivateKey> = LazyLock::new(|| PrivateKey::generate(KeyLength::Rsa2048).unwrap());
    &KEY
}

pub(super) fn legacy_key() -> &'static PrivateKey {
    static KEY: LazyLock<PrivateKey> = LazyLock::new(|| PrivateKey::generate(KeyLength::Rsa1024).unwrap());
    &KEY
}

pub(super) fn certificate() -> &'static Certificate {
    static CERTIFICATE: LazyLock<Certificate> = LazyLock::new(|| certificate_for(key()));
    &CERTIFICATE
}

pub(super) fn certificate_for(key: &PrivateKey) -> Certificate {
    let length = KeyLength::try_from(key.bits()).unwrap();
    self_signed(&request(length), &names(), key, now()).unwrap()
}

pub(super) fn request(key_length: KeyLength) -> SelfSignedRequest {
    let subject = Subject {
        common_name: "EpsonRC.SN0000123.192.168.010.001".into(),
        country: "JP".into(),
        state: "Nagano".into(),
        locality: "Suwa".into(),
        organisation: "Example & Sons".into(),
    };
    SelfSignedRequest { subject, key_length, validity: Validity::try_from(5).unwrap() }
}

pub(super) fn names() -> ServerNames {
    ServerNames {
        application_uri: "urn:EpsonRC:SN0000123".into(),
        ips: vec!["192.168.10.1".parse().unwrap(), "fe80::1".parse().unwrap()],
        dns: vec!["robot-7.plant.example".into()],
    }
}

pub(super) fn now() -> DateTime<Utc> {
    Utc.with_ymd_and_hms(2030, 6, 15, 12, 0, 0).unwrap()
}
