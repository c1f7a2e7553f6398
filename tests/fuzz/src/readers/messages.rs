use opcua_configurator::model::{
    Changed, ControllerInfo, ListedCertificate, LogChunk, Problem, Revisioned, ServerSettings,
    StoredServerCertificates, UserName,
};
use opcua_configurator::protocol::{
    Activate, AddUser, CertificateInstalled, CsrMade, EditTrust, ExportContent, ExportSettings, FailureBody, Hello,
    ImportCaSigned, ImportCertificate, ImportCsr, ImportSettings, Login, MAX_EXPORT_BYTES, MakeCsr, MakeSelfSigned,
    RemoveUsers, SelectCertificate, SessionStarted, SetSettings, SettingsExport,
};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Every message of the management protocol, either way: what was understood says the same when it is written again,
/// and shows no secret.
pub fn management_message(bytes: &[u8]) {
    request::<Login>(bytes, |m| vec![m.password.expose().to_owned()]);
    request::<SetSettings>(bytes, |_| vec![]);
    request::<AddUser>(bytes, |m| vec![m.password.expose().to_owned()]);
    request::<RemoveUsers>(bytes, |_| vec![]);
    request::<MakeSelfSigned>(bytes, |_| vec![]);
    request::<ImportCertificate>(bytes, |m| vec![m.password.expose().to_owned()]);
    request::<SelectCertificate>(bytes, |_| vec![]);
    request::<MakeCsr>(bytes, |_| vec![]);
    request::<ImportCsr>(bytes, |m| vec![m.password.expose().to_owned()]);
    request::<ImportCaSigned>(bytes, |_| vec![]);
    request::<EditTrust>(bytes, |_| vec![]);
    request::<Activate>(bytes, |m| vec![m.licence.to_string(), m.activation.to_string()]);
    request::<ExportSettings>(bytes, |m| vec![m.passphrase.expose().to_owned()]);
    request::<ImportSettings>(bytes, |m| vec![m.passphrase.expose().to_owned()]);

    request::<SessionStarted>(bytes, |m| vec![m.token.expose().to_owned()]);
    response::<Hello>(bytes);
    response::<Changed>(bytes);
    response::<CertificateInstalled>(bytes);
    response::<CsrMade>(bytes);
    response::<LogChunk>(bytes);
    response::<ControllerInfo>(bytes);
    response::<Revisioned<ServerSettings>>(bytes);
    response::<Revisioned<Vec<UserName>>>(bytes);
    response::<Revisioned<StoredServerCertificates>>(bytes);
    response::<Revisioned<Vec<ListedCertificate>>>(bytes);
    response::<FailureBody>(bytes);
    if let Ok(failure) = serde_json::from_slice::<FailureBody>(bytes) {
        let problem = Problem::from(failure);
        assert!(problem.code.is_a_controllers());
    }
}

/// [`SettingsExport::from_json`], and what an export holds. Opening one hashes its passphrase, which is slow on
/// purpose, and is left to other tests.
pub fn settings_export(bytes: &[u8]) {
    if let Ok(export) = SettingsExport::from_json(bytes) {
        assert!(bytes.len() <= MAX_EXPORT_BYTES);
        assert_eq!(SettingsExport::from_json(&export.to_json()), Ok(export));
    }
    response::<ExportContent>(bytes);
}

/// Requests are not compared with each other: some hold secrets.
fn request<T: Serialize + DeserializeOwned + std::fmt::Debug>(bytes: &[u8], secrets: fn(&T) -> Vec<String>) {
    let Ok(message) = serde_json::from_slice::<T>(bytes) else { return };
    let json = serde_json::to_string(&message).expect("it can be written");
    let again: T = serde_json::from_str(&json).expect("and read");
    assert_eq!(serde_json::to_string(&again).expect("twice"), json);
    let shown = format!("{message:?}");
    // A short one may stand there for other reasons.
    for secret in secrets(&message).iter().filter(|secret| secret.len() >= 16) {
        assert!(!shown.contains(secret.as_str()), "{shown}");
    }
}

fn response<T: Serialize + DeserializeOwned + PartialEq + std::fmt::Debug>(bytes: &[u8]) {
    let Ok(message) = serde_json::from_slice::<T>(bytes) else { return };
    let json = serde_json::to_vec(&message).expect("it can be written");
    assert_eq!(serde_json::from_slice::<T>(&json).expect("and read"), message);
}
