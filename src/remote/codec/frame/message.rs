use zeroize::Zeroizing;

use crate::remote::codec::decode_error::{DecodeError, EncodeError, Fault};

/// Opens the remote function of the controller: EOT.
pub const OPEN: u8 = 0x04;
/// Begins a request.
pub(super) const STX: u8 = 0x02;
/// Ends the data.
pub(super) const ETX: u8 = 0x03;
/// Begins a good answer.
pub(super) const ACK: u8 = 0x06;
/// Begins a refusal.
pub(super) const NAK: u8 = 0x15;

/// Bytes before the data: the first one and the letter.
pub(super) const HEAD: usize = 2;
/// Bytes behind the data: ETX and BCC.
pub(super) const TAIL: usize = 2;

/// The longest request: a command of Execute in quotes; a String with its name is shorter.
pub(super) const MAX_REQUEST: usize = HEAD + 512 + TAIL;
/// The longest answer: a result of Execute in quotes.
pub(super) const MAX_ANSWER: usize = HEAD + 4096 + TAIL;

/// A message. The buffer never grows, so that no copy of a password is left behind.
pub(super) fn message(
    first: u8,
    letter: u8,
    most: usize,
    put_data: impl FnOnce(&mut Vec<u8>) -> Result<(), EncodeError>,
) -> Result<Zeroizing<Vec<u8>>, EncodeError> {
    let mut bytes = Zeroizing::new(Vec::with_capacity(2 * most));
    bytes.extend([first, letter]);
    put_data(&mut bytes)?;
    if bytes.len() + TAIL > most {
        return Err(EncodeError::TooLong);
    }
    bytes.push(ETX);
    let checksum = checksum(&bytes[1..]);
    bytes.push(checksum);
    Ok(bytes)
}

/// BCC: the exclusive or of the bytes.
pub(super) fn checksum(bytes: &[u8]) -> u8 {
    bytes.iter().fold(0, |sum, byte| sum ^ byte)
}

/// Checks ETX and BCC of a message with so many bytes of data; all of it has come.
pub(super) fn check(message: &[u8], data: usize) -> Result<(), DecodeError> {
    let etx = HEAD + data;
    if message[etx] != ETX {
        return Err(DecodeError::new(Fault::Malformed, "ETX", etx));
    }
    let (expected, found) = (checksum(&message[1..=etx]), message[etx + 1]);
    if expected != found {
        return Err(DecodeError::new(Fault::Checksum { expected, found }, "BCC", etx + 1));
    }
    Ok(())
}

/// Every place where the message may end, if its data has no fixed length: how long the data is, up to an ETX that is
/// followed by a BCC; and whether the BCC is right.
pub(super) fn ends(message: &[u8]) -> impl Iterator<Item = (usize, bool)> {
    let mut sum = message.get(1).copied().unwrap_or_default();
    let pairs = message.windows(2).enumerate().skip(HEAD);
    pairs.filter_map(move |(at, pair)| {
        sum ^= pair[0];
        (pair[0] == ETX).then(|| (at - HEAD, sum == pair[1]))
    })
}
