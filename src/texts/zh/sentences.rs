//! Sentences with values filled in, in Chinese.

use super::LANGUAGE;
use crate::jobs::JobSummary;
use crate::model::{CertificateSummary, FirmwareVersion};
use crate::texts::{TextKey as T, Zone, byte_count};

pub fn controllers(count: usize) -> String {
    format!("{count} 台控制器")
}

pub fn shown_of(shown: usize, all: usize) -> String {
    format!("显示 {shown} / {all} 台控制器")
}

pub fn ticked(count: usize, hidden: usize) -> String {
    match hidden {
        0 => format!("已勾选 {count} 台"),
        _ => format!("已勾选 {count} 台，其中 {hidden} 台未显示"),
    }
}

pub fn menu_for_one(name: &str) -> String {
    format!("仅 {name}")
}

pub fn menu_for_ticked(count: usize) -> String {
    format!("全部已勾选的 {count} 台控制器")
}

pub fn expired(count: usize) -> String {
    format!("{count} 个证书已过期")
}

pub fn expiring(count: usize) -> String {
    format!("{count} 个证书即将到期")
}

pub fn days_left(days: i64) -> String {
    format!("剩余 {days} 天")
}

pub fn tick_row(name: &str) -> String {
    format!("勾选 {name}")
}

pub fn sort_by(column: T) -> String {
    format!("按{}排序", column.text(LANGUAGE))
}

pub fn summary(summary: JobSummary) -> String {
    let JobSummary { done, failed, not_started } = summary;
    let parts = [
        (done, format!("完成 {done} 台")),
        (failed, format!("失败 {failed} 台")),
        (not_started, format!("未开始 {not_started} 台")),
    ];
    let said: Vec<String> = parts.into_iter().filter(|(n, _)| *n > 0).map(|(_, text)| text).collect();
    said.join("，")
}

pub fn job_running(title: T, done: usize, all: usize) -> String {
    let title = title.text(LANGUAGE).trim_end_matches('…');
    format!("{title}：已完成 {done} / {all} 台控制器")
}

pub fn job_done(title: T, count: usize) -> String {
    let title = title.text(LANGUAGE).trim_end_matches('…');
    format!("{title}：{} 台控制器已完成", count)
}

pub fn added(name: &str) -> String {
    format!("已添加 {name}")
}

pub fn deleted(count: usize) -> String {
    format!("已从列表中删除 {count} 台控制器")
}

pub fn user_count(count: usize, most: usize) -> String {
    format!("{count} 个用户，最多 {most} 个")
}

pub fn exported_at(at: &str, firmware: FirmwareVersion) -> String {
    format!("{at}，固件 {firmware}")
}

pub fn log_size(size: u64, here: u64, lines: usize, found: Option<usize>) -> String {
    let bytes = if here < size {
        format!("共 {}，显示最后 {}", byte_count(size), byte_count(here))
    } else {
        byte_count(size)
    };
    match found {
        None => format!("{bytes}，{lines} 行"),
        Some(found) => format!("{bytes}，显示 {found} / {lines} 行"),
    }
}

pub fn version(version: &str) -> String {
    format!("版本 {version}")
}

pub fn bits(bits: impl std::fmt::Display) -> String {
    format!("{bits} 位")
}

pub fn nth_of(nth: usize, all: usize) -> String {
    format!("第 {nth} 台，共 {all} 台")
}

pub fn stored_certificate(summary: &CertificateSummary, zone: Zone) -> String {
    let CertificateSummary { issued_to, issued_by, not_after, .. } = summary;
    let until = zone.date(*not_after);
    format!("颁发给 {issued_to}，颁发者 {issued_by}，有效期至 {until}")
}

pub fn issuer(summary: &CertificateSummary, zone: Zone) -> String {
    let CertificateSummary { issued_to, issued_by, not_before, not_after, .. } = summary;
    let (from, until) = (zone.date(*not_before), zone.date(*not_after));
    if issued_to == issued_by {
        format!("{issued_to}，根证书，有效期 {from} 至 {until}")
    } else {
        format!("{issued_to}，颁发者 {issued_by}，有效期 {from} 至 {until}")
    }
}

pub fn stored_in(count: usize, all: usize) -> String {
    format!("{all} 台控制器中有 {count} 台已保存")
}

pub fn type_lacking(names: &[&str]) -> String {
    let (more, named) = (names.len().saturating_sub(5), names.iter().take(5).copied().collect::<Vec<_>>());
    match more {
        0 => format!("{} 未保存该类型，更改将失败", named.join("、")),
        _ => format!("{} 等 {} 台未保存该类型，更改将失败", named.join("、"), names.len()),
    }
}

pub fn not_read(name: &str, message: &str) -> String {
    format!("{name}：{message}")
}

pub fn importable(count: usize, all: usize) -> String {
    format!("{all} 个证书中有 {count} 个可以导入")
}

pub fn finding(severity: T, explained: &str) -> String {
    format!("{}：{explained}", severity.text(LANGUAGE))
}
