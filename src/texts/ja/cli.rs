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
