//! FINS/UDP: a datagram is a message.

use std::sync::Arc;

use tokio::net::UdpSocket;
use tokio::time::sleep;
use tokio_util::sync::CancellationToken;

use super::super::codec::MAX_MESSAGE_BYTES;
use super::{Delivery, Shared};

/// Answers datagrams one after the other, as one unit of a PLC does.
pub(super) async fn serve(socket: UdpSocket, shared: Arc<Shared>, stop: CancellationToken) {
    let mut buffer = vec![0; MAX_MESSAGE_BYTES + 1];
    loop {
        let received = tokio::select! {
            received = socket.recv_from(&mut buffer) => received,
            () = stop.cancelled() => return,
        };
        // An error is about an earlier answer that could not be delivered.
        let Ok((length, from)) = received else { continue };
        if length > MAX_MESSAGE_BYTES {
            continue;
        }
        let (delivery, faults) = shared.answer(&buffer[..length]);
        let answer = match delivery {
            Delivery::Nothing => continue,
            Delivery::Whole(answer) => answer,
            Delivery::Cut(mut answer, bytes) => {
                answer.truncate(bytes);
                answer
            }
        };
        if let Some(delay) = faults.delay {
            tokio::select! {
                () = sleep(delay) => {}
                () = stop.cancelled() => return,
            }
        }
        let _undelivered = socket.send_to(&answer, from).await;
    }
}
