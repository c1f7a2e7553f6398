use std::cell::OnceCell;
use std::sync::Arc;

use opcua::server::node_manager::ParsedReadValueId;
use opcua::types::{
    AttributeId, ByteString, DataEncoding, DataValue, DateTime, NumericRange, StatusCode, TimestampsToReturn, Variant,
};

use super::id::Id;
use super::node::Variable;
use super::table::Space;
use super::value::{DataNode, Source};
use crate::virtual_controller::cell::{CellHandle, CellSnapshot};

/// Reads attributes for one request: all its values are of the same moment.
pub(super) struct Reading<'a> {
    space: &'a Space,
    cell: &'a CellHandle,
    /// The source timestamp of values that never change.
    started: DateTime,
    now: DateTime,
    snapshot: OnceCell<Arc<CellSnapshot>>,
}

/// Whether a read takes data out of the queue behind a node Data.
pub(super) enum Queues {
    /// As the Read service does. At most so many bytes in all, so that the response fits what the client takes.
    Take { budget: usize },
    /// As subscriptions do, which see Null.
    Leave,
}

impl<'a> Reading<'a> {
    /// `now` becomes the timestamp of the values that can change.
    pub(super) fn new(space: &'a Space, cell: &'a CellHandle, started: DateTime, now: DateTime) -> Self {
        Self { space, cell, started, now, snapshot: OnceCell::new() }
    }

    /// The attribute with the timestamps that were asked for, or a bad status.
    pub(super) fn read(
        &self,
        request: &ParsedReadValueId,
        timestamps: TimestampsToReturn,
        queues: &mut Queues,
    ) -> DataValue {
        let is_value = request.attribute_id == AttributeId::Value;
        match self.attribute(request, queues) {
            Ok((value, source_time)) => {
                let source = matches!(timestamps, TimestampsToReturn::Source | TimestampsToReturn::Both) && is_value;
                let server = matches!(timestamps, TimestampsToReturn::Server | TimestampsToReturn::Both);
                DataValue {
                    value: Some(value),
                    status: Some(StatusCode::Good),
                    source_timestamp: source.then_some(source_time),
                    server_timestamp: server.then_some(self.now),
                    ..Default::default()
                }
            }
            Err(status) => DataValue { status: Some(status), server_timestamp: Some(self.now), ..Default::default() },
        }
    }

    fn attribute(&self, request: &ParsedReadValueId, queues: &mut Queues) -> Result<(Variant, DateTime), StatusCode> {
        let id = Id::of(&request.node_id).ok_or(StatusCode::BadNodeIdUnknown)?;
        let node = self.space.node(id).ok_or(StatusCode::BadNodeIdUnknown)?;
        if request.attribute_id != AttributeId::Value {
            return match request.index_range {
                NumericRange::None => Ok((node.attribute(id, request.attribute_id)?, self.now)),
                _ => Err(StatusCode::BadIndexRangeInvalid),
            };
        }
        let variable = node.variable().ok_or(StatusCode::BadAttributeIdInvalid)?;
        if !matches!(request.data_encoding, DataEncoding::Binary) {
            return Err(StatusCode::BadDataEncodingInvalid);
        }
        if let Source::Data(data) = variable.source {
            // Part of a packet is of no use, and the rest would be lost.
            if request.index_range.has_range() {
                return Err(StatusCode::BadIndexRangeInvalid);
            }
            return Ok((self.take(data, queues)?, self.now));
        }
        let (value, time) = self.value(variable);
        Ok((value.range_of_owned(&request.index_range)?, time))
    }

    /// The value of a variable that is no node Data, and its source timestamp.
    pub(super) fn value(&self, variable: &Variable) -> (Variant, DateTime) {
        match &variable.source {
            Source::Fixed(value) => (value.clone(), self.started),
            Source::Live(read) => (read(self.snapshot()), self.now),
            Source::Setting(setting) => (setting.value(self.snapshot()), self.now),
            Source::Data(_) => (Variant::Empty, self.now),
        }
    }

    fn snapshot(&self) -> &CellSnapshot {
        self.snapshot.get_or_init(|| self.cell.snapshot())
    }

    /// The next packets of a queue as whole records; Null if it is empty.
    fn take(&self, data: DataNode, queues: &mut Queues) -> Result<Variant, StatusCode> {
        let Queues::Take { budget } = queues else { return Ok(Variant::Empty) };
        if *budget < LEAST_BUDGET {
            return Err(StatusCode::BadResponseTooLarge);
        }
        let taken = match data {
            DataNode::Force(monitor) => self.cell.read_force_data(monitor, *budget),
            DataNode::MotionLog => self.cell.read_motion_log(*budget),
        };
        let Some(bytes) = taken else { return Ok(Variant::Empty) };
        *budget = budget.saturating_sub(bytes.len());
        Ok(Variant::ByteString(ByteString::from(bytes)))
    }
}

/// Room for the longest single packet, a block of the motion log.
const LEAST_BUDGET: usize = 2608;
