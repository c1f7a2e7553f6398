use super::columns::ForceColumns;
use super::footer::ForceFooter;
use super::header::ForceHeader;
use super::read::{DataRecords, ForceRead};

/// Puts the packets of recordings together by their id, and notices what is missing.
#[derive(Debug, Clone, Default)]
pub struct ForceAssembly {
    recording: Option<Recording>,
}

#[derive(Debug, Clone, Copy)]
struct Recording {
    id: u16,
    /// Count of the last record, `None` before the first one.
    last_count: Option<u32>,
}

/// What a packet means for the recording it belongs to.
#[derive(Debug, Clone, PartialEq)]
pub enum ForceEvent {
    /// A recording begins.
    Started(Box<ForceHeader>),
    /// A recording ended without a footer, because a packet of another recording followed.
    FooterMissing {
        /// Identifier of the recording that ended.
        id: u16,
    },
    /// Data or a footer came of a recording whose header did not come.
    HeaderMissing {
        /// Identifier of the recording without a header.
        id: u16,
    },
    /// The records between two counts did not come: `missing` of them, after the record with the count `after`.
    Lost {
        /// Count of the last record that came.
        after: u32,
        /// How many records did not come.
        missing: u32,
    },
    /// Records were appended to the columns.
    Records {
        /// How many records.
        count: usize,
    },
    /// The recording is complete.
    Ended(Box<ForceFooter>),
}

impl ForceAssembly {
    /// Takes in one read, and appends its records to the columns. The events are in the order in which they happened.
    pub fn push(&mut self, read: ForceRead<'_>, columns: &mut ForceColumns) -> Vec<ForceEvent> {
        let mut events = Vec::new();
        match read {
            ForceRead::Header { header, record_start } => {
                if let Some(unfinished) = self.recording.take() {
                    events.push(ForceEvent::FooterMissing { id: unfinished.id });
                }
                self.recording = Some(Recording { id: header.id(), last_count: None });
                events.push(ForceEvent::Started(Box::new(ForceHeader { header: header.to_packet(), record_start })));
            }
            ForceRead::Data(records) => {
                self.begin(read.id(), &mut events);
                self.count(records, &mut events);
                columns.extend(records);
                events.push(ForceEvent::Records { count: records.len() });
            }
            ForceRead::Footer(footer) => {
                self.begin(footer.id(), &mut events);
                self.recording = None;
                events.push(ForceEvent::Ended(Box::new(footer.to_packet())));
            }
        }
        events
    }

    /// The id of the recording whose footer has not come yet.
    pub fn recording(&self) -> Option<u16> {
        self.recording.map(|recording| recording.id)
    }

    fn begin(&mut self, id: u16, events: &mut Vec<ForceEvent>) {
        match self.recording {
            Some(recording) if recording.id == id => return,
            Some(recording) => events.push(ForceEvent::FooterMissing { id: recording.id }),
            None => {}
        }
        events.push(ForceEvent::HeaderMissing { id });
        self.recording = Some(Recording { id, last_count: None });
    }

    fn count(&mut self, records: DataRecords<'_>, events: &mut Vec<ForceEvent>) {
        let Some(recording) = &mut self.recording else { return };
        for head in (0..records.len()).filter_map(|index| records.head(index)) {
            let count = head.count();
            if let Some(after) = recording.last_count {
                let missing = count.wrapping_sub(after).wrapping_sub(1);
                // A count that goes back is a new numbering, not four thousand million lost records.
                if missing != 0 && missing < u32::MAX / 2 {
                    events.push(ForceEvent::Lost { after, missing });
                }
            }
            recording.last_count = Some(count);
        }
    }
}
