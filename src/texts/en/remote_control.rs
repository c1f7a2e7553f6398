//! The window for remote control, in English.

use std::path::Path;

english_texts! { remote_control:
    RemoteControl: "Remote control…";
    RemoteControlTip: "State, program, motors, I/O and variables of one controller through its remote commands";
    RemoteControlTitle: "Remote control";
    RemoteTabControl: "Control";
    RemoteTabIo: "I/O";
    RemoteTabVariables: "Variables";
    RemoteTabExecute: "Execute";
    RemoteTabAlarms: "Alarms";
    RemoteTabLog: "Log";

    // connection
    RemoteTarget: "Connection";
    RemoteTargetForms: "Remote Ethernet: tcp://192.168.0.1:5000. Serial port: serial:COM3?baud=19200 or serial:/dev/ttyS0. Serial device server: raw-tcp://192.168.0.7:4001.";
    RemoteTargetRule: "Enter a connection as in the examples below";
    RemotePasswordRule: "A password for remote commands has at most 16 printable characters";
    RemoteOneClient: "A controller serves one client of remote commands at a time. The connection begins with monitoring only.";
    RemoteNotConnected: "Not connected";
    RemoteLiveTip: "The state is read twice a second";
    RemoteOld: "What is shown below was read before the connection was lost";
    RemoteChangeConnection: "Connect to another place";
    RemoteDisconnect: "Disconnect";

    // the switch
    RemoteMonitoring: "Monitoring only";
    RemoteMonitoringText: "Nothing is sent that moves or changes anything.";
    RemoteAllow: "Allow commands…";
    RemoteAllowed: "Commands are allowed";
    RemoteAllowedText: "Robots, motors, outputs and programs react at once.";
    RemoteForbid: "Monitoring only";
    RemoteAllowTitle: "Allow commands";
    RemoteAllowRobots: "Robots may move at once: by Start, Continue, Home and Execute, and an arm may sink when motors are switched off.";
    RemoteAllowOutputs: "Outputs switch at once, and with them grippers, valves and conveyors.";
    RemoteAllowProgram: "Programs start, stop and react to variables and memory I/O that are set here.";
    RemoteAllowSafety: "Make sure that nobody is in the reach of the machine, and that an emergency stop is within your own reach.";
    RemoteAllowEnds: "Commands are allowed in this dialog only, until it is closed or the connection ends.";
    RemoteAllowNow: "Allow";
    RemoteWhyNotConnected: "There is no connection to the controller";
    RemoteWhyMonitoring: "Monitoring only. Allow commands first.";

    // lamps
    RemoteFlagTest: "The controller is in TEST mode";
    RemoteFlagTeach: "The controller is in TEACH mode";
    RemoteFlagAuto: "Remote commands that act are accepted";
    RemoteFlagWarning: "There is a warning; tasks go on";
    RemoteFlagSError: "There is a system error; the controller must be restarted";
    RemoteFlagSafeguard: "The safeguard is open";
    RemoteFlagEStop: "The emergency stop is on";
    RemoteFlagError: "There is an error, which Reset clears";
    RemoteFlagPaused: "Tasks are paused";
    RemoteFlagRunning: "Tasks run";
    RemoteFlagReady: "The controller has started up, and no task runs";

    // control
    RemoteProgram: "Program";
    RemoteFunction: "Function";
    RemoteStart: "Start";
    RemoteStop: "Stop";
    RemotePause: "Pause";
    RemoteContinue: "Continue";
    RemoteReset: "Reset";
    RemoteAbort: "Abort";
    RemoteRobots: "Robots";
    RemoteAllRobots: "All robots";
    RemoteRobotTip: "The robot for the buttons beside";
    RemoteOneRobot: "Choose one robot";
    RemoteMotorsOn: "Motors on";
    RemoteMotorsOff: "Motors off";
    RemoteHome: "Home";
    RemoteSelectRobot: "Select";
    RemoteCurrentRobot: "Selected for Execute";

    // I/O
    RemoteInputs: "Inputs";
    RemoteOutputs: "Outputs";
    RemoteMemory: "Memory I/O";
    RemoteBits: "Bits";
    RemoteBytes: "Bytes";
    RemoteWords: "Words";
    RemoteFirstWord: "From word";
    RemoteOutputsNote: "Remote commands set outputs and do not read them. Only what was set in this dialog is known.";
    RemoteNumber: "Number";
    RemoteHexadecimal: "Hexadecimal";
    RemoteDecimal: "Decimal";
    RemoteBinary: "Binary";
    RemoteSet: "Set";
    RemoteSetOn: "Switch on";
    RemoteSetOff: "Switch off";
    RemoteHexByteRule: "Enter a hexadecimal number from 00 to FF";
    RemoteHexWordRule: "Enter a hexadecimal number from 0000 to FFFF";
    RemoteLabels: "Labels";
    RemoteLabelsHint: "A CSV file";
    RemoteLabelsTip: "Each line: input, output or memory; the number of the bit; its label. The file io-labels.csv in the controller's folder of the workspace is read when the dialog opens.";
    RemoteReadLabels: "Read labels";

    // variables
    RemoteVariablesNote: "Variables that are declared Global Preserve can be read and set. Each is read in every cycle.";
    RemoteVariableName: "Name of the variable";
    RemoteType: "Type";
    RemoteIndices: "Indices";
    RemoteCount: "Elements";
    RemoteVariableNameRule: "A name has letters, digits and underscores, and does not begin with a digit";
    RemoteIndicesRule: "Enter one to three indices with commas between them, such as 3,0; leave it empty for a variable that is no array";
    RemoteCountRule: "1 to 100 elements can be read at once";
    RemoteNoStringArrays: "Arrays of String cannot be read";
    RemoteVariableKnown: "The variable is in the table already";
    RemoteVariablesFull: "The table is full. Remove a variable first.";
    RemoteArrayReadOnly: "Elements are only read";
    RemoteValueRule: "Not a value of this type";

    // Execute
    RemoteSpel: "Command of SPEL+";
    RemoteSpelTip: "Enter sends it, Up and Down bring earlier commands back";
    RemoteSpelRule: "Enter a command of 1 to 256 bytes";
    RemoteExecute: "Execute";
    RemoteExecuteNote: "The command acts on the selected robot. Its answer comes when it has ended; Abort ends it earlier.";
    RemoteAgain: "Put it into the field again";

    // alarms
    RemoteAlarmsNote: "Alarms of batteries and other parts that wear. Reset an alarm after the part was replaced.";
    RemoteResetAlarm: "Reset alarm";

    // log
    RemoteLogText: "Text";
    RemoteLogPolling: "With polling";
    RemoteLogPollingTip: "Also the commands that are sent twice a second to read the state";
    RemoteLogEmpty: "No messages yet";
    RemoteLogClear: "Clear";
    RemoteSaveTitle: "Save the log of the connection";
    RemoteSaveText: "The messages that are shown are saved as text, each with its hexadecimal form. A file of the same name is replaced.";
}

pub fn remote_waiting(command: &str) -> String {
    format!("Waiting for the answer to {command}")
}

pub fn remote_error(code: u16, message: Option<&str>) -> String {
    match message {
        Some(message) => format!("{code:04}: {message}"),
        None => format!("Error or warning {code:04}; its text is in the error code list of the controller"),
    }
}

pub fn remote_robot(number: u8) -> String {
    format!("Robot {number}")
}

pub fn remote_bit(number: u16, label: Option<&str>, is_on: Option<bool>) -> String {
    let label = label.map(|label| format!(" {label}")).unwrap_or_default();
    let state = match is_on {
        Some(true) => "on",
        Some(false) => "off",
        None => "not known",
    };
    format!("Bit {number}{label}: {state}")
}

pub fn remote_io_unread(why: &str) -> String {
    format!("Some of these could not be read: {why}")
}

pub fn remote_labels(count: usize, skipped: usize) -> String {
    match skipped {
        0 => format!("{count} labels"),
        1 => format!("{count} labels; 1 line holds none"),
        _ => format!("{count} labels; {skipped} lines hold none"),
    }
}

pub fn remote_log_size(shown: usize, all: usize, dropped: u64) -> String {
    match dropped {
        0 => format!("{shown} of {all} messages"),
        _ => format!("{shown} of {all} messages; {dropped} older ones were dropped"),
    }
}

pub fn text_saved(path: &Path) -> String {
    format!("Saved in {}", path.display())
}
