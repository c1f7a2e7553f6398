use clap::{Arg, ArgAction, Command};

use crate::model::Language;

/// The command line with its help in a language. English stands in the doc comments of the arguments.
pub fn localised(command: Command, language: Language) -> Command {
    match language {
        Language::En => command,
        Language::Zh => chinese(command, ""),
    }
}

fn chinese(command: Command, path: &str) -> Command {
    let command = match text_of(path) {
        Some(about) => command.about(about).long_about(about),
        None => command,
    };
    let names: Vec<String> = command.get_subcommands().map(|below| below.get_name().to_owned()).collect();
    let help = Arg::new("help").short('h').long("help").action(ArgAction::Help);
    let mut command = command.disable_help_flag(true).arg(help);
    if path.is_empty() {
        let version = Arg::new("version").short('V').long("version").action(ArgAction::Version);
        command = command.disable_version_flag(true).arg(version);
    }
    let command = command
        .subcommand_help_heading("命令")
        .help_template(TEMPLATE)
        .disable_help_subcommand(true)
        .mut_args(|arg| argument(arg, path));
    names.into_iter().fold(command, |command, name| {
        let below = if path.is_empty() { name.clone() } else { format!("{path} {name}") };
        command.mut_subcommand(name, |subcommand| chinese(subcommand, &below))
    })
}

fn argument(arg: Arg, path: &str) -> Arg {
    let heading = if arg.is_positional() { "参数" } else { "选项" };
    let text = help_of(path, arg.get_id().as_str()).map(|text| format!("{text}{}", choices(&arg)));
    let takes_values = arg.get_action().takes_values();
    let arg = arg.help_heading(heading);
    let Some(text) = text else { return arg };
    // One text for -h and --help; clap's own remarks are English.
    let arg = arg.help(text.clone()).long_help(text);
    if takes_values { arg.hide_possible_values(true).hide_default_value(true).hide_env(true) } else { arg }
}

/// The values to choose from, the default and the environment variable, as clap would add them.
fn choices(arg: &Arg) -> String {
    if !arg.get_action().takes_values() {
        return String::new();
    }
    let mut text = String::new();
    let possible: Vec<String> = arg.get_possible_values().iter().map(|value| value.get_name().to_owned()).collect();
    if !possible.is_empty() {
        text.push_str(&format!(" [可选值：{}]", possible.join("、")));
    }
    let default: Vec<_> = arg.get_default_values().iter().map(|value| value.to_string_lossy()).collect();
    if default.iter().any(|value| !value.is_empty()) {
        text.push_str(&format!(" [默认：{}]", default.join("、")));
    }
    if let Some(variable) = arg.get_env() {
        text.push_str(&format!(" [环境变量：{}]", variable.to_string_lossy()));
    }
    text
}

fn text_of(path: &str) -> Option<&'static str> {
    COMMANDS.iter().find(|(command, _)| *command == path).map(|(_, text)| *text)
}

/// The text of an argument of this command, or else of the argument that several commands share.
fn help_of(path: &str, id: &str) -> Option<&'static str> {
    let of = |wanted: &str| {
        ARGUMENTS.iter().find(|(command, argument, _)| *command == wanted && *argument == id).map(|(_, _, text)| *text)
    };
    of(path).or_else(|| of(""))
}

const TEMPLATE: &str = "{about-with-newline}\n用法：{usage}\n\n{all-args}{after-help}";

/// Commands, by their path.
const COMMANDS: &[(&str, &str)] = &[
    ("", "配置机器人控制器内的 OPC UA 服务器"),
    ("demo", "在本进程内启动虚拟控制器，并在临时工作区中打开窗口"),
    ("virtual", "不打开窗口，运行虚拟控制器直到按下 Ctrl-C；每台就绪后输出一行 JSON"),
    ("virtual keys", "输出激活文件，其中包含具有这些序列号的虚拟控制器所接受的密钥"),
    (
        "virtual switch",
        "切换在另一进程中以 --data 运行的虚拟控制器的故障：任务运行中、示教器已连接、OPC UA 服务器故障。一秒内生效，直到再次切换；不带开关时显示当前状态",
    ),
    ("controllers", "查看、添加、导入、确认和删除控制器"),
    ("controllers list", "列出已注册的控制器"),
    ("controllers add", "注册控制器"),
    ("controllers remove", "从列表中删除控制器；控制器本身不受影响"),
    ("controllers import", "添加连接列表中的控制器；确认指纹之前不会向其发送数据"),
    ("controllers trust", "接受已导入的控制器的指纹"),
    ("info", "读取并显示控制器的信息"),
    ("start", "启动 OPC UA 服务器"),
    ("stop", "停止 OPC UA 服务器"),
    ("settings", "显示或更改 OPC UA 服务器的基本设置"),
    ("settings show", "显示基本设置"),
    ("settings set", "更改基本设置；未指定的项保持不变"),
    ("users", "查看、添加和删除 OPC UA 服务器的用户"),
    ("users list", "列出用户；控制器不会返回密码"),
    ("users add", "添加用户：用户名和密码各为 8 至 32 个半角字母或数字"),
    ("users remove", "删除用户：用户… 控制器…"),
    ("activate", "使用密钥激活固件 8.0.0 之前的控制器"),
    ("cert", "创建、申请、导入、选择和导出服务器证书"),
    ("cert self-signed", "创建并安装自签名服务器证书"),
    ("cert csr", "创建密钥及其证书签名请求 (CSR)，保存到工作区中控制器文件夹的 Cert/CSR/3_csr"),
    ("cert import-ca", "导入 CA 为签名请求颁发的证书"),
    (
        "cert import-user",
        "将用其他工具创建的密钥和证书导入一台固件低于 8.0.0 的控制器：文件.pfx 控制器，或 证书 私钥文件 控制器",
    ),
    ("cert select", "选择服务器使用控制器中的哪个证书"),
    ("cert restore", "将密钥备份以原有类型恢复到固件低于 8.0.0 的控制器"),
    ("cert export", "将自签名证书保存到工作区中控制器文件夹的 Cert/SelfSigned/1_cert"),
    ("pki", "查看证书文件的内容，或在没有控制器的情况下检查证书"),
    ("pki show", "以 JSON 显示文件中所有公开内容：证书、证书链、吊销列表、签名请求、密钥、PKCS#7 和 PKCS#12"),
    (
        "pki verify",
        "按 OPC UA 应用程序的方式检查证书，并输出 OPC UA 状态：Good、BadCertificateRevoked 等；退出代码 0 表示 Good，否则为 1",
    ),
    ("ca", "工作区的小型 CA：创建、签发、吊销、发布 CRL、备份"),
    ("ca init", "创建本工作区的 CA"),
    ("ca sign", "签发文件中的证书签名请求 (DER 或 PEM)"),
    ("ca sign-controllers", "为控制器签发证书并导入：使用控制器中已有的签名请求，没有时新建。可重复执行"),
    ("ca revoke", "吊销证书并发布包含这些证书的 CRL；此操作无法撤销"),
    ("ca crl", "发布新的 CRL，并可发送到控制器"),
    ("ca show", "显示 CA、其 CRL 和已签发的证书；不需要口令"),
    ("ca backup", "将整个 CA 保存为一个文件，以 CA 的口令加密"),
    ("ca restore", "将备份恢复到没有 CA 的工作区"),
    ("clients", "查看、添加、信任和删除客户端证书和机构证书"),
    ("clients list", "列出允许连接的客户端证书、机构证书和被拒绝的客户端"),
    ("clients add", "添加允许连接的客户端证书或机构证书，以及随附的 CRL：文件… 控制器…"),
    ("clients remove", "从所在的全部列表中删除证书：指纹… 控制器…"),
    ("clients trust", "允许被拒绝的客户端连接：指纹… 控制器…"),
    ("crl", "查看、添加和删除证书吊销列表"),
    ("crl list", "列出 CRL；持有已吊销证书的客户端会被拒绝"),
    ("crl add", "添加 CRL；替换同一颁发者的旧 CRL：文件… 控制器…"),
    ("crl remove", "按 list 显示的编号删除 CRL：编号… 控制器…"),
    ("log", "显示或删除 OPC UA 服务器的日志"),
    ("log show", "显示 OPC UA 服务器的日志；可用 settings set --server-log on 打开日志"),
    ("log delete", "删除服务器日志；将停止 OPC UA 服务器，若之前正在运行则重新启动"),
    ("export-settings", "将固件 8.0.0 之前的控制器的设置、用户和密钥保存到工作区"),
    ("import-settings", "将导出的设置、用户和密钥恢复到原控制器"),
    ("verify", "以客户端方式尝试 OPC UA 服务器提供的每个端点和令牌，说明哪些正常、哪些不正常及原因"),
    ("backup", "打开或关闭所创建内容的备份"),
    ("backup on", "保留在此创建的证书和密钥的副本"),
    ("backup off", "不保留副本"),
    ("backup show", "显示是否保留副本以及保存位置"),
    ("vault", "保存在工作区中的加密连接密码，用于没有密钥环的计算机"),
    (
        "vault init",
        "创建密码库并开始使用；接管密钥环中已有的密码。口令至少 8 个字符，从 --vault-passphrase-file 读取或在终端询问；没有口令无法打开密码库",
    ),
    ("vault status", "显示是否有密码库及是否使用；指定 --vault-passphrase-file 时列出其中有密码的控制器"),
    ("vault import", "将列表中的连接密码放入密码库"),
    ("vault forget", "从密码库中删除密码；控制器保留在列表中"),
    ("vault passphrase", "更改密码库的口令；其文件的旧副本仍可用原口令打开"),
    ("vault on", "将连接密码保存在密码库中"),
    ("vault off", "将连接密码保存在操作系统的密钥环中；密码库保持不变"),
    ("licences", "显示本程序所含全部组件的许可证"),
    ("completions", "输出 shell 的补全脚本"),
];

/// Arguments: command, id, text. Those without a command are shared.
const ARGUMENTS: &[(&str, &str, &str)] = &[
    ("", "help", "显示帮助"),
    ("", "version", "显示版本"),
    (
        "",
        "workspace",
        "保存控制器列表及其全部文件的文件夹 [默认：主目录中的 EpsonRC80/OPCUA，Windows 上为 C:\\EpsonRC80\\OPCUA]",
    ),
    ("", "lang", "消息的语言：en 或 zh [默认：系统语言]"),
    ("", "json", "在标准输出中每台控制器输出一行 JSON"),
    ("", "yes", "停止、替换或删除之前不询问；没有终端时必须指定"),
    (
        "",
        "connection_password_file",
        "所选控制器的连接密码文件，\"-\" 表示标准输入；未指定时从操作系统的密钥环或工作区的密码库读取",
    ),
    ("", "connection_password_list", "按控制器名称给出连接密码的 CSV 文件，列为 Name,Password"),
    ("", "vault_passphrase_file", "连接密码库的口令文件，\"-\" 表示标准输入"),
    ("", "verbose", "在标准错误输出中显示更多消息；重复两次更详细"),
    ("", "names", "控制器名称"),
    ("", "all", "列表中的全部控制器"),
    ("", "arguments", "先是命令的对象，然后是控制器名称"),
    ("", "passphrase_file", "CA 口令文件，\"-\" 表示标准输入 [默认：在终端询问]"),
    ("", "cn", "通用名，仅用于一台控制器 [默认：控制器自身的 EpsonRC.<序列号>.<地址>]"),
    ("", "country", "国家，ISO 3166-1 alpha-2 代码"),
    ("", "state", "州或省名称"),
    ("", "locality", "地区名称"),
    ("", "organisation", "机构"),
    ("", "bits", "密钥长度：1024、2048 或 4096，须为已勾选安全策略所允许"),
    ("", "years", "有效期，1 至 10 年"),
    ("", "format", "文件格式"),
    ("", "seed", "相同的种子生成相同的控制器"),
    ("", "series", "RC90、RC700、T/VT 或 RC800"),
    ("", "fingerprint", "控制器管理身份的 SHA-256，与控制器上显示的一致"),
    ("", "trust_on_first_use", "接受控制器当前出示的任何指纹：仅在无人能冒充控制器的网络中安全"),
    ("", "renew", "对已签发过的请求重新签发；原证书仍然有效"),
    ("", "accept_warnings", "即使客户端可能对证书发出警告也导入；警告内容会列出"),
    ("", "allow_short_keys", "允许签发低于 2048 位的密钥，仅已弃用的安全策略可使用"),
    ("demo", "controllers", "控制器数量；前八台各不相同"),
    ("virtual", "count", "控制器数量"),
    ("virtual", "bind", "监听地址；使用非回环地址时整个网络均可访问"),
    ("virtual", "management_port", "管理协议的第一个端口，后续控制器依次使用下一个端口；0 表示自动选择"),
    ("virtual", "opcua_port", "OPC UA 服务器的第一个端口，后续控制器依次使用下一个端口；0 表示自动选择"),
    ("virtual", "firmware", "控制器的固件"),
    ("virtual", "not_activated", "旧固件的控制器不带密钥，可用 virtual keys 输出的密钥激活"),
    ("virtual", "password_file", "全部控制器的连接密码文件，\"-\" 表示标准输入；未指定时为空"),
    ("virtual", "data", "保存控制器数据的文件夹；未指定时使用临时文件夹"),
    ("virtual", "detailed_status", "向被拒绝的 OPC UA 客户端说明其证书的问题"),
    ("virtual", "allow_unknown_revocation", "允许 CA 未提供有效吊销列表的 OPC UA 客户端"),
    ("virtual switch", "data", "virtual --data 所指定的文件夹；窗口的虚拟控制器位于工作区的 virtual 文件夹"),
    ("virtual switch", "task_running", "有程序在运行：拒绝更改、启动和停止"),
    ("virtual switch", "teach_pendant", "已连接示教器：拒绝更改、启动和停止"),
    ("virtual switch", "server_error", "OPC UA 服务器启动时出现错误 580"),
    ("virtual switch", "all", "文件夹中的全部控制器"),
    ("virtual switch", "serials", "序列号"),
    ("virtual keys", "serials", "序列号"),
    ("controllers add", "name", "1 至 32 个字符"),
    ("controllers add", "address", "IP 地址或主机名；管理协议使用非默认端口时须带端口"),
    ("controllers add", "password_file", "连接密码文件，\"-\" 表示标准输入；保存在操作系统的密钥环中"),
    (
        "controllers add",
        "unconfirmed",
        "添加而不确认其身份，例如控制器已关机：在执行 controllers trust 之前不会向其发送任何数据",
    ),
    ("controllers remove", "names", "控制器名称"),
    ("controllers import", "file", "含 Name,Type,Address 列的 UTF-8 CSV 文件 [默认：工作区中的 connections.csv]"),
    ("controllers import", "series", "连接控制器之前显示的类型：RC90、RC700、T/VT 或 RC800"),
    ("controllers trust", "name", "列表中的名称"),
    ("controllers trust", "password_file", "连接密码文件，\"-\" 表示标准输入；保存在操作系统的密钥环中"),
    ("settings set", "port", "OPC UA 服务器的 TCP 端口，1024 至 65535"),
    ("settings set", "startup", "服务器启动方式：auto (控制器上电时) 或 manual (手动)"),
    (
        "settings set",
        "policies",
        "安全策略，以逗号分隔：None、Basic128Rsa15、Basic256、Basic256Sha256、Aes128Sha256RsaOaep、Aes256Sha256RsaPss",
    ),
    ("settings set", "tokens", "用户令牌，以逗号分隔：anonymous、username"),
    ("settings set", "server_log", "写服务器日志：on 或 off。平时应关闭；日志写满时服务器会停止"),
    (
        "settings set",
        "log_password_file",
        "打开服务器日志所需的密码 (199532) 文件，\"-\" 表示标准输入 [默认：在终端询问]",
    ),
    ("settings set", "delete_log", "删除控制器中的服务器日志"),
    ("users add", "user", "用户名"),
    ("users add", "password_file", "用户密码文件，\"-\" 表示标准输入"),
    ("activate", "file", "激活文件：UTF-8 CSV，第一行为 OPCUA.Activation.Ver.1.0，之后每行为 序列号,许可密钥,激活密钥"),
    ("activate", "license", "许可密钥 xxxx-xxxx-xxxx-xxxx，用于一台控制器"),
    ("activate", "activation", "激活密钥 XXXX-XXXX-XXXX-XXXX-XXXX-XXXX，用于一台控制器"),
    ("cert import-ca", "file", "证书文件，仅用于一台控制器 [默认：控制器的 Cert/CASigned 中唯一的 .der 文件]"),
    ("cert import-user", "password_file", ".pfx 或私钥的密码文件，\"-\" 表示标准输入"),
    ("cert select", "kind", "证书类型"),
    (
        "cert restore",
        "kind",
        "备份的内容：自签名证书及其密钥 (Cert/SelfSigned/1_key.pfx)，或签名请求、其密钥以及 CA 证书 (Cert/CASigned/3_key.pfx)",
    ),
    ("cert restore", "file", "改用此密钥文件，例如已移动到以日期命名的文件夹中的文件；仅用于一台控制器"),
    ("cert restore", "password_file", "密钥文件的密码文件，\"-\" 表示标准输入 [默认：连接密码]"),
    ("pki show", "file", "文件"),
    ("pki show", "password_file", ".pfx 或私钥的密码文件，\"-\" 表示标准输入"),
    ("pki verify", "trusted", "受信任的应用程序证书和 CA 证书"),
    ("pki verify", "issuers", "仅用于补全证书链的 CA 证书"),
    ("pki verify", "crls", "证书吊销列表"),
    ("pki verify", "at", "检查所用的时间，例如 2026-01-31T12:00:00Z [默认：当前时间]"),
    ("pki verify", "uri", "应用程序声明的 ApplicationUri [默认：不检查]"),
    ("pki verify", "host", "访问应用程序所用的地址或主机名 [默认：不检查]"),
    ("pki verify", "policy", "要使用的安全策略 [默认：除已弃用策略之外的要求]"),
    ("pki verify", "role", "应用程序的角色 [默认：指定 --host 时为 server，否则为 either]"),
    ("pki verify", "allow_unknown_revocation", "接受没有吊销列表的证书"),
    ("pki verify", "certificate", "证书，或以该证书开头的证书链"),
    ("ca init", "cn", "CA 的通用名"),
    ("ca init", "bits", "密钥长度：2048 或 4096"),
    ("ca init", "years", "有效期，1 至 30 年"),
    ("ca init", "intermediate", "创建根 CA 及其下负责签发的中间 CA，根 CA 的密钥 (CA/root.key) 可另行保管"),
    ("ca init", "intermediate_cn", "中间 CA 的通用名 [默认：CN 加 \" intermediate\"]"),
    ("ca init", "intermediate_years", "中间 CA 的有效期 (年)；不超过根 CA 的有效期"),
    ("ca init", "crl_days", "CRL 的有效天数"),
    ("ca sign", "files", "证书签名请求"),
    ("ca sign", "profile", "证书的用途"),
    ("ca sign", "out", "同时将各证书以请求的文件名保存到此文件夹 [默认：仅保存在 CA/issued]"),
    ("ca sign", "format", "--out 中文件的格式"),
    ("ca sign", "years", "有效期，1 至 10 年；不超过 CA 的有效期"),
    ("ca sign", "uri", "替代请求中的应用程序 URI，与 --host 一起使用"),
    ("ca sign", "host", "替代请求中的主机名或 IP 地址；可重复指定"),
    ("ca sign-controllers", "years", "有效期，1 至 10 年；不超过 CA 的有效期"),
    ("ca sign-controllers", "new_key", "即使控制器中已有签名请求，也让其生成新密钥"),
    ("ca revoke", "serials", "完整的十六进制序列号，如 ca show 所列"),
    (
        "ca revoke",
        "reason",
        "原因 (RFC 5280)：unspecified、keyCompromise、cACompromise、affiliationChanged、superseded、cessationOfOperation 或 privilegeWithdrawn",
    ),
    (
        "ca crl",
        "out",
        "将 CRL 保存到此文件，文件名以 .pem 结尾时为 PEM，否则为 DER；上级根 CA 的 CRL 保存在旁边，名称为 root-…",
    ),
    ("ca crl", "days", "有效天数 [默认：与上一个相同]"),
    ("ca crl", "push", "将 CRL 发送到这些控制器，并将 CA 证书添加到其发行人列表"),
    ("ca crl", "all", "与 --push 一起使用：列表中的全部控制器"),
    ("ca crl", "trust", "与 --push 一起使用：将 CA 证书添加到信任列表，允许持有其签发证书的所有客户端连接"),
    ("ca backup", "out", "保存位置"),
    ("ca restore", "file", "ca backup 保存的文件"),
    ("clients list", "list", "仅此列表"),
    ("clients add", "list", "证书添加到的列表；未指定时按证书的种类分配"),
    ("log show", "end", "仅最后 256 KiB"),
    (
        "export-settings",
        "passphrase_file",
        "保护导出文件的口令文件，至少 8 个字符，\"-\" 表示标准输入；未指定时使用连接密码",
    ),
    (
        "import-settings",
        "passphrase_file",
        "保护导出文件的口令文件，至少 8 个字符，\"-\" 表示标准输入；未指定时使用连接密码",
    ),
    ("vault import", "file", "含 Name,Password 列的 CSV 文件；密码为空表示该控制器没有密码"),
    ("vault forget", "names", "控制器名称，或已不在列表中的控制器的指纹"),
    ("vault passphrase", "new_passphrase_file", "新口令文件，\"-\" 表示标准输入；未指定时在终端询问"),
    ("verify", "user", "在需要用户名时用于登录的用户；未指定时不尝试此类登录"),
    ("verify", "user_password_file", "用户密码文件，\"-\" 表示标准输入"),
    ("verify", "trust_me", "先将本配置工具的证书添加到各控制器的信任列表，并保留在其中"),
    ("licences", "components", "要显示许可证文本的组件，all 表示全部 [默认：仅列表]"),
    ("completions", "shell", "shell 名称"),
];

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;
    use crate::cli::Cli;

    /// Paths of all commands, and of each the ids of its own arguments.
    fn all(command: &Command, path: &str, found: &mut Vec<(String, Vec<String>)>) {
        let ids = command.get_arguments().map(|arg| arg.get_id().to_string()).collect();
        found.push((path.to_owned(), ids));
        for below in command.get_subcommands() {
            let path =
                if path.is_empty() { below.get_name().to_owned() } else { format!("{path} {}", below.get_name()) };
            all(below, &path, found);
        }
    }

    #[test]
    fn every_command_and_argument_has_a_chinese_text_and_no_text_is_left_over() {
        let mut found = Vec::new();
        all(&Cli::command(), "", &mut found);
        let missing_commands: Vec<_> = found.iter().filter(|(path, _)| text_of(path).is_none()).collect();
        let missing_arguments: Vec<_> = found
            .iter()
            .flat_map(|(path, ids)| ids.iter().map(move |id| (path, id)))
            .filter(|(path, id)| help_of(path, id).is_none())
            .collect();
        assert!(
            missing_commands.is_empty() && missing_arguments.is_empty(),
            "{missing_commands:?} {missing_arguments:?}"
        );
        for (path, _) in COMMANDS {
            assert!(found.iter().any(|(known, _)| known == path), "no command is called {path:?}");
        }
        for (path, id, _) in ARGUMENTS.iter().filter(|(path, ..)| !path.is_empty()) {
            let known = found.iter().any(|(command, ids)| command == path && ids.iter().any(|known| known == id));
            assert!(known, "{path:?} has no argument {id:?}");
        }
    }

    #[test]
    fn the_help_is_chinese_and_english_by_choice() {
        let help = |language, path: &[&str]| {
            let mut command = localised(Cli::command(), language);
            command.build();
            let found = path.iter().fold(&mut command, |command, name| command.find_subcommand_mut(name).unwrap());
            found.render_long_help().to_string()
        };
        let chinese = help(Language::Zh, &["cert", "self-signed"]);
        for text in ["创建并安装自签名服务器证书", "用法：", "选项", "--country <CC>", "国家，ISO 3166-1", "显示帮助"]
        {
            assert!(chinese.contains(text), "no {text} in\n{chinese}");
        }
        for text in ["Options:", "Usage:", "Print help", "Country"] {
            assert!(!chinese.contains(text), "{text} in\n{chinese}");
        }
        assert!(help(Language::En, &["cert", "self-signed"]).contains("Make and install a self-signed"));
        let root = help(Language::Zh, &[]);
        assert!(root.contains("命令") && root.contains("启动 OPC UA 服务器") && !root.contains("Commands:"), "{root}");
    }
}
