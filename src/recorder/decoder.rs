use chrono::{DateTime, Utc};

use super::journal::Entry;
use super::live::RowBatch;
use super::settings::{RecordSettings, Source};
use super::sidecar::{ForceRecording, Gap, GapCause, TimeBase};
use crate::records::columns::Column;
use crate::records::force::{
    ForceAssembly, ForceColumns, ForceDataType, ForceEvent, ForceFooter, ForceHeader, ForceRead,
};
use crate::records::motion::{MotionColumns, MotionRead};
use crate::records::{ControllerTime, Ticks};

/// Makes columns of the entries of a recording, and notices what is missing.
#[derive(Debug)]
pub struct Decoder {
    data: Data,
    /// Why the next packet may not follow the one before.
    interrupted: Option<GapCause>,
    facts: Facts,
}

/// What is known of a recording so far.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Facts {
    /// Rows, the columns included that were cleared.
    pub rows: u64,
    pub packets: u64,
    /// Bytes of the packets.
    pub bytes: u64,
    /// Seconds of the controller's time that the samples span.
    pub seconds: f64,
    pub undecodable: u64,
    pub time_base: Option<TimeBase>,
    pub gaps: Vec<Gap>,
    pub recordings: Vec<ForceRecording>,
}

#[derive(Debug)]
enum Data {
    Force { data_type: ForceDataType, columns: Box<ForceColumns>, assembly: ForceAssembly, elapsed: Option<u32> },
    Motion { columns: Box<MotionColumns>, last: Option<LastBlock>, period: Option<u64> },
}

/// The block before, in ticks.
#[derive(Debug, Clone, Copy)]
struct LastBlock {
    first: u64,
    last: u64,
}

/// More gaps than this become one with the last: a recording with so many has no use for the list.
const MAX_GAPS: usize = 10_000;

impl Decoder {
    /// For a recording with these settings.
    pub fn new(settings: &RecordSettings) -> Self {
        let data = match settings.source() {
            Source::Force { data_type, .. } => {
                Data::Force { data_type, columns: Box::default(), assembly: ForceAssembly::default(), elapsed: None }
            }
            Source::Motion { .. } => Data::Motion { columns: Box::default(), last: None, period: None },
        };
        Self { data, interrupted: None, facts: Facts::default() }
    }

    /// Takes in an entry that came at `at`.
    pub fn push(&mut self, at: DateTime<Utc>, entry: &Entry) {
        match entry {
            Entry::Packet { bytes, overwritten } => {
                if *overwritten {
                    self.interrupted = Some(GapCause::Overwritten);
                }
                self.packet(at, bytes);
            }
            Entry::BrokenOff => self.interrupted = Some(GapCause::BrokenOff),
            Entry::ConnectionLost(_) => self.interrupted = Some(GapCause::ConnectionLost),
            Entry::End(_) => {
                if let Some(cause) = self.interrupted.take() {
                    self.gap(self.no_gap(cause, at));
                }
            }
        }
    }

    fn packet(&mut self, at: DateTime<Utc>, bytes: &[u8]) {
        self.facts.packets += 1;
        self.facts.bytes += bytes.len() as u64;
        let decoded = match &self.data {
            Data::Force { .. } => ForceRead::decode(bytes).map(|read| self.force(at, read)),
            Data::Motion { .. } => MotionRead::decode(bytes).map(|read| self.motion(at, read)),
        };
        if let Err(error) = decoded {
            tracing::warn!(%error, "a packet is not in the file");
            self.facts.undecodable += 1;
            self.gap(Gap { missing: None, ..self.no_gap(GapCause::Undecodable, at) });
        } else if let Some(cause) = self.interrupted.take() {
            // Interrupted, and nothing is missing.
            self.gap(Gap { missing: Some(0), ..self.no_gap(cause, at) });
        }
    }

    fn force(&mut self, at: DateTime<Utc>, read: ForceRead<'_>) {
        let Data::Force { data_type, columns, assembly, elapsed } = &mut self.data else { return };
        let is_odd = matches!(read, ForceRead::Data(records) if records.data_type() != *data_type);
        if is_odd {
            tracing::warn!("another client has changed the DataType");
            self.facts.undecodable += 1;
            return self.gap(Gap { missing: None, ..self.no_gap(GapCause::Undecodable, at) });
        }
        let events = assembly.push(read, columns);
        let id = read.id();
        if let ForceRead::Data(records) = read {
            let times = [0, records.len() - 1].map(|index| records.head(index).map_or(0, |head| head.elapsed()));
            self.facts.seconds += f64::from(times[1].saturating_sub(elapsed.unwrap_or(times[0]))) / 1000.0;
            *elapsed = Some(times[1]);
        } else {
            *elapsed = None;
        }
        for event in events {
            match event {
                ForceEvent::Started(header) => {
                    if let (Some(ticks), None) = (header.record_start, self.facts.time_base) {
                        self.facts.time_base = Some(TimeBase::new(ticks, at));
                    }
                    self.facts.recordings.push(started(&header));
                }
                ForceEvent::HeaderMissing { .. } => {
                    self.facts.recordings.push(unknown(id));
                    let cause = self.interrupted.take().unwrap_or(GapCause::Unexplained);
                    self.gap(Gap { missing: None, ..self.no_gap(cause, at) });
                }
                ForceEvent::FooterMissing { .. } => {
                    let cause = self.interrupted.take().unwrap_or(GapCause::Unexplained);
                    self.gap(Gap { missing: None, ..self.no_gap(cause, at) });
                }
                ForceEvent::Lost { after, missing } => {
                    let cause = self.interrupted.take().unwrap_or(GapCause::Unexplained);
                    let until = u64::from(after) + u64::from(missing) + 1;
                    let (after, missing) = (Some(after.into()), Some(missing.into()));
                    self.gap(Gap { after, until: Some(until), missing, ..self.no_gap(cause, at) });
                }
                ForceEvent::Records { count } => self.facts.rows += count as u64,
                ForceEvent::Ended(footer) => {
                    if let Some(recording) = self.facts.recordings.iter_mut().rev().find(|known| known.id == id) {
                        ended(recording, &footer);
                    }
                }
            }
        }
    }

    fn motion(&mut self, at: DateTime<Utc>, read: MotionRead<'_>) {
        let Data::Motion { columns, last, period } = &mut self.data else { return };
        let mut gaps = Vec::new();
        for (index, block) in read.blocks().enumerate() {
            let (Some(Ticks(first)), Some(Ticks(end))) = (block.first_timestamp(), block.last_timestamp()) else {
                continue;
            };
            if let Some(before) = *last {
                let step = first.saturating_sub(before.first);
                let found = |cause, missing| (index, cause, before.last, first, missing);
                if first <= before.first {
                    gaps.push(found(GapCause::ControllerRestarted, None));
                    self.interrupted = None;
                } else if let Some(period) = *period
                    && step > period + period / 2
                {
                    let cause = self.interrupted.take().unwrap_or(GapCause::Unexplained);
                    gaps.push(found(cause, Some((step + period / 2) / period - 1)));
                } else if self.interrupted.is_none() {
                    *period = Some(period.map_or(step, |known| known.min(step)));
                    self.facts.seconds += Ticks(step).seconds();
                }
            } else {
                self.facts.time_base = Some(TimeBase::new(Ticks(first), at));
            }
            *last = Some(LastBlock { first, last: end });
        }
        columns.extend(read);
        for (index, cause, after, until, missing) in gaps {
            let at_row = self.facts.rows + 8 * index as u64;
            let gap = self.no_gap(cause, at);
            self.gap(Gap { after: Some(after), until: Some(until), missing, at_row, ..gap });
        }
        self.facts.rows += 8 * read.len() as u64;
    }

    fn no_gap(&self, cause: GapCause, noticed_at: DateTime<Utc>) -> Gap {
        Gap { cause, noticed_at, after: None, until: None, missing: None, at_row: self.facts.rows }
    }

    fn gap(&mut self, gap: Gap) {
        let is_full = self.facts.gaps.len() >= MAX_GAPS;
        match self.facts.gaps.last_mut() {
            Some(last) if is_full => {
                last.until = gap.until;
                last.missing = match (last.missing, gap.missing) {
                    (Some(one), Some(more)) => Some(one + more),
                    (one, more) => one.or(more),
                };
            }
            _ => self.facts.gaps.push(gap),
        }
    }

    /// The columns since the last [`Decoder::clear`].
    pub fn columns(&self) -> Vec<Column<'_>> {
        match &self.data {
            Data::Force { data_type, columns, .. } => columns.columns(*data_type),
            Data::Motion { columns, .. } => columns.columns(),
        }
    }

    /// Rows of the columns since the last [`Decoder::clear`].
    pub const fn rows(&self) -> usize {
        match &self.data {
            Data::Force { columns, .. } => columns.rows(),
            Data::Motion { columns, .. } => columns.rows(),
        }
    }

    /// The rows of these columns, which are those since the last [`Decoder::clear`].
    pub fn batch<'a>(&'a self, columns: &'a [Column<'a>]) -> RowBatch<'a> {
        let rows = self.rows();
        RowBatch {
            columns,
            first_row: self.facts.rows - rows as u64,
            rows,
            gaps: &self.facts.gaps,
            first_ticks: self.facts.time_base.map(|base| base.first_ticks),
        }
    }

    /// Forgets the values of the columns, once they are written.
    pub fn clear(&mut self) {
        match &mut self.data {
            Data::Force { columns, .. } => columns.clear(),
            Data::Motion { columns, .. } => columns.clear(),
        }
    }

    /// What is known of the recording so far.
    pub const fn facts(&self) -> &Facts {
        &self.facts
    }
}

fn unknown(id: u16) -> ForceRecording {
    ForceRecording {
        id,
        started: None,
        ended: None,
        interval: None,
        record_start_ticks: None,
        robot_no: None,
        robot_name: None,
        sensor_no: None,
        sensor_serial: None,
        sensor_label: None,
        file_name: None,
        end_condition: None,
        error_no: None,
    }
}

fn started(start: &ForceHeader) -> ForceRecording {
    let ForceHeader { header, record_start } = start;
    ForceRecording {
        started: time(header.start),
        interval: Some(header.interval).filter(|interval| interval.is_finite()),
        record_start_ticks: record_start.map(|ticks| ticks.0),
        robot_no: Some(header.robot_no),
        robot_name: Some(header.robot_name.to_string()),
        sensor_no: Some(header.sensor_no),
        sensor_serial: Some(header.sensor_serial.to_string()),
        sensor_label: Some(header.sensor_label.to_string()),
        file_name: Some(header.file_name.to_string()),
        ..unknown(header.id)
    }
}

fn ended(recording: &mut ForceRecording, footer: &ForceFooter) {
    recording.ended = time(footer.end);
    recording.end_condition = Some(footer.end_condition.number());
    recording.error_no = Some(footer.error_no);
}

fn time(time: ControllerTime) -> Option<String> {
    time.to_date_time().map(|time| time.format("%Y-%m-%dT%H:%M:%S%.3f").to_string())
}
