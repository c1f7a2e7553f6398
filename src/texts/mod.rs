//! Every text of the window, in English and Chinese. The Chinese terms are those of the controller's manual.
//!
//! English is in sentence case, without a full stop after a single sentence, with `…` on whatever asks for more. A text
//! that lacks a language does not compile. Texts of errors come from [`ErrorCode::explain`](crate::model::ErrorCode).

mod authority;
mod files;
mod sentences;
mod trust;
mod vault;
mod verify;

pub use authority::*;
pub use files::*;
pub use sentences::*;
pub use trust::*;
pub use vault::*;
pub use verify::*;

use crate::model::Language;

macro_rules! texts {
    ($($key:ident: $en:literal, $zh:literal;)*) => {
        /// A fixed text.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum TextKey { $($key),* }

        impl TextKey {
            pub const ALL: &[Self] = &[$(Self::$key),*];

            pub const fn text(self, language: Language) -> &'static str {
                match language {
                    Language::En => match self { $(Self::$key => $en),* },
                    Language::Zh => match self { $(Self::$key => $zh),* },
                }
            }
        }
    };
}

texts! {
    AppName: "OPC UA Configurator", "OPC UA 配置工具";

    // menus
    MenuController: "Controller", "控制器";
    MenuCertificate: "Certificate", "证书";
    MenuServer: "Server settings", "服务器设置";
    MenuOptions: "Options", "选项";
    MenuTools: "Tools", "工具";
    MenuHelp: "Help", "帮助";
    MenuCreate: "Create and save", "创建与保存";
    MenuClients: "Client certificates", "客户端证书";

    // commands, and what they do
    AddController: "Add controller…", "添加控制器…";
    AddControllerTip: "Register a controller by its name, address and connection password", "以名称、地址和连接密码注册控制器";
    DeleteControllers: "Delete…", "删除…";
    DeleteControllersTip: "Remove the ticked controllers from the list", "从列表中删除已勾选的控制器";
    ConnectionList: "Get connection list…", "获取连接列表…";
    ConnectionListTip: "Register controllers from a connection list", "从连接列表注册控制器";
    ConfirmIdentity: "Confirm identity…", "确认控制器…";
    ConfirmIdentityTip: "Compare the fingerprint of the ticked controllers before anything is sent to them", "在向已勾选的控制器发送数据之前核对其指纹";
    Quit: "Quit", "退出";
    QuitTip: "Close the window", "关闭窗口";
    Start: "Start", "开始";
    StartTip: "Start the OPC UA server of the ticked controllers", "启动已勾选控制器的 OPC UA 服务器";
    Stop: "Stop", "停止";
    StopTip: "Stop the OPC UA server of the ticked controllers", "停止已勾选控制器的 OPC UA 服务器";
    GetInfo: "Get new information", "获取新信息";
    GetInfoTip: "Read status, certificate and activation of the ticked controllers", "读取已勾选控制器的状态、证书和激活信息";
    BasicSettings: "Basic settings…", "基本设置…";
    BasicSettingsTip: "Port, startup mode, security policies, user tokens and server log", "端口、启动模式、安全策略、用户令牌策略和服务器日志";
    Users: "Users…", "用户…";
    UsersTip: "List, add and delete the users of the OPC UA server", "查看、添加和删除 OPC UA 服务器的用户";
    Activation: "Activation…", "激活…";
    ActivationTip: "Enter licence and activation keys", "输入许可密钥和激活密钥";
    ExportSettings: "Export…", "导出…";
    ExportSettingsTip: "Save the server settings to a file", "将服务器设置保存到文件";
    ImportSettings: "Import…", "导入…";
    ImportSettingsTip: "Take the server settings from a file", "从文件读取服务器设置";
    SelfSigned: "Self-signed…", "自签名…";
    SelfSignedTip: "Make a self-signed server certificate and install it", "创建并安装自签名服务器证书";
    UserSpecified: "User specified…", "用户指定…";
    UserSpecifiedTip: "Install a server certificate made elsewhere", "安装在别处创建的服务器证书";
    CaSigned: "CA signed…", "CA 签名…";
    CaSignedTip: "Make a certificate signing request and import the signed certificate", "创建证书签名请求并导入已签名的证书";
    ExportSelfSigned: "Export self-signed…", "导出自签名证书…";
    ExportSelfSignedTip: "Save the self-signed server certificate to a file", "将自签名服务器证书保存到文件";
    TypeSelect: "Type select…", "类型选择…";
    TypeSelectTip: "Choose which of the installed server certificates is used", "选择要使用的服务器证书";
    RestoreBackup: "Restore backup…", "恢复备份…";
    RestoreBackupTip: "Put a key and its certificate back into the controllers from a backup", "从备份将密钥及其证书恢复到控制器";
    ClientLists: "Client certificates…", "客户端证书…";
    ClientListsTip: "Trusted, rejected and issuers: which clients may connect", "信任、拒绝、发行人：允许哪些客户端连接";
    Crl: "CRL…", "CRL…";
    CrlTip: "Certificate revocation lists of the authorities that issued client certificates", "签发客户端证书的机构的证书吊销列表";
    Backup: "Backup…", "备份…";
    BackupTip: "Keep copies of certificates in the workspace", "在工作区中保留证书副本";
    Options: "Options…", "选项…";
    OptionsTip: "Language, theme and controllers worked on at once", "语言、主题和同时处理的控制器数量";
    CertificateAuthority: "Certificate authority…", "证书颁发机构…";
    CertificateAuthorityTip: "Sign certificate requests with an authority of your own", "使用自己的颁发机构签发证书请求";
    Verify: "Verify", "验证";
    VerifyTip: "Connect to the OPC UA server as a client would, in every way it offers", "以客户端方式尝试 OPC UA 服务器提供的每种连接";
    Shortcuts: "Keyboard shortcuts", "键盘快捷键";
    ShortcutsTip: "Every key this window knows", "本窗口的全部快捷键";
    Licences: "Licences…", "许可证…";
    LicencesTip: "The licences of everything this program is made of", "本程序所含全部组件的许可证";
    About: "About", "关于";
    AboutTip: "Version and licence", "版本与许可证";
    TickAll: "Tick all", "全选";
    TickAllTip: "Tick every controller shown", "勾选所有显示的控制器";
    Search: "Search", "搜索";
    SearchTip: "Search name, address, serial number and type", "按名称、地址、序列号和类型搜索";
    TryVirtual: "Try it with virtual controllers", "使用虚拟控制器试用";
    TryVirtualTip: "Start a few simulated controllers on this computer and add them to the list", "在本机启动几台模拟控制器并添加到列表";

    // why something is disabled
    WhyTick: "Tick at least one controller first", "请先勾选至少一台控制器";
    WhyActivationOption: "Firmware 8.0.0 and later is activated as a controller option", "固件 8.0.0 及以上版本通过控制器选项激活";
    WhyConfirmed: "Every ticked controller is confirmed already", "已勾选的控制器均已确认";
    WhyUserOne: "For one controller at a time: tick only that one", "仅可用于一台控制器，请只勾选一台";
    WhyUserLegacy: "Only for firmware before 8.0.0", "仅适用于 8.0.0 之前的固件";
    WhyEmpty: "The list is empty", "列表为空";
    WhyVirtual: "Not available in this build", "此版本不可用";

    // table
    ColumnName: "Name", "名称";
    ColumnType: "Controller type", "控制器类型";
    ColumnAddress: "IP address", "IP 地址";
    ColumnSerial: "Serial number", "序列号";
    ColumnStatus: "Status", "状态";
    ColumnExpiry: "Expiry", "有效期";
    ColumnCertificate: "Certificate type", "认证类型";
    ColumnActivation: "Activation", "激活";
    ColumnRetrieved: "Retrieved at", "获取日期";
    NotConfirmed: "Not confirmed", "未确认";
    NotConfirmedTip: "Nothing is sent to it until its fingerprint was compared: choose Get new information", "核对指纹之前不会向其发送数据：请选择[获取新信息]";
    StatusRun: "Run", "运行";
    StatusStop: "Stop", "停止";
    StatusError: "Error", "错误";
    Expired: "expired", "已过期";
    ExpiresSoon: "expires soon", "即将到期";
    TypeSelfSigned: "Self-signed", "自签名";
    TypeUserSpecified: "User specified", "用户指定";
    TypeCaSigned: "CA signed", "CA 签名";
    Yes: "Yes", "是";
    No: "No", "否";
    NotRead: "Not read yet", "尚未获取";
    NothingFound: "No controller matches the search", "没有匹配的控制器";
    ClearSearch: "Clear search", "清除搜索";

    // welcome
    WelcomeTitle: "No controllers yet", "尚无控制器";
    WelcomeText: "Add the controllers whose OPC UA servers you want to set up", "请添加要设置其 OPC UA 服务器的控制器";
    WelcomeAdd: "Add a controller", "添加控制器";
    WelcomeVirtualText: "No robot at hand? Simulated controllers run on this computer and behave like real ones", "手边没有机器人？模拟控制器在本机运行，行为与真实控制器一致";
    StartingVirtual: "Starting virtual controllers…", "正在启动虚拟控制器…";

    // dialogs: buttons and common words
    Ok: "OK", "确定";
    Cancel: "Cancel", "取消";
    Close: "Close", "关闭";
    Apply: "Apply", "应用";
    Add: "Add", "添加";
    Delete: "Delete", "删除";
    Retry: "Try again", "重试";
    On: "On", "开";
    Off: "Off", "关";
    Show: "Show", "显示";
    Hide: "Hide", "隐藏";
    Copy: "Copy", "复制";
    Reading: "Reading…", "正在读取…";
    Processing: "Processing…", "处理中...";
    Cause: "Cause", "原因";
    Remedy: "Remedy", "解决方法";
    Detail: "Technical detail", "详细信息";
    Controllers: "Controllers", "控制器";

    // add controller
    AddControllerTitle: "Add controller", "添加控制器";
    Password: "Connection password", "连接密码";
    PasswordHint: "Empty if none is set", "未设置时留空";
    AddressHint: "192.168.0.1 or host:port", "192.168.0.1 或 主机：端口";
    NameRule: "1 to 32 characters", "1 至 32 个字符";
    NameTaken: "Another controller already has this name", "名称已被使用";
    AddressTaken: "Another controller already has this address", "地址已被使用";
    AddressRule: "Enter an IP address or a host name, with or without a port", "请输入 IP 地址或主机名，可带端口";
    FingerprintTitle: "Is this your controller?", "这是您的控制器吗？";
    FingerprintText: "Compare this fingerprint with the one the controller shows. It is checked at every connection from now on, so nobody can pose as this controller. The password is sent only after you agree.", "请与控制器上显示的指纹核对。此后每次连接都会检查该指纹，以防有人冒充控制器。确认后才会发送密码。";
    FingerprintLabel: "Fingerprint (SHA-256)", "指纹 (SHA-256)";
    FingerprintLater: "Compare this fingerprint with the one the controller shows. It is checked at every connection from now on, so nobody can pose as this controller. Then enter its password.", "请与控制器上显示的指纹核对。此后每次连接都会检查该指纹，以防有人冒充控制器。然后输入密码。";
    FingerprintConfirm: "It matches, go on", "一致，继续";
    LookingForController: "Reading the fingerprint of the controller…", "正在读取控制器的指纹…";
    Skip: "Skip", "跳过";
    FingerprintMatches: "It matches, add", "一致，添加";

    AddUnconfirmed: "Add without confirming its identity", "添加但暂不确认控制器";
    AddUnconfirmedTip: "For a controller that is switched off. Nothing is sent to it until its fingerprint was compared; then its password is asked for.", "用于未开机的控制器。核对指纹之前不会向其发送任何数据；届时再输入密码。";

    // delete
    DeleteTitle: "Delete from the list", "从列表中删除";
    DeleteText: "They are removed from the list with their connection passwords. Nothing is changed in the controllers, and saved files stay.", "将从列表中删除以下控制器及其连接密码。控制器本身不受影响，已保存的文件保留。";

    DeleteVaultClosed: "The vault for passwords is closed: open it first, or their passwords stay in it.", "密码库未打开：请先打开，否则其中的密码将保留。";

    // password
    PasswordTitle: "Connection password needed", "需要连接密码";
    PasswordText: "Enter the password for Ethernet connections that is set in these controllers", "请输入以下控制器中设置的以太网连接密码";
    PasswordUse: "Use for these controllers", "用于以下控制器";

    PasswordNotKept: "The password is known until this window is closed. A vault keeps it without a keyring, see the options.", "该密码仅在本窗口关闭前有效。没有密钥环时可用密码库保存，请见[选项]。";

    // the vault for connection passwords
    PasswordsLabel: "Connection passwords", "连接密码";
    PasswordsKeyring: "Keyring of this computer", "本机密钥环";
    PasswordsVault: "Vault in the workspace", "工作区密码库";
    PasswordsNotKept: "Passwords are not kept", "密码未保存";
    PasswordsNotKeptTip: "A password that was entered is known until this window is closed. Click to do something about it.", "已输入的密码仅在本窗口关闭前有效。单击以处理。";
    VaultOpen: "Open vault…", "打开密码库…";
    VaultClose: "Close vault", "关闭密码库";
    VaultChange: "Change passphrase…", "更改口令…";
    VaultCreateTitle: "Create a vault for passwords", "创建密码库";
    VaultCreateText: "The vault keeps connection passwords in the workspace, sealed under a passphrase. It is asked for once each time the program starts. Nobody can open the vault without it.", "密码库将连接密码以口令加密保存在工作区中。每次启动程序时输入一次口令。没有口令则无法打开密码库。";
    VaultCreateNow: "Create", "创建";
    VaultOpenTitle: "Open the vault for passwords", "打开密码库";
    VaultOpenText: "The connection passwords are in the vault of this workspace. If it is not opened, they are asked for instead.", "连接密码保存在该工作区的密码库中。如不打开，将逐一询问密码。";
    VaultOpenNow: "Open", "打开";
    VaultChangeTitle: "Change the passphrase of the vault", "更改密码库口令";
    VaultChangeText: "Copies of the vault that were made before still open with the old passphrase.", "此前复制的密码库文件仍可用旧口令打开。";
    VaultChangeNow: "Change", "更改";
    VaultNewPassphrase: "New passphrase", "新口令";
    VaultPassphraseNeeded: "Enter the passphrase of the vault", "请输入密码库口令";
    VaultCreated: "The vault was created: connection passwords are kept in it", "已创建密码库，连接密码将保存在其中";
    VaultOpened: "The vault is open", "密码库已打开";
    VaultPassphraseChanged: "The passphrase of the vault was changed", "密码库口令已更改";

    // confirmation
    ConfirmStops: "The OPC UA server is stopped for the change, and started again if it was running. Connected clients are cut off.", "更改期间将停止 OPC UA 服务器，若之前正在运行，完成后会重新启动。已连接的客户端将断开。";
    ConfirmStop: "The OPC UA server is stopped. Connected clients are cut off.", "将停止 OPC UA 服务器。已连接的客户端将断开。";
    ConfirmReplaces: "The certificate of this type in the controller is replaced, and the server uses the new one. Clients have to trust it.", "将覆盖控制器中该类型的证书，服务器将使用新证书。客户端需要信任新证书。";
    ConfirmChangesCertificate: "The server shows another certificate to its clients. Clients have to trust it.", "服务器将向客户端出示另一个证书。客户端需要信任该证书。";
    ConfirmInvalidatesCaSigned: "On firmware before 8.0.0 the present CA-signed certificate becomes invalid at once: a server that uses it stops, connected clients are cut off, and it stays stopped until another certificate is imported or selected. Firmware 8.0.0 and later goes on using it until the new one is imported.", "固件 8.0.0 之前的控制器：当前的 CA 签名证书立即失效，正在使用该证书的服务器将停止，已连接的客户端将断开，在导入或选择其他证书之前服务器保持停止。固件 8.0.0 及以上版本在导入新证书之前仍使用原证书。";
    ConfirmReplacesRequest: "The CSR in the controller and its key are replaced by those of the backup. If the backup holds no certificate for them, the present CA-signed certificate becomes invalid at once, and a server that uses it stops.", "控制器中的 CSR 及其密钥将被备份替换。若备份中没有对应的证书，当前的 CA 签名证书立即失效，正在使用该证书的服务器将停止。";
    ConfirmChangesEndpoints: "Clients reach the server only by the port, security policies and user tokens that are set here.", "客户端只能使用此处设置的端口、安全策略和用户令牌策略连接服务器。";
    ConfirmOverwritesExport: "A settings export of the same name in the workspace is overwritten.", "工作区中的同名设置导出文件将被覆盖。";
    ConfirmReplacesSettings: "Settings and users in the controller are replaced by those of the file, and so are the activation keys if it holds any.", "控制器中的设置和用户将被文件中的内容替换；若文件含激活密钥，也将一并替换。";
    ConfirmDisturbsNobody: "The OPC UA server goes on running. Nobody is disconnected.", "OPC UA 服务器继续运行，不会断开任何客户端。";
    ConfirmDisconnectsClients: "Clients that are not trusted any more are disconnected at once. The OPC UA server goes on running.", "不再受信任的客户端将立即断开连接。OPC UA 服务器继续运行。";
    ConfirmMovesFiles: "Files of a former certificate or CSR on this computer, and their keys, are kept: they are moved into a folder named after their date.", "本机上原有证书或 CSR 的文件及其密钥将保留，并移动到以其日期命名的文件夹。";
    ConfirmDeletesLog: "The server log in the controller is deleted.", "将删除控制器中的服务器日志。";

    // buttons that agree to a confirmation
    ActSettings: "Change settings", "更改设置";
    ActSelfSigned: "Create certificate", "创建证书";
    ActActivate: "Activate", "激活";
    ActSelectType: "Switch certificate", "切换证书";
    ActCreateCsr: "Create CSR", "创建 CSR";
    ActImportSettings: "Replace settings", "替换设置";
    ActSignAndImport: "Sign and import", "签发并导入";
    ActSendCrl: "Send CRL", "发送 CRL";
    ActMoveClients: "Move certificates", "移动证书";

    // processing
    StateWaiting: "Waiting", "等待中";
    StateDone: "Done", "完成";
    StateFailed: "Failed", "失败";
    StateNotStarted: "Not started", "未开始";
    StepConnect: "Connecting", "正在连接";
    StepRead: "Reading", "正在读取";
    StepVerify: "Verifying", "正在验证";
    StepMakeKey: "Making key", "正在生成密钥";
    StepSign: "Signing", "正在签发";
    StepApply: "Applying", "正在应用";
    StepSaveBackup: "Saving files", "正在保存文件";
    Completed: "Completed", "处理完成";
    Stopped: "Stopped", "已中止";
    CancelAsk: "Stop after the step in hand? What is done stays done.", "是否在当前步骤完成后中止？已完成的处理将保留。";
    CancelYes: "Stop", "中止";
    CancelNo: "Go on", "继续";
    Stopping: "Stopping after the step in hand…", "当前步骤完成后中止…";

    // closing the window while work goes on
    CloseTitle: "Close the window?", "是否关闭窗口？";
    CloseWarning: "Controllers or files are being changed. A change that is cut off can leave a controller without a usable certificate.", "正在更改控制器或文件。更改被中断可能导致控制器没有可用的证书。";
    CloseOtherWork: "Files are still being written", "仍在写入文件";
    CloseFinish: "Finish, then close", "完成后关闭";
    CloseStop: "Stop after this step, then close", "当前步骤完成后中止并关闭";
    CloseStay: "Stay open", "不关闭";
    CloseFinishing: "The window closes when all controllers are done. If one fails, the window stays open and shows why.", "所有控制器处理完成后窗口将关闭。如有控制器失败，窗口将保持打开并显示原因。";
    CloseStopping: "The window closes when the step in hand has ended.", "当前步骤结束后窗口将关闭。";
    EnterPassword: "Enter password…", "输入密码…";

    // basic settings
    SettingsTitle: "Basic settings", "基本设置";
    SettingsMany: "The same settings go to all ticked controllers. The fields start from the defaults.", "相同的设置将应用到所有已勾选的控制器。各项从默认值开始。";
    Port: "Port", "端口";
    PortRule: "Enter a port from 1024 to 65535", "请输入 1024 至 65535 的端口号";
    PortUsed: "Another function of the controller uses this port", "控制器的其他功能正在使用此端口";
    StartupMode: "Server startup mode", "服务器启动模式";
    StartupAutoTip: "The server starts when the controller is switched on", "打开控制器时启动服务器";
    StartupManualTip: "The server starts when somebody presses Start", "按下[开始]时启动服务器";
    SecurityPolicy: "Security policy", "安全策略";
    NotEncrypted: "not encrypted", "未加密";
    Deprecated: "deprecated", "已弃用";
    PolicyRule: "Tick at least one security policy", "请至少勾选一种安全策略";
    TokenPolicy: "User token policy", "用户令牌策略";
    TokenAnonymous: "Anonymous", "匿名";
    TokenUserName: "User name and password", "用户名和密码";
    TokenRule: "Tick at least one user token policy", "请至少勾选一种用户令牌策略";
    NoUsersWarning: "The controller has no users yet, so nobody can log in", "控制器尚无用户，将无法登录";
    ServerLog: "Server log", "服务器日志";
    LogPassword: "Password for the log", "日志密码";
    LogPasswordTip: "199532 switches it on (manual 2.6.1)", "输入 199532 打开日志（手册 2.6.1）";
    LogWarning: "The server stops by itself when the log reaches its size limit", "日志达到上限时服务器会自行停止";
    DeleteLog: "Delete log", "删除日志";

    // users
    UsersTitle: "Users", "用户";
    UsersNone: "No users yet", "尚无用户";
    UserName: "User name", "用户名";
    UserPassword: "Password", "密码";
    UserRule: "8 to 32 letters A–Z, a–z and digits", "8 至 32 个半角字母或数字";
    AddUser: "Add user…", "添加用户…";
    AddUserTitle: "Add user", "添加用户";
    AddUserMany: "The user is added to all ticked controllers", "该用户将添加到所有已勾选的控制器";
    DeleteUsers: "Delete users", "删除用户";
    UserExists: "A user of this name already exists", "用户名已存在";
    UsersFull: "A controller takes at most 10 users", "每台控制器最多可注册 10 个用户";
    TickUser: "Tick the users to delete first", "请先勾选要删除的用户";

    // self-signed
    SelfSignedTitle: "Self-signed certificate", "自签名证书";
    CommonName: "Common name", "通用名";
    CommonNameEach: "Made per controller", "按控制器自动生成";
    CommonNameRule: "1 to 64 half-width characters", "1 至 64 个半角字符";
    Country: "Country", "国家";
    CountryNone: "(none)", "(无)";
    CountrySearch: "Search country", "搜索国家";
    State: "State", "州或省名称";
    Locality: "Locality", "地区名称";
    Organisation: "Organisation", "机构";
    HalfWidthRule: "Half-width printable characters only", "仅限半角可打印字符";
    LengthRule: "Too long", "过长";
    KeyLength: "Key length", "密钥长度";
    KeyLengthOne: "Offered are the lengths every ticked security policy allows", "仅列出所有已勾选安全策略都允许的长度";
    KeyLengthMany: "Controllers whose security policies do not allow it refuse this length", "安全策略不允许该长度的控制器将拒绝";
    Validity: "Validity (years)", "有效期(年)";
    Optional: "optional", "可选";

    // connection list
    ConnectionListTitle: "Get connection list", "获取连接列表";
    ConnectionListText: "A CSV file with the columns Name, Type and Address. Controllers on USB and simulated ones are left out.", "包含 Name、Type、Address 列的 CSV 文件。USB 连接和虚拟控制器不会导入。";
    Import: "Import", "导入";
    NothingToImport: "There is no new controller in the file", "文件中没有新的控制器";
    TickConnection: "Tick at least one controller to import", "请至少勾选一台要导入的控制器";
    SeriesGuess: "The list does not say it. What the controller says of itself replaces it.", "列表中没有此信息，获取信息后以控制器为准。";
    LinesLeftOut: "Left out", "不导入";
    ImportText: "Nothing is sent to them until you have compared their fingerprints.", "核对指纹之前不会向这些控制器发送数据。";

    // activation
    ActivationTitle: "Activation", "激活";
    ActivationMany: "Keys for several controllers come from an activation file: a CSV file with a line per controller, its serial number, licence key and activation key", "多台控制器的密钥来自激活文件：CSV 文件，每台控制器一行，包含序列号、许可密钥和激活密钥";
    LicenceKey: "Licence key", "许可密钥";
    ActivationKey: "Activation key", "激活密钥";
    KeysRule: "Enter both keys completely", "请完整输入两个密钥";
    KeyComplete: "Complete", "已完整";
    NoKeysInFile: "The file has keys for none of these controllers", "文件中没有这些控制器的密钥";
    KeysMissing: "Not in the file", "文件中没有";
    KeysUnknown: "Not read yet, looked up when it is reached", "尚未获取序列号，连接后查找";
    LinesWithMistakes: "Lines that cannot be used", "无法使用的行";
    LinesUnused: "Lines of controllers that are not ticked", "未勾选控制器的行";

    // files
    FileLabel: "File", "文件";
    FileHint: "Path of the file", "文件路径";
    FileRule: "Choose a file or type its path", "请选择文件或输入其路径";
    ChooseFile: "Choose…", "选择…";
    ChooseFileTitle: "Choose a file", "选择文件";
    ReadFile: "Read file", "读取文件";
    Browse: "Browse…", "选择…";
    OpenFolder: "Open folder", "打开文件夹";

    // files dropped onto the window
    DropTitle: "Dropped files", "拖放的文件";
    DropChoose: "Use as", "用途";
    DropOpen: "Open", "打开";
    DropUnseen: "Drop them to see what they are", "松开后显示文件类型";
    DropAsks: "Several dialogs take this; you choose after dropping", "有多种用途，松开后选择";
    DropNothing: "Nothing here can be used", "没有可用的文件";
    DropDialogOpen: "A dialog is open: close it first, then drop the files again", "有对话框已打开：请先关闭对话框，然后重新拖放文件";
    DropTooMany: "Too many files: drop at most 100 at once", "文件过多：一次最多拖放 100 个";
    DropOneFile: "One file at a time: drop only that one", "一次仅限一个文件，请只拖放一个";
    WhySplitKey: "The file holds certificate and private key together: save them as two files, or as one .pfx", "文件同时包含证书和私钥：请分别保存为两个文件，或保存为一个 .pfx 文件";
    DropCrl: "Certificate revocation list (CRL)", "证书吊销列表 (CRL)";
    DropAuthority: "Certificate authority", "证书颁发机构";
    KindActivation: "Activation file", "激活文件";
    KindConnectionList: "Connection list", "连接列表";
    KindSettingsExport: "Settings export", "设置导出文件";
    KindCertificate: "Certificate", "证书";
    KindChain: "Several certificates (PEM)", "多个证书 (PEM)";
    KindBundle: "Collection of certificates or CRLs (PKCS#7 or PEM)", "证书或 CRL 集合 (PKCS#7 或 PEM)";
    KindCsr: "Certificate signing request (CSR)", "证书签名请求 (CSR)";
    KindKey: "Private key", "私钥";
    KindKeyAndCertificate: "Certificate and private key in one PEM file", "证书和私钥合一的 PEM 文件";
    KindPkcs12: "Certificate with encrypted key (PKCS#12)", "带加密密钥的证书 (PKCS#12)";

    // certificate files
    ExportSelfSignedTitle: "Export self-signed certificate", "导出自签名证书";
    Export: "Export", "导出";
    FileFormat: "File format", "文件格式";
    GoesTo: "Goes to", "保存位置";
    SavedIn: "Saved in", "已保存到";
    ImportedFrom: "Imported from", "导入自";
    MovedAside: "Former files were moved to", "原有文件已移动到";
    CaSignedTitle: "CA-signed certificate", "CA 签名证书";
    CsrTitle: "Certificate signing request", "证书签名请求 (CSR)";
    CsrCard: "1. Create CSR", "1. 创建 CSR";
    CsrText: "Makes a new key and its signing request. Send the file in this folder to your CA.", "创建新密钥及其签名请求。请将该文件夹中的文件发送给 CA。";
    CreateCsr: "Create CSR…", "创建 CSR…";
    CreateAndSave: "Create and save", "创建与保存";
    ImportCard: "2. Import certificate", "2. 导入证书";
    ImportFromFolder: "Put the certificate from the CA into this folder: exactly one .der file, named with letters, digits and underscores.", "请将 CA 颁发的证书保存到该文件夹：仅一个 .der 文件，文件名使用半角字母、数字和下划线。";
    ImportTextMany: "Put the certificate from the CA into the folder of each controller: exactly one .der file, named with letters, digits and underscores.", "请将 CA 颁发的证书保存到每台控制器的文件夹：仅一个 .der 文件，文件名使用半角字母、数字和下划线。";
    CertificateFile: "Certificate file", "证书文件";
    KeyFile: "Key file", "私钥文件";
    PfxFile: "File", "文件";
    FolderFileHint: "Empty: the one in the folder", "留空则使用文件夹中的文件";
    Folder: "Folder", "文件夹";
    ImportAsk: "Import…", "导入…";
    Checking: "Checking…", "正在检查…";
    UserSpecifiedTitle: "User-specified certificate", "用户指定证书";
    UserKind: "Kind", "类型";
    UserKindPfx: "Certificate with encrypted key (.pfx)", "带加密密钥的证书 (.pfx)";
    UserKindPair: "Certificate and key (.der, .key)", "证书/私钥 (.der、.key)";
    UserFilePassword: "Password of the file", "文件密码";
    UserKeyPassword: "Password of the key", "私钥密码";
    UserKeyPasswordHint: "Empty if it is not encrypted", "未加密时留空";
    UserFilesRule: "Give both files, or neither to use those in the folder", "请同时指定两个文件，或都留空以使用文件夹中的文件";
    UserPathRule: "Give the file, or get new information first", "请指定文件，或先获取新信息";
    ImportAnyway: "Import anyway", "仍然导入";
    NoneToImport: "None of these can be imported", "没有可以导入的证书";
    ImportRefused: "Not imported", "不导入";
    FindingNone: "Nothing found that clients could complain about", "未发现客户端可能提示的问题";
    Warning: "Warning", "警告";
    IssuerNotHere: "The next issuer is neither in the file nor in files beside it; clients need it to trust the controller", "文件及其所在文件夹中均没有上一级颁发者的证书；客户端需要该证书才能信任控制器";
    SerialFolder: "serial number", "控制器序列号";

    // backups of keys
    RestoreTitle: "Restore backup", "恢复备份";
    RestoreText: "A key that was kept on this computer is put back into the controller, under the type it had.", "将保存在本机的密钥以原有类型恢复到控制器。";
    RestoreKind: "Backup of", "备份内容";
    RestoreSelfSigned: "Self-signed certificate and its key (1_key.pfx)", "自签名证书及其密钥 (1_key.pfx)";
    RestoreCaSigned: "CSR, its key and the certificate from the CA (3_key.pfx)", "CSR、其密钥以及 CA 证书 (3_key.pfx)";
    RestoreFile: "Key file", "密钥文件";
    RestoreFileHint: "Empty: the one in the folder", "留空则使用文件夹中的文件";
    RestoreFormer: "Former backups are in folders named after their date.", "以前的备份位于以日期命名的文件夹中。";
    RestorePasswordHint: "Empty: the connection password", "留空则使用连接密码";
    RestoreButton: "Restore…", "恢复…";
    RestoreRequestOnly: "CSR and key, without a certificate from the CA: import the certificate afterwards", "CSR 和密钥，不含 CA 证书，请随后导入证书";

    // type select
    TypeSelectTitle: "Type select", "类型选择";
    TypeSelectText: "The server shows this certificate to its clients", "服务器向客户端出示所选类型的证书";
    TypeSelectRule: "Choose a certificate type", "请选择证书类型";
    TypeSelectLegacy: "User-specified certificates exist on firmware before 8.0.0 only", "用户指定证书仅适用于 8.0.0 之前的固件";
    TypeInUse: "in use", "使用中";
    TypeNotStored: "Not stored in the controller", "控制器中未保存";
    // export and import of settings
    WhyLegacyOnly: "Only for firmware before 8.0.0; untick controllers with later firmware", "仅适用于固件 8.0.0 之前的控制器，请取消勾选新版固件的控制器";
    ExportTitle: "Export settings", "导出设置";
    ImportTitle: "Import settings", "导入设置";
    ExportButton: "Export", "导出";
    ImportButton: "Import", "导入";
    ExportText: "Basic settings, users and activation keys are saved to an encrypted file on this computer. The server goes on running.", "将基本设置、用户和激活密钥加密保存到本机文件。服务器不会停止。";
    ImportSettingsText: "Basic settings, users and activation keys are put back from a file exported from the same controller. Either all of it is taken or nothing.", "从同一控制器导出的文件恢复基本设置、用户和激活密钥。全部恢复，否则不做任何更改。";
    File: "File", "文件";
    FilePerSerial: "One file per controller, in the folder named after its serial number", "每台控制器一个文件，位于以其序列号命名的文件夹中";
    ExportedAt: "Exported at", "导出日期";
    Passphrase: "Passphrase", "口令";
    PassphraseRule: "At least 8 characters, or none", "至少 8 个字符，或留空";
    ExportPassphraseTip: "If empty, each file is protected by the connection password of its controller. A controller without a connection password needs a passphrase.", "留空时以各控制器的连接密码保护文件。未设置连接密码的控制器必须输入口令。";
    ImportPassphraseTip: "The one the file was exported with. If empty, the connection password of the controller opens it.", "导出时使用的口令。留空时使用控制器的连接密码。";
    ImportNothing: "There is no file that can be imported", "没有可导入的文件";

    // server log
    ServerLogCommand: "Server log…", "服务器日志…";
    ServerLogTip: "Read the log of the OPC UA server, save it or delete it", "查看、保存和删除 OPC UA 服务器日志";
    WhyOne: "Tick one controller only", "请只勾选一台控制器";
    LogFilter: "Filter lines", "筛选行";
    LogEmpty: "The log is empty. It is switched on in the basic settings.", "日志为空。可在[基本设置]中打开日志。";
    LogNothingFound: "No line matches the filter", "没有匹配的行";
    Save: "Save", "保存";
    SaveLog: "Save…", "保存…";
    SaveLogTitle: "Save the server log", "保存服务器日志";
    SaveLogText: "The whole log is read from the controller and saved as text. A file of the same name is replaced.", "从控制器读取完整日志并保存为文本文件。同名文件将被替换。";
    Refresh: "Refresh", "刷新";
    DeleteLogButton: "Delete…", "删除…";

    // verify
    VerifyTitle: "Verify", "验证";
    VerifyWorks: "Everything tried works", "所有尝试均正常";
    VerifyFails: "Not everything works", "并非全部正常";
    VerifyEndpoint: "Endpoint", "端点";
    VerdictWorks: "Works", "正常";
    VerdictFails: "Fails", "失败";
    VerdictNotTried: "Not tried", "未尝试";
    VerifyCertificate: "Server certificate", "服务器证书";
    VerifyAccepted: "a careful client accepts it", "客户端可接受";
    VerifyRefused: "a careful client refuses it", "客户端将拒绝";
    VerifyAgain: "Verify again", "重新验证";
    VerifyTrust: "Trust this configurator…", "信任本配置工具…";
    VerifyTrustText: "The server lets in only clients whose certificate is in Trusted. That of this configurator is not there; it can be added now, or later from the file in this folder.", "服务器仅允许证书在[信任]列表中的客户端连接。本配置工具的证书不在其中，可立即添加，或以后使用此文件夹中的文件添加。";
    VerifyLogin: "To try logging in, give a user of the controller. The password is sent encrypted only, and not again once it was refused.", "如需尝试登录，请输入控制器的用户。密码仅以加密方式发送，被拒绝后不会再次发送。";
    TrustConfiguratorTitle: "Trust this configurator", "信任本配置工具";
    ConfirmTrustConfigurator: "The certificate of this configurator is put into Trusted and stays there: with a user of the controller, or where anonymous users are let in, it may connect like any other client.", "将把本配置工具的证书添加到[信任]并保留：使用控制器的用户，或在允许匿名时，可与其他客户端一样连接。";
    VerifyAfterChanges: "After a change", "更改之后";
    VerifyAfterChangesOn: "Verify when the server has started again", "服务器重新启动后进行验证";

    // client certificates and CRLs
    TrustTitle: "Client certificates", "客户端证书";
    TrustTrusted: "Trusted", "信任";
    TrustRejected: "Rejected", "拒绝";
    TrustIssuers: "Issuers", "发行人";
    TrustFilter: "Filter by name, issuer, address or number", "按名称、颁发者、地址或编号筛选";
    TrustNothingFound: "Nothing matches the filter", "没有匹配的项";
    TrustTrustedEmpty: "Nobody is let in by a certificate yet. Add the certificate of a client, or let a client try to connect: it then appears under Rejected.", "尚未信任任何客户端证书。请添加客户端证书，或让客户端尝试连接，其证书将显示在[拒绝]中。";
    TrustRejectedEmpty: "No client was refused. One that tries to connect and is not let in appears here by itself.", "没有被拒绝的客户端。尝试连接但未被允许的客户端会自动显示在此处。";
    TrustIssuersEmpty: "No authorities. Add the certificates of those that issued the certificates of clients, where these do not send them along.", "没有发行人证书。若客户端不随附证书链，请在此添加签发客户端证书的机构的证书。";
    TrustIssuersLegacy: "Firmware before 8.0.0 has no list of issuers. There, add authorities to Trusted.", "8.0.0 之前的固件没有发行人列表，请将机构证书添加到[信任]。";
    TrustLegacyTrusted: "Firmware before 8.0.0 has no list of issuers; there, authorities go to Trusted", "8.0.0 之前的固件没有发行人列表，机构证书将添加到[信任]";
    TrustFull: "The list is full: delete what is no longer needed first", "列表已满，请先删除不再需要的项";
    TrustIssuersWhy: "Only for firmware 8.0.0 and later", "仅适用于 8.0.0 及更高版本的固件";
    TrustChoose: "Tick something, or click a line first", "请先勾选或单击一行";
    TrustBusy: "Applying the last change…", "正在应用更改…";
    TrustIssuedTo: "Issued to", "颁发给";
    TrustIssuedBy: "Issued by", "颁发者";
    TrustFileName: "File name", "文件名";
    TrustValidFrom: "Valid from", "有效期开始";
    TrustValidUntil: "Valid until", "有效期至";
    TrustThumbprint: "Thumbprint (SHA-1)", "指纹 (SHA-1)";
    TrustReason: "Reason", "拒绝原因";
    TrustAddress: "Address", "地址";
    TrustCount: "Times", "次数";
    TrustFirstSeen: "First seen", "首次出现";
    TrustLastSeen: "Last seen", "最近出现";
    TrustNotYetValid: "not valid yet", "尚未生效";
    TrustNew: "new", "新";
    TrustLive: "Live", "实时";
    TrustLiveTip: "What changes in the controller shows here within a second", "控制器中的变化会在一秒内显示";
    TrustLost: "Connection lost, trying again", "连接中断，正在重试";
    TrustEnded: "Not up to date", "已停止更新";
    TrustAddTo: "Add…", "添加…";
    TrustTrust: "Trust", "信任";
    TrustTrustTip: "Let these clients in from now on", "今后允许这些客户端连接";
    TrustReject: "Reject", "拒绝";
    TrustRejectTip: "Move them to Rejected; their clients are disconnected at once", "移到[拒绝]，相应客户端将立即断开";
    TrustUndo: "Undo", "撤销";
    TrustUndoNothing: "Nothing was changed here that can be taken back", "没有可以撤销的更改";
    TrustUndoTitle: "Undo the change of trust", "撤销信任更改";
    TrustDetails: "Details…", "详细信息…";
    TrustCutTitle: "Disconnected", "已断开的客户端";
    TrustCutNone: "Nobody was disconnected", "没有客户端被断开";
    TrustPickLine: "Click a line to see all of it here", "单击一行可在此查看完整内容";
    TrustMovedHere: "put here by a person, has not come since", "由人工移入，此后未再连接";
    TrustMoveTitle: "Trust anyway?", "仍要信任吗？";
    TrustMove: "Move", "移动";
    TrustDeleteTitle: "Delete certificates", "删除证书";
    TrustDeleteText: "Clients that are not trusted any more are disconnected at once. The OPC UA server goes on running. The deletion can be taken back until the dialog is closed.", "不再受信任的客户端将立即断开，OPC UA 服务器继续运行。关闭对话框之前可以撤销删除。";
    TrustDeleteRejected: "They are forgotten until they try again. This cannot be taken back.", "将清除这些记录，客户端再次尝试连接时会重新出现。此操作无法撤销。";
    TrustAddTitle: "Add certificates", "添加证书";
    TrustAddFiles: "Files", "文件";
    TrustAddText: "Certificates and chains in any format: DER, PEM, P7B. CRLs in them come along. Several files can be chosen at once, or dropped here.", "可使用任意格式的证书和证书链：DER、PEM、P7B，其中的 CRL 会一并添加。可一次选择多个文件，也可拖放到此处。";
    TrustAddRule: "Choose files first", "请先选择文件";
    TrustLeaveOutRule: "Leave out the files that cannot be used first", "请先移除无法使用的文件";
    TrustLeaveOut: "Leave out", "移除";
    TrustTooMany: "At most 100 files at once", "一次最多 100 个文件";
    TrustDropHere: "Drop to see where they go; nothing is sent yet", "松开后显示添加位置，此时尚未发送";
    TrustReadFile: "Read file", "读取文件";
    TrustGoesTo: "Goes to", "添加到";
    TrustWhereGoes: "What goes where", "添加位置";
    TrustByKind: "Sort by kind", "按类型自动分配";
    TrustByKindTip: "Clients to Trusted, authorities to Issuers, CRLs to CRL", "客户端证书添加到[信任]，机构证书添加到[发行人]，CRL 添加到 CRL";
    TrustTrustedTip: "Everything to Trusted; authorities that come with the certificate of a client only complete its chain and go to Issuers", "全部添加到[信任]；随客户端证书附带的机构证书仅用于补全证书链，添加到[发行人]";
    TrustIssuersTip: "Authorities only", "仅机构证书";
    TrustCrls: "CRL", "CRL";
    TrustNothing: "nowhere", "不添加";
    TrustKindClient: "client", "客户端";
    TrustKindAuthority: "authority", "机构";
    TrustKindCrl: "CRL", "CRL";
    TrustSkipRepeated: "is in the files twice", "文件中重复";
    TrustSkipHeld: "is in the controller already", "控制器中已有";
    TrustSkipOutdated: "is older than the one in the controller", "比控制器中的旧";
    TrustSkipNotAsked: "is not what was asked for", "不是要添加的类型";
    TrustOnCurrent: "Firmware 8.0.0 and later", "固件 8.0.0 及以上";
    TrustOnLegacy: "Firmware before 8.0.0", "8.0.0 之前的固件";
    TrustRevokesAtOnce: "Clients whose certificate is revoked are disconnected at once. The OPC UA server goes on running.", "证书被吊销的客户端将立即断开，OPC UA 服务器继续运行。";
    TrustCertificateTitle: "Certificate", "证书";
    TrustSubject: "Subject", "使用者";
    TrustIssuerFull: "Issuer", "颁发者";
    TrustAlternativeNames: "Alternative names", "备用名称";
    TrustKeyUsages: "Key usages", "密钥用法";
    TrustPurposes: "Purposes", "扩展用法";
    TrustAuthority: "Authority", "机构";
    TrustSha256: "Thumbprint (SHA-256)", "指纹 (SHA-256)";
    TrustChain: "Chain", "证书链";
    TrustChainMissing: "missing: add its certificate to Issuers or Trusted", "缺失：请将其证书添加到[发行人]或[信任]";
    TrustChainRevoked: "revoked", "已吊销";
    TrustChainExpired: "expired", "已过期";
    TrustChainNotCa: "is no authority", "不是机构证书";
    TrustChainNoCrl: "no usable CRL", "没有可用的 CRL";
    TrustChainSent: "only sent by the client", "仅由客户端发送";
    TrustCopyPem: "Copy as PEM", "复制为 PEM";
    CrlTitle: "CRL", "CRL";
    CrlAddTitle: "Add CRL", "添加 CRL";
    CrlAddText: "CRL files in any format: DER, PEM, or within P7B. Several can be chosen at once, or dropped here.", "可使用任意格式的 CRL 文件：DER、PEM 或 P7B。可一次选择多个文件，也可拖放到此处。";
    CrlEmpty: "No CRLs. Without one, whether a certificate from an authority was revoked is not known. Add the current CRL of each authority.", "没有 CRL。没有 CRL 就无法得知机构签发的证书是否已被吊销。请添加各机构的最新 CRL。";
    CrlIssuer: "Issuer", "颁发者";
    CrlThisUpdate: "This update", "本次更新";
    CrlNextUpdate: "Next update", "下次更新";
    CrlEntries: "Revoked", "吊销数量";
    CrlNumber: "CRL number", "CRL 编号";
    CrlHealth: "Health", "状态";
    CrlSignature: "Signature", "签名算法";
    CrlGood: "in use", "有效";
    CrlUnusable: "cannot be used", "无法使用";
    CrlExpired: "expired, get a new one", "已过期，请获取新的 CRL";
    CrlNotYet: "not valid yet", "尚未生效";
    CrlNoIssuer: "its issuer is in no list, no use yet", "颁发者不在列表中，暂不起作用";
    CrlWrongKey: "not signed by the issuer of this name, no use", "不是该颁发者签名，不起作用";
    CrlMayNotSign: "its issuer may not sign CRLs, no use", "颁发者无权签发 CRL，不起作用";
    CrlNoEnd: "does not say until when it is valid, no use", "未注明有效期限，不起作用";
    CrlDeleteTitle: "Delete CRLs", "删除 CRL";
    CrlDeleteText: "The certificates they revoke count as valid again, or as unchecked. Clients that are not let in without them are disconnected at once. The deletion can be taken back until the dialog is closed.", "其中吊销的证书将重新有效或无法检查。缺少 CRL 而不再允许的客户端将立即断开。关闭对话框之前可以撤销删除。";
    CrlRevoked: "Revoked certificates", "被吊销的证书";
    CrlRevokedNone: "It revokes no certificate", "没有吊销任何证书";
    CrlWithoutTitle: "Authorities without a usable CRL", "没有可用 CRL 的机构";
    CrlWithoutText: "Whether their certificates were revoked is not known, so clients with one may be refused.", "无法得知其证书是否已被吊销，相应客户端可能被拒绝。";
    ChooseFilesTitle: "Choose files", "选择文件";
    KeyUndo: "Take the last change back, in client certificates and CRLs", "撤销上一次更改（客户端证书和 CRL）";
    KeyPanes: "Change to the next list, in client certificates", "切换列表（客户端证书）";
    KeySideways: "Left, Right", "左、右";

    // backup
    BackupTitle: "Backup", "备份";
    BackupOn: "Keep copies of certificates made here", "保留在此创建的证书副本";
    BackupWhere: "Copies go to a folder per controller, named after its serial number", "副本按控制器序列号分文件夹保存";
    BackupKeys: "Keys are kept only for firmware before 8.0.0, protected by the connection password, which must not be empty. Later firmware makes its keys itself and never gives them away.", "仅保留固件 8.0.0 之前的密钥，并以连接密码保护，连接密码不能为空。新版固件自行生成密钥，且密钥不会离开控制器。";
    BackupRestore: "A backup is put back with Certificate › Restore backup.", "使用[证书]-[恢复备份]恢复备份。";

    // options
    OptionsTitle: "Options", "选项";
    LanguageLabel: "Language", "语言";
    ThemeLabel: "Theme", "主题";
    ThemeSystem: "System", "跟随系统";
    ThemeLight: "Light", "浅色";
    ThemeDark: "Dark", "深色";
    Parallelism: "Controllers at once", "同时处理数量";
    ParallelismTip: "How many controllers a job works on at the same time, 1 to 64", "一次操作同时处理的控制器数量，1 至 64";

    // help
    AboutText: "Sets up the OPC UA servers inside robot controllers: settings, users and certificates", "设置机器人控制器内的 OPC UA 服务器：设置、用户和证书";
    AboutLicence: "Licence: MIT or Apache 2.0. The licences of all components are under Licences.", "许可证：MIT 或 Apache 2.0。全部组件的许可证请见[许可证]。";
    LicencesTitle: "Licences", "许可证";
    LicencesFilter: "Filter by name or licence", "按名称或许可证筛选";
    LicencesNone: "Nothing matches the filter", "没有匹配的项";
    WorkspaceLabel: "Workspace", "工作区";
    KeyMove: "Move through the list", "在列表中移动";
    KeyTick: "Tick or untick the row", "勾选或取消勾选该行";
    KeyRange: "Tick a range of rows", "勾选连续多行";
    KeyConfirm: "Confirm a dialog", "确认对话框";
    KeyCancel: "Cancel a dialog", "取消对话框";
    KeyArrows: "Up, Down", "上、下";
    KeySpace: "Space", "空格";
    KeyShiftClick: "Shift and click", "Shift+单击";
    KeyEnter: "Enter", "Enter";
    KeyEscape: "Esc", "Esc";

    // the small CA
    CaTitle: "Certificate authority", "证书颁发机构";
    CaNone: "This workspace has no certificate authority yet", "该工作区尚无证书颁发机构";
    CaNoneText: "A certificate authority (CA) of your own signs the certificates of controllers and clients, so that everybody only has to trust one certificate. Its key stays on this computer, protected by a passphrase.", "自己的证书颁发机构 (CA) 可为控制器和客户端签发证书，各方只需信任一个证书。CA 密钥保存在本机，并由口令保护。";
    CaCreate: "Create CA…", "创建 CA…";
    CaRestore: "Restore backup…", "恢复备份…";
    CaCreateTitle: "Create CA", "创建 CA";
    CaRestoreTitle: "Restore CA from backup", "从备份恢复 CA";
    CaSignTicked: "Sign ticked controllers…", "为已勾选控制器签发…";
    CaSignTickedTip: "Make or read the CSR of each ticked controller, sign it and import the certificate", "读取或创建已勾选控制器的 CSR，签发并导入证书";
    CaSignTitle: "CA: sign and import", "CA：签发并导入";
    CaSignFile: "Sign CSR file…", "签发 CSR 文件…";
    CaSignFileTitle: "Sign CSR file", "签发 CSR 文件";
    CaRevoke: "Revoke…", "吊销…";
    CaRevokeTitle: "Revoke certificates", "吊销证书";
    CaPublish: "Publish CRL…", "发布 CRL…";
    CaCrlTitle: "CA: publish CRL", "CA：发布 CRL";
    CaBackUp: "Back up…", "备份…";
    CaBackUpTitle: "Back up CA", "备份 CA";
    CaIssued: "Issued certificates", "已签发的证书";
    CaIssuedNone: "No certificate has been issued yet", "尚未签发证书";
    CaProfile: "For", "用途";
    CaServer: "Server", "服务器";
    CaClient: "Client", "客户端";
    CaValid: "Valid", "有效";
    CaExpired: "Expired", "已过期";
    CaRevoked: "Revoked", "已吊销";
    CaCrl: "CRL", "CRL";
    CaTickIssued: "Tick certificates first", "请先勾选证书";
    CaNameHint: "For example Plant 3 CA", "例如 Plant 3 CA";
    CaIntermediate: "With an intermediate CA that signs", "使用中间 CA 签发";
    CaIntermediateTip: "The root then only signs the intermediate, and its key (root.key) can be kept elsewhere.", "此时根 CA 仅签发中间 CA，其密钥 (root.key) 可另行保管。";
    CaKeep: "Keep the passphrase safe. Without it nothing can be signed or revoked, and nobody can restore it.", "请妥善保管口令。没有口令将无法签发或吊销证书，且无法找回。";
    CaPassphraseAgain: "Passphrase again", "再次输入口令";
    CaPassphrasesDiffer: "The two passphrases differ", "两次输入的口令不一致";
    CaPassphraseRule: "At least 8 characters", "至少 8 个字符";
    CaPassphraseNeeded: "Enter the passphrase of the CA", "请输入 CA 的口令";
    CaSignText: "The server certificates of these controllers are replaced by ones the CA signs. A CSR is made where there is none; below firmware 8.0.0 that makes the present CA-signed certificate invalid at once.", "将以 CA 签发的证书替换这些控制器的服务器证书。没有 CSR 时会创建；固件低于 8.0.0 时，现有 CA 签名证书将立即失效。";
    CaNewKey: "Have the controllers make new keys", "让控制器生成新密钥";
    CaRenew: "Renew certificates that are still valid", "续签仍有效的证书";
    CaAcceptWarnings: "Import even where some clients may complain", "即使部分客户端可能发出警告也导入";
    CaSignFileText: "The names in the request are taken over after a check, nothing else.", "检查后仅采用请求中的名称。";
    CaRequest: "Request", "请求";
    CaRevokeText: "Revoked certificates cannot be made valid again. Clients and controllers learn of it from the new CRL, so publish it to them afterwards.", "吊销后无法恢复有效。各方通过新的 CRL 得知吊销，请随后发布 CRL。";
    CaReason: "Reason", "原因";
    CaPublishText: "A new CRL with a new date and number is made and saved in the CA folder.", "将生成具有新日期和编号的 CRL，并保存在 CA 文件夹中。";
    CaPush: "Send it to the ticked controllers, and the CA certificate to their issuers list", "发送到已勾选的控制器，并将 CA 证书加入其发行人列表";
    CaPushNone: "Tick controllers to send it to them as well", "勾选控制器后可同时发送";
    CaTrust: "Trust the CA there: every client with a certificate from it is let in", "在控制器中信任该 CA：允许持有其签发证书的所有客户端连接";
    CaBackUpText: "Keys, certificates and database in one file, which the passphrase of the CA opens.", "将密钥、证书和数据库保存为一个文件，可用 CA 的口令打开。";
    CaRestoreText: "The backup is opened with the passphrase the CA had when it was made.", "使用备份时 CA 的口令打开备份。";
    CaSign: "Sign", "签发";
    CaPublishNow: "Publish", "发布";
    CaRevokeNow: "Revoke", "吊销";
    CaBackUpNow: "Back up", "备份";
    CaRestoreNow: "Restore", "恢复";
    CaCreateNow: "Create", "创建";
    CaWorking: "Working…", "处理中...";
    ReasonUnspecified: "Not specified", "未指定";
    ReasonKeyCompromise: "Key compromised", "密钥泄露";
    ReasonCaCompromise: "CA compromised", "CA 泄露";
    ReasonAffiliationChanged: "Name or owner changed", "名称或所属变更";
    ReasonSuperseded: "Replaced by another certificate", "已被其他证书取代";
    ReasonCessation: "No longer in operation", "停止使用";
    ReasonPrivilegeWithdrawn: "Permission withdrawn", "权限撤销";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn english_follows_the_house_style() {
        for key in TextKey::ALL {
            let (en, zh) = (key.text(Language::En), key.text(Language::Zh));
            assert!(!en.is_empty() && !zh.is_empty(), "{key:?}");
            let sentences = en.matches(". ").count() + 1;
            assert!(sentences > 1 || !en.ends_with('.') || en.ends_with("...") || en.len() > 40, "{key:?}: {en}");
            assert!(!en.ends_with("..."), "{key:?}: use …");
            assert!(!en.ends_with(':'), "{key:?}: no colon after a label");
        }
    }
}
