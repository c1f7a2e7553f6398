//! The address space without a server: nodes of cells whose time the tests move.

mod structure;
mod values;
mod writes;

use opcua::server::node_manager::{ParsedReadValueId, ParsedWriteValue};
use opcua::types::{
    AttributeId, DataEncoding, DataValue, DateTime, NodeId, NumericRange, StatusCode, TimestampsToReturn, Variant,
};

use super::id::Id;
use super::reading::{Queues, Reading};
use super::system;
use super::table::Space;
use super::types::Types;
use super::writing;
use crate::virtual_controller::cell::{
    BackupMemory, Cell, CellClock, CellConfig, CellHandle, CellOptions, RobotModel, SpelDeclaration, SpelType,
};

/// A controller with a six-axis robot and a SCARA.
struct Controller {
    cell: CellHandle,
    clock: CellClock,
    space: Space,
}

impl Controller {
    fn current() -> Self {
        Self::new("8.0.2", false)
    }

    fn legacy() -> Self {
        Self::new("7.5.4", false)
    }

    fn new(firmware: &str, virtual_io: bool) -> Self {
        let options = CellOptions {
            robots: vec![RobotModel::C4A601S, RobotModel::Gx4A251S],
            virtual_io,
            ..CellOptions::default()
        };
        let variables = SpelType::ALL.map(|kind| SpelDeclaration::scalar(format!("OPCUA_{kind}"), kind));
        let config = CellConfig {
            name: "Cell 1".parse().unwrap(),
            serial: "SN0000123".parse().unwrap(),
            series: "RC800".parse().unwrap(),
            firmware: firmware.parse().unwrap(),
            started: "2026-03-01T08:00:00Z".parse().unwrap(),
            variables: variables.to_vec(),
            backup: BackupMemory::default(),
            options,
        };
        let clock = CellClock::manual();
        let cell = CellHandle::new(Cell::new(config), clock.clone());
        let description = cell.description();
        let types = Types::of(description.controller.generation(), virtual_io).unwrap();
        let space = system::space(types, &description);
        Self { cell, clock, space }
    }

    /// The node at a path of BrowseNames below DeviceSet.
    fn find(&self, path: &str) -> Option<Id> {
        path.split('/').try_fold(Id::di(5001), |at, name| {
            let mut below = self.space.references(at).filter(|r| r.is_forward).map(|r| r.other);
            below.find(|id| self.space.node(*id).is_some_and(|node| &*node.name.text == name))
        })
    }

    fn id(&self, path: &str) -> Id {
        self.find(path).unwrap_or_else(|| panic!("no {path}"))
    }

    fn read_id(&self, id: Id, attribute: AttributeId) -> DataValue {
        let reading = Reading::new(&self.space, &self.cell, DateTime::now(), DateTime::now());
        let request = ParsedReadValueId {
            node_id: id.into(),
            attribute_id: attribute,
            index_range: NumericRange::None,
            data_encoding: DataEncoding::Binary,
        };
        reading.read(&request, TimestampsToReturn::Both, &mut Queues::Take { budget: 1 << 20 })
    }

    fn value(&self, path: &str) -> Variant {
        self.read_id(self.id(path), AttributeId::Value).value.unwrap()
    }

    fn write(&self, path: &str, value: impl Into<Variant>) -> Result<(), StatusCode> {
        self.write_attribute(path, AttributeId::Value, value.into())
    }

    fn write_attribute(&self, path: &str, attribute_id: AttributeId, value: Variant) -> Result<(), StatusCode> {
        let node_id = NodeId::from(self.id(path));
        let value = DataValue::value_only(value);
        let request = ParsedWriteValue { node_id, attribute_id, index_range: NumericRange::None, value };
        writing::write(&self.space, &self.cell, &request)
    }

    fn instances(&self) -> impl Iterator<Item = Id> {
        self.space.instances.nodes().map(|(id, _)| id)
    }
}

const SYSTEM: &str = "MotionDeviceSystem_0";
const COMPONENTS: &str = "MotionDeviceSystem_0/Controllers/Controller_0/Components";
const ROBOT: &str = "MotionDeviceSystem_0/MotionDevices/MotionDevice_1";
const SCARA: &str = "MotionDeviceSystem_0/MotionDevices/MotionDevice_2";

fn every_controller() -> [Controller; 3] {
    [Controller::current(), Controller::legacy(), Controller::new("8.0.2", true)]
}
