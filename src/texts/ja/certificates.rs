//! What is wrong with certificates, in Japanese.

use super::{revocation_lists, signatures};
use crate::model::CertificateStatus as S;
use crate::pki::{CertificateFlaw as F, PeerRole};
use crate::texts::certificates::{date, usages};

pub fn flaw_reason(flaw: &F) -> String {
    match flaw {
        F::Unreadable { why } => format!("証明書を読み込めません：{why}"),
        F::UnknownCriticalExtension { extension } => {
            format!("証明書のクリティカルな拡張{extension}は、サポートされていません")
        }
        F::RareCriticalExtension { extension } => {
            format!(
                "証明書の拡張{extension}がクリティカルです。\
                 この拡張に対応していないクライアントは、証明書を拒否します"
            )
        }
        F::DamagedExtension { extension } => format!("証明書の拡張{extension}が破損しています"),
        F::NameNotAscii { name } => format!("証明書の名前「{name}」に、ASCII以外の文字があります (RFC 5280 §4.2.1.6)"),
        F::EndsBeforeItBegins => "証明書の有効期間の終了が、開始より前です".to_owned(),
        F::ChainTooLong { most } => format!("証明書チェーンの証明書が{most}個を超えています"),
        F::TooManyIssuers => "発行者と同じ名前のCAが多すぎるため、すべてを検査できません".to_owned(),
        F::IssuerMissing { issuer } => format!("発行者「{issuer}」の証明書がありません"),
        F::IssuerKeyIdentifier { issuer, wanted } => {
            format!(
                "発行者「{issuer}」の証明書があり、署名も正しいですが、\
                 鍵識別子が証明書に記載された{wanted}と異なります (RFC 5280 §4.2.1.1)"
            )
        }
        F::IssuerKey { issuer } => {
            format!("「{issuer}」という名前のCAの証明書はありますが、証明書に署名した鍵とは別の鍵のものです")
        }
        F::SignatureWrong { issuer } => format!("署名が、発行者「{issuer}」のものではありません"),
        F::SelfSignatureWrong => {
            "発行者として証明書自身の名前が記載されていますが、証明書自身の鍵で署名されていません".to_owned()
        }
        F::SignatureUnverifiable { because } => format!("署名を検証できません：{}", signatures::unverifiable(because)),
        F::NameNotPermitted { name, authority } => {
            format!("CA「{authority}」の名前制約により、名前「{name}」は許可されていません (RFC 5280 §4.2.1.10)")
        }
        F::NameConstraintUnsupported { name, authority } => {
            format!(
                "CA「{authority}」の名前制約で名前「{name}」が許可されているかどうかを、\
                 検査できません (RFC 5280 §4.2.1.10)"
            )
        }
        F::TooManyNames { authority } => {
            format!("証明書の名前が多すぎるため、CA「{authority}」の名前制約と照合できません")
        }
        F::PolicyMissing => "上位のCAが証明書ポリシーを要求していますが、\
                             証明書チェーン全体で有効なポリシーがありません (RFC 5280 §6.1.5)"
            .to_owned(),
        F::PolicyMappingOfAny => "ポリシーマッピングにanyPolicyが使用されています (RFC 5280 §4.2.1.5で禁止)".to_owned(),
        F::KeyNotRsa => "鍵が、セキュリティポリシーに必要なRSA鍵ではありません".to_owned(),
        F::KeyExponent => "RSA鍵の指数が不正です".to_owned(),
        F::KeyTooShort { bits, least: least @ 2048.. } if *bits >= 1024 => {
            format!(
                "RSA鍵が{bits}ビットです。非推奨のものを除くセキュリティポリシーには、\
                 {least}ビット以上が必要です"
            )
        }
        F::KeyTooShort { bits, least } => format!("RSA鍵が{bits}ビットです。{least}ビット以上が必要です"),
        F::KeyTooLong { bits, most } => format!("RSA鍵が{bits}ビットです。使用できるのは{most}ビットまでです"),
        F::KeyLengthNotTicked { bits } => {
            format!("有効なセキュリティポリシーでは、{bits}ビットの鍵は許可されていません")
        }
        F::WeakHash { algorithm } => format!("証明書の署名アルゴリズム{algorithm}の強度が不足しています"),
        F::Untrusted => "証明書もその発行者も、信頼リストにありません".to_owned(),
        F::NotYetValid { from, now } => format!("有効期間は{}からですが、時計は{}です", date(from), date(now)),
        F::Expired { until, now } => format!("有効期限は{}ですが、時計は{}です", date(until), date(now)),
        F::ExpiresSoon { until } => format!("有効期限が近づいています ({})", date(until)),
        F::HostName { hosts, names } if names.is_empty() => {
            format!("証明書にホスト名もアドレスもありません。アプリケーションへの接続先は{}です", hosts.join("、"))
        }
        F::HostName { hosts, names } => {
            format!(
                "接続先の{}が証明書にありません。証明書に記載されているのは{}です",
                hosts.join("、"),
                names.join("、")
            )
        }
        F::UriMissing { announced: None } => "証明書にアプリケーションURIがありません".to_owned(),
        F::UriMissing { announced: Some(announced) } => {
            format!("証明書にアプリケーションURIがありません。アプリケーションのURIは{announced}です")
        }
        F::UriDiffers { certificate, announced } => {
            format!("証明書のアプリケーションURIは{certificate}ですが、アプリケーションのURIは{announced}です")
        }
        F::UriNotAscii { uri } => {
            format!("アプリケーションURI「{uri}」に、ASCII以外の文字があります (RFC 5280 §4.2.1.6)")
        }
        F::CertificateOfAuthority => "アプリケーションの証明書ではなく、CA証明書です".to_owned(),
        F::ClaimsToBeAuthority => "アプリケーションの証明書ですが、CAであると記載されています".to_owned(),
        F::KeyUsageMissing => "鍵用途が記載されていません".to_owned(),
        F::KeyUsageLacks { missing } => format!("鍵用途に{}がありません", usages(missing).join("、")),
        F::NotForRole { role } => format!("拡張鍵用途が{}用ではありません", who(*role)),
        F::ExtendedKeyUsageMissing => "拡張鍵用途が記載されていません".to_owned(),
        F::NotAnAuthority => "証明書を発行していますが、CAではありません".to_owned(),
        F::MayNotIssue => "証明書を発行していますが、その鍵による証明書への署名は許可されていません".to_owned(),
        F::MayNotIssueFor { role } => format!("{}用の証明書の発行は許可されていません", who(*role)),
        F::TooManyAuthoritiesBelow { most, found } => {
            format!("下位に許可されているCAは{most}個までですが、{found}個あります")
        }
        F::RevocationUnknown { authority, crl } => {
            format!("失効しているかどうかを確認できません：{}", revocation_lists::reason(crl, authority))
        }
        F::Revoked { on, because } => format!("{}に失効しました ({})", date(on), because.as_str()),
        F::NotThatOfTheChannel => "セッションの証明書が、セキュアチャネルの証明書と異なります".to_owned(),
    }
}

pub fn flaw_remedy(flaw: &F) -> String {
    match flaw {
        F::Unreadable { .. } => "証明書をDER形式で送り直すか、証明書の再発行を受けてください",
        F::UnknownCriticalExtension { .. } => {
            "この拡張がないか、この拡張がクリティカルでない証明書の発行を、CAに依頼してください"
        }
        F::RareCriticalExtension { .. } => {
            "使用するクライアントで接続を確認するか、この拡張がない証明書の発行をCAに依頼してください"
        }
        F::DamagedExtension { .. } | F::EndsBeforeItBegins | F::KeyExponent => "証明書の再発行を受けてください",
        F::NameNotAscii { .. } => {
            "名前がASCII文字だけの証明書を作成してください。\
             ホスト名のその他の文字は、xn--…の形式で表します"
        }
        F::UriNotAscii { .. } => "アプリケーションにASCII文字だけのURIを設定し、そのURIで証明書を作成してください",
        F::ChainTooLong { .. } => "ルートにより近いCAから証明書の発行を受けてください",
        F::TooManyIssuers => "この名前の不要なCA証明書を削除してください",
        F::IssuerMissing { .. } => "CA証明書を発行者リストまたは信頼リストに追加してください",
        F::IssuerKeyIdentifier { wanted, .. } => {
            return format!("鍵識別子が{wanted}のCA証明書を追加するか、現在のCAから証明書の再発行を受けてください");
        }
        F::IssuerKey { .. } => "証明書に署名した鍵のCA証明書を追加してください",
        F::SignatureWrong { .. } | F::SelfSignatureWrong => {
            "証明書が破損または偽造されています。信頼せずに、証明書の再発行を受けてください"
        }
        F::SignatureUnverifiable { .. } | F::WeakHash { .. } => {
            "SHA-256と2048ビット以上のRSA鍵で署名された証明書の発行を受けてください"
        }
        F::NameNotPermitted { .. } | F::NameConstraintUnsupported { .. } => {
            "このCAが証明できる名前で証明書の発行を受けるか、別のCAから証明書の発行を受けてください"
        }
        F::TooManyNames { .. } => "名前の数を減らした証明書の発行を受けてください",
        F::PolicyMissing => "CAが許可するポリシーの証明書の発行を受けてください",
        F::PolicyMappingOfAny => "このCAについて、このマッピングがない証明書の発行を受けてください",
        F::KeyNotRsa => "2048～4096ビットのRSA鍵で証明書を作成してください",
        F::KeyTooShort { .. } | F::KeyTooLong { .. } => "別の鍵長で証明書を作成してください",
        F::KeyLengthNotTicked { .. } => {
            "別の鍵長で証明書を作成するか、この鍵長を使用できるセキュリティポリシーを有効にしてください"
        }
        F::Untrusted => "証明書、または証明書を発行したCAの証明書を、信頼リストに追加してください",
        F::NotYetValid { .. } => "時計を確認するか、証明書の有効期間が始まるまで待ってください",
        F::Expired { .. } | F::ExpiresSoon { .. } => "証明書を更新するか、時計を確認してください",
        F::HostName { .. } => "証明書に記載された名前で接続するか、この接続先を含む証明書を作成してください",
        F::UriMissing { .. } => "サブジェクト代替名にアプリケーションURIを含む証明書を作成してください",
        F::UriDiffers { .. } => {
            "アプリケーションのURIで証明書を作成するか、証明書のURIをアプリケーションに設定してください"
        }
        F::CertificateOfAuthority => "アプリケーション自体の証明書を使用してください",
        F::ClaimsToBeAuthority => "CAではない証明書 (CA:FALSE) を作成してください",
        F::KeyUsageMissing | F::KeyUsageLacks { .. } => {
            "鍵用途にdigitalSignature、nonRepudiation、keyEncipherment、\
             dataEnciphermentを含む証明書を作成してください"
        }
        F::NotForRole { role: PeerRole::Client } => "拡張鍵用途にclientAuthを含む証明書を作成してください",
        F::NotForRole { role: PeerRole::Server } => "拡張鍵用途にserverAuthを含む証明書を作成してください",
        F::NotForRole { role: PeerRole::Either } | F::ExtendedKeyUsageMissing => {
            "拡張鍵用途にclientAuthとserverAuthを含む証明書を作成してください"
        }
        F::NotAnAuthority | F::MayNotIssue | F::MayNotIssueFor { .. } | F::TooManyAuthoritiesBelow { .. } => {
            "発行が許可されているCAから証明書の発行を受けてください"
        }
        F::RevocationUnknown { crl, .. } => return revocation_lists::remedy(crl),
        F::Revoked { .. } => "この証明書の使用を中止し、証明書の再発行を受けてください",
        F::NotThatOfTheChannel => "クライアントが2つの証明書を提示しています。クライアントを修正してください",
    }
    .to_owned()
}

pub fn sentence(reason: &str, remedy: &str) -> String {
    format!("{reason}。{remedy}。")
}

pub fn issuer_at_fault(issuer: &str, reason: &str) -> String {
    format!("発行者「{issuer}」に問題があります：{reason}")
}

/// What a status means, and what helps. The second part is the end of a sentence.
pub const fn status(status: S) -> (&'static str, &'static str) {
    match status {
        S::CertificateInvalid => ("証明書が破損しているか、署名が正しくありません", "証明書の再発行を受けてください"),
        S::ChainIncomplete => {
            ("証明書を発行したCAの証明書がありません", "CA証明書を発行者リストまたは信頼リストに追加してください")
        }
        S::SecurityChecksFailed => ("証明書が拒否されました", "相手から理由は通知されていません"),
        S::PolicyCheckFailed => {
            ("鍵または署名の強度か種類が、セキュリティポリシーに適合しません", "証明書を作成し直してください")
        }
        S::Untrusted => {
            ("証明書が信頼されていません", "証明書、または証明書を発行したCAの証明書を、信頼リストに追加してください")
        }
        S::TimeInvalid => ("証明書が期限切れか、有効期間前です", "時計を確認するか、証明書を更新してください"),
        S::IssuerTimeInvalid => {
            ("証明書を発行したCAの証明書が期限切れか、有効期間前です", "時計を確認するか、CA証明書を更新してください")
        }
        S::HostNameInvalid => {
            ("証明書が、接続先とは別のホスト用です", "証明書に記載された名前で接続するか、証明書を作成し直してください")
        }
        S::UriInvalid => (
            "証明書のアプリケーションURIが、アプリケーションのURIと一致しません",
            "このアプリケーション用の証明書を作成してください",
        ),
        S::UseNotAllowed => (
            "証明書は、OPC UAアプリケーションでの使用が許可されていません",
            "鍵用途が正しい証明書の発行を受けてください",
        ),
        S::IssuerUseNotAllowed => (
            "証明書チェーンに、証明書の発行が許可されていない証明書があります",
            "発行が許可されているCAから証明書の発行を受けてください",
        ),
        S::RevocationUnknown => ("証明書を発行したCAの有効なCRLがありません", "最新のCRLを追加してください"),
        S::IssuerRevocationUnknown => {
            ("証明書チェーン内のCAに対する有効なCRLがありません", "最新のCRLを追加してください")
        }
        S::Revoked => ("証明書は失効しています", "この証明書の使用を中止してください"),
        S::IssuerRevoked => {
            ("証明書チェーン内のCA証明書が失効しています", "このCAが発行したすべての証明書の使用を中止してください")
        }
    }
}

pub fn joined(reason: &str, remedy: &str) -> String {
    format!("{reason}。{remedy}。")
}

const fn who(role: PeerRole) -> &'static str {
    match role {
        PeerRole::Client => "クライアント",
        PeerRole::Server => "サーバー",
        PeerRole::Either => "クライアントまたはサーバー",
    }
}
