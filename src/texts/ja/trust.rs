//! Sentences about whom controllers trust, in Japanese.

use std::borrow::Cow;

use chrono::Duration;

use super::LANGUAGE;
use crate::jobs::TrustNote;
use crate::model::{CertificateStatus, ErrorCode};
use crate::pki::CertificateFlaw;
use crate::texts::TextKey as T;
use crate::texts::certificates::date;

fixed_texts! {
    ClientCertificates: "クライアント証明書…";
    ClientCertificatesTip: "接続を許可するクライアントを、信頼リスト、拒否リスト、発行者リストで管理します";
    Crl: "CRL…";
    CrlTip: "クライアント証明書を発行した認証局の証明書失効リストを管理します";
    ActMoveClients: "証明書を移動";
    TrustTitle: "クライアント証明書";
    TrustTrusted: "信頼リスト";
    TrustRejected: "拒否リスト";
    TrustIssuers: "発行者リスト";
    TrustFilter: "名前、発行者、アドレス、番号で絞り込み";
    TrustNothingFound: "一致する項目はありません";
    TrustTrustedEmpty: "証明書による接続を許可したクライアントはありません。クライアントの証明書を追加するか、クライアントから接続を試みてください。接続を試みたクライアントは、拒否リストに表示されます。";
    TrustRejectedEmpty: "拒否されたクライアントはありません。接続を試みて拒否されたクライアントは、ここに自動的に表示されます。";
    TrustIssuersEmpty: "CA証明書はありません。クライアントが証明書チェーンを送信しない場合は、クライアント証明書を発行した認証局の証明書を追加してください。";
    TrustIssuersLegacy: "ファームウェア8.0.0未満には発行者リストがありません。CA証明書は信頼リストに追加してください。";
    TrustLegacyTrusted: "ファームウェア8.0.0未満には発行者リストがないため、CA証明書は信頼リストに追加されます";
    TrustFull: "リストがいっぱいです。先に不要な項目を削除してください。";
    TrustIssuersWhy: "ファームウェア8.0.0以降でのみ使用できます";
    TrustChoose: "先に項目にチェックを付けるか、行をクリックしてください";
    TrustBusy: "直前の変更を適用しています…";
    TrustIssuedTo: "発行先";
    TrustIssuedBy: "発行者";
    TrustFileName: "ファイル名";
    TrustValidFrom: "有効期間の開始";
    TrustValidUntil: "有効期限";
    TrustThumbprint: "拇印 (SHA-1)";
    TrustReason: "拒否の理由";
    TrustAddress: "アドレス";
    TrustCount: "回数";
    TrustFirstSeen: "初回日時";
    TrustLastSeen: "最終日時";
    TrustNotYetValid: "有効期間前";
    TrustNew: "新規";
    TrustLive: "自動更新";
    TrustLiveTip: "コントローラーでの変更は、1秒以内に表示されます";
    TrustLost: "接続が切れたため、再接続中";
    TrustEnded: "最新ではありません";
    TrustAddTo: "追加…";
    TrustTrust: "信頼";
    TrustTrustTip: "これらのクライアントに、今後の接続を許可します";
    TrustReject: "拒否";
    TrustRejectTip: "拒否リストに移動します。該当するクライアントはただちに切断されます。";
    TrustUndo: "元に戻す";
    TrustUndoNothing: "元に戻せる変更はありません";
    TrustTakenBack: "変更を元に戻しました";
    TrustUndoTitle: "信頼の変更を元に戻す";
    TrustDetails: "詳細…";
    TrustCutTitle: "切断されたクライアント";
    TrustCutNone: "切断されたクライアントはありません";
    TrustPickLine: "行をクリックすると、すべての内容がここに表示されます";
    TrustMovedHere: "手動で移動、移動後の接続なし";
    TrustMoveTitle: "それでも信頼しますか？";
    TrustMove: "移動";
    TrustDeleteTitle: "証明書の削除";
    TrustDeleteText: "信頼されなくなったクライアントは、ただちに切断されます。OPC UAサーバーは動作を続けます。削除は、ダイアログを閉じるまで元に戻せます。";
    TrustDeleteRejected: "次に接続を試みるまで、これらの記録が消去されます。この操作は元に戻せません。";
    TrustAddTitle: "証明書の追加";
    TrustAddFiles: "ファイル";
    TrustAddText: "証明書と証明書チェーンは、DER、PEM、P7Bのいずれの形式でも使用できます。ファイルに含まれるCRLも追加されます。複数のファイルを一度に選択するか、ここにドロップできます。";
    TrustAddRule: "先にファイルを選択してください";
    TrustLeaveOutRule: "先に、使用できないファイルを除外してください";
    TrustLeaveOut: "除外";
    TrustTooMany: "一度に使用できるファイルは100個までです";
    TrustDropHere: "ドロップすると追加先を表示します。まだ送信はされません。";
    TrustReadFile: "ファイルの読み込み";
    TrustGoesTo: "追加先";
    TrustWhereGoes: "追加内容と追加先";
    TrustByKind: "種類で自動判別";
    TrustByKindTip: "クライアント証明書は信頼リスト、CA証明書は発行者リスト、CRLはCRLに追加します";
    TrustTrustedTip: "すべて信頼リストに追加します。クライアント証明書に付属するCA証明書は、証明書チェーンの補完にのみ使用し、発行者リストに追加します。";
    TrustIssuersTip: "CA証明書のみ";
    TrustCrls: "CRL";
    TrustNothing: "追加しない";
    TrustKindClient: "クライアント";
    TrustKindAuthority: "認証局";
    TrustKindCrl: "CRL";
    TrustSkipRepeated: "ファイル内で重複しています";
    TrustSkipHeld: "コントローラーに登録済みです";
    TrustSkipOutdated: "コントローラーにあるCRLより古いものです";
    TrustSkipNotAsked: "追加対象の種類ではありません";
    TrustOnCurrent: "ファームウェア8.0.0以降";
    TrustOnLegacy: "ファームウェア8.0.0未満";
    TrustRevokesAtOnce: "証明書が失効しているクライアントは、ただちに切断されます。OPC UAサーバーは動作を続けます。";
    TrustCertificateTitle: "証明書";
    TrustSubject: "サブジェクト";
    TrustIssuerFull: "発行者";
    TrustAlternativeNames: "サブジェクト代替名";
    TrustKeyUsages: "鍵用途";
    TrustPurposes: "拡張鍵用途";
    TrustAuthority: "認証局";
    TrustSha256: "拇印 (SHA-256)";
    TrustChain: "証明書チェーン";
    TrustChainMissing: "不足：証明書を発行者リストまたは信頼リストに追加してください";
    TrustChainRevoked: "失効済み";
    TrustChainExpired: "期限切れ";
    TrustChainNotCa: "CA証明書ではありません";
    TrustChainNoCrl: "使用できるCRLがありません";
    TrustChainSent: "クライアントから送信されたのみ";
    TrustCopyPem: "PEMとしてコピー";
    CrlTitle: "CRL";
    CrlAddTitle: "CRLの追加";
    CrlAddText: "CRLファイルは、DER、PEM、P7Bのいずれの形式でも使用できます。複数のファイルを一度に選択するか、ここにドロップできます。";
    CrlEmpty: "CRLはありません。CRLがないと、認証局が発行した証明書が失効しているかどうかを確認できません。各認証局の最新のCRLを追加してください。";
    CrlIssuer: "発行者";
    CrlThisUpdate: "今回の更新日";
    CrlNextUpdate: "次回の更新予定";
    CrlEntries: "失効件数";
    CrlNumber: "CRL番号";
    CrlHealth: "状態";
    CrlSignature: "署名アルゴリズム";
    CrlGood: "有効";
    CrlUnusable: "使用できません";
    CrlExpired: "期限切れのため、新しいCRLが必要";
    CrlNotYet: "有効期間前";
    CrlNoIssuer: "発行者がどのリストにもないため、まだ機能しません";
    CrlWrongKey: "この名前の発行者が署名したものではないため、機能しません";
    CrlMayNotSign: "発行者にCRLへの署名が許可されていないため、機能しません";
    CrlNoEnd: "有効期限が記載されていないため、機能しません";
    CrlDeleteTitle: "CRLの削除";
    CrlDeleteText: "このCRLで失効している証明書は、再び有効になるか、失効を確認できない状態になります。CRLがないと接続できないクライアントは、ただちに切断されます。削除は、ダイアログを閉じるまで元に戻せます。";
    CrlRevoked: "失効した証明書";
    CrlRevokedNone: "失効した証明書はありません";
    CrlWithoutTitle: "使用できるCRLがない認証局";
    CrlWithoutText: "発行した証明書が失効しているかどうかを確認できないため、その証明書を持つクライアントは拒否される場合があります。";
    ChooseFilesTitle: "ファイルの選択";
    KeyUndo: "直前の変更を元に戻す (クライアント証明書、CRL)";
    KeyPanes: "次のリストに移動 (クライアント証明書)";
    KeySideways: "左、右";
}

pub fn how_full(count: usize, limit: Option<usize>) -> String {
    match limit {
        Some(limit) => format!("{count} / {limit}"),
        None => format!("{count}件"),
    }
}

pub fn full_and_ticked(full: &str, count: usize, hidden: usize) -> String {
    match hidden {
        0 => format!("{full}、{count}件にチェック"),
        _ => format!("{full}、{count}件にチェック (うち{hidden}件は非表示)"),
    }
}

pub fn new_clients(count: usize) -> String {
    format!("新規{count}件")
}

fn certificates(count: usize) -> String {
    format!("{count}件の証明書")
}

fn crls(count: usize) -> String {
    format!("{count}件のCRL")
}

pub fn trust_added(count: usize) -> String {
    format!("{count}件を追加しました")
}

pub fn certificates_deleted(list: T, count: usize) -> String {
    format!("{}から{}を削除しました", list.text(LANGUAGE), certificates(count))
}

pub fn crls_deleted(count: usize) -> String {
    format!("{}を削除しました", crls(count))
}

pub fn certificates_moved(from: T, to: T, count: usize) -> String {
    format!("{}を{}から{}に移動しました", certificates(count), from.text(LANGUAGE), to.text(LANGUAGE))
}

pub fn without_crl(names: &str) -> String {
    format!("{}：{names}", T::CrlWithoutTitle.text(LANGUAGE))
}

pub fn cut(issued_to: &str, address: &str, status: CertificateStatus) -> String {
    format!("{issued_to} ({address})：{}", status.reason(LANGUAGE))
}

pub fn and_more(count: usize) -> String {
    format!("ほか{count}件")
}

pub fn clock_off(ahead: Duration) -> String {
    let (minutes, ahead) = (ahead.num_minutes().abs(), ahead > Duration::zero());
    let amount = match minutes {
        0..120 => format!("{minutes}分"),
        120..2880 => format!("{}時間", minutes / 60),
        _ => format!("{}日", minutes / 1440),
    };
    if ahead {
        format!(
            "コントローラーの時計が、このPCより{amount}進んでいます。\
             有効期間は、コントローラーの時計で判定されます。"
        )
    } else {
        format!(
            "コントローラーの時計が、このPCより{amount}遅れています。\
             有効期間は、コントローラーの時計で判定されます。"
        )
    }
}

pub fn refused_times(address: &str, count: u64, first: &str, last: &str) -> String {
    match count {
        1 => format!("{address}から1回、{last}"),
        _ => format!("{address}から{count}回、初回：{first}、最終：{last}"),
    }
}

pub fn file_holds(certificate_count: usize, crl_count: usize) -> String {
    let parts =
        [(certificate_count > 0).then(|| certificates(certificate_count)), (crl_count > 0).then(|| crls(crl_count))];
    parts.into_iter().flatten().collect::<Vec<_>>().join("、")
}

pub fn on_firmware(firmware: T, error: ErrorCode) -> String {
    format!("{}：{}", firmware.text(LANGUAGE), error.explain(LANGUAGE).message)
}

pub fn covers(health: T, authority: &str) -> String {
    format!("{} (対象：{authority})", health.text(LANGUAGE))
}

pub fn note(note: &TrustNote) -> Cow<'static, str> {
    match note {
        TrustNote::NeverAccepted { authority, flaw } => never_accepted(*authority, flaw).into(),
        TrustNote::NumberStartsAgain { number, date: on, before, date_before } => {
            starts_again((number, &date(on)), (before, &date(date_before))).into()
        }
        TrustNote::TrustsAllItIssues => "発行した証明書を持つすべてのクライアントに接続を許可".into(),
        TrustNote::OnlyCompletesAChain => "証明書チェーンの補完にのみ使用".into(),
        TrustNote::CrlAmongCertificates => "証明書に含まれるCRL".into(),
        TrustNote::ReplacesOlder => "古いCRLを置き換え".into(),
        TrustNote::Expired => "期限切れ".into(),
        TrustNote::NotYetValid => "有効期間前".into(),
    }
}

fn starts_again((number, date): (&str, &str), (before, date_before): (&str, &str)) -> String {
    format!(
        "CRL番号が以前より小さいため ({date}の番号：{number}、以前の{date_before}の番号：\
         {before})、CAを再構築したかどうかを認証局に確認してください"
    )
}

fn never_accepted(authority: bool, flaw: &CertificateFlaw) -> String {
    let (reason, remedy) = (flaw.reason(LANGUAGE), flaw.remedy(LANGUAGE));
    if authority {
        format!("このCAが発行した証明書を持つクライアントには、接続が許可されません：{reason}。{remedy}")
    } else {
        format!("この証明書を使用するクライアントには、接続が許可されません：{reason}。{remedy}")
    }
}
