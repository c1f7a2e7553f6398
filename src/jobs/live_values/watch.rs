use std::time::Duration;

use tokio::sync::mpsc::UnboundedReceiver;
use tokio_util::sync::CancellationToken;

use super::request::{LiveEvent, LiveRequest};
use super::serve::{Requests, serve};
use crate::jobs::{JobContext, JobController};
use crate::model::{ErrorCode, Problem, UserCredential, clock};
use crate::pki::Fingerprint;
use crate::session::opcua_client::{
    ClientSession, ConnectTimeouts, ControllerServer, OpcUaClient, ServerConnectError, UserLogin,
};
use crate::workspace::ConfiguratorIdentityFiles;

/// As whom the OPC UA server is logged in to.
#[derive(Debug, Clone)]
pub struct LiveLogin {
    /// What this program shows to the server.
    pub identity: ConfiguratorIdentityFiles,
    /// `None`: anonymous.
    pub user: Option<UserCredential>,
}

/// Watches the OPC UA server of one controller until it is cancelled: reports what the server shows, and the values of
/// the variables that are asked for with [`LiveRequest::Show`].
///
/// The session with the controller is used to find the server and closed again; the values come over an OPC UA session of
/// its own. A lost connection is opened again after pauses from 0.5 to 15 s. An error that would be the same at the next
/// try ends the watch with [`LiveEvent::Ended`].
pub async fn watch_values(
    controller: JobController,
    login: LiveLogin,
    context: JobContext,
    requests: UnboundedReceiver<LiveRequest>,
    cancel: CancellationToken,
    on_event: impl Fn(LiveEvent) + Send + Sync,
) {
    let Some(fingerprint) = controller.fingerprint else {
        return on_event(LiveEvent::Ended(ErrorCode::FingerprintUnknown.into()));
    };
    let mut requests = Requests::new(requests);
    let mut pause = FIRST_PAUSE;
    loop {
        let mut session = None;
        let watching = async {
            let opened = open(&controller, fingerprint, &login, &context).await?;
            pause = FIRST_PAUSE;
            let (_, session) = session.insert(opened);
            let failure = serve(session, &mut requests, &on_event).await;
            Err::<std::convert::Infallible, Problem>(ServerConnectError::Failed(failure).into())
        };
        let ended = tokio::select! {
            () = cancel.cancelled() => None,
            Err(problem) = watching => Some(problem),
        };
        if let Some((_client, session)) = session {
            session.close().await;
        }
        match ended {
            None => return,
            Some(problem) if problem.code.is_lasting() => return on_event(LiveEvent::Ended(problem)),
            Some(problem) => on_event(LiveEvent::Lost(problem)),
        }
        tokio::select! {
            () = cancel.cancelled() => return,
            () = tokio::time::sleep(pause) => pause = (pause * 2).min(LAST_PAUSE),
        }
    }
}

/// Finds the server and opens a session. The client is kept as long as the session: its key renews the secure channel.
async fn open(
    controller: &JobController,
    fingerprint: Fingerprint,
    login: &LiveLogin,
    context: &JobContext,
) -> Result<(OpcUaClient, ClientSession), Problem> {
    let credentials = context.credentials(fingerprint).await?;
    let mut session = context.connect(controller, fingerprint, &credentials).await?;
    let found = ControllerServer::find(session.as_mut(), controller.address.host()).await;
    session.close().await;
    let server = found?;
    let identity = login.identity.clone();
    let client = tokio::task::spawn_blocking(move || -> Result<OpcUaClient, Problem> {
        let own = identity.load_or_make(clock::now())?;
        OpcUaClient::new(&own, ConnectTimeouts::default())
    });
    let client = client.await.map_err(|e| Problem::with_detail(ErrorCode::Internal, e))??;
    let login = UserLogin::of(login.user.as_ref());
    let session = server.connect(&client, &login).await?;
    Ok((client, session))
}

const FIRST_PAUSE: Duration = Duration::from_millis(500);
const LAST_PAUSE: Duration = Duration::from_secs(15);
