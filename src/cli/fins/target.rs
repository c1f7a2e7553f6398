use std::time::Duration;

use clap::Args;

use crate::fins::client::{ClientSettings, DEFAULT_FINS_PORT, FinsClient, Transport};
use crate::model::{Address, ErrorCode, Problem};

/// The PLC that a command is for.
#[derive(Debug, Args)]
pub struct TargetArgs {
    /// The PLC; its port is 9600 unless another one is given
    #[arg(long, value_name = "HOST[:PORT]")]
    to: String,

    /// FINS/UDP instead of FINS/TCP
    #[arg(long)]
    udp: bool,

    /// Node of this program, 1 to 254 [default: the one that the PLC gives; over UDP the last number of the IP address]
    #[arg(long, value_name = "NODE", value_parser = clap::value_parser!(u8).range(1..=254))]
    client_node: Option<u8>,

    /// Node of the PLC, 1 to 254 [default: the one that the PLC says; over UDP the last number of its IP address]
    #[arg(long, value_name = "NODE", value_parser = clap::value_parser!(u8).range(1..=254))]
    server_node: Option<u8>,

    /// How long to wait for an answer
    #[arg(long, value_name = "MILLISECONDS", default_value_t = 2_000, value_parser = clap::value_parser!(u64).range(10..=60_000))]
    timeout: u64,
}

impl TargetArgs {
    pub fn settings(&self) -> Result<ClientSettings, Problem> {
        let to = Address::with_default_port(&self.to, DEFAULT_FINS_PORT);
        let to = to.map_err(|error| Problem::with_detail(ErrorCode::BadAddress, error))?;
        let transport = if self.udp { Transport::Udp } else { Transport::Tcp };
        Ok(ClientSettings {
            client_node: self.client_node,
            server_node: self.server_node,
            answer: Duration::from_millis(self.timeout),
            ..ClientSettings::new(to, transport)
        })
    }

    /// A client, and what its PLC is called in outputs.
    pub fn client(&self) -> Result<(FinsClient, String), Problem> {
        let settings = self.settings()?;
        let name = settings.to.authority();
        Ok((FinsClient::new(settings), name))
    }
}
