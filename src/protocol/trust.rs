//! The client certificate lists and CRLs of a controller: which clients its OPC UA server accepts (manual 2.7.3).

use serde::{Deserialize, Serialize};

use super::request::requests;
use super::response::{check_count, check_key, check_time, shorten};
use super::{Request, Response};
use crate::model::{
    Base64Bytes, Changed, CrlSummary, DisconnectedClient, ListedCertificate, ListedCrl, RevisionToken, Revisioned,
    TrustStamp, TrustStep,
};
use crate::pki::RejectedClient;

requests! {
    /// Client certificate lists and CRLs.
    TRUST_REQUESTS
    GET "/v1/clients/trusted" GetTrusted { none } session -> Revisioned<Vec<ListedCertificate>>, "";
    GET "/v1/clients/issuers" GetIssuers { none } session -> Revisioned<Vec<ListedCertificate>>, "current firmware";
    GET "/v1/clients/rejected" GetRejected { none } session -> Revisioned<Vec<RejectedClient>>, "seen last first";
    GET "/v1/crls" GetCrls { none } session -> Revisioned<Vec<ListedCrl>>, "";
    GET "/v1/crls/{id}" GetCrl { none } session -> Base64Bytes, "the CRL in DER", at GetCrl::target_with_parameters;
    GET "/v1/trust" GetTrustStamp { none } session -> TrustStamp, "";
    POST "/v1/trust" EditTrust { json } revision -> TrustChanged, "all steps or none";
}

/// The most steps of one [`EditTrust`].
pub const MAX_TRUST_STEPS: usize = 16;
/// The largest CRL a controller takes, in bytes of DER: what fits into a request.
pub const MAX_SENT_CRL_BYTES: usize = 700 * 1024;

/// Reads the trusted list: clients, and authorities whose clients are accepted.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct GetTrusted;

/// Current firmware: reads the issuers list, whose authorities complete chains and are not trusted by themselves.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct GetIssuers;

/// Reads the list of clients that were refused.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct GetRejected;

/// Reads the CRLs.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct GetCrls;

/// Reads one CRL, in DER.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct GetCrl {
    /// [`CrlSummary::id`].
    pub id: String,
}

impl GetCrl {
    fn target_with_parameters(&self) -> String {
        Self::PATH.replace("{id}", &self.id)
    }
}

/// Reads a [`TrustStamp`].
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct GetTrustStamp;

impl Response for TrustStamp {}

/// Changes lists and CRLs: all steps, one after the other, or none.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EditTrust {
    /// The configuration that the change is based on.
    pub revision: RevisionToken,
    /// 1 to [`MAX_TRUST_STEPS`].
    pub steps: Vec<TrustStep>,
}

/// Lists and CRLs were changed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct TrustChanged {
    /// The server's state and the new revision.
    pub changed: Changed,
    /// The clients whose open connections the controller ended because of the change.
    pub cut: Vec<DisconnectedClient>,
}

impl Response for TrustChanged {
    fn check(&mut self) -> Result<(), &'static str> {
        check_count(&self.cut)?;
        for cut in &mut self.cut {
            [&mut cut.address, &mut cut.issued_to, &mut cut.thumbprint].into_iter().for_each(shorten);
        }
        Ok(())
    }
}

impl Response for ListedCertificate {
    fn check(&mut self) -> Result<(), &'static str> {
        shorten(&mut self.file_name);
        self.summary.check()?;
        check_time(self.added)
    }
}

impl Response for RejectedClient {
    fn check(&mut self) -> Result<(), &'static str> {
        shorten(&mut self.reason);
        shorten(&mut self.address);
        check_count(&self.chain)?;
        self.summary.check()?;
        check_time(self.first_seen)?;
        check_time(self.last_seen)
    }
}

impl Response for ListedCrl {
    fn check(&mut self) -> Result<(), &'static str> {
        shorten(&mut self.file_name);
        // It becomes a part of a path.
        if !self.summary.id.bytes().all(|byte| byte.is_ascii_hexdigit()) {
            return Err("the name of a revocation list is no SHA-1");
        }
        self.summary.check()?;
        check_time(self.added)
    }
}

impl Response for CrlSummary {
    fn check(&mut self) -> Result<(), &'static str> {
        check_key(&mut self.issuer)?;
        check_key(&mut self.id)?;
        self.number.as_mut().map_or(Ok(()), check_key)?;
        check_time(self.this_update)?;
        self.next_update.map_or(Ok(()), check_time)
    }
}
