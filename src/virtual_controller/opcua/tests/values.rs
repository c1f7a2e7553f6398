//! Values of the cell over the wire: reads, subscriptions, and the node Data, which each read empties.

use std::time::Duration;

use opcua::client::{DataChangeCallback, MonitoredItem};
use opcua::types::{
    DataValue, MonitoredItemCreateRequest, NodeId, ReadValueId, StatusCode, TimestampsToReturn, Variant, WriteValue,
};
use tokio::sync::mpsc::{UnboundedReceiver, unbounded_channel};
use tokio::time::timeout;

use super::client::{Client, ClientOptions};
use super::{WAIT_LIMIT, cell, config, start};
use crate::records::motion::{BLOCK_BYTES, MotionRead};
use crate::virtual_controller::cell::{CellClock, CellCommand, CellHandle};
use crate::virtual_controller::opcua::{OpcUaConfig, OpcUaServer};

const DATA_NUM: u32 = 20_313;
const DATA: u32 = 20_316;
const DATA_EXISTS: u32 = 20_318;
const FORCE_PORT: u32 = 196_609;

/// A server over a cell whose time a test moves.
struct Running {
    server: OpcUaServer,
    cell: CellHandle,
    clock: CellClock,
    _folder: tempfile::TempDir,
}

impl Running {
    async fn start() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let clock = CellClock::manual();
        let cell = cell(clock.clone());
        let server = start(OpcUaConfig { cell: cell.clone(), ..config(&folder) }).await;
        Self { server, cell, clock, _folder: folder }
    }
}

fn own(number: u32) -> NodeId {
    NodeId::new(1, number)
}

async fn read_all(client: &Client, nodes: &[u32]) -> Vec<DataValue> {
    let nodes: Vec<ReadValueId> = nodes.iter().map(|number| ReadValueId::from(own(*number))).collect();
    timeout(WAIT_LIMIT, client.session.read(&nodes, TimestampsToReturn::Both, 0.0)).await.unwrap().unwrap()
}

async fn write(client: &Client, node: u32, value: Variant) -> StatusCode {
    let write = WriteValue::value_attr(own(node), value);
    timeout(WAIT_LIMIT, client.session.write(&[write])).await.unwrap().unwrap()[0]
}

fn bytes(value: DataValue) -> Vec<u8> {
    match value.value {
        Some(Variant::ByteString(bytes)) => bytes.value.unwrap_or_default(),
        other => panic!("no packets: {other:?}"),
    }
}

/// Every new value of the nodes, with the node.
async fn subscribe(client: &Client, nodes: &[u32]) -> UnboundedReceiver<(u32, DataValue)> {
    let (told, values) = unbounded_channel();
    let callback = DataChangeCallback::new(move |value, item: &MonitoredItem| {
        if let opcua::types::Identifier::Numeric(number) = item.item_to_monitor().node_id.identifier {
            let _ = told.send((number, value));
        }
    });
    let interval = Duration::from_millis(100);
    let created = client.session.create_subscription(interval, 100, 10, 0, 0, true, callback);
    let subscription = timeout(WAIT_LIMIT, created).await.unwrap().unwrap();
    let items = nodes.iter().map(|number| MonitoredItemCreateRequest::from(own(*number))).collect();
    let created = client.session.create_monitored_items(subscription, TimestampsToReturn::Both, items);
    for item in timeout(WAIT_LIMIT, created).await.unwrap().unwrap() {
        assert_eq!(item.result.status_code, StatusCode::Good);
    }
    values
}

/// Waits until the node has this value.
async fn wait_for(values: &mut UnboundedReceiver<(u32, DataValue)>, node: u32, value: impl Into<Variant>) {
    let value = Some(value.into());
    let seen = timeout(WAIT_LIMIT, async {
        while values.recv().await.is_some_and(|(number, seen)| number != node || seen.value != value) {}
    });
    assert!(seen.await.is_ok(), "{node} never has the value {value:?}");
}

#[tokio::test(flavor = "multi_thread")]
async fn subscribed_values_follow_the_cell_and_the_writes_of_clients() {
    let running = Running::start().await;
    let client = Client::anonymous(&running.server).await.unwrap();
    let mut values = subscribe(&client, &[DATA_EXISTS, FORCE_PORT]).await;
    wait_for(&mut values, DATA_EXISTS, "Empty").await;
    running.clock.advance(Duration::from_secs(1));
    wait_for(&mut values, DATA_EXISTS, "Ready").await;
    assert_eq!(write(&client, FORCE_PORT, true.into()).await, StatusCode::Good);
    wait_for(&mut values, FORCE_PORT, true).await;
    assert_eq!(write(&client, FORCE_PORT, 1_u16.into()).await, StatusCode::BadTypeMismatch);
    assert_eq!(write(&client, DATA_NUM, 201_u16.into()).await, StatusCode::BadOutOfRange);
    assert_eq!(write(&client, DATA, Variant::Empty).await, StatusCode::BadNotWritable);
    // No more than the 64 KiB that this client takes of a ByteString, which no client tells the server.
    assert_eq!(write(&client, DATA_NUM, 20_u16.into()).await, StatusCode::Good);
    running.cell.command(CellCommand::MotionLogging(false)).unwrap();
    while read_all(&client, &[DATA]).await.remove(0).value.is_some_and(|value| value != Variant::Empty) {}
    wait_for(&mut values, DATA_EXISTS, "Empty").await;
    client.close().await;
    running.server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn each_read_of_data_takes_the_next_packets_and_a_subscription_takes_none() {
    let running = Running::start().await;
    let client = Client::anonymous(&running.server).await.unwrap();
    assert_eq!(write(&client, DATA_NUM, 1_u16.into()).await, StatusCode::Good);
    let mut values = subscribe(&client, &[DATA, DATA_EXISTS]).await;
    running.clock.advance(Duration::from_millis(100));
    wait_for(&mut values, DATA_EXISTS, "Ready").await;
    let packets: Vec<Vec<u8>> = read_all(&client, &[DATA, DATA, DATA]).await.into_iter().map(bytes).collect();
    let first = |packet: &Vec<u8>| {
        let read = MotionRead::decode(packet).unwrap();
        assert_eq!(read.len(), 1);
        read.blocks().next().unwrap().first_timestamp().unwrap()
    };
    // Blocks of eight samples, 0.5 ms apart: from the first after power-on without a gap.
    let stamps: Vec<u64> = packets.iter().map(|packet| first(packet).0).collect();
    assert_eq!(stamps, [40_000, 360_000, 680_000]);
    let mut seen = Vec::new();
    while let Ok((number, value)) = values.try_recv() {
        seen.extend((number == DATA).then_some(value.value));
    }
    assert!(seen.iter().all(|value| *value == Some(Variant::Empty)), "{seen:?}");
    client.close().await;
    running.server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_client_with_small_messages_gets_whole_blocks_and_loses_none() {
    // The endpoints must fit too.
    const LIMIT: usize = 30_000;
    let running = Running::start().await;
    let client = ClientOptions { max_message_size: Some(LIMIT), ..ClientOptions::plain(&running.server) }
        .connect()
        .await
        .unwrap();
    running.clock.advance(Duration::from_secs(1));
    let mut blocks = 0;
    let mut last = None;
    loop {
        // The second finds what the first leaves of the message.
        let mut read = read_all(&client, &[DATA, DATA]).await;
        let (second, first) = (read.pop().unwrap(), read.pop().unwrap());
        if first.value == Some(Variant::Empty) {
            break;
        }
        let mut packets = vec![bytes(first)];
        match second.status {
            Some(StatusCode::BadResponseTooLarge) => {}
            _ if second.value == Some(Variant::Empty) => {}
            _ => packets.push(bytes(second)),
        }
        assert!(packets.concat().len() < LIMIT);
        for packet in packets {
            assert_eq!(packet.len() % BLOCK_BYTES, 0);
            for block in MotionRead::decode(&packet).unwrap().blocks() {
                let stamp = block.first_timestamp().unwrap().0;
                assert!(last.is_none_or(|last| stamp == last + 320_000), "{last:?} {stamp}");
                last = Some(stamp);
                blocks += 1;
            }
        }
    }
    assert_eq!(blocks, 250);
    client.close().await;
    running.server.stop().await;
}
