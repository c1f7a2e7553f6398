//! Bridges between a simulated PLC and a robot controller that answers as the manual says.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use parking_lot::Mutex;
use tokio::io::{AsyncBufReadExt as _, AsyncWriteExt as _, BufReader};
use tokio::net::TcpListener;

use super::*;
use crate::fins::plc::{PlcConfig, SimulatedPlc};

fn no_password(_: &Path) -> Result<SecretString, Problem> {
    Ok("secret".into())
}

fn map_in(folder: &Path, text: &str) -> std::path::PathBuf {
    let map = folder.join("map.toml");
    std::fs::write(&map, text).unwrap();
    map
}

/// What the controller has: variables, input and output words.
type Memory = Arc<Mutex<BTreeMap<String, String>>>;

/// A controller with remote Ethernet that answers with what it has, line by line.
async fn controller(memory: Memory) -> std::net::SocketAddr {
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let address = listener.local_addr().unwrap();
    tokio::spawn(async move {
        while let Ok((stream, _)) = listener.accept().await {
            let memory = Arc::clone(&memory);
            tokio::spawn(async move {
                let (reader, mut writer) = stream.into_split();
                let mut lines = BufReader::new(reader).lines();
                while let Ok(Some(line)) = lines.next_line().await {
                    let parts: Vec<&str> = line.trim_start_matches('$').split(',').collect();
                    let answer = match parts[..] {
                        ["Login", "secret"] => "#Login,0".to_owned(),
                        ["GetVariable", name, _] => format!("#GetVariable,{}", memory.lock()[name]),
                        ["SetVariable", name, value, _] => {
                            memory.lock().insert(name.to_owned(), value.to_owned());
                            "#SetVariable,0".to_owned()
                        }
                        ["GetIOWord", port] => format!("#GetIOWord,{}", memory.lock()[&format!("in {port}")]),
                        ["SetIOWord", port, value] => {
                            memory.lock().insert(format!("out {port}"), value.to_owned());
                            "#SetIOWord,0".to_owned()
                        }
                        _ => format!("!{},99", parts[0]),
                    };
                    if writer.write_all(format!("{answer}\r\n").as_bytes()).await.is_err() {
                        break;
                    }
                }
            });
        }
    });
    address
}

#[tokio::test]
async fn words_go_to_variables_and_outputs_and_back() {
    let memory = Memory::default();
    memory.lock().extend([("pieces".to_owned(), "-7".to_owned()), ("in 0".to_owned(), "00F1".to_owned())]);
    let robot = controller(Arc::clone(&memory)).await;
    let plc = SimulatedPlc::start(PlcConfig::default()).await.unwrap();
    plc.state().memory.set_words("D0".parse().unwrap(), &[1_234, 0, 0xC148, 0x00AB]).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let rows = [
        ("D0", "var product", "to-robot", "u16"),
        ("D1-2", "var offset", "to-robot", "f32"),
        ("D3", "io word 1", "to-robot", "u16"),
        ("D10", "var pieces", "to-plc", "i16"),
        ("D11", "io word 0", "to-plc", "u16"),
    ];
    let mut text = format!(
        "cycle-ms = 10\n[plc]\nto = \"{}\"\n[robot]\nkind = \"remote\"\nto = \"tcp://{robot}\"\npassword-file = \"p\"\n",
        plc.address()
    );
    for (from, to, direction, data_type) in rows {
        let row = format!("plc = \"{from}\"\nrobot = \"{to}\"\ndirection = \"{direction}\"\ntype = \"{data_type}\"\n");
        text.push_str(&format!("[[row]]\n{row}"));
    }
    let bridge = open_fins_bridge(&map_in(folder.path(), &text), no_password).unwrap();
    let running = bridge.start();
    let mut status = running.status();
    let complete = status.wait_for(|status| status.complete_cycles >= 2);
    let reached = tokio::time::timeout(Duration::from_secs(20), complete).await.map(|status| status.is_ok());
    assert_eq!(reached, Ok(true), "{:?}", running.status().borrow().rows);
    running.stop().await.unwrap();
    let words = plc.state().memory.words("D10-11".parse().unwrap()).unwrap().to_vec();
    assert_eq!(words, [0xFFF9, 0x00F1]);
    let memory = memory.lock();
    assert_eq!((memory["product"].as_str(), memory["out 1"].as_str()), ("1234", "00AB"));
    assert_eq!(memory["offset"].parse(), Ok(-12.5_f32));
}

#[test]
fn what_a_robot_does_not_have_is_said_with_its_row() {
    let folder = tempfile::tempdir().unwrap();
    let open = |row: &str| {
        let head = "[plc]\nto = \"127.0.0.1\"\n[robot]\nkind = \"remote\"\nto = \"tcp://127.0.0.1\"\n";
        open_fins_bridge(&map_in(folder.path(), &format!("{head}[[row]]\n{row}")), no_password).map(drop)
    };
    let good = "plc = \"D0\"\nrobot = \"var a\"\ndirection = \"to-plc\"\n";
    assert_eq!(open(good), Ok(()));
    for (row, wrong) in [
        (good.replace("var a", "speed"), "row 1: \"speed\" is no item of a robot"),
        (good.replace("var a", "io bit 1"), "has no values of the type u16"),
        (good.replace("\"D0\"", "\"D0-1\""), "cannot have so many values"),
        (good.replace("var a", "var a(0)").replace("to-plc", "to-robot"), "cannot have so many values"),
        (format!("{good}type = \"text\"\n").replace("var a", "var a as Long"), "has no values of the type text"),
    ] {
        let problem = open(&row).unwrap_err();
        assert_eq!(problem.code, ErrorCode::BadBridgeMap, "{problem}");
        assert!(problem.detail.as_deref().is_some_and(|detail| detail.contains(wrong)), "{problem}");
    }
    let other = "[plc]\nto = \"127.0.0.1\"\n[robot]\nkind = \"remote\"\nto = \"127.0.0.1\"\n";
    let refused = open_fins_bridge(&map_in(folder.path(), &format!("{other}[[row]]\n{good}")), no_password);
    assert_eq!(refused.map(drop).map_err(|problem| problem.code), Err(ErrorCode::BadRemoteTarget));
}
