//! The dialogs for activation and connection lists as they look.

use std::path::PathBuf;

use opcua_configurator::model::{ControllerSeries, ErrorCode, Problem};
use opcua_configurator::pki::Fingerprint;
use opcua_configurator::ui::backend::{BackendEvent, FileContents, RecordingBackend};
use opcua_configurator::workspace::{ConnectionList, RetrievedInfo};

use crate::harness::{SIZE, choose, click, now, type_into, window};
use crate::pictures::{W, assert_shows, chinese, job, picture, tell};
use crate::samples::{configuration, info};

fn read(window: &mut W, path: &str, contents: &str) {
    let job = job(window);
    let contents = FileContents(contents.as_bytes().to_vec());
    tell(window, BackendEvent::FileRead { job, result: Ok((PathBuf::from(path), contents)) });
}

/// Legacy controllers, the last of which was never read; none is activated.
fn legacy(count: usize) -> W {
    let mut configuration = configuration(count, now());
    for (n, entry) in configuration.controllers.iter_mut().enumerate() {
        entry.series = ControllerSeries::Rc700;
        let mut info = info(n, now(), entry.series);
        info.activated = false;
        entry.last = (n + 1 < count || count == 1).then(|| RetrievedInfo { at: now(), info });
    }
    window(RecordingBackend::default(), configuration, SIZE)
}

#[test]
fn keys_of_one_controller() {
    let mut window = legacy(1);
    click(&mut window, "Tick Weld 1");
    choose(&mut window, &["Server settings", "Activation…"]);
    type_into(&mut window, "Licence key", " 7AGK VCL3 X2EH LGZG");
    type_into(&mut window, "Activation key", "HTMT-L6FB-WUZW");
    assert_shows(&window, "12 of 24 letters and digits");
}

#[test]
fn keys_from_a_file() {
    let mut window = legacy(6);
    click(&mut window, "Tick all");
    choose(&mut window, &["Server settings", "Activation…"]);
    assert_shows(&window, "Activation – 6 controllers");
    click(&mut window, "Choose…");
    let picking = job(&window);
    let path = PathBuf::from("/home/engineer/keys/activation.csv");
    tell(&mut window, BackendEvent::FilePicked { job: picking, result: Ok(Some(path)) });
    let keys = "7agk-vcl3-x2eh-lgzg,HTMT-L6FB-WUZW-34CQ-GDMZ-RWUC";
    let serial = |n: usize| info(n, now(), ControllerSeries::Rc700).serial;
    let body = format!(
        "{},{keys}\n{},{keys}\n{},{keys}x\n{};{}\nR7A0010009,{keys}\npress 4 comes next week\n",
        serial(0),
        serial(1),
        serial(2),
        serial(3),
        keys.replace(',', ";"),
    );
    read(&mut window, "activation.csv", &format!("OPCUA.Activation.Ver.1.0\n{body}"));
    assert_shows(&window, "Line 4: activation key: 25 letters and digits; 24 are required");
    chinese(&mut window);
    picture(&mut window, "activation_preview_chinese");
}

#[test]
fn no_file_dialog() {
    let mut window = legacy(2);
    click(&mut window, "Tick all");
    choose(&mut window, &["Server settings", "Activation…"]);
    click(&mut window, "Choose…");
    let job = job(&window);
    tell(&mut window, BackendEvent::FilePicked { job, result: Err(Problem::from(ErrorCode::NoFilePicker)) });
    assert_shows(&window, "The file dialog cannot be opened");
}

#[test]
fn connection_list() {
    let mut window = window(RecordingBackend::default(), configuration(5, now()), SIZE);
    choose(&mut window, &["Controller", "Get connection list…"]);
    let list = "Name,Type,Address\nCell 1,Ethernet,192.168.20.1\nCell 2,Ethernet,192.168.20.2:7943\n\
        Assembly line 3,Ethernet,robot-3.example.com\n装配线 4,Ethernet,192.168.20.4\nWeld 1,Ethernet,192.168.20.5\n\
        Weld one,Ethernet,192.168.10.1\nService USB,USB,\nSimulator,Virtual,127.0.0.1\nCell 1,Ethernet,192.168.20.6\n\
        Cell 9,Ethernet,192.168.20.999\n";
    assert!(ConnectionList::parse(list.as_bytes()).is_ok());
    read(&mut window, "connections.csv", list);
    click(&mut window, "Cell 2");
    picture(&mut window, "connection_list");
    chinese(&mut window);
    assert_shows(&window, "地址已注册（Weld 1）");
}

#[test]
fn confirm_identity() {
    let mut configuration = configuration(4, now());
    for entry in &mut configuration.controllers[1..] {
        (entry.fingerprint, entry.last) = (None, None);
    }
    let mut window = window(RecordingBackend::default(), configuration, SIZE);
    assert_shows(&window, "Not confirmed");
    click(&mut window, "Tick all");
    click(&mut window, "Get new information");
    let job = job(&window);
    tell(&mut window, BackendEvent::Probed { job, result: Ok(Fingerprint::of(b"controller")) });
    assert_shows(&window, "1 of 3");
    chinese(&mut window);
    picture(&mut window, "confirm_identity_chinese");
}
