//! The list of controllers, in Chinese.

fixed_texts! {
    // add a controller
    AddController: "添加控制器…";
    AddControllerTip: "以名称、地址和连接密码注册控制器";
    AddControllerTitle: "添加控制器";
    Password: "连接密码";
    PasswordHint: "未设置时留空";
    AddressHint: "192.168.0.1 或 主机：端口";
    NameRule: "1 至 32 个字符";
    NameTaken: "名称已被使用";
    AddressTaken: "地址已被使用";
    AddressRule: "请输入 IP 地址或主机名，可带端口";
    FingerprintTitle: "这是您的控制器吗？";
    FingerprintText: "请与控制器上显示的指纹核对。此后每次连接都会检查该指纹，以防有人冒充控制器。确认后才会发送密码。";
    FingerprintLabel: "指纹 (SHA-256)";
    FingerprintLater: "请与控制器上显示的指纹核对。此后每次连接都会检查该指纹，以防有人冒充控制器。然后输入密码。";
    FingerprintConfirm: "一致，继续";
    LookingForController: "正在读取控制器的指纹…";
    Skip: "跳过";
    FingerprintMatches: "一致，添加";
    AddUnconfirmed: "添加但暂不确认控制器";
    AddUnconfirmedTip: "用于未开机的控制器。核对指纹之前不会向其发送任何数据；届时再输入密码。";

    // confirm identity
    ConfirmIdentity: "确认控制器…";
    ConfirmIdentityTip: "在向已勾选的控制器发送数据之前核对其指纹";
    WhyConfirmed: "已勾选的控制器均已确认";

    // delete
    DeleteControllers: "删除…";
    DeleteControllersTip: "从列表中删除已勾选的控制器";
    DeleteTitle: "从列表中删除";
    DeleteText: "将从列表中删除以下控制器及其连接密码。控制器本身不受影响，已保存的文件保留。";
    DeleteVaultClosed: "密码库未打开：请先打开，否则其中的密码将保留。";

    // connection list
    ConnectionList: "获取连接列表…";
    ConnectionListTip: "从连接列表注册控制器";
    ConnectionListTitle: "获取连接列表";
    ConnectionListText: "包含 Name、Type、Address 列的 CSV 文件。USB 连接和虚拟控制器不会导入。";
    Import: "导入";
    NothingToImport: "文件中没有新的控制器";
    TickConnection: "请至少勾选一台要导入的控制器";
    SeriesGuess: "列表中没有此信息，获取信息后以控制器为准。";
    LinesLeftOut: "不导入";
    ImportText: "核对指纹之前不会向这些控制器发送数据。";

    // connection password
    EnterPassword: "输入密码…";
    PasswordTitle: "需要连接密码";
    PasswordText: "请输入以下控制器中设置的以太网连接密码";
    PasswordUse: "用于以下控制器";
    PasswordNotKept: "该密码仅在本窗口关闭前有效。没有密钥环时可用密码库保存，请见[选项]。";
}
