//! Sentences of the command line, in Chinese.

use std::fmt::Display;

use super::LANGUAGE;
use crate::texts::TextKey;

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
