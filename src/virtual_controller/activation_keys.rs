use aws_lc_rs::hmac;

use crate::model::SerialNumber;
use crate::model::activation::{ActivationKey, ActivationKeys, LicenceKey};

/// The keys a virtual controller with this serial number accepts, and no others.
///
/// Each key is the HMAC-SHA256 of `licence:<serial>` or `activation:<serial>` under the key `opcua-configurator virtual
/// controller demo key`, the low five bits of each byte as one of `A`–`Z` and `2`–`9` without `I` and `O`. Every reader
/// of this can make them, on purpose: they are worth nothing to a real controller.
pub fn demo_keys(serial: &SerialNumber) -> ActivationKeys {
    let key = |what: &str, length: usize| -> String {
        let tag = hmac::sign(&hmac::Key::new(hmac::HMAC_SHA256, DEMO_KEY), format!("{what}:{serial}").as_bytes());
        let character = |byte: &u8| CHARACTERS.get(usize::from(byte % 32)).copied().map(char::from);
        tag.as_ref().iter().take(length).filter_map(character).collect()
    };
    ActivationKeys {
        licence: key("licence", LicenceKey::LENGTH).parse().expect("sixteen letters and digits"),
        activation: key("activation", ActivationKey::LENGTH).parse().expect("twenty-four letters and digits"),
    }
}

/// Not a secret.
const DEMO_KEY: &[u8] = b"opcua-configurator virtual controller demo key";
/// Letters and digits without those that look alike.
const CHARACTERS: &[u8; 32] = b"ABCDEFGHJKLMNPQRSTUVWXYZ23456789";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_belong_to_one_serial_number() {
        let keys = |serial: &str| demo_keys(&serial.parse().unwrap());
        assert_eq!(keys("R7A0000001"), keys("R7A0000001"));
        assert_ne!(keys("R7A0000001").licence, keys("R7A0000002").licence);
        assert_ne!(keys("R7A0000001").activation, keys("R7A0000002").activation);
    }

    /// The sample files in the fixtures and people's own sheets hold such keys.
    #[test]
    fn keys_stay_what_they_are() {
        let keys = demo_keys(&"R7A0010001".parse().unwrap());
        assert_eq!(keys.licence.to_string(), "7agk-vcl3-x2eh-lgzg");
        assert_eq!(keys.activation.to_string(), "HTMT-L6FB-WUZW-34CQ-GDMZ-RWUC");
    }
}
