use super::settings::Source;
use crate::records::force::ForceDataType;

/// Columns of a recording that have the same unit and belong into one plot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Quantity {
    /// Fx, Fy, Fz and their magnitude.
    Forces,
    /// Tx, Ty, Tz and their magnitude.
    Torques,
    /// X, Y, Z of the tool.
    Position,
    /// U, V, W of the tool.
    Orientation,
    /// X, Y, Z without force control.
    ReferencePosition,
    /// U, V, W without force control.
    ReferenceOrientation,
    /// What force control adds to X, Y, Z.
    Correction,
    /// Speed of the tool and its components.
    Speed,
    /// Positions of the joints.
    Joints,
    /// Overload rates of the joints.
    Overload,
    /// StepID, SeqNo, ObjectNo, FMNo, and whether force control runs.
    Program,
    /// Pulses of the encoders.
    EncoderPositions,
    /// Temperatures of the encoders.
    EncoderTemperatures,
    /// Commanded currents along the d axis.
    DirectCurrents,
    /// Commanded currents along the q axis.
    QuadratureCurrents,
    /// Speeds of the motors.
    MotorSpeeds,
    /// Electrical angles of the motors.
    ElectricalAngles,
    /// Inputs and outputs, as numbers.
    InputsOutputs,
    /// Forces and torques in counts of the sensor.
    SensorCounts,
    /// Counters of pulse generators.
    PulseCounters,
}

impl Quantity {
    /// What a recording of this data offers; the most wanted first.
    pub fn of(source: Source) -> Vec<Self> {
        use Quantity::*;
        match source {
            Source::Force { data_type: ForceDataType::All, .. } => vec![
                Forces,
                Torques,
                Position,
                Orientation,
                Speed,
                Joints,
                ReferencePosition,
                ReferenceOrientation,
                Correction,
                Overload,
                Program,
            ],
            Source::Force { data_type: ForceDataType::Motion, .. } => {
                vec![Position, Orientation, Speed, Joints, Overload, Program]
            }
            Source::Force { data_type: ForceDataType::Force, .. } => {
                vec![Forces, Torques, Position, Orientation, Program]
            }
            Source::Force { data_type: ForceDataType::Position, .. } => vec![Position, Orientation, Program],
            Source::Motion { .. } => vec![
                Position,
                Orientation,
                EncoderPositions,
                MotorSpeeds,
                QuadratureCurrents,
                DirectCurrents,
                ElectricalAngles,
                EncoderTemperatures,
                SensorCounts,
                InputsOutputs,
                PulseCounters,
            ],
        }
    }

    /// The names of its columns in a recording of this data, in the order of the file.
    pub fn columns(self, source: Source) -> Vec<String> {
        let list = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        let axes = |item: &str, field: &str| (1..=6).map(|axis| format!("{item}_{axis}.{field}")).collect();
        let joints = |field: &str| (1..=6).map(|joint| format!("{field}(J{joint})")).collect();
        let is_motion = matches!(source, Source::Motion { .. });
        match self {
            Self::Forces => list(&["Fx", "Fy", "Fz", "Fmag"]),
            Self::Torques => list(&["Tx", "Ty", "Tz", "Tmag"]),
            Self::Position if is_motion => list(&["TCP.X", "TCP.Y", "TCP.Z"]),
            Self::Position => list(&["CurPos(X)", "CurPos(Y)", "CurPos(Z)"]),
            Self::Orientation if is_motion => list(&["TCP.U", "TCP.V", "TCP.W"]),
            Self::Orientation => list(&["CurPos(U)", "CurPos(V)", "CurPos(W)"]),
            Self::ReferencePosition => list(&["RefPos(X)", "RefPos(Y)", "RefPos(Z)"]),
            Self::ReferenceOrientation => list(&["RefPos(U)", "RefPos(V)", "RefPos(W)"]),
            Self::Correction => list(&["Diff(X)", "Diff(Y)", "Diff(Z)"]),
            Self::Speed => list(&["TCPSpeed", "TCPSpeed(X)", "TCPSpeed(Y)", "TCPSpeed(Z)"]),
            Self::Joints => joints("Joint"),
            Self::Overload => joints("OLRate"),
            Self::Program if matches!(source, Source::Force { data_type: ForceDataType::All, .. }) => {
                list(&["FCOn", "StepID", "SeqNo", "ObjectNo", "FMNo"])
            }
            Self::Program => list(&["StepID", "SeqNo", "ObjectNo", "FMNo"]),
            Self::EncoderPositions => axes("ENC", "ENC_POS"),
            Self::EncoderTemperatures => axes("ENC", "ENC_TEMP"),
            Self::DirectCurrents => axes("DRVCMD", "IDREF"),
            Self::QuadratureCurrents => axes("DRVCMD", "IQREF"),
            Self::MotorSpeeds => axes("DRVCMD", "VEL"),
            Self::ElectricalAngles => axes("DRVCMD", "EANGLE"),
            Self::InputsOutputs => {
                list(&["RT-I/O.RTIO_IN", "RT-I/O.RTIO_OUT", "STD-I/O.STDIO_IN", "STD-I/O.STDIO_OUT"])
            }
            Self::SensorCounts => list(&["FSENS.Fx", "FSENS.Fy", "FSENS.Fz", "FSENS.Mx", "FSENS.My", "FSENS.Mz"]),
            Self::PulseCounters => ["PLSCNT1_NOW", "PLSCNT1_LATCH", "PLSCNT2_NOW", "PLSCNT2_LATCH"]
                .map(|name| format!("PLSCNT.{name}"))
                .into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recorder::RecordSettings;
    use crate::recorder::decoder::Decoder;

    #[test]
    fn every_column_of_a_quantity_is_in_the_recording_and_has_the_same_unit() {
        let force = (0..4).map(|data_type| RecordSettings::force(data_type, 1, 0).unwrap());
        for settings in force.chain([RecordSettings::motion(0, 0).unwrap()]) {
            let decoder = Decoder::new(&settings);
            let columns = decoder.columns();
            let offered = Quantity::of(settings.source());
            assert!(offered.len() >= 3);
            for quantity in offered {
                let unit = |name: &String| {
                    let found = columns.iter().find(|column| column.name == *name);
                    found.unwrap_or_else(|| panic!("{settings:?} has no {name}")).unit
                };
                let mut units: Vec<_> = quantity.columns(settings.source()).iter().map(unit).collect();
                units.dedup();
                assert_eq!(units.len(), 1, "{quantity:?}");
            }
        }
    }
}
