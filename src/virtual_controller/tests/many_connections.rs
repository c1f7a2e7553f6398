use std::collections::BTreeSet;

use super::test_controller::{ApiClient, LOOPBACK, bounded};
use crate::model::{ErrorCode, FirmwareGeneration, ServerStatus};
use crate::protocol;
use crate::protocol::Request as _;
use crate::virtual_controller::cell::CellOptions;
use crate::virtual_controller::remote::RemoteOptions;
use crate::virtual_controller::{
    AdmissionOptions, DEMO_COUNT, DEMO_PASSWORD, Fleet, FleetConfig, FleetError, FleetFirmware, demo_fleet,
};

fn config(data: &std::path::Path, count: usize) -> FleetConfig {
    FleetConfig {
        count,
        bind: LOOPBACK,
        management_port: 0,
        opcua_port: 0,
        firmware: FleetFirmware::Mixed,
        activated: true,
        password: "fleet".into(),
        data: data.to_owned(),
        admission: AdmissionOptions::default(),
        cell: CellOptions::default(),
        remote: RemoteOptions::default(),
        seed: 7,
    }
}

#[tokio::test]
async fn a_fleet_is_the_same_for_the_same_seed_and_keeps_its_state() {
    bounded(async {
        let data = tempfile::tempdir().unwrap();
        let fleet = Fleet::start(config(data.path(), 20)).await.unwrap();
        assert!(matches!(Fleet::start(config(data.path(), 1)).await, Err(FleetError::Busy { .. })));
        let lines: Vec<_> = fleet.controllers().iter().map(|c| c.ready_line()).collect();
        let distinct = |of: fn(&crate::virtual_controller::ReadyLine) -> &String| {
            lines.iter().map(of).collect::<BTreeSet<_>>().len()
        };
        assert_eq!((distinct(|l| &l.name), distinct(|l| &l.management), distinct(|l| &l.opcua)), (20, 20, 20));
        let current = lines.iter().filter(|l| l.firmware.generation() == FirmwareGeneration::Current).count();
        assert_eq!(current, 10);
        assert!(lines.iter().all(|line| line.series.check_firmware(line.firmware).is_ok()));
        let json = serde_json::to_string(&lines[0]).unwrap();
        assert!(!json.contains('\n'));
        for controller in fleet.controllers() {
            ApiClient::new(controller).login("fleet").await.unwrap();
        }
        fleet.shutdown().await;

        let again = Fleet::start(config(data.path(), 20)).await.unwrap();
        for (line, controller) in lines.iter().zip(again.controllers()) {
            assert_eq!((line.serial.clone(), line.fingerprint), (controller.serial(), controller.fingerprint()));
            assert_eq!(line.opcua, controller.endpoint());
        }
        again.shutdown().await;
    })
    .await;
}

#[tokio::test]
async fn a_fleet_that_does_not_fit_is_refused() {
    let data = tempfile::tempdir().unwrap();
    let many = Fleet::start(config(data.path(), 10_000)).await;
    assert!(matches!(many, Err(FleetError::TooMany { .. })));
    let ports = Fleet::start(FleetConfig { management_port: 65_530, ..config(data.path(), 10) }).await;
    assert!(matches!(ports, Err(FleetError::Ports { first: 65_530, .. })));
}

#[tokio::test(flavor = "multi_thread")]
async fn the_demo_has_something_of_everything() {
    bounded(async {
        let data = tempfile::tempdir().unwrap();
        let demo = demo_fleet(data.path(), LOOPBACK, DEMO_COUNT + 2, 0).await.unwrap();
        assert_eq!((demo.entries().len(), demo.controllers().len()), (DEMO_COUNT + 2, DEMO_COUNT + 1));
        let infos: Vec<_> = demo.controllers().iter().map(|c| c.info()).collect();
        let errors: Vec<_> = infos.iter().filter_map(|info| info.error).collect();
        assert_eq!(errors, [ErrorCode::PortConflict]);
        assert_eq!(infos.iter().filter(|info| info.status == ServerStatus::Run).count(), 5);
        assert_eq!(infos.iter().filter(|info| !info.activated).count(), 1);
        let now = chrono::Utc::now();
        let days: Vec<i64> = infos
            .iter()
            .filter_map(|info| info.certificate.as_ref())
            .map(|certificate| (certificate.summary.not_after - now).num_days())
            .collect();
        assert!(days.iter().any(|days| *days < 0) && days.iter().any(|days| (10..=12).contains(days)), "{days:?}");
        assert!(demo.entries().iter().any(|entry| entry.name.as_str().chars().count() == 32));
        let entry = &demo.entries()[0];
        assert_eq!(entry.address.to_string(), demo.controllers()[0].management_address().to_string());
        let mut client = ApiClient::new(&demo.controllers()[0]);
        client.login(DEMO_PASSWORD).await.unwrap();
        client.get::<serde_json::Value>(protocol::GetInfo::PATH).await.unwrap();
        let nobody = demo.entries().iter().find(|entry| entry.fingerprint.is_none()).unwrap();
        assert!(std::net::TcpStream::connect(nobody.address.authority()).is_err());
        demo.shutdown().await;
    })
    .await;
}

/// `cargo test --lib -- --ignored --nocapture five_hundred`
#[cfg(target_os = "linux")]
#[tokio::test(flavor = "multi_thread")]
#[ignore = "a measurement, for people"]
async fn five_hundred_stopped_controllers_cost_little() {
    fn resident_kb() -> usize {
        let status = std::fs::read_to_string("/proc/self/status").unwrap();
        let line = status.lines().find(|line| line.starts_with("VmRSS")).unwrap();
        line.split_whitespace().nth(1).unwrap().parse().unwrap()
    }
    bounded(async {
        let data = tempfile::tempdir().unwrap();
        // What a process pays once.
        Fleet::start(config(&data.path().join("one"), 1)).await.unwrap().shutdown().await;
        let (before, asked) = (resident_kb(), std::time::Instant::now());
        let fleet = Fleet::start(config(&data.path().join("many"), 500)).await.unwrap();
        let (after, started) = (resident_kb(), asked.elapsed());
        println!("{} KB each, {started:?} to start 500", (after - before) / 500);
        let asked = std::time::Instant::now();
        let mut logins = tokio::task::JoinSet::new();
        for controller in fleet.controllers() {
            let mut client = ApiClient::new(controller);
            logins.spawn(async move { client.login("fleet").await.unwrap() });
        }
        while logins.join_next().await.is_some() {}
        println!("{:?} for 500 logins; {} KB each after", asked.elapsed(), (resident_kb() - before) / 500);
        let asked = std::time::Instant::now();
        fleet.shutdown().await;
        println!("{:?} to stop", asked.elapsed());
        assert!((after - before) / 500 < 100);
    })
    .await;
}
