//! The main window, in Japanese.

fixed_texts! {
    // the program
    AppName: "OPC UAコンフィギュレーター";

    // menus
    MenuController: "コントローラー";
    MenuCertificate: "証明書";
    MenuServer: "サーバー設定";
    MenuOptions: "オプション";
    MenuTools: "ツール";
    MenuHelp: "ヘルプ";
    MenuCreate: "作成と保存";
    MenuClients: "クライアント証明書";

    // why a command is disabled
    WhyTick: "先に1台以上のコントローラーにチェックを付けてください";
    WhyEmpty: "リストが空です";
    WhyVirtual: "このビルドでは使用できません";

    // commands of the window itself
    TickAll: "すべてにチェック";
    TickAllTip: "表示中のすべてのコントローラーにチェックを付けます";
    Search: "検索";
    SearchTip: "名前、アドレス、番号、タイプで検索";
    CommandPalette: "コマンドを検索…";
    CommandPaletteTip: "名前の一部からコマンドを検索します";
    RowDetails: "詳細";
    RowDetailsTip: "カーソル位置のコントローラーの詳細を表示または非表示にします";
    Quit: "終了";
    QuitTip: "ウィンドウを閉じます";

    // command palette
    PaletteHint: "コマンド名の一部";
    PaletteNone: "この名前のコマンドはありません";

    // table
    ColumnName: "名前";
    ColumnType: "タイプ";
    ColumnAddress: "IPアドレス";
    ColumnSerial: "シリアル番号";
    ColumnStatus: "ステータス";
    ColumnExpiry: "有効期限";
    ColumnCertificate: "証明書タイプ";
    ColumnActivation: "ライセンス";
    ColumnRetrieved: "取得日時";
    NotConfirmed: "未確認";
    NotConfirmedTip: "フィンガープリントを照合するまで、データは送信されません。[最新情報の取得]を選択してください。";
    StatusRun: "動作中";
    StatusStop: "停止中";
    StatusError: "エラー";
    Expired: "期限切れ";
    ExpiresSoon: "期限間近";
    TypeSelfSigned: "自己署名";
    TypeUserSpecified: "ユーザー指定";
    TypeCaSigned: "CA署名";
    Yes: "あり";
    No: "なし";
    NotRead: "未取得";
    NothingFound: "検索に一致するコントローラーはありません";
    ClearSearch: "検索をクリア";
    Confirmed: "確認済み";
    SortedTip: "クリックすると並べ替えます。もう一度クリックすると順序が逆になります。";
    DragColumnTip: "ドラッグすると列を移動できます";

    // details of a row
    DetailsChoose: "コントローラーを選択してください：行をクリックするか、方向キーを使います";
    DetailsServer: "OPC UAサーバー";
    DetailsFirmware: "ファームウェア";
    DetailsLastResult: "前回の結果";
    DetailsNoResult: "ウィンドウを開いてからジョブは実行されていません";
    DetailsLists: "設定とリスト";
    DetailsRead: "設定とリストを読み取る";
    DetailsNotRead: "ウィンドウを開いてから読み取っていません";
    DetailsNoCertificate: "証明書なし";
    DetailsNone: "なし";
    DetailsApplicationUri: "アプリケーションURI";

    // welcome
    WelcomeTitle: "コントローラーが登録されていません";
    WelcomeText: "OPC UAサーバーを設定するコントローラーを追加してください";
    WelcomeAdd: "コントローラーの追加";
    WelcomeVirtualText: "ロボットが手元にない場合は、実機と同じように動作する仮想コントローラーをこのPCで使用できます";
    StartingVirtual: "仮想コントローラーを起動しています…";
    TryVirtual: "仮想コントローラーで試す";
    TryVirtualTip: "仮想コントローラーをこのPCで数台起動し、リストに追加します";

    // backup
    Backup: "バックアップ…";
    BackupTip: "証明書のコピーをワークスペースに保管します";
    BackupTitle: "バックアップ";
    BackupOn: "作成した証明書のコピーを保管";
    BackupWhere: "コピーは、シリアル番号を名前に付けたコントローラーごとのフォルダーに保存されます";
    BackupKeys: "鍵が保管されるのは、ファームウェア8.0.0未満の場合のみです。鍵は接続パスワードで保護されるため、接続パスワードの設定が必要です。ファームウェア8.0.0以降では、鍵はコントローラー内で生成され、外部に出ることはありません。";
    BackupRestore: "バックアップは、[証明書] › [バックアップの復元]で復元します。";

    // options
    Options: "オプション…";
    OptionsTip: "言語、テーマ、同時に処理するコントローラーの台数を設定します";
    OptionsTitle: "オプション";
    LanguageLabel: "言語";
    ThemeLabel: "テーマ";
    ThemeSystem: "システム設定に従う";
    ThemeLight: "ライト";
    ThemeDark: "ダーク";
    Parallelism: "同時処理台数";
    ParallelismTip: "1回の操作で同時に処理するコントローラーの台数 (1～64)";

    // help
    Shortcuts: "キーボードショートカット";
    ShortcutsTip: "このウィンドウで使用できるすべてのキーを表示します";
    Licences: "ライセンス…";
    LicencesTip: "本ツールに含まれるすべてのコンポーネントのライセンスを表示します";
    About: "バージョン情報";
    AboutTip: "バージョンとライセンスを表示します";
    AboutText: "ロボットコントローラーに内蔵されたOPC UAサーバーの設定、ユーザー、証明書を管理します";
    AboutLicence: "ライセンス：MITまたはApache 2.0。すべてのコンポーネントのライセンスは、[ライセンス]で確認できます。";
    LicencesTitle: "ライセンス";
    LicencesFilter: "名前またはライセンスで絞り込み";
    LicencesNone: "一致する項目はありません";
    WorkspaceLabel: "ワークスペース";
    KeyMove: "リスト内を移動";
    KeyTick: "行のチェックを切り替え";
    KeyRange: "行の範囲にチェックを付ける";
    KeyConfirm: "ダイアログを確定";
    KeyCancel: "ダイアログをキャンセル";
    KeyArrows: "上、下";
    KeySpace: "Space";
    KeyShiftClick: "Shift+クリック";
    KeyEnter: "Enter";
    KeyEscape: "Esc";
    KeyDetails: "行の詳細を表示";
    KeyRowMenu: "行のメニュー";
    KeyMenu: "メニューキーまたはShift+F10";
    KeyEnterRow: "Enterまたはダブルクリック";
}
