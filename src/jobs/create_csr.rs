use async_trait::async_trait;
use secrecy::ExposeSecret as _;

use super::self_signed::{bad_request, server_names, transfer_password};
use super::{Confirmation, JobController, JobStep, Operation, OperationOutput, OperationRun, OutputFacts};
use crate::model::{ControllerInfo, CsrRequest, Feature, FileFormat, KeyLength, Problem, Subject};
use crate::pki::{self, Csr, PkiError, PrivateKey};
use crate::session::{CsrImport, SealedKey, StoredCsr};
use crate::workspace::{CertificateFiles, SavedCsr};

/// The fields of the CSR dialog (manual 2.7.1.5).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CsrFields {
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
}

impl CsrFields {
    /// The request for a controller that calls itself `application_name`.
    pub fn request(&self, application_name: &str) -> CsrRequest {
        CsrRequest {
            subject: Subject {
                common_name: self.common_name.clone().unwrap_or_else(|| application_name.to_owned()),
                country: self.country.clone(),
                state: self.state.clone(),
                locality: self.locality.clone(),
                organisation: self.organisation.clone(),
            },
            key_length: self.key_length,
        }
    }
}

/// Makes a new key and its certificate signing request, and saves the request on the PC.
///
/// Current firmware makes the key itself and goes on using its CA-signed certificate until a new one is imported.
/// Legacy firmware gets the key from the PC in place of the old one: its CA-signed certificate is invalid at once.
#[derive(Debug, Clone)]
pub struct CreateCsr {
    /// Who the certificate is for, and the length of the key.
    pub fields: CsrFields,
    /// How the request is written to the file.
    pub format: FileFormat,
    /// Where the request is saved.
    pub files: CertificateFiles,
    /// Whether to keep a copy of the key of a legacy controller (manual 2.8.1).
    pub backup: bool,
}

/// A signing request was made and saved.
#[derive(Debug, Clone, PartialEq)]
pub struct CsrSaved {
    /// The CommonName of its subject.
    pub common_name: String,
    /// The file with the request, and what was moved aside for it.
    pub saved: SavedCsr,
}

impl OperationOutput for CsrSaved {
    fn facts(&self) -> OutputFacts<'_> {
        OutputFacts {
            written: Some(&self.saved.csr),
            used: None,
            moved_aside: &self.saved.moved_aside,
            shortcoming: None,
        }
    }
}

#[async_trait]
impl Operation for CreateCsr {
    type Output = CsrSaved;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation { invalidates_ca_signed: true, moves_files_aside: true, ..Confirmation::default() })
    }

    fn check(&self, controller: &JobController) -> Result<(), Problem> {
        let application_name = controller.known.as_ref().map_or("x", |info| &info.application_name);
        self.fields.request(application_name).subject.check().map_err(bad_request)
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<CsrSaved, Problem> {
        run.begin(JobStep::Read)?;
        let info = run.session.info().await?;
        let (csr, saved) = self.make(run, &info).await?;
        Ok(CsrSaved { common_name: csr.common_name().unwrap_or_default().to_owned(), saved })
    }
}

impl CreateCsr {
    /// What the operation does once it knows the controller.
    pub(super) async fn make(
        &self,
        run: &mut OperationRun<'_>,
        info: &ControllerInfo,
    ) -> Result<(Csr, SavedCsr), Problem> {
        let settings = run.session.settings().await?;
        let request = self.fields.request(&info.application_name);
        request.check(&settings.value.security_policies).map_err(bad_request)?;
        let made_on_pc = !run.session.capabilities().await?.offers(Feature::KeysMadeInController);
        let (files, serial) = (self.files.clone(), info.serial.clone());
        let key_password = (self.backup && made_on_pc).then(|| run.password.clone());
        run.off_thread(move || files.check_csr_writable(&serial, key_password.as_ref()).map_err(Problem::from)).await?;
        let (made, key) = if made_on_pc {
            let (made, key) = make_and_send(run, info, request).await?;
            (made, Some(key))
        } else {
            run.begin(JobStep::Apply)?;
            (run.session.make_csr(info.revision, request).await?, None)
        };
        let csr = Csr::from_der(&made.csr)?;
        // Saved also after a cancel: the controller holds it by now.
        (run.on_step)(JobStep::SaveBackup);
        let (files, serial, password) = (self.files.clone(), info.serial.clone(), run.password.clone());
        let (format, key, saving) = (self.format, key.filter(|_| self.backup), csr.clone());
        let save = move || files.save_csr(&serial, &saving, format, key.as_ref(), &password).map_err(Problem::from);
        Ok((csr, run.off_thread(save).await?))
    }
}

async fn make_and_send(
    run: &mut OperationRun<'_>,
    info: &ControllerInfo,
    request: CsrRequest,
) -> Result<(StoredCsr, PrivateKey), Problem> {
    run.begin(JobStep::MakeKey)?;
    let names = server_names(info, run.controller);
    let password = transfer_password()?;
    let alias = info.serial.to_string();
    let (key, csr, pkcs12, password) = run
        .on_a_core(move || -> Result<_, PkiError> {
            let key = PrivateKey::generate(request.key_length)?;
            let csr = pki::make_csr(&request, &names, &key)?;
            let pkcs12 = pki::pkcs12_write_key(&alias, &key, password.expose_secret())?;
            Ok((key, csr, pkcs12, password))
        })
        .await??;
    run.begin(JobStep::Apply)?;
    let key_transfer = SealedKey { pkcs12, password };
    let import = CsrImport { csr: csr.der().to_vec(), key: key_transfer, certificate: None };
    Ok((run.session.import_csr(info.revision, import).await?, key))
}
