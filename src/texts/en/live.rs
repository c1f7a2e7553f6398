//! Live values, in English.

english_texts! { live:
    LiveValues: "Live values…";
    LiveValuesTip: "Robots, safety, I/O and all nodes of one OPC UA server as they change";
    LiveTitle: "Live values";
    LiveRobot: "Robot";
    LiveSafety: "Safety and tasks";
    LiveIo: "I/O";
    LiveVariables: "Variables";
    LiveConsumables: "Consumables";
    LiveStatus: "Status";
    LiveNodes: "All nodes";
    LivePlot: "Plot";
    LiveSectionKeys: "Ctrl+Page Up and Ctrl+Page Down change the tab";
    LiveConnecting: "Connecting";
    LiveLiveTip: "The server reports each change within a fraction of a second";
    LiveOld: "The values below are the last ones before the connection was lost";
    LiveAnonymous: "Anonymous";
    LiveLogin: "Log in…";
    LiveLoginText: "Without a user name the login is anonymous. The password is sent encrypted only, and not again once it was refused.";
    LiveConnect: "Connect";
    LiveEmpty: "The server shows nothing of this kind. Which nodes there are depends on the firmware and the options of the controller.";
    LiveCut: "The server has more nodes than are arranged in the other tabs. All nodes shows every one.";
    LiveOn: "On";
    LiveOff: "Off";
    LiveMotors: "Motors";
    LivePower: "Power";
    LivePowerHigh: "High";
    LivePowerLow: "Low";
    LiveHome: "Home position";
    LiveAtHome: "Reached";
    LiveNotAtHome: "Not reached, or not defined";
    LiveSpeedOverride: "Speed factor";
    LiveMotorOnTime: "Motor-on time";
    LiveMotorOnCount: "Times motors were switched on";
    LiveNumber: "Robot number";
    LiveKind: "Kind";
    LiveSixAxis: "Six-axis";
    LiveScara: "SCARA";
    LiveOtherKind: "Other";
    LivePose: "Tool center point";
    LiveTarget: "Target";
    LiveActual: "Actual";
    LiveAxis: "Axis";
    LivePosition: "Position";
    LiveRange: "Range";
    LiveSpeed: "Speed";
    LiveAcceleration: "Acceleration";
    LiveTorque: "Torque";
    LiveLoad: "Load";
    LiveMotorTemperature: "Motor temperature";
    LiveHofs: "Hofs";
    LiveController: "Controller";
    LiveSafetyState: "Safety";
    LiveOperationalMode: "Operational mode";
    LiveManualReduced: "Manual, reduced speed";
    LiveManualHigh: "Manual, high speed";
    LiveAutomatic: "Automatic";
    LiveAutomaticExternal: "Automatic, external";
    LiveOtherMode: "Other";
    LiveEmergencyStop: "Emergency stop";
    LiveProtectiveStop: "Protective stop";
    LiveStopped: "Active";
    LiveNotStopped: "Not active";
    LiveTasks: "Tasks";
    LiveTask: "Task";
    LiveTaskName: "Function";
    LiveProgram: "Program";
    LiveExecuting: "Executing";
    LiveExecutes: "Yes";
    LiveDoesNotExecute: "No";
    LiveMode: "Mode";
    LiveCycle: "Cycle";
    LiveContinuous: "Continuous";
    LiveStep: "JobStep";
    LiveVariable: "Variable";
    LiveValue: "Value";
    LiveProject: "SPEL project";
    LiveNoVariables: "The project has no Global Preserve variables whose name begins with OPCUA_. After such variables are added, the project must be built and the server restarted.";
    LivePart: "Part";
    LiveOwner: "Belongs to";
    LiveMonthsLeft: "Months left";
    LiveConsumed: "Consumption";
    LiveInstalled: "Installed";
    LiveNotManaged: "Not managed";
    LiveStatusCode: "Status code";
    LiveCpuLoad: "CPU load";
    LiveForce: "Force sensor";
    LiveMotionLog: "Motion log";
    LiveQueue: "Queue";
    LiveRecording: "Recording";
    LiveDataExists: "Data";
    LiveQueueError: "Error";
    LiveDataNote: "The recorded data is not read here: each read takes it away from the client that records it.";
    LiveChoose: "Choose a node to see its attributes";
    LiveQuality: "Quality";
    LiveSourceTime: "Source time";
    LiveServerTime: "Server time";
    LiveAddToPlot: "Add to plot";
    LiveRemoveFromPlot: "Remove from plot";
    LiveNotNumeric: "Only a number can be plotted";
    LivePlotFull: "The plot is full. Remove a value first.";
    LivePlotEmpty: "Nothing is plotted yet. Drag a number onto the tab Plot, or choose Add to plot in its context menu.";
    LivePlotPause: "Pause";
    LivePlotResume: "Follow";
    LivePlotClear: "Remove all";
    LivePlotRemove: "Remove";
    LiveDropHere: "Drop here to plot";
    LiveWrite: "Write a value…";
    LiveWriteTitle: "Write a value";
    LiveWriteText: "The value is written into the controller at once, and other clients see it as well.";
    LiveWriteNow: "Write";
    LiveNewValue: "New value";
    LiveOldValue: "Value now";
    LiveWriting: "Writing";
    LiveWritten: "The value was written";
    LiveNotWritable: "The value of this node can only be read";
    LiveNotWritableNow: "Not while the connection is lost";
}

pub fn live_bit(number: u32, is_on: Option<bool>) -> String {
    match is_on {
        Some(true) => format!("Bit {number}: on"),
        Some(false) => format!("Bit {number}: off"),
        None => format!("Bit {number}: no value"),
    }
}

pub fn live_duration(days: u64, hours: u64, minutes: u64, seconds: u64) -> String {
    match (days, hours) {
        (0, 0) => format!("{minutes} min {seconds} s"),
        (0, _) => format!("{hours} h {minutes} min"),
        (_, _) => format!("{days} d {hours} h"),
    }
}

pub fn live_not_of_type(data_type: &str) -> String {
    format!("Not a value of the type {data_type}")
}

pub fn live_write_refused(status: &str) -> String {
    match status {
        "BadOutOfRange" => "The controller refuses the value: it is outside the permitted range".to_owned(),
        "BadTypeMismatch" => "The controller refuses the value: it has the wrong type".to_owned(),
        "BadNotWritable" | "BadUserAccessDenied" => "This user may not write the node".to_owned(),
        _ => format!("The controller refuses the value: {status}"),
    }
}

pub fn live_span(seconds: u32) -> String {
    match seconds {
        0..60 => format!("{seconds} s"),
        60..3600 => format!("{} min", seconds / 60),
        _ => format!("{} h", seconds / 3600),
    }
}

pub fn live_logged_in(user: &str) -> String {
    format!("User {user}")
}
