use super::data::{AllView, ForceData, ForceDataType, ForceView, HeadView, MotionView, PositionView};
use super::footer::{FooterView, ForceFooter};
use super::header::{ForceHeader, HEADER_V2_BYTES, HeaderView};
use super::{TAG_DATA, TAG_FOOTER, TAG_HEADER};
use crate::records::MAX_READ_BYTES;
use crate::records::error::{Mistake, PacketKind, RecordError};
use crate::records::layout::{Field, Wire, field_at};
use crate::records::text::Label;
use crate::records::time::{ControllerTime, Ticks};

/// What one read of a force sensor's `Data` node brought.
#[derive(Debug, Clone, Copy)]
pub enum ForceRead<'a> {
    /// The start of a recording. `record_start` is there in version 2.
    Header {
        /// What is recorded, and how.
        header: HeaderView<'a>,
        /// Time of the first record.
        record_start: Option<Ticks>,
    },
    /// Whole data records, at least one, all of one recording and DataType.
    Data(DataRecords<'a>),
    /// The end of a recording.
    Footer(FooterView<'a>),
}

/// Data records that lie end to end.
#[derive(Debug, Clone, Copy)]
pub enum DataRecords<'a> {
    /// Records of DataType 0.
    All(&'a [[u8; AllView::SIZE]]),
    /// Records of DataType 1.
    Motion(&'a [[u8; MotionView::SIZE]]),
    /// Records of DataType 2.
    Force(&'a [[u8; ForceView::SIZE]]),
    /// Records of DataType 3.
    Position(&'a [[u8; PositionView::SIZE]]),
}

impl<'a> ForceRead<'a> {
    /// Looks at the bytes of one read and checks them: tag, version, id, DataType, lengths, times, sizes.
    ///
    /// # Errors
    /// Bytes that are not exactly one header, one footer, or whole data records of one kind.
    pub fn decode(bytes: &'a [u8]) -> Result<Self, RecordError> {
        let force = Place { packet: PacketKind::Force, record: 0, start: 0 };
        if bytes.len() > MAX_READ_BYTES {
            return Err(force.wrong(
                "OPCUACommonTag",
                0,
                Mistake::TooLarge { length: bytes.len(), max: MAX_READ_BYTES },
            ));
        }
        match bytes.first() {
            None => Err(force.wrong("OPCUACommonTag", 0, Mistake::Truncated { missing: 1 })),
            Some(&TAG_HEADER) => header(bytes),
            Some(&TAG_DATA) => data(bytes).map(Self::Data),
            Some(&TAG_FOOTER) => footer(bytes),
            Some(&tag) => Err(force.value("OPCUACommonTag", 0, tag, "expected 1, 2 or 4")),
        }
    }

    /// The id of the recording.
    pub fn id(&self) -> u16 {
        match self {
            Self::Header { header, .. } => header.id(),
            Self::Data(records) => records.head(0).map_or(0, HeadView::id),
            Self::Footer(footer) => footer.id(),
        }
    }

    /// The header as an owned packet, where this is one.
    pub fn to_header(&self) -> Option<ForceHeader> {
        match self {
            Self::Header { header, record_start } => {
                Some(ForceHeader { header: header.to_packet(), record_start: *record_start })
            }
            Self::Data(_) | Self::Footer(_) => None,
        }
    }

    /// The footer as an owned packet, where this is one.
    pub fn to_footer(&self) -> Option<ForceFooter> {
        match self {
            Self::Footer(footer) => Some(footer.to_packet()),
            Self::Header { .. } | Self::Data(_) => None,
        }
    }
}

impl<'a> DataRecords<'a> {
    /// Which groups the records hold.
    pub const fn data_type(&self) -> ForceDataType {
        match self {
            Self::All(_) => ForceDataType::All,
            Self::Motion(_) => ForceDataType::Motion,
            Self::Force(_) => ForceDataType::Force,
            Self::Position(_) => ForceDataType::Position,
        }
    }

    /// How many records there are.
    pub const fn len(&self) -> usize {
        match self {
            Self::All(records) => records.len(),
            Self::Motion(records) => records.len(),
            Self::Force(records) => records.len(),
            Self::Position(records) => records.len(),
        }
    }

    /// Whether there are none. [`ForceRead::decode`] gives at least one.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// What a record begins with.
    pub fn head(&self, index: usize) -> Option<HeadView<'a>> {
        let head = match self {
            Self::All(records) => records.get(index)?.first_chunk(),
            Self::Motion(records) => records.get(index)?.first_chunk(),
            Self::Force(records) => records.get(index)?.first_chunk(),
            Self::Position(records) => records.get(index)?.first_chunk(),
        };
        head.map(HeadView::new)
    }

    /// A record with all of its fields.
    pub fn get(&self, index: usize) -> Option<ForceData> {
        Some(match self {
            Self::All(records) => ForceData::All(AllView::new(records.get(index)?).to_packet()),
            Self::Motion(records) => ForceData::Motion(MotionView::new(records.get(index)?).to_packet()),
            Self::Force(records) => ForceData::Force(ForceView::new(records.get(index)?).to_packet()),
            Self::Position(records) => ForceData::Position(PositionView::new(records.get(index)?).to_packet()),
        })
    }
}

/// Where in a read a packet begins.
#[derive(Debug, Clone, Copy)]
struct Place {
    packet: PacketKind,
    record: usize,
    start: usize,
}

impl Place {
    const fn wrong(self, field: &'static str, offset: usize, mistake: Mistake) -> RecordError {
        RecordError { packet: self.packet, record: self.record, field, offset: self.start + offset, mistake }
    }

    fn value(self, field: &'static str, offset: usize, found: impl Into<u64>, expected: &'static str) -> RecordError {
        self.wrong(field, offset, Mistake::Value { found: found.into(), expected })
    }

    /// The first bytes of the packet, of which `bytes` has to have no fewer.
    fn whole<'a, const N: usize>(self, bytes: &'a [u8], fields: &[Field]) -> Result<&'a [u8; N], RecordError> {
        bytes.first_chunk().ok_or_else(|| {
            let field = field_at(fields, bytes.len());
            self.wrong(field.name, field.offset, Mistake::Truncated { missing: N - bytes.len() })
        })
    }

    fn nothing_follows(self, bytes: &[u8], size: usize) -> Result<(), RecordError> {
        match bytes.len().checked_sub(size) {
            Some(excess) if excess > 0 => Err(self.wrong("end", size, Mistake::Oversized { excess })),
            _ => Ok(()),
        }
    }

    fn version(self, version: u8) -> Result<(), RecordError> {
        match version {
            1 | 2 => Ok(()),
            other => Err(self.value("OPCUACommonVer", 1, other, "expected 1 or 2")),
        }
    }

    fn label<const N: usize>(self, field: &'static str, offset: usize, label: &Label<N>) -> Result<(), RecordError> {
        if usize::from(label.length) <= N {
            return Ok(());
        }
        Err(self.value(field, offset, label.length, "more than the bytes of the text"))
    }

    fn time(self, offset: usize, time: ControllerTime) -> Result<(), RecordError> {
        match time.mistake() {
            None => Ok(()),
            Some((field, at, found, expected)) => Err(self.value(field, offset + at, found, expected)),
        }
    }
}

fn header(bytes: &[u8]) -> Result<ForceRead<'_>, RecordError> {
    let place = Place { packet: PacketKind::ForceHeader, record: 0, start: 0 };
    let header = HeaderView::new(place.whole(bytes, HeaderView::FIELDS)?);
    place.version(header.version())?;
    place.time(10, header.start())?;
    place.label("RobotNameLength", 29, &header.robot_name())?;
    place.label("SensorSerialLength", 63, &header.sensor_serial())?;
    place.label("SensorLabelLength", 74, &header.sensor_label())?;
    place.label("FMLabelLength", 109, &header.monitor_label())?;
    place.label("FCSLabelLength", 144, &header.coordinate_label())?;
    place.label("FileNameLength", 177, &header.file_name())?;
    place.label("SeqNameLength", 243, &header.sequence_name())?;
    place.label("ForceNameLength", 276, &header.force_name())?;
    if header.version() == 1 {
        place.nothing_follows(bytes, HeaderView::SIZE)?;
        return Ok(ForceRead::Header { header, record_start: None });
    }
    place.nothing_follows(bytes, HEADER_V2_BYTES)?;
    if bytes.len() < HEADER_V2_BYTES {
        let missing = HEADER_V2_BYTES - bytes.len();
        return Err(place.wrong("RecordStartTime", HeaderView::SIZE, Mistake::Truncated { missing }));
    }
    let record_start = Ticks::read(bytes, HeaderView::SIZE);
    if record_start >= Ticks::LIMIT {
        return Err(place.value("RecordStartTime", HeaderView::SIZE, record_start.0, "more than a hundred years"));
    }
    Ok(ForceRead::Header { header, record_start: Some(record_start) })
}

fn footer(bytes: &[u8]) -> Result<ForceRead<'_>, RecordError> {
    let place = Place { packet: PacketKind::ForceFooter, record: 0, start: 0 };
    let footer = FooterView::new(place.whole(bytes, FooterView::FIELDS)?);
    place.version(footer.version())?;
    place.time(10, footer.end())?;
    place.label("RobotNameLength", 29, &footer.robot_name())?;
    place.label("SensorSerialLength", 63, &footer.sensor_serial())?;
    place.label("SensorLabelLength", 74, &footer.sensor_label())?;
    place.label("FMLabelLength", 109, &footer.monitor_label())?;
    place.label("FCSLabelLength", 144, &footer.coordinate_label())?;
    place.nothing_follows(bytes, FooterView::SIZE)?;
    Ok(ForceRead::Footer(footer))
}

fn data(bytes: &[u8]) -> Result<DataRecords<'_>, RecordError> {
    let place = Place { packet: PacketKind::ForceData, record: 0, start: 0 };
    let head = HeadView::new(place.whole(bytes, HeadView::FIELDS)?);
    place.version(head.version())?;
    let data_type = ForceDataType::from_number(head.data_type())
        .ok_or_else(|| place.value("OPCUADataType", 6, head.data_type(), "expected 0 to 3"))?;
    Ok(match data_type {
        ForceDataType::All => {
            let records = alike(bytes, AllView::FIELDS)?;
            times(records, 165)?;
            DataRecords::All(records)
        }
        ForceDataType::Motion => {
            let records = alike(bytes, MotionView::FIELDS)?;
            times(records, 96)?;
            DataRecords::Motion(records)
        }
        ForceDataType::Force => DataRecords::Force(alike(bytes, ForceView::FIELDS)?),
        ForceDataType::Position => DataRecords::Position(alike(bytes, PositionView::FIELDS)?),
    })
}

/// Tag, version, id and DataType: the first eight bytes without the two that are reserved.
const COMMON: u64 = 0xffff_0000_ffff_ffff;

/// Whole records that begin as the first one does.
fn alike<'a, const N: usize>(bytes: &'a [u8], fields: &[Field]) -> Result<&'a [[u8; N]], RecordError> {
    let (records, rest) = bytes.as_chunks::<N>();
    let place = |record| Place { packet: PacketKind::ForceData, record, start: record * N };
    if !rest.is_empty() {
        let field = field_at(fields, rest.len());
        let missing = Mistake::Truncated { missing: N - rest.len() };
        return Err(place(records.len()).wrong(field.name, field.offset, missing));
    }
    let common = |record: &[u8; N]| u64::read(record, 0) & COMMON;
    let Some(first) = records.first().map(common) else { return Ok(records) };
    let Some(odd) = records.iter().position(|record| common(record) != first) else { return Ok(records) };
    let (found, first, place) = (common(&records[odd]).to_le_bytes(), first.to_le_bytes(), place(odd));
    let number = |at| u16::read(&found, at);
    let expected = "the first record of the same read has another value";
    Err(if found[0] != first[0] {
        place.value("OPCUACommonTag", 0, found[0], expected)
    } else if found[1] != first[1] {
        place.value("OPCUACommonVer", 1, found[1], expected)
    } else if number(2) != u16::read(&first, 2) {
        place.value("OPCUACommonID", 2, number(2), expected)
    } else {
        place.value("OPCUADataType", 6, number(6), expected)
    })
}

fn times<const N: usize>(records: &[[u8; N]], offset: usize) -> Result<(), RecordError> {
    let time = |record: &[u8; N]| ControllerTime::read(record, offset);
    if records.iter().all(|record| time(record).is_in_range()) {
        return Ok(());
    }
    records.iter().enumerate().try_for_each(|(record, bytes)| {
        let place = Place { packet: PacketKind::ForceData, record, start: record * N };
        place.time(offset, time(bytes))
    })
}

#[cfg(test)]
mod tests;
