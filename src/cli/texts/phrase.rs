use crate::model::{CertificateType, Language, ServerStatus};

/// A word or heading in every language.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Phrase {
    en: &'static str,
    zh: &'static str,
}

impl Phrase {
    pub const fn text(self, language: Language) -> &'static str {
        match language {
            Language::En => self.en,
            Language::Zh => self.zh,
        }
    }
}

/// One cell of a table: a value as it is, or a word in the reader's language.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Cell {
    Value(String),
    Word(Phrase),
    /// A word, then a value.
    Both(Phrase, String),
}

impl Cell {
    /// The same with this behind it.
    pub fn followed_by(self, value: String) -> Self {
        match self {
            Self::Value(text) => Self::Value(text + &value),
            Self::Word(phrase) => Self::Both(phrase, value),
            Self::Both(phrase, text) => Self::Both(phrase, text + &value),
        }
    }

    pub fn text(&self, language: Language) -> String {
        match self {
            Self::Value(value) => value.clone(),
            Self::Word(phrase) => phrase.text(language).to_owned(),
            Self::Both(phrase, value) => format!("{}{value}", phrase.text(language)),
        }
    }
}

impl From<String> for Cell {
    fn from(value: String) -> Self {
        Self::Value(value)
    }
}

impl From<Phrase> for Cell {
    fn from(phrase: Phrase) -> Self {
        Self::Word(phrase)
    }
}

impl From<ServerStatus> for Cell {
    fn from(status: ServerStatus) -> Self {
        Self::Word(match status {
            ServerStatus::Run => phrases::RUN,
            ServerStatus::Stop => phrases::STOP,
            ServerStatus::Error => phrases::ERROR,
        })
    }
}

impl From<CertificateType> for Cell {
    fn from(kind: CertificateType) -> Self {
        Self::Word(match kind {
            CertificateType::SelfSigned => phrases::SELF_SIGNED,
            CertificateType::UserSpecified => phrases::USER_SPECIFIED,
            CertificateType::CaSigned => phrases::CA_SIGNED,
        })
    }
}

/// Yes or no.
impl From<bool> for Cell {
    fn from(yes: bool) -> Self {
        Self::Word(if yes { phrases::YES } else { phrases::NO })
    }
}

macro_rules! phrases {
    ($($name:ident: $en:literal, $zh:literal;)*) => {
        /// Headings of tables in capitals, words in cells as in the window.
        pub mod phrases {
            use super::Phrase;
            $(pub const $name: Phrase = Phrase { en: $en, zh: $zh };)*
        }
    };
}

phrases! {
    ACTIVATED: "ACTIVATED", "激活";
    ADDRESS: "ADDRESS", "IP 地址";
    BITS: "BITS", "密钥位数";
    CA: "CA", "CA";
    CERTIFICATE: "CERTIFICATE", "认证类型";
    CERTIFICATES: "CERTIFICATES", "证书";
    COMMON_NAME: "COMMON NAME", "通用名";
    CONTROLLER: "CONTROLLER", "控制器";
    CRLS: "CRLS", "CRL";
    CRL_NUMBER: "CRL NUMBER", "CRL 编号";
    DISCONNECTED: "DISCONNECTED", "已断开";
    ENDPOINT: "ENDPOINT", "端点";
    EXPIRY: "EXPIRY", "有效期";
    FILE: "FILE", "文件";
    FIRMWARE: "FIRMWARE", "固件版本";
    GOES_TO: "GOES TO", "添加到";
    IDENTITY: "IDENTITY", "身份";
    ISSUED_BY: "ISSUED BY", "颁发者";
    ISSUED_TO: "ISSUED TO", "颁发给";
    ISSUERS: "ISSUERS", "发行人";
    LICENCE: "LICENCE", "许可证";
    LOG: "LOG", "服务器日志";
    NAME: "NAME", "名称";
    NEXT_CRL_BY: "NEXT CRL BY", "下次更新";
    NOTE: "NOTE", "备注";
    POLICIES: "POLICIES", "安全策略";
    PORT: "PORT", "端口";
    PROFILE: "PROFILE", "用途";
    REJECTED: "REJECTED", "拒绝";
    RESULT: "RESULT", "结果";
    RETRIEVED: "RETRIEVED", "获取日期";
    REVISION: "REVISION", "修订号";
    REVOKED: "REVOKED", "吊销数量";
    SERIAL: "SERIAL", "序列号";
    STARTUP: "STARTUP", "启动模式";
    STATUS: "STATUS", "状态";
    THUMBPRINT: "THUMBPRINT", "指纹";
    TOKENS: "TOKENS", "用户令牌";
    TRUSTED: "TRUSTED", "信任";
    TYPE: "TYPE", "控制器类型";
    USERS: "USERS", "用户";
    USER_TOKEN: "USER TOKEN", "用户令牌";
    VERSION: "VERSION", "版本";
    WARNINGS: "WARNINGS", "警告";
    WHAT: "WHAT", "内容";

    CA_SIGNED: "CA signed", "CA 签名";
    CONFIRMED: "Confirmed", "已确认";
    ERROR: "Error", "错误";
    NO: "No", "否";
    NOT_CONFIRMED: "Not confirmed", "未确认";
    OFF: "Off", "关";
    ON: "On", "开";
    RUN: "Run", "运行";
    SELF_SIGNED: "Self-signed", "自签名";
    STOP: "Stop", "停止";
    USER_SPECIFIED: "User specified", "用户指定";
    YES: "Yes", "是";
}
