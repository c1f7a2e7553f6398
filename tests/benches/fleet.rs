//! "Get new information" from many virtual controllers that each take 20 ms to answer a request, and what a virtual
//! controller costs in memory.
//!
//! `cargo bench --bench fleet -- [CONTROLLERS] [PARALLELISM]`; 1,000 and 16 without arguments.
//!
//! Configurator and controllers share this process and its cores, and everything between them is real: TCP over
//! loopback, a TLS handshake for every controller, passwords, sessions, JSON.

mod report;
#[allow(dead_code, reason = "tests need more of it")]
#[path = "../common/test_fleet.rs"]
mod test_fleet;

use std::time::{Duration, Instant};

use opcua_configurator::jobs::{GetInfo, Operation, SelfSigned, SelfSignedFields, StartServer};
use opcua_configurator::model::{KeyLength, Validity};
use opcua_configurator::virtual_controller::FleetFirmware;
use report::{Spread, line};
use test_fleet::TestFleet;
use tokio_util::sync::CancellationToken;

const LATENCY: Duration = Duration::from_millis(20);
/// Of one controller's turn: log in, read the information. The second needs the token from the first, so no program can
/// be faster than both together. The third request of a session, the log out, is sent while the next controller has its
/// turn, so it is not part of the ideal; only after the last turn it may be waited for.
const REQUESTS: u32 = 2;
const TARGET: f64 = 1.3;
const ROUNDS: usize = 5;
const SERVERS: usize = 20;

#[tokio::main]
async fn main() {
    let benching = report::is_benching();
    let count = report::number(0).unwrap_or(if benching { 1_000 } else { 8 });
    let parallelism = report::number(1).unwrap_or(16).max(1);

    // What a process costs once, for any number of controllers, is measured with these two.
    let first = TestFleet::start(2, FleetFirmware::Current).await;
    run_servers(&first, 2).await;

    let before = report::resident_bytes();
    let fleet = TestFleet::start(count, FleetFirmware::Current).await;
    let stopped = report::resident_bytes();

    let times = get_information(&fleet, count, parallelism, report::rounds_when(benching, ROUNDS)).await;
    let turns = u32::try_from(count.div_ceil(parallelism)).unwrap_or(u32::MAX);
    let ideal = LATENCY * REQUESTS * turns;
    let ratios = Spread::of(times.iter().map(|time| time.as_secs_f64() / ideal.as_secs_f64()));
    println!(
        "Get new information from {count} virtual controllers, {parallelism} at a time, {} cores",
        report::cores()
    );
    let latency = LATENCY.as_millis();
    line("each controller", format!("log in and information, {latency} ms each; log out during the next one's turn"));
    line("ideal", format!("{:.3} s: {turns} turns × {REQUESTS} requests × {latency} ms", ideal.as_secs_f64()));
    line("measured (s)", Spread::seconds(&times));
    line("measured / ideal", format!("{ratios}; target: at most {TARGET}"));

    println!("Memory of one virtual controller");
    let each = |before: Option<f64>, after: Option<f64>, count: usize| match (before, after) {
        (Some(before), Some(after)) => format!("{:.0} KiB", (after - before) / 1024.0 / count as f64),
        _ => "not measured on this system".to_owned(),
    };
    line("OPC UA server stopped", each(before, stopped, count));
    let servers = SERVERS.min(count);
    let before = report::resident_bytes();
    run_servers(&fleet, servers).await;
    let running = report::resident_bytes();
    line("OPC UA server running", format!("{} more", each(before, running, servers)));
}

/// How long each round took, after one that is not counted: there the controllers compare the password the slow way.
async fn get_information(fleet: &TestFleet, count: usize, parallelism: usize, rounds: usize) -> Vec<Duration> {
    let set_latency = |latency| {
        for index in 0..count {
            fleet.controller(index).faults().update(|switches| switches.latency = latency);
        }
    };
    set_latency(LATENCY);
    let mut times = Vec::new();
    for _ in 0..=rounds {
        let start = Instant::now();
        run(fleet, count, GetInfo, parallelism).await;
        times.push(start.elapsed());
    }
    set_latency(Duration::ZERO);
    times.split_off(1)
}

/// Gives the first `count` controllers a certificate and starts their OPC UA servers.
async fn run_servers(fleet: &TestFleet, count: usize) {
    let fields = SelfSignedFields {
        common_name: None,
        country: String::new(),
        state: String::new(),
        locality: String::new(),
        organisation: String::new(),
        key_length: KeyLength::Rsa2048,
        validity: Validity::try_from(1).expect("a year"),
    };
    run(fleet, count, SelfSigned { fields, backup: None }, report::cores()).await;
    run(fleet, count, StartServer, report::cores()).await;
}

async fn run(fleet: &TestFleet, count: usize, operation: impl Operation + 'static, parallelism: usize) {
    let mut controllers = fleet.listed();
    controllers.truncate(count);
    let mut context = fleet.context();
    context.parallelism = parallelism;
    let (reports, _) = test_fleet::run(controllers, operation, context, CancellationToken::new(), |_| {}).await;
    for report in reports {
        report.result.expect("every controller does as it is told");
    }
}
