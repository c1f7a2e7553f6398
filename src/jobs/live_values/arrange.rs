use std::collections::HashMap;

use super::consumed::is_consumed_by_reading;
use super::layout::{
    AxisPoints, ConsumablePoints, ControllerPoints, IoGroupPoints, IoSignalPoint, LiveLayout, LivePoint, QueueKind,
    QueuePoints, QueueSystemPoints, RobotPoints, SafetyPoints, SpelProjectPoints, StatusPoints, TaskPoints,
};
use super::tree::{NodeIndex, NodeTree};
use crate::model::opcua::{NodeId, Value};

/// Finds robots, tasks, signals … by the BrowseNames of OPC UA for Robotics Part 1 and of the manual's chapter 3.2, and by
/// the names of the vendor's types. `properties`: values of the nodes EngineeringUnits and EURange.
pub(super) fn arrange(tree: &NodeTree, properties: &HashMap<NodeId, Value>) -> LiveLayout {
    let arranger = Arranger { tree, properties };
    let mut layout = LiveLayout { is_cut: tree.is_cut, ..LiveLayout::default() };
    if tree.len() == 0 {
        return layout;
    }
    for system in tree.objects(0) {
        for robot in tree.instances(system, "MotionDevices") {
            arranger.robot(robot, &mut layout);
        }
        for controller in tree.instances(system, "Controllers") {
            arranger.controller(controller, &mut layout);
        }
        for state in tree.instances(system, "SafetyStates") {
            layout.safety.push(SafetyPoints {
                name: arranger.name(state),
                operational_mode: arranger.point(state, "OperationalMode"),
                emergency_stop: arranger.point(state, "EmergencyStop"),
                protective_stop: arranger.point(state, "ProtectiveStop"),
            });
        }
    }
    layout
}

struct Arranger<'a> {
    tree: &'a NodeTree,
    properties: &'a HashMap<NodeId, Value>,
}

impl Arranger<'_> {
    fn name(&self, index: NodeIndex) -> String {
        self.tree.name(index).to_owned()
    }

    /// The variable of this name of an object.
    fn point(&self, object: NodeIndex, name: &str) -> Option<LivePoint> {
        self.tree.variable(object, name).map(|index| self.point_at(index))
    }

    /// Those of these variables that an object has.
    fn points(&self, object: NodeIndex, names: &[&str]) -> Vec<LivePoint> {
        names.iter().filter_map(|name| self.point(object, name)).collect()
    }

    fn point_at(&self, index: NodeIndex) -> LivePoint {
        let property = |name: &str| self.properties.get(&self.tree.node(self.tree.child(index, name)?).id);
        let unit = match property("EngineeringUnits") {
            Some(Value::EngineeringUnits { symbol, .. }) if !symbol.is_empty() => Some(symbol.clone()),
            _ => None,
        };
        let range = match property("EURange") {
            Some(Value::Range { low, high }) if low < high => Some((*low, *high)),
            _ => None,
        };
        LivePoint { node: self.tree.node(index).id.clone(), name: self.name(index), unit, range }
    }

    fn robot(&self, robot: NodeIndex, layout: &mut LiveLayout) {
        let (tree, name) = (self.tree, self.name(robot));
        let of = |part: &str, variable: &str| self.point(tree.child(robot, part)?, variable);
        let axes = tree.instances(robot, "Axes");
        let trains = tree.instances(robot, "PowerTrains");
        layout.robots.push(RobotPoints {
            name: name.clone(),
            number: self.point(robot, "RobotNumber"),
            component_name: self.point(robot, "ComponentName"),
            model: self.point(robot, "Model"),
            serial_number: self.point(robot, "SerialNumber"),
            category: self.point(robot, "MotionDeviceCategory"),
            in_control: self.point(robot, "InControl"),
            speed_override: self.point(robot, "SpeedOverride"),
            power: of("RobotStatus", "Power"),
            home: of("RobotStatus", "Home"),
            motor_on_time: of("RobotStatus", "IntegrationMotorOnTime"),
            motor_on_count: of("RobotStatus", "MotorOnCount"),
            target_position: of("AdditionalInfo", "CurPos"),
            actual_position: of("AdditionalInfo", "RealPos"),
            axes: axes
                .iter()
                .enumerate()
                .map(|(at, axis)| self.axis(&name, *axis, self.train(*axis, at, &trains)))
                .collect(),
        });
        self.consumables(robot, &name, layout);
        for axis in axes {
            self.consumables(axis, &format!("{name}, {}", self.name(axis)), layout);
        }
    }

    /// The power train that moves an axis: the one that refers to it (Robotics Part 1, Moves), or else that at the same
    /// position.
    fn train(&self, axis: NodeIndex, at: usize, trains: &[NodeIndex]) -> Option<NodeIndex> {
        let moves = |train: &&NodeIndex| self.tree.children(**train).any(|child| child == axis);
        trains.iter().find(moves).or_else(|| trains.get(at)).copied()
    }

    /// The variables are named with robot and axis, which tells them apart in a plot.
    fn axis(&self, robot: &str, axis: NodeIndex, train: Option<NodeIndex>) -> AxisPoints {
        let tree = self.tree;
        let named = |object: NodeIndex, name: &str| {
            let point = self.point(object, name)?;
            Some(LivePoint { name: format!("{robot} {} {}", self.name(axis), point.name), ..point })
        };
        let motor = train.and_then(|train| {
            let is_motor = |part: &NodeIndex| tree.variable(*part, "MotorTemperature").is_some();
            tree.objects(train).find(is_motor)
        });
        let extra = |name: &str| named(tree.child(axis, "AdditionalInfo")?, name);
        AxisPoints {
            name: self.name(axis),
            profile: named(axis, "MotionProfile"),
            position: named(axis, "ActualPosition"),
            speed: named(axis, "ActualSpeed"),
            acceleration: named(axis, "ActualAcceleration"),
            torque: extra("Torque"),
            hofs: extra("Hofs"),
            load_rate: motor.and_then(|motor| named(motor, "EffectiveLoadRate")),
            motor_temperature: motor.and_then(|motor| named(motor, "MotorTemperature")),
        }
    }

    fn controller(&self, controller: NodeIndex, layout: &mut LiveLayout) {
        let (tree, name) = (self.tree, self.name(controller));
        let mut points = self.points(controller, &["ComponentName", "Manufacturer", "Model", "SerialNumber"]);
        for software in tree.instances(controller, "Software") {
            points.extend(self.points(software, &["SoftwareRevision"]));
        }
        points.extend(self.points(controller, &["StartUpTime", "TotalPowerOnTime", "Temperature"]));
        layout.controllers.push(ControllerPoints { name: name.clone(), points });
        for task in tree.instances(controller, "TaskControls") {
            layout.tasks.push(TaskPoints {
                name: self.name(task),
                component_name: self.point(task, "ComponentName"),
                program: self.point(task, "TaskProgramName"),
                loaded: self.point(task, "TaskProgramLoaded"),
                mode: self.point(task, "ExecutionMode"),
            });
        }
        for component in tree.instances(controller, "Components") {
            self.component(component, layout);
        }
        self.consumables(controller, &name, layout);
        let in_components = || tree.child(tree.child(controller, "Components")?, "ControllerStatus");
        if let Some(status) = tree.child(controller, "ControllerStatus").or_else(in_components) {
            let is_number = |index: NodeIndex| {
                matches!(tree.node(index).browse_name.name.as_str(), "StatusCode" | "CPULoad" | "CPUload")
            };
            let flags = tree.variables(status).filter(|index| !is_number(*index));
            layout.status.push(StatusPoints {
                controller: name,
                flags: flags.map(|index| self.point_at(index)).collect(),
                code: self.point(status, "StatusCode"),
                // Editions of the manual spell it differently.
                cpu_load: self.point(status, "CPULoad").or_else(|| self.point(status, "CPUload")),
            });
        }
    }

    fn component(&self, component: NodeIndex, layout: &mut LiveLayout) {
        let tree = self.tree;
        let has = |name: &str| tree.variable(component, name).is_some();
        match tree.type_name(component) {
            "IOSystemType" => layout.io.extend(tree.objects(component).map(|signals| self.signals(component, signals))),
            "SpelProjectType" => layout.projects.push(self.project(component)),
            "ForceSensorMonitorSystemType" => layout.queues.push(self.queues(component, QueueKind::ForceSensor)),
            "MotionLogSystemType" => layout.queues.push(self.queues(component, QueueKind::MotionLog)),
            // A server whose types have other names still has these members.
            _ if has("SpelProjectName") => layout.projects.push(self.project(component)),
            _ if has("SamplingInterval") => layout.queues.push(self.queues(component, QueueKind::MotionLog)),
            _ if has("Port") && has("DataNum") => layout.queues.push(self.queues(component, QueueKind::ForceSensor)),
            _ => {}
        }
    }

    fn signals(&self, system: NodeIndex, signals: NodeIndex) -> IoGroupPoints {
        let points = self.tree.variables(signals).enumerate().map(|(at, index)| {
            let browse_name = &self.tree.node(index).browse_name.name;
            IoSignalPoint { point: self.point_at(index), number: trailing_number(browse_name).unwrap_or(at as u32) }
        });
        let mut points: Vec<IoSignalPoint> = points.collect();
        points.sort_by_key(|signal| signal.number);
        IoGroupPoints { system: self.name(system), name: self.name(signals), signals: points }
    }

    fn project(&self, project: NodeIndex) -> SpelProjectPoints {
        let tree = self.tree;
        let containers = tree.objects(project);
        let variables = containers.flat_map(|container| tree.variables(container));
        SpelProjectPoints {
            name: self.point(project, "SpelProjectName"),
            variables: variables.map(|index| self.point_at(index)).collect(),
        }
    }

    fn queues(&self, system: NodeIndex, kind: QueueKind) -> QueueSystemPoints {
        let tree = self.tree;
        let has_data = |index: &NodeIndex| {
            tree.variables(*index).any(|member| is_consumed_by_reading(&tree.node(member).browse_name))
        };
        let running = match kind {
            QueueKind::ForceSensor => "MonitorStatus",
            QueueKind::MotionLog => "LoggingStatus",
        };
        let queue = |index: NodeIndex| QueuePoints {
            name: self.name(index),
            running: self.point(index, running),
            data_exists: self.point(index, "DataExistsStatus"),
            error: self.point(index, "ErrorStatus"),
        };
        QueueSystemPoints {
            kind,
            name: self.name(system),
            settings: self.points(system, &["Port", "DataType", "DataNum", "SamplingInterval"]),
            queues: tree.objects(system).filter(has_data).map(queue).collect(),
        }
    }

    fn consumables(&self, of: NodeIndex, owner: &str, layout: &mut LiveLayout) {
        for part in self.tree.instances(of, "ConsumableStatus") {
            layout.consumables.push(ConsumablePoints {
                owner: owner.to_owned(),
                part: self.name(part),
                available: self.point(part, "Available"),
                installed: self.point(part, "InstallationDate"),
                months_left: self.point(part, "MonthRemaining"),
                rate: self.point(part, "ConsumptionRate"),
            });
        }
    }
}

/// The number that a name ends with.
fn trailing_number(name: &str) -> Option<u32> {
    let digits = name.len() - name.trim_end_matches(|char: char| char.is_ascii_digit()).len();
    name[name.len() - digits..].parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jobs::live_values::samples::Space;

    #[test]
    fn a_robot_is_found_with_the_train_that_moves_each_axis() {
        let mut space = Space::new();
        let robot = space.object("DeviceSet/System/MotionDevices/Robot1", "MotionDeviceType");
        let axes = ["J1", "J2"].map(|name| {
            let path = format!("DeviceSet/System/MotionDevices/Robot1/Axes/{name}");
            let axis = space.object(&path, "AxisType");
            space.variable(&format!("{path}/ParameterSet/ActualPosition"), "AnalogUnitType");
            space.unit(&format!("{path}/ParameterSet/ActualPosition"), "deg", (-170.0, 170.0));
            space.variable(&format!("{path}/AdditionalInfo/Torque"), "BaseDataVariableType");
            axis
        });
        // In the other order.
        for (name, axis) in [("P1", axes[1]), ("P2", axes[0])] {
            let path = format!("DeviceSet/System/MotionDevices/Robot1/PowerTrains/{name}");
            let train = space.object(&path, "PowerTrainType");
            space.variable(&format!("{path}/Motor/ParameterSet/MotorTemperature"), "AnalogUnitType");
            space.variable(&format!("{path}/Motor/ParameterSet/EffectiveLoadRate"), "BaseDataVariableType");
            space.refer(train, axis);
        }
        space.variable("DeviceSet/System/MotionDevices/Robot1/ParameterSet/SpeedOverride", "AnalogUnitType");
        space.variable("DeviceSet/System/MotionDevices/Robot1/RobotStatus/Power", "BaseDataVariableType");
        space.variable("DeviceSet/System/MotionDevices/Robot1/AdditionalInfo/RealPos", "BaseDataVariableType");
        let battery = "DeviceSet/System/MotionDevices/Robot1/Axes/J1/ConsumableStatus/Battery";
        space.variable(&format!("{battery}/MonthRemaining"), "BaseDataVariableType");

        let layout = space.arranged();
        let [found] = &layout.robots[..] else { panic!("{layout:?}") };
        assert_eq!(space.id_of(robot), space.id("DeviceSet/System/MotionDevices/Robot1"));
        assert_eq!(found.name, "Robot1");
        assert!(found.speed_override.is_some() && found.power.is_some() && found.actual_position.is_some());
        assert!(found.home.is_none() && found.target_position.is_none());
        let position = found.axes[0].position.as_ref().unwrap();
        assert_eq!(position.name, "Robot1 J1 ActualPosition");
        assert_eq!((position.unit.as_deref(), position.range), (Some("deg"), Some((-170.0, 170.0))));
        let load = |at: usize| found.axes[at].load_rate.as_ref().unwrap().node.clone();
        let train = |name: &str| {
            let path = format!("DeviceSet/System/MotionDevices/Robot1/PowerTrains/{name}/Motor/ParameterSet");
            space.id(&format!("{path}/EffectiveLoadRate"))
        };
        assert_eq!([load(0), load(1)], [train("P2"), train("P1")]);
        let [part] = &layout.consumables[..] else { panic!("{layout:?}") };
        assert_eq!((part.owner.as_str(), part.part.as_str()), ("Robot1, J1", "Battery"));
        assert!(part.months_left.is_some() && part.rate.is_none());
    }

    #[test]
    fn components_are_told_apart_by_their_types() {
        let mut space = Space::new();
        let components = "DeviceSet/System/Controllers/Controller_0/Components";
        let plain = "BaseDataVariableType";
        space.object(&format!("{components}/Standard"), "IOSystemType");
        space.object(&format!("{components}/Standard/Inputs"), "IOSignalsType");
        for name in ["In10", "In2", "In1"] {
            space.variable(&format!("{components}/Standard/Inputs/{name}"), plain);
        }
        space.object(&format!("{components}/SpelProject"), "SpelProjectType");
        space.variable(&format!("{components}/SpelProject/SpelProjectName"), plain);
        space.variable(&format!("{components}/SpelProject/BackupVariables/OPCUA_Code"), plain);
        space.object(&format!("{components}/Force"), "ForceSensorMonitorSystemType");
        for name in ["Port", "DataNum", "Monitor_1/Data", "Monitor_1/MonitorStatus", "Monitor_1/ErrorStatus"] {
            space.variable(&format!("{components}/Force/{name}"), plain);
        }
        space.object(&format!("{components}/Log"), "OtherVendorsType");
        for name in ["SamplingInterval", "Channel/Data", "Channel/LoggingStatus"] {
            space.variable(&format!("{components}/Log/{name}"), plain);
        }
        for name in ["Auto", "EStop", "StatusCode", "CPUload"] {
            space.variable(&format!("{components}/ControllerStatus/{name}"), plain);
        }
        space.variable("DeviceSet/System/SafetyStates/State/ParameterSet/EmergencyStop", plain);
        let task = "DeviceSet/System/Controllers/Controller_0/TaskControls/Task_1/ParameterSet/TaskProgramName";
        space.variable(task, plain);

        let layout = space.arranged();
        let [inputs] = &layout.io[..] else { panic!("{layout:?}") };
        assert_eq!((inputs.system.as_str(), inputs.name.as_str()), ("Standard", "Inputs"));
        assert_eq!(inputs.signals.iter().map(|signal| signal.number).collect::<Vec<_>>(), [1, 2, 10]);
        let [project] = &layout.projects[..] else { panic!("{layout:?}") };
        assert_eq!((project.name.is_some(), project.variables[0].name.as_str()), (true, "OPCUA_Code"));
        let kinds: Vec<_> = layout.queues.iter().map(|system| (system.kind, system.queues.len())).collect();
        assert_eq!(kinds, [(QueueKind::ForceSensor, 1), (QueueKind::MotionLog, 1)]);
        assert!(layout.queues[1].queues[0].running.is_some());
        let [status] = &layout.status[..] else { panic!("{layout:?}") };
        assert_eq!(status.flags.iter().map(|flag| flag.name.as_str()).collect::<Vec<_>>(), ["Auto", "EStop"]);
        assert!(status.code.is_some() && status.cpu_load.is_some());
        assert!(layout.safety[0].emergency_stop.is_some() && layout.tasks[0].program.is_some());
    }

    #[test]
    fn no_part_of_the_layout_is_consumed_by_reading() {
        let mut space = Space::new();
        let log = "DeviceSet/System/Controllers/Controller_0/Components/Log";
        space.object(log, "MotionLogSystemType");
        for name in ["SamplingInterval", "Channel/Data", "Channel/LoggingStatus"] {
            space.variable(&format!("{log}/{name}"), "BaseDataVariableType");
        }
        let data = space.id(&format!("{log}/Channel/Data"));
        assert!(space.arranged().points().all(|point| point.node != data));
    }

    #[test]
    fn a_server_that_shows_something_else_has_an_empty_layout() {
        let mut space = Space::new();
        space.variable("DeviceSet/Pump/Speed", "AnalogUnitType");
        assert_eq!(space.arranged(), LiveLayout::default());
        assert_eq!(arrange(&NodeTree::default(), &HashMap::new()), LiveLayout::default());
    }

    #[test]
    fn a_name_may_end_with_its_number() {
        assert_eq!(["In_0012", "In", "12", "9999999999"].map(trailing_number), [Some(12), None, Some(12), None]);
    }
}
