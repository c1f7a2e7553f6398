//! A cable is pulled between a client or bridge and a PLC, at every step of a cycle: a proxy in between cuts the connection,
//! or swallows what is sent, after a certain number of bytes.
//!
//! No call may take longer than its limit, and what is reported as written must be written exactly once.

use std::collections::BTreeMap;
use std::net::SocketAddr;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use async_trait::async_trait;
use opcua_configurator::fins::address::{Address, AddressRange};
use opcua_configurator::fins::bridge::Bridge;
use opcua_configurator::fins::bridge::map::BridgeMap;
use opcua_configurator::fins::bridge::robot::{Direction, ItemError, RobotError, RobotItem, RobotSide};
use opcua_configurator::fins::bridge::status::BridgeStatus;
use opcua_configurator::fins::client::{ClientSettings, FinsClient, Transport, WriteError};
use opcua_configurator::fins::data_type::Value;
use opcua_configurator::fins::plc::{PlcConfig, SimulatedPlc};
use opcua_configurator::model;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::watch::Receiver;
use tokio::task::JoinSet;

/// How the cable is pulled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Pull {
    /// Both sides see the connection end.
    Cut,
    /// Nothing arrives any more, and no side is told.
    Drop,
}

/// Forwards connections to a PLC until the cable is pulled.
struct Cable {
    address: SocketAddr,
    /// Bytes that may still pass, in both directions together.
    budget: Arc<AtomicUsize>,
    _task: JoinSet<()>,
}

const WHOLE: usize = usize::MAX / 2;

impl Cable {
    async fn to(plc: SocketAddr, pull: Pull) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = listener.local_addr().unwrap();
        let budget = Arc::new(AtomicUsize::new(WHOLE));
        let shared = Arc::clone(&budget);
        let mut task = JoinSet::new();
        task.spawn(async move {
            let mut connections = JoinSet::new();
            while let Ok((client, _)) = listener.accept().await {
                let budget = Arc::clone(&shared);
                connections.spawn(async move {
                    let Ok(server) = TcpStream::connect(plc).await else { return };
                    let ((from_client, to_client), (from_server, to_server)) =
                        (client.into_split(), server.into_split());
                    let up = forward(from_client, to_server, Arc::clone(&budget), pull);
                    let down = forward(from_server, to_client, budget, pull);
                    // One direction that ends takes the other one with it, as a cut does.
                    tokio::select! {
                        () = up => {}
                        () = down => {}
                    }
                });
            }
        });
        Self { address, budget, _task: task }
    }

    fn pull_after(&self, bytes: usize) {
        self.budget.store(bytes, Ordering::SeqCst);
    }

    fn mend(&self) {
        self.budget.store(WHOLE, Ordering::SeqCst);
    }
}

async fn forward(
    mut from: tokio::net::tcp::OwnedReadHalf,
    mut to: tokio::net::tcp::OwnedWriteHalf,
    budget: Arc<AtomicUsize>,
    pull: Pull,
) {
    let mut buffer = [0; 4_096];
    while let Ok(read) = from.read(&mut buffer).await {
        if read == 0 {
            return;
        }
        let before = budget.fetch_update(Ordering::SeqCst, Ordering::SeqCst, |left| Some(left.saturating_sub(read)));
        let passes = before.unwrap_or(0).min(read);
        if to.write_all(&buffer[..passes]).await.is_err() {
            return;
        }
        if passes < read {
            match pull {
                Pull::Cut => return,
                // A connection over a pulled cable never comes back to life; its ends are given up by their owners.
                Pull::Drop => while from.read(&mut buffer).await.is_ok_and(|read| read > 0) {},
            }
        }
    }
}

const ANSWER: Duration = Duration::from_millis(80);
const CONNECT: Duration = Duration::from_millis(80);
/// Connecting, an answer, and a machine that has other things to do.
const LIMIT: Duration = Duration::from_secs(1);

fn settings(to: SocketAddr) -> ClientSettings {
    let to: model::Address = model::Address::with_default_port(&to.to_string(), 9_600).unwrap();
    ClientSettings {
        answer: ANSWER,
        connect: CONNECT,
        first_retry: Duration::from_millis(1),
        last_retry: Duration::from_millis(5),
        ..ClientSettings::new(to, Transport::Tcp)
    }
}

/// The bytes of one round: handshake 20 + 24, read 34 + 32, write 36 + 30.
const ROUND: usize = 176;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_write_that_is_reported_as_done_is_done_once_wherever_the_cable_is_pulled() {
    for pull in [Pull::Cut, Pull::Drop] {
        let plc = SimulatedPlc::start(PlcConfig { connections: 250, ..PlcConfig::default() }).await.unwrap();
        let cable = Cable::to(plc.address(), pull).await;
        let address: Address = "D0".parse().unwrap();
        let (mut done, mut unknown, mut not_done) = (Vec::new(), Vec::new(), Vec::new());
        // 100 runs: at every second byte of a round, beginning with the handshake.
        for run in 0_u16..100 {
            cable.pull_after(usize::from(run) * ROUND / 100);
            let mut client = FinsClient::new(settings(cable.address));
            let start = Instant::now();
            let read = client.read_words(AddressRange::from(address)).await;
            let value = run + 1;
            let written = client.write_words(address, &[value]).await;
            assert!(start.elapsed() < 2 * LIMIT, "{pull:?} run {run}: {:?}", start.elapsed());
            match written {
                Ok(()) => done.push(value),
                Err(WriteError::Unknown { .. }) => unknown.push(value),
                Err(WriteError::NotDone { .. }) => not_done.push(value),
            }
            drop(read);
            cable.mend();
            // The same client finds the PLC again.
            let until = Instant::now() + Duration::from_secs(10);
            while let Err(error) = client.read_words(AddressRange::from(address)).await {
                assert!(Instant::now() < until, "{pull:?} run {run}: {error}");
                tokio::time::sleep(Duration::from_millis(2)).await;
            }
            client.write_words(address, &[value + 1_000]).await.unwrap();
        }
        let mut counts: BTreeMap<u16, usize> = BTreeMap::new();
        for record in plc.state().journal() {
            *counts.entry(u16::from_be_bytes([record.data[0], record.data[1]])).or_default() += 1;
        }
        let count = |value: &u16| counts.get(value).copied().unwrap_or_default();
        assert!(done.iter().all(|value| count(value) == 1), "{pull:?}: {done:?} {counts:?}");
        assert!(not_done.iter().all(|value| count(value) == 0), "{pull:?}: {not_done:?} {counts:?}");
        assert!(unknown.iter().all(|value| count(value) <= 1), "{pull:?}: {unknown:?} {counts:?}");
        assert!((1..=100).all(|run| count(&(run + 1_000)) == 1), "{pull:?}: {counts:?}");
        // Each step of the round was met: before the write, in it, and behind it.
        assert!(!not_done.is_empty() && !unknown.is_empty(), "{pull:?}: {done:?} {unknown:?} {not_done:?}");
        assert!(unknown.iter().any(|value| count(value) == 1), "an answer was lost: {unknown:?} {counts:?}");
    }
}

/// A robot whose value is another one at each reading.
#[derive(Debug)]
struct Counter(u16);

#[async_trait]
impl RobotSide for Counter {
    fn check(&self, _: &RobotItem, _: Direction) -> Result<(), ItemError> {
        Ok(())
    }

    async fn connect(&mut self) -> Result<(), RobotError> {
        Ok(())
    }

    fn connections(&self) -> u64 {
        1
    }

    async fn read(&mut self, _: &RobotItem) -> Result<Vec<Value>, RobotError> {
        self.0 += 1;
        Ok(vec![Value::Integer(self.0.into())])
    }

    async fn write(&mut self, _: &RobotItem, _: &[Value]) -> Result<(), RobotError> {
        Ok(())
    }
}

fn failures(status: &BridgeStatus) -> u64 {
    status.rows.iter().map(|row| row.failed).sum()
}

async fn reached(status: &mut Receiver<BridgeStatus>, what: impl FnMut(&BridgeStatus) -> bool) -> bool {
    matches!(tokio::time::timeout(10 * LIMIT, status.wait_for(what)).await, Ok(Ok(_)))
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_bridge_writes_no_value_twice_and_none_that_is_old_wherever_the_cable_is_pulled() {
    const RUNS: usize = 100;
    for pull in [Pull::Cut, Pull::Drop] {
        let plc = SimulatedPlc::start(PlcConfig::default()).await.unwrap();
        let cable = Cable::to(plc.address(), pull).await;
        let text = "cycle-ms = 10\n[plc]\nto = \"TO\"\n[robot]\nkind = \"remote\"\nto = \"tcp://robot\"\n\
                    [[row]]\nplc = \"D0\"\nrobot = \"counter\"\ndirection = \"to-plc\"\n\
                    [[row]]\nplc = \"D1\"\nrobot = \"counter\"\ndirection = \"to-robot\"\n";
        let mut map = BridgeMap::parse(&text.replace("TO", &cable.address.to_string())).unwrap();
        map.plc = settings(cable.address);
        let running = Bridge::new(map, Box::new(Counter(0))).map_err(|(_, error)| error).unwrap().start();
        let mut status = running.status();
        for run in 0..RUNS {
            let before = status.borrow().clone();
            // A write with its answer and a read with its answer have 132 bytes.
            cable.pull_after(run * 132 / RUNS);
            let noticed = reached(&mut status, |status| failures(status) > failures(&before)).await;
            assert!(noticed, "{pull:?} run {run}: the bridge does not notice");
            cable.mend();
            let again = reached(&mut status, |status| status.rows[0].copied > before.rows[0].copied).await;
            assert!(again, "{pull:?} run {run}: the bridge does not go on");
        }
        running.stop().await.unwrap();
        let row = status.borrow().rows[0].clone();
        let state = plc.state();
        let written: Vec<u16> =
            state.journal().map(|record| u16::from_be_bytes([record.data[0], record.data[1]])).collect();
        assert!(written.is_sorted_by(|one, next| one < next), "{pull:?}: {written:?}");
        let confirmed = row.copied..=row.copied + row.unknown;
        assert!(confirmed.contains(&(written.len() as u64)), "{pull:?}: {} of {confirmed:?}", written.len());
        assert!(row.unknown > 0, "no answer was lost");
    }
}
