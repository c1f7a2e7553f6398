//! The certificates of the OPC UA server, in Japanese.

fixed_texts! {
    // self-signed
    SelfSigned: "自己署名…";
    SelfSignedTip: "自己署名のサーバー証明書を作成してインストールします";
    ActSelfSigned: "証明書を作成";
    SelfSignedTitle: "自己署名証明書";
    CommonName: "コモンネーム";
    CommonNameEach: "コントローラーごとに自動生成";
    CommonNameRule: "半角1～64文字";
    Country: "国";
    CountryNone: "(なし)";
    CountrySearch: "国を検索";
    State: "都道府県・州";
    Locality: "市区町村";
    Organisation: "組織";
    HalfWidthRule: "使用できるのは半角の印字可能文字のみです";
    LengthRule: "長すぎます";
    KeyLength: "鍵長";
    KeyLengthOne: "有効なすべてのセキュリティポリシーで使用できる鍵長だけを表示しています";
    KeyLengthMany: "セキュリティポリシーがこの鍵長を許可しないコントローラーでは、拒否されます";
    Validity: "有効期間 (年)";
    Optional: "省略可";

    // export self-signed, CA signed, user specified
    ExportSelfSigned: "自己署名証明書のエクスポート…";
    ExportSelfSignedTip: "自己署名のサーバー証明書をファイルに保存します";
    CaSigned: "CA署名…";
    CaSignedTip: "証明書署名要求を作成し、署名された証明書をインポートします";
    UserSpecified: "ユーザー指定…";
    UserSpecifiedTip: "別の手段で作成したサーバー証明書をインストールします";
    ActCreateCsr: "CSRを作成";
    WhyUserOne: "一度に処理できるのは1台です。1台だけにチェックを付けてください。";
    WhyUserLegacy: "ファームウェア8.0.0未満でのみ使用できます";
    ExportSelfSignedTitle: "自己署名証明書のエクスポート";
    Export: "エクスポート";
    FileFormat: "ファイル形式";
    GoesTo: "保存先";
    SavedIn: "保存先";
    ImportedFrom: "インポート元";
    MovedAside: "以前のファイルの移動先";
    CaSignedTitle: "CA署名証明書";
    CsrTitle: "証明書署名要求 (CSR)";
    CsrCard: "1. CSRの作成";
    CsrText: "新しい鍵とその証明書署名要求を作成します。このフォルダーのファイルを認証局に送付してください。";
    CreateCsr: "CSRの作成…";
    CreateAndSave: "作成と保存";
    ImportCard: "2. 証明書のインポート";
    ImportFromFolder: "認証局から受け取った証明書を、このフォルダーに入れてください。.derファイルを1つだけ入れ、ファイル名には半角英数字とアンダースコアを使用してください。";
    ImportTextMany: "認証局から受け取った証明書を、コントローラーごとのフォルダーに入れてください。.derファイルを1つだけ入れ、ファイル名には半角英数字とアンダースコアを使用してください。";
    CertificateFile: "証明書ファイル";
    KeyFile: "鍵ファイル";
    PfxFile: "ファイル";
    FolderFileHint: "空欄の場合はフォルダー内のファイルを使用";
    Folder: "フォルダー";
    ImportAsk: "インポート…";
    Checking: "確認中…";
    UserSpecifiedTitle: "ユーザー指定証明書";
    UserKind: "種類";
    UserKindPfx: "証明書と暗号化された鍵 (.pfx)";
    UserKindPair: "証明書と鍵 (.der、.key)";
    UserFilePassword: "ファイルのパスワード";
    UserKeyPassword: "鍵のパスワード";
    UserKeyPasswordHint: "暗号化されていない場合は空欄";
    UserFilesRule: "両方のファイルを指定するか、フォルダー内のファイルを使用する場合は両方とも空欄にしてください";
    UserPathRule: "ファイルを指定するか、先に最新情報を取得してください";
    ImportAnyway: "このままインポート";
    NoneToImport: "インポートできる証明書がありません";
    ImportRefused: "インポート不可";
    FindingNone: "クライアントで問題となる点は見つかりませんでした";
    Warning: "警告";
    IssuerNotHere: "上位の発行者の証明書が、このファイルにも同じフォルダーのファイルにもありません。クライアントがコントローラーを信頼するには、この証明書が必要です。";
    SerialFolder: "シリアル番号";

    // backups of keys
    RestoreBackup: "バックアップの復元…";
    RestoreBackupTip: "鍵とその証明書をバックアップからコントローラーに復元します";
    RestoreTitle: "バックアップの復元";
    RestoreText: "このPCに保管した鍵を、元の証明書タイプでコントローラーに復元します。";
    RestoreKind: "バックアップの内容";
    RestoreSelfSigned: "自己署名証明書とその鍵 (1_key.pfx)";
    RestoreCaSigned: "CSR、その鍵、認証局が発行した証明書 (3_key.pfx)";
    RestoreFile: "鍵ファイル";
    RestoreFileHint: "空欄の場合はフォルダー内のファイルを使用";
    RestoreFormer: "以前のバックアップは、その日付を名前に付けたフォルダーにあります。";
    RestorePasswordHint: "空欄の場合は接続パスワードを使用";
    RestoreButton: "復元…";
    RestoreRequestOnly: "CSRと鍵のみで、認証局が発行した証明書は含まれません。復元後に証明書をインポートしてください。";

    // type select
    TypeSelect: "タイプの選択…";
    TypeSelectTip: "インストール済みのサーバー証明書から、使用する証明書を選択します";
    ActSelectType: "証明書を切り替え";
    TypeSelectTitle: "証明書タイプの選択";
    TypeSelectText: "サーバーは、選択した証明書をクライアントに提示します";
    TypeSelectRule: "証明書タイプを選択してください";
    TypeSelectLegacy: "ユーザー指定証明書は、ファームウェア8.0.0未満でのみ使用できます";
    TypeInUse: "使用中";
    TypeNotStored: "コントローラーに保存されていません";
}
