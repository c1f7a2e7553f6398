//! What is said of remote commands, in English.

english_texts! { remote:
    RemoteActStart: "A function of the program starts, and robots may move";
    RemoteActStop: "All tasks and commands stop";
    RemoteActPause: "All tasks pause";
    RemoteActContinue: "Paused tasks continue, and robots may move";
    RemoteActReset: "Emergency stop and error are reset, and outputs go off";
    RemoteActMotorsOn: "Motors are switched on";
    RemoteActMotorsOff: "Motors are switched off, and an arm may sink";
    RemoteActRobot: "Another robot is selected for commands that are executed";
    RemoteActHome: "The robot moves to its home position";
    RemoteActOutputs: "Outputs are switched, and machines that they control may move";
    RemoteActMemory: "Memory I/O is changed, to which the program may react";
    RemoteActVariable: "A variable is changed, to which the program may react";
    RemoteActExecute: "A command is executed, and the selected robot may move";
    RemoteActAbort: "The command that is being executed is aborted";
    RemoteActAlarm: "The alarm of a part that wears is reset";
    RemoteNeedsAuto: "The mode is not AUTO, or remote is not the control device. Switch to AUTO and set the control device.";
    RemoteNeedsReady: "A task runs or is paused. Stop it, or wait until it has ended.";
    RemoteNeedsRunning: "No task runs, so there is nothing to pause.";
    RemoteNeedsPaused: "No task is paused, so there is nothing to continue.";
    RemoteNeedsNoError: "There is an error. Clear its cause, then reset it.";
    RemoteNeedsNoEStop: "The emergency stop is on. Release it, then reset it.";
    RemoteNeedsNoSafeguard: "The safeguard is open. Close it.";
    RemoteNoAlarm: "No alarm";
    RemoteNoResult: "Done, without a result";
    RemoteNothingTold: "The firmware does not answer the monitoring commands";
    RemoteAskPassword: "Password for remote commands";
    RemoteName: "Name";
    RemoteSerial: "Serial number";
    RemoteModel: "Model";
    RemoteFirmware: "Firmware";
    RemoteControlDevice: "Control device";
    RemoteSubnetMask: "Subnet mask";
    RemoteGateway: "Gateway";
    RemoteMac: "MAC address";
    RemoteProject: "Project";
    RemoteCpuLoad: "CPU load (%)";
    RemoteBattery: "Battery";
    RemoteRobot: "Robot";
    RemoteMotors: "Motors";
    RemotePower: "Power";
    RemoteHigh: "high";
    RemoteLow: "low";
    RemotePartsDue: "Parts to be replaced";
    RemotePartBattery: "battery";
    RemotePartBelt: "belt";
    RemotePartGrease: "grease";
    RemotePartMotor: "motor";
    RemotePartGear: "reduction gear";
    RemotePartBallScrew: "ball screw";
}

pub fn remote_status(flags: &[&str], code: u16) -> String {
    let flags = if flags.is_empty() { "no state is on".to_owned() } else { flags.join(", ") };
    if code == 0 { flags } else { format!("{flags}; error or warning {code:04}") }
}

pub fn remote_logged_in(target: &str) -> String {
    format!("{target}: the login succeeded")
}

pub fn remote_alarms(numbers: &str) -> String {
    format!("Alarms: {numbers}")
}

pub fn remote_done(command: &str) -> String {
    format!("{command}: done")
}

pub fn remote_watch_goes_on(problem: &str) -> String {
    format!("{problem}; trying again")
}

pub fn remote_bad_argument(argument: &str, value: &str, possible: &str) -> String {
    format!("{argument}: \"{value}\" is not possible; possible is {possible}")
}
