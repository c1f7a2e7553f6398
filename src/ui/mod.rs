//! The window.
//!
//! A frame takes in the backend's events, draws from `&Model`, and turns what the engineer did into
//! [`Message`](model::Message)s. [`reduce`] alone changes the model, and gives back
//! [`BackendCommand`](model::BackendCommand)s; the [`Backend`](backend::Backend) does them elsewhere. A frame never
//! waits, and without an event there is no frame.
//!
//! The modules. Each may use only those above it:
//!
//! | module | contents |
//! |---|---|
//! | [`picker`], `theme`, `fonts` | the desktop's dialog for choosing a file and its file manager; every colour and size |
//! | [`model`] | what the window knows: rows, the running job, the open dialogs; what a command and a dialog is; messages |
//! | `widgets` | what dialogs are made of |
//! | `shell` | starting jobs; the dialogs that belong to no feature |
//! | `features` | what the window can do, one file or folder each |
//! | [`closing`], [`reduce`] | the one place where the model changes |
//! | [`backend`] | does the commands: jobs, files, saving |
//! | `views`, `keys`, `drops` | the main window |
//! | `app` | one frame |

mod app;
pub mod backend;
pub mod closing;
mod drops;
mod features;
mod file_manager;
mod fonts;
mod keys;
pub mod model;
mod notice;
pub mod picker;
mod reduce;
mod shell;
#[cfg(test)]
mod tests;
mod theme;
mod views;
mod widgets;

use std::cell::Cell;
use std::rc::Rc;
use std::sync::Arc;

use backend::{BackendOptions, TokioBackend, VirtualFleetStarter};
use model::Model;

use crate::model::{ErrorCode, Language, Problem, clock};
use crate::session::Connectors;
use crate::texts::TextKey;
use crate::workspace::{Configuration, Passwords, Workspace, WorkspaceLock};

pub use app::App;
// The dialogs that stories and pictures look into.
pub use features::add_controller::AddControllerForm;
pub use features::backup::BackupDialog;
pub use features::client_certificates::{DetailsView, TrustAction};
pub use features::delete_controllers::DeleteControllersDialog;
pub use features::live_values::{LiveConnection, LiveForm, LiveSection};
pub use features::recorder::{
    ControllerRecording, PlotRange, RecordedData, RecorderForm, RecorderSetup, RecordingPlot, RecordingState,
    RecordingView,
};
pub use features::remote_control::{RemoteForm, RemoteLink, RemoteSection, WhyNot};
pub use features::server_log::SaveLogForm;
pub use features::vault::VaultRequest;
pub use notice::show_notice;
pub use reduce::reduce;

/// What the window works with.
pub struct WindowOptions {
    /// The folder with the list and the files of the controllers.
    pub workspace: Workspace,
    /// Held for as long as the window is open.
    pub lock: WorkspaceLock,
    /// The list of controllers and the options, as they were loaded.
    pub configuration: Configuration,
    /// Where connection passwords are looked up and kept.
    pub passwords: Arc<dyn Passwords>,
    /// The driver of each kind of connection.
    pub connectors: Connectors,
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
///
/// Draws with OpenGL 2.1. On Windows, where remote desktops and virtual machines often have none, Direct3D 12 is tried
/// next; it draws in software if there is no graphics card.
pub fn run(options: WindowOptions) -> Result<(), Problem> {
    #[cfg(all(unix, not(target_os = "macos")))]
    if crate::platform::display::is_there()
        && let Some(library) = crate::platform::display::missing_library()
    {
        return Err(Problem::with_detail(ErrorCode::NoDisplay, library));
    }
    let title = TextKey::AppName.text(options.configuration.options.language.unwrap_or(options.language));
    let size = options.configuration.options.window.size.map_or(theme::DEFAULT_WINDOW, |(w, h)| [w, h]);
    let viewport = viewport(title).with_inner_size(size).with_min_inner_size(theme::MIN_WINDOW);
    // A renderer that fails does so before it takes them.
    let options = Rc::new(Cell::new(Some(options)));
    let open = |native: eframe::NativeOptions| {
        let options = options.clone();
        let create = move |creation: &eframe::CreationContext<'_>| match options.take() {
            Some(options) => Ok(Box::new(create(creation, options)?) as Box<dyn eframe::App>),
            None => Err("the window was open before".into()),
        };
        eframe::run_native(APP_ID, native, Box::new(create))
    };
    let result = open(native_options(viewport.clone()));
    #[cfg(windows)]
    let result = result.or_else(|opengl| {
        if !has_options(&options) {
            return Err(opengl);
        }
        tracing::warn!(%opengl, "no OpenGL; trying Direct3D 12");
        open(direct3d(native_options(viewport)))
    });
    result.map_err(no_display)
}

#[cfg(windows)]
fn has_options(options: &Cell<Option<WindowOptions>>) -> bool {
    let taken = options.take();
    let there = taken.is_some();
    options.set(taken);
    there
}

fn create(creation: &eframe::CreationContext<'_>, options: WindowOptions) -> std::io::Result<App<TokioBackend>> {
    let ctx = creation.egui_ctx.clone();
    let backend = BackendOptions {
        workspace: options.workspace.clone(),
        lock: options.lock,
        passwords: options.passwords,
        connectors: options.connectors,
        starter: options.starter,
        picker: Arc::new(picker::SystemPicker),
    };
    let virtual_available = backend.starter.is_some();
    let backend = TokioBackend::new(backend, move || ctx.request_repaint())?;
    backend.receive_stop_signals();
    let mut model = Model::new(options.configuration, options.workspace, options.language, clock::now());
    model.virtual_available = virtual_available;
    if let Some(notice) = options.notice {
        model.show_problem(notice);
    }
    Ok(App::new(&creation.egui_ctx, model, backend))
}

/// Title, icon and the name by which the desktop knows the program.
fn viewport(title: &str) -> egui::ViewportBuilder {
    let viewport = egui::ViewportBuilder::default().with_title(title).with_app_id(APP_ID);
    match eframe::icon_data::from_png_bytes(include_bytes!("../../assets/icon-256.png")) {
        Ok(icon) => viewport.with_icon(icon),
        Err(error) => {
            tracing::warn!(%error, "no window icon");
            viewport
        }
    }
}

fn native_options(viewport: egui::ViewportBuilder) -> eframe::NativeOptions {
    let native = eframe::NativeOptions { viewport, renderer: eframe::Renderer::Glow, ..Default::default() };
    #[cfg(all(unix, not(target_os = "macos")))]
    if crate::platform::display::prefers_x11() {
        use winit::platform::x11::EventLoopBuilderExtX11 as _;
        tracing::info!("WAYLAND_DISPLAY is set, but nobody answers there; using X11");
        let with_x11: eframe::EventLoopBuilderHook = Box::new(|builder| {
            builder.with_x11();
        });
        return eframe::NativeOptions { event_loop_builder: Some(with_x11), ..native };
    }
    native
}

#[cfg(windows)]
fn direct3d(native: eframe::NativeOptions) -> eframe::NativeOptions {
    let mut setup = eframe::egui_wgpu::WgpuSetupCreateNew::without_display_handle();
    setup.instance_descriptor.backends = wgpu::Backends::DX12;
    let wgpu_options =
        eframe::WgpuConfiguration { wgpu_setup: eframe::egui_wgpu::WgpuSetup::CreateNew(setup), ..Default::default() };
    eframe::NativeOptions { renderer: eframe::Renderer::Wgpu, wgpu_options, ..native }
}

fn no_display(error: eframe::Error) -> Problem {
    let detail = crate::platform::display::without_source_locations(&error.to_string());
    Problem::with_detail(ErrorCode::NoDisplay, detail)
}

const APP_ID: &str = "opcua-configurator";
