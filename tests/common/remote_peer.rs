//! A controller with remote commands that does what a test says, byte for byte.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::thread::JoinHandle;
use std::time::Duration;

const LIMIT: Duration = Duration::from_secs(60);

/// The script runs in a thread of its own, with a listener that accepts what the program connects.
pub struct RemotePeer {
    address: SocketAddr,
    thread: JoinHandle<()>,
}

impl RemotePeer {
    pub fn start(script: impl FnOnce(&TcpListener) + Send + 'static) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap();
        Self { address, thread: std::thread::spawn(move || script(&listener)) }
    }

    /// The text form.
    pub fn text(&self) -> String {
        format!("tcp://{}", self.address)
    }

    /// Frames, as a serial device server carries them.
    pub fn frames(&self) -> String {
        format!("raw-tcp://{}", self.address)
    }

    /// Waits for the end of the script; panics if something else came than it expects.
    pub fn end(self) {
        self.thread.join().unwrap();
    }
}

/// One connection, or the other end of a serial line.
pub struct RemoteLine<T>(pub T);

pub fn accept(listener: &TcpListener) -> RemoteLine<TcpStream> {
    let stream = listener.accept().unwrap().0;
    stream.set_read_timeout(Some(LIMIT)).unwrap();
    RemoteLine(stream)
}

impl<T: Read + Write> RemoteLine<T> {
    pub fn expect(&mut self, bytes: &[u8]) {
        let mut came = vec![0; bytes.len()];
        self.0.read_exact(&mut came).unwrap();
        assert_eq!(came, bytes, "{} and not {}", came.escape_ascii(), bytes.escape_ascii());
    }

    pub fn send(&mut self, bytes: &[u8]) {
        self.0.write_all(bytes).unwrap();
    }

    pub fn answer(&mut self, request: &[u8], answer: &[u8]) {
        self.expect(request);
        self.send(answer);
    }

    /// A login without a password.
    pub fn log_in(&mut self) {
        self.answer(b"$Login,\r\n", b"#Login,0\r\n");
    }

    /// The same in frames, after the remote function was opened.
    pub fn log_in_frames(&mut self) {
        self.answer(b"\x04\x02L\x03\x4f", b"\x06L\x03\x4f");
    }

    /// Nothing more comes, and the connection ends.
    pub fn expect_end(&mut self) {
        let mut rest = Vec::new();
        // A reset is an end as well.
        let _reset = self.0.read_to_end(&mut rest);
        assert!(rest.is_empty(), "{}", rest.escape_ascii());
    }
}
