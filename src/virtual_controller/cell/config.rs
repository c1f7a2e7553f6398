use chrono::{DateTime, Utc};

use super::backup_memory::BackupMemory;
use super::robot_model::RobotModel;
use super::spel_declaration::SpelDeclaration;
use super::time::ClockRate;
use crate::model::{ControllerName, ControllerSeries, FirmwareVersion, SerialNumber};

/// What a cell is built from. The same configuration and the same commands at the same simulated times give the same
/// values.
#[derive(Debug, Clone, PartialEq)]
pub struct CellConfig {
    /// The name of the controller.
    pub name: ControllerName,
    /// The serial number of the controller.
    pub serial: SerialNumber,
    /// The series of the controller, which is its model.
    pub series: ControllerSeries,
    /// The firmware, which decides what the cell offers.
    pub firmware: FirmwareVersion,
    /// The moment of switching on, by the controller's clock.
    pub started: DateTime<Utc>,
    /// The backup variables of the project. The address space shows at most 256 of them.
    pub variables: Vec<SpelDeclaration>,
    /// What the battery has kept since the last power-off.
    pub backup: BackupMemory,
    /// What a person chooses.
    pub options: CellOptions,
}

/// The most robots on one controller. Those beyond it are not taken.
pub const MAX_ROBOTS: usize = 4;

/// The part of the configuration that a person chooses. By default one six-axis robot at normal speed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CellOptions {
    /// The robots on the controller: one to [`MAX_ROBOTS`]. An empty list stands for one six-axis robot.
    pub robots: Vec<RobotModel>,
    /// Points, times, wear and names of the program follow from it.
    pub seed: u64,
    /// How fast simulated time runs.
    pub rate: ClockRate,
    /// Clients may write inputs and see word nodes, as in the vendor's virtual controllers. Off by default.
    pub virtual_io: bool,
}

impl Default for CellOptions {
    fn default() -> Self {
        Self { robots: vec![RobotModel::C4A601S], seed: 1, rate: ClockRate::default(), virtual_io: false }
    }
}
