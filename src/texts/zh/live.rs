//! Live values, in Chinese.

fixed_texts! {
    LiveValues: "实时值…";
    LiveValuesTip: "以实时方式查看一个 OPC UA 服务器的机器人、安全、I/O 和所有节点";
    LiveTitle: "实时值";
    LiveRobot: "机器人";
    LiveSafety: "安全和任务";
    LiveIo: "I/O";
    LiveVariables: "变量";
    LiveConsumables: "消耗品";
    LiveStatus: "状态";
    LiveNodes: "所有节点";
    LivePlot: "曲线";
    LiveSectionKeys: "Ctrl+Page Up 和 Ctrl+Page Down 切换选项卡";
    LiveConnecting: "正在连接";
    LiveLiveTip: "服务器在不到一秒内报告每个变化";
    LiveOld: "以下是连接中断前的最后值";
    LiveAnonymous: "匿名";
    LiveLogin: "登录…";
    LiveLoginText: "不填写用户名时以匿名方式登录。密码仅以加密方式发送，被拒绝后不再发送。";
    LiveConnect: "连接";
    LiveEmpty: "服务器没有此类节点。有哪些节点取决于控制器的固件和选件。";
    LiveCut: "服务器的节点过多，其他选项卡未全部列出。“所有节点”显示全部。";
    LiveOn: "开";
    LiveOff: "关";
    LiveMotors: "电机";
    LivePower: "功率";
    LivePowerHigh: "高";
    LivePowerLow: "低";
    LiveHome: "Home 位置";
    LiveAtHome: "已到达";
    LiveNotAtHome: "未到达或未设置";
    LiveSpeedOverride: "速度比例";
    LiveMotorOnTime: "励磁时间";
    LiveMotorOnCount: "励磁次数";
    LiveNumber: "机器人编号";
    LiveKind: "类型";
    LiveSixAxis: "6 轴";
    LiveScara: "SCARA";
    LiveOtherKind: "其他";
    LivePose: "工具中心点";
    LiveTarget: "目标";
    LiveActual: "实际";
    LiveAxis: "轴";
    LivePosition: "位置";
    LiveRange: "范围";
    LiveSpeed: "速度";
    LiveAcceleration: "加速度";
    LiveTorque: "扭矩";
    LiveLoad: "负载率";
    LiveMotorTemperature: "电机温度";
    LiveHofs: "Hofs";
    LiveController: "控制器";
    LiveSafetyState: "安全";
    LiveOperationalMode: "运行模式";
    LiveManualReduced: "手动，低速";
    LiveManualHigh: "手动，高速";
    LiveAutomatic: "自动";
    LiveAutomaticExternal: "自动，外部";
    LiveOtherMode: "其他";
    LiveEmergencyStop: "紧急停止";
    LiveProtectiveStop: "保护性停止";
    LiveStopped: "生效";
    LiveNotStopped: "未生效";
    LiveTasks: "任务";
    LiveTask: "任务";
    LiveTaskName: "功能";
    LiveProgram: "程序";
    LiveExecuting: "执行";
    LiveExecutes: "是";
    LiveDoesNotExecute: "否";
    LiveMode: "模式";
    LiveCycle: "循环";
    LiveContinuous: "连续";
    LiveStep: "单步";
    LiveVariable: "变量";
    LiveValue: "值";
    LiveProject: "SPEL 项目";
    LiveNoVariables: "项目中没有名称以 OPCUA_ 开头的 Global Preserve 变量。添加此类变量后，需要构建项目并重新启动服务器。";
    LivePart: "零件";
    LiveOwner: "所属";
    LiveMonthsLeft: "剩余月数";
    LiveConsumed: "消耗率";
    LiveInstalled: "更换日期";
    LiveNotManaged: "未管理";
    LiveStatusCode: "状态码";
    LiveCpuLoad: "CPU 负荷率";
    LiveForce: "力觉传感器";
    LiveMotionLog: "机器人控制信息";
    LiveQueue: "队列";
    LiveRecording: "采集";
    LiveDataExists: "数据";
    LiveQueueError: "错误";
    LiveDataNote: "此处不读取采集的数据：每次读取都会从队列中取走数据，使采集数据的客户端无法再获取。";
    LiveChoose: "选择一个节点以查看其属性";
    LiveQuality: "质量";
    LiveSourceTime: "源时间";
    LiveServerTime: "服务器时间";
    LiveAddToPlot: "添加到曲线";
    LiveRemoveFromPlot: "从曲线移除";
    LiveNotNumeric: "只能绘制数值";
    LivePlotFull: "曲线已满，请先移除一个值。";
    LivePlotEmpty: "尚无曲线。将数值拖到“曲线”选项卡上，或在其快捷菜单中选择“添加到曲线”。";
    LivePlotPause: "暂停";
    LivePlotResume: "跟随";
    LivePlotClear: "全部移除";
    LivePlotRemove: "移除";
    LiveDropHere: "拖放到此处以绘制曲线";
    LiveWrite: "写入值…";
    LiveWriteTitle: "写入值";
    LiveWriteText: "该值将立即写入控制器，其他客户端也会看到。";
    LiveWriteNow: "写入";
    LiveNewValue: "新值";
    LiveOldValue: "当前值";
    LiveWriting: "正在写入";
    LiveWritten: "值已写入";
    LiveNotWritable: "该节点的值只读";
    LiveNotWritableNow: "连接中断时无法写入";
}

pub fn live_bit(number: u32, is_on: Option<bool>) -> String {
    match is_on {
        Some(true) => format!("位 {number}：开"),
        Some(false) => format!("位 {number}：关"),
        None => format!("位 {number}：无值"),
    }
}

pub fn live_duration(days: u64, hours: u64, minutes: u64, seconds: u64) -> String {
    match (days, hours) {
        (0, 0) => format!("{minutes} 分 {seconds} 秒"),
        (0, _) => format!("{hours} 小时 {minutes} 分"),
        (_, _) => format!("{days} 天 {hours} 小时"),
    }
}

pub fn live_not_of_type(data_type: &str) -> String {
    format!("不是 {data_type} 类型的值")
}

pub fn live_write_refused(status: &str) -> String {
    match status {
        "BadOutOfRange" => "控制器拒绝该值：超出允许范围".to_owned(),
        "BadTypeMismatch" => "控制器拒绝该值：类型不符".to_owned(),
        "BadNotWritable" | "BadUserAccessDenied" => "该用户无权写入此节点".to_owned(),
        _ => format!("控制器拒绝该值：{status}"),
    }
}

pub fn live_span(seconds: u32) -> String {
    match seconds {
        0..60 => format!("{seconds} 秒"),
        60..3600 => format!("{} 分钟", seconds / 60),
        _ => format!("{} 小时", seconds / 3600),
    }
}

pub fn live_logged_in(user: &str) -> String {
    format!("用户 {user}")
}
