//! What is said of PLCs and bridges, in Chinese.

use crate::fins::codec::cpu::PlcErrorKind;
use crate::fins::codec::end_code::{EndCode, EndCodeRemedy, KnownEndCode};

fixed_texts! {
    FinsModel: "型号";
    FinsVersion: "版本";
    FinsMode: "运行模式";
    FinsProgram: "用户程序";
    FinsProgramRuns: "运行中";
    FinsProgramStands: "未运行";
    FinsClock: "时钟";
    FinsFatalErrors: "致命错误";
    FinsNonFatalErrors: "非致命错误";
    FinsErrorMessage: "错误信息";
    FinsNodes: "节点（本程序、PLC）";
    FinsNone: "无";
    HeadingRow: "行";
    HeadingPlc: "PLC";
    HeadingDirection: "方向";
    HeadingRobot: "机器人";
    HeadingValues: "值";
    HeadingCopied: "已复制";
    HeadingFailed: "失败";
    HeadingUnknown: "不确定";
    HeadingError: "错误";
}

texts_of_values! { end_code(KnownEndCode):
    NormalCompletion: "正常结束";
    ServiceCancelled: "服务被取消";
    LocalNodeNotInNetwork: "本地节点不在网络中";
    TokenTimeout: "令牌超时";
    RetriesFailed: "重试全部失败";
    TooManySendFrames: "待发送帧过多";
    NodeAddressRange: "节点超出范围";
    NodeAddressDuplicate: "节点地址重复";
    DestinationNotInNetwork: "目标节点不在网络中";
    UnitMissing: "目标单元不存在";
    ThirdNodeMissing: "第三节点不存在";
    DestinationBusy: "目标节点忙";
    ResponseTimeout: "响应超时";
    CommunicationsControllerError: "通信控制器错误";
    CpuUnitError: "CPU 单元错误";
    ControllerError: "控制器错误";
    UnitNumberError: "单元号错误";
    UndefinedCommand: "命令未定义";
    NotSupportedByModel: "型号或版本不支持该命令";
    DestinationNotInRoutingTable: "路由表中没有目标地址";
    NoRoutingTables: "没有路由表";
    RoutingTableError: "路由表错误";
    TooManyRelays: "中继过多";
    CommandTooLong: "命令过长";
    CommandTooShort: "命令过短";
    ElementsAndDataDiffer: "元素数与数据不符";
    CommandFormatError: "命令格式错误";
    HeaderError: "头部错误";
    AreaMissing: "存储区不存在";
    AccessSizeError: "访问大小错误或地址为奇数";
    AddressRangeError: "起始地址超出存储区";
    AddressRangeExceeded: "结束地址超出存储区";
    ProgramMissing: "程序不存在";
    RelationalError: "参数相互矛盾";
    DuplicateDataAccess: "同时重复访问数据";
    ResponseTooLong: "响应过长";
    ParameterError: "参数错误";
    ReadProtected: "数据禁止读取";
    ReadTableMissing: "表不存在";
    ReadDataMissing: "数据不存在";
    ReadProgramMissing: "要读取的程序不存在";
    ReadFileMissing: "要读取的文件不存在";
    DataMismatch: "数据不一致";
    ReadOnly: "该区域只读";
    WriteProtected: "数据禁止写入";
    CannotRegister: "无法登记";
    WriteProgramMissing: "要写入的程序不存在";
    WriteFileMissing: "要写入的文件不存在";
    FileExists: "文件已存在";
    CannotChange: "无法更改";
    NotDuringExecution: "执行期间不能操作";
    NotWhileRunning: "PLC 运行期间不能操作";
    WrongModeProgram: "PROGRAM 模式下不能操作";
    WrongModeDebug: "DEBUG 模式下不能操作";
    WrongModeMonitor: "MONITOR 模式下不能操作";
    WrongModeRun: "RUN 模式下不能操作";
    NotPollingNode: "该节点不是轮询节点";
    StepNotExecutable: "无法执行该步";
    FileDeviceMissing: "文件装置不存在";
    MemoryMissing: "存储器不存在";
    ClockMissing: "时钟不存在";
    StartTableMissing: "启动所需的表不存在";
    UnitMemoryError: "存储器错误";
    IoSettingError: "I/O 设置错误";
    TooManyIoPoints: "I/O 点数过多";
    CpuBusError: "CPU 总线错误";
    IoDuplication: "I/O 地址重复";
    IoBusError: "I/O 总线错误";
    SysmacBus2Error: "SYSMAC BUS/2 错误";
    CpuBusUnitError: "CPU 总线单元错误";
    SysmacBusDuplication: "SYSMAC BUS 编号重复";
    MemoryError: "内部存储器或存储卡错误";
    TerminatorMissing: "缺少 SYSMAC BUS 终端";
    NotProtected: "没有保护";
    WrongPassword: "密码错误";
    Protected: "受保护";
    AlreadyExecuting: "该服务正在执行";
    ServiceStopped: "该服务已停止";
    NoExecutionRight: "没有执行权限";
    SettingsIncomplete: "设置不完整";
    ItemsNotSet: "未设置必需的项目";
    NumberAlreadyDefined: "编号已定义";
    ErrorNotCleared: "错误无法清除";
    NoAccessRight: "其他设备持有访问权";
    ServiceAborted: "服务被中止";
}

texts_of_values! { remedy(EndCodeRemedy):
    None: "没有问题。";
    Retry: "请重试。若仍然如此，请降低 PLC 及其网络的负荷。";
    NetworkUnit: "请检查网络单元的设置。";
    Destination: "请检查目标 PLC 的节点、网线和电源。";
    PlcError: "请查看 PLC 或单元显示的错误，并排除原因。";
    Unsupported: "该 PLC 不提供此命令，请使用其他命令。";
    Routing: "请在路由表中登记到目标的路径。";
    Format: "本程序与该 PLC 无法相互理解，请将显示的详细信息一并反馈。";
    Address: "请对照 PLC 型号检查存储区、地址和元素数。";
    Protection: "请解除保护，或选择其他区域。";
    Mode: "请更改 PLC 的运行模式。";
    AccessRight: "请等待其他设备释放访问权。";
    Missing: "请在 PLC 中创建缺少的内容，或指定其他内容。";
}

texts_of_values! { plc_error(PlcErrorKind):
    Watchdog: "看门狗";
    Fals: "FALS";
    Fal: "FAL";
    CycleTimeOver: "循环时间过长";
    Program: "程序";
    IoSetting: "I/O 设置";
    TooManyIoPoints: "I/O 点数过多";
    InnerBoard: "内插板";
    Duplication: "编号重复";
    IoBus: "I/O 总线";
    Memory: "存储器";
    SpecialIoUnitSetting: "特殊 I/O 单元设置";
    CpuBusUnitSetting: "CPU 总线单元设置";
    Battery: "电池";
    SysmacBus: "SYSMAC BUS";
    SpecialIoUnit: "特殊 I/O 单元";
    CpuBusUnit: "CPU 总线单元";
    IoVerification: "I/O 校验";
    PlcSetup: "PLC 设置";
    BasicIoUnit: "基本 I/O 单元";
    InterruptTask: "中断任务";
}

pub fn plc_advice(end: EndCode) -> String {
    let code = format!("{:04X}", end.code);
    let relay = if end.is_relay_error { "（网络中继命令时发生）" } else { "" };
    match end.known() {
        Some(known) => format!("结束代码 {code}：{}{relay}。{}", end_code(known), remedy(known.remedy())),
        None => format!("手册的表中没有结束代码 {code}{relay}。"),
    }
}

pub fn plc_written(range: &str) -> String {
    format!("已写入：{range}")
}

pub fn plc_partly_written(done: usize, uncertain: usize) -> String {
    match uncertain {
        0 => format!("此前 PLC 已确认 {done} 个元素"),
        _ => format!("此前 PLC 已确认 {done} 个元素；其后的 {uncertain} 个无法确定"),
    }
}

pub fn plc_simulated(address: &str, node: u8) -> String {
    format!("模拟 PLC（节点 {node}）正在 {address} 应答；按 Ctrl-C 结束")
}

pub fn plc_watched(what: &str) -> String {
    format!("正在监视 {what}；按 Ctrl-C 结束")
}

pub fn bridge_started(rows: usize) -> String {
    format!("桥接正在复制 {rows} 行；按 Ctrl-C 结束")
}

pub fn bridge_row_copied(row: &str) -> String {
    format!("{row}：已复制")
}

pub fn bridge_ended(cycles: u64, complete: u64, longest_ms: u128) -> String {
    format!("周期数：{cycles}，其中完整的：{complete}，最长 {longest_ms} ms")
}
