use opcua_configurator::jobs::{BasicSettingsChange, SelfSigned, SelfSignedFields, SetBasicSettings, StartServer};
use opcua_configurator::model::{KeyLength, SecurityPolicy, UserTokenPolicy, Validity};
use opcua_configurator::virtual_controller::FleetFirmware;
use opcua_configurator::virtual_controller::cell::CellHandle;

use crate::common::test_fleet::TestFleet;

/// More packets than any story reads.
const RECORD_LIMIT: usize = 100_000;

/// A controller whose server is open to everybody, in this process, so that the record of its cell can be compared.
pub struct OpenServer {
    pub fleet: TestFleet,
    pub folder: tempfile::TempDir,
}

impl OpenServer {
    pub async fn start() -> Self {
        let server = Self {
            fleet: TestFleet::start(1, FleetFirmware::Current).await,
            folder: tempfile::tempdir().expect("a temporary folder"),
        };
        let change = BasicSettingsChange {
            security_policies: Some([SecurityPolicy::None].into()),
            user_tokens: Some([UserTokenPolicy::Anonymous].into()),
            ..BasicSettingsChange::default()
        };
        let certificate = SelfSigned {
            fields: SelfSignedFields {
                common_name: None,
                country: "JP".into(),
                state: "Nagano".into(),
                locality: "Suwa".into(),
                organisation: "Example".into(),
                key_length: KeyLength::Rsa2048,
                validity: Validity::try_from(1).expect("a validity"),
            },
            backup: None,
        };
        for report in server.fleet.run(SetBasicSettings { change, ..SetBasicSettings::default() }).await {
            assert!(report.result.is_ok(), "{report:?}");
        }
        for report in server.fleet.run(certificate).await {
            assert!(report.result.is_ok(), "{report:?}");
        }
        for report in server.fleet.run(StartServer).await {
            assert!(report.result.is_ok(), "{report:?}");
        }
        server.keep_record();
        server
    }

    /// Keeps what is read from now on.
    pub fn keep_record(&self) {
        self.cell().keep_record(RECORD_LIMIT);
    }

    pub fn cell(&self) -> &CellHandle {
        self.fleet.controller(0).cell()
    }
}
