use clap::Args;
use serde_json::{Value, json};

use super::batch::{Presentation, PrintedResult};
use super::controller_selection::ControllerSelection;
use super::output::json_path;
use super::table::table;
use super::user_login::UserLoginArgs;
use super::{CommandContext, CommandOutcome};
use crate::jobs::{ConnectRefusal, TokenOutcome, Verify, VerifyReport};
use crate::model::{Language, Problem, untrusted_text};
use crate::pki::{CertificateRejection, Severity};
use crate::session::opcua_client::{ConnectTimeouts, MessageSecurity};
use crate::texts::{TextKey, cli as texts};

/// Exit code 1 if anything that is offered does not work.
#[derive(Debug, Args)]
pub struct VerifyArgs {
    #[command(flatten)]
    login: UserLoginArgs,

    /// First put the certificate of this configurator into the trusted list of each controller, where it stays
    #[arg(long)]
    trust_me: bool,

    #[command(flatten)]
    select: ControllerSelection,
}

pub fn run(cli: &CommandContext, args: &VerifyArgs) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    let chosen = args.select.resolve(&configuration, cli.output.language())?;
    let verify = Verify {
        identity: cli.workspace.own_identity(),
        login: args.login.credential()?,
        trust_first: args.trust_me,
        timeouts: ConnectTimeouts::default(),
    };
    let language = cli.output.language();
    let reports = cli.reports(&configuration, &chosen, verify, &REPORT)?;
    if !cli.output.is_json() {
        for (entry, report) in chosen.iter().zip(&reports) {
            match &report.result {
                Ok(report) => cli.output.text(&format!("{}: {}", entry.name, words(report, language))),
                Err(problem) => cli.output.explain(Some(entry.name.as_str()), problem),
            }
        }
    }
    Ok(CommandOutcome::of(&reports))
}

/// With `--json` only: [`words`] is what a person reads. JSON is for programs: its messages are English.
const REPORT: Presentation<VerifyReport> = Presentation {
    header: &[],
    show: |report, _| PrintedResult { json: as_json(report, Language::En), cells: Vec::new() },
};

fn as_json(report: &VerifyReport, language: Language) -> Value {
    let severity = |severity| match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    };
    let findings: Vec<Value> = report
        .findings
        .iter()
        .map(|finding| {
            json!({
                "severity": severity(finding.severity()),
                "code": finding.code(),
                "message": finding.explain(language),
            })
        })
        .collect();
    let certificate = report.certificate.as_ref().map(|verdict| {
        let refused = verdict.refused.as_ref();
        let status = refused.map_or("Good", |rejection| rejection.status().as_str());
        let findings: Vec<Value> = verdict
            .findings
            .iter()
            .map(|finding| {
                json!({
                    "severity": severity(finding.severity),
                    "status": finding.status(),
                    "cause": finding.flaw,
                    "message": finding.explain(language),
                })
            })
            .collect();
        json!({
            "status": status,
            "reason": refused.map(CertificateRejection::reason),
            "cause": refused.map(CertificateRejection::cause),
            "certificate": verdict.summary,
            "findings": findings,
        })
    });
    let endpoints: Vec<Value> = report
        .endpoints
        .iter()
        .map(|endpoint| {
            let tokens: Vec<Value> = endpoint
                .tokens
                .iter()
                .map(|token| {
                    let mut json = json!({
                        "token": token.kind,
                        "result": token.verdict.code(),
                        "message": token.verdict.explain(language),
                    });
                    if let TokenOutcome::Fails(ConnectRefusal::OwnCertificate(Some(told))) = &token.verdict {
                        json["status"] = json!(told.status);
                        json["reason"] = json!(told.reason);
                        json["cause"] = json!(told.cause);
                    }
                    if let TokenOutcome::Fails(ConnectRefusal::Status { name, .. }) = &token.verdict {
                        json["status"] = json!(name);
                    }
                    json
                })
                .collect();
            let policy = endpoint.policy.as_ref().map_or_else(String::as_str, |policy| policy.as_str());
            json!({ "policy": policy, "mode": endpoint.mode.map(MessageSecurity::as_str), "tokens": tokens })
        })
        .collect();
    json!({
        "url": report.url,
        "all_works": report.all_works(),
        "findings": findings,
        "server_certificate": certificate,
        "endpoints": endpoints,
        "own_certificate": {
            "file": json_path(&report.own.certificate_path),
            "thumbprint": report.own.certificate.thumbprint_sha1(),
        },
    })
}

/// The report for a terminal: the address, what was found, the server's certificate, a line for each token.
fn words(report: &VerifyReport, language: Language) -> String {
    let mut text = report.url.clone();
    let mark = |severity| if severity == Severity::Error { '✗' } else { '!' };
    let mut line = |mark: char, said: &str| {
        text.push_str(&format!("\n  {mark} {}", untrusted_text::one_line(said, usize::MAX)));
    };
    for finding in &report.findings {
        line(mark(finding.severity()), &finding.explain(language));
    }
    if let Some(verdict) = &report.certificate {
        match &verdict.refused {
            None => line('✓', TextKey::CliCertificateAccepted.text(language)),
            Some(rejection) => {
                line('✗', &format!("{}: {}", rejection.status(), rejection.cause().explain(language)));
            }
        }
        for finding in verdict.further_findings() {
            line(mark(finding.severity), &finding.explain(language));
        }
    }
    let mut rows = Vec::new();
    for endpoint in &report.endpoints {
        for token in &endpoint.tokens {
            let mark = match token.verdict {
                TokenOutcome::Works => "✓",
                TokenOutcome::Fails(_) => "✗",
                TokenOutcome::NotTried(_) => "-",
            };
            let said = token.verdict.explain(language);
            rows.push(vec![endpoint.name(), token.kind.text(language).to_owned(), format!("{mark} {said}")]);
        }
    }
    if !rows.is_empty() {
        let header = [TextKey::HeadingEndpoint, TextKey::HeadingUserToken, TextKey::HeadingResult]
            .map(|heading| heading.text(language));
        text.push('\n');
        text.push_str(&table(&header, &rows));
    }
    if report.lacks_trust() {
        let file = report.own.certificate_path.display().to_string();
        text.push_str(&texts::own_certificate(language, &file));
    }
    text
}
