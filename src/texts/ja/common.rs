//! What dialogs have in common, in Japanese.

fixed_texts! {
    // buttons and words of dialogs
    Ok: "OK";
    Cancel: "キャンセル";
    Close: "閉じる";
    Apply: "適用";
    Add: "追加";
    Delete: "削除";
    Retry: "再試行";
    On: "オン";
    Off: "オフ";
    Show: "表示";
    Hide: "非表示";
    Copy: "コピー";
    Reading: "読み込み中…";
    Processing: "処理中…";
    Cause: "原因";
    Remedy: "対処方法";
    Detail: "詳細情報";
    Controllers: "コントローラー";

    // confirmation
    ConfirmStops: "変更のためにOPC UAサーバーを停止します。動作中だった場合は、変更後に再び開始します。接続中のクライアントは切断されます。";
    ConfirmStop: "OPC UAサーバーを停止します。接続中のクライアントは切断されます。";
    ConfirmReplaces: "コントローラー内の同じタイプの証明書が置き換えられ、サーバーは新しい証明書を使用します。クライアント側で新しい証明書を信頼する必要があります。";
    ConfirmChangesCertificate: "サーバーがクライアントに提示する証明書が変わります。クライアント側でその証明書を信頼する必要があります。";
    ConfirmInvalidatesCaSigned: "ファームウェア8.0.0未満では、現在のCA署名証明書がただちに無効になります。この証明書を使用しているサーバーは停止し、接続中のクライアントは切断され、別の証明書をインポートまたは選択するまでサーバーは停止したままです。ファームウェア8.0.0以降では、新しい証明書をインポートするまで現在の証明書を引き続き使用します。";
    ConfirmReplacesRequest: "コントローラー内のCSRとその鍵が、バックアップの内容に置き換えられます。対応する証明書がバックアップにない場合は、現在のCA署名証明書がただちに無効になり、この証明書を使用しているサーバーは停止します。";
    ConfirmChangesEndpoints: "クライアントは、ここで設定したポート、セキュリティポリシー、ユーザートークンでのみサーバーに接続できます。";
    ConfirmOverwritesExport: "ワークスペースに同名の設定エクスポートファイルがある場合は、上書きされます。";
    ConfirmReplacesSettings: "コントローラー内の設定とユーザーが、ファイルの内容に置き換えられます。ファイルにアクティベーションキーが含まれる場合は、それも置き換えられます。";
    ConfirmDisturbsNobody: "OPC UAサーバーは動作を続けます。クライアントは切断されません。";
    ConfirmDisconnectsClients: "信頼されなくなったクライアントは、ただちに切断されます。OPC UAサーバーは動作を続けます。";
    ConfirmMovesFiles: "このPCにある以前の証明書またはCSRのファイルとその鍵は、その日付を名前に付けたフォルダーに移動して保管します。";
    ConfirmDeletesLog: "コントローラー内のサーバーログを削除します。";

    // processing
    StateWaiting: "待機中";
    StateDone: "完了";
    StateFailed: "失敗";
    StateNotStarted: "未開始";
    StepConnect: "接続中";
    StepRead: "読み込み中";
    StepVerify: "確認中";
    StepMakeKey: "鍵を生成中";
    StepSign: "署名中";
    StepApply: "適用中";
    StepSaveBackup: "ファイルを保存中";
    Completed: "処理完了";
    Stopped: "中止";
    CancelAsk: "現在のステップの完了後に中止しますか？完了した処理は元に戻りません。";
    CancelYes: "中止";
    CancelNo: "続行";
    Stopping: "現在のステップの完了後に中止します…";

    // closing the window while work goes on
    CloseTitle: "ウィンドウを閉じますか？";
    CloseWarning: "コントローラーまたはファイルを変更しています。変更が中断されると、コントローラーで使用できる証明書がなくなる場合があります。";
    CloseOtherWork: "ファイルの書き込みを続けています";
    CloseFinish: "完了後に閉じる";
    CloseStop: "このステップの完了後に中止して閉じる";
    CloseStay: "閉じない";
    CloseFinishing: "すべてのコントローラーの処理が完了すると、ウィンドウが閉じます。失敗したコントローラーがある場合、ウィンドウは閉じず、理由を表示します。";
    CloseStopping: "現在のステップが完了すると、ウィンドウが閉じます。";
}
