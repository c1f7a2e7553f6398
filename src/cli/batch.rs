//! Runs one operation on the chosen controllers and prints its results.

use std::io::{IsTerminal as _, Write as _};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use indicatif::{ProgressBar, ProgressStyle};
use parking_lot::Mutex;
use serde_json::{Value, json};
use tokio_util::sync::CancellationToken;

use super::output::say;
use super::table::table;
use super::table_cell::TableCell;
use super::{CommandContext, CommandOutcome, runtime};
use crate::jobs::{
    self, CertificateChecked, Confirmation, ControllerReport, JobContext, JobController, JobEvent, NoOutput, Operation,
    OperationOutput,
};
use crate::model::{ControllerInfo, ErrorCode, Problem, clock};
use crate::pki::Severity;
use crate::platform::stop_signal::StopSignals;
use crate::session::Connectors;
use crate::texts::{TextKey, cli as texts};
use crate::workspace::{Configuration, ControllerEntry, RetrievedInfo, WorkspaceLock};

/// What is shown of one controller's success.
pub struct PrintedResult {
    /// `result` of the JSON line.
    pub json: Value,
    /// One row of the table, after the name.
    pub cells: Vec<TableCell>,
}

/// How the results of an operation are printed. `O`: the operation's [`Operation::Output`].
pub struct Presentation<O> {
    /// Column headings after `NAME`.
    pub header: &'static [TextKey],
    /// One result, with the information that was read from the controller afterwards.
    pub show: fn(&O, &ControllerInfo) -> PrintedResult,
}

/// The usual: the server's state after the change.
pub const STATE: Presentation<NoOutput> = Presentation {
    header: &[TextKey::HeadingStatus, TextKey::HeadingRevision],
    show: |_, info| PrintedResult {
        json: json!({ "status": info.status, "revision": info.revision }),
        cells: vec![info.status.into(), info.revision.to_string().into()],
    },
};

impl CommandOutcome {
    pub fn of<O: OperationOutput>(reports: &[ControllerReport<O>]) -> Self {
        let good = |report: &ControllerReport<O>| {
            report.result.as_ref().is_ok_and(|output| output.facts().shortcoming.is_none())
        };
        if reports.iter().all(good) { Self::AllDone } else { Self::SomeFailed }
    }
}

impl CommandContext {
    pub fn configuration(&self) -> Result<Configuration, Problem> {
        let loaded = self.workspace.load()?;
        if let Some(notice) = loaded.notice() {
            self.output.explain(None, &notice);
        }
        Ok(loaded.configuration)
    }

    pub fn context(&self, parallelism: usize) -> Result<JobContext, Problem> {
        Ok(JobContext::new(Connectors::standard(), self.passwords()?, parallelism))
    }

    /// Runs an operation on the chosen controllers, after asking where it must be asked.
    pub fn batch<O: OperationOutput>(
        &self,
        configuration: &Configuration,
        chosen: &[ControllerEntry],
        operation: impl Operation<Output = O> + 'static,
        presentation: &Presentation<O>,
    ) -> Result<CommandOutcome, Problem> {
        let reports = self.reports(configuration, chosen, operation, presentation)?;
        if !self.output.is_json() {
            self.print(chosen, &reports, presentation);
        }
        Ok(CommandOutcome::of(&reports))
    }

    /// As [`CommandContext::batch`], but without `--json` the printing is left to the caller.
    pub fn reports<O: OperationOutput>(
        &self,
        configuration: &Configuration,
        chosen: &[ControllerEntry],
        operation: impl Operation<Output = O> + 'static,
        presentation: &Presentation<O>,
    ) -> Result<Vec<ControllerReport<O>>, Problem> {
        if let Some(confirmation) = operation.confirmation() {
            self.confirm(confirmation, chosen, &[])?;
        }
        let on_report = self.json_lines(presentation);
        self.confirmed(configuration, chosen, operation, on_report)
    }

    /// As [`CommandContext::reports`], and the caller prints everything, with `--json` too.
    pub fn quiet_reports<O: OperationOutput>(
        &self,
        configuration: &Configuration,
        chosen: &[ControllerEntry],
        operation: impl Operation<Output = O> + 'static,
    ) -> Result<Vec<ControllerReport<O>>, Problem> {
        if let Some(confirmation) = operation.confirmation() {
            self.confirm(confirmation, chosen, &[])?;
        }
        self.confirmed(configuration, chosen, operation, |_, _| {})
    }

    /// As [`CommandContext::reports`], once everything was agreed to.
    fn confirmed<O: OperationOutput>(
        &self,
        configuration: &Configuration,
        chosen: &[ControllerEntry],
        operation: impl Operation<Output = O> + 'static,
        on_report: impl Fn(&str, &ControllerReport<O>) + Send + Sync + 'static,
    ) -> Result<Vec<ControllerReport<O>>, Problem> {
        let context = self.context(configuration.options.parallelism)?;
        let controllers: Vec<JobController> = chosen.iter().map(JobController::from).collect();
        let reports = self.run_job(controllers, Arc::new(operation), context, on_report)?;
        self.remember(chosen, &reports);
        Ok(reports)
    }

    /// Whether there is a person to ask, and reason to.
    fn asks(&self) -> bool {
        !self.yes && std::io::stdin().is_terminal()
    }

    /// An import of server certificates. On a terminal, what clients will say of them is shown and asked about together
    /// with the rest. Elsewhere, and with `--yes`, which agrees to the stop of the server only, `accept_warnings` says
    /// whether certificates that clients may complain about are imported.
    pub fn import<I: Operation<Output = O> + 'static, O: OperationOutput>(
        &self,
        configuration: &Configuration,
        chosen: &[ControllerEntry],
        check: impl Operation<Output = CertificateChecked> + 'static,
        import: impl FnOnce(bool) -> I,
        accept_warnings: bool,
        presentation: &Presentation<O>,
    ) -> Result<CommandOutcome, Problem> {
        if accept_warnings || self.output.is_json() || !self.asks() {
            return self.batch(configuration, chosen, import(accept_warnings), presentation);
        }
        // Not with `--json`, so what was found is printed below only.
        let checked = self.confirmed(configuration, chosen, check, |_, _| {})?;
        let mut good = 0;
        let mut remarks = Vec::new();
        for (entry, report) in chosen.iter().zip(&checked) {
            let Ok(CertificateChecked { findings, .. }) = &report.result else { continue };
            self.output.findings(entry.name.as_str(), findings);
            if findings.iter().all(|finding| finding.severity == Severity::Warning) {
                good += 1;
                if !findings.is_empty() {
                    remarks.push(TextKey::CliClientsMayComplain.text(self.output.language()));
                }
            }
        }
        if good == 0 {
            // The import says for each why it is refused, and sends nothing.
            let reports = self.confirmed(configuration, chosen, import(false), |_, _| {})?;
            self.print(chosen, &reports, presentation);
            return Ok(CommandOutcome::of(&reports));
        }
        remarks.dedup();
        let import = import(true);
        if let Some(confirmation) = import.confirmation() {
            self.confirm(confirmation, chosen, &remarks)?;
        }
        let reports = self.confirmed(configuration, chosen, import, |_, _| {})?;
        self.print(chosen, &reports, presentation);
        Ok(CommandOutcome::of(&reports))
    }

    /// What prints the JSON line of a controller as soon as it is finished; nothing without `--json`.
    fn json_lines<O: OperationOutput>(
        &self,
        presentation: &Presentation<O>,
    ) -> impl Fn(&str, &ControllerReport<O>) + use<O> {
        let (output, show) = (self.output, presentation.show);
        move |name, report| {
            if !output.is_json() {
                return;
            }
            let result = match &report.result {
                Ok(result) => result,
                Err(problem) => return output.failed(name, problem),
            };
            // Without information: done, but what the controller is like now could not be read.
            let shown = report.info.as_ref().map(|info| show(result, info).json);
            match (result.facts().shortcoming, shown) {
                (None, shown) => output.done(name, &shown.unwrap_or(Value::Null)),
                (Some(problem), Some(shown)) => output.done_with_shortcoming(name, &problem, &shown),
                (Some(problem), None) => output.failed(name, &problem),
            }
        }
    }

    fn run_job<O: OperationOutput>(
        &self,
        controllers: Vec<JobController>,
        operation: Arc<dyn Operation<Output = O>>,
        context: JobContext,
        on_report: impl Fn(&str, &ControllerReport<O>) + Send + Sync + 'static,
    ) -> Result<Vec<ControllerReport<O>>, Problem> {
        let count = controllers.len();
        let names: Vec<String> = controllers.iter().map(|c| c.name.to_string()).collect();
        let progress = if self.output.shows_progress() { bar(count) } else { ProgressBar::hidden() };
        let slots: Arc<Mutex<Vec<Option<ControllerReport<O>>>>> =
            Arc::new(Mutex::new((0..count).map(|_| None).collect()));
        let finished = Arc::new(AtomicUsize::new(0));
        let on_event = {
            let (slots, progress) = (slots.clone(), progress.clone());
            move |event| {
                let JobEvent::Finished { index, report } = event else { return };
                progress.set_position(finished.fetch_add(1, Ordering::Relaxed) as u64 + 1);
                on_report(&names[index], &report);
                slots.lock()[index] = Some(*report);
            }
        };
        let (runtime, language) = (runtime()?, self.output.language());
        runtime.block_on(async {
            let cancel = CancellationToken::new();
            let on_stop = {
                let (stop, cancel) = (StopSignals::listen(), cancel.clone());
                tokio::spawn(stop.end_at_second(move || {
                    say(TextKey::CliStopping.text(language));
                    cancel.cancel();
                }))
            };
            jobs::run(controllers, operation, context, cancel, on_event).await;
            on_stop.abort();
        });
        // What was given up may still hold a thread: a keyring that asks for its password, a name that is looked up.
        runtime.shutdown_background();
        progress.finish_and_clear();
        let mut slots = slots.lock();
        Ok(slots.drain(..).flatten().collect())
    }

    /// Takes the right to change the workspace, and clears away what a program that was killed left there.
    pub fn lock(&self) -> Result<WorkspaceLock, Problem> {
        let lock = self.workspace.lock()?;
        self.workspace.remove_leftovers(&lock);
        Ok(lock)
    }

    /// Keeps what was read for the window. A window that is open keeps its own.
    fn remember<O>(&self, chosen: &[ControllerEntry], reports: &[ControllerReport<O>]) {
        let now = clock::now();
        let keep = || -> Result<(), Problem> {
            let lock = self.lock()?;
            let mut configuration = self.workspace.load()?.configuration;
            for (entry, report) in chosen.iter().zip(reports) {
                let found = configuration.controllers.iter_mut().find(|c| c.name == entry.name);
                if let (Some(entry), Some(info)) = (found, &report.info) {
                    entry.last = Some(RetrievedInfo { at: now, info: info.clone() });
                }
            }
            Ok(self.workspace.save(&configuration, &lock)?)
        };
        if let Err(problem) = keep() {
            tracing::info!(%problem, "what was read is not kept");
        }
    }

    fn print<O: OperationOutput>(
        &self,
        chosen: &[ControllerEntry],
        reports: &[ControllerReport<O>],
        presentation: &Presentation<O>,
    ) {
        let language = self.output.language();
        let mut rows: Vec<Vec<String>> = Vec::new();
        for (entry, report) in chosen.iter().zip(reports) {
            if let (Ok(output), Some(info)) = (&report.result, &report.info) {
                let cells = (presentation.show)(output, info).cells;
                let cells = cells.iter().map(|cell| cell.text(language));
                rows.push(std::iter::once(entry.name.to_string()).chain(cells).collect());
            } else if report.result.is_ok() {
                // Done, but what the controller is like now could not be read.
                let unknown = presentation.header.iter().map(|_| "-".to_owned());
                rows.push(std::iter::once(entry.name.to_string()).chain(unknown).collect());
            }
        }
        if !rows.is_empty() {
            let headings = std::iter::once(&TextKey::HeadingName).chain(presentation.header);
            let headings: Vec<&str> = headings.map(|heading| heading.text(language)).collect();
            self.output.text(&table(&headings, &rows));
        }
        for (entry, report) in chosen.iter().zip(reports) {
            match &report.result {
                Ok(output) => {
                    for file in output.facts().moved_aside {
                        self.output.text(&crate::texts::moved_aside(self.output.language(), entry.name.as_str(), file));
                    }
                }
                Err(problem) => self.output.explain(Some(entry.name.as_str()), problem),
            }
        }
    }

    /// Asks on a terminal; without one, `--yes` must have been given.
    fn confirm(&self, confirmation: Confirmation, chosen: &[ControllerEntry], remarks: &[&str]) -> Result<(), Problem> {
        if self.yes || confirmation == Confirmation::default() {
            return Ok(());
        }
        if !self.asks() {
            return Err(ErrorCode::NotConfirmed.into());
        }
        let names: Vec<&str> = chosen.iter().map(|c| c.name.as_str()).collect();
        let language = self.output.language();
        say(&texts::changes(language, &names));
        for sentence in crate::texts::confirmation(confirmation) {
            say(&format!("  - {}", sentence.text(language)));
        }
        for remark in remarks {
            say(&format!("  - {remark}"));
        }
        eprint!("{} ", TextKey::CliGoOn.text(self.output.language()));
        let mut answer = String::new();
        let read = std::io::stderr().flush().and_then(|()| std::io::stdin().read_line(&mut answer));
        match (read, answer.trim()) {
            (Ok(_), "y" | "Y" | "yes") => Ok(()),
            _ => Err(ErrorCode::Cancelled.into()),
        }
    }
}

fn bar(count: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{wide_bar} {pos}/{len} {elapsed}")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(count as u64).with_style(style)
}
