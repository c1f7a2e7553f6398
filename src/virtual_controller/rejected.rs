use std::collections::HashMap;
use std::fs::{self, File};
use std::io::{self, Read as _};
use std::net::IpAddr;
use std::path::{Path, PathBuf};
use std::time::Duration;

use chrono::{DateTime, Utc};
use parking_lot::Mutex;
use serde::{Deserialize, Serialize};
use tokio::sync::Notify;
use tokio_util::sync::CancellationToken;

use super::connection_limits::SourceNetwork;
use super::faults::Faults;
use super::opcua::RejectionRecorder;
use super::state::{ControllerState, TrustListCertificate};
use super::store::{StoreError, replace_private_file};
use crate::model::{Base64Bytes, CertificateStatus};
use crate::pki::{Certificate, CertificateRejection, RefusalCause, RejectedClient};

/// The client certificates that were refused, for a person to decide about (manual 2.7.3).
///
/// Any peer that reaches the OPC UA port can add to this list, so it is bounded: one entry a certificate,
/// [`MAX_ENTRIES`] of them and [`MAX_BYTES`] together. When it is full, the address with most entries loses the one not
/// seen for longest: a stranger with a thousand certificates does not push out the others.
///
/// It lives in memory; [`RejectedClients::keep`] writes it beside the controller's state, the first time at once, then
/// at most every [`WRITE_PAUSE`], however many are refused.
#[derive(Debug)]
pub struct RejectedClients {
    path: PathBuf,
    faults: Faults,
    list: Mutex<RejectedList>,
    changed: Notify,
    /// Held while the file is written, so that an older list never overwrites a newer one.
    writing: Mutex<()>,
}

#[derive(Debug, Default)]
struct RejectedList {
    entries: Vec<RejectedEntry>,
    stamp: u64,
    /// Whether the file holds something else.
    dirty: bool,
}

/// One refused certificate.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RejectedEntry {
    /// DER.
    pub certificate: Base64Bytes,
    pub chain: Vec<Base64Bytes>,
    pub thumbprint: String,
    pub status: CertificateStatus,
    #[serde(default, deserialize_with = "RefusalCause::if_known", skip_serializing_if = "Option::is_none")]
    pub cause: Option<RefusalCause>,
    pub reason: String,
    pub address: Option<IpAddr>,
    pub first_seen: DateTime<Utc>,
    pub last_seen: DateTime<Utc>,
    pub count: u64,
}

pub const MAX_ENTRIES: usize = 100;
/// Bytes of DER. Keeps the list within one answer of the protocol.
pub const MAX_BYTES: usize = 1024 * 1024;
/// Certificates of the chain that are kept of one entry. Chains of more than a root and two more are not seen.
const MAX_CHAIN: usize = 4;
/// More than is said of names of the usual length, so that a reason is not cut short.
const MAX_REASON_CHARS: usize = 1500;
pub const WRITE_PAUSE: Duration = Duration::from_secs(5);
const FILE: &str = "rejected.json";
const MAX_FILE_BYTES: u64 = 4 * 1024 * 1024;

impl RejectedClients {
    /// Reads what was kept. What cannot be read is put aside: a list of strangers is no reason not to switch on.
    ///
    /// Entries of certificates that `state` lists since are left out: the process was killed between the two files.
    pub fn open(folder: &Path, faults: Faults, state: &ControllerState) -> Self {
        let path = folder.join(FILE);
        let mut entries = read(&path).unwrap_or_else(|error| {
            tracing::warn!(path = %path.display(), %error, "the rejected clients are forgotten");
            let _ = fs::rename(&path, path.with_extension("damaged"));
            Vec::new()
        });
        let listed: HashMap<&[u8], DateTime<Utc>> = state
            .trusted
            .iter()
            .chain(&state.issuers)
            .map(|TrustListCertificate { certificate, added, .. }| (certificate.0.as_slice(), *added))
            .collect();
        entries.retain(|entry| {
            listed.get(entry.certificate.0.as_slice()).is_none_or(|added| entry.count > 0 && entry.last_seen > *added)
        });
        let mut list = RejectedList { entries, stamp: stamp(faults.now()), dirty: false };
        list.make_room(None);
        Self { path, faults, list: Mutex::new(list), changed: Notify::new(), writing: Mutex::new(()) }
    }

    /// Another number after each change.
    pub fn stamp(&self) -> u64 {
        self.list.lock().stamp
    }

    /// Seen last first.
    pub fn list(&self) -> Vec<RejectedClient> {
        let mut entries = self.list.lock().entries.clone();
        entries.sort_by_key(|entry| std::cmp::Reverse(entry.last_seen));
        entries.into_iter().filter_map(RejectedEntry::into_message).collect()
    }

    /// The certificates by thumbprint, in DER.
    pub fn certificates(&self) -> HashMap<String, Base64Bytes> {
        let list = self.list.lock();
        list.entries.iter().map(|entry| (entry.thumbprint.clone(), entry.certificate.clone())).collect()
    }

    /// Takes in certificates that another list loses, and gives the entries that had to go for them. The disk hears of
    /// it with [`RejectedClients::write`].
    pub fn insert(&self, entries: Vec<RejectedEntry>) -> Vec<RejectedEntry> {
        let mut list = self.list.lock();
        let mut displaced = Vec::new();
        for entry in entries {
            displaced.extend(list.entries.extract_if(.., |known| known.thumbprint == entry.thumbprint));
            list.entries.push(entry);
            let last = list.entries.len() - 1;
            displaced.extend(list.make_room(Some(last)));
        }
        self.touch(&mut list);
        displaced
    }

    /// Undoes [`RejectedClients::insert`], but for what was refused again since.
    pub fn take_back(&self, inserted: &[String], displaced: Vec<RejectedEntry>) {
        if inserted.is_empty() && displaced.is_empty() {
            return;
        }
        let mut list = self.list.lock();
        list.entries.retain(|entry| entry.count > 0 || !inserted.contains(&entry.thumbprint));
        list.put_back(displaced);
        self.touch(&mut list);
    }

    /// Forgets certificates; the disk hears of it soon.
    pub fn forget(&self, thumbprints: &[String]) {
        let mut list = self.list.lock();
        let before = list.entries.len();
        list.entries.retain(|entry| !thumbprints.contains(&entry.thumbprint));
        if list.entries.len() < before {
            self.touch(&mut list);
        }
    }

    /// Forgets certificates, and writes that to the disk; if that fails, nothing is forgotten.
    pub fn remove(&self, thumbprints: &[String]) -> Result<(), StoreError> {
        let removed: Vec<RejectedEntry> = {
            let mut list = self.list.lock();
            let removed = list.entries.extract_if(.., |entry| thumbprints.contains(&entry.thumbprint)).collect();
            self.touch(&mut list);
            removed
        };
        if removed.is_empty() {
            return Ok(());
        }
        self.write().inspect_err(|_| {
            let mut list = self.list.lock();
            list.put_back(removed);
            self.touch(&mut list);
        })
    }

    /// Writes what has changed, until the controller is switched off.
    pub async fn keep(self: std::sync::Arc<Self>, off: CancellationToken) {
        loop {
            tokio::select! {
                () = off.cancelled() => return,
                () = self.changed.notified() => self.write_soon().await,
            }
            tokio::select! {
                () = off.cancelled() => return,
                () = tokio::time::sleep(WRITE_PAUSE) => {}
            }
        }
    }

    /// Writes the list if that has not been done; a list that cannot be written stays in memory.
    pub async fn write_soon(self: &std::sync::Arc<Self>) {
        let this = std::sync::Arc::clone(self);
        let written = tokio::task::spawn_blocking(move || this.write()).await;
        if let Ok(Err(error)) = written {
            tracing::warn!(%error, "the rejected clients were not written");
        }
    }

    /// Writes the list to the disk, if it has changed since.
    pub fn write(&self) -> Result<(), StoreError> {
        let _writing = self.writing.lock();
        let entries = {
            let mut list = self.list.lock();
            if !std::mem::take(&mut list.dirty) {
                return Ok(());
            }
            list.entries.clone()
        };
        let bytes = serde_json::to_vec(&entries).map_err(io::Error::other);
        bytes.and_then(|bytes| replace_private_file(&self.path, &bytes, &self.faults)).map_err(|source| {
            self.list.lock().dirty = true;
            StoreError::Io { path: self.path.clone(), source }
        })
    }

    fn touch(&self, list: &mut RejectedList) {
        list.stamp += 1;
        list.dirty = true;
        self.changed.notify_one();
    }
}

impl RejectionRecorder for RejectedClients {
    /// Quick, and waits for no disk.
    fn record(&self, sent: &[Certificate], address: IpAddr, rejection: &CertificateRejection) {
        let Some((certificate, chain)) = sent.split_first() else { return };
        let now = self.faults.now();
        let at_fault = if rejection.depth > 0 { format!(" ({})", rejection.subject) } else { String::new() };
        let reason: String = rejection
            .reason()
            .chars()
            .chain(at_fault.chars())
            .filter(|c| !c.is_control())
            .take(MAX_REASON_CHARS)
            .collect();
        let mut list = self.list.lock();
        let index = match list.entries.iter().position(|entry| entry.certificate.0 == certificate.der()) {
            Some(index) => index,
            None => {
                list.entries.push(RejectedEntry {
                    certificate: Base64Bytes(certificate.der().to_vec()),
                    chain: Vec::new(),
                    thumbprint: certificate.thumbprint_sha1(),
                    status: rejection.status(),
                    cause: None,
                    reason: String::new(),
                    address: None,
                    first_seen: now,
                    last_seen: now,
                    count: 0,
                });
                list.entries.len() - 1
            }
        };
        let entry = &mut list.entries[index];
        entry.chain = chain.iter().take(MAX_CHAIN).map(|c| Base64Bytes(c.der().to_vec())).collect();
        entry.status = rejection.status();
        entry.cause = Some(rejection.cause());
        entry.reason = reason;
        entry.address = Some(address.to_canonical());
        entry.last_seen = now;
        entry.count = entry.count.saturating_add(1);
        list.make_room(Some(index));
        self.touch(&mut list);
    }
}

impl RejectedList {
    /// Takes in what had gone, where there is no newer entry.
    fn put_back(&mut self, entries: Vec<RejectedEntry>) {
        for entry in entries {
            if !self.entries.iter().any(|known| known.thumbprint == entry.thumbprint) {
                self.entries.push(entry);
            }
        }
        self.make_room(None);
    }

    /// Drops entries until the list is within its bounds, not the one at `fresh`; and gives them.
    fn make_room(&mut self, fresh: Option<usize>) -> Vec<RejectedEntry> {
        let mut dropped = Vec::new();
        let keep = fresh.and_then(|index| self.entries.get(index)).map(|entry| entry.thumbprint.clone());
        let mut bytes: usize = self.entries.iter().map(RejectedEntry::bytes).sum();
        while self.entries.len() > MAX_ENTRIES || bytes > MAX_BYTES {
            let mut owned: HashMap<Option<SourceNetwork>, usize> = HashMap::new();
            for entry in &self.entries {
                *owned.entry(entry.address.map(SourceNetwork::new)).or_default() += 1;
            }
            let victim = self
                .entries
                .iter()
                .enumerate()
                .filter(|(_, entry)| keep.as_ref() != Some(&entry.thumbprint))
                .max_by_key(|(_, entry)| {
                    (owned[&entry.address.map(SourceNetwork::new)], std::cmp::Reverse(entry.last_seen))
                })
                .map(|(index, _)| index);
            let Some(victim) = victim else { break };
            let victim = self.entries.swap_remove(victim);
            bytes -= victim.bytes();
            dropped.push(victim);
        }
        dropped
    }
}

impl RejectedEntry {
    /// A certificate that a person put here.
    pub fn moved(certificate: Base64Bytes, thumbprint: String, now: DateTime<Utc>) -> Self {
        Self {
            certificate,
            chain: Vec::new(),
            thumbprint,
            status: CertificateStatus::Untrusted,
            cause: None,
            reason: "it was taken out of the list it was in".to_owned(),
            address: None,
            first_seen: now,
            last_seen: now,
            count: 0,
        }
    }

    fn bytes(&self) -> usize {
        self.certificate.0.len() + self.chain.iter().map(|der| der.0.len()).sum::<usize>()
    }

    fn into_message(self) -> Option<RejectedClient> {
        Some(RejectedClient {
            summary: Certificate::from_der(&self.certificate.0).ok()?.summary(),
            certificate: self.certificate,
            chain: self.chain,
            status: self.status,
            cause: self.cause,
            reason: self.reason,
            address: self.address.map(|address| address.to_string()).unwrap_or_default(),
            first_seen: self.first_seen,
            last_seen: self.last_seen,
            count: self.count,
        })
    }
}

/// Not the same after the controller was switched off and on, as long as its clock goes forward.
fn stamp(now: DateTime<Utc>) -> u64 {
    u64::try_from(now.timestamp_millis()).unwrap_or_default()
}

fn read(path: &Path) -> io::Result<Vec<RejectedEntry>> {
    let mut bytes = Vec::new();
    match File::open(path) {
        Ok(file) => file.take(MAX_FILE_BYTES).read_to_end(&mut bytes)?,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(error),
    };
    Ok(serde_json::from_slice(&bytes)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::net::{Ipv4Addr, Ipv6Addr};
    use std::sync::{Arc, LazyLock};
    use std::time::Instant;

    use crate::pki::CertificateFlaw;
    use crate::virtual_controller::{ControllerIdentity, NewController, OperatingContext};

    const HOME: IpAddr = IpAddr::V4(Ipv4Addr::new(10, 0, 0, 1));
    const STRANGER: IpAddr = IpAddr::V4(Ipv4Addr::new(10, 0, 0, 66));

    fn state() -> ControllerState {
        let identity = ControllerIdentity {
            serial: "R7A0000001".parse().unwrap(),
            series: crate::model::ControllerSeries::Rc800,
            firmware: crate::model::FirmwareVersion::new(8, 1, 0),
            name: "rejected".parse().unwrap(),
        };
        let context = OperatingContext { now: Utc::now(), bind: HOME, management_port: 7943 };
        NewController::new(identity, String::new()).make(&context).unwrap()
    }

    fn open(folder: &Path) -> Arc<RejectedClients> {
        Arc::new(RejectedClients::open(folder, Faults::default(), &state()))
    }

    /// Certificates are not asked whether their signature is right before they get here: any bytes do in its place.
    fn certificate(number: u32) -> Certificate {
        static SAMPLE: LazyLock<Vec<u8>> = LazyLock::new(|| {
            let key = rcgen::KeyPair::generate().unwrap();
            rcgen::CertificateParams::default().self_signed(&key).unwrap().der().to_vec()
        });
        let mut der = SAMPLE.clone();
        let end = der.len();
        der[end - 4..].copy_from_slice(&number.to_be_bytes());
        Certificate::from_der(&der).unwrap()
    }

    fn untrusted() -> CertificateRejection {
        CertificateRejection { flaw: CertificateFlaw::Untrusted, subject: "CN=client".to_owned(), depth: 0 }
    }

    #[test]
    fn a_certificate_has_one_entry_however_often_it_comes() {
        let folder = tempfile::tempdir().unwrap();
        let rejected = open(folder.path());
        let stamp = rejected.stamp();
        let chain = [certificate(1), certificate(2), certificate(3)];
        rejected.record(&chain, HOME, &untrusted());
        let flaw = CertificateFlaw::IssuerMissing { issuer: "CN=Root\u{1b}[2J".to_owned() };
        let issuer = CertificateRejection { flaw: flaw.clone(), depth: 1, ..untrusted() };
        rejected.record(&chain[..1], STRANGER, &issuer);
        rejected.record(&[], HOME, &untrusted());
        assert_eq!(rejected.stamp(), stamp + 2);
        let [entry] = &rejected.list()[..] else { panic!() };
        assert_eq!((entry.count, entry.address.as_str()), (2, "10.0.0.66"));
        let reason = "the certificate of its issuer, CN=Root\u{fffd}[2J, is missing (CN=client)";
        assert_eq!((entry.status, entry.reason.as_str()), (CertificateStatus::ChainIncomplete, reason));
        assert_eq!(entry.cause, Some(RefusalCause { flaw, at_fault: Some("CN=client".to_owned()) }));
        assert!(entry.first_seen <= entry.last_seen);
        assert_eq!(entry.summary.thumbprint, chain[0].thumbprint_sha1());
    }

    #[test]
    fn a_file_of_before_causes_were_kept_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let rejected = open(folder.path());
        rejected.record(&[certificate(1)], HOME, &untrusted());
        rejected.write().unwrap();
        let file = folder.path().join(FILE);
        let mut entries: serde_json::Value = serde_json::from_slice(&fs::read(&file).unwrap()).unwrap();
        assert_eq!(entries[0]["cause"]["flaw"], "untrusted");
        entries[0].as_object_mut().unwrap().remove("cause");
        fs::write(&file, entries.to_string()).unwrap();
        let list = open(folder.path()).list();
        assert_eq!((list.len(), &list[0].cause, list[0].status), (1, &None, CertificateStatus::Untrusted));
    }

    #[test]
    fn a_flood_does_not_push_out_others_or_wait_for_the_disk() {
        let folder = tempfile::tempdir().unwrap();
        let rejected = open(folder.path());
        rejected.record(&[certificate(0)], HOME, &untrusted());
        let certificates: Vec<[Certificate; 3]> =
            (1..=10_000).map(|i| [certificate(i), certificate(i + 20_000), certificate(i + 40_000)]).collect();
        for chain in &certificates {
            rejected.record(chain, STRANGER, &untrusted());
        }
        let list = rejected.list();
        assert_eq!(list.len(), MAX_ENTRIES);
        assert_eq!(list.iter().filter(|entry| entry.address == HOME.to_string()).count(), 1);
        assert_eq!(list[0].certificate.0, certificates[9_999][0].der());
        assert!(serde_json::to_vec(&list).unwrap().len() < crate::protocol::MAX_RESPONSE_BYTES);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "recording does not wait for the disk");
    }

    #[test]
    fn a_whole_network_of_ipv6_counts_as_one_stranger() {
        let folder = tempfile::tempdir().unwrap();
        let rejected = open(folder.path());
        rejected.record(&[certificate(0)], HOME, &untrusted());
        for host in 1..=MAX_ENTRIES as u16 * 2 {
            let address = Ipv6Addr::new(0x2001, 0xdb8, 0, 0, 0, 0, 0, host);
            rejected.record(&[certificate(host.into())], address.into(), &untrusted());
        }
        assert!(rejected.list().iter().any(|entry| entry.address == HOME.to_string()));
    }

    #[tokio::test]
    async fn the_list_is_written_soon_but_not_for_every_refusal() {
        let folder = tempfile::tempdir().unwrap();
        let rejected = open(folder.path());
        let off = CancellationToken::new();
        let keeper = tokio::spawn(Arc::clone(&rejected).keep(off.clone()));
        let path = folder.path().join(FILE);
        rejected.record(&[certificate(0)], HOME, &untrusted());
        let begun = Instant::now();
        while !path.exists() {
            assert!(begun.elapsed() < Duration::from_secs(60), "not written");
            tokio::time::sleep(Duration::from_millis(5)).await;
        }
        for i in 1..50 {
            rejected.record(&[certificate(i)], HOME, &untrusted());
            tokio::time::sleep(Duration::from_millis(2)).await;
        }
        assert_eq!(open(folder.path()).list().len(), 1, "written again too soon");
        off.cancel();
        keeper.await.unwrap();
        rejected.write_soon().await;
        assert_eq!(open(folder.path()).list(), rejected.list());
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt as _;
            assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o600);
        }
    }

    #[test]
    fn a_full_disk_costs_the_file_but_not_the_list() {
        let folder = tempfile::tempdir().unwrap();
        let faults = Faults::default();
        let rejected = RejectedClients::open(folder.path(), faults.clone(), &state());
        let entry = |i: u32| {
            let certificate = certificate(i);
            RejectedEntry::moved(Base64Bytes(certificate.der().to_vec()), certificate.thumbprint_sha1(), Utc::now())
        };
        rejected.insert(vec![entry(1)]);
        rejected.write().unwrap();
        faults.update(|switches| switches.disk_full = true);
        let one = certificate(1).thumbprint_sha1();
        rejected.remove(std::slice::from_ref(&one)).unwrap_err();
        assert_eq!(rejected.list().len(), 1, "what the disk still holds is not forgotten");
        faults.update(|switches| switches.disk_full = false);
        rejected.remove(&[one]).unwrap();
        assert_eq!(open(folder.path()).list(), []);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "nothing half written is left");
    }

    #[test]
    fn what_is_taken_back_leaves_the_list_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let rejected = open(folder.path());
        let known = certificate(0);
        for number in 0..u32::try_from(MAX_ENTRIES).unwrap() {
            rejected.record(&[certificate(number)], IpAddr::from([10, 0, 0, 1]), &untrusted());
        }
        let before = rejected.list();
        let moved = |certificate: &Certificate| {
            let der = Base64Bytes(certificate.der().to_vec());
            RejectedEntry::moved(der, certificate.thumbprint_sha1(), Utc::now())
        };
        let new = certificate(9999);
        let thumbprints = [known.thumbprint_sha1(), new.thumbprint_sha1()];
        let displaced = rejected.insert(vec![moved(&known), moved(&new)]);
        assert_eq!(displaced.len(), 2, "the former entry of one, and the oldest for the other");
        rejected.take_back(&thumbprints, displaced);
        let order = |mut list: Vec<RejectedClient>| {
            list.sort_by_key(|client| client.summary.thumbprint.clone());
            list
        };
        assert_eq!(order(rejected.list()), order(before));
    }

    #[test]
    fn a_damaged_file_is_put_aside() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(FILE), b"[{").unwrap();
        assert_eq!(open(folder.path()).list(), []);
        assert!(folder.path().join("rejected.damaged").exists());
        assert!(!folder.path().join(FILE).exists());
    }

    #[test]
    fn a_process_killed_between_two_files_leaves_a_certificate_in_one_list() {
        let folder = tempfile::tempdir().unwrap();
        let rejected = open(folder.path());
        let moved = certificate(1);
        let listed = |certificate: &Certificate, added| TrustListCertificate {
            file_name: "client.der".to_owned(),
            certificate: Base64Bytes(certificate.der().to_vec()),
            added,
        };
        let der = Base64Bytes(moved.der().to_vec());
        rejected.insert(vec![RejectedEntry::moved(der, moved.thumbprint_sha1(), Utc::now())]);
        rejected.write().unwrap();
        for i in [2, 3, 4] {
            rejected.record(&[certificate(i)], HOME, &untrusted());
        }
        rejected.write().unwrap();
        let (past, future) = (Utc::now() - chrono::TimeDelta::hours(1), Utc::now() + chrono::TimeDelta::hours(1));
        // Moved here from the trusted list, but still there; trusted since; and refused again although it is trusted.
        let trusted = vec![listed(&moved, past), listed(&certificate(2), future), listed(&certificate(3), past)];
        let state = ControllerState { trusted, ..state() };
        let left = RejectedClients::open(folder.path(), Faults::default(), &state).list();
        let mut left: Vec<&[u8]> = left.iter().map(|entry| entry.certificate.0.as_slice()).collect();
        left.sort_unstable();
        assert_eq!(left, [certificate(3).der(), certificate(4).der()]);
    }
}
