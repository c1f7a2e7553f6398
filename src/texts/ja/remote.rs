//! What is said of remote commands, in Japanese.

fixed_texts! {
    RemoteActStart: "プログラムの関数を開始します。ロボットが動作する可能性があります";
    RemoteActStop: "すべてのタスクとコマンドを停止します";
    RemoteActPause: "すべてのタスクを一時停止します";
    RemoteActContinue: "一時停止中のタスクを再開します。ロボットが動作する可能性があります";
    RemoteActReset: "非常停止とエラーをリセットし、出力をオフにします";
    RemoteActMotorsOn: "モーターをオンにします";
    RemoteActMotorsOff: "モーターをオフにします。アームが下がる可能性があります";
    RemoteActRobot: "実行するコマンドの対象ロボットを切り替えます";
    RemoteActHome: "ロボットをホームポジションに移動します";
    RemoteActOutputs: "出力を切り替えます。接続された装置が動作する可能性があります";
    RemoteActMemory: "メモリーI/Oを変更します。プログラムの動作に影響する可能性があります";
    RemoteActVariable: "変数を変更します。プログラムの動作に影響する可能性があります";
    RemoteActExecute: "コマンドを実行します。選択中のロボットが動作する可能性があります";
    RemoteActAbort: "実行中のコマンドを中断します";
    RemoteActAlarm: "消耗部品のアラームをリセットします";
    RemoteNeedsAuto: "動作モードがAUTOではないか、リモートがコントロールデバイスに設定されていません。AUTOに切り替え、コントロールデバイスを設定してください。";
    RemoteNeedsReady: "実行中または一時停止中のタスクがあります。タスクを停止するか、終わるまで待ってください。";
    RemoteNeedsRunning: "一時停止できる実行中のタスクがありません。";
    RemoteNeedsPaused: "再開できる一時停止中のタスクがありません。";
    RemoteNeedsNoError: "エラーが発生しています。原因を取り除いてから、リセットしてください。";
    RemoteNeedsNoEStop: "非常停止中です。非常停止を解除してから、リセットしてください。";
    RemoteNeedsNoSafeguard: "安全扉が開いています。閉じてください。";
    RemoteNoAlarm: "アラームなし";
    RemoteNoResult: "実行しました (結果なし)";
    RemoteNothingTold: "このファームウェアはモニタリングコマンドに応答しません";
    RemoteAskPassword: "リモートコマンドのパスワード";
    RemoteName: "名前";
    RemoteSerial: "シリアル番号";
    RemoteModel: "型式";
    RemoteFirmware: "ファームウェア";
    RemoteControlDevice: "コントロールデバイス";
    RemoteSubnetMask: "サブネットマスク";
    RemoteGateway: "ゲートウェイ";
    RemoteMac: "MACアドレス";
    RemoteProject: "プロジェクト";
    RemoteCpuLoad: "CPU負荷 (%)";
    RemoteBattery: "バッテリー";
    RemoteRobot: "ロボット";
    RemoteMotors: "モーター";
    RemotePower: "パワー";
    RemoteHigh: "ハイ";
    RemoteLow: "ロー";
    RemotePartsDue: "交換が必要な部品";
    RemotePartBattery: "バッテリー";
    RemotePartBelt: "ベルト";
    RemotePartGrease: "グリス";
    RemotePartMotor: "モーター";
    RemotePartGear: "減速機";
    RemotePartBallScrew: "ボールねじ";
}

pub fn remote_status(flags: &[&str], code: u16) -> String {
    let flags = if flags.is_empty() { "オンの状態なし".to_owned() } else { flags.join("、") };
    if code == 0 { flags } else { format!("{flags}、エラーまたは警告{code:04}") }
}

pub fn remote_logged_in(target: &str) -> String {
    format!("{target}：ログインに成功しました")
}

pub fn remote_alarms(numbers: &str) -> String {
    format!("アラーム：{numbers}")
}

pub fn remote_done(command: &str) -> String {
    format!("{command}：実行しました")
}

pub fn remote_watch_goes_on(problem: &str) -> String {
    format!("{problem}。再試行します")
}

pub fn remote_bad_argument(argument: &str, value: &str, possible: &str) -> String {
    format!("{argument}：「{value}」は指定できません。指定できる値：{possible}")
}
