//! What a password encrypts, in private keys and in PKCS#12: PBES2 (RFC 8018 §6.2), and the 3DES and RC2 of PKCS#12
//! (RFC 7292 appendices B and C).

use aws_lc_rs::digest;
use cbc::cipher::block_padding::Pkcs7;
use cbc::cipher::{BlockCipherDecrypt, BlockModeDecrypt as _, KeyInit, KeyIvInit as _};
use pkcs5::der::Decode as _;
use pkcs5::pbes2::{self, Kdf};
use x509_parser::asn1_rs::Oid;
use zeroize::Zeroizing;

use super::tlv;

/// The most a password is hashed for one thing.
pub(super) const MAX_ITERATIONS: u32 = 1_000_000;

/// Why nothing was decrypted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum DecryptError {
    /// The name of the algorithm, or its object identifier.
    Unsupported(String),
    /// More than [`MAX_ITERATIONS`], or more than a gibibyte of scrypt.
    TooExpensive,
    /// The password is wrong, or the data is damaged.
    Failed,
}

/// A password in the forms that the algorithms take.
pub(super) struct EncodedPassword<'a> {
    text: &'a str,
    /// In big-endian UTF-16 with two zero bytes at the end (RFC 7292 B.1). No password at all is the empty string.
    utf16: Zeroizing<Vec<u8>>,
}

impl<'a> EncodedPassword<'a> {
    /// One, or two for an empty password: RFC 7292 B.1 leaves open whether that is two zero bytes or nothing, and both are
    /// written.
    pub fn forms(text: &'a str) -> Vec<Self> {
        let mut utf16 = Zeroizing::new(Vec::with_capacity(2 * text.len() + 2));
        utf16.extend(text.encode_utf16().chain([0]).flat_map(u16::to_be_bytes));
        let null = text.is_empty().then(|| Self { text, utf16: Zeroizing::default() });
        std::iter::once(Self { text, utf16 }).chain(null).collect()
    }

    pub fn utf8(&self) -> &'a [u8] {
        self.text.as_bytes()
    }

    /// The key derivation of PKCS#12 (RFC 7292 B.2). `purpose` is 1 for a key, 2 for an initial vector, 3 for a MAC.
    pub fn derive(
        &self,
        hash: &'static digest::Algorithm,
        purpose: u8,
        salt: &[u8],
        iterations: u32,
        length: usize,
    ) -> Zeroizing<Vec<u8>> {
        let block = hash.block_len;
        let filled =
            |text: &[u8]| text.iter().copied().cycle().take(text.len().div_ceil(block) * block).collect::<Vec<u8>>();
        let mut input = Zeroizing::new(filled(salt));
        input.extend_from_slice(&Zeroizing::new(filled(&self.utf16)));
        let mut derived = Zeroizing::new(Vec::with_capacity(length + hash.output_len));
        loop {
            let mut context = digest::Context::new(hash);
            context.update(&vec![purpose; block]);
            context.update(&input);
            let mut round = context.finish();
            for _ in 1..iterations {
                round = digest::digest(hash, round.as_ref());
            }
            derived.extend_from_slice(round.as_ref());
            if derived.len() >= length {
                derived.truncate(length);
                return derived;
            }
            // Each block of the input, as a number, grows by the repeated result and one.
            let repeated: Vec<u8> = round.as_ref().iter().copied().cycle().take(block).collect();
            for number in input.chunks_exact_mut(block) {
                let mut carry = 1_u16;
                for (digit, added) in number.iter_mut().zip(&repeated).rev() {
                    carry += u16::from(*digit) + u16::from(*added);
                    *digit = carry as u8;
                    carry >>= 8;
                }
            }
        }
    }
}

/// Decrypts `data` as the AlgorithmIdentifier `algorithm` says.
pub(super) fn decrypt(
    algorithm: &[u8],
    data: &[u8],
    password: &EncodedPassword<'_>,
) -> Result<Zeroizing<Vec<u8>>, DecryptError> {
    let parts = tlv::sole(algorithm).and_then(|whole| tlv::all(whole.content)).ok_or(DecryptError::Failed)?;
    let (identifier, parameters) = match parts.as_slice() {
        [identifier, parameters] => (identifier.content, parameters.content),
        [identifier] => (identifier.content, &[][..]),
        _ => return Err(DecryptError::Failed),
    };
    match identifier {
        PBES2 => pbes2(parameters, data, password),
        [scheme @ .., number @ 3..=6] if *scheme == *PKCS12_PBE => pkcs12_pbe(*number, parameters, data, password),
        other => Err(DecryptError::Unsupported(algorithm_name(other))),
    }
}

fn pbes2(parameters: &[u8], data: &[u8], password: &EncodedPassword<'_>) -> Result<Zeroizing<Vec<u8>>, DecryptError> {
    let whole = tlv::write(tlv::SEQUENCE, &[parameters]);
    let Ok(parameters) = pbes2::Parameters::from_der(&whole) else {
        return Err(unknown_in_pbes2(parameters).map_or(DecryptError::Failed, DecryptError::Unsupported));
    };
    let is_bounded = match &parameters.kdf {
        Kdf::Pbkdf2(kdf) => kdf.iteration_count <= MAX_ITERATIONS,
        Kdf::Scrypt(kdf) => {
            let memory = kdf.cost_parameter.checked_mul(u64::from(kdf.block_size)).and_then(|n| n.checked_mul(128));
            memory.is_some_and(|bytes| bytes <= MAX_SCRYPT_BYTES) && kdf.parallelization <= MAX_SCRYPT_THREADS
        }
        _ => false,
    };
    if !is_bounded {
        return Err(DecryptError::TooExpensive);
    }
    parameters.decrypt(password.utf8(), data).map(Zeroizing::new).map_err(|error| match error {
        pkcs5::Error::UnsupportedAlgorithm { oid } => DecryptError::Unsupported(algorithm_name(oid.as_bytes())),
        _ => DecryptError::Failed,
    })
}

/// The algorithm that keeps the parameters from being understood: the derivation, its hash, or the encryption.
fn unknown_in_pbes2(parameters: &[u8]) -> Option<String> {
    let algorithm = |element: &tlv::Tlv<'_>| Some(tlv::first(element.content)?.0.content.to_vec());
    let parts = tlv::all(parameters)?;
    let [derivation, encryption] = parts.as_slice() else { return None };
    let (derivation_name, encryption_name) = (algorithm(derivation)?, algorithm(encryption)?);
    if derivation_name != PBKDF2 && derivation_name != SCRYPT {
        return Some(algorithm_name(&derivation_name));
    }
    if !KNOWN_CIPHERS.contains(&encryption_name.as_slice()) {
        return Some(algorithm_name(&encryption_name));
    }
    // The hash of PBKDF2 stands last of its parameters.
    let (_, of_kdf) = tlv::first(derivation.content)?;
    let hash = tlv::all(tlv::first(of_kdf)?.0.content)?.last().copied().filter(|last| last.tag == tlv::SEQUENCE)?;
    algorithm(&hash).map(|name| algorithm_name(&name))
}

fn pkcs12_pbe(
    number: u8,
    parameters: &[u8],
    data: &[u8],
    password: &EncodedPassword<'_>,
) -> Result<Zeroizing<Vec<u8>>, DecryptError> {
    let parts = tlv::all(parameters).ok_or(DecryptError::Failed)?;
    let [salt, iterations] = parts.as_slice() else { return Err(DecryptError::Failed) };
    let iterations = iterations_of(iterations.content)?;
    let derive =
        |purpose, length| password.derive(&digest::SHA1_FOR_LEGACY_USE_ONLY, purpose, salt.content, iterations, length);
    let vector = derive(INITIAL_VECTOR, 8);
    match number {
        3 => cbc::<des::TdesEde3>(&derive(KEY, 24), &vector, data),
        4 => cbc::<des::TdesEde2>(&derive(KEY, 16), &vector, data),
        5 => cbc::<rc2::Rc2>(&derive(KEY, 16), &vector, data),
        _ => cbc::<rc2::Rc2>(&derive(KEY, 5), &vector, data),
    }
}

fn cbc<C: KeyInit + BlockCipherDecrypt>(
    key: &[u8],
    vector: &[u8],
    data: &[u8],
) -> Result<Zeroizing<Vec<u8>>, DecryptError> {
    // Both errors are without content.
    let cipher = cbc::Decryptor::<C>::new_from_slices(key, vector).map_err(|_| DecryptError::Failed)?;
    cipher.decrypt_padded_vec::<Pkcs7>(data).map(Zeroizing::new).map_err(|_| DecryptError::Failed)
}

/// A number of iterations, from an INTEGER.
pub(super) fn iterations_of(integer: &[u8]) -> Result<u32, DecryptError> {
    let digits = integer.strip_prefix(&[0]).unwrap_or(integer);
    if integer.is_empty() || digits.len() == integer.len() && integer[0] >= 0x80 {
        return Err(DecryptError::Failed);
    }
    let number =
        digits.iter().fold(0_u32, |number, digit| number.saturating_mul(256).saturating_add(u32::from(*digit)));
    match number {
        0 => Err(DecryptError::Failed),
        1..=MAX_ITERATIONS => Ok(number),
        _ => Err(DecryptError::TooExpensive),
    }
}

/// The usual name, or the object identifier.
pub(super) fn algorithm_name(identifier: &[u8]) -> String {
    let oid = Oid::new(identifier.into()).to_id_string();
    match oid.as_str() {
        "1.2.840.113549.3.2" => "RC2 in PBES2",
        "1.2.840.113549.3.4" => "RC4",
        "1.2.840.113549.1.5.1" | "1.2.840.113549.1.5.3" => "DES with MD2 or MD5 (PKCS#5 v1.5)",
        "1.2.840.113549.1.5.4" | "1.2.840.113549.1.5.6" | "1.2.840.113549.1.5.11" => "RC2 of PKCS#5 v1.5",
        "1.2.840.113549.1.5.10" => "DES with SHA-1 (PKCS#5 v1.5)",
        "1.2.840.113549.1.12.1.1" | "1.2.840.113549.1.12.1.2" => "RC4 of PKCS#12",
        "1.2.840.113549.2.5" => "MD5",
        "1.2.643.7.1.1.2.2" | "1.2.643.7.1.1.2.3" => "GOST R 34.11",
        "1.2.392.200011.61.1.1.1.2" | "1.2.392.200011.61.1.1.1.3" | "1.2.392.200011.61.1.1.1.4" => "Camellia",
        "2.16.840.1.101.3.4.2.5" | "2.16.840.1.101.3.4.2.6" => "truncated SHA-512",
        _ => return oid,
    }
    .to_owned()
}

pub(super) const KEY: u8 = 1;
pub(super) const INITIAL_VECTOR: u8 = 2;
pub(super) const MAC: u8 = 3;
const MAX_SCRYPT_BYTES: u64 = 1 << 30;
const MAX_SCRYPT_THREADS: u16 = 16;
/// 1.2.840.113549.1.5.13
const PBES2: &[u8] = &[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 5, 13];
/// 1.2.840.113549.1.5.12
pub(super) const PBKDF2: &[u8] = &[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 5, 12];
/// 1.3.6.1.4.1.11591.4.11
const SCRYPT: &[u8] = &[0x2b, 6, 1, 4, 1, 0xda, 0x47, 4, 11];
/// 1.2.840.113549.1.12.1, under which the encryptions of PKCS#12 itself stand.
const PKCS12_PBE: &[u8] = &[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 12, 1];
/// AES-128, AES-192, AES-256, 3DES and DES, all in CBC.
const KNOWN_CIPHERS: [&[u8]; 5] = [
    &[0x60, 0x86, 0x48, 1, 0x65, 3, 4, 1, 2],
    &[0x60, 0x86, 0x48, 1, 0x65, 3, 4, 1, 22],
    &[0x60, 0x86, 0x48, 1, 0x65, 3, 4, 1, 42],
    &[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 3, 7],
    &[0x2b, 14, 3, 2, 7],
];

#[cfg(test)]
mod tests {
    use super::*;

    /// RFC 7292 gives no values; these are those of Bouncy Castle's and OpenSSL's tests.
    #[test]
    fn keys_are_derived_as_other_implementations_do() {
        let salt = hex::decode("0a58cf64530d823f").unwrap();
        let smeg = &EncodedPassword::forms("smeg")[0];
        let key = smeg.derive(&digest::SHA1_FOR_LEGACY_USE_ONLY, KEY, &salt, 1, 24);
        assert_eq!(hex::encode(&*key), "8aaae6297b6cb04642ab5b077851284eb7128f1a2a7fbca3");
        let vector = smeg.derive(&digest::SHA1_FOR_LEGACY_USE_ONLY, INITIAL_VECTOR, &salt, 1, 8);
        assert_eq!(hex::encode(&*vector), "79993dfe048d3b76");
        let salt = hex::decode("05dec959acff72f7").unwrap();
        let queeg = &EncodedPassword::forms("queeg")[0];
        let key = queeg.derive(&digest::SHA1_FOR_LEGACY_USE_ONLY, KEY, &salt, 1000, 24);
        assert_eq!(hex::encode(&*key), "ed2034e36328830ff09df1e1a07dd357185dac0d4f9eb3d4");
        let mac =
            queeg.derive(&digest::SHA1_FOR_LEGACY_USE_ONLY, MAC, &hex::decode("263216fcc2fab31c").unwrap(), 1000, 20);
        assert_eq!(hex::encode(&*mac), "5ec4c7a80df652294c3925b6489a7ab857c83476");
    }

    #[test]
    fn a_password_is_written_as_utf_16_whatever_its_characters() {
        assert_eq!(*EncodedPassword::forms("é🤖")[0].utf16, [0, 0xe9, 0xd8, 0x3e, 0xdd, 0x16, 0, 0]);
        let empty = EncodedPassword::forms("");
        assert_eq!((empty.len(), empty[0].utf16.as_slice(), empty[1].utf16.as_slice()), (2, &[0, 0][..], &[][..]));
    }

    #[test]
    fn iterations_are_bounded() {
        for (integer, expected) in [
            (&[1][..], Ok(1)),
            (&[0x0f, 0x42, 0x40], Ok(MAX_ITERATIONS)),
            (&[0, 0x80], Ok(128)),
            (&[0x0f, 0x42, 0x41], Err(DecryptError::TooExpensive)),
            (&[0x7f; 9], Err(DecryptError::TooExpensive)),
            (&[0], Err(DecryptError::Failed)),
            (&[0xff], Err(DecryptError::Failed)),
            (&[], Err(DecryptError::Failed)),
        ] {
            assert_eq!(iterations_of(integer), expected, "{integer:?}");
        }
    }
}
