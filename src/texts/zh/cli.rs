//! Sentences of the command line, in Chinese.

use std::fmt::Display;

use super::LANGUAGE;
use crate::texts::TextKey;

fixed_texts! {
    // headings of tables, in capitals
    HeadingActivated: "激活";
    HeadingAddress: "IP 地址";
    HeadingBits: "密钥位数";
    HeadingCa: "CA";
    HeadingCertificate: "认证类型";
    HeadingCertificates: "证书";
    HeadingCommonName: "通用名";
    HeadingController: "控制器";
    HeadingCrls: "CRL";
    HeadingCrlNumber: "CRL 编号";
    HeadingDisconnected: "已断开";
    HeadingEndpoint: "端点";
    HeadingExpiry: "有效期";
    HeadingFile: "文件";
    HeadingFirmware: "固件版本";
    HeadingGoesTo: "添加到";
    HeadingIdentity: "身份";
    HeadingIssuedBy: "颁发者";
    HeadingIssuedTo: "颁发给";
    HeadingIssuers: "发行人";
    HeadingLicence: "许可证";
    HeadingLog: "服务器日志";
    HeadingName: "名称";
    HeadingNextCrlBy: "下次更新";
    HeadingNote: "备注";
    HeadingPolicies: "安全策略";
    HeadingPort: "端口";
    HeadingProfile: "用途";
    HeadingRejected: "拒绝";
    HeadingResult: "结果";
    HeadingRetrieved: "获取日期";
    HeadingRevision: "修订号";
    HeadingRevoked: "吊销数量";
    HeadingSerial: "序列号";
    HeadingStartup: "启动模式";
    HeadingStatus: "状态";
    HeadingThumbprint: "指纹";
    HeadingTokens: "用户令牌";
    HeadingTrusted: "信任";
    HeadingType: "控制器类型";
    HeadingUsers: "用户";
    HeadingUserToken: "用户令牌";
    HeadingVersion: "版本";
    HeadingWarnings: "警告";
    HeadingWhat: "内容";

    // words and sentences
    CliAddUnconfirmed: "如需现在添加并在以后确认其身份，请使用 --unconfirmed。";
    CliVaultKeeps: "密码库未打开，其中的密码保留：可用 vault status 查看，用 vault forget 删除。";
    CliStopping: "当前步骤完成后中止；再次按 Ctrl-C 将不等待其完成…";
    CliGoOn: "是否继续？[y/N]";
    CliClientsMayComplain: "客户端可能对以上各项发出警告";
    CliFirmwareCurrent: "固件 8.0.0 及以上版本的控制器";
    CliFirmwareLegacy: "固件低于 8.0.0 的控制器";
    CliError: "错误";
    CliWarning: "警告";
    CliCertificateAccepted: "客户端可接受服务器证书";
    CliWindowBroughtToFront: "该工作区已打开，已将其窗口置于最前。";
    CliAskCaPassphrase: "CA 的口令";
    CliAskVaultPassphrase: "密码库口令";
    CliAskNewVaultPassphrase: "密码库的新口令";
    CliAskAgain: "请再次输入";
    CliAskLogPassword: "服务器日志的密码（手册中为 199532）";
    CliProgramError: "程序因内部错误而结束";
}

pub fn added(name: impl Display, what: impl Display) -> String {
    format!("已添加 {name}：{what}")
}

pub fn added_unconfirmed(name: impl Display, address: impl Display) -> String {
    format!("已添加 {name}：{address}；请使用 controllers trust 确认其身份")
}

pub fn trusted(name: impl Display, what: impl Display) -> String {
    format!("已确认 {name}：{what}")
}

pub fn removed(name: impl Display) -> String {
    format!("已删除 {name}")
}

pub fn left_out(name: impl Display, line: impl Display, why: impl Display) -> String {
    format!("未导入 {name}，第 {line} 行：{why}")
}

pub fn other_series(name: impl Display, what: impl Display) -> String {
    format!("{name}：控制器报告其为 {what}")
}

pub fn backup(on: bool, folder: impl Display) -> String {
    format!("备份已{}；文件夹 {folder}", if on { "打开" } else { "关闭" })
}

pub fn revoked(serials: &[String]) -> String {
    format!("已吊销：{}\n请将新的 CRL 发送到每台控制器：ca crl --push", serials.join("、"))
}

pub fn starting_virtual(count: usize) -> String {
    format!("正在启动 {count} 台虚拟控制器…")
}

pub fn changes(names: &[&str]) -> String {
    format!("将更改 {}：", names.join("、"))
}

pub fn authority(issued_to: &str) -> String {
    format!("机构 {issued_to}")
}

pub fn application(issued_to: &str) -> String {
    format!("应用程序 {issued_to}")
}

pub fn crl_of(issuer: &str) -> String {
    format!("{issuer} 的 CRL")
}

pub fn over_plan(controllers: TextKey, plan: &str) -> String {
    format!("{}：\n{plan}", controllers.text(LANGUAGE))
}

pub fn own_certificate(file: &str) -> String {
    format!("本配置工具的证书为 {file}；使用 --trust-me 可将其添加到[信任]")
}

pub fn crl_line(id: &str, issuer: &str, revoked: usize, until: Option<String>, states: &[TextKey]) -> String {
    let states: String = states.iter().map(|state| format!("，{}", state.text(LANGUAGE))).collect();
    format!("{id} {issuer}：已吊销 {revoked} 个，下次更新 {}{states}", until.as_deref().unwrap_or("—"))
}

pub fn certificate_line(thumbprint: &str, issued_to: &str, until: &str) -> String {
    format!("{thumbprint} {issued_to}，有效期至 {until}")
}

pub fn refused_line(thumbprint: &str, issued_to: &str, why: &str, times: &str) -> String {
    format!("{thumbprint} {issued_to}：{why}{times}")
}

pub fn in_list(list: TextKey, entry: &str) -> String {
    format!("{}：{entry}", list.text(LANGUAGE))
}

pub fn log_read(name: &str, read: u64, size: u64) -> String {
    format!("{name}：日志共 {size} 字节，已读取 {read} 字节")
}

pub fn vault_created(path: &str, passwords: usize) -> String {
    format!("已创建 {path}，从密钥环接管的密码：{passwords} 个")
}

pub fn vault_missing(path: &str) -> String {
    format!("{path} 处没有密码库")
}

pub fn vault_used(path: &str) -> String {
    format!("正在使用密码库 {path}")
}

pub fn vault_used_without_keyring(path: &str) -> String {
    format!("没有密钥环时使用密码库 {path}；请见 vault on")
}

pub fn vault_passwords(count: usize) -> String {
    format!("密码：{count} 个")
}

pub fn vault_imported(count: usize) -> String {
    format!("已放入密码库的密码：{count} 个")
}

pub fn vault_forgot(name: &str) -> String {
    format!("已从密码库中删除 {name} 的密码")
}

pub fn vault_has_none(name: &str) -> String {
    format!("密码库中没有 {name} 的密码")
}

pub fn value_known(known: &[&str]) -> String {
    format!("可用的值为 {}", known.join("、"))
}

pub fn value_on_or_off() -> String {
    "只能为 on 或 off".to_owned()
}

pub fn value_time() -> String {
    "不是 RFC 3339 格式的时间，例如 2026-01-31T12:00:00Z".to_owned()
}

pub fn keys_of_one() -> String {
    "多台控制器请使用 --file".to_owned()
}

pub fn common_name_of_one() -> String {
    "通用名称只能用于一台控制器".to_owned()
}

pub fn push_to_none() -> String {
    "--push 需要控制器名称或 --all".to_owned()
}

pub fn same_name_in_out() -> String {
    "两个证书在 --out 中的文件名相同".to_owned()
}

pub fn digits_needed(text: &str) -> String {
    format!("{text}：需要 40 位十六进制数字")
}

pub fn entries_differ() -> String {
    "两次输入不一致".to_owned()
}

pub fn vault_passphrase_option() -> String {
    "请用 --vault-passphrase-file 指定文件".to_owned()
}

pub fn certificate_among_lists(subject: &str) -> String {
    format!("--crls：吊销列表中有证书 {subject}")
}

pub fn only_certificates() -> String {
    "其中只有证书，没有吊销列表".to_owned()
}

pub fn no_controller_after(argument: &str) -> String {
    format!("“{argument}”之后没有控制器名称，请给出名称或 --all")
}

pub fn no_value_after(argument: &str) -> String {
    format!("“{argument}”之后没有值")
}

pub fn no_controllers() -> String {
    "控制器列表为空".to_owned()
}

pub fn too_many_files(folder: impl Display, most: usize) -> String {
    format!("{folder}：文件超过 {most} 个，或文件夹层数过多")
}
