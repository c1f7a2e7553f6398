use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use chrono::{DateTime, Duration, TimeZone as _, Utc};
use secrecy::SecretString;

use super::*;
use crate::model::{
    AuthorityRequest, AuthorityValidity, CertificateProfile, CsrRequest, ErrorCode, KeyLength, Problem, Subject,
    Validity,
};
use crate::pki::{Csr, IssueRequest, PrivateKey, RevocationReason, ServerNames, make_csr, read_key_file};
use crate::workspace::Workspace;

fn now() -> DateTime<Utc> {
    Utc.with_ymd_and_hms(2030, 6, 15, 12, 0, 0).unwrap()
}

fn passphrase() -> SecretString {
    SecretString::from("correct horse")
}

fn subject(common_name: &str) -> Subject {
    Subject {
        common_name: common_name.into(),
        country: "JP".into(),
        state: String::new(),
        locality: String::new(),
        organisation: "Example".into(),
    }
}

fn ca(common_name: &str) -> AuthorityRequest {
    AuthorityRequest {
        subject: subject(common_name),
        key_length: KeyLength::Rsa2048,
        validity: AuthorityValidity::default(),
    }
}

fn new(intermediate: bool) -> NewAuthority {
    NewAuthority {
        root: ca("Plant root"),
        intermediate: intermediate.then(|| ca("Plant CA")),
        crl_days: DEFAULT_CRL_DAYS,
    }
}

fn csr() -> &'static Csr {
    static CSR: LazyLock<Csr> = LazyLock::new(|| {
        let key = PrivateKey::generate(KeyLength::Rsa2048).unwrap();
        let request = CsrRequest { subject: subject("robot"), key_length: KeyLength::Rsa2048 };
        let names = ServerNames { application_uri: "urn:robot".into(), ips: vec![], dns: vec!["robot".into()] };
        make_csr(&request, &names, &key).unwrap()
    });
    &CSR
}

fn server() -> IssueRequest {
    IssueRequest {
        profile: CertificateProfile::Server,
        validity: Validity::try_from(2).unwrap(),
        names: None,
        allow_short_keys: false,
    }
}

fn code<T: std::fmt::Debug>(result: Result<T, AuthorityError>) -> ErrorCode {
    Problem::from(result.expect_err("refused")).code
}

fn files(folder: &Path) -> AuthorityFiles {
    Workspace::new(folder).authority()
}

#[test]
fn a_ca_is_made_once_and_taken_up_with_its_passphrase_only() {
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    assert_eq!(code(files.overview()), ErrorCode::NoAuthority);
    assert_eq!(code(files.open(&passphrase())), ErrorCode::NoAuthority);
    assert!(!files.folder().exists(), "asking leaves nothing behind");
    assert_eq!(code(files.create(&new(false), &SecretString::from("short"), now())), ErrorCode::BadPassphrase);
    let made = files.create(&new(false), &passphrase(), now()).unwrap().overview().unwrap();
    assert_eq!((made.signing.summary.issued_to.as_str(), made.root.is_none()), ("Plant root", true));
    assert_eq!(code(files.create(&new(false), &passphrase(), now())), ErrorCode::AuthorityExists);
    assert_eq!(files.overview().unwrap(), made);
    assert_eq!(code(files.open(&SecretString::from("correct house"))), ErrorCode::AuthorityPassphrase);
    assert_eq!(files.open(&passphrase()).unwrap().overview().unwrap(), made);

    let pem = fs::read(files.folder().join("ca.key")).unwrap();
    assert!(read_key_file(&pem, Some("correct horse")).unwrap().matches(&made.signing.certificate));
    assert_eq!(fs::read(files.folder().join("ca.der")).unwrap(), made.signing.certificate.der());
    assert_eq!(fs::read(files.folder().join("ca.crl")).unwrap(), made.signing.crl.der());
    #[cfg(unix)]
    for entry in fs::read_dir(files.folder()).unwrap() {
        use std::os::unix::fs::PermissionsExt as _;
        let entry = entry.unwrap();
        let mode = entry.metadata().unwrap().permissions().mode() & 0o077;
        assert!(mode == 0 || entry.file_name() == ".lock", "{entry:?}");
    }
}

#[test]
fn only_one_at_a_time_works_with_it() {
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    let held = files.create(&new(false), &passphrase(), now()).unwrap();
    assert_eq!(code(files.open(&passphrase())), ErrorCode::AuthorityBusy);
    files.overview().expect("looking is always allowed");
    drop(held);
    files.open(&passphrase()).unwrap();
}

#[test]
fn what_was_signed_is_written_down_and_a_second_time_only_as_a_renewal() {
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    let mut authority = files.create(&new(true), &passphrase(), now()).unwrap();
    let (first, path) = authority.sign(csr(), &server(), false, now()).unwrap();
    assert_eq!(fs::read(path).unwrap(), first.der());
    assert_eq!(first.summary().issued_by, "Plant CA");
    let later = now() + Duration::days(30);
    assert_eq!(code(authority.sign(csr(), &server(), false, later)), ErrorCode::AlreadySigned);
    let (second, _) = authority.sign(csr(), &server(), true, later).unwrap();
    let serial = second.summary().serial_number;
    assert_eq!(authority.valid_for(csr(), later).unwrap().serial_number, serial, "the newest");
    authority.revoke(&[first.summary().serial_number, serial], RevocationReason::Superseded, later).unwrap();
    assert_eq!(authority.valid_for(csr(), later), None);
    let (third, _) = authority.sign(csr(), &server(), false, later).unwrap();
    let end = third.not_after() + Duration::seconds(1);
    assert_eq!(authority.valid_for(csr(), end), None, "it has expired");
    drop(authority);

    let issued = files.overview().unwrap().issued;
    let states: Vec<_> = issued.iter().map(|issued| issued.state(end)).collect();
    assert_eq!(states, [CertificateState::Revoked, CertificateState::Revoked, CertificateState::Expired]);
    assert_eq!(issued[2].state(later), CertificateState::Valid);
    assert_eq!(files.issued(&issued[2].serial_number).unwrap(), third);
}

/// Between the entry in the database and the file of the certificate the program stops: the folder of the files is gone
/// as far as it can see, which is the same moment as a kill.
#[test]
fn a_certificate_without_its_file_gets_it_when_the_ca_is_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    let mut authority = files.create(&new(false), &passphrase(), now()).unwrap();
    let issued = files.folder().join("issued");
    fs::remove_dir_all(&issued).ok();
    fs::write(&issued, "in the way").unwrap();
    assert!(authority.sign(csr(), &server(), false, now()).is_err());
    let serial_number = authority.overview().unwrap().issued[0].serial_number.clone();
    assert_eq!(code(authority.sign(csr(), &server(), false, now())), ErrorCode::AlreadySigned);
    assert!(files.issued(&serial_number).is_err());
    drop(authority);

    fs::remove_file(&issued).unwrap();
    let mut authority = files.open(&passphrase()).unwrap();
    let written = files.issued(&serial_number).unwrap();
    assert_eq!(written.thumbprint_sha1(), authority.overview().unwrap().issued[0].thumbprint);
    let (renewed, path) = authority.sign(csr(), &server(), true, now()).unwrap();
    assert_eq!(fs::read(path).unwrap(), renewed.der());
    assert_eq!(files.issued(&serial_number).unwrap(), written);
}

/// Without opening it again: the next certificate is issued by the same program.
#[test]
fn a_certificate_without_its_file_gets_it_before_the_next_one_is_issued() {
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    let mut authority = files.create(&new(false), &passphrase(), now()).unwrap();
    let issued = files.folder().join("issued");
    fs::remove_dir_all(&issued).ok();
    fs::write(&issued, "in the way").unwrap();
    assert!(authority.sign(csr(), &server(), false, now()).is_err());
    fs::remove_file(&issued).unwrap();
    authority.sign(csr(), &server(), true, now()).unwrap();
    for one in authority.overview().unwrap().issued {
        assert_eq!(files.issued(&one.serial_number).unwrap().thumbprint_sha1(), one.thumbprint);
    }
}

#[test]
fn a_draft_leaves_no_trace() {
    let folder = tempfile::tempdir().unwrap();
    let authority = files(folder.path()).create(&new(false), &passphrase(), now()).unwrap();
    authority.draft(csr(), &server(), now()).unwrap();
    assert_eq!(authority.overview().unwrap().issued, []);
    assert_eq!(authority.valid_for(csr(), now()), None);
}

#[test]
fn revoking_is_all_or_nothing_and_final() {
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    let mut authority = files.create(&new(false), &passphrase(), now()).unwrap();
    let serial = authority.sign(csr(), &server(), false, now()).unwrap().0.summary().serial_number;
    let revoke = |authority: &mut UnlockedAuthority, serials: &[&str]| {
        let serials: Vec<String> = serials.iter().map(ToString::to_string).collect();
        authority.revoke(&serials, RevocationReason::KeyCompromise, now())
    };
    let before = authority.overview().unwrap();
    assert_eq!(code(revoke(&mut authority, &["4711"])), ErrorCode::UnknownSerial);
    assert_eq!(code(revoke(&mut authority, &[&serial, "4711"])), ErrorCode::UnknownSerial);
    assert_eq!(authority.overview().unwrap(), before, "nothing was revoked");
    // As OpenSSL prints it.
    let pairs: Vec<&str> = (0..serial.len()).step_by(2).map(|at| &serial[at..at + 2]).collect();
    revoke(&mut authority, &[&pairs.join(":").to_lowercase()]).unwrap();
    assert_eq!(code(revoke(&mut authority, &[&serial])), ErrorCode::AlreadyRevoked);
    let after = authority.overview().unwrap();
    assert_eq!(after.issued[0].revoked.unwrap().reason, RevocationReason::KeyCompromise);
    assert_eq!(after.signing.crl_number, before.signing.crl_number + 1);
    assert_eq!(fs::read(files.folder().join("ca.crl")).unwrap(), after.signing.crl.der());
}

#[test]
fn crl_numbers_only_ever_grow_also_when_the_clock_goes_back_or_a_backup_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    let mut authority = files.create(&new(true), &passphrase(), now()).unwrap();
    let numbers = |authority: &UnlockedAuthority| {
        let overview = authority.overview().unwrap();
        (overview.signing.crl_number, overview.root.unwrap().crl_number)
    };
    let (signing, root) = numbers(&authority);
    assert_eq!((signing, root), (now().timestamp() as u64, now().timestamp() as u64));
    authority.publish_crl(None, now() - Duration::hours(5)).unwrap();
    assert_eq!(numbers(&authority), (signing + 1, root + 1));
    let backup = folder.path().join("ca.backup");
    authority.back_up(&backup, now()).unwrap();
    authority.publish_crl(Some(30), now() + Duration::days(1)).unwrap();
    let published = numbers(&authority).0;
    assert_eq!(authority.overview().unwrap().signing.crl.next_update(), Some(now() + Duration::days(31)));
    drop(authority);
    fs::remove_dir_all(files.folder()).unwrap();
    files.restore(&backup, &passphrase()).unwrap();
    let mut authority = files.open(&passphrase()).unwrap();
    authority.publish_crl(None, now() + Duration::days(2)).unwrap();
    assert!(numbers(&authority).0 > published);
}

#[test]
fn without_the_roots_key_the_intermediate_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    let before = files.create(&new(true), &passphrase(), now()).unwrap().overview().unwrap();
    fs::rename(files.folder().join("root.key"), folder.path().join("in the safe")).unwrap();
    let mut authority = files.open(&passphrase()).unwrap();
    authority.sign(csr(), &server(), false, now()).unwrap();
    authority.publish_crl(None, now()).unwrap();
    let after = authority.overview().unwrap();
    assert!(after.signing.crl_number > before.signing.crl_number);
    assert_eq!(after.root.unwrap().crl, before.root.unwrap().crl);
}

#[test]
fn damage_is_said_so_and_never_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    let mut authority = files.create(&new(false), &passphrase(), now()).unwrap();
    authority.sign(csr(), &server(), false, now()).unwrap();
    drop(authority);
    let path = files.folder().join("ca.json");
    let whole = fs::read_to_string(&path).unwrap();
    let serial = files.overview().unwrap().issued[0].serial_number.clone();
    for damaged in [
        String::new(),
        whole[..whole.len() / 2].to_owned(),
        whole.replace("\"version\": 1", "\"version\": 2"),
        whole.replace(&serial, "../../../escape"),
        whole.replace("\"certificate\": \"MII", "\"certificate\": \"MIX"),
    ] {
        fs::write(&path, &damaged).unwrap();
        assert_eq!(code(files.overview()), ErrorCode::AuthorityDamaged);
        assert_eq!(code(files.open(&passphrase())), ErrorCode::AuthorityDamaged);
        assert_eq!(code(files.create(&new(false), &passphrase(), now())), ErrorCode::AuthorityExists);
        assert_eq!(fs::read_to_string(&path).unwrap(), damaged);
    }
    fs::write(&path, &whole).unwrap();
    let key = files.folder().join("ca.key");
    let pem = fs::read(&key).unwrap();
    for damaged in [&b""[..], b"hello", &pem[..pem.len() / 2]] {
        fs::write(&key, damaged).unwrap();
        assert_eq!(code(files.open(&passphrase())), ErrorCode::AuthorityDamaged);
    }
    let other = super::super::Workspace::new(folder.path().join("other")).authority();
    drop(other.create(&new(false), &passphrase(), now()).unwrap());
    fs::copy(other.folder().join("ca.key"), &key).unwrap();
    assert_eq!(code(files.open(&passphrase())), ErrorCode::AuthorityDamaged, "the key of another CA");
    fs::remove_file(&key).unwrap();
    assert_eq!(code(files.open(&passphrase())), ErrorCode::AuthorityDamaged);
}

#[test]
fn copies_are_made_again_and_a_key_left_over_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    fs::create_dir_all(files.folder()).unwrap();
    fs::write(files.folder().join("ca.key"), "of a creation that was broken off").unwrap();
    let made = files.create(&new(false), &passphrase(), now()).unwrap().overview().unwrap();
    let left: Vec<_> = fs::read_dir(files.folder())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.to_string_lossy().contains("ca.left-"))
        .collect();
    assert_eq!(fs::read(&left[0]).unwrap(), b"of a creation that was broken off");
    fs::write(files.folder().join("ca.crl"), "old").unwrap();
    fs::remove_file(files.folder().join("ca.der")).unwrap();
    files.open(&passphrase()).unwrap();
    assert_eq!(fs::read(files.folder().join("ca.crl")).unwrap(), made.signing.crl.der());
    assert_eq!(fs::read(files.folder().join("ca.der")).unwrap(), made.signing.certificate.der());
}

#[test]
fn a_backup_never_takes_the_place_of_what_it_backs_up() {
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    let authority = files.create(&new(false), &passphrase(), now()).unwrap();
    let key = fs::read(files.folder().join("ca.key")).unwrap();
    for path in ["ca.key", "ca.json", "new/backup.json", "../CA/ca.key"] {
        assert!(authority.back_up(&files.folder().join(path), now()).is_err(), "{path}");
    }
    assert_eq!(fs::read(files.folder().join("ca.key")).unwrap(), key);
    authority.back_up(&folder.path().join("CA-backup.json"), now()).unwrap();
    drop(authority);
    files.open(&passphrase()).unwrap();
}

#[test]
fn a_backup_brings_everything_back_to_those_who_know_the_passphrase() {
    let folder = tempfile::tempdir().unwrap();
    let old = files(&folder.path().join("old"));
    let mut authority = old.create(&new(true), &passphrase(), now()).unwrap();
    let (certificate, _) = authority.sign(csr(), &server(), false, now()).unwrap();
    let backup = folder.path().join("ca.backup");
    authority.back_up(&backup, now()).unwrap();
    let before = authority.overview().unwrap();
    drop(authority);
    assert_eq!(code(old.restore(&backup, &passphrase())), ErrorCode::AuthorityExists);

    let restored = files(&folder.path().join("new"));
    let wrong = restored.restore(&backup, &SecretString::from("correct house"));
    assert_eq!(code(wrong), ErrorCode::BackupPassphrase);
    let whole = fs::read(&backup).unwrap();
    let bad = folder.path().join("bad.backup");
    for damaged in
        [&b""[..], b"{}", &whole[..whole.len() - 20], old.folder().join("ca.json").to_string_lossy().as_bytes()]
    {
        fs::write(&bad, damaged).unwrap();
        assert_eq!(code(restored.restore(&bad, &passphrase())), ErrorCode::BackupDamaged);
    }
    assert_eq!(code(restored.restore(folder.path(), &passphrase())), ErrorCode::FileUnreadable);
    assert!(!restored.exist());

    let after = restored.restore(&backup, &passphrase()).unwrap();
    assert_eq!(AuthorityOverview { folder: before.folder.clone(), ..after }, before);
    let serial = &before.issued[0].serial_number;
    assert_eq!(restored.issued(serial).unwrap(), certificate);
    let mut authority = restored.open(&passphrase()).unwrap();
    authority.revoke(std::slice::from_ref(serial), RevocationReason::Superseded, now()).unwrap();
}
