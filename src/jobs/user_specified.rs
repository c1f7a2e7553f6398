use std::path::{Path, PathBuf};

use async_trait::async_trait;
use secrecy::{ExposeSecret as _, SecretString};

use super::self_signed::transfer_password;
use super::{
    CertificateChecked, CertificateImported, Confirmation, JobController, JobStep, Operation, OperationRun,
    ServerEffect, preflight,
};
use crate::model::{CertificateType, ErrorCode, Feature, Problem, SerialNumber};
use crate::pki::{
    Certificate, MAX_CERTIFICATE_FILE_BYTES, MAX_KEY_FILE_BYTES, MAX_PKCS12_BYTES, PkiError, PrivateKey, pkcs12_read,
    pkcs12_write, read_bundle, read_key_file,
};
use crate::session::SealedKey;
use crate::workspace::{CertificateFiles, read_import_file};

/// The files of a certificate made with another tool (manual 2.7.1.4).
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum UserSpecifiedFiles {
    /// A PKCS#12 with key and certificate.
    Pfx(PathBuf),
    /// Certificate and key in two files.
    Pair {
        /// The certificate, with or without its chain; PEM or DER.
        certificate: PathBuf,
        /// The private key; PEM or DER.
        key: PathBuf,
    },
    /// The only `.pfx` in a controller's folder, found when it is read.
    PfxIn(CertificateFiles, SerialNumber),
    /// The only pair in a controller's folder, found when it is read.
    PairIn(CertificateFiles, SerialNumber),
}

impl UserSpecifiedFiles {
    /// The only `.pfx` in a controller's `UserSpecified` folder.
    pub fn pfx_in(files: &CertificateFiles, serial: &SerialNumber) -> Result<Self, Problem> {
        Ok(Self::Pfx(files.find_user_pfx(serial)?))
    }

    /// The only `.der` and the only `.key` in a controller's `UserSpecified` folder.
    pub fn pair_in(files: &CertificateFiles, serial: &SerialNumber) -> Result<Self, Problem> {
        let (certificate, key) = files.find_user_pair(serial)?;
        Ok(Self::Pair { certificate, key })
    }

    /// Reads them, and checks that key and certificate belong together. Blocks while the password is hashed.
    ///
    /// The password is that of the PKCS#12 or of the key; a key that is not encrypted needs none.
    pub fn read(&self, password: Option<&SecretString>) -> Result<(PrivateKey, Certificate), Problem> {
        let given = password;
        let password = password.map(|password| password.expose_secret());
        match self {
            Self::PfxIn(files, serial) => Self::pfx_in(files, serial)?.read(given),
            Self::PairIn(files, serial) => Self::pair_in(files, serial)?.read(given),
            Self::Pfx(path) => {
                let bytes = read_import_file(path, MAX_PKCS12_BYTES)?;
                let (key, chain) = pkcs12_read(&bytes, password.unwrap_or_default()).map_err(|e| at(path, e))?;
                let certificate = chain.into_iter().next().ok_or_else(|| at(path, PkiError::NoCertificate))?;
                Ok((key, certificate))
            }
            Self::Pair { certificate, key } => {
                let certificate_bytes = read_import_file(certificate, MAX_CERTIFICATE_FILE_BYTES)?;
                let key_bytes = zeroize::Zeroizing::new(read_import_file(key, MAX_KEY_FILE_BYTES)?);
                // The CA's chain may stand beside the certificate.
                let certificates = read_bundle(&certificate_bytes)
                    .map_err(|e| Problem { code: ErrorCode::FileFormat, ..at(certificate, e) })?
                    .certificates;
                let private_key = read_key_file(&key_bytes, password).map_err(|e| at(key, e))?;
                let certificate = private_key.certificate_among(certificates)?;
                Ok((private_key, certificate))
            }
        }
    }
}

fn at(path: &Path, error: PkiError) -> Problem {
    let Problem { code, .. } = error.clone().into();
    Problem::with_detail(code, format!("{}: {error}", path.display()))
}

/// Imports key and certificate made with another tool, and selects them (manual 2.7.1.4). Legacy firmware only, one
/// controller at a time.
///
/// Refused before anything is sent: a wrong password, files that are not what they should be, a key that is not that
/// of the certificate, an expired certificate, a key length the policies do not allow, and a certificate that clients
/// would refuse ([`ErrorCode::Preflight`]).
#[derive(Debug, Clone)]
pub struct ImportUserSpecified {
    /// The files to be imported.
    pub files: UserSpecifiedFiles,
    /// Password of the file or of the key; `None` where it has none.
    pub password: Option<SecretString>,
    /// Import although some clients may complain. Otherwise that is [`ErrorCode::PreflightWarnings`].
    pub accept_warnings: bool,
}

#[async_trait]
impl Operation for ImportUserSpecified {
    type Output = CertificateImported;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation { server: ServerEffect::Restarts, replaces_certificate: true, ..Confirmation::default() })
    }

    fn check(&self, controller: &JobController) -> Result<(), Problem> {
        controller.capabilities().require(Feature::UserSpecifiedCertificate)
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<CertificateImported, Problem> {
        run.begin(JobStep::Read)?;
        let (files, password) = (self.files.clone(), self.password.clone());
        let (key, certificate) = run.on_a_core(move || files.read(password.as_ref())).await??;
        let info = run.session.info().await?;
        run.require(Feature::UserSpecifiedCertificate).await?;
        let findings = preflight::admit(run, &info, &certificate, self.accept_warnings).await?;
        let (password, alias, summary) = (transfer_password()?, info.serial.to_string(), certificate.summary());
        let (pkcs12, password) = run
            .on_a_core(move || {
                pkcs12_write(&alias, &key, &[&certificate], password.expose_secret()).map(|pfx| (pfx, password))
            })
            .await??;
        run.begin(JobStep::Apply)?;
        let key = SealedKey { pkcs12, password };
        run.session.import_certificate(info.revision, CertificateType::UserSpecified, key).await?;
        Ok(CertificateImported { summary, findings, moved_aside: Vec::new() })
    }
}

/// Looks at key and certificate as [`ImportUserSpecified`] would, and changes nothing.
#[derive(Debug, Clone)]
pub struct CheckUserSpecified {
    /// The files to be looked at.
    pub files: UserSpecifiedFiles,
    /// Password of the file or of the key; `None` where it has none.
    pub password: Option<SecretString>,
}

#[async_trait]
impl Operation for CheckUserSpecified {
    type Output = CertificateChecked;

    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<CertificateChecked, Problem> {
        run.begin(JobStep::Read)?;
        let (files, password) = (self.files.clone(), self.password.clone());
        let (_, certificate) = run.on_a_core(move || files.read(password.as_ref())).await??;
        let info = run.session.info().await?;
        let findings = preflight::examine(run, &info, &certificate).await?;
        Ok(CertificateChecked { summary: Some(certificate.summary()), findings, issuers: None })
    }
}
