//! Sentences of the command line, in Japanese.

use std::fmt::Display;

use super::LANGUAGE;
use crate::texts::TextKey;

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
