//! Closing the window while controllers or files are being changed: the window asks first, and closes when the work
//! has ended.

use egui::{Align, Layout, ProgressBar, RichText, Ui};

use super::theme::{self, palette};
use super::widgets::{Buttons, dialog, note, primary};
use crate::jobs::JobSummary;
use crate::texts::{self, TextKey as T};
use crate::ui::model::{BackendCommand, CancelState, CloseChoice, Closing, DialogAnswer, Message, Model};

impl Model {
    pub(in crate::ui) fn choose_about_closing(&mut self, choice: CloseChoice) -> Vec<BackendCommand> {
        match (choice, self.closing) {
            (CloseChoice::Ask, None) => {
                self.closing = Some(Closing::Asking);
                // Else they would take the keys that are for this dialog.
                self.command_palette = None;
                self.row_menu = None;
                // It may be minimised.
                return vec![BackendCommand::ShowWindow];
            }
            (CloseChoice::Ask, Some(_)) => {}
            (CloseChoice::Finish, _) => {
                self.closing = Some(Closing::Finishing);
                // A recording may have no end of its own.
                return self.end_all_recordings();
            }
            (CloseChoice::Stay, _) => self.closing = None,
            (CloseChoice::Stop, _) => {
                self.closing = Some(Closing::Stopping);
                let mut commands = self.end_all_recordings();
                if let Some(job) = self.job.as_mut().filter(|job| job.summary.is_none()) {
                    job.cancel = CancelState::Sent;
                    commands.push(BackendCommand::Cancel(job.id));
                }
                return commands;
            }
        }
        vec![]
    }

    /// The system ends the program, and there may be no person to ask.
    pub(in crate::ui) fn stop_requested(&mut self) -> Vec<BackendCommand> {
        let mut commands = self.choose_about_closing(CloseChoice::Stop);
        commands.push(BackendCommand::Quit);
        commands
    }

    /// A failure has to be seen before the window closes, if "finish first" was chosen.
    pub(in crate::ui) fn keep_open_after(&mut self, summary: JobSummary) {
        if summary.failed > 0 && self.closing == Some(Closing::Finishing) {
            self.closing = None;
        }
    }

    /// Whether the window may close as soon as no work is unfinished.
    pub fn closes_when_idle(&self) -> bool {
        matches!(self.closing, Some(Closing::Finishing | Closing::Stopping))
    }
}

/// The dialog over everything else. `enter`: the Enter key was pressed and belongs to it.
pub fn show(ui: &Ui, enter: bool, model: &Model, messages: &mut Vec<Message>) {
    let Some(closing) = model.closing else { return };
    let text = |key: T| key.text(model.language);
    let is_job = model.job.as_ref().is_some_and(|job| job.summary.is_none());
    let only_records = model.active_recordings() > 0 && !is_job;
    let mut choice = (enter && closing == Closing::Asking).then_some(CloseChoice::Finish);
    let buttons = Buttons { submit: None, close: None };
    let answer = dialog(ui, "closing", text(T::CloseTitle), theme::DIALOG, buttons, |ui| {
        progress(ui, model);
        ui.add_space(theme::SPACE);
        match closing {
            Closing::Asking if only_records => drop(ui.label(text(T::CloseRecordings))),
            Closing::Finishing | Closing::Stopping if only_records => drop(ui.label(text(T::CloseCompleting))),
            Closing::Asking => note(ui, palette(ui).warning, |ui| drop(ui.label(text(T::CloseWarning)))),
            Closing::Finishing => drop(ui.label(text(T::CloseFinishing))),
            Closing::Stopping => drop(ui.label(text(T::CloseStopping))),
        }
        ui.add_space(theme::SPACE_LARGE);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let finish = if only_records { T::CloseStopRecordings } else { T::CloseFinish };
            if closing == Closing::Asking && ui.add(primary(ui, text(finish))).clicked() {
                choice = Some(CloseChoice::Finish);
            }
            if closing != Closing::Stopping && !only_records && ui.button(text(T::CloseStop)).clicked() {
                choice = Some(CloseChoice::Stop);
            }
            if ui.button(text(T::CloseStay)).clicked() {
                choice = Some(CloseChoice::Stay);
            }
        });
    });
    if answer == DialogAnswer::Close {
        choice = Some(CloseChoice::Stay);
    }
    messages.extend(choice.map(Message::Closing));
}

/// What is still going on.
fn progress(ui: &mut Ui, model: &Model) {
    let palette = palette(ui);
    match model.job.as_ref().filter(|job| job.summary.is_none()) {
        Some(job) => {
            let all = job.rows.len();
            ui.label(texts::job_running(model.language, job.task.title, job.finished, all));
            ui.add_space(theme::SPACE);
            ui.visuals_mut().extreme_bg_color = palette.line;
            let done = job.finished as f32 / all.max(1) as f32;
            ui.add(ProgressBar::new(done).fill(palette.accent).desired_height(6.0).corner_radius(3));
        }
        None => {
            let said = match model.active_recordings() {
                0 => T::CloseOtherWork.text(model.language).to_owned(),
                active => texts::recordings_running(model.language, active),
            };
            ui.label(RichText::new(said).color(palette.text));
        }
    }
}
