use async_trait::async_trait;
use secrecy::SecretString;

use super::{HttpsConnection, LOGOUT_TIMEOUT, capabilities};
use crate::model::activation::ActivationKeys;
use crate::model::{
    Base64Bytes, Capabilities, CertificateType, Changed, ClientList, ControllerInfo, CsrRequest, ErrorCode,
    ListedCertificate, ListedCrl, LogChunk, Problem, RevisionToken, Revisioned, SelfSignedRequest, ServerSettings,
    StoredServerCertificates, TrustStamp, TrustStep, UserCredential, UserName,
};
use crate::pki::RejectedClient;
use crate::protocol::{
    Activate, AddUser, CertificateInstalled, CsrMade, EditTrust, ExportSettings, GetCertificates, GetCrl, GetCrls,
    GetInfo, GetIssuers, GetLog, GetRejected, GetSettings, GetTrustStamp, GetTrusted, GetUsers, ImportCaSigned,
    ImportCertificate, ImportCsr, ImportSettings, Logout, MakeCsr, MakeSelfSigned, RemoveUsers, SelectCertificate,
    SetSettings, SettingsExport, StartServer, StopServer, TrustChanged, WireSecret,
};
use crate::session::{
    ControllerSession, CsrImport, InstalledCertificate, SealedKey, SettingsUpdate, StoredCsr, TrustEdited,
};

impl From<CertificateInstalled> for InstalledCertificate {
    fn from(CertificateInstalled { changed, certificate }: CertificateInstalled) -> Self {
        Self { changed, certificate: certificate.0 }
    }
}

impl From<CsrMade> for StoredCsr {
    fn from(CsrMade { changed, csr }: CsrMade) -> Self {
        Self { changed, csr: csr.0 }
    }
}

impl From<TrustChanged> for TrustEdited {
    fn from(TrustChanged { changed, cut }: TrustChanged) -> Self {
        Self { changed, cut }
    }
}

#[async_trait]
impl ControllerSession for HttpsConnection {
    async fn info(&mut self) -> Result<ControllerInfo, Problem> {
        let info = self.send(&GetInfo).await?;
        self.firmware = Some(info.firmware);
        Ok(info)
    }

    async fn capabilities(&mut self) -> Result<Capabilities, Problem> {
        if self.firmware.is_none() {
            self.info().await?;
        }
        Ok(capabilities(self.firmware))
    }

    async fn start_server(&mut self) -> Result<Changed, Problem> {
        self.send(&StartServer).await
    }

    async fn stop_server(&mut self) -> Result<Changed, Problem> {
        self.send(&StopServer).await
    }

    async fn settings(&mut self) -> Result<Revisioned<ServerSettings>, Problem> {
        self.send(&GetSettings).await
    }

    async fn set_settings(&mut self, revision: RevisionToken, update: SettingsUpdate) -> Result<Changed, Problem> {
        let SettingsUpdate { settings, delete_log, log_password } = update;
        self.send(&SetSettings { revision, settings, delete_log, log_password }).await
    }

    async fn users(&mut self) -> Result<Revisioned<Vec<UserName>>, Problem> {
        self.send(&GetUsers).await
    }

    async fn add_user(&mut self, revision: RevisionToken, user: UserCredential) -> Result<Changed, Problem> {
        let password = WireSecret(user.password.secret().clone());
        self.send(&AddUser { revision, name: user.name, password }).await
    }

    async fn remove_users(&mut self, revision: RevisionToken, names: Vec<UserName>) -> Result<Changed, Problem> {
        self.send(&RemoveUsers { revision, names }).await
    }

    async fn make_self_signed(
        &mut self,
        revision: RevisionToken,
        request: SelfSignedRequest,
    ) -> Result<InstalledCertificate, Problem> {
        self.send(&MakeSelfSigned { revision, request }).await.map(Into::into)
    }

    async fn import_certificate(
        &mut self,
        revision: RevisionToken,
        kind: CertificateType,
        SealedKey { pkcs12, password }: SealedKey,
    ) -> Result<InstalledCertificate, Problem> {
        let (pkcs12, password) = (Base64Bytes(pkcs12), WireSecret(password));
        self.send(&ImportCertificate { revision, kind, pkcs12, password }).await.map(Into::into)
    }

    async fn certificates(&mut self) -> Result<Revisioned<StoredServerCertificates>, Problem> {
        self.send(&GetCertificates).await
    }

    async fn select_certificate(&mut self, revision: RevisionToken, kind: CertificateType) -> Result<Changed, Problem> {
        self.send(&SelectCertificate { revision, kind }).await
    }

    async fn make_csr(&mut self, revision: RevisionToken, request: CsrRequest) -> Result<StoredCsr, Problem> {
        self.send(&MakeCsr { revision, request }).await.map(Into::into)
    }

    async fn import_csr(&mut self, revision: RevisionToken, import: CsrImport) -> Result<StoredCsr, Problem> {
        let CsrImport { csr, key: SealedKey { pkcs12, password }, certificate } = import;
        let request = ImportCsr {
            revision,
            csr: Base64Bytes(csr),
            pkcs12: Base64Bytes(pkcs12),
            password: WireSecret(password),
            certificate: certificate.map(Base64Bytes),
        };
        self.send(&request).await.map(Into::into)
    }

    async fn import_ca_signed(
        &mut self,
        revision: RevisionToken,
        certificate: Vec<u8>,
    ) -> Result<InstalledCertificate, Problem> {
        self.send(&ImportCaSigned { revision, certificate: Base64Bytes(certificate) }).await.map(Into::into)
    }

    async fn clients(&mut self, list: ClientList) -> Result<Revisioned<Vec<ListedCertificate>>, Problem> {
        match list {
            ClientList::Trusted => self.send(&GetTrusted).await,
            ClientList::Issuers => self.send(&GetIssuers).await,
            ClientList::Rejected => {
                Err(Problem::with_detail(ErrorCode::Internal, "the rejected list is read by a call of its own"))
            }
        }
    }

    async fn rejected_clients(&mut self) -> Result<Revisioned<Vec<RejectedClient>>, Problem> {
        self.send(&GetRejected).await
    }

    async fn crls(&mut self) -> Result<Revisioned<Vec<ListedCrl>>, Problem> {
        self.send(&GetCrls).await
    }

    async fn crl(&mut self, id: &str) -> Result<Base64Bytes, Problem> {
        self.send(&GetCrl { id: id.to_owned() }).await
    }

    async fn trust_stamp(&mut self) -> Result<TrustStamp, Problem> {
        self.send(&GetTrustStamp).await
    }

    async fn edit_trust(&mut self, revision: RevisionToken, steps: Vec<TrustStep>) -> Result<TrustEdited, Problem> {
        self.send(&EditTrust { revision, steps }).await.map(Into::into)
    }

    async fn activate(&mut self, revision: RevisionToken, keys: ActivationKeys) -> Result<Changed, Problem> {
        let ActivationKeys { licence, activation } = keys;
        self.send(&Activate { revision, licence, activation }).await
    }

    async fn log(&mut self, from: Option<u64>) -> Result<LogChunk, Problem> {
        self.send(&GetLog { from }).await
    }

    async fn export_settings(&mut self, passphrase: SecretString) -> Result<SettingsExport, Problem> {
        self.send(&ExportSettings { passphrase: WireSecret(passphrase) }).await
    }

    async fn import_settings(
        &mut self,
        revision: RevisionToken,
        export: SettingsExport,
        passphrase: SecretString,
    ) -> Result<Changed, Problem> {
        self.send(&ImportSettings { revision, export, passphrase: WireSecret(passphrase) }).await
    }

    fn unanswered(&self) -> Option<RevisionToken> {
        *self.unanswered.lock()
    }

    async fn close(&mut self) {
        if let Err(problem) = self.send_within(LOGOUT_TIMEOUT, &Logout).await {
            tracing::debug!(%problem, "logout failed");
        }
        self.token = None;
    }
}
