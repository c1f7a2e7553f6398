//! Remote commands and OPC UA clients act on the same cell: what one of them does, the other one sees.

use std::net::Ipv4Addr;

use opcua::types::{NodeId, ObjectId, StatusCode, Variant, WriteValue};
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpStream;
use tokio::time::timeout;

use super::client::Client;
use super::{WAIT_LIMIT, config, start};
use crate::model::{ControllerSeries, FirmwareVersion};
use crate::virtual_controller::cell::{
    BackupMemory, Cell, CellClock, CellCommand, CellConfig, CellHandle, CellOptions, SpelDeclaration, SpelType,
};
use crate::virtual_controller::opcua::OpcUaConfig;
use crate::virtual_controller::remote::{RemoteOptions, RemoteServer};

fn cell() -> CellHandle {
    let mut cell = Cell::new(CellConfig {
        name: "Weld 1".parse().unwrap(),
        serial: "SN0000123".parse().unwrap(),
        series: ControllerSeries::Rc800,
        firmware: FirmwareVersion::new(8, 0, 1),
        started: chrono::DateTime::UNIX_EPOCH,
        variables: vec![
            SpelDeclaration::scalar("OPCUA_Count", SpelType::UInt32),
            SpelDeclaration::scalar("OPCUA_Recipe", SpelType::String),
        ],
        backup: BackupMemory::default(),
        options: CellOptions { virtual_io: true, ..CellOptions::default() },
    });
    cell.command(CellCommand::Stop).unwrap();
    CellHandle::new(cell, CellClock::manual())
}

async fn ask(stream: &mut TcpStream, line: &str) -> String {
    stream.write_all(format!("{line}\r\n").as_bytes()).await.unwrap();
    let mut answer = [0; 256];
    let length = timeout(WAIT_LIMIT, stream.read(&mut answer)).await.unwrap().unwrap();
    String::from_utf8(answer[..length].to_vec()).unwrap()
}

/// The node at a path of BrowseNames below the components of the controller.
async fn node(client: &Client, path: &str) -> NodeId {
    let mut at = NodeId::from(ObjectId::ObjectsFolder);
    let components = "DeviceSet/MotionDeviceSystem_0/Controllers/Controller_0/Components";
    for name in components.split('/').chain(path.split('/')) {
        let below = client.browse(at).await;
        at = below.into_iter().find(|(known, _)| known == name).unwrap_or_else(|| panic!("no {name} of {path}")).1;
    }
    at
}

#[tokio::test]
async fn what_a_remote_command_does_is_seen_through_opc_ua_and_the_other_way_round() {
    let folder = tempfile::tempdir().unwrap();
    let cell = cell();
    let server = start(OpcUaConfig { cell: cell.clone(), ..config(&folder) }).await;
    let options = RemoteOptions { text_port: Some(0), ..RemoteOptions::default() };
    let remote = RemoteServer::start(Ipv4Addr::LOCALHOST.into(), options, cell).await.unwrap();
    let mut line = TcpStream::connect(remote.text_address().unwrap()).await.unwrap();
    let client = Client::anonymous(&server).await.unwrap();
    for (request, answer) in [
        ("$Login,", "#Login,0\r\n"),
        ("$SetVariable,OPCUA_Count,77,UInt32", "#SetVariable,0\r\n"),
        ("$Execute,\"OPCUA_Recipe = \"Insert-3\"", "#Execute,0\r\n"),
        ("$SetIO,9,1", "#SetIO,0\r\n"),
        ("$SetMemIOWord,2,010F", "#SetMemIOWord,0\r\n"),
    ] {
        assert_eq!(ask(&mut line, request).await, answer);
    }
    let read = async |path: &str| client.read(node(&client, path).await).await;
    assert_eq!(read("SpelProject/BackupVariables/OPCUA_Count").await, Variant::UInt32(77));
    assert_eq!(read("SpelProject/BackupVariables/OPCUA_Recipe").await, Variant::from("Insert-3"));
    // Beside Ready, bit 0.
    assert_eq!(read("StandardIO/Outputs/Word_0").await, Variant::UInt16(0x0201));

    let inputs = node(&client, "StandardIO/Inputs/Word_0").await;
    let write = WriteValue::value_attr(inputs, Variant::UInt16(0xA500));
    let written = timeout(WAIT_LIMIT, client.session.write(&[write])).await.unwrap().unwrap();
    assert_eq!(written, [StatusCode::Good]);
    assert_eq!(ask(&mut line, "$GetIOWord,0").await, "#GetIOWord,A500\r\n");
    client.close().await;
}
