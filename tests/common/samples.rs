//! Controllers as a workspace remembers them.

use chrono::{DateTime, Duration, Utc};
use opcua_configurator::model::{
    CertificateSummary, CertificateType, ConnectionKind, ControllerInfo, ControllerSeries, ErrorCode, FirmwareVersion,
    ListLimits, RevisionToken, ServerCertificate, ServerStatus,
};
use opcua_configurator::pki::Fingerprint;
use opcua_configurator::workspace::{Configuration, ControllerEntry, RetrievedInfo};

const NAMES: [&str; 12] = [
    "Weld 1",
    "Weld 2",
    "Weld 10",
    "Paint booth",
    "Palletiser north",
    "Palletiser south",
    "Assembly A",
    "Assembly B",
    "焊接单元 3",
    "Test bench in hall 4 with a long na",
    "Press feeder",
    "Packing",
];

/// `count` controllers of every kind, as of `now`.
pub fn configuration(count: usize, now: DateTime<Utc>) -> Configuration {
    let mut configuration = Configuration::default();
    configuration.controllers = (0..count).map(|n| entry(n, now)).collect();
    configuration
}

pub fn entry(n: usize, now: DateTime<Utc>) -> ControllerEntry {
    let name: String = match NAMES.get(n) {
        Some(name) => name.chars().take(32).collect(),
        None => format!("Robot {n}"),
    };
    let series = ControllerSeries::ALL[(n * 7 + 3) % 4];
    let address = format!("192.168.{}.{}", 10 + n / 250, 1 + n % 250);
    ControllerEntry {
        name: name.parse().unwrap(),
        address: address.parse().unwrap(),
        series,
        connection: ConnectionKind::Management,
        fingerprint: Some(Fingerprint::of(&n.to_be_bytes())),
        last: (n % 12 != 6)
            .then(|| RetrievedInfo { at: now - Duration::minutes(n as i64 * 7), info: info(n, now, series) }),
    }
}

pub fn info(n: usize, now: DateTime<Utc>, series: ControllerSeries) -> ControllerInfo {
    let firmware = match series {
        ControllerSeries::Rc800 => FirmwareVersion::new(8, 0, 1),
        _ => FirmwareVersion::new(7, 5, 54),
    };
    let status =
        [ServerStatus::Run, ServerStatus::Run, ServerStatus::Stop, ServerStatus::Run, ServerStatus::Error][n % 5];
    let days = [400, 1200, 12, 90, -3, 700, 1500][n % 7];
    let kind = [CertificateType::SelfSigned, CertificateType::SelfSigned, CertificateType::CaSigned][n % 3];
    let serial = format!("SN{:07}", 123 + n * 1_337);
    let summary = CertificateSummary {
        issued_to: format!("EpsonRC.{serial}"),
        issued_by: format!("EpsonRC.{serial}"),
        serial_number: "01".into(),
        not_before: now - Duration::days(100),
        not_after: now + Duration::days(days),
        thumbprint: "00".repeat(20),
        key_bits: 2048,
        application_uri: None,
    };
    let has_certificate = n % 9 != 7;
    ControllerInfo {
        name: "RC".into(),
        application_name: format!("EpsonRC.{serial}.192.168.010.{:03}", 1 + n % 250),
        serial: serial.parse().unwrap(),
        series,
        firmware,
        status,
        error: (status == ServerStatus::Error).then_some(ErrorCode::PortConflict),
        activated: n % 6 != 5,
        certificate: has_certificate.then_some(ServerCertificate { kind, summary }),
        endpoint: format!("opc.tcp://192.168.10.{}:4840", 1 + n % 250),
        used_ports: vec![2000, 5000],
        limits: ListLimits::of(firmware.generation()),
        clock: now,
        revision: RevisionToken::new(4),
    }
}
