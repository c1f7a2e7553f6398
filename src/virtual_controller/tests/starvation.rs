//! Peers without a password that want all connections of the management protocol.

use std::net::SocketAddr;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use rustls::pki_types::ServerName;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::{TcpSocket, TcpStream};
use tokio::task::JoinSet;
use tokio_rustls::TlsConnector;

use super::test_controller::{ApiClient, CURRENT, PASSWORD, TestController, bounded, initial, tls};
use crate::model::ControllerInfo;
use crate::protocol;
use crate::protocol::Request as _;

/// A connection from another address of this machine.
async fn dial(to: SocketAddr, from: [u8; 4]) -> std::io::Result<TcpStream> {
    let socket = TcpSocket::new_v4()?;
    socket.bind((from, 0).into())?;
    socket.connect(to).await
}

/// Strangers that connect again whenever they are disconnected, and count how often they got through.
struct Strangers {
    tasks: JoinSet<()>,
    got_through: Arc<AtomicUsize>,
}

impl Strangers {
    /// `count` of them from one address; each sends `requests` over TLS, one after another, or nothing without TLS.
    fn start(test_controller: &TestController, count: usize, from: [u8; 4], requests: Option<&'static str>) -> Self {
        let (address, got_through) = (test_controller.controller.management_address(), Arc::new(AtomicUsize::new(0)));
        let tls = TlsConnector::from(Arc::new(tls(&test_controller.controller)));
        let mut tasks = JoinSet::new();
        for _ in 0..count {
            let (tls, got_through) = (tls.clone(), got_through.clone());
            tasks.spawn(async move {
                loop {
                    let _ended = hold(address, from, &tls, requests, &got_through).await;
                    tokio::time::sleep(Duration::from_millis(100)).await;
                }
            });
        }
        Self { tasks, got_through }
    }

    async fn have_got_through(&self, count: usize) {
        while self.got_through.load(Ordering::Relaxed) < count {
            tokio::time::sleep(Duration::from_millis(10)).await;
        }
    }
}

async fn hold(
    address: SocketAddr,
    from: [u8; 4],
    tls: &TlsConnector,
    requests: Option<&str>,
    got_through: &AtomicUsize,
) -> std::io::Result<()> {
    let mut stream = dial(address, from).await?;
    let mut answer = [0; 512];
    let Some(request) = requests else {
        got_through.fetch_add(1, Ordering::Relaxed);
        return stream.read(&mut answer).await.map(|_| ());
    };
    let mut stream = tls.connect(ServerName::from(address.ip()), stream).await?;
    loop {
        stream.write_all(request.as_bytes()).await?;
        got_through.fetch_add(1, Ordering::Relaxed);
        if stream.read(&mut answer).await? == 0 {
            return Ok(());
        }
        tokio::time::sleep(Duration::from_secs(4)).await;
    }
}

/// Ten times, each over a new connection; the longest time it took.
async fn serves_the_engineer(test_controller: &TestController) -> Duration {
    let mut longest = Duration::ZERO;
    for _ in 0..10 {
        let asked = Instant::now();
        let mut client = ApiClient::new(&test_controller.controller);
        client.login(PASSWORD).await.unwrap();
        let _: ControllerInfo = client.get(protocol::GetInfo::PATH).await.unwrap();
        longest = longest.max(asked.elapsed());
    }
    longest
}

#[tokio::test(flavor = "multi_thread")]
async fn strangers_keep_no_engineer_out() {
    bounded(async {
        let test_controller = TestController::new(initial(CURRENT)).await;
        let mut working = test_controller.client().await;
        let hello = Some("GET /v1/hello HTTP/1.1\r\nHost: a\r\n\r\n");
        let slow_login = Some("POST /v1/login HTTP/1.1\r\nHost: a\r\nContent-Length: 1000\r\n\r\n{");
        for (what, count, requests) in [("hello", 70, hello), ("nothing", 200, None), ("slow bodies", 70, slow_login)] {
            let strangers = Strangers::start(&test_controller, count, [127, 0, 0, 77], requests);
            strangers.have_got_through(count).await;
            let longest = serves_the_engineer(&test_controller).await;
            println!("10 of 10 while {count} connections send {what}; the longest took {longest:?}");
            assert!(longest < Duration::from_secs(5), "{what}: {longest:?}");
            let _: ControllerInfo = working.get(protocol::GetInfo::PATH).await.unwrap();
            drop(strangers.tasks);
        }
        let mut strangers = JoinSet::new();
        for last in 1..=100 {
            strangers.spawn(dial(test_controller.controller.management_address(), [127, 0, 1, last]));
        }
        let held = strangers.join_all().await;
        println!("from {} addresses: {:?}", held.len(), serves_the_engineer(&test_controller).await);
        working.login(PASSWORD).await.unwrap();
        test_controller.controller.shutdown().await;
    })
    .await;
}
