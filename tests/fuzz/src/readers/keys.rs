use opcua_configurator::model::KeyLength;
use opcua_configurator::pki::{PrivateKey, pkcs12_read, pkcs12_read_key, read_key_file, read_pair};

use super::{PASSWORD, certificates::assert_certificate};

/// [`read_key_file`]: a key that is taken is one that can be used.
pub fn private_key(bytes: &[u8]) {
    let without = read_key_file(bytes, None);
    let with = read_key_file(bytes, Some(PASSWORD));
    if let Ok(key) = &without {
        assert_key(key);
        assert!(with.is_ok(), "a password that is not needed does not matter");
    } else if let Ok(key) = &with {
        assert_key(key);
    }
}

/// [`read_pair`]; two bytes say how long the key file is, which comes before the certificate.
pub fn key_and_certificate(bytes: &[u8]) {
    let [high, low, files @ ..] = bytes else { return };
    let Some((key, certificate)) = files.split_at_checked(usize::from(u16::from_be_bytes([*high, *low]))) else {
        return;
    };
    if let Ok((key, certificate)) = read_pair(certificate, key, Some(PASSWORD)) {
        assert!(key.matches(&certificate));
        assert_key(&key);
        assert_certificate(&certificate);
    }
}

/// [`pkcs12_read`] and [`pkcs12_read_key`].
pub fn pkcs12(bytes: &[u8]) {
    match (pkcs12_read(bytes, PASSWORD), pkcs12_read_key(bytes, PASSWORD)) {
        (Ok((key, certificates)), Ok(alone)) => {
            assert!(key.matches(&certificates[0]) && alone.matches(&certificates[0]));
            assert_key(&key);
            certificates.iter().for_each(assert_certificate);
        }
        (Ok(_), Err(error)) => panic!("the key alone: {error}"),
        (Err(_), Ok(key)) => assert_key(&key),
        (Err(_), Err(_)) => {}
    }
}

fn assert_key(key: &PrivateKey) {
    assert!(KeyLength::ALL.iter().any(|length| length.bits() == key.bits()));
    let der = key.to_pkcs8_der().expect("it can be written");
    let again = PrivateKey::from_pkcs8_der(&der).expect("and read");
    assert_eq!(*again.to_pkcs8_der().expect("twice"), *der);
}
