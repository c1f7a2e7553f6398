use opcua_configurator::fins::address::{Address, AddressRange};
use opcua_configurator::fins::bridge::map::BridgeMap;
use opcua_configurator::fins::codec::command::Command;
use opcua_configurator::fins::codec::cpu::{ControllerData, CpuStatus, decode_clock};
use opcua_configurator::fins::codec::frame::{FrameDecoder, MAX_FRAME_BYTES, TcpFrame};
use opcua_configurator::fins::codec::header::Header;
use opcua_configurator::fins::codec::response::Response;
use opcua_configurator::fins::data_type::{DataType, WordOrder};

/// A stream of FINS/TCP frames: what is read is the same however it arrives, and messages are read back as written.
pub fn fins_stream(bytes: &[u8]) {
    let whole = frames(bytes, bytes.len().max(1));
    assert_eq!(whole, frames(bytes, 1));
    assert_eq!(whole, frames(bytes, 7));
    for frame in whole {
        let encoded = frame.encode();
        assert!(encoded.len() <= MAX_FRAME_BYTES);
        assert_eq!(frames(&encoded, encoded.len()), std::slice::from_ref(&frame));
        if let TcpFrame::Message(message) = frame {
            fins_message(&message);
        }
    }
}

fn frames(bytes: &[u8], piece: usize) -> Vec<TcpFrame> {
    let (mut decoder, mut found) = (FrameDecoder::default(), Vec::new());
    for part in bytes.chunks(piece) {
        decoder.feed(part);
        loop {
            match decoder.next_frame() {
                Ok(Some(frame)) => found.push(frame),
                Ok(None) => break,
                Err(_) => return found,
            }
        }
    }
    found
}

/// One FINS message, as command and as response.
pub fn fins_message(bytes: &[u8]) {
    let Ok((header, rest)) = Header::decode(bytes) else { return };
    assert_eq!(Header::decode(&header.encode()).map(|(header, _)| header), Ok(header));
    if let Ok(command) = Command::decode(rest) {
        let mut encoded = Vec::new();
        command.encode_into(&mut encoded);
        assert_eq!(encoded, rest);
    }
    if let Ok(response) = Response::decode(rest) {
        let mut encoded = Vec::new();
        response.encode_into(&mut encoded);
        assert_eq!(encoded, rest);
        let words = response.data.len() / 2;
        if let Ok(words) = response.words(words as u16) {
            for data_type in [DataType::U32, DataType::F32, DataType::Bcd32, DataType::Text] {
                let _ = data_type.decode(&words, WordOrder::LowFirst);
            }
        }
        if let Ok(data) = ControllerData::decode(&response) {
            super::assert_printable(&data.model);
            super::assert_printable(&data.version);
        }
        if let Ok(status) = CpuStatus::decode(&response) {
            super::assert_printable(&status.error_message);
        }
        let _ = decode_clock(&response);
    }
}

/// An address, a range or the map of a bridge.
pub fn fins_text(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    if let Ok(address) = text.parse::<Address>() {
        assert_eq!(address.to_string().parse(), Ok(address));
        assert_eq!(address.to_wire().address(), Ok(address));
    }
    if let Ok(range) = text.parse::<AddressRange>() {
        assert_eq!(range.to_string().parse(), Ok(range));
    }
    let _ = BridgeMap::parse(text);
}
