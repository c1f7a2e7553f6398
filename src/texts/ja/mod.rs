//! Japanese.
//!
//! Sentences are in です・ます style; buttons, menu entries and headings are noun phrases. One sentence alone ends without
//! `。`, several sentences each end with it; explanations of a dialog always do. No blank stands between Japanese and
//! Latin characters, except around parentheses, which are half-width. Values are quoted with `「」`, words on the screen
//! stand in `[]`. Long vowels are written out: コントローラー, サーバー, ユーザー, フォルダー.
//!
//! | English | Japanese |
//! |---|---|
//! | certificate: self-signed, user-specified, CA-signed | 証明書：自己署名、ユーザー指定、CA署名 |
//! | Trusted, Rejected, Issuers | 信頼リスト、拒否リスト、発行者リスト |
//! | authority, certificate of an authority | 認証局 (CA)、CA証明書 |
//! | fingerprint of a controller, thumbprint of a certificate | フィンガープリント、拇印 |
//! | key, key of a licence | 鍵、キー |
//! | to tick | チェックを付ける |
//! | to start and stop a server | 開始、停止 |
//! | vault, keyring | パスワード保管庫、キーリング |
//! | verify | 接続検証 |
//! | this configurator, this program | 本ツール |
//! | firmware before 8.0.0, 8.0.0 and later | ファームウェア8.0.0未満、8.0.0以降 |

pub mod authority;
pub mod certificates;
pub mod cli;
pub mod common;
pub mod controllers;
pub mod countries;
pub mod errors;
pub mod files;
pub mod fins;
pub mod help;
pub mod live;
pub mod recorder;
pub mod remote;
pub mod remote_control;
pub mod revocation_lists;
pub mod sentences;
pub mod server;
pub mod server_certificates;
pub mod signatures;
pub mod trust;
pub mod vault;
pub mod verify;
pub mod window;

use crate::model::Language;

const LANGUAGE: Language = Language::Ja;
