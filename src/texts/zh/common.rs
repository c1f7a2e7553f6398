//! What dialogs have in common, in Chinese.

fixed_texts! {
    // buttons and words of dialogs
    Ok: "确定";
    Cancel: "取消";
    Close: "关闭";
    Apply: "应用";
    Add: "添加";
    Delete: "删除";
    Retry: "重试";
    On: "开";
    Off: "关";
    Show: "显示";
    Hide: "隐藏";
    Copy: "复制";
    Reading: "正在读取…";
    Processing: "处理中...";
    Cause: "原因";
    Remedy: "解决方法";
    Detail: "详细信息";
    Controllers: "控制器";

    // confirmation
    ConfirmStops: "更改期间将停止 OPC UA 服务器，若之前正在运行，完成后会重新启动。已连接的客户端将断开。";
    ConfirmStop: "将停止 OPC UA 服务器。已连接的客户端将断开。";
    ConfirmReplaces: "将覆盖控制器中该类型的证书，服务器将使用新证书。客户端需要信任新证书。";
    ConfirmChangesCertificate: "服务器将向客户端出示另一个证书。客户端需要信任该证书。";
    ConfirmInvalidatesCaSigned: "固件 8.0.0 之前的控制器：当前的 CA 签名证书立即失效，正在使用该证书的服务器将停止，已连接的客户端将断开，在导入或选择其他证书之前服务器保持停止。固件 8.0.0 及以上版本在导入新证书之前仍使用原证书。";
    ConfirmReplacesRequest: "控制器中的 CSR 及其密钥将被备份替换。若备份中没有对应的证书，当前的 CA 签名证书立即失效，正在使用该证书的服务器将停止。";
    ConfirmChangesEndpoints: "客户端只能使用此处设置的端口、安全策略和用户令牌策略连接服务器。";
    ConfirmOverwritesExport: "工作区中的同名设置导出文件将被覆盖。";
    ConfirmReplacesSettings: "控制器中的设置和用户将被文件中的内容替换；若文件含激活密钥，也将一并替换。";
    ConfirmDisturbsNobody: "OPC UA 服务器继续运行，不会断开任何客户端。";
    ConfirmDisconnectsClients: "不再受信任的客户端将立即断开连接。OPC UA 服务器继续运行。";
    ConfirmMovesFiles: "本机上原有证书或 CSR 的文件及其密钥将保留，并移动到以其日期命名的文件夹。";
    ConfirmDeletesLog: "将删除控制器中的服务器日志。";

    // processing
    StateWaiting: "等待中";
    StateDone: "完成";
    StateFailed: "失败";
    StateNotStarted: "未开始";
    StepConnect: "正在连接";
    StepRead: "正在读取";
    StepVerify: "正在验证";
    StepMakeKey: "正在生成密钥";
    StepSign: "正在签发";
    StepApply: "正在应用";
    StepSaveBackup: "正在保存文件";
    Completed: "处理完成";
    Stopped: "已中止";
    CancelAsk: "是否在当前步骤完成后中止？已完成的处理将保留。";
    CancelYes: "中止";
    CancelNo: "继续";
    Stopping: "当前步骤完成后中止…";

    // closing the window while work goes on
    CloseTitle: "是否关闭窗口？";
    CloseWarning: "正在更改控制器或文件。更改被中断可能导致控制器没有可用的证书。";
    CloseOtherWork: "仍在写入文件";
    CloseFinish: "完成后关闭";
    CloseStop: "当前步骤完成后中止并关闭";
    CloseStay: "不关闭";
    CloseFinishing: "所有控制器处理完成后窗口将关闭。如有控制器失败，窗口将保持打开并显示原因。";
    CloseStopping: "当前步骤结束后窗口将关闭。";
}
