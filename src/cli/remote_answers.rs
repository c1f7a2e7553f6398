//! How virtual controllers answer remote commands: the options that `virtual` and `remote serve` share.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, ValueEnum};
use secrecy::ExposeSecret as _;

use super::secret_file::read_secret;
use super::value_error::ValueError;
use crate::model::{ErrorCode, Problem};
use crate::remote::text::Terminator;
use crate::remote::{MAX_PASSWORD_CHARS, Password};
use crate::virtual_controller::remote::{RemoteOptions, RemoteRole, SerialChoice};

#[derive(Debug, Args)]
pub struct RemoteAnswers {
    /// Answer remote commands as text (remote Ethernet) at this TCP port, each next controller takes the next one; 0 picks
    /// free ones
    #[arg(long, value_name = "P")]
    remote_port: Option<u16>,
    /// Answer remote commands in frames (remote RS232) at this TCP port, each next controller takes the next one; 0 picks
    /// free ones
    #[arg(long, value_name = "P")]
    remote_frames_port: Option<u16>,
    /// Answer remote commands in frames on a serial line: "pty" for a new pseudo-terminal, or a device with its speed, such
    /// as /dev/ttyUSB0,9600. Not on Windows
    #[arg(long, value_name = "LINE", value_parser = serial)]
    remote_serial: Option<SerialChoice>,
    /// File with the password of remote commands, at most 16 characters, "-" for standard input; none without it
    #[arg(long, value_name = "FILE")]
    remote_password_file: Option<PathBuf>,
    /// What remote commands may do
    #[arg(long, value_enum, value_name = "ROLE", default_value_t = RoleArg::Control)]
    remote_role: RoleArg,
    /// Seconds after which a session of remote commands without a command ends; 0 for never
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0, value_parser = seconds)]
    remote_time_out: f64,
    /// What ends the lines of answers to remote commands
    #[arg(long, value_enum, value_name = "END", default_value_t = TerminatorArg::Crlf)]
    remote_terminator: TerminatorArg,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum RoleArg {
    /// Everything: remote is the control device
    Control,
    /// Only what monitors
    Monitor,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum TerminatorArg {
    /// CR and LF
    Crlf,
    /// CR
    Cr,
    /// LF
    Lf,
}

/// The speed of a serial device without one.
const BAUD: u32 = 9600;

/// The speeds of a serial device.
const SPEEDS: [u32; 5] = [9600, 19_200, 38_400, 57_600, 115_200];

/// The longest time-out: a day.
const MAX_SECONDS: f64 = 86_400.0;

fn serial(line: &str) -> Result<SerialChoice, ValueError> {
    if line == "pty" {
        return Ok(SerialChoice::PseudoTerminal);
    }
    let (path, baud) = match line.rsplit_once(',') {
        Some((path, baud)) => (path, baud.parse().ok().filter(|baud| SPEEDS.contains(baud))),
        None => (line, Some(BAUD)),
    };
    match baud {
        Some(baud) if !path.is_empty() => Ok(SerialChoice::Device { path: path.into(), baud }),
        _ => Err(ValueError::NoneOf(vec!["pty", "DEVICE", "DEVICE,9600|19200|38400|57600|115200"])),
    }
}

fn seconds(text: &str) -> Result<f64, ValueError> {
    let seconds = text.parse().ok().filter(|seconds| (0.0..=MAX_SECONDS).contains(seconds));
    seconds.ok_or_else(|| ValueError::NoneOf(vec!["0 - 86400"]))
}

impl RemoteAnswers {
    /// The options of a virtual controller. Reads the password file. Errors: [`ErrorCode::FileUnreadable`], and
    /// [`ErrorCode::FileFormat`] for what cannot be a password of remote commands.
    pub fn options(&self) -> Result<RemoteOptions, Problem> {
        Ok(RemoteOptions {
            text_port: self.remote_port,
            frames_port: self.remote_frames_port,
            serial: self.remote_serial.clone(),
            password: self.password()?,
            role: match self.remote_role {
                RoleArg::Control => RemoteRole::Control,
                RoleArg::Monitor => RemoteRole::Monitor,
            },
            time_out: Duration::from_secs_f64(self.remote_time_out),
            terminator: match self.remote_terminator {
                TerminatorArg::Crlf => Terminator::CrLf,
                TerminatorArg::Cr => Terminator::Cr,
                TerminatorArg::Lf => Terminator::Lf,
            },
            ..RemoteOptions::default()
        })
    }

    fn password(&self) -> Result<Password, Problem> {
        let Some(file) = &self.remote_password_file else { return Ok(Password::default()) };
        Password::new(read_secret(file)?.expose_secret()).ok_or_else(|| {
            let why = format!("{}: more than {MAX_PASSWORD_CHARS} characters, or not printable ASCII", file.display());
            Problem::with_detail(ErrorCode::FileFormat, why)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_serial_line_is_a_pseudo_terminal_or_a_device_with_a_speed() {
        let device = |path: &str, baud| Ok(SerialChoice::Device { path: path.into(), baud });
        assert_eq!(serial("pty"), Ok(SerialChoice::PseudoTerminal));
        assert_eq!(serial("/dev/ttyUSB0"), device("/dev/ttyUSB0", 9600));
        assert_eq!(serial("/dev/ttyS1,115200"), device("/dev/ttyS1", 115_200));
        for wrong in ["", ",9600", "/dev/ttyS1,1200", "/dev/ttyS1,fast"] {
            assert!(serial(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_time_out_is_at_most_a_day() {
        assert_eq!((seconds("0"), seconds("0.5"), seconds("86400")), (Ok(0.0), Ok(0.5), Ok(86_400.0)));
        for wrong in ["-1", "86401", "NaN", "soon"] {
            assert!(seconds(wrong).is_err(), "{wrong}");
        }
    }
}
