//! What operations look at before they install a server certificate that was made elsewhere.

use std::path::PathBuf;

use super::self_signed::server_names;
use super::{OperationOutput, OperationRun, OutputFacts};
use crate::model::{CertificateSummary, ControllerInfo, ErrorCode, Language, Problem};
use crate::pki::{
    Certificate, CertificateFinding, CertificateFlaw, ExpectedServer, Issuers, PkiError, Severity, check_import,
};

/// A server certificate from elsewhere was installed and selected.
#[derive(Debug, Clone, PartialEq)]
pub struct CertificateImported {
    /// Names and dates of the certificate.
    pub summary: CertificateSummary,
    /// What clients may complain about, and was accepted.
    pub findings: Vec<CertificateFinding>,
    /// Where the files of the former request are now, if one was made for it.
    pub moved_aside: Vec<PathBuf>,
}

impl OperationOutput for CertificateImported {
    fn facts(&self) -> OutputFacts<'_> {
        OutputFacts { written: None, used: None, moved_aside: &self.moved_aside, shortcoming: None }
    }
}

/// A server certificate from elsewhere was looked at, and nothing was changed.
#[derive(Debug, Clone, PartialEq)]
pub struct CertificateChecked {
    /// `None`: a signing request and its key, without a certificate.
    pub summary: Option<CertificateSummary>,
    /// What clients would say of it.
    pub findings: Vec<CertificateFinding>,
    /// Of a certificate from a CA.
    pub issuers: Option<Issuers>,
}

impl CertificateChecked {
    /// Whether clients would refuse it.
    pub fn is_refused(&self) -> bool {
        self.findings.iter().any(|finding| finding.severity == Severity::Error)
    }
}

impl OperationOutput for CertificateChecked {
    fn facts(&self) -> OutputFacts<'_> {
        OutputFacts::NONE
    }
}

/// Compares a certificate with the controller it is for. Reads the controller's settings.
pub(super) async fn examine(
    run: &mut OperationRun<'_>,
    info: &ControllerInfo,
    certificate: &Certificate,
) -> Result<Vec<CertificateFinding>, Problem> {
    let policies = run.session.settings().await?.value.security_policies;
    let application_uri = server_names(info, run.controller).application_uri;
    // The name that this computer uses, and that `verify` compares with the certificate.
    let hosts = [run.controller.address.host().to_owned()];
    let expected =
        ExpectedServer { application_uri: &application_uri, hosts: &hosts, policies: &policies, now: info.clock };
    Ok(check_import(certificate, &expected))
}

/// Refuses what clients would refuse, and what they may complain about unless that is accepted. An expired certificate
/// and a key of the wrong length have codes of their own.
pub(super) async fn admit(
    run: &mut OperationRun<'_>,
    info: &ControllerInfo,
    certificate: &Certificate,
    accept_warnings: bool,
) -> Result<Vec<CertificateFinding>, Problem> {
    let findings = examine(run, info, certificate).await?;
    for finding in &findings {
        match &finding.flaw {
            CertificateFlaw::Expired { until, .. } => return Err(PkiError::Expired(*until).into()),
            CertificateFlaw::KeyLengthNotTicked { bits } => return Err(PkiError::KeyLengthNotAllowed(*bits).into()),
            _ => {}
        }
    }
    let of = |severity: Severity| findings.iter().filter(move |f| f.severity == severity);
    if of(Severity::Error).next().is_some() {
        return Err(Problem::with_detail(ErrorCode::Preflight, listed(of(Severity::Error))));
    }
    if !findings.is_empty() && !accept_warnings {
        return Err(Problem::with_detail(ErrorCode::PreflightWarnings, listed(findings.iter())));
    }
    Ok(findings)
}

fn listed<'a>(findings: impl Iterator<Item = &'a CertificateFinding>) -> String {
    let texts: Vec<String> =
        findings.map(|finding| format!("{}: {}", finding.status(), finding.explain(Language::En))).collect();
    texts.join("; ")
}
