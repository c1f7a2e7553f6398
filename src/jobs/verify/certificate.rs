use std::collections::BTreeSet;

use chrono::{DateTime, Utc};

use super::report::CertificateVerdict;
use crate::model::SecurityPolicy;
use crate::pki::{Certificate, Expected, Presented, Rejection, Role, TrustLists, TrustPolicy, preflight};

/// What the certificate of a server is compared with.
pub(super) struct Wanted<'a> {
    /// What the management session says is selected: the one certificate that is trusted here.
    pub selected: Option<&'a Certificate>,
    /// As the server announces it.
    pub application_uri: &'a str,
    /// As the engineer wrote it.
    pub host: &'a str,
    /// Those offered.
    pub policies: &'a BTreeSet<SecurityPolicy>,
    /// This computer's clock.
    pub now: DateTime<Utc>,
    /// What the findings speak of.
    pub controllers_clock: DateTime<Utc>,
}

/// Judges what a server shows as a careful client does. Blocks for some signature checks.
///
/// The session with the controller vouches for the certificate itself, so neither its issuer nor a revocation list is
/// asked for.
pub(super) fn judge(shown: &Certificate, chain: &[Certificate], wanted: &Wanted<'_>) -> CertificateVerdict {
    let lists = TrustLists::new(wanted.selected.cloned().into_iter().collect(), Vec::new(), Vec::new());
    let vouched =
        TrustPolicy { allow_unknown_revocation: true, allow_incomplete_chain: true, ..TrustPolicy::default() };
    let check = |security_policy| -> Option<Rejection> {
        let presented = Presented {
            certificate: shown,
            chain,
            role: Role::Server,
            now: wanted.now,
            application_uri: Some(wanted.application_uri),
            host: Some(wanted.host),
            security_policy,
        };
        lists.validate(&presented, &vouched).err()
    };
    let mut secured = wanted.policies.iter().copied().filter(|policy| *policy != SecurityPolicy::None).peekable();
    let rejection = if secured.peek().is_some() { secured.find_map(|policy| check(Some(policy))) } else { check(None) };
    let hosts = [wanted.host.to_owned()];
    let expected = Expected {
        application_uri: wanted.application_uri,
        hosts: &hosts,
        policies: wanted.policies,
        now: wanted.controllers_clock,
    };
    CertificateVerdict { summary: shown.summary(), refused: rejection, findings: preflight(shown, &expected) }
}

#[cfg(test)]
mod tests {
    use std::sync::LazyLock;

    use chrono::Duration;
    use rcgen::{BasicConstraints, CertificateParams, DnType, IsCa, Issuer, KeyPair, KeyUsagePurpose, SanType};

    use super::*;
    use crate::model::CertificateStatus;

    const URI: &str = "urn:EpsonRC.SN1.127.000.000.001";

    static KEY: LazyLock<KeyPair> =
        LazyLock::new(|| KeyPair::generate_rsa_for(&rcgen::PKCS_RSA_SHA256, rcgen::RsaKeySize::_2048).unwrap());

    fn server(by_ca: bool, change: impl FnOnce(&mut CertificateParams)) -> Certificate {
        let mut params = CertificateParams::default();
        params.distinguished_name.push(DnType::CommonName, "EpsonRC.SN1.127.000.000.001");
        params.subject_alt_names =
            vec![SanType::URI(URI.try_into().unwrap()), SanType::IpAddress("127.0.0.1".parse().unwrap())];
        params.key_usages = vec![
            KeyUsagePurpose::DigitalSignature,
            KeyUsagePurpose::ContentCommitment,
            KeyUsagePurpose::KeyEncipherment,
            KeyUsagePurpose::DataEncipherment,
            KeyUsagePurpose::KeyCertSign,
        ];
        let now = time::OffsetDateTime::now_utc();
        (params.not_before, params.not_after) = (now - time::Duration::DAY, now + time::Duration::DAY * 300);
        change(&mut params);
        let made = if by_ca {
            let mut ca = CertificateParams::default();
            ca.distinguished_name.push(DnType::CommonName, "Plant CA");
            ca.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
            params.signed_by(&*KEY, &Issuer::new(ca, KeyPair::generate().unwrap()))
        } else {
            params.self_signed(&*KEY)
        };
        Certificate::from_der(made.unwrap().der()).unwrap()
    }

    fn status(
        shown: &Certificate,
        selected: &Certificate,
        host: &str,
        policy: SecurityPolicy,
    ) -> Option<CertificateStatus> {
        let wanted = Wanted {
            selected: Some(selected),
            application_uri: URI,
            host,
            policies: &BTreeSet::from([SecurityPolicy::None, policy]),
            now: Utc::now(),
            controllers_clock: Utc::now(),
        };
        judge(shown, &[], &wanted).refused.map(|rejection| rejection.status())
    }

    #[test]
    fn what_the_controller_names_is_trusted_whoever_issued_it() {
        let strong = SecurityPolicy::Basic256Sha256;
        for by_ca in [false, true] {
            let certificate = server(by_ca, |_| {});
            assert_eq!(status(&certificate, &certificate, "127.0.0.1", strong), None, "by a CA: {by_ca}");
            let other = server(by_ca, |params| params.serial_number = Some(vec![7].into()));
            let refused = status(&certificate, &other, "127.0.0.1", strong);
            assert!(
                matches!(refused, Some(CertificateStatus::Untrusted | CertificateStatus::ChainIncomplete)),
                "{refused:?}"
            );
        }
    }

    #[test]
    fn each_flaw_has_its_status() {
        let strong = SecurityPolicy::Basic256Sha256;
        let of = |certificate: &Certificate, host| status(certificate, certificate, host, strong);
        assert_eq!(of(&server(false, |_| {}), "robot-7"), Some(CertificateStatus::HostNameInvalid));
        let other_uri = server(false, |params| params.subject_alt_names[0] = SanType::URI("urn:x".try_into().unwrap()));
        assert_eq!(of(&other_uri, "127.0.0.1"), Some(CertificateStatus::UriInvalid));
        let no_usage = server(false, |params| params.key_usages.truncate(1));
        assert_eq!(of(&no_usage, "127.0.0.1"), Some(CertificateStatus::UseNotAllowed));
        let past = server(false, |params| params.not_after = params.not_before + time::Duration::HOUR);
        assert_eq!(of(&past, "127.0.0.1"), Some(CertificateStatus::TimeInvalid));
        assert!(past.not_after() < Utc::now() - Duration::hours(1));
    }
}
