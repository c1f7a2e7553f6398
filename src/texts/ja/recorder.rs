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
    Recorder: "レコーダー…";
    RecorderTip: "コントローラーの力覚センサーまたはモーションログのデータをファイルに記録し、同時にグラフで表示します";
    RecorderTitle: "レコーダー";
    RecorderMotionTip: "ファームウェア8.0.0以降のエンコーダー、電流、速度、I/O、力覚センサー、ツール中心点";
    RecorderForceTip: "プログラムがRecordStartとRecordEndの間に記録するデータ";
    RecorderInterval: "SamplingInterval";
    RecorderIntervalTip: "サンプリング周期は最短周期にこの倍率を掛けた値です。最短周期では、ネットワークが遅いとデータが失われることがあります。";
    RecorderMonitor: "モニター";
    RecorderMonitorTip: "2は同時に実行される2つ目のRecordStart用です";
    RecorderDataType: "DataType";
    ForceDataAll: "力、トルク、位置、参照位置、速度、関節、過負荷率";
    ForceDataMotion: "位置、速度、関節、過負荷率";
    ForceDataForce: "力、トルク、位置";
    ForceDataPosition: "位置のみ";
    RecorderDataNum: "DataNum";
    RecorderDataNumHint: "0：コントローラーが決定";
    RecorderDataNumText: "1回の読み取りで得られるブロックまたはレコードの最大数です。小さすぎるとデータが失われることがあります。";
    RecorderBlocksRule: "0～200の整数";
    RecorderRecordsRule: "0～65535の整数";
    RecorderPortText: "記録中はPortを設定します。記録が終了するまで、コントローラーは力覚センサーのデータをRC+ではなくOPC UAに送信します。RecordStartの前に記録を開始してください。";
    RecorderFiles: "ファイル";
    RecorderFolder: "フォルダー";
    RecorderFolderTitle: "記録先フォルダー";
    RecorderFolderRule: "フォルダーのパスを入力してください";
    RecorderFormat: "形式";
    RecorderCsvTip: "1行1件のテキスト形式です。書き込み中でも読み取れます";
    RecorderParquetTip: "pandasなどのツール向けの列形式です。サイズが小さく、記録の終了後に読み取れます";
    RecorderKeepPackets: "パケットも保存する";
    RecorderKeepPacketsTip: "受信したままのデータを.packetsファイルに保存します。後で開いたり変換したりできます";
    RecorderEnds: "各記録は次の条件で自動的に終了します";
    RecorderSeconds: "時間 (s)";
    RecorderMegabytes: "パケットのサイズ (MB)";
    RecorderFooters: "力覚センサーの記録回数";
    RecorderNoLimit: "制限なし";
    RecorderLimitRule: "1以上の整数、または空欄";
    RecorderLogin: "本ツールの証明書によるOPC UAサーバーへのログイン";
    RecorderAnonymous: "空欄：匿名";
    RecorderStart: "記録を開始";
    RecorderStop: "記録を停止";
    RecorderStopOne: "停止";
    RecorderStopTip: "この記録を終了し、ファイルを完成させます";
    RecorderShow: "表示";
    RecorderAgain: "新しい記録";
    RecorderRetryTip: "失敗したすべての記録をもう一度開始します";
    RecorderChooseTip: "選択したコントローラーの値を下のグラフに表示します";
    RecorderState: "状態";
    RecorderStateTip: "記録の現在の状態";
    RecorderRowsTip: "ファイルの行数：力覚センサーのレコード、またはモーションログの1ブロックにつき8行";
    RecorderMissingTip: "届かなかったことが分かっているブロックまたはレコード";
    RecorderWarnings: "警告";
    RecorderWarningsTip: "読み取りが間に合わずコントローラーがデータを上書きした回数と、読み取れないパケットの数";
    RecorderSize: "ファイルサイズ";
    RecorderSizeTip: "書き込み済みのCSVまたはParquetファイルのバイト数です。パケットは1秒ごとに確実に保存されます";
    RecorderFinding: "サーバーを確認中";
    RecorderWaiting: "コントローラーの記録開始を待機中";
    RecorderRunning: "記録中";
    RecorderReconnecting: "再接続中";
    RecorderFinishing: "ファイルを仕上げ中";
    RecorderGoesOn: "このダイアログを閉じても記録は続きます。ステータスバーから戻れます。";
    RecorderBackTip: "これらの記録のダイアログを開きます";
    RecorderNoValues: "値はまだ届いていません";
    RecorderNoValuesEnded: "これらの量の値はありません";
    RecorderPlotsFull: "グラフは最大4つです。先に1つ外してください。";
    RecorderWhole: "全体";
    RecorderWholeTip: "全時間を表示します (Homeキーまたはダブルクリック)";
    RecorderPauseTip: "表示中の時間を保持します (Pキー)。記録は続きます";
    RecorderFollowTip: "最新の値の追従を再開します (Pキー)";
    RecorderZoomIn: "拡大";
    RecorderZoomOut: "縮小";
    RecorderPlotKeys: "ドラッグまたは矢印キー：移動。マウスホイール、プラス、マイナス：拡大と縮小。Homeまたはダブルクリック：全体。P：一時停止。";
    RecorderColumnTip: "線を非表示にする、または再び表示します";
    OpenRecording: "記録を開く…";
    OpenRecordingTip: "記録の内容とグラフを表示します";
    OpenRecordingTitle: "記録";
    OpenRecordingText: "レコーダーのCSVファイル、Parquetファイル、または.packetsファイルを開きます。CSVとParquetには同じフォルダーの.jsonファイルが必要です。ファイルをウィンドウにドロップすることもできます。";
    OpenRecordingNow: "開く";
    RecordingFile: "ファイル";
    KindRecording: "力覚センサーまたはモーションログの記録";
    CloseRecordings: "記録が実行中です。記録を終了し、各ファイルを完成させてからウィンドウを閉じます。";
    CloseStopRecordings: "記録を停止して閉じる";
    CloseCompleting: "記録のファイルが完成すると、ウィンドウが閉じます。";
    QuantityForces: "力";
    QuantityTorques: "トルク";
    QuantityPosition: "位置";
    QuantityOrientation: "姿勢";
    QuantityReferencePosition: "参照位置";
    QuantityReferenceOrientation: "参照姿勢";
    QuantityCorrection: "補正量";
    QuantitySpeed: "ツール速度";
    QuantityJoints: "関節";
    QuantityOverload: "過負荷率";
    QuantityProgram: "ステップとシーケンス";
    QuantityEncoderPositions: "エンコーダー位置";
    QuantityEncoderTemperatures: "エンコーダー温度";
    QuantityDirectCurrents: "電流 (d軸)";
    QuantityQuadratureCurrents: "電流 (q軸)";
    QuantityMotorSpeeds: "モーター速度";
    QuantityElectricalAngles: "電気角";
    QuantityInputsOutputs: "I/O";
    QuantitySensorCounts: "力覚センサー";
    QuantityPulseCounters: "パルスカウンター";
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

pub fn recording_end(reason: &str) -> String {
    format!("終了：{reason}")
}

pub fn recording_missing(missing: u64, gaps: u64) -> String {
    match (missing, gaps) {
        (_, 0) => "0".to_owned(),
        (0, gaps) => format!("? (ギャップ{gaps}件)"),
        (missing, gaps) => format!("{missing} (ギャップ{gaps}件)"),
    }
}

pub fn recording_gaps(gaps: usize) -> String {
    format!("ギャップ{gaps}件")
}

pub fn recording_gap(row: u64, missing: Option<u64>, cause: &str) -> String {
    match missing {
        Some(missing) => format!("{row}行目：欠落{missing}件、{cause}"),
        None => format!("{row}行目：欠落数不明、{cause}"),
    }
}

pub fn recording_range(from: f64, to: f64) -> String {
    format!("{from:.3} s～{to:.3} s")
}

pub fn recordings_running(count: usize) -> String {
    format!("記録中：{count}件")
}

pub fn recordings_ended(failed: usize) -> String {
    match failed {
        0 => "記録が終了しました".to_owned(),
        failed => format!("記録が終了しました (失敗{failed}件)"),
    }
}
