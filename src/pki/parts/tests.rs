//! Cases 02, 05, 06, 08, 13 and 14, and their neighbours: what one reader understands, all do.

use std::path::Path;

use super::*;
use crate::pki::{
    Certificate, Csr, Description, PkiKind, Wanted, describe, pkcs12_read, read_bundle, read_key_file, read_pair,
    recognise, samples,
};

fn case(name: &str) -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases").join(name);
    std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn utf16(text: &str) -> Vec<u8> {
    [0xfeff].into_iter().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect()
}

fn contents(bytes: &[u8]) -> Vec<FileContent> {
    parts(bytes).unwrap().into_iter().map(|part| part.content).collect()
}

#[test]
fn requests_of_other_tools_are_read_with_the_names_they_ask_for() {
    for name in ["keytool.csr", "certreq-modern.csr", "certreq-old-oid.csr"] {
        let bytes = case(&format!("02-new-certificate-request/{name}"));
        let csr = Csr::from_any(&bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(Csr::from_any(&[csr.der(), b"\r\n"].concat()).as_ref(), Ok(&csr), "{name}");
        assert_eq!(recognise(&bytes), Some(PkiKind::Csr));
        let described = describe(&bytes, None).unwrap();
        let [Description::Csr(described)] = described.as_slice() else { panic!("{name}: {described:?}") };
        let names: Vec<String> = described.alternative_names.iter().map(ToString::to_string).collect();
        assert_eq!(names, ["URI:urn:scada:app", "DNS:scada", "IP:10.0.0.5"], "{name}");
    }
    // `certutil -encode` writes CERTIFICATE round anything.
    assert!(Csr::from_any(&case("06-wrong-or-no-pem-label/certutil-encode.csr")).is_ok());
}

#[test]
fn certificates_are_read_whatever_stands_around_them() {
    for (name, count) in [
        ("06-wrong-or-no-pem-label/bare-base64.cer", 1),
        ("06-wrong-or-no-pem-label/trusted-certificate.pem", 1),
        ("05-utf16/utf16le-bom.pem", 1),
        ("08-pfx/p7b-ber.p7b", 2),
        ("13-pem-readers/c-chain.pem", 2),
        ("13-pem-readers/c-p7.pem", 1),
        ("13-pem-readers/c-x509label.pem", 1),
        ("14-der-trailing/der-crlf-after.der", 1),
        ("14-der-trailing/der-lf-after.der", 1),
        ("14-der-trailing/der-nul-padded.der", 1),
    ] {
        let bytes = case(name);
        let bundle = read_bundle(&bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
        let objects = bundle.certificates.len() + bundle.crls.len();
        assert_eq!(describe(&bytes, None).unwrap().len(), objects, "{name}");
        if bundle.certificates.len() == 1 {
            assert_eq!(Certificate::from_any(&bytes).as_ref(), Ok(&bundle.certificates[0]), "{name}");
        } else {
            let several = Err(PkiError::SeveralCertificates(bundle.certificates.len()));
            assert_eq!(Certificate::from_any(&bytes), several, "{name}");
        }
        assert!(bundle.certificates.len() >= count.min(2), "{name}: {}", bundle.certificates.len());
    }
    let bundle = read_bundle(&case("06-wrong-or-no-pem-label/certutil-encode-crl.b64")).unwrap();
    assert_eq!((bundle.certificates.len(), bundle.crls.len()), (0, 1));
    // The signature is that of the certificate in DER.
    let chain = read_bundle(&case("08-pfx/p7b-ber.p7b")).unwrap().certificates;
    assert!(chain.iter().any(|issuer| chain[0].verify_signed_by(issuer)), "{chain:?}");
}

#[test]
fn a_key_and_its_certificate_are_found_beside_others() {
    let key = case("13-pem-readers/server.key");
    for name in ["c-chain.pem", "c-p7.pem", "c-x509label.pem"] {
        let certificate = case(&format!("13-pem-readers/{name}"));
        let (read, certificate) = read_pair(&certificate, &key, None).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(read.matches(&certificate), "{name}");
    }
    let reversed: Vec<u8> = {
        let text = String::from_utf8(case("13-pem-readers/c-chain.pem")).unwrap();
        let mut blocks: Vec<&str> = text.split_inclusive("-----END CERTIFICATE-----\n").collect();
        blocks.reverse();
        blocks.concat().into()
    };
    assert!(read_pair(&reversed, &key, None).is_ok(), "the order does not matter");
    assert!(read_key_file(&case("05-utf16/utf16.key"), Some("secret")).is_ok());
    let der = samples::key().to_pkcs8_der().unwrap();
    for bytes in [
        [&der[..], b"\n"].concat(),
        [&der[..], b"\0\0\0"].concat(),
        pem::armour("CERTIFICATE", &der).into_bytes(),
        utf16(&pem::armour("PRIVATE KEY", &der)),
        pem::armour("X", &der).lines().filter(|line| !line.starts_with('-')).collect::<Vec<_>>().join("\r\n").into(),
        (String::from("-----BEGIN EC PARAMETERS-----\nBggqhkjOPQMBBw==\n-----END EC PARAMETERS-----\n")
            + &pem::armour("PRIVATE KEY", &der))
            .into(),
    ] {
        assert_eq!(read_key_file(&bytes, None).unwrap().public_key(), samples::key().public_key());
        assert_eq!(recognise(&bytes), Some(PkiKind::Key));
        assert_eq!(read_bundle(&bytes), Err(PkiError::PrivateKeyInside));
        assert_eq!(describe(&bytes, None).unwrap().len(), 1);
    }
}

#[test]
fn a_pfx_is_read_in_every_armour() {
    let bytes = case("06-wrong-or-no-pem-label/certutil-encode.pfx");
    assert!(pkcs12_read(&bytes, "secret").is_ok());
    assert_eq!(recognise(&bytes), Some(PkiKind::Pkcs12));
    assert!(describe(&bytes, Some("secret")).unwrap().len() >= 2);
    assert_eq!(describe(&bytes, None), Err(PkiError::PasswordNeeded));
}

#[test]
fn what_is_something_else_is_named_with_the_command_that_converts_it() {
    let certificate = samples::certificate();
    let pfx = case("08-pfx/ber.pfx");
    let jks = case("08-pfx/store.jks");
    let html = case("06-wrong-or-no-pem-label/html-login-page.cer");
    let crl = case("06-wrong-or-no-pem-label/certutil-encode-crl.b64");
    let csr = case("02-new-certificate-request/keytool.csr");
    let other = |found, wanted| Some(PkiError::OtherContent { found, wanted });
    assert_eq!(read_bundle(&pfx).err(), other(FileContent::Pkcs12, Wanted::TrustMaterial));
    assert_eq!(read_bundle(&jks).err(), other(FileContent::JavaKeystore, Wanted::TrustMaterial));
    assert_eq!(read_bundle(&html).err(), other(FileContent::WebPage, Wanted::TrustMaterial));
    assert_eq!(read_bundle(&csr).err(), other(FileContent::Csr, Wanted::TrustMaterial));
    assert_eq!(Certificate::from_any(&crl).err(), other(FileContent::Crl, Wanted::Certificate));
    assert_eq!(Csr::from_any(certificate.der()).err(), other(FileContent::Certificate, Wanted::Csr));
    assert_eq!(Csr::from_any(&html).err(), other(FileContent::WebPage, Wanted::Csr));
    assert_eq!(read_key_file(&pfx, None).err(), other(FileContent::Pkcs12, Wanted::PrivateKey));
    assert_eq!(read_key_file(&jks, None).err(), other(FileContent::JavaKeystore, Wanted::PrivateKey));
    assert_eq!(describe(&jks, None).err(), other(FileContent::JavaKeystore, Wanted::TrustMaterial));
    for (error, part) in [
        (read_bundle(&pfx).unwrap_err().to_string(), "`openssl pkcs12 -in FILE -nokeys"),
        (read_key_file(&jks, None).unwrap_err().to_string(), "`keytool -importkeystore"),
        (read_bundle(&html).unwrap_err().to_string(), "it is a web page, not certificates and CRLs; download"),
        (pkcs12_read(certificate.der(), "").unwrap_err().to_string(), "`openssl pkcs12 -export"),
        (read_bundle(b"\xff\xfe\0\0").unwrap_err().to_string(), "UTF-32"),
        (read_bundle(b"\xff\xfea\0b").unwrap_err().to_string(), "damaged UTF-16"),
    ] {
        assert!(error.contains(part), "{error}");
    }
    for (bytes, found) in [
        (&b"PuTTY-User-Key-File-3: ssh-rsa\n"[..], FileContent::PuttyKey),
        (b"ssh-rsa AAAAB3NzaC1yc2EAAAADAQABAAABAQC7 robot", FileContent::SshPublicKey),
        (b"\xce\xce\xce\xce\0\0\0\x02", FileContent::JavaKeystore),
        (b"\n<html lang=\"de\">", FileContent::WebPage),
        (b"PK\x03\x04\x14", FileContent::ZipArchive),
        (b"hello, robot", FileContent::Unknown),
        (b"\0\0\0\n", FileContent::Unknown),
        (b"-----BEGIN PRIVATE KEY-----\nAAAA\n-----END PRIVATE KEY-----\n", FileContent::PrivateKey),
    ] {
        assert_eq!(contents(bytes), [found], "{bytes:?}");
    }
}

#[test]
fn padding_is_passed_over_and_anything_else_is_counted() {
    let der = samples::certificate().der();
    for padding in ["", "\n", "\r\n", "\0", "\0\0\0\0", "\r\n\0\n"] {
        assert_eq!(contents(&[der, padding.as_bytes()].concat()), [FileContent::Certificate], "{padding:?}");
    }
    for (rest, bytes) in [("x", 1), ("\nx", 2), ("hello", 5), (" ", 1)] {
        let read = Certificate::from_any(&[der, rest.as_bytes()].concat());
        assert_eq!(read, Err(PkiError::TrailingBytes(bytes)), "{rest:?}");
        let read = read_bundle(&[der, rest.as_bytes()].concat());
        assert_eq!(read, Err(PkiError::TrailingBytes(bytes)), "{rest:?}");
    }
    assert_eq!(contents(&[der, der].concat()), [FileContent::Certificate, FileContent::Certificate]);
    // The last byte of a signature may be one of those.
    assert_eq!(contents(&[der, der, b"\n"].concat()).len(), 2);
}
