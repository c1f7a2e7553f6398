//! The OPC UA server and its settings, in Chinese.

fixed_texts! {
    // information, start and stop
    Start: "开始";
    StartTip: "启动已勾选控制器的 OPC UA 服务器";
    Stop: "停止";
    StopTip: "停止已勾选控制器的 OPC UA 服务器";
    GetInfo: "获取新信息";
    GetInfoTip: "读取已勾选控制器的状态、证书和激活信息";

    // basic settings
    BasicSettings: "基本设置…";
    BasicSettingsTip: "端口、启动模式、安全策略、用户令牌策略和服务器日志";
    ActSettings: "更改设置";
    SettingsTitle: "基本设置";
    SettingsMany: "相同的设置将应用到所有已勾选的控制器。各项从默认值开始。";
    Port: "端口";
    PortRule: "请输入 1024 至 65535 的端口号";
    PortUsed: "控制器的其他功能正在使用此端口";
    StartupMode: "服务器启动模式";
    StartupAutoTip: "打开控制器时启动服务器";
    StartupManualTip: "按下[开始]时启动服务器";
    SecurityPolicy: "安全策略";
    NotEncrypted: "未加密";
    Deprecated: "已弃用";
    PolicyRule: "请至少勾选一种安全策略";
    TokenPolicy: "用户令牌策略";
    TokenAnonymous: "匿名";
    TokenUserName: "用户名和密码";
    TokenRule: "请至少勾选一种用户令牌策略";
    NoUsersWarning: "控制器尚无用户，将无法登录";
    ServerLog: "服务器日志";
    LogPassword: "日志密码";
    LogPasswordTip: "输入 199532 打开日志（手册 2.6.1）";
    LogWarning: "日志达到上限时服务器会自行停止";
    DeleteLog: "删除日志";

    // users
    Users: "用户…";
    UsersTip: "查看、添加和删除 OPC UA 服务器的用户";
    UsersTitle: "用户";
    UsersNone: "尚无用户";
    UserName: "用户名";
    UserPassword: "密码";
    UserRule: "8 至 32 个半角字母或数字";
    AddUser: "添加用户…";
    AddUserTitle: "添加用户";
    AddUserMany: "该用户将添加到所有已勾选的控制器";
    DeleteUsers: "删除用户";
    UserExists: "用户名已存在";
    UsersFull: "每台控制器最多可注册 10 个用户";
    TickUser: "请先勾选要删除的用户";

    // activation
    Activation: "激活…";
    ActivationTip: "输入许可密钥和激活密钥";
    ActActivate: "激活";
    WhyActivationOption: "固件 8.0.0 及以上版本通过控制器选项激活";
    ActivationTitle: "激活";
    ActivationMany: "多台控制器的密钥来自激活文件：CSV 文件，每台控制器一行，包含序列号、许可密钥和激活密钥";
    LicenceKey: "许可密钥";
    ActivationKey: "激活密钥";
    KeysRule: "请完整输入两个密钥";
    KeyComplete: "已完整";
    NoKeysInFile: "文件中没有这些控制器的密钥";
    KeysMissing: "文件中没有";
    KeysUnknown: "尚未获取序列号，连接后查找";
    LinesWithMistakes: "无法使用的行";
    LinesUnused: "未勾选控制器的行";

    // server log
    ServerLogCommand: "服务器日志…";
    ServerLogTip: "查看、保存和删除 OPC UA 服务器日志";
    WhyOne: "请只勾选一台控制器";
    LogFilter: "筛选行";
    LogEmpty: "日志为空。可在[基本设置]中打开日志。";
    LogNothingFound: "没有匹配的行";
    Save: "保存";
    SaveLog: "保存…";
    SaveLogTitle: "保存服务器日志";
    SaveLogText: "从控制器读取完整日志并保存为文本文件。同名文件将被替换。";
    Refresh: "刷新";
    DeleteLogButton: "删除…";

    // export and import of settings
    ExportSettings: "导出…";
    ExportSettingsTip: "将服务器设置保存到文件";
    ImportSettings: "导入…";
    ImportSettingsTip: "从文件读取服务器设置";
    ActImportSettings: "替换设置";
    WhyLegacyOnly: "仅适用于固件 8.0.0 之前的控制器，请取消勾选新版固件的控制器";
    ExportTitle: "导出设置";
    ImportTitle: "导入设置";
    ExportButton: "导出";
    ImportButton: "导入";
    ExportText: "将基本设置、用户和激活密钥加密保存到本机文件。服务器不会停止。";
    ImportSettingsText: "从同一控制器导出的文件恢复基本设置、用户和激活密钥。全部恢复，否则不做任何更改。";
    File: "文件";
    FilePerSerial: "每台控制器一个文件，位于以其序列号命名的文件夹中";
    ExportedAt: "导出日期";
    Passphrase: "口令";
    PassphraseRule: "至少 8 个字符，或留空";
    ExportPassphraseTip: "留空时以各控制器的连接密码保护文件。未设置连接密码的控制器必须输入口令。";
    ImportPassphraseTip: "导出时使用的口令。留空时使用控制器的连接密码。";
    ImportNothing: "没有可导入的文件";
}
