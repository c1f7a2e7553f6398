use std::sync::Arc;

use async_trait::async_trait;
use parking_lot::Mutex;

use super::nodes::{self, DataNodes};
use super::settings::{RecordSettings, Source};
use super::source::{Delivery, ErrorStatus, PacketSource, SourceConnector, SourceError, SourceStatus};
use crate::model::opcua::{DataValue, NodeId, Value};
use crate::session::opcua_client::{ClientSession, ControllerServer, OpcUaClient, UserLogin};

/// Opens sessions with the OPC UA server of one controller.
#[derive(Debug)]
pub struct OpcUaConnector {
    /// Where the server is, and which certificate it must show.
    pub server: ControllerServer,
    /// What this program connects with.
    pub client: Arc<OpcUaClient>,
    /// Who logs in.
    pub login: UserLogin,
    /// What is recorded.
    pub settings: RecordSettings,
    found_values: FoundValues,
}

/// The settings that the controller had before the first connection.
type FoundValues = Arc<Mutex<Option<Vec<(NodeId, Value)>>>>;

impl OpcUaConnector {
    /// For one recording.
    pub fn new(server: ControllerServer, client: Arc<OpcUaClient>, login: UserLogin, settings: RecordSettings) -> Self {
        Self { server, client, login, settings, found_values: FoundValues::default() }
    }
}

#[async_trait]
impl SourceConnector for OpcUaConnector {
    async fn connect(&self) -> Result<Box<dyn PacketSource>, SourceError> {
        let session = self.server.connect(&self.client, &self.login).await?;
        let found = nodes::find(&session, &self.settings).await?;
        let nodes = found.unwrap_or_else(|| nodes::of_manual(&self.settings));
        Ok(Box::new(OpcUaSource { session, nodes, found_values: self.found_values.clone() }))
    }
}

/// The data nodes of a controller in one session.
#[derive(Debug)]
pub struct OpcUaSource {
    session: ClientSession,
    nodes: DataNodes,
    found_values: FoundValues,
}

#[async_trait]
impl PacketSource for OpcUaSource {
    /// DataType, DataNum, and last SamplingInterval or Port: the manual sets Port after DataNum.
    async fn configure(&mut self, settings: &RecordSettings) -> Result<(), SourceError> {
        let DataNodes { data_type, data_num, third, .. } = &self.nodes;
        let (kind, wanted) = match settings.source() {
            Source::Force { data_type, .. } => {
                ("force sensor", [("DataType", Value::UInt16(data_type.number())), ("Port", Value::Boolean(true))])
            }
            Source::Motion { sampling_interval } => (
                "motion log",
                [("DataType", Value::UInt16(0)), ("SamplingInterval", Value::UInt16(sampling_interval.into()))],
            ),
        };
        let nodes = [data_type, data_num, third].map(Clone::clone);
        let found = self.session.read(&nodes).await.map_err(SourceError::Session)?;
        if found.iter().any(|value| value.quality.is_bad()) {
            return Err(SourceError::NoNodes(kind));
        }
        let [(_, first), (third_name, third)] = wanted;
        let wanted = [first, Value::UInt16(settings.data_num()), third];
        self.found_values
            .lock()
            .get_or_insert_with(|| nodes.iter().cloned().zip(found.into_iter().map(|found| found.value)).collect());
        let values: Vec<(NodeId, Value)> = nodes.into_iter().zip(wanted).collect();
        let written = self.session.write(&values).await.map_err(SourceError::Session)?;
        let names = ["DataType", "DataNum", third_name];
        match names.into_iter().zip(written).find(|(_, quality)| quality.is_bad()) {
            Some((node, quality)) => Err(SourceError::SettingRefused { node, status: quality.name().to_owned() }),
            None => Ok(()),
        }
    }

    async fn status(&mut self) -> Result<SourceStatus, SourceError> {
        let DataNodes { running, data_exists, error, .. } = &self.nodes;
        let values = self.values([running, data_exists, error]).await?;
        let [running, data_exists, error] = &values;
        Ok(SourceStatus {
            is_running: text(running, "MonitorStatus")? == "Run",
            has_data: text(data_exists, "DataExistsStatus")? == "Ready",
            error: error_status(error)?,
        })
    }

    /// One request reads the nodes in this order: a `Warning` that the read of `Data` sets back is seen before.
    async fn read(&mut self) -> Result<Delivery, SourceError> {
        let DataNodes { data, data_exists, error, .. } = &self.nodes;
        let [error, data, data_exists] = self.values([error, data, data_exists]).await?;
        let packet = match data.value {
            Value::ByteString(bytes) if !bytes.is_empty() => Some(bytes),
            Value::ByteString(_) | Value::Null => None,
            other => return Err(SourceError::OddValue { node: "Data", value: other.type_name() }),
        };
        Ok(Delivery {
            error: error_status(&error)?,
            packet,
            has_more: text(&data_exists, "DataExistsStatus")? == "Ready",
        })
    }

    async fn close(self: Box<Self>) {
        let found = self.found_values.lock().clone().unwrap_or_default();
        if !found.is_empty()
            && let Err(failure) = self.session.write(&found).await
        {
            tracing::debug!(cause = %failure.cause, "the settings of the controller stay changed");
        }
        self.session.close().await;
    }
}

impl OpcUaSource {
    async fn values<const N: usize>(&self, nodes: [&NodeId; N]) -> Result<[DataValue; N], SourceError> {
        let nodes = nodes.map(Clone::clone);
        let values = self.session.read(&nodes).await.map_err(SourceError::Session)?;
        let odd =
            |values: Vec<DataValue>| SourceError::OddValue { node: "Data", value: format!("{} values", values.len()) };
        values.try_into().map_err(odd)
    }
}

fn text<'a>(value: &'a DataValue, node: &'static str) -> Result<&'a str, SourceError> {
    let odd = || SourceError::OddValue { node, value: format!("{} ({})", value.value, value.quality.name()) };
    value.value.as_text().ok_or_else(odd)
}

fn error_status(value: &DataValue) -> Result<ErrorStatus, SourceError> {
    match text(value, "ErrorStatus")? {
        "None" => Ok(ErrorStatus::None),
        "Warning" => Ok(ErrorStatus::Warning),
        "Error" => Ok(ErrorStatus::Error),
        other => Err(SourceError::OddValue { node: "ErrorStatus", value: other.to_owned() }),
    }
}
