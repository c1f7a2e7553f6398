//! A watch against a controller that answers as each test says.

use std::sync::Arc;
use std::time::Duration;

use parking_lot::Mutex;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::mpsc::{UnboundedReceiver, UnboundedSender, unbounded_channel};
use tokio::task::JoinHandle;
use tokio::time::timeout;
use tokio_util::sync::CancellationToken;

use super::*;
use crate::model::{Address, ErrorCode, StatusFlag, StatusFlags};
use crate::remote::client::{Direction, RemoteError, RemoteTarget};
use crate::remote::text::{RequestDecoder, Spelling, Terminator, encode_refusal, encode_reply};
use crate::remote::{
    Answer, Command, FunctionNumber, MessageLanguage, Password, PortNumber, RefusalCode, RemoteStatus, Reply, Request,
    SpelCommand,
};

/// What a controller does with a request; `None`: it closes the connection without an answer. An Execute of `Wait` is
/// answered after an Abort.
type Behaviour = dyn Fn(&Request) -> Option<Answer> + Send + Sync;

/// Answers over TCP, one client after the other, and notes what it was asked.
struct Controller {
    target: RemoteTarget,
    asked: Arc<Mutex<Vec<Request>>>,
    task: JoinHandle<()>,
}

impl Controller {
    async fn start(behaviour: impl Fn(&Request) -> Option<Answer> + Send + Sync + 'static) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = Address::with_default_port(&listener.local_addr().unwrap().to_string(), 1).unwrap();
        let asked: Arc<Mutex<Vec<Request>>> = Arc::default();
        let (notes, behaviour) = (Arc::clone(&asked), Arc::new(behaviour));
        let task = tokio::spawn(async move {
            while let Ok((stream, _)) = listener.accept().await {
                converse(stream, behaviour.as_ref(), &notes).await;
            }
        });
        Self { target: RemoteTarget::Ethernet { address, terminator: Terminator::CrLf }, asked, task }
    }

    fn count(&self, command: Command) -> usize {
        self.asked.lock().iter().filter(|request| request.command() == command).count()
    }
}

impl Drop for Controller {
    fn drop(&mut self) {
        self.task.abort();
    }
}

async fn converse(mut stream: TcpStream, behaviour: &Behaviour, asked: &Mutex<Vec<Request>>) {
    let mut decoder = RequestDecoder::default();
    let mut buffer = [0; 1024];
    while let Ok(count @ 1..) = stream.read(&mut buffer).await {
        decoder.add(&buffer[..count]);
        while let Some(line) = decoder.next_line() {
            let request = line.request.unwrap();
            asked.lock().push(request.clone());
            if matches!(&request, Request::Execute { spel } if spel.as_str() == "Wait") {
                continue;
            }
            let Some(answer) = behaviour(&request) else { return };
            let mut bytes = match answer {
                Answer::Good(reply) => encode_reply(&line.spelling, &request, &reply, Terminator::CrLf).unwrap(),
                Answer::Refused(code) => encode_refusal(&Spelling::from(request.command()), code, Terminator::CrLf),
            };
            if request == Request::Abort {
                let aborted = Spelling::from(Command::Execute);
                bytes.extend(encode_refusal(&aborted, RefusalCode::SystemError, Terminator::CrLf));
            }
            stream.write_all(&bytes).await.unwrap();
        }
    }
}

/// A controller in Auto that is ready, with an error number that its firmware can explain.
fn healthy(request: &Request) -> Option<Answer> {
    let mut flags = StatusFlags::default();
    flags.set(StatusFlag::Auto, true);
    flags.set(StatusFlag::Ready, true);
    Some(match request {
        Request::GetStatus => Answer::Good(Reply::Status(RemoteStatus { flags, code: 517 })),
        Request::GetErrMsg { .. } => Answer::Good(Reply::Text("Low battery".into())),
        Request::GetContName => Answer::Good(Reply::Text("Cell 7".into())),
        Request::GetIOWord { port } => Answer::Good(Reply::Word(0x0F00 + u16::from(port.get()))),
        Request::Login { .. } | Request::Start { .. } | Request::Stop | Request::Abort => Answer::Good(Reply::Done),
        _ => Answer::Refused(RefusalCode::UnknownCommand),
    })
}

struct Watching {
    events: UnboundedReceiver<RemoteControlEvent>,
    requests: UnboundedSender<RemoteControlRequest>,
    cancel: CancellationToken,
    task: JoinHandle<()>,
}

impl Watching {
    fn begin(controller: &Controller) -> Self {
        let (sender, events) = unbounded_channel();
        let (requests, receiver) = unbounded_channel();
        let cancel = CancellationToken::new();
        let connection = RemoteConnection {
            target: controller.target.clone(),
            password: Password::new("s3cret-word").unwrap(),
            language: MessageLanguage::new(0).unwrap(),
        };
        let on_event = move |event| drop(sender.send(event));
        let task = tokio::spawn(control_remotely(connection, receiver, cancel.clone(), on_event));
        Self { events, requests, cancel, task }
    }

    fn ask(&self, request: RemoteControlRequest) {
        self.requests.send(request).unwrap();
    }

    /// The next event that fits.
    async fn next<T>(&mut self, fits: impl Fn(RemoteControlEvent) -> Option<T>) -> T {
        let found = async {
            loop {
                let event = self.events.recv().await.expect("the watch goes on");
                if let Some(found) = fits(event) {
                    return found;
                }
            }
        };
        timeout(LIMIT, found).await.expect("the event comes in time")
    }

    async fn connected(&mut self) {
        self.next(|event| (event == RemoteControlEvent::Connected).then_some(())).await;
    }

    async fn done(&mut self) -> Result<Reply, RemoteError> {
        self.next(|event| match event {
            RemoteControlEvent::Done { result, .. } => Some(result),
            _ => None,
        })
        .await
    }
}

const LIMIT: Duration = Duration::from_secs(30);

fn start() -> Request {
    Request::Start { function: FunctionNumber::new(0).unwrap() }
}

#[tokio::test]
async fn state_identity_and_the_values_that_are_shown_are_reported() {
    let controller = Controller::start(healthy).await;
    let mut watch = Watching::begin(&controller);
    let read = Request::GetIOWord { port: PortNumber::new(3).unwrap() };
    watch.ask(RemoteControlRequest::Show(vec![read.clone()]));
    watch.connected().await;
    let (status, message) = watch
        .next(|event| match event {
            RemoteControlEvent::Status { status, message } => Some((status, message)),
            _ => None,
        })
        .await;
    assert!(status.flags.contains(StatusFlag::Ready) && status.code == 517);
    assert_eq!(message.as_deref(), Some("Low battery"));
    let identity = watch
        .next(|event| match event {
            RemoteControlEvent::Identity(identity) => Some(identity),
            _ => None,
        })
        .await;
    assert_eq!((identity.name.as_deref(), identity.serial), (Some("Cell 7"), None));
    for _ in 0..2 {
        let values = watch
            .next(|event| match event {
                RemoteControlEvent::Values(values) => Some(values),
                _ => None,
            })
            .await;
        assert_eq!(values, [(read.clone(), Ok(Reply::Word(0x0F03)))]);
    }
    assert_eq!(controller.count(Command::GetErrMsg), 1, "the text of the same error is read once");
    watch.cancel.cancel();
    timeout(LIMIT, watch.task).await.unwrap().unwrap();
}

#[tokio::test]
async fn every_message_is_reported_with_the_password_masked() {
    let controller = Controller::start(healthy).await;
    let mut watch = Watching::begin(&controller);
    watch.connected().await;
    watch.ask(RemoteControlRequest::Do(start()));
    let mut seen = Vec::new();
    while !seen.iter().any(|exchange: &LoggedExchange| exchange.message.text().starts_with("#Start,0")) {
        let exchanges = watch.next(|event| match event {
            RemoteControlEvent::Exchanged(exchanges) => Some(exchanges),
            _ => None,
        });
        seen.extend(exchanges.await);
    }
    assert_eq!(seen[0].message.text(), "$Login,***<0D><0A>");
    assert!(!seen.iter().any(|exchange| exchange.message.text().contains("s3cret")));
    let asked: Vec<String> = seen.iter().filter(|one| !one.is_polling).map(|one| one.message.text()).collect();
    assert_eq!(asked, ["$Start,0<0D><0A>", "#Start,0<0D><0A>"]);
    assert_eq!(seen.last().unwrap().message.direction, Direction::Received);
}

#[tokio::test]
async fn a_command_that_is_asked_for_without_a_connection_is_refused_and_never_sent() {
    let is_reachable = Arc::new(Mutex::new(false));
    let controller = Controller::start({
        let is_reachable = Arc::clone(&is_reachable);
        move |request| if *is_reachable.lock() { healthy(request) } else { None }
    })
    .await;
    let mut watch = Watching::begin(&controller);
    watch.next(|event| matches!(event, RemoteControlEvent::Lost(_)).then_some(())).await;
    watch.ask(RemoteControlRequest::Do(start()));
    assert!(matches!(watch.done().await, Err(RemoteError::ConnectionLost { command: Command::Start, .. })));
    *is_reachable.lock() = true;
    watch.connected().await;
    watch.next(|event| matches!(event, RemoteControlEvent::Status { .. }).then_some(())).await;
    assert_eq!(controller.count(Command::Start), 0);
    watch.ask(RemoteControlRequest::Do(start()));
    assert_eq!(watch.done().await, Ok(Reply::Done));
    assert_eq!(controller.count(Command::Start), 1);
}

#[tokio::test]
async fn an_answer_that_is_lost_is_told_as_unknown_and_the_command_is_not_repeated() {
    let controller = Controller::start(|request| match request {
        Request::Start { .. } => None,
        other => healthy(other),
    })
    .await;
    let mut watch = Watching::begin(&controller);
    watch.connected().await;
    watch.ask(RemoteControlRequest::Do(start()));
    assert!(matches!(watch.done().await, Err(RemoteError::OutcomeUnknown { command: Command::Start, .. })));
    watch.next(|event| matches!(event, RemoteControlEvent::Lost(_)).then_some(())).await;
    watch.connected().await;
    watch.next(|event| matches!(event, RemoteControlEvent::Status { .. }).then_some(())).await;
    assert_eq!(controller.count(Command::Start), 1);
}

#[tokio::test]
async fn a_wrong_password_ends_the_watch_after_one_try() {
    let controller = Controller::start(|request| match request {
        Request::Login { .. } => Some(Answer::Refused(RefusalCode::WrongPassword)),
        other => healthy(other),
    })
    .await;
    let mut watch = Watching::begin(&controller);
    let problem = watch.next(|event| match event {
        RemoteControlEvent::Ended(problem) => Some(problem),
        _ => None,
    });
    assert_eq!(problem.await.code, ErrorCode::RemoteWrongPassword);
    timeout(LIMIT, watch.task).await.unwrap().unwrap();
    assert_eq!(controller.count(Command::Login), 1);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_command_that_was_sent_is_waited_for_when_the_watch_is_cancelled() {
    let (sent, mut is_sent) = unbounded_channel();
    let (answer, answers) = std::sync::mpsc::channel::<()>();
    let answers = Mutex::new(answers);
    let controller = Controller::start(move |request| {
        if request.command() == Command::Stop {
            sent.send(()).unwrap();
            // Blocks one of the threads of this test until the watch is cancelled.
            tokio::task::block_in_place(|| answers.lock().recv_timeout(LIMIT).unwrap());
        }
        healthy(request)
    });
    let controller = controller.await;
    let mut watch = Watching::begin(&controller);
    watch.connected().await;
    watch.ask(RemoteControlRequest::Do(Request::Stop));
    timeout(LIMIT, is_sent.recv()).await.unwrap().unwrap();
    watch.cancel.cancel();
    answer.send(()).unwrap();
    assert_eq!(watch.done().await, Ok(Reply::Done));
    timeout(LIMIT, watch.task).await.unwrap().unwrap();
}

#[tokio::test]
async fn an_execute_is_aborted_while_it_runs_and_the_state_is_read_meanwhile() {
    let controller = Controller::start(healthy).await;
    let mut watch = Watching::begin(&controller);
    watch.connected().await;
    let spel = SpelCommand::new("Wait").unwrap();
    watch.ask(RemoteControlRequest::Do(Request::Execute { spel }));
    while controller.count(Command::Execute) == 0 {
        watch.next(|_| Some(())).await;
    }
    let before = controller.count(Command::GetStatus);
    while controller.count(Command::GetStatus) < before + 2 {
        watch.next(|event| matches!(event, RemoteControlEvent::Status { .. }).then_some(())).await;
    }
    watch.ask(RemoteControlRequest::Do(start()));
    let refused = Err(RemoteError::Refused { command: Command::Start, code: RefusalCode::ExecuteRunning });
    assert_eq!(watch.done().await, refused);
    watch.ask(RemoteControlRequest::Do(Request::Abort));
    assert_eq!(watch.done().await, Ok(Reply::Done));
    let aborted = Err(RemoteError::Refused { command: Command::Execute, code: RefusalCode::SystemError });
    assert_eq!(watch.done().await, aborted);
    assert_eq!((controller.count(Command::Start), controller.count(Command::Abort)), (0, 1));
    watch.ask(RemoteControlRequest::Do(start()));
    assert_eq!(watch.done().await, Ok(Reply::Done), "the connection goes on");
}
