//! What the controller does for each request in a session.

use std::sync::Arc;

use super::body::MalformedBody;
use super::caller::Caller;
use super::failed::FailedRequest;
use super::request_error::RequestError;
use super::routes::Routes;
use crate::model::activation::ActivationKeys;
use crate::model::{Base64Bytes, Changed, ClientList, ErrorCode, ListedCertificate, LogChunk, Revisioned};
use crate::protocol::{
    Activate, AddUser, CertificateInstalled, CsrMade, EditTrust, ExportSettings, GetCertificates, GetCrl, GetCrls,
    GetInfo, GetIssuers, GetLog, GetRejected, GetSettings, GetTrustStamp, GetTrusted, GetUsers, ImportCaSigned,
    ImportCertificate, ImportCsr, ImportSettings, MakeCsr, MakeSelfSigned, RemoveUsers, SelectCertificate, SetSettings,
    StartServer, StopServer,
};
use crate::virtual_controller::controller::Effect;
use crate::virtual_controller::state::{ControllerState, OperatingContext};
use crate::virtual_controller::{certificate_changes, changes, settings_transfer};

/// Registers every request that needs a session, but for logging out.
pub(super) fn register(routes: Routes) -> Routes {
    routes
        .plain::<GetInfo, _, _>(async |caller: Arc<Caller>| Ok(caller.controller().info(Some(caller.local_address()))))
        .plain::<StartServer, _, _>(async |caller: Arc<Caller>| {
            caller.settle(caller.controller().start_server().await).await
        })
        .plain::<StopServer, _, _>(async |caller: Arc<Caller>| {
            caller.settle(caller.controller().stop_server().await).await
        })
        .with_query::<GetLog, _, _>(get_log)
        .plain::<GetSettings, _, _>(async |caller: Arc<Caller>| Ok(caller.controller().settings()))
        .with_body::<SetSettings, _, _>(MalformedBody::plain(ErrorCode::BadSettings), set_settings)
        .with_body::<ExportSettings, _, _>(
            MalformedBody::secret(ErrorCode::Refused),
            async |caller: Arc<Caller>, ExportSettings { passphrase }| {
                Ok(caller.controller().export(passphrase).await?)
            },
        )
        .with_body::<ImportSettings, _, _>(MalformedBody::secret(ErrorCode::ExportDamaged), import_settings)
        .with_body::<Activate, _, _>(MalformedBody::secret(ErrorCode::BadActivationKey), activate)
        .plain::<GetUsers, _, _>(async |caller: Arc<Caller>| Ok(caller.controller().users()))
        .with_body::<AddUser, _, _>(MalformedBody::secret(ErrorCode::BadCredential), add_user)
        .with_body::<RemoveUsers, _, _>(MalformedBody::plain(ErrorCode::BadCredential), remove_users)
        .plain::<GetCertificates, _, _>(async |caller: Arc<Caller>| Ok(caller.controller().certificates()))
        .with_body::<SelectCertificate, _, _>(MalformedBody::plain(ErrorCode::Refused), select_certificate)
        .with_body::<MakeSelfSigned, _, _>(MalformedBody::plain(ErrorCode::BadCertificateRequest), make_self_signed)
        .with_body::<ImportCertificate, _, _>(MalformedBody::secret(ErrorCode::BadCertificate), import_certificate)
        .with_body::<MakeCsr, _, _>(MalformedBody::plain(ErrorCode::BadCertificateRequest), make_csr)
        .with_body::<ImportCsr, _, _>(MalformedBody::secret(ErrorCode::FileFormat), import_csr)
        .with_body::<ImportCaSigned, _, _>(MalformedBody::plain(ErrorCode::BadCertificate), import_ca_signed)
        .plain::<GetTrusted, _, _>(async |caller: Arc<Caller>| clients(&caller, ClientList::Trusted).await)
        .plain::<GetIssuers, _, _>(async |caller: Arc<Caller>| clients(&caller, ClientList::Issuers).await)
        .plain::<GetRejected, _, _>(async |caller: Arc<Caller>| {
            let controller = Arc::clone(caller.controller());
            off_thread(move || Ok(controller.rejected_clients())).await
        })
        .plain::<GetCrls, _, _>(async |caller: Arc<Caller>| Ok(caller.controller().crls()))
        .with_path::<GetCrl, _, _>(async |caller: Arc<Caller>, id: String| Ok(caller.controller().crl(&id)?))
        .plain::<GetTrustStamp, _, _>(async |caller: Arc<Caller>| Ok(caller.controller().trust_stamp()))
        .with_body::<EditTrust, _, _>(
            MalformedBody::plain(ErrorCode::BadCertificate),
            async |caller: Arc<Caller>, change: EditTrust| {
                caller.settle(caller.controller().edit_trust(change).await).await
            },
        )
}

async fn get_log(caller: Arc<Caller>, query: Option<String>) -> Result<LogChunk, FailedRequest> {
    let from = match query.as_deref() {
        None | Some("") => None,
        Some(query) => Some(query.strip_prefix("from=").and_then(|from| from.parse().ok()).ok_or(RequestError::Query)?),
    };
    Ok(caller.controller().read_log(from).await?)
}

async fn set_settings(caller: Arc<Caller>, change: SetSettings) -> Result<Changed, FailedRequest> {
    let SetSettings { revision, settings, delete_log, log_password } = change;
    let edit = move |state: &mut ControllerState, context: &OperatingContext| {
        changes::set_settings(state, context, settings, log_password.as_deref())
    };
    let outcome = if delete_log {
        caller.controller().change_with_new_log(revision, Effect::Restart, edit).await
    } else {
        caller.controller().change(revision, Effect::Restart, edit).await
    };
    let (changed, ()) = caller.settle(outcome).await?;
    Ok(changed)
}

async fn import_settings(caller: Arc<Caller>, change: ImportSettings) -> Result<Changed, FailedRequest> {
    let ImportSettings { revision, export, passphrase } = change;
    let edit = move |state: &mut ControllerState, context: &OperatingContext| {
        settings_transfer::import(state, context, &export, &passphrase.0)
    };
    let (changed, ()) = caller.settle(caller.controller().change(revision, Effect::Restart, edit).await).await?;
    Ok(changed)
}

async fn activate(caller: Arc<Caller>, change: Activate) -> Result<Changed, FailedRequest> {
    let Activate { revision, licence, activation } = change;
    let keys = ActivationKeys { licence, activation };
    let edit = move |state: &mut ControllerState, _: &OperatingContext| changes::activate(state, keys);
    let (changed, ()) = caller.settle(caller.controller().change(revision, Effect::Restart, edit).await).await?;
    Ok(changed)
}

async fn add_user(caller: Arc<Caller>, change: AddUser) -> Result<Changed, FailedRequest> {
    let AddUser { revision, name, password } = change;
    let edit =
        move |state: &mut ControllerState, _: &OperatingContext| changes::add_user(state, name, password.expose());
    let (changed, ()) = caller.settle(caller.controller().change(revision, Effect::Restart, edit).await).await?;
    Ok(changed)
}

async fn remove_users(caller: Arc<Caller>, change: RemoveUsers) -> Result<Changed, FailedRequest> {
    let RemoveUsers { revision, names } = change;
    let edit = move |state: &mut ControllerState, _: &OperatingContext| changes::remove_users(state, &names);
    let (changed, ()) = caller.settle(caller.controller().change(revision, Effect::Restart, edit).await).await?;
    Ok(changed)
}

async fn select_certificate(caller: Arc<Caller>, change: SelectCertificate) -> Result<Changed, FailedRequest> {
    let SelectCertificate { revision, kind } = change;
    let edit =
        move |state: &mut ControllerState, _: &OperatingContext| certificate_changes::select_certificate(state, kind);
    let (changed, ()) = caller.settle(caller.controller().change(revision, Effect::Restart, edit).await).await?;
    Ok(changed)
}

async fn make_self_signed(caller: Arc<Caller>, change: MakeSelfSigned) -> Result<CertificateInstalled, FailedRequest> {
    let MakeSelfSigned { revision, request } = change;
    let edit = move |state: &mut ControllerState, context: &OperatingContext| {
        changes::make_self_signed(state, context, &request)
    };
    let outcome = caller.controller().change(revision, Effect::Restart, edit).await;
    let (changed, certificate) = caller.settle(outcome).await?;
    Ok(CertificateInstalled { changed, certificate: Base64Bytes(certificate) })
}

async fn import_certificate(
    caller: Arc<Caller>,
    change: ImportCertificate,
) -> Result<CertificateInstalled, FailedRequest> {
    let ImportCertificate { revision, kind, pkcs12, password } = change;
    let edit = move |state: &mut ControllerState, context: &OperatingContext| {
        changes::import_certificate(state, context, kind, &pkcs12.0, password.expose())
    };
    let outcome = caller.controller().change(revision, Effect::Restart, edit).await;
    let (changed, certificate) = caller.settle(outcome).await?;
    Ok(CertificateInstalled { changed, certificate: Base64Bytes(certificate) })
}

async fn make_csr(caller: Arc<Caller>, change: MakeCsr) -> Result<CsrMade, FailedRequest> {
    let MakeCsr { revision, request } = change;
    let edit = move |state: &mut ControllerState, context: &OperatingContext| {
        certificate_changes::make_csr(state, context, &request)
    };
    let (changed, csr) = caller.settle(caller.controller().change(revision, Effect::Nothing, edit).await).await?;
    Ok(CsrMade { changed, csr: Base64Bytes(csr) })
}

async fn import_csr(caller: Arc<Caller>, change: ImportCsr) -> Result<CsrMade, FailedRequest> {
    let ImportCsr { revision, csr, pkcs12, password, certificate } = change;
    let effect = if certificate.is_some() { Effect::Restart } else { Effect::CertificateLost };
    let edit = move |state: &mut ControllerState, context: &OperatingContext| {
        let certificate = certificate.as_ref().map(|certificate| certificate.0.as_slice());
        certificate_changes::import_csr(state, context, &csr.0, &pkcs12.0, password.expose(), certificate)
    };
    let (changed, csr) = caller.settle(caller.controller().change(revision, effect, edit).await).await?;
    Ok(CsrMade { changed, csr: Base64Bytes(csr) })
}

async fn import_ca_signed(caller: Arc<Caller>, change: ImportCaSigned) -> Result<CertificateInstalled, FailedRequest> {
    let ImportCaSigned { revision, certificate } = change;
    let edit = move |state: &mut ControllerState, context: &OperatingContext| {
        certificate_changes::import_ca_signed(state, context, &certificate.0)
    };
    let outcome = caller.controller().change(revision, Effect::Restart, edit).await;
    let (changed, certificate) = caller.settle(outcome).await?;
    Ok(CertificateInstalled { changed, certificate: Base64Bytes(certificate) })
}

/// Parses certificates: off the async threads.
async fn clients(caller: &Caller, list: ClientList) -> Result<Revisioned<Vec<ListedCertificate>>, FailedRequest> {
    let controller = Arc::clone(caller.controller());
    off_thread(move || Ok(controller.clients(list)?)).await
}

async fn off_thread<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, FailedRequest> + Send + 'static,
) -> Result<T, FailedRequest> {
    tokio::task::spawn_blocking(work).await.map_err(RequestError::Worker)?
}
