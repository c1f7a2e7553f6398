use std::net::IpAddr;

use async_trait::async_trait;
use secrecy::SecretString;

use super::{
    Confirmation, JobController, JobStep, Operation, OperationOutput, OperationRun, OutputFacts, ServerEffect,
};
use crate::model::{
    CertificateSummary, CertificateType, ControllerInfo, ErrorCode, Feature, KeyLength, Problem, SelfSignedRequest,
    Subject, Validity, clock,
};
use crate::pki::{self, Certificate, PrivateKey, ServerNames};
use crate::session::{InstalledCertificate, SealedKey};
use crate::workspace::{CertificateFiles, SavedCertificate};

/// The fields of the self-signed dialog (manual 2.7.1.2).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SelfSignedFields {
    /// `None`: each controller's own ApplicationName. The only choice for several controllers.
    pub common_name: Option<String>,
    /// ISO 3166-1 alpha-2 code, or empty.
    pub country: String,
    /// State or province; may be empty.
    pub state: String,
    /// City; may be empty.
    pub locality: String,
    /// Organisation; may be empty.
    pub organisation: String,
    /// Length of the new key.
    pub key_length: KeyLength,
    /// How long the certificate is valid.
    pub validity: Validity,
}

impl SelfSignedFields {
    /// The request for a controller that calls itself `application_name`.
    pub fn request(&self, application_name: &str) -> SelfSignedRequest {
        SelfSignedRequest {
            subject: Subject {
                common_name: self.common_name.clone().unwrap_or_else(|| application_name.to_owned()),
                country: self.country.clone(),
                state: self.state.clone(),
                locality: self.locality.clone(),
                organisation: self.organisation.clone(),
            },
            key_length: self.key_length,
            validity: self.validity,
        }
    }
}

/// Makes a self-signed server certificate and installs it. Legacy firmware gets key and certificate from the PC;
/// current firmware makes both itself.
#[derive(Debug, Clone)]
pub struct SelfSigned {
    /// Who the certificate is for, its key and its validity.
    pub fields: SelfSignedFields,
    /// Where to keep a copy (manual 2.8.1); `None` when backup is off.
    pub backup: Option<CertificateFiles>,
}

pub(super) fn bad_request(error: impl std::fmt::Display) -> Problem {
    Problem::with_detail(ErrorCode::BadCertificateRequest, error)
}

/// A self-signed certificate was made and is in use.
#[derive(Debug, Clone, PartialEq)]
pub struct CertificateMade {
    /// Names and dates of the certificate.
    pub summary: CertificateSummary,
    /// Its backup; `None` when backup is off.
    pub saved: Option<SavedCertificate>,
}

impl OperationOutput for CertificateMade {
    fn facts(&self) -> OutputFacts<'_> {
        let saved = self.saved.as_ref();
        OutputFacts {
            written: saved.map(|saved| saved.certificate.as_path()),
            used: None,
            moved_aside: saved.map_or(&[], |saved| &saved.moved_aside),
            shortcoming: None,
        }
    }
}

#[async_trait]
impl Operation for SelfSigned {
    type Output = CertificateMade;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation {
            server: ServerEffect::Restarts,
            replaces_certificate: true,
            moves_files_aside: self.backup.is_some(),
            ..Confirmation::default()
        })
    }

    fn check(&self, controller: &JobController) -> Result<(), Problem> {
        let application_name = controller.known.as_ref().map_or("x", |info| &info.application_name);
        self.fields.request(application_name).subject.check().map_err(bad_request)
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<CertificateMade, Problem> {
        run.begin(JobStep::Read)?;
        let info = run.session.info().await?;
        let settings = run.session.settings().await?;
        let request = self.fields.request(&info.application_name);
        request.check(&settings.value.security_policies).map_err(bad_request)?;
        let made_in_controller = run.session.capabilities().await?.offers(Feature::KeysMadeInController);
        if let Some(files) = &self.backup {
            let (files, serial) = (files.clone(), info.serial.clone());
            let key_password = (!made_in_controller).then(|| run.password.clone());
            run.off_thread(move || files.check_writable(&serial, key_password.as_ref()).map_err(Problem::from)).await?;
        }
        let (installed, key) = if made_in_controller {
            run.begin(JobStep::Apply)?;
            (run.session.make_self_signed(info.revision, request).await?, None)
        } else {
            let (installed, key) = make_and_send(run, &info, request).await?;
            (installed, Some(key))
        };
        let certificate = Certificate::from_der(&installed.certificate)?;
        let saved = match &self.backup {
            None => None,
            Some(files) => {
                // Saved also after a cancel: no certificate is in use without its backup.
                (run.on_step)(JobStep::SaveBackup);
                let (files, serial, password) = (files.clone(), info.serial.clone(), run.password.clone());
                let certificate = certificate.clone();
                let save = move || {
                    files.save_self_signed(&serial, &certificate, key.as_ref(), &password).map_err(Problem::from)
                };
                Some(run.off_thread(save).await?)
            }
        };
        Ok(CertificateMade { summary: certificate.summary(), saved })
    }
}

async fn make_and_send(
    run: &mut OperationRun<'_>,
    info: &ControllerInfo,
    request: SelfSignedRequest,
) -> Result<(InstalledCertificate, PrivateKey), Problem> {
    run.begin(JobStep::MakeKey)?;
    let names = server_names(info, run.controller);
    let password = transfer_password()?;
    let alias = info.serial.to_string();
    let (key, pkcs12, password) = run
        .on_a_core(move || -> Result<_, pki::PkiError> {
            let key = PrivateKey::generate(request.key_length)?;
            let certificate = pki::self_signed(&request, &names, &key, clock::now())?;
            let pkcs12 =
                pki::pkcs12_write(&alias, &key, &[&certificate], secrecy::ExposeSecret::expose_secret(&password))?;
            Ok((key, pkcs12, password))
        })
        .await??;
    run.begin(JobStep::Apply)?;
    let sealed = SealedKey { pkcs12, password };
    Ok((run.session.import_certificate(info.revision, CertificateType::SelfSigned, sealed).await?, key))
}

/// What clients will compare with the certificate: the ApplicationUri the server announces (OPC 10000-6 §6.2.2), and
/// the names it is reached by, from both sides.
pub(super) fn server_names(info: &ControllerInfo, controller: &JobController) -> ServerNames {
    let announced =
        info.endpoint.strip_prefix("opc.tcp://").and_then(|rest| rest.split('/').next()).unwrap_or_default();
    let announced = announced.rsplit_once(':').map_or(announced, |(host, _)| host).trim_matches(['[', ']']);
    let mut names =
        ServerNames { application_uri: format!("urn:{}", info.application_name), ips: Vec::new(), dns: Vec::new() };
    for host in [announced, controller.address.host()] {
        match host.parse::<IpAddr>() {
            Ok(ip) if !names.ips.contains(&ip) && !ip.is_unspecified() => names.ips.push(ip),
            Err(_) if !host.is_empty() && !names.dns.iter().any(|d| d == host) => names.dns.push(host.to_owned()),
            _ => {}
        }
    }
    names
}

/// A random password for one transfer, known to the two ends only.
pub(super) fn transfer_password() -> Result<SecretString, Problem> {
    let mut bytes = [0u8; 24];
    getrandom::fill(&mut bytes).map_err(|e| Problem::with_detail(ErrorCode::Internal, e))?;
    Ok(SecretString::from(hex::encode(bytes)))
}
