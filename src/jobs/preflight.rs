//! What operations look at before they install a server certificate that was made elsewhere.

use super::Run;
use super::self_signed::server_names;
use crate::model::{ControllerInfo, ErrorCode, Language, Problem};
use crate::pki::{Certificate, CertificateFlaw, Expected, Finding, PkiError, Severity, check_import};

/// Compares a certificate with the controller it is for. Reads the controller's settings.
pub(super) async fn examine(
    run: &mut Run<'_>,
    info: &ControllerInfo,
    certificate: &Certificate,
) -> Result<Vec<Finding>, Problem> {
    let policies = run.session.settings().await?.value.security_policies;
    let application_uri = server_names(info, run.controller).application_uri;
    // The name that this computer uses, and that `verify` compares with the certificate.
    let hosts = [run.controller.address.host().to_owned()];
    let expected = Expected { application_uri: &application_uri, hosts: &hosts, policies: &policies, now: info.clock };
    Ok(check_import(certificate, &expected))
}

/// Refuses what clients would refuse, and what they may complain about unless that is accepted. An expired certificate
/// and a key of the wrong length have codes of their own.
pub(super) async fn admit(
    run: &mut Run<'_>,
    info: &ControllerInfo,
    certificate: &Certificate,
    accept_warnings: bool,
) -> Result<Vec<Finding>, Problem> {
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

fn listed<'a>(findings: impl Iterator<Item = &'a Finding>) -> String {
    let texts: Vec<String> =
        findings.map(|finding| format!("{}: {}", finding.status(), finding.explain(Language::En))).collect();
    texts.join("; ")
}
