//! The OPC UA server and its settings, in Japanese.

fixed_texts! {
    // information, start and stop
    Start: "開始";
    StartTip: "チェックを付けたコントローラーのOPC UAサーバーを開始します";
    Stop: "停止";
    StopTip: "チェックを付けたコントローラーのOPC UAサーバーを停止します";
    GetInfo: "最新情報の取得";
    GetInfoTip: "チェックを付けたコントローラーのステータス、証明書、アクティベーションの情報を読み込みます";

    // basic settings
    BasicSettings: "基本設定…";
    BasicSettingsTip: "ポート、起動モード、セキュリティポリシー、ユーザートークンポリシー、サーバーログを設定します";
    ActSettings: "設定を変更";
    SettingsTitle: "基本設定";
    SettingsMany: "チェックを付けたすべてのコントローラーに、同じ設定を適用します。各項目には、既定値が表示されます。";
    Port: "ポート";
    PortRule: "1024～65535のポート番号を入力してください";
    PortUsed: "このポートは、コントローラーの別の機能で使用されています";
    StartupMode: "サーバー起動モード";
    StartupAutoTip: "コントローラーの電源を入れたときに、サーバーを開始します";
    StartupManualTip: "[開始]を押したときに、サーバーを開始します";
    SecurityPolicy: "セキュリティポリシー";
    NotEncrypted: "暗号化なし";
    Deprecated: "非推奨";
    PolicyRule: "セキュリティポリシーを1つ以上選択してください";
    TokenPolicy: "ユーザートークンポリシー";
    TokenAnonymous: "匿名";
    TokenUserName: "ユーザー名とパスワード";
    TokenRule: "ユーザートークンポリシーを1つ以上選択してください";
    NoUsersWarning: "コントローラーにユーザーが登録されていないため、ログインできません";
    ServerLog: "サーバーログ";
    LogPassword: "ログ用パスワード";
    LogPasswordTip: "199532を入力すると、ログがオンになります (マニュアル2.6.1)";
    LogWarning: "サーバーは、ログがサイズの上限に達すると自動的に停止します";
    DeleteLog: "ログを削除";

    // users
    Users: "ユーザー…";
    UsersTip: "OPC UAサーバーのユーザーを表示、追加、削除します";
    UsersTitle: "ユーザー";
    UsersNone: "ユーザーが登録されていません";
    UserName: "ユーザー名";
    UserPassword: "パスワード";
    UserRule: "半角英数字8～32文字";
    AddUser: "ユーザーの追加…";
    AddUserTitle: "ユーザーの追加";
    AddUserMany: "チェックを付けたすべてのコントローラーに、このユーザーを追加します";
    DeleteUsers: "ユーザーの削除";
    UserExists: "同じ名前のユーザーが登録されています";
    UsersFull: "コントローラー1台に登録できるユーザーは10人までです";
    TickUser: "先に削除するユーザーにチェックを付けてください";

    // activation
    Activation: "アクティベーション…";
    ActivationTip: "ライセンスキーとアクティベーションキーを入力します";
    ActActivate: "アクティベーション";
    WhyActivationOption: "ファームウェア8.0.0以降は、コントローラーオプションとしてアクティベーションします";
    ActivationTitle: "アクティベーション";
    ActivationMany: "複数のコントローラーのキーは、アクティベーションファイルから読み込みます。1行にコントローラー1台分のシリアル番号、ライセンスキー、アクティベーションキーを記載したCSVファイルです。";
    LicenceKey: "ライセンスキー";
    ActivationKey: "アクティベーションキー";
    KeysRule: "2つのキーを最後まで入力してください";
    KeyComplete: "入力完了";
    NoKeysInFile: "ファイルに、これらのコントローラーのキーがありません";
    KeysMissing: "ファイルに記載なし";
    KeysUnknown: "シリアル番号は未取得です。接続時にキーを検索します。";
    LinesWithMistakes: "使用できない行";
    LinesUnused: "チェックを付けていないコントローラーの行";

    // server log
    ServerLogCommand: "サーバーログ…";
    ServerLogTip: "OPC UAサーバーのログを表示、保存、削除します";
    WhyOne: "1台だけにチェックを付けてください";
    LogFilter: "行を絞り込み";
    LogEmpty: "ログは空です。ログは[基本設定]でオンにできます。";
    LogNothingFound: "一致する行はありません";
    Save: "保存";
    SaveLog: "保存…";
    SaveLogTitle: "サーバーログの保存";
    SaveLogText: "コントローラーからログ全体を読み込み、テキストファイルに保存します。同名のファイルは置き換えられます。";
    Refresh: "更新";
    DeleteLogButton: "削除…";

    // export and import of settings
    ExportSettings: "エクスポート…";
    ExportSettingsTip: "サーバー設定をファイルに保存します";
    ImportSettings: "インポート…";
    ImportSettingsTip: "サーバー設定をファイルから読み込みます";
    ActImportSettings: "設定を置き換え";
    WhyLegacyOnly: "ファームウェア8.0.0未満でのみ使用できます。ファームウェア8.0.0以降のコントローラーのチェックを外してください。";
    ExportTitle: "設定のエクスポート";
    ImportTitle: "設定のインポート";
    ExportButton: "エクスポート";
    ImportButton: "インポート";
    ExportText: "基本設定、ユーザー、アクティベーションキーを、暗号化したファイルとしてこのPCに保存します。サーバーは動作を続けます。";
    ImportSettingsText: "同じコントローラーからエクスポートしたファイルを使用して、基本設定、ユーザー、アクティベーションキーを復元します。一部だけが復元されることはありません。";
    File: "ファイル";
    FilePerSerial: "コントローラーごとに1つのファイルが、シリアル番号を名前に付けたフォルダーに保存されます";
    ExportedAt: "エクスポート日時";
    Passphrase: "パスフレーズ";
    PassphraseRule: "8文字以上、または空欄";
    ExportPassphraseTip: "空欄の場合は、各コントローラーの接続パスワードでファイルを保護します。接続パスワードが未設定のコントローラーには、パスフレーズが必要です。";
    ImportPassphraseTip: "エクスポート時に使用したパスフレーズを入力します。空欄の場合は、コントローラーの接続パスワードを使用します。";
    ImportNothing: "インポートできるファイルがありません";
}
