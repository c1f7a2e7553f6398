//! Live values, in Japanese.

fixed_texts! {
    LiveValues: "ライブ値…";
    LiveValuesTip: "1台のOPC UAサーバーのロボット、安全状態、I/O、すべてのノードをリアルタイムで表示します";
    LiveTitle: "ライブ値";
    LiveRobot: "ロボット";
    LiveSafety: "安全状態とタスク";
    LiveIo: "I/O";
    LiveVariables: "変数";
    LiveConsumables: "消耗部品";
    LiveStatus: "ステータス";
    LiveNodes: "すべてのノード";
    LivePlot: "グラフ";
    LiveSectionKeys: "Ctrl+Page UpとCtrl+Page Downでタブを切り替えます";
    LiveConnecting: "接続中";
    LiveLiveTip: "サーバーは変化を1秒以内に通知します";
    LiveOld: "以下は、接続が切れる前の最後の値です";
    LiveAnonymous: "匿名";
    LiveLogin: "ログイン…";
    LiveLoginText: "ユーザー名を入力しない場合は、匿名でログインします。パスワードは暗号化した場合にのみ送信し、一度拒否されたら再送信しません。";
    LiveConnect: "接続";
    LiveEmpty: "サーバーにこの種類のノードはありません。ノードの有無は、コントローラーのファームウェアとオプションによって異なります。";
    LiveCut: "サーバーのノードが多いため、ほかのタブには一部のみ表示しています。「すべてのノード」では全ノードを表示できます。";
    LiveOn: "ON";
    LiveOff: "OFF";
    LiveMotors: "モーター";
    LivePower: "パワー";
    LivePowerHigh: "ハイ";
    LivePowerLow: "ロー";
    LiveHome: "ホーム位置";
    LiveAtHome: "到達";
    LiveNotAtHome: "未到達または未設定";
    LiveSpeedOverride: "速度係数";
    LiveMotorOnTime: "励磁時間";
    LiveMotorOnCount: "励磁回数";
    LiveNumber: "ロボット番号";
    LiveKind: "種類";
    LiveSixAxis: "6軸";
    LiveScara: "スカラ";
    LiveOtherKind: "その他";
    LivePose: "ツール中心点";
    LiveTarget: "目標";
    LiveActual: "実際";
    LiveAxis: "軸";
    LivePosition: "位置";
    LiveRange: "範囲";
    LiveSpeed: "速度";
    LiveAcceleration: "加速度";
    LiveTorque: "トルク";
    LiveLoad: "負荷率";
    LiveMotorTemperature: "モーター温度";
    LiveHofs: "Hofs";
    LiveController: "コントローラー";
    LiveSafetyState: "安全状態";
    LiveOperationalMode: "運転モード";
    LiveManualReduced: "手動、低速";
    LiveManualHigh: "手動、高速";
    LiveAutomatic: "自動";
    LiveAutomaticExternal: "自動、外部";
    LiveOtherMode: "その他";
    LiveEmergencyStop: "非常停止";
    LiveProtectiveStop: "保護停止";
    LiveStopped: "作動中";
    LiveNotStopped: "解除";
    LiveTasks: "タスク";
    LiveTask: "タスク";
    LiveTaskName: "機能";
    LiveProgram: "プログラム";
    LiveExecuting: "実行";
    LiveExecutes: "実行中";
    LiveDoesNotExecute: "停止";
    LiveMode: "モード";
    LiveCycle: "サイクル";
    LiveContinuous: "連続";
    LiveStep: "ステップ";
    LiveVariable: "変数";
    LiveValue: "値";
    LiveProject: "SPELプロジェクト";
    LiveNoVariables: "プロジェクトに、名前がOPCUA_で始まるGlobal Preserve変数がありません。変数を追加したら、プロジェクトをビルドしてサーバーを再起動してください。";
    LivePart: "部品";
    LiveOwner: "所属";
    LiveMonthsLeft: "残り月数";
    LiveConsumed: "消耗率";
    LiveInstalled: "交換日";
    LiveNotManaged: "管理対象外";
    LiveStatusCode: "ステータスコード";
    LiveCpuLoad: "CPU負荷率";
    LiveForce: "力覚センサー";
    LiveMotionLog: "モーションログ";
    LiveQueue: "キュー";
    LiveRecording: "取得";
    LiveDataExists: "データ";
    LiveQueueError: "エラー";
    LiveDataNote: "取得データはここでは読み出しません。読み出すとキューから取り出され、記録中のクライアントがそのデータを取得できなくなるためです。";
    LiveChoose: "ノードを選択すると、属性を表示します";
    LiveQuality: "品質";
    LiveSourceTime: "ソース時刻";
    LiveServerTime: "サーバー時刻";
    LiveAddToPlot: "グラフに追加";
    LiveRemoveFromPlot: "グラフから削除";
    LiveNotNumeric: "グラフに表示できるのは数値のみです";
    LivePlotFull: "グラフがいっぱいです。先に値を1つ削除してください。";
    LivePlotEmpty: "グラフに表示する値がありません。数値を「グラフ」タブにドラッグするか、右クリックメニューの「グラフに追加」を選択してください。";
    LivePlotPause: "一時停止";
    LivePlotResume: "追従";
    LivePlotClear: "すべて削除";
    LivePlotRemove: "削除";
    LiveDropHere: "ここにドロップするとグラフに追加します";
    LiveWrite: "値の書き込み…";
    LiveWriteTitle: "値の書き込み";
    LiveWriteText: "値はすぐにコントローラーに書き込まれ、ほかのクライアントにも反映されます。";
    LiveWriteNow: "書き込む";
    LiveNewValue: "新しい値";
    LiveOldValue: "現在の値";
    LiveWriting: "書き込み中";
    LiveWritten: "値を書き込みました";
    LiveNotWritable: "このノードの値は読み取り専用です";
    LiveNotWritableNow: "接続が切れている間は書き込めません";
}

pub fn live_bit(number: u32, is_on: Option<bool>) -> String {
    match is_on {
        Some(true) => format!("ビット{number}：ON"),
        Some(false) => format!("ビット{number}：OFF"),
        None => format!("ビット{number}：値なし"),
    }
}

pub fn live_duration(days: u64, hours: u64, minutes: u64, seconds: u64) -> String {
    match (days, hours) {
        (0, 0) => format!("{minutes}分{seconds}秒"),
        (0, _) => format!("{hours}時間{minutes}分"),
        (_, _) => format!("{days}日{hours}時間"),
    }
}

pub fn live_not_of_type(data_type: &str) -> String {
    format!("{data_type}型の値ではありません")
}

pub fn live_write_refused(status: &str) -> String {
    match status {
        "BadOutOfRange" => "コントローラーが値を拒否しました：許容範囲外です".to_owned(),
        "BadTypeMismatch" => "コントローラーが値を拒否しました：型が違います".to_owned(),
        "BadNotWritable" | "BadUserAccessDenied" => "このユーザーには、ノードへの書き込み権限がありません".to_owned(),
        _ => format!("コントローラーが値を拒否しました：{status}"),
    }
}

pub fn live_span(seconds: u32) -> String {
    match seconds {
        0..60 => format!("{seconds}秒"),
        60..3600 => format!("{}分", seconds / 60),
        _ => format!("{}時間", seconds / 3600),
    }
}

pub fn live_logged_in(user: &str) -> String {
    format!("ユーザー{user}")
}
