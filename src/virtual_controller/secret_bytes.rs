use std::fmt;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::de::{Deserialize, Deserializer, Error as _};
use serde::ser::{Serialize, Serializer};
use zeroize::Zeroizing;

/// Private key material: base64 in the store's file, never in `Debug`, wiped when dropped.
#[derive(Clone, PartialEq, Eq)]
pub struct SecretBytes(pub Zeroizing<Vec<u8>>);

impl fmt::Debug for SecretBytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("SecretBytes(…)")
    }
}

impl Serialize for SecretBytes {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let text = Zeroizing::new(STANDARD.encode(self.0.as_slice()));
        serializer.serialize_str(&text)
    }
}

impl<'de> Deserialize<'de> for SecretBytes {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = Zeroizing::new(String::deserialize(deserializer)?);
        // The error is made here, so that it cannot quote a byte of the input.
        // The error of the decoder quotes the text.
        let bytes = STANDARD.decode(text.as_bytes()).map_err(|_| D::Error::custom("a secret is not base64"))?;
        Ok(Self(Zeroizing::new(bytes)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_secret_survives_the_file_and_is_not_shown() {
        let secret = SecretBytes(Zeroizing::new(vec![1, 2, 3]));
        let json = serde_json::to_string(&secret).unwrap();
        assert_eq!(json, r#""AQID""#);
        assert_eq!(serde_json::from_str::<SecretBytes>(&json).unwrap(), secret);
        assert_eq!(format!("{secret:?}"), "SecretBytes(…)");
        let error = serde_json::from_str::<SecretBytes>(r#""not base64!""#).unwrap_err();
        assert!(!error.to_string().contains("not base64!"));
    }
}
