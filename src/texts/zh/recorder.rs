//! What is said of recordings, in Chinese.

use std::path::Path;

fixed_texts! {
    RecordingController: "控制器";
    RecordingData: "数据";
    RecordingStarted: "开始时间";
    RecordingEnded: "结束时间";
    RecordingStoppedBy: "结束原因";
    RecordingSeconds: "时长";
    RecordingRows: "行数";
    RecordingPackets: "数据包";
    RecordingMissing: "缺失";
    RecordingGaps: "间断";
    RecordingForce: "力觉传感器";
    RecordingMotion: "机器人控制信息";
    StopRequest: "用户请求";
    StopDuration: "到达指定时间";
    StopSize: "达到指定大小";
    StopFooter: "力觉传感器记录结束";
    StopError: "发生错误";
    StopKilled: "程序中断";
    GapOverwritten: "在控制器中被覆盖";
    GapBrokenOff: "被控制器中断";
    GapConnectionLost: "连接中断";
    GapUnexplained: "控制器未说明原因";
    GapRestarted: "控制器重新启动";
    GapUndecodable: "无法读取的数据包";
    Recorder: "数据记录…";
    RecorderTip: "将控制器的力觉传感器数据或机器人控制信息记录到文件，并同时显示曲线";
    RecorderTitle: "数据记录";
    RecorderMotionTip: "固件 8.0.0 及更高版本的编码器、电流、速度、I/O、力觉传感器和工具中心点";
    RecorderForceTip: "程序在 RecordStart 和 RecordEnd 之间记录的数据";
    RecorderInterval: "SamplingInterval";
    RecorderIntervalTip: "采样周期为最短周期乘以此倍数。使用最短周期时，网络较慢可能会丢失数据。";
    RecorderMonitor: "监视器";
    RecorderMonitorTip: "2 用于同时运行的第二个 RecordStart";
    RecorderDataType: "DataType";
    ForceDataAll: "力、力矩、位置、参考位置、速度、关节、过载率";
    ForceDataMotion: "位置、速度、关节、过载率";
    ForceDataForce: "力、力矩、位置";
    ForceDataPosition: "仅位置";
    RecorderDataNum: "DataNum";
    RecorderDataNumHint: "0：由控制器决定";
    RecorderDataNumText: "一次读取最多返回的数据块或记录数。数值过小可能会丢失数据。";
    RecorderBlocksRule: "0 到 200 的整数";
    RecorderRecordsRule: "0 到 65535 的整数";
    RecorderPortText: "记录期间会设置 Port：在记录结束之前，控制器将力觉传感器数据发送到 OPC UA，而不发送到 RC+。请在 RecordStart 之前开始记录。";
    RecorderFiles: "文件";
    RecorderFolder: "文件夹";
    RecorderFolderTitle: "记录的文件夹";
    RecorderFolderRule: "请输入文件夹路径";
    RecorderFormat: "格式";
    RecorderCsvTip: "文本格式，每行一条数据；写入过程中即可读取";
    RecorderParquetTip: "适用于 pandas 等工具的列式格式；体积小，记录结束后可读取";
    RecorderKeepPackets: "同时保留数据包";
    RecorderKeepPacketsTip: "按原样保存全部数据的 .packets 文件；以后可以打开和转换";
    RecorderEnds: "每个记录在达到以下条件后自动结束";
    RecorderSeconds: "时间 (s)";
    RecorderMegabytes: "数据包大小 (MB)";
    RecorderFooters: "力觉传感器记录次数";
    RecorderNoLimit: "无限制";
    RecorderLimitRule: "1 以上的整数，或留空";
    RecorderLogin: "使用本工具的证书登录 OPC UA 服务器";
    RecorderAnonymous: "留空：匿名";
    RecorderStart: "开始记录";
    RecorderStop: "停止记录";
    RecorderStopOne: "停止";
    RecorderStopTip: "结束此记录并完成其文件";
    RecorderShow: "显示";
    RecorderAgain: "新建记录";
    RecorderRetryTip: "重新开始所有失败的记录";
    RecorderChooseTip: "下方显示所选控制器的曲线";
    RecorderState: "状态";
    RecorderStateTip: "记录的当前状态";
    RecorderRowsTip: "文件的行数：力觉传感器记录，或每个数据块八行";
    RecorderMissingTip: "已知未收到的数据块或记录";
    RecorderWarnings: "警告";
    RecorderWarningsTip: "控制器覆盖未及时读取的数据的次数，以及无法读取的数据包数";
    RecorderSize: "文件大小";
    RecorderSizeTip: "已写入 CSV 或 Parquet 文件的字节数；数据包每秒安全写入一次";
    RecorderFinding: "正在查找服务器";
    RecorderWaiting: "等待控制器开始记录";
    RecorderRunning: "正在记录";
    RecorderReconnecting: "正在重新连接";
    RecorderFinishing: "正在完成文件";
    RecorderGoesOn: "关闭此对话框后记录会继续进行。可通过状态栏返回。";
    RecorderBackTip: "打开显示这些记录的对话框";
    RecorderNoValues: "尚未收到数值";
    RecorderNoValuesEnded: "没有这些量的数值";
    RecorderPlotsFull: "最多显示四个曲线图。请先取消一个。";
    RecorderWhole: "全部";
    RecorderWholeTip: "显示全部时间（Home 键或双击）";
    RecorderPauseTip: "保持当前显示的时间（P 键）；记录继续进行";
    RecorderFollowTip: "重新跟随最新数值（P 键）";
    RecorderZoomIn: "放大";
    RecorderZoomOut: "缩小";
    RecorderPlotKeys: "拖动或方向键：移动。鼠标滚轮、加号和减号：缩放。Home 键或双击：全部。P：暂停。";
    RecorderColumnTip: "隐藏或重新显示该曲线";
    OpenRecording: "打开记录…";
    OpenRecordingTip: "显示记录的内容并绘制其曲线";
    OpenRecordingTitle: "记录";
    OpenRecordingText: "记录的 CSV 或 Parquet 文件（同一文件夹中需有 .json 文件），或 .packets 文件。也可以将文件拖放到窗口中。";
    OpenRecordingNow: "打开";
    RecordingFile: "文件";
    KindRecording: "力觉传感器或机器人控制信息的记录";
    CloseRecordings: "正在进行记录。记录现在会结束，每个文件完成后窗口才会关闭。";
    CloseStopRecordings: "停止记录后关闭";
    CloseCompleting: "记录文件完成后窗口将关闭。";
    QuantityForces: "力";
    QuantityTorques: "力矩";
    QuantityPosition: "位置";
    QuantityOrientation: "姿态";
    QuantityReferencePosition: "参考位置";
    QuantityReferenceOrientation: "参考姿态";
    QuantityCorrection: "修正量";
    QuantitySpeed: "工具速度";
    QuantityJoints: "关节";
    QuantityOverload: "过载率";
    QuantityProgram: "步骤和序列";
    QuantityEncoderPositions: "编码器位置";
    QuantityEncoderTemperatures: "编码器温度";
    QuantityDirectCurrents: "电流 (d 轴)";
    QuantityQuadratureCurrents: "电流 (q 轴)";
    QuantityMotorSpeeds: "电机速度";
    QuantityElectricalAngles: "电角度";
    QuantityInputsOutputs: "I/O";
    QuantitySensorCounts: "力觉传感器";
    QuantityPulseCounters: "脉冲计数器";
}

pub fn recording_started(name: &str, file: &Path) -> String {
    format!("{name}：正在记录到 {}；按 Ctrl-C 结束", file.display())
}

pub fn recording_recovered(file: &Path, rows: u64) -> String {
    format!("已恢复中断的记录：{}，{rows} 行", file.display())
}

pub fn recording_ended(file: &Path, rows: u64, missing: u64, gaps: usize) -> String {
    match gaps {
        0 => format!("{}：{rows} 行，无缺失", file.display()),
        gaps => format!("{}：{rows} 行，{gaps} 处间断，共缺失 {missing} 个数据块或记录", file.display()),
    }
}

pub fn recording_end(reason: &str) -> String {
    format!("已结束：{reason}")
}

pub fn recording_missing(missing: u64, gaps: u64) -> String {
    match (missing, gaps) {
        (_, 0) => "0".to_owned(),
        (0, gaps) => format!("?（{gaps} 处间断）"),
        (missing, gaps) => format!("{missing}（{gaps} 处间断）"),
    }
}

pub fn recording_gaps(gaps: usize) -> String {
    format!("{gaps} 处间断")
}

pub fn recording_gap(row: u64, missing: Option<u64>, cause: &str) -> String {
    match missing {
        Some(missing) => format!("第 {row} 行：缺失 {missing}，{cause}"),
        None => format!("第 {row} 行：缺失数量未知，{cause}"),
    }
}

pub fn recording_range(from: f64, to: f64) -> String {
    format!("{from:.3} s 至 {to:.3} s")
}

pub fn recordings_running(count: usize) -> String {
    format!("正在记录：{count}")
}

pub fn recordings_ended(failed: usize) -> String {
    match failed {
        0 => "记录已结束".to_owned(),
        failed => format!("记录已结束，{failed} 个失败"),
    }
}
