//! The window: a model without egui, a reducer, views and dialogs.
//!
//! A frame takes in the backend's events, draws from `&Model`, and turns what the engineer did into
//! [`Message`](model::Message)s. [`reduce`](model::reduce) alone changes the model, and gives back
//! [`Command`](backend::Command)s; the [`Backend`](backend::Backend) does them elsewhere. A frame never waits, and
//! without an event there is no frame.
//!
//! | module | what lives there |
//! |---|---|
//! | [`app`](App) | one frame |
//! | [`backend`] | jobs, saving |
//! | [`command`] | what can be asked for: text, tooltip, key, and why it is disabled |
//! | [`picker`] | the desktop's dialog for choosing a file, and its file manager |
//! | `drops` | files dropped onto the window |
//! | [`model`] | rows, dialogs and their forms, the running job, the reducer |
//! | `views`, `dialogs`, `widgets` | what is drawn |
//! | `texts` | every word, in English and Chinese |
//! | `theme`, `fonts` | every colour and size |

mod app;
pub mod backend;
pub mod command;
mod dialogs;
mod drops;
mod file_manager;
mod fonts;
mod keys;
pub mod model;
pub mod picker;
pub mod texts;
mod theme;
mod views;
mod widgets;

use std::sync::Arc;

use chrono::Utc;

pub use app::App;
use backend::{BackendOptions, TokioBackend, VirtualFleetStarter};
use model::Model;
use texts::TextKey;

use crate::model::{Language, Problem};
use crate::session::Connector;
use crate::workspace::{Configuration, Passwords, Workspace, WorkspaceLock};

/// What the window works with.
pub struct WindowOptions {
    pub workspace: Workspace,
    /// Held for as long as the window is open.
    pub lock: WorkspaceLock,
    pub configuration: Configuration,
    pub passwords: Arc<dyn Passwords>,
    pub connector: Arc<dyn Connector>,
    /// `None`: virtual controllers are not offered.
    pub starter: Option<Arc<dyn VirtualFleetStarter>>,
    /// Used until the engineer chooses one.
    pub language: Language,
    /// What to tell first, such as a configuration that was damaged.
    pub notice: Option<Problem>,
}

impl std::fmt::Debug for WindowOptions {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("WindowOptions").field("workspace", &self.workspace).finish_non_exhaustive()
    }
}

/// Opens the window; returns when it is closed and everything is saved.
pub fn run(options: WindowOptions) -> Result<(), eframe::Error> {
    let title = TextKey::AppName.text(options.configuration.options.language.unwrap_or(options.language));
    let size = options.configuration.options.window.size.map_or(theme::DEFAULT_WINDOW, |(w, h)| [w, h]);
    let mut viewport = egui::ViewportBuilder::default()
        .with_title(title)
        .with_app_id("opcua-configurator")
        .with_inner_size(size)
        .with_min_inner_size(theme::MIN_WINDOW);
    match eframe::icon_data::from_png_bytes(include_bytes!("../../assets/icon-256.png")) {
        Ok(icon) => viewport = viewport.with_icon(icon),
        Err(error) => tracing::warn!(%error, "no window icon"),
    }
    let native = eframe::NativeOptions { viewport, ..Default::default() };
    eframe::run_native(
        "opcua-configurator",
        native,
        Box::new(move |creation| {
            let ctx = creation.egui_ctx.clone();
            let backend = BackendOptions {
                workspace: options.workspace.clone(),
                lock: options.lock,
                passwords: options.passwords,
                connector: options.connector,
                starter: options.starter,
                picker: Arc::new(picker::SystemPicker),
            };
            let virtual_available = backend.starter.is_some();
            let backend = TokioBackend::new(backend, move || ctx.request_repaint())?;
            let mut model = Model::new(options.configuration, options.workspace, options.language, Utc::now());
            model.virtual_available = virtual_available;
            if let Some(notice) = options.notice {
                model.show_problem(notice);
            }
            Ok(Box::new(App::new(&creation.egui_ctx, model, backend)))
        }),
    )
}
