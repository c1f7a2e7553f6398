//! The names of what files hold, and how one thing is made of another.

use std::fmt;

/// What a file, or one object of it, is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FileContent {
    /// An X.509 certificate.
    Certificate,
    /// A revocation list.
    Crl,
    /// A signing request (PKCS#10).
    Csr,
    /// With certificates and revocation lists, or with something else.
    Pkcs7,
    /// A PKCS#12 (`.pfx`, `.p12`).
    Pkcs12,
    /// PKCS#8, PKCS#1 or SEC 1, not encrypted, of any algorithm.
    PrivateKey,
    /// PKCS#8 under a password.
    EncryptedKey,
    /// PEM with `DEK-Info`, encrypted outside of the DER.
    TraditionalKey,
    /// A private key in OpenSSH's own form.
    OpenSshKey,
    /// A private key in PuTTY's own form.
    PuttyKey,
    /// Microsoft's PVK.
    PvkKey,
    /// A public key.
    PublicKey,
    /// A public key in SSH's own form.
    SshPublicKey,
    /// JKS or JCEKS.
    JavaKeystore,
    /// HTML, as a web server sends instead of a file that is missing.
    WebPage,
    /// A ZIP archive.
    ZipArchive,
    /// A block of PEM under this label, which nothing here reads.
    Block(String),
    /// None of these.
    Unknown,
}

/// What a reader was asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wanted {
    /// One certificate.
    Certificate,
    /// Certificates and revocation lists.
    TrustMaterial,
    /// A signing request.
    Csr,
    /// A private key.
    PrivateKey,
    /// A PKCS#12.
    Pkcs12,
}

impl FileContent {
    pub(super) const fn is_private_key(&self) -> bool {
        matches!(
            self,
            Self::PrivateKey
                | Self::EncryptedKey
                | Self::TraditionalKey
                | Self::OpenSshKey
                | Self::PuttyKey
                | Self::PvkKey
        )
    }

    /// Whether its standard allows BER.
    pub(super) const fn may_be_ber(&self) -> bool {
        matches!(self, Self::Pkcs7 | Self::Pkcs12)
    }

    /// By the label of a PEM block whose content is damaged or not known (RFC 7468 §4, and the older names of OpenSSL,
    /// Netscape and Microsoft).
    pub(super) fn labelled(label: &str) -> Self {
        match label {
            "CERTIFICATE" | "X509 CERTIFICATE" | "TRUSTED CERTIFICATE" => Self::Certificate,
            "CERTIFICATE REQUEST" | "NEW CERTIFICATE REQUEST" => Self::Csr,
            "X509 CRL" | "CRL" => Self::Crl,
            "PKCS7" | "PKCS #7 SIGNED DATA" | "CMS" | "CERTIFICATE CHAIN" => Self::Pkcs7,
            "PKCS12" => Self::Pkcs12,
            "PUBLIC KEY" => Self::PublicKey,
            "OPENSSH PRIVATE KEY" => Self::OpenSshKey,
            label if label.ends_with("PRIVATE KEY") => Self::PrivateKey,
            label => Self::Block(super::name::printable(label)),
        }
    }

    /// By the first bytes of a file that is neither PEM nor ASN.1.
    pub(super) fn foreign(bytes: &[u8]) -> Option<Self> {
        const MARKS: &[(&[u8], FileContent)] = &[
            (b"\xfe\xed\xfe\xed", FileContent::JavaKeystore),
            (b"\xce\xce\xce\xce", FileContent::JavaKeystore),
            (b"\x1e\xf1\xb5\xb0", FileContent::PvkKey),
            (b"PuTTY-User-Key-File-", FileContent::PuttyKey),
            (b"PK\x03\x04", FileContent::ZipArchive),
            (b"ssh-", FileContent::SshPublicKey),
            (b"ecdsa-sha2-", FileContent::SshPublicKey),
            (b"---- BEGIN SSH2 PUBLIC KEY", FileContent::SshPublicKey),
        ];
        if let Some((_, content)) = MARKS.iter().find(|(mark, _)| bytes.starts_with(mark)) {
            return Some(content.clone());
        }
        let text = bytes.trim_ascii_start();
        let starts = |word: &[u8]| text.len() >= word.len() && text[..word.len()].eq_ignore_ascii_case(word);
        (starts(b"<!doctype html") || starts(b"<html") || starts(b"<head")).then_some(Self::WebPage)
    }

    /// The command, or the step, that makes what was wanted of it; `FILE` stands for the file.
    pub(super) const fn remedy(&self, wanted: Wanted) -> Option<&'static str> {
        use Wanted::{Certificate, Csr, PrivateKey, TrustMaterial};
        Some(match (self, wanted) {
            (Self::WebPage, _) => "download the file again, after signing in",
            (Self::ZipArchive, _) => "unpack it first",
            (Self::JavaKeystore, Wanted::Pkcs12 | PrivateKey) => {
                "convert it with `keytool -importkeystore -srckeystore FILE -destkeystore new.pfx -deststoretype PKCS12`"
            }
            (Self::JavaKeystore, _) => {
                "take the certificate out with `keytool -exportcert -rfc -keystore FILE -alias NAME -file new.pem`; \
                 `keytool -importkeystore -srckeystore FILE -destkeystore new.pfx -deststoretype PKCS12` converts it whole"
            }
            (Self::Pkcs12, Certificate | TrustMaterial) => {
                "take the certificates out with `openssl pkcs12 -in FILE -nokeys -out new.pem`"
            }
            (Self::Pkcs12, PrivateKey) => {
                "import it as a PFX, or take the key out with `openssl pkcs12 -in FILE -nocerts -out new.key`"
            }
            (Self::Pkcs12, Csr) => "make a request with `openssl req -new -key KEY -out new.csr`",
            (Self::Certificate | Self::PrivateKey | Self::EncryptedKey, Wanted::Pkcs12) => {
                "make one of the certificate and its key with `openssl pkcs12 -export -in CERTIFICATE -inkey KEY -out new.pfx`"
            }
            (Self::Csr, Certificate | TrustMaterial) => "send it to the CA, and take what the CA issues for it",
            (Self::Pkcs7, Wanted::Pkcs12 | PrivateKey) => "there are no keys in such a file; export the key as a PFX",
            (Self::OpenSshKey, PrivateKey) => "convert a copy of it with `ssh-keygen -p -m PKCS8 -f FILE`",
            (Self::PuttyKey, PrivateKey) => "convert it with `puttygen FILE -O private-openssh -o new.key`",
            (Self::PvkKey, PrivateKey) => "convert it with `openssl rsa -inform PVK -in FILE -out new.key`",
            (Self::TraditionalKey, PrivateKey) => "convert it with `openssl pkcs8 -topk8 -in FILE -out new.key`",
            _ => return None,
        })
    }
}

impl fmt::Display for FileContent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Certificate => "a certificate",
            Self::Crl => "a certificate revocation list (CRL)",
            Self::Csr => "a certificate signing request (CSR)",
            Self::Pkcs7 => "a PKCS#7 (P7B)",
            Self::Pkcs12 => "a PKCS#12 (PFX)",
            Self::PrivateKey => "a private key",
            Self::EncryptedKey => "an encrypted private key",
            Self::TraditionalKey => "a private key that is encrypted in the old PEM way (\"DEK-Info\")",
            Self::OpenSshKey => "a private key in OpenSSH's own format",
            Self::PuttyKey => "a private key in PuTTY's format (PPK)",
            Self::PvkKey => "a private key in Microsoft's PVK format",
            Self::PublicKey => "a public key",
            Self::SshPublicKey => "a public key of SSH",
            Self::JavaKeystore => "a Java keystore (JKS or JCEKS)",
            Self::WebPage => "a web page",
            Self::ZipArchive => "a ZIP archive",
            Self::Block(label) => return write!(f, "a PEM block \"{label}\""),
            Self::Unknown => "of no known kind",
        })
    }
}

impl fmt::Display for Wanted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Certificate => "a certificate",
            Self::TrustMaterial => "certificates and CRLs",
            Self::Csr => "a certificate signing request",
            Self::PrivateKey => "a private key",
            Self::Pkcs12 => "a PKCS#12 (PFX)",
        })
    }
}
