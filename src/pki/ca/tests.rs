use chrono::{DateTime, Duration, Utc};
use x509_cert::der::asn1::{Any, Ia5String, OctetString, SetOfVec};
use x509_cert::der::oid::ObjectIdentifier;
use x509_cert::der::{Encode as _, Tag};
use x509_cert::ext::Extension;
use x509_cert::ext::pkix::name::GeneralName;
use x509_cert::ext::pkix::{BasicConstraints, SubjectAltName, SubjectKeyIdentifier};
use x509_cert::name::{Name, RdnSequence, RelativeDistinguishedName};
use x509_cert::request::{CertReq, CertReqInfo, Version};
use x509_parser::prelude::{CertificateRevocationList, FromDer, ParsedExtension, X509Certificate};

use super::*;
use crate::model::{
    AuthorityRequest, AuthorityValidity, CertificateProfile, CsrRequest, ErrorCode, KeyLength, Problem, Subject,
    Validity,
};
use crate::pki::samples::{self, now};
use crate::pki::{Certificate, Csr, PkiError, PrivateKey, ServerNames, make_csr};

fn copy(key: &PrivateKey) -> PrivateKey {
    PrivateKey::from_pkcs8_der(&key.to_pkcs8_der().unwrap()).unwrap()
}

fn request(common_name: &str, years: u8) -> AuthorityRequest {
    AuthorityRequest {
        subject: Subject {
            common_name: common_name.into(),
            country: "JP".into(),
            state: String::new(),
            locality: String::new(),
            organisation: "Example & Sons".into(),
        },
        key_length: KeyLength::Rsa2048,
        validity: AuthorityValidity::try_from(years).unwrap(),
    }
}

fn root() -> CertificateAuthority {
    CertificateAuthority::root(&request("Plant CA", 20), 0, copy(samples::other_key()), now()).unwrap()
}

fn csr_of(key: &PrivateKey) -> Csr {
    let key_length = KeyLength::try_from(key.bits()).unwrap();
    let request = CsrRequest { subject: samples::request(key_length).subject, key_length };
    make_csr(&request, &samples::names(), key).unwrap()
}

fn server() -> IssueRequest {
    IssueRequest {
        profile: CertificateProfile::Server,
        validity: Validity::try_from(5).unwrap(),
        names: None,
        allow_short_keys: false,
    }
}

fn part(oid: &str, tag: Tag, text: &str) -> RelativeDistinguishedName {
    let oid = ObjectIdentifier::new(oid).unwrap();
    let value = Any::new(tag, text.as_bytes()).unwrap();
    SetOfVec::try_from(vec![x509_cert::attr::AttributeTypeAndValue { oid, value }]).unwrap().into()
}

fn named(common_name: &str) -> Name {
    RdnSequence(vec![part("2.5.4.3", Tag::Utf8String, common_name)])
}

fn uri(text: &str) -> GeneralName {
    GeneralName::UniformResourceIdentifier(Ia5String::new(text).unwrap())
}

fn dns(text: &str) -> GeneralName {
    GeneralName::DnsName(Ia5String::new(text).unwrap())
}

/// A request as other tools make them: with any subject, any names and further extensions.
fn foreign(subject: Name, names: Vec<GeneralName>, more: Vec<Extension>) -> Csr {
    let key = samples::key();
    let mut extensions = more;
    if !names.is_empty() {
        extensions.push(encode::extension(&SubjectAltName(names)).unwrap());
    }
    let asked = x509_cert::attr::Attribute {
        oid: ObjectIdentifier::new("1.2.840.113549.1.9.14").unwrap(),
        values: SetOfVec::try_from(vec![Any::encode_from(&extensions).unwrap()]).unwrap(),
    };
    let info = CertReqInfo {
        version: Version::V1,
        subject,
        public_key: encode::public_key(key).unwrap(),
        attributes: SetOfVec::try_from(vec![asked]).unwrap(),
    };
    let signature = encode::sign(key, &info).unwrap();
    Csr::from_der(&CertReq { info, algorithm: encode::algorithm(), signature }.to_der().unwrap()).unwrap()
}

fn refusal(csr: &Csr) -> PkiError {
    root().issue(csr, &server(), now()).expect_err("refused")
}

#[test]
fn a_server_certificate_is_what_opc_ua_asks_for() {
    let ca = root();
    let issued = ca.issue(&csr_of(samples::key()), &server(), now()).unwrap();
    assert!(samples::key().matches(&issued));
    assert_eq!(issued.not_before(), now() - Duration::days(1));
    assert_eq!(issued.not_after(), now() + Validity::try_from(5).unwrap().duration());
    let (_, parsed) = X509Certificate::from_der(issued.der()).unwrap();
    let (_, issuer) = X509Certificate::from_der(ca.certificate().der()).unwrap();
    parsed.verify_signature(Some(issuer.public_key())).unwrap();
    assert_eq!(parsed.issuer().as_raw(), issuer.subject().as_raw());
    assert_eq!(
        parsed.subject().to_string(),
        "C=JP, ST=Nagano, L=Suwa, O=Example & Sons, CN=EpsonRC.SN0000123.192.168.010.001"
    );
    let usage = parsed.key_usage().unwrap().unwrap();
    assert!(usage.critical);
    assert_eq!(usage.value.flags, 0b1111);
    let extended = parsed.extended_key_usage().unwrap().unwrap().value;
    assert!(extended.server_auth && extended.client_auth && !extended.any);
    assert!(!parsed.basic_constraints().unwrap().expect("said explicitly").value.ca);
    let names = &parsed.subject_alternative_name().unwrap().unwrap().value.general_names;
    assert_eq!(names.len(), 4);
    assert_eq!(issued.application_uri().as_deref(), Some("urn:EpsonRC:SN0000123"));
    assert_eq!(key_ids(&parsed).1, key_ids(&issuer).0.expect("of the CA"));
    assert_eq!(parsed.raw_serial().len(), 16);
    assert_eq!(parsed.extensions().len(), 6);
}

/// Subject and authority key identifier.
fn key_ids<'a>(parsed: &'a X509Certificate<'_>) -> (Option<&'a [u8]>, &'a [u8]) {
    let (mut subject, mut authority) = (None, &[][..]);
    for extension in parsed.extensions() {
        match extension.parsed_extension() {
            ParsedExtension::SubjectKeyIdentifier(id) => subject = Some(id.0),
            ParsedExtension::AuthorityKeyIdentifier(id) => authority = id.key_identifier.as_ref().unwrap().0,
            _ => {}
        }
    }
    (subject, authority)
}

#[test]
fn a_client_certificate_is_for_clients_only_and_needs_no_host() {
    let client = IssueRequest { profile: CertificateProfile::Client, ..server() };
    let csr = foreign(named("SCADA"), vec![uri("urn:scada")], vec![]);
    let issued = root().issue(&csr, &client, now()).unwrap();
    let (_, parsed) = X509Certificate::from_der(issued.der()).unwrap();
    let extended = parsed.extended_key_usage().unwrap().unwrap().value;
    assert!(extended.client_auth && !extended.server_auth);
    assert_eq!(refusal(&csr), PkiError::NoHostName, "a server does");
}

#[test]
fn a_subject_is_taken_over_as_it_stands() {
    let subject = RdnSequence(vec![
        part("0.9.2342.19200300.100.1.25", Tag::Ia5String, "example"),
        part("0.9.2342.19200300.100.1.25", Tag::Ia5String, "plant"),
        part("2.5.4.3", Tag::PrintableString, "robot 7"),
        part("2.5.4.10", Tag::TeletexString, "Example"),
    ]);
    let key_id = SubjectKeyIdentifier(OctetString::new([7; 20]).unwrap());
    let ca = BasicConstraints { ca: true, path_len_constraint: None };
    let more = vec![encode::extension(&key_id).unwrap(), encode::extension(&ca).unwrap()];
    let csr = foreign(subject.clone(), vec![uri("urn:robot"), dns("robot-7")], more);
    let issued = root().issue(&csr, &server(), now()).unwrap();
    let (_, parsed) = X509Certificate::from_der(issued.der()).unwrap();
    assert_eq!(parsed.subject().as_raw(), subject.to_der().unwrap());
    assert_ne!(key_ids(&parsed).0, Some(&[7; 20][..]), "the key identifier is the CA's to compute");
    assert!(!parsed.is_ca(), "nobody becomes a CA by asking for it");
}

#[test]
fn names_can_be_given_where_a_request_has_none() {
    let bare = foreign(named("robot"), vec![], vec![]);
    assert_eq!(refusal(&bare), PkiError::CsrRefused("names no application URI"));
    let given = IssueRequest { names: Some(samples::names()), ..server() };
    let issued = root().issue(&bare, &given, now()).unwrap();
    assert_eq!(issued.application_uri().as_deref(), Some("urn:EpsonRC:SN0000123"));
    let bad = ServerNames { application_uri: "no uri".into(), ..samples::names() };
    let refused = root().issue(&bare, &IssueRequest { names: Some(bad), ..server() }, now());
    assert_eq!(refused, Err(PkiError::ApplicationUri("no uri".into())));
}

/// Case 02: keytool, and Microsoft's certreq with its newer and its older attribute.
#[test]
fn requests_of_other_tools_are_signed_with_the_names_they_ask_for() {
    for file in [
        &include_bytes!("../../../tests/cases/02-new-certificate-request/keytool.csr")[..],
        include_bytes!("../../../tests/cases/02-new-certificate-request/certreq-modern.csr"),
        include_bytes!("../../../tests/cases/02-new-certificate-request/certreq-old-oid.csr"),
    ] {
        let csr = Csr::from_any(file).unwrap();
        let issued = root().issue(&csr, &server(), now()).unwrap();
        let names: Vec<String> = issued.alternative_names().iter().map(ToString::to_string).collect();
        assert_eq!(names, ["URI:urn:scada:app", "DNS:scada", "IP:10.0.0.5"]);
        assert!(csr.matches(&issued));
    }
}

#[test]
fn what_does_not_belong_into_a_certificate_is_refused_with_its_reason() {
    let refused = |names: Vec<GeneralName>| refusal(&foreign(named("robot"), names, vec![]));
    assert_eq!(
        refused(vec![uri("urn:a"), uri("urn:b"), dns("robot")]),
        PkiError::CsrRefused("names several URIs; exactly one, the application URI, is expected")
    );
    assert_eq!(refused(vec![uri("no uri"), dns("robot")]), PkiError::ApplicationUri("no uri".into()));
    assert_eq!(refused(vec![uri("urn:a"), dns("*.example")]), PkiError::DnsName("*.example".into()));
    let mail = GeneralName::Rfc822Name(Ia5String::new("a@example").unwrap());
    assert_eq!(
        refused(vec![uri("urn:a"), dns("robot"), mail]),
        PkiError::CsrRefused("asks for a name that is no URI, host name or IP address")
    );
    let short = GeneralName::IpAddress(OctetString::new([10, 0, 0]).unwrap());
    assert_eq!(refused(vec![uri("urn:a"), short]), PkiError::CsrRefused("has an IP address of a wrong length"));

    let good = || vec![uri("urn:a"), dns("robot")];
    assert_eq!(refusal(&foreign(RdnSequence(vec![]), good(), vec![])), PkiError::CsrRefused("has no common name"));
    let (_, ca) = X509Certificate::from_der(root().certificate().der())
        .map(|(r, c)| (r.len(), c.subject().as_raw().to_vec()))
        .unwrap();
    let ca = x509_cert::der::Decode::from_der(&ca).unwrap();
    assert_eq!(refusal(&foreign(ca, good(), vec![])), PkiError::CsrRefused("asks for the name of the CA"));
}

#[test]
fn short_keys_are_signed_only_where_that_is_allowed() {
    let csr = csr_of(samples::legacy_key());
    assert_eq!(refusal(&csr), PkiError::ShortKey(1024));
    let issued = root().issue(&csr, &IssueRequest { allow_short_keys: true, ..server() }, now()).unwrap();
    assert_eq!(issued.key_bits(), 1024);
}

#[test]
fn path_lengths_leave_room_for_what_is_below_and_nothing_else() {
    let root = CertificateAuthority::root(&request("Plant root", 20), 1, copy(samples::other_key()), now()).unwrap();
    let own_key = PrivateKey::generate(KeyLength::Rsa2048).unwrap();
    let same_name = root.intermediate(&request("Plant root", 10), copy(&own_key), now());
    assert_eq!(same_name.err(), Some(PkiError::AuthorityName));
    let intermediate = root.intermediate(&request("Plant CA", 30), own_key, now()).unwrap();
    let path_length = |certificate: &Certificate| {
        let (_, parsed) = X509Certificate::from_der(certificate.der()).unwrap();
        let usage = parsed.key_usage().unwrap().unwrap();
        assert!(usage.critical);
        assert_eq!(usage.value.flags, 0b110_0000, "keyCertSign and cRLSign");
        let constraints = parsed.basic_constraints().unwrap().unwrap();
        assert!(constraints.critical && constraints.value.ca);
        constraints.value.path_len_constraint
    };
    assert_eq!((path_length(root.certificate()), path_length(intermediate.certificate())), (Some(1), Some(0)));
    assert_eq!(intermediate.certificate().not_after(), root.certificate().not_after(), "not beyond the root");
}

#[test]
fn nothing_is_valid_beyond_the_ca_and_an_expired_ca_signs_nothing() {
    let ca = CertificateAuthority::root(&request("Plant CA", 1), 0, copy(samples::other_key()), now()).unwrap();
    let csr = csr_of(samples::key());
    let issued = ca.issue(&csr, &server(), now()).unwrap();
    assert_eq!(issued.not_after(), ca.certificate().not_after());
    let at = |when: DateTime<Utc>| (ca.issue(&csr, &server(), when).err(), ca.crl(&[], 1, when, 30).err());
    let end = ca.certificate().not_after();
    assert_eq!(at(end), (None, None));
    let expired = Some(PkiError::AuthorityExpired(end));
    assert_eq!(at(end + Duration::seconds(1)), (expired.clone(), expired));
    let start = ca.certificate().not_before();
    assert_eq!(Problem::from(PkiError::AuthorityExpired(end)).code, ErrorCode::AuthorityExpired);
    let early = Some(PkiError::AuthorityNotYetValid(start));
    assert_eq!(at(start - Duration::seconds(1)), (early.clone(), early));
}

#[test]
fn a_ca_is_taken_up_again_and_nothing_else_is() {
    let ca = root();
    let again = CertificateAuthority::from_parts(ca.certificate().clone(), copy(samples::other_key())).unwrap();
    let issued = again.issue(&csr_of(samples::key()), &server(), now()).unwrap();
    assert_eq!(issued.summary().issued_by, "Plant CA");
    let refused = CertificateAuthority::from_parts(ca.certificate().clone(), copy(samples::key()));
    assert_eq!(refused.err(), Some(PkiError::NotAPair));
    let refused = CertificateAuthority::from_parts(samples::certificate().clone(), copy(samples::key()));
    assert!(matches!(refused, Err(PkiError::CannotSign(_))));
    let short = AuthorityRequest { key_length: KeyLength::Rsa1024, ..request("Plant CA", 1) };
    let refused = CertificateAuthority::root(&short, 0, copy(samples::legacy_key()), now());
    assert_eq!(refused.err(), Some(PkiError::AuthorityKey(1024)));
}

#[test]
fn dates_beyond_2049_are_written_as_rfc_5280_wants_them() {
    let late = now() + Duration::days(365 * 19);
    let ca = CertificateAuthority::root(&request("Plant CA", 5), 0, copy(samples::other_key()), late).unwrap();
    assert_eq!(ca.certificate().not_before(), late - Duration::days(1));
    let (_, parsed) = X509Certificate::from_der(ca.certificate().der()).unwrap();
    assert!(parsed.validity().not_before.is_utctime() && parsed.validity().not_after.is_generalizedtime());
}

#[test]
fn a_crl_says_who_signed_it_which_it_is_and_what_is_revoked_why() {
    let ca = root();
    let entry = |serial: &str, reason| RevokedCertificate { serial_number: serial.into(), at: now(), reason };
    let revoked: Vec<_> =
        REVOCATION_REASONS.into_iter().zip(0x41..).map(|(r, n)| entry(&format!("{n:x}"), r)).collect();
    let der = ca.crl(&revoked, 1_900_000_000, now(), 30).unwrap();
    let (rest, crl) = CertificateRevocationList::from_der(der.der()).unwrap();
    assert!(rest.is_empty());
    let (_, issuer) = X509Certificate::from_der(ca.certificate().der()).unwrap();
    crl.verify_signature(issuer.public_key()).unwrap();
    assert_eq!(crl.issuer().as_raw(), issuer.subject().as_raw());
    assert_eq!(crl.crl_number().unwrap().to_string(), "1900000000");
    assert_eq!(crl.last_update().timestamp(), (now() - Duration::hours(1)).timestamp());
    assert_eq!(crl.next_update().unwrap().timestamp(), (now() + Duration::days(30)).timestamp());
    let reasons: Vec<_> =
        crl.iter_revoked_certificates().map(|r| r.reason_code().map_or(0, |(_, code)| code.0)).collect();
    assert_eq!(reasons, [0, 1, 2, 3, 4, 5, 9]);

    let empty = ca.crl(&[], 1, now(), MAX_CRL_DAYS).unwrap();
    let (_, empty) = CertificateRevocationList::from_der(empty.der()).unwrap();
    assert_eq!(empty.iter_revoked_certificates().count(), 0);
}
