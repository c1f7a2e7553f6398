//! How export, import and the server log look.

use opcua_configurator::jobs::SettingsExported;
use opcua_configurator::model::{ControllerSeries, ErrorCode, FirmwareVersion, LogChunk, Problem};
use opcua_configurator::ui::backend::{BackendEvent, RecordingBackend};
use opcua_configurator::ui::model::ExportFound;

use crate::harness::{SIZE, choose, click, now, type_into, window};
use crate::pictures::{W, assert_shows, chinese, end_job, finish, job, picture, succeed, tell, tick};
use crate::samples::{configuration, info};

/// "Weld 2" has legacy firmware, "Palletiser south" too.
fn open(names: &[&str], path: &[&str]) -> W {
    let mut window = window(RecordingBackend::default(), configuration(24, now()), SIZE);
    tick(&mut window, names);
    choose(&mut window, path);
    window
}

fn load(window: &mut W, log: LogChunk) {
    succeed(window, 0, log, Some(info(1, now(), ControllerSeries::Rc90)));
    end_job(window, 1, 0, 0);
}

#[test]
fn export() {
    let mut window = open(&["Weld 2"], &["Server settings", "Export…"]);
    type_into(&mut window, "Passphrase", "short");
    picture(&mut window, "export_settings");
    type_into(&mut window, "Passphrase", "correct horse");
    click(&mut window, "Export");
    chinese(&mut window);
    assert_shows(&window, "工作区中的同名设置导出文件将被覆盖");
    click(&mut window, "导出");
    let path = window.state().model.workspace.root().join("SN0001460/option.json");
    finish(&mut window, vec![Ok(SettingsExported { path })]);
    assert_shows(&window, "导出设置 – 处理完成");
}

#[test]
fn import() {
    let mut window = open(&["Weld 2"], &["Server settings", "Import…"]);
    let look = job(&window);
    let found = ExportFound { exported: now(), firmware: FirmwareVersion::new(7, 5, 54) };
    tell(&mut window, BackendEvent::ExportSeen { job: look, result: Ok(found) });
    assert_shows(&window, "2026-06-01 16:30, firmware 7.5.54");
    click(&mut window, "Import");
    assert_shows(&window, "Settings and users in the controller are replaced");
}

#[test]
fn nothing_to_import() {
    let mut window = open(&["Weld 2"], &["Server settings", "Import…"]);
    let look = job(&window);
    let missing =
        Problem::with_detail(ErrorCode::ExportMissing, "/home/engineer/EpsonRC80/OPCUA/SN0001460/option.json");
    tell(&mut window, BackendEvent::ExportSeen { job: look, result: Err(missing) });
    assert_shows(&window, "No settings were exported from this controller");
}

#[test]
fn import_for_many_in_chinese() {
    let mut window = open(&["Weld 2", "Palletiser south"], &["Server settings", "Import…"]);
    chinese(&mut window);
    picture(&mut window, "import_settings_many_chinese");
}

fn lines() -> LogChunk {
    let line = |n: usize| {
        let what = match n % 4 {
            0 => "INFO connection from 192.168.10.77:50412 opened",
            1 => "INFO session activated: application urn:plant:scada:client, user operator1, policy Basic256Sha256",
            2 => {
                "WARN certificate of urn:plant:panel is not trusted; put into the rejected list under the thumbprint 8f3a"
            }
            _ => "INFO connection from 192.168.10.77:50412 closed",
        };
        format!("2026-06-01T08:{:02}:{:02}Z {what}\n", n / 60, n % 60)
    };
    let text: String = (0..400).map(line).collect();
    let size = 1_400_000;
    LogChunk { size, from: size - text.len() as u64, next: size, text }
}

#[test]
fn server_log() {
    let mut window = open(&["Weld 2"], &["Server settings", "Server log…"]);
    load(&mut window, lines());
    picture(&mut window, "server_log");
    type_into(&mut window, "Filter lines", "rejected");
}

#[test]
fn server_log_empty() {
    let mut window = open(&["Weld 2"], &["Server settings", "Server log…"]);
    load(&mut window, LogChunk::default());
    assert_shows(&window, "The log is empty. It is switched on in the basic settings.");
}
