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
