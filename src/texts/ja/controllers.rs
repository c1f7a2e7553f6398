//! The list of controllers, in Japanese.

fixed_texts! {
    // add a controller
    AddController: "コントローラーの追加…";
    AddControllerTip: "名前、アドレス、接続パスワードを指定してコントローラーを登録します";
    AddControllerTitle: "コントローラーの追加";
    Password: "接続パスワード";
    PasswordHint: "未設定の場合は空欄";
    AddressHint: "192.168.0.1またはホスト名:ポート";
    NameRule: "1～32文字";
    NameTaken: "この名前は別のコントローラーで使用されています";
    AddressTaken: "このアドレスは別のコントローラーで使用されています";
    AddressRule: "IPアドレスまたはホスト名を入力してください (ポートは省略できます)";
    FingerprintTitle: "目的のコントローラーであることの確認";
    FingerprintText: "コントローラーに表示されるフィンガープリントと照合してください。以後の接続では毎回このフィンガープリントを確認し、コントローラーへのなりすましを防ぎます。パスワードは、一致を確認した後に送信されます。";
    FingerprintLabel: "フィンガープリント (SHA-256)";
    FingerprintLater: "コントローラーに表示されるフィンガープリントと照合してください。以後の接続では毎回このフィンガープリントを確認し、コントローラーへのなりすましを防ぎます。照合後、接続パスワードを入力してください。";
    FingerprintConfirm: "一致を確認して続行";
    LookingForController: "コントローラーのフィンガープリントを読み込んでいます…";
    Skip: "スキップ";
    FingerprintMatches: "一致を確認して追加";
    AddUnconfirmed: "フィンガープリントを確認せずに追加";
    AddUnconfirmedTip: "電源が入っていないコントローラーを登録する場合に使用します。フィンガープリントを照合するまで、データは送信されません。接続パスワードは照合時に入力します。";

    // confirm identity
    ConfirmIdentity: "コントローラーの確認…";
    ConfirmIdentityTip: "チェックを付けたコントローラーにデータを送信する前に、フィンガープリントを照合します";
    WhyConfirmed: "チェックを付けたコントローラーはすべて確認済みです";

    // delete
    DeleteControllers: "削除…";
    DeleteControllersTip: "チェックを付けたコントローラーをリストから削除します";
    DeleteTitle: "リストから削除";
    DeleteText: "コントローラーとその接続パスワードをリストから削除します。コントローラー本体の設定は変更されません。保存済みのファイルも残ります。";
    DeleteVaultClosed: "パスワード保管庫が開いていません。先に開かないと、接続パスワードは保管庫に残ります。";

    // connection list
    ConnectionList: "接続リストの取得…";
    ConnectionListTip: "接続リストからコントローラーを登録します";
    ConnectionListTitle: "接続リストの取得";
    ConnectionListText: "Name、Type、Addressの列を持つCSVファイルです。USB接続のコントローラーと仮想コントローラーは対象外です。";
    Import: "インポート";
    NothingToImport: "ファイルに新しいコントローラーがありません";
    TickConnection: "インポートするコントローラーに、1台以上チェックを付けてください";
    SeriesGuess: "接続リストにはこの情報がありません。情報を取得すると、コントローラーの値に置き換わります。";
    LinesLeftOut: "インポート対象外";
    ImportText: "フィンガープリントを照合するまで、これらのコントローラーにデータは送信されません。";

    // connection password
    EnterPassword: "パスワードの入力…";
    PasswordTitle: "接続パスワードの入力";
    PasswordText: "以下のコントローラーに設定されている、イーサネット接続用のパスワードを入力してください";
    PasswordUse: "これらのコントローラーに使用";
    PasswordNotKept: "パスワードは、このウィンドウを閉じるまで保持されます。キーリングがない場合は、[オプション]でパスワード保管庫を作成すると保存できます。";
}
