//! The life of the motion log's channel (manual 3.2.3.4, 4.3.2): it logs from power-on, and the last blocks can be read.
//!
//! As with the force sensor, blocks are functions of simulated time and are calculated when they are read. The manual states
//! neither the time between two samples nor how many blocks are kept: here a sample is taken every 0.5 ms at SamplingInterval
//! 0, so a block of eight spans 4 ms, and [`CAPACITY`] blocks are kept.

use super::snapshot::ChannelValues;
use super::status::{DataStatus, QueueStatus, RecordingStatus};
use super::time::CellTime;
use crate::records::motion::{BLOCK_BYTES, MAX_BLOCKS_PER_READ, SAMPLES};

/// Blocks that are kept for a client; from then on the oldest is overwritten.
pub(super) const CAPACITY: u64 = 500;

/// Time between two samples at SamplingInterval 0.
pub(super) const SAMPLE_NANOS: u64 = 500_000;

/// The only channel of the motion log.
#[derive(Debug)]
pub(super) struct MotionChannel {
    start: CellTime,
    end: Option<CellTime>,
    /// Time between two samples, in nanoseconds.
    interval: u64,
    /// Number of the next block to be read.
    next: u64,
    /// A client reads: from its first read on, what is overwritten before it was read is a loss.
    reading: bool,
    overwritten: bool,
    broken: bool,
}

/// What one read gives: `count` blocks from number `first` on; at least one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct MotionRead {
    pub first: u64,
    pub count: u64,
}

impl MotionChannel {
    /// Logs from `start` on.
    pub const fn new(start: CellTime, sampling_interval: u16) -> Self {
        Self {
            start,
            end: None,
            interval: SAMPLE_NANOS << sampling_interval,
            next: 0,
            reading: false,
            overwritten: false,
            broken: false,
        }
    }

    /// Stops logging. What was logged can still be read.
    pub fn stop(&mut self, now: CellTime) {
        self.end.get_or_insert(now);
    }

    /// Logging breaks off: what was not read is lost.
    pub fn break_off(&mut self, now: CellTime) {
        self.stop(now);
        self.next = self.produced(now);
        self.broken = true;
    }

    pub const fn is_running(&self) -> bool {
        self.end.is_none()
    }

    /// The moment of sample `sample`, 0 to 7, of a block. The first sample is one interval after the start, so that no time
    /// stamp is 0, which would mean no data.
    pub fn moment(&self, block: u64, sample: u64) -> CellTime {
        let samples = block.saturating_mul(SAMPLES as u64).saturating_add(sample + 1);
        self.start.plus_nanos(samples.saturating_mul(self.interval))
    }

    fn produced(&self, now: CellTime) -> u64 {
        let until = self.end.map_or(now, |end| end.min(now));
        until.nanos_since(self.start) / (self.interval * SAMPLES as u64)
    }

    fn oldest(&self, now: CellTime) -> u64 {
        self.produced(now).saturating_sub(CAPACITY)
    }

    /// The status nodes.
    pub fn values(&self, now: CellTime) -> ChannelValues {
        let is_lossy = self.reading && (self.overwritten || self.next < self.oldest(now));
        ChannelValues {
            recording: if self.is_running() { RecordingStatus::Run } else { RecordingStatus::Stop },
            data: if self.next < self.produced(now) { DataStatus::Ready } else { DataStatus::Empty },
            error: match (self.broken, is_lossy) {
                (true, _) => QueueStatus::Error,
                (false, true) => QueueStatus::Warning,
                (false, false) => QueueStatus::None,
            },
        }
    }

    /// Takes the next blocks out of the queue. `data_num` is the value of the node DataNum; more bytes than `max_bytes` are
    /// given only if a single block is larger.
    pub fn read(&mut self, now: CellTime, data_num: u16, max_bytes: usize) -> Option<MotionRead> {
        let first = self.next.max(self.oldest(now));
        let left = self.produced(now).saturating_sub(first);
        if left == 0 {
            return None;
        }
        let wanted = if data_num == 0 { MAX_BLOCKS_PER_READ as u64 } else { data_num.into() };
        let count = left.min(wanted).min((max_bytes / BLOCK_BYTES).max(1) as u64);
        self.next = first + count;
        self.reading = true;
        self.overwritten = false;
        Some(MotionRead { first, count })
    }

    /// From which moment on the past is needed for blocks that may still be read.
    pub fn needed_from(&self, now: CellTime) -> Option<CellTime> {
        let next = self.next.max(self.oldest(now));
        (self.is_running() || next < self.produced(now)).then(|| self.moment(next, 0))
    }

    /// The past before `time` is forgotten: unread blocks of it count as overwritten.
    pub fn skip_before(&mut self, time: CellTime) {
        let first = time.nanos_since(self.start).div_ceil(self.interval * SAMPLES as u64);
        if self.next < first {
            self.next = first;
            self.overwritten = true;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(millis: u64) -> CellTime {
        CellTime::from_millis(millis)
    }

    #[test]
    fn blocks_follow_each_other_without_a_gap() {
        for interval in 0..=4 {
            let mut channel = MotionChannel::new(at(7), interval);
            let mut expected = at(7).nanos();
            let mut next = 0;
            for look in 1..2000 {
                while let Some(MotionRead { first, count }) = channel.read(at(7 + look * 10), 3, usize::MAX) {
                    assert_eq!(first, next);
                    next = first + count;
                    for (block, sample) in (first..next).flat_map(|block| (0..8).map(move |sample| (block, sample))) {
                        expected += SAMPLE_NANOS << interval;
                        assert_eq!(channel.moment(block, sample).nanos(), expected);
                    }
                    assert!(expected <= at(7 + look * 10).nanos(), "a sample of the future");
                }
                assert_eq!(channel.values(at(7 + look * 10)).error, QueueStatus::None);
            }
            assert!(at(7 + 19_990).nanos() - expected < 8 * (SAMPLE_NANOS << interval));
        }
    }

    #[test]
    fn only_a_reader_that_is_too_slow_is_warned() {
        let mut channel = MotionChannel::new(at(0), 0);
        assert_eq!(channel.values(at(3)).data, DataStatus::Empty);
        assert_eq!(channel.read(at(3), 0, usize::MAX), None);
        // Nobody reads yet: the oldest blocks go without a warning.
        let idle = channel.values(at(60_000));
        assert_eq!(
            (idle.recording, idle.data, idle.error),
            (RecordingStatus::Run, DataStatus::Ready, QueueStatus::None)
        );
        assert_eq!(channel.read(at(60_000), 0, usize::MAX), Some(MotionRead { first: 14_500, count: 200 }));
        assert_eq!(channel.read(at(60_000), 50, usize::MAX), Some(MotionRead { first: 14_700, count: 50 }));
        assert_eq!(channel.read(at(60_000), 50, BLOCK_BYTES * 2 + 1), Some(MotionRead { first: 14_750, count: 2 }));
        assert_eq!(channel.read(at(60_000), 50, 1), Some(MotionRead { first: 14_752, count: 1 }));
        let last = (14_753 + CAPACITY) * 4;
        assert_eq!(channel.values(at(last)).error, QueueStatus::None);
        assert_eq!(channel.values(at(last + 4)).error, QueueStatus::Warning);
        assert_eq!(channel.read(at(last + 4), 1, usize::MAX), Some(MotionRead { first: 14_754, count: 1 }));
        assert_eq!(channel.values(at(last + 4)).error, QueueStatus::None);
    }

    /// A day at the shortest interval, by a reader whose pauses are of any length up to twice what the queue holds.
    #[test]
    fn in_a_day_nothing_is_lost_until_the_queue_is_full_and_then_exactly_what_it_did_not_hold() {
        const DAY_MILLIS: u64 = 24 * 3600 * 1000;
        const BLOCK_MILLIS: u64 = 4;
        const FULL_MILLIS: u64 = CAPACITY * BLOCK_MILLIS;
        let mut channel = MotionChannel::new(at(0), 0);
        let (mut now, mut next, mut lost, mut warnings) = (0, 0, 0, 0);
        for look in 0_u64.. {
            let pause = match look % 50 {
                48 => FULL_MILLIS,
                49 => FULL_MILLIS + 1 + look * 7919 % FULL_MILLIS,
                // Mostly the pace of a recorder, sometimes nearly a full queue.
                turn => 1 + look * 7919 % if turn % 8 == 0 { FULL_MILLIS } else { 500 },
            };
            now += pause;
            if now > DAY_MILLIS {
                break;
            }
            let produced = now / BLOCK_MILLIS;
            let overwritten = (produced - next).saturating_sub(CAPACITY);
            let values = channel.values(at(now));
            // Before its first read nobody is warned.
            let is_late = overwritten > 0 && next > 0;
            assert_eq!(values.error == QueueStatus::Warning, is_late, "{pause} ms after the read before");
            warnings += u32::from(is_late);
            assert_eq!(values.data == DataStatus::Ready, produced > next);
            (next, lost) = (next + overwritten, lost + overwritten);
            while let Some(MotionRead { first, count }) = channel.read(at(now), 0, usize::MAX) {
                assert_eq!(first, next, "blocks follow each other");
                assert!(count <= MAX_BLOCKS_PER_READ as u64);
                next += count;
                assert_eq!(channel.values(at(now)).error, QueueStatus::None, "one read ends the warning");
            }
            assert_eq!(next, produced, "everything else was read");
        }
        assert!(warnings > 1000 && lost > 100_000 && next > DAY_MILLIS / BLOCK_MILLIS - 2 * CAPACITY);
    }

    #[test]
    fn stopping_leaves_the_rest_and_breaking_off_does_not() {
        let mut channel = MotionChannel::new(at(0), 0);
        channel.stop(at(40));
        let left = channel.values(at(1000));
        assert_eq!(
            (left.recording, left.data, left.error),
            (RecordingStatus::Stop, DataStatus::Ready, QueueStatus::None)
        );
        assert_eq!(channel.read(at(1000), 0, usize::MAX), Some(MotionRead { first: 0, count: 10 }));
        assert_eq!((channel.values(at(1000)).data, channel.needed_from(at(1000))), (DataStatus::Empty, None));

        let mut channel = MotionChannel::new(at(0), 0);
        channel.break_off(at(40));
        let broken = channel.values(at(1000));
        assert_eq!(
            (broken.recording, broken.data, broken.error),
            (RecordingStatus::Stop, DataStatus::Empty, QueueStatus::Error)
        );
        assert_eq!(channel.read(at(1000), 0, usize::MAX), None);
    }

    #[test]
    fn a_forgotten_past_counts_as_overwritten() {
        let mut channel = MotionChannel::new(at(0), 0);
        channel.read(at(4), 0, usize::MAX);
        assert_eq!(channel.needed_from(at(400)), Some(CellTime::from_nanos(4_500_000)));
        channel.skip_before(at(101));
        assert_eq!(channel.values(at(400)).error, QueueStatus::Warning);
        assert_eq!(channel.read(at(400), 1, usize::MAX), Some(MotionRead { first: 26, count: 1 }));
    }
}
