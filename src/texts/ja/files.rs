//! Sentences about files and their lines, in Japanese.

use std::path::Path;

use super::LANGUAGE;
use crate::model::AddressError;
use crate::model::activation::{ActivationMistake, KeyError, LineMistake};
use crate::texts::TextKey as T;
use crate::workspace::SkippedLine;

fixed_texts! {
    // choosing a file
    FileLabel: "ファイル";
    FileHint: "ファイルのパス";
    FileRule: "ファイルを選択するか、パスを入力してください";
    ChooseFile: "選択…";
    ChooseFileTitle: "ファイルの選択";
    ReadFile: "ファイルの読み込み";
    Browse: "参照…";
    OpenFolder: "フォルダーを開く";

    // files dropped onto the window
    DropTitle: "ドロップしたファイル";
    DropChoose: "用途";
    DropOpen: "開く";
    DropUnseen: "ドロップすると、ファイルの種類を判別します";
    DropAsks: "複数の用途があります。ドロップ後に選択してください。";
    DropNothing: "使用できるファイルがありません";
    DropDialogOpen: "ダイアログが開いています。先に閉じてから、ファイルをドロップし直してください。";
    DropTooMany: "ファイルが多すぎます。一度にドロップできるのは100個までです。";
    DropOneFile: "一度に使用できるファイルは1つです。1つだけドロップしてください。";
    WhySplitKey: "このファイルには証明書と秘密鍵が一緒に含まれています。2つのファイルに分けるか、1つの.pfxファイルとして保存してください。";
    DropCrl: "証明書失効リスト (CRL)";
    DropAuthority: "認証局";
    KindActivation: "アクティベーションファイル";
    KindConnectionList: "接続リスト";
    KindSettingsExport: "設定エクスポートファイル";
    KindCertificate: "証明書";
    KindChain: "複数の証明書 (PEM)";
    KindBundle: "証明書またはCRLの集合 (PKCS#7またはPEM)";
    KindCsr: "証明書署名要求 (CSR)";
    KindKey: "秘密鍵";
    KindKeyAndCertificate: "証明書と秘密鍵を1つにしたPEMファイル";
    KindPkcs12: "証明書と暗号化された鍵 (PKCS#12)";
}

pub fn moved_aside(name: &str, file: &Path) -> String {
    format!("{name}：以前のファイルを{}に移動しました", file.display())
}

pub fn line(line: impl std::fmt::Display) -> String {
    format!("{line}行目")
}

pub fn key_error(error: KeyError) -> String {
    match error {
        KeyError::Character(c) => format!("{c:?}は半角英数字ではありません"),
        KeyError::Length { found, expected } => format!("{found}文字です。{expected}文字にしてください。"),
    }
}

pub fn key_progress(found: usize, expected: usize) -> String {
    format!("半角英数字{expected}文字中{found}文字を入力済み")
}

pub fn keys_found(ready: usize, all: usize) -> String {
    format!("{all}台中{ready}台のキーが見つかりました")
}

pub fn line_mistake(mistake: &LineMistake) -> String {
    let what = match &mistake.mistake {
        ActivationMistake::Fields(count) => {
            format!("項目数が{count}個です。シリアル番号とキー2つの3個にしてください。")
        }
        ActivationMistake::Separator { found, expected } => {
            format!("区切り文字「{found}」が、前の行の「{expected}」と異なります")
        }
        ActivationMistake::Quotes => "引用符が閉じていないか、項目に改行が含まれています".to_owned(),
        ActivationMistake::Serial => {
            "シリアル番号が正しくありません。半角英数字、「-」、「_」の1～32文字にしてください。".to_owned()
        }
        ActivationMistake::Licence(error) => format!("ライセンスキー：{}", key_error(*error)),
        ActivationMistake::Activation(error) => format!("アクティベーションキー：{}", key_error(*error)),
        ActivationMistake::Duplicate(line) => format!("シリアル番号が{line}行目と重複しています"),
    };
    format!("{}：{what}", line(mistake.line))
}

pub fn to_import(ticked: usize, all: usize) -> String {
    format!("{all}台中{ticked}台をインポート")
}

pub fn imported(count: usize) -> String {
    format!("コントローラー{count}台を追加しました (未確認)")
}

pub fn skipped(why: &SkippedLine) -> String {
    match why {
        SkippedLine::Usb => "USB接続のため、ネットワークから接続できません".to_owned(),
        SkippedLine::Virtual => "開発環境の仮想コントローラーです".to_owned(),
        SkippedLine::NameRegistered => "名前は登録済みです".to_owned(),
        SkippedLine::AddressRegistered(name) => format!("アドレスは登録済みです ({name})"),
        SkippedLine::Fields(count) => format!("項目数が{count}個です。名前、タイプ、アドレスの3個にしてください。"),
        SkippedLine::Type(kind) => format!("「{kind}」は、接続の種類 (Ethernet、USB、Virtual) ではありません"),
        SkippedLine::Name(_) => format!("名前が正しくありません：{}", T::NameRule.text(LANGUAGE)),
        SkippedLine::Quotes => "引用符が閉じていないか、項目に改行が含まれています".to_owned(),
        SkippedLine::Address(error) => format!("アドレスが正しくありません：{}", address_error(error)),
        SkippedLine::NameTwice(line) => format!("名前が{line}行目と重複しています"),
        SkippedLine::AddressTwice(line) => format!("アドレスが{line}行目と重複しています"),
    }
}

/// Why a text is not the address of a controller.
fn address_error(error: &AddressError) -> String {
    match error {
        AddressError::Scheme(scheme) => {
            format!("「{scheme}://」を除いて、管理プロトコルのアドレスを入力してください (ポートは省略できます)")
        }
        AddressError::Path(path) => format!("「{path}」を除いてください"),
        AddressError::LeadingZeros { found, meant } => {
            format!("「{found}」の先頭に0があります。{meant}と入力してください。")
        }
        AddressError::Zone(zone) => {
            format!("ゾーン「{zone}」には対応していません。ゾーンのないアドレスを入力してください。")
        }
        AddressError::NotAscii(_) => "ASCII以外の文字があります。半角文字で入力してください。".to_owned(),
        _ => T::AddressRule.text(LANGUAGE).to_owned(),
    }
}

pub fn drop_title(count: usize) -> String {
    match count {
        1 => "ここにファイルをドロップしてください".to_owned(),
        _ => format!("ここに{count}個のファイルをドロップしてください"),
    }
}

pub fn drop_opens(dialog: &str) -> String {
    format!("開くダイアログ：{dialog}")
}

pub fn drop_disabled(dialog: &str, why: &str) -> String {
    format!("{dialog}：{why}")
}

pub fn more(count: usize) -> String {
    format!("ほか{count}個")
}

pub fn only_these(names: &[String]) -> String {
    let named = names.iter().take(3).map(String::as_str).collect::<Vec<_>>();
    let rest = if names.len() > 3 { format!("、{}", more(names.len() - 3)) } else { String::new() };
    format!("{}{rest}のみ", named.join("、"))
}
