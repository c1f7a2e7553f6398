//! The main window, in Chinese.

fixed_texts! {
    // the program
    AppName: "OPC UA 配置工具";

    // menus
    MenuController: "控制器";
    MenuCertificate: "证书";
    MenuServer: "服务器设置";
    MenuOptions: "选项";
    MenuTools: "工具";
    MenuHelp: "帮助";
    MenuCreate: "创建与保存";
    MenuClients: "客户端证书";

    // why a command is disabled
    WhyTick: "请先勾选至少一台控制器";
    WhyEmpty: "列表为空";
    WhyVirtual: "此版本不可用";

    // commands of the window itself
    TickAll: "全选";
    TickAllTip: "勾选所有显示的控制器";
    Search: "搜索";
    SearchTip: "按名称、地址、序列号和类型搜索";
    CommandPalette: "查找命令…";
    CommandPaletteTip: "按名称的一部分查找任意命令";
    RowDetails: "详细信息";
    RowDetailsTip: "显示或隐藏光标所在控制器的详细信息";
    Quit: "退出";
    QuitTip: "关闭窗口";

    // command palette
    PaletteHint: "命令名称的一部分";
    PaletteNone: "没有此名称的命令";

    // table
    ColumnName: "名称";
    ColumnType: "控制器类型";
    ColumnAddress: "IP 地址";
    ColumnSerial: "序列号";
    ColumnStatus: "状态";
    ColumnExpiry: "有效期";
    ColumnCertificate: "认证类型";
    ColumnActivation: "激活";
    ColumnRetrieved: "获取日期";
    NotConfirmed: "未确认";
    NotConfirmedTip: "核对指纹之前不会向其发送数据：请选择[获取新信息]";
    StatusRun: "运行";
    StatusStop: "停止";
    StatusError: "错误";
    Expired: "已过期";
    ExpiresSoon: "即将到期";
    TypeSelfSigned: "自签名";
    TypeUserSpecified: "用户指定";
    TypeCaSigned: "CA 签名";
    Yes: "是";
    No: "否";
    NotRead: "尚未获取";
    NothingFound: "没有匹配的控制器";
    ClearSearch: "清除搜索";
    Confirmed: "已确认";
    SortedTip: "单击排序，再次单击反转顺序";
    DragColumnTip: "拖动可移动此列";

    // details of a row
    DetailsChoose: "请选择控制器：单击其所在行或使用方向键";
    DetailsServer: "OPC UA 服务器";
    DetailsFirmware: "固件";
    DetailsLastResult: "上次结果";
    DetailsNoResult: "打开窗口以来没有执行过作业";
    DetailsLists: "设置和列表";
    DetailsRead: "读取设置和列表";
    DetailsNotRead: "打开窗口以来未读取";
    DetailsNoCertificate: "无证书";
    DetailsNone: "无";
    DetailsApplicationUri: "应用程序 URI";

    // welcome
    WelcomeTitle: "尚无控制器";
    WelcomeText: "请添加要设置其 OPC UA 服务器的控制器";
    WelcomeAdd: "添加控制器";
    WelcomeVirtualText: "手边没有机器人？模拟控制器在本机运行，行为与真实控制器一致";
    StartingVirtual: "正在启动虚拟控制器…";
    TryVirtual: "使用虚拟控制器试用";
    TryVirtualTip: "在本机启动几台模拟控制器并添加到列表";

    // backup
    Backup: "备份…";
    BackupTip: "在工作区中保留证书副本";
    BackupTitle: "备份";
    BackupOn: "保留在此创建的证书副本";
    BackupWhere: "副本按控制器序列号分文件夹保存";
    BackupKeys: "仅保留固件 8.0.0 之前的密钥，并以连接密码保护，连接密码不能为空。新版固件自行生成密钥，且密钥不会离开控制器。";
    BackupRestore: "使用[证书]-[恢复备份]恢复备份。";

    // options
    Options: "选项…";
    OptionsTip: "语言、主题和同时处理的控制器数量";
    OptionsTitle: "选项";
    LanguageLabel: "语言";
    ThemeLabel: "主题";
    ThemeSystem: "跟随系统";
    ThemeLight: "浅色";
    ThemeDark: "深色";
    Parallelism: "同时处理数量";
    ParallelismTip: "一次操作同时处理的控制器数量，1 至 64";

    // help
    Shortcuts: "键盘快捷键";
    ShortcutsTip: "本窗口的全部快捷键";
    Licences: "许可证…";
    LicencesTip: "本程序所含全部组件的许可证";
    About: "关于";
    AboutTip: "版本与许可证";
    AboutText: "设置机器人控制器内的 OPC UA 服务器：设置、用户和证书";
    AboutLicence: "许可证：MIT 或 Apache 2.0。全部组件的许可证请见[许可证]。";
    LicencesTitle: "许可证";
    LicencesFilter: "按名称或许可证筛选";
    LicencesNone: "没有匹配的项";
    WorkspaceLabel: "工作区";
    KeyMove: "在列表中移动";
    KeyTick: "勾选或取消勾选该行";
    KeyRange: "勾选连续多行";
    KeyConfirm: "确认对话框";
    KeyCancel: "取消对话框";
    KeyArrows: "上、下";
    KeySpace: "空格";
    KeyShiftClick: "Shift+单击";
    KeyEnter: "Enter";
    KeyEscape: "Esc";
    KeyDetails: "显示该行的详细信息";
    KeyRowMenu: "该行的菜单";
    KeyMenu: "菜单键或 Shift+F10";
    KeyEnterRow: "Enter 或双击";
}
