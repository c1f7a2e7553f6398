//! Controllers, Software and TaskControls (manual 3.2.2.1; OPC 40010-1 §7.9, 7.10), and the vendor's nodes of a controller
//! (manual 3.2.3).

use opcua::types::{DateTime, LocalizedText};

use super::consumables::consumable_status;
use super::format::duration;
use super::id::{Id, OWN, standard};
use super::instances::{Instance, Instances};
use super::node::BrowseName;
use super::units;
use super::value::{DataNode, SettingNode, Source};
use super::vendor_types;
use super::{io, spel};
use crate::model::FirmwareGeneration;
use crate::virtual_controller::cell::{CellDescription, CellSnapshot, ChannelValues, Part, StatusFlag};

const CONTROLLER: Id = Id::robotics(1003);
const TASK_CONTROL: Id = Id::robotics(1011);
/// SoftwareType of Devices.
const SOFTWARE: Id = Id::di(15_106);

/// Adds the controller with its software, tasks and components.
pub(super) fn add(space: &mut Instances, folder: &Instance, cell: &CellDescription) -> Instance {
    let description = &cell.controller;
    let controller = space.object(folder, BrowseName::new(OWN, "Controller_0"), CONTROLLER);
    space.set_fixed(&controller, "ComponentName", LocalizedText::from(&*description.name));
    space.set_fixed(&controller, "SerialNumber", description.serial.as_str());
    space.set_fixed(&controller, "Manufacturer", LocalizedText::from(description.manufacturer));
    space.set_fixed(&controller, "Model", LocalizedText::from(description.model));
    space.set_fixed(&controller, "ProductCode", description.model);
    space.set(&controller, "CurrentUser/Level", Source::NULL);
    let on_time = Source::live(|cell| duration(cell.controller.total_power_on));
    space.set(&controller, "ParameterSet/TotalPowerOnTime", on_time);
    let started = Source::live(|cell| DateTime::from(cell.controller.started));
    space.set(&controller, "ParameterSet/StartUpTime", started);
    space.set(&controller, "ParameterSet/Temperature", Source::live(|cell| cell.controller.temperature));
    space.set_fixed(&controller, "ParameterSet/Temperature/EngineeringUnits", units::CELSIUS.variant());
    software(space, &controller, cell);
    tasks(space, &controller, cell);
    if let Some(components) = space.member(&controller, "Components") {
        io::add(space, &components, cell);
        force_sensor(space, &components);
        spel::add(space, &components, cell);
        if description.generation() == FirmwareGeneration::Current {
            motion_log(space, &components);
            status(space, &components);
        }
    }
    if description.generation() == FirmwareGeneration::Current {
        consumable_status(space, &controller, &[Part::Battery], |cell, _| cell.controller.battery);
    }
    controller
}

fn software(space: &mut Instances, controller: &Instance, cell: &CellDescription) {
    let Some(folder) = space.member(controller, "Software") else { return };
    let software = space.object(&folder, BrowseName::new(OWN, "Software_0"), SOFTWARE);
    space.set_fixed(&software, "Manufacturer", LocalizedText::from(cell.controller.manufacturer));
    space.set_fixed(&software, "Model", LocalizedText::from(cell.controller.software_model));
    space.set_fixed(&software, "SoftwareRevision", cell.controller.firmware.to_string());
}

fn tasks(space: &mut Instances, controller: &Instance, cell: &CellDescription) {
    let Some(folder) = space.member(controller, "TaskControls") else { return };
    for (at, task) in cell.tasks.iter().enumerate() {
        let name = BrowseName::new(OWN, format!("TaskControl_{}", task.number));
        let task = space.object(&folder, name, TASK_CONTROL);
        let function = Source::live(move |cell| LocalizedText::from(cell.tasks[at].function));
        space.set(&task, "ComponentName", function);
        space.set(&task, "ParameterSet/TaskProgramName", Source::live(move |cell| cell.tasks[at].program));
        let loaded = Source::live(move |cell| cell.tasks[at].state.is_loaded());
        space.set(&task, "ParameterSet/TaskProgramLoaded", loaded);
        let execution = Source::live(move |cell| cell.tasks[at].execution.value());
        space.set(&task, "ParameterSet/ExecutionMode", execution);
    }
}

/// Manual 3.2.3.2.
fn force_sensor(space: &mut Instances, components: &Instance) {
    let name = BrowseName::new(OWN, "ForceSensorMonitorSystem");
    let system = space.object(components, name, vendor_types::FORCE_SENSOR_MONITOR_SYSTEM);
    space.set(&system, "Port", Source::Setting(SettingNode::ForcePort));
    space.set(&system, "Option", Source::Setting(SettingNode::ForceOption));
    space.set(&system, "DataType", Source::Setting(SettingNode::ForceDataType));
    space.set(&system, "DataNum", Source::Setting(SettingNode::ForceDataNum));
    for number in [1, 2] {
        let name = BrowseName::new(OWN, format!("ForceSensorMonitor_{number}"));
        let monitor = space.object(&system, name, vendor_types::FORCE_SENSOR_MONITOR);
        let values = move |cell: &CellSnapshot| cell.force_sensor.monitors[usize::from(number) - 1];
        channel(space, &monitor, DataNode::Force(number), "MonitorStatus", values);
    }
}

/// Manual 3.2.3.4.
fn motion_log(space: &mut Instances, components: &Instance) {
    let name = BrowseName::new(OWN, "MotionLogSystem");
    let system = space.object(components, name, vendor_types::MOTION_LOG_SYSTEM);
    space.set(&system, "DataType", Source::Setting(SettingNode::MotionDataType));
    space.set(&system, "DataNum", Source::Setting(SettingNode::MotionDataNum));
    space.set(&system, "SamplingInterval", Source::Setting(SettingNode::MotionSamplingInterval));
    let log = space.object(&system, BrowseName::new(OWN, "MotionLog_1"), vendor_types::MOTION_LOG);
    channel(space, &log, DataNode::MotionLog, "LoggingStatus", |cell| cell.motion_log.channel);
}

fn channel(
    space: &mut Instances,
    channel: &Instance,
    data: DataNode,
    recording: &str,
    values: impl Fn(&CellSnapshot) -> ChannelValues + Copy + Send + Sync + 'static,
) {
    space.set(channel, "Data", Source::Data(data));
    space.set(channel, recording, Source::live(move |cell| values(cell).recording.as_str()));
    space.set(channel, "DataExistsStatus", Source::live(move |cell| values(cell).data.as_str()));
    space.set(channel, "ErrorStatus", Source::live(move |cell| values(cell).error.as_str()));
}

/// Manual 3.2.3.10.
fn status(space: &mut Instances, components: &Instance) {
    let name = BrowseName::new(OWN, "ControllerStatus");
    let status = space.object(components, name, vendor_types::CONTROLLER_STATUS);
    for flag in StatusFlag::ALL {
        let is_on = Source::live(move |cell| cell.controller.flags.contains(flag));
        space.variable(&status, BrowseName::new(OWN, flag.name()), standard::BOOLEAN, is_on);
    }
    space.set(&status, "StatusCode", Source::live(|cell| cell.controller.status_code));
    space.set(&status, "CPULoad", Source::live(|cell| cell.controller.cpu_load));
}
