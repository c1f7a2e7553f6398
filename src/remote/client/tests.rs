//! The client against scripted peers.

use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use parking_lot::Mutex;

use super::*;
use crate::model::{ErrorCode, Problem, SpelType, SpelValue, StatusFlag};
use crate::remote::codec::*;

const LIMIT: Duration = Duration::from_secs(10);

/// A controller that does what a test says, on connections of its own thread.
struct Peer {
    address: SocketAddr,
    thread: JoinHandle<()>,
}

impl Peer {
    fn start(script: impl FnOnce(&TcpListener) + Send + 'static) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap();
        Self { address, thread: std::thread::spawn(move || script(&listener)) }
    }

    fn text(&self) -> RemoteClient {
        self.client("tcp", "")
    }

    fn frames(&self) -> RemoteClient {
        self.client("raw-tcp", "")
    }

    fn client(&self, scheme: &str, password: &str) -> RemoteClient {
        let target = format!("{scheme}://{}", self.address).parse().unwrap();
        RemoteClient::new(target, Password::new(password).unwrap(), timeouts())
    }

    fn end(self) {
        self.thread.join().unwrap();
    }
}

fn timeouts() -> RemoteTimeouts {
    let short = Duration::from_millis(800);
    RemoteTimeouts { connect: short, answer: short, motion: short }
}

/// One connection of a peer.
struct Line<T>(T);

fn accept(listener: &TcpListener) -> Line<TcpStream> {
    let stream = listener.accept().unwrap().0;
    stream.set_read_timeout(Some(LIMIT)).unwrap();
    Line(stream)
}

impl<T: std::io::Read + std::io::Write> Line<T> {
    fn expect(&mut self, bytes: &[u8]) {
        let mut came = vec![0; bytes.len()];
        self.0.read_exact(&mut came).unwrap();
        assert_eq!(came, bytes, "{} and not {}", came.escape_ascii(), bytes.escape_ascii());
    }

    fn send(&mut self, bytes: &[u8]) {
        self.0.write_all(bytes).unwrap();
    }

    fn answer(&mut self, request: &[u8], answer: &[u8]) {
        self.expect(request);
        self.send(answer);
    }

    fn log_in(&mut self) {
        self.answer(b"$Login,\r\n", b"#Login,0\r\n");
    }

    fn log_in_frames(&mut self) {
        self.answer(b"\x04\x02L\x03\x4f", b"\x06L\x03\x4f");
    }

    /// The client sends nothing more and closes the connection.
    fn expect_end(&mut self) {
        let mut rest = Vec::new();
        // A reset is an end as well.
        let _reset = self.0.read_to_end(&mut rest);
        assert!(rest.is_empty(), "{}", rest.escape_ascii());
    }
}

const STATUS: Request = Request::GetStatus;
const READY: &[u8] = b"#GetStatus,00100000001,0000\r\n";

fn start() -> Request {
    Request::Start { function: FunctionNumber::new(0).unwrap() }
}

fn code(error: RemoteError) -> ErrorCode {
    Problem::from(error).code
}

#[tokio::test]
async fn it_logs_in_and_asks() {
    let peer = Peer::start(|listener| {
        let mut line = accept(listener);
        line.answer(b"$Login,secret\r\n", b"#Login,0\r\n");
        line.answer(b"$GetStatus\r\n", READY);
        line.answer(b"$GetVariable,g_a(0),Integer,2\r\n", b"#GetVariable,5,-6\r\n");
        line.expect_end();
    });
    let seen = Arc::new(Mutex::new(String::new()));
    let log = Arc::clone(&seen);
    let mut client = peer.client("tcp", "secret").observed_by(Arc::new(move |observed| {
        log.lock().push_str(&observed.text());
    }));
    let Ok(Reply::Status(status)) = client.request(&STATUS).await else { panic!() };
    assert!(status.flags.contains(StatusFlag::Auto) && status.flags.contains(StatusFlag::Ready));
    let range = ElementRange::new(Element::new(&[0]).unwrap(), 2).unwrap();
    let variable = VariableRead::elements("g_a".parse().unwrap(), SpelType::Integer, range).unwrap();
    let values = client.request(&Request::GetVariable { variable }).await;
    assert_eq!(values, Ok(Reply::Values(vec![SpelValue::Int16(5), SpelValue::Int16(-6)])));
    drop(client);
    peer.end();
    let seen = seen.lock();
    assert!(seen.contains("$Login,***") && seen.contains("#Login,0") && !seen.contains("secret"), "{seen}");
}

#[tokio::test]
async fn a_refused_login_says_why() {
    for (refusal, expected) in [
        (&b"!Login,13\r\n"[..], ErrorCode::RemoteWrongPassword),
        (b"!Login,98\r\n", ErrorCode::RemotePasswordRequired),
        (b"!Login,99\r\n", ErrorCode::RemoteSystemError),
        (b"HTTP/1.1 400 Bad Request\r\n", ErrorCode::RemoteAnswerUnreadable),
        (b"", ErrorCode::RemoteOccupied),
    ] {
        let peer = Peer::start(move |listener| {
            let mut line = accept(listener);
            line.answer(b"$Login,\r\n", refusal);
        });
        let error = peer.text().request(&STATUS).await.unwrap_err();
        assert_eq!(code(error), expected);
        peer.end();
    }
}

#[tokio::test]
async fn every_refusal_has_its_error() {
    for (number, expected) in [
        (10, ErrorCode::RemoteRequestRefused),
        (11, ErrorCode::RemoteCommandUnknown),
        (12, ErrorCode::RemoteRequestRefused),
        (14, ErrorCode::RemoteRequestRefused),
        (15, ErrorCode::RemoteVariableUnknown),
        (19, ErrorCode::RemoteLineDisturbed),
        (21, ErrorCode::RemoteExecuteRunning),
        (42, ErrorCode::RemoteRequestRefused),
        (99, ErrorCode::RemoteSystemError),
    ] {
        let peer = Peer::start(move |listener| {
            let mut line = accept(listener);
            line.log_in();
            line.answer(b"$GetAlm\r\n", format!("!GetAlm,{number}\r\n").as_bytes());
            line.expect_end();
        });
        let mut client = peer.text();
        let error = client.request(&Request::GetAlm).await.unwrap_err();
        assert_eq!(code(error), expected, "{number}");
        drop(client);
        peer.end();
    }
}

#[tokio::test]
async fn a_silent_peer_ends_at_the_limit() {
    let peer = Peer::start(|listener| {
        let mut line = accept(listener);
        line.log_in();
        line.expect(b"$GetStatus\r\n");
        line.expect_end();
        let mut line = accept(listener);
        line.log_in();
        line.expect(b"$Start,0\r\n");
        line.send(b"#Sta");
        line.expect_end();
    });
    let mut client = peer.text();
    let begun = Instant::now();
    let error = client.request(&STATUS).await.unwrap_err();
    assert_eq!(error, RemoteError::NoAnswer { command: Command::GetStatus, after: timeouts().answer });
    assert_eq!(code(error), ErrorCode::RemoteNoAnswer);
    assert!(begun.elapsed() < LIMIT && !client.is_connected());
    let error = client.request(&start()).await.unwrap_err();
    let RemoteError::OutcomeUnknown { command: Command::Start, cause } = &error else { panic!("{error}") };
    assert!(matches!(**cause, RemoteError::NoAnswer { .. }));
    assert_eq!(code(error), ErrorCode::RemoteOutcomeUnknown);
    peer.end();
}

#[tokio::test]
async fn a_connection_that_ends_in_mid_answer_is_made_again() {
    let peer = Peer::start(|listener| {
        let mut line = accept(listener);
        line.log_in();
        line.answer(b"$GetStatus\r\n", b"#GetStatus,001000");
        drop(line);
        let mut line = accept(listener);
        line.log_in();
        line.answer(b"$Start,0\r\n", b"#Start");
        drop(line);
        let mut line = accept(listener);
        line.log_in();
        line.answer(b"$GetStatus\r\n", READY);
    });
    let mut client = peer.text();
    let error = client.request(&STATUS).await.unwrap_err();
    assert!(matches!(error, RemoteError::ConnectionLost { command: Command::GetStatus, .. }));
    assert_eq!(code(error), ErrorCode::ConnectionLost);
    let error = client.request(&start()).await.unwrap_err();
    assert!(matches!(error, RemoteError::OutcomeUnknown { command: Command::Start, .. }));
    assert!(client.request(&STATUS).await.is_ok(), "and Start was not sent again");
    peer.end();
}

/// A controller closes a connection on which no command comes.
#[tokio::test]
async fn an_idle_connection_that_was_closed_is_noticed_before_anything_is_sent() {
    let (closed, is_closed) = std::sync::mpsc::channel();
    let peer = Peer::start(move |listener| {
        let mut line = accept(listener);
        line.log_in();
        line.answer(b"$GetStatus\r\n", READY);
        drop(line);
        closed.send(()).unwrap();
        let mut line = accept(listener);
        line.log_in();
        line.answer(b"$Start,0\r\n", b"#Start,0\r\n");
        line.expect_end();
    });
    let mut client = peer.text();
    assert!(client.request(&STATUS).await.is_ok());
    is_closed.recv_timeout(LIMIT).unwrap();
    // The end travels over loopback before the answer of the peer to anything that is sent now could.
    let started = client.request(&start()).await;
    assert_eq!(started, Ok(Reply::Done));
    drop(client);
    peer.end();
}

#[tokio::test]
async fn a_refusal_for_the_state_names_the_conditions() {
    let peer = Peer::start(|listener| {
        let mut line = accept(listener);
        line.log_in();
        line.answer(b"$Start,0\r\n", b"!Start,20\r\n");
        line.answer(b"$GetStatus\r\n", b"#GetStatus,00100110010,1234\r\n");
        line.answer(b"$Pause\r\n", b"!Pause,20\r\n");
        line.answer(b"$GetStatus\r\n", b"!GetStatus,99\r\n");
        line.expect_end();
    });
    let mut client = peer.text();
    let error = client.request(&start()).await.unwrap_err();
    let RemoteError::NotReady { command, unmet, status: Some(status) } = &error else { panic!("{error}") };
    assert_eq!((*command, status.code), (Command::Start, 1234));
    assert_eq!(*unmet, [Condition::Ready, Condition::NoEStop, Condition::NoSafeguard]);
    assert!(error.to_string().ends_with("it needs Ready on, EStop off, Safeguard off"), "{error}");
    assert_eq!(code(error), ErrorCode::RemoteNotReady);
    let error = client.request(&Request::Pause).await.unwrap_err();
    assert_eq!(error, RemoteError::NotReady { command: Command::Pause, unmet: vec![], status: None });
    drop(client);
    peer.end();
}

const GOOD_STATUS: &[u8] = b"\x06S\0\0\x01\0\0\0\0\0\0\0\x010000\x03\x50";
const DAMAGED_STATUS: &[u8] = b"\x06S\0\0\x01\0\0\0\0\0\0\0\x010000\x03\x51";

#[tokio::test]
async fn a_damaged_answer_to_a_reading_command_is_asked_for_once_more() {
    let peer = Peer::start(|listener| {
        let mut line = accept(listener);
        line.log_in_frames();
        line.answer(b"\x02S\x03\x50", DAMAGED_STATUS);
        line.answer(b"\x02S\x03\x50", GOOD_STATUS);
        // The request itself was damaged.
        line.answer(b"\x02S\x03\x50", b"\x15S16\x03\x57");
        line.answer(b"\x02S\x03\x50", GOOD_STATUS);
        line.answer(b"\x02S\x03\x50", DAMAGED_STATUS);
        line.answer(b"\x02S\x03\x50", DAMAGED_STATUS);
        line.expect_end();
    });
    let mut client = peer.frames();
    assert!(client.request(&STATUS).await.is_ok());
    assert!(client.request(&STATUS).await.is_ok());
    let error = client.request(&STATUS).await.unwrap_err();
    let fault = Fault::Checksum { expected: 0x50, found: 0x51 };
    assert!(matches!(&error, RemoteError::BadAnswer { error, .. } if error.fault == fault), "{error}");
    assert_eq!(code(error), ErrorCode::RemoteAnswerUnreadable);
    drop(client);
    peer.end();
}

#[tokio::test]
async fn an_acting_command_is_never_sent_twice() {
    let peer = Peer::start(|listener| {
        let mut line = accept(listener);
        line.log_in_frames();
        line.answer(b"\x02G\x00\x03\x44", b"\x06G\x03\x45");
        line.expect_end();
        let mut line = accept(listener);
        line.log_in_frames();
        line.answer(b"\x02Q\x03\x52", b"\x15Q16\x03\x55");
        line.expect_end();
    });
    let mut client = peer.frames();
    let error = client.request(&start()).await.unwrap_err();
    let RemoteError::OutcomeUnknown { cause, .. } = &error else { panic!("{error}") };
    assert!(matches!(**cause, RemoteError::BadAnswer { .. }));
    // The controller says that it did nothing.
    let error = client.request(&Request::Stop).await.unwrap_err();
    assert_eq!(error, RemoteError::Refused { command: Command::Stop, code: RefusalCode::BadChecksum });
    assert_eq!(code(error), ErrorCode::RemoteLineDisturbed);
    drop(client);
    peer.end();
}

#[tokio::test]
async fn an_unreachable_controller_is_tried_again_ever_later() {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let target = format!("tcp://{}", listener.local_addr().unwrap()).parse().unwrap();
    drop(listener);
    let mut client = RemoteClient::new(target, Password::default(), timeouts());
    let begun = Instant::now();
    for _ in 0..2 {
        let error = client.request(&STATUS).await.unwrap_err();
        assert!(matches!(error, RemoteError::Unreachable { .. }));
        assert_eq!(code(error), ErrorCode::Unreachable);
    }
    let waited = begun.elapsed();
    assert!(waited >= Duration::from_millis(500) && waited < LIMIT, "{waited:?}");
}

#[tokio::test]
async fn what_cannot_be_sent_leaves_the_connection_as_it_is() {
    let peer = Peer::start(|listener| {
        let mut line = accept(listener);
        line.log_in_frames();
        line.answer(b"\x02S\x03\x50", GOOD_STATUS);
        line.expect_end();
    });
    let mut client = peer.frames();
    let error = client.request(&Request::GetContName).await.unwrap_err();
    assert_eq!(code(error), ErrorCode::RemoteRequestInvalid);
    assert!(client.request(&STATUS).await.is_ok());
    drop(client);
    peer.end();
}

#[tokio::test]
async fn an_identity_is_what_the_firmware_tells() {
    let peer = Peer::start(|listener| {
        let mut line = accept(listener);
        line.log_in();
        for (command, answer) in [
            ("GetContName", "#GetContName,0"),
            ("GetContNo", "#GetContNo,RC7C0012345"),
            ("GetContType", "#GetContType,RC700-A"),
            ("GetContVer", "#GetContVer,7. 5. 1. 2"),
            ("GetContDev", "!GetContDev,11"),
            ("GetSubnetMask", "#GetSubnetMask,255.255.255.0"),
            ("GetDefaultGateway", "#GetDefaultGateway,192.168.0.254"),
            ("GetContMacAdd", "!GetContMacAdd,11"),
            ("GetPrjName", "#GetPrjName,Weld"),
            ("GetCpuLoad", "#GetCpuLoad,12"),
            ("GetHealthCont", "#GetHealthCont,2025/03/04 05:06:07,12.5,40"),
            ("GetRobotInfo", "#GetRobotInfo,1,SCARA,G6-551S"),
            ("GetRobotName,0", "#GetRobotName,1,Left"),
            ("GetRobotSerial,0", "!GetRobotSerial,11"),
            ("GetMotor,0", "#GetMotor,1,1,0"),
            ("GetPartWarning,1", "#GetPartWarning,0,1,0,0,0,1"),
        ] {
            line.answer(format!("${command}\r\n").as_bytes(), format!("{answer}\r\n").as_bytes());
        }
        line.expect_end();
    });
    let mut client = peer.text();
    let identity = ControllerIdentity::read(&mut client).await.unwrap();
    drop(client);
    peer.end();
    assert_eq!((identity.name, identity.control_device), (None, None));
    assert_eq!(identity.firmware.as_deref(), Some("7.5.1.2"));
    assert_eq!(identity.battery.map(|battery| battery.months_left).as_deref(), Some("40"));
    let [robot] = identity.robots.as_slice() else { panic!("{:?}", identity.robots) };
    assert_eq!((robot.kind.as_deref(), robot.name.as_deref()), (Some("SCARA"), Some("Left")));
    assert_eq!((robot.motors_on, robot.power_high, &robot.serial), (Some(true), Some(false), &None));
    assert_eq!(robot.parts_due, Some(vec![WearingPart::Belt, WearingPart::BallScrew]));
}

#[tokio::test]
async fn a_wrong_serial_port_is_told() {
    let target = "serial:/dev/no-such-port".parse().unwrap();
    let mut client = RemoteClient::new(target, Password::default(), timeouts());
    let error = client.connect().await.unwrap_err();
    assert!(matches!(&error, RemoteError::SerialPort { device, .. } if device == "/dev/no-such-port"));
    assert_eq!(code(error), ErrorCode::SerialPortUnavailable);
}

/// A serial line: the other end of a pseudo-terminal.
#[cfg(unix)]
#[tokio::test]
async fn it_speaks_over_a_serial_port() {
    use std::os::fd::FromRawFd as _;

    let (mut master, mut slave) = (0, 0);
    let mut name = [0; 128];
    let made = unsafe {
        libc::openpty(&raw mut master, &raw mut slave, name.as_mut_ptr(), std::ptr::null_mut(), std::ptr::null_mut())
    };
    assert_eq!(made, 0);
    let name = unsafe { std::ffi::CStr::from_ptr(name.as_ptr()) }.to_str().unwrap().to_owned();
    // Kept open, so that the master does not report an end before the client has opened it.
    let slave = unsafe { std::fs::File::from_raw_fd(slave) };
    let mut line = Line(unsafe { std::fs::File::from_raw_fd(master) });
    let peer = std::thread::spawn(move || {
        line.log_in_frames();
        line.expect(b"\x02S\x03\x50");
        for byte in GOOD_STATUS {
            line.send(&[*byte]);
        }
        line.answer(b"\x02W\x01\x01\x0f\x03\x5b", b"\x06W\x03\x54");
        line
    });
    let target = format!("serial:{name}?baud=115200").parse().unwrap();
    let mut client = RemoteClient::new(target, Password::default(), timeouts());
    let status = client.request(&STATUS).await;
    assert!(matches!(status, Ok(Reply::Status(_))), "{status:?}");
    let request = Request::SetIOWord { port: PortNumber::new(1).unwrap(), value: 0x010F };
    assert_eq!(client.request(&request).await, Ok(Reply::Done));
    drop(client);
    drop(peer.join().unwrap());
    drop(slave);
}
