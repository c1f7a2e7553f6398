use std::fmt::Display;

use crate::model::{FirmwareGeneration, Language, Problem};

/// Picks the text of the language.
fn either(language: Language, en: impl Into<String>, zh: impl Into<String>) -> String {
    match language {
        Language::En => en.into(),
        Language::Zh => zh.into(),
    }
}

pub fn added(language: Language, name: impl Display, what: impl Display) -> String {
    either(language, format!("Added {name}: {what}"), format!("已添加 {name}：{what}"))
}

pub fn added_unconfirmed(language: Language, name: impl Display, address: impl Display) -> String {
    either(
        language,
        format!("Added {name}: {address}; confirm its identity with \"controllers trust\""),
        format!("已添加 {name}：{address}；请使用 controllers trust 确认其身份"),
    )
}

/// After a controller that could not be reached.
pub fn add_unconfirmed(language: Language) -> &'static str {
    match language {
        Language::En => "    To add it now and confirm its identity later, use --unconfirmed.",
        Language::Zh => "    如需现在添加并在以后确认其身份，请使用 --unconfirmed。",
    }
}

pub fn vault_keeps(language: Language) -> &'static str {
    match language {
        Language::En => {
            "The vault is not open: passwords in it stay; \"vault status\" lists them, \"vault forget\" deletes them."
        }
        Language::Zh => "密码库未打开，其中的密码保留：可用 vault status 查看，用 vault forget 删除。",
    }
}

pub fn trusted(language: Language, name: impl Display, what: impl Display) -> String {
    either(language, format!("Trusted {name}: {what}"), format!("已确认 {name}：{what}"))
}

pub fn removed(language: Language, name: impl Display) -> String {
    either(language, format!("Removed {name}"), format!("已删除 {name}"))
}

pub fn left_out(language: Language, name: impl Display, line: impl Display, why: impl Display) -> String {
    either(language, format!("Left out {name}, line {line}: {why}"), format!("未导入 {name}，第 {line} 行：{why}"))
}

pub fn other_series(language: Language, name: impl Display, what: impl Display) -> String {
    either(language, format!("{name}: the controller says that it is {what}"), format!("{name}：控制器报告其为 {what}"))
}

pub fn backup(language: Language, on: bool, folder: impl Display) -> String {
    either(
        language,
        format!("Backup is {}; folder {folder}", if on { "on" } else { "off" }),
        format!("备份已{}；文件夹 {folder}", if on { "打开" } else { "关闭" }),
    )
}

pub fn revoked(language: Language, serials: &[String]) -> String {
    either(
        language,
        format!("Revoked: {}\nGive the new CRL to every controller: ca crl --push", serials.join(", ")),
        format!("已吊销：{}\n请将新的 CRL 发送到每台控制器：ca crl --push", serials.join("、")),
    )
}

pub fn starting_virtual(language: Language, count: usize) -> String {
    either(language, format!("Starting {count} virtual controllers…"), format!("正在启动 {count} 台虚拟控制器…"))
}

/// After the first Ctrl-C.
pub fn stopping(language: Language) -> &'static str {
    match language {
        Language::En => "Stopping after the step in hand; press Ctrl-C again to leave it unfinished…",
        Language::Zh => "当前步骤完成后中止；再次按 Ctrl-C 将不等待其完成…",
    }
}

pub fn go_on(language: Language) -> &'static str {
    match language {
        Language::En => "Go on? [y/N] ",
        Language::Zh => "是否继续？[y/N] ",
    }
}

pub fn changes(language: Language, names: &[&str]) -> String {
    either(language, format!("This changes {}:", names.join(", ")), format!("将更改 {}：", names.join("、")))
}

pub fn clients_may_complain(language: Language) -> &'static str {
    match language {
        Language::En => "clients may complain about what is listed above",
        Language::Zh => "客户端可能对以上各项发出警告",
    }
}

pub fn controllers_with(language: Language, generation: FirmwareGeneration) -> &'static str {
    match (generation, language) {
        (FirmwareGeneration::Current, Language::En) => "Controllers with firmware 8.0.0 and later:",
        (FirmwareGeneration::Current, Language::Zh) => "固件 8.0.0 及以上版本的控制器：",
        (FirmwareGeneration::Legacy, Language::En) => "Controllers with firmware below 8.0.0:",
        (FirmwareGeneration::Legacy, Language::Zh) => "固件低于 8.0.0 的控制器：",
    }
}

pub fn authority(language: Language, issued_to: &str) -> String {
    either(language, format!("authority {issued_to}"), format!("机构 {issued_to}"))
}

pub fn application(language: Language, issued_to: &str) -> String {
    either(language, format!("application {issued_to}"), format!("应用程序 {issued_to}"))
}

pub fn crl_of(language: Language, issuer: &str) -> String {
    either(language, format!("CRL of {issuer}"), format!("{issuer} 的 CRL"))
}

/// Message and detail in one line.
pub fn problem(language: Language, problem: &Problem) -> String {
    let message = problem.code.explain(language).message;
    match &problem.detail {
        Some(detail) => format!("{message} ({detail})"),
        None => message.to_owned(),
    }
}
