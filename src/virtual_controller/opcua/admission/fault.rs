use opcua::types::StatusCode;

/// The error message that a refused peer gets: status and reason.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in super::super) struct Fault {
    pub(super) status: StatusCode,
    /// English, without anything the peer should not know.
    pub(super) reason: String,
}

impl Fault {
    pub(super) fn new(status: StatusCode, reason: impl Into<String>) -> Self {
        Self { status, reason: reason.into() }
    }

    /// A mistake of this program.
    pub(super) fn internal() -> Self {
        Self::new(StatusCode::BadInternalError, "internal error")
    }

    /// As the Error message that ends a connection (OPC 10000-6 §7.1.2.5).
    pub(super) fn to_message(&self) -> Vec<u8> {
        let reason: String = self.reason.chars().take(MAX_REASON_CHARS).collect();
        // At most four bytes a character.
        let length = reason.len() as u32;
        let mut message = b"ERRF".to_vec();
        message.extend((16 + length).to_le_bytes());
        message.extend(self.status.bits().to_le_bytes());
        message.extend(length.to_le_bytes());
        message.extend(reason.as_bytes());
        message
    }
}

const MAX_REASON_CHARS: usize = 200;

#[cfg(test)]
mod tests {
    use opcua::core::comms::tcp_types::ErrorMessage;
    use opcua::types::{DecodingOptions, SimpleBinaryDecodable as _};

    use super::*;

    #[test]
    fn the_client_library_reads_the_error_message() {
        let fault = Fault::new(StatusCode::BadSecurityChecksFailed, "ü".repeat(300));
        let message = fault.to_message();
        assert_eq!(message.len(), u32::from_le_bytes(message[4..8].try_into().unwrap()) as usize);
        let read = ErrorMessage::decode(&mut message.as_slice(), &DecodingOptions::default()).unwrap();
        assert_eq!(read.error, StatusCode::BadSecurityChecksFailed);
        assert_eq!(read.reason.as_ref(), "ü".repeat(200));
    }
}
