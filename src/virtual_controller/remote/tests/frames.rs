use super::*;
use crate::virtual_controller::cell::StatusFlag;

/// The manual's worked requests, and the answers by its rules, byte for byte.
const EXCHANGES: &[(&str, &str)] = &[
    // GetStatus before the remote function is opened, and before Login.
    ("02 53 03 50", "15 53 31 31 03 50"),
    // Login without a password.
    ("02 4C 03 4F", "06 4C 03 4F"),
    ("02 53 03 50", "06 53 00 00 01 00 00 00 00 00 00 00 01 30 30 30 30 03 50"),
    // GetAlm, GetCurRobot, SetMotorsOn 1, SetMotorsOff all.
    ("02 7A 03 79", "06 7A 00 03 79"),
    ("02 79 03 7A", "06 79 01 03 7B"),
    ("02 4D 01 03 4F", "06 4D 03 4E"),
    ("02 4E 00 03 4D", "06 4E 03 4D"),
    // GetIO 1, SetIO 1 on, GetIOByte 1, SetIOByte 1 = 0F, GetIOWord 1, SetIOWord 32 = 010F.
    ("02 69 00 01 03 6B", "06 69 00 03 6A"),
    ("02 49 00 01 01 03 4A", "06 49 03 4A"),
    ("02 62 01 03 60", "06 62 00 03 61"),
    ("02 42 01 0F 03 4F", "06 42 03 41"),
    ("02 77 01 03 75", "06 77 00 00 03 74"),
    ("02 57 20 01 0F 03 7A", "06 57 03 54"),
    // GetMemIO 1, SetMemIO 1 on, GetMemIO 1, and byte and word.
    ("02 6F 00 01 03 6D", "06 6F 00 03 6C"),
    ("02 4F 00 01 01 03 4C", "06 4F 03 4C"),
    ("02 6F 00 01 03 6D", "06 6F 01 03 6D"),
    ("02 54 01 0F 03 59", "06 54 03 57"),
    ("02 74 01 03 76", "06 74 0F 03 78"),
    ("02 55 01 01 0F 03 59", "06 55 03 56"),
    ("02 75 01 03 77", "06 75 01 0F 03 78"),
    // SetVariable g_Status = 0, GetVariable g_Status.
    ("02 56 67 5F 53 74 61 74 75 73 2C 00 00 2C 03 03 5A", "06 56 03 55"),
    ("02 76 67 5F 53 74 61 74 75 73 2C 03 03 56", "06 76 00 00 03 75"),
    // Ten elements of g_intArray, and of g_int3Array from (3,5,0) on.
    (
        "02 76 67 5F 69 6E 74 41 72 72 61 79 2C 00 00 2C 03 2C 00 0A 03 42",
        "06 76 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 03 75",
    ),
    (
        "02 76 67 5F 69 6E 74 33 41 72 72 61 79 2C 00 03 2C 00 05 2C 00 00 2C 03 2C 00 0A 03 77",
        "06 76 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 03 75",
    ),
    // ResetAlm 5, Start main, Pause, Continue, Stop.
    ("02 5A 05 03 5C", "06 5A 03 59"),
    ("02 47 00 03 44", "06 47 03 44"),
    ("02 47 00 03 44", "15 47 32 30 03 46"),
    ("02 50 03 53", "06 50 03 53"),
    ("02 43 03 40", "06 43 03 40"),
    ("02 6C 03 6F", "15 6C 32 30 03 6D"),
    ("02 51 03 52", "06 51 03 52"),
    ("02 52 03 51", "06 52 03 51"),
    ("02 41 03 42", "06 41 03 42"),
    // Logout, and again GetStatus.
    ("02 6C 03 6F", "06 6C 03 6F"),
    ("02 53 03 50", "15 53 31 31 03 50"),
];

#[tokio::test]
async fn every_worked_request_over_tcp() {
    let server = start(&cell(CellClock::manual()), options()).await;
    let mut client = Client::frames(&server).await;
    assert_eq!(client.exchange("02 4C 03 4F").await, "15 4C 31 31 03 4F", "Login before the function is opened");
    client.send(&[4]).await;
    for (request, answer) in EXCHANGES {
        assert_eq!(client.exchange(request).await, *answer, "{request}");
    }
}

#[tokio::test]
async fn execute_prints_in_quotes_and_alarms_are_counted() {
    let cell = cell(CellClock::manual());
    let server = start(&cell, options()).await;
    let mut client = Client::frames(&server).await;
    client.send(&[4]).await;
    client.exchange("02 4C 03 4F").await;
    let ask = |text: &str| framed('X', format!("\"{text}\"").as_bytes());
    client.send(&ask("print 6 * 7")).await;
    assert_eq!(client.read().await, {
        let mut answer = framed('X', b"\"42\"");
        answer[0] = 6;
        answer
    });
    client.send(&ask("On 9")).await;
    assert_eq!(shown(&client.read().await), "06 58 03 5B");
    // The manual's own Execute.
    client.send(&bytes("02 58 22 70 72 69 6E 74 20 68 65 72 65 22 03 10")).await;
    let here = client.read().await;
    assert!(here.starts_with(b"\x06X\" X:") && here[here.len() - 3..here.len() - 1] == *b"\"\x03", "{here:?}");
    cell.command(CellCommand::WearOut(1)).unwrap();
    cell.command(CellCommand::WearOut(5)).unwrap();
    assert_eq!(client.exchange("02 7A 03 79").await, "06 7A 02 01 05 03 7F");
    // EOT begins anew.
    client.send(&[4]).await;
    assert_eq!(client.exchange("02 7A 03 79").await, "15 7A 31 31 03 79");
}

#[tokio::test]
async fn a_damaged_frame_is_refused_and_the_next_one_is_read() {
    let server = start(&cell(CellClock::manual()), options()).await;
    let mut client = Client::frames(&server).await;
    client.send(&[4]).await;
    client.exchange("02 4C 03 4F").await;
    assert_eq!(client.exchange("02 53 03 51").await, "15 53 31 36 03 57", "a wrong checksum");
    assert_eq!(client.exchange("02 47 40 03 04").await, "15 47 31 32 03 47", "function 64");
    assert_eq!(client.exchange("02 71 03 72").await, "15 71 31 31 03 72", "no such command");
    // Cut off: refused after a silence.
    assert_eq!(client.exchange("02 69 00").await, "15 69 31 39 03 62");
    assert_eq!(client.exchange("FF 00 02 79 03 7A").await, "06 79 01 03 7B", "noise of the line is skipped");
}

/// The same over a pseudo-terminal, with a client that opens it as a file.
#[cfg(unix)]
#[tokio::test]
async fn frames_over_a_pseudo_terminal() {
    use std::fs::OpenOptions;
    use std::io::{Read as _, Write as _};

    let cell = cell(CellClock::manual());
    let options = RemoteOptions {
        serial: Some(crate::virtual_controller::remote::SerialChoice::PseudoTerminal),
        password: Password::new("secret").unwrap(),
        login_window: WAIT_LIMIT,
        ..RemoteOptions::default()
    };
    let server = start(&cell, options).await;
    assert_eq!((server.text_address(), server.frames_address()), (None, None));
    let path = server.serial_path().unwrap().to_owned();
    let client = tokio::task::spawn_blocking(move || {
        // A client may go and another one come.
        for _ in 0..2 {
            let mut line = OpenOptions::new().read(true).write(true).open(&path).unwrap();
            let mut exchange = |request: &[u8], length: usize| {
                line.write_all(request).unwrap();
                let mut answer = vec![0; length];
                line.read_exact(&mut answer).unwrap();
                shown(&answer)
            };
            exchange(&[2, 0x53, 3], 0);
            assert_eq!(exchange(&[0x50], 6), "15 53 31 31 03 50");
            let mut login = framed('L', b"wrong");
            login.insert(0, 4);
            assert_eq!(exchange(&login, 6), "15 4C 31 33 03 4D");
            assert_eq!(exchange(&framed('L', b"secret"), 4), "06 4C 03 4F");
            assert_eq!(exchange(&framed('O', &[0, 3, 1]), 4), "06 4F 03 4C");
            assert_eq!(exchange(&framed('o', &[0, 3]), 5), "06 6F 01 03 6D");
            assert_eq!(exchange(&framed('T', &[3, 4]), 4), "06 54 03 57");
            assert_eq!(exchange(&framed('t', &[3]), 5), "06 74 04 03 73");
            assert_eq!(exchange(&framed('l', &[]), 4), "06 6C 03 6F");
        }
    });
    tokio::time::timeout(WAIT_LIMIT, client).await.unwrap().unwrap();
    assert!(cell.snapshot().controller.flags.contains(StatusFlag::Ready));
    server.stop().await;
}

#[cfg(unix)]
#[tokio::test]
async fn a_device_that_is_not_there_is_named() {
    use crate::virtual_controller::remote::{RemoteServerError, SerialChoice};
    let device = SerialChoice::Device { path: "/dev/no-such-line".into(), baud: 9600 };
    let options = RemoteOptions { serial: Some(device), ..RemoteOptions::default() };
    let failed = RemoteServer::start(LOOPBACK, options, cell(CellClock::manual())).await.unwrap_err();
    assert!(matches!(&failed, RemoteServerError::Serial { name, .. } if name == "/dev/no-such-line"), "{failed}");
}
