//! What is wrong with certificate revocation lists, in Chinese.

use super::{LANGUAGE, signatures};
use crate::pki::{CrlFlaw as F, CrlUnusable, OutOfScope};
use crate::texts::certificates::date;

pub fn reason(flaw: &F, authority: &str) -> String {
    let list = format!("{authority} 的吊销列表");
    match flaw {
        F::Missing => format!("没有 {list}"),
        F::NotSigned => format!("{list}签名错误"),
        F::SignatureUnverifiable { because } => {
            format!("无法验证 {list}的签名：{}", signatures::unverifiable(because))
        }
        F::KeyNotHeld => format!("{list}由该 CA 的另一个密钥签名，而不是签发证书的密钥，且没有该密钥的证书"),
        F::KeyNotAccepted { subject, because } => {
            format!("{list}由该 CA 的另一个密钥签名，且该密钥的证书未被接受：{subject}：{}", because.reason(LANGUAGE))
        }
        F::MayNotSign => format!("有 {list}，但 {authority} 的密钥用法不允许签发吊销列表"),
        F::WeakHash { algorithm } => format!("{list}使用强度不足的 {algorithm} 签名"),
        F::Unusable { because } => format!("{list}无法使用：{}", unusable(because)),
        F::OutOfScope { because } => format!("{list}不适用于该证书：{}", out_of_scope(because)),
        F::NotYetValid { from, now } => format!("{list}从 {} 起有效，时钟为 {}", date(from), date(now)),
        F::NoEnd => format!("{list}未注明有效期限"),
        F::Expired { until, now } => format!("{list}有效期至 {}，时钟为 {}", date(until), date(now)),
        F::SomeReasons => format!("{list}为分区列表，仅涉及部分吊销原因，且没有涉及其余原因的列表"),
    }
}

pub fn remedy(flaw: &F) -> String {
    match flaw {
        F::Missing => "请添加该 CA 的当前吊销列表",
        F::NotSigned => "请勿使用该列表，它已损坏或系伪造，请重新从该 CA 获取",
        F::SignatureUnverifiable { .. } => "请向该 CA 获取使用其他签名算法（例如 RSA 和 SHA-256）的吊销列表",
        F::KeyNotHeld => "请添加持有列表签名密钥的 CA 证书，或添加由签发该证书的密钥签名的列表",
        F::KeyNotAccepted { because, .. } => {
            return format!("对于该密钥的证书，{}；或添加由签发该证书的密钥签名的列表", because.remedy(LANGUAGE));
        }
        F::MayNotSign => "请向该 CA 获取密钥用法包含 cRLSign 的 CA 证书，并添加该证书",
        F::WeakHash { .. } => "请向该 CA 获取使用 SHA-256 签名的吊销列表",
        F::Unusable { because } => match because {
            CrlUnusable::Delta => "请添加该 CA 的完整吊销列表，增量列表只是对它的补充",
            CrlUnusable::Indirect => "请添加该 CA 仅针对自己所签发证书的吊销列表",
            CrlUnusable::OnlyAttributeCertificates => "请添加该 CA 针对公钥证书的吊销列表",
            CrlUnusable::AboutNothing => "请向该 CA 获取没有这些限制的吊销列表",
            CrlUnusable::OnlySomeReasons => "请添加该 CA 涉及全部原因的吊销列表",
            CrlUnusable::CriticalExtension(_) | CrlUnusable::CriticalEntryExtension(_) => {
                "请向该 CA 获取不含该扩展或该扩展非关键的吊销列表"
            }
        },
        F::OutOfScope { because } => match because {
            OutOfScope::OnlyApplications => "请添加该 CA 针对 CA 证书的吊销列表",
            OutOfScope::OnlyAuthorities => "请添加该 CA 针对应用程序证书的吊销列表",
            OutOfScope::OnlyAttributeCertificates => "请添加该 CA 针对公钥证书的吊销列表",
            OutOfScope::OtherDistributionPoint(_) => "请添加证书所写分发点的列表，或该 CA 的完整吊销列表",
        },
        F::NotYetValid { .. } => "请检查时钟，或等到列表生效",
        F::NoEnd => "请向该 CA 获取注明下次更新时间的吊销列表 (RFC 5280 §5.1.2.5)",
        F::Expired { .. } => "请添加该 CA 的当前吊销列表，或检查时钟",
        F::SomeReasons => "请同时添加该 CA 涉及其余原因的列表，或添加涉及全部原因的列表",
    }
    .to_owned()
}

pub fn unusable(reason: &CrlUnusable) -> String {
    match reason {
        CrlUnusable::Delta => "这是增量列表，只说明相对于另一个列表的变化",
        CrlUnusable::Indirect => "这是间接列表，涉及其他 CA 的证书",
        CrlUnusable::OnlyAttributeCertificates => "该列表仅针对属性证书",
        CrlUnusable::AboutNothing => "该列表同时限定为仅针对应用程序和仅针对 CA，不涉及任何证书",
        CrlUnusable::OnlySomeReasons => "这是分区列表，仅涉及部分吊销原因",
        CrlUnusable::CriticalExtension(oid) => return format!("其关键扩展 {oid} 不受支持"),
        CrlUnusable::CriticalEntryExtension(oid) => return format!("其条目的关键扩展 {oid} 不受支持"),
    }
    .to_owned()
}

pub fn out_of_scope(reason: &OutOfScope) -> String {
    match reason {
        OutOfScope::OnlyApplications => "该列表仅针对应用程序证书".to_owned(),
        OutOfScope::OnlyAuthorities => "该列表仅针对 CA 证书".to_owned(),
        OutOfScope::OnlyAttributeCertificates => "该列表仅针对属性证书".to_owned(),
        OutOfScope::OtherDistributionPoint(point) => format!("该列表仅针对分发点为 {point} 的证书"),
    }
}
