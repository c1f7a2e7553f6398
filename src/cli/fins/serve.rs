use std::net::{Ipv4Addr, SocketAddr};
use std::str::FromStr;
use std::time::Duration;

use clap::{Args, ValueEnum};
use serde_json::json;

use super::super::output::{line, say};
use super::super::value_error::ValueError;
use super::super::{CommandContext, CommandOutcome, runtime};
use crate::fins::address::{Address, AddressRange};
use crate::fins::client::DEFAULT_FINS_PORT;
use crate::fins::codec::cpu::OperatingMode;
use crate::fins::codec::end_code::EndCode;
use crate::fins::data_type::{DataType, WordOrder};
use crate::fins::plc::{Faults, PlcConfig, SimulatedPlc};
use crate::model::{ErrorCode, Problem};
use crate::platform::stop_signal::StopSignals;
use crate::texts;

#[derive(Debug, Args)]
pub struct ServeArgs {
    /// Address and port to listen on, 0 picks a free port; anything but a loopback address lets the whole network in
    #[arg(long, value_name = "HOST:PORT", default_value_t = SocketAddr::from((Ipv4Addr::LOCALHOST, DEFAULT_FINS_PORT)))]
    bind: SocketAddr,

    /// FINS/UDP only, instead of both transports
    #[arg(long)]
    udp: bool,

    /// Node of the PLC, 1 to 254
    #[arg(long, value_name = "NODE", default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=254))]
    node: u8,

    /// Model that the PLC gives as its own, at most 20 ASCII characters
    #[arg(long, value_name = "MODEL", default_value = "CJ2M-CPU35")]
    model: String,

    /// Operating mode
    #[arg(long, value_enum, default_value_t = ModeArg::Run)]
    mode: ModeArg,

    /// Refuse writes in RUN mode, as PLCs of the CV series do
    #[arg(long)]
    no_writes_in_run: bool,

    /// Words at the beginning, such as D300=1,2,3
    #[arg(long, value_name = "ADDRESS=VALUES")]
    set: Vec<String>,

    /// Something that goes wrong: silent, loses-answers, wrong-node, slow=MILLISECONDS, end-code=HEXADECIMAL, cut=BYTES
    #[arg(long, value_name = "FAULT")]
    fault: Vec<FaultArg>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ModeArg {
    Program,
    Monitor,
    Run,
}

pub fn run(cli: &CommandContext, args: &ServeArgs) -> Result<CommandOutcome, Problem> {
    let config = PlcConfig {
        bind: args.bind.ip(),
        port: args.bind.port(),
        tcp: !args.udp,
        udp: true,
        node: args.node,
        model: args.model.clone(),
        mode: match args.mode {
            ModeArg::Program => OperatingMode::Program,
            ModeArg::Monitor => OperatingMode::Monitor,
            ModeArg::Run => OperatingMode::Run,
        },
        refuses_writes_in_run: args.no_writes_in_run,
        ..PlcConfig::default()
    };
    let faults = faults(&args.fault);
    let set = args.set.iter().map(|text| words(text)).collect::<Result<Vec<_>, Problem>>()?;
    runtime()?.block_on(async {
        // Before the line that says the PLC is ready: from then on a caller may ask the program to end.
        let mut stop = StopSignals::listen();
        let plc = SimulatedPlc::start(config).await?;
        for (range, words) in set {
            let kept = plc.state().memory.set_words(range.start, &words);
            kept.map_err(|error| Problem::with_detail(ErrorCode::BadPlcAddress, error))?;
        }
        *plc.faults() = faults;
        let address = plc.address().to_string();
        line(&json!({ "fins": address }).to_string());
        if !cli.output.is_json() {
            say(&texts::plc_simulated(cli.output.language(), &address, args.node));
        }
        stop.received().await;
        plc.shutdown().await;
        Ok(CommandOutcome::AllDone)
    })
}

/// `D300=1,2,3`.
fn words(text: &str) -> Result<(AddressRange, Vec<u16>), Problem> {
    let (start, values) = text.split_once('=').unwrap_or((text, ""));
    let start: Address = start.parse()?;
    let values = values.split(',').map(|value| DataType::U16.parse(value.trim())).collect::<Result<Vec<_>, _>>()?;
    let words = DataType::U16.encode(&values, WordOrder::default(), 0)?;
    Ok((AddressRange::new(start, words.len())?, words))
}

/// Something that goes wrong in the PLC.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FaultArg {
    Silent,
    LosesAnswers,
    WrongNode,
    Slow(u64),
    EndCode(u16),
    Cut(usize),
}

impl FromStr for FaultArg {
    type Err = ValueError;

    fn from_str(text: &str) -> Result<Self, ValueError> {
        let (name, value) = text.split_once('=').map_or((text, None), |(name, value)| (name, Some(value)));
        let fault = match (name, value) {
            ("silent", None) => Some(Self::Silent),
            ("loses-answers", None) => Some(Self::LosesAnswers),
            ("wrong-node", None) => Some(Self::WrongNode),
            ("slow", Some(value)) => value.parse().ok().map(Self::Slow),
            ("end-code", Some(value)) => u16::from_str_radix(value, 16).ok().map(Self::EndCode),
            ("cut", Some(value)) => value.parse().ok().map(Self::Cut),
            _ => None,
        };
        let known = ["silent", "loses-answers", "wrong-node", "slow=MILLISECONDS", "end-code=HEXADECIMAL", "cut=BYTES"];
        fault.ok_or_else(|| ValueError::NoneOf(known.to_vec()))
    }
}

fn faults(switches: &[FaultArg]) -> Faults {
    let mut faults = Faults::default();
    for switch in switches {
        match *switch {
            FaultArg::Silent => faults.is_silent = true,
            FaultArg::LosesAnswers => faults.loses_answers = true,
            FaultArg::WrongNode => faults.answers_wrong_node = true,
            FaultArg::Slow(milliseconds) => faults.delay = Some(Duration::from_millis(milliseconds)),
            FaultArg::EndCode(code) => faults.end_code = Some(EndCode::from_wire(code)),
            FaultArg::Cut(bytes) => faults.cuts_after = Some(bytes),
        }
    }
    faults
}
