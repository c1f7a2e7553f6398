use std::sync::Arc;
use std::time::Duration;

use chrono::{DateTime, Utc};
use egui::ThemePreference;

use super::backend::Backend;
use super::model::{BackendCommand, CloseChoice, Message, Model};
use super::shell::dialogs;
use super::{closing, drops, fonts, keys, reduce, theme, views};
use crate::model::{Language, clock};
use crate::workspace::ThemeChoice;

/// What the window remembers of itself is saved when nothing changed for so long.
const SAVE_DELAY: Duration = Duration::from_secs(2);

type Clock = Arc<dyn Fn() -> DateTime<Utc>>;

/// The window, over any backend.
pub struct App<B: Backend> {
    /// Everything the views draw from.
    pub model: Model,
    /// Does the commands in the background.
    pub backend: B,
    clock: Clock,
    /// In egui's time.
    save_at: Option<f64>,
    theme: Option<ThemeChoice>,
    /// The language the order of the fonts is for.
    fonts_of: Language,
    size: Option<(f32, f32)>,
    dialogs_shown: usize,
    /// The frame in which the window asks for the focus.
    focus_at: Option<u64>,
}

impl<B: Backend> std::fmt::Debug for App<B> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("App").field("model", &self.model).finish_non_exhaustive()
    }
}

impl<B: Backend> App<B> {
    /// Sets fonts and theme of `ctx`; nothing is drawn yet.
    pub fn new(ctx: &egui::Context, model: Model, backend: B) -> Self {
        theme::install(ctx);
        fonts::install(ctx, model.language);
        Self {
            fonts_of: model.language,
            model,
            backend,
            clock: Arc::new(clock::now),
            save_at: None,
            theme: None,
            size: None,
            dialogs_shown: 0,
            focus_at: None,
        }
    }

    /// Another clock than the computer's, for pictures that must not change.
    pub fn with_clock(mut self, clock: impl Fn() -> DateTime<Utc> + 'static) -> Self {
        self.clock = Arc::new(clock);
        self
    }

    /// One frame: take in what happened, draw, change the model, hand out the work.
    pub fn frame(&mut self, ui: &mut egui::Ui) {
        self.take_in_events(ui.ctx());
        self.apply_theme(ui.ctx());
        self.apply_fonts(ui.ctx());

        let mut messages = Vec::new();
        drops::read(ui.ctx(), &self.model, &mut messages);
        keys::read(ui.ctx(), &self.model, &mut messages);
        views::window(ui, &self.model, &mut messages);
        // A dialog's form is the one thing a view may write to.
        let mut open = std::mem::take(&mut self.model.dialogs);
        let opened = open.len() > self.dialogs_shown;
        self.dialogs_shown = open.len();
        dialogs::show(ui, &mut open, opened, &self.model, &mut messages);
        self.model.dialogs = open;
        let enter = self.model.closing.is_some() && dialogs::enter_confirms(ui);
        closing::show(ui, enter, &self.model, &mut messages);
        drops::overlay(ui.ctx(), &self.model);
        self.remember_size(ui.ctx(), &mut messages);

        if !messages.is_empty() {
            self.take_in(&mut messages, ui.ctx());
            ui.ctx().request_repaint();
        }
        self.save_when_due(ui.ctx());
        self.focus_when_due(ui.ctx());
        // The bench of the window counts these.
        tracing::trace!(frame = ui.ctx().cumulative_frame_nr(), "drawn");
    }

    /// What the backend did since; also while the window is minimised, when nothing is drawn.
    fn take_in_events(&mut self, ctx: &egui::Context) {
        self.model.set_now((self.clock)());
        let mut messages = Vec::new();
        while let Some(event) = self.backend.poll() {
            messages.push(Message::Event(event));
        }
        self.take_in(&mut messages, ctx);
        self.close_in_order(ctx);
    }

    /// The window does not close before the work that must not be cut off has ended.
    fn close_in_order(&mut self, ctx: &egui::Context) {
        let unfinished = self.backend.has_unfinished_work();
        if ctx.input(|input| input.viewport().close_requested()) {
            if unfinished {
                ctx.send_viewport_cmd(egui::ViewportCommand::CancelClose);
                self.take_in(&mut vec![Message::Closing(CloseChoice::Ask)], ctx);
            }
        } else if !unfinished && self.model.closes_when_idle() {
            ctx.send_viewport_cmd(egui::ViewportCommand::Close);
        } else if !unfinished {
            // Nothing is left to ask about: the work ended while the dialog waited for an answer.
            self.model.closing = None;
        }
    }

    fn take_in(&mut self, messages: &mut Vec<Message>, ctx: &egui::Context) {
        for message in messages.drain(..) {
            for command in reduce(&mut self.model, message) {
                match command {
                    BackendCommand::Quit => ctx.send_viewport_cmd(egui::ViewportCommand::Close),
                    BackendCommand::ShowWindow => {
                        ctx.send_viewport_cmd(egui::ViewportCommand::Minimized(false));
                        self.focus_at = Some(ctx.cumulative_frame_nr() + 1);
                        ctx.request_repaint();
                    }
                    command => self.backend.send(command),
                }
            }
        }
    }

    fn apply_theme(&mut self, ctx: &egui::Context) {
        let theme = self.model.options.theme;
        if self.theme.replace(theme) != Some(theme) {
            ctx.set_theme(match theme {
                ThemeChoice::System => ThemePreference::System,
                ThemeChoice::Light => ThemePreference::Light,
                ThemeChoice::Dark => ThemePreference::Dark,
            });
        }
    }

    fn apply_fonts(&mut self, ctx: &egui::Context) {
        let language = self.model.language;
        let before = std::mem::replace(&mut self.fonts_of, language);
        if fonts::order(before) != fonts::order(language) {
            fonts::install(ctx, language);
        }
    }

    fn remember_size(&mut self, ctx: &egui::Context, messages: &mut Vec<Message>) {
        let size = ctx.content_rect().size();
        let size = (size.x.round(), size.y.round());
        // What the window opens with is not a choice to remember.
        if self.size.replace(size).is_some_and(|before| before != size) {
            messages.push(Message::Resized(size));
        }
    }

    /// A frame later than the window was restored: a minimised window takes no focus.
    fn focus_when_due(&mut self, ctx: &egui::Context) {
        if self.focus_at.is_some_and(|at| ctx.cumulative_frame_nr() >= at) {
            self.focus_at = None;
            ctx.send_viewport_cmd(egui::ViewportCommand::Focus);
            // Where programs may not take the focus, the desktop marks the window.
            if !ctx.input(|input| input.focused) {
                let attention = egui::UserAttentionType::Informational;
                ctx.send_viewport_cmd(egui::ViewportCommand::RequestUserAttention(attention));
            }
        }
    }

    fn save_when_due(&mut self, ctx: &egui::Context) {
        if !self.model.unsaved {
            self.save_at = None;
            return;
        }
        let now = ctx.input(|input| input.time);
        let at = *self.save_at.get_or_insert(now + SAVE_DELAY.as_secs_f64());
        if now >= at {
            self.take_in(&mut vec![Message::Save], ctx);
            self.save_at = None;
        } else {
            ctx.request_repaint_after(Duration::from_secs_f64(at - now));
        }
    }
}

impl<B: Backend> eframe::App for App<B> {
    fn logic(&mut self, ctx: &egui::Context, _frame: &mut eframe::Frame) {
        self.take_in_events(ctx);
    }

    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        self.frame(ui);
    }

    fn on_exit(&mut self, _gl: Option<&eframe::glow::Context>) {
        if self.model.unsaved {
            for command in reduce(&mut self.model, Message::Save) {
                self.backend.send(command);
            }
        }
    }
}
