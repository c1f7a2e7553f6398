//! What is said of PLCs and bridges, in Japanese.

use crate::fins::codec::cpu::PlcErrorKind;
use crate::fins::codec::end_code::{EndCode, EndCodeRemedy, KnownEndCode};

fixed_texts! {
    FinsModel: "形式";
    FinsVersion: "バージョン";
    FinsMode: "動作モード";
    FinsProgram: "ユーザープログラム";
    FinsProgramRuns: "運転中";
    FinsProgramStands: "停止中";
    FinsClock: "時計";
    FinsFatalErrors: "致命的な異常";
    FinsNonFatalErrors: "非致命的な異常";
    FinsErrorMessage: "異常メッセージ";
    FinsNodes: "ノード (本ツール、PLC)";
    FinsNone: "なし";
    HeadingRow: "行";
    HeadingPlc: "PLC";
    HeadingDirection: "方向";
    HeadingRobot: "ロボット";
    HeadingValues: "値";
    HeadingCopied: "コピー";
    HeadingFailed: "失敗";
    HeadingUnknown: "不明";
    HeadingError: "エラー";
}

texts_of_values! { end_code(KnownEndCode):
    NormalCompletion: "正常終了";
    ServiceCancelled: "サービスがキャンセルされました";
    LocalNodeNotInNetwork: "ローカルノードがネットワークに加入していません";
    TokenTimeout: "トークンタイムアウト";
    RetriesFailed: "再試行がすべて失敗しました";
    TooManySendFrames: "送信フレームが多すぎます";
    NodeAddressRange: "ノードが範囲外です";
    NodeAddressDuplicate: "ノードアドレスが重複しています";
    DestinationNotInNetwork: "宛先ノードがネットワークに加入していません";
    UnitMissing: "宛先ユニットがありません";
    ThirdNodeMissing: "第三ノードがありません";
    DestinationBusy: "宛先ノードがビジーです";
    ResponseTimeout: "応答タイムアウト";
    CommunicationsControllerError: "通信コントローラーの異常";
    CpuUnitError: "CPUユニットの異常";
    ControllerError: "コントローラーの異常";
    UnitNumberError: "ユニット番号が間違っています";
    UndefinedCommand: "コマンドが定義されていません";
    NotSupportedByModel: "形式またはバージョンがコマンドに対応していません";
    DestinationNotInRoutingTable: "宛先がルーティングテーブルにありません";
    NoRoutingTables: "ルーティングテーブルがありません";
    RoutingTableError: "ルーティングテーブルの異常";
    TooManyRelays: "中継が多すぎます";
    CommandTooLong: "コマンドが長すぎます";
    CommandTooShort: "コマンドが短すぎます";
    ElementsAndDataDiffer: "要素数とデータが一致しません";
    CommandFormatError: "コマンドの形式が間違っています";
    HeaderError: "ヘッダーが間違っています";
    AreaMissing: "メモリエリアがありません";
    AccessSizeError: "アクセスサイズが間違っているか、アドレスが奇数です";
    AddressRangeError: "先頭アドレスがエリアの範囲外です";
    AddressRangeExceeded: "末尾アドレスがエリアの範囲外です";
    ProgramMissing: "プログラムがありません";
    RelationalError: "パラメーターが矛盾しています";
    DuplicateDataAccess: "同じデータが同時にアクセスされています";
    ResponseTooLong: "応答が長すぎます";
    ParameterError: "パラメーターが間違っています";
    ReadProtected: "データが読み出し保護されています";
    ReadTableMissing: "テーブルがありません";
    ReadDataMissing: "データがありません";
    ReadProgramMissing: "読み出すプログラムがありません";
    ReadFileMissing: "読み出すファイルがありません";
    DataMismatch: "データが一致しません";
    ReadOnly: "エリアは読み出し専用です";
    WriteProtected: "データが書き込み保護されています";
    CannotRegister: "登録できません";
    WriteProgramMissing: "書き込むプログラムがありません";
    WriteFileMissing: "書き込むファイルがありません";
    FileExists: "ファイルがすでに存在します";
    CannotChange: "変更できません";
    NotDuringExecution: "実行中は操作できません";
    NotWhileRunning: "PLCの運転中は操作できません";
    WrongModeProgram: "PROGRAMモードでは操作できません";
    WrongModeDebug: "DEBUGモードでは操作できません";
    WrongModeMonitor: "MONITORモードでは操作できません";
    WrongModeRun: "RUNモードでは操作できません";
    NotPollingNode: "ノードがポーリングノードではありません";
    StepNotExecutable: "ステップを実行できません";
    FileDeviceMissing: "ファイル装置がありません";
    MemoryMissing: "メモリがありません";
    ClockMissing: "時計がありません";
    StartTableMissing: "開始に必要なテーブルがありません";
    UnitMemoryError: "メモリの異常";
    IoSettingError: "I/O設定の異常";
    TooManyIoPoints: "I/O点数が多すぎます";
    CpuBusError: "CPUバスの異常";
    IoDuplication: "I/Oアドレスが重複しています";
    IoBusError: "I/Oバスの異常";
    SysmacBus2Error: "SYSMAC BUS/2の異常";
    CpuBusUnitError: "CPU高機能ユニットの異常";
    SysmacBusDuplication: "SYSMAC BUSの番号が重複しています";
    MemoryError: "内部メモリまたはメモリカードの異常";
    TerminatorMissing: "SYSMAC BUSの終端がありません";
    NotProtected: "保護されていません";
    WrongPassword: "パスワードが間違っています";
    Protected: "保護されています";
    AlreadyExecuting: "サービスがすでに実行中です";
    ServiceStopped: "サービスが停止しています";
    NoExecutionRight: "実行する権利がありません";
    SettingsIncomplete: "設定が完了していません";
    ItemsNotSet: "必要な項目が設定されていません";
    NumberAlreadyDefined: "番号がすでに定義されています";
    ErrorNotCleared: "異常を解除できません";
    NoAccessRight: "別の機器がアクセス権を持っています";
    ServiceAborted: "サービスが中断されました";
}

texts_of_values! { remedy(EndCodeRemedy):
    None: "問題はありません。";
    Retry: "再試行してください。解消しない場合は、PLCとネットワークの負荷を下げてください。";
    NetworkUnit: "ネットワークユニットの設定を確認してください。";
    Destination: "宛先のPLCのノード、ケーブル、電源を確認してください。";
    PlcError: "PLCまたはユニットに表示されている異常を確認し、原因を取り除いてください。";
    Unsupported: "このPLCはこのコマンドに対応していません。別のコマンドを使用してください。";
    Routing: "宛先までの経路をルーティングテーブルに登録してください。";
    Format: "本ツールとPLCの通信が噛み合っていません。表示された詳細を添えて報告してください。";
    Address: "エリア、アドレス、要素数がPLCの形式に合っているか確認してください。";
    Protection: "保護を解除するか、別のエリアを選択してください。";
    Mode: "PLCの動作モードを変更してください。";
    AccessRight: "別の機器がアクセス権を解放するまで待ってください。";
    Missing: "足りないものをPLCに作成するか、別のものを指定してください。";
}

texts_of_values! { plc_error(PlcErrorKind):
    Watchdog: "ウォッチドッグタイマー";
    Fals: "FALS";
    Fal: "FAL";
    CycleTimeOver: "サイクルタイムオーバー";
    Program: "プログラム";
    IoSetting: "I/O設定";
    TooManyIoPoints: "I/O点数オーバー";
    InnerBoard: "インナーボード";
    Duplication: "番号重複";
    IoBus: "I/Oバス";
    Memory: "メモリ";
    SpecialIoUnitSetting: "高機能I/Oユニットの設定";
    CpuBusUnitSetting: "CPU高機能ユニットの設定";
    Battery: "電池";
    SysmacBus: "SYSMAC BUS";
    SpecialIoUnit: "高機能I/Oユニット";
    CpuBusUnit: "CPU高機能ユニット";
    IoVerification: "I/O照合";
    PlcSetup: "PLCシステム設定";
    BasicIoUnit: "基本I/Oユニット";
    InterruptTask: "割り込みタスク";
}

pub fn plc_advice(end: EndCode) -> String {
    let code = format!("{:04X}", end.code);
    let relay = if end.is_relay_error { " (ネットワークでの中継中に発生)" } else { "" };
    match end.known() {
        Some(known) => format!("終了コード{code}：{}{relay}。{}", end_code(known), remedy(known.remedy())),
        None => format!("終了コード{code}はマニュアルの表にありません{relay}。"),
    }
}

pub fn plc_written(range: &str) -> String {
    format!("書き込みました：{range}")
}

pub fn plc_partly_written(done: usize, uncertain: usize) -> String {
    match uncertain {
        0 => format!("それまでにPLCが確認した要素：{done}個"),
        _ => format!("それまでにPLCが確認した要素：{done}個。続く{uncertain}個は不明です"),
    }
}

pub fn plc_simulated(address: &str, node: u8) -> String {
    format!("シミュレーションPLC (ノード{node}) が{address}で応答します。Ctrl-Cで終了します")
}

pub fn plc_watched(what: &str) -> String {
    format!("{what}を監視しています。Ctrl-Cで終了します")
}

pub fn bridge_started(rows: usize) -> String {
    format!("ブリッジが{rows}行をコピーしています。Ctrl-Cで終了します")
}

pub fn bridge_row_copied(row: &str) -> String {
    format!("{row}：コピーしました")
}

pub fn bridge_ended(cycles: u64, complete: u64, longest_ms: u128) -> String {
    format!("サイクル：{cycles}回、うち完全なもの：{complete}回、最長{longest_ms} ms")
}
