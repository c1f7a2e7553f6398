//! Everything below `Objects/DeviceSet` (manual 3.2.2.1).

use opcua::types::LocalizedText;

use super::id::{Id, OWN};
use super::instances::{Instance, Instances};
use super::node::BrowseName;
use super::table::Space;
use super::types::Types;
use super::value::Source;
use super::{controller, robot};
use crate::virtual_controller::cell::CellDescription;

/// DeviceSet of Devices.
const DEVICE_SET: Id = Id::di(5001);
const MOTION_DEVICE_SYSTEM: Id = Id::robotics(1002);
const SAFETY_STATE: Id = Id::robotics(1013);
const CONTROLS: Id = Id::robotics(4002);
const HAS_SAFETY_STATES: Id = Id::robotics(18_182);

/// The address space of a controller with this cell.
pub(super) fn space(types: Types, cell: &CellDescription) -> Space {
    let mut space = Instances::new(&types.0);
    let name = BrowseName::new(OWN, "MotionDeviceSystem_0");
    let system = space.root(DEVICE_SET, name, MOTION_DEVICE_SYSTEM);
    let robots: Vec<Instance> = match space.member(&system, "MotionDevices") {
        Some(folder) => (0..cell.robots.len()).map(|at| robot::add(&mut space, &folder, cell, at)).collect(),
        None => Vec::new(),
    };
    let safety = space.member(&system, "SafetyStates").map(|folder| safety_state(&mut space, &folder));
    if let Some(folder) = space.member(&system, "Controllers") {
        let controller = controller::add(&mut space, &folder, cell);
        for robot in &robots {
            space.refer(&controller, CONTROLS, robot);
        }
        if let Some(safety) = safety {
            space.refer(&controller, HAS_SAFETY_STATES, &safety);
        }
    }
    let instances = space.finish();
    Space { types: types.0, instances }
}

fn safety_state(space: &mut Instances, folder: &Instance) -> Instance {
    let state = space.object(folder, BrowseName::new(OWN, "SafetyState_0"), SAFETY_STATE);
    space.set_fixed(&state, "ComponentName", LocalizedText::from("SafetyState_0"));
    let mode = Source::live(|cell| cell.safety.mode.operational_mode());
    space.set(&state, "ParameterSet/OperationalMode", mode);
    space.set(&state, "ParameterSet/EmergencyStop", Source::live(|cell| cell.safety.emergency_stop));
    space.set(&state, "ParameterSet/ProtectiveStop", Source::live(|cell| cell.safety.protective_stop));
    state
}
