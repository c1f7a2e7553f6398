use std::time::Duration;

use async_trait::async_trait;
use chrono::{DateTime, Utc};

use crate::jobs::{Confirmation, JobStep, Operation, OperationOutput, OperationRun, OutputFacts};
use crate::model::{
    Capabilities, ClientList, ErrorCode, Feature, ListLimits, ListedCertificate, ListedCrl, Problem, RevisionToken,
};
use crate::pki::{Certificate, Crl, PkiError, RejectedClient, TrustHealth, TrustLists};
use crate::session::ControllerSession;

/// Reads all client lists and CRLs of a controller (manual 2.7.3.1, 2.7.3.4).
#[derive(Debug, Clone, Copy)]
pub struct ListTrust;

/// Everything a controller trusts, and whom it refused, at one moment.
#[derive(Debug, Clone, PartialEq)]
pub struct TrustSnapshot {
    /// The configuration that everything was read from.
    pub revision: RevisionToken,
    /// What the controller offers over this connection.
    pub capabilities: Capabilities,
    /// How much fits into each list.
    pub limits: ListLimits,
    /// The controller's clock when this was read.
    pub clock: DateTime<Utc>,
    /// The trusted list.
    pub trusted: Vec<ListedCertificate>,
    /// Seen last first.
    pub rejected: Vec<RejectedClient>,
    /// Empty where the controller has no such list ([`Feature::IssuersList`]).
    pub issuers: Vec<ListedCertificate>,
    /// Each with its DER.
    pub crls: Vec<ListedCrl>,
    /// Expired and missing CRLs, and what that means for clients.
    pub health: TrustHealth,
}

impl OperationOutput for TrustSnapshot {
    fn facts(&self) -> OutputFacts<'_> {
        OutputFacts::NONE
    }
}

#[async_trait]
impl Operation for ListTrust {
    type Output = TrustSnapshot;

    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<TrustSnapshot, Problem> {
        run.begin(JobStep::Read)?;
        TrustSnapshot::read(run.session).await
    }
}

/// How often the configuration may change while it is read, before reading fails.
const ATTEMPTS: u32 = 4;
/// For everything, however often it is read. Fifty CRLs of megabytes over a slow line take less.
const MAX_TIME: Duration = Duration::from_secs(120);
/// Of all CRLs together, in bytes of DER. The bundled virtual controller keeps 4 MiB.
const MAX_CRLS_BYTES: usize = 64 * 1024 * 1024;

impl TrustSnapshot {
    pub(in crate::jobs) async fn read(session: &mut dyn ControllerSession) -> Result<Self, Problem> {
        let reading = async {
            for _ in 0..ATTEMPTS {
                if let Some(whole) = Self::read_once(session).await? {
                    return Ok(whole);
                }
            }
            Err(ErrorCode::ChangedMeanwhile.into())
        };
        tokio::time::timeout(MAX_TIME, reading).await.unwrap_or_else(|_| Err(ErrorCode::Timeout.into()))
    }

    /// `None` if the configuration changed between two of the requests.
    async fn read_once(session: &mut dyn ControllerSession) -> Result<Option<Self>, Problem> {
        let info = session.info().await?;
        let trusted = session.clients(ClientList::Trusted).await?;
        let capabilities = session.capabilities().await?;
        let issuers = if capabilities.offers(Feature::IssuersList) {
            let issuers = session.clients(ClientList::Issuers).await?;
            if issuers.revision != info.revision {
                return Ok(None);
            }
            issuers.value
        } else {
            Vec::new()
        };
        let mut crls = session.crls().await?;
        let mut bytes: usize = crls.value.iter().filter_map(|listed| Some(listed.crl.as_ref()?.0.len())).sum();
        for listed in crls.value.iter_mut().filter(|listed| listed.crl.is_none()) {
            match session.crl(&listed.summary.id).await {
                Ok(der) => {
                    bytes += der.0.len();
                    listed.crl = Some(der);
                }
                Err(problem) if problem.code == ErrorCode::NotInList => return Ok(None),
                Err(problem) => return Err(problem),
            }
            if bytes > MAX_CRLS_BYTES {
                return Err(Problem::with_detail(ErrorCode::NotAController, "its CRLs are too large"));
            }
        }
        // Last: it is the one that changes by itself.
        let rejected = session.rejected_clients().await?;
        if [trusted.revision, crls.revision, rejected.revision].iter().any(|read| *read != info.revision) {
            return Ok(None);
        }
        let health = health([&trusted.value, &issuers], &crls.value, info.clock).await?;
        Ok(Some(Self {
            revision: info.revision,
            capabilities,
            limits: info.limits,
            clock: info.clock,
            trusted: trusted.value,
            rejected: rejected.value,
            issuers,
            crls: crls.value,
            health,
        }))
    }

    /// The lists that certificates are put into.
    pub(super) fn listed(&self, list: ClientList) -> &[ListedCertificate] {
        match list {
            ClientList::Trusted => &self.trusted,
            ClientList::Issuers => &self.issuers,
            ClientList::Rejected => &[],
        }
    }

    /// The list a certificate is in; if in several, the one that counts most.
    pub fn list_of(&self, thumbprint: &str) -> Option<ClientList> {
        [ClientList::Trusted, ClientList::Issuers, ClientList::Rejected]
            .into_iter()
            .find(|list| self.holds(*list, thumbprint))
    }

    /// Every certificate the controller has or was shown; those that cannot be read are left out.
    pub(super) fn certificates(&self) -> impl Iterator<Item = Certificate> + '_ {
        let listed = self.trusted.iter().chain(&self.issuers).map(|listed| &listed.certificate);
        let shown = self.rejected.iter().flat_map(|client| std::iter::once(&client.certificate).chain(&client.chain));
        listed.chain(shown).filter_map(|der| Certificate::from_der(&der.0).ok())
    }

    /// Whether a list holds the certificate with this thumbprint (SHA-1, hexadecimal).
    pub fn holds(&self, list: ClientList, thumbprint: &str) -> bool {
        self.thumbprints(list).any(|held| held == thumbprint)
    }

    pub(super) fn thumbprints(&self, list: ClientList) -> impl Iterator<Item = &str> {
        let rejected = if list == ClientList::Rejected { self.rejected.as_slice() } else { &[] };
        let listed = self.listed(list).iter().map(|listed| listed.summary.thumbprint.as_str());
        listed.chain(rejected.iter().map(|rejected| rejected.summary.thumbprint.as_str()))
    }

    pub(super) fn holds_crl(&self, id: &str) -> bool {
        self.crls.iter().any(|held| held.summary.id == id)
    }
}

/// Checks signatures: off the async threads.
async fn health(
    [trusted, issuers]: [&[ListedCertificate]; 2],
    crls: &[ListedCrl],
    now: DateTime<Utc>,
) -> Result<TrustHealth, Problem> {
    let ders = |listed: &[ListedCertificate]| -> Vec<Vec<u8>> {
        listed.iter().map(|listed| listed.certificate.0.clone()).collect()
    };
    let (trusted, issuers) = (ders(trusted), ders(issuers));
    let crls: Vec<Vec<u8>> = crls.iter().filter_map(|listed| Some(listed.crl.clone()?.0)).collect();
    tokio::task::spawn_blocking(move || {
        let crls = crls.iter().map(|der| Crl::from_der(der)).collect::<Result<Vec<_>, _>>()?;
        let certificates = |ders: &[Vec<u8>]| -> Result<Vec<Certificate>, PkiError> {
            ders.iter().map(|der| Certificate::from_der(der)).collect()
        };
        let lists = TrustLists::new(certificates(&trusted)?, certificates(&issuers)?, crls);
        Ok(TrustHealth::of(&lists, now))
    })
    .await
    .map_err(|e| Problem::with_detail(ErrorCode::Internal, e))?
}
