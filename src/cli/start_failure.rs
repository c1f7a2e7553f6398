//! Shows why the program does not start when it was started without a terminal, such as by a double click.

use std::io::IsTerminal as _;

use crate::model::{ErrorCode, Language, Problem};
use crate::platform::console;
use crate::texts::TextKey;

/// Shows a problem in a window if standard error goes nowhere. `is_window`: the window was to be opened.
pub(super) fn show(problem: &Problem, language: Language, is_window: bool) {
    if !console::has_error_stream() {
        console::message_box(TextKey::AppName.text(language), &problem_text(problem, language));
    } else if is_window && !std::io::stderr().is_terminal() && problem.code != ErrorCode::NoDisplay {
        // The terminal is closed or a file, as for a program that was started from a menu of the desktop.
        show_notice(problem, language);
    }
}

#[cfg(all(unix, not(target_os = "macos")))]
fn show_notice(problem: &Problem, language: Language) {
    if crate::platform::display::is_there()
        && let Err(problem) = crate::ui::show_notice(&problem_text(problem, language), language)
    {
        tracing::warn!(%problem, "the message cannot be shown in a window");
    }
}

#[cfg(not(all(unix, not(target_os = "macos"))))]
fn show_notice(_problem: &Problem, _language: Language) {}

/// The same for a command line that cannot be read, or for its help.
pub(super) fn show_usage(text: &str, language: Language) {
    if !console::has_error_stream() {
        console::message_box(TextKey::AppName.text(language), text);
    }
}

/// Shows a panic of the thread that draws the window; those of jobs are caught and reported by the job.
pub(super) fn show_panics() {
    let default = std::panic::take_hook();
    let main = std::thread::current().id();
    std::panic::set_hook(Box::new(move |panic| {
        default(panic);
        if std::thread::current().id() == main && !console::has_error_stream() {
            let language = super::system_language();
            let text = format!("{}\n\n{panic}", TextKey::CliProgramError.text(language));
            console::message_box(TextKey::AppName.text(language), &text);
        }
    }));
}

fn problem_text(problem: &Problem, language: Language) -> String {
    let explained = problem.code.explain(language);
    let detail = problem.detail.as_ref().map(|detail| format!("\n\n{detail}")).unwrap_or_default();
    format!("{}\n\n{}\n{}{detail}", explained.message, explained.cause, explained.remedy)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_says_what_happened_why_and_what_to_do() {
        let problem = Problem::with_detail(ErrorCode::WorkspaceBusy, "/plant is in use");
        let text = problem_text(&problem, Language::En);
        assert!(text.starts_with("The workspace is open in another window\n\n"), "{text}");
        assert!(text.contains("close it first.") && text.ends_with("\n\n/plant is in use"), "{text}");
    }
}
