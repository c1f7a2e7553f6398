use crate::model::opcua::NodeId;

/// What a server shows, in the order of the server: OPC UA for Robotics Part 1 (manual 3.2.2) and the vendor's nodes
/// (manual 3.2.3). A part that the server does not have is empty or `None`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LiveLayout {
    /// MotionDevices.
    pub robots: Vec<RobotPoints>,
    /// Controllers.
    pub controllers: Vec<ControllerPoints>,
    /// SafetyStates.
    pub safety: Vec<SafetyPoints>,
    /// TaskControls of all controllers.
    pub tasks: Vec<TaskPoints>,
    /// Inputs and outputs of all controllers.
    pub io: Vec<IoGroupPoints>,
    /// SPEL projects.
    pub projects: Vec<SpelProjectPoints>,
    /// Parts that wear, of controllers, robots and axes.
    pub consumables: Vec<ConsumablePoints>,
    /// ControllerStatus of each controller.
    pub status: Vec<StatusPoints>,
    /// Force sensor and motion log.
    pub queues: Vec<QueueSystemPoints>,
    /// The server has more nodes than were looked at.
    pub is_cut: bool,
}

impl LiveLayout {
    /// Every variable of every part.
    pub fn points(&self) -> impl Iterator<Item = &LivePoint> {
        let robots = self.robots.iter().flat_map(RobotPoints::points);
        let controllers = self.controllers.iter().flat_map(|controller| &controller.points);
        let safety = self.safety.iter().flat_map(SafetyPoints::points);
        let tasks = self.tasks.iter().flat_map(TaskPoints::points);
        let io = self.io.iter().flat_map(IoGroupPoints::points);
        let projects = self.projects.iter().flat_map(SpelProjectPoints::points);
        let consumables = self.consumables.iter().flat_map(ConsumablePoints::points);
        let status = self.status.iter().flat_map(StatusPoints::points);
        let queues = self.queues.iter().flat_map(QueueSystemPoints::points);
        let moving = robots.chain(controllers).chain(safety).chain(tasks);
        moving.chain(io).chain(projects).chain(consumables).chain(status).chain(queues)
    }
}

/// A variable that can be watched.
#[derive(Debug, Clone, PartialEq)]
pub struct LivePoint {
    /// Its id.
    pub node: NodeId,
    /// DisplayName of the node; of an axis, after the names of robot and axis.
    pub name: String,
    /// Symbol of its EngineeringUnits, for example `mm/s`.
    pub unit: Option<String>,
    /// Its EURange: the lowest and highest value in normal operation.
    pub range: Option<(f64, f64)>,
}

/// A MotionDevice.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RobotPoints {
    /// DisplayName of the object.
    pub name: String,
    /// `RobotNumber`: as the controller counts its robots.
    pub number: Option<LivePoint>,
    /// `ComponentName`: its name, which can be set in Epson RC+.
    pub component_name: Option<LivePoint>,
    /// `Model`.
    pub model: Option<LivePoint>,
    /// `SerialNumber`.
    pub serial_number: Option<LivePoint>,
    /// `MotionDeviceCategory`: 1 six-axis, 2 SCARA.
    pub category: Option<LivePoint>,
    /// `InControl`: the motors are on.
    pub in_control: Option<LivePoint>,
    /// `Power`: power is high.
    pub power: Option<LivePoint>,
    /// `Home`: the robot is at its home position.
    pub home: Option<LivePoint>,
    /// `SpeedOverride`, in percent.
    pub speed_override: Option<LivePoint>,
    /// `IntegrationMotorOnTime`, a DurationString.
    pub motor_on_time: Option<LivePoint>,
    /// `MotorOnCount`.
    pub motor_on_count: Option<LivePoint>,
    /// JSON with X, Y, Z in mm and U, V, W in degrees.
    pub target_position: Option<LivePoint>,
    /// As `target_position`.
    pub actual_position: Option<LivePoint>,
    /// Its axes.
    pub axes: Vec<AxisPoints>,
}

/// An axis with the power train that moves it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AxisPoints {
    /// DisplayName of the object.
    pub name: String,
    /// `MotionProfile`: 1 rotary, 3 linear.
    pub profile: Option<LivePoint>,
    /// `ActualPosition`.
    pub position: Option<LivePoint>,
    /// `ActualSpeed`.
    pub speed: Option<LivePoint>,
    /// `ActualAcceleration`.
    pub acceleration: Option<LivePoint>,
    /// `Torque`.
    pub torque: Option<LivePoint>,
    /// `Hofs`: pulses from the origin of the encoder to that of the axis.
    pub hofs: Option<LivePoint>,
    /// `EffectiveLoadRate`, in percent.
    pub load_rate: Option<LivePoint>,
    /// `MotorTemperature`.
    pub motor_temperature: Option<LivePoint>,
}

impl RobotPoints {
    /// Every variable of it.
    pub fn points(&self) -> impl Iterator<Item = &LivePoint> {
        let own = [
            &self.number,
            &self.component_name,
            &self.model,
            &self.serial_number,
            &self.category,
            &self.in_control,
            &self.power,
            &self.home,
            &self.speed_override,
            &self.motor_on_time,
            &self.motor_on_count,
            &self.target_position,
            &self.actual_position,
        ];
        own.into_iter().flatten().chain(self.axes.iter().flat_map(AxisPoints::points))
    }
}

impl AxisPoints {
    /// Every variable of it.
    pub fn points(&self) -> impl Iterator<Item = &LivePoint> {
        let own = [
            &self.profile,
            &self.position,
            &self.speed,
            &self.acceleration,
            &self.torque,
            &self.hofs,
            &self.load_rate,
            &self.motor_temperature,
        ];
        own.into_iter().flatten()
    }
}

/// A controller of the motion device system.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ControllerPoints {
    /// DisplayName of the object.
    pub name: String,
    /// Name, model, serial number, software, times, temperature: what there is.
    pub points: Vec<LivePoint>,
}

/// A SafetyState.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SafetyPoints {
    /// DisplayName of the object.
    pub name: String,
    /// `OperationalMode` (Robotics Part 1, OperationalModeEnumeration).
    pub operational_mode: Option<LivePoint>,
    /// `EmergencyStop`: true while it is in force.
    pub emergency_stop: Option<LivePoint>,
    /// `ProtectiveStop`: true while the safety door is open.
    pub protective_stop: Option<LivePoint>,
}

impl SafetyPoints {
    /// Every variable of it.
    pub fn points(&self) -> impl Iterator<Item = &LivePoint> {
        [&self.operational_mode, &self.emergency_stop, &self.protective_stop].into_iter().flatten()
    }
}

/// A TaskPoints.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TaskPoints {
    /// DisplayName of the object.
    pub name: String,
    /// `ComponentName`: its name, which can be set in Epson RC+.
    pub component_name: Option<LivePoint>,
    /// `TaskProgramName`.
    pub program: Option<LivePoint>,
    /// `TaskProgramLoaded`: the task executes, waits or pauses.
    pub loaded: Option<LivePoint>,
    /// `ExecutionMode` (Robotics Part 1, ExecutionModeEnumeration).
    pub mode: Option<LivePoint>,
}

impl TaskPoints {
    /// Every variable of it.
    pub fn points(&self) -> impl Iterator<Item = &LivePoint> {
        [&self.component_name, &self.program, &self.loaded, &self.mode].into_iter().flatten()
    }
}

/// Inputs or outputs of one I/O system (manual 3.2.3.1).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct IoGroupPoints {
    /// Name of the I/O system.
    pub system: String,
    /// DisplayName of the object.
    pub name: String,
    /// Its nodes, by number.
    pub signals: Vec<IoSignalPoint>,
}

impl IoGroupPoints {
    /// Every variable of it.
    pub fn points(&self) -> impl Iterator<Item = &LivePoint> {
        self.signals.iter().map(|signal| &signal.point)
    }
}

/// A node with one or more bits.
#[derive(Debug, Clone, PartialEq)]
pub struct IoSignalPoint {
    /// The node.
    pub point: LivePoint,
    /// Number at the end of the node's name, or else its position: of the bit, the byte or the word.
    pub number: u32,
}

/// The SPEL project with its backup variables (manual 3.2.3.3).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SpelProjectPoints {
    /// `SpelProjectName`.
    pub name: Option<LivePoint>,
    /// The variables, in the order of the server.
    pub variables: Vec<LivePoint>,
}

impl SpelProjectPoints {
    /// Every variable of it.
    pub fn points(&self) -> impl Iterator<Item = &LivePoint> {
        self.name.iter().chain(&self.variables)
    }
}

/// A part that wears (manual 3.2.3.7).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ConsumablePoints {
    /// The controller, the robot, or the robot and the axis.
    pub owner: String,
    /// Name of the part.
    pub part: String,
    /// `Available`: false for a part that is not managed or not there.
    pub available: Option<LivePoint>,
    /// `InstallationDate`.
    pub installed: Option<LivePoint>,
    /// Months until the recommended replacement.
    pub months_left: Option<LivePoint>,
    /// Percent; 100 is the recommended replacement.
    pub rate: Option<LivePoint>,
}

impl ConsumablePoints {
    /// Every variable of it.
    pub fn points(&self) -> impl Iterator<Item = &LivePoint> {
        [&self.available, &self.installed, &self.months_left, &self.rate].into_iter().flatten()
    }
}

/// ControllerStatus (manual 3.2.3.10).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StatusPoints {
    /// Name of the controller.
    pub controller: String,
    /// One Boolean for each state.
    pub flags: Vec<LivePoint>,
    /// `StatusCode`: status, warning or error.
    pub code: Option<LivePoint>,
    /// `CPULoad`.
    pub cpu_load: Option<LivePoint>,
}

impl StatusPoints {
    /// Every variable of it.
    pub fn points(&self) -> impl Iterator<Item = &LivePoint> {
        self.flags.iter().chain(&self.code).chain(&self.cpu_load)
    }
}

/// What a queue holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum QueueKind {
    /// Records of the force sensor (manual 4.1).
    ForceSensor,
    /// Blocks of the motion log (manual 4.3).
    MotionLog,
}

/// Force sensor or motion log (manual 3.2.3.2, 3.2.3.4): its settings and its queues.
#[derive(Debug, Clone, PartialEq)]
pub struct QueueSystemPoints {
    /// What its queues hold.
    pub kind: QueueKind,
    /// DisplayName of the object.
    pub name: String,
    /// Port, DataType, DataNum, SamplingInterval: what there is.
    pub settings: Vec<LivePoint>,
    /// Its queues.
    pub queues: Vec<QueuePoints>,
}

impl QueueSystemPoints {
    /// Every variable of it.
    pub fn points(&self) -> impl Iterator<Item = &LivePoint> {
        self.settings.iter().chain(self.queues.iter().flat_map(QueuePoints::points))
    }
}

/// The state of one queue. Its `Data` is left out: reading it takes the data away.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct QueuePoints {
    /// DisplayName of the object.
    pub name: String,
    /// `Stop` or `Run`.
    pub running: Option<LivePoint>,
    /// `Empty` or `Ready`.
    pub data_exists: Option<LivePoint>,
    /// `None`, `Warning` or `Error`.
    pub error: Option<LivePoint>,
}

impl QueuePoints {
    /// Every variable of it.
    pub fn points(&self) -> impl Iterator<Item = &LivePoint> {
        [&self.running, &self.data_exists, &self.error].into_iter().flatten()
    }
}
