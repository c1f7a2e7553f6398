//! Lines of bytes to another program: a new pseudo-terminal, or a serial device (Unix).

use std::ffi::{CStr, OsStr, c_int};
use std::fs::{File, OpenOptions};
use std::io;
use std::os::fd::{AsRawFd as _, FromRawFd as _, OwnedFd};
use std::os::unix::ffi::OsStrExt as _;
use std::os::unix::fs::OpenOptionsExt as _;
use std::path::{Path, PathBuf};

/// One end of a line. Reads and writes do not block; they fail with [`io::ErrorKind::WouldBlock`].
#[derive(Debug)]
pub struct TerminalLine {
    /// Bytes of the line.
    pub file: File,
    /// What a client opens: the other end of the pseudo-terminal, or the device itself.
    pub path: PathBuf,
    /// The other end of a pseudo-terminal is held open: without anybody there, reads would fail.
    _other_end: Option<OwnedFd>,
}

/// The speeds of a serial line, in bits a second.
pub const SPEEDS: [u32; 5] = [9600, 19_200, 38_400, 57_600, 115_200];

/// Makes a pseudo-terminal in raw mode: bytes pass as they are.
pub fn pseudo_terminal() -> io::Result<TerminalLine> {
    let (mut first, mut second): (c_int, c_int) = (-1, -1);
    let (name, settings, size) = (std::ptr::null_mut(), std::ptr::null_mut(), std::ptr::null_mut());
    // SAFETY: both numbers outlive the call; the other pointers may be null (openpty(3)).
    if unsafe { libc::openpty(&raw mut first, &raw mut second, name, settings, size) } != 0 {
        return Err(io::Error::last_os_error());
    }
    // SAFETY: openpty has just opened both, and nothing else owns them.
    let (first, second) = unsafe { (File::from_raw_fd(first), OwnedFd::from_raw_fd(second)) };
    for end in [first.as_raw_fd(), second.as_raw_fd()] {
        change_flags(end, libc::F_GETFD, libc::F_SETFD, libc::FD_CLOEXEC)?;
    }
    change_flags(first.as_raw_fd(), libc::F_GETFL, libc::F_SETFL, libc::O_NONBLOCK)?;
    make_raw(second.as_raw_fd(), None)?;
    let path = name_of(second.as_raw_fd())?;
    Ok(TerminalLine { file: first, path, _other_end: Some(second) })
}

/// Opens a serial device: 8 data bits, no parity, 1 stop bit, no handshake, at one of [`SPEEDS`].
///
/// Errors: those of the operating system, and [`io::ErrorKind::InvalidInput`] for another speed.
pub fn serial_device(path: &Path, baud: u32) -> io::Result<TerminalLine> {
    let speed = match baud {
        9600 => libc::B9600,
        19_200 => libc::B19200,
        38_400 => libc::B38400,
        57_600 => libc::B57600,
        115_200 => libc::B115200,
        _ => return Err(io::ErrorKind::InvalidInput.into()),
    };
    let flags = libc::O_NOCTTY | libc::O_NONBLOCK;
    let file = OpenOptions::new().read(true).write(true).custom_flags(flags).open(path)?;
    make_raw(file.as_raw_fd(), Some(speed))?;
    Ok(TerminalLine { file, path: path.to_owned(), _other_end: None })
}

fn change_flags(file: c_int, get: c_int, set: c_int, flag: c_int) -> io::Result<()> {
    // SAFETY: the file is open; neither call takes a pointer.
    let changed = unsafe {
        match libc::fcntl(file, get) {
            -1 => -1,
            flags => libc::fcntl(file, set, flags | flag),
        }
    };
    if changed == -1 { Err(io::Error::last_os_error()) } else { Ok(()) }
}

fn make_raw(terminal: c_int, speed: Option<libc::speed_t>) -> io::Result<()> {
    // SAFETY: a termios is plain data for which zero is a value; tcgetattr fills it before anything reads it.
    let mut settings: libc::termios = unsafe { std::mem::zeroed() };
    // SAFETY: the terminal is open, and the settings outlive the calls.
    let done = unsafe {
        libc::tcgetattr(terminal, &raw mut settings) == 0 && {
            libc::cfmakeraw(&raw mut settings);
            settings.c_cflag |= libc::CLOCAL | libc::CREAD;
            settings.c_cflag &= !(libc::CSTOPB | libc::CRTSCTS);
            speed.is_none_or(|speed| libc::cfsetspeed(&raw mut settings, speed) == 0)
                && libc::tcsetattr(terminal, libc::TCSANOW, &raw const settings) == 0
        }
    };
    if done { Ok(()) } else { Err(io::Error::last_os_error()) }
}

fn name_of(terminal: c_int) -> io::Result<PathBuf> {
    let mut name = [0; 256];
    // SAFETY: the buffer outlives the call, which writes at most its length with the zero at the end.
    let error = unsafe { libc::ttyname_r(terminal, name.as_mut_ptr(), name.len()) };
    if error != 0 {
        return Err(io::Error::from_raw_os_error(error));
    }
    // SAFETY: ttyname_r has succeeded, so that the buffer holds a text with a zero at its end.
    let name = unsafe { CStr::from_ptr(name.as_ptr()) };
    Ok(PathBuf::from(OsStr::from_bytes(name.to_bytes())))
}

#[cfg(test)]
mod tests {
    use std::io::{Read as _, Write as _};

    use super::*;

    #[test]
    fn every_byte_passes_as_it_is_and_clients_may_come_and_go() {
        let mut line = pseudo_terminal().unwrap();
        let bytes: Vec<u8> = (0..=255).collect();
        for _ in 0..2 {
            let mut client = OpenOptions::new().read(true).write(true).open(&line.path).unwrap();
            line.file.write_all(&bytes).unwrap();
            let mut read = vec![0; bytes.len()];
            client.read_exact(&mut read).unwrap();
            assert_eq!(read, bytes);
            client.write_all(&bytes).unwrap();
            let mut read = Vec::new();
            while read.len() < bytes.len() {
                let mut piece = [0; 64];
                match line.file.read(&mut piece) {
                    Ok(length) => read.extend_from_slice(&piece[..length]),
                    Err(error) => assert_eq!(error.kind(), io::ErrorKind::WouldBlock),
                }
            }
            assert_eq!(read, bytes);
        }
        assert_eq!(line.file.read(&mut [0; 8]).unwrap_err().kind(), io::ErrorKind::WouldBlock);
    }

    #[test]
    fn a_device_has_one_of_the_speeds_and_has_to_be_a_terminal() {
        let line = pseudo_terminal().unwrap();
        for speed in SPEEDS {
            assert_eq!(serial_device(&line.path, speed).unwrap().path, line.path);
        }
        assert_eq!(serial_device(&line.path, 12_345).unwrap_err().kind(), io::ErrorKind::InvalidInput);
        assert_eq!(serial_device(Path::new("/nowhere"), 9600).unwrap_err().kind(), io::ErrorKind::NotFound);
        let file = tempfile::NamedTempFile::new().unwrap();
        assert!(serial_device(file.path(), 9600).is_err());
    }
}
