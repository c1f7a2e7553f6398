//! FINS over loopback: requests a second and their latency, against fins-driver from Python; and a hundred bridges in one
//! process.
//!
//! `cargo bench --bench fins -- [REQUESTS] [BRIDGES]`; 20,000 and 100 without arguments. fins-driver is taken from the
//! Python of `OPCUA_INTEROP_PYTHON` or from `python3`; without it, its lines are missing.
//!
//! Client and simulated PLC share this process and its cores. fins-driver, a process of its own, asks the same PLC; it
//! speaks FINS/UDP only.

#[allow(dead_code, reason = "other benches need more of it")]
mod report;

use std::net::SocketAddr;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use opcua_configurator::fins::address::AddressRange;
use opcua_configurator::fins::bridge::Bridge;
use opcua_configurator::fins::bridge::map::{BridgeMap, RobotTarget};
use opcua_configurator::fins::bridge::robot::PlcRobot;
use opcua_configurator::fins::client::{ClientSettings, FinsClient, Transport};
use opcua_configurator::fins::plc::{PlcConfig, SimulatedPlc};
use opcua_configurator::model::Address;
use report::{Spread, line};

type Failure = Box<dyn std::error::Error + Send + Sync>;

const ROUNDS: usize = 5;
/// Words of a request.
const SIZES: [u16; 2] = [1, 500];

#[tokio::main]
async fn main() -> Result<(), Failure> {
    let benching = report::is_benching();
    let requests = report::number(0).unwrap_or(if benching { 20_000 } else { 20 }).max(1);
    let bridges = report::number(1).unwrap_or(if benching { 100 } else { 2 }).max(1);
    let rounds = report::rounds_when(benching, ROUNDS);
    let plc = SimulatedPlc::start(PlcConfig::default()).await?;
    println!("FINS over loopback, {} cores", report::cores());
    for transport in [Transport::Tcp, Transport::Udp] {
        for words in SIZES {
            let mut rates = Vec::new();
            let mut latencies = Vec::new();
            for _ in 0..rounds {
                let (rate, mut times) = requests_of(&plc, transport, words, requests).await?;
                rates.push(rate);
                latencies.append(&mut times);
            }
            println!("{transport:?}, {words} words");
            line("requests a second", Spread::of(rates));
            line("latency (µs)", percentiles(latencies));
        }
    }
    match fins_driver(plc.address(), requests.min(5_000)) {
        None => println!("fins-driver was not found"),
        Some(rates) => {
            for (words, rate) in SIZES.into_iter().zip(rates) {
                println!("fins-driver, Udp, {words} words");
                line("requests a second", format!("{rate:.0}"));
            }
        }
    }
    run_bridges(bridges, if benching { Duration::from_secs(10) } else { Duration::from_millis(300) }).await
}

/// Requests one after the other: how many a second, and how long each took in µs.
async fn requests_of(
    plc: &SimulatedPlc,
    transport: Transport,
    words: u16,
    requests: usize,
) -> Result<(f64, Vec<f64>), Failure> {
    let to = Address::with_default_port(&plc.address().to_string(), 9_600)?;
    let mut client = FinsClient::new(ClientSettings::new(to, transport));
    let range = AddressRange::new("D0".parse()?, words.into())?;
    client.read_words(range).await?;
    let mut times = Vec::with_capacity(requests);
    let start = Instant::now();
    for _ in 0..requests {
        let begin = Instant::now();
        if client.read_words(range).await?.len() != usize::from(words) {
            return Err("words are missing".into());
        }
        times.push(begin.elapsed().as_secs_f64() * 1e6);
    }
    Ok((requests as f64 / start.elapsed().as_secs_f64(), times))
}

fn percentiles(mut times: Vec<f64>) -> String {
    times.sort_by(f64::total_cmp);
    let at = |part: f64| times.get(((times.len() - 1) as f64 * part) as usize).copied().unwrap_or(f64::NAN);
    format!("median {:.0}, 99 % {:.0}, most {:.0}", at(0.5), at(0.99), at(1.0))
}

/// Requests a second of one word and of many.
fn fins_driver(plc: SocketAddr, requests: usize) -> Option<[f64; 2]> {
    let python = std::env::var_os("OPCUA_INTEROP_PYTHON").unwrap_or_else(|| "python3".into());
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/interop/fins_driver.py");
    let mut command = Command::new(python);
    command.arg(script).args(["bench", &plc.ip().to_string(), &plc.port().to_string(), &requests.to_string()]);
    let found: serde_json::Value = serde_json::from_slice(&command.output().ok()?.stdout).ok()?;
    let rate = |key: &str| Some(requests as f64 / found[key].as_f64()?);
    Some([rate("one")?, rate("many")?])
}

/// Bridges side by side, each with a PLC of its own and a cycle of 100 ms.
async fn run_bridges(count: usize, duration: Duration) -> Result<(), Failure> {
    let sample = include_str!("../../fixtures/fins-bridge.toml");
    let mut plcs = Vec::new();
    let mut running = Vec::new();
    for _ in 0..count {
        let plc = SimulatedPlc::start(PlcConfig { extended_memory_banks: 0, ..PlcConfig::default() }).await?;
        let map = BridgeMap::parse(&sample.replace("127.0.0.1:9600", &plc.address().to_string()))?;
        let RobotTarget::Plc(robot) = map.robot.clone() else { return Err("the sample has another robot".into()) };
        let bridge = Bridge::new(map, Box::new(PlcRobot::new(*robot))).map_err(|(_, error)| error)?;
        running.push(bridge.start());
        plcs.push(plc);
    }
    let (before, start) = (processor_seconds(), Instant::now());
    tokio::time::sleep(duration).await;
    let (elapsed, after) = (start.elapsed().as_secs_f64(), processor_seconds());
    let (mut cycles, mut complete, mut longest) = (0, 0, Duration::ZERO);
    for bridge in &running {
        let status = bridge.status().borrow().clone();
        cycles += status.cycles;
        complete += status.complete_cycles;
        longest = longest.max(status.longest_cycle);
    }
    println!("{count} bridges, cycle 100 ms, {elapsed:.1} s");
    line("cycles a second", format!("{:.0}", cycles as f64 / elapsed));
    line("incomplete cycles", cycles - complete);
    line("longest cycle (ms)", format!("{:.1}", longest.as_secs_f64() * 1e3));
    if let (Some(before), Some(after)) = (before, after) {
        line("processor (cores)", format!("{:.2}", (after - before) / elapsed));
    }
    if let Some(bytes) = report::resident_bytes() {
        line("resident (MB)", format!("{:.0}", bytes / 1e6));
    }
    for bridge in running {
        bridge.stop().await?;
    }
    Ok(())
}

/// Processor time of this process so far; `None` where the system does not say it the way Linux does.
fn processor_seconds() -> Option<f64> {
    const TICKS: f64 = 100.0;
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = stat.rsplit(')').next()?.split_whitespace().collect();
    let (user, system): (f64, f64) = (fields.get(11)?.parse().ok()?, fields.get(12)?.parse().ok()?);
    Some((user + system) / TICKS)
}
