//! The real window without a display: made, clicked and typed into by labels as a person reads them.

use chrono::{DateTime, FixedOffset, Utc};
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use opcua_configurator::model::Language;
use opcua_configurator::texts::Zone;
use opcua_configurator::ui::App;
use opcua_configurator::ui::backend::Backend;
use opcua_configurator::ui::model::Model;
use opcua_configurator::workspace::{Configuration, Workspace};

use super::soft_renderer::SoftRenderer;

pub type Window<B> = Harness<'static, App<B>>;

pub const SIZE: [f32; 2] = [1280.0, 800.0];

/// The time in every picture.
pub fn now() -> DateTime<Utc> {
    "2026-06-01T08:30:00Z".parse().unwrap()
}

/// The window over a backend. English, light, at a fixed time in a fixed time zone.
pub fn window<B: Backend + 'static>(backend: B, configuration: Configuration, size: [f32; 2]) -> Window<B> {
    window_in(Workspace::new("/home/engineer/EpsonRC80/OPCUA"), backend, configuration, size)
}

/// The window over a backend and a workspace. English, light, at a fixed time in a fixed time zone.
pub fn window_in<B: Backend + 'static>(
    workspace: Workspace,
    backend: B,
    configuration: Configuration,
    size: [f32; 2],
) -> Window<B> {
    let mut harness = Harness::builder()
        .with_size(size)
        .with_theme(egui::Theme::Light)
        .with_max_steps(30)
        .renderer(SoftRenderer::default())
        .build_eframe(move |creation| {
            let mut model = Model::new(configuration, workspace, Language::En, now());
            model.zone = FixedOffset::east_opt(8 * 3600).map_or(Zone::Local, Zone::Fixed);
            model.options.theme = opcua_configurator::workspace::ThemeChoice::Light;
            App::new(&creation.egui_ctx, model, backend).with_clock(now)
        });
    settle(&mut harness);
    harness
}

/// Frames until nothing moves. A busy cursor blinking in a text field is not counted as movement.
pub fn settle<B: Backend>(window: &mut Window<B>) {
    window.run_ok();
}

/// Clicks the button, menu item, tick box or the like with this label; of several, the one on top.
pub fn click<B: Backend>(window: &mut Window<B>, label: &str) {
    let found = window.query_all_by_label(label).rfind(|node| is_control(node.accesskit_node().role()));
    found.unwrap_or_else(|| panic!("nothing to click is called {label:?}")).click();
    settle(window);
}

/// Other things may have the same words on them, such as the state "Stop" of a row.
pub fn is_control(role: Role) -> bool {
    matches!(
        role,
        Role::Button | Role::CheckBox | Role::RadioButton | Role::ComboBox | Role::MenuItem | Role::ListBoxOption
    )
}

/// Opens a menu and clicks an item.
pub fn choose<B: Backend>(window: &mut Window<B>, path: &[&str]) {
    for label in path {
        click(window, label);
    }
}

/// Replaces what is in the text field with this label.
pub fn type_into<B: Backend>(window: &mut Window<B>, label: &str, text: &str) {
    let is_field = |role: Role| matches!(role, Role::TextInput | Role::PasswordInput);
    let field = |window: &Window<B>| {
        let found = window.query_all_by_label(label).rfind(|node| is_field(node.accesskit_node().role()));
        found.unwrap_or_else(|| panic!("no text field is called {label:?}")).focus();
    };
    field(window);
    settle(window);
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    window.event(egui::Event::Text(text.to_owned()));
    settle(window);
}
