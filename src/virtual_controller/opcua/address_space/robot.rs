//! MotionDevices (manual 3.2.2.1, 3.2.3.5–3.2.3.9; OPC 40010-1 §7.2–7.6).

use opcua::types::{LocalizedText, Variant};

use super::consumables::consumable_status;
use super::format::{duration, pose};
use super::id::{Id, OWN, standard};
use super::instances::{Instance, Instances};
use super::node::BrowseName;
use super::units;
use super::value::Source;
use super::vendor_types;
use crate::model::FirmwareGeneration;
use crate::virtual_controller::cell::{CellDescription, MotionProfile, Part, RobotDescription};

const MOTION_DEVICE: Id = Id::robotics(1004);
const AXIS: Id = Id::robotics(16_601);
const POWER_TRAIN: Id = Id::robotics(16_794);
const MOTOR: Id = Id::robotics(1019);
const MOVES: Id = Id::robotics(18_178);
const REQUIRES: Id = Id::robotics(18_179);

/// Adds the robot with this index, with its axes and power trains.
pub(super) fn add(space: &mut Instances, folder: &Instance, cell: &CellDescription, index: usize) -> Instance {
    let description = &cell.robots[index];
    let current = cell.controller.generation() == FirmwareGeneration::Current;
    let name = format!("MotionDevice_{}", description.number);
    let robot = space.object(folder, BrowseName::new(OWN, name), MOTION_DEVICE);
    identity(space, &robot, description);
    space.set_fixed(&robot, "MotionDeviceCategory", description.kind().category());
    space.set(&robot, "ParameterSet/InControl", Source::live(move |cell| cell.robots[index].motors_on));
    space.set(&robot, "ParameterSet/SpeedOverride", Source::live(move |cell| cell.robots[index].speed_override));
    if current {
        let name = BrowseName::new(OWN, "RobotNumber");
        space.variable(&robot, name, standard::UINT16, Source::Fixed(u16::from(description.number).into()));
        status(space, &robot, index);
        additional_info(space, &robot, index);
        consumable_status(space, &robot, &[Part::Battery], move |cell, _| cell.robots[index].battery);
    }
    for axis in 0..description.model.axes().len() {
        let added = self::axis(space, &robot, description, (index, axis), current);
        let train = power_train(space, &robot, (index, axis));
        if let (Some(axis), Some(train)) = (added, train) {
            space.refer(&train, MOVES, &axis);
            space.refer(&axis, REQUIRES, &train);
        }
    }
    robot
}

fn identity(space: &mut Instances, robot: &Instance, description: &RobotDescription) {
    let model = description.model.name();
    space.set_fixed(robot, "ComponentName", LocalizedText::from(&*description.name));
    space.set_fixed(robot, "SerialNumber", &*description.serial);
    space.set_fixed(robot, "Manufacturer", LocalizedText::from(description.manufacturer));
    space.set_fixed(robot, "Model", LocalizedText::from(model));
    space.set_fixed(robot, "ProductCode", model);
}

fn status(space: &mut Instances, robot: &Instance, index: usize) {
    let status = space.object(robot, BrowseName::new(OWN, "RobotStatus"), vendor_types::ROBOT_STATUS);
    space.set(&status, "Power", Source::live(move |cell| cell.robots[index].power_high));
    space.set(&status, "Home", Source::live(move |cell| cell.robots[index].at_home));
    let on_time = Source::live(move |cell| duration(cell.robots[index].motors_on_time));
    space.set(&status, "IntegrationMotorOnTime", on_time);
    space.set(&status, "MotorOnCount", Source::live(move |cell| cell.robots[index].motors_on_count));
}

fn additional_info(space: &mut Instances, robot: &Instance, index: usize) {
    let info = space.object(robot, BrowseName::new(OWN, "AdditionalInfo"), vendor_types::ROBOT_ADDITIONAL_INFO);
    space.set(&info, "CurPos", Source::live(move |cell| pose(&cell.robots[index].target)));
    space.set(&info, "RealPos", Source::live(move |cell| pose(&cell.robots[index].actual)));
}

fn axis(
    space: &mut Instances,
    robot: &Instance,
    description: &RobotDescription,
    (index, at): (usize, usize),
    current: bool,
) -> Option<Instance> {
    let model = description.model.axes()[at];
    let folder = space.member(robot, "Axes")?;
    let axis = space.object(&folder, BrowseName::new(OWN, format!("Axis_{}", at + 1)), AXIS);
    space.set_fixed(&axis, "MotionProfile", model.profile.value());
    let position = Source::live(move |cell| cell.robots[index].axes[at].position);
    space.set(&axis, "ParameterSet/ActualPosition", position);
    let unit = match model.profile {
        MotionProfile::Rotary => units::DEGREE,
        MotionProfile::Linear => units::MILLIMETRE,
    };
    space.set_fixed(&axis, "ParameterSet/ActualPosition/EngineeringUnits", unit.variant());
    let position = space.member(&axis, "ParameterSet/ActualPosition")?;
    space.property(&position, "EURange", standard::RANGE, units::range(model.min, model.max));
    if current {
        let info = space.object(&axis, BrowseName::new(OWN, "AdditionalInfo"), vendor_types::AXIS_ADDITIONAL_INFO);
        space.set(&info, "Torque", Source::live(move |cell| cell.robots[index].axes[at].torque));
        space.set(&info, "Hofs", Source::live(move |cell| cell.robots[index].axes[at].home_offset as f64));
        consumable_status(space, &axis, &Part::OF_AXIS, move |cell, part| cell.robots[index].axes[at].part(part));
    }
    Some(axis)
}

/// One motor moves one axis. What the controller does not know of a motor is Null.
fn power_train(space: &mut Instances, robot: &Instance, (index, at): (usize, usize)) -> Option<Instance> {
    let folder = space.member(robot, "PowerTrains")?;
    let train = space.object(&folder, BrowseName::new(OWN, format!("PowerTrain_{}", at + 1)), POWER_TRAIN);
    let motor = space.object(&train, BrowseName::new(OWN, format!("Motor_{}", at + 1)), MOTOR);
    for name in ["SerialNumber", "Manufacturer", "Model", "ProductCode", "ParameterSet/MotorTemperature"] {
        space.set(&motor, name, Source::Fixed(Variant::Empty));
    }
    let unit = units::CELSIUS.variant();
    space.set_fixed(&motor, "ParameterSet/MotorTemperature/EngineeringUnits", unit);
    let load = Source::live(move |cell| cell.robots[index].axes[at].load_percent());
    space.set(&motor, "ParameterSet/EffectiveLoadRate", load);
    Some(train)
}
