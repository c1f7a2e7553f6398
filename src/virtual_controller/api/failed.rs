//! The answer to a request that fails: the only place where an error of the virtual controller becomes a [`Problem`].

use std::fmt;
use std::io;

use axum::Json;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};

use super::request_error::RequestError;
use crate::model::{ErrorCode, Problem, with_sources};
use crate::protocol::{self, FailureBody};
use crate::virtual_controller::change_error::{
    ActivationError, CertificateChangeError, SettingsChangeError, TransferError, TrustError, UserChangeError,
};
use crate::virtual_controller::controller::{ControllerError, ServerStartError};
use crate::virtual_controller::faults::FaultRefusal;
use crate::virtual_controller::login::LoginError;
use crate::virtual_controller::opcua::StartError;
use crate::virtual_controller::request_heads::RejectedHead;
use crate::virtual_controller::state::{PortTaken, StartRefusal, StateError};
use crate::virtual_controller::store::StoreError;

/// A failed request. The status is [`protocol::status_of`] the code unless it is about the path or the head.
pub(super) struct FailedRequest {
    status: StatusCode,
    problem: Problem,
}

impl FailedRequest {
    fn new(problem: Problem) -> Self {
        let status = StatusCode::from_u16(protocol::status_of(problem.code));
        Self { status: status.unwrap_or(StatusCode::INTERNAL_SERVER_ERROR), problem }
    }
}

impl IntoResponse for FailedRequest {
    fn into_response(self) -> Response {
        (self.status, Json(FailureBody::from(self.problem))).into_response()
    }
}

/// The answer to a request whose head was refused.
pub fn rejected(head: RejectedHead) -> Response {
    FailedRequest::from(RequestError::Head(head)).into_response()
}

impl From<ControllerError> for FailedRequest {
    fn from(error: ControllerError) -> Self {
        Self::new(of_controller(&error))
    }
}

impl From<TrustError> for FailedRequest {
    fn from(error: TrustError) -> Self {
        Self::new(of_trust(&error))
    }
}

impl From<LoginError> for FailedRequest {
    fn from(error: LoginError) -> Self {
        Self::new(match &error {
            LoginError::LockedOut => ErrorCode::LockedOut.into(),
            LoginError::WrongPassword => ErrorCode::WrongPassword.into(),
            LoginError::Random(_) => told(ErrorCode::Internal, &error),
        })
    }
}

impl From<RequestError> for FailedRequest {
    fn from(error: RequestError) -> Self {
        let problem = match &error {
            RequestError::NoSession => ErrorCode::SessionExpired.into(),
            RequestError::TooLarge | RequestError::Head(RejectedHead::TooLong | RejectedHead::TargetTooLong) => {
                ErrorCode::RequestTooLarge.into()
            }
            RequestError::UnknownPath
            | RequestError::UnknownMethod
            | RequestError::Query
            | RequestError::Head(RejectedHead::OtherVersion | RejectedHead::Malformed(_))
            | RequestError::Late
            | RequestError::BrokenOff(_) => told(ErrorCode::Refused, &error),
            RequestError::Malformed { code, .. } => told(*code, &error),
            RequestError::NoConnection | RequestError::Worker(_) => told(ErrorCode::Internal, &error),
        };
        let status = error.status();
        let failed = Self::new(problem);
        Self { status: status.unwrap_or(failed.status), ..failed }
    }
}

fn of_controller(error: &ControllerError) -> Problem {
    use ControllerError as E;
    match error {
        E::SwitchedOff => told(ErrorCode::Refused, error),
        E::Fault(FaultRefusal::TaskRunning) => ErrorCode::TaskRunning.into(),
        E::Fault(FaultRefusal::TeachPendantConnected) => ErrorCode::TeachPendantConnected.into(),
        E::Fault(FaultRefusal::Refused) => ErrorCode::Refused.into(),
        E::ChangedMeanwhile { .. } => told(ErrorCode::ChangedMeanwhile, error),
        E::Settings(error) => of_settings(error),
        E::User(error) => of_user(error),
        E::Activation(error) => of_activation(error),
        E::Certificate(error) => of_certificate(error),
        E::Transfer(error) => of_transfer(error),
        E::Trust(error) => of_trust(error),
        E::State(StateError::Firmware(error)) => told(ErrorCode::FirmwareNotSupported, error),
        E::State(StateError::Broken(_)) => told(ErrorCode::Internal, error),
        E::TrustLists(error) => error.clone().into(),
        E::Store(error) => of_store(error),
        E::Start(error) => of_start(error),
        E::Log(error) => told(ErrorCode::Internal, error),
        E::Worker(error) => told(ErrorCode::Internal, error),
    }
}

fn of_start(error: &ServerStartError) -> Problem {
    use ServerStartError as E;
    match error {
        E::Refused(StartRefusal::NotActivated | StartRefusal::NoCertificate) | E::LogFull => error.code().into(),
        E::Refused(StartRefusal::Port(port)) => of_port(port),
        E::Refused(StartRefusal::Settings(_) | StartRefusal::Certificate(_) | StartRefusal::KeyLength(_))
        | E::FaultSwitch
        | E::Worker(_) => told(error.code(), error),
        E::TrustLists(error) => error.clone().into(),
        E::Server(StartError::PortInUse(port)) => detailed(error.code(), port),
        E::Server(StartError::InvalidParameter(reason)) => told(error.code(), reason),
        E::Server(StartError::Failed(cause)) => told(error.code(), cause),
    }
}

fn of_store(error: &StoreError) -> Problem {
    match error {
        StoreError::Io { source, .. }
            if matches!(source.kind(), io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded) =>
        {
            ErrorCode::DiskFull.into()
        }
        StoreError::Io { .. } | StoreError::Damaged { .. } | StoreError::TooNew { .. } => {
            told(ErrorCode::Internal, error)
        }
    }
}

fn of_settings(error: &SettingsChangeError) -> Problem {
    match error {
        SettingsChangeError::Settings(error) => told(ErrorCode::BadSettings, error),
        SettingsChangeError::Port(port) => of_port(port),
        SettingsChangeError::LogPassword => ErrorCode::LogPassword.into(),
    }
}

fn of_port(PortTaken(port): &PortTaken) -> Problem {
    detailed(ErrorCode::PortConflict, port)
}

fn of_user(error: &UserChangeError) -> Problem {
    match error {
        UserChangeError::Credential(error) => told(ErrorCode::BadCredential, error),
        UserChangeError::Exists(name) => detailed(ErrorCode::UserExists, name),
        UserChangeError::TooMany => ErrorCode::TooManyUsers.into(),
        UserChangeError::NotFound(name) => detailed(ErrorCode::UserNotFound, name),
        UserChangeError::Hash(error) => told(ErrorCode::Internal, error),
    }
}

fn of_activation(error: &ActivationError) -> Problem {
    match error {
        ActivationError::FirmwareTooNew => ErrorCode::FirmwareTooNew.into(),
        ActivationError::WrongKeys(serial) => detailed(ErrorCode::WrongKeys, serial),
    }
}

fn of_certificate(error: &CertificateChangeError) -> Problem {
    use CertificateChangeError as E;
    match error {
        E::FirmwareTooOld => ErrorCode::FirmwareTooOld.into(),
        E::FirmwareTooNew => ErrorCode::FirmwareTooNew.into(),
        E::Request(error) => told(ErrorCode::BadCertificateRequest, error),
        E::Pki(error) => error.clone().into(),
        E::KeyOfCsr => told(ErrorCode::Refused, error),
        E::NotSelfSigned => told(ErrorCode::BadCertificate, error),
        E::NoCsr => ErrorCode::NoCsr.into(),
        E::CsrMismatch => ErrorCode::CsrMismatch.into(),
        E::NotStored(kind) => detailed(ErrorCode::CertificateNotStored, kind.as_str()),
    }
}

fn of_transfer(error: &TransferError) -> Problem {
    match error {
        TransferError::FirmwareTooNew => ErrorCode::FirmwareTooNew.into(),
        TransferError::NoPassphrase => ErrorCode::BadPassphrase.into(),
        TransferError::Export(error) => error.clone().into(),
        TransferError::Settings(error) => of_settings(error),
        TransferError::User(error) => of_user(error),
        TransferError::CostlyHash => told(ErrorCode::BadCredential, error),
        TransferError::Activation(error) => of_activation(error),
    }
}

fn of_trust(error: &TrustError) -> Problem {
    use TrustError as E;
    match error {
        E::FirmwareTooOld => ErrorCode::FirmwareTooOld.into(),
        E::StepCount | E::SameList | E::FilledByController => told(ErrorCode::Refused, error),
        E::FileName => detailed(ErrorCode::BadName, "file name"),
        E::NoCertificate | E::Certificate { .. } => told(ErrorCode::BadCertificate, error),
        E::ListFull { .. } => told(ErrorCode::ListFull, error),
        E::Duplicate { file_name } => detailed(ErrorCode::DuplicateCertificate, file_name),
        E::NoCertificateNamed | E::NoCrlNamed => told(ErrorCode::NotInList, error),
        E::NotInList(name) => detailed(ErrorCode::NotInList, name),
        E::NoCrl | E::CrlTooLarge { .. } | E::Crl { .. } | E::CrlUnusable { .. } | E::CrlSignature { .. } => {
            told(ErrorCode::BadCrl, error)
        }
        E::DuplicateCrl { file_name } => detailed(ErrorCode::DuplicateCrl, file_name),
        E::CrlOutdated { .. } => told(ErrorCode::CrlOutdated, error),
        E::TooManyCrls { .. } | E::TooManyCrlBytes { .. } => told(ErrorCode::TooManyCrls, error),
    }
}

/// The detail is the text of the error and those of its sources.
fn told(code: ErrorCode, error: &(dyn std::error::Error + 'static)) -> Problem {
    Problem::with_detail(code, with_sources(error))
}

/// The detail is a value that the text of the code is about.
fn detailed(code: ErrorCode, value: impl fmt::Display) -> Problem {
    Problem::with_detail(code, value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ControllerSeries, FirmwareVersion};
    use crate::pki::{Certificate, PkiError};

    #[test]
    fn a_code_says_what_is_wrong_and_the_detail_what_caused_it() {
        let old = ControllerSeries::TVt.check_firmware(FirmwareVersion::new(7, 5, 53)).unwrap_err();
        let problem = of_controller(&ControllerError::State(StateError::Firmware(old)));
        assert_eq!(problem, Problem::with_detail(ErrorCode::FirmwareNotSupported, "T/VT 7.5.53 < 7.5.54"));

        let port = SettingsChangeError::Port(PortTaken(5000));
        assert_eq!(of_controller(&port.into()), Problem::with_detail(ErrorCode::PortConflict, "5000"));

        let source = io::Error::from(io::ErrorKind::StorageFull);
        let full = StoreError::Io { path: "controller.state".into(), source };
        assert_eq!(of_controller(&full.into()), ErrorCode::DiskFull.into());
    }

    #[test]
    fn a_file_that_is_no_certificate_is_named_with_what_the_reader_says() {
        let source = Certificate::from_der(&[0x30, 0]).unwrap_err();
        let because = with_sources(&source);
        assert!(because.len() > PkiError::to_string(&source).len(), "{because}");
        let error = TrustError::Certificate { file_name: "a.der".to_owned(), source };
        let expected = Problem::with_detail(ErrorCode::BadCertificate, format!("a.der: {because}"));
        assert_eq!(of_trust(&error), expected);
    }

    #[test]
    fn the_status_of_a_request_that_is_not_understood_is_its_own() {
        for (error, status, code) in [
            (RequestError::UnknownPath, 404, ErrorCode::Refused),
            (RequestError::UnknownMethod, 405, ErrorCode::Refused),
            (RequestError::Head(RejectedHead::TooLong), 431, ErrorCode::RequestTooLarge),
            (RequestError::TooLarge, 413, ErrorCode::RequestTooLarge),
            (RequestError::NoSession, 401, ErrorCode::SessionExpired),
            (RequestError::Late, 400, ErrorCode::Refused),
        ] {
            let failed = FailedRequest::from(error);
            assert_eq!((failed.status.as_u16(), failed.problem.code), (status, code));
        }
    }
}
