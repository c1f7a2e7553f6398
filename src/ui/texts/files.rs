//! What is wrong with the lines of a file.

use crate::model::Language;
use crate::model::activation::{KeyError, LineMistake, Mistake};

pub fn line(language: Language, line: impl std::fmt::Display) -> String {
    match language {
        Language::En => format!("Line {line}"),
        Language::Zh => format!("第 {line} 行"),
    }
}

pub fn key_error(language: Language, error: KeyError) -> String {
    match (language, error) {
        (Language::En, KeyError::Character(c)) => format!("{c:?} is neither a half-width letter nor a digit"),
        (Language::Zh, KeyError::Character(c)) => format!("“{c}”不是半角字母或数字"),
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
            Mistake::Serial => "序列号无效：应为 1 至 32 个字母、数字、“-”或“_”".to_owned(),
            Mistake::Licence(error) => format!("许可密钥：{}", key_error(language, *error)),
            Mistake::Activation(error) => format!("激活密钥：{}", key_error(language, *error)),
            Mistake::Duplicate(line) => format!("序列号与第 {line} 行重复"),
        },
    };
    let colon = if language == Language::En { ": " } else { "：" };
    format!("{}{colon}{what}", line(language, mistake.line))
}
