//! What a person reads about a report, in English and Chinese.

use super::report::{NotTried, Refusal, Told, Verdict, VerifyFinding};
use crate::model::{CertificateStatus, Language, UserTokenPolicy};
use crate::pki::explain_refusal;
use crate::session::opcua_client::TokenKind;

impl Verdict {
    /// One sentence: what works, or why not and what helps.
    pub fn explain(&self, language: Language) -> String {
        match self {
            Self::Works => match language {
                Language::En => "Works".to_owned(),
                Language::Zh => "正常".to_owned(),
            },
            Self::Fails(refusal) => refusal.explain(language),
            Self::NotTried(why) => why.explain(language).to_owned(),
        }
    }
}

impl Refusal {
    pub fn explain(&self, language: Language) -> String {
        match language {
            Language::En => self.english(),
            Language::Zh => self.chinese(),
        }
    }

    fn english(&self) -> String {
        match self {
            Self::NotReachable(why) => {
                format!("Nothing answers there ({why}); check the port, the firewall and the cable")
            }
            Self::TimedOut => "There is no answer in time; check the network, or start the server again".to_owned(),
            Self::NotOpcUa(why) => format!("What answers is not a sound OPC UA server: {why}"),
            Self::Closed => "The server closes the connection without a word; its log may say why, and after many \
                             refusals it says nothing for a minute"
                .to_owned(),
            Self::OwnCertificate(None) => "The server refuses the certificate of this configurator and does not say \
                                           why; most often it is not trusted yet"
                .to_owned(),
            Self::OwnCertificate(Some(Told { status: CertificateStatus::Untrusted, .. })) => {
                "The server does not trust the certificate of this configurator; add it to Trusted and verify again"
                    .to_owned()
            }
            Self::OwnCertificate(Some(told)) => format!(
                "The server refuses the certificate of this configurator ({}): {}",
                told.status,
                without_stop(&told.explain(Language::En))
            ),
            Self::OtherCertificate => {
                "The server answers with another certificate than the one of the endpoint; no password was sent"
                    .to_owned()
            }
            Self::Password => "User name or password is wrong, or the user is locked out for a minute".to_owned(),
            Self::Anonymous => "Nobody is let in without a user name, although it is offered".to_owned(),
            Self::Busy(name) => {
                format!("The server has no room for another client ({name}); close some, then verify again")
            }
            Self::State(state) => {
                format!("A client gets in, but the server says it is in state {state} instead of Running")
            }
            Self::Status { name, reason } if reason.is_empty() => format!("The server refuses it: {name}"),
            Self::Status { name, reason } => format!("The server refuses it: {name}, {reason}"),
        }
    }

    fn chinese(&self) -> String {
        match self {
            Self::NotReachable(why) => format!("该地址无应答（{why}），请检查端口、防火墙和网线"),
            Self::TimedOut => "未在规定时间内应答，请检查网络或重新启动服务器".to_owned(),
            Self::NotOpcUa(why) => format!("应答方不是正常的 OPC UA 服务器：{why}"),
            Self::Closed => "服务器未说明原因即断开连接，请查看服务器日志；多次拒绝后一分钟内不再说明原因".to_owned(),
            Self::OwnCertificate(None) => "服务器拒绝本配置工具的证书且未说明原因，通常是尚未信任该证书".to_owned(),
            Self::OwnCertificate(Some(Told { status: CertificateStatus::Untrusted, .. })) => {
                "服务器尚未信任本配置工具的证书，请将其添加到[信任]后重新验证".to_owned()
            }
            Self::OwnCertificate(Some(told)) => {
                let said = told.explain(Language::Zh);
                format!("服务器拒绝本配置工具的证书 ({})：{}", told.status, without_stop(&said))
            }
            Self::OtherCertificate => "服务器应答中的证书与端点的证书不同，未发送密码".to_owned(),
            Self::Password => "用户名或密码错误，或该用户被锁定一分钟".to_owned(),
            Self::Anonymous => "虽然提供匿名登录，但拒绝匿名用户".to_owned(),
            Self::Busy(name) => format!("服务器无法接受更多客户端 ({name})，请关闭部分客户端后重新验证"),
            Self::State(state) => format!("客户端可以连接，但服务器状态为 {state}，而不是运行"),
            Self::Status { name, reason } if reason.is_empty() => format!("服务器拒绝：{name}"),
            Self::Status { name, reason } => format!("服务器拒绝：{name}，{reason}"),
        }
    }
}

impl Told {
    fn explain(&self, language: Language) -> String {
        explain_refusal(self.status, self.cause.as_ref(), language)
    }
}

/// A sentence that becomes part of another.
fn without_stop(sentence: &str) -> &str {
    sentence.trim_end_matches(['.', '。'])
}

impl NotTried {
    pub const fn explain(self, language: Language) -> &'static str {
        match language {
            Language::En => match self {
                Self::NoPassword => "Not tried: give a user name and a password to try it",
                Self::PasswordRefused => {
                    "Not tried: the password was refused before, and trying on would lock the user out"
                }
                Self::PasswordInTheClear => "Not tried: the server wants the password without encryption",
                Self::OtherToken => "Not tried: only user names and passwords can be tried",
                Self::UnknownSecurity => "Not tried: this security policy or mode is not known here",
                Self::OtherCertificate => {
                    "Not tried: the server does not show the certificate that is selected in the controller"
                }
                Self::Chain => "Not tried: the server sends a chain of certificates, which is not supported yet",
            },
            Language::Zh => match self {
                Self::NoPassword => "未尝试：请输入用户名和密码",
                Self::PasswordRefused => "未尝试：该密码已被拒绝，继续尝试将锁定该用户",
                Self::PasswordInTheClear => "未尝试：服务器要求以未加密方式发送密码",
                Self::OtherToken => "未尝试：仅可尝试用户名和密码",
                Self::UnknownSecurity => "未尝试：无法识别该安全策略或模式",
                Self::OtherCertificate => "未尝试：服务器出示的证书不是控制器中所选的证书",
                Self::Chain => "未尝试：服务器发送证书链，目前不支持",
            },
        }
    }
}

impl VerifyFinding {
    /// What it is, and what helps.
    pub fn explain(&self, language: Language) -> String {
        match language {
            Language::En => self.english(),
            Language::Zh => self.chinese(),
        }
    }

    fn english(&self) -> String {
        match self {
            Self::NotRunning { error: Some(code), .. } => {
                format!("The server does not run: {}", code.explain(Language::En).message)
            }
            Self::NotRunning { error: None, .. } => "The server does not run; start it, then verify again".to_owned(),
            Self::NoAnswer(refusal) => refusal.english(),
            Self::NoEndpoints => "The server offers no endpoint".to_owned(),
            Self::PolicyMissing(policy) => format!(
                "{policy} is ticked in the basic settings, but the server does not offer it; start the server again"
            ),
            Self::PolicyNotTicked(policy) => {
                format!("The server offers {policy}, which is not ticked in the basic settings; start the server again")
            }
            Self::TokenMissing(token) => format!(
                "\"{}\" is ticked in the basic settings, but the server does not offer it; start the server again",
                TokenKind::from(*token).text(Language::En)
            ),
            Self::TokenNotTicked(token) => format!(
                "The server offers \"{}\", which is not ticked in the basic settings; start the server again",
                TokenKind::from(*token).text(Language::En)
            ),
            Self::OtherAddress { url, reachable: true } => {
                format!("The server gives its address as {url}; clients must know it by that name")
            }
            Self::OtherAddress { url, reachable: false } => format!(
                "The server gives its address as {url}, which this computer does not reach; clients that follow it fail"
            ),
            Self::WeakPolicy(policy) if policy.as_str() == "None" => {
                "None is offered: whoever listens reads everything, and can change it".to_owned()
            }
            Self::WeakPolicy(policy) => format!("{policy} is offered, which is deprecated and can be broken"),
            Self::NoUsers => {
                "Only users with a password are let in, and the controller has none; add a user".to_owned()
            }
            Self::Clock(ahead) => format!(
                "The controller's clock is {} {}; set it, or certificates may be refused",
                span(ahead.num_minutes().unsigned_abs(), Language::En),
                if *ahead < chrono::TimeDelta::zero() { "behind" } else { "ahead" }
            ),
        }
    }

    fn chinese(&self) -> String {
        match self {
            Self::NotRunning { error: Some(code), .. } => {
                format!("服务器未运行：{}", code.explain(Language::Zh).message)
            }
            Self::NotRunning { error: None, .. } => "服务器未运行，请启动后重新验证".to_owned(),
            Self::NoAnswer(refusal) => refusal.chinese(),
            Self::NoEndpoints => "服务器未提供任何端点".to_owned(),
            Self::PolicyMissing(policy) => format!("基本设置中已勾选 {policy}，但服务器未提供，请重新启动服务器"),
            Self::PolicyNotTicked(policy) => {
                format!("服务器提供 {policy}，但基本设置中未勾选，请重新启动服务器")
            }
            Self::TokenMissing(token) => format!(
                "基本设置中已勾选“{}”，但服务器未提供，请重新启动服务器",
                TokenKind::from(*token).text(Language::Zh)
            ),
            Self::TokenNotTicked(token) => format!(
                "服务器提供“{}”，但基本设置中未勾选，请重新启动服务器",
                TokenKind::from(*token).text(Language::Zh)
            ),
            Self::OtherAddress { url, reachable: true } => {
                format!("服务器公布的地址为 {url}，客户端须能识别该名称")
            }
            Self::OtherAddress { url, reachable: false } => {
                format!("服务器公布的地址为 {url}，本机无法连接，使用该地址的客户端将失败")
            }
            Self::WeakPolicy(policy) if policy.as_str() == "None" => "提供 None：通信内容可被他人读取和篡改".to_owned(),
            Self::WeakPolicy(policy) => format!("提供已弃用的 {policy}，可被破解"),
            Self::NoUsers => "仅允许用户名和密码登录，但控制器尚无用户，请添加用户".to_owned(),
            Self::Clock(ahead) => format!(
                "控制器时钟{} {}，请校准，否则证书可能被拒绝",
                if *ahead < chrono::TimeDelta::zero() { "慢" } else { "快" },
                span(ahead.num_minutes().unsigned_abs(), Language::Zh)
            ),
        }
    }
}

fn span(minutes: u64, language: Language) -> String {
    let (count, en, zh) = match minutes {
        0..120 => (minutes, "minutes", "分钟"),
        120..2880 => (minutes / 60, "hours", "小时"),
        _ => (minutes / 1440, "days", "天"),
    };
    match language {
        Language::En => format!("{count} {en}"),
        Language::Zh => format!("{count} {zh}"),
    }
}

impl From<UserTokenPolicy> for TokenKind {
    fn from(policy: UserTokenPolicy) -> Self {
        match policy {
            UserTokenPolicy::Anonymous => Self::Anonymous,
            UserTokenPolicy::UserName => Self::UserName,
        }
    }
}

impl TokenKind {
    pub const fn text(self, language: Language) -> &'static str {
        match (language, self) {
            (Language::En, Self::Anonymous) => "Anonymous",
            (Language::En, Self::UserName) => "User name and password",
            (Language::En, Self::Certificate) => "User certificate",
            (Language::En, Self::Issued) => "Issued token",
            (Language::Zh, Self::Anonymous) => "匿名",
            (Language::Zh, Self::UserName) => "用户名和密码",
            (Language::Zh, Self::Certificate) => "用户证书",
            (Language::Zh, Self::Issued) => "颁发的令牌",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ErrorCode, SecurityPolicy, ServerStatus};
    use chrono::TimeDelta;

    fn told(status: CertificateStatus) -> Told {
        Told { status, cause: None, reason: "why".into() }
    }

    #[test]
    fn everything_is_said_in_both_languages() {
        let refusals = [
            Refusal::NotReachable("why".into()),
            Refusal::TimedOut,
            Refusal::NotOpcUa("why".into()),
            Refusal::Closed,
            Refusal::OwnCertificate(None),
            Refusal::OwnCertificate(Some(told(CertificateStatus::Untrusted))),
            Refusal::OwnCertificate(Some(told(CertificateStatus::Revoked))),
            Refusal::OtherCertificate,
            Refusal::Password,
            Refusal::Anonymous,
            Refusal::Busy("why".into()),
            Refusal::State(3),
            Refusal::Status { name: "Bad".into(), reason: String::new() },
            Refusal::Status { name: "Bad".into(), reason: "why".into() },
        ];
        let findings = [
            VerifyFinding::NotRunning { status: ServerStatus::Error, error: Some(ErrorCode::PortConflict) },
            VerifyFinding::NotRunning { status: ServerStatus::Stop, error: None },
            VerifyFinding::NoAnswer(Refusal::TimedOut),
            VerifyFinding::NoEndpoints,
            VerifyFinding::PolicyMissing(SecurityPolicy::Basic256),
            VerifyFinding::PolicyNotTicked(SecurityPolicy::Basic256),
            VerifyFinding::TokenMissing(UserTokenPolicy::Anonymous),
            VerifyFinding::TokenNotTicked(UserTokenPolicy::UserName),
            VerifyFinding::OtherAddress { url: "opc.tcp://x".into(), reachable: true },
            VerifyFinding::OtherAddress { url: "opc.tcp://x".into(), reachable: false },
            VerifyFinding::WeakPolicy(SecurityPolicy::None),
            VerifyFinding::WeakPolicy(SecurityPolicy::Basic256),
            VerifyFinding::NoUsers,
            VerifyFinding::Clock(TimeDelta::days(-400)),
        ];
        let not_tried = [
            NotTried::NoPassword,
            NotTried::PasswordRefused,
            NotTried::PasswordInTheClear,
            NotTried::OtherToken,
            NotTried::UnknownSecurity,
            NotTried::OtherCertificate,
            NotTried::Chain,
        ];
        let of = |language: Language| -> Vec<String> {
            let said = refusals.iter().map(|refusal| refusal.explain(language));
            let said = said.chain(findings.iter().map(|finding| finding.explain(language)));
            said.chain(not_tried.iter().map(|why| why.explain(language).to_owned())).collect()
        };
        for (en, zh) in of(Language::En).into_iter().zip(of(Language::Zh)) {
            assert!(en.is_ascii() && !en.ends_with('.') && en.len() > 10, "{en}");
            assert!(!zh.is_ascii() && !zh.ends_with('。'), "{zh}");
        }
    }

    #[test]
    fn a_clock_is_told_in_words_a_person_uses() {
        let said = |minutes| VerifyFinding::Clock(TimeDelta::minutes(minutes)).explain(Language::En);
        assert!(said(-30).contains("30 minutes behind"));
        assert!(said(180).contains("3 hours ahead"));
        assert!(said(60 * 24 * 400).contains("400 days ahead"));
    }
}
