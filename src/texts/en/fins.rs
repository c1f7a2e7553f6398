//! What is said of PLCs and bridges, in English.

use crate::fins::codec::cpu::PlcErrorKind;
use crate::fins::codec::end_code::{EndCode, EndCodeRemedy, KnownEndCode};

english_texts! { fins:
    FinsModel: "Model";
    FinsVersion: "Version";
    FinsMode: "Mode";
    FinsProgram: "User program";
    FinsProgramRuns: "runs";
    FinsProgramStands: "does not run";
    FinsClock: "Clock";
    FinsFatalErrors: "Fatal errors";
    FinsNonFatalErrors: "Non-fatal errors";
    FinsErrorMessage: "Error message";
    FinsNodes: "Nodes (this program, PLC)";
    FinsNone: "none";
    HeadingRow: "ROW";
    HeadingPlc: "PLC";
    HeadingDirection: "DIRECTION";
    HeadingRobot: "ROBOT";
    HeadingValues: "VALUES";
    HeadingCopied: "COPIED";
    HeadingFailed: "FAILED";
    HeadingUnknown: "UNKNOWN";
    HeadingError: "ERROR";
}

texts_of_values! { end_code(KnownEndCode):
    NormalCompletion: "normal completion";
    ServiceCancelled: "the service was cancelled";
    LocalNodeNotInNetwork: "the local node is not in the network";
    TokenTimeout: "no token in time";
    RetriesFailed: "all retries failed";
    TooManySendFrames: "too many frames to send";
    NodeAddressRange: "the node is out of range";
    NodeAddressDuplicate: "two nodes have the same address";
    DestinationNotInNetwork: "the destination node is not in the network";
    UnitMissing: "the destination unit is missing";
    ThirdNodeMissing: "the third node is missing";
    DestinationBusy: "the destination node is busy";
    ResponseTimeout: "no response in time";
    CommunicationsControllerError: "error of the communications controller";
    CpuUnitError: "error of the CPU unit";
    ControllerError: "error of the controller";
    UnitNumberError: "wrong unit number";
    UndefinedCommand: "the command is not defined";
    NotSupportedByModel: "the model or version does not support the command";
    DestinationNotInRoutingTable: "the destination is not in the routing tables";
    NoRoutingTables: "there are no routing tables";
    RoutingTableError: "error of the routing tables";
    TooManyRelays: "too many relays";
    CommandTooLong: "the command is too long";
    CommandTooShort: "the command is too short";
    ElementsAndDataDiffer: "elements and data do not match";
    CommandFormatError: "the command format is wrong";
    HeaderError: "the header is wrong";
    AreaMissing: "the memory area does not exist";
    AccessSizeError: "wrong access size or odd address";
    AddressRangeError: "the first address is outside the area";
    AddressRangeExceeded: "the last address is outside the area";
    ProgramMissing: "the program does not exist";
    RelationalError: "the parameters contradict each other";
    DuplicateDataAccess: "the data is accessed twice at the same time";
    ResponseTooLong: "the response would be too long";
    ParameterError: "a parameter is wrong";
    ReadProtected: "the data is protected against reading";
    ReadTableMissing: "the table does not exist";
    ReadDataMissing: "the data does not exist";
    ReadProgramMissing: "the program to read does not exist";
    ReadFileMissing: "the file to read does not exist";
    DataMismatch: "the data does not match";
    ReadOnly: "the area is read-only";
    WriteProtected: "the data is protected against writing";
    CannotRegister: "it cannot be registered";
    WriteProgramMissing: "the program to write does not exist";
    WriteFileMissing: "the file to write does not exist";
    FileExists: "the file exists already";
    CannotChange: "it cannot be changed";
    NotDuringExecution: "not possible during execution";
    NotWhileRunning: "not possible while the PLC runs";
    WrongModeProgram: "not possible in PROGRAM mode";
    WrongModeDebug: "not possible in DEBUG mode";
    WrongModeMonitor: "not possible in MONITOR mode";
    WrongModeRun: "not possible in RUN mode";
    NotPollingNode: "the node is not the polling node";
    StepNotExecutable: "the step cannot be executed";
    FileDeviceMissing: "the file device does not exist";
    MemoryMissing: "the memory does not exist";
    ClockMissing: "the clock does not exist";
    StartTableMissing: "the table for starting does not exist";
    UnitMemoryError: "memory error";
    IoSettingError: "error of the I/O setting";
    TooManyIoPoints: "too many I/O points";
    CpuBusError: "error of the CPU bus";
    IoDuplication: "an I/O address is used twice";
    IoBusError: "error of the I/O bus";
    SysmacBus2Error: "error of SYSMAC BUS/2";
    CpuBusUnitError: "error of a CPU bus unit";
    SysmacBusDuplication: "a SYSMAC BUS number is used twice";
    MemoryError: "error of the internal memory or memory card";
    TerminatorMissing: "a SYSMAC BUS terminator is missing";
    NotProtected: "there is no protection";
    WrongPassword: "the password is wrong";
    Protected: "it is protected";
    AlreadyExecuting: "the service is executed already";
    ServiceStopped: "the service is stopped";
    NoExecutionRight: "there is no right to execute it";
    SettingsIncomplete: "the settings are not complete";
    ItemsNotSet: "necessary items are not set";
    NumberAlreadyDefined: "the number is defined already";
    ErrorNotCleared: "the error cannot be cleared";
    NoAccessRight: "another device holds the access right";
    ServiceAborted: "the service was aborted";
}

texts_of_values! { remedy(EndCodeRemedy):
    None: "Nothing is wrong.";
    Retry: "Try again. If it stays so, lower the load of the PLC and its networks.";
    NetworkUnit: "Check the settings of the network unit.";
    Destination: "Check node, cable and power of the PLC that is addressed.";
    PlcError: "Look at the error that the PLC or the unit shows, and remove its cause.";
    Unsupported: "This PLC does not offer the command; use another one.";
    Routing: "Register the way to the destination in the routing tables.";
    Format: "This program and the PLC do not understand each other: report it with the detail shown.";
    Address: "Check area, address and number of elements against the model of the PLC.";
    Protection: "Remove the protection, or choose another area.";
    Mode: "Change the operating mode of the PLC.";
    AccessRight: "Wait until the other device gives the access right back.";
    Missing: "Create in the PLC what is missing, or name another one.";
}

texts_of_values! { plc_error(PlcErrorKind):
    Watchdog: "watchdog";
    Fals: "FALS";
    Fal: "FAL";
    CycleTimeOver: "cycle time too long";
    Program: "program";
    IoSetting: "I/O setting";
    TooManyIoPoints: "too many I/O points";
    InnerBoard: "inner board";
    Duplication: "duplicate number";
    IoBus: "I/O bus";
    Memory: "memory";
    SpecialIoUnitSetting: "special I/O unit setting";
    CpuBusUnitSetting: "CPU bus unit setting";
    Battery: "battery";
    SysmacBus: "SYSMAC BUS";
    SpecialIoUnit: "special I/O unit";
    CpuBusUnit: "CPU bus unit";
    IoVerification: "I/O verification";
    PlcSetup: "PLC setup";
    BasicIoUnit: "basic I/O unit";
    InterruptTask: "interrupt task";
}

pub fn plc_advice(end: EndCode) -> String {
    let code = format!("{:04X}", end.code);
    let relay = if end.is_relay_error { ", while a network relayed the command" } else { "" };
    match end.known() {
        Some(known) => format!("End code {code}: {}{relay}. {}", end_code(known), remedy(known.remedy())),
        None => format!("End code {code} is in no table of the manuals{relay}."),
    }
}

pub fn plc_written(range: &str) -> String {
    format!("Written: {range}")
}

pub fn plc_partly_written(done: usize, uncertain: usize) -> String {
    match uncertain {
        0 => format!("Confirmed by the PLC before that: {done} elements"),
        _ => format!("Confirmed by the PLC before that: {done} elements; not known: the next {uncertain}"),
    }
}

pub fn plc_simulated(address: &str, node: u8) -> String {
    format!("A simulated PLC, node {node}, answers at {address}; Ctrl-C ends it")
}

pub fn plc_watched(what: &str) -> String {
    format!("Watching {what}; Ctrl-C ends it")
}

pub fn bridge_started(rows: usize) -> String {
    let rows = if rows == 1 { "1 row".to_owned() } else { format!("{rows} rows") };
    format!("The bridge copies {rows}; Ctrl-C ends it")
}

pub fn bridge_row_copied(row: &str) -> String {
    format!("{row}: copied")
}

pub fn bridge_ended(cycles: u64, complete: u64, longest_ms: u128) -> String {
    format!("Cycles: {cycles}, of them complete: {complete}, the longest took {longest_ms} ms")
}
