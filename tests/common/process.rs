//! Other programs in a test: every wait has a deadline, and none outlives the test that started it.

use std::io::{self, BufRead, BufReader, Read, Write as _};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// A program that runs until it ends by itself or this value is dropped.
pub struct Running {
    program: String,
    child: Child,
    lines: Receiver<String>,
    stderr: Option<JoinHandle<String>>,
}

/// What a program that ended left behind.
pub struct Finished {
    /// `None` if a signal ended it.
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl Running {
    /// Fails only if the program cannot be started at all, as when it is not installed.
    pub fn start(command: &mut Command) -> io::Result<Self> {
        Self::start_with(command, Stdio::null())
    }

    /// As [`Running::start`], with something on standard input.
    pub fn start_with(command: &mut Command, stdin: Stdio) -> io::Result<Self> {
        #[cfg(unix)]
        with_default_hang_up(command);
        let mut child = command.stdin(stdin).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn()?;
        let stdout = child.stdout.take().expect("stdout is piped");
        let mut stderr = child.stderr.take().expect("stderr is piped");
        let (sender, lines) = channel();
        thread::spawn(move || {
            for line in BufReader::new(stdout).lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    break;
                }
            }
        });
        let stderr = thread::spawn(move || {
            let mut bytes = Vec::new();
            let _ = stderr.read_to_end(&mut bytes);
            String::from_utf8_lossy(&bytes).into_owned()
        });
        Ok(Self { program: format!("{command:?}"), child, lines, stderr: Some(stderr) })
    }

    /// The next line on standard output. Panics, with what the program wrote to standard error, if none comes.
    pub fn next_line(&mut self, deadline: Duration) -> String {
        self.try_line(deadline).unwrap_or_else(|why| panic!("no line from {}: {why}", self.program))
    }

    /// As [`Running::next_line`], but tells why none came.
    pub fn try_line(&mut self, deadline: Duration) -> Result<String, String> {
        self.lines.recv_timeout(deadline).map_err(|why| format!("{why}\n{}", self.end()))
    }

    /// The number of the process.
    pub fn id(&self) -> u32 {
        self.child.id()
    }

    /// Writes a line to standard input, which must be a pipe.
    pub fn write_line(&mut self, line: &str) {
        let stdin = self.child.stdin.as_mut().expect("stdin is piped");
        writeln!(stdin, "{line}").unwrap_or_else(|why| panic!("{} does not listen: {why}", self.program));
    }

    /// Sends a signal to the program.
    #[cfg(unix)]
    pub fn signal(&self, signal: libc::c_int) {
        // SAFETY: the process was not waited for yet, so the number is still its own.
        assert_eq!(unsafe { libc::kill(self.id().cast_signed(), signal) }, 0);
    }

    /// Waits until the program has ended by itself. Panics if it has not by the deadline.
    pub fn finish(mut self, deadline: Duration) -> Finished {
        let until = Instant::now() + deadline;
        let mut stdout = String::new();
        let code = loop {
            match self.lines.recv_timeout(until.saturating_duration_since(Instant::now())) {
                Ok(line) => stdout = stdout + &line + "\n",
                Err(RecvTimeoutError::Disconnected) => {
                    break self.child.wait().expect("a child can be waited for").code();
                }
                Err(RecvTimeoutError::Timeout) => {
                    let program = self.program.clone();
                    panic!("{program} did not end within {deadline:?}\n{stdout}{}", self.end())
                }
            }
        };
        Finished { code, stdout, stderr: self.end() }
    }

    /// Ends the program if it still runs, and gives what it wrote to standard error.
    fn end(&mut self) -> String {
        let _ = self.child.kill();
        let _ = self.child.wait();
        self.stderr.take().and_then(|reader| reader.join().ok()).unwrap_or_default()
    }
}

/// The program ends when its terminal is closed, also if the tests run under `nohup`, which children inherit.
#[cfg(unix)]
fn with_default_hang_up(command: &mut Command) {
    use std::os::unix::process::CommandExt as _;
    let reset = || {
        // SAFETY: signal(2) is safe to call between fork and exec.
        unsafe { libc::signal(libc::SIGHUP, libc::SIG_DFL) };
        Ok(())
    };
    // SAFETY: the closure only calls signal(2).
    unsafe { command.pre_exec(reset) };
}

impl Drop for Running {
    fn drop(&mut self) {
        self.end();
    }
}
