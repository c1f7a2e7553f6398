use std::io;
use std::time::Duration;

use serial2_tokio::{CharSize, FlowControl, SerialPort, Settings, StopBits};
use tokio::io::{AsyncRead, AsyncWrite};
use tokio::net::TcpStream;
use tokio::time::timeout;

use super::error::RemoteError;
use super::target::{Parity, RemoteTarget, SerialLine};
use crate::model::{Address, Cause};

/// A connection that carries bytes both ways.
pub(super) trait Link: AsyncRead + AsyncWrite + Send + Unpin {}

impl<T: AsyncRead + AsyncWrite + Send + Unpin> Link for T {}

/// Opens the connection.
pub(super) async fn open(target: &RemoteTarget, limit: Duration) -> Result<Box<dyn Link>, RemoteError> {
    match target {
        RemoteTarget::Ethernet { address, .. } | RemoteTarget::RawTcp(address) => {
            let connected = timeout(limit, connect(address)).await;
            let connected =
                connected.map_err(|_| RemoteError::ConnectTimeout { target: target.to_string(), after: limit })?;
            connected
                .map(|stream| Box::new(stream) as Box<dyn Link>)
                .map_err(|error| RemoteError::Unreachable { target: target.to_string(), cause: Cause::new(error) })
        }
        RemoteTarget::Serial(line) => {
            let opened = SerialPort::open(&line.device, |settings: Settings| apply(line, settings));
            opened
                .map(|port| Box::new(port) as Box<dyn Link>)
                .map_err(|error| RemoteError::SerialPort { device: line.device.clone(), cause: Cause::new(error) })
        }
    }
}

async fn connect(address: &Address) -> io::Result<TcpStream> {
    let stream = TcpStream::connect((address.host(), address.port())).await?;
    // A request is one small write.
    stream.set_nodelay(true)?;
    Ok(stream)
}

fn apply(line: &SerialLine, mut settings: Settings) -> io::Result<Settings> {
    settings.set_raw();
    settings.set_baud_rate(line.baud)?;
    settings.set_char_size(CharSize::Bits8);
    settings.set_stop_bits(if line.two_stop_bits { StopBits::Two } else { StopBits::One });
    settings.set_parity(match line.parity {
        Parity::None => serial2_tokio::Parity::None,
        Parity::Even => serial2_tokio::Parity::Even,
        Parity::Odd => serial2_tokio::Parity::Odd,
    });
    settings.set_flow_control(if line.hardware_handshake { FlowControl::RtsCts } else { FlowControl::None });
    Ok(settings)
}
