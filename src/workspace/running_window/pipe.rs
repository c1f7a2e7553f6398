use std::fs::File;
use std::io;
use std::os::windows::fs::OpenOptionsExt as _;
use std::os::windows::io::AsRawHandle as _;
use std::path::Path;
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use sha2::{Digest as _, Sha256};
use tokio::net::windows::named_pipe::{NamedPipeServer, ServerOptions};
use windows_sys::Win32::Foundation::ERROR_PIPE_BUSY;
use windows_sys::Win32::Storage::FileSystem::SECURITY_IDENTIFICATION;
use windows_sys::Win32::System::Pipes::GetNamedPipeServerProcessId;
use windows_sys::Win32::UI::WindowsAndMessaging::AllowSetForegroundWindow;

use super::exchange::{ShowWindowOutcome, answer};
use crate::platform::windows::access::Descriptor;
use crate::workspace::WorkspaceLock;

/// Waits for other starts on the workspace.
#[derive(Debug)]
pub struct StartRequests {
    name: String,
}

impl StartRequests {
    /// The lock proves that no other window listens. Errors: the name of the pipe cannot be made.
    pub fn listen(root: &Path, _lock: &WorkspaceLock) -> io::Result<Self> {
        Ok(Self { name: pipe_name(root)? })
    }

    /// Answers requests until it is dropped, and tells `on_request` of each. Needs a runtime when it is first polled.
    pub fn serve(
        &self,
        shown: ShowWindowOutcome,
        on_request: impl Fn() + Send + Sync + 'static,
    ) -> impl Future<Output = ()> + Send + 'static {
        let (name, on_request) = (self.name.clone(), Arc::new(on_request));
        async move {
            let mut first = true;
            loop {
                let connected = async {
                    let pipe = create(&name, first)?;
                    first = false;
                    pipe.connect().await?;
                    io::Result::Ok(pipe)
                };
                match connected.await {
                    Ok(pipe) => {
                        tokio::spawn(answer(pipe, shown, on_request.clone()));
                    }
                    Err(error) => {
                        tracing::debug!(%error, "a second start cannot show this window for a moment");
                        tokio::time::sleep(PAUSE).await;
                    }
                }
            }
        }
    }
}

/// `first`: fails if another program has a pipe of this name.
fn create(name: &str, first: bool) -> io::Result<NamedPipeServer> {
    let descriptor = Descriptor::private()?;
    let mut attributes = descriptor.attributes();
    let mut options = ServerOptions::new();
    options.first_pipe_instance(first).reject_remote_clients(true).max_instances(INSTANCES);
    // SAFETY: the attributes outlive the call.
    unsafe { options.create_with_security_attributes_raw(name, (&raw mut attributes).cast()) }
}

pub(super) fn connect(root: &Path) -> io::Result<File> {
    let name = pipe_name(root)?;
    // The server may learn who asks, but not act in this account's name.
    let mut options = File::options();
    options.read(true).write(true).security_qos_flags(SECURITY_IDENTIFICATION);
    // Between two requests there is a moment without a free end of the pipe.
    let is_busy = |error: &io::Error| error.raw_os_error().map(i32::cast_unsigned) == Some(ERROR_PIPE_BUSY);
    let mut attempts = 0;
    let pipe = loop {
        match options.open(&name) {
            Err(error) if is_busy(&error) && attempts < ATTEMPTS => {
                attempts += 1;
                thread::sleep(SHORT_PAUSE);
            }
            result => break result?,
        }
    };
    let mut process = 0;
    // SAFETY: the handle is open; the number outlives the call. Windows lets only the program in front, which is this
    // one, say who may come to the front next.
    unsafe {
        if GetNamedPipeServerProcessId(pipe.as_raw_handle(), &raw mut process) != 0 {
            AllowSetForegroundWindow(process);
        }
    }
    Ok(pipe)
}

/// The same for every way to write the path of a folder that exists.
fn pipe_name(root: &Path) -> io::Result<String> {
    let path = std::fs::canonicalize(root)?;
    let digest = Sha256::digest(path.to_string_lossy().to_lowercase());
    Ok(format!(r"\\.\pipe\opcua-configurator-{}", hex::encode(&digest[..16])))
}

const INSTANCES: usize = 8;
const PAUSE: Duration = Duration::from_secs(1);
const ATTEMPTS: u32 = 100;
const SHORT_PAUSE: Duration = Duration::from_millis(20);
