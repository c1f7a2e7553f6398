use std::path::PathBuf;

use chrono::{DateTime, Duration, Utc};

use super::{Pane, PaneKind, TrustListEntry};
use crate::jobs::{TrustSnapshot, TrustUndo};
use crate::model::{DisconnectedClient, Feature, Problem};
use crate::pki::CrlIssuer;
use crate::texts::Zone;
use crate::ui::model::{JobId, RowId};

/// Which lists a dialog shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShownLists {
    /// Trusted, rejected, issuers (manual 2.7.3.1).
    Clients,
    /// CRLs (manual 2.7.3.4).
    Crls,
}

/// Whether what is shown is what the controller has now.
#[derive(Debug, Clone, PartialEq)]
pub enum Freshness {
    Reading,
    Live,
    /// It is tried again.
    Lost(Problem),
    /// It is not tried again by itself.
    Ended(Problem),
}

/// What was done last.
#[derive(Debug, Clone, PartialEq)]
pub enum LastTrustChange {
    Added(usize),
    Deleted { from: PaneKind, count: usize },
    Moved { from: PaneKind, to: PaneKind, count: usize },
    TakenBack,
}

/// The lists of one controller, and what was done to them since the dialog was opened.
#[derive(Debug)]
pub struct TrustForm {
    pub row: RowId,
    pub name: String,
    pub shows: ShownLists,
    pub link: Freshness,
    /// What was read last.
    pub held: Option<Box<TrustSnapshot>>,
    pub panes: Vec<Pane>,
    /// Index of the pane that has the keyboard.
    pub focus: usize,
    /// As it is typed.
    pub filter: String,
    /// A change is being made.
    pub busy: bool,
    pub done: Option<LastTrustChange>,
    /// Whose connections the last change ended.
    pub cut: Vec<DisconnectedClient>,
    /// The names of the authorities that no usable CRL is held of, in one line.
    pub without_crl: String,
    /// How far the controller's clock is ahead, if it matters.
    pub clock_off: Option<Duration>,
    pub(super) doing: Option<LastTrustChange>,
    /// What takes changes back, the last one at the end.
    pub(super) undo: Vec<TrustUndo>,
    pub(super) watch: Option<JobId>,
    /// Files to be added once the lists are known.
    pub(super) pending: Vec<PathBuf>,
    zone: Zone,
    /// When `held` was read.
    read_at: DateTime<Utc>,
    refreshed: DateTime<Utc>,
}

/// Certificates are judged by the controller's clock; a difference of so much is pointed out.
const CLOCK_TOLERANCE: Duration = Duration::minutes(5);

/// No read of the lists takes longer.
const LONGEST_READ: Duration = Duration::minutes(2);

impl TrustForm {
    pub fn new(row: RowId, name: String, shows: ShownLists, zone: Zone, now: DateTime<Utc>) -> Self {
        let kinds: &[PaneKind] = match shows {
            ShownLists::Clients => &[PaneKind::Trusted, PaneKind::Rejected, PaneKind::Issuers],
            ShownLists::Crls => &[PaneKind::Crls],
        };
        Self {
            row,
            name,
            shows,
            link: Freshness::Reading,
            held: None,
            panes: kinds.iter().map(|kind| Pane::new(*kind)).collect(),
            focus: 0,
            filter: String::new(),
            busy: false,
            done: None,
            cut: Vec::new(),
            without_crl: String::new(),
            clock_off: None,
            doing: None,
            undo: Vec::new(),
            watch: None,
            pending: Vec::new(),
            zone,
            read_at: now,
            refreshed: now,
        }
    }

    /// What the controller has now.
    pub fn fill(&mut self, held: Box<TrustSnapshot>, now: DateTime<Utc>) {
        // A change may answer sooner than a read that was begun before it. A larger difference is a clock that was set
        // back, and the lists are the newer ones.
        let is_stale = self.held.as_ref().is_some_and(|newer| {
            let behind = newer.clock - held.clock;
            newer.revision != held.revision && behind > Duration::zero() && behind < LONGEST_READ
        });
        if is_stale {
            return;
        }
        let mark_new = self.held.is_some();
        let (zone, clock) = (self.zone, held.clock);
        let ahead = held.clock - now;
        self.clock_off = (ahead.abs() > CLOCK_TOLERANCE).then_some(ahead);
        let name_of = |thumbprint: &str| {
            let mut authorities = held.trusted.iter().chain(&held.issuers);
            authorities.find(|listed| listed.summary.thumbprint == thumbprint).map(|l| l.summary.issued_to.clone())
        };
        let without_crl = held.health.without_crl.iter().filter_map(|thumbprint| name_of(thumbprint));
        self.without_crl = without_crl.collect::<Vec<_>>().join(", ");
        for pane in &mut self.panes {
            let listed = |list: &[crate::model::ListedCertificate]| -> Vec<TrustListEntry> {
                list.iter().map(|listed| TrustListEntry::listed(listed, zone, clock)).collect()
            };
            let (entries, limit) = match pane.kind {
                PaneKind::Trusted => (listed(&held.trusted), Some(held.limits.trusted)),
                PaneKind::Issuers => (listed(&held.issuers), Some(held.limits.issuers)),
                PaneKind::Rejected => {
                    (held.rejected.iter().map(|client| TrustListEntry::rejected(client, zone, clock)).collect(), None)
                }
                PaneKind::Crls => {
                    let entries = held.crls.iter().enumerate().map(|(at, listed)| {
                        let health = held.health.crls.get(at).cloned();
                        let covers = health.as_ref().and_then(|health| match &health.issuer {
                            CrlIssuer::Held { thumbprint } => name_of(thumbprint),
                            _ => None,
                        });
                        TrustListEntry::crl(listed, health, covers, zone, clock)
                    });
                    (entries.collect(), Some(held.limits.crls))
                }
            };
            pane.limit = limit;
            pane.fill(entries, mark_new);
        }
        if self.held.is_none() {
            self.focus = self.panes.iter().position(|pane| !pane.is_empty()).unwrap_or_default();
        }
        self.held = Some(held);
        (self.read_at, self.refreshed) = (now, now);
    }

    /// Brings words like "expired" up to date, at most once a minute.
    pub fn refresh_words(&mut self, now: DateTime<Utc>) {
        let Some(held) = &self.held else { return };
        if (now - self.refreshed).abs() < Duration::minutes(1) {
            return;
        }
        self.refreshed = now;
        let clock = held.clock + (now - self.read_at);
        self.panes.iter_mut().for_each(|pane| pane.refresh(clock));
    }

    /// Applies the filter; to be called when it has changed.
    pub fn find(&mut self) {
        let filter = &self.filter;
        self.panes.iter_mut().for_each(|pane| pane.set_filter(filter));
    }

    pub fn pane(&self, kind: PaneKind) -> Option<&Pane> {
        self.panes.iter().find(|pane| pane.kind == kind)
    }

    pub fn pane_mut(&mut self, kind: PaneKind) -> Option<&mut Pane> {
        self.panes.iter_mut().find(|pane| pane.kind == kind)
    }

    pub fn focused(&self) -> Option<&Pane> {
        self.panes.get(self.focus)
    }

    pub fn focused_mut(&mut self) -> Option<&mut Pane> {
        self.panes.get_mut(self.focus)
    }

    /// Gives the keyboard to the next pane, or the one before.
    pub fn move_focus(&mut self, by: isize) {
        let last = self.panes.len().saturating_sub(1);
        self.focus = self.focus.saturating_add_signed(by).min(last);
        if let Some(pane) = self.focused_mut()
            && pane.cursor().is_none()
        {
            pane.move_cursor(0);
        }
    }

    pub fn has_issuers(&self) -> bool {
        self.held.as_ref().is_none_or(|held| held.capabilities.offers(Feature::IssuersList))
    }

    /// How many changes can be taken back.
    pub fn undoable(&self) -> usize {
        self.undo.len()
    }

    /// Another change may be made now.
    pub fn is_ready(&self) -> bool {
        !self.busy && self.held.is_some()
    }
}
