use std::path::PathBuf;
use std::time::Duration;

use crate::remote::Password;
use crate::remote::text::Terminator;

/// How a virtual controller answers remote commands. By default it does not.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RemoteOptions {
    /// The TCP port of the text form (remote Ethernet); 0 takes a free one, `None` leaves the form off.
    pub text_port: Option<u16>,
    /// The TCP port of the frames (remote RS232, as a serial device server passes them on); 0 takes a free one, `None`
    /// leaves them off.
    pub frames_port: Option<u16>,
    /// The line on which frames are answered; `None` for none.
    pub serial: Option<SerialChoice>,
    /// The password of Login. Empty: every password is right, as on a controller that has none.
    pub password: Password,
    /// What clients may do.
    pub role: RemoteRole,
    /// How long a client that has logged in may send no command until its session ends; zero for endless. On a controller
    /// 60.00 s unless it is set otherwise.
    pub time_out: Duration,
    /// How long a client may take to log in: 5 minutes on a controller.
    pub login_window: Duration,
    /// What ends the lines that the controller sends. Received lines may end with any of them.
    pub terminator: Terminator,
}

/// What clients of the remote commands may do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RemoteRole {
    /// Remote is the control device: all commands.
    #[default]
    Control,
    /// Remote is set for monitoring only: what acts is refused with 20.
    Monitor,
}

/// A line on which frames are answered.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SerialChoice {
    /// A new pseudo-terminal, whose other end a client opens like a serial port.
    PseudoTerminal,
    /// A serial device: 8 data bits, no parity, 1 stop bit.
    Device {
        /// Such as `/dev/ttyUSB0`.
        path: PathBuf,
        /// Bits a second: 9600, 19200, 38400, 57600 or 115200.
        baud: u32,
    },
}

/// The time-out and the login window of a controller (SPEL+ guide, remote Ethernet).
const TIME_OUT: Duration = Duration::from_secs(60);
const LOGIN_WINDOW: Duration = Duration::from_secs(300);

impl Default for RemoteOptions {
    fn default() -> Self {
        Self {
            text_port: None,
            frames_port: None,
            serial: None,
            password: Password::default(),
            role: RemoteRole::default(),
            time_out: TIME_OUT,
            login_window: LOGIN_WINDOW,
            terminator: Terminator::default(),
        }
    }
}
