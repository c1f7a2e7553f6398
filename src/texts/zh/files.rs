//! Sentences about files and their lines, in Chinese.

use std::path::Path;

use super::LANGUAGE;
use crate::model::AddressError;
use crate::model::activation::{ActivationMistake, KeyError, LineMistake};
use crate::texts::TextKey as T;
use crate::workspace::SkippedLine;

fixed_texts! {
    // choosing a file
    FileLabel: "文件";
    FileHint: "文件路径";
    FileRule: "请选择文件或输入其路径";
    ChooseFile: "选择…";
    ChooseFileTitle: "选择文件";
    ReadFile: "读取文件";
    Browse: "选择…";
    OpenFolder: "打开文件夹";

    // files dropped onto the window
    DropTitle: "拖放的文件";
    DropChoose: "用途";
    DropOpen: "打开";
    DropUnseen: "松开后显示文件类型";
    DropAsks: "有多种用途，松开后选择";
    DropNothing: "没有可用的文件";
    DropDialogOpen: "有对话框已打开：请先关闭对话框，然后重新拖放文件";
    DropTooMany: "文件过多：一次最多拖放 100 个";
    DropOneFile: "一次仅限一个文件，请只拖放一个";
    WhySplitKey: "文件同时包含证书和私钥：请分别保存为两个文件，或保存为一个 .pfx 文件";
    DropCrl: "证书吊销列表 (CRL)";
    DropAuthority: "证书颁发机构";
    KindActivation: "激活文件";
    KindConnectionList: "连接列表";
    KindSettingsExport: "设置导出文件";
    KindCertificate: "证书";
    KindChain: "多个证书 (PEM)";
    KindBundle: "证书或 CRL 集合 (PKCS#7 或 PEM)";
    KindCsr: "证书签名请求 (CSR)";
    KindKey: "私钥";
    KindKeyAndCertificate: "证书和私钥合一的 PEM 文件";
    KindPkcs12: "带加密密钥的证书 (PKCS#12)";
}

pub fn moved_aside(name: &str, file: &Path) -> String {
    format!("{name}：原有文件已移动到 {}", file.display())
}

pub fn line(line: impl std::fmt::Display) -> String {
    format!("第 {line} 行")
}

pub fn key_error(error: KeyError) -> String {
    match error {
        KeyError::Character(c) => format!("{c:?} 不是半角字母或数字"),
        KeyError::Length { found, expected } => format!("有 {found} 个字符，应为 {expected} 个"),
    }
}

pub fn key_progress(found: usize, expected: usize) -> String {
    format!("已输入 {found} / {expected} 个半角字母或数字")
}

pub fn keys_found(ready: usize, all: usize) -> String {
    format!("{all} 台控制器中有 {ready} 台找到密钥")
}

pub fn line_mistake(mistake: &LineMistake) -> String {
    let what = match &mistake.mistake {
        ActivationMistake::Fields(count) => format!("有 {count} 个字段，应为序列号、许可密钥和激活密钥 3 个"),
        ActivationMistake::Separator { found, expected } => {
            format!("分隔符为“{found}”，与前面各行的“{expected}”不一致")
        }
        ActivationMistake::Quotes => "引号未闭合，或字段中有换行".to_owned(),
        ActivationMistake::Serial => "序列号无效：应为 1 至 32 个字母、数字、“-”或“_”".to_owned(),
        ActivationMistake::Licence(error) => format!("许可密钥：{}", key_error(*error)),
        ActivationMistake::Activation(error) => format!("激活密钥：{}", key_error(*error)),
        ActivationMistake::Duplicate(line) => format!("序列号与第 {line} 行重复"),
    };
    format!("{}：{what}", line(mistake.line))
}

pub fn to_import(ticked: usize, all: usize) -> String {
    format!("导入 {ticked} / {all} 台控制器")
}

pub fn imported(count: usize) -> String {
    format!("已添加 {count} 台控制器，尚未确认")
}

pub fn skipped(why: &SkippedLine) -> String {
    match why {
        SkippedLine::Usb => "USB 连接，无法通过网络访问".to_owned(),
        SkippedLine::Virtual => "编程环境中的虚拟控制器".to_owned(),
        SkippedLine::NameRegistered => "名称已注册".to_owned(),
        SkippedLine::AddressRegistered(name) => format!("地址已注册（{name}）"),
        SkippedLine::Fields(count) => format!("有 {count} 个字段，应为名称、类型和地址 3 个"),
        SkippedLine::Type(kind) => format!("“{kind}”不是已知的连接类型（Ethernet、USB、Virtual）"),
        SkippedLine::Name(_) => format!("名称无效：{}", T::NameRule.text(LANGUAGE)),
        SkippedLine::Quotes => "引号未闭合，或字段中有换行".to_owned(),
        SkippedLine::Address(error) => format!("地址无效：{}", address_error(error)),
        SkippedLine::NameTwice(line) => format!("名称与第 {line} 行重复"),
        SkippedLine::AddressTwice(line) => format!("地址与第 {line} 行重复"),
    }
}

/// Why a text is not the address of a controller.
fn address_error(error: &AddressError) -> String {
    match error {
        AddressError::Scheme(scheme) => {
            format!("请去掉“{scheme}://”，输入管理协议的地址，可带端口")
        }
        AddressError::Path(path) => format!("请去掉“{path}”"),
        AddressError::LeadingZeros { found, meant } => {
            format!("“{found}”含有前导零，请输入 {meant}")
        }
        AddressError::Zone(zone) => format!("不支持区域“{zone}”，请输入不带区域的地址"),
        AddressError::NotAscii(_) => "含有非 ASCII 字符，请使用半角字符".to_owned(),
        _ => T::AddressRule.text(LANGUAGE).to_owned(),
    }
}

pub fn drop_title(count: usize) -> String {
    match count {
        1 => "将文件拖放到此处".to_owned(),
        _ => format!("将 {count} 个文件拖放到此处"),
    }
}

pub fn drop_opens(dialog: &str) -> String {
    format!("将打开：{dialog}")
}

pub fn drop_disabled(dialog: &str, why: &str) -> String {
    format!("{dialog}：{why}")
}

pub fn more(count: usize) -> String {
    format!("以及另外 {count} 个")
}

pub fn only_these(names: &[String]) -> String {
    let named = names.iter().take(3).map(String::as_str).collect::<Vec<_>>();
    let rest = if names.len() > 3 { format!(", {}", more(names.len() - 3)) } else { String::new() };
    format!("仅 {}{}", named.join("、"), rest.replace(", ", "，"))
}
