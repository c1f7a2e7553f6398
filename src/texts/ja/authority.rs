//! Sentences about the small CA, in Japanese.

use crate::model::CertificateSummary;
use crate::texts::Zone;

fixed_texts! {
    CertificateAuthority: "認証局…";
    CertificateAuthorityTip: "独自の認証局で証明書署名要求に署名します";
    ActSignAndImport: "署名してインポート";
    ActSendCrl: "CRLを送信";
    CaTitle: "認証局";
    CaNone: "このワークスペースに認証局はありません";
    CaNoneText: "独自の認証局 (CA) でコントローラーとクライアントの証明書に署名すると、信頼する証明書は1つで済みます。CAの鍵はこのPCに保管され、パスフレーズで保護されます。";
    CaCreate: "CAの作成…";
    CaRestore: "バックアップの復元…";
    CaCreateTitle: "CAの作成";
    CaRestoreTitle: "バックアップからCAを復元";
    CaSignTicked: "チェックを付けたコントローラーに署名…";
    CaSignTickedTip: "チェックを付けた各コントローラーのCSRを読み込み、なければ作成し、署名した証明書をインポートします";
    CaSignTitle: "CA：署名とインポート";
    CaSignFile: "CSRファイルに署名…";
    CaSignFileTitle: "CSRファイルへの署名";
    CaRevoke: "失効…";
    CaRevokeTitle: "証明書の失効";
    CaPublish: "CRLの発行…";
    CaCrlTitle: "CA：CRLの発行";
    CaBackUp: "バックアップ…";
    CaBackUpTitle: "CAのバックアップ";
    CaIssued: "発行済み証明書";
    CaIssuedNone: "発行済みの証明書はありません";
    CaProfile: "用途";
    CaServer: "サーバー";
    CaClient: "クライアント";
    CaValid: "有効";
    CaExpired: "期限切れ";
    CaRevoked: "失効済み";
    CaCrl: "CRL";
    CaTickIssued: "先に証明書にチェックを付けてください";
    CaNameHint: "例：Plant 3 CA";
    CaIntermediate: "署名用の中間CAを使用";
    CaIntermediateTip: "ルートCAは中間CAにのみ署名するため、ルートCAの鍵 (root.key) は別の場所に保管できます。";
    CaKeep: "パスフレーズは安全に保管してください。パスフレーズがないと、署名も失効もできません。パスフレーズを復元する方法はありません。";
    CaPassphraseAgain: "パスフレーズ (確認)";
    CaPassphrasesDiffer: "2つのパスフレーズが一致しません";
    CaPassphraseRule: "8文字以上";
    CaPassphraseNeeded: "CAのパスフレーズを入力してください";
    CaSignText: "これらのコントローラーのサーバー証明書を、CAが署名した証明書に置き換えます。CSRがない場合は作成します。ファームウェア8.0.0未満では、CSRを作成すると現在のCA署名証明書がただちに無効になります。";
    CaNewKey: "コントローラーで新しい鍵を生成";
    CaRenew: "有効期間内の証明書も更新";
    CaAcceptWarnings: "一部のクライアントで警告が出る可能性があってもインポート";
    CaSignFileText: "証明書署名要求からは、名前だけを確認のうえ引き継ぎます。";
    CaRequest: "証明書署名要求";
    CaRevokeText: "失効した証明書を再び有効にすることはできません。クライアントとコントローラーには新しいCRLによって失効が伝わるため、失効後にCRLを発行してください。";
    CaReason: "理由";
    CaPublishText: "新しい日付と番号のCRLを作成し、CAフォルダーに保存します。";
    CaPush: "チェックを付けたコントローラーにCRLを送信し、CA証明書を発行者リストに追加";
    CaPushNone: "コントローラーにも送信する場合は、コントローラーにチェックを付けてください";
    CaTrust: "コントローラーでこのCAを信頼 (このCAが発行した証明書を持つすべてのクライアントに接続を許可)";
    CaBackUpText: "鍵、証明書、データベースを1つのファイルに保存します。ファイルはCAのパスフレーズで開けます。";
    CaRestoreText: "バックアップは、作成時のCAのパスフレーズで開きます。";
    CaSign: "署名";
    CaPublishNow: "発行";
    CaRevokeNow: "失効";
    CaBackUpNow: "バックアップ";
    CaRestoreNow: "復元";
    CaCreateNow: "作成";
    CaWorking: "処理中…";
    ReasonUnspecified: "指定なし";
    ReasonKeyCompromise: "鍵の漏えい";
    ReasonCaCompromise: "CAの鍵の漏えい";
    ReasonAffiliationChanged: "名前または所属の変更";
    ReasonSuperseded: "別の証明書による置き換え";
    ReasonCessation: "運用の終了";
    ReasonPrivilegeWithdrawn: "権限の取り消し";
}

pub fn authority(summary: &CertificateSummary, zone: Zone) -> String {
    let CertificateSummary { issued_to, issued_by, not_after, key_bits, .. } = summary;
    let until = zone.date(*not_after);
    if issued_to == issued_by {
        format!("{issued_to}、{key_bits}ビット、有効期限：{until}")
    } else {
        format!("{issued_to}、発行者：{issued_by}、{key_bits}ビット、有効期限：{until}")
    }
}

pub fn crl_state(revoked: usize, number: u64, next: Option<String>) -> String {
    let next = next.unwrap_or_else(|| "—".to_owned());
    format!("失効{revoked}件、番号{number}、次回更新の期限：{next}")
}

pub fn ca_saved(path: &std::path::Path) -> String {
    format!("保存先：{}", path.display())
}

pub fn request(common_name: &str, bits: u16) -> String {
    format!("{common_name}、{bits}ビット")
}
