//! What came of connecting to a server as a client, in Chinese.

use super::LANGUAGE;
use crate::jobs::{ConnectRefusal, NotTried, RefusalDetails, VerifyCounts, VerifyFinding};
use crate::model::CertificateStatus;
use crate::session::opcua_client::TokenKind;
use crate::texts::without_stop;

fixed_texts! {
    Verify: "验证";
    VerifyTip: "以客户端方式尝试 OPC UA 服务器提供的每种连接";
    VerifyTitle: "验证";
    VerifyWorks: "所有尝试均正常";
    VerifyFails: "并非全部正常";
    VerifyEndpoint: "端点";
    VerdictWorks: "正常";
    VerdictFails: "失败";
    VerdictNotTried: "未尝试";
    VerifyCertificate: "服务器证书";
    VerifyAccepted: "客户端可接受";
    VerifyRefused: "客户端将拒绝";
    VerifyAgain: "重新验证";
    VerifyTrust: "信任本配置工具…";
    VerifyTrustText: "服务器仅允许证书在[信任]列表中的客户端连接。本配置工具的证书不在其中，可立即添加，或以后使用此文件夹中的文件添加。";
    VerifyLogin: "如需尝试登录，请输入控制器的用户。密码仅以加密方式发送，被拒绝后不会再次发送。";
    TrustConfiguratorTitle: "信任本配置工具";
    ConfirmTrustConfigurator: "将把本配置工具的证书添加到[信任]并保留：使用控制器的用户，或在允许匿名时，可与其他客户端一样连接。";
    VerifyAfterChanges: "更改之后";
    VerifyAfterChangesOn: "服务器重新启动后进行验证";
}

pub fn refusal(refusal: &ConnectRefusal) -> String {
    match refusal {
        ConnectRefusal::NotReachable(why) => format!("该地址无应答（{why}），请检查端口、防火墙和网线"),
        ConnectRefusal::TimedOut => "未在规定时间内应答，请检查网络或重新启动服务器".to_owned(),
        ConnectRefusal::NotOpcUa(why) => format!("应答方不是正常的 OPC UA 服务器：{why}"),
        ConnectRefusal::Closed => {
            "服务器未说明原因即断开连接，请查看服务器日志；多次拒绝后一分钟内不再说明原因".to_owned()
        }
        ConnectRefusal::OwnCertificate(None) => {
            "服务器拒绝本配置工具的证书且未说明原因，通常是尚未信任该证书".to_owned()
        }
        ConnectRefusal::OwnCertificate(Some(RefusalDetails { status: CertificateStatus::Untrusted, .. })) => {
            "服务器尚未信任本配置工具的证书，请将其添加到[信任]后重新验证".to_owned()
        }
        ConnectRefusal::OwnCertificate(Some(told)) => {
            let said = told.explain(LANGUAGE);
            format!("服务器拒绝本配置工具的证书 ({})：{}", told.status, without_stop(&said))
        }
        ConnectRefusal::OtherCertificate => "服务器应答中的证书与端点的证书不同，未发送密码".to_owned(),
        ConnectRefusal::Password => "用户名或密码错误，或该用户被锁定一分钟".to_owned(),
        ConnectRefusal::Anonymous => "虽然提供匿名登录，但拒绝匿名用户".to_owned(),
        ConnectRefusal::Busy(name) => format!("服务器无法接受更多客户端 ({name})，请关闭部分客户端后重新验证"),
        ConnectRefusal::State(state) => format!("客户端可以连接，但服务器状态为 {state}，而不是运行"),
        ConnectRefusal::Status { name, reason } if reason.is_empty() => format!("服务器拒绝：{name}"),
        ConnectRefusal::Status { name, reason } => format!("服务器拒绝：{name}，{reason}"),
    }
}

pub const fn not_tried(why: NotTried) -> &'static str {
    match why {
        NotTried::NoPassword => "未尝试：请输入用户名和密码",
        NotTried::PasswordRefused => "未尝试：该密码已被拒绝，继续尝试将锁定该用户",
        NotTried::PasswordInTheClear => "未尝试：服务器要求以未加密方式发送密码",
        NotTried::OtherToken => "未尝试：仅可尝试用户名和密码",
        NotTried::UnknownSecurity => "未尝试：无法识别该安全策略或模式",
        NotTried::OtherCertificate => "未尝试：服务器出示的证书不是控制器中所选的证书",
        NotTried::Chain => "未尝试：服务器发送证书链，目前不支持",
    }
}

pub fn verify_finding(finding: &VerifyFinding) -> String {
    match finding {
        VerifyFinding::NotRunning { error: Some(code), .. } => {
            format!("服务器未运行：{}", code.explain(LANGUAGE).message)
        }
        VerifyFinding::NotRunning { error: None, .. } => "服务器未运行，请启动后重新验证".to_owned(),
        VerifyFinding::NoAnswer(why) => refusal(why),
        VerifyFinding::NoEndpoints => "服务器未提供任何端点".to_owned(),
        VerifyFinding::PolicyMissing(policy) => format!("基本设置中已勾选 {policy}，但服务器未提供，请重新启动服务器"),
        VerifyFinding::PolicyNotTicked(policy) => {
            format!("服务器提供 {policy}，但基本设置中未勾选，请重新启动服务器")
        }
        VerifyFinding::TokenMissing(token) => {
            format!("基本设置中已勾选“{}”，但服务器未提供，请重新启动服务器", TokenKind::from(*token).text(LANGUAGE))
        }
        VerifyFinding::TokenNotTicked(token) => {
            format!("服务器提供“{}”，但基本设置中未勾选，请重新启动服务器", TokenKind::from(*token).text(LANGUAGE))
        }
        VerifyFinding::OtherAddress { url, reachable: true } => {
            format!("服务器公布的地址为 {url}，客户端须能识别该名称")
        }
        VerifyFinding::OtherAddress { url, reachable: false } => {
            format!("服务器公布的地址为 {url}，本机无法连接，使用该地址的客户端将失败")
        }
        VerifyFinding::WeakPolicy(policy) if policy.as_str() == "None" => {
            "提供 None：通信内容可被他人读取和篡改".to_owned()
        }
        VerifyFinding::WeakPolicy(policy) => format!("提供已弃用的 {policy}，可被破解"),
        VerifyFinding::NoUsers => "仅允许用户名和密码登录，但控制器尚无用户，请添加用户".to_owned(),
        VerifyFinding::Clock(ahead) => format!(
            "控制器时钟{} {}，请校准，否则证书可能被拒绝",
            if *ahead < chrono::TimeDelta::zero() { "慢" } else { "快" },
            span(ahead.num_minutes().unsigned_abs())
        ),
    }
}

fn span(minutes: u64) -> String {
    match minutes {
        0..120 => format!("{minutes} 分钟"),
        120..2880 => format!("{} 小时", minutes / 60),
        _ => format!("{} 天", minutes / 1440),
    }
}

pub const fn token_kind(kind: TokenKind) -> &'static str {
    match kind {
        TokenKind::Anonymous => "匿名",
        TokenKind::UserName => "用户名和密码",
        TokenKind::Certificate => "用户证书",
        TokenKind::Issued => "颁发的令牌",
    }
}

pub fn verify_counts(counts: VerifyCounts) -> String {
    let VerifyCounts { work, fail, not_tried } = counts;
    format!("{work} 个正常，{fail} 个失败，{not_tried} 个未尝试")
}

pub fn endpoints_named(names: &[String]) -> String {
    match names {
        names if names.len() > MOST => format!("{} 个端点", names.len()),
        names => names.join("、"),
    }
}

const MOST: usize = 4;
