//! What an engineer is told of each error about a PLC.

use super::address::AddressError;
use super::bridge::map::MapError;
use super::bridge::robot::{ReadError, ValuesNotWritten};
use super::client::{ClientError, WriteError};
use super::data_type::ValueError;
use super::plc::PlcError;
use crate::model::{ErrorCode, Problem, with_sources};

impl ClientError {
    const fn code(&self) -> ErrorCode {
        match self {
            Self::Unreachable { .. } | Self::ConnectTimeout { .. } | Self::NotConnected => ErrorCode::PlcUnreachable,
            Self::Refused(_) | Self::OtherNode { .. } => ErrorCode::PlcConnectionRefused,
            Self::Lost(_) => ErrorCode::PlcConnectionLost,
            Self::NoAnswer { .. } => ErrorCode::PlcNoAnswer,
            Self::Frame(_) | Self::UnexpectedFrame | Self::Header(_) | Self::Response(_) => ErrorCode::NotFins,
            Self::EndCode { .. } => ErrorCode::PlcCommandRefused,
            Self::Waiting { cause, .. } => cause.code(),
            Self::NodeUnknown(_) | Self::Address(_) | Self::OtherKind(_) => ErrorCode::BadPlcAddress,
        }
    }
}

impl WriteError {
    const fn code(&self) -> ErrorCode {
        match self {
            Self::NotDone { source, .. } => source.code(),
            Self::Unknown { .. } => ErrorCode::PlcWriteUnknown,
        }
    }
}

macro_rules! problems {
    ($($error:ident: $code:expr;)*) => {$(
        impl From<$error> for Problem {
            fn from(error: $error) -> Self {
                let code: fn(&$error) -> ErrorCode = $code;
                Self::with_detail(code(&error), with_sources(&error))
            }
        }
    )*};
}

problems! {
    ClientError: ClientError::code;
    WriteError: WriteError::code;
    AddressError: |_| ErrorCode::BadPlcAddress;
    ValueError: |_| ErrorCode::BadPlcValue;
    ReadError: |error| match error {
        ReadError::Client(error) => error.code(),
        ReadError::Value(_) => ErrorCode::BadPlcValue,
    };
    ValuesNotWritten: |error| match error {
        ValuesNotWritten::Value(_) => ErrorCode::BadPlcValue,
        ValuesNotWritten::Write(error) => error.code(),
    };
    MapError: |error| match error {
        MapError::Host { .. } => ErrorCode::BadAddress,
        _ => ErrorCode::BadBridgeMap,
    };
    PlcError: |_| ErrorCode::PlcCannotListen;
}
