//! Sentences about whom controllers trust, in Japanese.

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

pub fn note(note: &Note) -> Cow<'static, str> {
    match note {
        Note::NeverAccepted { authority, flaw } => never_accepted(*authority, flaw).into(),
        Note::NumberStartsAgain { number, date: on, before, date_before } => {
            starts_again((number, &date(on)), (before, &date(date_before))).into()
        }
        Note::TrustsAllItIssues => "発行した証明書を持つすべてのクライアントに接続を許可".into(),
        Note::OnlyCompletesAChain => "証明書チェーンの補完にのみ使用".into(),
        Note::CrlAmongCertificates => "証明書に含まれるCRL".into(),
        Note::ReplacesOlder => "古いCRLを置き換え".into(),
        Note::Expired => "期限切れ".into(),
        Note::NotYetValid => "有効期間前".into(),
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
