use std::collections::HashSet;

use sha2::{Digest, Sha256};

use super::id::Id;

/// Gives the controller's own nodes their ids: those that clients use literally, and for all other nodes a number that
/// follows from the path, so that it is the same after every start.
#[derive(Debug, Default)]
pub(super) struct Ids {
    taken: HashSet<u32>,
}

impl Ids {
    /// The id of the node with this path. Two nodes never get the same; which of two whose numbers are equal gets the
    /// next one is decided by the order of the calls, which is the same at every start.
    pub(super) fn of(&mut self, path: &str) -> Id {
        if let Some(number) = literal(path) {
            self.taken.insert(number);
            return Id::own(number);
        }
        let digest = Sha256::digest(path.as_bytes());
        let mut number = FIRST_DERIVED | u32::from_be_bytes([digest[0], digest[1], digest[2], digest[3]]) >> 2;
        while !self.taken.insert(number) {
            number = FIRST_DERIVED | (number.wrapping_add(1) & (FIRST_DERIVED - 1));
        }
        Id::own(number)
    }
}

/// Derived numbers are from here to 2³¹ − 1: beyond every literal one, and positive for clients that count with a sign.
const FIRST_DERIVED: u32 = 1 << 30;

/// The numbers in the manual's sample programs (4.1.2.3, 4.3.2), and those between them in the same order.
fn literal(path: &str) -> Option<u32> {
    let (_, path) = path.split_once("/Components/")?;
    Some(match path {
        "MotionLogSystem" => 20_311,
        "MotionLogSystem/DataType" => 20_312,
        "MotionLogSystem/DataNum" => 20_313,
        "MotionLogSystem/SamplingInterval" => 20_314,
        "MotionLogSystem/MotionLog_1" => 20_315,
        "MotionLogSystem/MotionLog_1/Data" => 20_316,
        "MotionLogSystem/MotionLog_1/LoggingStatus" => 20_317,
        "MotionLogSystem/MotionLog_1/DataExistsStatus" => 20_318,
        "MotionLogSystem/MotionLog_1/ErrorStatus" => 20_319,
        "ForceSensorMonitorSystem" => 196_608,
        "ForceSensorMonitorSystem/Port" => 196_609,
        "ForceSensorMonitorSystem/Option" => 196_610,
        "ForceSensorMonitorSystem/DataType" => 196_611,
        "ForceSensorMonitorSystem/DataNum" => 196_612,
        "ForceSensorMonitorSystem/ForceSensorMonitor_1" => 196_864,
        "ForceSensorMonitorSystem/ForceSensorMonitor_1/Data" => 196_865,
        "ForceSensorMonitorSystem/ForceSensorMonitor_1/MonitorStatus" => 196_866,
        "ForceSensorMonitorSystem/ForceSensorMonitor_1/DataExistsStatus" => 196_867,
        "ForceSensorMonitorSystem/ForceSensorMonitor_1/ErrorStatus" => 196_868,
        "ForceSensorMonitorSystem/ForceSensorMonitor_2" => 197_120,
        "ForceSensorMonitorSystem/ForceSensorMonitor_2/Data" => 197_121,
        "ForceSensorMonitorSystem/ForceSensorMonitor_2/MonitorStatus" => 197_122,
        "ForceSensorMonitorSystem/ForceSensorMonitor_2/DataExistsStatus" => 197_123,
        "ForceSensorMonitorSystem/ForceSensorMonitor_2/ErrorStatus" => 197_124,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_follow_from_the_path_and_never_clash() {
        let mut ids = Ids::default();
        let first = ids.of("A/B");
        assert_ne!(first, ids.of("A/B"), "a second node of the same path");
        assert_eq!(first, Ids::default().of("A/B"));
        let many: HashSet<Id> = (0..100_000).map(|n| ids.of(&n.to_string())).collect();
        assert_eq!(many.len(), 100_000);
        assert!(many.iter().all(|id| (FIRST_DERIVED..1 << 31).contains(&id.number)));
    }

    #[test]
    fn the_ids_of_the_sample_programs_are_literal() {
        let id = |path: &str| Ids::default().of(&format!("System/Controllers/Controller_0/Components/{path}")).number;
        assert_eq!(id("ForceSensorMonitorSystem/Port"), 196_609);
        assert_eq!(id("ForceSensorMonitorSystem/ForceSensorMonitor_2/ErrorStatus"), 197_124);
        assert_eq!(id("MotionLogSystem/MotionLog_1/Data"), 20_316);
    }
}
