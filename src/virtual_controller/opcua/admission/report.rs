use std::fmt;
use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;
use std::time::Instant;

use parking_lot::Mutex;

use super::super::{ServerEvent, ServerEvents};
use crate::pki::{Certificate, CertificateRejection};
use crate::virtual_controller::connection_limits::{LineDecision, LineLimiter, RefusalDecision, SourceNetwork};

/// Who keeps the list of rejected clients.
pub trait RejectionRecorder: Send + Sync {
    /// A client at `address` was refused because of its certificate. `sent` is what it sent, leaf first, and never
    /// empty; `rejection` is the true reason, which the client may not have been told.
    ///
    /// Called on the server's own tasks, so it must not take long; not more than about thirty times a minute for one
    /// address.
    fn record(&self, sent: &[Certificate], address: IpAddr, rejection: &CertificateRejection);
}

/// Reports connections and refusals, with a limit for each source.
pub(in super::super) struct AdmissionReporter {
    events: ServerEvents,
    refusals: Option<Arc<dyn RejectionRecorder>>,
    lines: Mutex<LineLimiter>,
}

impl AdmissionReporter {
    pub(in super::super) fn new(events: ServerEvents, refusals: Option<Arc<dyn RejectionRecorder>>) -> Self {
        Self { events, refusals, lines: Mutex::default() }
    }

    /// A certificate was refused. False if it was not reported, because the source is over its limit.
    pub(super) fn rejected(&self, client: SocketAddr, sent: &[Certificate], rejection: &CertificateRejection) -> bool {
        let told = self.refused(client, &rejection.to_string());
        if told
            && !sent.is_empty()
            && let Some(refusals) = &self.refusals
        {
            refusals.record(sent, client.ip().to_canonical(), rejection);
        }
        told
    }

    /// Something else than a certificate was refused. False if it was not reported, because the source is over its
    /// limit.
    pub(super) fn refused(&self, client: SocketAddr, reason: &str) -> bool {
        self.refusal(client, ServerEvent::Refused { client, reason })
    }

    /// A user was not let in.
    pub(super) fn login_refused(&self, client: SocketAddr, user: Option<&str>, reason: &str) {
        self.refusal(client, ServerEvent::LoginRefused { client: Some(client), user, reason });
    }

    fn refusal(&self, client: SocketAddr, event: ServerEvent<'_>) -> bool {
        let source = SourceNetwork::new(client.ip());
        let refusal = self.lines.lock().refused(source, Instant::now());
        match refusal {
            RefusalDecision::Tell { left_out } => {
                self.left_out(source, left_out);
                self.events.tell(event);
                tracing::info!("OPC UA: {event}");
            }
            RefusalDecision::TellLast => {
                self.events.tell(event);
                self.events.tell(ServerEvent::RefusalsQuiet { source });
                tracing::warn!("OPC UA: {event}, as too many before; no more is said of this address for a while");
            }
            RefusalDecision::Quiet => return false,
        }
        true
    }

    fn left_out(&self, source: SourceNetwork, count: u64) {
        if count > 0 {
            self.events.tell(ServerEvent::LinesLeftOut { source, count });
        }
    }

    /// An open connection was ended because its certificate is not trusted any more. Reported without a limit.
    pub(super) fn cut(&self, client: SocketAddr, sent: &[Certificate], rejection: &CertificateRejection) {
        self.events.tell(ServerEvent::Cut { client, reason: &rejection.to_string() });
        if let Some(refusals) = &self.refusals {
            refusals.record(sent, client.ip().to_canonical(), rejection);
        }
    }

    pub(super) fn connected(&self, client: SocketAddr) {
        self.line(client, ServerEvent::Connected { client });
    }

    pub(super) fn disconnected(&self, client: SocketAddr) {
        self.line(client, ServerEvent::Disconnected { client });
    }

    pub(super) fn too_many(&self, client: SocketAddr) {
        self.line(client, ServerEvent::TooManyConnections { client });
    }

    fn line(&self, client: SocketAddr, event: ServerEvent<'_>) {
        let source = SourceNetwork::new(client.ip());
        let line = self.lines.lock().line(source, Instant::now());
        match line {
            LineDecision::Tell { left_out } => {
                self.left_out(source, left_out);
                self.events.tell(event);
            }
            LineDecision::LastOne => self.events.tell(ServerEvent::ConnectionsQuiet { source }),
            LineDecision::Quiet => {}
        }
    }
}

impl fmt::Debug for AdmissionReporter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("AdmissionReporter").field("events", &self.events).finish_non_exhaustive()
    }
}
