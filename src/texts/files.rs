//! What files are, and what is wrong with their lines.

use std::path::Path;

use super::TextKey as T;
use crate::model::activation::{KeyError, LineMistake, Mistake};
use crate::model::{AddressError, Language};
use crate::pki::PkiKind;
use crate::workspace::{Recognised, Skipped};

/// A file of a controller that had to make room for a new one.
pub fn moved_aside(language: Language, name: &str, file: &Path) -> String {
    match language {
        Language::En => format!("{name}: a former file was moved to {}", file.display()),
        Language::Zh => format!("{name}：原有文件已移动到 {}", file.display()),
    }
}

pub fn line(language: Language, line: impl std::fmt::Display) -> String {
    match language {
        Language::En => format!("Line {line}"),
        Language::Zh => format!("第 {line} 行"),
    }
}

pub fn key_error(language: Language, error: KeyError) -> String {
    match (language, error) {
        (Language::En, KeyError::Character(c)) => format!("{c:?} is neither a half-width letter nor a digit"),
        (Language::Zh, KeyError::Character(c)) => format!("{c:?} 不是半角字母或数字"),
        (Language::En, KeyError::Length { found, expected }) => {
            format!("{found} letters and digits; {expected} are required")
        }
        (Language::Zh, KeyError::Length { found, expected }) => format!("有 {found} 个字符，应为 {expected} 个"),
    }
}

/// Under a key that is being typed.
pub fn key_progress(language: Language, found: usize, expected: usize) -> String {
    match language {
        Language::En => format!("{found} of {expected} letters and digits"),
        Language::Zh => format!("已输入 {found} / {expected} 个半角字母或数字"),
    }
}

pub fn keys_found(language: Language, ready: usize, all: usize) -> String {
    match language {
        Language::En => format!("Keys found for {ready} of {}", super::controllers(language, all)),
        Language::Zh => format!("{all} 台控制器中有 {ready} 台找到密钥"),
    }
}

pub fn line_mistake(language: Language, mistake: &LineMistake) -> String {
    let what = match language {
        Language::En => match &mistake.mistake {
            Mistake::Licence(error) => format!("licence key: {}", key_error(language, *error)),
            Mistake::Activation(error) => format!("activation key: {}", key_error(language, *error)),
            other => other.to_string(),
        },
        Language::Zh => match &mistake.mistake {
            Mistake::Fields(count) => format!("有 {count} 个字段，应为序列号、许可密钥和激活密钥 3 个"),
            Mistake::Separator { found, expected } => {
                format!("分隔符为“{found}”，与前面各行的“{expected}”不一致")
            }
            Mistake::Quotes => "引号未闭合，或字段中有换行".to_owned(),
            Mistake::Serial => "序列号无效：应为 1 至 32 个字母、数字、“-”或“_”".to_owned(),
            Mistake::Licence(error) => format!("许可密钥：{}", key_error(language, *error)),
            Mistake::Activation(error) => format!("激活密钥：{}", key_error(language, *error)),
            Mistake::Duplicate(line) => format!("序列号与第 {line} 行重复"),
        },
    };
    let colon = if language == Language::En { ": " } else { "：" };
    format!("{}{colon}{what}", line(language, mistake.line))
}

/// The tick box over the lines that can be imported.
pub fn to_import(language: Language, ticked: usize, all: usize) -> String {
    match language {
        Language::En => format!("Import {ticked} of {}", super::controllers(language, all)),
        Language::Zh => format!("导入 {ticked} / {all} 台控制器"),
    }
}

pub fn imported(language: Language, count: usize) -> String {
    match language {
        Language::En => format!("{} added, not confirmed yet", super::controllers(language, count)),
        Language::Zh => format!("已添加 {count} 台控制器，尚未确认"),
    }
}

/// Why a line of a connection list is left out.
pub fn skipped(language: Language, why: &Skipped) -> String {
    match language {
        Language::En => why.to_string(),
        Language::Zh => match why {
            Skipped::Usb => "USB 连接，无法通过网络访问".to_owned(),
            Skipped::Virtual => "编程环境中的虚拟控制器".to_owned(),
            Skipped::NameRegistered => "名称已注册".to_owned(),
            Skipped::AddressRegistered(name) => format!("地址已注册（{name}）"),
            Skipped::Fields(count) => format!("有 {count} 个字段，应为名称、类型和地址 3 个"),
            Skipped::Type(kind) => format!("“{kind}”不是已知的连接类型（Ethernet、USB、Virtual）"),
            Skipped::Name(_) => format!("名称无效：{}", super::TextKey::NameRule.text(language)),
            Skipped::Quotes => "引号未闭合，或字段中有换行".to_owned(),
            Skipped::Address(error) => format!("地址无效：{}", address_error(language, error)),
            Skipped::NameTwice(line) => format!("名称与第 {line} 行重复"),
            Skipped::AddressTwice(line) => format!("地址与第 {line} 行重复"),
        },
    }
}

/// Why a text is not the address of a controller.
fn address_error(language: Language, error: &AddressError) -> String {
    match (language, error) {
        (Language::En, error) => error.to_string(),
        (Language::Zh, AddressError::Scheme(scheme)) => {
            format!("请去掉“{scheme}://”，输入管理协议的地址，可带端口")
        }
        (Language::Zh, AddressError::Path(path)) => format!("请去掉“{path}”"),
        (Language::Zh, AddressError::LeadingZeros { found, meant }) => {
            format!("“{found}”含有前导零，请输入 {meant}")
        }
        (Language::Zh, AddressError::Zone(zone)) => format!("不支持区域“{zone}”，请输入不带区域的地址"),
        (Language::Zh, AddressError::NotAscii(_)) => "含有非 ASCII 字符，请使用半角字符".to_owned(),
        (Language::Zh, _) => super::TextKey::AddressRule.text(language).to_owned(),
    }
}

/// What a file is, by its content.
pub const fn recognised(kind: Recognised) -> T {
    match kind {
        Recognised::Activation => T::KindActivation,
        Recognised::ConnectionList => T::KindConnectionList,
        Recognised::SettingsExport => T::KindSettingsExport,
        Recognised::Pki(PkiKind::Certificate) => T::KindCertificate,
        Recognised::Pki(PkiKind::Chain) => T::KindChain,
        Recognised::Pki(PkiKind::Bundle) => T::KindBundle,
        Recognised::Pki(PkiKind::Crl) => T::DropCrl,
        Recognised::Pki(PkiKind::Csr) => T::KindCsr,
        Recognised::Pki(PkiKind::Key) => T::KindKey,
        Recognised::Pki(PkiKind::KeyAndCertificate) => T::KindKeyAndCertificate,
        Recognised::Pki(PkiKind::Pkcs12) => T::KindPkcs12,
    }
}

/// Over files that are held over the window.
pub fn drop_title(language: Language, count: usize) -> String {
    match (language, count) {
        (Language::En, 1) => "Drop the file here".to_owned(),
        (Language::En, _) => format!("Drop {count} files here"),
        (Language::Zh, 1) => "将文件拖放到此处".to_owned(),
        (Language::Zh, _) => format!("将 {count} 个文件拖放到此处"),
    }
}

pub fn drop_opens(language: Language, dialog: &str) -> String {
    match language {
        Language::En => format!("Opens: {dialog}"),
        Language::Zh => format!("将打开：{dialog}"),
    }
}

/// Where a file would go, and why it cannot.
pub fn drop_disabled(language: Language, dialog: &str, why: &str) -> String {
    match language {
        Language::En => format!("{dialog}: {why}"),
        Language::Zh => format!("{dialog}：{why}"),
    }
}

pub fn more(language: Language, count: usize) -> String {
    match language {
        Language::En => format!("and {count} more"),
        Language::Zh => format!("以及另外 {count} 个"),
    }
}

/// Which of several files a dialog takes.
pub fn only_these(language: Language, names: &[String]) -> String {
    let named = names.iter().take(3).map(String::as_str).collect::<Vec<_>>();
    let rest = if names.len() > 3 { format!(", {}", more(language, names.len() - 3)) } else { String::new() };
    match language {
        Language::En => format!("Only {}{rest}", named.join(", ")),
        Language::Zh => format!("仅 {}{}", named.join("、"), rest.replace(", ", "，")),
    }
}
