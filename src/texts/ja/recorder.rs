//! What is said of recordings, in Japanese.

use std::path::Path;

fixed_texts! {
    RecordingController: "コントローラー";
    RecordingData: "データ";
    RecordingStarted: "開始";
    RecordingEnded: "終了";
    RecordingStoppedBy: "終了理由";
    RecordingSeconds: "長さ";
    RecordingRows: "行数";
    RecordingPackets: "パケット";
    RecordingMissing: "欠落";
    RecordingGaps: "ギャップ";
    RecordingForce: "力覚センサー";
    RecordingMotion: "モーションログ";
    StopRequest: "要求";
    StopDuration: "指定時間の経過";
    StopSize: "指定サイズへの到達";
    StopFooter: "力覚センサーの記録の終了";
    StopError: "エラー";
    StopKilled: "プログラムの中断";
    GapOverwritten: "コントローラー内で上書き";
    GapBrokenOff: "コントローラーによる中断";
    GapConnectionLost: "接続の切断";
    GapUnexplained: "原因不明";
    GapRestarted: "コントローラーの再起動";
    GapUndecodable: "読み取れないパケット";
}

pub fn recording_started(name: &str, file: &Path) -> String {
    format!("{name}：{}に記録しています。Ctrl-Cで終了します", file.display())
}

pub fn recording_recovered(file: &Path, rows: u64) -> String {
    format!("中断された記録を復元しました：{}、{rows}行", file.display())
}

pub fn recording_ended(file: &Path, rows: u64, missing: u64, gaps: usize) -> String {
    match gaps {
        0 => format!("{}：{rows}行、欠落なし", file.display()),
        gaps => format!("{}：{rows}行、ギャップ{gaps}件、欠落したブロックまたはレコード{missing}件", file.display()),
    }
}
