//! Lists of whom a controller trusts, as a controller reports them.

use chrono::{DateTime, Duration, Utc};
use opcua_configurator::jobs::TrustSnapshot;
use opcua_configurator::model::{
    Base64Bytes, Capabilities, CertificateStatus, CertificateSummary, CrlSummary, Feature, FirmwareGeneration,
    ListLimits, ListedCertificate, ListedCrl, MissingReason, RevisionToken,
};
use opcua_configurator::pki::{CrlDates, CrlHealth, CrlIssuer, RejectedClient, TrustHealth};

/// A controller that holds nothing.
pub fn nothing(generation: FirmwareGeneration, clock: DateTime<Utc>) -> TrustSnapshot {
    TrustSnapshot {
        revision: RevisionToken::new(4),
        capabilities: match generation {
            FirmwareGeneration::Legacy => {
                Capabilities::all().without(&[Feature::IssuersList], MissingReason::FirmwareTooOld)
            }
            FirmwareGeneration::Current => Capabilities::all(),
        },
        limits: ListLimits::of(generation),
        clock,
        trusted: vec![],
        rejected: vec![],
        issuers: vec![],
        crls: vec![],
        health: TrustHealth::default(),
    }
}

/// A controller in a plant that has been at it for a while.
pub fn fleet(clock: DateTime<Utc>) -> TrustSnapshot {
    let mut held = nothing(FirmwareGeneration::Current, clock);
    held.trusted = vec![
        listed(1, "HMI line 3", "Plant issuing CA 1", "hmi_line_3.der", 400, clock),
        listed(
            2,
            "MES gateway (production planning, hall 4)",
            "MES gateway (production planning, hall 4)",
            "mes.der",
            12,
            clock,
        ),
        listed(3, "历史数据采集站 2 号", "Plant issuing CA 1", "historian.cer", 900, clock),
        listed(4, "Old visualisation", "Old visualisation", "old.pem", -30, clock),
    ];
    held.rejected = vec![
        refused(11, "Quality station 7", "Quality station 7", CertificateStatus::Untrusted, 14, 2, clock),
        refused(12, "Laptop of the service", "Plant issuing CA 2", CertificateStatus::ChainIncomplete, 1, 40, clock),
        refused(13, "HMI line 1", "Plant issuing CA 1", CertificateStatus::Revoked, 3021, 90, clock),
    ];
    held.issuers = vec![
        listed(21, "Plant root CA", "Plant root CA", "plant_chain_1.der", 3000, clock),
        listed(22, "Plant issuing CA 1", "Plant root CA", "plant_chain_2.der", 1500, clock),
    ];
    held.crls = vec![
        crl(31, "Plant root CA", 0, 25, clock),
        crl(32, "Plant issuing CA 1", 3, -2, clock),
        crl(33, "Some other CA", 112, 5, clock),
    ];
    let of = |issuer, dates| CrlHealth { issuer, dates };
    held.health = TrustHealth {
        crls: vec![
            of(CrlIssuer::Held { thumbprint: thumbprint(21) }, CrlDates::Current),
            of(CrlIssuer::Held { thumbprint: thumbprint(22) }, CrlDates::Expired),
            of(CrlIssuer::Missing, CrlDates::Current),
        ],
        without_crl: vec![thumbprint(22)],
    };
    held
}

pub fn thumbprint(n: usize) -> String {
    let part = |k: u64| (n as u64 + k).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(17) as u32;
    (1..6).map(|k| format!("{:08X}", part(k))).collect()
}

pub fn listed(n: usize, to: &str, by: &str, file: &str, days: i64, clock: DateTime<Utc>) -> ListedCertificate {
    ListedCertificate {
        file_name: file.to_owned(),
        certificate: Base64Bytes(vec![0; 4]),
        summary: summary(n, to, by, days, clock),
        added: clock - Duration::days(3),
    }
}

pub fn refused(
    n: usize,
    to: &str,
    by: &str,
    status: CertificateStatus,
    count: u64,
    minutes: i64,
    clock: DateTime<Utc>,
) -> RejectedClient {
    RejectedClient {
        certificate: Base64Bytes(vec![0; 4]),
        chain: vec![],
        summary: summary(n, to, by, 700, clock),
        status,
        cause: None,
        reason: "what was found in this very certificate".to_owned(),
        address: format!("192.168.10.{}", n % 250),
        first_seen: clock - Duration::minutes(minutes * 10),
        last_seen: clock - Duration::minutes(minutes),
        count,
    }
}

pub fn crl(n: usize, issuer: &str, entries: usize, days: i64, clock: DateTime<Utc>) -> ListedCrl {
    ListedCrl {
        file_name: format!("{}.crl", issuer.to_lowercase().replace(' ', "_")),
        crl: Some(Base64Bytes(vec![0; 4])),
        summary: CrlSummary {
            issuer: issuer.to_owned(),
            this_update: clock - Duration::days(5),
            next_update: Some(clock + Duration::days(days)),
            entries,
            number: Some((n * 3).to_string()),
            id: thumbprint(n),
        },
        added: clock - Duration::days(3),
    }
}

fn summary(n: usize, to: &str, by: &str, days: i64, clock: DateTime<Utc>) -> CertificateSummary {
    CertificateSummary {
        issued_to: to.to_owned(),
        issued_by: by.to_owned(),
        serial_number: format!("{:016X}", (n as u64 + 3).wrapping_mul(0x4F1E_2D3C_4B5A_6987)),
        not_before: clock - Duration::days(200),
        not_after: clock + Duration::days(days),
        thumbprint: thumbprint(n),
        key_bits: 2048,
        application_uri: Some(format!("urn:plant:{n}")),
    }
}
