use super::*;
use crate::virtual_controller::cell::{IoDirection, find_bit};

async fn all(client: &mut Client, exchanges: &[(&str, &str)]) {
    for (line, answer) in exchanges {
        assert_eq!(client.ask(line).await, format!("{answer}\r\n"), "{line}");
    }
}

#[tokio::test]
async fn a_program_is_started_paused_continued_and_stopped() {
    let cell = cell(CellClock::manual());
    let options = RemoteOptions { password: Password::new("secret 1").unwrap(), ..options() };
    let server = start(&cell, options).await;
    let mut client = Client::text(&server).await;
    all(
        &mut client,
        &[
            ("$GetStatus", "!GetStatus,11"),
            ("$Login,wrong", "!Login,13"),
            ("$Login", "!Login,12"),
            ("$login,secret 1", "#login,0"),
            ("$GetStatus", "#GetStatus,00100000001,0000"),
            ("$SetMotorsOn,1", "#SetMotorsOn,0"),
            ("$SetMotorsOff,0", "#SetMotorsOff,0"),
            ("$Pause", "!Pause,20"),
            ("$Start,0", "#Start,0"),
            ("$GETSTATUS", "#GETSTATUS,00100000010,0000"),
            ("$Start,0", "!Start,20"),
            ("$Reset", "!Reset,20"),
            ("$SetMotorsOn,1", "!SetMotorsOn,20"),
            ("$SetIO,9,1", "!SetIO,20"),
            ("$Logout", "!Logout,20"),
            ("$Pause", "#Pause,0"),
            ("$GetStatus", "#GetStatus,00100000100,0000"),
            ("$Logout", "!Logout,20"),
            ("$Continue", "#Continue,0"),
            ("$GetStatus", "#GetStatus,00100000010,0000"),
            ("$Stop", "#Stop,0"),
            ("$GetStatus", "#GetStatus,00100000001,0000"),
            ("$Home,2", "#Home,0"),
            ("$Stop", "#Stop,0"),
            ("$SetCurRobot,2", "#SetCurRobot,0"),
            ("$GetCurRobot", "#GetCurRobot,2"),
            ("$Logout", "#Logout,0"),
            ("$GetStatus", "!GetStatus,11"),
            ("$Login,secret 1", "#Login,0"),
        ],
    )
    .await;
    cell.command(CellCommand::RaiseWarning(517)).unwrap();
    assert_eq!(client.ask("$GetStatus").await, "#GetStatus,00110000001,0517\r\n");
    cell.command(CellCommand::EmergencyStop(true)).unwrap();
    assert_eq!(client.ask("$GetStatus").await, "#GetStatus,00110010001,0517\r\n");
    assert_eq!(client.ask("$Start,0").await, "!Start,20\r\n");
    cell.command(CellCommand::EmergencyStop(false)).unwrap();
    assert_eq!(client.ask("$Reset").await, "#Reset,0\r\n");
    assert_eq!(client.ask("$GetStatus").await, "#GetStatus,00100000001,0000\r\n");
    server.stop().await;
    assert!(client.is_closed().await);
}

#[tokio::test]
async fn inputs_outputs_and_memory() {
    let cell = cell(CellClock::manual());
    let server = start(&cell, options()).await;
    let mut client = Client::logged_in(&server).await;
    cell.command(CellCommand::SetByte { port: 0, offset: 2, value: 0x5A }).unwrap();
    all(
        &mut client,
        &[
            ("$GetIO,17", "#GetIO,1"),
            ("$GetIO,16", "#GetIO,0"),
            ("$GetIOByte,2", "#GetIOByte,5A"),
            ("$GetIOWord,1", "#GetIOWord,005A"),
            ("$SetIO,9,1", "#SetIO,0"),
            ("$SetIOByte,8,0F", "#SetIOByte,0"),
            ("$SetIOWord,32,010F", "#SetIOWord,0"),
            ("$SetMemIO,1000,1", "#SetMemIO,0"),
            ("$GetMemIO,1000", "#GetMemIO,1"),
            ("$SetMemIOByte,1,0F", "#SetMemIOByte,0"),
            ("$GetMemIOByte,1", "#GetMemIOByte,0F"),
            ("$SetMemIOWord,1,010F", "#SetMemIOWord,0"),
            ("$GetMemIOWord,1", "#GetMemIOWord,010F"),
            ("$GetMemIOByte,3", "#GetMemIOByte,01"),
        ],
    )
    .await;
    let snapshot = cell.snapshot();
    let output = |bit| {
        let (port, offset) = find_bit(cell.description().io, IoDirection::Output, bit).unwrap();
        snapshot.io.bit(port, offset)
    };
    assert!(output(9) && output(64) && output(67) && !output(68));
    assert!(output(512) && output(515) && output(520) && !output(521), "word 32 begins with bit 512");
}

#[tokio::test]
async fn variables_and_elements_of_arrays() {
    let cell = cell(CellClock::manual());
    let server = start(&cell, options()).await;
    let mut client = Client::logged_in(&server).await;
    all(
        &mut client,
        &[
            ("$GetVariable,g_Status,Integer", "#GetVariable,0"),
            ("$SetVariable,g_Status,-5,Integer", "#SetVariable,0"),
            ("$GetVariable,G_STATUS,integer", "#GetVariable,-5"),
            ("$SetVariable,g_Real,-182.632,Real", "#SetVariable,0"),
            ("$GetVariable,g_Real,Real", "#GetVariable,-182.632"),
            ("$SetVariable,g_Text$,Insert,String", "#SetVariable,0"),
            ("$GetVariable,g_Text$,String", "#GetVariable,Insert"),
            ("$Execute,\"g_intArray(3) = 7; g_int3Array(3,5,9) = 1; g_int3Array(3,6,0) = 2\"", "#Execute,0"),
            ("$GetVariable,g_intArray(0),Integer,11", "#GetVariable,0,0,0,7,0,0,0,0,0,0,0"),
            ("$GetVariable,g_intArray(3),Integer,1", "#GetVariable,7"),
            ("$GetVariable,g_int3Array(3,5,8),Integer,4", "#GetVariable,0,1,0,2"),
            ("$GetVariable,g_intArray(0),Integer,12", "!GetVariable,15"),
            ("$GetVariable,g_intArray,Integer", "!GetVariable,15"),
            ("$GetVariable,g_intArray(11),Integer,1", "!GetVariable,15"),
            ("$GetVariable,g_intArray(0,0),Integer,1", "!GetVariable,15"),
            ("$GetVariable,g_Status,Long", "!GetVariable,15"),
            ("$GetVariable,g_Missing,Integer", "!GetVariable,15"),
            ("$SetVariable,g_Missing,1,Integer", "!SetVariable,15"),
            ("$SetVariable,g_intArray,1,Integer", "!SetVariable,15"),
            ("$SetVariable,g_Status,40000,Integer", "!SetVariable,12"),
            ("$GetVariable,g_Names$(0),String,2", "!GetVariable,14"),
            ("$GetVariable,g_intArray(0),Integer,0", "!GetVariable,14"),
            ("$GetVariable,g_intArray(0),Integer,101", "!GetVariable,14"),
            ("$GetVariable,g_intArray(0),Integer", "!GetVariable,14"),
        ],
    )
    .await;
}

#[tokio::test]
async fn alarms_are_listed_and_reset() {
    let cell = cell(CellClock::manual());
    let server = start(&cell, options()).await;
    let mut client = Client::logged_in(&server).await;
    assert_eq!(client.ask("$GetAlm").await, "#GetAlm,0\r\n");
    for alarm in [1, 5] {
        cell.command(CellCommand::WearOut(alarm)).unwrap();
    }
    all(
        &mut client,
        &[
            ("$GetAlm", "#GetAlm,2,1,5"),
            ("$ResetAlm,5", "#ResetAlm,0"),
            ("$GetAlm", "#GetAlm,1,1"),
            ("$ResetAlm,9", "!ResetAlm,99"),
        ],
    )
    .await;
}

#[tokio::test]
async fn execute_prints_moves_and_is_aborted() {
    let cell = cell(fast());
    let server = start(&cell, options()).await;
    let mut client = Client::logged_in(&server).await;
    assert_eq!(client.ask("$Stop").await, "#Stop,0\r\n");
    all(
        &mut client,
        &[
            ("$Execute,\"print 1 + 2\"", "#Execute,\"3\""),
            ("$Execute,\"On 9\"", "#Execute,0"),
            ("$execute,\"print oport(9);print \"mark\"", "#execute,\"1 mark\""),
            ("$Execute,\"Go P1\"", "!Execute,99"),
            ("$Execute,\"print errmsg$(err)\"", "#Execute,\"Motors off.\""),
            ("$Execute, \"On 9\"", "!Execute,12"),
            ("$Execute,On 9", "!Execute,12"),
            ("$SetMotorsOn,1", "#SetMotorsOn,0"),
        ],
    )
    .await;
    let here = client.ask("$Execute,\"print realpos\"").await;
    assert!(here.starts_with("#Execute,\" X:") && here.ends_with(" /R /A /NF /0\"\r\n"), "{here}");
    // A motion: the answer comes at its end.
    assert_eq!(client.ask("$Execute,\"Power High;Speed 20;Go P1\"").await, "#Execute,0\r\n");
    assert_ne!(client.ask("$Execute,\"print realpos\"").await, here);
    // While it runs, Abort, GetStatus and the outputs are accepted.
    client.send(b"$Execute,\"SpeedFactor 1;Speed 1;Go P4\"\r\n").await;
    all(
        &mut client,
        &[
            ("$GetStatus", "#GetStatus,00100000001,0000"),
            ("$SetIO,10,1", "#SetIO,0"),
            ("$SetMemIOWord,1,1234", "#SetMemIOWord,0"),
            ("$GetIO,1", "!GetIO,21"),
            ("$Start,0", "!Start,21"),
            ("$Execute,\"print 1\"", "!Execute,21"),
            ("$Logout", "!Logout,21"),
        ],
    )
    .await;
    client.send(b"$Abort\r\n").await;
    let mut answers = client.read().await;
    while answers.len() < b"#Abort,0\r\n!Execute,99\r\n".len() {
        answers.extend(client.read().await);
    }
    assert_eq!(answers, b"#Abort,0\r\n!Execute,99\r\n");
    assert_eq!(client.ask("$Execute,\"print 1\"").await, "#Execute,\"1\"\r\n");
}

#[tokio::test]
async fn for_monitoring_only_what_monitors_is_accepted() {
    let cell = cell(CellClock::manual());
    let server = start(&cell, RemoteOptions { role: RemoteRole::Monitor, ..options() }).await;
    let mut client = Client::logged_in(&server).await;
    cell.command(CellCommand::Start { function: 0 }).unwrap();
    all(
        &mut client,
        &[
            ("$GetStatus", "#GetStatus,00100000010,0000"),
            ("$GetIO,1", "#GetIO,0"),
            ("$GetMemIOWord,0", "#GetMemIOWord,0001"),
            ("$GetVariable,g_Status,Integer", "#GetVariable,0"),
            ("$GetContNo", "#GetContNo,SN0000123"),
            ("$Stop", "!Stop,20"),
            ("$SetMemIO,1,1", "!SetMemIO,20"),
            ("$SetVariable,g_Status,1,Integer", "!SetVariable,20"),
            ("$Execute,\"print 1\"", "!Execute,20"),
            ("$Abort", "!Abort,20"),
            ("$ResetAlm,1", "!ResetAlm,20"),
            ("$Logout", "#Logout,0"),
        ],
    )
    .await;
}

#[tokio::test]
async fn the_monitoring_client_learns_who_the_controller_is() {
    let cell = cell(CellClock::manual());
    let server = start(&cell, options()).await;
    let mut client = Client::logged_in(&server).await;
    all(
        &mut client,
        &[
            ("$GetContName", "#GetContName,Cell 1"),
            ("$GetContType", "#GetContType,RC800"),
            ("$GetContVer", "#GetContVer,8.1.0"),
            ("$GetContDev", "#GetContDev,Remote Ethernet"),
            ("$GetContSettings", "#GetContSettings,10000000010000001000010"),
            ("$GetRobotInfo", "#GetRobotInfo,2,5,C4-A601S,3,GX4-A251S"),
            ("$GetRobotName,0", "#GetRobotName,2,Robot1,Robot2"),
            ("$GetRobotSerial,2", "#GetRobotSerial,1,SN000012302"),
            ("$GetMotor,0", "#GetMotor,2,0,0,0,0"),
            ("$GetPartWarning,1", "#GetPartWarning,0,0,0,0,0,0"),
            ("$GetPrjName", "#GetPrjName,VirtualCell"),
            ("$GetErrMsg,7007,0", "#GetErrMsg,Point not defined."),
            ("$GetErrFunc,7007", "#GetErrFunc,0"),
            // Joint 3 of a SCARA has a ball screw spline (6) and no gear (5).
            ("$GetHealthRB,2,5,3", "#GetHealthRB,-1"),
            ("$GetMotor,3", "!GetMotor,99"),
            ("$GetHofs,0", "!GetHofs,99"),
        ],
    )
    .await;
    let offsets = client.ask("$GetHofs,2").await;
    assert_eq!(offsets.trim_end().split(',').count(), 5, "{offsets}");
    for (line, name) in [("$GetHealthCont", "#GetHealthCont"), ("$GetHealthRB,2,6,3", "#GetHealthRB")] {
        let answer = client.ask(line).await;
        let values: Vec<&str> = answer.trim_end().split(',').collect();
        assert_eq!((values[0], values.len(), values[1].len()), (name, 4, "2026/01/01 00:00:00".len()), "{answer}");
        assert!(values[2..].iter().all(|value| value.parse::<f64>().is_ok()), "{answer}");
    }
    let load = client.ask("$GetCpuLoad").await;
    assert!(load.trim_start_matches("#GetCpuLoad,").trim_end().parse::<u8>().is_ok(), "{load}");
}

/// What the terminator ends, and what a client may send in pieces or at once.
#[tokio::test]
async fn lines_end_as_set_and_come_in_any_pieces() {
    use crate::remote::text::Terminator;
    let cell = cell(CellClock::manual());
    for (terminator, end) in [(Terminator::Cr, "\r"), (Terminator::Lf, "\n"), (Terminator::CrLf, "\r\n")] {
        let server = start(&cell, RemoteOptions { terminator, ..options() }).await;
        let mut client = Client::text(&server).await;
        for piece in ["$Lo", "gin,", "\r"] {
            client.send(piece.as_bytes()).await;
        }
        assert_eq!(client.read().await, format!("#Login,0{end}").into_bytes());
        client.send(b"\n$GetCurRobot\n$GetAlm\r\n").await;
        let mut answers = Vec::new();
        while answers.len() < "#GetCurRobot,1#GetAlm,0".len() + 2 * end.len() {
            answers.extend(client.read().await);
        }
        assert_eq!(answers, format!("#GetCurRobot,1{end}#GetAlm,0{end}").into_bytes());
        server.stop().await;
    }
}
