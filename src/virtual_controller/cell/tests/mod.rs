//! Whole cells over simulated time.

mod alarms;
mod commands;
mod execute;
mod queues;
mod values;

use chrono::DateTime;

use super::*;
use crate::model::{ControllerSeries, FirmwareVersion};

const BOTH: [RobotModel; 2] = [RobotModel::C4A601S, RobotModel::Gx4A251S];

fn config(robots: &[RobotModel], seed: u64) -> CellConfig {
    CellConfig {
        name: "Cell 1".parse().unwrap(),
        serial: "SN0000123".parse().unwrap(),
        series: ControllerSeries::Rc800,
        firmware: FirmwareVersion::new(8, 1, 0),
        started: DateTime::from_timestamp(1_780_000_000, 0).unwrap(),
        variables: vec![
            SpelDeclaration::scalar("OPCUA_NumOfProduced", SpelType::UInt32),
            SpelDeclaration::scalar("OPCUA_CycleSeconds", SpelType::Double),
            SpelDeclaration::scalar("OPCUA_OperatingStatus", SpelType::UShort),
            SpelDeclaration::scalar("OPCUA_Recipe", SpelType::String),
        ],
        backup: BackupMemory::default(),
        options: CellOptions { robots: robots.to_vec(), seed, ..CellOptions::default() },
    }
}

fn cell(robots: &[RobotModel]) -> Cell {
    Cell::new(config(robots, 7))
}

fn at(millis: u64) -> CellTime {
    CellTime::from_millis(millis)
}

/// Moves on by so many milliseconds.
fn pass(cell: &mut Cell, millis: u64) -> CellSnapshot {
    let then = cell.now().plus_nanos(millis * 1_000_000);
    cell.advance_to(then);
    cell.snapshot()
}

/// Moves on, by a millisecond each, until something is so; at most a minute.
fn until(cell: &mut Cell, is_so: impl Fn(&CellSnapshot) -> bool) -> CellSnapshot {
    for _ in 0..60_000 {
        let snapshot = pass(cell, 1);
        if is_so(&snapshot) {
            return snapshot;
        }
    }
    panic!("not within a minute: {:?}", cell.snapshot());
}

fn flags(snapshot: &CellSnapshot) -> Vec<&'static str> {
    let flags = snapshot.controller.flags;
    StatusFlag::ALL.into_iter().filter(|flag| flags.contains(*flag)).map(StatusFlag::name).collect()
}
