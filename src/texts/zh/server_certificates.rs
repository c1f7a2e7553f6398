//! The certificates of the OPC UA server, in Chinese.

fixed_texts! {
    // self-signed
    SelfSigned: "自签名…";
    SelfSignedTip: "创建并安装自签名服务器证书";
    ActSelfSigned: "创建证书";
    SelfSignedTitle: "自签名证书";
    CommonName: "通用名";
    CommonNameEach: "按控制器自动生成";
    CommonNameRule: "1 至 64 个半角字符";
    Country: "国家";
    CountryNone: "(无)";
    CountrySearch: "搜索国家";
    State: "州或省名称";
    Locality: "地区名称";
    Organisation: "机构";
    HalfWidthRule: "仅限半角可打印字符";
    LengthRule: "过长";
    KeyLength: "密钥长度";
    KeyLengthOne: "仅列出所有已勾选安全策略都允许的长度";
    KeyLengthMany: "安全策略不允许该长度的控制器将拒绝";
    Validity: "有效期(年)";
    Optional: "可选";

    // export self-signed, CA signed, user specified
    ExportSelfSigned: "导出自签名证书…";
    ExportSelfSignedTip: "将自签名服务器证书保存到文件";
    CaSigned: "CA 签名…";
    CaSignedTip: "创建证书签名请求并导入已签名的证书";
    UserSpecified: "用户指定…";
    UserSpecifiedTip: "安装在别处创建的服务器证书";
    ActCreateCsr: "创建 CSR";
    WhyUserOne: "仅可用于一台控制器，请只勾选一台";
    WhyUserLegacy: "仅适用于 8.0.0 之前的固件";
    ExportSelfSignedTitle: "导出自签名证书";
    Export: "导出";
    FileFormat: "文件格式";
    GoesTo: "保存位置";
    SavedIn: "已保存到";
    ImportedFrom: "导入自";
    MovedAside: "原有文件已移动到";
    CaSignedTitle: "CA 签名证书";
    CsrTitle: "证书签名请求 (CSR)";
    CsrCard: "1. 创建 CSR";
    CsrText: "创建新密钥及其签名请求。请将该文件夹中的文件发送给 CA。";
    CreateCsr: "创建 CSR…";
    CreateAndSave: "创建与保存";
    ImportCard: "2. 导入证书";
    ImportFromFolder: "请将 CA 颁发的证书保存到该文件夹：仅一个 .der 文件，文件名使用半角字母、数字和下划线。";
    ImportTextMany: "请将 CA 颁发的证书保存到每台控制器的文件夹：仅一个 .der 文件，文件名使用半角字母、数字和下划线。";
    CertificateFile: "证书文件";
    KeyFile: "私钥文件";
    PfxFile: "文件";
    FolderFileHint: "留空则使用文件夹中的文件";
    Folder: "文件夹";
    ImportAsk: "导入…";
    Checking: "正在检查…";
    UserSpecifiedTitle: "用户指定证书";
    UserKind: "类型";
    UserKindPfx: "带加密密钥的证书 (.pfx)";
    UserKindPair: "证书/私钥 (.der、.key)";
    UserFilePassword: "文件密码";
    UserKeyPassword: "私钥密码";
    UserKeyPasswordHint: "未加密时留空";
    UserFilesRule: "请同时指定两个文件，或都留空以使用文件夹中的文件";
    UserPathRule: "请指定文件，或先获取新信息";
    ImportAnyway: "仍然导入";
    NoneToImport: "没有可以导入的证书";
    ImportRefused: "不导入";
    FindingNone: "未发现客户端可能提示的问题";
    Warning: "警告";
    IssuerNotHere: "文件及其所在文件夹中均没有上一级颁发者的证书；客户端需要该证书才能信任控制器";
    SerialFolder: "控制器序列号";

    // backups of keys
    RestoreBackup: "恢复备份…";
    RestoreBackupTip: "从备份将密钥及其证书恢复到控制器";
    RestoreTitle: "恢复备份";
    RestoreText: "将保存在本机的密钥以原有类型恢复到控制器。";
    RestoreKind: "备份内容";
    RestoreSelfSigned: "自签名证书及其密钥 (1_key.pfx)";
    RestoreCaSigned: "CSR、其密钥以及 CA 证书 (3_key.pfx)";
    RestoreFile: "密钥文件";
    RestoreFileHint: "留空则使用文件夹中的文件";
    RestoreFormer: "以前的备份位于以日期命名的文件夹中。";
    RestorePasswordHint: "留空则使用连接密码";
    RestoreButton: "恢复…";
    RestoreRequestOnly: "CSR 和密钥，不含 CA 证书，请随后导入证书";

    // type select
    TypeSelect: "类型选择…";
    TypeSelectTip: "选择要使用的服务器证书";
    ActSelectType: "切换证书";
    TypeSelectTitle: "类型选择";
    TypeSelectText: "服务器向客户端出示所选类型的证书";
    TypeSelectRule: "请选择证书类型";
    TypeSelectLegacy: "用户指定证书仅适用于 8.0.0 之前的固件";
    TypeInUse: "使用中";
    TypeNotStored: "控制器中未保存";
}
