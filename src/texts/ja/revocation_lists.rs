//! What is wrong with certificate revocation lists, in Japanese.

use super::{LANGUAGE, signatures};
use crate::pki::{CrlFlaw as F, CrlUnusable, OutOfScope};
use crate::texts::certificates::date;

pub fn reason(flaw: &F, authority: &str) -> String {
    let list = format!("「{authority}」のCRL");
    match flaw {
        F::Missing => format!("{list}がありません"),
        F::NotSigned => format!("{list}の署名が正しくありません"),
        F::SignatureUnverifiable { because } => {
            format!("{list}の署名を検証できません：{}", signatures::unverifiable(because))
        }
        F::KeyNotHeld => {
            format!("{list}が、証明書に署名した鍵とは別の、同じCAの鍵で署名されており、その鍵の証明書がありません")
        }
        F::KeyNotAccepted { subject, because } => {
            format!(
                "{list}が同じCAの別の鍵で署名されており、その鍵の証明書が受け入れられません：{subject}：{}",
                because.reason(LANGUAGE)
            )
        }
        F::MayNotSign => format!("{list}はありますが、「{authority}」の鍵用途では、CRLへの署名が許可されていません"),
        F::WeakHash { algorithm } => format!("{list}の署名アルゴリズム{algorithm}の強度が不足しています"),
        F::Unusable { because } => format!("{list}は使用できません：{}", unusable(because)),
        F::OutOfScope { because } => format!("{list}は、この証明書を対象としていません：{}", out_of_scope(because)),
        F::NotYetValid { from, now } => format!("{list}の有効期間は{}からですが、時計は{}です", date(from), date(now)),
        F::NoEnd => format!("{list}に有効期限が記載されていません"),
        F::Expired { until, now } => format!("{list}の有効期限は{}ですが、時計は{}です", date(until), date(now)),
        F::SomeReasons => {
            format!("{list}は、一部の失効理由だけを対象とする分割CRLです。その他の理由を対象とするCRLがありません")
        }
    }
}

pub fn remedy(flaw: &F) -> String {
    match flaw {
        F::Missing => "このCAの最新のCRLを追加してください",
        F::NotSigned => "CRLが破損または偽造されています。使用せずに、CAからCRLを再度入手してください",
        F::SignatureUnverifiable { .. } => {
            "別の署名アルゴリズム (SHA-256とRSAなど) で署名されたCRLを、CAから入手してください"
        }
        F::KeyNotHeld => "CRLに署名した鍵のCA証明書を追加するか、証明書に署名した鍵で署名されたCRLを追加してください",
        F::KeyNotAccepted { because, .. } => {
            return format!(
                "CRLに署名した鍵の証明書について次の対処を行うか、\
                 証明書に署名した鍵で署名されたCRLを追加してください：{}",
                because.remedy(LANGUAGE)
            );
        }
        F::MayNotSign => "鍵用途にcRLSignを含むCA証明書をCAから入手し、追加してください",
        F::WeakHash { .. } => "SHA-256で署名されたCRLをCAから入手してください",
        F::Unusable { because } => match because {
            CrlUnusable::Delta => "デルタCRLは、完全なCRLを補うものです。CAの完全なCRLを追加してください",
            CrlUnusable::Indirect => "このCAが自身の発行した証明書だけを対象として発行したCRLを追加してください",
            CrlUnusable::OnlyAttributeCertificates => "公開鍵証明書を対象とする、このCAのCRLを追加してください",
            CrlUnusable::AboutNothing => "このような限定のないCRLをCAから入手してください",
            CrlUnusable::OnlySomeReasons => "すべての失効理由を対象とする、このCAのCRLを追加してください",
            CrlUnusable::CriticalExtension(_) | CrlUnusable::CriticalEntryExtension(_) => {
                "この拡張がないか、この拡張がクリティカルでないCRLを、CAから入手してください"
            }
        },
        F::OutOfScope { because } => match because {
            OutOfScope::OnlyApplications => "CA証明書を対象とする、このCAのCRLを追加してください",
            OutOfScope::OnlyAuthorities => "アプリケーション証明書を対象とする、このCAのCRLを追加してください",
            OutOfScope::OnlyAttributeCertificates => "公開鍵証明書を対象とする、このCAのCRLを追加してください",
            OutOfScope::OtherDistributionPoint(_) => {
                "証明書に記載された配布点のCRL、またはCAの完全なCRLを追加してください"
            }
        },
        F::NotYetValid { .. } => "時計を確認するか、CRLの有効期間が始まるまで待ってください",
        F::NoEnd => "次回更新日時 (nextUpdate) が記載されたCRLを、CAから入手してください (RFC 5280 §5.1.2.5)",
        F::Expired { .. } => "CAの最新のCRLを追加するか、時計を確認してください",
        F::SomeReasons => {
            "その他の失効理由を対象とするCAのCRLも追加するか、\
             すべての失効理由を対象とするCRLを追加してください"
        }
    }
    .to_owned()
}

pub fn unusable(reason: &CrlUnusable) -> String {
    match reason {
        CrlUnusable::Delta => "別のCRLからの変更だけを記載したデルタCRLです",
        CrlUnusable::Indirect => "ほかのCAの証明書を対象とする間接CRLです",
        CrlUnusable::OnlyAttributeCertificates => "属性証明書だけを対象としています",
        CrlUnusable::AboutNothing => {
            "アプリケーションだけ、かつCAだけに限定されているため、対象となる証明書がありません"
        }
        CrlUnusable::OnlySomeReasons => "一部の失効理由だけを対象とする分割CRLです",
        CrlUnusable::CriticalExtension(oid) => {
            return format!("CRLのクリティカルな拡張{oid}は、サポートされていません");
        }
        CrlUnusable::CriticalEntryExtension(oid) => {
            return format!("CRLの項目のクリティカルな拡張{oid}は、サポートされていません");
        }
    }
    .to_owned()
}

pub fn out_of_scope(reason: &OutOfScope) -> String {
    match reason {
        OutOfScope::OnlyApplications => "アプリケーション証明書だけを対象としています".to_owned(),
        OutOfScope::OnlyAuthorities => "CA証明書だけを対象としています".to_owned(),
        OutOfScope::OnlyAttributeCertificates => "属性証明書だけを対象としています".to_owned(),
        OutOfScope::OtherDistributionPoint(point) => format!("配布点が「{point}」の証明書だけを対象としています"),
    }
}
