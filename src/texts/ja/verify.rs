//! What came of connecting to a server as a client, in Japanese.

use super::LANGUAGE;
use crate::jobs::{ConnectRefusal, NotTried, RefusalDetails, VerifyCounts, VerifyFinding};
use crate::model::CertificateStatus;
use crate::session::opcua_client::TokenKind;

fixed_texts! {
    Verify: "接続検証";
    VerifyTip: "OPC UAサーバーが提供するすべての方法で、クライアントとして接続を試みます";
    VerifyTitle: "接続検証";
    VerifyWorks: "試行した接続はすべて正常です";
    VerifyFails: "正常でない項目があります";
    VerifyEndpoint: "エンドポイント";
    VerdictWorks: "正常";
    VerdictFails: "失敗";
    VerdictNotTried: "未試行";
    VerifyCertificate: "サーバー証明書";
    VerifyAccepted: "厳密なクライアントで受け入れ可能";
    VerifyRefused: "厳密なクライアントで拒否";
    VerifyAgain: "再検証";
    VerifyTrust: "本ツールを信頼リストに追加…";
    VerifyTrustText: "サーバーは、信頼リストに証明書があるクライアントにのみ接続を許可します。本ツールの証明書は信頼リストにありません。ここで追加するか、後でこのフォルダーのファイルを使用して追加できます。";
    VerifyLogin: "ログインを試行するには、コントローラーのユーザーを入力してください。パスワードは暗号化した場合にのみ送信され、一度拒否されると再送信されません。";
    TrustConfiguratorTitle: "本ツールを信頼リストに追加";
    ConfirmTrustConfigurator: "本ツールの証明書を信頼リストに追加し、そのまま残します。コントローラーのユーザーを使用する場合、または匿名接続が許可されている場合は、ほかのクライアントと同じように接続できるようになります。";
    VerifyAfterChanges: "変更後の処理";
    VerifyAfterChangesOn: "サーバーの再開後に接続検証を実行";
}

pub fn refusal(refusal: &ConnectRefusal) -> String {
    match refusal {
        ConnectRefusal::NotReachable(why) => format!(
            "このアドレスから応答がありません ({why})。ポート、\
             ファイアウォール、ケーブルを確認してください。"
        ),
        ConnectRefusal::TimedOut => {
            "時間内に応答がありません。ネットワークを確認するか、サーバーを再度開始してください。".to_owned()
        }
        ConnectRefusal::NotOpcUa(why) => format!("応答した相手は、正常なOPC UAサーバーではありません：{why}"),
        ConnectRefusal::Closed => {
            "サーバーが、理由を通知せずに接続を切断しました。サーバーログで理由を確認してください。\
                            拒否が続くと、サーバーは1分間理由を通知しません。"
                .to_owned()
        }
        ConnectRefusal::OwnCertificate(None) => {
            "サーバーが本ツールの証明書を拒否しましたが、理由は通知されていません。\
                                          多くの場合、本ツールの証明書が信頼リストにないことが原因です。"
                .to_owned()
        }
        ConnectRefusal::OwnCertificate(Some(RefusalDetails { status: CertificateStatus::Untrusted, .. })) => {
            "サーバーが本ツールの証明書を信頼していません。\
             証明書を信頼リストに追加してから、再検証してください。"
                .to_owned()
        }
        ConnectRefusal::OwnCertificate(Some(told)) => {
            let said = told.explain(LANGUAGE);
            format!("サーバーが本ツールの証明書を拒否しました ({})：{said}", told.status)
        }
        ConnectRefusal::OtherCertificate => "サーバーが、エンドポイントの証明書とは別の証明書で応答しました。\
                                      パスワードは送信されていません。"
            .to_owned(),
        ConnectRefusal::Password => {
            "ユーザー名またはパスワードが間違っているか、ユーザーが1分間ロックされています".to_owned()
        }
        ConnectRefusal::Anonymous => "匿名接続が提供されていますが、ユーザー名なしの接続は拒否されました".to_owned(),
        ConnectRefusal::Busy(name) => format!(
            "サーバーに接続できるクライアント数の上限に達しています ({name})。\
             不要なクライアントを終了してから、再検証してください。"
        ),
        ConnectRefusal::State(state) => {
            format!("クライアントは接続できますが、サーバーの状態がRunningではなく{state}です")
        }
        ConnectRefusal::Status { name, reason } if reason.is_empty() => format!("サーバーが拒否しました：{name}"),
        ConnectRefusal::Status { name, reason } => format!("サーバーが拒否しました：{name}、{reason}"),
    }
}

pub const fn not_tried(why: NotTried) -> &'static str {
    match why {
        NotTried::NoPassword => "未試行：試行するには、ユーザー名とパスワードを入力してください",
        NotTried::PasswordRefused => {
            "未試行：パスワードがすでに拒否されています。試行を続けると、ユーザーがロックされます。"
        }
        NotTried::PasswordInTheClear => "未試行：サーバーが、暗号化しないパスワードの送信を要求しています",
        NotTried::OtherToken => "未試行：試行できるのは、ユーザー名とパスワードだけです",
        NotTried::UnknownSecurity => "未試行：このセキュリティポリシーまたはモードには対応していません",
        NotTried::OtherCertificate => {
            "未試行：サーバーが提示した証明書が、コントローラーで選択されている証明書と異なります"
        }
        NotTried::Chain => "未試行：サーバーが証明書チェーンを送信しましたが、まだ対応していません",
    }
}

pub fn verify_finding(finding: &VerifyFinding) -> String {
    match finding {
        VerifyFinding::NotRunning { error: Some(code), .. } => {
            format!("サーバーが動作していません：{}", code.explain(LANGUAGE).message)
        }
        VerifyFinding::NotRunning { error: None, .. } => {
            "サーバーが動作していません。サーバーを開始してから、再検証してください。".to_owned()
        }
        VerifyFinding::NoAnswer(why) => refusal(why),
        VerifyFinding::NoEndpoints => "サーバーがエンドポイントを提供していません".to_owned(),
        VerifyFinding::PolicyMissing(policy) => format!(
            "基本設定で{policy}が選択されていますが、\
             サーバーは提供していません。サーバーを再度開始してください。"
        ),
        VerifyFinding::PolicyNotTicked(policy) => {
            format!(
                "サーバーは{policy}を提供していますが、\
                 基本設定では選択されていません。サーバーを再度開始してください。"
            )
        }
        VerifyFinding::TokenMissing(token) => {
            format!(
                "基本設定で「{}」が選択されていますが、\
                 サーバーは提供していません。サーバーを再度開始してください。",
                TokenKind::from(*token).text(LANGUAGE)
            )
        }
        VerifyFinding::TokenNotTicked(token) => {
            format!(
                "サーバーは「{}」を提供していますが、\
                 基本設定では選択されていません。サーバーを再度開始してください。",
                TokenKind::from(*token).text(LANGUAGE)
            )
        }
        VerifyFinding::OtherAddress { url, reachable: true } => {
            format!("サーバーが通知するアドレスは{url}です。クライアントがこの名前で接続できる必要があります。")
        }
        VerifyFinding::OtherAddress { url, reachable: false } => {
            format!(
                "サーバーが通知するアドレスは{url}ですが、このPCからは接続できません。\
                 このアドレスを使用するクライアントは、接続に失敗します。"
            )
        }
        VerifyFinding::WeakPolicy(policy) if policy.as_str() == "None" => {
            "セキュリティポリシーNoneが提供されています。\
             通信内容が第三者に読み取られ、改ざんされるおそれがあります。"
                .to_owned()
        }
        VerifyFinding::WeakPolicy(policy) => {
            format!("非推奨の{policy}が提供されています。解読されるおそれがあります。")
        }
        VerifyFinding::NoUsers => "ユーザー名とパスワードによる接続だけが許可されていますが、\
                                   コントローラーにユーザーが登録されていません。ユーザーを追加してください。"
            .to_owned(),
        VerifyFinding::Clock(ahead) => format!(
            "コントローラーの時計が{1}{0}います。時計を合わせないと、証明書が拒否される場合があります。",
            if *ahead < chrono::TimeDelta::zero() { "遅れて" } else { "進んで" },
            span(ahead.num_minutes().unsigned_abs())
        ),
    }
}

fn span(minutes: u64) -> String {
    match minutes {
        0..120 => format!("{minutes}分"),
        120..2880 => format!("{}時間", minutes / 60),
        _ => format!("{}日", minutes / 1440),
    }
}

pub const fn token_kind(kind: TokenKind) -> &'static str {
    match kind {
        TokenKind::Anonymous => "匿名",
        TokenKind::UserName => "ユーザー名とパスワード",
        TokenKind::Certificate => "ユーザー証明書",
        TokenKind::Issued => "発行トークン",
    }
}

pub fn verify_counts(counts: VerifyCounts) -> String {
    let VerifyCounts { work, fail, not_tried } = counts;
    format!("正常{work}件、失敗{fail}件、未試行{not_tried}件")
}

pub fn endpoints_named(names: &[String]) -> String {
    match names {
        names if names.len() > MOST => format!("{}個のエンドポイント", names.len()),
        names => names.join("、"),
    }
}

const MOST: usize = 4;
