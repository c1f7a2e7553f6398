use async_trait::async_trait;

use super::{
    AddTrust, Confirmation, Destination, JobController, JobStep, Operation, OperationRun, TrustChange, TrustFile,
};
use crate::model::{Capabilities, Feature, Problem};
use crate::pki::Bundle;
use crate::workspace::authority::AuthorityOverview;

/// Gives controllers what they need of the small CA to judge certificates from it: its CRL and its certificate, and
/// those of the root above it.
///
/// The certificates go into the issuers list, where they only complete chains. Legacy firmware has no such list, and
/// gets the CRLs only.
#[derive(Debug, Clone)]
pub struct PushAuthority {
    files: Vec<TrustFile>,
    trust: bool,
}

impl PushAuthority {
    /// `trust`: the certificates go into the trusted list instead, of any firmware: every client is let in that has a
    /// certificate from the CA.
    pub fn new(overview: &AuthorityOverview, trust: bool) -> Self {
        let files = [("ca", Some(&overview.signing)), ("root", overview.root.as_ref())]
            .into_iter()
            .filter_map(|(name, ca)| {
                let ca = ca?;
                let file = |extension: &str, certificates, crls| TrustFile {
                    file_name: format!("{name}.{extension}"),
                    bundle: Bundle { certificates, crls },
                };
                Some([file("der", vec![ca.certificate.clone()], vec![]), file("crl", vec![], vec![ca.crl.clone()])])
            })
            .flatten()
            .collect();
        Self { files, trust }
    }

    fn operation(&self, capabilities: &Capabilities) -> AddTrust {
        let (destination, crls_only) = match (self.trust, capabilities.offers(Feature::IssuersList)) {
            (true, _) => (Destination::Trusted, false),
            (false, true) => (Destination::Issuers, false),
            (false, false) => (Destination::Crls, true),
        };
        let wanted = |file: &&TrustFile| !crls_only || file.bundle.certificates.is_empty();
        AddTrust { files: self.files.iter().filter(wanted).cloned().collect(), destination, based_on: None }
    }
}

#[async_trait]
impl Operation for PushAuthority {
    type Output = TrustChange;

    fn confirmation(&self) -> Option<Confirmation> {
        self.operation(&Capabilities::all()).confirmation()
    }

    fn check(&self, controller: &JobController) -> Result<(), Problem> {
        match &controller.known {
            Some(_) => self.operation(&controller.capabilities()).check(controller),
            None => Ok(()),
        }
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<TrustChange, Problem> {
        run.begin(JobStep::Read)?;
        let capabilities = run.session.capabilities().await?;
        self.operation(&capabilities).run(run).await
    }
}
