//! What the controller does for each request in a session.

use std::sync::Arc;

use super::body::Malformed;
use super::caller::{Caller, Failed};
use super::routes::Routes;
use crate::model::activation::ActivationKeys;
use crate::model::{Base64Bytes, Changed, ClientList, ErrorCode, ListedCertificate, LogChunk, Problem, Revisioned};
use crate::protocol::{
    Activate, AddUser, CsrMade, EditTrust, ExportSettings, GetCertificates, GetCrl, GetCrls, GetInfo, GetIssuers,
    GetLog, GetRejected, GetSettings, GetTrustStamp, GetTrusted, GetUsers, ImportCaSigned, ImportCertificate,
    ImportCsr, ImportSettings, Installed, MakeCsr, MakeSelfSigned, RemoveUsers, SelectCertificate, SetSettings,
    StartServer, StopServer,
};
use crate::virtual_controller::controller::Effect;
use crate::virtual_controller::state::{OperatingContext, State};
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
        .with_body::<SetSettings, _, _>(Malformed::plain(ErrorCode::BadSettings), set_settings)
        .with_body::<ExportSettings, _, _>(
            Malformed::secret(ErrorCode::Refused),
            async |caller: Arc<Caller>, ExportSettings { passphrase }| {
                Ok(caller.controller().export(passphrase).await?)
            },
        )
        .with_body::<ImportSettings, _, _>(Malformed::secret(ErrorCode::ExportDamaged), import_settings)
        .with_body::<Activate, _, _>(Malformed::secret(ErrorCode::BadActivationKey), activate)
        .plain::<GetUsers, _, _>(async |caller: Arc<Caller>| Ok(caller.controller().users()))
        .with_body::<AddUser, _, _>(Malformed::secret(ErrorCode::BadCredential), add_user)
        .with_body::<RemoveUsers, _, _>(Malformed::plain(ErrorCode::BadCredential), remove_users)
        .plain::<GetCertificates, _, _>(async |caller: Arc<Caller>| Ok(caller.controller().certificates()))
        .with_body::<SelectCertificate, _, _>(Malformed::plain(ErrorCode::Refused), select_certificate)
        .with_body::<MakeSelfSigned, _, _>(Malformed::plain(ErrorCode::BadCertificateRequest), make_self_signed)
        .with_body::<ImportCertificate, _, _>(Malformed::secret(ErrorCode::BadCertificate), import_certificate)
        .with_body::<MakeCsr, _, _>(Malformed::plain(ErrorCode::BadCertificateRequest), make_csr)
        .with_body::<ImportCsr, _, _>(Malformed::secret(ErrorCode::FileFormat), import_csr)
        .with_body::<ImportCaSigned, _, _>(Malformed::plain(ErrorCode::BadCertificate), import_ca_signed)
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
            Malformed::plain(ErrorCode::BadCertificate),
            async |caller: Arc<Caller>, change: EditTrust| {
                caller.settle(caller.controller().edit_trust(change).await).await
            },
        )
}

async fn get_log(caller: Arc<Caller>, query: Option<String>) -> Result<LogChunk, Failed> {
    let from = match query.as_deref() {
        None | Some("") => None,
        Some(query) => Some(
            query
                .strip_prefix("from=")
                .and_then(|from| from.parse().ok())
                .ok_or_else(|| Problem::with_detail(ErrorCode::Refused, "from=BYTE is all that can be asked for"))?,
        ),
    };
    Ok(caller.controller().read_log(from).await?)
}

async fn set_settings(caller: Arc<Caller>, change: SetSettings) -> Result<Changed, Failed> {
    let SetSettings { revision, settings, delete_log, log_password } = change;
    let edit = move |state: &mut State, context: &OperatingContext| {
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

async fn import_settings(caller: Arc<Caller>, change: ImportSettings) -> Result<Changed, Failed> {
    let ImportSettings { revision, export, passphrase } = change;
    let edit = move |state: &mut State, context: &OperatingContext| {
        settings_transfer::import(state, context, &export, &passphrase.0)
    };
    let (changed, ()) = caller.settle(caller.controller().change(revision, Effect::Restart, edit).await).await?;
    Ok(changed)
}

async fn activate(caller: Arc<Caller>, change: Activate) -> Result<Changed, Failed> {
    let Activate { revision, licence, activation } = change;
    let keys = ActivationKeys { licence, activation };
    let edit = move |state: &mut State, _: &OperatingContext| changes::activate(state, keys);
    let (changed, ()) = caller.settle(caller.controller().change(revision, Effect::Restart, edit).await).await?;
    Ok(changed)
}

async fn add_user(caller: Arc<Caller>, change: AddUser) -> Result<Changed, Failed> {
    let AddUser { revision, name, password } = change;
    let edit = move |state: &mut State, _: &OperatingContext| changes::add_user(state, name, password.expose());
    let (changed, ()) = caller.settle(caller.controller().change(revision, Effect::Restart, edit).await).await?;
    Ok(changed)
}

async fn remove_users(caller: Arc<Caller>, change: RemoveUsers) -> Result<Changed, Failed> {
    let RemoveUsers { revision, names } = change;
    let edit = move |state: &mut State, _: &OperatingContext| changes::remove_users(state, &names);
    let (changed, ()) = caller.settle(caller.controller().change(revision, Effect::Restart, edit).await).await?;
    Ok(changed)
}

async fn select_certificate(caller: Arc<Caller>, change: SelectCertificate) -> Result<Changed, Failed> {
    let SelectCertificate { revision, kind } = change;
    let edit = move |state: &mut State, _: &OperatingContext| certificate_changes::select_certificate(state, kind);
    let (changed, ()) = caller.settle(caller.controller().change(revision, Effect::Restart, edit).await).await?;
    Ok(changed)
}

async fn make_self_signed(caller: Arc<Caller>, change: MakeSelfSigned) -> Result<Installed, Failed> {
    let MakeSelfSigned { revision, request } = change;
    let edit = move |state: &mut State, context: &OperatingContext| changes::make_self_signed(state, context, &request);
    let outcome = caller.controller().change(revision, Effect::Restart, edit).await;
    let (changed, certificate) = caller.settle(outcome).await?;
    Ok(Installed { changed, certificate: Base64Bytes(certificate) })
}

async fn import_certificate(caller: Arc<Caller>, change: ImportCertificate) -> Result<Installed, Failed> {
    let ImportCertificate { revision, kind, pkcs12, password } = change;
    let edit = move |state: &mut State, context: &OperatingContext| {
        changes::import_certificate(state, context, kind, &pkcs12.0, password.expose())
    };
    let outcome = caller.controller().change(revision, Effect::Restart, edit).await;
    let (changed, certificate) = caller.settle(outcome).await?;
    Ok(Installed { changed, certificate: Base64Bytes(certificate) })
}

async fn make_csr(caller: Arc<Caller>, change: MakeCsr) -> Result<CsrMade, Failed> {
    let MakeCsr { revision, request } = change;
    let edit =
        move |state: &mut State, context: &OperatingContext| certificate_changes::make_csr(state, context, &request);
    let (changed, csr) = caller.settle(caller.controller().change(revision, Effect::Nothing, edit).await).await?;
    Ok(CsrMade { changed, csr: Base64Bytes(csr) })
}

async fn import_csr(caller: Arc<Caller>, change: ImportCsr) -> Result<CsrMade, Failed> {
    let ImportCsr { revision, csr, pkcs12, password, certificate } = change;
    let effect = if certificate.is_some() { Effect::Restart } else { Effect::CertificateLost };
    let edit = move |state: &mut State, context: &OperatingContext| {
        let certificate = certificate.as_ref().map(|certificate| certificate.0.as_slice());
        certificate_changes::import_csr(state, context, &csr.0, &pkcs12.0, password.expose(), certificate)
    };
    let (changed, csr) = caller.settle(caller.controller().change(revision, effect, edit).await).await?;
    Ok(CsrMade { changed, csr: Base64Bytes(csr) })
}

async fn import_ca_signed(caller: Arc<Caller>, change: ImportCaSigned) -> Result<Installed, Failed> {
    let ImportCaSigned { revision, certificate } = change;
    let edit = move |state: &mut State, context: &OperatingContext| {
        certificate_changes::import_ca_signed(state, context, &certificate.0)
    };
    let outcome = caller.controller().change(revision, Effect::Restart, edit).await;
    let (changed, certificate) = caller.settle(outcome).await?;
    Ok(Installed { changed, certificate: Base64Bytes(certificate) })
}

/// Parses certificates: off the async threads.
async fn clients(caller: &Caller, list: ClientList) -> Result<Revisioned<Vec<ListedCertificate>>, Failed> {
    let controller = Arc::clone(caller.controller());
    off_thread(move || Ok(controller.clients(list)?)).await
}

async fn off_thread<T: Send + 'static>(work: impl FnOnce() -> Result<T, Failed> + Send + 'static) -> Result<T, Failed> {
    tokio::task::spawn_blocking(work).await.map_err(|error| Problem::with_detail(ErrorCode::Internal, error))?
}
