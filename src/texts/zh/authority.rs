//! Sentences about the small CA, in Chinese.

use crate::model::CertificateSummary;
use crate::texts::Zone;

fixed_texts! {
    CertificateAuthority: "证书颁发机构…";
    CertificateAuthorityTip: "使用自己的颁发机构签发证书请求";
    ActSignAndImport: "签发并导入";
    ActSendCrl: "发送 CRL";
    CaTitle: "证书颁发机构";
    CaNone: "该工作区尚无证书颁发机构";
    CaNoneText: "自己的证书颁发机构 (CA) 可为控制器和客户端签发证书，各方只需信任一个证书。CA 密钥保存在本机，并由口令保护。";
    CaCreate: "创建 CA…";
    CaRestore: "恢复备份…";
    CaCreateTitle: "创建 CA";
    CaRestoreTitle: "从备份恢复 CA";
    CaSignTicked: "为已勾选控制器签发…";
    CaSignTickedTip: "读取或创建已勾选控制器的 CSR，签发并导入证书";
    CaSignTitle: "CA：签发并导入";
    CaSignFile: "签发 CSR 文件…";
    CaSignFileTitle: "签发 CSR 文件";
    CaRevoke: "吊销…";
    CaRevokeTitle: "吊销证书";
    CaPublish: "发布 CRL…";
    CaCrlTitle: "CA：发布 CRL";
    CaBackUp: "备份…";
    CaBackUpTitle: "备份 CA";
    CaIssued: "已签发的证书";
    CaIssuedNone: "尚未签发证书";
    CaProfile: "用途";
    CaServer: "服务器";
    CaClient: "客户端";
    CaValid: "有效";
    CaExpired: "已过期";
    CaRevoked: "已吊销";
    CaCrl: "CRL";
    CaTickIssued: "请先勾选证书";
    CaNameHint: "例如 Plant 3 CA";
    CaIntermediate: "使用中间 CA 签发";
    CaIntermediateTip: "此时根 CA 仅签发中间 CA，其密钥 (root.key) 可另行保管。";
    CaKeep: "请妥善保管口令。没有口令将无法签发或吊销证书，且无法找回。";
    CaPassphraseAgain: "再次输入口令";
    CaPassphrasesDiffer: "两次输入的口令不一致";
    CaPassphraseRule: "至少 8 个字符";
    CaPassphraseNeeded: "请输入 CA 的口令";
    CaSignText: "将以 CA 签发的证书替换这些控制器的服务器证书。没有 CSR 时会创建；固件低于 8.0.0 时，现有 CA 签名证书将立即失效。";
    CaNewKey: "让控制器生成新密钥";
    CaRenew: "续签仍有效的证书";
    CaAcceptWarnings: "即使部分客户端可能发出警告也导入";
    CaSignFileText: "检查后仅采用请求中的名称。";
    CaRequest: "请求";
    CaRevokeText: "吊销后无法恢复有效。各方通过新的 CRL 得知吊销，请随后发布 CRL。";
    CaReason: "原因";
    CaPublishText: "将生成具有新日期和编号的 CRL，并保存在 CA 文件夹中。";
    CaPush: "发送到已勾选的控制器，并将 CA 证书加入其发行人列表";
    CaPushNone: "勾选控制器后可同时发送";
    CaTrust: "在控制器中信任该 CA：允许持有其签发证书的所有客户端连接";
    CaBackUpText: "将密钥、证书和数据库保存为一个文件，可用 CA 的口令打开。";
    CaRestoreText: "使用备份时 CA 的口令打开备份。";
    CaSign: "签发";
    CaPublishNow: "发布";
    CaRevokeNow: "吊销";
    CaBackUpNow: "备份";
    CaRestoreNow: "恢复";
    CaCreateNow: "创建";
    CaWorking: "处理中...";
    ReasonUnspecified: "未指定";
    ReasonKeyCompromise: "密钥泄露";
    ReasonCaCompromise: "CA 泄露";
    ReasonAffiliationChanged: "名称或所属变更";
    ReasonSuperseded: "已被其他证书取代";
    ReasonCessation: "停止使用";
    ReasonPrivilegeWithdrawn: "权限撤销";
}

pub fn authority(summary: &CertificateSummary, zone: Zone) -> String {
    let CertificateSummary { issued_to, issued_by, not_after, key_bits, .. } = summary;
    let until = zone.date(*not_after);
    if issued_to == issued_by {
        format!("{issued_to}，{key_bits} 位，有效期至 {until}")
    } else {
        format!("{issued_to}，由 {issued_by} 签发，{key_bits} 位，有效期至 {until}")
    }
}

pub fn crl_state(revoked: usize, number: u64, next: Option<String>) -> String {
    let next = next.unwrap_or_else(|| "—".to_owned());
    format!("已吊销 {revoked} 个，编号 {number}，下次更新期限 {next}")
}

pub fn ca_saved(path: &std::path::Path) -> String {
    format!("已保存为 {}", path.display())
}

pub fn request(common_name: &str, bits: u16) -> String {
    format!("{common_name}，{bits} 位")
}
