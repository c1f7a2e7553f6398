//! Sentences with values filled in, in Japanese.

use super::LANGUAGE;
use crate::jobs::JobSummary;
use crate::model::{CertificateSummary, FirmwareVersion};
use crate::texts::{TextKey as T, Zone, byte_count};

pub fn controllers(count: usize) -> String {
    format!("コントローラー{count}台")
}

pub fn shown_of(shown: usize, all: usize) -> String {
    format!("{all}台中{shown}台を表示")
}

pub fn ticked(count: usize, hidden: usize) -> String {
    match hidden {
        0 => format!("{count}台にチェック"),
        _ => format!("{count}台にチェック (うち{hidden}台は非表示)"),
    }
}

pub fn menu_for_one(name: &str) -> String {
    format!("{name}のみ")
}

pub fn menu_for_ticked(count: usize) -> String {
    format!("チェックを付けた{count}台すべて")
}

pub fn expired(count: usize) -> String {
    format!("期限切れの証明書{count}件")
}

pub fn expiring(count: usize) -> String {
    format!("期限間近の証明書{count}件")
}

pub fn days_left(days: i64) -> String {
    format!("残り{days}日")
}

pub fn tick_row(name: &str) -> String {
    format!("{name}にチェックを付ける")
}

pub fn sort_by(column: T) -> String {
    format!("{}で並べ替え", column.text(LANGUAGE))
}

pub fn summary(summary: JobSummary) -> String {
    let JobSummary { done, failed, not_started } = summary;
    let parts = [
        (done, format!("完了{done}台")),
        (failed, format!("失敗{failed}台")),
        (not_started, format!("未開始{not_started}台")),
    ];
    let said: Vec<String> = parts.into_iter().filter(|(n, _)| *n > 0).map(|(_, text)| text).collect();
    said.join("、")
}

pub fn job_running(title: T, done: usize, all: usize) -> String {
    let title = title.text(LANGUAGE).trim_end_matches('…');
    format!("{title}：{all}台中{done}台完了")
}

pub fn job_done(title: T, count: usize) -> String {
    let title = title.text(LANGUAGE).trim_end_matches('…');
    format!("{title}：{}台完了", count)
}

pub fn added(name: &str) -> String {
    format!("{name}を追加しました")
}

pub fn deleted(count: usize) -> String {
    format!("コントローラー{count}台をリストから削除しました")
}

pub fn user_count(count: usize, most: usize) -> String {
    format!("ユーザー{count}人 (最大{most}人)")
}

pub fn exported_at(at: &str, firmware: FirmwareVersion) -> String {
    format!("{at}、ファームウェア{firmware}")
}

pub fn log_size(size: u64, here: u64, lines: usize, found: Option<usize>) -> String {
    let bytes = if here < size {
        format!("全{}のうち末尾の{}", byte_count(size), byte_count(here))
    } else {
        byte_count(size)
    };
    match found {
        None => format!("{bytes}、{lines}行"),
        Some(found) => format!("{bytes}、{lines}行中{found}行を表示"),
    }
}

pub fn version(version: &str) -> String {
    format!("バージョン{version}")
}

pub fn bits(bits: impl std::fmt::Display) -> String {
    format!("{bits}ビット")
}

pub fn nth_of(nth: usize, all: usize) -> String {
    format!("{all}台中{nth}台目")
}

pub fn stored_certificate(summary: &CertificateSummary, zone: Zone) -> String {
    let CertificateSummary { issued_to, issued_by, not_after, .. } = summary;
    let until = zone.date(*not_after);
    format!("発行先：{issued_to}、発行者：{issued_by}、有効期限：{until}")
}

pub fn issuer(summary: &CertificateSummary, zone: Zone) -> String {
    let CertificateSummary { issued_to, issued_by, not_before, not_after, .. } = summary;
    let (from, until) = (zone.date(*not_before), zone.date(*not_after));
    if issued_to == issued_by {
        format!("{issued_to}、ルート証明書、有効期間：{from}～{until}")
    } else {
        format!("{issued_to}、発行者：{issued_by}、有効期間：{from}～{until}")
    }
}

pub fn stored_in(count: usize, all: usize) -> String {
    format!("{all}台中{count}台に保存されています")
}

pub fn type_lacking(names: &[&str]) -> String {
    let (more, named) = (names.len().saturating_sub(5), names.iter().take(5).copied().collect::<Vec<_>>());
    match more {
        0 => format!("{}にはこのタイプの証明書が保存されていないため、変更は失敗します", named.join("、")),
        _ => format!(
            "{}など{}台にはこのタイプの証明書が保存されていないため、変更は失敗します",
            named.join("、"),
            names.len()
        ),
    }
}

pub fn not_read(name: &str, message: &str) -> String {
    format!("{name}：{message}")
}

pub fn importable(count: usize, all: usize) -> String {
    format!("証明書{all}件中{count}件をインポートできます")
}

pub fn finding(severity: T, explained: &str) -> String {
    format!("{}：{explained}", severity.text(LANGUAGE))
}
