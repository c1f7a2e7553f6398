//! RecordStart and RecordEnd, and the reads and writes of OPC UA clients.

use super::command::{CommandRefusal, ForceRecording, Setting, SettingRefusal};
use super::force_channel::{End, ForceRead, Recording, footer};
use super::io::IoDirection;
use super::motion_channel::{MotionChannel, MotionRead};
use super::record::{CellRecord, RecordedPacket};
use super::samples;
use super::simulation::Cell;
use super::time::CellTime;
use crate::model::FirmwareGeneration;
use crate::records::force::{EndCondition, ForceDataType, ForceHeader, Header};
use crate::records::motion::{BLOCK_BYTES, MotionBlock};
use crate::records::{ControllerTime, Label, Ticks};

/// Limits of RecordStart, in seconds.
const SECONDS: std::ops::RangeInclusive<f32> = 0.002..=600.0;

impl Cell {
    /// Starts a recording of the force sensor. The index of its monitor: the first that is free.
    pub(super) fn record_start(&mut self, recording: ForceRecording) -> Result<usize, CommandRefusal> {
        let ForceRecording { robot: number, duration, interval } = recording;
        let robot = usize::from(number).checked_sub(1).filter(|robot| *robot < self.robots.len());
        let robot = robot.ok_or(CommandRefusal::UnknownRobot)?;
        if !SECONDS.contains(&duration) || !SECONDS.contains(&interval) {
            return Err(CommandRefusal::OutOfRange);
        }
        let now = self.now;
        let free = self.monitors.iter().position(|monitor| !monitor.is_running(now));
        let monitor = free.ok_or(CommandRefusal::NoMonitor)?;
        self.recording_id = self.recording_id.wrapping_add(1);
        // With Port off the data goes to the programming software, and the monitor shows nothing of it.
        if self.settings.force_port {
            let micros = |secs: f32| (f64::from(secs) * 1e6).round() as u64;
            let end = now.plus_nanos(micros(duration) * 1000);
            self.monitors[monitor].start(Recording {
                header: self.force_header(monitor, robot, duration, interval),
                robot,
                data_type: ForceDataType::from_number(self.settings.force_data_type).unwrap_or_default(),
                start: now,
                interval: micros(interval) * 1000,
                end: End { time: end, condition: EndCondition::DurationElapsed, error: 0 },
            });
        }
        Ok(monitor)
    }

    fn force_header(&self, monitor: usize, robot: usize, duration: f32, interval: f32) -> ForceHeader {
        let is_current = self.description.controller.generation() == FirmwareGeneration::Current;
        let number = robot + 1;
        // Numbers of robots and monitors are below five.
        ForceHeader {
            header: Header {
                version: if is_current { 2 } else { 1 },
                id: self.recording_id,
                packet_version: 1,
                packet_type: 0,
                channel: monitor as u8 + 1,
                mode: 0,
                start: self.controller_time(self.now),
                duration,
                interval,
                robot_no: number as i16,
                robot_name: Label::new(&self.description.robots[robot].name),
                sensor_no: number as u8,
                sensor_serial: Label::new(&format!("S25{:07}", self.robots[robot].seed % 10_000_000)),
                sensor_label: Label::new(&format!("Sensor{number}")),
                monitor_no: number as i16,
                monitor_label: Label::new(&format!("FM{number}")),
                coordinate_no: 0,
                coordinate_label: Label::default(),
                file_name: Label::new(&format!("Insert_R{number}_{:05}", self.recording_id)),
                sequence_no: 0,
                sequence_name: Label::default(),
                force_name: Label::new("Insert"),
                robot_local: 0,
            },
            record_start: is_current.then(|| Ticks(self.now.ticks())),
        }
    }

    fn controller_time(&self, time: CellTime) -> ControllerTime {
        ControllerTime::from_date_time(self.clock(time).naive_utc())
    }

    /// Ends the recording of a monitor, if one runs.
    pub(super) fn record_end(&mut self, monitor: usize, condition: EndCondition) {
        let error = if condition == EndCondition::Error { self.safety.error } else { 0 };
        if let Some(monitor) = self.monitors.get_mut(monitor) {
            monitor.end(End { time: self.now, condition, error });
        }
    }

    /// Ends every recording.
    pub(super) fn end_recordings(&mut self, condition: EndCondition) {
        for monitor in 0..self.monitors.len() {
            self.record_end(monitor, condition);
        }
        self.tasks.iter_mut().for_each(|task| task.monitor = None);
    }

    /// See [`super::CellHandle::read_force_data`].
    pub fn read_force_data(&mut self, monitor: u8, max_bytes: usize) -> Option<Vec<u8>> {
        let (now, data_num) = (self.now, self.settings.force_data_num);
        let index = usize::from(monitor).checked_sub(1)?;
        match self.monitors.get_mut(index)?.read(now, data_num, max_bytes)? {
            ForceRead::Header(header) => {
                self.note(|| RecordedPacket::ForceHeader(monitor, Box::new(header)));
                Some(header.encode())
            }
            ForceRead::Data { recording, first, count } => {
                let mut bytes = Vec::with_capacity(recording.data_type.record_bytes() * count as usize);
                for number in first..first + count {
                    let unit = &self.robots[recording.robot];
                    let clock = |time| self.controller_time(time);
                    let data = samples::force_data(&unit.robot, &recording, number, clock, unit.seed);
                    let data = data.reduced(recording.data_type);
                    data.encode_into(&mut bytes);
                    self.note(|| RecordedPacket::ForceData(monitor, Box::new(data)));
                }
                Some(bytes)
            }
            ForceRead::Footer(recording) => {
                let footer = footer(&recording, self.controller_time(recording.end.time));
                self.note(|| RecordedPacket::ForceFooter(monitor, Box::new(footer)));
                Some(footer.encode().to_vec())
            }
        }
    }

    /// See [`super::CellHandle::read_motion_log`].
    pub fn read_motion_log(&mut self, max_bytes: usize) -> Option<Vec<u8>> {
        let (now, data_num) = (self.now, self.settings.motion_data_num);
        let MotionRead { first, count } = self.motion.as_mut()?.read(now, data_num, max_bytes)?;
        let mut bytes = Vec::with_capacity(BLOCK_BYTES * count as usize);
        for number in first..first + count {
            let block = self.motion_block(number)?;
            block.encode_into(&mut bytes);
            self.note(|| RecordedPacket::MotionBlock(Box::new(block)));
        }
        Some(bytes)
    }

    /// From now on, keeps the newest `limit` packets that are read.
    pub fn keep_record(&mut self, limit: usize) {
        self.record = Some(CellRecord::new(limit));
    }

    /// What was read since [`Cell::keep_record`].
    pub const fn record(&self) -> Option<&CellRecord> {
        self.record.as_ref()
    }

    fn note(&mut self, packet: impl FnOnce() -> RecordedPacket) {
        if let Some(record) = &mut self.record {
            record.push(packet());
        }
    }

    fn motion_block(&self, number: u64) -> Option<MotionBlock> {
        let unit = self.robots.first()?;
        let channel = self.motion.as_ref()?;
        Some(samples::motion_block(&unit.robot, &unit.home_offsets, channel, number, &self.io_history, unit.seed))
    }

    /// Switches motion logging on or off.
    pub(super) fn set_motion_logging(&mut self, on: bool) -> Result<(), CommandRefusal> {
        let (now, interval) = (self.now, self.settings.motion_interval);
        let channel = self.motion.as_mut().ok_or(CommandRefusal::NotSupported)?;
        match (on, channel.is_running()) {
            (true, false) => *channel = MotionChannel::new(now, interval),
            (false, true) => channel.stop(now),
            (true, true) | (false, false) => {}
        }
        Ok(())
    }

    /// Takes a client's write, whole or not at all. A new DataNum or SamplingInterval of the motion log empties its queue:
    /// the blocks that follow are contiguous.
    pub fn write(&mut self, setting: Setting) -> Result<(), SettingRefusal> {
        let restarts = matches!(setting, Setting::MotionDataNum(_) | Setting::MotionSamplingInterval(_));
        match setting {
            Setting::InputBit { port, offset, on } => {
                self.check_input(port, offset / 8)?;
                self.io.set_bit(port, offset, on);
                self.show_status();
            }
            Setting::InputByte { port, offset, value } => {
                self.check_input(port, offset)?;
                self.io.set_byte(port, offset, value);
                self.show_status();
            }
            Setting::MotionDataType(_) | Setting::MotionDataNum(_) | Setting::MotionSamplingInterval(_)
                if self.motion.is_none() =>
            {
                return Err(SettingRefusal::NotWritable);
            }
            setting => self.settings.set(setting)?,
        }
        if restarts
            && let Some(channel) = &mut self.motion
            && channel.is_running()
        {
            *channel = MotionChannel::new(self.now, self.settings.motion_interval);
        }
        Ok(())
    }

    fn check_input(&self, port: usize, byte: u16) -> Result<(), SettingRefusal> {
        let port = self.description.io.get(port).ok_or(SettingRefusal::NotWritable)?;
        if self.description.virtual_io && port.direction == IoDirection::Input && byte < port.bytes() {
            Ok(())
        } else {
            Err(SettingRefusal::NotWritable)
        }
    }
}
