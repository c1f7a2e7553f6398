//! Sentences about whom controllers trust, in Chinese.

use std::borrow::Cow;

use chrono::Duration;

use super::LANGUAGE;
use crate::jobs::TrustNote;
use crate::model::{CertificateStatus, ErrorCode};
use crate::pki::CertificateFlaw;
use crate::texts::TextKey as T;
use crate::texts::certificates::date;

fixed_texts! {
    ClientCertificates: "客户端证书…";
    ClientCertificatesTip: "信任、拒绝、发行人：允许哪些客户端连接";
    Crl: "CRL…";
    CrlTip: "签发客户端证书的机构的证书吊销列表";
    ActMoveClients: "移动证书";
    TrustTitle: "客户端证书";
    TrustTrusted: "信任";
    TrustRejected: "拒绝";
    TrustIssuers: "发行人";
    TrustFilter: "按名称、颁发者、地址或编号筛选";
    TrustNothingFound: "没有匹配的项";
    TrustTrustedEmpty: "尚未信任任何客户端证书。请添加客户端证书，或让客户端尝试连接，其证书将显示在[拒绝]中。";
    TrustRejectedEmpty: "没有被拒绝的客户端。尝试连接但未被允许的客户端会自动显示在此处。";
    TrustIssuersEmpty: "没有发行人证书。若客户端不随附证书链，请在此添加签发客户端证书的机构的证书。";
    TrustIssuersLegacy: "8.0.0 之前的固件没有发行人列表，请将机构证书添加到[信任]。";
    TrustLegacyTrusted: "8.0.0 之前的固件没有发行人列表，机构证书将添加到[信任]";
    TrustFull: "列表已满，请先删除不再需要的项";
    TrustIssuersWhy: "仅适用于 8.0.0 及更高版本的固件";
    TrustChoose: "请先勾选或单击一行";
    TrustBusy: "正在应用更改…";
    TrustIssuedTo: "颁发给";
    TrustIssuedBy: "颁发者";
    TrustFileName: "文件名";
    TrustValidFrom: "有效期开始";
    TrustValidUntil: "有效期至";
    TrustThumbprint: "指纹 (SHA-1)";
    TrustReason: "拒绝原因";
    TrustAddress: "地址";
    TrustCount: "次数";
    TrustFirstSeen: "首次出现";
    TrustLastSeen: "最近出现";
    TrustNotYetValid: "尚未生效";
    TrustNew: "新";
    TrustLive: "实时";
    TrustLiveTip: "控制器中的变化会在一秒内显示";
    TrustLost: "连接中断，正在重试";
    TrustEnded: "已停止更新";
    TrustAddTo: "添加…";
    TrustTrust: "信任";
    TrustTrustTip: "今后允许这些客户端连接";
    TrustReject: "拒绝";
    TrustRejectTip: "移到[拒绝]，相应客户端将立即断开";
    TrustUndo: "撤销";
    TrustUndoNothing: "没有可以撤销的更改";
    TrustTakenBack: "已撤销更改";
    TrustUndoTitle: "撤销信任更改";
    TrustDetails: "详细信息…";
    TrustCutTitle: "已断开的客户端";
    TrustCutNone: "没有客户端被断开";
    TrustPickLine: "单击一行可在此查看完整内容";
    TrustMovedHere: "由人工移入，此后未再连接";
    TrustMoveTitle: "仍要信任吗？";
    TrustMove: "移动";
    TrustDeleteTitle: "删除证书";
    TrustDeleteText: "不再受信任的客户端将立即断开，OPC UA 服务器继续运行。关闭对话框之前可以撤销删除。";
    TrustDeleteRejected: "将清除这些记录，客户端再次尝试连接时会重新出现。此操作无法撤销。";
    TrustAddTitle: "添加证书";
    TrustAddFiles: "文件";
    TrustAddText: "可使用任意格式的证书和证书链：DER、PEM、P7B，其中的 CRL 会一并添加。可一次选择多个文件，也可拖放到此处。";
    TrustAddRule: "请先选择文件";
    TrustLeaveOutRule: "请先移除无法使用的文件";
    TrustLeaveOut: "移除";
    TrustTooMany: "一次最多 100 个文件";
    TrustDropHere: "松开后显示添加位置，此时尚未发送";
    TrustReadFile: "读取文件";
    TrustGoesTo: "添加到";
    TrustWhereGoes: "添加位置";
    TrustByKind: "按类型自动分配";
    TrustByKindTip: "客户端证书添加到[信任]，机构证书添加到[发行人]，CRL 添加到 CRL";
    TrustTrustedTip: "全部添加到[信任]；随客户端证书附带的机构证书仅用于补全证书链，添加到[发行人]";
    TrustIssuersTip: "仅机构证书";
    TrustCrls: "CRL";
    TrustNothing: "不添加";
    TrustKindClient: "客户端";
    TrustKindAuthority: "机构";
    TrustKindCrl: "CRL";
    TrustSkipRepeated: "文件中重复";
    TrustSkipHeld: "控制器中已有";
    TrustSkipOutdated: "比控制器中的旧";
    TrustSkipNotAsked: "不是要添加的类型";
    TrustOnCurrent: "固件 8.0.0 及以上";
    TrustOnLegacy: "8.0.0 之前的固件";
    TrustRevokesAtOnce: "证书被吊销的客户端将立即断开，OPC UA 服务器继续运行。";
    TrustCertificateTitle: "证书";
    TrustSubject: "使用者";
    TrustIssuerFull: "颁发者";
    TrustAlternativeNames: "备用名称";
    TrustKeyUsages: "密钥用法";
    TrustPurposes: "扩展用法";
    TrustAuthority: "机构";
    TrustSha256: "指纹 (SHA-256)";
    TrustChain: "证书链";
    TrustChainMissing: "缺失：请将其证书添加到[发行人]或[信任]";
    TrustChainRevoked: "已吊销";
    TrustChainExpired: "已过期";
    TrustChainNotCa: "不是机构证书";
    TrustChainNoCrl: "没有可用的 CRL";
    TrustChainSent: "仅由客户端发送";
    TrustCopyPem: "复制为 PEM";
    CrlTitle: "CRL";
    CrlAddTitle: "添加 CRL";
    CrlAddText: "可使用任意格式的 CRL 文件：DER、PEM 或 P7B。可一次选择多个文件，也可拖放到此处。";
    CrlEmpty: "没有 CRL。没有 CRL 就无法得知机构签发的证书是否已被吊销。请添加各机构的最新 CRL。";
    CrlIssuer: "颁发者";
    CrlThisUpdate: "本次更新";
    CrlNextUpdate: "下次更新";
    CrlEntries: "吊销数量";
    CrlNumber: "CRL 编号";
    CrlHealth: "状态";
    CrlSignature: "签名算法";
    CrlGood: "有效";
    CrlUnusable: "无法使用";
    CrlExpired: "已过期，请获取新的 CRL";
    CrlNotYet: "尚未生效";
    CrlNoIssuer: "颁发者不在列表中，暂不起作用";
    CrlWrongKey: "不是该颁发者签名，不起作用";
    CrlMayNotSign: "颁发者无权签发 CRL，不起作用";
    CrlNoEnd: "未注明有效期限，不起作用";
    CrlDeleteTitle: "删除 CRL";
    CrlDeleteText: "其中吊销的证书将重新有效或无法检查。缺少 CRL 而不再允许的客户端将立即断开。关闭对话框之前可以撤销删除。";
    CrlRevoked: "被吊销的证书";
    CrlRevokedNone: "没有吊销任何证书";
    CrlWithoutTitle: "没有可用 CRL 的机构";
    CrlWithoutText: "无法得知其证书是否已被吊销，相应客户端可能被拒绝。";
    ChooseFilesTitle: "选择文件";
    KeyUndo: "撤销上一次更改（客户端证书和 CRL）";
    KeyPanes: "切换列表（客户端证书）";
    KeySideways: "左、右";
}

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

pub fn note(note: &TrustNote) -> Cow<'static, str> {
    match note {
        TrustNote::NeverAccepted { authority, flaw } => never_accepted(*authority, flaw).into(),
        TrustNote::NumberStartsAgain { number, date: on, before, date_before } => {
            starts_again((number, &date(on)), (before, &date(date_before))).into()
        }
        TrustNote::TrustsAllItIssues => "允许其签发的所有客户端连接".into(),
        TrustNote::OnlyCompletesAChain => "仅用于补全证书链".into(),
        TrustNote::CrlAmongCertificates => "证书中包含的 CRL".into(),
        TrustNote::ReplacesOlder => "替换旧的 CRL".into(),
        TrustNote::Expired => "已过期".into(),
        TrustNote::NotYetValid => "尚未生效".into(),
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
