//! Bridges between simulated PLCs.

use std::sync::Arc;
use std::time::{Duration, Instant};

use async_trait::async_trait;
use parking_lot::Mutex;
use tokio::sync::watch;

use super::super::client::ClientSettings;
use super::super::data_type::Value;
use super::super::plc::{PlcConfig, SimulatedPlc};
use super::map::{BridgeMap, RobotTarget};
use super::robot::{Direction, ItemError, PlcRobot, RobotError, RobotItem, RobotSide};
use super::status::{BridgeStatus, RowError};
use super::*;
use crate::model::Cause;

const EXAMPLE: &str = include_str!("../../../fixtures/fins-bridge.toml");

async fn plc(port: u16) -> SimulatedPlc {
    SimulatedPlc::start(PlcConfig { port, ..PlcConfig::default() }).await.unwrap()
}

/// Short times, so that a lost PLC is noticed soon.
fn quick(settings: &mut ClientSettings) {
    settings.connect = Duration::from_millis(300);
    settings.answer = Duration::from_millis(200);
    settings.first_retry = Duration::from_millis(20);
    settings.last_retry = Duration::from_millis(100);
}

fn map(text: &str, plc: &SimulatedPlc) -> BridgeMap {
    let text = text.replace("127.0.0.1:9600", &plc.address().to_string());
    let mut map = BridgeMap::parse(&text).unwrap();
    map.cycle = Duration::from_millis(10);
    quick(&mut map.plc);
    if let RobotTarget::Plc(settings) = &mut map.robot {
        quick(settings);
    }
    map
}

fn bridge(map: BridgeMap) -> Bridge {
    let RobotTarget::Plc(settings) = map.robot.clone() else { panic!() };
    Bridge::new(map, Box::new(PlcRobot::new(*settings))).unwrap()
}

fn words(plc: &SimulatedPlc, range: &str) -> Vec<u16> {
    plc.state().memory.words(range.parse().unwrap()).unwrap().to_vec()
}

fn set(plc: &SimulatedPlc, start: &str, values: &[u16]) {
    plc.state().memory.set_words(start.parse().unwrap(), values).unwrap();
}

async fn until(status: &mut watch::Receiver<BridgeStatus>, what: impl FnMut(&BridgeStatus) -> bool) {
    let reached = tokio::time::timeout(Duration::from_secs(20), status.wait_for(what)).await;
    reached.expect("the bridge reaches the state").unwrap();
}

#[tokio::test]
async fn the_example_copies_d300_to_d310() {
    let plc = plc(0).await;
    set(&plc, "D300", &[1, 2, 3, 4, 5]);
    let running = bridge(map(EXAMPLE, &plc)).start();
    let mut status = running.status();
    until(&mut status, |status| status.complete_cycles >= 1).await;
    assert_eq!(words(&plc, "D310-314"), [1, 2, 3, 4, 5]);
    set(&plc, "D302", &[777]);
    until(&mut status, |status| status.rows[0].values.get(2) == Some(&Value::Integer(777))).await;
    let bridge = running.stop().await.unwrap();
    assert_eq!(words(&plc, "D310-314"), [1, 2, 777, 4, 5]);
    assert!(!status.borrow().is_running);
    // Nothing is copied any more, until it is started again.
    set(&plc, "D300", &[9]);
    let writes = plc.state().writes;
    let copied = status.borrow().rows[0].copied;
    tokio::time::sleep(Duration::from_millis(50)).await;
    assert_eq!(plc.state().writes, writes);
    let running = bridge.start();
    let mut status = running.status();
    until(&mut status, |status| status.rows[0].copied > copied).await;
    assert_eq!(words(&plc, "D310"), [9]);
}

#[tokio::test]
async fn values_of_all_types_go_both_ways() {
    let plc = plc(0).await;
    let rows = [
        ("D0-3", "E1_0", "to-robot", "f32"),
        ("CIO0.04-0.11", "W0.00", "to-robot", "bit"),
        ("D20-22", "D120", "to-plc", "text"),
        ("D30", "H5", "to-plc", "bcd"),
    ];
    let mut text = "[plc]\nto = \"127.0.0.1:9600\"\n[robot]\nkind = \"same-plc\"\n".to_owned();
    for (from, to, direction, data_type) in rows {
        let row = format!("plc = \"{from}\"\nrobot = \"{to}\"\ndirection = \"{direction}\"\ntype = \"{data_type}\"\n");
        text.push_str(&format!("[[row]]\n{row}"));
    }
    set(&plc, "D0", &[0x0000, 0xC148, 0x0000, 0x3F80]);
    set(&plc, "CIO0", &[0x0550]);
    set(&plc, "D120", &[0x5765, 0x6C64, 0x2D31]);
    set(&plc, "H5", &[0x12A4]);
    let running = bridge(map(&text, &plc)).start();
    let mut status = running.status();
    until(&mut status, |status| status.cycles >= 2).await;
    assert_eq!(words(&plc, "E1_0-3"), [0x0000, 0xC148, 0x0000, 0x3F80]);
    assert_eq!(words(&plc, "W0"), [0x55]);
    assert_eq!(words(&plc, "D20-22"), [0x5765, 0x6C64, 0x2D31]);
    let rows = status.borrow().rows.clone();
    assert_eq!(rows[0].values, [Value::Float(-12.5), Value::Float(1.0)]);
    assert_eq!(rows[2].values, [Value::Text("Weld-1".into())]);
    // A row that cannot be copied does not stop the others, and is copied once it can.
    assert!(matches!(&rows[3].error, Some(RowError::Robot(RobotError::Refused(_)))), "{:?}", rows[3].error);
    assert_eq!((rows[3].copied, rows[0].error.clone(), status.borrow().complete_cycles), (0, None, 0));
    set(&plc, "H5", &[0x1234]);
    until(&mut status, |status| status.complete_cycles >= 1).await;
    assert_eq!(words(&plc, "D30"), [0x1234]);
}

#[tokio::test]
async fn a_plc_that_goes_and_comes_back_is_read_before_it_is_written() {
    let plc1 = plc(0).await;
    let port = plc1.address().port();
    set(&plc1, "D300", &[1, 2, 3, 4, 5]);
    let running = bridge(map(EXAMPLE, &plc1)).start();
    let mut status = running.status();
    until(&mut status, |status| status.complete_cycles >= 1).await;
    plc1.shutdown().await;
    until(&mut status, |status| !status.plc.is_connected && status.rows[0].error.is_some()).await;
    // The new PLC has other values from its first moment on: the old ones must never be written.
    let plc2 = plc(port).await;
    set(&plc2, "D300", &[6, 7, 8, 9, 10]);
    let copied = status.borrow().rows[0].copied;
    until(&mut status, |status| status.rows[0].copied > copied + 3).await;
    running.stop().await.unwrap();
    let stale =
        plc2.state().journal().filter(|record| record.data[..2] != [0, 6] && record.data[..2] != [0, 0]).count();
    assert_eq!((stale, words(&plc2, "D310-314")), (0, vec![6, 7, 8, 9, 10]));
    assert!(status.borrow().plc.connections >= 2);
}

#[tokio::test]
async fn a_lost_answer_counts_as_unknown() {
    let plc = plc(0).await;
    set(&plc, "D300", &[1, 2, 3, 4, 5]);
    let source = SimulatedPlc::start(PlcConfig { node: 2, ..PlcConfig::default() }).await.unwrap();
    let text = EXAMPLE.replace("\"same-plc\"", &format!("\"plc\"\nto = \"{}\"", source.address()));
    let text = text.replace("to-robot", "to-plc");
    let running = bridge(map(&text, &plc)).start();
    let mut status = running.status();
    until(&mut status, |status| status.complete_cycles >= 1).await;
    plc.faults().loses_answers = true;
    until(&mut status, |status| status.rows[0].unknown >= 1).await;
    plc.faults().loses_answers = false;
    let copied = status.borrow().rows[0].copied;
    until(&mut status, |status| status.rows[0].copied > copied).await;
    assert_eq!(status.borrow().rows[0].error, None);
}

#[tokio::test]
async fn stopping_does_not_wait_longer_than_one_row() {
    let plc = plc(0).await;
    let running = bridge(map(EXAMPLE, &plc)).start();
    let mut status = running.status();
    until(&mut status, |status| status.complete_cycles >= 1).await;
    plc.faults().is_silent = true;
    tokio::time::sleep(Duration::from_millis(30)).await;
    let start = Instant::now();
    running.stop().await.unwrap();
    assert!(start.elapsed() < Duration::from_secs(2), "{:?}", start.elapsed());
}

/// A robot that counts up with each read and notes what it is given.
#[derive(Debug, Default)]
struct CountingRobot {
    reads: u16,
    connections: u64,
    written: Arc<Mutex<Vec<Vec<Value>>>>,
    /// Connects anew while it is read.
    loses_connection: bool,
}

#[async_trait]
impl RobotSide for CountingRobot {
    fn check(&self, item: &RobotItem, _: Direction) -> Result<(), ItemError> {
        match item.text.as_str() {
            "counter" => Ok(()),
            other => Err(ItemError::Unsuitable(format!("{other} is unknown"))),
        }
    }

    async fn connect(&mut self) -> Result<(), RobotError> {
        self.connections += u64::from(self.connections == 0);
        Ok(())
    }

    fn connections(&self) -> u64 {
        self.connections
    }

    async fn read(&mut self, _: &RobotItem) -> Result<Vec<Value>, RobotError> {
        self.reads += 1;
        self.connections += u64::from(self.loses_connection);
        if self.reads.is_multiple_of(5) {
            return Err(RobotError::NotReached(Cause::finding("every fifth read fails")));
        }
        Ok(vec![Value::Integer(self.reads.into())])
    }

    async fn write(&mut self, _: &RobotItem, values: &[Value]) -> Result<(), RobotError> {
        self.written.lock().push(values.to_vec());
        Ok(())
    }
}

fn counting(rows: &[(&str, &str)]) -> String {
    let rows = rows.iter().map(|(plc, direction)| {
        format!("[[row]]\nplc = \"{plc}\"\nrobot = \"counter\"\ndirection = \"{direction}\"\n")
    });
    let head = "[plc]\nto = \"127.0.0.1:9600\"\n[robot]\nkind = \"remote\"\nto = \"any\"\n";
    format!("{head}{}", rows.collect::<String>())
}

#[tokio::test]
async fn only_what_was_read_in_the_same_cycle_is_written() {
    let plc = plc(0).await;
    let bridge = Bridge::new(map(&counting(&[("D0", "to-plc")]), &plc), Box::new(CountingRobot::default())).unwrap();
    let running = bridge.start();
    until(&mut running.status(), |status| status.cycles >= 20).await;
    running.stop().await.unwrap();
    let written: Vec<u16> = plc.state().journal().map(|record| u16::from(record.data[1])).collect();
    let expected: Vec<u16> = (1..=u16::MAX).filter(|read| !read.is_multiple_of(5)).take(written.len()).collect();
    assert!(written.len() >= 16 && written == expected, "{written:?}");
}

#[tokio::test]
async fn a_connection_made_anew_in_a_cycle_is_written_to_in_the_next_one() {
    let plc = plc(0).await;
    let robot = CountingRobot { loses_connection: true, ..CountingRobot::default() };
    let written = Arc::clone(&robot.written);
    let rows = counting(&[("D0", "to-plc"), ("D1", "to-robot")]);
    let running = Bridge::new(map(&rows, &plc), Box::new(robot)).unwrap().start();
    let mut status = running.status();
    until(&mut status, |status| status.cycles >= 3).await;
    assert_eq!(status.borrow().rows[1].error, Some(RowError::ConnectedAnew));
    assert!(status.borrow().rows[0].copied >= 3 && written.lock().is_empty());
}

#[test]
fn an_item_that_the_robot_does_not_have_is_found_before_the_start() {
    let text = counting(&[("D0", "to-plc"), ("D1", "to-plc")]).replacen("\"counter\"", "\"speed\"", 1);
    let map = BridgeMap::parse(&text).unwrap();
    let (row, error) = Bridge::new(map, Box::new(CountingRobot::default())).unwrap_err();
    assert_eq!((row, error.to_string().as_str()), (0, "speed is unknown"));
}
