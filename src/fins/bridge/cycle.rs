//! One cycle of a bridge.

use std::time::Instant;

use tokio_util::sync::CancellationToken;

use super::super::client::ClientError;
use super::super::data_type::Value;
use super::Bridge;
use super::map::Row;
use super::robot::{Direction, ReadError, RobotError, ValuesNotWritten, read_values, write_values};
use super::status::{RowError, SideStatus};
use crate::model::clock;

impl Bridge {
    /// Copies every row once. `stop` ends the cycle before the next row.
    pub(super) async fn cycle(&mut self, stop: &CancellationToken) {
        let start = Instant::now();
        let mut all_copied = true;
        let plc = self.plc.connect().await.map(drop);
        let robot = if stop.is_cancelled() { Ok(()) } else { self.robot.connect().await };
        let sides = Sides {
            plc: plc.clone().map(|()| self.plc.connections()),
            robot: robot.clone().map(|()| self.robot.connections()),
        };
        for number in 0..self.rows.len() {
            if stop.is_cancelled() {
                break;
            }
            all_copied &= self.copy(number, &sides).await;
        }
        let status = &mut self.status;
        status.plc = SideStatus { is_connected: plc.is_ok(), connections: self.plc.connections() };
        status.robot = SideStatus { is_connected: robot.is_ok(), connections: self.robot.connections() };
        status.cycles += 1;
        status.complete_cycles += u64::from(all_copied && !stop.is_cancelled());
        status.last_cycle = start.elapsed();
        status.longest_cycle = status.longest_cycle.max(status.last_cycle);
    }

    /// Whether the row was copied.
    async fn copy(&mut self, number: usize, sides: &Sides) -> bool {
        let row = &self.rows[number];
        let result = match row.direction {
            Direction::ToRobot => match read_plc(&mut self.plc, row, sides).await {
                Err(error) => (None, Err(error)),
                Ok(values) => {
                    let written = match &sides.robot {
                        Err(error) => Err(RowError::Robot(error.clone())),
                        Ok(connection) if *connection != self.robot.connections() => Err(RowError::ConnectedAnew),
                        Ok(_) => self.robot.write(&row.item, &values).await.map_err(RowError::Robot),
                    };
                    (Some(values), written)
                }
            },
            Direction::ToPlc => match read_robot(&mut self.robot, row, sides).await {
                Err(error) => (None, Err(error)),
                Ok(values) => {
                    let written = match &sides.plc {
                        Err(error) => Err(RowError::Plc(error.clone())),
                        Ok(connection) if *connection != self.plc.connections() => Err(RowError::ConnectedAnew),
                        Ok(_) => write_plc(&mut self.plc, row, &values).await,
                    };
                    (Some(values), written)
                }
            },
        };
        let (values, written) = result;
        let status = &mut self.status.rows[number];
        if let Some(values) = values {
            status.values = values;
        }
        match written {
            Ok(()) => {
                status.copied += 1;
                status.copied_at = Some(clock::now());
                status.error = None;
                true
            }
            Err(error) => {
                status.failed += 1;
                status.unknown += u64::from(error.is_unknown());
                status.error = Some(error);
                false
            }
        }
    }
}

/// The number of the connection that stood at the beginning of the cycle, of each side.
struct Sides {
    plc: Result<u64, ClientError>,
    robot: Result<u64, RobotError>,
}

type Read = Result<Vec<Value>, RowError>;

async fn read_plc(plc: &mut super::FinsClient, row: &Row, sides: &Sides) -> Read {
    sides.plc.clone().map_err(RowError::Plc)?;
    let values = read_values(plc, row.plc, row.item.data_type, row.item.word_order).await;
    values.map_err(|error| match error {
        ReadError::Client(error) => RowError::Plc(error),
        ReadError::Value(error) => RowError::Value(error),
    })
}

async fn read_robot(robot: &mut Box<dyn super::RobotSide>, row: &Row, sides: &Sides) -> Read {
    sides.robot.clone().map_err(RowError::Robot)?;
    robot.read(&row.item).await.map_err(RowError::Robot)
}

async fn write_plc(plc: &mut super::FinsClient, row: &Row, values: &[Value]) -> Result<(), RowError> {
    let written = write_values(plc, row.plc, values, row.item.data_type, row.item.word_order).await;
    written.map_err(|error| match error {
        ValuesNotWritten::Value(error) => RowError::Value(error),
        ValuesNotWritten::Write(error) => RowError::PlcWrite(error),
    })
}
