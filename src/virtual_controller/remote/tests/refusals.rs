use tokio::time::Instant;

use super::*;
use crate::virtual_controller::remote::conversation::Conversation;
use crate::virtual_controller::remote::request_handler::RequestHandler;
use crate::virtual_controller::remote::wire::Wire;

/// Each code of the manual, provoked in the text form; 16 exists in frames only.
#[tokio::test]
async fn every_code_of_the_text_form() {
    let cell = cell(fast());
    let options = RemoteOptions { password: Password::new("right").unwrap(), ..options() };
    let server = start(&cell, options).await;
    let mut client = Client::text(&server).await;
    for (line, answer) in [
        ("GetStatus", "!GetStatus,10"),
        ("$GetStatus", "!GetStatus,11"),
        ("$Dance", "!Dance,11"),
        ("$Login,wrong", "!Login,13"),
        ("$Login,right", "#Login,0"),
        ("$Dance", "!Dance,11"),
        ("$Start,64", "!Start,12"),
        ("$Start,0,0", "!Start,12"),
        ("$SetIO,9,2", "!SetIO,12"),
        ("$SetIOByte,1,1FF", "!SetIOByte,12"),
        ("$Stop", "#Stop,0"),
        ("$GetVariable,g_intArray(0),Integer,101", "!GetVariable,14"),
        ("$GetVariable,g_Missing,Integer", "!GetVariable,15"),
        ("$Pause", "!Pause,20"),
        ("$Continue", "!Continue,20"),
        // In range of the command, but the controller has no such thing.
        ("$Start,63", "!Start,99"),
        ("$Home,3", "!Home,99"),
        ("$SetCurRobot,0", "!SetCurRobot,99"),
        ("$GetIO,24", "!GetIO,99"),
        ("$SetIOWord,1,0000", "!SetIOWord,99"),
        ("$GetMemIOByte,128", "!GetMemIOByte,99"),
        ("$Execute,\"Dance\"", "!Execute,99"),
    ] {
        assert_eq!(client.ask(line).await, format!("{answer}\r\n"), "{line}");
    }
    assert_eq!(client.ask("$SetMotorsOn,0").await, "#SetMotorsOn,0\r\n");
    client.send(b"$Execute,\"SpeedFactor 1;Speed 1;Go P4\"\r\n").await;
    assert_eq!(client.ask("$GetAlm").await, "!GetAlm,21\r\n");
    cell.command(CellCommand::EmergencyStop(true)).unwrap();
    assert_eq!(client.read().await, b"!Execute,99\r\n", "an emergency stop ends it");
    assert_eq!(client.ask("$Execute,\"print 1\"").await, "!Execute,20\r\n");
    let long = format!("$Execute,\"{}\"", "x".repeat(257));
    assert_eq!(client.ask(&long).await, "!Execute,12\r\n");
}

/// 98: at an address of the internet, a controller without a password lets nobody in.
#[tokio::test]
async fn without_a_password_nobody_logs_in_at_an_address_of_the_internet() {
    for (password, is_global, answer) in
        [("", true, "!Login,98\r\n"), ("", false, "#Login,0\r\n"), ("right", true, "#Login,0\r\n")]
    {
        let options = RemoteOptions { password: Password::new(password).unwrap(), ..options() };
        let handler = RequestHandler::new(cell(CellClock::manual()), options.into());
        let wire = Wire::text(handler.options());
        let mut conversation = Conversation::new(handler, wire, is_global, Instant::now());
        let answers = conversation.receive(format!("$Login,{password}\r\n").as_bytes(), Instant::now());
        assert_eq!(*conversation.encode(&answers[0]), answer.as_bytes());
    }
}

#[tokio::test]
async fn old_firmware_does_not_know_the_monitoring_commands() {
    let mut config = CellConfig {
        name: "Old".parse().unwrap(),
        serial: "SN0000001".parse().unwrap(),
        series: ControllerSeries::Rc700,
        firmware: FirmwareVersion::new(7, 4, 6),
        started: chrono::DateTime::UNIX_EPOCH,
        variables: Vec::new(),
        backup: BackupMemory::default(),
        options: CellOptions::default(),
    };
    for (firmware, answer) in [((7, 4, 6), "!GetContName,11\r\n"), ((7, 5, 4), "#GetContName,Old\r\n")] {
        config.firmware = FirmwareVersion::new(firmware.0, firmware.1, firmware.2);
        let cell = CellHandle::new(Cell::new(config.clone()), CellClock::manual());
        let server = start(&cell, options()).await;
        let mut client = Client::logged_in(&server).await;
        assert_eq!(client.ask("$GetContName").await, answer);
        // Memory I/O, which its address space does not show.
        assert_eq!(client.ask("$SetMemIO,1000,1").await, "#SetMemIO,0\r\n");
        assert_eq!(client.ask("$GetMemIO,1000").await, "#GetMemIO,1\r\n");
    }
}

/// What cannot be kept over a power-off is not reported as done.
#[tokio::test]
async fn a_variable_that_cannot_be_kept_is_refused() {
    use crate::virtual_controller::faults::Faults;
    use crate::virtual_controller::remote::BackupFile;
    let folder = tempfile::tempdir().unwrap();
    let cell = cell(CellClock::manual());
    let faults = Faults::default();
    let kept = BackupFile::new(folder.path(), faults.clone(), cell.clone(), BackupMemory::default());
    let server = RemoteServer::start_kept(LOOPBACK, options(), cell.clone(), kept).await.unwrap();
    let mut client = Client::logged_in(&server).await;
    faults.update(|switches| switches.disk_full = true);
    assert_eq!(client.ask("$SetVariable,g_Status,1,Integer").await, "!SetVariable,99\r\n");
    faults.update(|switches| switches.disk_full = false);
    assert_eq!(client.ask("$SetVariable,g_Status,2,Integer").await, "#SetVariable,0\r\n");
    assert_eq!(client.ask("$Execute,\"g_intArray(0) = 3\"").await, "#Execute,0\r\n");
    let memory = BackupFile::load(folder.path()).unwrap();
    assert_eq!(memory, cell.backup());
    assert_eq!(memory.variables.iter().map(|it| it.name.as_str()).collect::<Vec<_>>(), ["g_Status", "g_intArray"]);
}
