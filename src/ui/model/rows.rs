use std::cmp::Ordering;
use std::collections::BTreeSet;

use chrono::{DateTime, Duration, Utc};

use crate::model::{Capabilities, CertificateType, ControllerInfo, Feature};
use crate::session;
use crate::ui::model::{LastResult, OverviewRead, RowState};
use crate::workspace::{ControllerEntry, RetrievedInfo};

/// A certificate that expires within this time is pointed out.
pub const EXPIRES_SOON: Duration = Duration::days(30);

/// A column of the table, in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Column {
    /// Name of the connection target.
    Name,
    /// Series of the controller.
    Type,
    /// Address of the management protocol.
    Address,
    /// Serial number.
    Serial,
    /// State of the OPC UA server.
    Status,
    /// Until when the server certificate is valid.
    Expiry,
    /// Type of the server certificate.
    Certificate,
    /// Whether the OPC UA function is activated.
    Activation,
    /// When the information was read.
    Retrieved,
}

impl Column {
    /// All columns in their built-in order.
    pub const ALL: [Self; 9] = [
        Self::Name,
        Self::Type,
        Self::Address,
        Self::Serial,
        Self::Status,
        Self::Expiry,
        Self::Certificate,
        Self::Activation,
        Self::Retrieved,
    ];

    /// The name the configuration remembers it by.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Name => "name",
            Self::Type => "type",
            Self::Address => "address",
            Self::Serial => "serial",
            Self::Status => "status",
            Self::Expiry => "expiry",
            Self::Certificate => "certificate",
            Self::Activation => "activation",
            Self::Retrieved => "retrieved",
        }
    }

    /// The column that the configuration file stores under this key.
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|column| column.key() == key)
    }
}

/// Names a row for as long as the window is open.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct RowId(u64);

/// How near the end of a certificate is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Expiry {
    /// It has expired.
    Past,
    /// It ends within [`EXPIRES_SOON`].
    Soon {
        /// Whole days that are left.
        days: i64,
    },
    /// It is valid for longer.
    Later,
}

impl Expiry {
    /// Of something that is good until `end`.
    pub fn of(end: DateTime<Utc>, now: DateTime<Utc>) -> Self {
        match end - now {
            left if left <= Duration::zero() => Self::Past,
            left if left < EXPIRES_SOON => Self::Soon { days: left.num_days() },
            _ => Self::Later,
        }
    }
}

/// A controller in the table.
#[derive(Debug)]
pub struct Row {
    /// Names the row.
    pub id: RowId,
    /// The controller as the configuration stores it.
    pub entry: ControllerEntry,
    /// Its address, as it is shown.
    pub address: String,
    /// Whether it is ticked.
    pub ticked: bool,
    /// Where the running job is with it.
    pub live: Option<RowState>,
    /// Of the jobs since the window was opened.
    pub last_result: Option<LastResult>,
    /// What the details pane read.
    pub overview: Option<OverviewRead>,
    /// Of the server certificate; `None` without one.
    pub expiry: Option<Expiry>,
    /// Lower case: what the search looks through.
    haystack: String,
    name_key: String,
}

impl Row {
    fn new(id: RowId, entry: ControllerEntry, now: DateTime<Utc>) -> Self {
        let mut row = Self {
            id,
            address: entry.address.to_string(),
            name_key: entry.name.as_str().to_lowercase(),
            entry,
            ticked: false,
            live: None,
            last_result: None,
            overview: None,
            expiry: None,
            haystack: String::new(),
        };
        row.refresh(now);
        row
    }

    /// What was read from the controller last.
    pub fn info(&self) -> Option<&ControllerInfo> {
        self.entry.last.as_ref().map(|last| &last.info)
    }

    /// What the controller offers, as far as its kind of connection and its latest information tell.
    pub fn capabilities(&self) -> Capabilities {
        session::capabilities(self.entry.connection, self.info())
    }

    /// The end of its server certificate.
    pub fn not_after(&self) -> Option<DateTime<Utc>> {
        self.info().and_then(|info| info.certificate.as_ref()).map(|certificate| certificate.summary.not_after)
    }

    /// The type of its server certificate.
    pub fn certificate_type(&self) -> Option<CertificateType> {
        self.info().and_then(|info| info.certificate.as_ref()).map(|certificate| certificate.kind)
    }

    fn serial(&self) -> Option<&str> {
        self.info().map(|info| info.serial.as_str())
    }

    fn refresh(&mut self, now: DateTime<Utc>) {
        self.haystack = format!(
            "{}\n{}\n{}\n{}",
            self.name_key,
            self.address,
            self.serial().unwrap_or_default(),
            self.entry.series.as_str()
        )
        .to_lowercase();
        self.refresh_expiry(now);
    }

    fn refresh_expiry(&mut self, now: DateTime<Utc>) {
        self.expiry = self.not_after().map(|end| Expiry::of(end, now));
    }

    fn compare(&self, other: &Self, column: Column) -> Ordering {
        let by_name = || natural(&self.name_key, &other.name_key);
        let order = match column {
            Column::Name => Ordering::Equal,
            Column::Type => self.entry.series.as_str().cmp(other.entry.series.as_str()),
            Column::Address => self.entry.address.sort_key().cmp(&other.entry.address.sort_key()),
            Column::Serial => self.serial().cmp(&other.serial()),
            Column::Status => self.info().map(|i| i.status).cmp(&other.info().map(|i| i.status)),
            Column::Expiry => self.not_after().cmp(&other.not_after()),
            Column::Certificate => self.certificate_type().cmp(&other.certificate_type()),
            Column::Activation => self.info().map(|i| i.activated).cmp(&other.info().map(|i| i.activated)),
            Column::Retrieved => self.entry.last.as_ref().map(|l| l.at).cmp(&other.entry.last.as_ref().map(|l| l.at)),
        };
        order.then_with(by_name)
    }
}

/// Runs of digits compare as numbers: "Weld 2" comes before "Weld 10".
fn natural(a: &str, b: &str) -> Ordering {
    let (mut a, mut b) = (a, b);
    loop {
        let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
        let (da, db) = (digits(a), digits(b));
        if da > 0 && db > 0 {
            let (na, nb) = (a[..da].trim_start_matches('0'), b[..db].trim_start_matches('0'));
            let order = na.len().cmp(&nb.len()).then_with(|| na.cmp(nb)).then_with(|| da.cmp(&db));
            if order != Ordering::Equal {
                return order;
            }
            (a, b) = (&a[da..], &b[db..]);
            continue;
        }
        match (a.chars().next(), b.chars().next()) {
            (Some(x), Some(y)) if x == y => (a, b) = (&a[x.len_utf8()..], &b[y.len_utf8()..]),
            (x, y) => return x.cmp(&y),
        }
    }
}

/// The table: its rows, what is ticked, and the cached order. Nothing here costs more than the visible rows in a frame.
#[derive(Debug)]
pub struct Rows {
    list: Vec<Row>,
    /// Indices into `list`, sorted.
    order: Vec<usize>,
    /// `order` without what the search hides.
    view: Vec<usize>,
    /// The column sorted by, and whether ascending; `None`: the order of the configuration.
    pub sort: Option<(Column, bool)>,
    filter: String,
    /// Position in the view.
    cursor: Option<usize>,
    /// Where a range of ticks starts.
    anchor: Option<RowId>,
    /// The table should scroll to the cursor.
    pub reveal: bool,
    ticked: usize,
    ticked_in_view: usize,
    expired: usize,
    expiring: usize,
    expiry_checked: DateTime<Utc>,
    next_id: u64,
}

impl Rows {
    /// The rows of a configuration. `now`: the time by this PC's clock.
    pub fn new(entries: Vec<ControllerEntry>, now: DateTime<Utc>) -> Self {
        let next_id = entries.len() as u64;
        let list = (0..).zip(entries).map(|(id, entry)| Row::new(RowId(id), entry, now)).collect();
        let mut rows = Self {
            list,
            order: Vec::new(),
            view: Vec::new(),
            sort: None,
            filter: String::new(),
            cursor: None,
            anchor: None,
            reveal: false,
            ticked: 0,
            ticked_in_view: 0,
            expired: 0,
            expiring: 0,
            expiry_checked: now,
            next_id,
        };
        rows.rebuild();
        rows
    }

    /// Every row, in the order they were added.
    pub fn all(&self) -> &[Row] {
        &self.list
    }

    /// Whether there is no row, shown or not.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// How many rows the filter lets through.
    pub fn shown(&self) -> usize {
        self.view.len()
    }

    /// The row at a position of the view.
    pub fn at(&self, position: usize) -> Option<&Row> {
        self.view.get(position).map(|index| &self.list[*index])
    }

    /// The row of this name.
    pub fn get(&self, id: RowId) -> Option<&Row> {
        self.list.iter().find(|row| row.id == id)
    }

    fn get_mut(&mut self, id: RowId) -> Option<&mut Row> {
        self.list.iter_mut().find(|row| row.id == id)
    }

    /// The text rows are filtered by.
    pub fn filter(&self) -> &str {
        &self.filter
    }

    /// Position of the cursor among the rows shown.
    pub fn cursor(&self) -> Option<usize> {
        self.cursor
    }

    /// How many rows are ticked, shown or not.
    pub fn ticked_count(&self) -> usize {
        self.ticked
    }

    /// Whether one of the ticked controllers is known not to offer this.
    pub fn any_ticked_lacks(&self, feature: Feature) -> bool {
        self.list.iter().any(|row| row.ticked && !row.capabilities().offers(feature))
    }

    /// How many ticked rows the filter hides.
    pub fn ticked_hidden(&self) -> usize {
        self.ticked - self.ticked_in_view
    }

    /// Whether every row shown is ticked, and there is one.
    pub fn all_shown_ticked(&self) -> bool {
        !self.view.is_empty() && self.ticked_in_view == self.view.len()
    }

    /// How many server certificates have expired.
    pub fn expired_count(&self) -> usize {
        self.expired
    }

    /// How many server certificates end within [`EXPIRES_SOON`].
    pub fn expiring_count(&self) -> usize {
        self.expiring
    }

    /// The ticked rows in table order, with those the search hides.
    pub fn ticked(&self) -> Vec<RowId> {
        self.order.iter().map(|i| &self.list[*i]).filter(|row| row.ticked).map(|row| row.id).collect()
    }

    /// The names of controllers, in the order of `ids`.
    pub fn names(&self, ids: &[RowId]) -> Vec<String> {
        ids.iter().filter_map(|id| self.get(*id)).map(|row| row.entry.name.to_string()).collect()
    }

    /// Adds a controller at the end of the list.
    pub fn add(&mut self, entry: ControllerEntry, now: DateTime<Utc>) -> RowId {
        let id = RowId(self.next_id);
        self.next_id += 1;
        self.list.push(Row::new(id, entry, now));
        self.rebuild();
        id
    }

    /// Many at once.
    /// Adds controllers, and ticks these and no others: the next command is for them.
    pub fn add_all_ticked(&mut self, entries: Vec<ControllerEntry>, now: DateTime<Utc>) {
        self.list.iter_mut().for_each(|row| row.ticked = false);
        for entry in entries {
            let id = RowId(self.next_id);
            self.next_id += 1;
            self.list.push(Row { ticked: true, ..Row::new(id, entry, now) });
        }
        self.rebuild();
    }

    /// The controller of a row was met; what it is called stays.
    pub fn confirm(&mut self, id: RowId, entry: ControllerEntry, now: DateTime<Utc>) {
        if let Some(row) = self.get_mut(id) {
            row.entry = entry;
            row.refresh(now);
        }
        self.rebuild();
    }

    /// Takes rows out and gives their entries back.
    pub fn remove(&mut self, ids: &[RowId]) -> Vec<ControllerEntry> {
        let (gone, kept) = std::mem::take(&mut self.list).into_iter().partition(|row| ids.contains(&row.id));
        self.list = kept;
        self.cursor = None;
        self.rebuild();
        gone.into_iter().map(|row: Row| row.entry).collect()
    }

    /// What was read from a controller. The order changes with [`Self::rebuild`] only, so that rows do not jump about
    /// while a job runs.
    pub fn set_info(&mut self, id: RowId, info: ControllerInfo, now: DateTime<Utc>) {
        if let Some(row) = self.get_mut(id) {
            row.entry.last = Some(RetrievedInfo { at: now, info });
            row.refresh(now);
        }
    }

    /// Says where a running job is with a controller; `None`: none is at work on it.
    pub fn set_live(&mut self, id: RowId, live: Option<RowState>) {
        if let Some(row) = self.get_mut(id) {
            row.live = live;
        }
    }

    /// Remembers how the last job ended for a controller.
    pub fn set_result(&mut self, id: RowId, result: LastResult) {
        if let Some(row) = self.get_mut(id) {
            row.last_result = Some(result);
        }
    }

    /// Remembers what was read for the details of a controller.
    pub fn set_overview(&mut self, id: RowId, overview: OverviewRead) {
        if let Some(row) = self.get_mut(id) {
            row.overview = Some(overview);
        }
    }

    /// Forgets where the job that ended was with each controller.
    pub fn clear_live(&mut self) {
        for row in &mut self.list {
            row.live = None;
        }
    }

    /// Ticks or unticks a row; with `range`, every row between it and the one ticked before gets the same.
    pub fn toggle(&mut self, id: RowId, range: bool) {
        let position_of = |id: RowId| self.view.iter().position(|i| self.list[*i].id == id);
        let position = position_of(id);
        match (range, self.anchor.and_then(position_of), position) {
            (true, Some(from), Some(to)) => {
                for index in &self.view[from.min(to)..=from.max(to)] {
                    self.list[*index].ticked = true;
                }
            }
            _ => {
                if let Some(row) = self.get_mut(id) {
                    row.ticked = !row.ticked;
                }
                self.anchor = Some(id);
            }
        }
        self.cursor = position;
        self.count();
    }

    /// Ticks a row.
    pub fn tick(&mut self, id: RowId) {
        if let Some(row) = self.get_mut(id) {
            row.ticked = true;
        }
        self.count();
    }

    /// Ticks this row and no other. Returns what was ticked before, for [`Rows::restore_ticks`].
    pub(in crate::ui) fn tick_only(&mut self, id: RowId) -> Vec<RowId> {
        let before = self.ticked();
        for row in &mut self.list {
            row.ticked = row.id == id;
        }
        self.count();
        before
    }

    pub(in crate::ui) fn restore_ticks(&mut self, ids: &[RowId]) {
        let ids: BTreeSet<&RowId> = ids.iter().collect();
        for row in &mut self.list {
            row.ticked = ids.contains(&row.id);
        }
        self.count();
    }

    /// Puts the cursor on a row that is shown.
    pub fn set_cursor(&mut self, id: RowId) {
        if let Some(position) = self.view.iter().position(|i| self.list[*i].id == id) {
            self.cursor = Some(position);
        }
    }

    /// The row under the cursor.
    pub fn at_cursor(&self) -> Option<&Row> {
        self.cursor.and_then(|at| self.at(at))
    }

    /// Ticks or unticks what the search shows; what it hides keeps its tick.
    pub fn tick_shown(&mut self, on: bool) {
        for index in &self.view {
            self.list[*index].ticked = on;
        }
        self.count();
    }

    /// Sorts by a column, ascending; by the column that is sorted by already: in the other direction.
    pub fn sort_by(&mut self, column: Column) {
        let ascending = !matches!(self.sort, Some((same, true)) if same == column);
        self.sort = Some((column, ascending));
        self.rebuild();
    }

    /// Shows only the rows that hold this text, and takes the cursor away.
    pub fn set_filter(&mut self, filter: String) {
        self.filter = filter;
        self.cursor = None;
        self.rebuild();
    }

    /// Moves the cursor by so many rows shown, negative: upwards. It stays within them.
    pub fn move_cursor(&mut self, by: isize) {
        let Some(last) = self.view.len().checked_sub(1) else { return };
        let next = match self.cursor {
            None => 0,
            Some(at) => at.saturating_add_signed(by).min(last),
        };
        self.cursor = Some(next);
        self.reveal = true;
    }

    /// Ticks or unticks the row under the cursor.
    pub fn toggle_cursor(&mut self) {
        if let Some(id) = self.cursor.and_then(|at| self.at(at)).map(|row| row.id) {
            self.toggle(id, false);
        }
    }

    /// Brings words like "expired" up to date, at most once a minute.
    pub fn refresh_expiry(&mut self, now: DateTime<Utc>) {
        if (now - self.expiry_checked).abs() < Duration::minutes(1) {
            return;
        }
        self.expiry_checked = now;
        for row in &mut self.list {
            row.refresh_expiry(now);
        }
        self.count();
    }

    /// Sorts and filters anew. The cursor stays on its row.
    pub fn rebuild(&mut self) {
        let on = self.cursor.and_then(|at| self.at(at)).map(|row| row.id);
        let list = &self.list;
        self.order = (0..list.len()).collect();
        if let Some((column, ascending)) = self.sort {
            self.order.sort_by(|a, b| {
                let order = list[*a].compare(&list[*b], column);
                if ascending { order } else { order.reverse() }
            });
        }
        let needle = self.filter.trim().to_lowercase();
        self.view = self.order.iter().copied().filter(|i| list[*i].haystack.contains(&needle)).collect();
        self.cursor = on.and_then(|id| self.view.iter().position(|i| list[*i].id == id));
        self.count();
    }

    fn count(&mut self) {
        let count = |what: &dyn Fn(&Row) -> bool| self.list.iter().filter(|row| what(row)).count();
        let expired = count(&|row| row.expiry == Some(Expiry::Past));
        let expiring = count(&|row| matches!(row.expiry, Some(Expiry::Soon { .. })));
        let ticked = count(&|row| row.ticked);
        (self.expired, self.expiring, self.ticked) = (expired, expiring, ticked);
        self.ticked_in_view = self.view.iter().filter(|i| self.list[**i].ticked).count();
    }
}
