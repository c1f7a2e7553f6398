//! Sentences of the command line, in Japanese.

use std::fmt::Display;

use super::LANGUAGE;
use crate::texts::TextKey;

fixed_texts! {
    // headings of tables, in capitals
    HeadingActivated: "ライセンス";
    HeadingAddress: "IPアドレス";
    HeadingBits: "ビット数";
    HeadingCa: "CA";
    HeadingCertificate: "証明書タイプ";
    HeadingCertificates: "証明書";
    HeadingCommonName: "コモンネーム";
    HeadingController: "コントローラー";
    HeadingCrls: "CRL";
    HeadingCrlNumber: "CRL番号";
    HeadingDisconnected: "切断";
    HeadingEndpoint: "エンドポイント";
    HeadingExpiry: "有効期限";
    HeadingFile: "ファイル";
    HeadingFirmware: "ファームウェア";
    HeadingGoesTo: "追加先";
    HeadingIdentity: "確認";
    HeadingIssuedBy: "発行者";
    HeadingIssuedTo: "発行先";
    HeadingIssuers: "発行者リスト";
    HeadingLicence: "ライセンス";
    HeadingLog: "サーバーログ";
    HeadingName: "名前";
    HeadingNextCrlBy: "次回CRL期限";
    HeadingNote: "備考";
    HeadingPolicies: "セキュリティポリシー";
    HeadingPort: "ポート";
    HeadingProfile: "用途";
    HeadingRejected: "拒否リスト";
    HeadingResult: "結果";
    HeadingRetrieved: "取得日時";
    HeadingRevision: "リビジョン";
    HeadingRevoked: "失効件数";
    HeadingSerial: "シリアル番号";
    HeadingStartup: "起動モード";
    HeadingStatus: "ステータス";
    HeadingThumbprint: "拇印";
    HeadingTokens: "ユーザートークン";
    HeadingTrusted: "信頼リスト";
    HeadingType: "コントローラータイプ";
    HeadingUsers: "ユーザー";
    HeadingUserToken: "ユーザートークン";
    HeadingVersion: "バージョン";
    HeadingWarnings: "警告";
    HeadingWhat: "内容";

    // words and sentences
    CliAddUnconfirmed: "コントローラーを今すぐ追加し、フィンガープリントを後で確認するには、--unconfirmedを使用してください。";
    CliVaultKeeps: "パスワード保管庫が開いていないため、保管庫内のパスワードは残ります。vault statusで一覧を表示し、vault forgetで削除できます。";
    CliStopping: "現在のステップの完了後に中止します (もう一度Ctrl-Cを押すと、完了を待たずに中止します)…";
    CliGoOn: "続行しますか？[y/N]";
    CliClientsMayComplain: "上記の点について、クライアントで警告が出る可能性があります";
    CliFirmwareCurrent: "ファームウェア8.0.0以降のコントローラー";
    CliFirmwareLegacy: "ファームウェア8.0.0未満のコントローラー";
    CliError: "エラー";
    CliWarning: "警告";
    CliCertificateAccepted: "サーバー証明書は、厳密なクライアントで受け入れ可能です";
    CliWindowBroughtToFront: "このワークスペースはすでに開かれているため、そのウィンドウを前面に表示しました。";
    CliAskCaPassphrase: "CAのパスフレーズ";
    CliAskVaultPassphrase: "パスワード保管庫のパスフレーズ";
    CliAskNewVaultPassphrase: "パスワード保管庫の新しいパスフレーズ";
    CliAskAgain: "もう一度入力";
    CliAskLogPassword: "サーバーログ用のパスワード (マニュアルでは199532)";
    CliProgramError: "内部エラーのため、本ツールを終了します";
}

pub fn added(name: impl Display, what: impl Display) -> String {
    format!("{name}を追加しました：{what}")
}

pub fn added_unconfirmed(name: impl Display, address: impl Display) -> String {
    format!("{name}を追加しました：{address}。controllers trustでフィンガープリントを確認してください。")
}

pub fn trusted(name: impl Display, what: impl Display) -> String {
    format!("{name}を確認しました：{what}")
}

pub fn removed(name: impl Display) -> String {
    format!("{name}を削除しました")
}

pub fn left_out(name: impl Display, line: impl Display, why: impl Display) -> String {
    format!("{name} ({line}行目) はインポートされませんでした：{why}")
}

pub fn other_series(name: impl Display, what: impl Display) -> String {
    format!("{name}：コントローラーが通知したタイプは{what}です")
}

pub fn backup(on: bool, folder: impl Display) -> String {
    format!("バックアップ：{}、フォルダー：{folder}", if on { "オン" } else { "オフ" })
}

pub fn revoked(serials: &[String]) -> String {
    format!(
        "失効させました：{}\n新しいCRLをすべてのコントローラーに送信してください：ca crl --push",
        serials.join("、")
    )
}

pub fn starting_virtual(count: usize) -> String {
    format!("仮想コントローラー{count}台を起動しています…")
}

pub fn changes(names: &[&str]) -> String {
    format!("{}に次の変更を行います：", names.join("、"))
}

pub fn authority(issued_to: &str) -> String {
    format!("認証局：{issued_to}")
}

pub fn application(issued_to: &str) -> String {
    format!("アプリケーション：{issued_to}")
}

pub fn crl_of(issuer: &str) -> String {
    format!("{issuer}のCRL")
}

pub fn over_plan(controllers: TextKey, plan: &str) -> String {
    format!("{}：\n{plan}", controllers.text(LANGUAGE))
}

pub fn own_certificate(file: &str) -> String {
    format!("本ツールの証明書は{file}です。--trust-meを使用すると、信頼リストに追加できます")
}

pub fn crl_line(id: &str, issuer: &str, revoked: usize, until: Option<String>, states: &[TextKey]) -> String {
    let states: String = states.iter().map(|state| format!("、{}", state.text(LANGUAGE))).collect();
    format!("{id} {issuer}：失効{revoked}件、次回更新：{}{states}", until.as_deref().unwrap_or("—"))
}

pub fn certificate_line(thumbprint: &str, issued_to: &str, until: &str) -> String {
    format!("{thumbprint} {issued_to}、有効期限：{until}")
}

pub fn refused_line(thumbprint: &str, issued_to: &str, why: &str, times: &str) -> String {
    format!("{thumbprint} {issued_to}：{why}{times}")
}

pub fn in_list(list: TextKey, entry: &str) -> String {
    format!("{}：{entry}", list.text(LANGUAGE))
}

pub fn log_read(name: &str, read: u64, size: u64) -> String {
    format!("{name}：ログ{size}バイトのうち{read}バイトを読み込みました")
}

pub fn vault_created(path: &str, passwords: usize) -> String {
    format!("{path}を作成しました。キーリングから引き継いだパスワード：{passwords}件")
}

pub fn vault_missing(path: &str) -> String {
    format!("{path}にパスワード保管庫はありません")
}

pub fn vault_used(path: &str) -> String {
    format!("パスワード保管庫{path}を使用しています")
}

pub fn vault_used_without_keyring(path: &str) -> String {
    format!("キーリングがない場合にのみ、パスワード保管庫{path}を使用します (vault onで切り替え)")
}

pub fn vault_passwords(count: usize) -> String {
    format!("パスワード：{count}件")
}

pub fn vault_imported(count: usize) -> String {
    format!("パスワード保管庫に保存したパスワード：{count}件")
}

pub fn vault_forgot(name: &str) -> String {
    format!("{name}のパスワードをパスワード保管庫から削除しました")
}

pub fn vault_has_none(name: &str) -> String {
    format!("パスワード保管庫に{name}のパスワードはありません")
}

pub fn value_known(known: &[&str]) -> String {
    format!("指定できる値：{}", known.join("、"))
}

pub fn value_on_or_off() -> String {
    "onまたはoffを指定してください".to_owned()
}

pub fn value_time() -> String {
    "RFC 3339形式の日時ではありません (例：2026-01-31T12:00:00Z)".to_owned()
}

pub fn keys_of_one() -> String {
    "複数のコントローラーには--fileを使用してください".to_owned()
}

pub fn common_name_of_one() -> String {
    "共通名 (CN) は、1台のコントローラーにのみ指定できます".to_owned()
}

pub fn push_to_none() -> String {
    "--pushには、コントローラー名または--allが必要です".to_owned()
}

pub fn same_name_in_out() -> String {
    "--outの中で、2つの証明書のファイル名が同じになります".to_owned()
}

pub fn digits_needed(text: &str) -> String {
    format!("{text}：40桁の16進数が必要です")
}

pub fn entries_differ() -> String {
    "2回の入力が一致しません".to_owned()
}

pub fn vault_passphrase_option() -> String {
    "ファイルは--vault-passphrase-fileで指定します".to_owned()
}

pub fn certificate_among_lists(subject: &str) -> String {
    format!("--crls：失効リストの中に証明書があります ({subject})")
}

pub fn only_certificates() -> String {
    "証明書だけで、CRLがありません".to_owned()
}

pub fn no_controller_after(argument: &str) -> String {
    format!("「{argument}」の後にコントローラー名がありません。名前または--allを指定してください")
}

pub fn no_value_after(argument: &str) -> String {
    format!("「{argument}」の後に値がありません")
}

pub fn no_controllers() -> String {
    "コントローラーの一覧が空です".to_owned()
}

pub fn too_many_files(folder: impl Display, most: usize) -> String {
    format!("{folder}：ファイルが{most}個を超えているか、フォルダーの階層が深すぎます")
}
