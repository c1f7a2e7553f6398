use std::fmt;
use std::str::FromStr;

use thiserror::Error;

/// A robot model of the virtual controller, with the figures of its manual.
///
/// - C4-A601S: six axes, 600 mm to the centre of the wrist. C4 series manipulator manual, "Specifications" and
///   "Setting the motion range".
/// - GX4-A251S: SCARA, arms of 120 mm and 130 mm. GX series manipulator manual, "Standard Work Envelope" and "Work
///   Envelope Setting by Pulse Range". The manual states the pulses of joint 1; those of the other joints follow from the
///   same 17-bit encoder and the reduction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RobotModel {
    /// Six-axis robot C4-A601S.
    C4A601S,
    /// SCARA robot GX4-A251S.
    Gx4A251S,
}

/// The kinds of robot that the address space shows (manual 3.2.2.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RobotKind {
    /// Articulated robot with six rotary joints: MotionDeviceCategory 1.
    SixAxis,
    /// SCARA with three rotary joints and one linear joint: MotionDeviceCategory 2.
    Scara,
}

impl RobotKind {
    /// The value of MotionDeviceCategory (manual 3.2.2.1, after ISO 8373).
    pub const fn category(self) -> i32 {
        match self {
            Self::SixAxis => 1,
            Self::Scara => 2,
        }
    }
}

/// How an axis moves (manual 3.2.2.1; OPC 40010-1, AxisMotionProfileEnumeration).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MotionProfile {
    /// A rotary axis; positions in degrees.
    Rotary,
    /// A linear axis; positions in millimetres.
    Linear,
}

impl MotionProfile {
    /// The value of MotionProfile.
    pub const fn value(self) -> i32 {
        match self {
            Self::Rotary => 1,
            Self::Linear => 3,
        }
    }
}

/// The fixed figures of one axis. Lengths in mm and angles in degrees by [`AxisModel::profile`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisModel {
    /// Rotary or linear.
    pub profile: MotionProfile,
    /// The lowest position, in degrees or mm.
    pub min: f64,
    /// The highest position, in degrees or mm.
    pub max: f64,
    /// The highest speed, in degrees or mm a second.
    pub max_speed: f64,
    /// The acceleration at full speed settings, in degrees or mm a second squared.
    pub acceleration: f64,
    /// Encoder pulses a degree or mm.
    pub pulses_per_unit: f64,
    /// The rated torque (N·m) or force (N) at the axis, which is 100 % of the torque limit for continuous work.
    pub rated_torque: f64,
}

impl RobotModel {
    /// Every model.
    pub const ALL: [Self; 2] = [Self::C4A601S, Self::Gx4A251S];

    /// The kind of robot.
    pub const fn kind(self) -> RobotKind {
        match self {
            Self::C4A601S => RobotKind::SixAxis,
            Self::Gx4A251S => RobotKind::Scara,
        }
    }

    /// The name of the model, as the nodes Model and ProductCode show it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::C4A601S => "C4-A601S",
            Self::Gx4A251S => "GX4-A251S",
        }
    }

    /// The axes, joint 1 first: six or four.
    pub const fn axes(self) -> &'static [AxisModel] {
        match self {
            Self::C4A601S => &C4_A601S,
            Self::Gx4A251S => &GX4_A251S,
        }
    }
}

impl fmt::Display for RobotModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A robot model that the virtual controller does not have.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("there is no robot model {0:?}; the models are C4-A601S and GX4-A251S")]
pub struct UnknownRobotModel(pub String);

impl FromStr for RobotModel {
    type Err = UnknownRobotModel;

    fn from_str(text: &str) -> Result<Self, UnknownRobotModel> {
        Self::ALL
            .into_iter()
            .find(|model| model.name().eq_ignore_ascii_case(text))
            .ok_or_else(|| UnknownRobotModel(text.to_owned()))
    }
}

const fn rotary(
    (min, max): (f64, f64),
    max_speed: f64,
    acceleration: f64,
    pulses_per_unit: f64,
    torque: f64,
) -> AxisModel {
    AxisModel {
        profile: MotionProfile::Rotary,
        min,
        max,
        max_speed,
        acceleration,
        pulses_per_unit,
        rated_torque: torque,
    }
}

/// A 17-bit encoder behind a reduction: pulses a degree.
const fn pulses_per_degree(reduction: f64) -> f64 {
    131_072.0 * reduction / 360.0
}

const C4_A601S: [AxisModel; 6] = [
    rotary((-170.0, 170.0), 450.0, 2600.0, 4_951_609.0 / 170.0, 101.0),
    rotary((-160.0, 65.0), 450.0, 2600.0, 4_660_338.0 / 160.0, 101.0),
    rotary((-51.0, 225.0), 514.0, 3000.0, 1_299_798.0 / 51.0, 33.0),
    rotary((-200.0, 200.0), 555.0, 3700.0, 4_723_316.0 / 200.0, 10.3),
    rotary((-135.0, 135.0), 555.0, 3700.0, 3_188_239.0 / 135.0, 10.3),
    rotary((-360.0, 360.0), 720.0, 4800.0, 6_553_600.0 / 360.0, 7.9),
];

const GX4_A251S: [AxisModel; 4] = [
    rotary((-50.0, 230.0), 470.0, 3900.0, pulses_per_degree(80.0), 30.0),
    rotary((-141.0, 141.0), 660.0, 5500.0, pulses_per_degree(60.0), 10.0),
    AxisModel {
        profile: MotionProfile::Linear,
        min: -150.0,
        max: 0.0,
        max_speed: 1100.0,
        acceleration: 9000.0,
        pulses_per_unit: 131_072.0 / 18.0,
        rated_torque: 165.0,
    },
    rotary((-360.0, 360.0), 3000.0, 25_000.0, pulses_per_degree(100.0 / 9.0), 3.3),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// GX series manual, "Joint #1 Maximum Pulse Range"; C4 manual, "Setting the motion range".
    #[test]
    fn the_pulse_ranges_are_those_of_the_manuals() {
        let pulses = |model: RobotModel, axis: usize| {
            let axis = model.axes()[axis];
            ((axis.min * axis.pulses_per_unit).round(), (axis.max * axis.pulses_per_unit).round())
        };
        assert_eq!(pulses(RobotModel::Gx4A251S, 0), (-1_456_356.0, 6_699_236.0));
        assert_eq!(pulses(RobotModel::C4A601S, 0), (-4_951_609.0, 4_951_609.0));
        assert_eq!(pulses(RobotModel::C4A601S, 1), (-4_660_338.0, 1_893_262.0));
        assert_eq!(pulses(RobotModel::C4A601S, 2), (-1_299_798.0, 5_734_403.0));
    }

    #[test]
    fn models_are_known_by_name() {
        for model in RobotModel::ALL {
            assert_eq!(model.name().to_lowercase().parse(), Ok(model));
            assert_eq!(model.axes().len(), if model.kind() == RobotKind::SixAxis { 6 } else { 4 });
        }
        assert!("PUMA".parse::<RobotModel>().is_err());
    }
}
