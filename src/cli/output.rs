use std::io::{IsTerminal as _, Write as _};
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::model::{Language, Problem};
use crate::pki::{CertificateFinding, Severity};
use crate::texts::TextKey;

/// Standard output and error, in the form that was asked for.
#[derive(Debug, Clone, Copy)]
pub struct Printer {
    json: bool,
    language: Language,
}

impl Printer {
    pub fn new(json: bool, language: Language) -> Self {
        Self { json, language }
    }

    pub fn language(self) -> Language {
        self.language
    }

    pub fn is_json(self) -> bool {
        self.json
    }

    /// Progress is for people at a terminal only.
    pub fn shows_progress(self) -> bool {
        !self.json && std::io::stderr().is_terminal()
    }

    /// `{"controller","ok":true,"result"}`.
    pub fn done(self, controller: &str, result: &Value) {
        line(&json!({ "controller": controller, "ok": true, "result": result }).to_string());
    }

    /// `{"controller","ok":false,"error":{"code","message","cause","remedy"}}`.
    pub fn failed(self, controller: &str, problem: &Problem) {
        line(&json!({ "controller": controller, "ok": false, "error": self.error(problem) }).to_string());
    }

    /// Prints an error that belongs to the request, not to one controller: with `--json`, or as text and an explanation.
    pub fn cli(self, what: &str, name: &str, result: &Result<(Value, String), Problem>) {
        match result {
            Ok((result, _)) if self.json => line(&json!({ what: name, "ok": true, "result": result }).to_string()),
            Err(problem) if self.json => {
                line(&json!({ what: name, "ok": false, "error": self.error(problem) }).to_string());
            }
            Ok((_, text)) => self.text(text),
            Err(problem) => self.explain(Some(name), problem),
        }
    }

    /// What a command that is about one thing only has done: `{"ok":true,"result"}`, or as text.
    pub fn finished(self, result: &Value, text: &str) {
        if self.json {
            line(&json!({ "ok": true, "result": result }).to_string());
        } else {
            self.text(text);
        }
    }

    /// It was done, and what came of it is not good: both of the above.
    pub fn done_with_shortcoming(self, controller: &str, problem: &Problem, result: &Value) {
        let error = self.error(problem);
        line(&json!({ "controller": controller, "ok": false, "error": error, "result": result }).to_string());
    }

    fn error(self, problem: &Problem) -> Value {
        let explained = problem.code.explain(self.language);
        let mut error = json!({
            "code": problem.code.as_str(),
            "message": explained.message,
            "cause": explained.cause,
            "remedy": explained.remedy,
        });
        if let Some(detail) = &problem.detail {
            error["detail"] = json!(detail);
        }
        error
    }

    pub fn text(self, text: &str) {
        line(text.trim_end());
    }

    /// Message, detail, cause and remedy on standard error.
    pub fn explain(self, who: Option<&str>, problem: &Problem) {
        let explained = problem.code.explain(self.language);
        let who = who.map(|w| format!("{w}: ")).unwrap_or_default();
        let detail = problem.detail.as_ref().map(|d| format!(" ({d})")).unwrap_or_default();
        say(&format!("{who}{}{detail}\n    {}\n    {}", explained.message, explained.cause, explained.remedy));
    }

    /// What clients will say about a certificate, on standard error.
    pub fn findings(self, who: &str, findings: &[CertificateFinding]) {
        for finding in findings {
            let severity = match finding.severity {
                Severity::Error => TextKey::CliError.text(self.language),
                Severity::Warning => TextKey::CliWarning.text(self.language),
            };
            say(&format!("{who}: {severity}: {} ({})", finding.explain(self.language), finding.status()));
        }
    }

    /// The request itself was wrong.
    pub fn request_wrong(self, problem: &Problem) {
        if self.json {
            line(&json!({ "ok": false, "error": self.error(problem) }).to_string());
        }
        self.explain(None, problem);
    }
}

/// A path in a JSON line. JSON is Unicode: what is not in a path (bytes that are not UTF-8, unpaired surrogates on
/// Windows) is written as `�`. To be used for every path: `json!` of a `Path` panics on such a one.
pub fn json_path(path: &Path) -> Value {
    Value::String(path.display().to_string())
}

/// Paths, each as [`json_path`] writes it.
pub fn json_paths(paths: &[PathBuf]) -> Value {
    paths.iter().map(|path| json_path(path)).collect()
}

/// A line on standard error: progress, questions, explanations. A reader that went away is no reason to fail.
pub fn say(text: &str) {
    let _gone = writeln!(std::io::stderr().lock(), "{text}");
}

/// A reader that went away (`| head`) is no reason to fail.
pub fn line(text: &str) {
    let mut out = std::io::stdout().lock();
    let _gone = writeln!(out, "{text}").and_then(|()| out.flush());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn a_path_that_is_not_utf_8_has_a_place_in_json() {
        use std::os::unix::ffi::OsStrExt as _;
        let path = Path::new(std::ffi::OsStr::from_bytes(b"/plant/\xff\xfe/1_cert.der"));
        assert_eq!(json!({ "file": json_path(path) }).to_string(), r#"{"file":"/plant/��/1_cert.der"}"#);
        assert_eq!(json_path(Path::new("/plant/焊接")), "/plant/焊接");
    }
}
