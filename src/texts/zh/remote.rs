//! What is said of remote commands, in Chinese.

fixed_texts! {
    RemoteActStart: "程序函数将启动，机器人可能动作";
    RemoteActStop: "所有任务和命令将停止";
    RemoteActPause: "所有任务将暂停";
    RemoteActContinue: "已暂停的任务将继续，机器人可能动作";
    RemoteActReset: "将复位紧急停止和错误，并关闭输出";
    RemoteActMotorsOn: "将打开电机";
    RemoteActMotorsOff: "将关闭电机，机械臂可能下落";
    RemoteActRobot: "将为要执行的命令选择其他机器人";
    RemoteActHome: "机器人将移动到起始点位置";
    RemoteActOutputs: "将切换输出，由其控制的设备可能动作";
    RemoteActMemory: "将更改内存 I/O，程序可能对此作出反应";
    RemoteActVariable: "将更改变量，程序可能对此作出反应";
    RemoteActExecute: "将执行命令，所选机器人可能动作";
    RemoteActAbort: "将中止正在执行的命令";
    RemoteActAlarm: "将复位消耗部件的报警";
    RemoteNeedsAuto: "操作模式不是 AUTO，或控制设备未设为远程。请切换到 AUTO 并设置控制设备。";
    RemoteNeedsReady: "有任务正在运行或已暂停。请停止该任务，或等待其结束。";
    RemoteNeedsRunning: "没有可暂停的运行中任务。";
    RemoteNeedsPaused: "没有可继续的已暂停任务。";
    RemoteNeedsNoError: "存在错误。请排除原因，然后复位。";
    RemoteNeedsNoEStop: "紧急停止有效。请解除紧急停止，然后复位。";
    RemoteNeedsNoSafeguard: "安全门已打开。请关闭安全门。";
    RemoteNoAlarm: "没有报警";
    RemoteNoResult: "已执行，没有结果";
    RemoteNothingTold: "该固件不响应监视命令";
    RemoteAskPassword: "远程命令的密码";
    RemoteName: "名称";
    RemoteSerial: "序列号";
    RemoteModel: "型号";
    RemoteFirmware: "固件";
    RemoteControlDevice: "控制设备";
    RemoteSubnetMask: "子网掩码";
    RemoteGateway: "网关";
    RemoteMac: "MAC 地址";
    RemoteProject: "项目";
    RemoteCpuLoad: "CPU 负载 (%)";
    RemoteBattery: "电池";
    RemoteRobot: "机器人";
    RemoteMotors: "电机";
    RemotePower: "功率";
    RemoteHigh: "高";
    RemoteLow: "低";
    RemotePartsDue: "需要更换的部件";
    RemotePartBattery: "电池";
    RemotePartBelt: "同步带";
    RemotePartGrease: "润滑脂";
    RemotePartMotor: "电机";
    RemotePartGear: "减速机";
    RemotePartBallScrew: "滚珠丝杠";
}

pub fn remote_status(flags: &[&str], code: u16) -> String {
    let flags = if flags.is_empty() { "没有有效的状态".to_owned() } else { flags.join("、") };
    if code == 0 { flags } else { format!("{flags}；错误或警告 {code:04}") }
}

pub fn remote_logged_in(target: &str) -> String {
    format!("{target}：登录成功")
}

pub fn remote_alarms(numbers: &str) -> String {
    format!("报警：{numbers}")
}

pub fn remote_done(command: &str) -> String {
    format!("{command}：已执行")
}

pub fn remote_watch_goes_on(problem: &str) -> String {
    format!("{problem}；正在重试")
}

pub fn remote_bad_argument(argument: &str, value: &str, possible: &str) -> String {
    format!("{argument}：“{value}”无效；可用的值为 {possible}")
}
