use tokio::time::Instant;

use super::*;
use crate::virtual_controller::remote::conversation::Conversation;
use crate::virtual_controller::remote::request_handler::RequestHandler;
use crate::virtual_controller::remote::wire::Wire;

fn conversation(options: RemoteOptions, now: Instant) -> Conversation {
    let handler = RequestHandler::new(cell(CellClock::manual()), options.into());
    let wire = Wire::text(handler.options());
    Conversation::new(handler, wire, false, now)
}

const MINUTE: Duration = Duration::from_secs(60);

/// The times of a controller, without waiting for them.
#[test]
fn a_login_takes_five_minutes_at_most_and_a_session_lives_by_its_commands() {
    let start = Instant::now();
    let mut late = conversation(RemoteOptions::default(), start);
    assert_eq!(late.wakes_at(), Some(start + 5 * MINUTE));
    // Nothing but a login counts.
    late.receive(b"$GetStatus\r\n", start + 4 * MINUTE);
    assert_eq!(late.wakes_at(), Some(start + 5 * MINUTE));
    assert!(late.wake(start + 5 * MINUTE).is_empty() && late.is_over());

    let mut session = conversation(RemoteOptions::default(), start);
    session.receive(b"$Login,\r\n", start + 4 * MINUTE);
    assert_eq!(session.wakes_at(), Some(start + 5 * MINUTE));
    let mut now = start + 4 * MINUTE;
    for _ in 0..10 {
        now += MINUTE - Duration::from_secs(1);
        assert!(session.wake(now).is_empty() && !session.is_over());
        assert_eq!(session.receive(b"$GetStatus\r\n", now).len(), 1);
    }
    // A request that has only begun does not count, and is refused.
    session.receive(b"$GetSta", now + Duration::from_secs(30));
    let refused = session.wake(now + MINUTE);
    assert_eq!(*session.encode(&refused[0]), b"!,19\r\n");
    assert!(refused.len() == 1 && session.is_over());

    let endless = RemoteOptions { time_out: Duration::ZERO, ..RemoteOptions::default() };
    let mut endless = conversation(endless, start);
    endless.receive(b"$Login,\r\n", start);
    assert_eq!(endless.wakes_at(), None);
    // After Logout the login window begins.
    endless.receive(b"$Logout\r\n", start + MINUTE);
    assert_eq!(endless.wakes_at(), Some(start + 6 * MINUTE));
}

#[tokio::test]
async fn a_client_that_does_not_log_in_makes_room_for_the_next_one() {
    let server =
        start(&cell(CellClock::manual()), RemoteOptions { login_window: Duration::from_millis(50), ..options() }).await;
    let mut silent = Client::text(&server).await;
    assert!(silent.is_closed().await);
    let mut unopened = Client::frames(&server).await;
    assert!(unopened.is_closed().await);
    Client::logged_in(&server).await;
}

#[tokio::test]
async fn a_session_without_commands_ends() {
    let server =
        start(&cell(CellClock::manual()), RemoteOptions { time_out: Duration::from_millis(50), ..options() }).await;
    let mut idle = Client::logged_in(&server).await;
    assert!(idle.is_closed().await);
    let mut stopped = Client::logged_in(&server).await;
    stopped.send(b"$GetSta").await;
    assert_eq!(stopped.read().await, b"!,19\r\n");
    assert!(stopped.is_closed().await);
}

#[tokio::test]
async fn a_second_client_is_disconnected_until_the_first_one_leaves() {
    let server = start(&cell(CellClock::manual()), options()).await;
    let mut first = Client::logged_in(&server).await;
    assert!(Client::text(&server).await.is_closed().await);
    // The other port has a client of its own.
    let mut frames = Client::frames(&server).await;
    frames.send(&[4]).await;
    assert_eq!(frames.exchange("02 4C 03 4F").await, "06 4C 03 4F");
    assert_eq!(first.ask("$GetCurRobot").await, "#GetCurRobot,1\r\n");
    drop(first);
    let next = async {
        loop {
            let mut next = Client::text(&server).await;
            next.send(b"$Login,\r\n").await;
            if next.read().await == b"#Login,0\r\n" {
                return;
            }
        }
    };
    timeout(WAIT_LIMIT, next).await.unwrap();
}

#[tokio::test]
async fn a_flood_without_an_end_is_answered_and_cut_off() {
    let server = start(&cell(CellClock::manual()), options()).await;
    let mut client = Client::logged_in(&server).await;
    let flood = vec![b'x'; 1 << 20];
    // The server stops reading before all of it was sent.
    let _cut = timeout(WAIT_LIMIT, client.0.write_all(&flood)).await.unwrap();
    let answer = client.read().await;
    assert!(answer == b"!,12\r\n" || answer.is_empty(), "{answer:?}");

    // A line that is too long, with an end, is refused, and the next one is read.
    let mut client = timeout(WAIT_LIMIT, async {
        loop {
            let mut next = Client::text(&server).await;
            next.send(b"$Login,\r\n").await;
            if next.read().await == b"#Login,0\r\n" {
                return next;
            }
        }
    })
    .await
    .unwrap();
    assert_eq!(client.ask(&"x".repeat(5000)).await, "!,12\r\n");
    assert_eq!(client.ask("$GetCurRobot").await, "#GetCurRobot,1\r\n");
}

#[tokio::test]
async fn after_ten_wrong_passwords_the_client_is_disconnected() {
    let options = RemoteOptions { password: Password::new("right").unwrap(), ..options() };
    let server = start(&cell(CellClock::manual()), options).await;
    let mut client = Client::text(&server).await;
    for _ in 0..10 {
        assert_eq!(client.ask("$Login,wrong").await, "!Login,13\r\n");
    }
    assert!(client.is_closed().await);
}

#[tokio::test]
async fn what_execute_moves_stops_when_its_client_is_gone() {
    let cell = cell(fast());
    let server = start(&cell, options()).await;
    let mut client = Client::logged_in(&server).await;
    client.ask("$Stop").await;
    client.ask("$SetMotorsOn,1").await;
    client.send(b"$Execute,\"SpeedFactor 1;Speed 1;Go P4\"\r\n").await;
    assert_eq!(client.ask("$GetAlm").await, "!GetAlm,21\r\n");
    drop(client);
    let ended = async {
        while cell.is_executing() {
            tokio::task::yield_now().await;
        }
    };
    timeout(WAIT_LIMIT, ended).await.unwrap();
    assert_eq!(cell.command(CellCommand::Abort), Ok(()));
}

#[tokio::test]
async fn a_port_in_use_is_named_and_a_stopped_server_gives_it_back() {
    let cell = cell(CellClock::manual());
    let server = start(&cell, options()).await;
    let address = server.text_address().unwrap();
    let same = RemoteOptions { text_port: Some(address.port()), ..RemoteOptions::default() };
    let failed = RemoteServer::start(LOOPBACK, same.clone(), cell.clone()).await.unwrap_err();
    assert!(failed.to_string().contains(&address.to_string()), "{failed}");
    server.stop().await;
    RemoteServer::start(LOOPBACK, same, cell).await.unwrap();
}
