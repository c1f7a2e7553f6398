//! Connecting to a controller's OPC UA server as a client does: what works, and why not.
//!
//! | file | what |
//! |---|---|
//! | `report` | [`VerifyReport`]: the result of a verification |
//! | `trust` | [`TrustConfigurator`]: what helps most often |
//! | `probe` | every endpoint with every token, and what a failure means |

mod probe;
mod report;
mod trust;

use std::collections::HashSet;
use std::time::Duration;

use async_trait::async_trait;

pub use report::{
    CertificateVerdict, ConnectRefusal, EndpointVerdict, NotTried, RefusalDetails, TokenOutcome, TokenVerdict,
    VerifyCounts, VerifyFinding, VerifyReport,
};

pub use trust::TrustConfigurator;
pub(super) use trust::{own as own_identity, trust as trust_configurator};

use super::{Confirmation, JobStep, Operation, OperationOutput, OperationRun, OutputFacts};
use crate::model::{
    ControllerInfo, ErrorCode, Problem, ServerSettings, ServerStatus, UserCredential, UserTokenPolicy, clock,
};
use crate::pki::{Certificate, ExpectedServer, check_server};
use crate::session::opcua_client::{ConnectTimeouts, Endpoint, OpcUaClient, ServerLocation, is_reachable};
use crate::workspace::ConfiguratorIdentityFiles;
use probe::{Probe, clock, compare, offered_policies, refusal_of};

/// Connects as an OPC UA client through every endpoint a controller offers, with every token.
///
/// The server's certificate is judged as a careful client does, with the certificate that the session with the
/// controller names as the one to trust. A server that shows another is not logged in to. Nothing is tried twice, and a
/// password that was refused is not sent again, so that the user is not locked out.
///
/// It fails only if the controller cannot be asked; what does not work is in the report.
#[derive(Debug, Clone)]
pub struct Verify {
    /// What this program shows to servers.
    pub identity: ConfiguratorIdentityFiles,
    /// Who logs in where a user name is wanted; `None` leaves that out.
    pub login: Option<UserCredential>,
    /// Put this program's certificate into the trusted list first.
    pub trust_first: bool,
    /// How long each connection may take.
    pub timeouts: ConnectTimeouts,
}

impl OperationOutput for VerifyReport {
    fn facts(&self) -> OutputFacts<'_> {
        let shortcoming = (!self.all_works()).then(|| ErrorCode::VerifyFailed.into());
        OutputFacts { written: None, used: None, moved_aside: &[], shortcoming }
    }
}

#[async_trait]
impl Operation for Verify {
    type Output = VerifyReport;

    fn confirmation(&self) -> Option<Confirmation> {
        self.trust_first.then(Confirmation::default)
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<VerifyReport, Problem> {
        run.begin(JobStep::Read)?;
        let own = trust::own(&self.identity, run).await?;
        if self.trust_first {
            trust::trust(run, &own).await?;
        }
        let info = run.session.info().await?;
        let settings = run.session.settings().await?.value;
        let held = run.session.certificates().await?.value;
        let users = run.session.users().await?.value.len();
        let selected = held.of(held.selected).and_then(|der| Certificate::from_der(der).ok());
        let known = ReportedFacts { info, settings, selected, users };
        let target = ServerLocation { host: run.controller.address.host().to_owned(), port: known.settings.port.get() };
        let mut report =
            VerifyReport { url: target.url(), own, findings: Vec::new(), certificate: None, endpoints: Vec::new() };
        self.fill(&mut report, run, &known, &target).await?;
        report.findings.sort_by_key(VerifyFinding::severity);
        Ok(report)
    }
}

/// What the controller says of itself.
struct ReportedFacts {
    info: ControllerInfo,
    settings: ServerSettings,
    selected: Option<Certificate>,
    users: usize,
}

impl Verify {
    async fn fill(
        &self,
        report: &mut VerifyReport,
        run: &mut OperationRun<'_>,
        known: &ReportedFacts,
        target: &ServerLocation,
    ) -> Result<(), Problem> {
        let ReportedFacts { info, settings, selected, users } = known;
        report.findings.extend(clock(info.clock, clock::now()));
        if *users == 0 && !settings.user_tokens.contains(&UserTokenPolicy::Anonymous) {
            report.findings.push(VerifyFinding::NoUsers);
        }
        if info.status != ServerStatus::Run {
            report.findings.push(VerifyFinding::NotRunning { status: info.status, error: info.error });
            return Ok(());
        }
        run.begin(JobStep::Verify)?;
        let (own, timeouts) = (report.own.clone(), self.timeouts);
        let client = run.off_thread(move || OpcUaClient::new(&own, timeouts)).await?;
        let endpoints = match client.endpoints(target).await {
            Ok(endpoints) => distinct(endpoints),
            Err(failure) => {
                report.findings.push(VerifyFinding::NoAnswer(refusal_of(&failure)));
                return Ok(());
            }
        };
        report.findings.extend(compare(&endpoints, settings));
        report.findings.extend(other_address(&endpoints, target).await);
        report.certificate = self.judge(run, &endpoints, known, target).await?;
        let mut probe = Probe {
            client: &client,
            target,
            own: &report.own.certificate,
            selected: selected.as_ref(),
            login: self.login.as_ref(),
            since: info.clock,
            password_refused: false,
            certificate_refused: None,
        };
        for endpoint in &endpoints {
            report.endpoints.push(probe.endpoint(run, endpoint).await?);
        }
        Ok(())
    }

    /// Every endpoint shows the same certificate; the first that is not the selected one counts.
    async fn judge(
        &self,
        run: &OperationRun<'_>,
        endpoints: &[Endpoint],
        known: &ReportedFacts,
        target: &ServerLocation,
    ) -> Result<Option<CertificateVerdict>, Problem> {
        let shown = endpoints.iter().filter_map(|endpoint| Some((endpoint, endpoint.certificates().ok()?.0)));
        let mut shown: Vec<(&Endpoint, Certificate)> = shown.collect();
        shown.sort_by_key(|(_, leaf)| Some(leaf) == known.selected.as_ref());
        let Some((endpoint, leaf)) = shown.into_iter().next() else { return Ok(None) };
        let policies = offered_policies(endpoints);
        let (selected, hosts, controllers_clock) = (known.selected.clone(), [target.host.clone()], known.info.clock);
        let application_uri = endpoint.application_uri.clone();
        let verdict = run
            .on_a_core(move || {
                let now = clock::now();
                let expected =
                    ExpectedServer { application_uri: &application_uri, hosts: &hosts, policies: &policies, now };
                let check = check_server(&leaf, selected.as_ref(), &expected, controllers_clock);
                CertificateVerdict { summary: leaf.summary(), refused: check.refused, findings: check.findings }
            })
            .await?;
        Ok(Some(verdict))
    }
}

/// Each policy and mode once, the weakest first; a server with several addresses gives each of them an endpoint.
fn distinct(mut endpoints: Vec<Endpoint>) -> Vec<Endpoint> {
    let key = |endpoint: &Endpoint| (endpoint.policy.clone(), endpoint.mode);
    let mut seen = HashSet::new();
    endpoints.retain(|endpoint| seen.insert(key(endpoint)));
    endpoints.sort_by_key(key);
    endpoints.truncate(MAX_ENDPOINTS);
    endpoints
}

/// Whether the server names another address than the one it was reached at, in the first endpoint that does.
async fn other_address(endpoints: &[Endpoint], target: &ServerLocation) -> Option<VerifyFinding> {
    let other = endpoints.iter().find(|endpoint| !endpoint.target().is_some_and(|named| is_same(&named, target)))?;
    let reachable = match other.target() {
        Some(named) => is_reachable(&named, OTHER_ADDRESS).await,
        None => false,
    };
    Some(VerifyFinding::OtherAddress { url: other.url.clone(), reachable })
}

fn is_same(one: &ServerLocation, other: &ServerLocation) -> bool {
    let ip = |target: &ServerLocation| target.host.parse::<std::net::IpAddr>();
    let same_host = match (ip(one), ip(other)) {
        (Ok(one), Ok(other)) => one == other,
        _ => one.host.eq_ignore_ascii_case(&other.host),
    };
    same_host && one.port == other.port
}

/// Six policies with at most two modes are eleven.
const MAX_ENDPOINTS: usize = 32;
const OTHER_ADDRESS: Duration = Duration::from_secs(2);
