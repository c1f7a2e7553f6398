//! What is wrong with certificates, in Chinese.

use super::{revocation_lists, signatures};
use crate::model::CertificateStatus as S;
use crate::pki::{CertificateFlaw as F, PeerRole};
use crate::texts::certificates::{date, usages};

pub fn flaw_reason(flaw: &F) -> String {
    match flaw {
        F::Unreadable { why } => format!("无法读取证书：{why}"),
        F::UnknownCriticalExtension { extension } => format!("证书的关键扩展 {extension} 不受支持"),
        F::RareCriticalExtension { extension } => {
            format!("证书的扩展 {extension} 为关键扩展，不支持该扩展的客户端会拒绝证书")
        }
        F::DamagedExtension { extension } => format!("证书的扩展 {extension} 已损坏"),
        F::NameNotAscii { name } => format!("证书中的名称 {name} 含有非 ASCII 字符 (RFC 5280 §4.2.1.6)"),
        F::EndsBeforeItBegins => "证书的有效期在开始之前结束".to_owned(),
        F::ChainTooLong { most } => format!("证书链超过 {most} 个证书"),
        F::TooManyIssuers => "与其签发者同名的 CA 过多，无法全部尝试".to_owned(),
        F::IssuerMissing { issuer } => format!("缺少其签发者 {issuer} 的证书"),
        F::IssuerKeyIdentifier { issuer, wanted } => {
            format!("其签发者 {issuer} 存在且签名正确，但其密钥标识符与证书中所写的 {wanted} 不同 (RFC 5280 §4.2.1.1)")
        }
        F::IssuerKey { issuer } => format!("存在名为 {issuer} 的 CA，但其密钥不是签发该证书的密钥"),
        F::SignatureWrong { issuer } => format!("签名不是其签发者 {issuer} 的签名"),
        F::SelfSignatureWrong => "证书以自身为签发者，但不是用自己的密钥签名".to_owned(),
        F::SignatureUnverifiable { because } => format!("无法验证签名：{}", signatures::unverifiable(because)),
        F::NameNotPermitted { name, authority } => {
            format!("其 CA {authority} 的名称约束不允许名称 {name} (RFC 5280 §4.2.1.10)")
        }
        F::NameConstraintUnsupported { name, authority } => {
            format!("无法检查其 CA {authority} 的名称约束是否允许名称 {name} (RFC 5280 §4.2.1.10)")
        }
        F::TooManyNames { authority } => format!("证书中的名称过多，无法与 {authority} 的名称约束比较"),
        F::PolicyMissing => "证书链中的 CA 要求证书策略，但没有策略适用于整个证书链 (RFC 5280 §6.1.5)".to_owned(),
        F::PolicyMappingOfAny => "证书映射了 anyPolicy 策略，RFC 5280 §4.2.1.5 不允许".to_owned(),
        F::KeyNotRsa => "密钥不是安全策略所需的 RSA 密钥".to_owned(),
        F::KeyExponent => "RSA 密钥的指数无效".to_owned(),
        F::KeyTooShort { bits, least: least @ 2048.. } if *bits >= 1024 => {
            format!("RSA 密钥为 {bits} 位，除已弃用的安全策略外至少需要 {least} 位")
        }
        F::KeyTooShort { bits, least } => format!("RSA 密钥为 {bits} 位，至少需要 {least} 位"),
        F::KeyTooLong { bits, most } => format!("RSA 密钥为 {bits} 位，最多允许 {most} 位"),
        F::KeyLengthNotTicked { bits } => format!("所选的安全策略不允许 {bits} 位密钥"),
        F::WeakHash { algorithm } => format!("证书使用强度不足的 {algorithm} 签名"),
        F::Untrusted => "证书及其签发者均不在信任列表中".to_owned(),
        F::NotYetValid { from, now } => format!("有效期从 {} 开始，时钟为 {}", date(from), date(now)),
        F::Expired { until, now } => format!("有效期至 {}，时钟为 {}", date(until), date(now)),
        F::ExpiresSoon { until } => format!("有效期仅至 {}", date(until)),
        F::HostName { hosts, names } if names.is_empty() => {
            format!("证书中没有地址或主机名，应用程序的连接地址为 {}", hosts.join("、"))
        }
        F::HostName { hosts, names } => {
            format!("证书不用于 {}，而用于 {}", hosts.join("、"), names.join("、"))
        }
        F::UriMissing { announced: None } => "证书中没有应用程序 URI".to_owned(),
        F::UriMissing { announced: Some(announced) } => {
            format!("证书中没有应用程序 URI，应用程序的 URI 为 {announced}")
        }
        F::UriDiffers { certificate, announced } => {
            format!("证书中的应用程序 URI 为 {certificate}，而应用程序的 URI 为 {announced}")
        }
        F::UriNotAscii { uri } => format!("应用程序 URI {uri} 含有非 ASCII 字符 (RFC 5280 §4.2.1.6)"),
        F::CertificateOfAuthority => "这是 CA 的证书，而不是应用程序的证书".to_owned(),
        F::ClaimsToBeAuthority => "这是应用程序的证书，却声明自己是 CA".to_owned(),
        F::KeyUsageMissing => "证书未说明密钥用法".to_owned(),
        F::KeyUsageLacks { missing } => format!("密钥用法缺少 {}", usages(missing).join("、")),
        F::NotForRole { role } => format!("扩展密钥用法不适用于{}", who(*role)),
        F::ExtendedKeyUsageMissing => "证书没有扩展密钥用法".to_owned(),
        F::NotAnAuthority => "该证书签发了证书，但不是 CA".to_owned(),
        F::MayNotIssue => "该证书签发了证书，但其密钥不能签发证书".to_owned(),
        F::MayNotIssueFor { role } => format!("该证书不能为{}签发证书", who(*role)),
        F::TooManyAuthoritiesBelow { most, found } => format!("其下最多允许 {most} 个 CA，实际有 {found} 个"),
        F::RevocationUnknown { authority, crl } => {
            format!("无法确定是否已吊销：{}", revocation_lists::reason(crl, authority))
        }
        F::Revoked { on, because } => format!("已于 {} 吊销 ({})", date(on), because.as_str()),
        F::NotThatOfTheChannel => "会话使用的证书与安全通道的证书不同".to_owned(),
    }
}

pub fn flaw_remedy(flaw: &F) -> String {
    match flaw {
        F::Unreadable { .. } => "请以 DER 格式重新发送证书，或重新申请证书",
        F::UnknownCriticalExtension { .. } => "请向 CA 申请不含该扩展或该扩展非关键的证书",
        F::RareCriticalExtension { .. } => "请用要连接的客户端试验，或向 CA 申请不含该扩展的证书",
        F::DamagedExtension { .. } | F::EndsBeforeItBegins | F::KeyExponent => "请重新申请证书",
        F::NameNotAscii { .. } => "请创建只含 ASCII 名称的证书，主机名中的其他字符写作 xn--…",
        F::UriNotAscii { .. } => "请为应用程序设置只含 ASCII 字符的 URI，并用该 URI 创建证书",
        F::ChainTooLong { .. } => "请由更接近根的 CA 签发证书",
        F::TooManyIssuers => "请删除不再需要的同名 CA",
        F::IssuerMissing { .. } => "请将该 CA 添加到发行人列表或信任列表",
        F::IssuerKeyIdentifier { wanted, .. } => {
            return format!("请添加密钥标识符为 {wanted} 的 CA 证书，或由现有 CA 重新签发该证书");
        }
        F::IssuerKey { .. } => "请添加持有签名密钥的 CA 证书",
        F::SignatureWrong { .. } | F::SelfSignatureWrong => "请勿信任，证书已损坏或系伪造，请重新申请证书",
        F::SignatureUnverifiable { .. } | F::WeakHash { .. } => "请申请使用 SHA-256 和至少 2048 位 RSA 密钥签名的证书",
        F::NameNotPermitted { .. } | F::NameConstraintUnsupported { .. } => {
            "请申请名称为该 CA 可签发的证书，或向其他 CA 申请"
        }
        F::TooManyNames { .. } => "请申请名称较少的证书",
        F::PolicyMissing => "请申请带有 CA 允许的策略的证书",
        F::PolicyMappingOfAny => "请为该 CA 申请不含此映射的新证书",
        F::KeyNotRsa => "请用 2048 至 4096 位 RSA 密钥创建证书",
        F::KeyTooShort { .. } | F::KeyTooLong { .. } => "请用其他长度的密钥创建证书",
        F::KeyLengthNotTicked { .. } => "请用其他长度的密钥创建证书，或勾选使用该长度的安全策略",
        F::Untrusted => "请将其或签发它的 CA 添加到信任列表",
        F::NotYetValid { .. } => "请检查时钟，或等到证书生效",
        F::Expired { .. } | F::ExpiresSoon { .. } => "请更新证书或检查时钟",
        F::HostName { .. } => "请使用证书中的名称连接，或创建含该名称的证书",
        F::UriMissing { .. } => "请创建使用者可选名称中含有应用程序 URI 的证书",
        F::UriDiffers { .. } => "请为该 URI 创建证书，或在应用程序中设置该 URI",
        F::CertificateOfAuthority => "请使用应用程序自己的证书",
        F::ClaimsToBeAuthority => "请创建非 CA 证书 (CA:FALSE)",
        F::KeyUsageMissing | F::KeyUsageLacks { .. } => {
            "请创建密钥用法包含 digitalSignature、nonRepudiation、keyEncipherment 和 dataEncipherment 的证书"
        }
        F::NotForRole { role: PeerRole::Client } => "请创建扩展密钥用法包含 clientAuth 的证书",
        F::NotForRole { role: PeerRole::Server } => "请创建扩展密钥用法包含 serverAuth 的证书",
        F::NotForRole { role: PeerRole::Either } | F::ExtendedKeyUsageMissing => {
            "请创建扩展密钥用法包含 clientAuth 和 serverAuth 的证书"
        }
        F::NotAnAuthority | F::MayNotIssue | F::MayNotIssueFor { .. } | F::TooManyAuthoritiesBelow { .. } => {
            "请由有权签发的 CA 签发证书"
        }
        F::RevocationUnknown { crl, .. } => return revocation_lists::remedy(crl),
        F::Revoked { .. } => "请勿继续使用，请重新申请证书",
        F::NotThatOfTheChannel => "请修正客户端，它出示了两个证书",
    }
    .to_owned()
}

pub fn sentence(reason: &str, remedy: &str) -> String {
    format!("{reason}。{remedy}。")
}

pub fn issuer_at_fault(issuer: &str, reason: &str) -> String {
    format!("问题在于其签发者 {issuer}：{reason}")
}

/// What a status means, and what helps. The second part is the end of a sentence.
pub const fn status(status: S) -> (&'static str, &'static str) {
    match status {
        S::CertificateInvalid => ("证书已损坏或签名错误", "请重新申请证书"),
        S::ChainIncomplete => ("缺少签发该证书的 CA 证书", "请将其添加到发行人列表或信任列表"),
        S::SecurityChecksFailed => ("证书被拒绝", "对方未说明原因"),
        S::PolicyCheckFailed => ("密钥或签名强度不足", "或与安全策略要求的类型不符，请重新创建证书"),
        S::Untrusted => ("该证书尚未受信任", "请将其或签发它的 CA 添加到信任列表"),
        S::TimeInvalid => ("证书已过期或尚未生效", "请检查时钟或更新证书"),
        S::IssuerTimeInvalid => ("签发该证书的 CA 已过期或尚未生效", "请检查时钟或更新 CA 证书"),
        S::HostNameInvalid => ("证书用于其他主机", "请使用证书中的名称连接或重新创建证书"),
        S::UriInvalid => ("证书中的应用程序 URI 与应用程序提供的不一致", "请为该应用程序创建证书"),
        S::UseNotAllowed => ("该证书不能用于 OPC UA 应用程序", "请申请具有正确用法的证书"),
        S::IssuerUseNotAllowed => ("证书链中有证书不能签发证书", "它不是 CA"),
        S::RevocationUnknown => ("没有签发该证书的 CA 的有效吊销列表", "请添加最新的吊销列表"),
        S::IssuerRevocationUnknown => ("没有证书链中某个 CA 的有效吊销列表", "请添加最新的吊销列表"),
        S::Revoked => ("该证书已被 CA 吊销", "不得继续使用"),
        S::IssuerRevoked => ("证书链中的某个 CA 已被吊销", "其签发的证书均不得使用"),
    }
}

pub fn joined(reason: &str, remedy: &str) -> String {
    format!("{reason}，{remedy}。")
}

const fn who(role: PeerRole) -> &'static str {
    match role {
        PeerRole::Client => "客户端",
        PeerRole::Server => "服务器",
        PeerRole::Either => "客户端或服务器",
    }
}
