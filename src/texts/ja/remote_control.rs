//! The window for remote control, in Japanese.

use std::path::Path;

fixed_texts! {
    RemoteControl: "リモート制御…";
    RemoteControlTip: "1台のコントローラーの状態、プログラム、モーター、I/O、変数をリモートコマンドで表示、操作します";
    RemoteControlTitle: "リモート制御";
    RemoteTabControl: "操作";
    RemoteTabIo: "I/O";
    RemoteTabVariables: "変数";
    RemoteTabExecute: "実行";
    RemoteTabAlarms: "アラーム";
    RemoteTabLog: "ログ";

    // connection
    RemoteTarget: "接続先";
    RemoteTargetForms: "リモートEthernet：tcp://192.168.0.1:5000。シリアルポート：serial:COM3?baud=19200またはserial:/dev/ttyS0。シリアルデバイスサーバー：raw-tcp://192.168.0.7:4001。";
    RemoteTargetRule: "下の例の形式で接続先を入力してください";
    RemotePasswordRule: "リモートコマンドのパスワードは、印字可能な文字で16文字以内です";
    RemoteOneClient: "コントローラーが同時に対応するリモートコマンドのクライアントは1つです。接続直後は監視のみです。";
    RemoteNotConnected: "未接続";
    RemoteLiveTip: "状態を毎秒2回読み取ります";
    RemoteOld: "以下は、接続が切れる前に読み取った内容です";
    RemoteChangeConnection: "別の接続先に接続します";
    RemoteDisconnect: "切断";

    // the switch
    RemoteMonitoring: "監視のみ";
    RemoteMonitoringText: "動作や変更を伴うコマンドは送信しません。";
    RemoteAllow: "コマンドを許可…";
    RemoteAllowed: "コマンドを許可しています";
    RemoteAllowedText: "ロボット、モーター、出力、プログラムはすぐに反応します。";
    RemoteForbid: "監視のみ";
    RemoteAllowTitle: "コマンドの許可";
    RemoteAllowRobots: "開始、継続、ホーム、実行により、ロボットがすぐに動作する可能性があります。モーターをオフにすると、アームが下がる可能性があります。";
    RemoteAllowOutputs: "出力はすぐに切り替わり、グリッパー、バルブ、コンベヤーなども動作します。";
    RemoteAllowProgram: "プログラムが開始、停止します。ここで設定した変数やメモリーI/Oにもプログラムが反応します。";
    RemoteAllowSafety: "装置の動作範囲に人がいないこと、非常停止をすぐに操作できることを確認してください。";
    RemoteAllowEnds: "コマンドを許可するのはこのダイアログのみで、ダイアログを閉じるか接続が終わると無効になります。";
    RemoteAllowNow: "許可";
    RemoteWhyNotConnected: "コントローラーに接続していません";
    RemoteWhyMonitoring: "監視のみです。先にコマンドを許可してください。";

    // lamps
    RemoteFlagTest: "コントローラーはTESTモードです";
    RemoteFlagTeach: "コントローラーはTEACHモードです";
    RemoteFlagAuto: "動作を伴うリモートコマンドを受け付けます";
    RemoteFlagWarning: "警告があります。タスクは継続します";
    RemoteFlagSError: "システムエラーです。コントローラーの再起動が必要です";
    RemoteFlagSafeguard: "安全扉が開いています";
    RemoteFlagEStop: "非常停止中です";
    RemoteFlagError: "エラーがあります。リセットで解除できます";
    RemoteFlagPaused: "タスクが一時停止中です";
    RemoteFlagRunning: "タスクを実行中です";
    RemoteFlagReady: "コントローラーは起動済みで、実行中のタスクはありません";

    // control
    RemoteProgram: "プログラム";
    RemoteFunction: "関数";
    RemoteStart: "開始";
    RemoteStop: "停止";
    RemotePause: "一時停止";
    RemoteContinue: "継続";
    RemoteReset: "リセット";
    RemoteAbort: "中断";
    RemoteRobots: "ロボット";
    RemoteAllRobots: "すべてのロボット";
    RemoteRobotTip: "右のボタンの対象ロボット";
    RemoteOneRobot: "ロボットを1台選択してください";
    RemoteMotorsOn: "モーターオン";
    RemoteMotorsOff: "モーターオフ";
    RemoteHome: "ホーム";
    RemoteSelectRobot: "選択";
    RemoteCurrentRobot: "実行の対象ロボット";

    // I/O
    RemoteInputs: "入力";
    RemoteOutputs: "出力";
    RemoteMemory: "メモリーI/O";
    RemoteBits: "ビット";
    RemoteBytes: "バイト";
    RemoteWords: "ワード";
    RemoteFirstWord: "先頭ワード";
    RemoteOutputsNote: "リモートコマンドでは、出力の設定はできますが読み取りはできません。このダイアログで設定した状態のみを表示します。";
    RemoteNumber: "番号";
    RemoteHexadecimal: "16進数";
    RemoteDecimal: "10進数";
    RemoteBinary: "2進数";
    RemoteSet: "設定";
    RemoteSetOn: "オンにする";
    RemoteSetOff: "オフにする";
    RemoteHexByteRule: "00～FFの16進数を入力してください";
    RemoteHexWordRule: "0000～FFFFの16進数を入力してください";
    RemoteLabels: "ラベル";
    RemoteLabelsHint: "CSVファイル";
    RemoteLabelsTip: "各行に、input、output、memoryのいずれか、ビット番号、ラベルを記載します。ダイアログを開くと、ワークスペースのコントローラーのフォルダーにあるio-labels.csvを読み取ります。";
    RemoteReadLabels: "ラベルを読み取る";

    // variables
    RemoteVariablesNote: "Global Preserveで宣言した変数を読み取り、設定できます。各変数は毎周期読み取ります。";
    RemoteVariableName: "変数名";
    RemoteType: "型";
    RemoteIndices: "添字";
    RemoteCount: "要素数";
    RemoteVariableNameRule: "変数名は英数字とアンダースコアで、先頭に数字は使えません";
    RemoteIndicesRule: "1～3個の添字をカンマで区切って入力してください (例：3,0)。配列でない変数は空にしてください";
    RemoteCountRule: "一度に読み取れるのは1～100要素です";
    RemoteNoStringArrays: "String型の配列は読み取れません";
    RemoteVariableKnown: "この変数はすでに表にあります";
    RemoteVariablesFull: "表がいっぱいです。先に変数を削除してください。";
    RemoteArrayReadOnly: "配列の要素は読み取りのみです";
    RemoteValueRule: "この型の値ではありません";

    // Execute
    RemoteSpel: "SPEL+コマンド";
    RemoteSpelTip: "Enterで送信し、上下の矢印キーで以前のコマンドを呼び出します";
    RemoteSpelRule: "1～256バイトのコマンドを入力してください";
    RemoteExecute: "実行";
    RemoteExecuteNote: "コマンドは選択中のロボットに作用します。応答はコマンドの終了後に届きます。「中断」で途中で終了できます。";
    RemoteAgain: "入力欄に再度入れます";

    // alarms
    RemoteAlarmsNote: "バッテリーなどの消耗部品のアラームです。部品を交換したら、アラームをリセットしてください。";
    RemoteResetAlarm: "アラームをリセット";

    // log
    RemoteLogText: "テキスト";
    RemoteLogPolling: "ポーリングも表示";
    RemoteLogPollingTip: "状態を毎秒2回読み取るコマンドも表示します";
    RemoteLogEmpty: "メッセージはまだありません";
    RemoteLogClear: "消去";
    RemoteSaveTitle: "通信ログの保存";
    RemoteSaveText: "表示中のメッセージを、16進数とともにテキストで保存します。同名のファイルは置き換えます。";
}

pub fn remote_waiting(command: &str) -> String {
    format!("{command}の応答を待っています")
}

pub fn remote_error(code: u16, message: Option<&str>) -> String {
    match message {
        Some(message) => format!("{code:04}：{message}"),
        None => format!("エラーまたは警告{code:04}。内容はコントローラーのエラーコード表を参照してください"),
    }
}

pub fn remote_robot(number: u8) -> String {
    format!("ロボット{number}")
}

pub fn remote_bit(number: u16, label: Option<&str>, is_on: Option<bool>) -> String {
    let label = label.map(|label| format!(" {label}")).unwrap_or_default();
    let state = match is_on {
        Some(true) => "オン",
        Some(false) => "オフ",
        None => "不明",
    };
    format!("ビット{number}{label}：{state}")
}

pub fn remote_io_unread(why: &str) -> String {
    format!("一部を読み取れませんでした：{why}")
}

pub fn remote_labels(count: usize, skipped: usize) -> String {
    match skipped {
        0 => format!("ラベル{count}個"),
        _ => format!("ラベル{count}個、ラベルのない行{skipped}行"),
    }
}

pub fn remote_log_size(shown: usize, all: usize, dropped: u64) -> String {
    match dropped {
        0 => format!("メッセージ{all}件中{shown}件を表示"),
        _ => format!("メッセージ{all}件中{shown}件を表示、古い{dropped}件は削除済み"),
    }
}

pub fn text_saved(path: &Path) -> String {
    format!("{}に保存しました", path.display())
}
