//! The life of one force sensor monitor: RecordStart, header, data records, footer (manual 3.2.3.2, 4.1.2).
//!
//! Records are not stored: a record is a function of simulated time, and is calculated when it is read. The queue is the
//! range of numbers of the records that were produced and not read. The manual gives no size; [`CAPACITY`] records are kept,
//! and the header and the footer besides.

use super::snapshot::ChannelValues;
use super::status::{DataStatus, QueueStatus, RecordingStatus};
use super::time::CellTime;
use crate::records::force::{EndCondition, ForceDataType, ForceFooter, ForceHeader};

/// Data records that are kept for a client; from then on the oldest is overwritten.
pub(super) const CAPACITY: u64 = 2000;

/// Most data records in one read while DataNum is 0.
const USUAL_RECORDS: u64 = 1000;

/// One monitor, with the recording that was started last.
#[derive(Debug, Default)]
pub(super) struct ForceChannel {
    current: Option<(Recording, Unread)>,
    /// Something was overwritten before it was read, besides the records that the current recording has overwritten itself.
    overwritten: bool,
    /// The recording was broken off from outside: nothing more comes of it.
    broken: bool,
}

/// A recording whose data goes to OPC UA.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Recording {
    pub header: ForceHeader,
    /// Index of the robot that carries the sensor.
    pub robot: usize,
    pub data_type: ForceDataType,
    pub start: CellTime,
    /// Time between two records, in nanoseconds; not 0.
    pub interval: u64,
    /// When it ends, and why; as long as nothing else ends it, when its duration is over.
    pub end: End,
}

/// The end of a recording.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct End {
    pub time: CellTime,
    pub condition: EndCondition,
    /// Number of the controller's error, or 0.
    pub error: u16,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Unread {
    header: bool,
    /// Number of the next record to be read.
    next: u64,
    footer: bool,
}

/// What one read gives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ForceRead {
    Header(ForceHeader),
    /// `count` records from number `first` on; at least one.
    Data {
        recording: Recording,
        first: u64,
        count: u64,
    },
    Footer(Recording),
}

impl Recording {
    /// The moment of the record with this number.
    pub fn moment(&self, number: u64) -> CellTime {
        self.start.plus_nanos(number.saturating_mul(self.interval))
    }

    pub fn is_over(&self, now: CellTime) -> bool {
        now >= self.end.time
    }

    /// How many records there are `now`. The end itself is not part of the recording.
    fn produced(&self, now: CellTime) -> u64 {
        if self.is_over(now) {
            self.end.time.nanos_since(self.start).div_ceil(self.interval)
        } else {
            now.nanos_since(self.start) / self.interval + 1
        }
    }

    fn oldest(&self, now: CellTime) -> u64 {
        self.produced(now).saturating_sub(CAPACITY)
    }
}

impl ForceChannel {
    /// Begins a recording. What is left of an earlier one is overwritten.
    pub fn start(&mut self, recording: Recording) {
        self.overwritten = self
            .current
            .is_some_and(|(old, unread)| unread.header || unread.footer || unread.next < old.produced(recording.start));
        self.broken = false;
        self.current = Some((recording, Unread { header: true, next: 0, footer: true }));
    }

    /// Whether a recording runs.
    pub fn is_running(&self, now: CellTime) -> bool {
        self.current.is_some_and(|(recording, _)| !recording.is_over(now))
    }

    /// Ends the recording, if one runs.
    pub fn end(&mut self, end: End) {
        if let Some((recording, _)) = &mut self.current
            && !recording.is_over(end.time)
        {
            recording.end = end;
        }
    }

    /// Breaks the recording off: what was not read is lost, and no footer comes.
    pub fn break_off(&mut self) {
        self.current = None;
        self.broken = true;
    }

    /// The status nodes.
    pub fn values(&self, now: CellTime) -> ChannelValues {
        let Some((recording, unread)) = self.current else {
            let error = if self.broken { QueueStatus::Error } else { QueueStatus::None };
            return ChannelValues { error, ..ChannelValues::default() };
        };
        let is_over = recording.is_over(now);
        let is_ready = unread.header || unread.next < recording.produced(now) || (unread.footer && is_over);
        let error = if is_over && recording.end.condition == EndCondition::Error {
            QueueStatus::Error
        } else if self.overwritten || unread.next < recording.oldest(now) {
            QueueStatus::Warning
        } else {
            QueueStatus::None
        };
        ChannelValues {
            recording: if is_over { RecordingStatus::Stop } else { RecordingStatus::Run },
            data: if is_ready { DataStatus::Ready } else { DataStatus::Empty },
            error,
        }
    }

    /// Takes the next part out of the queue: the header, then data records, then the footer. `data_num` is the value of the
    /// node DataNum; more bytes than `max_bytes` are given only if a single packet is larger.
    pub fn read(&mut self, now: CellTime, data_num: u16, max_bytes: usize) -> Option<ForceRead> {
        let (recording, unread) = self.current.as_mut()?;
        if unread.header {
            unread.header = false;
            self.overwritten = false;
            return Some(ForceRead::Header(recording.header));
        }
        let first = unread.next.max(recording.oldest(now));
        let left = recording.produced(now).saturating_sub(first);
        if left > 0 {
            let wanted = if data_num == 0 { USUAL_RECORDS } else { data_num.into() };
            let fits = (max_bytes / recording.data_type.record_bytes()).max(1) as u64;
            let count = left.min(wanted).min(fits);
            unread.next = first + count;
            self.overwritten = false;
            return Some(ForceRead::Data { recording: *recording, first, count });
        }
        if unread.footer && recording.is_over(now) {
            unread.footer = false;
            self.overwritten = false;
            return Some(ForceRead::Footer(*recording));
        }
        None
    }

    /// From which moment on the past is needed for records that may still be read.
    pub fn needed_from(&self, now: CellTime) -> Option<CellTime> {
        let (recording, unread) = self.current.as_ref()?;
        let next = unread.next.max(recording.oldest(now));
        let is_complete = recording.is_over(now) && next >= recording.produced(now);
        (!is_complete).then(|| recording.moment(next))
    }

    /// The past before `time` is forgotten: unread records of it count as overwritten.
    pub fn skip_before(&mut self, time: CellTime) {
        if let Some((recording, unread)) = &mut self.current {
            let first = time.nanos_since(recording.start).div_ceil(recording.interval);
            if unread.next < first {
                unread.next = first;
                self.overwritten = true;
            }
        }
    }
}

/// The footer of a recording.
pub(super) fn footer(recording: &Recording, end: crate::records::ControllerTime) -> ForceFooter {
    let header = &recording.header.header;
    let length = recording.end.time.nanos_since(recording.start);
    ForceFooter {
        version: header.version,
        id: header.id,
        packet_version: header.packet_version,
        packet_type: header.packet_type,
        channel: header.channel,
        mode: header.mode,
        end,
        duration: (length as f64 * 1e-9) as f32,
        interval: header.interval,
        robot_no: header.robot_no,
        robot_name: header.robot_name,
        sensor_no: header.sensor_no,
        sensor_serial: header.sensor_serial,
        sensor_label: header.sensor_label,
        monitor_no: header.monitor_no,
        monitor_label: header.monitor_label,
        coordinate_no: header.coordinate_no,
        coordinate_label: header.coordinate_label,
        end_condition: recording.end.condition,
        // Error numbers have four digits.
        error_no: i16::try_from(recording.end.error).unwrap_or(i16::MAX),
        sequence_no: header.sequence_no,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MILLI: u64 = 1_000_000;

    fn recording(start: u64, millis: u64) -> Recording {
        let start = CellTime::from_millis(start);
        Recording {
            header: ForceHeader::default(),
            robot: 0,
            data_type: ForceDataType::Position,
            start,
            interval: 2 * MILLI,
            end: End { time: start.plus_nanos(millis * MILLI), condition: EndCondition::DurationElapsed, error: 0 },
        }
    }

    fn at(millis: u64) -> CellTime {
        CellTime::from_millis(millis)
    }

    /// What a reader gets that looks every `pace` milliseconds until there is a footer: header, numbers of the records,
    /// footer.
    fn read_all(channel: &mut ForceChannel, from: u64, pace: u64, data_num: u16) -> Vec<u64> {
        let mut now = from;
        assert!(matches!(channel.read(at(now), data_num, 65_536), Some(ForceRead::Header(_))));
        let mut numbers = Vec::new();
        loop {
            match channel.read(at(now), data_num, 65_536) {
                Some(ForceRead::Data { first, count, .. }) => numbers.extend(first..first + count),
                Some(ForceRead::Footer(_)) => return numbers,
                Some(ForceRead::Header(_)) => panic!("a second header"),
                None => now += pace,
            }
        }
    }

    #[test]
    fn a_reader_that_keeps_up_gets_everything_once() {
        for (pace, data_num) in [(1, 0), (50, 0), (3, 1), (500, 1000)] {
            let mut channel = ForceChannel::default();
            assert_eq!(channel.values(at(0)), ChannelValues::default());
            channel.start(recording(10, 3001));
            assert_eq!(channel.values(at(10)).recording, RecordingStatus::Run);
            let numbers = read_all(&mut channel, 10, pace, data_num);
            assert_eq!(numbers, (0..1501).collect::<Vec<_>>());
            let values = channel.values(at(60_000));
            assert_eq!(values, ChannelValues::default(), "Stop, Empty, None");
            assert_eq!((channel.read(at(60_000), 0, 100), channel.needed_from(at(60_000))), (None, None));
        }
    }

    #[test]
    fn overwriting_warns_until_the_next_read_of_data() {
        let mut channel = ForceChannel::default();
        channel.start(recording(0, 60_000));
        assert!(matches!(channel.read(at(0), 0, 0), Some(ForceRead::Header(_))));
        let full = 2 * CAPACITY - 2;
        assert_eq!(channel.values(at(full)).error, QueueStatus::None);
        assert_eq!(channel.values(at(full + 2)).error, QueueStatus::Warning);
        let Some(ForceRead::Data { first, count, .. }) = channel.read(at(full + 20), 0, usize::MAX) else { panic!() };
        assert_eq!((first, count), (10, 1000));
        assert_eq!(channel.values(at(full + 20)).error, QueueStatus::None);
    }

    #[test]
    fn a_read_gives_whole_records_of_one_kind_within_the_limits() {
        let mut channel = ForceChannel::default();
        channel.start(recording(0, 100));
        let mut counts = Vec::new();
        let mut kinds = Vec::new();
        while let Some(read) = channel.read(at(100), 20, 54 * 7 + 53) {
            kinds.push(std::mem::discriminant(&read));
            if let ForceRead::Data { count, .. } = read {
                counts.push(count);
            }
        }
        assert_eq!(counts, [7, 7, 7, 7, 7, 7, 7, 1]);
        kinds.dedup();
        assert_eq!(kinds.len(), 3);
        channel.start(recording(200, 100));
        channel.read(at(300), 0, 1);
        assert!(matches!(channel.read(at(300), 0, 1), Some(ForceRead::Data { count: 1, .. })));
    }

    #[test]
    fn a_new_recording_overwrites_what_is_left_of_the_last_one() {
        let mut channel = ForceChannel::default();
        channel.start(recording(0, 100));
        channel.start(recording(200, 100));
        assert_eq!(channel.values(at(200)).error, QueueStatus::Warning);
        assert!(channel.read(at(200), 0, 1000).is_some());
        assert_eq!(channel.values(at(200)).error, QueueStatus::None);
        read_all_data(&mut channel, 300);
        channel.start(recording(400, 100));
        assert_eq!(channel.values(at(400)).error, QueueStatus::None);
    }

    fn read_all_data(channel: &mut ForceChannel, millis: u64) {
        while channel.read(at(millis), 0, 65_536).is_some() {}
    }

    #[test]
    fn an_error_ends_with_a_footer_and_a_break_without() {
        let mut channel = ForceChannel::default();
        channel.start(recording(0, 10_000));
        channel.end(End { time: at(50), condition: EndCondition::Error, error: 5040 });
        channel.end(End { time: at(60), condition: EndCondition::RecordEnd, error: 0 });
        let ready =
            ChannelValues { recording: RecordingStatus::Stop, data: DataStatus::Ready, error: QueueStatus::Error };
        assert_eq!(channel.values(at(70)), ready);
        channel.read(at(70), 0, 65_536);
        assert!(matches!(channel.read(at(70), 0, 65_536), Some(ForceRead::Data { first: 0, count: 25, .. })));
        let Some(ForceRead::Footer(end)) = channel.read(at(70), 0, 65_536) else { panic!() };
        let end = footer(&end, Default::default());
        assert_eq!((end.end_condition, end.error_no, end.duration), (EndCondition::Error, 5040, 0.05));

        channel.start(recording(100, 10_000));
        channel.break_off();
        let broken = ChannelValues { error: QueueStatus::Error, ..ChannelValues::default() };
        assert_eq!((channel.values(at(120)), channel.read(at(120), 0, 65_536)), (broken, None));
        channel.start(recording(200, 10));
        assert_eq!(channel.values(at(200)).error, QueueStatus::None);
    }

    #[test]
    fn a_forgotten_past_counts_as_overwritten() {
        let mut channel = ForceChannel::default();
        channel.start(recording(0, 1000));
        assert_eq!(channel.needed_from(at(500)), Some(at(0)));
        channel.skip_before(at(101));
        assert_eq!(
            (channel.needed_from(at(500)), channel.values(at(500)).error),
            (Some(at(102)), QueueStatus::Warning)
        );
        channel.read(at(500), 0, 65_536);
        assert!(matches!(channel.read(at(500), 0, 65_536), Some(ForceRead::Data { first: 51, .. })));
    }
}
