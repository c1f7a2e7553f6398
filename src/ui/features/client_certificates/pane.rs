use std::collections::{BTreeSet, HashMap};

use chrono::{DateTime, Utc};

use super::{RejectionDetails, TrustColumn, TrustListEntry};
use crate::jobs::{Destination, TargetList};
use crate::model::ClientList;

/// What a list is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PaneKind {
    Trusted,
    Rejected,
    Issuers,
    Crls,
}

impl PaneKind {
    /// `None` for CRLs.
    pub const fn list(self) -> Option<ClientList> {
        match self {
            Self::Trusted => Some(ClientList::Trusted),
            Self::Rejected => Some(ClientList::Rejected),
            Self::Issuers => Some(ClientList::Issuers),
            Self::Crls => None,
        }
    }

    /// Where files go that are added here. The controller alone fills its list of refused clients.
    pub const fn destination(self) -> Option<Destination> {
        match self {
            Self::Trusted => Some(Destination::Trusted),
            Self::Issuers => Some(Destination::Issuers),
            Self::Crls => Some(Destination::Crls),
            Self::Rejected => None,
        }
    }

    pub const fn of(target: TargetList) -> Self {
        match target {
            TargetList::Trusted => Self::Trusted,
            TargetList::Issuers => Self::Issuers,
            TargetList::Crls => Self::Crls,
        }
    }

    /// In the order they are shown.
    pub const fn columns(self) -> &'static [TrustColumn] {
        use TrustColumn as C;
        match self {
            Self::Trusted | Self::Issuers => {
                &[C::IssuedTo, C::ValidUntil, C::IssuedBy, C::FileName, C::SerialNumber, C::ValidFrom, C::Thumbprint]
            }
            Self::Rejected => &[
                C::IssuedTo,
                C::Reason,
                C::Address,
                C::Count,
                C::LastSeen,
                C::FirstSeen,
                C::ValidUntil,
                C::IssuedBy,
                C::SerialNumber,
                C::ValidFrom,
                C::Thumbprint,
            ],
            Self::Crls => {
                &[C::Issuer, C::Health, C::ThisUpdate, C::NextUpdate, C::Entries, C::Number, C::FileName, C::Thumbprint]
            }
        }
    }
}

/// One list: its lines, what is ticked, and the order they are shown in. Nothing here costs more than the lines in
/// sight in a frame.
#[derive(Debug)]
pub struct Pane {
    pub kind: PaneKind,
    /// How many the controller takes; `None` for the list it keeps by itself.
    pub limit: Option<usize>,
    entries: Vec<TrustListEntry>,
    /// Indices into `entries`: sorted, and without what the filter hides.
    view: Vec<usize>,
    pub sort: (TrustColumn, bool),
    needle: String,
    ticked: BTreeSet<String>,
    ticked_shown: usize,
    /// Position in the view.
    cursor: Option<usize>,
    /// Where a range of ticks starts.
    anchor: Option<String>,
    /// The list should scroll to the cursor.
    pub reveal: bool,
    new: usize,
}

impl Pane {
    pub fn new(kind: PaneKind) -> Self {
        let sort = match kind {
            PaneKind::Trusted | PaneKind::Issuers => (TrustColumn::IssuedTo, true),
            PaneKind::Rejected => (TrustColumn::LastSeen, false),
            PaneKind::Crls => (TrustColumn::Issuer, true),
        };
        Self {
            kind,
            limit: None,
            entries: Vec::new(),
            view: Vec::new(),
            sort,
            needle: String::new(),
            ticked: BTreeSet::new(),
            ticked_shown: 0,
            cursor: None,
            anchor: None,
            reveal: false,
            new: 0,
        }
    }

    /// What the controller has now. Ticks and the cursor stay with their entries; `mark_new`: what was not there before
    /// is pointed out.
    pub fn fill(&mut self, mut entries: Vec<TrustListEntry>, mark_new: bool) {
        let held: HashMap<&str, &RejectionDetails> =
            self.entries.iter().filter_map(|entry| Some((entry.id.as_str(), entry.refusal.as_ref()?))).collect();
        for entry in &mut entries {
            let before = held.get(entry.id.as_str());
            if let Some(refusal) = &mut entry.refusal {
                // One that a person put here has not come.
                let came_again = refusal.count > before.map_or(0, |before| before.count);
                refusal.is_new = before.is_some_and(|before| before.is_new) || (mark_new && came_again);
            }
        }
        let on = self.cursor_entry().map(|entry| entry.id.clone());
        self.entries = entries;
        let held: BTreeSet<&str> = self.entries.iter().map(|entry| entry.id.as_str()).collect();
        self.ticked.retain(|id| held.contains(id.as_str()));
        self.rebuild(on.as_deref());
    }

    pub fn set_filter(&mut self, filter: &str) {
        self.needle = filter.trim().to_lowercase();
        let on = self.cursor_entry().map(|entry| entry.id.clone());
        self.rebuild(on.as_deref());
    }

    pub fn sort_by(&mut self, column: TrustColumn) {
        let ascending = !matches!(self.sort, (same, true) if same == column);
        self.sort = (column, ascending);
        let on = self.cursor_entry().map(|entry| entry.id.clone());
        self.rebuild(on.as_deref());
    }

    pub fn refresh(&mut self, now: DateTime<Utc>) {
        self.entries.iter_mut().for_each(|entry| entry.refresh(now));
    }

    fn rebuild(&mut self, on: Option<&str>) {
        let (entries, needle) = (&self.entries, &self.needle);
        self.view = (0..entries.len()).filter(|at| entries[*at].haystack.contains(needle.as_str())).collect();
        let (column, ascending) = self.sort;
        self.view.sort_by(|a, b| {
            let order = entries[*a].compare(&entries[*b], column);
            if ascending { order } else { order.reverse() }
        });
        let place = on.and_then(|id| self.view.iter().position(|at| entries[*at].id == id));
        // The line below takes the place of one that is gone.
        self.cursor = place.or_else(|| self.cursor.zip(self.view.len().checked_sub(1)).map(|(at, last)| at.min(last)));
        self.count();
    }

    fn count(&mut self) {
        self.ticked_shown = self.view.iter().filter(|at| self.ticked.contains(&self.entries[**at].id)).count();
        let is_new = |entry: &&TrustListEntry| entry.refusal.as_ref().is_some_and(|refusal| refusal.is_new);
        self.new = self.entries.iter().filter(is_new).count();
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// How many the filter lets through.
    pub fn shown(&self) -> usize {
        self.view.len()
    }

    pub fn is_full(&self) -> bool {
        self.limit.is_some_and(|limit| self.len() >= limit)
    }

    /// How many came while the list was not looked at.
    pub fn new_ones(&self) -> usize {
        self.new
    }

    /// A line the filter lets through.
    pub fn at(&self, position: usize) -> Option<&TrustListEntry> {
        self.view.get(position).map(|at| &self.entries[*at])
    }

    pub fn cursor(&self) -> Option<usize> {
        self.cursor
    }

    pub fn cursor_entry(&self) -> Option<&TrustListEntry> {
        self.cursor.and_then(|at| self.at(at))
    }

    pub fn is_ticked(&self, id: &str) -> bool {
        self.ticked.contains(id)
    }

    pub fn ticked_count(&self) -> usize {
        self.ticked.len()
    }

    pub fn ticked_hidden(&self) -> usize {
        self.ticked.len() - self.ticked_shown
    }

    pub fn all_shown_ticked(&self) -> bool {
        !self.view.is_empty() && self.ticked_shown == self.view.len()
    }

    /// What an action is about: what is ticked, or else what the cursor is on.
    pub fn chosen(&self) -> Vec<&TrustListEntry> {
        if self.ticked.is_empty() {
            return self.cursor_entry().into_iter().collect();
        }
        let mut chosen: Vec<&TrustListEntry> =
            self.entries.iter().filter(|entry| self.ticked.contains(&entry.id)).collect();
        chosen.sort_by(|a, b| a.compare(b, self.sort.0));
        chosen
    }

    pub fn toggle(&mut self, position: usize, range: bool) {
        let Some(id) = self.at(position).map(|entry| entry.id.clone()) else { return };
        let from =
            self.anchor.as_ref().and_then(|anchor| self.view.iter().position(|at| self.entries[*at].id == *anchor));
        match (range, from) {
            (true, Some(from)) => {
                for at in &self.view[from.min(position)..=from.max(position)] {
                    self.ticked.insert(self.entries[*at].id.clone());
                }
            }
            _ => {
                if !self.ticked.remove(&id) {
                    self.ticked.insert(id.clone());
                }
                self.anchor = Some(id);
            }
        }
        self.place_cursor(position);
    }

    /// Ticks or unticks what the filter shows; what it hides keeps its tick.
    pub fn tick_shown(&mut self, on: bool) {
        for at in &self.view {
            let id = &self.entries[*at].id;
            if on {
                self.ticked.insert(id.clone());
            } else {
                self.ticked.remove(id);
            }
        }
        self.count();
    }

    pub fn untick(&mut self) {
        self.ticked.clear();
        self.count();
    }

    /// What the cursor is on has been looked at.
    pub fn place_cursor(&mut self, position: usize) {
        self.cursor = Some(position.min(self.view.len().saturating_sub(1)));
        if let Some(at) = self.view.get(position)
            && let Some(refusal) = &mut self.entries[*at].refusal
        {
            refusal.is_new = false;
        }
        self.count();
    }

    /// By lines of the view; clamped.
    pub fn move_cursor(&mut self, by: isize) {
        let Some(last) = self.view.len().checked_sub(1) else { return };
        let next = self.cursor.map_or(0, |at| at.saturating_add_signed(by).min(last));
        self.place_cursor(next);
        self.reveal = true;
    }
}
