use std::fmt;
use std::str::FromStr;

use thiserror::Error;

use crate::model::{Address, AddressError};
use crate::remote::codec::text::{DEFAULT_PORT, Terminator};

/// Where remote commands go, and in which form.
///
/// | text | form |
/// |---|---|
/// | `tcp://HOST[:PORT]` | text over TCP, port 5000 by default; `?terminator=crlf`, `cr` or `lf` |
/// | `raw-tcp://HOST:PORT` | frames over TCP, to a serial device server |
/// | `serial:DEVICE` | frames over a serial port; `?baud=9600&parity=none&stop=1&handshake=none` |
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum RemoteTarget {
    /// Text over TCP.
    Ethernet {
        /// Host and port.
        address: Address,
        /// What ends a line; set in the controller.
        terminator: Terminator,
    },
    /// Frames over TCP.
    RawTcp(Address),
    /// Frames over a serial port.
    Serial(SerialLine),
}

/// A serial port and its settings. Data bits are always 8, since frames hold any byte; a handshake by characters is not
/// offered for the same reason.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SerialLine {
    /// `/dev/ttyS0`, `COM3`.
    pub device: String,
    /// Bits per second: 9600 (default), 19200, 38400, 57600, 115200.
    pub baud: u32,
    /// Parity; none by default.
    pub parity: Parity,
    /// Two stop bits instead of one.
    pub two_stop_bits: bool,
    /// Handshake by the lines RTS and CTS; off by default.
    pub hardware_handshake: bool,
}

/// The parity bit of a serial line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Parity {
    /// No parity bit.
    #[default]
    None,
    /// Even parity.
    Even,
    /// Odd parity.
    Odd,
}

/// The speeds of a controller's serial port, in bits per second.
pub const BAUD_RATES: [u32; 5] = [9600, 19_200, 38_400, 57_600, 115_200];

/// Why a text is not a [`RemoteTarget`].
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum TargetError {
    /// Neither `tcp://` nor `raw-tcp://` nor `serial:`.
    #[error("\"{0}\" begins with none of tcp://, raw-tcp:// and serial:")]
    Scheme(String),
    /// Host or port is wrong.
    #[error("the address is wrong")]
    Address(#[source] AddressError),
    /// A serial device server has no port that could be assumed.
    #[error("raw-tcp:// needs a port, such as raw-tcp://192.168.0.7:4001")]
    NoPort,
    /// No device is named.
    #[error("serial: needs a device, such as serial:/dev/ttyS0 or serial:COM3")]
    NoDevice,
    /// No such setting here.
    #[error("\"{name}\" is not a setting of this connection; there are: {known}")]
    Setting {
        /// As it was written.
        name: String,
        /// Those there are.
        known: &'static str,
    },
    /// A setting has another value.
    #[error("{name}={value} is not possible; possible are: {known}")]
    Value {
        /// The setting.
        name: &'static str,
        /// As it was written.
        value: String,
        /// Those that are possible.
        known: &'static str,
    },
}

impl RemoteTarget {
    /// Text over TCP to this host, at the port that a controller uses by default.
    ///
    /// Errors: [`TargetError::Address`].
    pub fn ethernet(host: &str) -> Result<Self, TargetError> {
        let address = Address::with_default_port(host, DEFAULT_PORT).map_err(TargetError::Address)?;
        Ok(Self::Ethernet { address, terminator: Terminator::default() })
    }
}

impl FromStr for RemoteTarget {
    type Err = TargetError;

    fn from_str(text: &str) -> Result<Self, TargetError> {
        let text = text.trim();
        let (place, settings) = text.split_once('?').unwrap_or((text, ""));
        let settings = settings.split('&').filter(|setting| !setting.is_empty());
        let settings = settings.map(|setting| setting.split_once('=').unwrap_or((setting, "")));
        if let Some(host) = place.strip_prefix("tcp://") {
            let address =
                Address::with_default_port(without_slash(host), DEFAULT_PORT).map_err(TargetError::Address)?;
            let mut terminator = Terminator::default();
            for (name, value) in settings {
                match name {
                    "terminator" => terminator = one_of("terminator", value, "crlf, cr, lf", TERMINATORS)?,
                    other => return Err(TargetError::Setting { name: other.to_owned(), known: "terminator" }),
                }
            }
            return Ok(Self::Ethernet { address, terminator });
        }
        if let Some(host) = place.strip_prefix("raw-tcp://") {
            if let Some((name, _)) = settings.into_iter().next() {
                return Err(TargetError::Setting { name: name.to_owned(), known: "-" });
            }
            // Port 0 is no port.
            let address = Address::with_default_port(without_slash(host), 0).map_err(TargetError::Address)?;
            return if address.port() == 0 { Err(TargetError::NoPort) } else { Ok(Self::RawTcp(address)) };
        }
        let device = place.strip_prefix("serial:").ok_or_else(|| TargetError::Scheme(place.to_owned()))?;
        if device.is_empty() {
            return Err(TargetError::NoDevice);
        }
        let mut line = SerialLine {
            device: device.to_owned(),
            baud: BAUD_RATES[0],
            parity: Parity::None,
            two_stop_bits: false,
            hardware_handshake: false,
        };
        for (name, value) in settings {
            match name {
                "baud" => line.baud = one_of("baud", value, "9600, 19200, 38400, 57600, 115200", BAUDS)?,
                "parity" => line.parity = one_of("parity", value, "none, even, odd", PARITIES)?,
                "stop" => line.two_stop_bits = one_of("stop", value, "1, 2", STOP_BITS)?,
                "handshake" => {
                    line.hardware_handshake = one_of("handshake", value, "none, hardware", HANDSHAKES)?;
                }
                other => {
                    let known = "baud, parity, stop, handshake";
                    return Err(TargetError::Setting { name: other.to_owned(), known });
                }
            }
        }
        Ok(Self::Serial(line))
    }
}

const TERMINATORS: &[(&str, Terminator)] =
    &[("crlf", Terminator::CrLf), ("cr", Terminator::Cr), ("lf", Terminator::Lf)];
const BAUDS: &[(&str, u32)] =
    &[("9600", 9600), ("19200", 19_200), ("38400", 38_400), ("57600", 57_600), ("115200", 115_200)];
const PARITIES: &[(&str, Parity)] = &[("none", Parity::None), ("even", Parity::Even), ("odd", Parity::Odd)];
const STOP_BITS: &[(&str, bool)] = &[("1", false), ("2", true)];
const HANDSHAKES: &[(&str, bool)] = &[("none", false), ("hardware", true)];

fn one_of<T: Copy>(
    name: &'static str,
    value: &str,
    known: &'static str,
    values: &[(&str, T)],
) -> Result<T, TargetError> {
    let found = values.iter().find(|(text, _)| *text == value).map(|(_, found)| *found);
    found.ok_or_else(|| TargetError::Value { name, value: value.to_owned(), known })
}

fn word<T: PartialEq>(value: &T, values: &[(&'static str, T)]) -> &'static str {
    values.iter().find(|(_, known)| known == value).map_or("", |(text, _)| text)
}

/// A URL may end with one.
fn without_slash(host: &str) -> &str {
    host.strip_suffix('/').unwrap_or(host)
}

impl fmt::Display for RemoteTarget {
    /// The text that [`FromStr`] reads; settings that have their default are left out.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ethernet { address, terminator } => {
                write!(f, "tcp://{}", address.authority())?;
                match terminator {
                    Terminator::CrLf => Ok(()),
                    other => write!(f, "?terminator={}", word(other, TERMINATORS)),
                }
            }
            Self::RawTcp(address) => write!(f, "raw-tcp://{}", address.authority()),
            Self::Serial(line) => {
                write!(f, "serial:{}?baud={}", line.device, line.baud)?;
                if line.parity != Parity::None {
                    write!(f, "&parity={}", word(&line.parity, PARITIES))?;
                }
                if line.two_stop_bits {
                    f.write_str("&stop=2")?;
                }
                if line.hardware_handshake {
                    f.write_str("&handshake=hardware")?;
                }
                Ok(())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<String, TargetError> {
        text.parse::<RemoteTarget>().map(|target| target.to_string())
    }

    #[test]
    fn targets_are_read_and_shown() {
        for (text, shown) in [
            ("tcp://192.168.0.1", "tcp://192.168.0.1:5000"),
            (" tcp://Robot-7/ ", "tcp://robot-7:5000"),
            ("tcp://[::1]:5001?terminator=cr", "tcp://[::1]:5001?terminator=cr"),
            ("raw-tcp://10.0.0.7:4001", "raw-tcp://10.0.0.7:4001"),
            ("serial:/dev/ttyS0", "serial:/dev/ttyS0?baud=9600"),
            (
                "serial:COM3?baud=115200&parity=even&stop=2&handshake=hardware",
                "serial:COM3?baud=115200&parity=even&stop=2&handshake=hardware",
            ),
        ] {
            assert_eq!(of(text).as_deref(), Ok(shown));
            assert_eq!(of(shown).as_deref(), Ok(shown));
        }
        let RemoteTarget::Ethernet { address, .. } = RemoteTarget::ethernet("robot").unwrap() else { panic!() };
        assert_eq!(address.port(), 5000);
    }

    #[test]
    fn mistakes_are_named() {
        assert_eq!(of("192.168.0.1"), Err(TargetError::Scheme("192.168.0.1".into())));
        assert!(matches!(of("tcp://"), Err(TargetError::Address(AddressError::Empty))));
        assert!(matches!(of("tcp://robot:70000"), Err(TargetError::Address(AddressError::Port(_)))));
        assert_eq!(of("raw-tcp://10.0.0.7"), Err(TargetError::NoPort));
        assert_eq!(of("serial:?baud=9600"), Err(TargetError::NoDevice));
        assert!(matches!(of("serial:COM1?baud=1"), Err(TargetError::Value { name: "baud", .. })));
        assert!(matches!(of("serial:COM1?bits=7"), Err(TargetError::Setting { .. })));
        assert!(matches!(of("tcp://robot?baud=9600"), Err(TargetError::Setting { .. })));
    }
}
