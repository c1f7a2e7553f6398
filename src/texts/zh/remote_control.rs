//! The window for remote control, in Chinese.

use std::path::Path;

fixed_texts! {
    RemoteControl: "远程控制…";
    RemoteControlTip: "通过远程命令查看和控制一台控制器的状态、程序、电机、I/O 和变量";
    RemoteControlTitle: "远程控制";
    RemoteTabControl: "控制";
    RemoteTabIo: "I/O";
    RemoteTabVariables: "变量";
    RemoteTabExecute: "执行";
    RemoteTabAlarms: "报警";
    RemoteTabLog: "日志";

    // connection
    RemoteTarget: "连接";
    RemoteTargetForms: "远程以太网：tcp://192.168.0.1:5000。串口：serial:COM3?baud=19200 或 serial:/dev/ttyS0。串口服务器：raw-tcp://192.168.0.7:4001。";
    RemoteTargetRule: "请按以下示例的格式输入连接";
    RemotePasswordRule: "远程命令的密码最多 16 个可打印字符";
    RemoteOneClient: "控制器同时只为一个远程命令客户端服务。连接后首先仅进行监视。";
    RemoteNotConnected: "未连接";
    RemoteLiveTip: "每秒读取两次状态";
    RemoteOld: "以下显示的是连接中断之前读取的内容";
    RemoteChangeConnection: "连接到其他位置";
    RemoteDisconnect: "断开";

    // the switch
    RemoteMonitoring: "仅监视";
    RemoteMonitoringText: "不发送任何会引起动作或更改的命令。";
    RemoteAllow: "允许发送命令…";
    RemoteAllowed: "已允许发送命令";
    RemoteAllowedText: "机器人、电机、输出和程序会立即响应。";
    RemoteForbid: "仅监视";
    RemoteAllowTitle: "允许发送命令";
    RemoteAllowRobots: "机器人可能立即动作：启动、继续、回起始点和执行命令都会引起动作；关闭电机时机械臂可能下落。";
    RemoteAllowOutputs: "输出会立即切换，由其控制的夹具、阀门和输送带也会随之动作。";
    RemoteAllowProgram: "程序会启动、停止，并对此处设置的变量和内存 I/O 作出反应。";
    RemoteAllowSafety: "请确认设备的动作范围内无人，并且紧急停止按钮就在您手边。";
    RemoteAllowEnds: "仅在此对话框中允许发送命令，关闭对话框或连接结束后失效。";
    RemoteAllowNow: "允许";
    RemoteWhyNotConnected: "未连接到控制器";
    RemoteWhyMonitoring: "当前仅监视。请先允许发送命令。";

    // lamps
    RemoteFlagTest: "控制器处于 TEST 模式";
    RemoteFlagTeach: "控制器处于 TEACH 模式";
    RemoteFlagAuto: "接受会引起动作的远程命令";
    RemoteFlagWarning: "有警告；任务继续运行";
    RemoteFlagSError: "有系统错误；必须重新启动控制器";
    RemoteFlagSafeguard: "安全门已打开";
    RemoteFlagEStop: "紧急停止有效";
    RemoteFlagError: "有错误，可通过复位清除";
    RemoteFlagPaused: "任务已暂停";
    RemoteFlagRunning: "任务正在运行";
    RemoteFlagReady: "控制器已启动，没有任务运行";

    // control
    RemoteProgram: "程序";
    RemoteFunction: "函数";
    RemoteStart: "启动";
    RemoteStop: "停止";
    RemotePause: "暂停";
    RemoteContinue: "继续";
    RemoteReset: "复位";
    RemoteAbort: "中止";
    RemoteRobots: "机器人";
    RemoteAllRobots: "所有机器人";
    RemoteRobotTip: "右侧按钮所作用的机器人";
    RemoteOneRobot: "请选择一台机器人";
    RemoteMotorsOn: "打开电机";
    RemoteMotorsOff: "关闭电机";
    RemoteHome: "回起始点";
    RemoteSelectRobot: "选择";
    RemoteCurrentRobot: "执行命令的机器人";

    // I/O
    RemoteInputs: "输入";
    RemoteOutputs: "输出";
    RemoteMemory: "内存 I/O";
    RemoteBits: "位";
    RemoteBytes: "字节";
    RemoteWords: "字";
    RemoteFirstWord: "起始字";
    RemoteOutputsNote: "远程命令只能设置输出，不能读取输出。仅显示在此对话框中设置的状态。";
    RemoteNumber: "编号";
    RemoteHexadecimal: "十六进制";
    RemoteDecimal: "十进制";
    RemoteBinary: "二进制";
    RemoteSet: "设置";
    RemoteSetOn: "打开";
    RemoteSetOff: "关闭";
    RemoteHexByteRule: "请输入 00 至 FF 的十六进制数";
    RemoteHexWordRule: "请输入 0000 至 FFFF 的十六进制数";
    RemoteLabels: "标签";
    RemoteLabelsHint: "CSV 文件";
    RemoteLabelsTip: "每行依次为：input、output 或 memory；位编号；标签。打开对话框时读取工作区中该控制器文件夹内的 io-labels.csv。";
    RemoteReadLabels: "读取标签";

    // variables
    RemoteVariablesNote: "可以读取和设置声明为 Global Preserve 的变量。每个变量在每个周期读取一次。";
    RemoteVariableName: "变量名称";
    RemoteType: "类型";
    RemoteIndices: "下标";
    RemoteCount: "元素数";
    RemoteVariableNameRule: "名称由字母、数字和下划线组成，且不以数字开头";
    RemoteIndicesRule: "请输入一至三个以逗号分隔的下标，例如 3,0；非数组变量请留空";
    RemoteCountRule: "一次可读取 1 至 100 个元素";
    RemoteNoStringArrays: "不能读取 String 数组";
    RemoteVariableKnown: "该变量已在表中";
    RemoteVariablesFull: "表已满。请先移除一个变量。";
    RemoteArrayReadOnly: "数组元素只能读取";
    RemoteValueRule: "不是该类型的值";

    // Execute
    RemoteSpel: "SPEL+ 命令";
    RemoteSpelTip: "按 Enter 发送，按上下方向键调出以前的命令";
    RemoteSpelRule: "请输入 1 至 256 字节的命令";
    RemoteExecute: "执行";
    RemoteExecuteNote: "命令作用于所选机器人。命令结束后才有应答；可用中止提前结束。";
    RemoteAgain: "再次填入输入框";

    // alarms
    RemoteAlarmsNote: "电池及其他消耗部件的报警。更换部件后请复位报警。";
    RemoteResetAlarm: "复位报警";

    // log
    RemoteLogText: "文本";
    RemoteLogPolling: "包括轮询";
    RemoteLogPollingTip: "同时显示每秒两次读取状态的命令";
    RemoteLogEmpty: "尚无消息";
    RemoteLogClear: "清除";
    RemoteSaveTitle: "保存连接日志";
    RemoteSaveText: "将显示的消息保存为文本，每条消息附十六进制形式。同名文件将被替换。";
}

pub fn remote_waiting(command: &str) -> String {
    format!("正在等待 {command} 的应答")
}

pub fn remote_error(code: u16, message: Option<&str>) -> String {
    match message {
        Some(message) => format!("{code:04}：{message}"),
        None => format!("错误或警告 {code:04}；说明请参阅控制器的错误代码表"),
    }
}

pub fn remote_robot(number: u8) -> String {
    format!("机器人 {number}")
}

pub fn remote_bit(number: u16, label: Option<&str>, is_on: Option<bool>) -> String {
    let label = label.map(|label| format!(" {label}")).unwrap_or_default();
    let state = match is_on {
        Some(true) => "开",
        Some(false) => "关",
        None => "未知",
    };
    format!("位 {number}{label}：{state}")
}

pub fn remote_io_unread(why: &str) -> String {
    format!("其中一部分无法读取：{why}")
}

pub fn remote_labels(count: usize, skipped: usize) -> String {
    match skipped {
        0 => format!("{count} 个标签"),
        _ => format!("{count} 个标签；{skipped} 行没有标签"),
    }
}

pub fn remote_log_size(shown: usize, all: usize, dropped: u64) -> String {
    match dropped {
        0 => format!("显示 {shown} 条，共 {all} 条消息"),
        _ => format!("显示 {shown} 条，共 {all} 条消息；已删除 {dropped} 条较早的消息"),
    }
}

pub fn text_saved(path: &Path) -> String {
    format!("已保存到 {}", path.display())
}
