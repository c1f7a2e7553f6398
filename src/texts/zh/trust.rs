//! Sentences about whom controllers trust, in Chinese.

use std::borrow::Cow;

use chrono::Duration;

use super::LANGUAGE;
use crate::jobs::Note;
use crate::model::{CertificateStatus, ErrorCode};
use crate::pki::CertificateFlaw;
use crate::texts::TextKey as T;
use crate::texts::certificates::date;

pub fn how_full(count: usize, limit: Option<usize>) -> String {
    match limit {
        Some(limit) => format!("{count} / {limit}"),
        None => count.to_string(),
    }
}

pub fn full_and_ticked(full: &str, count: usize, hidden: usize) -> String {
    match hidden {
        0 => format!("{full}，已勾选 {count} 项"),
        _ => format!("{full}，已勾选 {count} 项，其中 {hidden} 项未显示"),
    }
}

pub fn new_clients(count: usize) -> String {
    format!("{count} 个新")
}

fn certificates(count: usize) -> String {
    format!("{count} 个证书")
}

fn crls(count: usize) -> String {
    format!("{count} 个 CRL")
}

pub fn trust_added(count: usize) -> String {
    format!("已添加 {count} 项")
}

pub fn certificates_deleted(list: T, count: usize) -> String {
    format!("已从[{}]删除 {}", list.text(LANGUAGE), certificates(count))
}

pub fn crls_deleted(count: usize) -> String {
    format!("已删除 {}", crls(count))
}

pub fn certificates_moved(from: T, to: T, count: usize) -> String {
    format!("已将 {} 从[{}]移到[{}]", certificates(count), from.text(LANGUAGE), to.text(LANGUAGE))
}

pub fn without_crl(names: &str) -> String {
    format!("{}：{names}", T::CrlWithoutTitle.text(LANGUAGE))
}

pub fn cut(issued_to: &str, address: &str, status: CertificateStatus) -> String {
    format!("{issued_to}（{address}）：{}", status.reason(LANGUAGE))
}

pub fn and_more(count: usize) -> String {
    format!("另有 {count} 个")
}

pub fn clock_off(ahead: Duration) -> String {
    let (minutes, ahead) = (ahead.num_minutes().abs(), ahead > Duration::zero());
    let amount = match minutes {
        0..120 => format!("{minutes} 分钟"),
        120..2880 => format!("{} 小时", minutes / 60),
        _ => format!("{} 天", minutes / 1440),
    };
    if ahead {
        format!("控制器的时钟比本机快 {amount}，有效期以控制器时钟为准。")
    } else {
        format!("控制器的时钟比本机慢 {amount}，有效期以控制器时钟为准。")
    }
}

pub fn refused_times(address: &str, count: u64, first: &str, last: &str) -> String {
    match count {
        1 => format!("来自 {address}，1 次，{last}"),
        _ => format!("来自 {address}，共 {count} 次，首次 {first}，最近 {last}"),
    }
}

pub fn file_holds(certificate_count: usize, crl_count: usize) -> String {
    let parts =
        [(certificate_count > 0).then(|| certificates(certificate_count)), (crl_count > 0).then(|| crls(crl_count))];
    parts.into_iter().flatten().collect::<Vec<_>>().join("，")
}

pub fn on_firmware(firmware: T, error: ErrorCode) -> String {
    format!("{}：{}", firmware.text(LANGUAGE), error.explain(LANGUAGE).message)
}

pub fn covers(health: T, authority: &str) -> String {
    format!("{}（适用于 {authority}）", health.text(LANGUAGE))
}

pub fn note(note: &Note) -> Cow<'static, str> {
    match note {
        Note::NeverAccepted { authority, flaw } => never_accepted(*authority, flaw).into(),
        Note::NumberStartsAgain { number, date: on, before, date_before } => {
            starts_again((number, &date(on)), (before, &date(date_before))).into()
        }
        Note::TrustsAllItIssues => "允许其签发的所有客户端连接".into(),
        Note::OnlyCompletesAChain => "仅用于补全证书链".into(),
        Note::CrlAmongCertificates => "证书中包含的 CRL".into(),
        Note::ReplacesOlder => "替换旧的 CRL".into(),
        Note::Expired => "已过期".into(),
        Note::NotYetValid => "尚未生效".into(),
    }
}

fn starts_again((number, date): (&str, &str), (before, date_before): (&str, &str)) -> String {
    format!(
        "编号重新开始：{date} 的编号为 {number}，此前 {date_before} 的编号为 {before}；请向颁发者确认是否已重新建立"
    )
}

fn never_accepted(authority: bool, flaw: &CertificateFlaw) -> String {
    let (reason, remedy) = (flaw.reason(LANGUAGE), flaw.remedy(LANGUAGE));
    if authority {
        format!("持有其所签发证书的客户端永远无法连接：{reason}，{remedy}")
    } else {
        format!("使用该证书的客户端永远无法连接：{reason}，{remedy}")
    }
}
