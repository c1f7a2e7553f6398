use super::data::{AllView, DataHead, ForceDataType, ForceView, Forces, MotionView, PositionView, TcpSpeed};
use super::read::DataRecords;
use crate::records::columns::{Column, NO_TIME, Values};
use crate::records::time::ControllerTime;

/// Appends to each column its value of each record. Column by column, because a loop over one column of many records
/// is several times as fast as one over many columns of one record; the compiler has to see each column's number.
macro_rules! extend_each {
    ($columns:expr, $records:expr, $values:expr, $($index:literal)*) => {
        $($columns[$index].extend($records.iter().map(|record| $values(record)[$index]));)*
    };
}

/// Force sensor data as columns. A group that the DataType does not hold stays empty; every other column has one value
/// for each record.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ForceColumns {
    /// The id of the recording.
    pub id: Vec<u16>,
    /// Number of the record in its recording, from 0.
    pub count: Vec<u32>,
    /// Milliseconds.
    pub elapsed: Vec<u32>,
    /// Fx, Fy, Fz, Tx, Ty, Tz, Fmag, Tmag.
    pub forces: [Vec<f32>; 8],
    /// X, Y, Z, U, V, W.
    pub position: [Vec<f32>; 6],
    /// X, Y, Z, U, V, W.
    pub reference: [Vec<f32>; 6],
    /// X, Y, Z.
    pub correction: [Vec<f32>; 3],
    /// TCPSpeed, then its components X, Y, Z.
    pub speed: [Vec<f32>; 4],
    /// J1 to J6.
    pub joints: [Vec<f32>; 6],
    /// J1 to J6, in percent.
    pub overload: [Vec<u8>; 6],
    /// Whether force control runs, 0 or 1.
    pub force_control: Vec<u8>,
    /// Set by the program with StepID.
    pub step_id: Vec<u32>,
    /// Milliseconds since 1970 by the controller's clock, or [`NO_TIME`].
    pub time: Vec<i64>,
    /// Number of the force guide sequence; 0 while none runs.
    pub sequence_no: Vec<u8>,
    /// Number of the object of the sequence.
    pub object_no: Vec<u8>,
    /// Number of the force monitor object.
    pub monitor_no: Vec<i16>,
    day: Day,
}

impl ForceColumns {
    /// Appends the records of one read.
    pub fn extend(&mut self, records: DataRecords<'_>) {
        match records {
            DataRecords::All(records) => {
                for records in records.chunks(TOGETHER) {
                    self.extend_by(records, AllView::new);
                    extend_each!(self.forces, records, |record| forces(AllView::new(record).forces()), 0 1 2 3 4 5 6 7);
                    extend_each!(self.reference, records, |record| AllView::new(record).reference(), 0 1 2 3 4 5);
                    extend_each!(self.correction, records, |record| AllView::new(record).correction(), 0 1 2);
                    extend_each!(self.speed, records, |record| speed(AllView::new(record).speed()), 0 1 2 3);
                    extend_each!(self.joints, records, |record| AllView::new(record).joints(), 0 1 2 3 4 5);
                    extend_each!(self.overload, records, |record| AllView::new(record).overload(), 0 1 2 3 4 5);
                    self.force_control.extend(records.iter().map(|record| AllView::new(record).force_control()));
                    self.extend_time(records, |record| AllView::new(record).time());
                }
            }
            DataRecords::Motion(records) => {
                for records in records.chunks(TOGETHER) {
                    self.extend_by(records, MotionView::new);
                    extend_each!(self.speed, records, |record| speed(MotionView::new(record).speed()), 0 1 2 3);
                    extend_each!(self.joints, records, |record| MotionView::new(record).joints(), 0 1 2 3 4 5);
                    extend_each!(self.overload, records, |record| MotionView::new(record).overload(), 0 1 2 3 4 5);
                    self.extend_time(records, |record| MotionView::new(record).time());
                }
            }
            DataRecords::Force(records) => {
                for records in records.chunks(TOGETHER) {
                    self.extend_by(records, ForceView::new);
                    extend_each!(self.forces, records, |record| forces(ForceView::new(record).forces()), 0 1 2 3 4 5 6 7);
                }
            }
            DataRecords::Position(records) => {
                for records in records.chunks(TOGETHER) {
                    self.extend_by(records, PositionView::new);
                }
            }
        }
    }

    /// The groups that every DataType has.
    fn extend_by<'a, const N: usize, V: Common>(&mut self, records: &'a [[u8; N]], view: fn(&'a [u8; N]) -> V) {
        let views = || records.iter().map(view);
        self.id.extend(views().map(|record| record.head().id));
        self.count.extend(views().map(|record| record.head().count));
        self.elapsed.extend(views().map(|record| record.head().elapsed));
        extend_each!(self.position, records, |record| view(record).position(), 0 1 2 3 4 5);
        self.step_id.extend(views().map(|record| record.numbers().0));
        self.sequence_no.extend(views().map(|record| record.numbers().1));
        self.object_no.extend(views().map(|record| record.numbers().2));
        self.monitor_no.extend(views().map(|record| record.numbers().3));
    }

    fn extend_time<const N: usize>(&mut self, records: &[[u8; N]], time: impl Fn(&[u8; N]) -> ControllerTime) {
        let Self { time: column, day, .. } = self;
        column.extend(records.iter().map(|record| day.milliseconds(time(record))));
    }

    /// How many records the columns hold.
    pub const fn rows(&self) -> usize {
        self.id.len()
    }

    /// Removes every value and keeps the memory.
    pub fn clear(&mut self) {
        let Self { id, count, elapsed, forces, position, reference, correction, speed, joints, .. } = self;
        id.clear();
        count.clear();
        elapsed.clear();
        let groups = [&mut forces[..], position, reference, correction, speed, joints];
        groups.into_iter().flatten().for_each(Vec::clear);
        self.overload.iter_mut().for_each(Vec::clear);
        self.force_control.clear();
        self.step_id.clear();
        self.time.clear();
        self.sequence_no.clear();
        self.object_no.clear();
        self.monitor_no.clear();
    }

    /// The columns of a DataType, in the order of the manual's table. Their names and order depend on nothing else.
    pub fn columns(&self, data_type: ForceDataType) -> Vec<Column<'_>> {
        use ForceDataType::{All, Force, Motion};
        let mut columns = Listed(Vec::with_capacity(48));
        columns.add("OPCUACommonID", "", Values::U16(&self.id));
        columns.add("Count", "", Values::U32(&self.count));
        columns.add("ElapsedTime", "ms", Values::U32(&self.elapsed));
        if matches!(data_type, All | Force) {
            let (force, torque) = self.forces.split_at(3);
            let (torque, magnitudes) = torque.split_at(3);
            columns.floats(&["Fx", "Fy", "Fz"], "N", force);
            columns.floats(&["Tx", "Ty", "Tz"], "N·m", torque);
            columns.floats(&["Fmag"], "N", &magnitudes[..1]);
            columns.floats(&["Tmag"], "N·m", &magnitudes[1..]);
        }
        columns.position("CurPos", &self.position);
        if data_type == All {
            columns.position("RefPos", &self.reference);
            columns.floats(&["Diff(X)", "Diff(Y)", "Diff(Z)"], "mm", &self.correction);
        }
        if matches!(data_type, All | Motion) {
            let names = ["TCPSpeed", "TCPSpeed(X)", "TCPSpeed(Y)", "TCPSpeed(Z)"];
            columns.floats(&names, "mm/s", &self.speed);
            for (joint, values) in (1..).zip(&self.joints) {
                columns.add(&format!("Joint(J{joint})"), "deg or mm", Values::F32(values));
            }
            for (joint, values) in (1..).zip(&self.overload) {
                columns.add(&format!("OLRate(J{joint})"), "%", Values::U8(values));
            }
        }
        if data_type == All {
            columns.add("FCOn", "", Values::U8(&self.force_control));
        }
        columns.add("StepID", "", Values::U32(&self.step_id));
        if matches!(data_type, All | Motion) {
            columns.add("Time", "controller clock", Values::Time(&self.time));
        }
        columns.add("SeqNo", "", Values::U8(&self.sequence_no));
        columns.add("ObjectNo", "", Values::U8(&self.object_no));
        columns.add("FMNo", "", Values::I16(&self.monitor_no));
        columns.0
    }
}

struct Listed<'a>(Vec<Column<'a>>);

impl<'a> Listed<'a> {
    fn add(&mut self, name: &str, unit: &'static str, values: Values<'a>) {
        self.0.push(Column { name: name.to_owned(), unit, values, timestamps: None, rows_per_value: 1 });
    }

    fn floats(&mut self, names: &[&str], unit: &'static str, columns: &'a [Vec<f32>]) {
        for (name, values) in names.iter().zip(columns) {
            self.add(name, unit, Values::F32(values));
        }
    }

    fn position(&mut self, group: &str, columns: &'a [Vec<f32>]) {
        let names = ["X", "Y", "Z", "U", "V", "W"];
        let units = ["mm", "mm", "mm", "deg", "deg", "deg"];
        for ((name, unit), values) in names.into_iter().zip(units).zip(columns) {
            self.add(&format!("{group}({name})"), unit, Values::F32(values));
        }
    }
}

/// Records that are taken apart together: few enough that they stay in the fastest cache while every field is read.
const TOGETHER: usize = 64;

/// The order of [`ForceColumns::forces`].
#[inline(always)]
const fn forces(forces: Forces) -> [f32; 8] {
    let Forces { force: [fx, fy, fz], torque: [tx, ty, tz], force_magnitude, torque_magnitude } = forces;
    [fx, fy, fz, tx, ty, tz, force_magnitude, torque_magnitude]
}

/// The order of [`ForceColumns::speed`].
#[inline(always)]
const fn speed(speed: TcpSpeed) -> [f32; 4] {
    let [x, y, z] = speed.components;
    [speed.speed, x, y, z]
}

/// The groups that every DataType has.
trait Common {
    fn head(&self) -> DataHead;
    fn position(&self) -> [f32; 6];
    /// StepID, SeqNo, ObjectNo, FMNo.
    fn numbers(&self) -> (u32, u8, u8, i16);
}

macro_rules! common {
    ($($view:ident),*) => {$(
        impl Common for $view<'_> {
            #[inline(always)]
            fn head(&self) -> DataHead {
                $view::head(*self)
            }

            #[inline(always)]
            fn position(&self) -> [f32; 6] {
                $view::position(*self)
            }

            #[inline(always)]
            fn numbers(&self) -> (u32, u8, u8, i16) {
                (self.step_id(), self.sequence_no(), self.object_no(), self.monitor_no())
            }
        }
    )*};
}

common!(AllView, MotionView, ForceView, PositionView);

/// The day of the last record: a recording has thousands of records of the same day.
#[derive(Debug, Clone, PartialEq, Default)]
struct Day {
    date: (i16, u8, u8),
    /// Milliseconds from 1970 to its midnight; `None` where it is no date.
    midnight: Option<i64>,
}

impl Day {
    fn milliseconds(&mut self, time: ControllerTime) -> i64 {
        let date = (time.year, time.month, time.day);
        if self.date != date {
            let midnight = ControllerTime { year: time.year, month: time.month, day: time.day, ..Default::default() };
            let midnight = midnight.to_date_time().map(|time| time.and_utc().timestamp_millis());
            *self = Self { date, midnight };
        }
        let of_day = i64::from(time.hour) * 3_600_000 + i64::from(time.minute) * 60_000 + i64::from(time.second) * 1000;
        self.midnight.map_or(NO_TIME, |midnight| midnight + of_day + i64::from(time.millisecond))
    }
}
