//! How fast the OPC UA server of a virtual controller answers, and what it needs of memory, against the servers of
//! asyncua and node-opcua that hold as many nodes.
//!
//! `cargo bench --bench opcua_server -- [CONNECTIONS] [BATCH]`; 4 and 500 without arguments.
//!
//! Each server is a process of its own: the virtual controller is the program itself, with its management interface and a
//! simulated robot that moves. The client of all of them is in this process; each of its connections sends a request when
//! the answer to the one before has come. The peers are found as the interop stories find them: `OPCUA_INTEROP_PYTHON`
//! names a Python with asyncua, `OPCUA_INTEROP_NODE_MODULES` the `node_modules` folder with node-opcua-server.

#[allow(dead_code, reason = "tests need more of it")]
#[path = "../common/command_line_test.rs"]
mod command_line_test;
#[allow(dead_code, reason = "other benches need more of it")]
mod opcua_client;
mod plant;
#[allow(dead_code, reason = "tests need more of it")]
#[path = "../common/process.rs"]
mod process;
#[allow(dead_code, reason = "other benches need more of it")]
mod report;
#[allow(dead_code, reason = "other benches need more of it")]
mod usage;

use std::collections::HashSet;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::Arc;
use std::time::{Duration, Instant};

use command_line_test::CommandLineTest;
use opcua::crypto::SecurityPolicy as WirePolicy;
use opcua::types::{MessageSecurityMode, NodeClass, NodeId, ObjectId, ReadValueId, Variant};
use opcua_client::{Client, Failure, MODES, TestApplication, offered_endpoint};
use process::Running;
use report::{Spread, line};
use serde_json::Value;
use tokio::task::JoinSet;
use usage::{processor_seconds, resident_bytes};

const ROUNDS: usize = 5;
const START: Duration = Duration::from_secs(120);

#[tokio::main]
async fn main() -> Result<(), Failure> {
    let benching = report::is_benching();
    let connections = report::number(0).unwrap_or(4).max(1);
    let batch = report::number(1).unwrap_or(500).max(1);
    let period = Duration::from_millis(if benching { 2000 } else { 100 });
    let folder = tempfile::tempdir()?;
    let (application, client) = (TestApplication::new("server")?, TestApplication::new("client")?);
    application.write(folder.path())?;

    let mut servers = vec![Server::virtual_controller(&client, folder.path())?];
    let walk = servers[0].look_around(&client).await?;
    println!(
        "The OPC UA server of a virtual controller: {} nodes; {connections} connections, {} cores",
        walk.nodes,
        report::cores()
    );
    let variables = walk.numbers.len().min(batch);
    servers[0].reads = cycle(walk.numbers, batch);
    for peer in [Peer::Asyncua, Peer::NodeOpcua] {
        match Server::peer(peer, folder.path(), walk.nodes, variables) {
            Ok(mut server) => {
                let walk = server.look_around(&client).await?;
                println!("  {}: {} nodes", server.name, walk.nodes);
                server.reads = cycle(server.variables.split_off(0), batch);
                servers.push(server);
            }
            Err(missing) => println!("  {}: not compared: {missing}", peer.name()),
        }
    }
    let started: Vec<Option<f64>> = servers.iter().map(|server| resident_bytes(server.process)).collect();

    for (policy, mode) in MODES {
        println!("{}, {mode}", policy.to_str());
        for (what, together) in [("single reads", 1), ("values, batched", batch)] {
            let mut measured: Vec<Vec<Measured>> = servers.iter().map(|_| Vec::new()).collect();
            // In turns, so that a busy machine is as unfair to the one as to the other.
            for _ in 0..report::rounds_when(benching, ROUNDS) {
                for (server, measured) in servers.iter().zip(&mut measured) {
                    let clients = server.connect(policy, mode, connections, &client).await?;
                    measured.push(server.measure(clients, together, period).await?);
                }
            }
            compare(what, &servers, &measured);
        }
    }
    println!("Memory, resident (MB)");
    for (server, started) in servers.iter().zip(started) {
        let megabytes = |bytes: Option<f64>| bytes.map_or("?".to_owned(), |bytes| format!("{:.1}", bytes / 1e6));
        let now = resident_bytes(server.process);
        line(server.name, format!("{} after the start, {} after the reads", megabytes(started), megabytes(now)));
    }
    Ok(())
}

fn compare(what: &str, servers: &[Server], measured: &[Vec<Measured>]) {
    let mut ours = f64::NAN;
    for (index, (server, measured)) in servers.iter().zip(measured).enumerate() {
        let rate = Spread::of(measured.iter().map(|measured| measured.rate));
        let cost = Spread::of(measured.iter().filter_map(|measured| measured.server_micros)).median();
        let cost = format!("{rate}; {cost:.1} µs of the server's processor each");
        if index == 0 {
            ours = rate.median();
            line(&format!("{what} (1/s)"), cost);
        } else {
            line(&format!("  {}", server.name), format!("{cost}; ours {:.1} × as fast", ours / rate.median()));
        }
    }
}

/// As many as `count`, the nodes over and over again.
fn cycle(nodes: Vec<NodeId>, count: usize) -> Arc<[ReadValueId]> {
    nodes.into_iter().map(ReadValueId::from).collect::<Vec<_>>().into_iter().cycle().take(count).collect()
}

/// A server in a process of its own.
struct Server {
    name: &'static str,
    url: String,
    process: u32,
    /// Of a peer, the nodes with values that were asked for.
    variables: Vec<NodeId>,
    reads: Arc<[ReadValueId]>,
    _running: Box<dyn Send>,
}

#[derive(Clone, Copy)]
enum Peer {
    Asyncua,
    NodeOpcua,
}

impl Peer {
    const fn name(self) -> &'static str {
        match self {
            Self::Asyncua => "asyncua",
            Self::NodeOpcua => "node-opcua",
        }
    }

    fn command(self) -> Command {
        let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/benches");
        let (program, script) = match self {
            Self::Asyncua => {
                (std::env::var_os("OPCUA_INTEROP_PYTHON").unwrap_or_else(|| "python3".into()), "opcua_server.py")
            }
            Self::NodeOpcua => ("node".into(), "opcua_server.mjs"),
        };
        let mut command = Command::new(program);
        command.arg(beside.join(script));
        command
    }
}

/// What was found in an address space.
struct Walk {
    nodes: usize,
    /// Variables outside of the standard namespaces whose value is a number.
    numbers: Vec<NodeId>,
}

struct Measured {
    /// Values a second.
    rate: f64,
    /// Processor time of the server for a value, in microseconds.
    server_micros: Option<f64>,
}

impl Server {
    /// A controller of the current firmware with one robot, which trusts the client.
    fn virtual_controller(client: &TestApplication, folder: &Path) -> Result<Self, Failure> {
        let trusted = folder.join("client.der");
        fs::write(&trusted, client.certificate.der())?;
        let running = CommandLineTest::with(1, &["--seed", "1", "--firmware", "current"]);
        plant::set_up(&running, &["--policies", "None,Basic256Sha256", "--tokens", "anonymous"], &trusted);
        Ok(Self {
            name: "virtual controller",
            url: running.ready[0]["opcua"].as_str().ok_or("no address")?.to_owned(),
            process: running.controllers.id(),
            variables: Vec::new(),
            reads: [].into(),
            _running: Box::new(running),
        })
    }

    /// A peer with the key and the certificate in `folder`.
    fn peer(peer: Peer, folder: &Path, nodes: usize, variables: usize) -> Result<Self, String> {
        let mut command = peer.command();
        command.arg(folder).args([nodes.to_string(), variables.to_string()]);
        let mut running = Running::start(&mut command).map_err(|error| error.to_string())?;
        let ready = running.try_line(START)?;
        let ready: Value = serde_json::from_str(&ready).map_err(|error| format!("{error} in: {ready}"))?;
        let variables = ready["variables"].as_array().into_iter().flatten();
        Ok(Self {
            name: peer.name(),
            url: ready["url"].as_str().unwrap_or_default().to_owned(),
            process: running.id(),
            variables: variables.filter_map(|node| node.as_str()?.parse().ok()).collect(),
            reads: [].into(),
            _running: Box::new(running),
        })
    }

    async fn look_around(&self, client: &TestApplication) -> Result<Walk, Failure> {
        let clients = self.connect(WirePolicy::None, MessageSecurityMode::None, 1, client).await?;
        let client = &clients[0];
        let mut known = HashSet::from([NodeId::from(ObjectId::RootFolder)]);
        let mut waiting: Vec<NodeId> = known.iter().cloned().collect();
        let mut variables = Vec::new();
        while !waiting.is_empty() {
            // An answer must not be larger than the client takes.
            let nodes: Vec<NodeId> = waiting.drain(..waiting.len().min(10)).collect();
            for found in client.references(&nodes).await? {
                let is_variable = found.node_class == NodeClass::Variable;
                let node = found.node_id.node_id;
                if known.insert(node.clone()) {
                    if is_variable && node.namespace > 0 {
                        variables.push(node.clone());
                    }
                    waiting.push(node);
                }
            }
        }
        let mut numbers = Vec::new();
        for nodes in variables.chunks(100) {
            let reads: Vec<ReadValueId> = nodes.iter().cloned().map(ReadValueId::from).collect();
            let values = client.read_any(&reads).await?;
            let are_numbers = values.iter().map(|value| value.value.as_ref().is_some_and(Variant::is_numeric));
            numbers.extend(nodes.iter().zip(are_numbers).filter(|(_, is)| *is).map(|(node, _)| node.clone()));
        }
        for client in clients {
            client.close().await;
        }
        Ok(Walk { nodes: known.len(), numbers })
    }

    async fn connect(
        &self,
        policy: WirePolicy,
        mode: MessageSecurityMode,
        connections: usize,
        client: &TestApplication,
    ) -> Result<Vec<Client>, Failure> {
        let endpoint = offered_endpoint(&self.url, policy, mode, client).await?;
        let mut clients = Vec::new();
        for _ in 0..connections {
            clients.push(Client::connect(endpoint.clone(), client).await?);
        }
        Ok(clients)
    }

    /// Reads for the period over all connections at the same time, `together` values in one request.
    async fn measure(&self, clients: Vec<Client>, together: usize, period: Duration) -> Result<Measured, Failure> {
        let computed = processor_seconds(self.process);
        let start = Instant::now();
        let mut reading = JoinSet::new();
        for client in clients {
            let reads = self.reads.clone();
            reading.spawn(async move {
                let mut values = 0;
                for request in reads.chunks(together).cycle() {
                    client.read(request).await?;
                    values += request.len();
                    if start.elapsed() >= period {
                        break;
                    }
                }
                Ok::<_, Failure>((values, client))
            });
        }
        let ended = reading.join_all().await.into_iter().collect::<Result<Vec<_>, _>>()?;
        let seconds = start.elapsed().as_secs_f64();
        let computed = computed.zip(processor_seconds(self.process)).map(|(before, after)| after - before);
        let values = ended.iter().map(|(values, _)| values).sum::<usize>() as f64;
        for (_, client) in ended {
            client.close().await;
        }
        Ok(Measured { rate: values / seconds, server_micros: computed.map(|seconds| seconds * 1e6 / values) })
    }
}
